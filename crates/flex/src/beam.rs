//! With what forces does a beam answer the movements of its ends?
//!
//! Timoshenko's beam of one section: bending and shear deflections add, `phi = 12 E I / (kappa G A
//! L^2)` is their ratio. Its stiffness matrix is exact for loads at its ends, so that a frame needs
//! nodes only where sections, supports or loads are.
//!
//! Freedoms of an end: displacements along x, y, z, rotations about x, y, z.
//! Assumptions: small displacements, linear elastic, no warping of the ends hindered.
//! Reference: J. S. Przemieniecki, Theory of Matrix Structural Analysis (1968), section 5.6.

use crate::Section;
use nalgebra::{Matrix3, SMatrix, Vector3};

/// Freedoms of a node.
pub const NODE_FREEDOMS: usize = 6;
/// Freedoms of a beam: both ends.
const BEAM_FREEDOMS: usize = 2 * NODE_FREEDOMS;

/// Stiffness of a beam over the freedoms of its first, then of its second end.
pub type BeamStiffness = SMatrix<f64, BEAM_FREEDOMS, BEAM_FREEDOMS>;

/// Stiffness in the local axes of a beam of `length` (m): x from its first to its second end, y and z
/// as in [`Section`].
#[must_use]
pub fn local_stiffness(section: &Section, length: f64) -> BeamStiffness {
    let mut stiffness = BeamStiffness::zeros();
    add_spring(&mut stiffness, 0, section.axial / length);
    add_spring(&mut stiffness, 3, section.torsion / length);
    let [about_y, about_z] = section.bending;
    let [along_y, along_z] = section.shear_flexibility;
    // a positive rotation about z raises y along the beam, one about y lowers z
    add_bending(&mut stiffness, [1, 5], 1.0, about_z, along_y, length);
    add_bending(&mut stiffness, [2, 4], -1.0, about_y, along_z, length);
    stiffness
}

/// Stiffness in the axes of the frame of a beam along `span` (m, not 0); `across` lies in the plane of
/// local x and y.
///
/// Returns `None` where `span` is 0 or parallel to `across`.
#[must_use]
pub fn stiffness(section: &Section, span: [f64; 3], across: [f64; 3]) -> Option<BeamStiffness> {
    let (span, across) = (Vector3::from(span), Vector3::from(across));
    let along = span.try_normalize(0.0)?;
    let normal = along.cross(&across.try_normalize(0.0)?);
    // parallel to within 1e-6 rad: the section would have no orientation
    let normal = normal.try_normalize(1e-6)?;
    let axes = Matrix3::from_columns(&[along, normal.cross(&along), normal]);
    let mut turn = BeamStiffness::zeros();
    for block in 0..4 {
        turn.fixed_view_mut::<3, 3>(3 * block, 3 * block)
            .copy_from(&axes);
    }
    Some(turn * local_stiffness(section, span.norm()) * turn.transpose())
}

fn add_spring(stiffness: &mut BeamStiffness, freedom: usize, value: f64) {
    let ends = [freedom, freedom + NODE_FREEDOMS];
    for (row, row_sign) in ends.into_iter().zip([1.0, -1.0]) {
        for (column, sign) in ends.into_iter().zip([1.0, -1.0]) {
            stiffness[(row, column)] = row_sign * sign * value;
        }
    }
}

/// Bending in one plane: `freedoms` deflection and rotation, `sign` that of the rotation as the slope.
fn add_bending(
    stiffness: &mut BeamStiffness,
    [deflection, rotation]: [usize; 2],
    sign: f64,
    bending: f64,
    shear_flexibility: f64,
    length: f64,
) {
    let phi = 12.0 * bending * shear_flexibility / (length * length);
    let unit = bending / (length * (1.0 + phi));
    let (arm, near, far) = (6.0 * sign * unit / length, 4.0 + phi, 2.0 - phi);
    let force = 12.0 * unit / (length * length);
    let rows = [
        [force, arm, -force, arm],
        [arm, near * unit, -arm, far * unit],
        [-force, -arm, force, -arm],
        [arm, far * unit, -arm, near * unit],
    ];
    let places = [
        deflection,
        rotation,
        deflection + NODE_FREEDOMS,
        rotation + NODE_FREEDOMS,
    ];
    for (row, values) in places.into_iter().zip(rows) {
        for (column, value) in places.into_iter().zip(values) {
            stiffness[(row, column)] = value;
        }
    }
}
