//! A load cycle: the orbit, and what its points do not hold.

use super::record::FieldRecorder;
use super::{
    ProgressCallback, conditions, film_of, note_edge_contact, note_outcome, with_reynolds_number,
};
use crate::input::{BearingCase, CycleDuty, FilmSettings};
use crate::progress::ProgressEvent;
use crate::results::{Body, CycleResults, Header, InstantCoefficients};
use crate::spool::FieldSpool;
use sommerfeld_bearing::{
    CyclePoint, JournalOrbit, OrbitSettings, Progress, instant_coefficients, journal_orbit,
};
use sommerfeld_film::{FeedFlow, FilmError, FilmForce, FilmHistory, JournalState, Outcome, Step};
use std::ops::ControlFlow;

pub(super) fn solve_cycle(
    case: &BearingCase,
    duty: &CycleDuty,
    settings: &FilmSettings,
    header: &mut Header,
    spool: Option<&mut FieldSpool>,
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
        fields: None,
        coefficients: Vec::new(),
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
    let usual = OrbitSettings::default();
    let orbit_settings = OrbitSettings {
        error_tolerance: usual.error_tolerance * duty.step_error_factor,
        history_error_tolerance: usual.history_error_tolerance * duty.step_error_factor,
        crank_step: duty.crank_step,
        cycle_limit: duty.maximum_cycles,
        closure_tolerance: duty.closure_tolerance,
        ..usual
    };
    let points = orbit_settings.points_per_cycle(&duty.cycle);
    let fields = FieldRecorder::new(points, case.bearing.cavitation_pressure, spool);
    let mut watch = CycleWatch::new(duty, fields);
    let mut film = film_of(case, settings)?;
    let mut orbit = journal_orbit(
        film.as_mut(),
        &case.bearing,
        &duty.cycle,
        &conditions(case),
        &orbit_settings,
        &mut |point, film, stage| watch.see(point, film, stage, progress),
    )?;
    for point in &mut orbit.points {
        point.summary = with_reynolds_number(point.summary, case, &point.state);
    }
    note_outcome(orbit.outcome, header);
    let contact = orbit.edge_contact(&duty.cycle, case.bearing.radial_clearance);
    if let Some((crank_angle, edge)) = contact {
        let at = format!("at crank angle {:.1} deg", crank_angle.to_degrees());
        note_edge_contact(edge, &at, header);
    }
    if watch.stopped {
        header.messages.insert(
            0,
            "interrupted: the orbit is that of an unfinished run".to_owned(),
        );
    }
    let coefficients = watch.coefficients(case, film.as_mut())?;
    let mut feed_flows = watch.feed_flows;
    // The observer also saw the start of a cycle, which is not a point of its own.
    feed_flows.drain(..feed_flows.len().saturating_sub(orbit.points.len()));
    Ok(Body::LoadCycle(Box::new(CycleResults {
        bearing: case.bearing.clone(),
        orbit,
        feed_flows,
        fields: watch.fields.finish(),
        coefficients,
    })))
}

/// A crank angle at which coefficients are asked for, and what was seen nearest to it.
struct Request {
    crank_angle: f64,
    seen: Option<(CyclePoint, FilmHistory)>,
}

/// Copies from the running orbit what its points do not hold, and passes its progress on.
struct CycleWatch<'a> {
    requests: Vec<Request>,
    period: f64,
    crank_step: f64,
    expected_cycles: usize,
    fields: FieldRecorder<'a>,
    feed_flows: Vec<Vec<FeedFlow>>,
    stopped: bool,
}

impl<'a> CycleWatch<'a> {
    fn new(duty: &CycleDuty, fields: FieldRecorder<'a>) -> Self {
        /// Cycles that most orbits take to close: for the estimate of the time left.
        const USUAL_CYCLES: usize = 4;
        Self {
            requests: duty
                .coefficients_at
                .iter()
                .map(|&crank_angle| Request {
                    crank_angle,
                    seen: None,
                })
                .collect(),
            period: duty.cycle.period,
            crank_step: duty.crank_step,
            expected_cycles: duty.maximum_cycles.min(USUAL_CYCLES),
            fields,
            feed_flows: Vec::new(),
            stopped: false,
        }
    }

    fn see(
        &mut self,
        point: &CyclePoint,
        film: &dyn FilmForce,
        stage: Progress,
        progress: &mut ProgressCallback<'_>,
    ) -> ControlFlow<()> {
        if let Some(field) = film.field()
            && !self.fields.see(stage, point, &field)
        {
            return ControlFlow::Break(());
        }
        for request in &mut self.requests {
            let apart = (point.crank_angle - request.crank_angle).rem_euclid(self.period);
            let distance = apart.min(self.period - apart);
            if distance <= 0.500_001 * self.crank_step {
                request.seen = Some((*point, film.instant()));
            }
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

    /// Stiffness and damping at what was seen last near each crank angle asked for.
    fn coefficients(
        &self,
        case: &BearingCase,
        film: &mut dyn FilmForce,
    ) -> Result<Vec<InstantCoefficients>, FilmError> {
        let has_tilt = film.capabilities().accepts_tilt;
        let mut all = Vec::new();
        for request in &self.requests {
            let Some((point, instant)) = &request.seen else {
                continue;
            };
            let (coefficients, outcome) =
                instant_coefficients(film, &point.state, instant, &conditions(case))?;
            let turns = ((request.crank_angle - point.crank_angle) / self.period).round();
            all.push(InstantCoefficients {
                crank_angle: point.crank_angle + turns * self.period,
                load: point.load,
                coefficients,
                has_tilt,
                outcome: match point.outcome {
                    Outcome::Converged => outcome,
                    failed => failed,
                },
            });
        }
        Ok(all)
    }
}
