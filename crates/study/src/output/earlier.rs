//! What may already lie in the directory of results, and what becomes of it.
//!
//! Results of an earlier run are replaced, whichever study they came from: files that this run does
//! not write are removed, so that no table of another run stays beside the new summary. A file that
//! no run has written is never touched.
//!
//! A run that was killed between its first table and its summary leaves no summary: its tables are
//! known by their header.

use super::{OutputError, ResultWriter, WRITERS};
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
    let has_summary = holds_summary(directory);
    let files = WRITERS.iter().flat_map(|writer| {
        let files = writer.files_in(directory).into_iter();
        files.map(move |path| (writer, path))
    });
    for (writer, path) in files {
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
        let is_foreign = match is_table {
            true => !is_own_table(*writer, &path),
            false => writer.file_name() == SUMMARY,
        };
        if !has_summary && is_foreign {
            return taken(path, "it is not the result of a run");
        }
    }
    Ok(())
}

/// The directory holds results of this program: its summary or, of a run that was killed before it
/// wrote one, a table.
pub(super) fn holds_results(directory: &Path) -> bool {
    let has_table = || {
        let mut writers = WRITERS.iter();
        writers.any(|writer| {
            let files = writer.files_in(directory);
            files.iter().any(|path| is_own_table(*writer, path))
        })
    };
    holds_summary(directory) || has_table()
}

/// A file of a name of this format in a directory of results may be removed: whatever is no table, and
/// tables that begin as this writer writes them.
pub(super) fn is_ours(writer: &dyn ResultWriter, path: &Path) -> bool {
    let is_table = path.extension().is_some_and(|kind| kind == "csv");
    !is_table || is_own_table(writer, path)
}

fn holds_summary(directory: &Path) -> bool {
    // The name of the program stands among the first keys of a summary.
    let named = format!("\"program\": \"{PROGRAM}\"");
    head(&directory.join(SUMMARY)).contains(&named)
}

/// The file begins with the header of a table that this writer writes.
fn is_own_table(writer: &dyn ResultWriter, path: &Path) -> bool {
    let head = head(path);
    head.lines()
        .next()
        .is_some_and(|line| writer.is_own_table(line))
}

/// The first few thousand bytes of a file as text; empty for what cannot be read.
fn head(path: &Path) -> String {
    /// Longer than any header and than the first keys of a summary.
    const HEAD: u64 = 16_384;
    let mut head = Vec::new();
    let read = fs::File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    match read {
        Ok(_) => String::from_utf8_lossy(&head).into_owned(),
        Err(_) => String::new(),
    }
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

    /// A run that is killed writes no summary: it is taken up where its tables are known, and they
    /// go where the next run has none of their kind.
    #[test]
    fn tables_of_a_killed_run_are_known_by_their_header() {
        let directory = tempfile::tempdir().unwrap();
        let check = || check_directory(directory.path(), &[]);
        let own = [
            (
                "cycle.csv",
                "crank_angle[deg],eccentricity_x[-],eccentricity_y[-],load_x[N],load_y[N],\
                 minimum_film_thickness[m],peak_film_pressure[Pa],power_loss[W],side_flow[m3/s],new\n0\n",
            ),
            (
                "film.csv",
                "angle[deg],axial[mm],pressure[Pa],film_fraction[-],film_thickness[m]\n",
            ),
            (
                "cases.csv",
                "case,bearing.width[mm],status,power_loss[W],message\n",
            ),
        ];
        for (name, header) in own {
            let path = directory.path().join(name);
            fs::write(&path, header).unwrap();
            assert!(check().is_ok(), "{name}");
            assert!(holds_results(directory.path()), "{name}");
            // A comment, another order or a column less: written by somebody else.
            for foreign in [
                format!("# mine\n{header}"),
                header.replacen(',', ";", 1),
                header.split(',').next().unwrap().to_owned(),
                String::new(),
            ] {
                fs::write(&path, &foreign).unwrap();
                assert!(check().is_err(), "{foreign}");
                assert!(!holds_results(directory.path()), "{foreign}");
            }
            fs::remove_file(&path).unwrap();
        }
    }
}
