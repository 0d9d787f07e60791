//! Symmetric systems whose rows begin at a given column: Cholesky inside the profile.

/// A positive definite matrix by the rows of its lower triangle, then its factor.
#[derive(Debug, Clone)]
pub(super) struct ProfileMatrix {
    /// First column of each row.
    starts: Vec<usize>,
    /// Where each row lies in `entries`; one more at the end.
    offsets: Vec<usize>,
    entries: Vec<f64>,
}

impl ProfileMatrix {
    /// Zeros from `starts` to the diagonal.
    pub(super) fn new(starts: Vec<usize>) -> Self {
        let mut offsets = vec![0];
        for (row, start) in starts.iter().enumerate() {
            offsets.push(offsets[row] + row + 1 - start);
        }
        let entries = vec![0.0; offsets[starts.len()]];
        Self {
            starts,
            offsets,
            entries,
        }
    }

    pub(super) fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    /// Columns `from` to `from + M` of a row, for additions.
    #[inline]
    pub(super) fn part<const M: usize>(&mut self, row: usize, from: usize) -> &mut [f64] {
        let first = self.offsets[row] + from - self.starts[row];
        let last = (first + M).min(self.offsets[row + 1]);
        &mut self.entries[first..last]
    }

    /// Replaces the matrix by its factor; false where it is not positive definite.
    pub(super) fn factor(&mut self) -> bool {
        for row in 0..self.starts.len() {
            let start = self.starts[row];
            let (above, rest) = self.entries.split_at_mut(self.offsets[row]);
            let own = &mut rest[..=row - start];
            for column in start..row {
                let begin = self.starts[column].max(start);
                let other = &above[self.offsets[column]..self.offsets[column + 1]];
                let left = &other[begin - self.starts[column]..];
                let known = dot(&own[begin - start..column - start], left);
                own[column - start] = (own[column - start] - known) * left[column - begin];
            }
            let (before, last) = own.split_at_mut(row - start);
            let pivot = last[0] - dot(before, before);
            if pivot.is_nan() || pivot <= 0.0 {
                return false;
            }
            // The diagonal holds its inverse: rows are divided by it many times.
            last[0] = 1.0 / pivot.sqrt();
        }
        true
    }

    /// Solves for two right-hand sides in place.
    pub(super) fn solve(&self, sides: &mut [[f64; 2]]) {
        for row in 0..self.starts.len() {
            let start = self.starts[row];
            let own = &self.entries[self.offsets[row]..self.offsets[row + 1]];
            let mut value = sides[row];
            for (entry, known) in own.iter().zip(&sides[start..row]) {
                value[0] -= entry * known[0];
                value[1] -= entry * known[1];
            }
            let inverse = own[row - start];
            sides[row] = value.map(|value| value * inverse);
        }
        for row in (0..self.starts.len()).rev() {
            let start = self.starts[row];
            let own = &self.entries[self.offsets[row]..self.offsets[row + 1]];
            let inverse = own[row - start];
            let value = sides[row].map(|value| value * inverse);
            sides[row] = value;
            for (entry, open) in own.iter().zip(&mut sides[start..row]) {
                open[0] -= entry * value[0];
                open[1] -= entry * value[1];
            }
        }
    }
}

/// Scalar product over the shorter length, in four sums so that lanes can be used.
#[inline]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let count = a.len().min(b.len());
    let (a, b) = (&a[..count], &b[..count]);
    let (a_fours, a_rest) = a.as_chunks::<4>();
    let (b_fours, b_rest) = b.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (a, b) in a_fours.iter().zip(b_fours) {
        for lane in 0..4 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows in two overlapping blocks.
    fn matrix() -> (ProfileMatrix, Vec<Vec<f64>>) {
        let starts = vec![0, 0, 0, 0, 2, 2, 2];
        let mut full = vec![vec![0.0; 7]; 7];
        let mut profile = ProfileMatrix::new(starts.clone());
        for row in 0..7 {
            for column in starts[row]..=row {
                let value = if row == column {
                    5.0 + row as f64
                } else {
                    1.0 / (1.0 + (row * 3 + column) as f64)
                };
                full[row][column] = value;
                full[column][row] = value;
                profile.part::<1>(row, column)[0] += value;
            }
        }
        (profile, full)
    }

    #[test]
    fn the_solution_satisfies_the_matrix() {
        let (mut profile, full) = matrix();
        let sides: Vec<[f64; 2]> = (0..7).map(|i| [i as f64 - 2.0, (i * i) as f64]).collect();
        let mut x = sides.clone();
        assert!(profile.factor());
        profile.solve(&mut x);
        for row in 0..7 {
            for side in 0..2 {
                let sum: f64 = (0..7).map(|k| full[row][k] * x[k][side]).sum();
                assert!((sum - sides[row][side]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn what_is_not_positive_is_told() {
        let mut profile = ProfileMatrix::new(vec![0, 0]);
        profile.part::<1>(0, 0)[0] = 1.0;
        profile.part::<2>(1, 0).copy_from_slice(&[2.0, 1.0]);
        assert!(!profile.factor());
    }
}
