//! One cylinder: how piston and rod move, and the forces between them.

mod cylinder;
mod kinematics;
mod rod_forces;

pub use cylinder::{CylinderInstant, WorkingCylinder};
pub use kinematics::{SliderCrank, SliderCrankInstant};
pub use rod_forces::{RodForces, inertia_force, rod_forces};
