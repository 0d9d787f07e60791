//! Every output format on made-up results: keys, tables that read back, a report that is safe,
//! self-contained and honest about what did not converge.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod synthetic;

use serde_json::Value;
use sommerfeld_film::Outcome;
use sommerfeld_study::cases::{CaseRecord, CaseStatus, SweepResults, VariedColumn};
use sommerfeld_study::output::{WRITERS, case_table, check_directory, summary, write_all};
use sommerfeld_study::report::render;
use sommerfeld_study::results::{Body, Results};
use std::path::PathBuf;

const HOSTILE: &str = "</script><script>alert(1)</script> & \"quotes\"";

fn all() -> [Results; 4] {
    [
        synthetic::load_cycle("cycle"),
        synthetic::load_cycle_not_converged("cycle"),
        synthetic::steady("steady"),
        synthetic::dimensionless("integrals"),
    ]
}

/// A directory of this test run that nobody else uses.
fn directory(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&path);
    path
}

fn number(summary: &Value, key: &str) -> f64 {
    summary[key].as_f64().unwrap_or_else(|| {
        assert!(summary[key].is_number(), "{key} is {}", summary[key]);
        f64::NAN
    })
}

/// The page without the drawing library, which holds addresses it never loads here.
fn own_part(page: &str) -> String {
    let start = page.find("* plotly.js v").unwrap_or(page.len());
    let end = page[start..]
        .find("</script>")
        .map_or(start, |at| start + at);
    format!("{}{}", &page[..start], &page[end..])
}

#[test]
fn summary_always_has_the_header() {
    for results in all() {
        let summary = summary(&results);
        assert_eq!(summary["schema"], 1);
        assert_eq!(summary["program"], "sommerfeld");
        for key in ["version", "analysis", "title", "status"] {
            assert!(summary[key].is_string(), "{key}");
        }
        assert!(summary["messages"].is_array() && summary["models"].is_array());
        assert!(number(&summary, "wall_time_s") > 0.0);
    }
}

/// A run that was killed before its summary leaves tables: the same command takes the directory.
#[test]
fn tables_without_their_summary_are_known() {
    let mut tables = 0;
    for (index, results) in all().iter().enumerate() {
        let directory = directory(&format!("killed-{index}"));
        let files = write_all(results, &directory).unwrap();
        std::fs::remove_file(directory.join("summary.json")).unwrap();
        tables += files
            .iter()
            .filter(|f| f.extension().is_some_and(|e| e == "csv"))
            .count();
        check_directory(&directory, &[]).unwrap();
        // Results of another kind leave none of these tables beside their summary.
        write_all(&synthetic::dimensionless("integrals"), &directory).unwrap();
        let left = std::fs::read_dir(&directory).unwrap();
        let left = left.map(|entry| entry.unwrap().path());
        assert_eq!(
            left.filter(|f| f.extension().is_some_and(|e| e == "csv"))
                .count(),
            0
        );
    }
    assert!(tables >= 4, "{tables}");
}

#[test]
fn summary_of_a_load_cycle_has_its_keys() {
    let summary = summary(&synthetic::load_cycle("cycle"));
    for key in [
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
    ] {
        number(&summary, key);
    }
    assert_eq!(summary["cycles"], 4);
    // Means of harmonics over whole periods are their constant parts.
    assert!((number(&summary, "mean_power_loss_w") - 460.0).abs() < 1e-6);
    assert!((number(&summary, "mean_side_flow_m3_s") - 8e-6).abs() < 1e-12);
    assert_eq!(summary["error"]["minimum_film_thickness_m"], 2.1e-8);
    assert_eq!(summary["limits"][0]["name"], "minimum_film_thickness");
    assert_eq!(summary["limits"][1]["verdict"], "exceeded");
}

#[test]
fn summary_of_a_steady_state_has_its_keys() {
    let summary = summary(&synthetic::steady("steady"));
    for key in [
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
    ] {
        number(&summary, key);
    }
    assert_eq!(summary["force_n"], serde_json::json!([-10e3, 0.0]));
    assert_eq!(summary["stiffness_n_m"][1][0], -1.27e9);
    let attitude = 0.6f64.atan2(0.8).to_degrees();
    assert!((number(&summary, "attitude_angle_deg") - attitude).abs() < 1e-6);
}

#[test]
fn summary_of_the_dimensionless_problem_has_its_integrals() {
    let summary = summary(&synthetic::dimensionless("integrals"));
    for key in ["p_cos", "p_sin", "p_z_cos", "p_z_sin", "peak"] {
        number(&summary["integrals"], key);
    }
    assert_eq!(summary["error"]["integrals"]["p_cos"], 1.5e-4);
}

#[test]
fn what_is_not_finite_becomes_null() {
    let mut results = synthetic::steady("steady");
    if let Body::Steady(steady) = &mut results.body {
        steady.sommerfeld_number = f64::INFINITY;
        steady.summary.peak_film_pressure.value = f64::NAN;
    }
    let summary = summary(&results);
    assert!(summary["sommerfeld_number"].is_null() && summary["peak_film_pressure_pa"].is_null());
    render(&results).unwrap();
}

#[test]
fn an_empty_orbit_is_reported_not_refused() {
    let mut results = synthetic::load_cycle("empty");
    results.header.status = Outcome::NoSolution;
    if let Body::LoadCycle(cycle) = &mut results.body {
        cycle.orbit.points.clear();
        cycle.feed_flows.clear();
    }
    assert!(summary(&results)["minimum_film_thickness_m"].is_null());
    assert!(render(&results).unwrap().contains("No solution"));
}

#[test]
fn the_cycle_table_reads_back() {
    let directory = directory("cycle-table");
    let results = synthetic::load_cycle_not_converged("cycle");
    write_all(&results, &directory).unwrap();
    let mut reader = csv::Reader::from_path(directory.join("cycle.csv")).unwrap();
    let header = reader.headers().unwrap().clone();
    let fixed = "crank_angle[deg],eccentricity_x[-],eccentricity_y[-],load_x[N],load_y[N],\
                 minimum_film_thickness[m],peak_film_pressure[Pa],power_loss[W],side_flow[m3/s]";
    let names: Vec<&str> = header.iter().collect();
    assert!(names.join(",").starts_with(fixed), "{names:?}");
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let Body::LoadCycle(cycle) = &results.body else {
        unreachable!("a load cycle was built")
    };
    assert_eq!(rows.len(), cycle.orbit.points.len());
    assert_eq!(&rows[90][0], "90.0");
    let loaded: f64 = rows[372][3].parse().unwrap();
    assert_eq!(loaded, cycle.orbit.points[372].load[0]);
    assert_eq!(names.last(), Some(&"status"));
    assert_eq!(rows[372].iter().next_back(), Some("not-converged"));
    let feeds = ["feed_1_flow[m3/s]", "feed_2_flow[m3/s]"];
    let pressures = ["feed_1_pressure[Pa]", "feed_2_pressure[Pa]"];
    let last = names.len() - 1;
    assert_eq!(names[last - 4..last], [feeds, pressures].concat());
    assert_eq!(&rows[372][last - 1], "500000.0");
}

#[test]
fn the_field_table_has_a_row_per_cell() {
    let directory = directory("field-table");
    write_all(&synthetic::steady("steady"), &directory).unwrap();
    let mut reader = csv::Reader::from_path(directory.join("film.csv")).unwrap();
    assert_eq!(
        reader.headers().unwrap(),
        &csv::StringRecord::from(vec![
            "angle[deg]",
            "axial[mm]",
            "pressure[Pa]",
            "film_fraction[-]",
            "film_thickness[m]"
        ])
    );
    assert_eq!(reader.records().count(), 128 * 32);
}

/// Two cases of a sweep over the made-up bearing, the second one failed.
fn sweep() -> Results {
    let steady = synthetic::steady("steady");
    let record = |number, status, summary: String| CaseRecord {
        number,
        status,
        message: if number == 1 {
            String::new()
        } else {
            HOSTILE.into()
        },
        summary,
        wall_time: 0.5,
    };
    let mut sweep = SweepResults {
        base: "base.toml".into(),
        mode: "grid",
        varied: vec![VariedColumn {
            key: "bearing.width".into(),
            unit: "mm".into(),
            tells_apart: true,
        }],
        ..SweepResults::default()
    };
    let done = record(1, CaseStatus::Converged, summary(&steady).to_string());
    let failed = record(2, CaseStatus::Failed, "{}".into());
    sweep.push(1, vec!["30 mm".into()], vec![Some(30.0)], Some(&done));
    sweep.push(2, vec!["40 mm".into()], vec![Some(40.0)], Some(&failed));
    sweep.push(3, vec!["50 mm".into()], vec![Some(50.0)], None);
    let mut header = steady.header;
    header.analysis = "sweep".into();
    header.status = Outcome::NotConverged;
    header.limits.clear();
    Results {
        header,
        body: Body::Sweep(Box::new(sweep)),
    }
}

#[test]
fn a_sweep_counts_and_names_its_cases() {
    let results = sweep();
    let found = summary(&results);
    for (key, expected) in [
        ("cases", 3.0),
        ("converged", 1.0),
        ("failed", 1.0),
        ("not_run", 1.0),
    ] {
        assert_eq!(number(&found, key), expected, "{key}");
    }
    assert_eq!(
        found["varied"][0]["values"],
        serde_json::json!(["30 mm", "40 mm", "50 mm"])
    );
    assert_eq!(
        found["extremes"]["stiffness_n_m.yx"]["minimum"]["value"],
        -1.27e9
    );
    assert_eq!(found["cases_not_converged"][0]["case"], 2);
    let Body::Sweep(cases) = &results.body else {
        unreachable!("a sweep was built")
    };
    let table = case_table(cases).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_slice());
    let header = reader.headers().unwrap().clone();
    let place = |name: &str| header.iter().position(|column| column == name).unwrap();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(
        (
            &rows[0][place("bearing.width[mm]")],
            &rows[0][place("status")]
        ),
        ("30.0", "converged")
    );
    assert_eq!(&rows[0][place("stiffness_yx[N/m]")], "-1270000000.0");
    assert_eq!(&rows[1][place("force_x[N]")], "nan");
    assert_eq!(&rows[1][place("message")], HOSTILE);
    assert_eq!(&rows[2][place("status")], "not-run");
    let page = own_part(&render(&results).unwrap());
    assert!(page.contains("Not every case converged") && page.contains("1 failed, 1 not run"));
    assert!(!page.contains("<script>alert") && !page.contains("src="));
}

#[test]
fn files_appear_whole_and_alone() {
    let directory = directory("whole");
    let files = write_all(&synthetic::load_cycle("cycle"), &directory).unwrap();
    for writer in WRITERS {
        let path = directory.join(writer.file_name());
        // A load cycle has no stability chart, no cases, no other bearings, no engine, and this one wears none.
        let others = [
            "stability.csv",
            "cases.csv",
            "bearings.csv",
            "engine.csv",
            "running-in.csv",
        ];
        let name = writer.file_name();
        let is_due = !others.contains(&name) && !name.starts_with("cycle-");
        assert_eq!(files.contains(&path), is_due, "{}", path.display());
    }
    let mut found = 0;
    for place in [directory.clone(), directory.join("paraview")] {
        for entry in std::fs::read_dir(&place).unwrap() {
            let path = entry.unwrap().path();
            assert!(path.is_dir() || files.contains(&path), "{}", path.display());
            found += usize::from(path.is_file());
        }
    }
    assert_eq!(found, files.len());
}

#[test]
fn the_report_is_one_offline_file() {
    for results in all() {
        let page = render(&results).unwrap();
        assert!(page.len() < 10_000_000);
        assert!(page.contains("default-src 'none'"));
        let own = own_part(&page);
        // Links lead to places of the page itself.
        assert_eq!(
            own.matches("href=").count(),
            own.matches("href=\"#").count()
        );
        for loader in ["src=", "@import", "url(", "http:", "https:"] {
            assert!(!own.contains(loader), "{loader}");
        }
    }
}

#[test]
fn the_report_escapes_what_users_write() {
    let mut results = synthetic::load_cycle(HOSTILE);
    results.header.messages.push(HOSTILE.into());
    results.header.study_text = HOSTILE.into();
    results.header.inputs[0].value = HOSTILE.into();
    let own = own_part(&render(&results).unwrap());
    assert!(!own.contains("<script>alert"));
    assert!(own.contains("&lt;script&gt;alert(1)"));
    let scripts = own.matches("<script").count();
    assert_eq!((scripts, own.matches("</script>").count()), (3, 3));
}

#[test]
fn the_report_of_a_cycle_holds_the_standard_package() {
    let page = own_part(&render(&synthetic::load_cycle("cycle")).unwrap());
    for kind in [
        "film-solid",
        "film-pressure",
        "film-fraction",
        "load-polar",
        "load-polar-journal",
        "orbit",
        "eccentricity",
        "thickness",
        "pressure",
        "power",
        "flow",
        "feed-flows",
        "shell-amplitude",
        "journal-pressure",
    ] {
        assert!(page.contains(&format!("data-kind=\"{kind}\"")), "{kind}");
    }
    assert!(
        page.contains("id=\"frame\"") && page.contains("is loaded least for an oil hole of 6 mm")
    );
    assert!(page.contains("Limit exceeded") && page.contains("± 0.021"));
    assert!(page.contains("data-key=\"mean_power_loss_w\" data-value=\""));
}

#[test]
fn a_cycle_without_fields_has_no_film_to_show() {
    let mut results = synthetic::load_cycle("closed form");
    if let Body::LoadCycle(cycle) = &mut results.body {
        cycle.fields = None;
    }
    let page = own_part(&render(&results).unwrap());
    assert!(page.contains("data-kind=\"orbit\"") && !page.contains("data-kind=\"film-solid\""));
}

#[test]
fn the_report_warns_beyond_laminar_flow() {
    let mut results = synthetic::steady("fast");
    assert!(!own_part(&render(&results).unwrap()).contains("Beyond laminar flow"));
    if let Body::Steady(steady) = &mut results.body {
        steady.summary.reynolds_number = 1500.0;
    }
    assert!(own_part(&render(&results).unwrap()).contains("Beyond laminar flow"));
}

#[test]
fn the_report_says_what_did_not_converge() {
    let page = own_part(&render(&synthetic::load_cycle_not_converged("cycle")).unwrap());
    assert!(page.contains("<strong>Not converged</strong>"));
    assert!(page.contains("class=\"badge\">Not converged"));
    assert!(page.contains("Points not converged"));
    assert!(page.contains("not evaluated") && !page.contains("<b>OK</b>"));
    let good = own_part(&render(&synthetic::load_cycle("cycle")).unwrap());
    assert!(good.contains("<strong>Converged</strong>") && !good.contains("class=\"badge\""));
}
