//! Contact pressure over the gap from a measurement or another program.
//!
//! Between rows under pressure the LOGARITHM of the pressure is interpolated by cubics with the
//! slopes of Fritsch and Carlson, so that decades count alike and the pressure falls everywhere. The
//! last row is the gap where contact ends: towards it the pressure itself is a cubic that arrives at
//! zero with slope zero. Above, the pressure is zero. Below the first row it goes on linearly with
//! the slope it has there, which is the steepest end of a table that is curved as contact is. The
//! pressure is C1 in the gap and never rises with it.
//!
//! Reference: F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238; the mean of slopes is
//! that of F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300.

use crate::roughness::{FinishError, OfGap};
use serde::{Deserialize, Serialize};

/// Rows of gap and pressure with what interpolates them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Rows", into = "Rows")]
pub struct ContactTable {
    /// Gaps, m, rising.
    gaps: Vec<f64>,
    /// Pressures, Pa, falling to zero.
    pressures: Vec<f64>,
    /// ln(pressure/Pa) of all rows but the last.
    logarithms: Vec<f64>,
    /// Slopes of the logarithm at these rows, 1/m; not positive.
    slopes: Vec<f64>,
}

/// The data alone, as stored.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Rows {
    /// m.
    gaps: Vec<f64>,
    /// Pa.
    pressures: Vec<f64>,
}

impl TryFrom<Rows> for ContactTable {
    type Error = FinishError;

    fn try_from(rows: Rows) -> Result<Self, FinishError> {
        Self::new(rows.gaps, rows.pressures)
    }
}

impl From<ContactTable> for Rows {
    fn from(table: ContactTable) -> Self {
        Self {
            gaps: table.gaps,
            pressures: table.pressures,
        }
    }
}

impl ContactTable {
    /// A table of nominal gaps (m, either sign) and contact pressures (Pa, mean over the nominal area).
    ///
    /// # Errors
    /// [`FinishError`] unless there are two rows at least, all finite, the gap rises and the pressure
    /// falls from row to row, and the last pressure is zero.
    pub fn new(gaps: Vec<f64>, pressures: Vec<f64>) -> Result<Self, FinishError> {
        let n = gaps.len();
        if n < 2 || pressures.len() != n {
            return Err(FinishError::TooFewRows);
        }
        let finite = |i: &usize| gaps[*i].is_finite() && pressures[*i].is_finite();
        if let Some(i) = (0..n).find(|i| !finite(i)) {
            return Err(FinishError::NotFinite { row: i + 1 });
        }
        let ordered = |i: &usize| gaps[i - 1] < gaps[*i] && pressures[i - 1] > pressures[*i];
        if let Some(i) = (1..n).find(|i| !ordered(i)) {
            return Err(FinishError::NotMonotone { row: i + 1 });
        }
        if pressures[n - 1] != 0.0 {
            return Err(FinishError::EndsUnderPressure {
                pressure: pressures[n - 1],
            });
        }
        let logarithms: Vec<f64> = pressures[..n - 1].iter().map(|p| p.ln()).collect();
        let slopes = slopes(&gaps, &logarithms);
        Ok(Self {
            gaps,
            pressures,
            logarithms,
            slopes,
        })
    }

    /// Contact pressure, Pa, and its derivative by the gap.
    #[must_use]
    pub fn pressure(&self, gap: f64) -> OfGap {
        let last = self.gaps.len() - 1;
        // rows at or below the gap; a gap that is no number has none and comes out as none
        let below = self.gaps.partition_point(|g| *g <= gap);
        if below == 0 {
            let by_gap = self.pressures[0] * self.slopes[0];
            return OfGap {
                value: self.pressures[0] + by_gap * (gap - self.gaps[0]),
                by_gap,
            };
        }
        if below > last {
            return OfGap::default();
        }
        let i = below - 1;
        let length = self.gaps[i + 1] - self.gaps[i];
        let t = (gap - self.gaps[i]) / length;
        if below == last {
            // the same cubic to zero with slope zero, written so that round-off keeps its sign
            let (start, left) = (self.pressures[i], 1.0 - t);
            let tilt = start * (2.0 + self.slopes[i] * length);
            let value = left * left * (start + tilt * t);
            let by_t = left * (left * tilt - 2.0 * (start + tilt * t));
            return OfGap {
                value,
                by_gap: by_t / length,
            };
        }
        let (log, by_t) = cubic(
            [self.logarithms[i], self.logarithms[i + 1]],
            [self.slopes[i] * length, self.slopes[i + 1] * length],
            t,
        );
        let value = log.exp();
        OfGap {
            value,
            by_gap: value * by_t / length,
        }
    }
}

/// Monotone slopes of the logarithms at their rows.
fn slopes(gaps: &[f64], logarithms: &[f64]) -> Vec<f64> {
    let length = |i: usize| gaps[i + 1] - gaps[i];
    let secant = |i: usize| (logarithms[i + 1] - logarithms[i]) / length(i);
    let last = logarithms.len() - 1;
    let mut slopes: Vec<f64> = (0..=last)
        .map(|i| {
            if last == 0 {
                // straight to zero pressure
                -1.0 / length(0)
            } else if i == 0 {
                secant(0)
            } else if i == last {
                secant(last - 1)
            } else {
                // harmonic, weighted towards the shorter stretch
                let (before, behind) = (length(i - 1), length(i));
                let (a, b) = (2.0 * behind + before, behind + 2.0 * before);
                (a + b) / (a / secant(i - 1) + b / secant(i))
            }
        })
        .collect();
    // the closing cubic stays above zero with a slope of three secants at most
    slopes[last] = slopes[last].max(-3.0 / length(last));
    slopes
}

/// Hermite's cubic on 0 to 1 by its values and slopes at both ends: value and slope at `t`.
fn cubic([v0, v1]: [f64; 2], [s0, s1]: [f64; 2], t: f64) -> (f64, f64) {
    let rise = v1 - v0;
    let (q, c) = (3.0 * rise - 2.0 * s0 - s1, s0 + s1 - 2.0 * rise);
    (
        v0 + t * (s0 + t * (q + t * c)),
        s0 + t * (2.0 * q + 3.0 * t * c),
    )
}

#[cfg(test)]
mod tests {
    // a panic is how a test fails
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::height_integrals::F_5_2;

    const SIGMA: f64 = 0.3e-6;

    /// Rows of F_5/2 every quarter sigma, to 4 sigma; twice as close where asked for.
    fn table(per_sigma: i32) -> ContactTable {
        let n = 6 * per_sigma;
        let gaps = (0..=n).map(|i| SIGMA * (f64::from(i) / f64::from(per_sigma) - 2.0));
        let gaps: Vec<f64> = gaps.collect();
        let mut pressures: Vec<f64> = gaps.iter().map(|g| 1e8 * F_5_2.at(g / SIGMA).0).collect();
        if let Some(last) = pressures.last_mut() {
            *last = 0.0;
        }
        ContactTable::new(gaps, pressures).unwrap()
    }

    #[test]
    fn a_table_of_a_known_law_gives_it_back_better_with_more_rows() {
        let worst = |per_sigma: i32| {
            let table = table(per_sigma);
            (-190..370)
                .map(|i| f64::from(i) * 0.01)
                .map(|u| (table.pressure(u * SIGMA).value / 1e8 / F_5_2.at(u).0 - 1.0).abs())
                .fold(0.0, f64::max)
        };
        let (coarse, fine) = (worst(4), worst(8));
        // away from the last row; its own stretch, at 3e-6 of the pressure at zero gap, is cut
        assert!(coarse < 2e-2 && fine < 0.5 * coarse, "{coarse:e} {fine:e}");
    }

    #[test]
    fn pressure_falls_and_is_smooth_from_below_the_first_row_to_beyond_the_last() {
        let table = ContactTable::new(
            vec![-1e-6, -0.9e-6, 0.0, 0.1e-6, 0.11e-6, 1e-6],
            vec![1e8, 0.99e8, 1e6, 1e3, 0.999e3, 0.0],
        )
        .unwrap();
        let mut last = table.pressure(-2e-6);
        let delta = 1e-13;
        let mut largest = 0.0_f64;
        for i in -19_999..15_000 {
            // beside the rows, where the second derivative steps
            let gap = (f64::from(i) + 0.37) * 1e-10;
            let read = table.pressure(gap);
            assert!(read.value <= last.value && read.by_gap <= 0.0 && read.value >= 0.0);
            let up = table.pressure(gap + delta).value;
            let down = table.pressure(gap - delta).value;
            let difference = (up - down) / (2.0 * delta);
            // round-off of the difference, and its second order
            let bar = 1e-6 * read.by_gap.abs() + 1e-15 * read.value / delta;
            assert!(
                (difference - read.by_gap).abs() <= bar + 1e-6 * last.by_gap.abs(),
                "{gap}"
            );
            largest = largest.max(read.value);
            last = read;
        }
        for (gap, pressure) in table.gaps.iter().zip(&table.pressures) {
            assert!((table.pressure(*gap).value - pressure).abs() <= 1e-12 * pressure);
            let before = table.pressure(gap - 1e-18);
            let behind = table.pressure(gap + 1e-18);
            let scale = table.pressure(-1e-6).by_gap.abs();
            assert!((before.by_gap - behind.by_gap).abs() < 1e-9 * scale);
        }
        assert!(largest > 1e8);
        assert_eq!(table.pressure(1e-6), OfGap::default());
        assert_eq!(table.pressure(1.0), OfGap::default());
    }

    #[test]
    fn two_rows_are_a_table() {
        let table = ContactTable::new(vec![0.0, 1e-6], vec![1e6, 0.0]).unwrap();
        assert!((table.pressure(0.0).by_gap + 1e12).abs() < 1.0);
        // with both end slopes: 1 - t - t^2 + t^3
        assert!((table.pressure(0.5e-6).value - 0.375e6).abs() < 1e-6);
    }

    #[test]
    fn what_is_no_table_is_refused_with_its_row() {
        let error = |gaps: &[f64], pressures: &[f64]| {
            ContactTable::new(gaps.to_vec(), pressures.to_vec()).unwrap_err()
        };
        assert_eq!(error(&[0.0], &[0.0]), FinishError::TooFewRows);
        assert_eq!(error(&[0.0, 1.0], &[0.0]), FinishError::TooFewRows);
        let nan = error(&[0.0, f64::NAN], &[1.0, 0.0]);
        assert_eq!(nan, FinishError::NotFinite { row: 2 });
        let back = error(&[0.0, 0.0, 1.0], &[2.0, 1.0, 0.0]);
        assert_eq!(back, FinishError::NotMonotone { row: 2 });
        let flat = error(&[0.0, 1.0, 2.0], &[2.0, 1.0, 1.0]);
        assert_eq!(flat, FinishError::NotMonotone { row: 3 });
        let open = error(&[0.0, 1.0], &[2.0, 1.0]);
        assert_eq!(open, FinishError::EndsUnderPressure { pressure: 1.0 });
        let below = error(&[0.0, 1.0], &[2.0, -1.0]);
        assert_eq!(below, FinishError::EndsUnderPressure { pressure: -1.0 });
    }
}
