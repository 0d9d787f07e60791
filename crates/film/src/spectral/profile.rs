//! Symmetric systems of square blocks whose rows begin at a given block: Cholesky inside the profile.
//!
//! `A = U^T U` with the blocks of a column of U, from the first that is not zero to the diagonal, one after
//! another: then every inner loop runs along rows of blocks.

/// A square block.
pub(super) type Block<const M: usize> = [[f64; M]; M];

/// A positive definite matrix by the columns of its upper triangle, then its factor.
#[derive(Debug, Clone)]
pub(super) struct ProfileMatrix<const M: usize> {
    /// First block of each column.
    starts: Vec<usize>,
    /// Where each column lies in `blocks`; one more at the end.
    offsets: Vec<usize>,
    blocks: Vec<Block<M>>,
}

impl<const M: usize> ProfileMatrix<M> {
    /// Zeros from `starts` to the diagonal.
    pub(super) fn new(starts: Vec<usize>) -> Self {
        let mut offsets = vec![0];
        for (column, start) in starts.iter().enumerate() {
            offsets.push(offsets[column] + column + 1 - start);
        }
        let blocks = vec![[[0.0; M]; M]; offsets[starts.len()]];
        Self {
            starts,
            offsets,
            blocks,
        }
    }

    pub(super) fn clear(&mut self) {
        self.blocks.fill([[0.0; M]; M]);
    }

    /// The block at a row and a column not before it, for additions.
    #[inline]
    pub(super) fn block(&mut self, row: usize, column: usize) -> &mut Block<M> {
        &mut self.blocks[self.offsets[column] + row - self.starts[column]]
    }

    /// Replaces the matrix by its factor; false where it is not positive definite.
    pub(super) fn factor(&mut self) -> bool {
        for column in 0..self.starts.len() {
            let start = self.starts[column];
            let (before, rest) = self.blocks.split_at_mut(self.offsets[column]);
            let own = &mut rest[..=column - start];
            for row in start..column {
                let begin = self.starts[row].max(start);
                let other = &before[self.offsets[row]..self.offsets[row + 1]];
                let other = &other[begin - self.starts[row]..];
                let (known, open) = own.split_at_mut(row - start);
                let mut block = open[0];
                for (left, right) in other.iter().zip(&known[begin - start..]) {
                    subtract_product(left, right, &mut block);
                }
                divide(&other[row - begin], &mut block);
                open[0] = block;
            }
            let (known, last) = own.split_at_mut(column - start);
            for block in known.iter() {
                subtract_product(block, block, &mut last[0]);
            }
            if !factor_diagonal(&mut last[0]) {
                return false;
            }
        }
        true
    }

    /// Solves for right-hand sides side by side in place.
    pub(super) fn solve<const L: usize>(&self, sides: &mut [[f64; L]]) {
        let (sides, _) = sides.as_chunks_mut::<M>();
        for column in 0..self.starts.len() {
            let start = self.starts[column];
            let own = &self.blocks[self.offsets[column]..self.offsets[column + 1]];
            let mut value = sides[column];
            for (block, known) in own.iter().zip(&sides[start..column]) {
                for t in 0..M {
                    for b in 0..M {
                        for side in 0..L {
                            value[b][side] -= block[t][b] * known[t][side];
                        }
                    }
                }
            }
            let diagonal = &own[column - start];
            for t in 0..M {
                value[t] = value[t].map(|part| part * diagonal[t][t]);
                for b in t + 1..M {
                    for side in 0..L {
                        value[b][side] -= diagonal[t][b] * value[t][side];
                    }
                }
            }
            sides[column] = value;
        }
        for column in (0..self.starts.len()).rev() {
            let start = self.starts[column];
            let own = &self.blocks[self.offsets[column]..self.offsets[column + 1]];
            let diagonal = &own[column - start];
            let mut value = sides[column];
            for t in (0..M).rev() {
                for b in t + 1..M {
                    for side in 0..L {
                        value[t][side] -= diagonal[t][b] * value[b][side];
                    }
                }
                value[t] = value[t].map(|part| part * diagonal[t][t]);
            }
            sides[column] = value;
            for (block, open) in own.iter().zip(&mut sides[start..column]) {
                for t in 0..M {
                    for b in 0..M {
                        for side in 0..L {
                            open[t][side] -= block[t][b] * value[b][side];
                        }
                    }
                }
            }
        }
    }
}

/// `block - left^T right`.
#[inline]
fn subtract_product<const M: usize>(left: &Block<M>, right: &Block<M>, block: &mut Block<M>) {
    for a in 0..M {
        let mut row = block[a];
        for t in 0..M {
            for b in 0..M {
                row[b] -= left[t][a] * right[t][b];
            }
        }
        block[a] = row;
    }
}

/// `U^-T block` for a factored diagonal block, whose own diagonal holds inverses.
#[inline]
fn divide<const M: usize>(diagonal: &Block<M>, block: &mut Block<M>) {
    for t in 0..M {
        let row = block[t].map(|value| value * diagonal[t][t]);
        block[t] = row;
        for a in t + 1..M {
            for b in 0..M {
                block[a][b] -= diagonal[t][a] * row[b];
            }
        }
    }
}

/// Cholesky of a block, with the inverses of its pivots on the diagonal.
fn factor_diagonal<const M: usize>(block: &mut Block<M>) -> bool {
    for t in 0..M {
        let pivot = block[t][t];
        if pivot.is_nan() || pivot <= 0.0 {
            return false;
        }
        let inverse = 1.0 / pivot.sqrt();
        for b in t + 1..M {
            block[t][b] *= inverse;
        }
        block[t][t] = inverse;
        for a in t + 1..M {
            for b in a..M {
                block[a][b] -= block[t][a] * block[t][b];
            }
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns in two overlapping groups of blocks of two.
    fn matrix() -> (ProfileMatrix<2>, Vec<Vec<f64>>) {
        let starts = vec![0, 0, 0, 0, 2, 2, 2];
        let mut full = vec![vec![0.0; 14]; 14];
        let mut profile = ProfileMatrix::new(starts.clone());
        for column in 0..7 {
            for row in starts[column]..=column {
                for a in 0..2 {
                    for b in 0..2 {
                        let (i, j) = (2 * row + a, 2 * column + b);
                        let value = if i == j {
                            9.0 + i as f64
                        } else {
                            1.0 / (1.0 + (i.min(j) * 3 + i.max(j)) as f64)
                        };
                        full[i][j] = value;
                        full[j][i] = value;
                        profile.block(row, column)[a][b] += value;
                    }
                }
            }
        }
        (profile, full)
    }

    #[test]
    fn the_solution_satisfies_the_matrix() {
        let (mut profile, full) = matrix();
        let sides: Vec<[f64; 2]> = (0..14).map(|i| [i as f64 - 2.0, (i * i) as f64]).collect();
        let mut x = sides.clone();
        assert!(profile.factor());
        profile.solve(&mut x);
        for row in 0..14 {
            for side in 0..2 {
                let sum: f64 = (0..14).map(|k| full[row][k] * x[k][side]).sum();
                assert!((sum - sides[row][side]).abs() < 1e-11);
            }
        }
    }

    #[test]
    fn what_is_not_positive_is_told() {
        let mut profile = ProfileMatrix::<1>::new(vec![0, 0]);
        profile.block(0, 0)[0][0] = 1.0;
        profile.block(0, 1)[0][0] = 2.0;
        profile.block(1, 1)[0][0] = 1.0;
        assert!(!profile.factor());
    }
}
