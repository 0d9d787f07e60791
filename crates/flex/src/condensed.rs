//! A shaft seen from its bearings: elastic, massless, condensed onto the journals that hold it.
//!
//! Equation: `K d = T f + r`, with the displacements `d` of the journals, the given forces `f` at the
//! places of load and the reactions `r` of the bearings on the journals. From the frame with retained
//! freedoms b (x, y and tilts of the journals) and all others i: `K = K_bb - K_bi K_ii^-1 K_ib`,
//! `T = -K_bi K_ii^-1` in the columns of i. `K` is singular: a shaft that nothing holds may move as a
//! rigid body, twice sideways and twice by tilt. Reference: R. J. Guyan, AIAA J. 3 (1965) 380,
//! 10.2514/3.2874; without masses the condensation is exact.
//!
//! Along the axis and in torsion the frame itself holds the shaft, each at one node on the axis.
//! Bearings and loads have no force along the axis, so that nothing arises at that hold. Torque of the
//! loads leaves where torsion is held: at the drive end, as in the machine. Both holds are statically
//! determinate and add no force across the shaft.

use crate::beam::NODE_FREEDOMS;
use crate::frame::Factored;
use crate::{Frame, FrameError};
use nalgebra::{DMatrix, DVector};

/// Degrees of freedom of a journal: displacements x, y (m), tilts about x, y (rad).
pub const JOURNAL_FREEDOMS: usize = 4;

/// The freedoms of a node that a journal keeps: x, y, rotations about x, y.
const KEPT: [usize; JOURNAL_FREEDOMS] = [0, 1, 3, 4];

/// A shaft condensed onto its journals, in a frame that turns with it (x towards crank angle 0).
#[derive(Debug, Clone, PartialEq)]
pub struct CondensedShaft {
    /// Forces and moments at the journals over their displacements and tilts, `4 n` by `4 n`:
    /// x, y (N/m), tilt about x, y (N m/rad) of journal 1, then of journal 2, ...; symmetric.
    pub stiffness: DMatrix<f64>,
    /// What forces and moments at the places of load put on the journals, `4 n` by `4 m`, places of
    /// load in the same manner as journals.
    pub load_transfer: DMatrix<f64>,
}

impl CondensedShaft {
    /// Condenses `frame` onto the nodes `journals`; `loads` are the nodes of load. A node may be both,
    /// and several loads may share a node.
    ///
    /// # Errors
    /// [`FrameError`] for unknown or repeated nodes, held freedoms of journals, and a frame that moves
    /// without force even when its journals are held.
    pub fn from_frame(
        frame: &Frame,
        journals: &[usize],
        loads: &[usize],
    ) -> Result<Self, FrameError> {
        for (at, node) in journals.iter().enumerate() {
            frame.known(*node)?;
            let is_held = KEPT.iter().any(|freedom| frame.is_held(*node, *freedom));
            if is_held || journals[..at].contains(node) {
                return Err(FrameError::Journal { node: *node });
            }
        }
        for node in loads {
            frame.known(*node)?;
        }
        let kept = freedoms(journals);
        let inner = frame.free_freedoms(&kept);
        let loaded = freedoms(loads);
        let all = frame.stiffness();
        let across = all.select_rows(&inner).select_columns(&kept);
        // movements of the inner freedoms with the kept ones: their transpose carries loads as well
        let moved = Factored::new(&all, &inner)?.solve(&across);
        let mut stiffness = all.select_rows(&kept).select_columns(&kept);
        stiffness -= across.tr_mul(&moved);
        let stiffness = 0.5 * (&stiffness + stiffness.transpose());
        let load_transfer = DMatrix::from_fn(kept.len(), loaded.len(), |row, column| {
            let freedom = loaded[column];
            match inner.binary_search(&freedom) {
                Ok(at) => -moved[(at, row)],
                Err(_) => f64::from(u8::from(kept[row] == freedom)),
            }
        });
        Ok(Self {
            stiffness,
            load_transfer,
        })
    }

    /// How many journals.
    #[must_use]
    pub fn journals(&self) -> usize {
        self.stiffness.nrows() / JOURNAL_FREEDOMS
    }

    /// How many places of load.
    #[must_use]
    pub fn loads(&self) -> usize {
        self.load_transfer.ncols() / JOURNAL_FREEDOMS
    }

    /// Stiffness in the fixed frame when the shaft has turned by `angle` (rad) about z: as
    /// [`Self::stiffness`], with displacements, tilts, forces and moments along the fixed axes.
    #[must_use]
    pub fn stiffness_at(&self, angle: f64) -> DMatrix<f64> {
        let mut turned = self.stiffness.clone();
        turn_rows(&mut turned, angle);
        turned.transpose_mut();
        turn_rows(&mut turned, angle);
        turned
    }

    /// What `forces` (N, fixed frame, in the order of the places of load) put on the journals when the
    /// shaft has turned by `angle` (rad): forces x, y (N) and moments about x, y (N m) of journal 1,
    /// then of journal 2, ..., fixed frame. Forces missing at the end are 0, surplus ones are left out.
    #[must_use]
    pub fn journal_loads(&self, angle: f64, forces: &[[f64; 2]]) -> DVector<f64> {
        let (sin, cos) = angle.sin_cos();
        let mut sum = DMatrix::zeros(self.stiffness.nrows(), 1);
        for (place, [x, y]) in forces.iter().take(self.loads()).enumerate() {
            let first = JOURNAL_FREEDOMS * place;
            let along = [cos * x + sin * y, cos * y - sin * x];
            for (column, force) in (first..).zip(along) {
                sum.column_mut(0)
                    .axpy(force, &self.load_transfer.column(column), 1.0);
            }
        }
        turn_rows(&mut sum, angle);
        sum.column(0).into_owned()
    }
}

/// Turns the pairs of rows of `matrix` from the frame of the shaft into the fixed frame.
fn turn_rows(matrix: &mut DMatrix<f64>, angle: f64) {
    let (sin, cos) = angle.sin_cos();
    for mut column in matrix.column_iter_mut() {
        for pair in 0..column.len() / 2 {
            let (x, y) = (column[2 * pair], column[2 * pair + 1]);
            column[2 * pair] = cos * x - sin * y;
            column[2 * pair + 1] = sin * x + cos * y;
        }
    }
}

/// Freedoms of a frame that the journals at `nodes` keep.
fn freedoms(nodes: &[usize]) -> Vec<usize> {
    nodes
        .iter()
        .flat_map(|node| KEPT.map(|freedom| NODE_FREEDOMS * node + freedom))
        .collect()
}
