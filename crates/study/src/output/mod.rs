//! Results as files: one writer per format, iterated from one list.

mod csv;
mod earlier;
mod hdf5;
mod html;
mod json;
mod machine;
mod running_in;
mod stability;
mod vtk;

pub use csv::{CaseTable, CycleTable, FieldTable, case_table, cycle_table, field_table};
pub use earlier::check_directory;
pub use hdf5::Hdf5Results;
pub use html::HtmlReport;
pub use json::{SummaryJson, summary};
pub use machine::{BearingTables, BearingsTable, EngineTables};
pub use running_in::RunningInTable;
pub use stability::StabilityTable;
pub use vtk::ParaView;

use crate::results::Results;
use crate::spool::FieldSpool;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Which instants of a cycle are stored as fields.
#[derive(Debug, Clone, Copy)]
pub enum StoredFields<'a> {
    /// Every crank angle, from the disk.
    Spool(&'a FieldSpool),
    /// The frames of the results.
    Frames,
    /// None.
    None,
}

/// One format of results: a file whose content fits in the memory (`content`), or whatever files
/// `write` makes of it and `files_in` finds again.
pub trait ResultWriter: Sync {
    /// Name of the file this format is written to, without directory; of several files, that of the
    /// one to open.
    fn file_name(&self) -> &'static str;

    /// What the file holds, in one line, for help texts.
    fn describe(&self) -> &'static str;

    /// Whether a file that begins with this line is a table of this format, so that a run may
    /// replace it.
    fn is_own_table(&self, _first_line: &str) -> bool {
        false
    }

    /// Files of this format that may lie in a directory, of whichever run.
    fn files_in(&self, directory: &Path) -> Vec<PathBuf> {
        let path = directory.join(self.file_name());
        if path.exists() {
            vec![path]
        } else {
            Vec::new()
        }
    }

    /// The content of the file; `None` if these results have nothing for this format.
    ///
    /// # Errors
    /// [`OutputError::Content`] if the content cannot be built.
    fn content(&self, _results: &Results) -> Result<Option<Vec<u8>>, OutputError> {
        Ok(None)
    }

    /// Writes the format into `directory` and returns its files in the order of writing: none if
    /// these results have nothing for it.
    ///
    /// # Errors
    /// [`OutputError`].
    fn write(
        &self,
        results: &Results,
        _stored: StoredFields<'_>,
        directory: &Path,
    ) -> Result<Vec<PathBuf>, OutputError> {
        let Some(content) = self.content(results)? else {
            return Ok(Vec::new());
        };
        let path = directory.join(self.file_name());
        replace_file(&path, &content)?;
        Ok(vec![path])
    }
}

/// Every format, in the order in which they are written: the summary last, so that a directory
/// that holds it holds everything.
pub const WRITERS: &[&dyn ResultWriter] = &[
    &CycleTable,
    &FieldTable,
    &Hdf5Results,
    &ParaView,
    &StabilityTable,
    &RunningInTable,
    &CaseTable,
    &BearingsTable,
    &EngineTables,
    &BearingTables,
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
    /// Something lies there that no run has written, or that this one reads: the user's to move.
    #[error("{} is in the way: {reason}\n  = hint: name another directory with --out, or move the file", path.display())]
    Taken {
        /// The file.
        path: PathBuf,
        /// Why it stays.
        reason: &'static str,
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

/// Writes every format these results have into `directory`, with the frames of a cycle as its
/// fields: [`write_stored`].
///
/// # Errors
/// As [`write_stored`].
pub fn write_all(results: &Results, directory: &Path) -> Result<Vec<PathBuf>, OutputError> {
    write_stored(results, StoredFields::Frames, directory)
}

/// Writes every format these results have into `directory`, which is created if missing, and
/// returns the files in the order of writing. Files that an earlier run left and these results have
/// no content for are removed; all others are left alone.
///
/// # Errors
/// [`OutputError`] at the first file that fails; files written before stay.
pub fn write_stored(
    results: &Results,
    stored: StoredFields<'_>,
    directory: &Path,
) -> Result<Vec<PathBuf>, OutputError> {
    fs::create_dir_all(directory).map_err(|source| OutputError::Disk {
        action: "create the directory",
        path: directory.to_path_buf(),
        source,
    })?;
    let is_earlier_run = earlier::holds_results(directory);
    let mut files = Vec::new();
    for writer in WRITERS {
        let written = writer.write(results, stored, directory)?;
        let left = writer.files_in(directory).into_iter();
        for path in left.filter(|path| !written.contains(path)) {
            if !(is_earlier_run && earlier::is_ours(*writer, &path)) {
                continue;
            }
            fs::remove_file(&path).map_err(|source| OutputError::Disk {
                action: "remove what an earlier run left,",
                path,
                source,
            })?;
        }
        files.extend(written);
    }
    Ok(files)
}

/// Writes a file under a temporary name beside it and renames it: a reader, or a run that is
/// interrupted, sees the old file or the new one, never half of it.
///
/// # Errors
/// [`OutputError::Disk`].
pub fn replace_file(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    replace_with(path, |file| file.write_all(content))
}

/// The same with a file that is written piece by piece.
fn replace_with(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&fs::File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".part");
    let temporary = path.with_file_name(name);
    write_through(&temporary, write)
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
fn write_through(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&fs::File>) -> io::Result<()>,
) -> io::Result<()> {
    let file = fs::File::create(path)?;
    let mut buffer = BufWriter::new(&file);
    write(&mut buffer)?;
    buffer.flush()?;
    drop(buffer);
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
    fn what_fails_half_way_leaves_what_was_there() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("results.h5");
        replace_file(&path, b"old").unwrap();
        let fails = |file: &mut BufWriter<&fs::File>| {
            file.write_all(b"half")?;
            Err(io::Error::other("no space left"))
        };
        let error = replace_with(&path, fails).unwrap_err();
        assert!(error.to_string().contains("no space left"));
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_failed_disk_names_the_file() {
        let error = replace_file(Path::new("/nonexistent/summary.json"), b"{}").unwrap_err();
        assert!(error.to_string().contains("/nonexistent/summary.json"));
    }
}
