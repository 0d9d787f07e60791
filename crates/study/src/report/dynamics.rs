//! Tables and data of what a rotor feels of the film: coefficients with tilt, whirl, chart over speed.

use super::figures::short;
use super::format::{angle, significant};
use super::page::{Cell, Figure, Section, Table};
use crate::results::{
    CycleResults, Dynamics, SteadyResults, degrees, rpm, stability_name, status_name,
};
use serde_json::{Value, json};
use sommerfeld_bearing::StabilityChart;
use sommerfeld_film::Outcome;

const ROWS: [&str; 4] = [
    "Force x [N]",
    "Force y [N]",
    "Moment x [N·m]",
    "Moment y [N·m]",
];

/// The tables of a steady state: coefficients along the load and with tilt, whirl, chart.
pub(super) fn tables(steady: &SteadyResults) -> Vec<Table> {
    let Some(dynamics) = &steady.dynamics else {
        return Vec::new();
    };
    let mut tables = coefficients(steady, dynamics);
    tables.push(whirl(dynamics, steady.state.journal_speed));
    tables.extend(dynamics.chart.as_ref().map(chart));
    tables
}

/// Stiffness and damping, x along the load where there is one; with tilt where the film has it.
fn coefficients(steady: &SteadyResults, dynamics: &Dynamics) -> Vec<Table> {
    let (found, frame) = match steady.load_angle() {
        Some(angle) => (
            dynamics.coefficients.turned(angle),
            "x along the load, y 90° ahead of it in the sense of rotation",
        ),
        None => (dynamics.coefficients, "shell frame"),
    };
    let size = if dynamics.has_tilt { 4 } else { 2 };
    let table = |title, note: &str, units: [&'static str; 4], matrix: &[[f64; 4]; 4]| {
        let rows = (0..size).map(|row| {
            let values = matrix[row][..size].iter();
            std::iter::once(Cell::text(ROWS[row]))
                .chain(values.map(|value| Cell::number(significant(*value))))
                .collect()
        });
        Table {
            title,
            note: format!("{note}; {frame}."),
            columns: std::iter::once("per")
                .chain(units[..size].iter().copied())
                .collect(),
            rows: rows.collect(),
            size: "wide",
        }
    };
    vec![
        table(
            "Stiffness along the load",
            "−∂(force, moment)/∂(position, tilt)",
            ["x [m]", "y [m]", "tilt x [rad]", "tilt y [rad]"],
            &found.stiffness,
        ),
        table(
            "Damping along the load",
            "−∂(force, moment)/∂(velocity, tilt rate)",
            ["x [m/s]", "y [m/s]", "tilt x [rad/s]", "tilt y [rad/s]"],
            &found.damping,
        ),
    ]
}

fn whirl(dynamics: &Dynamics, journal_speed: f64) -> Table {
    let mut rows = vec![("Rigid rotor", stability_name(dynamics.stability).to_owned())];
    if let Some(threshold) = dynamics.stability.threshold() {
        let ratio = threshold.whirl_speed / journal_speed.abs();
        rows.push((
            "Threshold mass",
            format!("{} kg", significant(threshold.mass)),
        ));
        rows.push((
            "Whirl speed on the threshold",
            format!("{} rpm", significant(rpm(threshold.whirl_speed))),
        ));
        rows.push(("Whirl speed over journal speed", significant(ratio)));
    }
    if let Some(mass) = dynamics.rotor_mass {
        let is_stable = dynamics.stability.is_stable(mass);
        rows.push((
            "Rotor mass on this bearing",
            format!("{} kg", significant(mass)),
        ));
        let word = if is_stable {
            "stable"
        } else {
            "unstable: it whirls"
        };
        rows.push(("This rotor", word.to_owned()));
        let margin = dynamics.stability.margin(mass);
        rows.push((
            "Margin: threshold mass over rotor mass",
            significant(margin),
        ));
    }
    for onset in dynamics.chart.iter().flat_map(|chart| &chart.onsets) {
        let side = if onset.is_unstable_above {
            "above"
        } else {
            "below"
        };
        let speed = significant(rpm(onset.journal_speed));
        rows.push(("Onset of whirl", format!("unstable {side} {speed} rpm")));
    }
    Table {
        title: "Whirl of a rigid rotor",
        note: "Largest mass per bearing at which small motions still decay, at this speed. The \
               rotor is rigid, symmetric, and its tilt is held."
            .into(),
        rows: rows
            .into_iter()
            .map(|(label, text)| vec![Cell::text(label), Cell::number(text)])
            .collect(),
        ..Table::default()
    }
}

fn chart(chart: &StabilityChart) -> Table {
    let row = |point: &sommerfeld_bearing::SpeedPoint| {
        let threshold = point.stability.threshold();
        let mass = threshold.map_or_else(
            || stability_name(point.stability).to_owned(),
            |threshold| format!("{} kg", significant(threshold.mass)),
        );
        let ratio = threshold.map_or_else(String::new, |threshold| {
            significant(threshold.whirl_speed / point.journal_speed.abs())
        });
        let is_solved = point.outcome == Outcome::Converged;
        let shown = |text: String| Cell::number(if is_solved { text } else { "n/a".into() });
        vec![
            Cell::number(format!("{} rpm", significant(rpm(point.journal_speed)))),
            shown(mass),
            shown(ratio),
            Cell::outcome(point.outcome),
        ]
    };
    Table {
        title: "Stability over speed",
        note: "Load, oil and clearance as at the speed above. More columns in stability.csv."
            .into(),
        columns: vec!["Journal speed", "Threshold mass", "Whirl ratio", "Status"],
        rows: chart.points.iter().map(row).collect(),
        ..Table::default()
    }
}

/// The section of the chart, if there is one.
pub(super) fn section(steady: &SteadyResults) -> Option<Section> {
    let chart = steady.dynamics.as_ref()?.chart.as_ref()?;
    (chart.points.len() > 1).then(|| Section {
        id: "stability",
        title: "Stability over speed",
        lead: String::new(),
        figures: vec![Figure {
            kind: "stability",
            title: "Whirl threshold over speed",
            caption: "Largest mass per bearing at which a rigid rotor is stable. Dashed: the \
                      rotor of the study; dotted: the speed where it begins to whirl. No point \
                      where there is no threshold."
                .into(),
            size: "wide",
        }],
    })
}

/// Data of that figure: speeds and onsets in rpm, masses in kg.
pub(super) fn chart_data(steady: &SteadyResults) -> Value {
    let Some(dynamics) = &steady.dynamics else {
        return Value::Null;
    };
    let Some(chart) = &dynamics.chart else {
        return Value::Null;
    };
    let mass = |point: &sommerfeld_bearing::SpeedPoint| {
        let threshold = point.stability.threshold();
        short(threshold.map_or(f64::NAN, |threshold| threshold.mass))
    };
    let onsets = chart.onsets.iter().map(|onset| {
        let speed = rpm(onset.journal_speed);
        json!({ "speed": short(speed), "label": format!("onset {} rpm", significant(speed)) })
    });
    json!({
        "speed": chart.points.iter().map(|p| short(rpm(p.journal_speed))).collect::<Value>(),
        "mass": chart.points.iter().map(mass).collect::<Value>(),
        "rotor": dynamics.rotor_mass.map(short),
        "onsets": onsets.collect::<Value>(),
    })
}

/// Stiffness and damping at the crank angles asked for.
pub(super) fn instants(cycle: &CycleResults) -> Option<Table> {
    let rows = cycle
        .coefficients
        .iter()
        .flat_map(|found| {
            let stiffness = found.coefficients.translation_stiffness();
            let damping = found.coefficients.translation_damping();
            [0, 1].map(|axis| {
                let values = stiffness[axis].iter().chain(&damping[axis]);
                let mut row = vec![
                    Cell::number(angle(degrees(found.crank_angle))),
                    Cell::text(["Force x", "Force y"][axis]),
                ];
                row.extend(values.map(|value| Cell::number(significant(*value))));
                row.push(Cell::text(status_name(found.outcome)));
                row
            })
        })
        .collect();
    (!cycle.coefficients.is_empty()).then(|| Table {
        title: "Stiffness and damping at crank angles",
        note: "−∂F/∂position and −∂F/∂velocity in the shell frame, for the film content of that \
               instant. Along the load, and with tilt where the film has it, in summary.json."
            .into(),
        columns: vec![
            "Crank angle",
            "",
            "Stiffness x [N/m]",
            "y [N/m]",
            "Damping x [N·s/m]",
            "y [N·s/m]",
            "Status",
        ],
        rows,
        size: "wide",
    })
}
