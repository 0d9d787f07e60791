//! The study beside itself with plain surfaces and oil.

use super::cycle::side_flow;
use super::format::{MICROMETRE, ONE, Unit, Units, celsius, significant};
use super::page::{Cell, Table, headline};
use crate::results::{Body, CycleResults, Header, PlainRun, SteadyResults};
use sommerfeld_film::Outcome;

/// Figures that are compared: what, in which unit, how much (SI).
type Figures = Vec<(&'static str, Unit, f64)>;

/// Of a state.
pub(super) fn steady_figures(steady: &SteadyResults, units: &Units) -> Figures {
    let summary = &steady.summary;
    vec![
        (
            "Minimum film thickness",
            MICROMETRE,
            summary.minimum_film_thickness.value,
        ),
        (
            "Peak film pressure",
            units.pressure,
            summary.peak_film_pressure.value,
        ),
        ("Relative eccentricity", ONE, steady.relative_eccentricity()),
        ("Power loss", units.power, summary.power_loss()),
        (
            "Side flow",
            units.flow,
            summary.side_flow[0] + summary.side_flow[1],
        ),
    ]
}

/// Of a load cycle.
pub(super) fn cycle_figures(cycle: &CycleResults, units: &Units) -> Figures {
    let thinnest = cycle.minimum_film_thickness();
    let peak = cycle.peak_film_pressure();
    let none = f64::NAN;
    vec![
        (
            "Minimum film thickness",
            MICROMETRE,
            thinnest.map_or(none, |p| p.summary.minimum_film_thickness.value),
        ),
        (
            "Peak film pressure",
            units.pressure,
            peak.map_or(none, |p| p.summary.peak_film_pressure.value),
        ),
        (
            "Mean power loss",
            units.power,
            cycle.mean(|p| p.summary.power_loss()),
        ),
        ("Mean side flow", units.flow, cycle.mean(side_flow)),
    ]
}

/// The table, for studies that ask for it; `own` are the figures of the study.
pub(super) fn table(header: &Header, own: Figures, units: &Units) -> Option<Table> {
    let plain = header.plain.as_deref()?;
    let of_plain = match &plain.body {
        Some(Body::Steady(steady)) => steady_figures(steady, units),
        Some(Body::LoadCycle(cycle)) => cycle_figures(cycle, units),
        _ => own
            .iter()
            .map(|(what, unit, _)| (*what, *unit, f64::NAN))
            .collect(),
    };
    let mut rows: Vec<Vec<Cell>> = own
        .into_iter()
        .zip(of_plain)
        .map(|((what, unit, own), (_, _, plain))| {
            row(what, [unit.show(plain), unit.show(own)], change(plain, own))
        })
        .collect();
    rows.extend(temperatures(header, plain));
    Some(Table {
        title: "Beside a plain bearing",
        note: note(plain),
        columns: vec!["Quantity", "Plain", "This study", "Change"],
        rows,
        size: "wide",
    })
}

fn row(what: &str, [plain, own]: [String; 2], change: String) -> Vec<Cell> {
    let mut cells = vec![Cell::text(what)];
    cells.extend([plain, own, change].map(Cell::number));
    cells
}

/// From the plain value to that of the study, with its sign.
fn change(plain: f64, own: f64) -> String {
    let share = 100.0 * (own / plain - 1.0);
    if share.is_finite() {
        format!("{share:+.1} %").replace('-', "−")
    } else {
        "n/a".to_owned()
    }
}

fn temperatures(header: &Header, plain: &PlainRun) -> Vec<Vec<Cell>> {
    let of = |what: &str, own: f64| {
        let shown = [plain.temperature, own].map(|kelvin| format!("{} °C", celsius(kelvin)));
        let rise = own - plain.temperature;
        let sign = if rise > 0.0 { "+" } else { "" };
        row(what, shown, format!("{sign}{} K", significant(rise)))
    };
    let Some(heat) = &header.heat else {
        return vec![of("Temperature of the film", plain.temperature)];
    };
    let mut rows = vec![of("Temperature of the film", heat.effective_temperature)];
    if let Some(field) = &heat.field {
        rows[0] = of("Mean temperature of the film", heat.effective_temperature);
        rows.push(of("Hottest place of the film", field.hottest));
    }
    rows
}

fn note(plain: &PlainRun) -> String {
    let what = "Plain: the same study with smooth surfaces, a rigid shell and an oil of constant \
                viscosity and density, at one temperature.";
    if plain.status == Outcome::Converged {
        return what.to_owned();
    }
    let status = headline(plain.status).to_lowercase();
    if plain.body.is_some() {
        format!("{what} That run ended {status}: its numbers are last iterates.")
    } else {
        format!("{what} That run has no numbers: {status}.")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_counts_from_the_plain_value() {
        assert_eq!(change(2.0, 1.5), "−25.0 %");
        assert_eq!(change(2.0, 2.2), "+10.0 %");
        assert_eq!(change(0.0, 1.0), "n/a");
    }
}
