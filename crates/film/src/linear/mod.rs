//! Direct solution of the film's linear systems.

mod kernels;
pub mod ring;

pub use kernels::Lanes;
pub use ring::{RingFactor, RingMatrix};
