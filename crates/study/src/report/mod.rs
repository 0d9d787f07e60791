//! `report.html`: the results of a run for a reader, in one file that needs no network.
//!
//! Rust decides what is shown and formats every number; the template lays it out; the script draws
//! the figures from data that are already in reading units. Nothing is loaded from anywhere: style,
//! script and the drawing library are in the file, and a content policy in its head forbids the rest.

mod chart;
mod compare;
mod compare_models;
mod contact;
mod cycle;
mod cycle_tables;
mod database;
mod detail;
mod dimensionless;
mod dynamics;
mod figures;
mod film;
mod format;
mod heat;
mod machine;
mod packing;
mod page;
mod spark;
mod steady;
mod surfaces;
mod sweep;
mod wear;

use crate::regime::Regime;
use crate::results::{Body, Results};
use minijinja::{Environment, Value, context};
use page::Page;

const FILE_NAME: &str = "report.html";
const TEMPLATE: &str = include_str!("assets/report.html");
const PARTS: &str = include_str!("assets/parts.html");
const MACHINE: &str = include_str!("assets/machine.html");
const STYLE: &str = include_str!("assets/report.css");
/// The parts of the script in the order in which they need each other.
const SCRIPT: &[&str] = &[
    include_str!("assets/base.js"),
    include_str!("assets/curves.js"),
    include_str!("assets/planes.js"),
    include_str!("assets/maps.js"),
    include_str!("assets/film.js"),
    include_str!("assets/sweep.js"),
    include_str!("assets/machine.js"),
    include_str!("assets/start.js"),
];
const DRAWING_LIBRARY: &str = include_str!("assets/plotly.min.js");

/// The report as HTML text.
///
/// # Errors
/// What the template engine says if the template does not take the page.
pub fn render(results: &Results) -> Result<String, minijinja::Error> {
    let header = &results.header;
    let mut page = Page::of(header);
    page.warning = results
        .flow_regime()
        .filter(|flow| flow.regime != Regime::Laminar)
        .map_or_else(String::new, |_| "Beyond laminar flow".to_owned());
    let data = match &results.body {
        Body::Steady(steady) => steady::fill(&mut page, header, steady),
        Body::LoadCycle(cycle) => cycle::fill(&mut page, header, cycle),
        Body::Dimensionless(integrals) => dimensionless::fill(&mut page, header, integrals),
        Body::Machine(machine) => machine::fill(&mut page, header, machine),
        Body::Database(database) => database::fill(&mut page, header, database),
        Body::Sweep(sweep) => sweep::fill(&mut page, sweep),
    };
    let data = script_safe(&data.to_string());
    let mut environment = Environment::new();
    environment.set_trim_blocks(true);
    environment.set_lstrip_blocks(true);
    environment.add_template("parts.html", PARTS)?;
    environment.add_template("machine.html", MACHINE)?;
    let library = if page.is_drawn() { DRAWING_LIBRARY } else { "" };
    environment.render_named_str(
        FILE_NAME,
        TEMPLATE,
        context! {
            page => Value::from_serialize(&page),
            style => Value::from_safe_string(STYLE.to_owned()),
            script => Value::from_safe_string(SCRIPT.concat()),
            library => Value::from_safe_string(library.to_owned()),
            data => Value::from_safe_string(data),
        },
    )
}

/// JSON text that cannot end or change the script element it stands in: the characters that could
/// are written as escapes, which JSON reads as the same characters.
fn script_safe(json: &str) -> String {
    json.replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('&', "\\u0026")
        .replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    #[test]
    fn data_cannot_leave_their_script_element() {
        let hostile = serde_json::json!({"feed": "</script><!--<script>&"});
        let text = script_safe(&hostile.to_string());
        assert!(!text.contains(['<', '>', '&']));
        let back: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(back, hostile);
    }
}
