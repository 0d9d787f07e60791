//! The cases of a sweep: what each one was, how it ended and what it found, as one table.
//!
//! A case is known by the summary it left behind, whether it was computed a moment ago or by a run
//! of last week: the table is always built from summaries, so that both give the same table.

use crate::models::{self, Model};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sommerfeld_film::Outcome;
use std::collections::HashMap;

/// How a case ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CaseStatus {
    /// It has not run yet, or was interrupted.
    NotRun,
    /// It was refused while it ran, such as by a film whose gap closes.
    Failed,
    /// It converged.
    Converged,
    /// Its numbers are those of a last iterate.
    NotConverged,
    /// No oil can reach its film.
    Starved,
    /// Its equations have no solution.
    NoSolution,
}

impl CaseStatus {
    /// Every status.
    pub const ALL: [Self; 6] = [
        Self::NotRun,
        Self::Failed,
        Self::Converged,
        Self::NotConverged,
        Self::Starved,
        Self::NoSolution,
    ];

    /// Its word in results.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::NotRun => "not-run",
            Self::Failed => "failed",
            Self::Converged => "converged",
            Self::NotConverged => "not-converged",
            Self::Starved => "starved",
            Self::NoSolution => "no-solution",
        }
    }

    /// The status of a word in results.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.name() == name)
    }

    /// The case gave no numbers.
    #[must_use]
    pub const fn has_failed(self) -> bool {
        matches!(self, Self::Failed | Self::Starved | Self::NoSolution)
    }
}

impl From<Outcome> for CaseStatus {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Converged => Self::Converged,
            Outcome::NotConverged => Self::NotConverged,
            Outcome::Starved => Self::Starved,
            Outcome::NoSolution => Self::NoSolution,
        }
    }
}

/// A case that ended.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseRecord {
    /// Number of the case, from 1.
    pub number: usize,
    /// How it ended.
    pub status: CaseStatus,
    /// Why it did not converge; empty where it did.
    pub message: String,
    /// Its `summary.json`.
    pub summary: String,
    /// Wall time, s.
    pub wall_time: f64,
}

/// What a sweep found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SweepResults {
    /// The base study, as the user named it.
    pub base: String,
    /// `grid` or `zip`.
    pub mode: &'static str,
    /// The varied keys.
    pub varied: Vec<VariedColumn>,
    /// Columns of numbers, in the order in which the cases first show them.
    pub columns: Vec<Column>,
    /// Names of the limits that some case has, in the same order.
    pub limits: Vec<String>,
    /// The cases in the order of their numbers.
    pub cases: Vec<CaseRow>,
}

/// A varied key as a column.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedColumn {
    /// The key, such as `bearing.groove[0].pressure`.
    pub key: String,
    /// Unit of the numbers, `-` for bare ones; empty where the values are not numbers.
    pub unit: String,
    /// It takes more than one value, or none does: what tells the cases apart.
    pub tells_apart: bool,
}

/// A column of numbers.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Column {
    /// Key in the summary of a case, such as `minimum_film_thickness_m` or `error.power_loss_w`.
    pub key: String,
    /// The key without its unit, such as `minimum_film_thickness`.
    pub name: String,
    /// Its unit; `-` without one.
    pub unit: &'static str,
}

/// One case as a row.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseRow {
    /// Its number, from 1.
    pub number: usize,
    /// The varied values as they are shown, one for each varied key.
    pub inputs: Vec<String>,
    /// The varied values as numbers, where they are.
    pub numbers: Vec<Option<f64>>,
    /// How it ended.
    pub status: CaseStatus,
    /// Why it did not converge; empty where it did.
    pub message: String,
    /// A number for each column, not a number where the case has none.
    pub values: Vec<f64>,
    /// A verdict for each limit, where the case has it.
    pub limits: Vec<Option<CaseLimit>>,
}

/// How a case stands against a limit.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseLimit {
    /// The limit, SI.
    pub limit: f64,
    /// `ok`, `exceeded` or `not-evaluated`.
    pub verdict: String,
    /// Where the limit comes from.
    pub source: String,
}

impl SweepResults {
    /// Adds the next case with its record, if it has ended.
    pub fn push(
        &mut self,
        number: usize,
        inputs: Vec<String>,
        numbers: Vec<Option<f64>>,
        record: Option<&CaseRecord>,
    ) {
        let summary: Value = record
            .and_then(|record| serde_json::from_str(&record.summary).ok())
            .unwrap_or_default();
        let mut row = CaseRow {
            number,
            inputs,
            numbers,
            status: record.map_or(CaseStatus::NotRun, |record| record.status),
            message: record.map_or_else(String::new, |record| record.message.clone()),
            values: Vec::new(),
            limits: Vec::new(),
        };
        let known: HashMap<String, usize> = (self.columns.iter().enumerate())
            .map(|(at, column)| (column.key.clone(), at))
            .collect();
        let mut place = |columns: &mut Vec<Column>, key: String, value: f64| {
            let at = known.get(&key).copied().unwrap_or_else(|| {
                columns.push(column_of(key));
                columns.len() - 1
            });
            if row.values.len() <= at {
                row.values.resize(at + 1, f64::NAN);
            }
            row.values[at] = value;
        };
        if let Value::Object(object) = &summary {
            for (key, value) in object {
                if !NO_RESULTS.contains(&key.as_str()) {
                    flatten(key, value, &mut |key, value| {
                        place(&mut self.columns, key, value);
                    });
                }
            }
        }
        self.push_limits(&mut row, &summary["limits"]);
        self.cases.push(row);
    }

    fn push_limits(&mut self, row: &mut CaseRow, limits: &Value) {
        for limit in limits.as_array().into_iter().flatten() {
            let Some(name) = limit["name"].as_str() else {
                continue;
            };
            let at = match self.limits.iter().position(|known| known == name) {
                Some(at) => at,
                None => {
                    self.limits.push(name.to_owned());
                    self.limits.len() - 1
                }
            };
            if row.limits.len() <= at {
                row.limits.resize(at + 1, None);
            }
            let number = limit
                .as_object()
                .and_then(|object| object.iter().find(|(key, _)| key.starts_with("limit_")))
                .and_then(|(_, value)| value.as_f64());
            row.limits[at] = Some(CaseLimit {
                limit: number.unwrap_or(f64::NAN),
                verdict: limit["verdict"].as_str().unwrap_or_default().to_owned(),
                source: limit["source"].as_str().unwrap_or_default().to_owned(),
            });
        }
    }

    /// The number of a case in a column; not a number where it has none.
    #[must_use]
    pub fn value(row: &CaseRow, column: usize) -> f64 {
        row.values.get(column).copied().unwrap_or(f64::NAN)
    }

    /// The place of a column.
    #[must_use]
    pub fn column(&self, key: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.key == key)
    }

    /// How a case stands against a limit.
    #[must_use]
    pub fn limit(row: &CaseRow, limit: usize) -> Option<&CaseLimit> {
        row.limits.get(limit)?.as_ref()
    }

    /// Number of cases with this status.
    #[must_use]
    pub fn count(&self, status: CaseStatus) -> usize {
        self.cases.iter().filter(|row| row.status == status).count()
    }

    /// Number of cases that gave no numbers.
    #[must_use]
    pub fn failed(&self) -> usize {
        let failed = self.cases.iter().filter(|row| row.status.has_failed());
        failed.count()
    }

    /// The cases with the smallest and the largest number of a column, among those that converged.
    #[must_use]
    pub fn extremes(&self, column: usize) -> Option<[(&CaseRow, f64); 2]> {
        let mut values = self
            .cases
            .iter()
            .filter(|row| row.status == CaseStatus::Converged)
            .map(|row| (row, Self::value(row, column)))
            .filter(|(_, value)| value.is_finite());
        let first = values.next()?;
        Some(values.fold([first, first], |[low, high], next| {
            [
                if next.1 < low.1 { next } else { low },
                if next.1 > high.1 { next } else { high },
            ]
        }))
    }

    /// What tells a case from the others: `bearing.width = 30 mm`.
    #[must_use]
    pub fn inputs(&self, row: &CaseRow) -> String {
        let inputs = self.varied.iter().zip(&row.inputs);
        let inputs: Vec<String> = inputs
            .filter(|(column, _)| column.tells_apart)
            .map(|(column, value)| format!("{} = {value}", column.key))
            .collect();
        inputs.join(", ")
    }

    /// A case in words: `case 3 (bearing.width = 30 mm)`.
    #[must_use]
    pub fn describe(&self, row: &CaseRow) -> String {
        format!("case {} ({})", row.number, self.inputs(row))
    }
}

/// The models that the summary of a case names.
#[must_use]
pub fn models_of(record: &CaseRecord) -> Vec<Model> {
    let summary: Value = serde_json::from_str(&record.summary).unwrap_or_default();
    let named = summary["models"].as_array().into_iter().flatten();
    named
        .filter_map(|model| models::find(model["family"].as_str()?, model["name"].as_str()?))
        .collect()
}

/// Keys of a summary that are no results, or not the same in every run.
const NO_RESULTS: [&str; 6] = [
    "schema",
    "wall_time_s",
    "build_time_s",
    "models",
    "limits",
    "messages",
];

/// The numbers of a value of the summary, each with a key of its own: `force_n.x`,
/// `integrals.p_cos`. Missing numbers count, so that a column does not depend on them.
fn flatten(key: &str, value: &Value, take: &mut dyn FnMut(String, f64)) {
    const AXES: [&str; 2] = ["x", "y"];
    match value {
        Value::Number(number) => take(key.to_owned(), number.as_f64().unwrap_or(f64::NAN)),
        Value::Null => take(key.to_owned(), f64::NAN),
        Value::Object(object) => {
            for (name, value) in object {
                flatten(&format!("{key}.{name}"), value, take);
            }
        }
        Value::Array(items) if items.len() == 2 => {
            for (axis, item) in AXES.iter().zip(items) {
                // Of a matrix the axes stand together: xx, xy.
                let joint = if key.ends_with(".x") || key.ends_with(".y") {
                    ""
                } else {
                    "."
                };
                flatten(&format!("{key}{joint}{axis}"), item, take);
            }
        }
        Value::Array(items) if items.iter().all(Value::is_number) => {
            for (number, item) in (1..).zip(items) {
                flatten(&format!("{key}.{number}"), item, take);
            }
        }
        Value::Array(_) | Value::String(_) | Value::Bool(_) => {}
    }
}

/// Endings of keys and the units they stand for, the longer ones first.
const UNITS: &[(&str, &str)] = &[
    ("_m3_s", "m3/s"),
    ("_m2_s", "m2/s"),
    ("_n_s_m", "N.s/m"),
    ("_n_m", "N.m"),
    ("_kg_m3", "kg/m3"),
    ("_kg_s", "kg/s"),
    ("_rad_s", "rad/s"),
    ("_pa_s", "Pa.s"),
    ("_degc", "degC"),
    ("_deg", "deg"),
    ("_rad", "rad"),
    ("_rpm", "rpm"),
    ("_hz", "Hz"),
    ("_pa", "Pa"),
    ("_kg", "kg"),
    ("_w", "W"),
    ("_n", "N"),
    ("_j", "J"),
    ("_k", "K"),
    ("_s", "s"),
    ("_m", "m"),
];

/// The column of a key: its unit comes last in the key, before the axis of a vector.
fn column_of(key: String) -> Column {
    let compared = key.strip_prefix("comparison.");
    let compared = compared.and_then(|rest| rest.split_once('.'));
    let error = key.strip_prefix("error.").map(|rest| ("error", rest));
    let (suffix, plain) = match error.or(compared) {
        Some((of, rest)) => (format!("_{of}"), rest),
        None => (String::new(), key.as_str()),
    };
    let (stem, part) = match plain.split_once('.') {
        Some((stem, part)) => (stem, format!("_{part}")),
        None => (plain, String::new()),
    };
    let found = UNITS.iter().find(|(ending, _)| stem.ends_with(ending));
    let (stem, unit) = match found {
        Some((ending, unit)) => (&stem[..stem.len() - ending.len()], *unit),
        None => (stem, "-"),
    };
    let unit = match unit {
        "N.m" if stem.contains("stiffness") => "N/m",
        unit => unit,
    };
    Column {
        name: format!("{stem}{part}{suffix}"),
        unit,
        key,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;
    use serde_json::json;

    fn header(key: &str) -> String {
        let column = column_of(key.to_owned());
        format!("{}[{}]", column.name, column.unit)
    }

    #[test]
    fn keys_become_names_with_units() {
        assert_eq!(
            header("minimum_film_thickness_m"),
            "minimum_film_thickness[m]"
        );
        assert_eq!(header("side_flow_m3_s"), "side_flow[m3/s]");
        assert_eq!(
            header("friction_torque_shell_n_m"),
            "friction_torque_shell[N.m]"
        );
        assert_eq!(header("force_n.x"), "force_x[N]");
        assert_eq!(header("stiffness_n_m.xy"), "stiffness_xy[N/m]");
        assert_eq!(header("damping_n_s_m.yy"), "damping_yy[N.s/m]");
        assert_eq!(header("integrals.p_cos"), "integrals_p_cos[-]");
        assert_eq!(header("error.power_loss_w"), "power_loss_error[W]");
        assert_eq!(
            header("comparison.online.power_loss_w"),
            "power_loss_online[W]"
        );
        assert_eq!(header("sommerfeld_number"), "sommerfeld_number[-]");
    }

    fn record(number: usize, status: CaseStatus, summary: &Value) -> CaseRecord {
        CaseRecord {
            number,
            status,
            message: String::new(),
            summary: summary.to_string(),
            wall_time: 0.0,
        }
    }

    #[test]
    fn columns_grow_with_the_cases_and_keep_their_place() {
        let mut sweep = SweepResults::default();
        let mut push = |number, record: Option<&CaseRecord>| {
            sweep.push(number, vec!["1 mm".into()], vec![Some(1.0)], record);
        };
        push(1, None);
        let first = json!({"wall_time_s": 3.0, "force_n": [1.0, 2.0], "power_loss_w": 7.0});
        push(2, Some(&record(2, CaseStatus::Converged, &first)));
        let second = json!({"stiffness_n_m": [[1.0, 2.0], [3.0, 4.0]], "power_loss_w": 5.0,
            "limits": [{"name": "power_loss", "limit_w": 6.0, "verdict": "ok"}]});
        push(3, Some(&record(3, CaseStatus::Converged, &second)));
        push(
            4,
            Some(&record(
                4,
                CaseStatus::NotConverged,
                &json!({"power_loss_w": 1.0}),
            )),
        );
        let keys: Vec<&str> = sweep.columns.iter().map(|c| c.key.as_str()).collect();
        let stiffness = ["xx", "xy", "yx", "yy"].map(|axes| format!("stiffness_n_m.{axes}"));
        assert_eq!(keys[..3], ["force_n.x", "force_n.y", "power_loss_w"]);
        assert_eq!(keys[3..], stiffness);
        let power = sweep.column("power_loss_w").unwrap();
        let [low, high] = sweep.extremes(power).unwrap();
        assert_eq!(
            (low.0.number, low.1, high.0.number, high.1),
            (3, 5.0, 2, 7.0)
        );
        assert!(SweepResults::value(&sweep.cases[0], power).is_nan());
        let limit = SweepResults::limit(&sweep.cases[2], 0).unwrap();
        assert_eq!((limit.limit, limit.verdict.as_str()), (6.0, "ok"));
        assert_eq!(SweepResults::limit(&sweep.cases[3], 0), None);
    }

    #[test]
    fn words_read_back() {
        for status in CaseStatus::ALL {
            assert_eq!(CaseStatus::from_name(status.name()), Some(status));
            assert_eq!(serde_json::to_value(status).unwrap(), status.name());
        }
    }
}
