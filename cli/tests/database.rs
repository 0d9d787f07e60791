//! `sommerfeld database build | info | lookup | check`, and what users get wrong.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

mod common;

use common::{sommerfeld, summary};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::OnceLock;
use std::time::{Duration, Instant};
use tempfile::TempDir;

const STUDY: &str = "schema = 1\nanalysis = \"database\"\n[database]\nwidth_ratios = 0.4\ntarget = 1e-2\n\
    last_eccentricity = 0.95\nsamples = 100\n[film]\ncavitation = \"reynolds\"\n";

fn run(arguments: &[&str], directory: &Path) -> (i32, String, String) {
    let output = sommerfeld()
        .args(arguments)
        .current_dir(directory)
        .output()
        .unwrap();
    let utf8 = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        output.status.code().unwrap(),
        utf8(output.stdout),
        utf8(output.stderr),
    )
}

/// A directory with `films.toml` and what `database build` made of it.
fn films() -> &'static Path {
    static FILMS: OnceLock<TempDir> = OnceLock::new();
    let directory = FILMS.get_or_init(|| {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("films.toml"), STUDY).unwrap();
        let (code, out, err) = run(
            &["database", "build", "films.toml", "--threads", "2"],
            directory.path(),
        );
        assert_eq!(code, 0, "{out}{err}");
        assert!(
            out.contains("largest error") && err.contains("level"),
            "{out}{err}"
        );
        directory
    });
    directory.path()
}

const TABLE: &str = "films/table.h5";

#[test]
fn what_is_built_is_shown_looked_up_and_checked() {
    let built = summary(&films().join("films"));
    assert_eq!(built["status"], "converged");
    let (code, out, err) = run(&["database", "info", TABLE], films());
    assert_eq!((code, err.as_str()), (0, ""));
    for stored in [
        "closure",
        "reynolds",
        "width_ratios",
        "0.4",
        "last_eccentricity",
        "0.95",
        "seed",
        "samples",
        "error_maximum",
        "error_norm",
        "solver_version",
        "force_across[-]",
        "eccentricity[-]",
    ] {
        assert!(out.contains(stored), "{stored}\n{out}");
    }
    let (code, out, err) = run(
        &[
            "database",
            "check",
            TABLE,
            "--samples",
            "200",
            "--seed",
            "5",
        ],
        films(),
    );
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(
        out.contains("200 of seed 5") && out.contains("kept"),
        "{out}"
    );
    // Other states every time.
    let fresh = || run(&["database", "check", TABLE, "--samples", "3"], films()).1;
    assert_ne!(fresh(), fresh());
}

#[test]
fn a_state_is_looked_up() {
    let state = ["database", "lookup", TABLE, "--eccentricity", "0.8"];
    let (code, out, err) = run(&[&state[..], &["--direction", "-90"]].concat(), films());
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(
        out.contains("force_across") && out.contains("stated error"),
        "{out}"
    );
    let bearing = [
        "--diameter",
        "72 mm",
        "--width",
        "28.8 mm",
        "--clearance",
        "72 um",
        "--viscosity",
        "8 mPa.s",
        "--speed",
        "2000 rpm",
    ];
    let (code, out, err) = run(&[&state[..], &bearing].concat(), films());
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(out.contains("in SI") && out.contains("N s/m"), "{out}");
    fs::write(
        films().join("states.csv"),
        "eccentricity[-],direction[deg]\n0.5,0\n0.5,180\n",
    )
    .unwrap();
    let table = ["database", "lookup", TABLE, "--states", "states.csv"];
    let (code, out, _) = run(&table, films());
    assert_eq!((code, out.lines().count()), (0, 3), "{out}");
    let (code, _, err) = run(&[&table[..], &["--out", "answers.csv"]].concat(), films());
    assert_eq!((code, err.as_str()), (0, ""));
    let written = fs::read_to_string(films().join("answers.csv")).unwrap();
    assert_eq!(written, out);
}

/// What is wrong is named, nothing panics, and the exit status says so.
#[test]
fn nonsense_is_refused_by_name() {
    let directory = films();
    fs::write(directory.join("text.h5"), "not a table").unwrap();
    fs::write(directory.join("empty.h5"), "").unwrap();
    fs::write(
        directory.join("film.toml"),
        "schema = 1\nanalysis = \"film\"\n[film]\ncavitation = \"reynolds\"\n[operation]\n\
         dimensionless = true\nd_over_b = 2.0\nrelative_eccentricity = 0.8\n",
    )
    .unwrap();
    fs::write(
        directory.join("states-bad.csv"),
        "eccentricity[-],direction[deg]\n2,0\n",
    )
    .unwrap();
    let lookup = |rest: &[&'static str]| [&["database", "lookup", TABLE], rest].concat();
    let cases: Vec<(Vec<&str>, &str)> = vec![
        (vec!["database"], "Usage"),
        (vec!["database", "info", "nowhere.h5"], "cannot be read"),
        (vec!["database", "info", "text.h5"], "not a whole HDF5 file"),
        (
            vec!["database", "info", "empty.h5"],
            "not a whole HDF5 file",
        ),
        (vec!["database", "info", "films"], "cannot be read"),
        (
            vec!["database", "check", "text.h5"],
            "not a whole HDF5 file",
        ),
        (
            vec!["database", "check", TABLE, "--samples", "0"],
            "--samples",
        ),
        (vec!["database", "build", "film.toml"], "builds no database"),
        (vec!["database", "build", "nowhere.toml"], "no such file"),
        (lookup(&[]), "--eccentricity"),
        (lookup(&["--eccentricity", "0.5"]), "--direction"),
        (
            lookup(&["--eccentricity", "1", "--direction", "0"]),
            "out of range",
        ),
        (
            lookup(&["--eccentricity", "-0.1", "--direction", "0"]),
            "-0.1",
        ),
        (
            lookup(&["--eccentricity", "nan", "--direction", "0"]),
            "out of range",
        ),
        (
            lookup(&["--eccentricity", "0.5", "--direction", "inf"]),
            "direction",
        ),
        (
            lookup(&[
                "--eccentricity",
                "0.5",
                "--direction",
                "0",
                "--width-ratio",
                "0.9",
            ]),
            "0.9",
        ),
        (
            lookup(&["--eccentricity", "0.5", "--diameter", "72 mm"]),
            "--width",
        ),
        (
            lookup(&[
                "--eccentricity",
                "0.5",
                "--diameter",
                "72",
                "--width",
                "28.8 mm",
                "--clearance",
                "72 um",
                "--viscosity",
                "8 mPa.s",
                "--speed",
                "2000 rpm",
            ]),
            "--diameter \"72\"",
        ),
        (lookup(&["--states", "states-bad.csv"]), "line 2"),
        (lookup(&["--states", "nowhere.csv"]), "nowhere.csv"),
    ];
    for (arguments, expected) in cases {
        let (code, out, err) = run(&arguments, directory);
        assert_eq!(code, 2, "{arguments:?}\n{out}{err}");
        assert!(err.contains(expected), "{arguments:?}: {expected}\n{err}");
        assert!(!err.contains("panicked"), "{err}");
    }
}

/// Ctrl-C leaves a directory that the same command goes on with.
#[cfg(unix)]
#[test]
fn a_build_that_is_interrupted_goes_on() {
    let directory = tempfile::tempdir().unwrap();
    // Fine enough that a signal hits it.
    let study = STUDY
        .replace("target = 1e-2", "target = 1e-4")
        .replace("0.95", "0.999");
    fs::write(directory.path().join("films.toml"), study).unwrap();
    let child = sommerfeld()
        .args(["database", "build", "films.toml"])
        .current_dir(directory.path())
        .stderr(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let unfinished: PathBuf = directory.path().join("films");
    let start = Instant::now();
    while !unfinished.exists() && start.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(300));
    let sent = std::process::Command::new("kill")
        .arg("-INT")
        .arg(child.id().to_string())
        .status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let told = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(130), "{told}");
    assert_eq!(summary(&unfinished)["status"], "not-converged");
    assert!(
        summary(&unfinished)["messages"]
            .to_string()
            .contains("interrupted")
    );
    assert!(unfinished.join("unfinished.h5").exists() && !unfinished.join("table.h5").exists());
}
