//! Runs of engines as users run them: no way of ending one loses or repeats a finished calculation, and
//! what it cannot do is said before anything is computed.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

mod common;

use common::{Table, sommerfeld, summary};
use rusqlite::Connection;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const SPEEDS: usize = 20;
/// Two mains and a big end at each speed.
const ORBITS: usize = 3 * SPEEDS;

/// A single-cylinder engine with films in closed form: some hundredths of a second an orbit.
const ENGINE: &str = r#"
schema = 1
title = "Twenty speeds"
analysis = "engine"

[engine]
layout = "inline"
cylinders = 1
cylinder_spacing = "100 mm"
bore = "86 mm"
stroke = "86 mm"
rod_length = "145 mm"
piston_mass = "0.45 kg"
rod_mass = "0.58 kg"
rod_centre_of_gravity = "42 mm"
rod_inertia = "2.6e-3 kg.m2"
speed = [SPEEDS]

[engine.combustion]
compression_ratio = 10.5
heat = "1.45 kJ"

[[engine.combustion.burning]]
start = "-15 deg"
duration = "60 deg"

[[bearing]]
of = "main"
diameter = "54 mm"
width = "24 mm"
diametral_clearance = "42 um"

[[bearing]]
of = "big-end"
diameter = "48 mm"
width = "22 mm"
diametral_clearance = "38 um"

[oil]
viscosity = "8 mPa.s"

[film]
model = "short-bearing"
cavitation = "gumbel"

[orbit]
crank_step = "4 deg"

[limits]
minimum_film_thickness = { value = "1 um", source = "test" }
"#;

struct Desk {
    directory: TempDir,
}

impl Desk {
    fn new() -> Self {
        let speeds: Vec<String> = (0..SPEEDS)
            .map(|at| format!("\"{} rpm\"", 1000 + 150 * at))
            .collect();
        let desk = Self {
            directory: tempfile::tempdir().unwrap(),
        };
        let text = ENGINE.replace("SPEEDS", &speeds.join(", "));
        fs::write(desk.path("engine.toml"), text).unwrap();
        desk
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn start(&self, out: &str, arguments: &[&str]) -> Child {
        sommerfeld()
            .arg("run")
            .arg(self.path("engine.toml"))
            .arg("--out")
            .arg(self.path(out))
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap()
    }

    fn run(&self, out: &str, arguments: &[&str]) -> (Option<i32>, String) {
        let output = self.start(out, arguments).wait_with_output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        let both = text(output.stdout) + &text(output.stderr);
        (output.status.code(), both)
    }
}

/// A finished calculation in the ledger: its number, how often it was started, what it found.
type Found = (i64, i64, Vec<u8>);

fn found(directory: &Path) -> Vec<Found> {
    let path = directory.join("ledger.sqlite");
    if !path.exists() {
        return Vec::new();
    }
    let ledger = Connection::open(path).unwrap();
    let query = "SELECT findings.number, cases.starts, findings.content
                 FROM findings JOIN cases ON cases.number = findings.number ORDER BY 1";
    // Killed before its tables were there.
    let Ok(mut statement) = ledger.prepare(query) else {
        return Vec::new();
    };
    let rows = statement
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))
        .unwrap();
    rows.map(Result::unwrap).collect()
}

/// Tables and summary of a directory and of those in it, without the wall time.
fn tables(directory: &Path) -> BTreeMap<String, String> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            let inner = tables(&path).into_iter();
            all.extend(inner.map(|(inner, content)| (format!("{name}/{inner}"), content)));
        } else if name == "summary.json" {
            let mut summary = summary(directory);
            summary["wall_time_s"] = 0.into();
            all.insert(name, summary.to_string());
        } else if name.ends_with(".csv") {
            all.insert(name, fs::read_to_string(&path).unwrap());
        } else {
            // What else lies there is named; nothing half written, no ledger.
            all.insert(name, String::new());
        }
    }
    all
}

/// A number of the next bits of a seeded sequence (xorshift), from 0 to 1.
fn random(state: &mut u64) -> f64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

/// When a run is killed: with so many orbits recorded, or so long after its start.
enum Kill {
    Orbits(usize),
    After(Duration),
}

/// Runs until it is killed, or ends before; the way it ended tells which.
fn run_until(mut child: Child, kill: &Kill, results: &Path) -> Option<i32> {
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status.code();
        }
        let due = match kill {
            Kill::Orbits(count) => recorded(results) >= *count,
            Kill::After(time) => start.elapsed() >= *time,
        };
        if due {
            child.kill().unwrap();
            return child.wait().unwrap().code();
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// How many orbits a run at work has recorded, by a copy of its ledger: who opens the ledger itself makes files
/// beside it, even while the run takes it away.
fn recorded(results: &Path) -> usize {
    let copy = tempfile::tempdir().unwrap();
    for name in ["ledger.sqlite", "ledger.sqlite-wal"] {
        // Without its log the ledger is being made or taken away.
        if fs::copy(results.join(name), copy.path().join(name)).is_err() {
            return 0;
        }
    }
    let count = Connection::open(copy.path().join("ledger.sqlite"))
        .and_then(|ledger| ledger.query_row("SELECT count(*) FROM findings", [], |row| row.get(0)));
    count.unwrap_or(0)
}

#[test]
fn killed_at_any_time_an_engine_is_taken_up_where_it_stood() {
    let desk = Desk::new();
    let mut uninterrupted = None;
    let mut seed = 0x2012_0007_u64;
    for threads in ["1", "2"] {
        let arguments = ["--threads", threads];
        let start = Instant::now();
        let whole = format!("whole-{threads}");
        let (code, text) = desk.run(&whole, &arguments);
        let duration = start.elapsed();
        assert_eq!(code, Some(0), "{text}");
        assert!(text.contains("60 orbits at 20 speeds"), "{text}");
        let told = text.lines().find(|line| line.starts_with(" 50 %"));
        assert!(told.unwrap().ends_with(" left"), "{text}");
        let whole = tables(&desk.path(&whole));
        // Bit by bit the same on other threads.
        let expected = uninterrupted.get_or_insert_with(|| whole.clone());
        assert!(*expected == whole);

        let out = format!("killed-{threads}");
        let results = desk.path(&out);
        let mut known: Vec<Found> = Vec::new();
        let (mut kills, mut kills_amid) = (0, 0);
        let ended = (0..60).find_map(|_| {
            // Amid the orbits at first; then at any time, files being written among them.
            let kill = if kills < 6 {
                let ahead = (ORBITS - known.len()).max(2) as f64;
                Kill::Orbits(known.len() + 1 + (0.5 * ahead * random(&mut seed)) as usize)
            } else {
                Kill::After(duration.mul_f64(0.02 + 1.5 * random(&mut seed)))
            };
            let code = run_until(desk.start(&out, &arguments), &kill, &results);
            if code.is_some() {
                return code;
            }
            kills += 1;
            let now = found(&results);
            // Killed after its last file, it has left no ledger, and the next one begins anew.
            if now.is_empty() && results.join("summary.json").exists() {
                known.clear();
            }
            for case in &known {
                assert!(
                    now.contains(case),
                    "calculation {} was lost or repeated",
                    case.0
                );
            }
            kills_amid += usize::from(now.len() < ORBITS && now.len() > known.len());
            known = now;
            None
        });
        assert_eq!(ended, Some(0));
        assert!(
            kills_amid >= 2,
            "{kills_amid} of {kills} kills hit orbits at work"
        );
        let found = tables(&results);
        assert!(found.keys().eq(expected.keys()), "{:?}", found.keys());
        for (name, content) in &found {
            assert!(*content == expected[name], "{name} differs");
        }
        every_bearing_once(&results);
    }
}

/// Each speed and bearing has one row, its limit judged, in the table as in the summary.
fn every_bearing_once(results: &Path) {
    let table = Table::read(&results.join("bearings.csv"));
    let (names, verdicts) = (
        table.words("bearing"),
        table.words("limit_minimum_film_thickness"),
    );
    let speeds = table.words("speed[rpm]");
    let rows: BTreeSet<(&str, &str)> = speeds.iter().copied().zip(names.iter().copied()).collect();
    assert_eq!((rows.len(), names.len()), (ORBITS, ORBITS));
    let summary = summary(results);
    let judged: Vec<(&str, &str)> = summary["speeds"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|speed| speed["bearings"].as_array().unwrap())
        .map(|bearing| {
            let verdict = match bearing["limits"][0]["verdict"].as_str().unwrap() {
                "ok" => "OK",
                other => other,
            };
            (bearing["name"].as_str().unwrap(), verdict)
        })
        .collect();
    let expected: Vec<(&str, &str)> = names.into_iter().zip(verdicts).collect();
    assert_eq!(judged, expected);
    assert!(
        expected
            .iter()
            .all(|(_, verdict)| ["OK", "exceeded"].contains(verdict))
    );
}

#[test]
fn error_bars_of_a_machine_are_refused_by_name() {
    let desk = Desk::new();
    let (code, text) = desk.run("out", &["--verify"]);
    assert_eq!(code, Some(2), "{text}");
    for part in ["--verify", "engine", "loads-<name>.csv", "load-cycle"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(!desk.path("out").exists());
    let study = fs::read_to_string(desk.path("engine.toml")).unwrap();
    let field = "cavitation = \"reynolds\"\nrelative_error_target = 1e-2\n";
    let form = "model = \"short-bearing\"\ncavitation = \"gumbel\"\n";
    for (before, after) in [
        (form, field),
        (
            "cavitation = \"gumbel\"\n",
            "cavitation = \"gumbel\"\nrelative_error_target = 1e-2\n",
        ),
    ] {
        assert!(study.contains(before));
        fs::write(desk.path("engine.toml"), study.replace(before, after)).unwrap();
        let (code, text) = desk.run("out", &[]);
        assert_eq!(code, Some(2), "{text}");
        for part in ["relative_error_target", "loads-<name>.csv", "load-cycle"] {
            assert!(text.contains(part), "{part}: {text}");
        }
        assert!(!desk.path("out").exists());
    }
}
