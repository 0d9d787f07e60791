//! What is wrong with a shaft or with what holds it.

use sommerfeld_flex::FrameError;
use thiserror::Error;

/// Millimetres per metre, for messages.
const MM: f64 = 1e3;

/// Why a shaft cannot be condensed or supported. Counted from 1 in messages, from 0 in fields.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ShaftError {
    /// A dimension or a material constant out of its range.
    #[error("{name} is {value}: it must be {allowed}")]
    Value {
        /// What it is.
        name: &'static str,
        /// As given, SI.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// Lengths of journal, webs and pins that do not fit the spacing.
    #[error(
        "{from} and {to} lie {:.3} mm apart, but journals, webs and pins between their centres take {:.3} mm: \
         correct main_length, pin_length, the thickness of the web, or the spacing",
        distance * MM, needed * MM
    )]
    LengthsDoNotFit {
        /// Name of the one.
        from: String,
        /// Name of the other.
        to: String,
        /// Distance of their centres, m.
        distance: f64,
        /// What the lengths add up to, m.
        needed: f64,
    },
    /// A rod beside its pin.
    #[error(
        "the rod of cylinder {} at {:.3} mm is not on its pin, which runs from {:.3} to {:.3} mm: \
         correct its axial position or pin_length",
        cylinder + 1, axial * MM, pin[0] * MM, pin[1] * MM
    )]
    OffPin {
        /// Index of the cylinder.
        cylinder: usize,
        /// Axial position of the rod, m.
        axial: f64,
        /// Ends of the pin, m.
        pin: [f64; 2],
    },
    /// A cylinder on a throw that does not exist.
    #[error("cylinder {} works on throw {}, but there are {throws} throws", cylinder + 1, throw + 1)]
    UnknownThrow {
        /// Index of the cylinder.
        cylinder: usize,
        /// Index of the throw.
        throw: usize,
        /// How many there are.
        throws: usize,
    },
    /// Fewer places of force than cylinders.
    #[error(
        "{given} places of force for {needed} cylinders: the rods come first, in order of the cylinders"
    )]
    ForcesMissing {
        /// How many there are.
        given: usize,
        /// How many rods there are.
        needed: usize,
    },
    /// A throw that no web makes as stiff as wanted.
    #[error(
        "{name}: {wanted:e} leaves nothing for the web, journals and pin are softer than that by themselves: \
         shorten pin_length or main_length in favour of the web, or check units"
    )]
    StiffThrow {
        /// Which figure.
        name: &'static str,
        /// What was wanted, N/m or N m/rad.
        wanted: f64,
    },
    /// A bearing or a force beside the shaft.
    #[error("{what} {} at {:.3} mm is not on the shaft, which runs from 0 to {:.3} mm", index + 1, axial * MM, length * MM)]
    OffShaft {
        /// Bearing, unbalance or load.
        what: &'static str,
        /// Its index.
        index: usize,
        /// Its axial position, m.
        axial: f64,
        /// Length of the shaft, m.
        length: f64,
    },
    /// Axial positions that do not ascend.
    #[error("axial positions of the {what} must ascend: number {} does not lie beyond the one before it", index + 1)]
    NotAscending {
        /// Bearings, mains or throws.
        what: &'static str,
        /// The one that does not.
        index: usize,
    },
    /// Too few bearings for what is asked.
    #[error("{given} bearings: {needed} are needed at least")]
    TooFewBearings {
        /// How many there are.
        given: usize,
        /// How many are needed.
        needed: usize,
    },
    /// A matrix of supports of the wrong size.
    #[error(
        "the matrix of the supports has {given} values: {bearings} bearings need {needed}, 4 rows and 4 columns each"
    )]
    SupportSize {
        /// How many values there are.
        given: usize,
        /// How many bearings there are.
        bearings: usize,
        /// How many values they need.
        needed: usize,
    },
    /// A matrix of supports that is not symmetric.
    #[error(
        "stiffness of the supports is not symmetric: {value:e} in row {}, column {}, {mirrored:e} across the diagonal",
        row + 1, column + 1
    )]
    SupportSymmetry {
        /// Row of the largest difference.
        row: usize,
        /// Column of it.
        column: usize,
        /// Value there.
        value: f64,
        /// Value across the diagonal.
        mirrored: f64,
    },
    /// Supports that push where they are pressed, or do not hold at all.
    #[error(
        "stiffness of the supports is not positive definite: some movement of the shells meets no resistance; check signs, units and the order x, y, tilt x, tilt y"
    )]
    SupportSign,
    /// Offsets for another number of bearings.
    #[error("{given} offsets for {bearings} bearings: give one for each or none")]
    Offsets {
        /// How many there are.
        given: usize,
        /// How many bearings there are.
        bearings: usize,
    },
    /// A shaft that can move without force.
    #[error("the shaft can move without force on its bearings")]
    Loose,
    /// The frame of beams that stands for the shaft.
    #[error("beams of the shaft: {0}")]
    Frame(#[from] FrameError),
}

/// An error unless `value` is positive and finite.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), ShaftError> {
    within(name, value, value > 0.0, "positive")
}

/// An error unless `value` is finite and `is_allowed`.
pub(crate) fn within(
    name: &'static str,
    value: f64,
    is_allowed: bool,
    allowed: &'static str,
) -> Result<(), ShaftError> {
    if value.is_finite() && is_allowed {
        return Ok(());
    }
    Err(ShaftError::Value {
        name,
        value,
        allowed,
    })
}

/// An error unless `positions` are finite and ascend.
pub(crate) fn ascending(
    what: &'static str,
    positions: impl Iterator<Item = f64>,
) -> Result<(), ShaftError> {
    let mut before = f64::NEG_INFINITY;
    for (index, position) in positions.enumerate() {
        if !position.is_finite() || position <= before {
            return Err(ShaftError::NotAscending { what, index });
        }
        before = position;
    }
    Ok(())
}
