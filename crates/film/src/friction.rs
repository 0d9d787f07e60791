//! What resists the sliding, and what asperities carry.
//!
//! ```text
//! viscous     R int eta U_s (phi_f -+ phi_fs)/h dA  +- R int phi_fp (h/2) dp/dx dA      journal, shell
//! boundary    R int mu p_c dA                                                          both alike
//! contact     F_c = -int p_c n dA        M_c = int r x (-p_c n) dA
//! ```
//! with the factors of rough surfaces, 1, 0 and 1 for smooth ones, and the viscosity at the cell's
//! pressure, temperature and mean shear rate. In the ruptured film the shear is that of a full one or
//! weighted by its film fraction.

use crate::bearing::FilmShear;
use crate::finish::Finish;
use crate::force::Extreme;
use crate::integrals::SolvedFilm;
use crate::journal_state::JournalState;
use crate::linear::Lanes;
use crate::reynolds::Cell;

/// Torques that resist the sliding, N m.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Friction {
    /// Viscous, on the journal.
    pub journal: f64,
    /// Viscous, on the shell.
    pub shell: f64,
    /// Of asperities that touch, on both.
    pub boundary: f64,
}

impl SolvedFilm<'_> {
    /// Torques on journal and shell.
    #[must_use]
    pub fn friction(&self, state: &JournalState) -> Friction {
        let (shear, drag) = (self.shear_torques(state), self.pressure_torque());
        Friction {
            journal: shear[0] + drag,
            shell: shear[1] - drag,
            boundary: self.boundary_torque(state),
        }
    }

    /// Torque of the shear by sliding on journal and shell, N m.
    fn shear_torques(&self, state: &JournalState) -> [f64; 2] {
        let (mut mean, mut difference) = (0.0, 0.0);
        for k in 0..self.pressure.len() {
            let [stress, unlike] = self.shear_per_sliding(k);
            mean += stress;
            difference += unlike;
        }
        let unit = self.shear_torque_unit() * (state.journal_speed - state.shell_speed);
        [unit * (mean - difference), unit * (mean + difference)]
    }

    /// N m per 1/s of sliding: eta R^2 area / c.
    fn shear_torque_unit(&self) -> f64 {
        let units = &self.units;
        units.viscosity * units.radius.powi(2) * units.area / units.clearance
    }

    /// Shear of a cell's area by sliding: mean of both walls, and half of what they differ by.
    fn shear_per_sliding(&self, cell: usize) -> [f64; 2] {
        // A groove is deep: its shear is negligible beside that of the lands.
        if self.set.cells[cell] == Cell::Fed {
            return [0.0; 2];
        }
        let share = match self.bearing.film_shear {
            FilmShear::FullWidth => 1.0,
            FilmShear::FilmFraction => self.wetted_share(cell),
        };
        let m = self.grid.n_axial();
        let weight = share * self.viscosity_ratio(cell) * self.grid.area(cell / m, cell % m);
        match self.passage {
            Some(passage) => passage.shearing[cell].map(|per_height| weight * per_height),
            None => [weight / self.gap.mean[cell], 0.0],
        }
    }

    /// Viscosity of a cell over that of the units.
    fn viscosity_ratio(&self, cell: usize) -> f64 {
        let warm = self.passage.map_or(1.0, |passage| passage.viscosity[cell]);
        warm * self.thickening(cell)
    }

    /// Power that sliding shears a cell with, W.
    #[must_use]
    pub fn shear_power(&self, cell: usize, sliding: f64) -> f64 {
        self.shear_torque_unit() * sliding * sliding * self.shear_per_sliding(cell)[0]
    }

    /// Liquid in a cell over its mean gap. The film fraction of a ruptured cell belongs to the gap at
    /// the face it drains through; taken with the mean gap it would be a first-order error.
    fn wetted_share(&self, cell: usize) -> f64 {
        let theta = self.film_fraction[cell];
        let flow = self.operator.mean_speed;
        if theta >= 1.0 || flow == 0.0 {
            return theta;
        }
        let face = if flow > 0.0 {
            cell + self.grid.n_axial()
        } else {
            cell
        };
        (theta * self.gap.around_transport[face] / self.gap.mean[cell]).min(1.0)
    }

    /// `R int phi_fp (h/2) dp/dx dA`, N m.
    fn pressure_torque(&self) -> f64 {
        let (n, m) = (self.grid.n_around(), self.grid.n_axial());
        let mut sum = 0.0;
        let is_ring = self.operator.west(0, 0).is_some();
        // A periodic ring meets its first face twice: as face 0 and as face n.
        for i in 0..if is_ring { n } else { n + 1 } {
            for j in 0..m {
                let face = i * m + j;
                let before = match i {
                    0 => self.operator.west(0, j),
                    _ => Some(face - m),
                };
                let behind = (i < n).then_some(face);
                let height = match self.passage {
                    Some(passage) => passage.pressing[face] * passage.height_around[face],
                    None => self.gap.around_transport[face],
                };
                let rise = self.loading_beside(behind, 1) - self.loading_beside(before, 0);
                sum += height * rise * self.grid.axial_widths[j];
            }
        }
        0.5 * sum * self.units.clearance * self.units.pressure * self.units.area
    }

    /// Contact pressure of a cell, 1/s.
    fn contact(&self, cell: usize) -> [f64; 2] {
        match (self.contact.get(cell), self.set.cells[cell]) {
            // Asperities do not reach the ground of a groove.
            (Some(_), Cell::Fed) | (None, _) => [0.0; 2],
            (Some(contact), _) => *contact,
        }
    }

    /// Torque of asperities that touch, in the sense of the viscous one, N m.
    fn boundary_torque(&self, state: &JournalState) -> f64 {
        let Finish::Rough(rough) = &self.bearing.finish else {
            return 0.0;
        };
        let sliding = state.journal_speed - state.shell_speed;
        if self.contact.is_empty() || sliding == 0.0 {
            return 0.0;
        }
        rough.boundary_friction * self.units.radius * self.contact_load() * sliding.signum()
    }

    /// `int p_c dA`, N.
    #[must_use]
    pub fn contact_load(&self) -> f64 {
        let m = self.grid.n_axial();
        let cells = 0..self.contact.len();
        let sum: f64 = cells
            .map(|k| self.contact(k)[0] * self.grid.area(k / m, k % m))
            .sum();
        sum * self.units.pressure * self.units.area
    }

    /// Force (N) and moment (N m) of contact on the journal.
    pub(crate) fn contact_reaction(&self) -> ([f64; 2], [f64; 2]) {
        let mut sums = [0.0; 4];
        for k in 0..self.contact.len() {
            let pressure = self.contact(k)[0];
            if pressure > 0.0 {
                for (sum, weight) in sums.iter_mut().zip(self.output_weight::<4>(k)) {
                    *sum += pressure * weight;
                }
            }
        }
        let force = self.units.pressure * self.units.area;
        let moment = force * self.units.radius;
        (
            [sums[0] * force, sums[1] * force],
            [sums[2] * moment, sums[3] * moment],
        )
    }

    /// Derivative of force and moment of contact per rise of H in a cell, the outputs' unit.
    pub(crate) fn contact_by_height<const L: usize>(&self, cell: usize) -> Option<Lanes<L>> {
        let [_, slope] = self.contact(cell);
        (slope != 0.0).then(|| self.output_weight(cell).map(|weight| weight * slope))
    }

    /// Largest contact pressure, Pa, and where.
    #[must_use]
    pub fn peak_contact(&self) -> Extreme {
        let m = self.grid.n_axial();
        let cells = 0..self.contact.len();
        let highest = cells.max_by(|&a, &b| self.contact(a)[0].total_cmp(&self.contact(b)[0]));
        highest.map_or_else(Extreme::default, |k| Extreme {
            value: self.contact(k)[0] * self.units.pressure,
            angle: self.grid.around[k / m],
            axial: self.grid.axial[k % m] * self.units.radius,
        })
    }
}
