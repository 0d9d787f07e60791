//! How warm is the oil in each cell of the film?
//!
//! Equation, averaged across the film and over the time of the account:
//! ```text
//! rho c ( q . grad T ) = dissipation - k_w (T - T_w)         per area of the film
//! dissipation = eta U^2/h + h^3/(12 eta) |grad p|^2          shear and pressure-driven flow
//! ```
//! Unknowns: the temperature (K) of each cell and of each feed, whose oil is that of its supply mixed
//! with what the film pushes or drags into it. Finite volumes, upwind: a cell mixes what flows in, so
//! that no cell is colder than the coldest and none hotter than its own heat makes it. The equations are
//! a ring of stations like those of the pressure, bordered by one unknown per feed.
//! Assumptions: no gradient across the film, no conduction along it (it is some thousandths of what
//! flows), walls that take heat in proportion (`k_w`, W/(m2 K)), or none. Oil that a closure without
//! mass conservation makes stands for what the supply brings to where the film forms again and comes at the
//! supply's temperature, so that a feed that takes more than it gives has been given the rest before; what it
//! loses leaves at that of its cell.
//! Where nothing flows in, a cell has the temperature of the supply.
//! Reference: W. F. Cope, Proc. R. Soc. A 197 (1949) 201 (energy equation of the film).

use crate::grid::Grid;
use crate::linear::{Lanes, RingFactor, RingMatrix, solve_dense};
use serde::{Deserialize, Serialize};

/// Inflow below this share of the largest flow is none: such a cell has the temperature of the supply.
const NOTHING: f64 = 1e-10;

/// What flows and what heats, averaged over the time that was accounted for.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatAccount {
    periodic: bool,
    n_axial: usize,
    /// Area of the cells, m2.
    area: Vec<f64>,
    /// s.
    duration: f64,
    /// Volume through faces around, m3, `(i, j)` at `i * n_axial + j`; forth and back apart, because
    /// upwind is another cell.
    around: [Vec<f64>; 2],
    /// The same along the axis, `(i, j)` at `i * (n_axial + 1) + j`.
    axial: [Vec<f64>; 2],
    /// Heat made per cell, J.
    heat: Vec<f64>,
    /// Per feed and cell, m3: what the feed gave to the cell, and what it took.
    given: Vec<Vec<f64>>,
    taken: Vec<Vec<f64>>,
    /// The feed that a cell belonged to last.
    home: Vec<Option<usize>>,
}

/// One instant of a film for [`HeatAccount::add`]; SI.
#[derive(Debug, Clone, Copy)]
pub struct HeatInstant<'a> {
    /// Flow through faces around, m3/s, positive towards higher index.
    pub around: &'a [f64],
    /// Flow through faces along the axis, m3/s.
    pub axial: &'a [f64],
    /// Heat made per cell, W.
    pub heat: &'a [f64],
    /// The feed that each cell belongs to. A film that begins on the line of the widest gap has one more:
    /// the line, which is the last.
    pub fed_by: &'a [Option<usize>],
}

/// What the oil brings and what surrounds it.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// Heat capacity of the oil by volume, J/(m3 K).
    pub volumetric_heat: f64,
    /// Temperature of the oil that each feed brings, K (the line of the widest gap last).
    pub supply: &'a [f64],
    /// Temperature of the bath at the ends, K.
    pub ambient: f64,
    /// Share of the oil that a feed takes from the film that mixes into what it gives; the rest leaves with
    /// its heat and the supply replaces it. 1: all of it; measured grooves lie at 0.4 to 1.
    pub carry_over: f64,
    /// Heat that the walls take, W/(m2 K), and their temperature, K; 0 for adiabatic walls.
    pub wall: (f64, f64),
}

/// The temperatures of a film.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmTemperature {
    /// Per cell, K.
    pub cells: Vec<f64>,
    /// Per feed, K.
    pub feeds: Vec<f64>,
    /// Of the oil that leaves at the ends, mean by flow, K; that of the supply if none leaves.
    pub outlet: f64,
    /// Where the heat goes.
    pub balance: EnergyBalance,
}

/// Energy per time, W; what oil carries is counted from the supply's temperature.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyBalance {
    /// Heat made in the film.
    pub generated: f64,
    /// Carried out at the ends, less what a bath brought in.
    pub carried_out: f64,
    /// Carried back into feeds that take more than they give.
    pub returned: f64,
    /// Taken by the walls.
    pub conducted: f64,
    /// Lost with oil that the closure does not conserve.
    pub unconserved: f64,
}

impl EnergyBalance {
    /// What is missing over the largest of its parts.
    #[must_use]
    pub fn relative_error(&self) -> f64 {
        let parts = [
            self.carried_out,
            self.returned,
            self.conducted,
            self.unconserved,
        ];
        let largest = parts
            .iter()
            .fold(self.generated.abs(), |a, b| a.max(b.abs()));
        if largest > 0.0 {
            (self.generated - parts.iter().sum::<f64>()).abs() / largest
        } else {
            0.0
        }
    }
}

impl HeatAccount {
    /// An empty account of a film on `grid`, whose lengths are those over `radius` (m), periodic around or
    /// not, with so many feeds.
    #[must_use]
    pub fn new(grid: &Grid, radius: f64, periodic: bool, feeds: usize) -> Self {
        let (n, m) = (grid.n_around(), grid.n_axial());
        let cells = (0..n).flat_map(|i| (0..m).map(move |j| (i, j)));
        Self {
            periodic,
            n_axial: m,
            area: cells
                .map(|(i, j)| radius * radius * grid.area(i, j))
                .collect(),
            duration: 0.0,
            around: [vec![0.0; (n + 1) * m], vec![0.0; (n + 1) * m]],
            axial: [vec![0.0; n * (m + 1)], vec![0.0; n * (m + 1)]],
            heat: vec![0.0; n * m],
            given: vec![vec![0.0; n * m]; feeds],
            taken: vec![vec![0.0; n * m]; feeds],
            home: vec![None; n * m],
        }
    }

    /// Forgets what was accounted for.
    pub fn clear(&mut self) {
        self.duration = 0.0;
        let volumes = self.around.iter_mut().chain(&mut self.axial);
        let feeds = self.given.iter_mut().chain(&mut self.taken);
        for values in volumes.chain(feeds) {
            values.fill(0.0);
        }
        self.heat.fill(0.0);
        self.home.fill(None);
    }

    /// Time accounted for, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Adds an instant that stands for `duration` (s).
    ///
    /// What flows between cells of feeds stays in them; what flows from a feed into the film is given, what
    /// flows the other way is taken.
    pub fn add(&mut self, instant: &HeatInstant<'_>, duration: f64) {
        let m = self.n_axial;
        let cells = self.heat.len();
        let n = cells / m;
        self.duration += duration;
        for (k, sum) in self.heat.iter_mut().enumerate() {
            // A groove is deep: the shear in it is none of the film's.
            if instant.fed_by[k].is_none() {
                *sum += duration * instant.heat[k];
            }
        }
        for (home, feed) in self.home.iter_mut().zip(instant.fed_by) {
            *home = feed.or(*home);
        }
        let line = self.given.len().checked_sub(1);
        // A periodic ring meets its first face twice.
        for face in 0..if self.periodic { cells } else { cells + m } {
            let (i, j) = (face / m, face % m);
            let before = match i {
                0 if self.periodic => Some((n - 1) * m + j),
                0 => None,
                _ => Some(face - m),
            };
            let behind = (i < n).then_some(face);
            let volume = duration * instant.around[face];
            let is_line = before.is_none() || behind.is_none();
            let feeds = [before, behind].map(|cell| match cell {
                Some(k) => instant.fed_by[k],
                None => line,
            });
            match feeds {
                [None, None] => add_flow(&mut self.around, face, volume),
                [Some(_), Some(_)] if !is_line => {}
                [feed, other] => {
                    if let (Some(feed), Some(k)) = (feed, behind) {
                        self.exchange(feed, k, volume);
                    }
                    if let (Some(feed), Some(k)) = (other, before) {
                        self.exchange(feed, k, -volume);
                    }
                }
            }
        }
        for face in 0..n * (m + 1) {
            let (i, j) = (face / (m + 1), face % (m + 1));
            let volume = duration * instant.axial[face];
            if j == 0 || j == m {
                add_flow(&mut self.axial, face, volume);
                continue;
            }
            let (before, behind) = (i * m + j - 1, i * m + j);
            match (instant.fed_by[before], instant.fed_by[behind]) {
                (None, None) => add_flow(&mut self.axial, face, volume),
                (Some(_), Some(_)) => {}
                (Some(feed), None) => self.exchange(feed, behind, volume),
                (None, Some(feed)) => self.exchange(feed, before, -volume),
            }
        }
    }

    /// A volume (m3) from a feed to the film's cell `k`, negative for the other way.
    fn exchange(&mut self, feed: usize, k: usize, volume: f64) {
        if volume > 0.0 {
            self.given[feed][k] += volume;
        } else {
            self.taken[feed][k] -= volume;
        }
    }

    /// The temperatures that the account leads to; `None` where nothing was accounted for, or where heat
    /// is made in oil that nothing replaces.
    #[must_use]
    pub fn temperature(&self, surroundings: &Surroundings<'_>) -> Option<FilmTemperature> {
        if self.duration <= 0.0 {
            return None;
        }
        let reference = surroundings
            .supply
            .first()
            .copied()
            .unwrap_or(surroundings.ambient);
        let system = System::of(self, surroundings, reference);
        let mut factor = RingFactor::new(&system.matrix);
        if !factor.factor(&system.matrix) {
            return None;
        }
        let mut cells = system.rhs.clone();
        factor.solve(&mut cells);
        let feeds = self.mixed(&mut factor, &mut cells, &system, surroundings, reference)?;
        for (k, cell) in cells.iter_mut().enumerate() {
            if let (true, Some(feed)) = (system.stands_still[k], self.home[k]) {
                *cell = feeds[feed];
            }
        }
        let balance = self.balance(&cells, &feeds, &system, surroundings, reference);
        let outlet = self.outlet(&cells);
        let absolute = |rise: &f64| reference + rise;
        let temperature = FilmTemperature {
            outlet: reference + outlet,
            cells: cells.iter().map(absolute).collect(),
            feeds: feeds.iter().map(absolute).collect(),
            balance,
        };
        temperature
            .cells
            .iter()
            .all(|t| t.is_finite())
            .then_some(temperature)
    }

    /// Adds the feeds' temperatures to the film solved with all of them at the reference: one
    /// back-substitution per feed, one small dense system. Rises over the reference, K.
    fn mixed(
        &self,
        factor: &mut RingFactor,
        cells: &mut [f64],
        system: &System,
        surroundings: &Surroundings<'_>,
        reference: f64,
    ) -> Option<Vec<f64>> {
        let count = self.given.len();
        let responses: Vec<Vec<f64>> = self
            .given
            .iter()
            .map(|given| {
                let mut response = given.clone();
                factor.solve(&mut response);
                response
            })
            .collect();
        let drawn = |feed: usize, field: &[f64]| -> f64 {
            self.taken[feed].iter().zip(field).map(|(q, t)| q * t).sum()
        };
        let mut matrix = vec![0.0; count * count];
        let mut right: Vec<Lanes> = vec![[0.0; 4]; count];
        for feed in 0..count {
            let supply = surroundings.supply.get(feed).map_or(0.0, |t| t - reference);
            let through = self.through(feed, system);
            // A feed through which nothing flows has the temperature of its supply.
            let flows = through > 0.0;
            let mixed = if flows { surroundings.carry_over } else { 0.0 };
            let fresh = if flows {
                self.fresh(feed, system, surroundings)
            } else {
                1.0
            };
            for other in 0..count {
                matrix[feed * count + other] = -mixed * drawn(feed, &responses[other]);
            }
            matrix[feed * count + feed] += if flows { through } else { 1.0 };
            right[feed][0] = mixed * drawn(feed, cells) + fresh * supply;
        }
        if count > 0 && !solve_dense(&mut matrix, &mut right) {
            return None;
        }
        let feeds: Vec<f64> = right.iter().map(|lanes| lanes[0]).collect();
        for (response, feed) in responses.iter().zip(&feeds) {
            for (cell, response) in cells.iter_mut().zip(response) {
                *cell += feed * response;
            }
        }
        Some(feeds)
    }

    /// What mixes in a feed, m3: all that it gives, or all that it takes where it takes more; but not
    /// where the closure made that oil.
    fn through(&self, feed: usize, system: &System) -> f64 {
        let (given, taken) = (total(&self.given[feed]), total(&self.taken[feed]));
        if taken - given <= system.made && given > 0.0 {
            given
        } else {
            given.max(taken)
        }
    }

    /// Oil of the supply that a feed mixes in, m3.
    fn fresh(&self, feed: usize, system: &System, surroundings: &Surroundings<'_>) -> f64 {
        let carried = surroundings.carry_over * total(&self.taken[feed]);
        (self.through(feed, system) - carried).max(0.0)
    }

    /// Rise of what leaves at the ends, mean by flow, K.
    fn outlet(&self, cells: &[f64]) -> f64 {
        let (mut volume, mut carried) = (0.0, 0.0);
        self.at_ends(|cell, out, _| {
            volume += out;
            carried += out * cells[cell];
        });
        if volume > 0.0 { carried / volume } else { 0.0 }
    }

    /// Calls with each cell at an end, what left there and what entered, m3.
    fn at_ends(&self, mut see: impl FnMut(usize, f64, f64)) {
        let m = self.n_axial;
        for i in 0..self.heat.len() / m {
            let (first, last) = (i * (m + 1), i * (m + 1) + m);
            see(i * m, self.axial[1][first], self.axial[0][first]);
            see(i * m + m - 1, self.axial[0][last], self.axial[1][last]);
        }
    }

    fn balance(
        &self,
        cells: &[f64],
        feeds: &[f64],
        system: &System,
        surroundings: &Surroundings<'_>,
        reference: f64,
    ) -> EnergyBalance {
        let unit = surroundings.volumetric_heat / self.duration;
        let bath = surroundings.ambient - reference;
        let mut balance = EnergyBalance {
            generated: total(&self.heat) / self.duration,
            ..EnergyBalance::default()
        };
        self.at_ends(|cell, out, entered| {
            balance.carried_out += unit * (out * cells[cell] - entered * bath);
        });
        for (feed, rise) in feeds.iter().enumerate() {
            let supply = surroundings.supply.get(feed).map_or(0.0, |t| t - reference);
            let through = self.through(feed, system);
            let kept = through - total(&self.given[feed]);
            // What a feed takes and does not give again leaves with it, and what is not carried over.
            let drawn: f64 = self.taken[feed].iter().zip(cells).map(|(q, t)| q * t).sum();
            let left = (1.0 - surroundings.carry_over) * drawn;
            let carried =
                left + kept.max(0.0) * rise - self.fresh(feed, system, surroundings) * supply;
            balance.returned += unit * carried;
        }
        let (coefficient, wall) = surroundings.wall;
        for (k, rise) in cells.iter().enumerate() {
            // A cell that nothing flows into is none of the balance: a groove's walls are not the film's.
            if system.stands_still[k] {
                continue;
            }
            balance.conducted += coefficient * self.area[k] * (rise - (wall - reference));
            // Inflow less outflow: what the closure lost in the cell. What it made brought no rise.
            balance.unconserved += unit * (system.inflow[k] - system.outflow[k]) * rise;
        }
        balance
    }
}

/// The upwind equations, volumes (m3) times rises (K).
struct System {
    matrix: RingMatrix,
    rhs: Vec<f64>,
    inflow: Vec<f64>,
    outflow: Vec<f64>,
    /// Per cell: nothing flows in.
    stands_still: Vec<bool>,
    /// Oil that the closure makes in all cells, m3; round-off where it conserves mass.
    made: f64,
}

impl System {
    fn of(account: &HeatAccount, surroundings: &Surroundings<'_>, reference: f64) -> Self {
        let m = account.n_axial;
        let n = account.heat.len() / m;
        let mut system = Self {
            matrix: RingMatrix::new(n, m, account.periodic),
            rhs: vec![0.0; n * m],
            inflow: vec![0.0; n * m],
            outflow: vec![0.0; n * m],
            stands_still: vec![false; n * m],
            made: 0.0,
        };
        system.add_around(account, n, m);
        system.add_axial(account, surroundings.ambient - reference, n, m);
        for k in 0..n * m {
            for feed in 0..account.given.len() {
                system.inflow[k] += account.given[feed][k];
                system.outflow[k] += account.taken[feed][k];
            }
        }
        for (inflow, outflow) in system.inflow.iter_mut().zip(&system.outflow) {
            system.made += (outflow - *inflow).max(0.0);
            *inflow = inflow.max(*outflow);
        }
        let largest = system.inflow.iter().fold(0.0_f64, |a, b| a.max(*b));
        let (coefficient, wall) = surroundings.wall;
        for k in 0..n * m {
            let wall_volume =
                coefficient * account.area[k] * account.duration / surroundings.volumetric_heat;
            system.matrix.centre[k] = system.inflow[k] + wall_volume;
            system.rhs[k] +=
                account.heat[k] / surroundings.volumetric_heat + wall_volume * (wall - reference);
            if system.inflow[k] <= NOTHING * largest {
                system.stand_still(k, largest);
            }
        }
        system
    }

    /// A cell that nothing flows into: no heat is carried, it keeps the temperature of the supply.
    fn stand_still(&mut self, k: usize, largest: f64) {
        self.stands_still[k] = true;
        let matrix = &mut self.matrix;
        for entries in [
            &mut matrix.west,
            &mut matrix.east,
            &mut matrix.south,
            &mut matrix.north,
        ] {
            entries[k] = 0.0;
        }
        matrix.centre[k] += largest.max(f64::MIN_POSITIVE);
    }

    fn add_around(&mut self, account: &HeatAccount, n: usize, m: usize) {
        for i in 0..n {
            for j in 0..m {
                let k = i * m + j;
                let next = if i + 1 == n { 0 } else { i + 1 } * m + j;
                // The face behind the last cell is the first one of a ring; a line is a feed.
                let face = match (i + 1 == n, account.periodic) {
                    (true, true) => j,
                    (true, false) => continue,
                    _ => k + m,
                };
                let [forth, back] = [account.around[0][face], account.around[1][face]];
                self.matrix.west[next] -= forth;
                self.matrix.east[k] -= back;
                self.inflow[next] += forth;
                self.outflow[k] += forth;
                self.inflow[k] += back;
                self.outflow[next] += back;
            }
        }
    }

    fn add_axial(&mut self, account: &HeatAccount, bath: f64, n: usize, m: usize) {
        for i in 0..n {
            for j in 0..=m {
                let face = i * (m + 1) + j;
                let [forth, back] = [account.axial[0][face], account.axial[1][face]];
                let before = (j > 0).then(|| i * m + j - 1);
                let behind = (j < m).then_some(i * m + j);
                if let Some(k) = behind {
                    self.inflow[k] += forth;
                    self.outflow[k] += back;
                    if before.is_some() {
                        self.matrix.south[k] -= forth;
                    } else {
                        self.rhs[k] += forth * bath;
                    }
                }
                if let Some(k) = before {
                    self.inflow[k] += back;
                    self.outflow[k] += forth;
                    if behind.is_some() {
                        self.matrix.north[k] -= back;
                    } else {
                        self.rhs[k] += back * bath;
                    }
                }
            }
        }
    }
}

fn add_flow(both: &mut [Vec<f64>; 2], face: usize, volume: f64) {
    let way = usize::from(volume < 0.0);
    both[way][face] += volume.abs();
}

fn total(values: &[f64]) -> f64 {
    values.iter().sum()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]
mod tests {
    use super::*;

    const OIL: f64 = 1.8e6;

    fn uniform(n: usize, m: usize) -> Grid {
        let faces = |count: usize, length: f64| {
            (0..=count)
                .map(|i| length * i as f64 / count as f64)
                .collect()
        };
        Grid::from_faces(faces(n, 1.0), faces(m, 0.3))
    }

    fn surroundings(supply: &[f64]) -> Surroundings<'_> {
        Surroundings {
            volumetric_heat: OIL,
            supply,
            ambient: 300.0,
            carry_over: 1.0,
            wall: (0.0, 300.0),
        }
    }

    /// A flow that enters on the line before the first cell and leaves at both ends of the last station.
    fn channel(n: usize, m: usize, flow: f64) -> (Vec<f64>, Vec<f64>) {
        let mut around = vec![flow / m as f64; (n + 1) * m];
        let mut axial = vec![0.0; n * (m + 1)];
        around[n * m..].fill(0.0);
        for j in 0..=m {
            axial[(n - 1) * (m + 1) + j] = flow * (j as f64 / m as f64 - 0.5);
        }
        (around, axial)
    }

    #[test]
    fn an_adiabatic_channel_warms_in_proportion() {
        let (n, m) = (12, 2);
        let grid = uniform(n, m);
        let mut account = HeatAccount::new(&grid, 0.05, false, 1);
        let (around, axial) = channel(n, m, 2e-5);
        let instant = HeatInstant {
            around: &around,
            axial: &axial,
            heat: &vec![2.0; n * m],
            fed_by: &vec![None; n * m],
        };
        account.add(&instant, 0.25);
        let found = account.temperature(&surroundings(&[330.0])).unwrap();
        let rise = 2.0 / (OIL * 1e-5);
        for (k, temperature) in found.cells.iter().enumerate() {
            let exact = 330.0 + rise * ((k / m) as f64 + 1.0);
            assert!(
                (temperature - exact).abs() < 1e-9,
                "{k} {temperature} {exact}"
            );
        }
        assert!(
            found.balance.relative_error() < 1e-12,
            "{:?}",
            found.balance
        );
    }

    /// An axial groove that gives half of what leaves it and takes the rest from the film before it: its
    /// temperature is the mean of supply and film.
    #[test]
    fn a_groove_mixes_supply_and_film() {
        let (n, m) = (20, 2);
        let grid = uniform(n, m);
        let mut account = HeatAccount::new(&grid, 0.05, true, 1);
        let mut fed_by = vec![None; n * m];
        fed_by[..2 * m].fill(Some(0));
        let mut around = vec![0.0; (n + 1) * m];
        let mut axial = vec![0.0; n * (m + 1)];
        // Half of the flow leaves at the ends on the way.
        let mut flow = 2e-5;
        for i in 2..=n {
            around[i * m..(i + 1) * m].fill(flow);
            if i < n {
                let side = 1e-5 / (n - 2) as f64;
                axial[i * (m + 1)] = -side;
                axial[i * (m + 1) + m] = side;
                flow -= side;
            }
        }
        around.copy_within(n * m.., 0);
        let heat = vec![1.5; n * m];
        let instant = HeatInstant {
            around: &around,
            axial: &axial,
            heat: &heat,
            fed_by: &fed_by,
        };
        account.add(&instant, 1.0);
        let found = account.temperature(&surroundings(&[350.0])).unwrap();
        let last = found.cells[(n - 1) * m];
        assert!((found.feeds[0] - 0.5 * (350.0 + last)).abs() < 1e-9);
        assert!((found.cells[0] - found.feeds[0]).abs() < 1e-9);
        assert!(
            found.balance.relative_error() < 1e-12,
            "{:?}",
            found.balance
        );
        // Heat in the cells of the groove is not the film's.
        let made = 1.5 * ((n - 2) * m) as f64;
        assert!(
            (found.balance.carried_out / made - 1.0).abs() < 1e-9,
            "{:?}",
            found.balance
        );
        assert!((found.outlet - 350.0 - made / (OIL * 2e-5)).abs() < 1e-9);
    }

    /// Walls draw the temperature to theirs with exp(-x k b/(rho c q)); upwind cells are of first order.
    #[test]
    fn walls_draw_heat_exponentially() {
        let error = |n: usize| {
            let grid = uniform(n, 1);
            let mut account = HeatAccount::new(&grid, 0.1, false, 1);
            let (flow_around, axial) = channel(n, 1, 1e-6);
            let instant = HeatInstant {
                around: &flow_around,
                axial: &axial,
                heat: &vec![0.0; n],
                fed_by: &vec![None; n],
            };
            account.add(&instant, 1.0);
            let mut around = surroundings(&[400.0]);
            around.wall = (2000.0, 320.0);
            let found = account.temperature(&around).unwrap();
            // 1 x 0.3 over a radius of 0.1 m.
            let exponent = 2000.0 * 0.3 * 0.01 / (OIL * 1e-6);
            let exact = (-exponent).exp();
            assert!(found.balance.relative_error() < 1e-12);
            (found.cells[n - 1] - 320.0) / (found.feeds[0] - 320.0) - exact
        };
        let (coarse, fine) = (error(40), error(80));
        assert!((coarse / fine - 2.0).abs() < 0.1, "{coarse} {fine}");
    }

    /// Walls beside a groove take heat from the film alone, and the balance of all cells closes.
    #[test]
    fn walls_beside_a_groove_are_in_the_balance() {
        let (n, m) = (20, 2);
        let grid = uniform(n, m);
        let mut account = HeatAccount::new(&grid, 0.05, true, 1);
        let mut fed_by = vec![None; n * m];
        fed_by[..2 * m].fill(Some(0));
        let mut around = vec![2e-5; (n + 1) * m];
        around[m..2 * m].fill(0.0);
        let instant = HeatInstant {
            around: &around,
            axial: &vec![0.0; n * (m + 1)],
            heat: &vec![1.5; n * m],
            fed_by: &fed_by,
        };
        account.add(&instant, 1.0);
        let mut walls = surroundings(&[350.0]);
        walls.wall = (20_000.0, 355.0);
        let found = account.temperature(&walls).unwrap();
        assert!(found.balance.conducted.abs() > 1.0);
        let error = found.balance.relative_error();
        assert!(error < 1e-12, "{error:e} {:?}", found.balance);
    }

    #[test]
    fn nothing_accounted_for_has_no_temperature() {
        let account = HeatAccount::new(&uniform(4, 2), 0.05, true, 0);
        assert!(account.temperature(&surroundings(&[])).is_none());
    }
}
