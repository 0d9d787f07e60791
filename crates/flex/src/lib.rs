//! Elastic bodies: beams, their matrices, and their condensation onto the places where bearings hold
//! them.
//!
//! Degrees of freedom of a node, in this order: displacements x, y, z (m), rotations about x, y, z
//! (rad), right-handed, small. z is the axis of a shaft and points to its drive end (the flywheel).
mod beam;
mod condensed;
mod error;
mod frame;
mod section;

pub use beam::NODE_FREEDOMS;
pub use condensed::{CondensedShaft, JOURNAL_FREEDOMS};
pub use error::FrameError;
pub use frame::{Frame, NodeLoad};
pub use section::{Material, Section};
