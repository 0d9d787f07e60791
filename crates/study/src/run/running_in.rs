//! The running-in of a shell before its load cycle: an orbit for every step, each from the end of the
//! one before.

use super::ProgressCallback;
use super::cycle::{WarmStart, bearing_cycle, orbit_settings};
use super::record::FieldRecorder;
use crate::input::{BearingCase, CycleDuty, FilmSettings};
use crate::progress::ProgressEvent;
use crate::results::{Header, status_name};
use sommerfeld_bearing::{RanIn, RunningInEnd, WornCycle, run_in};
use sommerfeld_film::{Bearing, FilmError, Outcome};

/// Share of the run that the running-in is taken for, and not the orbit after it.
pub(super) const SHARE: f64 = 0.95;

/// Runs the shell of a case in, where the study asks for it; with it comes where the orbit of the last
/// step began. A caller that stops ends it: the cycle that was not finished counts as not converged.
pub(super) fn ran_in(
    case: &BearingCase,
    duty: &CycleDuty,
    settings: &FilmSettings,
    progress: &mut ProgressCallback<'_>,
) -> Result<(Option<RanIn>, Option<WarmStart>), FilmError> {
    let plan = case.wear.and_then(|wear| wear.running_in(&case.bearing));
    let Some(plan) = plan else {
        return Ok((None, None));
    };
    let mut cycles = WornCycles {
        case,
        // The coefficients belong to the bearing that has run in.
        duty: CycleDuty {
            coefficients_at: Vec::new(),
            ..duty.clone()
        },
        settings,
        start: None,
        end: None,
    };
    let hours = |time: f64| time / 3600.0;
    let ran = run_in(&case.bearing, &plan, |ran| {
        let label = format!(
            "running in, {:.3} of {} h",
            hours(ran.time),
            hours(plan.duration)
        );
        let done = SHARE * ran.time / plan.duration;
        cycles.next(&ran.bearing, &mut |event| {
            progress(ProgressEvent {
                label: format!("{label}, {}", event.label),
                done,
                ..event
            })
        })
    })?;
    Ok((Some(ran), cycles.start))
}

/// The orbits of a bearing that wears.
struct WornCycles<'a> {
    case: &'a BearingCase,
    duty: CycleDuty,
    settings: &'a FilmSettings,
    /// Where the last orbit began, and where it ended.
    start: Option<WarmStart>,
    end: Option<WarmStart>,
}

impl WornCycles<'_> {
    /// The orbit of the bearing as it is worn: from where the one before ended and, should it not
    /// converge from there, from rest.
    fn next(
        &mut self,
        bearing: &Bearing,
        progress: &mut ProgressCallback<'_>,
    ) -> Result<WornCycle, FilmError> {
        self.start = self.end.take();
        let (found, stopped) = self.orbit(bearing, progress)?;
        if found.outcome == Outcome::Converged || stopped || self.start.is_none() {
            return Ok(found);
        }
        self.start = None;
        Ok(self.orbit(bearing, progress)?.0)
    }

    /// The orbit from the start, and whether the caller stopped it.
    fn orbit(
        &mut self,
        bearing: &Bearing,
        progress: &mut ProgressCallback<'_>,
    ) -> Result<(WornCycle, bool), FilmError> {
        let worn = BearingCase {
            bearing: bearing.clone(),
            ..self.case.clone()
        };
        let points = orbit_settings(&self.duty).points_per_cycle(&self.duty.cycle);
        let recorder = FieldRecorder::new(points, 0, bearing.cavitation_pressure, None)
            .with_wear(&worn, &self.duty);
        let start = self.start.as_ref();
        let solved = bearing_cycle(&worn, &self.duty, self.settings, start, recorder, progress)?;
        self.end = solved.end;
        let cycle = solved.results;
        let (share, thinnest) = (cycle.contact_load_share(), cycle.minimum_film_thickness());
        let thinnest = thinnest.map_or(f64::NAN, |p| p.summary.minimum_film_thickness.value);
        let outcome = cycle.orbit.outcome;
        let wear = cycle.fields.and_then(|fields| fields.on_shell.wear);
        let found = match wear {
            Some(wear) => WornCycle {
                contact_share: share,
                minimum_film_thickness: thinnest,
                on_shell: wear.map,
                outcome,
            },
            None => WornCycle::not_solved(match outcome {
                Outcome::Converged => Outcome::NotConverged,
                failed => failed,
            }),
        };
        Ok((found, solved.stopped))
    }
}

/// Tells how the running-in of a shell ended, and what kept it from the time asked for.
pub(super) fn note(ran: &RanIn, header: &mut Header) {
    let after = ran.time / 3600.0;
    let (status, why) = match ran.end {
        RunningInEnd::TimeOver => return,
        RunningInEnd::Settled | RunningInEnd::Faded => {
            let message = if ran.end == RunningInEnd::Settled {
                format!(
                    "the shell has run in after {after:.3} h: the map of its wear no longer changes"
                )
            } else {
                format!(
                    "the shell has run in after {after:.3} h: its wear has faded to settled_below of the \
                     first; settled_below = 0 runs on"
                )
            };
            header.messages.push(message);
            return;
        }
        RunningInEnd::StepLimit => (
            Outcome::NotConverged,
            "its steps were used up; give more steps, or a larger step_depth".to_owned(),
        ),
        RunningInEnd::NotSolved(outcome) => (
            outcome,
            format!("a load cycle ended as {}", status_name(outcome)),
        ),
    };
    if header.status == Outcome::Converged {
        header.status = status;
    }
    let message = format!("the shell ran in for {after:.3} h only: {why}");
    header.messages.insert(0, message);
}
