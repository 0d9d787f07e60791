//! A table built: solved on all cores, interrupted and resumed, refined until it errs less than asked.
//!
//! A slice is one eccentricity of one width ratio: its films are solved one after the other, slices
//! side by side, and every film is that of its node whatever was solved before, so that a table does not
//! depend on the number of cores or on interruptions. A level ends when all nodes are there. Then every
//! second node along an axis is left out, and what a table without them says of them tells which axis
//! errs; it gets a node in the middle of every two. Once no axis shows an error, films at states between
//! the nodes decide: drawn ones, and the middles beside the nodes that were missed most.

use crate::check::{CheckReport, Place, check_at, places};
use crate::contents::Contents;
use crate::direction::{Direction, from_logarithms};
use crate::error::DatabaseError;
use crate::node_film::NodeFilm;
use crate::recipe::Recipe;
use crate::table::{Axes, Errors, Node, Table, contents, parts};
use rayon::prelude::*;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Signs of life of a build, and the wish to end it. Called from many threads.
pub trait Progress: Sync {
    /// `done` of the `total` films of this level are solved; the next level may have more.
    fn films(&self, _done: usize, _total: usize) {}

    /// Asked before every film: true ends the build.
    fn interrupted(&self) -> bool {
        false
    }
}

/// Nobody looks.
impl Progress for () {}

/// What the attribute `scheme` of an unfinished file says.
const UNFINISHED: &str = "combined-unfinished";
/// Nodes along each axis to begin with: nine are the fewest of which every second one may be left out;
/// along the eccentricity the derivatives ask for more than the force.
const FIRST: [usize; 3] = [9, 25, 17];
/// Fewest nodes along the direction of tables that err by [`DERIVATIVES_FROM`] or less: with 33 of them the
/// derivatives of `gumbel` films were off by 1.3 % at one state of a hundred.
const DIRECTIONS: usize = 65;
const DERIVATIVES_FROM: f64 = 1e-3;
/// Most nodes of a table.
const MOST_NODES: usize = 1 << 20;
/// Films that are solved at least every so often are kept.
const KEEP_EVERY: Duration = Duration::from_secs(5);
/// Share of the target that the axes' own estimate and the samples may use, so that fresh states stay
/// below it.
const SAFE: f64 = 0.5;
/// Nodes of each axis beside which the table is looked at besides the samples.
const WEAK: usize = 25;
/// Factor by which halving the distance of nodes is trusted to lower an error; a smooth film gives 16.
const TRUSTED: f64 = 10.0;

/// Builds a table.
///
/// With `unfinished`, films already solved are kept in that file now and then and when interrupted, and
/// taken from it where it exists; it is removed when the table is whole.
///
/// # Errors
/// [`DatabaseError::Interrupted`] when `progress` says so; what [`Recipe::check`] refuses;
/// [`DatabaseError::TargetMissed`], [`DatabaseError::NotSolved`]; [`DatabaseError::File`] and
/// [`DatabaseError::Contents`] of the unfinished file, the latter too if it belongs to another recipe.
pub fn generate(
    recipe: &Recipe,
    progress: &dyn Progress,
    unfinished: Option<&Path>,
) -> Result<Table, DatabaseError> {
    recipe.check()?;
    let mut build = Build::begin(recipe, unfinished)?;
    let table = loop {
        build.fill(progress, unfinished)?;
        let table = build.table()?;
        let halves = build.halves(&table)?;
        let missing = halves
            .each_ref()
            .map(|halves| halves.first().map_or(0.0, |(_, error)| error / TRUSTED));
        let mut refine = missing.map(|error| error > SAFE * recipe.target);
        if !refine.contains(&true) {
            let table = Arc::new(table);
            let mut places = places(recipe, recipe.samples, recipe.seed);
            places.extend(build.weak_places(&halves));
            let report = check_at(&table, &places, false)?;
            if report.maximum <= SAFE.sqrt() * recipe.target {
                let errors = build.errors(&report);
                break Arc::unwrap_or_clone(table).with_errors(errors);
            }
            let worst = missing.iter().copied().fold(0.0, f64::max);
            refine = missing.map(|error| error == worst);
            build.refuse_to_grow(report.maximum, refine)?;
        }
        build.halve(refine)?;
    };
    if let Some(path) = unfinished.filter(|path| path.exists()) {
        std::fs::remove_file(path).map_err(|error| DatabaseError::File {
            path: path.to_owned(),
            reason: format!("cannot be removed: {error}"),
        })?;
    }
    Ok(table)
}

/// A table on its way. Nodes that are not solved have an error that is not a number.
struct Build {
    recipe: Recipe,
    axes: Axes,
    nodes: Vec<Node>,
}

const OPEN: Node = Node {
    force: [f64::NAN; 2],
    peak: f64::NAN,
    peak_angle: f64::NAN,
    side_flow: f64::NAN,
    full_film_share: f64::NAN,
    error: f64::NAN,
};

impl Build {
    fn begin(recipe: &Recipe, unfinished: Option<&Path>) -> Result<Self, DatabaseError> {
        if let Some(path) = unfinished.filter(|path| path.exists()) {
            let contents = Contents::read(path, UNFINISHED)?;
            let (begun, axes, nodes) = parts(&contents, path)?;
            if begun != *recipe {
                return Err(DatabaseError::File {
                    path: path.to_owned(),
                    reason: "holds films of another recipe: remove it, or name another file"
                        .to_owned(),
                });
            }
            return Ok(Self {
                recipe: begun,
                axes,
                nodes,
            });
        }
        let [narrow, wide] = recipe.width_ratios;
        let mut counts = FIRST;
        if narrow == wide {
            counts[0] = 1;
        }
        if recipe.target <= DERIVATIVES_FROM {
            counts[2] = DIRECTIONS;
        }
        Ok(Self {
            recipe: *recipe,
            axes: Axes::new(recipe, counts)?,
            nodes: vec![OPEN; counts.iter().product()],
        })
    }

    fn keep(&self, path: Option<&Path>) -> Result<(), DatabaseError> {
        match path {
            Some(path) => contents(&self.recipe, &self.axes, &self.nodes).write(path, UNFINISHED),
            None => Ok(()),
        }
    }

    /// Solves the nodes that are open.
    fn fill(
        &mut self,
        progress: &dyn Progress,
        unfinished: Option<&Path>,
    ) -> Result<(), DatabaseError> {
        let directions = self.axes.direction.count();
        let total = self.nodes.len();
        let done = AtomicUsize::new(
            self.nodes
                .iter()
                .filter(|node| !node.error.is_nan())
                .count(),
        );
        let open: Vec<usize> = (0..total / directions)
            .filter(|slice| self.nodes[slice * directions].error.is_nan() || self.has_open(*slice))
            .collect();
        let mut kept = Instant::now();
        progress.films(done.load(Ordering::Relaxed), total);
        for some in open.chunks(4 * rayon::current_num_threads()) {
            let begun = some
                .par_iter()
                .map(|slice| self.slice(*slice, progress, &done))
                .collect::<Result<Vec<_>, _>>()?;
            let mut whole = true;
            for (slice, nodes) in some.iter().zip(begun) {
                match nodes {
                    Some(nodes) => self.nodes[slice * directions..(slice + 1) * directions]
                        .copy_from_slice(&nodes),
                    None => whole = false,
                }
            }
            if !whole {
                self.keep(unfinished)?;
                let solved = self.nodes.iter().filter(|node| !node.error.is_nan());
                return Err(DatabaseError::Interrupted {
                    done: solved.count(),
                    total,
                });
            }
            if kept.elapsed() > KEEP_EVERY {
                self.keep(unfinished)?;
                kept = Instant::now();
            }
        }
        Ok(())
    }

    fn has_open(&self, slice: usize) -> bool {
        let directions = self.axes.direction.count();
        let nodes = &self.nodes[slice * directions..(slice + 1) * directions];
        nodes.iter().any(|node| node.error.is_nan())
    }

    /// The films of one slice; `None` when interrupted.
    fn slice(
        &self,
        slice: usize,
        progress: &dyn Progress,
        done: &AtomicUsize,
    ) -> Result<Option<Vec<Node>>, DatabaseError> {
        let [_, eccentricities, directions] = self.axes.counts();
        let (width, at) = (slice / eccentricities, slice % eccentricities);
        let eccentricity = self.axes.eccentricity.value(at);
        let width_ratio = self.axes.width_ratio.value(width);
        let mut film = NodeFilm::new(self.recipe.closure, width_ratio, self.recipe.tolerance());
        let mut nodes = self.nodes[slice * directions..(slice + 1) * directions].to_vec();
        let mut centred: Option<Node> = None;
        for (direction, node) in nodes.iter_mut().enumerate() {
            if !node.error.is_nan() {
                continue;
            }
            if progress.interrupted() {
                return Ok(None);
            }
            let angle = self.axes.angle(at, direction);
            *node = match centred {
                // In the centre all directions are alike.
                Some(first) => turned(&first, angle),
                None => solve(&mut film, eccentricity, angle).ok_or(DatabaseError::NotSolved {
                    eccentricity,
                    direction_deg: angle.to_degrees(),
                    width_ratio,
                })?,
            };
            if at == 0 && centred.is_none() {
                let first = solve(&mut film, eccentricity, 0.0).unwrap_or(*node);
                *node = turned(&first, angle);
                centred = Some(first);
            }
            let end = direction == 0 || direction + 1 == directions;
            if end {
                node.force[1] = 0.0;
            }
            let all = self.nodes.len();
            progress.films((done.fetch_add(1, Ordering::Relaxed) + 1).min(all), all);
        }
        Ok(Some(nodes))
    }

    fn table(&self) -> Result<Table, DatabaseError> {
        Table::new(
            self.recipe,
            self.axes,
            self.nodes.clone(),
            Errors::default(),
        )
    }

    /// Errors of tables with every second node along each axis, at the nodes left out, the largest
    /// first.
    fn halves(&self, table: &Table) -> Result<[Vec<(usize, f64)>; 3], DatabaseError> {
        let counts = self.axes.counts();
        let mut halves = [const { Vec::new() }; 3];
        for (axis, errors) in halves.iter_mut().enumerate() {
            if counts[axis] > 1 {
                *errors = table.errors_of_half(axis)?;
                errors.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
            }
        }
        Ok(halves)
    }

    /// Middles between the nodes that tables with fewer nodes miss most: where the table should err most.
    fn weak_places(&self, halves: &[Vec<(usize, f64)>; 3]) -> Vec<Place> {
        let counts = self.axes.counts();
        let axes = &self.axes;
        let mut places = Vec::new();
        for (axis, halves) in halves.iter().enumerate() {
            for (at, _) in halves.iter().take(WEAK) {
                let node = [
                    at / (counts[1] * counts[2]),
                    at / counts[2] % counts[1],
                    at % counts[2],
                ];
                for side in [-0.5, 0.5] {
                    let near = |of: usize| {
                        let last = (counts[of] - 1) as f64;
                        let aside = if of == axis || of == 2 {
                            side
                        } else {
                            0.25 * side
                        };
                        (node[of] as f64 + aside).clamp(0.0, last)
                    };
                    let eccentricity = axes.eccentricity.at(near(1));
                    places.push(Place {
                        width_ratio: axes.width_ratio.at(near(0)),
                        eccentricity,
                        angle: Direction::angle(eccentricity, axes.direction.at(near(2))),
                    });
                }
            }
        }
        places
    }

    /// A node in the middle of every two along some axes.
    fn halve(&mut self, along: [bool; 3]) -> Result<(), DatabaseError> {
        let before = self.axes.counts();
        let mut counts = before;
        for (count, halved) in counts.iter_mut().zip(along) {
            if halved && *count > 1 {
                *count = 2 * *count - 1;
            }
        }
        let axes = Axes::new(&self.recipe, counts)?;
        let mut nodes = vec![OPEN; counts.iter().product()];
        let step: [usize; 3] =
            std::array::from_fn(|axis| (counts[axis] - 1) / (before[axis] - 1).max(1));
        for (at, node) in self.nodes.iter().enumerate() {
            let place = [
                at / (before[1] * before[2]) * step[0].max(1),
                at / before[2] % before[1] * step[1],
                at % before[2] * step[2],
            ];
            nodes[(place[0] * counts[1] + place[1]) * counts[2] + place[2]] = *node;
        }
        self.axes = axes;
        self.nodes = nodes;
        Ok(())
    }

    fn refuse_to_grow(&self, reached: f64, along: [bool; 3]) -> Result<(), DatabaseError> {
        let twice = along.iter().filter(|halved| **halved).count() as u32;
        if self.nodes.len() << twice > MOST_NODES {
            return Err(DatabaseError::TargetMissed {
                target: self.recipe.target,
                reached,
                nodes: self.nodes.len(),
            });
        }
        Ok(())
    }

    fn errors(&self, report: &CheckReport) -> Errors {
        Errors {
            maximum: report.maximum,
            quantile_999: report.quantile_999,
            median: report.median,
            peak_maximum: report.peak_maximum,
            node_maximum: self.nodes.iter().fold(0.0, |a, node| a.max(node.error)),
        }
    }
}

fn solve(film: &mut NodeFilm, eccentricity: f64, angle: f64) -> Option<Node> {
    let solved = film.solve(eccentricity, angle, false)?;
    Some(Node {
        force: solved.force,
        peak: solved.peak,
        peak_angle: solved.peak_angle.abs(),
        side_flow: solved.side_flow,
        full_film_share: solved.full_film_share,
        error: solved.error,
    })
}

/// The film of a centred journal that moves at `angle`, from the one that moves at 0.
fn turned(first: &Node, angle: f64) -> Node {
    Node {
        force: from_logarithms([(-first.force[0]).ln(), 0.0], angle),
        peak_angle: angle,
        ..*first
    }
}
