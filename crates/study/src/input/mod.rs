//! From a study file to a checked [`Study`]: read, check, convert to SI, with every error named.
//!
//! `keys` is the one table of what a study file may hold; [`units`] the one place where text becomes
//! SI; `read` walks the TOML; `check` looks at what no single key can tell; [`load_study`] joins them.

mod check;
mod contact_file;
mod csv_table;
pub mod diagram_file;
mod error;
mod explain;
mod files;
pub(crate) mod film_models;
mod heat;
mod json_schema;
mod keys;
pub mod load_file;
mod machine;
mod profile_file;
mod read;
pub mod schema;
mod study;
mod sweep;
pub mod units;
mod values;
mod vary;
mod wear;

pub use error::{InputError, InputErrors, MessageKind, Place, render_all};
pub use explain::{explain, list_keys};
pub use files::{load_study, study_from_text};
pub use heat::{HeatPlan, Wall};
pub use json_schema::json_schema;
pub use keys::KEYS;
pub use machine::{EnginePlan, Machine, MachineBearing, MachinePlan, OrbitPlan};
pub use study::{
    Analysis, BearingCase, Compared, CycleDuty, DatabasePlan, Duty, FilmMethod, FilmModel,
    FilmSettings, LinearSolver, Rotor, SteadyLoad, StoredInstants, Study, StudyLimit, Subject,
    TiltCondition,
};
pub use sweep::{Keep, KeyStep, SweepMode, SweepPlan, VariedKey, VariedValue};
pub use wear::{RunningInPlan, WearPlan};
