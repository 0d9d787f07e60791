//! A result beyond what the physics can mean says so, and an ordinary one says nothing.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_oil::{DensityLaw, Lubricant, ViscosityLaw};
use sommerfeld_study::input::{HeatPlan, study_from_text};
use sommerfeld_study::output::{summary, write_all};
use sommerfeld_study::results::Results;
use sommerfeld_study::sanity::{Hottest, hot_film};
use sommerfeld_study::{Outcome, solve};
use std::ops::ControlFlow;
use std::path::Path;

/// Messages of a converged equilibrium.
fn messages(load: &str, speed: &str, grid: &str) -> Vec<String> {
    let text = format!(
        "schema = 1\nanalysis = \"equilibrium\"\n[bearing]\ndiameter = \"72 mm\"\n\
         width = \"30 mm\"\ndiametral_clearance = \"72 um\"\n[oil]\nviscosity = \"8 mPa.s\"\n\
         [film]\ncavitation = \"reynolds\"\ngrid = {grid}\n\
         [operation]\nspeed = \"{speed}\"\nload = [\"{load}\", \"0 N\"]\n"
    );
    let study = study_from_text("study.toml", &text, Path::new("")).unwrap();
    let results = solve(&study, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(results.header.status, Outcome::Converged);
    let told = summary(&results)["messages"].to_string();
    for message in &results.header.messages {
        assert!(told.contains(message.as_str()), "{told}");
    }
    results.header.messages
}

#[test]
fn an_ordinary_film_has_no_warning() {
    assert_eq!(
        messages("10 kN", "2000 rpm", "[64, 8]"),
        Vec::<String>::new()
    );
}

#[test]
fn a_load_that_no_bearing_carries_is_named() {
    let found = messages("10 MN", "2000 rpm", "[128, 32]");
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].starts_with("the minimum film thickness, 0.0"));
    assert!(found[0].contains("below 0.1 um"), "{found:?}");
    assert!(found[1].starts_with("the peak film pressure, "));
    assert!(found[1].contains("above 1 GPa"), "{found:?}");
}

/// 41.1 sqrt(0.036/36e-6) = 1300 is reached at Re = 850 * omega * 0.036 * 36e-6 / 0.008, that is at
/// omega = 9439 rad/s, 90 136 rpm.
#[test]
fn a_flow_that_is_not_laminar_is_named() {
    assert_eq!(
        messages("10 kN", "90000 rpm", "[64, 8]"),
        Vec::<String>::new()
    );
    let found = messages("10 kN", "91000 rpm", "[64, 8]");
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("Taylor vortices"), "{found:?}");
    // It is the journal that drives them, in either sense.
    assert_eq!(messages("10 kN", "-91000 rpm", "[64, 8]").len(), 1);
}

/// Results of a study, whatever they are.
fn solved(text: &str) -> Results {
    let study = study_from_text("study.toml", text, Path::new(""));
    let study = study.unwrap_or_else(|errors| panic!("{errors}"));
    solve(&study, &mut |_| ControlFlow::Continue(())).unwrap()
}

/// A grooved bearing with so much of an oil, heat and load.
fn warm_bearing(oil: &str, heat: &str, operation: &str) -> String {
    format!(
        "schema = 1\nanalysis = \"equilibrium\"\n[bearing]\ndiameter = \"72 mm\"\n\
         width = \"30 mm\"\ndiametral_clearance = \"72 um\"\n[[bearing.groove]]\nkind = \"axial\"\n\
         carried_by = \"shell\"\nangle = \"180 deg\"\nposition = \"0 mm\"\nlength = \"20 mm\"\n\
         width = \"10 mm\"\npressure = \"4 bar\"\n[oil]\n{oil}\ndensity = \"850 kg/m3\"\n{heat}\n[film]\n\
         cavitation = \"mass-conserving\"\ngrid = [64, 8]\n[operation]\n{operation}\n"
    )
}

const THINNING: &str =
    "viscosity = { law = \"vogel\", a = \"0.13 mPa.s\", b = \"900 K\", c = \"-163.15 K\" }";
const FIELD: &str = "[heat]\nmodel = \"field\"\nsupply_temperature = \"100 degC\"";
const HEAVY: &str = "speed = \"2000 rpm\"\nload = [\"60 kN\", \"0 N\"]";

/// The message stands in the summary and the report as the others do.
fn hot_message(results: &Results) -> String {
    let hot = |text: &&String| text.contains("degC, is above");
    let mut found = results.header.messages.iter().filter(hot);
    let message = found.next().unwrap_or_else(|| panic!("{results:?}"));
    assert!(found.next().is_none());
    let told = summary(results)["messages"].to_string();
    assert!(told.contains(message.as_str()), "{told}");
    let directory = tempfile::tempdir().unwrap();
    write_all(results, directory.path()).unwrap();
    let page = std::fs::read_to_string(directory.path().join("report.html")).unwrap();
    assert!(page.contains("no lubricating oil lives there"));
    message.clone()
}

/// Heat that only the oil carries away, out of a film that is far too thin: the solution is one of the
/// equations, not of an oil.
#[test]
fn a_film_too_hot_for_any_oil_is_named() {
    let results = solved(&warm_bearing(THINNING, FIELD, HEAVY));
    assert_eq!(results.header.status, Outcome::Converged);
    let heat = results.header.heat.as_ref().unwrap();
    let hottest = heat.field.as_ref().unwrap().hottest;
    assert!(hottest > 800.0, "{hottest}");
    let message = hot_message(&results);
    assert!(
        message.starts_with("the hottest place of the film, "),
        "{message}"
    );
    assert!(message.contains("above 250 degC"), "{message}");
    assert!(message.contains("heat.wall_coefficient"), "{message}");

    let light = HEAVY.replace("60 kN", "5 kN");
    let results = solved(&warm_bearing(THINNING, FIELD, &light));
    assert_eq!(results.header.status, Outcome::Converged);
    assert_eq!(results.header.messages, Vec::<String>::new());
}

#[test]
fn one_temperature_too_hot_for_any_oil_is_named() {
    let thick = "viscosity = \"100 mPa.s\"";
    // The laws of heat that are not given end at 204 degC, and the balance with them.
    let thick =
        &format!("{thick}\nheat_capacity = \"2100 J/(kg.K)\"\nconductivity = \"0.14 W/(m.K)\"");
    let balance = FIELD.replace("field", "balance");
    let fast = "speed = \"3000 rpm\"\nload = [\"10 kN\", \"0 N\"]";
    let results = solved(&warm_bearing(thick, &balance, fast));
    assert_eq!(results.header.status, Outcome::Converged);
    let effective = results.header.heat.as_ref().unwrap().effective_temperature;
    assert!(effective > 523.15, "{effective}");
    let message = hot_message(&results);
    assert!(message.starts_with("the effective temperature of the film, "));
    assert!(message.contains("a larger conductance"), "{message}");

    let given = format!("{thick}\ntemperature = \"300 degC\"");
    let message = hot_message(&solved(&warm_bearing(&given, "", fast)));
    assert!(message.starts_with("the temperature of the film, 300 degC, is above 250 degC"));
    assert!(message.ends_with("not as a temperature"), "{message}");
}

/// Below the end of all oils an oil's own laws may end: this one has 2 mm2/s, the least of ASTM D341, at
/// some 120 degC.
#[test]
fn temperatures_beyond_the_laws_of_the_oil_are_named() {
    let thin = ViscosityLaw::AstmD341 {
        kv40: 10e-6,
        kv100: 2.6e-6,
    };
    let oil = Lubricant::newtonian(thin, DensityLaw::Constant { density: 850.0 });
    let end = oil.temperature_range().high;
    assert!((383.15..403.15).contains(&end), "{end}");
    let told = |temperature| {
        let hottest = Hottest {
            what: Hottest::EFFECTIVE,
            temperature,
        };
        hot_film(&hottest, &oil, &HeatPlan::Given)
    };
    assert_eq!(told(end), None);
    let message = told(end + 1.0).unwrap();
    assert!(
        message.contains("where the laws of this oil end"),
        "{message}"
    );
    assert!(
        told(523.2)
            .unwrap()
            .contains("no lubricating oil lives there")
    );
    assert_eq!(told(f64::NAN), None);
}

/// A machine names the bearing and the speed at which it is hottest.
#[test]
fn a_bearing_of_a_machine_that_is_too_hot_is_named() {
    let text = "schema = 1\nanalysis = \"shaft\"\n[shaft]\nmodel = \"determinate\"\n\
        speed = [\"5000 rpm\", \"6000 rpm\"]\nbearing_positions = [\"30 mm\", \"150 mm\"]\n\
        gravity = [\"-9.81 m/s2\", \"0 m/s2\"]\n[[shaft.section]]\nlength = \"180 mm\"\n\
        diameter = \"72 mm\"\n[[shaft.unbalance]]\nposition = \"60 mm\"\nmoment = \"1000 kg.mm\"\n\
        [[bearing]]\ndiameter = \"72 mm\"\nwidth = \"30 mm\"\ndiametral_clearance = \"72 um\"\n\
        [orbit]\ncrank_step = \"10 deg\"\nmaximum_cycles = 60\n[oil]\nviscosity = \"100 mPa.s\"\n\
        density = \"850 kg/m3\"\nheat_capacity = \"2100 J/(kg.K)\"\nconductivity = \"0.14 W/(m.K)\"\n\
        HEAT[film]\nmodel = \"short-bearing\"\ncavitation = \"gumbel\"\n";
    let balance = "[heat]\nmodel = \"balance\"\nsupply_temperature = \"80 degC\"\n";
    let results = solved(&text.replace("HEAT", balance));
    let messages = &results.header.messages;
    assert_eq!(results.header.status, Outcome::Converged, "{messages:?}");
    assert_eq!(messages.len(), 2, "{messages:?}");
    for (message, bearing) in messages.iter().zip(["bearing-1", "bearing-2"]) {
        let start = format!("{bearing} at 6000 rpm: the effective temperature of the film, 3");
        assert!(message.starts_with(&start), "{message}");
        assert!(message.contains("above 250 degC"), "{message}");
    }
    // One temperature that is given for all is one message.
    let results = solved(&text.replace("HEAT", "temperature = \"300 degC\"\n"));
    let message = hot_message(&results);
    assert!(message.starts_with("the temperature of the film, 300 degC"));
}
