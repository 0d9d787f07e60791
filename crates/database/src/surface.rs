//! Smooth surfaces through the nodes of a table: tensor products of splines over relative
//! eccentricity and direction, one for each width ratio or one between them.
//!
//! A journal at the eccentricity -eps that moves at some angle from its line of centres is one at eps on the
//! other side, which moves at pi minus that angle: the direction's coordinate changes its sign. So the
//! nodes go on beyond the centre, and the surfaces are as smooth there as anywhere.

use crate::axis::Axis;
use crate::error::DatabaseError;
use crate::spline::{End, coefficients, fit, weights};

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
    /// The negative.
    Negative,
    /// An angle: pi less the angle, where the narrowest gap changes sides too.
    Angle,
}

impl Mirrored {
    /// The coefficient beyond the centre of that of the other direction.
    fn beyond_centre(self, coefficient: f64) -> f64 {
        match self {
            Self::Same => coefficient,
            Self::Negative => -coefficient,
            Self::Angle => std::f64::consts::PI - coefficient,
        }
    }
}

/// Nodes beyond the centre: what lies farther has no weight left, each node passes on about a quarter.
const BEYOND: usize = 12;

impl<const L: usize> Surface<L> {
    /// Surfaces through `values`, direction fastest, then eccentricity.
    pub fn through(
        counts: [usize; 2],
        values: &[[f64; L]],
        mirrored: [Mirrored; L],
    ) -> Result<Self, DatabaseError> {
        let [eccentricities, directions] = counts;
        let wide = coefficients(directions);
        // Along the direction, one lane after the other, as their ends differ.
        let beyond = BEYOND.min(eccentricities - 1);
        let mut rows = vec![[0.0; L]; (beyond + eccentricities) * wide];
        for (lane, mirror) in mirrored.into_iter().enumerate() {
            let end = if mirror == Mirrored::Same {
                End::Even
            } else {
                End::NotAKnot
            };
            for e in 0..eccentricities {
                let nodes: Vec<f64> = values[e * directions..(e + 1) * directions]
                    .iter()
                    .map(|node| node[lane])
                    .collect();
                for (d, c) in fit(&nodes, 1, [end; 2])?.into_iter().enumerate() {
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

    /// Looks up a place counted in nodes: eccentricity, which goes on linearly beyond its last node,
    /// and direction.
    pub fn look(&self, eccentricity: f64, direction: f64) -> Looked<L> {
        let along = weights(eccentricity, self.counts[0]);
        let around = weights(direction, self.counts[1]);
        let wide = self.counts[1] + 2;
        let mut found = Looked {
            value: [0.0; L],
            by_eccentricity: [0.0; L],
            by_direction: [0.0; L],
        };
        let beyond = eccentricity - (self.counts[0] - 1) as f64;
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
            let weight = along.value[row] + beyond.max(0.0) * along.slope[row];
            for lane in 0..L {
                found.value[lane] += weight * value[lane];
                found.by_direction[lane] += weight * slope[lane];
                found.by_eccentricity[lane] += along.slope[row] * value[lane];
            }
        }
        found
    }
}
