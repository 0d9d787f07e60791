//! What do the pressures of a tilted journal put on it once negative ones are cut (Gumbel)?
//!
//! ```text
//! -(H^3 p_theta)_theta - (D/B)^2 (H^3 p_Z)_Z = (w + Z w') . n,    H = 1 - (e + Z s) . n
//! F = -int int max(p, 0) (n, Z n) dtheta dZ,    p = u/H^2,    n = (cos(theta), sin(theta)),  |Z| < 1
//! ```
//! with the centre e over c in the mid-plane and its change s to the rear end, w and w' their effective
//! velocities. Shapes (1 - Z^2) P_k of both parities across the width for u, not for p: across a wedge the
//! short bearing has p = const (1 - Z^2)/H^2 exactly, which polynomials alone follow slowly near a narrow
//! end. Elements of high degree around, crowded where either end is narrow (`layout`).
//! The form is symmetric and positive: Cholesky, no pivots. Along each line of Gauss points what is
//! positive of the polynomials is integrated up to their zeros (`positive`).
//! Derivatives are those of the discrete force, by its adjoint: one further solution gives those by
//! motion, position and tilt, the shift of the elements included; the zeros do not count, as pressure
//! is zero there (`tangents`).
//! Pressures over 12 eta R^2/c^2, 1/s; motion over c, 1/s; shell frame.
//! References: L. Gumbel, Monatsbl. Berl. Bez. VDI (1914) 87; A. T. Patera, J. Comput. Phys. 54 (1984)
//! 468 (elements of high degree).

use super::profile::{Block, ProfileMatrix};
use layout::{Layout, Span};
use positive::{ElementRule, Sums};
use widthwise::Widthwise;

mod figures;
mod layout;
mod positive;
mod tangents;
mod widthwise;

/// Degree of the elements.
const DEGREE: usize = 6;
/// Nodes of an element, both ends included.
const NODES: usize = DEGREE + 1;

/// Where a tilted journal is, or how it moves: along X and Y in the mid-plane, and their change to the
/// rear end; over c.
pub(super) type Place = [f64; 4];

/// Force and moment on a tilted journal with all derivatives: rows as [`Place`], moments over half the
/// width.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct TiltedForce {
    /// `-int int p (n, Z n)`, 1/s.
    pub force: Place,
    /// By place at fixed motion, 1/s.
    pub by_place: [Place; 4],
    /// By motion.
    pub by_motion: [Place; 4],
}

/// Half film of a tilted journal on `M` shapes and `G` lines across the width.
#[derive(Debug, Clone)]
pub(super) struct TiltedFilm<const M: usize, const G: usize> {
    /// (D/B)^2.
    aspect: f64,
    across: Widthwise<M, G>,
    rule: ElementRule,
    layout: Layout,
    matrix: ProfileMatrix<M>,
    /// Source of the motion, then u by unknown.
    answer: Vec<[f64; 1]>,
    /// Loads of the four forces, then their adjoints.
    adjoints: Vec<[f64; 4]>,
    /// u on the lines, by node.
    lines: Vec<[f64; G]>,
    /// What the positive part of each element gives.
    sums: Vec<Sums>,
    place: Place,
    motion: Place,
}

/// The gap at an angle: in the mid-plane and its change to the rear end, and the same of its slope.
#[derive(Debug, Clone, Copy)]
struct Gap {
    height: [f64; 2],
    slope: [f64; 2],
}

/// Products of shapes over the width at one angle.
struct Products<const M: usize> {
    /// `int psi psi/H`.
    plain: Block<M>,
    /// `int psi psi H_theta/H^2`.
    sloped: Block<M>,
    /// Of all that goes with u u alone.
    own: Block<M>,
}

impl<const M: usize, const G: usize> TiltedFilm<M, G> {
    /// For a film of this D/B on so many elements around.
    pub(super) fn new(d_over_b: f64, elements: usize) -> Self {
        let nodes = elements * DEGREE;
        // The seam comes last: it alone reaches back to the first element.
        let mut starts: Vec<usize> = (0..nodes)
            .map(|node| (node / DEGREE * DEGREE).saturating_sub(1))
            .collect();
        starts[nodes - 1] = 0;
        Self {
            aspect: d_over_b * d_over_b,
            across: Widthwise::new(),
            rule: ElementRule::new(),
            layout: Layout::new(elements),
            matrix: ProfileMatrix::new(starts),
            answer: vec![[0.0]; nodes * M],
            adjoints: vec![[0.0; 4]; nodes * M],
            lines: vec![[0.0; G]; nodes],
            sums: vec![Sums::default(); elements],
            place: [0.0; 4],
            motion: [0.0; 4],
        }
    }

    /// Force and derivatives where the gap is open; `None` where the equations have no answer.
    pub(super) fn force(&mut self, place: Place, motion: Place) -> Option<TiltedForce> {
        (self.place, self.motion) = (place, motion);
        self.layout.follow(place, &self.rule);
        self.assemble();
        if !self.matrix.factor() {
            return None;
        }
        self.matrix.solve(&mut self.answer);
        self.spread_on_lines();
        self.load_positive();
        self.matrix.solve(&mut self.adjoints);
        Some(self.answer_with_tangents())
    }

    /// Unknown of a node of an element.
    fn node(&self, element: usize, i: usize) -> usize {
        let last = self.layout.count() * DEGREE;
        (element * DEGREE + i + last - 1) % last
    }

    fn assemble(&mut self) {
        self.matrix.clear();
        self.answer.fill([0.0]);
        for e in 0..self.layout.count() {
            let span = *self.layout.span(e);
            let nodes: [usize; NODES] = std::array::from_fn(|i| self.node(e, i));
            let products: [Products<M>; NODES] = std::array::from_fn(|i| self.products(&span, i));
            for a in 0..NODES {
                for b in a..NODES {
                    let (row, column) = (nodes[a].min(nodes[b]), nodes[a].max(nodes[b]));
                    self.couple([a, b], &span, &products, [row, column]);
                }
                self.add_source(&span, a, nodes[a]);
            }
        }
    }

    /// Products over the width at a node.
    fn products(&self, span: &Span, node: usize) -> Products<M> {
        let gap = Gap::at(&self.place, span.trig[node]);
        let zero = [[0.0; M]; M];
        let (mut plain, mut sloped, mut own) = (zero, zero, zero);
        for line in &self.across.lines {
            let [height, slope] = gap.on(line.place);
            let inverse = 1.0 / height;
            let (around, along) = (slope * inverse, gap.height[1] * inverse);
            let weight = line.weight * inverse;
            let bent: [f64; M] =
                std::array::from_fn(|m| line.slopes[m] - 2.0 * along * line.values[m]);
            for m in 0..M {
                let by_value = weight * line.values[m];
                let by_slope = around * by_value;
                let by_both = 4.0 * around * by_slope;
                let by_bent = self.aspect * weight * bent[m];
                for n in 0..M {
                    plain[m][n] += by_value * line.values[n];
                    sloped[m][n] += by_slope * line.values[n];
                    own[m][n] += by_both * line.values[n] + by_bent * bent[n];
                }
            }
        }
        Products { plain, sloped, own }
    }

    /// Adds what two nodes of an element have in common.
    fn couple(
        &mut self,
        [a, b]: [usize; 2],
        span: &Span,
        products: &[Products<M>; NODES],
        [row, column]: [usize; 2],
    ) {
        let rule = &self.rule;
        let mut sum = [[0.0; M]; M];
        for (i, product) in products.iter().enumerate() {
            let weight = rule.weights[i] * rule.slopes[i][a] * rule.slopes[i][b] / span.width;
            add(weight, &product.plain, &mut sum);
        }
        add(
            -2.0 * rule.weights[b] * rule.slopes[b][a],
            &products[b].sloped,
            &mut sum,
        );
        add(
            -2.0 * rule.weights[a] * rule.slopes[a][b],
            &products[a].sloped,
            &mut sum,
        );
        if a == b {
            add(rule.weights[a] * span.width, &products[a].own, &mut sum);
        }
        add(1.0, &sum, self.matrix.block(row, column));
    }

    fn add_source(&mut self, span: &Span, i: usize, node: usize) {
        let gap = Gap::at(&self.place, span.trig[i]);
        let [rigid, turning] = split(&self.motion, span.trig[i]);
        let weight = self.rule.weights[i] * span.width;
        let own = &mut self.answer[node * M..][..M];
        for line in &self.across.lines {
            let [height, _] = gap.on(line.place);
            let drive = rigid + turning * line.place;
            let part = weight * line.weight * drive / (height * height);
            for ([right], value) in own.iter_mut().zip(&line.values) {
                *right += part * value;
            }
        }
    }

    fn spread_on_lines(&mut self) {
        let (nodes, _) = self.answer.as_chunks::<M>();
        for (values, own) in nodes.iter().zip(&mut self.lines) {
            for (line, u) in self.across.lines.iter().zip(own) {
                *u = (0..M).map(|m| values[m][0] * line.values[m]).sum();
            }
        }
    }

    /// Integrals of the positive pressure, with what they are per u of each unknown.
    fn load_positive(&mut self) {
        self.adjoints.fill([0.0; 4]);
        for e in 0..self.layout.count() {
            let span = *self.layout.span(e);
            let nodes: [usize; NODES] = std::array::from_fn(|i| self.node(e, i));
            let gaps = span.point_trig.map(|trig| Gap::at(&self.place, trig));
            let mut sums = Sums::default();
            for (g, line) in self.across.lines.iter().enumerate() {
                let values = nodes.map(|node| self.lines[node][g]);
                let mut loads = [[0.0; 4]; NODES];
                let mut load = |i: usize, load: [f64; 4], share: f64| {
                    for r in 0..4 {
                        loads[i][r] += share * span.width * load[r];
                    }
                };
                if values.iter().all(|value| *value < 0.0) {
                    continue;
                }
                if values.iter().all(|value| *value >= 0.0) {
                    let points = self.rule.points.iter().zip(&self.rule.shares).zip(&gaps);
                    for (k, ((&[xi, weight], shares), gap)) in points.enumerate() {
                        let value = shares.iter().zip(values).map(|(b, v)| b * v).sum();
                        let point = [xi, line.place, weight * line.weight];
                        let of = sums.add(point, value, span.point_trig[k], gap);
                        for (i, share) in shares.iter().enumerate() {
                            load(i, of, *share);
                        }
                    }
                } else {
                    self.rule.stretches(&values, |xi, weight| {
                        let (sin, cos) = (span.start + span.width * xi).sin_cos();
                        let basis = self.rule.basis(xi);
                        let value = basis.iter().zip(values).map(|(b, v)| b * v).sum();
                        let gap = Gap::at(&self.place, [cos, sin]);
                        let point = [xi, line.place, weight * line.weight];
                        let of = sums.add(point, value, [cos, sin], &gap);
                        for (i, share) in basis.into_iter().enumerate() {
                            load(i, of, share);
                        }
                    });
                }
                for i in 0..NODES {
                    let own = &mut self.adjoints[nodes[i] * M..][..M];
                    for (side, value) in own.iter_mut().zip(&line.values) {
                        for r in 0..4 {
                            side[r] += value * loads[i][r];
                        }
                    }
                }
            }
            self.sums[e] = sums;
        }
    }
}

impl Gap {
    fn at(place: &Place, trig: [f64; 2]) -> Self {
        let [cos, sin] = trig;
        let [middle, change] = split(place, trig);
        let [bend, bend_change] = split(place, [-sin, cos]);
        Self {
            height: [1.0 - middle, -change],
            slope: [-bend, -bend_change],
        }
    }

    /// H and H_theta at Z.
    #[inline]
    fn on(&self, z: f64) -> [f64; 2] {
        [
            self.height[0] + z * self.height[1],
            self.slope[0] + z * self.slope[1],
        ]
    }
}

/// What a place or motion has along n in the mid-plane, and its change to the rear end.
fn split([x, y, to_x, to_y]: &Place, [cos, sin]: [f64; 2]) -> [f64; 2] {
    [x * cos + y * sin, to_x * cos + to_y * sin]
}

#[inline]
fn add<const M: usize>(factor: f64, block: &Block<M>, sum: &mut Block<M>) {
    for (row, own) in sum.iter_mut().zip(block) {
        for (part, value) in row.iter_mut().zip(own) {
            *part += factor * value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Centre in the mid-plane and its change that leave a gap: the centre goes the rest of the way,
    /// 1 - share of what is open, in the direction `turn`, the ends in the direction `lean`.
    fn place(least: f64, share: f64, turn: f64, lean: f64) -> Place {
        let open = 1.0 - least;
        let middle = open * (1.0 - share);
        let (sin, cos) = turn.sin_cos();
        let [x, y] = [middle * cos, middle * sin];
        // |centre + slant| = open for the end that is narrower.
        let along = (middle * (lean - turn).cos()).abs();
        let slant = (along * along + open * open - middle * middle).sqrt() - along;
        [x, y, slant * lean.cos(), slant * lean.sin()]
    }

    /// Largest errors of force and of moment over the force, against a film of more of everything.
    fn errors<const M: usize, const G: usize>(width_ratio: f64, least: f64) -> [f64; 2] {
        let mut film = TiltedFilm::<M, G>::new(1.0 / width_ratio, 7);
        let mut finer = TiltedFilm::<10, 28>::new(1.0 / width_ratio, 12);
        let mut worst = [0.0_f64; 2];
        for share in [0.0, 0.1, 0.5, 1.0] {
            for k in [1.0, 3.0, 6.0] {
                for lean in [0.0, 1.0, 3.1] {
                    let turn = 0.3 + TAU * k / 8.0;
                    let place = place(least, share, turn, turn + lean);
                    let motion = [0.3 * f64::cos(k), f64::sin(2.0 * k), 0.2, 0.4 - 0.1 * k];
                    let seen = film.force(place, motion).unwrap_or_default().force;
                    let exact = finer.force(place, motion).unwrap_or_default().force;
                    let scale = exact[0].hypot(exact[1]);
                    let off: Place = std::array::from_fn(|r| (seen[r] - exact[r]) / scale);
                    worst[0] = worst[0].max(off[0].hypot(off[1]));
                    worst[1] = worst[1].max(off[2].hypot(off[3]));
                }
            }
        }
        worst
    }

    /// The bars that `OnlineFilm::new` states.
    #[test]
    fn the_film_on_line_is_close_to_a_finer_one() {
        for (least, bar, close) in [(0.1, 2e-4, 1e-4), (0.05, 8e-4, 3e-4), (0.02, 5e-3, 5e-3)] {
            let all = [
                (0.25, errors::<4, 14>(0.25, least)),
                (0.5, errors::<4, 14>(0.5, least)),
                (0.75, errors::<6, 14>(0.75, least)),
                (1.5, errors::<6, 14>(1.5, least)),
            ];
            for (width_ratio, worst) in all {
                let is_wide = width_ratio > 0.8;
                let bar = if is_wide { bar } else { f64::min(bar, close) };
                println!(
                    "B/D {width_ratio} gap {least}: {:.1e} {:.1e}",
                    worst[0], worst[1]
                );
                assert!(
                    worst[0] < bar && worst[1] < bar,
                    "B/D {width_ratio} gap {least}: {worst:?}"
                );
            }
        }
    }
}
