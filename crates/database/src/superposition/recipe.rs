//! What a database of the paper's scheme is built from.

use super::Drive;
use super::centre;
use crate::axis::{Axis, Spacing};
use crate::error::DatabaseError;
use sommerfeld_film::dimensionless::DimensionlessFilm;
use sommerfeld_film::{Cavitation, Inlet};

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
    /// Cells around and along the axis of every film, multiples of 8, extrapolated from it and half as many each
    /// way, see [`sommerfeld_film::dimensionless::solve_graded`]. Films at random states have a quarter more.
    pub grid: [usize; 2],
    /// Smallest relative film thickness of the random states that the error is measured at.
    pub smallest_gap: f64,
    /// Smallest relative eccentricity of those states.
    pub smallest_eccentricity: f64,
    /// Number of random states of each drive.
    pub samples: usize,
    /// Where the random states begin.
    pub seed: u64,
    /// Error at the random states that is asked for. Nodes and cells are added where the error is until it is
    /// met, or until there are as many as a database may have.
    pub target: f64,
    /// Most films at nodes and near the centre.
    pub most_films: usize,
}

impl SuperpositionRecipe {
    /// Tilted journals; the error is measured where the smallest gap is above 0.02.
    #[must_use]
    pub fn tilted(d_over_b: f64) -> Self {
        Self {
            d_over_b,
            eccentricities: [0.01, 0.95],
            eccentricity_nodes: 21,
            largest_shares: [0.95, 0.85],
            tilt_nodes: [21, 15],
            centre_nodes: [9, 14],
            cavitation: Cavitation::Reynolds,
            wedge_inlet: Inlet::Cyclic,
            grid: [128, 32],
            smallest_gap: 0.02,
            smallest_eccentricity: 0.01,
            samples: 1000,
            seed: 1,
            target: 2e-2,
            most_films: 60_000,
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
            // Half of an aligned film is solved, and nothing is steep at its ends.
            grid: [192, 32],
            smallest_gap: 0.01,
            smallest_eccentricity: 0.02,
            samples: 200,
            target: 1e-3,
            ..Self::tilted(d_over_b)
        }
    }

    /// Nodes along eccentricity and the two shares of tilt.
    ///
    /// # Errors
    /// [`DatabaseError::Recipe`] where a value cannot be built for.
    pub(super) fn axes(&self) -> Result<[Axis; 3], DatabaseError> {
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
        if !self
            .grid
            .iter()
            .all(|cells| *cells > 0 && cells.is_multiple_of(8))
        {
            let value = format!("{:?}", self.grid);
            return Err(refused("grid", value, "multiples of 8"));
        }
        if !(self.target.is_finite() && self.target > 0.0) {
            return Err(refused(
                "target",
                format!("{}", self.target),
                "a positive number",
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
        // Where both edges are close to contact, the film of a small eccentricity turns within as much of it as is
        // left of the gap there.
        let spacing = match self.tilt_nodes {
            [1, 1] => Spacing::Atanh,
            _ => Spacing::ShiftedLogit,
        };
        let nodes = self.eccentricity_nodes;
        Ok([
            Axis::new("eccentricities", spacing, first, last, nodes)?,
            tilt("tilt share", 0)?,
            tilt("transverse share", 1)?,
        ])
    }

    /// The film of a drive at an eccentricity and tilts `[along, across]`.
    pub(super) fn film(
        &self,
        drive: Drive,
        eps: f64,
        [along, across]: [f64; 2],
    ) -> DimensionlessFilm {
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
