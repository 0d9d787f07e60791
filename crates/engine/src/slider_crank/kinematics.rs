//! How piston and rod move with the crank: the slider-crank, exact.
//!
//! Frame: x along the cylinder axis towards the head, y 90 deg further in the sense of rotation, origin
//! on the crank axis. Arm r at the angle t from x, rod l, cylinder axis at y = e:
//! `sin b = (r sin t - e)/l`, `x = r cos t + l cos b`, and their time derivatives with w = dt/dt and
//! a = dw/dt, the angular acceleration of the throw:
//! `b' = r w cos t/(l cos b)`, `b'' = (r a cos t - r w^2 sin t + l b'^2 sin b)/(l cos b)`,
//! `x'' = -r (w^2 cos t + a sin t) - l (b'^2 cos b + b'' sin b)`.
//! The rod points from big end to small end along (cos b, -sin b): it turns with the angular speed -b'.
//!
//! Assumptions: rigid parts without play. Limit: l > r + |e|, else the crank does not turn through and
//! the figures are not numbers where the rod does not reach.
//! Reference: any text on machine dynamics, e.g. Dresig and Holzweissig, Dynamics of Machinery, 2010.

use crate::{CrankTrain, ThrowInstant};

/// Dimensions of a slider-crank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliderCrank {
    /// m.
    pub crank_radius: f64,
    /// From big-end to small-end centre, m.
    pub rod_length: f64,
    /// y of the cylinder axis (piston pin), m.
    pub pin_offset: f64,
}

/// A slider-crank at an instant, in the frame of its cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliderCrankInstant {
    /// Angle of the arm from the cylinder axis, rad, its speed, rad/s, and acceleration, rad/s2.
    pub crank: ThrowInstant,
    /// Angular speed of the rod in the sense of rotation of the crank, -b', rad/s.
    pub rod_speed: f64,
    /// Angular acceleration of the rod, -b'', rad/s2.
    pub rod_acceleration: f64,
    /// Unit vector from big end to small end.
    pub rod_direction: [f64; 2],
    /// Position of the crankpin, m.
    pub crankpin: [f64; 2],
    /// Acceleration of the crankpin, m/s2.
    pub crankpin_acceleration: [f64; 2],
    /// Distance of the piston pin from the crank axis along the cylinder axis, m.
    pub piston_position: f64,
    /// Speed of the piston towards the head, m/s.
    pub piston_speed: f64,
    /// Acceleration of the piston towards the head, m/s2.
    pub piston_acceleration: f64,
}

impl SliderCrank {
    /// The slider-crank of each cylinder of an engine.
    #[must_use]
    pub fn of(train: &CrankTrain) -> Self {
        Self {
            crank_radius: train.crank_radius,
            rod_length: train.rod_length,
            pin_offset: train.pin_offset,
        }
    }

    /// Angle of the arm from the cylinder axis at the piston's top dead centre, rad: arm and rod in line.
    #[must_use]
    pub fn top_dead_centre(&self) -> f64 {
        (self.pin_offset / (self.rod_length + self.crank_radius)).asin()
    }

    /// Angle of the arm from the cylinder axis at the piston's bottom dead centre, rad.
    #[must_use]
    pub fn bottom_dead_centre(&self) -> f64 {
        std::f64::consts::PI + (self.pin_offset / (self.rod_length - self.crank_radius)).asin()
    }

    /// Way of the piston from dead centre to dead centre, m.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        let reach = |arm: f64| (arm * arm - self.pin_offset * self.pin_offset).sqrt();
        reach(self.rod_length + self.crank_radius) - reach(self.rod_length - self.crank_radius)
    }

    /// Position and motion when the arm stands at the angle of `crank` from the cylinder axis.
    #[must_use]
    pub fn at(&self, crank: ThrowInstant) -> SliderCrankInstant {
        let (r, l) = (self.crank_radius, self.rod_length);
        let ThrowInstant {
            angle,
            speed,
            acceleration,
        } = crank;
        let (sin, cos) = angle.sin_cos();
        let sin_rod = (r * sin - self.pin_offset) / l;
        let cos_rod = (1.0 - sin_rod * sin_rod).sqrt();
        let rate = r * speed * cos / (l * cos_rod);
        let change = r * (acceleration * cos - speed * speed * sin) + l * rate * rate * sin_rod;
        let second = change / (l * cos_rod);
        let crankpin_acceleration = [
            -r * (speed * speed * cos + acceleration * sin),
            -r * (speed * speed * sin - acceleration * cos),
        ];
        SliderCrankInstant {
            crank,
            rod_speed: -rate,
            rod_acceleration: -second,
            rod_direction: [cos_rod, -sin_rod],
            crankpin: [r * cos, r * sin],
            crankpin_acceleration,
            piston_position: r * cos + l * cos_rod,
            piston_speed: -r * speed * sin - l * rate * sin_rod,
            piston_acceleration: crankpin_acceleration[0]
                - l * (rate * rate * cos_rod + second * sin_rod),
        }
    }
}

impl SliderCrankInstant {
    /// Angle b of the rod, rad: it points along (cos b, -sin b).
    #[must_use]
    pub fn rod_angle(&self) -> f64 {
        (-self.rod_direction[1]).asin()
    }

    /// Acceleration of the point of the rod at `distance` (m) from the big-end centre, m/s2.
    #[must_use]
    pub fn rod_point_acceleration(&self, distance: f64) -> [f64; 2] {
        let [x, y] = self.rod_direction;
        let (turning, towards) = (self.rod_acceleration, self.rod_speed * self.rod_speed);
        let [pin_x, pin_y] = self.crankpin_acceleration;
        [
            pin_x - distance * (turning * y + towards * x),
            pin_y + distance * (turning * x - towards * y),
        ]
    }

    /// Components along the rod and across it of a vector in the frame of the cylinder.
    #[must_use]
    pub fn in_rod_frame(&self, vector: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.rod_direction;
        [x * vector[0] + y * vector[1], x * vector[1] - y * vector[0]]
    }
}
