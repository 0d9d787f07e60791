//! The page of one bearing: what the report of a load cycle shows, at every speed, and beside the load
//! the one that hinges at the mains would give.

use super::{AtSpeed, MachinePage, flag, own_header, speed_label};
use crate::report::chart::{Chart, Mark, Series};
use crate::report::cycle::{self, CyclePart};
use crate::report::detail::Detail;
use crate::report::figures::thinned;
use crate::report::format::{Units, plain_number};
use crate::report::page::{Card, Figure, FilmPart, Section, check_with_value, headline, subject};
use crate::results::machine::{BearingResults, MachineResults, SpeedResults};
use crate::results::{Header, degrees, magnitude};
use serde_json::{Value, json};
use sommerfeld_engine::Role;
use sommerfeld_film::Outcome;

/// The page of the bearing `number`, and the data of its figures for each speed.
pub(super) fn page(
    header: &Header,
    machine: &MachineResults,
    number: usize,
    id: &str,
    units: &Units,
    detail: &Detail,
) -> (MachinePage, Value) {
    // A speed whose loads failed has no bearings: its place stays empty.
    let found: Vec<Option<&BearingResults>> = machine
        .speeds
        .iter()
        .map(|speed| speed.bearings.get(number))
        .collect();
    let mut data = Vec::new();
    let mut at = Vec::new();
    let mut headers = Vec::new();
    // All speeds share the places of the figures: those of the speed that fills most of them.
    let mut fullest: (usize, Option<FilmPart>, Vec<Section>) = (0, None, Vec::new());
    for (bearing, speed) in found.iter().zip(&machine.speeds) {
        let Some(bearing) = bearing else {
            data.push(Value::Null);
            at.push(nothing_at(speed));
            continue;
        };
        let own = own_header(header, bearing);
        let part = with_determinate(bearing, &own, units, detail);
        let figures = part.sections.iter().map(|one| one.figures.len()).sum();
        if figures > fullest.0 {
            fullest = (figures, part.film, part.sections);
        }
        data.push(part.data);
        at.push(AtSpeed {
            speed: speed_label(speed),
            status: headline(own.status),
            good: own.status == Outcome::Converged,
            checks: own.limits.iter().map(check_with_value).collect(),
            cards: without_curves(part.cards, detail),
            note: note(bearing, part.hole),
            tables: part.tables,
        });
        headers.push(own);
    }
    let first = found.into_iter().flatten().next();
    let of_first = |text: &dyn Fn(&BearingResults) -> String| first.map_or_else(String::new, text);
    let page = MachinePage {
        id: id.to_owned(),
        name: of_first(&|one| one.name.clone()),
        heading: of_first(&|one| one.name.clone()),
        subject: of_first(&|one| subject(&one.cycle.bearing)),
        lead: of_first(&|one| lead(machine, one)),
        flag: flag(&headers),
        film: fullest.1,
        sections: fullest.2,
        at,
    };
    (page, Value::Array(data))
}

/// What a page tells of a speed beside its figures: of the oil holes, and where the orbit is from.
fn note(bearing: &BearingResults, hole: String) -> String {
    let Some(first) = &bearing.turned_from else {
        return hole;
    };
    let turned = if first.later_by == 0.0 {
        format!(
            "This bearing does the same as {}: its orbit is the one computed there.",
            first.name
        )
    } else {
        format!(
            "This bearing does the same as {}, {}° of crank angle later: its orbit is the one computed \
             there, shifted.",
            first.name,
            plain_number(degrees(first.later_by))
        )
    };
    [hole, turned]
        .into_iter()
        .filter(|part| !part.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

/// What a page tells of a speed at which there are no results of its bearing.
fn nothing_at(speed: &SpeedResults) -> AtSpeed {
    AtSpeed {
        speed: speed_label(speed),
        status: headline(speed.outcome),
        note: "No results of this bearing at this speed.".to_owned(),
        ..AtSpeed::default()
    }
}

/// Cards without their small curves where so many of them would take the room of figures.
fn without_curves(mut cards: Vec<Card>, detail: &Detail) -> Vec<Card> {
    if detail.is_crowded {
        cards.iter_mut().for_each(|card| card.spark = None);
    }
    cards
}

/// Which body and frame the loads of a bearing belong to.
fn frame(role: Role) -> &'static str {
    match role {
        Role::Main => {
            "Main bearing of the crankshaft. The shell frame is that of the engine: x up along the \
             bisector of the banks, y 90° further in the sense of rotation. Loads are loads on the \
             main journal."
        }
        Role::BigEnd => {
            "Big end of the connecting rod. The shell frame is that of the rod: x from the big end \
             to the small end, y 90° further in the sense of rotation. Loads are loads on the \
             crankpin."
        }
        Role::SmallEnd => {
            "Small end of the connecting rod. The shell frame is that of the rod: x from the big \
             end to the small end, y 90° further in the sense of rotation. Loads are loads on the \
             piston pin."
        }
        Role::PistonBoss => {
            "Both bosses of the piston together. The shell frame is that of the piston: x along the \
             cylinder axis towards the head, y 90° further in the sense of rotation. Loads are \
             loads on the piston pin."
        }
        Role::Shaft => {
            "Bearing of the shaft. The shell frame is that of the housing. Loads are loads on the \
             journal."
        }
    }
}

fn lead(machine: &MachineResults, bearing: &BearingResults) -> String {
    let frame = frame(bearing.role);
    if matches!(bearing.role, Role::Main | Role::Shaft) && !machine.load_model.is_empty() {
        format!("{frame} Model of the loads: {}.", model_words(machine))
    } else {
        frame.to_owned()
    }
}

/// The model of the loads without a full stop.
pub(super) fn model_words(machine: &MachineResults) -> &str {
    machine.load_model.trim().trim_end_matches('.')
}

/// A cycle, and beside its load that of the determinate model where there is one.
fn with_determinate(
    bearing: &BearingResults,
    own: &Header,
    units: &Units,
    detail: &Detail,
) -> CyclePart {
    let cycle = &bearing.cycle;
    let mut part = cycle::part(own, cycle, units, detail);
    let points = &cycle.orbit.points;
    let Some(hinged) = &bearing.determinate_load else {
        return part;
    };
    if points.is_empty() || hinged.len() != points.len() {
        return part;
    }
    let kept = thinned(points.len(), detail.curve_points);
    let over = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        kept.iter()
            .map(|&at| value(at) * units.force.factor)
            .collect()
    };
    let series = |name: &str, y| Series {
        name: name.to_owned(),
        x: None,
        y,
        mark: Mark::Line,
    };
    let chart = Chart {
        x_title: "Crank angle [°]".to_owned(),
        y_title: format!("Load [{}]", units.force.symbol),
        y_range: None,
        series: vec![
            series("elastic shaft", over(&|at| magnitude(points[at].load))),
            series("hinges at the mains", over(&|at| magnitude(hinged[at]))),
        ],
    };
    if let Some(charts) = part.data.get_mut("charts") {
        charts["load-models"] = chart.data(detail);
    }
    if let Some(curves) = part.data.get_mut("cycle") {
        curves["hinged_x"] = detail.numbers(&over(&|at| hinged[at][0]));
        curves["hinged_y"] = detail.numbers(&over(&|at| hinged[at][1]));
        curves["hinged"] = json!(true);
    }
    if let Some(section) = part.sections.first_mut() {
        section.figures.push(Figure {
            kind: "load-models",
            title: "Load of the elastic and of the hinged shaft",
            caption: "Magnitude of the load on the journal as this run used it (elastic shaft on \
                      films and supports), and as a shaft with a hinge at each main would give it \
                      (statically determinate)."
                .to_owned(),
            size: "wide",
        });
    }
    part
}
