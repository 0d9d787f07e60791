//! Jakobsson, Floberg (1957) and Olsson (1965): `p >= p_cav`, `0 <= theta <= 1`,
//! `(p - p_cav)(1 - theta) = 0`, with theta transported and stored, so that oil is conserved in
//! every cell, at rupture and where the film forms again.
//!
//! The unknown of a full cell is its pressure, that of a ruptured cell its film fraction. Column by
//! column the matrix is diagonally dominant, whatever the set.

use super::{CavitationModel, FilmSet, RupturedRow, assemble_balance};
use crate::linear::RingMatrix;
use crate::reynolds::{Cell, Operator};

/// The mass-conserving closure.
#[derive(Debug, Clone, Copy)]
pub struct MassConserving;

impl CavitationModel for MassConserving {
    fn conserves_mass(&self) -> bool {
        true
    }

    fn assemble(
        &self,
        operator: &Operator,
        set: &FilmSet,
        matrix: &mut RingMatrix,
        rhs: &mut [f64],
    ) {
        assemble_balance(operator, set, RupturedRow::FilmFraction, matrix, rhs);
        drain_closed_circles(operator, set, matrix);
    }

    fn fields(
        &self,
        set: &FilmSet,
        solution: &[f64],
        pressure: &mut [f64],
        film_fraction: &mut [f64],
    ) {
        for (k, x) in solution.iter().enumerate() {
            (pressure[k], film_fraction[k]) = match set.cells[k] {
                Cell::Full => (*x, 1.0),
                Cell::Fed => (*x, set.fed_fraction[k]),
                Cell::Ruptured => (0.0, *x),
            };
        }
    }

    /// A ruptured cell that nothing drains cannot be: it is full.
    fn admit_set(&self, operator: &Operator, set: &mut FilmSet) {
        for (k, cell) in set.cells.iter_mut().enumerate() {
            if *cell == Cell::Ruptured && !can_drain(operator, k) {
                *cell = Cell::Full;
            }
        }
    }

    /// A full cell with negative pressure ruptures, if it can then drain: a closing gap that holds
    /// more than leaves it stays full. A ruptured cell with more than a full film fills.
    fn update_set(
        &self,
        operator: &Operator,
        pressure: &[f64],
        film_fraction: &[f64],
        _excess: &[f64],
        tolerance: f64,
        set: &mut FilmSet,
    ) -> usize {
        let mut moved = set.update_ends(operator, pressure, tolerance);
        for (k, cell) in set.cells.iter_mut().enumerate() {
            let next = match *cell {
                Cell::Full if pressure[k] < 0.0 && can_drain(operator, k) => Cell::Ruptured,
                Cell::Ruptured if film_fraction[k] > 1.0 || !can_drain(operator, k) => Cell::Full,
                unchanged => unchanged,
            };
            moved += usize::from(next != *cell);
            *cell = next;
        }
        moved
    }
}

/// Whether a film fraction has anything to balance it: transport out of the cell, or storage.
fn can_drain(operator: &Operator, cell: usize) -> bool {
    operator.outflow(cell) + operator.ruptured_storage[cell] > 0.0
}

/// Around a circle of ruptured cells oil turns for ever: where nothing enters and nothing is stored,
/// any film fraction balances. A leak far below every other flow picks the empty one of them, which
/// balances exactly; a circle into which oil does flow fills and is ruptured no longer.
fn drain_closed_circles(operator: &Operator, set: &FilmSet, matrix: &mut RingMatrix) {
    const LEAK: f64 = 1e-11;
    let (n, m) = (operator.n_around, operator.n_axial);
    for j in 0..m {
        let is_idle = |k: usize| set.cells[k] == Cell::Ruptured && operator.stored[k] == 0.0;
        if (0..n).all(|i| is_idle(i * m + j)) {
            for i in 0..n {
                matrix.centre[i * m + j] *= 1.0 + LEAK;
            }
        }
    }
}
