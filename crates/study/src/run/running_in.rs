//! The running-in of a shell before its load cycle: an orbit for every step.

use super::ProgressCallback;
use super::cycle::{bearing_cycle, orbit_settings};
use super::record::FieldRecorder;
use crate::input::{BearingCase, CycleDuty, FilmSettings};
use crate::progress::ProgressEvent;
use crate::results::{Header, magnitude, status_name};
use sommerfeld_bearing::{RanIn, RunningInEnd, WornCycle, run_in};
use sommerfeld_film::{FilmError, Outcome};

/// Runs the shell of a case in, where the study asks for it. A caller that stops ends it: the cycle
/// that was not finished counts as not converged.
pub(super) fn ran_in(
    case: &BearingCase,
    duty: &CycleDuty,
    settings: &FilmSettings,
    progress: &mut ProgressCallback<'_>,
) -> Result<Option<RanIn>, FilmError> {
    let plan = case.wear.and_then(|wear| wear.running_in(&case.bearing));
    let Some(plan) = plan else {
        return Ok(None);
    };
    let points = orbit_settings(duty).points_per_cycle(&duty.cycle);
    // The coefficients belong to the bearing that has run in.
    let duty = CycleDuty {
        coefficients_at: Vec::new(),
        ..duty.clone()
    };
    let mut step = 0;
    let ran = run_in(&case.bearing, &plan, |bearing| {
        step += 1;
        let worn = BearingCase {
            bearing: bearing.clone(),
            ..case.clone()
        };
        let recorder = FieldRecorder::new(points, 0, bearing.cavitation_pressure, None)
            .with_wear(&worn, &duty);
        let solved = bearing_cycle(&worn, &duty, settings, recorder, &mut |event| {
            progress(ProgressEvent {
                label: format!("running in, step {step}, {}", event.label),
                ..event
            })
        })?;
        let cycle = solved.results;
        let load = cycle.mean(|point| magnitude(point.load));
        let wear = cycle.fields.and_then(|fields| fields.on_shell.wear);
        match wear {
            Some(wear) => Ok(WornCycle {
                contact_share: cycle.orbit.mean(|p| p.summary.contact_load) / load,
                on_shell: wear.map,
                outcome: cycle.orbit.outcome,
            }),
            None => Ok(WornCycle::not_solved(match cycle.orbit.outcome {
                Outcome::Converged => Outcome::NotConverged,
                failed => failed,
            })),
        }
    })?;
    Ok(Some(ran))
}

/// Tells what kept a shell from running in for the time asked for.
pub(super) fn note(ran: &RanIn, header: &mut Header) {
    let after = ran.time / 3600.0;
    let (status, why) = match ran.end {
        RunningInEnd::Settled | RunningInEnd::TimeOver => return,
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
