//! Which cells hold oil at a feed pressure, and what a crank drilling adds to it?
//!
//! Cells whose centre lies inside the outline of a groove or hole are fed; a hole smaller than a cell
//! feeds the cell it lies in. What the journal carries turns with it. What the outline gives or takes
//! is read from the balance of its cells. Grid faces lie on the edges of grooves, so that their flow is
//! of second order. A hole follows no face: its cells are more or fewer with its place, and so is its
//! flow. A hole of 6 mm in a concentric bearing D 72, B 30 mm deviates from the closed form by up to
//! 16 % on 64 x 16 cells, 2 % on 128 x 32 and 3 % on 256 x 64; one of 3 mm by up to 12 % on 128 x 32
//! (`tests/groove_flow.rs`). Averaged over the places a turning hole passes it is less.
//!
//! Where outlines overlap, a hole opens into a groove:
//! - one of the two behind a line with a resistance: both are ONE POCKET with one pressure, their
//!   lines in parallel, so that oil may run from the groove through the hole's line and back;
//! - both held at their pressure without a line: nothing can give way, and the feed that is listed
//!   first holds the cells that both cover.

use crate::bearing::{Bearing, Carrier, Feed, FeedLine, FeedShape};
use crate::grid::Grid;
use crate::journal_state::JournalState;
use std::f64::consts::{PI, TAU};

/// Marks in `fed_by`, per cell, the feed (index into [`Bearing::feeds`]) that feeds it, the first
/// one where several cover it; and in `pocket`, per feed, the lowest index of the feeds that it is
/// one pocket with.
pub fn mark_fed_cells(
    bearing: &Bearing,
    grid: &Grid,
    state: &JournalState,
    fed_by: &mut [Option<usize>],
    pocket: &mut [usize],
) {
    fed_by.fill(None);
    for (index, pocket) in pocket.iter_mut().enumerate() {
        *pocket = index;
    }
    for (index, feed) in bearing.feeds.iter().enumerate().rev() {
        let turned = match feed.carried_by {
            Carrier::Shell => state.shell_angle,
            Carrier::Journal => state.journal_angle,
        };
        mark_feed(bearing, grid, feed, feed.angle + turned, |cell| {
            if let Some(other) = fed_by[cell]
                && (feed.line != FeedLine::Direct || bearing.feeds[other].line != FeedLine::Direct)
            {
                join(pocket, index, other);
            }
            fed_by[cell] = Some(index);
        });
    }
}

/// Makes one pocket of those of two feeds.
fn join(pocket: &mut [usize], a: usize, b: usize) {
    let (a, b) = (pocket[a], pocket[b]);
    for of_feed in pocket {
        if *of_feed == a || *of_feed == b {
            *of_feed = a.min(b);
        }
    }
}

/// Pressure, Pa, that a drilling in the turning crank adds between its inlet and its outlet, at these
/// distances (m) from the crank axis: `rho omega^2 (r_out^2 - r_in^2) / 2` for oil that turns with the
/// crank like a solid body. Density in kg/m3, crank speed in rad/s.
#[must_use]
pub fn drilling_head(density: f64, crank_speed: f64, inlet_radius: f64, outlet_radius: f64) -> f64 {
    0.5 * density
        * crank_speed
        * crank_speed
        * (outlet_radius + inlet_radius)
        * (outlet_radius - inlet_radius)
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
