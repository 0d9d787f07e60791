//! Shapes of both parities across the width, and what weights of Z make of their products.

use crate::spectral::profile::Block;
use crate::spectral::quadrature::{gauss_legendre, legendre};

/// `int Z^k a b dZ` for all pairs of shapes and k = 0 to 3. A product of shapes of the same parity
/// needs the even powers alone, one of unlike parity the odd: two matrices hold all.
#[derive(Debug, Clone)]
pub(super) struct Products<const M: usize> {
    /// Powers 0 and 1.
    low: Block<M>,
    /// Powers 2 and 3.
    high: Block<M>,
}

/// The shapes.
#[derive(Debug, Clone)]
pub(super) struct Widthwise<const M: usize> {
    /// Of values.
    pub mass: Products<M>,
    /// Of slopes.
    pub stiffness: Products<M>,
    /// `int psi dZ` and `int Z psi dZ`.
    pub integrals: [[f64; 2]; M],
    /// Lines on which pressure is cut.
    pub lines: Vec<Line<M>>,
}

/// A line of Gauss points around the bearing.
#[derive(Debug, Clone)]
pub(super) struct Line<const M: usize> {
    /// Z.
    pub place: f64,
    pub weight: f64,
    /// Values of the shapes.
    pub values: [f64; M],
}

impl<const M: usize> Widthwise<M> {
    pub(super) fn new(lines: usize) -> Self {
        let mut mass = Products::zero();
        let mut stiffness = Products::zero();
        let mut integrals = [[0.0; 2]; M];
        // Exact to the degree 2 (M + 1) + 3.
        for [z, weight] in gauss_legendre(M + 3) {
            let shapes = shapes_at::<M>(z);
            mass.gather(z, weight, &shapes.map(|[value, _]| value));
            stiffness.gather(z, weight, &shapes.map(|[_, slope]| slope));
            for (sums, [value, _]) in integrals.iter_mut().zip(shapes) {
                sums[0] += weight * value;
                sums[1] += weight * z * value;
            }
        }
        let lines = gauss_legendre(lines)
            .into_iter()
            .map(|[place, weight]| Line {
                place,
                weight,
                values: shapes_at(place).map(|[value, _]| value),
            })
            .collect();
        Self {
            mass,
            stiffness,
            integrals,
            lines,
        }
    }
}

impl<const M: usize> Products<M> {
    fn zero() -> Self {
        Self {
            low: [[0.0; M]; M],
            high: [[0.0; M]; M],
        }
    }

    fn gather(&mut self, z: f64, weight: f64, shapes: &[f64; M]) {
        for a in 0..M {
            for b in 0..M {
                let power = if (a + b) % 2 == 0 { 1.0 } else { z };
                let product = weight * shapes[a] * shapes[b] * power;
                self.low[a][b] += product;
                self.high[a][b] += product * z * z;
            }
        }
    }

    /// Adds the matrix for the weight with these coefficients by powers of Z.
    #[inline]
    pub(super) fn add_to(&self, parts: [f64; 4], block: &mut Block<M>) {
        let [low, high] = alternating::<M>(parts);
        for a in 0..M {
            for b in 0..M {
                block[a][b] += low[a % 2][b] * self.low[a][b] + high[a % 2][b] * self.high[a][b];
            }
        }
    }

    /// `matrix vector` for the weights Z^k, k = 0 to 3.
    #[inline]
    pub(super) fn times(&self, vector: &[f64; M]) -> [[f64; M]; 4] {
        let mut products = [[0.0; M]; 4];
        for b in 0..M {
            for a in 0..M {
                // Symmetric: a row serves as a column.
                let odd = (a + b) % 2;
                products[odd][a] += self.low[b][a] * vector[b];
                products[2 + odd][a] += self.high[b][a] * vector[b];
            }
        }
        products
    }
}

/// Coefficients for rows and columns of alternating parity: of the low powers, and of the high.
#[inline]
fn alternating<const M: usize>(parts: [f64; 4]) -> [[[f64; M]; 2]; 2] {
    [0, 2].map(|first| [0, 1].map(|row| std::array::from_fn(|b| parts[first + (row + b) % 2])))
}

/// (1 - Z^2) P_k(Z) and its slope, k = 0 to M - 1.
pub(super) fn shapes_at<const M: usize>(z: f64) -> [[f64; 2]; M] {
    std::array::from_fn(|k| {
        let (value, slope) = legendre(k, z);
        let bubble = (1.0 - z) * (1.0 + z);
        [bubble * value, bubble * slope - 2.0 * z * value]
    })
}
