//! How the crankshaft twists under its orders.

use crate::Twist;
use serde::{Deserialize, Serialize};

/// A chain of discs joined by torsional springs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TorsionalChain {
    /// Discs from the free end to the flywheel.
    pub discs: Vec<Disc>,
    /// Links between neighbours: one fewer than discs.
    pub links: Vec<TorsionalLink>,
}

/// One disc of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Disc {
    /// Moment of inertia, kg m2.
    pub inertia: f64,
    /// Damping against ground, N m s/rad.
    pub damping: f64,
    /// The throw that drives it, if any.
    pub throw: Option<usize>,
}

/// One link of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TorsionalLink {
    /// N m/rad.
    pub stiffness: f64,
    /// Viscous damping between the discs, N m s/rad.
    pub damping: f64,
    /// Loss factor: imaginary over real part of the stiffness.
    pub loss_factor: f64,
}

/// Steady torsional vibration of a chain at one speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TorsionResponse {
    /// Natural frequencies of the undamped chain, Hz, ascending, the rigid one first.
    pub natural_frequencies: Vec<f64>,
    /// Mode shapes, one row for each frequency, largest entry 1.
    pub modes: Vec<Vec<f64>>,
    /// Twist of each disc over the crank angle, rad, about the even turning of the shaft.
    pub twists: Vec<Twist>,
    /// Torque in each link over the orders, N m.
    pub link_torques: Vec<Twist>,
    /// Mean heat in each link over a cycle, W: what a damper must give off.
    pub link_heat: Vec<f64>,
}
