//! What does a film put on its journal, solved while the journal moves, without a grid of cells?
//!
//! The pressure of a plain bearing whose ends lie at cavitation pressure, in shapes across the width
//! and nodes around that follow the line of centres: some microseconds for force and exact tangents,
//! where a grid takes a millisecond. Wedge and squeeze enter as the one effective velocity `w = velocity -
//! mean speed x eccentricity`, so that nothing is added that was cut before.
//! Friction: shear of a full film over the whole width, `eta R U_s/h` integrated; the pressure part
//! `+-(h/2) dp/dx` integrates by parts to half the couple `e x F`.
//! Limits: cylinders, smooth and rigid; isoviscous; no feeds; ambient and cavitation pressure 0.
//! Errors of the force over its size: see [`OnlineFilm::aligned`] and [`OnlineFilm::new`].
//! References: numerics of the closure `gumbel` in `half_film`, with tilt in `tilted_film`, of `reynolds` in `fitted_film`; friction: O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication, 1961, ch. 3.

use super::aligned_film::{AlignedFilm, Precision};
use super::answer::FilmFigures;
use super::tilting::TiltingFilm;
use crate::bearing::{Bearing, Cavitation, Inlet};
use crate::elastic::Elasticity;
use crate::finish::Finish;
use crate::force::{
    Capabilities, Conditions, Extreme, FilmError, FilmForce, FilmSummary, Linearised, Outcome,
    Reaction, Step, Tangent,
};
use crate::frame::rotate;
use crate::integrals::Units;
use crate::journal_state::JournalState;
use crate::narrowest::GapSearch;
use sommerfeld_oil::{CompressionLaw, Lubricant, PressureLaw, ShearThinning};
use std::f64::consts::TAU;

/// Below this relative eccentricity the line of centres has no direction that derivatives could be
/// divided by.
const CENTRED: f64 = 1e-7;

/// Largest width over diameter of a film between fronts: in a wider one, lines across the width may stay
/// without rupture as the gap opens.
const WIDEST: f64 = 2.0;

/// A film solved on line: the [`FilmForce`] for many calls in little time.
#[derive(Debug, Clone)]
pub struct OnlineFilm {
    bearing: Bearing,
    lubricant: Lubricant,
    search: GapSearch,
    kernel: Kernel,
    last: Option<Seen>,
    updates: usize,
}

/// The numerics.
#[derive(Debug, Clone)]
enum Kernel {
    Aligned(AlignedFilm),
    Tilting(TiltingFilm),
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

/// Force, moment, tangent and outcome, with the angle of the frame that the film was solved in.
type Solved = (Reaction, Tangent, Outcome, f64);

impl OnlineFilm {
    /// Film of a journal that may tilt, closure `gumbel`.
    ///
    /// For B/D from 0.25 to 1.5 force and moment are within 8e-4 of the force, and of the force at half the
    /// width, while the smallest gap is 0.05 of the clearance or more, wherever the journal leans; within 5e-3
    /// down to 0.02. Up to B/D 0.75 it is 3e-4 and 5e-3. The derivatives are those of the discrete
    /// force. (`film/tests/online_tilted.rs`)
    ///
    /// # Errors
    /// As [`OnlineFilm::aligned`]; the closure `reynolds` has no tilt on line.
    pub fn new(bearing: &Bearing, lubricant: &Lubricant) -> Result<Self, FilmError> {
        if bearing.cavitation == Cavitation::Reynolds {
            return Err(FilmError::Unsupported {
                reason: "an on-line film of a journal that may tilt needs cavitation = \"gumbel\": use model = \"field\" \
                         for cavitation = \"reynolds\"",
            });
        }
        let aligned = Self::aligned(bearing, lubricant)?;
        Ok(Self {
            kernel: Kernel::Tilting(TiltingFilm::new(bearing.width / bearing.diameter)),
            ..aligned
        })
    }

    /// Film of an aligned journal; it refuses tilt.
    ///
    /// For B/D from 0.25 to 1.5 and all directions of motion the force is, by its size, within
    /// - closure `gumbel`: 4e-5 up to a relative eccentricity of 0.95, 1.5e-4 up to 0.99; its derivatives
    ///   are those of the discrete force;
    /// - closure `reynolds`: 6e-5 up to 0.95, 3e-4 up to 0.99; its derivatives are those of the discrete force
    ///   too, with the fronts that bound the film moving along: differences give the same to 1e-6 of force over
    ///   gap, and of force over motion, up to 0.99. Closer to contact
    ///   a front may not be found, which is [`Outcome::NotConverged`].
    ///
    /// (`film/tests/online.rs`)
    ///
    /// # Errors
    /// [`FilmError::Unsupported`] names what this film does not have: feeds, profiles, roughness, an
    /// elastic shell, pressures other than 0 at ends and in the ruptured film, oils that depend on
    /// pressure or shear, other closures and inlets; and a closure `reynolds` wider than two diameters.
    pub fn aligned(bearing: &Bearing, lubricant: &Lubricant) -> Result<Self, FilmError> {
        check_bearing(bearing)?;
        check_lubricant(lubricant)?;
        let width_ratio = bearing.width / bearing.diameter;
        if bearing.cavitation == Cavitation::Reynolds && width_ratio > WIDEST {
            return Err(FilmError::Unsupported {
                reason: "an on-line film with cavitation = \"reynolds\" is at most twice as wide as its diameter: \
                         use model = \"field\"",
            });
        }
        let kernel = AlignedFilm::new(bearing.cavitation, width_ratio, Precision::OnLine)?;
        Ok(Self {
            bearing: bearing.clone(),
            lubricant: lubricant.clone(),
            search: GapSearch::of(bearing),
            kernel: Kernel::Aligned(kernel),
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
        let is_tilted = (state.tilt, state.tilt_rate) != ([0.0; 2], [0.0; 2]);
        if is_tilted && matches!(self.kernel, Kernel::Aligned(_)) {
            return Err(FilmError::NoTilt);
        }
        if self.minimum_gap(state) > 0.0 {
            return Ok(());
        }
        let narrowest = self.search.narrowest(&self.bearing, state);
        Err(FilmError::Contact {
            angle_deg: narrowest.angle.to_degrees(),
            axial_mm: 1e3 * narrowest.axial,
            gap_um: 1e6 * narrowest.gap,
        })
    }

    /// The film of a state that was checked.
    fn solve(&mut self, state: &JournalState, units: &Units) -> Result<Solved, FilmError> {
        match &mut self.kernel {
            Kernel::Aligned(kernel) => aligned(kernel, &self.bearing, state, units),
            Kernel::Tilting(film) => {
                let (reaction, tangent, outcome) = film.solve(&self.bearing, state, units);
                Ok((reaction, tangent, outcome, 0.0))
            }
        }
    }

    /// Torque of full shear, N m, and half the couple of forces and centres.
    fn torques(&self, state: &JournalState, reaction: &Reaction, units: &Units) -> [f64; 2] {
        let half_width = 0.5 * self.bearing.width;
        let [front, rear] = [-half_width, half_width].map(|z| {
            let [x, y] = state.centre_at(z);
            let eps = x.hypot(y) / units.clearance;
            ((1.0 - eps) * (1.0 + eps)).sqrt()
        });
        // int dZ/sqrt(1 - c.c) over the width, with a centre c that moves on linearly.
        let slant = state.tilt[0].hypot(state.tilt[1]) * half_width / units.clearance;
        let mean = 2.0 / (front + rear);
        let across = if slant * mean < 1e-6 {
            2.0 * mean
        } else {
            2.0 * (slant * mean).atan() / slant
        };
        let sliding = state.journal_speed - state.shell_speed;
        let shear = TAU * units.viscosity * units.radius.powi(3) * half_width * sliding * across
            / units.clearance;
        let ([x, y], [tilt_x, tilt_y]) = (state.position, state.tilt);
        let ([force_x, force_y], [moment_x, moment_y]) =
            (reaction.film_force, reaction.film_moment);
        let couple = x * force_y - y * force_x + tilt_x * moment_y - tilt_y * moment_x;
        [shear + 0.5 * couple, shear - 0.5 * couple]
    }
}

impl FilmForce for OnlineFilm {
    fn capabilities(&self) -> Capabilities {
        Capabilities {
            accepts_tilt: matches!(self.kernel, Kernel::Tilting(_)),
            has_history: false,
            conserves_mass: false,
            iteration_limit: 1,
        }
    }

    fn minimum_gap(&self, state: &JournalState) -> f64 {
        let [front, rear] = self.search.at_edges(&self.bearing, state);
        front.min(rear)
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
        let (mut reaction, tangent, outcome, turned) = self.solve(state, &units)?;
        let [journal, shell] = self.torques(state, &reaction, &units);
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
        let sliding = state.journal_speed - state.shell_speed;
        let narrowest = self.search.narrowest(&self.bearing, state);
        let figures = match &self.kernel {
            Kernel::Aligned(kernel) => FilmFigures::from(kernel.figures()),
            Kernel::Tilting(film) => film.figures(),
        };
        let flow_unit = units.flow * self.bearing.diameter / self.bearing.width;
        let end_flow = figures.end_flow.map(|flow| flow_unit * flow);
        let turning = state.shell_speed;
        let power = |action: [f64; 2], rate: [f64; 2], of: [f64; 2]| {
            action[0] * (rate[0] + turning * of[1]) + action[1] * (rate[1] - turning * of[0])
        };
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
                axial: 0.5 * self.bearing.width * figures.peak_place,
            },
            side_flow: end_flow,
            // No feed brings what leaves at the ends: all of it is created.
            mass_balance_relative: if end_flow[0] + end_flow[1] > 0.0 {
                1.0
            } else {
                0.0
            },
            friction_power: reaction.friction_torque_journal * sliding,
            squeeze_power: -power(reaction.film_force, state.velocity, state.position)
                - power(reaction.film_moment, state.tilt_rate, state.tilt),
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

/// Reaction and tangent of an aligned film, in the shell frame.
fn aligned(
    kernel: &mut AlignedFilm,
    bearing: &Bearing,
    state: &JournalState,
    units: &Units,
) -> Result<Solved, FilmError> {
    // A journal in the centre has no line of centres: the shell frame serves as well.
    let eccentricity = state.eccentricity();
    if eccentricity < CENTRED * units.clearance {
        let local = JournalState {
            position: [0.0; 2],
            ..*state
        };
        let (force, tangent, outcome) = film_force(kernel, bearing, &local, units)?;
        return Ok((of_force(force), shell_tangent(&tangent), outcome, 0.0));
    }
    let direction = state.position.map(|part| part / eccentricity);
    let local = JournalState {
        position: [eccentricity, 0.0],
        velocity: turned_back(state.velocity, direction),
        ..*state
    };
    let (force, mut tangent, outcome) = film_force(kernel, bearing, &local, units)?;
    // Away from the line of centres the frame turns, and the film with it (`frame`).
    let [along, across] = local.velocity;
    for (row, own) in [-force[1], force[0]].into_iter().enumerate() {
        let rate = tangent.by_rate[row];
        tangent.by_position[row][1] = (own + rate[0] * across - rate[1] * along) / eccentricity;
    }
    let tangent = Planar {
        by_position: turned_matrix(&tangent.by_position, direction),
        by_rate: turned_matrix(&tangent.by_rate, direction),
    };
    let turned = state.line_of_centres_angle();
    Ok((
        of_force(turned_on(force, direction)),
        shell_tangent(&tangent),
        outcome,
        turned,
    ))
}

/// A tangent without tilt.
#[derive(Debug, Clone, Copy, Default)]
struct Planar {
    by_position: [[f64; 2]; 2],
    by_rate: [[f64; 2]; 2],
}

fn of_force(film_force: [f64; 2]) -> Reaction {
    Reaction {
        film_force,
        ..Reaction::default()
    }
}

fn shell_tangent(planar: &Planar) -> Tangent {
    let mut tangent = Tangent::default();
    for row in 0..2 {
        tangent.by_position[row][..2].copy_from_slice(&planar.by_position[row]);
        tangent.by_rate[row][..2].copy_from_slice(&planar.by_rate[row]);
    }
    tangent
}

/// A vector in the frame whose +X has this direction.
fn turned_back([x, y]: [f64; 2], [cos, sin]: [f64; 2]) -> [f64; 2] {
    [cos * x + sin * y, cos * y - sin * x]
}

/// A vector of that frame.
fn turned_on([x, y]: [f64; 2], [cos, sin]: [f64; 2]) -> [f64; 2] {
    [cos * x - sin * y, sin * x + cos * y]
}

/// A matrix of that frame.
fn turned_matrix(matrix: &[[f64; 2]; 2], direction: [f64; 2]) -> [[f64; 2]; 2] {
    let [x, y] = matrix.map(|row| turned_on(row, direction));
    let columns = [0, 1].map(|column: usize| turned_on([x[column], y[column]], direction));
    [0, 1].map(|row: usize| columns.map(|column| column[row]))
}

/// Force (N) and its tangent in the frame of the line of centres.
fn film_force(
    kernel: &mut AlignedFilm,
    bearing: &Bearing,
    local: &JournalState,
    units: &Units,
) -> Result<([f64; 2], Planar, Outcome), FilmError> {
    let c = units.clearance;
    let eps = local.position[0] / c;
    let speed = local.mean_speed();
    let motion = [local.velocity[0] / c, local.velocity[1] / c - speed * eps];
    let unit = units.pressure * units.area * bearing.width / bearing.diameter;
    let (found, outcome) = kernel.force(eps, motion)?;
    let mut tangent = Planar::default();
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
        let (turned, _) = kernel.force(eps, quarter)?;
        let [along, across] = turned.by_eccentricity;
        for (row, slope) in [-across, along].into_iter().enumerate() {
            tangent.by_position[row][1] = unit / c * (slope + speed * found.by_motion[row][0]);
        }
        // The film that figures are asked of is that of the first frame.
        kernel.force(eps, motion)?;
    }
    Ok((found.force.map(|force| unit * force), tangent, outcome))
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
