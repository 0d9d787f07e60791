//! What does an infinitely long bearing put on a journal that moves in any way?
//!
//! Equation: `d/dphi(h^3/(12 eta R^2) dp/dphi) = -w.n`, w the effective velocity (velocity - mean
//! speed x eccentricity), n the unit vector at phi. Once integrated, with N = (sin phi, -cos phi):
//! `dp/dphi = 12 eta R^2 (C - w.N)/h^3`, `C = -3 c (e x w)/(2 c^2 + e^2)` from periodicity.
//! Level: p = 0 where w.n = 0, on the one of these two lines that has the wider gap; negative
//! pressure is cut (Gumbel). For a steady bearing that line is the widest gap (half Sommerfeld); a
//! closing or opening gap carries on exactly the half where w.n > 0.
//! Force: `F = -R B integral of p n = R B integral of dp/dphi N` over the arc with p > 0.
//! Tangents: exact; the limits do not contribute (p = 0), the moving line of zero pressure does.
//! Limits: aligned, isoviscous, no side flow, feeds not used; good above B/D of about 2.
//! References: A. Sommerfeld, Z. Math. Phys. 50 (1904) 97; L. Gumbel, Monatsbl. Berl. Bez. VDI
//! (1914) 87.

use super::arc::{ArcRule, Centre};
use super::plain_film::{PlainFilm, cross};
use super::short_bearing_film::wrap;
use crate::{
    Bearing, Capabilities, Conditions, Extreme, FilmError, FilmForce, FilmSummary, JournalState,
    Linearised, Step,
};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Infinitely long half film under wedge and squeeze together.
#[derive(Debug, Clone)]
pub struct LongBearingFilm {
    film: PlainFilm,
    rule: ArcRule,
}

/// The carrying arc of one motion.
struct CarryingArc {
    centre: Centre,
    /// Effective velocity, m/s.
    motion: [f64; 2],
    /// Its size, m/s, and angle, rad.
    speed: f64,
    middle: f64,
    /// Constant of the first integral C, m/s.
    constant: f64,
    from: f64,
    to: f64,
    /// The zero-pressure line given by w.n = 0 starts the arc (else it ends it).
    fixed_at_start: bool,
}

impl LongBearingFilm {
    /// Film of `bearing` at one viscosity [Pa s].
    ///
    /// # Errors
    /// As [`super::ShortBearingFilm::new`].
    pub fn new(bearing: &Bearing, viscosity: f64) -> Result<Self, FilmError> {
        Ok(Self {
            film: PlainFilm::new(bearing, viscosity)?,
            rule: ArcRule::new(),
        })
    }

    /// 12 eta R^2, Pa s m2.
    fn pressure_factor(&self) -> f64 {
        12.0 * self.film.viscosity * self.film.radius.powi(2)
    }

    fn arc(&self, state: &JournalState) -> CarryingArc {
        let centre = Centre::new(state.position, self.film.clearance);
        let motion = PlainFilm::effective_velocity(state);
        let speed = motion[0].hypot(motion[1]);
        let middle = motion[1].atan2(motion[0]);
        let square = centre.eps * centre.eps;
        let constant =
            -3.0 * cross(state.position, motion) / (self.film.clearance * (2.0 + square));
        let (start, end) = (middle - FRAC_PI_2, middle + FRAC_PI_2);
        let mut arc = CarryingArc {
            fixed_at_start: centre.gap(start) >= centre.gap(end),
            centre,
            motion,
            speed,
            middle,
            constant,
            from: start,
            to: end,
        };
        if speed > 0.0 {
            let other = self.other_zero(&arc);
            if arc.fixed_at_start {
                arc.to = other;
            } else {
                arc.from = other;
            }
        }
        arc
    }

    /// Second line of zero pressure, rad: Newton between the peak and the pressure minimum, bracketed.
    fn other_zero(&self, arc: &CarryingArc) -> f64 {
        let peak = arc.peak_offset();
        let (mut positive, mut negative, fixed) = if arc.fixed_at_start {
            (arc.middle + peak, arc.middle + PI - peak, arc.from)
        } else {
            (arc.middle + peak, arc.middle - PI - peak, arc.to)
        };
        let mut angle = if arc.fixed_at_start { arc.to } else { arc.from };
        if (angle - positive) * (angle - negative) >= 0.0 {
            angle = 0.5 * (positive + negative);
        }
        for _ in 0..200 {
            let pressure = self.scaled_pressure(arc, fixed, angle);
            if pressure > 0.0 {
                positive = angle;
            } else {
                negative = angle;
            }
            let newton = angle - pressure / arc.scaled_slope(angle);
            let inside = (newton - positive) * (newton - negative) < 0.0;
            let next = if inside {
                newton
            } else {
                0.5 * (positive + negative)
            };
            let change = (next - angle).abs();
            angle = next;
            if change < 1e-15 {
                break;
            }
        }
        angle
    }

    /// Pressure over 12 eta R^2 at `angle`, zero at `fixed`.
    fn scaled_pressure(&self, arc: &CarryingArc, fixed: f64, angle: f64) -> f64 {
        let (from, to, sign) = if angle >= fixed {
            (fixed, angle, 1.0)
        } else {
            (angle, fixed, -1.0)
        };
        let sum: f64 = self
            .rule
            .nodes(&arc.centre, from, to)
            .iter()
            .map(|node| {
                let along = arc.motion[0] * node.normal[1] - arc.motion[1] * node.normal[0];
                node.weight * (arc.constant - along) / node.gap.powi(3)
            })
            .sum();
        sign * sum
    }
}

impl CarryingArc {
    /// Slope of the pressure over 12 eta R^2 at `angle`.
    fn scaled_slope(&self, angle: f64) -> f64 {
        (self.constant - self.speed * (angle - self.middle).sin()) / self.centre.gap(angle).powi(3)
    }

    /// Angle from the motion to the pressure peak, rad.
    fn peak_offset(&self) -> f64 {
        (self.constant / self.speed).clamp(-1.0, 1.0).asin()
    }

    /// d(C)/d(position) at fixed motion and d(C)/d(motion).
    fn constant_derivatives(&self, position: [f64; 2]) -> ([f64; 2], [f64; 2]) {
        let clearance = self.centre.clearance;
        let denominator = clearance * (2.0 + self.centre.eps * self.centre.eps);
        let [x, y] = position;
        let [wx, wy] = self.motion;
        let shrink = 2.0 * self.constant / (clearance * denominator);
        (
            [
                -3.0 * wy / denominator - shrink * x,
                3.0 * wx / denominator - shrink * y,
            ],
            [3.0 * y / denominator, -3.0 * x / denominator],
        )
    }
}

/// Sums over the arc that force and tangents are made of, without the factor 12 eta R^3 B.
#[derive(Default)]
struct ArcSums {
    force: [f64; 2],
    /// Integral of d(slope), per position and per motion component.
    rise: [[f64; 2]; 2],
    /// Integral of d(slope) N, `[kind][row][column]`.
    moment: [[[f64; 2]; 2]; 2],
}

impl FilmForce for LongBearingFilm {
    fn capabilities(&self) -> Capabilities {
        PlainFilm::capabilities()
    }

    fn minimum_gap(&self, state: &JournalState) -> f64 {
        self.film.minimum_gap(state)
    }

    fn linearise(
        &mut self,
        state: &JournalState,
        _step: Step,
        _conditions: &Conditions<'_>,
    ) -> Result<Linearised, FilmError> {
        self.film.check(state)?;
        let arc = self.arc(state);
        let factor = self.pressure_factor() * self.film.radius * self.film.width;
        let sums = self.sums(&arc, state.position);
        let [by_position, by_motion] = arc.derivatives(&sums);
        let force = sums.force.map(|value| factor * value);
        let scaled = |matrix: [[f64; 2]; 2]| matrix.map(|row| row.map(|value| factor * value));
        Ok(self
            .film
            .answer(state, force, scaled(by_position), scaled(by_motion)))
    }

    fn summary(&self) -> FilmSummary {
        let Some(state) = self.film.last_state() else {
            return FilmSummary::default();
        };
        let arc = self.arc(state);
        if arc.speed == 0.0 {
            return self.film.summary(Extreme::default(), 0.0, 0.0);
        }
        let angle = arc.middle + arc.peak_offset();
        let fixed = if arc.fixed_at_start { arc.from } else { arc.to };
        let peak = Extreme {
            value: self.pressure_factor() * self.scaled_pressure(&arc, fixed, angle),
            angle: wrap(angle),
            axial: 0.0,
        };
        // An infinitely long film has no ends, so no side flow.
        self.film.summary(peak, 0.0, (arc.to - arc.from) / TAU)
    }

    fn accept_step(&mut self) {
        self.film.restart_count();
    }

    fn reject_step(&mut self) {
        self.film.restart_count();
    }
}

impl LongBearingFilm {
    fn sums(&self, arc: &CarryingArc, position: [f64; 2]) -> ArcSums {
        let (by_position, by_motion) = arc.constant_derivatives(position);
        let mut sums = ArcSums::default();
        for node in self.rule.nodes(&arc.centre, arc.from, arc.to) {
            let primitive = [node.normal[1], -node.normal[0]];
            let share = node.weight / node.gap.powi(3);
            let rest = arc.constant - arc.motion[0] * primitive[0] - arc.motion[1] * primitive[1];
            for column in 0..2 {
                let slopes = [
                    by_position[column] + 3.0 * rest * node.normal[column] / node.gap,
                    by_motion[column] - primitive[column],
                ];
                sums.force[column] += share * rest * primitive[column];
                for (kind, slope) in slopes.iter().enumerate() {
                    sums.rise[kind][column] += share * slope;
                    for (row, value) in primitive.iter().enumerate() {
                        sums.moment[kind][row][column] += share * slope * value;
                    }
                }
            }
        }
        sums
    }
}

impl CarryingArc {
    /// d(F) = -[dp N] + integral of d(slope) N, with dp at the fixed line from its own shift (it
    /// turns with the motion) and at the other end from there on.
    fn derivatives(&self, sums: &ArcSums) -> [[[f64; 2]; 2]; 2] {
        let fixed = if self.fixed_at_start {
            self.from
        } else {
            self.to
        };
        let slope = self.scaled_slope(fixed);
        let square = (self.speed * self.speed).max(f64::MIN_POSITIVE);
        let turn = [-self.motion[1] / square, self.motion[0] / square];
        let primitive = |angle: f64| [angle.sin(), -angle.cos()];
        let (first, last) = (primitive(self.from), primitive(self.to));
        let mut derivatives = [[[0.0; 2]; 2]; 2];
        for (kind, derivative) in derivatives.iter_mut().enumerate() {
            for column in 0..2 {
                let shift = if kind == 1 {
                    -slope * turn[column]
                } else {
                    0.0
                };
                let rise = sums.rise[kind][column];
                let (at_first, at_last) = if self.fixed_at_start {
                    (shift, shift + rise)
                } else {
                    (shift - rise, shift)
                };
                for row in 0..2 {
                    derivative[row][column] = sums.moment[kind][row][column] - at_last * last[row]
                        + at_first * first[row];
                }
            }
        }
        derivatives
    }
}
