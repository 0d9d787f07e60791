//! The ratio of the specific heats of the gas.
//!
//! Question: how much does heat raise the pressure, and which internal energy does the gas hold?
//!
//! `c_v = R/(kappa - 1)`, so that the internal energy over `m R` is the integral of `dT/(kappa - 1)`. The
//! ratio is constant, or falls linearly with the temperature as hot gas takes up more heat.
//!
//! Reference: J. A. Gatowski et al., SAE 841359, 1984.

use crate::CombustionError;
use serde::{Deserialize, Serialize};

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

    pub(crate) fn check(&self) -> Result<(), CombustionError> {
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
