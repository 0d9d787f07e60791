//! How does pressure thicken the oil? eta(T, p) from the viscosity eta0(T) at ambient pressure.
//!
//! - Barus: `eta = eta0 exp(alpha p)`. C. Barus, American Journal of Science 45 (1893) 87-96. Good
//!   to about 100 MPa; far too thick beyond.
//! - Roelands: `eta = eta0 exp(L ((1 + 5.1e-9 p)^z - 1))`, `L = ln eta0 + 9.67`,
//!   `z = alpha / (5.1e-9 L)`, so that `alpha` is the slope of `ln eta` at ambient pressure.
//!   C. J. A. Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of
//!   lubricating oils, TU Delft 1966. Good to about 500 MPa.
//!
//! **Temperature counts once.** eta0(T) comes from the viscosity law, and at p = 0 both laws return
//! it unchanged. What is left to say is how `alpha` goes with temperature: [`RoelandsTemperature`].
//! Roelands' own temperature factor `((T - 138) / (T_r - 138))^-s0` on L is the third choice there,
//! for a viscosity that is known at one temperature only; with any other viscosity law it is refused.
//!
//! Limits: p is above ambient. In tension the laws are followed to 10 MPa and fade out; exponents
//! are followed to 20 (a factor of 5e8) and never exceed 30, so that guesses of an iteration stay
//! finite. eta0 counts as at least 1e-4 Pa s in L: below it `ln eta0 + 9.67` runs into its zero.

use crate::{
    Derived, OilError, TemperatureRange,
    law::{bounded_exponent, liquid_pressure, positive, within},
};
use serde::{Deserialize, Serialize};

/// Largest coefficient that is an oil's, 1/Pa; cylinder oils at 30 degC have 4e-8.
const LARGEST_ALPHA: f64 = 1e-7;
/// Inverse of the pressure of Roelands' law, 1/Pa.
pub(crate) const ROELANDS_PER_PASCAL: f64 = 5.1e-9;
/// Minus the logarithm of the viscosity (Pa s) where Roelands' lines meet, 6.3e-5 Pa s.
const ROELANDS_LOGARITHM: f64 = 9.67;
/// Temperature where Roelands' lines over temperature meet, K.
const ROELANDS_TEMPERATURE: f64 = 138.0;
/// Thinnest oil of Roelands' law, Pa s.
const THINNEST: f64 = 1e-4;
/// Largest slope over temperature that is an oil's; mineral oils have 1 to 1.5.
const LARGEST_TEMPERATURE_SLOPE: f64 = 5.0;

/// Law of the viscosity over pressure.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum PressureLaw {
    /// The same at every pressure.
    #[default]
    None,
    /// `eta0 exp(alpha p)`.
    Barus {
        /// Pressure-viscosity coefficient, 1/Pa; 5e-9 to 4e-8.
        alpha: f64,
    },
    /// `eta0 exp(L ((1 + 5.1e-9 p)^z - 1))`.
    Roelands {
        /// Pressure-viscosity coefficient at ambient pressure, 1/Pa; 5e-9 to 4e-8.
        alpha: f64,
        /// How the coefficient goes with temperature.
        #[serde(default)]
        temperature: RoelandsTemperature,
    },
}

/// What Roelands' law makes of temperature.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum RoelandsTemperature {
    /// `alpha` is the same at every temperature; z follows from eta0 at each.
    #[default]
    SameAlpha,
    /// `alpha` holds at this temperature and fixes z there; elsewhere alpha goes with `ln eta0 + 9.67`,
    /// as Roelands found: it falls as the oil warms.
    AlphaAt {
        /// Temperature of `alpha`, K.
        temperature: f64,
    },
    /// Roelands' own law over temperature on a viscosity given at one temperature: needs a constant
    /// viscosity law, which then holds at `temperature` alone.
    Slope {
        /// Roelands' slope over temperature; 1 to 1.5.
        s0: f64,
        /// Temperature of `alpha` and of the viscosity, K.
        temperature: f64,
    },
}

/// Roelands' law at one temperature.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RoelandsState {
    /// `L = ln eta0 + 9.67` and its derivative, 1/K.
    pub(crate) logarithm: [f64; 2],
    /// The exponent z and its derivative, 1/K.
    pub(crate) index: [f64; 2],
}

impl RoelandsState {
    /// `x = ln(eta / eta0)` at `t = ln(1 + 5.1e-9 p)`, dx/dt, and dx/dT in 1/K.
    pub(crate) fn exponent(&self, t: f64) -> [f64; 3] {
        let ([l, l_by_t], [z, z_by_t]) = (self.logarithm, self.index);
        let power_less_one = (z * t).exp_m1();
        let power = power_less_one + 1.0;
        [
            l * power_less_one,
            l * z * power,
            l_by_t * power_less_one + l * power * t * z_by_t,
        ]
    }
}

impl PressureLaw {
    /// Viscosity at ambient pressure, Pa s, at a temperature (K); `ambient` is the viscosity law's.
    ///
    /// The viscosity law's own value, except where Roelands' slope carries the temperature.
    #[must_use]
    pub fn at_ambient(&self, ambient: impl Fn(f64) -> Derived, temperature_k: f64) -> Derived {
        match *self {
            Self::Roelands {
                temperature: RoelandsTemperature::Slope { s0, temperature },
                ..
            } => {
                let reference = roelands_logarithm(ambient(temperature).value);
                let [l, l_by_t] = sloping_logarithm(reference, s0, temperature, temperature_k);
                let value = (l - ROELANDS_LOGARITHM).exp();
                Derived {
                    value,
                    by_temperature: value * l_by_t,
                    by_pressure: 0.0,
                }
            }
            _ => ambient(temperature_k),
        }
    }

    /// Viscosity, Pa s, at a temperature (K) and gauge pressure (Pa); `ambient` gives the viscosity
    /// law's value at ambient pressure over the temperature.
    #[must_use]
    pub fn at(
        &self,
        ambient: impl Fn(f64) -> Derived,
        temperature_k: f64,
        pressure_pa: f64,
    ) -> Derived {
        let eta0 = self.at_ambient(&ambient, temperature_k);
        let (p, p_slope) = liquid_pressure(pressure_pa);
        let [x, x_by_pressure, x_by_temperature] = match *self {
            Self::None => return eta0,
            Self::Barus { alpha } => [alpha * p, alpha, 0.0],
            Self::Roelands { .. } => {
                let state = self.roelands(&ambient, eta0, temperature_k);
                let [x, x_by_t, x_by_temperature] =
                    state.exponent((ROELANDS_PER_PASCAL * p).ln_1p());
                let t_by_pressure = ROELANDS_PER_PASCAL / (1.0 + ROELANDS_PER_PASCAL * p);
                [x, x_by_t * t_by_pressure, x_by_temperature]
            }
        };
        let (followed, slope) = bounded_exponent(x);
        let factor = followed.exp();
        let value = eta0.value * factor;
        // past the followed exponents an infinite slope meets a zero one
        let steepness = |by: f64| if slope > 0.0 { slope * by } else { 0.0 };
        Derived {
            value,
            by_temperature: eta0.by_temperature * factor + value * steepness(x_by_temperature),
            by_pressure: eta0.by_pressure * factor + value * steepness(x_by_pressure) * p_slope,
        }
    }

    /// Roelands' law at one temperature, where `eta0` is the viscosity at ambient pressure.
    pub(crate) fn roelands(
        &self,
        ambient: impl Fn(f64) -> Derived,
        eta0: Derived,
        temperature_k: f64,
    ) -> RoelandsState {
        let Self::Roelands { alpha, temperature } = *self else {
            return RoelandsState {
                logarithm: [1.0, 0.0],
                index: [0.0, 0.0],
            };
        };
        let own = [
            roelands_logarithm(eta0.value),
            if eta0.value > THINNEST {
                eta0.by_temperature / eta0.value
            } else {
                0.0
            },
        ];
        let index = |logarithm: f64| alpha / (ROELANDS_PER_PASCAL * logarithm);
        match temperature {
            RoelandsTemperature::SameAlpha => {
                let z = index(own[0]);
                RoelandsState {
                    logarithm: own,
                    index: [z, -z * own[1] / own[0]],
                }
            }
            RoelandsTemperature::AlphaAt { temperature } => RoelandsState {
                logarithm: own,
                index: [index(roelands_logarithm(ambient(temperature).value)), 0.0],
            },
            RoelandsTemperature::Slope { s0, temperature } => {
                let reference = roelands_logarithm(ambient(temperature).value);
                RoelandsState {
                    logarithm: sloping_logarithm(reference, s0, temperature, temperature_k),
                    index: [index(reference), 0.0],
                }
            }
        }
    }

    /// Whether the law carries the temperature of the viscosity itself.
    #[must_use]
    pub const fn has_temperature_slope(&self) -> bool {
        matches!(
            self,
            Self::Roelands {
                temperature: RoelandsTemperature::Slope { .. },
                ..
            }
        )
    }

    /// Whether the parameters describe an oil.
    ///
    /// # Errors
    /// [`OilError`] names the parameter that does not, and its range.
    pub fn check(&self) -> Result<(), OilError> {
        let (alpha, rule) = match *self {
            Self::None => return Ok(()),
            Self::Barus { alpha } => (alpha, RoelandsTemperature::SameAlpha),
            Self::Roelands { alpha, temperature } => (alpha, temperature),
        };
        within("alpha", alpha, 0.0, LARGEST_ALPHA)?;
        match rule {
            RoelandsTemperature::SameAlpha => Ok(()),
            RoelandsTemperature::AlphaAt { temperature } => positive("temperature", temperature),
            RoelandsTemperature::Slope { s0, temperature } => {
                within("s0", s0, 0.0, LARGEST_TEMPERATURE_SLOPE)?;
                within(
                    "temperature",
                    temperature,
                    SLOPE_RANGE.low,
                    SLOPE_RANGE.high,
                )
            }
        }
    }
}

/// Temperatures of Roelands' slope, K: -40 to 250 degC, between the pour point and the decay of oils.
pub(crate) const SLOPE_RANGE: TemperatureRange = TemperatureRange {
    low: 233.15,
    high: 523.15,
};

/// `ln eta0 + 9.67`, kept away from its zero.
fn roelands_logarithm(viscosity: f64) -> f64 {
    viscosity.max(THINNEST).ln() + ROELANDS_LOGARITHM
}

/// Roelands' logarithm over temperature and its derivative, 1/K.
fn sloping_logarithm(reference: f64, s0: f64, at: f64, temperature_k: f64) -> [f64; 2] {
    let above = (temperature_k - ROELANDS_TEMPERATURE).max(1.0);
    let l = reference * ((at - ROELANDS_TEMPERATURE) / above).powf(s0);
    [l, -s0 * l / above]
}
