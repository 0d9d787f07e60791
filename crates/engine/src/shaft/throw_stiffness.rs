//! How stiff is one throw?
//!
//! One throw between two mains, as the crankshaft has it, under the loads by which throws are compared
//! with finite elements or on a rig; webs are fitted to these figures. A link of a torsional chain, from
//! throw to throw, lies between the two torsional figures. Mains that are hinged but do not yield leave
//! the free one as it is: on two hinges a torque alone calls no force across the shaft.

use super::crank_frame::CrankFrame;
use super::error::positive;
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

/// The web with which a throw of `shape` with `crank_radius` (m) has the stiffnesses `target`: those in
/// bending and with one main free; the held one follows. The web of `shape` gives the thickness alone.
///
/// Flexibilities of a throw are sums over its members, so that each unknown of the web stands alone in one
/// of them, given those before it: torsion, then bending in the plane, then bending across it.
///
/// # Errors
/// [`ShaftError`] for dimensions out of range, and for a throw that is softer with rigid webs than wanted.
pub fn fitted_web(
    shape: &CrankshaftShape,
    crank_radius: f64,
    target: &ThrowStiffness,
) -> Result<Web, ShaftError> {
    let (Web::Bar { thickness, .. } | Web::Fitted { thickness, .. }) = shape.web;
    // any web will do to begin with: what it adds is known and taken off again
    let begin = shape.youngs_modulus * shape.pin_diameter.powi(4);
    let mut trial = shape.clone();
    trial.web = Web::Fitted {
        thickness,
        bending_in_plane: begin,
        bending_across: begin,
        torsion: begin,
    };
    let found = throw_stiffness(&trial, crank_radius)?;
    let arm = 0.5 * (shape.main_length + thickness);
    let unknown = |name, wanted: f64, found: f64, share: f64, known: f64| {
        positive(name, wanted)?;
        let flexibility = 1.0 / begin + (1.0 / wanted - 1.0 / found - known) / share;
        if flexibility > 0.0 {
            return Ok(1.0 / flexibility);
        }
        Err(ShaftError::StiffThrow { name, wanted })
    };
    let bending_across = unknown(
        "stiffness of the throw in torsion",
        target.torsion_free,
        found.torsion_free,
        2.0 * crank_radius,
        0.0,
    )?;
    // bending by the force times the arm, and stretching with E A = 12 E I / thickness^2
    let bending_in_plane = unknown(
        "stiffness of the throw in its plane",
        target.bending_in_plane,
        found.bending_in_plane,
        crank_radius * (arm * arm / 2.0 + thickness * thickness / 24.0),
        0.0,
    )?;
    let torsion = unknown(
        "stiffness of the throw across its plane",
        target.bending_across,
        found.bending_across,
        crank_radius * arm * arm / 2.0,
        crank_radius.powi(3) / 6.0 * (1.0 / bending_across - 1.0 / begin),
    )?;
    Ok(Web::Fitted {
        thickness,
        bending_in_plane,
        bending_across,
        torsion,
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
