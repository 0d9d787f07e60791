//! Wear of a load cycle as a study asks for it.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_study::input::{Study, study_from_text};
use sommerfeld_study::output::summary;
use sommerfeld_study::results::{Body, CycleResults, Results};
use sommerfeld_study::solve;
use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::path::Path;

const COEFFICIENT: f64 = 1e-16;

/// A big end whose journal touches the shell under the firing load.
const BIG_END: &str = r#"
schema = 1
analysis = "load-cycle"

[bearing]
diameter = "72 mm"
width = "30 mm"
diametral_clearance = "72 um"

[bearing.surface]
roughness_journal = "0.8 um"
roughness_shell = "1.2 um"
boundary_friction = 0.08
contact = { law = "greenwood-tripp", factor = 1e-3, asperity_product = 0.05, modulus = "53.3 GPa" }

[oil]
viscosity = "2 mPa.s"

[load_cycle]
file = "loads.csv"
engine_speed = "1500 rpm"
crank_step = "6 deg"

[film]
cavitation = "reynolds"
grid = [48, 8]

[wear]
coefficient = "1e-16 m2/N"
"#;

fn study(text: &str) -> Study {
    let directory = tempfile::tempdir().unwrap();
    let template = sommerfeld_study::templates::find("big-end").unwrap();
    for (name, content) in template.files {
        std::fs::write(directory.path().join(name), content).unwrap();
    }
    study_from_text("study.toml", text, directory.path())
        .unwrap_or_else(|errors| panic!("{errors}"))
}

fn solved(text: &str) -> Results {
    solve(&study(text), &mut |_| ControlFlow::Continue(())).unwrap()
}

fn cycle(results: &Results) -> &CycleResults {
    match &results.body {
        Body::LoadCycle(cycle) => cycle,
        _ => panic!("no load cycle"),
    }
}

/// The volume of the map is that of the contact load over the orbit; both surfaces take the same.
#[test]
fn wear_over_a_cycle_is_that_of_its_contact_load() {
    let results = solved(BIG_END);
    let cycle = cycle(&results);
    let fields = cycle.fields.as_ref().unwrap();
    let shell = fields.on_shell.wear.as_ref().unwrap();
    let journal = fields.on_journal.wear.as_ref().unwrap();
    let period = 4.0 * PI / (1500.0 * PI / 30.0);
    assert!((shell.map.duration / period - 1.0).abs() < 1e-12);
    // The map takes each point after the first; the first is a period before the last.
    let points = &cycle.orbit.points[1..];
    let sliding = |p: &sommerfeld_bearing::CyclePoint| {
        0.036 * (p.state.journal_speed - p.state.shell_speed).abs() * p.summary.contact_load
    };
    let power: f64 = points.iter().map(sliding).sum::<f64>() / points.len() as f64;
    assert!(power > 0.0);
    for map in [&shell.map, &journal.map] {
        let found = map.total() / period;
        assert!((found / power - 1.0).abs() < 1e-10, "{found} {power}");
    }
    let boundary: f64 = points.iter().map(|p| p.summary.boundary_power).sum();
    let boundary = boundary / points.len() as f64;
    assert!((boundary / (0.08 * power) - 1.0).abs() < 1e-10);

    let keys = summary(&results);
    let number = |key: &str| {
        keys[key]
            .as_f64()
            .unwrap_or_else(|| panic!("{key}: {}", keys[key]))
    };
    let volume = number("wear_volume_per_hour_m3");
    assert!((volume / (3600.0 * COEFFICIENT * power) - 1.0).abs() < 1e-10);
    // Deeper than the mean, no deeper than all of it in one cell.
    let depth = number("wear_depth_per_hour_m");
    let area = PI * 0.072 * 0.030;
    assert!(depth > volume / area && depth < 48.0 * 8.0 * volume / area);
    assert!(number("wear_depth_position_m").abs() < 0.015);
    assert!(journal.coefficient.is_none() && journal.depth_per_hour().is_none());
}

/// Running-in that uses its steps up says so, and the results are those of the worn bearing.
#[test]
fn a_shell_that_ran_in_wears_slower() {
    let text = BIG_END.replace("[48, 8]", "[32, 4]")
        + "running_in = { hours = \"8000 h\", steps = 1, settled_below = 0.0 }\n";
    let results = solved(&text);
    assert!(results.header.messages[0].contains("its steps were used up"));
    let cycle = cycle(&results);
    let ran = cycle.running_in.as_ref().unwrap();
    let (first, last) = (ran.steps[0], *ran.steps.last().unwrap());
    assert_eq!(ran.steps.len(), 2, "{:?}", ran.steps);
    assert_eq!(ran.time, first.duration);
    assert!(last.deepest_rate < first.deepest_rate, "{first:?} {last:?}");
    let wear = cycle.fields.as_ref().unwrap().on_shell.wear.as_ref();
    let rate = wear.unwrap().deepest_per_hour().unwrap().value / 3600.0;
    assert!(
        (rate / last.deepest_rate - 1.0).abs() < 1e-9,
        "{rate} {last:?}"
    );
    assert_eq!(summary(&results)["running_in_end"], "step-limit");
}

#[test]
fn without_wear_in_the_study_there_is_none() {
    let text = BIG_END.split("[wear]").next().unwrap();
    assert!(study(text).bearing_case().unwrap().wear.is_none());
    let errors = study_from_text(
        "study.toml",
        &BIG_END.replace("contact = {", "# contact = {"),
        Path::new(""),
    )
    .unwrap_err()
    .to_string();
    assert!(errors.contains("nothing wears without contact"), "{errors}");
}

/// Running-in goes on to the end of the hours, each orbit from the end of the one before; the roughness of
/// the shell falls with it, or stays if it is to. What it found stands in its files.
#[test]
fn running_in_lasts_for_the_hours_given() {
    let hours = |roughness: &str| {
        BIG_END.replace("[48, 8]", "[32, 4]")
            + "[wear.running_in]\nhours = \"2 h\"\nsettled_below = 0.0\nstep_depth = 0.4\n"
            + roughness
    };
    let results = solved(&hours(""));
    let found = cycle(&results);
    let ran = found.running_in.as_ref().unwrap();
    assert_eq!(ran.end.name(), "time-over");
    assert_eq!((ran.time, ran.steps.last().unwrap().time), (7200.0, 7200.0));
    assert!(ran.steps.len() > 2, "{:?}", ran.steps);
    assert!(results.header.status == sommerfeld_study::Outcome::Converged);
    for pair in ran.steps.windows(2) {
        assert!(pair[1].shell_roughness < pair[0].shell_roughness);
        assert!(pair[1].deepest_rate < pair[0].deepest_rate, "{pair:?}");
        assert!(pair[1].depth > pair[0].depth && pair[1].volume > pair[0].volume);
    }
    let directory = tempfile::tempdir().unwrap();
    sommerfeld_study::output::write_all(&results, directory.path()).unwrap();
    let table = std::fs::read_to_string(directory.path().join("running-in.csv")).unwrap();
    assert_eq!(table.lines().count(), ran.steps.len() + 1);
    assert!(table.starts_with("time[s],duration[s],wear_rate[m/s],"));
    let keys = summary(&results);
    let last = ran.steps.last().unwrap();
    assert_eq!(keys["running_in_shell_roughness_m"], last.shell_roughness);
    assert_eq!(keys["running_in_volume_m3"], last.volume);
    let page = std::fs::read_to_string(directory.path().join("report.html")).unwrap();
    for words in [
        "Roughness over running-in",
        "Worn profile around",
        "the time given is over",
    ] {
        assert!(page.contains(words), "{words}");
    }

    let results = solved(&hours("roughness = \"kept\"\n"));
    let kept = cycle(&results).running_in.as_ref().unwrap();
    let mut steps = kept.steps.iter();
    assert!(steps.all(|step| step.shell_roughness == 1.2e-6));
    // The same first orbit, another course after it.
    assert_eq!(kept.steps[0].deepest_rate, ran.steps[0].deepest_rate);
    assert!(kept.steps[1].deepest_rate > ran.steps[1].deepest_rate);
}

/// A shell whose first orbit does not close says so, and its results can be written.
#[test]
fn running_in_that_cannot_begin_is_a_status() {
    let text = BIG_END
        .replace("[48, 8]", "[32, 4]")
        .replace("crank_step", "maximum_cycles = 1\ncrank_step")
        + "running_in = { hours = \"1 h\" }\n";
    let results = solved(&text);
    assert_eq!(summary(&results)["status"], "not-converged");
    assert_eq!(summary(&results)["running_in_end"], "not-solved");
    let mut messages = results.header.messages.iter();
    assert!(messages.any(|told| told.contains("ran in for 0.000 h only")));
    let directory = tempfile::tempdir().unwrap();
    sommerfeld_study::output::write_all(&results, directory.path()).unwrap();
}

/// What the film loses is boundary, shear of the oil and squeeze; the viscous power of the contract holds
/// the last two.
#[test]
fn the_split_of_friction_tells_squeeze_from_shear() {
    let keys = summary(&solved(&BIG_END.replace("[48, 8]", "[32, 4]")));
    let number = |key: &str| keys[key].as_f64().unwrap();
    let viscous = number("viscous_power_w");
    let parts = number("viscous_shear_power_w") + number("squeeze_power_w");
    assert!((parts / viscous - 1.0).abs() < 1e-12, "{parts} {viscous}");
    let all = viscous + number("boundary_power_w");
    assert!((all / number("mean_power_loss_w") - 1.0).abs() < 1e-12);
    let friction = number("viscous_shear_power_w") + number("boundary_power_w");
    assert!((friction / number("mean_friction_power_w") - 1.0).abs() < 1e-12);
    assert_eq!(number("squeeze_power_w"), number("mean_squeeze_power_w"));
    assert!(number("squeeze_power_w").abs() > 0.0);
}
