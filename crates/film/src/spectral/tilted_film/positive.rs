//! What of a polynomial on an element is positive?
//!
//! The nodes tell where it changes sign; Newton's method finds its zeros between them. Each
//! positive stretch has the Gauss-Lobatto rule of a whole element, so that nothing jumps as a zero leaves
//! the element.

use super::{DEGREE, Gap, NODES, Place};
use crate::spectral::quadrature::Element;

/// Gauss-Lobatto points of a stretch: what they miss would have to be derived by the place of the zeros.
pub(super) const POINTS: usize = 11;

/// The polynomials of an element, on [0, 1].
#[derive(Debug, Clone)]
pub(super) struct ElementRule {
    /// Gauss-Lobatto nodes and weights.
    pub places: [f64; NODES],
    pub weights: [f64; NODES],
    /// Slope at a node (row) of the polynomial of another.
    pub slopes: [[f64; NODES]; NODES],
    /// Coefficients by powers (row) of the polynomial of a node.
    powers: [[f64; NODES]; NODES],
    /// Points of a whole stretch with weights, and the values there of the polynomials of all nodes.
    pub points: [[f64; 2]; POINTS],
    pub shares: [[f64; NODES]; POINTS],
}

/// Integrals over the positive part of an element, in its own coordinate.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sums {
    /// Of `p (n, Z n)`.
    pub whole: Place,
    /// What they change by per turn of all of the element, and per turn that grows along it.
    pub turned: Place,
    pub stretched: Place,
    /// Their derivatives by place where pressure falls with the gap, u at rest.
    pub by_place: [Place; 4],
    /// Of 1 over all lines.
    pub length: f64,
}

impl Sums {
    /// Adds a point at a place in the element and a Z, with its weight, u, n and gap; returns what it adds to
    /// `whole` per u.
    #[inline]
    pub(super) fn add(
        &mut self,
        [xi, z, weight]: [f64; 3],
        u: f64,
        [cos, sin]: [f64; 2],
        gap: &Gap,
    ) -> Place {
        let [height, slope] = gap.on(z);
        let inverse = 1.0 / height;
        let scale = weight * inverse * inverse;
        let outward = [cos, sin, z * cos, z * sin];
        let across = [-sin, cos, -z * sin, z * cos];
        let fall = 2.0 * inverse;
        self.length += weight;
        for r in 0..4 {
            let part = scale * u * outward[r];
            let turn = scale * u * (across[r] - fall * slope * outward[r]);
            self.whole[r] += part;
            self.turned[r] += turn;
            self.stretched[r] += xi * turn;
            for q in 0..4 {
                self.by_place[r][q] += part * fall * outward[q];
            }
        }
        outward.map(|n| scale * n)
    }
}

impl ElementRule {
    pub(super) fn new() -> Self {
        let element = Element::new(DEGREE);
        let places: [f64; NODES] = std::array::from_fn(|i| element.nodes[i]);
        let mut powers = [[0.0; NODES]; NODES];
        for node in 0..NODES {
            let mut product = [0.0; NODES];
            product[0] = 1.0;
            for other in (0..NODES).filter(|&other| other != node) {
                let scale = 1.0 / (places[node] - places[other]);
                for power in (0..NODES).rev() {
                    let below = if power > 0 { product[power - 1] } else { 0.0 };
                    product[power] = scale * (below - places[other] * product[power]);
                }
            }
            for power in 0..NODES {
                powers[power][node] = product[power];
            }
        }
        let fine = Element::new(POINTS - 1);
        let mut rule = Self {
            places,
            weights: std::array::from_fn(|i| element.weights[i]),
            slopes: std::array::from_fn(|i| std::array::from_fn(|j| element.slopes[i][j])),
            powers,
            points: std::array::from_fn(|k| [fine.nodes[k], fine.weights[k]]),
            shares: [[0.0; NODES]; POINTS],
        };
        rule.shares = rule.points.map(|[xi, _]| rule.basis(xi));
        rule
    }

    /// Hands over the places and weights of all positive stretches.
    pub(super) fn stretches(&self, values: &[f64; NODES], mut hand: impl FnMut(f64, f64)) {
        let mut begin = 0.0;
        for i in 0..NODES {
            let is_positive = values[i] >= 0.0;
            let changes = i + 1 < NODES && is_positive != (values[i + 1] >= 0.0);
            let end = if changes {
                self.zero(values, i)
            } else if i + 1 == NODES {
                1.0
            } else {
                continue;
            };
            if is_positive {
                let width = end - begin;
                for [xi, weight] in self.points {
                    hand(begin + width * xi, width * weight);
                }
            }
            begin = end;
        }
    }

    /// Values at a place of the polynomials of all nodes.
    pub(super) fn basis(&self, xi: f64) -> [f64; NODES] {
        let mut sums = self.powers[DEGREE];
        for row in self.powers[..DEGREE].iter().rev() {
            for (sum, coefficient) in sums.iter_mut().zip(row) {
                *sum = *sum * xi + coefficient;
            }
        }
        sums
    }

    /// The zero between a node and the next.
    fn zero(&self, values: &[f64; NODES], node: usize) -> f64 {
        const STEPS: usize = 60;
        let coefficients = self
            .powers
            .map(|row| row.iter().zip(values).map(|(a, b)| a * b).sum::<f64>());
        let rises = values[node] < 0.0;
        let (mut low, mut high) = (self.places[node], self.places[node + 1]);
        let share = values[node] / (values[node] - values[node + 1]);
        let mut xi = low + (high - low) * share;
        for _ in 0..STEPS {
            let (mut value, mut slope) = (0.0, 0.0);
            for coefficient in coefficients.iter().rev() {
                slope = slope * xi + value;
                value = value * xi + coefficient;
            }
            if (value < 0.0) == rises {
                low = xi;
            } else {
                high = xi;
            }
            let newton = xi - value / slope;
            let next = if newton >= low && newton <= high {
                newton
            } else {
                0.5 * (low + high)
            };
            let change = (next - xi).abs();
            xi = next;
            if change < 1e-14 {
                break;
            }
        }
        xi
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_positive_part_of_a_polynomial_is_integrated() {
        let rule = ElementRule::new();
        // Positive before 0.3 and behind 0.8.
        let of = |x: f64| (x - 0.3) * (x - 0.8);
        let primitive = |x: f64| x * x * x / 3.0 - 1.1 * x * x / 2.0 + 0.24 * x;
        let exact = primitive(0.3) + primitive(1.0) - primitive(0.8);
        let values = rule.places.map(of);
        let (mut sum, mut length) = (0.0, 0.0);
        rule.stretches(&values, |xi, weight| {
            let basis = rule.basis(xi);
            sum += weight * basis.iter().zip(values).map(|(b, v)| b * v).sum::<f64>();
            length += weight;
        });
        assert!((sum - exact).abs() < 1e-12, "{sum} {exact}");
        assert!((length - 0.5).abs() < 1e-12, "{length}");
    }
}
