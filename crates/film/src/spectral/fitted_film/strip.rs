//! The equations of the film between its fronts, on the rectangle they are mapped from.
//!
//! ```text
//! s = s_a(Z) + sigma l(Z),  l = s_b - s_a,  tau = (s_a' + sigma l')/l,   p_s = p_sigma/l,  p_Z = p_Z - tau p_sigma
//! int int ( K p_s q_s + Q p_Z q_Z ) l dsigma dZ = int int w n dtheta/ds q l dsigma dZ
//! K = H^3 ds/dtheta,  Q = (D/B)^2 H^3 dtheta/ds
//! ```
//! Nodes are the quadrature points around (Gauss-Lobatto), lines those across (Gauss).

use super::{FittedFilm, dot};
use crate::spectral::profile::Block;

/// One quadrature point.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Point {
    /// Weight times l dtheta/ds: area in theta and Z.
    pub area: f64,
    /// p_theta per p_sigma, and tau.
    pub around: f64,
    pub tau: f64,
    /// H, cos and sin of theta.
    pub gap: f64,
    pub normal: [f64; 2],
}

/// A front on a line: s, its slope by Z, cos and sin of theta.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    pub place: f64,
    pub slope: f64,
    pub normal: [f64; 2],
}

/// Slopes of both answers at a point: around and across.
pub(super) type Slopes = [[f64; 2]; 2];

impl<const M: usize, const G: usize> FittedFilm<M, G> {
    /// Both fronts on a line.
    pub(super) fn ends(&self, g: usize) -> [End; 2] {
        let direction = self.direction();
        [0, 1].map(|side| {
            let place = self.map.of(direction + self.fronts.angles[side][g]);
            let (normal, stretch, _) = self.map.at(place.sin_cos());
            End {
                place,
                slope: self.fronts.slopes[side][g] / stretch,
                normal,
            }
        })
    }

    /// Fills the points for the fronts.
    fn place_points(&mut self) {
        let degree = self.element.nodes.len() - 1;
        for g in 0..G {
            let ends = self.ends(g).map(|end| [end.place, end.slope]);
            let length = ends[1][0] - ends[0][0];
            let widening = ends[1][1] - ends[0][1];
            for element in 0..self.accuracy.elements {
                let part = self.part(element);
                for r in 0..=degree {
                    let share = self.breaks[element] + self.element.nodes[r] * part;
                    let s = ends[0][0] + share * length;
                    let (normal, stretch, gap) = self.map.at(s.sin_cos());
                    let weight = self.element.weights[r] * part * self.shapes.weights[g];
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

    /// Part of the way between the fronts that an element covers.
    pub(super) fn part(&self, element: usize) -> f64 {
        self.breaks[element + 1] - self.breaks[element]
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
    pub(super) fn unknown(&self, node: usize) -> Option<usize> {
        let last = self.accuracy.elements * self.accuracy.degree;
        (node > 0 && node < last).then(|| (node - 1) * M)
    }

    /// Adds what one element conducts and what drives it.
    fn assemble(&mut self, element: usize) {
        let degree = self.accuracy.degree;
        let scale = 1.0 / self.part(element);
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
    pub(super) fn resistance(&self) -> [[f64; 2]; 2] {
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

    /// Visits all points with the line they lie on and the slopes of both answers there.
    pub(super) fn walk(&self, mut visit: impl FnMut(&Point, usize, &Slopes)) {
        let degree = self.accuracy.degree;
        for element in 0..self.accuracy.elements {
            let scale = 1.0 / self.part(element);
            for r in 0..=degree {
                let mut rises = [[0.0; 2]; M];
                for i in 0..=degree {
                    let Some(first) = self.unknown(element * degree + i) else {
                        continue;
                    };
                    let slope = scale * self.element.slopes[r][i];
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

    /// Element and node at a front.
    pub(super) fn end(&self, side: usize) -> (usize, usize) {
        match side {
            0 => (0, 0),
            _ => (self.accuracy.elements - 1, self.accuracy.degree),
        }
    }

    /// H^3 p_theta at a front for unit motions.
    pub(super) fn fluxes(&self, side: usize, g: usize) -> [f64; 2] {
        let degree = self.accuracy.degree;
        let (element, r) = self.end(side);
        let mut rises = [0.0; 2];
        for i in 0..=degree {
            let Some(first) = self.unknown(element * degree + i) else {
                continue;
            };
            let slope = self.element.slopes[r][i];
            for k in 0..M {
                let weight = slope * self.shapes.values[g][k];
                rises[0] += weight * self.answers[first + k][0];
                rises[1] += weight * self.answers[first + k][1];
            }
        }
        let point = &self.points[(element * (degree + 1) + r) * G + g];
        let scale = point.around * point.gap.powi(3) / self.part(element);
        rises.map(|rise| scale * rise)
    }
}

/// Most nodes of an element.
const MOST_NODES: usize = 10;
