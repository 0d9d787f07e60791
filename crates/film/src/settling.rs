//! What is the film of another set, a few of whose cells differ from one that was solved?
//!
//! A cell k that ruptures is held at zero by a source q in its balance; one that fills has a pressure u,
//! which drives its neighbours through the conductances c of its faces. With the solved matrix M the film
//! of the new set is
//!
//! ```text
//! x' = x + sum q M^-1 e_k + sum u M^-1 (e_k + sum over full neighbours c e_n)
//! ```
//! where the few q and u follow from `x'_k = 0`, and from the balance of cells that fill: a small dense
//! system (Sherman, Morrison, Woodbury). Adjoints change alike, because M is symmetric. So a front that
//! moves by a few cells needs no second elimination, and the film is that of the new set to round-off.
//! Only for closures whose ruptured cells have a known pressure. Reference: W. W. Hager, SIAM Rev. 31
//! (1989) 221, 10.1137/1031049.

use crate::linear::{Lanes, RingFactor, solve_dense};
use crate::reynolds::{Cell, Operator};

/// Cells that may differ: as many as the factors are applied to at once.
const LARGEST_CHANGE: usize = 4;

/// A cell that differs from the set that was solved.
#[derive(Debug, Clone, Copy)]
struct Change {
    cell: usize,
    fills: bool,
}

/// The solved film, the cells that differ and its answers to them.
#[derive(Debug, Clone)]
pub(crate) struct Settling {
    cells: Vec<Cell>,
    solution: Vec<f64>,
    /// Entering beyond leaving per cell, 1/s.
    excess: Vec<f64>,
    changes: Vec<Change>,
    answers: Vec<Lanes>,
}

impl Settling {
    /// Storage for `cells` cells.
    pub(crate) fn new(cells: usize) -> Self {
        Self {
            cells: vec![Cell::Full; cells],
            solution: vec![0.0; cells],
            excess: vec![0.0; cells],
            changes: Vec::with_capacity(LARGEST_CHANGE),
            answers: vec![[0.0; LARGEST_CHANGE]; cells],
        }
    }

    /// Takes a film as it was solved.
    pub(crate) fn begin(&mut self, cells: &[Cell], solution: &[f64], excess: &[f64]) {
        self.cells.copy_from_slice(cells);
        self.solution.copy_from_slice(solution);
        self.excess.copy_from_slice(excess);
        self.changes.clear();
    }

    /// The film is the one that was solved.
    pub(crate) fn forget(&mut self) {
        self.changes.clear();
    }

    /// Writes the film of the set `next` into `solution`; `false`, and nothing is changed, where too
    /// many cells differ or none.
    pub(crate) fn solve(
        &mut self,
        operator: &Operator,
        factor: &mut RingFactor,
        next: &[Cell],
        solution: &mut [f64],
    ) -> bool {
        let differ = |k: &usize| self.cells[*k] != next[*k];
        let count = (0..next.len()).filter(differ).count();
        if count == 0 || count > LARGEST_CHANGE {
            return false;
        }
        self.changes.clear();
        let changed = (0..next.len()).filter(|&k| self.cells[k] != next[k]);
        self.changes.extend(changed.map(|cell| Change {
            cell,
            fills: next[cell] == Cell::Full,
        }));
        self.answers.fill([0.0; LARGEST_CHANGE]);
        for (lane, change) in self.changes.iter().enumerate() {
            self.answers[change.cell][lane] += 1.0;
            if change.fills {
                for (conductance, cell) in faces(operator, change.cell) {
                    if let Some(cell) = cell.filter(|&cell| self.cells[cell] == Cell::Full) {
                        self.answers[cell][lane] += conductance;
                    }
                }
            }
        }
        factor.solve_transposed(&mut self.answers);
        solution.copy_from_slice(&self.solution);
        let (film, _) = solution.as_chunks_mut::<1>();
        let excess = &self.excess;
        if self.correct(operator, film, |k, _| [excess[k]]) {
            return true;
        }
        self.changes.clear();
        false
    }

    /// Turns the adjoints `y` of the film that was solved into those of the one last found. `weight` is
    /// the derivative of the outputs by P of a cell.
    pub(crate) fn correct_adjoints<const L: usize>(
        &self,
        operator: &Operator,
        y: &mut [Lanes<L>],
        weight: impl Fn(usize) -> Lanes<L>,
    ) {
        for change in self.changes.iter().filter(|change| change.fills) {
            y[change.cell] = [0.0; L];
        }
        self.correct(operator, y, |k, y| {
            let mut sum = weight(k);
            for (conductance, cell) in faces(operator, k) {
                let Some(cell) = cell else { continue };
                for (sum, y) in sum.iter_mut().zip(y[cell]) {
                    *sum += conductance * y;
                }
            }
            sum
        });
    }

    /// Adds what the changed cells do to `x`, given what the balance of a cell that fills lacks.
    fn correct<const L: usize>(
        &self,
        operator: &Operator,
        x: &mut [Lanes<L>],
        lacks: impl Fn(usize, &[Lanes<L>]) -> Lanes<L>,
    ) -> bool {
        let count = self.changes.len();
        if count == 0 {
            return true;
        }
        let mut matrix = [0.0; LARGEST_CHANGE * LARGEST_CHANGE];
        let mut right = [[0.0; 4]; LARGEST_CHANGE];
        for (row, change) in self.changes.iter().enumerate() {
            let k = change.cell;
            let mut line = self.answers[k];
            let mut known = x[k].map(|x| -x);
            if change.fills {
                let faces = faces(operator, k);
                let own: f64 = faces.iter().map(|(conductance, _)| conductance).sum();
                line = line.map(|answer| own * answer);
                for (conductance, cell) in faces {
                    let Some(cell) = cell else { continue };
                    for (entry, answer) in line.iter_mut().zip(self.answers[cell]) {
                        *entry -= conductance * answer;
                    }
                }
                known = lacks(k, x);
            }
            matrix[row * count..(row + 1) * count].copy_from_slice(&line[..count]);
            right[row][..L].copy_from_slice(&known);
        }
        if !solve_dense(&mut matrix[..count * count], &mut right[..count]) {
            return false;
        }
        for (x, answers) in x.iter_mut().zip(&self.answers) {
            for (answer, by) in answers.iter().zip(&right[..count]) {
                for (x, by) in x.iter_mut().zip(by) {
                    *x += answer * by;
                }
            }
        }
        for change in self.changes.iter().filter(|change| !change.fills) {
            x[change.cell] = [0.0; L];
        }
        true
    }
}

/// Conductance of the faces of a cell, and the cells behind them.
fn faces(operator: &Operator, k: usize) -> [(f64, Option<usize>); 4] {
    let m = operator.n_axial;
    let (i, j) = (k / m, k % m);
    let along = i * (m + 1) + j;
    [
        (operator.conductance_around[k], operator.west(i, j)),
        (operator.conductance_around[k + m], operator.east(i, j)),
        (operator.conductance_axial[along], (j > 0).then(|| k - 1)),
        (
            operator.conductance_axial[along + 1],
            (j + 1 < m).then_some(k + 1),
        ),
    ]
}
