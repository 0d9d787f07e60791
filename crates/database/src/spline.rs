//! Which smooth curve runs through evenly spaced nodes?
//!
//! Cubic B-splines on the unit grid, twice continuously differentiable:
//! ```text
//! s(x) = sum c_k B(x - k),   k = -1 ... n,   (c_{k-1} + 4 c_k + c_{k+1})/6 = value k
//! ```
//! with two more conditions, one at each end: the third derivative has no jump at the next node
//! (not-a-knot), the curve is even or odd about the end, or its bend follows from its slope. A surface is the tensor product: the
//! coefficients along one axis are fitted through those along the other. Error of a smooth function
//! f in one direction: h^4/384 f''''.
//! Reference: C. de Boor, A Practical Guide to Splines, Springer 1978, ch. IV and XVII.

use crate::error::DatabaseError;

/// Condition at one end of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// Third derivative without a jump at the node next to the end.
    NotAKnot,
    /// Mirrored about the end.
    Even,
    /// Mirrored and negated about the end; the value there is zero.
    Odd,
    /// Second derivative over the first one, both by the place counted inwards from the end.
    Bent(f64),
}

/// Coefficients per node of an axis with `count` nodes: two more than nodes, or one for a single node.
#[must_use]
pub fn coefficients(count: usize) -> usize {
    if count == 1 { 1 } else { count + 2 }
}

/// Coefficients of the curves through `values`: node-major, `lanes` curves side by side, so that value
/// `k` of lane `l` is `values[k * lanes + l]`. The coefficients are laid out alike, `coefficients(count)`
/// of them.
///
/// # Errors
/// [`DatabaseError::Unsupported`] for 2 to 4 nodes, or a number of values that is not a multiple of
/// `lanes`.
pub fn fit(values: &[f64], lanes: usize, ends: [End; 2]) -> Result<Vec<f64>, DatabaseError> {
    let count = values.len() / lanes.max(1);
    if count == 1 {
        return Ok(values.to_vec());
    }
    if count < 5 || lanes == 0 || !values.len().is_multiple_of(lanes) {
        return Err(DatabaseError::Unsupported {
            reason: "an axis of a table needs one node, or at least five",
        });
    }
    let n = count + 2;
    let mut rows = Rows::new(n, lanes);
    rows.end(0, ends[0], |k| k);
    for (k, node) in values.chunks_exact(lanes).enumerate() {
        for (offset, weight) in [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0].into_iter().enumerate() {
            rows.matrix[(k + 1) * n + k + offset] = weight;
        }
        rows.right[(k + 1) * lanes..(k + 2) * lanes].copy_from_slice(node);
    }
    rows.end(n - 1, ends[1], |k| n - 1 - k);
    Ok(rows.solve())
}

/// Linear equations of a fit: few hundred unknowns, bandwidth 5.
struct Rows {
    n: usize,
    lanes: usize,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

/// Farthest column of a row from its diagonal: the conditions at the ends reach four.
const REACH: usize = 4;

impl Rows {
    fn new(n: usize, lanes: usize) -> Self {
        Self {
            n,
            lanes,
            matrix: vec![0.0; n * n],
            right: vec![0.0; n * lanes],
        }
    }

    fn end(&mut self, row: usize, end: End, column: impl Fn(usize) -> usize) {
        let bent;
        let stencil: &[f64] = match end {
            End::NotAKnot => &[1.0, -4.0, 6.0, -4.0, 1.0],
            End::Even => &[1.0, 0.0, -1.0],
            End::Odd => &[1.0, -2.0, 1.0],
            End::Bent(ratio) => {
                bent = [1.0 + 0.5 * ratio, -2.0, 1.0 - 0.5 * ratio];
                &bent
            }
        };
        for (k, weight) in stencil.iter().enumerate() {
            self.matrix[row * self.n + column(k)] = *weight;
        }
    }

    /// Elimination of the band; the pivots of these rows do not vanish.
    fn solve(mut self) -> Vec<f64> {
        let (n, lanes) = (self.n, self.lanes);
        for pivot in 0..n {
            let last = (pivot + REACH + 1).min(n);
            for row in pivot + 1..last {
                let factor = self.matrix[row * n + pivot] / self.matrix[pivot * n + pivot];
                if factor == 0.0 {
                    continue;
                }
                for k in pivot..last {
                    self.matrix[row * n + k] -= factor * self.matrix[pivot * n + k];
                }
                let (above, below) = self.right.split_at_mut(row * lanes);
                let above = &above[pivot * lanes..(pivot + 1) * lanes];
                for (own, above) in below.iter_mut().zip(above) {
                    *own -= factor * above;
                }
            }
        }
        for row in (0..n).rev() {
            let (own, below) = self.right.split_at_mut((row + 1) * lanes);
            let own = &mut own[row * lanes..];
            for k in row + 1..(row + REACH + 1).min(n) {
                let factor = self.matrix[row * n + k];
                if factor != 0.0 {
                    let known = &below[(k - row - 1) * lanes..(k - row) * lanes];
                    for (own, known) in own.iter_mut().zip(known) {
                        *own -= factor * known;
                    }
                }
            }
            let pivot = self.matrix[row * n + row];
            for own in own {
                *own /= pivot;
            }
        }
        self.right
    }
}

/// Where a place lies on an axis: the first of four coefficients and their weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights {
    /// Index of the first coefficient.
    pub first: usize,
    /// Weights of the value.
    pub value: [f64; 4],
    /// Weights of the derivative by the place.
    pub slope: [f64; 4],
}

/// Weights at `place`, counted in nodes, on an axis of `count` > 1 nodes; places beyond the ends are
/// taken to the ends.
#[must_use]
pub fn weights(place: f64, count: usize) -> Weights {
    let last = (count - 1) as f64;
    let place = place.clamp(0.0, last);
    // Truncation is the floor of what is not negative.
    let first = (place as usize).min(count - 2);
    let t = place - first as f64;
    let u = 1.0 - t;
    let (t2, u2) = (t * t, u * u);
    Weights {
        first,
        value: [
            u2 * u / 6.0,
            (4.0 - 3.0 * t2 * (2.0 - t)) / 6.0,
            (4.0 - 3.0 * u2 * (2.0 - u)) / 6.0,
            t2 * t / 6.0,
        ],
        slope: [
            -0.5 * u2,
            0.5 * t * (3.0 * t - 4.0),
            -0.5 * u * (3.0 * u - 4.0),
            0.5 * t2,
        ],
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn value(coefficients: &[f64], place: f64) -> [f64; 2] {
        let w = weights(place, coefficients.len() - 2);
        let four = &coefficients[w.first..w.first + 4];
        let sum = |weights: [f64; 4]| weights.iter().zip(four).map(|(w, c)| w * c).sum::<f64>();
        [sum(w.value), sum(w.slope)]
    }

    #[test]
    fn a_cubic_is_reproduced_with_its_slope() {
        let f = |x: f64| 1.0 - 2.0 * x + 0.3 * x * x - 0.05 * x * x * x;
        let slope = |x: f64| -2.0 + 0.6 * x - 0.15 * x * x;
        let nodes: Vec<f64> = (0..9).map(|k| f(f64::from(k))).collect();
        let c = fit(&nodes, 1, [End::NotAKnot; 2]).unwrap();
        for k in 0..=160 {
            let x = 0.05 * f64::from(k);
            let [found, rise] = value(&c, x);
            assert!(
                (found - f(x)).abs() < 1e-12 && (rise - slope(x)).abs() < 1e-11,
                "{x}"
            );
        }
    }

    #[test]
    fn the_error_falls_with_the_fourth_power_and_ends_keep_their_symmetry() {
        // sin from 0 to pi/2 is odd about 0 and even about the end; two lanes keep apart.
        let error = |n: usize| {
            let h = std::f64::consts::FRAC_PI_2 / (n - 1) as f64;
            let nodes: Vec<f64> = (0..n)
                .flat_map(|k| [(h * k as f64).sin(), -3.0 * (h * k as f64).sin()])
                .collect();
            let both = fit(&nodes, 2, [End::Odd, End::Even]).unwrap();
            let c: Vec<f64> = both.iter().step_by(2).copied().collect();
            let other = both.iter().skip(1).step_by(2);
            assert!(
                other
                    .zip(&c)
                    .all(|(other, c)| (other + 3.0 * c).abs() < 1e-14)
            );
            assert!(value(&c, 0.0)[0].abs() < 1e-15);
            assert!(value(&c, (n - 1) as f64)[1].abs() < 1e-14);
            (0..=1000)
                .map(|k| {
                    let x = f64::from(k) / 1000.0 * (n - 1) as f64;
                    (value(&c, x)[0] - (h * x).sin()).abs()
                })
                .fold(0.0, f64::max)
        };
        let [coarse, fine] = [9, 17].map(error);
        assert!((14.0..18.0).contains(&(coarse / fine)), "{coarse} {fine}");
    }

    #[test]
    fn a_bend_given_by_the_slope_is_kept() {
        // exp(-x) bends as much as it falls; counted inwards from the right end the signs differ.
        let nodes: Vec<f64> = (0..9).map(|k| (-0.2 * f64::from(k)).exp()).collect();
        let c = fit(&nodes, 1, [End::Bent(-0.2), End::Bent(0.2)]).unwrap();
        // Cubic splines are off by 5/384 h^4 of the fourth derivative (C. A. Hall, J. Approx. Theory 1 (1968) 209).
        let bound = 1.1 * 5.0 / 384.0 * 0.2_f64.powi(4);
        for k in 0..=160 {
            let x = 0.05 * f64::from(k);
            assert!((value(&c, x)[0] - (-0.2 * x).exp()).abs() < bound, "{x}");
        }
        for (bend, slope) in [
            (c[0] - 2.0 * c[1] + c[2], 0.5 * (c[2] - c[0])),
            (c[10] - 2.0 * c[9] + c[8], 0.5 * (c[10] - c[8])),
        ] {
            assert!((bend + 0.2 * slope).abs() < 1e-15);
        }
    }

    #[test]
    fn too_few_nodes_are_refused() {
        assert!(fit(&[1.0, 2.0, 3.0], 1, [End::NotAKnot; 2]).is_err());
        assert_eq!(fit(&[4.0], 1, [End::NotAKnot; 2]).unwrap(), [4.0]);
    }
}
