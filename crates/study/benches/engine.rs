//! What a user waits for who runs a whole engine; see `benches/README.md`.
//!
//! The engine is the template `engine-i6`: seven mains and six big ends, one speed, 720 points a cycle,
//! `reynolds` films on 64 x 16 cells. A run takes the cycles until its orbits close, so the figure is its
//! wall time over the mean number of cycles; the whole time is printed beside it.

#![allow(
    clippy::panic,
    clippy::expect_used,
    clippy::print_stderr,
    reason = "a benchmark stops at the first surprise and says what it found"
)]

use criterion::{Criterion, SamplingMode};
use sommerfeld_study::input::study_from_text;
use sommerfeld_study::results::Body;
use sommerfeld_study::{Outcome, Study, solve, templates};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

const ELASTIC: &str = "[engine.crankshaft]
model = \"elastic\"
main_length = \"24 mm\"
pin_length = \"22 mm\"
web_thickness = \"24 mm\"
web_width = \"80 mm\"
support_stiffness = [\"500 N/um\", \"300 N/um\"]
support_tilt_stiffness = [\"50 kN.m/rad\", \"50 kN.m/rad\"]
";

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("engine");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for (name, crankshaft) in [("hinged-mains", ""), ("elastic-mains", ELASTIC)] {
        let study = inline_six(crankshaft);
        group.bench_function(name, |bencher| {
            bencher.iter_custom(|count| (0..count).map(|_| per_cycle(name, &study)).sum());
        });
    }
    group.finish();
    criterion.final_summary();
}

fn inline_six(crankshaft: &str) -> Study {
    let template = templates::find("engine-i6").expect("the template of the inline six");
    let text = template
        .study
        .replace(
            "speed = [\"2000 rpm\", \"4000 rpm\"]",
            "speed = \"2000 rpm\"",
        )
        .replace(
            "[film]\n",
            &format!("{crankshaft}[film]\ncavitation = \"reynolds\"\n"),
        );
    study_from_text("engine-i6.toml", &text, Path::new("."))
        .unwrap_or_else(|errors| panic!("{}", errors.render(false)))
}

/// Wall time of a run over the mean number of cycles of its orbits.
fn per_cycle(name: &str, study: &Study) -> Duration {
    let start = Instant::now();
    let results = solve(study, &mut |_| ControlFlow::Continue(())).expect("a run");
    let whole = start.elapsed();
    let Body::Machine(machine) = &results.body else {
        panic!("no engine");
    };
    let orbits: Vec<_> = machine
        .speeds
        .iter()
        .flat_map(|speed| &speed.bearings)
        .collect();
    assert!(
        results.header.status == Outcome::Converged,
        "{:?}",
        results.header.messages
    );
    let cycles: usize = orbits
        .iter()
        .map(|bearing| bearing.cycle.orbit.cycles)
        .sum();
    let mean = cycles as f64 / orbits.len() as f64;
    eprintln!(
        "{name}: {} orbits in {:.2} s, {mean:.2} cycles on average",
        orbits.len(),
        whole.as_secs_f64()
    );
    whole.div_f64(mean)
}
