//! How warm the film is, and where its heat goes.

use super::format::{MICROMETRE, Unit, Units, celsius, size};
use super::page::{Card, Cell, Table, badge, exact, last_iterates};
use crate::results::machine::SpeedResults;
use crate::results::{Header, HeatResults};

const DEGREE: &str = "°C";

/// Two cards, for pages of bearings that find their temperature.
pub(super) fn cards(header: &Header) -> Vec<Card> {
    let Some(heat) = &header.heat else {
        return Vec::new();
    };
    let card = |label, key, kelvin: f64, detail| Card {
        label,
        key,
        exact: exact(kelvin - 273.15),
        value: celsius(kelvin),
        unit: DEGREE,
        detail,
        badge: badge(header.status),
        ..Card::default()
    };
    let shown = |kelvin: f64| format!("{} {DEGREE}", celsius(kelvin));
    let (label, detail) = match &heat.field {
        Some(field) => (
            "Mean temperature of the film",
            format!("hottest {}", shown(field.hottest)),
        ),
        None => (
            "Effective temperature of the film",
            format!("supply {}", shown(heat.supply_temperature)),
        ),
    };
    let rise = heat.outlet_temperature - heat.supply_temperature;
    vec![
        card(
            label,
            "effective_temperature_degc",
            heat.effective_temperature,
            detail,
        ),
        card(
            "Outlet temperature",
            "outlet_temperature_degc",
            heat.outlet_temperature,
            format!(
                "{} K above the supply at {}",
                super::format::significant(rise),
                shown(heat.supply_temperature)
            ),
        ),
    ]
}

/// Temperatures and heat flows; `power` is what the film loses, W.
pub(super) fn table(header: &Header, power: f64, units: &Units) -> Option<Table> {
    let heat = header.heat.as_ref()?;
    let shown = |kelvin: f64| format!("{} {DEGREE}", celsius(kelvin));
    let mut rows = vec![("Oil supply", shown(heat.supply_temperature))];
    let (generated, carried, to) = match &heat.field {
        Some(field) => {
            rows.push(("Mean of the film", shown(heat.effective_temperature)));
            rows.push(("Hottest place of the film", shown(field.hottest)));
            (
                field.generated,
                field.carried_out,
                "of it into the surfaces",
            )
        }
        None => {
            rows.push(("Effective, of the film", shown(heat.effective_temperature)));
            let carried = power - heat.conducted;
            (power, carried, "of it into the surroundings")
        }
    };
    let share = |part: f64| {
        let percent = Unit {
            symbol: "%",
            factor: 100.0,
        };
        format!(
            "{} · {}",
            units.power.show(part),
            percent.show(part / generated)
        )
    };
    rows.extend([
        (
            "Outlet, mean of the side flow",
            shown(heat.outlet_temperature),
        ),
        ("Heat of the film", units.power.show(generated)),
        ("of it with the oil", share(carried)),
        (to, share(heat.conducted)),
        (
            "Radial clearance, warm",
            MICROMETRE.show(heat.radial_clearance),
        ),
    ]);
    if heat.radial_clearance != heat.given_radial_clearance {
        let given = MICROMETRE.show(heat.given_radial_clearance);
        rows.push(("Radial clearance, as given", given));
    }
    rows.extend(convergence(heat));
    Some(Table {
        title: "Heat",
        note: last_iterates(header),
        rows: rows
            .into_iter()
            .map(|(label, value)| vec![Cell::text(label), Cell::number(value)])
            .collect(),
        ..Table::default()
    })
}

/// Temperatures of every bearing of a machine at one speed, where its heat is balanced.
pub(super) fn machine_table(speed: &SpeedResults, units: &Units) -> Option<Table> {
    let shown = |kelvin: f64| Cell::number(format!("{} {DEGREE}", celsius(kelvin)));
    let rows: Vec<Vec<Cell>> = speed
        .bearings
        .iter()
        .filter_map(|bearing| {
            let heat = bearing.heat.as_ref()?;
            let lost = bearing.cycle.mean(|point| point.summary.power_loss());
            Some(vec![
                Cell::text(bearing.name.clone()),
                shown(heat.supply_temperature),
                shown(heat.effective_temperature),
                shown(heat.outlet_temperature),
                Cell::number(units.power.show(lost)),
                Cell::number(units.power.show(heat.conducted)),
                Cell::number(MICROMETRE.show(2.0 * heat.radial_clearance)),
            ])
        })
        .collect();
    (!rows.is_empty()).then(|| Table {
        title: "Temperatures of every bearing",
        note: "Each bearing at the temperature at which its mean power loss leaves with the oil and by \
               conduction."
            .to_owned(),
        columns: vec![
            "Bearing",
            "Supply",
            "Effective",
            "Outlet",
            "Heat of the film",
            "Conducted",
            "Warm diametral clearance",
        ],
        rows,
        size: "wide",
    })
}

/// How the temperatures were found.
fn convergence(heat: &HeatResults) -> Vec<(&'static str, String)> {
    let Some(field) = &heat.field else {
        return vec![("Temperatures tried", heat.trials.len().to_string())];
    };
    let mut rows = vec![("Energy balance of all cells", size(field.balance_error))];
    if let Some(last) = field.changes.last() {
        let text = format!("{} K in round {}", size(*last), field.changes.len());
        rows.push(("Last change of a temperature", text));
    }
    rows
}
