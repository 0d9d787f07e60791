//! How do the shells of a shaft yield, and what does each carry when no film is between?
//!
//! Equations: shells `s = C l` under the loads `l` of the journals; journals pinned to their shells,
//! free to tilt: `K d = T f - E l`, `E^T d = offset + C l` with `E` the positions among the freedoms.
//! A linear reference for the coupled calculation with films, and the classical continuous beam.
//! Limits: no clearance, bearings that pull as well as push.

use crate::{ShaftError, Supports};
use nalgebra::{Cholesky, DMatrix, DVector};
use sommerfeld_flex::{CondensedShaft, JOURNAL_FREEDOMS};

/// Largest asymmetry of a stiffness relative to its diagonal that still counts as rounding of a file.
const SYMMETRY: f64 = 1e-4;

/// What each support of a shaft without films carries, and how the journals lie.
#[derive(Debug, Clone, PartialEq)]
pub struct SupportReactions {
    /// Force of each journal on its support, N, fixed frame.
    pub loads: Vec<[f64; 2]>,
    /// Positions of the journals against the common line, m, fixed frame.
    pub positions: Vec<[f64; 2]>,
    /// Tilts of the journals about x and y, rad, fixed frame.
    pub tilts: Vec<[f64; 2]>,
}

impl Supports {
    /// Displacements and tilts of the shells of `bearings` bearings over the forces and moments on
    /// them, `4 n` by `4 n`, in the order of [`CondensedShaft::stiffness`]; 0 where they do not move.
    ///
    /// # Errors
    /// [`ShaftError`] for a stiffness of the wrong size, that is not symmetric or not positive definite.
    pub fn compliance(&self, bearings: usize) -> Result<DMatrix<f64>, ShaftError> {
        let size = JOURNAL_FREEDOMS * bearings;
        match self {
            Self::Rigid => Ok(DMatrix::zeros(size, size)),
            Self::Each {
                stiffness,
                tilt_stiffness,
            } => {
                let shift = inverted(pair(stiffness))?;
                let tilt = tilt_stiffness
                    .map(|stiffness| inverted(pair(&stiffness)))
                    .transpose()?
                    .unwrap_or_else(|| DMatrix::zeros(2, 2));
                let mut compliance = DMatrix::zeros(size, size);
                for first in (0..size).step_by(JOURNAL_FREEDOMS) {
                    compliance
                        .view_mut((first, first), (2, 2))
                        .copy_from(&shift);
                    compliance
                        .view_mut((first + 2, first + 2), (2, 2))
                        .copy_from(&tilt);
                }
                Ok(compliance)
            }
            Self::Matrix(values) => {
                if values.len() != size * size {
                    return Err(ShaftError::SupportSize {
                        given: values.len(),
                        bearings,
                        needed: size * size,
                    });
                }
                inverted(DMatrix::from_row_slice(size, size, values))
            }
        }
    }
}

/// What the supports of a shaft carry without films when it has turned by `angle` (rad), its journals
/// pinned to shells that stand at `offsets` (m, fixed frame, none for 0) and yield as `supports` say;
/// `forces` (N, fixed frame) in the order of its places of load.
///
/// # Errors
/// [`ShaftError`] for fewer than two bearings, offsets of another number, and unfit supports.
pub fn support_reactions(
    shaft: &CondensedShaft,
    supports: &Supports,
    angle: f64,
    forces: &[[f64; 2]],
    offsets: &[[f64; 2]],
) -> Result<SupportReactions, ShaftError> {
    let bearings = shaft.journals();
    if bearings < 2 {
        return Err(ShaftError::TooFewBearings {
            given: bearings,
            needed: 2,
        });
    }
    if !offsets.is_empty() && offsets.len() != bearings {
        return Err(ShaftError::Offsets {
            given: offsets.len(),
            bearings,
        });
    }
    let compliance = supports.compliance(bearings)?;
    let stiffness = shaft.stiffness_at(angle);
    let size = stiffness.nrows();
    let places: Vec<usize> = (0..size).filter(|k| k % JOURNAL_FREEDOMS < 2).collect();
    // forces counted in units of the stiffness, so that rows of both kinds have like size
    let scale: DVector<f64> = stiffness.diagonal().map(f64::sqrt);
    let mut matrix = DMatrix::zeros(size + places.len(), size + places.len());
    let mut right = DVector::zeros(size + places.len());
    let loads = shaft.journal_loads(angle, forces);
    for row in 0..size {
        right[row] = loads[row] / scale[row];
        for column in 0..size {
            matrix[(row, column)] = stiffness[(row, column)] / (scale[row] * scale[column]);
        }
    }
    for (at, place) in places.iter().enumerate() {
        let row = size + at;
        matrix[(*place, row)] = 1.0;
        matrix[(row, *place)] = 1.0;
        right[row] = scale[*place] * offsets.get(at / 2).map_or(0.0, |offset| offset[at % 2]);
        for (to, other) in places.iter().enumerate() {
            matrix[(row, size + to)] =
                -compliance[(*place, *other)] * scale[*place] * scale[*other];
        }
    }
    let answer = matrix.full_piv_lu().solve(&right);
    let answer = answer.filter(|values| values.iter().all(|value| value.is_finite()));
    let answer = answer.ok_or(ShaftError::Loose)?;
    let moved = |k: usize| answer[k] / scale[k];
    let load = |at: usize| answer[size + at] * scale[places[at]];
    let each = 0..bearings;
    Ok(SupportReactions {
        loads: each
            .clone()
            .map(|n| [load(2 * n), load(2 * n + 1)])
            .collect(),
        positions: each
            .clone()
            .map(|n| [moved(4 * n), moved(4 * n + 1)])
            .collect(),
        tilts: each.map(|n| [moved(4 * n + 2), moved(4 * n + 3)]).collect(),
    })
}

fn pair(rows: &[[f64; 2]; 2]) -> DMatrix<f64> {
    DMatrix::from_fn(2, 2, |row, column| rows[row][column])
}

/// Inverse of a symmetric, positive definite stiffness.
fn inverted(stiffness: DMatrix<f64>) -> Result<DMatrix<f64>, ShaftError> {
    let size = stiffness.nrows();
    let scale = stiffness.diagonal().map(|value| 1.0 / value.sqrt());
    if scale.iter().any(|value| !value.is_finite()) {
        return Err(ShaftError::SupportSign);
    }
    for row in 0..size {
        for column in 0..row {
            let (value, mirrored) = (stiffness[(row, column)], stiffness[(column, row)]);
            let off = (value - mirrored).abs() * scale[row] * scale[column];
            if !off.is_finite() || off > SYMMETRY {
                return Err(ShaftError::SupportSymmetry {
                    row,
                    column,
                    value,
                    mirrored,
                });
            }
        }
    }
    let scaled = DMatrix::from_fn(size, size, |row, column| {
        0.5 * (stiffness[(row, column)] + stiffness[(column, row)]) * scale[row] * scale[column]
    });
    let inverse = Cholesky::new(scaled)
        .ok_or(ShaftError::SupportSign)?
        .inverse();
    Ok(DMatrix::from_fn(size, size, |row, column| {
        inverse[(row, column)] * scale[row] * scale[column]
    }))
}
