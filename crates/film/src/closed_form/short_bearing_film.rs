//! What does a short bearing put on a journal that moves in any way?
//!
//! Equation: `d/dz(h^3/(12 eta) dp/dz) = mean speed dh/dphi + dh/dt`, so with the effective velocity
//! `w = velocity - mean speed x eccentricity` and the unit vector n at the angle phi
//! `p = 6 eta (w.n) (B^2/4 - z^2)/h^3`, kept where it is positive: exactly the half w.n > 0.
//! Force: `F = -eta B^3 R integral of (w.n) n/h^3`, exact by Gauss-Legendre in the Sommerfeld angle.
//! Tangents: the limits do not contribute, because p = 0 there.
//! Limits: aligned, isoviscous, ends at cavitation pressure, feeds and closure of the bearing are
//! not used (half film always); good below B/D of about 1/4, an estimate up to 1/2.
//! References: F. W. Ocvirk, NACA TN 2808 (1952); J. F. Booker, J. Basic Eng. 87 (1965) 537,
//! 10.1115/1.3650602.

use super::arc::{ArcRule, Centre};
use super::plain_film::PlainFilm;
use crate::{
    Bearing, Capabilities, Conditions, Extreme, FilmError, FilmForce, FilmSummary, JournalState,
    Linearised, Step,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// Short-bearing half film under wedge and squeeze together, exact.
#[derive(Debug, Clone)]
pub struct ShortBearingFilm {
    film: PlainFilm,
    rule: ArcRule,
}

impl ShortBearingFilm {
    /// Film of `bearing` at one viscosity [Pa s].
    ///
    /// # Errors
    /// [`FilmError::Unsupported`] for sizes that are not positive, unequal ambient and cavitation
    /// pressure, or film shear other than full width.
    pub fn new(bearing: &Bearing, viscosity: f64) -> Result<Self, FilmError> {
        Ok(Self {
            film: PlainFilm::new(bearing, viscosity)?,
            rule: ArcRule::new(),
        })
    }
}

impl FilmForce for ShortBearingFilm {
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
        let motion = PlainFilm::effective_velocity(state);
        let middle = motion[1].atan2(motion[0]);
        let centre = Centre::new(state.position, self.film.clearance);
        let factor = -self.film.viscosity * self.film.width.powi(3) * self.film.radius;
        let mut force = [0.0; 2];
        let mut by_position = [[0.0; 2]; 2];
        let mut by_velocity = [[0.0; 2]; 2];
        for node in self
            .rule
            .nodes(&centre, middle - FRAC_PI_2, middle + FRAC_PI_2)
        {
            let share = factor * node.weight / node.gap.powi(3);
            let approach = motion[0] * node.normal[0] + motion[1] * node.normal[1];
            for row in 0..2 {
                force[row] += share * approach * node.normal[row];
                for column in 0..2 {
                    let pair = share * node.normal[row] * node.normal[column];
                    by_velocity[row][column] += pair;
                    by_position[row][column] += 3.0 * approach * pair / node.gap;
                }
            }
        }
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

/// Summary with the short-bearing pressure of the last state; its outflow at each end is R B |w|.
pub(super) fn short_summary(film: &PlainFilm) -> FilmSummary {
    let Some(state) = film.last_state() else {
        return FilmSummary::default();
    };
    let motion = PlainFilm::effective_velocity(state);
    let speed = motion[0].hypot(motion[1]);
    if speed == 0.0 {
        return film.summary(Extreme::default(), 0.0, 0.0);
    }
    let centre = Centre::new(state.position, film.clearance);
    let middle = motion[1].atan2(motion[0]);
    let angle = peak_angle(&centre, middle);
    let value = 1.5 * film.viscosity * film.width.powi(2) * speed * (angle - middle).cos()
        / centre.gap(angle).powi(3);
    let peak = Extreme {
        value,
        angle: wrap(angle),
        axial: 0.0,
    };
    film.summary(peak, film.radius * film.width * speed, 0.5)
}

/// Shell angle where `cos(angle - middle)/gap^3` is largest, rad. It may have two maxima (opening
/// gap), so a scan precedes the bisection of its slope.
fn peak_angle(centre: &Centre, middle: f64) -> f64 {
    const SCAN: usize = 64;
    let pressure = |angle: f64| (angle - middle).cos() / centre.gap(angle).powi(3);
    let slope = |angle: f64| {
        let theta = angle - centre.line_of_centres;
        -(angle - middle).sin() * (1.0 - centre.eps * theta.cos())
            - 3.0 * centre.eps * theta.sin() * (angle - middle).cos()
    };
    // Scan angles crowd where the gap is narrow, the only place where the pressure is steep.
    let (mut low, mut high) = (middle - FRAC_PI_2, middle + FRAC_PI_2);
    let candidates = crowded(centre, low, high, SCAN);
    let mut best = 0;
    for (index, angle) in candidates.iter().enumerate() {
        if pressure(*angle) > pressure(candidates[best]) {
            best = index;
        }
    }
    low = if best > 0 { candidates[best - 1] } else { low };
    high = candidates.get(best + 1).copied().unwrap_or(high);
    for _ in 0..100 {
        let angle = 0.5 * (low + high);
        if slope(angle) > 0.0 {
            low = angle;
        } else {
            high = angle;
        }
    }
    0.5 * (low + high)
}

/// Angles between `low` and `high`, evenly spaced in the Sommerfeld angle and in the angle by turns.
fn crowded(centre: &Centre, low: f64, high: f64, count: usize) -> Vec<f64> {
    let (start, end) = (centre.sommerfeld_angle(low), centre.sommerfeld_angle(high));
    let squeeze = ((1.0 - centre.eps) / (1.0 + centre.eps)).sqrt();
    let mut angles: Vec<f64> = (1..count)
        .flat_map(|i| {
            let share = i as f64 / count as f64;
            let s = start + share * (end - start);
            let turns = (s / (2.0 * PI)).round() * 2.0 * PI;
            let half = 0.5 * (s - turns);
            let theta = 2.0 * (squeeze * half.sin()).atan2(half.cos()) + turns;
            [centre.line_of_centres + theta, low + share * (high - low)]
        })
        .collect();
    angles.sort_by(f64::total_cmp);
    angles
}

/// Angle within (-pi, pi].
pub(super) fn wrap(angle: f64) -> f64 {
    angle - (angle / (2.0 * PI)).round() * 2.0 * PI
}
