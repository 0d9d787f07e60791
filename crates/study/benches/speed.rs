//! What a user waits for, next to a fixed kernel timed in the same run; see `benches/README.md`.
//!
//! The bearings, oils and loads are those of `examples/`, so that a figure is that of a study.

#![allow(
    clippy::panic,
    clippy::expect_used,
    reason = "a benchmark stops at the first surprise"
)]

use criterion::{BatchSize, Criterion, SamplingMode, Throughput};
use sommerfeld_bearing::{
    EquilibriumRequest, JournalOrbit, OrbitSettings, find_equilibrium, journal_orbit,
};
use sommerfeld_film::{
    Bearing, Cavitation, Conditions, FilmForce, FilmShear, FilmSolver, JournalState, Outcome,
    ShortBearingFilm, Step,
};
use sommerfeld_study::input::{BearingCase, CycleDuty, Duty, TiltCondition};
use sommerfeld_study::{Study, load_study};
use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

/// Default grid of a study.
const GRID: [usize; 2] = [128, 32];

/// Eccentricity over clearance in the film benchmarks.
const ECCENTRICITY_RATIO: f64 = 0.9;

/// What the journal turns in a warm step.
const STEP_DEG: f64 = 2.0;

/// What its line of centres turns meanwhile, over that: half of the half-speed whirl of an unloaded journal.
const PRECESSION_RATIO: f64 = 0.25;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    // First and last: a machine that changed its pace in between shows it.
    fixed_kernel(&mut criterion, "before");
    films(&mut criterion);
    equilibrium(&mut criterion);
    load_cycles(&mut criterion);
    fixed_kernel(&mut criterion, "after");
    criterion.final_summary();
}

/// The unit of all ratios: it never changes. Elimination of a dense matrix by plain loops.
fn fixed_kernel(criterion: &mut Criterion, when: &str) {
    const N: usize = 192;
    fn eliminate(a: &mut [f64]) -> f64 {
        for k in 0..N {
            for i in k + 1..N {
                let factor = a[i * N + k] / a[k * N + k];
                a[i * N + k] = factor;
                for j in k + 1..N {
                    a[i * N + j] -= factor * a[k * N + j];
                }
            }
        }
        a[N * N - 1]
    }
    let matrix: Vec<f64> = (0..N * N)
        .map(|at| match (at / N).abs_diff(at % N) {
            0 => N as f64,
            distance => 1.0 / distance as f64,
        })
        .collect();
    let mut work = matrix.clone();
    criterion
        .benchmark_group("fixed-kernel")
        .bench_function(when, |bencher| {
            bencher.iter(|| {
                work.copy_from_slice(black_box(&matrix));
                black_box(eliminate(&mut work))
            });
        });
}

fn example(path: &str) -> Study {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples")
        .join(path);
    load_study(&path).unwrap_or_else(|errors| panic!("{}", errors.render(false)))
}

fn case(study: &Study) -> &BearingCase {
    study.bearing_case().expect("the study has a bearing")
}

fn duty(study: &Study) -> &CycleDuty {
    match &case(study).duty {
        Duty::Cycle(duty) => duty,
        other => panic!("no load cycle: {other:?}"),
    }
}

fn conditions(case: &BearingCase) -> Conditions<'static> {
    Conditions {
        temperature: case.temperature,
        feed_pressures: None,
    }
}

/// The film of example 02 at one position, with every closure.
fn films(criterion: &mut Criterion) {
    let study = example("02-big-end-diesel/study.toml");
    let case = case(&study);
    let speed = duty(&study).cycle.engine_speed;
    let at_rest = JournalState {
        position: [ECCENTRICITY_RATIO * case.bearing.radial_clearance, 0.0],
        journal_speed: speed,
        ..JournalState::default()
    };
    let [start, end] = warm_step(&at_rest);
    let duration = STEP_DEG.to_radians() / speed;
    let implicit = Step::Implicit {
        duration,
        after: 0.5 * duration,
    };
    let mut group = criterion.benchmark_group("film");
    for (name, cavitation, step) in [
        ("mass-conserving", Cavitation::MassConserving, implicit),
        ("reynolds", Cavitation::Reynolds, Step::Steady),
        ("gumbel", Cavitation::Gumbel, Step::Steady),
    ] {
        let bearing = Bearing {
            cavitation,
            film_shear: match cavitation {
                Cavitation::MassConserving => FilmShear::FilmFraction,
                _ => FilmShear::FullWidth,
            },
            ..case.bearing.clone()
        };
        // Studies with an aligned journal solve one half of this mirrored bearing.
        let new = || FilmSolver::aligned(&bearing, &case.lubricant, GRID).expect("a film");
        let whole = || FilmSolver::new(&bearing, &case.lubricant, GRID).expect("a film");
        group.throughput(updates(settle(&mut whole(), &at_rest, Step::Steady, case)));
        group.bench_function(format!("{name}-whole-cold"), |bencher| {
            bencher.iter_batched(
                whole,
                |mut film| {
                    settle(&mut film, &at_rest, Step::Steady, case);
                    film
                },
                BatchSize::PerIteration,
            );
        });

        group.throughput(updates(settle(&mut new(), &at_rest, Step::Steady, case)));
        group.bench_function(format!("{name}-cold"), |bencher| {
            bencher.iter_batched(
                new,
                |mut film| {
                    settle(&mut film, &at_rest, Step::Steady, case);
                    film
                },
                BatchSize::PerIteration,
            );
        });
        if cavitation == Cavitation::Gumbel {
            continue; // settled in one update, warm or cold
        }

        let mut film = new();
        let mut warm = move || {
            settle(&mut film, &start, Step::Steady, case);
            film.accept_step();
            let clock = Instant::now();
            let count = settle(&mut film, &end, step, case);
            (clock.elapsed(), count)
        };
        warm();
        group.throughput(updates(warm().1));
        group.bench_function(format!("{name}-warm"), |bencher| {
            bencher.iter_custom(|count| (0..count).map(|_| warm().0).sum());
        });
    }

    let plain = Bearing {
        feeds: Vec::new(),
        cavitation: Cavitation::Gumbel,
        film_shear: FilmShear::FullWidth,
        finish: sommerfeld_film::Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
        ..case.bearing.clone()
    };
    let viscosity = case.lubricant.viscosity(case.temperature, 0.0).value;
    let mut film = ShortBearingFilm::new(&plain, viscosity).expect("a film");
    group.throughput(updates(1));
    group.bench_function("short-bearing-update", |bencher| {
        bencher.iter(|| film.linearise(black_box(&at_rest), Step::Steady, &conditions(case)));
    });
    group.finish();
}

/// The journal before and after a step, at the velocity that takes it from one to the other.
fn warm_step(at_rest: &JournalState) -> [JournalState; 2] {
    let duration = STEP_DEG.to_radians() / at_rest.journal_speed;
    let (sine, cosine) = (PRECESSION_RATIO * STEP_DEG).to_radians().sin_cos();
    let [x, y] = at_rest.position;
    let end = [cosine * x - sine * y, sine * x + cosine * y];
    let velocity = [(end[0] - x) / duration, (end[1] - y) / duration];
    let start = JournalState {
        velocity,
        ..*at_rest
    };
    let end = JournalState {
        position: end,
        journal_angle: start.journal_angle + STEP_DEG.to_radians(),
        ..start
    };
    [start, end]
}

/// Film updates until the film at `state` has settled.
fn settle(film: &mut FilmSolver, state: &JournalState, step: Step, case: &BearingCase) -> u64 {
    let conditions = conditions(case);
    film.reject_step();
    let answer = film.react(state, step, &conditions).expect("a film");
    assert_eq!(answer.outcome, Outcome::Converged);
    black_box(answer);
    film.summary().iterations as u64
}

/// Film updates stand beside the times: criterion keeps them as its throughput.
fn updates(count: u64) -> Throughput {
    Throughput::Elements(count)
}

/// Example 01: Newton with film updates interleaved, from a cold film.
fn equilibrium(criterion: &mut Criterion) {
    let study = example("01-steady-main-bearing/study.toml");
    let case = case(&study);
    let Duty::Load(load) = &case.duty else {
        panic!("no steady load: {:?}", case.duty);
    };
    let TiltCondition::Fixed(tilt) = load.tilt else {
        panic!("the tilt is free");
    };
    let request = EquilibriumRequest {
        load: load.load,
        moment: None,
        frame: JournalState {
            tilt,
            journal_speed: load.journal_speed,
            shell_speed: load.shell_speed,
            ..JournalState::default()
        },
        start: None,
        settings: Default::default(),
    };
    let cells = study.film.grid;
    let new = || FilmSolver::aligned(&case.bearing, &case.lubricant, cells).expect("a film");
    let find = |mut film: FilmSolver| {
        let found = find_equilibrium(&mut film, &case.bearing, &request, &conditions(case))
            .expect("an equilibrium");
        assert_eq!(found.outcome, Outcome::Converged);
        found
    };
    let mut group = criterion.benchmark_group("equilibrium");
    group.throughput(updates(find(new()).film_updates as u64));
    group.bench_function("example-01", |bencher| {
        bencher.iter_batched(new, find, BatchSize::PerIteration);
    });
    group.finish();
}

/// One cycle of the orbit, the search for its start included.
fn load_cycles(criterion: &mut Criterion) {
    let field = example("02-big-end-diesel/study.toml");
    let short = example("03-one-axis-cycle/short-bearing.toml");
    assert_eq!(field.film.grid, GRID);
    let mut group = criterion.benchmark_group("cycle");

    let (duty_of_field, case_of_field) = (duty(&field), case(&field));
    let run = || {
        let (bearing, oil) = (&case_of_field.bearing, &case_of_field.lubricant);
        let mut film = FilmSolver::aligned(bearing, oil, GRID).expect("a film");
        one_cycle(&mut film, case_of_field, duty_of_field)
    };
    let orbit = run();
    group.throughput(updates(orbit.film_solves as u64));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.warm_up_time(Duration::from_millis(1));
    group.bench_function("example-02", |bencher| bencher.iter(run));

    let (duty_of_short, case_of_short) = (duty(&short), case(&short));
    let viscosity = case_of_short
        .lubricant
        .viscosity(case_of_short.temperature, 0.0)
        .value;
    let run = || {
        let mut film = ShortBearingFilm::new(&case_of_short.bearing, viscosity).expect("a film");
        one_cycle(&mut film, case_of_short, duty_of_short)
    };
    group.throughput(updates(run().film_solves as u64));
    group.sample_size(50).warm_up_time(Duration::from_secs(1));
    group.bench_function("example-03-short-bearing", |bencher| bencher.iter(run));
    group.finish();
}

fn one_cycle(film: &mut dyn FilmForce, case: &BearingCase, duty: &CycleDuty) -> JournalOrbit {
    let settings = OrbitSettings {
        crank_step: duty.crank_step,
        closure_tolerance: duty.closure_tolerance,
        cycle_limit: 1,
        ..OrbitSettings::default()
    };
    let orbit = journal_orbit(
        film,
        &case.bearing,
        &duty.cycle,
        &conditions(case),
        &settings,
        &mut |_, _, _| ControlFlow::Continue(()),
    )
    .expect("an orbit");
    // One cycle cannot close; all of its points must hold.
    assert!(orbit.points.iter().all(|p| p.outcome == Outcome::Converged));
    orbit
}
