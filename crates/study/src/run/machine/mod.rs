//! An engine or shaft: the loads of its bearings at every speed, and the orbits that answer them.
//!
//! The loads of all speeds come first, they cost little. The orbits are units of work ([`units`]), each
//! sequential and independent of the others. In a directory of results what a unit finds is kept in the
//! ledger until the results are written: a run that ends in any way is taken up by the same command.

mod alike;
mod assemble;
mod coupled;
mod desk;
mod pin;
mod speeds;
mod units;

use super::{ProgressCallback, RunError, RunOptions, RunSummary, finish_results, header};
use crate::input::{FilmSettings, Machine, MachinePlan, Study};
use crate::ledger::{Ledger, LedgerStudy};
use crate::models::{self, Model};
use crate::output::{check_directory, prepare_directory, write_all};
use crate::results::machine::speed_words;
use crate::results::{Body, Results};
use assemble::assemble;
use desk::{UnitDesk, read};
use serde_json::json;
use sommerfeld_engine::Mains;
use speeds::{SpeedLoads, points};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;
use units::{Unit, UnitFound, units};

/// What all units share: the machine, its loads at every speed, and the list of the units.
struct Work<'a> {
    plan: &'a MachinePlan,
    film: &'a FilmSettings,
    speeds: Vec<SpeedLoads>,
    units: Vec<Unit>,
}

impl<'a> Work<'a> {
    fn new(plan: &'a MachinePlan, film: &'a FilmSettings) -> Result<Self, RunError> {
        let speeds = plan.speeds.iter().map(|speed| SpeedLoads::of(plan, *speed));
        let speeds: Vec<SpeedLoads> = speeds.collect::<Result<_, _>>()?;
        Ok(Self {
            plan,
            film,
            units: units(plan, &speeds, points(plan)),
            speeds,
        })
    }

    /// Output points of every orbit over its period.
    fn points(&self) -> usize {
        points(self.plan)
    }

    /// A bearing at a speed, by their indices, for a reader.
    fn place(&self, speed: usize, bearing: usize) -> String {
        let speed = self.plan.speeds.get(speed).copied().unwrap_or(f64::NAN);
        let bearing = self.plan.bearings.get(bearing);
        let name = bearing.map_or("a bearing", |bearing| bearing.name.as_str());
        format!("{name} at {}", speed_words(speed))
    }
}

/// Runs the orbits that the directory does not hold yet, and writes the results of all.
pub(super) fn run_machine(
    study: &Study,
    plan: &MachinePlan,
    directory: &Path,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<RunSummary, RunError> {
    let start = Instant::now();
    refuse_error_bars(study, options)?;
    check_directory(directory, &study.files)?;
    let work = Work::new(plan, &study.film)?;
    prepare_directory(directory)?;
    let mut ledger = Ledger::open(directory, &ledger_study(study, &work))?;
    let mut found = read(&ledger, work.units.len())?;
    let told = (!found.is_empty()).then(|| {
        let (done, units) = (found.len(), work.units.len());
        let place = directory.display();
        format!("{done} of {units} calculations were found done in {place}")
    });
    let mut desk = UnitDesk::new(&work, Some(&mut ledger), &mut found, progress);
    // A stop is heard at the next sign of life.
    let _ = desk.tell(told);
    if let Err(error) = desk.compute(options) {
        // With nothing to take up, the directory is free for the study once it is mended.
        if found.is_empty() {
            ledger.remove()?;
        }
        return Err(error);
    }
    let is_complete = found.len() == work.units.len();
    let mut results = results(study, work, found);
    results.header.wall_time = start.elapsed().as_secs_f64();
    let files = write_all(&results, directory)?;
    if is_complete {
        ledger.remove()?;
    }
    Ok(RunSummary { results, files })
}

/// Runs every orbit and writes nothing.
pub(super) fn solve_machine(
    study: &Study,
    plan: &MachinePlan,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Results, RunError> {
    let start = Instant::now();
    refuse_error_bars(study, options)?;
    let work = Work::new(plan, &study.film)?;
    let mut found = BTreeMap::new();
    UnitDesk::new(&work, None, &mut found, progress).compute(options)?;
    let mut results = results(study, work, found);
    results.header.wall_time = start.elapsed().as_secs_f64();
    Ok(results)
}

/// Error bars need every orbit on three grids; they are there for one bearing at a time.
fn refuse_error_bars(study: &Study, options: RunOptions) -> Result<(), RunError> {
    let asked = match (options.verify, study.film.relative_error_target) {
        (true, _) => "--verify",
        (false, Some(_)) => "film.relative_error_target",
        (false, None) => return Ok(()),
    };
    Err(RunError::NoErrorBars {
        asked,
        analysis: study.analysis.name(),
    })
}

fn results(study: &Study, work: Work<'_>, found: BTreeMap<usize, UnitFound>) -> Results {
    let mut header = header(study);
    let machine = assemble(work, found, &mut header);
    let mut results = Results {
        header,
        body: Body::Machine(Box::new(machine)),
    };
    finish_results(study, &mut results);
    results
}

/// The machine as its ledger knows it.
fn ledger_study(study: &Study, work: &Work<'_>) -> LedgerStudy {
    let plan = work.plan;
    let inputs = |unit: &Unit| {
        let names = unit.task.bearings().into_iter();
        let names: Vec<&str> = names
            .filter_map(|index| plan.bearings.get(index))
            .map(|bearing| bearing.name.as_str())
            .collect();
        let speed = plan.speeds.get(unit.speed);
        json!({ "speed_rad_s": speed, "bearings": names }).to_string()
    };
    LedgerStudy {
        title: if study.title.is_empty() {
            study.file.clone()
        } else {
            format!("\"{}\"", study.title)
        },
        hash: study.input_hash.clone(),
        parts: vec![("the study".to_owned(), study.text.clone())],
        cases: work
            .units
            .iter()
            .map(|unit| (inputs(unit), study.input_hash.clone()))
            .collect(),
    }
}

/// How the loads of the mains are found, in words for a reader.
fn load_model(plan: &MachinePlan) -> String {
    match &plan.machine {
        Machine::Engine(engine) => match engine.mains {
            Mains::Determinate => {
                "statically determinate: a hinge at each main, every bay a beam on two supports"
            }
            Mains::Elastic { .. } => {
                "statically indeterminate: elastic crankshaft on elastic supports, through \
                 clearances and films"
            }
        },
        Machine::Shaft(shaft) if shaft.is_elastic => {
            "statically indeterminate: elastic shaft on elastic supports, through clearances and films"
        }
        Machine::Shaft(_) => {
            "statically determinate: a hinge at each bearing, every bay a beam on two supports"
        }
    }
    .to_owned()
}

/// The models a machine uses.
pub(super) fn models_of_machine(plan: &MachinePlan, settings: &FilmSettings) -> Vec<Model> {
    let mut used = Vec::new();
    for bearing in &plan.bearings {
        for model in models::of_bearing(&bearing.bearing, settings.model.is_field()) {
            if !used.contains(&model) {
                used.push(model);
            }
        }
    }
    used.extend(models::of_oil(&plan.lubricant, settings.model.is_field()));
    used
}
