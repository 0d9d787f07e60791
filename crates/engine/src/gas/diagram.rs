//! How the pressure in a cylinder runs over its working cycle, and how an engine's speeds change it.
//!
//! Question: which absolute pressure stands over the piston at a crank angle?
//!
//! A diagram is linear between its points and periodic. An angle that stands twice is a step: before
//! it the first pressure holds, from it on the second. A measured diagram that does not close keeps
//! its step that way, at the seam of the measurement. Between speeds pressures are interpolated at
//! equal crank angle, which is again a diagram, exact on the angles of both.
//!
//! Limits: where the peaks of two speeds lie further apart than they are wide, the diagram between
//! them has two lower peaks; give diagrams at closer speeds, or one diagram and a table of peaks.

use serde::{Deserialize, Serialize};

/// Fewest points of a diagram: fewer draw no compression and expansion.
pub(crate) const FEWEST_POINTS: usize = 8;

/// Absolute gas pressure of one cylinder over its working cycle: linear between its points, periodic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IndicatorDiagram {
    /// Crank angle from the firing top dead centre, rad, ascending in one period, and absolute
    /// pressure, Pa; the first is not repeated at the end. An angle that stands twice is a step.
    pub points: Vec<[f64; 2]>,
    /// Crank angle of one working cycle, rad.
    pub period: f64,
}

/// Why a diagram or the gas of an engine is refused. Angles are crank angles, rad; rows count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DiagramError {
    /// The period is no positive number.
    #[error("the period of the indicator diagram is no positive number")]
    Period,
    /// Too few points to draw a cycle.
    #[error("the indicator diagram has {points} points, {FEWEST_POINTS} are the fewest")]
    TooFewPoints {
        /// How many there are.
        points: usize,
    },
    /// A number that is none.
    #[error("row {row} of the indicator diagram holds a number that is not finite")]
    NotFinite {
        /// Its row.
        row: usize,
    },
    /// Crank angles do not run in one direction.
    #[error("the crank angle {:.6} deg in row {row} of the indicator diagram does not follow the one before", angle.to_degrees())]
    Unsorted {
        /// The row.
        row: usize,
        /// Its angle as measured.
        angle: f64,
    },
    /// The rows do not reach around the cycle.
    #[error("the indicator diagram covers {:.3} deg of a cycle of {:.3} deg", covered.to_degrees(), period.to_degrees())]
    CoversLess {
        /// From the first row to the last.
        covered: f64,
        /// The working cycle.
        period: f64,
    },
    /// The rows run over more than one cycle.
    #[error("the indicator diagram covers {:.3} deg, more than a cycle of {:.3} deg", covered.to_degrees(), period.to_degrees())]
    CoversMore {
        /// From the first row to the last.
        covered: f64,
        /// The working cycle.
        period: f64,
    },
    /// A pressure below zero absolute.
    #[error("the pressure {:.4} bar in row {row} of the indicator diagram is below 0 absolute", pressure / 1e5)]
    BelowVacuum {
        /// The row.
        row: usize,
        /// Absolute pressure, Pa.
        pressure: f64,
    },
    /// The peak does not lie at the firing top dead centre.
    #[error("the peak of the indicator diagram lies {:.1} deg from its firing top dead centre", peak.to_degrees())]
    PeakMisplaced {
        /// Crank angle of the peak from the firing top dead centre as given, within half a period.
        peak: f64,
        /// By how much the firing top dead centre must move, in the sense of rotation, to meet the
        /// dead centre next to the peak.
        shift: f64,
    },
    /// Both ends of the cycle are too far apart to be one.
    #[error("the indicator diagram steps by {:.1} % of its range where the cycle closes", 100.0 * share)]
    Open {
        /// Step over range.
        share: f64,
    },
    /// A width of smoothing that smooths nothing or everything.
    #[error("smoothing over {:.3} deg to each side is no part of the cycle", half_width.to_degrees())]
    Smoothing {
        /// As given.
        half_width: f64,
    },
    /// No diagram, or diagrams of different cycles, or speeds that do not ascend above zero.
    #[error("the diagrams of the gas are {0}")]
    Diagrams(&'static str),
    /// The table of peak pressures is not one.
    #[error("the peak pressures of the gas are {0}")]
    Peaks(&'static str),
}

impl IndicatorDiagram {
    /// A diagram of points (crank angle from the firing top dead centre, rad; absolute pressure, Pa) in
    /// any order: angles are brought into one period and sorted. Of equal angles the order given is
    /// kept, as a step.
    ///
    /// # Errors
    /// [`DiagramError`] where the period is not positive, a number is not finite, a pressure is below 0,
    /// or there are too few points.
    pub fn new(points: Vec<[f64; 2]>, period: f64) -> Result<Self, DiagramError> {
        if !(period.is_finite() && period > 0.0) {
            return Err(DiagramError::Period);
        }
        if points.len() < FEWEST_POINTS {
            let points = points.len();
            return Err(DiagramError::TooFewPoints { points });
        }
        for (row, &[angle, pressure]) in points.iter().enumerate() {
            if !(angle.is_finite() && pressure.is_finite()) {
                return Err(DiagramError::NotFinite { row });
            }
            if pressure < 0.0 {
                return Err(DiagramError::BelowVacuum { row, pressure });
            }
        }
        let mut points = points;
        for point in &mut points {
            point[0] = wrapped(point[0], period);
        }
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Ok(Self { points, period })
    }

    /// Absolute pressure, Pa, at a crank angle from the firing top dead centre, rad, of any size. NaN
    /// where the diagram has no points.
    #[must_use]
    pub fn at(&self, cycle_angle: f64) -> f64 {
        let angle = self.in_range(cycle_angle);
        self.between(
            self.points.partition_point(|point| point[0] <= angle),
            angle,
        )
    }

    /// As [`Self::at`] just before the angle: another pressure only where there is a step.
    #[must_use]
    pub fn before(&self, cycle_angle: f64) -> f64 {
        let angle = self.in_range(cycle_angle);
        self.between(self.points.partition_point(|point| point[0] < angle), angle)
    }

    /// Pressures at many angles; fastest where they ascend.
    #[must_use]
    pub fn at_each(&self, cycle_angles: &[f64]) -> Vec<f64> {
        let mut next = 0;
        let follows = |next: usize, angle: f64| {
            (next == 0 || self.points.get(next - 1).is_some_and(|p| p[0] <= angle))
                && self.points.get(next).is_none_or(|p| angle < p[0])
        };
        cycle_angles
            .iter()
            .map(|&cycle_angle| {
                let angle = self.in_range(cycle_angle);
                if !follows(next, angle) {
                    next += 1;
                }
                if next > self.points.len() || !follows(next, angle) {
                    next = self.points.partition_point(|point| point[0] <= angle);
                }
                self.between(next, angle)
            })
            .collect()
    }

    /// The angle in the period that begins with the first point.
    fn in_range(&self, angle: f64) -> f64 {
        let first = self.points.first().map_or(0.0, |point| point[0]);
        if angle >= first && angle < first + self.period {
            return angle;
        }
        first + wrapped(angle - first, self.period)
    }

    /// Linear between the point before index `next` and that one, around the end of the period.
    fn between(&self, next: usize, angle: f64) -> f64 {
        let (Some(&first), Some(&last)) = (self.points.first(), self.points.last()) else {
            return f64::NAN;
        };
        let [a, p] = match next
            .checked_sub(1)
            .and_then(|before| self.points.get(before))
        {
            Some(&point) => point,
            None => [last[0] - self.period, last[1]],
        };
        let [b, q] = match self.points.get(next) {
            Some(&point) => point,
            None => [first[0] + self.period, first[1]],
        };
        if b > a {
            p + (q - p) * ((angle - a) / (b - a))
        } else {
            q
        }
    }

    /// Crank angle from the firing top dead centre within half a period, rad, and absolute pressure,
    /// Pa, of the highest point; the first of several.
    #[must_use]
    pub fn peak(&self) -> [f64; 2] {
        let highest = |best: [f64; 2], point: &[f64; 2]| {
            if point[1] > best[1] { *point } else { best }
        };
        let start = [0.0, f64::NEG_INFINITY];
        let [angle, pressure] = self.points.iter().fold(start, highest);
        [from_firing(angle, self.period), pressure]
    }

    /// Lowest absolute pressure, Pa.
    #[must_use]
    pub fn lowest(&self) -> f64 {
        let pressures = self.points.iter().map(|point| point[1]);
        pressures.fold(f64::INFINITY, f64::min)
    }

    /// All pressures times a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        self.mapped(|pressure| factor * pressure)
    }

    fn mapped(&self, map: impl Fn(f64) -> f64) -> Self {
        let points = self.points.iter().map(|&[angle, p]| [angle, map(p)]);
        Self {
            points: points.collect(),
            period: self.period,
        }
    }

    /// Scaled so that its peak is `peak` (absolute, Pa).
    #[must_use]
    pub fn with_peak(&self, peak: f64, scaling: PeakScaling) -> Self {
        let own = self.peak()[1];
        match scaling {
            PeakScaling::Whole => self.scaled(peak / own),
            PeakScaling::AboveCompressionStart => {
                // A quarter of a four-stroke cycle, half a turn, before firing; likewise in two strokes.
                let start = self.at(-std::f64::consts::PI).min(own);
                let factor = (peak - start) / (own - start);
                self.mapped(|p| {
                    if p > start {
                        start + factor * (p - start)
                    } else {
                        p
                    }
                })
            }
        }
    }

    /// `weight` of the other diagram, the rest of this one, at equal crank angles.
    #[must_use]
    pub fn blended(&self, other: &Self, weight: f64) -> Self {
        let angles = |diagram: &Self| diagram.points.iter().map(|point| point[0]).collect();
        let mut knots: Vec<f64> = angles(self);
        knots.extend::<Vec<f64>>(angles(other));
        knots.sort_by(f64::total_cmp);
        knots.dedup();
        let blend = |p: f64, q: f64| (1.0 - weight) * p + weight * q;
        let steps = |diagram: &Self, angle: f64| diagram.before(angle) != diagram.at(angle);
        let mut points = Vec::with_capacity(knots.len());
        for angle in knots {
            if steps(self, angle) || steps(other, angle) {
                points.push([angle, blend(self.before(angle), other.before(angle))]);
            }
            points.push([angle, blend(self.at(angle), other.at(angle))]);
        }
        Self {
            points,
            period: self.period,
        }
    }
}

/// An angle in one period from 0.
pub(crate) fn wrapped(angle: f64, period: f64) -> f64 {
    let within = angle.rem_euclid(period);
    // A tiny negative angle rounds to the whole period, which is its beginning.
    if within < period { within } else { 0.0 }
}

/// An angle within half a period about 0.
pub(crate) fn from_firing(angle: f64, period: f64) -> f64 {
    let within = wrapped(angle, period);
    if within > 0.5 * period {
        within - period
    } else {
        within
    }
}

/// How a diagram is brought to another peak pressure.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PeakScaling {
    /// Every pressure by the same factor, as scripts do; the pressures of the gas exchange move too.
    #[default]
    Whole,
    /// Pressures above that at the start of compression (the bottom dead centre before firing) by their
    /// distance from it; those below stay.
    AboveCompressionStart,
}

/// The gas of an engine over its speeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Gas {
    /// Diagrams with the speed they belong to, rad/s, ascending; one alone is for every speed. Between
    /// speeds pressures are interpolated at equal crank angle.
    pub diagrams: Vec<(f64, IndicatorDiagram)>,
    /// Peak pressure (absolute, Pa) over speed (rad/s), ascending, to which a diagram is scaled; empty:
    /// not scaled.
    pub peaks: Vec<[f64; 2]>,
}

impl Gas {
    /// One diagram for every speed.
    #[must_use]
    pub fn of(diagram: IndicatorDiagram) -> Self {
        Self {
            diagrams: vec![(0.0, diagram)],
            peaks: Vec::new(),
        }
    }

    /// The diagram at a speed, rad/s: interpolated between the speeds given, the nearest outside them,
    /// every pressure scaled by the table of peaks. No points where there is no diagram.
    #[must_use]
    pub fn diagram_at(&self, speed: f64) -> IndicatorDiagram {
        self.diagram_scaled(speed, PeakScaling::Whole)
    }

    /// As [`Self::diagram_at`] with a scaling of choice.
    #[must_use]
    pub fn diagram_scaled(&self, speed: f64, scaling: PeakScaling) -> IndicatorDiagram {
        let next = self.diagrams.partition_point(|(at, _)| *at <= speed);
        let before = next.checked_sub(1).and_then(|at| self.diagrams.get(at));
        let diagram = match (before, self.diagrams.get(next)) {
            (Some((_, diagram)), None) | (None, Some((_, diagram))) => diagram.clone(),
            (Some((a, low)), Some((b, high))) => low.blended(high, (speed - a) / (b - a)),
            (None, None) => IndicatorDiagram {
                points: Vec::new(),
                period: 0.0,
            },
        };
        match self.peak_at(speed) {
            Some(peak) => diagram.with_peak(peak, scaling),
            None => diagram,
        }
    }

    /// Peak pressure (absolute, Pa) of the table at a speed, rad/s, linear between its rows, the nearest
    /// outside them; `None` without a table.
    #[must_use]
    pub fn peak_at(&self, speed: f64) -> Option<f64> {
        let next = self.peaks.partition_point(|row| row[0] <= speed);
        let before = next.checked_sub(1).and_then(|at| self.peaks.get(at));
        match (before, self.peaks.get(next)) {
            (Some(&[a, p]), Some(&[b, q])) => Some(p + (q - p) * (speed - a) / (b - a)),
            (Some(row), None) | (None, Some(row)) => Some(row[1]),
            (None, None) => None,
        }
    }
}
