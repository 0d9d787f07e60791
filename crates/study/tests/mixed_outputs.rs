//! What outputs say of asperities that touch, of heat, and of a plain bearing beside this one.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

#[allow(dead_code, reason = "other tests need the rest")]
mod synthetic;

use serde_json::Value;
use sommerfeld_study::cases::{CaseRecord, CaseStatus, SweepResults, VariedColumn};
use sommerfeld_study::output::{summary, write_all};
use sommerfeld_study::report::render;
use sommerfeld_study::results::{Body, Results};
use std::path::PathBuf;
use synthetic::mixed;

fn number(summary: &Value, key: &str) -> f64 {
    let at = key.split('.').fold(summary, |value, part| &value[part]);
    at.as_f64().unwrap_or_else(|| {
        assert!(at.is_number(), "{key} is {at}");
        f64::NAN
    })
}

fn near(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
}

/// The page without the drawing library.
fn own_part(results: &Results) -> String {
    let page = render(results).unwrap();
    let start = page.find("* plotly.js v").unwrap_or(page.len());
    let end = page[start..]
        .find("</script>")
        .map_or(start, |at| start + at);
    format!("{}{}", &page[..start], &page[end..])
}

#[test]
fn contact_and_friction_have_their_keys() {
    let [steady, cycle] = mixed::both("mixed").each_ref().map(summary);
    // 0.912 N m over 10 kN and 36 mm.
    near(
        number(&steady, "friction_coefficient"),
        0.912 / (10e3 * 0.036),
    );
    near(number(&steady, "contact_load_share"), 0.1);
    near(number(&cycle, "contact_load_share"), 0.1);
    for summary in [&steady, &cycle] {
        let thinnest = number(summary, "minimum_film_thickness_m");
        near(number(summary, "film_parameter"), thinnest / 0.5e-6);
    }
    let smooth = summary(&synthetic::steady("smooth"));
    assert!(smooth["film_parameter"].is_null() && smooth["comparison"].is_null());
    near(
        number(&smooth, "friction_coefficient"),
        0.912 / (10e3 * 0.036),
    );
}

#[test]
fn a_plain_run_stands_under_the_keys_of_the_study() {
    let [steady, cycle] = mixed::both("mixed").each_ref().map(summary);
    for (summary, keys) in [
        (&steady, ["power_loss_w", "side_flow_m3_s"]),
        (&cycle, ["mean_power_loss_w", "mean_side_flow_m3_s"]),
    ] {
        for key in keys
            .iter()
            .chain(&["minimum_film_thickness_m", "peak_film_pressure_pa"])
        {
            let plain = number(summary, &format!("comparison.plain.{key}"));
            assert_eq!(plain, number(summary, key), "{key}");
        }
        near(number(summary, "comparison.plain.temperature_degc"), 80.0);
        assert_eq!(summary["comparison"]["plain"]["status"], "converged");
        assert!(summary["comparison"]["plain"]["contact_load_share"].is_null());
    }
}

#[test]
fn the_report_shows_contact_heat_and_the_plain_bearing() {
    let words = [
        "data-kind=\"film-contact\"",
        "data-kind=\"film-temperature\"",
        "Beside a plain bearing",
        "<h3>Heat</h3>",
        "Contact and friction",
        "Hottest cell: 120.0 °C",
        "345.0 W · 75.00 %",
    ];
    for results in mixed::both("mixed") {
        let page = own_part(&results);
        for word in words {
            assert!(page.contains(word), "{word}");
        }
        let found = summary(&results);
        for key in ["contact_load_share", "effective_temperature_degc"] {
            let card = format!(
                "data-key=\"{key}\" data-value=\"{:?}\"",
                number(&found, key)
            );
            assert!(page.contains(&card), "{card}");
        }
        let is_cycle = matches!(results.body, Body::LoadCycle(_));
        for kind in ["contact-load", "friction-split"] {
            let kind = format!("data-kind=\"{kind}\"");
            assert_eq!(page.contains(&kind), is_cycle, "{kind}");
        }
        let mut balanced = results;
        balanced.header.heat = Some(mixed::balance());
        let page = own_part(&balanced);
        assert!(page.contains("Radial clearance, as given") && page.contains("102.0"));
    }
}

#[test]
fn what_is_not_there_is_not_shown() {
    for results in [synthetic::steady("smooth"), synthetic::load_cycle("smooth")] {
        let page = own_part(&results);
        for word in [
            "film-contact\"",
            "film-temperature\"",
            "Beside a plain",
            "<h3>Heat",
            "Contact and",
        ] {
            assert!(!page.contains(&format!("data-kind=\"{word}")), "{word}");
            assert!(!page.contains(&format!("<h3>{word}")), "{word}");
        }
    }
}

#[test]
fn a_plain_run_without_numbers_is_named() {
    for mut results in mixed::both("mixed") {
        let plain = results.header.plain.as_mut().unwrap();
        plain.body = None;
        plain.status = sommerfeld_film::Outcome::NoSolution;
        assert_eq!(
            summary(&results)["comparison"]["plain"]["status"],
            "no-solution"
        );
        assert!(own_part(&results).contains("That run has no numbers: no solution."));
    }
}

/// The films for ParaView hold the two fields where there are any.
#[test]
fn both_fields_are_stored_where_they_exist() {
    let mut both: Vec<(Results, bool)> = mixed::both("mixed").map(|one| (one, true)).into();
    both.push((synthetic::steady("smooth"), false));
    for (index, (results, has_fields)) in both.iter().enumerate() {
        let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("mixed-{index}"));
        let _ = std::fs::remove_dir_all(&directory);
        let files = write_all(results, &directory).unwrap();
        let films = files
            .iter()
            .filter(|f| f.extension().is_some_and(|e| e == "vts"));
        for film in films {
            let text = std::fs::read_to_string(film).unwrap();
            for name in ["contact pressure [Pa]", "temperature [K]"] {
                assert_eq!(text.contains(name), *has_fields, "{name}");
            }
        }
    }
}

fn speeds(summaries: [Value; 2], key: &str) -> Results {
    let mut sweep = SweepResults {
        base: "base.toml".into(),
        mode: "grid",
        varied: vec![VariedColumn {
            key: key.into(),
            unit: "rpm".into(),
            tells_apart: true,
        }],
        ..SweepResults::default()
    };
    for (number, summary) in (1..).zip(summaries) {
        let record = CaseRecord {
            number,
            status: CaseStatus::Converged,
            message: String::new(),
            summary: summary.to_string(),
            wall_time: 0.1,
        };
        let speed = 100.0 * number as f64;
        sweep.push(
            number,
            vec![format!("{speed} rpm")],
            vec![Some(speed)],
            Some(&record),
        );
    }
    Results {
        header: synthetic::header("sweep", "speeds"),
        body: Body::Sweep(Box::new(sweep)),
    }
}

#[test]
fn a_sweep_over_speed_with_contact_is_a_stribeck_curve() {
    let [steady, _] = mixed::both("mixed");
    // The faster case has half of the friction.
    let pair = |results: &Results| {
        let mut faster = summary(results);
        let friction = faster["friction_coefficient"].as_f64().unwrap();
        faster["friction_coefficient"] = (0.5 * friction).into();
        [summary(results), faster]
    };
    let page = own_part(&speeds(pair(&steady), "operation.speed"));
    assert!(
        page.contains("data-kind=\"stribeck\"")
            && !page.contains("data-kind=\"friction_coefficient\"")
    );
    assert!(page.contains("Smallest friction coefficient"));
    // What both cases share stands in the table alone.
    assert!(page.contains("Specific load") && !page.contains("data-kind=\"specific_load_pa\""));
    // Over another key, or without contact, friction stands alone.
    let other = own_part(&speeds(pair(&steady), "bearing.width"));
    let smooth = synthetic::steady("smooth");
    let smooth = own_part(&speeds(pair(&smooth), "operation.speed"));
    for page in [other, smooth] {
        assert!(
            !page.contains("data-kind=\"stribeck\"")
                && page.contains("data-kind=\"friction_coefficient\"")
        );
        assert!(!page.contains("Smallest friction coefficient"));
    }
}

#[test]
fn the_columns_of_a_comparison_have_units() {
    let [steady, _] = mixed::both("mixed");
    let results = speeds([summary(&steady), summary(&steady)], "operation.speed");
    let Body::Sweep(sweep) = &results.body else {
        unreachable!("a sweep was built")
    };
    let column = sweep.column("comparison.plain.power_loss_w").unwrap();
    let column = &sweep.columns[column];
    assert_eq!(
        (column.name.as_str(), column.unit),
        ("power_loss_plain", "W")
    );
}
