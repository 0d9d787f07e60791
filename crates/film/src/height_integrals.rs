//! How much of a rough surface reaches beyond a plane, and how far?
//!
//! ```text
//! F_n(u) = (2 pi)^(-1/2) int_u^inf (v - u)^n exp(-v^2/2) dv        F_n' = -n F_(n-1)
//! ```
//! for n = 1, 2, 5/2: mean overlap, contact area and contact pressure of Gaussian heights. u is a
//! gap over the rms roughness, of either sign.
//!
//! Integration by parts gives `F'' = -u F' + n F`, and for `G = F exp(u^2/2)`, which falls
//! algebraically, `G'' = u G' + (n + 1) G`. The compiler steps G from its asymptotic series at u = 36
//! down to 8 and F from there to -8, in which direction the wanted solution is the dominant one, by
//! Taylor series of the differential equation, and keeps the series about the middle of each cell. Value
//! and slope are those of one polynomial per cell; cells meet to round-off. Beyond -8 follows
//! `F_n(-v) = sum binom(n, 2k) (2k-1)!! v^(n-2k)`, short of it by exp(-v^2/2).
//! Above 36, F is below 1e-283 and returned as zero.
//!
//! Reference: J. A. Greenwood, J. H. Tripp, Proc. Instn Mech. Engrs 185 (1970) 625.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI};

/// 1/sqrt(2 pi).
const FRAC_1_SQRT_TAU: f64 = 0.5 * FRAC_2_SQRT_PI * FRAC_1_SQRT_2;
/// Where the asymptotic series starts the march: its square root is exact.
const TOP: f64 = 36.0;
/// F itself is kept below, G above, and F is expanded below its negative.
const NEAR: f64 = 8.0;
/// exp(-NEAR^2/2).
const WEIGHT_AT_NEAR: f64 = 1.266_416_554_909_417_6e-14;
/// Cells of F per unit of u, and cells.
const PER_NEAR: f64 = 32.0;
const NEAR_CELLS: usize = 512;
/// Cells of G per unit of u, and cells.
const PER_FAR: f64 = 16.0;
const FAR_CELLS: usize = 448;
/// Coefficients kept per cell: the first left out contributes below 1e-15 to F and 2e-14 to its slope.
const KEPT: usize = 10;
/// Coefficients used from cell to cell.
const STEPPED: usize = 20;

/// One of the integrals, as polynomials about the middles of cells.
pub(crate) struct HeightIntegral {
    /// Twice the exponent n.
    twice_n: usize,
    /// Of F, upwards from -[`NEAR`].
    near: [[f64; KEPT]; NEAR_CELLS],
    /// Of G, upwards from [`NEAR`].
    far: [[f64; KEPT]; FAR_CELLS],
}

/// n = 1: the mean of what overlaps.
pub(crate) static F_1: HeightIntegral = HeightIntegral::new(2, FRAC_1_SQRT_TAU);
/// n = 2: real area of contact.
pub(crate) static F_2: HeightIntegral = HeightIntegral::new(4, 2.0 * FRAC_1_SQRT_TAU);
/// n = 5/2: pressure of contact.
pub(crate) static F_5_2: HeightIntegral = HeightIntegral::new(5, 15.0 / 8.0 * FRAC_1_SQRT_2);

impl HeightIntegral {
    /// Half of `twice_n` is n, `leading` is Gamma(n + 1)/sqrt(2 pi).
    const fn new(twice_n: usize, leading: f64) -> Self {
        let n = 0.5 * twice_n as f64;
        let mut far = [[0.0; KEPT]; FAR_CELLS];
        let mut near = [[0.0; KEPT]; NEAR_CELLS];
        let start = far_above(twice_n, leading);
        let (g, g_slope) = march(&mut far, TOP, PER_FAR, start, 1.0, n + 1.0);
        let start = (WEIGHT_AT_NEAR * g, WEIGHT_AT_NEAR * (g_slope - NEAR * g));
        march(&mut near, NEAR, PER_NEAR, start, -1.0, n);
        Self { twice_n, near, far }
    }

    /// F_n(u) and its derivative -n F_(n-1)(u). Not a number where u is none.
    #[inline]
    pub(crate) fn at(&self, u: f64) -> (f64, f64) {
        if u.abs() < NEAR {
            let (i, distance) = place::<NEAR_CELLS>(u + NEAR, PER_NEAR);
            polynomial(&self.near[i], distance)
        } else if u >= TOP {
            (0.0, 0.0)
        } else if u > 0.0 {
            let (i, distance) = place::<FAR_CELLS>(u - NEAR, PER_FAR);
            let (g, slope) = polynomial(&self.far[i], distance);
            let weight = (-0.5 * u * u).exp();
            (weight * g, weight * (slope - u * g))
        } else {
            self.far_below(-u)
        }
    }

    /// The expansion for deep overlap, `v = -u`.
    fn far_below(&self, v: f64) -> (f64, f64) {
        let n = 0.5 * self.twice_n as f64;
        let root = if self.twice_n.is_multiple_of(2) {
            1.0
        } else {
            v.sqrt()
        };
        let mut term = v.powi((self.twice_n / 2) as i32) * root;
        let (mut value, mut slope) = (0.0, 0.0);
        // ten terms: the smallest at v = 8
        for k in 0..10 {
            let exponent = n - f64::from(2 * k);
            value += term;
            slope -= exponent * term / v;
            term *= exponent * (exponent - 1.0) / (f64::from(2 * (k + 1)) * v * v);
        }
        (value, slope)
    }
}

/// Fills cells downwards from their upper end `top` with the solution of `f'' = sign u f' + factor f`
/// that starts there with value and slope; returns both at the lower end.
const fn march<const CELLS: usize>(
    cells: &mut [[f64; KEPT]; CELLS],
    top: f64,
    per_unit: f64,
    start: (f64, f64),
    sign: f64,
    factor: f64,
) -> (f64, f64) {
    let half = 0.5 / per_unit;
    let mut reading = start;
    let mut i = CELLS;
    while i > 0 {
        let above = top - (CELLS - i) as f64 / per_unit;
        i -= 1;
        reading = sum(&taylor(above, reading, sign, factor), -half);
        let middle = taylor(above - half, reading, sign, factor);
        let mut k = 0;
        while k < KEPT {
            cells[i][k] = middle[k];
            k += 1;
        }
        reading = sum(&middle, -half);
    }
    reading
}

/// G and its slope at [`TOP`] by the asymptotic series.
const fn far_above(twice_n: usize, leading: f64) -> (f64, f64) {
    let n = 0.5 * twice_n as f64;
    let mut term = leading;
    let mut i = 0;
    // u^-(n+1) with u = 6^2
    while i < twice_n + 2 {
        term /= 6.0;
        i += 1;
    }
    let (mut value, mut slope, mut k) = (0.0, 0.0, 0.0);
    while k < 10.0 {
        let exponent = n + 1.0 + 2.0 * k;
        value += term;
        slope -= exponent * term / TOP;
        k += 1.0;
        term *= -exponent * (exponent + 1.0) / (2.0 * k * TOP * TOP);
    }
    (value, slope)
}

/// Taylor coefficients at `at` of the solution of `f'' = sign u f' + factor f`.
const fn taylor(at: f64, reading: (f64, f64), sign: f64, factor: f64) -> [f64; STEPPED] {
    let mut a = [0.0; STEPPED];
    (a[0], a[1]) = reading;
    let mut k = 0;
    while k + 2 < STEPPED {
        let order = k as f64;
        a[k + 2] = (sign * at * (order + 1.0) * a[k + 1] + (sign * order + factor) * a[k])
            / ((order + 1.0) * (order + 2.0));
        k += 1;
    }
    a
}

/// Value and slope of a series at a distance from its middle.
const fn sum(a: &[f64; STEPPED], distance: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    let mut k = STEPPED;
    while k > 0 {
        k -= 1;
        slope = slope * distance + value;
        value = value * distance + a[k];
    }
    (value, slope)
}

/// The cell at a distance from the lower end, and how far its middle is.
#[inline]
fn place<const CELLS: usize>(from_end: f64, per_unit: f64) -> (usize, f64) {
    // 32 bits convert both ways in one instruction; round-off at the upper end may reach beyond it
    let i = ((from_end * per_unit) as i32).min(CELLS as i32 - 1);
    (i as usize, from_end - (f64::from(i) + 0.5) / per_unit)
}

/// Value and slope of a cell's polynomial: even and odd powers side by side, which halves what waits
/// for each other.
#[inline]
fn polynomial(a: &[f64; KEPT], distance: f64) -> (f64, f64) {
    let square = distance * distance;
    let (mut even, mut odd) = (a[KEPT - 2], a[KEPT - 1]);
    let (mut by_even, mut by_odd) = (0.0, 0.0);
    for pair in a[..KEPT - 2].chunks_exact(2).rev() {
        by_even = by_even * square + even;
        by_odd = by_odd * square + odd;
        even = even * square + pair[0];
        odd = odd * square + pair[1];
    }
    (
        even + distance * odd,
        odd + 2.0 * distance * (by_even + distance * by_odd),
    )
}

#[cfg(test)]
mod tests {
    // a panic is how a test fails
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// `int_0^inf t^n exp(-(t + u)^2/2 + shift) dt` over sqrt(2 pi) by the double-exponential rule
    /// `t = exp(pi/2 sinh s)`: no series, no differential equation.
    fn quadrature(n: f64, u: f64, shift: f64) -> f64 {
        const STEP: f64 = 1.0 / 256.0;
        let mut sum = 0.0;
        for i in -1200..=700 {
            let s = f64::from(i) * STEP;
            let t = (std::f64::consts::FRAC_PI_2 * s.sinh()).exp();
            let by_s = t * std::f64::consts::FRAC_PI_2 * s.cosh();
            let term = t.powf(n) * (shift - 0.5 * (t + u) * (t + u)).exp() * by_s;
            if term.is_finite() {
                sum += term;
            }
        }
        sum * STEP * FRAC_1_SQRT_TAU
    }

    const ALL: [(&HeightIntegral, f64); 3] = [(&F_1, 1.0), (&F_2, 2.0), (&F_5_2, 2.5)];

    #[test]
    fn integrals_and_slopes_agree_with_quadrature_to_1e_12() {
        let mut worst = [0.0_f64; 2];
        for (integral, n) in ALL {
            for i in -200..720 {
                let u = f64::from(i) * 0.05 + 0.0037;
                // scaled alike, so that 1e-283 is compared to as many digits
                let shift = if u > 0.0 { 0.5 * u * u } else { 0.0 };
                let (value, slope) = integral.at(u);
                let want = [quadrature(n, u, shift), -n * quadrature(n - 1.0, u, shift)];
                for ((got, want), worst) in [value, slope].iter().zip(want).zip(&mut worst) {
                    let error = (got * shift.exp() / want - 1.0).abs();
                    assert!(
                        error < 1e-12,
                        "n {n}, u {u}: {got}, {want} scaled, {error:e}"
                    );
                    *worst = worst.max(error);
                }
            }
        }
        println!(
            "worst relative error of F {:e}, of its slope {:e}",
            worst[0], worst[1]
        );
    }

    #[test]
    fn cells_and_ranges_meet_to_round_off() {
        for (integral, n) in ALL {
            for i in -(9 * 32)..36 * 32 {
                let edge = f64::from(i) / 32.0;
                // one step of round-off aside; exp(-u^2/2) itself varies by u times that
                let (before, behind) = (integral.at(edge.next_down()), integral.at(edge));
                let allowed = 1e-12;
                for (a, b) in [(before.0, behind.0), (before.1, behind.1)] {
                    assert!(
                        (a / b - 1.0).abs() < allowed,
                        "n {n}, u {edge}: {a:e}, {b:e}"
                    );
                }
            }
        }
    }

    #[test]
    fn integrals_fall_from_any_overlap_to_exactly_nothing() {
        for (integral, n) in ALL {
            let mut last = f64::INFINITY;
            for i in -20_000..4000 {
                let (value, slope) = integral.at(f64::from(i) * 0.01);
                assert!(value <= last && slope <= 0.0, "n {n} at {i}");
                last = value;
            }
            assert_eq!(integral.at(36.0), (0.0, 0.0));
            assert_eq!(integral.at(f64::INFINITY), (0.0, 0.0));
            assert!(integral.at(35.99).0 < 1e-280);
            // far in, the heights do not matter: F_n(-v) = v^n
            assert!((integral.at(-1e6).0 / 1e6_f64.powf(n) - 1.0).abs() < 1e-11);
            assert!(integral.at(f64::NAN).0.is_nan());
        }
    }

    #[test]
    fn slopes_are_those_of_the_values() {
        for (integral, n) in ALL {
            for i in -1200..1200 {
                let u = f64::from(i) * 0.01 + 0.003;
                // fourth order: error 4 delta^4 f^(5)/120
                let delta = 1e-3;
                let f = |k: f64| integral.at(u + k * delta).0;
                let difference = (8.0 * (f(1.0) - f(-1.0)) - (f(2.0) - f(-2.0))) / (12.0 * delta);
                let slope = integral.at(u).1;
                assert!(
                    (slope / difference - 1.0).abs() < 1e-7,
                    "n {n}, u {u}: {slope:e}"
                );
            }
        }
    }

    /// `validation/greenwood-tripp`: u, then F_0, F_1/2, F_1, F_3/2, F_2, F_5/2 and two published fits.
    #[test]
    fn integrals_agree_with_the_reference_rows() {
        let table = include_str!("../../../validation/greenwood-tripp/reference.csv");
        let mut rows = 0;
        for line in table.lines().filter(|l| !l.starts_with('#')).skip(1) {
            let row: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
            let u = row[0];
            let (f_1, by_f_1) = F_1.at(u);
            let (f_2, by_f_2) = F_2.at(u);
            let (f_5_2, by_f_5_2) = F_5_2.at(u);
            let f_3_2 = -by_f_5_2 / 2.5;
            // n F_(n-2) (n-1) = n F_n - n u F_(n-1), from parts
            let f_1_2 = (f_5_2 + u * f_3_2) / 1.5;
            let got = [-by_f_1, f_1_2, f_1, f_3_2, f_2, f_5_2, -by_f_2 / 2.0];
            let want = [row[1], row[2], row[3], row[4], row[5], row[6], row[3]];
            for (got, want) in got.iter().zip(want) {
                assert!((got / want - 1.0).abs() < 1e-6, "{line}: {got}, bar 1e-6");
            }
            rows += 1;
        }
        assert_eq!(rows, 19);
    }

    #[test]
    fn the_usual_power_law_for_contact_pressure_is_far_off_where_it_matters() {
        let power_law = |u: f64| 4.4086e-5 * (4.0 - u).powf(6.804);
        let off = |u: f64| power_law(u) / F_5_2.at(u).0 - 1.0;
        assert!((off(0.0) + 0.1073).abs() < 1e-3, "{}", off(0.0));
        assert!((off(3.0) + 0.7420).abs() < 1e-3, "{}", off(3.0));
    }
}
