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
    for template in sommerfeld_study::templates::TEMPLATES {
        let name = template.name;
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
    assert!(!err.contains("did you mean"), "{err}");
    let (code, _, err) = run(&["new", "bigend", "."]);
    assert_eq!(code, 2);
    assert!(err.contains("did you mean `big-end`?"), "{err}");
}

#[test]
fn help_names_every_template() {
    let (code, out, _) = run(&["new", "--help"]);
    assert_eq!(code, 0);
    for template in sommerfeld_study::templates::TEMPLATES {
        assert!(out.contains(template.name), "{}: {out}", template.name);
    }
}

#[test]
fn new_writes_all_or_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let loads = directory.path().join("loads.csv");
    std::fs::write(&loads, "mine\n").unwrap();
    let (code, _, err) = text(&sommerfeld(&["new", "big-end", "."], directory.path()));
    assert_eq!(code, 2, "{err}");
    assert_eq!(std::fs::read_to_string(&loads).unwrap(), "mine\n");
    assert!(!directory.path().join("big-end.toml").exists());
    // A place that is a file is no directory.
    let (code, _, err) = text(&sommerfeld(&["new", "film", "loads.csv"], directory.path()));
    assert_eq!(code, 3, "{err}");
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
    for nonsense in [
        &["run"][..],
        &["run", "a.toml", "b.toml"],
        &["run", "a.toml", "--out"],
        &["run", "a.toml", "--threads", "0"],
        &["run", "a.toml", "--threads", "-1"],
        &["run", "a.toml", "--threads", "many"],
        &["run", "a.toml", "--threads", "1e9"],
        &["run", "a.toml", "--fast"],
        &["check"],
        &["check", "a.toml", "--out", "b"],
        &["new", "film"],
        &["new"],
        &["explain", "a", "b"],
        &["schema", "1"],
        &["--verbose"],
        &["", ""],
        &["run", ""],
        &["check", ""],
        &["check", "."],
        &["explain", ""],
        &["explain", "[["],
    ] {
        let (code, out, err) = run(nonsense);
        assert_eq!((code, out.as_str()), (2, ""), "{nonsense:?}: {err}");
        assert!(err.starts_with("error: ") || err.contains("Usage"), "{err}");
    }
}

/// Arguments that are no text reach the file system as they are.
#[cfg(unix)]
#[test]
fn names_that_are_no_text_are_refused_politely() {
    use std::os::unix::ffi::OsStrExt;
    let name = std::ffi::OsStr::from_bytes(b"\xff\xfe.toml");
    let output = Command::new(env!("CARGO_BIN_EXE_sommerfeld"))
        .arg("check")
        .arg(name)
        .output()
        .unwrap();
    let (code, _, err) = text(&output);
    assert_eq!(code, 2);
    assert!(err.contains("there is no such file"), "{err}");
}

/// Blanks and letters of any alphabet in paths, and a working directory that is another.
#[test]
fn a_study_is_run_from_anywhere() {
    let directory = tempfile::tempdir().unwrap();
    let place = directory.path().join("m\u{fc}hle 7 \u{65e5}\u{672c}");
    std::fs::create_dir(&place).unwrap();
    let elsewhere = tempfile::tempdir().unwrap();
    let new = ["new", "one-axis-cycle", place.to_str().unwrap()];
    let (code, out, err) = text(&sommerfeld(&new, elsewhere.path()));
    assert_eq!(code, 0, "{err}");
    let file = Path::new(out.trim());
    assert!(file.is_absolute() && file.exists(), "{out}");
    // By its whole path from elsewhere, and by its name from beside it.
    let results = place.join("die Ergebnisse");
    for (file, from) in [
        (file.to_str().unwrap(), elsewhere.path()),
        ("one-axis-cycle.toml", place.as_path()),
    ] {
        let run = ["run", file, "--out", results.to_str().unwrap()];
        let (code, out, err) = text(&sommerfeld(&run, from));
        assert_eq!(code, 0, "{out}{err}");
        assert!(results.join("summary.json").exists());
        std::fs::remove_dir_all(&results).unwrap();
    }
    // Without --out the results lie beside the study.
    let (code, ..) = text(&sommerfeld(
        &["run", file.to_str().unwrap()],
        elsewhere.path(),
    ));
    assert_eq!(code, 0);
    assert!(place.join("one-axis-cycle/cycle.csv").exists());
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
