//! `film.compare`: the plain bearing beside the study is the one a user would write by hand.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use serde_json::Value;
use sommerfeld_study::input::study_from_text;
use sommerfeld_study::output::summary;
use sommerfeld_study::run::solve;
use std::ops::ControlFlow;
use std::path::Path;

const BEARING: &str = "[bearing]\ndiameter = \"72 mm\"\nwidth = \"30 mm\"\n";
const SURFACE: &str = "[bearing.surface]\nroughness_journal = \"0.3 um\"\nroughness_shell = \"0.4 um\"\n\
    boundary_friction = 0.08\ncontact = { law = \"greenwood-tripp\", factor = 1e-3, \
    asperity_product = 0.05, modulus = \"53.3 GPa\" }\n";
const LAYER: &str = "[bearing.shell]\nelastic = \"layer\"\nthickness = \"2 mm\"\nmodulus = \"29 GPa\"\npoisson = 0.33\n";
const OIL: &str = "[oil]\nviscosity = { law = \"vogel\", a = \"0.0669 mPa.s\", b = \"1041 K\", c = \"-164.15 K\" }\n\
    viscosity_pressure = { law = \"roelands\", alpha = \"12 1/GPa\" }\n";
const COMPARE: &str = "compare = [\"plain\"]\n";

/// The duty of an analysis.
fn duty(analysis: &str) -> &'static str {
    match analysis {
        "film" => "[operation]\nspeed = \"1000 rpm\"\nrelative_eccentricity = 0.9\n",
        "equilibrium" => "[operation]\nspeed = \"300 rpm\"\nload = [\"20 kN\", \"0 N\"]\n",
        _ => {
            "[load_cycle]\nfile = \"../../examples/02-big-end-diesel/loads.csv\"\nengine_speed = \"2000 rpm\"\n\
             period = \"720 deg\"\ncrank_step = \"6 deg\"\n"
        }
    }
}

fn run(text: &str) -> Value {
    let study = study_from_text("study.toml", text, Path::new(""))
        .unwrap_or_else(|errors| panic!("{errors}"));
    let mut last = 0.0;
    let results = solve(&study, &mut |event| {
        assert!((0.0..=1.0).contains(&event.done));
        last = event.done;
        ControlFlow::Continue(())
    });
    summary(&results.unwrap())
}

fn head(analysis: &str, clearance: &str) -> String {
    format!(
        "schema = 1\nanalysis = \"{analysis}\"\n{BEARING}diametral_clearance = \"{clearance}\"\n"
    )
}

const FILM: &str = "[film]\ncavitation = \"reynolds\"\ngrid = [32, 8]\n";

/// Every figure of the comparison is that of the plain study.
fn is_of(compared: &Value, plain: &Value, least: usize) {
    let found = compared["comparison"]["plain"].as_object().unwrap();
    let figures = found
        .iter()
        .filter(|(key, _)| plain[key.as_str()].is_number() && *key != "wall_time_s");
    assert!(figures.clone().count() >= least, "{found:?}");
    for (key, value) in figures {
        let (a, b) = (value.as_f64().unwrap(), plain[key].as_f64().unwrap());
        assert!((a / b - 1.0).abs() < 1e-9, "{key} {a} {b}");
    }
}

#[test]
fn the_plain_bearing_is_the_one_written_by_hand() {
    for analysis in ["film", "equilibrium"] {
        let real = run(&format!(
            "{}{SURFACE}{LAYER}{OIL}temperature = \"90 degC\"\n{FILM}{COMPARE}{}",
            head(analysis, "72 um"),
            duty(analysis)
        ));
        assert_eq!(
            real["status"], "converged",
            "{analysis}: {}",
            real["messages"]
        );
        // Vogel at 90 degC: a exp(b / (T + c)).
        let viscosity = 0.0669 * (1041.0_f64 / (90.0 + 109.0)).exp();
        let plain = run(&format!(
            "{}[oil]\nviscosity = \"{viscosity} mPa.s\"\n{FILM}{}",
            head(analysis, "72 um"),
            duty(analysis)
        ));
        is_of(&real, &plain, 5);
        let figure = |of: &Value| of["peak_film_pressure_pa"].as_f64().unwrap();
        let change = figure(&real) / figure(&real["comparison"]["plain"]);
        assert!((change - 1.0).abs() > 1e-3, "{analysis}: {change}");
        assert_eq!(real["comparison"]["plain"]["temperature_degc"], 90.0);
    }
}

/// A study that is plain itself is compared with itself.
#[test]
fn a_plain_study_differs_in_nothing() {
    for analysis in ["film", "equilibrium"] {
        let text = format!(
            "{}[oil]\nviscosity = \"12 mPa.s\"\ntemperature = \"100 degC\"\n{FILM}{COMPARE}{}",
            head(analysis, "72 um"),
            duty(analysis)
        );
        let found = run(&text);
        is_of(&found, &found, 5);
    }
}

/// With a heat balance the plain bearing has the temperature and the clearance that it led to.
#[test]
fn the_plain_bearing_is_as_warm() {
    let real = run(&format!(
        "{}{SURFACE}{OIL}heat_capacity = \"2000 J/(kg.K)\"\n[heat]\nmodel = \"balance\"\n\
         supply_temperature = \"70 degC\"\n[heat.expansion]\njournal = \"11.5e-6 1/K\"\n\
         housing = \"23e-6 1/K\"\n{FILM}{COMPARE}{}",
        head("equilibrium", "72 um"),
        duty("equilibrium")
    ));
    let number = |key: &str| real[key].as_f64().unwrap_or_else(|| panic!("{key}"));
    let temperature = number("effective_temperature_degc");
    let at = real["comparison"]["plain"]["temperature_degc"]
        .as_f64()
        .unwrap();
    assert!(temperature > 70.0 && at == temperature);
    let viscosity = 0.0669 * (1041.0 / (temperature + 109.0)).exp();
    let clearance = format!("{} m", number("warm_diametral_clearance_m"));
    let plain = run(&format!(
        "{}[oil]\nviscosity = \"{viscosity} mPa.s\"\n{FILM}{}",
        head("equilibrium", &clearance),
        duty("equilibrium")
    ));
    is_of(&real, &plain, 5);
}

/// A position that only asperities hold has no plain film: the study stands, and says so.
#[test]
fn a_position_without_a_plain_film_is_named() {
    let text = format!(
        "{}{SURFACE}[oil]\nviscosity = \"8 mPa.s\"\n{FILM}{COMPARE}[operation]\nspeed = \"100 rpm\"\nrelative_eccentricity = 1.005\n",
        head("film", "72 um")
    );
    let found = run(&text);
    assert_eq!(found["status"], "converged");
    assert_eq!(found["comparison"]["plain"]["status"], "no-solution");
    let messages = found["messages"].as_array().unwrap();
    let named = |message: &Value| {
        message
            .as_str()
            .unwrap()
            .starts_with("comparison: the plain")
    };
    assert!(messages.iter().any(named), "{messages:?}");
}

/// A cycle beside itself, and its rough one beside the plain one.
#[test]
fn a_cycle_is_compared() {
    let cycle = |surface: &str, compare: &str| {
        run(&format!(
            "{}{surface}[oil]\nviscosity = \"8 mPa.s\"\n{FILM}{compare}{}",
            head("load-cycle", "72 um"),
            duty("load-cycle")
        ))
    };
    let plain = cycle("", "");
    let rough = cycle(SURFACE, COMPARE);
    is_of(&rough, &plain, 5);
}
