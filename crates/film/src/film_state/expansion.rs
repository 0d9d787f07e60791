//! What a solution makes of pressure, density and displacement: the place about which the next one is
//! linearised.

use super::FilmState;
use crate::bearing::{Bearing, Inlet};
use crate::cavitation::CavitationModel;
use crate::finish::Finish;
use crate::grid::Grid;
use crate::integrals::Units;
use crate::nonlinear::EndOpening;
use crate::reduced_pressure::ReducedPressure;
use crate::reynolds::Cell;

/// H that a soft shell keeps open where the rigid shapes overlap, and the share of one that was thinner.
const LEAST_HEIGHT: f64 = 2e-3;
const STAYING: f64 = 0.4;

impl FilmState {
    /// What the new solution makes of pressure, density and displacement, the place about which the next
    /// one is linearised.
    pub(super) fn expand(&mut self, closure: &dyn CavitationModel) {
        self.exceeds_limit = false;
        self.is_bending = false;
        if self.reduced == ReducedPressure::Same && self.expansion.is_linear() {
            self.stiffened.clear();
            return;
        }
        let unit = self.units.pressure;
        let is_soft = !self.expansion.displacement.is_empty();
        self.stiffened.resize(self.pressure.len(), [0.0, 1.0]);
        self.turned_back.clear();
        for k in 0..self.pressure.len() {
            let full = self.reduced.pressure(self.pressure[k] * unit);
            let held = is_soft.then(|| self.held_back(k, full)).flatten();
            let (pressure, slope) = match (held, full) {
                (Some((at, pressure, slope)), _) => {
                    self.turned_back.push((k, at));
                    (pressure, slope)
                }
                (None, Some(full)) => full,
                (None, None) => {
                    self.exceeds_limit = true;
                    self.reduced.highest()
                }
            };
            self.stiffened[k] = [pressure / unit, slope];
        }
        if !self.expansion.is_linear() {
            self.move_expansion();
            let pressure = closure.equation_pressure(&self.solution, &self.pressure);
            self.expansion.pressure.copy_from_slice(pressure);
        }
        self.is_bending |= !self.turned_back.is_empty();
        for (k, at) in &self.turned_back {
            self.expansion.pressure[*k] = *at;
        }
    }

    /// Where the pressure of a cell rises to far more than the slope of the last one foretold, or beyond
    /// the limit: what the slope foretold, with reduced pressure (1/s), pressure (Pa) and slope there. A soft
    /// shell would make way for a pressure that it never gets, and leave the film without one.
    fn held_back(&self, k: usize, full: Option<(f64, f64)>) -> Option<(f64, f64, f64)> {
        const MOST: f64 = 1.5;
        let unit = self.units.pressure;
        let [last, slope] = self.stiffened[k];
        let rise = self.pressure[k] - self.expansion.pressure[k].max(0.0);
        if rise <= 0.0 {
            return None;
        }
        let foretold = (last.max(0.0) + slope * rise) * unit;
        if full.is_some_and(|(pressure, _)| pressure <= MOST * foretold) {
            return None;
        }
        let reduced = self.reduced.reduced(foretold);
        let (pressure, slope) = self.reduced.pressure(reduced)?;
        Some((reduced / unit, pressure, slope))
    }

    /// Density and displacement at the new pressures. Where the density bends by round-off alone the cell holds what
    /// its equation said, so that a settled film gains and loses no oil.
    fn move_expansion(&mut self) {
        const ROUND_OFF: f64 = 1e-9;
        let unit = self.units.pressure;
        let is_soft = !self.expansion.displacement.is_empty();
        for k in 0..self.pressure.len() {
            if is_soft {
                self.move_shell(k);
            }
            let [pressure, slope] = self.stiffened[k];
            let change = self.pressure[k] - self.expansion.pressure[k].max(0.0);
            let mut content = self.film_fraction[k];
            if let Some(density) = self.expansion.density.get_mut(k) {
                let is_full = self.set.cells[k] == Cell::Full;
                let next = if is_full {
                    let (factor, by_pressure) = self.compression.factor(pressure * unit);
                    [factor, by_pressure * unit * slope]
                } else {
                    [1.0, 0.0]
                };
                let linear = density[0] + density[1] * change;
                let bends = is_full && (next[0] - linear).abs() > ROUND_OFF;
                self.is_bending |= bends;
                *density = next;
                content *= if is_full && !bends { linear } else { next[0] };
            }
            self.expansion.content[k] = content;
        }
    }

    /// Displacement of one cell at its new pressure. A step that opens the gap by more than it is, or closes
    /// more than a share of it, has left what its slopes are good for: the shell goes part of the way, and the
    /// pressure with it.
    fn move_shell(&mut self, k: usize) {
        const ROUND_OFF: f64 = 1e-9;
        const CLOSING: f64 = 0.6;
        let unit = self.units.pressure;
        let [pressure, slope] = self.stiffened[k];
        let compliance = self.compliance * unit / self.units.clearance;
        let height = self.passage.as_ref().map_or(&self.gap.mean, |p| &p.height)[k];
        let [before, _] = self.expansion.displacement[k];
        if self.set.cells[k] == Cell::Fed {
            self.is_bending |= before.abs() > ROUND_OFF * height.abs().max(1e-3);
            self.expansion.displacement[k] = [0.0; 2];
            return;
        }
        let asperities = Asperities {
            finish: &self.finish,
            units: &self.units,
            compliance,
        };
        let rigid = height - before;
        let (next, yielding) = asperities.displaced(rigid, compliance * pressure.max(0.0));
        let opening = 0.5 * height.abs().max(before.abs()).max(1e-3);
        let rough = self.finish.composite_roughness() / self.units.clearance;
        let closing = CLOSING * height.max(0.0) + rough;
        let moved = next - before;
        self.is_bending |= moved.abs() > ROUND_OFF * height.abs().max(1e-3);
        let after = before + moved.clamp(-closing, opening);
        self.expansion.displacement[k] = [after, compliance * slope * yielding];
        if let Some(contact) = self.contact.get_mut(k) {
            // What the journal feels is what presses at this solution, not at the last.
            contact[0] = asperities.pressing(rigid + after);
        }
        if after == next || self.set.cells[k] != Cell::Full {
            return;
        }
        let (by_film, yielding) = asperities.share_of_film(rigid, after);
        let reduced = self.reduced.reduced((by_film / compliance).max(0.0) * unit);
        if let Some((pressure, slope)) = self.reduced.pressure(reduced) {
            self.stiffened[k] = [pressure / unit, slope];
            self.turned_back.push((k, reduced / unit));
            self.expansion.displacement[k] = [after, compliance * slope * yielding];
        }
    }

    /// Lets the asperities of every cell press the shell back until both agree, at the pressures of the last
    /// solution, before the gap of the rigid shapes is opened.
    pub(crate) fn press_back(&mut self) {
        if !self.finish.has_contact() || self.expansion.displacement.is_empty() {
            return;
        }
        let compliance = self.compliance * self.units.pressure / self.units.clearance;
        let asperities = Asperities {
            finish: &self.finish,
            units: &self.units,
            compliance,
        };
        self.yielding.resize(self.pressure.len(), 1.0);
        for k in 0..self.pressure.len() {
            if self.set.cells[k] == Cell::Fed {
                self.yielding[k] = 1.0;
                continue;
            }
            let pressure = self.stiffened.get(k).map_or(self.pressure[k], |[p, _]| *p);
            let by_film = compliance * pressure.max(0.0);
            let (displacement, yielding) = asperities.displaced(self.gap.mean[k], by_film);
            let slope = self.stiffened.get(k).map_or(1.0, |[_, slope]| *slope);
            self.expansion.displacement[k] = [displacement, compliance * slope * yielding];
            self.yielding[k] = yielding;
        }
    }

    /// Displacement at the boundaries, over the clearance.
    pub(crate) fn end_opening(&self, bearing: &Bearing) -> EndOpening {
        let of = |pressure: f64| {
            let above = (pressure - bearing.cavitation_pressure).max(0.0);
            self.compliance * above / self.units.clearance
        };
        EndOpening {
            around: match bearing.inlet {
                Inlet::Cyclic => [0.0; 2],
                Inlet::MaxFilmLine { pressure } => [of(pressure); 2],
            },
            axial: of(bearing.ambient_pressure),
            // Rough surfaces leave a mean gap wherever they are.
            conducts: matches!(self.finish, Finish::Smooth),
        }
    }

    /// Keeps the gap of a soft shell open where the rigid shapes overlap: it has given way at least as far, under
    /// a pressure that does it.
    pub(crate) fn give_way(&mut self) {
        if self.passage.is_some() && self.finish.has_contact() {
            // Asperities hold it open, and rough surfaces leave a mean gap wherever they are.
            return;
        }
        let unit = self.units.pressure;
        let compliance = self.compliance * unit / self.units.clearance;
        for k in 0..self.expansion.displacement.len() {
            let [before, _] = self.expansion.displacement[k];
            // A film that was thinner stays so.
            let least = LEAST_HEIGHT.min(STAYING * self.last_height[k]);
            let needed = least - self.gap.mean[k];
            if before >= needed {
                continue;
            }
            self.expansion.displacement[k][0] = needed;
            if self.set.cells[k] != Cell::Full {
                continue;
            }
            let reduced = self.reduced.reduced(needed.max(0.0) / compliance * unit);
            if let Some((pressure, slope)) = self.reduced.pressure(reduced) {
                self.stiffened.resize(self.pressure.len(), [0.0, 1.0]);
                self.stiffened[k] = [pressure / unit, slope];
                self.expansion.pressure[k] = reduced / unit;
                self.expansion.displacement[k][1] = compliance * slope;
            }
        }
    }

    /// Lets the gap of a soft shell lean upstream, as soft as the shell is under the film alone.
    pub(crate) fn lean(&mut self, grid: &Grid) {
        let unit = self.units.pressure;
        let compliance = self.compliance * unit / self.units.clearance;
        let softness = |k: usize| {
            if self.set.cells[k] == Cell::Fed {
                return [0.0; 2];
            }
            let slope = self.stiffened.get(k).map_or(1.0, |[_, slope]| *slope);
            let reduced = self.expansion.pressure[k] * unit;
            [compliance * slope, self.reduced.stiffening(reduced) * unit]
        };
        let (gap, passage) = (&self.gap, self.passage.as_ref());
        self.expansion
            .lean(grid, gap, passage, softness, &mut self.operator);
    }

    /// Where the rigid shapes overlap, only a pressure can keep the film open: such cells are full. Returns
    /// whether any was not.
    pub(crate) fn fill_overlaps(&mut self) -> bool {
        let mut filled = false;
        if self.finish != Finish::Smooth {
            return filled;
        }
        for (cell, rigid) in self.set.cells.iter_mut().zip(&self.rigid_height) {
            if *cell == Cell::Ruptured && *rigid <= 0.0 {
                *cell = Cell::Full;
                filled = true;
            }
        }
        filled
    }
}

/// Asperities that press on a soft shell.
struct Asperities<'a> {
    finish: &'a Finish,
    units: &'a Units,
    /// Displacement over the clearance per pressure of the film's unit.
    compliance: f64,
}

impl Asperities<'_> {
    /// Inverse of [`Asperities::displaced`]: what of a displacement the film makes, with the same slope.
    fn share_of_film(&self, rigid: f64, displacement: f64) -> (f64, f64) {
        if !self.finish.has_contact() {
            return (displacement, 1.0);
        }
        let (clearance, unit) = (self.units.clearance, self.units.pressure);
        let contact = self
            .finish
            .contact_pressure((rigid + displacement) * clearance);
        let by_film = displacement - self.compliance * contact.value / unit;
        let slope = self.compliance * contact.by_gap * clearance / unit;
        (by_film, 1.0 / (1.0 - slope))
    }

    /// Contact pressure over the unit at a relative gap.
    fn pressing(&self, height: f64) -> f64 {
        let pressure = self.finish.contact_pressure(height * self.units.clearance);
        pressure.value / self.units.pressure
    }

    /// Displacement u over the clearance where the film alone makes `by_film`, `u = by_film + k p_c(H + u)`,
    /// and by how much the gap then falls as that of the rigid shapes, `rigid`, does. The right side falls
    /// with u and bends upwards, so that Newton's steps from below do not overshoot.
    fn displaced(&self, rigid: f64, by_film: f64) -> (f64, f64) {
        const STEPS: usize = 40;
        const ROUND_OFF: f64 = 1e-13;
        if !self.finish.has_contact() || self.compliance == 0.0 {
            return (by_film, 1.0);
        }
        let (clearance, unit) = (self.units.clearance, self.units.pressure);
        let (mut u, mut slope) = (by_film, 0.0);
        for _ in 0..STEPS {
            let contact = self.finish.contact_pressure((rigid + u) * clearance);
            slope = self.compliance * contact.by_gap * clearance / unit;
            let missing = by_film + self.compliance * contact.value / unit - u;
            let step = missing / (1.0 - slope);
            u += step;
            if step.abs() <= ROUND_OFF * (rigid.abs() + u.abs()) {
                break;
            }
        }
        (u, 1.0 / (1.0 - slope))
    }
}
