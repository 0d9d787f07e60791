//! The discrete film: columns around the bearing, each with the nodes of a width.
//!
//! ```text
//! -d/ds(H^3/phi' dP/ds) - (D/B)^2 phi' H^3 d2P/dZ2 = 12 cos(phi - angle) phi',    P >= 0 for `reynolds`
//! phi' = dphi/ds,   s even, see `grading`
//! ```
//! second order in s between the columns, spectral across the width. The equations are those of a
//! block-tridiagonal symmetric matrix with diagonal blocks beside the main ones, closed to a ring;
//! unknowns out of the set are rows of the unit matrix. Elimination runs from a column without unknowns,
//! or carries the coupling to the last column along.

use super::grading::Grading;
use super::lobatto::Lobatto;
use std::f64::consts::{PI, TAU};

type Block<const M: usize> = [[f64; M]; M];

/// Columns of a film with their operator and its factors.
#[derive(Debug, Clone)]
pub(super) struct Ring<const M: usize> {
    width: Lobatto<M>,
    grading: Grading,
    /// Cosine and sine of the angle from the narrowest gap of each column.
    pub cos: Vec<f64>,
    pub sin: Vec<f64>,
    /// Length of the bore that a column stands for, rad.
    pub share: Vec<f64>,
    /// H^3 of a column and at the face to the next one, over the spacing there.
    pub axial: Vec<f64>,
    face: Vec<f64>,
    /// Derivatives of the two by the relative eccentricity.
    axial_slope: Vec<f64>,
    face_slope: Vec<f64>,
    /// What the film beyond a rupture boundary between two columns adds to the diagonal.
    pub beyond: Vec<[f64; M]>,
    /// The unknowns: one bit per node.
    pub set: Vec<u32>,
    start: usize,
    closed: bool,
    inverse: Vec<Block<M>>,
    carried: Vec<Block<M>>,
}

impl<const M: usize> Ring<M> {
    pub const ALL: u32 = (1 << M) - 1;

    /// `count` columns, an even number, at a relative eccentricity and D/B.
    pub fn new(count: usize, eccentricity: f64, d_over_b: f64) -> Self {
        let step = TAU / count as f64;
        let grading = Grading::new(eccentricity);
        let angle = |s: f64| grading.angle(if s > PI { s - TAU } else { s });
        let slope = |phi: f64| grading.slope(phi);
        let gap = |phi: f64| {
            // 1 - eps cos(phi) without cancellation near contact.
            1.0 - eccentricity + 2.0 * eccentricity * (0.5 * phi).sin().powi(2)
        };
        let ratio = d_over_b * d_over_b;
        let angles = |ahead: f64| -> Vec<f64> {
            (0..count)
                .map(|k| angle((k as f64 + ahead) * step))
                .collect()
        };
        let [columns, faces] = [0.0, 0.5].map(angles);
        let column = |of: &dyn Fn(f64) -> f64| columns.iter().map(|phi| of(*phi)).collect();
        let between = |of: &dyn Fn(f64) -> f64| faces.iter().map(|phi| of(*phi)).collect();
        Self {
            width: Lobatto::new(),
            grading,
            cos: column(&f64::cos),
            sin: column(&f64::sin),
            share: column(&|phi| slope(phi) * step),
            axial: column(&|phi| ratio * slope(phi) * step * gap(phi).powi(3)),
            face: between(&|phi| gap(phi).powi(3) / (slope(phi) * step)),
            axial_slope: column(&|phi| {
                -3.0 * ratio * slope(phi) * step * gap(phi).powi(2) * phi.cos()
            }),
            face_slope: between(&|phi| -3.0 * gap(phi).powi(2) * phi.cos() / (slope(phi) * step)),
            beyond: vec![[0.0; M]; count],
            set: vec![Self::ALL; count],
            start: 0,
            closed: true,
            inverse: vec![[[0.0; M]; M]; count],
            carried: Vec::new(),
        }
    }

    pub fn count(&self) -> usize {
        self.set.len()
    }

    pub fn weights(&self) -> &[f64; M] {
        &self.width.weights
    }

    /// Stiffness between column `k` and the next one at node `j`.
    pub fn face(&self, k: usize, j: usize) -> f64 {
        self.face[k] * self.width.weights[j]
    }

    /// Slope of the pressure of a column at the end of the width.
    pub fn end_slope(&self, pressure: &[f64; M]) -> f64 {
        dot(&self.width.end_slope, pressure)
    }

    /// Angle of a place counted in columns from the narrowest gap, rad, -pi to pi.
    pub fn angle(&self, place: f64) -> f64 {
        let s = TAU * place / self.count() as f64;
        self.grading.angle(if s > PI { s - TAU } else { s })
    }

    /// Coupling of column `k` to the next one.
    fn coupling(&self, k: usize) -> [f64; M] {
        let both = self.set[k] & self.set[(k + 1) % self.count()];
        std::array::from_fn(|j| {
            if both >> j & 1 == 1 {
                -self.face[k] * self.width.weights[j]
            } else {
                0.0
            }
        })
    }

    /// Own block of column `k`.
    fn block(&self, k: usize) -> Block<M> {
        let before = (k + self.count() - 1) % self.count();
        let faces = self.face[before] + self.face[k];
        let set = self.set[k];
        std::array::from_fn(|j| {
            std::array::from_fn(|l| {
                let inside = set >> j & set >> l & 1 == 1;
                if !inside {
                    return if j == l { 1.0 } else { 0.0 };
                }
                let around = if j == l {
                    faces * self.width.weights[j] + self.beyond[k][j]
                } else {
                    0.0
                };
                around + self.axial[k] * self.width.stiffness[j][l]
            })
        })
    }

    /// Eliminates the present set.
    pub fn factorise(&mut self) {
        let n = self.count();
        let open = self.set.iter().position(|set| *set == 0);
        self.start = open.unwrap_or(0);
        self.closed = open.is_none();
        if self.closed {
            self.factorise_ring();
            return;
        }
        let mut own = self.block(self.start);
        for at in 0..n {
            let k = (self.start + at) % n;
            if self.set[k] == 0 {
                own = self.block((k + 1) % n);
                continue;
            }
            invert(&mut own);
            self.inverse[k] = own;
            let coupling = self.coupling(k);
            let mut next = self.block((k + 1) % n);
            subtract(&mut next, &self.inverse[k], &coupling);
            own = next;
        }
    }

    fn factorise_ring(&mut self) {
        let n = self.count();
        self.carried = vec![[[0.0; M]; M]; n];
        let mut own = self.block(0);
        let mut carried = diagonal(&self.coupling(n - 1));
        let mut last = self.block(n - 1);
        for k in 0..n - 1 {
            invert(&mut own);
            self.inverse[k] = own;
            let coupling = self.coupling(k);
            if k == n - 2 {
                for j in 0..M {
                    carried[j][j] += coupling[j];
                }
            }
            self.carried[k] = carried;
            let solved = product(&own, &carried);
            for j in 0..M {
                for l in 0..M {
                    let sum: f64 = (0..M).map(|q| carried[q][j] * solved[q][l]).sum();
                    last[j][l] -= sum;
                }
            }
            let mut next = self.block(k + 1);
            subtract(&mut next, &own, &coupling);
            own = next;
            for j in 0..M {
                carried[j] = solved[j].map(|value| -coupling[j] * value);
            }
        }
        invert(&mut last);
        self.inverse[n - 1] = last;
    }

    /// Solves in place with the factors of the present set; right sides out of the set do not count.
    pub fn solve(&self, x: &mut [[f64; M]]) {
        for (x, set) in x.iter_mut().zip(&self.set) {
            for (j, x) in x.iter_mut().enumerate() {
                if set >> j & 1 == 0 {
                    *x = 0.0;
                }
            }
        }
        if self.closed {
            self.solve_ring(x);
            return;
        }
        let n = self.count();
        for at in 0..n - 1 {
            let k = (self.start + at) % n;
            if self.set[k] == 0 {
                continue;
            }
            let part = apply(&self.inverse[k], &x[k]);
            let coupling = self.coupling(k);
            let next = &mut x[(k + 1) % n];
            for j in 0..M {
                next[j] -= coupling[j] * part[j];
            }
        }
        let mut next = [0.0; M];
        for at in (0..n).rev() {
            let k = (self.start + at) % n;
            if self.set[k] == 0 {
                next = [0.0; M];
                continue;
            }
            let coupling = self.coupling(k);
            for j in 0..M {
                x[k][j] -= coupling[j] * next[j];
            }
            x[k] = apply(&self.inverse[k], &x[k]);
            next = x[k];
        }
    }

    fn solve_ring(&self, x: &mut [[f64; M]]) {
        let n = self.count();
        for k in 0..n - 1 {
            let part = apply(&self.inverse[k], &x[k]);
            let coupling = self.coupling(k);
            for j in 0..M {
                if k < n - 2 {
                    x[k + 1][j] -= coupling[j] * part[j];
                }
                let carried: f64 = (0..M).map(|q| self.carried[k][q][j] * part[q]).sum();
                x[n - 1][j] -= carried;
            }
        }
        x[n - 1] = apply(&self.inverse[n - 1], &x[n - 1]);
        let last = x[n - 1];
        for k in (0..n - 1).rev() {
            let coupling = self.coupling(k);
            let carried = apply(&self.carried[k], &last);
            for j in 0..M {
                let next = if k < n - 2 {
                    coupling[j] * x[k + 1][j]
                } else {
                    0.0
                };
                x[k][j] -= next + carried[j];
            }
            x[k] = apply(&self.inverse[k], &x[k]);
        }
    }

    /// Operator on a pressure, for every node whether in the set or not; `change` takes the derivative
    /// of the operator by the relative eccentricity instead.
    pub fn operate(&self, pressure: &[[f64; M]], k: usize, change: bool) -> [f64; M] {
        let (face, axial) = if change {
            (&self.face_slope, &self.axial_slope)
        } else {
            (&self.face, &self.axial)
        };
        let n = self.count();
        let (before, after) = ((k + n - 1) % n, (k + 1) % n);
        let across = apply(&self.width.stiffness, &pressure[k]);
        std::array::from_fn(|j| {
            let own = pressure[k][j];
            let around =
                face[before] * (own - pressure[before][j]) + face[k] * (own - pressure[after][j]);
            self.width.weights[j] * around + axial[k] * across[j]
        })
    }
}

fn dot<const M: usize>(a: &[f64; M], b: &[f64; M]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn apply<const M: usize>(matrix: &Block<M>, x: &[f64; M]) -> [f64; M] {
    std::array::from_fn(|j| dot(&matrix[j], x))
}

fn product<const M: usize>(a: &Block<M>, b: &Block<M>) -> Block<M> {
    let mut out = [[0.0; M]; M];
    for (row, out) in a.iter().zip(&mut out) {
        for (factor, b) in row.iter().zip(b) {
            for (out, b) in out.iter_mut().zip(b) {
                *out += factor * b;
            }
        }
    }
    out
}

fn diagonal<const M: usize>(values: &[f64; M]) -> Block<M> {
    let mut out = [[0.0; M]; M];
    for (j, value) in values.iter().enumerate() {
        out[j][j] = *value;
    }
    out
}

/// `next -= coupling inverse coupling`.
fn subtract<const M: usize>(next: &mut Block<M>, inverse: &Block<M>, coupling: &[f64; M]) {
    for j in 0..M {
        for l in 0..M {
            next[j][l] -= coupling[j] * inverse[j][l] * coupling[l];
        }
    }
}

/// Inverse in place, by Gauss-Jordan without pivoting: the blocks are symmetric and positive definite.
fn invert<const M: usize>(a: &mut Block<M>) {
    for k in 0..M {
        let pivot = 1.0 / a[k][k];
        a[k][k] = 1.0;
        for value in &mut a[k] {
            *value *= pivot;
        }
        let row = a[k];
        for (i, other) in a.iter_mut().enumerate() {
            if i != k {
                let factor = other[k];
                other[k] = 0.0;
                for (value, above) in other.iter_mut().zip(&row) {
                    *value -= factor * above;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest residual in the set after a solve.
    fn residual(ring: &mut Ring<4>) -> f64 {
        ring.factorise();
        let right: Vec<[f64; 4]> = (0..ring.count())
            .map(|k| std::array::from_fn(|j| ((k * 7 + j * 3) as f64).sin()))
            .collect();
        let mut x = right.clone();
        ring.solve(&mut x);
        let mut worst = 0.0_f64;
        for k in 0..ring.count() {
            let found = ring.operate(&x, k, false);
            for j in 0..4 {
                if ring.set[k] >> j & 1 == 1 {
                    worst = worst.max((found[j] - right[k][j]).abs());
                } else {
                    assert_eq!(x[k][j], 0.0);
                }
            }
        }
        worst
    }

    #[test]
    fn the_equations_hold_on_a_closed_and_on_a_cut_ring() {
        let mut ring = Ring::<4>::new(16, 0.7, 1.5);
        assert!(residual(&mut ring) < 1e-11);
        ring.set[5] = 0;
        ring.set[6] = 0b1100;
        ring.set[12] = 0b0101;
        ring.set[3] = 0;
        assert!(residual(&mut ring) < 1e-11);
        ring.set = vec![Ring::<4>::ALL; 16];
        ring.set[9] = 0b0011;
        assert!(residual(&mut ring) < 1e-11);
    }
}
