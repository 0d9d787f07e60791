//! The inputs of a study as rows for the reader of a report.

use crate::results::InputRow;

/// The keys of the study with their values as the user wrote them.
pub(super) fn input_rows(text: &str) -> Vec<InputRow> {
    fn walk(prefix: &str, value: &toml::Value, rows: &mut Vec<InputRow>) {
        match value {
            toml::Value::Table(table) => {
                for (key, value) in table {
                    let path = if prefix.is_empty() {
                        key.clone()
                    } else {
                        format!("{prefix}.{key}")
                    };
                    walk(&path, value, rows);
                }
            }
            toml::Value::Array(items) if items.iter().any(toml::Value::is_table) => {
                for (index, item) in items.iter().enumerate() {
                    // Counted from 0, as a sweep names the elements of a list.
                    walk(&format!("{prefix}[{index}]"), item, rows);
                }
            }
            toml::Value::String(words) => rows.push(InputRow {
                key: prefix.to_owned(),
                value: words.clone(),
            }),
            toml::Value::Array(items) => {
                let items = items.iter().map(|item| match item {
                    toml::Value::String(words) => words.clone(),
                    other => other.to_string(),
                });
                rows.push(InputRow {
                    key: prefix.to_owned(),
                    value: items.collect::<Vec<_>>().join(", "),
                });
            }
            other => rows.push(InputRow {
                key: prefix.to_owned(),
                value: other.to_string(),
            }),
        }
    }
    let mut rows = Vec::new();
    if let Ok(table) = text.parse::<toml::Table>() {
        walk("", &toml::Value::Table(table), &mut rows);
    }
    rows
}
