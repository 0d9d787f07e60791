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
