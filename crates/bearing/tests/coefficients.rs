//! Stiffness and damping: the reference table, an instant of an orbit, stability over speed.
#![allow(clippy::unwrap_used)]

mod common;

use common::{CONDITIONS, plain_bearing, table, text_table};
use sommerfeld_bearing::{
    Coefficients, EquilibriumRequest, EquilibriumSettings, Stability, find_equilibrium,
    instant_coefficients, stability_chart,
};
use sommerfeld_film::closed_form::short;
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Feed, FeedLine, FeedShape, FilmForce, FilmHistory, FilmShear,
    FilmSolver, Inlet, JournalState, Outcome, Reaction, ShortBearingFilm, Step,
};
use sommerfeld_oil::Lubricant;
use std::f64::consts::PI;
use std::ops::ControlFlow;

fn request(load: [f64; 2], journal_speed: f64) -> EquilibriumRequest {
    EquilibriumRequest {
        load,
        moment: None,
        frame: JournalState {
            journal_speed,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings::default(),
    }
}

/// Every row of validation/dynamic-coefficients/reference.csv on the default grid, within 1 % of the
/// largest of the row: the load of the row must rest at its eccentricity and attitude, too.
#[test]
fn plain_full_bearing_has_the_reference_coefficients() {
    let (speed, viscosity) = (200.0, 0.01);
    let oil = Lubricant::constant(viscosity, 850.0);
    let mut worst = (0.0, String::new());
    for row in text_table("dynamic-coefficients/reference.csv") {
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        let inlet = match row[1].as_str() {
            "cyclic" => Inlet::Cyclic,
            "hmax" => Inlet::MaxFilmLine { pressure: 0.0 },
            other => unreachable!("boundary {other}"),
        };
        let mut bearing = plain_bearing(0.1, 0.1 * number(0), 50e-6);
        bearing.cavitation = Cavitation::Reynolds;
        bearing.inlet = inlet;
        // So = F psi^2/(B D eta omega).
        let psi = bearing.relative_clearance();
        let load = number(4) * bearing.width * bearing.diameter * viscosity * speed / (psi * psi);
        let mut film = FilmSolver::new(&bearing, &oil, [256, 32]).unwrap();
        let found = find_equilibrium(
            &mut film,
            &bearing,
            &request([load, 0.0], speed),
            &CONDITIONS,
        )
        .unwrap();
        assert_eq!(found.outcome, Outcome::Converged, "{row:?}");
        let coefficients = Coefficients::from_tangent(&found.tangent);
        let stiffness = coefficients.translation_stiffness();
        let damping = coefficients.translation_damping();
        let unit = bearing.radial_clearance / load;
        for (matrix, unit, first) in [(stiffness, unit, 6), (damping, unit * speed, 10)] {
            let expected: Vec<f64> = (first..first + 4).map(number).collect();
            let largest = expected.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            for (got, expected) in matrix.iter().flatten().zip(&expected) {
                let off = (got * unit - expected).abs() / largest;
                if off > worst.0 {
                    worst = (off, format!("{row:?}: {matrix:?} times {unit}"));
                }
            }
        }
    }
    assert!(worst.0 < 0.01, "{worst:?}");
}

fn big_end() -> Bearing {
    let mut bearing = plain_bearing(0.072, 0.030, 36e-6);
    bearing.cavitation = Cavitation::MassConserving;
    bearing.film_shear = FilmShear::FilmFraction;
    bearing.feeds.push(Feed {
        shape: FeedShape::Hole { diameter: 6e-3 },
        carried_by: Carrier::Shell,
        angle: 0.6 * PI,
        position: 2e-3,
        pressure: 5e5,
        line: FeedLine::Direct,
    });
    bearing
}

fn components(reaction: &Reaction) -> [f64; 4] {
    let (force, moment) = (reaction.force(), reaction.moment());
    [force[0], force[1], moment[0], moment[1]]
}

/// The state with position (or rates) and tilt moved along one of the four coordinates.
fn nudged(state: &JournalState, rates: bool, column: usize, by: f64) -> JournalState {
    let mut moved = *state;
    let (linear, tilt) = if rates {
        (&mut moved.velocity, &mut moved.tilt_rate)
    } else {
        (&mut moved.position, &mut moved.tilt)
    };
    if column < 2 {
        linear[column] += by;
    } else {
        tilt[column - 2] += by;
    }
    moved
}

/// Force and moment of a film at `state` whose content is `instant`, with no time to flow.
fn force_at_once(film: &mut FilmSolver, state: &JournalState, instant: &FilmHistory) -> [f64; 4] {
    let duration = 1e-8;
    film.restore(instant);
    let step = Step::Implicit {
        duration,
        after: duration,
    };
    let answer = film.react(state, step, &CONDITIONS).unwrap();
    assert!(answer.settled && answer.outcome == Outcome::Converged);
    components(&answer.reaction)
}

/// The definition of stiffness and damping at an instant, by displacing the journal: the film keeps
/// its fraction everywhere, and has no time to flow. The film has a past that is far from
/// steady.
#[test]
fn coefficients_at_an_instant_are_what_displacing_the_journal_does() {
    let bearing = big_end();
    let (clearance, arm) = (bearing.radial_clearance, 0.5 * bearing.width);
    let oil = Lubricant::constant(8e-3, 850.0);
    let mut film = FilmSolver::new(&bearing, &oil, [64, 16]).unwrap();
    let mut state = JournalState {
        position: [0.5 * clearance, 0.2 * clearance],
        tilt: [0.1 * clearance / arm, -0.15 * clearance / arm],
        velocity: [20.0 * clearance, -35.0 * clearance],
        tilt_rate: [15.0 * clearance / arm, 10.0 * clearance / arm],
        journal_speed: 210.0,
        ..JournalState::default()
    };
    film.react(&state, Step::Steady, &CONDITIONS).unwrap();
    film.accept_step();
    let duration = 1e-4;
    for _ in 0..40 {
        for axis in 0..2 {
            state.position[axis] += duration * state.velocity[axis];
            state.tilt[axis] += duration * state.tilt_rate[axis];
        }
        // Turning, the path stays inside the clearance.
        let turn = 0.03_f64;
        let [vx, vy] = state.velocity;
        state.velocity = [
            vx * turn.cos() - vy * turn.sin(),
            vx * turn.sin() + vy * turn.cos(),
        ];
        state.tilt_rate = state.tilt_rate.map(|rate| 0.95 * rate);
        let mut middle = state;
        for axis in 0..2 {
            middle.position[axis] += 0.5 * duration * state.velocity[axis];
            middle.tilt[axis] += 0.5 * duration * state.tilt_rate[axis];
        }
        let step = Step::Implicit {
            duration,
            after: 0.5 * duration,
        };
        assert!(film.react(&middle, step, &CONDITIONS).unwrap().settled);
        film.accept_step();
    }
    let step = Step::Implicit {
        duration,
        after: 0.0,
    };
    for axis in 0..2 {
        state.position[axis] += duration * state.velocity[axis];
        state.tilt[axis] += duration * state.tilt_rate[axis];
    }
    film.react(&state, step, &CONDITIONS).unwrap();
    let instant = film.instant();
    let fraction = film.field().unwrap().film_fraction.to_vec();
    let ruptured = fraction.iter().filter(|theta| **theta < 1.0).count();
    let share = ruptured as f64 / fraction.len() as f64;
    assert!(share > 0.1 && share < 0.9, "{share}");

    let (found, outcome) = instant_coefficients(&mut film, &state, &instant, &CONDITIONS).unwrap();
    assert_eq!(outcome, Outcome::Converged);
    // The film around the instant, seen from outside.
    let lever = |index: usize| if index < 2 { 1.0 } else { arm };
    for rates in [false, true] {
        let matrix = if rates {
            found.damping
        } else {
            found.stiffness
        };
        let scale = matrix[..2]
            .iter()
            .flat_map(|row| &row[..2])
            .fold(0.0_f64, |a, b| a.max(b.abs()));
        for column in 0..4 {
            let by = 1e-5 * clearance / lever(column) * if rates { 200.0 } else { 1.0 };
            let mut force = |sign: f64| {
                let moved = nudged(&state, rates, column, sign * by);
                film.restore(&instant);
                film.react(
                    &moved,
                    Step::Implicit {
                        duration,
                        after: 0.0,
                    },
                    &CONDITIONS,
                )
                .unwrap();
                let gaps = film.field().unwrap().film_thickness.to_vec();
                let content = gaps.iter().zip(&fraction);
                let refilled = FilmHistory {
                    content: content
                        .map(|(gap, theta)| theta * gap / clearance)
                        .collect(),
                };
                force_at_once(&mut film, &moved, &refilled)
            };
            let (plus, minus) = (force(1.0), force(-1.0));
            for (row, values) in matrix.iter().enumerate() {
                let expected = -(plus[row] - minus[row]) / (2.0 * by);
                let got = values[column];
                let off = (got - expected).abs() / (lever(row) * lever(column));
                assert!(
                    off < 2e-4 * scale,
                    "rates {rates}, {row} {column}: {got} {expected}"
                );
            }
        }
    }
}

/// Without content there is no difference between an instant and a steady state with rates.
#[test]
fn a_film_without_memory_has_its_own_tangents_at_an_instant() {
    let mut bearing = big_end();
    bearing.cavitation = Cavitation::Reynolds;
    let oil = Lubricant::constant(8e-3, 850.0);
    let mut film = FilmSolver::new(&bearing, &oil, [48, 12]).unwrap();
    let state = JournalState {
        position: [15e-6, 8e-6],
        velocity: [1e-3, 2e-3],
        journal_speed: 210.0,
        ..JournalState::default()
    };
    let answer = film.react(&state, Step::Steady, &CONDITIONS).unwrap();
    let instant = film.instant();
    let (found, _) = instant_coefficients(&mut film, &state, &instant, &CONDITIONS).unwrap();
    assert_eq!(found, Coefficients::from_tangent(&answer.tangent));
}

/// The rotor of each row of validation/whirl-threshold begins to whirl at the speed of the row, found
/// between coarse speeds; below it is stable, above not.
#[test]
fn the_onset_over_speed_is_the_threshold_of_the_table() {
    let (speed, viscosity) = (300.0, 0.01);
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    for row in table("whirl-threshold/reference.csv") {
        let (eps, whirl_ratio, threshold) = (row[0], row[11], row[12]);
        let [along, across] = short::ocvirk_force(eps);
        let psi = bearing.relative_clearance();
        let unit = viscosity * speed * bearing.diameter * bearing.width / (4.0 * psi * psi);
        let load = along.hypot(across) * (bearing.width / bearing.diameter).powi(2) * unit;
        let mass = (threshold / speed).powi(2) * load / bearing.radial_clearance;
        let speeds = [0.5, 0.8, 0.9, 1.2, 1.7].map(|share| share * speed);
        let mut film = ShortBearingFilm::new(&bearing, viscosity).unwrap();
        let chart = stability_chart(
            &mut film,
            &bearing,
            &request([0.6 * load, -0.8 * load], speed),
            (&speeds, Some(mass)),
            &CONDITIONS,
            &mut |_| ControlFlow::Continue(()),
        )
        .unwrap();
        assert_eq!(chart.outcome, Outcome::Converged, "eps {eps}");
        let stable: Vec<bool> = chart
            .points
            .iter()
            .map(|point| point.stability.is_stable(mass))
            .collect();
        assert_eq!(stable, [true, true, true, false, false], "eps {eps}");
        let [onset] = chart.onsets[..] else {
            unreachable!("{:?}", chart.onsets)
        };
        assert!(onset.is_unstable_above);
        let error = onset.journal_speed / speed - 1.0;
        assert!(error.abs() < 1e-3, "eps {eps}: {error:e}");
        let ratio = onset.whirl_speed / onset.journal_speed;
        assert!(
            (ratio / whirl_ratio - 1.0).abs() < 1e-3,
            "eps {eps}: {ratio}"
        );
        // A point of the chart is the equilibrium that stands alone.
        let alone = find_equilibrium(
            &mut film,
            &bearing,
            &request([0.6 * load, -0.8 * load], speeds[3]),
            &CONDITIONS,
        )
        .unwrap();
        let Stability::Below(expected) =
            sommerfeld_bearing::rotor_stability(&Coefficients::from_tangent(&alone.tangent))
        else {
            unreachable!("eps {eps} has a threshold")
        };
        let found = chart.points[3].stability.threshold().unwrap();
        assert!((found.mass / expected.mass - 1.0).abs() < 1e-6);
    }
}
