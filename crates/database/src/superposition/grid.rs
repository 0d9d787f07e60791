//! Splines through the nodes of one drive, and what they give between them.

use super::Drive;
use super::build::{FIGURES, place_of};
use super::centre::Centre;
use super::tilt_box::{self, TiltPlace};
use crate::axis::{Axis, Placing};
use crate::error::DatabaseError;
use crate::spline::{End, coefficients, fit, weights};

/// Eccentricity down to which the moment of a wedge near the centre is divided by it.
const FIRST_NEAR_CENTRE: f64 = 1e-6;
/// Interpolated side by side: logarithm of the size, four shares of it, logarithm of the peak over it.
const LANES: usize = 6;

/// Nodes along the three axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shape {
    pub counts: [usize; 3],
}

impl Shape {
    pub(super) fn of(axes: &[Axis; 3]) -> Self {
        Self {
            counts: axes.each_ref().map(Axis::count),
        }
    }

    pub(super) fn nodes(&self) -> usize {
        self.counts.iter().product()
    }

    /// Indices along the axes of a node.
    pub(super) fn place(&self, index: usize) -> [usize; 3] {
        let [_, n_share, n_transverse] = self.counts;
        let row = index / n_transverse;
        [row / n_share, row % n_share, index % n_transverse]
    }

    pub(super) fn index(&self, [e, u, d]: [usize; 3]) -> usize {
        (e * self.counts[1] + u) * self.counts[2] + d
    }

    /// The node that stands at a node of a shape with as many nodes or one more between every two, along each axis.
    pub(super) fn within(&self, finer: Self, place: [usize; 3]) -> Option<[usize; 3]> {
        let mut own = place;
        for (axis, node) in own.iter_mut().enumerate() {
            let step = if finer.counts[axis] == self.counts[axis] {
                1
            } else {
                2
            };
            if *node % step != 0 {
                return None;
            }
            *node /= step;
        }
        Some(own)
    }
}

/// The axes as lookups need them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places([(Placing, usize); 3]);

impl Places {
    pub(super) fn of(axes: &[Axis; 3]) -> Self {
        Self(axes.each_ref().map(|axis| (axis.placing(), axis.count())))
    }

    fn reach(&self, axis: usize, value: f64) -> Reach {
        let (placing, count) = &self.0[axis];
        Reach::new(placing, *count, value)
    }
}

/// Where a state lies: the same for all drives.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    eps: f64,
    /// Tilts along and across.
    tilts: [f64; 2],
    /// Root of the sum of the squares of the three.
    size: f64,
    /// Share of the transverse tilt.
    transverse: f64,
    /// Coefficients along the axes.
    reach: [Reach; 3],
    /// Derivatives of both shares by eccentricity, tilt along and tilt across.
    slopes: [[f64; 3]; 2],
}

impl Spot {
    pub(super) fn new(places: &Places, eps: f64, [along, across]: [f64; 2]) -> Self {
        let is_tilted = places.0[1].1 > 1 || places.0[2].1 > 1;
        let tilt = match is_tilted {
            true => tilt_box::place(eps, along, across),
            false => TiltPlace::default(),
        };
        Self {
            eps,
            tilts: [along, across],
            size: (eps * eps + along * along + across * across).sqrt(),
            transverse: tilt.shares[1],
            reach: [
                places.reach(0, eps),
                places.reach(1, tilt.shares[0]),
                places.reach(2, tilt.shares[1]),
            ],
            slopes: tilt.slopes,
        }
    }

    /// The same with the transverse tilt turned round: its share is odd in it, the other even.
    pub(super) fn mirrored(&self, places: &Places) -> Self {
        let [share, transverse] = self.slopes;
        Self {
            tilts: [self.tilts[0], -self.tilts[1]],
            transverse: -self.transverse,
            reach: [
                self.reach[0],
                self.reach[1],
                places.reach(2, -self.transverse),
            ],
            slopes: [
                [share[0], share[1], -share[2]],
                [-transverse[0], -transverse[1], transverse[2]],
            ],
            ..*self
        }
    }
}

/// Integrals at a state with derivatives by relative eccentricity, tilt along and tilt across.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Looked {
    /// `Phi_1, Phi_2, Theta_1, Theta_2`; of the wedge over eps, the moments below the first eccentricity
    /// (1e-6 where the recipe has films near the centre) over a straight continuation of 1/eps.
    pub integrals: [f64; 4],
    /// Their derivatives.
    pub slopes: [[f64; 3]; 4],
    /// Largest `Pi`; of the wedge over eps. 0 where it was not asked for.
    pub peak: f64,
}

/// Integrals before those of the moment of a wedge are taken over eps.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Parts {
    /// `Phi_1, Phi_2`, of the wedge over eps, `Theta_1, Theta_2`.
    pub values: [f64; 4],
    /// Their derivatives by relative eccentricity, tilt along and tilt across.
    pub slopes: [[f64; 3]; 4],
    /// Largest `Pi`.
    pub peak: f64,
}

impl Parts {
    /// Turned into `other` by a share and its derivatives.
    fn towards(&self, other: &Self, share: f64, by: [f64; 3]) -> Self {
        Self {
            values: std::array::from_fn(|k| {
                self.values[k] + share * (other.values[k] - self.values[k])
            }),
            slopes: std::array::from_fn(|k| {
                std::array::from_fn(|which| {
                    let own = self.slopes[k][which];
                    own + share * (other.slopes[k][which] - own)
                        + by[which] * (other.values[k] - self.values[k])
                })
            }),
            peak: self.peak + share * (other.peak - self.peak),
        }
    }
}

/// Coefficients of the splines of one drive.
#[derive(Debug, Clone)]
pub(super) struct Fitted {
    /// Of a wedge, near the centre.
    centre: Option<Centre>,
    /// The first eccentricity that a moment of the wedge is divided by.
    first_of_wedge: Option<f64>,
    extents: [usize; 3],
    coefficients: Vec<f64>,
}

impl Fitted {
    /// Splines through the integrals and peaks at the nodes.
    pub(super) fn through(
        drive: Drive,
        axes: &[Axis; 3],
        shape: Shape,
        nodes: &[[f64; FIGURES]],
        centre: Option<Centre>,
    ) -> Result<Self, DatabaseError> {
        let mut values = Vec::with_capacity(shape.nodes() * LANES);
        for (index, node) in nodes.iter().enumerate() {
            let (eps, [along, across]) = place_of(axes, shape.place(index));
            // A tilted wedge has a moment at eps = 0, and its force grows with eps.
            let (wedge, drive) = match drive {
                Drive::Wedge => (eps, eps.hypot(along).hypot(across)),
                _ => (1.0, 1.0),
            };
            let parts = [node[0] / wedge, node[1] / wedge, node[2], node[3]];
            let size = parts.iter().map(|value| value * value).sum::<f64>().sqrt();
            values.push(size.ln());
            values.extend(parts.map(|value| value / size));
            values.push((node[4] / (size * drive)).ln());
        }
        if values.iter().any(|value| !value.is_finite()) {
            return Err(DatabaseError::Unsupported {
                reason: "a film of the database carries nothing: raise the first eccentricity",
            });
        }
        let extents = shape.counts.map(coefficients);
        let ends = [End::NotAKnot; 2];
        let [_, n_share, n_transverse] = shape.counts;
        let values = fit(&values, n_share * n_transverse * LANES, ends)?;
        let mut along = Vec::new();
        for line in values.chunks_exact(n_share * n_transverse * LANES) {
            along.extend(fit(line, n_transverse * LANES, ends)?);
        }
        let mut coefficients = Vec::new();
        for line in along.chunks_exact(n_transverse * LANES) {
            coefficients.extend(fit(line, LANES, ends)?);
        }
        let first = match centre {
            Some(_) => FIRST_NEAR_CENTRE,
            None => axes[0].value(0),
        };
        Ok(Self {
            centre,
            first_of_wedge: (drive == Drive::Wedge).then_some(first),
            extents,
            coefficients,
        })
    }

    /// Integrals and their derivatives, and the peak where it is asked for; see
    /// [`super::SuperpositionTable::lookup`].
    pub(super) fn lookup(&self, spot: &Spot, asks_peak: bool) -> Looked {
        let parts = self.parts(spot, asks_peak);
        let [inverse, inverse_slope] = match self.first_of_wedge {
            Some(first) => inverse_from(first, spot.eps),
            None => [1.0, 0.0],
        };
        let mut looked = Looked {
            integrals: parts.values,
            slopes: parts.slopes,
            peak: parts.peak * inverse,
        };
        for k in 2..4 {
            looked.integrals[k] *= inverse;
            looked.slopes[k] = looked.slopes[k].map(|slope| inverse * slope);
            looked.slopes[k][0] += inverse_slope * parts.values[k];
        }
        looked
    }

    /// Near the centre the curves of a wedge over its direction, far from it those over the axes.
    fn parts(&self, spot: &Spot, asks_peak: bool) -> Parts {
        let Some(centre) = &self.centre else {
            return self.of_axes(spot, asks_peak);
        };
        let [share, slope] = Centre::share_of_table(spot.size);
        if share >= 1.0 {
            return self.of_axes(spot, asks_peak);
        }
        let near = centre.lookup(spot.eps, spot.tilts, spot.size, asks_peak);
        if share <= 0.0 {
            return near;
        }
        let per_size = slope / spot.size;
        let by = [spot.eps, spot.tilts[0], spot.tilts[1]].map(|own| per_size * own);
        near.towards(&self.of_axes(spot, asks_peak), share, by)
    }

    fn of_axes(&self, spot: &Spot, asks_peak: bool) -> Parts {
        let (lanes, by_share) = self.sum(&spot.reach);
        // By eccentricity at fixed tilts, the shares move too.
        let [share, transverse] = spot.slopes;
        let slope = |lane: usize, which: usize| {
            let own = if which == 0 { by_share[0][lane] } else { 0.0 };
            own + by_share[1][lane] * share[which] + by_share[2][lane] * transverse[which]
        };
        let of_size: [f64; 3] = std::array::from_fn(|which| slope(0, which));
        let size = lanes[0].exp();
        let drive = match self.first_of_wedge {
            Some(_) => spot.size,
            None => 1.0,
        };
        let own = |k: usize| size * lanes[k + 1];
        Parts {
            values: std::array::from_fn(own),
            slopes: std::array::from_fn(|k| {
                std::array::from_fn(|which| size * slope(k + 1, which) + own(k) * of_size[which])
            }),
            peak: match asks_peak {
                true => size * lanes[5].exp() * drive,
                false => 0.0,
            },
        }
    }

    /// Lanes, and their derivatives by the values along the three axes.
    fn sum(&self, [e, u, d]: &[Reach; 3]) -> ([f64; LANES], [[f64; LANES]; 3]) {
        let (mut value, mut slopes) = ([0.0; LANES], [[0.0; LANES]; 3]);
        let [_, n_share, n_transverse] = self.extents;
        for i in 0..e.count {
            let (mut plane, mut by_share, mut by_transverse) =
                ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            for j in 0..u.count {
                let row = ((e.first + i) * n_share + u.first + j) * n_transverse + d.first;
                let (nodes, _) =
                    self.coefficients[row * LANES..(row + d.count) * LANES].as_chunks::<LANES>();
                // Of four nodes the compiler keeps both sums in registers.
                let [line, rise] = match <&[[f64; LANES]; 4]>::try_from(nodes) {
                    Ok(four) => along_line(four.as_slice(), d),
                    Err(_) => along_line(nodes, d),
                };
                add(&mut plane, u.value[j], &line);
                add(&mut by_share, u.slope[j], &line);
                add(&mut by_transverse, u.value[j], &rise);
            }
            add(&mut value, e.value[i], &plane);
            add(&mut slopes[0], e.slope[i], &plane);
            add(&mut slopes[1], e.value[i], &by_share);
            add(&mut slopes[2], e.value[i], &by_transverse);
        }
        (value, slopes)
    }
}

/// Value and derivative along the last axis.
#[inline(always)]
fn along_line(nodes: &[[f64; LANES]], d: &Reach) -> [[f64; LANES]; 2] {
    let (mut line, mut rise) = ([0.0; LANES], [0.0; LANES]);
    for ((node, value), slope) in nodes.iter().zip(&d.value).zip(&d.slope) {
        add(&mut line, *value, node);
        add(&mut rise, *slope, node);
    }
    [line, rise]
}

#[inline(always)]
fn add(sum: &mut [f64; LANES], factor: f64, node: &[f64; LANES]) {
    for (own, value) in sum.iter_mut().zip(node) {
        *own += factor * value;
    }
}

/// 1/eps and its derivative, below the first eccentricity along the tangent there: at eps = 0 a wedge has no
/// direction, and the moment of a tilted one over eps no limit.
fn inverse_from(first: f64, eps: f64) -> [f64; 2] {
    if eps >= first {
        [1.0 / eps, -1.0 / (eps * eps)]
    } else {
        [
            (2.0 * first - eps) / (first * first),
            -1.0 / (first * first),
        ]
    }
}

/// Coefficients that a value reaches along one axis, with their weights.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach {
    pub first: usize,
    count: usize,
    pub value: [f64; 4],
    pub slope: [f64; 4],
}

impl Reach {
    /// Beyond the ends of an axis the curves go on straight.
    pub(super) fn new(placing: &Placing, nodes: usize, value: f64) -> Self {
        if nodes == 1 {
            return Self {
                first: 0,
                count: 1,
                value: [1.0, 0.0, 0.0, 0.0],
                slope: [0.0; 4],
            };
        }
        let (place, per_value) = placing.place(value);
        let inside = place.clamp(0.0, (nodes - 1) as f64);
        let found = weights(inside, nodes);
        let beyond = place - inside;
        Self {
            first: found.first,
            count: 4,
            value: std::array::from_fn(|k| found.value[k] + beyond * found.slope[k]),
            slope: found.slope.map(|weight| weight * per_value),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::superposition::SuperpositionRecipe;

    #[test]
    fn a_spot_turned_round_is_that_of_the_tilt_turned_round() {
        let places = Places::of(&SuperpositionRecipe::tilted(2.0).axes().unwrap());
        for (eps, along, across) in [(0.3, 0.2, 0.4), (0.05, -0.3, -0.6), (0.8, 0.01, 0.0)] {
            let found = Spot::new(&places, eps, [along, across]).mirrored(&places);
            let expected = Spot::new(&places, eps, [along, -across]);
            assert_eq!((found.eps, found.tilts), (expected.eps, expected.tilts));
            assert!((found.size - expected.size).abs() < 1e-15);
            for (a, b) in found.reach.iter().zip(&expected.reach) {
                assert_eq!(a.first, b.first);
                for k in 0..4 {
                    assert!((a.value[k] - b.value[k]).abs() < 1e-12);
                    assert!((a.slope[k] - b.slope[k]).abs() < 1e-10);
                }
            }
            let slopes = found.slopes.as_flattened().iter();
            for (a, b) in slopes.zip(expected.slopes.as_flattened()) {
                assert!((a - b).abs() < 1e-12, "{a} {b}");
            }
        }
    }
}
