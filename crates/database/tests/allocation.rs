//! A lookup allocates nothing: it sits in the innermost loop of every orbit.
#![allow(clippy::unwrap_used, unsafe_code)]

mod common;

use common::{CONDITIONS, VISCOSITY, state, table, unit_bearing};
use sommerfeld_database::TableFilm;
use sommerfeld_film::{Cavitation, FilmForce, Step};
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

#[test]
fn a_lookup_allocates_nothing() {
    let bearing = unit_bearing(Cavitation::Gumbel, 0.5);
    let mut film =
        TableFilm::new(table(Cavitation::Gumbel, 0.5, 2e-2), &bearing, VISCOSITY).unwrap();
    let before = ALLOCATIONS.with(Cell::get);
    assert!(before > 0);
    let mut sum = 0.0;
    for k in 0..1000 {
        let seen = film
            .react(&state(&bearing, k, 0.9999), Step::Steady, &CONDITIONS)
            .unwrap();
        sum += seen.tangent.by_position[0][0] + film.summary().peak_film_pressure.value;
        film.accept_step();
    }
    assert!(sum.is_finite());
    assert_eq!(ALLOCATIONS.with(Cell::get), before);
}
