//! Torsional vibration of the crankshaft: twist over the cycle, orders, natural frequencies, heat.

use super::engine::{CRANK_TITLE, amplitude, chart, order_bars, title};
use super::largest;
use crate::report::chart::{Mark, Series};
use crate::report::format::{MILLIRADIAN, Units, significant};
use crate::report::page::{Cell, Figure, Section, Table};
use crate::results::machine::{MachineResults, SpeedResults};
use crate::results::{degrees, rpm};
use serde_json::Value;
use sommerfeld_engine::{TorsionResponse, Twist};

/// Points of a curve over the crank angle.
const POINTS: usize = 360;
/// So many orders are drawn over the speed: those with the largest amplitudes.
const DRAWN_ORDERS: usize = 5;

/// Figures of the torsion, where any speed has it.
pub(super) fn section(machine: &MachineResults) -> Option<Section> {
    if machine.speeds.iter().all(|one| one.torsion.is_none()) {
        return None;
    }
    let figure = |kind, title, caption: &str| Figure {
        kind,
        title,
        caption: caption.to_owned(),
        size: "",
    };
    let mut figures = vec![
        figure(
            "twist",
            "Twist over the cycle",
            "How far the ends of the shaft lead or lag behind an evenly turning one: free end \
             (nose) and the last disc (flywheel).",
        ),
        figure(
            "twist-orders",
            "Twist of the free end by order",
            "Amplitude of each order at the nose, relative to an evenly turning shaft.",
        ),
    ];
    if machine.speeds.len() > 1 {
        figures.push(Figure {
            size: "wide",
            ..figure(
                "order-amplitudes",
                "Orders of the free end over speed",
                "The orders with the largest amplitudes. An order peaks where its frequency, order \
                 times speed, meets a natural frequency.",
            )
        });
    }
    Some(Section {
        id: "torsion",
        title: "Torsion",
        lead: "The crankshaft as a chain of discs and springs under the orders of its torques."
            .to_owned(),
        figures,
    })
}

/// The charts of one speed.
pub(super) fn charts(charts: &mut Value, response: &TorsionResponse, speed: &SpeedResults) {
    let (Some(nose), Some(flywheel)) = (response.twists.first(), response.twists.last()) else {
        return;
    };
    let period = speed
        .bearings
        .iter()
        .map(|bearing| bearing.load.period)
        .fold(0.0, f64::max);
    let crank: Vec<f64> = (0..=POINTS)
        .map(|i| period * i as f64 / POINTS as f64)
        .collect();
    let series = |name: &str, twist: &Twist| Series {
        name: name.to_owned(),
        x: Some(crank.iter().copied().map(degrees).collect()),
        y: crank
            .iter()
            .map(|angle| twist.at(*angle)[0] * MILLIRADIAN.factor)
            .collect(),
        mark: Mark::Line,
    };
    let both = vec![series("free end", nose), series("flywheel end", flywheel)];
    charts["twist"] = chart(CRANK_TITLE.to_owned(), title("Twist", MILLIRADIAN), both);
    let orders: [(&str, &[_]); 1] = [("free end", &nose.harmonics)];
    charts["twist-orders"] = order_bars("Amplitude", MILLIRADIAN, &orders, 0.0);
}

/// Amplitude of an order of the free end; 0 where it has none.
fn of_order(speed: &SpeedResults, order: f64) -> Option<f64> {
    let nose = speed.torsion.as_ref()?.twists.first()?;
    let found = nose
        .harmonics
        .iter()
        .find(|one| (one.order - order).abs() < 1e-6);
    Some(found.map_or(0.0, amplitude))
}

/// The largest orders of the free end over the speed.
pub(super) fn over_speed(machine: &MachineResults) -> Option<Value> {
    let noses = machine
        .speeds
        .iter()
        .filter_map(|speed| speed.torsion.as_ref()?.twists.first());
    let mut orders: Vec<f64> = noses
        .flat_map(|nose| nose.harmonics.iter().map(|one| one.order))
        .filter(|order| *order > 0.0)
        .collect();
    orders.sort_by(f64::total_cmp);
    orders.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    if orders.is_empty() || machine.speeds.len() < 2 {
        return None;
    }
    let peak = |order: f64| largest(machine.speeds.iter().filter_map(|one| of_order(one, order)));
    orders.sort_by(|a, b| peak(*b).total_cmp(&peak(*a)));
    orders.truncate(DRAWN_ORDERS);
    let series = orders.iter().map(|&order| Series {
        name: format!("order {order}"),
        x: Some(machine.speeds.iter().map(|one| rpm(one.speed)).collect()),
        y: machine
            .speeds
            .iter()
            .map(|one| of_order(one, order).map_or(f64::NAN, |a| a * MILLIRADIAN.factor))
            .collect(),
        mark: Mark::Line,
    });
    Some(chart(
        "Speed [rpm]".to_owned(),
        title("Amplitude", MILLIRADIAN),
        series.collect(),
    ))
}

/// Natural frequencies, and torque and heat of each link.
pub(super) fn tables(speed: &SpeedResults) -> Vec<Table> {
    let Some(response) = &speed.torsion else {
        return Vec::new();
    };
    let turns = speed.speed / std::f64::consts::TAU;
    let frequencies = response
        .natural_frequencies
        .iter()
        .enumerate()
        .map(|(mode, frequency)| {
            vec![
                Cell::number(mode.to_string()),
                Cell::number(format!("{} Hz", significant(*frequency))),
                Cell::number(if mode == 0 {
                    "turns as a whole".to_owned()
                } else {
                    significant(frequency / turns)
                }),
            ]
        });
    let frequencies = Table {
        title: "Natural frequencies of the torsion",
        note:
            "Of the undamped chain of discs. Order: the one that meets the frequency at this speed."
                .to_owned(),
        columns: vec!["Mode", "Frequency", "Order at this speed"],
        rows: frequencies.collect(),
        ..Table::default()
    };
    let peaks: Vec<f64> = response
        .link_torques
        .iter()
        .map(|link| peak(link, speed))
        .collect();
    let unit = Units::choose(0.0, 0.0, 0.0, 0.0, largest(peaks.iter().copied())).torque;
    let heat = Units::choose(
        0.0,
        0.0,
        largest(response.link_heat.iter().copied()),
        0.0,
        0.0,
    )
    .power;
    let links = peaks.iter().enumerate().map(|(link, torque)| {
        let lost = response.link_heat.get(link).copied().unwrap_or(f64::NAN);
        vec![
            Cell::text(format!("disc {} to disc {}", link + 1, link + 2)),
            Cell::number(unit.show(*torque)),
            Cell::number(heat.show(lost)),
        ]
    });
    let links = Table {
        title: "Links of the torsional chain",
        note:
            "Discs from the free end. Largest alternating torque over the cycle, without the mean; \
               heat: what a damper there must give off."
                .to_owned(),
        columns: vec!["Link", "Torque", "Heat"],
        rows: links.collect(),
        ..Table::default()
    };
    vec![frequencies, links]
}

/// Largest magnitude of a twist or torque over one cycle without its mean, which is order 0.
fn peak(twist: &Twist, speed: &SpeedResults) -> f64 {
    let periods = speed.bearings.iter().map(|bearing| bearing.load.period);
    let period = periods.fold(0.0, f64::max);
    let alternating = |angle: f64| -> f64 {
        let orders = twist.harmonics.iter().filter(|one| one.order > 0.0);
        orders.map(|one| one.at(angle)[0]).sum()
    };
    largest((0..POINTS).map(|i| alternating(period * i as f64 / POINTS as f64)))
}
