//! Beams and frames against closed forms, and identities of any elastic body.
#![allow(clippy::unwrap_used)]

use sommerfeld_flex::{CondensedShaft, Frame, FrameError, Material, NodeLoad, Section};

const STEEL: Material = Material {
    youngs_modulus: 210e9,
    poissons_ratio: 0.3,
};

fn close(found: f64, exact: f64, bar: f64, what: &str) {
    let error = (found / exact - 1.0).abs();
    assert!(error < bar, "{what}: {found} {exact} {error:e}");
}

fn clamp(frame: &mut Frame, node: usize) {
    for freedom in 0..6 {
        frame.hold(node, freedom).unwrap();
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// A shaft with a throw out of every symmetry.
fn crank() -> (Frame, Vec<usize>) {
    let mut frame = Frame::new();
    let journal = Section::circle(&STEEL, 0.06, 0.01);
    let web = Section::rectangle(&STEEL, 0.02, 0.08);
    let (x, y) = (0.04, 0.025);
    let places = [
        [0.0, 0.0, -0.02],
        [0.0, 0.0, 0.03],
        [x, y, 0.03],
        [x, y, 0.055],
        [x, y, 0.08],
        [0.0, 0.0, 0.08],
        [0.0, 0.0, 0.12],
    ];
    let nodes: Vec<usize> = places.map(|place| frame.add_node(place)).to_vec();
    for ends in nodes.windows(2) {
        let is_web = (places[ends[0]][2] - places[ends[1]][2]).abs() < 1e-12;
        let (section, across) = if is_web {
            (web, [0.0, 0.0, 1.0])
        } else {
            (journal, [1.0, 0.0, 0.0])
        };
        frame.add_beam([ends[0], ends[1]], section, across).unwrap();
    }
    (frame, nodes)
}

#[test]
fn a_cantilever_bends_and_shears_in_every_direction() {
    let length = 0.3;
    let section = Section::rectangle(&STEEL, 0.02, 0.05);
    // local x, y, z of the beam in the frame
    let along = [2.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0];
    let y = [-2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0];
    let z = cross(along, y);
    let mut frame = Frame::new();
    let root = frame.add_node([0.1, -0.2, 0.4]);
    let tip = frame.add_node([0, 1, 2].map(|k| [0.1, -0.2, 0.4][k] + length * along[k]));
    // an orientation that lies in the plane of local x and y but not along y
    let across = [0, 1, 2].map(|k| 3.0 * y[k] + along[k]);
    frame.add_beam([root, tip], section, across).unwrap();
    clamp(&mut frame, root);
    let [about_y, about_z] = section.bending;
    let force = 1e4;
    for (direction, bending, shear) in [
        (y, about_z, section.shear_flexibility[0]),
        (z, about_y, section.shear_flexibility[1]),
    ] {
        let [fx, fy, fz] = direction.map(|d| force * d);
        let load = NodeLoad {
            node: tip,
            load: [fx, fy, fz, 0.0, 0.0, 0.0],
        };
        let moved = frame.solve(&[load]).unwrap()[tip];
        let part = |v: [f64; 3], first: usize| (0..3).map(|k| v[k] * moved[first + k]).sum::<f64>();
        let exact = force * length.powi(3) / (3.0 * bending) + force * length * shear;
        close(part(direction, 0), exact, 1e-12, "deflection");
        let slope = force * length * length / (2.0 * bending);
        close(part(cross(along, direction), 3), slope, 1e-12, "slope");
        assert!(part(along, 0).abs() < 1e-12 * exact);
    }
    let load = [along, along.map(|a| 0.5 * a)].concat();
    let load: [f64; 6] = load.try_into().unwrap();
    let moved = frame.solve(&[NodeLoad { node: tip, load }]).unwrap()[tip];
    let part = |first: usize| (0..3).map(|k| along[k] * moved[first + k]).sum::<f64>();
    close(part(0), length / section.axial, 1e-12, "stretch");
    close(part(3), 0.5 * length / section.torsion, 1e-12, "twist");
}

#[test]
fn an_angle_frame_bends_and_twists_as_castigliano_says() {
    // leg 1 along z from a clamp, leg 2 along x; force across both at the free end, then along leg 1
    let (one, other, force) = (0.2, 0.15, 500.0);
    let shaft = Section::circle(&STEEL, 0.03, 0.0);
    let web = Section::rectangle(&STEEL, 0.02, 0.05);
    let mut frame = Frame::new();
    let nodes = [[0.0, 0.0, 0.0], [0.0, 0.0, one], [other, 0.0, one]]
        .map(|position| frame.add_node(position));
    frame
        .add_beam([nodes[0], nodes[1]], shaft, [1.0, 0.0, 0.0])
        .unwrap();
    // local y of the web along z: thickness along the shaft, width across
    frame
        .add_beam([nodes[1], nodes[2]], web, [0.0, 0.0, 1.0])
        .unwrap();
    clamp(&mut frame, nodes[0]);
    let at_end = |load| NodeLoad {
        node: nodes[2],
        load,
    };
    let [wide, flat] = web.bending;
    // out of the plane: bending of both legs, torsion of the first, shear of both
    let moved = frame
        .solve(&[at_end([0.0, force, 0.0, 0.0, 0.0, 0.0])])
        .unwrap()[nodes[2]];
    let exact = force
        * (one.powi(3) / (3.0 * shaft.bending[0])
            + one * shaft.shear_flexibility[0]
            + other.powi(3) / (3.0 * wide)
            + other * web.shear_flexibility[1]
            + other * other * one / shaft.torsion);
    close(moved[1], exact, 1e-12, "out of plane");
    // in the plane, along z: the second leg bends, the first bends by a couple and stretches
    let moved = frame
        .solve(&[at_end([0.0, 0.0, force, 0.0, 0.0, 0.0])])
        .unwrap()[nodes[2]];
    let exact = force
        * (other.powi(3) / (3.0 * flat)
            + other * web.shear_flexibility[0]
            + other * other * one / shaft.bending[0]
            + one / shaft.axial);
    close(moved[2], exact, 1e-12, "in plane");
}

#[test]
fn rigid_movements_cost_no_force() {
    let (frame, nodes) = crank();
    let stiffness = frame.stiffness();
    let largest = stiffness.amax();
    for mode in 0..6 {
        let mut unit = [0.0; 6];
        unit[mode] = 1.0;
        let turn = [unit[3], unit[4], unit[5]];
        let mut movement = nalgebra::DVector::zeros(6 * nodes.len());
        for node in &nodes {
            let shift = cross(turn, frame.nodes()[*node]);
            for k in 0..3 {
                movement[6 * node + k] = unit[k] + shift[k];
                movement[6 * node + 3 + k] = turn[k];
            }
        }
        let force = (&stiffness * movement).amax();
        assert!(
            force < 1e-14 * largest,
            "mode {mode}: {force:e} {largest:e}"
        );
    }
}

#[test]
fn a_frame_that_moves_freely_is_refused_by_node() {
    let (mut frame, nodes) = crank();
    assert!(frame.solve(&[]).is_err());
    for freedom in 0..5 {
        frame.hold(nodes[0], freedom).unwrap();
    }
    let free = frame.solve(&[]);
    assert!(
        matches!(free, Err(FrameError::LooseNode { .. } | FrameError::Loose)),
        "{free:?}"
    );
    frame.hold(nodes[0], 5).unwrap();
    assert!(frame.solve(&[]).is_ok());
    let lone = frame.add_node([1.0, 0.0, 0.0]);
    assert_eq!(
        frame.solve(&[]),
        Err(FrameError::LooseNode {
            node: lone,
            freedom: 0
        })
    );
}

#[test]
fn beams_without_length_or_stiffness_are_refused() {
    let (mut frame, nodes) = crank();
    let section = Section::circle(&STEEL, 0.03, 0.0);
    let ends = [nodes[0], nodes[0]];
    let refused = frame.add_beam(ends, section, [1.0, 0.0, 0.0]);
    assert_eq!(refused, Err(FrameError::Beam { ends }));
    let ends = [nodes[0], nodes[1]];
    let parallel = frame.add_beam(ends, section, [0.0, 0.0, 1.0]);
    assert_eq!(parallel, Err(FrameError::Beam { ends }));
    let hollow = Section::circle(&STEEL, 0.03, 0.04);
    let refused = frame.add_beam(ends, hollow, [1.0, 0.0, 0.0]);
    assert_eq!(refused, Err(FrameError::Beam { ends }));
    let nowhere = frame.add_beam([0, 99], section, [1.0, 0.0, 0.0]);
    assert_eq!(nowhere, Err(FrameError::Node { node: 99, nodes: 7 }));
    assert!(frame.hold(0, 6).is_err());
    assert!(CondensedShaft::from_frame(&frame, &[0, 0], &[]).is_err());
}

#[test]
fn flexibility_is_symmetric() {
    // the work of one load along the displacement of another is mutual
    let (mut frame, nodes) = crank();
    clamp(&mut frame, nodes[0]);
    let solve = |node: usize, freedom: usize| {
        let mut load = [0.0; 6];
        load[freedom] = 1.0;
        frame.solve(&[NodeLoad { node, load }]).unwrap()
    };
    for (a, b) in [([6, 0], [3, 1]), ([3, 1], [5, 5]), ([2, 2], [6, 4])] {
        let (there, back) = (solve(a[0], a[1])[b[0]][b[1]], solve(b[0], b[1])[a[0]][a[1]]);
        assert!(there.abs() > 1e-14);
        close(there, back, 1e-10, "mutual");
    }
}
