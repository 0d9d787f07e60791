//! Half a bearing for a whole one.
//!
//! A journal that stays aligned in a bearing that is its own mirror image has a film that is its own
//! mirror image too: nothing flows through the mid-plane, both ends lose alike, and no moment acts.
//! The half between one end and the mid-plane is solved; stations with half the cells cost an eighth.

use crate::bearing::Bearing;
use crate::energy::EnergyBalance;
use crate::force::{FilmSummary, Reaction, Tangent};
use crate::grid::Grid;

/// How much of a bearing its grid covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// All of it.
    Whole,
    /// From the end at z = -B/2 to the mid-plane.
    Half,
}

/// The grid's half before the mid-plane, if bearing and grid mirror each other there.
#[must_use]
pub fn half_of(bearing: &Bearing, grid: &Grid) -> Option<Grid> {
    let faces = &grid.axial_faces;
    let (first, last) = (faces[0], faces[faces.len() - 1]);
    let width = last - first;
    let is_mirrored = faces
        .iter()
        .zip(faces.iter().rev())
        .all(|(a, b)| (a + b).abs() < 1e-12 * width);
    let feeds_are_central = bearing.feeds.iter().all(|feed| feed.position == 0.0);
    let shapes_are_mirrored = bearing.bore.is_mirrored() && bearing.journal.is_mirrored();
    if !is_mirrored
        || !feeds_are_central
        || !shapes_are_mirrored
        || !grid.n_axial().is_multiple_of(2)
    {
        return None;
    }
    let mut half = faces[..=grid.n_axial() / 2].to_vec();
    if let Some(middle) = half.last_mut() {
        *middle = 0.0;
    }
    Some(Grid::from_faces(grid.around_faces.clone(), half))
}

impl Extent {
    /// Places along the axis of all cells, m, from those that are solved.
    #[must_use]
    pub fn unfold_axial(self, solved: &[f64]) -> Vec<f64> {
        let mut all = solved.to_vec();
        if self == Self::Half {
            all.extend(solved.iter().rev().map(|z| -z));
        }
        all
    }

    /// Writes `value` of each solved cell to its place and to its mirror image; `n_axial` of the
    /// solved cells.
    pub fn unfold(self, n_axial: usize, value: impl Fn(usize) -> f64, all: &mut [f64]) {
        if self == Self::Whole {
            for (k, target) in all.iter_mut().enumerate() {
                *target = value(k);
            }
            return;
        }
        for (i, line) in all.chunks_exact_mut(2 * n_axial).enumerate() {
            for j in 0..n_axial {
                let value = value(i * n_axial + j);
                line[j] = value;
                line[2 * n_axial - 1 - j] = value;
            }
        }
    }

    /// Reaction of the whole bearing.
    #[must_use]
    pub fn reaction(self, solved: Reaction) -> Reaction {
        if self == Self::Whole {
            return solved;
        }
        Reaction {
            film_force: solved.film_force.map(|f| 2.0 * f),
            film_moment: [0.0; 2],
            contact_force: solved.contact_force.map(|f| 2.0 * f),
            contact_moment: [0.0; 2],
            friction_torque_journal: 2.0 * solved.friction_torque_journal,
            friction_torque_shell: 2.0 * solved.friction_torque_shell,
        }
    }

    /// Tangent of the whole bearing; that of tilt is not to be had from a half.
    #[must_use]
    pub fn tangent(self, solved: Tangent) -> Tangent {
        if self == Self::Whole {
            return solved;
        }
        let forces = |whole: &[[f64; 4]; 4]| {
            std::array::from_fn(|row| {
                std::array::from_fn(|column| {
                    if row < 2 && column < 2 {
                        2.0 * whole[row][column]
                    } else {
                        0.0
                    }
                })
            })
        };
        Tangent {
            by_position: forces(&solved.by_position),
            by_rate: forces(&solved.by_rate),
        }
    }

    /// Flows of the whole bearing; extremes and shares are those of the half.
    #[must_use]
    pub fn flows(self, solved: FilmSummary) -> FilmSummary {
        if self == Self::Whole {
            return solved;
        }
        FilmSummary {
            side_flow: [solved.side_flow[0]; 2],
            feed_flow: 2.0 * solved.feed_flow,
            storage_rate: 2.0 * solved.storage_rate,
            contact_load: 2.0 * solved.contact_load,
            boundary_power: 2.0 * solved.boundary_power,
            ..solved
        }
    }

    /// Energy of the whole bearing.
    #[must_use]
    pub fn energy(self, solved: EnergyBalance) -> EnergyBalance {
        let images = self.images();
        EnergyBalance {
            generated: images * solved.generated,
            carried_out: images * solved.carried_out,
            returned: images * solved.returned,
            conducted: images * solved.conducted,
            unconserved: images * solved.unconserved,
        }
    }

    /// Cells of the bearing for each that is solved.
    #[must_use]
    pub fn images(self) -> f64 {
        match self {
            Self::Whole => 1.0,
            Self::Half => 2.0,
        }
    }
}
