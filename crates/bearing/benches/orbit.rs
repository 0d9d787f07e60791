//! What one orbit costs: film updates per time step, milliseconds per update, wall time; see
//! `benches/README.md`.
//!
//! The loads are those of `examples/02-big-end-diesel`, the grids those of an engine (64 x 16 cells):
//! half a film for an aligned journal, all of it for one whose tilt is prescribed, and a film that
//! remembers. With `physics` in its name: the film that remembers on 128 x 32 cells, plain and with rough
//! surfaces in contact, an oil that thins under shear, one that thickens and is compressed (bar: twice the time per
//! cycle); and the
//! bearing at rest with one temperature and with one for each cell (bar: three
//! times). Beside the times stand the figures of the cycle, which a faster orbit must not move.

#![allow(
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a benchmark stops at the first surprise and says what it found"
)]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{CONDITIONS, diesel_big_end, diesel_cycle, greenwood_tripp, rig_finish};
use sommerfeld_bearing::{
    CycleTilt, EquilibriumRequest, EquilibriumSettings, HeatFieldSettings, LoadCycle,
    OrbitSettings, find_equilibrium, journal_orbit, warm_equilibrium,
};
use sommerfeld_film::{
    Bearing, Cavitation, FilmForce, FilmSolver, JournalState, Outcome, Step, Surroundings,
};
use sommerfeld_oil::{
    CROSS_EXPONENT, CompressionLaw, DensityLaw, Lubricant, PressureLaw, ThinningForm, ViscosityLaw,
};
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
        "three cycles, physics: one       steps  updates  per step  ms/update      s  h_min um  p_max MPa"
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
        if !asked_for(name) {
            continue;
        }
        let bearing = diesel_big_end(cavitation);
        let film = match cycle.tilt {
            CycleTilt::Aligned => FilmSolver::aligned(&bearing, &oil, GRID),
            _ => FilmSolver::new(&bearing, &oil, GRID),
        };
        let mut film = film.unwrap();
        updates(name, &mut film);
        measure(name, &mut film, &bearing, cycle, degrees, 3);
    }
    if asked_for("mixed physics") {
        mixed(&cycle);
    }
    if asked_for("warm physics") {
        warm();
    }
}

/// No word was given, or all of them are in the name.
fn asked_for(name: &str) -> bool {
    let mut words = std::env::args().skip(1).filter(|w| !w.starts_with('-'));
    words.all(|word| name.contains(&word))
}

/// The fine grid of the bars.
const FINE: [usize; 2] = [128, 32];

/// One cycle with each physics: mixed, piezoviscous, both.
fn mixed(cycle: &LoadCycle) {
    let smooth = diesel_big_end(Cavitation::MassConserving);
    let rough = Bearing {
        finish: rig_finish(greenwood_tripp(1e-3)),
        ..smooth.clone()
    };
    let plain = Lubricant::constant(8e-3, 850.0);
    let thick = Lubricant {
        viscosity_pressure: PressureLaw::Roelands {
            alpha: 9.5e-9,
            temperature: Default::default(),
        },
        ..plain.clone()
    };
    let dense = Lubricant {
        density_pressure: CompressionLaw::DowsonHigginson,
        ..thick.clone()
    };
    // Three quarters of the viscosity at low shear are left at 150 degC and 1e6 1/s.
    let thinning = |form| {
        let thin = plain.clone().with_hths(6e-3, form, 0.4);
        thin.unwrap()
    };
    let cross = thinning(ThinningForm::Cross {
        exponent: CROSS_EXPONENT,
    });
    let carreau = thinning(ThinningForm::Carreau { exponent: 0.7 });
    for (name, bearing, oil) in [
        ("physics: plain", &smooth, &plain),
        ("physics: Cross", &smooth, &cross),
        ("physics: Carreau", &smooth, &carreau),
        ("physics: rough, contact", &rough, &plain),
        ("physics: rough, Cross", &rough, &cross),
        ("physics: rough, Roelands", &rough, &thick),
        ("physics: rough, R., compressed", &rough, &dense),
    ] {
        let mut film = FilmSolver::aligned(bearing, oil, FINE).unwrap();
        updates(name, &mut film);
        measure(name, &mut film, bearing, cycle, 1.0, 1);
    }
}

/// The bearing at rest, at one temperature and at one for each cell: the fastest of some.
fn warm() {
    let bearing = diesel_big_end(Cavitation::MassConserving);
    let viscosity = ViscosityLaw::Vogel {
        a: 1.3e-4,
        b: 900.0,
        c: 110.0 - 273.15,
    };
    let oil = Lubricant::newtonian(viscosity, DensityLaw::Constant { density: 850.0 });
    let request = EquilibriumRequest {
        load: [12e3, 0.0],
        moment: None,
        frame: JournalState {
            journal_speed: 209.0,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings::default(),
    };
    let supply = [CONDITIONS.temperature];
    let surroundings = Surroundings {
        volumetric_heat: 1.8e6,
        supply: &supply,
        ambient: supply[0],
        carry_over: 1.0,
        wall: (0.0, supply[0]),
    };
    let mut fastest = [f64::INFINITY; 2];
    let mut counts = [0; 3];
    // A machine changes its pace: one after the other they have the same.
    let mut ratios = Vec::new();
    for _ in 0..40 {
        let mut film = FilmSolver::aligned(&bearing, &oil, FINE).unwrap();
        let clock = Instant::now();
        let rest = find_equilibrium(&mut film, &bearing, &request, &CONDITIONS).unwrap();
        let plain = clock.elapsed().as_secs_f64();
        fastest[0] = fastest[0].min(plain);
        assert_eq!(rest.outcome, Outcome::Converged);
        let mut film = FilmSolver::aligned(&bearing, &oil, FINE).unwrap();
        let settings = HeatFieldSettings::default();
        let clock = Instant::now();
        let warm = warm_equilibrium(
            &mut film,
            &bearing,
            &request,
            &CONDITIONS,
            &surroundings,
            &settings,
        )
        .unwrap();
        let field = clock.elapsed().as_secs_f64();
        fastest[1] = fastest[1].min(field);
        ratios.push(field / plain);
        assert_eq!(warm.outcome, Outcome::Converged);
        counts = [rest.film_updates, warm.film_updates, warm.changes.len()];
    }
    ratios.sort_by(f64::total_cmp);
    println!(
        "physics: at rest, one temperature {:.1} ms ({} updates), a field {:.1} ms ({} updates, {} rounds), ratio {:.2} in the median",
        1e3 * fastest[0],
        counts[0],
        1e3 * fastest[1],
        counts[1],
        counts[2],
        ratios[ratios.len() / 2]
    );
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
    cycles: usize,
) {
    let settings = OrbitSettings {
        crank_step: degrees.to_radians(),
        cycle_limit: cycles,
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
