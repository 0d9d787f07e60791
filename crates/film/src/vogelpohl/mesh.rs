//! Nodes around and along the axis with variable steps, laid by the gradient of a pressure.
//!
//! ```text
//! node density = (1 - s)/length + s g(x)/integral of g       g = largest |dPi/dx| on the line, smoothed
//! ```
//! Nodes are equidistributed: the same integral of the density lies between neighbours. The share `s` of
//! the nodes goes where the pressure is steep, the rest evenly, so that no step is more than
//! `1/(1 - s)` times the even one. The paper says that the density follows the gradient, not how.

use std::f64::consts::{PI, TAU};

/// Share of the nodes that follow the gradient.
const SHARE: f64 = 0.5;
/// Passes of the mean over neighbours are the square of the intervals over this: each spreads by the root of
/// half an interval squared, together over a 34th of the line on every mesh, so that meshes converge with the
/// grid. Gradients vanish at the peak, where the mesh must stay dense, and noise must not show in the steps.
const INTERVALS_FOR_ONE_PASS: usize = 24;

/// Nodes of a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Angles from the widest gap, rad, ascending from 0 to below 2 pi: the ring closes to the first.
    pub around: Vec<f64>,
    /// Relative axial coordinates, ascending from -1 to 1, both edges included.
    pub axial: Vec<f64>,
}

impl Mesh {
    /// Even steps.
    #[must_use]
    pub fn uniform([n_around, n_axial]: [usize; 2]) -> Self {
        let even = |count: usize, last: usize, from: f64, length: f64| -> Vec<f64> {
            let step = length / count as f64;
            (0..=last).map(|k| from + step * k as f64).collect()
        };
        let mut mesh = Self {
            around: even(n_around, n_around.saturating_sub(1), 0.0, TAU),
            axial: even(n_axial, n_axial, -1.0, 2.0),
        };
        if let Some(edge) = mesh.axial.last_mut() {
            *edge = 1.0;
        }
        mesh
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.around.len() * self.axial.len()
    }

    /// Step from node `i` around to the next, rad.
    #[must_use]
    pub fn step_around(&self, i: usize) -> f64 {
        let next = self.around.get(i + 1).copied().unwrap_or(TAU);
        next - self.around[i]
    }

    /// Step from node `j` along the axis to the next.
    #[must_use]
    pub fn step_axial(&self, j: usize) -> f64 {
        self.axial[j + 1] - self.axial[j]
    }

    /// A mesh of so many intervals whose density follows the gradient of `pressure`, given on the
    /// nodes of this one.
    #[must_use]
    pub fn remeshed(&self, pressure: &[f64], [n_around, n_axial]: [usize; 2]) -> Self {
        let (rows, columns) = (self.around.len(), self.axial.len());
        let at = |i: usize, j: usize| pressure[(i % rows) * columns + j];
        let steepest_around = (0..rows).map(|i| {
            let rise = (0..columns).map(|j| (at(i + 1, j) - at(i, j)).abs());
            rise.fold(0.0, f64::max) / self.step_around(i)
        });
        let steepest_axial = (0..columns - 1).map(|j| {
            let rise = (0..rows).map(|i| (at(i, j + 1) - at(i, j)).abs());
            rise.fold(0.0, f64::max) / self.step_axial(j)
        });
        let mut closed = self.around.clone();
        closed.push(TAU);
        let mut around = laid(&closed, steepest_around.collect(), n_around, Ends::Meet);
        around.truncate(n_around);
        Self {
            around,
            axial: laid(&self.axial, steepest_axial.collect(), n_axial, Ends::Apart),
        }
    }

    /// Values on the nodes of this mesh, interpolated linearly to those of `other`.
    #[must_use]
    pub fn carried_to(&self, other: &Self, values: &[f64]) -> Vec<f64> {
        let columns = self.axial.len();
        let along: Vec<_> = other
            .axial
            .iter()
            .map(|z| bracket(&self.axial, *z))
            .collect();
        let mut carried = Vec::with_capacity(other.nodes());
        for phi in &other.around {
            let (i, share) = self.bracket_around(*phi);
            let next = (i + 1) % self.around.len();
            for (j, part) in &along {
                let on = |row: usize| {
                    let at = row * columns + j;
                    values[at] + part * (values[at + 1] - values[at])
                };
                carried.push(on(i) + share * (on(next) - on(i)));
            }
        }
        carried
    }

    fn bracket_around(&self, phi: f64) -> (usize, f64) {
        let after = self.around.partition_point(|node| *node <= phi);
        let i = after.saturating_sub(1);
        (i, (phi - self.around[i]) / self.step_around(i))
    }
}

/// Interval that holds `x`, and the place in it from 0 to 1.
fn bracket(nodes: &[f64], x: f64) -> (usize, f64) {
    let after = nodes.partition_point(|node| *node <= x);
    let i = after.clamp(1, nodes.len() - 1) - 1;
    (i, (x - nodes[i]) / (nodes[i + 1] - nodes[i]))
}

/// How the ends of a line of intervals are neighbours.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ends {
    Meet,
    Apart,
}

/// `count + 1` nodes over those of `nodes`, equidistributed over the steepness of its intervals.
fn laid(nodes: &[f64], mut steepness: Vec<f64>, count: usize, ends: Ends) -> Vec<f64> {
    let intervals = steepness.len();
    for _ in 0..1 + (intervals / INTERVALS_FOR_ONE_PASS).pow(2) {
        steepness = smoothed(&steepness, ends);
    }
    let (first, length) = (nodes[0], nodes[intervals] - nodes[0]);
    let step = |k: usize| nodes[k + 1] - nodes[k];
    let whole: f64 = (0..intervals).map(|k| steepness[k] * step(k)).sum();
    // No pressure at all: even steps.
    let share = if whole > 0.0 { SHARE } else { 0.0 };
    let of_interval = |k: usize| {
        let steep = if whole > 0.0 {
            steepness[k] / whole
        } else {
            0.0
        };
        (1.0 - share) / length + share * steep
    };
    // Densities on the nodes, linear between them, so that neighbouring steps differ little.
    let density: Vec<f64> = (0..=intervals)
        .map(|k| {
            let (before, behind) = match (k, ends) {
                (0, Ends::Apart) => (0, 0),
                (k, Ends::Apart) if k == intervals => (k - 1, k - 1),
                (0, Ends::Meet) => (intervals - 1, 0),
                (k, Ends::Meet) if k == intervals => (k - 1, 0),
                (k, _) => (k - 1, k),
            };
            0.5 * (of_interval(before) + of_interval(behind))
        })
        .collect();
    let mut below = vec![0.0];
    for k in 0..intervals {
        below.push(below[k] + 0.5 * (density[k] + density[k + 1]) * step(k));
    }
    let total = below[intervals];
    (0..=count)
        .map(|n| {
            if n == 0 {
                return first;
            }
            if n == count {
                return nodes[intervals];
            }
            let target = total * n as f64 / count as f64;
            let k = below
                .partition_point(|part| *part <= target)
                .clamp(1, intervals)
                - 1;
            let (low, high) = (density[k], density[k + 1]);
            // Root of step (low t + (high - low) t^2/2) = rest, in the form without cancellation.
            let rest = (target - below[k]) / step(k);
            let root = (low * low + 2.0 * (high - low) * rest).max(0.0).sqrt();
            nodes[k] + step(k) * (2.0 * rest / (low + root)).min(1.0)
        })
        .collect()
}

/// The mean of each value with its neighbours, itself counted twice.
fn smoothed(values: &[f64], ends: Ends) -> Vec<f64> {
    let last = values.len() - 1;
    let beyond = |k: usize, otherwise: usize| if ends == Ends::Meet { k } else { otherwise };
    (0..=last)
        .map(|k| {
            let before = if k == 0 { beyond(last, 0) } else { k - 1 };
            let behind = if k == last { beyond(0, last) } else { k + 1 };
            0.25 * (values[before] + 2.0 * values[k] + values[behind])
        })
        .collect()
}

/// Angle within (-pi, pi].
pub(super) fn wrapped(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if turned > PI { turned - TAU } else { turned }
}
