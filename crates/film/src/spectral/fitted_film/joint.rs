//! Where are the fronts of a film, all of them moved together until nothing is left of their conditions?
//!
//! On line: from afar each line moves its fronts by itself, then Newton's method all together, with the
//! derivatives of the discrete equations (`moving`). They also give those of the force with fronts that
//! follow the journal, and foretell the fronts of the next state.

use super::moving::{Pull, Rates};
use super::{
    Accuracy, FittedFilm, LONGEST_MOVE, MOST_UPDATES, at_rest, driven, first_wishes, keep_apart,
};
use crate::spectral::answer::{AlignedFigures, AlignedForce};

/// Places before the parts of the fronts in an array of what the film depends on: eccentricity and direction.
pub(super) const BEFORE: usize = 2;
/// Newton's method takes over where the fronts move less, rad (mean square).
const CLOSE: f64 = 0.03;
/// It has new rates where its changes fall less than to this share.
const SLOW: f64 = 0.3;
/// Its changes are at most this, rad; a greater one means that it is lost.
const FARTHEST: f64 = 0.3;
/// Changes of the force over its size that lines which move by themselves may still make.
const UNFELT: f64 = 3e-6;

/// A film whose fronts are settled together, with `L - 2` parts in both.
#[derive(Debug, Clone)]
pub(in crate::spectral) struct JointFilm<const M: usize, const G: usize, const L: usize> {
    pub(super) film: FittedFilm<M, G>,
    /// The answers and the adjoints of the fronts' conditions.
    pub(super) fields: Vec<[f64; L]>,
    /// Where each line would have the fronts.
    pub(super) pulls: [[Pull; G]; 2],
    /// Parts of the fronts, rad, first of eccentricity and direction nothing.
    parts: [f64; L],
    /// How the equations change, the inverse of the fronts' part, how the fronts follow eccentricity and direction.
    pub(super) rates: Rates<L>,
    pub(super) inverse: Rates<L>,
    pub(super) follow: [[f64; 2]; L],
    is_warm: bool,
    pub(in crate::spectral) fallbacks: usize, pub(super) least: f64, pub(super) weights: [f64; G], debug: bool, pub(in crate::spectral) solves: usize, pub(in crate::spectral) diffs: usize,
}

impl<const M: usize, const G: usize, const L: usize> JointFilm<M, G, L> {
    /// Terms of one front.
    pub(super) const TERMS: usize = (L - BEFORE) / 2;

    /// For a film of this D/B.
    pub(in crate::spectral) fn new(d_over_b: f64, accuracy: Accuracy) -> Self {
        let accuracy = Accuracy { elements: super::env("E", accuracy.elements as f64) as usize, degree: super::env("P", accuracy.degree as f64) as usize, tolerance: super::env("TOL", accuracy.tolerance), modulus: super::env("M", accuracy.modulus), };
        let mut film = FittedFilm::new(d_over_b, accuracy);
        film.grade();
        Self {
            fields: vec![[0.0; L]; film.answers.len()],
            film,
            pulls: [[Pull::default(); G]; 2],
            parts: [0.0; L],
            rates: [[0.0; L]; L],
            inverse: [[0.0; L]; L],
            follow: [[0.0; 2]; L],
            is_warm: false,
            fallbacks: 0, weights: { let points = crate::spectral::quadrature::gauss_legendre(2 * G); std::array::from_fn(|g| (1.0 - points[g][0] * points[g][0]).powf(super::env("W", 0.0))) }, debug: super::env("DEBUG", 0.0) > 0.0, least: super::env("C", super::moving::LEAST_CHORD), solves: 0, diffs: 0,
        }
    }

    /// Figures of the last solution.
    pub(in crate::spectral) fn figures(&self) -> AlignedFigures {
        self.film.figures()
    }

    /// Force and derivatives at a relative eccentricity below 1, for a motion along and across the line
    /// of centres, and whether the fronts settled.
    pub(in crate::spectral) fn force(&mut self, eps: f64, motion: [f64; 2]) -> (AlignedForce, bool) {
        self.begin(eps, driven(motion));
        let mut settled = self.settle();
        if !settled && self.is_warm {
            self.is_warm = false;
            self.begin(eps, driven(motion));
            settled = self.settle();
        }
        self.is_warm = settled && self.differentiate();
        let found = if self.is_warm {
            let change = self.newton_change();
            for (part, change) in self.parts.iter_mut().zip(&change) {
                *part += change;
            }
            self.tangents(&change)
        } else {
            // Where the elements are too coarse for the fronts of a gap so wide that the force does not feel them.
            self.fallbacks += 1;
            settled = self.settle_by_lines();
            self.differentiate();
            self.follow = [[0.0; 2]; L];
            self.tangents(&[0.0; L])
        };
        if motion == [0.0; 2] {
            return (at_rest(found), settled);
        }
        (found, settled)
    }

    /// Fronts to begin with: those of the last film if it was a similar one, moved on as they follow.
    fn begin(&mut self, eps: f64, motion: [f64; 2]) {
        match self.film.go_to(eps, motion) {
            Some([rise, turn]) if self.is_warm => {
                for (part, [by_rise, by_turn]) in self.parts.iter_mut().zip(&self.follow) {
                    *part += by_rise * rise + by_turn * turn;
                }
            }
            _ => {
                self.parts = self.parts_of(&first_wishes(), 1);
                self.is_warm = false;
            }
        }
    }

    /// Parts of the fronts closest to the wishes, `count` terms of each.
    fn parts_of(&self, wishes: &[[f64; G]; 2], count: usize) -> [f64; L] {
        let mut parts = [0.0; L];
        let places = parts[BEFORE..].chunks_exact_mut(Self::TERMS);
        for (places, wishes) in places.zip(wishes) {
            places.copy_from_slice(&self.film.fit.parts(wishes, count)[..Self::TERMS]);
        }
        parts
    }

    /// Solves between the fronts of the present parts; false where the equations are no film's.
    fn solve(&mut self) -> bool {
        self.solves += 1;
        let film = &mut self.film;
        for (side, parts) in self.parts[BEFORE..].chunks_exact(Self::TERMS).enumerate() {
            [film.fronts.angles[side], film.fronts.slopes[side]] = film.fit.front(parts);
        }
        let is_solved = film.solve();
        self.pull_fronts();
        is_solved
    }

    /// Moves the fronts to where their conditions put them: from afar each line by itself, then all by Newton's
    /// method, with rates known from a neighbour while that brings them on.
    fn settle(&mut self) -> bool {
        let terms = Self::TERMS;
        let mut is_close = self.is_warm;
        let mut last = f64::INFINITY;
        let mut step: Option<[f64; L]> = None;
        for update in 0..MOST_UPDATES {
            if !self.solve() {
                return false;
            }
            if !is_close {
                let parts = self.parts_of(
                    &self.wishes(),
                    if update > 3 { terms } else { terms.min(3) },
                );
                let change: [f64; L] =
                    std::array::from_fn(|part| parts[part] - self.parts[part]);
                if self.debug { eprintln!("   lines {update}: {:.2e} parts {:.3?}", self.size(&change), &self.parts[2..]); }
                is_close = self.size(&change) < CLOSE;
                if !is_close {
                    self.parts = parts;
                    continue;
                }
                if !self.differentiate() {
                    return false;
                }
            }
            let mut change = self.newton_change();
            if let Some(step) = &step {
                self.learn(step, &mut change);
            }
            let mut size = self.size(&change);
            if self.film.aspect.max(1.0) * size * size < self.film.accuracy.tolerance {
                return true;
            }
            if size > SLOW * last {
                if !self.differentiate() {
                    return false;
                }
                change = self.newton_change();
                size = self.size(&change);
            }
            if self.debug { eprintln!("   newton {update}: {size:.2e} last {last:.2e} parts {:.3?}", &self.parts[2..]); }
            if size > FARTHEST || size > last || size.is_nan() {
                return false;
            }
            for (part, change) in self.parts.iter_mut().zip(change) {
                *part += change;
            }
            (last, step) = (size, Some(change));
        }
        false
    }

    /// How far a change moves the fronts, rad (mean square).
    fn size(&self, change: &[f64; L]) -> f64 {
        self.film.fit.size_of_parts(&change[BEFORE..])
    }

    /// Betters the inverse by what is left to change after a step, and that change with it: the update of C. G.
    /// Broyden, Math. Comput. 19 (1965) 577, with `H y = step - change`.
    fn learn(&mut self, step: &[f64; L], change: &mut [f64; L]) {
        let product = |a: &[f64; L], b: &[f64; L]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let square = product(step, step);
        let rest = square - product(step, change);
        if rest < 0.5 * square {
            return;
        }
        let mut row = [0.0; L];
        for (part, known) in step.iter().zip(&self.inverse) {
            for (sum, value) in row.iter_mut().zip(known) {
                *sum += part * value;
            }
        }
        for (part, known) in change.iter().zip(&mut self.inverse) {
            for (value, sum) in known.iter_mut().zip(&row) {
                *value += part * sum / rest;
            }
        }
        *change = change.map(|part| part * square / rest);
    }

    /// Lets each line move its fronts by itself until the force no longer feels it.
    fn settle_by_lines(&mut self) -> bool {
        self.begin(self.film.eps, self.film.motion);
        let terms = Self::TERMS;
        let (mut before, mut last_change) = ([0.0; 2], f64::INFINITY);
        for update in 0..MOST_UPDATES {
            if !self.solve() {
                return false;
            }
            let force = self.film.force_of_answers();
            let size = force[0].hypot(force[1]);
            let change = (force[0] - before[0]).hypot(force[1] - before[1]) / size;
            // The force follows the fronts to second order, and so do its changes one another.
            let left = (change * change / last_change).max(0.1 * change);
            if update > 1 && left < UNFELT {
                return true;
            }
            let terms = if update > 3 { terms } else { terms.min(3) };
            self.parts = self.parts_of(&self.wishes(), terms);
            (before, last_change) = (force, change);
        }
        last_change < 10.0 * UNFELT
    }

    /// Where each line would have its fronts: where the flux across them is used up, rad.
    fn wishes(&self) -> [[f64; G]; 2] {
        let mut wishes = [[0.0; G]; 2];
        for g in 0..G {
            for side in 0..2 {
                let way = self.pulls[side][g].way;
                wishes[side][g] =
                    self.film.fronts.angles[side][g] + way.clamp(-LONGEST_MOVE, LONGEST_MOVE);
            }
        }
        keep_apart(&mut wishes);
        wishes
    }

}
