//! What the rod carries: small end, big end and side thrust from Newton and Euler, in closed form.
//!
//! Unknown are the force P of the rod on the piston, the force Q of the crankpin on the rod and the side
//! thrust N of the cylinder on the piston; frame of the cylinder, u from big end to small end, u x v the
//! component about z, a the distance of the rod's centre of gravity from the big end.
//! Piston along x: `P_x = m_p x'' + A (p - p_crankcase)`; across: `N = -P_y`.
//! Rod: `Q - P = m_r c''`; about its centre of gravity: `J W' = -(l - a) u x P - a u x Q`. Q put in:
//! `u x P = -(J W' + a m_r u x c'')/l`, which with P_x gives P_y.
//! With `J = m_r a (l - a)` the rod is two point masses; with any other it takes a couple besides, which
//! the side thrust and the main bearings feel.
//!
//! Assumptions: rigid rod, symmetric about the line of its centres; no friction; the gas force and all of
//! the piston's mass act at the pin; the cylinder takes the moment of the piston.

use crate::{CrankTrain, SliderCrankInstant};

/// Forces on the rod of one cylinder, N, in the frame of the cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RodForces {
    /// Force of the rod ON the crankpin.
    pub big_end: [f64; 2],
    /// Force of the rod ON the piston with its pin.
    pub small_end: [f64; 2],
    /// Force of the cylinder ON the piston along y.
    pub side_thrust: f64,
}

/// Forces of piston and rod in motion under the gas force (N, on the piston, away from the head).
#[must_use]
pub fn rod_forces(train: &CrankTrain, instant: &SliderCrankInstant, gas_force: f64) -> RodForces {
    let rod = &train.rod;
    let along = train.piston_mass * instant.piston_acceleration + gas_force;
    let [x, y] = instant.rod_direction;
    let inertia = instant
        .rod_point_acceleration(rod.centre_of_gravity)
        .map(|acceleration| rod.mass * acceleration);
    let moment = rod.inertia * instant.rod_acceleration
        + rod.centre_of_gravity * (x * inertia[1] - y * inertia[0]);
    let across = (y * along - moment / train.rod_length) / x;
    RodForces {
        big_end: [-along - inertia[0], -across - inertia[1]],
        small_end: [along, across],
        side_thrust: -across,
    }
}

/// Force of the moving piston and rod on the engine block without the gas, N: what it takes to
/// accelerate them, reversed. Frame of the cylinder.
#[must_use]
pub fn inertia_force(train: &CrankTrain, instant: &SliderCrankInstant) -> [f64; 2] {
    let rod = &train.rod;
    let [x, y] = instant.rod_point_acceleration(rod.centre_of_gravity);
    [
        -train.piston_mass * instant.piston_acceleration - rod.mass * x,
        -rod.mass * y,
    ]
}
