//! Smooth surfaces through the nodes of a table: tensor products of splines over relative
//! eccentricity and direction, one for each width ratio or one between them.
//!
//! A journal at the eccentricity -eps that moves at some angle from its line of centres is one at eps on the
//! other side, which moves at pi minus that angle: the direction's coordinate changes its sign. So the
//! nodes go on beyond the centre, and the surfaces are as smooth there as anywhere.

use crate::axis::Axis;
use crate::direction::Direction;
use crate::error::DatabaseError;
use crate::spline::{End, Weights, coefficients, fit, weights};

/// Coefficients of `L` surfaces over (relative eccentricity, direction), side by side.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Surface<const L: usize> {
    /// Nodes along eccentricity and direction.
    counts: [usize; 2],
    coefficients: Vec<[f64; L]>,
}

/// Value and derivatives by the places along eccentricity and direction, counted in nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Looked<const L: usize> {
    pub value: [f64; L],
    pub by_eccentricity: [f64; L],
    pub by_direction: [f64; L],
}

/// What a value becomes when the sense of rotation is mirrored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mirrored {
    /// The same: its slope vanishes at both ends of the direction.
    Same,
    /// The same, but for a kink where the gap opens, as of two peaks that change places.
    Peak,
    /// The negative.
    Negative,
    /// An angle: pi less the angle, where the narrowest gap changes sides too.
    Angle,
}

impl Mirrored {
    /// The coefficient beyond the centre of that of the other direction.
    fn beyond_centre(self, coefficient: f64) -> f64 {
        match self {
            Self::Same | Self::Peak => coefficient,
            Self::Negative => -coefficient,
            Self::Angle => std::f64::consts::PI - coefficient,
        }
    }
}

/// Nodes beyond the centre: what lies farther has no weight left, each node passes on about a quarter.
const BEYOND: usize = 12;

impl<const L: usize> Surface<L> {
    /// Surfaces through `values`, direction fastest, then eccentricity. `bends` tells of each eccentricity how
    /// what is negative when mirrored bends at the ends of the direction ([`End::Bent`]).
    pub fn through(
        counts: [usize; 2],
        values: &[[f64; L]],
        mirrored: [Mirrored; L],
        bends: &[f64],
    ) -> Result<Self, DatabaseError> {
        let [eccentricities, directions] = counts;
        let wide = coefficients(directions);
        // Along the direction, one lane after the other, as their ends differ.
        let beyond = BEYOND.min(eccentricities - 1);
        let mut rows = vec![[0.0; L]; (beyond + eccentricities) * wide];
        for (lane, mirror) in mirrored.into_iter().enumerate() {
            for (e, bend) in bends.iter().enumerate().take(eccentricities) {
                let ends = match mirror {
                    Mirrored::Same => [End::Even; 2],
                    Mirrored::Peak => [End::NotAKnot, End::Even],
                    Mirrored::Negative => [End::Bent(*bend); 2],
                    Mirrored::Angle => [End::NotAKnot; 2],
                };
                let nodes: Vec<f64> = values[e * directions..(e + 1) * directions]
                    .iter()
                    .map(|node| node[lane])
                    .collect();
                for (d, c) in fit(&nodes, 1, ends)?.into_iter().enumerate() {
                    rows[(beyond + e) * wide + d][lane] = c;
                    if (1..=beyond).contains(&e) {
                        let opposite = (beyond - e) * wide + wide - 1 - d;
                        rows[opposite][lane] = mirror.beyond_centre(c);
                    }
                }
            }
        }
        let flat = fit(rows.as_flattened(), wide * L, [End::NotAKnot; 2])?;
        let (coefficients, _) = flat.as_chunks::<L>();
        Ok(Self {
            counts,
            coefficients: coefficients[beyond * wide..].to_vec(),
        })
    }

    /// Surfaces at a width ratio between those of `slices`, which stand at the nodes of `axis`.
    pub fn between(slices: &[Self], axis: &Axis, width_ratio: f64) -> Result<Self, DatabaseError> {
        let Some(first) = slices.first() else {
            return Err(DatabaseError::Unsupported {
                reason: "a table without width ratios",
            });
        };
        if slices.len() == 1 {
            return Ok(first.clone());
        }
        let flat: Vec<f64> = slices
            .iter()
            .flat_map(|slice| slice.coefficients.as_flattened())
            .copied()
            .collect();
        let lanes = first.coefficients.len() * L;
        let all = fit(&flat, lanes, [End::NotAKnot; 2])?;
        let at = weights(axis.place(width_ratio).0, axis.count());
        let mut coefficients = vec![[0.0; L]; first.coefficients.len()];
        for (k, weight) in at.value.into_iter().enumerate() {
            let from = (at.first + k) * lanes;
            let slice = &all[from..from + lanes];
            for (own, c) in coefficients.as_flattened_mut().iter_mut().zip(slice) {
                *own += weight * c;
            }
        }
        Ok(Self {
            counts: first.counts,
            coefficients,
        })
    }

    /// Looks up a place counted in nodes: eccentricity, which goes on beyond its last node, and
    /// direction.
    #[inline]
    pub fn look(&self, eccentricity: f64, direction: f64) -> Looked<L> {
        let mut along = weights(eccentricity, self.counts[0]);
        let beyond = eccentricity - (self.counts[0] - 1) as f64;
        if beyond > 0.0 {
            go_on(&mut along, beyond);
        }
        let around = weights(direction, self.counts[1]);
        let wide = self.counts[1] + 2;
        let mut found = Looked {
            value: [0.0; L],
            by_eccentricity: [0.0; L],
            by_direction: [0.0; L],
        };
        for row in 0..4 {
            let from = (along.first + row) * wide + around.first;
            let four = &self.coefficients[from..from + 4];
            let mut value = [0.0; L];
            let mut slope = [0.0; L];
            for (k, c) in four.iter().enumerate() {
                for lane in 0..L {
                    value[lane] += around.value[k] * c[lane];
                    slope[lane] += around.slope[k] * c[lane];
                }
            }
            for lane in 0..L {
                found.value[lane] += along.value[row] * value[lane];
                found.by_direction[lane] += along.value[row] * slope[lane];
                found.by_eccentricity[lane] += along.slope[row] * value[lane];
            }
        }
        found
    }

    /// Values at a node of the direction and their derivatives by the place along the eccentricity, both in
    /// the centre.
    fn rise_at_centre(&self, direction: f64) -> [f64; L] {
        self.look(0.0, direction).by_eccentricity
    }
}

/// Weights beyond the last node, where value, slope and bend go on: the bend falls to its e-th part
/// in a node, so that the slope tends to a limit.
#[cold]
fn go_on(weights: &mut Weights, beyond: f64) {
    let left = (-beyond).exp();
    // Integrals of what is left of the bend.
    let (bent, risen) = (1.0 - left, beyond - (1.0 - left));
    // Bend at the last node.
    let bend = [0.0, 1.0, -2.0, 1.0];
    for (k, bend) in bend.into_iter().enumerate() {
        weights.value[k] += beyond * weights.slope[k] + risen * bend;
        weights.slope[k] += bent * bend;
    }
}

/// Makes a surface of forces smooth in the centre.
///
/// To first order in the eccentricity a smooth film gains `cos(angle)` times a number where mirroring it leaves
/// the value, and `sin(angle)` times one where it turns the sign: that is a plane over the journal's position.
/// A spline rises by that up to its own error, which leaves a cone with a kink in the centre. Within the first
/// nodes around it the difference is added, with a weight that rises from 0 by 1 per node and ends smoothly:
/// ```text
/// x (1 - x^2)^3,   x the place along the eccentricity
/// ```
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Centre {
    /// Coefficients of the spline's rise over the direction.
    rises: Vec<[f64; 2]>,
    /// Rises of the plane, for `cos` and for `sin`.
    plane: [f64; 2],
}

impl Centre {
    /// For surfaces of which the first is the same when mirrored, the second the negative.
    pub fn of(surface: &Surface<2>) -> Self {
        let directions = surface.counts[1];
        let wide = directions + 2;
        let row = |row: usize| &surface.coefficients[row * wide..(row + 1) * wide];
        // Slope of the spline over the first node.
        let rises = row(0)
            .iter()
            .zip(row(2))
            .map(|(before, behind)| [0, 1].map(|lane| 0.5 * (behind[lane] - before[lane])))
            .collect();
        let (mut sums, mut squares) = ([0.0; 2], [0.0; 2]);
        for node in 0..directions {
            let place = 2.0 * node as f64 / (directions - 1) as f64 - 1.0;
            let (sin, cos) = Direction::angle(0.0, place).sin_cos();
            let rise = surface.rise_at_centre(node as f64);
            for (lane, share) in [cos, sin].into_iter().enumerate() {
                sums[lane] += share * rise[lane];
                squares[lane] += share * share;
            }
        }
        Self {
            rises,
            plane: [sums[0] / squares[0], sums[1] / squares[1]],
        }
    }

    /// What is to be added at places below 1 along the eccentricity, the arguments as in [`Surface::look`]. The
    /// angle is the one that the direction has in the centre, for which plane and rise belong together.
    #[cold]
    pub fn look(&self, eccentricity: f64, direction: f64) -> Looked<2> {
        let around = weights(direction, self.rises.len() - 2);
        let square = eccentricity * eccentricity;
        let rest = 1.0 - square;
        let weight = eccentricity * rest * rest * rest;
        let weight_slope = rest * rest * (1.0 - 7.0 * square);
        // t = tan(pi/4 - angle/2), and its derivative by the place.
        let per_place = 2.0 * 1.0_f64.asinh() / (self.rises.len() - 3) as f64;
        let t = (per_place * direction - 1.0_f64.asinh()).sinh();
        let t_slope = per_place * (1.0 + t * t).sqrt();
        let per_square = 1.0 / (1.0 + t * t);
        let (cos, sin) = (2.0 * t * per_square, (1.0 - t * t) * per_square);
        let turn = -2.0 * t_slope * per_square;
        let mut added = Looked {
            value: [0.0; 2],
            by_eccentricity: [0.0; 2],
            by_direction: [0.0; 2],
        };
        for (lane, [share, turned]) in [[cos, -sin], [sin, cos]].into_iter().enumerate() {
            let (mut rise, mut slope) = (0.0, 0.0);
            for k in 0..4 {
                let c = self.rises[around.first + k][lane];
                rise += around.value[k] * c;
                slope += around.slope[k] * c;
            }
            let missing = self.plane[lane] * share - rise;
            added.value[lane] = weight * missing;
            added.by_eccentricity[lane] = weight_slope * missing;
            added.by_direction[lane] = weight * (self.plane[lane] * turned * turn - slope);
        }
        added
    }
}
