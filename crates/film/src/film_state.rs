//! Everything of a film that changes from call to call: set, fields, history and scratch, made once
//! and reused as a warm start. [`crate::solver`] says in which order its stages run.

use crate::bearing::{Bearing, Ends, Inlet};
use crate::cavitation::{CavitationModel, FilmSet};
use crate::energy::HeatAccount;
use crate::feed_lines::FeedLines;
use crate::finish::Finish;
use crate::force::{Conditions, FeedFlow, FilmField, Reaction, Step};
use crate::gap::Gap;
use crate::grid::Grid;
use crate::heat::FilmHeat;
use crate::integrals::Units;
use crate::journal_state::JournalState;
use crate::linear::{RingFactor, RingMatrix};
use crate::mirror::Extent;
use crate::nonlinear::{Expansion, FilmEquations};
use crate::passage::Passage;
use crate::reduced_pressure::ReducedPressure;
use crate::reynolds::{Around, Axial, Cell, Operator};
use crate::settling::Settling;
use sommerfeld_oil::{CompressionLaw, Lubricant};

mod expansion;

/// Flow below this share of the largest is round-off of the direct solution.
const ROUND_OFF: f64 = 1e-12;

/// Everything that changes from call to call.
pub(crate) struct FilmState {
    pub(crate) gap: Gap,
    pub(crate) operator: Operator,
    pub(crate) set: FilmSet,
    pub(crate) matrix: RingMatrix,
    pub(crate) factor: RingFactor,
    pub(crate) fed_by: Vec<Option<usize>>,
    pub(crate) lines: FeedLines,
    /// Flow into the film by the cells of each feed, 1/s.
    pub(crate) film_flows: Vec<f64>,
    pub(crate) rhs: Vec<f64>,
    pub(crate) solution: Vec<f64>,
    pub(crate) correction: Vec<f64>,
    /// Reduced pressure per cell, 1/s: what drives the flows.
    pub(crate) pressure: Vec<f64>,
    /// Pressure per cell, 1/s, and its derivative by the reduced one, where they differ.
    pub(crate) stiffened: Vec<[f64; 2]>,
    /// About what density and displacement are linearised, and the content of cells then.
    pub(crate) expansion: Expansion,
    /// Flow into store per H, 1/s, per cell; 0 without a step.
    pub(crate) held_per_height: Vec<f64>,
    /// Density and displacement changed by more than round-off in the last solution.
    pub(crate) is_bending: bool,
    /// Cells that do not go all the way to their new pressure, and the reduced pressure (1/s) they go to.
    pub(crate) turned_back: Vec<(usize, f64)>,
    /// Nominal H of the last solution on a soft shell, else empty.
    pub(crate) last_height: Vec<f64>,
    /// The same of the rigid shapes alone.
    pub(crate) rigid_height: Vec<f64>,
    /// What the gap lets through, where it is not smooth or its oil not the same everywhere.
    pub(crate) passage: Option<Passage>,
    /// Contact pressure per cell, 1/s, and its derivative by the H of the rigid shapes; empty without
    /// contact.
    pub(crate) contact: Vec<[f64; 2]>,
    /// Where asperities press on a soft shell, per cell: by how much the gap falls as that of the rigid
    /// shapes does; else empty.
    pub(crate) yielding: Vec<f64>,
    pub(crate) finish: Finish,
    /// Relation of pressure and reduced pressure at the film's temperature (K).
    pub(crate) reduced: ReducedPressure,
    pub(crate) reduced_at: f64,
    /// A cell asks for more than the limit of the reduced pressure.
    pub(crate) exceeds_limit: bool,
    pub(crate) film_fraction: Vec<f64>,
    pub(crate) excess: Vec<f64>,
    /// Largest flow of the last balance, 1/s.
    pub(crate) flow_scale: f64,
    /// Adjoints of force and moment, per cell as many as the extent has outputs.
    pub(crate) adjoints: Vec<f64>,
    /// States of the cells that the fields belong to, while the set has moved on.
    pub(crate) solved_cells: Vec<Cell>,
    pub(crate) settling: Settling,
    /// Content theta H at the last accepted step; empty before the first.
    pub(crate) content: Vec<f64>,
    /// Content that an implicit step starts from.
    pub(crate) old_content: Vec<f64>,
    /// Time from the last state to the end of its step, s.
    pub(crate) after: f64,
    pub(crate) is_warm: bool,
    pub(crate) iterations: usize,
    pub(crate) state: JournalState,
    pub(crate) reaction: Reaction,
    pub(crate) units: Units,
    pub(crate) compression: CompressionLaw,
    /// Of the shell, m/Pa.
    pub(crate) compliance: f64,
    pub(crate) density: f64,
    pub(crate) feed_flows: Vec<FeedFlow>,
    pub(crate) fields: Fields,
    /// Temperature per cell, K, where it is a field.
    pub(crate) temperature: Option<Vec<f64>>,
    pub(crate) account: Option<HeatAccount>,
    pub(crate) heat: FilmHeat,
}

/// The fields in SI, as the caller sees them.
pub(crate) struct Fields {
    pub(crate) angles: Vec<f64>,
    pub(crate) axial: Vec<f64>,
    angle_widths: Vec<f64>,
    axial_widths: Vec<f64>,
    pub(crate) pressure: Vec<f64>,
    pub(crate) film_fraction: Vec<f64>,
    pub(crate) film_thickness: Vec<f64>,
    pub(crate) temperature: Vec<f64>,
    pub(crate) contact_pressure: Vec<f64>,
}

impl Fields {
    pub(crate) fn view(&self) -> FilmField<'_> {
        FilmField {
            angles: &self.angles,
            axial: &self.axial,
            angle_widths: &self.angle_widths,
            axial_widths: &self.axial_widths,
            pressure: &self.pressure,
            film_fraction: &self.film_fraction,
            film_thickness: &self.film_thickness,
            temperature: &self.temperature,
            contact_pressure: &self.contact_pressure,
        }
    }
}

impl FilmState {
    pub(crate) fn new(
        bearing: &Bearing,
        lubricant: &Lubricant,
        grid: &Grid,
        extent: Extent,
    ) -> Self {
        let (n, m) = (grid.n_around(), grid.n_axial());
        let solved: Vec<f64> = grid.axial.iter().map(|z| z * bearing.radius()).collect();
        let axial = extent.unfold_axial(&solved);
        let all = vec![0.0; n * axial.len()];
        let mut axial_widths = vec![0.0; axial.len()];
        let width = |j: usize| grid.axial_widths[j] * bearing.radius();
        extent.unfold(m, width, &mut axial_widths);
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
            lines: FeedLines::new(bearing, n * m),
            film_flows: vec![0.0; bearing.feeds.len()],
            rhs: zero.clone(),
            solution: zero.clone(),
            correction: zero.clone(),
            pressure: zero.clone(),
            stiffened: Vec::new(),
            expansion: Expansion::new(
                n * m,
                lubricant.density_pressure != CompressionLaw::None,
                bearing.elasticity.compliance() > 0.0,
            ),
            held_per_height: zero.clone(),
            is_bending: false,
            turned_back: Vec::new(),
            rigid_height: Vec::new(),
            last_height: if bearing.elasticity.compliance() > 0.0 {
                vec![1.0; n * m]
            } else {
                Vec::new()
            },
            passage: None,
            contact: Vec::new(),
            yielding: Vec::new(),
            finish: bearing.finish.clone(),
            reduced: ReducedPressure::Same,
            reduced_at: f64::NAN,
            exceeds_limit: false,
            film_fraction: zero.clone(),
            excess: zero.clone(),
            flow_scale: 0.0,
            adjoints: vec![0.0; extent.outputs() * n * m],
            solved_cells: vec![Cell::Full; n * m],
            settling: Settling::new(n * m),
            content: Vec::with_capacity(n * m),
            old_content: zero.clone(),
            after: 0.0,
            is_warm: false,
            iterations: 0,
            state: JournalState::default(),
            reaction: Reaction::default(),
            units: Units::of(bearing, lubricant.viscosity(373.15, 0.0).value),
            compression: lubricant.density_pressure,
            compliance: bearing.elasticity.compliance(),
            density: 0.0,
            feed_flows: vec![FeedFlow::default(); bearing.feeds.len()],
            fields: Fields {
                angles: grid.around.clone(),
                axial,
                angle_widths: grid.around_widths.clone(),
                axial_widths,
                pressure: all.clone(),
                film_fraction: all.clone(),
                film_thickness: all,
                temperature: Vec::new(),
                contact_pressure: Vec::new(),
            },
            temperature: None,
            account: None,
            heat: FilmHeat::default(),
        }
    }

    /// Reduced pressure of the film unit for a gauge pressure in Pa.
    fn relative_pressure(&self, bearing: &Bearing, pressure: f64) -> f64 {
        self.reduced.reduced(pressure - bearing.cavitation_pressure) / self.units.pressure
    }

    /// Contact pressure of every cell between rough surfaces.
    pub(crate) fn touch(&mut self) {
        if !self.finish.has_contact() {
            return;
        }
        let (clearance, unit) = (self.units.clearance, self.units.pressure);
        let nominal = self.passage.as_ref().map_or(&self.gap.mean, |p| &p.height);
        self.contact.resize(nominal.len(), [0.0; 2]);
        for (contact, height) in self.contact.iter_mut().zip(nominal) {
            let pressure = self.finish.contact_pressure(height * clearance);
            *contact = [pressure.value / unit, pressure.by_gap * clearance / unit];
        }
        for (contact, yielding) in self.contact.iter_mut().zip(&self.yielding) {
            contact[1] *= yielding;
        }
    }

    pub(crate) fn place_feeds(
        &mut self,
        bearing: &Bearing,
        extent: Extent,
        conditions: &Conditions<'_>,
    ) {
        let given = conditions.feed_pressures;
        let per_flow = extent.images() * self.units.flow / self.units.pressure;
        for (index, feed) in bearing.feeds.iter().enumerate() {
            let pressure = given
                .and_then(|p| p.get(index))
                .map_or(feed.pressure, |p| *p);
            let supply = self.relative_pressure(bearing, pressure);
            let resistance = feed.line.resistance() * per_flow;
            self.lines.set_line(index, supply, resistance);
        }
        self.lines.gather(&self.fed_by, &mut self.set);
        for (cell, feed) in self.set.cells.iter_mut().zip(&self.fed_by) {
            match (feed, *cell) {
                (Some(_), _) => *cell = Cell::Fed,
                // The feed moved on and left its cell.
                (None, Cell::Fed) => *cell = Cell::Full,
                _ => {}
            }
        }
    }

    pub(crate) fn place_boundaries(&mut self, bearing: &Bearing) {
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
    pub(crate) fn take_old_content(&mut self, step: Step) {
        let Step::Implicit { duration, after } = step else {
            self.after = 0.0;
            return;
        };
        self.after = after;
        if self.content.len() == self.old_content.len() {
            self.old_content.copy_from_slice(&self.content);
        } else {
            let gaps = self.gap.mean.iter().zip(&self.gap.rate);
            for (old, (mean, rate)) in self.old_content.iter_mut().zip(gaps) {
                *old = mean - rate * (duration - after);
            }
        }
    }

    /// Stage 4: solves the equations of the present set. `false` where they determine no film.
    pub(crate) fn solve(&mut self, closure: &dyn CavitationModel) -> bool {
        let conserves = closure.conserves_mass();
        closure.admit_set(&self.operator, &mut self.set);
        if !self.last_height.is_empty() {
            let nominal = self.passage.as_ref().map_or(&self.gap.mean, |p| &p.height);
            self.last_height.copy_from_slice(nominal);
            let rigid = nominal.iter().zip(&self.expansion.displacement);
            self.rigid_height.clear();
            self.rigid_height
                .extend(rigid.map(|(height, [displacement, _])| height - displacement));
            self.fill_overlaps();
        }
        self.lines.prepare(&self.operator, &self.fed_by);
        self.lines.fill(&self.fed_by, conserves, &mut self.set);
        self.assemble(closure);
        if !self.factor.factor(&self.matrix) {
            return false;
        }
        self.solution.copy_from_slice(&self.rhs);
        self.factor.solve(&mut self.solution);
        if self.lines.has_unknowns() && !self.solve_lines(closure) {
            return false;
        }
        self.refine();
        self.take_fields(closure);
        if self.lines.has_unknowns() && !closure.cuts_pressures() {
            self.refine_lines(closure);
        }
        self.solution.iter().all(|x| x.is_finite()) && !self.has_lost_its_way()
    }

    /// A compressed oil was linearised at pressures from which no step leads back: far beyond the limit of the
    /// reduced pressure, where neither viscosity nor density means anything.
    fn has_lost_its_way(&self) -> bool {
        const FAR: f64 = 10.0;
        let is_rigid = self.expansion.displacement.is_empty();
        if self.expansion.density.is_empty() || !is_rigid || !self.exceeds_limit {
            return false;
        }
        let farthest = FAR * self.reduced.limit() / self.units.pressure;
        self.pressure.iter().any(|pressure| *pressure > farthest)
    }

    /// Forgets the linearisation of density and displacement that left no solution: it would leave none
    /// anywhere else either.
    pub(crate) fn start_anew(&mut self) {
        if self.expansion.is_linear() {
            return;
        }
        self.pressure.fill(0.0);
        self.solution.fill(0.0);
        self.expansion.forget();
        self.stiffened.fill([0.0, 1.0]);
        self.last_height.fill(1.0);
    }

    /// The same on the balances of feeds behind lines.
    fn refine_lines(&mut self, closure: &dyn CavitationModel) {
        const LARGEST_RESIDUAL: f64 = 1e-12;
        const STEPS: usize = 3;
        let conserves = closure.conserves_mass();
        for _ in 0..STEPS {
            self.sum_film_flows();
            let imbalance = self.lines.imbalance(&self.film_flows, conserves);
            if imbalance <= LARGEST_RESIDUAL * self.flow_scale {
                return;
            }
            self.lines
                .refine(&self.film_flows, &mut self.solution, conserves);
            self.lines.fill(&self.fed_by, conserves, &mut self.set);
            self.take_fields(closure);
        }
    }

    /// Pressure, film fraction and balance of the solution.
    fn take_fields(&mut self, closure: &dyn CavitationModel) {
        self.snap_round_off();
        closure.fields(
            &self.set,
            &self.solution,
            &mut self.pressure,
            &mut self.film_fraction,
        );
        self.expand(closure);
        self.balance();
    }

    /// What enters each cell beyond what leaves it.
    pub(crate) fn balance(&mut self) {
        let held = if self.expansion.density.is_empty() {
            &self.film_fraction
        } else {
            &self.expansion.content
        };
        self.flow_scale = self
            .operator
            .balance(&self.pressure, held, &mut self.excess);
    }

    /// Flow into the film per feed, 1/s.
    fn sum_film_flows(&mut self) {
        self.film_flows.fill(0.0);
        for (excess, feed) in self.excess.iter().zip(&self.fed_by) {
            if let Some(feed) = feed {
                self.film_flows[*feed] -= excess;
            }
        }
    }

    /// Adds what the unknown pressures of feeds behind lines do to the film solved without them.
    fn solve_lines(&mut self, closure: &dyn CavitationModel) -> bool {
        let conserves = closure.conserves_mass();
        let tolerance = ROUND_OFF * self.operator.flow_unit;
        let (operator, set) = (&self.operator, &mut self.set);
        self.lines.assemble(operator, set, &self.fed_by, conserves);
        let (factor, film) = (&mut self.factor, &mut self.solution);
        if !self.lines.close(factor, film, tolerance, conserves) {
            return false;
        }
        self.lines.fill(&self.fed_by, conserves, set);
        self.assemble(closure);
        true
    }

    /// The equations of the present set.
    fn assemble(&mut self, closure: &dyn CavitationModel) {
        closure.assemble(&self.operator, &self.set, &mut self.matrix, &mut self.rhs);
        let film = FilmEquations {
            operator: &self.operator,
            set: &self.set,
            gap: &self.gap,
            passage: self.passage.as_ref(),
            held_per_height: &self.held_per_height,
            conserves_mass: closure.conserves_mass(),
        };
        self.expansion
            .add_to(&film, &mut self.matrix, &mut self.rhs);
    }

    /// Content per cell over that of a full film without pressure: film fraction times density.
    pub(crate) fn held(&self) -> &[f64] {
        if self.expansion.density.is_empty() {
            &self.film_fraction
        } else {
            &self.expansion.content
        }
    }

    /// Iterative refinement where elimination left more than round-off of the flows.
    fn refine(&mut self) {
        const LARGEST_RESIDUAL: f64 = 1e-12;
        const STEPS: usize = 2;
        let bound = LARGEST_RESIDUAL * self.operator.flow_unit;
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

    /// Puts values that round-off alone keeps beyond their bound onto the bound, so that it decides
    /// no cell: both conditions hold with equality there.
    fn snap_round_off(&mut self) {
        let scale = ROUND_OFF * self.operator.flow_unit;
        for (k, x) in self.solution.iter_mut().enumerate() {
            let weight = self.matrix.centre[k];
            match self.set.cells[k] {
                Cell::Full if *x < 0.0 && -*x * weight <= scale => *x = 0.0,
                Cell::Ruptured if *x > 1.0 && (*x - 1.0) * weight <= scale => *x = 1.0,
                // No film fraction is negative but by round-off, which idle circles magnify.
                Cell::Ruptured if *x < 0.0 && *x > -1e-6 => *x = 0.0,
                _ => {}
            }
        }
    }

    pub(crate) fn account_feeds(&mut self, bearing: &Bearing, extent: Extent) {
        self.sum_film_flows();
        let units = [self.units.pressure, extent.images() * self.units.flow];
        let cavitation = bearing.cavitation_pressure;
        self.lines
            .account(&self.film_flows, units, cavitation, &mut self.feed_flows);
    }

    /// The film of a set that differs in a few cells can be found without another elimination: all
    /// changes are those of pressures.
    pub(crate) fn can_settle(&self, closure: &dyn CavitationModel) -> bool {
        let ends_stay = match self.operator.axial {
            Axial::Air(air) => air <= 0.0 && self.set.end_open.iter().all(|open| *open),
            Axial::Bath(_) | Axial::Closed => true,
        };
        let is_linear = self.expansion.is_linear();
        closure.knows_pressures() && ends_stay && is_linear && !self.lines.has_unknowns()
    }

    /// Moves the set on and the film with it, as far as a few cells carry. `true` if it settled; else the
    /// set is the one to be solved next, and the states of the cells that the film belongs to are kept.
    pub(crate) fn settle(&mut self, closure: &dyn CavitationModel) -> bool {
        const ROUNDS: usize = 3;
        self.settling
            .begin(&self.set.cells, &self.solution, &self.excess);
        for round in 0..=ROUNDS {
            self.solved_cells.copy_from_slice(&self.set.cells);
            if self.advance_set(closure) == 0 {
                return true;
            }
            let is_found = round < ROUNDS
                && self.settling.solve(
                    &self.operator,
                    &mut self.factor,
                    &self.set.cells,
                    &mut self.solution,
                );
            if !is_found {
                return false;
            }
            self.take_fields(closure);
            self.sum_film_flows();
        }
        false
    }

    /// Exchanges the set that is next for the states of the cells that the film belongs to.
    pub(crate) fn swap_solved_cells(&mut self) {
        std::mem::swap(&mut self.set.cells, &mut self.solved_cells);
    }

    pub(crate) fn advance_set(&mut self, closure: &dyn CavitationModel) -> usize {
        let tolerance = ROUND_OFF * self.flow_scale;
        let conserves = closure.conserves_mass();
        let lines = if closure.cuts_pressures() {
            0
        } else {
            self.lines.update(&self.film_flows, tolerance, conserves)
        };
        let is_soft = !self.expansion.displacement.is_empty();
        if is_soft {
            self.solved_cells.copy_from_slice(&self.set.cells);
        }
        let moved = closure.update_set(
            &self.operator,
            &self.pressure,
            &self.film_fraction,
            &self.excess,
            tolerance,
            &mut self.set,
        );
        let before = self.moved_cells();
        if is_soft && self.fill_overlaps() {
            return lines + moved - before + self.moved_cells();
        }
        lines + moved
    }

    /// Cells whose state is another than in the set that was solved.
    fn moved_cells(&self) -> usize {
        let cells = self.set.cells.iter().zip(&self.solved_cells);
        cells.filter(|(now, before)| now != before).count()
    }

    pub(crate) fn write_fields(
        &mut self,
        bearing: &Bearing,
        grid: &Grid,
        extent: Extent,
        turned: f64,
    ) {
        let fields = &mut self.fields;
        for (angle, local) in fields.angles.iter_mut().zip(&grid.around) {
            *angle = local + turned;
        }
        let m = grid.n_axial();
        let units = &self.units;
        let true_pressure = |k: usize| match self.stiffened.get(k) {
            Some([pressure, _]) => *pressure,
            None => self.pressure[k],
        };
        let pressure = |k: usize| true_pressure(k) * units.pressure + bearing.cavitation_pressure;
        extent.unfold(m, pressure, &mut fields.pressure);
        extent.unfold(m, |k| self.film_fraction[k], &mut fields.film_fraction);
        let nominal = self.passage.as_ref().map_or(&self.gap.mean, |p| &p.height);
        let thickness = |k: usize| nominal[k] * units.clearance;
        extent.unfold(m, thickness, &mut fields.film_thickness);
        if !self.contact.is_empty() {
            fields.contact_pressure.resize(fields.pressure.len(), 0.0);
            // Asperities do not reach the ground of a groove.
            let contact = |k: usize| match self.set.cells[k] {
                Cell::Fed => 0.0,
                _ => self.contact[k][0] * units.pressure,
            };
            extent.unfold(m, contact, &mut fields.contact_pressure);
        }
        if let Some(temperature) = &self.temperature {
            fields.temperature.resize(fields.pressure.len(), 0.0);
            extent.unfold(m, |k| temperature[k], &mut fields.temperature);
        }
    }

    pub(crate) fn complementarity_violation(&self) -> f64 {
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
    pub(crate) fn cell_residual(&self, closure: &dyn CavitationModel) -> f64 {
        let conserves = closure.conserves_mass();
        let worst = self.excess.iter().zip(&self.set.cells).fold(
            self.lines.imbalance(&self.film_flows, conserves),
            |worst, (excess, cell)| match cell {
                Cell::Full => worst.max(excess.abs()),
                Cell::Ruptured if conserves => worst.max(excess.abs()),
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

    /// What the last step leaves in the cells becomes the accepted content.
    pub(crate) fn keep_content(&mut self) {
        self.content.clear();
        let gaps = self.gap.mean.iter().zip(&self.gap.rate);
        let held = if self.expansion.density.is_empty() {
            &self.film_fraction
        } else {
            &self.expansion.content
        };
        let content = held.iter().zip(gaps);
        let after = self.after;
        self.content
            .extend(content.map(|(theta, (mean, rate))| theta * (mean + after * rate)));
    }
}
