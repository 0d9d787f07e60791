//! Where is the journal one time step later?
//!
//! Equation: `force(position, rate) + load(t) = mass x acceleration`; massless: an implicit equation
//! for the rate. Unknown of every implicit stage: the position (and tilt) at its end.
//! Films without history: TR-BDF2, second order and L-stable (a thin film is stiff, a massive journal
//! on it stiffer), two implicit stages; the error estimate is its embedded third-order pair, taken
//! on the position. Films with history: the implicit midpoint rule, second order too, with journal and
//! pressure in the middle of the step and the film content from its start to its end, which keeps the
//! film fraction between its bounds; its error is estimated from the change of the rate's slope.
//! Estimates are relative to the smallest gap. A prescribed tilt enters every stage with its value and
//! rate there; in the midpoint rule the rate is the change over the step, so that the film content
//! agrees with it.
//! References: those of [`crate::motion`].

use crate::balance::{Balance, Balanced, Motion, NewtonLimits};
use crate::cycle_table::{CycleTable, HeldTilt};
use crate::motion::{
    Coordinates, DIAGONAL, ERROR_WEIGHTS, FIRST_STAGE, WEIGHT, add, coordinates, length,
    with_motion,
};
use crate::supply_cycle::SupplyCycle;
use sommerfeld_film::{FilmError, FilmForce, JournalState, Linearised, Outcome, Step};

/// The journal in motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moving {
    /// Rad, counted on over the cycles.
    pub crank_angle: f64,
    /// m and rad.
    pub position: Coordinates,
    /// m/s and rad/s.
    pub rate: Coordinates,
    /// Change of the rate per time, m/s2 and rad/s2: the acceleration of a journal with mass, an
    /// extrapolation for one without.
    pub slope: Coordinates,
    /// Length of the step that led here, s; 0 at the start.
    pub duration: f64,
    /// The rate is one of the motion, not a mere start value.
    pub rate_is_known: bool,
}

/// A tried step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Trial {
    pub end: Moving,
    pub state: JournalState,
    pub linearised: Linearised,
    /// The film as it is belongs to the state.
    pub film_shows: bool,
    /// Estimated error of the position over the smallest gap.
    pub error: f64,
    pub outcome: Outcome,
}

/// What all steps of a run share.
#[derive(Debug, Clone)]
pub(crate) struct Stepper<'a> {
    pub table: CycleTable<'a>,
    pub supply: SupplyCycle<'a>,
    /// Crank speed, rad/s.
    pub engine_speed: f64,
    /// kg.
    pub mass: f64,
    pub with_tilt: bool,
    /// Half the bearing width, m.
    pub arm: f64,
    /// Largest load of the cycle, N.
    pub force_scale: f64,
    pub limits: NewtonLimits,
    pub has_history: bool,
    /// Film updates so far.
    pub film_solves: usize,
}

impl Stepper<'_> {
    /// One step of `angle` (rad of crank angle) from `from`.
    pub(crate) fn try_step(
        &mut self,
        film: &mut dyn FilmForce,
        from: &Moving,
        angle: f64,
    ) -> Result<Trial, FilmError> {
        if self.has_history {
            self.midpoint(film, from, angle)
        } else {
            self.second_order(film, from, angle)
        }
    }

    fn second_order(
        &mut self,
        film: &mut dyn FilmForce,
        from: &Moving,
        angle: f64,
    ) -> Result<Trial, FilmError> {
        let duration = angle / self.engine_speed;
        let stage = DIAGONAL * duration;
        let middle_motion = Motion::Moving {
            anchor: add(from.position, stage, from.rate),
            rate_anchor: add(from.rate, stage, from.slope),
            duration: stage,
            mass: self.mass,
            step: Step::Steady,
        };
        let middle_angle = from.crank_angle + FIRST_STAGE * angle;
        let held = self.table.held_tilt(middle_angle);
        let middle_motion = holding(middle_motion, held);
        let guess = extrapolated(from, FIRST_STAGE * duration, from.slope);
        let middle = self.solve(
            film,
            middle_motion,
            middle_angle,
            [from.position, guess],
            held,
        )?;
        if middle.outcome != Outcome::Converged {
            return Ok(self.trial(film, from, angle, &middle, middle_motion));
        }
        let middle_position = coordinates(&middle.state);
        let middle_rate = middle_motion.rate(middle_position);
        let middle_slope = middle_motion.acceleration(middle_position);

        let weight = WEIGHT * duration;
        let both = |a: Coordinates, b: Coordinates| add(a, 1.0, b);
        let motion = Motion::Moving {
            anchor: add(from.position, weight, both(from.rate, middle_rate)),
            rate_anchor: add(from.rate, weight, both(from.slope, middle_slope)),
            duration: stage,
            mass: self.mass,
            step: Step::Steady,
        };
        let end_angle = from.crank_angle + angle;
        let held = self.table.held_tilt(end_angle);
        let motion = holding(motion, held);
        let slope = divided(add(middle_rate, -1.0, from.rate), FIRST_STAGE * duration);
        let guess = extrapolated(from, duration, slope);
        let end = self.solve(film, motion, end_angle, [from.position, guess], held)?;
        let mut trial = self.trial(film, from, angle, &end, motion);
        let rates = [from.rate, middle_rate, trial.end.rate];
        let mut error = ERROR_WEIGHTS
            .iter()
            .zip(rates)
            .fold([0.0; 4], |sum, (weight, rate)| {
                add(sum, weight * duration, rate)
            });
        if held.is_some() {
            // A prescribed tilt is exact.
            error[2..].fill(0.0);
        }
        trial.error = length(error, self.arm) / self.smallest_gap(film, from, &trial.state);
        if self.mass == 0.0 {
            let rest = (1.0 - FIRST_STAGE) * duration;
            trial.end.slope = divided(add(trial.end.rate, -1.0, middle_rate), rest);
        }
        Ok(trial)
    }

    fn midpoint(
        &mut self,
        film: &mut dyn FilmForce,
        from: &Moving,
        angle: f64,
    ) -> Result<Trial, FilmError> {
        let duration = angle / self.engine_speed;
        let half = 0.5 * duration;
        let motion = Motion::Moving {
            anchor: from.position,
            rate_anchor: from.rate,
            duration: half,
            mass: self.mass,
            step: Step::Implicit {
                duration,
                after: half,
            },
        };
        // The rate of a massless journal is that in the middle of the step before, of one with mass
        // that at its end.
        let since = if self.mass > 0.0 {
            half
        } else {
            half + 0.5 * from.duration
        };
        let guess = add(from.position, half, add(from.rate, since, from.slope));
        let middle_angle = from.crank_angle + 0.5 * angle;
        let held = self.mean_tilt(from.crank_angle, angle);
        let motion = holding(motion, held);
        let middle = self.solve(film, motion, middle_angle, [from.position, guess], held)?;
        let mut trial = self.trial(film, from, angle, &middle, motion);
        let rate = trial.end.rate;
        trial.end.position = add(from.position, duration, rate);
        trial.end.duration = duration;
        let change = add(rate, -1.0, from.rate);
        trial.end.slope = if from.rate_is_known {
            divided(change, since)
        } else {
            [0.0; 4]
        };
        if from.rate_is_known {
            let mut bend = add(trial.end.slope, -1.0, from.slope);
            if held.is_some() {
                bend[2..].fill(0.0);
            }
            let end = with_motion(&trial.state, trial.end.position, rate);
            trial.error = duration * duration / 24.0 * length(bend, self.arm)
                / self.smallest_gap(film, from, &end);
        }
        if self.mass > 0.0 {
            trial.end.rate = add(rate, 1.0, change);
        }
        Ok(trial)
    }

    /// Rate of the massless journal at its start (films without history), from an implicit step so
    /// short that the position stays; acceleration of a journal with mass from its force.
    pub(crate) fn start_motion(
        &mut self,
        film: &mut dyn FilmForce,
        start: &Moving,
        angle: f64,
    ) -> Result<Trial, FilmError> {
        let motion = Motion::Moving {
            anchor: start.position,
            rate_anchor: start.rate,
            duration: 1e-3 * angle / self.engine_speed,
            mass: self.mass,
            step: Step::Steady,
        };
        let held = self.table.held_tilt(start.crank_angle);
        let motion = holding(motion, held);
        let tolerance = self.limits.step;
        self.limits.step *= 1e-4;
        let balanced = self.solve(film, motion, start.crank_angle, [start.position; 2], held);
        self.limits.step = tolerance;
        let mut trial = self.trial(film, start, 0.0, &balanced?, motion);
        trial.end.position = start.position;
        if self.mass == 0.0 {
            trial.end.slope = [0.0; 4];
        }
        Ok(trial)
    }

    /// Brings the film of a point that is to be shown to the state of the point.
    pub(crate) fn refresh(
        &mut self,
        film: &mut dyn FilmForce,
        trial: &mut Trial,
    ) -> Result<(), FilmError> {
        if trial.film_shows || self.has_history {
            return Ok(());
        }
        let conditions = self.supply.at(trial.end.crank_angle);
        match film.look(&trial.state, Step::Steady, &conditions) {
            Ok((seen, updates)) => {
                self.film_solves += updates;
                trial.linearised = seen;
                trial.outcome = seen.outcome;
            }
            // So close to contact what the film said last stands.
            Err(FilmError::Contact { .. }) => {}
            Err(error) => return Err(error),
        }
        Ok(())
    }

    /// Mean and change per time of a prescribed tilt over a step of `angle` (rad).
    fn mean_tilt(&self, from: f64, angle: f64) -> Option<HeldTilt> {
        let start = self.table.held_tilt(from)?.tilt;
        let end = self.table.held_tilt(from + angle)?.tilt;
        let duration = angle / self.engine_speed;
        Some(HeldTilt {
            tilt: [0, 1].map(|axis| 0.5 * (start[axis] + end[axis])),
            rate: [0, 1].map(|axis| (end[axis] - start[axis]) / duration),
        })
    }

    /// The balance at a crank angle, from a guess that keeps the gap of a safe position open.
    fn solve(
        &mut self,
        film: &mut dyn FilmForce,
        motion: Motion,
        crank_angle: f64,
        [mut safe, mut guess]: [Coordinates; 2],
        held: Option<HeldTilt>,
    ) -> Result<Balanced, FilmError> {
        let point = self.table.at(crank_angle);
        let mut frame = self.table.frame(crank_angle);
        if let Some(held) = held {
            safe = under_tilt(film, &frame, safe, held.tilt);
            guess[2..].copy_from_slice(&held.tilt);
        }
        frame.tilt = [safe[2], safe[3]];
        let balance = Balance {
            load: point.load,
            moment: point.moment,
            with_tilt: self.with_tilt,
            frame,
            motion,
            force_scale: self.force_scale,
            arm: self.arm,
        };
        let jump = add(guess, -1.0, safe);
        let share = balance.allowed_share(film, safe, jump, self.limits.gap_loss);
        let conditions = self.supply.at(crank_angle);
        let found = balance.find(film, &conditions, add(safe, share, jump), &self.limits)?;
        self.film_solves += found.film_updates;
        Ok(found)
    }

    fn trial(
        &self,
        film: &dyn FilmForce,
        from: &Moving,
        angle: f64,
        balanced: &Balanced,
        motion: Motion,
    ) -> Trial {
        let position = coordinates(&balanced.state);
        debug_assert!(film.minimum_gap(&balanced.state).is_finite());
        Trial {
            end: Moving {
                crank_angle: from.crank_angle + angle,
                position,
                rate: motion.rate(position),
                slope: motion.acceleration(position),
                duration: angle / self.engine_speed,
                rate_is_known: balanced.outcome == Outcome::Converged,
            },
            state: balanced.state,
            linearised: balanced.linearised,
            film_shows: balanced.shows,
            error: 0.0,
            outcome: balanced.outcome,
        }
    }

    fn smallest_gap(&self, film: &dyn FilmForce, from: &Moving, end: &JournalState) -> f64 {
        let start = with_motion(end, from.position, from.rate);
        film.minimum_gap(&start).min(film.minimum_gap(end)).abs()
    }
}

/// The motion with the rate of a prescribed tilt.
fn holding(motion: Motion, held: Option<HeldTilt>) -> Motion {
    held.map_or(motion, |held| motion.with_tilt_rate(held.tilt, held.rate))
}

/// A position under another tilt. Where that would close most of the gap, the journal is moved towards
/// the centre: it is only where a search starts.
fn under_tilt(
    film: &dyn FilmForce,
    frame: &JournalState,
    position: Coordinates,
    tilt: [f64; 2],
) -> Coordinates {
    const KEPT_GAP: f64 = 0.3;
    let gap = |p: Coordinates| film.minimum_gap(&with_motion(frame, p, [0.0; 4]));
    let floor = KEPT_GAP * gap(position);
    let mut under = [position[0], position[1], tilt[0], tilt[1]];
    for _ in 0..100 {
        if gap(under) >= floor {
            break;
        }
        under[0] *= 0.97;
        under[1] *= 0.97;
    }
    under
}

fn divided(vector: Coordinates, by: f64) -> Coordinates {
    vector.map(|value| value / by)
}

fn extrapolated(from: &Moving, duration: f64, slope: Coordinates) -> Coordinates {
    let moved = add(from.position, duration, from.rate);
    add(moved, 0.5 * duration * duration, slope)
}
