//! Is a converged result still one that the physics of the run can mean?
//!
//! The equations have solutions far outside what they describe: a film thinner than the roughness of
//! any shaft, pressures at which no shell is rigid, a flow that would not be laminar. Such a result
//! keeps its numbers and gets a message that says what they are worth. Design limits are another
//! thing: they are the user's, in [`limits`](crate::limits).

use crate::input::{BearingCase, Duty};
use crate::limits::Quantity;
use crate::results::Results;
use std::f64::consts::PI;

/// Thinnest film that smooth surfaces can stand for, m. The finest finished journals and shells have
/// a combined roughness of some 0.03 um rms, and from about three times the combined roughness
/// downwards asperities carry a part of the load (film parameter of mixed lubrication).
pub const SMOOTH_SURFACES: f64 = 0.1e-6;

/// Largest film pressure that a rigid shell and a viscosity without pressure can stand for, Pa. Under
/// 1 GPa steel gives way elastically by about `p R/E`, 0.5 % of the radius and several times a usual
/// clearance, and mineral oils with pressure coefficients of 15/GPa and more are a million times as
/// viscous as at ambient pressure.
pub const RIGID_SHELL: f64 = 1e9;

/// Reynolds number `rho u c/eta` over `sqrt(R/c)` above which vortices form between a turning journal
/// and its shell, which the Reynolds equation does not know: the square root of the critical Taylor
/// number 1708 of G. I. Taylor, Phil. Trans. R. Soc. A 223 (1923), stated for a concentric journal;
/// eccentricity moves it by a factor of order one.
pub const TAYLOR_VORTICES: f64 = 41.3;

/// What a reader of the results must know; empty where the physics holds. A result that is not there
/// is not judged. `case` is the bearing of the study, if it has one.
#[must_use]
pub fn warnings(results: &Results, case: Option<&BearingCase>) -> Vec<String> {
    let thinnest = results.limited_value(Quantity::MinimumFilmThickness);
    let peak = results.limited_value(Quantity::PeakFilmPressure);
    let mut found = Vec::new();
    if let Some(film) = thinnest.filter(|film| *film < SMOOTH_SURFACES) {
        found.push(format!(
            "the minimum film thickness, {} um, is below {} um: real surfaces touch there, and this \
             film of smooth surfaces does not know contact; read it as overload",
            short(1e6 * film),
            short(1e6 * SMOOTH_SURFACES)
        ));
    }
    if let Some(pressure) = peak.filter(|pressure| *pressure > RIGID_SHELL) {
        found.push(format!(
            "the peak film pressure, {} GPa, is above {} GPa: a rigid shell and a viscosity without \
             pressure mean nothing there; read it as overload",
            short(1e-9 * pressure),
            short(1e-9 * RIGID_SHELL)
        ));
    }
    found.extend(case.and_then(vortices));
    found
}

/// Three digits, as many as such a number is worth.
fn short(value: f64) -> String {
    let rounded = format!("{value:.2e}");
    match rounded.parse::<f64>() {
        Ok(plain) if (1e-4..1e6).contains(&plain.abs()) => plain.to_string(),
        _ => rounded,
    }
}

/// The flow in the gap at the highest speed of the study is not laminar.
fn vortices(case: &BearingCase) -> Option<String> {
    let radius = 0.5 * case.bearing.diameter;
    let clearance = case.bearing.radial_clearance;
    let speed = relative_speed(&case.duty);
    let viscosity = case.lubricant.viscosity(case.temperature, 0.0).value;
    let density = case.lubricant.density(case.temperature, 0.0).value;
    let reynolds = density * speed * radius * clearance / viscosity;
    let critical = TAYLOR_VORTICES * (radius / clearance).sqrt();
    (reynolds > critical).then(|| {
        format!(
            "the Reynolds number of the gap, {reynolds:.0} at {:.0} rpm, is above {critical:.0}: \
             vortices form and the flow may not be laminar; friction is then higher than given here",
            speed * 30.0 / PI
        )
    })
}

/// Largest angular speed of the journal against the shell, rad/s, while the journal is the faster
/// one: with a shell that turns faster the layers of the flow are stable.
fn relative_speed(duty: &Duty) -> f64 {
    let relative = |journal: f64, shell: f64| {
        if journal.abs() > shell.abs() {
            (journal - shell).abs()
        } else {
            0.0
        }
    };
    match duty {
        Duty::State(state) => relative(state.journal_speed, state.shell_speed),
        Duty::Load(load) => relative(load.journal_speed, load.shell_speed),
        Duty::Cycle(duty) => duty
            .cycle
            .points
            .iter()
            .map(|point| relative(point.journal_speed, point.shell_speed))
            .fold(0.0, f64::max),
    }
}
