//! From a checked study to results in a directory: which film, which analysis, what it means.

mod cycle;
mod inputs;
mod steady;
mod sweep;

use crate::input::{BearingCase, Duty, FilmModel, FilmSettings, Study, Subject, TiltCondition};
use crate::ledger::LedgerError;
use crate::limits::{Limit, Quantity};
use crate::models::{self, Model};
use crate::output::{OutputError, prepare_directory, write_all};
use crate::progress::ProgressEvent;
use crate::results::{Body, DimensionlessResults, Header, Results};
use cycle::solve_cycle;
use inputs::input_rows;
use sommerfeld_film::dimensionless::{DimensionlessFilm, solve_dimensionless};
use sommerfeld_film::{
    Conditions, FilmError, FilmForce, FilmSolver, LongBearingFilm, MobilityFilm, Outcome,
    ShortBearingFilm,
};
use sommerfeld_oil::ViscosityLaw;
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

/// Why a run gave no results.
#[derive(Debug, Error)]
pub enum RunError {
    /// The film refuses what the study asks of it.
    #[error("{0}")]
    Film(#[from] FilmError),
    /// Results could not be written.
    #[error("{0}")]
    Output(#[from] OutputError),
    /// The ledger of a sweep cannot be used.
    #[error("{0}")]
    Ledger(#[from] LedgerError),
    /// The base study of a sweep, or a file it names, is not the one that was checked.
    #[error(
        "{0}, or a file it names, has changed while the sweep ran\n  = hint: run the sweep again, in another directory unless the change is taken back"
    )]
    InputChanged(String),
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
    run_on(study, directory, None, progress)
}

/// As [`run`], the cases of a sweep on this number of threads; without a number one for each
/// processor. The results do not depend on it.
///
/// # Errors
/// As [`run`].
pub fn run_on(
    study: &Study,
    directory: &Path,
    threads: Option<usize>,
    progress: &mut ProgressCallback<'_>,
) -> Result<RunSummary, RunError> {
    if let Subject::Sweep(plan) = &study.subject {
        return run_sweep(study, plan, directory, threads, progress);
    }
    // Better told before a long run than after it.
    prepare_directory(directory)?;
    let results = solve(study, progress)?;
    let files = write_all(&results, directory)?;
    Ok(RunSummary { results, files })
}

/// Runs `study` and writes nothing.
///
/// # Errors
/// [`FilmError`] where the film refuses what the study asks of it.
pub fn solve(study: &Study, progress: &mut ProgressCallback<'_>) -> Result<Results, FilmError> {
    let start = Instant::now();
    let mut header = header(study);
    let body = match &study.subject {
        Subject::Sweep(plan) => return Ok(solve_sweep(study, plan, progress)),
        Subject::Dimensionless(film) => solve_paper(film, &study.film, &mut header)?,
        Subject::Bearing(case) => match &case.duty {
            Duty::State(state) => solve_state(case, state, &study.film, &mut header)?,
            Duty::Load(load) => solve_load(case, load, study, &mut header)?,
            Duty::Cycle(duty) => solve_cycle(case, duty, &study.film, &mut header, progress)?,
        },
    };
    header.wall_time = start.elapsed().as_secs_f64();
    let mut results = Results { header, body };
    let limits: Vec<Limit> = study
        .limits
        .iter()
        .filter_map(|limit| {
            Some(Limit {
                quantity: Quantity::from_key(limit.key)?,
                value: limit.value,
                source: limit.source.clone(),
            })
        })
        .collect();
    results.check_limits(&limits);
    Ok(results)
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
        limits: Vec::new(),
    }
}

fn models_of(study: &Study) -> Vec<Model> {
    let mut used: Vec<Model> = models::find("film", study.film.model.name())
        .into_iter()
        .collect();
    match &study.subject {
        // Its cases say what they used.
        Subject::Sweep(_) => used.clear(),
        Subject::Dimensionless(film) => used.extend(models::of_bearing(&film.bearing())),
        Subject::Bearing(case) => {
            if study.film.model.is_field() {
                used.extend(models::of_bearing(&case.bearing));
            }
            let law = match case.lubricant.viscosity {
                ViscosityLaw::Constant { .. } => "constant",
                ViscosityLaw::Vogel { .. } => "vogel",
                ViscosityLaw::AstmD341 { .. } => "astm-d341",
            };
            used.extend(models::find("viscosity", law));
        }
    }
    used
}

/// Whether the journal cannot tilt in this duty.
fn stays_aligned(duty: &Duty) -> bool {
    match duty {
        Duty::State(state) => state.tilt == [0.0; 2] && state.tilt_rate == [0.0; 2],
        Duty::Load(load) => load.tilt == TiltCondition::Fixed([0.0; 2]),
        Duty::Cycle(duty) => !duty.tilt_is_free,
    }
}

/// The film model that the study names.
fn film_of(case: &BearingCase, settings: &FilmSettings) -> Result<Box<dyn FilmForce>, FilmError> {
    let viscosity = case.lubricant.viscosity(case.temperature, 0.0).value;
    Ok(match settings.model {
        FilmModel::Field if stays_aligned(&case.duty) => Box::new(FilmSolver::aligned(
            &case.bearing,
            &case.lubricant,
            settings.grid,
        )?),
        FilmModel::Field => Box::new(FilmSolver::new(
            &case.bearing,
            &case.lubricant,
            settings.grid,
        )?),
        FilmModel::ShortBearing => Box::new(ShortBearingFilm::new(&case.bearing, viscosity)?),
        FilmModel::Mobility => Box::new(MobilityFilm::new(&case.bearing, viscosity)?),
        FilmModel::LongBearing => Box::new(LongBearingFilm::new(&case.bearing, viscosity)?),
    })
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
    let solution = solve_dimensionless(film, settings.grid)?;
    note_outcome(solution.outcome, header);
    header
        .models
        .extend(models::find("extrapolation", "richardson"));
    let integrals = solution.integrals;
    Ok(Body::Dimensionless(DimensionlessResults {
        p_cos: integrals.p_cos,
        p_sin: integrals.p_sin,
        p_z_cos: integrals.p_z_cos,
        p_z_sin: integrals.p_z_sin,
        peak: integrals.peak,
    }))
}

/// Sets the status and says what it means and what to do.
fn note_outcome(outcome: Outcome, header: &mut Header) {
    header.status = outcome;
    let message = match outcome {
        Outcome::Converged => return,
        Outcome::NotConverged if header.analysis == "load-cycle" => {
            "not converged: the numbers are those of the last iterate; try a finer crank_step or \
             grid, or more maximum_cycles where only the orbit has not closed"
        }
        Outcome::NotConverged => {
            "not converged: the numbers are those of the last iterate; try another grid"
        }
        Outcome::Starved => {
            "starved: side flow leaves and no oil enters, so that the mass-conserving film empties \
             and carries no load; give a groove or hole, or ends = \"flooded\" with \
             ambient_pressure above cavitation_pressure; or use cavitation = \"reynolds\", which \
             needs no supply and does not conserve oil"
        }
        Outcome::NoSolution => "no solution: the film's equations determine no pressure here",
    };
    header.messages.insert(0, message.to_owned());
}
