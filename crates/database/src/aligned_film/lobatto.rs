//! Nodes across the width: Legendre-Gauss-Lobatto points of an even polynomial.
//!
//! `M` unknowns from the mid-plane outwards and the end, where the pressure is zero, hold an even
//! polynomial of degree 2M. `weights` integrate over the whole width, Z in [-1, 1]; `stiffness` is the
//! integral of `l_j' l_k'` of the folded cardinal functions, `end_slope` their derivative at Z = 1.
//! Reference: C. Canuto et al., Spectral Methods, Springer 2006, ch. 2.3.

use std::f64::consts::PI;

/// Nodes of a width with `M` unknowns.
#[derive(Debug, Clone)]
pub(super) struct Lobatto<const M: usize> {
    pub weights: [f64; M],
    pub stiffness: [[f64; M]; M],
    pub end_slope: [f64; M],
}

impl<const M: usize> Lobatto<M> {
    pub fn new() -> Self {
        let degree = 2 * M;
        let nodes: Vec<f64> = (0..=degree).map(|k| node(degree, k)).collect();
        let legendre: Vec<f64> = nodes.iter().map(|x| polynomials(degree, *x)[1]).collect();
        let factor = 2.0 / (degree * (degree + 1)) as f64;
        let weight: Vec<f64> = legendre.iter().map(|p| factor / (p * p)).collect();
        // Derivative of cardinal function k at node q.
        let derivative = |q: usize, k: usize| {
            let corner = 0.25 * (degree * (degree + 1)) as f64;
            if q != k {
                legendre[q] / (legendre[k] * (nodes[q] - nodes[k]))
            } else if q == 0 {
                -corner
            } else if q == degree {
                corner
            } else {
                0.0
            }
        };
        // Node 0 lies in the mid-plane; the others stand for both sides.
        let folded = |q: usize, j: usize| {
            let one = derivative(q, M + j);
            if j == 0 {
                one
            } else {
                one + derivative(q, M - j)
            }
        };
        let stiffness = std::array::from_fn(|j| {
            std::array::from_fn(|k| {
                (0..=degree)
                    .map(|q| weight[q] * folded(q, j) * folded(q, k))
                    .sum()
            })
        });
        Self {
            weights: std::array::from_fn(|j| {
                if j == 0 {
                    weight[M]
                } else {
                    2.0 * weight[M + j]
                }
            }),
            stiffness,
            end_slope: std::array::from_fn(|j| folded(degree, j)),
        }
    }
}

/// Legendre polynomials of `degree - 1` and `degree` at `x`.
fn polynomials(degree: usize, x: f64) -> [f64; 2] {
    let (mut below, mut own) = (1.0, x);
    for k in 2..=degree {
        let k = k as f64;
        (below, own) = (own, ((2.0 * k - 1.0) * x * own - (k - 1.0) * below) / k);
    }
    [below, own]
}

/// Lobatto node `k` of 0 to `degree`: a zero of `(1 - x^2) P'`, by Newton from the Chebyshev node.
fn node(degree: usize, k: usize) -> f64 {
    if k == 0 || k == degree {
        return if k == 0 { -1.0 } else { 1.0 };
    }
    if 2 * k == degree {
        return 0.0;
    }
    let mut x = -(PI * k as f64 / degree as f64).cos();
    for _ in 0..50 {
        // (1 - x^2) P' = n (P_below - x P), and its derivative is -n (n + 1) P.
        let [below, own] = polynomials(degree, x);
        x += (below - x * own) / ((degree + 1) as f64 * own);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_of_even_polynomials_are_exact() {
        let lobatto = Lobatto::<5>::new();
        let nodes: Vec<f64> = (0..5).map(|j| node(10, 5 + j)).collect();
        // (1 - Z^2) Z^4: vanishes at the end, degree 6.
        let f: Vec<f64> = nodes.iter().map(|z| (1.0 - z * z) * z.powi(4)).collect();
        let area: f64 = f.iter().zip(lobatto.weights).map(|(f, w)| f * w).sum();
        assert!((area - (2.0 / 5.0 - 2.0 / 7.0)).abs() < 1e-14);
        // Its slope squared: (4 Z^3 - 6 Z^5)^2.
        let energy: f64 = (0..25)
            .map(|at| f[at / 5] * lobatto.stiffness[at / 5][at % 5] * f[at % 5])
            .sum();
        assert!((energy - 2.0 * (16.0 / 7.0 - 48.0 / 9.0 + 36.0 / 11.0)).abs() < 1e-12);
        let slope: f64 = f.iter().zip(lobatto.end_slope).map(|(f, d)| f * d).sum();
        assert!((slope + 2.0).abs() < 1e-12);
    }
}
