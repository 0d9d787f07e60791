//! In which shapes does pressure vary across the width?
//!
//! ```text
//! S v = lambda M v      M = int psi psi dZ,  S = int psi' psi' dZ,   psi in (1 - Z^2) P_2k(Z), k < n
//! ```
//! The polynomials that vanish at both ends and mirror each other in the mid-plane, turned so that
//! both matrices are diagonal (M = 1): an aligned film falls apart into one ordinary differential
//! equation around for each of them. The eigenvalues tend to those of the cosines, (k + 1/2)^2 pi^2.
//! Reference: J. Shen, SIAM J. Sci. Comput. 15 (1994) 1489, 10.1137/0915089 (Galerkin with
//! polynomials that keep the boundary conditions).

use super::quadrature::{gauss_legendre, legendre};

/// Even shapes across the width, as many as there are lanes `M`, with `G` Gauss points on one half.
#[derive(Debug, Clone)]
pub(super) struct Across<const M: usize, const G: usize> {
    /// lambda, ascending.
    pub eigenvalues: [f64; M],
    /// `int psi dZ` over both halves.
    pub integrals: [f64; M],
    /// Slope at Z = 1.
    pub end_slopes: [f64; M],
    /// Value in the mid-plane.
    pub middle: [f64; M],
    /// Values at the Gauss points of one half, by shape.
    pub values: [[f64; G]; M],
    /// Slopes there.
    pub slopes: [[f64; G]; M],
    /// Weights of the points for both halves together: their sum is 2.
    pub weights: [f64; G],
}

impl<const M: usize, const G: usize> Across<M, G> {
    pub(super) fn new() -> Self {
        let mut mass = [[0.0; M]; M];
        let mut stiffness = [[0.0; M]; M];
        for [z, weight] in gauss_legendre(2 * M + 2) {
            let shapes: [[f64; 2]; M] = std::array::from_fn(|k| shape(k, z));
            for row in 0..M {
                for column in 0..M {
                    mass[row][column] += weight * shapes[row][0] * shapes[column][0];
                    stiffness[row][column] += weight * shapes[row][1] * shapes[column][1];
                }
            }
        }
        let (eigenvalues, vectors) = generalised_eigenpairs(mass, stiffness);
        let at = |z: f64, which: usize| -> [f64; M] {
            std::array::from_fn(|mode| (0..M).map(|k| vectors[k][mode] * shape(k, z)[which]).sum())
        };
        let points = gauss_legendre(2 * G);
        let values_at: [[f64; M]; G] = std::array::from_fn(|g| at(points[g][0], 0));
        let slopes_at: [[f64; M]; G] = std::array::from_fn(|g| at(points[g][0], 1));
        let mut integrals = [0.0; M];
        for [z, weight] in gauss_legendre(M + 2) {
            for (sum, value) in integrals.iter_mut().zip(at(z, 0)) {
                *sum += weight * value;
            }
        }
        Self {
            eigenvalues,
            integrals,
            end_slopes: at(1.0, 1),
            middle: at(0.0, 0),
            values: std::array::from_fn(|k| std::array::from_fn(|g| values_at[g][k])),
            slopes: std::array::from_fn(|k| std::array::from_fn(|g| slopes_at[g][k])),
            weights: std::array::from_fn(|g| 2.0 * points[g][1]),
        }
    }
}

/// (1 - Z^2) P_2k(Z) and its slope.
fn shape(k: usize, z: f64) -> [f64; 2] {
    let (value, slope) = legendre(2 * k, z);
    let bubble = (1.0 - z) * (1.0 + z);
    [bubble * value, bubble * slope - 2.0 * z * value]
}

type Square<const M: usize> = [[f64; M]; M];

/// Eigenvalues, ascending, and columns `v` with `v^T mass v = 1`, of symmetric matrices: Cholesky and
/// Jacobi rotations.
fn generalised_eigenpairs<const M: usize>(
    mass: Square<M>,
    stiffness: Square<M>,
) -> ([f64; M], Square<M>) {
    let mut lower = [[0.0; M]; M];
    for i in 0..M {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            lower[i][j] = if i == j {
                (mass[i][i] - known).sqrt()
            } else {
                (mass[i][j] - known) / lower[j][j]
            };
        }
    }
    let forward = |column: [f64; M]| {
        let mut x = column;
        for i in 0..M {
            let known: f64 = (0..i).map(|k| lower[i][k] * x[k]).sum();
            x[i] = (x[i] - known) / lower[i][i];
        }
        x
    };
    // L^-1 S L^-T, by columns: S is symmetric, so its rows are its columns.
    let half = transposed(stiffness.map(forward));
    let mut matrix = half.map(forward);
    let mut turned = [[0.0; M]; M];
    for (i, row) in turned.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for _ in 0..60 {
        for p in 0..M {
            for q in p + 1..M {
                rotate_away(&mut matrix, &mut turned, p, q);
            }
        }
    }
    let mut order: [usize; M] = std::array::from_fn(|i| i);
    order.sort_by(|&a, &b| matrix[a][a].total_cmp(&matrix[b][b]));
    let mut vectors = [[0.0; M]; M];
    for (mode, &column) in order.iter().enumerate() {
        let mut v: [f64; M] = std::array::from_fn(|i| turned[i][column]);
        for i in (0..M).rev() {
            let known: f64 = (i + 1..M).map(|k| lower[k][i] * v[k]).sum();
            v[i] = (v[i] - known) / lower[i][i];
        }
        for i in 0..M {
            vectors[i][mode] = v[i];
        }
    }
    (order.map(|i| matrix[i][i]), vectors)
}

/// One Jacobi rotation that makes `matrix[p][q]` zero.
fn rotate_away<const M: usize>(matrix: &mut Square<M>, turned: &mut Square<M>, p: usize, q: usize) {
    let off = matrix[p][q];
    if off.abs() <= f64::MIN_POSITIVE {
        return;
    }
    let half = 0.5 * (matrix[q][q] - matrix[p][p]) / off;
    let tangent = half.signum() / (half.abs() + half.hypot(1.0));
    let cos = 1.0 / tangent.hypot(1.0);
    let sin = tangent * cos;
    for row in matrix.iter_mut().chain(turned.iter_mut()) {
        let (a, b) = (row[p], row[q]);
        row[p] = cos * a - sin * b;
        row[q] = sin * a + cos * b;
    }
    for k in 0..M {
        let (a, b) = (matrix[p][k], matrix[q][k]);
        matrix[p][k] = cos * a - sin * b;
        matrix[q][k] = sin * a + cos * b;
    }
}

fn transposed<const M: usize>(matrix: Square<M>) -> Square<M> {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[j][i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn low_eigenvalues_are_those_of_cosines() {
        let across = Across::<6, 8>::new();
        for (k, bar) in [1e-12, 1e-9, 1e-4].into_iter().enumerate() {
            let exact = ((k as f64 + 0.5) * PI).powi(2);
            let off = across.eigenvalues[k] / exact - 1.0;
            assert!(off.abs() < bar && off > -1e-12, "{k}: {off}");
        }
    }

    #[test]
    fn shapes_are_orthonormal_and_weights_cover_the_width() {
        let across = Across::<4, 8>::new();
        for a in 0..4 {
            for b in 0..4 {
                let sum: f64 = (0..8)
                    .map(|g| across.weights[g] * across.values[a][g] * across.values[b][g])
                    .sum();
                let exact = if a == b { 1.0 } else { 0.0 };
                assert!((sum - exact).abs() < 1e-12, "{a} {b}: {sum}");
            }
            let sum: f64 = (0..8)
                .map(|g| across.weights[g] * across.values[a][g])
                .sum();
            assert!((sum - across.integrals[a]).abs() < 1e-12);
        }
        assert!((across.weights.iter().sum::<f64>() - 2.0).abs() < 1e-14);
    }

    /// `int psi'' psi = -S`: the slopes at the ends belong to the values.
    #[test]
    fn end_slopes_carry_the_flow_of_each_shape() {
        let across = Across::<5, 8>::new();
        // A parabola 1 - Z^2 in these shapes has the slope -2 at the end and 1 in the middle.
        let points = gauss_legendre(16);
        let parts: [f64; 5] = std::array::from_fn(|k| {
            (0..8)
                .map(|g| {
                    let bubble = 1.0 - points[g][0].powi(2);
                    across.weights[g] * across.values[k][g] * bubble
                })
                .sum()
        });
        let of = |values: [f64; 5]| -> f64 { parts.iter().zip(values).map(|(a, b)| a * b).sum() };
        assert!((of(across.end_slopes) + 2.0).abs() < 1e-12);
        assert!((of(across.middle) - 1.0).abs() < 1e-12);
    }
}
