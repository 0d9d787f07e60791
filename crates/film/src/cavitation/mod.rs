//! Where does the film rupture, and what holds there?
//!
//! Every cell is full, ruptured or fed. For a given set the discrete equations are linear: full
//! cells have the pressure as unknown, ruptured ones what the closure says (a film fraction, or
//! nothing). A closure assembles the equations of a set and, from their solution, names the next
//! set. When the set repeats, the complementarity `p >= p_cav`, `theta <= 1` holds exactly: an
//! active-set method (policy iteration), finite for these matrices.

mod gumbel;
mod mass_conserving;
mod reynolds;

pub use gumbel::Gumbel;
pub use mass_conserving::MassConserving;
pub use reynolds::Reynolds;

use crate::bearing::Cavitation;
use crate::linear::RingMatrix;
use crate::reynolds::{Around, Axial, Cell, Operator};

/// A closure for the ruptured film.
pub trait CavitationModel: Send + Sync {
    /// Oil is conserved in every cell.
    fn conserves_mass(&self) -> bool;

    /// Pressures below cavitation pressure are part of the solution and cut afterwards: no cell and
    /// no feed ruptures.
    fn cuts_pressures(&self) -> bool {
        false
    }

    /// Ruptured cells have a known pressure and are no unknowns.
    fn knows_pressures(&self) -> bool {
        false
    }

    /// Writes the linear equations of the set into `matrix` and `rhs`.
    fn assemble(
        &self,
        operator: &Operator,
        set: &FilmSet,
        matrix: &mut RingMatrix,
        rhs: &mut [f64],
    );

    /// Splits the solution of the set's equations into pressure (1/s) and film fraction.
    fn fields(
        &self,
        set: &FilmSet,
        solution: &[f64],
        pressure: &mut [f64],
        film_fraction: &mut [f64],
    );

    /// The pressure that solves the set's equations, where that is not the one of
    /// [`CavitationModel::fields`]: the tangents need it.
    fn equation_pressure<'a>(&self, _solution: &'a [f64], pressure: &'a [f64]) -> &'a [f64] {
        pressure
    }

    /// Makes a set that comes from another gap or grid one whose equations have a solution.
    fn admit_set(&self, _operator: &Operator, _set: &mut FilmSet) {}

    /// Moves every cell that breaks a condition to its other state; returns how many moved.
    /// `excess` is what enters each cell beyond what leaves it (1/s), `tolerance` the flow (1/s)
    /// below which a violation is round-off.
    fn update_set(
        &self,
        operator: &Operator,
        pressure: &[f64],
        film_fraction: &[f64],
        excess: &[f64],
        tolerance: f64,
        set: &mut FilmSet,
    ) -> usize;

    /// Whether the unknown of a cell acts on the journal: every full cell's pressure does, unless the
    /// closure cuts it.
    fn loaded(&self, set: &FilmSet, _solution: &[f64], cell: usize) -> bool {
        set.cells[cell] == Cell::Full
    }
}

/// The closures that a study can name.
#[must_use]
pub fn model_of(cavitation: Cavitation) -> Box<dyn CavitationModel> {
    match cavitation {
        Cavitation::Gumbel => Box::new(Gumbel),
        Cavitation::Reynolds => Box::new(Reynolds),
        Cavitation::MassConserving => Box::new(MassConserving),
    }
}

/// State of every cell, and of the ends against air.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmSet {
    /// State per cell.
    pub cells: Vec<Cell>,
    /// Pressure of fed cells, 1/s.
    pub fed_pressure: Vec<f64>,
    /// Film fraction of fed cells: 1, or less where a line brings less than the film takes.
    pub fed_fraction: Vec<f64>,
    /// Per station and end (`2 i + end`): oil leaves there. Closed where air would be drawn in.
    pub end_open: Vec<bool>,
}

impl FilmSet {
    /// A full film without feeds.
    #[must_use]
    pub fn full(n_around: usize, n_axial: usize) -> Self {
        Self {
            cells: vec![Cell::Full; n_around * n_axial],
            fed_pressure: vec![0.0; n_around * n_axial],
            fed_fraction: vec![1.0; n_around * n_axial],
            end_open: vec![true; 2 * n_around],
        }
    }

    /// Opens all ends; returns how many were closed.
    fn open_ends(&mut self) -> usize {
        let closed = self.end_open.iter().filter(|open| !**open).count();
        self.end_open.fill(true);
        closed
    }

    /// Opens ends that oil wants to leave through and closes those that would draw in air.
    fn update_ends(&mut self, operator: &Operator, pressure: &[f64], tolerance: f64) -> usize {
        let Axial::Air(air) = operator.axial else {
            return 0;
        };
        let m = operator.n_axial;
        let mut moved = 0;
        for (i, ends) in self.end_open.chunks_exact_mut(2).enumerate() {
            for (end, cell, face) in [(0, i * m, 0), (1, i * m + m - 1, m)] {
                let conductance = operator.conductance_axial[i * (m + 1) + face];
                let outflow = conductance * (pressure[cell] - air);
                // Air at rest against oil at rest: what round-off makes of nothing must not switch.
                let still = 1e-12 * conductance * (pressure[cell].abs() + air.abs());
                let tolerance = tolerance.max(still);
                let turns = if ends[end] {
                    outflow < -tolerance
                } else {
                    outflow > tolerance
                };
                moved += usize::from(turns);
                ends[end] ^= turns;
            }
        }
        moved
    }
}

/// What the equation of a ruptured cell is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RupturedRow {
    /// The balance of the cell, with its film fraction as the unknown.
    FilmFraction,
    /// The cavitation pressure.
    Known,
}

/// Writes the balance of every cell, the same for all closures but for ruptured cells.
fn assemble_balance(
    operator: &Operator,
    set: &FilmSet,
    ruptured: RupturedRow,
    matrix: &mut RingMatrix,
    rhs: &mut [f64],
) {
    let (n, m) = (operator.n_around, operator.n_axial);
    matrix.flows_east = operator.mean_speed >= 0.0;
    for i in 0..n {
        let [before, behind] = [
            operator.stations_beside(i)[0],
            operator.stations_beside(i + 1)[1],
        ];
        let is_full = |station: Option<usize>| {
            station.is_some_and(|i| {
                set.cells[i * m..(i + 1) * m]
                    .iter()
                    .all(|c| *c == Cell::Full)
            })
        };
        if is_full(Some(i)) && is_full(before) && is_full(behind) {
            assemble_full_station(operator, set, i, matrix, rhs);
            continue;
        }
        for j in 0..m {
            let k = i * m + j;
            let cell = set.cells[k];
            (matrix.west[k], matrix.east[k]) = (0.0, 0.0);
            (matrix.south[k], matrix.north[k]) = (0.0, 0.0);
            matrix.loaded[k] = cell == Cell::Full;
            let known = match (cell, ruptured) {
                (Cell::Fed, _) => Some(set.fed_pressure[k]),
                (Cell::Ruptured, RupturedRow::Known) => Some(0.0),
                _ => None,
            };
            if let Some(value) = known {
                matrix.centre[k] = 1.0;
                rhs[k] = value;
                continue;
            }
            let own = if cell == Cell::Full { 1.0 } else { 0.0 };
            let mut row = if cell == Cell::Full {
                Row {
                    centre: 0.0,
                    rhs: operator.stored[k] - operator.storage[k],
                }
            } else {
                Row {
                    centre: operator.ruptured_storage[k],
                    rhs: operator.stored[k],
                }
            };
            let [west, east] = [before, behind].map(|station| station.map(|i| i * m + j));
            let (west_face, east_face) = (k, k + m);
            let faces = (west_face, east_face);
            let conductances = (
                operator.conductance_around[faces.0],
                operator.conductance_around[faces.1],
            );
            matrix.west[k] = row.conduct(operator, set, west, 0, conductances.0, own);
            matrix.east[k] = row.conduct(operator, set, east, 1, conductances.1, own);
            let film_fraction = ruptured == RupturedRow::FilmFraction;
            // A positive flow is outward here: through the east face, against the west face.
            for (outward, neighbour, entry) in [
                (-operator.transport[faces.0], west, &mut matrix.west[k]),
                (operator.transport[faces.1], east, &mut matrix.east[k]),
            ] {
                let ruptured_at = |c: usize| film_fraction && set.cells[c] == Cell::Ruptured;
                if outward > 0.0 && ruptured_at(k) {
                    row.centre += outward;
                } else if outward <= 0.0 && neighbour.is_some_and(ruptured_at) {
                    *entry += outward;
                } else if outward <= 0.0 {
                    let fed = neighbour.filter(|&c| set.cells[c] == Cell::Fed);
                    row.rhs -= outward * fed.map_or(1.0, |c| set.fed_fraction[c]);
                } else {
                    row.rhs -= outward;
                }
            }
            matrix.south[k] = row.conduct_axial(operator, set, i, j, true, own);
            matrix.north[k] = row.conduct_axial(operator, set, i, j, false, own);
            matrix.centre[k] = row.centre;
            rhs[k] = row.rhs;
        }
    }
}

/// The same at a station with full stations on both sides: everything conducts, all transport is known.
fn assemble_full_station(
    operator: &Operator,
    set: &FilmSet,
    i: usize,
    matrix: &mut RingMatrix,
    rhs: &mut [f64],
) {
    let m = operator.n_axial;
    let (here, next) = (i * m..(i + 1) * m, (i + 1) * m..(i + 2) * m);
    let around = &operator.conductance_around;
    let (to_west, to_east) = (&around[here.clone()], &around[next.clone()]);
    let (inward, outward) = (&operator.transport[here.clone()], &operator.transport[next]);
    let (storage, stored) = (
        &operator.storage[here.clone()],
        &operator.stored[here.clone()],
    );
    let along = &operator.conductance_axial[i * (m + 1)..(i + 1) * (m + 1)];
    let (centre, west) = (
        &mut matrix.centre[here.clone()],
        &mut matrix.west[here.clone()],
    );
    let (east, south) = (
        &mut matrix.east[here.clone()],
        &mut matrix.south[here.clone()],
    );
    let (north, rhs) = (&mut matrix.north[here.clone()], &mut rhs[here.clone()]);
    for j in 0..m {
        west[j] = -to_west[j];
        east[j] = -to_east[j];
        south[j] = -along[j];
        north[j] = -along[j + 1];
        centre[j] = to_west[j] + to_east[j] + along[j] + along[j + 1];
        rhs[j] = stored[j] - storage[j] + inward[j] - outward[j];
    }
    (south[0], north[m - 1]) = (0.0, 0.0);
    for (end, cell, face) in [(0, 0, 0), (1, m - 1, m)] {
        match operator.axial {
            Axial::Bath(p) => rhs[cell] += along[face] * p,
            Axial::Air(p) if set.end_open[2 * i + end] => rhs[cell] += along[face] * p,
            // Nothing flows through it.
            Axial::Air(_) | Axial::Closed => centre[cell] -= along[face],
        }
    }
    matrix.loaded[here].fill(true);
}

/// One equation being written.
struct Row {
    centre: f64,
    rhs: f64,
}

impl Row {
    /// Conduction to the `neighbour` around (or the boundary on `side`); returns the coefficient
    /// of the neighbour's pressure.
    #[inline]
    fn conduct(
        &mut self,
        operator: &Operator,
        set: &FilmSet,
        neighbour: Option<usize>,
        side: usize,
        conductance: f64,
        own: f64,
    ) -> f64 {
        self.centre += own * conductance;
        match (neighbour, operator.around) {
            (Some(cell), _) => self.couple(set, cell, conductance),
            (None, Around::Pressures(given)) => {
                self.rhs += conductance * given[side];
                0.0
            }
            (None, _) => 0.0,
        }
    }

    #[inline]
    fn conduct_axial(
        &mut self,
        operator: &Operator,
        set: &FilmSet,
        i: usize,
        j: usize,
        towards_south: bool,
        own: f64,
    ) -> f64 {
        let m = operator.n_axial;
        let face = i * (m + 1) + if towards_south { j } else { j + 1 };
        let conductance = operator.conductance_axial[face];
        let at_end = if towards_south { j == 0 } else { j + 1 == m };
        if !at_end {
            self.centre += own * conductance;
            let cell = if towards_south {
                i * m + j - 1
            } else {
                i * m + j + 1
            };
            return self.couple(set, cell, conductance);
        }
        let outside = match operator.axial {
            Axial::Closed => return 0.0,
            Axial::Air(_) if !set.end_open[2 * i + usize::from(!towards_south)] => return 0.0,
            Axial::Bath(p) | Axial::Air(p) => p,
        };
        self.centre += own * conductance;
        self.rhs += conductance * outside;
        0.0
    }

    #[inline]
    fn couple(&mut self, set: &FilmSet, cell: usize, conductance: f64) -> f64 {
        match set.cells[cell] {
            Cell::Full => -conductance,
            Cell::Ruptured => 0.0,
            Cell::Fed => {
                self.rhs += conductance * set.fed_pressure[cell];
                0.0
            }
        }
    }
}
