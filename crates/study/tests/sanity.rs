//! A result beyond what the physics can mean says so, and an ordinary one says nothing.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_study::input::study_from_text;
use sommerfeld_study::output::summary;
use sommerfeld_study::{Outcome, solve};
use std::ops::ControlFlow;
use std::path::Path;

/// Messages of a converged equilibrium.
fn messages(load: &str, speed: &str, grid: &str) -> Vec<String> {
    let text = format!(
        "schema = 1\nanalysis = \"equilibrium\"\n[bearing]\ndiameter = \"72 mm\"\n\
         width = \"30 mm\"\ndiametral_clearance = \"72 um\"\n[oil]\nviscosity = \"8 mPa.s\"\n\
         [film]\ncavitation = \"reynolds\"\ngrid = {grid}\n\
         [operation]\nspeed = \"{speed}\"\nload = [\"{load}\", \"0 N\"]\n"
    );
    let study = study_from_text("study.toml", &text, Path::new("")).unwrap();
    let results = solve(&study, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(results.header.status, Outcome::Converged);
    let told = summary(&results)["messages"].to_string();
    for message in &results.header.messages {
        assert!(told.contains(message.as_str()), "{told}");
    }
    results.header.messages
}

#[test]
fn an_ordinary_film_has_no_warning() {
    assert_eq!(
        messages("10 kN", "2000 rpm", "[64, 8]"),
        Vec::<String>::new()
    );
}

#[test]
fn a_load_that_no_bearing_carries_is_named() {
    let found = messages("10 MN", "2000 rpm", "[128, 32]");
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].starts_with("the minimum film thickness, 0.0"));
    assert!(found[0].contains("below 0.1 um"), "{found:?}");
    assert!(found[1].starts_with("the peak film pressure, "));
    assert!(found[1].contains("above 1 GPa"), "{found:?}");
}

/// 41.1 sqrt(0.036/36e-6) = 1300 is reached at Re = 850 * omega * 0.036 * 36e-6 / 0.008, that is at
/// omega = 9439 rad/s, 90 136 rpm.
#[test]
fn a_flow_that_is_not_laminar_is_named() {
    assert_eq!(
        messages("10 kN", "90000 rpm", "[64, 8]"),
        Vec::<String>::new()
    );
    let found = messages("10 kN", "91000 rpm", "[64, 8]");
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("Taylor vortices"), "{found:?}");
    // It is the journal that drives them, in either sense.
    assert_eq!(messages("10 kN", "-91000 rpm", "[64, 8]").len(), 1);
}
