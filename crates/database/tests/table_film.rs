//! A table as a film: what must hold whatever it was built from.
#![allow(clippy::panic, clippy::unwrap_used)]

mod common;

use common::{CONDITIONS, VISCOSITY, state, table, unit_bearing};
use sommerfeld_database::{Table, TableFilm};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Elasticity, Feed, FeedLine, FeedShape, FilmError, FilmForce,
    FilmShear, Inlet, JournalState, Linearised, Step,
};
use std::sync::{Arc, OnceLock};

const CLOSURE: Cavitation = Cavitation::Gumbel;

fn shared() -> Arc<Table> {
    static TABLE: OnceLock<Arc<Table>> = OnceLock::new();
    Arc::clone(TABLE.get_or_init(|| table(CLOSURE, 0.5, 5e-3)))
}

fn film() -> (Bearing, TableFilm) {
    let bearing = unit_bearing(CLOSURE, 0.5);
    let film = TableFilm::new(shared(), &bearing, VISCOSITY).unwrap();
    (bearing, film)
}

fn react(film: &mut TableFilm, state: &JournalState) -> Linearised {
    film.react(state, Step::Steady, &CONDITIONS).unwrap()
}

fn force(film: &mut TableFilm, state: &JournalState) -> [f64; 2] {
    react(film, state).reaction.film_force
}

#[test]
fn the_force_is_homogeneous_in_all_velocities() {
    let (bearing, mut film) = film();
    for k in 1..100 {
        let own = state(&bearing, k, 0.9999);
        let scaled = JournalState {
            velocity: own.velocity.map(|v| 3.0 * v),
            journal_speed: 3.0 * own.journal_speed,
            shell_speed: 3.0 * own.shell_speed,
            ..own
        };
        let [f, g] = [force(&mut film, &own), force(&mut film, &scaled)];
        for row in 0..2 {
            assert!(
                (3.0 * f[row] - g[row]).abs() < 1e-11 * f[0].hypot(f[1]),
                "{k}"
            );
        }
        // Euler: the derivatives by the effective velocity give the force back.
        let tangent = react(&mut film, &own).tangent;
        let mean = own.mean_speed();
        let w = [
            own.velocity[0] + mean * own.position[1],
            own.velocity[1] - mean * own.position[0],
        ];
        for row in 0..2 {
            let sum = tangent.by_rate[row][0] * w[0] + tangent.by_rate[row][1] * w[1];
            assert!((sum - f[row]).abs() < 1e-10 * f[0].hypot(f[1]), "{k}");
        }
    }
}

#[test]
fn turned_and_mirrored_states_have_turned_and_mirrored_forces() {
    let (bearing, mut film) = film();
    let turn = |[x, y]: [f64; 2]| [0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y];
    for k in 1..50 {
        let own = state(&bearing, k, 0.99);
        let turned = JournalState {
            position: turn(own.position),
            velocity: turn(own.velocity),
            ..own
        };
        let mirror = |[x, y]: [f64; 2]| [x, -y];
        let mirrored = JournalState {
            position: mirror(own.position),
            velocity: mirror(own.velocity),
            journal_speed: -own.journal_speed,
            shell_speed: -own.shell_speed,
            ..own
        };
        let f = force(&mut film, &own);
        let size = f[0].hypot(f[1]);
        for (found, expected) in [
            (force(&mut film, &turned), turn(f)),
            (force(&mut film, &mirrored), mirror(f)),
        ] {
            let off = (found[0] - expected[0]).hypot(found[1] - expected[1]);
            assert!(off < 1e-10 * size, "{k}: {off:e} of {size:e}");
        }
    }
}

#[test]
fn the_film_is_smooth_through_the_centre() {
    let (bearing, mut film) = film();
    let c = bearing.radial_clearance;
    let at = |x: f64, y: f64| JournalState {
        position: [x * c, y * c],
        velocity: [0.3 * c, -0.2 * c],
        ..JournalState::default()
    };
    let centre = react(&mut film, &at(0.0, 0.0));
    let size = centre.reaction.film_force[0].hypot(centre.reaction.film_force[1]);
    // It only resists.
    let f = centre.reaction.film_force;
    assert!((f[0] / 0.3 + f[1] / 0.2).abs() < 1e-6 * size);
    for [x, y] in [
        [1.0, 0.0],
        [0.0, 1.0],
        [-0.6, 0.8],
        [0.7, 0.7],
        [-1.0, -0.1],
    ] {
        let near = react(&mut film, &at(1e-5 * x, 1e-5 * y));
        for (row, f) in f.iter().enumerate() {
            let rise = [0, 1].map(|column: usize| centre.tangent.by_position[row][column] * c);
            let expected = f + 1e-5 * (rise[0] * x + rise[1] * y);
            assert!(
                (near.reaction.film_force[row] - expected).abs() < 1e-7 * size,
                "{x} {y}"
            );
            for column in 0..2 {
                let change =
                    near.tangent.by_position[row][column] - centre.tangent.by_position[row][column];
                assert!(
                    (change * c).abs() < 3e-4 * size,
                    "{x} {y} {row} {column}: {}",
                    change * c / size
                );
            }
        }
    }
}

/// Central differences over every place where pieces of the table meet: the centre, both ends of the direction,
/// nodes, and the last eccentricity.
#[test]
fn derivatives_are_those_of_differences_across_every_joint() {
    let (bearing, mut film) = film();
    let c = bearing.radial_clearance;
    let nodes = film.table().axes().eccentricity;
    let pi = std::f64::consts::PI;
    for (eps, angle) in [
        (1e-7, 0.7),
        (1e-5, 2.0),
        (1e-3, 1.0),
        (0.01, 1e-8),
        (0.5, 1e-9),
        (0.5, pi - 1e-9),
        (0.95, pi - 1e-7),
        (nodes.value(1) - 1e-9, 1.0),
        (nodes.value(5) + 1e-9, 1.0),
        (0.999 - 1e-9, 1.3),
        (0.999 + 1e-9, 2.3),
    ] {
        let own = JournalState {
            position: [0.6 * eps * c, 0.8 * eps * c],
            velocity: [
                c * (0.6 * f64::cos(angle) - 0.8 * f64::sin(angle)),
                c * (0.8 * f64::cos(angle) + 0.6 * f64::sin(angle)),
            ],
            ..JournalState::default()
        };
        let tangent = react(&mut film, &own).tangent;
        let step = 1e-5 * c * (1.0 - eps);
        let rate_step = 1e-5 * c * (1.0 - eps).sqrt();
        for (exact, by_rate, step) in [
            (tangent.by_position, false, step),
            (tangent.by_rate, true, rate_step),
        ] {
            let largest = exact
                .as_flattened()
                .iter()
                .fold(0.0_f64, |a, b| a.max(b.abs()));
            for column in 0..2 {
                let mut at = |ahead: f64| {
                    let mut moved = own;
                    let pair = if by_rate {
                        &mut moved.velocity
                    } else {
                        &mut moved.position
                    };
                    pair[column] += ahead;
                    force(&mut film, &moved)
                };
                let [near, far] = [1.0, 2.0].map(|k| (at(k * step), at(-k * step)));
                for (row, exact) in exact.iter().enumerate().take(2) {
                    let central = (8.0 * (near.0[row] - near.1[row]) - (far.0[row] - far.1[row]))
                        / (12.0 * step);
                    let off = (central - exact[column]).abs() / largest;
                    assert!(
                        off < 1e-6,
                        "{eps} {angle} {by_rate} {row} {column}: {off:.1e}"
                    );
                }
            }
        }
    }
}

#[test]
fn beyond_the_last_eccentricity_the_film_goes_on_smoothly_and_stiffens() {
    let (bearing, mut film) = film();
    let c = bearing.radial_clearance;
    let at = |eps: f64, angle: f64| JournalState {
        position: [eps * c, 0.0],
        velocity: [c * angle.cos(), c * angle.sin()],
        ..JournalState::default()
    };
    for k in -8..=8 {
        let angle = 0.39 * f64::from(k);
        let [before, after] =
            [0.999 - 1e-9, 0.999 + 1e-9].map(|eps| react(&mut film, &at(eps, angle)));
        for row in 0..2 {
            for column in 0..2 {
                let [a, b] = [&before, &after].map(|seen| seen.tangent.by_position[row][column]);
                let largest = before
                    .tangent
                    .by_position
                    .iter()
                    .flatten()
                    .fold(0.0, |m: f64, v| m.max(v.abs()));
                assert!(
                    (a - b).abs() < 1e-4 * largest,
                    "{angle} {row} {column}: {a} {b}"
                );
            }
        }
        for eps in [0.9992, 0.99999] {
            let f = force(&mut film, &at(eps, angle));
            assert!(f.iter().all(|f| f.is_finite()));
            assert!(
                f[0] * angle.cos() + f[1] * angle.sin() < 0.0,
                "{eps} {angle} {f:?}"
            );
        }
    }
    let closing = |film: &mut TableFilm, eps: f64| -force(film, &at(eps, 0.0))[0];
    let [last, beyond] = [0.999, 0.9999].map(|eps| closing(&mut film, eps));
    assert!(beyond > 20.0 * last, "{last} {beyond}");
}

#[test]
fn friction_and_power_close() {
    let (bearing, mut film) = film();
    for k in 1..30 {
        let own = state(&bearing, k, 0.95);
        let reaction = react(&mut film, &own).reaction;
        let summary = film.summary();
        let [x, y] = own.position;
        let couple = x * reaction.film_force[1] - y * reaction.film_force[0];
        let difference = reaction.friction_torque_journal - reaction.friction_torque_shell;
        assert!(
            (difference - couple).abs()
                < 1e-12 * reaction.friction_torque_journal.abs().max(couple.abs())
        );
        assert!(summary.peak_film_pressure.value > 0.0);
        assert!(
            (0.2..0.8).contains(&summary.full_film_share),
            "{}",
            summary.full_film_share
        );
        assert!(summary.side_flow[0] > 0.0 && summary.side_flow[0] == summary.side_flow[1]);
    }
}

#[test]
fn bearings_the_table_does_not_know_are_refused_by_name() {
    let good = unit_bearing(CLOSURE, 0.5);
    let feed = Feed {
        shape: FeedShape::Hole { diameter: 0.1 },
        carried_by: Carrier::Shell,
        angle: 0.0,
        position: 0.0,
        pressure: 1e5,
        line: FeedLine::Direct,
    };
    let cases = [
        (
            Bearing {
                cavitation: Cavitation::Reynolds,
                ..good.clone()
            },
            "closure",
        ),
        (
            Bearing {
                inlet: Inlet::MaxFilmLine { pressure: 0.0 },
                ..good.clone()
            },
            "inlet",
        ),
        (
            Bearing {
                feeds: vec![feed],
                ..good.clone()
            },
            "grooves and holes",
        ),
        (
            Bearing {
                ambient_pressure: 1e5,
                cavitation_pressure: 1e5,
                ..good.clone()
            },
            "pressure 0",
        ),
        (
            Bearing {
                elasticity: Elasticity::Layer {
                    thickness: 1e-3,
                    modulus: 1e9,
                    poisson: 0.3,
                },
                ..good.clone()
            },
            "rigid",
        ),
        (
            Bearing {
                film_shear: FilmShear::FilmFraction,
                ..good.clone()
            },
            "full-width",
        ),
        (
            Bearing {
                width: 1.1,
                ..good.clone()
            },
            "width ratios of the table",
        ),
    ];
    for (bearing, word) in cases {
        let error = TableFilm::new(shared(), &bearing, VISCOSITY)
            .unwrap_err()
            .to_string();
        assert!(error.contains(word), "{word}: {error}");
    }
    let mut film = TableFilm::new(shared(), &good, VISCOSITY).unwrap();
    let tilted = JournalState {
        tilt: [1e-5, 0.0],
        ..JournalState::default()
    };
    let closed = JournalState {
        position: [1.1e-3, 0.0],
        ..JournalState::default()
    };
    let mut refused = |state| film.react(&state, Step::Steady, &CONDITIONS).unwrap_err();
    assert_eq!(refused(tilted), FilmError::NoTilt);
    assert!(matches!(refused(closed), FilmError::Contact { .. }));
}
