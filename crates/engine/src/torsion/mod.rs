//! How the crankshaft twists under its orders, and what that does to its speed.
//!
//! Question: the twist of each disc of a torsional chain about the even turning of the shaft, from
//! the torque of each throw. Equation, over the crank angle `a = W t` at the mean speed `W`:
//! `M W^2 x'' + C W x' + (K + i H) x = T(a)`, with the moments of inertia `M`, the damping `C` against
//! ground and in the links, the stiffness `K` and, for each harmonic, the loss `H` of the links.
//! Unknowns: the twist (rad) of each disc, one complex number for each order.
//! Signs: a twist is positive where the disc leads the even turning; the torque of a link is positive
//! where its disc on the side of the free end drives the other.
//! Mean torque: the load takes it at the last disc, less what damping against ground takes; the mean
//! twist is counted from the disc of throw 1, where the crank angle is counted.
//!
//! Limits: linear links; the inertia of a disc is constant. The inertia of a crank slider swings with
//! the crank angle: its mean belongs to the disc, the rest is excitation (`ripple`). Torsion alone:
//! bending and axial vibration, which real crankshafts couple to it, are left out.
//! References: J. P. Den Hartog, Mechanical Vibrations, 4th ed. 1956, ch. 3 and 5 (dampers,
//! multi-cylinder engines); W. Ker Wilson, Practical Solution of Torsional Vibration Problems, 3rd
//! ed.; E. J. Nestorides, A Handbook on Torsional Vibration, 1958.

mod chain;
mod damper;
mod forced;
mod free;
mod inertia;
mod ripple;
mod tuning;

pub use chain::{ChainMatrices, Disc, TorsionError, TorsionalChain, TorsionalLink};
pub use damper::Damper;
pub use forced::TorsionResponse;
pub use free::NaturalVibration;
pub use ripple::{RippleSettings, SettledRipple, engine_ripple, settle_ripple};
pub use tuning::{DamperOptimum, DamperTask};
