//! When does an oil hole of the journal feed, when does the film push oil back into it, and when does
//! it open into a groove of the shell?
//!
//! Read off the orbit: the flow of the feed changes its sign between two points where the straight
//! line through them does; outlines meet where their clearance on the developed surface, in the same
//! way, becomes negative.

use crate::results::CycleResults;
use sommerfeld_film::{Bearing, Carrier, Feed, FeedShape, JournalState, Outcome};
use std::f64::consts::PI;

/// What one feed of the journal does over a cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct OilHole {
    /// Index into the feeds of the bearing.
    pub feed: usize,
    /// Mean flow into the film, m3/s.
    pub mean_flow: f64,
    /// Smallest flow, m3/s (negative: oil pushed back), and its crank angle, rad.
    pub minimum_flow: [f64; 2],
    /// Largest flow, m3/s, and its crank angle, rad.
    pub maximum_flow: [f64; 2],
    /// Crank angles from and to which the film pushes oil back, rad.
    pub backflow: Vec<[f64; 2]>,
    /// Share of the cycle in which it does.
    pub backflow_share: f64,
    /// Crank angles from and to which it opens into a groove or hole of the shell, rad.
    pub facing: Vec<[f64; 2]>,
    /// Share of the cycle in which it does.
    pub facing_share: f64,
}

/// The feeds that the journal carries; empty where no flows were recorded.
#[must_use]
pub fn oil_holes(cycle: &CycleResults) -> Vec<OilHole> {
    let count = cycle.orbit.points.len();
    if count < 2 || cycle.feed_flows.len() != count {
        return Vec::new();
    }
    let feeds = cycle.bearing.feeds.iter().enumerate();
    feeds
        .filter(|(_, feed)| feed.carried_by == Carrier::Journal)
        .map(|(index, feed)| oil_hole(cycle, index, feed))
        .collect()
}

fn oil_hole(cycle: &CycleResults, index: usize, feed: &Feed) -> OilHole {
    let points = &cycle.orbit.points;
    let angles: Vec<f64> = points.iter().map(|point| point.crank_angle).collect();
    let flows: Vec<f64> = cycle
        .feed_flows
        .iter()
        .map(|row| row.get(index).map_or(f64::NAN, |feed| feed.flow))
        .collect();
    let clearances: Vec<f64> = points
        .iter()
        .map(|point| clearance(&cycle.bearing, feed, &point.state))
        .collect();
    let is_closed = cycle.orbit.outcome == Outcome::Converged;
    let span = angles[angles.len() - 1] - angles[0];
    let share = |ranges: &[[f64; 2]]| ranges.iter().map(|[from, to]| to - from).sum::<f64>() / span;
    let backflow = negative_ranges(&angles, &flows, is_closed);
    let facing = negative_ranges(&angles, &clearances, is_closed);
    let extreme = |sign: f64| {
        let pairs = flows
            .iter()
            .zip(&angles)
            .filter(|(flow, _)| flow.is_finite());
        let best = pairs.reduce(|best, next| {
            if sign * next.0 > sign * best.0 {
                next
            } else {
                best
            }
        });
        best.map_or([f64::NAN; 2], |(flow, angle)| [*flow, *angle])
    };
    OilHole {
        feed: index,
        mean_flow: cycle.mean_of_feed(index, |feed| feed.flow),
        minimum_flow: extreme(-1.0),
        maximum_flow: extreme(1.0),
        backflow_share: share(&backflow),
        facing_share: share(&facing),
        backflow,
        facing,
    }
}

/// Ranges of `angles` in which `values`, straight between the angles, are negative; a range over the
/// end of a closed cycle is one, from its start to its end a period later.
fn negative_ranges(angles: &[f64], values: &[f64], is_closed: bool) -> Vec<[f64; 2]> {
    let (Some(&first), Some(&last)) = (angles.first(), angles.last()) else {
        return Vec::new();
    };
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    let mut start = values.first().filter(|v| **v < 0.0).map(|_| first);
    for (angle, value) in angles.windows(2).zip(values.windows(2)) {
        let crossing = angle[0] + value[0] / (value[0] - value[1]) * (angle[1] - angle[0]);
        match (start, value[1] < 0.0) {
            (None, true) => {
                start = Some(if value[0].is_finite() {
                    crossing
                } else {
                    angle[1]
                })
            }
            (Some(from), false) => {
                ranges.push([
                    from,
                    if value[1].is_finite() {
                        crossing
                    } else {
                        angle[0]
                    },
                ]);
                start = None;
            }
            _ => {}
        }
    }
    ranges.extend(start.map(|from| [from, last]));
    if is_closed && ranges.len() > 1 && ranges[0][0] == first && start.is_some() {
        let head = ranges.remove(0);
        if let Some(tail) = ranges.last_mut() {
            tail[1] += head[1] - first;
        }
    }
    ranges
}

/// Smallest distance between the outline of a feed of the journal and those of the shell, m; negative
/// where they overlap, infinite without any.
fn clearance(bearing: &Bearing, feed: &Feed, state: &JournalState) -> f64 {
    let grooves = bearing.feeds.iter();
    grooves
        .filter(|other| other.carried_by == Carrier::Shell)
        .map(|groove| {
            let angle = feed.angle + state.journal_angle - groove.angle - state.shell_angle;
            let around = bearing.radius() * ((angle + PI).rem_euclid(2.0 * PI) - PI).abs();
            let along = (feed.position - groove.position).abs();
            outline_clearance(feed.shape, groove.shape, around, along)
        })
        .fold(f64::INFINITY, f64::min)
}

/// Clearance of two outlines whose centres lie these distances apart, m.
fn outline_clearance(a: FeedShape, b: FeedShape, around: f64, along: f64) -> f64 {
    let half = |shape| match shape {
        FeedShape::Hole { .. } => [0.0, 0.0],
        FeedShape::Rectangle { length, width } => [0.5 * length, 0.5 * width],
        FeedShape::Circumferential { width } => [f64::INFINITY, 0.5 * width],
    };
    let radius = |shape| match shape {
        FeedShape::Hole { diameter } => 0.5 * diameter,
        _ => 0.0,
    };
    let ([la, wa], [lb, wb]) = (half(a), half(b));
    // A hole is a point with a radius: what lies outside the rectangle of both counts straight.
    let (dx, dz) = (around - la - lb, along - wa - wb);
    let outside = dx.max(0.0).hypot(dz.max(0.0));
    let inside = dx.max(dz).min(0.0);
    outside + inside - radius(a) - radius(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_begin_and_end_where_the_line_crosses_zero() {
        let angles = [0.0, 1.0, 2.0, 3.0, 4.0];
        let ranges = negative_ranges(&angles, &[-1.0, 1.0, 3.0, -1.0, -1.0], true);
        assert_eq!(ranges, [[2.75, 4.5]]);
        let open = negative_ranges(&angles, &[-1.0, 1.0, 3.0, -1.0, -1.0], false);
        assert_eq!(open, [[0.0, 0.5], [2.75, 4.0]]);
        assert_eq!(negative_ranges(&angles, &[-1.0; 5], true), [[0.0, 4.0]]);
        assert!(negative_ranges(&angles, &[0.0; 5], true).is_empty());
        let gap = negative_ranges(&angles, &[1.0, -1.0, f64::NAN, -1.0, 1.0], true);
        assert_eq!(gap, [[0.5, 1.0], [3.0, 3.5]]);
    }

    #[test]
    fn outlines_meet_at_their_edges() {
        let hole = FeedShape::Hole { diameter: 6.0 };
        let groove = FeedShape::Rectangle {
            length: 10.0,
            width: 4.0,
        };
        let ring = FeedShape::Circumferential { width: 4.0 };
        assert_eq!(outline_clearance(hole, hole, 3.0, 4.0), -1.0);
        assert_eq!(outline_clearance(hole, groove, 10.0, 1.0), 2.0);
        assert_eq!(outline_clearance(groove, hole, 8.0, 6.0), 2.0);
        assert!(outline_clearance(hole, groove, 7.9, 0.0) < 0.0);
        assert_eq!(outline_clearance(hole, ring, 1e3, 6.0), 1.0);
        assert!(outline_clearance(groove, ring, 1e3, 3.0) < 0.0);
    }
}
