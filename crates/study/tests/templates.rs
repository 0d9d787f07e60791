//! Every template runs as it is written, on a coarser grid, and answers its question.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_study::templates::{self, TEMPLATES};
use sommerfeld_study::{Outcome, load_study, solve};
use std::fs;
use std::ops::ControlFlow;

/// A grid that is fast and coarse; the templates write or default to this one.
const GRID: &str = "grid = [128, 32]";
const COARSE: &str = "grid = [48, 12]";

/// Machines have many orbits: at their higher speed, on a grid of their own, in longer crank steps.
const MACHINE_GRID: &str = "grid = [64, 16]";
const MACHINE_COARSE: &str = "grid = [32, 8]";
const ORBIT: &str = "\n[orbit]\n";
const LONG_STEPS: &str = "\n[orbit]\ncrank_step = \"4 deg\"\n";

fn coarse_machine(text: &str) -> String {
    for (speeds, one) in [
        (
            "speed = [\"2000 rpm\", \"4000 rpm\"]",
            "speed = \"4000 rpm\"",
        ),
        (
            "speed = [\"4000 rpm\", \"8000 rpm\"]",
            "speed = \"8000 rpm\"",
        ),
    ] {
        if text.contains(speeds) {
            assert!(text.contains(MACHINE_GRID), "{text}");
            let text = text
                .replace(speeds, one)
                .replace(MACHINE_GRID, MACHINE_COARSE);
            return match text.contains(ORBIT) {
                true => text.replace(ORBIT, LONG_STEPS),
                false => text + LONG_STEPS,
            };
        }
    }
    panic!("a machine at other speeds: {text}")
}

/// A study on the coarse grid. A sweep takes that of its base; a table of loads has none.
fn coarse(text: &str) -> String {
    let is_machine = ["engine", "shaft"]
        .iter()
        .any(|analysis| text.contains(&format!("analysis = \"{analysis}\"")));
    match text {
        _ if is_machine => coarse_machine(text),
        _ if !text.contains("schema = 1") || text.contains("[sweep]") => text.to_owned(),
        _ if text.contains(GRID) => text.replace(GRID, COARSE),
        _ if text.contains("[film]") => text.replace("[film]", &format!("[film]\n{COARSE}")),
        _ => format!("{text}\n[film]\n{COARSE}\n"),
    }
}

#[test]
fn every_template_converges_without_a_message() {
    for template in TEMPLATES {
        let directory = tempfile::tempdir().unwrap();
        for (name, content) in template.files {
            fs::write(directory.path().join(name), coarse(content)).unwrap();
        }
        let file = directory.path().join("study.toml");
        fs::write(&file, coarse(template.study)).unwrap();
        let study = load_study(&file).unwrap_or_else(|errors| panic!("{errors}"));
        let results = solve(&study, &mut |_| ControlFlow::Continue(())).unwrap();
        let name = template.name;
        assert_eq!(results.header.status, Outcome::Converged, "{name}");
        // The closed form says that it does not use the grid of this test.
        let told = &results.header.messages;
        assert!(
            told.iter().all(|message| message.contains("film.grid")),
            "{name}: {told:?}"
        );
        assert!(!results.key_figures().is_empty(), "{name}");
    }
}

#[test]
fn a_template_explains_itself() {
    for template in TEMPLATES {
        let comments = template.study.matches('#').count();
        assert!(comments >= 3, "{} has {comments} comments", template.name);
        assert!(template.study.starts_with("# "), "{}", template.name);
        assert!(!template.meaning.is_empty());
    }
}

#[test]
fn slips_of_the_pen_find_their_template() {
    assert_eq!(templates::nearest("bigend"), Some("big-end"));
    assert_eq!(templates::nearest("coeficients"), Some("coefficients"));
    assert_eq!(templates::nearest("gearbox"), None);
}
