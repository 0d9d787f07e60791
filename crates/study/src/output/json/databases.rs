//! Keys of `summary.json` about databases of films: one that was built, and those that a run looked up in.

use crate::film_tables::DatabaseFacts;
use crate::results::database::DatabaseResults;
use serde_json::{Value, json};

/// A database that was built, or begun.
pub(super) fn database_keys(database: &DatabaseResults) -> Value {
    let mut keys = json!({
        "file": database.file.to_string_lossy(),
        "build_time_s": database.build_time,
        "points": null,
        "maximum_relative_error": null,
        "error_samples": null,
    });
    let Some(built) = &database.built else {
        return keys;
    };
    keys["points"] = json!(built.facts.points);
    keys["maximum_relative_error"] = json!(built.facts.stated_error);
    keys["error_samples"] = json!(built.facts.samples);
    keys["target"] = json!(built.target);
    keys["relative_error_quantile_999"] = json!(built.quantile_999);
    keys["relative_error_median"] = json!(built.median);
    keys["peak_pressure_maximum_relative_error"] = json!(built.peak_maximum);
    keys["fresh_maximum_relative_error"] = json!(built.fresh_maximum());
    keys["fresh_samples"] = json!(built.fresh.len());
    keys["scheme"] = json!(built.facts.scheme.name());
    keys["closure"] = json!(built.facts.closure);
    keys["width_ratios"] = json!(built.facts.width_ratios);
    keys["last_eccentricity"] = json!(built.facts.last_eccentricity);
    keys["error_status"] = json!(built.facts.status_name());
    keys["journal"] = json!(built.facts.journal());
    keys["smallest_relative_film_thickness"] = json!(built.facts.smallest_gap);
    keys
}

/// The databases that films were looked up in.
pub(super) fn looked_up(databases: &[DatabaseFacts]) -> Value {
    let all = databases.iter().map(|facts| {
        json!({
            "file": facts.file,
            "scheme": facts.scheme.name(),
            "closure": facts.closure,
            "width_ratios": facts.width_ratios,
            "last_eccentricity": facts.last_eccentricity,
            "target": facts.bound,
            "maximum_relative_error": facts.stated_error,
            "error_samples": facts.samples,
            "status": facts.status_name(),
            "journal": facts.journal(),
        })
    });
    all.collect()
}
