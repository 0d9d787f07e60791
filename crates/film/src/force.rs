//! The waist of the house: journal state in, the film's reaction and its tangents out.
//!
//! Equilibrium, orbit, coefficients and engine see a film only through [`FilmForce`]. Its core is
//! ONE update of the film at the given state, not a full solve: a caller with a Newton iteration of
//! its own interleaves film and journal updates and pays one factorisation for both. Closed forms
//! and tables are settled at once.

use crate::JournalState;
use crate::energy::{EnergyBalance, Surroundings};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A model of the film of one bearing.
pub trait FilmForce {
    /// What this model can do; callers adapt to it instead of matching on names.
    fn capabilities(&self) -> Capabilities;

    /// Smallest gap at this state, m; negative where the surfaces overlap. Callers keep their steps
    /// where it stays positive.
    fn minimum_gap(&self, state: &JournalState) -> f64;

    /// One update of the film at `state`: the reaction for the present cavitated set with its exact
    /// tangents at that set, then a new set. `settled` tells that the set did not change, so that
    /// reaction, tangent and fields are those of the state.
    ///
    /// # Errors
    /// [`FilmError`] where the state is not one this film can have (closed gap, tilt for a model
    /// without tilt).
    fn linearise(
        &mut self,
        state: &JournalState,
        step: Step,
        conditions: &Conditions<'_>,
    ) -> Result<Linearised, FilmError>;

    /// Iterates [`FilmForce::linearise`] at a fixed state until it is settled. The outcome is
    /// [`Outcome::NotConverged`] if it does not settle within the model's own limit.
    ///
    /// # Errors
    /// As [`FilmForce::linearise`].
    fn react(
        &mut self,
        state: &JournalState,
        step: Step,
        conditions: &Conditions<'_>,
    ) -> Result<Linearised, FilmError> {
        let (seen, _) = settled(self, state, step, conditions)?;
        Ok(seen)
    }

    /// [`FilmForce::react`] for a caller that asks for no tangent, which may be zero: fields and summary
    /// of the settled film, with the number of updates it took.
    ///
    /// # Errors
    /// As [`FilmForce::linearise`].
    fn look(
        &mut self,
        state: &JournalState,
        step: Step,
        conditions: &Conditions<'_>,
    ) -> Result<(Linearised, usize), FilmError> {
        settled(self, state, step, conditions)
    }

    /// Integrals, extremes, flows and power of the film as last linearised.
    fn summary(&self) -> FilmSummary;

    /// Flow into the film through each feed of the bearing, in the order of [`crate::Bearing::feeds`],
    /// as last linearised. Empty for models without feeds.
    fn feed_flows(&self) -> &[FeedFlow] {
        &[]
    }

    /// The fields as last linearised; `None` for models without fields.
    fn field(&self) -> Option<FilmField<'_>> {
        None
    }

    /// Counts the film as last linearised for a time (s) in the account of its heat. Nothing for models
    /// without a field of temperature.
    fn account_heat(&mut self, _duration: f64) {}

    /// The temperatures that the account of the film's heat leads to, with the heat as it was made or, if
    /// `foresees`, as it will be there; both agree where the film has these temperatures. `None` for models
    /// without a field of temperature, and where heat has no way out.
    fn led_to(&mut self, _surroundings: &Surroundings<'_>, _foresees: bool) -> Option<Warming> {
        None
    }

    /// Gives the film temperatures (K) for each of the cells of [`Warming`], and begins a new account.
    fn warm(&mut self, _cells: &[f64]) {}

    /// The same film on a coarser grid, for callers that bring it to rest first; `None` for films without.
    fn coarser(&mut self) -> Option<&mut dyn FilmForce> {
        None
    }

    /// Begins with what the coarser film found: its cavitated set and temperatures.
    fn take_over(&mut self) {}

    /// The last implicit step becomes history: the next one starts from its film content.
    fn accept_step(&mut self) {}

    /// Forgets the last implicit step: the next one starts again from the accepted history.
    fn reject_step(&mut self) {}

    /// The film's memory, to resume or to repeat a cycle. Empty for models without history.
    fn history(&self) -> FilmHistory {
        FilmHistory::default()
    }

    /// The film's memory at the state last linearised, within an implicit step too: from there the
    /// film can be looked at again ([`FilmForce::restore`]) without the step that led to it.
    fn instant(&self) -> FilmHistory {
        FilmHistory::default()
    }

    /// Puts back a memory taken by [`FilmForce::history`] of the same model.
    fn restore(&mut self, _history: &FilmHistory) {}
}

/// Iterates [`FilmForce::linearise`] at a fixed state until it is settled; with the number of updates.
fn settled<F: FilmForce + ?Sized>(
    film: &mut F,
    state: &JournalState,
    step: Step,
    conditions: &Conditions<'_>,
) -> Result<(Linearised, usize), FilmError> {
    let limit = film.capabilities().iteration_limit;
    let mut updates = 1;
    let mut seen = film.linearise(state, step, conditions)?;
    while !seen.settled && seen.outcome == Outcome::Converged && updates < limit {
        seen = film.linearise(state, step, conditions)?;
        updates += 1;
    }
    if !seen.settled && seen.outcome == Outcome::Converged {
        seen.outcome = Outcome::NotConverged;
    }
    Ok((seen, updates))
}

/// What the account of a film's heat leads to.
#[derive(Debug, Clone, PartialEq)]
pub struct Warming {
    /// Temperatures of the cells, K: those at which the heat was made.
    pub from: Vec<f64>,
    /// Temperatures that it leads to, K.
    pub led_to: Vec<f64>,
    /// What there is to say of them.
    pub warmed: Warmed,
}

/// The temperatures of a film, in short.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Warmed {
    /// Largest difference of a cell to what the account leads to, K.
    pub change: f64,
    /// Highest temperature of the film, K.
    pub hottest: f64,
    /// Mean over the film, K.
    pub mean: f64,
    /// Mean by flow of the oil that leaves at the ends, K.
    pub outlet: f64,
    /// Where the heat goes.
    pub balance: EnergyBalance,
}

/// What a film model can do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capabilities {
    /// It answers to tilt and tilt rates.
    pub accepts_tilt: bool,
    /// Its answer depends on the film content of the past: steps must be accepted or rejected.
    pub has_history: bool,
    /// It conserves oil, so flows balance.
    pub conserves_mass: bool,
    /// More updates than this at one state mean that it does not settle.
    pub iteration_limit: usize,
}

/// How time enters an update.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// Nothing is stored: squeeze from the given velocities, film content constant in time.
    Steady,
    /// Implicit step of the film content from the accepted history, with the gap moving at the
    /// state's velocity throughout. The state is the one `after` before the END of the step: 0 is
    /// backward Euler; half the duration, the state in the middle, is of second order for pressure
    /// and journal while the film fraction keeps its bounds.
    Implicit {
        /// Length of the step, s.
        duration: f64,
        /// Time from the state to the end of the step, s; from 0 to the duration.
        after: f64,
    },
}

/// What surrounds the film at this instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conditions<'a> {
    /// Temperature of the film, K.
    pub temperature: f64,
    /// Gauge pressure of each feed, Pa, where it differs from the bearing's own.
    pub feed_pressures: Option<&'a [f64]>,
}

/// How a calculation ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Solved to its tolerance.
    Converged,
    /// The iteration stopped at its limit; the number printed is the last iterate.
    NotConverged,
    /// No oil can reach the film, so that it carries no load.
    Starved,
    /// No film solution exists at this position.
    NoSolution,
}

/// Result of one update of the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linearised {
    /// What the film puts on the journal.
    pub reaction: Reaction,
    /// Its derivatives for the cavitated set of this update.
    pub tangent: Tangent,
    /// The cavitated set did not change in this update.
    pub settled: bool,
    /// Anything but [`Outcome::Converged`] ends the caller's iteration.
    pub outcome: Outcome,
}

impl Linearised {
    /// The answer of a film that is not there.
    #[must_use]
    pub fn without_film(outcome: Outcome) -> Self {
        Self {
            reaction: Reaction::default(),
            tangent: Tangent::default(),
            settled: true,
            outcome,
        }
    }
}

/// What film and contact put on the journal, shell frame, moments about the mid-plane shell centre.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Reaction {
    /// Force of the film, N.
    pub film_force: [f64; 2],
    /// Force of asperity contact, N.
    pub contact_force: [f64; 2],
    /// Moment of the film, N m.
    pub film_moment: [f64; 2],
    /// Moment of asperity contact, N m.
    pub contact_moment: [f64; 2],
    /// Torque of the shear that resists the journal's rotation, N m.
    pub friction_torque_journal: f64,
    /// Torque of the shear that drags the shell along, N m.
    pub friction_torque_shell: f64,
}

impl Reaction {
    /// Film and contact force together, N.
    #[must_use]
    pub fn force(&self) -> [f64; 2] {
        [
            self.film_force[0] + self.contact_force[0],
            self.film_force[1] + self.contact_force[1],
        ]
    }

    /// Film and contact moment together, N m.
    #[must_use]
    pub fn moment(&self) -> [f64; 2] {
        [
            self.film_moment[0] + self.contact_moment[0],
            self.film_moment[1] + self.contact_moment[1],
        ]
    }
}

/// Derivatives of the reaction: rows force x, force y, moment x, moment y (N, N m); columns x, y
/// (m), tilt x, tilt y (rad), or their rates.
///
/// In an implicit step of a film with history the squeeze is in the change of position, so
/// `by_position` holds it and `by_rate` only what the motion after the state adds; with the velocity
/// `(position - old position) / (duration - after)` the total derivative with respect to the
/// position is `by_position + by_rate / (duration - after)` for every model.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Tangent {
    /// With respect to position and tilt.
    pub by_position: [[f64; 4]; 4],
    /// With respect to velocity and tilt rate.
    pub by_rate: [[f64; 4]; 4],
}

/// A value with its place on the bearing surface.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Extreme {
    /// The value, in the unit of its field.
    pub value: f64,
    /// Angle from +X of the shell frame, rad.
    pub angle: f64,
    /// Axial position from the mid-plane, m.
    pub axial: f64,
}

/// Flow through one feed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FeedFlow {
    /// Oil into the film, m3/s; negative where the film pushes oil back.
    pub flow: f64,
    /// Gauge pressure in the feed, Pa.
    pub pressure: f64,
}

/// What a designer asks of one film.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FilmSummary {
    /// Smallest film thickness, m, and where.
    pub minimum_film_thickness: Extreme,
    /// Smallest film thickness at the front edge z = -B/2 and at the rear edge z = +B/2, m.
    pub edge_film_thickness: [f64; 2],
    /// Largest film pressure (gauge), Pa, and where.
    pub peak_film_pressure: Extreme,
    /// Oil that leaves at the ends z = -B/2 and z = +B/2, m3/s.
    pub side_flow: [f64; 2],
    /// Oil that enters through all feeds and the inlet line, m3/s.
    pub feed_flow: f64,
    /// Rate at which the film content grows, m3/s.
    pub storage_rate: f64,
    /// |feed - side - storage| over the largest of them: 0 for a mass-conserving closure up to
    /// round-off, and what the others create or lose.
    pub mass_balance_relative: f64,
    /// Friction torque of the journal times its speed relative to the shell, W.
    pub friction_power: f64,
    /// Power that squeeze motion and tilt rates put into the film, -F v - M tilt_rate, W, and what a
    /// journal that is not round puts in as it turns.
    pub squeeze_power: f64,
    /// Largest contact pressure of asperities, Pa, and where; zero without contact.
    #[serde(default)]
    pub peak_contact_pressure: Extreme,
    /// Contact pressure over the whole bearing, N: integral without regard to its direction.
    #[serde(default)]
    pub contact_load: f64,
    /// Power of asperities that touch, W: part of the friction power.
    #[serde(default)]
    pub boundary_power: f64,
    /// Share of the land area that carries a full film.
    pub full_film_share: f64,
    /// Largest violation of p >= p_cav, theta <= 1 and (p - p_cav)(1 - theta) = 0, relative to the
    /// peak pressure and 1.
    pub complementarity_violation: f64,
    /// Largest cell residual over the largest cell flux.
    pub cell_residual: f64,
    /// Updates of the film since the last accepted or rejected step.
    pub iterations: usize,
    /// Reynolds number of the film at its mean thickness, rho U h / eta.
    pub reynolds_number: f64,
}

impl FilmSummary {
    /// Power lost in the film, W: friction and squeeze together.
    #[must_use]
    pub fn power_loss(&self) -> f64 {
        self.friction_power + self.squeeze_power
    }
}

/// View of the fields of a film on its grid: cell `i` around, `j` along the axis, at
/// `i * axial.len() + j`.
#[derive(Debug, Clone, Copy)]
pub struct FilmField<'a> {
    /// Cell centres around, rad, shell frame.
    pub angles: &'a [f64],
    /// Cell centres along the axis, m.
    pub axial: &'a [f64],
    /// Angles that the cells span, rad: half to each side of the centre.
    pub angle_widths: &'a [f64],
    /// Widths of the cells along the axis, m.
    pub axial_widths: &'a [f64],
    /// Gauge pressure, Pa.
    pub pressure: &'a [f64],
    /// Film fraction.
    pub film_fraction: &'a [f64],
    /// Film thickness, m.
    pub film_thickness: &'a [f64],
    /// Temperature, K, where it is a field; else empty.
    pub temperature: &'a [f64],
    /// Contact pressure of asperities, Pa; empty where none carry.
    pub contact_pressure: &'a [f64],
}

/// The film content of the past, opaque to callers.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FilmHistory {
    /// Film fraction times relative gap per cell at the last accepted step.
    pub content: Vec<f64>,
}

/// A state or use that a film model refuses.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum FilmError {
    /// The surfaces touch or overlap.
    #[error(
        "the gap closes at angle {angle_deg:.2} deg, axial position {axial_mm:.3} mm \
         (gap {gap_um:.4} um): reduce eccentricity or tilt"
    )]
    Contact {
        /// Place around, degrees from +X.
        angle_deg: f64,
        /// Place along the axis, mm.
        axial_mm: f64,
        /// The gap there, um (not positive).
        gap_um: f64,
    },
    /// The model has no tilt.
    #[error("this film model has no tilt: use model = \"field\"")]
    NoTilt,
    /// A value is not a number or infinite.
    #[error("the journal state holds a value that is not finite: {name}")]
    NotFinite {
        /// Which one.
        name: &'static str,
    },
    /// The model cannot be built from this bearing.
    #[error("{reason}")]
    Unsupported {
        /// Why, and what to do.
        reason: &'static str,
    },
}
