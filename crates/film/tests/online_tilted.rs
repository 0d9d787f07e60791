//! The on-line film of a tilting journal against films on a grid, the aligned film and identities.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "helpers of tests stop at the first surprise; --nocapture shows the figures"
)]

mod common;

use common::conditions;
use sommerfeld_film::{
    Bearing, Cavitation, FilmError, FilmForce, FilmShear, FilmSolver, JournalState, Linearised,
    OnlineFilm, Outcome, Step,
};
use sommerfeld_oil::Lubricant;
use std::f64::consts::TAU;

const VISCOSITY: f64 = 8e-3;
const SPEED: f64 = 200.0;

fn bearing(width_ratio: f64) -> Bearing {
    Bearing {
        width: 0.072 * width_ratio,
        cavitation: Cavitation::Gumbel,
        film_shear: FilmShear::FullWidth,
        ..common::big_end()
    }
}

fn oil() -> Lubricant {
    Lubricant::constant(VISCOSITY, 850.0)
}

fn online(bearing: &Bearing) -> OnlineFilm {
    OnlineFilm::new(bearing, &oil()).expect("a plain bearing")
}

fn react(film: &mut impl FilmForce, state: &JournalState) -> Linearised {
    let seen = film.react(state, Step::Steady, &conditions());
    let seen = seen.expect("an open gap");
    assert_eq!(seen.outcome, Outcome::Converged);
    seen
}

/// A journal whose centre is at `eps` in the direction `place`, tilted so that its centre moves on by
/// `slant` clearances in the direction `lean` up to the rear end, squeezed and tilting on.
fn tilted(bearing: &Bearing, [eps, place]: [f64; 2], [slant, lean]: [f64; 2]) -> JournalState {
    let c = bearing.radial_clearance;
    let angle = 2.0 * c * slant / bearing.width;
    let rate = SPEED * c;
    JournalState {
        position: [eps * c * place.cos(), eps * c * place.sin()],
        tilt: [-angle * lean.sin(), angle * lean.cos()],
        velocity: [0.1 * rate, -0.05 * rate],
        tilt_rate: [0.05 * rate / bearing.width, 0.1 * rate / bearing.width],
        journal_speed: 1.2 * SPEED,
        shell_speed: -0.1 * SPEED,
        ..JournalState::default()
    }
}

/// Smallest gap at 1 - eps - slant where the tilt lies in the plane of the line of centres.
const STATES: [([f64; 2], [f64; 2]); 8] = [
    ([0.0, 0.0], [0.5, 1.0]),
    ([0.0, 0.0], [0.95, 2.0]),
    ([0.3, 0.4], [0.2, 0.4]),
    ([0.6, 2.0], [0.3, 3.6]),
    ([0.5, 4.0], [0.45, 4.0]),
    ([0.85, 1.0], [0.10, 1.0]),
    ([0.85, 5.0], [0.35, 6.6]),
    ([0.9, 3.0], [0.0, 0.0]),
];

fn size([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

fn difference(a: [f64; 2], b: [f64; 2]) -> f64 {
    size([a[0] - b[0], a[1] - b[1]])
}

/// Errors of force and moment over the force and its lever of half the width.
fn errors(bearing: &Bearing, seen: &Linearised, exact: &Linearised) -> [f64; 2] {
    let (seen, exact) = (&seen.reaction, &exact.reaction);
    let scale = size(exact.film_force);
    [
        difference(seen.film_force, exact.film_force) / scale,
        difference(seen.film_moment, exact.film_moment) / (0.5 * bearing.width * scale),
    ]
}

/// Components by row: forces and moments, or places and tilts.
fn parts(seen: &Linearised) -> [f64; 4] {
    let ([x, y], [about_x, about_y]) = (seen.reaction.film_force, seen.reaction.film_moment);
    [x, y, about_x, about_y]
}

fn shift(pair: (&mut [f64; 2], &mut [f64; 2]), column: usize, by: f64) {
    if column < 2 {
        pair.0[column] += by;
    } else {
        pair.1[column - 2] += by;
    }
}

#[test]
fn tangents_equal_differences_of_the_force() {
    let mut worst = [0.0_f64; 2];
    for width_ratio in [0.4, 1.0] {
        let bearing = bearing(width_ratio);
        let mut film = online(&bearing);
        let (c, lever) = (bearing.radial_clearance, 0.5 * bearing.width);
        for (centre, slant) in STATES {
            let state = tilted(&bearing, centre, slant);
            let seen = react(&mut film, &state);
            let scale = size(seen.reaction.film_force);
            let gap = film.minimum_gap(&state);
            for column in 0..4 {
                let unit = if column < 2 { 1.0 } else { 1.0 / lever };
                let (step, rate_step) = (1e-6 * gap * unit, 1e-6 * c * SPEED * unit);
                let at = |film: &mut OnlineFilm, sign: f64, is_rate: bool| {
                    let mut moved = state;
                    if is_rate {
                        let pair = (&mut moved.velocity, &mut moved.tilt_rate);
                        shift(pair, column, sign * rate_step);
                    } else {
                        let pair = (&mut moved.position, &mut moved.tilt);
                        shift(pair, column, sign * step);
                    }
                    parts(&react(film, &moved))
                };
                for (is_rate, tangent, step) in [
                    (false, &seen.tangent.by_position, step),
                    (true, &seen.tangent.by_rate, rate_step),
                ] {
                    let (plus, minus) = (at(&mut film, 1.0, is_rate), at(&mut film, -1.0, is_rate));
                    let reach = if is_rate { c * SPEED } else { gap } * unit;
                    for row in 0..4 {
                        let by_difference = (plus[row] - minus[row]) / (2.0 * step);
                        let off = (tangent[row][column] - by_difference).abs() * reach;
                        let relative = off / (scale * if row < 2 { 1.0 } else { lever });
                        let kind = usize::from(is_rate);
                        worst[kind] = worst[kind].max(relative);
                        assert!(
                            relative < 1e-6,
                            "{centre:?} {slant:?} {row} {column} {is_rate}: {relative}"
                        );
                    }
                }
            }
        }
    }
    println!("by position {:.1e}, by rate {:.1e}", worst[0], worst[1]);
}

#[test]
fn without_tilt_it_is_the_aligned_film() {
    for width_ratio in [0.25, 0.6, 1.5] {
        let bearing = bearing(width_ratio);
        let mut film = online(&bearing);
        let mut aligned = OnlineFilm::aligned(&bearing, &oil()).expect("a plain bearing");
        for eps in [0.0, 0.3, 0.7, 0.9, 0.95] {
            let mut worst = [0.0_f64; 3];
            for place in [0.2, 1.5, 2.6, 3.9, 5.5] {
                let mut state = tilted(&bearing, [eps, place], [0.0; 2]);
                state.tilt_rate = [0.0; 2];
                let seen = react(&mut film, &state);
                let exact = react(&mut aligned, &state);
                let [force, moment] = errors(&bearing, &seen, &exact);
                let friction = |seen: &Linearised| seen.reaction.friction_torque_shell;
                let torque = (friction(&seen) / friction(&exact) - 1.0).abs();
                for (worst, error) in worst.iter_mut().zip([force, moment, torque]) {
                    *worst = worst.max(error);
                }
            }
            println!("B/D {width_ratio} eps {eps}: {worst:?}");
            assert!(worst[0] < 8e-4, "B/D {width_ratio} eps {eps}: {worst:?}");
            assert!(worst[1] < 1e-11, "B/D {width_ratio} eps {eps}: {worst:?}");
            assert!(worst[2] < 3e-4, "B/D {width_ratio} eps {eps}: {worst:?}");
        }
    }
}

/// The film on a grid that turns with the line of centres, on two grids and their limit; the cut costs a grid order, so
/// that the limit is known to the change it makes.
#[test]
fn force_and_moment_are_those_of_a_grid() {
    for (width_ratio, states) in [
        (0.25, &STATES[4..5]),
        (0.5, &STATES[3..7]),
        (1.5, &STATES[4..5]),
    ] {
        let bearing = bearing(width_ratio);
        let mut film = online(&bearing);
        for &(centre, slant) in states {
            let state = tilted(&bearing, centre, slant);
            let seen = react(&mut film, &state);
            let grids: Vec<Linearised> = [[192, 48], [384, 96]]
                .into_iter()
                .map(|cells| {
                    let mut grid = FilmSolver::following(&bearing, &oil(), cells, 0.7)
                        .expect("a plain bearing");
                    react(&mut grid, &state)
                })
                .collect();
            let mut limit = grids[1];
            let (coarse, fine) = (&grids[0].reaction, &grids[1].reaction);
            for i in 0..2 {
                limit.reaction.film_force[i] += (fine.film_force[i] - coarse.film_force[i]) / 3.0;
                limit.reaction.film_moment[i] +=
                    (fine.film_moment[i] - coarse.film_moment[i]) / 3.0;
            }
            let error = errors(&bearing, &seen, &limit);
            let known = errors(&bearing, &grids[1], &limit);
            println!("B/D {width_ratio} {centre:?} {slant:?}: {error:?}, grid {known:?}");
            for i in 0..2 {
                assert!(error[i] < 5e-4, "{centre:?} {slant:?}: {error:?} {known:?}");
            }
        }
    }
}

/// Every figure of the summary.
#[test]
fn figures_are_those_of_a_grid() {
    let bearing = bearing(0.5);
    let mut film = online(&bearing);
    for (centre, slant) in [STATES[3], STATES[5], STATES[6]] {
        let state = tilted(&bearing, centre, slant);
        let seen = react(&mut film, &state);
        let summary = film.summary();
        let mut grid =
            FilmSolver::following(&bearing, &oil(), [384, 96], 0.7).expect("a plain bearing");
        let by_grid = react(&mut grid, &state);
        let expected = grid.summary();
        // The cells of a grid place a peak and count what is wet to a part of their size.
        let close = |name: &str, a: f64, b: f64, scale: f64| {
            let off = (a - b).abs() / scale;
            let bar = match name {
                "peak" | "peak angle" | "peak place" => 1e-2,
                "share" => 4e-3,
                _ => 2e-3,
            };
            println!("{centre:?} {name}: {off:.1e}");
            assert!(off < bar, "{centre:?} {slant:?} {name}: {a} {b}");
        };
        let peak = [summary.peak_film_pressure, expected.peak_film_pressure];
        close("peak", peak[0].value, peak[1].value, peak[1].value);
        let turn = (peak[0].angle - peak[1].angle) / TAU;
        close("peak angle", (turn - turn.round()) * TAU, 0.0, 1.0);
        close("peak place", peak[0].axial, peak[1].axial, bearing.width);
        for end in 0..2 {
            let flow = [summary.side_flow[end], expected.side_flow[end]];
            close(
                "flow",
                flow[0],
                flow[1],
                expected.side_flow[0].max(expected.side_flow[1]),
            );
            let edge = [summary.edge_film_thickness, expected.edge_film_thickness];
            close("edge", edge[0][end], edge[1][end], edge[1][end]);
        }
        let least = [
            summary.minimum_film_thickness,
            expected.minimum_film_thickness,
        ];
        close("film", least[0].value, least[1].value, least[1].value);
        close("film place", least[0].axial, least[1].axial, bearing.width);
        close(
            "share",
            summary.full_film_share,
            expected.full_film_share,
            1.0,
        );
        let power = [summary.friction_power, expected.friction_power];
        close("friction", power[0], power[1], power[1]);
        let squeeze = [summary.squeeze_power, expected.squeeze_power];
        close(
            "squeeze",
            squeeze[0],
            squeeze[1],
            power[1].max(squeeze[1].abs()),
        );
        let torque = [&seen, &by_grid].map(|seen| seen.reaction.friction_torque_shell);
        close("torque", torque[0], torque[1], torque[1]);
        close(
            "balance",
            summary.mass_balance_relative,
            expected.mass_balance_relative,
            1.0,
        );
    }
}

/// Front and rear changed places.
#[test]
fn the_mirrored_journal_has_the_mirrored_moment() {
    let bearing = bearing(0.5);
    let mut film = online(&bearing);
    for (centre, slant) in STATES {
        let state = tilted(&bearing, centre, slant);
        let seen = react(&mut film, &state).reaction;
        let flow = film.summary().side_flow;
        let mirrored = JournalState {
            tilt: state.tilt.map(|tilt| -tilt),
            tilt_rate: state.tilt_rate.map(|rate| -rate),
            ..state
        };
        let other = react(&mut film, &mirrored).reaction;
        let other_flow = film.summary().side_flow;
        let bar = 1e-11 * size(seen.film_force);
        assert!(difference(seen.film_force, other.film_force) < bar);
        let turned = other.film_moment.map(|moment| -moment);
        assert!(difference(seen.film_moment, turned) < bar * bearing.width);
        assert!((flow[0] - other_flow[1]).abs() < 1e-9 * flow[0].max(flow[1]));
        assert!((flow[1] - other_flow[0]).abs() < 1e-9 * flow[0].max(flow[1]));
        // Up and down changed places, and the sense of rotation.
        let upside_down = JournalState {
            position: [state.position[0], -state.position[1]],
            velocity: [state.velocity[0], -state.velocity[1]],
            tilt: [-state.tilt[0], state.tilt[1]],
            tilt_rate: [-state.tilt_rate[0], state.tilt_rate[1]],
            journal_speed: -state.journal_speed,
            shell_speed: -state.shell_speed,
            ..state
        };
        let other = react(&mut film, &upside_down).reaction;
        let force = [other.film_force[0], -other.film_force[1]];
        assert!(difference(seen.film_force, force) < 1e3 * bar);
        let moment = [-other.film_moment[0], other.film_moment[1]];
        assert!(difference(seen.film_moment, moment) < 1e3 * bar * bearing.width);
    }
}

/// Turned with everything it sees, up to where the elements lie.
#[test]
fn force_and_moment_turn_with_the_journal() {
    let bearing = bearing(0.5);
    let mut film = online(&bearing);
    let turn = |[x, y]: [f64; 2], angle: f64| {
        let (sin, cos) = angle.sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    };
    for (centre, slant) in STATES {
        let state = tilted(&bearing, centre, slant);
        let seen = react(&mut film, &state);
        for angle in [0.7, 2.9, 5.0] {
            let turned = JournalState {
                position: turn(state.position, angle),
                tilt: turn(state.tilt, angle),
                velocity: turn(state.velocity, angle),
                tilt_rate: turn(state.tilt_rate, angle),
                ..state
            };
            let mut other = react(&mut film, &turned);
            other.reaction.film_force = turn(other.reaction.film_force, -angle);
            other.reaction.film_moment = turn(other.reaction.film_moment, -angle);
            let error = errors(&bearing, &other, &seen);
            println!("{centre:?} {slant:?} by {angle}: {error:?}");
            assert!(
                error[0].max(error[1]) < 3e-4,
                "{centre:?} {slant:?}: {error:?}"
            );
        }
    }
}

/// Whatever moves, it puts power into the film; a film at rest has no force.
#[test]
fn motion_and_tilting_are_resisted() {
    let bearing = bearing(0.75);
    let mut film = online(&bearing);
    for (centre, slant) in STATES {
        for k in 0..16 {
            let angle = TAU * f64::from(k) / 16.0;
            let c = bearing.radial_clearance * SPEED;
            let state = JournalState {
                velocity: [c * angle.cos(), c * (3.0 * angle).sin()],
                tilt_rate: [0.0, 1.0].map(|by| c * (5.0 * angle + by).cos() / bearing.width),
                journal_speed: 0.0,
                shell_speed: 0.0,
                ..tilted(&bearing, centre, slant)
            };
            let seen = react(&mut film, &state).reaction;
            let power =
                |action: [f64; 2], rate: [f64; 2]| action[0] * rate[0] + action[1] * rate[1];
            let gained =
                power(seen.film_force, state.velocity) + power(seen.film_moment, state.tilt_rate);
            assert!(gained < 0.0, "{centre:?} {slant:?} {k}: {gained}");
        }
        let at_rest = JournalState {
            position: tilted(&bearing, centre, slant).position,
            ..JournalState::default()
        };
        let seen = react(&mut film, &at_rest).reaction;
        assert!(size(seen.film_force) < 1e-12 && size(seen.film_moment) < 1e-12);
        assert_eq!(film.summary().peak_film_pressure.value, 0.0);
    }
}

#[test]
fn what_it_does_not_have_is_refused_by_name() {
    let reynolds = Bearing {
        cavitation: Cavitation::Reynolds,
        ..bearing(0.5)
    };
    let message = OnlineFilm::new(&reynolds, &oil())
        .expect_err("reynolds")
        .to_string();
    assert!(
        message.contains("gumbel") && message.contains("field"),
        "{message}"
    );
    let pressed = Bearing {
        ambient_pressure: 1e5,
        ..bearing(0.5)
    };
    let message = OnlineFilm::new(&pressed, &oil())
        .expect_err("ambient")
        .to_string();
    assert!(message.contains("ambient"), "{message}");
    let bearing = bearing(0.5);
    let mut film = online(&bearing);
    assert!(film.capabilities().accepts_tilt);
    let touching = tilted(&bearing, [0.6, 1.0], [0.41, 1.0]);
    let seen = film.linearise(&touching, Step::Steady, &conditions());
    let Err(FilmError::Contact { axial_mm, .. }) = seen else {
        panic!("{seen:?}");
    };
    assert!(
        (axial_mm - 500.0 * bearing.width).abs() < 1e-6,
        "{axial_mm}"
    );
}
