//! One lookup with all derivatives (aim 0.3 us), and a table built (aim 10 s on two cores for 1e-4).
//!
//! `cargo bench -p sommerfeld-database`; a word of a name picks cases.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    missing_docs,
    reason = "a benchmark stops at the first surprise and says what it found"
)]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{CONDITIONS, VISCOSITY, state, unit_bearing};
use criterion::{Criterion, criterion_group, criterion_main};
use sommerfeld_database::superposition::{
    SuperpositionFilm, SuperpositionRecipe, SuperpositionTable,
};
use sommerfeld_database::{Recipe, TableFilm, generate};
use sommerfeld_film::{Cavitation, FilmForce, JournalState, Step};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

fn lookup(criterion: &mut Criterion) {
    let bearing = unit_bearing(Cavitation::Gumbel, 0.5);
    let table = generate(&Recipe::new(Cavitation::Gumbel, 0.5), &(), None).unwrap();
    let mut film = TableFilm::new(Arc::new(table), &bearing, VISCOSITY).unwrap();
    let states: Vec<JournalState> = (0..1024).map(|k| state(&bearing, k, 0.999)).collect();
    let mut next = 0;
    criterion.bench_function("lookup with derivatives", |bencher| {
        bencher.iter(|| {
            next = (next + 1) % states.len();
            film.linearise(black_box(&states[next]), Step::Steady, &CONDITIONS)
                .unwrap()
        });
    });
}

/// A tilted journal of the paper's scheme (aim 3 us), where two tables of the wedge join: all of it is looked up. On
/// coarse cells: the table has the size of a fine one.
fn tilted_lookup(criterion: &mut Criterion) {
    let bearing = unit_bearing(Cavitation::Reynolds, 0.5);
    let recipe = SuperpositionRecipe {
        grid: [32, 8],
        samples: 0,
        ..SuperpositionRecipe::tilted(2.0)
    };
    let table = SuperpositionTable::build(&recipe, None, &mut |_, _| true).unwrap();
    let mut film = SuperpositionFilm::new(Arc::new(table), &bearing, VISCOSITY).unwrap();
    let per_tilt = 0.5 * bearing.width / bearing.radial_clearance;
    let states: Vec<JournalState> = (0..1024)
        .map(|k| {
            let eps = 0.3 + 0.1 * f64::from(k) / 1024.0;
            let c = bearing.radial_clearance;
            JournalState {
                position: [0.8 * eps * c, 0.6 * eps * c],
                tilt: [0.2 / per_tilt, -0.25 / per_tilt],
                velocity: [10.0 * c, 20.0 * c],
                journal_speed: 100.0,
                ..JournalState::default()
            }
        })
        .collect();
    let mut next = 0;
    criterion.bench_function("tilted lookup with derivatives", |bencher| {
        bencher.iter(|| {
            next = (next + 1) % states.len();
            film.linearise(black_box(&states[next]), Step::Steady, &CONDITIONS)
                .unwrap()
        });
    });
}

/// One build each: they take seconds.
fn build(_: &mut Criterion) {
    for closure in [Cavitation::Gumbel, Cavitation::Reynolds] {
        for target in [1e-3, 1e-4] {
            let recipe = Recipe {
                target,
                ..Recipe::new(closure, 0.5)
            };
            let begun = Instant::now();
            let table = generate(&recipe, &(), None).unwrap();
            println!(
                "build {} {target:e}: {:.1} s, nodes {:?}, {:?}",
                recipe.closure_name(),
                begun.elapsed().as_secs_f64(),
                table.axes().counts(),
                table.errors()
            );
        }
    }
}

criterion_group!(benches, lookup, tilted_lookup, build);
criterion_main!(benches);
