//! What makes the equations of the film nonlinear: oil that is compressed, a shell that gives way.
//!
//! Through a face, per time and over the density without pressure,
//! ```text
//! flow = G(H)(q_W - q_E) + T(H) rho(q_up) theta_up        H = H_0 + (u_W + u_E)/2,  u = compliance p(q)
//! ```
//! The operator has G and T at the displacement of the last solution; what the density and the displacement
//! change by is added here, linear in the new solution (Newton): for constant density and a rigid shell
//! nothing is. Derivatives of the displacement go to both cells of a face alike, those of the density to
//! the cell upstream, whose column stays one of a matrix that needs no pivoting.

use crate::cavitation::FilmSet;
use crate::gap::{EndFace, Gap};
use crate::linear::RingMatrix;
use crate::passage::Passage;
use crate::reynolds::{Cell, Operator};

/// The state about which the film is linearised: the last solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Expansion {
    /// Reduced pressure per cell, 1/s.
    pub pressure: Vec<f64>,
    /// Content per cell, over the full film without pressure: film fraction times density.
    pub content: Vec<f64>,
    /// Density of a full cell over that without pressure, and its derivative by the reduced pressure;
    /// empty for an incompressible oil.
    pub density: Vec<[f64; 2]>,
    /// Displacement of the shell in a cell over the clearance, and its derivative by the reduced pressure;
    /// empty for a rigid shell.
    pub displacement: Vec<[f64; 2]>,
}

impl Expansion {
    /// About a full film without pressure, of so many cells.
    #[must_use]
    pub fn new(cells: usize, is_compressible: bool, is_soft: bool) -> Self {
        let sized = |needed: bool, value| vec![value; if needed { cells } else { 0 }];
        Self {
            pressure: vec![0.0; cells],
            content: vec![1.0; cells],
            density: sized(is_compressible, [1.0, 0.0]),
            displacement: sized(is_soft, [0.0; 2]),
        }
    }

    /// Neither density nor displacement depends on the pressure.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.density.is_empty() && self.displacement.is_empty()
    }

    /// Goes back to a full film without pressure.
    pub(crate) fn forget(&mut self) {
        self.pressure.fill(0.0);
        self.content.fill(1.0);
        self.density.fill([1.0, 0.0]);
        self.displacement.fill([0.0; 2]);
    }

    /// Opens the gap by the displacement; around a ring, or between two ends.
    ///
    /// With `conducts_at_ends` the half cells at both ends conduct with the mean of H^3 over the pressure
    /// ([`EndFace`]): where the rigid shapes overlap, the film closes towards an end, and the H in the middle
    /// may be below zero.
    pub fn open(&self, gap: &mut Gap, n_axial: usize, ends: EndOpening, is_ring: bool) {
        gap.ends.clear();
        if self.displacement.is_empty() {
            return;
        }
        let m = n_axial;
        let n = self.displacement.len() / m;
        let conducts_at_ends = ends.conducts;
        if conducts_at_ends {
            gap.ends.resize(2 * n, EndFace::default());
        }
        let of = |k: usize| self.displacement[k][0];
        for face in 0..(n + 1) * m {
            let (i, j) = (face / m, face % m);
            let (before, behind) = match i {
                0 if !is_ring => (ends.around[0], of(j)),
                i if i == n && !is_ring => (of((n - 1) * m + j), ends.around[1]),
                i => (of((i + n - 1) % n * m + j), of(i % n * m + j)),
            };
            let height = gap.around_transport[face] + 0.5 * (before + behind);
            gap.around_transport[face] = height;
            gap.around_cubed[face] = height * height * height;
        }
        for i in 0..n {
            for j in 0..=m {
                let before = if j > 0 { of(i * m + j - 1) } else { ends.axial };
                let behind = if j < m { of(i * m + j) } else { ends.axial };
                gap.axial[i * (m + 1) + j] += 0.5 * (before + behind);
            }
            if conducts_at_ends {
                for (end, j, cell) in [(0, 0, i * m), (1, m, i * m + m - 1)] {
                    let height = &mut gap.axial[i * (m + 1) + j];
                    let rigid = *height - 0.5 * (ends.axial + of(cell));
                    let face = EndFace::between(rigid + of(cell), rigid + ends.axial);
                    *height = face.height;
                    gap.ends[2 * i + end] = face;
                }
            }
        }
        for (mean, [opened, _]) in gap.mean.iter_mut().zip(&self.displacement) {
            *mean += opened;
        }
    }

    /// Adds the terms of density and displacement to the equations of a set.
    pub fn add_to(&self, film: &FilmEquations<'_>, matrix: &mut RingMatrix, rhs: &mut [f64]) {
        if self.is_linear() {
            return;
        }
        let mut equations = Equations { film, matrix, rhs };
        self.add_around(film, &mut equations);
        if !self.displacement.is_empty() {
            self.add_axial(film, &mut equations);
        }
        for k in 0..self.pressure.len() {
            self.add_stored(film, &mut equations, k);
        }
    }

    fn add_around(&self, film: &FilmEquations<'_>, equations: &mut Equations<'_>) {
        let operator = film.operator;
        let (n, m) = (operator.n_around, operator.n_axial);
        let mut steps = film.gap.steps.as_slice();
        let is_ring = operator.west(0, 0).is_some();
        for face in 0..if is_ring { n * m } else { (n + 1) * m } {
            let (i, j) = (face / m, face % m);
            let before = match i {
                0 => operator.west(0, j),
                _ => Some(face - m),
            };
            let behind = (i < n).then_some(face);
            let transport = operator.transport[face];
            if let Some(up) = if transport > 0.0 { before } else { behind } {
                self.add_density(equations, [before, behind], up, transport);
            }
            if self.displacement.is_empty() {
                continue;
            }
            let [conducting, carrying] = match film.passage {
                Some(passage) => passage.around_slopes[face],
                None => film.gap.relative_slopes(face, &mut steps).into(),
            };
            let (p_before, held_before) = operator.beside(before, 0, &self.pressure, &self.content);
            let (p_behind, held_behind) = operator.beside(behind, 1, &self.pressure, &self.content);
            let upstream = if transport > 0.0 {
                held_before
            } else {
                held_behind
            };
            let leaning = operator.leaning.get(face);
            let carried = leaning.map_or(carrying * transport, |leaning| leaning.by_face);
            let by_height = conducting * operator.conductance_around[face] * (p_before - p_behind)
                + carried * upstream;
            let by_cells = leaning.map_or([0.0; 2], |leaning| leaning.by_cells);
            let by_heights = by_cells.map(|by_cell| 0.5 * by_height + by_cell * upstream);
            self.add_displacement(equations, [before, behind], by_heights);
            if let (Some(leaning), Some(down)) =
                (leaning, if transport > 0.0 { behind } else { before })
                && equations.film.set.cells[down] == Cell::Full
            {
                let slope = leaning.by_pressure * upstream;
                let constant = -slope * self.pressure[down];
                equations.add_flow([before, behind], constant, &[(down, slope)]);
            }
        }
    }

    fn add_axial(&self, film: &FilmEquations<'_>, equations: &mut Equations<'_>) {
        let operator = film.operator;
        let (n, m) = (operator.n_around, operator.n_axial);
        for face in 0..n * (m + 1) {
            let (i, j) = (face / (m + 1), face % (m + 1));
            let before = (j > 0).then(|| i * m + j - 1);
            let behind = (j < m).then_some(i * m + j);
            let slope = match film.passage {
                Some(passage) => passage.axial_slopes[face],
                None => 3.0 / film.gap.axial[face],
            };
            let by_height = slope * operator.flow_axial(i, j, &self.pressure);
            // An end opens with the cell beside it.
            let [_, yielding] = film.gap.end_slopes(i, j, m);
            let by_heights = [0.5 * yielding * by_height; 2];
            self.add_displacement(equations, [before, behind], by_heights);
        }
    }

    /// The flow `transport` through a face carries the density of the cell upstream.
    fn add_density(
        &self,
        equations: &mut Equations<'_>,
        sides: [Option<usize>; 2],
        up: usize,
        transport: f64,
    ) {
        if let (Some([density, slope]), Cell::Full) =
            (self.density.get(up), equations.film.set.cells[up])
        {
            let constant = density - 1.0 - slope * self.pressure[up];
            equations.add_flow(sides, transport * constant, &[(up, transport * slope)]);
        }
    }

    /// The flow through a face rises by `by_heights` per H that either side opens by.
    fn add_displacement(
        &self,
        equations: &mut Equations<'_>,
        sides: [Option<usize>; 2],
        by_heights: [f64; 2],
    ) {
        let mut slopes = [(0, 0.0); 2];
        let mut constant = 0.0;
        for ((slope, cell), by_height) in slopes.iter_mut().zip(sides).zip(by_heights) {
            let Some(cell) = cell else { continue };
            // A pressure that was cut does not move the shell.
            if equations.film.set.cells[cell] == Cell::Full && self.pressure[cell] >= 0.0 {
                let value = by_height * self.displacement[cell][1];
                constant -= value * self.pressure[cell];
                *slope = (cell, value);
            }
        }
        equations.add_flow(sides, constant, &slopes);
    }

    /// What a full cell holds.
    fn add_stored(&self, film: &FilmEquations<'_>, equations: &mut Equations<'_>, k: usize) {
        if film.set.cells[k] != Cell::Full {
            return;
        }
        let (mut slope, mut constant) = (0.0, 0.0);
        if let Some([density, by_pressure]) = self.density.get(k) {
            slope += film.operator.storage[k] * by_pressure;
            constant += film.operator.storage[k] * (density - 1.0 - by_pressure * self.pressure[k]);
        }
        if let Some([_, by_pressure]) = self.displacement.get(k)
            && self.pressure[k] >= 0.0
        {
            let held = film
                .passage
                .map_or(1.0, |passage| passage.holding_slopes[k][0]);
            let by_height = film.held_per_height[k] * held * by_pressure * self.content[k];
            slope += by_height;
            constant -= by_height * self.pressure[k];
        }
        equations.matrix.centre[k] += slope;
        equations.rhs[k] -= constant;
    }
}

/// Displacement of the shell at the boundaries, over the clearance: that of the pressures there.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EndOpening {
    /// Before the first and behind the last cell around, where the film is no ring.
    pub around: [f64; 2],
    /// At both ends along the axis.
    pub axial: f64,
    /// The gap there is one of smooth surfaces, which oil leaves through.
    pub conducts: bool,
}

/// The film that is linearised.
#[derive(Debug, Clone, Copy)]
pub struct FilmEquations<'a> {
    /// Its balance.
    pub operator: &'a Operator,
    /// Its set.
    pub set: &'a FilmSet,
    /// Its gap.
    pub gap: &'a Gap,
    /// What that lets through, where it is not smooth.
    pub passage: Option<&'a Passage>,
    /// Flow into store per H, 1/s, per cell: its area over the duration of a step; 0 in a steady film.
    pub held_per_height: &'a [f64],
    /// Rows of ruptured cells are balances.
    pub conserves_mass: bool,
}

struct Equations<'a> {
    film: &'a FilmEquations<'a>,
    matrix: &'a mut RingMatrix,
    rhs: &'a mut [f64],
}

impl Equations<'_> {
    /// The row of a cell is a balance of flows.
    fn is_balance(&self, cell: usize) -> bool {
        match self.film.set.cells[cell] {
            Cell::Full => true,
            Cell::Ruptured => self.film.conserves_mass,
            Cell::Fed => false,
        }
    }

    /// Adds a flow `constant + sum of slope x unknown` from the first side to the second.
    fn add_flow(&mut self, sides: [Option<usize>; 2], constant: f64, slopes: &[(usize, f64)]) {
        for (side, sign) in sides.into_iter().zip([1.0, -1.0]) {
            let Some(row) = side.filter(|row| self.is_balance(*row)) else {
                continue;
            };
            self.rhs[row] -= sign * constant;
            for (column, slope) in slopes {
                if *slope != 0.0 {
                    *self.entry(row, *column) += sign * slope;
                }
            }
        }
    }

    fn entry(&mut self, row: usize, column: usize) -> &mut f64 {
        let m = self.matrix.n_axial;
        let matrix = &mut *self.matrix;
        if row == column {
            &mut matrix.centre[row]
        } else if row / m == column / m {
            if column < row {
                &mut matrix.south[row]
            } else {
                &mut matrix.north[row]
            }
        } else if self.film.operator.west(row / m, row % m) == Some(column) {
            &mut matrix.west[row]
        } else {
            &mut matrix.east[row]
        }
    }
}
