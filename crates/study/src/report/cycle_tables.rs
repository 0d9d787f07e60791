//! Tables of a load cycle: extremes with limits, means, convergence, points that failed.

use super::cycle::side_flow;
use super::format::{MICROMETRE, ONE, Unit, Units, angle, significant, size};
use super::page::{Cell, Table, error, feed_words, headline, last_iterates, limit_cells};
use super::{compare, compare_models, contact, dynamics, heat, wear};
use crate::limits::Quantity;
use crate::oil_holes::oil_holes;
use crate::regime::FlowRegime;
use crate::results::{CycleResults, Header, degrees, magnitude, place, specific_load};
use sommerfeld_bearing::CyclePoint;
use sommerfeld_film::{Extreme, Feed, FeedFlow, FilmSummary, Outcome};

/// So many rows that did not converge are listed; the table of the cycle names all of them.
const LISTED_ROWS: usize = 24;

/// What the mass balance of a table of convergence means.
pub(super) const BALANCE_NOTE: &str = "Mass balance: |feed − side − storage| over the largest of \
    them. A closure that does not conserve oil shows here what it creates or loses.";
/// What the Reynolds number of such a table is held against.
pub(super) const REYNOLDS_NOTE: &str = "Reynolds number ρ U c/η; laminar below 41.1 √(R/c) \
    (Taylor vortices: Taylor 1923, Phil. Trans. R. Soc. A 223, 289–343) and below 2000 (turbulent \
    shear flow).";

/// The Reynolds number of the film and its bound.
pub(super) fn reynolds_row(flow: Option<FlowRegime>) -> Vec<Cell> {
    let label = Cell::text("Largest Reynolds number of the film");
    let Some(flow) = flow else {
        return vec![label, Cell::number("not given by this film model")];
    };
    let text = format!(
        "{}, laminar below {}",
        significant(flow.reynolds_number),
        significant(flow.critical)
    );
    let class = if flow.warning().is_some() {
        "bad"
    } else {
        "number"
    };
    vec![label, Cell { text, class }]
}

/// The tables in the order of the page.
pub(super) fn all(header: &Header, cycle: &CycleResults, units: &Units) -> Vec<Table> {
    let mut tables = vec![
        extremes(header, cycle, units),
        means(header, cycle, units),
        convergence(cycle),
    ];
    let lost = cycle.mean(|point| point.summary.power_loss());
    tables.extend(contact::cycle_table(cycle, units));
    tables.extend(wear::table(cycle));
    tables.extend(heat::table(header, lost, units));
    let own = compare::cycle_figures(cycle, units);
    let compared = [
        compare::table(header, own, units),
        compare_models::cycle_table(header, cycle, units),
    ];
    for (at, table) in compared.into_iter().flatten().enumerate() {
        tables.insert(1 + at, table);
    }
    tables.extend(feeds(cycle, units));
    tables.extend(oil_hole_rows(cycle, units));
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
    /// Its key in `summary.json`, and the unit of its error.
    key: Option<(&'static str, Unit)>,
}

impl Peak<'_> {
    fn error(&self, header: &Header) -> String {
        let error = self.key.and_then(|(key, unit)| error(header, key, unit));
        error.map_or_else(String::new, |error| format!("± {error}"))
    }

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
            Cell::number(self.error(header)),
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
        key: None,
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
            key: Some(("minimum_film_thickness_m", MICROMETRE)),
        },
        Peak {
            label: "Peak film pressure",
            point: cycle.peak_film_pressure(),
            value: Box::new(move |p| pressure.show(p.summary.peak_film_pressure.value)),
            in_film: Some(|summary| &summary.peak_film_pressure),
            limited: Some((Quantity::PeakFilmPressure, pressure)),
            key: Some(("peak_film_pressure_pa", pressure)),
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
            "Error",
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
            "of it front, z = −B/2",
            units.flow.show(cycle.mean(|p| p.summary.side_flow[0])),
        ),
        (
            "of it rear, z = +B/2",
            units.flow.show(cycle.mean(|p| p.summary.side_flow[1])),
        ),
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

/// The number and the words of a groove or hole.
pub(super) fn feed_name(feed: &Feed, index: usize) -> String {
    format!("{}: {}", index + 1, feed_words(feed))
}

/// Mean, largest and smallest flow of each groove and hole.
fn feeds(cycle: &CycleResults, units: &Units) -> Option<Table> {
    let points = &cycle.orbit.points;
    if cycle.bearing.feeds.is_empty() || cycle.feed_flows.len() != points.len() {
        return None;
    }
    let rows = cycle.bearing.feeds.iter().enumerate().map(|(index, feed)| {
        let flow = |row: &Vec<FeedFlow>| row.get(index).map_or(f64::NAN, |feed| feed.flow);
        let flows: Vec<f64> = cycle.feed_flows.iter().map(flow).collect();
        let show = |value: f64| Cell::number(units.flow.show(value));
        vec![
            Cell::text(feed_name(feed, index)),
            Cell::number(units.pressure.show(feed.pressure)),
            show(mean_over(points, &flows)),
            show(flows.iter().copied().fold(f64::NAN, f64::max)),
            show(flows.iter().copied().fold(f64::NAN, f64::min)),
        ]
    });
    Some(Table {
        title: "Grooves and holes",
        note: "Flow into the film; negative where the film pushes oil back.".into(),
        columns: vec!["Feed", "Gauge pressure", "Mean flow", "Largest", "Smallest"],
        rows: rows.collect(),
        size: "wide",
    })
}

/// Mean of values given at the points over their crank angles (trapezoidal rule).
fn mean_over(points: &[CyclePoint], values: &[f64]) -> f64 {
    let widths = points
        .windows(2)
        .map(|pair| pair[1].crank_angle - pair[0].crank_angle);
    let area: f64 = widths
        .clone()
        .zip(values.windows(2))
        .map(|(width, pair)| 0.5 * width * (pair[0] + pair[1]))
        .sum();
    area / widths.sum::<f64>()
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
    ];
    let fastest = cycle.largest(|point| point.summary.reynolds_number);
    let flow = fastest.and_then(|p| FlowRegime::of(&cycle.bearing, p.summary.reynolds_number));
    let mut cells = vec![vec![
        Cell::text("Status of the orbit"),
        Cell::outcome(orbit.outcome),
    ]];
    cells.extend(
        rows.into_iter()
            .map(|(label, value)| vec![Cell::text(label), Cell::number(value)]),
    );
    cells.push(reynolds_row(flow));
    Table {
        title: "Convergence and validity",
        note: format!("{BALANCE_NOTE} {REYNOLDS_NOTE}"),
        rows: cells,
        ..Table::default()
    }
}

/// Crank angles, `from to to`, one range after the other.
fn ranges(ranges: &[[f64; 2]]) -> String {
    if ranges.is_empty() {
        return "never".to_owned();
    }
    let ranges = ranges
        .iter()
        .map(|[from, to]| format!("{} to {}", angle(degrees(*from)), angle(degrees(*to))));
    ranges.collect::<Vec<_>>().join("; ")
}

fn oil_hole_rows(cycle: &CycleResults, units: &Units) -> Option<Table> {
    let holes = oil_holes(cycle);
    if holes.is_empty() {
        return None;
    }
    let at = |[flow, crank]: [f64; 2]| {
        let at = angle(degrees(crank));
        format!("{} at {at}", units.flow.show(flow))
    };
    let rows = holes.iter().map(|hole| {
        vec![
            Cell::text(format!("Feed {}", hole.feed + 1)),
            Cell::number(units.flow.show(hole.mean_flow)),
            Cell::number(at(hole.minimum_flow)),
            Cell::number(at(hole.maximum_flow)),
            Cell::text(ranges(&hole.backflow)),
            Cell::number(format!("{} %", significant(100.0 * hole.backflow_share))),
            Cell::text(ranges(&hole.facing)),
        ]
    });
    Some(Table {
        title: "Oil holes of the journal",
        note: "Flow into the film; negative where the film, full and above the pressure of the \
               hole, pushes oil back. Angles are crank angles."
            .into(),
        columns: vec![
            "Feed",
            "Mean flow",
            "Smallest flow",
            "Largest flow",
            "Oil pushed back",
            "Share of the cycle",
            "Opens into a shell groove",
        ],
        rows: rows.collect(),
        size: "wide",
    })
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
