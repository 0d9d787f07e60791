//! Heat of the bearings of engines and shafts: each at its own temperature, as if it were alone.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    missing_docs,
    reason = "a test may stop at the first surprise"
)]

use sommerfeld_study::input::{Subject, study_from_text};
use sommerfeld_study::output::{summary, write_all};
use sommerfeld_study::results::machine::BearingResults;
use sommerfeld_study::results::{Body, Results};
use sommerfeld_study::{Outcome, solve};
use std::ops::ControlFlow;
use std::path::Path;

const OIL: &str = r#"
[oil]
viscosity = { law = "vogel", a = "0.06 mPa.s", b = "1000 K", c = "180 K" }
density = "850 kg/m3"
heat_capacity = "2100 J/(kg.K)"

[heat]
model = "balance"
supply_temperature = "80 degC"
conductance = "0.2 W/K"
surroundings_temperature = "30 degC"

[heat.expansion]
journal = "11.5e-6 1/K"
housing = "14e-6 1/K"

[film]
model = "short-bearing"
cavitation = "gumbel"
"#;

const ENGINE: &str = r#"
schema = 1
analysis = "engine"

[engine]
layout = "inline"
cylinders = 1
cylinder_spacing = "100 mm"
bore = "86 mm"
stroke = "86 mm"
rod_length = "145 mm"
piston_mass = "0.45 kg"
rod_mass = "0.58 kg"
rod_centre_of_gravity = "42 mm"
rod_inertia = "2.6e-3 kg.m2"
speed = ["3000 rpm"]

[engine.combustion]
compression_ratio = 10.5
heat = "1.45 kJ"

[[engine.combustion.burning]]
start = "-15 deg"
duration = "60 deg"

[[bearing]]
of = "main"
diameter = "54 mm"
width = "24 mm"
diametral_clearance = "42 um"

[[bearing]]
of = "big-end"
diameter = "48 mm"
width = "22 mm"
diametral_clearance = "38 um"

[orbit]
crank_step = "4 deg"
"#;

fn solved(text: &str, directory: &Path) -> Results {
    let study = study_from_text("study.toml", text, directory);
    let study = study.unwrap_or_else(|errors| panic!("{errors}"));
    solve(&study, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn bearing<'r>(results: &'r Results, name: &str) -> &'r BearingResults {
    let Body::Machine(machine) = &results.body else {
        panic!("no machine")
    };
    let mut all = machine.speeds[0].bearings.iter();
    all.find(|bearing| bearing.name == name).unwrap()
}

/// What a film makes leaves with its oil and by conduction: `rho c Q 2 (T - T_in) + k (T - T_surroundings)`.
/// Returns the temperature of the film, K.
fn assert_balanced(found: &BearingResults) -> f64 {
    let heat = found.heat.as_ref().unwrap();
    let lost = found.cycle.orbit.mean_power_loss();
    let per_kelvin = 850.0 * 2100.0 * found.cycle.orbit.mean_side_flow() * 2.0;
    let rise = heat.effective_temperature - heat.supply_temperature;
    let carried = per_kelvin * rise;
    let conducted = 0.2 * (heat.effective_temperature - 303.15);
    assert!((heat.conducted / conducted - 1.0).abs() < 1e-9);
    // The oil that leaves is twice as far above the supply as the film.
    let outlet = heat.supply_temperature + 2.0 * rise;
    assert!((heat.outlet_temperature - outlet).abs() < 1e-9, "{heat:?}");
    // The temperatures stand to 0.05 K; a warmer film makes less heat by about as much again.
    let bar = (per_kelvin + 0.2) * 0.05 * 2.0;
    let left = lost - carried - conducted;
    let name = &found.name;
    assert!(left.abs() < bar, "{name}: {lost} {carried} {conducted}");
    assert!(lost > 0.0 && heat.trials.len() > 1, "{name}: {heat:?}");
    assert_eq!(
        found.cycle.bearing.radial_clearance, heat.radial_clearance,
        "{name}"
    );
    heat.effective_temperature
}

/// A study with these bearings of its machine alone.
fn solved_alone(text: &str, names: &[&str]) -> Results {
    let mut study = study_from_text("study.toml", text, Path::new("")).unwrap();
    let Subject::Machine(plan) = &mut study.subject else {
        panic!("no machine")
    };
    plan.bearings
        .retain(|bearing| names.contains(&bearing.name.as_str()));
    assert_eq!(plan.bearings.len(), names.len());
    solve(&study, &mut |_| ControlFlow::Continue(())).unwrap()
}

/// The bearing of an engine as a load cycle of its own, under the loads that the engine wrote to
/// `directory`; sizes in mm and um.
fn load_cycle(name: &str, directory: &Path, [diameter, width, clearance]: [u32; 3]) -> Results {
    let text = format!(
        "schema = 1\nanalysis = \"load-cycle\"\n[bearing]\ndiameter = \"{diameter} mm\"\n\
         width = \"{width} mm\"\ndiametral_clearance = \"{clearance} um\"\n[load_cycle]\n\
         file = \"loads-{name}.csv\"\nengine_speed = \"3000 rpm\"\nperiod = \"720 deg\"\n\
         crank_step = \"4 deg\"\n{OIL}"
    );
    let results = solved(&text, directory);
    assert_eq!(results.header.status, Outcome::Converged, "{name}");
    results
}

/// A bearing of an engine finds the temperature, clearance and film of the load-cycle study that takes the
/// loads which the engine wrote, number by number.
#[test]
fn a_bearing_of_an_engine_is_as_warm_as_alone() {
    let directory = tempfile::tempdir().unwrap();
    let engine = solved(&format!("{ENGINE}{OIL}"), directory.path());
    assert_eq!(engine.header.status, Outcome::Converged);
    write_all(&engine, directory.path()).unwrap();
    let keys = summary(&engine);
    for (name, diameter, width, clearance) in [("big-end-1", 48, 22, 38), ("main-1", 54, 24, 42)] {
        let alone = load_cycle(name, directory.path(), [diameter, width, clearance]);
        let (own, alone_keys) = (bearing(&engine, name), summary(&alone));
        let heat = own.heat.as_ref().unwrap();
        let single = alone.header.heat.as_ref().unwrap();
        assert!(
            heat.effective_temperature > 273.15 + 80.2,
            "{name}: {heat:?}"
        );
        let apart = heat.effective_temperature - single.effective_temperature;
        assert!(apart.abs() < 1e-6, "{name}: {heat:?} {single:?}");
        assert!((heat.radial_clearance / single.radial_clearance - 1.0).abs() < 1e-9);
        // The housing grows more than the journal.
        assert!(heat.radial_clearance > heat.given_radial_clearance);
        assert_eq!(own.cycle.bearing.radial_clearance, heat.radial_clearance);
        let listed = keys["bearings"].as_array().unwrap();
        let listed = listed.iter().find(|one| one["name"] == name).unwrap();
        for key in [
            "minimum_film_thickness_m",
            "peak_film_pressure_pa",
            "mean_power_loss_w",
            "mean_side_flow_m3_s",
            "effective_temperature_degc",
            "outlet_temperature_degc",
            "conducted_heat_w",
            "warm_diametral_clearance_m",
        ] {
            let (a, b) = (&listed[key], &alone_keys[key]);
            let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
            assert!((a / b - 1.0).abs() < 1e-6, "{name} {key}: {a} {b}");
        }
    }
    let table = std::fs::read_to_string(directory.path().join("bearings.csv")).unwrap();
    let header = table.lines().next().unwrap();
    assert!(header.contains("effective_temperature[degC],outlet_temperature[degC]"));
    let page = std::fs::read_to_string(directory.path().join("report.html")).unwrap();
    assert!(page.contains("Temperatures of every bearing"));
}

const SHAFT: &str = r#"
schema = 1
analysis = "shaft"

[shaft]
model = "elastic"
speed = ["6000 rpm"]
bearing_positions = ["30 mm", "150 mm"]
gravity = ["-9.81 m/s2", "0 m/s2"]

[[shaft.section]]
length = "180 mm"
diameter = "28 mm"

[[shaft.unbalance]]
position = "60 mm"
moment = "0.5 kg.mm"

[[bearing]]
diameter = "28 mm"
width = "18 mm"
diametral_clearance = "50 um"

[orbit]
crank_step = "10 deg"
"#;

/// The films of one elastic shaft settle together: what each makes of power leaves with its oil and by
/// conduction, at a temperature of its own.
#[test]
fn the_films_of_an_elastic_shaft_are_balanced_together() {
    let film = OIL.replace(
        "model = \"short-bearing\"\ncavitation = \"gumbel\"",
        "cavitation = \"gumbel\"\ngrid = [32, 8]",
    );
    let results = solved(&format!("{SHAFT}{film}"), Path::new(""));
    let messages = &results.header.messages;
    assert_eq!(results.header.status, Outcome::Converged, "{messages:?}");
    let Body::Machine(machine) = &results.body else {
        panic!("no machine")
    };
    let mut warmth = Vec::new();
    for found in &machine.speeds[0].bearings {
        warmth.push(assert_balanced(found));
    }
    assert_eq!(warmth.len(), 2);
    assert!((warmth[0] - warmth[1]).abs() > 0.05, "{warmth:?}");
}

/// Bearings that share an orbit share its temperature, and it is the one that each would find by itself:
/// two cylinders that fire a turn apart.
#[test]
fn bearings_that_share_an_orbit_are_as_warm_as_alone() {
    let two = ENGINE.replace("cylinders = 1", "cylinders = 2\nfiring_order = [1, 2]");
    let two = two.replace("crank_step", "closure_tolerance = 1e-4\ncrank_step");
    let text = format!("{two}{OIL}");
    let together = solved(&text, Path::new(""));
    assert_eq!(together.header.status, Outcome::Converged);
    let Body::Machine(machine) = &together.body else {
        panic!("no machine")
    };
    let mut later = 0;
    for found in &machine.speeds[0].bearings {
        assert_balanced(found);
        let Some(from) = &found.turned_from else {
            continue;
        };
        later += 1;
        assert_eq!(found.heat, bearing(&together, &from.name).heat);
        let alone = solved_alone(&text, &[&found.name]);
        let alone = bearing(&alone, &found.name);
        assert!(alone.turned_from.is_none());
        assert_balanced(alone);
        let of = |one: &BearingResults| one.heat.as_ref().unwrap().effective_temperature;
        let apart = of(found) - of(alone);
        assert!(apart.abs() < 1e-3, "{}: {apart} K", found.name);
        let (a, b) = (&found.cycle, &alone.cycle);
        assert!((a.bearing.radial_clearance / b.bearing.radial_clearance - 1.0).abs() < 1e-6);
        let power = a.orbit.mean_power_loss() / b.orbit.mean_power_loss();
        let flow = a.orbit.mean_side_flow() / b.orbit.mean_side_flow();
        assert!(
            (power - 1.0).abs() < 1e-4 && (flow - 1.0).abs() < 1e-4,
            "{power} {flow}"
        );
    }
    // The outer mains and the big ends.
    assert_eq!(later, 2);
}

/// Both films of a pin that floats are balanced at the speed at which their torques cancel, and as warm as
/// alone under it: oil that splashes into a film which makes less than what is conducted away leaves it
/// colder than it came.
#[test]
fn the_films_of_a_floating_pin_are_as_warm_as_alone() {
    let pin = "[[bearing]]\nof = \"small-end\"\ndiameter = \"22 mm\"\nwidth = \"22 mm\"\n\
        diametral_clearance = \"24 um\"\n[[bearing]]\nof = \"piston-boss\"\ndiameter = \"22 mm\"\n\
        width = \"26 mm\"\ndiametral_clearance = \"26 um\"\n[orbit]";
    // Under the full load the thinnest films make torques that jump from row to row of 4 deg.
    let light = ENGINE.replace("1.45 kJ", "0.5 kJ");
    let engine = format!("{}{OIL}", light.replace("[orbit]", pin));
    let directory = tempfile::tempdir().unwrap();
    let results = solved(&engine, directory.path());
    let messages = &results.header.messages;
    assert_eq!(results.header.status, Outcome::Converged, "{messages:?}");
    write_all(&results, directory.path()).unwrap();
    for (name, sizes) in [
        ("small-end-1", [22, 22, 24]),
        ("piston-boss-1", [22, 26, 26]),
    ] {
        let found = bearing(&results, name);
        let warm = assert_balanced(found);
        let alone = load_cycle(name, directory.path(), sizes);
        let single = alone.header.heat.as_ref().unwrap();
        let apart = warm - single.effective_temperature;
        assert!(apart.abs() < 1e-6, "{name}: {apart} K");
        let keys = summary(&alone);
        let power = keys["mean_power_loss_w"].as_f64().unwrap();
        let own = found.cycle.orbit.mean_power_loss();
        assert!((own / power - 1.0).abs() < 1e-6, "{name}: {own} {power}");
    }
}

/// One throw between two mains is determinate: on a crankshaft that hardly bends, where temperatures and orbits take
/// turns, its mains are as warm as under hinges, where each finds its own.
#[test]
fn the_mains_of_an_elastic_crankshaft_are_as_warm_as_under_hinges() {
    let bar = "[engine.crankshaft]\nmodel = \"elastic\"\nmain_length = \"30 mm\"\n\
        pin_length = \"26 mm\"\nweb_thickness = \"22 mm\"\nweb_width = \"90 mm\"\n\
        youngs_modulus = \"1000 GPa\"\nsupport_stiffness = [\"1000 N/um\", \"1000 N/um\"]\n\
        support_tilt_stiffness = [\"1 kN.m/rad\", \"1 kN.m/rad\"]\n[engine.combustion]";
    let light = ENGINE
        .replace("1.45 kJ", "0.5 kJ")
        .replace("4 deg", "10 deg");
    let light = light.replace("crank_step", "closure_tolerance = 1e-4\ncrank_step");
    let film = OIL.replace("model = \"short-bearing\"", "grid = [24, 6]");
    let mains = ["main-1", "main-2"];
    let hinged = solved_alone(&format!("{light}{film}"), &mains);
    let elastic = light.replace("[engine.combustion]", bar);
    let elastic = solved_alone(&format!("{elastic}{film}"), &mains);
    let messages = &elastic.header.messages;
    assert_eq!(elastic.header.status, Outcome::Converged, "{messages:?}");
    for name in mains {
        let (a, b) = (bearing(&elastic, name), bearing(&hinged, name));
        assert!(a.determinate_load.is_some() && b.determinate_load.is_none());
        let apart = assert_balanced(a) - assert_balanced(b);
        // Each stands to 0.05 K.
        assert!(apart.abs() < 0.1, "{name}: {apart} K");
        let power = a.cycle.orbit.mean_power_loss() / b.cycle.orbit.mean_power_loss();
        assert!((power - 1.0).abs() < 5e-3, "{name}: {power}");
    }
}

/// What stays refused says what to do.
#[test]
fn a_field_of_temperature_is_refused_for_machines_by_name() {
    let conduction = "conductance = \"0.2 W/K\"\nsurroundings_temperature = \"30 degC\"\n";
    let field = OIL.replace("model = \"balance\"", "model = \"field\"");
    let field = field.replace(conduction, "");
    let refused = |text: &str| {
        let study = study_from_text("study.toml", text, Path::new(""));
        study.unwrap_err().to_string()
    };
    let told = refused(&format!("{ENGINE}{field}"));
    let what = "heat.model = \"field\" of the analysis engine is not built yet";
    assert!(told.contains(what), "{told}");
    assert!(told.contains("given, balance") && told.contains("loads-<name>.csv"));
    let shell = format!(
        "{ENGINE}{OIL}\n[heat.expansion.shell]\nthickness = \"2 mm\"\n\
         housing_diameter = \"90 mm\"\ninterference = \"50 um\"\n"
    );
    let told = refused(&shell);
    assert!(told.contains("heat.expansion.shell of a machine"), "{told}");
    let tight = OIL.replace("14e-6", "0.5e-6").replace("11.5e-6", "23e-6");
    let told = refused(&format!("{ENGINE}{tight}"));
    assert!(
        told.contains("no clearance at the supply temperature"),
        "{told}"
    );
}
