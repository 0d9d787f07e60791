//! The paper's equation 20, node by node, with negative pressures set to 0 as they arise.
//!
//! ```text
//! u = max(0, u + r ((w_west u_west + w_east u_east + w_south u_south + w_north u_north - b)
//!                   / (w_west + w_east + w_south + w_north - a) - u))
//! w_west = 2/(d_west (d_west + d_east)) and so on; along the axis times (D/B)^2
//! ```
//! with `H_phiphi = 1 - H` of round journals the divisor is positive wherever neighbours are closer than a
//! radian. Newest neighbours are used (Gauss-Seidel); `r` is the relaxation.

use super::mesh::Mesh;
use crate::dimensionless::DimensionlessFilm;

/// Sweeps between two looks at the change: the rate of convergence is taken over them.
const SWEEPS_PER_LOOK: usize = 10;

/// The gap and what the equation needs of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct GapAt {
    /// H.
    pub height: f64,
    around: f64,
    axial: f64,
}

impl GapAt {
    pub(super) fn new(film: &DimensionlessFilm, phi: f64, z: f64) -> Self {
        let tilt = film.tilt_gamma * (1.0 - film.relative_eccentricity);
        let (sin, cos) = phi.sin_cos();
        let (along, across) = (film.relative_eccentricity - tilt * z, -film.tilt_delta * z);
        Self {
            height: 1.0 + along * cos + across * sin,
            around: -along * sin + across * cos,
            axial: -tilt * cos - film.tilt_delta * sin,
        }
    }

    /// Coefficient `a` of the transformed pressure.
    pub(super) fn reaction(&self, d_over_b: f64) -> f64 {
        let bend = 2.0 * self.height * (1.0 - self.height);
        let slopes = self.around.powi(2) + (d_over_b * self.axial).powi(2);
        -0.75 * (bend + slopes) / self.height.powi(2)
    }

    /// Right side `b`, wedge and squeeze together.
    fn source(&self, film: &DimensionlessFilm, phi: f64) -> f64 {
        (film.wedge * 6.0 * self.around + film.squeeze * 12.0 * phi.cos()) / self.height.powf(1.5)
    }
}

/// The five-point equations of one mesh.
#[derive(Debug, Clone)]
pub(super) struct Equations {
    /// Weights of the neighbours before and behind, by node around.
    around: Vec<[f64; 2]>,
    /// The same along the axis, by node; of no use at the edges.
    axial: Vec<[f64; 2]>,
    /// One over the divisor, by node.
    inverse: Vec<f64>,
    /// `b`, by node.
    source: Vec<f64>,
    /// Area of a node over H^(3/2): what its value adds to the integral of `Pi`.
    share: Vec<f64>,
    /// `Pi*` along the line of the widest gap where it is given.
    inlet: Option<Vec<f64>>,
}

impl Equations {
    /// Equations of `film` on `mesh`, with the pressure on the line of the widest gap where it is held.
    pub(super) fn new(film: &DimensionlessFilm, mesh: &Mesh, inlet: Option<f64>) -> Self {
        let gaps = |i: usize, j: usize| GapAt::new(film, mesh.around[i], mesh.axial[j]);
        let mut equations = Self::of(
            mesh,
            film.d_over_b,
            |i, j| gaps(i, j).reaction(film.d_over_b),
            |i, j| gaps(i, j).source(film, mesh.around[i]),
            |i, j| gaps(i, j).height.powf(-1.5),
        );
        equations.inlet = inlet.map(|pressure| {
            let line = 0..mesh.axial.len();
            line.map(|j| pressure.max(0.0) * gaps(0, j).height.powf(1.5))
                .collect()
        });
        equations
    }

    /// Equations with any coefficient, right side and weight in the integral, by node.
    pub(super) fn of(
        mesh: &Mesh,
        d_over_b: f64,
        reaction: impl Fn(usize, usize) -> f64,
        source: impl Fn(usize, usize) -> f64,
        share: impl Fn(usize, usize) -> f64,
    ) -> Self {
        let (rows, columns) = (mesh.around.len(), mesh.axial.len());
        let weights = |before: f64, behind: f64| {
            let span = 0.5 * (before + behind);
            [1.0 / (before * span), 1.0 / (behind * span)]
        };
        let steps_around =
            |i: usize| [mesh.step_around((i + rows - 1) % rows), mesh.step_around(i)];
        let around: Vec<_> = (0..rows)
            .map(steps_around)
            .map(|[b, a]| weights(b, a))
            .collect();
        let mut axial = vec![[0.0; 2]; columns];
        for (j, weight) in axial.iter_mut().enumerate().take(columns - 1).skip(1) {
            *weight = weights(mesh.step_axial(j - 1), mesh.step_axial(j))
                .map(|weight| d_over_b * d_over_b * weight);
        }
        let mut equations = Self {
            around,
            axial,
            inverse: vec![0.0; rows * columns],
            source: vec![0.0; rows * columns],
            share: vec![0.0; rows * columns],
            inlet: None,
        };
        for i in 0..rows {
            let [before, behind] = steps_around(i);
            for j in 1..columns - 1 {
                let at = i * columns + j;
                let width = 0.5 * (mesh.axial[j + 1] - mesh.axial[j - 1]);
                let neighbours: f64 = equations.around[i].iter().chain(&equations.axial[j]).sum();
                equations.inverse[at] = 1.0 / (neighbours - reaction(i, j));
                equations.source[at] = source(i, j);
                equations.share[at] = 0.5 * (before + behind) * width * share(i, j);
            }
        }
        equations
    }
}

/// What an iteration took.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Used {
    pub sweeps: usize,
    pub is_converged: bool,
}

/// Point iteration on one mesh.
pub(super) struct Iteration<'a> {
    equations: &'a Equations,
    values: Vec<f64>,
    /// The first sweep holds the pressure 0 on the line of the widest gap.
    is_first: bool,
}

impl<'a> Iteration<'a> {
    pub(super) fn new(equations: &'a Equations, mut values: Vec<f64>, is_first: bool) -> Self {
        if let Some(line) = &equations.inlet {
            let inner = 1..line.len() - 1;
            values[inner.clone()].copy_from_slice(&line[inner]);
        }
        Self {
            equations,
            values,
            is_first,
        }
    }

    /// Sweeps until what is still lacking, estimated from the change and the rate at which it falls, is below
    /// `tolerance` of the load, or `most` are used.
    pub(super) fn run(&mut self, relaxation: f64, tolerance: f64, most: usize) -> Used {
        let mut previous: Option<f64> = None;
        // Changes of an over-relaxed iteration swing: the slower of two rates counts.
        let mut slower = 1.0_f64;
        let mut sweeps = 0;
        while sweeps < most {
            let mut seen = [0.0; 2];
            for _ in 0..SWEEPS_PER_LOOK.min(most - sweeps) {
                let first_row = usize::from(self.is_first || self.equations.inlet.is_some());
                seen = self.sweep(relaxation, first_row);
                self.is_first = false;
                sweeps += 1;
            }
            let [change, load] = seen;
            let rate = previous.map_or(1.0, |previous| {
                (change / previous).powf(1.0 / SWEEPS_PER_LOOK as f64)
            });
            // The geometric series of the changes to come.
            let worst = rate.max(slower);
            let lacking = change * worst / (1.0 - worst);
            if change == 0.0 || (worst < 1.0 && lacking <= tolerance * load) {
                return Used {
                    sweeps,
                    is_converged: true,
                };
            }
            slower = rate;
            previous = Some(change);
        }
        Used {
            sweeps,
            is_converged: false,
        }
    }

    /// One sweep over all rows from `first_row` on: the change of the integral of `Pi` by size, and that
    /// integral.
    fn sweep(&mut self, relaxation: f64, first_row: usize) -> [f64; 2] {
        let (rows, columns) = (self.equations.around.len(), self.equations.axial.len());
        let (mut change, mut load) = (0.0, 0.0);
        for i in first_row..rows {
            let [west, east] = self.equations.around[i];
            let row = i * columns;
            let before = (i + rows - 1) % rows * columns;
            let behind = (i + 1) % rows * columns;
            for j in 1..columns - 1 {
                let at = row + j;
                let [south, north] = self.equations.axial[j];
                let around = west * self.values[before + j] + east * self.values[behind + j];
                let along = south * self.values[at - 1] + north * self.values[at + 1];
                let old = self.values[at];
                let found =
                    (around + along - self.equations.source[at]) * self.equations.inverse[at];
                let new = (old + relaxation * (found - old)).max(0.0);
                self.values[at] = new;
                change += (new - old).abs() * self.equations.share[at];
                load += new * self.equations.share[at];
            }
        }
        [change, load]
    }

    pub(super) fn into_values(self) -> Vec<f64> {
        self.values
    }
}
