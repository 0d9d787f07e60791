//! Journal orbits against closed forms and independent integrations.
#![allow(clippy::unwrap_used)]

mod common;

use common::{CONDITIONS, plain_bearing, table};
use sommerfeld_bearing::{
    JournalOrbit, LoadCycle, LoadPoint, OrbitSettings, OrbitStart, journal_orbit,
};
use sommerfeld_film::{Bearing, FilmForce, JournalState, MobilityFilm, Outcome, ShortBearingFilm};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// The one-axis cycle of Flores et al. 2006; the journal turns at 4000 rpm in a fixed shell while
/// the load cycle takes 720 degrees of a 2000 rpm engine.
fn flores() -> (Bearing, LoadCycle) {
    let points = table("flores-2006/load.csv")
        .iter()
        .map(|row| LoadPoint {
            crank_angle: row[0].to_radians(),
            load: [row[1], 0.0],
            moment: [0.0; 2],
            journal_speed: 2.0 * 209.439_510_239_319_5,
            shell_speed: 0.0,
        })
        .collect();
    let cycle = LoadCycle {
        points,
        period: 4.0 * PI,
        engine_speed: 209.439_510_239_319_5,
        journal_mass: 0.0,
    };
    (plain_bearing(0.0635, 0.0254, 35.56e-6), cycle)
}

fn run(
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    cycle: &LoadCycle,
    settings: &OrbitSettings,
) -> JournalOrbit {
    journal_orbit(
        film,
        bearing,
        cycle,
        &CONDITIONS,
        settings,
        &mut |_, _, _| ControlFlow::Continue(()),
    )
    .unwrap()
}

/// Position at a crank angle in degrees, linear between the points.
fn position_at(orbit: &JournalOrbit, degrees: f64) -> [f64; 2] {
    let first = orbit.points[0].crank_angle;
    let step = orbit.points[1].crank_angle - first;
    let place = (degrees.to_radians() - first).rem_euclid(4.0 * PI) / step;
    let index = (place.floor() as usize).min(orbit.points.len() - 2);
    let share = place - index as f64;
    let (a, b) = (&orbit.points[index].state, &orbit.points[index + 1].state);
    [0, 1].map(|i| a.position[i] + share * (b.position[i] - a.position[i]))
}

#[test]
fn flores_cycle_of_the_short_bearing() {
    let (bearing, cycle) = flores();
    let mut film = ShortBearingFilm::new(&bearing, 0.00416).unwrap();
    let orbit = run(&mut film, &bearing, &cycle, &OrbitSettings::default());
    assert_eq!(orbit.outcome, Outcome::Converged);
    let mut worst: f64 = 0.0;
    let (mut smallest, mut reference_smallest) = (f64::INFINITY, f64::INFINITY);
    for row in table("flores-2006/reference.csv") {
        let [x, y] = position_at(&orbit, row[0]);
        let gap = (bearing.radial_clearance - x.hypot(y)) * 1e6;
        worst = worst.max((gap / row[4] - 1.0).abs());
        smallest = smallest.min(gap);
        reference_smallest = reference_smallest.min(row[4]);
    }
    let steps = orbit.points.len() - 1;
    let per_step = orbit.film_solves as f64 / (steps * orbit.cycles) as f64;
    eprintln!(
        "worst deviation {worst:e}, minimum {smallest} against {reference_smallest}, {} cycles, \
         {} steps, {per_step:.2} film updates per crank step, closure {:e}",
        orbit.cycles, orbit.steps, orbit.closure
    );
    assert!(worst < 1e-3, "{worst}");
    assert!((smallest / reference_smallest - 1.0).abs() < 5e-4);
    assert!(per_step < 8.0);
}

#[test]
fn flores_cycle_of_bookers_mobility() {
    let (bearing, cycle) = flores();
    let mut exact = ShortBearingFilm::new(&bearing, 0.00416).unwrap();
    let exact = run(&mut exact, &bearing, &cycle, &OrbitSettings::default());
    let mut film = MobilityFilm::new(&bearing, 0.00416).unwrap();
    let orbit = run(&mut film, &bearing, &cycle, &OrbitSettings::default());
    assert_eq!(orbit.outcome, Outcome::Converged);
    let ratio = orbit.minimum_film_thickness().unwrap().0.value
        / exact.minimum_film_thickness().unwrap().0.value;
    eprintln!("Booker's minimum film over the exact one: {ratio}");
    assert!((ratio - 1.0).abs() < 0.05);
    assert!(orbit.mean_power_loss() > 0.0 && orbit.mean_side_flow() > 0.0);
}

#[test]
fn the_observer_stops_the_run() {
    let (bearing, cycle) = flores();
    let mut film = ShortBearingFilm::new(&bearing, 0.00416).unwrap();
    let orbit = journal_orbit(
        &mut film,
        &bearing,
        &cycle,
        &CONDITIONS,
        &OrbitSettings::default(),
        &mut |_, _, progress| {
            if progress.fraction < 0.5 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        },
    )
    .unwrap();
    assert_eq!(orbit.outcome, Outcome::NotConverged);
    assert_eq!(orbit.points.len(), 361);
}

fn constant(load: [f64; 2], speed: f64, mass: f64, turns: f64) -> LoadCycle {
    LoadCycle {
        points: vec![LoadPoint {
            crank_angle: 0.0,
            load,
            moment: [0.0; 2],
            journal_speed: speed,
            shell_speed: 0.0,
        }],
        period: turns * 2.0 * PI,
        engine_speed: speed,
        journal_mass: mass,
    }
}

#[test]
fn a_constant_load_stays_in_equilibrium_and_decays_to_it() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let mut film = ShortBearingFilm::new(&bearing, 0.01).unwrap();
    let cycle = constant([300.0, -400.0], 300.0, 0.0, 2.0);
    let resting = run(&mut film, &bearing, &cycle, &OrbitSettings::default());
    assert_eq!((resting.outcome, resting.cycles), (Outcome::Converged, 1));
    let rest = resting.points[0].state.position;

    let settings = OrbitSettings {
        start: OrbitStart::At(JournalState::default()),
        cycle_limit: 20,
        ..OrbitSettings::default()
    };
    let decayed = run(&mut film, &bearing, &cycle, &settings);
    assert_eq!(decayed.outcome, Outcome::Converged);
    let end = decayed.points[decayed.points.len() - 1].state.position;
    let distance = (end[0] - rest[0]).hypot(end[1] - rest[1]);
    assert!(distance < 1e-3 * bearing.radial_clearance, "{distance:e}");
}
