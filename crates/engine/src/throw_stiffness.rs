//! How stiff is one throw?
//!
//! One throw between two mains, as the crankshaft has it, under the loads by which throws are compared
//! with finite elements or on a rig; webs are fitted to these figures. A link of a torsional chain, from
//! throw to throw, lies between the two torsional figures. Mains that are hinged but do not yield leave
//! the free one as it is: on two hinges a torque alone calls no force across the shaft.

use crate::crank_frame::CrankFrame;
use crate::{CrankshaftShape, ShaftError, Throw, Web};
use sommerfeld_flex::{Frame, NodeLoad};

/// Stiffnesses of one throw between the centres of two neighbouring mains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThrowStiffness {
    /// Force in the middle of the pin along the throw over its displacement, mains hinged, N/m.
    pub bending_in_plane: f64,
    /// Force in the middle of the pin across the throw over its displacement, mains hinged and neither
    /// turning about the axis of the shaft, N/m.
    pub bending_across: f64,
    /// Torque over the twist between the mains, one main clamped and the other free, N m/rad.
    pub torsion_free: f64,
    /// The same with both mains held in position and tilt, N m/rad.
    pub torsion_held: f64,
}

/// Stiffness of one throw of a crankshaft of `shape` with `crank_radius` (m).
///
/// # Errors
/// [`ShaftError`] for dimensions out of range.
pub fn throw_stiffness(
    shape: &CrankshaftShape,
    crank_radius: f64,
) -> Result<ThrowStiffness, ShaftError> {
    let (Web::Bar { thickness, .. } | Web::Fitted { thickness, .. }) = shape.web;
    let reach = 0.5 * (shape.main_length + shape.pin_length) + thickness;
    let throw = Throw {
        angle: 0.0,
        axial: 0.0,
    };
    let mut crank = CrankFrame::new(&[-reach, reach], &[throw], crank_radius, shape)?;
    crank.build(shape)?;
    let pin = crank.pin_node(0, 0.0);
    let CrankFrame { frame, mains, .. } = crank;
    let [front, rear] = [mains[0], mains[1]];
    let hinge = [
        [front, 0],
        [front, 1],
        [rear, 0],
        [rear, 1],
        [rear, 2],
        [rear, 5],
    ];
    let clamp = [0, 1, 2, 3, 4, 5].map(|freedom| [rear, freedom]);
    let untwisted = [&hinge[..], &[[front, 5]]].concat();
    let straight = [
        &clamp[..],
        &[[front, 0], [front, 1], [front, 3], [front, 4]],
    ]
    .concat();
    Ok(ThrowStiffness {
        bending_in_plane: stiffness(&frame, &hinge, pin, 0)?,
        bending_across: stiffness(&frame, &untwisted, pin, 1)?,
        torsion_free: stiffness(&frame, &clamp, front, 5)?,
        torsion_held: stiffness(&frame, &straight, front, 5)?,
    })
}

/// Unit load in a freedom of a node over its displacement there.
fn stiffness(
    frame: &Frame,
    held: &[[usize; 2]],
    node: usize,
    freedom: usize,
) -> Result<f64, ShaftError> {
    let mut frame = frame.clone();
    for [at, which] in held {
        frame.hold(*at, *which)?;
    }
    let mut load = [0.0; 6];
    load[freedom] = 1.0;
    let moved = frame.solve(&[NodeLoad { node, load }])?;
    Ok(1.0 / moved[node][freedom])
}
