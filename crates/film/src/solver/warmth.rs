//! The temperatures of a film on a grid: what is accounted for, and what it leads to.

use super::FilmSolver;
use crate::bearing::Inlet;
use crate::energy::{Foresight, HeatAccount, Surroundings};
use crate::force::{Warmed, Warming};
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

    /// See [`crate::FilmForce::led_to`].
    pub(super) fn temperatures_led_to(
        &mut self,
        surroundings: &Surroundings<'_>,
        foresees: bool,
    ) -> Option<Warming> {
        let at = self.film.reduced_at;
        let from = match &self.film.temperature {
            Some(cells) => cells.clone(),
            None => vec![at; self.film.set.cells.len()],
        };
        let fall: Vec<f64> = if foresees {
            from.iter().map(|t| self.fall_of_heat(*t)).collect()
        } else {
            Vec::new()
        };
        let foresight = Foresight {
            made_at: &from,
            fall: &fall,
        };
        let account = self.film.account.as_mut()?;
        let found = account.temperature(surroundings, foresees.then_some(&foresight))?;
        let mut warmed = Warmed {
            outlet: found.outlet,
            balance: self.extent.energy(found.balance),
            hottest: f64::NEG_INFINITY,
            ..Warmed::default()
        };
        let m = self.grid.n_axial();
        let (mut sum, mut area) = (0.0, 0.0);
        for (k, (cell, led_to)) in from.iter().zip(&found.cells).enumerate() {
            warmed.change = warmed.change.max((led_to - cell).abs());
            warmed.hottest = warmed.hottest.max(*led_to);
            sum += led_to * self.grid.area(k / m, k % m);
            area += self.grid.area(k / m, k % m);
        }
        warmed.mean = sum / area;
        Some(Warming {
            from,
            led_to: found.cells,
            warmed,
        })
    }

    /// Share by which heat falls with the temperature (K) where it is made, 1/K: shear and pressure flow make
    /// it in proportion to the viscosity where the oil's motion stays.
    fn fall_of_heat(&self, temperature: f64) -> f64 {
        let viscosity = self.lubricant.viscosity(temperature, 0.0);
        let fall = -viscosity.by_temperature / viscosity.value;
        if fall.is_finite() { fall.max(0.0) } else { 0.0 }
    }

    /// See [`crate::FilmForce::warm`].
    pub(super) fn take_temperatures(&mut self, cells: &[f64]) {
        if let Some(account) = &mut self.film.account {
            account.clear();
        }
        if self.film.passage.is_none() {
            self.film.passage = Passage::new(&self.grid, None, false, true);
        }
        let field = self.film.temperature.get_or_insert_default();
        field.clear();
        field.extend_from_slice(cells);
        self.film.is_warm = true;
    }

    /// See [`crate::FilmForce::take_over`].
    pub(super) fn take_coarse_temperatures(&mut self) {
        let Some(coarse) = &self.coarse else { return };
        let Some(known) = coarse.film.temperature.as_deref() else {
            return;
        };
        let is_ring = self.bearing.inlet == Inlet::Cyclic;
        let (n, m) = (self.grid.n_around(), self.grid.n_axial());
        let (rough_n, rough_m) = (coarse.grid.n_around(), coarse.grid.n_axial());
        let around: Vec<_> = (0..n).map(|i| between(i, n, rough_n, is_ring)).collect();
        let along: Vec<_> = (0..m).map(|j| between(j, m, rough_m, false)).collect();
        let cells = (0..n * m).map(|k| {
            let [stations, rows] = [&around[k / m], &along[k % m]];
            let mut temperature = 0.0;
            for (i, by_station) in stations {
                for (j, by_row) in rows {
                    temperature += by_station * by_row * known[i * rough_m + j];
                }
            }
            temperature
        });
        let cells: Vec<f64> = cells.collect();
        self.take_temperatures(&cells);
    }
}

/// Both coarse cells that a fine one lies between, with their weights, where a coarse cell is cut into equal
/// ones.
fn between(fine: usize, of: usize, coarse: usize, is_ring: bool) -> [(usize, f64); 2] {
    let parts = of / coarse;
    let parent = fine / parts;
    // From the parent's middle, in its widths.
    let place = ((fine % parts) as f64 + 0.5) / parts as f64 - 0.5;
    let beside = match (place < 0.0, is_ring) {
        (true, true) => (parent + coarse - 1) % coarse,
        (true, false) => parent.saturating_sub(1),
        (false, true) => (parent + 1) % coarse,
        (false, false) => (parent + 1).min(coarse - 1),
    };
    [(parent, 1.0 - place.abs()), (beside, place.abs())]
}
