//! One state of the journal: given, or found as the equilibrium under a load.

use super::heat_field::FieldHeat;
use super::{
    ProgressCallback, conditions, film_of, note_edge_contact, note_outcome, with_reynolds_number,
};
use crate::input::{Analysis, BearingCase, FilmSettings, SteadyLoad, Study, TiltCondition};
use crate::progress::ProgressEvent;
use crate::results::{Body, Dynamics, FieldSnapshot, Header, SteadyResults, status_name};
use sommerfeld_bearing::{
    Coefficients, Equilibrium, EquilibriumRequest, EquilibriumSettings, HeatFieldSettings,
    Stability, StabilityChart, closing_edge, find_equilibrium, rotor_stability, stability_chart,
    warm_equilibrium,
};
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
    progress: &mut ProgressCallback<'_>,
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
    let found = at_rest(case, film.as_mut(), &request, header)?;
    note_outcome(found.outcome, header);
    let edges = case.bearing.edge_film_thickness(&found.state);
    let closing = closing_edge(edges, case.bearing.radial_clearance);
    if let (Outcome::NotConverged, Some(_), Some(edge)) = (found.outcome, moment, closing) {
        note_edge_contact(edge, "under this load", header);
    }
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
        if found.outcome == Outcome::Converged {
            let (coefficients, has_tilt) = with_tilt(case, study, film.as_ref(), &found)?;
            let chart = chart(case, study, film.as_mut(), &request, header, progress)?;
            let stability = rotor_stability(&coefficients);
            note_stability(stability, study.rotor.mass, header);
            steady.dynamics = Some(Box::new(Dynamics {
                coefficients,
                has_tilt,
                stability,
                rotor_mass: study.rotor.mass,
                chart,
            }));
        }
    }
    Ok(body)
}

/// The equilibrium, in the film's own temperatures where they are a field.
fn at_rest(
    case: &BearingCase,
    film: &mut dyn FilmForce,
    request: &EquilibriumRequest,
    header: &mut Header,
) -> Result<Equilibrium, FilmError> {
    let Some(heat) = FieldHeat::of(case) else {
        return find_equilibrium(film, &case.bearing, request, &conditions(case));
    };
    let usual = HeatFieldSettings::default();
    let found = warm_equilibrium(
        film,
        &case.bearing,
        request,
        &conditions(case),
        &heat.surroundings(),
        &usual,
    )?;
    let outcome = match found.rest.outcome {
        Outcome::Converged => found.outcome,
        // Said of the equilibrium itself.
        _ => Outcome::Converged,
    };
    heat.note(case, &found.warmed, &found.changes, outcome, header);
    Ok(Equilibrium {
        film_updates: found.film_updates,
        ..found.rest
    })
}

/// Coefficients with tilt. An aligned journal is solved on half a film, which knows none: the whole
/// film is solved once more at the equilibrium.
fn with_tilt(
    case: &BearingCase,
    study: &Study,
    film: &dyn FilmForce,
    found: &Equilibrium,
) -> Result<(Coefficients, bool), FilmError> {
    let own = Coefficients::from_tangent(&found.tangent);
    if film.capabilities().accepts_tilt || !study.film.model.is_field() {
        return Ok((own, film.capabilities().accepts_tilt));
    }
    let mut whole = FilmSolver::new(&case.bearing, &case.lubricant, study.film.grid)?;
    let answer = whole.react(&found.state, Step::Steady, &conditions(case))?;
    Ok(match answer.outcome {
        Outcome::Converged => (Coefficients::from_tangent(&answer.tangent), true),
        _ => (own, false),
    })
}

/// Stability over the speeds of the study, if it names any.
fn chart(
    case: &BearingCase,
    study: &Study,
    film: &mut dyn FilmForce,
    request: &EquilibriumRequest,
    header: &mut Header,
    progress: &mut ProgressCallback<'_>,
) -> Result<Option<StabilityChart>, FilmError> {
    if study.rotor.speeds.is_empty() {
        return Ok(None);
    }
    let chart = stability_chart(
        film,
        &case.bearing,
        request,
        (&study.rotor.speeds, study.rotor.mass),
        &conditions(case),
        &mut |share| progress(ProgressEvent::new("stability chart".to_owned(), share)),
    )?;
    if chart.points.len() < study.rotor.speeds.len() {
        header.messages.insert(
            0,
            "interrupted: the stability chart is unfinished".to_owned(),
        );
    }
    if chart.outcome != Outcome::Converged && header.status == Outcome::Converged {
        header.status = chart.outcome;
        let message = format!(
            "{}: not every speed of the stability chart; stability.csv tells which",
            status_name(chart.outcome)
        );
        header.messages.insert(0, message);
    }
    Ok(Some(chart))
}

/// Says what a threshold that is not there means, and that a rotor is unstable.
fn note_stability(stability: Stability, rotor_mass: Option<f64>, header: &mut Header) {
    match stability {
        Stability::Below(_) => {}
        Stability::EveryMass => header.messages.push(
            "no whirl threshold: small motions of a rigid rotor decay at this speed whatever its mass"
                .to_owned(),
        ),
        Stability::NoMass => header.messages.push(
            "no whirl threshold: the film drives a rigid rotor away or around at this speed whatever \
             its mass"
                .to_owned(),
        ),
    }
    if rotor_mass.is_some_and(|mass| !stability.is_stable(mass)) {
        header
            .messages
            .push("the rotor is unstable at this speed: it whirls".to_owned());
    }
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
        (
            answer.reaction,
            with_reynolds_number(film.summary(), case, &state),
        )
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
        dynamics: None,
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
        edge_film_thickness: [f64::NAN; 2],
        peak_film_pressure: nowhere,
        peak_contact_pressure: nowhere,
        contact_load: f64::NAN,
        boundary_power: f64::NAN,
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
