//! Is a converged result still one that the physics of the run can mean?
//!
//! The equations have solutions far outside what they describe: a film thinner than the roughness of
//! any shaft, pressures at which no shell is rigid. Such a result keeps its numbers and gets a message
//! that says what they are worth. Whether the flow is laminar is asked in [`regime`](crate::regime).
//! Design limits are another thing: they are the user's, in [`limits`](crate::limits).

use crate::limits::Quantity;
use crate::results::{Body, Results};

/// Thinnest film that smooth surfaces can stand for, m. The finest finished journals and shells have
/// a combined roughness of some 0.03 um rms, and from about three times the combined roughness
/// downwards asperities carry a part of the load (film parameter of mixed lubrication).
pub const SMOOTH_SURFACES: f64 = 0.1e-6;

/// Largest film pressure that a rigid shell and a viscosity without pressure can stand for, Pa. Under
/// 1 GPa steel gives way elastically by about `p R/E`, 0.5 % of the radius and several times a usual
/// clearance, and mineral oils with pressure coefficients of 15/GPa and more are a million times as
/// viscous as at ambient pressure.
pub const RIGID_SHELL: f64 = 1e9;

/// What a reader of the results must know; empty where the physics holds. A result that is not there
/// is not judged; of a machine the run names the bearings.
#[must_use]
pub fn warnings(results: &Results) -> Vec<String> {
    if let Body::Machine(_) = &results.body {
        return Vec::new();
    }
    let thinnest = results.limited_value(Quantity::MinimumFilmThickness);
    let peak = results.limited_value(Quantity::PeakFilmPressure);
    let knows_contact = match &results.body {
        Body::Steady(steady) => steady.bearing.finish.has_contact(),
        Body::LoadCycle(cycle) => cycle.bearing.finish.has_contact(),
        Body::Dimensionless(_) | Body::Machine(_) | Body::Database(_) | Body::Sweep(_) => false,
    };
    let thinnest = thinnest.filter(|_| !knows_contact).and_then(thin_film);
    let peak = peak.and_then(high_pressure);
    thinnest.into_iter().chain(peak).collect()
}

/// What a minimum film thickness (m) of smooth surfaces is worth, if it is too thin for them.
#[must_use]
pub fn thin_film(film: f64) -> Option<String> {
    (film < SMOOTH_SURFACES).then(|| {
        format!(
            "the minimum film thickness, {} um, is below {} um: real surfaces touch there, and this \
             film of smooth surfaces does not know contact; read it as overload",
            short(1e6 * film),
            short(1e6 * SMOOTH_SURFACES)
        )
    })
}

/// What a peak film pressure (Pa) in a rigid shell is worth, if it is too high for one.
#[must_use]
pub fn high_pressure(pressure: f64) -> Option<String> {
    (pressure > RIGID_SHELL).then(|| {
        format!(
            "the peak film pressure, {} GPa, is above {} GPa: a rigid shell and a viscosity without \
             pressure mean nothing there; read it as overload",
            short(1e-9 * pressure),
            short(1e-9 * RIGID_SHELL)
        )
    })
}

/// Three digits, as many as such a number is worth.
fn short(value: f64) -> String {
    let rounded = format!("{value:.2e}");
    match rounded.parse::<f64>() {
        Ok(plain) if (1e-4..1e6).contains(&plain.abs()) => plain.to_string(),
        _ => rounded,
    }
}
