//! What do shaft and supports ask of the journals at one crank angle?
//!
//! Equation: `K(theta) (d + o - C F) = f(theta) + F` for the displacements `d` of the journals in their
//! shells, with the film's forces `F` on the journals, the offsets `o` of the bores and the compliance
//! `C` of the supports, whose shells yield by `-C F`.
//! Unknowns are scaled: a tilt counts as the displacement it makes at half the bearing width, a moment
//! as the force it takes there, so that all rows are forces (N) and all columns displacements (m).

use super::film_update::Place;
use super::{CoupledRequest, ShaftForces};
use nalgebra::{DMatrix, DVector};
use sommerfeld_bearing::motion::Coordinates;
use sommerfeld_film::FilmError;
use sommerfeld_flex::{CondensedShaft, JOURNAL_FREEDOMS};

/// Shaft, supports and loads of a run, scaled.
pub(super) struct Structure<'a> {
    shaft: &'a CondensedShaft,
    forces: &'a ShaftForces<'a>,
    compliance: Option<DMatrix<f64>>,
    /// Per freedom: 1 for displacements, 1/arm (1/m) for tilts.
    scale: DVector<f64>,
    /// Where the bores lie, m.
    offsets: DVector<f64>,
}

/// Shaft and loads at one crank angle, scaled.
pub(super) struct Instant {
    /// K, N/m.
    pub stiffness: DMatrix<f64>,
    /// K C, 1; `None` for rigid supports.
    pub coupling: Option<DMatrix<f64>>,
    /// f - K o, N.
    pub loads: DVector<f64>,
    /// Resultant of the given forces, N.
    pub resultant: [f64; 2],
}

impl<'a> Structure<'a> {
    /// # Errors
    /// [`FilmError::Unsupported`] where the sizes of shaft, compliance and journals differ.
    pub(super) fn new(
        request: &CoupledRequest<'a>,
        places: &[Place<'_>],
    ) -> Result<Self, FilmError> {
        let size = JOURNAL_FREEDOMS * places.len();
        let refuse = |reason| Err(FilmError::Unsupported { reason });
        if request.shaft.stiffness.shape() != (size, size) || size == 0 {
            return refuse("the shaft and its bearings differ in number of journals");
        }
        let scale = DVector::from_fn(size, |freedom, _| match freedom % JOURNAL_FREEDOMS {
            0 | 1 => 1.0,
            _ => 1.0 / places[freedom / JOURNAL_FREEDOMS].arm,
        });
        let compliance = match request.compliance {
            Some(given) if given.shape() != (size, size) => {
                return refuse("the compliance of the supports and the bearings differ in number");
            }
            Some(given) if given.iter().any(|value| *value != 0.0) => {
                let scaled = DMatrix::from_fn(size, size, |row, column| {
                    given[(row, column)] / (scale[row] * scale[column])
                });
                Some(scaled)
            }
            _ => None,
        };
        let offsets = DVector::from_fn(size, |freedom, _| match freedom % JOURNAL_FREEDOMS {
            axis @ (0 | 1) => places[freedom / JOURNAL_FREEDOMS].offset[axis],
            _ => 0.0,
        });
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        let given = request.compliance.map_or(&[][..], |c| c.as_slice());
        if !finite(request.shaft.stiffness.as_slice())
            || !finite(given)
            || !finite(offsets.as_slice())
        {
            return refuse("shaft, supports or offsets hold a value that is not finite");
        }
        Ok(Self {
            shaft: request.shaft,
            forces: request.forces,
            compliance,
            scale,
            offsets,
        })
    }

    /// Shaft and loads at a crank angle, rad.
    ///
    /// # Errors
    /// [`FilmError::NotFinite`] for forces that are no numbers.
    pub(super) fn at(&self, crank_angle: f64) -> Result<Instant, FilmError> {
        let mut stiffness = self.shaft.stiffness_at(crank_angle);
        for (column, by) in self.scale.iter().enumerate() {
            stiffness.row_mut(column).scale_mut(*by);
            stiffness.column_mut(column).scale_mut(*by);
        }
        let given = self.given_loads(crank_angle);
        if !given.iter().all(|value| value.is_finite()) {
            return Err(FilmError::NotFinite {
                name: "force on the shaft",
            });
        }
        let sum = |axis| given.iter().skip(axis).step_by(JOURNAL_FREEDOMS).sum();
        let resultant = [sum(0), sum(1)];
        let loads = given.component_mul(&self.scale) - &stiffness * &self.offsets;
        let coupling = self.compliance.as_ref().map(|c| &stiffness * c);
        Ok(Instant {
            stiffness,
            coupling,
            loads,
            resultant,
        })
    }

    /// What the given forces put on the journals, N and N m.
    fn given_loads(&self, crank_angle: f64) -> DVector<f64> {
        let forces = (self.forces)(crank_angle);
        self.shaft.journal_loads(crank_angle, &forces)
    }

    /// Direction of the load on each journal, as far as the given forces alone say it.
    pub(super) fn load_directions(&self, crank_angle: f64) -> Vec<[f64; 2]> {
        let given = self.given_loads(crank_angle);
        let journals = given.as_slice().chunks_exact(JOURNAL_FREEDOMS);
        journals
            .map(|load| {
                let size = load[0].hypot(load[1]);
                if size > 0.0 {
                    [load[0] / size, load[1] / size]
                } else {
                    [0.0; 2]
                }
            })
            .collect()
    }

    /// Scaled coordinates of all journals, m.
    pub(super) fn scaled(&self, positions: &[Coordinates]) -> DVector<f64> {
        DVector::from_iterator(
            self.scale.len(),
            positions
                .iter()
                .flatten()
                .zip(&self.scale)
                .map(|(v, s)| v / s),
        )
    }

    /// Coordinates of each journal (m, rad) from scaled ones.
    pub(super) fn unscaled(&self, scaled: &DVector<f64>) -> Vec<Coordinates> {
        let values = scaled.component_mul(&self.scale);
        let journals = values.as_slice().chunks_exact(JOURNAL_FREEDOMS);
        journals.map(|c| [c[0], c[1], c[2], c[3]]).collect()
    }
}
