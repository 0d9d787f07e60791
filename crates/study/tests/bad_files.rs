//! Files that are too large, too odd or too far away to lie among the committed bad inputs; and those
//! that look odd and are fine.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_study::input::{Duty, InputErrors, Study};
use sommerfeld_study::load_study;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::Instant;
use tempfile::TempDir;

const LOADS: &str = "crank_angle[deg],load_x[N],load_y[N]\n0,1000,0\n360,2000,500\n720,1000,0\n";

fn study(load_file: &str) -> String {
    format!(
        "schema = 1\nanalysis = \"load-cycle\"\n\n[bearing]\ndiameter = \"72 mm\"\n\
         width = \"30 mm\"\ndiametral_clearance = \"72 um\"\n\n[oil]\nviscosity = \"8 mPa.s\"\n\n\
         [load_cycle]\nfile = '{load_file}'\nengine_speed = \"2000 rpm\"\n"
    )
}

/// A study and a load table in a directory of their own, given as names and contents.
fn directory(files: &[(&str, &[u8])]) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    for (name, content) in files {
        let path = directory.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }
    directory
}

fn accepted(path: &Path) -> Study {
    load_study(path).unwrap_or_else(|errors| panic!("{errors}"))
}

fn refused(path: &Path) -> InputErrors {
    match load_study(path) {
        Ok(_) => panic!("{} is accepted", path.display()),
        Err(errors) => errors,
    }
}

fn rows(study: &Study) -> usize {
    match &study.bearing_case().unwrap().duty {
        Duty::Cycle(duty) => duty.cycle.points.len(),
        _ => 0,
    }
}

/// One error that says this, told at once.
fn refused_at_once(path: &Path, part: &str) {
    let start = Instant::now();
    let errors = refused(path);
    assert!(start.elapsed().as_secs_f64() < 2.0, "{:?}", start.elapsed());
    assert_eq!(errors.0.len(), 1, "{errors}");
    let text = errors.render(false);
    assert!(text.contains(part), "{text}");
    assert!(text.contains("allowed: at most"), "{text}");
}

/// A file of so many bytes that takes no room on the disk.
fn sparse(path: &Path, bytes: u64) {
    File::create(path).unwrap().set_len(bytes).unwrap();
}

#[test]
fn a_line_of_a_gigabyte_is_refused_unread() {
    let directory = directory(&[("study.toml", study("loads.csv").as_bytes())]);
    let file = directory.path().join("large.toml");
    sparse(&file, 1 << 30);
    refused_at_once(&file, "the file is too large: 1024 MB");
    sparse(&directory.path().join("loads.csv"), 1 << 30);
    refused_at_once(
        &directory.path().join("study.toml"),
        "the load table cannot be used: the file is too large: 1024 MB",
    );
}

/// A device has no length: only the cap ends the reading of one that has no end.
#[cfg(unix)]
#[test]
fn a_file_without_end_is_read_up_to_the_cap() {
    refused_at_once(Path::new("/dev/zero"), "the file is too large");
}

#[test]
fn a_line_within_the_cap_of_the_file_has_a_cap_of_its_own() {
    let mut loads = LOADS.as_bytes().to_vec();
    loads.extend(vec![b'1'; 2 << 20]);
    let directory = directory(&[
        ("study.toml", study("loads.csv").as_bytes()),
        ("loads.csv", &loads),
    ]);
    refused_at_once(
        &directory.path().join("study.toml"),
        "the line is 2048 kB long",
    );
}

#[test]
fn a_table_of_too_many_rows_is_refused() {
    let mut loads = "crank_angle[deg],load_x[N],load_y[N]\n".to_owned();
    for row in 0..400_000 {
        loads += &format!("{},1,0\n", 1e-3 * f64::from(row));
    }
    let directory = directory(&[
        ("study.toml", study("loads.csv").as_bytes()),
        ("loads.csv", loads.as_bytes()),
    ]);
    refused_at_once(
        &directory.path().join("study.toml"),
        "more than 200000 rows",
    );
}

#[test]
fn marks_line_ends_and_blanks_of_other_systems_are_fine() {
    let odd = |text: &str| format!("\u{feff}{}", text.replace('\n', "\r\n"));
    let spaced = odd(&study("loads.csv"))
        .replace("\"72 um\"", "\"72\u{b5}m\"")
        .replace("\"30 mm\"", "\"\t30\u{a0}mm \"")
        .replace("width =", "width\t=\t");
    let loads = odd(LOADS).replace("\n0,1000,0", "\n 0 ,\t1000 , \"0\" ");
    let odd = directory(&[
        ("study.toml", spaced.as_bytes()),
        ("loads.csv", loads.as_bytes()),
    ]);
    let plain = directory(&[
        ("study.toml", study("loads.csv").as_bytes()),
        ("loads.csv", LOADS.as_bytes()),
    ]);
    let read = |directory: &TempDir| accepted(&directory.path().join("study.toml"));
    assert_eq!(read(&odd).subject, read(&plain).subject);
    // The other micro sign, Greek mu.
    let greek = study("loads.csv").replace("72 um", "72 \u{3bc}m");
    fs::write(odd.path().join("study.toml"), greek).unwrap();
    assert_eq!(read(&odd).subject, read(&plain).subject);
}

#[test]
fn a_table_lies_relative_to_its_study() {
    let directory = directory(&[
        ("studies/near.toml", study("loads.csv").as_bytes()),
        (
            "studies/up.toml",
            study("../loads und \u{f6}l/l\u{e4}ste \u{2116}1.csv").as_bytes(),
        ),
        ("studies/loads.csv", LOADS.as_bytes()),
        (
            "loads und \u{f6}l/l\u{e4}ste \u{2116}1.csv",
            LOADS.as_bytes(),
        ),
    ]);
    let studies = directory.path().join("studies");
    assert_eq!(rows(&accepted(&studies.join("near.toml"))), 2);
    assert_eq!(rows(&accepted(&studies.join("up.toml"))), 2);
    // An absolute path is taken as it is.
    let absolute = studies.join("loads.csv");
    let file = directory.path().join("m\u{fc}hle \u{65e5}\u{672c}.toml");
    fs::write(&file, study(&absolute.to_string_lossy())).unwrap();
    let read = accepted(&file);
    assert_eq!(rows(&read), 2);
    assert_eq!(read.files, [file, absolute]);
}

#[test]
fn a_missing_table_says_where_it_was_looked_for() {
    let directory = directory(&[("study.toml", study("sub/loads.csv").as_bytes())]);
    let text = refused(&directory.path().join("study.toml")).render(false);
    let looked: PathBuf = directory.path().join("sub/loads.csv");
    assert!(
        text.contains(&format!("it was looked for at {}", looked.display())),
        "{text}"
    );
}

#[test]
fn messages_stay_on_a_page() {
    let long = "x".repeat(100_000);
    for text in [
        study("loads.csv").replace("72 um", &format!("72 {long}")),
        study("loads.csv").replace("72 um", &"9".repeat(100_000)),
        study("loads.csv").replace("72 um", &format!("\u{2212}{long}")),
        study("loads.csv").replace("width", &long),
        study(&long),
        study("loads.csv") + &format!("{long} = 1\n").repeat(2),
        "[".repeat(100_000),
        "a = [".repeat(100_000),
        format!("{}\n", "a.".repeat(100_000)),
        "= \n".repeat(100_000),
        "[[bearing.groove]]\n".repeat(10_000),
    ] {
        let directory = directory(&[("study.toml", text.as_bytes())]);
        let message = refused(&directory.path().join("study.toml")).render(false);
        assert!(
            message.len() < 12_000 && message.lines().count() < 120,
            "{} bytes: {message:.2000}",
            message.len()
        );
    }
}
