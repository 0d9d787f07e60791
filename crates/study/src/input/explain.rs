//! `explain`: what a key means, in words, from the table of keys.

use super::keys::KEYS;
use super::schema::{self, Key, Kind, Presence};
use std::fmt::Write as _;

/// What a key or section means.
///
/// # Errors
/// The nearest valid key, if there is one, where the key is unknown.
pub fn explain(path: &str) -> Result<String, Option<&'static str>> {
    let found = schema::find(path).or_else(|| only_key_named(path));
    let Some(key) = found else {
        return Err(schema::nearest(path).map(|key| key.path));
    };
    let mut text = format!("{}\n  {}\n", key.path, key.meaning);
    for (label, line) in details(key) {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {label:<10}{line}");
    }
    for child in schema::children(key.path) {
        let _ = writeln!(text, "  {:<42}{}", child.path, child.meaning);
    }
    Ok(text)
}

/// All keys with their meaning, one a line.
#[must_use]
pub fn list_keys() -> String {
    let mut text = String::new();
    for key in KEYS {
        let note = if key.is_built() {
            ""
        } else {
            " (not built yet)"
        };
        let _ = writeln!(text, "{:<42}{}{note}", key.path, key.meaning);
    }
    text
}

/// The key with this last name, if only one has it.
fn only_key_named(name: &str) -> Option<&'static Key> {
    let mut named = KEYS.iter().filter(|key| key.name() == name);
    let first = named.next()?;
    named.next().is_none().then_some(first)
}

fn details(key: &Key) -> Vec<(&'static str, String)> {
    let mut lines = vec![("value", kind(&key.kind))];
    match key.kind {
        Kind::Number(range)
        | Kind::Quantity(_, range)
        | Kind::QuantityOrLaw(_, range)
        | Kind::Limit(_, range)
            if range.low.is_finite() || range.high.is_finite() =>
        {
            lines.push(("range", range.to_string()));
        }
        _ => {}
    }
    match key.presence {
        Presence::Default(text) if !text.is_empty() => lines.push(("default", text.to_owned())),
        Presence::Required => lines.push(("presence", "required".to_owned())),
        _ => lines.push(("presence", "optional".to_owned())),
    }
    if !key.typical.is_empty() {
        lines.push(("typical", key.typical.to_owned()));
    }
    let used: Vec<&str> = key.used_by.iter().map(|mode| mode.name()).collect();
    lines.push(("used by", used.join(", ")));
    lines
}

fn kind(kind: &Kind) -> String {
    let units = |dimension: super::units::Dimension| {
        format!("{} in {}", dimension.name(), dimension.units().join(", "))
    };
    match *kind {
        Kind::Table => "a table".into(),
        Kind::TableList => "a list of tables".into(),
        Kind::Text => "text".into(),
        Kind::Flag => "true or false".into(),
        Kind::Integer(low, high) if low == high => format!("{low}"),
        Kind::Integer(low, high) => format!("a whole number from {low} to {high}"),
        Kind::Number(_) => "a number without unit".into(),
        Kind::Quantity(dimension, _) => units(dimension),
        Kind::QuantityOrLaw(dimension, _) => format!("{}, or a table", units(dimension)),
        Kind::Pair(dimension) => format!("[x, y], each a {}", units(dimension)),
        Kind::Grid => "[around, axial] in cells".into(),
        Kind::Choice(built, []) => built.join(" | "),
        Kind::Choice(built, planned) => {
            format!(
                "{} (not built yet: {})",
                built.join(" | "),
                planned.join(", ")
            )
        }
        Kind::Limit(dimension, _) => {
            format!("{{ value, source }}, value a {}", units(dimension))
        }
        Kind::Vary => {
            "a table of keys, each with a list of its values or a range { from, to, count }".into()
        }
        Kind::NotBuilt => format!("not built yet in version {}", env!("CARGO_PKG_VERSION")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_can_be_explained() {
        for key in KEYS {
            assert!(explain(key.path).is_ok_and(|text| text.contains(key.meaning)));
        }
    }

    #[test]
    fn a_last_name_is_enough_where_it_is_the_only_one() {
        assert!(explain("engine_speed").is_ok_and(|text| text.contains("load_cycle.engine_speed")));
        assert_eq!(explain("bearing.diametr"), Err(Some("bearing.diameter")));
    }
}
