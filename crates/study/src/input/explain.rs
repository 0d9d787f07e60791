//! `explain`: what a key means, in words, from the table of keys.

use super::keys::KEYS;
use super::schema::{self, GRID_LIMITS, Key, Kind, Presence};
use std::fmt::Write as _;

/// What a key or section means.
///
/// # Errors
/// The nearest valid key, if there is one, where the key is unknown.
pub fn explain(path: &str) -> Result<String, Option<&'static str>> {
    let path = bare_path(path);
    let found = schema::find(&path).or_else(|| only_key_named(&path));
    let Some(key) = found else {
        return Err(schema::nearest(&path).map(|key| key.path));
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

/// All keys with their meaning, one a line, in the parts of the study file.
#[must_use]
pub fn list_keys() -> String {
    let mut text = String::new();
    for key in KEYS {
        // A blank line before each part of the study file.
        if key.section().is_empty() && !matches!(key.path, "schema" | "title" | "analysis") {
            text.push('\n');
        }
        let note = if key.is_built() {
            ""
        } else {
            " (not built yet)"
        };
        let _ = writeln!(text, "{:<42}{}{note}", key.path, key.meaning);
    }
    text
}

/// A path as it may be copied from a study file or a report, without brackets and numbers of lists:
/// `[bearing]`, `bearing.groove[2].width`.
fn bare_path(path: &str) -> String {
    let inner = path.trim().trim_start_matches('[').trim_end_matches(']');
    let mut bare = String::new();
    let mut depth = 0_usize;
    for c in inner.chars() {
        match c {
            '[' => depth += 1,
            ']' => depth = depth.saturating_sub(1),
            c if depth == 0 => bare.push(c),
            _ => {}
        }
    }
    bare
}

/// The key with this last name, if only one has it.
fn only_key_named(name: &str) -> Option<&'static Key> {
    let mut named = KEYS.iter().filter(|key| key.name() == name);
    let first = named.next()?;
    named.next().is_none().then_some(first)
}

fn details(key: &Key) -> Vec<(&'static str, String)> {
    let mut lines = vec![("value", kind(&key.kind))];
    lines.extend(range(&key.kind).map(|range| ("range", range)));
    lines.push((
        "default",
        match key.presence {
            Presence::Default("") => "empty".to_owned(),
            Presence::Default(text) => text.to_owned(),
            Presence::Required => "none: it must be given".to_owned(),
            Presence::Optional => "none: it may be left out".to_owned(),
        },
    ));
    if !key.typical.is_empty() {
        lines.push(("typical", key.typical.to_owned()));
    }
    let used: Vec<&str> = key.used_by.iter().map(|mode| mode.name()).collect();
    lines.push(("used by", used.join(", ")));
    lines
}

/// The numbers that are allowed, of a kind that holds numbers.
fn range(kind: &Kind) -> Option<String> {
    match *kind {
        Kind::Number(range)
        | Kind::Quantity(_, range)
        | Kind::QuantityOrLaw(_, range)
        | Kind::List(_, range)
        | Kind::Pair(_, range)
        | Kind::Limit(_, range) => Some(range.to_string()),
        Kind::Integer(low, high) if low == high => Some(low.to_string()),
        Kind::Integer(low, high) | Kind::Integers(low, high) => {
            Some(format!("at least {low}, at most {high}"))
        }
        Kind::Grid => {
            let [[around_low, around_high], [axial_low, axial_high]] = GRID_LIMITS;
            Some(format!(
                "{around_low} to {around_high} around, {axial_low} to {axial_high} axial"
            ))
        }
        _ => None,
    }
}

fn kind(kind: &Kind) -> String {
    let units = |dimension: super::units::Dimension| {
        format!(
            "{} in {}",
            dimension.with_article(),
            dimension.units().join(", ")
        )
    };
    match *kind {
        Kind::Table => "a table".into(),
        Kind::TableList => "a list of tables".into(),
        Kind::TableOrList => "a table; in an engine or shaft a list of tables".into(),
        Kind::Text => "text".into(),
        Kind::Flag => "true or false".into(),
        Kind::Integer(..) => "a whole number".into(),
        Kind::Number(_) => "a number without unit".into(),
        Kind::Quantity(dimension, _) => units(dimension),
        Kind::QuantityOrLaw(dimension, _) => format!("{}, or a table", units(dimension)),
        Kind::Pair(dimension, _) => format!("[x, y], each {}", units(dimension)),
        Kind::List(dimension, _) => format!("one, or a list, each {}", units(dimension)),
        Kind::Integers(..) => "a whole number, or a list of them".into(),
        Kind::Numbers(_) => "a number without unit, or a list of them".into(),
        Kind::Files => "the path of a file, or a list of them".into(),
        Kind::Grid => "[around, axial] in cells".into(),
        Kind::Choice(built, []) => built.join(" | "),
        Kind::Words(built) => format!("a list of {}", built.join(", ")),
        Kind::Choice(built, planned) => {
            format!(
                "{} (not built yet: {})",
                built.join(" | "),
                planned.join(", ")
            )
        }
        Kind::Limit(dimension, _) => {
            format!("{{ value, source }}, value {}", units(dimension))
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

    /// Meaning, value with its units, range, default, typical values and who reads it: of every key.
    #[test]
    fn every_key_is_explained_in_full() {
        for key in KEYS {
            let text = explain(key.path).unwrap_or_default();
            let has = |part: &str| assert!(text.contains(part), "{part} in: {text}");
            has(key.meaning);
            has("\n  value     ");
            has("\n  default   ");
            has("\n  used by   ");
            let dimension = match key.kind {
                Kind::Quantity(dimension, _)
                | Kind::QuantityOrLaw(dimension, _)
                | Kind::Limit(dimension, _)
                | Kind::Pair(dimension, _) => Some(dimension),
                _ => None,
            };
            for unit in dimension.iter().flat_map(|dimension| dimension.units()) {
                has(unit);
            }
            let is_number = matches!(key.kind, Kind::Number(_) | Kind::Integer(..) | Kind::Grid);
            if dimension.is_some() || is_number {
                has("\n  range     ");
            }
            if !matches!(
                key.kind,
                Kind::Table | Kind::TableList | Kind::TableOrList | Kind::NotBuilt
            ) {
                has("\n  typical   ");
                assert!(!key.typical.is_empty(), "{}", key.path);
            }
            for mode in key.used_by {
                has(mode.name());
            }
            for child in schema::children(key.path) {
                has(child.path);
            }
        }
        let listed = list_keys();
        assert!(KEYS.iter().all(|key| listed.contains(key.path)));
    }

    #[test]
    fn a_path_may_be_copied_with_its_brackets() {
        for path in [
            "[bearing.groove]",
            "[[bearing.groove]]",
            "bearing.groove[2]",
        ] {
            assert_eq!(explain(path), explain("bearing.groove"), "{path}");
        }
        assert_eq!(
            explain("bearing.groove[1].width"),
            explain("bearing.groove.width")
        );
    }

    #[test]
    fn a_last_name_is_enough_where_it_is_the_only_one() {
        assert!(explain("engine_speed").is_ok_and(|text| text.contains("load_cycle.engine_speed")));
        assert_eq!(explain("bearing.diametr"), Err(Some("bearing.diameter")));
    }
}
