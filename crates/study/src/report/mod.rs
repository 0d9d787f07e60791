//! `report.html`: the results of a run for a reader, in one file that needs no network.
//!
//! Rust decides what is shown and formats every number; the template lays it out; the script draws
//! the figures from data that are already in reading units. Nothing is loaded from anywhere: style,
//! script and the drawing library are in the file, and a content policy in its head forbids the rest.

mod cycle;
mod cycle_tables;
mod dimensionless;
mod figures;
mod format;
mod page;
mod steady;
mod sweep;

use crate::results::{Body, Results};
use minijinja::{Environment, Value, context};
use page::Page;

const FILE_NAME: &str = "report.html";
const TEMPLATE: &str = include_str!("assets/report.html");
const STYLE: &str = include_str!("assets/report.css");
const SCRIPT: &str = include_str!("assets/report.js");
const DRAWING_LIBRARY: &str = include_str!("assets/plotly.min.js");

/// The report as HTML text.
///
/// # Errors
/// What the template engine says if the template does not take the page.
pub fn render(results: &Results) -> Result<String, minijinja::Error> {
    let header = &results.header;
    let mut page = Page::of(header);
    let data = match &results.body {
        Body::Steady(steady) => steady::fill(&mut page, header, steady),
        Body::LoadCycle(cycle) => cycle::fill(&mut page, header, cycle),
        Body::Dimensionless(integrals) => dimensionless::fill(&mut page, header, integrals),
        Body::Sweep(sweep) => sweep::fill(&mut page, sweep),
    };
    let data = script_safe(&data.to_string());
    let mut environment = Environment::new();
    environment.set_trim_blocks(true);
    environment.set_lstrip_blocks(true);
    let library = if page.figures.is_empty() {
        ""
    } else {
        DRAWING_LIBRARY
    };
    environment.render_named_str(
        FILE_NAME,
        TEMPLATE,
        context! {
            page => Value::from_serialize(&page),
            style => Value::from_safe_string(STYLE.to_owned()),
            script => Value::from_safe_string(SCRIPT.to_owned()),
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
