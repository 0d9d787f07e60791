//! Each bad input is refused with exactly the message in the `.expected` file beside it.
//!
//! `UPDATE_EXPECTED=1 cargo test -p sommerfeld-study --test bad_inputs` writes the messages anew;
//! read the difference before you commit it.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stderr, missing_docs)]

use sommerfeld_study::load_study;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// The bad studies, relative to the crate so that messages do not depend on the machine.
fn studies() -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = fs::read_dir("tests/bad_inputs")
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "toml")
        })
        .collect();
    found.sort();
    found
}

fn message(path: &Path) -> String {
    match load_study(path) {
        Ok(_) => "accepted\n".to_owned(),
        // Windows writes paths with backslashes.
        Err(errors) => errors.render(false).replace('\\', "/"),
    }
}

/// Lines that differ, expected with `-`, found with `+`.
fn difference(expected: &str, found: &str) -> String {
    let (mut left, mut right) = (expected.lines(), found.lines());
    let mut text = String::new();
    loop {
        match (left.next(), right.next()) {
            (None, None) => return text,
            (a, b) if a == b => writeln!(text, "  {}", a.unwrap_or_default()).unwrap(),
            (a, b) => {
                a.into_iter()
                    .for_each(|line| writeln!(text, "- {line}").unwrap());
                b.into_iter()
                    .for_each(|line| writeln!(text, "+ {line}").unwrap());
            }
        }
    }
}

#[test]
fn every_bad_input_has_its_exact_message() {
    let update = std::env::var_os("UPDATE_EXPECTED").is_some();
    let mut failed = Vec::new();
    let studies = studies();
    assert!(studies.len() >= 70);
    for study in &studies {
        let found = message(study);
        let expected_file = study.with_extension("expected");
        if found == "accepted\n" {
            failed.push(format!("{} is accepted", study.display()));
            continue;
        }
        if update {
            fs::write(&expected_file, &found).unwrap();
        }
        let expected = fs::read_to_string(&expected_file)
            .unwrap_or_default()
            .replace('\r', "");
        if found != expected {
            failed.push(format!(
                "{}\n{}",
                study.display(),
                difference(&expected, &found)
            ));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
