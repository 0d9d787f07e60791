//! The study run once more: with plain surfaces and oil, and with other models of the film.

use super::{Body, status_name};
use sommerfeld_film::Outcome;

/// A study run once more with smooth surfaces, a rigid shell and an oil of constant viscosity and
/// density, at one temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct PlainRun {
    /// Temperature of the oil, K.
    pub temperature: f64,
    /// How the run ended.
    pub status: Outcome,
    /// Its numbers, without fields; none where the film refused it, as rigid smooth surfaces do at a
    /// position that only asperities hold.
    pub body: Option<Body>,
    /// Wall time of the run, s.
    pub wall_time: f64,
}

/// A study run once more with other models of the film.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The study's own model, as in the study file.
    pub own_model: &'static str,
    /// Wall time of the study with its own model, s.
    pub own_wall_time: f64,
    /// The other models in the order of the study.
    pub runs: Vec<ModelRun>,
}

impl Comparison {
    /// A run that was stopped before every model had its turn.
    #[must_use]
    pub fn is_unfinished(&self) -> bool {
        self.runs.iter().any(|run| run.end == ModelEnd::NotRun)
    }
}

/// A study run with another model of the film.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelRun {
    /// The model, as in the study file.
    pub model: &'static str,
    /// How it ended.
    pub end: ModelEnd,
    /// In which ways the model takes the bearing to be other than the study has it.
    pub notes: Vec<String>,
    /// Its numbers, without fields; `None` where it has none.
    pub body: Option<Body>,
    /// Wall time of the run, s.
    pub wall_time: f64,
}

/// How a run with another model of the film ended.
#[derive(Debug, Clone, PartialEq)]
pub enum ModelEnd {
    /// With this outcome.
    Ended(Outcome),
    /// The model cannot do what the study asks; why.
    Refused(String),
    /// The study was stopped before.
    NotRun,
}

impl ModelEnd {
    /// The word for it in results: that of an outcome, `refused` or `not-run`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Ended(outcome) => status_name(*outcome),
            Self::Refused(_) => "refused",
            Self::NotRun => "not-run",
        }
    }
}
