//! What a bearing is: immutable data shared by every film model.

use crate::elastic::Elasticity;
use crate::finish::Finish;
use crate::shape::Shape;
use serde::{Deserialize, Serialize};

/// One slide bearing: bore, clearance, supply and the rules at its boundaries. Immutable in a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Bearing {
    /// Bore diameter, m.
    pub diameter: f64,
    /// Bearing width along the axis, m.
    pub width: f64,
    /// Radial clearance, m: half the diametral clearance.
    pub radial_clearance: f64,
    /// How the bore departs from its cylinder.
    #[serde(default)]
    pub bore: Shape,
    /// How the journal departs from its cylinder.
    #[serde(default)]
    pub journal: Shape,
    /// Grooves and holes that supply oil.
    pub feeds: Vec<Feed>,
    /// Gauge pressure at the bearing ends, Pa; not below the cavitation pressure.
    pub ambient_pressure: f64,
    /// Gauge pressure of the ruptured film, Pa.
    pub cavitation_pressure: f64,
    /// What enters at the ends.
    pub ends: Ends,
    /// Where the film starts around the circumference.
    pub inlet: Inlet,
    /// Closure for the ruptured film.
    pub cavitation: Cavitation,
    /// How the ruptured film shears.
    pub film_shear: FilmShear,
    /// Roughness of both surfaces, and what asperities carry.
    #[serde(default)]
    pub finish: Finish,
    /// How the running surface of the shell gives way.
    #[serde(default)]
    pub elasticity: Elasticity,
}

impl Bearing {
    /// Bore radius, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        0.5 * self.diameter
    }

    /// Relative clearance psi = C/D = radial clearance over radius.
    #[must_use]
    pub fn relative_clearance(&self) -> f64 {
        self.radial_clearance / self.radius()
    }

    /// Both surfaces are cylinders.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.bore.is_cylindrical() && self.journal.is_cylindrical()
    }
}

/// Closure for the ruptured film.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cavitation {
    /// Solve the full film, then cut pressures below cavitation pressure (half Sommerfeld).
    Gumbel,
    /// Complementarity `p >= p_cav` with smooth rupture (Swift-Stieber); creates oil at reformation.
    Reynolds,
    /// Jakobsson-Floberg-Olsson: film fraction transported and stored, mass conserved per cell.
    MassConserving,
}

/// Where the film starts around the circumference.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Inlet {
    /// Periodic around the full circumference.
    Cyclic,
    /// Additionally `pressure` (gauge, Pa) and a full film on the line of the widest gap, which
    /// moves with the line of centres.
    MaxFilmLine {
        /// Gauge pressure on the line, Pa.
        pressure: f64,
    },
}

/// What enters at the bearing ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ends {
    /// Air: oil may leave, none enters.
    Air,
    /// An oil bath: oil may enter and leave.
    Flooded,
}

/// How the ruptured film shears.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmShear {
    /// Shear stress of a full film everywhere.
    FullWidth,
    /// Shear stress weighted by the film fraction.
    FilmFraction,
}

/// A groove or hole that holds oil at a given pressure and is always full.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Feed {
    /// Outline on the developed surface.
    pub shape: FeedShape,
    /// Which surface carries it.
    pub carried_by: Carrier,
    /// Angle of its centre from +X of its carrier, rad.
    pub angle: f64,
    /// Axial position of its centre from the mid-plane, m.
    pub position: f64,
    /// Gauge supply pressure, Pa: where the line begins, with the head of a crank drilling.
    pub pressure: f64,
    /// What lies between supply and feed.
    #[serde(default)]
    pub line: FeedLine,
}

/// The line that brings oil to a feed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FeedLine {
    /// The supply pressure holds in the feed, whatever flows.
    #[default]
    Direct,
    /// Laminar: the pressure falls in proportion to the flow into the film.
    Resistive {
        /// Pressure drop per flow, Pa s/m3; not negative.
        resistance: f64,
    },
}

impl FeedLine {
    /// Pressure drop per flow, Pa s/m3.
    #[must_use]
    pub fn resistance(self) -> f64 {
        match self {
            Self::Direct => 0.0,
            Self::Resistive { resistance } => resistance,
        }
    }
}

/// Outline of a feed on the developed bearing surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FeedShape {
    /// Round hole.
    Hole {
        /// Diameter, m.
        diameter: f64,
    },
    /// Rectangle: an axial groove or a pocket.
    Rectangle {
        /// Length around the circumference, m.
        length: f64,
        /// Width along the axis, m.
        width: f64,
    },
    /// Groove around the whole circumference.
    Circumferential {
        /// Width along the axis, m.
        width: f64,
    },
}

/// The surface that carries a feed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Carrier {
    /// The shell.
    Shell,
    /// The journal: the feed turns with it.
    Journal,
}
