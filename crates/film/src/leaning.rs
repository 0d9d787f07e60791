//! Which gap carries the oil through a face where the shell gives way under the film?
//!
//! Where pressure opens the gap, `H = H_0 + u(p)`, the flow dragged along follows the pressure: with the gap in
//! the middle of both cells, `U (H_0 + (u_W + u_E)/2)`, it is a convection of pressure in central differences.
//! Once it outweighs conduction, `x = U w u'/G > 2` with the conductance G, those make pressures that
//! alternate from cell to cell. So the gap leans upstream:
//! ```text
//! T = U w (H + beta/2 (H_up - H_down))        beta = x^2/(x^2 + 2 x + 4)
//! ```
//! which keeps the neighbour's pressure from driving oil upstream for every x (`1 - beta <= 2/x`). All of the
//! gap leans, not the displacement alone: between surfaces pressed together it hardly changes along the flow,
//! the displacement does. Where the grid resolves the film, x shrinks with the cells, and what is added with
//! their third power. Faces at steps and beside feeds, whose cells do not give way, stay central.
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

impl Expansion {
    /// Lets the gap of an operator that is complete lean upstream, and writes the derivatives into it; nothing
    /// for rigid shells and surfaces that drag nothing along.
    pub fn lean(&self, grid: &Grid, gap: &Gap, passage: Option<&Passage>, operator: &mut Operator) {
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
            };
            let cells = operator.stations_beside(i).map(|i| i.map(|i| i * m + j));
            if let ([Some(before), Some(behind)], false) = (cells, is_step)
                && transport * speed > 0.0
            {
                let (up, down) = if speed > 0.0 {
                    (before, behind)
                } else {
                    (behind, before)
                };
                let dragged = speed * grid.axial_widths[j];
                let holding = |k: usize| passage.map_or([1.0, 0.0], |p| p.holding_slopes[k]);
                let [held, curvature] = holding(down);
                let conductance = operator.conductance_around[face];
                let x = dragged.abs() * held * self.displacement[down][1] / conductance;
                let (beta, slope) = share(x);
                let drop = gap.mean[up] - gap.mean[down];
                let by_share = 0.5 * dragged * drop * slope;
                operator.transport[face] += 0.5 * dragged * beta * drop;
                leaning.by_face -= by_share * conducting;
                let by_up = 0.5 * dragged * beta * holding(up)[0];
                let mut by_down = -0.5 * dragged * beta * held;
                if held > 0.0 {
                    by_down += by_share * curvature / held;
                }
                leaning.by_cells = if up == before {
                    [by_up, by_down]
                } else {
                    [by_down, by_up]
                };
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
