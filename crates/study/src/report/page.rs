//! What the template shows: plain text blocks, everything already formatted for reading.

use super::format;
use super::machine::MachinePart;
use super::spark::Spark;
use crate::limits::{LimitCheck, Quantity, Side, Verdict};
use crate::results::{Header, VERSION, degrees_around, status_name};
use serde::Serialize;
use sommerfeld_film::{Bearing, Carrier, Feed, FeedShape, Outcome};

/// The whole page.
#[derive(Debug, Serialize)]
pub(crate) struct Page {
    /// Heading; the analysis where the study has no title.
    pub title: String,
    /// Name of the analysis in words.
    pub analysis: String,
    /// Version of the program.
    pub version: &'static str,
    /// The bearing in a line; may be empty.
    pub subject: String,
    /// Whether the limits are kept.
    pub answer: Answer,
    /// How the run ended.
    pub status: Status,
    /// Names what lies outside the models; empty where nothing does.
    pub warning: String,
    /// What the reader must know.
    pub messages: Vec<String>,
    /// Key figures.
    pub cards: Vec<Card>,
    /// The film at one instant or many, if the film model has fields.
    pub film: Option<FilmPart>,
    /// Figures by the question they answer, in the order of the page.
    pub sections: Vec<Section>,
    /// Further figures, after those of the sections.
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
    /// The pages of an engine or shaft.
    pub machine: Option<MachinePart>,
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

/// Whether the limits are kept, on the first screen.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Answer {
    /// `good`, `bad` or `open`.
    pub class: &'static str,
    /// In two words.
    pub headline: &'static str,
    /// In a sentence.
    pub explanation: String,
    /// Every limit with the value it was held against.
    pub checks: Vec<Check>,
}

/// Figures that answer one question.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Section {
    /// Anchor in the page.
    pub id: &'static str,
    /// Heading.
    pub title: &'static str,
    /// What to look at; may be empty.
    pub lead: String,
    /// Its figures.
    pub figures: Vec<Figure>,
}

/// The words around the pictures of the film.
#[derive(Debug, Serialize)]
pub(crate) struct FilmPart {
    /// Whether there is more than one instant to choose from.
    pub is_cycle: bool,
    /// Whether the crank angle is read out.
    pub shows_crank: bool,
    /// What to do with it.
    pub lead: String,
    /// Caption of the body of the film.
    pub solid: String,
    /// Caption of the map of pressure.
    pub pressure: String,
    /// Caption of the map of film fraction.
    pub fraction: String,
    /// Caption of the map of contact pressure; empty where asperities cannot touch.
    pub contact: String,
    /// Caption of the map of temperature; empty where it is no field.
    pub temperature: String,
}

/// One key figure.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Card {
    /// What it is.
    pub label: &'static str,
    /// Its key in `summary.json`.
    pub key: &'static str,
    /// Its value there, SI, with every digit; empty if not finite.
    pub exact: String,
    /// Its course over a cycle.
    pub spark: Option<Spark>,
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

/// One figure; the script draws it by its kind: one of its own drawings, or a [`Chart`] of this name.
///
/// [`Chart`]: super::chart::Chart
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
            subject: String::new(),
            answer: answer(header),
            warning: String::new(),
            status: Status {
                name: status_name(header.status),
                good: header.status == Outcome::Converged,
                headline: headline(header.status),
                explanation: explanation(header.status),
            },
            messages: header.messages.clone(),
            cards: Vec::new(),
            film: None,
            sections: Vec::new(),
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
            machine: None,
        }
    }
}

impl Page {
    /// Whether there is anything to draw.
    pub fn is_drawn(&self) -> bool {
        self.machine.is_some()
            || self.film.is_some()
            || !self.sections.is_empty()
            || !self.figures.is_empty()
    }
}

/// A value of `summary.json` with every digit; empty where it is not finite.
pub(crate) fn exact(value: f64) -> String {
    if value.is_finite() {
        format!("{value:?}")
    } else {
        String::new()
    }
}

/// So many grooves and holes are named in the line about the bearing.
const LISTED_FEEDS: usize = 2;

/// A groove or hole in a few words.
pub(crate) fn feed_words(feed: &Feed) -> String {
    let shape = match feed.shape {
        FeedShape::Hole { .. } => "hole",
        FeedShape::Rectangle { .. } => "groove",
        FeedShape::Circumferential { .. } => "groove all around",
    };
    let carrier = match feed.carried_by {
        Carrier::Shell => "shell",
        Carrier::Journal => "journal",
    };
    if matches!(feed.shape, FeedShape::Circumferential { .. }) {
        return format!("{shape} in the {carrier}");
    }
    let at = format::angle(degrees_around(feed.angle));
    format!("{shape} in the {carrier} at {at}")
}

/// What the circle around a journal position is.
pub(super) fn outer_circle(bearing: &Bearing) -> &'static str {
    if bearing.is_plain() {
        "On the outer circle the surfaces would touch."
    } else {
        "The outer circle is the radial clearance; these surfaces are no cylinders and touch elsewhere."
    }
}

/// The bearing in a line.
pub(crate) fn subject(bearing: &Bearing) -> String {
    let millimetres = |metres: f64| format::plain_number(metres * 1e3);
    let mut text = format!(
        "Bore {} mm · width {} mm · radial clearance {} µm ({} ‰ of the radius)",
        millimetres(bearing.diameter),
        millimetres(bearing.width),
        format::plain_number(bearing.radial_clearance * 1e6),
        format::plain_number(bearing.relative_clearance() * 1e3)
    );
    for feed in bearing.feeds.iter().take(LISTED_FEEDS) {
        text += &format!(" · {}", feed_words(feed));
    }
    if let Some(more @ 1..) = bearing.feeds.len().checked_sub(LISTED_FEEDS) {
        text += &format!(" · {more} more grooves and holes");
    }
    text
}

/// What the limits say, in a sentence.
fn answer(header: &Header) -> Answer {
    let limits = &header.limits;
    let with = |verdict| {
        limits
            .iter()
            .filter(|check| check.verdict == verdict)
            .count()
    };
    let of_all = |count: usize| format!("{count} of {}", limits.len());
    let (class, headline, explanation) = if limits.is_empty() {
        (
            "open",
            "No limits set",
            "The study names no limits, so that there is nothing to judge the results against."
                .to_owned(),
        )
    } else if with(Verdict::Exceeded) > 0 {
        let exceeded = of_all(with(Verdict::Exceeded));
        (
            "bad",
            "Limit exceeded",
            format!("{exceeded} limits of the study exceeded."),
        )
    } else if with(Verdict::NotEvaluated) > 0 {
        let open = of_all(with(Verdict::NotEvaluated));
        (
            "bad",
            "Limits not evaluated",
            format!("{open} limits could not be judged."),
        )
    } else {
        (
            "good",
            "Limits kept",
            "Every limit of the study is kept.".to_owned(),
        )
    };
    Answer {
        class,
        headline,
        explanation,
        checks: limits.iter().map(check_with_value).collect(),
    }
}

/// A limit with the quantity, what was found and how far it is from the limit.
pub(crate) fn check_with_value(check: &LimitCheck) -> Check {
    let quantity = check.limit.quantity;
    let unit = match quantity {
        Quantity::MinimumFilmThickness => format::MICROMETRE,
        Quantity::PeakFilmPressure | Quantity::MaximumSpecificLoad => format::MEGAPASCAL,
        Quantity::PowerLoss => format::WATT,
    };
    let found = check
        .found
        .map_or("n/a".to_owned(), |value| unit.show(value));
    let margin = check.found.map_or(String::new(), |value| {
        let share = 100.0 * (value / check.limit.value - 1.0);
        if share.is_finite() {
            format!(", {share:+.0} %").replace('-', "−")
        } else {
            String::new()
        }
    });
    Check {
        verdict: verdict(check),
        good: check.verdict == Verdict::Ok,
        text: format!(
            "{} {found}, limit {}{margin}",
            quantity.key().replace('_', " "),
            limit_text(check, unit)
        ),
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
        "engine" => "Engine: every bearing over the working cycle".to_owned(),
        "shaft" => "Shaft: every bearing over its cycle".to_owned(),
        "database" => "Database of films".to_owned(),
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
    let databases = header.databases.iter();
    facts.extend(databases.map(|one| ("Film".to_owned(), one.told())));
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

/// The error of a key of `summary.json` in a reading unit; of a vector, those of its components.
pub(crate) fn error(header: &Header, key: &str, unit: format::Unit) -> Option<String> {
    let errors = header.error.as_ref()?;
    if let Some(value) = errors.get(key) {
        return Some(unit.rough(*value));
    }
    let components = [0, 1].map(|k| errors.get(&format!("{key}.{k}")));
    let [Some(x), Some(y)] = components else {
        return None;
    };
    Some(format!("{}, {}", unit.rough(*x), unit.rough(*y)))
}
