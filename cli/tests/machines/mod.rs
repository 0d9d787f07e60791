//! The engines and the shaft of the examples: the tables of their pages come out of their studies.
//! Speeds are left out, and cells where a page says so, for the sake of time.

use crate::common::{Ran, Table, number, root, run};
use std::fs;
use std::path::Path;

/// An example of a machine with changes to its text, its data beside it.
pub(crate) fn changed(directory: &str, study: &str, changes: &[(&str, &str)]) -> Ran {
    let from = root().join("examples").join(directory);
    let place = tempfile::tempdir().unwrap();
    for entry in fs::read_dir(&from).unwrap() {
        let file = entry.unwrap();
        fs::copy(file.path(), place.path().join(file.file_name())).unwrap();
    }
    let mut text = fs::read_to_string(from.join(study)).unwrap();
    for (old, new) in changes {
        assert_eq!(text.matches(old).count(), 1, "{directory}/{study}: {old}");
        text = text.replace(old, new);
    }
    let file = place.path().join(study);
    fs::write(&file, text).unwrap();
    let ran = run(&file).converged();
    crate::check_report(directory, &ran.report());
    ran
}

/// Cells of the row of a page that begins with this name, after it; the first such row.
pub(crate) fn words(directory: &str, name: &str) -> Vec<String> {
    let page = root().join("examples").join(directory).join("README.md");
    let page = fs::read_to_string(page).unwrap();
    let start = format!("| {name} | ");
    let line = page.lines().find(|line| line.starts_with(&start)).unwrap();
    let cells = line[start.len()..].trim_end_matches(" |").split(" | ");
    cells.map(str::to_owned).collect()
}

/// The same as numbers.
pub(crate) fn row(directory: &str, name: &str) -> Vec<f64> {
    let cells = words(directory, name);
    cells.iter().map(|cell| cell.parse().unwrap()).collect()
}

/// Columns of `bearings.csv` in the order of the tables, the factor into their units, and by how much
/// a figure may be off: twice the last digit that is shown.
const COLUMNS: [(&str, f64, f64); 6] = [
    ("minimum_film_thickness[m]", 1e6, 0.02),
    ("minimum_film_thickness_angle[deg]", 1.0, 2.0),
    ("peak_film_pressure[Pa]", 1e-6, 0.2),
    ("maximum_load[N]", 1e-3, 0.02),
    ("mean_power_loss[W]", 1.0, 0.2),
    ("mean_side_flow[m3/s]", 1e6, 0.02),
];

/// The rows of a run stand in the page, `named` in it as told.
fn check_rows(directory: &str, results: &Path, named: impl Fn(&str) -> String) {
    let table = Table::read(&results.join("bearings.csv"));
    let names = table.words("bearing");
    for (at, (column, factor, off)) in COLUMNS.iter().enumerate() {
        for (name, value) in names.iter().zip(table.numbers(column)) {
            let shown = row(directory, &named(name))[at];
            let value = factor * value;
            assert!(
                (value - shown).abs() <= *off,
                "{directory} {name} {column}: {value}, the page says {shown}"
            );
        }
    }
}

/// A column of a machine, by the name of the bearing.
fn values(ran: &Ran, column: &str) -> impl Fn(&str) -> f64 {
    let table = Table::read(&ran.results.join("bearings.csv"));
    let names: Vec<String> = table
        .words("bearing")
        .iter()
        .map(ToString::to_string)
        .collect();
    let values = table.numbers(column);
    move |name| values[names.iter().position(|at| at == name).unwrap()]
}

#[test]
fn inline_six_on_hinges() {
    let directory = "04-inline-six-diesel";
    let one = [(r#"["1000 rpm", "2000 rpm"]"#, r#""2000 rpm""#)];
    let ran = changed(directory, "study.toml", &one);
    check_rows(directory, &ran.results, str::to_owned);
    let summary = ran.summary();
    // The diagram of the source has 18.947 bar at a peak of 15.2 MPa, and is scaled to the peak at
    // 2000 rpm, interpolated between two rows of its table.
    let peak = 14.9105 + (14.8986 - 14.9105) * (2000.0 - 1998.97) / (2097.09 - 1998.97);
    let imep = 1e-5 * number(&summary, "imep_pa");
    assert!((imep / (18.947 * peak / 15.2) - 1.0).abs() < 1e-3, "{imep}");
    let friction = 1e-5 * number(&summary, "friction_mean_effective_pressure_pa");
    assert!((friction - 0.325).abs() < 1e-3, "{friction}");
    assert!((number(&summary, "mean_torque_n_m") - 1049.1).abs() < 0.2);
    // Six throws are symmetric about main 4: what differs is their twist.
    let load = values(&ran, "maximum_load[N]");
    for (one, other) in [
        ("main-1", "main-7"),
        ("main-2", "main-6"),
        ("main-3", "main-5"),
    ] {
        let ratio = load(one) / load(other);
        assert!((ratio - 1.0).abs() < 0.03, "{one} {other}: {ratio}");
    }
    // What the film of a main is fed leaves at its sides.
    let (feed, side) = (
        values(&ran, "mean_feed_flow[m3/s]"),
        values(&ran, "mean_side_flow[m3/s]"),
    );
    for name in ["main-1", "main-4", "big-end-3"] {
        let ratio = feed(name) / side(name);
        assert!((ratio - 1.0).abs() < 0.02, "{name}: {ratio}");
    }
}

#[test]
fn inline_six_on_an_elastic_crankshaft() {
    let coarse = [
        ("[48, 12]", "[32, 8]"),
        (r#"crank_step = "4 deg""#, r#"crank_step = "6 deg""#),
    ];
    let ran = changed("04-inline-six-diesel", "elastic.toml", &coarse);
    let summary = ran.summary();
    let model = summary["load_model"].as_str().unwrap();
    assert!(model.contains("indeterminate"), "{model}");
    // The page's tables: the film of main 4 is the thinnest, journals tilt by less than 1.2 mrad, and the
    // loads are those of the page to what cells and steps are worth.
    let film = values(&ran, "minimum_film_thickness[m]");
    let tilt = values(&ran, "maximum_tilt[rad]");
    let load = values(&ran, "maximum_load[N]");
    let page = [49.98, 69.94, 68.00, 49.82, 64.98, 64.39, 52.89];
    for (at, page) in page.into_iter().enumerate() {
        let name = format!("main-{}", at + 1);
        assert!(film(&name) >= film("main-4"), "{name}");
        assert!(
            (1e-4..1.2e-3).contains(&tilt(&name)),
            "{name}: {}",
            tilt(&name)
        );
        let load = 1e-3 * load(&name);
        assert!(
            (load / page - 1.0).abs() < 0.04,
            "{name}: {load} kN, {page}"
        );
    }
}

#[test]
fn inline_four_of_gasoline() {
    let directory = "05-inline-four-gasoline";
    // The middle of each list.
    let text = fs::read_to_string(root().join("examples").join(directory).join("study.toml"));
    let text = text.unwrap();
    let lists: Vec<&str> = text
        .lines()
        .filter_map(|line| line.split_once(" = [\"").map(|_| line))
        .collect();
    let middle: Vec<String> = lists
        .iter()
        .map(|line| {
            let (key, list) = line.split_once(" = [").unwrap();
            format!("{key} = {}", list.split(", ").nth(1).unwrap())
        })
        .collect();
    assert_eq!(lists.len(), 7, "{lists:?}");
    let changes: Vec<(&str, &str)> = lists
        .iter()
        .zip(&middle)
        .map(|(old, new)| (*old, new.as_str()))
        .collect();
    let ran = changed(directory, "study.toml", &changes);
    check_rows(directory, &ran.results, str::to_owned);
    // Of all speeds, as the table of the generated gas has them.
    let summary = ran.summary();
    let table = Table::read(&root().join("examples").join(directory).join("gas.csv"));
    let speeds = table.numbers("speed[rpm]");
    let at = speeds.iter().position(|speed| *speed == 4000.0).unwrap();
    let expected = table.numbers("mean_effective_pressure[bar]")[at];
    let imep = 1e-5 * number(&summary, "imep_pa");
    assert!((imep - expected).abs() < 5.1e-4, "{imep} {expected}");
    let friction = 1e-5 * number(&summary, "friction_mean_effective_pressure_pa");
    assert!((friction - 0.310).abs() < 1e-3, "{friction}");
}

#[test]
fn balancer_shaft() {
    let directory = "06-balancer-shaft";
    let one = [(r#"["4000 rpm", "8000 rpm"]"#, r#""8000 rpm""#)];
    for study in ["study.toml", "determinate.toml"] {
        let ran = changed(directory, study, &one);
        check_rows(directory, &ran.results, |_| format!("{study}, 8000 rpm"));
        // Half of the unbalance and half of the weight of 0.87 kg, downwards.
        let speed = 8000.0 * std::f64::consts::PI / 30.0;
        let volume = 0.25 * std::f64::consts::PI * 0.028 * 0.028 * 0.18;
        let expected = 0.5 * (3.747e-3 * speed * speed + 7850.0 * volume * 9.81);
        let load = values(&ran, "maximum_load[N]");
        for name in ["bearing-1", "bearing-2"] {
            let load = load(name);
            assert!((load / expected - 1.0).abs() < 1e-4, "{load} {expected}");
        }
    }
}
