//! One film on a sequence of rings, each with twice the columns of the one before.

use super::ring::Ring;
use sommerfeld_film::Cavitation;

/// Bearing and position of a film without dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmCase {
    /// Relative eccentricity, 0 to below 1.
    pub eccentricity: f64,
    /// Width over diameter.
    pub width_ratio: f64,
    /// Closure, `gumbel` or `reynolds`.
    pub closure: Cavitation,
    /// The pressure is zero on the line of the widest gap.
    pub line: bool,
}

/// What one ring answers to a unit effective velocity.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Answer {
    /// Force along and across the line of centres, over `eta |w| R^3 B / (2 c^3)`.
    pub force: [f64; 2],
    /// Derivatives of the force by the relative eccentricity at fixed direction from the line of
    /// centres, at the set of this film.
    pub by_eccentricity: [f64; 2],
    /// Derivatives of the force by the angle of the effective velocity.
    pub by_angle: [f64; 2],
    /// Largest pressure over `eta |w| R^2 / c^3`.
    pub peak: f64,
    /// Its angle from the narrowest gap, rad, -pi to pi.
    pub peak_angle: f64,
    /// Oil leaving at each end over `|w| R B`.
    pub side_flow: f64,
    /// Share of the bearing area under pressure.
    pub full_film_share: f64,
}

/// Films of one case on rings with a given number of nodes across the width.
pub(super) trait Columns: Send {
    /// Answer at `level` (columns doubled that often), or `None` if its set does not settle. The level
    /// below must have been solved for this angle just before. Derivatives only if asked for.
    fn answer(&mut self, level: usize, angle: f64, tangents: bool) -> Option<Answer>;
}

/// Columns of the coarsest ring.
pub(super) const COARSEST: usize = 32;

/// Updates of the set of one ring; a start from the ring below needs about four.
const MOST_UPDATES: usize = 80;

/// Corrections of a rupture boundary that lies between two columns.
const BOUNDARY_STEPS: usize = 2;
/// Largest change of the pressure beyond a boundary per change of that before it.
const STEEPEST: f64 = 20.0;

pub(super) struct Rings<const M: usize> {
    case: FilmCase,
    rings: Vec<Level<M>>,
}

struct Level<const M: usize> {
    ring: Ring<M>,
    /// Pressure to unit velocity along and across, before it is cut: `gumbel` only.
    full: Option<[Vec<[f64; M]>; 2]>,
    pressure: Vec<[f64; M]>,
}

impl<const M: usize> Rings<M> {
    pub fn new(case: FilmCase) -> Self {
        Self {
            case,
            rings: Vec::new(),
        }
    }

    fn prepare(&mut self, level: usize) {
        while self.rings.len() <= level {
            let count = COARSEST << self.rings.len();
            let case = &self.case;
            let mut ring = Ring::new(count, case.eccentricity, 1.0 / case.width_ratio);
            if case.line {
                ring.set[count / 2] = 0;
            }
            self.rings.push(Level {
                ring,
                full: None,
                pressure: vec![[0.0; M]; count],
            });
        }
    }

    /// Start of a set: that of the ring below, or where the walls approach.
    fn start(&mut self, level: usize, angle: f64) {
        let (below, own) = self.rings.split_at_mut(level);
        let ring = &mut own[0].ring;
        let count = ring.count();
        for k in 0..count {
            ring.set[k] = match below.last() {
                Some(below) => {
                    let set = &below.ring.set;
                    let next = set[(k / 2 + k % 2) % set.len()];
                    set[k / 2] | next
                }
                None if ring.cos[k] * angle.cos() + ring.sin[k] * angle.sin() > 0.0 => {
                    Ring::<M>::ALL
                }
                None => 0,
            };
        }
        if self.case.line {
            ring.set[count / 2] = 0;
        }
    }
}

impl<const M: usize> Columns for Rings<M> {
    fn answer(&mut self, level: usize, angle: f64, tangents: bool) -> Option<Answer> {
        self.prepare(level);
        let line = self.case.line;
        if self.case.closure == Cavitation::Gumbel {
            let own = &mut self.rings[level];
            own.superpose(angle);
            return Some(own.cut_answer(angle, tangents));
        }
        self.start(level, angle);
        let own = &mut self.rings[level];
        own.complementary(angle, line)
            .then(|| own.answer(angle, tangents))
    }
}

/// Force of the film without rupture on a coarse ring: along for a closing gap, across for a sliding
/// journal.
pub(super) fn full_forces<const M: usize>(case: &FilmCase) -> [f64; 2] {
    let count = 4 * COARSEST;
    let ring = Ring::<M>::new(count, case.eccentricity, 1.0 / case.width_ratio);
    let mut level = Level {
        ring,
        full: None,
        pressure: vec![[0.0; M]; count],
    };
    level.superpose(0.0);
    let whole = vec![[1.0; M]; count];
    let mut forces = [0.0; 2];
    if let Some(full) = &level.full {
        for (own, pressure) in full.iter().enumerate() {
            forces[own] = level.force(pressure, &whole)[own];
        }
    }
    forces
}

impl<const M: usize> Level<M> {
    /// Right side of a unit velocity at an angle.
    fn source(&self, k: usize, angle: f64) -> [f64; M] {
        let ring = &self.ring;
        let approach = ring.cos[k] * angle.cos() + ring.sin[k] * angle.sin();
        ring.weights()
            .map(|weight| 12.0 * approach * ring.share[k] * weight)
    }

    fn sources(&self, angle: f64) -> Vec<[f64; M]> {
        (0..self.ring.count())
            .map(|k| self.source(k, angle))
            .collect()
    }

    /// Full pressure of `gumbel`: a sum of the two of along and across.
    fn superpose(&mut self, angle: f64) {
        if self.full.is_none() {
            self.ring.factorise();
            self.full = Some([0.0, std::f64::consts::FRAC_PI_2].map(|angle| {
                let mut x = self.sources(angle);
                self.ring.solve(&mut x);
                x
            }));
        }
        let (sin, cos) = angle.sin_cos();
        if let Some([along, across]) = &self.full {
            for (own, (along, across)) in self.pressure.iter_mut().zip(along.iter().zip(across)) {
                *own = std::array::from_fn(|j| cos * along[j] + sin * across[j]);
            }
        }
    }

    /// `reynolds`: the set on which the pressure is positive while elsewhere the walls would only
    /// pull. False if it does not settle.
    fn complementary(&mut self, angle: f64, line: bool) -> bool {
        let count = self.ring.count();
        self.ring.beyond.fill([0.0; M]);
        for update in 0..MOST_UPDATES {
            self.ring.factorise();
            self.pressure = self.sources(angle);
            self.ring.solve(&mut self.pressure);
            let highest = self
                .pressure
                .iter()
                .flatten()
                .fold(0.0, |a: f64, p| a.max(*p));
            let mut changed = false;
            for k in 0..count {
                if line && k == count / 2 {
                    continue;
                }
                let source = self.source(k, angle);
                let operated = self.ring.operate(&self.pressure, k, false);
                for j in 0..M {
                    let inside = self.ring.set[k] >> j & 1 == 1;
                    // Late updates only take away: a node that comes and goes has no pressure.
                    let flips = if inside {
                        self.pressure[k][j] < -1e-13 * highest
                    } else {
                        let weight = self.ring.share[k] * self.ring.weights()[j];
                        update < MOST_UPDATES / 2 && source[j] - operated[j] > 1e-11 * weight
                    };
                    if flips {
                        self.ring.set[k] ^= 1 << j;
                        changed = true;
                    }
                }
            }
            if !changed {
                for _ in 0..BOUNDARY_STEPS {
                    self.fit_boundary(angle);
                }
                return true;
            }
        }
        false
    }

    /// The rupture boundary lies between two columns: behind it the pressure would go on as the parabola
    /// that touches zero there, which is what the last column in the film sees instead of zero.
    fn fit_boundary(&mut self, angle: f64) {
        let n = self.ring.count();
        let mut right = self.sources(angle);
        let mut beyond = vec![[0.0; M]; n];
        for (k, (right, beyond)) in right.iter_mut().zip(&mut beyond).enumerate() {
            let (before, after) = ((k + n - 1) % n, (k + 1) % n);
            for (inner, outer, face) in [(before, after, k), (after, before, before)] {
                for (j, (right, beyond)) in right.iter_mut().zip(beyond.iter_mut()).enumerate() {
                    if let Some((slope, value)) = self.parabola([inner, k, outer], j) {
                        let stiffness = self.ring.face(face, j);
                        *beyond += stiffness * slope;
                        *right += stiffness * value;
                    }
                }
            }
        }
        self.ring.beyond = beyond;
        self.ring.factorise();
        self.ring.solve(&mut right);
        self.pressure = right;
    }

    /// Where the film ends between the second and the third of three columns: minus the derivative of the
    /// pressure beyond the boundary by that before it, and what it would be with that at zero.
    fn parabola(&self, [inner, k, outer]: [usize; 3], j: usize) -> Option<(f64, f64)> {
        let inside = |k: usize| self.ring.set[k] >> j & 1 == 1;
        if !inside(k) || inside(outer) || !inside(inner) {
            return None;
        }
        let root = |k: usize| self.pressure[k][j].max(0.0).sqrt();
        let (own, next) = (root(k), root(inner));
        let beyond = 2.0 * own - next;
        if beyond >= 0.0 {
            return None;
        }
        let slope = (-beyond / own.max(1e-3 * next)).min(STEEPEST);
        Some((slope, beyond * beyond + slope * own * own))
    }

    /// Part of the length of column `k` that its node `j` stands for, where the pressure is cut at
    /// zero between two columns.
    fn kept(&self, k: usize, j: usize) -> f64 {
        let n = self.ring.count();
        let own = self.pressure[k][j];
        if own <= 0.0 {
            return 0.0;
        }
        let lost = |other: usize| {
            let other = self.pressure[other][j];
            if other < 0.0 {
                0.5 * other / (other - own)
            } else {
                0.0
            }
        };
        1.0 - lost((k + 1) % n) - lost((k + n - 1) % n)
    }

    /// Derivative of what a node counts, pressure times [`Level::kept`] of itself and its neighbours, by
    /// its pressure.
    fn kept_change(&self, k: usize, j: usize) -> f64 {
        let n = self.ring.count();
        let own = self.pressure[k][j];
        let sides = [(k + 1) % n, (k + n - 1) % n].map(|other| self.pressure[other][j]);
        if own > 0.0 {
            let lost = |other: f64| {
                if other < 0.0 {
                    0.5 * (other / (other - own)).powi(2)
                } else {
                    0.0
                }
            };
            1.0 - lost(sides[0]) - lost(sides[1])
        } else {
            let gained = |other: f64| {
                if other > 0.0 {
                    0.5 * (other / (other - own)).powi(2)
                } else {
                    0.0
                }
            };
            gained(sides[0]) + gained(sides[1])
        }
    }

    fn cut_answer(&mut self, angle: f64, tangents: bool) -> Answer {
        let count = self.ring.count();
        let each = |of: fn(&Self, usize, usize) -> f64| -> Vec<[f64; M]> {
            (0..count)
                .map(|k| std::array::from_fn(|j| of(self, k, j)))
                .collect()
        };
        let mut answer = self.integrals(&each(Self::kept));
        if tangents {
            let weight = each(Self::kept_change);
            let turned = self.turned(angle);
            let moved = self.moved();
            answer.by_angle = self.force(&turned, &weight);
            answer.by_eccentricity = self.force(&moved, &weight);
        }
        answer
    }

    fn answer(&mut self, angle: f64, tangents: bool) -> Answer {
        let kept = vec![[1.0; M]; self.ring.count()];
        let mut answer = self.integrals(&kept);
        if tangents {
            let turned = self.turned(angle);
            let moved = self.moved();
            answer.by_angle = self.force(&turned, &kept);
            answer.by_eccentricity = self.force(&moved, &kept);
        }
        answer
    }

    /// Derivative of the pressure by the angle of the velocity, at this set.
    fn turned(&self, angle: f64) -> Vec<[f64; M]> {
        let mut x = self.sources(angle + std::f64::consts::FRAC_PI_2);
        self.ring.solve(&mut x);
        x
    }

    /// Derivative of the pressure by the relative eccentricity, at this set.
    fn moved(&self) -> Vec<[f64; M]> {
        let mut x: Vec<[f64; M]> = (0..self.ring.count())
            .map(|k| self.ring.operate(&self.pressure, k, true).map(|v| -v))
            .collect();
        self.ring.solve(&mut x);
        x
    }

    fn force(&self, pressure: &[[f64; M]], kept: &[[f64; M]]) -> [f64; 2] {
        let ring = &self.ring;
        let mut force = [0.0; 2];
        for k in 0..ring.count() {
            let nodes = pressure[k].iter().zip(kept[k]).zip(ring.weights());
            let line: f64 = nodes.map(|((p, kept), weight)| p * kept * weight).sum();
            force[0] -= line * ring.share[k] * ring.cos[k];
            force[1] -= line * ring.share[k] * ring.sin[k];
        }
        force
    }

    fn integrals(&self, kept: &[[f64; M]]) -> Answer {
        let ring = &self.ring;
        let n = ring.count();
        let mut out = Answer {
            force: self.force(&self.pressure, kept),
            ..Answer::default()
        };
        let mut highest = 0;
        for (k, (own, kept)) in self.pressure.iter().zip(kept).enumerate() {
            // (D/B)^2/24 times the integral of -H^3 dP/dZ at the end; `axial` holds the rest.
            let outflow = -ring.axial[k] * ring.end_slope(own) / 24.0;
            out.side_flow += outflow.max(0.0);
            for (j, pressure) in own.iter().enumerate() {
                if *pressure > 0.0 {
                    out.full_film_share += kept[j] * ring.share[k] * ring.weights()[j];
                }
            }
            if own[0] > self.pressure[highest][0] {
                highest = k;
            }
        }
        out.full_film_share /= 4.0 * std::f64::consts::PI;
        let [before, own, after] =
            [n - 1, 0, 1].map(|offset| self.pressure[(highest + offset) % n][0]);
        let bend = before - 2.0 * own + after;
        let shift = if bend < 0.0 {
            0.5 * (before - after) / bend
        } else {
            0.0
        };
        out.peak = own - 0.25 * (before - after) * shift;
        let place = (highest as f64 + shift).rem_euclid(n as f64);
        out.peak_angle = ring.angle(place);
        out
    }
}
