//! Pressures while valves or ports are open: given, with smooth ways between them.
//!
//! Question: what does the cylinder hold when the intake closes, and which pressure follows the opening of
//! the exhaust?

use crate::{CombustionError, Strokes};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// The gas while valves or ports are open. Angles are crank angles from the firing top dead centre, rad,
/// pressures absolute, Pa.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GasExchange {
    /// Where the intake closes, below 0.
    pub intake_closes: f64,
    /// Where the exhaust opens, above 0.
    pub exhaust_opens: f64,
    /// Pressure in the cylinder while it draws and when the intake closes.
    pub intake_pressure: f64,
    /// Temperature of the charge when the intake closes, with what was left of the last one, K.
    pub intake_temperature: f64,
    /// Pressure in the cylinder while it exhausts.
    pub exhaust_pressure: f64,
    /// Over which angle the pressure falls after the exhaust has opened.
    pub blow_down: f64,
    /// Over which angle about the gas-exchange dead centre the pressure goes from exhaust to intake.
    pub overlap: f64,
}

impl GasExchange {
    pub(crate) fn check(&self, strokes: Strokes) -> Result<(), CombustionError> {
        let refuse = CombustionError::unless;
        let (closes, opens) = (self.intake_closes, self.exhaust_opens);
        let half = 0.5 * strokes.period();
        let allowed = "between a turn before firing and firing";
        refuse(
            closes < 0.0 && closes >= -half.min(PI + 1.0),
            "closing of the intake",
            closes,
            allowed,
        )?;
        let allowed = "between firing and a turn after it";
        refuse(
            opens > 0.0 && opens <= half.min(PI + 1.0),
            "opening of the exhaust",
            opens,
            allowed,
        )?;
        for pressure in [self.intake_pressure, self.exhaust_pressure] {
            let is_pressure = pressure > 0.0 && pressure < 1e8;
            refuse(
                is_pressure,
                "pressure of the gas exchange",
                pressure,
                "above 0 Pa absolute",
            )?;
        }
        let temperature = self.intake_temperature;
        let is_charge = (200.0..=1500.0).contains(&temperature);
        refuse(
            is_charge,
            "temperature of the charge",
            temperature,
            "200 to 1500 K",
        )?;
        let overlap = self.overlap;
        refuse(
            (0.0..=PI).contains(&overlap),
            "overlap",
            overlap,
            "0 to 180 deg",
        )?;
        let room = match strokes {
            Strokes::Four => TAU - 0.5 * overlap - opens,
            Strokes::Two => closes + TAU - opens,
        };
        let falls = self.blow_down > 0.0 && self.blow_down <= room;
        let allowed = "above 0, to its end before the intake";
        refuse(
            falls,
            "crank angle of the blow-down",
            self.blow_down,
            allowed,
        )
    }

    /// Pressure at a crank angle between opening of the exhaust, where it was `opened`, and the closing of
    /// the intake a period after firing.
    pub(crate) fn pressure(&self, strokes: Strokes, angle: f64, opened: f64) -> f64 {
        let after = match strokes {
            Strokes::Four => self.exhaust_pressure,
            Strokes::Two => self.intake_pressure,
        };
        let fallen = smooth_step((angle - self.exhaust_opens) / self.blow_down);
        let exhausting = opened + (after - opened) * fallen;
        let change = match strokes {
            Strokes::Four if self.overlap > 0.0 => smooth_step((angle - TAU) / self.overlap + 0.5),
            Strokes::Four => f64::from(angle >= TAU),
            Strokes::Two => 0.0,
        };
        exhausting + (self.intake_pressure - after) * change
    }
}

/// From 0 at 0 to 1 at 1, without slope at both.
fn smooth_step(way: f64) -> f64 {
    let way = way.clamp(0.0, 1.0);
    way * way * (3.0 - 2.0 * way)
}
