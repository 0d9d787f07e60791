//! Where a cold film begins.

use super::FilmSolver;
use crate::force::{Conditions, FilmError, FilmForce, Step};
use crate::journal_state::JournalState;
use crate::reynolds::Cell;

impl FilmSolver {
    /// Set of a cold film: that of the same film on half the cells, to the root.
    pub(super) fn start_cold(
        &mut self,
        state: &JournalState,
        conditions: &Conditions<'_>,
    ) -> Result<(), FilmError> {
        self.film.is_warm = true;
        for cell in &mut self.film.set.cells {
            *cell = Cell::Full;
        }
        let Some(coarse) = &mut self.coarse else {
            return Ok(());
        };
        coarse.react(state, Step::Steady, conditions)?;
        self.take_coarse_set();
        Ok(())
    }

    /// The set of the film on half the cells.
    pub(super) fn take_coarse_set(&mut self) {
        let Some(coarse) = &self.coarse else { return };
        self.film.is_warm = true;
        let m = self.grid.n_axial();
        let (n_coarse, m_coarse) = (coarse.grid.n_around(), coarse.grid.n_axial());
        let (around, along) = (self.grid.n_around() / n_coarse, m / m_coarse);
        for (k, cell) in self.film.set.cells.iter_mut().enumerate() {
            let parent = (k / m / around) * m_coarse + (k % m) / along;
            *cell = coarse.film.set.cells[parent];
        }
        let starved = &coarse.film.lines.starved;
        self.film.lines.starved.copy_from_slice(starved);
    }

    /// A soft shell whose rigid shape the journal overlaps: its displacement is followed from where the
    /// shapes leave a gap, step by step.
    pub(super) fn walk_in(
        &mut self,
        state: &JournalState,
        conditions: &Conditions<'_>,
    ) -> Result<(), FilmError> {
        const STEPS: usize = 10;
        const ROOM: f64 = 0.15;
        let is_soft = self.bearing.elasticity.compliance() > 0.0;
        let gap = |state: &JournalState| self.search.narrowest(&self.bearing, state).gap;
        let open = ROOM * self.bearing.radial_clearance;
        if !is_soft || gap(state) >= open {
            return Ok(());
        }
        let scaled = |share: f64| JournalState {
            position: state.position.map(|x| share * x),
            tilt: state.tilt.map(|turn| share * turn),
            ..*state
        };
        let mut share = 1.0;
        while share > 0.1 && gap(&scaled(share)) < open {
            share *= 0.95;
        }
        let first = share;
        for step in 0..STEPS {
            share = first + (1.0 - first) * step as f64 / STEPS as f64;
            self.react(&scaled(share), Step::Steady, conditions)?;
        }
        Ok(())
    }
}
