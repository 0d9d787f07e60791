//! An engine or shaft: the loads of its bearings at every speed, and the orbits that answer them.

use super::ProgressCallback;
use crate::input::{FilmSettings, MachinePlan};
use crate::models::Model;
use crate::results::{Body, Header};
use sommerfeld_film::FilmError;

/// Every bearing of a machine at every speed.
pub(super) fn solve_machine(
    _plan: &MachinePlan,
    _settings: &FilmSettings,
    _header: &mut Header,
    _progress: &mut ProgressCallback<'_>,
) -> Result<Body, FilmError> {
    Err(FilmError::Unsupported {
        reason: "the analyses engine and shaft are not built yet",
    })
}

/// The models a machine uses.
pub(super) fn models_of_machine(_plan: &MachinePlan, _settings: &FilmSettings) -> Vec<Model> {
    Vec::new()
}
