//! What the tests of this crate share: the diesel of `validation/crank-i6` in any layout.
#![allow(dead_code, clippy::unwrap_used)]

use sommerfeld_engine::{
    CrankMotion, CrankTrain, EngineLayout, Harmonic, IndicatorDiagram, LayoutKind, LayoutPlan, Rod,
    Strokes, Twist, Unbalance,
};
use std::f64::consts::{PI, TAU};

/// 2000 rpm, rad/s.
pub const SPEED: f64 = 2000.0 / 60.0 * TAU;
/// Oscillating and rotating mass of a cylinder, kg.
pub const OSCILLATING: f64 = 2.521;
pub const ROTATING: f64 = 1.5;

pub fn plan(kind: LayoutKind, order: &[usize]) -> LayoutPlan {
    LayoutPlan {
        kind,
        cylinders: order.len(),
        firing_order: order.to_vec(),
        firing_intervals: None,
        throw_angles: None,
        cylinder_spacing: 0.13,
        rod_offset: match kind {
            LayoutKind::Inline => 0.0,
            LayoutKind::Vee { .. } | LayoutKind::Boxer => 0.03,
        },
        main_positions: None,
        strokes: Strokes::Four,
    }
}

pub fn inline(order: &[usize]) -> EngineLayout {
    EngineLayout::new(&plan(LayoutKind::Inline, order)).unwrap()
}

/// An engine of each kind: inline six, V8 with a cross-plane crankshaft, V6 with split pins, boxer four.
pub fn layouts() -> [EngineLayout; 4] {
    let vee = LayoutKind::Vee {
        bank_angle: 0.5 * PI,
    };
    let mut split = plan(vee, &[1, 4, 3, 6, 2, 5]);
    let throws = [0.0_f64, -30.0, 240.0, 210.0, 120.0, 90.0];
    split.throw_angles = Some(throws.map(f64::to_radians).to_vec());
    [
        inline(&[1, 5, 3, 6, 2, 4]),
        EngineLayout::new(&plan(vee, &[1, 5, 4, 8, 6, 3, 7, 2])).unwrap(),
        EngineLayout::new(&split).unwrap(),
        EngineLayout::new(&plan(LayoutKind::Boxer, &[1, 3, 2, 4])).unwrap(),
    ]
}

/// The diesel with a rod of two point masses and no pin offset.
pub fn diesel(layout: EngineLayout) -> CrankTrain {
    let rod_length = 0.207;
    let in_small_end = 0.9;
    let mass = ROTATING + in_small_end;
    let centre_of_gravity = rod_length * in_small_end / mass;
    CrankTrain {
        layout,
        bore: 0.105,
        crank_radius: 0.0685,
        rod_length,
        pin_offset: 0.0,
        piston_mass: OSCILLATING - in_small_end,
        rod: Rod {
            mass,
            centre_of_gravity,
            inertia: mass * centre_of_gravity * (rod_length - centre_of_gravity),
        },
        unbalances: Vec::new(),
        crankcase_pressure: 1e5,
    }
}

/// The same with a rod that is no two point masses, a pin offset and counterweights.
pub fn general(layout: EngineLayout) -> CrankTrain {
    let mut train = diesel(layout);
    train.rod.inertia *= 1.25;
    train.pin_offset = 0.0012;
    let at = |axial, angle| Unbalance {
        axial,
        moment: 0.08,
        angle,
    };
    train.unbalances = vec![at(0.02, 3.0), at(0.31, 0.4), at(0.37, -1.0)];
    train
}

/// A shaft that twists.
pub fn rippling() -> CrankMotion {
    let twist = |scale: f64| Twist {
        harmonics: vec![
            Harmonic {
                order: 3.0,
                cos: 0.01 * scale,
                sin: -0.004 * scale,
            },
            Harmonic {
                order: 7.5,
                cos: -0.002 * scale,
                sin: 0.003 * scale,
            },
        ],
    };
    CrankMotion {
        speed: SPEED,
        twists: vec![(0.0, twist(1.0)), (0.3, twist(0.4)), (0.8, twist(-0.3))],
    }
}

/// The indicator diagram of `validation/crank-i6`: its firing top dead centre is at 360 deg, and the step
/// where it closes stays.
pub fn diagram() -> IndicatorDiagram {
    let points = table("crank-i6/pressure.csv");
    IndicatorDiagram {
        points: points
            .iter()
            .map(|row| [(row[0] - 360.0).to_radians(), row[1] * 1e6])
            .collect(),
        period: 2.0 * TAU,
    }
}

/// The pressure under the pistons above them too: no gas force.
pub fn no_gas() -> IndicatorDiagram {
    IndicatorDiagram {
        points: vec![[0.0, 1e5]],
        period: 2.0 * TAU,
    }
}

/// Numbers of a committed table: comments and the header left out.
pub fn table(path: &str) -> Vec<Vec<f64>> {
    let path = format!("{}/../../validation/{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path)
        .unwrap()
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| {
            line.split(',')
                .map(|cell| cell.trim().parse().unwrap())
                .collect()
        })
        .collect()
}

pub fn close(found: f64, expected: f64, bar: f64, what: &str) {
    assert!(
        (found - expected).abs() <= bar,
        "{what}: {found} against {expected}, {:.2e} apart, bar {bar:.2e}",
        (found - expected).abs()
    );
}
