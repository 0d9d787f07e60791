//! Where asperities touch: what they carry, how hard they press, what their friction costs.

use super::chart::{Chart, Mark, Series};
use super::detail::Detail;
use super::figures::thinned;
use super::film::in_film;
use super::format::{PERCENT, Units, angle, significant};
use super::page::{Card, Cell, Figure, Section, Table, badge, exact};
use super::spark::spark;
use crate::results::{CycleResults, Header, SteadyResults, degrees, film_parameter, magnitude};
use serde_json::Value;
use sommerfeld_bearing::CyclePoint;
use sommerfeld_film::FilmSummary;

/// What the share of the contact load is, for tables.
const SHARE_NOTE: &str = "Contact load: the integral of the asperities' pressure without regard to \
    its direction; its share is over the load.";

/// A share in percent: what is nothing for a reader is told so, without its power of ten.
fn share_number(share: f64) -> String {
    const LEAST: f64 = 1e-5;
    if share > 0.0 && share < LEAST {
        "< 0.001".to_owned()
    } else {
        PERCENT.number(share)
    }
}

fn share_text(share: f64) -> String {
    format!("{} {}", share_number(share), PERCENT.symbol)
}

/// Contact loads below this share of the largest load are drawn alone.
const SMALL: f64 = 0.02;

/// Power that shearing oil takes, W.
fn viscous(summary: &FilmSummary) -> f64 {
    summary.friction_power - summary.boundary_power
}

/// Cards of a state whose asperities may touch; none between others.
pub(super) fn steady_cards(header: &Header, steady: &SteadyResults, units: &Units) -> Vec<Card> {
    if !steady.bearing.finish.has_contact() {
        return Vec::new();
    }
    let summary = &steady.summary;
    let peak = &summary.peak_contact_pressure;
    let place = place_where(peak.value, in_film(peak, steady.bearing.width));
    let share = steady.contact_load_share();
    let boundary = summary.boundary_power;
    vec![
        Card {
            label: "Contact load share",
            key: "contact_load_share",
            exact: exact(share),
            value: share_number(share),
            unit: PERCENT.symbol,
            detail: format!(
                "asperity pressure {}{place}",
                units.pressure.show(peak.value)
            ),
            badge: badge(header.status),
            ..Card::default()
        },
        Card {
            label: "Boundary friction power",
            key: "boundary_power_w",
            exact: exact(boundary),
            value: units.power.number(boundary),
            unit: units.power.symbol,
            detail: format!("viscous {}", units.power.show(viscous(summary))),
            badge: badge(header.status),
            ..Card::default()
        },
    ]
}

/// Cards of a cycle in which asperities may touch; none in others.
pub(super) fn cycle_cards(header: &Header, cycle: &CycleResults, units: &Units) -> Vec<Card> {
    if !cycle.bearing.finish.has_contact() {
        return Vec::new();
    }
    let points = &cycle.orbit.points;
    let places: Vec<f64> = points.iter().map(|point| point.crank_angle).collect();
    let course = |value: fn(&FilmSummary) -> f64| {
        let values: Vec<f64> = points.iter().map(|point| value(&point.summary)).collect();
        spark(&places, &values, None, None)
    };
    let share = cycle.contact_load_share();
    let peak = cycle.peak_contact_pressure();
    let peak = peak.map_or_else(String::new, |point| {
        let value = point.summary.peak_contact_pressure.value;
        let at = format!(" at crank angle {}", angle(degrees(point.crank_angle)));
        let at = place_where(value, at);
        format!("asperity pressure up to {}{at}", units.pressure.show(value))
    });
    let boundary = cycle.mean(|point| point.summary.boundary_power);
    vec![
        Card {
            label: "Mean contact load share",
            key: "contact_load_share",
            exact: exact(share),
            value: share_number(share),
            unit: PERCENT.symbol,
            detail: peak,
            spark: course(|summary| summary.contact_load),
            badge: badge(header.status),
            ..Card::default()
        },
        Card {
            label: "Mean boundary friction power",
            key: "boundary_power_w",
            exact: exact(boundary),
            value: units.power.number(boundary),
            unit: units.power.symbol,
            detail: format!(
                "viscous {}",
                units
                    .power
                    .show(cycle.mean(|point| viscous(&point.summary)))
            ),
            spark: course(|summary| summary.boundary_power),
            badge: badge(header.status),
            ..Card::default()
        },
    ]
}

/// A place in words, where there is a pressure that could have one.
fn place_where(pressure: f64, place: String) -> String {
    if pressure > 0.0 && !place.is_empty() {
        format!(" {}", place.trim_start())
    } else {
        String::new()
    }
}

fn pairs<const N: usize>(rows: [(&str, String); N]) -> Vec<Vec<Cell>> {
    let rows = rows.into_iter();
    rows.map(|(label, value)| vec![Cell::text(label), Cell::number(value)])
        .collect()
}

/// The table of a state whose asperities may touch.
pub(super) fn steady_table(steady: &SteadyResults, units: &Units) -> Option<Table> {
    if !steady.bearing.finish.has_contact() {
        return None;
    }
    let summary = &steady.summary;
    let peak = &summary.peak_contact_pressure;
    let place = place_where(peak.value, in_film(peak, steady.bearing.width));
    let thinnest = summary.minimum_film_thickness.value;
    Some(Table {
        title: "Contact and friction",
        note: SHARE_NOTE.to_owned(),
        rows: pairs([
            ("Contact load", units.force.show(summary.contact_load)),
            ("of the load", share_text(steady.contact_load_share())),
            (
                "Peak asperity pressure",
                format!("{}{place}", units.pressure.show(peak.value)),
            ),
            (
                "Minimum film thickness over composite roughness",
                parameter(film_parameter(&steady.bearing, thinnest)),
            ),
            ("Friction power", units.power.show(summary.friction_power)),
            ("of it viscous", units.power.show(viscous(summary))),
            ("of it boundary", units.power.show(summary.boundary_power)),
        ]),
        ..Table::default()
    })
}

fn parameter(found: Option<f64>) -> String {
    significant(found.unwrap_or(f64::NAN))
}

/// The table of a cycle in which asperities may touch.
pub(super) fn cycle_table(cycle: &CycleResults, units: &Units) -> Option<Table> {
    if !cycle.bearing.finish.has_contact() {
        return None;
    }
    let at = |point: &CyclePoint| format!("at crank angle {}", angle(degrees(point.crank_angle)));
    let hardest = cycle.peak_contact_pressure();
    let peak = hardest.map(|point| {
        let peak = point.summary.peak_contact_pressure.value;
        format!(
            "{}{}",
            units.pressure.show(peak),
            place_where(peak, at(point))
        )
    });
    let place = hardest
        .map(|point| &point.summary.peak_contact_pressure)
        .filter(|peak| peak.value > 0.0)
        .map(|peak| in_film(peak, cycle.bearing.width));
    let most = cycle.largest(|point| point.summary.contact_load);
    // What asperities carry is often small beside the load.
    let largest = most.map_or(0.0, |point| point.summary.contact_load);
    let force = Units::choose(largest, 0.0, 0.0, 0.0, 0.0).force;
    let most =
        most.map(|point| format!("{}{}", force.show(largest), place_where(largest, at(point))));
    let thinnest = cycle
        .minimum_film_thickness()
        .and_then(|p| film_parameter(&cycle.bearing, p.summary.minimum_film_thickness.value));
    let mean = |value: fn(&FilmSummary) -> f64| cycle.mean(|point| value(&point.summary));
    let power = |value: fn(&FilmSummary) -> f64| units.power.show(mean(value));
    let none = || "n/a".to_owned();
    Some(Table {
        title: "Contact and friction over the cycle",
        note: SHARE_NOTE.to_owned(),
        rows: pairs([
            (
                "Mean contact load",
                force.show(mean(|summary| summary.contact_load)),
            ),
            ("of the mean load", share_text(cycle.contact_load_share())),
            ("Largest contact load", most.unwrap_or_else(none)),
            ("Peak asperity pressure", peak.unwrap_or_else(none)),
            ("its place", place.unwrap_or_else(none)),
            (
                "Minimum film thickness over composite roughness",
                parameter(thinnest),
            ),
            (
                "Mean friction power",
                power(|summary| summary.friction_power),
            ),
            ("of it viscous", power(viscous)),
            ("of it boundary", power(|summary| summary.boundary_power)),
        ]),
        ..Table::default()
    })
}

/// What asperities do over the cycle, for those in which they may touch.
pub(super) fn section(cycle: &CycleResults) -> Option<Section> {
    let figure = |kind, title, caption: &str| Figure {
        kind,
        title,
        caption: caption.to_owned(),
        size: "",
    };
    cycle.bearing.finish.has_contact().then(|| Section {
        id: "contact",
        title: "Where asperities touch",
        lead: String::new(),
        figures: vec![
            figure(
                "contact-load",
                "Contact load",
                "What asperities carry: the integral of their pressure without regard to its \
                 direction; beside the load, unless it is small against that.",
            ),
            figure(
                "friction-split",
                "Friction power",
                "Power of the turning surfaces: viscous in the oil that they shear, boundary where \
                 asperities rub.",
            ),
        ],
    })
}

/// The charts of that section, by their kind.
pub(super) fn charts(cycle: &CycleResults, units: &Units, detail: &Detail, charts: &mut Value) {
    if !cycle.bearing.finish.has_contact() {
        return;
    }
    let points = &cycle.orbit.points;
    let kept = thinned(points.len(), detail.curve_points);
    let series = |name: &str, factor: f64, value: fn(&CyclePoint) -> f64| Series {
        name: name.to_owned(),
        x: None,
        y: kept.iter().map(|&i| factor * value(&points[i])).collect(),
        mark: Mark::Line,
    };
    let chart = |title: &str, unit: &str, series| {
        let chart = Chart {
            x_title: "Crank angle [°]".to_owned(),
            y_title: format!("{title} [{unit}]"),
            y_range: None,
            series,
        };
        chart.data(detail)
    };
    let largest = |value: &dyn Fn(&CyclePoint) -> f64| cycle.largest(value).map_or(0.0, value);
    let contact = largest(&|p| p.summary.contact_load);
    let is_small = contact < SMALL * largest(&|p| magnitude(p.load));
    // A small load would lie on the axis beside a large one, and needs a unit of its own.
    let unit = if is_small {
        Units::choose(contact, 0.0, 0.0, 0.0, 0.0).force
    } else {
        units.force
    };
    let mut shown = vec![series("carried by asperities", unit.factor, |p| {
        p.summary.contact_load
    })];
    if !is_small {
        shown.push(series("load", unit.factor, |p| magnitude(p.load)));
    }
    charts["contact-load"] = chart("Load", unit.symbol, shown);
    let power = units.power.factor;
    charts["friction-split"] = chart(
        "Power",
        units.power.symbol,
        vec![
            series("friction", power, |p| p.summary.friction_power),
            series("boundary", power, |p| p.summary.boundary_power),
            series("viscous", power, |p| viscous(&p.summary)),
        ],
    );
}
