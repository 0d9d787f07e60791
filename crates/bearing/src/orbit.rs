//! Which orbit does the journal run under a periodic load?
//!
//! Equation: `force(position, rate, film content) + load(t) = mass x acceleration` over one period of
//! the load table, with position (and film content) at its end as at its start.
//! Unknowns: journal position, m, and tilt, rad, where it is free ([`crate::CycleTilt`]); a prescribed
//! tilt enters the film with its rate, and the moment that holds it follows.
//! Method: implicit in time ([`crate::time_step`]), steps adapted inside each output crank step
//! ([`crate::step_control`]), journal and film brought to balance by one interleaved Newton
//! ([`crate::balance`]); cycles are run until two successive ones agree.
//! References: J. F. Booker, J. Basic Eng. 87 (1965) 537, 10.1115/1.3650602; P. K. Goenka, J.
//! Tribol. 106 (1984) 421, 10.1115/1.3260949.

use crate::balance::NewtonLimits;
use crate::cycle_table::CycleTable;
use crate::equilibrium::{EquilibriumRequest, EquilibriumSettings, find_equilibrium};
use crate::mixing::Mixing;
use crate::motion::{add, coordinates, length, with_motion};
use crate::step_control::Substeps;
use crate::supply_cycle::SupplyCycle;
use crate::time_step::{Moving, Stepper, Trial};
use crate::{CyclePoint, JournalOrbit, LoadCycle};
use serde::{Deserialize, Serialize};
use sommerfeld_film::{
    Bearing, Conditions, FilmError, FilmForce, FilmHistory, JournalState, Linearised, Outcome,
    Step, Surroundings, Warmed,
};
use std::ops::ControlFlow;

/// How the orbit is computed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct OrbitSettings {
    /// Output crank step, rad; rounded so that a whole number fills the period. Default 1 degree.
    pub crank_step: f64,
    /// Largest error of one time step over the smallest gap, films without history (second order).
    /// Default 1e-4.
    pub error_tolerance: f64,
    /// The same for films with history. Default 5e-3.
    pub history_error_tolerance: f64,
    /// For the sake of that tolerance the crank step is divided by three at most this often. Cells of a
    /// film on a grid that fill or rupture make the rate of a light journal jump; still shorter steps
    /// would follow single cells and not the motion. Default 1.
    pub history_divisions: u32,
    /// Newton stops before a step smaller than this, over the smallest gap. Default 1e-5.
    pub newton_tolerance: f64,
    /// The same for films with history, whose time steps are coarser. Default 1e-4.
    pub history_newton_tolerance: f64,
    /// Film updates for one implicit stage. Default 20.
    pub iteration_limit: usize,
    /// Largest share of the smallest gap that one Newton step may take. Default 0.7.
    pub largest_gap_loss: f64,
    /// The output crank step is divided by three at most this often where Newton fails. Default 6.
    pub largest_divisions: u32,
    /// The orbit is closed when two cycles differ by less than this share of the radial clearance.
    /// Default 1e-4.
    pub closure_tolerance: f64,
    /// Cycles at most. Default 8.
    pub cycle_limit: usize,
    /// Where the first cycle starts.
    pub start: OrbitStart,
}

impl Default for OrbitSettings {
    fn default() -> Self {
        Self {
            crank_step: std::f64::consts::PI / 180.0,
            error_tolerance: 1e-4,
            history_error_tolerance: 5e-3,
            history_divisions: 1,
            newton_tolerance: 1e-5,
            history_newton_tolerance: 1e-4,
            iteration_limit: 20,
            largest_gap_loss: 0.7,
            largest_divisions: 6,
            closure_tolerance: 1e-4,
            cycle_limit: 8,
            start: OrbitStart::Equilibrium,
        }
    }
}

impl OrbitSettings {
    /// Output points per cycle: a whole number of crank steps fills the period.
    #[must_use]
    pub fn points_per_cycle(&self, cycle: &LoadCycle) -> usize {
        (cycle.period / self.crank_step).round().max(1.0) as usize
    }
}

/// Where the first cycle starts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OrbitStart {
    /// At rest in the equilibrium of the first row with the film content that belongs to it; at half
    /// eccentricity in the direction of the load, with a full film, if there is none.
    Equilibrium,
    /// At a given state (position and tilt, and the rates of a journal with mass) with the film
    /// content that the film remembers.
    At(JournalState),
}

/// How far the run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Number of the cycle, from 1.
    pub cycle: usize,
    /// Share of this cycle that is done.
    pub fraction: f64,
}

/// Sees every output point of every cycle together with the film there (fields included) and may ask
/// to stop. Called for the start once, then at the end of each output crank step.
pub type Observer<'a> = dyn FnMut(&CyclePoint, &dyn FilmForce, Progress) -> ControlFlow<()> + 'a;

/// From this level of division on, a substep that fails is tried once more with patience.
const PATIENT_LEVEL: u32 = 1;

/// Limits for a journal that crosses an emptied gap: nothing holds it until it meets oil again, so
/// that a shorter time step does not help, but many small Newton steps do.
fn patient(limits: &NewtonLimits) -> NewtonLimits {
    NewtonLimits {
        iterations: 6 * limits.iterations,
        gap_loss: 0.4 * limits.gap_loss,
        ..*limits
    }
}

/// Refused substeps at the finest level before the rest of an output crank step is given up.
const LARGEST_FAILURES: usize = 3;

/// Output points in a row that may fail before the run is given up.
const LARGEST_FAILED_POINTS: usize = 10;

/// Runs the journal through the load cycle until its orbit closes. The supply pressures of the cycle
/// take the place of those in `conditions` and in the bearing.
///
/// Points that do not converge are marked and passed over; where the film starves or has no solution,
/// or the observer stops the run, the points of the unfinished cycle come back with
/// [`Outcome::Starved`], [`Outcome::NoSolution`] or [`Outcome::NotConverged`].
///
/// # Errors
/// [`FilmError::Unsupported`] for a load table that cannot be run, and what the film refuses.
pub fn journal_orbit(
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    cycle: &LoadCycle,
    conditions: &Conditions<'_>,
    settings: &OrbitSettings,
    observer: &mut Observer<'_>,
) -> Result<JournalOrbit, FilmError> {
    let mut run = Run::new(film, bearing, cycle, conditions, settings)?;
    run.until_closed(observer)
}

/// How the film of an orbit is warmed.
#[derive(Debug, Clone, Copy)]
pub struct CycleHeat<'a> {
    /// What the oil brings and what surrounds it.
    pub surroundings: Surroundings<'a>,
    /// The orbit is closed only when no temperature changes by more than this from cycle to cycle, K.
    pub tolerance: f64,
}

/// An orbit with the temperatures of its film.
#[derive(Debug, Clone, PartialEq)]
pub struct WarmOrbit {
    /// The orbit in the warm film.
    pub orbit: JournalOrbit,
    /// Temperatures, and where the heat goes, mean over the last cycle.
    pub warmed: Warmed,
    /// Largest change of a temperature at the end of each cycle, K.
    pub changes: Vec<f64>,
}

/// [`journal_orbit`] in the film's own temperatures: those that the heat and the flows of a whole cycle
/// lead to. A film is warmed through within many cycles and does not follow one, so that the temperatures
/// stay as they are within a cycle and move at its end.
///
/// # Errors
/// As [`journal_orbit`]; [`FilmError::Unsupported`] for a film without a field of temperature.
pub fn warm_orbit(
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    cycle: &LoadCycle,
    conditions: &Conditions<'_>,
    settings: &OrbitSettings,
    heat: &CycleHeat<'_>,
    observer: &mut Observer<'_>,
) -> Result<WarmOrbit, FilmError> {
    if film.field().is_none() {
        return Err(FilmError::Unsupported {
            reason: "a field of temperature needs model = \"field\"",
        });
    }
    let mut run = Run::new(film, bearing, cycle, conditions, settings)?;
    run.heat = Some(heat);
    let orbit = run.until_closed(observer)?;
    Ok(WarmOrbit {
        orbit,
        warmed: run.warmed,
        changes: run.changes,
    })
}

impl Run<'_> {
    /// Cycles until the orbit closes, and the temperatures with it.
    fn until_closed(&mut self, observer: &mut Observer<'_>) -> Result<JournalOrbit, FilmError> {
        let run = self;
        let settings = run.settings;
        if let Some(outcome) = run.start(observer)? {
            return Ok(run.orbit(1, f64::NAN, outcome));
        }
        let mut closure = f64::NAN;
        for number in 1..=settings.cycle_limit.max(1) {
            let before = std::mem::take(&mut run.points);
            if let Some(last) = before.last() {
                run.points.push(CyclePoint {
                    crank_angle: run.stepper.table.first_angle(),
                    ..*last
                });
            }
            if let Some(outcome) = run.cycle(number, observer)? {
                return Ok(run.orbit(number, closure, outcome));
            }
            closure = run.closure(&before, number).unwrap_or(closure);
            let is_warm = match run.warm() {
                Some(is_warm) => is_warm,
                None => return Ok(run.orbit(number, closure, Outcome::NoSolution)),
            };
            if closure < settings.closure_tolerance && is_warm {
                let solved = run.points.iter().all(|p| p.outcome == Outcome::Converged);
                let outcome = if solved {
                    Outcome::Converged
                } else {
                    Outcome::NotConverged
                };
                return Ok(run.orbit(number, closure, outcome));
            }
        }
        Ok(run.orbit(settings.cycle_limit.max(1), closure, Outcome::NotConverged))
    }

    /// Moves the temperatures to what the cycle leads to; whether they stayed. `None` where heat has no
    /// way out.
    fn warm(&mut self) -> Option<bool> {
        let Some(heat) = self.heat else {
            return Some(true);
        };
        let mut warming = self.film.led_to(&heat.surroundings, true)?;
        if warming.warmed.change <= heat.tolerance {
            warming = self.film.led_to(&heat.surroundings, false)?;
        }
        self.warmed = warming.warmed;
        self.changes.push(self.warmed.change);
        let next = self
            .mixing
            .next(&warming.from, &warming.led_to, warming.from.len());
        self.film.warm(&next);
        Some(self.warmed.change <= heat.tolerance)
    }
}

/// A run in progress.
struct Run<'a> {
    film: &'a mut dyn FilmForce,
    bearing: &'a Bearing,
    settings: &'a OrbitSettings,
    stepper: Stepper<'a>,
    substeps: Substeps,
    /// Crank angle of one output step, rad, and their number per period.
    crank_step: f64,
    count: usize,
    moving: Moving,
    /// Points of the present cycle.
    points: Vec<CyclePoint>,
    steps: usize,
    failed_points: usize,
    /// A substep since the last point did not converge.
    failed_since: bool,
    /// How the film is warmed, if it is, and what came of it.
    heat: Option<&'a CycleHeat<'a>>,
    warmed: Warmed,
    changes: Vec<f64>,
    mixing: Mixing,
}

impl<'a> Run<'a> {
    fn new(
        film: &'a mut dyn FilmForce,
        bearing: &'a Bearing,
        cycle: &'a LoadCycle,
        conditions: &'a Conditions<'a>,
        settings: &'a OrbitSettings,
    ) -> Result<Self, FilmError> {
        let table = CycleTable::new(cycle)?;
        if !(settings.crank_step.is_finite() && settings.crank_step > 0.0) {
            return Err(FilmError::Unsupported {
                reason: "the crank step must be positive",
            });
        }
        let count = settings.points_per_cycle(cycle);
        let capabilities = film.capabilities();
        if !(table.is_aligned() || capabilities.accepts_tilt) {
            return Err(FilmError::NoTilt);
        }
        let stepper = Stepper {
            supply: SupplyCycle::new(bearing, cycle, conditions)?,
            engine_speed: cycle.engine_speed,
            mass: cycle.journal_mass,
            with_tilt: table.frees_tilt(),
            arm: 0.5 * bearing.width,
            force_scale: table.largest_load().max(f64::MIN_POSITIVE),
            limits: NewtonLimits {
                iterations: settings.iteration_limit,
                residual: 1e-3,
                step: if capabilities.has_history {
                    settings.history_newton_tolerance
                } else {
                    settings.newton_tolerance
                },
                gap_loss: settings.largest_gap_loss,
                takes_last_step: !capabilities.has_history,
                needs_settled: true,
            },
            has_history: capabilities.has_history,
            film_solves: 0,
            table,
        };
        Ok(Self {
            moving: Moving {
                crank_angle: stepper.table.first_angle(),
                position: [0.0; 4],
                rate: [0.0; 4],
                slope: [0.0; 4],
                duration: 0.0,
                rate_is_known: false,
            },
            film,
            bearing,
            settings,
            stepper,
            substeps: Substeps::new(settings.largest_divisions.min(20)),
            crank_step: cycle.period / count as f64,
            count,
            points: Vec::new(),
            steps: 0,
            failed_points: 0,
            failed_since: false,
            heat: None,
            warmed: Warmed::default(),
            changes: Vec::new(),
            // A cycle differs from the one before by its journal and film content too.
            mixing: Mixing::new(0),
        })
    }

    /// Start state, its rate and the first point.
    fn start(&mut self, observer: &mut Observer<'_>) -> Result<Option<Outcome>, FilmError> {
        let (state, history) = self.start_state()?;
        self.moving.position = coordinates(&state);
        if self.stepper.mass > 0.0 || self.stepper.table.holds_tilt() {
            let ([x, y], [tilt_x, tilt_y]) = (state.velocity, state.tilt_rate);
            self.moving.rate = [x, y, tilt_x, tilt_y];
        }
        let (state, linearised) = if self.stepper.has_history {
            let conditions = self.stepper.supply.at(self.moving.crank_angle);
            let linearised = self.film.react(&state, Step::Steady, &conditions)?;
            (state, linearised)
        } else {
            let trial = self
                .stepper
                .start_motion(self.film, &self.moving, self.crank_step)?;
            self.moving = trial.end;
            (
                with_motion(&trial.state, trial.end.position, trial.end.rate),
                trial.linearised,
            )
        };
        let stopped = self.publish(&state, &linearised, linearised.outcome, 1, observer);
        self.film.reject_step();
        self.film.restore(&history);
        if self.stepper.has_history {
            // Points are the middles of the output crank steps: the first begins half a step on.
            self.moving.crank_angle += 0.5 * self.crank_step;
        }
        Ok(stopped)
    }

    /// First state, and the film content that it starts from.
    fn start_state(&mut self) -> Result<(JournalState, FilmHistory), FilmError> {
        let first = self.stepper.table.first_angle();
        let mut frame = self.stepper.table.frame(first);
        let held = self.stepper.table.held_tilt(first);
        frame.tilt = held.map_or([0.0; 2], |held| held.tilt);
        let tilt_rate = held.map_or([0.0; 2], |held| held.rate);
        if let OrbitStart::At(state) = self.settings.start {
            let motion = with_motion(&frame, coordinates(&state), [0.0; 4]);
            let state = JournalState {
                velocity: state.velocity,
                tilt: held.map_or(state.tilt, |held| held.tilt),
                tilt_rate: held.map_or(state.tilt_rate, |held| held.rate),
                ..motion
            };
            return Ok((state, self.film.history()));
        }
        self.film.restore(&FilmHistory::default());
        let point = self.stepper.table.at(first);
        let request = EquilibriumRequest {
            load: point.load,
            moment: self.stepper.with_tilt.then_some(point.moment),
            frame,
            start: None,
            settings: EquilibriumSettings {
                residual_tolerance: 1e-6,
                ..EquilibriumSettings::default()
            },
        };
        let conditions = self.stepper.supply.at(first);
        let found = find_equilibrium(self.film, self.bearing, &request, &conditions)?;
        self.stepper.film_solves += found.film_updates;
        if found.outcome == Outcome::Converged {
            self.film.accept_step();
            let state = JournalState {
                tilt_rate,
                ..found.state
            };
            return Ok((state, self.film.history()));
        }
        let load = point.load[0].hypot(point.load[1]).max(f64::MIN_POSITIVE);
        let half = 0.5 * self.bearing.radial_clearance / load;
        let state = JournalState {
            position: point.load.map(|component| half * component),
            tilt_rate,
            ..frame
        };
        Ok((state, FilmHistory::default()))
    }

    /// One cycle; an outcome if the run ends within it.
    fn cycle(
        &mut self,
        number: usize,
        observer: &mut Observer<'_>,
    ) -> Result<Option<Outcome>, FilmError> {
        let start = self.moving.crank_angle;
        for step in 1..=self.count {
            let ended = self.output_step(self.moving.crank_angle, number, observer)?;
            // Sums of many substeps must not drift off the output crank angles.
            self.moving.crank_angle = start + step as f64 * self.crank_step;
            if ended.is_some() {
                return Ok(ended);
            }
            if self.failed_points > LARGEST_FAILED_POINTS {
                return Ok(Some(Outcome::NotConverged));
            }
        }
        Ok(None)
    }

    /// Substeps through one output crank step, with its point published on the way: at the middle for
    /// films with history, whose state belongs there, else at the end. An outcome if the run ends.
    fn output_step(
        &mut self,
        from: f64,
        number: usize,
        observer: &mut Observer<'_>,
    ) -> Result<Option<Outcome>, FilmError> {
        let settings = self.settings;
        let (tolerance, finest) = if self.stepper.has_history {
            (settings.history_error_tolerance, settings.history_divisions)
        } else {
            (settings.error_tolerance, settings.largest_divisions)
        };
        // The error of a step of second order falls by 27 with a third of its length.
        let room = 0.03;
        let mut failures = 0;
        let mut is_published = false;
        self.substeps.begin();
        loop {
            self.moving.crank_angle = from + self.substeps.position() * self.crank_step;
            let angle = self.substeps.length() * self.crank_step;
            let mut trial = self.stepper.try_step(self.film, &self.moving, angle)?;
            if trial.outcome == Outcome::NotConverged && self.substeps.level() >= PATIENT_LEVEL {
                self.film.reject_step();
                let hasty = self.stepper.limits;
                self.stepper.limits = patient(&hasty);
                let again = self.stepper.try_step(self.film, &self.moving, angle);
                self.stepper.limits = hasty;
                trial = again?;
            }
            let solved = trial.outcome == Outcome::Converged;
            let accurate = trial.error <= tolerance || self.substeps.level() >= finest;
            if !(solved && accurate) && self.substeps.divide() {
                self.film.reject_step();
                continue;
            }
            if matches!(trial.outcome, Outcome::Starved | Outcome::NoSolution) {
                self.film.reject_step();
                return Ok(Some(trial.outcome));
            }
            let shows = if self.stepper.has_history {
                self.substeps.is_central()
            } else {
                self.substeps.is_last()
            };
            let mut trial = if solved {
                trial
            } else {
                self.failed_since = true;
                failures += 1;
                self.passed_over(&trial, failures)
            };
            self.moving = trial.end;
            self.steps += 1;
            self.substeps
                .advance(solved && trial.error < room * tolerance);
            let at_end = self.substeps.at_end();
            if shows || (at_end && !is_published) {
                is_published = true;
                if solved {
                    self.stepper.refresh(self.film, &mut trial)?;
                    self.failed_since |= trial.outcome != Outcome::Converged;
                }
                let stopped = self.publish_step(&trial, number, observer);
                if stopped.is_some() {
                    self.film.accept_step();
                    return Ok(stopped);
                }
            }
            self.film.accept_step();
            if at_end {
                return Ok(None);
            }
        }
    }

    /// Publishes the point of an output crank step.
    fn publish_step(
        &mut self,
        trial: &Trial,
        number: usize,
        observer: &mut Observer<'_>,
    ) -> Option<Outcome> {
        let outcome = if self.failed_since {
            self.failed_points += 1;
            Outcome::NotConverged
        } else {
            self.failed_points = 0;
            Outcome::Converged
        };
        self.failed_since = false;
        self.publish(&trial.state, &trial.linearised, outcome, number, observer)
    }

    /// A substep that does not converge even at the finest level: its best iterate, then at rest;
    /// after several of them the journal rests where it is to the end of the output crank step.
    fn passed_over(&mut self, trial: &Trial, failures: usize) -> Trial {
        let mut kept = *trial;
        if failures >= LARGEST_FAILURES {
            self.substeps.skip_to_end();
        }
        let gap = self.film.minimum_gap(&trial.state);
        if !gap.is_finite() {
            kept.end.position = self.moving.position;
        }
        kept.end.rate = [0.0; 4];
        kept.end.slope = [0.0; 4];
        kept.end.rate_is_known = false;
        kept.state = with_motion(&trial.state, kept.end.position, kept.end.rate);
        kept
    }

    /// Adds a point and shows it; an outcome if the observer asks to stop.
    fn publish(
        &mut self,
        state: &JournalState,
        linearised: &Linearised,
        outcome: Outcome,
        number: usize,
        observer: &mut Observer<'_>,
    ) -> Option<Outcome> {
        let index = self.points.len();
        let crank_angle = self.stepper.table.first_angle() + index as f64 * self.crank_step;
        let load = self.stepper.table.at(crank_angle);
        let point = CyclePoint {
            crank_angle,
            load: load.load,
            moment: if self.stepper.table.holds_tilt() {
                linearised.reaction.moment().map(|moment| -moment)
            } else {
                load.moment
            },
            state: *state,
            reaction: linearised.reaction,
            summary: self.film.summary(),
            outcome,
        };
        self.points.push(point);
        if self.heat.is_some() && index > 0 {
            let duration = self.crank_step / self.stepper.engine_speed;
            self.film.account_heat(duration);
        }
        let progress = Progress {
            cycle: number,
            fraction: index as f64 / self.count as f64,
        };
        match observer(&point, &*self.film, progress) {
            ControlFlow::Continue(()) => None,
            ControlFlow::Break(()) => Some(Outcome::NotConverged),
        }
    }

    /// Largest distance from the cycle before, over the clearance. The first cycle has none before it,
    /// but under a constant load it is closed if the journal stayed where it began.
    fn closure(&self, before: &[CyclePoint], number: usize) -> Option<f64> {
        let distance = |a: &CyclePoint, b: &CyclePoint| {
            let change = add(coordinates(&a.state), -1.0, coordinates(&b.state));
            length(change, self.stepper.arm) / self.bearing.radial_clearance
        };
        let largest = |distances: &mut dyn Iterator<Item = f64>| distances.fold(0.0, f64::max);
        if number > 1 {
            let mut distances = self.points.iter().zip(before).map(|(a, b)| distance(a, b));
            return Some(largest(&mut distances));
        }
        let first = self.points.first()?;
        let mut distances = self.points.iter().map(|point| distance(point, first));
        self.stepper
            .table
            .is_constant()
            .then(|| largest(&mut distances))
    }

    fn orbit(&mut self, cycles: usize, closure: f64, outcome: Outcome) -> JournalOrbit {
        JournalOrbit {
            points: std::mem::take(&mut self.points),
            cycles,
            closure,
            steps: self.steps,
            film_solves: self.stepper.film_solves,
            outcome,
        }
    }
}
