//! Solves the films of all nodes, in parallel, and adds nodes and cells until the curves between them err less than
//! asked.
//!
//! Films that mirror each other are solved once. With the axis turned round both tilts change their signs:
//! forces stay, moments change theirs. With the sense of rotation turned round the transverse tilt does,
//! which a squeeze does not feel: `Phi_2` and `Theta_2` change their signs.

use super::accuracy::{WEIGHT, samples};
use super::grid::Shape;
use super::stored::{Kept, Solved};
use super::{Accuracy, Drive, SuperpositionRecipe, SuperpositionTable, centre, tilt_box};
use crate::axis::Axis;
use crate::error::DatabaseError;
use rayon::prelude::*;
use sommerfeld_film::Outcome;
use sommerfeld_film::dimensionless::{DimensionlessSolution, solve_graded};
use std::path::Path;

/// Of a node: `Phi_1, Phi_2, Theta_1, Theta_2`, the largest `Pi`, and how far extrapolation moved the
/// first four, over force and moment.
pub(super) const FIGURES: usize = 6;
/// Films between two reports of progress.
pub(super) const BATCH: usize = 64;

/// Films solved and films in all, those of random states, which have more cells, counted as two; `false` as the
/// answer stops the generation. More in all than before: nodes are added.
pub type Progress<'a> = dyn FnMut(usize, usize) -> bool + 'a;

/// A film to solve.
#[derive(Clone, Copy)]
enum Task {
    Node(Drive, [usize; 3]),
    /// Of the wedge near the centre: eccentricity and tilts.
    Centre(f64, [f64; 2]),
}

impl SuperpositionTable {
    /// Solves everything that `recipe` asks for, and adds nodes and cells where the error is until its target is
    /// met with some room or they are as many as a database may have; see [`SuperpositionTable::outcome`] and
    /// what is left of the recipe in the table. With a `path` the database is written there, and an interrupted
    /// generation leaves what it has solved beside it, where the next one with the same recipe takes it up. The
    /// result does not depend on threads or interruptions.
    ///
    /// # Errors
    /// [`DatabaseError::Recipe`] where a value cannot be built for, [`DatabaseError::Interrupted`] where
    /// `progress` says so, [`DatabaseError::TiltedNotSolved`] for a film without a solution, and errors of
    /// the file.
    pub fn build(
        recipe: &SuperpositionRecipe,
        path: Option<&Path>,
        progress: &mut Progress<'_>,
    ) -> Result<Self, DatabaseError> {
        recipe.axes()?;
        let mut kept = Kept::beside(path, recipe);
        let (mut level, mut solved) = kept.read();
        let table = loop {
            let table = Self::level(&level, &mut solved, &mut kept, progress)?;
            let states = samples(&level, &table.axes);
            match table.finer(&states, &solved.errors)? {
                Some(finer) => {
                    solved = table.taken_over(&finer)?;
                    level = finer;
                }
                None => break table,
            }
        };
        if let Some(path) = path {
            table.write(path)?;
            kept.remove();
        }
        Ok(table)
    }

    /// The table of a recipe as it stands, its error measured. `solved` holds what is known of it.
    fn level(
        recipe: &SuperpositionRecipe,
        solved: &mut Solved,
        kept: &mut Kept,
        progress: &mut Progress<'_>,
    ) -> Result<Self, DatabaseError> {
        let axes = recipe.axes()?;
        let shape = Shape::of(&axes);
        let tasks = tasks(recipe, shape);
        let states = samples(recipe, &axes);
        let total = tasks.len() + WEIGHT * states.len();
        solved.fit(tasks.len(), states.len());
        let open: Vec<usize> = (0..tasks.len())
            .filter(|k| solved.films[*k][0].is_nan())
            .collect();
        let mut done = tasks.len() - open.len();
        for batch in open.chunks(BATCH) {
            let found: Result<Vec<_>, _> = (batch.par_iter())
                .map(|k| solve(recipe, &axes, tasks[*k]))
                .collect();
            for (k, figures) in batch.iter().zip(found?) {
                solved.films[*k] = figures;
            }
            done += batch.len();
            let goes_on = progress(done, total);
            kept.write(recipe, solved, !goes_on || done == tasks.len())?;
            if !goes_on {
                return Err(DatabaseError::Interrupted { done, total });
            }
        }
        let nodes = Drive::ALL.map(|drive| filled(drive, shape, &tasks, &solved.films));
        let centre = tasks.iter().zip(&solved.films);
        let centre = centre.filter(|(task, _)| matches!(task, Task::Centre(..)));
        let centre = centre.map(|(_, figures)| *figures).collect();
        let mut table = Self::of(*recipe, nodes, centre, [Accuracy::default(); 3])?;
        let mut errors = solved.errors.clone();
        table.measure(&states, &mut errors, &mut |measured, errors| {
            let done = tasks.len() + WEIGHT * measured;
            let goes_on = progress(done, total);
            solved.errors.copy_from_slice(errors);
            kept.write(recipe, solved, !goes_on)?;
            match goes_on {
                true => Ok(()),
                false => Err(DatabaseError::Interrupted { done, total }),
            }
        })?;
        table.accuracy = table.accuracy_of(&states, &errors);
        Ok(table)
    }

    /// What this table knows of the films of a finer one.
    fn taken_over(&self, finer: &SuperpositionRecipe) -> Result<Solved, DatabaseError> {
        let axes = finer.axes()?;
        let (own, shape) = (Shape::of(&self.axes), Shape::of(&axes));
        let tasks = tasks(finer, shape);
        let mut solved = Solved::default();
        solved.fit(tasks.len(), 0);
        if finer.grid != self.recipe.grid {
            return Ok(solved);
        }
        let mut centre = self.centre.iter();
        for (films, task) in solved.films.iter_mut().zip(tasks) {
            match task {
                Task::Node(drive, place) => {
                    if let Some(place) = own.within(shape, place) {
                        *films = self.nodes[drive as usize][own.index(place)];
                    }
                }
                Task::Centre(..) if finer.centre_nodes == self.recipe.centre_nodes => {
                    if let Some(figures) = centre.next() {
                        *films = *figures;
                    }
                }
                Task::Centre(..) => {}
            }
        }
        Ok(solved)
    }
}

/// The films to solve: one of each set of nodes that mirror each other, and those near the centre.
fn tasks(recipe: &SuperpositionRecipe, shape: Shape) -> Vec<Task> {
    let mut tasks = Vec::new();
    for drive in Drive::ALL {
        for index in 0..shape.nodes() {
            let node = shape.place(index);
            if representative(drive, shape, node).0 == node {
                tasks.push(Task::Node(drive, node));
            }
        }
    }
    let states = centre::states(recipe);
    tasks.extend(
        states
            .into_iter()
            .map(|(eps, tilts)| Task::Centre(eps, tilts)),
    );
    tasks
}

/// Films of the nodes of a recipe.
pub(super) fn count_of_films(recipe: &SuperpositionRecipe) -> Result<usize, DatabaseError> {
    Ok(tasks(recipe, Shape::of(&recipe.axes()?)).len())
}

/// The node whose film is solved for `node`, and the signs of its integrals there.
fn representative(drive: Drive, shape: Shape, [e, u, d]: [usize; 3]) -> ([usize; 3], [f64; 4]) {
    let [last_u, last_d] = [shape.counts[1] - 1, shape.counts[2] - 1];
    let mut signs = [1.0; 4];
    let (mut u, mut d) = (u, d);
    // Whole numbers, the middle at half of the last: negative tilts come before it.
    if 2 * u < last_u || (2 * u == last_u && 2 * d < last_d) {
        (u, d) = (last_u - u, last_d - d);
        signs = [1.0, 1.0, -1.0, -1.0];
    }
    if drive != Drive::Wedge && 2 * d < last_d {
        d = last_d - d;
        signs[1] = -signs[1];
        signs[3] = -signs[3];
    }
    ([e, u, d], signs)
}

/// All nodes of a drive from those that were solved.
fn filled(
    drive: Drive,
    shape: Shape,
    tasks: &[Task],
    solved: &[[f64; FIGURES]],
) -> Vec<[f64; FIGURES]> {
    let mut own = vec![[f64::NAN; FIGURES]; shape.nodes()];
    for (task, figures) in tasks.iter().zip(solved) {
        match task {
            Task::Node(of, node) if *of == drive => own[shape.index(*node)] = *figures,
            _ => {}
        }
    }
    (0..shape.nodes())
        .map(|index| {
            let (node, signs) = representative(drive, shape, shape.place(index));
            let mut figures = own[shape.index(node)];
            for (figure, sign) in figures.iter_mut().zip(signs) {
                *figure *= sign;
            }
            figures
        })
        .collect()
}

/// Eccentricity and tilts `[along, across]` of a node.
pub(super) fn place_of(axes: &[Axis; 3], [e, u, d]: [usize; 3]) -> (f64, [f64; 2]) {
    let eps = axes[0].value(e);
    (
        eps,
        tilt_box::tilts(eps, [axes[1].value(u), axes[2].value(d)]),
    )
}

fn solve(
    recipe: &SuperpositionRecipe,
    axes: &[Axis; 3],
    task: Task,
) -> Result<[f64; FIGURES], DatabaseError> {
    let (drive, (eps, tilts)) = match task {
        Task::Node(drive, node) => (drive, place_of(axes, node)),
        Task::Centre(eps, tilts) => (Drive::Wedge, (eps, tilts)),
    };
    let solution = solve_film(recipe, drive, eps, tilts, recipe.grid)?;
    let (found, moved) = (solution.integrals, solution.moved);
    let force = found.p_cos.hypot(found.p_sin);
    let moment = found.p_z_cos.hypot(found.p_z_sin).max(0.1 * force);
    let of_force = moved.p_cos.hypot(moved.p_sin) / force;
    let of_moment = moved.p_z_cos.hypot(moved.p_z_sin) / moment;
    Ok([
        found.p_cos,
        found.p_sin,
        found.p_z_cos,
        found.p_z_sin,
        found.peak,
        of_force.max(of_moment),
    ])
}

pub(super) fn solve_film(
    recipe: &SuperpositionRecipe,
    drive: Drive,
    eps: f64,
    tilts: [f64; 2],
    grid: [usize; 2],
) -> Result<DimensionlessSolution, DatabaseError> {
    let film = recipe.film(drive, eps, tilts);
    let solution = solve_graded(&film, grid)?;
    if solution.outcome == Outcome::Converged {
        return Ok(solution);
    }
    Err(DatabaseError::TiltedNotSolved {
        drive: drive.letter(),
        d_over_b: recipe.d_over_b,
        eccentricity: eps,
        gamma: film.tilt_gamma,
        delta: film.tilt_delta,
    })
}
