//! What flows where: the Reynolds equation as a balance of oil over cells.
//!
//! ```text
//! div( -h^3/(12 eta) grad p ) + d(U_m theta h)/dx + d(theta h)/dt = 0
//! ```
//! with lengths over the radius R, `H = h/c`, the mean surface speed `U_m = R omega_m`, and the
//! pressure in the unit of a rate, `P = (p - p_cav) c^2 / (12 eta R^2)` in 1/s:
//!
//! ```text
//! div( -H^3 grad P ) + omega_m d(theta H)/d(angle) + d(theta H)/dt = 0        [1/s]
//! ```
//! P and theta live at cell centres, H at faces. Flows are per cell face, positive towards higher
//! index, in 1/s; times c R^2 they are m3/s. The transport takes H at the face and theta from the
//! cell upstream: taking the product from upstream overestimates the load by several percent on
//! usual grids. The operator knows gap, grid and boundaries, nothing of bearings, so that planar
//! sliders and squeeze plates run through it as well.

use crate::gap::Gap;
use crate::grid::Grid;
use crate::linear::larger;

/// What limits the film around: at its first and last face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Around {
    /// The last cell is followed by the first.
    Periodic,
    /// Full film at the given P before the first and behind the last cell.
    Pressures([f64; 2]),
    /// Nothing flows through the first and last face.
    Closed,
}

/// What limits the film along the axis: at both ends alike.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Axial {
    /// Nothing flows: a plane of symmetry, or an infinitely long bearing.
    Closed,
    /// An oil bath at P.
    Bath(f64),
    /// Air at P: oil may leave, none enters.
    Air(f64),
}

/// How time enters the balance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Storage<'a> {
    /// Film content changes by the motion of the surfaces alone.
    Rate,
    /// Implicit step of the given duration (s) from the old content `theta H` per cell.
    Step {
        /// Duration, s.
        duration: f64,
        /// Time from the gap given to the end of the step, s.
        after: f64,
        /// Old content.
        old: &'a [f64],
    },
}

/// What a cell holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// A full film: its pressure is unknown.
    Full,
    /// A ruptured film at cavitation pressure.
    Ruptured,
    /// Oil at the pressure of a feed.
    Fed,
}

/// Derivatives of what is dragged through a face around, 1/s per H.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Leaning {
    /// By the H of the face.
    pub by_face: f64,
    /// By the H of the cells before and behind it.
    pub by_cells: [f64; 2],
    /// By the reduced pressure of the cell downstream: of the oil that stiffens there.
    pub by_pressure: f64,
}

/// The discrete balance of one gap on one grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Operator {
    /// Cells around.
    pub n_around: usize,
    /// Cells along the axis.
    pub n_axial: usize,
    /// Boundary around.
    pub around: Around,
    /// Boundary at the ends.
    pub axial: Axial,
    /// The last face along the axis is no end but the mid-plane of a mirrored film.
    pub ends_at_mid_plane: bool,
    /// Conductance of faces around, `(i, j)` at `i * n_axial + j`, `i` up to and including `n_around`.
    pub conductance_around: Vec<f64>,
    /// Conductance of faces along the axis, `(i, j)` at `i * (n_axial + 1) + j`.
    pub conductance_axial: Vec<f64>,
    /// Flow of a full film dragged through faces around, 1/s.
    pub transport: Vec<f64>,
    /// How the transport follows the gap where a soft shell makes it lean upstream
    /// ([`crate::leaning`]), per face around; else empty.
    pub leaning: Vec<Leaning>,
    /// Flow into store per unit of film fraction, 1/s, per cell.
    pub storage: Vec<f64>,
    /// The same where the film is ruptured. Without a past to start from, a film fraction that stays
    /// constant while the gap closes must gain oil; it is let gain no more than transport brings it
    /// over one radian, or it would grow without bound where the gap closes faster than that.
    pub ruptured_storage: Vec<f64>,
    /// Flow out of the store of the past, 1/s, per cell.
    pub stored: Vec<f64>,
    /// Mean surface speed, rad/s.
    pub mean_speed: f64,
    /// Largest flow that drives the film: dragged along, stored or released, 1/s.
    pub flow_unit: f64,
    /// Inverse distance of what faces along the axis couple; end faces couple a cell centre to the end.
    pub per_axial_distance: Vec<f64>,
}

impl Operator {
    /// Operator of the right size, nothing flowing.
    #[must_use]
    pub fn for_grid(grid: &Grid, around: Around, axial: Axial) -> Self {
        let (n, m) = (grid.n_around(), grid.n_axial());
        Self {
            n_around: n,
            n_axial: m,
            around,
            axial,
            ends_at_mid_plane: false,
            conductance_around: vec![0.0; (n + 1) * m],
            conductance_axial: vec![0.0; n * (m + 1)],
            transport: vec![0.0; (n + 1) * m],
            leaning: Vec::new(),
            storage: vec![0.0; n * m],
            ruptured_storage: vec![0.0; n * m],
            stored: vec![0.0; n * m],
            mean_speed: 0.0,
            flow_unit: 0.0,
            per_axial_distance: (0..=m).map(|j| 1.0 / axial_distance(grid, j)).collect(),
        }
    }

    /// Sets up the balance for `gap`, the mean surface speed (rad/s) and the storage.
    pub fn update(&mut self, grid: &Grid, gap: &Gap, mean_speed: f64, storage: Storage<'_>) {
        self.mean_speed = mean_speed;
        self.leaning.clear();
        let (n, m) = (self.n_around, self.n_axial);
        for i in 0..=n {
            let distance = around_distance(grid, &self.around, i);
            for (j, width) in grid.axial_widths.iter().enumerate() {
                let face = i * m + j;
                self.conductance_around[face] = gap.around_cubed[face] * width / distance;
                self.transport[face] = mean_speed * gap.around_transport[face] * width;
            }
        }
        if self.around == Around::Closed {
            for face in (0..m).chain(n * m..(n + 1) * m) {
                self.conductance_around[face] = 0.0;
                self.transport[face] = 0.0;
            }
        }
        let [closed, mid_plane] = [self.axial == Axial::Closed, self.ends_at_mid_plane];
        for i in 0..n {
            let width = grid.around_widths[i];
            let faces = i * (m + 1)..(i + 1) * (m + 1);
            let conductance = &mut self.conductance_axial[faces.clone()];
            let distances = &self.per_axial_distance;
            if let Some(cubed) = gap.axial_cubed.get(faces.clone()) {
                for (conductance, (cubed, per_distance)) in
                    conductance.iter_mut().zip(cubed.iter().zip(distances))
                {
                    *conductance = cubed * width * per_distance;
                }
            } else {
                for (conductance, (height, per_distance)) in conductance
                    .iter_mut()
                    .zip(gap.axial[faces].iter().zip(distances))
                {
                    *conductance = height * height * height * width * per_distance;
                }
            }
            if closed {
                conductance[0] = 0.0;
            }
            if closed || mid_plane {
                conductance[m] = 0.0;
            }
            self.update_storage(grid, gap, storage, i);
        }
        self.flow_unit = self.largest_drive();
    }

    /// Storage of the cells of station `i`.
    fn update_storage(&mut self, grid: &Grid, gap: &Gap, storage: Storage<'_>, i: usize) {
        let m = self.n_axial;
        let width = grid.around_widths[i];
        for (j, along) in grid.axial_widths.iter().enumerate() {
            let k = i * m + j;
            let area = width * along;
            let least = -self.outflow(k) * width;
            (self.storage[k], self.stored[k]) = match storage {
                Storage::Rate => (gap.rate[k] * area, 0.0),
                Storage::Step {
                    duration,
                    after,
                    old,
                } => {
                    let end = gap.mean[k] + after * gap.rate[k];
                    (end * area / duration, old[k] * area / duration)
                }
            };
            self.ruptured_storage[k] = self.storage[k].max(least);
        }
    }

    /// Largest flow that drives the film: dragged along, stored or released, 1/s.
    fn largest_drive(&self) -> f64 {
        let transport = self.transport.iter();
        let dragged = transport.fold(0.0_f64, |a, b| larger(b.abs(), a));
        let stored = self.storage.iter().zip(&self.stored);
        stored.fold(dragged, |a, (new, old)| larger((new - old).abs(), a))
    }

    /// Flow that transport takes out of a full cell, 1/s.
    #[must_use]
    pub fn outflow(&self, cell: usize) -> f64 {
        (-self.transport[cell]).max(0.0) + self.transport[cell + self.n_axial].max(0.0)
    }

    /// Flow into store of a cell with the given film fraction, 1/s.
    #[must_use]
    pub fn stored_flow(&self, cell: usize, film_fraction: f64) -> f64 {
        let coefficient = if film_fraction < 1.0 {
            self.ruptured_storage[cell]
        } else {
            self.storage[cell]
        };
        coefficient * film_fraction - self.stored[cell]
    }

    /// Lets fed cells hold their pressure up to their faces: a groove ends at its edge, not in the
    /// middle of its last cell, so that a face between land and feed conducts over the half cell of
    /// the land alone. Call it after [`Operator::update`]; an edge half a cell off would be a
    /// first-order error.
    pub fn hold_feeds_to_edges(&mut self, grid: &Grid, cells: &[Cell]) {
        let (n, m) = (self.n_around, self.n_axial);
        let fed = |k: usize| cells[k] == Cell::Fed;
        // What the land's half cell is of the distance between centres, inverted.
        let gain = |of: [f64; 2], fed: [bool; 2]| match fed {
            [true, false] => (of[0] + of[1]) / of[1],
            [false, true] => (of[0] + of[1]) / of[0],
            _ => 1.0,
        };
        let has_fed = |i: usize| cells[i * m..(i + 1) * m].contains(&Cell::Fed);
        for i in 0..=n {
            let [Some(before), Some(behind)] = self.stations_beside(i) else {
                continue;
            };
            if !has_fed(before) && !has_fed(behind) {
                continue;
            }
            let widths = [before, behind].map(|i| grid.around_widths[i]);
            for j in 0..m {
                let states = [before, behind].map(|i| fed(i * m + j));
                self.conductance_around[i * m + j] *= gain(widths, states);
            }
        }
        for i in (0..n).filter(|&i| has_fed(i)) {
            for j in 1..m {
                let widths = [j - 1, j].map(|j| grid.axial_widths[j]);
                let states = [j - 1, j].map(|j| fed(i * m + j));
                self.conductance_axial[i * (m + 1) + j] *= gain(widths, states);
            }
        }
    }

    /// The stations before and behind face `i` around; `None` at a boundary.
    #[must_use]
    pub fn stations_beside(&self, i: usize) -> [Option<usize>; 2] {
        let n = self.n_around;
        match (i, self.around) {
            (0, Around::Periodic) => [Some(n - 1), Some(0)],
            (i, Around::Periodic) if i == n => [Some(n - 1), Some(0)],
            (0, _) => [None, Some(0)],
            (i, _) if i == n => [Some(n - 1), None],
            _ => [Some(i - 1), Some(i)],
        }
    }

    /// The cell before cell `(i, j)` around; `None` at a boundary.
    #[must_use]
    pub fn west(&self, i: usize, j: usize) -> Option<usize> {
        match (i, self.around) {
            (0, Around::Periodic) => Some((self.n_around - 1) * self.n_axial + j),
            (0, _) => None,
            _ => Some((i - 1) * self.n_axial + j),
        }
    }

    /// The cell behind cell `(i, j)` around; `None` at a boundary.
    #[must_use]
    pub fn east(&self, i: usize, j: usize) -> Option<usize> {
        match (i + 1 == self.n_around, self.around) {
            (true, Around::Periodic) => Some(j),
            (true, _) => None,
            _ => Some((i + 1) * self.n_axial + j),
        }
    }

    /// Pressure and film fraction that a face around sees on one side: of `cell`, or of the
    /// boundary (`side` 0 before the first, 1 behind the last cell).
    #[must_use]
    pub fn beside(
        &self,
        cell: Option<usize>,
        side: usize,
        pressure: &[f64],
        film_fraction: &[f64],
    ) -> (f64, f64) {
        match (cell, self.around) {
            (Some(k), _) => (pressure[k], film_fraction[k]),
            (None, Around::Pressures(given)) => (given[side], 1.0),
            (None, _) => (0.0, 1.0),
        }
    }

    /// Flow through face `i` around in row `j`, 1/s.
    #[must_use]
    pub fn flow_around(&self, i: usize, j: usize, pressure: &[f64], film_fraction: &[f64]) -> f64 {
        let before = if i == 0 {
            self.west(0, j)
        } else {
            Some((i - 1) * self.n_axial + j)
        };
        let behind = if i == self.n_around {
            self.east(i - 1, j)
        } else {
            Some(i * self.n_axial + j)
        };
        let (p_before, theta_before) = self.beside(before, 0, pressure, film_fraction);
        let (p_behind, theta_behind) = self.beside(behind, 1, pressure, film_fraction);
        let face = i * self.n_axial + j;
        let transport = self.transport[face];
        let upstream = if transport > 0.0 {
            theta_before
        } else {
            theta_behind
        };
        self.conductance_around[face] * (p_before - p_behind) + transport * upstream
    }

    /// Flow through face `j` along the axis at station `i`, 1/s.
    #[must_use]
    pub fn flow_axial(&self, i: usize, j: usize, pressure: &[f64]) -> f64 {
        let m = self.n_axial;
        let conductance = self.conductance_axial[i * (m + 1) + j];
        if j == 0 {
            -conductance * self.end_drop(pressure[i * m])
        } else if j == m {
            conductance * self.end_drop(pressure[i * m + m - 1])
        } else {
            conductance * (pressure[i * m + j - 1] - pressure[i * m + j])
        }
    }

    /// Pressure drop that drives oil out of an end, given the pressure of the cell at the end.
    #[must_use]
    pub fn end_drop(&self, pressure: f64) -> f64 {
        match self.axial {
            Axial::Closed => 0.0,
            Axial::Bath(bath) => pressure - bath,
            // Air that is drawn in brings no oil.
            Axial::Air(air) => (pressure - air).max(0.0),
        }
    }

    /// What enters each cell beyond what leaves it and is stored, 1/s: zero where the balance
    /// holds. Returns the largest flow through any face or into any store, as the scale.
    pub fn balance(&self, pressure: &[f64], film_fraction: &[f64], excess: &mut [f64]) -> f64 {
        let (n, m) = (self.n_around, self.n_axial);
        let mut scale = 0.0_f64;
        excess.fill(0.0);
        let mut flows = |i: usize, j: usize, flow: f64| {
            scale = larger(flow.abs(), scale);
            if i < n {
                excess[i * m + j] += flow;
            }
            if i > 0 {
                excess[(i - 1) * m + j] -= flow;
            }
        };
        for i in 0..=n {
            let [Some(before), Some(behind)] = self.stations_beside(i) else {
                for j in 0..m {
                    flows(i, j, self.flow_around(i, j, pressure, film_fraction));
                }
                continue;
            };
            let faces = i * m..(i + 1) * m;
            let (before, behind) = (before * m..(before + 1) * m, behind * m..(behind + 1) * m);
            let conductance = &self.conductance_around[faces.clone()];
            let transport = &self.transport[faces];
            let (p_before, p_behind) = (&pressure[before.clone()], &pressure[behind.clone()]);
            let (theta_before, theta_behind) = (&film_fraction[before], &film_fraction[behind]);
            for j in 0..m {
                let upstream = if transport[j] > 0.0 {
                    theta_before[j]
                } else {
                    theta_behind[j]
                };
                let conducted = conductance[j] * (p_before[j] - p_behind[j]);
                flows(i, j, conducted + transport[j] * upstream);
            }
        }
        for i in 0..n {
            let conductance = &self.conductance_axial[i * (m + 1)..(i + 1) * (m + 1)];
            let pressure = &pressure[i * m..(i + 1) * m];
            let excess = &mut excess[i * m..(i + 1) * m];
            let out = [0, m - 1].map(|j| self.end_drop(pressure[j]));
            let out = [conductance[0] * out[0], conductance[m] * out[1]];
            scale = scale.max(out[0].abs()).max(out[1].abs());
            excess[0] -= out[0];
            excess[m - 1] -= out[1];
            for j in 1..m {
                let flow = conductance[j] * (pressure[j - 1] - pressure[j]);
                scale = larger(flow.abs(), scale);
                excess[j] += flow;
                excess[j - 1] -= flow;
            }
            for (j, excess) in excess.iter_mut().enumerate() {
                let k = i * m + j;
                let store = self.stored_flow(k, film_fraction[k]);
                scale = larger(store.abs(), scale);
                *excess -= store;
            }
        }
        scale
    }
}

/// Distance between the places that a face around couples, rad.
fn around_distance(grid: &Grid, around: &Around, i: usize) -> f64 {
    let n = grid.n_around();
    let (first, last) = (0.5 * grid.around_widths[0], 0.5 * grid.around_widths[n - 1]);
    match (i, around) {
        (0, Around::Periodic) => first + last,
        (0, _) => first,
        (i, Around::Periodic) if i == n => first + last,
        (i, _) if i == n => last,
        _ => grid.around[i] - grid.around[i - 1],
    }
}

/// The same along the axis; end faces couple a cell centre to the end.
fn axial_distance(grid: &Grid, j: usize) -> f64 {
    let m = grid.n_axial();
    if j == 0 {
        0.5 * grid.axial_widths[0]
    } else if j == m {
        0.5 * grid.axial_widths[m - 1]
    } else {
        grid.axial[j] - grid.axial[j - 1]
    }
}
