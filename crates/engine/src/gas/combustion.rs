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

use super::closed_cycle::{ClosedCycle, ClosedGas};
use crate::{
    Chamber, CombustionError, GasExchange, HeatRatio, HeatRelease, IndicatorDiagram, Strokes,
    WallHeat,
};
use serde::{Deserialize, Serialize};
use sommerfeld_film::Outcome;

/// Fewest and most points of a generated diagram.
const POINTS: std::ops::RangeInclusive<usize> = 72..=36_000;

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
    /// Estimated relative error of the pressures while the valves are closed.
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
        let closed = self.closed(speed).solve(&inside)?;
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

    fn closed(&self, speed: f64) -> ClosedCycle<'_> {
        ClosedCycle::new(ClosedGas {
            chamber: &self.chamber,
            exchange: &self.gas_exchange,
            release: &self.heat_release,
            ratio: self.heat_ratio,
            walls: self.wall_heat,
            speed,
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
