//! What pressure has the full film of an aligned journal, and how does it change with eccentricity?
//!
//! ```text
//! U_ss = g U + f     for each shape across the width, f for unit motion along and across
//! d^2 V = h^2 (g U + f),   V = U - h^2 t (g U + f),   t = 1/(12 (1 + x^2)),   x = h^2 g/12
//! ```
//! with d^2 the second difference: Numerov's scheme, of fourth order in the step h, whose weight 1/12
//! falls where the equation is stiff (short films where the gap is wide), so that it stays stable. The
//! answer to motion along the line of centres is even about it, the other odd: half a turn is solved
//! for both. Derivatives by eccentricity solve the same system and are those of the discrete answer.
//! References: B. V. Numerov, Mon. Not. R. Astron. Soc. 84 (1924) 592.

use super::across::Across;
use super::around::{Node, Substitution};
use std::f64::consts::PI;

/// Lanes of the two answers at a node: to motion along the line of centres, and across it.
pub(super) type Pair<const M: usize> = [[f64; M]; 2];

/// The full film around half a turn.
#[derive(Debug, Clone)]
pub(super) struct FullFilm<const M: usize> {
    /// (D/B)^2 lambda by shape.
    stiffness: [f64; M],
    /// Nodes s = 0 to pi, both ends included: cos and sin.
    trig: Vec<[f64; 2]>,
    /// Step in s.
    pub step: f64,
    /// The substitution of the last solution.
    pub map: Substitution,
    /// Coefficients at the nodes.
    pub nodes: Vec<Node>,
    rows: Vec<Row<M>>,
    /// Answers U by node.
    pub answer: Vec<Pair<M>>,
    /// Their derivatives by relative eccentricity.
    pub slope: Vec<Pair<M>>,
}

/// One row of the tridiagonal systems, by shape.
#[derive(Debug, Clone, Copy)]
struct Row<const M: usize> {
    /// h^2 g/chi and its derivative.
    gamma: [f64; M],
    gamma_slope: [f64; M],
    /// 1/chi with chi = 1 - h^2 g t, and its derivative.
    spread: [f64; M],
    spread_slope: [f64; M],
    /// t/chi times 12, and its derivative.
    share: [f64; M],
    share_slope: [f64; M],
    /// Inverse pivots of both systems.
    pivots: Pair<M>,
    /// Right-hand sides, then V.
    unknown: Pair<M>,
}

impl<const M: usize> FullFilm<M> {
    /// `count` steps over half a turn, for a film of this D/B.
    pub(super) fn new<const G: usize>(across: &Across<M, G>, d_over_b: f64, count: usize) -> Self {
        let step = PI / count as f64;
        let trig = (0..=count)
            .map(|j| {
                let s = step * j as f64;
                [s.cos(), if j == 0 || j == count { 0.0 } else { s.sin() }]
            })
            .collect();
        let zero = [[0.0; M]; 2];
        let row = Row {
            gamma: [0.0; M],
            gamma_slope: [0.0; M],
            spread: [0.0; M],
            spread_slope: [0.0; M],
            share: [0.0; M],
            share_slope: [0.0; M],
            pivots: zero,
            unknown: zero,
        };
        Self {
            stiffness: across.eigenvalues.map(|value| d_over_b * d_over_b * value),
            trig,
            step,
            map: Substitution::new(0.0),
            nodes: vec![Node::default(); count + 1],
            rows: vec![row; count + 1],
            answer: vec![zero; count + 1],
            slope: vec![zero; count + 1],
        }
    }

    /// cos and sin of s at the nodes.
    pub(super) fn trig(&self) -> &[[f64; 2]] {
        &self.trig
    }

    /// Fills answers and slopes at a relative eccentricity.
    pub(super) fn solve(&mut self, eps: f64) {
        self.assemble(eps);
        self.eliminate();
        self.substitute_back();
        let square = self.step * self.step;
        let twelfth = square / 12.0;
        let films = self.answer.iter_mut().zip(&mut self.slope);
        for ((row, node), (answer, slope)) in self.rows.iter_mut().zip(&self.nodes).zip(films) {
            for p in 0..2 {
                let f = node.source[p];
                for k in 0..M {
                    let v = row.unknown[p][k];
                    answer[p][k] = v * row.spread[k] + twelfth * f.value * row.share[k];
                    // The slope of V is still to come.
                    slope[p][k] = v * row.spread_slope[k]
                        + twelfth * (f.slope * row.share[k] + f.value * row.share_slope[k]);
                    row.unknown[p][k] = row.gamma_slope[k] * v
                        + square * (f.slope * row.spread[k] + f.value * row.spread_slope[k]);
                }
            }
        }
        self.eliminate_again();
        self.substitute_back();
        for (row, slope) in self.rows.iter().zip(&mut self.slope) {
            for p in 0..2 {
                for k in 0..M {
                    slope[p][k] += row.unknown[p][k] * row.spread[k];
                }
            }
        }
    }

    /// Coefficients and right-hand sides.
    fn assemble(&mut self, eps: f64) {
        self.map = Substitution::new(eps);
        let square = self.step * self.step;
        let twelfth = square / 12.0;
        let stiffness = self.stiffness;
        for ((row, node), [cos, sin]) in self.rows.iter_mut().zip(&mut self.nodes).zip(&self.trig) {
            *node = self.map.node(*cos, *sin);
            for k in 0..M {
                let g = stiffness[k] * node.stretch.value + node.potential.value;
                let g_slope = stiffness[k] * node.stretch.slope + node.potential.slope;
                let (x, x_slope) = (twelfth * g, twelfth * g_slope);
                let xx = x * x;
                // chi = 1 - x/(1 + x^2)
                let share = 1.0 / (1.0 + xx - x);
                let share_square = share * share * x_slope;
                let spread = (1.0 + xx) * share;
                let spread_slope = (1.0 - xx) * share_square;
                row.share[k] = share;
                row.share_slope[k] = (1.0 - 2.0 * x) * share_square;
                row.spread[k] = spread;
                row.spread_slope[k] = spread_slope;
                row.gamma[k] = 12.0 * x * spread;
                row.gamma_slope[k] = 12.0 * (x_slope * spread + x * spread_slope);
                row.unknown[0][k] = square * node.source[0].value * spread;
                row.unknown[1][k] = square * node.source[1].value * spread;
            }
        }
    }

    /// Forward sweep with new pivots: `-p V_j + V_(j+1) = right`, from the mirror at s = 0 for the
    /// even answer and from zero for the odd one.
    fn eliminate(&mut self) {
        let last = self.rows.len() - 1;
        let mut inverse = [[0.0; M]; 2];
        let mut right = [[0.0; M]; 2];
        for (j, row) in self.rows.iter_mut().enumerate() {
            let is_end = j == 0 || j == last;
            let even = if is_end { 0.5 } else { 1.0 };
            for k in 0..M {
                let diagonal = 2.0 + row.gamma[k];
                let pivot = even * diagonal - inverse[0][k];
                right[0][k] = even * row.unknown[0][k] + right[0][k] * inverse[0][k];
                inverse[0][k] = 1.0 / pivot;
                let pivot = diagonal - inverse[1][k];
                right[1][k] = row.unknown[1][k] + right[1][k] * inverse[1][k];
                inverse[1][k] = 1.0 / pivot;
            }
            if is_end {
                inverse[1] = [0.0; M];
                right[1] = [0.0; M];
            }
            row.pivots = inverse;
            row.unknown = right;
        }
    }

    /// The same for other right-hand sides.
    fn eliminate_again(&mut self) {
        let last = self.rows.len() - 1;
        let mut inverse = [[0.0; M]; 2];
        let mut right = [[0.0; M]; 2];
        for (j, row) in self.rows.iter_mut().enumerate() {
            let is_end = j == 0 || j == last;
            let even = if is_end { 0.5 } else { 1.0 };
            for k in 0..M {
                right[0][k] = even * row.unknown[0][k] + right[0][k] * inverse[0][k];
                right[1][k] = row.unknown[1][k] + right[1][k] * inverse[1][k];
            }
            if is_end {
                right[1] = [0.0; M];
            }
            inverse = row.pivots;
            row.unknown = right;
        }
    }

    fn substitute_back(&mut self) {
        let mut next = [[0.0; M]; 2];
        for row in self.rows.iter_mut().rev() {
            for p in 0..2 {
                for k in 0..M {
                    next[p][k] = (next[p][k] - row.unknown[p][k]) * row.pivots[p][k];
                }
            }
            row.unknown = next;
        }
    }
}
