//! What one orbit costs: film updates per time step, milliseconds per update, wall time; see
//! `benches/README.md`.
//!
//! The loads are those of `examples/02-big-end-diesel`, the grids those of an engine (64 x 16 cells):
//! half a film for an aligned journal, all of it for one whose tilt is prescribed, and a film that
//! remembers. Beside the times stand the figures of the cycle, which a faster orbit must not move.

#![allow(
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a benchmark stops at the first surprise and says what it found"
)]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{CONDITIONS, diesel_big_end, diesel_cycle};
use sommerfeld_bearing::{CycleTilt, LoadCycle, OrbitSettings, journal_orbit};
use sommerfeld_film::{Bearing, Cavitation, FilmForce, FilmSolver, JournalState, Step};
use sommerfeld_oil::Lubricant;
use std::f64::consts::PI;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

const GRID: [usize; 2] = [64, 16];

/// Largest prescribed tilt, rad: 1.5 um at the ends of the bearing.
const TILT: f64 = 1e-4;

fn main() {
    let oil = Lubricant::constant(8e-3, 850.0);
    let cycle = diesel_cycle();
    let tilted = LoadCycle {
        tilt: CycleTilt::Prescribed(
            (0..cycle.points.len())
                .map(|row| 2.0 * PI * row as f64 / cycle.points.len() as f64)
                .map(|turn| [TILT * turn.cos(), TILT * (2.0 * turn).sin()])
                .collect(),
        ),
        ..diesel_cycle()
    };
    println!(
        "orbit, 64 x 16 cells, 3 cycles   steps  updates  per step  ms/update      s  h_min um  p_max MPa"
    );
    for (name, cavitation, degrees, cycle) in [
        ("reynolds, aligned", Cavitation::Reynolds, 1.0, &cycle),
        (
            "reynolds, tilt prescribed",
            Cavitation::Reynolds,
            1.0,
            &tilted,
        ),
        (
            "mass-conserving, aligned",
            Cavitation::MassConserving,
            1.0,
            &cycle,
        ),
    ] {
        if std::env::args()
            .skip(1)
            .any(|word| !word.starts_with('-') && !name.contains(&word))
        {
            continue;
        }
        let bearing = diesel_big_end(cavitation);
        let film = match cycle.tilt {
            CycleTilt::Aligned => FilmSolver::aligned(&bearing, &oil, GRID),
            _ => FilmSolver::new(&bearing, &oil, GRID),
        };
        let mut film = film.unwrap();
        updates(name, &mut film);
        measure(name, &mut film, &bearing, cycle, degrees);
    }
}

/// One update of the film, and one without tangents, at a state of the orbit: the fastest of many.
fn updates(name: &str, film: &mut dyn FilmForce) {
    let state = JournalState {
        position: [28e-6, 12e-6],
        velocity: [-2e-3, 1e-3],
        journal_speed: 209.0,
        ..JournalState::default()
    };
    let mut fastest = [f64::INFINITY; 2];
    for _ in 0..400 {
        let clock = Instant::now();
        black_box(film.linearise(&state, Step::Steady, &CONDITIONS).unwrap());
        fastest[0] = fastest[0].min(clock.elapsed().as_secs_f64());
        let clock = Instant::now();
        black_box(film.look(&state, Step::Steady, &CONDITIONS).unwrap());
        fastest[1] = fastest[1].min(clock.elapsed().as_secs_f64());
    }
    let [update, look] = fastest.map(|seconds| 1e3 * seconds);
    println!("{name:31} one update {update:.4} ms, without tangents {look:.4} ms");
}

fn measure(
    name: &str,
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    cycle: &LoadCycle,
    degrees: f64,
) {
    let settings = OrbitSettings {
        crank_step: degrees.to_radians(),
        cycle_limit: 3,
        // All of them, whatever the closure.
        closure_tolerance: 0.0,
        ..OrbitSettings::default()
    };
    let clock = Instant::now();
    let mut observer = |_: &_, _: &dyn FilmForce, _| ControlFlow::Continue(());
    let orbit = journal_orbit(film, bearing, cycle, &CONDITIONS, &settings, &mut observer).unwrap();
    let wall = clock.elapsed().as_secs_f64();
    let peak = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let summaries = || orbit.points.iter().skip(1).map(|point| point.summary);
    let pressure = peak(&mut summaries().map(|s| s.peak_film_pressure.value));
    let gap = summaries()
        .map(|s| s.minimum_film_thickness.value)
        .fold(f64::INFINITY, f64::min);
    println!(
        "{name:31} {:7} {:8} {:9.3} {:10.4} {wall:6.2} {:9.5} {:10.4}",
        orbit.steps,
        orbit.film_solves,
        orbit.film_solves as f64 / orbit.steps as f64,
        1e3 * wall / orbit.film_solves as f64,
        1e6 * gap,
        1e-6 * pressure,
    );
}
