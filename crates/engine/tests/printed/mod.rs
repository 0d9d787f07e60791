//! Committed numbers with the half of their last digit.
#![allow(dead_code, clippy::unwrap_used)]

/// One quantity of a reference.
pub struct Printed {
    pub name: String,
    pub value: f64,
    /// Half of the last printed digit.
    pub bar: f64,
}

/// Cells of `validation/<path>`: comments and the header left out.
pub fn cells_of(path: &str) -> Vec<Vec<String>> {
    let path = format!("{}/../../validation/{path}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect()
}

/// Rows `quantity,value,half_last_digit,unit`.
pub fn rows_of(path: &str) -> Vec<Printed> {
    let printed = |row: Vec<String>| Printed {
        name: row[0].clone(),
        value: row[1].parse().unwrap(),
        bar: row[2].parse().unwrap(),
    };
    cells_of(path).into_iter().map(printed).collect()
}
