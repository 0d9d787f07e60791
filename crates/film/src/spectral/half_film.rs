//! What force does an aligned film put on its journal once negative pressures are cut (Gumbel)?
//!
//! ```text
//! p = w_r p_even + w_t p_odd,   F_i = -int int max(p, 0) n_i dtheta dZ
//! ```
//! The full film answers both motions; along each line of Gauss points across the width, what is
//! positive of their sum is integrated ([`super::cut`]). Wedge and squeeze together, so that nothing is
//! added that was cut before. The force is of degree 1 in the motion and its derivatives are those of
//! the discrete force: by the motion the sums themselves, by eccentricity sums of slopes.
//! Pressures over 12 eta R^2/c^2, 1/s; motion over c, 1/s.
//! Reference: L. Gumbel, Monatsbl. Berl. Bez. VDI (1914) 87.

use super::across::Across;
use super::answer::AlignedForce;
use super::around::Dual;
use super::cut::{Rest, Stencil};
use super::full_film::{FullFilm, Pair};

mod figures;

/// Half film of an aligned journal, solved on `M` shapes and `G` lines on one half of the width.
#[derive(Debug, Clone)]
pub(super) struct HalfFilm<const M: usize, const G: usize> {
    across: Across<M, G>,
    film: FullFilm<M>,
    lines: Vec<Line<G>>,
    changes: Vec<Change>,
    motion: [f64; 2],
}

/// A node on all lines of Gauss points.
#[derive(Debug, Clone, Copy)]
struct Line<const G: usize> {
    answer: Pair<G>,
    slope: Pair<G>,
}

/// A change of sign on a line: the positive node next to it, as a place on the whole ring of nodes,
/// and the way to the negative one.
#[derive(Debug, Clone, Copy)]
struct Change {
    line: usize,
    node: isize,
    way: isize,
}

/// Integrals of the answer to each motion times the weight of each force, and their slopes.
#[derive(Debug, Clone, Copy)]
struct Sums<const G: usize> {
    value: [Pair<G>; 2],
    slope: [Pair<G>; 2],
}

/// Bits of the lines on which a node at s and its mirror image at -s are positive.
type Signs = [u32; 2];

impl<const M: usize, const G: usize> HalfFilm<M, G> {
    /// For a film of this D/B, on `count` steps over half a turn.
    pub(super) fn new(d_over_b: f64, count: usize) -> Self {
        let across = Across::new();
        let film = FullFilm::new(&across, d_over_b, count);
        let zero = [[0.0; G]; 2];
        Self {
            across,
            film,
            lines: vec![
                Line {
                    answer: zero,
                    slope: zero,
                };
                count + 1
            ],
            changes: Vec::with_capacity(8 * G),
            motion: [0.0; 2],
        }
    }

    /// Force and derivatives at a relative eccentricity below 1, for a motion along and across the line
    /// of centres.
    pub(super) fn force(&mut self, eps: f64, motion: [f64; 2]) -> AlignedForce {
        self.film.solve(eps);
        self.motion = motion;
        self.spread_on_lines();
        let mut sums = self.sum_positive();
        for change in &self.changes {
            self.correct(change, &mut sums);
        }
        self.gather(&sums)
    }

    /// From shapes to lines.
    fn spread_on_lines(&mut self) {
        let across = &self.across;
        let mut factors = across.values;
        for (row, integral) in factors.iter_mut().zip(&across.integrals) {
            for value in row {
                *value *= integral;
            }
        }
        let films = self.film.answer.iter().zip(&self.film.slope);
        for (line, (answer, slope)) in self.lines.iter_mut().zip(films) {
            for p in 0..2 {
                let (mut value, mut rise) = ([0.0; G], [0.0; G]);
                for k in 0..M {
                    for g in 0..G {
                        value[g] += answer[p][k] * factors[k][g];
                        rise[g] += slope[p][k] * factors[k][g];
                    }
                }
                line.answer[p] = value;
                line.slope[p] = rise;
            }
        }
    }

    /// Sums over the nodes that are not negative; notes the changes of sign.
    fn sum_positive(&mut self) -> Sums<G> {
        let zero = [[[0.0; G]; 2]; 2];
        let mut sums = Sums {
            value: zero,
            slope: zero,
        };
        self.changes.clear();
        let last = self.half();
        let mut before: Option<Signs> = None;
        for (j, (line, node)) in self.lines.iter().zip(&self.film.nodes).enumerate() {
            let has_mirror_image = if j == 0 || j == last { 0.0 } else { 1.0 };
            let (mut even, mut odd) = ([0.0; G], [0.0; G]);
            let mut signs = [0; 2];
            for g in 0..G {
                let along = self.motion[0] * line.answer[0][g];
                let across = self.motion[1] * line.answer[1][g];
                let (here, mirrored) = (along + across >= 0.0, along - across >= 0.0);
                signs[0] |= u32::from(here) << g;
                signs[1] |= u32::from(mirrored) << g;
                let here = if here { 1.0 } else { 0.0 };
                let mirrored = if mirrored { has_mirror_image } else { 0.0 };
                even[g] = here + mirrored;
                odd[g] = here - mirrored;
            }
            for answer in 0..2 {
                for force in 0..2 {
                    let Dual { value, slope } = node.source[force];
                    let counts = if answer == force { &even } else { &odd };
                    for g in 0..G {
                        let u = line.answer[answer][g] * counts[g];
                        sums.value[answer][force][g] += u * value;
                        sums.slope[answer][force][g] +=
                            u * slope + line.slope[answer][g] * counts[g] * value;
                    }
                }
            }
            if let Some(before) = before
                && before != signs
            {
                note_changes(j, before, signs, &mut self.changes);
            }
            before = Some(signs);
        }
        sums
    }

    /// Adds what the sum has too much or too little at a change of sign.
    fn correct(&self, change: &Change, sums: &mut Sums<G>) {
        let g = change.line;
        let places: [(usize, f64); 4] =
            [-1, 0, 1, 2].map(|i| on_half(self.half(), change.node + change.way * i));
        // Parity of the answer to motion across and of the weight of the force across.
        let parity = |odd: usize, sign: f64| if odd == 1 { sign } else { 1.0 };
        let answers: [Stencil; 2] =
            [0, 1].map(|p| places.map(|(j, sign)| parity(p, sign) * self.lines[j].answer[p][g]));
        let slopes: [Stencil; 2] =
            [0, 1].map(|p| places.map(|(j, sign)| parity(p, sign) * self.lines[j].slope[p][g]));
        let weights: [[Dual; 4]; 2] = [0, 1].map(|q| {
            places.map(|(j, sign)| {
                let Dual { value, slope } = self.film.nodes[j].source[q];
                Dual {
                    value: parity(q, sign) * value,
                    slope: parity(q, sign) * slope,
                }
            })
        });
        let pressure: Stencil = std::array::from_fn(|i| {
            self.motion[0] * answers[0][i] + self.motion[1] * answers[1][i]
        });
        let rest = Rest::of(&pressure);
        for p in 0..2 {
            for q in 0..2 {
                let value = weights[q].map(|weight| weight.value);
                let slope = weights[q].map(|weight| weight.slope);
                sums.value[p][q][g] += rest.correction(&answers[p], &value);
                sums.slope[p][q][g] +=
                    rest.correction(&slopes[p], &value) + rest.correction(&answers[p], &slope);
            }
        }
    }

    /// Node at the end of half a turn.
    fn half(&self) -> usize {
        self.lines.len() - 1
    }

    fn gather(&self, sums: &Sums<G>) -> AlignedForce {
        let over_lines = |lanes: &[f64; G]| -> f64 {
            let weighted = lanes.iter().zip(&self.across.weights);
            self.film.step * weighted.map(|(sum, weight)| sum * weight).sum::<f64>()
        };
        let mut found = AlignedForce::default();
        for q in 0..2 {
            for p in 0..2 {
                let value = over_lines(&sums.value[p][q]);
                found.force[q] += self.motion[p] * value;
                found.by_motion[q][p] = value;
                found.by_eccentricity[q] += self.motion[p] * over_lines(&sums.slope[p][q]);
            }
        }
        found
    }
}

/// Node of half a turn, up to node `half` at its end, for a place on the ring, and the sign of what is
/// odd there.
fn on_half(half: usize, place: isize) -> (usize, f64) {
    let half = half as isize;
    let wrapped = if place > half {
        place - 2 * half
    } else if place < -half {
        place + 2 * half
    } else {
        place
    };
    let sign = if wrapped < 0 { -1.0 } else { 1.0 };
    (wrapped.unsigned_abs(), sign)
}

/// Changes of sign between node `j - 1` and `j` and between their mirror images.
fn note_changes(j: usize, before: Signs, now: Signs, changes: &mut Vec<Change>) {
    for (signs, side) in before.into_iter().zip(now).zip([1, -1]) {
        let (before, now) = signs;
        let mut left = before ^ now;
        while left != 0 {
            let line = left.trailing_zeros() as usize;
            left &= left - 1;
            let is_here = now >> line & 1 == 1;
            let node = side * (j as isize - isize::from(!is_here));
            let way = if is_here { -side } else { side };
            changes.push(Change { line, node, way });
        }
    }
}
