//! Density of the oil: rho(T, p) in kg/m3.
//!
//! Range: mineral and synthetic lubricants lie at 750 to 1000 kg/m3. The hydrodynamic laminar film
//! feels the density only through its ratio to the feed density (compressibility), through ASTM
//! D341's kinematic viscosity, and through the Reynolds number that is reported.

use crate::{Derived, OilError, law::positive};
use serde::{Deserialize, Serialize};

/// Law of the density.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum DensityLaw {
    /// The same at every temperature and pressure.
    Constant {
        /// Density, kg/m3.
        density: f64,
    },
}

impl DensityLaw {
    /// Density, kg/m3, at a temperature (K) and gauge pressure (Pa).
    #[must_use]
    pub fn at(&self, _temperature_k: f64, _pressure_pa: f64) -> Derived {
        match *self {
            Self::Constant { density } => Derived::constant(density),
        }
    }

    /// Whether the parameters describe an oil.
    ///
    /// # Errors
    /// [`OilError::NotPositive`] for a density that is not positive.
    pub fn check(&self) -> Result<(), OilError> {
        match *self {
            Self::Constant { density } => positive("density", density),
        }
    }
}
