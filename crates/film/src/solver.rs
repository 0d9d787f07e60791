//! The film of one bearing at one instant, by finite volumes and active sets.
//!
//! The stages of [`FilmSolver::linearise`]:
//! 1. gap: where the journal is, how thick the film
//! 2. supply: which cells a groove or hole keeps at its pressure
//! 3. operator: what conducts, what is dragged along, what is stored
//! 4. cavitation: the equations of the present set, solved directly, bordered by the feeds whose line
//!    resists
//! 5. the next set; where it differs in a few cells of known pressure the film follows it on the same
//!    factors, else it waits for the next update; unchanged means settled
//! 6. integrals: force, moment, torques; tangents by adjoints on the same factors

use crate::bearing::{Bearing, Cavitation, Ends, Inlet};
use crate::cavitation::{CavitationModel, FilmSet, model_of};
use crate::energy::Surroundings;
use crate::film_state::FilmState;
use crate::finish::Finish;
use crate::force::{
    Capabilities, Conditions, FeedFlow, FilmError, FilmField, FilmForce, FilmHistory, FilmSummary,
    Linearised, Outcome, Step, Tangent, Warming,
};
use crate::frame::Frame;
use crate::gap::AngleTables;
use crate::grid::Grid;
use crate::integrals::{SolvedFilm, Units, relative_motion};
use crate::journal_state::JournalState;
use crate::mirror::{Extent, half_of};
use crate::narrowest::GapSearch;
use crate::passage::{Passage, PassageState};
use crate::reduced_pressure::ReducedPressure;
use crate::reynolds::{Cell, Storage};
use crate::supply::mark_fed_cells;
use crate::surfaces::Surfaces;
use sommerfeld_oil::{Lubricant, ShearThinning};

mod start;
mod warmth;

/// A film solved on a grid: the [`FilmForce`] with fields.
pub struct FilmSolver {
    bearing: Bearing,
    lubricant: Lubricant,
    closure: Box<dyn CavitationModel>,
    frame: Frame,
    extent: Extent,
    grid: Grid,
    angles: AngleTables,
    surfaces: Surfaces,
    search: GapSearch,
    film: FilmState,
    /// The same bearing on half the cells: where a cold start gets its set from.
    coarse: Option<Box<FilmSolver>>,
}

/// What an update is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Wanted {
    Reaction,
    Tangent,
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
        Self::following_on(bearing, lubricant, grid, Extent::Whole)
    }

    /// The same on any grid from angle -pi to pi, over all of the width or, for a journal that stays aligned,
    /// over the half that [`half_of`] makes of it.
    ///
    /// # Errors
    /// As [`FilmSolver::following`].
    pub fn following_on(
        bearing: &Bearing,
        lubricant: &Lubricant,
        grid: Grid,
        extent: Extent,
    ) -> Result<Self, FilmError> {
        Self::on_grid(bearing, lubricant, grid, Frame::LineOfCentres, extent)
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
        let is_round = !bearing.bore.varies_around() && !bearing.journal.varies_around();
        if frame == Frame::LineOfCentres && !is_round {
            return Err(FilmError::Unsupported {
                reason: "a bore or journal that is not round needs inlet = \"cyclic\": a grid that \
                         follows the line of centres cannot hold it",
            });
        }
        if bearing.journal.has_steps() {
            return Err(FilmError::Unsupported {
                reason: "a journal has no offset halves: its steps would turn through the cells",
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
        let factors = bearing.finish.flow_factors();
        let factors = factors.map_err(|_| FilmError::Unsupported {
            reason: "the roughness of the surfaces is outside what flow factors are known for",
        })?;
        if factors.is_some() && bearing.bore.has_steps() {
            return Err(FilmError::Unsupported {
                reason: "rough surfaces need a bore without steps: no offset halves",
            });
        }
        let thins = lubricant.shear_thinning != ShearThinning::None;
        let film = FilmState {
            passage: Passage::new(&grid, factors, thins, false),
            ..FilmState::new(bearing, lubricant, &grid, extent)
        };
        Ok(Self {
            film,
            bearing: bearing.clone(),
            lubricant: lubricant.clone(),
            closure: model_of(bearing.cavitation),
            frame,
            extent,
            angles,
            surfaces: Surfaces::new(bearing, &grid),
            search: GapSearch::of(bearing),
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
        let least = self.search.narrowest(&self.bearing, state);
        // Rough surfaces leave a mean gap wherever they are, and asperities that carry push back.
        let is_soft = self.bearing.elasticity.compliance() > 0.0;
        if least.gap > 0.0 || self.bearing.finish.has_contact() || is_soft {
            return Ok(());
        }
        Err(FilmError::Contact {
            angle_deg: least.angle.to_degrees(),
            axial_mm: 1e3 * least.axial,
            gap_um: 1e6 * least.gap,
        })
    }

    /// Before an update: what is refused, a film that is not there, the set of a cold film; stages 1 to
    /// 3 at the state.
    fn enter(
        &mut self,
        state: &JournalState,
        step: Step,
        conditions: &Conditions<'_>,
    ) -> Result<Option<Linearised>, FilmError> {
        self.check(state, step)?;
        if step == Step::Steady && self.is_starved() {
            return Ok(Some(Linearised::without_film(Outcome::Starved)));
        }
        if !self.film.is_warm {
            self.start_cold(state, conditions)?;
            self.walk_in(state, conditions)?;
        }
        let turned = self.frame.turn(state);
        self.prepare(&self.frame.to_grid(state, turned), step, conditions);
        self.film.state = *state;
        Ok(None)
    }

    /// Stages 4 to 6 at a state that was entered.
    fn update(&mut self, state: &JournalState, step: Step, wanted: Wanted) -> Linearised {
        let turned = self.frame.turn(state);
        let local = self.frame.to_grid(state, turned);
        self.film.iterations += 1;
        if !self.film.solve(self.closure.as_ref()) {
            self.film.start_anew();
            return Linearised::without_film(Outcome::NoSolution);
        }
        self.film.account_feeds(&self.bearing, self.extent);
        // Else the set moves on after the integrals, which are those of the set that was solved.
        let early = self.film.can_settle(self.closure.as_ref());
        self.film.settling.forget();
        let settled_early = early && self.film.settle(self.closure.as_ref());
        if early {
            self.film.account_feeds(&self.bearing, self.extent);
            self.film.swap_solved_cells();
        }
        let reaction = self.extent.reaction(self.solved().reaction(&local));
        let tangent = match wanted {
            Wanted::Tangent => self.extent.tangent(self.tangent(step)),
            Wanted::Reaction => Tangent::default(),
        };
        let (reaction, tangent) = self.frame.from_grid(&local, turned, reaction, tangent);
        self.film.reaction = reaction;
        self.film
            .write_fields(&self.bearing, &self.grid, self.extent, turned);
        let settled = if early {
            self.film.swap_solved_cells();
            settled_early
        } else {
            self.film.advance_set(self.closure.as_ref()) == 0 && !self.film.is_bending
        };
        if settled && !self.film.expansion.displacement.is_empty() {
            self.rest_in_its_gap(&local, step);
            self.film
                .write_fields(&self.bearing, &self.grid, self.extent, turned);
        }
        Linearised {
            reaction,
            tangent,
            settled,
            outcome: if settled && self.film.exceeds_limit {
                Outcome::NoSolution
            } else if settled && !self.keeps_conditions() {
                Outcome::NotConverged
            } else {
                Outcome::Converged
            },
        }
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
        if film.reduced_at != temperature {
            film.reduced = ReducedPressure::of(&self.lubricant, temperature);
            film.reduced_at = temperature;
        }
        self.open_gap(state);
        let film = &mut self.film;
        mark_fed_cells(
            &self.bearing,
            &self.grid,
            state,
            &mut film.fed_by,
            &mut film.lines.pocket,
        );
        film.place_feeds(&self.bearing, self.extent, conditions);

        film.place_boundaries(&self.bearing);
        film.take_old_content(step);
        self.fill_operator(state, step);
    }

    /// Stage 1: the gap of the rigid shapes, opened by the displacement of the last solution.
    fn open_gap(&mut self, state: &JournalState) {
        let film = &mut self.film;
        let (position, rate) = relative_motion(&self.bearing, state);
        self.angles
            .fill_gap(&self.grid, &position, &rate, &mut film.gap);
        self.surfaces.turn_to(&self.bearing, &self.grid, state);
        self.surfaces.add_to(&self.grid, state, &mut film.gap);
        film.press_back();
        film.give_way();
        let is_ring = self.bearing.inlet == Inlet::Cyclic;
        let ends = film.end_opening(&self.bearing);
        film.expansion
            .open(&mut film.gap, self.grid.n_axial(), ends, is_ring);
        if let Some(passage) = &mut film.passage {
            let around = PassageState {
                grid: &self.grid,
                oil: &self.lubricant,
                temperature: film.reduced_at,
                field: film.temperature.as_deref(),
                clearance: film.units.clearance,
                radius: film.units.radius,
                mean_speed: state.mean_speed(),
                sliding: state.journal_speed - state.shell_speed,
            };
            passage.narrow(&mut film.gap, &around);
        }
        film.touch();
    }

    /// Stage 3: what conducts, what is dragged along, what is stored in that gap.
    fn fill_operator(&mut self, state: &JournalState, step: Step) {
        let film = &mut self.film;
        let storage = film_storage(self.closure.as_ref(), step, &film.old_content);
        film.operator
            .update(&self.grid, &film.gap, state.mean_speed(), storage);
        if let Some(passage) = &film.passage {
            passage.amend(&mut film.operator, &self.grid);
        }
        let per_time = match storage {
            Storage::Step { duration, .. } => 1.0 / duration,
            Storage::Rate => 0.0,
        };
        let m = self.grid.n_axial();
        for (k, held) in film.held_per_height.iter_mut().enumerate() {
            *held = per_time * self.grid.area(k / m, k % m);
        }
        film.operator
            .hold_feeds_to_edges(&self.grid, &film.set.cells);
        film.lean(&self.grid);
    }

    /// The gap and the flows of a settled film on a soft shell where its last solution left the shell. That moved by
    /// as little as settled films may, and the equations knew its slopes; but over the duration of a step, and in
    /// gaps that carry many times what leaves at the ends, the gap before would miss more oil than round-off.
    fn rest_in_its_gap(&mut self, state: &JournalState, step: Step) {
        self.open_gap(state);
        self.fill_operator(state, step);
        self.film.balance();
        self.film.account_feeds(&self.bearing, self.extent);
    }

    /// The settled film keeps its conditions: where next to nothing flows, round-off of ill-posed
    /// balances (idle circles of a ruptured film) may leave film fractions that mean nothing.
    fn keeps_conditions(&self) -> bool {
        const LARGEST_VIOLATION: f64 = 1e-6;
        self.closure.cuts_pressures() || self.film.complementarity_violation() <= LARGEST_VIOLATION
    }

    fn solved(&self) -> SolvedFilm<'_> {
        SolvedFilm {
            bearing: &self.bearing,
            grid: &self.grid,
            angles: &self.angles,
            gap: &self.film.gap,
            surfaces: &self.surfaces,
            search: &self.search,
            operator: &self.film.operator,
            set: &self.film.set,
            pressure: &self.film.pressure,
            stiffened: &self.film.stiffened,
            compression: &self.lubricant.density_pressure,
            passage: self.film.passage.as_ref(),
            contact: &self.film.contact,
            yielding: &self.film.yielding,
            film_fraction: &self.film.film_fraction,
            held: self.film.held(),
            excess: &self.film.excess,
            units: self.film.units,
        }
    }

    /// Tangents at the set of the last solution.
    fn tangent(&mut self, step: Step) -> Tangent {
        match self.extent {
            Extent::Whole => self.tangent_of::<4>(step),
            Extent::Half => self.tangent_of::<2>(step),
        }
    }

    /// The same of as many outputs as the extent has.
    fn tangent_of<const L: usize>(&mut self, step: Step) -> Tangent {
        let mut store = std::mem::take(&mut self.film.adjoints);
        let (adjoints, _) = store.as_chunks_mut::<L>();
        let solved = self.solved();
        let closure = self.closure.as_ref();
        let (lines, fed_by) = (&self.film.lines, &self.film.fed_by);
        solved.output_weights(
            |k| match solved.set.cells[k] {
                Cell::Fed => lines.answers(fed_by, k),
                _ => closure.loaded(solved.set, &self.film.solution, k),
            },
            adjoints,
        );
        if lines.has_unknowns() {
            self.film.lines.close_adjoints(adjoints);
        }
        self.film.factor.solve_transposed(adjoints);
        self.film
            .settling
            .correct_adjoints(&self.film.operator, adjoints, |k| {
                let solved = self.solved();
                let stiffening = solved.stiffening(k);
                solved.output_weight(k).map(|weight| weight * stiffening)
            });
        // Known cells have no balance that could answer; those of a feed behind a line share one.
        for (k, adjoint) in adjoints.iter_mut().enumerate() {
            match self.film.set.cells[k] {
                Cell::Fed => *adjoint = self.film.lines.multiplier(&self.film.fed_by, k),
                Cell::Ruptured if !closure.conserves_mass() => *adjoint = [0.0; L],
                _ => {}
            }
        }
        let storage = film_storage(closure, step, &self.film.old_content);
        let solved = SolvedFilm {
            pressure: closure.equation_pressure(&self.film.solution, &self.film.pressure),
            ..self.solved()
        };
        let tangent = solved.tangent(adjoints, storage);
        self.film.adjoints = store;
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
        let nominal = self.search.narrowest(&self.bearing, state).gap;
        // What a soft shell gives way under a pressure that bearings have.
        let give = 2e7 * self.bearing.elasticity.compliance();
        match &self.bearing.finish {
            Finish::Rough(rough) if rough.contact.is_on() && give == 0.0 => {
                softened(nominal, rough.roughness.composite())
            }
            finish if give > 0.0 => yielded(nominal, give.max(finish.composite_roughness())),
            _ => nominal,
        }
    }

    fn linearise(
        &mut self,
        state: &JournalState,
        step: Step,
        conditions: &Conditions<'_>,
    ) -> Result<Linearised, FilmError> {
        if let Some(without) = self.enter(state, step, conditions)? {
            return Ok(without);
        }
        Ok(self.update(state, step, Wanted::Tangent))
    }

    fn look(
        &mut self,
        state: &JournalState,
        step: Step,
        conditions: &Conditions<'_>,
    ) -> Result<(Linearised, usize), FilmError> {
        if let Some(without) = self.enter(state, step, conditions)? {
            return Ok((without, 1));
        }
        let mut updates = 1;
        let mut seen = self.update(state, step, Wanted::Reaction);
        while !seen.settled && seen.outcome == Outcome::Converged {
            if updates == self.capabilities().iteration_limit {
                seen.outcome = Outcome::NotConverged;
                break;
            }
            if self.film.expansion.displacement.is_empty() {
                // What the film left its feeds may have changed.
                self.film
                    .place_feeds(&self.bearing, self.extent, conditions);
            } else {
                // A shell that gave way has another gap, about which the film is linearised.
                let turned = self.frame.turn(state);
                self.prepare(&self.frame.to_grid(state, turned), step, conditions);
            }
            seen = self.update(state, step, Wanted::Reaction);
            updates += 1;
        }
        Ok((seen, updates))
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
        Some(self.film.fields.view())
    }

    fn account_heat(&mut self, duration: f64) {
        self.add_to_account(duration);
    }

    fn led_to(&mut self, surroundings: &Surroundings<'_>, foresees: bool) -> Option<Warming> {
        self.temperatures_led_to(surroundings, foresees)
    }

    fn warm(&mut self, cells: &[f64]) {
        self.take_temperatures(cells);
    }

    fn coarser(&mut self) -> Option<&mut dyn FilmForce> {
        let coarse = self.coarse.as_deref_mut()?;
        Some(coarse)
    }

    fn take_over(&mut self) {
        self.take_coarse_set();
        self.take_coarse_temperatures();
    }

    fn accept_step(&mut self) {
        self.film.iterations = 0;
        if self.closure.conserves_mass() {
            self.film.keep_content();
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

    fn instant(&self) -> FilmHistory {
        let content = self.film.held().iter().zip(&self.film.gap.mean);
        FilmHistory {
            content: if self.closure.conserves_mass() {
                content.map(|(theta, gap)| theta * gap).collect()
            } else {
                Vec::new()
            },
        }
    }

    fn restore(&mut self, history: &FilmHistory) {
        self.film.content.clear();
        self.film.content.extend_from_slice(&history.content);
    }
}

/// Room between rough surfaces (m) at a nominal gap: the gap where it is wide, a positive rest where the
/// surfaces overlap, so that steps measured in it neither stop nor jump at contact.
fn softened(nominal: f64, sigma: f64) -> f64 {
    let over = nominal / sigma;
    if over > 30.0 {
        nominal
    } else {
        sigma * over.exp().ln_1p()
    }
}

/// The same where the shell gives way, by as much as the shapes overlap: the film between them thins with the
/// load as a power of it, not by powers of e.
fn yielded(nominal: f64, give: f64) -> f64 {
    let root = nominal.hypot(2.0 * give);
    if nominal > 0.0 {
        0.5 * (nominal + root)
    } else {
        2.0 * give * give / (root - nominal)
    }
}

/// How time enters for a closure: only one that transports film content stores it.
fn film_storage<'a>(closure: &dyn CavitationModel, step: Step, old: &'a [f64]) -> Storage<'a> {
    match step {
        Step::Implicit { duration, after } if closure.conserves_mass() => Storage::Step {
            duration,
            after,
            old,
        },
        _ => Storage::Rate,
    }
}
