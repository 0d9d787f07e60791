//! The drawing in ARCHITECTURE.md and the house are one: no arrow points back, between crates or
//! between the modules of a crate; no room is missing on either side; no file is a warehouse; no
//! committed file leans on somebody's own machine; no reference lacks its source.
//!
//! Code under `#[cfg(test)]` is exempt from the module order and from the count of lines: a test
//! may look at its module from anywhere.

#![allow(
    clippy::panic,
    clippy::expect_used,
    reason = "a test stops at the first surprise"
)]

mod arrows;
mod drawing;
mod source;

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// Longest source, in lines outside tests.
const LONGEST_SOURCE: usize = 700;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &str) -> String {
    fs::read_to_string(workspace().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Every file below `folder` that is committed or about to be, relative to the workspace.
///
/// Without git (an unpacked archive) every file that is there.
fn files(folder: &str) -> Vec<String> {
    let listed = Command::new("git")
        .args([
            "ls-files",
            "--cached",
            "--others",
            "--exclude-standard",
            folder,
        ])
        .current_dir(workspace())
        .output()
        .ok()
        .filter(|output| output.status.success())
        .map(|output| String::from_utf8_lossy(&output.stdout).into_owned())
        .filter(|text| !text.is_empty());
    let mut found = match listed {
        Some(text) => text.lines().map(str::to_owned).collect(),
        None => walk(&workspace(), folder.trim_end_matches('/')),
    };
    found.retain(|file| workspace().join(file).is_file());
    found.sort();
    found
}

fn walk(root: &Path, folder: &str) -> Vec<String> {
    let Ok(entries) = fs::read_dir(root.join(folder)) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for entry in entries.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = if folder == "." {
            name.clone()
        } else {
            format!("{folder}/{name}")
        };
        if !entry.path().is_dir() {
            found.push(path);
        } else if name != "target" && name != ".git" {
            found.extend(walk(root, &path));
        }
    }
    found
}

/// Crates as drawn, with their folder: libraries under `crates/`, shells beside it.
fn houses() -> Vec<(String, String)> {
    arrows::crates(&read("ARCHITECTURE.md"))
        .expect("ARCHITECTURE.md has a block ```crates")
        .rooms
        .into_iter()
        .filter(|room| !room.planned)
        .map(|room| {
            let folder = if workspace().join("crates").join(&room.name).is_dir() {
                format!("crates/{}", room.name)
            } else {
                room.name.clone()
            };
            (room.name, folder)
        })
        .collect()
}

fn complain(faults: &[String], advice: &str) {
    assert!(faults.is_empty(), "\n{}\n\n{advice}\n", faults.join("\n"));
}

#[test]
fn crates_depend_downwards_only() {
    let drawing = read("ARCHITECTURE.md");
    let manifests: Vec<(String, String)> = files(".")
        .into_iter()
        .filter(|file| file.ends_with("/Cargo.toml"))
        .map(|file| (file.clone(), read(&file)))
        .collect();
    complain(
        &arrows::between_crates(&drawing, &manifests),
        "Dependencies point down the block ```crates of ARCHITECTURE.md, from a later line to an \
         earlier one. Move the code to the lower crate, or change the drawing if it is the drawing \
         that is wrong.",
    );
}

#[test]
fn modules_use_what_stands_below_them_only() {
    let drawing = read("ARCHITECTURE.md");
    let mut faults = Vec::new();
    for (name, folder) in houses() {
        let src = format!("{folder}/src/");
        let sources: Vec<(String, String)> = files(&src)
            .into_iter()
            .filter(|file| file.ends_with(".rs"))
            .map(|file| (file.clone(), read(&file)))
            .collect();
        faults.extend(arrows::inside_crate(&drawing, &name, &src, &sources));
    }
    complain(
        &faults,
        "Modules use only those above them in their crate's block of ARCHITECTURE.md. Pass the \
         value in, move the code down, or change the drawing if it is the drawing that is wrong.",
    );
}

#[test]
fn no_source_is_a_warehouse() {
    let mut faults = Vec::new();
    for (_, folder) in houses() {
        for file in files(&format!("{folder}/src/")) {
            if file.ends_with(".rs") && !arrows::is_test_file(&file) {
                let lines = source::read(&read(&file), &[]).map_or(0, |found| found.lines);
                if lines > LONGEST_SOURCE {
                    faults.push(format!("{file}: {lines} lines outside tests"));
                }
            }
        }
    }
    complain(
        &faults,
        &format!(
            "More than {LONGEST_SOURCE} lines: ask why. Which second question does it answer?"
        ),
    );
}

#[test]
fn nothing_committed_leans_on_one_machine() {
    let mut faults = Vec::new();
    for file in files(".") {
        if file == "Cargo.lock" || file.ends_with(".min.js") {
            continue;
        }
        // binary files hold no text to check
        let Ok(text) = fs::read_to_string(workspace().join(&file)) else {
            continue;
        };
        for (number, found) in arrows::machine_paths(&text) {
            faults.push(format!("{file}:{number}: names {found}"));
        }
    }
    complain(
        &faults,
        "These places do not exist for a user: use a path inside the repository, or a temporary \
         directory asked from the system.",
    );
}

#[test]
fn every_validation_case_states_source_bar_and_reader() {
    let mut faults = Vec::new();
    let committed = files("validation");
    let mut cases: Vec<&str> = committed
        .iter()
        .filter_map(|file| file.split('/').nth(1))
        .filter(|case| *case != "README.md")
        .collect();
    cases.dedup();
    let contents = read("validation/README.md");
    for case in cases {
        let has = |file: &str| committed.contains(&format!("validation/{case}/{file}"));
        let directory = format!("validation/{case}/");
        let has_table = committed
            .iter()
            .any(|file| file.starts_with(&directory) && file.ends_with(".csv"));
        if !has_table || !has("README.md") {
            faults.push(format!("validation/{case}: needs a table and README.md"));
            continue;
        }
        let page = read(&format!("validation/{case}/README.md"));
        for part in ["**Source.**", "**Bar.**", "**Read by**"] {
            if !page.contains(part) {
                faults.push(format!("validation/{case}/README.md: no paragraph {part}"));
            }
        }
        if !contents.contains(&format!("({case})")) {
            faults.push(format!("validation/README.md: does not list {case}"));
        }
    }
    for file in committed.iter().filter(|file| file.ends_with(".csv")) {
        if !read(file).starts_with("# source:") {
            faults.push(format!("{file}:1: does not open with `# source:`"));
        }
    }
    complain(
        &faults,
        "A reference is worth what its source is worth: see CONTRIBUTING.md, Add a validation case.",
    );
}
