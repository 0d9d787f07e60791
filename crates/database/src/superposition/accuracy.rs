//! How far are the tables from films at random states between their nodes?
//!
//! States are spread evenly over the places of the axes where the gap is open enough. Their films have a quarter
//! more cells each way than those of the nodes, so that the errors of both show.

use super::build::{BATCH, Progress, place_of, solve_film};
use super::grid::Shape;
use super::{Drive, SuperpositionRecipe, SuperpositionTable, tilt_box};
use crate::axis::Axis;
use crate::error::DatabaseError;
use rayon::prelude::*;

/// Hears how many errors are known, and the errors; its own error ends the measurement.
type Seen<'a> = dyn FnMut(usize, &[f64]) -> Result<(), DatabaseError> + 'a;

/// A random state is solved on more cells: of all films it counts as so many.
pub(super) const WEIGHT: usize = 2;

/// How far the looked up integrals are from those of films solved directly, at random states of a drive: the
/// larger of the error of the force vector over itself and of the moment vector over the larger of itself
/// and a tenth of the force.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Accuracy {
    /// States.
    pub samples: usize,
    /// Largest error.
    pub largest: f64,
    /// Error that 99.9 % of the states do not exceed.
    pub of_999: f64,
    /// Error that half of the states do not exceed.
    pub median: f64,
    /// Largest estimated error of a film at a node whose gap is above that of the states, before its
    /// extrapolation.
    pub node_error: f64,
    /// Eccentricity and tilts along and across of the state that errs most.
    pub worst: [f64; 3],
}

impl SuperpositionTable {
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
        /// So that no seed draws the states of the generation.
        const OTHERS: u64 = 0x9A3C_5D71_0B2E_4F86;
        let recipe = SuperpositionRecipe {
            samples: samples_of_each,
            seed: seed ^ OTHERS,
            ..self.recipe
        };
        let states = samples(&recipe, &self.axes);
        let mut errors = vec![f64::NAN; states.len()];
        self.measure(
            &states,
            &mut errors,
            &mut |done, _| match progress(done, states.len()) {
                true => Ok(()),
                false => Err(DatabaseError::Interrupted {
                    done,
                    total: states.len(),
                }),
            },
        )?;
        Ok(self.accuracy_of(&states, &errors))
    }

    /// Solves the films of `samples` whose error is not a number yet. `seen` hears of every batch how many are
    /// known, and the errors.
    pub(super) fn measure(
        &self,
        samples: &[Sample],
        errors: &mut [f64],
        seen: &mut Seen<'_>,
    ) -> Result<(), DatabaseError> {
        let open: Vec<usize> = (0..samples.len()).filter(|k| errors[*k].is_nan()).collect();
        let mut done = samples.len() - open.len();
        for batch in open.chunks(BATCH) {
            let found: Result<Vec<_>, _> = (batch.par_iter())
                .map(|k| self.error_at(&samples[*k]))
                .collect();
            for (k, error) in batch.iter().zip(found?) {
                errors[*k] = error;
            }
            done += batch.len();
            seen(done, errors)?;
        }
        Ok(())
    }

    /// Errors put in order.
    pub(super) fn accuracy_of(&self, samples: &[Sample], errors: &[f64]) -> [Accuracy; 3] {
        Drive::ALL.map(|drive| {
            let of_drive = samples
                .iter()
                .zip(errors)
                .filter(|(sample, _)| sample.drive == drive);
            let mut sorted: Vec<(&Sample, f64)> =
                of_drive.map(|(sample, error)| (sample, *error)).collect();
            sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
            let of_share = |share: f64| {
                let rank = (share * sorted.len() as f64).ceil() as usize;
                let found = sorted.get(rank.max(1) - 1);
                found.map_or(0.0, |(_, error)| *error)
            };
            Accuracy {
                samples: sorted.len(),
                largest: of_share(1.0),
                of_999: of_share(0.999),
                median: of_share(0.5),
                node_error: self.node_error(drive),
                worst: sorted.last().map_or([0.0; 3], |(sample, _)| {
                    [sample.eps, sample.tilts[0], sample.tilts[1]]
                }),
            }
        })
    }

    /// Error at a state whose film is solved on a quarter more cells than those of the nodes.
    fn error_at(&self, sample: &Sample) -> Result<f64, DatabaseError> {
        // A multiple of 4 whatever multiple of 8 the grid is.
        let finer = self.recipe.grid.map(|cells| 4 * (5 * cells).div_ceil(16));
        self.error_against(sample, finer)
    }

    /// Error at a state whose film is solved on `grid`.
    pub(super) fn error_against(
        &self,
        sample: &Sample,
        grid: [usize; 2],
    ) -> Result<f64, DatabaseError> {
        let Sample { drive, eps, tilts } = *sample;
        let direct = solve_film(&self.recipe, drive, eps, tilts, grid)?.integrals;
        let factor = if drive == Drive::Wedge { eps } else { 1.0 };
        let found = (self.lookup(drive, eps, tilts).integrals).map(|value| factor * value);
        Ok(error_of(
            found,
            [direct.p_cos, direct.p_sin, direct.p_z_cos, direct.p_z_sin],
        ))
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

/// The larger of the error of the force over itself and of the moment over the larger of itself and a tenth of
/// the force; integrals as in [`super::Looked`].
pub(super) fn error_of(found: [f64; 4], direct: [f64; 4]) -> f64 {
    let force = direct[0].hypot(direct[1]);
    let moment = direct[2].hypot(direct[3]).max(0.1 * force);
    let of_force = (found[0] - direct[0]).hypot(found[1] - direct[1]) / force;
    let of_moment = (found[2] - direct[2]).hypot(found[3] - direct[3]) / moment;
    of_force.max(of_moment)
}

/// A state between the nodes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub drive: Drive,
    pub eps: f64,
    pub tilts: [f64; 2],
}

/// Random states, evenly spread over the places of the axes, where the gap is open enough. The same for the
/// same recipe.
pub(super) fn samples(recipe: &SuperpositionRecipe, axes: &[Axis; 3]) -> Vec<Sample> {
    /// A share of states that is never as small as this one finds none.
    const TRIES: usize = 1000;
    let mut random = SplitMix { state: recipe.seed };
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
