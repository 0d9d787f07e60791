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

mod accuracy;
mod build;
mod centre;
mod film;
mod grid;
mod recipe;
mod refine;
mod stored;
pub mod tilt_box;

pub use accuracy::Accuracy;
pub use build::Progress;
pub use film::SuperpositionFilm;
pub use grid::Looked;
pub use recipe::SuperpositionRecipe;

use crate::axis::Axis;
use crate::error::DatabaseError;
use centre::Centre;
use grid::{Fitted, Places, Shape, Spot};
use sommerfeld_film::Outcome;

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

/// Figures of all nodes, by drive.
type Nodes = [Vec<[f64; build::FIGURES]>; 3];

/// The database of one ratio of diameter over width.
#[derive(Debug, Clone)]
pub struct SuperpositionTable {
    recipe: SuperpositionRecipe,
    axes: [Axis; 3],
    /// Where values lie on them, quickly.
    places: Places,
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
            places: Places::of(&axes),
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

    /// Whether the random states of its generation err by no more than its recipe asks for.
    #[must_use]
    pub fn outcome(&self) -> Outcome {
        let is_met = |a: &Accuracy| a.samples > 0 && a.largest <= self.recipe.target;
        match self.accuracy.iter().all(is_met) {
            true => Outcome::Converged,
            false => Outcome::NotConverged,
        }
    }

    /// Largest error of all drives at the random states of its generation.
    #[must_use]
    pub fn largest_error(&self) -> f64 {
        self.accuracy.iter().map(|a| a.largest).fold(0.0, f64::max)
    }

    /// Integrals of a drive, those of the wedge over eps, at an eccentricity and tilts `[along, across]`
    /// (`gamma (1 - eps)` and `delta`) of an open gap, with their derivatives.
    #[must_use]
    pub fn lookup(&self, drive: Drive, eps: f64, tilts: [f64; 2]) -> Looked {
        let asks_peak = true;
        self.at(drive, &self.spot(eps, tilts), asks_peak)
    }

    /// Where a state lies, the same for all drives.
    fn spot(&self, eps: f64, tilts: [f64; 2]) -> Spot {
        Spot::new(&self.places, eps, tilts)
    }

    /// The same with the transverse tilt turned round.
    fn mirrored(&self, spot: &Spot) -> Spot {
        spot.mirrored(&self.places)
    }

    fn at(&self, drive: Drive, spot: &Spot, asks_peak: bool) -> Looked {
        self.fitted[drive as usize].lookup(spot, asks_peak)
    }
}
