//! What does a film put on its journal, solved while the journal moves, without a grid of cells?
//!
//! The pressure of a plain bearing whose ends lie at cavitation pressure, in shapes across the width
//! and nodes around that follow the line of centres: some microseconds for force and exact tangents,
//! where a grid takes a millisecond. Wedge and squeeze enter as the one effective velocity `w = velocity -
//! mean speed x eccentricity`, so that nothing is added that was cut before.
//! Friction: shear of a full film over the whole width, `eta R U_s/h` integrated; the pressure part
//! `+-(h/2) dp/dx` integrates by parts to half the couple `e x F`.
//! Limits: cylinders, smooth and rigid; isoviscous; no feeds; ambient and cavitation pressure 0.
//! Errors of the force over its size: see [`OnlineFilm::aligned`].
//! References: numerics of the closure `gumbel` in `half_film`, of `reynolds` in `fitted_film`; friction: O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication, 1961, ch. 3.

use super::aligned_film::{AlignedFilm, Precision};
use crate::bearing::{Bearing, Inlet};
use crate::elastic::Elasticity;
use crate::finish::Finish;
use crate::force::{
    Capabilities, Conditions, Extreme, FilmError, FilmForce, FilmSummary, Linearised, Outcome,
    Reaction, Step, Tangent,
};
use crate::frame::{Frame, rotate};
use crate::integrals::Units;
use crate::journal_state::JournalState;
use crate::narrowest::GapSearch;
use sommerfeld_oil::{CompressionLaw, Lubricant, PressureLaw, ShearThinning};
use std::f64::consts::TAU;

/// Below this relative eccentricity the line of centres has no direction that derivatives could be
/// divided by.
const CENTRED: f64 = 1e-7;

/// A film solved on line: the [`FilmForce`] for many calls in little time.
#[derive(Debug, Clone)]
pub struct OnlineFilm {
    bearing: Bearing,
    lubricant: Lubricant,
    search: GapSearch,
    kernel: AlignedFilm,
    last: Option<Seen>,
    updates: usize,
}

/// What was last linearised.
#[derive(Debug, Clone)]
struct Seen {
    state: JournalState,
    reaction: Reaction,
    units: Units,
    density: f64,
    /// Angle of the frame that the film was solved in.
    turned: f64,
}

impl OnlineFilm {
    /// Film of an aligned journal; it refuses tilt.
    ///
    /// For B/D from 0.25 to 1.5 and all directions of motion the force is, by its size, within
    /// - closure `gumbel`: 4e-5 up to a relative eccentricity of 0.95, 1.5e-4 up to 0.99; its derivatives
    ///   are those of the discrete force;
    /// - closure `reynolds`: 2e-4 up to 0.95, 3e-4 up to 0.99; its derivatives leave the fronts that bound
    ///   the film where they are and are within 1e-3 of force over gap, and of force over motion.
    ///
    /// (`film/tests/online.rs`)
    ///
    /// # Errors
    /// [`FilmError::Unsupported`] names what this film does not have: feeds, profiles, roughness, an
    /// elastic shell, pressures other than 0 at ends and in the ruptured film, oils that depend on
    /// pressure or shear, other closures and inlets.
    pub fn aligned(bearing: &Bearing, lubricant: &Lubricant) -> Result<Self, FilmError> {
        check_bearing(bearing)?;
        check_lubricant(lubricant)?;
        let width_ratio = bearing.width / bearing.diameter;
        let kernel = AlignedFilm::new(bearing.cavitation, width_ratio, Precision::OnLine)?;
        Ok(Self {
            bearing: bearing.clone(),
            lubricant: lubricant.clone(),
            search: GapSearch::of(bearing),
            kernel,
            last: None,
            updates: 0,
        })
    }

    /// The bearing that is solved.
    #[must_use]
    pub fn bearing(&self) -> &Bearing {
        &self.bearing
    }

    fn check(&self, state: &JournalState) -> Result<(), FilmError> {
        for (name, values) in [
            ("position", state.position),
            ("velocity", state.velocity),
            ("tilt", state.tilt),
            ("tilt rate", state.tilt_rate),
            ("speed", [state.journal_speed, state.shell_speed]),
        ] {
            if !values.iter().all(|value| value.is_finite()) {
                return Err(FilmError::NotFinite { name });
            }
        }
        if (state.tilt, state.tilt_rate) != ([0.0; 2], [0.0; 2]) {
            return Err(FilmError::NoTilt);
        }
        let gap = self.minimum_gap(state);
        if gap > 0.0 {
            return Ok(());
        }
        Err(FilmError::Contact {
            angle_deg: state.line_of_centres_angle().to_degrees(),
            axial_mm: 0.0,
            gap_um: 1e6 * gap,
        })
    }

    /// Force (N) and its tangent in the frame of the line of centres.
    fn film_force(
        &mut self,
        local: &JournalState,
        units: &Units,
    ) -> Result<([f64; 2], Tangent, Outcome), FilmError> {
        let c = units.clearance;
        let eps = local.position[0] / c;
        let speed = local.mean_speed();
        let motion = [local.velocity[0] / c, local.velocity[1] / c - speed * eps];
        let unit = units.pressure * units.area * self.bearing.width / self.bearing.diameter;
        let (found, outcome) = self.kernel.force(eps, motion)?;
        let mut tangent = Tangent::default();
        for row in 0..2 {
            let by_motion = found.by_motion[row];
            tangent.by_rate[row][0] = unit / c * by_motion[0];
            tangent.by_rate[row][1] = unit / c * by_motion[1];
            tangent.by_position[row][0] =
                unit / c * (found.by_eccentricity[row] - speed * by_motion[1]);
        }
        if eps < CENTRED {
            // Away from the centre across the frame is along it in a frame turned by a quarter.
            let quarter = rotate(motion, -0.5 * std::f64::consts::PI);
            let (turned, _) = self.kernel.force(eps, quarter)?;
            let [along, across] = turned.by_eccentricity;
            for (row, slope) in [-across, along].into_iter().enumerate() {
                tangent.by_position[row][1] = unit / c * (slope + speed * found.by_motion[row][0]);
            }
            // The film that figures are asked of is that of the first frame.
            self.kernel.force(eps, motion)?;
        }
        Ok((found.force.map(|force| unit * force), tangent, outcome))
    }

    /// Torque of full shear, N m, and half the couple of force and eccentricity.
    fn torques(&self, state: &JournalState, force: [f64; 2], units: &Units) -> [f64; 2] {
        let eps = state.eccentricity() / units.clearance;
        let root = ((1.0 - eps) * (1.0 + eps)).sqrt();
        let sliding = state.journal_speed - state.shell_speed;
        let shear = TAU * units.viscosity * units.radius.powi(3) * self.bearing.width * sliding
            / (units.clearance * root);
        let [x, y] = state.position;
        let half_couple = 0.5 * (x * force[1] - y * force[0]);
        [shear + half_couple, shear - half_couple]
    }
}

impl FilmForce for OnlineFilm {
    fn capabilities(&self) -> Capabilities {
        Capabilities {
            accepts_tilt: false,
            has_history: false,
            conserves_mass: false,
            iteration_limit: 1,
        }
    }

    fn minimum_gap(&self, state: &JournalState) -> f64 {
        self.bearing.radial_clearance - state.eccentricity()
    }

    fn linearise(
        &mut self,
        state: &JournalState,
        _step: Step,
        conditions: &Conditions<'_>,
    ) -> Result<Linearised, FilmError> {
        self.check(state)?;
        let temperature = conditions.temperature;
        let viscosity = self.lubricant.viscosity(temperature, 0.0).value;
        if !(viscosity.is_finite() && viscosity > 0.0) {
            return Err(FilmError::NotFinite { name: "viscosity" });
        }
        let units = Units::of(&self.bearing, viscosity);
        // A journal in the centre has no line of centres: the shell frame serves as well.
        let is_centred = state.eccentricity() < CENTRED * units.clearance;
        let turned = if is_centred {
            0.0
        } else {
            state.line_of_centres_angle()
        };
        let local = if is_centred {
            JournalState {
                position: [0.0; 2],
                ..*state
            }
        } else {
            Frame::LineOfCentres.to_grid(state, turned)
        };
        let (force, tangent, outcome) = self.film_force(&local, &units)?;
        let reaction = Reaction {
            film_force: force,
            ..Reaction::default()
        };
        let (mut reaction, tangent) =
            Frame::LineOfCentres.from_grid(&local, turned, reaction, tangent);
        let [journal, shell] = self.torques(state, reaction.film_force, &units);
        reaction.friction_torque_journal = journal;
        reaction.friction_torque_shell = shell;
        self.updates += 1;
        self.last = Some(Seen {
            state: *state,
            reaction,
            units,
            density: self.lubricant.density(temperature, 0.0).value,
            turned,
        });
        Ok(Linearised {
            reaction,
            tangent,
            settled: true,
            outcome,
        })
    }

    fn summary(&self) -> FilmSummary {
        let Some(seen) = &self.last else {
            return FilmSummary::default();
        };
        let (state, reaction, units) = (&seen.state, &seen.reaction, &seen.units);
        let figures = self.kernel.figures();
        let sliding = state.journal_speed - state.shell_speed;
        let narrowest = self.search.narrowest(&self.bearing, state);
        let end_flow = units.flow * self.bearing.diameter / self.bearing.width * figures.end_flow;
        let turning = state.shell_speed;
        let velocity = [
            state.velocity[0] + turning * state.position[1],
            state.velocity[1] - turning * state.position[0],
        ];
        let [force_x, force_y] = reaction.film_force;
        FilmSummary {
            minimum_film_thickness: Extreme {
                value: narrowest.gap,
                angle: narrowest.angle,
                axial: narrowest.axial,
            },
            edge_film_thickness: self.search.at_edges(&self.bearing, state),
            peak_film_pressure: Extreme {
                value: units.pressure * figures.peak,
                angle: wrapped(seen.turned + figures.peak_angle),
                axial: 0.0,
            },
            side_flow: [end_flow; 2],
            // No feed brings what leaves at the ends: all of it is created.
            mass_balance_relative: if end_flow > 0.0 { 1.0 } else { 0.0 },
            friction_power: reaction.friction_torque_journal * sliding,
            squeeze_power: -(force_x * velocity[0] + force_y * velocity[1]),
            full_film_share: figures.full_film_share,
            iterations: self.updates,
            reynolds_number: seen.density * sliding.abs() * units.radius * units.clearance
                / units.viscosity,
            ..FilmSummary::default()
        }
    }

    fn accept_step(&mut self) {
        self.updates = 0;
    }

    fn reject_step(&mut self) {
        self.updates = 0;
    }
}

/// Angle within (-pi, pi].
fn wrapped(angle: f64) -> f64 {
    angle - (angle / TAU).round() * TAU
}

/// Refuses what an on-line film does not have.
fn check_bearing(bearing: &Bearing) -> Result<(), FilmError> {
    let sizes = [bearing.diameter, bearing.width, bearing.radial_clearance];
    let refused = if sizes.iter().any(|size| !(size.is_finite() && *size > 0.0)) {
        "diameter, width and clearance of an on-line film must be positive"
    } else if !bearing.is_plain() {
        "an on-line film has cylinders, no profiles of bore or journal: use model = \"field\""
    } else if !bearing.feeds.is_empty() {
        "an on-line film has no grooves and holes: use model = \"field\""
    } else if bearing.ambient_pressure != 0.0 || bearing.cavitation_pressure != 0.0 {
        "an on-line film needs ambient and cavitation pressure 0: use model = \"field\""
    } else if bearing.inlet != Inlet::Cyclic {
        "an on-line film needs inlet = \"cyclic\": use model = \"field\""
    } else if bearing.finish != Finish::Smooth {
        "an on-line film has smooth surfaces: use model = \"field\""
    } else if bearing.elasticity != Elasticity::Rigid {
        "an on-line film has a rigid shell: use model = \"field\""
    } else {
        return Ok(());
    };
    Err(FilmError::Unsupported { reason: refused })
}

/// Refuses oils that are not the same everywhere.
fn check_lubricant(lubricant: &Lubricant) -> Result<(), FilmError> {
    let refused = if lubricant.viscosity_pressure != PressureLaw::None {
        "an on-line film is isoviscous: an oil that thickens under pressure needs model = \"field\""
    } else if lubricant.shear_thinning != ShearThinning::None {
        "an on-line film is isoviscous: an oil that thins with shear needs model = \"field\""
    } else if lubricant.density_pressure != CompressionLaw::None {
        "an on-line film is incompressible: an oil that is compressed needs model = \"field\""
    } else {
        return Ok(());
    };
    Err(FilmError::Unsupported { reason: refused })
}
