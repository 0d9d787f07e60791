//! Direct solution of the film's linear systems.

mod dense;
mod kernels;
pub mod ring;

pub use dense::solve_dense;
pub use kernels::{Lanes, larger};
pub use ring::{RingFactor, RingMatrix};
