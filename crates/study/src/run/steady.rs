//! One state of the journal: given, or found as the equilibrium under a load.

use super::{conditions, film_of, note_outcome};
use crate::input::{Analysis, BearingCase, FilmSettings, SteadyLoad, Study, TiltCondition};
use crate::results::{Body, FieldSnapshot, Header, SteadyResults};
use sommerfeld_bearing::{Coefficients, EquilibriumRequest, EquilibriumSettings, find_equilibrium};
use sommerfeld_film::{
    Bearing, Extreme, FilmError, FilmForce, FilmSolver, FilmSummary, Inlet, JournalState,
    Linearised, Outcome, Reaction, Step,
};

pub(super) fn solve_state(
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

pub(super) fn solve_load(
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
