//! Studies run by the built command in a directory of their own, and what they leave behind.
#![allow(clippy::unwrap_used, clippy::panic, dead_code, missing_docs)]

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// The root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The command, ready for its arguments.
pub fn sommerfeld() -> Command {
    Command::new(env!("CARGO_BIN_EXE_sommerfeld"))
}

/// What a run printed and left behind.
pub struct Ran {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
    pub results: PathBuf,
    _directory: TempDir,
}

/// Runs a study file of the repository, its results in a directory of their own.
pub fn run(study: &Path) -> Ran {
    run_in(study, tempfile::tempdir().unwrap())
}

/// Runs a study given as text, with a load table beside it.
pub fn run_text(study: &str, loads: &str) -> Ran {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("loads.csv"), loads).unwrap();
    let file = directory.path().join("study.toml");
    fs::write(&file, study).unwrap();
    run_in(&file, directory)
}

fn run_in(study: &Path, directory: TempDir) -> Ran {
    let results = directory.path().join("results");
    let output = sommerfeld()
        .arg("run")
        .arg(study)
        .arg("--out")
        .arg(&results)
        .output()
        .unwrap();
    Ran {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
        results,
        _directory: directory,
    }
}

impl Ran {
    /// The results of a run that must have converged.
    pub fn converged(self) -> Self {
        assert_eq!(self.code, Some(0), "{}\n{}", self.out, self.err);
        assert_eq!(self.summary()["status"], "converged");
        self
    }

    pub fn summary(&self) -> Value {
        summary(&self.results)
    }

    pub fn report(&self) -> String {
        fs::read_to_string(self.results.join("report.html")).unwrap()
    }

    pub fn cycle(&self) -> Table {
        Table::read(&self.results.join("cycle.csv"))
    }
}

/// The summary in a directory of results.
pub fn summary(results: &Path) -> Value {
    let text = fs::read_to_string(results.join("summary.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// A finite number of a summary; a list of them is taken element by element.
pub fn number(summary: &Value, key: &str) -> f64 {
    match summary[key].as_f64() {
        Some(value) => value,
        None => panic!("{key} is {}", summary[key]),
    }
}

/// A table with a header; lines that begin with `#` are comments.
pub struct Table {
    pub header: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        let mut lines = text
            .lines()
            .filter(|line| !line.starts_with('#') && !line.is_empty())
            .map(fields);
        Self {
            header: lines.next().unwrap(),
            rows: lines.collect(),
        }
    }

    /// A column as text.
    pub fn words(&self, name: &str) -> Vec<&str> {
        let found = self.header.iter().position(|column| column == name);
        let Some(index) = found else {
            panic!("no column {name} in {:?}", self.header)
        };
        self.rows.iter().map(|row| row[index].as_str()).collect()
    }

    /// A column of finite numbers.
    pub fn numbers(&self, name: &str) -> Vec<f64> {
        let parse = |word: &str| word.parse::<f64>().ok().filter(|value| value.is_finite());
        self.words(name)
            .into_iter()
            .map(|word| parse(word).unwrap_or_else(|| panic!("{name}: {word}")))
            .collect()
    }
}

/// The fields of a line; commas in quotes are part of a field.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            c => fields.last_mut().unwrap().push(c),
        }
    }
    fields
}

/// The value in a table of quantity, value, unit and bar.
pub fn reference(case: &str, quantity: &str) -> f64 {
    let table = Table::read(&root().join("validation").join(case).join("reference.csv"));
    let row = table.rows.iter().find(|row| row[0] == quantity).unwrap();
    row[1].parse().unwrap()
}
