//! A load cycle: the orbit, and what its points do not hold.

use super::heat_field::{CYCLE_TOLERANCE, FieldHeat};
use super::record::FieldRecorder;
use super::running_in;
use super::{
    ProgressCallback, conditions, film_of, note_edge_contact, note_outcome, with_reynolds_number,
};
use crate::input::{BearingCase, CycleDuty, FilmSettings};
use crate::progress::ProgressEvent;
use crate::results::{Body, CycleFields, CycleResults, Header, InstantCoefficients, MOST_FRAMES};
use crate::spool::FieldSpool;
use sommerfeld_bearing::{
    CycleHeat, CyclePoint, JournalOrbit, LoadCycle, Observer, OrbitSettings, OrbitStart, Progress,
    instant_coefficients, journal_orbit, warm_orbit,
};
use sommerfeld_film::{
    Bearing, FeedFlow, FilmError, FilmForce, FilmHistory, JournalState, Outcome, Step, Warmed,
};
use std::ops::ControlFlow;

pub(super) fn solve_cycle(
    case: &BearingCase,
    duty: &CycleDuty,
    settings: &FilmSettings,
    header: &mut Header,
    spool: Option<&mut FieldSpool>,
    progress: &mut ProgressCallback<'_>,
) -> Result<Body, FilmError> {
    let recorder = FieldRecorder::new(
        orbit_settings(duty).points_per_cycle(&duty.cycle),
        MOST_FRAMES,
        case.bearing.cavitation_pressure,
        spool,
    );
    let (ran_in, start) = running_in::ran_in(case, duty, settings, progress)?;
    let worn = ran_in.as_ref().map(|ran| BearingCase {
        bearing: ran.bearing.clone(),
        ..case.clone()
    });
    let case = worn.as_ref().unwrap_or(case);
    let recorder = recorder.with_wear(case, duty);
    let before = ran_in.as_ref().map_or(0.0, |_| running_in::SHARE);
    let mut after = |event: ProgressEvent| {
        let done = before + (1.0 - before) * event.done;
        progress(ProgressEvent { done, ..event })
    };
    let mut solved = bearing_cycle(case, duty, settings, start.as_ref(), recorder, &mut after)?;
    if let Some(ran) = &ran_in {
        running_in::note(ran, header);
    }
    solved.results.running_in = ran_in;
    note_outcome(solved.results.orbit.outcome, header);
    if let (Some(heat), Some((warmed, changes))) = (FieldHeat::of(case), &solved.warmth) {
        // What the orbit did not reach was said of the orbit.
        heat.note(case, warmed, changes, Outcome::Converged, header);
    }
    if let Some((crank_angle, edge)) = solved.edge_contact {
        let at = format!("at crank angle {:.1} deg", crank_angle.to_degrees());
        note_edge_contact(edge, &at, header);
    }
    if solved.stopped {
        header.messages.insert(
            0,
            "interrupted: the orbit is that of an unfinished run".to_owned(),
        );
    }
    Ok(Body::LoadCycle(Box::new(solved.results)))
}

/// What the load cycle of one bearing left.
pub(super) struct SolvedCycle {
    /// The orbit and what its points do not hold.
    pub results: CycleResults,
    /// Crank angle (rad) and edge (0 the front, 1 the rear) where a moment presses the journal to
    /// contact.
    pub edge_contact: Option<(f64, usize)>,
    /// The caller asked to stop before the orbit had closed.
    pub stopped: bool,
    /// The fields of each bearing that does the same later; none if the film showed none.
    pub turned: Vec<CycleFields>,
    /// Temperatures, where they are a field.
    pub warmth: Option<Warmth>,
    /// Where a bearing that differs little may begin, after an orbit that converged.
    pub end: Option<WarmStart>,
}

/// Where an orbit begins: at the end of one of a bearing that differs little.
#[derive(Debug, Clone)]
pub(super) struct WarmStart {
    /// The journal.
    pub state: JournalState,
    /// What the film remembers.
    pub content: FilmHistory,
}

/// The results of a bearing whose journal runs no orbit.
pub(super) fn without_orbit(bearing: &Bearing, outcome: Outcome) -> CycleResults {
    CycleResults {
        bearing: bearing.clone(),
        orbit: JournalOrbit {
            points: Vec::new(),
            cycles: 0,
            closure: f64::NAN,
            steps: 0,
            film_solves: 0,
            outcome,
        },
        feed_flows: Vec::new(),
        fields: None,
        coefficients: Vec::new(),
        running_in: None,
    }
}

/// Whether the film of a bearing gets no oil at all: it would empty over the cycles and the journal
/// sink into the shell.
pub(super) fn is_starved(
    case: &BearingCase,
    engine_speed: f64,
    settings: &FilmSettings,
) -> Result<bool, FilmError> {
    let centred = JournalState {
        journal_speed: engine_speed,
        ..JournalState::default()
    };
    let mut film = film_of(case, settings)?;
    let found = film.linearise(&centred, Step::Steady, &conditions(case))?;
    Ok(found.outcome == Outcome::Starved)
}

/// How the orbit of a duty is computed.
pub(super) fn orbit_settings(duty: &CycleDuty) -> OrbitSettings {
    let usual = OrbitSettings::default();
    OrbitSettings {
        error_tolerance: usual.error_tolerance * duty.step_error_factor,
        history_error_tolerance: usual.history_error_tolerance * duty.step_error_factor,
        crank_step: duty.crank_step,
        cycle_limit: duty.maximum_cycles,
        closure_tolerance: duty.closure_tolerance,
        ..usual
    }
}

/// The orbit of one bearing over its load cycle, from a start or from rest, with the fields that
/// `fields` records.
pub(super) fn bearing_cycle(
    case: &BearingCase,
    duty: &CycleDuty,
    settings: &FilmSettings,
    start: Option<&WarmStart>,
    fields: FieldRecorder<'_>,
    progress: &mut ProgressCallback<'_>,
) -> Result<SolvedCycle, FilmError> {
    if is_starved(case, duty.cycle.engine_speed, settings)? {
        return Ok(SolvedCycle {
            results: without_orbit(&case.bearing, Outcome::Starved),
            edge_contact: None,
            stopped: false,
            turned: Vec::new(),
            warmth: None,
            end: None,
        });
    }
    let mut watch = CycleWatch::new(duty, fields);
    let mut film = film_of(case, settings)?;
    let heat = FieldHeat::of(case);
    let (mut orbit, warmth) = orbit_of(
        (case, duty),
        start,
        film.as_mut(),
        heat.as_ref(),
        &mut |p, f, s| watch.see(p, f, s, progress),
    )?;
    let last = orbit
        .points
        .last()
        .filter(|_| orbit.outcome == Outcome::Converged);
    let end = last.map(|point| WarmStart {
        state: point.state,
        content: film.history(),
    });
    for point in &mut orbit.points {
        point.summary = with_reynolds_number(point.summary, case, &point.state);
    }
    let coefficients = watch.coefficients(case, film.as_mut())?;
    let mut solved = watch.finish(case, &duty.cycle, orbit, coefficients);
    solved.warmth = warmth;
    solved.end = end;
    Ok(solved)
}

/// The orbit, in the film's own temperatures where they are a field.
fn orbit_of(
    (case, duty): (&BearingCase, &CycleDuty),
    start: Option<&WarmStart>,
    film: &mut dyn FilmForce,
    heat: Option<&FieldHeat>,
    observer: &mut Observer<'_>,
) -> Result<(JournalOrbit, Option<Warmth>), FilmError> {
    let (bearing, cycle) = (&case.bearing, &duty.cycle);
    let (conditions, mut settings) = (conditions(case), orbit_settings(duty));
    if let Some(start) = start {
        film.restore(&start.content);
        settings.start = OrbitStart::At(start.state);
    }
    let Some(heat) = heat else {
        let orbit = journal_orbit(film, bearing, cycle, &conditions, &settings, observer)?;
        return Ok((orbit, None));
    };
    let heat = CycleHeat {
        surroundings: heat.surroundings(),
        tolerance: CYCLE_TOLERANCE,
    };
    let found = warm_orbit(
        film,
        bearing,
        cycle,
        &conditions,
        &settings,
        &heat,
        observer,
    )?;
    Ok((found.orbit, Some((found.warmed, found.changes))))
}

/// Temperatures of the film and their largest change in each cycle, K.
type Warmth = (Warmed, Vec<f64>);

/// A crank angle at which coefficients are asked for, and what was seen nearest to it.
struct Request {
    crank_angle: f64,
    seen: Option<(CyclePoint, FilmHistory)>,
}

/// Copies from the running orbit what its points do not hold, and passes its progress on.
pub(super) struct CycleWatch<'a> {
    requests: Vec<Request>,
    period: f64,
    crank_step: f64,
    expected_cycles: usize,
    fields: FieldRecorder<'a>,
    feed_flows: Vec<Vec<FeedFlow>>,
    stopped: bool,
}

impl<'a> CycleWatch<'a> {
    pub(super) fn new(duty: &CycleDuty, fields: FieldRecorder<'a>) -> Self {
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

    pub(super) fn see(
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

    /// What was seen beside the orbit that it led to.
    pub(super) fn finish(
        self,
        case: &BearingCase,
        cycle: &LoadCycle,
        orbit: JournalOrbit,
        coefficients: Vec<InstantCoefficients>,
    ) -> SolvedCycle {
        let mut feed_flows = self.feed_flows;
        // The observer also saw the start of a cycle, which is not a point of its own.
        feed_flows.drain(..feed_flows.len().saturating_sub(orbit.points.len()));
        let mut fields = self.fields.finish().into_iter();
        SolvedCycle {
            edge_contact: orbit.edge_contact(cycle, case.bearing.radial_clearance),
            stopped: self.stopped,
            results: CycleResults {
                bearing: case.bearing.clone(),
                orbit,
                feed_flows,
                fields: fields.next(),
                coefficients,
                running_in: None,
            },
            turned: fields.collect(),
            warmth: None,
            end: None,
        }
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
