//! A load cycle: the orbit, and what its points do not hold.

use super::{ProgressCallback, conditions, film_of, note_outcome};
use crate::input::{BearingCase, CycleDuty, FilmSettings};
use crate::progress::ProgressEvent;
use crate::results::{
    AccumulatedMap, Body, CycleField, CycleFields, CycleResults, FieldSnapshot, Header, MOST_FRAMES,
};
use sommerfeld_bearing::{CyclePoint, JournalOrbit, OrbitSettings, Progress, journal_orbit};
use sommerfeld_film::{FeedFlow, FilmError, FilmForce, JournalState, Outcome, Step};
use std::ops::ControlFlow;

pub(super) fn solve_cycle(
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
    let mut watch = CycleWatch::new(duty.maximum_cycles);
    watch.fields.spacing = duty.cycle.period / MOST_FRAMES as f64;
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
        fields: watch.fields.finished(),
    })))
}

/// Copies from the running orbit what its points do not hold, and passes its progress on.
struct CycleWatch {
    expected_cycles: usize,
    cycle: usize,
    fields: FieldRecord,
    feed_flows: Vec<Vec<FeedFlow>>,
    stopped: bool,
}

impl CycleWatch {
    fn new(cycle_limit: usize) -> Self {
        /// Cycles that most orbits take to close: for the estimate of the time left.
        const USUAL_CYCLES: usize = 4;
        Self {
            expected_cycles: cycle_limit.min(USUAL_CYCLES),
            cycle: 0,
            fields: FieldRecord::default(),
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
        if stage.cycle != self.cycle {
            self.cycle = stage.cycle;
            self.fields.restart();
        }
        if let Some(field) = film.field() {
            self.fields.see(point, &FieldSnapshot::from(field));
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

/// The fields of the running cycle, as few as a report needs.
#[derive(Default)]
struct FieldRecord {
    spacing: f64,
    frames: Vec<CycleField>,
    worst: Option<(f64, CycleField)>,
    /// Smallest film, largest and smallest pressure, points with a full film, of shell and journal.
    seen: [Vec<[f64; 4]>; 2],
    points: f64,
}

impl FieldRecord {
    fn restart(&mut self) {
        self.frames.clear();
        self.worst = None;
        self.seen = Default::default();
        self.points = 0.0;
    }

    fn see(&mut self, point: &CyclePoint, field: &FieldSnapshot) {
        let snapshot = || CycleField {
            crank_angle: point.crank_angle,
            field: field.clone(),
        };
        let is_due = self
            .frames
            .last()
            .is_none_or(|last| point.crank_angle > last.crank_angle + self.spacing - 1e-9);
        if is_due && self.frames.len() < MOST_FRAMES {
            self.frames.push(snapshot());
        }
        let thickness = point.summary.minimum_film_thickness.value;
        if self
            .worst
            .as_ref()
            .is_none_or(|(least, _)| thickness < *least)
        {
            self.worst = Some((thickness, snapshot()));
        }
        self.points += 1.0;
        let (around, along) = (field.angles.len(), field.axial.len());
        let cell = std::f64::consts::TAU / around as f64;
        for (seen, turned) in self.seen.iter_mut().zip([0.0, point.state.journal_angle]) {
            seen.resize(around * along, [f64::INFINITY, 0.0, f64::INFINITY, 0.0]);
            let shift = (turned / cell).round() as i64;
            for i in 0..around {
                let to = (i as i64 - shift).rem_euclid(around as i64) as usize;
                for j in 0..along {
                    let (from, to) = (i * along + j, to * along + j);
                    let [film, high, low, full] = &mut seen[to];
                    *film = film.min(field.film_thickness[from]);
                    *high = high.max(field.pressure[from]);
                    *low = low.min(field.pressure[from]);
                    *full += f64::from(u8::from(field.film_fraction[from] >= 1.0));
                }
            }
        }
    }

    fn finished(self) -> Option<CycleFields> {
        let (_, worst) = self.worst?;
        let [on_shell, on_journal] = self.seen.map(|seen| AccumulatedMap {
            angles: worst.field.angles.clone(),
            axial: worst.field.axial.clone(),
            minimum_film_thickness: seen.iter().map(|cell| cell[0]).collect(),
            maximum_pressure: seen.iter().map(|cell| cell[1]).collect(),
            pressure_amplitude: seen.iter().map(|cell| 0.5 * (cell[1] - cell[2])).collect(),
            full_film_share: seen.iter().map(|cell| cell[3] / self.points).collect(),
        });
        Some(CycleFields {
            frames: self.frames,
            worst,
            on_shell,
            on_journal,
        })
    }
}
