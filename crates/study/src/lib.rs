//! From a study file to results: checked input, the run, tables and the report.

pub mod input;
pub mod limits;
pub mod models;
pub mod oil_holes;
pub mod output;
pub mod progress;
pub mod report;
pub mod results;
pub mod run;
pub mod templates;

pub use input::{InputError, InputErrors, Study, load_study};
pub use progress::ProgressEvent;
pub use run::{RunError, RunSummary, run, solve};
pub use sommerfeld_film::Outcome;
