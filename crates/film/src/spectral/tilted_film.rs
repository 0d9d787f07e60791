//! What do the pressures of a tilted journal put on it once negative ones are cut (Gumbel)?
//!
//! ```text
//! -(H^3 p_theta)_theta - (D/B)^2 (H^3 p_Z)_Z = (w + Z w') . n,    H = 1 - (e + Z s) . n
//! F = -int int max(p, 0) (n, Z n) dtheta dZ,    n = (cos(theta), sin(theta)),  |Z| < 1
//! ```
//! with the centre e over c in the mid-plane and its change s to the rear end, w and w' their effective
//! velocities. Shapes (1 - Z^2) P_k of both parities across the width, which H^3, cubic in Z, couples;
//! around the bearing elements of high degree, crowded where either end is narrow (`layout`).
//! The form is symmetric and positive: Cholesky, no pivots. Along each line of Gauss points what is
//! positive of the polynomials is integrated up to their zeros (`positive`).
//! Derivatives are those of the discrete force, by its adjoint: four further solutions give those by
//! motion, position and tilt, the shift of the elements included; the zeros do not count, as pressure
//! is zero there.
//! Pressures over 12 eta R^2/c^2, 1/s; motion over c, 1/s; shell frame.
//! References: L. Gumbel, Monatsbl. Berl. Bez. VDI (1914) 87; A. T. Patera, J. Comput. Phys. 54 (1984)
//! 468 (elements of high degree).

use super::profile::ProfileMatrix;
use layout::Layout;
use positive::ElementRule;
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

/// Half film of a tilted journal on `M` shapes.
#[derive(Debug, Clone)]
pub(super) struct TiltedFilm<const M: usize> {
    /// (D/B)^2.
    aspect: f64,
    across: Widthwise<M>,
    rule: ElementRule,
    layout: Layout,
    matrix: ProfileMatrix<M>,
    /// Source of the motion, then pressure by unknown.
    answer: Vec<[f64; 1]>,
    /// Loads of the four forces, then their adjoints.
    adjoints: Vec<[f64; 4]>,
    /// Pressure on the lines, by node.
    lines: Vec<f64>,
    /// What the positive part of each element gives by its shift.
    shifts: Vec<Shift>,
    place: Place,
    motion: Place,
    /// Positive arc over all lines, rad.
    wetted: f64,
}

/// Integrals over the positive part of an element, with weights 1 and Z, of `p n` and of `p n xi`.
#[derive(Debug, Clone, Copy, Default)]
struct Shift {
    whole: Place,
    moved: Place,
}

impl<const M: usize> TiltedFilm<M> {
    /// For a film of this D/B on so many elements around.
    pub(super) fn new(d_over_b: f64, elements: usize, lines: usize) -> Self {
        let nodes = elements * DEGREE;
        // The seam comes last: it alone reaches back to the first element.
        let mut starts: Vec<usize> = (0..nodes)
            .map(|node| (node / DEGREE * DEGREE).saturating_sub(1))
            .collect();
        starts[nodes - 1] = 0;
        let across = Widthwise::new(lines);
        Self {
            aspect: d_over_b * d_over_b,
            rule: ElementRule::new(),
            layout: Layout::new(elements),
            matrix: ProfileMatrix::new(starts),
            answer: vec![[0.0]; nodes * M],
            adjoints: vec![[0.0; 4]; nodes * M],
            lines: vec![0.0; nodes * lines],
            across,
            shifts: vec![Shift::default(); elements],
            place: [0.0; 4],
            motion: [0.0; 4],
            wetted: 0.0,
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
        let force = self.load_positive();
        self.matrix.solve(&mut self.adjoints);
        let mut found = self.tangents();
        found.force = force.map(|part| -part);
        Some(found)
    }

    /// Unknown of a node of an element.
    fn node(&self, element: usize, i: usize) -> usize {
        let last = self.layout.count() * DEGREE;
        (element * DEGREE + i + last - 1) % last
    }

    fn assemble(&mut self) {
        self.matrix.clear();
        self.answer.fill([0.0]);
        let (rule, across) = (&self.rule, &self.across);
        for e in 0..self.layout.count() {
            let span = self.layout.span(e);
            let cubes: [[f64; 4]; NODES] =
                std::array::from_fn(|i| cubed(gap_at(&self.place, span.trig[i])));
            let nodes: [usize; NODES] = std::array::from_fn(|i| self.node(e, i));
            for a in 0..NODES {
                for b in a..NODES {
                    let mut parts = [0.0; 4];
                    for i in 0..NODES {
                        let weight = rule.weights[i] * rule.slopes[i][a] * rule.slopes[i][b];
                        for k in 0..4 {
                            parts[k] += weight * cubes[i][k];
                        }
                    }
                    let parts = parts.map(|part| part / span.width);
                    let (row, column) = (nodes[a].min(nodes[b]), nodes[a].max(nodes[b]));
                    across.mass.add_to(parts, self.matrix.block(row, column));
                }
                let weight = rule.weights[a] * span.width;
                let parts = cubes[a].map(|part| self.aspect * weight * part);
                across
                    .stiffness
                    .add_to(parts, self.matrix.block(nodes[a], nodes[a]));
                let [rigid, turning] = split(&self.motion, span.trig[a]);
                let own = &mut self.answer[nodes[a] * M..][..M];
                for (m, [right]) in own.iter_mut().enumerate() {
                    let [even, odd] = across.integrals[m];
                    *right += weight * (rigid * even + turning * odd);
                }
            }
        }
    }

    fn spread_on_lines(&mut self) {
        let count = self.across.lines.len();
        let (nodes, _) = self.answer.as_chunks::<M>();
        for (values, own) in nodes.iter().zip(self.lines.chunks_exact_mut(count)) {
            for (line, pressure) in self.across.lines.iter().zip(own) {
                *pressure = (0..M).map(|m| values[m][0] * line.values[m]).sum();
            }
        }
    }

    /// Integrals of the positive pressure, with what they are per pressure of each unknown.
    fn load_positive(&mut self) -> Place {
        let count = self.across.lines.len();
        let mut force = [0.0; 4];
        self.adjoints.fill([0.0; 4]);
        self.wetted = 0.0;
        for e in 0..self.layout.count() {
            let span = *self.layout.span(e);
            let nodes: [usize; NODES] = std::array::from_fn(|i| self.node(e, i));
            let mut shift = Shift::default();
            for (g, line) in self.across.lines.iter().enumerate() {
                let values = nodes.map(|node| self.lines[node * count + g]);
                let Some(part) = self.rule.positive(&values, &span) else {
                    continue;
                };
                self.wetted += line.weight * part.length * span.width;
                let lever = line.weight * line.place;
                for i in 0..NODES {
                    let [x, y] = part.loads[i].map(|load| load * span.width);
                    let load = [line.weight * x, line.weight * y, lever * x, lever * y];
                    let own = &mut self.adjoints[nodes[i] * M..][..M];
                    for (side, value) in own.iter_mut().zip(&line.values) {
                        for r in 0..4 {
                            side[r] += value * load[r];
                        }
                    }
                }
                for r in 0..4 {
                    let weight = if r < 2 { line.weight } else { lever };
                    shift.whole[r] += weight * part.whole[r % 2];
                    shift.moved[r] += weight * part.moved[r % 2];
                }
            }
            for r in 0..4 {
                force[r] += span.width * shift.whole[r];
            }
            self.shifts[e] = shift;
        }
        force
    }
}

/// `1 - e . n` and `-s . n`: H where n has these components, and its change to the rear end.
fn gap_at(place: &Place, trig: [f64; 2]) -> [f64; 2] {
    let [middle, change] = split(place, trig);
    [1.0 - middle, -change]
}

/// What a place or motion has along n in the mid-plane, and its change to the rear end.
fn split([x, y, to_x, to_y]: &Place, [cos, sin]: [f64; 2]) -> [f64; 2] {
    [x * cos + y * sin, to_x * cos + to_y * sin]
}

/// Coefficients of H^3 by powers of Z.
fn cubed([middle, change]: [f64; 2]) -> [f64; 4] {
    let (square, other) = (middle * middle, change * change);
    [
        square * middle,
        3.0 * square * change,
        3.0 * middle * other,
        other * change,
    ]
}
