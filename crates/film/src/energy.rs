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
//! Film and temperatures are found in turn. Heat that was made at one temperature may be foreseen at the one
//! it leads to ([`Foresight`]): a warmer oil makes less, and a round that knows it does not overshoot.
//! Reference: W. F. Cope, Proc. R. Soc. A 197 (1949) 201 (energy equation of the film).

use crate::grid::Grid;
use crate::linear::{Lanes, RingFactor, RingMatrix, solve_dense};
use serde::{Deserialize, Serialize};

/// Inflow below this share of the largest flow is none: such a cell has the temperature of the supply.
const NOTHING: f64 = 1e-10;

/// What flows and what heats, averaged over the time that was accounted for.
#[derive(Debug, Clone)]
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
    /// Room for the factors of the equations.
    factor: Option<RingFactor>,
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

/// How the heat of the account changes where its film gets another temperature.
#[derive(Debug, Clone, Copy)]
pub struct Foresight<'a> {
    /// Temperatures at which the heat was made, per cell, K.
    pub made_at: &'a [f64],
    /// Share by which the heat of a cell falls with its temperature, 1/K; not negative.
    pub fall: &'a [f64],
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
            factor: None,
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

    /// The temperatures that the account leads to, with its heat as it was made or as foreseen; `None` where
    /// nothing was accounted for, or where heat is made in oil that nothing replaces.
    #[must_use]
    pub fn temperature(
        &mut self,
        surroundings: &Surroundings<'_>,
        foresight: Option<&Foresight<'_>>,
    ) -> Option<FilmTemperature> {
        if self.duration <= 0.0 {
            return None;
        }
        let reference = surroundings
            .supply
            .first()
            .copied()
            .unwrap_or(surroundings.ambient);
        let mut system = System::of(self, surroundings, reference);
        if let Some(foresight) = foresight {
            system.foresee(self, foresight, surroundings.volumetric_heat, reference);
        }
        let kept = self.factor.take();
        let mut factor = kept.unwrap_or_else(|| RingFactor::new(&system.matrix));
        if !factor.factor(&system.matrix) {
            return None;
        }
        let mut cells = system.rhs.clone();
        factor.solve(&mut cells);
        let feeds = self.mixed(&mut factor, &mut cells, &system, surroundings, reference);
        self.factor = Some(factor);
        let feeds = feeds?;
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
        let spared = system.spared.iter().zip(cells);
        let spared: f64 = spared.map(|([volume, rise], t)| volume * (t - rise)).sum();
        let mut balance = EnergyBalance {
            generated: (total(&self.heat) - surroundings.volumetric_heat * spared) / self.duration,
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
    /// Per cell, if foreseen: heat that each K more spares over the oil's heat capacity, m3, and the rise (K)
    /// from which it is counted.
    spared: Vec<[f64; 2]>,
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
            spared: Vec::new(),
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

    /// Heat falls with the temperature that it leads to.
    fn foresee(
        &mut self,
        account: &HeatAccount,
        foresight: &Foresight<'_>,
        volumetric_heat: f64,
        reference: f64,
    ) {
        for (k, heat) in account.heat.iter().enumerate() {
            let volume = if self.stands_still[k] {
                0.0
            } else {
                (heat * foresight.fall[k]).max(0.0) / volumetric_heat
            };
            let rise = foresight.made_at[k] - reference;
            self.matrix.centre[k] += volume;
            self.rhs[k] += volume * rise;
            self.spared.push([volume, rise]);
        }
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
mod tests;
