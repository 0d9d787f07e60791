//! Peak, side flow and wetted share of a film between fronts as last solved.

use super::{FittedFilm, dot};
use crate::spectral::answer::AlignedFigures;
use std::f64::consts::TAU;

impl<const M: usize, const G: usize> FittedFilm<M, G> {
    /// Figures of the last solution.
    pub(in crate::spectral) fn figures(&self) -> AlignedFigures {
        let (peak, peak_angle) = self.peak();
        let mut covered = 0.0;
        for g in 0..G {
            let span = self.fronts.angles[1][g] - self.fronts.angles[0][g];
            covered += 0.5 * self.shapes.weights[g] * span;
        }
        AlignedFigures {
            peak,
            peak_angle,
            end_flow: self.end_flow(),
            full_film_share: covered / TAU,
        }
    }

    /// Outflow at one end, by the balance weighted with Z^2, which needs no slope at the end.
    fn end_flow(&self) -> f64 {
        let mut sum = 0.0;
        self.walk(|point, g, slopes| {
            let z = self.shapes.places[g];
            let across = self.motion[0] * slopes[0][1] + self.motion[1] * slopes[1][1];
            let driven = dot(self.motion, point.normal) * z * z / self.aspect;
            sum += point.area * (driven - 2.0 * z * point.gap.powi(3) * across);
        });
        0.5 * sum
    }

    /// Largest pressure in the mid-plane and its angle from the line of centres: the polynomial of the
    /// elements around it, by bisection of its slope.
    fn peak(&self) -> (f64, f64) {
        const PLACES: usize = 8;
        let last = self.accuracy.elements * PLACES;
        let at = |place: f64| self.in_mid_plane(place);
        let (mut top, mut highest) = (0, 0.0);
        for place in 1..last {
            let value = at(place as f64 / last as f64);
            if value > highest {
                (top, highest) = (place, value);
            }
        }
        if highest <= 0.0 {
            return (0.0, 0.0);
        }
        // Golden section between the neighbours.
        let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
        let (mut low, mut high) = (
            (top - 1) as f64 / last as f64,
            (top + 1) as f64 / last as f64,
        );
        for _ in 0..36 {
            let (left, right) = (high - ratio * (high - low), low + ratio * (high - low));
            if at(left) > at(right) {
                high = right;
            } else {
                low = left;
            }
        }
        let place = 0.5 * (low + high);
        // Fronts in the mid-plane: lines lie too close to it for a difference.
        let ends = [0, 1].map(|side| {
            self.map
                .of(self.direction() + self.fronts.angles[side][G - 1])
        });
        let (element, x) = self.element_at(place * self.accuracy.elements as f64);
        let share = self.breaks[element] + x * self.part(element);
        let s = ends[0] + share * (ends[1] - ends[0]);
        (at(place), self.map.angle(s))
    }

    /// Element and place in it, of a place that counts elements.
    fn element_at(&self, place: f64) -> (usize, f64) {
        let element = (place as usize).min(self.accuracy.elements - 1);
        (element, place - element as f64)
    }

    /// Pressure in the mid-plane at a share of the way between the fronts.
    fn in_mid_plane(&self, share: f64) -> f64 {
        let degree = self.accuracy.degree;
        let (element, x) = self.element_at(share * self.accuracy.elements as f64);
        let nodes = &self.element.nodes;
        let mut sum = 0.0;
        for i in 0..=degree {
            let Some(first) = self.unknown(element * degree + i) else {
                continue;
            };
            let mut share = 1.0;
            for j in (0..=degree).filter(|&j| j != i) {
                share *= (x - nodes[j]) / (nodes[i] - nodes[j]);
            }
            for k in 0..M {
                let pressure = dot(self.answers[first + k], self.motion);
                sum += share * self.shapes.middle[k] * pressure;
            }
        }
        sum
    }
}
