//! Made-up engines and shafts: the shape of real results, no physics.

use super::{CLEARANCE, accumulated, bearing, bump, field_on, header, limits, summary};
use sommerfeld_bearing::{CyclePoint, CycleTilt, JournalOrbit, LoadCycle, LoadPoint};
use sommerfeld_engine::{Harmonic, Performance, Role, TorsionResponse, Twist};
use sommerfeld_film::{Bearing, JournalState, Outcome, Reaction};
use sommerfeld_study::results::machine::{BearingResults, MachineResults, SpeedResults};
use sommerfeld_study::results::{
    Body, CycleField, CycleFields, CycleResults, FieldSnapshot, Results,
};
use std::f64::consts::{PI, TAU};

/// Points of a made-up cycle of an engine: one per degree and the closing one.
const POINTS: usize = 721;
/// Cells of its films.
const GRID: [usize; 2] = [64, 16];

/// An inline six with seven mains and six big ends at `speeds` speeds from 1000 rpm, each with its
/// films where `with_fields` says so. The mains are elastic and tilt.
pub fn inline_six(title: &str, speeds: usize, with_fields: bool) -> Results {
    let at = |index: usize| {
        let rpm = 1000.0 + 250.0 * index as f64;
        let mains = (0..7).map(|main| one(Role::Main, main, rpm, with_fields));
        let big_ends = (0..6).map(|rod| one(Role::BigEnd, rod, rpm, with_fields));
        SpeedResults {
            speed: rpm * PI / 30.0,
            outcome: Outcome::Converged,
            performance: Some(performance(rpm)),
            torsion: Some(torsion(rpm)),
            bearings: mains.chain(big_ends).collect(),
            friction_mean_effective_pressure: Some(15e3 + 4.0 * rpm),
        }
    };
    results(
        "engine",
        title,
        MachineResults {
            load_model:
                "elastic crankshaft on films and elastic supports (statically indeterminate)".into(),
            speeds: (0..speeds).map(at).collect(),
        },
    )
}

/// A shaft with two bearings at one speed, without films.
pub fn shaft(title: &str) -> Results {
    let speed = 3000.0;
    let mut bearings: Vec<BearingResults> = (0..2)
        .map(|index| one(Role::Shaft, index, speed, false))
        .collect();
    for bearing in &mut bearings {
        bearing.determinate_load = None;
    }
    results(
        "shaft",
        title,
        MachineResults {
            load_model: "statically determinate: two bearings".into(),
            speeds: vec![SpeedResults {
                speed: speed * PI / 30.0,
                outcome: Outcome::Converged,
                performance: None,
                torsion: None,
                bearings,
                friction_mean_effective_pressure: None,
            }],
        },
    )
}

fn results(analysis: &str, title: &str, machine: MachineResults) -> Results {
    let mut results = Results {
        header: header(analysis, title),
        body: Body::Machine(Box::new(machine)),
    };
    results.check_limits(&limits());
    results
}

/// One bearing of the made-up machine at one speed.
fn one(role: Role, index: usize, rpm: f64, with_fields: bool) -> BearingResults {
    let is_big_end = role == Role::BigEnd;
    let own = Bearing {
        width: if is_big_end { 0.030 } else { 0.028 },
        diameter: if is_big_end { 0.072 } else { 0.085 },
        ..bearing()
    };
    let firing = (120.0 * index as f64 + 10.0).rem_euclid(720.0);
    let points: Vec<CyclePoint> = (0..POINTS)
        .map(|degree| point(degree as f64, firing, role, rpm))
        .collect();
    let determinate = points
        .iter()
        .map(|point| [1.15 * point.load[0] - 2e3, 0.9 * point.load[1]])
        .collect();
    let given = points
        .iter()
        .step_by(4)
        .take(180)
        .map(|point| LoadPoint {
            crank_angle: point.crank_angle,
            load: point.load,
            moment: [0.0; 2],
            journal_speed: point.state.journal_speed,
            shell_speed: 0.0,
        })
        .collect();
    let fields = with_fields.then(|| fields(&own, &points));
    BearingResults {
        name: format!("{}-{}", role.name(), index + 1),
        role,
        index,
        load: LoadCycle {
            points: given,
            period: 2.0 * TAU,
            engine_speed: rpm * PI / 30.0,
            journal_mass: 0.0,
            tilt: CycleTilt::Aligned,
            feed_pressures: Vec::new(),
        },
        turned_from: None,
        heat: None,
        determinate_load: (role == Role::Main).then_some(determinate),
        cycle: CycleResults {
            bearing: own,
            orbit: JournalOrbit {
                points,
                cycles: 3,
                closure: 4e-5,
                steps: 2163,
                film_solves: 7000,
                outcome: Outcome::Converged,
            },
            feed_flows: Vec::new(),
            fields,
            coefficients: Vec::new(),
            running_in: None,
        },
    }
}

fn point(degrees: f64, firing: f64, role: Role, rpm: f64) -> CyclePoint {
    let turned = degrees.to_radians();
    let fire = bump(degrees, firing, 24.0)
        + bump(degrees, firing - 720.0, 24.0)
        + bump(degrees, firing + 720.0, 24.0);
    let inertia = (rpm / 2000.0).powi(2);
    let load = [
        inertia * (-8e3 + 7e3 * turned.cos()) - 70e3 * fire,
        inertia * (9e3 * turned.sin() + 2e3 * (2.0 * turned).sin()) + 9e3 * fire,
    ];
    let size = (0.78 + 0.05 * inertia + 0.05 * (turned + 0.3).cos() + 0.09 * fire).min(0.985);
    let heading = load[1].atan2(load[0]) + 0.5 - 0.3 * fire;
    let tilt = if role == Role::Main { 2e-4 } else { 0.0 };
    let state = JournalState {
        position: [
            size * CLEARANCE * heading.cos(),
            size * CLEARANCE * heading.sin(),
        ],
        tilt: [tilt * fire, -0.4 * tilt * turned.sin()],
        journal_speed: rpm * PI / 30.0
            * (1.0
                + if role == Role::BigEnd {
                    0.3 * turned.cos()
                } else {
                    0.0
                }),
        journal_angle: turned,
        ..JournalState::default()
    };
    let summary = summary(&state, 15e6 + 90e6 * fire + 8e6 * inertia, turned);
    CyclePoint {
        crank_angle: turned,
        load,
        moment: [0.0; 2],
        reaction: Reaction {
            film_force: load.map(|component| -component),
            friction_torque_journal: summary.friction_power / state.journal_speed,
            ..Reaction::default()
        },
        state,
        summary,
        outcome: Outcome::Converged,
    }
}

fn fields(bearing: &Bearing, points: &[CyclePoint]) -> CycleFields {
    let at = |point: &CyclePoint| CycleField {
        crank_angle: point.crank_angle,
        field: field_on(
            GRID,
            bearing.width,
            &point.state,
            point.summary.peak_film_pressure.value,
        ),
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
    let worst = points
        .iter()
        .min_by(|a, b| {
            let film = |point: &CyclePoint| point.summary.minimum_film_thickness.value;
            film(a).total_cmp(&film(b))
        })
        .unwrap();
    CycleFields {
        worst: at(worst),
        on_shell: seen(|_| 0.0),
        on_journal: seen(|point| point.state.journal_angle),
        frames,
    }
}

fn orders(amplitudes: &[(f64, f64)]) -> Vec<Harmonic> {
    amplitudes
        .iter()
        .map(|&(order, amplitude)| Harmonic {
            order,
            cos: 0.8 * amplitude,
            sin: 0.6 * amplitude,
        })
        .collect()
}

fn performance(rpm: f64) -> Performance {
    let angles: Vec<f64> = (0..720)
        .map(|degree| f64::from(degree).to_radians())
        .collect();
    let swept = 1.2e-3;
    let volume = |angle: f64| 0.5 * swept * (1.0 - angle.cos());
    let clearance = swept / 16.0;
    let pressure = |angle: f64| {
        let compressed = (swept + clearance) / (volume(angle) + clearance);
        let degrees = angle.to_degrees();
        if (180.0..540.0).contains(&degrees) {
            1.5e5
        } else {
            let fired = if degrees < 180.0 { 1.6 } else { 1.0 };
            1.5e5 * fired * compressed.powf(1.33)
        }
    };
    let gas: Vec<f64> = angles
        .iter()
        .map(|a| 900.0 + 1400.0 * (3.0 * a).sin())
        .collect();
    let inertia = (rpm / 2000.0).powi(2);
    Performance {
        gas_pressure: angles.iter().map(|a| pressure(*a)).collect(),
        displaced_volume: angles.iter().map(|a| volume(*a)).collect(),
        torque: angles
            .iter()
            .zip(&gas)
            .map(|(a, gas)| gas + 500.0 * inertia * (6.0 * a).sin())
            .collect(),
        gas_torque: gas,
        mean_torque: 900.0,
        indicated_mean_effective_pressure: 15.7e5,
        swept_volume: 6.0 * swept,
        shaking_force: vec![[1e-9, 1e-10]; 720],
        shaking_moment: vec![[0.0; 2]; 720],
        side_thrust: vec![angles.iter().map(|a| 4e3 * a.sin()).collect(); 6],
        torque_orders: orders(&[
            (3.0, 1400.0),
            (4.5, 300.0),
            (6.0, 500.0 * inertia),
            (9.0, 80.0),
        ]),
        force_orders: [
            orders(&[(1.0, 1e-10), (2.0, 2e-10)]),
            orders(&[(1.0, 1e-10)]),
        ],
        moment_orders: [orders(&[(1.0, 40.0), (2.0, 12.0)]), orders(&[(1.0, 35.0)])],
        crank_angles: angles,
    }
}

fn torsion(rpm: f64) -> TorsionResponse {
    let near = 1.0 / (1.0 + ((rpm - 2160.0) / 300.0).powi(2));
    let twist = |scale: f64| Twist {
        harmonics: orders(&[
            (3.0, 2e-3 * scale),
            (4.5, 1e-3 * scale),
            (6.0, (4e-4 + 5e-3 * near) * scale),
        ]),
    };
    let discs = 8;
    TorsionResponse {
        natural_frequencies: vec![0.0, 216.6, 592.7, 984.9],
        modes: vec![vec![1.0; discs]; 4],
        twists: (0..discs)
            .map(|disc| twist(1.0 - 1.1 * disc as f64 / 7.0))
            .collect(),
        link_torques: (1..discs).map(|_| twist(3e5)).collect(),
        disc_heat: vec![3.0; discs],
        load_torque: 900.0,
        link_heat: (1..discs).map(|link| 12.0 * link as f64).collect(),
    }
}
