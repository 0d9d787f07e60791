//! After its first call an update of the film allocates nothing: it sits in the innermost loop of
//! every orbit.
#![allow(clippy::unwrap_used, unsafe_code)]

mod common;

use common::{big_end, conditions, feed_hole, oil};
use sommerfeld_film::{
    Bearing, Cavitation, Feature, Feed, FeedLine, FilmForce, FilmSolver, Inlet, JournalState,
    OnlineFilm, Outcome, ProfileTable, Shape, Step,
};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The system's allocator, counting per thread.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

fn count() {
    // A thread that ends has no counter any more.
    let _ = ALLOCATIONS.try_with(|n| n.set(n.get() + 1));
}

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations() -> usize {
    ALLOCATIONS.with(Cell::get)
}

/// A journal on its way around, at step `k`.
fn state(bearing: &Bearing, k: usize, duration: f64) -> JournalState {
    let at = |k: f64| {
        let angle = 0.3 * k;
        [angle.cos(), angle.sin()].map(|d| 0.7 * bearing.radial_clearance * d)
    };
    let (now, before) = (at(k as f64), at(k as f64 - 1.0));
    JournalState {
        position: now,
        velocity: [0, 1].map(|d: usize| (now[d] - before[d]) / duration),
        tilt: [1e-4 * (k as f64).sin(), 5e-5],
        journal_speed: 200.0,
        journal_angle: 200.0 * duration * k as f64,
        ..JournalState::default()
    }
}

#[test]
fn an_update_allocates_nothing_after_the_first() {
    let duration = 1e-4;
    let plain = || Bearing {
        // Without a line, and behind one.
        feeds: vec![
            Feed {
                angle: 4.0,
                ..feed_hole()
            },
            Feed {
                line: FeedLine::Resistive { resistance: 5e10 },
                ..feed_hole()
            },
        ],
        ..big_end()
    };
    for cavitation in [
        Cavitation::Gumbel,
        Cavitation::Reynolds,
        Cavitation::MassConserving,
    ] {
        for (inlet, step) in [
            (Inlet::Cyclic, Step::Steady),
            (
                Inlet::Cyclic,
                Step::Implicit {
                    duration,
                    after: 0.0,
                },
            ),
            (Inlet::MaxFilmLine { pressure: 1e5 }, Step::Steady),
        ] {
            let bearing = Bearing {
                cavitation,
                inlet,
                feeds: if inlet == Inlet::Cyclic {
                    plain().feeds
                } else {
                    Vec::new()
                },
                ..plain()
            };
            let mut film = FilmSolver::new(&bearing, &oil(), [64, 16]).unwrap();
            film.linearise(&state(&bearing, 0, duration), step, &conditions())
                .unwrap();
            film.accept_step();
            let before = allocations();
            let mut updates = 0;
            for k in 1..=20 {
                let state = state(&bearing, k, duration);
                for _ in 0..4 {
                    let answer = film.linearise(&state, step, &conditions()).unwrap();
                    assert_eq!(answer.outcome, Outcome::Converged);
                    updates += 1;
                }
                film.reject_step();
                film.linearise(&state, step, &conditions()).unwrap();
                film.accept_step();
            }
            let made = allocations() - before;
            assert_eq!(made, 0, "{cavitation:?} {step:?}: {updates} updates");
        }
    }
    // With profiles that turn, steps and tables.
    let nodes = (0..32).map(|k| 0.19 * f64::from(k)).collect();
    let offsets = (0..64).map(|k| 1e-7 * f64::from(k % 7)).collect();
    let table = ProfileTable::new(nodes, vec![-0.015, 0.015], offsets).unwrap();
    let bearing = Bearing {
        bore: Shape::of([
            Feature::OffsetHalves {
                shift: 10e-6,
                joint: 0.0,
            },
            Feature::Table(table),
        ]),
        journal: Shape::of([Feature::Harmonic {
            order: 2,
            amplitude: 2e-6,
            phase: 0.0,
        }]),
        ..plain()
    };
    let mut film = FilmSolver::new(&bearing, &oil(), [64, 16]).unwrap();
    let step = Step::Implicit {
        duration,
        after: 0.0,
    };
    film.linearise(&state(&bearing, 0, duration), step, &conditions())
        .unwrap();
    film.accept_step();
    let before = allocations();
    for k in 1..=10 {
        let state = state(&bearing, k, duration);
        film.linearise(&state, step, &conditions()).unwrap();
        assert!(film.minimum_gap(&state) > 0.0);
        film.accept_step();
    }
    assert_eq!(allocations(), before, "with profiles");
    // Films on line.
    for cavitation in [Cavitation::Gumbel, Cavitation::Reynolds] {
        let bearing = Bearing {
            feeds: Vec::new(),
            cavitation,
            ..plain()
        };
        let mut film = OnlineFilm::aligned(&bearing, &oil()).unwrap();
        let aligned = |k| JournalState {
            tilt: [0.0; 2],
            tilt_rate: [0.0; 2],
            ..state(&bearing, k, duration)
        };
        let first = aligned(0);
        film.linearise(&first, Step::Steady, &conditions()).unwrap();
        let before = allocations();
        for k in 1..=10 {
            let state = aligned(k);
            let answer = film.linearise(&state, Step::Steady, &conditions()).unwrap();
            assert_eq!(answer.outcome, Outcome::Converged);
            assert!(film.summary().peak_film_pressure.value > 0.0);
            film.accept_step();
        }
        assert_eq!(allocations(), before, "{cavitation:?} on line");
    }
    // The counter counts.
    let before = allocations();
    drop(std::hint::black_box(vec![0_u8; 64]));
    assert_eq!(allocations(), before + 1);
}
