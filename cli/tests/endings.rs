//! How runs end that do not end well: starved, interrupted, without a place for their results.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

mod common;

use common::{root, run_text, sommerfeld};
use std::fs;

const BEARING: &str = "schema = 1\n[bearing]\ndiameter = \"72 mm\"\nwidth = \"30 mm\"\n\
                       diametral_clearance = \"72 um\"\n[oil]\nviscosity = \"8 mPa.s\"\n";
const STEADY: &str = "[operation]\nspeed = \"2000 rpm\"\nload = [\"10 kN\", \"0 N\"]\n";
const CYCLE: &str =
    "[load_cycle]\nfile = \"loads.csv\"\nengine_speed = \"2000 rpm\"\ncrank_step = \"5 deg\"\n";
const LOADS: &str =
    "crank_angle[deg],load_x[N],load_y[N]\n0,3000,0\n180,0,2000\n360,4000,500\n720,3000,0\n";

fn study(analysis: &str, film: &str, duty: &str) -> String {
    let head = BEARING.replace(
        "schema = 1\n",
        &format!("schema = 1\nanalysis = \"{analysis}\"\n"),
    );
    format!("{head}[film]\n{film}\n{duty}")
}

/// A film that conserves mass and is fed by nothing: named, no number, and what to do about it.
/// `sommerfeld run study.toml | head -1`: what nobody reads any more is no failure.
#[test]
fn a_reader_that_closes_the_output_is_no_failure() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("study.toml");
    let template = sommerfeld_study::templates::find("dimensionless").unwrap();
    fs::write(
        &file,
        template.study.replace("[film]", "[film]\ngrid = [32, 8]"),
    )
    .unwrap();
    let mut child = sommerfeld()
        .arg("run")
        .arg(&file)
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let ended = child.wait_with_output().unwrap();
    let err = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(0), "{err}");
    assert!(
        directory.path().join("study/summary.json").exists(),
        "{err}"
    );
}

#[test]
fn without_supply_a_run_is_starved() {
    for (analysis, duty) in [
        ("equilibrium", STEADY),
        ("coefficients", STEADY),
        ("load-cycle", CYCLE),
    ] {
        let ran = run_text(&study(analysis, "", duty), LOADS);
        assert_eq!(ran.code, Some(1), "{analysis}: {}{}", ran.out, ran.err);
        assert!(
            ran.out.contains(&format!("{analysis}: starved")),
            "{}",
            ran.out
        );
        assert!(ran.out.contains("give a groove or hole"), "{}", ran.out);
        assert!(!ran.out.contains("minimum film thickness"), "{}", ran.out);
        let summary = ran.summary();
        assert_eq!(summary["status"], "starved");
        let told = summary["messages"].to_string();
        assert!(told.contains("give a groove or hole"), "{told}");
        for key in ["minimum_film_thickness_m", "peak_film_pressure_pa"] {
            assert!(summary[key].is_null(), "{analysis}: {key} {}", summary[key]);
        }
        let report = ran.report();
        assert!(report.contains("<strong>Starved</strong>"), "{analysis}");
        assert!(report.contains("give a groove or hole"), "{analysis}");
    }
}

/// The ways out that the message names are ways out.
#[test]
fn what_the_hint_says_feeds_the_film() {
    let hole = "[[bearing.groove]]\nkind = \"hole\"\nangle = \"180 deg\"\ndiameter = \"6 mm\"\n\
                pressure = \"5 bar\"\n";
    let grid = "grid = [64, 16]\n";
    let flooded = "ends = \"flooded\"\nambient_pressure = \"1 bar\"\n";
    for (film, feed) in [
        (grid.to_owned(), hole),
        (format!("{grid}{flooded}"), ""),
        (format!("{grid}cavitation = \"reynolds\"\n"), ""),
    ] {
        let text = study("equilibrium", &format!("{film}{feed}"), STEADY);
        let ran = run_text(&text, LOADS);
        assert_eq!(ran.code, Some(0), "{film}{feed}: {}{}", ran.out, ran.err);
    }
}

#[test]
fn no_place_for_results_is_told_before_the_run() {
    let directory = tempfile::tempdir().unwrap();
    let taken = directory.path().join("taken");
    fs::write(&taken, "a file").unwrap();
    for out in [taken.join("results"), taken] {
        let output = sommerfeld()
            .arg("run")
            .arg(root().join("examples/02-big-end-diesel/study.toml"))
            .arg("--out")
            .arg(&out)
            .output()
            .unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(3), "{err}");
        assert!(err.contains(&out.display().to_string()), "{err}");
        assert!(!err.contains('%'), "told after the run: {err}");
    }
}

/// Results are replaced as a whole; what no run has written is not touched.
#[test]
fn a_second_run_replaces_the_results_and_nothing_else() {
    let grid = "grid = [32, 8]\ncavitation = \"reynolds\"\n";
    let directory = tempfile::tempdir().unwrap();
    let place = |name: &str| directory.path().join(name);
    let run = |name: &str| {
        let mut command = sommerfeld();
        command.arg("run").arg(place(name)).arg("--out");
        let output = command.arg(place("results")).output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        (output.status.code().unwrap(), err)
    };
    fs::write(place("loads.csv"), LOADS).unwrap();
    fs::write(place("steady.toml"), study("equilibrium", grid, STEADY)).unwrap();
    let model = "model = \"short-bearing\"\n";
    fs::write(place("cycle.toml"), study("load-cycle", model, CYCLE)).unwrap();
    assert_eq!(run("cycle.toml").0, 0);
    fs::write(place("results/notes.txt"), "mine").unwrap();
    assert!(place("results/cycle.csv").exists());
    assert_eq!(run("steady.toml").0, 0);
    assert_eq!(
        common::summary(&place("results"))["analysis"],
        "equilibrium"
    );
    assert!(!place("results/cycle.csv").exists(), "of the other run");
    assert!(place("results/film.csv").exists());
    assert!(place("results/notes.txt").exists());

    // Tables that are not of a run, and a summary of another program.
    for (name, content) in [("film.csv", "mine"), ("summary.json", "{}")] {
        fs::remove_dir_all(place("results")).unwrap();
        fs::create_dir(place("results")).unwrap();
        fs::write(place("results").join(name), content).unwrap();
        let (code, err) = run("steady.toml");
        assert_eq!(code, 2, "{err}");
        assert!(err.contains(name) && err.contains("--out"), "{err}");
        let kept = fs::read_to_string(place("results").join(name)).unwrap();
        assert_eq!(kept, content);
        assert_eq!(fs::read_dir(place("results")).unwrap().count(), 1);
    }
}

/// A load table that has the name of a table of results is not overwritten by them.
#[test]
fn an_input_is_never_overwritten() {
    let directory = tempfile::tempdir().unwrap();
    let place = |name: &str| directory.path().join(name);
    let duty = CYCLE.replace("loads.csv", "cycle.csv");
    fs::write(place("cycle.csv"), LOADS).unwrap();
    let text = study("load-cycle", "model = \"short-bearing\"\n", &duty);
    fs::write(place("study.toml"), text).unwrap();
    let mut command = sommerfeld();
    command.arg("run").arg(place("study.toml")).arg("--out");
    let output = command.arg(directory.path()).output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{err}");
    assert!(err.contains("it is an input of this study"), "{err}");
    assert_eq!(fs::read_to_string(place("cycle.csv")).unwrap(), LOADS);
}

/// A load beyond any bearing converges, and says in every place that its numbers mean nothing.
#[test]
fn a_result_beyond_the_physics_is_called_so() {
    let film = "cavitation = \"reynolds\"\n";
    let ran = run_text(
        &study("equilibrium", film, &STEADY.replace("10 kN", "10 MN")),
        LOADS,
    );
    assert_eq!(ran.code, Some(0), "{}{}", ran.out, ran.err);
    for text in [
        &ran.out,
        &ran.summary()["messages"].to_string(),
        &ran.report(),
    ] {
        for part in ["is below 0.1 um", "is above 1 GPa"] {
            assert!(text.contains(part), "{part} in {text:.3000}");
        }
    }
}

/// Ctrl-C leaves a directory that can be read, and says that the run is not finished.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_a_valid_directory() {
    use std::process::{Command, Stdio};
    use std::time::Duration;

    let directory = tempfile::tempdir().unwrap();
    let results = directory.path().join("results");
    let child = sommerfeld()
        .arg("run")
        .arg(root().join("examples/02-big-end-diesel/study.toml"))
        .arg("--out")
        .arg(&results)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(3));
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success());
    let output = child.wait_with_output().unwrap();
    let (out, err) = (
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    );
    assert_eq!(output.status.code(), Some(130), "{out}{err}");
    let summary = common::summary(&results);
    assert_eq!(summary["status"], "not-converged");
    assert!(summary["messages"].to_string().contains("interrupted"));
    let report = fs::read_to_string(results.join("report.html")).unwrap();
    assert!(report.ends_with("</html>\n") || report.trim_end().ends_with("</html>"));
    for entry in fs::read_dir(&results).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(!name.ends_with(".part"), "{name}");
    }
}
