//! What would the reaction still change by, if the cavitated set settled where the film is?
//!
//! A cell that changes its state adds one unknown to the solved film M p = b, or takes one away. With
//! the adjoints y of the outputs (`M^T y = w`) the change of an output is, for one cell k of its own,
//!
//! ```text
//! full to ruptured    -p_k y_k / (M^-1)_kk                      <= |p_k y_k| M_kk
//! ruptured to full    (w_k + sum over neighbours c y) e_k / S   <= the same with S >= M_kk/2
//! ```
//! where `e_k` is what enters the ruptured cell beyond what leaves it, c the conductances of its faces,
//! `M_kk` their sum and S the Schur complement of the cell. Changes are added without their signs; what
//! the changes of several cells do to one another, and the changes that may follow, is left out, so that
//! it is an estimate and no bound. Only for closures whose ruptured cells have a known pressure.

use crate::cavitation::FilmSet;
use crate::linear::Lanes;
use crate::reynolds::{Cell, Operator};

/// A solved film before and after its set moved on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SetChange<'a, const L: usize> {
    pub(crate) operator: &'a Operator,
    /// State of the cells that was solved.
    pub(crate) solved: &'a [Cell],
    pub(crate) next: &'a FilmSet,
    /// P - P_cav per cell, 1/s.
    pub(crate) pressure: &'a [f64],
    /// Entering beyond leaving per cell, 1/s.
    pub(crate) excess: &'a [f64],
    /// Adjoints of the outputs.
    pub(crate) adjoints: &'a [Lanes<L>],
}

impl<const L: usize> SetChange<'_, L> {
    /// Cells that changed their state.
    fn cells(&self) -> impl Iterator<Item = usize> {
        let states = self.solved.iter().zip(&self.next.cells).enumerate();
        states.filter_map(|(k, (before, after))| (before != after).then_some(k))
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.cells().count()
    }

    /// Size of the change of each output, given the derivative of the outputs by P of a cell.
    pub(crate) fn outputs(&self, weight: impl Fn(usize) -> Lanes<L>) -> Lanes<L> {
        let mut sizes = [0.0; L];
        for k in self.cells() {
            let faces = self.faces(k);
            let own: f64 = faces.iter().map(|(conductance, _)| conductance).sum();
            let (by_pressure, pressure) = if self.solved[k] == Cell::Full {
                (self.adjoints[k].map(|y| own * y), self.pressure[k])
            } else {
                let mut sum = weight(k);
                for (conductance, cell) in faces {
                    let Some(cell) = cell else { continue };
                    for (sum, y) in sum.iter_mut().zip(self.adjoints[cell]) {
                        *sum += conductance * y;
                    }
                }
                (sum, 2.0 * self.excess[k] / own)
            };
            for (size, by_pressure) in sizes.iter_mut().zip(by_pressure) {
                *size += (by_pressure * pressure).abs();
            }
        }
        sizes
    }

    /// Conductance of the faces of a cell, and the cells behind them.
    fn faces(&self, k: usize) -> [(f64, Option<usize>); 4] {
        let operator = self.operator;
        let m = operator.n_axial;
        let (i, j) = (k / m, k % m);
        let axial = i * (m + 1) + j;
        [
            (operator.conductance_around[k], operator.west(i, j)),
            (operator.conductance_around[k + m], operator.east(i, j)),
            (operator.conductance_axial[axial], (j > 0).then(|| k - 1)),
            (operator.conductance_axial[axial + 1], (j + 1 < m).then_some(k + 1)),
        ]
    }
}
