//! Which gap carries the oil through a face where the shell gives way under the film?
//!
//! Where pressure opens the gap, `H = H_0 + u(p)`, the flow dragged along follows the pressure: with the gap in
//! the middle of both cells, `U (H_0 + (u_W + u_E)/2)`, it is a convection of pressure in central differences.
//! Once it outweighs conduction, `x = U w u'/G > 2` with the conductance G, those make pressures that
//! alternate from cell to cell. So the gap leans upstream:
//! ```text
//! T = U w ((1 - beta) H + beta H_up)        beta = x^2/(x^2 + 2 x + 4)
//! ```
//! which keeps the neighbour's pressure from driving oil upstream for every x (`1 - beta <= 2/x`). All of the
//! gap leans, not the displacement alone: between surfaces pressed together it hardly changes along the flow,
//! the displacement does. Where the film is narrower upstream, x is that of the narrower one: behind a
//! constriction no more leaves than it holds. Where the grid resolves the film, x shrinks with the cells, and
//! what is added with their third power. Faces at steps and before feeds, which do not give way, stay central.
//! Reference of such weights: S. V. Patankar, Numerical Heat Transfer and Fluid Flow, Hemisphere 1980, ch. 5.

use crate::gap::Gap;
use crate::grid::Grid;
use crate::nonlinear::Expansion;
use crate::passage::Passage;
use crate::reynolds::{Leaning, Operator};

/// Share of the upstream gap, and its derivative by the logarithm of `x`.
fn share(x: f64) -> (f64, f64) {
    const ALL: f64 = 1e12;
    if x.is_nan() {
        return (0.0, 0.0);
    }
    if x > ALL {
        return (1.0, 0.0);
    }
    let below = x * x + 2.0 * x + 4.0;
    (x * x / below, 2.0 * x * x * (x + 4.0) / (below * below))
}

/// A face with full derivatives of its gap.
struct Face<'a> {
    gap: &'a Gap,
    passage: Option<&'a Passage>,
    face: usize,
    up: usize,
    down: usize,
    /// Relative derivative of the conductance by H.
    conducting: f64,
    /// Displacement of the cell downstream per reduced pressure, and the relative derivative of that.
    softness: [f64; 2],
}

impl Face<'_> {
    /// How far the H that carries moves from that of the face, and the derivatives of this by the H of the
    /// face, of the cell upstream and of that downstream, and by the reduced pressure there.
    fn lean(&self, dragged_over_conductance: f64) -> [f64; 5] {
        let holding = |k: usize| self.passage.map_or([1.0, 0.0], |p| p.holding_slopes[k]);
        let carried_slope = self.passage.map_or(1.0, |p| p.carried_slopes[self.face]);
        let ([by_up, _], [held, curvature]) = (holding(self.up), holding(self.down));
        let (here, upstream) = (self.gap.around_transport[self.face], self.gap.mean[self.up]);
        // A film that is narrower upstream conducts no better than there.
        let narrowing = (upstream / here).clamp(0.0, 1.0);
        let open = narrowing * narrowing * narrowing;
        let [softness, stiffening] = self.softness;
        let x = dragged_over_conductance * held * softness / open;
        let (beta, slope) = share(x);
        let drop = upstream - here;
        let (mut log_by_face, mut log_by_up) = (-self.conducting, 0.0);
        if upstream < here && upstream > 0.0 {
            log_by_face += 3.0 * carried_slope / here;
            log_by_up -= 3.0 * by_up / upstream;
        }
        let by_share = drop * slope;
        [
            beta * drop,
            by_share * log_by_face - beta * carried_slope,
            by_share * log_by_up + beta * by_up,
            if held > 0.0 {
                by_share * curvature / held
            } else {
                0.0
            },
            by_share * stiffening,
        ]
    }
}

impl Expansion {
    /// Lets the gap of an operator that is complete lean upstream, and writes the derivatives into it; nothing
    /// for rigid shells and surfaces that drag nothing along. `softness` of a cell is its displacement per reduced
    /// pressure where no asperity holds it, and the relative derivative of that.
    pub fn lean(
        &self,
        grid: &Grid,
        gap: &Gap,
        passage: Option<&Passage>,
        softness: impl Fn(usize) -> [f64; 2],
        operator: &mut Operator,
    ) {
        operator.leaning.clear();
        let speed = operator.mean_speed;
        if self.displacement.is_empty() || speed == 0.0 {
            return;
        }
        let (n, m) = (operator.n_around, operator.n_axial);
        operator.leaning.resize((n + 1) * m, Leaning::default());
        let mut steps = gap.steps.as_slice();
        for face in 0..(n + 1) * m {
            let (i, j) = (face / m, face % m);
            let is_step = steps.first().is_some_and(|step| step.face == face);
            let [conducting, carrying] = match passage {
                Some(passage) => passage.around_slopes[face],
                None => gap.relative_slopes(face, &mut steps).into(),
            };
            let transport = operator.transport[face];
            let mut leaning = Leaning {
                by_face: carrying * transport,
                by_cells: [0.0; 2],
                by_pressure: 0.0,
            };
            let cells = operator.stations_beside(i).map(|i| i.map(|i| i * m + j));
            let ([Some(before), Some(behind)], false) = (cells, is_step) else {
                operator.leaning[face] = leaning;
                continue;
            };
            if transport * speed > 0.0 {
                let forth = speed > 0.0;
                let (up, down) = if forth {
                    (before, behind)
                } else {
                    (behind, before)
                };
                let pressed = Face {
                    gap,
                    passage,
                    face,
                    up,
                    down,
                    conducting,
                    softness: softness(down),
                };
                let dragged = speed * grid.axial_widths[j];
                let conductance = operator.conductance_around[face];
                let [moved, by_face, by_up, by_down, by_pressure] =
                    pressed.lean(dragged.abs() / conductance);
                leaning.by_pressure = dragged * by_pressure;
                operator.transport[face] += dragged * moved;
                leaning.by_face += dragged * by_face;
                leaning.by_cells = [by_up, by_down].map(|by| dragged * by);
                if !forth {
                    leaning.by_cells.reverse();
                }
            }
            operator.leaning[face] = leaning;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_driven_upstream() {
        for x in [0.0, 0.1, 1.0, 2.0, 5.0, 1e3] {
            let (beta, slope) = share(x);
            assert!((0.0..=1.0).contains(&beta), "{x}");
            assert!(0.5 * x * (1.0 - beta) <= 1.0, "{x}");
            let difference = (share(1.0001 * x).0 - share(0.9999 * x).0) / 2e-4;
            assert!((difference - slope).abs() < 1e-7, "{x}");
        }
        assert_eq!(share(f64::INFINITY), (1.0, 0.0));
        assert_eq!(share(f64::NAN), (0.0, 0.0));
    }
}
