//! Files to text: caps on their size, encodings, and what else a path may turn out to be.

use super::check;
use super::error::{InputError, InputErrors, Place};
use super::study::Study;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// Largest study file, bytes: far above any written by hand.
pub(super) const STUDY_CAP: u64 = 1 << 20;
/// Largest load table, bytes.
pub(super) const TABLE_CAP: u64 = 64 << 20;

/// Reads and checks a study file and the files it names, which lie relative to it.
///
/// # Errors
/// Everything that is wrong with it, in the order of the file.
pub fn load_study(path: &Path) -> Result<Study, InputErrors> {
    let text = read_text(path, STUDY_CAP)?;
    let directory = path.parent().unwrap_or(Path::new(""));
    study_from_text(&path.to_string_lossy(), &text, directory)
}

/// Checks the text of a study. `file` names it in messages; `directory` holds the files it names.
///
/// # Errors
/// As [`load_study`].
pub fn study_from_text(file: &str, text: &str, directory: &Path) -> Result<Study, InputErrors> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(InputError::new(file, "the study file is empty")
            .hinting("`sommerfeld new TEMPLATE DIR` writes one to start from")
            .into());
    }
    check::study(file, text, directory)
}

/// Reads a text file of at most `cap` bytes; of a longer one no more than that is ever held.
pub(super) fn read_text(path: &Path, cap: u64) -> Result<String, Box<InputError>> {
    let name = path.to_string_lossy();
    let refuse = |message: String| Box::new(InputError::new(&name, message));
    let too_large = |message: String| {
        let error = InputError::new(&name, message).allowing(format!("at most {} MB", cap >> 20));
        Box::new(error.hinting("is this the right file?"))
    };
    let metadata = std::fs::metadata(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => refuse("there is no such file".into()),
        ErrorKind::PermissionDenied => refuse("the file may not be read: permission denied".into()),
        _ => refuse(format!("the file cannot be read: {error}")),
    })?;
    if metadata.is_dir() {
        return Err(refuse("this is a directory, not a file".into()));
    }
    if metadata.len() > cap {
        let size = metadata.len() >> 20;
        return Err(too_large(format!("the file is too large: {size} MB")));
    }
    // A pipe or device has no length, and a file may grow: read up to the cap and see.
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(cap + 1).read_to_end(&mut bytes))
        .map_err(|error| refuse(format!("the file cannot be read: {error}")))?;
    if bytes.len() as u64 > cap {
        return Err(too_large("the file is too large".into()));
    }
    decode(&name, bytes)
}

/// UTF-8 text without a byte order mark.
fn decode(name: &str, bytes: Vec<u8>) -> Result<String, Box<InputError>> {
    if let Some((message, hint)) = foreign_format(&bytes) {
        return Err(InputError::new(name, message).hinting(hint).into());
    }
    match String::from_utf8(bytes) {
        Ok(text) => Ok(match text.strip_prefix('\u{feff}') {
            Some(rest) => rest.to_owned(),
            None => text,
        }),
        Err(error) => {
            let valid = error.utf8_error().valid_up_to();
            let good = String::from_utf8_lossy(&error.as_bytes()[..valid]).into_owned();
            Err(
                InputError::new(name, "the file is not UTF-8 text from here on")
                    .at(Place::of_span(&good, valid..valid))
                    .hinting("save it as UTF-8")
                    .into(),
            )
        }
    }
}

/// What the bytes are, where they are not text of one byte a letter, and what to do.
fn foreign_format(bytes: &[u8]) -> Option<(String, &'static str)> {
    if bytes.starts_with(b"PK\x03\x04") {
        return Some((
            "this is a ZIP archive, as spreadsheets (.xlsx, .ods) are".to_owned(),
            "export the table as CSV in UTF-8",
        ));
    }
    let has_mark = bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]);
    // Without its mark, UTF-16 of Western text has every other byte zero.
    let alternates = matches!(bytes, [0, a, 0, b, ..] | [a, 0, b, 0, ..] if *a != 0 && *b != 0);
    if has_mark || alternates {
        return Some(("the file is UTF-16 text".to_owned(), "save it as UTF-8"));
    }
    let zero = bytes.iter().position(|&byte| byte == 0)?;
    Some((
        format!("this is a binary file, no text: byte {zero} is zero"),
        "is this the right file?",
    ))
}
