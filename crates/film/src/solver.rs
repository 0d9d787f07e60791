//! The film of one bearing at one instant, by finite volumes and active sets.
//!
//! The stages of [`FilmSolver::linearise`]:
//! 1. gap: where the journal is, how thick the film
//! 2. supply: which cells a groove or hole holds at its pressure
//! 3. operator: what conducts, what is dragged along, what is stored
//! 4. cavitation: the equations of the present set, solved directly
//! 5. integrals: force, moment, torques; tangents by adjoints on the same factors
//! 6. the next set; unchanged means settled

use crate::bearing::{Bearing, Cavitation, Ends, Inlet};
use crate::cavitation::{CavitationModel, FilmSet, model_of};
use crate::force::{
    Capabilities, Conditions, FeedFlow, FilmError, FilmField, FilmForce, FilmHistory, FilmSummary,
    Linearised, Outcome, Reaction, Step, Tangent,
};
use crate::frame::Frame;
use crate::gap::{AngleTables, Gap};
use crate::grid::Grid;
use crate::integrals::{SolvedFilm, Units, minimum_film, relative_motion};
use crate::journal_state::JournalState;
use crate::linear::{Lanes, RingFactor, RingMatrix};
use crate::mirror::{Extent, half_of};
use crate::reynolds::{Around, Axial, Cell, Operator, Storage};
use crate::supply::mark_fed_cells;
use sommerfeld_oil::Lubricant;

/// Flow below this share of the largest is round-off of the direct solution.
const ROUND_OFF: f64 = 1e-12;

/// A film solved on a grid: the [`FilmForce`] with fields.
pub struct FilmSolver {
    bearing: Bearing,
    lubricant: Lubricant,
    closure: Box<dyn CavitationModel>,
    frame: Frame,
    extent: Extent,
    grid: Grid,
    angles: AngleTables,
    film: Film,
    /// The same bearing on half the cells: where a cold start gets its set from.
    coarse: Option<Box<FilmSolver>>,
}

/// Everything that changes from call to call.
struct Film {
    gap: Gap,
    operator: Operator,
    set: FilmSet,
    matrix: RingMatrix,
    factor: RingFactor,
    fed_by: Vec<Option<usize>>,
    rhs: Vec<f64>,
    solution: Vec<f64>,
    correction: Vec<f64>,
    pressure: Vec<f64>,
    film_fraction: Vec<f64>,
    excess: Vec<f64>,
    /// Largest flow of the last balance, 1/s.
    flow_scale: f64,
    /// Adjoints of force and moment, per cell.
    adjoints: Vec<Lanes>,
    /// Content theta H at the last accepted step; empty before the first.
    content: Vec<f64>,
    /// Content that an implicit step starts from.
    old_content: Vec<f64>,
    is_warm: bool,
    iterations: usize,
    state: JournalState,
    reaction: Reaction,
    units: Units,
    density: f64,
    feed_flows: Vec<FeedFlow>,
    fields: Fields,
}

/// The fields in SI, as the caller sees them.
struct Fields {
    angles: Vec<f64>,
    axial: Vec<f64>,
    pressure: Vec<f64>,
    film_fraction: Vec<f64>,
    film_thickness: Vec<f64>,
}

impl FilmSolver {
    /// A solver for `bearing` with `n_around` x `n_axial` cells: fixed in the shell frame, or, with
    /// the inlet on the line of the widest gap, following that line.
    ///
    /// # Errors
    /// [`FilmError::Unsupported`] for a bearing that the grid cannot hold.
    pub fn new(
        bearing: &Bearing,
        lubricant: &Lubricant,
        [n_around, n_axial]: [usize; 2],
    ) -> Result<Self, FilmError> {
        match bearing.inlet {
            Inlet::Cyclic => {
                let grid = Grid::shell_fixed(bearing, n_around, n_axial);
                Self::on_grid(bearing, lubricant, grid, Frame::Shell, Extent::Whole)
            }
            Inlet::MaxFilmLine { .. } => {
                Self::following(bearing, lubricant, [n_around, n_axial], 0.0)
            }
        }
    }

    /// The same for a journal that stays aligned: where the bearing is its own mirror image, half of
    /// it is solved. It refuses tilt, and its tangent by tilt is zero.
    ///
    /// # Errors
    /// As [`FilmSolver::new`].
    pub fn aligned(
        bearing: &Bearing,
        lubricant: &Lubricant,
        cells: [usize; 2],
    ) -> Result<Self, FilmError> {
        if bearing.inlet == Inlet::Cyclic {
            let grid = Grid::shell_fixed(bearing, cells[0], cells[1]);
            if let Some(half) = half_of(bearing, &grid) {
                return Self::on_grid(bearing, lubricant, half, Frame::Shell, Extent::Half);
            }
        }
        Self::new(bearing, lubricant, cells)
    }

    /// A solver whose grid turns with the line of centres, graded towards the narrowest gap
    /// (`grading` as in [`Grid::following`]); for bearings without feeds and runs without history.
    ///
    /// # Errors
    /// [`FilmError::Unsupported`] for bearings with feeds: they stand still in another frame.
    pub fn following(
        bearing: &Bearing,
        lubricant: &Lubricant,
        [n_around, n_axial]: [usize; 2],
        grading: f64,
    ) -> Result<Self, FilmError> {
        let grid = Grid::following(bearing, n_around, n_axial, grading);
        Self::on_grid(
            bearing,
            lubricant,
            grid,
            Frame::LineOfCentres,
            Extent::Whole,
        )
    }

    fn on_grid(
        bearing: &Bearing,
        lubricant: &Lubricant,
        grid: Grid,
        frame: Frame,
        extent: Extent,
    ) -> Result<Self, FilmError> {
        if frame == Frame::LineOfCentres && !bearing.feeds.is_empty() {
            return Err(FilmError::Unsupported {
                reason: "grooves and holes need inlet = \"cyclic\": a grid that follows the line \
                         of centres cannot hold them",
            });
        }
        let coarse = match grid.coarsened() {
            Some(coarse) => {
                let solver = Self::on_grid(bearing, lubricant, coarse, frame, extent)?;
                Some(Box::new(solver))
            }
            None => None,
        };
        let angles = AngleTables::new(&grid);
        Ok(Self {
            film: Film::new(bearing, lubricant, &grid, extent),
            bearing: bearing.clone(),
            lubricant: lubricant.clone(),
            closure: model_of(bearing.cavitation),
            frame,
            extent,
            angles,
            grid,
            coarse,
        })
    }

    /// The bearing that is solved.
    #[must_use]
    pub fn bearing(&self) -> &Bearing {
        &self.bearing
    }

    /// The grid that it is solved on.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The set of cells of the last solution's successor: equal to its own once settled.
    #[must_use]
    pub fn set(&self) -> &FilmSet {
        &self.film.set
    }

    /// Forgets the cavitated set: the next update starts cold.
    pub fn cool(&mut self) {
        self.film.is_warm = false;
    }

    /// No oil can reach a steady film: it empties.
    fn is_starved(&self) -> bool {
        let flooded = self.bearing.ends == Ends::Flooded
            && self.bearing.ambient_pressure > self.bearing.cavitation_pressure;
        self.closure.conserves_mass()
            && self.bearing.feeds.is_empty()
            && self.bearing.inlet == Inlet::Cyclic
            && !flooded
    }

    fn check(&self, state: &JournalState, step: Step) -> Result<(), FilmError> {
        for (name, values) in [
            ("position", state.position),
            ("velocity", state.velocity),
            ("tilt", state.tilt),
            ("tilt rate", state.tilt_rate),
            ("speed", [state.journal_speed, state.shell_speed]),
            ("surface angle", [state.journal_angle, state.shell_angle]),
        ] {
            if !values.iter().all(|v| v.is_finite()) {
                return Err(FilmError::NotFinite { name });
            }
        }
        if self.bearing.cavitation == Cavitation::MassConserving
            && self.frame == Frame::LineOfCentres
            && matches!(step, Step::Implicit { .. })
        {
            return Err(FilmError::Unsupported {
                reason: "inlet = \"max-film-line\" keeps no film history: use a groove or hole, or \
                         cavitation = \"reynolds\"",
            });
        }
        if self.extent == Extent::Half && (state.tilt, state.tilt_rate) != ([0.0; 2], [0.0; 2]) {
            return Err(FilmError::NoTilt);
        }
        let least = minimum_film(&self.bearing, state);
        if least.value > 0.0 {
            return Ok(());
        }
        Err(FilmError::Contact {
            angle_deg: least.angle.to_degrees(),
            axial_mm: 1e3 * least.axial,
            gap_um: 1e6 * least.value,
        })
    }

    /// Set of a cold film: that of the same film on half the cells, to the root.
    fn start_cold(
        &mut self,
        state: &JournalState,
        conditions: &Conditions<'_>,
    ) -> Result<(), FilmError> {
        self.film.is_warm = true;
        for cell in &mut self.film.set.cells {
            *cell = Cell::Full;
        }
        let Some(coarse) = &mut self.coarse else {
            return Ok(());
        };
        coarse.react(state, Step::Steady, conditions)?;
        let m = self.grid.n_axial();
        let (n_coarse, m_coarse) = (coarse.grid.n_around(), coarse.grid.n_axial());
        let (around, along) = (self.grid.n_around() / n_coarse, m / m_coarse);
        for (k, cell) in self.film.set.cells.iter_mut().enumerate() {
            let parent = (k / m / around) * m_coarse + (k % m) / along;
            *cell = coarse.film.set.cells[parent];
        }
        Ok(())
    }

    /// Stage 1 to 3. `state` is in the frame of the grid.
    fn prepare(&mut self, state: &JournalState, step: Step, conditions: &Conditions<'_>) {
        let film = &mut self.film;
        let temperature = conditions.temperature;
        film.units = Units::of(
            &self.bearing,
            self.lubricant.viscosity(temperature, 0.0).value,
        );
        film.density = self.lubricant.density(temperature, 0.0).value;
        let (position, rate) = relative_motion(&self.bearing, state);
        self.angles
            .fill_gap(&self.grid, &position, &rate, &mut film.gap);

        mark_fed_cells(&self.bearing, &self.grid, state, &mut film.fed_by);
        film.place_feeds(&self.bearing, conditions);

        film.place_boundaries(&self.bearing);
        film.take_old_content(step);
        let storage = film_storage(self.closure.as_ref(), step, &film.old_content);
        film.operator
            .update(&self.grid, &film.gap, state.mean_speed(), storage);
        film.operator
            .hold_feeds_to_edges(&self.grid, &film.set.cells);
    }

    fn solved(&self) -> SolvedFilm<'_> {
        SolvedFilm {
            bearing: &self.bearing,
            grid: &self.grid,
            angles: &self.angles,
            gap: &self.film.gap,
            operator: &self.film.operator,
            set: &self.film.set,
            pressure: &self.film.pressure,
            film_fraction: &self.film.film_fraction,
            excess: &self.film.excess,
            units: self.film.units,
        }
    }

    /// Tangents at the set of the last solution.
    fn tangent(&mut self, step: Step) -> Tangent {
        let mut adjoints = std::mem::take(&mut self.film.adjoints);
        let solved = self.solved();
        let closure = self.closure.as_ref();
        solved.output_weights(
            |k| closure.loaded(solved.set, solved.pressure, k),
            &mut adjoints,
        );
        self.film.factor.solve_transposed(&mut adjoints);
        // Known cells have no balance that could answer.
        for (adjoint, cell) in adjoints.iter_mut().zip(&self.film.set.cells) {
            if *cell == Cell::Fed || (*cell == Cell::Ruptured && !closure.conserves_mass()) {
                *adjoint = [0.0; 4];
            }
        }
        let storage = film_storage(closure, step, &self.film.old_content);
        let solved = SolvedFilm {
            pressure: closure.equation_pressure(&self.film.solution, &self.film.pressure),
            ..self.solved()
        };
        let tangent = solved.tangent(&adjoints, storage);
        self.film.adjoints = adjoints;
        tangent
    }
}

impl FilmForce for FilmSolver {
    fn capabilities(&self) -> Capabilities {
        Capabilities {
            accepts_tilt: self.extent == Extent::Whole,
            has_history: self.closure.conserves_mass(),
            conserves_mass: self.closure.conserves_mass(),
            // A front that must cross the bearing moves at least a cell per update.
            iteration_limit: 30 + self.grid.n_around(),
        }
    }

    fn minimum_gap(&self, state: &JournalState) -> f64 {
        self.bearing.minimum_gap(state)
    }

    fn linearise(
        &mut self,
        state: &JournalState,
        step: Step,
        conditions: &Conditions<'_>,
    ) -> Result<Linearised, FilmError> {
        self.check(state, step)?;
        if step == Step::Steady && self.is_starved() {
            return Ok(Linearised::without_film(Outcome::Starved));
        }
        if !self.film.is_warm {
            self.start_cold(state, conditions)?;
        }
        let turned = self.frame.turn(state);
        let local = self.frame.to_grid(state, turned);
        self.prepare(&local, step, conditions);
        self.film.iterations += 1;
        self.film.state = *state;
        if !self.film.solve(self.closure.as_ref()) {
            return Ok(Linearised::without_film(Outcome::NoSolution));
        }
        self.film.account_feeds(self.extent);
        let reaction = self.extent.reaction(self.solved().reaction(&local));
        let tangent = self.extent.tangent(self.tangent(step));
        let (reaction, tangent) = self.frame.from_grid(&local, turned, reaction, tangent);
        self.film.reaction = reaction;
        self.film
            .write_fields(&self.bearing, &self.grid, self.extent, turned);
        let moved = self.film.advance_set(self.closure.as_ref());
        Ok(Linearised {
            reaction,
            tangent,
            settled: moved == 0,
            outcome: Outcome::Converged,
        })
    }

    fn summary(&self) -> FilmSummary {
        let solved = self.solved();
        let film = &self.film;
        let turned = self.frame.turn(&film.state);
        let mut summary = self
            .extent
            .flows(solved.summary(&film.state, &film.reaction));
        summary.peak_film_pressure.angle += turned;
        summary.complementarity_violation = film.complementarity_violation();
        summary.cell_residual = film.cell_residual(self.closure.as_ref());
        summary.iterations = film.iterations;
        let sliding = (film.state.journal_speed - film.state.shell_speed).abs();
        summary.reynolds_number = film.density * sliding * film.units.radius * film.units.clearance
            / film.units.viscosity;
        summary
    }

    fn feed_flows(&self) -> &[FeedFlow] {
        &self.film.feed_flows
    }

    fn field(&self) -> Option<FilmField<'_>> {
        let fields = &self.film.fields;
        Some(FilmField {
            angles: &fields.angles,
            axial: &fields.axial,
            pressure: &fields.pressure,
            film_fraction: &fields.film_fraction,
            film_thickness: &fields.film_thickness,
        })
    }

    fn accept_step(&mut self) {
        self.film.iterations = 0;
        if self.closure.conserves_mass() {
            let film = &mut self.film;
            film.content.clear();
            let content = film.film_fraction.iter().zip(&film.gap.mean);
            film.content.extend(content.map(|(theta, h)| theta * h));
        }
    }

    fn reject_step(&mut self) {
        self.film.iterations = 0;
    }

    fn history(&self) -> FilmHistory {
        FilmHistory {
            content: self.film.content.clone(),
        }
    }

    fn restore(&mut self, history: &FilmHistory) {
        self.film.content.clear();
        self.film.content.extend_from_slice(&history.content);
    }
}

impl Film {
    fn new(bearing: &Bearing, lubricant: &Lubricant, grid: &Grid, extent: Extent) -> Self {
        let (n, m) = (grid.n_around(), grid.n_axial());
        let solved: Vec<f64> = grid.axial.iter().map(|z| z * bearing.radius()).collect();
        let axial = extent.unfold_axial(&solved);
        let all = vec![0.0; n * axial.len()];
        let matrix = RingMatrix::new(n, m, bearing.inlet == Inlet::Cyclic);
        let zero = vec![0.0; n * m];
        let around = Around::Periodic;
        Self {
            gap: Gap::for_grid(grid),
            operator: Operator {
                ends_at_mid_plane: extent == Extent::Half,
                ..Operator::for_grid(grid, around, Axial::Air(0.0))
            },
            set: FilmSet::full(n, m),
            factor: RingFactor::new(&matrix),
            matrix,
            fed_by: vec![None; n * m],
            rhs: zero.clone(),
            solution: zero.clone(),
            correction: zero.clone(),
            pressure: zero.clone(),
            film_fraction: zero.clone(),
            excess: zero.clone(),
            flow_scale: 0.0,
            adjoints: vec![[0.0; 4]; n * m],
            content: Vec::with_capacity(n * m),
            old_content: zero.clone(),
            is_warm: false,
            iterations: 0,
            state: JournalState::default(),
            reaction: Reaction::default(),
            units: Units::of(bearing, lubricant.viscosity(373.15, 0.0).value),
            density: 0.0,
            feed_flows: vec![FeedFlow::default(); bearing.feeds.len()],
            fields: Fields {
                angles: grid.around.clone(),
                axial,
                pressure: all.clone(),
                film_fraction: all.clone(),
                film_thickness: all,
            },
        }
    }

    /// Pressure of the film unit for a gauge pressure in Pa.
    fn relative_pressure(&self, bearing: &Bearing, pressure: f64) -> f64 {
        (pressure - bearing.cavitation_pressure) / self.units.pressure
    }

    fn place_feeds(&mut self, bearing: &Bearing, conditions: &Conditions<'_>) {
        let given = conditions.feed_pressures;
        for (index, feed) in bearing.feeds.iter().enumerate() {
            self.feed_flows[index].pressure = given
                .and_then(|p| p.get(index))
                .map_or(feed.pressure, |p| *p);
        }
        for k in 0..self.fed_by.len() {
            match (self.fed_by[k], self.set.cells[k]) {
                (Some(feed), _) => {
                    self.set.cells[k] = Cell::Fed;
                    self.set.fed_pressure[k] =
                        self.relative_pressure(bearing, self.feed_flows[feed].pressure);
                }
                // The feed moved on and left a full film.
                (None, Cell::Fed) => self.set.cells[k] = Cell::Full,
                _ => {}
            }
        }
    }

    fn place_boundaries(&mut self, bearing: &Bearing) {
        let ambient = self.relative_pressure(bearing, bearing.ambient_pressure);
        self.operator.axial = match bearing.ends {
            Ends::Air => Axial::Air(ambient),
            Ends::Flooded => Axial::Bath(ambient),
        };
        self.operator.around = match bearing.inlet {
            Inlet::Cyclic => Around::Periodic,
            Inlet::MaxFilmLine { pressure } => {
                Around::Pressures([self.relative_pressure(bearing, pressure); 2])
            }
        };
    }

    /// Content at the start of an implicit step: the accepted one, or, at the very first step, the
    /// full film of the position that the step came from.
    fn take_old_content(&mut self, step: Step) {
        let Step::Implicit { duration } = step else {
            return;
        };
        if self.content.len() == self.old_content.len() {
            self.old_content.copy_from_slice(&self.content);
        } else {
            let gaps = self.gap.mean.iter().zip(&self.gap.rate);
            for (old, (mean, rate)) in self.old_content.iter_mut().zip(gaps) {
                *old = mean - rate * duration;
            }
        }
    }

    /// Stage 4: solves the equations of the present set. `false` where they determine no film.
    fn solve(&mut self, closure: &dyn CavitationModel) -> bool {
        closure.admit_set(&self.operator, &mut self.set);
        closure.assemble(&self.operator, &self.set, &mut self.matrix, &mut self.rhs);
        if !self.factor.factor(&self.matrix) {
            return false;
        }
        self.solution.copy_from_slice(&self.rhs);
        self.factor.solve(&mut self.solution);
        self.refine();
        self.snap_round_off();
        closure.fields(
            &self.set,
            &self.solution,
            &mut self.pressure,
            &mut self.film_fraction,
        );
        self.flow_scale =
            self.operator
                .balance(&self.pressure, &self.film_fraction, &mut self.excess);
        self.solution.iter().all(|x| x.is_finite())
    }

    /// Iterative refinement where elimination left more than round-off of the flows.
    fn refine(&mut self) {
        const LARGEST_RESIDUAL: f64 = 1e-12;
        const STEPS: usize = 2;
        let bound = LARGEST_RESIDUAL * self.flow_unit();
        for _ in 0..STEPS {
            let residual = self
                .matrix
                .residual(&self.solution, &self.rhs, &mut self.correction);
            if residual <= bound {
                return;
            }
            self.factor.solve(&mut self.correction);
            for (x, dx) in self.solution.iter_mut().zip(&self.correction) {
                *x += dx;
            }
        }
    }

    /// Largest flow that drives the film: dragged along, stored or released, 1/s.
    fn flow_unit(&self) -> f64 {
        let operator = &self.operator;
        let dragged = operator
            .transport
            .iter()
            .fold(0.0_f64, |a, b| a.max(b.abs()));
        let stored = operator.storage.iter().zip(&operator.stored);
        stored.fold(dragged, |a, (new, old)| a.max((new - old).abs()))
    }

    /// Puts values that round-off alone keeps beyond their bound onto the bound, so that it decides
    /// no cell: both conditions hold with equality there.
    fn snap_round_off(&mut self) {
        let scale = ROUND_OFF * self.flow_unit();
        for (k, x) in self.solution.iter_mut().enumerate() {
            let weight = self.matrix.centre[k];
            match self.set.cells[k] {
                Cell::Full if *x < 0.0 && -*x * weight <= scale => *x = 0.0,
                Cell::Ruptured if *x > 1.0 && (*x - 1.0) * weight <= scale => *x = 1.0,
                Cell::Ruptured if *x < 0.0 && -*x * weight <= scale => *x = 0.0,
                _ => {}
            }
        }
    }

    fn account_feeds(&mut self, extent: Extent) {
        for feed in &mut self.feed_flows {
            feed.flow = 0.0;
        }
        for (k, feed) in self.fed_by.iter().enumerate() {
            if let Some(feed) = feed {
                self.feed_flows[*feed].flow -= extent.images() * self.excess[k] * self.units.flow;
            }
        }
    }

    fn advance_set(&mut self, closure: &dyn CavitationModel) -> usize {
        closure.update_set(
            &self.operator,
            &self.pressure,
            &self.film_fraction,
            &self.excess,
            ROUND_OFF * self.flow_scale,
            &mut self.set,
        )
    }

    fn write_fields(&mut self, bearing: &Bearing, grid: &Grid, extent: Extent, turned: f64) {
        let fields = &mut self.fields;
        for (angle, local) in fields.angles.iter_mut().zip(&grid.around) {
            *angle = local + turned;
        }
        let m = grid.n_axial();
        let units = &self.units;
        let pressure = |k: usize| self.pressure[k] * units.pressure + bearing.cavitation_pressure;
        extent.unfold(m, pressure, &mut fields.pressure);
        extent.unfold(m, |k| self.film_fraction[k], &mut fields.film_fraction);
        let thickness = |k: usize| self.gap.mean[k] * units.clearance;
        extent.unfold(m, thickness, &mut fields.film_thickness);
    }

    fn complementarity_violation(&self) -> f64 {
        let peak = self
            .pressure
            .iter()
            .fold(f64::MIN_POSITIVE, |a, b| a.max(*b));
        let fields = self.pressure.iter().zip(&self.film_fraction);
        fields.fold(0.0_f64, |worst, (p, theta)| {
            let both = (p / peak).min(1.0 - theta);
            worst.max(-p / peak).max(theta - 1.0).max(-theta).max(both)
        })
    }

    /// Largest imbalance of a cell whose equation is a balance, over the largest flow.
    fn cell_residual(&self, closure: &dyn CavitationModel) -> f64 {
        let worst = self.excess.iter().zip(&self.set.cells).fold(
            0.0_f64,
            |worst, (excess, cell)| match cell {
                Cell::Full => worst.max(excess.abs()),
                Cell::Ruptured if closure.conserves_mass() => worst.max(excess.abs()),
                _ => worst,
            },
        );
        // Where nothing flows, round-off of the pressures is all there is to compare with.
        let conductance = self.operator.conductance_around.iter();
        let gross = conductance.fold(0.0_f64, |a, b| a.max(*b))
            * self.pressure.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        if self.flow_scale > ROUND_OFF * gross {
            worst / self.flow_scale
        } else {
            0.0
        }
    }
}

/// How time enters for a closure: only one that transports film content stores it.
fn film_storage<'a>(closure: &dyn CavitationModel, step: Step, old: &'a [f64]) -> Storage<'a> {
    match step {
        Step::Implicit { duration } if closure.conserves_mass() => Storage::Step { duration, old },
        _ => Storage::Rate,
    }
}
