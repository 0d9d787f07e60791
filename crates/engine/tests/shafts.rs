//! Straight shafts on rigid and elastic supports against closed forms.
#![allow(clippy::unwrap_used)]

use sommerfeld_engine::{
    GeneralShaft, ShaftError, ShaftLoad, ShaftSection, SupportReactions, Supports, Unbalance,
    condensed_shaft, support_reactions,
};
use sommerfeld_flex::{Material, Section};
use std::f64::consts::TAU;

const STEEL: Material = Material {
    youngs_modulus: 210e9,
    poissons_ratio: 0.3,
};

/// `spans` equal spans of 1 m, unit force along x in the middle of the first.
fn shaft(spans: usize, diameter: f64) -> GeneralShaft {
    GeneralShaft {
        sections: vec![ShaftSection {
            length: spans as f64,
            diameter,
            bore_diameter: 0.0,
        }],
        youngs_modulus: STEEL.youngs_modulus,
        poissons_ratio: STEEL.poissons_ratio,
        density: 7850.0,
        gravity: [0.0; 2],
        bearings: (0..=spans).map(|n| n as f64).collect(),
        unbalances: Vec::new(),
        loads: vec![load(0.5, [1.0, 0.0])],
        period: TAU,
        is_elastic: true,
        supports: Supports::Rigid,
        offsets: Vec::new(),
    }
}

fn load(axial: f64, [x, y]: [f64; 2]) -> ShaftLoad {
    ShaftLoad {
        axial,
        points: vec![[0.0, x, y]],
    }
}

fn section(diameter: f64) -> Section {
    Section::circle(&STEEL, diameter, 0.0)
}

/// What the middle of three supports carries of a force in the middle of a span. Force method on the
/// span of 2 L: deflections of bending and shear at the middle support.
fn middle_of_two_spans(diameter: f64) -> f64 {
    let section = section(diameter);
    let shear = section.bending[0] * section.shear_flexibility[0];
    (11.0 / 96.0 + 0.25 * shear) / (1.0 / 6.0 + 0.5 * shear)
}

fn each(stiffness: f64) -> Supports {
    Supports::Each {
        stiffness: [[stiffness, 0.0], [0.0, stiffness]],
        tilt_stiffness: None,
    }
}

fn carried(shaft: &GeneralShaft, supports: &Supports) -> SupportReactions {
    let forces: Vec<[f64; 2]> = shaft.forces(0.0, 0.0).iter().map(|f| f.force).collect();
    let condensed = condensed_shaft(shaft).unwrap();
    support_reactions(&condensed, supports, 0.0, &forces, &shaft.offsets).unwrap()
}

fn along_x(reactions: &SupportReactions) -> Vec<f64> {
    reactions.loads.iter().map(|load| load[0]).collect()
}

fn all_near(found: &[f64], exact: &[f64], bar: f64, what: &str) {
    assert_eq!(found.len(), exact.len());
    for (a, b) in found.iter().zip(exact) {
        assert!((a - b).abs() <= bar, "{what}: {found:?} {exact:?}");
    }
}

#[test]
fn continuous_beams_carry_what_the_references_say() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../validation/continuous-beams/reference.csv"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let rows: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    for row in &rows[1..] {
        let cells: Vec<&str> = row.split(',').collect();
        let spans: usize = cells[0].parse().unwrap();
        let stiffness: f64 = cells[1].parse().unwrap();
        let exact: Vec<f64> = (0..=spans).map(|n| cells[2 + n].parse().unwrap()).collect();
        let bar: f64 = cells[7].parse().unwrap();
        let diameter = 2e-4;
        let supports = if stiffness.is_finite() {
            each(stiffness * section(diameter).bending[0])
        } else {
            Supports::Rigid
        };
        let found = along_x(&carried(&shaft(spans, diameter), &supports));
        all_near(&found, &exact, bar, row);
        let sum: f64 = found.iter().sum();
        assert!((sum - 1.0).abs() < 1e-9, "{row}: {sum}");
    }
}

#[test]
fn shear_takes_load_off_the_middle_support() {
    for diameter in [2e-4, 0.1, 0.3] {
        let middle = middle_of_two_spans(diameter);
        let exact = [0.75 - 0.5 * middle, middle, 0.25 - 0.5 * middle];
        let found = along_x(&carried(&shaft(2, diameter), &Supports::Rigid));
        all_near(&found, &exact, 1e-9, &format!("diameter {diameter}"));
    }
    // a span of three diameters: shear moves more than 1 % of it
    let found = along_x(&carried(&shaft(2, 0.3), &Supports::Rigid));
    assert!(found[1] < 0.99 * 0.6875, "{found:?}");
}

#[test]
fn stiff_supports_carry_as_rigid_ones_and_soft_ones_as_under_a_rigid_shaft() {
    let shaft = shaft(4, 0.05);
    let rigid = along_x(&carried(&shaft, &Supports::Rigid));
    let unit = section(0.05).bending[0];
    let stiff = along_x(&carried(&shaft, &each(1e9 * unit)));
    all_near(&stiff, &rigid, 1e-6, "stiff");
    // five springs at -2..2, unit force at -1.5: 1/5 + (-1.5) z / 10
    let level: Vec<f64> = (0..5).map(|n| 0.2 - 0.15 * (f64::from(n) - 2.0)).collect();
    let soft = carried(&shaft, &each(1e-7 * unit));
    all_near(&along_x(&soft), &level, 1e-6, "soft");
    // and the shaft itself stays straight
    let [first, .., last] = &soft.tilts[..] else {
        panic!("five tilts")
    };
    assert!((first[1] / last[1] - 1.0).abs() < 1e-6);
    let slope = -0.15 / (1e-7 * unit);
    assert!((first[1] / slope - 1.0).abs() < 1e-6, "{first:?} {slope}");
}

#[test]
fn ends_of_one_span_slope_as_a_beam_on_two_supports() {
    let mut shaft = shaft(1, 0.05);
    shaft.loads = vec![load(0.5, [1e3, -2e3])];
    let slope = 1e3 / (16.0 * section(0.05).bending[0]);
    let found = carried(&shaft, &Supports::Rigid);
    // x grows along z at the first end: tilt about +y; y falls there: tilt about +x
    all_near(
        &found.tilts[0],
        &[2.0 * slope, slope],
        1e-9 * slope,
        "first",
    );
    all_near(
        &found.tilts[1],
        &[-2.0 * slope, -slope],
        1e-9 * slope,
        "last",
    );
    all_near(&found.loads[0], &[500.0, -1000.0], 1e-8, "load");
}

#[test]
fn a_bore_off_the_line_bends_the_shaft() {
    // two spans, middle bore off by 0.1 mm: 48 E I d / (2 L)^3 at the middle, shear added
    let mut shaft = shaft(2, 0.05);
    shaft.loads = vec![load(0.5, [0.0; 2])];
    shaft.offsets = vec![[0.0; 2], [0.0, 1e-4], [0.0; 2]];
    let section = section(0.05);
    let flexibility = 8.0 / (48.0 * section.bending[0]) + 0.5 * section.shear_flexibility[0];
    let middle = 1e-4 / flexibility;
    let found = carried(&shaft, &Supports::Rigid);
    let across: Vec<f64> = found.loads.iter().map(|load| load[1]).collect();
    let exact = [0.5 * middle, -middle, 0.5 * middle];
    all_near(&across, &exact, 1e-9 * middle, "offset");
    all_near(&found.positions[1], &[0.0, 1e-4], 1e-16, "position");
    shaft.offsets.pop();
    let forces = [[0.0; 2]];
    let condensed = condensed_shaft(&shaft).unwrap();
    let refused = support_reactions(&condensed, &shaft.supports, 0.0, &forces, &shaft.offsets);
    assert_eq!(
        refused,
        Err(ShaftError::Offsets {
            given: 2,
            bearings: 3
        })
    );
}

#[test]
fn weight_is_carried_as_a_distributed_load() {
    let mut shaft = shaft(2, 2e-4);
    shaft.loads.clear();
    shaft.gravity = [-9.81, 0.0];
    let weight = 9.81 * 7850.0 * std::f64::consts::PI * 1e-8;
    let found = along_x(&carried(&shaft, &Supports::Rigid));
    let exact = [-0.375 * weight, -1.25 * weight, -0.375 * weight];
    all_near(&found, &exact, 1e-6 * weight, "two spans");
    // stout, stepped and bored: cutting the pieces by places without load changes nothing
    let step = |length, diameter, bore_diameter| ShaftSection {
        length,
        diameter,
        bore_diameter,
    };
    shaft.sections = vec![
        step(0.7, 0.2, 0.0),
        step(0.9, 0.3, 0.1),
        step(0.4, 0.15, 0.0),
    ];
    let whole = along_x(&carried(&shaft, &each(1e8)));
    shaft.loads = [0.13, 0.4, 0.71, 1.2, 1.55, 1.9]
        .map(|z| load(z, [0.0; 2]))
        .to_vec();
    let cut = along_x(&carried(&shaft, &each(1e8)));
    let total: f64 = whole.iter().sum();
    all_near(&cut, &whole, 1e-9 * total.abs(), "cut");
    let volume = 0.25 * std::f64::consts::PI * (0.7 * 0.04 + 0.9 * 0.08 + 0.4 * 0.0225);
    assert!((total / (-9.81 * 7850.0 * volume) - 1.0).abs() < 1e-9);
}

#[test]
fn unbalance_turns_and_loads_repeat() {
    let mut shaft = shaft(2, 0.05);
    shaft.unbalances = vec![Unbalance {
        axial: 0.5,
        moment: 1e-3,
        angle: 0.4,
    }];
    shaft.loads = vec![ShaftLoad {
        axial: 1.5,
        points: vec![[1.0, 0.0, 3.0], [2.0, 4.0, 3.0], [4.0, 0.0, 3.0]],
    }];
    let forces = shaft.forces(100.0, 0.8);
    assert_eq!(forces.len(), shaft.force_positions().len());
    let (sin, cos) = 1.2_f64.sin_cos();
    all_near(
        &forces[0].force,
        &[10.0 * cos, 10.0 * sin],
        1e-12,
        "unbalance",
    );
    for (angle, along) in [
        (1.5, 2.0),
        (2.5, 3.0),
        (1.5 + TAU, 2.0),
        (0.5, 0.0),
        (2.0, 4.0),
    ] {
        let force = shaft.loads[0].at(angle, TAU);
        all_near(&force, &[along, 3.0], 1e-12, &format!("{angle}"));
    }
    // a round shaft carries the turned force as it carries the force
    shaft.loads.clear();
    let condensed = condensed_shaft(&shaft).unwrap();
    for angle in [0.0, 0.9, 4.0] {
        let force = shaft.forces(100.0, angle)[0].force;
        let found = support_reactions(&condensed, &Supports::Rigid, angle, &[force], &[]).unwrap();
        let middle = [force[0] * found.loads[1][0], force[1] * found.loads[1][1]];
        let share = (middle[0] + middle[1]) / 100.0;
        assert!((share - middle_of_two_spans(0.05)).abs() < 1e-9, "{share}");
        let across = force[0] * found.loads[1][1] - force[1] * found.loads[1][0];
        assert!(across.abs() < 1e-9);
    }
}

#[test]
fn a_matrix_of_supports_may_couple_bearings_and_is_checked() {
    let stiffness = [[3e8, 1e7], [1e7, 2e8]];
    let tilt = [[2e5, 1e3], [1e3, 1e5]];
    let single = Supports::Each {
        stiffness,
        tilt_stiffness: Some(tilt),
    };
    let mut values = vec![0.0; 144];
    for n in 0..3 {
        for row in 0..2 {
            for column in 0..2 {
                values[(4 * n + row) * 12 + 4 * n + column] = stiffness[row][column];
                values[(4 * n + 2 + row) * 12 + 4 * n + 2 + column] = tilt[row][column];
            }
        }
    }
    let shaft = shaft(2, 0.1);
    let whole = Supports::Matrix(values.clone());
    let difference = single.compliance(3).unwrap() - whole.compliance(3).unwrap();
    assert!(difference.amax() < 1e-20);
    let exact = along_x(&carried(&shaft, &single));
    all_near(&along_x(&carried(&shaft, &whole)), &exact, 1e-10, "matrix");
    // a block that joins its mains: its inverse times itself is one
    for (a, b) in [(0, 4), (4, 8)] {
        values[a * 12 + b] = -1e8;
        values[b * 12 + a] = -1e8;
    }
    let coupled = Supports::Matrix(values.clone()).compliance(3).unwrap();
    let one = nalgebra::DMatrix::from_row_slice(12, 12, &values) * coupled;
    assert!((one - nalgebra::DMatrix::identity(12, 12)).amax() < 1e-10);
    // refused: size, symmetry, sign
    assert_eq!(
        whole.compliance(4),
        Err(ShaftError::SupportSize {
            given: 144,
            bearings: 4,
            needed: 256
        })
    );
    values[5] = 1e7;
    let skew = Supports::Matrix(values.clone()).compliance(3);
    assert!(
        matches!(
            skew,
            Err(ShaftError::SupportSymmetry {
                row: 5,
                column: 0,
                ..
            })
        ),
        "{skew:?}"
    );
    values[5] = 0.0;
    values[0] = 1e6;
    assert_eq!(
        Supports::Matrix(values).compliance(3),
        Err(ShaftError::SupportSign)
    );
    assert_eq!(each(-1.0).compliance(1), Err(ShaftError::SupportSign));
    assert_eq!(each(f64::NAN).compliance(1), Err(ShaftError::SupportSign));
    assert_eq!(Supports::Rigid.compliance(2).unwrap().amax(), 0.0);
}

#[test]
fn shafts_that_cannot_be_are_refused_by_name() {
    let refused = |change: &dyn Fn(&mut GeneralShaft)| {
        let mut changed = shaft(2, 0.05);
        change(&mut changed);
        condensed_shaft(&changed).unwrap_err().to_string()
    };
    for (found, words) in [
        (
            refused(&|s| s.bearings[2] = 2.5),
            "bearing 3 at 2500.000 mm is not on the shaft",
        ),
        (
            refused(&|s| s.bearings[1] = 0.0),
            "bearings must ascend: number 2",
        ),
        (refused(&|s| s.bearings.clear()), "0 bearings"),
        (
            refused(&|s| s.loads[0].axial = f64::NAN),
            "load 1 at NaN mm",
        ),
        (
            refused(&|s| s.sections[0].bore_diameter = 0.06),
            "bore_diameter is 0.06",
        ),
        (
            refused(&|s| s.sections.clear()),
            "is not on the shaft, which runs from 0 to 0.000",
        ),
        (refused(&|s| s.youngs_modulus = 0.0), "youngs_modulus is 0"),
        (
            refused(&|s| s.poissons_ratio = 0.7),
            "poissons_ratio is 0.7",
        ),
    ] {
        assert!(found.contains(words), "{found} / {words}");
    }
    let condensed = condensed_shaft(&GeneralShaft {
        bearings: vec![0.5],
        ..shaft(2, 0.05)
    });
    let lone = support_reactions(&condensed.unwrap(), &Supports::Rigid, 0.0, &[], &[]);
    assert_eq!(
        lone,
        Err(ShaftError::TooFewBearings {
            given: 1,
            needed: 2
        })
    );
}
