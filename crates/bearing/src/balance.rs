//! Where is the journal when film force, load and inertia balance?
//!
//! Equation: `force(position, rate) + load = mass x acceleration` (and `moment + load moment = 0` for
//! the tilt), at rest or at the end of an implicit time step, where
//! `rate = (position - anchor)/duration` and `acceleration = (rate - rate anchor)/duration`.
//! Unknowns: position (m) and, if asked, tilt (rad) of the journal.
//! Method: Newton with the film's tangents, one update of the film per iteration, so that the
//! cavitated set and the journal settle together. A step never takes more than a given share of the
//! smallest gap, and is halved where it made the residual much worse.
//! Reference: P. Deuflhard, Newton Methods for Nonlinear Problems, Springer 2011, ch. 3.

use crate::dense::solve;
use crate::motion::{Coordinates, add, length, with_motion};
use serde::{Deserialize, Serialize};
use sommerfeld_film::{
    Conditions, FilmError, FilmForce, JournalState, Linearised, Outcome, Step, Tangent,
};

/// A residual this much above the last one sends the step back. Interleaved film updates may raise
/// it for an iteration, so that a strict descent would only cost film updates.
const TOLERATED_GROWTH: f64 = 4.0;

/// Step reductions in a row before the iterate is kept as it is.
const LARGEST_BACKTRACKS: usize = 6;

/// Updates in a row at one position whose residual grew before a step from there is taken back: where the
/// cavitated set still changes, the growth is that of the set.
const SETTLING_UPDATES: usize = 8;

/// Ways back to wider gaps from positions where the settled film has no solution.
const LARGEST_RETREATS: usize = 8;

/// How far the journal may be from where its film was last updated, over the step tolerance, for the
/// film to show a point: its velocity and power are off by that over the duration.
const FIELD_ACCURACY: f64 = 0.1;

/// How rates follow from the unknown position.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Motion {
    /// All rates are zero.
    AtRest,
    /// End of an implicit step (or stage).
    Moving {
        /// Position to which the rate refers, m and rad.
        anchor: Coordinates,
        /// Rate to which the acceleration refers, m/s and rad/s.
        rate_anchor: Coordinates,
        /// s.
        duration: f64,
        /// kg; acts on the position only.
        mass: f64,
        /// How the film counts time.
        step: Step,
    },
}

impl Motion {
    /// Rates at a position.
    pub(crate) fn rate(&self, position: Coordinates) -> Coordinates {
        match *self {
            Self::AtRest => [0.0; 4],
            Self::Moving {
                anchor, duration, ..
            } => [0, 1, 2, 3].map(|i| (position[i] - anchor[i]) / duration),
        }
    }

    /// Accelerations at a position, m/s2 and rad/s2.
    pub(crate) fn acceleration(&self, position: Coordinates) -> Coordinates {
        match *self {
            Self::AtRest => [0.0; 4],
            Self::Moving {
                rate_anchor,
                duration,
                ..
            } => {
                let rate = self.rate(position);
                [0, 1, 2, 3].map(|i| (rate[i] - rate_anchor[i]) / duration)
            }
        }
    }

    /// Where the step that a position belongs to ends.
    fn end(&self, position: Coordinates) -> Coordinates {
        match self.step() {
            Step::Steady => position,
            Step::Implicit { after, .. } => add(position, after, self.rate(position)),
        }
    }

    fn step(&self) -> Step {
        match *self {
            Self::AtRest => Step::Steady,
            Self::Moving { step, .. } => step,
        }
    }

    /// The same motion where the tilt (rad) has this rate (rad/s), whatever the step makes of it.
    pub(crate) fn with_tilt_rate(mut self, tilt: [f64; 2], rate: [f64; 2]) -> Self {
        if let Self::Moving {
            anchor, duration, ..
        } = &mut self
        {
            for axis in 0..2 {
                anchor[axis + 2] = tilt[axis] - *duration * rate[axis];
            }
        }
        self
    }

    fn is_at_rest(&self) -> bool {
        matches!(self, Self::AtRest)
    }

    fn mass(&self) -> f64 {
        match *self {
            Self::AtRest => 0.0,
            Self::Moving { mass, .. } => mass,
        }
    }

    /// Derivative of force minus inertia by the position.
    fn total_tangent(&self, tangent: &Tangent) -> [[f64; 4]; 4] {
        let mut total = tangent.by_position;
        if let Self::Moving { duration, mass, .. } = *self {
            for (row, rates) in total.iter_mut().zip(tangent.by_rate) {
                for (value, rate) in row.iter_mut().zip(rates) {
                    *value += rate / duration;
                }
            }
            for (axis, row) in total.iter_mut().take(2).enumerate() {
                row[axis] -= mass / (duration * duration);
            }
        }
        total
    }
}

/// The balance to be found.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Balance {
    /// Load on the journal, N.
    pub load: [f64; 2],
    /// Moment on the journal, N m.
    pub moment: [f64; 2],
    /// Tilt is an unknown too.
    pub with_tilt: bool,
    /// Speeds and angles of the surfaces at this instant.
    pub frame: JournalState,
    /// How rates follow from the position.
    pub motion: Motion,
    /// Residuals are measured in this force, N.
    pub force_scale: f64,
    /// Half the bearing width, m: turns moments and tilts into forces and displacements.
    pub arm: f64,
}

/// When Newton stops.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NewtonLimits {
    /// Updates of the film.
    pub iterations: usize,
    /// Residual over the force scale.
    pub residual: f64,
    /// Next step over the smallest gap.
    pub step: f64,
    /// Largest share of the smallest gap that one step may take.
    pub gap_loss: f64,
    /// Take the last step too (without another film update; the reaction follows by its tangent).
    /// Not for films with history, whose content belongs to the position they were asked at.
    pub takes_last_step: bool,
    /// Ends only with a settled film; else also while its cavitated set still moves, for callers that come
    /// back.
    pub needs_settled: bool,
}

impl NewtonLimits {
    /// Largest last step over the smallest gap. Taken without another update, it leaves an error of the
    /// order of its square, or, where the cavitated set would change on the way, of the share by which
    /// the tangent changes with it. A third of the step bounds that share in the passages of a hole and
    /// the thinnest films of a big end (`tests/field_film.rs`).
    fn last_step(&self) -> f64 {
        if self.takes_last_step {
            3.0 * self.step
        } else {
            self.step
        }
    }
}

/// One row of the iteration table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct IterationRow {
    /// Force (and moment) that is not balanced, over the load.
    pub residual: f64,
    /// Length of the Newton step over the smallest gap.
    pub step: f64,
    /// Share of that step that was taken.
    pub taken: f64,
    /// Smallest gap, m.
    pub minimum_gap: f64,
    /// The film's cavitated set did not change.
    pub settled: bool,
}

/// Result of the Newton iteration.
#[derive(Debug, Clone)]
pub(crate) struct Balanced {
    /// Last state (or the best one, if not converged).
    pub state: JournalState,
    /// The film's answer there.
    pub linearised: Linearised,
    /// The film as it is belongs to that state: settled, and moved on by no more than
    /// [`FIELD_ACCURACY`].
    pub shows: bool,
    /// Residual over the force scale.
    pub residual: f64,
    /// One row per film update.
    pub table: Vec<IterationRow>,
    /// Film updates asked for, refused ones included.
    pub film_updates: usize,
    /// How it ended.
    pub outcome: Outcome,
}

impl Balance {
    fn size(&self) -> usize {
        if self.with_tilt { 4 } else { 2 }
    }

    fn state(&self, position: Coordinates) -> JournalState {
        with_motion(&self.frame, position, self.motion.rate(position))
    }

    /// Unbalanced force (N) and moment over the arm (N).
    pub(crate) fn residual(&self, position: Coordinates, linearised: &Linearised) -> Coordinates {
        let force = linearised.reaction.force();
        let moment = linearised.reaction.moment();
        let acceleration = self.motion.acceleration(position);
        let mass = self.motion.mass();
        let tilting = if self.with_tilt { 1.0 / self.arm } else { 0.0 };
        [
            force[0] + self.load[0] - mass * acceleration[0],
            force[1] + self.load[1] - mass * acceleration[1],
            tilting * (moment[0] + self.moment[0]),
            tilting * (moment[1] + self.moment[1]),
        ]
    }

    /// Newton step in m and rad. A film that has run empty on one side does not resist motion that
    /// way: where the step of a moving journal leaves the gap, a resistance is added that lets the
    /// residual move the journal by about half a gap (Levenberg); it fades with the residual.
    pub(crate) fn newton_step(
        &self,
        residual: Coordinates,
        tangent: &Tangent,
        gap: f64,
    ) -> Option<Coordinates> {
        let plain = self.resisted_step(residual, tangent, 0.0);
        if self.motion.is_at_rest() || plain.is_some_and(|step| length(step, self.arm) <= gap.abs())
        {
            return plain;
        }
        let size = residual.iter().map(|r| r * r).sum::<f64>().sqrt();
        self.resisted_step(residual, tangent, 2.0 * size / gap.abs())
            .or(plain)
    }

    /// Newton step with an additional resistance (N/m), solved with tilts as displacements at the
    /// bearing ends.
    fn resisted_step(
        &self,
        residual: Coordinates,
        tangent: &Tangent,
        resistance: f64,
    ) -> Option<Coordinates> {
        let mut matrix = self.motion.total_tangent(tangent);
        for (row, values) in matrix.iter_mut().enumerate() {
            for (column, value) in values.iter_mut().enumerate() {
                let tilted = usize::from(row >= 2) + usize::from(column >= 2);
                for _ in 0..tilted {
                    *value /= self.arm;
                }
            }
        }
        for (axis, row) in matrix.iter_mut().enumerate() {
            row[axis] -= resistance;
        }
        let [x, y, end_x, end_y] = solve(matrix, residual.map(|value| -value), self.size())?;
        Some([x, y, end_x / self.arm, end_y / self.arm])
    }

    /// Smallest gap at a position and at the end of its step.
    fn smallest_gap(&self, film: &dyn FilmForce, position: Coordinates) -> f64 {
        let state = self.state(position);
        let end = with_motion(&state, self.motion.end(position), [0.0; 4]);
        film.minimum_gap(&state).min(film.minimum_gap(&end))
    }

    /// Largest share (1, 1/2, 1/4, ...) of a displacement that keeps the smallest gap above
    /// `(1 - gap_loss)` of what it is at `from`.
    pub(crate) fn allowed_share(
        &self,
        film: &dyn FilmForce,
        from: Coordinates,
        displacement: Coordinates,
        gap_loss: f64,
    ) -> f64 {
        let present = self.smallest_gap(film, from);
        if present <= 0.0 {
            // Only a film with soft surfaces gets here: overlap of the rigid shapes is its business.
            return 1.0;
        }
        let floor = (1.0 - gap_loss) * present;
        let mut share = 1.0;
        for _ in 0..60 {
            let gap = self.smallest_gap(film, add(from, share, displacement));
            if gap >= floor {
                return share;
            }
            share *= 0.5;
        }
        0.0
    }

    /// Finds the balance from `start` on.
    ///
    /// # Errors
    /// What the film refuses at `start`, except a closed gap, which is `NotConverged`.
    pub(crate) fn find(
        &self,
        film: &mut dyn FilmForce,
        conditions: &Conditions<'_>,
        start: Coordinates,
        limits: &NewtonLimits,
    ) -> Result<Balanced, FilmError> {
        let mut newton = Newton::new(self, start);
        for _ in 0..limits.iterations {
            let state = self.state(newton.position);
            let answer = film.linearise(&state, self.motion.step(), conditions);
            newton.film_updates += 1;
            let linearised = match answer {
                Ok(linearised) => linearised,
                Err(FilmError::Contact { .. } | FilmError::NotFinite { .. }) => {
                    if newton.step_back(f64::INFINITY, Outcome::NotConverged) {
                        continue;
                    }
                    break;
                }
                Err(error) => return Err(error),
            };
            let residual = self.residual(newton.position, &linearised);
            let size = residual.iter().map(|r| r * r).sum::<f64>().sqrt() / self.force_scale;
            if linearised.outcome != Outcome::Converged {
                newton.keep_best(state, &linearised, f64::INFINITY);
                let outcome = linearised.outcome;
                newton.met_limit |= outcome == Outcome::NoSolution;
                if newton.step_back(f64::INFINITY, outcome)
                    || (self.motion.is_at_rest()
                        && newton.retreat(film.minimum_gap(&state), outcome))
                {
                    continue;
                }
                break;
            }
            if self.motion.is_at_rest() && newton.settles_first(size, linearised.settled) {
                continue;
            }
            if newton.step_back(size, Outcome::NotConverged) {
                continue;
            }
            newton.keep_best(state, &linearised, size);
            let gap = film.minimum_gap(&state);
            let Some(step) = self.newton_step(residual, &linearised.tangent, gap) else {
                break;
            };
            let relative_step = length(step, self.arm) / gap.abs();
            let done = (linearised.settled || !limits.needs_settled)
                && size <= limits.residual
                && relative_step <= limits.last_step();
            let taken = if done {
                f64::from(u8::from(limits.takes_last_step))
            } else {
                self.allowed_share(film, newton.position, step, limits.gap_loss)
            };
            newton.table.push(IterationRow {
                residual: size,
                step: relative_step,
                taken,
                minimum_gap: gap,
                settled: linearised.settled,
            });
            if done {
                let shows =
                    linearised.settled && taken * relative_step <= FIELD_ACCURACY * limits.step;
                let step = add([0.0; 4], taken, step);
                return Ok(self.finished(newton, linearised, size, step, shows));
            }
            newton.advance(size, add([0.0; 4], taken, step));
        }
        newton.given_up(film, self, conditions)
    }

    /// The converged state after its last (tiny) step, the reaction moved along by its tangent.
    fn finished(
        &self,
        newton: Newton,
        mut linearised: Linearised,
        residual: f64,
        step: Coordinates,
        shows: bool,
    ) -> Balanced {
        let position = add(newton.position, 1.0, step);
        let before = self.motion.rate(newton.position);
        let rate_step = add(self.motion.rate(position), -1.0, before);
        let tangent = &linearised.tangent;
        let change: Vec<f64> = (0..4)
            .map(|row| {
                (0..4)
                    .map(|column| {
                        tangent.by_position[row][column] * step[column]
                            + tangent.by_rate[row][column] * rate_step[column]
                    })
                    .sum()
            })
            .collect();
        for axis in 0..2 {
            linearised.reaction.film_force[axis] += change[axis];
            linearised.reaction.film_moment[axis] += change[axis + 2];
        }
        Balanced {
            state: self.state(position),
            linearised,
            shows,
            residual,
            table: newton.table,
            film_updates: newton.film_updates,
            outcome: Outcome::Converged,
        }
    }
}

/// Where the iteration stands.
struct Newton {
    position: Coordinates,
    /// Last accepted position with the step from there and its residual.
    previous: Option<(Coordinates, Coordinates, f64)>,
    backtracks: usize,
    /// Updates in a row at this position.
    settling: usize,
    retreats: usize,
    /// Trials were turned back by settled films without a solution.
    met_limit: bool,
    best: Option<(JournalState, Linearised, f64)>,
    /// Why the last trial was refused.
    cause: Outcome,
    table: Vec<IterationRow>,
    film_updates: usize,
    start: JournalState,
}

impl Newton {
    fn new(balance: &Balance, start: Coordinates) -> Self {
        Self {
            position: start,
            previous: None,
            backtracks: 0,
            settling: 0,
            retreats: 0,
            met_limit: false,
            best: None,
            cause: Outcome::NotConverged,
            table: Vec::new(),
            film_updates: 0,
            start: balance.state(start),
        }
    }

    /// Halves the last step if the residual grew too much or the film refused; false if the iterate
    /// is to be kept (or there is no way back).
    fn step_back(&mut self, residual: f64, cause: Outcome) -> bool {
        let refused = !residual.is_finite();
        let Some((from, step, before)) = self.previous else {
            self.cause = cause;
            return false;
        };
        if !refused && residual <= TOLERATED_GROWTH * before {
            return false;
        }
        if self.backtracks >= LARGEST_BACKTRACKS {
            self.cause = cause;
            return false;
        }
        self.backtracks += 1;
        self.settling = 0;
        let shorter = step.map(|value| 0.5 * value);
        self.position = add(from, 1.0, shorter);
        self.previous = Some((from, shorter, before));
        true
    }

    /// The residual grew while the cavitated set changed: the film is to be updated here once more before
    /// the step is judged.
    fn settles_first(&mut self, residual: f64, settled: bool) -> bool {
        let grew = self
            .previous
            .is_some_and(|(_, _, before)| residual > TOLERATED_GROWTH * before);
        if settled || !grew || self.settling >= SETTLING_UPDATES {
            return false;
        }
        self.settling += 1;
        true
    }

    /// Goes on from a gap half as wide again, where the settled film has no solution at the last accepted
    /// position either: that had been taken with a set that was not settled.
    fn retreat(&mut self, gap: f64, cause: Outcome) -> bool {
        let eccentricity = self.position[0].hypot(self.position[1]);
        let share = 0.5 * gap / eccentricity;
        if cause != Outcome::NoSolution || self.retreats >= LARGEST_RETREATS || share.is_nan() {
            return false;
        }
        self.retreats += 1;
        self.previous = None;
        self.backtracks = 0;
        for value in &mut self.position[..2] {
            *value *= (1.0 - share).clamp(0.0, 1.0);
        }
        true
    }

    fn keep_best(&mut self, state: JournalState, linearised: &Linearised, residual: f64) {
        let better = self
            .best
            .as_ref()
            .is_none_or(|(_, _, best)| residual <= *best);
        if better {
            self.best = Some((state, *linearised, residual));
        }
    }

    fn advance(&mut self, residual: f64, step: Coordinates) {
        self.previous = Some((self.position, step, residual));
        self.position = add(self.position, 1.0, step);
        self.backtracks = 0;
        self.settling = 0;
    }

    /// The best iterate, with the film updated there once more. It has no solution where the way to one
    /// led to films without.
    fn given_up(
        self,
        film: &mut dyn FilmForce,
        balance: &Balance,
        conditions: &Conditions<'_>,
    ) -> Result<Balanced, FilmError> {
        let (state, mut linearised, residual) = self.best.unwrap_or((
            self.start,
            Linearised {
                reaction: sommerfeld_film::Reaction::default(),
                tangent: Tangent::default(),
                settled: false,
                outcome: self.cause,
            },
            f64::INFINITY,
        ));
        if let Ok(again) = film.linearise(&state, balance.motion.step(), conditions) {
            linearised = again;
        }
        Ok(Balanced {
            state,
            linearised,
            shows: true,
            residual,
            table: self.table,
            film_updates: self.film_updates + 1,
            outcome: if self.met_limit && self.cause == Outcome::NotConverged {
                Outcome::NoSolution
            } else {
                self.cause
            },
        })
    }
}
