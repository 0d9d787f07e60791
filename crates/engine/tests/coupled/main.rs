//! Journals of one shaft against beams on springs, single journals and balances.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

mod balances;
#[path = "../common/mod.rs"]
mod common;
mod edges;
#[path = "../common/elastic_six.rs"]
mod elastic_six;
mod engine;
mod limits;
mod shafts;
