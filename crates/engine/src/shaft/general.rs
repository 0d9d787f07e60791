//! A general shaft: camshaft, balancer shaft, or any other with given loads.

use crate::{Supports, Unbalance};
use serde::{Deserialize, Serialize};

/// A straight shaft on bearings with loads that repeat.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GeneralShaft {
    /// Sections from its free end, where z = 0.
    pub sections: Vec<ShaftSection>,
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// kg/m3: for its weight.
    pub density: f64,
    /// Acceleration of gravity along x and y of the frame, m/s2.
    pub gravity: [f64; 2],
    /// Axial positions of the centres of its bearings, m, ascending.
    pub bearings: Vec<f64>,
    /// What turns out of balance.
    pub unbalances: Vec<Unbalance>,
    /// Given loads.
    pub loads: Vec<ShaftLoad>,
    /// Angle of the shaft after which loads repeat, rad.
    pub period: f64,
    /// Whether its bending is followed: a hinge at each bearing otherwise.
    pub is_elastic: bool,
    /// What holds the shells.
    pub supports: Supports,
    /// Position of each bore against the common line, m; empty for bores in line.
    pub offsets: Vec<[f64; 2]>,
}

/// One section of a shaft.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ShaftSection {
    /// m.
    pub length: f64,
    /// m.
    pub diameter: f64,
    /// Bore along it, m; 0 for a solid one.
    pub bore_diameter: f64,
}

/// A load at one place of a shaft over its angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ShaftLoad {
    /// Axial position, m.
    pub axial: f64,
    /// Shaft angle (rad, ascending in one period), force on the shaft along x and y (N): linear
    /// between its rows, periodic.
    pub points: Vec<[f64; 3]>,
}
