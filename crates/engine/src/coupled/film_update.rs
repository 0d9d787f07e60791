//! The films of all journals, and their updates, which may run side by side.

use super::CoupledJournal;
use sommerfeld_bearing::motion::{Coordinates, length, with_motion};
use sommerfeld_bearing::{CycleTable, SupplyCycle};
use sommerfeld_film::{Bearing, Conditions, FilmError, FilmForce, JournalState, Linearised, Step};

/// One update of one film. Those of different journals touch nothing in common.
pub struct FilmUpdate<'u> {
    film: &'u mut (dyn FilmForce + Send + 'u),
    state: JournalState,
    step: Step,
    conditions: Conditions<'u>,
    answer: Option<Result<Linearised, FilmError>>,
}

impl FilmUpdate<'_> {
    /// Updates the film.
    pub fn run(&mut self) {
        self.answer = Some(
            self.film
                .linearise(&self.state, self.step, &self.conditions),
        );
    }

    /// What the film answered.
    fn answer(mut self) -> Result<Linearised, FilmError> {
        if self.answer.is_none() {
            self.run();
        }
        self.answer
            .unwrap_or(Err(FilmError::NotFinite { name: "film" }))
    }
}

/// Runs the updates it is given, in any order, on any threads: they do not depend on each other.
pub type FilmExecutor<'a> = dyn Fn(&mut [FilmUpdate<'_>]) + 'a;

/// The executor that runs one update after the other.
pub fn in_sequence(updates: &mut [FilmUpdate<'_>]) {
    updates.iter_mut().for_each(FilmUpdate::run);
}

/// A journal in its bearing.
pub(super) struct Place<'a> {
    pub film: &'a mut (dyn FilmForce + Send + 'a),
    pub bearing: &'a Bearing,
    pub table: CycleTable<'a>,
    pub supply: SupplyCycle<'a>,
    /// The film answers to tilt.
    pub with_tilt: bool,
    /// Half the bearing width, m.
    pub arm: f64,
    /// Where the bore lies against the common line, m.
    pub offset: [f64; 2],
    /// Film updates so far.
    pub film_solves: usize,
}

impl<'a> Place<'a> {
    pub(super) fn new(journal: CoupledJournal<'a>) -> Result<Self, FilmError> {
        if !(journal.bearing.width.is_finite() && journal.bearing.width > 0.0) {
            return Err(FilmError::Unsupported {
                reason: "the bearing width must be positive",
            });
        }
        let table = CycleTable::new(journal.duty)?;
        Ok(Self {
            supply: SupplyCycle::new(journal.bearing, journal.duty, &journal.conditions)?,
            with_tilt: journal.film.capabilities().accepts_tilt,
            arm: 0.5 * journal.bearing.width,
            film: journal.film,
            bearing: journal.bearing,
            table,
            offset: journal.offset,
            film_solves: 0,
        })
    }

    /// What the film sees of coordinates or rates.
    pub(super) fn seen(&self, coordinates: Coordinates) -> Coordinates {
        let [x, y, tilt_x, tilt_y] = coordinates;
        if self.with_tilt {
            [x, y, tilt_x, tilt_y]
        } else {
            [x, y, 0.0, 0.0]
        }
    }

    /// The journal's state at a crank angle, as the film sees it.
    pub(super) fn state(
        &self,
        crank_angle: f64,
        position: Coordinates,
        rate: Coordinates,
    ) -> JournalState {
        let frame = self.table.frame(crank_angle);
        with_motion(&frame, self.seen(position), self.seen(rate))
    }

    /// Smallest gap at a position, m. Speeds and rates do not change it.
    pub(super) fn gap(&self, crank_angle: f64, position: Coordinates) -> f64 {
        self.film
            .minimum_gap(&self.state(crank_angle, position, [0.0; 4]))
    }

    /// Size of a displacement as far as the film sees it, m.
    pub(super) fn length(&self, displacement: Coordinates) -> f64 {
        length(self.seen(displacement), self.arm)
    }

    /// The film's update at a state.
    pub(super) fn update(
        &mut self,
        state: JournalState,
        step: Step,
        crank_angle: f64,
    ) -> FilmUpdate<'_> {
        self.film_solves += 1;
        FilmUpdate {
            film: &mut *self.film,
            state,
            step,
            conditions: self.supply.at(crank_angle),
            answer: None,
        }
    }
}

/// Runs updates and collects their answers in order.
pub(super) fn answers(
    mut updates: Vec<FilmUpdate<'_>>,
    executor: &FilmExecutor<'_>,
) -> Vec<Result<Linearised, FilmError>> {
    executor(&mut updates);
    updates.into_iter().map(FilmUpdate::answer).collect()
}
