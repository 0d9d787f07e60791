//! How do force and moment of a tilted film change with its motion and its place?
//!
//! ```text
//! F = -g.x, A x = b, A l = g:    dF = -(dg.x + l.(db - dA x))
//! ```
//! The adjoint l of each of the four forces gives all derivatives. A, b and g depend on the place by H,
//! and by where the elements are.

use super::{NODES, Place, TiltedFilm, TiltedForce, gap_at, split};

/// What changes with the gap and the arc at one node, for one adjoint.
#[derive(Debug, Clone, Copy, Default)]
struct Change {
    /// `dA` per H alike over the width, and per H that grows like Z.
    by_gap: [f64; 2],
    /// `dA` per arc.
    by_width: f64,
    /// `int l dZ` and `int Z l dZ`.
    integrals: [f64; 2],
}

impl<const M: usize> TiltedFilm<M> {
    /// Derivatives of the last force; its own place is left zero.
    pub(super) fn tangents(&self) -> TiltedForce {
        let mut found = TiltedForce::default();
        for e in 0..self.layout.count() {
            self.add_element(e, &mut found);
        }
        for r in 0..4 {
            for q in 0..4 {
                found.by_place[r][q] = -found.by_place[r][q];
                found.by_motion[r][q] = -found.by_motion[r][q];
            }
        }
        found
    }

    fn add_element(&self, e: usize, found: &mut TiltedForce) {
        let span = self.layout.span(e);
        let (pressures, _) = self.answer.as_chunks::<M>();
        let (adjoints, _) = self.adjoints.as_chunks::<M>();
        let nodes: [usize; NODES] = std::array::from_fn(|i| self.node(e, i));
        let shift = &self.shifts[e];
        // By the start of the element and by its arc.
        let mut by_start = [0.0; 4];
        let mut by_width: Place = shift.whole;
        for r in 0..4 {
            // n' is n turned by a quarter.
            let (other, sign) = if r % 2 == 0 {
                (r + 1, -1.0)
            } else {
                (r - 1, 1.0)
            };
            by_start[r] += span.width * sign * shift.whole[other];
            by_width[r] += span.width * sign * shift.moved[other];
        }
        for i in 0..NODES {
            let pressure: [f64; M] = std::array::from_fn(|m| pressures[nodes[i]][m][0]);
            let mut pressure_slope = [0.0; M];
            let mut adjoint_slope = [[0.0; 4]; M];
            for j in 0..NODES {
                let slope = self.rule.slopes[i][j];
                for m in 0..M {
                    pressure_slope[m] += slope * pressures[nodes[j]][m][0];
                    for r in 0..4 {
                        adjoint_slope[m][r] += slope * adjoints[nodes[j]][m][r];
                    }
                }
            }
            let changes = self.changes_at(
                gap_at(&self.place, span.trig[i]),
                span.width,
                &[pressure, pressure_slope],
                &adjoints[nodes[i]],
                &adjoint_slope,
            );
            let [cos, sin] = span.trig[i];
            let turned = [-sin, cos];
            let weight = self.rule.weights[i];
            let [drive, drive_to_rear] = split(&self.motion, span.trig[i]);
            let [rise, rise_to_rear] = split(&self.motion, turned);
            let [bend, bend_to_rear] = split(&self.place, turned);
            for r in 0..4 {
                let Change {
                    by_gap,
                    by_width: by_arc,
                    integrals,
                } = changes[r];
                let source = drive * integrals[0] + drive_to_rear * integrals[1];
                let source_slope = rise * integrals[0] + rise_to_rear * integrals[1];
                // H_theta is minus the bend.
                let gap_slope = -(bend * by_gap[0] + bend_to_rear * by_gap[1]);
                let by_angle = weight * (span.width * source_slope - gap_slope);
                by_start[r] += by_angle;
                by_width[r] += weight * (source - by_arc) + self.rule.places[i] * by_angle;
                for (q, n) in [cos, sin].into_iter().enumerate() {
                    for half in 0..2 {
                        found.by_place[r][2 * half + q] += weight * n * by_gap[half];
                        found.by_motion[r][2 * half + q] +=
                            weight * span.width * n * integrals[half];
                    }
                }
            }
        }
        for r in 0..4 {
            for q in 0..4 {
                found.by_place[r][q] +=
                    by_start[r] * span.start_slope[q] + by_width[r] * span.width_slope[q];
            }
        }
    }

    /// For each adjoint, what its form with the pressure changes by at a node.
    fn changes_at(
        &self,
        [middle, to_rear]: [f64; 2],
        width: f64,
        [pressure, pressure_slope]: &[[f64; M]; 2],
        adjoint: &[[f64; 4]; M],
        adjoint_slope: &[[f64; 4]; M],
    ) -> [Change; 4] {
        let around = self.across.mass.times(pressure_slope);
        let along = self.across.stiffness.times(pressure);
        let square = [
            3.0 * middle * middle,
            6.0 * middle * to_rear,
            3.0 * to_rear * to_rear,
        ];
        let cube = super::cubed([middle, to_rear]);
        let mut changes = [Change::default(); 4];
        for m in 0..M {
            let weigh = |products: &[[f64; M]; 4]| -> [f64; 3] {
                let mut sums = [0.0; 3];
                for k in 0..3 {
                    sums[0] += square[k] * products[k][m];
                    sums[1] += square[k] * products[k + 1][m];
                }
                for k in 0..4 {
                    sums[2] += cube[k] * products[k][m];
                }
                sums
            };
            let around = weigh(&around).map(|sum| sum / width);
            let along = weigh(&along).map(|sum| sum * width * self.aspect);
            let [even, odd] = self.across.integrals[m];
            for r in 0..4 {
                let (value, slope) = (adjoint[m][r], adjoint_slope[m][r]);
                let change = &mut changes[r];
                change.by_gap[0] += slope * around[0] + value * along[0];
                change.by_gap[1] += slope * around[1] + value * along[1];
                change.by_width += (value * along[2] - slope * around[2]) / width;
                change.integrals[0] += value * even;
                change.integrals[1] += value * odd;
            }
        }
        changes
    }
}
