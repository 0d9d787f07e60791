//! From the rows of an indicated cylinder to a diagram that a crank train can use.
//!
//! Question: what do measured crank angles and pressures mean, and are they one plausible cycle?
//!
//! `angle from firing = sense (angle + shift - firing dead centre)`, `absolute = gauge + ambient`.
//! A measurement never closes exactly: its first and last pressure, one cycle apart, differ by drift
//! and by the scatter of cycles. That step is reported; it is kept where it is, or shared out over the
//! cycle by a straight line that leaves the middle of the rows alone.
//!
//! Limits: one cycle, or the mean of many; the thermodynamic loss angle between the peak of a motored
//! diagram and the dead centre is for the shift to correct.

use super::diagram::{DiagramError, FEWEST_POINTS, IndicatorDiagram};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI};

/// The way from the last row around to the first may be this many median steps of the rows.
const CLOSING_STEPS: f64 = 1.5;
/// Share of the period that round-off in a file may add to a cycle.
const PERIOD_SLACK: f64 = 1e-6;
/// A step above this share of the range is no cycle that closes.
const OPEN: f64 = 0.1;
/// A peak further than this from the firing top dead centre is no combustion there, rad.
const FARTHEST_PEAK: f64 = FRAC_PI_2;

/// What crank angles and pressures of a measurement mean.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Convention {
    /// Crank angle of one working cycle, rad.
    pub period: f64,
    /// Angle of the firing top dead centre in the rows, rad, after the shift; any whole number of
    /// periods more is the same.
    pub firing_tdc: f64,
    /// Added to every angle of the rows, rad: what an encoder reads too low.
    pub shift: f64,
    /// Ambient pressure, Pa, added to gauge pressures; `None` where the rows are absolute.
    pub gauge_ambient: Option<f64>,
    /// Which way the angles count.
    pub sense: Sense,
    /// What becomes of the step where the cycle closes.
    pub seam: Seam,
}

impl Convention {
    /// Absolute pressures over angles that count with the rotation; a step is kept.
    #[must_use]
    pub const fn absolute(period: f64, firing_tdc: f64) -> Self {
        Self {
            period,
            firing_tdc,
            shift: 0.0,
            gauge_ambient: None,
            sense: Sense::Along,
            seam: Seam::Keep,
        }
    }

    fn angle_after_firing(&self, angle: f64) -> f64 {
        let along = angle + self.shift - self.firing_tdc;
        match self.sense {
            Sense::Along => along,
            Sense::Against => -along,
        }
    }
}

/// Which way the angles of a measurement count.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sense {
    /// They grow as the crankshaft turns.
    #[default]
    Along,
    /// They fall as the crankshaft turns.
    Against,
}

/// What becomes of the step where a measured cycle closes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Seam {
    /// It stays where it is.
    #[default]
    Keep,
    /// A straight line over the cycle takes it out, half at either end.
    Distribute,
}

/// How far a measured cycle is from closing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closure {
    /// Step from the end of the cycle to its beginning, Pa: first pressure less last, less what the
    /// slopes there explain if the rows do not reach around.
    pub step: f64,
    /// Its size over the range of the pressures.
    pub share: f64,
}

impl IndicatorDiagram {
    /// The diagram of measured rows (angle, rad; pressure, Pa), and how far the measurement is from
    /// closing. Angles start anywhere; the last row may lie one period from the first.
    ///
    /// # Errors
    /// [`DiagramError`] where the rows are no plausible cycle: not finite, not in order, less or more
    /// than a period, below 0 absolute, open, or with their peak further than 90 deg from firing.
    pub fn from_measured(
        rows: &[[f64; 2]],
        convention: &Convention,
    ) -> Result<(Self, Closure), DiagramError> {
        let period = convention.period;
        if !(period.is_finite() && period > 0.0) {
            return Err(DiagramError::Period);
        }
        if rows.len() < FEWEST_POINTS {
            let points = rows.len();
            return Err(DiagramError::TooFewPoints { points });
        }
        let ambient = convention.gauge_ambient.unwrap_or(0.0);
        let mut points = Vec::with_capacity(rows.len());
        for (row, &[angle, pressure]) in rows.iter().enumerate() {
            let point = [convention.angle_after_firing(angle), pressure + ambient];
            check_row(row, angle, point, points.last())?;
            points.push(point);
        }
        let closes_itself = check_coverage(&points, period)?;
        let closure = closing(&points, period);
        if closure.share > OPEN {
            return Err(DiagramError::Open {
                share: closure.share,
            });
        }
        if convention.seam == Seam::Distribute {
            let start = points[0][0];
            for point in &mut points {
                point[1] += closure.step * ((point[0] - start) / period - 0.5);
            }
        }
        if closes_itself {
            close(&mut points, convention.seam);
        }
        let diagram = Self::new(points, period)?;
        check_peak(&diagram)?;
        Ok((diagram, closure))
    }
}

fn check_row(
    row: usize,
    angle: f64,
    point: [f64; 2],
    before: Option<&[f64; 2]>,
) -> Result<(), DiagramError> {
    let [from_firing, pressure] = point;
    if !(from_firing.is_finite() && pressure.is_finite()) {
        return Err(DiagramError::NotFinite { row });
    }
    if before.is_some_and(|before| from_firing <= before[0]) {
        return Err(DiagramError::Unsorted { row, angle });
    }
    if pressure < 0.0 {
        return Err(DiagramError::BelowVacuum { row, pressure });
    }
    Ok(())
}

/// The rows reach around the cycle, once; true where the last one lies a whole period from the first.
fn check_coverage(points: &[[f64; 2]], period: f64) -> Result<bool, DiagramError> {
    let covered = points[points.len() - 1][0] - points[0][0];
    let slack = PERIOD_SLACK * period;
    if covered > period + slack {
        return Err(DiagramError::CoversMore { covered, period });
    }
    let mut steps: Vec<f64> = points
        .windows(2)
        .map(|pair| pair[1][0] - pair[0][0])
        .collect();
    steps.sort_by(f64::total_cmp);
    let median = steps[steps.len() / 2];
    if period - covered > CLOSING_STEPS * median + slack {
        return Err(DiagramError::CoversLess { covered, period });
    }
    Ok(covered > period - slack)
}

/// The step from the last row around to the first, less what the mean slope beside it explains.
fn closing(points: &[[f64; 2]], period: f64) -> Closure {
    let (first, last) = (points[0], points[points.len() - 1]);
    let slope = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]) / (b[0] - a[0]);
    let mean = 0.5 * (slope(first, points[1]) + slope(points[points.len() - 2], last));
    let way = (first[0] + period - last[0]).max(0.0);
    let step = first[1] - last[1] - mean * way;
    let pressures = || points.iter().map(|point| point[1]);
    let range = pressures().fold(0.0, f64::max) - pressures().fold(f64::INFINITY, f64::min);
    let share = if range > 0.0 { step.abs() / range } else { 0.0 };
    Closure { step, share }
}

/// The last row lies where the first one does: it goes, or stands before it as the foot of a step.
fn close(points: &mut Vec<[f64; 2]>, seam: Seam) {
    let Some(last) = points.pop() else { return };
    let first = points[0];
    if seam == Seam::Keep && last[1] != first[1] {
        points.insert(0, [first[0], last[1]]);
    }
}

fn check_peak(diagram: &IndicatorDiagram) -> Result<(), DiagramError> {
    let [peak, _] = diagram.peak();
    if peak.abs() > FARTHEST_PEAK {
        let shift = PI * (peak / PI).round();
        return Err(DiagramError::PeakMisplaced { peak, shift });
    }
    Ok(())
}
