//! Runs of whole machines: every bearing at every speed, their files, and runs that are taken up.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at the first surprise"
)]

mod machines;

use machines::{RPM, inline_plan, study};
use sommerfeld_engine::Role;
use sommerfeld_film::FilmShear;
use sommerfeld_study::input::{FilmModel, StudyLimit, Subject};
use sommerfeld_study::output::summary;
use sommerfeld_study::results::machine::MachineResults;
use sommerfeld_study::results::{Body, Results};
use sommerfeld_study::{
    Outcome, ProgressEvent, RunOptions, Study, load_study, run_with, solve_with,
};
use std::collections::BTreeMap;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

fn threads(count: usize) -> RunOptions {
    RunOptions {
        threads: Some(count),
        ..RunOptions::default()
    }
}

fn solved(study: &Study, count: usize) -> Results {
    solve_with(study, threads(count), &mut |_| ControlFlow::Continue(())).unwrap()
}

fn machine(results: &Results) -> &MachineResults {
    match &results.body {
        Body::Machine(machine) => machine,
        other => panic!("no machine: {other:?}"),
    }
}

/// A three-cylinder engine at three speeds, films in closed form.
fn three(limits: Vec<StudyLimit>) -> Study {
    let plan = inline_plan(&[1, 3, 2], &[1500.0, 2000.0, 2500.0]);
    study(plan, FilmModel::ShortBearing, [64, 16], limits)
}

/// Every file below a directory with its content; times are taken out of summary and report.
fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            let inner = files(&path).into_iter();
            all.extend(inner.map(|(inner, content)| (format!("{name}/{inner}"), content)));
            continue;
        }
        let mut content = fs::read(&path).unwrap();
        if name == "summary.json" {
            let mut summary: serde_json::Value = serde_json::from_slice(&content).unwrap();
            summary["wall_time_s"] = 0.into();
            content = summary.to_string().into_bytes();
        }
        if name == "report.html" {
            content = without_wall_time(&String::from_utf8(content).unwrap()).into_bytes();
        }
        all.insert(name, content);
    }
    all
}

/// A report without the row of its wall time, which must stand there once.
fn without_wall_time(report: &str) -> String {
    let before = report
        .find("Wall time")
        .expect("the report names its wall time");
    let after = before + report[before..].find("</tr>").expect("a row of a table");
    assert!(!report[after..].contains("Wall time"));
    format!("{}{}", &report[..before], &report[after..])
}

/// The wall time in the summary of a run, s.
fn wall_time(directory: &Path) -> f64 {
    let summary = fs::read(directory.join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_slice(&summary).unwrap();
    summary["wall_time_s"].as_f64().unwrap()
}

/// Two files of numbers differ in nothing but the eight bytes of their wall times.
fn same_but_wall_time(name: &str, a: &[u8], b: &[u8], wall_times: [f64; 2]) {
    let without = |content: &[u8], wall_time: f64| {
        let bytes = wall_time.to_le_bytes();
        let at: Vec<usize> = (0..content.len().saturating_sub(7))
            .filter(|at| content[*at..*at + 8] == bytes)
            .collect();
        assert_eq!(at.len(), 1, "{name} holds its wall time {wall_time} s once");
        let mut content = content.to_vec();
        content[at[0]..at[0] + 8].fill(0);
        content
    };
    let (a, b) = (without(a, wall_times[0]), without(b, wall_times[1]));
    let different = a.iter().zip(&b).filter(|(a, b)| a != b).count();
    assert!(
        a == b,
        "{name}: {different} of {} and {} bytes differ",
        a.len(),
        b.len()
    );
}

/// Orbits that are done, which every sign of life of a machine counts.
fn orbits_done(event: &ProgressEvent) -> usize {
    let count = event.label.split(' ').next().unwrap();
    count.parse().unwrap()
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let study = three(Vec::new());
    let (one, three) = (solved(&study, 1), solved(&study, 3));
    assert_eq!(
        one.header.status,
        Outcome::Converged,
        "{:?}",
        one.header.messages
    );
    assert_eq!(machine(&one), machine(&three));
    assert_eq!(machine(&one).bearings().count(), 3 * 7);
}

/// The bearings of the machine by hand: mean power over the swept volume and the cycle rate.
#[test]
fn friction_mean_effective_pressure_is_the_work_of_a_cycle_over_the_swept_volume() {
    let results = solved(&three(Vec::new()), 2);
    for speed in &machine(&results).speeds {
        let power: f64 = speed
            .bearings
            .iter()
            .map(|bearing| bearing.cycle.orbit.mean_power_loss())
            .sum();
        let swept = 3.0 * 0.25 * std::f64::consts::PI * 0.105 * 0.105 * 0.137;
        let cycles_per_second = speed.speed / RPM / 120.0;
        let expected = power / (swept * cycles_per_second);
        let found = speed.friction_mean_effective_pressure.unwrap();
        assert!(
            (found / expected - 1.0).abs() < 1e-9,
            "{found} for {expected}"
        );
        // Film friction of a diesel's bearings: some hundredths to some tenths of a bar.
        assert!((1e3..1e5).contains(&found), "{found}");
    }
}

#[test]
fn summary_keeps_its_stable_keys() {
    let results = solved(&three(Vec::new()), 2);
    let summary = summary(&results);
    for key in [
        "imep_pa",
        "mean_torque_n_m",
        "friction_mean_effective_pressure_pa",
    ] {
        assert!(summary[key].is_f64(), "{key}");
        assert_eq!(summary[key], summary["speeds"][0][key]);
    }
    let speeds = summary["speeds"].as_array().unwrap();
    let rpm: Vec<f64> = speeds
        .iter()
        .map(|speed| speed["speed_rpm"].as_f64().unwrap())
        .collect();
    assert_eq!(rpm, [1500.0, 2000.0, 2500.0]);
    assert_eq!(summary["bearings"], speeds[0]["bearings"]);
    let names: Vec<&str> = summary["bearings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|b| b["name"].as_str().unwrap())
        .collect();
    assert_eq!(
        names,
        [
            "main-1",
            "main-2",
            "main-3",
            "main-4",
            "big-end-1",
            "big-end-2",
            "big-end-3"
        ]
    );
    for bearing in speeds
        .iter()
        .flat_map(|speed| speed["bearings"].as_array().unwrap())
    {
        for key in [
            "minimum_film_thickness_m",
            "peak_film_pressure_pa",
            "maximum_load_n",
            "maximum_specific_load_pa",
            "mean_power_loss_w",
            "cycle_closure",
        ] {
            assert!(bearing[key].is_f64(), "{key} of {bearing}");
        }
        assert_eq!(bearing["status"], "converged");
    }
}

/// A limit in the middle of what is found: broken by some, kept by others, and the worst is named.
#[test]
fn a_limit_judges_every_bearing_and_names_the_worst() {
    let free = solved(&three(Vec::new()), 2);
    let film = |bearing: &sommerfeld_study::results::machine::BearingResults| {
        let thinnest = bearing.cycle.minimum_film_thickness().unwrap();
        thinnest.summary.minimum_film_thickness.value
    };
    let mut all: Vec<(f64, String)> = machine(&free)
        .bearings()
        .map(|(speed, bearing)| (film(bearing), speed.place(bearing)))
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let middle = 0.5 * (all[9].0 + all[10].0);
    let limit = |value| StudyLimit {
        key: "minimum_film_thickness",
        value,
        source: "house rule".into(),
    };
    let judged = solved(&three(vec![limit(middle)]), 2);
    let worst = &judged.header.limits[0];
    assert_eq!(worst.at.as_ref(), Some(&all[0].1));
    assert_eq!(worst.found, Some(all[0].0));
    assert!(worst.to_string().contains("EXCEEDED") && worst.to_string().contains(&all[0].1));
    let summary = summary(&judged);
    let verdicts = summary["speeds"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|speed| speed["bearings"].as_array().unwrap());
    let broken = verdicts
        .filter(|bearing| bearing["limits"][0]["verdict"] == "exceeded")
        .count();
    assert_eq!(broken, 10);
    let kept = solved(&three(vec![limit(0.5 * all[0].0)]), 2);
    assert!(kept.header.limits[0].to_string().contains("OK"));
}

/// A run that is stopped and taken up leaves the files of one that was not.
#[test]
fn a_stopped_run_is_taken_up_to_the_same_files() {
    let study = three(Vec::new());
    let (whole, parts) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    run_with(&study, whole.path(), threads(2), &mut |_| {
        ControlFlow::Continue(())
    })
    .unwrap();
    let mut stops = 0;
    for _ in 0..50 {
        let mut done_before = None;
        // Stops when some orbits of this run are done.
        let mut stop = |event: ProgressEvent| {
            let done = orbits_done(&event);
            match done >= *done_before.get_or_insert(done) + 5 {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        };
        let summary = run_with(&study, parts.path(), threads(2), &mut stop).unwrap();
        let missing = machine(&summary.results).missing();
        if missing == 0 {
            break;
        }
        stops += 1;
        assert_eq!(summary.results.header.status, Outcome::NotConverged);
        assert!(summary.results.header.messages[0].starts_with("interrupted:"));
        assert!(parts.path().join("ledger.sqlite").exists());
    }
    assert!(stops >= 2, "{stops}");
    let wall_times = [whole.path(), parts.path()].map(wall_time);
    let (whole, parts) = (files(whole.path()), files(parts.path()));
    assert_eq!(
        whole.keys().collect::<Vec<_>>(),
        parts.keys().collect::<Vec<_>>()
    );
    for (name, content) in &whole {
        match name.as_str() {
            "results.h5" => same_but_wall_time(name, content, &parts[name], wall_times),
            _ => assert!(content == &parts[name], "{name} differs"),
        }
    }
    assert!(whole.contains_key("2000rpm/cycle-main-2.csv") && !whole.contains_key("ledger.sqlite"));
}

/// The load file of a bearing, run as a study of its own, gives the orbit of the machine.
#[test]
fn the_load_file_of_a_bearing_gives_its_orbit() {
    let plan = inline_plan(&[1, 3, 2], &[2000.0]);
    let study = study(plan, FilmModel::ShortBearing, [64, 16], Vec::new());
    let directory = tempfile::tempdir().unwrap();
    let run = run_with(&study, directory.path(), threads(2), &mut |_| {
        ControlFlow::Continue(())
    })
    .unwrap();
    for name in ["main-2", "big-end-3"] {
        let speed = &machine(&run.results).speeds[0];
        let of_machine = speed
            .bearings
            .iter()
            .find(|bearing| bearing.name == name)
            .unwrap();
        let size = match of_machine.role {
            Role::Main => {
                "diameter = \"83 mm\"\nwidth = \"30 mm\"\ndiametral_clearance = \"82 um\""
            }
            _ => "diameter = \"69 mm\"\nwidth = \"34 mm\"\ndiametral_clearance = \"70 um\"",
        };
        let text = format!(
            "schema = 1\nanalysis = \"load-cycle\"\n[bearing]\n{size}\n[oil]\nviscosity = \"10 mPa.s\"\n\
             temperature = \"100 degC\"\ndensity = \"850 kg/m3\"\n[film]\nmodel = \"short-bearing\"\n\
             cavitation = \"gumbel\"\n[load_cycle]\nfile = \"loads-{name}.csv\"\n\
             engine_speed = \"2000 rpm\"\nperiod = \"720 deg\"\ncrank_step = \"1 deg\"\n\
             closure_tolerance = 1e-3\n"
        );
        let file = directory.path().join("alone.toml");
        fs::write(&file, text).unwrap();
        let alone = load_study(&file).unwrap_or_else(|errors| panic!("{}", errors.render(false)));
        let alone = solved(&alone, 1);
        let Body::LoadCycle(alone) = &alone.body else {
            panic!("no cycle");
        };
        let clearance = alone.bearing.radial_clearance;
        assert_eq!(
            alone.orbit.points.len(),
            of_machine.cycle.orbit.points.len()
        );
        for (a, b) in alone
            .orbit
            .points
            .iter()
            .zip(&of_machine.cycle.orbit.points)
        {
            for axis in 0..2 {
                let apart = (a.state.position[axis] - b.state.position[axis]).abs();
                // The file holds angles in degrees; their round-off is all that differs.
                assert!(
                    apart < 1e-8 * clearance,
                    "{name} at {}: {apart}",
                    a.crank_angle
                );
            }
        }
    }
}

/// A film that refuses a bearing ends the run; as nothing was found, the study may be mended and run in the
/// same directory.
#[test]
fn a_refused_bearing_leaves_the_directory_free() {
    let mut plan = inline_plan(&[1], &[2000.0]);
    // Closed forms shear over the full width.
    plan.bearings[0].bearing.film_shear = FilmShear::FilmFraction;
    let mut study = study(plan, FilmModel::ShortBearing, [64, 16], Vec::new());
    let directory = tempfile::tempdir().unwrap();
    let run = |study: &Study| {
        run_with(study, directory.path(), threads(1), &mut |_| {
            ControlFlow::Continue(())
        })
    };
    let error = run(&study).unwrap_err();
    assert!(
        error.to_string().starts_with("main-1 at 2000 rpm: "),
        "{error}"
    );
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
    let Subject::Machine(plan) = &mut study.subject else {
        panic!("no machine");
    };
    plan.bearings[0].bearing.film_shear = FilmShear::FullWidth;
    study.input_hash = "mended".into();
    assert_eq!(
        run(&study).unwrap().results.header.status,
        Outcome::Converged
    );
}
