//! Journals of one shaft against beams on springs, single journals and balances.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

mod balances;
mod limits;
mod shafts;
