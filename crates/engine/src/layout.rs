//! Which cylinder works on which throw, and when it fires.

use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Cylinders, throws and main bearings of an engine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EngineLayout {
    /// Cylinders, numbered from the free end.
    pub cylinders: Vec<Cylinder>,
    /// Throws in ascending axial position; two rods may share one.
    pub throws: Vec<Throw>,
    /// Axial positions of the centres of the main bearings, m, ascending.
    pub mains: Vec<f64>,
    /// Strokes of a working cycle.
    pub strokes: Strokes,
}

/// One cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Cylinder {
    /// Index of its throw.
    pub throw: usize,
    /// Angle of the cylinder axis from x of the engine frame, rad, positive about z.
    pub bank_angle: f64,
    /// Crank angle of its firing top dead centre, rad, in one period; 0 for cylinder 1.
    pub firing_angle: f64,
    /// Axial position of the cylinder axis and of its rod, m.
    pub axial: f64,
}

/// One throw of the crankshaft.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Throw {
    /// Direction of its arm at crank angle 0, rad from x of the engine frame.
    pub angle: f64,
    /// Axial position of the centre of its pin, m.
    pub axial: f64,
}

/// Strokes of a working cycle.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strokes {
    /// One cycle in one turn.
    Two,
    /// One cycle in two turns.
    #[default]
    Four,
}

impl Strokes {
    /// Crank angle of one working cycle, rad.
    #[must_use]
    pub fn period(self) -> f64 {
        match self {
            Self::Two => TAU,
            Self::Four => 2.0 * TAU,
        }
    }
}
