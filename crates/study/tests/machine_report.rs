//! The report of engines and shafts on made-up results: its pages, its tables, its size.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

#[expect(
    dead_code,
    reason = "the results of single bearings are for other tests"
)]
mod synthetic;

use serde_json::Value;
use sommerfeld_film::Outcome;
use sommerfeld_study::report::render;
use sommerfeld_study::results::machine::MachineResults;
use sommerfeld_study::results::{Body, Results};
use synthetic::machine::{inline_six, shaft};

const LARGEST_REPORT: usize = 10_000_000;
const HOSTILE: &str = "</script><script>alert(1)</script> & \"quotes\"";

fn machine(results: &mut Results) -> &mut MachineResults {
    match &mut results.body {
        Body::Machine(machine) => machine,
        _ => unreachable!("a machine was built"),
    }
}

/// What stands before the data: all that a reader without a script sees.
fn text(page: &str) -> &str {
    &page[..page.find("<script type=\"application/json\"").unwrap()]
}

/// The data of the figures.
fn data(page: &str) -> Value {
    let start = page.find("id=\"data\">").unwrap() + "id=\"data\">".len();
    let end = start + page[start..].find("</script>").unwrap();
    serde_json::from_str(&page[start..end]).unwrap()
}

#[test]
fn an_engine_has_its_page_and_one_for_each_bearing() {
    let page = render(&inline_six("engine", 1, true)).unwrap();
    let text = text(&page);
    assert_eq!(text.matches("<section class=\"page").count(), 14);
    for link in ["#engine", "#b-main-1", "#b-main-7", "#b-big-end-6"] {
        assert!(text.contains(&format!("href=\"{link}\"")), "{link}");
    }
    for (kind, count) in [
        ("gas-pressure", 1),
        ("pressure-volume", 1),
        ("torque-orders", 1),
        ("moment-orders", 1),
        ("twist", 1),
        ("polars", 1),
        ("overview-thickness", 1),
        ("orbit", 13),
        ("load-polar", 13),
        ("load-polar-journal", 13),
        ("film-pressure", 13),
        ("tilt", 7),
        ("load-models", 7),
    ] {
        let found = text.matches(&format!("data-kind=\"{kind}\"")).count();
        assert_eq!(found, count, "{kind}");
    }
    assert!(text.contains("statically indeterminate") && text.contains("crankpin"));
    assert!(!text.contains("<select"), "one speed is no choice");
}

#[test]
fn thirteen_bearings_at_eight_speeds_can_be_sent() {
    let page = render(&inline_six("engine", 8, true)).unwrap();
    assert!(page.len() < LARGEST_REPORT, "{}", page.len());
    let cycles = data(&page)["cycles"].clone();
    assert_eq!(cycles.as_array().unwrap().len(), 13);
    for bearing in cycles.as_array().unwrap() {
        for cycle in bearing.as_array().unwrap() {
            assert!(cycle["cycle"]["angle"]["count"].as_u64().unwrap() >= 240);
            assert!(cycle["film"]["pressure"]["data"].is_string());
        }
    }
    assert_eq!(text(&page).matches("<option").count(), 8);
}

#[test]
fn the_worst_bearing_is_named_with_its_speed() {
    let mut results = inline_six("engine", 3, false);
    let point = &mut machine(&mut results).speeds[1].bearings[9]
        .cycle
        .orbit
        .points[77];
    point.summary.minimum_film_thickness.value = 0.25e-6;
    let limits: Vec<_> = results
        .header
        .limits
        .iter()
        .map(|check| check.limit.clone())
        .collect();
    results.check_limits(&limits);
    assert_eq!(results.header.limits[0].found, Some(0.25e-6));
    let page = render(&results).unwrap();
    let text = text(&page);
    assert!(text.contains("big-end-3 at 1250 rpm"));
    assert!(text.contains("0.2500 µm exceeded"));
    assert!(text.contains("title=\"limit exceeded\""));
    let data = data(&page);
    let cell = &data["machine"]["thickness"]["rows"][9][1];
    assert_eq!(
        (cell["value"].as_f64(), cell["bad"].as_bool()),
        (Some(0.25), Some(true))
    );
}

/// The friction power of the table's last row is the sum of those of the bearings.
#[test]
fn totals_are_sums() {
    let mut results = inline_six("engine", 1, false);
    let machine = machine(&mut results);
    let loss = |number: usize| {
        let cycle = &machine.speeds[0].bearings[number].cycle;
        cycle.mean(|point| point.summary.power_loss())
    };
    let total: f64 = (0..13).map(loss).sum();
    let page = render(&results).unwrap();
    let at = page
        .find("data-key=\"total_power_loss_w\" data-value=\"")
        .unwrap();
    let value = page[at..].split('"').nth(3).unwrap();
    let shown: f64 = value.parse().unwrap();
    assert!((shown / total - 1.0).abs() < 1e-12, "{shown} {total}");
}

#[test]
fn a_shaft_has_no_gas_and_no_torque() {
    let page = render(&shaft("shaft")).unwrap();
    let text = text(&page);
    assert!(text.contains("href=\"#shaft\"") && text.contains("Loads of the bearings"));
    for kind in [
        "gas-pressure",
        "torque-orders",
        "friction-pressure",
        "load-models",
    ] {
        assert!(!text.contains(&format!("data-kind=\"{kind}\"")), "{kind}");
    }
}

#[test]
fn a_bearing_that_did_not_converge_is_named() {
    let mut results = inline_six("engine", 2, false);
    results.header.status = Outcome::NotConverged;
    let speed = &mut machine(&mut results).speeds[1];
    speed.outcome = Outcome::NotConverged;
    speed.bearings[4].cycle.orbit.outcome = Outcome::NotConverged;
    let page = render(&results).unwrap();
    let text = text(&page);
    assert!(text.contains("Not every bearing converged"));
    assert!(text.contains("Not converged: main-5 at 1250 rpm."));
    assert!(text.contains("title=\"not converged\""));
}

#[test]
fn names_are_text_and_anchors_are_not_twice() {
    let mut results = inline_six(HOSTILE, 1, false);
    for bearing in &mut machine(&mut results).speeds[0].bearings {
        bearing.name = HOSTILE.into();
    }
    let page = render(&results).unwrap();
    assert!(!page.contains("<script>alert"));
    let ids: Vec<&str> = text(&page)
        .split(" id=\"")
        .skip(1)
        .map(|rest| &rest[..rest.find('"').unwrap()])
        .collect();
    let unique: std::collections::BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(unique.len(), ids.len());
}

#[test]
fn an_engine_without_an_orbit_is_reported_not_refused() {
    let mut results = inline_six("engine", 2, true);
    machine(&mut results).speeds[0].bearings[0]
        .cycle
        .orbit
        .points
        .clear();
    machine(&mut results).speeds[1].bearings.clear();
    assert!(render(&results).unwrap().contains("big-end-6"));
    machine(&mut results).speeds.clear();
    assert!(render(&results).unwrap().contains("</html>"));
}
