//! What pressure has an aligned film that ruptures smoothly (Reynolds, Swift and Stieber)?
//!
//! ```text
//! -(H^3 p_theta)_theta - (D/B)^2 (H^3 p_Z)_Z = w n     where p > 0,  theta in (a(Z), b(Z)), |Z| < 1
//! p = 0 all around it;   H^3 p_theta = 0 at a and b    which places the fronts
//! ```
//! The film is mapped onto a rectangle between its fronts, where pressure is smooth: elements of high
//! degree around, even polynomials across. The fronts move by Newton's method: the pressure that is
//! zero on a front which is off by d is right to order d^2, and the front belongs where the flux across
//! it has been used up by the sink behind it,
//!
//! ```text
//! |w| (sin(theta' - omega) - sin(theta - omega)) = (1 + (D/B)^2 front'^2) H^3 p_theta
//! ```
//! with omega the angle of the motion. The force follows to order d^2 too, so that a few updates
//! suffice, and its derivatives need no third solution: `u dA/de p` with the two u of unit motions.
//! Limits: the film is torn apart on every line across the width; it is, up to widths of some
//! diameters. Pressures over 12 eta R^2/c^2, motion over c.
//! References: H. W. Swift, Proc. ICE 233 (1932) 267; W. Stieber, Das Schwimmlager, VDI 1933; trial free
//! boundaries: J. Crank, Free and Moving Boundary Problems, 1984, ch. 8.

use super::across::Across;
use super::answer::AlignedForce;
use super::around::SommerfeldAngle;
use super::profile::ProfileMatrix;
use super::quadrature::{Element, gauss_legendre};
use fronts::{FrontFit, Fronts};
use std::f64::consts::{FRAC_PI_2, TAU};

mod fronts;
mod strip;

/// How far beyond the half turn with w n > 0 a cold film is thought to reach, rad.
const FIRST_REACH: f64 = 0.15;
/// Fronts move at most so far at once, rad.
const LONGEST_MOVE: f64 = 0.4;
/// The ruptured film keeps at least this arc, rad.
const LEAST_RUPTURE: f64 = 0.05;
/// Share of the slope of a front that counts at most in its move.
const SLOPE_CAP: f64 = 0.5;
/// More updates than this mean that the fronts do not settle.
const MOST_UPDATES: usize = 14;

/// Film of an aligned journal between fitted fronts; `M` shapes across, `G` lines on half the width.
#[derive(Debug, Clone)]
pub(super) struct FittedFilm<const M: usize, const G: usize> {
    /// (D/B)^2.
    aspect: f64,
    accuracy: Accuracy,
    shapes: Shapes<M, G>,
    element: Element,
    fit: FrontFit<G>,
    matrix: ProfileMatrix<M>,
    /// Right-hand sides for motion along and across, and the answers u, by unknown.
    sources: Vec<[f64; 2]>,
    answers: Vec<[f64; 2]>,
    points: Vec<strip::Point>,
    map: SommerfeldAngle,
    /// The state of the last solution.
    eps: f64,
    motion: [f64; 2],
    /// Fronts of the last solution, from the direction of motion, and where they would go next, rad.
    fronts: Fronts<G>,
    wishes: [[f64; G]; 2],
    is_warm: bool,
}

/// What a fitted film is asked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Accuracy {
    /// Elements around.
    pub elements: usize,
    /// Their degree.
    pub degree: usize,
    /// Terms of the fronts.
    pub terms: usize,
    /// Modulus of the substitution over the relative eccentricity.
    pub modulus: f64,
    /// Change of the force over its size by a further update.
    pub tolerance: f64,
}

/// Even polynomials on the lines.
#[derive(Debug, Clone)]
struct Shapes<const M: usize, const G: usize> {
    places: [f64; G],
    weights: [f64; G],
    values: [[f64; M]; G],
    slopes: [[f64; M]; G],
    middle: [f64; M],
}

impl<const M: usize, const G: usize> Shapes<M, G> {
    fn new() -> Self {
        let across = Across::<M, G>::new();
        let points = gauss_legendre(2 * G);
        Self {
            places: std::array::from_fn(|g| points[g][0]),
            weights: across.weights,
            values: std::array::from_fn(|g| std::array::from_fn(|k| across.values[k][g])),
            slopes: std::array::from_fn(|g| std::array::from_fn(|k| across.slopes[k][g])),
            middle: across.middle,
        }
    }
}

impl<const M: usize, const G: usize> FittedFilm<M, G> {
    /// For a film of this D/B.
    pub(super) fn new(d_over_b: f64, accuracy: Accuracy) -> Self {
        let Accuracy {
            elements, degree, ..
        } = accuracy;
        // Nodes inside, the ends being zero; a row begins where its element does.
        let nodes = elements * degree - 1;
        let starts = (0..nodes)
            .map(|node| (node / degree * degree).saturating_sub(1))
            .collect();
        Self {
            aspect: d_over_b * d_over_b,
            accuracy,
            shapes: Shapes::new(),
            element: Element::new(degree),
            fit: FrontFit::new(),
            matrix: ProfileMatrix::new(starts),
            sources: vec![[0.0; 2]; nodes * M],
            answers: vec![[0.0; 2]; nodes * M],
            points: vec![strip::Point::default(); elements * (degree + 1) * G],
            map: SommerfeldAngle::new(0.0, accuracy.modulus),
            eps: 0.0,
            motion: [1.0, 0.0],
            fronts: Fronts {
                angles: [[0.0; G]; 2],
                slopes: [[0.0; G]; 2],
            },
            wishes: [[0.0; G]; 2],
            is_warm: false,
        }
    }

    /// Force and derivatives at a relative eccentricity below 1, for a motion along and across the line
    /// of centres, and whether the fronts settled.
    pub(super) fn force(&mut self, eps: f64, motion: [f64; 2]) -> (AlignedForce, bool) {
        // A film at rest is the one that would form as the gap closes.
        let is_at_rest = motion == [0.0; 2];
        let driven = if is_at_rest { [1.0, 0.0] } else { motion };
        self.begin(eps, driven);
        let mut settled = self.settle();
        if !settled && self.is_warm {
            self.is_warm = false;
            self.begin(eps, driven);
            settled = self.settle();
        }
        self.is_warm = settled;
        let mut found = self.tangents();
        if is_at_rest {
            found.force = [0.0; 2];
            found.by_eccentricity = [0.0; 2];
        }
        (found, settled)
    }

    /// Fronts to begin with: those of the last film if it was a similar one.
    fn begin(&mut self, eps: f64, motion: [f64; 2]) {
        let turn = cross(self.motion, motion).atan2(dot(self.motion, motion));
        let near = (eps - self.eps).abs() < 0.3 * (1.0 - eps) && turn.abs() < 0.3;
        self.eps = eps;
        self.motion = motion;
        self.map = SommerfeldAngle::new(eps, self.accuracy.modulus);
        if !(self.is_warm && near) {
            let reach = FRAC_PI_2 + FIRST_REACH;
            self.wishes = [[-reach; G], [reach; G]];
            self.is_warm = false;
        }
    }

    /// Updates until a further one would not change the force.
    fn settle(&mut self) -> bool {
        let tolerance = self.accuracy.tolerance;
        let mut terms = self.accuracy.terms.min(3);
        let (mut before, mut last_change) = ([0.0; 2], f64::INFINITY);
        for update in 0..MOST_UPDATES {
            self.fronts = self.fit.fit(&self.wishes, terms);
            if !self.solve() {
                return false;
            }
            let force = self.force_of_answers();
            let size = force[0].hypot(force[1]);
            let change = (force[0] - before[0]).hypot(force[1] - before[1]) / size;
            let shift = self.move_fronts(terms);
            // The force follows the fronts to second order, and so do its changes one another.
            let by_shift = self.aspect.max(1.0) * shift * shift;
            let by_change = (change * change / last_change).max(0.1 * change);
            let is_done = by_shift < tolerance || (update > 1 && by_change < tolerance);
            if terms == self.accuracy.terms && is_done {
                return true;
            }
            if shift < 0.05 || update > 3 {
                terms = self.accuracy.terms;
            }
            (before, last_change) = (force, change);
        }
        last_change < 10.0 * tolerance
    }

    /// Lets the fronts go where the flux across them is used up; how far they move, rad (mean square).
    fn move_fronts(&mut self, terms: usize) -> f64 {
        let speed = self.motion[0].hypot(self.motion[1]);
        let mut wishes = [[0.0; G]; 2];
        for g in 0..G {
            for side in 0..2 {
                let (at, slope) = (self.fronts.angles[side][g], self.fronts.slopes[side][g]);
                let steep = 1.0 + (self.aspect * slope * slope).min(SLOPE_CAP);
                let used = at.sin() + steep * self.flux(side, g) / speed;
                let beyond = std::f64::consts::PI - used.clamp(-1.0, 1.0).asin();
                let wish = if side == 1 { beyond } else { beyond - TAU };
                wishes[side][g] = at + (wish - at).clamp(-LONGEST_MOVE, LONGEST_MOVE);
            }
            let over = wishes[1][g] - wishes[0][g] - (TAU - LEAST_RUPTURE);
            if over > 0.0 {
                wishes[0][g] += 0.5 * over;
                wishes[1][g] -= 0.5 * over;
            }
        }
        self.wishes = wishes;
        let next = self.fit.fit(&wishes, terms);
        let moved = |side: usize| -> f64 {
            let change =
                std::array::from_fn(|g| next.angles[side][g] - self.fronts.angles[side][g]);
            self.fit.size(&change)
        };
        moved(0).hypot(moved(1))
    }

    /// Angle of the motion from the line of centres, rad.
    fn direction(&self) -> f64 {
        self.motion[1].atan2(self.motion[0])
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The film for tables against one with more of everything, over all directions.
    #[test]
    fn the_fine_film_is_within_2e_5() {
        for d_over_b in [4.0, 1.0, 2.0 / 3.0] {
            let accuracy = |elements, degree| Accuracy {
                elements,
                degree,
                terms: 4,
                modulus: 0.96,
                tolerance: 1e-7,
            };
            let mut fine = FittedFilm::<7, 9>::new(d_over_b, accuracy(8, 7));
            let mut finer = FittedFilm::<9, 11>::new(d_over_b, accuracy(10, 8));
            for eps in [0.2, 0.8, 0.95, 0.99] {
                for k in 0..6 {
                    let direction = 0.2 + TAU * f64::from(k) / 6.0;
                    let motion = [direction.cos(), direction.sin()];
                    let (seen, settled) = fine.force(eps, motion);
                    let (exact, exact_settled) = finer.force(eps, motion);
                    assert!(settled && exact_settled, "{d_over_b} {eps} {direction}");
                    let [a, b] = [0, 1].map(|i| seen.force[i] - exact.force[i]);
                    let error = a.hypot(b) / exact.force[0].hypot(exact.force[1]);
                    assert!(error < 2e-5, "{d_over_b} {eps} {direction}: {error}");
                }
            }
        }
    }
}
