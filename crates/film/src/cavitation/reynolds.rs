//! Complementarity `p >= p_cav` with `p = dp/dn = 0` at rupture (Swift 1932, Stieber 1933): what the
//! seed of this program, resetting negative pressures inside the iteration, converges to. It makes
//! oil out of nothing where the film forms again.

use super::{CavitationModel, FilmSet, RupturedRow, assemble_balance};
use crate::linear::RingMatrix;
use crate::reynolds::{Axial, Cell, Operator};

/// The closure after Swift and Stieber, often named after Reynolds.
#[derive(Debug, Clone, Copy)]
pub struct Reynolds;

impl CavitationModel for Reynolds {
    fn conserves_mass(&self) -> bool {
        false
    }

    fn knows_pressures(&self) -> bool {
        true
    }

    fn assemble(
        &self,
        operator: &Operator,
        set: &FilmSet,
        matrix: &mut RingMatrix,
        rhs: &mut [f64],
    ) {
        assemble_balance(operator, set, RupturedRow::Known, matrix, rhs);
    }

    fn fields(
        &self,
        _: &FilmSet,
        solution: &[f64],
        pressure: &mut [f64],
        film_fraction: &mut [f64],
    ) {
        pressure.copy_from_slice(solution);
        film_fraction.fill(1.0);
    }

    /// A full cell with negative pressure ruptures; a ruptured cell into which a full film would
    /// push oil fills.
    fn update_set(
        &self,
        operator: &Operator,
        pressure: &[f64],
        _film_fraction: &[f64],
        excess: &[f64],
        tolerance: f64,
        set: &mut FilmSet,
    ) -> usize {
        // No pressure is below that of cavitation: against air at or below it, oil leaves every end,
        // and one that closed beside a cell about to rupture would cost an update when it fills.
        let mut moved = match operator.axial {
            Axial::Air(air) if air <= 0.0 => set.open_ends(),
            _ => set.update_ends(operator, pressure, tolerance),
        };
        for (k, cell) in set.cells.iter_mut().enumerate() {
            let next = match *cell {
                Cell::Full if pressure[k] < 0.0 => Cell::Ruptured,
                Cell::Ruptured if excess[k] > tolerance => Cell::Full,
                unchanged => unchanged,
            };
            moved += usize::from(next != *cell);
            *cell = next;
        }
        moved
    }
}
