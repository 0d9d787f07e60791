//! The crankshaft as an elastic body, and what holds it.

use serde::{Deserialize, Serialize};

/// How the loads of the main bearings are found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Mains {
    /// A hinge at each main: every bay between two mains is a beam on two supports.
    Determinate,
    /// An elastic crankshaft on elastic supports, through clearance and film.
    Elastic {
        /// The crankshaft.
        shape: CrankshaftShape,
        /// What holds the shells.
        supports: Supports,
        /// Position of the bore of each main against the common line, m, along x and y of the engine
        /// frame; empty for bores in line.
        offsets: Vec<[f64; 2]>,
    },
}

/// Dimensions and material of a crankshaft, as far as its bending asks for them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CrankshaftShape {
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Diameter of the main journals, m.
    pub main_diameter: f64,
    /// Length of the main journals between the webs, m.
    pub main_length: f64,
    /// Diameter of the crankpins, m.
    pub pin_diameter: f64,
    /// Length of the crankpins between the webs, m.
    pub pin_length: f64,
    /// Bores along journals and pins, m; 0 for solid ones.
    pub bore_diameter: f64,
    /// The webs.
    pub web: Web,
}

/// A crank web.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Web {
    /// A bar of rectangular section from journal to pin.
    Bar {
        /// Thickness along the crankshaft, m.
        thickness: f64,
        /// Width across the arm, m.
        width: f64,
    },
    /// Stiffnesses of the equivalent bar, from a finite-element model or a test.
    Fitted {
        /// Thickness along the crankshaft, m: it places the webs.
        thickness: f64,
        /// Bending stiffness EI in the plane of the throw, N m2.
        bending_in_plane: f64,
        /// Bending stiffness EI across the plane of the throw, N m2.
        bending_across: f64,
        /// Torsional stiffness GJ, N m2.
        torsion: f64,
    },
}

/// What holds the shells of the main bearings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Supports {
    /// Shells that do not move.
    Rigid,
    /// One stiffness for every main, none between them.
    Each {
        /// Force per displacement, N/m, engine frame, rows force x, y.
        stiffness: [[f64; 2]; 2],
        /// Moment per tilt, N m/rad, about x, y; `None`: the shell does not tilt.
        tilt_stiffness: Option<[[f64; 2]; 2]>,
    },
    /// A condensed matrix over all mains: rows and columns x, y (N/m) and tilt about x, y (N m/rad) of
    /// main 1, then of main 2, ...; symmetric, row by row.
    Matrix(Vec<f64>),
}

/// How the piston pin is held.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PinFit {
    /// Free in rod and piston: its speed follows from the friction balance of its films.
    #[default]
    Floating,
    /// Fixed in the piston: it does not turn against the piston.
    FixedInPiston,
    /// Fixed in the rod: it turns with the rod.
    FixedInRod,
    /// It turns with this share of the rod's angular speed.
    Given(f64),
}
