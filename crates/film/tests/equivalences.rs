//! Two ways to the same film agree.
#![allow(
    clippy::unwrap_used,
    reason = "a test may stop at what it does not expect"
)]

mod common;

use common::{big_end, conditions, feed_hole, oil};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Feed, FeedLine, FeedShape, FilmForce, FilmSolver, JournalState,
    Step,
};

fn groove() -> Feed {
    Feed {
        shape: FeedShape::Circumferential { width: 4e-3 },
        carried_by: Carrier::Shell,
        angle: 0.0,
        position: 0.0,
        pressure: 2e5,
        line: FeedLine::Direct,
    }
}

fn close(a: f64, b: f64, scale: f64) -> bool {
    (a - b).abs() <= 1e-9 * scale.abs()
}

/// The half between one end and the mid-plane against the whole bearing, steady and in time.
#[test]
fn half_a_mirrored_film_is_the_whole() {
    for cavitation in [
        Cavitation::Gumbel,
        Cavitation::Reynolds,
        Cavitation::MassConserving,
    ] {
        for feed in [feed_hole(), groove()] {
            let bearing = Bearing {
                cavitation,
                feeds: vec![feed],
                ..big_end()
            };
            let c = bearing.radial_clearance;
            let mut whole = FilmSolver::new(&bearing, &oil(), [64, 16]).unwrap();
            let mut half = FilmSolver::aligned(&bearing, &oil(), [64, 16]).unwrap();
            assert!(!half.capabilities().accepts_tilt, "the half was not taken");
            for step in [
                Step::Steady,
                Step::Implicit {
                    duration: 2e-4,
                    after: 0.0,
                },
            ] {
                let shift = if step == Step::Steady { 0.0 } else { 2e-4 };
                let velocity = [30.0 * c, -50.0 * c];
                let state = JournalState {
                    position: [
                        0.6 * c + shift * velocity[0],
                        -0.4 * c + shift * velocity[1],
                    ],
                    velocity,
                    journal_speed: 210.0,
                    journal_angle: 0.3,
                    ..JournalState::default()
                };
                let a = whole.react(&state, step, &conditions()).unwrap();
                let b = half.react(&state, step, &conditions()).unwrap();
                assert!(a.settled && b.settled);
                let size = a.reaction.film_force[0].hypot(a.reaction.film_force[1]);
                for k in 0..2 {
                    assert!(close(
                        a.reaction.film_force[k],
                        b.reaction.film_force[k],
                        size
                    ));
                    for l in 0..2 {
                        let scale = a.tangent.by_position[0][0];
                        let (a, b) = (a.tangent.by_position[k][l], b.tangent.by_position[k][l]);
                        assert!(close(a, b, scale), "{cavitation:?} {step:?}: {a} {b}");
                    }
                }
                let torque = a.reaction.friction_torque_journal;
                assert!(close(torque, b.reaction.friction_torque_journal, torque));
                let (s, t) = (whole.summary(), half.summary());
                assert!(close(s.side_flow[1], t.side_flow[1], s.side_flow[1]));
                assert!(close(s.feed_flow, t.feed_flow, s.feed_flow));
                assert!(close(s.storage_rate, t.storage_rate, s.feed_flow));
                let peak = s.peak_film_pressure.value;
                assert!(close(peak, t.peak_film_pressure.value, peak * 1e3));
                let (f, g) = (whole.field().unwrap(), half.field().unwrap());
                assert_eq!(f.axial.len(), g.axial.len());
                for (p, q) in f.pressure.iter().zip(g.pressure) {
                    assert!(close(*p, *q, peak));
                }
                for (p, q) in whole.feed_flows().iter().zip(half.feed_flows()) {
                    assert!(close(p.flow, q.flow, s.feed_flow));
                }
                whole.accept_step();
                half.accept_step();
            }
        }
    }
}

/// A front that moved by a few cells: the film found on the factors of the set before it is that of an
/// elimination of its own, force, tangents, fields and flows.
#[test]
fn a_set_found_without_elimination_is_the_one_eliminated() {
    let bearing = Bearing {
        cavitation: Cavitation::Reynolds,
        feeds: vec![feed_hole()],
        ..big_end()
    };
    let c = bearing.radial_clearance;
    for is_half in [true, false] {
        let mut film = if is_half {
            FilmSolver::aligned(&bearing, &oil(), [64, 16]).unwrap()
        } else {
            FilmSolver::new(&bearing, &oil(), [64, 16]).unwrap()
        };
        let mut moved = 0;
        for k in 0..120 {
            let angle = 0.02 * f64::from(k);
            let tilt = if is_half { 0.0 } else { 1e-4 };
            let state = JournalState {
                position: [0.8 * c * angle.cos(), 0.8 * c * angle.sin()],
                velocity: [-40.0 * c * (3.0 * angle).sin(), 60.0 * c],
                tilt: [tilt * angle.cos(), tilt],
                journal_speed: 209.0,
                ..JournalState::default()
            };
            let before = film.set().clone();
            let found = film.linearise(&state, Step::Steady, &conditions()).unwrap();
            if !found.settled || *film.set() == before {
                continue;
            }
            moved += 1;
            let pressure = film.field().unwrap().pressure.to_vec();
            let summary = film.summary();
            let set = film.set().clone();
            let eliminated = film.linearise(&state, Step::Steady, &conditions()).unwrap();
            assert!(eliminated.settled && *film.set() == set);
            let size = |v: [f64; 2]| v[0].hypot(v[1]);
            let (a, b) = (found.reaction, eliminated.reaction);
            for axis in 0..2 {
                assert!(close(
                    a.film_force[axis],
                    b.film_force[axis],
                    size(b.film_force)
                ));
                let moment = size(b.film_moment);
                assert!(close(a.film_moment[axis], b.film_moment[axis], moment));
            }
            for (a, b) in [
                (found.tangent.by_position, eliminated.tangent.by_position),
                (found.tangent.by_rate, eliminated.tangent.by_rate),
            ] {
                for (a, b) in a.iter().zip(b) {
                    let scale = b.iter().fold(0.0_f64, |s, v| s.max(v.abs()));
                    for (a, b) in a.iter().zip(b) {
                        assert!(close(*a, b, scale), "{k}: {a} {b} {scale}");
                    }
                }
            }
            let peak = film.summary().peak_film_pressure.value;
            for (a, b) in pressure.iter().zip(film.field().unwrap().pressure) {
                assert!(close(*a, *b, peak));
            }
            let flow = film.summary().side_flow[0];
            assert!(close(summary.side_flow[0], flow, flow));
            assert!(close(summary.feed_flow, film.summary().feed_flow, flow));
            assert_eq!(summary.complementarity_violation, 0.0);
            assert!(summary.cell_residual < 1e-11, "{}", summary.cell_residual);
        }
        assert!(moved > 20, "{moved}");
    }
}
