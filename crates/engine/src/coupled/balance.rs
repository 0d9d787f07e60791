//! Where are the journals when shaft, films and supports balance?
//!
//! Equation: residual `K (d + o - C F) - f - F = 0` ([`super::shaft`]) with the films' forces `F(d, d')`
//! and `d' = (d - anchor)/duration`, an implicit step; at rest the duration is infinite.
//! Unknowns: displacement and tilt of every journal in its shell, scaled, m.
//! Method: Newton with the films' tangents T, `J = K - (K C + 1) T`, dense. Each iteration updates the
//! films that moved since their last update, once; the cavitated sets settle on the way. All journals
//! take the same share of a step, the largest that leaves every gap open: parts of a step would bend
//! the shaft. The last step is so small that the forces follow by their tangents; so the equation of
//! the shaft, and with it the resultant, holds to round-off.
//! Reference: P. Deuflhard, Newton Methods for Nonlinear Problems, Springer 2011, ch. 3.

use super::film_update::{FilmExecutor, Place, answers};
use super::shaft::{Instant, Structure};
use nalgebra::{DMatrix, DVector};
use sommerfeld_bearing::motion::{Coordinates, add};
use sommerfeld_film::{FilmError, JournalState, Linearised, Outcome, Step};
use sommerfeld_flex::JOURNAL_FREEDOMS;

/// A residual this much above the last one sends the step back. Interleaved film updates may raise
/// it for an iteration, so that a strict descent would only cost film updates.
const TOLERATED_GROWTH: f64 = 4.0;

/// Step reductions in a row before the iterate is kept as it is.
const LARGEST_BACKTRACKS: usize = 6;

/// An implicit step of all journals.
pub(super) struct Stage {
    /// Rad.
    pub crank_angle: f64,
    /// Positions to which the rates refer, m and rad.
    pub anchors: Vec<Coordinates>,
    /// s; infinite for journals at rest.
    pub duration: f64,
    /// How the films count time.
    pub step: Step,
}

/// When Newton stops.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// Updates of a film.
    pub iterations: usize,
    /// Residual over the force scale.
    pub residual: f64,
    /// Error of the positions over the smallest gap.
    pub step: f64,
    /// Largest share of the smallest gap that one step may take.
    pub gap_loss: f64,
    /// Take the last step too, without another update of the films, and leave films alone that moved
    /// less than the step tolerance. Not for films with history, whose content belongs to the position
    /// they were asked at.
    pub takes_last_step: bool,
}

impl Limits {
    /// Largest last step over the smallest gap, as for single bearings
    /// (`sommerfeld_bearing`): taken without another update, it leaves an error of the order of its square, or,
    /// where the cavitated set would change on the way, of a share of it.
    fn last_step(&self) -> f64 {
        if self.takes_last_step {
            3.0 * self.step
        } else {
            self.step
        }
    }
}

/// What Newton found.
pub(super) struct Balanced {
    /// m and rad, tilts of films without tilt included.
    pub positions: Vec<Coordinates>,
    /// As the films see them.
    pub states: Vec<JournalState>,
    pub linearised: Vec<Linearised>,
    /// What the shaft puts on each journal: force (N), moment (N m).
    pub loads: Vec<[f64; 4]>,
    /// How far each journal moved since the last update of its film, over its gap.
    pub moved: Vec<f64>,
    pub outcome: Outcome,
}

/// The balance to be found.
pub(super) struct Balance<'b, 'a> {
    pub structure: &'b Structure<'a>,
    pub instant: &'b Instant,
    pub stage: &'b Stage,
    pub force_scale: f64,
    pub limits: Limits,
    pub executor: &'b FilmExecutor<'b>,
}

/// A film as last updated.
#[derive(Clone, Copy)]
pub(super) struct FilmAnswer {
    at: Coordinates,
    gap: f64,
    linearised: Linearised,
    /// Total derivative of force and moment by position and tilt, through the rates too.
    tangent: [[f64; 4]; 4],
}

impl FilmAnswer {
    /// Force and moment at a position near the last update, by the tangent.
    fn force(&self, position: Coordinates) -> [f64; 4] {
        let moved = add(position, -1.0, self.at);
        let ([x, y], [moment_x, moment_y]) = (
            self.linearised.reaction.force(),
            self.linearised.reaction.moment(),
        );
        let mut force = [x, y, moment_x, moment_y];
        for (value, row) in force.iter_mut().zip(self.tangent) {
            *value += row.iter().zip(moved).map(|(t, d)| t * d).sum::<f64>();
        }
        force
    }

    fn moved_to(&self, position: Coordinates) -> Linearised {
        let [x, y, moment_x, moment_y] = self.force(position);
        let mut moved = self.linearised;
        let reaction = &mut moved.reaction;
        reaction.film_force = [x - reaction.contact_force[0], y - reaction.contact_force[1]];
        reaction.film_moment = [
            moment_x - reaction.contact_moment[0],
            moment_y - reaction.contact_moment[1],
        ];
        moved
    }
}

/// Where the iteration stands.
struct Newton {
    positions: Vec<Coordinates>,
    films: Vec<Option<FilmAnswer>>,
    /// Last accepted positions with the step from there and its residual.
    previous: Option<(Vec<Coordinates>, Vec<Coordinates>, f64)>,
    backtracks: usize,
    best: Option<(Vec<Coordinates>, f64)>,
    /// Why the last trial was refused.
    cause: Outcome,
}

impl Balance<'_, '_> {
    fn rate(&self, journal: usize, position: Coordinates) -> Coordinates {
        let moved = add(position, -1.0, self.stage.anchors[journal]);
        moved.map(|value| value / self.stage.duration)
    }

    fn state(&self, place: &Place<'_>, journal: usize, position: Coordinates) -> JournalState {
        place.state(
            self.stage.crank_angle,
            position,
            self.rate(journal, position),
        )
    }

    /// Smallest gap at a position and at the end of its step.
    fn gap(&self, place: &Place<'_>, journal: usize, position: Coordinates) -> f64 {
        let gap = place.gap(self.stage.crank_angle, position);
        match self.stage.step {
            Step::Steady => gap,
            Step::Implicit { after, .. } => {
                let end = add(position, after, self.rate(journal, position));
                gap.min(place.gap(self.stage.crank_angle, end))
            }
        }
    }

    /// Bound of how much a step may change any gap, m: no point of the journal moves further. Saves the
    /// search for the narrowest place, which takes as long as the film where the surfaces have profiles.
    fn reach(&self, place: &Place<'_>, step: Coordinates) -> f64 {
        let [x, y, tilt_x, tilt_y] = place.seen(step);
        let moved = x.hypot(y) + place.arm * tilt_x.hypot(tilt_y);
        match self.stage.step {
            Step::Steady => moved,
            Step::Implicit { after, .. } => moved * (1.0 + after / self.stage.duration),
        }
    }

    /// Largest share (1, 1/2, 1/4, ...) of a step that leaves each smallest gap above
    /// `(1 - gap loss)` of what it is now. Films as last updated save the search for the present gap.
    pub(super) fn allowed_share(
        &self,
        places: &[Place<'_>],
        from: &[Coordinates],
        step: &[Coordinates],
        films: Option<&[FilmAnswer]>,
    ) -> f64 {
        let mut share = 1.0;
        for (journal, place) in places.iter().enumerate() {
            let reach = self.reach(place, step[journal]);
            let known = match self.stage.step {
                Step::Steady => films.map(|films| &films[journal]),
                // The gap at the end of the step is not the film's.
                Step::Implicit { .. } => None,
            };
            if known.is_some_and(|film| {
                let since = self.reach(place, add(place.seen(from[journal]), -1.0, film.at));
                reach <= self.limits.gap_loss * (film.gap - since)
            }) {
                continue;
            }
            let present = self.gap(place, journal, from[journal]);
            if present <= 0.0 {
                // Only a film with soft surfaces gets here: overlap of the rigid shapes is its business.
                continue;
            }
            if reach <= self.limits.gap_loss * present {
                continue;
            }
            let floor = (1.0 - self.limits.gap_loss) * present;
            let is_open = |share: f64| {
                let there = add(from[journal], share, step[journal]);
                self.gap(place, journal, there) >= floor
            };
            for _ in 0..60 {
                if is_open(share) {
                    break;
                }
                share *= 0.5;
            }
        }
        share
    }

    /// Updates the films that moved; the first outcome other than converged, or a refused state.
    fn update_films(
        &self,
        places: &mut [Place<'_>],
        newton: &mut Newton,
    ) -> Result<Outcome, FilmError> {
        let idle = |journal: usize, place: &Place<'_>| {
            newton.films[journal].is_some_and(|film| {
                let here = place.seen(newton.positions[journal]);
                let moved = place.length(add(here, -1.0, film.at));
                let small = if self.limits.takes_last_step {
                    self.limits.last_step() * film.gap.abs()
                } else {
                    0.0
                };
                film.linearised.settled && moved <= small
            })
        };
        let moved: Vec<usize> = (0..places.len())
            .filter(|&journal| !idle(journal, &places[journal]))
            .collect();
        let crank_angle = self.stage.crank_angle;
        let updates = places
            .iter_mut()
            .enumerate()
            .filter(|(journal, _)| moved.binary_search(journal).is_ok())
            .map(|(journal, place)| {
                let state = self.state(place, journal, newton.positions[journal]);
                place.update(state, self.stage.step, crank_angle)
            })
            .collect();
        let found = answers(updates, self.executor);
        let mut outcome = Outcome::Converged;
        for (journal, answer) in moved.into_iter().zip(found) {
            let position = newton.positions[journal];
            newton.films[journal] = None;
            match answer {
                Ok(linearised) => {
                    if linearised.outcome != Outcome::Converged {
                        outcome = linearised.outcome;
                    }
                    let gap = places[journal].gap(crank_angle, position);
                    let at = places[journal].seen(position);
                    newton.films[journal] = Some(self.answer(at, gap, linearised));
                }
                Err(FilmError::Contact { .. } | FilmError::NotFinite { .. }) => {
                    outcome = Outcome::NotConverged;
                }
                Err(error) => return Err(error),
            }
        }
        Ok(outcome)
    }

    fn answer(&self, at: Coordinates, gap: f64, linearised: Linearised) -> FilmAnswer {
        let mut tangent = linearised.tangent.by_position;
        for (row, rates) in tangent.iter_mut().zip(linearised.tangent.by_rate) {
            for (value, rate) in row.iter_mut().zip(rates) {
                *value += rate / self.stage.duration;
            }
        }
        FilmAnswer {
            at,
            gap,
            linearised,
            tangent,
        }
    }

    /// Scaled forces of the films at the present positions, N.
    fn forces(
        &self,
        places: &[Place<'_>],
        films: &[FilmAnswer],
        at: &[Coordinates],
    ) -> DVector<f64> {
        let values = places.iter().zip(films).zip(at);
        let forces = values.flat_map(|((place, film), position)| {
            let [x, y, moment_x, moment_y] = film.force(place.seen(*position));
            [x, y, moment_x / place.arm, moment_y / place.arm]
        });
        DVector::from_iterator(JOURNAL_FREEDOMS * places.len(), forces)
    }

    fn residual(&self, forces: &DVector<f64>, positions: &[Coordinates]) -> DVector<f64> {
        let at = self.structure.scaled(positions);
        let mut residual = &self.instant.stiffness * at - &self.instant.loads - forces;
        if let Some(coupling) = &self.instant.coupling {
            residual -= coupling * forces;
        }
        residual
    }

    /// Newton step, scaled. A film that has run empty on one side does not resist motion that way:
    /// where the step of a moving journal leaves the gap, a resistance is added that lets the residual
    /// move the journal by about half a gap (Levenberg); it fades with the residual.
    fn newton_step(
        &self,
        places: &[Place<'_>],
        films: &[FilmAnswer],
        residual: &DVector<f64>,
    ) -> Option<Vec<Coordinates>> {
        let mut matrix = self.matrix(places, films);
        let plain = self.solved(&matrix, residual);
        if self.stage.duration.is_infinite() {
            return plain;
        }
        let size = residual.norm();
        let mut leaves = false;
        for (journal, (place, film)) in places.iter().zip(films).enumerate() {
            let stays = plain
                .as_ref()
                .is_some_and(|step| place.length(step[journal]) <= film.gap.abs());
            if !stays {
                leaves = true;
                for axis in 0..JOURNAL_FREEDOMS {
                    let freedom = JOURNAL_FREEDOMS * journal + axis;
                    matrix[(freedom, freedom)] += 2.0 * size / film.gap.abs();
                }
            }
        }
        if leaves {
            self.solved(&matrix, residual).or(plain)
        } else {
            plain
        }
    }

    /// `K - (K C + 1) T`, scaled, N/m.
    fn matrix(&self, places: &[Place<'_>], films: &[FilmAnswer]) -> DMatrix<f64> {
        let mut matrix = self.instant.stiffness.clone();
        let size = matrix.nrows();
        for (journal, (place, film)) in places.iter().zip(films).enumerate() {
            let first = JOURNAL_FREEDOMS * journal;
            let scale = [1.0, 1.0, 1.0 / place.arm, 1.0 / place.arm];
            for column in 0..JOURNAL_FREEDOMS {
                for row in 0..JOURNAL_FREEDOMS {
                    let tangent = scale[row] * film.tangent[row][column] * scale[column];
                    matrix[(first + row, first + column)] -= tangent;
                    if let Some(coupling) = &self.instant.coupling {
                        for k in 0..size {
                            matrix[(k, first + column)] -= coupling[(k, first + row)] * tangent;
                        }
                    }
                }
            }
        }
        matrix
    }

    fn solved(&self, matrix: &DMatrix<f64>, residual: &DVector<f64>) -> Option<Vec<Coordinates>> {
        let step = matrix.clone().lu().solve(&-residual)?;
        step.iter()
            .all(|value| value.is_finite())
            .then(|| self.structure.unscaled(&step))
    }

    /// Finds the balance from `start` on.
    ///
    /// # Errors
    /// What a film refuses, except a closed gap, which is `NotConverged`.
    pub(super) fn find(
        &self,
        places: &mut [Place<'_>],
        start: Vec<Coordinates>,
    ) -> Result<Balanced, FilmError> {
        let mut newton = Newton {
            films: vec![None; places.len()],
            positions: start,
            previous: None,
            backtracks: 0,
            best: None,
            cause: Outcome::NotConverged,
        };
        for _ in 0..self.limits.iterations {
            let outcome = self.update_films(places, &mut newton)?;
            let films: Option<Vec<FilmAnswer>> = newton.films.iter().copied().collect();
            let Some(films) = films.filter(|_| outcome == Outcome::Converged) else {
                newton.keep_best(f64::INFINITY);
                if newton.step_back(f64::INFINITY, outcome) {
                    continue;
                }
                break;
            };
            let forces = self.forces(places, &films, &newton.positions);
            let residual = self.residual(&forces, &newton.positions);
            let size = residual.norm() / self.force_scale;
            if newton.step_back(size, Outcome::NotConverged) {
                continue;
            }
            newton.keep_best(size);
            let Some(step) = self.newton_step(places, &films, &residual) else {
                break;
            };
            let relative_step = places
                .iter()
                .zip(&films)
                .zip(&step)
                .map(|((place, film), step)| place.length(*step) / film.gap.abs())
                .fold(0.0, f64::max);
            let settled = films.iter().all(|film| film.linearised.settled);
            if settled && size <= self.limits.residual && relative_step <= self.limits.last_step() {
                return Ok(self.finished(places, &newton.positions, &films, &step));
            }
            let share = self.allowed_share(places, &newton.positions, &step, Some(&films));
            newton.advance(size, step.iter().map(|s| s.map(|v| share * v)).collect());
        }
        self.given_up(places, newton)
    }

    /// The converged positions after their last (tiny) step, the forces moved along by their tangents.
    fn finished(
        &self,
        places: &[Place<'_>],
        positions: &[Coordinates],
        films: &[FilmAnswer],
        step: &[Coordinates],
    ) -> Balanced {
        let ends: Vec<Coordinates> = positions
            .iter()
            .zip(step)
            .map(|(position, step)| add(*position, 1.0, *step))
            .collect();
        let each = || places.iter().zip(films).zip(&ends);
        let loads = each()
            .map(|((place, film), end)| film.force(place.seen(*end)).map(|value| -value))
            .collect();
        let moved = each()
            .map(|((place, film), end)| {
                place.length(add(place.seen(*end), -1.0, film.at)) / film.gap.abs()
            })
            .collect();
        let (positions, linearised) = if self.limits.takes_last_step {
            let there = each().map(|((place, film), end)| film.moved_to(place.seen(*end)));
            let there = there.collect();
            (ends, there)
        } else {
            let kept = films.iter().map(|film| film.linearised).collect();
            (positions.to_vec(), kept)
        };
        Balanced {
            states: self.states(places, &positions),
            moved: if self.limits.takes_last_step {
                moved
            } else {
                vec![0.0; places.len()]
            },
            positions,
            linearised,
            loads,
            outcome: Outcome::Converged,
        }
    }

    fn states(&self, places: &[Place<'_>], positions: &[Coordinates]) -> Vec<JournalState> {
        let journals = places.iter().zip(positions).enumerate();
        journals
            .map(|(journal, (place, position))| self.state(place, journal, *position))
            .collect()
    }

    /// The best iterate, with the films updated there once more.
    fn given_up(&self, places: &mut [Place<'_>], newton: Newton) -> Result<Balanced, FilmError> {
        let positions = newton.best.map_or(newton.positions, |(best, _)| best);
        let mut again = Newton {
            films: vec![None; places.len()],
            positions,
            previous: None,
            backtracks: 0,
            best: None,
            cause: newton.cause,
        };
        self.update_films(places, &mut again)?;
        let linearised: Vec<Linearised> = again
            .films
            .iter()
            .map(|film| film.map_or(Linearised::without_film(again.cause), |f| f.linearised))
            .collect();
        let loads = linearised
            .iter()
            .map(|answer| {
                let (force, moment) = (answer.reaction.force(), answer.reaction.moment());
                [-force[0], -force[1], -moment[0], -moment[1]]
            })
            .collect();
        Ok(Balanced {
            states: self.states(places, &again.positions),
            positions: again.positions,
            linearised,
            loads,
            moved: vec![0.0; places.len()],
            outcome: again.cause,
        })
    }
}

impl Newton {
    /// Halves the last step if the residual grew too much or a film refused; false if the iterate is
    /// to be kept (or there is no way back).
    fn step_back(&mut self, residual: f64, cause: Outcome) -> bool {
        let refused = !residual.is_finite();
        let Some((from, step, before)) = &mut self.previous else {
            self.cause = cause;
            return false;
        };
        if !refused && residual <= TOLERATED_GROWTH * *before {
            return false;
        }
        if self.backtracks >= LARGEST_BACKTRACKS {
            self.cause = cause;
            return false;
        }
        self.backtracks += 1;
        for ((position, from), step) in self.positions.iter_mut().zip(from).zip(step) {
            *step = step.map(|value| 0.5 * value);
            *position = add(*from, 1.0, *step);
        }
        true
    }

    fn keep_best(&mut self, residual: f64) {
        let better = self.best.as_ref().is_none_or(|(_, best)| residual <= *best);
        if better {
            self.best = Some((self.positions.clone(), residual));
        }
    }

    fn advance(&mut self, residual: f64, step: Vec<Coordinates>) {
        let from = self.positions.clone();
        for (position, step) in self.positions.iter_mut().zip(&step) {
            *position = add(*position, 1.0, *step);
        }
        self.previous = Some((from, step, residual));
        self.backtracks = 0;
    }
}
