//! The JSON schema (draft 2020-12) of the study file, for editors that complete and check TOML.
//!
//! It comes from the table of keys and says what a schema can: names, types, units, words. Ranges
//! of quantities and what one key demands of another are checked by the program alone.

use super::schema::{self, GRID_LIMITS, Key, Kind, Presence};
use super::units::Dimension;
use serde_json::{Map, Value, json};

/// The JSON schema of the study file.
#[must_use]
pub fn json_schema() -> Value {
    let mut root = object_of("");
    root.insert(
        "$schema".into(),
        json!("https://json-schema.org/draft/2020-12/schema"),
    );
    root.insert("title".into(), json!("Sommerfeld study"));
    root.insert("required".into(), json!(["schema", "analysis"]));
    Value::Object(root)
}

/// The schema of a section; planned keys are left out and so refused.
fn object_of(section: &str) -> Map<String, Value> {
    let properties: Map<String, Value> = schema::children(section)
        .filter(|key| key.is_built())
        .map(|key| (key.name().to_owned(), property(key)))
        .collect();
    let mut object = Map::new();
    object.insert("type".into(), json!("object"));
    object.insert("properties".into(), Value::Object(properties));
    object.insert("additionalProperties".into(), json!(false));
    object
}

fn property(key: &Key) -> Value {
    let mut property = match key.kind {
        Kind::Table => object_of(key.path),
        Kind::TableList => as_map(json!({
            "type": "array",
            "items": with_required(object_of(key.path), key.path),
        })),
        Kind::TableOrList => {
            let one = Value::Object(object_of(key.path));
            as_map(json!({ "oneOf": [{ "type": "array", "minItems": 1, "items": one }, one] }))
        }
        Kind::QuantityOrLaw(dimension, _) => as_map(json!({
            "oneOf": [quantity(dimension), with_required(object_of(key.path), key.path)],
        })),
        kind => as_map(plain(&kind)),
    };
    property.insert("description".into(), json!(key.meaning));
    if let Some(default) = default_of(key) {
        property.insert("default".into(), default);
    }
    Value::Object(property)
}

/// Adds the keys that a list element or law cannot do without.
fn with_required(mut object: Map<String, Value>, section: &str) -> Value {
    let required: Vec<&str> = schema::children(section)
        .filter(|key| key.presence == Presence::Required)
        .map(Key::name)
        .collect();
    object.insert("required".into(), json!(required));
    Value::Object(object)
}

fn plain(kind: &Kind) -> Value {
    match *kind {
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Integer(low, high) => json!({ "type": "integer", "minimum": low, "maximum": high }),
        Kind::Number(range) => {
            let mut number = as_map(json!({ "type": "number" }));
            let low = if range.low_is_open {
                "exclusiveMinimum"
            } else {
                "minimum"
            };
            if range.low.is_finite() {
                number.insert(low.into(), json!(range.low));
            }
            if range.high.is_finite() {
                number.insert("maximum".into(), json!(range.high));
            }
            Value::Object(number)
        }
        Kind::Quantity(dimension, _) => quantity(dimension),
        Kind::Pair(dimension, _) => json!({
            "type": "array", "items": quantity(dimension), "minItems": 2, "maxItems": 2,
        }),
        Kind::List(dimension, _) => json!({ "anyOf": [
            quantity(dimension),
            { "type": "array", "items": quantity(dimension), "minItems": 1 },
        ]}),
        Kind::Integers(low, high) => {
            let one = json!({ "type": "integer", "minimum": low, "maximum": high });
            json!({ "anyOf": [one, { "type": "array", "minItems": 1, "items": one }] })
        }
        Kind::Numbers(_) => json!({ "anyOf": [
            { "type": "number" },
            { "type": "array", "minItems": 1, "items": { "type": "number" } },
        ]}),
        Kind::Files => json!({ "anyOf": [
            { "type": "string" },
            { "type": "array", "minItems": 1, "items": { "type": "string" } },
        ]}),
        Kind::Grid => {
            let [around, axial] = GRID_LIMITS
                .map(|[low, high]| json!({ "type": "integer", "minimum": low, "maximum": high }));
            json!({
                "type": "array", "prefixItems": [around, axial], "items": false, "minItems": 2,
            })
        }
        Kind::Choice(built, _) => json!({ "enum": built }),
        Kind::Words(built) => json!({
            "type": "array", "items": { "enum": built }, "uniqueItems": true,
        }),
        Kind::Limit(dimension, _) => json!({
            "type": "object",
            "properties": { "value": quantity(dimension), "source": { "type": "string" } },
            "required": ["value"],
            "additionalProperties": false,
        }),
        Kind::Vary => json!({
            "type": "object",
            "minProperties": 1,
            "additionalProperties": { "anyOf": [
                { "type": "array", "minItems": 1 },
                {
                    "type": "object",
                    "properties": {
                        "from": { "type": ["string", "number"] },
                        "to": { "type": ["string", "number"] },
                        "count": { "type": "integer", "minimum": 2 },
                        "scale": { "enum": ["linear", "log"] },
                    },
                    "required": ["from", "to", "count"],
                    "additionalProperties": false,
                },
                { "type": "object", "not": { "required": ["from"] } },
            ]},
        }),
        Kind::Text
        | Kind::Table
        | Kind::TableList
        | Kind::TableOrList
        | Kind::QuantityOrLaw(..)
        | Kind::NotBuilt => {
            json!({ "type": "string" })
        }
    }
}

/// A number and one of the units; further spellings of the units are taken by the program only.
fn quantity(dimension: Dimension) -> Value {
    let units: Vec<String> = dimension
        .units()
        .iter()
        .map(|unit| {
            let unit = unit.replace('.', "[. ]");
            unit.replace('(', r"\(").replace(')', r"\)")
        })
        .collect();
    let pattern = format!(
        r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*({})\s*$",
        units.join("|")
    );
    json!({ "type": "string", "pattern": pattern })
}

fn default_of(key: &Key) -> Option<Value> {
    let Presence::Default(text) = key.presence else {
        return None;
    };
    Some(match key.kind {
        Kind::Text | Kind::Choice(..) | Kind::Quantity(..) | Kind::QuantityOrLaw(..) => json!(text),
        _ => serde_json::from_str(text).unwrap_or_else(|_| json!(text)),
    })
}

fn as_map(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_key_is_in_the_schema() {
        let root = json_schema();
        for key in super::super::keys::KEYS.iter().filter(|key| key.is_built()) {
            let mut node = &root;
            for part in key.path.split('.') {
                let inner = [
                    &node["properties"],
                    &node["items"]["properties"],
                    &node["oneOf"][1]["properties"],
                ];
                let found = inner.into_iter().find_map(|map| map.get(part));
                assert!(found.is_some(), "{}", key.path);
                node = found.unwrap_or(&Value::Null);
            }
            assert_eq!(node["description"], json!(key.meaning));
        }
    }
}
