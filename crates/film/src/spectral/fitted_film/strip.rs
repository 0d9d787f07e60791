//! The equations of the film between its fronts, on the rectangle they are mapped from.
//!
//! ```text
//! s = s_a(Z) + sigma l(Z),  l = s_b - s_a,  tau = (s_a' + sigma l')/l,   p_s = p_sigma/l,  p_Z = p_Z - tau p_sigma
//! int int ( K p_s q_s + Q p_Z q_Z ) l dsigma dZ = int int w n dtheta/ds q l dsigma dZ
//! K = H^3 ds/dtheta,  Q = (D/B)^2 H^3 dtheta/ds
//! ```
//! Nodes are the quadrature points around (Gauss-Lobatto), lines those across (Gauss).

use super::{FittedFilm, dot};
use crate::spectral::answer::{AlignedFigures, AlignedForce};
use crate::spectral::profile::Block;
use std::f64::consts::TAU;

/// One quadrature point.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Point {
    /// Weight times l dtheta/ds: area in theta and Z.
    area: f64,
    /// p_theta per p_sigma, and tau.
    around: f64,
    tau: f64,
    /// H, cos and sin of theta.
    gap: f64,
    normal: [f64; 2],
}

/// Slopes of both answers at a point: around and across.
type Slopes = [[f64; 2]; 2];

impl<const M: usize, const G: usize> FittedFilm<M, G> {
    /// Fills the points for the fronts.
    fn place_points(&mut self) {
        let direction = self.direction();
        let degree = self.element.nodes.len() - 1;
        let per_element = 1.0 / self.accuracy.elements as f64;
        for g in 0..G {
            let ends = [0, 1].map(|side| {
                let place = self.map.of(direction + self.fronts.angles[side][g]);
                let stretch = self.map.at(place.sin_cos()).1;
                [place, self.fronts.slopes[side][g] / stretch]
            });
            let length = ends[1][0] - ends[0][0];
            let widening = ends[1][1] - ends[0][1];
            for element in 0..self.accuracy.elements {
                for r in 0..=degree {
                    let share = (element as f64 + self.element.nodes[r]) * per_element;
                    let s = ends[0][0] + share * length;
                    let (normal, stretch, gap) = self.map.at(s.sin_cos());
                    let weight = self.element.weights[r] * per_element * self.shapes.weights[g];
                    self.points[(element * (degree + 1) + r) * G + g] = Point {
                        area: weight * length * stretch,
                        around: 1.0 / (length * stretch),
                        tau: (ends[0][1] + share * widening) / length,
                        gap,
                        normal,
                    };
                }
            }
        }
    }

    /// Solves between the fronts; false where the equations are no film's.
    pub(super) fn solve(&mut self) -> bool {
        self.place_points();
        self.matrix.clear();
        self.sources.fill([0.0; 2]);
        for element in 0..self.accuracy.elements {
            self.assemble(element);
        }
        if !self.matrix.factor() {
            return false;
        }
        self.answers.copy_from_slice(&self.sources);
        self.matrix.solve(&mut self.answers);
        self.answers.iter().flatten().all(|u| u.is_finite())
    }

    /// Unknown of a node's first shape; none at the ends.
    fn unknown(&self, node: usize) -> Option<usize> {
        let last = self.accuracy.elements * self.accuracy.degree;
        (node > 0 && node < last).then(|| (node - 1) * M)
    }

    /// Adds what one element conducts and what drives it.
    fn assemble(&mut self, element: usize) {
        let degree = self.accuracy.degree;
        let scale = self.accuracy.elements as f64;
        let zero = [[0.0; M]; M];
        let mut blocks = [[zero; 3]; MOST_NODES];
        for r in 0..=degree {
            let node = element * degree + r;
            let mut sources = [[0.0; 2]; M];
            let [around, mixed, across] = &mut blocks[r];
            for g in 0..G {
                let point = self.points[(element * (degree + 1) + r) * G + g];
                let cubed = point.area * point.gap * point.gap * point.gap;
                let side = self.aspect * cubed;
                let slope = scale
                    * scale
                    * (cubed * point.around * point.around + side * point.tau * point.tau);
                let skew = -scale * side * point.tau;
                let (values, slopes) = (&self.shapes.values[g], &self.shapes.slopes[g]);
                for k in 0..M {
                    let (a, b) = (slope * values[k], skew * slopes[k]);
                    let c = side * slopes[k];
                    for l in 0..M {
                        around[k][l] += a * values[l];
                        mixed[k][l] += b * values[l];
                        across[k][l] += c * slopes[l];
                    }
                    let source = point.area * values[k];
                    sources[k][0] += source * point.normal[0];
                    sources[k][1] += source * point.normal[1];
                }
            }
            if let Some(first) = self.unknown(node) {
                for (k, source) in sources.iter().enumerate() {
                    self.sources[first + k][0] += source[0];
                    self.sources[first + k][1] += source[1];
                }
            }
        }
        self.add_blocks(element, &blocks);
    }

    /// Adds the blocks of an element, products of slopes at its nodes times what is conducted there.
    fn add_blocks(&mut self, element: usize, blocks: &[[Block<M>; 3]; MOST_NODES]) {
        let degree = self.accuracy.degree;
        for i in 0..=degree {
            let Some(column) = self.unknown(element * degree + i) else {
                continue;
            };
            for j in 0..=i {
                let Some(row) = self.unknown(element * degree + j) else {
                    continue;
                };
                let mut block = *self.matrix.block(row / M, column / M);
                for r in 0..=degree {
                    let factor = self.element.slopes[r][i] * self.element.slopes[r][j];
                    for k in 0..M {
                        for l in 0..M {
                            block[k][l] += factor * blocks[r][0][k][l];
                        }
                    }
                }
                let (forth, back) = (self.element.slopes[j][i], self.element.slopes[i][j]);
                for k in 0..M {
                    for l in 0..M {
                        block[k][l] += forth * blocks[j][1][k][l] + back * blocks[i][1][l][k];
                        if i == j {
                            block[k][l] += blocks[i][2][k][l];
                        }
                    }
                }
                *self.matrix.block(row / M, column / M) = block;
            }
        }
    }

    /// Force of the last solution.
    pub(super) fn force_of_answers(&self) -> [f64; 2] {
        let resistance = self.resistance();
        [0, 1].map(|row| dot(resistance[row], self.motion))
    }

    /// Force per motion: `-b A^-1 b`.
    fn resistance(&self) -> [[f64; 2]; 2] {
        let mut sums = [[0.0; 2]; 2];
        for (source, answer) in self.sources.iter().zip(&self.answers) {
            for row in 0..2 {
                for column in 0..2 {
                    sums[row][column] -= source[row] * answer[column];
                }
            }
        }
        sums
    }

    /// Force and derivatives of the last solution. Those by the place of the journal, along and across,
    /// at fixed fronts; the one by the direction of motion with fronts that turn with it, `J F - eps
    /// dF/dy` since the film knows only the angle between both: exact for a journal in the centre.
    pub(super) fn tangents(&self) -> AlignedForce {
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
        let per_square = 1.0 / dot(self.motion, self.motion);
        let [along, across] = self.motion.map(|part| part * per_square);
        AlignedForce {
            force,
            by_eccentricity: by_place.map(|row| row[0]),
            by_motion: [0, 1].map(|row| {
                [
                    force[row] * along - by_turn[row] * across,
                    force[row] * across + by_turn[row] * along,
                ]
            }),
        }
    }

    /// Visits all points with the line they lie on and the slopes of both answers there.
    fn walk(&self, mut visit: impl FnMut(&Point, usize, &Slopes)) {
        let degree = self.accuracy.degree;
        for element in 0..self.accuracy.elements {
            for r in 0..=degree {
                let mut rises = [[0.0; 2]; M];
                for i in 0..=degree {
                    let Some(first) = self.unknown(element * degree + i) else {
                        continue;
                    };
                    let slope = self.element.slopes[r][i] * self.accuracy.elements as f64;
                    for (rise, answer) in rises.iter_mut().zip(&self.answers[first..first + M]) {
                        rise[0] += slope * answer[0];
                        rise[1] += slope * answer[1];
                    }
                }
                let mut values = [[0.0; 2]; M];
                if let Some(first) = self.unknown(element * degree + r) {
                    values.copy_from_slice(&self.answers[first..first + M]);
                }
                for g in 0..G {
                    let point = &self.points[(element * (degree + 1) + r) * G + g];
                    let mut slopes = [[0.0; 2]; 2];
                    for k in 0..M {
                        for answer in 0..2 {
                            slopes[answer][0] += self.shapes.values[g][k] * rises[k][answer];
                            slopes[answer][1] += self.shapes.slopes[g][k] * values[k][answer];
                        }
                    }
                    for slope in &mut slopes {
                        slope[1] -= point.tau * slope[0];
                        slope[0] *= point.around;
                    }
                    visit(point, g, &slopes);
                }
            }
        }
    }

    /// H^3 p_theta at a front.
    pub(super) fn flux(&self, side: usize, g: usize) -> f64 {
        let degree = self.accuracy.degree;
        let (element, r) = match side {
            0 => (0, 0),
            _ => (self.accuracy.elements - 1, degree),
        };
        let mut rise = 0.0;
        for i in 0..=degree {
            let Some(first) = self.unknown(element * degree + i) else {
                continue;
            };
            let slope = self.element.slopes[r][i];
            for k in 0..M {
                let pressure = dot(self.answers[first + k], self.motion);
                rise += slope * self.shapes.values[g][k] * pressure;
            }
        }
        let point = &self.points[(element * (degree + 1) + r) * G + g];
        self.accuracy.elements as f64 * rise * point.around * point.gap.powi(3)
    }

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
        let s = ends[0] + place * (ends[1] - ends[0]);
        (at(place), self.map.angle(s))
    }

    /// Pressure in the mid-plane at a share of the way between the fronts.
    fn in_mid_plane(&self, share: f64) -> f64 {
        let degree = self.accuracy.degree;
        let place = share * self.accuracy.elements as f64;
        let element = (place as usize).min(self.accuracy.elements - 1);
        let x = place - element as f64;
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

/// Most nodes of an element.
const MOST_NODES: usize = 10;
