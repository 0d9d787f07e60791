//! `summary.json`: the numbers of a run in SI, the unit in the key, keys that stay.
//!
//! Numbers that are not finite become `null`: JSON has no word for them.

use super::{OutputError, ResultWriter};
use crate::cases::{CaseStatus, SweepResults};
use crate::limits::LimitCheck;
use crate::models::Model;
use crate::results::{
    Body, CycleResults, DimensionlessResults, Header, PROGRAM, Results, SCHEMA, SteadyResults,
    VERSION, degrees, magnitude, specific_load, status_name,
};
use serde_json::{Map, Value, json};
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
        Body::Sweep(sweep) => sweep_keys(sweep),
    };
    if let Value::Object(body) = body {
        object.extend(body);
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
        "feed_flow_m3_s": summary.feed_flow,
        "full_film_share": summary.full_film_share,
        "reynolds_number": summary.reynolds_number,
        "mass_balance_relative": summary.mass_balance_relative,
        "complementarity_violation": summary.complementarity_violation,
        "iterations": steady.iterations,
    });
    let optional = [
        ("load_n", steady.load.map(|load| json!(load))),
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
    json!({
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
        "mean_feed_flow_m3_s": cycle.mean(|p| p.summary.feed_flow),
        "mean_relative_eccentricity": cycle.mean(|p| cycle.relative_eccentricity(p)),
        "cycle_closure": orbit.closure,
        "cycles": orbit.cycles,
        "steps": orbit.steps,
        "film_solves": orbit.film_solves,
        "points_not_converged": cycle.not_converged().count(),
        "mass_balance_relative": worst(|summary| summary.mass_balance_relative),
        "complementarity_violation": worst(|summary| summary.complementarity_violation),
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

/// Dotted keys as nested objects.
fn nested(values: &BTreeMap<String, f64>) -> Value {
    let mut object = json!({});
    for (key, value) in values {
        match key.split_once('.') {
            Some((outer, inner)) => object[outer][inner] = json!(value),
            None => object[key.as_str()] = json!(value),
        }
    }
    object
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_nest_at_the_dot() {
        let errors = BTreeMap::from([
            ("integrals.p_cos".to_owned(), 1e-3),
            ("integrals.peak".to_owned(), f64::NAN),
            ("power_loss_w".to_owned(), 0.5),
        ]);
        let expected = json!({"integrals": {"p_cos": 1e-3, "peak": null}, "power_loss_w": 0.5});
        assert_eq!(nested(&errors), expected);
    }
}
