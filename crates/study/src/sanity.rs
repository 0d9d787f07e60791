//! Is a converged result still one that the physics of the run can mean?
//!
//! The equations have solutions far outside what they describe: a film thinner than the roughness of
//! any shaft, pressures at which no shell is rigid, temperatures at which no oil is a liquid. Such a result keeps its numbers and gets a message
//! that says what they are worth. Whether the flow is laminar is asked in [`regime`](crate::regime).
//! Design limits are another thing: they are the user's, in [`limits`](crate::limits).

use crate::input::{BearingCase, HeatPlan};
use crate::limits::Quantity;
use crate::results::{Body, HeatResults, Results};
use sommerfeld_oil::{HOTTEST_OIL, Lubricant};

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
/// is not judged; of a machine the run names the bearings. `case` is the bearing of the study, where it is
/// one.
#[must_use]
pub fn warnings(results: &Results, case: Option<&BearingCase>) -> Vec<String> {
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
    let hot = case.and_then(|case| {
        let hottest = match &results.header.heat {
            Some(heat) => Hottest::of(heat),
            None => Hottest {
                what: Hottest::GIVEN,
                temperature: case.temperature,
            },
        };
        hot_film(&hottest, &case.lubricant, &case.heat)
    });
    thinnest.into_iter().chain(peak).chain(hot).collect()
}

/// The highest temperature that a calculation of heat knows of a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hottest {
    /// What it is the temperature of, in words.
    pub what: &'static str,
    /// The temperature, K.
    pub temperature: f64,
}

impl Hottest {
    /// The one temperature of a film that is given.
    pub const GIVEN: &'static str = "the temperature of the film";
    /// The one temperature of a film that a heat balance found.
    pub const EFFECTIVE: &'static str = "the effective temperature of the film";

    /// Of a film whose heat was followed.
    #[must_use]
    pub fn of(heat: &HeatResults) -> Self {
        match &heat.field {
            Some(field) => Self {
                what: "the hottest place of the film",
                temperature: field.hottest,
            },
            None => Self {
                what: Self::EFFECTIVE,
                temperature: heat.effective_temperature,
            },
        }
    }
}

/// What a temperature of a film is worth, if its oil is no longer one there or its laws have ended.
#[must_use]
pub fn hot_film(hottest: &Hottest, oil: &Lubricant, heat: &HeatPlan) -> Option<String> {
    let celsius = |kelvin: f64| short(kelvin - 273.15);
    let laws = oil.temperature_range();
    let Hottest { what, temperature } = *hottest;
    let found = format!("{what}, {} degC, is above", celsius(temperature));
    if temperature > HOTTEST_OIL {
        let way_out = match heat {
            HeatPlan::Given => "",
            HeatPlan::Balance { .. } => {
                "; give more supply or a larger conductance, or take load off"
            }
            HeatPlan::Field { wall, .. } if wall.coefficient == 0.0 => {
                "; the walls of this film take no heat (heat.wall_coefficient)"
            }
            HeatPlan::Field { .. } => {
                "; give more supply or walls that take more heat, or take load off"
            }
        };
        return Some(format!(
            "{found} {} degC: no lubricating oil lives there, it burns and cracks; read it as \
             overheating, not as a temperature{way_out}",
            celsius(HOTTEST_OIL)
        ));
    }
    (temperature > laws.high).then(|| {
        format!(
            "{found} {} degC, where the laws of this oil end: its viscosity is continued there",
            celsius(laws.high)
        )
    })
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
