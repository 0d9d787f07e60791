//! `summary.json`: the numbers of a run in SI, the unit in the key, keys that stay.
//!
//! Numbers that are not finite become `null`: JSON has no word for them.

mod databases;
mod mixed;

use databases::{database_keys, looked_up};
use mixed::{contact_keys, heat_keys, wear_keys};

use super::machine::{rounded_rpm, status_of};
use super::{OutputError, ResultWriter};
use crate::cases::{CaseStatus, SweepResults};
use crate::limits::LimitCheck;
use crate::models::Model;
use crate::oil_holes::{OilHole, oil_holes};
use crate::results::machine::{BearingResults, MachineResults, SpeedResults};
use crate::results::{
    Body, CycleResults, DimensionlessResults, Dynamics, Header, InstantCoefficients, ModelEnd,
    ModelRun, PROGRAM, PlainRun, Results, SCHEMA, SteadyResults, VERSION, degrees, film_parameter,
    magnitude, specific_load, stability_name, status_name,
};
use serde_json::{Map, Value, json};
use sommerfeld_bearing::Coefficients;
use sommerfeld_film::FeedFlow;
use std::collections::{BTreeMap, HashSet};

/// Writes `summary.json`.
#[derive(Debug, Clone, Copy)]
pub struct SummaryJson;

impl ResultWriter for SummaryJson {
    fn file_name(&self) -> &'static str {
        "summary.json"
    }

    fn describe(&self) -> &'static str {
        "status and key numbers, SI with the unit in the key"
    }

    fn content(&self, results: &Results) -> Result<Option<Vec<u8>>, OutputError> {
        let mut text =
            serde_json::to_vec_pretty(&summary(results)).map_err(|error| OutputError::Content {
                file: self.file_name(),
                reason: error.to_string(),
            })?;
        text.push(b'\n');
        Ok(Some(text))
    }
}

/// The summary of a run as a JSON object.
#[must_use]
pub fn summary(results: &Results) -> Value {
    let mut object = header(&results.header);
    let body = match &results.body {
        Body::Steady(steady) => steady_keys(steady),
        Body::LoadCycle(cycle) => cycle_keys(cycle),
        Body::Dimensionless(integrals) => dimensionless_keys(integrals),
        Body::Machine(machine) => machine_keys(machine, &results.header.limits),
        Body::Database(database) => database_keys(database),
        Body::Sweep(sweep) => sweep_keys(sweep),
    };
    if let Value::Object(body) = body {
        object.extend(body);
    }
    if let Some(heat) = &results.header.heat {
        object.extend(heat_keys(heat));
    }
    if !results.header.databases.is_empty() {
        object.insert("databases".into(), looked_up(&results.header.databases));
    }
    if let Some(compared) = comparison(&results.header, &object) {
        object.insert("comparison".into(), compared);
    }
    if let Some(grid) = results.header.grid {
        object.insert("grid".into(), json!(grid));
    }
    if let Some(error) = &results.header.error {
        object.insert("error".into(), nested(error));
    }
    if !results.header.limits.is_empty() {
        let limits = results.header.limits.iter().map(limit).collect();
        object.insert("limits".into(), Value::Array(limits));
    }
    Value::Object(object)
}

/// Keys of a summary that a plain run repeats: of a steady state, of a load cycle.
const COMPARED: &[&str] = &[
    "minimum_film_thickness_m",
    "peak_film_pressure_pa",
    "power_loss_w",
    "mean_power_loss_w",
    "side_flow_m3_s",
    "mean_side_flow_m3_s",
    "relative_eccentricity",
    "mean_relative_eccentricity",
    "friction_coefficient",
    "stiffness_n_m",
    "damping_n_s_m",
];

/// The study run once more with plain surfaces and oil, and with other film models; `own` holds the
/// study's own figures.
fn comparison(header: &Header, own: &Map<String, Value>) -> Option<Value> {
    let mut all = Map::new();
    if let Some(plain) = &header.plain {
        all.insert("plain".into(), plain_keys(plain));
    }
    if let Some(compared) = &header.comparison {
        all.insert("own_model".into(), json!(compared.own_model));
        all.insert("own_wall_time_s".into(), json!(compared.own_wall_time));
        let runs = compared.runs.iter();
        all.extend(runs.map(|run| (run.model.to_owned(), model_keys(run, own))));
    }
    (!all.is_empty()).then_some(Value::Object(all))
}

/// The plain run under the keys of the study's own figures.
fn plain_keys(plain: &PlainRun) -> Value {
    let mut keys = json!({
        "status": status_name(plain.status),
        "temperature_degc": plain.temperature - 273.15,
        "wall_time_s": plain.wall_time,
    });
    if let Value::Object(keys) = &mut keys {
        keys.extend(compared_keys(plain.body.as_ref()));
    }
    keys
}

/// The run of another model under the keys of the study's own figures, and how far it is from them.
fn model_keys(run: &ModelRun, own: &Map<String, Value>) -> Value {
    let mut keys = json!({
        "status": run.end.name(),
        "wall_time_s": run.wall_time,
        "notes": run.notes,
    });
    if let ModelEnd::Refused(reason) = &run.end {
        keys["reason"] = json!(reason);
    }
    let found = compared_keys(run.body.as_ref());
    let change = |(key, value): (&String, &Value)| {
        let share = value.as_f64()? / own.get(key)?.as_f64()? - 1.0;
        Some((key.clone(), json!(100.0 * share)))
    };
    let changes: Map<String, Value> = found.iter().filter_map(change).collect();
    if let Value::Object(keys) = &mut keys {
        keys.extend(found);
        if !changes.is_empty() {
            keys.insert("difference_percent".into(), Value::Object(changes));
        }
    }
    keys
}

fn compared_keys(body: Option<&Body>) -> Map<String, Value> {
    let found = match body {
        Some(Body::Steady(steady)) => as_map(steady_keys(steady)),
        Some(Body::LoadCycle(cycle)) => as_map(cycle_keys(cycle)),
        _ => Map::new(),
    };
    let compared = found.into_iter();
    compared
        .filter(|(key, _)| COMPARED.contains(&key.as_str()))
        .collect()
}

/// The first speed at the top, every speed in a list of its own.
fn machine_keys(machine: &MachineResults, limits: &[LimitCheck]) -> Value {
    let mut keys = json!({ "load_model": machine.load_model });
    let speeds: Vec<Value> = machine
        .speeds
        .iter()
        .map(|speed| speed_keys(speed, limits))
        .collect();
    if let (Value::Object(keys), Some(Value::Object(first))) = (&mut keys, speeds.first()) {
        // The status at the top is that of all speeds.
        keys.extend(
            first
                .iter()
                .filter(|(key, _)| *key != "status")
                .map(|(key, value)| (key.clone(), value.clone())),
        );
    }
    keys["speeds"] = Value::Array(speeds);
    keys
}

/// A machine at one speed.
fn speed_keys(speed: &SpeedResults, limits: &[LimitCheck]) -> Value {
    let mut keys = json!({
        "speed_rpm": rounded_rpm(speed.speed),
        "status": status_name(speed.outcome),
    });
    if let Some(performance) = &speed.performance {
        keys["imep_pa"] = json!(performance.indicated_mean_effective_pressure);
        keys["mean_torque_n_m"] = json!(performance.mean_torque);
        keys["swept_volume_m3"] = json!(performance.swept_volume);
    }
    if let Some(lost) = speed.friction_mean_effective_pressure {
        keys["friction_mean_effective_pressure_pa"] = json!(lost);
    }
    let total: f64 = speed
        .bearings
        .iter()
        .map(|bearing| bearing.cycle.mean(|point| point.summary.power_loss()))
        .sum();
    keys["mean_power_loss_w"] = json!(total);
    if let Some(torsion) = &speed.torsion {
        keys["natural_frequencies_hz"] = json!(torsion.natural_frequencies);
    }
    let bearings = speed.bearings.iter();
    keys["bearings"] = bearings
        .map(|bearing| bearing_keys(bearing, limits))
        .collect();
    keys
}

/// One bearing at one speed: the keys of a load cycle and its place.
fn bearing_keys(bearing: &BearingResults, limits: &[LimitCheck]) -> Value {
    let mut keys = json!({
        "name": bearing.name,
        "role": bearing.role.name(),
        "status": status_of(bearing),
    });
    if let Some(first) = &bearing.turned_from {
        keys["computed_as"] = json!(first.to_string());
    }
    if let (Value::Object(keys), Value::Object(cycle)) = (&mut keys, cycle_keys(&bearing.cycle)) {
        keys.extend(cycle);
        keys.extend(bearing.heat.iter().flat_map(heat_keys));
    }
    if !limits.is_empty() {
        let checks = limits.iter().map(|check| bearing.check(&check.limit));
        keys["limits"] = checks.map(|check| limit(&check)).collect();
    }
    keys
}

fn as_map(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

fn header(header: &Header) -> Map<String, Value> {
    let mut object = Map::new();
    let mut insert = |key: &str, value: Value| {
        object.insert(key.into(), value);
    };
    insert("schema", json!(SCHEMA));
    insert("program", json!(PROGRAM));
    insert("version", json!(VERSION));
    insert("analysis", json!(header.analysis));
    insert("title", json!(header.title));
    insert("status", json!(status_name(header.status)));
    insert("messages", json!(header.messages));
    insert(
        "models",
        Value::Array(header.models.iter().map(model).collect()),
    );
    insert("wall_time_s", json!(header.wall_time));
    if let Some(hash) = &header.study_hash {
        insert("study_hash", json!(hash));
    }
    object
}

fn model(model: &Model) -> Value {
    json!({
        "family": model.family,
        "name": model.name,
        "description": model.description,
        "reference": model.reference,
        "doi": model.doi,
    })
}

fn limit(check: &LimitCheck) -> Value {
    let unit = check.limit.quantity.unit_suffix();
    let mut object = Map::new();
    object.insert("name".into(), json!(check.limit.quantity.key()));
    object.insert(format!("limit_{unit}"), json!(check.limit.value));
    object.insert(format!("value_{unit}"), json!(check.found));
    object.insert("verdict".into(), json!(check.verdict));
    object.insert("source".into(), json!(check.limit.source));
    if let Some(at) = &check.at {
        object.insert("at".into(), json!(at));
    }
    Value::Object(object)
}

fn steady_keys(steady: &SteadyResults) -> Value {
    let summary = &steady.summary;
    let mut keys = json!({
        "force_n": steady.reaction.force(),
        "moment_n_m": steady.reaction.moment(),
        "relative_eccentricity": steady.relative_eccentricity(),
        "line_of_centres_angle_deg": degrees(steady.state.line_of_centres_angle()),
        "attitude_angle_deg": steady.attitude_angle().map(degrees),
        "sommerfeld_number": steady.sommerfeld_number,
        "specific_load_pa": steady.specific_load(),
        "minimum_film_thickness_m": summary.minimum_film_thickness.value,
        "peak_film_pressure_pa": summary.peak_film_pressure.value,
        "friction_torque_journal_n_m": steady.reaction.friction_torque_journal,
        "friction_torque_shell_n_m": steady.reaction.friction_torque_shell,
        "power_loss_w": summary.power_loss(),
        "side_flow_m3_s": summary.side_flow[0] + summary.side_flow[1],
        "side_flow_front_m3_s": summary.side_flow[0],
        "side_flow_rear_m3_s": summary.side_flow[1],
        "feed_flow_m3_s": summary.feed_flow,
        "groove_flows_m3_s": steady.feed_flows.iter().map(|feed| feed.flow).collect::<Vec<_>>(),
        "groove_pressures_pa":
            steady.feed_flows.iter().map(|feed| feed.pressure).collect::<Vec<_>>(),
        "full_film_share": summary.full_film_share,
        "reynolds_number": summary.reynolds_number,
        "mass_balance_relative": summary.mass_balance_relative,
        "complementarity_violation": summary.complementarity_violation,
        "iterations": steady.iterations,
    });
    let optional = [
        ("load_n", steady.load.map(|load| json!(load))),
        (
            "friction_coefficient",
            steady.friction_coefficient().map(|found| json!(found)),
        ),
        (
            "film_parameter",
            film_parameter(&steady.bearing, summary.minimum_film_thickness.value)
                .map(|found| json!(found)),
        ),
        (
            "stiffness_n_m",
            steady.stiffness.map(|matrix| json!(matrix)),
        ),
        ("damping_n_s_m", steady.damping.map(|matrix| json!(matrix))),
    ];
    for (key, value) in optional {
        if let Some(value) = value {
            keys[key] = value;
        }
    }
    if let (true, Value::Object(keys)) = (steady.bearing.finish.has_contact(), &mut keys) {
        let contact = contact_keys(
            Some(summary.peak_contact_pressure.value),
            steady.contact_load_share(),
            [
                summary.boundary_power,
                summary.friction_power,
                summary.squeeze_power,
            ],
        );
        keys.extend(as_map(contact));
    }
    let [front, rear] = summary.edge_film_thickness;
    keys["minimum_edge_film_front_m"] = json!(front);
    keys["minimum_edge_film_rear_m"] = json!(rear);
    if let (Some(dynamics), Value::Object(keys)) = (&steady.dynamics, &mut keys) {
        let found = &dynamics.coefficients;
        let load_angle = steady.load_angle();
        keys.extend(coefficient_keys(found, dynamics.has_tilt, load_angle));
        keys.extend(stability_keys(dynamics, steady.state.journal_speed));
    }
    keys
}

/// Stiffness and damping beyond the plain ones of the shell frame: turned to the load, and with tilt
/// where the film has it.
fn coefficient_keys(
    found: &Coefficients,
    has_tilt: bool,
    load_angle: Option<f64>,
) -> Map<String, Value> {
    let mut keys = Map::new();
    let turned = load_angle.map(|angle| found.turned(angle));
    if let Some(turned) = &turned {
        let (stiffness, damping) = (turned.translation_stiffness(), turned.translation_damping());
        keys.insert("stiffness_load_frame_n_m".into(), json!(stiffness));
        keys.insert("damping_load_frame_n_s_m".into(), json!(damping));
    }
    if has_tilt {
        keys.insert("stiffness_4x4".into(), json!(found.stiffness));
        keys.insert("damping_4x4".into(), json!(found.damping));
        if let Some(turned) = &turned {
            keys.insert("stiffness_4x4_load_frame".into(), json!(turned.stiffness));
            keys.insert("damping_4x4_load_frame".into(), json!(turned.damping));
        }
        // Rows: force, moment; columns: position, tilt, or their rates. One unit per 2x2 block.
        let units = json!({
            "stiffness": [["N/m", "N/rad"], ["N m/m", "N m/rad"]],
            "damping": [["N s/m", "N s/rad"], ["N m s/m", "N m s/rad"]],
        });
        keys.insert("units_4x4".into(), units);
    }
    keys
}

/// Whirl of a rigid rotor. A threshold that is not there is `null`; `whirl_threshold` says why.
fn stability_keys(dynamics: &Dynamics, journal_speed: f64) -> Map<String, Value> {
    let threshold = dynamics.stability.threshold();
    let ratio = threshold.map(|threshold| threshold.whirl_speed / journal_speed.abs());
    let mut keys = Map::new();
    keys.insert(
        "whirl_threshold".into(),
        json!(stability_name(dynamics.stability)),
    );
    keys.insert(
        "whirl_threshold_mass_kg".into(),
        json!(threshold.map(|threshold| threshold.mass)),
    );
    keys.insert(
        "whirl_speed_rad_s".into(),
        json!(threshold.map(|threshold| threshold.whirl_speed)),
    );
    keys.insert("whirl_ratio".into(), json!(ratio));
    if let Some(mass) = dynamics.rotor_mass {
        keys.insert("rotor_mass_kg".into(), json!(mass));
        keys.insert("stable".into(), json!(dynamics.stability.is_stable(mass)));
        let margin = dynamics.stability.margin(mass);
        keys.insert("stability_margin".into(), json!(margin));
    }
    if let Some(chart) = &dynamics.chart {
        let onsets = chart.onsets.iter().map(|onset| {
            json!({
                "journal_speed_rad_s": onset.journal_speed,
                "whirl_speed_rad_s": onset.whirl_speed,
                "unstable": if onset.is_unstable_above { "above" } else { "below" },
            })
        });
        keys.insert("whirl_onsets".into(), onsets.collect());
    }
    keys
}

fn instant(found: &InstantCoefficients) -> Value {
    let matrices = &found.coefficients;
    let mut keys = json!({
        "crank_angle_deg": degrees(found.crank_angle),
        "status": status_name(found.outcome),
        "stiffness_n_m": matrices.translation_stiffness(),
        "damping_n_s_m": matrices.translation_damping(),
    });
    let [x, y] = found.load;
    let load_angle = (found.load != [0.0; 2]).then(|| y.atan2(x));
    if let Value::Object(keys) = &mut keys {
        keys.extend(coefficient_keys(matrices, found.has_tilt, load_angle));
    }
    keys
}

fn cycle_keys(cycle: &CycleResults) -> Value {
    let orbit = &cycle.orbit;
    let thinnest = cycle.minimum_film_thickness();
    let peak = cycle.peak_film_pressure();
    let heaviest = cycle.maximum_load();
    let worst = |value: fn(&sommerfeld_film::FilmSummary) -> f64| {
        cycle
            .largest(|point| value(&point.summary))
            .map(|point| value(&point.summary))
    };
    let grooves = |value: fn(&FeedFlow) -> f64| -> Vec<f64> {
        (0..cycle.bearing.feeds.len())
            .map(|feed| cycle.mean_of_feed(feed, value))
            .collect()
    };
    let edge = |edge: usize| cycle.thinnest_edge(edge);
    let edge_film = |index: usize| edge(index).map(|p| p.summary.edge_film_thickness[index]);
    let moment = cycle.largest(|point| magnitude(point.moment));
    let mut keys = json!({
        "minimum_edge_film_front_m": edge_film(0),
        "minimum_edge_film_front_angle_deg": edge(0).map(|p| degrees(p.crank_angle)),
        "minimum_edge_film_rear_m": edge_film(1),
        "minimum_edge_film_rear_angle_deg": edge(1).map(|p| degrees(p.crank_angle)),
        "maximum_applied_moment_n_m": moment.map(|p| magnitude(p.moment)),
        "maximum_applied_moment_angle_deg": moment.map(|p| degrees(p.crank_angle)),
        "minimum_film_thickness_m": thinnest.map(|p| p.summary.minimum_film_thickness.value),
        "minimum_film_thickness_angle_deg": thinnest.map(|p| degrees(p.crank_angle)),
        "peak_film_pressure_pa": peak.map(|p| p.summary.peak_film_pressure.value),
        "peak_film_pressure_angle_deg": peak.map(|p| degrees(p.crank_angle)),
        "maximum_load_n": heaviest.map(|p| magnitude(p.load)),
        "maximum_load_angle_deg": heaviest.map(|p| degrees(p.crank_angle)),
        "maximum_specific_load_pa": heaviest.map(|p| specific_load(&cycle.bearing, p.load)),
        "mean_power_loss_w": cycle.mean(|p| p.summary.power_loss()),
        "mean_friction_power_w": cycle.mean(|p| p.summary.friction_power),
        "mean_squeeze_power_w": cycle.mean(|p| p.summary.squeeze_power),
        "mean_side_flow_m3_s": cycle.mean(|p| p.summary.side_flow[0] + p.summary.side_flow[1]),
        "mean_side_flow_front_m3_s": cycle.mean(|p| p.summary.side_flow[0]),
        "mean_side_flow_rear_m3_s": cycle.mean(|p| p.summary.side_flow[1]),
        "mean_feed_flow_m3_s": cycle.mean(|p| p.summary.feed_flow),
        "mean_groove_flows_m3_s": grooves(|feed| feed.flow),
        "mean_groove_pressures_pa": grooves(|feed| feed.pressure),
        "oil_holes": oil_holes(cycle).iter().map(oil_hole).collect::<Vec<_>>(),
        "mean_relative_eccentricity": cycle.mean(|p| cycle.relative_eccentricity(p)),
        "cycle_closure": orbit.closure,
        "cycles": orbit.cycles,
        "steps": orbit.steps,
        "film_solves": orbit.film_solves,
        "points_not_converged": cycle.not_converged().count(),
        "mass_balance_relative": worst(|summary| summary.mass_balance_relative),
        "complementarity_violation": worst(|summary| summary.complementarity_violation),
    });
    if let (true, Value::Object(keys)) = (cycle.bearing.finish.has_contact(), &mut keys) {
        let contact = cycle.peak_contact_pressure();
        keys.extend(as_map(contact_keys(
            contact.map(|p| p.summary.peak_contact_pressure.value),
            cycle.contact_load_share(),
            [
                cycle.mean(|p| p.summary.boundary_power),
                cycle.mean(|p| p.summary.friction_power),
                cycle.mean(|p| p.summary.squeeze_power),
            ],
        )));
        let angle = contact.map(|p| degrees(p.crank_angle));
        keys.insert("peak_contact_pressure_angle_deg".into(), json!(angle));
    }
    if let Value::Object(keys) = &mut keys {
        keys.extend(wear_keys(cycle));
    }
    if let Some(least) = thinnest
        .and_then(|p| film_parameter(&cycle.bearing, p.summary.minimum_film_thickness.value))
    {
        keys["film_parameter"] = json!(least);
    }
    if !cycle.coefficients.is_empty() {
        keys["coefficients"] = cycle.coefficients.iter().map(instant).collect();
    }
    keys
}

/// A feed of the journal over the cycle; grooves count from 1, as in `cycle.csv`.
fn oil_hole(hole: &OilHole) -> Value {
    let ranges = |ranges: &[[f64; 2]]| -> Vec<[f64; 2]> {
        ranges.iter().map(|range| range.map(degrees)).collect()
    };
    json!({
        "groove": hole.feed + 1,
        "mean_flow_m3_s": hole.mean_flow,
        "minimum_flow_m3_s": hole.minimum_flow[0],
        "minimum_flow_angle_deg": degrees(hole.minimum_flow[1]),
        "maximum_flow_m3_s": hole.maximum_flow[0],
        "maximum_flow_angle_deg": degrees(hole.maximum_flow[1]),
        "backflow_deg": ranges(&hole.backflow),
        "backflow_share": hole.backflow_share,
        "facing_groove_deg": ranges(&hole.facing),
        "facing_groove_share": hole.facing_share,
    })
}

fn dimensionless_keys(integrals: &DimensionlessResults) -> Value {
    json!({
        "integrals": {
            "p_cos": integrals.p_cos,
            "p_sin": integrals.p_sin,
            "p_z_cos": integrals.p_z_cos,
            "p_z_sin": integrals.p_z_sin,
            "peak": integrals.peak,
        }
    })
}

fn sweep_keys(sweep: &SweepResults) -> Value {
    let varied: Vec<Value> = (sweep.varied.iter().enumerate())
        .map(|(at, column)| {
            let mut seen = HashSet::new();
            let values = sweep.cases.iter().filter_map(|row| row.inputs.get(at));
            let values: Vec<&String> = values.filter(|value| seen.insert(*value)).collect();
            json!({ "key": column.key, "unit": column.unit, "values": values })
        })
        .collect();
    let mut extremes = Map::new();
    for (at, column) in sweep.columns.iter().enumerate() {
        if let Some(found) = sweep.extremes(at) {
            let [low, high] =
                found.map(|(row, value)| json!({ "value": value, "case": row.number }));
            let both = json!({ "minimum": low, "maximum": high });
            extremes.insert(column.key.clone(), both);
        }
    }
    let limits: Vec<Value> = (sweep.limits.iter().enumerate())
        .map(|(at, name)| {
            let count = |verdict: &str| {
                let limits = sweep
                    .cases
                    .iter()
                    .filter_map(|row| SweepResults::limit(row, at));
                limits.filter(|limit| limit.verdict == verdict).count()
            };
            json!({
                "name": name, "ok": count("ok"), "exceeded": count("exceeded"),
                "not_evaluated": count("not-evaluated"),
            })
        })
        .collect();
    let bad = sweep
        .cases
        .iter()
        .filter(|row| row.status != CaseStatus::Converged);
    let bad: Vec<Value> = bad
        .map(|row| {
            let keys = sweep.varied.iter().map(|column| column.key.clone());
            let inputs: Map<String, Value> = keys
                .zip(row.inputs.iter().map(|value| json!(value)))
                .collect();
            json!({
                "case": row.number, "inputs": inputs, "status": row.status.name(),
                "message": row.message,
            })
        })
        .collect();
    json!({
        "cases": sweep.cases.len(),
        "converged": sweep.count(CaseStatus::Converged),
        "not_converged": sweep.count(CaseStatus::NotConverged),
        "failed": sweep.failed(),
        "not_run": sweep.count(CaseStatus::NotRun),
        "base": sweep.base,
        "mode": sweep.mode,
        "varied": varied,
        "extremes": extremes,
        "limits": limits,
        "cases_not_converged": bad,
    })
}

/// Dotted keys as nested objects; where the parts are indices, as arrays.
fn nested(values: &BTreeMap<String, f64>) -> Value {
    let mut groups: BTreeMap<&str, BTreeMap<String, f64>> = BTreeMap::new();
    let mut object = Map::new();
    for (key, value) in values {
        match key.split_once('.') {
            Some((outer, inner)) => {
                let group = groups.entry(outer).or_default();
                group.insert(inner.to_owned(), *value);
            }
            None => {
                object.insert(key.clone(), json!(value));
            }
        }
    }
    for (outer, group) in groups {
        object.insert(outer.to_owned(), nested(&group));
    }
    if !object.is_empty() && (0..object.len()).all(|k| object.contains_key(&k.to_string())) {
        return (0..object.len())
            .map(|k| object[&k.to_string()].clone())
            .collect();
    }
    Value::Object(object)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_nest_at_their_dots() {
        let errors = BTreeMap::from([
            ("integrals.p_cos".to_owned(), 1e-3),
            ("integrals.peak".to_owned(), f64::NAN),
            ("power_loss_w".to_owned(), 0.5),
            ("k.0.0".to_owned(), 1.0),
            ("k.0.1".to_owned(), 2.0),
            ("k.1.0".to_owned(), 3.0),
            ("k.1.1".to_owned(), 4.0),
        ]);
        let expected = json!({
            "integrals": {"p_cos": 1e-3, "peak": null},
            "power_loss_w": 0.5,
            "k": [[1.0, 2.0], [3.0, 4.0]],
        });
        assert_eq!(nested(&errors), expected);
    }
}
