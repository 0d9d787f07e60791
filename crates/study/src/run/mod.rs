//! From a checked study to results in a directory: which film, which analysis, what it means.

mod accuracy;
mod compare;
mod crew;
mod cycle;
mod database;
mod film_models;
mod heat;
mod heat_field;
mod inputs;
mod machine;
mod record;
mod running_in;
mod steady;
mod sweep;
mod turn;

use crate::film_tables::{Scheme, closure_name};
use crate::input::{
    BearingCase, Duty, FilmMethod, FilmModel, FilmSettings, HeatPlan, StoredInstants, Study,
    Subject,
};
use crate::ledger::LedgerError;
use crate::limits::{Limit, Quantity};
use crate::models::{self, Model};
use crate::output::{OutputError, StoredFields, check_directory, prepare_directory, write_stored};
use crate::progress::ProgressEvent;
use crate::results::{Body, CycleResults, DimensionlessResults, Header, Results};
use crate::sanity;
use crate::spool::FieldSpool;
use cycle::solve_cycle;
use database::{run_database, solve_database};
use film_models::{databases_of, film_of};
use inputs::input_rows;
use machine::{models_of_machine, run_machine, solve_machine};
use sommerfeld_film::dimensionless::{DimensionlessFilm, solve_dimensionless};
use sommerfeld_film::vogelpohl::{VogelpohlSettings, solve_vogelpohl};
use sommerfeld_film::{Conditions, FilmError, FilmSummary, JournalState, Outcome};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;
use steady::{solve_load, solve_state};
use sweep::{run_sweep, solve_sweep};
use thiserror::Error;

/// Takes the signs of life of a run and answers whether to go on.
pub type ProgressCallback<'a> = dyn FnMut(ProgressEvent) -> ControlFlow<()> + 'a;

/// What a run left behind.
#[derive(Debug, Clone, PartialEq)]
pub struct RunSummary {
    /// Everything that was found.
    pub results: Results,
    /// The files that were written.
    pub files: Vec<PathBuf>,
}

/// What a run is asked for beside the study.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RunOptions {
    /// Error bars from other grids and time steps, where the study sets no error target, which has
    /// them anyway.
    pub verify: bool,
    /// Threads that share the cases of a sweep; `None` takes one for each processor. The results do
    /// not depend on it.
    pub threads: Option<usize>,
}

/// Why a run gave no results.
#[derive(Debug, Error)]
pub enum RunError {
    /// The film refuses what the study asks of it.
    #[error("{0}")]
    Film(#[from] FilmError),
    /// The same for one bearing of a machine.
    #[error("{place}: {source}")]
    Bearing {
        /// The bearing and the speed.
        place: String,
        /// What the film says.
        source: FilmError,
    },
    /// Crankshaft, supports or torsional chain of a machine cannot be computed.
    #[error("{place}: {reason}")]
    Machine {
        /// The part and the speed.
        place: String,
        /// What is wrong with it.
        reason: String,
    },
    /// Error bars are asked of a machine.
    #[error(
        "{asked} states the discretisation error of one bearing, not of all bearings of the analysis {analysis}\n  = hint: run without it, then the loads-<name>.csv of a bearing as a load-cycle study with --verify"
    )]
    NoErrorBars {
        /// The option or key.
        asked: &'static str,
        /// The analysis.
        analysis: &'static str,
    },
    /// Results could not be written.
    #[error("{0}")]
    Output(#[from] OutputError),
    /// The ledger of the run cannot be used.
    #[error("{0}")]
    Ledger(#[from] LedgerError),
    /// The base study of a sweep, or a file it names, is not the one that was checked.
    #[error(
        "{0}, or a file it names, has changed while the sweep ran\n  = hint: run the sweep again, in another directory unless the change is taken back"
    )]
    InputChanged(String),
    /// A database cannot be built.
    #[error("{0}")]
    Database(String),
    /// The system gives no threads.
    #[error("no threads can be started: {0}")]
    Threads(String),
}

/// Runs `study` and writes its results into `directory`.
///
/// # Errors
/// [`RunError`]; what does not converge is no error but the status of the results.
pub fn run(
    study: &Study,
    directory: &Path,
    progress: &mut ProgressCallback<'_>,
) -> Result<RunSummary, RunError> {
    run_with(study, directory, RunOptions::default(), progress)
}

/// [`run`] with options.
///
/// # Errors
/// As [`run`].
pub fn run_with(
    study: &Study,
    directory: &Path,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<RunSummary, RunError> {
    if let Subject::Sweep(plan) = &study.subject {
        return run_sweep(study, plan, directory, options, progress);
    }
    if let Subject::Machine(plan) = &study.subject {
        return run_machine(study, plan, directory, options, progress);
    }
    if let Subject::Database(plan) = &study.subject {
        return run_database(study, plan, directory, options, progress);
    }
    // Better told before a long run than after it.
    check_directory(directory, &study.files)?;
    prepare_directory(directory)?;
    let failed = |source| OutputError::Disk {
        action: "store fields in the directory",
        path: directory.to_path_buf(),
        source,
    };
    let instants = stored_instants(study);
    let mut spool = match instants {
        StoredInstants::All => Some(FieldSpool::create(directory).map_err(failed)?),
        StoredInstants::Frames | StoredInstants::None => None,
    };
    let results = solve_into(study, options, spool.as_mut(), progress)?;
    if let Some(error) = spool.as_mut().and_then(FieldSpool::failure) {
        return Err(failed(error).into());
    }
    let stored = match (&spool, instants) {
        (Some(spool), _) => StoredFields::Spool(spool),
        (None, StoredInstants::None) => StoredFields::None,
        (None, _) => StoredFields::Frames,
    };
    let files = write_stored(&results, stored, directory)?;
    Ok(RunSummary { results, files })
}

/// Runs `study` and writes nothing.
///
/// # Errors
/// [`RunError`] where the film refuses what the study asks of it.
pub fn solve(study: &Study, progress: &mut ProgressCallback<'_>) -> Result<Results, RunError> {
    solve_into(study, RunOptions::default(), None, progress)
}

/// The instants whose fields a study stores. With an error target the run that is kept is known only
/// in the end: it has frames.
fn stored_instants(study: &Study) -> StoredInstants {
    match study.bearing_case().map(|case| &case.duty) {
        Some(Duty::Cycle(duty)) if study.film.model.is_field() => match duty.stored_fields {
            StoredInstants::All if study.film.relative_error_target.is_some() => {
                StoredInstants::Frames
            }
            instants => instants,
        },
        _ => StoredInstants::None,
    }
}

/// [`solve`] with options.
///
/// # Errors
/// As [`solve`].
pub fn solve_with(
    study: &Study,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Results, RunError> {
    solve_into(study, options, None, progress)
}

/// Runs `study` with the fields of every crank angle into a spool, if there is one.
fn solve_into(
    study: &Study,
    options: RunOptions,
    spool: Option<&mut FieldSpool>,
    progress: &mut ProgressCallback<'_>,
) -> Result<Results, RunError> {
    match &study.subject {
        Subject::Sweep(plan) => return Ok(solve_sweep(study, plan, options, progress)),
        Subject::Machine(plan) => return solve_machine(study, plan, options, progress),
        Subject::Database(plan) => return solve_database(study, plan, options, progress),
        Subject::Bearing(_) | Subject::Dimensionless(_) => {}
    }
    let start = Instant::now();
    // A run that is compared leaves a part of the bar to each of the others.
    let others = study.film.compare.len();
    let share = 0.6 / (0.6 + 0.4 * others as f64);
    let mut is_stopped = false;
    let mut of_share = |event: ProgressEvent| {
        let answer = progress(ProgressEvent {
            done: share * event.done,
            ..event
        });
        is_stopped |= answer.is_break();
        answer
    };
    let mut results = solve_accurately(study, options, spool, &mut of_share)?;
    if others > 0 {
        let own_time = start.elapsed().as_secs_f64();
        let bar = compare::Bar::new(share, others, is_stopped, progress);
        compare::with_others(study, &mut results, own_time, bar);
    }
    results.header.wall_time = start.elapsed().as_secs_f64();
    finish_results(study, &mut results);
    Ok(results)
}

/// The study on its grid, or on as many as its accuracy takes.
fn solve_accurately(
    study: &Study,
    options: RunOptions,
    spool: Option<&mut FieldSpool>,
    progress: &mut ProgressCallback<'_>,
) -> Result<Results, RunError> {
    let target = study
        .film
        .relative_error_target
        .filter(|_| study.film.model.is_field());
    match target {
        Some(target) => accuracy::solve_to_target(study, target, progress),
        None if options.verify => {
            // The bar is shared with the runs on other grids.
            let share = 0.6;
            let mut results = solve_once(study, spool, &mut |event| {
                progress(ProgressEvent {
                    done: share * event.done,
                    ..event
                })
            })?;
            accuracy::add_error_bars(study, &mut results, progress)?;
            Ok(results)
        }
        None => solve_once(study, spool, progress),
    }
}

/// Holds results against the limits of the study and against what its physics can mean.
fn finish_results(study: &Study, results: &mut Results) {
    results.check_limits(&limits(study));
    let beyond_laminar = results.flow_regime().and_then(|flow| flow.warning());
    results.header.messages.extend(beyond_laminar);
    results.header.messages.extend(beyond_database(results));
    let warnings = sanity::warnings(results, study.bearing_case());
    results.header.messages.extend(warnings);
}

/// That a journal came nearer to the shell than the films of the databases it was looked up in.
fn beyond_database(results: &Results) -> Option<String> {
    let databases = results.header.databases.iter();
    let last = databases
        .map(|one| one.last_eccentricity)
        .reduce(f64::min)?;
    let of_cycle = |cycle: &CycleResults| {
        let nearest = cycle.largest(|point| cycle.relative_eccentricity(point));
        nearest.map(|point| cycle.relative_eccentricity(point))
    };
    let nearest = match &results.body {
        Body::Steady(steady) => Some(steady.relative_eccentricity()),
        Body::LoadCycle(cycle) => of_cycle(cycle),
        Body::Machine(machine) => {
            let all = machine.bearings().filter_map(|(_, on)| of_cycle(&on.cycle));
            all.reduce(f64::max)
        }
        Body::Dimensionless(_) | Body::Database(_) | Body::Sweep(_) => None,
    }?;
    (nearest > last).then(|| {
        format!(
            "the journal reaches a relative eccentricity of {nearest:.6}, beyond the last of the \
             database, {last}: there its film is continued smoothly, without a stated error"
        )
    })
}

/// The study as it stands, on one grid.
fn solve_once(
    study: &Study,
    spool: Option<&mut FieldSpool>,
    progress: &mut ProgressCallback<'_>,
) -> Result<Results, RunError> {
    let mut header = header(study);
    let body = match &study.subject {
        Subject::Sweep(plan) => {
            return Ok(solve_sweep(study, plan, RunOptions::default(), progress));
        }
        Subject::Machine(plan) => {
            return solve_machine(study, plan, RunOptions::default(), progress);
        }
        Subject::Database(plan) => {
            return solve_database(study, plan, RunOptions::default(), progress);
        }
        Subject::Dimensionless(film) => solve_paper(film, &study.film, &mut header)?,
        Subject::Bearing(case) => match &case.heat {
            HeatPlan::Given | HeatPlan::Field { .. } => {
                solve_bearing(case, study, &mut header, spool, progress)?
            }
            HeatPlan::Balance { path, expansion } => {
                let heat = (path, expansion.as_ref());
                let warm = heat::balanced(case, heat, study, progress)?;
                let body = solve_bearing(&warm.case, study, &mut header, spool, progress)?;
                warm.note(&mut header);
                body
            }
        },
    };
    Ok(Results { header, body })
}

/// A bearing at the temperature of its case.
fn solve_bearing(
    case: &BearingCase,
    study: &Study,
    header: &mut Header,
    spool: Option<&mut FieldSpool>,
    progress: &mut ProgressCallback<'_>,
) -> Result<Body, FilmError> {
    match &case.duty {
        Duty::State(state) => solve_state(case, state, &study.film, header),
        Duty::Load(load) => solve_load(case, load, study, header, progress),
        Duty::Cycle(duty) => solve_cycle(case, duty, &study.film, header, spool, progress),
    }
}

fn limits(study: &Study) -> Vec<Limit> {
    study
        .limits
        .iter()
        .filter_map(|limit| {
            Some(Limit {
                quantity: Quantity::from_key(limit.key)?,
                value: limit.value,
                source: limit.source.clone(),
            })
        })
        .collect()
}

fn header(study: &Study) -> Header {
    Header {
        analysis: study.analysis.name().to_owned(),
        title: study.title.clone(),
        status: Outcome::Converged,
        messages: study.warnings.iter().map(|w| w.message.clone()).collect(),
        models: models_of(study),
        wall_time: 0.0,
        inputs: input_rows(&study.text),
        study_text: study.text.clone(),
        study_hash: Some(study.input_hash.clone()),
        error: None,
        grid: study.film.model.is_field().then_some(study.film.grid),
        limits: Vec::new(),
        heat: None,
        plain: None,
        databases: databases_of(study),
        comparison: None,
    }
}

fn models_of(study: &Study) -> Vec<Model> {
    let mut used: Vec<Model> = models::find("film", study.film.model.name())
        .into_iter()
        .collect();
    match &study.subject {
        // Its cases say what they used.
        Subject::Sweep(_) => used.clear(),
        Subject::Machine(plan) => used.extend(models_of_machine(plan, &study.film)),
        Subject::Database(plan) => {
            let film = match plan.scheme() {
                Scheme::Combined => FilmModel::Database,
                Scheme::Superposition => FilmModel::Superposition,
            };
            used = models::find("film", film.name()).into_iter().collect();
            used.extend(models::find("cavitation", closure_name(plan.closure())));
            used.extend(models::find("inlet", "cyclic"));
        }
        Subject::Dimensionless(film) => used.extend(models::of_bearing(&film.bearing(), true)),
        Subject::Bearing(case) => {
            let is_field = study.film.model.is_field();
            used.extend(models::of_bearing(&case.bearing, is_field));
            used.extend(models::of_oil(&case.lubricant, is_field));
            used.extend(models::find("heat", case.heat.name()));
        }
    }
    used
}

/// The summary with the Reynolds number of the film, where its model knows no density.
fn with_reynolds_number(
    summary: FilmSummary,
    case: &BearingCase,
    state: &JournalState,
) -> FilmSummary {
    if summary.reynolds_number != 0.0 {
        return summary;
    }
    let density = case.lubricant.density(case.temperature, 0.0).value;
    let viscosity = case.lubricant.viscosity(case.temperature, 0.0).value;
    let sliding = (state.journal_speed - state.shell_speed).abs() * case.bearing.radius();
    FilmSummary {
        reynolds_number: density * sliding * case.bearing.radial_clearance / viscosity,
        ..summary
    }
}

fn conditions(case: &BearingCase) -> Conditions<'static> {
    Conditions {
        temperature: case.temperature,
        feed_pressures: None,
    }
}

fn solve_paper(
    film: &DimensionlessFilm,
    settings: &FilmSettings,
    header: &mut Header,
) -> Result<Body, FilmError> {
    let (integrals, outcome) = match settings.method {
        FilmMethod::FiniteVolume => {
            let solution = solve_dimensionless(film, settings.grid)?;
            header
                .models
                .extend(models::find("extrapolation", "richardson"));
            (solution.integrals, solution.outcome)
        }
        FilmMethod::VogelpohlFdm => {
            let solution = solve_vogelpohl(film, &VogelpohlSettings::new(settings.grid))?;
            let method = models::find("method", settings.method.name());
            header.models.extend(method);
            (solution.integrals, solution.outcome)
        }
    };
    note_outcome(outcome, header);
    Ok(Body::Dimensionless(DimensionlessResults {
        p_cos: integrals.p_cos,
        p_sin: integrals.p_sin,
        p_z_cos: integrals.p_z_cos,
        p_z_sin: integrals.p_z_sin,
        peak: integrals.peak,
    }))
}

/// Says that no tilt of the journal balances its moment.
fn note_edge_contact(edge: usize, at: &str, header: &mut Header) {
    header.messages.insert(0, edge_contact_message(edge, at));
}

fn edge_contact_message(edge: usize, at: &str) -> String {
    let name = ["front (z = -B/2)", "rear (z = +B/2)"][edge];
    format!(
        "edge contact: {at} the moment presses the {name} edge of the journal to contact, a film \
         between rigid smooth surfaces carries no such moment there; give a smaller moment, a \
         wider bearing or a smaller clearance, a crowned bore, rough surfaces with contact, or \
         prescribe the tilt (under an elastic shaft: give support_tilt_stiffness)"
    )
}

/// Sets the status and says what it means and what to do. What went wrong before stays wrong.
fn note_outcome(outcome: Outcome, header: &mut Header) {
    if outcome != Outcome::Converged {
        header.status = outcome;
    }
    if let Some(message) = outcome_message(outcome, &header.analysis) {
        header.messages.insert(0, message.to_owned());
    }
}

/// What an outcome means and what to do; nothing where all is well.
fn outcome_message(outcome: Outcome, analysis: &str) -> Option<&'static str> {
    let has_cycle = ["load-cycle", "engine", "shaft"].contains(&analysis);
    match outcome {
        Outcome::Converged => None,
        Outcome::NotConverged if has_cycle => Some(
            "not converged: the numbers are those of the last iterate; try a finer crank_step or \
             grid, or more maximum_cycles where only the orbit has not closed",
        ),
        Outcome::NotConverged => {
            Some("not converged: the numbers are those of the last iterate; try another grid")
        }
        Outcome::Starved => Some(
            "starved: side flow leaves and no oil enters, so that the mass-conserving film empties \
             and carries no load; give a groove or hole, or ends = \"flooded\" with \
             ambient_pressure above cavitation_pressure; or use cavitation = \"reynolds\", which \
             needs no supply and does not conserve oil",
        ),
        Outcome::NoSolution => Some(
            "no solution: the film's equations determine no pressure here, or an oil that thickens \
             under pressure would need more than the limit of its reduced pressure; give an elastic \
             shell, rough surfaces with contact or a smaller load",
        ),
    }
}
