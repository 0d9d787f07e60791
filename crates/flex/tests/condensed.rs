//! The condensed shaft against the frame it stands for.
#![allow(clippy::unwrap_used)]

use nalgebra::{DMatrix, DVector};
use sommerfeld_flex::{CondensedShaft, Frame, Material, NodeLoad, Section};

const STEEL: Material = Material {
    youngs_modulus: 210e9,
    poissons_ratio: 0.3,
};
const JOURNALS: [usize; 3] = [0, 6, 12];
const LOADS: [usize; 3] = [3, 9, 7];

/// [`free_crank`] held along the axis and in torsion at its drive end.
fn crank(angle: f64) -> Frame {
    let mut frame = free_crank(angle);
    frame.hold(12, 2).unwrap();
    frame.hold(12, 5).unwrap();
    frame
}

/// Two throws at unlike angles on three journals, turned by `angle` about z; drive end at node 12.
fn free_crank(angle: f64) -> Frame {
    let mut frame = Frame::new();
    let journal = Section::circle(&STEEL, 0.06, 0.01);
    let web = Section::rectangle(&STEEL, 0.02, 0.08);
    let mut nodes = vec![[0.0, 0.0, 0.0]];
    for (throw, direction) in [0.3_f64, 2.4].into_iter().enumerate() {
        let (sin, cos) = (direction + angle).sin_cos();
        let (start, x, y) = (0.1 * throw as f64, 0.045 * cos, 0.045 * sin);
        nodes.extend([
            [0.0, 0.0, start + 0.02],
            [x, y, start + 0.02],
            [x, y, start + 0.05],
            [x, y, start + 0.08],
            [0.0, 0.0, start + 0.08],
            [0.0, 0.0, start + 0.1],
        ]);
    }
    for node in &nodes {
        frame.add_node(*node);
    }
    for from in 0..nodes.len() - 1 {
        let is_web = nodes[from][2] == nodes[from + 1][2];
        let (section, across) = if is_web {
            (web, [0.0, 0.0, 1.0])
        } else {
            (journal, [1.0, 0.0, 0.0])
        };
        frame.add_beam([from, from + 1], section, across).unwrap();
    }
    frame
}

fn condensed(angle: f64) -> CondensedShaft {
    CondensedShaft::from_frame(&crank(angle), &JOURNALS, &LOADS).unwrap()
}

fn spring(node: usize) -> [[f64; 6]; 6] {
    let k = 1e8 * (1.0 + node as f64);
    let mut matrix = [[0.0; 6]; 6];
    for (freedom, value) in [(0, k), (1, 2.0 * k), (3, 1e-4 * k), (4, 3e-4 * k)] {
        matrix[freedom][freedom] = value;
    }
    matrix[0][1] = 0.3 * k;
    matrix[1][0] = 0.3 * k;
    matrix
}

#[test]
fn condensed_shaft_on_springs_moves_as_its_frame() {
    let (shaft, mut frame) = (condensed(0.0), crank(0.0));
    let forces = [[3e3, -1e3], [2e3, 5e3], [-1e3, 4e3]];
    let mut stiffness = shaft.stiffness.clone();
    for (at, node) in JOURNALS.into_iter().enumerate() {
        frame.add_spring(node, spring(node)).unwrap();
        for (row, from) in [0, 1, 3, 4].into_iter().enumerate() {
            for (column, to) in [0, 1, 3, 4].into_iter().enumerate() {
                stiffness[(4 * at + row, 4 * at + column)] += spring(node)[from][to];
            }
        }
    }
    let loads: Vec<NodeLoad> = LOADS
        .into_iter()
        .zip(forces)
        .map(|(node, [x, y])| NodeLoad {
            node,
            load: [x, y, 0.0, 0.0, 0.0, 0.0],
        })
        .collect();
    let whole = frame.solve(&loads).unwrap();
    let found = stiffness
        .lu()
        .solve(&shaft.journal_loads(0.0, &forces))
        .unwrap();
    for (at, node) in JOURNALS.into_iter().enumerate() {
        for (k, freedom) in [0, 1, 3, 4].into_iter().enumerate() {
            let (a, b) = (found[4 * at + k], whole[node][freedom]);
            assert!(
                (a - b).abs() < 1e-10 * found.amax(),
                "{node} {freedom}: {a} {b}"
            );
        }
    }
}

/// Rigid movements of places at axial positions `axial`: x, y, tilt about x, tilt about y.
fn rigid(axial: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(4 * axial.len(), 4, |row, mode| {
        let z = axial[row / 4];
        match (row % 4, mode) {
            (0, 3) => z,
            (1, 2) => -z,
            (freedom, mode) => f64::from(u8::from(freedom == mode)),
        }
    })
}

#[test]
fn rigid_movements_of_the_journals_cost_no_force_and_loads_keep_their_resultant() {
    let shaft = condensed(0.0);
    let journals = rigid(&[0.0, 0.1, 0.2]);
    let loads = rigid(&[0.05, 0.15, 0.12]);
    let left = (&shaft.stiffness * &journals).amax() / shaft.stiffness.amax();
    assert!(left < 1e-13, "{left:e}");
    let off = journals.tr_mul(&shaft.load_transfer) - loads.transpose();
    assert!(off.amax() < 1e-12, "{:e}", off.amax());
    // nothing but the four rigid movements is free
    let values = shaft.stiffness.clone().symmetric_eigenvalues();
    let free = values.iter().filter(|v| **v < 1e-9 * values.max()).count();
    assert_eq!(free, 4, "{values}");
}

#[test]
fn turning_the_condensed_shaft_is_turning_its_frame() {
    let angle = 0.7;
    let (turned, still) = (condensed(angle), condensed(0.0));
    let off = (still.stiffness_at(angle) - &turned.stiffness).amax();
    assert!(off < 1e-12 * still.stiffness.amax(), "{off:e}");
    let forces = [[3e3, -1e3], [2e3, 5e3], [-1e3, 4e3]];
    let off = still.journal_loads(angle, &forces) - turned.journal_loads(0.0, &forces);
    assert!(off.amax() < 1e-8, "{:e}", off.amax());
}

#[test]
fn holds_along_the_axis_and_in_torsion_bend_nothing() {
    // the place of the axial hold does not matter; that of torsion does, as torque runs to it
    let forces = [[3e3, -1e3], [2e3, 5e3], [-1e3, 4e3]];
    let with = |axial: usize, torsion: usize| {
        let mut free = free_crank(0.0);
        free.hold(axial, 2).unwrap();
        free.hold(torsion, 5).unwrap();
        CondensedShaft::from_frame(&free, &JOURNALS, &LOADS).unwrap()
    };
    let (drive, nose) = (with(12, 12), with(0, 12));
    let largest = drive.stiffness.amax();
    assert!((&drive.stiffness - &nose.stiffness).amax() < 1e-12 * largest);
    let same: DVector<f64> = drive.journal_loads(0.0, &forces) - nose.journal_loads(0.0, &forces);
    assert!(same.amax() < 1e-8);
    let front = with(12, 0);
    assert!((&drive.stiffness - &front.stiffness).amax() < 1e-12 * largest);
    let torque = drive.journal_loads(0.0, &forces) - front.journal_loads(0.0, &forces);
    assert!(torque.amax() > 1.0, "{torque}");
}
