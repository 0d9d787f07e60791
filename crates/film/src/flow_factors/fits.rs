//! The fits of Patir and Cheng, row by row of Peklenik numbers, with their continuations.

/// A value and its derivative by H.
pub(super) type Reading = (f64, f64);

/// Coefficients of all fits at one Peklenik number.
pub(super) struct Row {
    /// Peklenik number g.
    pub peklenik: f64,
    /// `phi_x = 1 - c exp(-r H)` for g <= 1, `1 + c H^-r` above.
    pub pressure: [f64; 2],
    /// Where the fit of phi_x begins.
    pub pressure_from: f64,
    /// `a H^b exp(-c H + d H^2)` up to H = 5.
    pub shear_flow: [f64; 4],
    /// `a exp(-H/4)` from there.
    pub shear_flow_far: f64,
    /// `a H^b exp(-c H + d H^2)`.
    pub difference: [f64; 4],
    /// `phi_fp = 1 - d exp(-s H)`.
    pub by_pressure: [f64; 2],
    /// Where the fit of phi_fp begins.
    pub by_pressure_from: f64,
}

/// Compact form of the table in `validation/patir-cheng`, in its order of columns.
const fn row(peklenik: f64, v: [f64; 15]) -> Row {
    Row {
        peklenik,
        pressure: [v[0], v[1]],
        pressure_from: v[2],
        shear_flow: [v[3], v[4], v[5], v[6]],
        shear_flow_far: v[7],
        difference: [v[8], v[9], v[10], v[11]],
        by_pressure: [v[12], v[13]],
        by_pressure_from: v[14],
    }
}

/// By Peklenik number. Not compared with the printed papers; what supports them stands in
/// `validation/patir-cheng/README.md`.
#[rustfmt::skip]
pub(super) const ROWS: [Row; 7] = [
    row(1.0 / 9.0, [1.48, 0.42, 1.0, 2.046, 1.12, 0.78, 0.03, 1.856, 14.1, 2.45, 2.3, 0.1, 1.51, 0.52, 1.0]),
    row(1.0 / 6.0, [1.38, 0.42, 1.0, 1.962, 1.08, 0.77, 0.03, 1.754, 13.4, 2.42, 2.3, 0.1, 1.51, 0.54, 1.0]),
    row(1.0 / 3.0, [1.18, 0.42, 0.75, 1.858, 1.01, 0.76, 0.03, 1.561, 12.3, 2.32, 2.3, 0.1, 1.47, 0.58, 1.0]),
    row(1.0, [0.9, 0.56, 0.5, 1.899, 0.98, 0.92, 0.05, 1.126, 11.1, 2.31, 2.38, 0.11, 1.4, 0.66, 0.75]),
    row(3.0, [0.225, 1.5, 0.5, 1.56, 0.85, 1.13, 0.08, 0.556, 9.8, 2.25, 2.8, 0.18, 0.98, 0.79, 0.5]),
    row(6.0, [0.52, 1.5, 0.5, 1.29, 0.62, 1.09, 0.08, 0.388, 10.1, 2.25, 2.9, 0.18, 0.97, 0.91, 0.5]),
    row(9.0, [0.87, 1.5, 0.5, 1.011, 0.54, 1.07, 0.08, 0.295, 8.7, 2.15, 2.97, 0.18, 0.73, 0.91, 0.5]),
];

/// Where the fits of shear flow and of the stress difference begin.
pub(super) const SHEAR_FROM: f64 = 0.5;
/// Share of its value at the beginning of its range that a pressure flow keeps at any overlap. Oil that
/// is dragged into contact has to leave: without it pressure there would grow beyond all bounds, as
/// the mean gap closes more slowly than a fit that is continued to zero.
pub(super) const LEAST_FLOW: f64 = 0.01;
/// Where the two formulas of shear flow are blended.
pub(super) const SHEAR_FLOW_SEAM: [f64; 2] = [4.75, 5.25];
/// Where the stress difference fades out.
pub(super) const DIFFERENCE_FADES: [f64; 2] = [6.0, 7.0];

/// phi_x of a row.
pub(super) fn pressure(k: usize, h: f64) -> Reading {
    let row = &ROWS[k];
    let from = row.pressure_from;
    if row.peklenik <= 1.0 {
        return continued(h, from, LEAST_FLOW, |h| saturating(row.pressure, h));
    }
    if h >= from {
        return longitudinal(row.pressure, h);
    }
    // rises on by what its slope makes of the length `from`: to (1 + r) times the excess there
    let (value, slope) = longitudinal(row.pressure, from);
    let rest = ((h - from) / from).exp();
    (value - slope * from * (1.0 - rest), slope * rest)
}

/// `phi_x H^3` of a row.
pub(super) fn conductance(k: usize, h: f64) -> Reading {
    let row = &ROWS[k];
    continued(h, row.pressure_from, LEAST_FLOW, |h| {
        let (value, slope) = if row.peklenik <= 1.0 {
            saturating(row.pressure, h)
        } else {
            longitudinal(row.pressure, h)
        };
        (value * h * h * h, (slope * h + 3.0 * value) * h * h)
    })
}

/// Phi_s of a row.
pub(super) fn shear_flow(k: usize, h: f64) -> Reading {
    let row = &ROWS[k];
    let [from, to] = SHEAR_FLOW_SEAM;
    let near = |h| power_exponential(row.shear_flow, h);
    if h <= from {
        return continued(h, SHEAR_FROM, 0.0, near);
    }
    let value = row.shear_flow_far * (-0.25 * h).exp();
    let far = (value, -0.25 * value);
    if h >= to {
        return far;
    }
    let (share, by_h) = step(h, from, to);
    let near = near(h);
    (
        near.0 + share * (far.0 - near.0),
        near.1 + share * (far.1 - near.1) + by_h * (far.0 - near.0),
    )
}

/// Phi_fs of a row.
pub(super) fn shear_difference(k: usize, h: f64) -> Reading {
    let [from, to] = DIFFERENCE_FADES;
    if h >= to {
        return (0.0, 0.0);
    }
    let fit = |h| power_exponential(ROWS[k].difference, h);
    if h <= from {
        return continued(h, SHEAR_FROM, 0.0, fit);
    }
    let (gone, by_h) = step(h, from, to);
    let (value, slope) = fit(h);
    (value * (1.0 - gone), slope * (1.0 - gone) - value * by_h)
}

/// phi_fp of a row.
pub(super) fn shear_by_pressure(k: usize, h: f64) -> Reading {
    let row = &ROWS[k];
    continued(h, row.by_pressure_from, 0.0, |h| {
        saturating(row.by_pressure, h)
    })
}

/// `1 - c exp(-r H)`.
fn saturating([c, r]: [f64; 2], h: f64) -> Reading {
    let short = c * (-r * h).exp();
    (1.0 - short, r * short)
}

/// `1 + c H^-r`; every r of the table is 3/2, whose root is cheap.
fn longitudinal([c, r]: [f64; 2], h: f64) -> Reading {
    let power = if r == 1.5 {
        1.0 / (h * h.sqrt())
    } else {
        h.powf(-r)
    };
    (1.0 + c * power, -r * c * power / h)
}

/// `a H^b exp(-c H + d H^2)`.
fn power_exponential([a, b, c, d]: [f64; 4], h: f64) -> Reading {
    let value = a * (b * h.ln() + h * (d * h - c)).exp();
    (value, value * (b / h - c + 2.0 * d * h))
}

/// A positive rising fit, continued below `from` as the exponential with its value and slope there
/// that falls to the share `least` of that value.
pub(super) fn continued(h: f64, from: f64, least: f64, fit: impl Fn(f64) -> Reading) -> Reading {
    if h >= from {
        return fit(h);
    }
    let (value, slope) = fit(from);
    let falls = (1.0 - least) * value;
    let rate = slope / falls;
    let left = (rate * (h - from)).exp();
    (least * value + falls * left, slope * left)
}

/// From 0 to 1 without a bend at either end.
fn step(h: f64, from: f64, to: f64) -> Reading {
    let t = (h - from) / (to - from);
    (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / (to - from))
}
