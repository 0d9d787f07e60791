//! How much heat does the oil hold and conduct? Heat capacity c(T) in J/(kg K) and conductivity k(T)
//! in W/(m K).
//!
//! Mineral oil of relative density d (15.6 degC against water of 15.6 degC), t in degC:
//! `c = (1684.8 + 3.391 t) / sqrt(d)`, `k = 0.11726 (1 - 5.4e-4 t) / d`.
//! C. S. Cragoe, Thermal Properties of Petroleum Products, Miscellaneous Publication 97, Bureau of
//! Standards, Washington 1929: `c = (0.388 + 0.00045 t_F) / sqrt(d)` Btu/(lb degF),
//! `k = 0.813 (1 - 0.0003 (t_F - 32)) / d` Btu in/(h ft2 degF), here in SI. For 0 to 400 degF and d
//! of 0.75 to 0.96; stated to 4 % for c and 10 % for k.
//!
//! Or constant, or a straight line over temperature. Pressure changes c by a few per cent and k by
//! about 10 % at 100 MPa; both are left out.

use crate::{
    Derived, OilError, TemperatureRange,
    law::{positive, within},
};
use serde::{Deserialize, Serialize};

/// 0 degC, K.
const ICE: f64 = 273.15;
/// Cragoe's heat capacity at 0 degC for d = 1, J/(kg K), and its slope, J/(kg K2).
const CAPACITY: [f64; 2] = [1684.8, 3.391];
/// Cragoe's conductivity at 0 degC for d = 1, W/(m K), and its slope, W/(m K2).
const CONDUCTIVITY: [f64; 2] = [0.117_26, -0.117_26 * 5.4e-4];
/// Cragoe's temperatures, K: 0 to 400 degF.
const CRAGOE: TemperatureRange = TemperatureRange {
    low: 255.37,
    high: 477.59,
};
/// Cragoe's relative densities.
const RELATIVE_DENSITIES: [f64; 2] = [0.75, 0.96];
/// Relative density of the default, an engine oil: c = 2170 J/(kg K), k = 0.128 W/(m K) at 100 degC.
const ENGINE_OIL: f64 = 0.87;

/// Law of the heat capacity over temperature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum HeatCapacityLaw {
    /// Mineral oil by its density (Cragoe 1929).
    MineralOil {
        /// Density at 15.6 degC over that of water, 0.75 to 0.96.
        relative_density: f64,
    },
    /// The same at every temperature.
    Constant {
        /// Heat capacity, J/(kg K); 1700 to 2600 for oils.
        heat_capacity: f64,
    },
    /// `heat_capacity + slope (T - temperature)`.
    Linear {
        /// Heat capacity at the reference temperature, J/(kg K).
        heat_capacity: f64,
        /// Reference temperature, K.
        temperature: f64,
        /// Change over temperature, J/(kg K2); about 3.6 for mineral oil.
        slope: f64,
    },
}

/// Law of the heat conductivity over temperature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum ConductivityLaw {
    /// Mineral oil by its density (Cragoe 1929).
    MineralOil {
        /// Density at 15.6 degC over that of water, 0.75 to 0.96.
        relative_density: f64,
    },
    /// The same at every temperature.
    Constant {
        /// Conductivity, W/(m K); 0.11 to 0.15 for oils.
        conductivity: f64,
    },
    /// `conductivity + slope (T - temperature)`.
    Linear {
        /// Conductivity at the reference temperature, W/(m K).
        conductivity: f64,
        /// Reference temperature, K.
        temperature: f64,
        /// Change over temperature, W/(m K2); about -7e-5 for mineral oil.
        slope: f64,
    },
}

/// `value` at a reference temperature, K, and its change over temperature.
struct Line {
    value: f64,
    temperature: f64,
    slope: f64,
}

impl Line {
    fn at(&self, temperature_k: f64) -> Derived {
        Derived {
            value: self.value + self.slope * (temperature_k - self.temperature),
            by_temperature: self.slope,
            by_pressure: 0.0,
        }
    }

    /// Where the line has at least a quarter of its reference value.
    fn range(&self) -> TemperatureRange {
        let reach = 0.75 * self.value / self.slope.abs();
        if self.slope > 0.0 {
            TemperatureRange {
                low: (self.temperature - reach).max(0.0),
                high: f64::INFINITY,
            }
        } else if self.slope < 0.0 {
            TemperatureRange {
                low: 0.0,
                high: self.temperature + reach,
            }
        } else {
            TemperatureRange::ALL
        }
    }

    fn check(&self, name: &'static str) -> Result<(), OilError> {
        positive(name, self.value)?;
        positive("temperature", self.temperature)?;
        if self.slope.is_finite() {
            Ok(())
        } else {
            Err(OilError::NotFinite { name: "slope" })
        }
    }
}

/// Refuses a relative density Cragoe did not have.
fn check_relative_density(relative_density: f64) -> Result<(), OilError> {
    let [low, high] = RELATIVE_DENSITIES;
    within("relative_density", relative_density, low, high)
}

impl HeatCapacityLaw {
    /// Engine oil of relative density 0.87.
    pub const DEFAULT: Self = Self::MineralOil {
        relative_density: ENGINE_OIL,
    };

    /// Heat capacity, J/(kg K), at a temperature (K).
    #[must_use]
    pub fn at(&self, temperature_k: f64) -> Derived {
        self.line().at(temperature_k)
    }

    fn line(&self) -> Line {
        match *self {
            Self::MineralOil { relative_density } => Line {
                value: CAPACITY[0] / relative_density.sqrt(),
                temperature: ICE,
                slope: CAPACITY[1] / relative_density.sqrt(),
            },
            Self::Constant { heat_capacity } => Line {
                value: heat_capacity,
                temperature: ICE,
                slope: 0.0,
            },
            Self::Linear {
                heat_capacity,
                temperature,
                slope,
            } => Line {
                value: heat_capacity,
                temperature,
                slope,
            },
        }
    }

    /// Temperatures at which the law holds.
    #[must_use]
    pub fn temperature_range(&self) -> TemperatureRange {
        match self {
            Self::MineralOil { .. } => CRAGOE,
            _ => self.line().range(),
        }
    }

    /// Whether the parameters describe an oil.
    ///
    /// # Errors
    /// [`OilError`] names the parameter that does not.
    pub fn check(&self) -> Result<(), OilError> {
        match *self {
            Self::MineralOil { relative_density } => check_relative_density(relative_density),
            _ => self.line().check("heat_capacity"),
        }
    }
}

impl ConductivityLaw {
    /// Engine oil of relative density 0.87.
    pub const DEFAULT: Self = Self::MineralOil {
        relative_density: ENGINE_OIL,
    };

    /// Conductivity, W/(m K), at a temperature (K).
    #[must_use]
    pub fn at(&self, temperature_k: f64) -> Derived {
        self.line().at(temperature_k)
    }

    fn line(&self) -> Line {
        match *self {
            Self::MineralOil { relative_density } => Line {
                value: CONDUCTIVITY[0] / relative_density,
                temperature: ICE,
                slope: CONDUCTIVITY[1] / relative_density,
            },
            Self::Constant { conductivity } => Line {
                value: conductivity,
                temperature: ICE,
                slope: 0.0,
            },
            Self::Linear {
                conductivity,
                temperature,
                slope,
            } => Line {
                value: conductivity,
                temperature,
                slope,
            },
        }
    }

    /// Temperatures at which the law holds.
    #[must_use]
    pub fn temperature_range(&self) -> TemperatureRange {
        match self {
            Self::MineralOil { .. } => CRAGOE,
            _ => self.line().range(),
        }
    }

    /// Whether the parameters describe an oil.
    ///
    /// # Errors
    /// [`OilError`] names the parameter that does not.
    pub fn check(&self) -> Result<(), OilError> {
        match *self {
            Self::MineralOil { relative_density } => check_relative_density(relative_density),
            _ => self.line().check("conductivity"),
        }
    }
}

impl Default for HeatCapacityLaw {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Default for ConductivityLaw {
    fn default() -> Self {
        Self::DEFAULT
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cragoe's own formula in his units, converted with 4186.8 J/(kg K) per Btu/(lb degF) and
    /// 0.1442279 W/(m K) per Btu in/(h ft2 degF).
    #[test]
    fn mineral_oil_follows_the_bureau_of_standards() {
        for (d, celsius) in [(0.75_f64, 0.0), (0.87, 100.0), (0.96, 150.0)] {
            let fahrenheit = 32.0 + 1.8 * celsius;
            let c = 4186.8 * (0.388 + 0.00045 * fahrenheit) / d.sqrt();
            let k = 0.144_227_9 * 0.813 * (1.0 - 0.0003 * (fahrenheit - 32.0)) / d;
            let capacity = HeatCapacityLaw::MineralOil {
                relative_density: d,
            };
            let conductivity = ConductivityLaw::MineralOil {
                relative_density: d,
            };
            assert!((capacity.at(ICE + celsius).value / c - 1.0).abs() < 1e-4);
            assert!((conductivity.at(ICE + celsius).value / k - 1.0).abs() < 1e-4);
        }
    }

    #[test]
    fn lines_know_their_slope_and_their_range() {
        let law = ConductivityLaw::Linear {
            conductivity: 0.13,
            temperature: 373.15,
            slope: -7e-5,
        };
        let slope = (law.at(400.0).value - law.at(300.0).value) / 100.0;
        assert!((slope - law.at(350.0).by_temperature).abs() < 1e-15);
        let end = law.temperature_range().high;
        assert!((law.at(end).value / 0.13 - 0.25).abs() < 1e-12);
        assert_eq!(
            HeatCapacityLaw::Constant {
                heat_capacity: 2000.0
            }
            .temperature_range(),
            TemperatureRange::ALL
        );
    }

    #[test]
    fn parameters_that_describe_no_oil_are_refused() {
        assert!(HeatCapacityLaw::DEFAULT.check().is_ok());
        assert!(
            HeatCapacityLaw::MineralOil {
                relative_density: 870.0
            }
            .check()
            .is_err()
        );
        assert!(
            ConductivityLaw::Constant { conductivity: 0.0 }
                .check()
                .is_err()
        );
        assert!(
            HeatCapacityLaw::Linear {
                heat_capacity: 2000.0,
                temperature: 300.0,
                slope: f64::NAN
            }
            .check()
            .is_err()
        );
    }
}
