//! The report of an engine or shaft: the machine as a whole, then every bearing, at every speed.
//!
//! A page of the report is the machine or one bearing; all of them stand in one file, and the script
//! shows one at a time, at the speed that the reader chose. Cards and tables of every speed are
//! text; the figures of all speeds share their places and are drawn when they are looked at.

mod bearing;
mod engine;
mod overview;
mod torsion;

use super::cycle;
use super::detail::Detail;
use super::format::plain_number;
use super::page::{Card, Check, FilmPart, Page, Section, Table, check_with_value};
use crate::limits::Verdict;
use crate::results::machine::{BearingResults, MachineResults, SpeedResults};
use crate::results::{Header, rpm};
use serde::Serialize;
use serde_json::{Value, json};
use sommerfeld_film::Outcome;

/// The pages of a machine.
#[derive(Debug, Serialize)]
pub(crate) struct MachinePart {
    /// The speeds in words.
    pub speeds: Vec<String>,
    /// The machine as a whole, then every bearing.
    pub pages: Vec<MachinePage>,
}

/// The machine as a whole or one bearing.
#[derive(Debug, Serialize)]
pub(crate) struct MachinePage {
    /// Its anchor.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Heading; empty for the machine, whose heading is that of the report.
    pub heading: String,
    /// It in a line.
    pub subject: String,
    /// Frames, loads and models in words.
    pub lead: String,
    /// What is wrong with it at any speed; empty where nothing is.
    pub flag: &'static str,
    /// The film through the cycle, if the film model has fields.
    pub film: Option<FilmPart>,
    /// Figures by the question they answer.
    pub sections: Vec<Section>,
    /// What depends on the speed and is no figure.
    pub at: Vec<AtSpeed>,
}

/// What a page tells of one speed.
#[derive(Debug, Default, Serialize)]
pub(crate) struct AtSpeed {
    /// The speed.
    pub speed: String,
    /// How it ended.
    pub status: &'static str,
    /// For the colour.
    pub good: bool,
    /// Limits with what was found.
    pub checks: Vec<Check>,
    /// Key figures.
    pub cards: Vec<Card>,
    /// A sentence about the figures of this speed; may be empty.
    pub note: String,
    /// Tables in the order of the page.
    pub tables: Vec<Table>,
}

/// Fills the page and returns the data of its figures.
pub(super) fn fill(page: &mut Page, header: &Header, machine: &MachineResults) -> Value {
    let is_engine = machine.speeds.iter().any(|one| one.performance.is_some());
    let units = cycle::units(machine.all().map(|(_, _, bearing)| &bearing.cycle));
    let detail = Detail::of_many(machine.all().count(), largest_grid(machine));
    say_what_failed(page, machine);
    if !header.limits.is_empty() {
        page.answer.checks = header
            .limits
            .iter()
            .map(|check| {
                let mut words = check_with_value(check);
                if let Some(at) = &check.at {
                    words.text += &format!(": {at}");
                }
                words
            })
            .collect();
    }
    let ids = ids(machine, if is_engine { "engine" } else { "shaft" });
    let mut pages = vec![overview::page(header, machine, &units, is_engine)];
    let mut cycles = Vec::new();
    for (number, id) in ids.iter().enumerate() {
        let (page, data) = bearing::page(header, machine, number, id, &units, &detail);
        pages.push(page);
        cycles.push(data);
    }
    let data = json!({
        "machine": overview::data(header, machine, &units, &ids, is_engine),
        "overall": engine::speeds(machine, &units),
        "cycles": cycles,
    });
    page.machine = Some(MachinePart {
        speeds: machine.speeds.iter().map(speed_label).collect(),
        pages,
    });
    data
}

/// Cells around and along of the finest films.
fn largest_grid(machine: &MachineResults) -> [usize; 2] {
    let films = machine
        .all()
        .filter_map(|(_, _, bearing)| Some(&bearing.cycle.fields.as_ref()?.worst.field));
    films.fold([1, 1], |grid, film| {
        [
            grid[0].max(film.angles.len()),
            grid[1].max(film.axial.len()),
        ]
    })
}

/// Names what did not converge.
fn say_what_failed(page: &mut Page, machine: &MachineResults) {
    let failed: Vec<String> = machine
        .all()
        .filter(|(_, _, bearing)| bearing.cycle.orbit.outcome != Outcome::Converged)
        .map(|(speed, bearing, _)| place(machine, speed, bearing))
        .collect();
    let all = machine.all().count();
    if failed.is_empty() || failed.len() == all {
        return;
    }
    page.status.headline = "Not every bearing converged";
    page.status.explanation = "The bearings named below did not converge; the others stand.";
    page.messages
        .push(format!("Not converged: {}.", failed.join("; ")));
}

/// A bearing at a speed in words.
fn place(machine: &MachineResults, speed: usize, bearing: usize) -> String {
    let Some(at) = machine.speeds.get(speed) else {
        return String::new();
    };
    let name = at.bearings.get(bearing).map_or("", |one| one.name.as_str());
    if machine.speeds.len() > 1 {
        format!("{name} at {}", speed_label(at))
    } else {
        name.to_owned()
    }
}

/// A speed in words.
fn speed_label(speed: &SpeedResults) -> String {
    format!("{} rpm", plain_number(rpm(speed.speed)))
}

/// The anchors of the bearings: their names in letters that an address takes, none twice and none
/// that of the page of the machine.
fn ids(machine: &MachineResults, taken: &str) -> Vec<String> {
    let mut ids: Vec<String> = vec![taken.to_owned()];
    for bearing in machine.fullest() {
        let plain: String = bearing
            .name
            .chars()
            .map(|letter| match letter {
                letter if letter.is_ascii_alphanumeric() => letter.to_ascii_lowercase(),
                _ => '-',
            })
            .collect();
        let plain = format!("b-{plain}");
        let mut id = plain.clone();
        let mut again = 2;
        while ids.contains(&id) {
            id = format!("{plain}-{again}");
            again += 1;
        }
        ids.push(id);
    }
    ids.split_off(1)
}

/// What the header of one bearing at one speed would be: its own outcome and limits.
fn own_header(header: &Header, bearing: &BearingResults) -> Header {
    let limits = header.limits.iter();
    let limits = limits.map(|check| bearing.check(&check.limit)).collect();
    Header {
        analysis: header.analysis.clone(),
        title: bearing.name.clone(),
        status: bearing.cycle.orbit.outcome,
        messages: Vec::new(),
        models: Vec::new(),
        wall_time: f64::NAN,
        inputs: Vec::new(),
        study_text: String::new(),
        study_hash: None,
        error: None,
        grid: header.grid,
        limits,
        heat: bearing.heat.clone(),
        plain: None,
        databases: Vec::new(),
        comparison: None,
    }
}

/// What is wrong with a bearing at any speed.
fn flag(headers: &[Header]) -> &'static str {
    let any = |verdict| {
        let mut limits = headers.iter().flat_map(|header| &header.limits);
        limits.any(|check| check.verdict == verdict)
    };
    if headers.iter().any(|one| one.status != Outcome::Converged) {
        "not converged"
    } else if any(Verdict::Exceeded) {
        "limit exceeded"
    } else {
        ""
    }
}

/// Largest magnitude of finite values.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values
        .map(f64::abs)
        .filter(|value| value.is_finite())
        .fold(0.0, f64::max)
}
