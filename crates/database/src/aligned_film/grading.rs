//! Columns around the bearing: half of them even, half of them where the gap is narrow.
//!
//! `s = (phi + 2 atan(tan(phi/2)/a))/2`, the mean of the angle and of Sommerfeld's, with `a` the square
//! root of `1 - eps^2`, which is the length of the narrow gap near contact.

use std::f64::consts::PI;

/// Map between the even coordinate s of the columns and the angle from the narrowest gap.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grading {
    length: f64,
}

impl Grading {
    pub fn new(eccentricity: f64) -> Self {
        Self {
            length: ((1.0 - eccentricity) * (1.0 + eccentricity)).sqrt(),
        }
    }

    /// Derivative of the angle by s.
    pub fn slope(self, phi: f64) -> f64 {
        let (sin, cos) = (0.5 * phi).sin_cos();
        let narrow = self.length / ((self.length * cos).powi(2) + sin * sin);
        2.0 / (1.0 + narrow)
    }

    /// Angle at s, both from -pi to pi, by Newton kept between bounds.
    pub fn angle(self, s: f64) -> f64 {
        let target = s.abs();
        let (mut low, mut high) = (0.0, PI);
        let mut phi = target.min(target * self.slope(0.0) * 2.0);
        for _ in 0..60 {
            let (sin, cos) = (0.5 * phi).sin_cos();
            let excess = 0.5 * phi + sin.atan2(self.length * cos) - target;
            if excess > 0.0 {
                high = phi;
            } else {
                low = phi;
            }
            let next = phi - excess * self.slope(phi);
            // Bounds count as inside: round-off may put one on the angle itself.
            let next = if next >= low && next <= high {
                next
            } else {
                0.5 * (low + high)
            };
            let moved = (next - phi).abs();
            phi = next;
            // The error left is of the order of the square of the last step.
            if moved <= 1e-10 * phi {
                break;
            }
        }
        phi.copysign(s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_lie_where_the_map_says() {
        for eps in [0.0, 0.8, 0.9999] {
            let grading = Grading::new(eps);
            let of =
                |phi: f64| 0.5 * phi + (0.5 * phi).sin().atan2(grading.length * (0.5 * phi).cos());
            for k in -50..=50 {
                let s = PI * f64::from(k) / 50.0;
                let phi = grading.angle(s);
                assert!(
                    (of(phi.abs()) - s.abs()).abs() < 1e-13 && phi * s >= 0.0,
                    "{eps} {s}"
                );
                let h = 1e-7 * (1.0 - eps).sqrt();
                let rise = (of(phi.abs() + h) - of(phi.abs() - h)) / (2.0 * h);
                assert!((rise * grading.slope(phi) - 1.0).abs() < 1e-5, "{eps} {s}");
            }
        }
    }
}
