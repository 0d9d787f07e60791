//! An elastic crankshaft where its mains are determinate: through the whole study it gives the loads and
//! films of hinges.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at the first surprise"
)]

mod machines;

use machines::{inline_plan, study};
use sommerfeld_engine::{CrankshaftShape, Mains, Supports, Unbalance, Web};
use sommerfeld_study::input::{FilmModel, Machine, MachinePlan};
use sommerfeld_study::output::write_all;
use sommerfeld_study::results::machine::BearingResults;
use sommerfeld_study::results::{Body, Results};
use sommerfeld_study::{Outcome, RunOptions, solve_with};
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;

/// One throw between two mains on short films, which pass no moments; an unbalance of its front web, so that
/// the mains differ.
fn single(elastic: bool) -> MachinePlan {
    let mut plan = inline_plan(&[1], &[2000.0]);
    plan.orbit.closure_tolerance = 1e-4;
    let Machine::Engine(engine) = &mut plan.machine else {
        panic!("no engine");
    };
    let layout = &engine.train.layout;
    let throw = layout.throws[0];
    engine.train.unbalances.push(Unbalance {
        axial: throw.axial - 0.03,
        angle: throw.angle,
        moment: 0.1,
    });
    if elastic {
        engine.mains = Mains::Elastic {
            shape: CrankshaftShape {
                youngs_modulus: 2.1e11,
                poissons_ratio: 0.3,
                main_diameter: 0.083,
                main_length: 0.044,
                pin_diameter: 0.069,
                pin_length: 0.038,
                bore_diameter: 0.0,
                web: Web::Bar {
                    thickness: 0.024,
                    width: 0.1,
                },
            },
            supports: Supports::Each {
                stiffness: [[5e8, 0.0], [0.0, 3e8]],
                tilt_stiffness: None,
            },
            offsets: Vec::new(),
        };
    }
    plan
}

fn solved(elastic: bool) -> Results {
    let study = study(
        single(elastic),
        FilmModel::ShortBearing,
        [64, 16],
        Vec::new(),
    );
    let results = solve_with(&study, RunOptions::default(), &mut |_| {
        ControlFlow::Continue(())
    });
    let results = results.unwrap();
    assert_eq!(
        results.header.status,
        Outcome::Converged,
        "{:?}",
        results.header.messages
    );
    results
}

fn bearings(results: &Results) -> &[BearingResults] {
    match &results.body {
        Body::Machine(machine) => &machine.speeds[0].bearings,
        other => panic!("no machine: {other:?}"),
    }
}

/// The column of a table by its name.
fn column(directory: &Path, file: &str, name: &str) -> Vec<f64> {
    let text = fs::read_to_string(directory.join(file)).unwrap();
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let at = lines
        .next()
        .unwrap()
        .split(',')
        .position(|head| head == name);
    let at = at.unwrap_or_else(|| panic!("{file} has no {name}"));
    lines
        .map(|line| line.split(',').nth(at).unwrap().parse().unwrap())
        .collect()
}

#[test]
fn one_throw_in_two_mains_gives_the_loads_and_films_of_hinges() {
    let (hinged, elastic) = (solved(false), solved(true));
    assert_eq!(bearings(&elastic).len(), 3);
    for (a, b) in bearings(&elastic).iter().zip(bearings(&hinged)) {
        let name = &a.name;
        let is_main = name.starts_with("main");
        assert_eq!(a.determinate_load.is_some(), is_main, "{name}");
        let points = &b.cycle.orbit.points;
        let largest = points
            .iter()
            .map(|point| point.load[0].hypot(point.load[1]))
            .fold(0.0, f64::max);
        assert_eq!(a.cycle.orbit.points.len(), points.len());
        for (at, (elastic, hinged)) in a.cycle.orbit.points.iter().zip(points).enumerate() {
            for axis in 0..2 {
                let apart = (elastic.load[axis] - hinged.load[axis]).abs();
                assert!(
                    apart < 1e-7 * largest,
                    "{name} {at}: {apart} of {largest} N"
                );
                let told = a.determinate_load.as_ref().map(|loads| loads[at][axis]);
                let told = told.unwrap_or(hinged.load[axis]);
                assert!(
                    (told - hinged.load[axis]).abs() < 1e-9 * largest,
                    "{name} {at}"
                );
            }
        }
        // Both follow the same journal, with time steps of their own.
        let film = |one: &BearingResults| {
            let found = one.cycle.orbit.minimum_film_thickness().unwrap();
            (found.0.value, found.1)
        };
        let (found, expected) = (film(a), film(b));
        assert!(
            (found.0 / expected.0 - 1.0).abs() < 2e-3,
            "{name}: {found:?} for {expected:?}"
        );
        let peak = |one: &BearingResults| one.cycle.orbit.peak_film_pressure().unwrap().0.value;
        assert!((peak(a) / peak(b) - 1.0).abs() < 5e-3, "{name}");
    }
    // The unbalance loads the mains differently: a test that could tell the mains apart.
    let largest = |one: &BearingResults| {
        let points = one.cycle.orbit.points.iter();
        points
            .map(|p| p.load[0].hypot(p.load[1]))
            .fold(0.0, f64::max)
    };
    let mains = [0, 1].map(|at| largest(&bearings(&hinged)[at]));
    assert!((mains[0] / mains[1] - 1.0).abs() > 0.02, "{mains:?}");

    let directories = [&elastic, &hinged].map(|results| {
        let directory = tempfile::tempdir().unwrap();
        write_all(results, directory.path()).unwrap();
        directory
    });
    let [of_elastic, of_hinged] = directories.each_ref().map(tempfile::TempDir::path);
    for axis in ["x", "y"] {
        let determinate = format!("determinate_load_{axis}[N]");
        let file = "cycle-main-1.csv";
        let told = column(of_elastic, file, &determinate);
        let hinges = column(of_hinged, file, &format!("load_{axis}[N]"));
        assert_eq!(told.len(), hinges.len());
        let largest = hinges.iter().map(|load| load.abs()).fold(0.0, f64::max);
        for (told, hinges) in told.iter().zip(&hinges) {
            assert!(
                (told - hinges).abs() < 1e-9 * largest,
                "{told} for {hinges} N"
            );
        }
    }
    let text = fs::read_to_string(of_hinged.join("cycle-main-1.csv")).unwrap();
    assert!(!text.contains("determinate"));
}
