//! Validation cases that a study file can state, run as a user runs them.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

mod common;

use common::{Table, number, reference, root, run, run_text};

/// Short bearing after Friswell et al.: the digits that the source prints.
#[test]
fn short_bearing_rotor() {
    let study = root().join("validation/short-bearing-rotor/study.toml");
    let summary = run(&study).converged().summary();
    for (name, key) in [("stiffness", "stiffness_n_m"), ("damping", "damping_n_s_m")] {
        for (i, row) in ["x", "y"].iter().enumerate() {
            for (j, column) in ["x", "y"].iter().enumerate() {
                let quantity = format!("{name}_{row}{column}");
                let expected = reference("short-bearing-rotor", &quantity);
                let got = summary[key][i][j].as_f64().unwrap();
                assert!(
                    (got / expected - 1.0).abs() < 1e-6,
                    "{quantity}: {got}, expected {expected}"
                );
            }
        }
    }
    let eccentricity = reference("short-bearing-rotor", "relative_eccentricity");
    assert!((number(&summary, "relative_eccentricity") - eccentricity).abs() < 1e-6);
    let attitude = reference("short-bearing-rotor", "attitude_angle");
    assert!((number(&summary, "attitude_angle_deg") - attitude).abs() < 1e-3);
}

/// Rigid rotors after validation/whirl-threshold, as studies: mass and whirl ratio of the threshold within
/// 0.1 %, the rotor stable at 0.97 and unstable at 1.03 of it, and the onset over speed at its speed.
#[test]
fn whirl_threshold() {
    let table = Table::read(&root().join("validation/whirl-threshold/reference.csv"));
    let (width, diameter, clearance) = (0.02, 0.05, 25e-6);
    let (viscosity, speed) = (0.01, 300.0);
    for row in &table.rows {
        let column = |index: usize| row[index].parse::<f64>().unwrap();
        // Ss = eta D omega B^3/(8 c^2 W), omega_bar = omega sqrt(M c/W).
        let load: f64 = viscosity * diameter * speed * f64::powi(width, 3)
            / (8.0 * clearance * clearance * column(1));
        let mass = (column(12) / speed).powi(2) * load / clearance;
        let study = |share: f64| {
            format!(
                "schema = 1\nanalysis = \"coefficients\"\n[bearing]\ndiameter = \"{diameter} m\"\n\
                 width = \"{width} m\"\ndiametral_clearance = \"{} m\"\n[oil]\nviscosity = \
                 \"{viscosity} Pa.s\"\n[film]\nmodel = \"short-bearing\"\n[operation]\nspeed = \
                 \"{speed} rad/s\"\nload = [\"{load} N\", \"0 N\"]\nrotor_mass = \"{} kg\"\n\
                 speeds = [\"200 rad/s\", \"280 rad/s\", \"350 rad/s\"]\n",
                2.0 * clearance,
                share * mass
            )
        };
        for share in [0.97_f64, 1.03] {
            // The threshold is a speed at a given mass; at a given speed it is a mass with its square.
            let summary = run_text(&study(share * share), "").converged().summary();
            let found = number(&summary, "whirl_threshold_mass_kg");
            assert!((found / mass - 1.0).abs() < 2e-3, "{row:?}: {found} {mass}");
            let ratio = number(&summary, "whirl_ratio");
            assert!((ratio / column(11) - 1.0).abs() < 1e-3, "{row:?}: {ratio}");
            assert_eq!(summary["stable"], share < 1.0, "{row:?}");
            let margin = number(&summary, "stability_margin");
            assert!((margin * share * share - found / mass).abs() < 1e-9);
        }
        let summary = run_text(&study(1.0), "").converged().summary();
        let onset = number(&summary["whirl_onsets"][0], "journal_speed_rad_s");
        assert!((onset / speed - 1.0).abs() < 1e-3, "{row:?}: {onset}");
    }
}

/// The study of a row of the tilted table.
fn dimensionless(row: &[String]) -> String {
    let right_side = match row[7].as_str() {
        "D" => "wedge = 1.0\nsqueeze = 0.0",
        "V" => "wedge = 0.0\nsqueeze = 1.0",
        _ => "wedge = 0.0\nsqueeze = -1.0",
    };
    let float = |text: &str| format!("{:?}", text.parse::<f64>().unwrap());
    format!(
        "schema = 1\nanalysis = \"film\"\n[film]\ncavitation = \"reynolds\"\ninlet = \"cyclic\"\n\
         [operation]\ndimensionless = true\nd_over_b = {}\nrelative_eccentricity = {}\n\
         tilt_gamma = {}\ntilt_delta = {}\n{right_side}\n",
        float(&row[0]),
        float(&row[1]),
        float(&row[2]),
        float(&row[5])
    )
}

/// The default grid through the command: every eighth open row (the tests of the film take all),
/// within 0.5 % of the force vector and of the moment scale where H_min > 0.1; closed rows refused.
#[test]
fn tilted_table() {
    let table = Table::read(&root().join("validation/tilted-table/reference.csv"));
    let (mut open, mut closed) = (0, 0);
    for row in table.rows.iter().filter(|row| row[8] == "closed") {
        let ran = run_text(&dimensionless(row), "");
        assert_eq!(ran.code, Some(2), "{row:?}\n{}{}", ran.out, ran.err);
        assert!(ran.err.contains("the gap closes at phi"), "{}", ran.err);
        closed += 1;
    }
    let is_due = |row: &&Vec<String>| row[8] == "ok" && row[6].parse::<f64>().unwrap() > 0.1;
    for row in table.rows.iter().filter(is_due).step_by(8) {
        let summary = run_text(&dimensionless(row), "").converged().summary();
        let got =
            ["p_cos", "p_sin", "p_z_cos", "p_z_sin"].map(|key| number(&summary["integrals"], key));
        let expected = [9, 10, 11, 12].map(|column| row[column].parse::<f64>().unwrap());
        let force = expected[0].hypot(expected[1]);
        // Moments that vanish by symmetry are held against a tenth of the force.
        let moment = expected[2].hypot(expected[3]).max(0.1 * force);
        let off = |k: usize| (got[k] - expected[k]).hypot(got[k + 1] - expected[k + 1]);
        assert!(off(0) < 0.005 * force, "{row:?}: {got:?}");
        assert!(off(2) < 0.005 * moment, "{row:?}: {got:?}");
        open += 1;
    }
    assert!(open >= 8 && closed >= 3, "{open} open, {closed} closed");
}

/// A large bearing on an oil that stiffens: the study answers as the equilibrium of the page does.
#[test]
fn comsol_ehl() {
    let study = root().join("validation/comsol-ehl/study.toml");
    let summary = run(&study).converged().summary();
    let table =
        std::fs::read_to_string(root().join("validation/comsol-ehl/equilibria.csv")).unwrap();
    let row: Vec<f64> = table
        .lines()
        .find(|line| line.starts_with("100,"))
        .unwrap()
        .split(',')
        .map(|cell| cell.parse().unwrap())
        .collect();
    let film = 1e6 * number(&summary, "minimum_film_thickness_m");
    let eps = number(&summary, "relative_eccentricity");
    assert!((film / row[3] - 1.0).abs() < 1e-3, "{film} um, {}", row[3]);
    assert!((eps - row[1]).abs() < 1e-4, "{eps}, {}", row[1]);
}

/// The plain big end over its load cycle, within 1 % of the independent orbit beside the study. The bar
/// of the first row, 1.349 um, is not met on any grid; the README of the case shows the figures.
#[test]
fn plain_big_end() {
    let study = root().join("validation/plain-big-end/study.toml");
    let summary = run(&study).converged().summary();
    let thickness = 1e6 * number(&summary, "minimum_film_thickness_m");
    let angle = number(&summary, "minimum_film_thickness_angle_deg");
    let case = |quantity| reference("plain-big-end", quantity);
    let expected = case("independent_orbit_minimum_film_thickness");
    println!(
        "{thickness:.4} um at {angle} deg; independent orbit {expected} um, first row {} um",
        case("minimum_film_thickness")
    );
    assert!(
        (thickness / expected - 1.0).abs() < 0.01,
        "{thickness} um, expected {expected} um within 1 %"
    );
    // The rows of the table stand every 2 deg.
    let expected = case("independent_orbit_minimum_film_thickness_angle");
    assert!((angle - expected).abs() <= 2.0, "{angle}, {expected} deg");
}
