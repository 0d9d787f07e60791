//! What contact wears off a bearing, and how its shell ran in.

use super::chart::{Chart, Mark, Series};
use super::detail::Detail;
use super::format::{MICROMETRE, Unit, angle, plain_number, significant};
use super::page::{Cell, Figure, Section, Table};
use crate::results::machine::SpeedResults;
use crate::results::{CycleResults, degrees, degrees_around};
use serde_json::Value;
use sommerfeld_bearing::{RanIn, RunningInEnd, RunningInStep};

/// Depth per hour.
const DEPTH_RATE: Unit = Unit {
    symbol: "nm/h",
    factor: 1e9,
};
/// Volume per hour.
const VOLUME_RATE: Unit = Unit {
    symbol: "mm³/h",
    factor: 1e9,
};
const VOLUME: Unit = Unit {
    symbol: "mm³",
    factor: 1e9,
};
const PRESSURE_VELOCITY: Unit = Unit {
    symbol: "MW/m²",
    factor: 1e-6,
};
const ENERGY: Unit = Unit {
    symbol: "J/m²",
    factor: 1.0,
};
/// s
const HOUR: f64 = 3600.0;

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

fn row(label: &str, value: String) -> Vec<Cell> {
    vec![Cell::text(label), Cell::number(value)]
}

/// The table of a load cycle whose study asks for wear.
pub(super) fn table(cycle: &CycleResults) -> Option<Table> {
    let wear = cycle.shell_wear()?;
    let deepest = wear.deepest_per_hour()?;
    let place = if deepest.value > 0.0 {
        format!(
            "at {}, {} mm",
            angle(degrees_around(deepest.angle)),
            plain_number(1e3 * deepest.axial)
        )
    } else {
        "nothing wears".to_owned()
    };
    let mut rows = vec![
        row("Deepest wear of the shell", DEPTH_RATE.show(deepest.value)),
        row("its place", place),
        row(
            "Volume worn off the shell",
            VOLUME_RATE.show(wear.volume_per_hour()?),
        ),
        row(
            "Largest pressure times speed",
            PRESSURE_VELOCITY.show(largest(&wear.map.peak_pressure_velocity)),
        ),
        row(
            "Largest friction energy of asperities, per cycle",
            ENERGY.show(largest(&wear.friction_energy())),
        ),
    ];
    if let Some(ran) = &cycle.running_in {
        rows.extend(running_in_rows(ran));
    }
    Some(Table {
        title: "Wear",
        note: "Archard: depth = coefficient × contact pressure × way. The shell wears, the journal is \
               the harder surface."
            .to_owned(),
        rows,
        ..Table::default()
    })
}

fn running_in_rows(ran: &RanIn) -> Vec<Vec<Cell>> {
    let (Some(first), Some(last)) = (ran.steps.first(), ran.steps.last()) else {
        return Vec::new();
    };
    let ended = match ran.end {
        RunningInEnd::Settled => "the map of wear has settled",
        RunningInEnd::Faded => "the wear has faded",
        RunningInEnd::TimeOver => "the time given is over",
        RunningInEnd::StepLimit => "the steps given are used up",
        RunningInEnd::NotSolved(_) => "a load cycle was not solved",
    };
    let from_to = |value: fn(&RunningInStep) -> f64, unit: Unit| {
        format!("{} → {}", unit.show(value(first)), unit.show(value(last)))
    };
    let percent = Unit {
        symbol: "%",
        factor: 100.0,
    };
    vec![
        row(
            "Running-in before this cycle",
            format!(
                "{} h, {} steps",
                significant(ran.time / HOUR),
                ran.steps.len() - 1
            ),
        ),
        row("ended because", ended.to_owned()),
        row("Deepest place worn off", MICROMETRE.show(last.depth)),
        row("Volume worn off", VOLUME.show(last.volume)),
        row(
            "Wear rate over running-in",
            from_to(|step| HOUR * step.deepest_rate, DEPTH_RATE),
        ),
        row(
            "Roughness of the shell (rms)",
            from_to(|step| step.shell_roughness, MICROMETRE),
        ),
        row(
            "Minimum film thickness",
            from_to(|step| step.minimum_film_thickness, MICROMETRE),
        ),
        row(
            "Contact load share",
            from_to(|step| step.contact_share, percent),
        ),
    ]
}

/// How a shell ran in, for a load cycle before which it did.
pub(super) fn section(cycle: &CycleResults) -> Option<Section> {
    let ran = cycle.running_in.as_ref()?;
    if ran.steps.is_empty() {
        return None;
    }
    let figure = |kind, title, caption: &str| Figure {
        kind,
        title,
        caption: caption.to_owned(),
        size: "",
    };
    let place = deepest(ran).map_or_else(String::new, |(around, along)| {
        format!(
            " Deepest at {}, {} mm from the mid-plane.",
            angle(degrees_around(ran.angles[around])),
            plain_number(1e3 * ran.axial[along])
        )
    });
    let mut figures = vec![
        figure(
            "running-in-contact",
            "Contact over running-in",
            "Mean of what asperities carry over the mean load.",
        ),
        figure(
            "running-in-film",
            "Minimum film over running-in",
            "Thinnest film of the cycle, between the worn surfaces.",
        ),
        figure(
            "running-in-rate",
            "Wear rate over running-in",
            "Depth worn per hour at the place that wears fastest.",
        ),
        figure(
            "running-in-roughness",
            "Roughness over running-in",
            "rms of the shell: its summits wear to plateaus, down to 0.584 of the rms when all are gone.",
        ),
        figure(
            "worn-around",
            "Worn profile around",
            &format!("Bore of the shell before and after, through the deepest place.{place}"),
        ),
        figure(
            "worn-along",
            "Worn profile along the axis",
            "Bore of the shell before and after, through the same place.",
        ),
        figure(
            "shell-worn",
            "Worn off the shell",
            "Shell, angle from +X of the shell frame. Depth that running-in has worn off.",
        ),
    ];
    if let Some(map) = figures.last_mut() {
        map.size = "wide";
    }
    if deepest(ran).is_none() {
        figures.truncate(4);
    }
    Some(Section {
        id: "running-in",
        title: "Running-in",
        lead: format!(
            "The shell wore for {} h before the cycle that this page shows.",
            significant(ran.time / HOUR)
        ),
        figures,
    })
}

/// The cell that is worn deepest: its number around and along; none where nothing is worn.
fn deepest(ran: &RanIn) -> Option<(usize, usize)> {
    let cells = ran.depth.iter().enumerate();
    let (cell, depth) = cells.max_by(|a, b| a.1.total_cmp(b.1))?;
    (*depth > 0.0).then(|| (cell / ran.axial.len(), cell % ran.axial.len()))
}

/// The charts of that section, by their kind.
pub(super) fn charts(cycle: &CycleResults, detail: &Detail, charts: &mut Value) {
    let Some(ran) = cycle
        .running_in
        .as_ref()
        .filter(|ran| !ran.steps.is_empty())
    else {
        return;
    };
    let hours: Vec<f64> = ran.steps.iter().map(|step| step.time / HOUR).collect();
    let over = |y_title: &str, value: &dyn Fn(&RunningInStep) -> f64| {
        let y: Vec<f64> = ran.steps.iter().map(value).collect();
        let top = 1.08 * largest(&y);
        let series = vec![Series {
            name: y_title.split(" [").next().unwrap_or(y_title).to_owned(),
            x: Some(hours.clone()),
            y,
            mark: Mark::Line,
        }];
        let chart = Chart {
            x_title: "Time of running-in [h]".to_owned(),
            y_title: y_title.to_owned(),
            y_range: (top > 0.0).then_some([0.0, top]),
            series,
        };
        chart.data(detail)
    };
    charts["running-in-contact"] =
        over("Contact load share [%]", &|step| 100.0 * step.contact_share);
    charts["running-in-film"] = over("Film thickness [µm]", &|step| {
        1e6 * step.minimum_film_thickness
    });
    charts["running-in-rate"] = over("Wear rate [nm/h]", &|step| {
        DEPTH_RATE.factor * HOUR * step.deepest_rate
    });
    charts["running-in-roughness"] =
        over("Roughness, rms [µm]", &|step| 1e6 * step.shell_roughness);
    if let Some(place) = deepest(ran) {
        profiles(cycle, ran, place, detail, charts);
    }
}

/// The bore before and after, around and along through its deepest place.
fn profiles(
    cycle: &CycleResults,
    ran: &RanIn,
    (around, along): (usize, usize),
    detail: &Detail,
    charts: &mut Value,
) {
    let worn = |i: usize, j: usize| ran.depth[i * ran.axial.len() + j];
    let after = |i: usize, j: usize| 1e6 * cycle.bearing.bore.offset(ran.angles[i], ran.axial[j]);
    let before = |i: usize, j: usize| after(i, j) - 1e6 * worn(i, j);
    let chart = |x_title: &str, x: Vec<f64>, before: Vec<f64>, after: Vec<f64>| {
        let series = [("before", before), ("after", after)].map(|(name, y)| Series {
            name: name.to_owned(),
            x: Some(x.clone()),
            y,
            mark: Mark::Line,
        });
        Chart {
            x_title: x_title.to_owned(),
            y_title: "Bore, outwards [µm]".to_owned(),
            y_range: None,
            series: series.to_vec(),
        }
        .data(detail)
    };
    // The deepest place in the middle, half a turn to both sides.
    let middle = degrees_around(ran.angles[around]);
    let unrolled = |i: usize| {
        let apart = degrees_around(ran.angles[i]) - middle;
        middle + (apart + 180.0).rem_euclid(360.0) - 180.0
    };
    let mut order: Vec<usize> = (0..ran.angles.len()).collect();
    order.sort_by(|a, b| unrolled(*a).total_cmp(&unrolled(*b)));
    charts["worn-around"] = chart(
        "Bearing angle [°]",
        order.iter().map(|i| unrolled(*i)).collect(),
        order.iter().map(|i| before(*i, along)).collect(),
        order.iter().map(|i| after(*i, along)).collect(),
    );
    let places = 0..ran.axial.len();
    charts["worn-along"] = chart(
        "Axial position [mm]",
        ran.axial.iter().map(|z| 1e3 * z).collect(),
        places.clone().map(|j| before(around, j)).collect(),
        places.map(|j| after(around, j)).collect(),
    );
}

/// Wear of every bearing of a machine at one speed, where the study asks for it.
pub(super) fn machine_table(speed: &SpeedResults) -> Option<Table> {
    let touching = speed.bearings.iter();
    let rows: Vec<Vec<Cell>> = touching
        .filter_map(|bearing| {
            let wear = bearing.cycle.shell_wear()?;
            let deepest = wear.deepest_per_hour()?;
            let place = if deepest.value > 0.0 {
                format!(
                    "{}, {} mm",
                    angle(degrees_around(deepest.angle)),
                    plain_number(1e3 * deepest.axial)
                )
            } else {
                "–".to_owned()
            };
            let percent = Unit {
                symbol: "%",
                factor: 100.0,
            };
            let hardest = bearing.cycle.peak_contact_pressure();
            let hardest = hardest.filter(|p| p.summary.peak_contact_pressure.value > 0.0);
            let at =
                hardest.map_or_else(|| "–".to_owned(), |point| angle(degrees(point.crank_angle)));
            Some(vec![
                Cell::text(bearing.name.clone()),
                Cell::number(DEPTH_RATE.show(deepest.value)),
                Cell::number(place),
                Cell::number(VOLUME_RATE.show(wear.volume_per_hour()?)),
                Cell::number(PRESSURE_VELOCITY.show(largest(&wear.map.peak_pressure_velocity))),
                Cell::number(ENERGY.show(largest(&wear.friction_energy()))),
                Cell::number(percent.show(bearing.cycle.contact_load_share())),
                Cell::number(at),
            ])
        })
        .collect();
    (!rows.is_empty()).then(|| Table {
        title: "Wear of every bearing",
        note: "Of the shell, in an hour of such cycles (Archard). Where: bearing angle, axial position \
               from the mid-plane. Contact share: what asperities carry over the mean load."
            .to_owned(),
        columns: vec![
            "Bearing",
            "Deepest wear",
            "Where",
            "Volume",
            "Pressure × speed",
            "Friction energy",
            "Contact share",
            "Hardest contact at",
        ],
        rows,
        size: "wide",
    })
}
