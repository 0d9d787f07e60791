//! Solution of the small linear systems of one journal (2 or 4 unknowns).

/// Solves the leading `size` rows and columns of `matrix x = right` by Gaussian elimination with
/// partial pivoting; `None` if the matrix is singular or not finite. Unused entries come back as 0.
pub(crate) fn solve(
    mut matrix: [[f64; 4]; 4],
    mut right: [f64; 4],
    size: usize,
) -> Option<[f64; 4]> {
    for column in 0..size {
        let pivot = (column..size).max_by(|a, b| {
            matrix[*a][column]
                .abs()
                .total_cmp(&matrix[*b][column].abs())
        })?;
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        let diagonal = matrix[column][column];
        if !diagonal.is_finite() || diagonal == 0.0 {
            return None;
        }
        let pivot_row = matrix[column];
        for row in column + 1..size {
            let factor = matrix[row][column] / diagonal;
            for (value, above) in matrix[row].iter_mut().zip(pivot_row).skip(column) {
                *value -= factor * above;
            }
            right[row] -= factor * right[column];
        }
    }
    let mut solution = [0.0; 4];
    for row in (0..size).rev() {
        let known: f64 = (row + 1..size)
            .map(|column| matrix[row][column] * solution[column])
            .sum();
        solution[row] = (right[row] - known) / matrix[row][row];
    }
    solution
        .iter()
        .all(|value| value.is_finite())
        .then_some(solution)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::solve;

    #[test]
    fn solves_with_pivoting_and_refuses_singular() {
        let matrix = [
            [0.0, 2.0, 1.0, 0.0],
            [1.0, 0.0, 0.0, 3.0],
            [4.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 5.0, 1.0],
        ];
        let x = [1.0, -2.0, 3.0, 0.5];
        let right = matrix.map(|row| row.iter().zip(x).map(|(a, b)| a * b).sum());
        let found = solve(matrix, right, 4).unwrap();
        assert!(found.iter().zip(x).all(|(a, b)| (a - b).abs() < 1e-14));
        assert!(solve([[0.0; 4]; 4], right, 2).is_none());
    }
}
