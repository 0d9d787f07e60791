//! What of a polynomial on an element is positive?
//!
//! The nodes tell where it changes sign; Newton's method finds its zeros between them, and Gauss points
//! integrate each positive stretch.

use super::layout::Span;
use super::{DEGREE, NODES};
use crate::spectral::quadrature::{Element, gauss_legendre};

/// Gauss points of a stretch: exact for the polynomial times one of a few degrees, as which cos and
/// sin pass on an element.
const POINTS: usize = DEGREE / 2 + 3;

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
    gauss: [[f64; 2]; POINTS],
}

/// Integrals over the positive part of an element, in its own coordinate.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Positive {
    /// Of n times the polynomial of each node.
    pub loads: [[f64; 2]; NODES],
    /// Of `p n`.
    pub whole: [f64; 2],
    /// Of `p n xi`.
    pub moved: [f64; 2],
    /// Of 1.
    pub length: f64,
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
        let gauss = gauss_legendre(POINTS);
        Self {
            places,
            weights: std::array::from_fn(|i| element.weights[i]),
            slopes: std::array::from_fn(|i| std::array::from_fn(|j| element.slopes[i][j])),
            powers,
            gauss: std::array::from_fn(|i| [0.5 + 0.5 * gauss[i][0], 0.5 * gauss[i][1]]),
        }
    }

    /// The positive part of these values at the nodes; `None` where all are negative.
    pub(super) fn positive(&self, values: &[f64; NODES], span: &Span) -> Option<Positive> {
        let mut part = Positive::default();
        let count = values.iter().filter(|value| **value >= 0.0).count();
        if count == 0 {
            return None;
        }
        if count == NODES {
            part.length = 1.0;
            for i in 0..NODES {
                let load = span.trig[i].map(|n| self.weights[i] * n);
                part.loads[i] = load;
                for r in 0..2 {
                    part.whole[r] += load[r] * values[i];
                    part.moved[r] += load[r] * values[i] * self.places[i];
                }
            }
            return Some(part);
        }
        self.stretches(values, |xi, weight| {
            let basis = self.basis(xi);
            let value: f64 = basis.iter().zip(values).map(|(b, v)| b * v).sum();
            let (sin, cos) = (span.start + span.width * xi).sin_cos();
            part.length += weight;
            for (r, n) in [cos, sin].into_iter().enumerate() {
                for i in 0..NODES {
                    part.loads[i][r] += weight * n * basis[i];
                }
                part.whole[r] += weight * n * value;
                part.moved[r] += weight * n * value * xi;
            }
        });
        Some(part)
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
                for [xi, weight] in self.gauss {
                    hand(begin + (end - begin) * xi, (end - begin) * weight);
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
        let values = rule.places.map(of);
        let span = Span::default();
        let mut span = Span {
            width: 1e-9,
            ..span
        };
        span.trig = [[1.0, 0.0]; NODES];
        let primitive = |x: f64| x * x * x / 3.0 - 1.1 * x * x / 2.0 + 0.24 * x;
        let exact = primitive(0.3) + primitive(1.0) - primitive(0.8);
        let part = rule.positive(&values, &span).unwrap_or_default();
        assert!((part.whole[0] - exact).abs() < 1e-12, "{part:?}");
        assert!((part.length - 0.5).abs() < 1e-12, "{part:?}");
        let by_loads: f64 = (0..NODES).map(|i| part.loads[i][0] * values[i]).sum();
        assert!((by_loads - exact).abs() < 1e-12);
        assert!(rule.positive(&values.map(|v| v - 1.0), &span).is_none());
    }
}
