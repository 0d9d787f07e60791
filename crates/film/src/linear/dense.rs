//! Small dense systems: a handful of unknowns beside those of the ring.

use super::Lanes;

/// Solves the `right.len()` equations `matrix x = right` in place, four right sides at once, by
/// Gaussian elimination with partial pivoting; `matrix` is row-major and is used up. Returns `false`
/// where a pivot vanishes.
pub fn solve_dense(matrix: &mut [f64], right: &mut [Lanes]) -> bool {
    let n = right.len();
    for column in 0..n {
        let size = |row: &usize| matrix[row * n + column].abs();
        let Some(pivot) = (column..n).max_by(|a, b| size(a).total_cmp(&size(b))) else {
            return false;
        };
        let value = matrix[pivot * n + column];
        if value == 0.0 || !value.is_finite() {
            return false;
        }
        if pivot != column {
            for k in 0..n {
                matrix.swap(column * n + k, pivot * n + k);
            }
            right.swap(column, pivot);
        }
        for row in column + 1..n {
            let factor = matrix[row * n + column] / value;
            for k in column..n {
                matrix[row * n + k] -= factor * matrix[column * n + k];
            }
            let above = right[column];
            for (own, above) in right[row].iter_mut().zip(above) {
                *own -= factor * above;
            }
        }
    }
    for row in (0..n).rev() {
        for k in row + 1..n {
            let (factor, known) = (matrix[row * n + k], right[k]);
            for (own, known) in right[row].iter_mut().zip(known) {
                *own -= factor * known;
            }
        }
        let pivot = matrix[row * n + row];
        right[row] = right[row].map(|value| value / pivot);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::solve_dense;

    #[test]
    fn solves_with_pivoting_and_refuses_singular() {
        let matrix = [0.0, 2.0, 1.0, 1.0, 0.0, 3.0, 4.0, 1.0, 0.0];
        let x = [
            [1.0, -2.0, 0.5, 3.0],
            [0.0, 1.0, 2.0, -1.0],
            [7.0, 0.1, 0.0, 1.0],
        ];
        let mut right = [[0.0; 4]; 3];
        for (row, right) in right.iter_mut().enumerate() {
            for (lane, right) in right.iter_mut().enumerate() {
                *right = (0..3).map(|k| matrix[3 * row + k] * x[k][lane]).sum();
            }
        }
        assert!(solve_dense(&mut matrix.clone(), &mut right));
        for (found, x) in right.iter().flatten().zip(x.iter().flatten()) {
            assert!((found - x).abs() < 1e-14);
        }
        assert!(!solve_dense(&mut [1.0, 2.0, 2.0, 4.0], &mut right[..2]));
    }
}
