//! Solves the films of all nodes, in parallel, and measures how far the splines between them err.
//!
//! Films that mirror each other are solved once. With the axis turned round both tilts change their signs:
//! forces stay, moments change theirs. With the sense of rotation turned round the transverse tilt does,
//! which a squeeze does not feel: `Phi_2` and `Theta_2` change their signs.

use super::grid::Shape;
use super::stored::Kept;
use super::{Accuracy, Drive, SuperpositionRecipe, SuperpositionTable, centre, tilt_box};
use crate::axis::Axis;
use crate::error::DatabaseError;
use rayon::prelude::*;
use sommerfeld_film::Outcome;
use sommerfeld_film::dimensionless::{DimensionlessSolution, solve_dimensionless};
use std::path::Path;

/// Of a node: `Phi_1, Phi_2, Theta_1, Theta_2`, the largest `Pi`, and how far extrapolation moved the
/// first four, over force and moment.
pub(super) const FIGURES: usize = 6;
/// Of the random states of a generation.
const FIRST_SEED: u64 = 0x5EED;
/// Films between two reports of progress.
const BATCH: usize = 64;

/// Films solved and films in all; `false` as the answer stops the generation.
pub type Progress<'a> = dyn FnMut(usize, usize) -> bool + 'a;

/// A film to solve.
#[derive(Clone, Copy)]
enum Task {
    Node(Drive, [usize; 3]),
    /// Of the wedge near the centre: eccentricity and tilts.
    Centre(f64, [f64; 2]),
}

impl SuperpositionTable {
    /// Solves everything that `recipe` asks for. With a `path` the database is written there, and an
    /// interrupted generation leaves what it has solved beside it, where the next one with the same recipe
    /// takes it up. The result does not depend on threads or interruptions.
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
        let axes = recipe.axes()?;
        let shape = Shape::of(&axes);
        let tasks = tasks(recipe, shape);
        let samples = samples(recipe, &axes, FIRST_SEED);
        let total = tasks.len() + samples.len();
        let mut kept = Kept::beside(path, recipe);
        let mut solved = kept.read(tasks.len());
        let open: Vec<usize> = (0..tasks.len())
            .filter(|k| solved[*k][0].is_nan())
            .collect();
        let mut done = tasks.len() - open.len();
        for batch in open.chunks(BATCH) {
            let found: Result<Vec<_>, _> = (batch.par_iter())
                .map(|k| solve(recipe, &axes, tasks[*k]))
                .collect();
            for (k, figures) in batch.iter().zip(found?) {
                solved[*k] = figures;
            }
            done += batch.len();
            let goes_on = progress(done, total);
            kept.write(&solved, !goes_on || done == tasks.len())?;
            if !goes_on {
                return Err(DatabaseError::Interrupted { done, total });
            }
        }
        let nodes = Drive::ALL.map(|drive| filled(drive, shape, &tasks, &solved));
        let centre = tasks.iter().zip(&solved);
        let centre = centre.filter(|(task, _)| matches!(task, Task::Centre(..)));
        let centre = centre.map(|(_, figures)| *figures).collect();
        let mut table = Self::of(*recipe, nodes, centre, [Accuracy::default(); 3])?;
        table.measure(&samples, &mut |measured| progress(done + measured, total))?;
        if let Some(path) = path {
            table.write(path)?;
            kept.remove();
        }
        Ok(table)
    }

    /// Errors at other random states, `samples` of each drive, than those of the generation: another `seed`,
    /// other states. The table stays as it is.
    ///
    /// # Errors
    /// As [`SuperpositionTable::build`].
    pub fn check(
        &self,
        samples_of_each: usize,
        seed: u64,
        progress: &mut Progress<'_>,
    ) -> Result<[Accuracy; 3], DatabaseError> {
        let mut own = self.clone();
        own.recipe.samples = samples_of_each;
        let states = samples(&own.recipe, &self.axes, seed);
        own.measure(&states, &mut |done| progress(done, states.len()))?;
        Ok(own.accuracy)
    }

    /// Measures the errors at `samples` by direct solutions.
    fn measure(
        &mut self,
        samples: &[Sample],
        progress: &mut dyn FnMut(usize) -> bool,
    ) -> Result<(), DatabaseError> {
        let mut errors: [Vec<f64>; 3] = Default::default();
        for (k, batch) in samples.chunks(BATCH).enumerate() {
            let found: Result<Vec<_>, _> = batch.par_iter().map(|s| self.error_at(s)).collect();
            for (sample, error) in batch.iter().zip(found?) {
                errors[sample.drive as usize].push(error);
            }
            if !progress(k * BATCH + batch.len()) {
                let (done, total) = (k * BATCH + batch.len(), samples.len());
                return Err(DatabaseError::Interrupted { done, total });
            }
        }
        for (drive, mut errors) in Drive::ALL.into_iter().zip(errors) {
            errors.sort_by(f64::total_cmp);
            let count = errors.len();
            let of_share = |share: f64| {
                let rank = (share * count as f64).ceil() as usize;
                errors
                    .get(rank.clamp(1, count.max(1)) - 1)
                    .copied()
                    .unwrap_or_default()
            };
            self.accuracy[drive as usize] = Accuracy {
                samples: count,
                largest: of_share(1.0),
                of_999: of_share(0.999),
                median: of_share(0.5),
                node_error: self.node_error(drive),
            };
        }
        Ok(())
    }

    fn error_at(&self, sample: &Sample) -> Result<f64, DatabaseError> {
        let Sample { drive, eps, tilts } = *sample;
        let finer = self.recipe.grid.map(|cells| 2 * (3 * cells / 4));
        let direct = solve_film(&self.recipe, drive, eps, tilts, finer)?.integrals;
        let factor = if drive == Drive::Wedge { eps } else { 1.0 };
        let [f1, f2, m1, m2] =
            (self.lookup(drive, eps, tilts).integrals).map(|value| factor * value);
        let force = direct.p_cos.hypot(direct.p_sin);
        let moment = direct.p_z_cos.hypot(direct.p_z_sin).max(0.1 * force);
        let of_force = (f1 - direct.p_cos).hypot(f2 - direct.p_sin) / force;
        let of_moment = (m1 - direct.p_z_cos).hypot(m2 - direct.p_z_sin) / moment;
        Ok(of_force.max(of_moment))
    }

    /// Largest error of a node of a gap as open as those of the samples.
    fn node_error(&self, drive: Drive) -> f64 {
        let shape = Shape::of(&self.axes);
        let mut largest = 0.0_f64;
        for (index, node) in self.nodes[drive as usize].iter().enumerate() {
            let (eps, [along, across]) = place_of(&self.axes, shape.place(index));
            if tilt_box::smallest_gap(eps, along, across) >= self.recipe.smallest_gap {
                largest = largest.max(node[5]);
            }
        }
        largest
    }
}

/// A state between the nodes.
struct Sample {
    drive: Drive,
    eps: f64,
    tilts: [f64; 2],
}

/// Random states, evenly spread over the places of the axes, where the gap is open enough. The same for the
/// same recipe and seed.
fn samples(recipe: &SuperpositionRecipe, axes: &[Axis; 3], seed: u64) -> Vec<Sample> {
    /// A share of states that is never as small as this one finds none.
    const TRIES: usize = 1000;
    let mut random = SplitMix { state: seed };
    let mut samples = Vec::new();
    for drive in Drive::ALL {
        let mut found = 0;
        for _ in 0..recipe.samples * TRIES {
            if found == recipe.samples {
                break;
            }
            let [eps, share, transverse] = axes
                .each_ref()
                .map(|axis| axis.at(random.next() * (axis.count() - 1) as f64));
            let tilts = tilt_box::tilts(eps, [share, transverse]);
            let is_open = tilt_box::smallest_gap(eps, tilts[0], tilts[1]) >= recipe.smallest_gap;
            if is_open && eps >= recipe.smallest_eccentricity {
                samples.push(Sample { drive, eps, tilts });
                found += 1;
            }
        }
    }
    samples
}

/// Numbers in [0, 1) by the generator of Steele, Lea and Flood (2014), 10.1145/2660193.2660195.
struct SplitMix {
    state: u64,
}

impl SplitMix {
    fn next(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
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

fn solve_film(
    recipe: &SuperpositionRecipe,
    drive: Drive,
    eps: f64,
    tilts: [f64; 2],
    grid: [usize; 2],
) -> Result<DimensionlessSolution, DatabaseError> {
    let film = recipe.film(drive, eps, tilts);
    let solution = solve_dimensionless(&film, grid)?;
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
