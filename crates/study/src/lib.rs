//! From a study file to results: checked input, the run, tables and the report.

pub mod cases;
pub mod input;
pub mod ledger;
pub mod limits;
pub mod models;
pub mod output;
pub mod progress;
pub mod report;
pub mod results;
pub mod run;
pub mod templates;

pub use input::{InputError, InputErrors, Study, load_study};
pub use progress::ProgressEvent;
pub use run::{RunError, RunSummary, run, run_on, solve};
pub use sommerfeld_film::Outcome;
