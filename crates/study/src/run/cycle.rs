//! A load cycle: the orbit, and what its points do not hold.

use super::record::FieldRecorder;
use super::{ProgressCallback, conditions, film_of, note_outcome};
use crate::input::{BearingCase, CycleDuty, FilmSettings};
use crate::progress::ProgressEvent;
use crate::results::{Body, CycleResults, Header};
use crate::spool::FieldSpool;
use sommerfeld_bearing::{CyclePoint, JournalOrbit, OrbitSettings, Progress, journal_orbit};
use sommerfeld_film::{FeedFlow, FilmError, FilmForce, JournalState, Outcome, Step};
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
    let points = orbit_settings.points_per_cycle(&duty.cycle);
    let fields = FieldRecorder::new(points, case.bearing.cavitation_pressure, spool);
    let mut watch = CycleWatch::new(duty.maximum_cycles, fields);
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
        fields: watch.fields.finish(),
    })))
}

/// Copies from the running orbit what its points do not hold, and passes its progress on.
struct CycleWatch<'a> {
    expected_cycles: usize,
    fields: FieldRecorder<'a>,
    feed_flows: Vec<Vec<FeedFlow>>,
    stopped: bool,
}

impl<'a> CycleWatch<'a> {
    fn new(cycle_limit: usize, fields: FieldRecorder<'a>) -> Self {
        /// Cycles that most orbits take to close: for the estimate of the time left.
        const USUAL_CYCLES: usize = 4;
        Self {
            expected_cycles: cycle_limit.min(USUAL_CYCLES),
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
