//! One state of the journal: given, or found as the equilibrium under a load.

use super::{conditions, film_of, note_outcome};
use crate::input::{Analysis, BearingCase, FilmSettings, SteadyLoad, Study, TiltCondition};
use crate::results::{Body, FieldSnapshot, Header, SteadyResults};
use sommerfeld_bearing::{Coefficients, EquilibriumRequest, EquilibriumSettings, find_equilibrium};
use sommerfeld_film::{
    Bearing, FilmError, FilmForce, FilmSolver, Inlet, JournalState, Linearised, Outcome, Step,
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
        steady.stiffness = Some(coefficients.translation_stiffness());
        steady.damping = Some(coefficients.translation_damping());
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
    let carried = load.unwrap_or_else(|| answer.reaction.force());
    let viscosity = case.lubricant.viscosity(case.temperature, 0.0).value;
    let has_film = matches!(answer.outcome, Outcome::Converged | Outcome::NotConverged);
    Body::Steady(Box::new(SteadyResults {
        bearing: bearing.clone(),
        state: *state,
        load,
        reaction: answer.reaction,
        summary: film.summary(),
        feed_flows: film.feed_flows().to_vec(),
        sommerfeld_number: sommerfeld_number(bearing, carried, viscosity, state),
        iterations,
        stiffness: None,
        damping: None,
        field: film.field().filter(|_| has_film).map(FieldSnapshot::from),
    }))
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
