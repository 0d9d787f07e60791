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

use sommerfeld_film::{Carrier, Feature, Feed, FeedLine, FeedShape, Shape};
use sommerfeld_study::input::{FilmModel, Machine, MachinePlan};
use sommerfeld_study::output::write_all;
use sommerfeld_study::results::machine::{BearingResults, MachineResults};
use sommerfeld_study::results::{Body, CycleField, Results};
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

/// Films on a grid with turning oil holes: orbit, flows, fields and tables.
#[test]
fn films_with_holes_that_turn_are_shared_where_the_holes_agree() {
    let mut plan = with_pin_holes(only(&six(), &["big-end-1", "big-end-2"]));
    plan.orbit.crank_step = 2.0_f64.to_radians();
    let together = solved(plan.clone(), FilmModel::Field);
    assert_eq!(
        origins(&together),
        [None, Some("big-end-1 shifted by 480 deg".to_owned())]
    );
    let alone = solved(only(&plan, &["big-end-2"]), FilmModel::Field);
    let [_, shared] = &machine(&together).speeds[0].bearings[..] else {
        panic!("two bearings")
    };
    let own = &machine(&alone).speeds[0].bearings[0];
    assert_same_orbit(shared, own, CLOSURE);
    assert_same_fields(shared, own);
    assert_same_tables(&together, &alone);
}

/// Fields at the same instants; maps of what the points of both surfaces have seen.
fn assert_same_fields(shared: &BearingResults, alone: &BearingResults) {
    let fields = |one: &BearingResults| one.cycle.fields.clone().unwrap();
    let (a, b) = (fields(shared), fields(alone));
    let angles = |frames: &[CycleField]| -> Vec<i64> {
        frames
            .iter()
            .map(|frame| hundredths(frame.crank_angle))
            .collect()
    };
    let start = 2.0 * std::f64::consts::TAU;
    let within = |all: Vec<i64>| -> Vec<i64> {
        all.iter()
            .map(|angle| angle.rem_euclid(hundredths(start)))
            .collect()
    };
    assert_eq!(within(angles(&a.frames)), within(angles(&b.frames)));
    assert_eq!(a.frames.len(), 24);
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let same = |what: &str, a: &[f64], b: &[f64]| {
        assert_eq!(a.len(), b.len());
        let scale = largest(b);
        for (a, b) in a.iter().zip(b) {
            assert!(
                (a - b).abs() < 2e-3 * scale,
                "{what}: {a} for {b} of {scale}"
            );
        }
    };
    for (a, b) in a.frames.iter().zip(&b.frames) {
        same("pressure", &a.field.pressure, &b.field.pressure);
        same("film", &a.field.film_thickness, &b.field.film_thickness);
    }
    same("worst", &a.worst.field.pressure, &b.worst.field.pressure);
    for (a, b) in [(&a.on_shell, &b.on_shell), (&a.on_journal, &b.on_journal)] {
        same("film", &a.minimum_film_thickness, &b.minimum_film_thickness);
        same("most", &a.maximum_pressure, &b.maximum_pressure);
        same("amplitude", &a.pressure_amplitude, &b.pressure_amplitude);
    }
    let (a, b) = (&shared.cycle.feed_flows, &alone.cycle.feed_flows);
    assert_eq!(a.len(), b.len());
    let most = b
        .iter()
        .flatten()
        .map(|one| one.flow.abs())
        .fold(0.0, f64::max);
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        assert!((a.flow - b.flow).abs() < 2e-3 * most);
    }
}

fn hundredths(angle: f64) -> i64 {
    (100.0 * angle.to_degrees()).round() as i64
}

/// The rows of the tables of `big-end-2`, number by number: over the largest of their column, and angles
/// apart from whole turns.
fn assert_same_tables(together: &Results, alone: &Results) {
    let rows = |results: &Results, file: &str| {
        let directory = tempfile::tempdir().unwrap();
        write_all(results, directory.path()).unwrap();
        let text = fs::read_to_string(directory.path().join(file)).unwrap();
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        let lines: Vec<Vec<String>> = lines
            .map(|line| line.split(',').map(str::to_owned).collect())
            .collect();
        lines
    };
    for file in ["loads-big-end-2.csv", "cycle-big-end-2.csv"] {
        let (a, b) = (rows(together, file), rows(alone, file));
        assert_eq!((a.len(), &a[0]), (b.len(), &b[0]), "{file}");
        for (column, name) in a[0].iter().enumerate() {
            let values = |rows: &[Vec<String>]| -> Vec<f64> {
                rows[1..]
                    .iter()
                    .map(|row| row[column].parse().unwrap_or(f64::NAN))
                    .collect()
            };
            let (a, b) = (values(&a), values(&b));
            let scale = b.iter().map(|value| value.abs()).fold(0.0, f64::max);
            // Solver counts and residuals are what they are; places jump between equal cells.
            let is_compared = [
                "load",
                "eccentricity",
                "film_thickness[",
                "pressure[",
                "power",
                "flow",
            ]
            .iter()
            .any(|part| name.contains(part));
            for (a, b) in a.iter().zip(&b).filter(|_| is_compared) {
                assert!((a - b).abs() <= 2e-3 * scale, "{file} {name}: {a} for {b}");
            }
        }
    }
}

/// Whatever makes bearings differ, they are solved by themselves.
#[test]
fn nothing_is_shared_where_bearings_differ() {
    let short = FilmModel::ShortBearing;
    let plan = only(&six(), &["big-end-1", "big-end-2", "big-end-6"]);
    assert_eq!(shared(&solved(plan.clone(), short)), 2);

    // 700 crank steps do not divide into thirds: only the cylinder that fires half a period later is alike.
    let mut odd = plan.clone();
    odd.orbit.crank_step = (720.0_f64 / 700.0).to_radians();
    let origins_of_odd = origins(&solved(odd, short));
    assert_eq!(
        origins_of_odd,
        [None, None, Some("big-end-1 shifted by 360 deg".to_owned())]
    );

    let mut wider = plan;
    wider.bearings[1].bearing.width *= 1.0 + 1e-6;
    assert_eq!(shared(&solved(wider, short)), 1);
}

/// A hole 2 deg further on one pin, or a journal that is not round, is another bearing at that crank
/// angle; a crowned journal turns into itself.
#[test]
fn what_turns_with_the_journal_counts() {
    let both = only(&six(), &["big-end-1", "big-end-2"]);
    let mut moved = with_pin_holes(both.clone());
    moved.orbit.crank_step = 5.0_f64.to_radians();
    let shared_with_hole = shared(&solved(moved.clone(), FilmModel::Field));
    assert_eq!(shared_with_hole, 1);
    moved.bearings[1].bearing.feeds[0].angle += 2.0_f64.to_radians();
    assert_eq!(shared(&solved(moved, FilmModel::Field)), 0);

    let shaped = |journal: Shape| {
        let mut plan = both.clone();
        plan.orbit.crank_step = 5.0_f64.to_radians();
        for bearing in &mut plan.bearings {
            bearing.bearing.journal = journal.clone();
        }
        shared(&solved(plan, FilmModel::Field))
    };
    let crowned = Shape::of([Feature::Crowning {
        end_offset: -1e-6,
        half_width: 0.017,
    }]);
    assert_eq!(shaped(crowned), 1);
    let lemon = Shape::of([Feature::Lemon {
        shift: -1e-6,
        joint: 0.3,
    }]);
    assert_eq!(shaped(lemon), 0);
}
