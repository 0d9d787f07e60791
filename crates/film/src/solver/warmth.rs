//! The temperatures of a film on a grid: what is accounted for, and what it leads to.

use super::FilmSolver;
use crate::bearing::Inlet;
use crate::energy::{HeatAccount, Surroundings};
use crate::force::Warmed;
use crate::passage::Passage;

impl FilmSolver {
    /// Counts the film as last solved for a time (s).
    pub(super) fn add_to_account(&mut self, duration: f64) {
        let periodic = self.bearing.inlet == Inlet::Cyclic;
        let mut heat = std::mem::take(&mut self.film.heat);
        let turned = self.frame.turn(&self.film.state);
        let local = self.frame.to_grid(&self.film.state, turned);
        heat.take(&self.solved(), &local);
        let feeds = self.bearing.feeds.len() + usize::from(!periodic);
        let radius = self.bearing.radius();
        let account = self
            .film
            .account
            .get_or_insert_with(|| HeatAccount::new(&self.grid, radius, periodic, feeds));
        account.add(&heat.instant(&self.film.fed_by), duration);
        self.film.heat = heat;
    }

    /// See [`crate::FilmForce::warm`].
    pub(super) fn move_temperatures(
        &mut self,
        surroundings: &Surroundings<'_>,
        share: f64,
    ) -> Option<Warmed> {
        let account = self.film.account.as_mut()?;
        let found = account.temperature(surroundings)?;
        account.clear();
        if self.film.passage.is_none() {
            self.film.passage = Passage::new(&self.grid, None, false, true);
        }
        let reference = surroundings.supply.first().copied();
        let reference = reference.unwrap_or(surroundings.ambient);
        let cells = self
            .film
            .temperature
            .get_or_insert_with(|| vec![reference; found.cells.len()]);
        let mut warmed = Warmed {
            outlet: found.outlet,
            balance: self.extent.energy(found.balance),
            hottest: f64::NEG_INFINITY,
            ..Warmed::default()
        };
        for (cell, led_to) in cells.iter_mut().zip(&found.cells) {
            warmed.change = warmed.change.max((led_to - *cell).abs());
            *cell += share * (led_to - *cell);
            warmed.hottest = warmed.hottest.max(*cell);
        }
        let m = self.grid.n_axial();
        let (mut sum, mut area) = (0.0, 0.0);
        for (k, cell) in cells.iter().enumerate() {
            sum += cell * self.grid.area(k / m, k % m);
            area += self.grid.area(k / m, k % m);
        }
        warmed.mean = sum / area;
        self.film.is_warm = true;
        Some(warmed)
    }
}
