//! The report of a sweep: the key figures of all cases over what varies, and a table of the cases.

use super::format::{MICROMETRE, ONE, PERCENT, Unit, Units};
use super::page::{Answer, Card, Cell, Check, Figure, Page, Table};
use crate::cases::{CaseRow, CaseStatus, SweepResults, VariedColumn};
use crate::limits::{Quantity, Side};
use serde_json::{Value, json};

/// More rows than this are not read; `cases.csv` has all of them.
const MOST_ROWS: usize = 2000;
/// More marks than this are not seen.
const MOST_MARKS: usize = 5000;

/// A figure of a case that answers most questions.
struct Headline {
    /// Its keys in summaries: of a load cycle, of a steady state.
    keys: &'static [&'static str],
    label: &'static str,
    /// Its unit among those of the report.
    unit: fn(&Units) -> Unit,
    limited: Option<Quantity>,
    /// The better side, if there is one: 1 for large, -1 for small.
    better: i8,
}

const HEADLINES: &[Headline] = &[
    Headline {
        keys: &["minimum_film_thickness_m"],
        label: "Minimum film thickness",
        unit: |_| MICROMETRE,
        limited: Some(Quantity::MinimumFilmThickness),
        better: 1,
    },
    Headline {
        keys: &["peak_film_pressure_pa"],
        label: "Peak film pressure",
        unit: |units| units.pressure,
        limited: Some(Quantity::PeakFilmPressure),
        better: -1,
    },
    Headline {
        keys: &["mean_power_loss_w", "power_loss_w"],
        label: "Power loss",
        unit: |units| units.power,
        limited: Some(Quantity::PowerLoss),
        better: -1,
    },
    Headline {
        keys: &["mean_side_flow_m3_s", "side_flow_m3_s"],
        label: "Side flow",
        unit: |units| units.flow,
        limited: None,
        better: 0,
    },
    Headline {
        keys: &["maximum_specific_load_pa", "specific_load_pa"],
        label: "Specific load",
        unit: |units| units.pressure,
        limited: Some(Quantity::MaximumSpecificLoad),
        better: 0,
    },
    Headline {
        keys: &["mean_relative_eccentricity", "relative_eccentricity"],
        label: "Relative eccentricity",
        unit: |_| ONE,
        limited: None,
        better: 0,
    },
    Headline {
        keys: &["effective_temperature_degc"],
        label: "Effective temperature",
        unit: |_| Unit {
            symbol: "°C",
            factor: 1.0,
        },
        limited: None,
        better: 0,
    },
    Headline {
        keys: &["contact_load_share"],
        label: "Contact load share",
        unit: |_| PERCENT,
        limited: None,
        better: 0,
    },
    Headline {
        keys: &["friction_coefficient"],
        label: "Friction coefficient",
        unit: |_| ONE,
        limited: None,
        better: 0,
    },
    Headline {
        keys: &["film_parameter"],
        label: "Minimum film over roughness",
        unit: |_| ONE,
        limited: None,
        better: 0,
    },
    Headline {
        keys: &["integrals.p_cos"],
        label: "Integral of p cos φ",
        unit: |_| ONE,
        limited: None,
        better: 0,
    },
    Headline {
        keys: &["integrals.p_sin"],
        label: "Integral of p sin φ",
        unit: |_| ONE,
        limited: None,
        better: 0,
    },
    Headline {
        keys: &["integrals.peak"],
        label: "Peak pressure, dimensionless",
        unit: |_| ONE,
        limited: None,
        better: 0,
    },
];

/// A headline that the cases have.
struct Shown {
    headline: &'static Headline,
    key: &'static str,
    column: usize,
    error: Option<usize>,
    unit: Unit,
    /// Place of its limit among those of the sweep.
    limit: Option<usize>,
}

/// Fills cards, figures and the table of cases; returns the data of the figures.
pub(super) fn fill(page: &mut Page, sweep: &SweepResults) -> Value {
    if !page.status.good {
        page.status.headline = "Not every case converged";
        page.status.explanation = "The cases named below failed, did not converge or have not run; \
                                   the others stand.";
    }
    let shown = shown(sweep);
    page.cards = cards(sweep, &shown);
    if !sweep.limits.is_empty() {
        page.answer = answer(sweep);
    }
    // A key of one value is set, not varied: nothing is drawn over it.
    let names: Vec<&str> = telling(sweep)
        .map(|(_, column)| column.key.as_str())
        .collect();
    let caption = match (joined(sweep), names.as_slice()) {
        ("second", [first, second]) => format!("Over {first}, one line for each {second}."),
        ("none", _) => format!(
            "One mark for each case; choose what it is drawn over: {}.",
            names.join(", ")
        ),
        (_, [first, ..]) => format!("Over {first}."),
        (_, []) => String::new(),
    };
    let is_stribeck = is_stribeck(sweep);
    if is_stribeck {
        page.figures.push(Figure {
            kind: STRIBECK,
            title: "Stribeck curve",
            caption: format!(
                "{caption} Friction torque of the journal over load and radius, the minimum film \
                 over the composite roughness, and the share of the load that asperities carry. A \
                 ring marks the least friction of the speeds that were calculated."
            ),
            size: "wide",
        });
    }
    let alone = shown
        .iter()
        .filter(|shown| !is_stribeck || !STRIBECK_KEYS.contains(&shown.key))
        .filter(|shown| shown.limit.is_some() || !is_the_same_everywhere(sweep, shown));
    let figures = alone.map(|shown| Figure {
        kind: shown.key,
        title: shown.headline.label,
        caption: caption.clone(),
        size: "",
    });
    page.figures.extend(figures);
    page.tables.push(case_table(sweep, &shown));
    data(sweep, &shown)
}

/// Whether all cases have one value of a headline, to round-off: the load of a sweep over the speed. The table says
/// which.
fn is_the_same_everywhere(sweep: &SweepResults, shown: &Shown) -> bool {
    const ROUND_OFF: f64 = 1e-9;
    let extremes = sweep.extremes(shown.column);
    let all = sweep.cases.len();
    // Where a case failed its mark is to be seen.
    all > 1
        && sweep.count(CaseStatus::Converged) == all
        && extremes.is_some_and(|[(_, low), (_, high)]| {
            (high - low).abs() <= ROUND_OFF * high.abs().max(low.abs())
        })
}

/// The figure of friction, film and contact over speed.
const STRIBECK: &str = "stribeck";
/// What it shows, from the top down.
const STRIBECK_KEYS: [&str; 3] = [
    "friction_coefficient",
    "film_parameter",
    "contact_load_share",
];

/// Whether the cases are those of a bearing with contact over its speed.
fn is_stribeck(sweep: &SweepResults) -> bool {
    let Some((at, first)) = telling(sweep).next() else {
        return false;
    };
    let speeds = |row: &CaseRow| row.numbers.get(at).copied().flatten();
    first.key == "operation.speed"
        && joined(sweep) != "none"
        && sweep
            .cases
            .iter()
            .all(|row| speeds(row).is_some_and(|speed| speed > 0.0))
        && STRIBECK_KEYS.iter().all(|key| sweep.column(key).is_some())
}

/// What the limits of the base study say over all cases.
fn answer(sweep: &SweepResults) -> Answer {
    let with = |verdict: &str| {
        let limits = 0..sweep.limits.len();
        let has = |row: &&CaseRow| {
            let mut limits = limits.clone();
            limits.any(|at| SweepResults::limit(row, at).is_some_and(|l| l.verdict == verdict))
        };
        sweep.cases.iter().filter(has).count()
    };
    let (exceeded, kept) = (with("exceeded"), with("ok"));
    let total = sweep.cases.len();
    let (class, headline, explanation) = if exceeded > 0 {
        let explanation =
            format!("A limit of the study is exceeded in {exceeded} of {total} cases.");
        ("bad", "Limit exceeded", explanation)
    } else if kept == total {
        let explanation = "Every case keeps every limit of the study.";
        ("good", "Limits kept", explanation.to_owned())
    } else {
        let explanation =
            format!("No limit exceeded, but only {kept} of {total} cases were judged.");
        ("bad", "Limits not evaluated", explanation)
    };
    Answer {
        class,
        headline,
        explanation,
        checks: Vec::new(),
    }
}

/// The headlines that the cases have, in units that suit their largest numbers.
fn shown(sweep: &SweepResults) -> Vec<Shown> {
    let largest = |keys: &[&str]| {
        let columns = keys.iter().filter_map(|key| sweep.column(key));
        columns
            .flat_map(|at| {
                sweep
                    .cases
                    .iter()
                    .map(move |row| SweepResults::value(row, at))
            })
            .filter(|value| value.is_finite())
            .fold(0.0, f64::max)
    };
    let units = Units::choose(
        0.0,
        largest(&["peak_film_pressure_pa"]),
        largest(&["mean_power_loss_w", "power_loss_w"]),
        largest(&["mean_side_flow_m3_s", "side_flow_m3_s"]),
        0.0,
    );
    let found = HEADLINES.iter().filter_map(|headline| {
        let key = headline
            .keys
            .iter()
            .find(|key| sweep.column(key).is_some())?;
        let limit = headline
            .limited
            .and_then(|quantity| sweep.limits.iter().position(|name| name == quantity.key()));
        Some(Shown {
            headline,
            key,
            column: sweep.column(key)?,
            error: sweep.column(&format!("error.{key}")),
            unit: (headline.unit)(&units),
            limit,
        })
    });
    found.collect()
}

fn cards(sweep: &SweepResults, shown: &[Shown]) -> Vec<Card> {
    let converged = sweep.count(CaseStatus::Converged);
    let mut rest: Vec<String> = Vec::new();
    for (count, what) in [
        (sweep.count(CaseStatus::NotConverged), "not converged"),
        (sweep.failed(), "failed"),
        (sweep.count(CaseStatus::NotRun), "not run"),
    ] {
        if count > 0 {
            rest.push(format!("{count} {what}"));
        }
    }
    let all = Card {
        label: "Cases converged",
        value: format!("{converged} of {}", sweep.cases.len()),
        detail: rest.join(", "),
        badge: (converged < sweep.cases.len()).then_some("See the table"),
        ..Card::default()
    };
    let best = shown.iter().filter_map(|shown| {
        let [low, high] = sweep.extremes(shown.column)?;
        let ((row, value), label) = match (shown.headline.better, shown.key) {
            (1, _) => (high, "Thickest minimum film"),
            (-1, "peak_film_pressure_pa") => (low, "Lowest peak film pressure"),
            (-1, _) => (low, "Smallest power loss"),
            _ => return None,
        };
        Some(Card {
            label,
            value: shown.unit.number(value),
            unit: shown.unit.symbol,
            error: shown
                .error
                .map(|at| SweepResults::value(row, at))
                .filter(|error| error.is_finite())
                .map(|error| shown.unit.rough(error)),
            detail: sweep.describe(row),
            checks: check(shown, row).into_iter().collect(),
            ..Card::default()
        })
    });
    let least_friction = shown.iter().filter_map(|shown| {
        let is_asked = is_stribeck(sweep) && shown.key == "friction_coefficient";
        let [(row, value), _] = is_asked.then(|| sweep.extremes(shown.column))??;
        Some(Card {
            label: "Smallest friction coefficient",
            value: shown.unit.number(value),
            unit: shown.unit.symbol,
            detail: sweep.describe(row),
            ..Card::default()
        })
    });
    std::iter::once(all)
        .chain(best)
        .chain(least_friction)
        .collect()
}

/// The limit of a headline beside the number of a case.
fn check(shown: &Shown, row: &CaseRow) -> Option<Check> {
    let limit = SweepResults::limit(row, shown.limit?)?;
    let verdict = match limit.verdict.as_str() {
        "ok" => "OK",
        "exceeded" => "exceeded",
        _ => "not evaluated",
    };
    let sign = match shown.headline.limited.map(Quantity::side) {
        Some(Side::AtMost) => "≤",
        _ => "≥",
    };
    Some(Check {
        verdict,
        good: verdict == "OK",
        text: format!(
            "{sign} {} ({})",
            shown.unit.plain(limit.limit),
            limit.source
        ),
    })
}

fn case_table(sweep: &SweepResults, shown: &[Shown]) -> Table {
    let mut columns = vec!["Case", "Varied", "Status"];
    columns.extend(shown.iter().map(|shown| shown.headline.label));
    columns.push("Message");
    // Where not all can be shown, those that need a look come first.
    let total = sweep.cases.len();
    let mut rows: Vec<&CaseRow> = sweep.cases.iter().collect();
    let mut note = "Colours tell which numbers keep and which exceed the limits of the study; \
                    cases.csv has all numbers of all cases."
        .to_owned();
    if total > MOST_ROWS {
        rows.sort_by_key(|row| (row.status == CaseStatus::Converged, row.number));
        rows.truncate(MOST_ROWS);
        note = format!(
            "The first {MOST_ROWS} of {total} cases, those not converged before the others. {note}"
        );
    }
    Table {
        title: "Cases",
        note,
        columns,
        rows: rows
            .iter()
            .map(|row| case_cells(sweep, shown, row))
            .collect(),
        size: "wide",
    }
}

fn case_cells(sweep: &SweepResults, shown: &[Shown], row: &CaseRow) -> Vec<Cell> {
    let mut cells = vec![
        Cell::number(row.number.to_string()),
        Cell::text(sweep.inputs(row)),
        Cell {
            text: row.status.name().replace('-', " "),
            class: if row.status == CaseStatus::Converged {
                "good"
            } else {
                "bad"
            },
        },
    ];
    for shown in shown {
        let value = SweepResults::value(row, shown.column);
        let error = shown.error.map(|at| SweepResults::value(row, at));
        let error = error.filter(|error| error.is_finite());
        let text = match error {
            Some(error) => format!("{} ± {}", shown.unit.show(value), shown.unit.rough(error)),
            None => shown.unit.show(value),
        };
        let check = check(shown, row);
        cells.push(match check {
            Some(check) if check.verdict != "not evaluated" => Cell {
                text: format!("{text} {}", check.verdict),
                class: if check.good { "good" } else { "bad" },
            },
            _ => Cell::number(text),
        });
    }
    cells.push(Cell::text(row.message.clone()));
    cells
}

/// The varied keys that tell the cases apart, with their places.
fn telling(sweep: &SweepResults) -> impl Iterator<Item = (usize, &VariedColumn)> {
    let columns = sweep.varied.iter().enumerate();
    columns.filter(|(_, column)| column.tells_apart)
}

/// Which cases share a line: `all` along one key, `second` one line for each value of the second,
/// `none` where a line would mean nothing.
fn joined(sweep: &SweepResults) -> &'static str {
    match (telling(sweep).count(), sweep.mode) {
        (0 | 1, _) | (_, "zip") => "all",
        (2, _) => "second",
        _ => "none",
    }
}

/// Data of the figures, in the units they are drawn in.
fn data(sweep: &SweepResults, shown: &[Shown]) -> Value {
    let stride = sweep.cases.len().div_ceil(MOST_MARKS).max(1);
    let rows: Vec<&CaseRow> = sweep.cases.iter().step_by(stride).collect();
    let inputs: Vec<Value> = telling(sweep)
        .map(|(at, column)| {
            let label = match column.unit.as_str() {
                "" | "-" => column.key.clone(),
                unit => format!("{} [{unit}]", column.key),
            };
            let values = rows.iter().map(|row| match row.numbers.get(at) {
                Some(Some(number)) => json!(number),
                _ => json!(row.inputs.get(at)),
            });
            json!({ "label": label, "values": values.collect::<Vec<_>>() })
        })
        .collect();
    let mut figures = serde_json::Map::new();
    for shown in shown {
        let numbers = |at: usize| -> Vec<Value> {
            let values = rows
                .iter()
                .map(|row| SweepResults::value(row, at) * shown.unit.factor);
            values
                .map(|value| json!(value.is_finite().then_some(value)))
                .collect()
        };
        let figure = json!({
            "label": if shown.unit.symbol.is_empty() {
                shown.headline.label.to_owned()
            } else {
                format!("{} [{}]", shown.headline.label, shown.unit.symbol)
            },
            "values": numbers(shown.column),
            "errors": shown.error.map(numbers),
            "limits": limits(sweep, shown),
        });
        figures.insert(shown.key.to_owned(), figure);
    }
    let labels: Vec<String> = rows.iter().map(|row| sweep.describe(row)).collect();
    let statuses: Vec<&str> = rows.iter().map(|row| row.status.name()).collect();
    json!({
        "units": {},
        "sweep": {
            "joined": joined(sweep), "inputs": inputs, "labels": labels, "status": statuses,
            "figures": figures,
            "stribeck": is_stribeck(sweep).then_some(STRIBECK_KEYS),
        },
    })
}

/// The limits of a headline as lines: more than one where a limit varies with the cases.
fn limits(sweep: &SweepResults, shown: &Shown) -> Vec<Value> {
    let Some(at) = shown.limit else {
        return Vec::new();
    };
    let mut found: Vec<f64> = Vec::new();
    for limit in sweep
        .cases
        .iter()
        .filter_map(|row| SweepResults::limit(row, at))
    {
        if limit.limit.is_finite() && !found.contains(&limit.limit) {
            found.push(limit.limit);
        }
    }
    // A limit that varies itself would fill the figure with lines.
    let few = found.iter().filter(|_| found.len() <= 4);
    few.map(|limit| {
        json!({
            "value": limit * shown.unit.factor,
            "label": format!("limit {}", shown.unit.plain(*limit)),
        })
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_a_headline_once() {
        let mut keys: Vec<&str> = HEADLINES.iter().flat_map(|h| h.keys).copied().collect();
        keys.sort_unstable();
        let count = keys.len();
        keys.dedup();
        assert_eq!(keys.len(), count);
    }
}
