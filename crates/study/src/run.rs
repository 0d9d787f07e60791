//! From a checked study to results in a directory: which film, which analysis, what it means.

use crate::input::{
    Analysis, BearingCase, CycleDuty, Duty, FilmModel, FilmSettings, SteadyLoad, Study, Subject,
    TiltCondition,
};
use crate::limits::{Limit, Quantity};
use crate::models::{self, Model};
use crate::output::{OutputError, prepare_directory, write_all};
use crate::progress::ProgressEvent;
use crate::results::{
    Body, CycleField, CycleResults, DimensionlessResults, FieldSnapshot, Header, InputRow, Results,
    SteadyResults,
};
use sommerfeld_bearing::{
    Coefficients, EquilibriumRequest, EquilibriumSettings, JournalOrbit, OrbitSettings,
    find_equilibrium, journal_orbit,
};
use sommerfeld_film::dimensionless::{DimensionlessFilm, solve_dimensionless};
use sommerfeld_film::{
    Bearing, Conditions, Extreme, FilmError, FilmForce, FilmSolver, FilmSummary, Inlet,
    JournalState, Linearised, LongBearingFilm, MobilityFilm, Outcome, Reaction, ShortBearingFilm,
    Step,
};
use sommerfeld_oil::ViscosityLaw;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;
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

/// The keys of the study with their values as the user wrote them.
fn input_rows(text: &str) -> Vec<InputRow> {
    fn walk(prefix: &str, value: &toml::Value, rows: &mut Vec<InputRow>) {
        match value {
            toml::Value::Table(table) => {
                for (key, value) in table {
                    let path = if prefix.is_empty() {
                        key.clone()
                    } else {
                        format!("{prefix}.{key}")
                    };
                    walk(&path, value, rows);
                }
            }
            toml::Value::Array(items) if items.iter().any(toml::Value::is_table) => {
                for (index, item) in items.iter().enumerate() {
                    walk(&format!("{prefix}[{}]", index + 1), item, rows);
                }
            }
            toml::Value::String(words) => rows.push(InputRow {
                key: prefix.to_owned(),
                value: words.clone(),
            }),
            toml::Value::Array(items) => {
                let items = items.iter().map(|item| match item {
                    toml::Value::String(words) => words.clone(),
                    other => other.to_string(),
                });
                rows.push(InputRow {
                    key: prefix.to_owned(),
                    value: items.collect::<Vec<_>>().join(", "),
                });
            }
            other => rows.push(InputRow {
                key: prefix.to_owned(),
                value: other.to_string(),
            }),
        }
    }
    let mut rows = Vec::new();
    if let Ok(table) = text.parse::<toml::Table>() {
        walk("", &toml::Value::Table(table), &mut rows);
    }
    rows
}

/// The film model that the study names.
fn film_of(case: &BearingCase, settings: &FilmSettings) -> Result<Box<dyn FilmForce>, FilmError> {
    let viscosity = case.lubricant.viscosity(case.temperature, 0.0).value;
    Ok(match settings.model {
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

fn solve_state(
    case: &BearingCase,
    state: &JournalState,
    settings: &FilmSettings,
    header: &mut Header,
) -> Result<Body, FilmError> {
    let follows =
        settings.model.is_field() && matches!(case.bearing.inlet, Inlet::MaxFilmLine { .. });
    let mut film: Box<dyn FilmForce> = if follows {
        let grading =
            (state.eccentricity() / case.bearing.radial_clearance - 0.05).clamp(0.0, 0.95);
        let (bearing, oil) = (&case.bearing, &case.lubricant);
        Box::new(FilmSolver::following(bearing, oil, settings.grid, grading)?)
    } else {
        film_of(case, settings)?
    };
    let answer = film.react(state, Step::Steady, &conditions(case))?;
    note_outcome(answer.outcome, header);
    let iterations = film.summary().iterations;
    Ok(steady(
        case,
        state,
        None,
        &answer,
        film.as_ref(),
        iterations,
    ))
}

fn solve_load(
    case: &BearingCase,
    load: &SteadyLoad,
    study: &Study,
    header: &mut Header,
) -> Result<Body, FilmError> {
    let mut film = film_of(case, &study.film)?;
    let (tilt, moment) = match load.tilt {
        TiltCondition::Fixed(tilt) => (tilt, None),
        TiltCondition::Free { moment } => ([0.0; 2], Some(moment)),
    };
    let request = EquilibriumRequest {
        load: load.load,
        moment,
        frame: JournalState {
            tilt,
            journal_speed: load.journal_speed,
            shell_speed: load.shell_speed,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings::default(),
    };
    let found = find_equilibrium(film.as_mut(), &case.bearing, &request, &conditions(case))?;
    note_outcome(found.outcome, header);
    let answer = Linearised {
        reaction: found.reaction,
        tangent: found.tangent,
        settled: true,
        outcome: found.outcome,
    };
    let updates = found.film_updates;
    let mut body = steady(
        case,
        &found.state,
        Some(load.load),
        &answer,
        film.as_ref(),
        updates,
    );
    if let (Analysis::Coefficients, Body::Steady(steady)) = (study.analysis, &mut body) {
        let coefficients = Coefficients::from_tangent(&found.tangent);
        let has_film = matches!(found.outcome, Outcome::Converged | Outcome::NotConverged);
        let shown = |matrix| if has_film { matrix } else { [[f64::NAN; 2]; 2] };
        steady.stiffness = Some(shown(coefficients.translation_stiffness()));
        steady.damping = Some(shown(coefficients.translation_damping()));
    }
    Ok(body)
}

fn steady(
    case: &BearingCase,
    state: &JournalState,
    load: Option<[f64; 2]>,
    answer: &Linearised,
    film: &dyn FilmForce,
    iterations: usize,
) -> Body {
    let bearing = &case.bearing;
    let viscosity = case.lubricant.viscosity(case.temperature, 0.0).value;
    let has_film = matches!(answer.outcome, Outcome::Converged | Outcome::NotConverged);
    // A film that is not there has no numbers, and a journal that it should carry no place.
    let mut state = *state;
    if !has_film && load.is_some() {
        state.position = [f64::NAN; 2];
    }
    let (reaction, summary) = if has_film {
        (answer.reaction, film.summary())
    } else {
        (no_reaction(), no_summary())
    };
    let carried = load.unwrap_or_else(|| reaction.force());
    let feed_flows = film.feed_flows().iter().filter(|_| has_film);
    Body::Steady(Box::new(SteadyResults {
        bearing: bearing.clone(),
        state,
        load,
        reaction,
        summary,
        feed_flows: feed_flows.copied().collect(),
        sommerfeld_number: sommerfeld_number(bearing, carried, viscosity, &state),
        iterations,
        stiffness: None,
        damping: None,
        field: film.field().filter(|_| has_film).map(FieldSnapshot::from),
    }))
}

/// The reaction of a film that is not there: no number.
fn no_reaction() -> Reaction {
    let none = [f64::NAN; 2];
    Reaction {
        film_force: none,
        film_moment: none,
        friction_torque_journal: f64::NAN,
        friction_torque_shell: f64::NAN,
        ..Reaction::default()
    }
}

/// The summary of a film that is not there: no number.
fn no_summary() -> FilmSummary {
    let nowhere = Extreme {
        value: f64::NAN,
        angle: f64::NAN,
        axial: f64::NAN,
    };
    FilmSummary {
        minimum_film_thickness: nowhere,
        peak_film_pressure: nowhere,
        side_flow: [f64::NAN; 2],
        feed_flow: f64::NAN,
        storage_rate: f64::NAN,
        mass_balance_relative: f64::NAN,
        friction_power: f64::NAN,
        squeeze_power: f64::NAN,
        full_film_share: f64::NAN,
        complementarity_violation: f64::NAN,
        cell_residual: f64::NAN,
        reynolds_number: f64::NAN,
        iterations: 0,
    }
}

/// So = F psi^2/(B D eta omega) with omega the sum of both speeds.
fn sommerfeld_number(
    bearing: &Bearing,
    load: [f64; 2],
    viscosity: f64,
    state: &JournalState,
) -> f64 {
    let speed = (state.journal_speed + state.shell_speed).abs();
    load[0].hypot(load[1]) * bearing.relative_clearance().powi(2)
        / (bearing.width * bearing.diameter * viscosity * speed)
}

fn solve_cycle(
    case: &BearingCase,
    duty: &CycleDuty,
    settings: &FilmSettings,
    header: &mut Header,
    progress: &mut ProgressCallback<'_>,
) -> Result<Body, FilmError> {
    let mut film = film_of(case, settings)?;
    let no_orbit = CycleResults {
        bearing: case.bearing.clone(),
        orbit: JournalOrbit {
            points: Vec::new(),
            cycles: 0,
            closure: f64::NAN,
            steps: 0,
            film_solves: 0,
            outcome: Outcome::Starved,
        },
        feed_flows: Vec::new(),
        worst_film: None,
    };
    // Without supply the film would empty over the cycles and the journal sink into the shell.
    let centred = JournalState {
        journal_speed: duty.cycle.engine_speed,
        ..JournalState::default()
    };
    if film
        .linearise(&centred, Step::Steady, &conditions(case))?
        .outcome
        == Outcome::Starved
    {
        note_outcome(Outcome::Starved, header);
        return Ok(Body::LoadCycle(Box::new(no_orbit)));
    }
    let orbit_settings = OrbitSettings {
        crank_step: duty.crank_step,
        cycle_limit: duty.maximum_cycles,
        closure_tolerance: duty.closure_tolerance,
        ..OrbitSettings::default()
    };
    let mut watch = CycleWatch::new(duty.maximum_cycles);
    let mut film = film_of(case, settings)?;
    let orbit = journal_orbit(
        film.as_mut(),
        &case.bearing,
        &duty.cycle,
        &conditions(case),
        &orbit_settings,
        &mut |point, film, stage| watch.see(point, film, stage, progress),
    )?;
    note_outcome(orbit.outcome, header);
    if watch.stopped {
        header.messages.insert(
            0,
            "interrupted: the orbit is that of an unfinished run".to_owned(),
        );
    }
    let mut feed_flows = watch.feed_flows;
    // The observer also saw the start of a cycle, which is not a point of its own.
    feed_flows.drain(..feed_flows.len().saturating_sub(orbit.points.len()));
    Ok(Body::LoadCycle(Box::new(CycleResults {
        bearing: case.bearing.clone(),
        orbit,
        feed_flows,
        worst_film: watch.worst,
    })))
}

/// Copies from the running orbit what its points do not hold, and passes its progress on.
struct CycleWatch {
    expected_cycles: usize,
    cycle: usize,
    least_film: f64,
    worst: Option<CycleField>,
    feed_flows: Vec<Vec<sommerfeld_film::FeedFlow>>,
    stopped: bool,
}

impl CycleWatch {
    fn new(cycle_limit: usize) -> Self {
        /// Cycles that most orbits take to close: for the estimate of the time left.
        const USUAL_CYCLES: usize = 4;
        Self {
            expected_cycles: cycle_limit.min(USUAL_CYCLES),
            cycle: 0,
            least_film: f64::INFINITY,
            worst: None,
            feed_flows: Vec::new(),
            stopped: false,
        }
    }

    fn see(
        &mut self,
        point: &sommerfeld_bearing::CyclePoint,
        film: &dyn FilmForce,
        stage: sommerfeld_bearing::Progress,
        progress: &mut ProgressCallback<'_>,
    ) -> ControlFlow<()> {
        if stage.cycle != self.cycle {
            self.cycle = stage.cycle;
            self.least_film = f64::INFINITY;
        }
        let thickness = point.summary.minimum_film_thickness.value;
        if thickness < self.least_film {
            self.least_film = thickness;
            self.worst = film.field().map(|field| CycleField {
                crank_angle: point.crank_angle,
                field: FieldSnapshot::from(field),
            });
        }
        self.feed_flows.push(film.feed_flows().to_vec());
        let label = format!("cycle {}", stage.cycle);
        let done = (stage.cycle.saturating_sub(1) as f64 + stage.fraction)
            / self.expected_cycles.max(stage.cycle) as f64;
        let mut event = ProgressEvent::new(label, done.min(1.0));
        if point.outcome != Outcome::Converged {
            event.message = Some(format!(
                "crank angle {:.1} deg did not converge",
                point.crank_angle.to_degrees()
            ));
        }
        let answer = progress(event);
        self.stopped |= answer.is_break();
        answer
    }
}

/// Sets the status and says what it means and what to do.
fn note_outcome(outcome: Outcome, header: &mut Header) {
    header.status = outcome;
    let message = match outcome {
        Outcome::Converged => return,
        Outcome::NotConverged => {
            "not converged: the numbers are those of the last iterate; try a finer crank_step or grid"
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
