//! How does shear thin the oil? eta = eta1 f(rate / rate_c), where eta1(T, p) is the viscosity at
//! low shear.
//!
//! - Cross: `f = r + (1 - r) / (1 + (rate / rate_c)^m)`. M. M. Cross, Journal of Colloid Science 20
//!   (1965) 417-437; his exponent m is 2/3 ([`CROSS_EXPONENT`]).
//! - Carreau: `f = r + (1 - r) (1 + (rate / rate_c)^2)^((n - 1) / 2)`. P. J. Carreau, Transactions of
//!   the Society of Rheology 16 (1972) 99-127.
//!
//! r is the second Newtonian viscosity over the first, about that of the base oil over that of the
//! blend. m <= 1 and n >= 0, because a stress that falls with the rate holds no steady flow.
//!
//! Temperature and pressure move the critical rate by time-temperature superposition, the time
//! constant going with `eta1 / (rho T)`: `rate_c = rate_r (rho T / eta1) / (rho T / eta1)_r`
//! (J. D. Ferry, Viscoelastic Properties of Polymers, 3rd ed., Wiley 1980, chapter 11). Without a
//! reference state the critical rate is the same everywhere.
//!
//! Identification: HTHS is the viscosity at 150 degC and 1e6 1/s (ASTM D4683); with r and the
//! exponent given, the critical rate at 150 degC follows in closed form.
//!
//! Limits: laminar shear without memory: the rate changes slowly against the time constant of the
//! polymer, about a microsecond. Cross' slope at zero rate is infinite for m < 1: below 1e-9 of the
//! critical rate a parabola without slope takes over, which moves the viscosity by less than 1e-9^m.

use crate::{
    Derived, OilError,
    law::{positive, within},
};
use serde::{Deserialize, Serialize};

/// Exponent of M. M. Cross (1965).
pub const CROSS_EXPONENT: f64 = 2.0 / 3.0;
/// Temperature of HTHS, 150 degC, K (ASTM D4683, SAE J300).
pub const HTHS_TEMPERATURE: f64 = 423.15;
/// Shear rate of HTHS, 1/s (ASTM D4683, SAE J300).
pub const HTHS_SHEAR_RATE: f64 = 1e6;
/// Part of the critical rate below which Cross' cusp is rounded.
const ROUNDED: f64 = 1e-9;
/// Smallest exponent of Cross: below it the law is a constant over any range of rates.
const SMALLEST_EXPONENT: f64 = 0.1;

/// Law of the viscosity over the shear rate.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum ShearThinning {
    /// Newtonian.
    #[default]
    None,
    /// `r + (1 - r) / (1 + (rate / critical)^exponent)`.
    Cross {
        /// Second Newtonian viscosity over the first, 0 to below 1.
        second_newtonian_ratio: f64,
        /// Shear rate halfway down to the second plateau, 1/s.
        critical_shear_rate: f64,
        /// Exponent, 0.1 to 1.
        exponent: f64,
        /// State where the critical rate holds; none: it holds everywhere.
        #[serde(default)]
        reference: Option<ReferenceState>,
    },
    /// `r + (1 - r) (1 + (rate / critical)^2)^((exponent - 1) / 2)`.
    Carreau {
        /// Second Newtonian viscosity over the first, 0 to below 1.
        second_newtonian_ratio: f64,
        /// Shear rate where thinning sets in, 1/s.
        critical_shear_rate: f64,
        /// Exponent of the power law beyond, 0 to below 1.
        exponent: f64,
        /// State where the critical rate holds; none: it holds everywhere.
        #[serde(default)]
        reference: Option<ReferenceState>,
    },
}

/// The oil where its critical shear rate was found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ReferenceState {
    /// Temperature, K.
    pub temperature: f64,
    /// Viscosity at low shear, Pa s.
    pub viscosity: f64,
    /// Density, kg/m3.
    pub density: f64,
}

/// A viscosity with its derivatives, that by the shear rate among them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Sheared {
    /// Dynamic viscosity, Pa s.
    pub value: f64,
    /// Derivative with respect to temperature, Pa s/K.
    pub by_temperature: f64,
    /// Derivative with respect to pressure, s.
    pub by_pressure: f64,
    /// Derivative with respect to the shear rate, Pa s2.
    pub by_shear_rate: f64,
}

/// Form of the law that is identified, with its exponent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum ThinningForm {
    /// Cross; [`CROSS_EXPONENT`] is Cross' own.
    Cross {
        /// Exponent, 0.1 to 1.
        exponent: f64,
    },
    /// Carreau.
    Carreau {
        /// Exponent of the power law, 0 to below 1.
        exponent: f64,
    },
}

impl ShearThinning {
    /// Viscosity, Pa s, at a temperature (K) and shear rate (1/s, of either sign) of an oil with the
    /// viscosity `low_shear` (Pa s) and this density (kg/m3), both at that temperature and pressure.
    #[must_use]
    pub fn at(
        &self,
        low_shear: Derived,
        density: Derived,
        temperature_k: f64,
        shear_rate: f64,
    ) -> Sheared {
        let (critical, reference) = match *self {
            Self::None => {
                return Sheared {
                    value: low_shear.value,
                    by_temperature: low_shear.by_temperature,
                    by_pressure: low_shear.by_pressure,
                    by_shear_rate: 0.0,
                };
            }
            Self::Cross {
                critical_shear_rate,
                reference,
                ..
            }
            | Self::Carreau {
                critical_shear_rate,
                reference,
                ..
            } => (critical_shear_rate, reference),
        };
        let [shift, log_by_temperature, log_by_pressure] = match reference {
            None => [1.0, 0.0, 0.0],
            Some(reference) => reference.shift(low_shear, density, temperature_k),
        };
        let critical = critical * shift;
        let relative = shear_rate.abs() / critical;
        let [factor, slope] = self.factor(relative);
        let eta = low_shear.value;
        Sheared {
            value: eta * factor,
            by_temperature: low_shear.by_temperature * factor
                - eta * slope * relative * log_by_temperature,
            by_pressure: low_shear.by_pressure * factor - eta * slope * relative * log_by_pressure,
            by_shear_rate: eta * slope / critical * shear_rate.signum(),
        }
    }

    /// Viscosity over the one at low shear, over the rate in parts of the critical one, and its slope.
    #[must_use]
    pub fn factor(&self, relative_rate: f64) -> [f64; 2] {
        match *self {
            Self::None => [1.0, 0.0],
            Self::Cross {
                second_newtonian_ratio: r,
                exponent,
                ..
            } => {
                let (power, slope) = rounded_power(relative_rate, exponent);
                let below = 1.0 + power;
                [r + (1.0 - r) / below, -(1.0 - r) * (slope / below) / below]
            }
            Self::Carreau {
                second_newtonian_ratio: r,
                exponent,
                ..
            } => {
                let half = 0.5 * (exponent - 1.0);
                let base = 1.0 + relative_rate * relative_rate;
                let power = base.powf(half);
                [
                    r + (1.0 - r) * power,
                    (1.0 - r) * 2.0 * half * power * (relative_rate / base),
                ]
            }
        }
    }

    /// The law that gives the viscosity `hths` (Pa s) at 150 degC and 1e6 1/s of an oil whose state
    /// at 150 degC and low shear is `low_shear`; `second_newtonian_ratio` is the base oil's viscosity
    /// over the blend's, 0 to below 1, for which no number holds for every oil.
    ///
    /// # Errors
    /// [`OilError::NotShearThinning`] where HTHS is not below the viscosity at low shear,
    /// [`OilError::BelowSecondNewtonian`] where it is not above the second plateau, and the errors
    /// of [`Self::check`].
    pub fn identify(
        form: ThinningForm,
        second_newtonian_ratio: f64,
        low_shear: ReferenceState,
        hths: f64,
    ) -> Result<Self, OilError> {
        let r = second_newtonian_ratio;
        let with = |critical_shear_rate: f64| match form {
            ThinningForm::Cross { exponent } => Self::Cross {
                second_newtonian_ratio,
                critical_shear_rate,
                exponent,
                reference: Some(low_shear),
            },
            ThinningForm::Carreau { exponent } => Self::Carreau {
                second_newtonian_ratio,
                critical_shear_rate,
                exponent,
                reference: Some(low_shear),
            },
        };
        with(HTHS_SHEAR_RATE).check()?;
        positive("hths", hths)?;
        let factor = hths / low_shear.viscosity;
        if factor >= 1.0 {
            return Err(OilError::NotShearThinning {
                hths,
                low_shear: low_shear.viscosity,
            });
        }
        if factor <= r {
            return Err(OilError::BelowSecondNewtonian {
                hths,
                plateau: r * low_shear.viscosity,
            });
        }
        let thinned = (1.0 - factor) / (factor - r);
        let relative = match form {
            ThinningForm::Cross { exponent } => thinned.powf(1.0 / exponent),
            // ((f - r) / (1 - r))^(2 / (n - 1)) - 1, without the loss of digits near 1
            ThinningForm::Carreau { exponent } => {
                (thinned.ln_1p() * 2.0 / (1.0 - exponent)).exp_m1().sqrt()
            }
        };
        let found = with(HTHS_SHEAR_RATE / relative);
        found.check()?;
        Ok(found)
    }

    /// Whether the parameters describe an oil.
    ///
    /// # Errors
    /// [`OilError`] names the parameter that does not, and its range.
    pub fn check(&self) -> Result<(), OilError> {
        let (ratio, critical, reference) = match *self {
            Self::None => return Ok(()),
            Self::Cross {
                second_newtonian_ratio,
                critical_shear_rate,
                exponent,
                reference,
            } => {
                within("exponent", exponent, SMALLEST_EXPONENT, 1.0)?;
                (second_newtonian_ratio, critical_shear_rate, reference)
            }
            Self::Carreau {
                second_newtonian_ratio,
                critical_shear_rate,
                exponent,
                reference,
            } => {
                within("exponent", exponent, 0.0, 1.0 - SMALLEST_EXPONENT)?;
                (second_newtonian_ratio, critical_shear_rate, reference)
            }
        };
        within("second_newtonian_ratio", ratio, 0.0, 1.0 - f64::EPSILON)?;
        positive("critical_shear_rate", critical)?;
        reference.map_or(Ok(()), |state| {
            positive("temperature", state.temperature)?;
            positive("viscosity", state.viscosity)?;
            positive("density", state.density)
        })
    }
}

impl ReferenceState {
    /// Critical rate over the one here, and the derivatives of its logarithm by temperature (1/K)
    /// and pressure (1/Pa).
    fn shift(&self, low_shear: Derived, density: Derived, temperature_k: f64) -> [f64; 3] {
        let here = self.density * self.temperature / self.viscosity;
        let there = density.value * temperature_k / low_shear.value;
        [
            there / here,
            density.by_temperature / density.value + 1.0 / temperature_k
                - low_shear.by_temperature / low_shear.value,
            density.by_pressure / density.value - low_shear.by_pressure / low_shear.value,
        ]
    }
}

/// `x^m` for `x >= 0` and its slope, with the cusp at zero rounded.
fn rounded_power(x: f64, m: f64) -> (f64, f64) {
    if x >= ROUNDED || m >= 1.0 {
        let slope = if x > 0.0 { m * x.powf(m - 1.0) } else { 1.0 };
        return (x.powf(m), slope);
    }
    // s^2 ((4 - m) + (m - 2) s^2) / 2: value 1 and slope m at s = 1, no slope at 0
    let s = x / ROUNDED;
    let scale = ROUNDED.powf(m);
    (
        scale * 0.5 * s * s * ((4.0 - m) + (m - 2.0) * s * s),
        scale / ROUNDED * s * ((4.0 - m) + 2.0 * (m - 2.0) * s * s),
    )
}
