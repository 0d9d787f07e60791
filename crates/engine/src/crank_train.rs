//! What an engine is: its layout, dimensions and masses. Immutable in a run.

use crate::EngineLayout;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Layout, dimensions and masses of the crank train of an engine whose cylinders are alike.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CrankTrain {
    /// Cylinders, throws and mains.
    pub layout: EngineLayout,
    /// Cylinder bore, m.
    pub bore: f64,
    /// Half the stroke of a crank without pin offset, m.
    pub crank_radius: f64,
    /// Rod length from big-end to small-end centre, m.
    pub rod_length: f64,
    /// Distance of the cylinder axis (piston pin) from the crank axis, m, towards y of a cylinder whose
    /// axis is x.
    pub pin_offset: f64,
    /// Piston with rings and pin, kg.
    pub piston_mass: f64,
    /// Connecting rod.
    pub rod: Rod,
    /// What turns with the crankshaft out of balance: pins, webs, counterweights.
    pub unbalances: Vec<Unbalance>,
    /// Absolute pressure under the pistons, Pa.
    pub crankcase_pressure: f64,
}

impl CrankTrain {
    /// Area of one piston, m2.
    #[must_use]
    pub fn piston_area(&self) -> f64 {
        0.25 * PI * self.bore * self.bore
    }

    /// Crank angle of one working cycle, rad.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.layout.strokes.period()
    }
}

/// A rigid connecting rod, symmetric about the line through its centres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rod {
    /// kg, with both bearings.
    pub mass: f64,
    /// Distance of its centre of gravity from the big-end centre, m.
    pub centre_of_gravity: f64,
    /// Moment of inertia about an axis through the centre of gravity along the crankshaft, kg m2.
    pub inertia: f64,
}

/// A mass out of balance, fixed to a shaft.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Unbalance {
    /// Axial position, m.
    pub axial: f64,
    /// Mass times distance from the axis, kg m.
    pub moment: f64,
    /// Direction at crank angle 0, rad from x of the engine frame.
    pub angle: f64,
}
