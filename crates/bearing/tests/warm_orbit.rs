//! Temperatures of the film over a load cycle.
#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use sommerfeld_bearing::{
    CycleHeat, CycleTilt, EquilibriumRequest, EquilibriumSettings, HeatFieldSettings, LoadCycle,
    LoadPoint, OrbitSettings, warm_equilibrium, warm_orbit,
};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Conditions, Elasticity, Ends, Feed, FeedLine, FeedShape,
    FilmShear, FilmSolver, Finish, Inlet, JournalState, Outcome, Shape, Surroundings,
};
use sommerfeld_oil::{DensityLaw, Lubricant, ViscosityLaw};
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

const KELVIN: f64 = 273.15;
const SPEED: f64 = 209.44;
const SUPPLY: [f64; 1] = [KELVIN + 80.0];

/// An axial groove opposite to the load.
fn bearing(cavitation: Cavitation) -> Bearing {
    Bearing {
        diameter: 0.06,
        width: 0.03,
        radial_clearance: 30e-6,
        bore: Shape::cylindrical(),
        journal: Shape::cylindrical(),
        feeds: vec![Feed {
            shape: FeedShape::Rectangle {
                length: 8e-3,
                width: 20e-3,
            },
            carried_by: Carrier::Shell,
            angle: PI,
            position: 0.0,
            pressure: 3e5,
            line: FeedLine::Direct,
        }],
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Air,
        inlet: Inlet::Cyclic,
        cavitation,
        film_shear: FilmShear::FilmFraction,
        finish: Finish::Smooth,
        elasticity: Elasticity::Rigid,
    }
}

fn oil() -> Lubricant {
    let viscosity = ViscosityLaw::Vogel {
        a: 1.3e-4,
        b: 900.0,
        c: 110.0 - KELVIN,
    };
    Lubricant::newtonian(viscosity, DensityLaw::Constant { density: 860.0 })
}

fn surroundings() -> Surroundings<'static> {
    Surroundings {
        volumetric_heat: 1.8e6,
        supply: &SUPPLY,
        ambient: SUPPLY[0],
        carry_over: 1.0,
        wall: (0.0, SUPPLY[0]),
    }
}

const CONDITIONS: Conditions<'static> = Conditions {
    temperature: KELVIN + 90.0,
    feed_pressures: None,
};

fn cycle(load: impl Fn(f64) -> [f64; 2]) -> LoadCycle {
    let points = (0..72).map(|step| {
        let crank_angle = TAU * f64::from(step) / 72.0;
        LoadPoint {
            crank_angle,
            load: load(crank_angle),
            moment: [0.0; 2],
            journal_speed: SPEED,
            shell_speed: 0.0,
        }
    });
    LoadCycle {
        points: points.collect(),
        period: TAU,
        engine_speed: SPEED,
        journal_mass: 0.0,
        tilt: CycleTilt::Aligned,
        feed_pressures: Vec::new(),
    }
}

fn settings() -> OrbitSettings {
    OrbitSettings {
        crank_step: 5.0_f64.to_radians(),
        cycle_limit: 60,
        // Single cells at the edge of a ruptured film come and go under a load that does not change.
        closure_tolerance: 1e-3,
        ..OrbitSettings::default()
    }
}

/// Under a constant load the orbit is a point, and its film as warm as that of a bearing at rest.
#[test]
fn a_constant_load_warms_the_film_as_at_rest() {
    for cavitation in [Cavitation::Reynolds, Cavitation::MassConserving] {
        let (bearing, oil) = (bearing(cavitation), oil());
        let heat = CycleHeat {
            surroundings: surroundings(),
            tolerance: 0.02,
        };
        let mut film = FilmSolver::aligned(&bearing, &oil, [64, 16]).unwrap();
        let cycle = cycle(|_| [4e3, 0.0]);
        let found = warm_orbit(
            &mut film,
            &bearing,
            &cycle,
            &CONDITIONS,
            &settings(),
            &heat,
            &mut |_, _, _| ControlFlow::Continue(()),
        )
        .unwrap();
        assert_eq!(
            found.orbit.outcome,
            Outcome::Converged,
            "{:?}",
            found.changes
        );
        let request = EquilibriumRequest {
            load: [4e3, 0.0],
            moment: None,
            frame: JournalState {
                journal_speed: SPEED,
                ..JournalState::default()
            },
            start: None,
            settings: EquilibriumSettings::default(),
        };
        let mut film = FilmSolver::aligned(&bearing, &oil, [64, 16]).unwrap();
        let rest = warm_equilibrium(
            &mut film,
            &bearing,
            &request,
            &CONDITIONS,
            &surroundings(),
            &HeatFieldSettings::default(),
        )
        .unwrap();
        assert_eq!(rest.outcome, Outcome::Converged, "{:?}", rest.changes);
        let (orbit, rest_heat) = (found.warmed, rest.warmed);
        println!(
            "{cavitation:?} {orbit:?}\n {rest_heat:?} {} rounds",
            rest.changes.len()
        );
        assert!((orbit.hottest - rest_heat.hottest).abs() < 0.05);
        assert!((orbit.mean - rest_heat.mean).abs() < 0.05);
        assert!((orbit.outlet - rest_heat.outlet).abs() < 0.05);
        assert!(rest_heat.balance.relative_error() < 1e-8);
        let thinnest = found.orbit.points[10].summary.minimum_film_thickness.value;
        let at_rest = rest.rest.summary.minimum_film_thickness.value;
        assert!((thinnest / at_rest - 1.0).abs() < 1e-3);
    }
}

/// A load that turns and swells: the temperatures settle over the cycles, and their account closes.
#[test]
fn temperatures_settle_over_cycles() {
    for cavitation in [Cavitation::Reynolds, Cavitation::MassConserving] {
        let (bearing, oil) = (bearing(cavitation), oil());
        let heat = CycleHeat {
            surroundings: surroundings(),
            tolerance: 0.02,
        };
        let mut film = FilmSolver::aligned(&bearing, &oil, [64, 16]).unwrap();
        let cycle = cycle(|angle| [4e3 + 2e3 * angle.cos(), 1.5e3 * angle.sin()]);
        let found = warm_orbit(
            &mut film,
            &bearing,
            &cycle,
            &CONDITIONS,
            &settings(),
            &heat,
            &mut |_, _, _| ControlFlow::Continue(()),
        )
        .unwrap();
        println!("{cavitation:?} {:?} {:?}", found.warmed, found.changes);
        assert_eq!(
            found.orbit.outcome,
            Outcome::Converged,
            "{:?}",
            found.changes
        );
        let balance = found.warmed.balance;
        assert!(balance.relative_error() < 1e-8, "{balance:?}");
        // The power of the points, and what the supply pumps through: p q, a few W.
        let points = &found.orbit.points[1..];
        let count = points.len() as f64;
        let power: f64 = points.iter().map(|p| p.summary.power_loss()).sum();
        let pumped: f64 = points.iter().map(|p| 3e5 * p.summary.feed_flow).sum();
        let expected = (power + pumped) / count;
        assert!(
            (balance.generated / expected - 1.0).abs() < 1e-2,
            "{balance:?} {expected}"
        );
        assert!(found.warmed.hottest > SUPPLY[0] + 5.0);
    }
}
