//! What every law returns and refuses.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A value of a law with its exact derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Derived {
    /// The value, in the unit of its law.
    pub value: f64,
    /// Derivative with respect to temperature, unit of the value per K.
    pub by_temperature: f64,
    /// Derivative with respect to pressure, unit of the value per Pa.
    pub by_pressure: f64,
}

impl Derived {
    /// A value that depends on nothing.
    #[must_use]
    pub const fn constant(value: f64) -> Self {
        Self {
            value,
            by_temperature: 0.0,
            by_pressure: 0.0,
        }
    }
}

/// Parameters that describe no oil, or a temperature outside a law's range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum OilError {
    /// A parameter that must be positive and finite is not.
    #[error("{name} must be positive, not {value}")]
    NotPositive {
        /// The parameter, as the study file calls it.
        name: &'static str,
        /// What was given, SI.
        value: f64,
    },
    /// A parameter is not a number or infinite.
    #[error("{name} is not a finite number")]
    NotFinite {
        /// The parameter, as the study file calls it.
        name: &'static str,
    },
    /// An oil that does not thin as it warms.
    #[error("kv100 must be below kv40: oil thins as it warms")]
    DoesNotThin,
    /// Too thin for the double logarithm of ASTM D341.
    #[error(
        "kv100 is {value_mm2_s} mm2/s: the formula lg lg(nu + 0.7) needs more than 0.3 mm2/s, \
         the standard 2 mm2/s"
    )]
    TooThin {
        /// What was given, mm2/s.
        value_mm2_s: f64,
    },
}

/// Refuses a parameter that is not positive and finite.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), OilError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(OilError::NotPositive { name, value })
    }
}
