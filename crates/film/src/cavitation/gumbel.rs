//! Half Sommerfeld: the full film is solved once and pressures below cavitation pressure are cut
//! afterwards (Guembel 1914). Nothing is conserved where the cut is made.

use super::{CavitationModel, FilmSet, RupturedRow, assemble_balance};
use crate::linear::RingMatrix;
use crate::reynolds::{Cell, Operator};

/// The closure after Guembel.
#[derive(Debug, Clone, Copy)]
pub struct Gumbel;

impl CavitationModel for Gumbel {
    fn conserves_mass(&self) -> bool {
        false
    }

    fn cuts_pressures(&self) -> bool {
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
        for ((p, theta), x) in pressure.iter_mut().zip(film_fraction).zip(solution) {
            *p = x.max(0.0);
            *theta = 1.0;
        }
    }

    fn equation_pressure<'a>(&self, solution: &'a [f64], _pressure: &'a [f64]) -> &'a [f64] {
        solution
    }

    /// Pressures that are zero are not cut: at rest in the centre all are, and the film still resists.
    fn loaded(&self, set: &FilmSet, solution: &[f64], cell: usize) -> bool {
        set.cells[cell] == Cell::Full && solution[cell] >= 0.0
    }

    /// There is nothing to decide: the full film, ends included, is solved as it is.
    fn update_set(
        &self,
        _operator: &Operator,
        _pressure: &[f64],
        _film_fraction: &[f64],
        _excess: &[f64],
        _tolerance: f64,
        _set: &mut FilmSet,
    ) -> usize {
        0
    }
}
