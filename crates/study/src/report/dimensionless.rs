//! The report of the dimensionless problem: five integrals.

use super::format::{ONE, long, significant};
use super::page::{Card, Cell, Page, Table, badge, error, exact};
use crate::results::{DimensionlessResults, Header};
use serde_json::{Value, json};

/// Fills cards and table; there is nothing to draw.
pub(super) fn fill(page: &mut Page, header: &Header, integrals: &DimensionlessResults) -> Value {
    let rows = [
        ("p_cos", "Integral of p cos φ", integrals.p_cos),
        ("p_sin", "Integral of p sin φ", integrals.p_sin),
        ("p_z_cos", "Integral of p Z cos φ", integrals.p_z_cos),
        ("p_z_sin", "Integral of p Z sin φ", integrals.p_z_sin),
        ("peak", "Peak pressure", integrals.peak),
    ];
    let mut table = Table {
        title: "Integrals of the dimensionless pressure",
        note: "Over φ from 0 to 2π, counted from the widest gap, and Z = 2z/B from −1 to 1.".into(),
        columns: vec!["Key", "Quantity", "Value", "Error"],
        size: "wide",
        ..Table::default()
    };
    for (key, label, value) in rows {
        let error = error(header, &format!("integrals.{key}"), ONE);
        page.cards.push(Card {
            label,
            key,
            exact: exact(value),
            value: significant(value),
            error: error.clone(),
            badge: badge(header.status),
            ..Card::default()
        });
        table.rows.push(vec![
            Cell {
                text: key.to_owned(),
                class: "key",
            },
            Cell::text(label),
            Cell::number(long(value)),
            Cell::number(error.unwrap_or_else(|| "not asked for".to_owned())),
        ]);
    }
    page.tables.push(table);
    json!({})
}
