//! Bearings that do the same at another crank angle: their shared orbit is the one that each would have
//! found by itself.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at the first surprise"
)]

mod machines;

use machines::{inline_plan, study};
use sommerfeld_bearing::CyclePoint;
use sommerfeld_engine::{Role, arm_in_rod_frame};
use sommerfeld_film::{Carrier, Cavitation, Feed, FeedLine, FeedShape, Shape};
use sommerfeld_study::input::{FilmModel, Machine, MachinePlan};
use sommerfeld_study::output::write_all;
use sommerfeld_study::results::machine::{BearingResults, MachineResults};
use sommerfeld_study::results::{Body, Results};
use sommerfeld_study::{Outcome, RunOptions, solve_with};
use std::fs;
use std::ops::ControlFlow;

/// Closure of the orbits that are compared, over the clearance.
const CLOSURE: f64 = 1e-4;

fn solved(plan: MachinePlan, model: FilmModel) -> Results {
    let options = RunOptions {
        threads: Some(2),
        ..RunOptions::default()
    };
    let study = study(plan, model, [48, 8], Vec::new());
    solve_with(&study, options, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn machine(results: &Results) -> &MachineResults {
    match &results.body {
        Body::Machine(machine) => machine,
        other => panic!("no machine: {other:?}"),
    }
}

/// An inline six at one speed with tightly closed orbits.
fn six() -> MachinePlan {
    let mut plan = inline_plan(&[1, 5, 3, 6, 2, 4], &[2000.0]);
    plan.orbit.closure_tolerance = CLOSURE;
    plan
}

/// The plan with the bearings of these names alone.
fn only(plan: &MachinePlan, names: &[&str]) -> MachinePlan {
    let mut plan = plan.clone();
    plan.bearings
        .retain(|bearing| names.contains(&bearing.name.as_str()));
    assert_eq!(plan.bearings.len(), names.len());
    plan
}

/// What is said of the origin of each orbit.
fn origins(results: &Results) -> Vec<Option<String>> {
    let bearings = machine(results).speeds[0].bearings.iter();
    bearings
        .map(|bearing| bearing.turned_from.as_ref().map(ToString::to_string))
        .collect()
}

fn shared(results: &Results) -> usize {
    origins(results).iter().flatten().count()
}

/// A hole in each crankpin at the same angle from its arm.
fn with_pin_holes(mut plan: MachinePlan) -> MachinePlan {
    let Machine::Engine(engine) = &plan.machine else {
        panic!("no engine");
    };
    for bearing in &mut plan.bearings {
        if bearing.role == Role::BigEnd {
            let arm = arm_in_rod_frame(&engine.train, bearing.index).unwrap();
            bearing.bearing.feeds.push(Feed {
                shape: FeedShape::Hole { diameter: 6e-3 },
                carried_by: Carrier::Journal,
                angle: arm + 0.7,
                position: 0.0,
                pressure: 4e5,
                line: FeedLine::Direct,
            });
        }
    }
    plan
}

/// Every point of an orbit against that of the bearing solved alone; `bar` over clearance and the largest
/// value of each kind.
fn assert_same_orbit(shared: &BearingResults, alone: &BearingResults, bar: f64) {
    let name = &shared.name;
    assert_eq!(alone.cycle.orbit.outcome, Outcome::Converged, "{name}");
    assert_eq!(shared.cycle.orbit.outcome, Outcome::Converged, "{name}");
    assert!(shared.turned_from.is_some() && alone.turned_from.is_none());
    assert_eq!(shared.load, alone.load, "{name}");
    let (a, b) = (&shared.cycle.orbit.points, &alone.cycle.orbit.points);
    assert_eq!(a.len(), b.len());
    let clearance = alone.cycle.bearing.radial_clearance;
    let largest = |value: fn(&CyclePoint) -> f64| b.iter().map(value).fold(0.0, f64::max);
    let peak = largest(|p| p.summary.peak_film_pressure.value);
    let power = largest(|p| p.summary.power_loss().abs());
    let cycles = alone.cycle.orbit.cycles as f64;
    for (at, (a, b)) in a.iter().zip(b).enumerate() {
        let near = |what: &str, a: f64, b: f64, bar: f64| {
            assert!(
                (a - b).abs() <= bar,
                "{name} {at} {what}: {a} for {b}, bar {bar}"
            );
        };
        near("crank angle", a.crank_angle, b.crank_angle, 1e-12);
        near("load", a.load[0], b.load[0], 1e-9);
        near("load", a.load[1], b.load[1], 1e-9);
        for axis in 0..2 {
            near(
                "place",
                a.state.position[axis],
                b.state.position[axis],
                bar * clearance,
            );
        }
        let film = |p: &CyclePoint| p.summary.minimum_film_thickness.value;
        near("film", film(a), film(b), bar * clearance);
        let pressure = |p: &CyclePoint| p.summary.peak_film_pressure.value;
        near("peak", pressure(a), pressure(b), 20.0 * bar * peak);
        let lost = |p: &CyclePoint| p.summary.power_loss();
        near("power", lost(a), lost(b), 20.0 * bar * power);
        near(
            "journal speed",
            a.state.journal_speed,
            b.state.journal_speed,
            1e-9,
        );
        // Each further cycle has turned by one more period.
        let further = a.state.journal_angle - b.state.journal_angle;
        let periods = further / (4.0 * std::f64::consts::PI);
        near("journal angle", periods, periods.round(), 1e-9);
        assert!(periods.abs() < cycles + 8.0);
    }
}

/// Thirteen orbits are four: the first and the last main, the middle one and the others, big ends.
#[test]
fn an_inline_six_needs_four_orbits() {
    let plan = six();
    let results = solved(plan.clone(), FilmModel::ShortBearing);
    let from = |name: &str, by: u32| Some(format!("{name} shifted by {by} deg"));
    // Firing order 1-5-3-6-2-4: cylinder 5 fires 120 deg after 1, 3 after 240, and so on.
    let big_ends = [
        None,
        from("big-end-1", 480),
        from("big-end-1", 240),
        from("big-end-1", 600),
        from("big-end-1", 120),
        from("big-end-1", 360),
    ];
    let found = origins(&results);
    assert_eq!(found[7..], big_ends);
    // The outer mains carry half of one cylinder each, the middle one two that fire a turn apart.
    assert_eq!(found[0], None);
    assert_eq!(found[6], from("main-1", 360));
    assert_eq!(found[3], None);
    assert_eq!(found[1], None);
    for at in [2, 4, 5] {
        assert!(
            found[at].as_ref().unwrap().starts_with("main-2 "),
            "{found:?}"
        );
    }
    let together = &machine(&results).speeds[0].bearings;
    for name in ["main-3", "main-5", "main-7", "big-end-2", "big-end-6"] {
        let alone = solved(only(&plan, &[name]), FilmModel::ShortBearing);
        let alone = &machine(&alone).speeds[0].bearings[0];
        let of_all = together.iter().find(|one| one.name == name).unwrap();
        assert_same_orbit(of_all, alone, CLOSURE);
    }
}
