//! The study beside itself with other models of its film: curves over the cycle, and a table.

use super::chart::{Chart, Mark, Series};
use super::detail::Detail;
use super::figures::thinned;
use super::format::{MICROMETRE, Unit, Units, significant};
use super::page::{Cell, Figure, Section, Table, headline};
use crate::results::{
    Body, Comparison, CycleResults, Header, ModelEnd, ModelRun, SteadyResults, degrees,
};
use serde_json::Value;
use sommerfeld_bearing::CyclePoint;
use sommerfeld_film::Outcome;

/// Minimum film thickness, peak film pressure and power, SI.
type Figures = [f64; 3];

/// The models side by side at one state.
pub(super) fn steady_table(
    header: &Header,
    steady: &SteadyResults,
    units: &Units,
) -> Option<Table> {
    table(header, of_steady(steady), units, "Power loss")
}

/// The models side by side over a cycle.
pub(super) fn cycle_table(header: &Header, cycle: &CycleResults, units: &Units) -> Option<Table> {
    table(header, of_cycle(cycle), units, "Mean power loss")
}

fn of_steady(steady: &SteadyResults) -> Figures {
    let summary = &steady.summary;
    [
        summary.minimum_film_thickness.value,
        summary.peak_film_pressure.value,
        summary.power_loss(),
    ]
}

fn of_cycle(cycle: &CycleResults) -> Figures {
    let none = f64::NAN;
    let thinnest = cycle.minimum_film_thickness();
    let peak = cycle.peak_film_pressure();
    [
        thinnest.map_or(none, |p| p.summary.minimum_film_thickness.value),
        peak.map_or(none, |p| p.summary.peak_film_pressure.value),
        cycle.mean(|p| p.summary.power_loss()),
    ]
}

fn table(header: &Header, own: Figures, units: &Units, power: &'static str) -> Option<Table> {
    let compared = header.comparison.as_deref()?;
    let shown = [MICROMETRE, units.pressure, units.power];
    let mut rows = vec![row(
        &format!("{} (this study)", compared.own_model),
        Cell::outcome(header.status),
        (own, None),
        shown,
        (compared.own_wall_time, String::new()),
    )];
    for run in &compared.runs {
        let found = match &run.body {
            Some(Body::Steady(steady)) => of_steady(steady),
            Some(Body::LoadCycle(cycle)) => of_cycle(cycle),
            _ => [f64::NAN; 3],
        };
        let remarks = (run.wall_time, remarks(run));
        rows.push(row(
            run.model,
            status(run),
            (found, Some(own)),
            shown,
            remarks,
        ));
    }
    Some(Table {
        title: "Film models side by side",
        note: "The same study with other models of its film. Differences are in percent of the \
               study's own model."
            .to_owned(),
        columns: vec![
            "Film model",
            "Status",
            "Minimum film",
            "Difference",
            "Peak pressure",
            "Difference",
            power,
            "Difference",
            "Wall time",
            "Remarks",
        ],
        rows,
        size: "wide",
    })
}

fn row(
    model: &str,
    status: Cell,
    (found, own): (Figures, Option<Figures>),
    units: [Unit; 3],
    (wall_time, remarks): (f64, String),
) -> Vec<Cell> {
    let mut cells = vec![Cell::text(model), status];
    for at in 0..3 {
        cells.push(Cell::number(units[at].show(found[at])));
        let difference = own.map_or_else(String::new, |own| difference(found[at], own[at]));
        cells.push(Cell::number(difference));
    }
    cells.push(Cell::number(format!("{} s", significant(wall_time))));
    cells.push(Cell::text(remarks));
    cells
}

/// In percent of the study's own value, with its sign; two digits where it is small.
fn difference(found: f64, own: f64) -> String {
    let percent = 100.0 * (found / own - 1.0);
    if !percent.is_finite() {
        return "n/a".to_owned();
    }
    let digits = match percent.abs() {
        1.0.. => 1,
        0.01.. => 2,
        0.0005.. => 3,
        _ => return "0.000 %".to_owned(),
    };
    format!("{percent:+.digits$} %").replace('-', "−")
}

fn status(run: &ModelRun) -> Cell {
    match &run.end {
        ModelEnd::Ended(outcome) => Cell::outcome(*outcome),
        ModelEnd::Refused(_) => Cell {
            text: "Refused".to_owned(),
            class: "bad",
        },
        ModelEnd::NotRun => Cell {
            text: "Not run".to_owned(),
            class: "bad",
        },
    }
}

fn remarks(run: &ModelRun) -> String {
    let mut all = run.notes.clone();
    match &run.end {
        ModelEnd::Ended(Outcome::Converged) | ModelEnd::NotRun => {}
        ModelEnd::Ended(outcome) => all.push(format!(
            "{}: the numbers are last iterates",
            headline(*outcome).to_lowercase()
        )),
        ModelEnd::Refused(reason) => all.push(reason.clone()),
    }
    all.join("; ")
}

/// The cycles of the models that have one.
fn cycles(compared: &Comparison) -> impl Iterator<Item = (&'static str, &CycleResults)> {
    compared.runs.iter().filter_map(|run| match &run.body {
        Some(Body::LoadCycle(cycle)) if !cycle.orbit.points.is_empty() => {
            Some((run.model, cycle.as_ref()))
        }
        _ => None,
    })
}

/// The figures of a cycle, where there is more than one model to draw.
pub(super) fn section(header: &Header) -> Option<Section> {
    let compared = header.comparison.as_deref()?;
    cycles(compared).next()?;
    let figure = |kind, title, caption: &str| Figure {
        kind,
        title,
        caption: caption.to_owned(),
        size: "",
    };
    Some(Section {
        id: "models",
        title: "Film models side by side",
        lead: "The same load cycle with other models of the film; the differences of the extremes \
               stand in the table of this name."
            .to_owned(),
        figures: vec![
            figure(
                "models-thickness",
                "Minimum film thickness",
                "Thinnest film at each crank angle, by film model.",
            ),
            figure(
                "models-pressure",
                "Peak film pressure",
                "Highest film pressure (gauge) at each crank angle, by film model.",
            ),
            figure(
                "models-power",
                "Power loss",
                "Power lost in the film at each crank angle, by film model.",
            ),
            figure(
                "models-orbit",
                "Journal orbits",
                "Path of the journal centre over the radial clearance, by film model.",
            ),
        ],
    })
}

/// The charts of the figures of [`section`].
pub(super) fn charts(
    header: &Header,
    own: &CycleResults,
    units: &Units,
    detail: &Detail,
    charts: &mut Value,
) {
    let Some(compared) = header.comparison.as_deref() else {
        return;
    };
    if cycles(compared).next().is_none() {
        return;
    }
    let all: Vec<(&str, &CycleResults)> = std::iter::once((compared.own_model, own))
        .chain(cycles(compared))
        .collect();
    let over = |cycle: &CycleResults, value: &dyn Fn(&CyclePoint) -> f64| -> Vec<f64> {
        let points = &cycle.orbit.points;
        let kept = thinned(points.len(), detail.curve_points);
        kept.iter().map(|&at| value(&points[at])).collect()
    };
    let crank = |point: &CyclePoint| degrees(point.crank_angle);
    let chart = |[x_title, y_title]: [&str; 2],
                 x: &dyn Fn(&CyclePoint, f64) -> f64,
                 y: &dyn Fn(&CyclePoint, f64) -> f64| {
        let series = all.iter().map(|(model, cycle)| {
            let clearance = cycle.bearing.radial_clearance;
            Series {
                name: (*model).to_owned(),
                x: Some(over(cycle, &|point| x(point, clearance))),
                y: over(cycle, &|point| y(point, clearance)),
                mark: Mark::Line,
            }
        });
        Chart {
            x_title: x_title.to_owned(),
            y_title: y_title.to_owned(),
            y_range: None,
            series: series.collect(),
        }
        .data(detail)
    };
    let over_crank = |title: String, unit: Unit, value: fn(&CyclePoint) -> f64| {
        chart(
            ["Crank angle [°]", &title],
            &|point, _| crank(point),
            &|point, _| unit.factor * value(point),
        )
    };
    charts["models-thickness"] = over_crank("Film thickness [µm]".to_owned(), MICROMETRE, |p| {
        p.summary.minimum_film_thickness.value
    });
    charts["models-pressure"] = over_crank(
        format!("Film pressure [{}]", units.pressure.symbol),
        units.pressure,
        |p| p.summary.peak_film_pressure.value,
    );
    charts["models-power"] = over_crank(
        format!("Power [{}]", units.power.symbol),
        units.power,
        |p| p.summary.power_loss(),
    );
    charts["models-orbit"] = chart(
        [
            "Eccentricity x / clearance [–]",
            "Eccentricity y / clearance [–]",
        ],
        &|point, clearance| point.state.position[0] / clearance,
        &|point, clearance| point.state.position[1] / clearance,
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_differences_keep_their_digits() {
        assert_eq!(difference(1.5, 2.0), "−25.0 %");
        assert_eq!(difference(2.001, 2.0), "+0.05 %");
        assert_eq!(difference(2.0 - 1e-9, 2.0), "0.000 %");
        assert_eq!(difference(1.0, 0.0), "n/a");
    }
}
