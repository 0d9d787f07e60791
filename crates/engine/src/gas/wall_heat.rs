//! Heat from the gas to the walls of the chamber.
//!
//! Question: how much heat leaves the gas through head, piston and liner at a crank angle?
//!
//! Woschni: `alpha = 130 B^-0.2 p^0.8 T^-0.53 w^0.8` W/(m2 K) with the bore in m, the pressure in bar, the
//! mean gas temperature in K and the velocity in m/s
//! `w = (2.28 + 0.308 c_u/c_m) c_m + C2 V_h T1/(p1 V1) (p - p0)` while the valves are closed, its second
//! term from the start of burning on, with `p0` the pressure of the motored cycle and state 1 the closing of
//! the intake; `w = (6.18 + 0.417 c_u/c_m) c_m` during the gas exchange. The 130 is the 110 kcal/(m2 h K)
//! at pressures in kp/cm2 of the paper in SI: 110 * 1.163 * 1.0197^0.8 = 129.9.
//!
//! Limits: one temperature for all gas, one coefficient for all surfaces; +-20 % is what such formulas give.
//!
//! References: G. Woschni, SAE 670931, 1967; the terms of swirl came later, see J. B. Heywood, Internal
//! Combustion Engine Fundamentals, McGraw-Hill 1988, 12.4.3.

use crate::{Chamber, CombustionError};
use serde::{Deserialize, Serialize};

/// Factor of Woschni's formula with m, bar, K, m/s, W/(m2 K).
const WOSCHNI: f64 = 130.0;
const PASCAL_PER_BAR: f64 = 1e5;

/// How the gas loses heat.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WallHeat {
    /// It does not.
    Adiabatic,
    /// By Woschni's formula.
    Woschni(Woschni),
}

/// Woschni's formula and the walls.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Woschni {
    /// Circumferential speed of the charge over the mean piston speed, `c_u/c_m`; 0 without swirl.
    pub swirl: f64,
    /// The constant `C2`, m/(s K): 3.24e-3 for direct injection and spark ignition, 6.22e-3 with
    /// prechamber.
    pub combustion: f64,
    /// Temperatures of the surfaces of head, piston and liner, K.
    pub head_temperature: f64,
    /// See `head_temperature`.
    pub piston_temperature: f64,
    /// See `head_temperature`.
    pub liner_temperature: f64,
    /// Surface of the head in the chamber over the area of the bore.
    pub head_area_ratio: f64,
    /// Surface of the piston crown over the area of the bore.
    pub piston_area_ratio: f64,
}

/// The gas as Woschni's formula sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GasInstant {
    /// Absolute pressure, Pa.
    pub pressure: f64,
    /// Mean temperature, K.
    pub temperature: f64,
    /// Pressure above that of the motored cycle, Pa; 0 before burning.
    pub excess_pressure: f64,
}

/// What stays the same over a cycle in Woschni's formula.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleScales {
    /// Cylinder bore, m.
    pub bore: f64,
    /// Mean piston speed, m/s.
    pub piston_speed: f64,
    /// `V_h T1/(p1 V1)` at the closing of the intake, K/Pa.
    pub reference: f64,
}

impl Woschni {
    /// Heat transfer coefficient with the valves closed, W/(m2 K).
    #[must_use]
    pub fn coefficient(&self, gas: &GasInstant, scales: &CycleScales) -> f64 {
        let swept = (2.28 + 0.308 * self.swirl) * scales.piston_speed;
        let burning = self.combustion * scales.reference * gas.excess_pressure.max(0.0);
        transfer(gas, scales, swept + burning)
    }

    /// Heat transfer coefficient during the gas exchange, W/(m2 K).
    #[must_use]
    pub fn gas_exchange_coefficient(&self, gas: &GasInstant, scales: &CycleScales) -> f64 {
        transfer(
            gas,
            scales,
            (6.18 + 0.417 * self.swirl) * scales.piston_speed,
        )
    }

    /// Heat flow per coefficient at a crank angle (rad): sum of surfaces times temperature differences,
    /// m2 K, from gas to walls.
    #[must_use]
    pub fn driving(&self, chamber: &Chamber, angle: f64, temperature: f64) -> f64 {
        let area = chamber.area();
        self.head_area_ratio * area * (temperature - self.head_temperature)
            + self.piston_area_ratio * area * (temperature - self.piston_temperature)
            + chamber.liner_area(angle) * (temperature - self.liner_temperature)
    }

    /// Refuses walls and constants that are none.
    ///
    /// # Errors
    /// [`CombustionError::OutOfRange`] with the number.
    pub fn check(&self) -> Result<(), CombustionError> {
        let refuse = CombustionError::unless;
        refuse(
            (0.0..=10.0).contains(&self.swirl),
            "swirl",
            self.swirl,
            "0 to 10",
        )?;
        let constant = self.combustion;
        let allowed = "0 to 0.1 m/(s K)";
        refuse(
            (0.0..=0.1).contains(&constant),
            "combustion constant",
            constant,
            allowed,
        )?;
        for temperature in [
            self.head_temperature,
            self.piston_temperature,
            self.liner_temperature,
        ] {
            let is_wall = (200.0..=1500.0).contains(&temperature);
            refuse(is_wall, "wall temperature", temperature, "200 to 1500 K")?;
        }
        for ratio in [self.head_area_ratio, self.piston_area_ratio] {
            refuse(
                (0.5..=5.0).contains(&ratio),
                "surface over bore area",
                ratio,
                "0.5 to 5",
            )?;
        }
        Ok(())
    }
}

fn transfer(gas: &GasInstant, scales: &CycleScales, velocity: f64) -> f64 {
    WOSCHNI
        * scales.bore.powf(-0.2)
        * (gas.pressure / PASCAL_PER_BAR).powf(0.8)
        * gas.temperature.powf(-0.53)
        * velocity.powf(0.8)
}
