//! What each command prints and how it ends.
#![allow(clippy::unwrap_used, missing_docs)]

use std::path::Path;
use std::process::{Command, Output};

fn sommerfeld(arguments: &[&str], directory: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_sommerfeld"))
        .args(arguments)
        .current_dir(directory)
        .output()
        .unwrap()
}

fn run(arguments: &[&str]) -> (i32, String, String) {
    let directory = tempfile::tempdir().unwrap();
    text(&sommerfeld(arguments, directory.path()))
}

fn text(output: &Output) -> (i32, String, String) {
    let utf8 = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (
        output.status.code().unwrap(),
        utf8(&output.stdout),
        utf8(&output.stderr),
    )
}

#[test]
fn every_template_is_written_and_accepted() {
    let directory = tempfile::tempdir().unwrap();
    for name in [
        "big-end",
        "main-bearing",
        "one-axis-cycle",
        "film",
        "dimensionless",
    ] {
        let (code, out, err) = text(&sommerfeld(&["new", name, "studies"], directory.path()));
        assert_eq!((code, err.as_str()), (0, ""), "{name}");
        let (code, out, err) = text(&sommerfeld(&["check", out.trim()], directory.path()));
        assert_eq!((code, err.as_str()), (0, ""), "{name}");
        assert!(out.contains("a valid study"), "{out}");
    }
}

#[test]
fn new_does_not_overwrite() {
    let directory = tempfile::tempdir().unwrap();
    assert_eq!(
        text(&sommerfeld(&["new", "film", "."], directory.path())).0,
        0
    );
    let (code, _, err) = text(&sommerfeld(&["new", "film", "."], directory.path()));
    assert_eq!(code, 2);
    assert!(err.contains("is already there"), "{err}");
}

#[test]
fn an_unknown_template_lists_the_known() {
    let (code, _, err) = run(&["new", "gearbox", "."]);
    assert_eq!(code, 2);
    assert!(err.contains("one-axis-cycle"), "{err}");
}

#[test]
fn a_bad_study_is_refused_on_standard_error() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(
        directory.path().join("a.toml"),
        "schema = 1\nanalysis = \"filn\"\n",
    )
    .unwrap();
    let (code, out, err) = text(&sommerfeld(&["check", "a.toml"], directory.path()));
    assert_eq!((code, out.as_str()), (2, ""));
    assert!(
        err.contains("--> a.toml:2:12") && err.contains("did you mean \"film\"?"),
        "{err}"
    );
    assert!(!err.contains('\u{1b}'), "colours in a file: {err}");
}

#[test]
fn a_file_that_is_not_there_is_refused() {
    let (code, _, err) = run(&["check", "nowhere.toml"]);
    assert_eq!(code, 2);
    assert!(err.contains("there is no such file"), "{err}");
}

#[test]
fn bad_arguments_are_refused() {
    assert_eq!(run(&[]).0, 2);
    assert_eq!(run(&["chekc", "a.toml"]).0, 2);
    assert_eq!(run(&["--version"]).0, 0);
    assert_eq!(run(&["--help"]).0, 0);
}

#[test]
fn keys_are_explained() {
    let (code, out, _) = run(&["explain", "bearing.diametral_clearance"]);
    assert_eq!(code, 0);
    assert!(
        out.contains("twice the radial clearance") && out.contains("um"),
        "{out}"
    );
    let (code, out, _) = run(&["explain"]);
    assert_eq!(code, 0);
    assert!(out.lines().count() > 60);
    let (code, _, err) = run(&["explain", "bearing.diametr"]);
    assert_eq!(code, 2);
    assert!(err.contains("bearing.diameter"), "{err}");
}

#[test]
fn the_schema_is_json() {
    let (code, out, _) = run(&["schema"]);
    assert_eq!(code, 0);
    let schema: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
}
