//! Wear of the bearings of machines: on both surfaces that of the contact load over the orbit, whether a bearing is
//! solved by itself, stands for others, floats on its pin or answers an elastic crankshaft.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at the first surprise"
)]

use sommerfeld_study::input::{Subject, study_from_text};
use sommerfeld_study::output::{summary, write_all};
use sommerfeld_study::results::machine::{BearingResults, MachineResults};
use sommerfeld_study::results::{AccumulatedMap, Body, Results, SurfaceWear};
use sommerfeld_study::{Outcome, solve};
use std::ops::ControlFlow;
use std::path::Path;

const COEFFICIENT: f64 = 1e-16;
const BOUNDARY_FRICTION: f64 = 0.08;
/// s: two turns at 3000 rpm.
const PERIOD: f64 = 0.04;

const ENGINE: &str = r#"
schema = 1
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
speed = ["3000 rpm"]

[engine.combustion]
compression_ratio = 10.5
heat = "1.45 kJ"

[[engine.combustion.burning]]
start = "-15 deg"
duration = "60 deg"

[[bearing]]
of = "main"
diameter = "54 mm"
width = "20 mm"
diametral_clearance = "42 um"
SURFACE

[[bearing]]
of = "big-end"
diameter = "48 mm"
width = "18 mm"
diametral_clearance = "38 um"
SURFACE

[orbit]
crank_step = "6 deg"
closure_tolerance = 1e-4

[oil]
viscosity = "3 mPa.s"

[film]
cavitation = "reynolds"
grid = [48, 8]

[wear]
coefficient = "1e-16 m2/N"
"#;

const SURFACE: &str = r#"
[bearing.surface]
roughness_journal = "0.8 um"
roughness_shell = "1.2 um"
boundary_friction = 0.08
contact = { law = "greenwood-tripp", factor = 1e-3, asperity_product = 0.05, modulus = "53.3 GPa" }
"#;

fn engine(changed: impl Fn(String) -> String) -> String {
    changed(ENGINE.to_owned()).replace("SURFACE", SURFACE)
}

/// The study, with these bearings of its machine alone if any are named.
fn solved(text: &str, only: &[&str]) -> Results {
    let study = study_from_text("study.toml", text, Path::new(""));
    let mut study = study.unwrap_or_else(|errors| panic!("{errors}"));
    let Subject::Machine(plan) = &mut study.subject else {
        panic!("no machine")
    };
    plan.bearings
        .retain(|bearing| only.is_empty() || only.contains(&bearing.name.as_str()));
    let results = solve(&study, &mut |_| ControlFlow::Continue(())).unwrap();
    let messages = &results.header.messages;
    assert_eq!(results.header.status, Outcome::Converged, "{messages:?}");
    // Thin films of surfaces that know contact are no overload.
    assert!(
        messages
            .iter()
            .all(|told| !told.contains("does not know contact"))
    );
    results
}

fn machine(results: &Results) -> &MachineResults {
    match &results.body {
        Body::Machine(machine) => machine,
        other => panic!("no machine: {other:?}"),
    }
}

fn bearing<'r>(results: &'r Results, name: &str) -> &'r BearingResults {
    let mut all = machine(results).speeds[0].bearings.iter();
    all.find(|bearing| bearing.name == name).unwrap()
}

fn maps(found: &BearingResults) -> [&AccumulatedMap; 2] {
    let fields = found.cycle.fields.as_ref().unwrap();
    [&fields.on_shell, &fields.on_journal]
}

fn wear(map: &AccumulatedMap) -> &SurfaceWear {
    map.wear.as_ref().unwrap()
}

/// The wear load of both surfaces is contact load times sliding over the orbit, the friction power of asperities
/// its boundary share.
fn assert_wears_by_its_contact(found: &BearingResults) {
    let name = &found.name;
    let radius = 0.5 * found.cycle.bearing.diameter;
    let points = &found.cycle.orbit.points[1..];
    let interval = PERIOD / points.len() as f64;
    let slid = points.iter().map(|point| {
        let sliding = radius * (point.state.journal_speed - point.state.shell_speed).abs();
        sliding * point.summary.contact_load * interval
    });
    let expected: f64 = slid.sum();
    assert!(expected > 0.0, "{name} does not touch");
    for map in maps(found) {
        let wear = wear(map);
        assert!((wear.map.duration / PERIOD - 1.0).abs() < 1e-12, "{name}");
        let total = wear.map.total();
        assert!(
            (total / expected - 1.0).abs() < 1e-10,
            "{name}: {total} {expected}"
        );
    }
    let boundary: f64 = points
        .iter()
        .map(|p| p.summary.boundary_power * interval)
        .sum();
    let rubbed = BOUNDARY_FRICTION * expected;
    assert!(
        (boundary / rubbed - 1.0).abs() < 1e-10,
        "{name}: {boundary} {rubbed}"
    );
    // The coefficient is that of the shell: nothing is said of the journal's depth.
    let [shell, journal] = maps(found).map(wear);
    let volume = shell.volume_per_hour().unwrap();
    let per_hour = 3600.0 / PERIOD * COEFFICIENT * expected;
    assert!((volume / per_hour - 1.0).abs() < 1e-10, "{name}");
    assert!(journal.coefficient.is_none() && journal.volume_per_hour().is_none());
}

/// Of a bearing that stands for another the journal has turned by another angle under the same load.
#[test]
fn bearings_that_share_an_orbit_wear_as_alone() {
    let text = engine(|text| text.replace("cylinders = 1", "cylinders = 2\nfiring_order = [1, 2]"));
    let together = solved(&text, &["big-end-1", "big-end-2"]);
    let alone = solved(&text, &["big-end-2"]);
    let shared = bearing(&together, "big-end-2");
    let own = bearing(&alone, "big-end-2");
    assert!(shared.turned_from.is_some() && own.turned_from.is_none());
    assert_wears_by_its_contact(bearing(&together, "big-end-1"));
    assert_wears_by_its_contact(shared);
    assert_wears_by_its_contact(own);
    for (which, (a, b)) in maps(shared).into_iter().zip(maps(own)).enumerate() {
        let (a, b) = (&wear(a).map, &wear(b).map);
        assert_eq!(a.angles, b.angles);
        for (what, a, b) in [
            ("wear load", &a.wear_load, &b.wear_load),
            ("mean", &a.mean_pressure_velocity, &b.mean_pressure_velocity),
            ("peak", &a.peak_pressure_velocity, &b.peak_pressure_velocity),
        ] {
            let largest = b.iter().copied().fold(0.0, f64::max);
            for (at, (a, b)) in a.iter().zip(b).enumerate() {
                let apart = (a - b).abs();
                assert!(
                    apart < 1e-2 * largest,
                    "{which} {what} {at}: {a} for {b} of {largest}"
                );
            }
        }
    }
    // The journal of a cylinder that fires a turn later has turned by a whole turn more: the same place.
    let listed = summary(&together);
    let listed = listed["bearings"].as_array().unwrap();
    let volumes: Vec<f64> = listed
        .iter()
        .map(|one| one["wear_volume_per_hour_m3"].as_f64().unwrap())
        .collect();
    assert_eq!(volumes.len(), 2);
    assert_eq!(volumes[0], volumes[1]);
    let directory = tempfile::tempdir().unwrap();
    write_all(&together, directory.path()).unwrap();
    let table = std::fs::read_to_string(directory.path().join("bearings.csv")).unwrap();
    assert!(
        table
            .lines()
            .next()
            .unwrap()
            .contains("wear_volume_per_hour[m3]")
    );
}

/// Cylinders that fire two thirds of a turn apart on throws as far apart: each journal is worn at the same place
/// of its own crankpin, while the angles that the maps give count from +X of the journal.
#[test]
fn journals_of_three_throws_wear_at_the_same_place_of_each_pin() {
    let three = "cylinders = 3\nfiring_order = [1, 3, 2]";
    let text = engine(|text| text.replace("cylinders = 1", three));
    let names = ["big-end-1", "big-end-2", "big-end-3"];
    let together = solved(&text, &names);
    for name in &names[1..] {
        let (shared, alone) = (bearing(&together, name), solved(&text, &[name]));
        assert!(shared.turned_from.is_some(), "{name}");
        assert_wears_by_its_contact(shared);
        let [_, a] = maps(shared).map(|map| &wear(map).map);
        let [_, b] = maps(bearing(&alone, name)).map(|map| &wear(map).map);
        let largest = b.wear_load.iter().copied().fold(0.0, f64::max);
        for (at, (a, b)) in a.wear_load.iter().zip(&b.wear_load).enumerate() {
            assert!(
                (a - b).abs() < 1e-2 * largest,
                "{name} {at}: {a} for {b} of {largest}"
            );
        }
        // It is worn on one side, so that a map turned by a third would fail above.
        let around = b.wear_load.chunks(8).map(|of| of.iter().sum::<f64>());
        let around: Vec<f64> = around.collect();
        let turned = around.iter().cycle().skip(16).zip(&around);
        let most = around.iter().copied().fold(0.0, f64::max);
        let apart = turned.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart > 0.3 * most, "{name}: {around:?}");
    }
}

/// The mains of an elastic crankshaft tilt and touch with their edges.
#[test]
fn the_mains_of_an_elastic_crankshaft_wear_by_their_contact() {
    let text = engine(|text| {
        let bar = "[engine.crankshaft]\nmodel = \"elastic\"\nmain_length = \"30 mm\"\n\
            pin_length = \"26 mm\"\nweb_thickness = \"22 mm\"\nweb_width = \"90 mm\"\n\
            [engine.combustion]";
        let coarse = text.replace("6 deg", "10 deg").replace("1e-4", "1e-3");
        coarse
            .replace("[engine.combustion]", bar)
            .replace("[48, 8]", "[32, 8]")
    });
    let results = solved(&text, &["main-1", "main-2"]);
    for (name, towards_throw) in [("main-1", 1.0), ("main-2", -1.0)] {
        let found = bearing(&results, name);
        assert!(found.determinate_load.is_some());
        assert_wears_by_its_contact(found);
        let tilted = found.cycle.orbit.points.iter();
        let tilt = tilted.map(|p| p.state.tilt[0].hypot(p.state.tilt[1]));
        assert!(tilt.fold(0.0, f64::max) > 1e-5);
        // Both mains of one throw are worn more at the side of the throw.
        let shell = &wear(maps(found)[0]).map;
        let lever: f64 = (0..shell.wear_load.len())
            .map(|cell| shell.wear_load[cell] * shell.axial[cell % 8])
            .sum();
        assert!(towards_throw * lever > 0.0, "{name}: {lever}");
    }
}

/// A pin that swings: its films touch at speeds that change their sign.
#[test]
fn both_films_of_a_pin_wear_by_their_contact() {
    let pin = "[[bearing]]\nof = \"small-end\"\ndiameter = \"22 mm\"\nwidth = \"22 mm\"\n\
        diametral_clearance = \"24 um\"\nSURFACE\n[[bearing]]\nof = \"piston-boss\"\n\
        diameter = \"22 mm\"\nwidth = \"26 mm\"\ndiametral_clearance = \"26 um\"\nSURFACE\n[orbit]";
    // Dry friction has no balance of torques where a film sticks: the pin is given half of the speed of the rod.
    let text = engine(|text| {
        let given = text.replace("[orbit]", pin);
        given.replace("speed = [", "pin_speed_share = 0.5\nspeed = [")
    });
    let results = solved(&text, &["small-end-1", "piston-boss-1"]);
    for name in ["small-end-1", "piston-boss-1"] {
        let found = bearing(&results, name);
        assert_wears_by_its_contact(found);
        let mut speeds = found.cycle.orbit.points.iter();
        let relative =
            |p: &sommerfeld_bearing::CyclePoint| p.state.journal_speed - p.state.shell_speed;
        assert!(speeds.clone().any(|p| relative(p) > 0.0) && speeds.any(|p| relative(p) < 0.0));
    }
}
