//! Lubricant laws: numbers in, numbers and exact derivatives out. SI units throughout.
//!
//! A [`Lubricant`] joins a viscosity law and a density law. Every law returns a [`Derived`] value,
//! so that Newton iterations above never difference a law numerically.

pub mod density;
pub mod law;
pub mod lubricant;
pub mod viscosity;

pub use density::DensityLaw;
pub use law::{Derived, OilError};
pub use lubricant::Lubricant;
pub use viscosity::ViscosityLaw;
