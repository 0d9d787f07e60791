//! A working cycle without a measurement: compression, burning, expansion and gas exchange.
//!
//! Question: which pressure would an indicator show in an engine of these dimensions?
//!
//! While the valves are closed the gas is one ideal gas of uniform state, `p V = m R T`,
//! `V dp = (kappa - 1)(dQ_burn - dQ_wall) - kappa p dV`, from the state at the closing of the intake to the
//! opening of the exhaust, by the classical Runge-Kutta method of order 4 on a mesh that has the beginnings
//! of burning among its points. Every interval is halved until two solutions agree; a fifteenth of their
//! difference is the stated error. Then the pressure falls smoothly to that of the exhaust, and about the
//! gas-exchange dead centre smoothly to that of the intake; a two-stroke engine falls to that of the intake.
//!
//! Limits: constant mass and gas constant, no dissociation, no crevices, no waves in the manifolds. The
//! gas exchange is given, not computed; it loads bearings by inertia, hardly by its pressures.
//!
//! References: J. B. Heywood, Internal Combustion Engine Fundamentals, McGraw-Hill 1988, 9.2 and 14.4;
//! J. A. Gatowski et al., SAE 841359, 1984 (`kappa` falling linearly with temperature).

use crate::closed_cycle::ClosedCycle;
use crate::{Chamber, HeatRelease, IndicatorDiagram, Strokes, WallHeat};
use serde::{Deserialize, Serialize};
use sommerfeld_film::Outcome;
use std::f64::consts::{PI, TAU};

/// Fewest and most points of a generated diagram.
const POINTS: std::ops::RangeInclusive<usize> = 72..=36_000;

/// Why a cycle cannot be generated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CombustionError {
    /// A number is out of range.
    #[error("{what} is {value}, allowed: {allowed}")]
    OutOfRange {
        /// What it is.
        what: &'static str,
        /// As given, SI.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The pressure left the range of numbers: heat or losses fit no gas in this chamber.
    #[error("the gas has no state any more at {:.1} deg", angle.to_degrees())]
    NoState {
        /// Crank angle from firing, rad.
        angle: f64,
    },
}

impl CombustionError {
    /// An error unless the claim holds.
    pub(crate) const fn unless(
        claim: bool,
        what: &'static str,
        value: f64,
        allowed: &'static str,
    ) -> Result<(), Self> {
        if claim {
            return Ok(());
        }
        Err(Self::OutOfRange {
            what,
            value,
            allowed,
        })
    }
}

/// Ratio of the specific heats of the gas over its temperature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HeatRatio {
    /// The same at every temperature.
    Constant(f64),
    /// Falling in a straight line from its value at 300 K, down to a lowest value.
    Falling {
        /// Ratio at 300 K: 1.38 (Gatowski).
        at_300_kelvin: f64,
        /// Fall per kelvin, above 0: 8e-5 (Gatowski).
        per_kelvin: f64,
        /// Lowest ratio, above 1.
        lowest: f64,
    },
}

/// Temperature where [`HeatRatio::Falling`] begins to count, K.
const REFERENCE_TEMPERATURE: f64 = 300.0;

impl HeatRatio {
    /// The ratio at a temperature, K.
    #[must_use]
    pub fn at(&self, temperature: f64) -> f64 {
        match *self {
            Self::Constant(ratio) => ratio,
            Self::Falling {
                at_300_kelvin,
                per_kelvin,
                lowest,
            } => {
                let fallen = at_300_kelvin - per_kelvin * (temperature - REFERENCE_TEMPERATURE);
                fallen.max(lowest)
            }
        }
    }

    /// Internal energy over `m R` (K) above that at 300 K, the integral of `dT/(kappa - 1)`.
    #[must_use]
    pub fn internal_energy(&self, temperature: f64) -> f64 {
        let above = temperature - REFERENCE_TEMPERATURE;
        match *self {
            Self::Constant(ratio) => above / (ratio - 1.0),
            Self::Falling {
                at_300_kelvin,
                per_kelvin,
                lowest,
            } => {
                let start = at_300_kelvin - 1.0;
                let floor = (at_300_kelvin - lowest) / per_kelvin;
                let falling = -(-per_kelvin * above.min(floor) / start).ln_1p() / per_kelvin;
                falling + (above - floor).max(0.0) / (lowest - 1.0)
            }
        }
    }

    fn check(&self) -> Result<(), CombustionError> {
        let refuse = CombustionError::unless;
        let allowed = "1.05 to 2";
        let is_ratio = |ratio: f64| (1.05..=2.0).contains(&ratio);
        match *self {
            Self::Constant(ratio) => {
                refuse(is_ratio(ratio), "ratio of specific heats", ratio, allowed)
            }
            Self::Falling {
                at_300_kelvin,
                per_kelvin,
                lowest,
            } => {
                let first = at_300_kelvin;
                refuse(
                    is_ratio(first),
                    "ratio of specific heats at 300 K",
                    first,
                    allowed,
                )?;
                let falls = per_kelvin > 0.0 && per_kelvin <= 1e-3;
                let what = "fall of the ratio of specific heats";
                refuse(falls, what, per_kelvin, "above 0, up to 1e-3 1/K")?;
                let is_lowest = is_ratio(lowest) && lowest < first;
                let allowed = "1.05 to the ratio at 300 K";
                refuse(is_lowest, "lowest ratio of specific heats", lowest, allowed)
            }
        }
    }
}

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
    fn check(&self, strokes: Strokes) -> Result<(), CombustionError> {
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
    fn pressure(&self, strokes: Strokes, angle: f64, opened: f64) -> f64 {
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

/// An engine cylinder whose cycle is generated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Combustion {
    /// Volume over the crank angle.
    pub chamber: Chamber,
    /// Strokes of a cycle.
    pub strokes: Strokes,
    /// Valves, and the states they leave.
    pub gas_exchange: GasExchange,
    /// How the fuel burns.
    pub heat_release: HeatRelease,
    /// Ratio of specific heats.
    pub heat_ratio: HeatRatio,
    /// Heat to the walls.
    pub wall_heat: WallHeat,
}

/// A generated cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct GeneratedCycle {
    /// Its diagram; the highest pressure is one of its points.
    pub diagram: IndicatorDiagram,
    /// Highest pressure: crank angle from firing, rad, and Pa.
    pub peak: [f64; 2],
    /// Highest mean temperature of the gas, K.
    pub highest_temperature: f64,
    /// Heat released while the valves are closed, J.
    pub heat_released: f64,
    /// Heat to the walls meanwhile, J.
    pub wall_heat: f64,
    /// Work of the gas meanwhile, J.
    pub closed_work: f64,
    /// Change of its internal energy meanwhile, J: equals released less walls less work.
    pub internal_energy_change: f64,
    /// Indicated mean effective pressure of the whole cycle, Pa.
    pub mean_effective_pressure: f64,
    /// Charge at the closing of the intake, as `p V/T = m R`, J/K.
    pub charge: f64,
    /// Estimated error of the pressures over the peak.
    pub error: f64,
    /// Whether that met the tolerance of 1e-9.
    pub outcome: Outcome,
}

impl Combustion {
    /// The cycle at a speed, rad/s, with `points` evenly spaced over the period, 72 to 36000, and a few
    /// more where valves move and at the peak.
    ///
    /// # Errors
    /// [`CombustionError`] where a number is out of range or the gas loses its state.
    pub fn cycle(&self, speed: f64, points: usize) -> Result<GeneratedCycle, CombustionError> {
        self.check(speed, points)?;
        let period = self.strokes.period();
        let exchange = &self.gas_exchange;
        let (closes, opens) = (exchange.intake_closes, exchange.exhaust_opens);
        let step = period / points as f64;
        let even = (0..points).map(|index| index as f64 * step - 0.5 * period);
        let (inside, outside): (Vec<f64>, Vec<f64>) =
            even.partition(|angle| *angle > closes && *angle < opens);
        let closed = ClosedCycle::new(self, speed).solve(&inside)?;
        let opened = closed.last().map_or(f64::NAN, |state| state.pressure);
        let open = outside.into_iter().map(|angle| {
            let after = if angle < opens { angle + period } else { angle };
            [angle, exchange.pressure(self.strokes, after, opened)]
        });
        let mut rows: Vec<[f64; 2]> = open
            .filter(|point| (point[0] - opens).abs() > 1e-12 && (point[0] - closes).abs() > 1e-12)
            .collect();
        rows.extend(
            closed
                .states
                .iter()
                .map(|state| [state.angle, state.pressure]),
        );
        if !rows.iter().any(|point| point[0] == closed.peak[0]) {
            rows.push(closed.peak);
        }
        let no_state = |_| CombustionError::NoState { angle: closes };
        let diagram = IndicatorDiagram::new(rows, period).map_err(no_state)?;
        Ok(GeneratedCycle {
            mean_effective_pressure: self.chamber.mean_effective_pressure(&diagram),
            diagram,
            peak: closed.peak,
            highest_temperature: closed.highest_temperature,
            heat_released: closed.heat_released,
            wall_heat: closed.wall_heat(),
            closed_work: closed.work(),
            internal_energy_change: closed.internal_energy_change,
            charge: closed.charge,
            error: closed.error,
            outcome: closed.outcome,
        })
    }

    fn check(&self, speed: f64, points: usize) -> Result<(), CombustionError> {
        let refuse = CombustionError::unless;
        refuse(
            speed > 0.0 && speed.is_finite(),
            "speed",
            speed,
            "above 0 rad/s",
        )?;
        let allowed = "72 to 36000";
        refuse(
            POINTS.contains(&points),
            "number of points",
            points as f64,
            allowed,
        )?;
        self.chamber.check()?;
        self.gas_exchange.check(self.strokes)?;
        self.heat_ratio.check()?;
        if let WallHeat::Woschni(woschni) = &self.wall_heat {
            woschni.check()?;
        }
        let exchange = &self.gas_exchange;
        self.heat_release
            .check(exchange.intake_closes, exchange.exhaust_opens)
    }
}
