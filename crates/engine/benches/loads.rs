//! Loads alone: what an engine takes per speed before any film is asked.
//!
//! Aim: 5 ms for an inline six at 720 crank angles (all load cycles, torque, orders), on one core.

#[path = "../tests/common/mod.rs"]
mod common;

use criterion::Criterion;
use sommerfeld_engine::{CrankMotion, PinSpeed, bearing_duties, performance};
use std::hint::black_box;

/// One for each degree of a four-stroke cycle.
const POINTS: usize = 720;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let train = common::general(common::inline(&[1, 5, 3, 6, 2, 4]));
    let diagram = common::diagram();
    let pin = PinSpeed::Share(0.5);
    let motions = [
        ("even", CrankMotion::even(common::SPEED)),
        ("rippling", common::rippling()),
    ];
    let mut group = criterion.benchmark_group("engine-loads");
    for (name, motion) in motions {
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let motion = black_box(&motion);
                let duties = bearing_duties(&train, &diagram, motion, &pin, POINTS);
                (duties, performance(&train, &diagram, motion, POINTS))
            });
        });
    }
    group.finish();
    criterion.final_summary();
}
