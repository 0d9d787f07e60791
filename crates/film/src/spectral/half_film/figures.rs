//! Peak, side flow and wetted share of an aligned film as last solved.

use super::{HalfFilm, on_half};
use crate::spectral::answer::AlignedFigures;
use crate::spectral::cut::{Stencil, integrate_positive, zero_of};
use std::f64::consts::TAU;

impl<const M: usize, const G: usize> HalfFilm<M, G> {
    /// Figures of the last solution.
    pub(in crate::spectral) fn figures(&self) -> AlignedFigures {
        let (peak, peak_angle) = self.peak();
        AlignedFigures {
            peak,
            peak_angle,
            end_flow: self.end_flow(),
            full_film_share: self.share(),
        }
    }

    /// U at a place on the ring: the shapes weighted by what each of them is there.
    fn along(&self, place: isize, shapes: &[f64; M]) -> f64 {
        let (j, sign) = on_half(self.half(), place);
        let [even, odd] = &self.film.answer[j];
        let mut sum = 0.0;
        for k in 0..M {
            let answer = self.motion[0] * even[k] + sign * self.motion[1] * odd[k];
            sum += answer * shapes[k] * self.across.integrals[k];
        }
        sum
    }

    /// Largest pressure in the mid-plane and its angle: the quartic through five nodes.
    fn peak(&self) -> (f64, f64) {
        let half = self.half() as isize;
        let pressure = |place: isize| {
            let (j, _) = on_half(self.half(), place);
            let [unscaled, _] = self.film.map.unscaled(self.film.trig()[j][0]);
            unscaled * self.along(place, &self.across.middle)
        };
        let (mut top, mut highest) = (0, pressure(0));
        for place in 1 - half..=half {
            let value = pressure(place);
            if value > highest {
                (top, highest) = (place, value);
            }
        }
        if highest <= 0.0 {
            return (0.0, 0.0);
        }
        let around: [f64; 5] = [-2, -1, 0, 1, 2].map(|i| pressure(top + i));
        let (offset, rise) = quartic_peak(&around);
        let s = self.film.step * (top as f64 + offset);
        (highest + rise, self.film.map.angle(s))
    }

    fn end_flow(&self) -> f64 {
        let outward = |place: isize| -self.along(place, &self.across.end_slopes);
        let weight = |place: isize| {
            let (j, _) = on_half(self.half(), place);
            let [unscaled, _] = self.film.map.unscaled(self.film.trig()[j][0]);
            self.film.nodes[j].stretch.value / unscaled
        };
        self.film.step * integrate_positive(self.half() as isize, outward, weight)
    }

    /// By the angles of all changes of sign on all lines.
    fn share(&self) -> f64 {
        let last = &self.lines[self.half()];
        let mut sum = 0.0;
        for (g, weight) in self.across.weights.iter().enumerate() {
            // A stretch that is positive on the far side begins before and ends behind it.
            let wraps = self.motion[0] * last[0][g] >= 0.0;
            sum += if wraps { weight * TAU } else { 0.0 };
        }
        for change in &self.changes {
            let values: Stencil = [-1, 0, 1, 2].map(|i| {
                let (j, sign) = on_half(self.half(), change.node + change.way * i);
                let [even, odd] = &self.lines[j];
                self.motion[0] * even[change.line] + sign * self.motion[1] * odd[change.line]
            });
            let place = change.node as f64 + change.way as f64 * zero_of(&values);
            let angle = self.film.map.angle(self.film.step * place);
            sum += self.across.weights[change.line] * change.way as f64 * angle;
        }
        0.5 * sum / TAU
    }
}

/// Offset (in steps) and height above the middle of five values of the peak of the quartic through
/// them.
fn quartic_peak(&[far_before, before, middle, behind, far_behind]: &[f64; 5]) -> (f64, f64) {
    const STEPS: usize = 20;
    let (near, far) = (behind - before, far_behind - far_before);
    let (near_sum, far_sum) = (behind + before, far_behind + far_before);
    let slope = (8.0 * near - far) / 12.0;
    let bend = (16.0 * near_sum - far_sum - 30.0 * middle) / 24.0;
    let third = (far - 2.0 * near) / 12.0;
    let fourth = (far_sum - 4.0 * near_sum + 6.0 * middle) / 24.0;
    let mut x: f64 = 0.0;
    for _ in 0..STEPS {
        let first = slope + x * (2.0 * bend + x * (3.0 * third + x * 4.0 * fourth));
        let second = 2.0 * bend + x * (6.0 * third + x * 12.0 * fourth);
        if second >= 0.0 {
            return (0.0, 0.0);
        }
        let step = first / second;
        x = (x - step).clamp(-1.0, 1.0);
        if step.abs() < 1e-12 {
            break;
        }
    }
    let rise = x * (slope + x * (bend + x * (third + x * fourth)));
    if rise >= 0.0 { (x, rise) } else { (0.0, 0.0) }
}
