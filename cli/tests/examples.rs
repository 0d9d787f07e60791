//! Every example, run as a user runs it: exit status, summary, tables, report, and that each answers
//! the question of its page.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, missing_docs)]

mod common;

use common::{Ran, Table, number, root, run};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Keys of every summary.
const ALWAYS: [&str; 9] = [
    "schema",
    "program",
    "version",
    "analysis",
    "title",
    "status",
    "messages",
    "models",
    "wall_time_s",
];
const STEADY: [&str; 15] = [
    "relative_eccentricity",
    "line_of_centres_angle_deg",
    "attitude_angle_deg",
    "sommerfeld_number",
    "minimum_film_thickness_m",
    "peak_film_pressure_pa",
    "friction_torque_journal_n_m",
    "friction_torque_shell_n_m",
    "power_loss_w",
    "side_flow_m3_s",
    "feed_flow_m3_s",
    "mass_balance_relative",
    "complementarity_violation",
    "iterations",
    "wall_time_s",
];
const CYCLE: [&str; 12] = [
    "minimum_film_thickness_m",
    "minimum_film_thickness_angle_deg",
    "peak_film_pressure_pa",
    "peak_film_pressure_angle_deg",
    "mean_power_loss_w",
    "mean_side_flow_m3_s",
    "mean_feed_flow_m3_s",
    "mean_relative_eccentricity",
    "cycle_closure",
    "cycles",
    "steps",
    "film_solves",
];
const CYCLE_COLUMNS: &str = "crank_angle[deg],eccentricity_x[-],eccentricity_y[-],load_x[N],load_y[N],\
                             minimum_film_thickness[m],peak_film_pressure[Pa],power_loss[W],\
                             side_flow[m3/s]";

/// Runs an example and checks what every run promises.
fn example(file: &str) -> Ran {
    let ran = run(&root().join("examples").join(file)).converged();
    let summary = ran.summary();
    for key in ALWAYS {
        assert!(!summary[key].is_null(), "{file}: {key}");
    }
    let keys: &[&str] = match summary["analysis"].as_str() {
        Some("load-cycle") => &CYCLE,
        _ => &STEADY,
    };
    for key in keys {
        number(&summary, key);
    }
    assert!(ran.out.contains("minimum film thickness"), "{}", ran.out);
    for model in summary["models"].as_array().unwrap() {
        assert!(model["reference"].is_string(), "{file}: {model}");
    }
    check_report(file, &ran.report());
    let kept = fs::read_dir(&ran.results).unwrap();
    for entry in kept {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(!name.ends_with(".part"), "{file}: {name}");
    }
    ran
}

/// One file below 10 MB that loads nothing from anywhere.
fn check_report(file: &str, page: &str) {
    assert!(page.len() < 10_000_000, "{file}: {} bytes", page.len());
    assert!(page.contains("default-src 'none'"), "{file}");
    // The drawing library holds addresses that it never loads here.
    let start = page.find("* plotly.js v").unwrap();
    let end = start + page[start..].find("</script>").unwrap();
    let own = format!("{}{}", &page[..start], &page[end..]);
    for loader in ["src=", "@import", "url(", "http:", "https:"] {
        assert!(!own.contains(loader), "{file}: {loader}");
    }
    // Links lead to other places of the page alone.
    let links = own.matches("href=").count();
    assert_eq!(links, own.matches("href=\"#").count(), "{file}");
    assert!(own.contains("<strong>Converged</strong>"), "{file}");
}

/// The table of a load cycle: its columns, a row per degree, its ends on one another.
fn check_cycle(file: &str, ran: &Ran) -> Table {
    let table = ran.cycle();
    assert!(
        table.header.join(",").starts_with(CYCLE_COLUMNS),
        "{:?}",
        table.header
    );
    assert_eq!(table.rows.len(), 721, "{file}");
    for name in CYCLE_COLUMNS.split(',') {
        table.numbers(name);
    }
    assert!(
        table
            .words("status")
            .iter()
            .all(|word| *word == "converged")
    );
    for name in ["eccentricity_x[-]", "eccentricity_y[-]"] {
        let values = table.numbers(name);
        assert!((values[0] - values[720]).abs() < 1e-4, "{file}: {name}");
    }
    let thickness = table.numbers("minimum_film_thickness[m]");
    let least = thickness.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(least, number(&ran.summary(), "minimum_film_thickness_m"));
    table
}

#[test]
fn steady_main_bearing() {
    let ran = example("01-steady-main-bearing/study.toml");
    let summary = ran.summary();
    // The film answers the load, the narrowest gap lies beyond it, what enters leaves.
    let force = summary["force_n"].as_array().unwrap();
    let [x, y] = [0, 1].map(|axis| force[axis].as_f64().unwrap());
    assert!(x.hypot(y - 50e3) < 1e-3 * 50e3, "force {x} {y}");
    assert!((0.0..90.0).contains(&number(&summary, "attitude_angle_deg")));
    assert!(number(&summary, "mass_balance_relative") < 1e-10);
    assert_eq!(number(&summary, "complementarity_violation"), 0.0);
    let (feed, side) = (
        number(&summary, "feed_flow_m3_s"),
        number(&summary, "side_flow_m3_s"),
    );
    assert!((feed / side - 1.0).abs() < 1e-10, "{feed} {side}");
    assert_eq!(summary["limits"][0]["verdict"], "ok");
}

#[test]
fn big_end_of_a_diesel() {
    let ran = example("02-big-end-diesel/study.toml");
    let cycle = check_cycle("02", &ran);
    let summary = ran.summary();
    assert!(number(&summary, "mass_balance_relative") < 1e-10);
    assert_eq!(number(&summary, "complementarity_violation"), 0.0);
    // Over a closed cycle the film stores nothing: the hole gives what leaves at the sides.
    let (feed, side) = (
        number(&summary, "mean_feed_flow_m3_s"),
        number(&summary, "mean_side_flow_m3_s"),
    );
    assert!((feed / side - 1.0).abs() < 0.01, "{feed} {side}");
    // At firing the pin is pressed towards the small end: the film is thin on the side of +x.
    let angles = cycle.numbers("crank_angle[deg]");
    let loads = cycle.numbers("load_x[N]");
    let x = cycle.numbers("eccentricity_x[-]");
    let thickness = cycle.numbers("minimum_film_thickness[m]");
    for (index, angle) in angles.iter().enumerate() {
        if (365.0..=375.0).contains(angle) {
            assert!(x[index] > 0.8, "eccentricity x {} at {angle}", x[index]);
            assert!(loads[index] > 100e3, "load {} at {angle}", loads[index]);
            assert!(thickness[index] < 3e-6, "{} at {angle}", thickness[index]);
        }
    }
    let heaviest = number(&summary, "maximum_load_angle_deg");
    assert!((365.0..=375.0).contains(&heaviest), "{heaviest}");
    let peak = number(&summary, "peak_film_pressure_angle_deg");
    assert!((365.0..=375.0).contains(&peak), "{peak}");
    // The film leaves the wall later than the load.
    let after_firing = (300..460)
        .min_by(|a, b| thickness[*a].total_cmp(&thickness[*b]))
        .unwrap();
    assert!(
        (380.0..=400.0).contains(&angles[after_firing]),
        "thinnest after firing at {}",
        angles[after_firing]
    );
    let least = number(&summary, "minimum_film_thickness_m");
    assert!((1e-6..1.6e-6).contains(&least), "{least}");
}

/// Film thickness against an independent orbit, `crank_deg` and `hminB_um`, within `bar`: row by row
/// and in its minimum.
fn check_flores(ran: &Ran, file: &str, bar: f64) {
    let cycle = check_cycle(file, ran);
    let angles = cycle.numbers("crank_angle[deg]");
    let thickness = cycle.numbers("minimum_film_thickness[m]");
    let between = |angle: f64| {
        let angle = (angle - angles[0]).rem_euclid(720.0) + angles[0];
        let next = angles
            .partition_point(|a| *a < angle)
            .clamp(1, angles.len() - 1);
        let share = (angle - angles[next - 1]) / (angles[next] - angles[next - 1]);
        1e6 * (thickness[next - 1] + share * (thickness[next] - thickness[next - 1]))
    };
    let reference = Table::read(&root().join("validation/flores-2006").join(file));
    let expected = reference.numbers("hminB_um");
    let mut least = f64::INFINITY;
    for (angle, expected) in reference.numbers("crank_deg").iter().zip(expected) {
        let got = between(*angle);
        assert!(
            (got / expected - 1.0).abs() < bar,
            "{file} at {angle} deg: {got} um, expected {expected} um within {bar}"
        );
        least = least.min(expected);
    }
    let got = 1e6 * number(&ran.summary(), "minimum_film_thickness_m");
    assert!(
        (got / least - 1.0).abs() < bar,
        "{file}: minimum {got} um, expected {least} um within {bar}"
    );
}

#[test]
fn one_axis_cycle_on_a_grid() {
    let ran = example("03-one-axis-cycle/study.toml");
    check_flores(&ran, "reference_finite.csv", 0.02);
}

#[test]
fn one_axis_cycle_of_a_short_bearing() {
    let ran = example("03-one-axis-cycle/short-bearing.toml");
    check_flores(&ran, "reference.csv", 0.005);
}

#[test]
fn clearance_of_a_big_end() {
    let ran = run(&root().join("examples/07-clearance-sweep/study.toml")).converged();
    let summary = ran.summary();
    for key in ALWAYS {
        assert!(!summary[key].is_null(), "07: {key}");
    }
    check_report("07", &ran.report());
    let table = Table::read(&ran.results.join("cases.csv"));
    let clearance = table.numbers("bearing.diametral_clearance[um]");
    let expected: Vec<f64> = (4..=12).map(|ten| 10.0 * f64::from(ten)).collect();
    assert_eq!(clearance, expected);
    assert!(
        table
            .words("status")
            .iter()
            .all(|word| *word == "converged")
    );
    // A wider gap carries on a smaller arc, lets more oil out and shears it less.
    let rises = |name: &str| table.numbers(name).windows(2).all(|pair| pair[1] > pair[0]);
    let falls = |name: &str| table.numbers(name).windows(2).all(|pair| pair[1] < pair[0]);
    assert!(falls("minimum_film_thickness[m]") && falls("mean_power_loss[W]"));
    assert!(rises("peak_film_pressure[Pa]") && rises("mean_side_flow[m3/s]"));
    assert!(
        table
            .numbers("mass_balance_relative[-]")
            .iter()
            .all(|value| *value < 1e-10)
    );
    // The page's optimum: the limit is kept up to 70 um.
    let verdicts = table.words("limit_minimum_film_thickness");
    for (clearance, verdict) in clearance.iter().zip(verdicts) {
        let expected = if *clearance < 75.0 { "OK" } else { "exceeded" };
        assert_eq!(verdict, expected, "{clearance} um");
    }
    assert_eq!(
        summary["extremes"]["minimum_film_thickness_m"]["maximum"]["case"],
        1
    );
    assert_eq!(
        summary["extremes"]["peak_film_pressure_pa"]["maximum"]["case"],
        9
    );
}

/// Machines of the examples, run at one of their speeds.
mod machines;

/// Rough surfaces, a real oil, a lining and heat, on a coarser grid and step than the example's own.
#[test]
fn mixed_big_end_of_a_diesel() {
    let changes = [
        ("grid = [64, 16]", "grid = [48, 8]"),
        (
            "period = \"720 deg\"",
            "period = \"720 deg\"\ncrank_step = \"2 deg\"",
        ),
    ];
    let ran = machines::changed("08-big-end-mixed", "study.toml", &changes);
    let summary = ran.summary();
    // As far as Newton goes with the lining and the compressed oil.
    assert!(number(&summary, "mass_balance_relative") < 1e-6);
    assert!(number(&summary, "energy_balance_relative") < 1e-8);
    // What the film makes of heat leaves with its oil.
    let (made, out) = (
        number(&summary, "heat_generated_w"),
        number(&summary, "heat_carried_out_w"),
    );
    assert!((out / made - 1.0).abs() < 0.02, "{made} {out}");
    let temperatures = ["supply", "effective", "outlet", "hottest"]
        .map(|name| number(&summary, &format!("{name}_temperature_degc")));
    let [supply, effective, outlet, hottest] = temperatures;
    assert!(
        supply == 100.0 && effective > supply + 10.0,
        "{temperatures:?}"
    );
    assert!(hottest > effective && outlet > supply, "{temperatures:?}");
    // Asperities touch, and carry little.
    let share = number(&summary, "contact_load_share");
    assert!(share > 0.0 && share < 0.01, "{share}");
    let (boundary, viscous) = (
        number(&summary, "boundary_power_w"),
        number(&summary, "viscous_power_w"),
    );
    assert!(
        boundary > 0.0 && boundary < 0.1 * viscous,
        "{boundary} {viscous}"
    );
    // Within a tenth of the page, whose grid is finer.
    let shown = machines::row("08-big-end-mixed", "all of it, warm");
    for (key, factor, shown) in [
        ("minimum_film_thickness_m", 1e6, shown[0]),
        ("peak_film_pressure_pa", 1e-6, shown[1]),
        ("mean_power_loss_w", 1.0, shown[2]),
    ] {
        let value = factor * number(&summary, key);
        assert!(
            (value / shown - 1.0).abs() < 0.1,
            "{key}: {value}, the page says {shown}"
        );
    }
}

/// A third of the hours of the example: its first rows are those of the page, and the end is named.
#[test]
fn running_in_of_a_big_end() {
    let changes = [("hours = \"2 h\"", "hours = \"1154 s\"")];
    let ran = machines::changed("10-running-in", "study.toml", &changes);
    let summary = ran.summary();
    assert_eq!(summary["running_in_end"], "time-over");
    assert_eq!(number(&summary, "running_in_time_s"), 1154.0);
    let table = Table::read(&ran.results.join("running-in.csv"));
    let columns = [
        ("wear_rate[m/s]", 3600e9),
        ("contact_load_share[-]", 100.0),
        ("minimum_film_thickness[m]", 1e6),
        ("shell_roughness[m]", 1e6),
    ];
    for (row, shown) in [(0, "0"), (table.rows.len() - 1, "0.32")] {
        let shown = machines::row("10-running-in", shown);
        for ((name, factor), shown) in columns.iter().zip(shown) {
            let value = factor * table.numbers(name)[row];
            assert!(
                (value / shown - 1.0).abs() < 0.02,
                "{name}: {value}, the page says {shown}"
            );
        }
    }
    let page = ran.report();
    check_report("10", &page);
    for words in ["Contact over running-in", "Wear rate over running-in"] {
        assert!(page.contains(words), "{words}");
    }
}

/// From creeping to full film: friction falls, has its minimum, and rises; contact only falls.
#[test]
fn stribeck_curve_of_a_bearing() {
    let ran = run(&root().join("examples/09-stribeck/study.toml")).converged();
    check_report("09", &ran.report());
    let table = Table::read(&ran.results.join("cases.csv"));
    let speed = table.numbers("operation.speed[rpm]");
    assert_eq!(speed.len(), 19);
    let torque = table.numbers("friction_torque_journal[N.m]");
    let film = table.numbers("minimum_film_thickness[m]");
    let share = table.numbers("contact_load_share[-]");
    assert!(film.windows(2).all(|pair| pair[1] > pair[0]));
    assert!(share.windows(2).all(|pair| pair[1] < pair[0]));
    let least = (0..19)
        .min_by(|a, b| torque[*a].total_cmp(&torque[*b]))
        .unwrap();
    assert_eq!(speed[least], 1000.0);
    assert!(torque[..=least].windows(2).all(|pair| pair[1] < pair[0]));
    assert!(torque[least..].windows(2).all(|pair| pair[1] > pair[0]));
    // Creeping, friction is nearly the boundary's on what touches.
    let friction = torque[0] / (8e3 * 0.0239);
    assert!(
        (friction / (0.02 * share[0]) - 1.0).abs() < 0.05,
        "{friction}"
    );
    for (speed, shown) in [(5.0, "5 rpm"), (1000.0, "1000 rpm")] {
        let at = table
            .numbers("operation.speed[rpm]")
            .iter()
            .position(|s| *s == speed)
            .unwrap();
        let page = machines::words("09-stribeck", shown);
        let value: f64 = page[0].parse().unwrap();
        let friction = torque[at] / (8e3 * 0.0239);
        assert!((friction - value).abs() < 1e-4 * 0.6, "{friction} {value}");
    }
    example("09-stribeck/bearing.toml");
}

/// Runs a study of a copy of the example of databases, as a user would who has built them.
fn beside_databases(place: &Path, study: &str) -> Value {
    let output = common::sommerfeld()
        .args(["run", study])
        .current_dir(place)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{study}: {told}");
    let results = place.join(study.trim_end_matches(".toml"));
    let summary = common::summary(&results);
    for key in ALWAYS {
        assert!(!summary[key].is_null(), "{study}: {key}");
    }
    check_report(
        study,
        &fs::read_to_string(results.join("report.html")).unwrap(),
    );
    summary
}

/// The example of databases in a place of its own, beside the loads that it names.
fn copied_databases() -> tempfile::TempDir {
    let place = tempfile::tempdir().unwrap();
    for name in ["11-database", "02-big-end-diesel"] {
        let to = place.path().join(name);
        fs::create_dir(&to).unwrap();
        for entry in fs::read_dir(root().join("examples").join(name)).unwrap() {
            let file = entry.unwrap();
            if file.path().is_file() {
                fs::copy(file.path(), to.join(file.file_name())).unwrap();
            }
        }
    }
    place
}

/// Combined tables within 1 % of the field; the error of the superposition is printed, and large.
#[test]
fn film_models_of_a_plain_big_end() {
    let place = copied_databases();
    let place = place.path().join("11-database");
    let combined = beside_databases(&place, "combined.toml");
    assert!(number(&combined, "maximum_relative_error") <= 1e-3);
    beside_databases(&place, "superposition.toml");
    let summary = beside_databases(&place, "study.toml");
    let comparison = &summary["comparison"];
    let off = |model: &str, key: &str| {
        let found = &comparison[model];
        assert_eq!(found["status"], "converged", "{model}: {found}");
        found["difference_percent"][key].as_f64().unwrap()
    };
    let film = "minimum_film_thickness_m";
    for model in ["field", "superposition", "online", "short-bearing"] {
        let [thinnest, peak, power] =
            [film, "peak_film_pressure_pa", "mean_power_loss_w"].map(|key| off(model, key));
        println!(
            "{model}: minimum film {thinnest:+.3} %, peak pressure {peak:+.3} %, power {power:+.3} % of \
             the database, {:.3} s",
            number(&comparison[model], "wall_time_s")
        );
    }
    println!("database: {:.3} s", number(comparison, "own_wall_time_s"));
    assert!(off("field", film).abs() < 1.0, "{}", off("field", film));
    assert!(
        off("superposition", film) > 5.0,
        "{}",
        off("superposition", film)
    );
    // The page shows what the run found.
    for model in ["field", "superposition", "online", "short-bearing"] {
        let page = machines::words("11-database", model);
        let shown: f64 = page[1]
            .trim_end_matches(" %")
            .replace('−', "-")
            .parse()
            .unwrap();
        let found = off(model, film);
        assert!(
            (shown - found).abs() < 0.1,
            "{model}: {found}, the page says {shown}"
        );
    }
}

/// The case of Flores on a database of its bearing.
#[test]
fn one_axis_cycle_on_a_database() {
    let place = tempfile::tempdir().unwrap();
    let from = root().join("examples/03-one-axis-cycle");
    fs::copy(from.join("loads.csv"), place.path().join("loads.csv")).unwrap();
    let field = fs::read_to_string(from.join("study.toml")).unwrap();
    let looked_up = field.replace(
        "model = \"field\"",
        "model = \"database\"\ndatabase = \"films/table.h5\"\ncompare = [\"field\"]",
    );
    fs::write(place.path().join("study.toml"), looked_up).unwrap();
    fs::write(
        place.path().join("films.toml"),
        "schema = 1\nanalysis = \"database\"\n[database]\n[bearing]\ndiameter = \"63.5 mm\"\n\
         width = \"25.4 mm\"\n[film]\ncavitation = \"reynolds\"\n",
    )
    .unwrap();
    beside_databases(place.path(), "films.toml");
    let summary = beside_databases(place.path(), "study.toml");
    let off = &summary["comparison"]["field"]["difference_percent"]["minimum_film_thickness_m"];
    println!("Flores: minimum film of the field {off} % of that of the database");
    assert!(off.as_f64().unwrap().abs() < 1.0, "{off}");
}

#[test]
fn every_example_is_run_here() {
    let mut studies: Vec<String> = Vec::new();
    for entry in fs::read_dir(root().join("examples")).unwrap() {
        let directory = entry.unwrap().path();
        if !directory.is_dir() {
            continue;
        }
        for file in fs::read_dir(&directory).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_some_and(|kind| kind == "toml") {
                let name = |part: &Path| part.file_name().unwrap().to_str().unwrap().to_owned();
                studies.push(format!("{}/{}", name(&directory), name(&path)));
            }
        }
    }
    studies.sort();
    assert_eq!(
        studies,
        [
            "01-steady-main-bearing/study.toml",
            "02-big-end-diesel/study.toml",
            "03-one-axis-cycle/short-bearing.toml",
            "03-one-axis-cycle/study.toml",
            "04-inline-six-diesel/elastic.toml",
            "04-inline-six-diesel/study.toml",
            "05-inline-four-gasoline/study.toml",
            "06-balancer-shaft/determinate.toml",
            "06-balancer-shaft/study.toml",
            "07-clearance-sweep/study.toml",
            "08-big-end-mixed/study.toml",
            "09-stribeck/bearing.toml",
            "09-stribeck/study.toml",
            "10-running-in/study.toml",
            "11-database/combined.toml",
            "11-database/study.toml",
            "11-database/superposition.toml",
        ]
    );
}
