//! Peak, flow out of both ends and wetted share of a tilted film as last solved.

use super::widthwise::shapes_at;
use super::{DEGREE, Gap, NODES, TiltedFilm};
use crate::spectral::answer::FilmFigures;
use std::f64::consts::TAU;

impl<const M: usize, const G: usize> TiltedFilm<M, G> {
    /// Figures of the last solution.
    pub(in crate::spectral) fn figures(&self) -> FilmFigures {
        if self.motion == [0.0; 4] {
            return FilmFigures::default();
        }
        let (peak, peak_angle, peak_place) = self.peak();
        FilmFigures {
            peak,
            peak_angle,
            peak_place,
            end_flow: [-1.0, 1.0].map(|end| self.end_flow(end)),
            full_film_share: self.full_film_share(),
        }
    }

    /// By the positive stretches of all lines.
    fn full_film_share(&self) -> f64 {
        let arcs = self.sums.iter().enumerate();
        let sum: f64 = arcs
            .map(|(e, sums)| sums.length * self.layout.span(e).width)
            .sum();
        0.5 * sum / TAU
    }

    /// What shapes at one Z make of u at the nodes of an element.
    fn at_nodes(&self, element: usize, shapes: &[f64; M]) -> [f64; NODES] {
        let (pressures, _) = self.answer.as_chunks::<M>();
        std::array::from_fn(|i| {
            let own = &pressures[self.node(element, i)];
            (0..M).map(|m| own[m][0] * shapes[m]).sum()
        })
    }

    fn pressure(&self, angle: f64, z: f64) -> f64 {
        let (element, xi) = self.layout.locate(angle.rem_euclid(TAU));
        let values = self.at_nodes(element, &shapes_at(z).map(|[value, _]| value));
        let basis = self.rule.basis(xi);
        let u: f64 = basis.iter().zip(values).map(|(b, v)| b * v).sum();
        let (sin, cos) = angle.sin_cos();
        let [height, _] = Gap::at(&self.place, [cos, sin]).on(z);
        u / (height * height)
    }

    /// Largest pressure, its angle and Z: from the highest node on a line by the quadratic around the
    /// place, with ever smaller distances.
    fn peak(&self) -> (f64, f64, f64) {
        const ROUNDS: usize = 8;
        let (mut highest, mut angle, mut z) = (0.0, 0.0, 0.0);
        let mut reach = [0.0; 2];
        for e in 0..self.layout.count() {
            let span = self.layout.span(e);
            for line in &self.across.lines {
                let values = self.at_nodes(e, &line.values);
                for i in 0..NODES {
                    let [height, _] = Gap::at(&self.place, span.trig[i]).on(line.place);
                    let value = values[i] / (height * height);
                    if value > highest {
                        (highest, z) = (value, line.place);
                        angle = span.start + span.width * self.rule.places[i];
                        reach = [span.width / DEGREE as f64, 0.2 * (1.0 - z.abs())];
                    }
                }
            }
        }
        if highest <= 0.0 {
            return (0.0, 0.0, 0.0);
        }
        for _ in 0..ROUNDS {
            let of = |i: f64, j: f64| self.pressure(angle + i * reach[0], z + j * reach[1]);
            let middle = of(0.0, 0.0);
            let [[before, behind], [front, rear]] =
                [[of(-1.0, 0.0), of(1.0, 0.0)], [of(0.0, -1.0), of(0.0, 1.0)]];
            let slope = [0.5 * (behind - before), 0.5 * (rear - front)];
            let bend = [behind + before - 2.0 * middle, rear + front - 2.0 * middle];
            let twist = 0.25 * (of(1.0, 1.0) + of(-1.0, -1.0) - of(1.0, -1.0) - of(-1.0, 1.0));
            let determinant = bend[0] * bend[1] - twist * twist;
            if determinant > 0.0 && bend[0] < 0.0 {
                let step = [
                    (twist * slope[1] - bend[1] * slope[0]) / determinant,
                    (twist * slope[0] - bend[0] * slope[1]) / determinant,
                ];
                angle += step[0].clamp(-1.0, 1.0) * reach[0];
                z += step[1].clamp(-1.0, 1.0) * reach[1];
                z = z.clamp(-1.0, 1.0);
            }
            reach = reach.map(|distance| 0.5 * distance);
        }
        (self.pressure(angle, z).max(highest), angle, z)
    }

    /// Flow out of the end Z = -1 or 1 where the pressure before it is positive.
    fn end_flow(&self, end: f64) -> f64 {
        let slopes = shapes_at(end).map(|[_, slope]| -end * slope);
        let mut flow = 0.0;
        for e in 0..self.layout.count() {
            let span = self.layout.span(e);
            let values = self.at_nodes(e, &slopes);
            self.rule.stretches(&values, |xi, weight| {
                let (sin, cos) = (span.start + span.width * xi).sin_cos();
                // H^3 p_Z, where u is zero.
                let [height, _] = Gap::at(&self.place, [cos, sin]).on(end);
                let basis = self.rule.basis(xi);
                let value: f64 = basis.iter().zip(values).map(|(b, v)| b * v).sum();
                flow += span.width * weight * value * height;
            });
        }
        flow
    }
}
