//! The elastic crankshaft of an inline six: seven mains on `reynolds` films of 64 x 16 cells with tilt,
//! 720 degrees at 1 degree.
//!
//! Aim: 15 s per cycle on two cores. A run is two cycles from a cold start.
#![allow(clippy::unwrap_used, reason = "a bench stops at the first surprise")]

#[path = "../tests/common/mod.rs"]
mod common;
#[path = "../tests/common/elastic_six.rs"]
mod elastic_six;

use criterion::{Criterion, SamplingMode};
use elastic_six::ElasticSix;
use sommerfeld_bearing::OrbitSettings;
use sommerfeld_engine::{COUPLED_ERROR_TOLERANCE, FilmUpdate};
use sommerfeld_film::Cavitation;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Two threads that take one update after the other.
fn on_two_threads(updates: &mut [FilmUpdate<'_>]) {
    let next = AtomicUsize::new(0);
    let updates: Vec<_> = updates.iter_mut().map(Mutex::new).collect();
    let work = || {
        while let Some(update) = updates.get(next.fetch_add(1, Ordering::Relaxed)) {
            update.lock().unwrap().run();
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(work);
        work();
    });
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let engine = ElasticSix::new(0.024, Cavitation::Reynolds, Vec::new());
    let settings = OrbitSettings {
        cycle_limit: 2,
        error_tolerance: COUPLED_ERROR_TOLERANCE,
        closure_tolerance: 1e-12,
        ..OrbitSettings::default()
    };
    let mut group = criterion.benchmark_group("coupled");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.bench_function("inline-six-two-cycles", |bencher| {
        bencher.iter(|| engine.run(&settings, &on_two_threads));
    });
    group.finish();
    criterion.final_summary();
}
