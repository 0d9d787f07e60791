//! The report of an engine or shaft: the machine, then every bearing.

use super::page::Page;
use crate::results::Header;
use crate::results::machine::MachineResults;
use serde_json::{Value, json};

/// Fills the page and returns the data of its figures.
pub(super) fn fill(_page: &mut Page, _header: &Header, _machine: &MachineResults) -> Value {
    json!({})
}
