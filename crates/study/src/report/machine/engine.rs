//! What an engine gives and how it shakes, at each speed: gas, torque, orders, torsion.

use super::{largest, torsion};
use crate::report::chart::{Chart, Mark, Series};
use crate::report::detail::Detail;
use crate::report::figures::thinned;
use crate::report::format::{Unit, Units, significant};
use crate::report::page::{Cell, Figure, Section, Table};
use crate::results::machine::{MachineResults, SpeedResults};
use crate::results::{degrees, magnitude};
use serde_json::{Value, json};
use sommerfeld_engine::{Harmonic, Performance};

/// Points of all curves of one kind over the crank angle, over all speeds.
const POINTS: usize = 2880;
/// Orders above this one are not drawn.
const HIGHEST_ORDER: f64 = 12.0;
/// Orders smaller than this share of the largest bearing load (a moment: at an arm of 1 m) are
/// round-off of forces that balance.
const BALANCED: f64 = 1e-6;

const LITRE: Unit = Unit {
    symbol: "l",
    factor: 1e3,
};
const CUBIC_CENTIMETRE: Unit = Unit {
    symbol: "cm³",
    factor: 1e6,
};
/// Crank angles in the titles of axes.
pub(super) const CRANK_TITLE: &str = "Crank angle [°]";

/// Units of the engine's own numbers.
pub(super) fn units(machine: &MachineResults) -> Units {
    let all = || {
        machine
            .speeds
            .iter()
            .filter_map(|one| one.performance.as_ref())
    };
    let of = |value: fn(&Performance) -> f64| largest(all().map(value));
    Units::choose(
        of(|p| largest(p.shaking_force.iter().map(|force| magnitude(*force)))),
        of(|p| largest(p.gas_pressure.iter().copied())),
        of(|p| p.mean_torque),
        0.0,
        of(|p| largest(p.torque.iter().chain(&p.gas_torque).copied())),
    )
}

/// Figures of gas, torque and orders.
pub(super) fn sections(machine: &MachineResults) -> Vec<Section> {
    let mut sections = Vec::new();
    if machine.speeds.iter().any(|one| one.performance.is_some()) {
        sections.push(gas_and_torque());
        sections.push(orders());
    }
    sections.extend(torsion::section(machine));
    sections
}

fn figure(kind: &'static str, title: &'static str, caption: &str) -> Figure {
    Figure {
        kind,
        title,
        caption: caption.to_owned(),
        size: "",
    }
}

fn gas_and_torque() -> Section {
    Section {
        id: "gas",
        title: "Gas and torque",
        lead: "Crank angle 0 is the firing top dead centre of cylinder 1.".to_owned(),
        figures: vec![
            figure(
                "gas-pressure",
                "Gas pressure",
                "Absolute pressure in cylinder 1 over the working cycle.",
            ),
            figure(
                "pressure-volume",
                "Pressure over volume",
                "The area inside the loop is the work of the gas in one cycle. Volume: what piston \
                 1 has left behind since it stood nearest to the head.",
            ),
            figure(
                "torque",
                "Torque on the crankshaft",
                "In the sense of rotation. Total: gas and inertia of the moving parts; gas: of the \
                 gas alone; mean: what the engine gives before friction.",
            ),
            figure(
                "side-thrust",
                "Piston side thrust",
                "Force of the liner on piston 1, 90° ahead of the cylinder axis in the sense of \
                 rotation.",
            ),
        ],
    }
}

fn orders() -> Section {
    Section {
        id: "orders",
        title: "Orders",
        lead: "An order is a number of periods in one turn of the crankshaft; bars are amplitudes."
            .to_owned(),
        figures: vec![
            figure(
                "torque-orders",
                "Torque by order",
                "What twists the crankshaft and shakes the engine about it. The mean torque is no \
                 order.",
            ),
            figure(
                "force-orders",
                "Shaking force by order",
                "Force of the moving parts on the engine block without the gas, in the engine frame: \
                 x along the bisector of the banks, y across.",
            ),
            figure(
                "moment-orders",
                "Shaking moment by order",
                "Moment of that force about x and y through the middle of the main bearings.",
            ),
            figure(
                "shaking-force",
                "Shaking force over the cycle",
                "The force of the moving parts on the engine block without the gas.",
            ),
        ],
    }
}

/// The charts of each speed for the script.
pub(super) fn speeds(machine: &MachineResults, bearing_units: &Units) -> Value {
    let units = units(machine);
    let load = machine
        .all()
        .flat_map(|(_, _, one)| &one.cycle.orbit.points);
    let load = largest(load.map(|point| magnitude(point.load)));
    let speeds = machine.speeds.iter().map(|speed| {
        let mut charts = json!({});
        if let Some(performance) = &speed.performance {
            let points = (POINTS / machine.speeds.len()).clamp(180, 720);
            over_the_cycle(&mut charts, performance, [&units, bearing_units], points);
            by_order(&mut charts, performance, &units, BALANCED * load);
        }
        if let Some(response) = &speed.torsion {
            torsion::charts(&mut charts, response, speed);
        }
        json!({ "charts": charts })
    });
    speeds.collect()
}

/// A chart of curves over one axis.
pub(super) fn chart(x_title: String, y_title: String, series: Vec<Series>) -> Value {
    Chart {
        x_title,
        y_title,
        y_range: None,
        series,
    }
    .data(&Detail::of_many(1, [1, 1]))
}

/// The title of an axis with its unit.
pub(super) fn title(name: &str, unit: Unit) -> String {
    format!("{name} [{}]", unit.symbol)
}

/// Curves over one cycle, closed, in the units of the engine and of its bearings.
fn over_the_cycle(
    charts: &mut Value,
    performance: &Performance,
    [units, bearing_units]: [&Units; 2],
    points: usize,
) {
    let count = performance.crank_angles.len();
    let kept = thinned(count, points);
    let pick = |values: &[f64], factor: f64| -> Vec<f64> {
        let closed = kept.iter().chain([&0]);
        closed
            .map(|at| values.get(*at).map_or(f64::NAN, |value| value * factor))
            .collect()
    };
    let mut crank: Vec<f64> = kept
        .iter()
        .map(|&i| degrees(performance.crank_angles[i]))
        .collect();
    // The table ends one step before the cycle does.
    if let (Some(last), true) = (crank.last(), count > 1) {
        crank.push((last * count as f64 / (count - 1) as f64 * 1e9).round() / 1e9);
    }
    let series = |name: &str, y: Vec<f64>| Series {
        name: name.to_owned(),
        x: Some(crank.clone()),
        y,
        mark: Mark::Line,
    };
    let over =
        |name: &str, unit: Unit, series| chart(CRANK_TITLE.to_owned(), title(name, unit), series);
    let pressure = pick(&performance.gas_pressure, units.pressure.factor);
    charts["gas-pressure"] = over(
        "Absolute pressure",
        units.pressure,
        vec![series("cylinder 1", pressure.clone())],
    );
    if performance.displaced_volume.len() == count {
        let volume = pick(&performance.displaced_volume, CUBIC_CENTIMETRE.factor);
        charts["pressure-volume"] = chart(
            title("Displaced volume", CUBIC_CENTIMETRE),
            title("Absolute pressure", units.pressure),
            vec![Series {
                x: Some(volume),
                ..series("cylinder 1", pressure)
            }],
        );
    }
    let mean = vec![performance.mean_torque; count];
    let torque = |values: &[f64]| pick(values, units.torque.factor);
    charts["torque"] = over(
        "Torque",
        units.torque,
        vec![
            series("total", torque(&performance.torque)),
            series("gas", torque(&performance.gas_torque)),
            series("mean", torque(&mean)),
        ],
    );
    if let Some(thrust) = performance.side_thrust.first() {
        charts["side-thrust"] = over(
            "Side thrust",
            bearing_units.force,
            vec![series(
                "cylinder 1",
                pick(thrust, bearing_units.force.factor),
            )],
        );
    }
    let component = |axis: usize| -> Vec<f64> {
        let values: Vec<f64> = performance.shaking_force.iter().map(|f| f[axis]).collect();
        pick(&values, units.force.factor)
    };
    charts["shaking-force"] = over(
        "Shaking force",
        units.force,
        vec![series("x", component(0)), series("y", component(1))],
    );
}

fn by_order(charts: &mut Value, performance: &Performance, units: &Units, least: f64) {
    let moments = performance.moment_orders.iter().flatten().map(amplitude);
    let moment = Units::choose(0.0, 0.0, 0.0, 0.0, largest(moments)).torque;
    let [force_x, force_y] = &performance.force_orders;
    let [about_x, about_y] = &performance.moment_orders;
    let bars = |unit: Unit, of: &[(&str, &[Harmonic])]| order_bars("Amplitude", unit, of, least);
    charts["torque-orders"] = bars(units.torque, &[("torque", &performance.torque_orders)]);
    charts["force-orders"] = bars(units.force, &[("x", force_x), ("y", force_y)]);
    charts["moment-orders"] = bars(moment, &[("about x", about_x), ("about y", about_y)]);
}

/// Amplitude of a harmonic.
pub(super) fn amplitude(harmonic: &Harmonic) -> f64 {
    harmonic.cos.hypot(harmonic.sin)
}

/// Bars over the orders; a sentence where all of them are below `least` (SI).
pub(super) fn order_bars(name: &str, unit: Unit, of: &[(&str, &[Harmonic])], least: f64) -> Value {
    let drawn = |harmonic: &&Harmonic| harmonic.order > 0.0 && harmonic.order <= HIGHEST_ORDER;
    let all = of
        .iter()
        .flat_map(|(_, orders)| orders.iter())
        .filter(drawn);
    if largest(all.map(amplitude)) <= least {
        return json!({
            "nothing": "Balanced: no order is more than round-off of forces that cancel.",
        });
    }
    let series = of.iter().map(|(name, orders)| {
        let shown: Vec<&Harmonic> = orders.iter().filter(drawn).collect();
        Series {
            name: (*name).to_owned(),
            x: Some(shown.iter().map(|harmonic| harmonic.order).collect()),
            y: shown
                .iter()
                .map(|harmonic| amplitude(harmonic) * unit.factor)
                .collect(),
            mark: Mark::Bars,
        }
    });
    chart("Order".to_owned(), title(name, unit), series.collect())
}

/// Torque, work and friction at one speed.
pub(super) fn table(speed: &SpeedResults, units: &Units) -> Option<Table> {
    let performance = speed.performance.as_ref()?;
    let imep = performance.indicated_mean_effective_pressure;
    let mean_pressure = Units::choose(0.0, imep, 0.0, 0.0, 0.0).pressure;
    let power = speed.speed * performance.mean_torque;
    let power_unit = Units::choose(0.0, 0.0, power, 0.0, 0.0).power;
    let peak = performance
        .gas_pressure
        .iter()
        .zip(&performance.crank_angles)
        .filter(|(pressure, _)| pressure.is_finite())
        .max_by(|a, b| a.0.total_cmp(b.0));
    let mut rows = vec![
        ("Swept volume", LITRE.show(performance.swept_volume)),
        (
            "Peak gas pressure, cylinder 1 (absolute)",
            peak.map_or("n/a".to_owned(), |(pressure, crank)| {
                let at = crate::report::format::angle(degrees(*crank));
                format!("{} at {at}", units.pressure.show(*pressure))
            }),
        ),
        (
            "Indicated mean effective pressure",
            mean_pressure.show(imep),
        ),
        ("Mean torque", units.torque.show(performance.mean_torque)),
        (
            "Largest torque",
            units
                .torque
                .show(performance.torque.iter().copied().fold(f64::NAN, f64::max)),
        ),
        ("Indicated power", power_unit.show(power)),
    ];
    if let Some(friction) = speed.friction_mean_effective_pressure {
        let unit = Units::choose(0.0, friction, 0.0, 0.0, 0.0).pressure;
        let share = 100.0 * friction / imep;
        rows.push((
            "Friction mean effective pressure of the bearings",
            unit.show(friction),
        ));
        rows.push(("of the indicated one", format!("{} %", significant(share))));
    }
    Some(Table {
        title: "Engine",
        note: "Mean effective pressure: work of one cycle over the swept volume; of the bearings, the \
               work lost in all their films."
            .to_owned(),
        rows: rows
            .into_iter()
            .map(|(label, value)| vec![Cell::text(label), Cell::number(value)])
            .collect(),
        ..Table::default()
    })
}
