//! From a study file to results: checked input, the run, tables and the report.

pub mod limits;
pub mod models;
pub mod output;
pub mod report;
pub mod results;
