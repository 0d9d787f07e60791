//! What one update of the on-line film costs, with force and tangents: microseconds, the fastest of many
//! rounds, while the journal moves on by a degree of crank angle; see `benches/README.md`.
//!
//! The journal goes round at a relative eccentricity between 0.5 and 0.9. `cold` films start from nothing
//! each time, `warm` ones from the fronts of the last; the half film has no memory. `field` is the film
//! on the grid that orbits of engines use, half of 64 x 16 cells, warm.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a benchmark stops at the first surprise and says what it found"
)]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{big_end, conditions, oil};
use sommerfeld_film::spectral::{AlignedFilm, Precision};
use sommerfeld_film::{Bearing, Cavitation, FilmForce, FilmSolver, JournalState, OnlineFilm, Step};
use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

const STATES: usize = 90;
const ROUNDS: usize = 60;

fn main() {
    println!("one update with tangents                         us");
    for width_ratio in [0.42, 1.0] {
        for cavitation in [Cavitation::Gumbel, Cavitation::Reynolds] {
            let bearing = Bearing {
                width: 0.072 * width_ratio,
                cavitation,
                ..big_end()
            };
            let states = path(&bearing);
            let name = |what: &str| format!("B/D {width_ratio}, {cavitation:?}, {what}");
            let mut film = OnlineFilm::aligned(&bearing, &oil()).unwrap();
            measure(&name("warm"), 1, || {
                for state in &states {
                    let seen = film.linearise(state, Step::Steady, &conditions()).unwrap();
                    black_box(seen.tangent);
                }
            });
            let mut film = OnlineFilm::aligned(&bearing, &oil()).unwrap();
            measure(&name("summary too"), 1, || {
                for state in &states {
                    let seen = film.linearise(state, Step::Steady, &conditions()).unwrap();
                    black_box((seen.tangent, film.summary()));
                }
            });
            for precision in [Precision::OnLine, Precision::Fine] {
                let mut film = AlignedFilm::new(cavitation, width_ratio, precision).unwrap();
                measure(&name(&format!("cold, {precision:?}")), 1, || {
                    for k in 0..STATES {
                        // Far from the last one, so that nothing of it can be used.
                        let turn = TAU * (k as f64 * 0.382).fract();
                        let motion = [turn.cos(), turn.sin()];
                        black_box(film.force(0.5 + 0.4 * turn.sin().abs(), motion).unwrap());
                    }
                });
            }
            if cavitation == Cavitation::Gumbel {
                // The journal leans across its path by a part of the gap.
                let slant = 0.05 * bearing.radial_clearance / bearing.width;
                let mut film = OnlineFilm::new(&bearing, &oil()).unwrap();
                measure(&name("tilted"), 1, || {
                    for state in &states {
                        let tilt = state
                            .position
                            .map(|part| slant * part / bearing.radial_clearance);
                        let state = JournalState { tilt, ..*state };
                        let seen = film.linearise(&state, Step::Steady, &conditions()).unwrap();
                        black_box(seen.tangent);
                    }
                });
            }
            let mut field = FilmSolver::aligned(&bearing, &oil(), [64, 16]).unwrap();
            measure(&name("field 64 x 16"), 4, || {
                for state in &states {
                    let seen = field.react(state, Step::Steady, &conditions()).unwrap();
                    black_box(seen.tangent);
                }
            });
        }
    }
}

/// The journal by degrees of crank angle.
fn path(bearing: &Bearing) -> Vec<JournalState> {
    const SPEED: f64 = 400.0;
    let c = bearing.radial_clearance;
    let at = |angle: f64| {
        let eps = 0.7 + 0.2 * (2.0 * angle).cos();
        [eps * c * angle.cos(), eps * c * angle.sin()]
    };
    (0..STATES)
        .map(|k| {
            let angle = k as f64 * TAU / 360.0;
            let (now, before) = (at(angle), at(angle - TAU / 360.0));
            let duration = TAU / 360.0 / SPEED;
            JournalState {
                position: now,
                velocity: [0, 1].map(|i| (now[i] - before[i]) / duration),
                journal_speed: SPEED,
                ..JournalState::default()
            }
        })
        .collect()
}

fn measure(name: &str, fewer: usize, mut round: impl FnMut()) {
    if std::env::args()
        .skip(1)
        .any(|word| !word.starts_with('-') && !name.contains(&word))
    {
        return;
    }
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS / fewer {
        let start = Instant::now();
        round();
        best = best.min(start.elapsed().as_secs_f64());
    }
    println!("{name:<46} {:7.1}", 1e6 * best / STATES as f64);
}
