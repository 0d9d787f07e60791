//! The film of a tilting journal with its units, in the frame of the shell.
//!
//! The journal's rows are x, y and the rotations about X and Y; the film's are the centre in the
//! mid-plane and its change to the rear end, (ty, -tx) B/2: forces and moments follow by the same
//! factors, as they do the same work.

use super::answer::FilmFigures;
use super::tilted_film::{Place, TiltedFilm, TiltedForce};
use crate::bearing::Bearing;
use crate::force::{Outcome, Reaction, Tangent};
use crate::integrals::Units;
use crate::journal_state::JournalState;

/// Largest width over diameter that the fewer shapes are enough for.
const NARROW: f64 = 0.5;
/// Elements around.
const ELEMENTS: usize = 7;

/// The film for the width.
#[derive(Debug, Clone)]
pub(super) enum TiltingFilm {
    Narrow(Box<TiltedFilm<4, 14>>),
    Wide(Box<TiltedFilm<6, 14>>),
}

impl TiltingFilm {
    pub(super) fn new(width_ratio: f64) -> Self {
        let d_over_b = 1.0 / width_ratio;
        if width_ratio <= NARROW {
            Self::Narrow(Box::new(TiltedFilm::new(d_over_b, ELEMENTS)))
        } else {
            Self::Wide(Box::new(TiltedFilm::new(d_over_b, ELEMENTS)))
        }
    }

    /// Force, moment and tangent where the gap is open.
    pub(super) fn solve(
        &mut self,
        bearing: &Bearing,
        state: &JournalState,
        units: &Units,
    ) -> (Reaction, Tangent, Outcome) {
        let (c, half_width) = (units.clearance, 0.5 * bearing.width);
        // By row of the journal: row of the film and its change.
        let rows = [(0, 1.0), (1, 1.0), (3, -half_width), (2, half_width)];
        let of = |[x, y]: [f64; 2], [about_x, about_y]: [f64; 2]| {
            let mut place = [0.0; 4];
            for ((row, factor), part) in rows.into_iter().zip([x, y, about_x, about_y]) {
                place[row] = factor * part / c;
            }
            place
        };
        let (place, rate) = (
            of(state.position, state.tilt),
            of(state.velocity, state.tilt_rate),
        );
        let speed = state.mean_speed();
        let found = match self {
            Self::Narrow(film) => film.force(place, effective(rate, place, speed)),
            Self::Wide(film) => film.force(place, effective(rate, place, speed)),
        };
        let Some(TiltedForce {
            force,
            by_place,
            by_motion,
        }) = found
        else {
            return (
                Reaction::default(),
                Tangent::default(),
                Outcome::NotConverged,
            );
        };
        let unit = units.pressure * units.area * bearing.width / bearing.diameter;
        let own = rows.map(|(row, factor)| unit * factor * force[row]);
        let mut tangent = Tangent::default();
        for (r, (row, factor)) in rows.into_iter().enumerate() {
            for (q, (column, change)) in rows.into_iter().enumerate() {
                let scale = unit * factor * change / c;
                // The place moves with the speed into the effective velocity of its partner.
                let carried = if column % 2 == 0 {
                    -by_motion[row][column + 1]
                } else {
                    by_motion[row][column - 1]
                };
                tangent.by_position[r][q] = scale * (by_place[row][column] + speed * carried);
                tangent.by_rate[r][q] = scale * by_motion[row][column];
            }
        }
        let reaction = Reaction {
            film_force: [own[0], own[1]],
            film_moment: [own[2], own[3]],
            ..Reaction::default()
        };
        (reaction, tangent, Outcome::Converged)
    }

    /// Figures of the last solution.
    pub(super) fn figures(&self) -> FilmFigures {
        match self {
            Self::Narrow(film) => film.figures(),
            Self::Wide(film) => film.figures(),
        }
    }
}

/// `velocity - mean speed x centre`, in the mid-plane and for its change.
fn effective(rate: Place, place: Place, speed: f64) -> Place {
    [
        rate[0] + speed * place[1],
        rate[1] - speed * place[0],
        rate[2] + speed * place[3],
        rate[3] - speed * place[2],
    ]
}
