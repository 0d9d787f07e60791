//! What does the film of an aligned journal answer, to a small error that is known?
//!
//! The dimensionless problem of `direction`, solved on rings of columns around the bearing (second
//! order) with spectral nodes across the width, by active sets for `reynolds` and one linear solve,
//! cut, for `gumbel`. Two rings are extrapolated to their limit (Richardson), which two more must
//! confirm. The nodes across the width are chosen on the film without rupture, whose error no set
//! disturbs.
//! Films without cells (`sommerfeld_film::spectral`) are some twenty times faster; rings are the method that
//! shares nothing with them: they answer where those are not exact enough (`node_film`), and for some of
//! the states of every check.
//!
//! Limits: aligned, rigid, isoviscous, no feeds, ends and ruptured film at the same pressure.
//! References: numerics of the film as `sommerfeld-film`, which this agrees with in the tests; across
//! the width C. Canuto et al., Spectral Methods, Springer 2006.

mod columns;
mod grading;
mod lobatto;
mod ring;

pub use columns::{Answer, FilmCase};
use columns::{Columns, Rings, full_forces};

/// A film answer and how far it may be off.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Solved {
    /// Limit of the rings; derivatives are those of the finest one.
    pub answer: Answer,
    /// Error of the force over its size.
    pub error: f64,
    /// Columns of the finest ring.
    pub columns: usize,
    /// Nodes across half of the width.
    pub nodes: usize,
}

/// Films of one case, any number of directions.
pub struct AlignedFilm {
    columns: Box<dyn Columns>,
    nodes: usize,
    /// Error that the nodes across the width leave, relative.
    across: f64,
}

/// Finest level: 32 x 2^7 = 4096 columns.
const FINEST: usize = 7;
/// Most that the nodes across the width may leave of an error; the columns share the rest.
const ACROSS: f64 = 0.3;

impl AlignedFilm {
    /// A film without dimensions, for errors down to `tolerance`.
    #[must_use]
    pub fn new(case: FilmCase, tolerance: f64) -> Self {
        let forces: [fn(&FilmCase) -> [f64; 2]; 5] = [
            full_forces::<5>,
            full_forces::<7>,
            full_forces::<10>,
            full_forces::<14>,
            full_forces::<20>,
        ];
        let mut own = forces[0](&case);
        let mut across = f64::INFINITY;
        let mut width = 0;
        for (next, more) in forces.iter().enumerate().skip(1) {
            let more = more(&case);
            let error = |k: usize| (own[k] / more[k] - 1.0).abs();
            across = error(0).max(error(1));
            width = next - 1;
            if across <= ACROSS * tolerance {
                break;
            }
            own = more;
        }
        let (nodes, columns): (usize, Box<dyn Columns>) = match width {
            0 => (5, Box::new(Rings::<5>::new(case))),
            1 => (7, Box::new(Rings::<7>::new(case))),
            2 => (10, Box::new(Rings::<10>::new(case))),
            _ => (14, Box::new(Rings::<14>::new(case))),
        };
        Self {
            columns,
            nodes,
            across,
        }
    }

    /// Answer to a unit effective velocity at `angle` from the line of centres, with an error of the
    /// force below `tolerance` of its size if that can be had; `None` where a set does not settle.
    pub fn solve(&mut self, angle: f64, tolerance: f64, tangents: bool) -> Option<Solved> {
        let mut levels = Vec::with_capacity(FINEST + 1);
        let mut best: Option<Solved> = None;
        for level in 0..=FINEST {
            levels.push(self.columns.answer(level, angle, tangents)?);
            let [.., first, coarse, middle, fine] = levels[..] else {
                continue;
            };
            let limit = extrapolated(&middle, &fine);
            let before = extrapolated(&coarse, &middle);
            let earlier = extrapolated(&first, &coarse);
            // Two limits may agree by chance, three hardly.
            let steps = [
                distance(&limit, &before),
                CHANCE * distance(&before, &earlier),
            ];
            let around = CONFIRMED * steps[0].max(steps[1]) / size(&limit.force);
            best = Some(Solved {
                answer: limit,
                error: around + self.across,
                columns: columns::COARSEST << level,
                nodes: self.nodes,
            });
            if around <= (1.0 - ACROSS) * tolerance {
                break;
            }
        }
        best
    }
}

/// Share of the step between two limits that the second one may still be off.
const CONFIRMED: f64 = 0.5;
/// Share of the step before that counts as one of the last.
const CHANCE: f64 = 0.25;

/// Limit of two rings, the second with twice the columns, of second order.
fn extrapolated(coarse: &Answer, fine: &Answer) -> Answer {
    let limit = |coarse: f64, fine: f64| fine + (fine - coarse) / 3.0;
    let both =
        |coarse: [f64; 2], fine: [f64; 2]| [limit(coarse[0], fine[0]), limit(coarse[1], fine[1])];
    Answer {
        force: both(coarse.force, fine.force),
        by_eccentricity: both(coarse.by_eccentricity, fine.by_eccentricity),
        by_angle: both(coarse.by_angle, fine.by_angle),
        peak: limit(coarse.peak, fine.peak),
        side_flow: limit(coarse.side_flow, fine.side_flow),
        ..*fine
    }
}

fn size(force: &[f64; 2]) -> f64 {
    force[0].hypot(force[1])
}

fn distance(a: &Answer, b: &Answer) -> f64 {
    (a.force[0] - b.force[0]).hypot(a.force[1] - b.force[1])
}

#[cfg(test)]
mod tests;
