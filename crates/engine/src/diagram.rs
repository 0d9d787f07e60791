//! How the pressure in a cylinder runs over its working cycle.

use serde::{Deserialize, Serialize};

/// Absolute gas pressure of one cylinder over its working cycle: linear between its points, periodic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IndicatorDiagram {
    /// Crank angle from the firing top dead centre, rad, ascending in one period, and absolute
    /// pressure, Pa; the first is not repeated at the end.
    pub points: Vec<[f64; 2]>,
    /// Crank angle of one working cycle, rad.
    pub period: f64,
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

impl IndicatorDiagram {
    /// Absolute pressure at a cycle angle (rad from the firing top dead centre, any turn), Pa: linear
    /// between the points. Not a number without points.
    #[must_use]
    pub fn at(&self, angle: f64) -> f64 {
        let Some(&first) = self.points.first() else {
            return f64::NAN;
        };
        let within = first[0] + (angle - first[0]).rem_euclid(self.period);
        let behind = self.points.partition_point(|point| point[0] <= within);
        let from = self.points[behind.saturating_sub(1)];
        let to = match self.points.get(behind) {
            Some(&to) => to,
            None => [first[0] + self.period, first[1]],
        };
        from[1] + (within - from[0]) / (to[0] - from[0]) * (to[1] - from[1])
    }
}
