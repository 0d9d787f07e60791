//! The moment of inertia that pistons and rods add to a throw.
//!
//! At one degree of freedom the kinetic energy of piston and rod is `J(b) b'^2 / 2` with the angle `b`
//! of the throw from the cylinder axis, and
//! `J = m_p x'^2 + m_r (x_g'^2 + y_g'^2) + I_r beta'^2`, derivatives by `b`. Its mean belongs to the
//! disc of a torsional chain; what it swings by, mostly at order 2, is excitation (`ripple`).

use crate::{CrankTrain, SliderCrank, ThrowInstant};
use std::f64::consts::TAU;

/// Points of the mean over a turn. `J` is smooth and periodic: the sum converges like a power of the
/// crank ratio, 1e-16 long before these are used up.
const POINTS: u32 = 360;

impl CrankTrain {
    /// Moment of inertia, kg m2, that piston and rod of one cylinder add where the arm of its throw
    /// stands at `angle` (rad) from the cylinder axis. Not a number if the rod cannot follow.
    #[must_use]
    pub fn slider_inertia(&self, angle: f64) -> f64 {
        let instant = SliderCrank::of(self).at(ThrowInstant {
            angle,
            speed: 1.0,
            acceleration: 0.0,
        });
        let turn = instant.rod_speed;
        let ([x, y], [pin_x, pin_y]) = (instant.rod_direction, instant.crankpin);
        let a = self.rod.centre_of_gravity;
        let [along, across] = [-pin_y - a * turn * y, pin_x + a * turn * x];
        self.piston_mass * instant.piston_speed * instant.piston_speed
            + self.rod.mass * (along * along + across * across)
            + self.rod.inertia * turn * turn
    }

    /// Mean over a turn of what its pistons and rods add to the moment of inertia of each throw, kg m2.
    #[must_use]
    pub fn mean_slider_inertias(&self) -> Vec<f64> {
        let of_one: f64 = (0..POINTS)
            .map(|at| self.slider_inertia(TAU * f64::from(at) / f64::from(POINTS)))
            .sum::<f64>()
            / f64::from(POINTS);
        let cylinders = |throw| {
            self.layout
                .cylinders
                .iter()
                .filter(move |one| one.throw == throw)
        };
        (0..self.layout.throws.len())
            .map(|throw| cylinders(throw).count() as f64 * of_one)
            .collect()
    }
}
