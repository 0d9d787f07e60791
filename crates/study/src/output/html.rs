//! `report.html`.

use super::{OutputError, ResultWriter};
use crate::report::render;
use crate::results::Results;

/// Writes `report.html`.
#[derive(Debug, Clone, Copy)]
pub struct HtmlReport;

impl ResultWriter for HtmlReport {
    fn file_name(&self) -> &'static str {
        "report.html"
    }

    fn describe(&self) -> &'static str {
        "report with figures and tables, one offline file"
    }

    fn content(&self, results: &Results) -> Result<Option<Vec<u8>>, OutputError> {
        match render(results) {
            Ok(text) => Ok(Some(text.into_bytes())),
            Err(error) => Err(OutputError::Content {
                file: self.file_name(),
                reason: format!("{error:#}"),
            }),
        }
    }
}
