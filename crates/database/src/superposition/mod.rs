//! The paper's database: wedge and squeeze solved apart, stored over eccentricity and tilt, and added.
//!
//! ```text
//! F_r = K (|W| Phi_1D/eps + |eps_dot| Phi_1V)        F_t = K (+-|W| Phi_2D/eps + |eps_dot| Phi_2V)
//! M_t = K B/2 (... Theta_1 ...)                      M_r = -K B/2 (... Theta_2 ...)
//! K = eta D B/(4 psi^2)       W = eps omega_eff = eps (omega_J + omega_S) - 2 velocity across/c
//! ```
//! `Phi_1, Phi_2, Theta_1, Theta_2` are the integrals of `Pi cos(phi), Pi sin(phi), Pi Z cos(phi), Pi Z sin(phi)`
//! for the wedge (D), the eccentricity rising (V) and falling (W, in place of V where `eps_dot < 0`). The paper
//! lacks Phi_2V and Theta_2V, which a transverse tilt makes. Axes: eccentricity, and the two shares of
//! [`tilt_box`], all even in artanh of their value, so that they are even in the logarithm of the gap
//! towards contact. Interpolated by cubic splines with two continuous derivatives: the logarithm of the size of
//! `(Phi_1, Phi_2, Theta_1, Theta_2)`, the forces of the wedge over eps, and the four over that size. Near the
//! centre the wedge of a tilted journal has a table of its own over the ratios of eccentricity and tilts.
//! What it is not: forces of separately cut pressures do not add up to that of the film (tens of percent where
//! the gap closes, more where it opens), and tilt RATES make no force in this scheme: the tilt is taken to turn
//! with the line of centres. It is for comparison.
//! Source: O. Marsalek, P. Novotny, L. Drapal, V. Pistek (2012), 10.2478/v10138-012-0015-7, section 3.

mod build;
mod centre;
mod film;
mod grid;
mod stored;
pub mod tilt_box;

pub use build::Progress;
pub use film::SuperpositionFilm;
pub use grid::Looked;

use crate::axis::{Axis, Spacing};
use crate::error::DatabaseError;
use centre::Centre;
use grid::{Fitted, Shape};
use sommerfeld_film::dimensionless::DimensionlessFilm;
use sommerfeld_film::{Cavitation, Inlet};

/// What a film is driven by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// D: the surfaces drag oil into the narrowing gap.
    Wedge,
    /// V: the eccentricity rises.
    Rising,
    /// W: the eccentricity falls.
    Falling,
}

impl Drive {
    /// All, in the order in which they are stored.
    pub const ALL: [Self; 3] = [Self::Wedge, Self::Rising, Self::Falling];

    /// Letter in names of datasets, as in the paper (W is not in it).
    #[must_use]
    pub const fn letter(self) -> char {
        match self {
            Self::Wedge => 'D',
            Self::Rising => 'V',
            Self::Falling => 'W',
        }
    }

    /// Factors of the wedge and of the squeeze term.
    const fn factors(self) -> [f64; 2] {
        match self {
            Self::Wedge => [1.0, 0.0],
            Self::Rising => [0.0, 1.0],
            Self::Falling => [0.0, -1.0],
        }
    }
}

/// What a database is built from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SuperpositionRecipe {
    /// Diameter over width.
    pub d_over_b: f64,
    /// First and last relative eccentricity; beyond them the curves go on straight.
    pub eccentricities: [f64; 2],
    /// Nodes between them.
    pub eccentricity_nodes: usize,
    /// Largest shares of the tilts of [`tilt_box`], each way.
    pub largest_shares: [f64; 2],
    /// Nodes along them, odd; 1 and 1 for a database of aligned journals.
    pub tilt_nodes: [usize; 2],
    /// Films of the wedge near the centre: sizes of eccentricity and tilt together (none, or at least
    /// five), and the even degree of the polynomials over their ratios. Without them the tables err by
    /// percents where tilts are as large as the eccentricity and both are small.
    pub centre_nodes: [usize; 2],
    /// Closure of the ruptured film: `reynolds` or `gumbel`.
    pub cavitation: Cavitation,
    /// Where the film of the wedge starts. That of the squeeze is cyclic: its pressure peak may lie on
    /// the line of the widest gap.
    pub wedge_inlet: Inlet,
    /// Cells around and along the axis of every film, extrapolated from it and half the axial cells, see
    /// [`sommerfeld_film::dimensionless::solve_dimensionless`]. Films at random states have half as many
    /// again.
    pub grid: [usize; 2],
    /// Smallest relative film thickness of the random states that the error is measured at.
    pub smallest_gap: f64,
    /// Smallest relative eccentricity of those states.
    pub smallest_eccentricity: f64,
    /// Number of random states of each drive.
    pub samples: usize,
}

impl SuperpositionRecipe {
    /// Tilted journals; the error is measured where the smallest gap is above 0.02.
    #[must_use]
    pub fn tilted(d_over_b: f64) -> Self {
        Self {
            d_over_b,
            eccentricities: [0.01, 0.95],
            eccentricity_nodes: 17,
            largest_shares: [0.95, 0.85],
            tilt_nodes: [21, 15],
            centre_nodes: [9, 14],
            cavitation: Cavitation::Reynolds,
            wedge_inlet: Inlet::Cyclic,
            grid: [128, 40],
            smallest_gap: 0.02,
            smallest_eccentricity: 0.01,
            samples: 60,
        }
    }

    /// Aligned journals.
    #[must_use]
    pub fn aligned(d_over_b: f64) -> Self {
        Self {
            eccentricities: [0.02, 0.99],
            eccentricity_nodes: 25,
            largest_shares: [0.0, 0.0],
            tilt_nodes: [1, 1],
            centre_nodes: [0, 0],
            smallest_gap: 0.01,
            smallest_eccentricity: 0.02,
            samples: 40,
            ..Self::tilted(d_over_b)
        }
    }

    /// Nodes along eccentricity and the two shares of tilt.
    ///
    /// # Errors
    /// [`DatabaseError::Recipe`] where a value cannot be built for.
    fn axes(&self) -> Result<[Axis; 3], DatabaseError> {
        let refused = |key, value: String, allowed| DatabaseError::Recipe {
            key,
            value,
            allowed,
        };
        if !(self.d_over_b.is_finite() && self.d_over_b > 0.0) {
            return Err(refused(
                "d_over_b",
                format!("{}", self.d_over_b),
                "a positive number",
            ));
        }
        if self.cavitation == Cavitation::MassConserving {
            let allowed =
                "reynolds, gumbel: with mass conserved and no supply there is no film at rest";
            return Err(refused("cavitation", "mass-conserving".to_owned(), allowed));
        }
        if matches!(self.wedge_inlet, Inlet::MaxFilmLine { pressure } if pressure != 0.0) {
            let allowed = "0: forces are proportional to the motion at no other pressure";
            return Err(refused(
                "inlet_pressure",
                format!("{:?}", self.wedge_inlet),
                allowed,
            ));
        }
        if !self.eccentricities.iter().all(|eps| *eps > 0.0) {
            let allowed = "numbers above 0";
            return Err(refused(
                "eccentricities",
                format!("{:?}", self.eccentricities),
                allowed,
            ));
        }
        let [shells, degree] = self.centre_nodes;
        let is_fit = shells >= 5 && degree.is_multiple_of(2) && degree <= centre::LARGEST_DEGREE;
        if shells != 0 && !is_fit {
            let allowed = "no sizes, or at least 5, and an even degree of at most 20";
            return Err(refused(
                "centre_nodes",
                format!("{:?}", self.centre_nodes),
                allowed,
            ));
        }
        let [first, last] = self.eccentricities;
        let tilt = |key, which: usize| {
            let (count, largest) = (self.tilt_nodes[which], self.largest_shares[which]);
            if count.is_multiple_of(2) {
                return Err(refused(
                    key,
                    format!("{count} nodes"),
                    "an odd number of nodes",
                ));
            }
            if count == 1 {
                return Axis::new(key, Spacing::Linear, 0.0, 0.0, 1);
            }
            Axis::new(key, Spacing::Atanh, -largest, largest, count)
        };
        let eccentricity = (self.eccentricity_nodes, Spacing::Atanh);
        Ok([
            Axis::new(
                "eccentricities",
                eccentricity.1,
                first,
                last,
                eccentricity.0,
            )?,
            tilt("tilt share", 0)?,
            tilt("transverse share", 1)?,
        ])
    }

    /// The film of a drive at an eccentricity and tilts `[along, across]`.
    fn film(&self, drive: Drive, eps: f64, [along, across]: [f64; 2]) -> DimensionlessFilm {
        let [wedge, squeeze] = drive.factors();
        DimensionlessFilm {
            d_over_b: self.d_over_b,
            relative_eccentricity: eps,
            tilt_gamma: along / (1.0 - eps),
            tilt_delta: across,
            wedge,
            squeeze,
            cavitation: self.cavitation,
            inlet: if drive == Drive::Wedge {
                self.wedge_inlet
            } else {
                Inlet::Cyclic
            },
        }
    }
}

/// How far the looked up integrals are from those of films solved directly, at random states of a drive: the
/// larger of the error of the force vector over itself and of the moment vector over the larger of itself
/// and a tenth of the force.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Accuracy {
    /// States.
    pub samples: usize,
    /// Largest error.
    pub largest: f64,
    /// Error that 99.9 % of the states do not exceed.
    pub of_999: f64,
    /// Error that half of the states do not exceed.
    pub median: f64,
    /// Largest estimated error of a film at a node whose gap is above that of the states.
    pub node_error: f64,
}

/// Figures of all nodes, by drive.
type Nodes = [Vec<[f64; build::FIGURES]>; 3];

/// The database of one ratio of diameter over width.
#[derive(Debug, Clone)]
pub struct SuperpositionTable {
    recipe: SuperpositionRecipe,
    axes: [Axis; 3],
    /// Integrals and peak at every node, by drive.
    nodes: Nodes,
    /// Integrals and peak of the wedge near the centre.
    centre: Vec<[f64; build::FIGURES]>,
    fitted: [Fitted; 3],
    accuracy: [Accuracy; 3],
}

impl SuperpositionTable {
    /// From nodes of every drive.
    fn of(
        recipe: SuperpositionRecipe,
        nodes: Nodes,
        centre: Vec<[f64; build::FIGURES]>,
        accuracy: [Accuracy; 3],
    ) -> Result<Self, DatabaseError> {
        let axes = recipe.axes()?;
        let shape = Shape::of(&axes);
        let mut fitted = Vec::new();
        for (drive, nodes) in Drive::ALL.into_iter().zip(&nodes) {
            let near = match drive {
                Drive::Wedge => Centre::through(&recipe, &centre)?,
                _ => None,
            };
            fitted.push(Fitted::through(drive, &axes, shape, nodes, near)?);
        }
        let Ok(fitted) = <[Fitted; 3]>::try_from(fitted) else {
            return Err(DatabaseError::Unsupported {
                reason: "a database has three drives",
            });
        };
        Ok(Self {
            recipe,
            axes,
            nodes,
            centre,
            fitted,
            accuracy,
        })
    }

    /// What it was built from.
    #[must_use]
    pub fn recipe(&self) -> &SuperpositionRecipe {
        &self.recipe
    }

    /// Its error, by [`Drive::ALL`].
    #[must_use]
    pub fn accuracy(&self) -> &[Accuracy; 3] {
        &self.accuracy
    }

    /// It has tilts.
    #[must_use]
    pub fn is_tilted(&self) -> bool {
        self.recipe.tilt_nodes != [1, 1]
    }

    /// Integrals of a drive, those of the wedge over eps, at an eccentricity and tilts `[along, across]`
    /// (`gamma (1 - eps)` and `delta`) of an open gap, with their derivatives.
    #[must_use]
    pub fn lookup(&self, drive: Drive, eps: f64, tilts: [f64; 2]) -> Looked {
        self.fitted[drive as usize].lookup(&self.axes, eps, tilts)
    }
}
