//! What every law returns and refuses, and how laws stay finite outside their range.

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

/// Temperatures at which a law holds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TemperatureRange {
    /// Lowest temperature, K.
    pub low: f64,
    /// Highest temperature, K; infinite where the law names none.
    pub high: f64,
}

impl TemperatureRange {
    /// Every temperature.
    pub const ALL: Self = Self {
        low: 0.0,
        high: f64::INFINITY,
    };

    /// Whether a temperature (K) lies inside.
    #[must_use]
    pub fn contains(&self, temperature_k: f64) -> bool {
        (self.low..=self.high).contains(&temperature_k)
    }

    /// Temperatures at which both laws hold; empty (`low > high`) where there are none.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self {
            low: self.low.max(other.low),
            high: self.high.min(other.high),
        }
    }
}

/// Exponent up to which an exponential law is followed, and the room above it in which its growth
/// fades out. `exp(20)` is a viscosity 5e8 times the ambient one: no film and no oil reaches it,
/// only the first guesses of a Newton iteration do, and those have to stay finite.
const FOLLOWED_EXPONENT: f64 = 20.0;
const FADING_EXPONENT: f64 = 10.0;

/// The exponent an exponential law uses, never above 30, and its slope: the identity up to 20,
/// continuous in value and slope.
pub(crate) fn bounded_exponent(exponent: f64) -> (f64, f64) {
    if exponent <= FOLLOWED_EXPONENT {
        return (exponent, 1.0);
    }
    let fade = (-(exponent - FOLLOWED_EXPONENT) / FADING_EXPONENT).exp();
    (FOLLOWED_EXPONENT + FADING_EXPONENT * (1.0 - fade), fade)
}

/// Largest tension a pressure law is followed into, Pa. Oil with dissolved gas ruptures long before;
/// guesses of an iteration lie anywhere.
pub(crate) const LARGEST_TENSION: f64 = 1e7;

/// The pressure a law uses at a gauge pressure (Pa), and its slope: the pressure itself where it is
/// not negative; below, `-P tanh(-p / P)` with `P` = 10 MPa, so that no law meets its pole. Two
/// derivatives are continuous; at -1 bar the difference is 3e-5 of the pressure.
pub(crate) fn liquid_pressure(pressure_pa: f64) -> (f64, f64) {
    if pressure_pa >= 0.0 {
        return (pressure_pa, 1.0);
    }
    let part = (pressure_pa / LARGEST_TENSION).tanh();
    (LARGEST_TENSION * part, 1.0 - part * part)
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
    /// A parameter lies outside the range of its law.
    #[error("{name} is {value}, its range is {low} to {high}")]
    OutOfRange {
        /// The parameter, as the study file calls it.
        name: &'static str,
        /// What was given, SI.
        value: f64,
        /// Smallest permissible value, SI.
        low: f64,
        /// Largest permissible value, SI.
        high: f64,
    },
    /// Roelands' temperature slope on a viscosity that follows temperature already.
    #[error(
        "temperature would count twice: viscosity follows it already, so viscosity_pressure must \
         not have a temperature slope of its own"
    )]
    TemperatureCountsTwice,
    /// A temperature at which a law of this oil does not hold.
    #[error(
        "{temperature_k:.2} K lies outside {low:.2} to {high:.2} K, where the laws of this oil hold"
    )]
    TemperatureOutside {
        /// What was asked for, K.
        temperature_k: f64,
        /// Lowest temperature of the laws, K.
        low: f64,
        /// Highest temperature of the laws, K.
        high: f64,
    },
    /// A viscosity at high shear that is not below the one at low shear.
    #[error(
        "hths is {hths:.4e} Pa.s, but the oil has only {low_shear:.4e} Pa.s at low shear and 150 degC: \
         check kv40, kv100 and the density at 150 degC"
    )]
    NotShearThinning {
        /// Given viscosity at 150 degC and 1e6 1/s, Pa s.
        hths: f64,
        /// Viscosity at 150 degC and low shear, Pa s.
        low_shear: f64,
    },
    /// A viscosity at high shear below the second Newtonian plateau.
    #[error(
        "hths is {hths:.4e} Pa.s, at or below the second Newtonian viscosity of {plateau:.4e} Pa.s: \
         second_newtonian_ratio must be smaller"
    )]
    BelowSecondNewtonian {
        /// Given viscosity at 150 degC and 1e6 1/s, Pa s.
        hths: f64,
        /// Viscosity at 150 degC and unlimited shear, Pa s.
        plateau: f64,
    },
}

/// Refuses a parameter outside its range.
pub(crate) fn within(name: &'static str, value: f64, low: f64, high: f64) -> Result<(), OilError> {
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(OilError::OutOfRange {
            name,
            value,
            low,
            high,
        })
    }
}

/// Refuses a parameter that is not positive and finite.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), OilError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(OilError::NotPositive { name, value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_continuous_in_value_and_slope_and_stay_bounded() {
        let (below, above) = (bounded_exponent(20.0 - 1e-9), bounded_exponent(20.0 + 1e-9));
        assert!((below.0 - above.0).abs() < 3e-9 && (below.1 - above.1).abs() < 1e-9);
        assert!(bounded_exponent(f64::MAX).0 <= 30.0);
        for p in [-1e3, -1e6, -2e7] {
            let step = 1e-4 * LARGEST_TENSION;
            let slope = (liquid_pressure(p + step).0 - liquid_pressure(p - step).0) / (2.0 * step);
            assert!((slope - liquid_pressure(p).1).abs() < 1e-7, "{p} {slope}");
        }
        assert!(liquid_pressure(-f64::MAX).0 >= -LARGEST_TENSION);
        assert_eq!(liquid_pressure(3e5), (3e5, 1.0));
    }

    #[test]
    fn ranges_meet() {
        let cold = TemperatureRange {
            low: 200.0,
            high: 300.0,
        };
        let warm = TemperatureRange {
            low: 250.0,
            high: 400.0,
        };
        assert_eq!(
            cold.and(warm),
            TemperatureRange {
                low: 250.0,
                high: 300.0
            }
        );
        assert!(cold.contains(300.0) && !cold.contains(300.1) && !cold.contains(f64::NAN));
        assert_eq!(cold.and(TemperatureRange::ALL), cold);
    }
}
