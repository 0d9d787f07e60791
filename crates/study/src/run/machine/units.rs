//! The orbits of a machine as units of work.
//!
//! A bearing whose load is known is a unit of its own. Bearings whose loads follow from each other are
//! one unit: the mains of an elastic crankshaft, the two films of a floating piston pin.

use super::speeds::SpeedLoads;
use super::{ProgressCallback, RunError, Work};
use crate::input::{BearingCase, CycleDuty, Duty, MachinePlan, StoredInstants};
use crate::results::machine::{MACHINE_FRAMES, speed_words};
use crate::results::{CycleFields, CycleResults};
use crate::run::cycle::{bearing_cycle, orbit_settings};
use crate::run::record::FieldRecorder;
use serde::{Deserialize, Serialize};
use sommerfeld_bearing::{JournalOrbit, LoadCycle};
use sommerfeld_film::FeedFlow;

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
    /// The orbit of one bearing under a known load.
    Alone([usize; 1]),
}

impl Task {
    /// The bearings whose orbits it finds.
    pub(super) fn bearings(&self) -> &[usize] {
        match self {
            Self::Alone(bearing) => bearing,
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
    /// What the reader must know.
    pub notes: Vec<String>,
}

/// What a unit found: one for each of its bearings.
pub(super) type UnitFound = Vec<BearingFound>;

/// Every unit of a machine, speed by speed.
pub(super) fn units(plan: &MachinePlan) -> Vec<Unit> {
    let at = |speed: usize| {
        (0..plan.bearings.len()).map(move |bearing| Unit {
            speed,
            task: Task::Alone([bearing]),
        })
    };
    (0..plan.speeds.len()).flat_map(at).collect()
}

/// Computes a unit.
pub(super) fn solve_unit(
    work: &Work<'_>,
    unit: &Unit,
    progress: &mut ProgressCallback<'_>,
) -> Result<UnitFound, RunError> {
    let speed = &work.speeds[unit.speed];
    match &unit.task {
        Task::Alone([bearing]) => {
            let cycle = speed.cycles[*bearing].clone();
            let found = solve_alone(work, unit.speed, *bearing, cycle, progress)?;
            Ok(vec![found])
        }
    }
}

/// The orbit of one bearing under a load cycle.
fn solve_alone(
    work: &Work<'_>,
    speed: usize,
    bearing: usize,
    cycle: LoadCycle,
    progress: &mut ProgressCallback<'_>,
) -> Result<BearingFound, RunError> {
    let (case, duty) = bearing_case(work.plan, bearing, cycle);
    let recorder = recorder(&case, &duty, speed);
    let solved = bearing_cycle(&case, &duty, work.film, recorder, progress)
        .map_err(|error| refused(work, &work.speeds[speed], bearing, error))?;
    let CycleResults {
        orbit,
        feed_flows,
        fields,
        ..
    } = solved.results;
    Ok(BearingFound {
        bearing,
        load: duty.cycle,
        determinate_load: None,
        orbit,
        feed_flows,
        fields,
        notes: Vec::new(),
    })
}

/// What the film of a bearing refuses, with its place.
fn refused(
    work: &Work<'_>,
    speed: &SpeedLoads,
    bearing: usize,
    source: sommerfeld_film::FilmError,
) -> RunError {
    let at = speed_words(speed.motion.speed);
    RunError::Bearing {
        place: format!("{} at {at}", work.plan.bearings[bearing].name),
        source,
    }
}

/// A bearing of the machine with its load cycle, as a study of its own would have it.
fn bearing_case(plan: &MachinePlan, bearing: usize, cycle: LoadCycle) -> (BearingCase, CycleDuty) {
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
        bearing: plan.bearings[bearing].bearing.clone(),
        lubricant: plan.lubricant.clone(),
        temperature: plan.temperature,
        duty: Duty::Cycle(duty.clone()),
    };
    (case, duty)
}

/// Frames over the cycle are kept at the first speed: those of all would not fit into one report.
fn recorder<'a>(case: &BearingCase, duty: &CycleDuty, speed: usize) -> FieldRecorder<'a> {
    let frames = if speed == 0 { MACHINE_FRAMES } else { 0 };
    let points = orbit_settings(duty).points_per_cycle(&duty.cycle);
    FieldRecorder::new(points, frames, case.bearing.cavitation_pressure, None)
}
