//! What must hold exactly on any grid: the conditions of the ruptured film, the balance of oil, of
//! torque and of power, and the symmetries of the bearing.
#![allow(clippy::unwrap_used)]

mod common;

use common::recomputed::{Past, Recomputed, recompute};
use common::{big_end, conditions, feed_hole, oil};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Ends, Feed, FeedLine, FeedShape, FilmForce, FilmShear,
    FilmSolver, FilmSummary, Inlet, JournalState, Linearised, Step,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// Of the oil in [`oil`].
const VISCOSITY: f64 = 8e-3;
const GRID: [usize; 2] = [96, 16];

fn axial_groove(angle: f64) -> Feed {
    Feed {
        shape: FeedShape::Rectangle {
            length: 9e-3,
            // Half the bearing: cells along the axis are then shared out symmetrically.
            width: 15e-3,
        },
        carried_by: Carrier::Shell,
        angle,
        position: 0.0,
        pressure: 3e5,
        line: FeedLine::Direct,
    }
}

fn circumferential_groove() -> Feed {
    Feed {
        shape: FeedShape::Circumferential { width: 5e-3 },
        carried_by: Carrier::Shell,
        angle: 0.0,
        position: 1e-3,
        pressure: 4e5,
        line: FeedLine::Direct,
    }
}

fn shell_hole() -> Feed {
    Feed {
        shape: FeedShape::Hole { diameter: 7e-3 },
        carried_by: Carrier::Shell,
        angle: 4.0,
        position: -4e-3,
        pressure: 2e5,
        line: FeedLine::Direct,
    }
}

fn behind(feed: Feed, resistance: f64) -> Feed {
    Feed {
        line: FeedLine::Resistive { resistance },
        ..feed
    }
}

/// Bearings with every kind of supply.
fn bearings() -> Vec<(&'static str, Bearing)> {
    let with = |feeds: Vec<Feed>| Bearing { feeds, ..big_end() };
    vec![
        ("hole behind a line", with(vec![behind(feed_hole(), 4e10)])),
        (
            "groove starved by its line, and a hole",
            with(vec![behind(axial_groove(5.5), 2e12), shell_hole()]),
        ),
        (
            "two holes behind lines",
            with(vec![behind(shell_hole(), 1e10), behind(feed_hole(), 1e11)]),
        ),
        ("journal hole", with(vec![feed_hole()])),
        ("two holes", with(vec![shell_hole(), feed_hole()])),
        (
            "two axial grooves",
            with(vec![axial_groove(0.3), axial_groove(0.3 + PI)]),
        ),
        (
            "circumferential groove",
            with(vec![circumferential_groove()]),
        ),
        (
            "flooded ends, below ambient",
            Bearing {
                ends: Ends::Flooded,
                ambient_pressure: 0.5e5,
                cavitation_pressure: -0.9e5,
                ..big_end()
            },
        ),
        (
            "flooded ends and a groove",
            Bearing {
                ends: Ends::Flooded,
                ambient_pressure: 1e5,
                ..with(vec![axial_groove(5.0)])
            },
        ),
    ]
}

/// States with tilt, squeeze, tilt rates and both speeds; the film runs backwards in one.
fn states() -> Vec<(&'static str, JournalState)> {
    let c = big_end().radial_clearance;
    let tilt = c / (0.5 * big_end().width);
    let base = JournalState {
        position: [0.55 * c, 0.35 * c],
        journal_speed: 210.0,
        journal_angle: 1.0,
        ..JournalState::default()
    };
    vec![
        ("aligned", base),
        (
            "everything",
            JournalState {
                tilt: [0.12 * tilt, -0.1 * tilt],
                velocity: [40.0 * c, -25.0 * c],
                tilt_rate: [30.0 * tilt, 20.0 * tilt],
                shell_speed: -40.0,
                shell_angle: 0.0,
                ..base
            },
        ),
        (
            "backwards and opening",
            JournalState {
                position: [-0.3 * c, -0.75 * c],
                velocity: [5.0 * c, 30.0 * c],
                journal_speed: -150.0,
                shell_speed: 30.0,
                tilt: [-0.05 * tilt, 0.05 * tilt],
                ..base
            },
        ),
    ]
}

fn solve(bearing: &Bearing, state: &JournalState) -> (FilmSolver, Linearised) {
    let mut film = FilmSolver::new(bearing, &oil(), GRID).unwrap();
    let answer = film.react(state, Step::Steady, &conditions()).unwrap();
    assert!(answer.settled);
    (film, answer)
}

/// Complementarity exactly; cells and bearing to 1e-10 of the largest flow of a cell.
fn assert_balanced(name: &str, film: &FilmSolver, sum: &Recomputed) {
    assert_eq!(sum.violations, 0, "{name}");
    let scale = 1e-10 * sum.largest_flow;
    assert!(
        sum.worst_cell <= scale,
        "{name}: {:e} of {:e}",
        sum.worst_cell,
        sum.largest_flow
    );
    let summary = film.summary();
    for (end, flow) in sum.side_flow.iter().enumerate() {
        assert!((flow - summary.side_flow[end]).abs() <= scale, "{name}");
    }
    for (feed, flow) in film.feed_flows().iter().zip(&sum.feed_flows) {
        assert!((feed.flow - flow).abs() <= scale, "{name}: {feed:?} {flow}");
    }
    let growth = sum.growth;
    let stored = summary.storage_rate;
    assert!(
        (stored - growth).abs() <= scale,
        "{name}: {stored:e} {growth:e} of {:e}",
        sum.largest_flow
    );
}

fn assert_bearing_balances(name: &str, sum: &Recomputed) {
    let fed: f64 = sum.feed_flows.iter().sum();
    let left: f64 = sum.side_flow.iter().sum();
    let residual = (fed - left - sum.growth).abs();
    assert!(
        residual <= 1e-10 * sum.largest_flow,
        "{name}: {residual:e} of {:e}",
        sum.largest_flow
    );
}

fn assert_torques(name: &str, state: &JournalState, answer: &Linearised) {
    let r = &answer.reaction;
    let ([x, y], [fx, fy]) = (state.position, r.film_force);
    let ([tx, ty], [mx, my]) = (state.tilt, r.film_moment);
    let difference = r.friction_torque_journal - r.friction_torque_shell;
    let couple = x * fy - y * fx + tx * my - ty * mx;
    let scale = r.friction_torque_journal.abs().max(couple.abs());
    assert!(
        (difference - couple).abs() <= 1e-10 * scale,
        "{name}: {difference} {couple}"
    );
}

/// Film power against dissipation, work at the boundaries and loss where the film forms again.
fn assert_power(name: &str, summary: &FilmSummary, sum: &Recomputed) {
    let film = summary.friction_power + summary.squeeze_power;
    let lost = sum.shear_loss + sum.pressure_loss + sum.reformation_loss;
    let scale = lost.max(film.abs());
    assert!(
        (film - lost - sum.boundary_work).abs() <= 1e-10 * scale,
        "{name}: {film} = {} + {} + {} + {}",
        sum.shear_loss,
        sum.pressure_loss,
        sum.reformation_loss,
        sum.boundary_work
    );
}

#[test]
fn steady_films_balance() {
    let (mut ruptured, mut reformation_share) = (0, 0.0_f64);
    for cavitation in [Cavitation::MassConserving, Cavitation::Reynolds] {
        for film_shear in [FilmShear::FilmFraction, FilmShear::FullWidth] {
            for (what, bearing) in bearings() {
                for (how, state) in states() {
                    let name = format!("{cavitation:?}, {what}, {how}");
                    let bearing = Bearing {
                        cavitation,
                        film_shear,
                        ..bearing.clone()
                    };
                    let (film, answer) = solve(&bearing, &state);
                    let conserves = cavitation == Cavitation::MassConserving;
                    let sum = recompute(&film, &state, VISCOSITY, conserves, Past::None);
                    assert_balanced(&name, &film, &sum);
                    if conserves {
                        assert_bearing_balances(&name, &sum);
                    }
                    assert_torques(&name, &state, &answer);
                    assert_power(&name, &film.summary(), &sum);
                    ruptured += sum.ruptured;
                    reformation_share =
                        reformation_share.max(sum.reformation_loss / sum.shear_loss);
                    assert!(sum.fed > 0 || bearing.feeds.is_empty(), "{name}");
                }
            }
        }
    }
    assert!(
        ruptured > 0 && reformation_share > 1e-3,
        "{reformation_share}"
    );
}

/// A full film loses exactly what shear and pressure gradients dissipate and what it pumps out.
#[test]
fn power_of_a_full_film() {
    for (how, state) in states() {
        let bearing = Bearing {
            cavitation: Cavitation::MassConserving,
            ends: Ends::Flooded,
            ambient_pressure: 1e8,
            feeds: vec![shell_hole()]
                .into_iter()
                .map(|f| Feed { pressure: 1e8, ..f })
                .collect(),
            ..big_end()
        };
        let (film, answer) = solve(&bearing, &state);
        let sum = recompute(&film, &state, VISCOSITY, true, Past::None);
        assert_eq!(sum.ruptured, 0, "{how}");
        assert!(sum.reformation_loss.abs() < 1e-12 * sum.shear_loss, "{how}");
        assert_balanced(how, &film, &sum);
        assert_power(how, &film.summary(), &sum);
        assert_torques(how, &state, &answer);
    }
}

/// The line of the widest gap: torque identity on the grid that follows the line of centres.
#[test]
fn torques_on_the_following_grid() {
    for cavitation in [
        Cavitation::Gumbel,
        Cavitation::Reynolds,
        Cavitation::MassConserving,
    ] {
        for (how, state) in states() {
            let bearing = Bearing {
                cavitation,
                inlet: Inlet::MaxFilmLine { pressure: 2e5 },
                ..big_end()
            };
            let (_, answer) = solve(&bearing, &state);
            assert_torques(how, &state, &answer);
        }
    }
}

/// Along a prescribed orbit: per step complementarity, oil in every cell, torque and power.
#[test]
fn implicit_steps_balance() {
    let c = big_end().radial_clearance;
    let tilt = c / (0.5 * big_end().width);
    let omega = 210.0;
    let duration = 2e-4;
    // Around once in a varying distance, tilting to and fro, closing and opening fast.
    let place = |t: f64| {
        let angle = 0.7 * omega * t;
        let eps = 0.6 + 0.3 * (1.9 * omega * t).sin();
        let position = [angle.cos(), angle.sin()].map(|d| eps * c * d);
        let tilt = [0.06 * tilt * (omega * t).cos(), 0.04 * tilt];
        (position, tilt)
    };
    let feeds = vec![feed_hole(), axial_groove(2.0)];
    // Not passing over one another: the balance of each feed is then its own.
    let aside = Feed {
        position: -9e-3,
        ..shell_hole()
    };
    let lines = vec![behind(feed_hole(), 1e10), behind(aside, 3e12)];
    for (name, bearing) in [
        (
            "lines",
            Bearing {
                feeds: lines,
                ..big_end()
            },
        ),
        (
            "air",
            Bearing {
                feeds: feeds.clone(),
                ..big_end()
            },
        ),
        (
            "flooded",
            Bearing {
                feeds,
                ends: Ends::Flooded,
                ambient_pressure: 0.3e5,
                cavitation_pressure: -0.7e5,
                ..big_end()
            },
        ),
    ] {
        let mut film = FilmSolver::new(&bearing, &oil(), GRID).unwrap();
        let mut content: Vec<f64> = Vec::new();
        let (mut ruptured, mut fed_cells) = (0, Vec::new());
        for step in 0..=100 {
            let t = step as f64 * duration;
            let ((position, tilt), (old_position, old_tilt)) = (place(t), place(t - duration));
            let rate = |new: [f64; 2], old: [f64; 2]| {
                [(new[0] - old[0]) / duration, (new[1] - old[1]) / duration]
            };
            let state = JournalState {
                position,
                tilt,
                velocity: rate(position, old_position),
                tilt_rate: rate(tilt, old_tilt),
                journal_speed: omega,
                shell_speed: 25.0,
                journal_angle: omega * t,
                shell_angle: 0.0,
            };
            // The first film is a steady one: it is where the history begins.
            let kind = if step == 0 {
                Step::Steady
            } else {
                Step::Implicit {
                    duration,
                    after: 0.0,
                }
            };
            let answer = film.react(&state, kind, &conditions()).unwrap();
            assert!(answer.settled, "{name} step {step}");
            let past = if step == 0 {
                Past::None
            } else {
                Past::Content {
                    old: &content,
                    duration,
                }
            };
            let sum = recompute(&film, &state, VISCOSITY, true, past);
            let label = format!("{name} step {step}");
            assert_balanced(&label, &film, &sum);
            assert_bearing_balances(&label, &sum);
            assert_torques(&label, &state, &answer);
            assert_power(&label, &film.summary(), &sum);
            ruptured += sum.ruptured;
            fed_cells.push(sum.fed);
            content = sum.content;
            film.accept_step();
        }
        assert!(
            ruptured > 0 && fed_cells.iter().any(|f| *f != fed_cells[0]),
            "{name}"
        );
    }
}

fn rotated([x, y]: [f64; 2], quarter_turns: usize) -> [f64; 2] {
    match quarter_turns % 4 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

/// Largest difference of force and moment, of the torques, over their size.
fn deviation(a: &Linearised, b: &Linearised, turn: impl Fn(&Linearised) -> [[f64; 2]; 2]) -> f64 {
    let ([f, m], [fb, mb]) = (turn(a), [b.reaction.film_force, b.reaction.film_moment]);
    let pair = |a: [f64; 2], b: [f64; 2], size: f64| (a[0] - b[0]).hypot(a[1] - b[1]) / size;
    let force = fb[0].hypot(fb[1]);
    let lever = big_end().width * force;
    pair(f, fb, force).max(pair(m, mb, lever))
}

fn closures() -> [Cavitation; 3] {
    [
        Cavitation::Gumbel,
        Cavitation::Reynolds,
        Cavitation::MassConserving,
    ]
}

/// Turned by quarters, everything turns.
#[test]
fn four_quadrants() {
    for cavitation in closures() {
        for (how, state) in states() {
            // On its grid the hole covers the same cells in every quadrant.
            let bearing = |turns: usize| Bearing {
                cavitation,
                feeds: vec![Feed {
                    angle: (turns as f64 + 2.0) * FRAC_PI_2,
                    ..shell_hole()
                }],
                ..big_end()
            };
            let (_, first) = solve(&bearing(0), &state);
            for turns in 1..4 {
                let turned = JournalState {
                    position: rotated(state.position, turns),
                    tilt: rotated(state.tilt, turns),
                    velocity: rotated(state.velocity, turns),
                    tilt_rate: rotated(state.tilt_rate, turns),
                    ..state
                };
                let (_, answer) = solve(&bearing(turns), &turned);
                let worst = deviation(&first, &answer, |a| {
                    [a.reaction.film_force, a.reaction.film_moment].map(|v| rotated(v, turns))
                });
                assert!(worst < 1e-9, "{cavitation:?} {how} {turns}: {worst:e}");
                let torques = [&first, &answer].map(|a| a.reaction.friction_torque_journal);
                assert!((torques[0] / torques[1] - 1.0).abs() < 1e-9);
            }
        }
    }
}

/// Mirrored in the X-Z plane (everything turns the other way), and in the mid-plane.
#[test]
fn mirrors() {
    for cavitation in closures() {
        for (how, state) in states() {
            let bearing = Bearing {
                cavitation,
                feeds: vec![shell_hole(), axial_groove(1.0)],
                ..big_end()
            };
            let (film, first) = solve(&bearing, &state);

            // y to -y: axial vectors (tilt, moment) turn over in x.
            let (polar, axial) = (|[x, y]: [f64; 2]| [x, -y], |[x, y]: [f64; 2]| [-x, y]);
            let mirrored = JournalState {
                position: polar(state.position),
                velocity: polar(state.velocity),
                tilt: axial(state.tilt),
                tilt_rate: axial(state.tilt_rate),
                journal_speed: -state.journal_speed,
                shell_speed: -state.shell_speed,
                journal_angle: -state.journal_angle,
                shell_angle: -state.shell_angle,
            };
            let mut turned_over = bearing.clone();
            for feed in &mut turned_over.feeds {
                feed.angle = -feed.angle;
            }
            let (other, answer) = solve(&turned_over, &mirrored);
            let worst = deviation(&first, &answer, |a| {
                [polar(a.reaction.film_force), axial(a.reaction.film_moment)]
            });
            assert!(worst < 1e-9, "{cavitation:?} {how} around: {worst:e}");
            let sum =
                first.reaction.friction_torque_journal + answer.reaction.friction_torque_journal;
            assert!(sum.abs() < 1e-9 * first.reaction.friction_torque_journal.abs());
            let powers = [&film, &other].map(|f| f.summary().power_loss());
            assert!((powers[0] / powers[1] - 1.0).abs() < 1e-9);

            // z to -z.
            let minus = |[x, y]: [f64; 2]| [-x, -y];
            let mirrored = JournalState {
                tilt: minus(state.tilt),
                tilt_rate: minus(state.tilt_rate),
                ..state
            };
            let mut turned_over = bearing.clone();
            for feed in &mut turned_over.feeds {
                feed.position = -feed.position;
            }
            let (other, answer) = solve(&turned_over, &mirrored);
            let worst = deviation(&first, &answer, |a| {
                [a.reaction.film_force, minus(a.reaction.film_moment)]
            });
            assert!(worst < 1e-9, "{cavitation:?} {how} along: {worst:e}");
            let flows = [&film, &other].map(|f| f.summary().side_flow);
            assert!((flows[0][0] - flows[1][1]).abs() < 1e-9 * flows[0][0].abs());
        }
    }
}

/// Seen from a frame that turns, both surfaces turn the other way and the journal centre moves
/// around, and the film is the same.
#[test]
fn turning_frames() {
    for cavitation in [Cavitation::Gumbel, Cavitation::Reynolds] {
        for (how, state) in states() {
            let bearing = Bearing {
                cavitation,
                feeds: vec![shell_hole(), feed_hole()],
                ..big_end()
            };
            let (film, first) = solve(&bearing, &state);
            for turning in [-300.0, 77.0] {
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
                let worst = deviation(&first, &answer, |a| {
                    [a.reaction.film_force, a.reaction.film_moment]
                });
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
