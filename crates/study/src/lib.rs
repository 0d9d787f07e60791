//! From a study file to results: checked input, the run, tables and the report.

pub mod cases;
pub mod database_files;
pub mod film_tables;
pub mod hdf5;
pub mod input;
mod key_figures;
pub mod ledger;
pub mod limits;
pub mod models;
pub mod oil_holes;
pub mod output;
pub mod progress;
pub mod regime;
pub mod report;
pub mod results;
pub mod run;
pub mod sanity;
pub mod spool;
pub mod templates;
pub mod verify;

pub use input::{InputError, InputErrors, Study, load_study};
pub use progress::ProgressEvent;
pub use run::{RunError, RunOptions, RunSummary, run, run_with, solve, solve_with};
pub use sommerfeld_film::Outcome;
