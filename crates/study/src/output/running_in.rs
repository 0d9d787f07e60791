//! `running-in.csv`: a shell that runs in, one row for each step and one for its end.

use super::csv::{Table, begins_with, number};
use super::{OutputError, ResultWriter};
use crate::results::{Body, Results};
use sommerfeld_bearing::{RanIn, RunningInStep};

/// Writes `running-in.csv`: wear, contact, film and roughness over the hours of running-in.
#[derive(Debug, Clone, Copy)]
pub struct RunningInTable;

impl ResultWriter for RunningInTable {
    fn file_name(&self) -> &'static str {
        "running-in.csv"
    }

    fn describe(&self) -> &'static str {
        "running-in: wear rate, contact share, film and roughness per step"
    }

    fn is_own_table(&self, first_line: &str) -> bool {
        begins_with(first_line, COLUMNS.iter().map(|(name, _)| *name))
    }

    fn content(&self, results: &Results) -> Result<Option<Vec<u8>>, OutputError> {
        let Body::LoadCycle(cycle) = &results.body else {
            return Ok(None);
        };
        let Some(ran) = &cycle.running_in else {
            return Ok(None);
        };
        let mut table = Table::new(self.file_name());
        table.row(COLUMNS.iter().map(|(name, _)| *name))?;
        for step in &ran.steps {
            table.row(COLUMNS.iter().map(|(_, value)| number(value(step))))?;
        }
        table.finish().map(Some)
    }
}

/// A column: its header and its value at a step.
type Column = (&'static str, fn(&RunningInStep) -> f64);

const COLUMNS: &[Column] = &[
    ("time[s]", |step| step.time),
    ("duration[s]", |step| step.duration),
    ("wear_rate[m/s]", |step| step.deepest_rate),
    ("wear_volume_rate[m3/s]", |step| step.volume_rate),
    ("worn_depth[m]", |step| step.depth),
    ("worn_volume[m3]", |step| step.volume),
    ("shell_roughness[m]", |step| step.shell_roughness),
    ("contact_load_share[-]", |step| step.contact_share),
    ("minimum_film_thickness[m]", |step| {
        step.minimum_film_thickness
    }),
    ("rate_change[-]", |step| step.rate_change),
];

/// The columns with their values.
pub(super) fn columns(ran: &RanIn) -> Vec<(String, Vec<f64>)> {
    let all = COLUMNS.iter();
    all.map(|(name, value)| ((*name).to_owned(), ran.steps.iter().map(value).collect()))
        .collect()
}
