//! Films between surfaces that are no cylinders: balances, turning profiles and tangents.
#![allow(clippy::unwrap_used)]

mod common;

use common::recomputed::{Offsets, Past, Recomputed, recompute_shaped};
use common::shaped::{
    CLOSURES, GRID, HALF, VISCOSITY, answers, bearing_at, bore_offset, crowning, deviation,
    journal_offset, shaped, solve, states,
};
use common::{big_end, conditions, feed_hole, oil};
use sommerfeld_film::{
    Bearing, Cavitation, Feature, FilmForce, FilmSolver, JournalState, Linearised, Shape, Step,
};

/// `int p d(bore - journal)/d(angle) dA` with the pressure of the cells.
fn profile_torque(film: &FilmSolver, rise: impl Fn(f64, f64, f64) -> f64) -> f64 {
    let (grid, field) = (film.grid(), film.field().unwrap());
    let (m, radius) = (grid.n_axial(), film.bearing().radius());
    let cavitation = film.bearing().cavitation_pressure;
    let mut sum = 0.0;
    for (k, p) in field.pressure.iter().enumerate() {
        let [from, to] = [k / m, k / m + 1].map(|i| grid.around_faces[i]);
        let width = radius * grid.axial_widths[k % m];
        // Over the area R d(angle) dz the rise is that from face to face.
        sum += (p - cavitation) * rise(from, to, radius * grid.axial[k % m]) * width * radius;
    }
    sum
}

fn assert_torques(name: &str, state: &JournalState, answer: &Linearised, by_profiles: f64) -> f64 {
    let r = &answer.reaction;
    let ([x, y], [fx, fy]) = (state.position, r.film_force);
    let ([tx, ty], [mx, my]) = (state.tilt, r.film_moment);
    let difference = r.friction_torque_journal - r.friction_torque_shell;
    let couple = x * fy - y * fx + tx * my - ty * mx;
    let scale = r.friction_torque_journal.abs().max(couple.abs());
    let error = (difference - couple + by_profiles).abs() / scale;
    assert!(
        error <= 1e-10,
        "{name}: {difference} {couple} {by_profiles}"
    );
    by_profiles.abs() / scale
}

fn assert_balances(name: &str, film: &FilmSolver, sum: &Recomputed) {
    assert_eq!(sum.violations, 0, "{name}");
    let scale = 1e-10 * sum.largest_flow;
    assert!(
        sum.worst_cell <= scale,
        "{name}: {:e} {:e}",
        sum.worst_cell,
        sum.largest_flow
    );
    let summary = film.summary();
    assert!((summary.storage_rate - sum.growth).abs() <= scale, "{name}");
    let power = summary.friction_power + summary.squeeze_power;
    let lost = sum.shear_loss + sum.pressure_loss + sum.reformation_loss;
    let error = (power - lost - sum.boundary_work).abs() / lost.max(power.abs());
    assert!(
        error <= 1e-10,
        "{name}: power {power}, lost {lost}, {error:e}"
    );
}

/// Oil in every cell, torque and power, against the gap written down once more.
#[test]
fn steady_films_balance() {
    let mut largest_share = 0.0_f64;
    for cavitation in [Cavitation::MassConserving, Cavitation::Reynolds] {
        for (how, state) in states() {
            let bearing = Bearing {
                cavitation,
                feeds: vec![feed_hole()],
                ..shaped()
            };
            let name = format!("{cavitation:?} {how}");
            let (film, answer) = solve(&bearing, &state);
            let journal = |angle: f64, z: f64| journal_offset(angle - state.journal_angle, z);
            let offsets = Offsets {
                bore: &bore_offset,
                journal: &journal,
            };
            let conserves = cavitation == Cavitation::MassConserving;
            let sum = recompute_shaped(&film, &state, VISCOSITY, conserves, Past::None, offsets);
            assert_balances(&name, &film, &sum);
            let widening = |angle: f64, z: f64| bore_offset(angle, z) - journal(angle, z);
            let torque = profile_torque(&film, |a, b, z| widening(b, z) - widening(a, z));
            largest_share = largest_share.max(assert_torques(&name, &state, &answer, torque));
            if conserves {
                assert!(film.summary().mass_balance_relative < 1e-10, "{name}");
            }
        }
    }
    assert!(largest_share > 0.005, "{largest_share}");
}

/// In time, with a journal that turns: the content at the end of each step is kept.
#[test]
fn implicit_steps_balance() {
    let (omega, duration) = (210.0, 2e-4);
    let bearing = Bearing {
        feeds: vec![feed_hole()],
        ..shaped()
    };
    let c = bearing.radial_clearance;
    let mut film = FilmSolver::new(&bearing, &oil(), GRID).unwrap();
    let mut content: Vec<f64> = Vec::new();
    let mut ruptured = 0;
    for step in 0..=60 {
        let t = f64::from(step) * duration;
        let place = |t: f64| {
            let angle = 0.6 * omega * t;
            [angle.cos(), angle.sin()].map(|d| (0.5 + 0.2 * (1.3 * omega * t).sin()) * c * d)
        };
        let (position, before) = (place(t), place(t - duration));
        let state = JournalState {
            position,
            velocity: [0, 1].map(|k: usize| (position[k] - before[k]) / duration),
            journal_speed: omega,
            journal_angle: omega * t,
            ..JournalState::default()
        };
        let after = 0.0;
        let kind = if step == 0 {
            Step::Steady
        } else {
            Step::Implicit { duration, after }
        };
        let answer = film.react(&state, kind, &conditions()).unwrap();
        assert!(answer.settled, "{step}");
        let past = if step == 0 {
            Past::None
        } else {
            Past::Content {
                old: &content,
                duration,
            }
        };
        let journal = |angle: f64, z: f64| journal_offset(angle - state.journal_angle, z);
        let offsets = Offsets {
            bore: &bore_offset,
            journal: &journal,
        };
        let sum = recompute_shaped(&film, &state, VISCOSITY, true, past, offsets);
        let name = format!("step {step}");
        assert_eq!(sum.violations, 0, "{name}");
        assert!(sum.worst_cell <= 1e-10 * sum.largest_flow, "{name}");
        let widening = |angle: f64, z: f64| bore_offset(angle, z) - journal(angle, z);
        let torque = profile_torque(&film, |a, b, z| widening(b, z) - widening(a, z));
        assert_torques(&name, &state, &answer, torque);
        ruptured += sum.ruptured;
        content = sum.content;
        film.accept_step();
    }
    assert!(ruptured > 0);
}

/// Seen from a frame that turns, both surfaces turn the other way, profiles included, and the film
/// is the same: squeeze of a turning profile and transport of a resting one are one thing.
#[test]
fn turning_frames() {
    for cavitation in [Cavitation::Gumbel, Cavitation::Reynolds] {
        for (how, state) in states() {
            let bearing = Bearing {
                cavitation,
                feeds: vec![feed_hole()],
                ..shaped()
            };
            let (film, first) = solve(&bearing, &state);
            for turning in [-300.0, 77.0, -state.journal_speed, -state.shell_speed] {
                let dragged = |rate: [f64; 2], of: [f64; 2]| {
                    [rate[0] - turning * of[1], rate[1] + turning * of[0]]
                };
                let seen = JournalState {
                    velocity: dragged(state.velocity, state.position),
                    tilt_rate: dragged(state.tilt_rate, state.tilt),
                    journal_speed: state.journal_speed + turning,
                    shell_speed: state.shell_speed + turning,
                    ..state
                };
                let (other, answer) = solve(&bearing, &seen);
                let worst = deviation(answers(&first), &answer);
                assert!(worst < 1e-9, "{cavitation:?} {how} {turning}: {worst:e}");
                let powers = [&film, &other].map(|f| f.summary().power_loss());
                assert!(
                    (powers[0] / powers[1] - 1.0).abs() < 1e-9,
                    "{how}: {powers:?}"
                );
            }
        }
    }
}

/// A turning journal's gap in time is the one it has when it has turned: after a small step the
/// content that the rate predicts differs by the second order.
#[test]
fn the_rate_is_that_of_the_turned_gap() {
    let bearing = shaped();
    let state = states()[1].1;
    let mean = |time: f64| {
        let moved = JournalState {
            journal_angle: state.journal_angle + time * state.journal_speed,
            shell_angle: time * state.shell_speed,
            position: [0, 1].map(|k: usize| state.position[k] + time * state.velocity[k]),
            tilt: [0, 1].map(|k: usize| state.tilt[k] + time * state.tilt_rate[k]),
            ..state
        };
        let (film, _) = solve(&bearing_at(&bearing, Cavitation::Gumbel), &moved);
        let field = film.field().unwrap();
        (field.film_thickness.to_vec(), film)
    };
    // Short: kinks that cross a face are an error of the first order in it.
    let d = 1e-9;
    let ((plus, _), (minus, _)) = (mean(d), mean(-d));
    let (_, film) = mean(0.0);
    let (grid, c) = (film.grid(), bearing.radial_clearance);
    let journal = |angle: f64, z: f64| journal_offset(angle - state.journal_angle, z);
    let m = grid.n_axial();
    for k in 0..plus.len() {
        let [from, to] = [k / m, k / m + 1].map(|i| grid.around_faces[i]);
        let z = bearing.radius() * grid.axial[k % m];
        let mean = [to.sin() - from.sin(), from.cos() - to.cos()].map(|v| v / (to - from));
        let velocity = [
            state.velocity[0] + z * state.tilt_rate[1],
            state.velocity[1] - z * state.tilt_rate[0],
        ];
        let rate = (state.journal_speed * (journal(to, z) - journal(from, z))
            - state.shell_speed * (bore_offset(to, z) - bore_offset(from, z)))
            / (to - from)
            - velocity[0] * mean[0]
            - velocity[1] * mean[1];
        let by = (plus[k] - minus[k]) / (2.0 * d);
        assert!((by - rate).abs() < 1e-5 * 200.0 * c, "{k}: {by} {rate}");
    }
}

/// Worst deviation of the tangents from central differences over each row's largest entry.
fn tangent_deviation(bearing: &Bearing, step: Step) -> f64 {
    let c = bearing.radial_clearance;
    let centre = JournalState {
        shell_speed: 0.0,
        ..states()[1].1
    };
    let mut film = FilmSolver::new(bearing, &oil(), [64, 16]).unwrap();
    if let Step::Implicit { duration, after } = step {
        let back = duration - after;
        let before = JournalState {
            position: [0, 1].map(|k: usize| centre.position[k] - back * centre.velocity[k]),
            tilt: [0, 1].map(|k: usize| centre.tilt[k] - back * centre.tilt_rate[k]),
            journal_angle: centre.journal_angle - back * centre.journal_speed,
            ..centre
        };
        film.react(&before, Step::Steady, &conditions()).unwrap();
        film.accept_step();
    }
    let tangent = film.react(&centre, step, &conditions()).unwrap().tangent;
    let mut worst = 0.0_f64;
    for (rates, analytic) in [(false, tangent.by_position), (true, tangent.by_rate)] {
        for column in 0..4 {
            let lever = if column < 2 { 1.0 } else { 1.0 / HALF };
            let by = 1e-6 * c * lever * if rates { 200.0 } else { 1.0 };
            let mut react = |sign: f64| {
                let mut moved = centre;
                let target = match (rates, column < 2) {
                    (false, true) => &mut moved.position,
                    (false, false) => &mut moved.tilt,
                    (true, true) => &mut moved.velocity,
                    (true, false) => &mut moved.tilt_rate,
                };
                target[column % 2] += sign * by;
                let [f, m] = answers(&film.react(&moved, step, &conditions()).unwrap());
                [f[0], f[1], m[0], m[1]]
            };
            let (plus, minus) = (react(1.0), react(-1.0));
            for row in 0..4 {
                let difference = (plus[row] - minus[row]) / (2.0 * by);
                let entries = analytic[row].iter().enumerate();
                let scale = entries.fold(1e-300_f64, |s, (k, v)| {
                    s.max(v.abs() * if k < 2 { 1.0 } else { 1.0 / HALF })
                });
                worst = worst.max((analytic[row][column] - difference).abs() * lever / scale);
            }
        }
    }
    worst
}

#[test]
fn tangents_equal_differences() {
    let offset = Bearing {
        bore: Shape::of([
            Feature::OffsetHalves {
                shift: 12e-6,
                joint: 0.0,
            },
            crowning(3e-6),
        ]),
        ..big_end()
    };
    for bearing in [shaped(), offset] {
        for cavitation in CLOSURES {
            for (duration, after) in [(0.0, 0.0), (1e-4, 0.0), (1e-4, 5e-5)] {
                let step = if duration == 0.0 {
                    Step::Steady
                } else {
                    Step::Implicit { duration, after }
                };
                let deviation = tangent_deviation(&bearing_at(&bearing, cavitation), step);
                let steps = bearing.bore.has_steps();
                assert!(
                    deviation < 2e-5,
                    "{cavitation:?} {step:?} {steps}: {deviation:e}"
                );
            }
        }
    }
}
