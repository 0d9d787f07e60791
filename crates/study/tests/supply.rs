//! From the supply keys of a study file to its results.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_study::input::study_from_text;
use sommerfeld_study::output::{cycle_table, summary};
use sommerfeld_study::results::{Body, CycleResults, Results};
use sommerfeld_study::{Study, solve};
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

/// A big end whose crankpin hole is fed through a drilling and a line, and a groove in its shell.
const STUDY: &str = r#"
schema = 1
analysis = "load-cycle"
[bearing]
diameter = "72 mm"
width = "30 mm"
diametral_clearance = "72 um"
[[bearing.groove]]
kind = "hole"
carried_by = "journal"
angle = "90 deg"
diameter = "8 mm"
pressure_file = "feed.csv"
line_resistance = "0.05 bar.s/cm3"
drilling_inlet_radius = "30 mm"
drilling_outlet_radius = "104 mm"
[[bearing.groove]]
kind = "rectangle"
angle = "350 deg"
length = "40 mm"
width = "6 mm"
pressure = "2 bar"
[oil]
viscosity = "8 mPa.s"
[film]
grid = [32, 10]
[load_cycle]
file = "loads.csv"
engine_speed = "3000 rpm"
period = "360 deg"
crank_step = "5 deg"
maximum_cycles = 2
"#;

fn study(text: &str, feed: &str, name: &str) -> Study {
    let directory =
        std::env::temp_dir().join(format!("sommerfeld-supply-{name}-{}", std::process::id()));
    fs::create_dir_all(&directory).unwrap();
    let loads =
        "crank_angle[deg],load_x[N],load_y[N]\n0,4000,0\n90,3000,800\n180,2000,0\n270,3000,-800\n";
    fs::write(directory.join("loads.csv"), loads).unwrap();
    fs::write(directory.join("feed.csv"), feed).unwrap();
    let study = study_from_text("study.toml", text, Path::new(&directory));
    fs::remove_dir_all(&directory).unwrap();
    study.unwrap_or_else(|errors| panic!("{errors}"))
}

const FEED: &str = "crank_angle[deg],pressure[kPa]\n0,400\n180,600\n";

fn solved(study: &Study) -> Results {
    solve(study, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn cycle(results: &Results) -> &CycleResults {
    match &results.body {
        Body::LoadCycle(cycle) => cycle,
        _ => panic!("no load cycle"),
    }
}

#[test]
fn the_pressure_file_reaches_film_tables_and_summary() {
    let results = solved(&study(STUDY, FEED, "film"));
    let cycle = cycle(&results);
    // rho omega^2 (r_out^2 - r_in^2)/2 by hand: 425 x (100 pi)^2 x (0.010816 - 0.0009).
    let head = 425.0 * 98_696.044 * 0.009_916;
    for (point, feeds) in cycle.orbit.points.iter().zip(&cycle.feed_flows) {
        let turn = point.crank_angle.to_degrees().rem_euclid(360.0);
        let supply = 6e5 - 2e5 * (turn - 180.0).abs() / 180.0 + head;
        // What the line loses is its resistance times its flow, also where the film pushes back.
        let due = supply - 0.05e11 * feeds[0].flow;
        assert!(
            (feeds[0].pressure / due - 1.0).abs() < 1e-6,
            "{turn}: {feeds:?} {due}"
        );
        // The groove has no line: it holds its pressure, also with the hole open into it.
        assert!(
            (feeds[1].pressure / 2e5 - 1.0).abs() < 1e-12,
            "{turn}: {feeds:?}"
        );
    }
    let keys = summary(&results);
    let sum: f64 = ["front", "rear"]
        .iter()
        .map(|edge| {
            keys[format!("mean_side_flow_{edge}_m3_s")]
                .as_f64()
                .unwrap()
        })
        .sum();
    let whole = keys["mean_side_flow_m3_s"].as_f64().unwrap();
    assert!((sum / whole - 1.0).abs() < 1e-12);
    let flows = keys["mean_groove_flows_m3_s"].as_array().unwrap();
    let fed: f64 = flows.iter().map(|flow| flow.as_f64().unwrap()).sum();
    assert!((fed / keys["mean_feed_flow_m3_s"].as_f64().unwrap() - 1.0).abs() < 1e-9);
    assert_eq!(
        keys["mean_groove_pressures_pa"].as_array().unwrap().len(),
        2
    );
    let table = String::from_utf8(cycle_table(cycle).unwrap()).unwrap();
    let header = table.lines().next().unwrap();
    for column in [
        "side_flow_rear[m3/s]",
        "feed_2_flow[m3/s]",
        "feed_1_pressure[Pa]",
    ] {
        assert!(header.split(',').any(|name| name == column), "{header}");
    }
    // The hole, half of it 6.4 deg, passes the groove, half of it 31.8 deg, once a turn at 260 deg.
    let holes = keys["oil_holes"].as_array().unwrap();
    assert_eq!(holes.len(), 1);
    let facing = &holes[0]["facing_groove_deg"];
    assert_eq!(facing.as_array().unwrap().len(), 1, "{facing}");
    let [from, to] = [0, 1].map(|end| facing[0][end].as_f64().unwrap());
    assert!(
        (from - 221.8).abs() < 0.2 && (to - 298.2).abs() < 0.2,
        "{facing}"
    );
}

#[test]
fn the_hash_covers_the_pressure_file() {
    let hash = |feed: &str, name: &str| study(STUDY, feed, name).input_hash;
    assert_eq!(hash(FEED, "a"), hash(FEED, "b"));
    assert_ne!(hash(FEED, "c"), hash(&FEED.replace("600", "601"), "d"));
}
