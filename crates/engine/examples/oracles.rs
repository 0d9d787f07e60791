//! Prints, as JSON, a torsional vibration and the forces of a slider-crank with all that they were
//! computed from, for other programs to compute them again (`tests/readers/test_engine_oracles.py`).
//!
//! `cargo run -p sommerfeld-engine --example oracles`
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use serde_json::{Value, json};
use sommerfeld_engine::{
    CrankMotion, CrankTrain, CylinderInstant, Damper, Disc, EngineLayout, Harmonic,
    IndicatorDiagram, LayoutKind, LayoutPlan, Rod, Strokes, TorsionalChain, TorsionalLink, Twist,
    harmonics, throw_torques,
};
use std::f64::consts::TAU;

fn main() {
    let oracles = json!({ "torsion": torsion(), "slider_crank": slider_crank() });
    println!("{oracles}");
}

/// An inline six of 105 mm bore and 137 mm stroke; its rod is no two point masses, its pin is offset.
fn inline_six() -> CrankTrain {
    let order = [1, 5, 3, 6, 2, 4];
    let plan = LayoutPlan {
        kind: LayoutKind::Inline,
        cylinders: order.len(),
        firing_order: order.to_vec(),
        firing_intervals: None,
        throw_angles: None,
        cylinder_spacing: 0.13,
        rod_offset: 0.0,
        main_positions: None,
        strokes: Strokes::Four,
    };
    CrankTrain {
        layout: EngineLayout::new(&plan).unwrap(),
        bore: 0.105,
        crank_radius: 0.0685,
        rod_length: 0.207,
        pin_offset: 0.0012,
        piston_mass: 1.7,
        rod: Rod {
            mass: 2.4,
            centre_of_gravity: 0.065,
            inertia: 0.0277,
        },
        unbalances: Vec::new(),
        crankcase_pressure: 1e5,
    }
}

/// A polytropic cycle with a rounded burst after the dead centre: smooth, of the size of a diesel's.
fn diagram(train: &CrankTrain) -> IndicatorDiagram {
    let (r, l) = (train.crank_radius, train.rod_length);
    let rows = 1440;
    let pressure = |angle: f64| {
        let depth = r * (1.0 - angle.cos()) + l - (l * l - (r * angle.sin()).powi(2)).sqrt();
        let volume = 0.008 + depth;
        let compressed = 1.6e5 * ((0.008 + 2.0 * r) / volume).powf(1.34);
        let burst = 7.5e6 * (-((angle - 0.2) / 0.3).powi(2)).exp();
        let expanding = 2.0e5 * (-((angle - 1.8) / 1.0).powi(2)).exp();
        // The gas exchange of the other turn stands near the pressure of the charge.
        let closed = 0.5 * (1.0 + (0.5 * angle).cos());
        1.6e5 + closed * closed * (compressed - 1.6e5) + burst + expanding
    };
    let points = (0..rows)
        .map(|row| 2.0 * TAU * (f64::from(row) / f64::from(rows) - 0.5))
        .map(|angle| [angle, pressure(angle)])
        .collect();
    IndicatorDiagram {
        points,
        period: 2.0 * TAU,
    }
}

fn torsion() -> Value {
    let inertias = [
        0.0170, 0.0090, 0.0467, 0.0327, 0.0467, 0.0467, 0.0327, 0.0487, 2.0750,
    ];
    let stiffnesses = [1.106, 1.631, 1.253, 1.253, 1.678, 1.253, 1.253, 1.976].map(|k| k * 1e6);
    let disc = |(at, inertia): (usize, f64)| {
        let throw = (2..8).contains(&at).then(|| at - 2);
        let damping = if throw.is_some() { 2.0 } else { 0.0 };
        Disc {
            inertia,
            damping,
            throw,
        }
    };
    let link = |stiffness| TorsionalLink {
        stiffness,
        damping: 0.0,
        loss_factor: 0.035,
    };
    let chain = TorsionalChain {
        discs: inertias.into_iter().enumerate().map(disc).collect(),
        links: stiffnesses.map(link).to_vec(),
    };
    let train = inline_six();
    let diagram = diagram(&train);
    let viscous = Damper::viscous(0.11, 95.0);
    let rubber = Damper {
        hub_inertia: 0.006,
        ..Damper::rubber(0.06, 8.0e4, 0.18)
    };
    let chains = [
        ("plain", chain.clone()),
        ("viscous damper", chain.with_damper(&viscous)),
        ("rubber damper", chain.with_damper(&rubber)),
    ];
    let speeds = [900.0, 1444.0, 2000.0, 2600.0].map(|rpm| rpm * TAU / 60.0);
    let cases = chains.iter().flat_map(|(name, chain)| {
        speeds.map(|speed| {
            let torques = torques(&train, &diagram, speed);
            let response = chain.forced_response(speed, &torques).unwrap();
            json!({
                "name": name, "chain": chain, "speed": speed, "torques": torques, "response": response,
            })
        })
    });
    cases.collect()
}

fn torques(train: &CrankTrain, diagram: &IndicatorDiagram, speed: f64) -> Vec<Vec<Harmonic>> {
    let (rows, even) = (1440, CrankMotion::even(speed));
    let table: Vec<Vec<f64>> = (0..rows)
        .map(|row| 2.0 * TAU * f64::from(row) / f64::from(rows))
        .map(|angle| throw_torques(train, diagram, &even, angle))
        .collect();
    let of_throw = |throw: usize| {
        let values: Vec<f64> = table.iter().map(|row| row[throw]).collect();
        harmonics(&values, 2.0, 12.0)
    };
    (0..train.layout.throws.len()).map(of_throw).collect()
}

/// Forces of cylinder 1 over a cycle, at even speed and with ripple.
fn slider_crank() -> Value {
    let train = inline_six();
    let diagram = diagram(&train);
    let speed = 2000.0 * TAU / 60.0;
    let ripple = Twist {
        harmonics: vec![
            Harmonic {
                order: 3.0,
                cos: 0.006,
                sin: -0.004,
            },
            Harmonic {
                order: 5.5,
                cos: 0.0,
                sin: 0.003,
            },
        ],
    };
    let motions = [Vec::new(), vec![(0.0, ripple)]].map(|twists| CrankMotion { speed, twists });
    let cases = motions.iter().map(|motion| {
        let rows = (0..360).map(|row| {
            let crank_angle = 2.0 * TAU * f64::from(row) / 360.0;
            let at = CylinderInstant::at(&train, &diagram, motion, 0, crank_angle).unwrap();
            json!({
                "crank_angle": crank_angle,
                "arm": at.slider.crank.angle,
                "gas_force": at.gas_force,
                "big_end": at.forces.big_end,
                "small_end": at.forces.small_end,
                "side_thrust": at.forces.side_thrust,
                "torque": at.torque(),
            })
        });
        json!({ "motion": motion, "rows": rows.collect::<Vec<Value>>() })
    });
    json!({
        "train": train,
        "diagram": diagram.points,
        "cases": cases.collect::<Vec<Value>>(),
    })
}
