//! Engines made by hand for the tests of runs: an inline engine of 105 mm bore and 137 mm stroke with a
//! diagram of adiabatic changes and a bump of combustion, and bearings of plausible sizes.

use sommerfeld_engine::{
    CrankTrain, EngineLayout, Gas, IndicatorDiagram, LayoutKind, LayoutPlan, Mains, PinFit, Rod,
    Role, Strokes,
};
use sommerfeld_film::{Bearing, Cavitation, Ends, FilmShear, Inlet, Shape};
use sommerfeld_oil::Lubricant;
use sommerfeld_study::Study;
use sommerfeld_study::input::{
    Analysis, EnginePlan, FilmMethod, FilmModel, FilmSettings, HeatPlan, LinearSolver, Machine,
    MachineBearing, MachinePlan, OrbitPlan, Rotor, StudyLimit, Subject,
};
use std::f64::consts::PI;

pub const RPM: f64 = PI / 30.0;

/// Absolute pressure over the cycle: gas exchange at 2 bar, compression 17 to 1 with the exponent 1.35,
/// combustion as a bump of 60 bar at 10 deg, expansion with the exponent 1.3.
fn diagram(crank_radius: f64, rod_length: f64) -> IndicatorDiagram {
    let height = |angle: f64| {
        let lateral = crank_radius * angle.sin() / rod_length;
        crank_radius * angle.cos() + rod_length * (1.0 - lateral * lateral).sqrt()
    };
    let top = crank_radius + rod_length;
    let clearance = 2.0 * crank_radius / 16.0;
    let ratio = |angle: f64| (top - height(PI) + clearance) / (top - height(angle) + clearance);
    let boost: f64 = 2e5;
    let points = (0..720).map(|degree| {
        let angle = f64::from(degree).to_radians();
        // 0 is the firing dead centre: expansion to 180, exhaust, inlet, compression from 540.
        let pressure = match degree {
            0..180 => 1.9 * boost * ratio(angle).powf(1.3),
            180..540 => boost,
            _ => boost * ratio(angle).powf(1.35),
        };
        let from_bump = (f64::from((degree + 350) % 720) - 360.0) / 12.0;
        [angle, pressure + 6e6 * (-from_bump * from_bump).exp()]
    });
    IndicatorDiagram {
        points: points.collect(),
        period: 4.0 * PI,
    }
}

fn train(firing_order: &[usize]) -> CrankTrain {
    let layout = EngineLayout::new(&LayoutPlan {
        kind: LayoutKind::Inline,
        cylinders: firing_order.len(),
        firing_order: firing_order.to_vec(),
        firing_intervals: None,
        throw_angles: None,
        cylinder_spacing: 0.13,
        rod_offset: 0.0,
        main_positions: None,
        strokes: Strokes::Four,
    })
    .unwrap();
    CrankTrain {
        layout,
        bore: 0.105,
        crank_radius: 0.0685,
        rod_length: 0.207,
        pin_offset: 0.0,
        piston_mass: 1.7,
        rod: Rod {
            mass: 2.4,
            centre_of_gravity: 0.065,
            inertia: 0.022,
        },
        unbalances: Vec::new(),
        crankcase_pressure: 1e5,
    }
}

/// A bearing without feeds, which the closure of Reynolds does not need.
pub fn bearing(diameter: f64, width: f64, clearance: f64) -> Bearing {
    Bearing {
        diameter,
        width,
        radial_clearance: clearance,
        bore: Shape::cylindrical(),
        journal: Shape::cylindrical(),
        feeds: Vec::new(),
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Air,
        inlet: Inlet::Cyclic,
        cavitation: Cavitation::Reynolds,
        film_shear: FilmShear::FullWidth,
        finish: sommerfeld_film::Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
    }
}

pub fn member(role: Role, index: usize, bearing: Bearing) -> MachineBearing {
    MachineBearing {
        name: format!("{}-{}", role.name(), index + 1),
        role,
        index,
        bearing,
        feed_pressures: Vec::new(),
        drillings: Vec::new(),
    }
}

/// An inline engine that fires in this order: its mains and big ends at these speeds (rpm).
pub fn inline_plan(firing_order: &[usize], speeds: &[f64]) -> MachinePlan {
    let train = train(firing_order);
    let mains = train.layout.mains.len();
    let of = |role, count: usize, bearing: Bearing| {
        (0..count).map(move |index| member(role, index, bearing.clone()))
    };
    let bearings = of(Role::Main, mains, bearing(0.083, 0.030, 41e-6)).chain(of(
        Role::BigEnd,
        firing_order.len(),
        bearing(0.069, 0.034, 35e-6),
    ));
    MachinePlan {
        bearings: bearings.collect(),
        lubricant: Lubricant::constant(0.010, 850.0),
        temperature: 373.15,
        heat: HeatPlan::Given,
        wear: None,
        speeds: speeds.iter().map(|rpm| rpm * RPM).collect(),
        orbit: OrbitPlan {
            crank_step: PI / 180.0,
            maximum_cycles: 8,
            closure_tolerance: 1e-3,
        },
        machine: Machine::Engine(Box::new(EnginePlan {
            gas: Gas::of(diagram(train.crank_radius, train.rod_length)),
            train,
            mains: Mains::Determinate,
            pin_fit: PinFit::Floating,
            torsion: None,
        })),
    }
}

/// A study of a machine as the reader of study files would hand it over.
pub fn study(
    plan: MachinePlan,
    model: FilmModel,
    grid: [usize; 2],
    limits: Vec<StudyLimit>,
) -> Study {
    Study {
        title: "An engine made by hand".into(),
        analysis: Analysis::Engine,
        subject: Subject::Machine(Box::new(plan)),
        film: FilmSettings {
            model,
            method: FilmMethod::FiniteVolume,
            grid,
            linear_solver: LinearSolver::Auto,
            relative_error_target: None,
            compare: Vec::new(),
            databases: Vec::new(),
        },
        rotor: Rotor::default(),
        limits,
        warnings: Vec::new(),
        file: "engine.toml".into(),
        files: Vec::new(),
        text: "schema = 1\nanalysis = \"engine\"\n".into(),
        input_hash: "made by hand".into(),
    }
}
