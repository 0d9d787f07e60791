//! A machine at one speed: its motion, its gas, and what every bearing has to do.

use super::super::RunError;
use crate::input::MachinePlan;
use sommerfeld_bearing::LoadCycle;
use sommerfeld_engine::{CrankMotion, Performance, TorsionResponse};
use sommerfeld_film::FilmError;

/// A machine at one speed before any film is solved.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpeedLoads {
    /// Motion of the crankshaft or shaft.
    pub motion: CrankMotion,
    /// Gas, torque and orders; `None` for a shaft.
    pub performance: Option<Performance>,
    /// Torsional vibration, where it is followed.
    pub torsion: Option<TorsionResponse>,
    /// Load cycle of each bearing, in the order of the plan; hinges at the mains.
    pub cycles: Vec<LoadCycle>,
}

impl SpeedLoads {
    /// The loads at a speed, rad/s.
    pub(super) fn of(_plan: &MachinePlan, _speed: f64) -> Result<Self, RunError> {
        Err(RunError::Film(FilmError::Unsupported {
            reason: "loads are not merged",
        }))
    }
}
