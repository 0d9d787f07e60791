//! Which cells hold oil at a feed pressure?
//!
//! A groove or hole holds its pressure and is full. Cells whose centre lies inside its outline are
//! fed; a hole smaller than a cell feeds the cell it lies in. What the journal carries turns with
//! it. What the outline gives or takes is read from the balance of its cells.

use crate::bearing::{Bearing, Carrier, Feed, FeedShape};
use crate::grid::Grid;
use crate::journal_state::JournalState;
use std::f64::consts::{PI, TAU};

/// Marks in `fed_by`, per cell, the feed (index into [`Bearing::feeds`]) that feeds it.
/// Where feeds overlap, the first one holds.
pub fn mark_fed_cells(
    bearing: &Bearing,
    grid: &Grid,
    state: &JournalState,
    fed_by: &mut [Option<usize>],
) {
    fed_by.fill(None);
    for (index, feed) in bearing.feeds.iter().enumerate().rev() {
        let turned = match feed.carried_by {
            Carrier::Shell => state.shell_angle,
            Carrier::Journal => state.journal_angle,
        };
        mark_feed(bearing, grid, feed, feed.angle + turned, |cell| {
            fed_by[cell] = Some(index);
        });
    }
}

fn mark_feed(
    bearing: &Bearing,
    grid: &Grid,
    feed: &Feed,
    centre_angle: f64,
    mut mark: impl FnMut(usize),
) {
    let radius = bearing.radius();
    let mut nearest = (f64::INFINITY, 0);
    let mut any = false;
    for (i, &angle) in grid.around.iter().enumerate() {
        let around = radius * ((angle - centre_angle + PI).rem_euclid(TAU) - PI);
        for (j, &zeta) in grid.axial.iter().enumerate() {
            let along = radius * zeta - feed.position;
            let cell = i * grid.n_axial() + j;
            if inside(feed.shape, around, along) {
                mark(cell);
                any = true;
            }
            let distance = match feed.shape {
                FeedShape::Circumferential { .. } => along.abs(),
                _ => around.hypot(along),
            };
            if distance < nearest.0 {
                nearest = (distance, cell);
            }
        }
    }
    if !any {
        mark(nearest.1);
    }
}

/// Whether the point at distance `around`, `along` (m) from the centre lies in the outline.
fn inside(shape: FeedShape, around: f64, along: f64) -> bool {
    match shape {
        FeedShape::Hole { diameter } => around.hypot(along) <= 0.5 * diameter,
        FeedShape::Rectangle { length, width } => {
            around.abs() <= 0.5 * length && along.abs() <= 0.5 * width
        }
        FeedShape::Circumferential { width } => along.abs() <= 0.5 * width,
    }
}
