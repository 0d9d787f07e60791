//! The report of a load cycle: key figures, orbit, curves over crank angle, maps, convergence.

use super::format::{MICROMETRE, Unit, Units, angle, significant};
use super::page::{Card, Figure, Page, badge, checks, error};
use super::{cycle_tables, figures};
use crate::limits::Quantity;
use crate::results::{CycleField, CycleResults, Header, degrees, magnitude, specific_load};
use serde_json::{Value, json};
use sommerfeld_bearing::CyclePoint;

/// Fills cards, figures and tables; returns the data of the figures.
pub(super) fn fill(page: &mut Page, header: &Header, cycle: &CycleResults) -> Value {
    let units = units(cycle);
    page.cards = cards(header, cycle, &units);
    page.tables = cycle_tables::all(header, cycle, &units);
    if cycle.orbit.points.is_empty() {
        return json!({});
    }
    page.figures = figures_of(cycle);
    let worst = cycle
        .fields
        .as_ref()
        .and_then(|fields| Some((&fields.worst, nearest(cycle, fields.worst.crank_angle)?)));
    json!({
        "units": figures::unit_symbols(&units),
        "cycle": figures::cycle_data(header, cycle, &units),
        "field": worst.map(|(worst, point)| {
            figures::field_data(&worst.field, &cycle.bearing, &point.state, &point.summary, &units)
        }),
    })
}

fn units(cycle: &CycleResults) -> Units {
    let largest = |value: &dyn Fn(&CyclePoint) -> f64| {
        cycle
            .largest(|point| value(point).abs())
            .map_or(f64::NAN, |point| value(point).abs())
    };
    Units::choose(
        largest(&|p| magnitude(p.load)),
        largest(&|p| p.summary.peak_film_pressure.value),
        largest(&|p| p.summary.power_loss()),
        largest(&side_flow),
        largest(&|p| p.reaction.friction_torque_journal),
    )
}

/// What leaves at both ends, m3/s.
pub(super) fn side_flow(point: &CyclePoint) -> f64 {
    point.summary.side_flow[0] + point.summary.side_flow[1]
}

/// The point of the orbit at a crank angle, rad.
fn nearest(cycle: &CycleResults, crank_angle: f64) -> Option<&CyclePoint> {
    cycle.largest(|point| -(point.crank_angle - crank_angle).abs())
}

/// A card for the value of one point: its badge is the point's own failure before the run's.
fn point_card(
    header: &Header,
    label: &'static str,
    point: Option<&CyclePoint>,
    value: impl Fn(&CyclePoint) -> f64,
    unit: Unit,
) -> Card {
    Card {
        label,
        value: unit.number(point.map_or(f64::NAN, &value)),
        unit: unit.symbol,
        detail: point.map_or_else(String::new, |point| {
            format!("at crank angle {}", angle(degrees(point.crank_angle)))
        }),
        badge: point
            .and_then(|point| badge(point.outcome))
            .or(badge(header.status)),
        ..Card::default()
    }
}

fn cards(header: &Header, cycle: &CycleResults, units: &Units) -> Vec<Card> {
    let mean_card = |label, value: f64, unit: Unit, key, detail| Card {
        label,
        value: unit.number(value),
        unit: unit.symbol,
        error: error(header, key, unit),
        detail,
        badge: badge(header.status),
        ..Card::default()
    };
    let thickness = Card {
        error: error(header, "minimum_film_thickness_m", MICROMETRE),
        checks: checks(header, Quantity::MinimumFilmThickness, MICROMETRE),
        ..point_card(
            header,
            "Minimum film thickness",
            cycle.minimum_film_thickness(),
            |p| p.summary.minimum_film_thickness.value,
            MICROMETRE,
        )
    };
    let pressure = Card {
        error: error(header, "peak_film_pressure_pa", units.pressure),
        checks: checks(header, Quantity::PeakFilmPressure, units.pressure),
        ..point_card(
            header,
            "Peak film pressure",
            cycle.peak_film_pressure(),
            |p| p.summary.peak_film_pressure.value,
            units.pressure,
        )
    };
    let load = Card {
        checks: checks(header, Quantity::MaximumSpecificLoad, units.pressure),
        ..point_card(
            header,
            "Maximum specific load F/(B D)",
            cycle.maximum_load(),
            |p| specific_load(&cycle.bearing, p.load),
            units.pressure,
        )
    };
    let power = cycle.mean(|p| p.summary.power_loss());
    let friction = cycle.mean(|p| p.summary.friction_power);
    let squeeze = cycle.mean(|p| p.summary.squeeze_power);
    let parts = format!(
        "friction {}, squeeze {}",
        units.power.show(friction),
        units.power.show(squeeze)
    );
    let side = cycle.mean(side_flow);
    let feed = cycle.mean(|p| p.summary.feed_flow);
    let flow = units.flow;
    vec![
        thickness,
        pressure,
        load,
        Card {
            checks: checks(header, Quantity::PowerLoss, units.power),
            ..mean_card(
                "Mean power loss",
                power,
                units.power,
                "mean_power_loss_w",
                parts,
            )
        },
        mean_card(
            "Mean side flow",
            side,
            flow,
            "mean_side_flow_m3_s",
            per_minute(side),
        ),
        mean_card(
            "Mean feed flow",
            feed,
            flow,
            "mean_feed_flow_m3_s",
            per_minute(feed),
        ),
    ]
}

fn per_minute(flow: f64) -> String {
    format!("{} l/min", significant(flow * 6e4))
}

fn figures_of(cycle: &CycleResults) -> Vec<Figure> {
    let failed = if cycle.not_converged().next().is_some() {
        " Crosses: steps that did not converge."
    } else {
        ""
    };
    let figure = |kind, title, caption: &str| Figure {
        kind,
        title,
        caption: caption.to_owned(),
        size: "",
    };
    let mut list = vec![
        figure(
            "load-polar",
            "Load on the journal",
            "Tip of the load vector in the shell frame over one period, with its crank angles.",
        ),
        figure(
            "orbit",
            "Journal orbit",
            &format!(
                "Path of the journal centre over the radial clearance. On the outer circle the \
                 surfaces would touch.{failed}"
            ),
        ),
        figure(
            "thickness",
            "Minimum film thickness",
            &format!("Thinnest film anywhere in the bearing at each crank angle.{failed}"),
        ),
        figure(
            "pressure",
            "Peak film pressure",
            "Highest film pressure (gauge) anywhere in the bearing at each crank angle.",
        ),
        figure(
            "power",
            "Power loss",
            "Power lost in the film: friction of the turning surfaces and squeeze of the moving \
             journal.",
        ),
        figure(
            "flow",
            "Oil flow",
            "Oil that leaves at both ends, that enters through feeds, and that the film stores. \
             Feed = side + storage where the closure conserves oil.",
        ),
        figure(
            "eccentricity",
            "Relative eccentricity",
            &format!("Distance of the centres over the radial clearance.{failed}"),
        ),
        figure(
            "load",
            "Load",
            "Components of the load on the journal in the shell frame, and its magnitude.",
        ),
    ];
    if cycle
        .orbit
        .points
        .iter()
        .any(|p| p.state.tilt != [0.0, 0.0])
    {
        list.push(figure(
            "tilt",
            "Tilt",
            "Rotation vector of the journal axis against the shell axis.",
        ));
    }
    if let Some(fields) = &cycle.fields {
        list.extend(maps(cycle, &fields.worst));
    }
    list
}

fn maps(cycle: &CycleResults, worst: &CycleField) -> [Figure; 2] {
    let is_at = |point: Option<&CyclePoint>| {
        point.is_some_and(|point| (point.crank_angle - worst.crank_angle).abs() < 1e-9)
    };
    let instant = angle(degrees(worst.crank_angle));
    let reason = if is_at(cycle.minimum_film_thickness()) {
        ", where the film is thinnest"
    } else if is_at(cycle.peak_film_pressure()) {
        ", where the film pressure peaks"
    } else {
        ""
    };
    map_figures(&format!("At crank angle {instant}{reason}. "))
}

/// The two maps of a film, with an opening of their captions that says when.
pub(super) fn map_figures(when: &str) -> [Figure; 2] {
    [
        Figure {
            kind: "pressure-map",
            title: "Film pressure",
            caption: format!(
                "{when}Bearing surface unrolled, cell by cell as computed, angle from +X of the \
                 shell frame. Ring: peak pressure; cross: thinnest film; outlines: feeds."
            ),
            size: "wide",
        },
        Figure {
            kind: "fraction-map",
            title: "Film fraction",
            caption: format!(
                "{when}1 where oil fills the gap, below 1 where the film is ruptured. \
                 Cross: thinnest film; outlines: feeds."
            ),
            size: "wide",
        },
    ]
}
