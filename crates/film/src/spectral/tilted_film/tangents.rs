//! How do force and moment of a tilted film change with its motion and its place?
//!
//! ```text
//! F = -g.x, A x = b, A l = g:    dF = -(dg.x + l.(db - dA x))
//! form of A:  (1/H) (a a' + (D/B)^2 b b'),   a = u_theta - 2 u H_theta/H,   b = u_Z - 2 u H_Z/H
//! ```
//! The adjoint l of each of the four forces gives all derivatives. A, b and g depend on the place by H
//! and its slopes, and by where the elements are.

use super::layout::Span;
use super::{Gap, NODES, Place, TiltedFilm, TiltedForce, split};

/// u or an adjoint at a point, its slopes along theta and Z, and what H makes of them: `a`, `b`.
#[derive(Debug, Clone, Copy, Default)]
struct Field {
    value: f64,
    around: f64,
    bent_around: f64,
    bent_along: f64,
}

impl Field {
    #[inline]
    fn of([value, around, along]: [f64; 3], [by_around, by_along]: [f64; 2]) -> Self {
        Self {
            value,
            around,
            bent_around: around - 2.0 * by_around * value,
            bent_along: along - 2.0 * by_along * value,
        }
    }
}

impl<const M: usize, const G: usize> TiltedFilm<M, G> {
    /// The force of the last solution with all derivatives.
    pub(super) fn answer_with_tangents(&self) -> TiltedForce {
        let mut found = TiltedForce::default();
        for e in 0..self.layout.count() {
            let span = self.layout.span(e);
            let sums = &self.sums[e];
            for r in 0..4 {
                found.force[r] -= span.width * sums.whole[r];
                for q in 0..4 {
                    found.by_place[r][q] -= span.width * sums.by_place[r][q];
                }
            }
            // By the start of the element and by its arc.
            let mut by_start = sums.turned.map(|turned| span.width * turned);
            let mut by_width: Place =
                std::array::from_fn(|r| sums.whole[r] + span.width * sums.stretched[r]);
            for i in 0..NODES {
                self.add_node(e, i, &mut found, [&mut by_start, &mut by_width]);
            }
            for r in 0..4 {
                for q in 0..4 {
                    found.by_place[r][q] -=
                        by_start[r] * span.start_slope[q] + by_width[r] * span.width_slope[q];
                }
            }
        }
        found
    }

    /// u and the adjoints at a node, and their slopes around, by shape.
    fn fields_at(&self, e: usize, i: usize, span: &Span) -> [[[f64; 5]; M]; 2] {
        let (pressures, _) = self.answer.as_chunks::<M>();
        let (adjoints, _) = self.adjoints.as_chunks::<M>();
        let all = |node: usize, m: usize| -> [f64; 5] {
            let [a, b, c, d] = adjoints[node][m];
            [a, b, c, d, pressures[node][m][0]]
        };
        let own = self.node(e, i);
        let values = std::array::from_fn(|m| all(own, m));
        let mut slopes = [[0.0; 5]; M];
        for j in 0..NODES {
            let slope = self.rule.slopes[i][j] / span.width;
            let node = self.node(e, j);
            for m in 0..M {
                let parts = all(node, m);
                for r in 0..5 {
                    slopes[m][r] += slope * parts[r];
                }
            }
        }
        [values, slopes]
    }

    fn add_node(
        &self,
        e: usize,
        i: usize,
        found: &mut TiltedForce,
        [by_start, by_width]: [&mut Place; 2],
    ) {
        let span = self.layout.span(e);
        let [cos, sin] = span.trig[i];
        let gap = Gap::at(&self.place, [cos, sin]);
        let [values, slopes] = self.fields_at(e, i, span);
        let drive = split(&self.motion, [cos, sin]);
        let rise = split(&self.motion, [-sin, cos]);
        for line in &self.across.lines {
            let mut parts = [[0.0; 5]; 3];
            for m in 0..M {
                for r in 0..5 {
                    parts[0][r] += line.values[m] * values[m][r];
                    parts[1][r] += line.values[m] * slopes[m][r];
                    parts[2][r] += line.slopes[m] * values[m][r];
                }
            }
            let z = line.place;
            let [height, slope] = gap.on(z);
            let inverse = 1.0 / height;
            let ratios = [slope * inverse, gap.height[1] * inverse];
            let field = |r: usize| Field::of([parts[0][r], parts[1][r], parts[2][r]], ratios);
            let u = field(4);
            let (source, source_slope) = (drive[0] + z * drive[1], rise[0] + z * rise[1]);
            let weight = self.rule.weights[i] * line.weight;
            let weighted = weight * span.width * inverse;
            for r in 0..4 {
                let l = field(r);
                let form =
                    u.bent_around * l.bent_around + self.aspect * u.bent_along * l.bent_along;
                let around = 2.0 * (u.value * l.bent_around + l.value * u.bent_around);
                let along = 2.0 * self.aspect * (u.value * l.bent_along + l.value * u.bent_along);
                let driven = inverse * source * l.value;
                let by_height = weighted
                    * inverse
                    * (form - ratios[0] * around - ratios[1] * along - 2.0 * driven);
                let by_slope = weighted * inverse * around;
                let by_along = weighted * inverse * along;
                let by_arc = weight
                    * inverse
                    * (driven - form + u.around * l.bent_around + l.around * u.bent_around);
                // H_thetatheta is 1 - H, and its mixed slope that of the change to the rear end.
                let by_angle = slope * by_height
                    + (1.0 - height) * by_slope
                    + gap.slope[1] * by_along
                    + weighted * inverse * source_slope * l.value;
                by_start[r] += by_angle;
                by_width[r] += by_arc + self.rule.places[i] * by_angle;
                let by_x = sin * by_slope - cos * by_height;
                let by_y = -cos * by_slope - sin * by_height;
                let place = &mut found.by_place[r];
                place[0] -= by_x;
                place[1] -= by_y;
                place[2] -= z * by_x - cos * by_along;
                place[3] -= z * by_y - sin * by_along;
                let load = weighted * inverse * l.value;
                let motion = &mut found.by_motion[r];
                motion[0] -= load * cos;
                motion[1] -= load * sin;
                motion[2] -= load * z * cos;
                motion[3] -= load * z * sin;
            }
        }
    }
}
