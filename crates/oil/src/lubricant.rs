//! One oil: a viscosity law and a density law.

use crate::{DensityLaw, Derived, OilError, ViscosityLaw};
use serde::{Deserialize, Serialize};

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
