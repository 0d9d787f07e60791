//! What pressure has an aligned film that ruptures smoothly (Reynolds, Swift and Stieber)?
//!
//! ```text
//! -(H^3 p_theta)_theta - (D/B)^2 (H^3 p_Z)_Z = w n     where p > 0,  theta in (a(Z), b(Z)), |Z| < 1
//! p = 0 all around it;   H^3 p_theta = 0 at a and b    which places the fronts
//! ```
//! The film is mapped onto a rectangle between its fronts, where pressure is smooth: elements of high
//! degree around, even polynomials across. The pressure that is zero on a front which is off by d is right
//! to order d^2, and so is the force. The front belongs where the flux across it has been used up by the
//! sink behind it,
//!
//! ```text
//! |w| (sin(theta' - omega) - sin(theta - omega)) = (1 + (D/B)^2 front'^2) H^3 p_theta
//! ```
//! with omega the angle of the motion. Two ways to settle the fronts: each line by itself until the force
//! no longer feels it (`linewise`), for tables; all together by Newton's method until nothing is left of
//! their conditions, the mean flux weighted with each term of a front, with a force whose derivatives are
//! exact (`joint`, `moving`), on line.
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
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub(super) use joint::JointFilm;
pub(super) use linewise::LinewiseFilm;

mod figures;
mod fronts;
mod joint;
mod linewise;
mod moving;
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

/// Film of an aligned journal between given fronts; `M` shapes across, `G` lines on half the width.
#[derive(Debug, Clone)]
pub(super) struct FittedFilm<const M: usize, const G: usize> {
    /// (D/B)^2.
    aspect: f64,
    accuracy: Accuracy,
    shapes: Shapes<M, G>,
    element: Element,
    /// Where elements meet, as a part of the way between the fronts.
    breaks: Vec<f64>,
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
    /// Its fronts, from the direction of motion.
    fronts: Fronts<G>,
}

/// What a fitted film is asked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Accuracy {
    /// Elements around.
    pub elements: usize,
    /// Their degree.
    pub degree: usize,
    /// How long the elements at the fronts are, over the others.
    pub end: f64,
    pub crowding: Crowding,
    /// Error of the force over its size that fronts may leave.
    pub tolerance: f64,
}

/// How nodes crowd in the narrowest gap: the modulus of the substitution.
#[derive(Debug, Clone, Copy)]
pub(super) enum Crowding {
    /// A share of the relative eccentricity.
    Share(f64),
    /// [`SommerfeldAngle::graded`] with this power: less than the gap asks for as it closes, so that nodes are left
    /// for a front in the widest gap.
    Graded(f64),
}

impl Crowding {
    fn at(self, eps: f64) -> SommerfeldAngle {
        match self {
            Self::Share(share) => SommerfeldAngle::new(eps, share),
            Self::Graded(power) => SommerfeldAngle::graded(eps, power),
        }
    }
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
    fn new(d_over_b: f64, accuracy: Accuracy) -> Self {
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
            breaks: breaks(elements, accuracy.end),
            fit: FrontFit::new(),
            matrix: ProfileMatrix::new(starts),
            sources: vec![[0.0; 2]; nodes * M],
            answers: vec![[0.0; 2]; nodes * M],
            points: vec![strip::Point::default(); elements * (degree + 1) * G],
            map: accuracy.crowding.at(0.0),
            eps: 0.0,
            motion: [1.0, 0.0],
            fronts: Fronts {
                angles: [[0.0; G]; 2],
                slopes: [[0.0; G]; 2],
            },
        }
    }

    /// Goes to another state; by what the relative eccentricity rises and the motion turns, rad, if its
    /// film is similar to the last.
    fn go_to(&mut self, eps: f64, motion: [f64; 2]) -> Option<[f64; 2]> {
        let turn = cross(self.motion, motion).atan2(dot(self.motion, motion));
        let rise = eps - self.eps;
        self.eps = eps;
        self.motion = motion;
        self.map = self.accuracy.crowding.at(eps);
        (rise.abs() < 0.3 * (1.0 - eps) && turn.abs() < 0.3).then_some([rise, turn])
    }

    /// Where each line would have its fronts, rad: where the flux across them is used up.
    fn wishes(&self) -> [[f64; G]; 2] {
        let speed = self.motion[0].hypot(self.motion[1]);
        let mut wishes = [[0.0; G]; 2];
        for g in 0..G {
            for side in 0..2 {
                let (at, slope) = (self.fronts.angles[side][g], self.fronts.slopes[side][g]);
                let steep = 1.0 + (self.aspect * slope * slope).min(SLOPE_CAP);
                let used = at.sin() + steep * dot(self.fluxes(side, g), self.motion) / speed;
                let beyond = PI - used.clamp(-1.0, 1.0).asin();
                let wish = if side == 1 { beyond } else { beyond - TAU };
                wishes[side][g] = at + (wish - at).clamp(-LONGEST_MOVE, LONGEST_MOVE);
            }
            let over = wishes[1][g] - wishes[0][g] - (TAU - LEAST_RUPTURE);
            if over > 0.0 {
                wishes[0][g] += 0.5 * over;
                wishes[1][g] -= 0.5 * over;
            }
        }
        wishes
    }

    /// Angle of the motion from the line of centres, rad.
    fn direction(&self) -> f64 {
        self.motion[1].atan2(self.motion[0])
    }

    /// Derivatives by the motion: of degree 1 in its size, and by its direction.
    fn by_motion(&self, force: [f64; 2], by_turn: [f64; 2]) -> [[f64; 2]; 2] {
        let per_square = 1.0 / dot(self.motion, self.motion);
        let [along, across] = self.motion.map(|part| part * per_square);
        [0, 1].map(|row| {
            [
                force[row] * along - by_turn[row] * across,
                force[row] * across + by_turn[row] * along,
            ]
        })
    }
}

/// Where elements meet, those at the fronts shorter than the others by a factor.
fn breaks(elements: usize, end: f64) -> Vec<f64> {
    let last = elements - 1;
    let size = |element: usize| {
        if element == 0 || element == last {
            end
        } else {
            1.0
        }
    };
    let whole: f64 = (0..elements).map(size).sum();
    let mut at = 0.0;
    let inner = (0..last).map(|element| {
        at += size(element);
        at / whole
    });
    std::iter::once(0.0).chain(inner).chain([1.0]).collect()
}

/// Where the fronts of a film are thought to be that nothing is known of, rad.
const fn first_wishes<const G: usize>() -> [[f64; G]; 2] {
    let reach = FRAC_PI_2 + FIRST_REACH;
    [[-reach; G], [reach; G]]
}

/// A film at rest is the one that would form as the gap closes: the motion to solve for.
fn driven(motion: [f64; 2]) -> [f64; 2] {
    if motion == [0.0; 2] {
        [1.0, 0.0]
    } else {
        motion
    }
}

/// What of its answer is left at rest.
fn at_rest(found: AlignedForce) -> AlignedForce {
    AlignedForce {
        force: [0.0; 2],
        by_eccentricity: [0.0; 2],
        ..found
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
                end: 1.0,
                crowding: Crowding::Share(0.96),
                tolerance: 1e-7,
            };
            let mut fine = LinewiseFilm::<7, 9>::new(d_over_b, accuracy(8, 7), 4);
            let mut finer = LinewiseFilm::<9, 11>::new(d_over_b, accuracy(10, 8), 4);
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
