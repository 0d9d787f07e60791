//! Where does a table err, and what makes it err less?
//!
//! Of the random states that err most, films on the cells of the nodes tell whether those cells err or the curves
//! between the nodes. Curves are blamed on the axis whose nodes, every second one left out, the rest says least of;
//! near the centre on the films there.

use super::accuracy::{Sample, error_of};
use super::build::{count_of_films, place_of};
use super::centre::{Centre, LARGEST_DEGREE};
use super::grid::{Fitted, Places, Shape, Spot};
use super::{Drive, SuperpositionRecipe, SuperpositionTable, tilt_box};
use crate::axis::Axis;
use crate::error::DatabaseError;
use rayon::prelude::*;
use sommerfeld_film::Outcome;

/// Share of the target that random states may use, so that others keep it too.
const SAFE: f64 = 0.7;
/// States that are looked at.
const WORST: usize = 12;
/// Most cells of a film at a node.
const MOST_CELLS: usize = 288 * 72;
/// Fewest nodes of an axis of which every second one may be left out.
const FEWEST: usize = 9;

impl SuperpositionTable {
    /// A recipe that errs less, `errors` being those at `samples`; `None` where the target is met or nothing may
    /// be added.
    pub(super) fn finer(
        &self,
        samples: &[Sample],
        errors: &[f64],
    ) -> Result<Option<SuperpositionRecipe>, DatabaseError> {
        let is_met = self.largest_error() <= SAFE * self.recipe.target;
        if samples.is_empty() || is_met && self.outcome() == Outcome::Converged {
            return Ok(None);
        }
        for finer in self.ways(samples, errors)? {
            if count_of_films(&finer)? <= self.recipe.most_films
                && finer.grid[0] * finer.grid[1] <= MOST_CELLS
            {
                return Ok(Some(finer));
            }
        }
        Ok(None)
    }

    /// What may be done, the best first.
    fn ways(
        &self,
        samples: &[Sample],
        errors: &[f64],
    ) -> Result<Vec<SuperpositionRecipe>, DatabaseError> {
        let mut worst: Vec<(Sample, f64)> = (samples.iter().copied())
            .zip(errors.iter().copied())
            .collect();
        worst.sort_by(|a, b| b.1.total_cmp(&a.1));
        let kept = SAFE * self.recipe.target;
        worst.retain(|(_, error)| *error > kept);
        worst.truncate(WORST);
        let between: Result<Vec<f64>, _> = (worst.par_iter())
            .map(|(sample, _)| self.error_against(sample, self.recipe.grid))
            .collect();
        let mut blamed = [0; 3];
        for ((sample, error), between) in worst.iter().zip(between?) {
            let [along, across] = sample.tilts;
            let size = sample.eps.hypot(along).hypot(across);
            let is_central = sample.drive == Drive::Wedge
                && self.recipe.centre_nodes[0] > 0
                && Centre::share_of_table(size)[0] < 0.5;
            let which = match (between < 0.5 * error, is_central) {
                (true, _) => 0,
                (false, true) => 1,
                (false, false) => 2,
            };
            blamed[which] += 1;
        }
        let mut order = [0, 1, 2];
        order.sort_by_key(|which| std::cmp::Reverse(blamed[*which]));
        let mut ways = Vec::new();
        for which in order.into_iter().filter(|which| blamed[*which] > 0) {
            match which {
                0 => ways.push(self.with_finer_cells()),
                1 => ways.extend(self.with_more_at_the_centre()),
                _ => ways.extend(self.with_more_nodes()?),
            }
        }
        Ok(ways)
    }

    fn with_finer_cells(&self) -> SuperpositionRecipe {
        SuperpositionRecipe {
            // Half as many again, in eights.
            grid: self.recipe.grid.map(|cells| 8 * (3 * cells).div_ceil(16)),
            ..self.recipe
        }
    }

    fn with_more_at_the_centre(&self) -> Option<SuperpositionRecipe> {
        let [shells, degree] = self.recipe.centre_nodes;
        (degree < LARGEST_DEGREE).then(|| SuperpositionRecipe {
            centre_nodes: [shells + 3, (degree + 4).min(LARGEST_DEGREE)],
            ..self.recipe
        })
    }

    /// Nodes in the middle of every two along an axis, the one that errs most first.
    fn with_more_nodes(&self) -> Result<Vec<SuperpositionRecipe>, DatabaseError> {
        let mut ways = Vec::new();
        for axis in 0..3 {
            let mut finer = self.recipe;
            match axis {
                0 => finer.eccentricity_nodes = 2 * finer.eccentricity_nodes - 1,
                _ if finer.tilt_nodes[axis - 1] == 1 => continue,
                _ => finer.tilt_nodes[axis - 1] = 2 * finer.tilt_nodes[axis - 1] - 1,
            }
            // Of few nodes nothing is known but that they are few.
            let error = match self.axes[axis].count() >= FEWEST && self.axes[axis].count() % 2 == 1
            {
                true => self.error_without(axis)?,
                false => f64::INFINITY,
            };
            ways.push((error, finer));
        }
        ways.sort_by(|a, b| b.0.total_cmp(&a.0));
        Ok(ways.into_iter().map(|(_, finer)| finer).collect())
    }

    /// How far a table with every second node along `axis` is from the others.
    fn error_without(&self, axis: usize) -> Result<f64, DatabaseError> {
        let mut coarser = self.recipe;
        match axis {
            0 => coarser.eccentricity_nodes = coarser.eccentricity_nodes.div_ceil(2),
            _ => coarser.tilt_nodes[axis - 1] = coarser.tilt_nodes[axis - 1].div_ceil(2),
        }
        let axes: [Axis; 3] = coarser.axes()?;
        let (own, shape) = (Shape::of(&self.axes), Shape::of(&axes));
        let places = Places::of(&axes);
        let mut largest = 0.0_f64;
        for (drive, nodes) in Drive::ALL.into_iter().zip(&self.nodes) {
            let left: Vec<_> = (0..shape.nodes())
                .map(|index| {
                    let mut place = shape.place(index);
                    place[axis] *= 2;
                    nodes[own.index(place)]
                })
                .collect();
            let fitted = Fitted::through(drive, &axes, shape, &left, None)?;
            for (index, node) in nodes.iter().enumerate() {
                let place = own.place(index);
                let (eps, tilts) = place_of(&self.axes, place);
                let gap = tilt_box::smallest_gap(eps, tilts[0], tilts[1]);
                if place[axis] % 2 == 0 || gap < self.recipe.smallest_gap {
                    continue;
                }
                let factor = if drive == Drive::Wedge { eps } else { 1.0 };
                let found = fitted
                    .lookup(&Spot::new(&places, eps, tilts), false)
                    .integrals;
                let known = [node[0], node[1], node[2], node[3]];
                largest = largest.max(error_of(found.map(|value| factor * value), known));
            }
        }
        Ok(largest)
    }
}
