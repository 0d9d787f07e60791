//! In which frame does the grid stand?
//!
//! A grid fixed to the shell needs no turning. One that follows the line of centres sees the
//! journal always displaced towards its own +X. Its force depends on the position through the
//! eccentricity and through the turning of the frame, which is exact:
//!
//! ```text
//! F = T F_l(e, T^-1 v, T^-1 tilt, T^-1 tilt_rate),    T the turn by the line of centres' angle
//! dF_l/dt = (J F_l - dF_l/dv J v - dF_l/dtilt J tilt - dF_l/dtilt_rate J tilt_rate) / e
//! ```
//! with J the turn by 90 degrees and t the direction across the line of centres.

use crate::force::{Reaction, Tangent};
use crate::journal_state::JournalState;

/// Frame of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// The shell frame.
    Shell,
    /// Turned so that +X points to the narrowest gap in the mid-plane.
    LineOfCentres,
}

impl Frame {
    /// Angle by which the grid is turned against the shell frame, rad.
    #[must_use]
    pub fn turn(self, state: &JournalState) -> f64 {
        match self {
            Self::Shell => 0.0,
            Self::LineOfCentres => state.line_of_centres_angle(),
        }
    }

    /// The state as the grid sees it.
    #[must_use]
    pub fn to_grid(self, state: &JournalState, turned: f64) -> JournalState {
        match self {
            Self::Shell => *state,
            Self::LineOfCentres => JournalState {
                position: [state.eccentricity(), 0.0],
                tilt: rotate(state.tilt, -turned),
                velocity: rotate(state.velocity, -turned),
                tilt_rate: rotate(state.tilt_rate, -turned),
                ..*state
            },
        }
    }

    /// Reaction and tangent of the state `local` as the shell frame sees them.
    #[must_use]
    pub fn from_grid(
        self,
        local: &JournalState,
        turned: f64,
        reaction: Reaction,
        mut tangent: Tangent,
    ) -> (Reaction, Tangent) {
        if self == Self::Shell {
            return (reaction, tangent);
        }
        let eccentricity = local.position[0];
        if eccentricity > 0.0 {
            let across = across_line(local, &reaction, &tangent);
            for (row, value) in tangent.by_position.iter_mut().zip(across) {
                row[1] = value / eccentricity;
            }
        }
        let reaction = Reaction {
            film_force: rotate(reaction.film_force, turned),
            contact_force: rotate(reaction.contact_force, turned),
            film_moment: rotate(reaction.film_moment, turned),
            contact_moment: rotate(reaction.contact_moment, turned),
            ..reaction
        };
        let tangent = Tangent {
            by_position: rotate_matrix(&tangent.by_position, turned),
            by_rate: rotate_matrix(&tangent.by_rate, turned),
        };
        (reaction, tangent)
    }
}

/// Change of force and moment per turn of the line of centres with everything else at rest.
fn across_line(local: &JournalState, reaction: &Reaction, tangent: &Tangent) -> [f64; 4] {
    let quarter = |[x, y]: [f64; 2]| [-y, x];
    let (force, moment) = (quarter(reaction.force()), quarter(reaction.moment()));
    let (v, tilt, tilt_rate) = (
        quarter(local.velocity),
        quarter(local.tilt),
        quarter(local.tilt_rate),
    );
    let own = [force[0], force[1], moment[0], moment[1]];
    std::array::from_fn(|row| {
        let (position, rate) = (&tangent.by_position[row], &tangent.by_rate[row]);
        own[row]
            - (rate[0] * v[0] + rate[1] * v[1])
            - (position[2] * tilt[0] + position[3] * tilt[1])
            - (rate[2] * tilt_rate[0] + rate[3] * tilt_rate[1])
    })
}

/// Rotates a vector by `angle`.
#[must_use]
pub fn rotate([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// `T A T^-1` for the 2x2 blocks of a 4x4 matrix.
fn rotate_matrix(matrix: &[[f64; 4]; 4], angle: f64) -> [[f64; 4]; 4] {
    let (sin, cos) = angle.sin_cos();
    let turn = [[cos, -sin], [sin, cos]];
    std::array::from_fn(|r| {
        std::array::from_fn(|c| {
            let (row, column) = (r / 2 * 2, c / 2 * 2);
            let mut sum = 0.0;
            for a in 0..2 {
                for b in 0..2 {
                    sum += turn[r % 2][a] * matrix[row + a][column + b] * turn[c % 2][b];
                }
            }
            sum
        })
    })
}
