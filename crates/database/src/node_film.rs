//! What does a film of a table's node answer, and how far is that off?
//!
//! Films without cells answer in some milliseconds. Where they are known to be exact, away from contact,
//! one is enough. Elsewhere a second one with more of everything must agree; where it does not, or its
//! fronts do not settle, and where an opening gap bends the fronts, rings of columns (`aligned_film`), an
//! independent method and some twenty times slower, are solved to their own tolerance.
//!
//! A film without cells begins from the fronts of the one before, which leaves a trace below 3e-6 of the
//! force; so a `NodeFilm` is begun anew for every slice of a table, and answers the same there in any order
//! of the slices.

use crate::aligned_film::{AlignedFilm as Rings, FilmCase};
use crate::direction::Direction;
use sommerfeld_film::spectral::{AlignedFilm, AlignedForce, Precision};
use sommerfeld_film::{Cavitation, Outcome};

/// A film answer to a unit effective velocity, in the units of a table, and how far it may be off.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Solved {
    /// Force along and across the line of centres.
    pub force: [f64; 2],
    /// Its derivative by relative eccentricity.
    pub by_eccentricity: [f64; 2],
    /// Its derivative by the angle of the effective velocity.
    pub by_angle: [f64; 2],
    /// Largest pressure.
    pub peak: f64,
    /// Its angle from the narrowest gap, rad.
    pub peak_angle: f64,
    /// Oil leaving at each end.
    pub side_flow: f64,
    /// Share of the bearing area under pressure.
    pub full_film_share: f64,
    /// Error of the force over its size.
    pub error: f64,
    /// Whether rings of columns gave the answer.
    pub by_rings: bool,
}

/// Films of one closure and one width ratio.
pub struct NodeFilm {
    closure: Cavitation,
    width_ratio: f64,
    tolerance: f64,
    fine: Option<AlignedFilm>,
    near_contact: Option<AlignedFilm>,
    finest: Option<AlignedFilm>,
    /// Rings of the last eccentricity that asked for them.
    rings: Option<(f64, Rings)>,
}

/// Up to this relative eccentricity one film of [`Precision::Fine`] is within [`FINE_ERROR`].
const KNOWN: f64 = 0.95;
/// The same after Gumbel, whose films have no fronts to be found.
const KNOWN_GUMBEL: f64 = 0.99;
/// The same holds for these width ratios.
const KNOWN_WIDTHS: [f64; 2] = [0.2, 1.0];
/// Error of the force over its size, the trace of the film before included.
const FINE_ERROR: f64 = 2e-5;
/// Least error that is stated elsewhere: fronts across the width leave it where both films agree by chance.
const OTHER_ERROR: f64 = 4e-5;
/// Two films may differ by this many tolerances: it is the error of the one that is dropped.
const AGREEMENT: f64 = 5.0;

/// Directions, in the coordinate of tables, in which the film of an opening gap lets go of the contact: its
/// front bends so sharply across the width that both films may err alike, by [`BENT_ERROR`].
const BENT: [f64; 2] = [-0.72, -0.25];
/// Relative eccentricity from which fronts bend so.
const BENT_FROM: f64 = 0.97;
/// Error of the force over its size there.
const BENT_ERROR: f64 = 2e-4;
/// Tolerances below this are met there by rings alone.
const BENT_TOLERANCE: f64 = 1.5e-5;

impl NodeFilm {
    /// Films of these bearings; errors are below `tolerance`, or `FINE_ERROR`, if that can be had.
    #[must_use]
    pub fn new(closure: Cavitation, width_ratio: f64, tolerance: f64) -> Self {
        let film = |precision| AlignedFilm::new(closure, width_ratio, precision).ok();
        Self {
            closure,
            width_ratio,
            tolerance,
            fine: film(Precision::Fine),
            near_contact: film(Precision::NearContact),
            finest: film(Precision::Finest),
            rings: None,
        }
    }

    /// The same films, of which none knows what was solved before if `self` has not solved any.
    #[must_use]
    pub fn fresh(&self) -> Self {
        Self {
            fine: self.fine.clone(),
            near_contact: self.near_contact.clone(),
            finest: self.finest.clone(),
            rings: None,
            ..*self
        }
    }

    /// Answer to a unit effective velocity at `angle` from the line of centres at a relative eccentricity
    /// from 0 to below 1; `None` where no method settles.
    pub fn solve(&mut self, eccentricity: f64, angle: f64, tangents: bool) -> Option<Solved> {
        self.without_cells(eccentricity, angle)
            .or_else(|| self.rings(eccentricity, angle, tangents))
    }

    fn without_cells(&mut self, eccentricity: f64, angle: f64) -> Option<Solved> {
        let width_ratio = self.width_ratio;
        let [narrow, wide] = KNOWN_WIDTHS;
        // Fronts of narrow films hardly settle, and rings need few nodes across them.
        if self.closure == Cavitation::Reynolds && width_ratio < narrow {
            return None;
        }
        let known = match self.closure {
            Cavitation::Gumbel => KNOWN_GUMBEL,
            _ => KNOWN,
        };
        if eccentricity <= known && (narrow..=wide).contains(&width_ratio) {
            let solved = solve(self.fine.as_mut()?, eccentricity, angle, width_ratio)?;
            return Some(Solved {
                error: FINE_ERROR,
                ..solved
            });
        }
        let (sin, cos) = angle.sin_cos();
        let [from, to] = BENT;
        let is_bent = self.closure == Cavitation::Reynolds
            && eccentricity > BENT_FROM
            && (from..=to).contains(&Direction::new(eccentricity, cos, sin).place);
        if is_bent && self.tolerance < BENT_TOLERANCE {
            return None;
        }
        let coarse = solve(
            self.near_contact.as_mut()?,
            eccentricity,
            angle,
            width_ratio,
        )?;
        let solved = solve(self.finest.as_mut()?, eccentricity, angle, width_ratio)?;
        let [along, across] = [0, 1].map(|row| solved.force[row] - coarse.force[row]);
        let error = along.hypot(across) / solved.force[0].hypot(solved.force[1]);
        let least = if is_bent { BENT_ERROR } else { OTHER_ERROR };
        (error < AGREEMENT * self.tolerance).then_some(Solved {
            error: error.max(least),
            ..solved
        })
    }

    /// The same by rings of columns alone: what they answer does not depend on what was asked before.
    pub fn rings(&mut self, eccentricity: f64, angle: f64, tangents: bool) -> Option<Solved> {
        let case = FilmCase {
            eccentricity,
            width_ratio: self.width_ratio,
            closure: self.closure,
            line: false,
        };
        if !matches!(&self.rings, Some((known, _)) if *known == eccentricity) {
            self.rings = Some((eccentricity, Rings::new(case, self.tolerance)));
        }
        let (_, rings) = self.rings.as_mut()?;
        let found = rings.solve(angle, self.tolerance, tangents)?;
        let answer = found.answer;
        Some(Solved {
            force: answer.force,
            by_eccentricity: answer.by_eccentricity,
            by_angle: answer.by_angle,
            peak: answer.peak,
            peak_angle: answer.peak_angle,
            side_flow: answer.side_flow,
            full_film_share: answer.full_film_share,
            error: found.error,
            by_rings: true,
        })
    }
}

/// A film without cells, which counts pressure over 12 eta R^2/c^2 and motion over c.
fn solve(film: &mut AlignedFilm, eps: f64, angle: f64, width_ratio: f64) -> Option<Solved> {
    let (sin, cos) = angle.sin_cos();
    let (found, outcome) = film.force(eps, [cos, sin]).ok()?;
    if outcome != Outcome::Converged {
        return None;
    }
    let AlignedForce {
        force,
        by_eccentricity,
        by_motion,
    } = found;
    let figures = film.figures();
    let scaled = |pair: [f64; 2]| pair.map(|part| 12.0 * part);
    Some(Solved {
        force: scaled(force),
        by_eccentricity: scaled(by_eccentricity),
        by_angle: scaled(by_motion.map(|[along, across]| cos * across - sin * along)),
        peak: 12.0 * figures.peak,
        peak_angle: figures.peak_angle,
        side_flow: 0.5 * figures.end_flow / (width_ratio * width_ratio),
        full_film_share: figures.full_film_share,
        error: 0.0,
        by_rings: false,
    })
}
