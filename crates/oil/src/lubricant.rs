//! One oil: a law of each kind, joined.
//!
//! `eta(T, p, rate)`: the viscosity law gives eta0(T) at ambient pressure (ASTM D341 with the density
//! there), the pressure law thickens it, the shear law thins that. `rho(T, p)`: the density law times
//! the compression law. Pressures are above ambient.

use crate::{
    CompressionLaw, ConductivityLaw, DensityLaw, Derived, HTHS_TEMPERATURE, HeatCapacityLaw,
    OilError, PressureLaw, ReferenceState, ShearThinning, Sheared, TemperatureRange, ThinningForm,
    ViscosityLaw, pressure,
};
use serde::{Deserialize, Serialize};

/// One oil: how viscous and dense it is at a temperature, pressure and shear rate, and what heat it
/// holds and conducts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Lubricant {
    /// Law of the viscosity over temperature, at ambient pressure and low shear.
    pub viscosity: ViscosityLaw,
    /// Law of the viscosity over pressure.
    #[serde(default)]
    pub viscosity_pressure: PressureLaw,
    /// Law of the viscosity over the shear rate.
    #[serde(default)]
    pub shear_thinning: ShearThinning,
    /// Law of the density over temperature, at ambient pressure.
    pub density: DensityLaw,
    /// Law of the density over pressure.
    #[serde(default)]
    pub density_pressure: CompressionLaw,
    /// Law of the heat capacity.
    #[serde(default)]
    pub heat_capacity: HeatCapacityLaw,
    /// Law of the heat conductivity.
    #[serde(default)]
    pub conductivity: ConductivityLaw,
}

impl Lubricant {
    /// An oil of constant viscosity (Pa s) and density (kg/m3).
    #[must_use]
    pub const fn constant(viscosity: f64, density: f64) -> Self {
        Self::newtonian(
            ViscosityLaw::Constant { viscosity },
            DensityLaw::Constant { density },
        )
    }

    /// An oil whose viscosity and density depend on nothing but temperature.
    #[must_use]
    pub const fn newtonian(viscosity: ViscosityLaw, density: DensityLaw) -> Self {
        Self {
            viscosity,
            viscosity_pressure: PressureLaw::None,
            shear_thinning: ShearThinning::None,
            density,
            density_pressure: CompressionLaw::None,
            heat_capacity: HeatCapacityLaw::DEFAULT,
            conductivity: ConductivityLaw::DEFAULT,
        }
    }

    /// This oil thinning with shear so that it has the viscosity `hths` (Pa s) at 150 degC and
    /// 1e6 1/s. Viscosity and density laws have to hold at 150 degC.
    ///
    /// # Errors
    /// As [`ShearThinning::identify`].
    pub fn with_hths(
        mut self,
        hths: f64,
        form: ThinningForm,
        second_newtonian_ratio: f64,
    ) -> Result<Self, OilError> {
        let low_shear = self.reference_state(HTHS_TEMPERATURE);
        self.shear_thinning =
            ShearThinning::identify(form, second_newtonian_ratio, low_shear, hths)?;
        Ok(self)
    }

    /// The oil at a temperature (K), ambient pressure and low shear.
    #[must_use]
    pub fn reference_state(&self, temperature_k: f64) -> ReferenceState {
        ReferenceState {
            temperature: temperature_k,
            viscosity: self.viscosity(temperature_k, 0.0).value,
            density: self.density(temperature_k, 0.0).value,
        }
    }

    /// Viscosity law alone, Pa s, at a temperature (K) and ambient pressure.
    fn ambient_viscosity(&self, temperature_k: f64) -> Derived {
        self.viscosity
            .dynamic(temperature_k, self.density.at(temperature_k))
    }

    /// Dynamic viscosity at low shear, Pa s, at a temperature (K) and gauge pressure (Pa), with its
    /// derivatives.
    #[must_use]
    pub fn viscosity(&self, temperature_k: f64, pressure_pa: f64) -> Derived {
        let ambient = |t| self.ambient_viscosity(t);
        self.viscosity_pressure
            .at(ambient, temperature_k, pressure_pa)
    }

    /// Dynamic viscosity, Pa s, at a temperature (K), gauge pressure (Pa) and shear rate (1/s, of
    /// either sign), with its derivatives.
    #[must_use]
    pub fn viscosity_at_shear(
        &self,
        temperature_k: f64,
        pressure_pa: f64,
        shear_rate: f64,
    ) -> Sheared {
        let low_shear = self.viscosity(temperature_k, pressure_pa);
        let density = self.density(temperature_k, pressure_pa);
        self.shear_thinning
            .at(low_shear, density, temperature_k, shear_rate)
    }

    /// Reduced pressure, Pa: the integral of eta0 / eta from ambient to a gauge pressure (Pa) at a
    /// temperature (K). Its derivative by pressure is eta0 / eta.
    #[must_use]
    pub fn reduced_pressure(&self, temperature_k: f64, pressure_pa: f64) -> Derived {
        let ambient = |t| self.ambient_viscosity(t);
        self.viscosity_pressure
            .reduced_pressure(ambient, temperature_k, pressure_pa)
    }

    /// Bound of the reduced pressure, Pa, at a temperature (K): a rigid film whose isoviscous pressure
    /// exceeds it has no solution. Infinite for an oil that does not thicken under pressure.
    #[must_use]
    pub fn limiting_reduced_pressure(&self, temperature_k: f64) -> f64 {
        let ambient = |t| self.ambient_viscosity(t);
        self.viscosity_pressure
            .limiting_reduced_pressure(ambient, temperature_k)
    }

    /// Density, kg/m3, at a temperature (K) and gauge pressure (Pa), with its derivatives.
    #[must_use]
    pub fn density(&self, temperature_k: f64, pressure_pa: f64) -> Derived {
        let ambient = self.density.at(temperature_k);
        let (factor, by_pressure) = self.density_pressure.factor(pressure_pa);
        Derived {
            value: ambient.value * factor,
            by_temperature: ambient.by_temperature * factor,
            by_pressure: ambient.value * by_pressure,
        }
    }

    /// Kinematic viscosity at low shear and ambient pressure, m2/s, at a temperature (K).
    #[must_use]
    pub fn kinematic_viscosity(&self, temperature_k: f64) -> f64 {
        self.viscosity(temperature_k, 0.0).value / self.density(temperature_k, 0.0).value
    }

    /// Heat capacity of a volume, J/(m3 K), at a temperature (K) and gauge pressure (Pa), with its
    /// derivatives.
    #[must_use]
    pub fn volumetric_heat(&self, temperature_k: f64, pressure_pa: f64) -> Derived {
        let density = self.density(temperature_k, pressure_pa);
        let capacity = self.heat_capacity.at(temperature_k);
        Derived {
            value: density.value * capacity.value,
            by_temperature: density.by_temperature * capacity.value
                + density.value * capacity.by_temperature,
            by_pressure: density.by_pressure * capacity.value,
        }
    }

    /// Temperatures at which the laws of viscosity and density hold.
    #[must_use]
    pub fn temperature_range(&self) -> TemperatureRange {
        let range = self
            .viscosity
            .temperature_range()
            .and(self.density.temperature_range());
        if self.viscosity_pressure.has_temperature_slope() {
            range.and(pressure::SLOPE_RANGE)
        } else {
            range
        }
    }

    /// Temperatures at which the laws of heat capacity and conductivity hold.
    #[must_use]
    pub fn heat_temperature_range(&self) -> TemperatureRange {
        self.heat_capacity
            .temperature_range()
            .and(self.conductivity.temperature_range())
    }

    /// Whether the laws of viscosity and density hold at a temperature, K.
    ///
    /// # Errors
    /// [`OilError::TemperatureOutside`] with the range.
    pub fn check_temperature(&self, temperature_k: f64) -> Result<(), OilError> {
        let range = self.temperature_range();
        if range.contains(temperature_k) {
            Ok(())
        } else {
            Err(OilError::TemperatureOutside {
                temperature_k,
                low: range.low,
                high: range.high,
            })
        }
    }

    /// Whether the parameters of all laws describe an oil, and the laws go together.
    ///
    /// # Errors
    /// [`OilError`] names the parameter that does not.
    pub fn check(&self) -> Result<(), OilError> {
        self.viscosity.check()?;
        self.viscosity_pressure.check()?;
        self.shear_thinning.check()?;
        self.density.check()?;
        self.density_pressure.check()?;
        self.heat_capacity.check()?;
        self.conductivity.check()?;
        let follows_temperature = !matches!(self.viscosity, ViscosityLaw::Constant { .. });
        if follows_temperature && self.viscosity_pressure.has_temperature_slope() {
            return Err(OilError::TemperatureCountsTwice);
        }
        Ok(())
    }
}
