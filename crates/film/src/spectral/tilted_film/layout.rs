//! Where around the bearing do the elements of a tilted film lie?
//!
//! ```text
//! S(theta) = theta + 1/2 sum 2 atan((a x n)/(1 - a . n)) = 2 pi k/count,    one a for each end
//! a = mu c/(1 + sqrt(1 - mu^2 c.c)),   c = e -+ s the centre at that end
//! ```
//! the mean of Sommerfeld's substitutions of both ends with a modulus mu times their eccentricity. It
//! is smooth in c, also where an end is centred, and so are the elements.
//! Reference: A. Sommerfeld, Z. Math. Phys. 50 (1904) 97.

use super::positive::{ElementRule, POINTS};
use super::{NODES, Place};
use std::f64::consts::TAU;

/// Modulus of the substitution over the relative eccentricity.
const MODULUS: f64 = 0.85;

/// An element.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Span {
    /// Angle at which it begins, rad.
    pub start: f64,
    /// Its arc, rad.
    pub width: f64,
    /// cos and sin at its nodes.
    pub trig: [[f64; 2]; NODES],
    /// The same at the points of a whole stretch.
    pub point_trig: [[f64; 2]; POINTS],
    /// Derivatives of start and arc by place.
    pub start_slope: Place,
    pub width_slope: Place,
}

/// All elements, from angle 0 on.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    spans: Vec<Span>,
}

/// The substitution of one end.
#[derive(Debug, Clone, Copy)]
struct End {
    /// a.
    pole: [f64; 2],
    /// Its derivative by the centre at this end: symmetric.
    slope: [[f64; 2]; 2],
    /// Share of the tilt in the centre at this end: -1 or 1.
    side: f64,
}

impl Layout {
    pub(super) fn new(count: usize) -> Self {
        Self {
            spans: vec![Span::default(); count],
        }
    }

    pub(super) fn count(&self) -> usize {
        self.spans.len()
    }

    pub(super) fn span(&self, element: usize) -> &Span {
        &self.spans[element]
    }

    /// The element of an angle in [0, 2 pi) and the place in it, from 0 to 1.
    pub(super) fn locate(&self, angle: f64) -> (usize, f64) {
        let behind = self.spans.partition_point(|span| span.start <= angle);
        let element = behind.saturating_sub(1);
        let span = &self.spans[element];
        (element, (angle - span.start) / span.width)
    }

    /// Elements for a place of the journal.
    pub(super) fn follow(&mut self, place: Place, rule: &ElementRule) {
        let ends = [-1.0, 1.0].map(|side| End::of(&place, side));
        let count = self.spans.len();
        let (mut start, mut start_slope) = (0.0, break_slope(&ends, 0.0));
        for (e, span) in self.spans.iter_mut().enumerate() {
            let (next, next_slope) = if e + 1 == count {
                (TAU, break_slope(&ends, 0.0))
            } else {
                let wanted = TAU * (e + 1) as f64 / count as f64 + substituted(&ends, 0.0);
                let next = angle_of(&ends, wanted, start);
                (next, break_slope(&ends, next))
            };
            let width = next - start;
            span.start = start;
            span.width = width;
            span.start_slope = start_slope;
            span.width_slope = std::array::from_fn(|q| next_slope[q] - start_slope[q]);
            let trig_at = |xi: f64| {
                let (sin, cos) = (start + width * xi).sin_cos();
                [cos, sin]
            };
            span.trig = rule.places.map(trig_at);
            span.point_trig = rule.points.map(|[xi, _]| trig_at(xi));
            (start, start_slope) = (next, next_slope);
        }
    }
}

impl End {
    fn of(place: &Place, side: f64) -> Self {
        let centre = [place[0] + side * place[2], place[1] + side * place[3]];
        let square = centre[0] * centre[0] + centre[1] * centre[1];
        let root = (1.0 - MODULUS * MODULUS * square).sqrt();
        let share = MODULUS / (1.0 + root);
        let bend = MODULUS * share * share / root;
        let slope = [0, 1].map(|i| {
            [0, 1].map(|j| bend * centre[i] * centre[j] + if i == j { share } else { 0.0 })
        });
        Self {
            pole: centre.map(|part| share * part),
            slope,
            side,
        }
    }

    /// `a x n` and `1 - a . n`.
    fn parts(&self, sin: f64, cos: f64) -> [f64; 2] {
        let [x, y] = self.pole;
        [x * sin - y * cos, 1.0 - x * cos - y * sin]
    }

    /// Slope of this end's S by theta.
    fn density(&self, sin: f64, cos: f64) -> f64 {
        let [x, y] = self.pole;
        let [across, along] = self.parts(sin, cos);
        (1.0 - x * x - y * y) / (across * across + along * along)
    }

    /// Slope of half this end's S by the centre at this end.
    fn by_centre(&self, sin: f64, cos: f64) -> [f64; 2] {
        let [across, along] = self.parts(sin, cos);
        let scale = 1.0 / (across * across + along * along);
        let by_pole = [
            scale * (along * sin + across * cos),
            scale * (across * sin - along * cos),
        ];
        self.slope
            .map(|row| row[0] * by_pole[0] + row[1] * by_pole[1])
    }
}

/// S, from 0 to 2 pi while theta goes there, but for a constant.
fn substituted(ends: &[End; 2], angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let turns = ends.iter().map(|end| {
        let [across, along] = end.parts(sin, cos);
        (across / along).atan()
    });
    angle + turns.sum::<f64>()
}

/// Derivative by place of the angle at which S is a given amount beyond S(0).
fn break_slope(ends: &[End; 2], angle: f64) -> Place {
    let (sin, cos) = angle.sin_cos();
    let density: f64 = 0.5 * ends.iter().map(|end| end.density(sin, cos)).sum::<f64>();
    let mut slope = [0.0; 4];
    for end in ends {
        let (here, at_start) = (end.by_centre(sin, cos), end.by_centre(0.0, 1.0));
        for i in 0..2 {
            let part = (at_start[i] - here[i]) / density;
            slope[i] += part;
            slope[2 + i] += end.side * part;
        }
    }
    slope
}

/// The angle behind `from` with this S: Newton inside a bracket.
fn angle_of(ends: &[End; 2], wanted: f64, from: f64) -> f64 {
    const STEPS: usize = 60;
    let (mut below, mut above) = (from, TAU);
    let mut angle = from;
    for _ in 0..STEPS {
        let off = substituted(ends, angle) - wanted;
        if off <= 0.0 {
            below = angle;
        } else {
            above = angle;
        }
        let (sin, cos) = angle.sin_cos();
        let density = 0.5 * (ends[0].density(sin, cos) + ends[1].density(sin, cos));
        let newton = angle - off / density;
        let next = if newton >= below && newton <= above {
            newton
        } else {
            0.5 * (below + above)
        };
        let change = (next - angle).abs();
        angle = next;
        if change < 1e-14 {
            break;
        }
    }
    angle
}
