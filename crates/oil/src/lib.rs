//! Lubricant laws: numbers in, numbers and exact derivatives out. SI units throughout.
//!
//! A [`Lubricant`] joins a law of each kind: viscosity over temperature, pressure and shear rate,
//! density over temperature and pressure, heat capacity and conductivity. Every law returns its value
//! with its derivatives ([`Derived`], [`Sheared`]), so that Newton iterations above never difference
//! a law numerically, and says what describes no oil and at which temperatures it holds.

pub mod density;
pub mod heat;
pub mod law;
pub mod library;
pub mod lubricant;
pub mod pressure;
pub mod reduced_pressure;
pub mod sae;
pub mod shear_thinning;
pub mod viscosity;

pub use density::{CompressionLaw, DensityLaw};
pub use heat::{ConductivityLaw, HeatCapacityLaw};
pub use law::{Derived, OilError, TemperatureRange};
pub use library::NamedOil;
pub use lubricant::Lubricant;
pub use pressure::{PressureLaw, RoelandsTemperature};
pub use sae::{GradeError, SaeGrade};
pub use shear_thinning::{
    CROSS_EXPONENT, HTHS_SHEAR_RATE, HTHS_TEMPERATURE, ReferenceState, ShearThinning, Sheared,
    ThinningForm,
};
pub use viscosity::{HOTTEST_OIL, ViscosityLaw};
