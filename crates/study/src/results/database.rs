//! What the build of a database left behind.

use crate::film_tables::DatabaseFacts;
use std::path::PathBuf;

/// A database that was built, or was begun.
#[derive(Debug, Clone, PartialEq)]
pub struct DatabaseResults {
    /// The file of the database; where the build was stopped, that of the films solved so far.
    pub file: PathBuf,
    /// What it holds and how far it errs; `None` where the build was stopped.
    pub built: Option<BuiltDatabase>,
    /// Wall time of the build, s; of a build that was taken up, from there on.
    pub build_time: f64,
}

/// A database that is whole.
#[derive(Debug, Clone, PartialEq)]
pub struct BuiltDatabase {
    /// What it holds, with the error that the file states.
    pub facts: DatabaseFacts,
    /// Error that was asked for.
    pub target: f64,
    /// Error of the force over its size that 99.9 % of the build's samples stay below.
    pub quantile_999: f64,
    /// Half of them.
    pub median: f64,
    /// Largest error of the peak pressure over itself, of the same samples; `None` where it was not
    /// measured.
    pub peak_maximum: Option<f64>,
    /// Nodes along each axis, with its name.
    pub axes: Vec<(&'static str, usize)>,
    /// States drawn anew after the build, each against a film solved for it; none where the build
    /// measured all.
    pub fresh: Vec<FreshSample>,
    /// What the database says over its eccentricities, by direction of the motion.
    pub curves: Vec<ForceCurve>,
}

/// A state drawn anew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreshSample {
    /// Relative eccentricity.
    pub eccentricity: f64,
    /// Angle of the effective velocity from the line of centres, rad.
    pub angle: f64,
    /// Error of the force over its size.
    pub error: f64,
}

/// Force over the relative eccentricity in one direction of motion, dimensionless.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceCurve {
    /// Angle of the effective velocity from the line of centres, rad: 0 the gap closes.
    pub angle: f64,
    /// Relative eccentricities.
    pub eccentricity: Vec<f64>,
    /// Size of the force over `eta |w| R^3 B / (2 c^3)`.
    pub force: Vec<f64>,
    /// Peak pressure over `eta |w| R^2 / c^3`.
    pub peak: Vec<f64>,
}

impl BuiltDatabase {
    /// Largest error of the states drawn anew.
    #[must_use]
    pub fn fresh_maximum(&self) -> f64 {
        self.fresh.iter().map(|one| one.error).fold(0.0, f64::max)
    }
}
