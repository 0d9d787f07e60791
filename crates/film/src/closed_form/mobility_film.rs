//! What does Booker's mobility say the film puts on a moving journal?
//!
//! Equation: the load `L` on the film moves the journal at the effective velocity
//! `w = velocity - mean speed x eccentricity = c psi^2/(eta B D) |L| M`, with M Booker's closed-form
//! mobility in the frame of the load ([`super::short::booker_mobility`]). The film is asked the other
//! way round (impedance): given w, the load direction follows from one monotone scalar equation
//! `b + atan(4 eps sin b/(pi (1 - eps cos b))) = angle from w to the line of centres`, b the angle
//! from the load to the line of centres; then |L| from the length of w. Force on the journal: -L.
//! Tangents: exact, by implicit differentiation of `w = N(eccentricity, L)`.
//! Limits: an approximation of the short half film (5-8 % in mobility at eps 0.8-0.9); aligned,
//! isoviscous. Peak pressure and side flow are those of the short film at the same motion.
//! Reference: J. F. Booker, J. Basic Eng. 87 (1965) 537, 10.1115/1.3650602.

use super::plain_film::PlainFilm;
use super::short::booker_mobility;
use super::short_bearing_film::{short_summary, wrap};
use crate::{
    Bearing, Capabilities, Conditions, FilmError, FilmForce, FilmSummary, JournalState, Linearised,
    Step,
};
use std::f64::consts::PI;

/// Booker's closed-form mobility as a film model.
#[derive(Debug, Clone)]
pub struct MobilityFilm {
    film: PlainFilm,
}

impl MobilityFilm {
    /// Film of `bearing` at one viscosity [Pa s].
    ///
    /// # Errors
    /// As [`super::ShortBearingFilm::new`].
    pub fn new(bearing: &Bearing, viscosity: f64) -> Result<Self, FilmError> {
        Ok(Self {
            film: PlainFilm::new(bearing, viscosity)?,
        })
    }

    /// Velocity per mobility and load, m/(s N): `c psi^2/(eta B D)`, divided by (B/D)^2 because the
    /// mobility formula is multiplied by it.
    fn velocity_scale(&self) -> f64 {
        let diameter = 2.0 * self.film.radius;
        let psi = self.film.clearance / self.film.radius;
        let width_ratio = self.film.width / diameter;
        self.film.clearance * psi * psi
            / (self.film.viscosity * self.film.width * diameter * width_ratio * width_ratio)
    }
}

impl FilmForce for MobilityFilm {
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
        let scale = self.velocity_scale();
        let motion = PlainFilm::effective_velocity(state);
        let eps = state.eccentricity() / self.film.clearance;
        let line = state.line_of_centres_angle();
        let from_motion = wrap(line - motion[1].atan2(motion[0]));
        let to_line = load_to_line_of_centres(eps, from_motion);
        let frame = LoadFrame::new(eps, to_line, line - to_line);
        let load =
            motion[0].hypot(motion[1]) / (scale * frame.mobility[0].hypot(frame.mobility[1]));

        // d(load vector) = N_L^-1 (d motion/scale - N_e d position).
        let inverse = frame.velocity_by_load_inverse();
        let by_position = multiply(
            inverse,
            frame.velocity_by_eccentricity(load / self.film.clearance),
        );
        let by_velocity = inverse.map(|row| row.map(|value| -value / scale));
        let force = frame.along.map(|component| -load * component);
        Ok(self.film.answer(state, force, by_position, by_velocity))
    }

    fn summary(&self) -> FilmSummary {
        short_summary(&self.film)
    }

    fn accept_step(&mut self) {
        self.film.restart_count();
    }

    fn reject_step(&mut self) {
        self.film.restart_count();
    }
}

/// Angle from the load to the line of centres, rad, for the angle from the motion to the line of
/// centres. The left side rises monotonically from 0 to pi; Newton with a bracket as safeguard.
fn load_to_line_of_centres(eps: f64, from_motion: f64) -> f64 {
    let target = from_motion.abs();
    let (mut low, mut high) = (0.0, PI);
    let mut angle = 0.5 * target;
    for _ in 0..200 {
        let (sin, cos) = angle.sin_cos();
        let gap = 1.0 - eps * cos;
        let tangent = 4.0 / PI * eps * sin / gap;
        let slope = 1.0 + 4.0 / PI * eps * (cos - eps) / (gap * gap) / (1.0 + tangent * tangent);
        let excess = angle + tangent.atan() - target;
        if excess > 0.0 {
            high = angle;
        } else {
            low = angle;
        }
        let newton = angle - excess / slope;
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        let change = (next - angle).abs();
        angle = next;
        if change <= 1e-16 * (1.0 + angle) {
            break;
        }
    }
    angle.copysign(from_motion)
}

/// Mobility and its derivatives in the frame of the load.
struct LoadFrame {
    /// Unit vector of the load, shell frame.
    along: [f64; 2],
    /// 90 degrees ahead of it.
    across: [f64; 2],
    /// Relative eccentricity in this frame.
    xi: f64,
    eta: f64,
    /// Mobility along and across, times (B/D)^2.
    mobility: [f64; 2],
    by_xi: [f64; 2],
    by_eta: [f64; 2],
}

impl LoadFrame {
    fn new(eps: f64, to_line: f64, load_angle: f64) -> Self {
        let (sin, cos) = load_angle.sin_cos();
        let (xi, eta) = (eps * to_line.cos(), eps * to_line.sin());
        let gap = 1.0 - xi;
        Self {
            along: [cos, sin],
            across: [-sin, cos],
            xi,
            eta,
            mobility: booker_mobility(xi, eta),
            by_xi: [
                -2.5 * gap.powf(1.5) / PI,
                6.0 * eta * gap.sqrt() / (PI * PI),
            ],
            by_eta: [0.0, -4.0 * gap.powf(1.5) / (PI * PI)],
        }
    }

    /// Vector of this frame's components in the shell frame.
    fn to_shell(&self, [along, across]: [f64; 2]) -> [f64; 2] {
        [
            along * self.along[0] + across * self.across[0],
            along * self.along[1] + across * self.across[1],
        ]
    }

    /// Inverse of dN/dL with N = |L| M: one column per |L| (M itself) and one per turn of the load
    /// (xi changes by eta, eta by -xi, and the frame turns).
    fn velocity_by_load_inverse(&self) -> [[f64; 2]; 2] {
        let turn = [
            self.by_xi[0] * self.eta - self.by_eta[0] * self.xi - self.mobility[1],
            self.by_xi[1] * self.eta - self.by_eta[1] * self.xi + self.mobility[0],
        ];
        let determinant = self.mobility[0] * turn[1] - self.mobility[1] * turn[0];
        let in_frame = [
            [turn[1] / determinant, -turn[0] / determinant],
            [
                -self.mobility[1] / determinant,
                self.mobility[0] / determinant,
            ],
        ];
        self.tensor_to_shell(in_frame)
    }

    /// dN/d(position), with `factor` = load over clearance.
    fn velocity_by_eccentricity(&self, factor: f64) -> [[f64; 2]; 2] {
        self.tensor_to_shell([
            [factor * self.by_xi[0], factor * self.by_eta[0]],
            [factor * self.by_xi[1], factor * self.by_eta[1]],
        ])
    }

    /// Second-order tensor of this frame in the shell frame.
    fn tensor_to_shell(&self, tensor: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        let first = self.to_shell([tensor[0][0], tensor[1][0]]);
        let second = self.to_shell([tensor[0][1], tensor[1][1]]);
        [0, 1].map(|row| self.to_shell([first[row], second[row]]))
    }
}

fn multiply(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    [0, 1].map(|row| [0, 1].map(|column| a[row][0] * b[0][column] + a[row][1] * b[1][column]))
}
