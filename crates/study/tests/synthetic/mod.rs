//! Made-up results that have the shape of real ones, for tests and for looking at the report.
//!
//! Simple formulas, no physics: orbit, film and power do not belong to the load. They exercise
//! every figure and table, nothing more.

#[allow(dead_code, reason = "not every test needs a machine")]
pub mod machine;
#[allow(dead_code, reason = "not every test needs rough surfaces")]
pub mod mixed;

use sommerfeld_bearing::{CyclePoint, JournalOrbit};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Ends, Extreme, Feed, FeedFlow, FeedLine, FeedShape, FilmShear,
    FilmSummary, Inlet, JournalState, Outcome, Reaction, Shape,
};
use sommerfeld_study::limits::{Limit, Quantity};
use sommerfeld_study::models;
use sommerfeld_study::results::{
    AccumulatedMap, Body, CycleField, CycleFields, CycleResults, DimensionlessResults,
    FieldSnapshot, Header, InputRow, Results, SteadyResults,
};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// Radial clearance of the made-up bearing, m.
const CLEARANCE: f64 = 36e-6;
/// Points of the made-up cycle, one per degree and the closing one.
const POINTS: usize = 721;

/// A bearing with a hole in the journal and an axial groove in the shell.
pub fn bearing() -> Bearing {
    Bearing {
        diameter: 0.072,
        width: 0.030,
        radial_clearance: CLEARANCE,
        bore: Shape::cylindrical(),
        journal: Shape::cylindrical(),
        feeds: vec![
            Feed {
                shape: FeedShape::Hole { diameter: 0.006 },
                carried_by: Carrier::Journal,
                angle: 0.5 * PI,
                position: 0.0,
                pressure: 5e5,
                line: FeedLine::Direct,
            },
            Feed {
                shape: FeedShape::Rectangle {
                    length: 0.010,
                    width: 0.018,
                },
                carried_by: Carrier::Shell,
                angle: 0.0,
                position: 0.0,
                pressure: 5e5,
                line: FeedLine::Direct,
            },
        ],
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Air,
        inlet: Inlet::Cyclic,
        cavitation: Cavitation::MassConserving,
        film_shear: FilmShear::FilmFraction,
        finish: sommerfeld_film::Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
    }
}

/// The header of made-up results.
pub fn header(analysis: &str, title: &str) -> Header {
    let row = |key: &str, value: &str| InputRow {
        key: key.into(),
        value: value.into(),
    };
    let mut used = vec![models::find("film", "field").unwrap()];
    used.extend(models::of_bearing(&bearing(), true));
    used.push(models::find("viscosity", "constant").unwrap());
    Header {
        analysis: analysis.into(),
        title: title.into(),
        status: Outcome::Converged,
        messages: Vec::new(),
        models: used,
        wall_time: 12.34,
        inputs: vec![
            row("bearing.diameter", "72 mm"),
            row("bearing.width", "30 mm"),
            row("bearing.diametral_clearance", "72 um"),
            row("oil.viscosity", "8 mPa.s"),
            row("film.model", "field"),
            row("film.cavitation", "mass-conserving"),
            row("film.grid", "[128, 32]"),
        ],
        study_text:
            "schema = 1\ntitle = \"Synthetic data\"\n\n[bearing]\ndiameter = \"72 mm\"  # <bore>\n"
                .into(),
        study_hash: Some("0123456789abcdef".into()),
        error: None,
        grid: Some([128, 32]),
        limits: Vec::new(),
        heat: None,
        plain: None,
        databases: Vec::new(),
        comparison: None,
    }
}

fn limits() -> [Limit; 2] {
    let limit = |quantity, value| Limit {
        quantity,
        value,
        source: "example of a house rule".into(),
    };
    [
        limit(Quantity::MinimumFilmThickness, 1.5e-6),
        limit(Quantity::PeakFilmPressure, 110e6),
    ]
}

/// A made-up load cycle.
pub fn load_cycle(title: &str) -> Results {
    let points: Vec<CyclePoint> = (0..POINTS).map(cycle_point).collect();
    let fields = cycle_fields(&points);
    let feed_flows = points
        .iter()
        .map(|point| {
            let flow = 0.5 * point.summary.feed_flow;
            vec![
                FeedFlow {
                    flow,
                    pressure: 5e5
                };
                2
            ]
        })
        .collect();
    let cycle = CycleResults {
        bearing: bearing(),
        orbit: JournalOrbit {
            points,
            cycles: 4,
            closure: 3.2e-5,
            steps: 2884,
            film_solves: 9120,
            outcome: Outcome::Converged,
        },
        feed_flows,
        fields: Some(fields),
        coefficients: Vec::new(),
        running_in: None,
    };
    let mut header = header("load-cycle", title);
    header.error = Some(BTreeMap::from([(
        "minimum_film_thickness_m".to_owned(),
        2.1e-8,
    )]));
    let mut results = Results {
        header,
        body: Body::LoadCycle(Box::new(cycle)),
    };
    results.check_limits(&limits());
    results
}

/// Fields every 10 deg of crank angle, and what the surfaces have seen of them.
fn cycle_fields(points: &[CyclePoint]) -> CycleFields {
    let at = |point: &CyclePoint| CycleField {
        crank_angle: point.crank_angle,
        field: field(&point.state, point.summary.peak_film_pressure.value),
    };
    let kept: Vec<&CyclePoint> = points.iter().step_by(10).take(72).collect();
    let frames: Vec<CycleField> = kept.iter().map(|point| at(point)).collect();
    let seen = |turned: fn(&CyclePoint) -> f64| {
        let instants: Vec<(f64, &FieldSnapshot)> = kept
            .iter()
            .zip(&frames)
            .map(|(point, frame)| (turned(point), &frame.field))
            .collect();
        accumulated(&instants)
    };
    CycleFields {
        worst: at(&points[371]),
        on_shell: seen(|_| 0.0),
        on_journal: seen(|point| point.state.journal_angle),
        frames,
    }
}

/// What the points of a surface that has turned by the given angles have seen of these fields.
fn accumulated(instants: &[(f64, &FieldSnapshot)]) -> AccumulatedMap {
    let first = instants[0].1;
    let (around, along) = (first.angles.len(), first.axial.len());
    let seen =
        |start: f64, value: &dyn Fn(&FieldSnapshot, usize) -> f64, join: fn(f64, f64) -> f64| {
            let cells = (0..around * along).map(|cell| {
                instants.iter().fold(start, |seen, (turned, field)| {
                    let shift = (turned / TAU * around as f64).round() as i64;
                    let from = (cell / along) as i64 + shift;
                    let from = from.rem_euclid(around as i64) as usize * along + cell % along;
                    join(seen, value(field, from))
                })
            });
            cells.collect::<Vec<f64>>()
        };
    let highest = seen(0.0, &|field, cell| field.pressure[cell], f64::max);
    let lowest = seen(f64::INFINITY, &|field, cell| field.pressure[cell], f64::min);
    let full = |field: &FieldSnapshot, cell: usize| {
        f64::from(u8::from(field.film_fraction[cell] >= 1.0)) / instants.len() as f64
    };
    AccumulatedMap {
        angles: first.angles.clone(),
        axial: first.axial.clone(),
        minimum_film_thickness: seen(
            f64::INFINITY,
            &|field, cell| field.film_thickness[cell],
            f64::min,
        ),
        pressure_amplitude: highest
            .iter()
            .zip(&lowest)
            .map(|(high, low)| 0.5 * (high - low))
            .collect(),
        maximum_pressure: highest,
        full_film_share: seen(0.0, &full, |sum, part| sum + part),
        wear: None,
    }
}

/// The same cycle with three steps that did not converge.
pub fn load_cycle_not_converged(title: &str) -> Results {
    let mut results = load_cycle(title);
    results.header.status = Outcome::NotConverged;
    results
        .header
        .messages
        .push("three steps did not converge (synthetic)".into());
    if let Body::LoadCycle(cycle) = &mut results.body {
        cycle.orbit.outcome = Outcome::NotConverged;
        for index in [370, 371, 372] {
            cycle.orbit.points[index].outcome = Outcome::NotConverged;
        }
    }
    results.check_limits(&limits());
    results
}

/// A smooth bump around a crank angle in degrees.
fn bump(angle: f64, centre: f64, width: f64) -> f64 {
    (-((angle - centre) / width).powi(2)).exp()
}

fn cycle_point(index: usize) -> CyclePoint {
    let degrees = index as f64;
    let turned = degrees.to_radians();
    let fire = bump(degrees, 372.0, 22.0);
    let load = [
        -9e3 + 6e3 * turned.cos() + 95e3 * fire,
        11e3 * turned.sin() + 2e3 * (2.0 * turned).sin() - 12e3 * fire,
    ];
    let size = (0.80 + 0.06 * (turned + 0.3).cos() + 0.08 * fire).min(0.99);
    let heading = load[1].atan2(load[0]) + 0.55 - 0.3 * fire;
    let position = [
        size * CLEARANCE * heading.cos(),
        size * CLEARANCE * heading.sin(),
    ];
    let state = JournalState {
        position,
        journal_speed: 209.0 + 50.0 * turned.cos(),
        journal_angle: turned,
        ..JournalState::default()
    };
    let summary = summary(&state, 20e6 + 120e6 * fire, turned);
    CyclePoint {
        crank_angle: turned,
        load,
        moment: [0.0; 2],
        state,
        reaction: Reaction {
            film_force: load.map(|component| -component),
            friction_torque_journal: summary.friction_power / state.journal_speed,
            friction_torque_shell: 0.9 * summary.friction_power / state.journal_speed,
            ..Reaction::default()
        },
        summary,
        outcome: Outcome::Converged,
    }
}

fn summary(state: &JournalState, peak: f64, turned: f64) -> FilmSummary {
    let thinnest = state.line_of_centres_angle();
    let side = 8e-6 + 3e-6 * (turned - 0.4).sin();
    let storage = 2e-6 * (2.0 * turned).cos();
    FilmSummary {
        minimum_film_thickness: Extreme {
            value: CLEARANCE - state.eccentricity(),
            angle: thinnest,
            axial: 0.0146,
        },
        edge_film_thickness: [CLEARANCE - state.eccentricity(); 2],
        peak_film_pressure: Extreme {
            value: peak,
            angle: thinnest - 0.25,
            axial: 0.0,
        },
        side_flow: [0.5 * side; 2],
        feed_flow: side + storage,
        storage_rate: storage,
        mass_balance_relative: 3e-13,
        peak_contact_pressure: Extreme::default(),
        contact_load: 0.0,
        boundary_power: 0.0,
        friction_power: 420.0 + 120.0 * turned.cos(),
        squeeze_power: 40.0 + 30.0 * (2.0 * turned).sin(),
        full_film_share: 0.58,
        complementarity_violation: 2e-14,
        cell_residual: 5e-12,
        iterations: 3,
        reynolds_number: 180.0,
    }
}

/// A bump of pressure ahead of the narrowest gap, a ruptured region behind it.
fn field(state: &JournalState, peak: f64) -> FieldSnapshot {
    field_on([128, 32], bearing().width, state, peak)
}

/// The same on a grid and over a width, m.
fn field_on(grid: [usize; 2], width: f64, state: &JournalState, peak: f64) -> FieldSnapshot {
    let [around, along] = grid;
    let angles: Vec<f64> = (0..around)
        .map(|i| (i as f64 + 0.5) * TAU / around as f64)
        .collect();
    let axial: Vec<f64> = (0..along)
        .map(|j| ((j as f64 + 0.5) / along as f64 - 0.5) * width)
        .collect();
    let mut snapshot = FieldSnapshot {
        pressure: Vec::new(),
        film_fraction: Vec::new(),
        film_thickness: Vec::new(),
        contact_pressure: Vec::new(),
        temperature: Vec::new(),
        angles: angles.clone(),
        axial: axial.clone(),
    };
    for angle in &angles {
        let behind = (angle - state.line_of_centres_angle()).rem_euclid(TAU);
        let ahead = if behind > PI { behind - TAU } else { behind };
        for z in &axial {
            let side = 1.0 - (2.0 * z / width).powi(2);
            let bump = (-((ahead + 0.25) / 0.3).powi(2)).exp() * side;
            let pressure = peak * (bump - 0.01).max(0.0) / 0.99;
            let is_ruptured = (0.15..2.4).contains(&ahead);
            let [x, y] = state.position;
            snapshot.pressure.push(pressure);
            snapshot
                .film_fraction
                .push(if is_ruptured && pressure == 0.0 {
                    0.35 + 0.2 * ahead + 0.1 * side
                } else {
                    1.0
                });
            snapshot
                .film_thickness
                .push(CLEARANCE - x * angle.cos() - y * angle.sin());
        }
    }
    snapshot
}

/// A made-up equilibrium with stiffness and damping.
pub fn steady(title: &str) -> Results {
    let eccentricity = 0.72 * CLEARANCE;
    let state = JournalState {
        position: [eccentricity * 0.8, eccentricity * 0.6],
        journal_speed: 209.44,
        ..JournalState::default()
    };
    let load = [10e3, 0.0];
    let steady = SteadyResults {
        bearing: bearing(),
        load: Some(load),
        reaction: Reaction {
            film_force: [-10e3, 0.0],
            friction_torque_journal: 0.912,
            friction_torque_shell: 0.756,
            ..Reaction::default()
        },
        summary: summary(&state, 141e6, 0.0),
        feed_flows: vec![FeedFlow {
            flow: 8.8e-6,
            pressure: 5e5,
        }],
        sommerfeld_number: 2.763,
        iterations: 7,
        stiffness: Some([[8.12e8, 3.4e8], [-1.27e9, 2.05e9]]),
        damping: Some([[1.94e6, -1.1e6], [-1.1e6, 5.2e6]]),
        dynamics: None,
        field: Some(field(&state, 141e6)),
        state,
    };
    let mut results = Results {
        header: header("coefficients", title),
        body: Body::Steady(Box::new(steady)),
    };
    results.check_limits(&limits());
    results
}

/// A made-up answer to the dimensionless problem.
pub fn dimensionless(title: &str) -> Results {
    let mut header = header("film", title);
    header.error = Some(BTreeMap::from([("integrals.p_cos".to_owned(), 1.5e-4)]));
    Results {
        header,
        body: Body::Dimensionless(DimensionlessResults {
            p_cos: -1.25,
            p_sin: 2.5,
            p_z_cos: 0.0625,
            p_z_sin: -0.125,
            peak: 3.5,
        }),
    }
}
