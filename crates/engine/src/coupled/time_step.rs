//! Where are all journals one time step later?
//!
//! Equation: the balance of [`super::balance`], an implicit equation for the rates of displacement.
//! Films without history: TR-BDF2 ([`sommerfeld_bearing::motion`]); with history: the implicit midpoint
//! rule, the film content from the start of the step to its end. As for one journal on a given load
//! ([`sommerfeld_bearing::journal_orbit`]), with one step for all journals: the journal with the
//! largest error relative to its gap decides. Tilts that no film answers follow from the shaft alone
//! and count in no error.

use super::balance::{Balance, Balanced, Limits, Stage};
use super::film_update::{FilmExecutor, Place, answers};
use super::shaft::Structure;
use sommerfeld_bearing::motion::{
    Coordinates, DIAGONAL, ERROR_WEIGHTS, FIRST_STAGE, WEIGHT, add, coordinates,
};
use sommerfeld_film::{FilmError, JournalState, Linearised, Outcome, Step};

/// All journals in motion.
#[derive(Clone)]
pub(super) struct Moving {
    /// Rad, counted on over the cycles.
    pub crank_angle: f64,
    /// m and rad.
    pub positions: Vec<Coordinates>,
    /// m/s and rad/s.
    pub rates: Vec<Coordinates>,
    /// Change of the rates per time, m/s2 and rad/s2, for extrapolation.
    pub slopes: Vec<Coordinates>,
    /// Length of the step that led here, s; 0 at the start.
    pub duration: f64,
    /// The rates are those of the motion, not mere start values.
    pub rate_is_known: bool,
}

/// A tried step.
pub(super) struct Trial {
    pub end: Moving,
    pub states: Vec<JournalState>,
    pub linearised: Vec<Linearised>,
    /// What the shaft puts on each journal: force (N), moment (N m).
    pub loads: Vec<[f64; 4]>,
    /// How far each journal moved since the last update of its film, over its gap.
    pub moved: Vec<f64>,
    /// Sum of the loads less that of the given forces, N.
    pub unbalance: f64,
    /// Largest estimated error of a position over the smallest gap there.
    pub error: f64,
    pub outcome: Outcome,
}

/// What all steps of a run share.
pub(super) struct Stepper<'a> {
    pub structure: Structure<'a>,
    pub places: Vec<Place<'a>>,
    pub executor: &'a FilmExecutor<'a>,
    /// Crank speed, rad/s.
    pub engine_speed: f64,
    /// N.
    pub force_scale: f64,
    pub limits: Limits,
    pub has_history: bool,
}

/// The film of a point belongs to a position within this share of the gap from that of the journal.
const FIELD_ACCURACY: f64 = 1e-4;

/// `a + factor b` for every journal.
pub(super) fn add_all(a: &[Coordinates], factor: f64, b: &[Coordinates]) -> Vec<Coordinates> {
    a.iter().zip(b).map(|(a, b)| add(*a, factor, *b)).collect()
}

/// `(a - b) / by` for every journal.
fn difference(a: &[Coordinates], b: &[Coordinates], by: f64) -> Vec<Coordinates> {
    let each = a.iter().zip(b);
    each.map(|(a, b)| add(*a, -1.0, *b).map(|value| value / by))
        .collect()
}

impl Stepper<'_> {
    /// One step of `angle` (rad of crank angle) from `from`.
    pub(super) fn try_step(&mut self, from: &Moving, angle: f64) -> Result<Trial, FilmError> {
        if self.has_history {
            self.midpoint(from, angle)
        } else {
            self.second_order(from, angle)
        }
    }

    fn second_order(&mut self, from: &Moving, angle: f64) -> Result<Trial, FilmError> {
        let duration = angle / self.engine_speed;
        let middle_stage = Stage {
            crank_angle: from.crank_angle + FIRST_STAGE * angle,
            anchors: add_all(&from.positions, DIAGONAL * duration, &from.rates),
            duration: DIAGONAL * duration,
            step: Step::Steady,
        };
        let guess = extrapolated(from, FIRST_STAGE * duration, &from.slopes);
        let (middle, unbalance) = self.solve(&middle_stage, &from.positions, &guess)?;
        if middle.outcome != Outcome::Converged {
            return Ok(trial(
                from,
                angle,
                duration,
                middle,
                &middle_stage,
                unbalance,
            ));
        }
        let middle_rates = middle_stage.rates(&middle.positions);

        let both = add_all(&from.rates, 1.0, &middle_rates);
        let stage = Stage {
            crank_angle: from.crank_angle + angle,
            anchors: add_all(&from.positions, WEIGHT * duration, &both),
            duration: DIAGONAL * duration,
            step: Step::Steady,
        };
        let slopes = difference(&middle_rates, &from.rates, FIRST_STAGE * duration);
        let guess = extrapolated(from, duration, &slopes);
        let (end, unbalance) = self.solve(&stage, &from.positions, &guess)?;
        let mut trial = trial(from, angle, duration, end, &stage, unbalance);
        let rates = [&from.rates, &middle_rates, &trial.end.rates];
        let errors: Vec<Coordinates> = (0..self.places.len())
            .map(|journal| {
                ERROR_WEIGHTS
                    .iter()
                    .zip(rates)
                    .fold([0.0; 4], |sum, (weight, rates)| {
                        add(sum, weight * duration, rates[journal])
                    })
            })
            .collect();
        trial.error = self.largest_share_of_gap(&errors, from, &trial.end);
        let rest = (1.0 - FIRST_STAGE) * duration;
        trial.end.slopes = difference(&trial.end.rates, &middle_rates, rest);
        Ok(trial)
    }

    fn midpoint(&mut self, from: &Moving, angle: f64) -> Result<Trial, FilmError> {
        let duration = angle / self.engine_speed;
        let half = 0.5 * duration;
        let stage = Stage {
            crank_angle: from.crank_angle + 0.5 * angle,
            anchors: from.positions.clone(),
            duration: half,
            step: Step::Implicit {
                duration,
                after: half,
            },
        };
        // The rate is that in the middle of the step before.
        let since = half + 0.5 * from.duration;
        let rates = add_all(&from.rates, since, &from.slopes);
        let guess = add_all(&from.positions, half, &rates);
        let (middle, unbalance) = self.solve(&stage, &from.positions, &guess)?;
        let mut trial = trial(from, angle, duration, middle, &stage, unbalance);
        trial.end.positions = add_all(&from.positions, duration, &trial.end.rates);
        trial.end.slopes = if from.rate_is_known {
            difference(&trial.end.rates, &from.rates, since)
        } else {
            vec![[0.0; 4]; self.places.len()]
        };
        if from.rate_is_known {
            let mut bends = difference(&trial.end.slopes, &from.slopes, 1.0);
            for value in bends.iter_mut().flatten() {
                *value *= duration * duration / 24.0;
            }
            trial.error = self.largest_share_of_gap(&bends, from, &trial.end);
        }
        Ok(trial)
    }

    /// Rates at the start (films without history), from an implicit step so short that the positions
    /// stay.
    pub(super) fn start_motion(&mut self, start: &Moving, angle: f64) -> Result<Trial, FilmError> {
        let duration = 1e-3 * angle / self.engine_speed;
        let stage = Stage {
            crank_angle: start.crank_angle,
            anchors: start.positions.clone(),
            duration,
            step: Step::Steady,
        };
        let tolerance = self.limits.step;
        self.limits.step *= 1e-4;
        let found = self.solve(&stage, &start.positions, &start.positions);
        self.limits.step = tolerance;
        let (found, unbalance) = found?;
        let mut trial = trial(start, 0.0, 0.0, found, &stage, unbalance);
        trial.end.positions.clone_from(&start.positions);
        Ok(trial)
    }

    /// Updates the films that are to be shown and were last updated elsewhere.
    pub(super) fn refresh(&mut self, trial: &mut Trial) -> Result<(), FilmError> {
        let is_stale = |journal: &usize| trial.moved[*journal] > FIELD_ACCURACY;
        let stale: Vec<usize> = (0..self.places.len()).filter(is_stale).collect();
        let crank_angle = trial.end.crank_angle;
        let updates = self
            .places
            .iter_mut()
            .enumerate()
            .filter(|(journal, _)| stale.binary_search(journal).is_ok())
            .map(|(journal, place)| place.update(trial.states[journal], Step::Steady, crank_angle))
            .collect();
        for (journal, answer) in stale.into_iter().zip(answers(updates, self.executor)) {
            match answer {
                Ok(linearised) => trial.linearised[journal] = linearised,
                // So close to contact what the film said last stands.
                Err(FilmError::Contact { .. }) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// The balance of a stage, from a guess that keeps the gaps of safe positions open, and what is
    /// missing in the sum of the loads, N.
    pub(super) fn solve(
        &mut self,
        stage: &Stage,
        safe: &[Coordinates],
        guess: &[Coordinates],
    ) -> Result<(Balanced, f64), FilmError> {
        let instant = self.structure.at(stage.crank_angle)?;
        let balance = Balance {
            structure: &self.structure,
            instant: &instant,
            stage,
            force_scale: self.force_scale,
            limits: self.limits,
            executor: self.executor,
        };
        let jump = difference(guess, safe, 1.0);
        let share = balance.allowed_share(&self.places, safe, &jump, None);
        let start = add_all(safe, share, &jump);
        let found = balance.find(&mut self.places, start)?;
        let missing = [0, 1].map(|axis| {
            let sum: f64 = found.loads.iter().map(|load| load[axis]).sum();
            sum - instant.resultant[axis]
        });
        Ok((found, missing[0].hypot(missing[1])))
    }

    /// Largest size of a displacement over the journal's smallest gap.
    fn largest_share_of_gap(&self, errors: &[Coordinates], from: &Moving, end: &Moving) -> f64 {
        let each = self.places.iter().zip(errors).enumerate();
        each.map(|(journal, (place, error))| {
            let start = place.gap(from.crank_angle, from.positions[journal]);
            let end = place.gap(end.crank_angle, end.positions[journal]);
            place.length(*error) / start.min(end).abs()
        })
        .fold(0.0, f64::max)
    }
}

impl Stage {
    /// Rates at given positions.
    fn rates(&self, positions: &[Coordinates]) -> Vec<Coordinates> {
        difference(positions, &self.anchors, self.duration)
    }
}

fn trial(
    from: &Moving,
    angle: f64,
    duration: f64,
    balanced: Balanced,
    stage: &Stage,
    unbalance: f64,
) -> Trial {
    Trial {
        end: Moving {
            crank_angle: from.crank_angle + angle,
            rates: stage.rates(&balanced.positions),
            slopes: vec![[0.0; 4]; balanced.positions.len()],
            positions: balanced.positions,
            duration,
            rate_is_known: balanced.outcome == Outcome::Converged,
        },
        states: balanced.states,
        linearised: balanced.linearised,
        loads: balanced.loads,
        moved: balanced.moved,
        unbalance,
        error: 0.0,
        outcome: balanced.outcome,
    }
}

fn extrapolated(from: &Moving, duration: f64, slopes: &[Coordinates]) -> Vec<Coordinates> {
    let moved = add_all(&from.positions, duration, &from.rates);
    add_all(&moved, 0.5 * duration * duration, slopes)
}

impl Trial {
    /// The same at rest where it is, for a step that did not converge; journals whose gap is not a
    /// number stay where they were.
    pub(super) fn at_rest(mut self, from: &Moving, places: &[Place<'_>]) -> Self {
        for (journal, place) in places.iter().enumerate() {
            let gap = place.gap(self.end.crank_angle, coordinates(&self.states[journal]));
            if !gap.is_finite() {
                self.end.positions[journal] = from.positions[journal];
            }
            let position = self.end.positions[journal];
            self.states[journal] = place.state(self.end.crank_angle, position, [0.0; 4]);
        }
        self.end.rates.fill([0.0; 4]);
        self.end.slopes.fill([0.0; 4]);
        self.end.rate_is_known = false;
        self
    }
}
