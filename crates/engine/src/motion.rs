//! How the crankshaft turns: its mean speed and what torsion adds at each place.

use serde::{Deserialize, Serialize};

/// Motion of a crankshaft. Time runs with the mean speed: the crank angle is mean speed times time,
/// and each place of the shaft leads or lags by its twist.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CrankMotion {
    /// Mean angular speed, rad/s.
    pub speed: f64,
    /// Twist at stations of ascending axial position, linear between them and constant beyond; empty
    /// for a shaft that turns evenly.
    pub twists: Vec<(f64, Twist)>,
}

/// Periodic twist of one place of the shaft, rad: the sum of its harmonics.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Twist {
    /// Harmonics by ascending order.
    pub harmonics: Vec<Harmonic>,
}

/// `cos` cos(n a) + `sin` sin(n a) over the crank angle a.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Harmonic {
    /// Order n: periods per turn of the crankshaft, 0.5, 1, 1.5, ... for a four-stroke engine.
    pub order: f64,
    /// Amplitude of the cosine.
    pub cos: f64,
    /// Amplitude of the sine.
    pub sin: f64,
}

/// Angle and motion of one place of the shaft at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThrowInstant {
    /// Crank angle with the twist, rad.
    pub angle: f64,
    /// rad/s.
    pub speed: f64,
    /// rad/s2.
    pub acceleration: f64,
}

impl Harmonic {
    /// Value and its first two derivatives with respect to the crank angle (rad).
    #[must_use]
    pub fn at(&self, crank_angle: f64) -> [f64; 3] {
        let (sin, cos) = (self.order * crank_angle).sin_cos();
        let value = self.cos * cos + self.sin * sin;
        let slope = self.order * (self.sin * cos - self.cos * sin);
        [value, slope, -self.order * self.order * value]
    }
}

impl Twist {
    /// Twist and its first two derivatives with respect to the crank angle (rad).
    #[must_use]
    pub fn at(&self, crank_angle: f64) -> [f64; 3] {
        self.harmonics.iter().fold([0.0; 3], |sum, harmonic| {
            let added = harmonic.at(crank_angle);
            [0, 1, 2].map(|k| sum[k] + added[k])
        })
    }
}

impl CrankMotion {
    /// A shaft that turns evenly at `speed` (rad/s).
    #[must_use]
    pub fn even(speed: f64) -> Self {
        Self {
            speed,
            twists: Vec::new(),
        }
    }

    /// Motion of the place at axial position `z` (m) when the crank angle (rad) is `crank_angle`.
    #[must_use]
    pub fn at(&self, z: f64, crank_angle: f64) -> ThrowInstant {
        let [twist, slope, bend] = self.twist_at(z, crank_angle);
        ThrowInstant {
            angle: crank_angle + twist,
            speed: self.speed * (1.0 + slope),
            acceleration: self.speed * self.speed * bend,
        }
    }

    fn twist_at(&self, z: f64, crank_angle: f64) -> [f64; 3] {
        let behind = self.twists.partition_point(|(station, _)| *station <= z);
        let before = behind.checked_sub(1).and_then(|at| self.twists.get(at));
        match (before, self.twists.get(behind)) {
            (None, None) => [0.0; 3],
            (Some((_, only)), None) | (None, Some((_, only))) => only.at(crank_angle),
            (Some((from, a)), Some((to, b))) => {
                let share = (z - from) / (to - from);
                let (a, b) = (a.at(crank_angle), b.at(crank_angle));
                [0, 1, 2].map(|k| a[k] + share * (b[k] - a[k]))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speed_and_acceleration_are_derivatives_of_the_angle() {
        let twist = |order, cos, sin| Twist {
            harmonics: vec![Harmonic { order, cos, sin }],
        };
        let motion = CrankMotion {
            speed: 200.0,
            twists: vec![(0.0, twist(3.0, 0.01, 0.02)), (0.5, twist(1.5, -0.02, 0.0))],
        };
        let (z, a, step) = (0.2, 0.7, 1e-4);
        let angle = |a| motion.at(z, a).angle;
        let speed = motion.speed * (angle(a + step) - angle(a - step)) / (2.0 * step);
        let second = (angle(a + step) - 2.0 * angle(a) + angle(a - step)) / (step * step);
        let instant = motion.at(z, a);
        assert!((instant.speed / speed - 1.0).abs() < 1e-8);
        assert!((instant.acceleration / (motion.speed.powi(2) * second) - 1.0).abs() < 1e-5);
    }
}
