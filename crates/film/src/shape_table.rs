//! A measured or computed profile: radial offsets at angles times axial positions, made smooth.
//!
//! Around, a periodic cubic through the values of each column (Hermite's form, the slope at a node is
//! that of the parabola through it and its neighbours); along the axis the same with one-sided slopes
//! at the ends. Both are linear in the data, so that value, slope and integral around are the same
//! sum over at most four columns, and the offset is continuous with its first derivatives. Beyond
//! the first and last position the profile goes on as it ends. Between nodes a cubic may pass a
//! steep step by about a tenth of its height.

use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Radial offsets on a grid of angles and axial positions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ProfileTable {
    /// Angles, rad, ascending within one turn.
    angles: Vec<f64>,
    /// Axial positions from the mid-plane, m, ascending.
    positions: Vec<f64>,
    /// Offsets, m; `(i, k)` of angle i and position k at `i * positions.len() + k`.
    offsets: Vec<f64>,
    /// Slopes around at the nodes, m/rad.
    slopes: Vec<f64>,
    /// Integrals around from the first angle to each node, m rad, and to the end of the turn.
    integrals: Vec<f64>,
}

/// Why values are no table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// No angle, no position, or not one offset for each pair.
    #[error("a profile needs one offset for every pair of angle and position")]
    Incomplete,
    /// A value is not finite.
    #[error("a profile holds only finite numbers")]
    NotFinite,
    /// Angles or positions do not ascend, or the angles span a whole turn or more.
    #[error("angles must ascend within less than one turn, positions must ascend")]
    NotAscending,
}

/// What is read from a column at an angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Read {
    Value,
    Slope,
    Integral,
}

/// Columns that act at a position, with their weights.
type Weights = [(usize, f64); 4];

impl ProfileTable {
    /// A table of `offsets` (m), all positions of the first angle first.
    ///
    /// # Errors
    /// [`TableError`] for values that are no table.
    pub fn new(
        angles: Vec<f64>,
        positions: Vec<f64>,
        offsets: Vec<f64>,
    ) -> Result<Self, TableError> {
        let (n, m) = (angles.len(), positions.len());
        if n == 0 || m == 0 || offsets.len() != n * m {
            return Err(TableError::Incomplete);
        }
        let mut all = angles.iter().chain(&positions).chain(&offsets);
        if !all.all(|v| v.is_finite()) {
            return Err(TableError::NotFinite);
        }
        let ascend = |values: &[f64]| values.windows(2).all(|w| w[0] < w[1]);
        if !ascend(&angles) || !ascend(&positions) || angles[n - 1] - angles[0] >= TAU {
            return Err(TableError::NotAscending);
        }
        let mut table = Self {
            slopes: vec![0.0; n * m],
            integrals: vec![0.0; (n + 1) * m],
            angles,
            positions,
            offsets,
        };
        table.complete();
        Ok(table)
    }

    /// Turns the table by an angle (rad) in the sense of rotation.
    pub(crate) fn turn(&mut self, by: f64) {
        self.angles.iter_mut().for_each(|angle| *angle += by);
    }

    /// Slopes at the nodes and integrals between them.
    fn complete(&mut self) {
        let (n, m) = (self.angles.len(), self.positions.len());
        for i in 0..n {
            let (before, behind) = ((i + n - 1) % n, (i + 1) % n);
            let (d_before, d_behind) = (self.length(before), self.length(i));
            for k in 0..m {
                let at = |i: usize| self.offsets[i * m + k];
                let s_before = (at(i) - at(before)) / d_before;
                let s_behind = (at(behind) - at(i)) / d_behind;
                self.slopes[i * m + k] =
                    (s_before * d_behind + s_behind * d_before) / (d_before + d_behind);
            }
        }
        for i in 0..n {
            for k in 0..m {
                let whole = self.hermite(i, k, 1.0, Read::Integral);
                self.integrals[(i + 1) * m + k] = self.integrals[i * m + k] + whole;
            }
        }
    }

    /// Angle from node i to the next, the turn's last stretch included.
    fn length(&self, i: usize) -> f64 {
        match self.angles.get(i + 1) {
            Some(next) => next - self.angles[i],
            None => self.angles[0] + TAU - self.angles[i],
        }
    }

    /// The cubic of column k behind node i at the share `t` of its stretch.
    fn hermite(&self, i: usize, k: usize, t: f64, read: Read) -> f64 {
        let (n, m) = (self.angles.len(), self.positions.len());
        let (a, b) = (i * m + k, (i + 1) % n * m + k);
        let length = self.length(i);
        let (start, rise) = (self.offsets[a], self.offsets[b] - self.offsets[a]);
        let (s0, s1) = (self.slopes[a] * length, self.slopes[b] * length);
        // start + s0 t + q t^2 + c t^3
        let (q, c) = (3.0 * rise - 2.0 * s0 - s1, s0 + s1 - 2.0 * rise);
        match read {
            Read::Value => start + t * (s0 + t * (q + t * c)),
            Read::Slope => (s0 + t * (2.0 * q + 3.0 * t * c)) / length,
            Read::Integral => length * t * (start + t * (0.5 * s0 + t * (q / 3.0 + 0.25 * t * c))),
        }
    }

    /// Weights of the columns at `z`, or of the derivative by z.
    fn weights(&self, z: f64, of_derivative: bool) -> Weights {
        let p = &self.positions;
        let m = p.len();
        let inside = z.clamp(p[0], p[m - 1]);
        let mut weights = [(0, 0.0); 4];
        if m == 1 || (of_derivative && inside != z) {
            weights[0].1 = if of_derivative { 0.0 } else { 1.0 };
            return weights;
        }
        let k = p.partition_point(|v| *v <= inside).clamp(1, m - 1) - 1;
        let length = p[k + 1] - p[k];
        let t = (inside - p[k]) / length;
        let [value0, value1, slope0, slope1] = if of_derivative {
            let u = 6.0 * t * (1.0 - t) / length;
            let (a, b) = (1.0 - 4.0 * t + 3.0 * t * t, 3.0 * t * t - 2.0 * t);
            [-u, u, a, b]
        } else {
            let (t2, t3) = (t * t, t * t * t);
            let rise = 3.0 * t2 - 2.0 * t3;
            let (a, b) = (t - 2.0 * t2 + t3, t3 - t2);
            [1.0 - rise, rise, a * length, b * length]
        };
        for (slot, weight) in weights.iter_mut().enumerate() {
            // Columns k - 1 to k + 2; those beyond an end have no weight.
            weight.0 = (k + slot).saturating_sub(1).min(m - 1);
        }
        weights[1].1 += value0;
        weights[2].1 += value1;
        for (node, slope, first) in [(k, slope0, 0), (k + 1, slope1, 1)] {
            let (has_before, has_behind) = (node > 0, node + 1 < m);
            let before = |share: f64| share * slope / (p[node] - p[node - 1]);
            let behind = |share: f64| share * slope / (p[node + 1] - p[node]);
            let (d_before, d_behind) = match (has_before, has_behind) {
                (true, true) => {
                    let (b, a) = (p[node] - p[node - 1], p[node + 1] - p[node]);
                    (before(a / (a + b)), behind(b / (a + b)))
                }
                (true, false) => (before(1.0), 0.0),
                _ => (0.0, behind(1.0)),
            };
            weights[first].1 -= d_before;
            weights[first + 1].1 += d_before - d_behind;
            weights[first + 2].1 += d_behind;
        }
        weights
    }

    fn read(&self, angle: f64, z: f64, read: Read, by_z: bool) -> f64 {
        let m = self.positions.len();
        let turns = ((angle - self.angles[0]) / TAU).floor();
        let local = angle - turns * TAU;
        let i = self.angles.partition_point(|a| *a <= local).max(1) - 1;
        let t = (local - self.angles[i]) / self.length(i);
        let mut sum = 0.0;
        for (k, weight) in self.weights(z, by_z) {
            if weight == 0.0 {
                continue;
            }
            let mut own = self.hermite(i, k, t, read);
            if read == Read::Integral {
                let turn = self.integrals[self.angles.len() * m + k];
                own += self.integrals[i * m + k] + turns * turn;
            }
            sum += weight * own;
        }
        sum
    }

    /// Radial offset, m.
    #[must_use]
    pub fn offset(&self, angle: f64, z: f64) -> f64 {
        self.read(angle, z, Read::Value, false)
    }

    /// Its derivatives by angle (m/rad) and by z (1).
    #[must_use]
    pub fn gradient(&self, angle: f64, z: f64) -> [f64; 2] {
        [
            self.read(angle, z, Read::Slope, false),
            self.read(angle, z, Read::Value, true),
        ]
    }

    /// Its integral around up to `angle` from a fixed one, m rad.
    #[must_use]
    pub fn integral(&self, angle: f64, z: f64) -> f64 {
        self.read(angle, z, Read::Integral, false)
    }

    /// First and last position, m.
    #[must_use]
    pub fn span(&self) -> [f64; 2] {
        [self.positions[0], self.positions[self.positions.len() - 1]]
    }

    /// The positions of its columns, m.
    #[must_use]
    pub fn positions(&self) -> &[f64] {
        &self.positions
    }

    /// Angles in a turn.
    #[must_use]
    pub fn n_around(&self) -> usize {
        self.angles.len()
    }

    /// It differs around.
    #[must_use]
    pub fn varies_around(&self) -> bool {
        let m = self.positions.len();
        let first = &self.offsets[..m];
        self.offsets.chunks_exact(m).any(|row| row != first)
    }

    /// It differs along the axis.
    #[must_use]
    pub fn varies_along(&self) -> bool {
        let m = self.positions.len();
        self.offsets
            .chunks_exact(m)
            .any(|row| row.iter().any(|v| *v != row[0]))
    }

    /// It is its own mirror image in the mid-plane.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        let m = self.positions.len();
        let [first, last] = self.span();
        let near = 1e-12 * (last - first).abs();
        let ends = self.positions.iter().zip(self.positions.iter().rev());
        let columns = ends.map(|(a, b)| (a + b).abs()).fold(0.0, f64::max) <= near;
        let rows = self
            .offsets
            .chunks_exact(m)
            .all(|row| row.iter().eq(row.iter().rev()));
        rows && (columns || m == 1)
    }

    /// Bounds of the second derivatives by angle (m/rad2) and by z (1/m).
    #[must_use]
    pub fn curvature_bounds(&self) -> [f64; 2] {
        /// Largest sum of the weights' sizes over what a cubic through even nodes has, 1.25.
        const WEIGHTS: f64 = 2.0;
        let (n, m) = (self.angles.len(), self.positions.len());
        let mut around = 0.0_f64;
        for i in 0..n {
            let length = self.length(i);
            for k in 0..m {
                let end = |t: f64| self.hermite(i, k, t, Read::Slope) * length;
                // A cubic's second derivative is linear: its values at the ends by its slopes.
                let (s0, s1, middle) = (end(0.0), end(1.0), end(0.5));
                let first = 4.0 * middle - 3.0 * s0 - s1;
                let last = 3.0 * s1 + s0 - 4.0 * middle;
                around = around.max(first.abs().max(last.abs()) / (length * length));
            }
        }
        let mut along = 0.0_f64;
        for row in 0..n {
            let value = |z: f64| {
                let weights = self.weights(z, true);
                let terms = weights.map(|(k, w)| w * self.offsets[row * m + k]);
                terms.iter().sum::<f64>()
            };
            for pair in self.positions.windows(2) {
                let length = pair[1] - pair[0];
                let end = |t: f64| value(pair[0] + t * length) * length;
                let (s0, s1, middle) = (end(0.0), end(1.0 - 1e-12), end(0.5));
                let first = 4.0 * middle - 3.0 * s0 - s1;
                let last = 3.0 * s1 + s0 - 4.0 * middle;
                along = along.max(first.abs().max(last.abs()) / (length * length));
            }
        }
        [WEIGHTS * around, WEIGHTS * along]
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn nodes() -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let angles = vec![0.2, 0.9, 2.0, 3.5, 4.1, 5.7];
        let positions = vec![-0.02, -0.004, 0.003, 0.011];
        let offsets = (0..24).map(|k| 1e-6 * f64::from((7 * k) % 11)).collect();
        (angles, positions, offsets)
    }

    fn table() -> ProfileTable {
        let (angles, positions, offsets) = nodes();
        ProfileTable::new(angles, positions, offsets).unwrap()
    }

    #[test]
    fn a_table_meets_its_nodes_without_a_bend() {
        let ((angles, positions, offsets), table) = (nodes(), table());
        for (i, &angle) in angles.iter().enumerate() {
            for (k, &z) in positions.iter().enumerate() {
                let value = offsets[i * 4 + k];
                assert!((table.offset(angle, z) - value).abs() < 1e-20);
                let near = |by: f64, bz: f64| table.gradient(angle + by, z + bz);
                let jump = near(1e-9, 0.0)[0] - near(-1e-9, 0.0)[0];
                assert!(jump.abs() < 1e-12, "{jump}");
                if k > 0 && k < 3 {
                    let jump = near(0.0, 1e-12)[1] - near(0.0, -1e-12)[1];
                    assert!(jump.abs() < 1e-11, "{jump}");
                }
            }
        }
    }

    /// A table of a smooth profile comes close to it, by the third order.
    #[test]
    fn a_finer_table_is_closer() {
        let error = |n: usize| {
            let angles: Vec<f64> = (0..n).map(|i| TAU * i as f64 / n as f64).collect();
            let positions: Vec<f64> = (0..n).map(|k| k as f64 / (n - 1) as f64 - 0.5).collect();
            let value = |a: f64, z: f64| (2.0 * a).cos() * (1.0 + z * z);
            let offsets = angles
                .iter()
                .flat_map(|a| positions.iter().map(move |z| value(*a, *z)))
                .collect();
            let table = ProfileTable::new(angles, positions, offsets).unwrap();
            let places = (0..200).map(|k| (0.0314 * f64::from(k), 0.0049 * f64::from(k) - 0.48));
            places
                .map(|(a, z)| (table.offset(a, z) - value(a, z)).abs())
                .fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(24), error(48));
        assert!(
            fine < 1e-3 && (coarse / fine).log2() > 2.7,
            "{coarse} {fine}"
        );
    }
}
