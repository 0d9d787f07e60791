//! Where are the fronts of a film, each line across the width moving its own until the force no longer
//! feels it, and how does the force follow the journal between held fronts?
//!
//! For tables: the fronts of neighbouring states come out alike however the updates went. The force
//! follows the fronts to second order, so that a few updates suffice. Its derivatives hold the fronts:
//! those by the place of the journal are `u dA/de p` with the two u of unit motions.

use super::fronts::{Fronts, MOST_TERMS};
use super::{Accuracy, FittedFilm, MOST_UPDATES, at_rest, driven, first_wishes};
use crate::spectral::answer::{AlignedFigures, AlignedForce};

/// A film whose fronts are settled line by line.
#[derive(Debug, Clone)]
pub(in crate::spectral) struct LinewiseFilm<const M: usize, const G: usize> {
    film: FittedFilm<M, G>,
    /// Terms of a front.
    terms: usize,
    /// Where the lines would have the fronts next, rad from the direction of motion.
    wishes: [[f64; G]; 2],
    is_warm: bool,
}

impl<const M: usize, const G: usize> LinewiseFilm<M, G> {
    /// For a film of this D/B, fronts of so many terms.
    pub(in crate::spectral) fn new(d_over_b: f64, accuracy: Accuracy, terms: usize) -> Self {
        Self {
            film: FittedFilm::new(d_over_b, accuracy),
            terms: terms.min(MOST_TERMS),
            wishes: first_wishes(),
            is_warm: false,
        }
    }

    /// Force and derivatives at a relative eccentricity below 1, for a motion along and across the line
    /// of centres, and whether the fronts settled.
    pub(in crate::spectral) fn force(
        &mut self,
        eps: f64,
        motion: [f64; 2],
    ) -> (AlignedForce, bool) {
        self.begin(eps, driven(motion));
        let mut settled = self.settle();
        if !settled && self.is_warm {
            self.is_warm = false;
            self.begin(eps, driven(motion));
            settled = self.settle();
        }
        self.is_warm = settled;
        let found = self.film.held_tangents();
        if motion == [0.0; 2] {
            return (at_rest(found), settled);
        }
        (found, settled)
    }

    /// Figures of the last solution.
    pub(in crate::spectral) fn figures(&self) -> AlignedFigures {
        self.film.figures()
    }

    /// Fronts to begin with: those of the last film if it was a similar one.
    fn begin(&mut self, eps: f64, motion: [f64; 2]) {
        let is_near = self.film.go_to(eps, motion).is_some();
        if !(self.is_warm && is_near) {
            self.wishes = first_wishes();
            self.is_warm = false;
        }
    }

    fn settle(&mut self) -> bool {
        let tolerance = self.film.accuracy.tolerance;
        self.film
            .settle_linewise(&mut self.wishes, self.terms, tolerance)
    }
}

impl<const M: usize, const G: usize> FittedFilm<M, G> {
    /// Lets each line move its fronts, from wishes for them to wishes for the next, until a further update would
    /// not change the force by more than the tolerance; whether that came about.
    pub(super) fn settle_linewise(
        &mut self,
        wishes: &mut [[f64; G]; 2],
        most_terms: usize,
        tolerance: f64,
    ) -> bool {
        let mut terms = most_terms.min(3);
        let (mut before, mut last_change) = ([0.0; 2], f64::INFINITY);
        for update in 0..MOST_UPDATES {
            self.fronts = self.fit.fit(wishes, terms);
            if !self.solve() {
                return false;
            }
            let force = self.force_of_answers();
            let size = force[0].hypot(force[1]);
            let change = (force[0] - before[0]).hypot(force[1] - before[1]) / size;
            *wishes = self.wishes();
            let shift = self.shift(&self.fit.fit(wishes, terms));
            // The force follows the fronts to second order, and so do its changes one another.
            let by_shift = self.aspect.max(1.0) * shift * shift;
            let by_change = (change * change / last_change).max(0.1 * change);
            let is_done = by_shift < tolerance || (update > 1 && by_change < tolerance);
            if terms == most_terms && is_done {
                return true;
            }
            if shift < 0.05 || update > 3 {
                terms = most_terms;
            }
            (before, last_change) = (force, change);
        }
        last_change < 10.0 * tolerance
    }

    /// How far fronts would move, rad (mean square).
    fn shift(&self, next: &Fronts<G>) -> f64 {
        let moved = |side: usize| -> f64 {
            let change =
                std::array::from_fn(|g| next.angles[side][g] - self.fronts.angles[side][g]);
            self.fit.size_on_lines(&change)
        };
        moved(0).hypot(moved(1))
    }

    /// Force and derivatives of the last solution. Those by the place of the journal, along and across,
    /// at fixed fronts; the one by the direction of motion with fronts that turn with it, `J F - eps
    /// dF/dy` since the film knows only the angle between both: exact for a journal in the centre.
    pub(super) fn held_tangents(&self) -> AlignedForce {
        let force = self.force_of_answers();
        let mut by_place = [[0.0; 2]; 2];
        self.walk(|point, _, slopes| {
            let film =
                [0, 1].map(|way| self.motion[0] * slopes[0][way] + self.motion[1] * slopes[1][way]);
            let change = -3.0 * point.gap * point.gap * point.area;
            for (row, answer) in slopes.iter().enumerate() {
                let lost = change * (answer[0] * film[0] + self.aspect * answer[1] * film[1]);
                by_place[row][0] += lost * point.normal[0];
                by_place[row][1] += lost * point.normal[1];
            }
        });
        let by_turn = [
            -force[1] - self.eps * by_place[0][1],
            force[0] - self.eps * by_place[1][1],
        ];
        AlignedForce {
            force,
            by_eccentricity: by_place.map(|row| row[0]),
            by_motion: self.by_motion(force, by_turn),
        }
    }
}
