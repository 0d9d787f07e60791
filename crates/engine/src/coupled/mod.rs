//! Which orbits do the journals of one elastic shaft run, when its films share its loads?
//!
//! Equation: `K(theta) (d + o - C F) = f(theta) + F(d, d', film content)` at every crank angle, with
//! displacements and tilts at the end of the period as at its start. `K` is the stiffness of the shaft
//! condensed onto its journals (singular: the films hold it), `f` the given forces as they reach the
//! journals, `C` the compliance of the supports, `o` where the bores lie.
//! Unknowns: displacement (m) and tilt (rad) `d` of each journal in its shell.
//! Method: implicit in time ([`time_step`]), the same steps for all journals, adapted inside each output
//! crank step; shaft, films and supports brought to balance by one interleaved Newton ([`balance`]);
//! cycles are run until two successive ones agree. A cold start lets the shaft settle under the load of
//! the first crank angle ([`start`]).
//! Assumptions: massless shaft and shells, small displacements, linear supports. A film without tilt
//! passes no moment: there the shaft tilts as it likes.
//! References: Z. P. Mourelatos, Comput. Struct. 79 (2001) 2009 (crankshaft, block and films
//! together); P. K. Goenka, J. Tribol. 106 (1984) 421, 10.1115/1.3260949 (one journal).

mod balance;
mod film_update;
mod shaft;
mod start;
mod time_step;

pub use film_update::{FilmExecutor, FilmUpdate, in_sequence};

use balance::Limits;
use film_update::Place;
use nalgebra::DMatrix;
use shaft::Structure;
use sommerfeld_bearing::motion::{add, coordinates};
use sommerfeld_bearing::{
    CyclePoint, CycleTilt, JournalOrbit, LoadCycle, LoadPoint, OrbitSettings, Progress, Substeps,
};
use sommerfeld_film::{Bearing, Conditions, FilmError, FilmForce, JournalState, Outcome};
use sommerfeld_flex::CondensedShaft;
use std::ops::ControlFlow;
use time_step::{Moving, Stepper, Trial};

/// Usual [`OrbitSettings::error_tolerance`] of films without history on one shaft. The journal nearest to
/// contact sets the step of all: an inline six with films of 0.2 to 1.6 um keeps its smallest films to
/// 1e-3 and loads to 1e-5 against a tenth of it, with 0.6 times the film updates.
pub const COUPLED_ERROR_TOLERANCE: f64 = 1e-3;

/// Forces on the shaft at a crank angle (rad, any turn): x, y (N, fixed frame) at each place of load.
pub type ShaftForces<'a> = dyn Fn(f64) -> Vec<[f64; 2]> + 'a;

/// One journal of the shaft in its bearing.
pub struct CoupledJournal<'a> {
    /// Its film. One that accepts no tilt passes no moment.
    pub film: &'a mut (dyn FilmForce + Send + 'a),
    /// Its bearing.
    pub bearing: &'a Bearing,
    /// Speeds of journal and shell, supply pressures, period and crank speed. Loads, mass and tilt of
    /// this cycle are not used: the shaft gives the loads, and the film says whether it tilts.
    pub duty: &'a LoadCycle,
    /// Temperature, and feed pressures where they differ from the bearing's.
    pub conditions: Conditions<'a>,
    /// Where the bore lies against the common line, m.
    pub offset: [f64; 2],
}

/// What the journals have in common.
#[derive(Clone, Copy)]
pub struct CoupledRequest<'a> {
    /// The shaft; it has turned by the crank angle.
    pub shaft: &'a CondensedShaft,
    /// Displacements and tilts of the shells over the forces and moments on them, x, y (m/N) and tilt
    /// about x, y (rad/(N m)) of journal 1, then of journal 2, ...; `None` for rigid supports.
    pub compliance: Option<&'a DMatrix<f64>>,
    /// Forces on the shaft at its places of load.
    pub forces: &'a ShaftForces<'a>,
    /// How the orbits are computed; the start is not used.
    pub settings: &'a OrbitSettings,
    /// Runs updates of films side by side, or [`in_sequence`].
    pub executor: &'a FilmExecutor<'a>,
}

/// The orbits of all journals over the last computed cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct CoupledOrbits {
    /// Of each journal. The load of a point is what the shaft puts on the journal.
    pub orbits: Vec<JournalOrbit>,
    /// These loads and the speeds of each journal, as a load table of one period.
    pub cycles: Vec<LoadCycle>,
    /// Largest difference between the sum of the loads on the journals and that of the given forces
    /// over the largest load; of the points that converged.
    pub resultant_error: f64,
    /// Converged only if every step and the closure of every orbit did.
    pub outcome: Outcome,
}

/// Sees every output point of every journal in turn, with its number and the film there (fields
/// included), and may ask to stop.
pub type CoupledObserver<'a> =
    dyn FnMut(usize, &CyclePoint, &dyn FilmForce, Progress) -> ControlFlow<()> + 'a;

/// From this level of division on, a substep that fails is tried once more with patience.
const PATIENT_LEVEL: u32 = 1;

/// Refused substeps at the finest level before the rest of an output crank step is given up.
const LARGEST_FAILURES: usize = 3;

/// Output points in a row that may fail before the run is given up.
const LARGEST_FAILED_POINTS: usize = 10;

/// Limits for a journal that crosses an emptied gap: nothing holds it until it meets oil again, so
/// that a shorter time step does not help, but many small Newton steps do.
fn patient(limits: &Limits) -> Limits {
    Limits {
        iterations: 6 * limits.iterations,
        gap_loss: 0.4 * limits.gap_loss,
        ..*limits
    }
}

/// Runs the journals of a shaft through its load cycle until their orbits close.
///
/// Points that do not converge are marked and passed over; where a film starves or has no solution, or
/// the observer stops the run, the points of the unfinished cycle come back with
/// [`Outcome::Starved`], [`Outcome::NoSolution`] or [`Outcome::NotConverged`].
///
/// # Errors
/// [`FilmError::Unsupported`] for sizes or periods that do not fit together and a shaft that its films
/// cannot hold; [`FilmError::NotFinite`] for values that are no numbers; and what a film refuses.
pub fn coupled_orbits<'a>(
    journals: Vec<CoupledJournal<'a>>,
    request: &CoupledRequest<'a>,
    observer: &mut CoupledObserver<'_>,
) -> Result<CoupledOrbits, FilmError> {
    coupled_orbits_from(journals, None, request, observer)
}

/// [`coupled_orbits`] from given states of the journals (position and tilt) and the content that the
/// films remember: those of the last point of an orbit that differs little.
///
/// # Errors
/// As [`coupled_orbits`]; [`FilmError::Unsupported`] for another number of states than journals.
pub fn coupled_orbits_from<'a>(
    journals: Vec<CoupledJournal<'a>>,
    starts: Option<&[JournalState]>,
    request: &CoupledRequest<'a>,
    observer: &mut CoupledObserver<'_>,
) -> Result<CoupledOrbits, FilmError> {
    if starts.is_some_and(|starts| starts.len() != journals.len()) {
        return Err(FilmError::Unsupported {
            reason: "each journal of a shaft needs a state to start from",
        });
    }
    let duties: Vec<&LoadCycle> = journals.iter().map(|journal| journal.duty).collect();
    let settings = request.settings;
    let mut run = Run::new(journals, &duties, request)?;
    if let Some(outcome) = run.start(starts, observer)? {
        return Ok(run.result(&duties, 1, f64::NAN, outcome));
    }
    let mut closure = f64::NAN;
    for number in 1..=settings.cycle_limit.max(1) {
        let before = run.begin_cycle();
        if let Some(outcome) = run.cycle(number, observer)? {
            return Ok(run.result(&duties, number, closure, outcome));
        }
        closure = run.closure(&before, number).unwrap_or(closure);
        if closure < settings.closure_tolerance {
            let outcome = run.outcome();
            return Ok(run.result(&duties, number, closure, outcome));
        }
    }
    let cycles = settings.cycle_limit.max(1);
    Ok(run.result(&duties, cycles, closure, Outcome::NotConverged))
}

/// A run in progress.
struct Run<'a> {
    settings: &'a OrbitSettings,
    stepper: Stepper<'a>,
    substeps: Substeps,
    /// Crank angle of the first point and of one output step, rad; their number per period.
    first_angle: f64,
    crank_step: f64,
    count: usize,
    moving: Moving,
    /// Points of the present cycle, of each journal.
    points: Vec<Vec<CyclePoint>>,
    /// Nothing changes over the period.
    is_constant: bool,
    steps: usize,
    failed_points: usize,
    /// A substep since the last point did not converge.
    failed_since: bool,
    /// Largest difference between the sum of the loads and that of the given forces, N.
    largest_unbalance: f64,
}

impl<'a> Run<'a> {
    fn new(
        journals: Vec<CoupledJournal<'a>>,
        duties: &[&LoadCycle],
        request: &CoupledRequest<'a>,
    ) -> Result<Self, FilmError> {
        let settings = request.settings;
        check(duties, settings)?;
        let places: Vec<Place<'a>> = journals
            .into_iter()
            .map(Place::new)
            .collect::<Result<_, _>>()?;
        if let [only] = places.as_slice()
            && !only.with_tilt
        {
            return Err(FilmError::Unsupported {
                reason: "a shaft in one bearing needs a film that answers to tilt",
            });
        }
        let structure = Structure::new(request, &places)?;
        let cycle = duties[0];
        let count = settings.points_per_cycle(cycle);
        let crank_step = cycle.period / count as f64;
        let first_angle = places[0].table.first_angle();
        let has_history = places
            .iter()
            .any(|place| place.film.capabilities().has_history);
        let loads = (0..count).map(|k| structure.at(first_angle + k as f64 * crank_step));
        let loads: Vec<_> = loads
            .map(|at| at.map(|at| at.loads))
            .collect::<Result<_, _>>()?;
        let force_scale = loads.iter().map(|load| load.amax()).fold(0.0, f64::max);
        let same = |load: &nalgebra::DVector<f64>| (load - &loads[0]).amax() <= 1e-12 * force_scale;
        let is_constant =
            loads.iter().all(same) && places.iter().all(|place| place.table.is_constant());
        let stepper = Stepper {
            structure,
            executor: request.executor,
            engine_speed: cycle.engine_speed,
            force_scale: force_scale.max(f64::MIN_POSITIVE),
            limits: Limits {
                iterations: settings.iteration_limit,
                // The last step lets it fall with its square.
                residual: if has_history { 1e-3 } else { 1e-2 },
                step: if has_history {
                    settings.history_newton_tolerance
                } else {
                    settings.newton_tolerance
                },
                gap_loss: settings.largest_gap_loss,
                takes_last_step: !has_history,
            },
            has_history,
            places,
        };
        let still = vec![[0.0; 4]; stepper.places.len()];
        Ok(Self {
            settings,
            substeps: Substeps::new(settings.largest_divisions.min(20)),
            first_angle,
            crank_step,
            count,
            moving: Moving {
                crank_angle: first_angle,
                positions: still.clone(),
                rates: still.clone(),
                slopes: still,
                duration: 0.0,
                rate_is_known: false,
            },
            points: vec![Vec::new(); stepper.places.len()],
            stepper,
            is_constant,
            steps: 0,
            failed_points: 0,
            failed_since: false,
            largest_unbalance: 0.0,
        })
    }

    /// Start state, its rates and the first points.
    fn start(
        &mut self,
        starts: Option<&[JournalState]>,
        observer: &mut CoupledObserver<'_>,
    ) -> Result<Option<Outcome>, FilmError> {
        self.moving.positions = match starts {
            Some(starts) => starts.iter().map(coordinates).collect(),
            None => start::settled(&mut self.stepper, self.first_angle, self.is_constant)?,
        };
        if !self.stepper.has_history {
            let trial = self.stepper.start_motion(&self.moving, self.crank_step)?;
            let outcome = trial.outcome;
            self.moving = trial.end.clone();
            return Ok(self.publish(&trial, outcome, 1, observer));
        }
        let keeps = starts.is_some();
        let (trial, histories) = start::filled(&mut self.stepper, &self.moving, keeps)?;
        let stopped = self.publish(&trial, trial.outcome, 1, observer);
        for (place, history) in self.stepper.places.iter_mut().zip(&histories) {
            place.film.reject_step();
            place.film.restore(history);
        }
        // Points are the middles of the output crank steps: the first begins half a step on.
        self.moving.crank_angle += 0.5 * self.crank_step;
        Ok(stopped)
    }

    /// Takes the points of the cycle before; its last ones are the first of the next.
    fn begin_cycle(&mut self) -> Vec<Vec<CyclePoint>> {
        let before = std::mem::take(&mut self.points);
        let first = |points: &Vec<CyclePoint>| {
            let last = points.last().map(|last| CyclePoint {
                crank_angle: self.first_angle,
                ..*last
            });
            last.into_iter().collect()
        };
        self.points = before.iter().map(first).collect();
        before
    }

    /// One cycle; an outcome if the run ends within it.
    fn cycle(
        &mut self,
        number: usize,
        observer: &mut CoupledObserver<'_>,
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

    /// Substeps through one output crank step, with its points published on the way: at the middle for
    /// films with history, whose state belongs there, else at the end. An outcome if the run ends.
    fn output_step(
        &mut self,
        from: f64,
        number: usize,
        observer: &mut CoupledObserver<'_>,
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
            let trial = self.try_step(angle)?;
            let solved = trial.outcome == Outcome::Converged;
            let accurate = trial.error <= tolerance || self.substeps.level() >= finest;
            if !(solved && accurate) && self.substeps.divide() {
                self.reject_step();
                continue;
            }
            if matches!(trial.outcome, Outcome::Starved | Outcome::NoSolution) {
                self.reject_step();
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
                if failures >= LARGEST_FAILURES {
                    self.substeps.skip_to_end();
                }
                trial.at_rest(&self.moving, &self.stepper.places)
            };
            self.moving = trial.end.clone();
            self.steps += 1;
            self.substeps
                .advance(solved && trial.error < room * tolerance);
            let at_end = self.substeps.at_end();
            let mut stopped = None;
            if shows || (at_end && !is_published) {
                is_published = true;
                self.stepper.refresh(&mut trial)?;
                stopped = self.publish_step(&trial, number, observer);
            }
            for place in &mut self.stepper.places {
                place.film.accept_step();
            }
            if stopped.is_some() || at_end {
                return Ok(stopped);
            }
        }
    }

    /// A step, tried once more with patience where it fails.
    fn try_step(&mut self, angle: f64) -> Result<Trial, FilmError> {
        let trial = self.stepper.try_step(&self.moving, angle)?;
        if trial.outcome != Outcome::NotConverged || self.substeps.level() < PATIENT_LEVEL {
            return Ok(trial);
        }
        self.reject_step();
        let hasty = self.stepper.limits;
        self.stepper.limits = patient(&hasty);
        let again = self.stepper.try_step(&self.moving, angle);
        self.stepper.limits = hasty;
        again
    }

    fn reject_step(&mut self) {
        for place in &mut self.stepper.places {
            place.film.reject_step();
        }
    }

    /// Publishes the points of an output crank step.
    fn publish_step(
        &mut self,
        trial: &Trial,
        number: usize,
        observer: &mut CoupledObserver<'_>,
    ) -> Option<Outcome> {
        let outcome = if self.failed_since {
            self.failed_points += 1;
            Outcome::NotConverged
        } else {
            self.failed_points = 0;
            Outcome::Converged
        };
        self.failed_since = false;
        self.publish(trial, outcome, number, observer)
    }

    /// Adds a point to each journal and shows it; an outcome if the observer asks to stop.
    fn publish(
        &mut self,
        trial: &Trial,
        outcome: Outcome,
        number: usize,
        observer: &mut CoupledObserver<'_>,
    ) -> Option<Outcome> {
        if outcome == Outcome::Converged {
            self.largest_unbalance = self.largest_unbalance.max(trial.unbalance);
        }
        let mut stopped = None;
        for (journal, place) in self.stepper.places.iter().enumerate() {
            let points = &mut self.points[journal];
            let index = points.len();
            let [x, y, moment_x, moment_y] = trial.loads[journal];
            let point = CyclePoint {
                crank_angle: self.first_angle + index as f64 * self.crank_step,
                load: [x, y],
                moment: [moment_x, moment_y],
                state: trial.states[journal],
                reaction: trial.linearised[journal].reaction,
                summary: place.film.summary(),
                outcome,
            };
            points.push(point);
            let progress = Progress {
                cycle: number,
                fraction: index as f64 / self.count as f64,
            };
            if observer(journal, &point, &*place.film, progress).is_break() {
                stopped = Some(Outcome::NotConverged);
            }
        }
        stopped
    }

    /// Largest distance of a journal from the cycle before, over its clearance. The first cycle has
    /// none before it, but where nothing changes it is closed if the journals stayed where they began.
    fn closure(&self, before: &[Vec<CyclePoint>], number: usize) -> Option<f64> {
        if number <= 1 && !self.is_constant {
            return None;
        }
        let of_journal = |(journal, place): (usize, &Place<'_>)| {
            let points = &self.points[journal];
            let earlier = |index: usize| {
                if number > 1 {
                    before[journal].get(index)
                } else {
                    points.first()
                }
            };
            points
                .iter()
                .enumerate()
                .filter_map(|(index, point)| Some((point, earlier(index)?)))
                .map(|(a, b)| add(coordinates(&a.state), -1.0, coordinates(&b.state)))
                .map(|change| place.length(change) / place.bearing.radial_clearance)
                .fold(0.0, f64::max)
        };
        let each = self.stepper.places.iter().enumerate().map(of_journal);
        Some(each.fold(0.0, f64::max))
    }

    fn outcome(&self) -> Outcome {
        let mut points = self.points.iter().flatten();
        if points.all(|point| point.outcome == Outcome::Converged) {
            Outcome::Converged
        } else {
            Outcome::NotConverged
        }
    }

    fn result(
        self,
        duties: &[&LoadCycle],
        cycles: usize,
        closure: f64,
        outcome: Outcome,
    ) -> CoupledOrbits {
        let count = self.count;
        let load_cycles = self.stepper.places.iter().zip(&self.points).zip(duties);
        let load_cycles = load_cycles
            .map(|((place, points), duty)| {
                load_cycle(place, &points[..count.min(points.len())], duty)
            })
            .collect();
        let largest = self
            .points
            .iter()
            .flatten()
            .map(|point| point.load[0].hypot(point.load[1]))
            .fold(f64::MIN_POSITIVE, f64::max);
        let orbits = self.points.into_iter().zip(&self.stepper.places);
        let orbits = orbits
            .map(|(points, place)| JournalOrbit {
                points,
                cycles,
                closure,
                steps: self.steps,
                film_solves: place.film_solves,
                outcome,
            })
            .collect();
        CoupledOrbits {
            orbits,
            cycles: load_cycles,
            resultant_error: self.largest_unbalance / largest,
            outcome,
        }
    }
}

/// The loads of a journal's points as a table.
fn load_cycle(place: &Place<'_>, points: &[CyclePoint], duty: &LoadCycle) -> LoadCycle {
    let row = |point: &CyclePoint| LoadPoint {
        crank_angle: point.crank_angle,
        load: point.load,
        moment: point.moment,
        journal_speed: point.state.journal_speed,
        shell_speed: point.state.shell_speed,
    };
    LoadCycle {
        points: points.iter().map(row).collect(),
        period: duty.period,
        engine_speed: duty.engine_speed,
        journal_mass: 0.0,
        tilt: if place.with_tilt {
            CycleTilt::Free
        } else {
            CycleTilt::Aligned
        },
        feed_pressures: duty.feed_pressures.clone(),
    }
}

fn check(duties: &[&LoadCycle], settings: &OrbitSettings) -> Result<(), FilmError> {
    let refuse = |reason| Err(FilmError::Unsupported { reason });
    let Some((first, others)) = duties.split_first() else {
        return refuse("a shaft needs a bearing");
    };
    if !(settings.crank_step.is_finite() && settings.crank_step > 0.0) {
        return refuse("the crank step must be positive");
    }
    let start = |cycle: &LoadCycle| cycle.points.first().map(|point| point.crank_angle);
    let agree = others.iter().all(|other| {
        other.period == first.period
            && other.engine_speed == first.engine_speed
            && start(other) == start(first)
    });
    if !agree {
        return refuse("the bearings of a shaft must agree in period, speed and first crank angle");
    }
    Ok(())
}
