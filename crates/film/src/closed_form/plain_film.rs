//! What every closed-form film of a plain aligned bearing shares: data, checks, friction, summary.
//!
//! Friction of the full width: shear `eta U/h` integrated around, `2 pi eta R^3 B (relative
//! speed)/(c sqrt(1 - eps^2))`, plus the pressure part `+-(h/2) dp/dx`, which integrates by parts to
//! half the couple `e x F` (physics: torque difference of both surfaces = force couple).
//! Reference: O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication, 1961, ch. 3.

use crate::{
    Bearing, Capabilities, Extreme, FilmError, FilmShear, FilmSummary, JournalState, Linearised,
    Outcome, Reaction, Tangent,
};
use std::f64::consts::TAU;

/// Dimensions and viscosity of a plain aligned film.
#[derive(Debug, Clone)]
pub struct PlainFilm {
    /// Bore radius, m.
    pub radius: f64,
    /// Bearing width, m.
    pub width: f64,
    /// Radial clearance, m.
    pub clearance: f64,
    /// Viscosity, Pa s.
    pub viscosity: f64,
    /// The last state with its reaction, for the summary.
    last: Option<(JournalState, Reaction)>,
    updates: usize,
}

impl PlainFilm {
    /// Film of `bearing` at one viscosity [Pa s].
    ///
    /// # Errors
    /// [`FilmError::Unsupported`] for sizes that are not positive, unequal ambient and cavitation
    /// pressure, surfaces that are no cylinders, or film shear other than full width.
    pub fn new(bearing: &Bearing, viscosity: f64) -> Result<Self, FilmError> {
        let sizes = [
            bearing.diameter,
            bearing.width,
            bearing.radial_clearance,
            viscosity,
        ];
        if sizes.iter().any(|size| !(size.is_finite() && *size > 0.0)) {
            return Err(FilmError::Unsupported {
                reason: "diameter, width, clearance and viscosity of a closed-form film must be positive",
            });
        }
        if bearing.ambient_pressure != bearing.cavitation_pressure {
            return Err(FilmError::Unsupported {
                reason: "closed-form films need equal ambient and cavitation pressure: use model = \"field\"",
            });
        }
        if !bearing.is_plain() {
            return Err(FilmError::Unsupported {
                reason: "closed-form films are those of a cylindrical bore and journal: use model = \"field\"",
            });
        }
        if bearing.film_shear != FilmShear::FullWidth {
            return Err(FilmError::Unsupported {
                reason: "closed-form films shear over the full width: use film_shear = \"full-width\"",
            });
        }
        Ok(Self {
            radius: bearing.radius(),
            width: bearing.width,
            clearance: bearing.radial_clearance,
            viscosity,
            last: None,
            updates: 0,
        })
    }

    /// What these films can do.
    #[must_use]
    pub fn capabilities() -> Capabilities {
        Capabilities {
            accepts_tilt: false,
            has_history: false,
            conserves_mass: false,
            iteration_limit: 1,
        }
    }

    /// Smallest gap, m; negative where the surfaces overlap.
    #[must_use]
    pub fn minimum_gap(&self, state: &JournalState) -> f64 {
        self.clearance - distance(state)
    }

    /// Refuses states these films cannot have.
    ///
    /// # Errors
    /// [`FilmError`] for values that are not finite, tilt, and a closed gap.
    #[inline]
    pub fn check(&self, state: &JournalState) -> Result<(), FilmError> {
        let values = [
            ("position", state.position[0] + state.position[1]),
            ("velocity", state.velocity[0] + state.velocity[1]),
            ("speed", state.journal_speed + state.shell_speed),
        ];
        if let Some((name, _)) = values.iter().find(|(_, value)| !value.is_finite()) {
            return Err(FilmError::NotFinite { name });
        }
        if state.tilt != [0.0; 2] || state.tilt_rate != [0.0; 2] {
            return Err(FilmError::NoTilt);
        }
        let gap = self.minimum_gap(state);
        if gap <= 0.0 {
            return Err(FilmError::Contact {
                angle_deg: state.line_of_centres_angle().to_degrees(),
                axial_mm: 0.0,
                gap_um: gap * 1e6,
            });
        }
        Ok(())
    }

    /// Velocity of the journal centre relative to the oil that both surfaces drag along, m/s: wedge
    /// and squeeze together, `velocity - mean speed x eccentricity`.
    #[inline]
    #[must_use]
    pub fn effective_velocity(state: &JournalState) -> [f64; 2] {
        let speed = state.mean_speed();
        [
            state.velocity[0] + speed * state.position[1],
            state.velocity[1] - speed * state.position[0],
        ]
    }

    /// Completes a force and its tangents by position (at fixed effective velocity) and by effective
    /// velocity to the film's answer, and remembers it for the summary.
    #[inline]
    pub fn answer(
        &mut self,
        state: &JournalState,
        force: [f64; 2],
        by_position: [[f64; 2]; 2],
        by_velocity: [[f64; 2]; 2],
    ) -> Linearised {
        let speed = state.mean_speed();
        let mut tangent = Tangent::default();
        for row in 0..2 {
            let [along_x, along_y] = by_velocity[row];
            tangent.by_rate[row][0] = along_x;
            tangent.by_rate[row][1] = along_y;
            // The effective velocity turns with the position: d(wx)/dy = speed, d(wy)/dx = -speed.
            tangent.by_position[row][0] = by_position[row][0] - speed * along_y;
            tangent.by_position[row][1] = by_position[row][1] + speed * along_x;
        }
        let reaction = self.reaction(state, force);
        self.last = Some((*state, reaction));
        self.updates += 1;
        Linearised {
            reaction,
            tangent,
            settled: true,
            outcome: Outcome::Converged,
        }
    }

    #[inline]
    fn reaction(&self, state: &JournalState, force: [f64; 2]) -> Reaction {
        let eps = distance(state) / self.clearance;
        let root = ((1.0 - eps) * (1.0 + eps)).sqrt();
        let relative_speed = state.journal_speed - state.shell_speed;
        let shear = TAU * self.viscosity * self.radius.powi(3) * self.width * relative_speed
            / (self.clearance * root);
        let couple = cross(state.position, force);
        Reaction {
            film_force: force,
            friction_torque_journal: shear + 0.5 * couple,
            friction_torque_shell: shear - 0.5 * couple,
            ..Reaction::default()
        }
    }

    /// The state last answered.
    #[must_use]
    pub fn last_state(&self) -> Option<&JournalState> {
        self.last.as_ref().map(|(state, _)| state)
    }

    /// Counts updates from zero again.
    pub fn restart_count(&mut self) {
        self.updates = 0;
    }

    /// The summary of the last state with what only the model knows: peak pressure, outflow at each
    /// end (m3/s) and the share of the land under pressure. Feeds are not part of these films, so
    /// what leaves at the ends is counted as created. The density is not known, so that the Reynolds
    /// number stays 0.
    #[must_use]
    pub fn summary(&self, peak: Extreme, end_flow: f64, share: f64) -> FilmSummary {
        let Some((state, reaction)) = &self.last else {
            return FilmSummary::default();
        };
        let relative_speed = state.journal_speed - state.shell_speed;
        let [force_x, force_y] = reaction.film_force;
        let [velocity_x, velocity_y] = state.velocity;
        FilmSummary {
            minimum_film_thickness: Extreme {
                value: self.minimum_gap(state),
                angle: state.line_of_centres_angle(),
                axial: 0.0,
            },
            edge_film_thickness: [self.minimum_gap(state); 2],
            peak_film_pressure: peak,
            side_flow: [end_flow; 2],
            mass_balance_relative: if end_flow > 0.0 { 1.0 } else { 0.0 },
            friction_power: reaction.friction_torque_journal * relative_speed,
            squeeze_power: -(force_x * velocity_x + force_y * velocity_y),
            full_film_share: share,
            iterations: self.updates,
            ..FilmSummary::default()
        }
    }
}

/// Distance from the shell centre, m, without the care of `hypot` for numbers whose squares leave the range.
#[inline]
fn distance(state: &JournalState) -> f64 {
    let [x, y] = state.position;
    (x * x + y * y).sqrt()
}

/// z component of the cross product.
pub(super) fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
