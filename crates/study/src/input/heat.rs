//! Where the temperature of the film comes from.

use sommerfeld_bearing::{Expansion, HeatPath};

/// Where the temperature of the film comes from.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum HeatPlan {
    /// It is given; so is the warm clearance.
    #[default]
    Given,
    /// One effective temperature, at which power and what carries it away agree.
    Balance {
        /// How heat leaves the bearing.
        path: HeatPath,
        /// How the clearance follows the temperature; `None`: the warm clearance is given.
        expansion: Option<Expansion>,
    },
    /// A temperature at every place of the film.
    Field {
        /// How heat leaves the bearing.
        path: HeatPath,
        /// How heat leaves the film.
        wall: Wall,
        /// How the clearance follows the temperature; `None`: the warm clearance is given.
        expansion: Option<Expansion>,
    },
}

/// What the film gives to the surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Heat to both surfaces together per area and difference of temperatures, W/(m2 K); 0: none.
    pub coefficient: f64,
    /// Temperature of the surfaces, K.
    pub temperature: f64,
}

impl HeatPlan {
    /// As in the study file.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::Balance { .. } => "balance",
            Self::Field { .. } => "field",
        }
    }

    /// How heat leaves the bearing, where it is asked.
    #[must_use]
    pub const fn path(&self) -> Option<&HeatPath> {
        match self {
            Self::Given => None,
            Self::Balance { path, .. } | Self::Field { path, .. } => Some(path),
        }
    }

    /// How the clearance follows the temperature.
    #[must_use]
    pub const fn expansion(&self) -> Option<&Expansion> {
        match self {
            Self::Given => None,
            Self::Balance { expansion, .. } | Self::Field { expansion, .. } => expansion.as_ref(),
        }
    }
}
