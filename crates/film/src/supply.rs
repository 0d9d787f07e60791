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
    let around = |angle: f64| radius * ((angle - centre_angle + PI).rem_euclid(TAU) - PI);
    let reach = match feed.shape {
        FeedShape::Hole { diameter } => 0.5 * diameter,
        FeedShape::Rectangle { length, .. } => 0.5 * length,
        FeedShape::Circumferential { .. } => f64::INFINITY,
    };
    let mut any = false;
    for (i, &angle) in grid.around.iter().enumerate() {
        let around = around(angle);
        if around.abs() > reach {
            continue;
        }
        for (j, &zeta) in grid.axial.iter().enumerate() {
            if inside(feed.shape, around, radius * zeta - feed.position) {
                mark(i * grid.n_axial() + j);
                any = true;
            }
        }
    }
    if !any {
        let i = nearest(&grid.around, |angle| around(angle).abs());
        let j = nearest(&grid.axial, |zeta| (radius * zeta - feed.position).abs());
        mark(i * grid.n_axial() + j);
    }
}

/// Index of the place with the smallest distance.
fn nearest(places: &[f64], distance: impl Fn(f64) -> f64) -> usize {
    (0..places.len())
        .min_by(|&a, &b| distance(places[a]).total_cmp(&distance(places[b])))
        .unwrap_or(0)
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
