//! Tables of a load cycle: extremes with limits, means, convergence, points that failed.

use super::cycle::side_flow;
use super::dynamics;
use super::format::{MICROMETRE, ONE, Unit, Units, angle, significant, size};
use super::page::{Cell, Table, headline, last_iterates, limit_cells};
use crate::limits::Quantity;
use crate::results::{CycleResults, Header, degrees, magnitude, place, specific_load};
use sommerfeld_bearing::CyclePoint;
use sommerfeld_film::{Extreme, FilmSummary, Outcome};

/// So many rows that did not converge are listed; the table of the cycle names all of them.
const LISTED_ROWS: usize = 24;

/// The tables in the order of the page.
pub(super) fn all(header: &Header, cycle: &CycleResults, units: &Units) -> Vec<Table> {
    let mut tables = vec![
        extremes(header, cycle, units),
        means(header, cycle, units),
        convergence(cycle),
    ];
    tables.extend(dynamics::instants(cycle));
    tables.extend(not_converged_rows(cycle));
    tables
}

/// One row of the table of extremes.
struct Peak<'a> {
    label: &'static str,
    /// The point at which it occurs.
    point: Option<&'a CyclePoint>,
    /// The value of a point with its unit.
    value: Box<dyn Fn(&CyclePoint) -> String + 'a>,
    /// Where in the film it lies, for what has a place there.
    in_film: Option<fn(&FilmSummary) -> &Extreme>,
    /// What may limit it, and the unit of the limit.
    limited: Option<(Quantity, Unit)>,
}

impl Peak<'_> {
    fn cells(&self, header: &Header) -> Option<Vec<Cell>> {
        let point = self.point?;
        // A converged step of a run that did not converge is still part of no result.
        let status = match point.outcome {
            Outcome::Converged => header.status,
            failed => failed,
        };
        let [bearing_angle, axial] = match self.in_film {
            Some(extreme) => {
                let (degrees, axial) = place(extreme(&point.summary));
                [angle(degrees), format!("{} mm", significant(axial))].map(Cell::number)
            }
            None => [Cell::number("–"), Cell::number("–")],
        };
        let unit = self.limited.map_or(ONE, |(_, unit)| unit);
        let [limit, verdict] = limit_cells(header, self.limited.map(|(q, _)| q), unit);
        Some(vec![
            Cell::text(self.label),
            Cell::number((self.value)(point)),
            Cell::number(angle(degrees(point.crank_angle))),
            bearing_angle,
            axial,
            limit,
            verdict,
            Cell::outcome(status),
        ])
    }
}

/// The rows of the table of extremes.
fn peaks<'a>(cycle: &'a CycleResults, units: &'a Units) -> Vec<Peak<'a>> {
    let plain = |label, point, value: Box<dyn Fn(&CyclePoint) -> String + 'a>| Peak {
        label,
        point,
        value,
        in_film: None,
        limited: None,
    };
    let pressure = units.pressure;
    let heaviest = cycle.maximum_load();
    let loss = cycle.largest(|p| p.summary.power_loss());
    let torque = cycle.largest(|p| p.reaction.friction_torque_journal);
    let mut peaks = vec![
        Peak {
            label: "Minimum film thickness",
            point: cycle.minimum_film_thickness(),
            value: Box::new(|p| MICROMETRE.show(p.summary.minimum_film_thickness.value)),
            in_film: Some(|summary| &summary.minimum_film_thickness),
            limited: Some((Quantity::MinimumFilmThickness, MICROMETRE)),
        },
        Peak {
            label: "Peak film pressure",
            point: cycle.peak_film_pressure(),
            value: Box::new(move |p| pressure.show(p.summary.peak_film_pressure.value)),
            in_film: Some(|summary| &summary.peak_film_pressure),
            limited: Some((Quantity::PeakFilmPressure, pressure)),
        },
        plain(
            "Maximum load",
            heaviest,
            Box::new(|p| units.force.show(magnitude(p.load))),
        ),
        Peak {
            limited: Some((Quantity::MaximumSpecificLoad, pressure)),
            ..plain(
                "Maximum specific load",
                heaviest,
                Box::new(move |p| pressure.show(specific_load(&cycle.bearing, p.load))),
            )
        },
        plain(
            "Maximum relative eccentricity",
            cycle.largest(|p| cycle.relative_eccentricity(p)),
            Box::new(|p| significant(cycle.relative_eccentricity(p))),
        ),
        plain(
            "Maximum power loss",
            loss,
            Box::new(|p| units.power.show(p.summary.power_loss())),
        ),
        plain(
            "Maximum friction torque on the journal",
            torque,
            Box::new(|p| units.torque.show(p.reaction.friction_torque_journal)),
        ),
    ];
    if cycle.is_tilted() {
        for (edge, label) in [
            "Minimum film at the front edge",
            "Minimum film at the rear edge",
        ]
        .into_iter()
        .enumerate()
        {
            let value = move |p: &CyclePoint| MICROMETRE.show(p.summary.edge_film_thickness[edge]);
            peaks.push(plain(label, cycle.thinnest_edge(edge), Box::new(value)));
        }
        peaks.push(plain(
            "Maximum moment on the journal",
            cycle.largest(|p| magnitude(p.moment)),
            Box::new(|p| units.torque.show(magnitude(p.moment))),
        ));
    }
    peaks
}

fn extremes(header: &Header, cycle: &CycleResults, units: &Units) -> Table {
    Table {
        title: "Extremes over the cycle",
        columns: vec![
            "Quantity",
            "Value",
            "Crank angle",
            "Bearing angle",
            "Axial position",
            "Limit",
            "Verdict",
            "Status",
        ],
        rows: peaks(cycle, units)
            .iter()
            .filter_map(|peak| peak.cells(header))
            .collect(),
        size: "wide",
        ..Table::default()
    }
}

fn means(header: &Header, cycle: &CycleResults, units: &Units) -> Table {
    let mut rows: Vec<Vec<Cell>> = [
        (
            "Power loss",
            units.power.show(cycle.mean(|p| p.summary.power_loss())),
        ),
        (
            "of it friction",
            units.power.show(cycle.mean(|p| p.summary.friction_power)),
        ),
        (
            "of it squeeze",
            units.power.show(cycle.mean(|p| p.summary.squeeze_power)),
        ),
        ("Side flow", units.flow.show(cycle.mean(side_flow))),
        (
            "Feed flow",
            units.flow.show(cycle.mean(|p| p.summary.feed_flow)),
        ),
        (
            "Relative eccentricity",
            significant(cycle.mean(|p| cycle.relative_eccentricity(p))),
        ),
        (
            "Friction torque on the journal",
            units
                .torque
                .show(cycle.mean(|p| p.reaction.friction_torque_journal)),
        ),
        (
            "Share of full film",
            significant(cycle.mean(|p| p.summary.full_film_share)),
        ),
    ]
    .into_iter()
    .map(|(label, value)| vec![Cell::text(label), Cell::number(value)])
    .collect();
    let [limit, verdict] = limit_cells(header, Some(Quantity::PowerLoss), units.power);
    if !verdict.text.is_empty() {
        let label = Cell::text(format!("Limit of the mean power loss {}", limit.text));
        rows.insert(1, vec![label, verdict]);
    }
    Table {
        title: "Means over the cycle",
        note: last_iterates(header),
        rows,
        ..Table::default()
    }
}

fn convergence(cycle: &CycleResults) -> Table {
    let orbit = &cycle.orbit;
    let worst = |value: fn(&FilmSummary) -> f64| {
        cycle
            .largest(|point| value(&point.summary))
            .map_or("n/a".to_owned(), |point| {
                let at = angle(degrees(point.crank_angle));
                format!("{} at {at}", size(value(&point.summary)))
            })
    };
    let failed = cycle.not_converged().count();
    let rows = [
        ("Cycles until the orbit closed", orbit.cycles.to_string()),
        (
            "Closure (distance between last cycles / clearance)",
            size(orbit.closure),
        ),
        ("Time steps", orbit.steps.to_string()),
        ("Film solves", orbit.film_solves.to_string()),
        ("Points shown", orbit.points.len().to_string()),
        ("Points not converged", failed.to_string()),
        (
            "Worst mass balance",
            worst(|summary| summary.mass_balance_relative),
        ),
        (
            "Worst complementarity",
            worst(|summary| summary.complementarity_violation),
        ),
        (
            "Worst cell residual",
            worst(|summary| summary.cell_residual),
        ),
        (
            "Largest Reynolds number of the film",
            worst(|summary| summary.reynolds_number),
        ),
    ];
    let mut cells = vec![vec![
        Cell::text("Status of the orbit"),
        Cell::outcome(orbit.outcome),
    ]];
    cells.extend(
        rows.into_iter()
            .map(|(label, value)| vec![Cell::text(label), Cell::number(value)]),
    );
    Table {
        title: "Convergence",
        note: "Mass balance: |feed − side − storage| over the largest of them. A closure that \
               does not conserve oil shows here what it creates or loses."
            .into(),
        rows: cells,
        ..Table::default()
    }
}

fn not_converged_rows(cycle: &CycleResults) -> Option<Table> {
    let failed: Vec<&CyclePoint> = cycle.not_converged().collect();
    if failed.is_empty() {
        return None;
    }
    let rows = failed
        .iter()
        .take(LISTED_ROWS)
        .map(|point| {
            vec![
                Cell::number(angle(degrees(point.crank_angle))),
                Cell {
                    text: headline(point.outcome).to_owned(),
                    class: "bad",
                },
                Cell::number(MICROMETRE.show(point.summary.minimum_film_thickness.value)),
                Cell::number(size(point.summary.cell_residual)),
            ]
        })
        .collect();
    let more = failed.len().saturating_sub(LISTED_ROWS);
    let note = if more > 0 {
        format!("The first {LISTED_ROWS} of them; {more} more in cycle.csv.")
    } else {
        String::new()
    };
    Some(Table {
        title: "Points not converged",
        note,
        columns: vec![
            "Crank angle",
            "Status",
            "Last film thickness",
            "Cell residual",
        ],
        rows,
        size: "wide",
    })
}
