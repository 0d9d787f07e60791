//! Where are the fronts of a film, all of them moved together until nothing is left of their conditions?
//!
//! On line: from afar each line moves its fronts by itself, then Newton's method all together, with the
//! derivatives of the discrete equations (`moving`). They also give those of the force with fronts that
//! follow the journal, and foretell the fronts of the next state.

use super::moving::Rates;
use super::{Accuracy, FittedFilm, MOST_UPDATES, at_rest, driven, first_wishes};
use crate::spectral::answer::{AlignedFigures, AlignedForce};

/// Places before the parts of the fronts in an array of what the film depends on: eccentricity and direction.
pub(super) const BEFORE: usize = 2;
/// Newton's method takes over where the fronts move less, rad (mean square).
const CLOSE: f64 = 0.03;
/// It has new rates where its changes fall less than to this share.
const SLOW: f64 = 0.3;
/// Where they fall less than to this share even so, half of them is enough.
const OVERSHOT: f64 = 0.5;
/// Its changes are at most this, rad; a greater one means that it is lost.
const FARTHEST: f64 = 0.3;
/// Lines that would move settled fronts further than this, rad (mean square), show that those are none.
const STRAY: f64 = 0.1;
/// Gap over the last one where a film is led from the centre.
const NEARER: f64 = 0.8;
/// Terms of fronts that each line moves by itself: those of more are unsteady at the ends.
const FIRST_TERMS: usize = 2;

/// A film whose fronts are settled together, with `L - 2` parts in both.
#[derive(Debug, Clone)]
pub(in crate::spectral) struct JointFilm<const M: usize, const G: usize, const L: usize> {
    pub(super) film: FittedFilm<M, G>,
    /// The answers and the adjoints of the fronts' conditions.
    pub(super) fields: Vec<[f64; L]>,
    /// H^3 p_theta at both fronts on the lines for unit motions.
    pub(super) fluxes: [[[f64; 2]; G]; 2],
    /// Parts of the fronts, rad, first of eccentricity and direction nothing.
    parts: [f64; L],
    /// How the equations change, the inverse of the fronts' part, how the fronts follow eccentricity and direction.
    pub(super) rates: Rates<L>,
    pub(super) inverse: Rates<L>,
    pub(super) follow: [[f64; 2]; L],
    is_warm: bool,
}

impl<const M: usize, const G: usize, const L: usize> JointFilm<M, G, L> {
    /// Terms of one front.
    pub(super) const TERMS: usize = (L - BEFORE) / 2;

    /// For a film of this D/B.
    pub(in crate::spectral) fn new(d_over_b: f64, accuracy: Accuracy) -> Self {
        let film = FittedFilm::new(d_over_b, accuracy);
        Self {
            fields: vec![[0.0; L]; film.answers.len()],
            film,
            fluxes: [[[0.0; 2]; G]; 2],
            parts: [0.0; L],
            rates: [[0.0; L]; L],
            inverse: [[0.0; L]; L],
            follow: [[0.0; 2]; L],
            is_warm: false,
        }
    }

    /// Figures of the last solution.
    pub(in crate::spectral) fn figures(&self) -> AlignedFigures {
        self.film.figures()
    }

    /// Force and derivatives at a relative eccentricity below 1, for a motion along and across the line
    /// of centres, and whether the fronts settled.
    pub(in crate::spectral) fn force(
        &mut self,
        eps: f64,
        motion: [f64; 2],
    ) -> (AlignedForce, bool) {
        self.begin(eps, driven(motion));
        let mut settled = self.settle() || self.approach(eps, driven(motion));
        self.is_warm = settled && self.differentiate();
        let found = if self.is_warm {
            let change = self.newton_change();
            for (part, change) in self.parts.iter_mut().zip(&change) {
                *part += change;
            }
            self.tangents(&change)
        } else {
            // Beyond a relative eccentricity of 0.99, elements may be too coarse for a front in a gap so wide that the
            // force hardly feels it: it is held where it last settled.
            self.film.go_to(eps, driven(motion));
            settled = false;
            self.solve();
            self.film.held_tangents()
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

    /// Settles the fronts for a journal that comes from the centre, in steps that a film follows.
    fn approach(&mut self, eps: f64, motion: [f64; 2]) -> bool {
        let gap = 1.0 - eps;
        let steps = (gap.ln() / NEARER.ln()).ceil().max(1.0);
        self.is_warm = false;
        for step in 0..steps as usize {
            self.begin(1.0 - gap.powf(step as f64 / steps), motion);
            let known = self.parts;
            self.is_warm = self.settle() && self.differentiate();
            if !self.is_warm {
                self.parts = known;
                return false;
            }
        }
        self.begin(eps, motion);
        let known = self.parts;
        let is_settled = self.settle();
        if !is_settled {
            self.parts = known;
        }
        is_settled
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
        let film = &mut self.film;
        for (side, parts) in self.parts[BEFORE..].chunks_exact(Self::TERMS).enumerate() {
            [film.fronts.angles[side], film.fronts.slopes[side]] = film.fit.front(parts);
        }
        let is_solved = film.solve();
        self.fluxes = [0, 1].map(|side| std::array::from_fn(|g| film.fluxes(side, g)));
        is_solved
    }

    /// Moves the fronts to where their conditions put them: from afar each line by itself, then all by Newton's
    /// method, with rates known from a neighbour while that brings them on.
    fn settle(&mut self) -> bool {
        let mut is_close = self.is_warm;
        let mut last = f64::INFINITY;
        let mut step: Option<[f64; L]> = None;
        for _ in 0..MOST_UPDATES {
            if !self.solve() {
                return false;
            }
            if !is_close {
                let parts = self.parts_of(&self.film.wishes(), FIRST_TERMS);
                let change: [f64; L] = std::array::from_fn(|part| parts[part] - self.parts[part]);
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
                return self.is_wished();
            }
            if size > SLOW * last {
                if !self.differentiate() {
                    return false;
                }
                change = self.newton_change();
                size = self.size(&change);
            }
            if size > FARTHEST || size.is_nan() {
                return false;
            }
            let is_whole = size <= OVERSHOT * last;
            let share = if is_whole { 1.0 } else { 0.5 };
            for (part, change) in self.parts.iter_mut().zip(change) {
                *part += share * change;
            }
            // The update knows whole steps.
            (last, step) = (size, is_whole.then_some(change));
        }
        false
    }

    /// Whether each line would leave its fronts about where they are: mean fluxes may vanish elsewhere.
    fn is_wished(&self) -> bool {
        let (film, wishes) = (&self.film, self.film.wishes());
        (0..2).all(|side| {
            let angles = &film.fronts.angles[side];
            let moves = std::array::from_fn(|g| wishes[side][g] - angles[g]);
            film.fit.size_on_lines(&moves) < STRAY
        })
    }

    /// How far a change moves the fronts, rad (mean square).
    fn size(&self, change: &[f64; L]) -> f64 {
        self.film.fit.size_of_parts(&change[BEFORE..])
    }

    /// Betters the inverse by what is left to change after a step, and that change with it: the update of C. G.
    /// Broyden, Math. Comput. 19 (1965) 577, with `H y = step - change`.
    fn learn(&mut self, step: &[f64; L], change: &mut [f64; L]) {
        let product =
            |a: &[f64; L], b: &[f64; L]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
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
}
