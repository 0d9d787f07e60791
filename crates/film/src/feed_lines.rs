//! Which pressure is left in a groove whose oil comes through a line?
//!
//! ```text
//! p_supply - p = resistance q                 q: flow into the film, what the cells of the feed lose
//! p >= p_cav, theta <= 1, (p - p_cav)(1 - theta) = 0        in the feed, as everywhere in the film
//! ```
//! The pressure of the feed is one unknown beside those of the cells. A line that brings less than
//! the film takes leaves the feed at cavitation pressure, starved: the surfaces then drag away oil of
//! the film fraction `theta`, the unknown instead, so that oil is conserved. `reynolds` holds a
//! starved feed full at cavitation pressure and makes the missing oil; `gumbel` cuts the pressure of
//! a feed like any other, after the solution.
//!
//! For a fixed set the film is linear in these unknowns u. With the film's matrix M, its answer to
//! them `W = M^-1 B`, and the balances of the feeds `C x + D u = ...`, the film is bordered by the
//! dense system `D + C W`: one back-substitution per feed behind a line. Its transpose closes the
//! adjoints, whose value in the cells of the feed is the multiplier of its balance. Equations are
//! multiplied by the resistance, which may go to 0.
//!
//! Feeds that open into one another are one pocket ([`crate::supply`]): their lines are parallel.

use crate::bearing::{Bearing, FeedLine};
use crate::cavitation::FilmSet;
use crate::force::FeedFlow;
use crate::linear::{Lanes, RingFactor, solve_dense};
use crate::reynolds::{Around, Axial, Cell, Operator};

/// The feeds behind lines, with storage made once.
#[derive(Debug, Clone)]
pub(crate) struct FeedLines {
    /// Per feed, the lowest index of the feeds that it is one pocket with.
    pub(crate) pocket: Vec<usize>,
    /// Per feed, at the supply: pressure of the film's unit, 1/s.
    supply: Vec<f64>,
    /// Per feed: drop of that pressure per flow in the film's unit, both 1/s; 0 without a line.
    resistance: Vec<f64>,
    /// Per pocket: its line brings less than the film takes.
    pub(crate) starved: Vec<bool>,
    /// Pockets whose pressure is unknown, in ascending order, and per pocket its place among them.
    unknown: Vec<Unknown>,
    slot: Vec<Option<usize>>,
    /// Coefficients of cells in the balance of an unknown pocket: slot, cell, coefficient.
    couplings: Vec<(usize, usize, f64)>,
    /// Response of all cells to each unknown: `W`.
    responses: Vec<Vec<f64>>,
    /// `D`, then the bordering system.
    system: Vec<f64>,
    scratch: Vec<f64>,
    lanes: Vec<Lanes>,
}

/// One pocket behind lines.
#[derive(Debug, Clone, Copy)]
struct Unknown {
    pocket: usize,
    /// Of all its lines together.
    supply: f64,
    resistance: f64,
    /// What it loses at `u = 0` into cells at 0.
    outflow: f64,
    /// What it loses per pressure, and per film fraction.
    conductance: f64,
    drain: f64,
    starved: bool,
    /// Pressure; film fraction if starved.
    value: f64,
}

/// What lies beyond one side of a fed cell.
#[derive(Debug, Clone, Copy)]
enum Beyond {
    Cell(usize),
    /// A full film at this pressure.
    Pressure(f64),
    Nothing,
}

/// One side of a fed cell: what conducts, and the flow that transport takes outward from a full film.
#[derive(Debug, Clone, Copy)]
struct Side {
    beyond: Beyond,
    conductance: f64,
    outward: f64,
}

impl FeedLines {
    /// Storage for a bearing on `cells` cells.
    pub(crate) fn new(bearing: &Bearing, cells: usize) -> Self {
        let feeds = bearing.feeds.len();
        let lines = bearing.feeds.iter().filter(|f| f.line != FeedLine::Direct);
        let count = lines.count();
        Self {
            pocket: (0..feeds).collect(),
            supply: vec![0.0; feeds],
            resistance: vec![0.0; feeds],
            starved: vec![false; feeds],
            unknown: Vec::with_capacity(count),
            slot: vec![None; feeds],
            couplings: Vec::with_capacity(if count > 0 { 4 * cells } else { 0 }),
            responses: vec![vec![0.0; cells]; count],
            system: Vec::with_capacity(count * count),
            scratch: Vec::with_capacity(count * count),
            lanes: Vec::with_capacity(count),
        }
    }

    /// Takes the supply of `feed`: pressure of the film's unit, and resistance to a flow in its unit.
    pub(crate) fn set_line(&mut self, feed: usize, supply: f64, resistance: f64) {
        self.supply[feed] = supply;
        self.resistance[feed] = resistance;
    }

    /// The feed whose pressure its pocket has: the first that nothing resists.
    fn holder(&self, pocket: usize) -> Option<usize> {
        (0..self.pocket.len()).find(|&f| self.pocket[f] == pocket && self.resistance[f] == 0.0)
    }

    /// Gathers the unknown pockets, with their lines in parallel, and gives the cells of all others
    /// the pressure that they are held at.
    pub(crate) fn gather(&mut self, fed_by: &[Option<usize>], set: &mut FilmSet) {
        self.unknown.clear();
        self.slot.fill(None);
        for pocket in 0..self.pocket.len() {
            if self.pocket[pocket] != pocket || self.holder(pocket).is_some() {
                continue;
            }
            let (mut conductance, mut driven) = (0.0, 0.0);
            for feed in (pocket..self.pocket.len()).filter(|&f| self.pocket[f] == pocket) {
                conductance += 1.0 / self.resistance[feed];
                driven += self.supply[feed] / self.resistance[feed];
            }
            self.slot[pocket] = Some(self.unknown.len());
            self.unknown.push(Unknown {
                pocket,
                supply: driven / conductance,
                resistance: 1.0 / conductance,
                outflow: 0.0,
                conductance: 0.0,
                drain: 0.0,
                starved: self.starved[pocket],
                value: 0.0,
            });
        }
        for (k, feed) in fed_by.iter().enumerate() {
            let Some(pocket) = feed.map(|feed| self.pocket[feed]) else {
                continue;
            };
            let held = self.holder(pocket).unwrap_or(pocket);
            set.fed_pressure[k] = self.supply[held];
            set.fed_fraction[k] = 1.0;
        }
    }

    pub(crate) fn has_unknowns(&self) -> bool {
        !self.unknown.is_empty()
    }

    fn slot_of(&self, fed_by: &[Option<usize>], cell: usize) -> Option<usize> {
        self.slot[self.pocket[fed_by[cell]?]]
    }

    /// Decides which pockets may be starved: those that lose something per film fraction.
    pub(crate) fn prepare(&mut self, operator: &Operator, fed_by: &[Option<usize>]) {
        for slot in 0..self.unknown.len() {
            let drain = self.drain_of(operator, fed_by, slot);
            let of = &mut self.unknown[slot];
            of.drain = drain;
            of.starved &= drain > 0.0;
        }
    }

    /// Flow that a pocket, starved, loses per film fraction.
    fn drain_of(&self, operator: &Operator, fed_by: &[Option<usize>], slot: usize) -> f64 {
        let is_within = |cell: usize| self.slot_of(fed_by, cell) == Some(slot);
        let mut drain = 0.0;
        for k in (0..fed_by.len()).filter(|&k| is_within(k)) {
            drain += operator.ruptured_storage[k];
            let (i, j) = (k / operator.n_axial, k % operator.n_axial);
            for (beyond, outward) in [
                (operator.west(i, j), -operator.transport[k]),
                (
                    operator.east(i, j),
                    operator.transport[k + operator.n_axial],
                ),
            ] {
                if !beyond.is_some_and(is_within) {
                    drain += outward.max(0.0);
                }
            }
        }
        drain
    }

    /// Puts the unknowns into the cells of their feeds.
    pub(crate) fn fill(&self, fed_by: &[Option<usize>], conserves: bool, set: &mut FilmSet) {
        for k in 0..fed_by.len() {
            let Some(slot) = self.slot_of(fed_by, k) else {
                continue;
            };
            let of = &self.unknown[slot];
            (set.fed_pressure[k], set.fed_fraction[k]) = match (of.starved, conserves) {
                (true, true) => (0.0, of.value),
                (true, false) => (0.0, 1.0),
                (false, _) => (of.value, 1.0),
            };
        }
    }

    /// Writes the balances of the unknown pockets, `C`, `D` and what is known, and the right sides of
    /// the responses, `B`. Cells of unknown pockets must be filled with 0.
    pub(crate) fn assemble(
        &mut self,
        operator: &Operator,
        set: &FilmSet,
        fed_by: &[Option<usize>],
        conserves: bool,
    ) {
        let count = self.unknown.len();
        self.couplings.clear();
        self.system.clear();
        self.system.resize(count * count, 0.0);
        for response in &mut self.responses[..count] {
            response.fill(0.0);
        }
        for k in 0..fed_by.len() {
            let Some(slot) = self.slot_of(fed_by, k) else {
                continue;
            };
            let starved = self.unknown[slot].starved;
            if starved {
                self.system[slot * (count + 1)] += operator.ruptured_storage[k];
                self.unknown[slot].outflow -= operator.stored[k];
            } else {
                self.responses[slot][k] = 1.0;
                self.unknown[slot].outflow += operator.storage[k] - operator.stored[k];
            }
            for side in sides(operator, set, k) {
                match side.beyond {
                    Beyond::Cell(n) if self.slot_of(fed_by, n) == Some(slot) => {}
                    Beyond::Cell(n) => self.couple(slot, side, n, set, fed_by, conserves),
                    Beyond::Pressure(outside) => {
                        self.lose(slot, side);
                        self.unknown[slot].outflow -= side.conductance * outside;
                        self.unknown[slot].outflow += side.outward.min(0.0);
                    }
                    Beyond::Nothing => {}
                }
            }
        }
    }

    /// What leaves the pocket through a side in proportion to its own unknown, or, full, by transport.
    fn lose(&mut self, slot: usize, side: Side) {
        let count = self.unknown.len();
        let of = &mut self.unknown[slot];
        of.conductance += side.conductance;
        if of.starved {
            self.system[slot * (count + 1)] += side.outward.max(0.0);
        } else {
            self.system[slot * (count + 1)] += side.conductance;
            of.outflow += side.outward.max(0.0);
        }
    }

    /// A side towards cell `n` outside the pocket.
    fn couple(
        &mut self,
        slot: usize,
        side: Side,
        n: usize,
        set: &FilmSet,
        fed_by: &[Option<usize>],
        conserves: bool,
    ) {
        self.lose(slot, side);
        let count = self.unknown.len();
        let (conductance, inward) = (side.conductance, side.outward.min(0.0));
        let mut outflow = 0.0;
        match (set.cells[n], self.slot_of(fed_by, n)) {
            (Cell::Full, _) => {
                self.couplings.push((slot, n, -conductance));
                outflow = inward;
            }
            (Cell::Ruptured, _) if conserves => self.couplings.push((slot, n, inward)),
            (Cell::Ruptured, _) => outflow = inward,
            (Cell::Fed, Some(other)) if self.unknown[other].starved && conserves => {
                self.system[slot * count + other] += inward;
            }
            (Cell::Fed, Some(other)) => {
                self.system[slot * count + other] -= conductance;
                outflow = inward;
            }
            (Cell::Fed, None) => {
                outflow = inward * set.fed_fraction[n] - conductance * set.fed_pressure[n];
            }
        }
        self.unknown[slot].outflow += outflow;
        let is_balanced =
            set.cells[n] == Cell::Full || (set.cells[n] == Cell::Ruptured && conserves);
        if is_balanced {
            self.responses[slot][n] += if self.unknown[slot].starved {
                side.outward.max(0.0)
            } else {
                conductance
            };
        }
    }

    /// Solves the bordering system, given the film `x` at unknowns of 0, and adds the responses to
    /// `x`. `tolerance` is the flow (1/s) below which a value beyond its bound is round-off. `false`
    /// where the balances determine nothing.
    pub(crate) fn close(
        &mut self,
        factor: &mut RingFactor,
        x: &mut [f64],
        tolerance: f64,
        conserves: bool,
    ) -> bool {
        let count = self.unknown.len();
        for response in &mut self.responses[..count] {
            factor.solve(response);
        }
        self.lanes.clear();
        for of in &self.unknown {
            let known = of.supply - of.resistance * of.outflow;
            self.lanes.push([known, 0.0, 0.0, 0.0]);
        }
        for &(slot, cell, coefficient) in &self.couplings {
            for (other, response) in self.responses[..count].iter().enumerate() {
                self.system[slot * count + other] += coefficient * response[cell];
            }
            self.lanes[slot][0] -= self.unknown[slot].resistance * coefficient * x[cell];
        }
        for slot in 0..count {
            let of = self.unknown[slot];
            for entry in &mut self.system[slot * count..(slot + 1) * count] {
                *entry *= of.resistance;
            }
            if !of.starved {
                self.system[slot * (count + 1)] += 1.0;
            } else if !conserves {
                self.hold(slot);
            }
        }
        self.scratch.clear();
        self.scratch.extend_from_slice(&self.system);
        if !solve_dense(&mut self.scratch, &mut self.lanes) {
            return false;
        }
        for (of, [value, ..]) in self.unknown.iter_mut().zip(&self.lanes) {
            of.value = snapped(of, *value, tolerance);
        }
        for (of, response) in self.unknown.iter().zip(&self.responses) {
            for (x, response) in x.iter_mut().zip(response) {
                *x += of.value * response;
            }
        }
        true
    }

    /// One step of iterative refinement on the balances of the pockets: `film` is the flow into the
    /// film per feed, 1/s, of the film `x`. Where little flows behind a low resistance, elimination
    /// leaves much of it as round-off.
    pub(crate) fn refine(&mut self, film: &[f64], x: &mut [f64], conserves: bool) {
        self.lanes.clear();
        for of in &self.unknown {
            let taken = self.taken(of.pocket, film);
            let pressure = if of.starved { 0.0 } else { of.value };
            let residual = if conserves || !of.starved {
                of.supply - pressure - of.resistance * taken
            } else {
                0.0
            };
            self.lanes.push([residual, 0.0, 0.0, 0.0]);
        }
        self.scratch.clear();
        self.scratch.extend_from_slice(&self.system);
        if !solve_dense(&mut self.scratch, &mut self.lanes) {
            return;
        }
        let steps = self.lanes.iter().zip(&self.responses);
        for (of, ([step, ..], response)) in self.unknown.iter_mut().zip(steps) {
            of.value += step;
            for (x, response) in x.iter_mut().zip(response) {
                *x += step * response;
            }
        }
    }

    /// Makes the equation of a pocket say that its unknown is 0: it is held at cavitation pressure.
    fn hold(&mut self, slot: usize) {
        let count = self.unknown.len();
        for other in 0..count {
            self.system[slot * count + other] = 0.0;
            self.system[other * count + slot] = 0.0;
        }
        self.system[slot * (count + 1)] = 1.0;
        self.lanes[slot][0] = 0.0;
        self.responses[slot].fill(0.0);
    }

    /// Moves pockets that break a condition to their other state; returns how many moved. `film` is
    /// the flow into the film per feed, 1/s.
    pub(crate) fn update(&mut self, film: &[f64], tolerance: f64, conserves: bool) -> usize {
        let mut moved = 0;
        for of in &self.unknown {
            let next = if !of.starved {
                of.value < 0.0 && of.drain > 0.0
            } else if conserves {
                (0.0..=1.0).contains(&of.value)
            } else {
                let taken = self.taken(of.pocket, film);
                of.supply <= of.resistance * (taken + tolerance)
            };
            moved += usize::from(next != self.starved[of.pocket]);
            self.starved[of.pocket] = next;
        }
        moved
    }

    /// Multipliers of the pockets' balances for the four outputs: `weights` are the derivatives of
    /// the outputs by the unknown of each cell, those of fed cells included. Takes what the
    /// multipliers contribute to the right side of the cells' adjoints from `weights`.
    pub(crate) fn close_adjoints<const L: usize>(&mut self, weights: &mut [Lanes<L>]) {
        let count = self.unknown.len();
        self.lanes.clear();
        for response in &self.responses[..count] {
            let mut sum = [0.0; 4];
            for (response, weights) in response.iter().zip(&*weights) {
                for (sum, weight) in sum.iter_mut().zip(weights) {
                    *sum += response * weight;
                }
            }
            self.lanes.push(sum);
        }
        self.scratch.clear();
        for column in 0..count {
            self.scratch
                .extend((0..count).map(|row| self.system[row * count + column]));
        }
        if !solve_dense(&mut self.scratch, &mut self.lanes) {
            // Not after a solution with the same system.
            self.lanes.fill([0.0; 4]);
        }
        for (lanes, of) in self.lanes.iter_mut().zip(&self.unknown) {
            *lanes = lanes.map(|lane| lane * of.resistance);
        }
        for &(slot, cell, coefficient) in &self.couplings {
            for (weight, lane) in weights[cell].iter_mut().zip(self.lanes[slot]) {
                *weight -= coefficient * lane;
            }
        }
    }

    /// The multiplier of the balance that a fed cell is part of; zero where its pressure is held.
    pub(crate) fn multiplier<const L: usize>(
        &self,
        fed_by: &[Option<usize>],
        cell: usize,
    ) -> Lanes<L> {
        self.slot_of(fed_by, cell)
            .and_then(|slot| self.lanes.get(slot))
            .map_or([0.0; L], |lanes| std::array::from_fn(|lane| lanes[lane]))
    }

    /// The pressure of this fed cell is unknown and not cut off at cavitation pressure.
    pub(crate) fn answers(&self, fed_by: &[Option<usize>], cell: usize) -> bool {
        self.slot_of(fed_by, cell)
            .is_some_and(|slot| !self.unknown[slot].starved)
    }

    /// Flow from all feeds of a pocket into the film, 1/s.
    fn taken(&self, pocket: usize, film: &[f64]) -> f64 {
        let members = self.pocket.iter().zip(film);
        members
            .filter(|(of, _)| **of == pocket)
            .map(|(_, flow)| flow)
            .sum()
    }

    /// Largest difference between what lines bring and what the film takes (1/s per feed in `film`),
    /// 1/s, where both must agree.
    pub(crate) fn imbalance(&self, film: &[f64], conserves: bool) -> f64 {
        let balanced = self.unknown.iter().filter(|of| conserves || !of.starved);
        balanced.fold(0.0, |worst, of| {
            let taken = self.taken(of.pocket, film);
            let pressure = if of.starved { 0.0 } else { of.value };
            worst.max(((of.supply - pressure) / of.resistance - taken).abs())
        })
    }

    /// Shares the flow of each pocket (1/s per feed in `film`) among its feeds: lines bring what
    /// their pressure drop says, and the feed that holds the pocket's pressure, or its first, the
    /// rest. Units: pressure (Pa) and flow (m3/s) per 1/s.
    pub(crate) fn account(
        &self,
        film: &[f64],
        [pressure_unit, flow_unit]: [f64; 2],
        cavitation_pressure: f64,
        flows: &mut [FeedFlow],
    ) {
        for feed in 0..flows.len() {
            let pocket = self.pocket[feed];
            let holder = self.holder(pocket);
            let pressure = match (holder, self.slot[pocket]) {
                (Some(holder), _) => self.supply[holder],
                (None, Some(slot)) if self.unknown[slot].starved => 0.0,
                // A closure that cuts pressures cuts those of feeds.
                (None, Some(slot)) => self.unknown[slot].value.max(0.0),
                (None, None) => self.supply[feed],
            };
            flows[feed].pressure = pressure * pressure_unit + cavitation_pressure;
            let line = |f: usize| match self.resistance[f] {
                0.0 => 0.0,
                resistance => (self.supply[f] - pressure) / resistance,
            };
            let members = || (0..flows.len()).filter(|&f| self.pocket[f] == pocket);
            let flow = if holder.unwrap_or(pocket) == feed {
                let others: f64 = members().filter(|&f| f != feed).map(line).sum();
                self.taken(pocket, film) - others
            } else {
                line(feed)
            };
            flows[feed].flow = flow * flow_unit;
        }
    }
}

/// A value that round-off alone keeps beyond its bound lies on the bound.
fn snapped(of: &Unknown, value: f64, tolerance: f64) -> f64 {
    if !of.starved && value < 0.0 && -value * of.conductance <= tolerance {
        0.0
    } else if of.starved && value > 1.0 && (value - 1.0) * of.drain <= tolerance {
        1.0
    } else {
        value
    }
}

fn sides(operator: &Operator, set: &FilmSet, cell: usize) -> [Side; 4] {
    let m = operator.n_axial;
    let (i, j) = (cell / m, cell % m);
    let around = |beyond: Option<usize>, side: usize, face: usize, sense: f64| Side {
        beyond: match (beyond, operator.around) {
            (Some(cell), _) => Beyond::Cell(cell),
            (None, Around::Pressures(given)) => Beyond::Pressure(given[side]),
            (None, _) => Beyond::Nothing,
        },
        conductance: operator.conductance_around[face],
        outward: sense * operator.transport[face],
    };
    let along = |is_end: bool, end: usize, beyond: usize, face: usize| Side {
        beyond: match operator.axial {
            _ if !is_end => Beyond::Cell(beyond),
            Axial::Closed => Beyond::Nothing,
            Axial::Air(_) if !set.end_open[2 * i + end] => Beyond::Nothing,
            Axial::Air(outside) | Axial::Bath(outside) => Beyond::Pressure(outside),
        },
        conductance: operator.conductance_axial[i * (m + 1) + face],
        outward: 0.0,
    };
    [
        around(operator.west(i, j), 0, cell, -1.0),
        around(operator.east(i, j), 1, cell + m, 1.0),
        along(j == 0, 0, cell.wrapping_sub(1), j),
        along(j + 1 == m, 1, cell + 1, j + 1),
    ]
}
