//! Keys of `summary.json` that films with contact, heat or wear have.

use crate::results::{CycleResults, HeatResults, degrees};
use serde_json::{Map, Value, json};

/// What asperities carry and lose. All that the film loses is boundary and viscous power; the viscous
/// power is shear of the turning surfaces and squeeze of the moving journal, W.
pub(super) fn contact_keys(peak: Option<f64>, share: f64, power: [f64; 3]) -> Value {
    let [boundary, friction, squeeze] = power;
    json!({
        "peak_contact_pressure_pa": peak,
        "contact_load_share": share,
        "boundary_power_w": boundary,
        "viscous_power_w": friction + squeeze - boundary,
        "viscous_shear_power_w": friction - boundary,
        "squeeze_power_w": squeeze,
    })
}

/// The temperature that the heat of the film led to.
pub(super) fn heat_keys(heat: &HeatResults) -> Map<String, Value> {
    let celsius = |kelvin: f64| json!(kelvin - 273.15);
    let trials: Vec<Value> = heat.trials.iter().copied().map(celsius).collect();
    let keys = [
        (
            "effective_temperature_degc",
            celsius(heat.effective_temperature),
        ),
        ("supply_temperature_degc", celsius(heat.supply_temperature)),
        ("outlet_temperature_degc", celsius(heat.outlet_temperature)),
        ("conducted_heat_w", json!(heat.conducted)),
        (
            "warm_diametral_clearance_m",
            json!(2.0 * heat.radial_clearance),
        ),
        ("heat_balance_trials_degc", Value::Array(trials)),
    ];
    let mut keys: Map<String, Value> = keys
        .map(|(key, value)| (key.to_owned(), value))
        .into_iter()
        .collect();
    if let Some(field) = &heat.field {
        keys.insert("hottest_temperature_degc".into(), celsius(field.hottest));
        keys.insert("heat_generated_w".into(), json!(field.generated));
        keys.insert("heat_carried_out_w".into(), json!(field.carried_out));
        keys.insert("energy_balance_relative".into(), json!(field.balance_error));
        keys.insert("temperature_changes_k".into(), json!(field.changes));
    }
    keys
}

/// Wear of the shell, largest friction energy and pressure times speed of both surfaces.
pub(super) fn wear_keys(cycle: &CycleResults) -> Map<String, Value> {
    let mut keys = Map::new();
    if let Some(wear) = cycle.shell_wear() {
        let largest = |values: &[f64]| values.iter().copied().reduce(f64::max);
        let deepest = wear.deepest_per_hour();
        let all = [
            ("wear_depth_per_hour_m", deepest.map(|d| d.value)),
            ("wear_depth_angle_deg", deepest.map(|d| degrees(d.angle))),
            ("wear_depth_position_m", deepest.map(|d| d.axial)),
            ("wear_volume_per_hour_m3", wear.volume_per_hour()),
            (
                "peak_pressure_velocity_w_m2",
                largest(&wear.map.peak_pressure_velocity),
            ),
            ("friction_energy_j_m2", largest(&wear.friction_energy())),
        ];
        keys.extend(all.map(|(key, value)| (key.to_owned(), json!(value))));
    }
    if let Some(ran) = &cycle.running_in {
        let deepest = ran.depth.iter().copied().reduce(f64::max);
        keys.insert("running_in_time_s".into(), json!(ran.time));
        keys.insert("running_in_end".into(), json!(ran.end.name()));
        keys.insert("running_in_depth_m".into(), json!(deepest));
        let last = ran.steps.last();
        for (key, value) in [
            ("running_in_volume_m3", last.map(|step| step.volume)),
            (
                "running_in_shell_roughness_m",
                last.map(|step| step.shell_roughness),
            ),
        ] {
            keys.insert(key.into(), json!(value));
        }
        keys.insert(
            "running_in_steps".into(),
            json!(ran.steps.len().saturating_sub(1)),
        );
    }
    keys
}
