//! Planar films, one cell wide: the operator with a closure, below the bearing.
//!
//! Lengths along the slider are over its length L, gaps over some h0; pressures are in the unit of
//! the operator, `p h0^2 / (12 eta L^2)`.
use sommerfeld_film::Grid;
use sommerfeld_film::cavitation::{CavitationModel, FilmSet};
use sommerfeld_film::gap::Gap;
use sommerfeld_film::linear::{RingFactor, RingMatrix};
use sommerfeld_film::reynolds::{Around, Axial, Cell, Operator, Storage};

/// Values that round-off alone keeps beyond their bound lie on it.
const ROUND_OFF: f64 = 1e-12;

/// A planar film between pressures at both ends (or closed), uniform across.
pub struct Planar {
    pub grid: Grid,
    pub operator: Operator,
    pub set: FilmSet,
    pub pressure: Vec<f64>,
    pub film_fraction: Vec<f64>,
    /// Entering beyond leaving per cell.
    pub excess: Vec<f64>,
    /// Largest flow.
    pub scale: f64,
    matrix: RingMatrix,
    factor: RingFactor,
    closure: Box<dyn CavitationModel>,
}

impl Planar {
    pub fn new(faces: Vec<f64>, around: Around, closure: Box<dyn CavitationModel>) -> Self {
        let grid = Grid::from_faces(faces, vec![0.0, 1.0]);
        let n = grid.n_around();
        let matrix = RingMatrix::new(n, 1, around == Around::Periodic);
        Self {
            operator: Operator::for_grid(&grid, around, Axial::Closed),
            set: FilmSet::full(n, 1),
            pressure: vec![0.0; n],
            film_fraction: vec![1.0; n],
            excess: vec![0.0; n],
            scale: 0.0,
            factor: RingFactor::new(&matrix),
            matrix,
            closure,
            grid,
        }
    }

    /// Solves for `gap`; returns the number of updates.
    pub fn solve(&mut self, gap: &Gap, mean_speed: f64, storage: Storage<'_>) -> usize {
        self.operator.update(&self.grid, gap, mean_speed, storage);
        self.operator
            .hold_feeds_to_edges(&self.grid, &self.set.cells);
        let n = self.grid.n_around();
        let mut x = vec![0.0; n];
        for update in 1..=30 + 2 * n {
            self.closure
                .assemble(&self.operator, &self.set, &mut self.matrix, &mut x);
            assert!(self.factor.factor(&self.matrix), "no film is determined");
            self.factor.solve(&mut x);
            self.put_on_bounds(&mut x);
            self.closure
                .fields(&self.set, &x, &mut self.pressure, &mut self.film_fraction);
            self.scale =
                self.operator
                    .balance(&self.pressure, &self.film_fraction, &mut self.excess);
            let moved = self.closure.update_set(
                &self.operator,
                &self.pressure,
                &self.film_fraction,
                &self.excess,
                ROUND_OFF * self.scale,
                &mut self.set,
            );
            if moved == 0 {
                return update;
            }
        }
        panic!("the cavitated set does not settle")
    }

    fn put_on_bounds(&self, x: &mut [f64]) {
        let flows = self.operator.transport.iter().chain(&self.operator.storage);
        let scale = ROUND_OFF * flows.fold(0.0_f64, |a, b| a.max(b.abs()));
        for (k, x) in x.iter_mut().enumerate() {
            let weight = self.matrix.centre[k];
            match self.set.cells[k] {
                Cell::Full if *x < 0.0 && -*x * weight <= scale => *x = 0.0,
                Cell::Ruptured if *x > 1.0 && (*x - 1.0) * weight <= scale => *x = 1.0,
                _ => {}
            }
        }
    }

    /// Content `theta H` of every cell, the start of the next step.
    pub fn content(&self, gap: &Gap) -> Vec<f64> {
        self.film_fraction
            .iter()
            .zip(&gap.mean)
            .map(|(theta, h)| theta * h)
            .collect()
    }

    /// `sum of f(x) P dx`.
    pub fn integral(&self, f: impl Fn(f64) -> f64) -> f64 {
        let cells = self.grid.around.iter().zip(&self.grid.around_widths);
        cells
            .zip(&self.pressure)
            .map(|((x, dx), p)| f(*x) * p * dx)
            .sum()
    }

    pub fn is_ruptured(&self) -> bool {
        self.set.cells.contains(&Cell::Ruptured)
    }

    /// Faces between which the film is ruptured, and the largest cell beside them: the first cavity.
    pub fn cavity(&self) -> Option<[f64; 2]> {
        let ruptured = |c: &Cell| *c == Cell::Ruptured;
        let first = self.set.cells.iter().position(ruptured)?;
        let last = self.set.cells.iter().rposition(ruptured)?;
        Some([
            self.grid.around_faces[first],
            self.grid.around_faces[last + 1],
        ])
    }

    /// Flow through the first face, and the largest deviation of any other face from it.
    pub fn flow(&self) -> (f64, f64) {
        let flow = |i: usize| {
            self.operator
                .flow_around(i, 0, &self.pressure, &self.film_fraction)
        };
        let first = flow(0);
        let worst = (0..=self.grid.n_around())
            .map(|i| (flow(i) - first).abs())
            .fold(0.0, f64::max);
        (first, worst)
    }
}

/// `n` even cells from `from` to `to`.
pub fn even_faces(from: f64, to: f64, n: usize) -> Vec<f64> {
    (0..=n)
        .map(|i| from + (to - from) * i as f64 / n as f64)
        .collect()
}

/// Order of an error that falls from `coarse` to `fine` on half the cell size.
pub fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).abs().log2()
}
