//! What may already lie in the directory of results, and what becomes of it.
//!
//! Results of an earlier run are replaced, whichever study they came from: files that this run does
//! not write are removed, so that no table of another run stays beside the new summary. A file that
//! no run has written is never touched.

use super::{OutputError, WRITERS};
use crate::results::PROGRAM;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The file by which a directory of results is known.
const SUMMARY: &str = "summary.json";

/// Sees that a run that writes into `directory` overwrites none of its `inputs` and nothing that is
/// not a result of this program.
///
/// # Errors
/// [`OutputError::Taken`].
pub fn check_directory(directory: &Path, inputs: &[PathBuf]) -> Result<(), OutputError> {
    let taken = |path: PathBuf, reason| Err(OutputError::Taken { path, reason });
    let has_results = holds_results(directory);
    for name in WRITERS.iter().map(|writer| writer.file_name()) {
        let path = directory.join(name);
        let Ok(real) = fs::canonicalize(&path) else {
            continue;
        };
        if inputs
            .iter()
            .any(|input| fs::canonicalize(input).is_ok_and(|input| input == real))
        {
            return taken(path, "it is an input of this study");
        }
        let is_table = path.extension().is_some_and(|kind| kind == "csv");
        if !has_results && (is_table || name == SUMMARY) {
            return taken(path, "it is not the result of a run");
        }
    }
    Ok(())
}

/// The directory holds results of this program.
pub(super) fn holds_results(directory: &Path) -> bool {
    /// The name of the program stands among the first keys of a summary.
    const HEAD: u64 = 4096;
    let mut head = Vec::new();
    let read = fs::File::open(directory.join(SUMMARY))
        .and_then(|file| file.take(HEAD).read_to_end(&mut head));
    let named = format!("\"program\": \"{PROGRAM}\"");
    read.is_ok() && String::from_utf8_lossy(&head).contains(&named)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    #[test]
    fn an_input_and_foreign_files_are_kept() {
        let directory = tempfile::tempdir().unwrap();
        let loads = directory.path().join("cycle.csv");
        let check = |inputs: &[PathBuf]| check_directory(directory.path(), inputs);
        assert!(check(&[]).is_ok());
        fs::write(&loads, "crank_angle[deg]\n").unwrap();
        let error = check(&[]).unwrap_err().to_string();
        assert!(error.contains("not the result of a run"), "{error}");
        let summary = directory.path().join(SUMMARY);
        fs::write(
            &summary,
            "{\n  \"schema\": 1,\n  \"program\": \"sommerfeld\"\n}\n",
        )
        .unwrap();
        assert!(check(&[]).is_ok());
        let error = check(&[loads]).unwrap_err().to_string();
        assert!(error.contains("an input of this study"), "{error}");
        fs::write(&summary, "{\"program\": \"another\"}").unwrap();
        assert!(check(&[]).is_err());
    }
}
