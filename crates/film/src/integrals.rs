//! What the film does to the journal: forces, moments, torques, flows and power from the fields.
//!
//! ```text
//! F = -int p n dA            M = int r x (-p n) dA          about the mid-plane shell centre
//! M_f = R int ( eta U_s/h +- (h/2) dp/dx ) dA               + journal, - shell
//! M_journal - M_shell = e x F + (tilt x M)_z - int p d(bore - journal profile)/d(angle) dA
//! P = (M_journal - int p d(journal profile)/d(angle) dA)(w_J - w_S) - F v - M tilt_rate
//! ```
//! with v and tilt_rate relative to the turning shell. The friction torques are those of the shear at
//! both surfaces; the pressure on a journal that is not round turns it, too.
//! Pressure weights are exact cell integrals of cos and sin, and the pressure part of the torque is
//! summed over faces: summation by parts then makes the torque identity exact on any grid, with the
//! rise of a profile over each cell.

use crate::bearing::Bearing;
use crate::cavitation::FilmSet;
use crate::force::{FilmSummary, Reaction, Tangent};
use crate::gap::{AngleTables, Gap, Waviness};
use crate::grid::Grid;
use crate::journal_state::JournalState;
use crate::linear::Lanes;
use crate::narrowest::GapSearch;
use crate::passage::Passage;
use crate::reynolds::{Around, Axial, Cell, Operator, Storage};
use crate::surfaces::Surfaces;
use sommerfeld_oil::CompressionLaw;

mod extremes;

/// Units that turn the film's relative quantities into SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Pressure, Pa per 1/s: 12 eta R^2 / c^2.
    pub pressure: f64,
    /// Area, m2: R^2.
    pub area: f64,
    /// Flow, m3/s per 1/s: c R^2.
    pub flow: f64,
    /// Radius R, m.
    pub radius: f64,
    /// Radial clearance c, m.
    pub clearance: f64,
    /// Viscosity eta, Pa s.
    pub viscosity: f64,
}

impl Units {
    /// For a bearing with oil of the given viscosity (Pa s).
    #[must_use]
    pub fn of(bearing: &Bearing, viscosity: f64) -> Self {
        let (radius, clearance) = (bearing.radius(), bearing.radial_clearance);
        Self {
            pressure: 12.0 * viscosity * (radius / clearance).powi(2),
            area: radius * radius,
            flow: clearance * radius * radius,
            radius,
            clearance,
            viscosity,
        }
    }
}

/// One solved film, as the integrals see it.
#[derive(Debug, Clone, Copy)]
pub struct SolvedFilm<'a> {
    /// The bearing.
    pub bearing: &'a Bearing,
    /// Its grid.
    pub grid: &'a Grid,
    /// Trigonometry of the grid.
    pub angles: &'a AngleTables,
    /// The gap.
    pub gap: &'a Gap,
    /// Profiles of both surfaces.
    pub surfaces: &'a Surfaces,
    /// Where the gap is smallest.
    pub search: &'a GapSearch,
    /// The balance.
    pub operator: &'a Operator,
    /// The set of the solution.
    pub set: &'a FilmSet,
    /// Reduced pressure per cell beyond cavitation pressure, 1/s: drives the flows.
    pub pressure: &'a [f64],
    /// P - P_cav per cell, 1/s, and its derivative by the reduced pressure; empty where they are one.
    pub stiffened: &'a [[f64; 2]],
    /// How the density grows with pressure.
    pub compression: &'a CompressionLaw,
    /// What the gap lets through, where it is not a smooth one of one oil.
    pub passage: Option<&'a Passage>,
    /// Contact pressure per cell, 1/s, and its derivative by the nominal H; empty without contact.
    pub contact: &'a [[f64; 2]],
    /// Where asperities press on a soft shell, per cell: by how much the gap falls as that of the rigid
    /// shapes does; else empty.
    pub yielding: &'a [f64],
    /// Film fraction per cell.
    pub film_fraction: &'a [f64],
    /// Content per cell over that of a full film without pressure: film fraction times density.
    pub held: &'a [f64],
    /// Entering beyond leaving per cell, 1/s.
    pub excess: &'a [f64],
    /// Units.
    pub units: Units,
}

impl SolvedFilm<'_> {
    /// P - P_cav of a cell, 1/s: what loads the journal.
    #[must_use]
    #[inline]
    pub fn loading(&self, cell: usize) -> f64 {
        match self.stiffened.get(cell) {
            Some([pressure, _]) => *pressure,
            None => self.pressure[cell],
        }
    }

    /// The same beside a face: of a cell, or of the boundary on a side.
    pub(crate) fn loading_beside(&self, cell: Option<usize>, side: usize) -> f64 {
        match (cell, self.operator.around) {
            (Some(cell), _) => self.loading(cell),
            (None, Around::Pressures(given)) => given[side],
            (None, _) => 0.0,
        }
    }

    /// Viscosity of a cell over that at no pressure.
    pub(crate) fn thickening(&self, cell: usize) -> f64 {
        let pressure = self.loading(cell);
        match self.stiffened.get(cell) {
            Some([_, slope]) => slope * self.compression.factor(pressure * self.units.pressure).0,
            None => 1.0,
        }
    }

    /// Derivative of the same by the reduced pressure.
    #[inline]
    pub(crate) fn stiffening(&self, cell: usize) -> f64 {
        self.stiffened.get(cell).map_or(1.0, |[_, slope]| *slope)
    }

    /// Force, moment and torques on the journal, in the frame of the grid.
    #[must_use]
    pub fn reaction(&self, state: &JournalState) -> Reaction {
        let (n, m) = (self.grid.n_around(), self.grid.n_axial());
        let (mut force, mut moment) = ([0.0; 2], [0.0; 2]);
        for i in 0..n {
            let [cos, sin] = self.angles.means[i];
            let (mut sum, mut lever) = (0.0, 0.0);
            for j in 0..m {
                let load = self.loading(i * m + j) * self.grid.axial_widths[j];
                sum += load;
                lever += load * self.grid.axial[j];
            }
            let width = self.grid.around_widths[i];
            force[0] -= cos * sum * width;
            force[1] -= sin * sum * width;
            moment[0] += sin * lever * width;
            moment[1] -= cos * lever * width;
        }
        let force_unit = self.units.pressure * self.units.area;
        let moment_unit = force_unit * self.units.radius;
        let friction = self.friction(state);
        let (contact_force, contact_moment) = self.contact_reaction();
        Reaction {
            film_force: force.map(|f| f * force_unit),
            film_moment: moment.map(|f| f * moment_unit),
            contact_force,
            contact_moment,
            friction_torque_journal: friction.journal + friction.boundary,
            friction_torque_shell: friction.shell + friction.boundary,
        }
    }

    /// Everything a designer asks of the film.
    #[must_use]
    pub fn summary(&self, state: &JournalState, reaction: &Reaction) -> FilmSummary {
        let (n, m) = (self.grid.n_around(), self.grid.n_axial());
        let mut summary = FilmSummary {
            minimum_film_thickness: self.minimum_film(state),
            edge_film_thickness: self.search.at_edges(self.bearing, state),
            peak_film_pressure: self.peak_pressure(),
            peak_contact_pressure: self.peak_contact(),
            contact_load: self.contact_load(),
            ..FilmSummary::default()
        };
        let (mut land, mut full) = (0.0, 0.0);
        for i in 0..n {
            summary.side_flow[0] -= self.operator.flow_axial(i, 0, self.pressure);
            summary.side_flow[1] += self.operator.flow_axial(i, m, self.pressure);
            for j in 0..m {
                let k = i * m + j;
                summary.storage_rate += self.operator.stored_flow(k, self.held[k]);
                if self.set.cells[k] == Cell::Fed {
                    summary.feed_flow -= self.excess[k];
                } else {
                    land += self.grid.area(i, j);
                    let carries = self.set.cells[k] == Cell::Full && self.pressure[k] > 0.0;
                    full += if carries { self.grid.area(i, j) } else { 0.0 };
                }
            }
        }
        summary.feed_flow += self.inlet_line_flow();
        summary.full_film_share = full / land;
        let unit = self.units.flow;
        summary.side_flow = summary.side_flow.map(|q| q * unit);
        summary.feed_flow *= unit;
        summary.storage_rate *= unit;
        let side = summary.side_flow[0] + summary.side_flow[1];
        let largest = [side, summary.feed_flow, summary.storage_rate]
            .into_iter()
            .fold(0.0_f64, |a, b| a.max(b.abs()));
        if largest > 0.0 {
            summary.mass_balance_relative =
                (summary.feed_flow - side - summary.storage_rate).abs() / largest;
        }
        self.add_power(state, reaction, &mut summary);
        summary
    }

    /// `int p d(journal profile)/d(angle) dA`, N m: what the pressure turns a journal by that is not
    /// round.
    fn profile_torque(&self) -> f64 {
        if !self.surfaces.journal_varies_around() {
            return 0.0;
        }
        let m = self.grid.n_axial();
        let terms = (0..self.pressure.len()).map(|k| (k, self.loading(k)));
        let sum: f64 = terms
            .map(|(k, p)| p * self.surfaces.journal_rise(k, m) * self.grid.axial_widths[k % m])
            .sum();
        sum * self.units.clearance * self.units.pressure * self.units.area
    }

    /// Flow into the film from a line that holds a pressure around: before the first cell and
    /// behind the last, 1/s.
    fn inlet_line_flow(&self) -> f64 {
        let n = self.grid.n_around();
        if self.operator.west(0, 0).is_some() {
            return 0.0;
        }
        (0..self.grid.n_axial())
            .map(|j| {
                self.operator.flow_around(0, j, self.pressure, self.held)
                    - self.operator.flow_around(n, j, self.pressure, self.held)
            })
            .sum()
    }

    /// Power by friction and by squeeze, W, both relative to the shell.
    fn add_power(&self, state: &JournalState, reaction: &Reaction, summary: &mut FilmSummary) {
        let turning = state.shell_speed;
        let relative =
            |rate: [f64; 2], of: [f64; 2]| [rate[0] + turning * of[1], rate[1] - turning * of[0]];
        let velocity = relative(state.velocity, state.position);
        let tilt_rate = relative(state.tilt_rate, state.tilt);
        let (force, moment) = (reaction.force(), reaction.moment());
        summary.friction_power =
            reaction.friction_torque_journal * (state.journal_speed - state.shell_speed);
        summary.boundary_power =
            self.friction(state).boundary * (state.journal_speed - state.shell_speed);
        summary.squeeze_power = -(force[0] * velocity[0] + force[1] * velocity[1])
            - (moment[0] * tilt_rate[0] + moment[1] * tilt_rate[1])
            - self.profile_torque() * (state.journal_speed - state.shell_speed);
    }

    /// Derivatives of force and moment for this set, by the adjoints of its outputs, the
    /// force alone or the moment too:
    /// `dF/dq = -y . dR/dq` with the balance R and `M^T y = dF/dP`. `adjoints` per cell, one lane per
    /// output, already zero where the equation is not a balance.
    #[must_use]
    pub fn tangent<const L: usize>(&self, adjoints: &[Lanes<L>], storage: Storage<'_>) -> Tangent {
        let (mut by_position, mut by_rate) = (Sensitivity::<L>::new(), Sensitivity::<L>::new());
        let gives_way = self.operator.leaning.len().max(self.yielding.len());
        let mut yielded = vec![[0.0; L]; gives_way.min(self.pressure.len())];
        self.sensitivity_around(adjoints, &mut yielded, &mut by_position);
        self.sensitivity_axial(adjoints, &mut yielded, &mut by_position);
        self.sensitivity_cells(&yielded, &mut by_position);
        match storage {
            Storage::Rate => {
                self.sensitivity_storage(adjoints, [1.0, 0.0], &[], &mut by_rate);
                self.sensitivity_storage(adjoints, [0.0, 1.0], self.yielding, &mut by_position);
                self.sensitivity_limited_storage(adjoints, &mut by_position);
            }
            Storage::Step {
                duration, after, ..
            } => {
                let per_time = 1.0 / duration;
                let by_gap = [per_time, after * per_time];
                self.sensitivity_storage(adjoints, by_gap, self.yielding, &mut by_position);
                self.sensitivity_storage(adjoints, [after * per_time, 0.0], &[], &mut by_rate);
            }
        }
        Tangent {
            by_position: by_position.in_units(&self.units),
            by_rate: by_rate.in_units(&self.units),
        }
    }

    fn sensitivity_around<const L: usize>(
        &self,
        adjoints: &[Lanes<L>],
        yielded: &mut [Lanes<L>],
        by: &mut Sensitivity<L>,
    ) {
        let (n, m) = (self.grid.n_around(), self.grid.n_axial());
        let is_ring = self.operator.west(0, 0).is_some();
        let last = if is_ring { n } else { n + 1 };
        let mut steps = self.gap.steps.as_slice();
        for i in 0..last {
            let stations = self.operator.stations_beside(i);
            let mut sums = StationSums::<L>::new();
            for j in 0..m {
                let face = i * m + j;
                let [before, behind] = stations.map(|station| station.map(|i| i * m + j));
                let (p_before, theta_before) =
                    self.operator.beside(before, 0, self.pressure, self.held);
                let (p_behind, theta_behind) =
                    self.operator.beside(behind, 1, self.pressure, self.held);
                let transport = self.operator.transport[face];
                let upstream = if transport > 0.0 {
                    theta_before
                } else {
                    theta_behind
                };
                let (conducting, carrying) = match self.passage {
                    Some(passage) => passage.around_slopes[face].into(),
                    None => self.gap.relative_slopes(face, &mut steps),
                };
                let conducted = conducting * self.operator.conductance_around[face];
                let leaning = self.operator.leaning.get(face);
                let carried = leaning.map_or(carrying * transport, |leaning| leaning.by_face);
                let by_height = conducted * (p_before - p_behind) + carried * upstream;
                let value = |cell: Option<usize>| cell.map_or([0.0; L], |k| adjoints[k]);
                let sides = [value(before), value(behind)];
                sums.add(sides[0], sides[1], by_height, self.grid.axial[j]);
                self.add_yielded([before, behind], sides, by_height, yielded);
                if let Some(leaning) = leaning {
                    let by_cells = leaning.by_cells.map(|by_cell| by_cell * upstream);
                    self.add_leaning([before, behind], sides, by_cells, yielded);
                }
            }
            by.add(&sums, self.angles.faces[i]);
        }
    }

    fn sensitivity_axial<const L: usize>(
        &self,
        adjoints: &[Lanes<L>],
        yielded: &mut [Lanes<L>],
        by: &mut Sensitivity<L>,
    ) {
        let (n, m) = (self.grid.n_around(), self.grid.n_axial());
        for i in 0..n {
            let gap = &self.gap.axial[i * (m + 1)..(i + 1) * (m + 1)];
            let conductance = &self.operator.conductance_axial[i * (m + 1)..(i + 1) * (m + 1)];
            let pressure = &self.pressure[i * m..(i + 1) * m];
            let adjoints = &adjoints[i * m..(i + 1) * m];
            let faces = &self.grid.axial_faces;
            let slope = |j: usize| match self.passage {
                Some(passage) => passage.axial_slopes[i * (m + 1) + j],
                None => 3.0 / gap[j],
            };
            let mut sums = StationSums::<L>::new();
            for j in 0..=m {
                let flow = if j == 0 || j == m {
                    self.set_flow_at_end(i, j)
                } else {
                    conductance[j] * (pressure[j - 1] - pressure[j])
                };
                let [rigid, _] = self.gap.end_slopes(i, j, m);
                let by_height = slope(j) * rigid * flow;
                let before = if j > 0 { adjoints[j - 1] } else { [0.0; L] };
                let behind = if j < m { adjoints[j] } else { [0.0; L] };
                sums.add(before, behind, by_height, faces[j]);
                let cells = [(j > 0).then(|| i * m + j - 1), (j < m).then_some(i * m + j)];
                self.add_yielded(cells, [before, behind], by_height, yielded);
            }
            by.add(&sums, self.angles.centres[i]);
        }
    }

    /// Flow through the first (`j` = 0) or last face along the axis as the equations of the set have
    /// it: an end against air is open or closed by the set, not by the pressure.
    fn set_flow_at_end(&self, i: usize, j: usize) -> f64 {
        let m = self.grid.n_axial();
        let outside = match self.operator.axial {
            Axial::Closed => return 0.0,
            Axial::Air(_) if !self.set.end_open[2 * i + usize::from(j == m)] => return 0.0,
            Axial::Bath(p) | Axial::Air(p) => p,
        };
        let (inside, outward) = if j == 0 {
            (i * m, -1.0)
        } else {
            (i * m + m - 1, 1.0)
        };
        let conductance = self.operator.conductance_axial[i * (m + 1) + j];
        outward * conductance * (self.pressure[inside] - outside)
    }

    /// `per_time`: 1 for rates of change; 1/duration for the gap and after/duration for its rate in
    /// steps.
    /// Of what cells hold, by the gap (or its rate) `per_time`, and by how its growth changes with the
    /// gap `per_rate`; `yielding` for a gap that follows the rigid shapes only in part.
    fn sensitivity_storage<const L: usize>(
        &self,
        adjoints: &[Lanes<L>],
        [per_time, per_rate]: [f64; 2],
        yielding: &[f64],
        by: &mut Sensitivity<L>,
    ) {
        let m = self.grid.n_axial();
        if self.passage.is_none() && per_time == 0.0 {
            return;
        }
        for i in 0..self.grid.n_around() {
            let mut sums = StationSums::<L>::new();
            for j in 0..m {
                let k = i * m + j;
                if !self.gains_limited(k) {
                    let held = self.passage.map_or(per_time, |passage| {
                        let [slope, curvature] = passage.holding_slopes[k];
                        per_time * slope + per_rate * passage.rate[k] * curvature
                    });
                    let yielding = yielding.get(k).copied().unwrap_or(1.0);
                    let by_height = held * yielding * self.held[k] * self.grid.area(i, j);
                    sums.add(adjoints[k], [0.0; L], by_height, self.grid.axial[j]);
                }
            }
            by.add(&sums, self.angles.means[i]);
        }
    }

    /// Of what follows the gap of a cell: the pressure of asperities that touch, what they press back, and a
    /// gap that leans upstream.
    fn sensitivity_cells<const L: usize>(&self, yielded: &[Lanes<L>], by: &mut Sensitivity<L>) {
        if self.contact.is_empty() && yielded.is_empty() {
            return;
        }
        let m = self.grid.n_axial();
        for i in 0..self.grid.n_around() {
            let mut sums = StationSums::<L>::new();
            for j in 0..m {
                let k = i * m + j;
                if !self.contact.is_empty()
                    && let Some(outputs) = self.contact_by_height::<L>(k)
                {
                    sums.add([0.0; L], outputs, 1.0, self.grid.axial[j]);
                }
                if let Some(pressed) = yielded.get(k) {
                    sums.add(*pressed, [0.0; L], 1.0, self.grid.axial[j]);
                }
            }
            by.add(&sums, self.angles.means[i]);
        }
    }

    /// A ruptured cell gains no more than transport brings it, see [`Operator::ruptured_storage`].
    fn gains_limited(&self, cell: usize) -> bool {
        self.film_fraction[cell] < 1.0
            && self.operator.ruptured_storage[cell] > self.operator.storage[cell]
    }

    /// The limited gain follows the gap at the face that the cell drains through.
    fn sensitivity_limited_storage<const L: usize>(
        &self,
        adjoints: &[Lanes<L>],
        by: &mut Sensitivity<L>,
    ) {
        let m = self.grid.n_axial();
        let speed = self.operator.mean_speed;
        for i in 0..self.grid.n_around() {
            let mut sums = StationSums::<L>::new();
            for j in 0..m {
                let k = i * m + j;
                if self.gains_limited(k) {
                    let per_height = self.passage.map_or(1.0, |passage| {
                        let face = if speed > 0.0 { k + m } else { k };
                        passage.around_slopes[face][1] * self.gap.around_transport[face]
                    });
                    let by_height =
                        -speed.abs() * per_height * self.grid.area(i, j) * self.film_fraction[k];
                    sums.add(adjoints[k], [0.0; L], by_height, self.grid.axial[j]);
                }
            }
            by.add(
                &sums,
                self.angles.faces[if speed > 0.0 { i + 1 } else { i }],
            );
        }
    }

    /// Half of what the gap at a face does not follow the rigid shapes belongs to the cell on either side:
    /// its asperities press the shell back.
    fn add_yielded<const L: usize>(
        &self,
        cells: [Option<usize>; 2],
        [before, behind]: [Lanes<L>; 2],
        by_height: f64,
        yielded: &mut [Lanes<L>],
    ) {
        if self.yielding.is_empty() {
            return;
        }
        for k in cells.into_iter().flatten() {
            let share = 0.5 * (self.yielding[k] - 1.0) * by_height;
            for output in 0..L {
                yielded[k][output] += share * (before[output] - behind[output]);
            }
        }
    }

    /// What leans upstream follows the gaps of the cells on either side.
    fn add_leaning<const L: usize>(
        &self,
        cells: [Option<usize>; 2],
        [before, behind]: [Lanes<L>; 2],
        by_cells: [f64; 2],
        yielded: &mut [Lanes<L>],
    ) {
        for (cell, by_cell) in cells.into_iter().zip(by_cells) {
            let Some(k) = cell else { continue };
            let by_cell = by_cell * self.yielding.get(k).copied().unwrap_or(1.0);
            for output in 0..L {
                yielded[k][output] += by_cell * (before[output] - behind[output]);
            }
        }
    }

    /// Load on the journal per pressure of a cell: a shell that gives way takes load off its asperities.
    fn carrying(&self, cell: usize) -> f64 {
        if self.yielding.is_empty() {
            return 1.0;
        }
        let compliance = self.bearing.elasticity.compliance() * self.units.pressure;
        1.0 + self.contact[cell][1] * compliance / self.units.clearance
    }

    /// Right sides of the adjoints: derivative of force and moment with respect to P of each cell whose
    /// P is an unknown that acts on the journal (`loaded`).
    pub fn output_weights<const L: usize>(
        &self,
        loaded: impl Fn(usize) -> bool,
        weights: &mut [Lanes<L>],
    ) {
        let m = self.grid.n_axial();
        for i in 0..self.grid.n_around() {
            for j in 0..m {
                let k = i * m + j;
                weights[k] = if loaded(k) {
                    let stiffening = self.stiffening(k) * self.carrying(k);
                    self.output_weight(k).map(|weight| weight * stiffening)
                } else {
                    [0.0; L]
                };
            }
        }
    }

    /// Derivative of force and moment with respect to P of a cell.
    #[must_use]
    pub fn output_weight<const L: usize>(&self, cell: usize) -> Lanes<L> {
        let m = self.grid.n_axial();
        let (i, j) = (cell / m, cell % m);
        let [cos, sin] = self.angles.means[i];
        let area = self.grid.area(i, j);
        let lever = area * self.grid.axial[j];
        let all = [-cos * area, -sin * area, sin * lever, -cos * lever];
        std::array::from_fn(|output| all[output])
    }
}

/// What one station gives to the outputs per rise of H there: in the mid-plane, and times zeta.
#[derive(Debug, Clone, Copy)]
struct StationSums<const L: usize> {
    even: Lanes<L>,
    tilting: Lanes<L>,
}

impl<const L: usize> StationSums<L> {
    fn new() -> Self {
        Self {
            even: [0.0; L],
            tilting: [0.0; L],
        }
    }

    /// Adds the share of one face (adjoints before and behind it) or cell, given the derivative of
    /// its flow by H.
    #[inline]
    fn add(&mut self, before: Lanes<L>, behind: Lanes<L>, by_height: f64, zeta: f64) {
        for output in 0..L {
            let drop = (before[output] - behind[output]) * by_height;
            self.even[output] += drop;
            // Without moments among the outputs there is no tilt.
            if L == 4 {
                self.tilting[output] += zeta * drop;
            }
        }
    }
}

/// Derivatives of the outputs being summed: one row of lanes (outputs) per motion.
#[derive(Debug, Clone, Copy)]
struct Sensitivity<const L: usize> {
    by_motion: [Lanes<L>; 4],
}

impl<const L: usize> Sensitivity<L> {
    fn new() -> Self {
        Self {
            by_motion: [[0.0; L]; 4],
        }
    }

    /// Adds a station. H falls by `cos * x + sin * y` with `(x, y) = position + zeta (ty, -tx)`, and
    /// the output is minus the adjoint times the balance: the two signs cancel.
    fn add(&mut self, sums: &StationSums<L>, [cos, sin]: [f64; 2]) {
        let motions = [
            (cos, &sums.even),
            (sin, &sums.even),
            (-sin, &sums.tilting),
            (cos, &sums.tilting),
        ];
        for (lanes, (factor, sums)) in self.by_motion.iter_mut().zip(motions) {
            for (sum, share) in lanes.iter_mut().zip(sums) {
                *sum += factor * share;
            }
        }
    }

    /// As rows of outputs by motions, SI; rows of what is no output are zero.
    fn in_units(&self, units: &Units) -> [[f64; 4]; 4] {
        let force = units.pressure * units.area;
        let moment = force * units.radius;
        let outputs = [force, force, moment, moment];
        let (per_length, per_tilt) = (1.0 / units.clearance, units.radius / units.clearance);
        let inputs = [per_length, per_length, per_tilt, per_tilt];
        let mut rows = [[0.0; 4]; 4];
        for (output, row) in rows.iter_mut().enumerate().take(L) {
            for (motion, value) in row.iter_mut().enumerate() {
                *value = self.by_motion[motion][output] * outputs[output] * inputs[motion];
            }
        }
        rows
    }
}

/// Waviness of a state's position and of its motion, relative to the clearance.
#[must_use]
pub fn relative_motion(bearing: &Bearing, state: &JournalState) -> (Waviness, Waviness) {
    let c = bearing.radial_clearance;
    let tilt = bearing.radius() / c;
    let relative = |centre: [f64; 2], turn: [f64; 2]| {
        Waviness::of(centre.map(|v| v / c), turn.map(|v| v * tilt))
    };
    (
        relative(state.position, state.tilt),
        relative(state.velocity, state.tilt_rate),
    )
}
