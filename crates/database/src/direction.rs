//! In which coordinates does the film of an aligned journal change evenly?
//!
//! ```text
//! w = velocity - mean speed x eccentricity        (e_dot, -eccentricity omega_eff / 2) along and across
//! H^3 operator of P = -12 (w.n)/|w|               n the unit vector from the centre to the wall
//! F = -(eta R^3 B / (2 c^3)) |w| (dissipation w^ + turn J w^)(relative eccentricity, angle of w)
//! ```
//! The effective velocity w holds wedge and squeeze together, so the film of closures that bound the
//! pressure from below is positively homogeneous in it: one angle is left, from the line of centres,
//! mirrored where it is negative. Other than (2 eps_dot, omega_eff), from which it differs by a factor eps
//! across, w says all at eps = 0 too: there the film only resists it, in every direction alike.
//!
//! Near contact the pressure changes sides while the along component falls from the across component
//! times sqrt(2 (1 - eps)) to zero and beyond; with an opening gap the film then leaves the contact
//! by powers of that ratio. So the direction is stretched by `s`, which falls with that root:
//! ```text
//! r = sqrt(1 - eps^2),    s = r/(3 - 2 r)
//! t = along / (|w| + |across|) = tan(pi/4 - angle/2),      a = asinh(t/s) / asinh(1/s)   in [-1, 1]
//! ```
//! a = 1 where the gap closes, 0 where the journal only slides, -1 where it opens. Forces are given as
//! the logarithm of their share along w, which is the dissipation and positive, and asinh of the ratio of
//! the share across to it.

/// Stretched direction with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction {
    /// Coordinate, -1 (opening) to 1 (closing).
    pub place: f64,
    /// Derivative by the angle of the effective velocity from the line of centres, where that is
    /// not negative.
    pub by_angle: f64,
    /// Derivative by the relative eccentricity.
    pub by_eccentricity: f64,
}

impl Direction {
    /// Direction of the effective velocity with the components `along` the line of centres (positive
    /// where the gap closes) and `across` it, not both zero, at a relative eccentricity from 0 to below 1.
    #[must_use]
    pub fn new(eccentricity: f64, along: f64, across: f64) -> Self {
        let per_size = 1.0 / (along * along + across * across).sqrt();
        Self::of_unit(
            &Position::new(eccentricity),
            along * per_size,
            (across * per_size).abs(),
        )
    }

    /// The same of a unit velocity whose component across is not negative.
    #[inline]
    #[must_use]
    pub(crate) fn of_unit(position: &Position, along: f64, across: f64) -> Self {
        let t = along / (1.0 + across);
        let square = position.stretch * position.stretch;
        let (root, end_root) = ((square + t * t).sqrt(), (square + 1.0).sqrt());
        let per_s = position.per_stretch;
        // asinh(t/s) over asinh(1/s), with two logarithms.
        let scale = 1.0 / ((1.0 + end_root) * per_s).ln();
        let place = (((t.abs() + root) * per_s).ln() * scale).copysign(t);
        let per_root = 1.0 / root;
        let by_s = scale * per_s * (place / end_root - t * per_root);
        Self {
            place,
            by_angle: -0.5 * (1.0 + t * t) * scale * per_root,
            by_eccentricity: by_s * position.stretch_slope,
        }
    }

    /// Angle of the effective velocity from the line of centres at a coordinate, rad, 0 to pi.
    #[must_use]
    pub fn angle(eccentricity: f64, place: f64) -> f64 {
        let s = Position::new(eccentricity).stretch;
        let t = (s * ((1.0 / s).asinh() * place).sinh()).clamp(-1.0, 1.0);
        std::f64::consts::FRAC_PI_2 - 2.0 * t.atan()
    }
}

/// What the eccentricity alone decides, with as few roots and divisions as there are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Position {
    /// `atanh` of the relative eccentricity, and its derivative by it.
    pub atanh: f64,
    pub atanh_slope: f64,
    /// The stretch s, its inverse, and its derivative by the relative eccentricity.
    stretch: f64,
    per_stretch: f64,
    stretch_slope: f64,
}

impl Position {
    /// At a relative eccentricity from 0 to below 1.
    #[inline]
    pub fn new(eccentricity: f64) -> Self {
        let root = ((1.0 - eccentricity) * (1.0 + eccentricity)).sqrt();
        let per_root = 1.0 / root;
        let rest = 3.0 - 2.0 * root;
        let per_rest = 1.0 / rest;
        Self {
            // One logarithm: exact enough, as places are sums with the node's number.
            atanh: ((1.0 + eccentricity) * per_root).ln(),
            atanh_slope: per_root * per_root,
            stretch: root * per_rest,
            per_stretch: rest * per_root,
            stretch_slope: -3.0 * eccentricity * per_root * per_rest * per_rest,
        }
    }

    /// What is odd about a direction along the line of centres bends in the coordinate as much as its slope
    /// times this, counted inwards from the end: `asinh(1/s) s^2/sqrt(1 + s^2)`, since the coordinate itself
    /// bends.
    pub fn bend(&self) -> f64 {
        let s = self.stretch;
        (1.0 / s).asinh() * s * s / (1.0 + s * s).sqrt()
    }
}

/// Logarithm of the dissipation and asinh of the turn over it, of a force `[along, across]` the line of
/// centres that answers to a unit effective velocity at `angle`, and back.
#[must_use]
pub fn to_logarithms(force: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    let dissipation = -(force[0] * cos + force[1] * sin);
    let turn = force[0] * sin - force[1] * cos;
    [dissipation.ln(), (turn / dissipation).asinh()]
}

/// Inverse of [`to_logarithms`].
#[must_use]
pub fn from_logarithms([dissipation, turn]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    let (size, turn) = (dissipation.exp(), turn.sinh());
    [size * (turn * sin - cos), -size * (sin + turn * cos)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn directions_and_angles_are_each_others_inverse() {
        for eps in [0.0, 0.3, 0.9, 0.999] {
            for k in 0..=20 {
                let angle = PI * f64::from(k) / 20.0;
                let direction = Direction::new(eps, 3.0 * angle.cos(), -3.0 * angle.sin());
                let back = Direction::angle(eps, direction.place);
                assert!((back - angle).abs() < 1e-7, "{eps} {angle} {back}");
            }
            assert!((Direction::new(eps, 1.0, 0.0).place - 1.0).abs() < 1e-14);
            assert!((Direction::new(eps, -1.0, 0.0).place + 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn derivatives_are_those_of_central_differences() {
        let place = |eps: f64, angle: f64| Direction::new(eps, angle.cos(), angle.sin()).place;
        for eps in [0.01, 0.5, 0.98] {
            for k in 1..20 {
                let angle = PI * f64::from(k) / 20.0;
                let direction = Direction::new(eps, angle.cos(), angle.sin());
                let h = 1e-6;
                let by_angle = (place(eps, angle + h) - place(eps, angle - h)) / (2.0 * h);
                let by_eps = (place(eps + h, angle) - place(eps - h, angle)) / (2.0 * h);
                assert!((by_angle - direction.by_angle).abs() < 1e-7 * (1.0 + by_angle.abs()));
                assert!((by_eps - direction.by_eccentricity).abs() < 1e-6 * (1.0 + by_eps.abs()));
            }
        }
    }

    #[test]
    fn what_is_odd_in_the_angle_bends_as_told() {
        for eps in [0.0, 0.5, 0.99] {
            // sin(angle) over the coordinate, counted inwards from a = 1.
            let h = 1e-3;
            let [at, near, far] =
                [0.0, h, 2.0 * h].map(|inwards| Direction::angle(eps, 1.0 - inwards).sin());
            let bend = (far - 2.0 * near + at) / (h * h);
            let slope = (4.0 * near - 3.0 * at - far) / (2.0 * h);
            let expected = Position::new(eps).bend();
            let third = 0.02 * (1.0 / (1.0 - eps)).ln().max(1.0).powi(2);
            assert!(
                (bend / slope - expected).abs() < third,
                "{eps} {bend} {slope} {expected}"
            );
        }
    }

    #[test]
    fn logarithms_keep_the_force() {
        for angle in [0.0, 0.4, 1.6, PI] {
            let force = [-3.0 * f64::cos(angle) + 0.2, -2.0 * f64::sin(angle)];
            let back = from_logarithms(to_logarithms(force, angle), angle);
            for (found, given) in back.iter().zip(force) {
                assert!((found - given).abs() < 1e-14);
            }
        }
    }
}
