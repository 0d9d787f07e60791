//! Cases with a known answer: linear beams, single bearings, determinate and rigid shafts.

use crate::shafts::{
    CONDITIONS, STEEL, Spring, bending_stiffness, duty, plain_bearing, run, straight_shaft,
    two_bearing_shaft,
};
use nalgebra::DMatrix;
use sommerfeld_bearing::{
    CyclePoint, EquilibriumRequest, EquilibriumSettings, LoadCycle, LoadPoint, OrbitSettings,
    find_equilibrium, journal_orbit,
};
use sommerfeld_engine::{CoupledJournal, CoupledRequest, coupled_orbits, in_sequence};
use sommerfeld_film::{JournalState, Outcome, ShortBearingFilm};
use sommerfeld_flex::{CondensedShaft, Frame, Section};
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

const FOUR_SPANS: [f64; 9] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8];

/// Reactions of five springs under a unit force in the middle of the first of four spans of 0.2 m;
/// `ratio` is spring stiffness times L^3 / EI; half of each spring's compliance may be the support's.
fn spring_reactions(ratio: f64, supports_yield: bool) -> Vec<f64> {
    let diameter = 0.05;
    let shaft = straight_shaft(diameter, &FOUR_SPANS, &[0, 2, 4, 6, 8], &[1]);
    let stiffness = ratio * bending_stiffness(diameter) / 0.2_f64.powi(3);
    let share = if supports_yield { 2.0 } else { 1.0 };
    let mut films = vec![
        Spring {
            stiffness: share * stiffness
        };
        5
    ];
    let compliance = DMatrix::from_fn(20, 20, |row, column| {
        if row == column && row % 4 < 2 {
            0.5 / stiffness
        } else {
            0.0
        }
    });
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let duty = duty(100.0, 100.0, TAU);
    let settings = OrbitSettings {
        crank_step: 0.5,
        ..OrbitSettings::default()
    };
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
        forces: &|_| vec![[0.0, 1.0]],
        settings: &settings,
        executor: &in_sequence,
    };
    let found = coupled_orbits(journals, &request, &mut |_, _, _, _| {
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(found.outcome, Outcome::Converged);
    assert_eq!(found.orbits[0].cycles, 1);
    let last = found
        .orbits
        .iter()
        .map(|orbit| orbit.points.last().unwrap());
    last.map(|point| {
        assert!(point.load[0].abs() < 1e-12);
        point.load[1]
    })
    .collect()
}

/// A beam over four equal spans on springs; printed digits of an independent beam program.
#[test]
fn springs_for_films_are_a_beam_on_elastic_supports() {
    let table = [
        (100.0, [0.420, 0.668, -0.095, 0.007, 0.000]),
        (48.0, [0.435, 0.624, -0.050, -0.011, 0.002]),
        (10.0, [0.483, 0.491, 0.064, -0.030, -0.007]),
    ];
    for (ratio, expected) in table {
        for supports_yield in [false, true] {
            let found = spring_reactions(ratio, supports_yield);
            for (value, expected) in found.iter().zip(expected) {
                assert!(
                    (value - expected).abs() <= 5.001e-4,
                    "{ratio} {supports_yield}: {found:?}"
                );
            }
        }
    }
}

/// The cycle of Flores et al. 2006.
fn flores() -> LoadCycle {
    let path = format!(
        "{}/../../validation/flores-2006/load.csv",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let points = rows
        .map(|row| {
            let cells: Vec<f64> = row
                .split(',')
                .map(|cell| cell.trim().parse().unwrap())
                .collect();
            LoadPoint {
                crank_angle: cells[0].to_radians(),
                load: [cells[1], 0.0],
                ..duty(418.879, 209.4395, 4.0 * PI).points[0]
            }
        })
        .collect();
    LoadCycle {
        points,
        ..duty(418.879, 209.4395, 4.0 * PI)
    }
}

#[test]
fn two_equal_bearings_share_a_central_load_as_two_single_ones() {
    let cycle = flores();
    let bearing = plain_bearing(0.0635, 0.0254, 35.56e-6);
    let film = ShortBearingFilm::new(&bearing, 0.00416).unwrap();
    let settings = OrbitSettings::default();
    let single = journal_orbit(
        &mut film.clone(),
        &bearing,
        &cycle,
        &CONDITIONS,
        &settings,
        &mut |_, _, _| ControlFlow::Continue(()),
    )
    .unwrap();
    let table = sommerfeld_bearing::CycleTable::new(&cycle).unwrap();
    for diameter in [0.02, 0.06, 2.0] {
        let both = run(
            &mut [film.clone(), film.clone()],
            &bearing,
            &cycle,
            &two_bearing_shaft(diameter),
            &|angle| vec![table.at(angle).load.map(|force| 2.0 * force)],
            &settings,
        );
        assert_eq!(both.outcome, Outcome::Converged);
        assert!(both.resultant_error < 1e-8, "{:e}", both.resultant_error);
        let mut worst: f64 = 0.0;
        for orbit in &both.orbits {
            for (a, b) in orbit.points.iter().zip(&single.points) {
                assert!((a.crank_angle - b.crank_angle).abs() < 1e-12);
                for axis in 0..2 {
                    let apart = a.state.position[axis] - b.state.position[axis];
                    worst = worst.max(apart.abs() / bearing.radial_clearance);
                }
            }
        }
        // Each orbit is closed to 1e-4 of the clearance.
        assert!(worst < 2e-4, "{diameter}: {worst:e}");
        let cost = |solves: usize, orbit: &sommerfeld_bearing::JournalOrbit| {
            solves as f64 / ((orbit.points.len() - 1) * orbit.cycles) as f64
        };
        let first = &both.orbits[0];
        assert!(cost(first.film_solves, first) < 1.2 * cost(single.film_solves, &single) + 0.5);
    }
}

fn rest(bearing: &sommerfeld_film::Bearing, load: [f64; 2]) -> JournalState {
    let mut film = ShortBearingFilm::new(bearing, 0.01).unwrap();
    let request = EquilibriumRequest {
        load,
        moment: None,
        frame: JournalState {
            journal_speed: 300.0,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings::default(),
    };
    let found = find_equilibrium(&mut film, bearing, &request, &CONDITIONS).unwrap();
    assert_eq!(found.outcome, Outcome::Converged);
    found.state
}

/// On two bearings any shaft is determinate: the lever gives the loads.
#[test]
fn a_shaft_on_two_bearings_rests_as_the_lever_says() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let film = ShortBearingFilm::new(&bearing, 0.01).unwrap();
    let load = [300.0, -800.0];
    for diameter in [0.01, 0.05, 1.0] {
        let shaft = straight_shaft(diameter, &[0.0, 0.05, 0.2], &[0, 2], &[1]);
        let found = run(
            &mut [film.clone(), film.clone()],
            &bearing,
            &duty(300.0, 300.0, TAU),
            &shaft,
            &|_| vec![load],
            &OrbitSettings::default(),
        );
        assert_eq!(
            (found.outcome, found.orbits[0].cycles),
            (Outcome::Converged, 1)
        );
        for (orbit, share) in found.orbits.iter().zip([0.75, 0.25]) {
            let state = orbit.points.last().unwrap().state;
            let expected = rest(&bearing, load.map(|force| share * force));
            for axis in 0..2 {
                let apart = (state.position[axis] - expected.position[axis]).abs();
                assert!(
                    apart < 1e-6 * bearing.radial_clearance,
                    "{diameter}: {apart:e}"
                );
            }
        }
    }
}

const LOADS: [[f64; 2]; 2] = [[300.0, -800.0], [-200.0, -100.0]];

/// Three journals at rest on short bearings under [`LOADS`] in the middle of both spans of 0.1 m. The
/// shaft has this diameter, and another one for 1 mm on both sides of the middle journal.
fn three_at_rest(diameter: f64, diameter_at_middle: f64) -> Vec<CyclePoint> {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let film = ShortBearingFilm::new(&bearing, 0.01).unwrap();
    let mut frame = Frame::new();
    for z in [0.0, 0.05, 0.099, 0.1, 0.101, 0.15, 0.2] {
        frame.add_node([0.0, 0.0, z]);
    }
    for from in 0..6 {
        let diameter = if from == 2 || from == 3 {
            diameter_at_middle
        } else {
            diameter
        };
        let section = Section::circle(&STEEL, diameter, 0.0).without_shear();
        frame
            .add_beam([from, from + 1], section, [1.0, 0.0, 0.0])
            .unwrap();
    }
    frame.hold(6, 2).unwrap();
    frame.hold(6, 5).unwrap();
    let found = run(
        &mut [film.clone(), film.clone(), film.clone()],
        &bearing,
        &duty(300.0, 300.0, TAU),
        &CondensedShaft::from_frame(&frame, &[0, 3, 6], &[1, 5]).unwrap(),
        &|_| LOADS.to_vec(),
        &OrbitSettings::default(),
    );
    assert_eq!(found.outcome, Outcome::Converged);
    assert!(found.resultant_error < 1e-8, "{:e}", found.resultant_error);
    let points = found
        .orbits
        .iter()
        .map(|orbit| *orbit.points.last().unwrap());
    points.collect()
}

#[test]
fn a_stiff_shaft_stays_straight() {
    let points = three_at_rest(0.5, 0.5);
    for axis in 0..2 {
        let [a, b, c] = [0, 1, 2].map(|journal: usize| points[journal].state.position[axis]);
        let bend = (a - 2.0 * b + c).abs() / 25e-6;
        assert!(bend < 1e-4, "{bend:e}");
        // The moment of all forces about the first journal.
        let moment = 0.1 * points[1].reaction.film_force[axis]
            + 0.2 * points[2].reaction.film_force[axis]
            + 0.05 * LOADS[0][axis]
            + 0.15 * LOADS[1][axis];
        assert!(moment.abs() < 1e-8 * 0.2 * 800.0, "{moment:e}");
    }
}

/// Shares of a load in the middle of the first of two spans that reach the three journals.
fn carries(points: &[CyclePoint], shares: [f64; 3]) {
    for (journal, point) in points.iter().enumerate() {
        for axis in 0..2 {
            let expected = shares[journal] * LOADS[0][axis] + shares[2 - journal] * LOADS[1][axis];
            let error = (point.load[axis] - expected).abs() / 800.0;
            assert!(
                error < 1e-4,
                "{journal} {axis}: {:?} {expected}",
                point.load
            );
        }
    }
}

#[test]
fn stiff_films_are_rigid_supports_of_a_soft_shaft() {
    let shares = [13.0 / 32.0, 22.0 / 32.0, -3.0 / 32.0];
    carries(&three_at_rest(0.001, 0.001), shares);
}

#[test]
fn with_a_hinge_at_the_middle_journal_the_loads_are_determinate() {
    carries(&three_at_rest(0.03, 0.0005), [0.5, 0.5, 0.0]);
}
