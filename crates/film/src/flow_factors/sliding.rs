//! phi_f, the mean of gap over local gap, in closed form.
//!
//! With z = H/3, `phi_f = (35/32) z int (1 - t^2)^3/(z + t) dt` over the heights t that leave a gap,
//! the smallest counted being e = 1/300 of three sigma. Above z = 3 the closed form loses digits
//! and the series of moments `phi_f = sum m_k z^(-2k)`, `m_k = m_(k-1) (2k - 1)/(2k + 7)`, takes over.

use super::fits::{Reading, SHEAR_FROM, continued};

/// 1/e: three sigma over the smallest gap that is counted.
const DEEPEST: f64 = 300.0;
/// Where the series takes over; the first term left out is below 1e-18.
const SERIES_FROM: f64 = 9.0;
/// Moments used.
const MOMENTS: usize = 17;

/// `m_k`, k from 0: moments of the heights over three sigma.
const M: [f64; MOMENTS] = {
    let mut m = [1.0; MOMENTS];
    let mut k = 1;
    while k < MOMENTS {
        m[k] = m[k - 1] * (2 * k - 1) as f64 / (2 * k + 7) as f64;
        k += 1;
    }
    m
};

/// phi_f, below its range continued towards zero.
pub(super) fn phi_f(h: f64) -> Reading {
    continued(h, SHEAR_FROM, 0.0, |h| {
        if h >= SERIES_FROM {
            return series(h);
        }
        let (inverse, slope) = mean_inverse(h);
        (h * inverse, inverse + h * slope)
    })
}

/// phi_f/H, below its range continued towards zero.
pub(super) fn phi_f_over_h(h: f64) -> Reading {
    continued(h, SHEAR_FROM, 0.0, |h| {
        if h >= SERIES_FROM {
            let (value, slope) = series(h);
            return (value / h, (slope - value / h) / h);
        }
        mean_inverse(h)
    })
}

/// phi_f by its moments.
fn series(h: f64) -> Reading {
    let y = 9.0 / (h * h);
    let (mut value, mut by_y) = (0.0, 0.0);
    for m in M.iter().rev() {
        by_y = by_y * y + value;
        value = value * y + m;
    }
    (value, -2.0 * y / h * by_y)
}

/// phi_f/H in closed form.
fn mean_inverse(h: f64) -> Reading {
    let z = h / 3.0;
    let inner = 1.0 - z * z;
    let cubed = inner * inner * inner;
    let by_z = -6.0 * z * inner * inner;
    let (value, slope) = if z < 1.0 {
        let log = (DEEPEST * (z + 1.0)).ln();
        let p = [-55.0, 132.0, 345.0, -160.0, -405.0, 60.0, 147.0];
        let (mut value, mut slope) = (0.0, 0.0);
        for c in p.iter().rev() {
            slope = slope * z + value;
            value = value * z + c;
        }
        (
            cubed * log + value / 60.0,
            by_z * log + cubed / (z + 1.0) + slope / 60.0,
        )
    } else {
        // at z = 1 the logarithm is infinite, what it is multiplied with is zero
        let log = ((z + 1.0) / (z - 1.0).max(f64::MIN_POSITIVE)).ln();
        let z2 = z * z;
        // (1 - z^2)^3 d(log)/dz = 2 (1 - z^2)^2
        (
            cubed * log + z / 15.0 * (66.0 + z2 * (30.0 * z2 - 80.0)),
            by_z * log + 2.0 * inner * inner + (66.0 + z2 * (150.0 * z2 - 240.0)) / 15.0,
        )
    };
    // over three sigma, and H is over one: (35/32)/3, and d/dH = (d/dz)/3
    let unit = 35.0 / 96.0;
    (unit * value, unit * slope / 3.0)
}
