//! What does a steadily loaded, infinitely long bearing carry?
//!
//! Equation: `d/dphi(H^3 dP/dphi) = 6 dH/dphi`, `H = 1 + eps cos(phi)`, phi from the WIDEST gap in
//! the sense of rotation, pressure `p = P eta omega / psi^2` with omega the sum of both angular
//! speeds and psi the relative clearance.
//! Forces: `F1 = integral of P cos(phi)`, `F2 = integral of P sin(phi)`, both per unit of 2z/B
//! (dimensionless); the force on the journal is F1 towards the narrowest gap and F2 in the sense of
//! rotation ahead of it, so a carrying film has F1 < 0 and F2 > 0.
//! Assumptions: aligned, isoviscous, laminar, no flow along the axis; eps in (0, 1).
//! References: A. Sommerfeld, Z. Math. Phys. 50 (1904) 97; L. Gumbel, Monatsbl. Berl. Bez. VDI
//! (1914) 87; H. W. Swift, Proc. ICE 233 (1932) 267, 10.1680/imotp.1932.13239; W. Stieber, Das
//! Schwimmlager (1933). Integrals by J. F. Booker's table of journal bearing integrals, J. Basic
//! Eng. 87 (1965) 533, 10.1115/1.3650603.

use std::f64::consts::PI;

/// Scaled forces and pressure extremes of one steady infinitely long film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LongFilm {
    /// F1, 1: scaled force on the journal towards the narrowest gap (negative: away from it).
    pub force_along: f64,
    /// F2, 1: scaled force on the journal 90 degrees ahead of the narrowest gap.
    pub force_across: f64,
    /// Where the pressure film ends, rad from the widest gap; 2 pi for the full film.
    pub rupture_angle: f64,
    /// Relative film thickness where the pressure peaks, 1.
    pub peak_film_thickness: f64,
    /// Peak of the scaled pressure P, 1.
    pub peak_pressure: f64,
    /// Where it lies, rad from the widest gap.
    pub peak_angle: f64,
}

impl LongFilm {
    /// Sommerfeld number So = |F|/2 of an infinitely long bearing (F per unit of 2z/B, so
    /// `So = specific load psi^2 / (eta omega) = |F| / 2`), 1.
    #[must_use]
    pub fn sommerfeld_number(&self) -> f64 {
        0.5 * self.force_along.hypot(self.force_across)
    }

    /// Attitude angle from the load to the line of centres in the sense of rotation, rad.
    #[must_use]
    pub fn attitude_angle(&self) -> f64 {
        self.force_across.atan2(-self.force_along)
    }
}

/// Sommerfeld's pressure P at `phi` (rad from the widest gap), 1; zero at the widest gap.
#[must_use]
pub fn sommerfeld_pressure(eps: f64, phi: f64) -> f64 {
    let gap = 1.0 + eps * phi.cos();
    6.0 * eps * phi.sin() * (2.0 + eps * phi.cos()) / ((2.0 + eps * eps) * gap * gap)
}

/// Full film with tension (Sommerfeld 1904).
#[must_use]
pub fn full_sommerfeld(eps: f64) -> LongFilm {
    let square = eps * eps;
    let peak_angle = (-3.0 * eps / (2.0 + square)).acos();
    LongFilm {
        force_along: 0.0,
        force_across: 12.0 * PI * eps / ((2.0 + square) * (1.0 - square).sqrt()),
        rupture_angle: 2.0 * PI,
        peak_film_thickness: 2.0 * (1.0 - square) / (2.0 + square),
        peak_pressure: sommerfeld_pressure(eps, peak_angle),
        peak_angle,
    }
}

/// Sommerfeld's film without its tension (Gumbel 1914, half Sommerfeld).
#[must_use]
pub fn gumbel(eps: f64) -> LongFilm {
    let square = eps * eps;
    let full = full_sommerfeld(eps);
    LongFilm {
        force_along: -12.0 * square / ((2.0 + square) * (1.0 - square)),
        force_across: 0.5 * full.force_across,
        rupture_angle: PI,
        ..full
    }
}

/// Film that starts at the widest gap and ends with `P = dP/dphi = 0` (Swift 1932, Stieber 1933).
#[must_use]
pub fn swift_stieber(eps: f64) -> LongFilm {
    let rupture_angle = swift_stieber_rupture(eps);
    let gap = 1.0 + eps * rupture_angle.cos();
    let [j1, j2, _] = gap_integrals(eps, rupture_angle);
    let start = 1.0 + eps;
    // F1 = -6 int sin(phi) (1/H^2 - H2/H^3), F2 = 6 int cos(phi) (1/H^2 - H2/H^3), by parts.
    let first = (1.0 / gap - 1.0 / start) / eps;
    let second = 0.5 * (1.0 / (gap * gap) - 1.0 / (start * start)) / eps;
    let peak_angle = 2.0 * PI - rupture_angle;
    let [_, peak2, peak3] = gap_integrals(eps, peak_angle);
    LongFilm {
        force_along: -6.0 * (first - gap * second),
        force_across: 6.0 / eps * (j1 - gap * j2),
        rupture_angle,
        peak_film_thickness: gap,
        peak_pressure: 6.0 * (peak2 - gap * peak3),
        peak_angle,
    }
}

/// Rupture angle of Swift and Stieber, rad from the widest gap: root of `J2 = H J3` in
/// (pi, 3 pi/2 + eps), where the slope of the pressure vanishes together with the pressure.
#[must_use]
pub fn swift_stieber_rupture(eps: f64) -> f64 {
    let end_pressure = |phi: f64| {
        let [_, j2, j3] = gap_integrals(eps, phi);
        j2 - (1.0 + eps * phi.cos()) * j3
    };
    // At the narrowest gap the end pressure is positive, at the widest negative.
    let (mut low, mut high) = (PI, 2.0 * PI);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if end_pressure(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// `J_n = integral from 0 to phi of H^-n`, n = 1, 2, 3, through the Sommerfeld angle g.
fn gap_integrals(eps: f64, phi: f64) -> [f64; 3] {
    let root = (1.0 - eps) * (1.0 + eps);
    let turns = (phi / (2.0 * PI)).round();
    let half = 0.5 * (phi - turns * 2.0 * PI);
    let reduced = 2.0 * ((1.0 - eps).sqrt() * half.sin()).atan2((1.0 + eps).sqrt() * half.cos());
    let g = reduced + turns * 2.0 * PI;
    [
        g / root.sqrt(),
        (g - eps * g.sin()) / root.powf(1.5),
        (g * (1.0 + 0.5 * eps * eps) - 2.0 * eps * g.sin() + 0.25 * eps * eps * (2.0 * g).sin())
            / root.powf(2.5),
    ]
}
