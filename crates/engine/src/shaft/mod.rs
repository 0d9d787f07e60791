//! Crankshafts and straight shafts as elastic bodies, and what holds them.

mod crank_frame;
mod crank_station;
mod crankshaft;
mod error;
mod force;
mod general;
mod general_frame;
mod supports;
mod throw_stiffness;

pub use crank_frame::condensed_crankshaft;
pub use crankshaft::{CrankshaftShape, Mains, PinFit, Supports, Web};
pub use error::ShaftError;
pub use force::ShaftForce;
pub use general::{GeneralShaft, ShaftLoad, ShaftSection};
pub use general_frame::condensed_shaft;
pub use supports::{SupportReactions, support_reactions};
pub use throw_stiffness::{ThrowStiffness, fitted_web, throw_stiffness};
