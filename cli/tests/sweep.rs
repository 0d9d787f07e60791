//! Sweeps as users run them: what varies arrives, results do not depend on threads, and no way of
//! ending a run loses or repeats a finished case.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

mod common;

use common::{Table, number, sommerfeld, summary};
use rusqlite::Connection;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A bearing of a few milliseconds a case.
const BASE: &str = "schema = 1\nanalysis = \"equilibrium\"\n[bearing]\ndiameter = \"100 mm\"\n\
    width = \"50 mm\"\ndiametral_clearance = \"110 um\"\n[[bearing.groove]]\nkind = \"axial\"\n\
    angle = \"180 deg\"\nlength = \"12 mm\"\nwidth = \"40 mm\"\npressure = \"2.5 bar\"\n[oil]\n\
    viscosity = \"10 mPa.s\"\ntemperature = \"80 degC\"\n[film]\ngrid = [32, 8]\n[operation]\n\
    speed = \"3000 rpm\"\nload = [\"0 N\", \"-30 kN\"]\n[limits]\n\
    minimum_film_thickness = { value = \"2 um\", source = \"test\" }\n";

/// A directory with a base study and a sweep over it.
struct Desk {
    directory: TempDir,
}

impl Desk {
    fn new(base: &str, sweep: &str) -> Self {
        let desk = Self {
            directory: tempfile::tempdir().unwrap(),
        };
        fs::write(desk.path("base.toml"), base).unwrap();
        desk.set(sweep);
        desk
    }

    /// Writes the sweep anew.
    fn set(&self, sweep: &str) {
        let head =
            "schema = 1\ntitle = \"Test\"\nanalysis = \"sweep\"\n[sweep]\nbase = \"base.toml\"\n";
        fs::write(self.path("sweep.toml"), format!("{head}{sweep}")).unwrap();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn start(&self, out: &str, threads: &str) -> Child {
        sommerfeld()
            .arg("run")
            .arg(self.path("sweep.toml"))
            .arg("--out")
            .arg(self.path(out))
            .args(["--threads", threads])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap()
    }

    fn run(&self, out: &str, threads: &str) -> (Option<i32>, String) {
        told(&self.start(out, threads).wait_with_output().unwrap())
    }

    fn cases(&self, out: &str) -> Vec<u8> {
        fs::read(self.path(out).join("cases.csv")).unwrap()
    }
}

fn told(output: &Output) -> (Option<i32>, String) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    let both = text(&output.stdout) + &text(&output.stderr);
    (output.status.code(), both)
}

/// A finished case in the ledger: number, starts, starts when it was finished, summary.
type Finished = (i64, i64, i64, String);

fn finished(directory: &Path) -> Vec<Finished> {
    let Ok(ledger) = Connection::open(directory.join("ledger.sqlite")) else {
        return Vec::new();
    };
    let query = "SELECT number, starts, starts_when_finished, summary FROM cases
                 WHERE status IS NOT NULL ORDER BY number";
    // Killed before its tables were there.
    let Ok(mut statement) = ledger.prepare(query) else {
        return Vec::new();
    };
    let rows = statement
        .query_map([], |row| {
            Ok((row.get(0)?, row.get(1)?, row.get(2)?, row.get(3)?))
        })
        .unwrap();
    rows.map(Result::unwrap).collect()
}

/// A number of the next bits of a seeded sequence (xorshift), from 0 to 1.
fn random(state: &mut u64) -> f64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

#[test]
fn killed_at_any_time_a_sweep_is_taken_up_where_it_stood() {
    // Cases that take long enough for a kill to hit them.
    let desk = Desk::new(
        &BASE.replace("[32, 8]", "[48, 12]"),
        "[sweep.vary]\n\"operation.speed\" = { from = \"1000 rpm\", to = \"4000 rpm\", count = 12 }\n\
         \"bearing.diametral_clearance\" = { from = \"80 um\", to = \"140 um\", count = 10 }\n",
    );
    let start = Instant::now();
    let (code, text) = desk.run("whole", "1");
    let whole = start.elapsed();
    assert_eq!(code, Some(0), "{text}");
    // Bit by bit the same on two threads.
    assert_eq!(desk.run("two", "2").0, Some(0));
    assert!(desk.cases("whole") == desk.cases("two"));

    let results = desk.path("killed");
    let mut seed = 0x2012_0006_u64;
    let mut known: Vec<Finished> = Vec::new();
    let mut kills_amid = 0;
    for _ in 0..8 {
        let mut child = desk.start("killed", "2");
        std::thread::sleep(whole.mul_f64(0.02 + 0.2 * random(&mut seed)));
        child.kill().unwrap();
        child.wait().unwrap();
        let now = finished(&results);
        // What was recorded stays as it was, and was not computed again.
        for case in &known {
            assert!(now.contains(case), "case {} was lost or repeated", case.0);
        }
        kills_amid += usize::from(!now.is_empty() && now.len() < 120 && now.len() > known.len());
        known = now;
    }
    assert!(kills_amid >= 2, "{kills_amid} kills hit a sweep at work");
    let (code, text) = desk.run("killed", "2");
    assert_eq!(code, Some(0), "{text}");
    assert!(
        known.is_empty() || text.contains("were found done"),
        "{text}"
    );
    let now = finished(&results);
    let numbers: Vec<i64> = now.iter().map(|case| case.0).collect();
    assert_eq!(numbers, (1..=120).collect::<Vec<i64>>());
    for (number, starts, starts_when_finished, _) in &now {
        assert_eq!(starts, starts_when_finished, "case {number} ran again");
        assert!(*starts >= 1);
    }
    assert!(known.iter().all(|case| now.contains(case)));
    assert!(desk.cases("killed") == desk.cases("whole"));
    // Done is done: another run computes nothing.
    let (code, text) = desk.run("killed", "1");
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("120 of 120 cases were found done"), "{text}");
    assert_eq!(finished(&results), now);
    assert!(desk.cases("killed") == desk.cases("whole"));
}

#[cfg(unix)]
#[test]
fn interrupted_and_locked() {
    let slow = BASE.replace("[32, 8]", "[128, 32]");
    let desk = Desk::new(
        &slow,
        "vary = { \"operation.speed\" = { from = \"1000 rpm\", to = \"4000 rpm\", count = 60 } }\n",
    );
    let child = desk.start("out", "1");
    // At work as soon as it has finished a case.
    let deadline = Instant::now() + Duration::from_secs(120);
    while !desk.path("out/cases/0001/summary.json").exists() {
        assert!(
            Instant::now() < deadline,
            "no case was finished in two minutes"
        );
        std::thread::sleep(Duration::from_millis(20));
    }
    let (code, text) = desk.run("out", "1");
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("another run is at work in"), "{text}");
    assert!(text.contains(&format!("process {}", child.id())), "{text}");

    let sent = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success());
    let (code, text) = told(&child.wait_with_output().unwrap());
    assert_eq!(code, Some(130), "{text}");
    let stopped = summary(&desk.path("out"));
    assert!(
        stopped["messages"][0]
            .as_str()
            .unwrap()
            .starts_with("interrupted")
    );
    let (missing, done) = (number(&stopped, "not_run"), number(&stopped, "converged"));
    assert!(
        missing > 0.0 && done > 0.0 && missing + done == 60.0,
        "{missing} {done}"
    );
    let table = Table::read(&desk.path("out/cases.csv"));
    let waiting = table
        .words("status")
        .iter()
        .filter(|word| **word == "not-run")
        .count();
    assert_eq!(waiting as f64, missing);
    let before = finished(&desk.path("out"));
    assert_eq!(before.len() as f64, done);
    let (code, text) = desk.run("out", "2");
    assert_eq!(code, Some(0), "{text}");
    let after = finished(&desk.path("out"));
    assert_eq!(after.len(), 60);
    assert!(before.iter().all(|case| after.contains(case)));
    assert_eq!(number(&summary(&desk.path("out")), "not_run"), 0.0);
}

#[test]
fn a_directory_of_another_sweep_is_refused() {
    let vary = "vary = { \"operation.speed\" = [\"1000 rpm\", \"2000 rpm\"] }\n";
    let desk = Desk::new(BASE, vary);
    assert_eq!(desk.run("out", "1").0, Some(0));
    let table = desk.cases("out");
    let refused = |expected: &str| {
        let (code, text) = desk.run("out", "1");
        assert_eq!(code, Some(2), "{text}");
        assert!(
            text.contains("holds the results of another study, \"Test\""),
            "{text}"
        );
        assert!(text.contains(expected), "{text}");
        assert!(text.contains("--out"), "{text}");
        assert!(desk.cases("out") == table);
    };
    desk.set(&vary.replace("2000", "2500"));
    refused("`operation.speed` differs: `1000 rpm, 2000 rpm` there, `1000 rpm, 2500 rpm` here");
    desk.set(vary);
    fs::write(desk.path("base.toml"), BASE.replace("110 um", "111 um")).unwrap();
    refused("the base study differs in line 6: `diametral_clearance = \"110 um\"` there");
    fs::write(desk.path("base.toml"), BASE).unwrap();

    fs::write(desk.path("out/ledger.sqlite"), "no ledger at all").unwrap();
    let (code, text) = desk.run("out", "1");
    assert_eq!(code, Some(3), "{text}");
    assert!(
        text.contains("cannot be trusted") && text.contains("hint: move it away"),
        "{text}"
    );
}

/// A case that fails is named everywhere, and the others go on.
#[test]
fn failed_cases_are_named() {
    let unfed = BASE.split("[[bearing.groove]]").next().unwrap().to_owned()
        + "[oil]\n"
        + BASE.split("[oil]\n").nth(1).unwrap();
    let desk = Desk::new(
        &unfed,
        "vary = { \"film.cavitation\" = [\"reynolds\", \"mass-conserving\"], \
         \"operation.speed\" = [\"2000 rpm\", \"3000 rpm\"] }\n",
    );
    for _ in 0..2 {
        let (code, text) = desk.run("out", "2");
        assert_eq!(code, Some(1), "{text}");
        let named =
            "case 3 (film.cavitation = mass-conserving, operation.speed = 2000 rpm): starved";
        assert!(text.contains(named), "{text}");
        let found = summary(&desk.path("out"));
        assert_eq!(found["status"], "not-converged");
        for (key, expected) in [("cases", 4.0), ("converged", 2.0), ("failed", 2.0)] {
            assert_eq!(number(&found, key), expected, "{key}");
        }
        assert_eq!(found["cases_not_converged"][1]["case"], 4);
        assert_eq!(
            found["cases_not_converged"][1]["inputs"]["operation.speed"],
            "3000 rpm"
        );
        assert!(found["messages"][0].as_str().unwrap().starts_with(named));
        let report = fs::read_to_string(desk.path("out/report.html")).unwrap();
        assert!(report.contains("Not every case converged") && report.contains(named));
    }
    let table = String::from_utf8(desk.cases("out")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert!(rows[0].starts_with("case,film.cavitation,operation.speed[rpm],status,"));
    assert!(
        rows[1].starts_with("1,reynolds,2000.0,converged,"),
        "{}",
        rows[1]
    );
    assert!(
        rows[3].starts_with("3,mass-conserving,2000.0,starved,nan,"),
        "{}",
        rows[3]
    );
    assert!(rows[3].contains("give a groove or hole"), "{}", rows[3]);
    let verdicts = Table::read(&desk.path("out/cases.csv"));
    assert_eq!(verdicts.rows[0][verdicts.header.len() - 2], "OK");
    assert_eq!(
        verdicts.header[verdicts.header.len() - 2],
        "limit_minimum_film_thickness"
    );
}

/// Whatever varies: a case is the study with that value in it, to the last bit.
#[test]
fn a_case_is_the_study_with_its_values() {
    let fed = BASE.replace(
        "[oil]\n",
        "[[bearing.groove]]\nkind = \"hole\"\nangle = \"100 deg\"\ndiameter = \"7 mm\"\npressure = \"3 bar\"\n[oil]\n",
    );
    let law = "{ law = \"vogel\", a = \"0.06 mPa.s\", b = \"1000 K\", c = \"-163 K\" }";
    let varied = [
        (
            "bearing.width",
            "\"40 mm\"",
            "width = \"50 mm\"",
            "width = \"40 mm\"",
        ),
        (
            "oil.viscosity",
            law,
            "viscosity = \"10 mPa.s\"",
            &format!("viscosity = {law}"),
        ),
        ("film.grid", "[24, 6]", "[32, 8]", "[24, 6]"),
        (
            "bearing.groove[1].pressure",
            "\"9 bar\"",
            "\"3 bar\"",
            "\"9 bar\"",
        ),
        (
            "operation.load[1]",
            "\"-20 kN\"",
            "\"-30 kN\"",
            "\"-20 kN\"",
        ),
        (
            "operation.tilt",
            "[\"0 rad\", \"0.1 mrad\"]",
            "[limits]",
            "tilt = [\"0 rad\", \"0.1 mrad\"]\n[limits]",
        ),
        (
            "bearing.relative_clearance",
            "1.3e-3",
            "diametral_clearance = \"110 um\"",
            "relative_clearance = 1.3e-3",
        ),
    ];
    for (key, value, from, to) in varied {
        assert!(fed.contains(from), "{from}");
        let edited = fed.replacen(from, to, 1);
        // In place of the other clearance, not beside it.
        let base = fed.replace(
            if key.ends_with("relative_clearance") {
                from
            } else {
                "none"
            },
            "",
        );
        let desk = Desk::new(
            &base,
            &format!("keep = \"all\"\nvary = {{ \"{key}\" = [{value}] }}\n"),
        );
        let (code, text) = desk.run("out", "1");
        assert_eq!(code, Some(0), "{key}: {text}");
        fs::write(desk.path("direct.toml"), edited).unwrap();
        let direct = sommerfeld()
            .arg("run")
            .arg(desk.path("direct.toml"))
            .output()
            .unwrap();
        assert_eq!(told(&direct).0, Some(0), "{key}");
        let table = Table::read(&desk.path("out/cases.csv"));
        let (case, alone) = (
            summary(&desk.path("out/cases/0001")),
            summary(&desk.path("direct")),
        );
        for name in [
            "minimum_film_thickness_m",
            "power_loss_w",
            "side_flow_m3_s",
            "friction_torque_shell_n_m",
        ] {
            assert_eq!(number(&case, name), number(&alone, name), "{key}: {name}");
        }
        let film = fs::read(desk.path("out/cases/0001/film.csv")).unwrap();
        assert!(
            film == fs::read(desk.path("direct/film.csv")).unwrap(),
            "{key}"
        );
        assert!(desk.path("out/cases/0001/report.html").exists());
        let column = table.numbers("minimum_film_thickness[m]");
        assert_eq!(
            column,
            [number(&alone, "minimum_film_thickness_m")],
            "{key}"
        );
    }
}

#[test]
fn check_says_how_many_cases() {
    let desk = Desk::new(
        BASE,
        "mode = \"zip\"\nvary = { \"operation.speed\" = [\"1000 rpm\", \"2000 rpm\"], \
         \"bearing.width\" = { from = \"50 mm\", to = \"60 mm\", count = 2 } }\n",
    );
    let check = sommerfeld()
        .arg("check")
        .arg(desk.path("sweep.toml"))
        .output()
        .unwrap();
    let (code, text) = told(&check);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("cases     2, every one checked"), "{text}");
    assert!(
        text.contains("bearing.width, 2 values, 50 mm to 60 mm"),
        "{text}"
    );
    assert!(!desk.path("sweep").exists());
}
