//! What can be wrong with a database, and what to do about it.

use sommerfeld_film::FilmError;
use std::path::PathBuf;
use thiserror::Error;

/// Why a database cannot be built, read or used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DatabaseError {
    /// A value of the recipe is outside of what a table can be built for.
    #[error("{key} = {value}: allowed is {allowed}")]
    Recipe {
        /// Which value.
        key: &'static str,
        /// What was given.
        value: String,
        /// What may be given.
        allowed: &'static str,
    },
    /// The film cannot be tabulated.
    #[error("{reason}")]
    Unsupported {
        /// Why, and what to do.
        reason: &'static str,
    },
    /// The flag of the caller was set; what was solved is kept where a path was given.
    #[error("interrupted after {done} of {total} films: build again with the same file to go on")]
    Interrupted {
        /// Films solved.
        done: usize,
        /// Films of this level.
        total: usize,
    },
    /// The table errs more than asked, with all the nodes it may have.
    #[error(
        "the table errs by {reached:.1e} with {nodes} nodes, above the target {target:.1e}: raise \
         the target or lower last_eccentricity"
    )]
    TargetMissed {
        /// Error asked for.
        target: f64,
        /// Error reached.
        reached: f64,
        /// Nodes of the last table.
        nodes: usize,
    },
    /// A film of the table could not be solved.
    #[error(
        "the film at relative eccentricity {eccentricity}, direction {direction_deg} deg, B/D \
         {width_ratio} was not solved"
    )]
    NotSolved {
        /// Relative eccentricity.
        eccentricity: f64,
        /// Direction of the motion from the line of centres, degrees.
        direction_deg: f64,
        /// Width over diameter.
        width_ratio: f64,
    },
    /// A film of a tilted journal could not be solved.
    #[error(
        "the film {drive} at D/B {d_over_b}, relative eccentricity {eccentricity}, gamma {gamma}, delta \
         {delta} was not solved"
    )]
    TiltedNotSolved {
        /// Its drive: D, V or W.
        drive: char,
        /// Diameter over width.
        d_over_b: f64,
        /// Relative eccentricity.
        eccentricity: f64,
        /// Tilt in the plane of the narrowest gap over its largest value.
        gamma: f64,
        /// Tilt across it, as it stands in the gap.
        delta: f64,
    },
    /// The file cannot be read or written.
    #[error("{}: {reason}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system or the format says, and what to do.
        reason: String,
    },
    /// The file is an HDF5 file, but not a database of this kind, or a damaged one.
    #[error("{}: {reason}: build it again (sommerfeld database build)", path.display())]
    Contents {
        /// The file.
        path: PathBuf,
        /// What does not fit.
        reason: String,
    },
    /// A film error on the way.
    #[error(transparent)]
    Film(#[from] FilmError),
}
