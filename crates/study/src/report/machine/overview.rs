//! The page of the machine as a whole: the worst bearing first, every bearing in a table, all of them
//! over the speed.

use super::bearing::model_words;
use super::engine::{self, chart, title};
use super::{AtSpeed, MachinePage, largest, own_header, speed_label, torsion};
use crate::limits::{Quantity, Verdict};
use crate::report::chart::{Mark, Series};
use crate::report::cycle::side_flow;
use crate::report::format::{MICROMETRE, Unit, Units, angle, plain_number};
use crate::report::page::{Card, Cell, Figure, Section, Table, badge, checks, exact, headline};
use crate::report::{heat, wear};
use crate::results::machine::{BearingResults, MachineResults, SpeedResults};
use crate::results::{Header, degrees, place, rpm};
use serde_json::{Value, json};
use sommerfeld_film::Outcome;

/// The page; its figures are drawn from [`data`] and [`engine::speeds`].
pub(super) fn page(
    header: &Header,
    machine: &MachineResults,
    units: &Units,
    is_engine: bool,
) -> MachinePage {
    let (id, name) = if is_engine {
        ("engine", "Engine")
    } else {
        ("shaft", "Shaft")
    };
    let mut sections = vec![bearings(machine)];
    sections.extend(engine::sections(machine));
    MachinePage {
        id: id.to_owned(),
        name: name.to_owned(),
        heading: String::new(),
        subject: String::new(),
        lead: lead(machine, is_engine),
        flag: "",
        film: None,
        sections,
        at: machine
            .speeds
            .iter()
            .map(|speed| at_speed(header, speed, units, &engine::units(machine)))
            .collect(),
    }
}

/// Which model the loads are of, and whether the other one is shown beside it.
fn lead(machine: &MachineResults, is_engine: bool) -> String {
    if machine.load_model.is_empty() {
        return String::new();
    }
    let of = if is_engine {
        "main bearings"
    } else {
        "bearings"
    };
    let both = if machine
        .all()
        .any(|(_, _, bearing)| bearing.determinate_load.is_some())
    {
        " Their pages show the load that hinges at the mains would give (statically determinate) \
         beside it."
    } else {
        ""
    };
    format!("Loads of the {of}: {}.{both}", model_words(machine))
}

fn bearings(machine: &MachineResults) -> Section {
    let many = machine.speeds.len() > 1;
    let over = if many {
        "Every bearing at every speed; an exclamation mark: a limit is exceeded. A click opens the bearing at that speed."
    } else {
        "Every bearing; a click opens it."
    };
    let figure = |kind, title, caption: String, size| Figure {
        kind,
        title,
        caption,
        size,
    };
    let mut figures = vec![
        figure(
            "overview-thickness",
            "Minimum film thickness",
            format!("Thinnest film over the cycle. {over}"),
            "",
        ),
        figure(
            "overview-pressure",
            "Peak film pressure",
            format!("Highest film pressure (gauge) over the cycle. {over}"),
            "",
        ),
        figure(
            "polars",
            "Loads of all bearings",
            "Tip of the load vector on the journal in the frame of the shell, +X to the right, +Y up, \
             all on one scale; dot: the film is thinnest there. A click opens the bearing."
                .to_owned(),
            "wide",
        ),
        figure(
            "overview-friction",
            "Power lost in the bearings",
            if many {
                "Mean over the cycle, friction and squeeze, one bearing on the other.".to_owned()
            } else {
                "Mean over the cycle, friction and squeeze.".to_owned()
            },
            if many { "" } else { "wide" },
        ),
    ];
    if many {
        figures.push(figure(
            "friction-pressure",
            "Friction mean effective pressure",
            "Work lost in the films of all bearings in one cycle, over the swept volume."
                .to_owned(),
            "",
        ));
    }
    if machine
        .speeds
        .iter()
        .all(|one| one.friction_mean_effective_pressure.is_none())
    {
        figures.retain(|figure| figure.kind != "friction-pressure");
        if let Some(last) = figures.last_mut() {
            last.size = "wide";
        }
    }
    Section {
        id: "bearings",
        title: "Bearings",
        lead: String::new(),
        figures,
    }
}

/// The value of each bearing that a limit judges, and the worst of them.
fn worst_at(speed: &SpeedResults, quantity: Quantity) -> Option<&BearingResults> {
    let value = |bearing: &BearingResults| {
        let value = bearing.cycle.limited_value(quantity)?;
        value.is_finite().then_some(match quantity.side() {
            crate::limits::Side::AtLeast => -value,
            crate::limits::Side::AtMost => value,
        })
    };
    speed
        .bearings
        .iter()
        .filter_map(|bearing| Some((value(bearing)?, bearing)))
        .reduce(|worst, next| if next.0 > worst.0 { next } else { worst })
        .map(|(_, bearing)| bearing)
}

/// Sum over the bearings of a mean over the cycle.
fn total(speed: &SpeedResults, value: impl Fn(&BearingResults) -> f64) -> f64 {
    speed.bearings.iter().map(value).sum()
}

fn mean_loss(bearing: &BearingResults) -> f64 {
    bearing.cycle.mean(|point| point.summary.power_loss())
}

fn mean_side_flow(bearing: &BearingResults) -> f64 {
    bearing.cycle.mean(side_flow)
}

fn at_speed(header: &Header, speed: &SpeedResults, units: &Units, own: &Units) -> AtSpeed {
    let mut tables = vec![bearing_table(header, speed, units)];
    tables.extend(wear::machine_table(speed));
    tables.extend(heat::machine_table(speed, units));
    tables.extend(engine::table(speed, own));
    tables.extend(torsion::tables(speed));
    AtSpeed {
        speed: speed_label(speed),
        status: headline(speed.outcome),
        good: speed.outcome == Outcome::Converged,
        checks: Vec::new(),
        cards: cards(header, speed, units),
        note: String::new(),
        tables,
    }
}

/// The worst bearing of each limited quantity at a speed, and the totals.
fn cards(header: &Header, speed: &SpeedResults, units: &Units) -> Vec<Card> {
    let worst = |label, key, quantity, unit: Unit, at: &dyn Fn(&BearingResults) -> Option<f64>| {
        let Some(bearing) = worst_at(speed, quantity) else {
            return Card {
                label,
                key,
                value: "n/a".to_owned(),
                ..Card::default()
            };
        };
        let value = bearing.cycle.limited_value(quantity).unwrap_or(f64::NAN);
        let crank = at(bearing).map_or_else(String::new, |crank| {
            format!(", crank angle {}", angle(degrees(crank)))
        });
        let own = own_header(header, bearing);
        Card {
            label,
            key,
            exact: exact(value),
            value: unit.number(value),
            unit: unit.symbol,
            detail: format!("{}{crank}", bearing.name),
            badge: badge(own.status),
            checks: checks(&own, quantity, unit),
            ..Card::default()
        }
    };
    let sum = |label, key, unit: Unit, value: f64, detail: String| Card {
        label,
        key,
        exact: exact(value),
        value: unit.number(value),
        unit: unit.symbol,
        detail,
        badge: badge(speed.outcome),
        ..Card::default()
    };
    let loss = total(speed, mean_loss);
    let flow = total(speed, mean_side_flow);
    let sums = Units::choose(0.0, 0.0, loss, flow, 0.0);
    let mut cards = vec![
        worst(
            "Minimum film thickness",
            "minimum_film_thickness_m",
            Quantity::MinimumFilmThickness,
            MICROMETRE,
            &|one| one.cycle.minimum_film_thickness().map(|p| p.crank_angle),
        ),
        worst(
            "Peak film pressure",
            "peak_film_pressure_pa",
            Quantity::PeakFilmPressure,
            units.pressure,
            &|one| one.cycle.peak_film_pressure().map(|p| p.crank_angle),
        ),
        worst(
            "Maximum specific load F/(B D)",
            "maximum_specific_load_pa",
            Quantity::MaximumSpecificLoad,
            units.pressure,
            &|one| one.cycle.maximum_load().map(|p| p.crank_angle),
        ),
        sum(
            "Power lost in all bearings",
            "total_power_loss_w",
            sums.power,
            loss,
            format!("{} bearings, mean over the cycle", speed.bearings.len()),
        ),
        sum(
            "Side flow of all bearings",
            "total_side_flow_m3_s",
            sums.flow,
            flow,
            "mean over the cycle".to_owned(),
        ),
    ];
    if let Some(friction) = speed.friction_mean_effective_pressure {
        let unit = Units::choose(0.0, friction, 0.0, 0.0, 0.0).pressure;
        cards.push(sum(
            "Friction mean effective pressure",
            "friction_mean_effective_pressure_pa",
            unit,
            friction,
            "of all bearings".to_owned(),
        ));
    }
    cards
}

/// A number with the verdict of its limit.
fn judged(own: &Header, quantity: Quantity, unit: Unit, value: f64) -> Cell {
    let text = unit.show(value);
    let mut verdicts = own
        .limits
        .iter()
        .filter(|check| check.limit.quantity == quantity)
        .map(|check| check.verdict)
        .peekable();
    if verdicts.peek().is_none() {
        return Cell::number(text);
    }
    let verdicts: Vec<Verdict> = verdicts.collect();
    let (word, class) = if verdicts.contains(&Verdict::Exceeded) {
        ("exceeded", "number bad")
    } else if verdicts.contains(&Verdict::NotEvaluated) {
        ("not evaluated", "number bad")
    } else {
        ("OK", "number good")
    };
    Cell {
        text: format!("{text} {word}"),
        class,
    }
}

/// Every bearing at one speed.
fn bearing_table(header: &Header, speed: &SpeedResults, units: &Units) -> Table {
    let crank = |point: Option<f64>| {
        Cell::number(point.map_or("n/a".to_owned(), |crank| angle(degrees(crank))))
    };
    let mut rows: Vec<Vec<Cell>> = speed
        .bearings
        .iter()
        .map(|bearing| {
            let own = own_header(header, bearing);
            let cycle = &bearing.cycle;
            let value = |quantity| cycle.limited_value(quantity).unwrap_or(f64::NAN);
            let thinnest = cycle.minimum_film_thickness();
            let highest = cycle.peak_film_pressure();
            let number = |quantity, unit| judged(&own, quantity, unit, value(quantity));
            vec![
                Cell::text(bearing.name.clone()),
                number(Quantity::MinimumFilmThickness, MICROMETRE),
                crank(thinnest.map(|p| p.crank_angle)),
                Cell::number(thinnest.map_or_else(String::new, |p| {
                    let (around, along) = place(&p.summary.minimum_film_thickness);
                    format!("{}, {} mm", angle(around), plain_number(along))
                })),
                number(Quantity::PeakFilmPressure, units.pressure),
                crank(highest.map(|p| p.crank_angle)),
                number(Quantity::MaximumSpecificLoad, units.pressure),
                Cell::number(units.power.show(cycle.mean(|p| p.summary.friction_power))),
                number(Quantity::PowerLoss, units.power),
                Cell::number(units.flow.show(mean_side_flow(bearing))),
                Cell::outcome(own.status),
            ]
        })
        .collect();
    let sums = |value: f64, unit: Unit| Cell::number(unit.show(value));
    let mut sum = vec![Cell::default(); 11];
    sum[0] = Cell::text("All");
    let friction = |one: &BearingResults| one.cycle.mean(|p| p.summary.friction_power);
    sum[7] = sums(total(speed, friction), units.power);
    sum[8] = sums(total(speed, mean_loss), units.power);
    sum[9] = sums(total(speed, mean_side_flow), units.flow);
    sum[10] = Cell::outcome(speed.outcome);
    rows.push(sum);
    Table {
        title: "Every bearing",
        note: "Where: bearing angle, axial position from the mid-plane. Power and flow: means over the cycle; power loss is friction and squeeze together. \
               Specific load: largest load over width times diameter. A colour and a word tell \
               whether a limit of the study is kept."
            .to_owned(),
        columns: vec![
            "Bearing",
            "Minimum film",
            "Crank angle",
            "Where",
            "Peak pressure",
            "Crank angle",
            "Specific load",
            "Friction power",
            "Power loss",
            "Side flow",
            "Status",
        ],
        rows,
        size: "wide",
    }
}

/// All bearings over all speeds, for the script.
pub(super) fn data(
    header: &Header,
    machine: &MachineResults,
    units: &Units,
    ids: &[String],
    is_engine: bool,
) -> Value {
    let bearings = machine.fullest();
    let named: Value = bearings
        .iter()
        .zip(ids)
        .map(|(bearing, id)| json!({"name": bearing.name, "id": id, "role": bearing.role.name()}))
        .collect();
    let values = |unit: Unit, value: &dyn Fn(&BearingResults) -> f64| -> Value {
        let rows = (0..bearings.len()).map(|number| -> Value {
            let row = machine.speeds.iter().map(|speed| {
                let value = speed.bearings.get(number).map_or(f64::NAN, value);
                json!({
                    "value": crate::report::figures::short(value * unit.factor),
                    "text": unit.show(value),
                })
            });
            row.collect()
        });
        json!({ "unit": unit.symbol, "rows": rows.collect::<Value>() })
    };
    let judged = |unit: Unit, quantity: Quantity| {
        let mut found = values(unit, &|one| {
            one.cycle.limited_value(quantity).unwrap_or(f64::NAN)
        });
        found["limits"] = crate::report::figures::limits(header, quantity, unit);
        for (number, row) in found["rows"]
            .as_array_mut()
            .into_iter()
            .flatten()
            .enumerate()
        {
            let cells = row.as_array_mut().into_iter().flatten();
            for (cell, speed) in cells.zip(&machine.speeds) {
                let own = speed
                    .bearings
                    .get(number)
                    .map(|one| own_header(header, one));
                let is_bad = own.is_some_and(|own| {
                    let mut limits = own.limits.iter();
                    limits.any(|check| {
                        check.limit.quantity == quantity && check.verdict == Verdict::Exceeded
                    })
                });
                cell["bad"] = json!(is_bad);
            }
        }
        found
    };
    let mut charts = json!({});
    if let Some(pressure) = friction_pressure(machine) {
        charts["friction-pressure"] = pressure;
    }
    if let Some(orders) = torsion::over_speed(machine) {
        charts["order-amplitudes"] = orders;
    }
    json!({
        "page": if is_engine { "engine" } else { "shaft" },
        "speeds": machine.speeds.iter().map(speed_label).collect::<Value>(),
        "rpm": machine.speeds.iter().map(|one| rpm(one.speed)).collect::<Value>(),
        "bearings": named,
        "force": units.force.symbol,
        "thickness": judged(MICROMETRE, Quantity::MinimumFilmThickness),
        "pressure": judged(units.pressure, Quantity::PeakFilmPressure),
        "friction": values(units.power, &mean_loss),
        "charts": charts,
    })
}

/// Friction mean effective pressure over the speed.
fn friction_pressure(machine: &MachineResults) -> Option<Value> {
    let found: Vec<(f64, f64)> = machine
        .speeds
        .iter()
        .filter_map(|one| Some((rpm(one.speed), one.friction_mean_effective_pressure?)))
        .collect();
    if found.len() < 2 {
        return None;
    }
    let unit = Units::choose(0.0, largest(found.iter().map(|one| one.1)), 0.0, 0.0, 0.0).pressure;
    let series = Series {
        name: "all bearings".to_owned(),
        x: Some(found.iter().map(|one| one.0).collect()),
        y: found.iter().map(|one| one.1 * unit.factor).collect(),
        mark: Mark::Line,
    };
    Some(chart(
        "Speed [rpm]".to_owned(),
        title("Mean effective pressure", unit),
        vec![series],
    ))
}
