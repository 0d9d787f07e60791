//! Is this a 5W-30? Viscosity grades of engine oils, SAE J300 (January 2015).
//!
//! A grade is a winter part (0W to 25W), a summer part (8 to 60) or both, as `5W-30`. Each part sets
//! windows: kinematic viscosity at 100 degC (ASTM D445) for both; cranking (ASTM D5293) and pumping
//! (ASTM D4684) viscosity in the cold for the winter part; HTHS, at 150 degC and 1e6 1/s (ASTM
//! D4683), for the summer part. SAE 40 asks for less HTHS with 0W, 5W and 10W than with the others.
//!
//! Cranking and pumping viscosities are measured at high and at hardly any shear in oil that may
//! hold wax: no law of this crate reaches there, so they are compared where they are given.

use crate::{HTHS_SHEAR_RATE, HTHS_TEMPERATURE, Lubricant};
use serde::{Deserialize, Serialize};
use std::{fmt, str::FromStr};
use thiserror::Error;

/// Temperature of the kinematic viscosity of a grade, 100 degC, K.
const KV_TEMPERATURE: f64 = 373.15;
/// Round-off that a limit forgives.
const ROUND_OFF: f64 = 1e-9;
/// Largest pumping viscosity of every winter grade, Pa s.
const PUMPING: f64 = 60.0;

/// Winter grades: number, smallest kinematic viscosity at 100 degC (m2/s), largest cranking viscosity
/// (Pa s) at a temperature (degC), temperature of the pumping viscosity (degC).
const WINTER: [(u8, f64, f64, f64, f64); 6] = [
    (0, 3.8e-6, 6.2, -35.0, -40.0),
    (5, 3.8e-6, 6.6, -30.0, -35.0),
    (10, 4.1e-6, 7.0, -25.0, -30.0),
    (15, 5.6e-6, 7.0, -20.0, -25.0),
    (20, 5.6e-6, 9.5, -15.0, -20.0),
    (25, 9.3e-6, 13.0, -10.0, -15.0),
];

/// Summer grades: number, kinematic viscosity at 100 degC from and to below (m2/s), smallest HTHS
/// (Pa s).
const SUMMER: [(u8, f64, f64, f64); 8] = [
    (8, 4.0e-6, 6.1e-6, 1.7e-3),
    (12, 5.0e-6, 7.1e-6, 2.0e-3),
    (16, 6.1e-6, 8.2e-6, 2.3e-3),
    (20, 6.9e-6, 9.3e-6, 2.6e-3),
    (30, 9.3e-6, 12.5e-6, 2.9e-3),
    (40, 12.5e-6, 16.3e-6, 3.7e-3),
    (50, 16.3e-6, 21.9e-6, 3.7e-3),
    (60, 21.9e-6, 26.1e-6, 3.7e-3),
];
/// Smallest HTHS of 0W-40, 5W-40 and 10W-40, Pa s.
const HTHS_OF_LIGHT_40: f64 = 3.5e-3;

/// A viscosity grade of SAE J300.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct SaeGrade {
    winter: Option<u8>,
    summer: Option<u8>,
}

/// A largest viscosity at a low temperature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ColdLimit {
    /// Temperature, K.
    pub temperature: f64,
    /// Largest viscosity, Pa s.
    pub viscosity: f64,
}

/// What a grade asks of an oil.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GradeWindow {
    /// Smallest kinematic viscosity at 100 degC, m2/s.
    pub kv100_low: f64,
    /// Kinematic viscosity at 100 degC the oil has to stay below, m2/s.
    pub kv100_high: Option<f64>,
    /// Smallest viscosity at 150 degC and 1e6 1/s, Pa s.
    pub hths_low: Option<f64>,
    /// Cranking viscosity.
    pub cranking: Option<ColdLimit>,
    /// Pumping viscosity.
    pub pumping: Option<ColdLimit>,
}

/// What was measured of an oil; nothing is asked of what is not given.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Viscometrics {
    /// Kinematic viscosity at 100 degC, m2/s.
    pub kv100: Option<f64>,
    /// Viscosity at 150 degC and 1e6 1/s, Pa s.
    pub hths: Option<f64>,
    /// Cranking viscosity at the temperature of the grade, Pa s.
    pub cranking: Option<f64>,
    /// Pumping viscosity at the temperature of the grade, Pa s.
    pub pumping: Option<f64>,
}

/// No grade, or an oil outside it.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GradeError {
    /// SAE J300 has no such grade.
    #[error(
        "`{given}` is no grade of SAE J300: write 5W-30, 5W or 30, with 0W, 5W, 10W, 15W, 20W, 25W and \
         8, 12, 16, 20, 30, 40, 50, 60"
    )]
    Unknown {
        /// What was given.
        given: String,
    },
    /// A viscosity below its window.
    #[error("{what} is {value:.4} {unit}: SAE {grade} asks for at least {limit} {unit}")]
    Below {
        /// The grade.
        grade: SaeGrade,
        /// Which viscosity.
        what: &'static str,
        /// Its value, in `unit`.
        value: f64,
        /// Smallest value, in `unit`.
        limit: f64,
        /// Unit of both.
        unit: &'static str,
    },
    /// A viscosity at or above the end of its window.
    #[error("{what} is {value:.4} {unit}: SAE {grade} asks for {bound} {limit} {unit}")]
    Above {
        /// The grade.
        grade: SaeGrade,
        /// Which viscosity.
        what: &'static str,
        /// Its value, in `unit`.
        value: f64,
        /// `less than` or `at most`.
        bound: &'static str,
        /// The end of the window, in `unit`.
        limit: f64,
        /// Unit of both.
        unit: &'static str,
    },
}

impl SaeGrade {
    /// Every grade of one part: 0W to 25W, then 8 to 60.
    #[must_use]
    pub fn single() -> Vec<Self> {
        let winter = WINTER.iter().map(|row| Self {
            winter: Some(row.0),
            summer: None,
        });
        let summer = SUMMER.iter().map(|row| Self {
            winter: None,
            summer: Some(row.0),
        });
        winter.chain(summer).collect()
    }

    /// What the grade asks of an oil.
    #[must_use]
    pub fn window(&self) -> GradeWindow {
        let winter = WINTER.iter().find(|row| Some(row.0) == self.winter);
        let summer = SUMMER.iter().find(|row| Some(row.0) == self.summer);
        let cold = |celsius: f64, viscosity: f64| ColdLimit {
            temperature: 273.15 + celsius,
            viscosity,
        };
        let is_light_40 = self.summer == Some(40) && matches!(self.winter, Some(0 | 5 | 10));
        GradeWindow {
            kv100_low: winter
                .map_or(0.0, |row| row.1)
                .max(summer.map_or(0.0, |row| row.1)),
            kv100_high: summer.map(|row| row.2),
            hths_low: summer.map(|row| if is_light_40 { HTHS_OF_LIGHT_40 } else { row.3 }),
            cranking: winter.map(|row| cold(row.3, row.2)),
            pumping: winter.map(|row| cold(row.4, PUMPING)),
        }
    }

    /// Whether measured viscosities lie in the windows of the grade.
    ///
    /// # Errors
    /// [`GradeError::Below`] or [`GradeError::Above`] for the first window that is missed, with both values.
    pub fn check(&self, oil: &Viscometrics) -> Result<(), GradeError> {
        const KV: (&str, &str, f64) = ("the kinematic viscosity at 100 degC", "mm2/s", 1e6);
        const HTHS: (&str, &str, f64) =
            ("the viscosity at 150 degC and 1e6 1/s (HTHS)", "mPa.s", 1e3);
        const CRANKING: (&str, &str, f64) = ("the cranking viscosity", "mPa.s", 1e3);
        const PUMPING: (&str, &str, f64) = ("the pumping viscosity", "mPa.s", 1e3);
        let window = self.window();
        self.at_least(KV, oil.kv100, Some(window.kv100_low))?;
        if let (Some(kv100), Some(high)) = (oil.kv100, window.kv100_high)
            && (kv100.is_nan() || kv100 >= high * (1.0 - ROUND_OFF))
        {
            return Err(self.above(KV, kv100, "less than", high));
        }
        self.at_least(HTHS, oil.hths, window.hths_low)?;
        for (quantity, measured, limit) in [
            (CRANKING, oil.cranking, window.cranking),
            (PUMPING, oil.pumping, window.pumping),
        ] {
            if let (Some(value), Some(limit)) = (measured, limit)
                && (value.is_nan() || value > limit.viscosity * (1.0 + ROUND_OFF))
            {
                return Err(self.above(quantity, value, "at most", limit.viscosity));
            }
        }
        Ok(())
    }

    /// Whether the laws of an oil give viscosities in the windows at 100 and 150 degC.
    ///
    /// # Errors
    /// As [`Self::check`].
    pub fn check_lubricant(&self, oil: &Lubricant) -> Result<(), GradeError> {
        self.check(&Viscometrics {
            kv100: Some(oil.kinematic_viscosity(KV_TEMPERATURE)),
            hths: Some(
                oil.viscosity_at_shear(HTHS_TEMPERATURE, 0.0, HTHS_SHEAR_RATE)
                    .value,
            ),
            cranking: None,
            pumping: None,
        })
    }

    fn at_least(
        &self,
        (what, unit, scale): (&'static str, &'static str, f64),
        measured: Option<f64>,
        limit: Option<f64>,
    ) -> Result<(), GradeError> {
        match (measured, limit) {
            (Some(value), Some(limit)) if value.is_nan() || value < limit * (1.0 - ROUND_OFF) => {
                Err(GradeError::Below {
                    grade: *self,
                    what,
                    value: value * scale,
                    limit: in_unit(limit, scale),
                    unit,
                })
            }
            _ => Ok(()),
        }
    }

    fn above(
        &self,
        (what, unit, scale): (&'static str, &'static str, f64),
        value: f64,
        bound: &'static str,
        limit: f64,
    ) -> GradeError {
        GradeError::Above {
            grade: *self,
            what,
            value: value * scale,
            bound,
            limit: in_unit(limit, scale),
            unit,
        }
    }
}

/// A limit of the standard in its unit, with the digits the standard prints.
fn in_unit(limit: f64, scale: f64) -> f64 {
    (limit * scale * 10.0).round() / 10.0
}

impl fmt::Display for SaeGrade {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.winter, self.summer) {
            (Some(winter), Some(summer)) => write!(f, "{winter}W-{summer}"),
            (Some(winter), None) => write!(f, "{winter}W"),
            (None, Some(summer)) => write!(f, "{summer}"),
            (None, None) => Ok(()),
        }
    }
}

impl FromStr for SaeGrade {
    type Err = GradeError;

    /// Reads `5W-30`, `5W30`, `5W` or `30`, with or without `SAE` in front.
    fn from_str(given: &str) -> Result<Self, GradeError> {
        let unknown = || GradeError::Unknown {
            given: given.to_owned(),
        };
        let upper = given.trim().to_ascii_uppercase();
        let text = upper.strip_prefix("SAE").unwrap_or(&upper).trim();
        let (winter, summer) = match text.split_once('W') {
            Some((winter, rest)) => (Some(winter), rest.strip_prefix('-').unwrap_or(rest)),
            None => (None, text),
        };
        let number = |text: &str, known: &[u8]| {
            let named = known.iter().find(|number| number.to_string() == text);
            named.copied().ok_or_else(unknown)
        };
        let winter = winter
            .map(|text| number(text, &WINTER.map(|row| row.0)))
            .transpose()?;
        let summer = if summer.is_empty() && winter.is_some() && !text.ends_with('-') {
            None
        } else {
            Some(number(summer, &SUMMER.map(|row| row.0))?)
        };
        Ok(Self { winter, summer })
    }
}

impl TryFrom<String> for SaeGrade {
    type Error = GradeError;

    fn try_from(given: String) -> Result<Self, GradeError> {
        given.parse()
    }
}

impl From<SaeGrade> for String {
    fn from(grade: SaeGrade) -> Self {
        grade.to_string()
    }
}
