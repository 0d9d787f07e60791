//! What an engine gives and how it shakes: torque, mean effective pressure, orders.

use crate::Harmonic;
use serde::{Deserialize, Serialize};

/// Torque, work and shaking of an engine over one working cycle, at evenly spaced crank angles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Performance {
    /// Crank angles, rad, from 0, ascending, evenly spaced over one period, the last one before its end.
    pub crank_angles: Vec<f64>,
    /// Absolute gas pressure in cylinder 1, Pa.
    pub gas_pressure: Vec<f64>,
    /// Volume that piston 1 has left behind since it stood nearest to the head, m3.
    pub displaced_volume: Vec<f64>,
    /// Torque of gas and inertia on the crankshaft, N m, in the sense of rotation.
    pub torque: Vec<f64>,
    /// Torque of the gas alone, N m.
    pub gas_torque: Vec<f64>,
    /// Mean torque, N m.
    pub mean_torque: f64,
    /// Indicated mean effective pressure, Pa: work of the gas over one cycle and the swept volume.
    pub indicated_mean_effective_pressure: f64,
    /// Swept volume of all cylinders, m3.
    pub swept_volume: f64,
    /// Force of the moving parts on the engine block without the gas, N, x and y of the engine frame.
    pub shaking_force: Vec<[f64; 2]>,
    /// Moment of that force about x and y through the middle of the mains, N m.
    pub shaking_moment: Vec<[f64; 2]>,
    /// Piston side thrust of each cylinder, N, ON the piston towards y of a cylinder whose axis is x.
    pub side_thrust: Vec<Vec<f64>>,
    /// Harmonics of the torque, N m.
    pub torque_orders: Vec<Harmonic>,
    /// Harmonics of the shaking force along x and y, N.
    pub force_orders: [Vec<Harmonic>; 2],
    /// Harmonics of the shaking moment about x and y, N m.
    pub moment_orders: [Vec<Harmonic>; 2],
}
