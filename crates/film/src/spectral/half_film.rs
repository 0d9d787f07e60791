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
    /// Shapes on the lines, each by how much of it is driven.
    factors: [[f64; G]; M],
    /// Their integrals across the width.
    whole: [f64; M],
    /// Answers on the lines of Gauss points, by node.
    lines: Vec<Pair<G>>,
    changes: Vec<Change>,
    motion: [f64; 2],
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
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    value: [[f64; 2]; 2],
    slope: [[f64; 2]; 2],
}

/// Bits of the lines on which a node at s and its mirror image at -s are positive.
type Signs = [u32; 2];

impl<const M: usize, const G: usize> HalfFilm<M, G> {
    /// For a film of this D/B, on `count` steps over half a turn.
    pub(super) fn new(d_over_b: f64, count: usize) -> Self {
        let across = Across::new();
        let film = FullFilm::new(&across, d_over_b, count);
        let integrals = across.integrals;
        let factors = std::array::from_fn(|k| across.values[k].map(|value| integrals[k] * value));
        Self {
            across,
            film,
            factors,
            whole: integrals.map(|integral| integral * integral),
            lines: vec![[[0.0; G]; 2]; count + 1],
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
        for (line, answer) in self.lines.iter_mut().zip(&self.film.answer) {
            for p in 0..2 {
                let mut value = [0.0; G];
                for k in 0..M {
                    for g in 0..G {
                        value[g] += answer[p][k] * self.factors[k][g];
                    }
                }
                line[p] = value;
            }
        }
    }

    /// Sums over the nodes that are not negative; notes the changes of sign.
    fn sum_positive(&mut self) -> Sums {
        let mut sums = Sums::default();
        self.changes.clear();
        let last = self.half();
        let mut before: Option<Signs> = None;
        for (j, line) in self.lines.iter().enumerate() {
            let mut signs = [0; 2];
            for g in 0..G {
                let along = self.motion[0] * line[0][g];
                let across = self.motion[1] * line[1][g];
                signs[0] |= u32::from(along + across >= 0.0) << g;
                signs[1] |= u32::from(along - across >= 0.0) << g;
            }
            if signs != [0; 2] {
                let mirrored = if j == 0 || j == last { 0 } else { signs[1] };
                self.add_node(j, [signs[0], mirrored], &mut sums);
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

    /// Adds a node and its mirror image, as far as they are positive.
    fn add_node(&self, j: usize, signs: Signs, sums: &mut Sums) {
        let [here, mirrored] = signs.map(|signs| self.counted(signs));
        let node = &self.film.nodes[j];
        let (answer, slope) = (&self.film.answer[j], &self.film.slope[j]);
        for p in 0..2 {
            // What is even and what is odd about the line of centres.
            let (mut value, mut rise) = ([0.0; 2], [0.0; 2]);
            for k in 0..M {
                let counts = [here[k] + mirrored[k], here[k] - mirrored[k]];
                for parity in 0..2 {
                    value[parity] += counts[parity] * answer[p][k];
                    rise[parity] += counts[parity] * slope[p][k];
                }
            }
            for q in 0..2 {
                let parity = usize::from(p != q);
                let weight = node.source[q];
                sums.value[p][q] += value[parity] * weight.value;
                sums.slope[p][q] += value[parity] * weight.slope + rise[parity] * weight.value;
            }
        }
    }

    /// Integrals of the shapes over the lines of these bits.
    #[inline]
    fn counted(&self, lines: u32) -> [f64; M] {
        if lines == 0 {
            return [0.0; M];
        }
        if lines == (1 << G) - 1 {
            return self.whole;
        }
        let mut counted = [0.0; M];
        for g in (0..G).filter(|g| lines >> g & 1 == 1) {
            for k in 0..M {
                counted[k] += self.across.weights[g] * self.factors[k][g];
            }
        }
        counted
    }

    /// Adds what the sum has too much or too little at a change of sign.
    fn correct(&self, change: &Change, sums: &mut Sums) {
        let g = change.line;
        let places: [(usize, f64); 4] =
            [-1, 0, 1, 2].map(|i| on_half(self.half(), change.node + change.way * i));
        // Parity of the answer to motion across and of the weight of the force across.
        let parity = |odd: usize, sign: f64| if odd == 1 { sign } else { 1.0 };
        let answers: [Stencil; 2] =
            [0, 1].map(|p| places.map(|(j, sign)| parity(p, sign) * self.lines[j][p][g]));
        let slope_at = |p: usize, j: usize| -> f64 {
            let slope = &self.film.slope[j][p];
            (0..M).map(|k| slope[k] * self.factors[k][g]).sum()
        };
        let slopes: [Stencil; 2] =
            [0, 1].map(|p| places.map(|(j, sign)| parity(p, sign) * slope_at(p, j)));
        let weight = self.across.weights[g];
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
                sums.value[p][q] += weight * rest.correction(&answers[p], &value);
                sums.slope[p][q] += weight
                    * (rest.correction(&slopes[p], &value) + rest.correction(&answers[p], &slope));
            }
        }
    }

    /// Node at the end of half a turn.
    fn half(&self) -> usize {
        self.lines.len() - 1
    }

    fn gather(&self, sums: &Sums) -> AlignedForce {
        let mut found = AlignedForce::default();
        for q in 0..2 {
            for p in 0..2 {
                let value = self.film.step * sums.value[p][q];
                found.force[q] += self.motion[p] * value;
                found.by_motion[q][p] = value;
                found.by_eccentricity[q] += self.motion[p] * self.film.step * sums.slope[p][q];
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
