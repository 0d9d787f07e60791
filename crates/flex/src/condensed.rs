//! A shaft seen from its bearings: elastic, massless, condensed onto the journals that hold it.
//!
//! Equation: `K d = T f + r`, with the displacements `d` of the journals, the given forces `f` at the
//! places of load and the reactions `r` of the bearings on the journals. `K` is singular: a shaft that
//! nothing holds may move as a rigid body. Reference: R. J. Guyan, AIAA J. 3 (1965) 380,
//! 10.2514/3.2874; without masses the condensation is exact.

use nalgebra::DMatrix;

/// Degrees of freedom of a journal: displacements x, y (m), tilts about x, y (rad).
pub const JOURNAL_FREEDOMS: usize = 4;

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
