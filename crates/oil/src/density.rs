//! Density of the oil: rho(T, p) = rho0(T) f(p) in kg/m3.
//!
//! rho0(T), at ambient pressure:
//! - constant;
//! - linear: `rho0 = rho_r (1 - beta (T - T_r))`. Mineral oils expand by 6e-4 to 8e-4 1/K.
//!
//! f(p), p above ambient:
//! - Dowson-Higginson: `1 + 0.6e-9 p / (1 + 1.7e-9 p)`, tends to 1.353. D. Dowson, G. R. Higginson,
//!   Elasto-hydrodynamic Lubrication, Pergamon 1966; a fit to mineral oils up to about 400 MPa.
//! - limit 1.34: `(5.9e8 + 1.34 p) / (5.9e8 + p)`, the form of numerical lubrication (C. H. Venner,
//!   A. A. Lubrecht, Multilevel Methods in Lubrication, Elsevier 2000): at 1 GPa 0.9 % denser.
//! - constant bulk modulus: `exp(p / K)`, K about 1.2 to 2 GPa; for pressures far below K.
//!
//! Below ambient pressure the laws are followed into 10 MPa of tension and fade out there.
//!
//! Range: mineral and synthetic lubricants lie at 750 to 1000 kg/m3. The hydrodynamic laminar film
//! feels the density only through its ratio to the feed density (compressibility), through ASTM
//! D341's kinematic viscosity, through the heat it carries, and through the Reynolds number.

use crate::{
    Derived, OilError, TemperatureRange,
    law::{bounded_exponent, liquid_pressure, positive, within},
};
use serde::{Deserialize, Serialize};

/// Largest thermal expansion that is an oil's, 1/K: twice that of a light hydrocarbon.
const LARGEST_EXPANSION: f64 = 2e-3;
/// Change of density up to which a straight line over temperature is followed.
const LARGEST_CHANGE: f64 = 0.2;
/// Smallest bulk modulus, Pa: below it the oil holds free gas, and its modulus is not constant.
const SMALLEST_BULK_MODULUS: f64 = 1e8;
/// Largest bulk modulus, Pa: steel.
const LARGEST_BULK_MODULUS: f64 = 2e11;

/// Law of the density over temperature, at ambient pressure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum DensityLaw {
    /// The same at every temperature.
    Constant {
        /// Density, kg/m3.
        density: f64,
    },
    /// `density (1 - expansion (T - temperature))`.
    ThermalExpansion {
        /// Density at the reference temperature, kg/m3.
        density: f64,
        /// Reference temperature, K.
        temperature: f64,
        /// Thermal expansion at the reference temperature, 1/K; 6e-4 to 8e-4 for mineral oil.
        expansion: f64,
    },
}

impl DensityLaw {
    /// Density, kg/m3, at a temperature (K) and ambient pressure.
    #[must_use]
    pub fn at(&self, temperature_k: f64) -> Derived {
        match *self {
            Self::Constant { density } => Derived::constant(density),
            Self::ThermalExpansion {
                density,
                temperature,
                expansion,
            } => Derived {
                value: density * (1.0 - expansion * (temperature_k - temperature)),
                by_temperature: -density * expansion,
                by_pressure: 0.0,
            },
        }
    }

    /// Temperatures at which the law holds: the line over temperature up to 20 % of change.
    #[must_use]
    pub fn temperature_range(&self) -> TemperatureRange {
        match *self {
            Self::ThermalExpansion {
                temperature,
                expansion,
                ..
            } if expansion > 0.0 => {
                let reach = LARGEST_CHANGE / expansion;
                TemperatureRange {
                    low: (temperature - reach).max(0.0),
                    high: temperature + reach,
                }
            }
            _ => TemperatureRange::ALL,
        }
    }

    /// Whether the parameters describe an oil.
    ///
    /// # Errors
    /// [`OilError`] names the parameter that does not.
    pub fn check(&self) -> Result<(), OilError> {
        match *self {
            Self::Constant { density } => positive("density", density),
            Self::ThermalExpansion {
                density,
                temperature,
                expansion,
            } => {
                positive("density", density)?;
                positive("temperature", temperature)?;
                within("expansion", expansion, 0.0, LARGEST_EXPANSION)
            }
        }
    }
}

/// Law of the density over pressure: a factor on the density at ambient pressure.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum CompressionLaw {
    /// Incompressible.
    #[default]
    None,
    /// `1 + 0.6e-9 p / (1 + 1.7e-9 p)`, p in Pa.
    DowsonHigginson,
    /// `(5.9e8 + 1.34 p) / (5.9e8 + p)`, p in Pa.
    #[serde(rename = "limit-1.34")]
    Limit134,
    /// `exp(p / bulk_modulus)`.
    BulkModulus {
        /// Isothermal bulk modulus, Pa; 1.2e9 to 2e9 for oil without free gas.
        bulk_modulus: f64,
    },
}

impl CompressionLaw {
    /// Density over the density at ambient pressure, and its derivative by pressure, 1/Pa.
    #[must_use]
    pub fn factor(&self, pressure_pa: f64) -> (f64, f64) {
        let (p, slope) = liquid_pressure(pressure_pa);
        let (factor, by_pressure) = match *self {
            Self::None => return (1.0, 0.0),
            Self::DowsonHigginson => {
                let below = 1.0 + 1.7e-9 * p;
                (1.0 + 0.6e-9 * p / below, 0.6e-9 / (below * below))
            }
            Self::Limit134 => {
                let below = 5.9e8 + p;
                (1.0 + 0.34 * (p / below), 0.34 * 5.9e8 / below / below)
            }
            Self::BulkModulus { bulk_modulus } => {
                let (exponent, followed) = bounded_exponent(p / bulk_modulus);
                let factor = exponent.exp();
                (factor, factor * followed / bulk_modulus)
            }
        };
        (factor, by_pressure * slope)
    }

    /// Whether the parameters describe an oil.
    ///
    /// # Errors
    /// [`OilError::OutOfRange`] for a bulk modulus that is no liquid's.
    pub fn check(&self) -> Result<(), OilError> {
        match *self {
            Self::BulkModulus { bulk_modulus } => within(
                "bulk_modulus",
                bulk_modulus,
                SMALLEST_BULK_MODULUS,
                LARGEST_BULK_MODULUS,
            ),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAWS: [CompressionLaw; 3] = [
        CompressionLaw::DowsonHigginson,
        CompressionLaw::Limit134,
        CompressionLaw::BulkModulus {
            bulk_modulus: 1.5e9,
        },
    ];

    #[test]
    fn derivatives_agree_with_differences() {
        for law in LAWS {
            for p in [-2e7, -1e5, 0.0, 5e6, 1e8, 1e9] {
                let (step, at) = (1e3, |p| law.factor(p).0);
                let slope = (at(p + step) - at(p - step)) / (2.0 * step);
                let exact = law.factor(p).1;
                // two values near 1 over 2e3 Pa: 1e-19 1/Pa of round-off, two digits below the bar
                assert!(
                    (slope / exact - 1.0).abs() <= 1e-7,
                    "{law:?} {p} {slope} {exact}"
                );
            }
        }
    }

    #[test]
    fn each_law_starts_at_one_and_tends_to_its_limit() {
        for (law, limit) in LAWS.iter().zip([1.0 + 0.6 / 1.7, 1.34]) {
            assert_eq!(law.factor(0.0).0, 1.0);
            assert!((law.factor(1e16).0 - limit).abs() < 1e-6, "{law:?}");
        }
        let stiffness = LAWS[2].factor(2e7);
        assert!(
            (stiffness.0 / stiffness.1 - 1.5e9).abs() < 1.0,
            "rho dp/d(rho) = K"
        );
    }

    #[test]
    fn every_pressure_gives_a_finite_positive_density() {
        for law in LAWS {
            for p in [-f64::MAX, -1e12, -5.9e8, 1e12, f64::MAX] {
                let (factor, slope) = law.factor(p);
                assert!(
                    factor.is_finite() && factor > 0.9 && slope.is_finite(),
                    "{law:?} {p}"
                );
            }
        }
    }

    #[test]
    fn oil_expands_as_it_warms() {
        let law = DensityLaw::ThermalExpansion {
            density: 870.0,
            temperature: 288.15,
            expansion: 7e-4,
        };
        assert_eq!(law.at(288.15).value, 870.0);
        assert!((law.at(388.15).value - 870.0 * 0.93).abs() < 1e-9);
        assert!((law.at(300.0).by_temperature + 870.0 * 7e-4).abs() < 1e-12);
        let range = law.temperature_range();
        assert!((range.high - 288.15 - 0.2 / 7e-4).abs() < 1e-9 && range.contains(400.0));
    }

    #[test]
    fn parameters_that_describe_no_oil_are_refused() {
        let expanding = |expansion| DensityLaw::ThermalExpansion {
            density: 870.0,
            temperature: 288.15,
            expansion,
        };
        assert!(expanding(0.0).check().is_ok());
        for expansion in [-1e-4, 0.7, f64::NAN] {
            assert!(matches!(
                expanding(expansion).check(),
                Err(OilError::OutOfRange {
                    name: "expansion",
                    ..
                })
            ));
        }
        for bulk_modulus in [0.0, 1.5, f64::INFINITY] {
            assert!(
                CompressionLaw::BulkModulus { bulk_modulus }
                    .check()
                    .is_err()
            );
        }
    }
}
