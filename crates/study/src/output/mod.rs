//! Results as files: one writer per format, iterated from one list.

mod csv;
mod html;
mod json;

pub use csv::{CaseTable, CycleTable, FieldTable, case_table, cycle_table, field_table};
pub use html::HtmlReport;
pub use json::{SummaryJson, summary};

use crate::results::Results;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// One format of results.
pub trait ResultWriter: Sync {
    /// Name of the file this format is written to, without directory.
    fn file_name(&self) -> &'static str;

    /// What the file holds, in one line, for help texts.
    fn describe(&self) -> &'static str;

    /// The content of the file; `None` if these results have nothing for this format.
    ///
    /// # Errors
    /// [`OutputError::Content`] if the content cannot be built.
    fn content(&self, results: &Results) -> Result<Option<Vec<u8>>, OutputError>;
}

/// Every format, in the order in which they are written: the summary last, so that a directory
/// that holds it holds everything.
pub const WRITERS: &[&dyn ResultWriter] = &[
    &CycleTable,
    &FieldTable,
    &CaseTable,
    &HtmlReport,
    &SummaryJson,
];

/// Results that could not be written.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The disk or its permissions failed: the machine's fault, not the study's.
    #[error("cannot {action} {}: {source}", path.display())]
    Disk {
        /// What was tried.
        action: &'static str,
        /// The file or directory.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The content of a file could not be built: a fault of this program.
    #[error("cannot build {file}: {reason}")]
    Content {
        /// The file.
        file: &'static str,
        /// Why.
        reason: String,
    },
}

/// Makes the directory if it is missing and sees that files can be written into it.
///
/// # Errors
/// [`OutputError::Disk`].
pub fn prepare_directory(directory: &Path) -> Result<(), OutputError> {
    let failed = |action, path: &Path| {
        let path = path.to_path_buf();
        move |source| OutputError::Disk {
            action,
            path,
            source,
        }
    };
    fs::create_dir_all(directory).map_err(failed("create the directory", directory))?;
    let trial = directory.join(".part");
    fs::File::create(&trial)
        .and_then(|_| fs::remove_file(&trial))
        .map_err(failed("write into the directory", directory))
}

/// Writes every format these results have into `directory`, which is created if missing, and
/// returns the files in the order of writing. Other files in the directory are left alone.
///
/// # Errors
/// [`OutputError`] at the first file that fails; files written before stay.
pub fn write_all(results: &Results, directory: &Path) -> Result<Vec<PathBuf>, OutputError> {
    fs::create_dir_all(directory).map_err(|source| OutputError::Disk {
        action: "create the directory",
        path: directory.to_path_buf(),
        source,
    })?;
    let mut files = Vec::new();
    for writer in WRITERS {
        if let Some(content) = writer.content(results)? {
            let path = directory.join(writer.file_name());
            replace_file(&path, &content)?;
            files.push(path);
        }
    }
    Ok(files)
}

/// Writes a file under a temporary name beside it and renames it: a reader, or a run that is
/// interrupted, sees the old file or the new one, never half of it.
///
/// # Errors
/// [`OutputError::Disk`].
pub fn replace_file(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".part");
    let temporary = path.with_file_name(name);
    write_through(&temporary, content)
        .and_then(|()| fs::rename(&temporary, path))
        .map_err(|source| {
            // The first failure is the one to report, whether or not the remains can be removed.
            let _ = fs::remove_file(&temporary);
            OutputError::Disk {
                action: "write",
                path: path.to_path_buf(),
                source,
            }
        })
}

/// Writes a file and waits until it is on the disk: only then may the rename make it the result.
fn write_through(path: &Path, content: &[u8]) -> io::Result<()> {
    let mut file = fs::File::create(path)?;
    io::Write::write_all(&mut file, content)?;
    file.sync_all()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    #[test]
    fn file_names_are_unique() {
        for (index, writer) in WRITERS.iter().enumerate() {
            let same = |other: &&&dyn ResultWriter| other.file_name() == writer.file_name();
            assert_eq!(WRITERS[..index].iter().filter(same).count(), 0);
        }
    }

    #[test]
    fn a_failed_disk_names_the_file() {
        let error = replace_file(Path::new("/nonexistent/summary.json"), b"{}").unwrap_err();
        assert!(error.to_string().contains("/nonexistent/summary.json"));
    }
}
