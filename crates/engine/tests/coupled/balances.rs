//! What must hold for any shaft on any films: resultants, work, order of the steps, independence of
//! the executor, and refusals.

use crate::shafts::{
    CONDITIONS, duty, plain_bearing, run, run_with_offsets, straight_shaft, two_bearing_shaft,
};
use nalgebra::DMatrix;
use sommerfeld_bearing::{CyclePoint, JournalOrbit, OrbitSettings, journal_orbit};
use sommerfeld_engine::{
    CoupledJournal, CoupledOrbits, CoupledRequest, FilmExecutor, FilmUpdate, coupled_orbits,
    in_sequence,
};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Feed, FeedLine, FeedShape, FilmForce, FilmSolver, Outcome,
    ShortBearingFilm,
};
use sommerfeld_oil::Lubricant;
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

const JOURNALS: [f64; 3] = [0.0, 0.1, 0.2];
const LOADS: [f64; 2] = [0.04, 0.15];
const SPEED: f64 = 300.0;

fn shaft(diameter: f64) -> sommerfeld_flex::CondensedShaft {
    straight_shaft(diameter, &[0.0, 0.04, 0.1, 0.15, 0.2], &[0, 2, 4], &[1, 3])
}

/// Forces that turn and beat, x and y at both places of load.
fn forces(angle: f64) -> Vec<[f64; 2]> {
    let beat = 1.0 + 0.5 * (2.0 * angle).cos();
    vec![
        [900.0 * beat * angle.cos(), 900.0 * beat * angle.sin()],
        [300.0 - 500.0 * angle.sin(), -600.0 + 700.0 * angle.cos()],
    ]
}

fn oil() -> Lubricant {
    Lubricant::constant(0.01, 850.0)
}

fn reynolds_bearing() -> Bearing {
    Bearing {
        cavitation: Cavitation::Reynolds,
        ..plain_bearing(0.05, 0.02, 25e-6)
    }
}

fn field_films(bearing: &Bearing, count: usize) -> Vec<FilmSolver> {
    let film = |_| FilmSolver::new(bearing, &oil(), [32, 8]).unwrap();
    (0..count).map(film).collect()
}

fn degrees(step: f64) -> OrbitSettings {
    OrbitSettings {
        crank_step: step.to_radians(),
        ..OrbitSettings::default()
    }
}

/// The three journals on tilting films, with yielding supports or rigid ones.
fn tilting(executor: &FilmExecutor<'_>, supports_yield: bool, step: f64) -> CoupledOrbits {
    let bearing = reynolds_bearing();
    let mut films = field_films(&bearing, 3);
    let duty = duty(SPEED, SPEED, TAU);
    let compliance = DMatrix::from_fn(12, 12, |row, column| match (row % 4, column % 4) {
        _ if row / 4 != column / 4 => 0.0,
        (0, 0) => 4e-9,
        (1, 1) => 2e-9,
        (0, 1) | (1, 0) => 1e-9,
        (2, 2) | (3, 3) => 2e-5,
        _ => 0.0,
    });
    let settings = degrees(step);
    let shaft = shaft(0.04);
    let journals = films
        .iter_mut()
        .map(|film| CoupledJournal {
            film,
            bearing: &bearing,
            duty: &duty,
            conditions: CONDITIONS,
            offset: [0.0; 2],
        })
        .collect();
    let request = CoupledRequest {
        shaft: &shaft,
        compliance: supports_yield.then_some(&compliance),
        forces: &forces,
        settings: &settings,
        executor,
    };
    let found = coupled_orbits(journals, &request, &mut |_, _, _, _| {
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(found.outcome, Outcome::Converged);
    found
}

/// Forces and moments about the end of the shaft that are missing at a point of the cycle.
fn unbalance(orbits: &[JournalOrbit], index: usize) -> f64 {
    let angle = orbits[0].points[index].crank_angle;
    let mut sum = [0.0; 4];
    for (force, z) in forces(angle).iter().zip(LOADS) {
        let [x, y] = *force;
        sum = [sum[0] + x, sum[1] + y, sum[2] - z * y, sum[3] + z * x];
    }
    for (orbit, z) in orbits.iter().zip(JOURNALS) {
        let CyclePoint { load, moment, .. } = orbit.points[index];
        sum[0] -= load[0];
        sum[1] -= load[1];
        sum[2] -= moment[0] - z * load[1];
        sum[3] -= moment[1] + z * load[0];
    }
    sum[..2]
        .iter()
        .chain(sum[2..].iter())
        .fold(0.0, |m: f64, v| m.max(v.abs()))
}

#[test]
fn forces_and_moments_balance_at_every_crank_angle() {
    for supports_yield in [false, true] {
        let found = tilting(&in_sequence, supports_yield, 6.0);
        let count = found.orbits[0].points.len();
        let worst = (0..count).map(|index| unbalance(&found.orbits, index));
        let worst = worst.fold(0.0, f64::max);
        assert!(worst < 1e-8 * 1350.0, "{worst:e}");
        assert!(found.resultant_error < 1e-8, "{:e}", found.resultant_error);
        // What the films say agrees with it, and the journals do tilt.
        for point in found.orbits.iter().flat_map(|orbit| &orbit.points) {
            let force = point.reaction.force();
            let missing = [force[0] + point.load[0], force[1] + point.load[1]];
            assert!(missing[0].hypot(missing[1]) < 1e-4 * 1350.0, "{missing:?}");
        }
        let tilts = found.orbits[0]
            .points
            .iter()
            .map(|point| point.state.tilt[0].abs());
        assert!(tilts.fold(0.0, f64::max) > 1e-5);
        for (orbit, cycle) in found.orbits.iter().zip(&found.cycles) {
            assert_eq!(cycle.points.len() + 1, orbit.points.len());
            assert_eq!(cycle.points[3].load, orbit.points[3].load);
        }
    }
}

/// Sum over the cycle of a mean value times a change, J.
fn work(points: &[CyclePoint], force: impl Fn(&CyclePoint) -> [f64; 4]) -> f64 {
    let place = |point: &CyclePoint| {
        let ([x, y], [tilt_x, tilt_y]) = (point.state.position, point.state.tilt);
        [x, y, tilt_x, tilt_y]
    };
    let pairs = points.windows(2);
    pairs
        .map(|pair| {
            let (a, b) = (force(&pair[0]), force(&pair[1]));
            let (from, to) = (place(&pair[0]), place(&pair[1]));
            (0..4)
                .map(|i| 0.5 * (a[i] + b[i]) * (to[i] - from[i]))
                .sum::<f64>()
        })
        .sum()
}

/// The film's power is what the shaft does to it, and what all films take by squeeze is what the given
/// forces do to the shaft: bending gives back over a cycle what it takes.
#[test]
fn the_work_of_the_cycle_closes() {
    let found = tilting(&in_sequence, false, 2.0);
    let period = TAU / SPEED;
    let shaft = shaft(0.04);
    let (mut by_films, mut by_forces) = (0.0, 0.0);
    for (journal, orbit) in found.orbits.iter().enumerate() {
        let load = |point: &CyclePoint| {
            let ([x, y], [moment_x, moment_y]) = (point.load, point.moment);
            [x, y, moment_x, moment_y]
        };
        let moved = work(&orbit.points, load);
        let turned =
            period * orbit.mean(|p| p.reaction.friction_torque_journal * p.state.journal_speed);
        let lost = period * orbit.mean_power_loss();
        assert!(
            ((moved + turned) / lost - 1.0).abs() < 1e-3,
            "{moved} {turned} {lost}"
        );
        by_films += moved;
        by_forces += work(&orbit.points, |point| {
            let angle = point.crank_angle;
            let given = shaft.journal_loads(angle, &forces(angle));
            [0, 1, 2, 3].map(|axis| given[4 * journal + axis])
        });
    }
    assert!(
        (by_films / by_forces - 1.0).abs() < 1e-3,
        "{by_films} {by_forces}"
    );
}

#[test]
fn the_executor_does_not_matter() {
    let threads = |updates: &mut [FilmUpdate<'_>]| {
        std::thread::scope(|scope| {
            for update in updates.iter_mut().rev() {
                scope.spawn(move || update.run());
            }
        });
    };
    let idle = |_: &mut [FilmUpdate<'_>]| {};
    let expected = tilting(&in_sequence, true, 20.0);
    for executor in [&threads as &FilmExecutor<'_>, &idle] {
        assert_eq!(tilting(executor, true, 20.0), expected);
    }
}

/// Without error control the steps are of second order.
#[test]
fn halved_crank_steps_quarter_the_error() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let film = ShortBearingFilm::new(&bearing, 0.01).unwrap();
    let orbits = [6.0, 3.0, 1.5, 0.25].map(|step| {
        let settings = OrbitSettings {
            error_tolerance: f64::INFINITY,
            closure_tolerance: 1e-8,
            cycle_limit: 30,
            newton_tolerance: 1e-9,
            ..degrees(step)
        };
        let films = &mut [film.clone(), film.clone(), film.clone()];
        let duty = duty(SPEED, SPEED, TAU);
        let found = run(films, &bearing, &duty, &shaft(0.03), &forces, &settings);
        assert_eq!(found.outcome, Outcome::Converged);
        found.orbits
    });
    let error = |which: usize| {
        let mut worst: f64 = 0.0;
        for (orbit, exact) in orbits[which].iter().zip(&orbits[3]) {
            let every = (exact.points.len() - 1) / (orbit.points.len() - 1);
            for (index, point) in orbit.points.iter().enumerate() {
                let there = exact.points[every * index].state.position;
                let here = point.state.position;
                worst = worst.max((here[0] - there[0]).hypot(here[1] - there[1]));
            }
        }
        worst / bearing.radial_clearance
    };
    let errors = [error(0), error(1), error(2)];
    assert!(
        errors[0] / errors[1] > 3.2 && errors[1] / errors[2] > 3.2,
        "{errors:?}"
    );
    assert!(errors[2] < 1e-3, "{errors:?}");
}

/// The higher a bore stands against a load that presses down, the more it carries.
#[test]
fn a_raised_bore_takes_load_from_its_neighbours() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let film = ShortBearingFilm::new(&bearing, 0.01).unwrap();
    let mut before = f64::NEG_INFINITY;
    for offset in [-60e-6, -20e-6, -10e-6, 0.0, 10e-6, 20e-6, 60e-6] {
        let found = run_with_offsets(
            &mut [film.clone(), film.clone(), film.clone()],
            &bearing,
            &duty(SPEED, SPEED, TAU),
            &shaft(0.04),
            &|_| vec![[0.0, -800.0], [0.0, -800.0]],
            &degrees(10.0),
            &[[0.0; 2], [0.0, offset], [0.0; 2]],
        );
        assert_eq!(found.outcome, Outcome::Converged, "{offset}");
        let loads = found
            .orbits
            .iter()
            .map(|orbit| orbit.points.last().unwrap().load[1]);
        let loads: Vec<f64> = loads.collect();
        assert!((loads.iter().sum::<f64>() + 1600.0).abs() < 1e-5);
        assert!(-loads[1] > before + 10.0, "{offset}: {loads:?}");
        before = -loads[1];
    }
}

/// Films that remember: both bearings of a symmetric shaft run the orbit of a single one.
#[test]
fn films_with_history_orbit_as_a_single_one() {
    let bearing = Bearing {
        cavitation: Cavitation::MassConserving,
        feeds: vec![Feed {
            shape: FeedShape::Rectangle {
                length: 0.01,
                width: 0.014,
            },
            carried_by: Carrier::Shell,
            angle: 0.5 * PI,
            position: 0.0,
            pressure: 2e5,
            line: FeedLine::Direct,
        }],
        ..plain_bearing(0.05, 0.02, 25e-6)
    };
    let film = || FilmSolver::aligned(&bearing, &oil(), [32, 8]).unwrap();
    let load = |angle: f64| [600.0 * angle.cos(), -500.0 + 300.0 * angle.sin()];
    let mut cycle = duty(SPEED, SPEED, TAU);
    let row = cycle.points[0];
    cycle.points = (0..360)
        .map(|degree| {
            let crank_angle = f64::from(degree).to_radians();
            sommerfeld_bearing::LoadPoint {
                crank_angle,
                load: load(crank_angle),
                ..row
            }
        })
        .collect();
    let settings = degrees(2.0);
    let single = journal_orbit(
        &mut film(),
        &bearing,
        &cycle,
        &CONDITIONS,
        &settings,
        &mut |_, _, _| ControlFlow::Continue(()),
    )
    .unwrap();
    let both = run(
        &mut [film(), film()],
        &bearing,
        &cycle,
        &two_bearing_shaft(0.04),
        &|angle| vec![load(angle).map(|force| 2.0 * force)],
        &settings,
    );
    assert_eq!(
        (single.outcome, both.outcome),
        (Outcome::Converged, Outcome::Converged)
    );
    assert!(both.resultant_error < 1e-8, "{:e}", both.resultant_error);
    let mut worst: f64 = 0.0;
    for orbit in &both.orbits {
        for (a, b) in orbit.points.iter().zip(&single.points) {
            let (here, there) = (a.state.position, b.state.position);
            worst = worst.max((here[0] - there[0]).hypot(here[1] - there[1]));
        }
    }
    // Load tables are linear between their rows; steps are controlled to 5e-3 of the gap.
    assert!(worst < 5e-3 * bearing.radial_clearance, "{worst:e}");
}

#[test]
fn the_observer_sees_every_film_and_stops_the_run() {
    let bearing = reynolds_bearing();
    let mut films = field_films(&bearing, 2);
    let duty = duty(SPEED, SPEED, TAU);
    let shaft = two_bearing_shaft(0.04);
    let journals = films
        .iter_mut()
        .map(|film| CoupledJournal {
            film,
            bearing: &bearing,
            duty: &duty,
            conditions: CONDITIONS,
            offset: [0.0; 2],
        })
        .collect();
    let request = CoupledRequest {
        shaft: &shaft,
        compliance: None,
        forces: &|angle| vec![[800.0 * angle.cos(), -400.0]],
        settings: &degrees(10.0),
        executor: &in_sequence,
    };
    let mut seen = [0, 0];
    let found = coupled_orbits(journals, &request, &mut |journal, point, film, progress| {
        seen[journal] += 1;
        let peak = film.summary().peak_film_pressure;
        assert_eq!(peak, point.summary.peak_film_pressure);
        assert!(film.field().is_some());
        if progress.fraction < 0.25 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    })
    .unwrap();
    assert_eq!(found.outcome, Outcome::NotConverged);
    assert_eq!(seen, [10, 10]);
    assert_eq!(found.orbits[1].points.len(), 10);
}

#[test]
fn what_does_not_fit_is_refused() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let plain = duty(SPEED, SPEED, TAU);
    let slower = duty(SPEED, 0.5 * SPEED, TAU);
    let refused = |duties: &[&sommerfeld_bearing::LoadCycle],
                   compliance: Option<&DMatrix<f64>>,
                   force: f64| {
        let mut films: Vec<ShortBearingFilm> = duties
            .iter()
            .map(|_| ShortBearingFilm::new(&bearing, 0.01).unwrap())
            .collect();
        let journals = films
            .iter_mut()
            .zip(duties)
            .map(|(film, duty)| CoupledJournal {
                film: film as &mut (dyn FilmForce + Send),
                bearing: &bearing,
                duty,
                conditions: CONDITIONS,
                offset: [0.0; 2],
            })
            .collect();
        let request = CoupledRequest {
            shaft: &two_bearing_shaft(0.04),
            compliance,
            forces: &|_| vec![[force, 0.0]],
            settings: &OrbitSettings::default(),
            executor: &in_sequence,
        };
        let found = coupled_orbits(journals, &request, &mut |_, _, _, _| {
            ControlFlow::Continue(())
        });
        found.unwrap_err().to_string()
    };
    let small = DMatrix::zeros(4, 4);
    assert!(refused(&[&plain], None, 1.0).contains("one bearing"));
    assert!(refused(&[&plain, &plain, &plain], None, 1.0).contains("number of journals"));
    assert!(refused(&[&plain, &slower], None, 1.0).contains("agree in period"));
    assert!(refused(&[&plain, &plain], Some(&small), 1.0).contains("compliance"));
    assert!(refused(&[&plain, &plain], None, f64::NAN).contains("not finite"));
    assert!(refused(&[], None, 1.0).contains("needs a bearing"));
}
