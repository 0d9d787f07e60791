//! The orbits of a machine as units of work.
//!
//! Bearings whose loads are known and do the same at other crank angles are one unit, of which one orbit
//! is solved; mostly a unit holds a single bearing. Bearings whose loads follow from each other are
//! one unit: the mains of an elastic crankshaft, the two films of a floating piston pin.

use super::alike::{Later, groups, solve_alike};
use super::coupled::solve_coupled;
use super::pin::solve_pin;
use super::speeds::SpeedLoads;
use super::{ProgressCallback, RunError, Work};
use crate::input::{
    BearingCase, CycleDuty, Duty, HeatPlan, Machine, MachineBearing, MachinePlan, StoredInstants,
};
use crate::results::machine::MACHINE_FRAMES;
use crate::results::{CycleFields, CycleResults, HeatResults};
use crate::run::cycle::{bearing_cycle, orbit_settings};
use crate::run::heat::balanced_cycle;
use crate::run::record::FieldRecorder;
use serde::{Deserialize, Serialize};
use sommerfeld_bearing::{JournalOrbit, LoadCycle};
use sommerfeld_engine::{Mains, PinFit, Role};
use sommerfeld_film::{FeedFlow, FilmError, Outcome};

/// A unit of work.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unit {
    /// Index of the speed.
    pub speed: usize,
    /// What is to be done at it.
    pub task: Task,
}

/// What a unit has to do; bearings by their index in the plan.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Task {
    /// Bearings under known loads that do the same, some later than the first: one orbit for all.
    Alike(Vec<Later>),
    /// Small end and piston boss of a pin that floats between them.
    Pin([usize; 2]),
    /// All bearings of an elastic shaft, in axial order.
    Coupled(Vec<usize>),
}

impl Task {
    /// The bearings whose orbits it finds.
    pub(super) fn bearings(&self) -> Vec<usize> {
        match self {
            Self::Alike(group) => group.iter().map(|one| one.bearing).collect(),
            Self::Pin(films) => films.to_vec(),
            Self::Coupled(bearings) => bearings.clone(),
        }
    }
}

/// The orbit of one bearing of a unit, with all that its results need beside the plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct BearingFound {
    /// Index in the plan.
    pub bearing: usize,
    /// The load it was given, or that the elastic shaft put on it.
    pub load: LoadCycle,
    /// Load of hinges at the mains, N, at each point of the orbit.
    pub determinate_load: Option<Vec<[f64; 2]>>,
    /// The orbit.
    pub orbit: JournalOrbit,
    /// Flow through each feed at each point of the orbit.
    pub feed_flows: Vec<Vec<FeedFlow>>,
    /// Fields.
    pub fields: Option<CycleFields>,
    /// The bearing of the plan whose orbit this is, so much later, rad; `None` for one that was solved
    /// itself.
    pub turned_from: Option<(usize, f64)>,
    /// The temperature that its heat led to, where it was not given.
    #[serde(default)]
    pub heat: Option<HeatResults>,
    /// What the reader must know.
    pub notes: Vec<String>,
}

/// What a unit found: one for each of its bearings.
pub(super) type UnitFound = Vec<BearingFound>;

/// Every unit of a machine, speed by speed, those that take longest first.
pub(super) fn units(plan: &MachinePlan, speeds: &[SpeedLoads], points: usize) -> Vec<Unit> {
    let shaft = on_elastic_shaft(plan).map(Task::Coupled);
    let pins = floating_pins(plan).into_iter().map(Task::Pin);
    let tasks: Vec<Task> = shaft.into_iter().chain(pins).collect();
    let is_taken = |bearing: &usize| tasks.iter().any(|task| task.bearings().contains(bearing));
    let known = (0..plan.bearings.len()).filter(|bearing| !is_taken(bearing));
    let known: Vec<usize> = known.collect();
    let at = |(speed, loads): (usize, &SpeedLoads)| {
        let alike = groups(&known, (&loads.bearings, &loads.cycles), points);
        let alike = alike.into_iter().map(Task::Alike);
        let tasks = tasks.iter().cloned().chain(alike);
        tasks.map(|task| Unit { speed, task }).collect::<Vec<_>>()
    };
    speeds.iter().enumerate().flat_map(at).collect()
}

/// The bearings of a shaft whose bending is followed, from its free end.
fn on_elastic_shaft(plan: &MachinePlan) -> Option<Vec<usize>> {
    let role = match &plan.machine {
        Machine::Engine(engine) if engine.mains != Mains::Determinate => Role::Main,
        Machine::Shaft(shaft) if shaft.is_elastic => Role::Shaft,
        Machine::Engine(_) | Machine::Shaft(_) => return None,
    };
    let all = plan.bearings.iter().enumerate();
    let on_shaft = all.filter(|(_, bearing)| bearing.role == role);
    let mut on_shaft: Vec<(usize, usize)> = on_shaft.map(|(at, on)| (on.index, at)).collect();
    on_shaft.sort_unstable();
    (!on_shaft.is_empty()).then(|| on_shaft.into_iter().map(|(_, at)| at).collect())
}

/// Small end and piston boss of each pin that floats in both.
fn floating_pins(plan: &MachinePlan) -> Vec<[usize; 2]> {
    let is_floating = match &plan.machine {
        Machine::Engine(engine) => engine.pin_fit == PinFit::Floating,
        Machine::Shaft(_) => false,
    };
    if !is_floating {
        return Vec::new();
    }
    let bearings = plan.bearings.iter().enumerate();
    let small_ends = bearings.filter(|(_, bearing)| bearing.role == Role::SmallEnd);
    small_ends
        .filter_map(|(at, small_end)| {
            let is_its_boss = |other: &MachineBearing| {
                other.role == Role::PistonBoss && other.index == small_end.index
            };
            Some([at, plan.bearings.iter().position(is_its_boss)?])
        })
        .collect()
}

/// Computes a unit.
pub(super) fn solve_unit(
    work: &Work<'_>,
    unit: &Unit,
    progress: &mut ProgressCallback<'_>,
) -> Result<UnitFound, RunError> {
    match &unit.task {
        Task::Alike(group) => solve_alike(work, unit.speed, group, progress),
        Task::Pin(films) => solve_pin(work, unit.speed, *films, progress),
        Task::Coupled(bearings) => solve_coupled(work, unit.speed, bearings, progress),
    }
}

/// The orbit of one bearing under a load cycle.
pub(super) fn solve_alone(
    work: &Work<'_>,
    speed: usize,
    bearing: usize,
    cycle: LoadCycle,
    progress: &mut ProgressCallback<'_>,
) -> Result<BearingFound, RunError> {
    let warm = WarmBearing::of(work, speed, bearing, cycle, progress)?;
    let (case, duty) = (&warm.case, &warm.duty);
    let recorder = recorder(case, duty, speed);
    let solved = bearing_cycle(case, duty, work.film, None, recorder, progress)
        .map_err(|error| refused(work, speed, bearing, error))?;
    Ok(warm.found(bearing, solved.results))
}

/// A bearing of the machine at the temperature that its heat leads to, or at the one that is given.
pub(super) struct WarmBearing {
    /// With its warm clearance.
    pub case: BearingCase,
    /// What it has to do.
    pub duty: CycleDuty,
    heat: Option<HeatResults>,
    notes: Vec<String>,
}

impl WarmBearing {
    /// Of a bearing under a load cycle.
    pub(super) fn of(
        work: &Work<'_>,
        speed: usize,
        bearing: usize,
        cycle: LoadCycle,
        progress: &mut ProgressCallback<'_>,
    ) -> Result<Self, RunError> {
        let (case, duty) = bearing_case(work, speed, bearing, cycle);
        let HeatPlan::Balance { path, expansion } = case.heat else {
            return Ok(Self {
                case,
                duty,
                heat: None,
                notes: Vec::new(),
            });
        };
        let way = (&path, expansion.as_ref());
        let warm = balanced_cycle((&case, &duty), way, work.film, progress)
            .map_err(|error| refused(work, speed, bearing, error))?;
        let place = work.place(speed, bearing);
        let notes = warm.failure().map(|failure| format!("{place}: {failure}"));
        let (case, heat) = warm.into_parts();
        Ok(Self {
            case,
            duty,
            heat: Some(heat),
            notes: notes.into_iter().collect(),
        })
    }

    /// With what its orbit left.
    pub(super) fn found(self, bearing: usize, results: CycleResults) -> BearingFound {
        let mut found = BearingFound {
            heat: self.heat,
            ..BearingFound::of(bearing, self.duty.cycle, results)
        };
        if !self.notes.is_empty() {
            found.mark_not_converged();
            found.notes = self.notes;
        }
        found
    }
}

impl BearingFound {
    /// What an orbit under a load left.
    pub(super) fn of(bearing: usize, load: LoadCycle, results: CycleResults) -> Self {
        Self {
            bearing,
            load,
            determinate_load: None,
            orbit: results.orbit,
            feed_flows: results.feed_flows,
            fields: results.fields,
            turned_from: None,
            heat: None,
            notes: Vec::new(),
        }
    }

    /// An orbit in a film that is not known, or under a speed that is not, is none that converged.
    pub(super) fn mark_not_converged(&mut self) {
        if self.orbit.outcome == Outcome::Converged {
            self.orbit.outcome = Outcome::NotConverged;
        }
    }
}

/// What the film of a bearing refuses, with its place.
pub(super) fn refused(
    work: &Work<'_>,
    speed: usize,
    bearing: usize,
    source: FilmError,
) -> RunError {
    RunError::Bearing {
        place: work.place(speed, bearing),
        source,
    }
}

/// A bearing of the machine with its load cycle, as a study of its own would have it.
pub(super) fn bearing_case(
    work: &Work<'_>,
    speed: usize,
    bearing: usize,
    cycle: LoadCycle,
) -> (BearingCase, CycleDuty) {
    let plan = work.plan;
    let duty = CycleDuty {
        cycle,
        coefficients_at: Vec::new(),
        crank_step: plan.orbit.crank_step,
        maximum_cycles: plan.orbit.maximum_cycles,
        closure_tolerance: plan.orbit.closure_tolerance,
        stored_fields: StoredInstants::None,
        step_error_factor: 1.0,
    };
    let case = BearingCase {
        bearing: work.speeds[speed].bearings[bearing].clone(),
        lubricant: plan.lubricant.clone(),
        temperature: plan.temperature,
        heat: plan.heat,
        wear: plan.wear,
        duty: Duty::Cycle(duty.clone()),
    };
    (case, duty)
}

/// Frames over the cycle are kept at the first speed: those of all would not fit into one report.
pub(super) fn recorder<'a>(
    case: &BearingCase,
    duty: &CycleDuty,
    speed: usize,
) -> FieldRecorder<'a> {
    let frames = if speed == 0 { MACHINE_FRAMES } else { 0 };
    let points = orbit_settings(duty).points_per_cycle(&duty.cycle);
    FieldRecorder::new(points, frames, case.bearing.cavitation_pressure, None).with_wear(case, duty)
}
