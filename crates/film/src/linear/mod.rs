//! Direct solution of the film's linear systems.

pub mod ring;

pub use ring::{Lanes, RingFactor, RingMatrix};
