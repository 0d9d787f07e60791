//! Tables are built the same whatever happens on the way, keep what they were built from, and hold what they
//! state.
#![allow(clippy::panic, clippy::unwrap_used)]

mod common;

use common::{recipe, table};
use sommerfeld_database::{DatabaseError, Progress, Recipe, Table, check, generate};
use sommerfeld_film::{Cavitation, Inlet};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Ends a build after a number of films.
struct After {
    films: usize,
    asked: AtomicUsize,
    seen: AtomicUsize,
}

impl After {
    fn new(films: usize) -> Self {
        Self {
            films,
            asked: AtomicUsize::new(0),
            seen: AtomicUsize::new(0),
        }
    }
}

impl Progress for After {
    fn films(&self, done: usize, total: usize) {
        assert!(done <= total);
        self.seen.fetch_max(done, Ordering::Relaxed);
    }

    fn interrupted(&self) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed) >= self.films
    }
}

#[test]
fn an_interrupted_table_goes_on_to_the_same_one_on_any_number_of_threads() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("unfinished.h5");
    let recipe = recipe(Cavitation::Gumbel, 0.5, 5e-3);
    let on = |threads: usize| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap()
    };
    let whole = on(1).install(|| generate(&recipe, &(), None)).unwrap();
    let mut before = 0;
    for films in [250, 100] {
        let progress = After::new(films);
        let ended = on(3).install(|| generate(&recipe, &progress, Some(&path)));
        let Err(DatabaseError::Interrupted { done, total }) = ended else {
            panic!("{ended:?}")
        };
        assert!(done > before && done < total, "{before} {done} {total}");
        assert!(progress.seen.load(Ordering::Relaxed) >= done);
        before = done;
    }
    // Another recipe does not take these films for its own.
    let other = Recipe { seed: 2, ..recipe };
    let error = generate(&other, &(), Some(&path)).unwrap_err().to_string();
    assert!(error.contains("another recipe"), "{error}");
    let resumed = on(2)
        .install(|| generate(&recipe, &(), Some(&path)))
        .unwrap();
    assert_eq!(resumed, whole);
    assert!(!path.exists());
    // And the file keeps all of it.
    let file = directory.path().join("table.h5");
    whole.save(&file).unwrap();
    assert_eq!(Table::load(&file).unwrap(), whole);
    let errors = whole.errors();
    assert!(errors.median <= errors.quantile_999 && errors.quantile_999 <= errors.maximum);
    assert!(errors.maximum > 0.0 && errors.maximum <= recipe.target);
    assert!(errors.node_maximum > 0.0 && errors.node_maximum <= recipe.target);
}

/// Fresh states for the test command; `SOMMERFELD_FRESH_STATES` takes more of them, and the finer targets.
#[test]
fn fresh_states_stay_within_the_stated_error() {
    let more = std::env::var("SOMMERFELD_FRESH_STATES").ok();
    let samples = more.as_ref().map_or(300, |count| count.parse().unwrap());
    let targets: &[f64] = if more.is_some() {
        &[1e-3, 1e-4]
    } else {
        &[1e-3]
    };
    for target in targets {
        for closure in [Cavitation::Gumbel, Cavitation::Reynolds] {
            let begun = std::time::Instant::now();
            let table = table(closure, 0.5, *target);
            let built = begun.elapsed();
            let report = check(&table, samples, 4711).unwrap();
            let counts = table.axes().counts();
            println!(
                "{closure:?} {target:e} nodes {counts:?} in {built:?}, checked {:?}",
                begun.elapsed()
            );
            println!("{:?}\n{report:?}", table.errors());
            assert_eq!(report.samples, samples);
            assert!(report.maximum <= *target, "{report:?}");
            assert!(
                report.median > 0.0 && report.median < 0.1 * target,
                "{report:?}"
            );
            assert!(report.difference_maximum < 1e-6, "{report:?}");
            assert!(report.dissipation_minimum > 0.0, "{report:?}");
            assert!(report.tangent_quantile_99 < 1e-2, "{report:?}");
            assert!(report.peak_maximum < 5e-3, "{report:?}");
        }
    }
}

#[test]
fn width_ratios_between_the_nodes() {
    let recipe = Recipe {
        width_ratios: [0.4, 0.5],
        last_eccentricity: 0.9,
        ..recipe(Cavitation::Gumbel, 0.4, 1e-2)
    };
    let table = Arc::new(generate(&recipe, &(), None).unwrap());
    assert_eq!(table.axes().counts()[0], 9);
    let report = check(&table, 100, 3).unwrap();
    assert!(report.maximum <= 1e-2, "{report:?}");
    assert!(report.dissipation_minimum > 0.0);
}

#[test]
fn what_no_table_holds_is_refused_by_name() {
    let good = recipe(Cavitation::Reynolds, 0.5, 1e-3);
    let refused = [
        (
            Recipe {
                closure: Cavitation::MassConserving,
                ..good
            },
            "remembers its past",
        ),
        (
            Recipe {
                inlet: Inlet::MaxFilmLine { pressure: 0.0 },
                ..good
            },
            "cyclic",
        ),
        (
            Recipe {
                width_ratios: [0.5, 0.4],
                ..good
            },
            "width_ratios",
        ),
        (
            Recipe {
                width_ratios: [f64::NAN; 2],
                ..good
            },
            "width_ratios",
        ),
        (
            Recipe {
                target: 0.0,
                ..good
            },
            "target",
        ),
        (
            Recipe {
                last_eccentricity: 1.0,
                ..good
            },
            "last_eccentricity",
        ),
        (Recipe { samples: 0, ..good }, "samples"),
    ];
    for (recipe, word) in refused {
        let error = generate(&recipe, &(), None).unwrap_err().to_string();
        assert!(error.contains(word), "{error}");
    }
}
