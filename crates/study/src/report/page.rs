//! What the template shows: plain text blocks, everything already formatted for reading.

use super::format;
use crate::limits::{LimitCheck, Quantity, Side, Verdict};
use crate::results::{Header, VERSION, status_name};
use serde::Serialize;
use sommerfeld_film::Outcome;

/// The whole page.
#[derive(Debug, Serialize)]
pub(crate) struct Page {
    /// Heading; the analysis where the study has no title.
    pub title: String,
    /// Name of the analysis in words.
    pub analysis: String,
    /// Version of the program.
    pub version: &'static str,
    /// How the run ended.
    pub status: Status,
    /// What the reader must know.
    pub messages: Vec<String>,
    /// Key figures.
    pub cards: Vec<Card>,
    /// Figures in the order of the page.
    pub figures: Vec<Figure>,
    /// Tables in the order of the page.
    pub tables: Vec<Table>,
    /// Input of the study, key and value.
    pub inputs: Vec<(String, String)>,
    /// Models with references.
    pub models: Vec<ModelLine>,
    /// Reproducibility and other facts, label and text.
    pub facts: Vec<(String, String)>,
    /// The study file.
    pub study_text: String,
}

/// How the run ended.
#[derive(Debug, Serialize)]
pub(crate) struct Status {
    /// Its name in `summary.json`.
    pub name: &'static str,
    /// Good or not, for the colour.
    pub good: bool,
    /// Its name in words.
    pub headline: &'static str,
    /// What it means for the numbers.
    pub explanation: &'static str,
}

/// One key figure.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Card {
    /// What it is.
    pub label: &'static str,
    /// Four significant digits.
    pub value: String,
    /// Unit of the value.
    pub unit: &'static str,
    /// Error of the value in the same unit, if known.
    pub error: Option<String>,
    /// Where or when.
    pub detail: String,
    /// Names a status other than converged.
    pub badge: Option<&'static str>,
    /// Limits it was held against.
    pub checks: Vec<Check>,
}

/// One limit beside a value.
#[derive(Debug, Serialize)]
pub(crate) struct Check {
    /// `OK`, `exceeded` or `not evaluated`.
    pub verdict: &'static str,
    /// For the colour.
    pub good: bool,
    /// The limit and its source.
    pub text: String,
}

/// One figure; the script draws it by its kind.
#[derive(Debug, Serialize)]
pub(crate) struct Figure {
    /// Which drawing.
    pub kind: &'static str,
    /// Its title.
    pub title: &'static str,
    /// What one sees.
    pub caption: String,
    /// Place in the grid: empty, `wide` or `tall`.
    pub size: &'static str,
}

/// One table.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Table {
    /// Its heading.
    pub title: &'static str,
    /// What to know about it; may be empty.
    pub note: String,
    /// Column headings; none for a list of label and value.
    pub columns: Vec<&'static str>,
    /// Rows of cells.
    pub rows: Vec<Vec<Cell>>,
    /// Place in the grid: empty, `wide` or `tall`.
    pub size: &'static str,
}

/// One cell of a table.
#[derive(Debug, Default, Clone, Serialize)]
pub(crate) struct Cell {
    /// Its text.
    pub text: String,
    /// `number`, `good`, `bad`, `key` or empty.
    pub class: &'static str,
}

/// One model.
#[derive(Debug, Serialize)]
pub(crate) struct ModelLine {
    /// Family and name.
    pub name: String,
    /// What it is.
    pub description: &'static str,
    /// Where it is published.
    pub reference: &'static str,
    /// DOI, empty if none.
    pub doi: &'static str,
}

impl Cell {
    /// Text, flush left.
    pub fn text(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            class: "",
        }
    }

    /// A number, flush right in tabular digits.
    pub fn number(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            class: "number",
        }
    }

    /// An outcome in words, coloured.
    pub fn outcome(outcome: Outcome) -> Self {
        Self {
            text: headline(outcome).to_owned(),
            class: if outcome == Outcome::Converged {
                "good"
            } else {
                "bad"
            },
        }
    }
}

impl Page {
    /// The page of a header, still without numbers of the body.
    pub fn of(header: &Header) -> Self {
        let analysis = analysis_in_words(&header.analysis);
        let title = if header.title.trim().is_empty() {
            analysis.clone()
        } else {
            header.title.clone()
        };
        Self {
            title,
            analysis,
            version: VERSION,
            status: Status {
                name: status_name(header.status),
                good: header.status == Outcome::Converged,
                headline: headline(header.status),
                explanation: explanation(header.status),
            },
            messages: header.messages.clone(),
            cards: Vec::new(),
            figures: Vec::new(),
            tables: Vec::new(),
            inputs: header
                .inputs
                .iter()
                .map(|row| (row.key.clone(), row.value.clone()))
                .collect(),
            models: models(header),
            facts: facts(header),
            study_text: header.study_text.clone(),
        }
    }
}

/// An outcome in words.
pub(crate) fn headline(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Converged => "Converged",
        Outcome::NotConverged => "Not converged",
        Outcome::Starved => "Starved",
        Outcome::NoSolution => "No solution",
    }
}

/// The badge beside a number whose calculation did not converge.
pub(crate) fn badge(outcome: Outcome) -> Option<&'static str> {
    (outcome != Outcome::Converged).then(|| headline(outcome))
}

/// The note of a table whose numbers did not converge; empty where they did.
pub(crate) fn last_iterates(header: &Header) -> String {
    badge(header.status).map_or_else(String::new, |status| {
        if header.status == Outcome::NotConverged {
            format!("{status}: these numbers are last iterates, not results.")
        } else {
            format!("{status}: no results.")
        }
    })
}

fn explanation(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Converged => "Every calculation reached its tolerance.",
        Outcome::NotConverged => {
            "At least one calculation stopped before its tolerance. The numbers below are last \
             iterates, not results."
        }
        Outcome::Starved => "No oil can reach the film, so that it carries no load.",
        Outcome::NoSolution => {
            "At least at one position the film equations have no solution. The numbers below do \
             not describe a film there."
        }
    }
}

fn analysis_in_words(analysis: &str) -> String {
    match analysis {
        "film" => "Film at a given state".to_owned(),
        "equilibrium" => "Equilibrium under steady load".to_owned(),
        "coefficients" => "Equilibrium with stiffness and damping".to_owned(),
        "load-cycle" => "Journal orbit over a load cycle".to_owned(),
        "sweep" => "Sweep over a base study".to_owned(),
        other => other.to_owned(),
    }
}

fn models(header: &Header) -> Vec<ModelLine> {
    header
        .models
        .iter()
        .map(|model| ModelLine {
            name: format!("{}: {}", model.family.replace('_', " "), model.name),
            description: model.description,
            reference: model.reference,
            doi: model.doi.unwrap_or_default(),
        })
        .collect()
}

fn facts(header: &Header) -> Vec<(String, String)> {
    let mut facts = vec![
        ("Program".to_owned(), format!("Sommerfeld {VERSION}")),
        ("Analysis".to_owned(), header.analysis.clone()),
        (
            "Wall time".to_owned(),
            format!("{} s", format::significant(header.wall_time)),
        ),
    ];
    if let Some(hash) = &header.study_hash {
        facts.push(("Hash of the input".to_owned(), hash.clone()));
    }
    facts
}

/// The limits of one quantity in words, in the unit its value is shown in.
pub(crate) fn checks(header: &Header, quantity: Quantity, unit: format::Unit) -> Vec<Check> {
    header
        .limits
        .iter()
        .filter(|check| check.limit.quantity == quantity)
        .map(|check| Check {
            verdict: verdict(check),
            good: check.verdict == Verdict::Ok,
            text: limit_text(check, unit),
        })
        .collect()
}

fn verdict(check: &LimitCheck) -> &'static str {
    match check.verdict {
        Verdict::Ok => "OK",
        Verdict::Exceeded => "exceeded",
        Verdict::NotEvaluated => "not evaluated",
    }
}

fn limit_text(check: &LimitCheck, unit: format::Unit) -> String {
    let sign = match check.limit.quantity.side() {
        Side::AtLeast => "≥",
        Side::AtMost => "≤",
    };
    let source = if check.limit.source.is_empty() {
        "no source given"
    } else {
        &check.limit.source
    };
    format!("{sign} {} ({source})", unit.plain(check.limit.value))
}

/// Cells for the limit and the verdict of a quantity: empty where it has none.
pub(crate) fn limit_cells(
    header: &Header,
    quantity: Option<Quantity>,
    unit: format::Unit,
) -> [Cell; 2] {
    let checks = quantity.map_or_else(Vec::new, |quantity| checks(header, quantity, unit));
    let join = |text: fn(&Check) -> &str| checks.iter().map(text).collect::<Vec<_>>().join("; ");
    let class = match (checks.is_empty(), checks.iter().all(|check| check.good)) {
        (true, _) => "",
        (false, true) => "good",
        (false, false) => "bad",
    };
    [
        Cell::text(join(|check| &check.text)),
        Cell {
            text: join(|check| check.verdict),
            class,
        },
    ]
}

/// The error of a key of `summary.json` in a reading unit.
pub(crate) fn error(header: &Header, key: &str, unit: format::Unit) -> Option<String> {
    let value = header.error.as_ref()?.get(key)?;
    Some(unit.rough(*value))
}
