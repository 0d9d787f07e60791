//! The report of one state of the journal: position, load and force, pressure, results.

use super::cycle_tables::{BALANCE_NOTE, REYNOLDS_NOTE, feed_name, reynolds_row};
use super::detail::Detail;
use super::film::{self, Instant, in_film};
use super::format::{MICROMETRE, MILLIRADIAN, ONE, Unit, Units, angle, significant, size};
use super::page::{
    Card, Cell, Figure, Page, Section, Table, badge, checks, error, exact, last_iterates,
    limit_cells, outer_circle, subject,
};
use super::{compare, compare_models, contact, dynamics, figures, heat};
use crate::limits::Quantity;
use crate::regime::FlowRegime;
use crate::results::{FieldSnapshot, Header, SteadyResults, degrees, degrees_around, magnitude};
use serde_json::{Value, json};

/// Fills cards, figures and tables; returns the data of the figures.
pub(super) fn fill(page: &mut Page, header: &Header, steady: &SteadyResults) -> Value {
    let units = units(steady);
    page.cards = cards(header, steady, &units);
    page.cards.extend(further_cards(
        heat::cards(header),
        contact::steady_cards(header, steady, &units),
    ));
    page.subject = subject(&steady.bearing);
    let figures = figures_of(steady);
    let instant: Vec<Instant<'_>> = steady
        .field
        .iter()
        .map(|field| instant(steady, field))
        .collect();
    page.film = instant
        .first()
        .filter(|_| !figures.is_empty())
        .map(|_| film::part(&steady.bearing, &instant, &Detail::ALONE));
    if !figures.is_empty() {
        page.sections = vec![Section {
            id: "position",
            title: "Journal and mid-plane",
            lead: String::new(),
            figures,
        }];
    }
    let beside: Vec<Table> = [
        contact::steady_table(steady, &units),
        heat::table(header, steady.summary.power_loss(), &units),
        coefficients(steady),
        feeds(steady, &units),
    ]
    .into_iter()
    .flatten()
    .collect();
    page.tables = vec![results(header, steady, &units), convergence(header, steady)];
    page.tables[1].size = match beside.len() {
        0 => "wide",
        2 | 4 => "tall",
        _ => "",
    };
    page.tables.extend(beside);
    let own = compare::steady_figures(steady, &units);
    let compared = [
        compare::table(header, own, &units),
        compare_models::steady_table(header, steady, &units),
    ];
    for (at, table) in compared.into_iter().flatten().enumerate() {
        page.tables.insert(1 + at, table);
    }
    page.tables.extend(dynamics::tables(steady));
    page.sections.extend(dynamics::section(steady));
    json!({
        "units": figures::unit_symbols(&units),
        "stability": dynamics::chart_data(steady),
        "position": figures::position_data(steady, &units),
        "film": film::film_data(&steady.bearing, &instant, &units, &Detail::ALONE),
        "middle": steady.field.as_ref().map(|field| film::middle_data(field, &units)),
    })
}

/// Two cards more beside those that every page has, so that they fill their rows: of heat, of contact,
/// or the first of each.
pub(super) fn further_cards(heat: Vec<Card>, contact: Vec<Card>) -> impl Iterator<Item = Card> {
    let each = if heat.is_empty() || contact.is_empty() {
        2
    } else {
        1
    };
    contact
        .into_iter()
        .take(each)
        .chain(heat.into_iter().take(each))
}

fn instant<'a>(steady: &'a SteadyResults, field: &'a FieldSnapshot) -> Instant<'a> {
    let force = steady.reaction.force();
    Instant {
        crank_angle: None,
        field,
        state: &steady.state,
        summary: &steady.summary,
        // Where a position was given, the load is what the film would bear there.
        load: steady
            .load
            .unwrap_or_else(|| force.map(|component| -component)),
    }
}

fn units(steady: &SteadyResults) -> Units {
    let torque = steady
        .reaction
        .friction_torque_journal
        .abs()
        .max(steady.reaction.friction_torque_shell.abs());
    let force = magnitude(steady.load.unwrap_or_else(|| steady.reaction.force()));
    let summary = &steady.summary;
    let flow = side_flow(steady).abs().max(summary.feed_flow.abs());
    let peak = summary.peak_film_pressure.value;
    Units::choose(
        force,
        if peak.is_finite() {
            peak
        } else {
            steady.specific_load()
        },
        summary.power_loss(),
        flow,
        torque,
    )
}

fn side_flow(steady: &SteadyResults) -> f64 {
    steady.summary.side_flow[0] + steady.summary.side_flow[1]
}

fn cards(header: &Header, steady: &SteadyResults, units: &Units) -> Vec<Card> {
    let summary = &steady.summary;
    let card = |label, value: f64, unit: Unit, key, limited, detail| Card {
        label,
        key,
        exact: exact(value),
        spark: None,
        value: unit.number(value),
        unit: unit.symbol,
        error: error(header, key, unit),
        checks: checks(header, limited, unit),
        badge: badge(header.status),
        detail,
    };
    let plain = |label, value: f64, unit: Unit, key, detail| Card {
        checks: Vec::new(),
        ..card(label, value, unit, key, Quantity::PowerLoss, detail)
    };
    let centres = degrees_around(steady.state.line_of_centres_angle());
    let attitude = match steady.attitude_angle() {
        Some(attitude) => format!("attitude angle {}", angle(degrees(attitude))),
        None => format!("line of centres at {}", angle(centres)),
    };
    let parts = format!(
        "friction {}, squeeze {}",
        units.power.show(summary.friction_power),
        units.power.show(summary.squeeze_power)
    );
    let side = side_flow(steady);
    vec![
        card(
            "Minimum film thickness",
            summary.minimum_film_thickness.value,
            MICROMETRE,
            "minimum_film_thickness_m",
            Quantity::MinimumFilmThickness,
            in_film(&summary.minimum_film_thickness, steady.bearing.width),
        ),
        card(
            "Peak film pressure",
            summary.peak_film_pressure.value,
            units.pressure,
            "peak_film_pressure_pa",
            Quantity::PeakFilmPressure,
            in_film(&summary.peak_film_pressure, steady.bearing.width),
        ),
        plain(
            "Relative eccentricity",
            steady.relative_eccentricity(),
            ONE,
            "relative_eccentricity",
            attitude,
        ),
        card(
            "Power loss",
            summary.power_loss(),
            units.power,
            "power_loss_w",
            Quantity::PowerLoss,
            parts,
        ),
        plain(
            "Side flow",
            side,
            units.flow,
            "side_flow_m3_s",
            format!("{} l/min", significant(side * 6e4)),
        ),
        plain(
            "Sommerfeld number",
            steady.sommerfeld_number,
            ONE,
            "sommerfeld_number",
            "So = F ψ²/(B D η ω)".to_owned(),
        ),
    ]
}

fn figures_of(steady: &SteadyResults) -> Vec<Figure> {
    // Without a film the journal has no place to draw.
    if !steady.relative_eccentricity().is_finite() {
        return Vec::new();
    }
    let vectors = if steady.load.is_some() {
        "Arrows: load on the journal and force of the film on it, drawn to one scale."
    } else {
        "Arrow: force of the film on the journal."
    };
    let mut list = vec![Figure {
        kind: "position",
        title: "Journal in the clearance circle",
        caption: format!(
            "Position of the journal centre over the radial clearance, shell frame. {} {vectors}",
            outer_circle(&steady.bearing)
        ),
        size: if steady.field.is_some() { "tall" } else { "" },
    }];
    if steady.field.is_some() {
        list.push(Figure {
            kind: "middle-pressure",
            title: "Film pressure in the mid-plane",
            caption: "Gauge pressure around the bearing, angle from +X of the shell frame.".into(),
            size: "",
        });
        list.push(Figure {
            kind: "middle-thickness",
            title: "Film thickness in the mid-plane",
            caption: "Gap, and the part of it that oil fills (film fraction times gap).".into(),
            size: "",
        });
    }
    list
}

fn results(header: &Header, steady: &SteadyResults, units: &Units) -> Table {
    let summary = &steady.summary;
    let reaction = &steady.reaction;
    let pair = |unit: Unit, [x, y]: [f64; 2]| format!("{}, {}", unit.number(x), unit.show(y));
    // What is round-off against the load reads 0.
    let force = magnitude(steady.load.unwrap_or_else(|| reaction.force()));
    let heard = |vector: [f64; 2], scale: f64| {
        vector.map(|value| {
            if value.abs() < 1e-9 * scale {
                0.0
            } else {
                value
            }
        })
    };
    let row = |label: &str, value: String, key: &str, unit: Unit, limited: Option<Quantity>| {
        let [limit, verdict] = limit_cells(header, limited, unit);
        let error = error(header, key, unit).map_or_else(String::new, |error| format!("± {error}"));
        vec![
            Cell::text(label),
            Cell::number(value),
            Cell::number(error),
            limit,
            verdict,
        ]
    };
    let plain = |label: &str, value: String, key: &str| row(label, value, key, ONE, None);
    let in_unit = |label: &str, value: f64, key: &str, unit: Unit, limited| {
        row(label, unit.show(value), key, unit, limited)
    };
    let mut rows = Vec::new();
    if let Some(load) = steady.load {
        rows.push(plain(
            "Load on the journal x, y",
            pair(units.force, load),
            "load_n",
        ));
    }
    let film = MICROMETRE;
    rows.extend([
        plain(
            "Force on the journal x, y",
            pair(units.force, heard(reaction.force(), force)),
            "force_n",
        ),
        plain(
            "Moment on the journal x, y",
            pair(
                units.torque,
                heard(reaction.moment(), force * steady.bearing.width),
            ),
            "moment_n_m",
        ),
        in_unit(
            "Specific load F/(B D)",
            steady.specific_load(),
            "specific_load_pa",
            units.pressure,
            Some(Quantity::MaximumSpecificLoad),
        ),
        plain(
            "Sommerfeld number",
            significant(steady.sommerfeld_number),
            "sommerfeld_number",
        ),
        plain(
            "Relative eccentricity",
            significant(steady.relative_eccentricity()),
            "relative_eccentricity",
        ),
        plain(
            "Line of centres, from +X",
            angle(degrees_around(steady.state.line_of_centres_angle())),
            "line_of_centres_angle_deg",
        ),
    ]);
    if let Some(attitude) = steady.attitude_angle() {
        let text = angle(degrees(attitude));
        rows.push(plain("Attitude angle", text, "attitude_angle_deg"));
    }
    if steady.state.tilt != [0.0; 2] {
        let tilt = pair(MILLIRADIAN, steady.state.tilt);
        rows.push(plain("Tilt x, y", tilt, ""));
        let edges = pair(film, summary.edge_film_thickness);
        rows.push(plain("Film at the front, rear edge", edges, ""));
    }
    rows.extend([
        in_unit(
            "Minimum film thickness",
            summary.minimum_film_thickness.value,
            "minimum_film_thickness_m",
            film,
            Some(Quantity::MinimumFilmThickness),
        ),
        in_unit(
            "Peak film pressure",
            summary.peak_film_pressure.value,
            "peak_film_pressure_pa",
            units.pressure,
            Some(Quantity::PeakFilmPressure),
        ),
        in_unit(
            "Friction torque on the journal",
            reaction.friction_torque_journal,
            "friction_torque_journal_n_m",
            units.torque,
            None,
        ),
        in_unit(
            "Friction torque on the shell",
            reaction.friction_torque_shell,
            "friction_torque_shell_n_m",
            units.torque,
            None,
        ),
        plain(
            "Friction coefficient, torque over load and radius",
            significant(steady.friction_coefficient().unwrap_or(f64::NAN)),
            "friction_coefficient",
        ),
        in_unit(
            "Power loss",
            summary.power_loss(),
            "power_loss_w",
            units.power,
            Some(Quantity::PowerLoss),
        ),
        in_unit(
            "Side flow, both ends",
            side_flow(steady),
            "side_flow_m3_s",
            units.flow,
            None,
        ),
        plain(
            "of it front (z = −B/2), rear (z = +B/2)",
            pair(units.flow, summary.side_flow),
            "",
        ),
        in_unit(
            "Feed flow",
            summary.feed_flow,
            "feed_flow_m3_s",
            units.flow,
            None,
        ),
    ]);
    Table {
        title: "Results",
        note: last_iterates(header),
        columns: vec!["Quantity", "Value", "Error", "Limit", "Verdict"],
        rows,
        size: "wide",
    }
}

fn convergence(header: &Header, steady: &SteadyResults) -> Table {
    let summary = &steady.summary;
    let rows = [
        ("Iterations", steady.iterations.to_string()),
        ("Mass balance", size(summary.mass_balance_relative)),
        ("Complementarity", size(summary.complementarity_violation)),
        ("Cell residual", size(summary.cell_residual)),
        ("Share of full film", significant(summary.full_film_share)),
    ];
    let mut cells = vec![vec![Cell::text("Status"), Cell::outcome(header.status)]];
    cells.extend(
        rows.into_iter()
            .map(|(label, value)| vec![Cell::text(label), Cell::number(value)]),
    );
    let flow = FlowRegime::of(&steady.bearing, summary.reynolds_number);
    cells.push(reynolds_row(flow));
    Table {
        title: "Convergence and validity",
        note: format!("{BALANCE_NOTE} {REYNOLDS_NOTE}"),
        rows: cells,
        ..Table::default()
    }
}

/// Stiffness and damping side by side, as far as the run has them.
fn coefficients(steady: &SteadyResults) -> Option<Table> {
    let parts: Vec<(&str, &str, [[f64; 2]; 2])> = [
        ("Stiffness x", "y [N/m]", steady.stiffness),
        ("Damping x", "y [N·s/m]", steady.damping),
    ]
    .into_iter()
    .filter_map(|(x, y, matrix)| Some((x, y, matrix?)))
    .collect();
    let rows = ["Force x", "Force y"]
        .into_iter()
        .enumerate()
        .map(|(axis, label)| {
            let values = parts.iter().flat_map(|(_, _, matrix)| matrix[axis]);
            std::iter::once(Cell::text(label))
                .chain(values.map(|value| Cell::number(significant(value))))
                .collect()
        })
        .collect();
    let mut columns = vec![""];
    columns.extend(parts.iter().flat_map(|(x, y, _)| [*x, *y]));
    (!parts.is_empty()).then(|| Table {
        title: "Stiffness and damping",
        note: "−∂F/∂position and −∂F/∂velocity in the shell frame, at the state above.".into(),
        columns,
        rows,
        ..Table::default()
    })
}

fn feeds(steady: &SteadyResults, units: &Units) -> Option<Table> {
    let rows: Vec<_> = steady
        .feed_flows
        .iter()
        .enumerate()
        .map(|(index, feed)| {
            let name = steady.bearing.feeds.get(index).map_or_else(
                || format!("Feed {}", index + 1),
                |feed| feed_name(feed, index),
            );
            vec![
                Cell::text(name),
                Cell::number(units.flow.show(feed.flow)),
                Cell::number(units.pressure.show(feed.pressure)),
            ]
        })
        .collect();
    (!rows.is_empty()).then(|| Table {
        title: "Feeds",
        note: "Flow into the film; negative where the film pushes oil back.".into(),
        columns: vec!["Feed", "Flow", "Gauge pressure"],
        rows,
        ..Table::default()
    })
}
