//! `film.compare`: the study beside itself with other film models is the study with those models.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use serde_json::Value;
use sommerfeld_study::input::study_from_text;
use sommerfeld_study::output::summary;
use sommerfeld_study::report::render;
use sommerfeld_study::results::{ModelEnd, Results};
use sommerfeld_study::run::solve;
use std::ops::ControlFlow;
use std::path::Path;

const BEARING: &str =
    "[bearing]\ndiameter = \"72 mm\"\nwidth = \"18 mm\"\ndiametral_clearance = \"72 um\"\n";
const HOLE: &str = "[[bearing.groove]]\nkind = \"hole\"\ncarried_by = \"shell\"\nangle = \"180 deg\"\n\
    diameter = \"6 mm\"\npressure = \"3 bar\"\n";
const OIL: &str = "[oil]\nviscosity = \"8 mPa.s\"\n";
const STEADY: &str = "[operation]\nspeed = \"2000 rpm\"\nload = [\"4 kN\", \"0 N\"]\n";
const FILM: &str = "[operation]\nspeed = \"2000 rpm\"\nrelative_eccentricity = 0.7\n";
const CYCLE: &str = "[load_cycle]\nfile = \"../../examples/02-big-end-diesel/loads.csv\"\n\
    engine_speed = \"2000 rpm\"\ncrank_step = \"6 deg\"\n";

fn text(analysis: &str, bearing: &str, film: &str, duty: &str) -> String {
    format!("schema = 1\nanalysis = \"{analysis}\"\n{BEARING}{bearing}{OIL}[film]\n{film}{duty}")
}

fn results(text: &str) -> Results {
    let study = study_from_text("study.toml", text, Path::new(""))
        .unwrap_or_else(|errors| panic!("{errors}"));
    let mut last = 0.0;
    solve(&study, &mut |event| {
        assert!((0.0..=1.0).contains(&event.done) && event.done >= last - 0.5);
        last = event.done;
        ControlFlow::Continue(())
    })
    .unwrap()
}

/// Every number that a run of the comparison repeats is that of the study with that model, and its
/// difference follows from it.
fn is_of(compared: &Value, own: &Value, by_hand: &Value, least: usize) {
    let mut seen = 0;
    for (key, value) in compared.as_object().unwrap() {
        let (Some(value), Some(expected)) = (value.as_f64(), by_hand[key].as_f64()) else {
            continue;
        };
        if key == "wall_time_s" {
            continue;
        }
        seen += 1;
        assert_eq!(value, expected, "{key}");
        let percent = 100.0 * (value / own[key].as_f64().unwrap() - 1.0);
        let told = compared["difference_percent"][key].as_f64().unwrap();
        assert!((told - percent).abs() < 1e-9, "{key}: {told} {percent}");
    }
    assert!(seen >= least, "{compared}");
}

#[test]
fn a_compared_model_is_the_study_with_that_model() {
    for (analysis, duty) in [
        ("film", FILM),
        ("equilibrium", STEADY),
        ("coefficients", STEADY),
        ("load-cycle", CYCLE),
    ] {
        let others = ["short-bearing", "mobility", "field"];
        let grid = "grid = [48, 8]\ncavitation = \"gumbel\"\n";
        let list = "compare = [\"short-bearing\", \"mobility\", \"field\"]\n";
        let online = "model = \"online\"\n";
        let all = results(&text(analysis, "", &format!("{online}{grid}{list}"), duty));
        let found = summary(&all);
        assert_eq!(found["status"], "converged", "{}", found["messages"]);
        assert_eq!(found["comparison"]["own_model"], "online");
        for model in others {
            let film = format!("model = \"{model}\"\n{grid}");
            let by_hand = summary(&results(&text(analysis, "", &film, duty)));
            let compared = &found["comparison"][model];
            assert_eq!(compared["status"], "converged", "{analysis} {model}");
            is_of(compared, &found, &by_hand, 4);
            // Whatever the model, the closure stands among what was used.
            let used = by_hand["models"].as_array().unwrap();
            let closures = used.iter().filter(|used| used["family"] == "cavitation");
            let names: Vec<&str> = closures
                .map(|used| used["name"].as_str().unwrap())
                .collect();
            assert_eq!(names, ["gumbel"], "{analysis} {model}");
        }
        let page = render(&all).unwrap();
        assert!(page.contains("Film models side by side"), "{analysis}");
        let is_cycle = analysis == "load-cycle";
        assert_eq!(page.contains("models-orbit"), is_cycle, "{analysis}");
    }
}

/// What a model cannot do ends nothing: it is named with the reason.
#[test]
fn a_model_that_refuses_is_named() {
    let film = "grid = [48, 8]\ncompare = [\"online\", \"short-bearing\"]\n";
    let all = results(&text("equilibrium", HOLE, film, STEADY));
    let found = summary(&all);
    assert_eq!(found["status"], "converged");
    let online = &found["comparison"]["online"];
    assert_eq!(online["status"], "refused");
    assert!(online["reason"].as_str().unwrap().contains("grooves"));
    let short = &found["comparison"]["short-bearing"];
    assert_eq!(short["status"], "converged");
    let notes: Vec<&str> = (short["notes"].as_array().unwrap().iter())
        .map(|note| note.as_str().unwrap())
        .collect();
    assert!(notes.contains(&"without grooves and holes"), "{notes:?}");
    let messages = found["messages"].to_string();
    assert!(messages.contains("online was not run"), "{messages}");
    // Without its hole every model has the same bearing.
    let film = format!("{film}feeds = \"left-out\"\ncavitation = \"reynolds\"\n");
    let found = summary(&results(&text("equilibrium", HOLE, &film, STEADY)));
    assert_eq!(found["comparison"]["online"]["status"], "converged");
    // A tilt that only the film on a grid can have.
    let tilted = format!("{STEADY}tilt = [\"0 rad\", \"0.1 mrad\"]\n");
    let film = "grid = [48, 8]\ncavitation = \"reynolds\"\ncompare = [\"online\", \"mobility\"]\n";
    let found = summary(&results(&text("equilibrium", "", film, &tilted)));
    for model in ["online", "mobility"] {
        let reason = found["comparison"][model]["reason"].as_str().unwrap();
        assert!(reason.contains("tilt"), "{reason}");
    }
}

/// A run that is stopped during the comparison keeps its own results and says what is missing.
#[test]
fn a_stop_leaves_the_rest_of_the_comparison_out() {
    let film = "model = \"online\"\ncompare = [\"mobility\", \"short-bearing\"]\n";
    let text = text("load-cycle", "", film, CYCLE);
    let study = study_from_text("study.toml", &text, Path::new("")).unwrap();
    let all = solve(
        &study,
        &mut |event| match event.label.starts_with("mobility, cycle 2") {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        },
    );
    let all = all.unwrap();
    assert_eq!(summary(&all)["status"], "converged");
    let comparison = all.header.comparison.unwrap();
    assert!(comparison.is_unfinished());
    for run in &comparison.runs {
        assert_eq!(run.end, ModelEnd::NotRun, "{}", run.model);
        assert!(run.body.is_none());
    }
}

/// Nothing is compared with itself.
#[test]
fn the_own_model_is_left_out_of_the_comparison() {
    let film = "model = \"online\"\ncompare = [\"online\", \"plain\"]\n";
    let text = text("equilibrium", "", film, STEADY);
    let study = study_from_text("study.toml", &text, Path::new("")).unwrap();
    assert!(study.film.compare.is_empty());
    assert_eq!(study.warnings.len(), 2);
}

/// A journal that tilts is solved on line where the closure is `gumbel`, at rest and over a cycle.
#[test]
fn a_journal_that_tilts_is_solved_on_line() {
    let held = format!(
        "{FILM}tilt = [\"0.2 mrad\", \"-0.5 mrad\"]\ntilt_rate = [\"0 rad/s\", \"3 rad/s\"]\n"
    );
    let free = format!("{STEADY}moment = [\"1 N.m\", \"2 N.m\"]\n");
    for (analysis, duty) in [("film", held), ("equilibrium", free)] {
        let of = |model: &str| {
            let film = format!("cavitation = \"gumbel\"\n{model}");
            summary(&results(&text(analysis, "", &film, &duty)))
        };
        let online = of("model = \"online\"\n");
        let field = of("grid = [192, 48]\n");
        assert_eq!(online["status"], "converged", "{}", online["messages"]);
        for key in ["minimum_film_thickness_m", "power_loss_w", "side_flow_m3_s"] {
            let [found, expected] = [&online, &field].map(|from| from[key].as_f64().unwrap());
            let off = (found / expected - 1.0).abs();
            assert!(off < 5e-3, "{analysis} {key}: {found} {expected}");
        }
        let moment = |from: &Value| from["moment_n_m"][1].as_f64().unwrap();
        let off = (moment(&online) / moment(&field) - 1.0).abs();
        assert!(
            moment(&field).abs() > 1.0 && off < 5e-3,
            "{analysis}: {off}"
        );
    }
    let film = "model = \"online\"\ncavitation = \"reynolds\"\n";
    let duty = format!("{STEADY}moment = [\"3 N.m\", \"0 N.m\"]\n");
    let text = text("equilibrium", "", film, &duty);
    let errors = study_from_text("study.toml", &text, Path::new("")).unwrap_err();
    let told = errors.to_string();
    assert!(
        told.contains("no tilt") && told.contains("gumbel"),
        "{told}"
    );
}
