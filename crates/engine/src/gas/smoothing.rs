//! Noise out of a measured diagram, its peak left as it is.
//!
//! Question: which smooth curve runs through the noise without lowering the peak that loads bearings?
//!
//! Every point becomes the value at its angle of a parabola fitted to its neighbours within the
//! half-width `h`, weighted by `(1 - |x/h|^3)^3`, around the period: a parabola is reproduced. Then
//! `d (1 - (x/h)^2)^2` about the peak, with `d` what the fit took from it, lifts it back to its measured
//! value; what would reach above it is held just below. So value and crank angle of the peak are those
//! of the measurement.
//!
//! Limits: features narrower than about `h` go, and so does a step where the cycle closes; a peak that
//! is one spike of noise stays.
//!
//! Reference: W. S. Cleveland, J. Am. Stat. Assoc. 74 (1979) 829-836 (local fit and its weight).

use super::diagram::{DiagramError, IndicatorDiagram};

/// Fewest points under a parabola that smooths.
const FEWEST_NEIGHBOURS: usize = 5;

impl IndicatorDiagram {
    /// Smoothed over `half_width`, rad, to each side; the angles stay. A point with fewer than five
    /// points within it stays as it is.
    ///
    /// # Errors
    /// [`DiagramError::Smoothing`] where the half-width is not above 0 or above a quarter of the period.
    pub fn smoothed(&self, half_width: f64) -> Result<Self, DiagramError> {
        if !(half_width > 0.0 && half_width <= 0.25 * self.period) {
            return Err(DiagramError::Smoothing { half_width });
        }
        let n = self.points.len();
        let around = self.around(half_width);
        let mut pressures = Vec::with_capacity(n);
        let mut start = 0;
        for &[angle, pressure] in &self.points {
            while around[start][0] < angle - half_width {
                start += 1;
            }
            let window = around[start..]
                .iter()
                .take_while(|point| point[0] <= angle + half_width)
                .map(|point| [(point[0] - angle) / half_width, point[1]]);
            pressures.push(fit(window).unwrap_or(pressure).max(0.0));
        }
        self.restore_peak(&mut pressures, half_width);
        let points = self.points.iter().zip(pressures);
        Ok(Self {
            points: points
                .map(|(point, pressure)| [point[0], pressure])
                .collect(),
            period: self.period,
        })
    }

    /// The points of the period and those within `reach` beyond both its ends, ascending.
    fn around(&self, reach: f64) -> Vec<[f64; 2]> {
        let (Some(first), Some(last)) = (self.points.first(), self.points.last()) else {
            return Vec::new();
        };
        let moved = |by: f64| self.points.iter().map(move |&[angle, p]| [angle + by, p]);
        let before = moved(-self.period).filter(|point| point[0] >= first[0] - reach);
        let after = moved(self.period).filter(|point| point[0] <= last[0] + reach);
        before.chain(moved(0.0)).chain(after).collect()
    }

    /// Lifts smoothed pressures so that the peak has its value and place again.
    fn restore_peak(&self, pressures: &mut [f64], half_width: f64) {
        let [_, peak] = self.peak();
        let Some(at) = self.points.iter().position(|point| point[1] == peak) else {
            return;
        };
        let (top, lost) = (self.points[at][0], peak - pressures[at]);
        for (index, (point, pressure)) in self.points.iter().zip(pressures).enumerate() {
            let away = super::diagram::from_firing(point[0] - top, self.period) / half_width;
            if away.abs() < 1.0 {
                *pressure += lost * (1.0 - away * away).powi(2);
            }
            *pressure = if index == at {
                peak
            } else {
                pressure.min(peak.next_down())
            };
        }
    }
}

/// Value at 0 of the parabola through points (offset over the half-width, value) with tricube weights.
fn fit(points: impl Iterator<Item = [f64; 2]>) -> Option<f64> {
    let mut moments = [0.0; 5];
    let mut values = [0.0; 3];
    let mut count = 0;
    for [x, value] in points {
        let weight = (1.0 - x.abs().powi(3)).max(0.0).powi(3);
        count += usize::from(weight > 0.0);
        let mut power = weight;
        for (order, moment) in moments.iter_mut().enumerate() {
            *moment += power;
            if let Some(sum) = values.get_mut(order) {
                *sum += power * value;
            }
            power *= x;
        }
    }
    if count < FEWEST_NEIGHBOURS {
        return None;
    }
    // Normal equations of 1, x, x^2; the value at 0 is the first coefficient, by Cramer's rule.
    let [s0, s1, s2, s3, s4] = moments;
    let minors = [s2 * s4 - s3 * s3, s1 * s4 - s2 * s3, s1 * s3 - s2 * s2];
    let determinant = s0 * minors[0] - s1 * minors[1] + s2 * minors[2];
    let value = values[0] * minors[0] - values[1] * minors[1] + values[2] * minors[2];
    // Points on two angles only carry no parabola.
    (determinant > 1e-12 * s0 * s2 * s4).then(|| value / determinant)
}
