//! How the crankshaft twists under its orders, and what that does to its speed.
//!
//! Question: the twist of each disc of a torsional chain about the even turning of the shaft, from the
//! torque of each throw. Over the crank angle `a = W t` at the mean speed `W`:
//! `M W^2 x'' + C W x' + (K + i H) x = T(a)`, with the moments of inertia `M`, the damping `C` of discs
//! against even turning and of links, the stiffness `K` and, order by order, the loss `H` of the links.
//! Unknowns: the twist (rad) of each disc, one complex number for each order.
//! Signs: a twist is positive where the disc leads the even turning; the torque of a link is positive
//! where its disc on the side of the free end drives the other.
//! Mean torque: the load takes all of it at the last disc; the drag of the mean speed is part of the
//! torques or of the load. The mean twist is counted from the disc of throw 1, as the crank angle is.
//!
//! Limits: linear links; the inertia of a disc is constant. That of a slider-crank swings with the
//! crank angle: its mean belongs to the disc, the rest is excitation (`ripple`). Torsion alone:
//! bending and axial vibration, which real crankshafts couple to it, are left out.
//! References: J. P. Den Hartog, Mechanical Vibrations, 4th ed. 1956, ch. 3 and 5 (dampers, engines);
//! W. Ker Wilson, Practical Solution of Torsional Vibration Problems, 3rd ed.; E. J. Nestorides,
//! A Handbook on Torsional Vibration, 1958.

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
