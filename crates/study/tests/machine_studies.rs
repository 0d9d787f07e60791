//! Studies of engines and shafts are read into the right plans.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_engine::{Mains, PinFit, Role, Supports, arm_in_rod_frame};
use sommerfeld_film::Carrier;
use sommerfeld_study::input::{EnginePlan, Machine, MachinePlan, Study, Subject, study_from_text};
use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::Path;

/// A four-cylinder engine, complete and small.
const FOUR: &str = r#"
schema = 1
analysis = "engine"

[engine]
layout = "inline"
cylinders = 4
firing_order = [1, 3, 4, 2]
cylinder_spacing = "90 mm"
bore = "80 mm"
stroke = "90 mm"
rod_length = "140 mm"
speed = ["2000 rpm", "4000 rpm"]
piston_mass = "0.45 kg"
rod_mass = "0.6 kg"
rod_centre_of_gravity = "42 mm"
rod_inertia = "2.5e-3 kg.m2"
throw_unbalance = "0.05 kg.m"
counterweight = "0.04 kg.m"

[[engine.unbalance]]
throw = 2
moment = "1 kg.mm"
angle = "90 deg"

[engine.gas]
file = "pressure.csv"

[[bearing]]
of = "main"
diameter = "52 mm"
width = "19 mm"
diametral_clearance = "40 um"

[[bearing.groove]]
kind = "circumferential"
width = "4 mm"
pressure = "4 bar"

[[bearing]]
of = "main"
numbers = [3]
width = "23 mm"

[[bearing]]
of = "big-end"
diameter = "48 mm"
width = "19 mm"
relative_clearance = 0.8e-3

[[bearing.groove]]
kind = "hole"
carried_by = "journal"
angle = "60 deg"
diameter = "5 mm"
fed_by = 2

[oil]
viscosity = "8 mPa.s"
density = "850 kg/m3"
"#;

/// The pressure of compression and expansion alone, as a file with its firing top dead centre at 360 deg.
fn pressures(firing_tdc: i32) -> String {
    let mut text = "crank_angle[deg],pressure[bar]\n".to_owned();
    for degree in 0..720 {
        let angle = f64::from(degree - firing_tdc).to_radians();
        let turn = (angle + TAU).rem_euclid(2.0 * TAU) - TAU;
        let volume = 1.0 + 4.5 * (1.0 - turn.cos());
        let pressure = if turn.abs() < PI {
            40.0 / volume.powf(1.3)
        } else {
            2.0
        };
        text += &format!("{degree},{pressure:.6}\n");
    }
    text
}

fn read(text: &str) -> Study {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("pressure.csv"), pressures(0)).unwrap();
    fs::write(directory.path().join("pressure-360.csv"), pressures(360)).unwrap();
    study_from_text("study.toml", text, directory.path())
        .unwrap_or_else(|errors| panic!("{errors}"))
}

fn plan(study: &Study) -> &MachinePlan {
    let Subject::Machine(plan) = &study.subject else {
        panic!()
    };
    plan
}

fn engine(study: &Study) -> &EnginePlan {
    let Machine::Engine(engine) = &plan(study).machine else {
        panic!()
    };
    engine
}

#[test]
fn an_engine_in_si() {
    let study = read(FOUR);
    assert!(study.warnings.is_empty(), "{:?}", study.warnings);
    let (plan, engine) = (plan(&study), engine(&study));
    assert_eq!(engine.train.layout.mains.len(), 5);
    assert!((engine.train.crank_radius - 0.045).abs() < 1e-15);
    assert_eq!(engine.mains, Mains::Determinate);
    assert_eq!(engine.pin_fit, PinFit::Floating);
    assert!((plan.speeds[1] - 4000.0 * PI / 30.0).abs() < 1e-9);
    let names: Vec<&str> = plan.bearings.iter().map(|b| b.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "main-1",
            "main-2",
            "main-3",
            "main-4",
            "main-5",
            "big-end-1",
            "big-end-2",
            "big-end-3",
            "big-end-4"
        ]
    );
    let widths = plan.bearings.iter().map(|b| b.bearing.width);
    let mains: Vec<f64> = widths.take(5).collect();
    assert_eq!(mains, [0.019, 0.019, 0.023, 0.019, 0.019]);
    assert!(
        plan.bearings[2].bearing.feeds.len() == 1,
        "what is left out is that of the others"
    );
    assert_eq!(plan.bearings[5].role, Role::BigEnd);
    // Four throws towards their pins, and one square to the arm of throw 2.
    let unbalances = &engine.train.unbalances;
    assert_eq!(unbalances.len(), 5);
    let throw = engine.train.layout.throws[1];
    assert!((unbalances[1].moment - 0.01).abs() < 1e-15 && unbalances[1].angle == throw.angle);
    assert!((unbalances[4].angle - throw.angle - 0.5 * PI).abs() < 1e-15);
    assert!((unbalances[4].moment - 1e-3).abs() < 1e-15 && unbalances[4].axial == throw.axial);
}

#[test]
fn holes_of_pins_are_counted_from_the_arm_and_fed_through_the_crank() {
    let study = read(FOUR);
    let (plan, engine) = (plan(&study), engine(&study));
    for cylinder in 0..4 {
        let bearing = &plan.bearings[5 + cylinder];
        let feed = &bearing.bearing.feeds[0];
        assert_eq!(feed.carried_by, Carrier::Journal);
        let arm = arm_in_rod_frame(&engine.train, cylinder).unwrap();
        assert!((feed.angle - arm - 60_f64.to_radians()).abs() < 1e-12);
        let speed = 4000.0 * PI / 30.0;
        let (supplied, cycles) = plan.supplied(bearing, speed);
        assert!(cycles.is_empty());
        let (pin, main) = (0.024 * (1.0 - 0.8e-3), 0.026 - 20e-6);
        let outlet = 0.045 * 0.045 + pin * pin + 2.0 * 0.045 * pin * 60_f64.to_radians().cos();
        let head = 0.5 * 850.0 * speed * speed * (outlet - main * main);
        assert!((supplied.feeds[0].pressure - 4e5 - head).abs() < 1e-3);
    }
    // Crank angle 0 is the firing top dead centre of cylinder 1: its arm stands along the rod.
    assert!(arm_in_rod_frame(&engine.train, 0).unwrap().abs() < 1e-12);
}

#[test]
fn the_firing_tdc_of_the_file_is_that_of_the_engine() {
    let study = read(FOUR);
    let other = read(&FOUR.replace(
        "file = \"pressure.csv\"",
        "file = \"pressure-360.csv\"\nfiring_tdc = \"360 deg\"",
    ));
    let diagram = |study: &Study| engine(study).gas.diagram_at(300.0);
    let (a, b) = (diagram(&study), diagram(&other));
    for angle in [0.0, 0.3, 2.0, 7.0, 12.0] {
        assert!(
            (a.at(angle) - b.at(angle)).abs() < 1e-3 * a.at(angle),
            "{angle}"
        );
    }
    assert!(a.peak()[0].abs() < 0.02 && (a.peak()[1] - 4e6).abs() < 1.0);
}

#[test]
fn an_elastic_crankshaft_with_its_supports() {
    let text = FOUR.replace(
        "numbers = [3]",
        "numbers = [3]\noffset = [\"10 um\", \"0 um\"]",
    ) + r#"
[engine.crankshaft]
model = "elastic"
main_length = "26 mm"
pin_length = "24 mm"
web_thickness = "20 mm"
web_width = "80 mm"
support_stiffness = ["500 N/um", "300 N/um"]

[[engine.torsion.disc]]
inertia = "0.01 kg.m2"
throw = 1
damping = "2 N.m.s/rad"
[[engine.torsion.disc]]
inertia = "0.01 kg.m2"
throw = 2
[[engine.torsion.disc]]
inertia = "0.01 kg.m2"
throw = 3
[[engine.torsion.disc]]
inertia = "0.01 kg.m2"
throw = 4
[[engine.torsion.disc]]
inertia = "0.15 kg.m2"
[[engine.torsion.link]]
stiffness = "0.5 MN.m/rad"
[[engine.torsion.link]]
stiffness = "0.5 MN.m/rad"
[[engine.torsion.link]]
stiffness = "0.5 MN.m/rad"
[[engine.torsion.link]]
stiffness = "0.5 MN.m/rad"
loss_factor = 0.2
"#;
    let study = read(&(text + "[engine.torsion]\nloss_factor = 0.03\n"));
    let engine = engine(&study);
    let Mains::Elastic {
        shape,
        supports,
        offsets,
    } = &engine.mains
    else {
        panic!()
    };
    assert!((shape.main_diameter - (0.052 - 40e-6)).abs() < 1e-15);
    assert_eq!(offsets[2], [1e-5, 0.0]);
    assert_eq!(offsets[0], [0.0, 0.0]);
    assert_eq!(
        *supports,
        Supports::Each {
            stiffness: [[5e8, 0.0], [0.0, 3e8]],
            tilt_stiffness: None
        }
    );
    let chain = engine.torsion.as_ref().unwrap();
    assert_eq!(chain.discs[3].throw, Some(3));
    assert_eq!(chain.links[0].loss_factor, 0.03);
    assert_eq!(chain.links[3].loss_factor, 0.2);
}

const SHAFT: &str = r#"
schema = 1
analysis = "shaft"

[shaft]
speed = "6000 rpm"
bearing_positions = ["15 mm", "185 mm"]

[[shaft.section]]
length = "200 mm"
diameter = "30 mm"

[[shaft.unbalance]]
position = "100 mm"
moment = "2 kg.mm"

[[shaft.load]]
position = "60 mm"
force = ["-100 N", "0 N"]

[[bearing]]
diameter = "30 mm"
width = "20 mm"
diametral_clearance = "45 um"

[[bearing.groove]]
kind = "circumferential"
width = "4 mm"
pressure = "3 bar"

[oil]
viscosity = "10 mPa.s"
"#;

#[test]
fn a_shaft_in_si() {
    let study = read(SHAFT);
    assert!(study.warnings.is_empty(), "{:?}", study.warnings);
    let plan = plan(&study);
    let Machine::Shaft(shaft) = &plan.machine else {
        panic!()
    };
    assert!(shaft.is_elastic && shaft.supports == Supports::Rigid && shaft.offsets.is_empty());
    assert_eq!(shaft.bearings, [0.015, 0.185]);
    assert_eq!(shaft.loads[0].points[0], [0.0, -100.0, 0.0]);
    assert!((plan.period() - TAU).abs() < 1e-12);
    assert_eq!(plan.bearings[1].name, "bearing-2");
    assert!((plan.orbit.crank_step - TAU / 360.0).abs() < 1e-12);
}

#[test]
fn a_study_of_one_bearing_has_no_list_of_them() {
    let text = "schema = 1\nanalysis = \"film\"\n[[bearing]]\ndiameter = \"1 mm\"\n[oil]\nviscosity = \"1 mPa.s\"\n[operation]\nspeed = \"1 rpm\"\nrelative_eccentricity = 0.5\n";
    let errors = study_from_text("study.toml", text, Path::new("")).unwrap_err();
    assert!(errors.to_string().contains("has one bearing"), "{errors}");
}
