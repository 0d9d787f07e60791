//! Where does the journal rest under a steady load, and what does the film do there?
//!
//! Equation: `force + load = 0` (and `moment + load moment = 0`), all rates zero.
//! Unknowns: position (m) and, when a moment is given, tilt (rad), in the shell frame.
//! Method: Newton ([`crate::balance`]) from a start on the short-bearing path, calibrated by one
//! probe of the film at eps 0.5; where that fails, the massless journal is let to settle in implicit
//! time steps of growing length, which the damping of any film keeps inside the gap. On a soft shell,
//! whose film stays far from where it was when the journal moves by its clearance, the load is raised
//! from a light one instead.
//! References: F. W. Ocvirk, NACA TN 2808 (1952) (start value); C. T. Kelley, D. E. Keyes, SIAM J.
//! Numer. Anal. 35 (1998) 508, 10.1137/S0036142996304796 (pseudo-transient continuation).

use crate::balance::{Balance, Balanced, IterationRow, Motion, NewtonLimits};
use crate::motion::{Coordinates, add, coordinates, length, with_motion};
use serde::{Deserialize, Serialize};
use sommerfeld_film::closed_form::short;
use sommerfeld_film::{
    Bearing, Conditions, FilmError, FilmForce, FilmSummary, JournalState, Linearised, Outcome,
    Reaction, Step, Tangent,
};

/// What is to be in equilibrium.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EquilibriumRequest {
    /// Load ON the journal in the shell frame, N.
    pub load: [f64; 2],
    /// Moment ON the journal about the mid-plane shell centre, N m; `None` holds the tilt.
    pub moment: Option<[f64; 2]>,
    /// Speeds, surface angles and the held (or first) tilt; its position and rates are not used.
    pub frame: JournalState,
    /// Where to start, m, with the film as it was left; `None` looks for a start on the short-bearing path.
    pub start: Option<[f64; 2]>,
    /// When to stop.
    pub settings: EquilibriumSettings,
}

/// When the search for an equilibrium stops.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EquilibriumSettings {
    /// Largest unbalanced force over the load; default 1e-9.
    pub residual_tolerance: f64,
    /// Largest Newton step over the smallest gap that may be left out; default 1e-6.
    pub step_tolerance: f64,
    /// Film updates of one Newton iteration; default 60.
    pub iteration_limit: usize,
    /// Largest share of the smallest gap that one step may take; default 0.7.
    pub largest_gap_loss: f64,
}

impl Default for EquilibriumSettings {
    fn default() -> Self {
        Self {
            residual_tolerance: 1e-9,
            step_tolerance: 1e-6,
            iteration_limit: 60,
            largest_gap_loss: 0.7,
        }
    }
}

/// The journal at rest under its load.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// Position and tilt, shell frame; rates zero.
    pub state: JournalState,
    /// What the film puts on the journal there.
    pub reaction: Reaction,
    /// Extremes, flows, power.
    pub summary: FilmSummary,
    /// Derivatives of the reaction there.
    pub tangent: Tangent,
    /// Unbalanced force over the load.
    pub residual: f64,
    /// Newton iterations, and each of them.
    pub table: Vec<IterationRow>,
    /// Film updates of all attempts and the probe.
    pub film_updates: usize,
    /// How it ended; `NoSolution` also where surfaces at rest or in counter-rotation carry nothing.
    pub outcome: Outcome,
}

impl Equilibrium {
    /// Newton iterations of the last attempt.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.table.len()
    }

    /// Attitude angle, rad: from the load to the line of centres, positive in the sense of rotation
    /// of `+angle`, within (-pi, pi].
    #[must_use]
    pub fn attitude_angle(&self, load: [f64; 2]) -> f64 {
        let [x, y] = self.state.position;
        (load[0] * y - load[1] * x).atan2(load[0] * x + load[1] * y)
    }
}

/// Smallest load scale over stiffness times clearance: an unloaded journal is in equilibrium when
/// its residual is this small.
const UNLOADED_SHARE: f64 = 1e-6;

/// First share of the load where it is raised: films of soft shells are wide open under it.
const LIGHT_LOAD: f64 = 0.02;

/// Longest step of the journal over the clearance while a settled film is followed.
const LARGEST_STRIDE: f64 = 0.03;

/// Unbalanced force over the load where following hands over to the interleaved search.
const FOLLOWED: f64 = 1e-6;

/// Settled films on the way to one equilibrium: across the clearance and some of Newton's.
const FOLLOWING_STEPS: usize = 50;

/// Equilibria on the way to the whole load.
const RAISING_STEPS: usize = 40;

/// Longest search by settling in time, in implicit steps.
const SETTLING_STEPS: usize = 80;

/// Finds the equilibrium of `film` under the requested load. The film is left as linearised there.
///
/// # Errors
/// [`FilmError`] for what the film refuses (tilt, values that are not finite). No equilibrium, no
/// oil or no convergence is an [`Outcome`].
pub fn find_equilibrium(
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    request: &EquilibriumRequest,
    conditions: &Conditions<'_>,
) -> Result<Equilibrium, FilmError> {
    let once = Round {
        start: None,
        goes_on: false,
    };
    search_from(film, bearing, request, conditions, &once)
}

/// Where and how a search for one of a row of equilibria begins.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Round {
    /// Where the journal may be: without a probe of the film elsewhere. `None` in the first round.
    pub start: Option<Coordinates>,
    /// The row goes on: the film need not be settled, the journal is where the last step leads, of which the
    /// film does not know yet, and nobody asks for a summary.
    pub goes_on: bool,
}

/// [`find_equilibrium`] as one of a row in which the film changes.
pub(crate) fn find_in_round(
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    request: &EquilibriumRequest,
    conditions: &Conditions<'_>,
    round: &Round,
) -> Result<Equilibrium, FilmError> {
    search_from(film, bearing, request, conditions, round)
}

fn search_from(
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    request: &EquilibriumRequest,
    conditions: &Conditions<'_>,
    round: &Round,
) -> Result<Equilibrium, FilmError> {
    let mut search = Search {
        balance: Balance {
            load: request.load,
            moment: request.moment.unwrap_or_default(),
            with_tilt: request.moment.is_some(),
            frame: with_motion(&request.frame, coordinates(&request.frame), [0.0; 4]),
            motion: Motion::AtRest,
            force_scale: request.load[0].hypot(request.load[1]),
            arm: 0.5 * bearing.width,
        },
        limits: NewtonLimits {
            iterations: request.settings.iteration_limit,
            residual: request.settings.residual_tolerance,
            step: request.settings.step_tolerance,
            gap_loss: request.settings.largest_gap_loss,
            takes_last_step: round.goes_on,
            needs_settled: !round.goes_on,
        },
        clearance: bearing.radial_clearance,
        conditions,
    };
    let mut probes = 0;
    let start = match round.start {
        Some(start) if search.balance.force_scale > 0.0 => start,
        _ => match search.start(film, request)? {
            Start::At(start) => {
                probes = 1;
                start
            }
            Start::Nowhere(outcome) => return Ok(search.failed(film, outcome)),
        },
    };
    let is_soft = bearing.elasticity.compliance() > 0.0;
    let found = if is_soft {
        search.find_on_soft_shell(film, start, request.start.is_some())?
    } else {
        search.find(film, start)?
    };
    Ok(Equilibrium {
        state: found.state,
        reaction: found.linearised.reaction,
        summary: if round.goes_on {
            FilmSummary::default()
        } else {
            film.summary()
        },
        tangent: found.linearised.tangent,
        residual: found.residual,
        table: found.table,
        film_updates: found.film_updates + probes,
        outcome: found.outcome,
    })
}

/// Where the search begins.
enum Start {
    At(Coordinates),
    Nowhere(Outcome),
}

struct Search<'a> {
    balance: Balance,
    limits: NewtonLimits,
    clearance: f64,
    conditions: &'a Conditions<'a>,
}

impl Search<'_> {
    /// Start position: the given one, or on the short-bearing path after one probe of the film,
    /// which also sets the force scale of an unloaded journal.
    fn start(
        &mut self,
        film: &mut dyn FilmForce,
        request: &EquilibriumRequest,
    ) -> Result<Start, FilmError> {
        let [load_x, load_y] = self.balance.load;
        let load = load_x.hypot(load_y);
        let sense = if request.frame.mean_speed() < 0.0 {
            -1.0
        } else {
            1.0
        };
        let load_angle = load_y.atan2(load_x);
        let given = request.start.map(|[x, y]| {
            let [tilt_x, tilt_y] = self.balance.frame.tilt;
            self.inside(film, [x, y, tilt_x, tilt_y])
        });
        if let (Some(start), true) = (given, load > 0.0) {
            return Ok(Start::At(start));
        }
        let probe_eps: f64 = 0.5;
        let probe = self.inside(film, self.on_path(probe_eps, load_angle, sense));
        let state = with_motion(&self.balance.frame, probe, [0.0; 4]);
        let answer = film.react(&state, Step::Steady, self.conditions)?;
        if answer.outcome == Outcome::Starved {
            return Ok(Start::Nowhere(answer.outcome));
        }
        let stiffness = answer
            .tangent
            .by_position
            .iter()
            .take(2)
            .flat_map(|row| &row[..2])
            .fold(0.0, |largest: f64, value| largest.max(value.abs()));
        self.balance.force_scale = load.max(UNLOADED_SHARE * stiffness * self.clearance);
        if let Some(start) = given {
            return Ok(Start::At(start));
        }
        let force = answer.reaction.force();
        let size = force[0].hypot(force[1]);
        if load > 0.0 && size <= 1e-9 * load && request.frame.mean_speed() == 0.0 {
            return Ok(Start::Nowhere(Outcome::NoSolution));
        }
        let eps = match answer.outcome {
            Outcome::Converged if size > 0.0 => {
                short_eccentricity(load / size * path_force(probe_eps))
            }
            _ => 0.2,
        };
        Ok(Start::At(
            self.inside(film, self.on_path(eps, load_angle, sense)),
        ))
    }

    /// Point of the short-bearing path (Ocvirk's attitude angle) with the held tilt.
    fn on_path(&self, eps: f64, load_angle: f64, sense: f64) -> Coordinates {
        let [along, across] = short::ocvirk_force(eps);
        let attitude = if eps == 0.0 {
            0.0
        } else {
            across.atan2(-along)
        };
        let (sin, cos) = (load_angle + sense * attitude).sin_cos();
        let distance = eps * self.clearance;
        let [tilt_x, tilt_y] = self.balance.frame.tilt;
        [distance * cos, distance * sin, tilt_x, tilt_y]
    }

    /// Moves a position towards the centre until at least a thousandth of the clearance is open at
    /// the narrower end too (a tilted journal closes earlier), or half of what the centre has.
    fn inside(&self, film: &dyn FilmForce, position: Coordinates) -> Coordinates {
        let state = |p: Coordinates| with_motion(&self.balance.frame, p, [0.0; 4]);
        let plain_gap = self.clearance - position[0].hypot(position[1]);
        let mut inside = position;
        for _ in 0..60 {
            if film.minimum_gap(&state(inside)) >= 0.5 * plain_gap {
                break;
            }
            inside[0] *= 0.9;
            inside[1] *= 0.9;
        }
        inside
    }

    /// Newton, and where it fails the journal left to settle.
    fn find(&self, film: &mut dyn FilmForce, start: Coordinates) -> Result<Balanced, FilmError> {
        let found = self
            .balance
            .find(film, self.conditions, start, &self.limits)?;
        match found.outcome {
            Outcome::Converged => Ok(found),
            _ => self.settle(film, start, found),
        }
    }

    /// The same on a soft shell: a start that was given is followed with settled films, one that was not is
    /// left to Newton first, and then the load is raised.
    fn find_on_soft_shell(
        &self,
        film: &mut dyn FilmForce,
        start: Coordinates,
        is_given: bool,
    ) -> Result<Balanced, FilmError> {
        let mut updates = 0;
        let mut near = start;
        if is_given && let Some(at) = self.follow(film, &self.balance, start, &mut updates)? {
            near = at;
        }
        let mut found = self
            .balance
            .find(film, self.conditions, near, &self.limits)?;
        if found.outcome != Outcome::Converged {
            updates += found.film_updates;
            found = match self.raise(film, &mut updates)? {
                Some(raised) => self.find(film, raised)?,
                None => self.find(film, start)?,
            };
        }
        found.film_updates += updates;
        Ok(found)
    }

    /// The film at a state, updated until its cavitated set and its shell rest; `None` where it has no
    /// answer. Counts the updates.
    fn settled(
        &self,
        film: &mut dyn FilmForce,
        state: &JournalState,
        updates: &mut usize,
    ) -> Result<Option<Linearised>, FilmError> {
        for _ in 0..film.capabilities().iteration_limit {
            *updates += 1;
            match film.linearise(state, Step::Steady, self.conditions) {
                Ok(seen) if seen.outcome != Outcome::Converged => return Ok(None),
                Ok(seen) if seen.settled => return Ok(Some(seen)),
                Ok(_) => {}
                Err(FilmError::Contact { .. } | FilmError::NotFinite { .. }) => return Ok(None),
                Err(error) => return Err(error),
            }
        }
        Ok(None)
    }

    /// Follows Newton with films settled at every position, in steps of [`LARGEST_STRIDE`] at most.
    /// `None` where it does not arrive.
    fn follow(
        &self,
        film: &mut dyn FilmForce,
        balance: &Balance,
        from: Coordinates,
        updates: &mut usize,
    ) -> Result<Option<Coordinates>, FilmError> {
        let mut position = from;
        for _ in 0..FOLLOWING_STEPS {
            let state = with_motion(&balance.frame, position, [0.0; 4]);
            let Some(settled) = self.settled(film, &state, updates)? else {
                break;
            };
            let residual = balance.residual(position, &settled);
            let size = residual.iter().map(|r| r * r).sum::<f64>().sqrt();
            if size <= FOLLOWED * balance.force_scale {
                return Ok(Some(position));
            }
            let gap = film.minimum_gap(&state);
            let Some(step) = balance.newton_step(residual, &settled.tangent, gap) else {
                break;
            };
            let stride = length(step, balance.arm);
            let share = f64::min(1.0, LARGEST_STRIDE * self.clearance / stride);
            position = add(position, share, step);
        }
        Ok(None)
    }

    /// Raises the load from a light one, each equilibrium the start of the next, in steps that grow while
    /// Newton follows and shrink where it does not. `None` where it does not arrive at the whole load.
    fn raise(
        &self,
        film: &mut dyn FilmForce,
        updates: &mut usize,
    ) -> Result<Option<Coordinates>, FilmError> {
        let sense = self.balance.frame.mean_speed().signum();
        let [load_x, load_y] = self.balance.load;
        let mut position = self.on_path(0.5, load_y.atan2(load_x), sense);
        let (mut share, mut step) = (0.0, LIGHT_LOAD);
        for _ in 0..RAISING_STEPS {
            let next = f64::min(share + step, 1.0);
            let part = |value: f64| next * value;
            let balance = Balance {
                load: self.balance.load.map(part),
                moment: self.balance.moment.map(part),
                force_scale: part(self.balance.force_scale),
                ..self.balance
            };
            match self.follow(film, &balance, position, updates)? {
                Some(found) => {
                    position = found;
                    (share, step) = (next, 1.5 * step);
                    if share >= 1.0 {
                        return Ok(Some(position));
                    }
                }
                None => step *= 0.5,
            }
        }
        Ok(None)
    }

    /// Lets the massless journal settle in implicit time steps, then tries Newton again.
    fn settle(
        &self,
        film: &mut dyn FilmForce,
        start: Coordinates,
        first: Balanced,
    ) -> Result<Balanced, FilmError> {
        let speed = self.balance.frame.mean_speed().abs();
        if speed == 0.0 {
            return Ok(first);
        }
        let mut duration = 0.1 / speed;
        let mut position = start.map(|value| 0.7 * value);
        position[2] = start[2];
        position[3] = start[3];
        let mut last = first;
        let mut film_updates = last.film_updates;
        for step in 0..SETTLING_STEPS {
            let mut balance = self.balance;
            balance.motion = Motion::Moving {
                anchor: position,
                rate_anchor: [0.0; 4],
                duration,
                mass: 0.0,
                step: Step::Steady,
            };
            let limits = NewtonLimits {
                residual: 1e-3,
                step: 1e-2,
                ..self.limits
            };
            let moved = balance.find(film, self.conditions, position, &limits)?;
            film_updates += moved.film_updates;
            if moved.outcome == Outcome::Converged {
                position = coordinates(&moved.state);
                duration *= 2.0;
            } else {
                duration *= 0.25;
            }
            if step % 6 == 5 || duration * speed > 1e3 {
                last = self
                    .balance
                    .find(film, self.conditions, position, &self.limits)?;
                film_updates += last.film_updates;
                last.film_updates = film_updates;
                if last.outcome == Outcome::Converged || duration * speed > 1e6 {
                    return Ok(last);
                }
            }
            if duration * speed < 1e-6 {
                break;
            }
        }
        Ok(last)
    }

    /// No start was found: the probe's reaction with its outcome.
    fn failed(&self, film: &mut dyn FilmForce, outcome: Outcome) -> Equilibrium {
        Equilibrium {
            state: self.balance.frame,
            reaction: Reaction::default(),
            summary: film.summary(),
            tangent: Tangent::default(),
            residual: f64::INFINITY,
            table: Vec::new(),
            film_updates: 1,
            outcome,
        }
    }
}

/// Ocvirk's scaled force at an eccentricity.
fn path_force(eps: f64) -> f64 {
    let [along, across] = short::ocvirk_force(eps);
    along.hypot(across)
}

/// Eccentricity at which Ocvirk's scaled force is `force`.
fn short_eccentricity(force: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0 - 1e-9);
    for _ in 0..60 {
        let eps = 0.5 * (low + high);
        if path_force(eps) < force {
            low = eps;
        } else {
            high = eps;
        }
    }
    0.5 * (low + high)
}
