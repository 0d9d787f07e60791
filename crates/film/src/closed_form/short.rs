//! What does an infinitely short bearing carry, and how fast does a load move its journal?
//!
//! Equation: `(D/B)^2 d/dZ(H^3 dP/dZ) = 6 dH/dphi` (wedge) or `+-12 cos(phi)` (squeeze), phi from
//! the WIDEST gap, Z = 2z/B; pressure is kept on the half of the circumference where it is
//! positive. Wedge pressure `p = P eta omega / psi^2` with omega the sum of both angular speeds;
//! squeeze pressure `p = P eta |eps_dot| / psi^2`.
//! Results are divided by (B/D)^2. `F1, F2` as in [`super::infinitely_long`], integrated over Z too,
//! so that `So = |F|/4 (B/D)^2`.
//! Assumptions: aligned, isoviscous, laminar, no flow around the circumference from pressure.
//! References: G. B. DuBois, F. W. Ocvirk, NACA TN 2808 (1952) and Report 1157 (1953); J. F. Booker,
//! J. Basic Eng. 87 (1965) 537, 10.1115/1.3650602 (mobility method).

use std::f64::consts::PI;

/// Ocvirk's wedge pressure `P/(B/D)^2`, 1, at `phi` (rad from the widest gap) and relative axial
/// coordinate Z; not cut where it is negative.
#[must_use]
pub fn ocvirk_pressure(eps: f64, phi: f64, relative_axial_coordinate: f64) -> f64 {
    let gap = 1.0 + eps * phi.cos();
    3.0 * eps * phi.sin() / gap.powi(3) * (1.0 - relative_axial_coordinate.powi(2))
}

/// Angle of the wedge pressure peak, rad from the widest gap.
#[must_use]
pub fn ocvirk_peak_angle(eps: f64) -> f64 {
    if eps == 0.0 {
        return 0.5 * PI;
    }
    // d/dphi of sin(phi)/H^3 = 0: 2 eps cos^2(phi) - cos(phi) - 3 eps = 0.
    ((1.0 - (1.0 + 24.0 * eps * eps).sqrt()) / (4.0 * eps)).acos()
}

/// Wedge force `[F1, F2]/(B/D)^2`, 1 (half film).
#[must_use]
pub fn ocvirk_force(eps: f64) -> [f64; 2] {
    let root = (1.0 - eps) * (1.0 + eps);
    [
        -8.0 * eps * eps / (root * root),
        2.0 * PI * eps / root.powf(1.5),
    ]
}

/// Squeeze force `F1/(B/D)^2`, 1, of a closing gap (eps rising): negative, away from the narrowest
/// gap.
#[must_use]
pub fn squeeze_force_closing(eps: f64) -> f64 {
    let root = (1.0 - eps) * (1.0 + eps);
    let bracket = (PI - eps.acos()) * (1.0 + 2.0 * eps * eps) + 3.0 * eps * root.sqrt();
    -8.0 * bracket / root.powf(2.5)
}

/// Squeeze force `F1/(B/D)^2`, 1, of an opening gap (eps falling): positive, towards the narrowest
/// gap.
#[must_use]
pub fn squeeze_force_opening(eps: f64) -> f64 {
    let root = (1.0 - eps) * (1.0 + eps);
    let bracket = eps.acos() * (1.0 + 2.0 * eps * eps) - 3.0 * eps * root.sqrt();
    8.0 * bracket / root.powf(2.5)
}

/// Booker's closed-form mobility times (B/D)^2, 1, along the load and 90 degrees ahead of it, for
/// the relative eccentricity components `xi` along the load and `eta` 90 degrees ahead.
///
/// `d eps/dt = F psi^2 M/(viscosity B D) + mean angular speed x eps`. An approximation of the short
/// half film: 5-8 % off at eps 0.8-0.9.
#[must_use]
pub fn booker_mobility(xi: f64, eta: f64) -> [f64; 2] {
    let gap = 1.0 - xi;
    [gap.powf(2.5) / PI, -4.0 * eta * gap.powf(1.5) / (PI * PI)]
}
