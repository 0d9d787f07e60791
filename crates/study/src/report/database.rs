//! The report of a database: how far it errs, where, and what it holds.

use super::chart::{Chart, Mark, Series};
use super::detail::Detail;
use super::format::significant;
use super::page::{Answer, Card, Cell, Figure, Page, Section, Table, badge, exact};
use crate::results::Header;
use crate::results::database::{BuiltDatabase, DatabaseResults, ForceCurve};
use serde_json::{Value, json};

/// Bars of the histogram of errors.
const BARS: usize = 40;

/// Fills cards, figures and tables; returns the data of the figures.
pub(super) fn fill(page: &mut Page, header: &Header, database: &DatabaseResults) -> Value {
    let name = database.file.file_name().unwrap_or_default();
    page.subject = format!("File {}", name.to_string_lossy());
    let Some(built) = &database.built else {
        return json!({});
    };
    page.answer = answer(built);
    page.cards = cards(header, database, built);
    page.sections = vec![content_section()];
    page.tables = vec![errors_table(built), content_table(built)];
    let mut charts = json!({
        "database-force": curves(built, "Force / (η |w| R³ B / 2c³)", |curve| &curve.force),
        "database-peak": curves(built, "Peak pressure / (η |w| R² / c³)", |curve| &curve.peak),
    });
    if !built.fresh.is_empty() {
        page.sections.insert(0, errors_section());
        charts["database-histogram"] = histogram(built);
        charts["database-errors"] = errors_over_eccentricity(built);
    }
    json!({ "charts": charts })
}

/// Whether the database errs by no more than asked.
fn answer(built: &BuiltDatabase) -> Answer {
    let found = built.facts.stated_error.max(built.fresh_maximum());
    let is_met = found <= built.target;
    Answer {
        class: if is_met { "good" } else { "bad" },
        headline: if is_met {
            "Target met"
        } else {
            "Target missed, not converged"
        },
        explanation: format!(
            "The force errs by at most {} of its size at {} states, target {}.",
            small(found),
            built.facts.samples + built.fresh.len(),
            small(built.target)
        ),
        checks: Vec::new(),
    }
}

fn small(value: f64) -> String {
    format!("{value:.2e}").replace('-', "−")
}

fn cards(header: &Header, database: &DatabaseResults, built: &BuiltDatabase) -> Vec<Card> {
    let card = |label, key, value: f64, shown: String, unit, detail: String| Card {
        label,
        key,
        exact: exact(value),
        value: shown,
        unit,
        badge: badge(header.status),
        detail,
        ..Card::default()
    };
    let fresh = built.fresh_maximum();
    let axes = built.axes.iter();
    let axes: Vec<String> = axes
        .map(|(name, count)| format!("{count} {name}"))
        .collect();
    let mut cards = vec![
        card(
            "Largest error of the force",
            "maximum_relative_error",
            built.facts.stated_error,
            small(built.facts.stated_error),
            "",
            format!(
                "of {} states drawn at random, target {}",
                built.facts.samples,
                small(built.target)
            ),
        ),
        card(
            "Points",
            "points",
            built.facts.points as f64,
            built.facts.points.to_string(),
            "",
            axes.join(" × "),
        ),
        card(
            "Build time",
            "build_time_s",
            database.build_time,
            significant(database.build_time),
            "s",
            "solving, refining and checking".to_owned(),
        ),
    ];
    if !built.fresh.is_empty() {
        cards.insert(
            1,
            card(
                "Largest error, fresh states",
                "fresh_maximum_relative_error",
                fresh,
                small(fresh),
                "",
                format!("of {} states drawn after the build", built.fresh.len()),
            ),
        );
    }
    cards
}

fn figure(kind: &'static str, title: &'static str, caption: &str) -> Figure {
    Figure {
        kind,
        title,
        caption: caption.to_owned(),
        size: "",
    }
}

fn errors_section() -> Section {
    Section {
        id: "errors",
        title: "How far it errs",
        lead: "States drawn at random after the build, each against a film solved for it. The error is \
               that of the force vector over its own size."
            .to_owned(),
        figures: vec![
            figure(
                "database-histogram",
                "Errors of fresh states",
                "How many states have an error of this size, decades of the error to the right.",
            ),
            figure(
                "database-errors",
                "Where they are",
                "Error of each state over its relative eccentricity.",
            ),
        ],
    }
}

fn content_section() -> Section {
    Section {
        id: "content",
        title: "What it holds",
        lead: "Film of a journal that moves with the effective velocity w, relative to the oil that both \
               surfaces drag along. Angles are those of w from the line of centres: at 0° the gap \
               closes, at 90° the journal slides as in steady rotation, at 180° the gap opens."
            .to_owned(),
        figures: vec![
            figure(
                "database-force",
                "Force",
                "Size of the force on the journal over the relative eccentricity, by direction of the \
                 motion.",
            ),
            figure(
                "database-peak",
                "Peak pressure",
                "Highest film pressure over the relative eccentricity, by direction of the motion.",
            ),
        ],
    }
}

fn errors_table(built: &BuiltDatabase) -> Table {
    let mut rows = vec![
        ("Target", small(built.target)),
        ("Status", built.facts.status_name().to_owned()),
        (
            "Largest, of the samples of the build (stated in the file)",
            small(built.facts.stated_error),
        ),
        ("99.9 % of them stay below", small(built.quantile_999)),
        ("Half of them stay below", small(built.median)),
        ("Samples of the build", built.facts.samples.to_string()),
    ];
    if !built.fresh.is_empty() {
        rows.push(("Largest, of fresh states", small(built.fresh_maximum())));
        rows.push(("Fresh states", built.fresh.len().to_string()));
    }
    if let Some(peak) = built.peak_maximum {
        rows.push((
            "Largest error of the peak pressure over itself",
            small(peak),
        ));
    }
    Table {
        title: "Errors",
        note: "Error of the force vector over its own size, except where said.".to_owned(),
        rows: rows_of(&rows),
        ..Table::default()
    }
}

fn content_table(built: &BuiltDatabase) -> Table {
    let [narrow, wide] = built.facts.width_ratios;
    let ratios = if narrow == wide {
        format!("{narrow:.6}")
    } else {
        format!("{narrow:.6} to {wide:.6}")
    };
    let mut rows = vec![
        ("Scheme", built.facts.scheme.name().to_owned()),
        ("Closure", built.facts.closure.clone()),
        ("Inlet", built.facts.inlet.clone()),
        ("Journal", built.facts.journal().to_owned()),
        ("Width over diameter", ratios),
        (
            "Last relative eccentricity",
            built.facts.last_eccentricity.to_string(),
        ),
        (
            "Smallest relative film thickness of the samples",
            significant(built.facts.smallest_gap),
        ),
        ("Points", built.facts.points.to_string()),
    ];
    for (name, count) in &built.axes {
        rows.push((name, count.to_string()));
    }
    Table {
        title: "Content",
        note: "Points along each axis last.".to_owned(),
        rows: rows_of(&rows),
        ..Table::default()
    }
}

fn rows_of(rows: &[(&str, String)]) -> Vec<Vec<Cell>> {
    rows.iter()
        .map(|(label, value)| vec![Cell::text(*label), Cell::number(value.clone())])
        .collect()
}

/// Decimal logarithms of the errors, those that vanish left out.
fn decades(built: &BuiltDatabase) -> Vec<f64> {
    let errors = built.fresh.iter().map(|one| one.error);
    errors
        .filter(|error| *error > 0.0)
        .map(f64::log10)
        .collect()
}

fn histogram(built: &BuiltDatabase) -> Value {
    let decades = decades(built);
    let least = decades
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min)
        .max(-9.0);
    let most = decades.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let width = ((most - least) / BARS as f64).max(1e-3);
    let mut counts = vec![0.0; BARS];
    for decade in &decades {
        let bar = ((decade - least) / width).clamp(0.0, (BARS - 1) as f64) as usize;
        counts[bar] += 1.0;
    }
    let places = (0..BARS).map(|bar| least + (bar as f64 + 0.5) * width);
    Chart {
        x_title: "Decimal logarithm of the error".to_owned(),
        y_title: "States".to_owned(),
        y_range: None,
        series: vec![Series {
            name: "fresh states".to_owned(),
            x: Some(places.collect()),
            y: counts,
            mark: Mark::Bars,
        }],
    }
    .data(&Detail::ALONE)
}

fn errors_over_eccentricity(built: &BuiltDatabase) -> Value {
    let dots = Series {
        name: "fresh states".to_owned(),
        x: Some(built.fresh.iter().map(|one| one.eccentricity).collect()),
        y: built.fresh.iter().map(|one| one.error).collect(),
        mark: Mark::Dots,
    };
    let line = |name: &str, value: f64| Series {
        name: name.to_owned(),
        x: Some(vec![0.0, 1.0]),
        y: vec![value; 2],
        mark: Mark::Line,
    };
    logarithmic(Chart {
        x_title: "Relative eccentricity".to_owned(),
        y_title: "Error of the force".to_owned(),
        y_range: None,
        series: vec![
            dots,
            line("stated in the file", built.facts.stated_error),
            line("target", built.target),
        ],
    })
}

fn curves(built: &BuiltDatabase, title: &str, value: fn(&ForceCurve) -> &Vec<f64>) -> Value {
    let series = built.curves.iter().map(|curve| Series {
        name: format!("{:.0}°", curve.angle.to_degrees()),
        x: Some(curve.eccentricity.clone()),
        y: value(curve).clone(),
        mark: Mark::Line,
    });
    logarithmic(Chart {
        x_title: "Relative eccentricity".to_owned(),
        y_title: title.to_owned(),
        y_range: None,
        series: series.collect(),
    })
}

/// The chart with decades upwards.
fn logarithmic(chart: Chart) -> Value {
    let mut data = chart.data(&Detail::ALONE);
    data["y_log"] = json!(true);
    data
}
