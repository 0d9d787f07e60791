//! Lubricant laws: numbers in, numbers and exact derivatives out. SI units throughout.
//!
//! A [`Lubricant`] joins a viscosity law and a density law. Every law returns a [`Derived`] value,
//! so that Newton iterations above never difference a law numerically.

pub mod density;
pub mod viscosity;

pub use density::DensityLaw;
pub use viscosity::ViscosityLaw;

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

/// One oil: how viscous and how dense it is at a temperature and a pressure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Lubricant {
    /// Law of the viscosity.
    pub viscosity: ViscosityLaw,
    /// Law of the density.
    pub density: DensityLaw,
}

impl Lubricant {
    /// An oil of constant viscosity (Pa s) and density (kg/m3).
    #[must_use]
    pub const fn constant(viscosity: f64, density: f64) -> Self {
        Self {
            viscosity: ViscosityLaw::Constant { viscosity },
            density: DensityLaw::Constant { density },
        }
    }

    /// Dynamic viscosity, Pa s, at a temperature (K) and gauge pressure (Pa), with its derivatives.
    #[must_use]
    pub fn viscosity(&self, temperature_k: f64, pressure_pa: f64) -> Derived {
        let density = self.density(temperature_k, pressure_pa);
        self.viscosity.dynamic(temperature_k, density)
    }

    /// Density, kg/m3, at a temperature (K) and gauge pressure (Pa), with its derivatives.
    #[must_use]
    pub fn density(&self, temperature_k: f64, pressure_pa: f64) -> Derived {
        self.density.at(temperature_k, pressure_pa)
    }

    /// Whether the parameters of both laws describe an oil.
    ///
    /// # Errors
    /// [`OilError`] names the parameter that does not.
    pub fn check(&self) -> Result<(), OilError> {
        self.viscosity.check()?;
        self.density.check()
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
fn positive(name: &'static str, value: f64) -> Result<(), OilError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(OilError::NotPositive { name, value })
    }
}
