//! Writes reports of made-up results, to look at their layout in a browser:
//! `cargo run -p sommerfeld-study --example report_preview -- DIRECTORY`.

#![allow(
    clippy::unwrap_used,
    reason = "a preview may stop at the first surprise"
)]

#[path = "../tests/synthetic/mod.rs"]
mod synthetic;

use sommerfeld_study::output::write_all;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let directory = std::env::args()
        .nth(1)
        .map_or_else(|| PathBuf::from("report-preview"), PathBuf::from);
    let title = "Synthetic data: a preview of the layout, not a calculation";
    let [mixed_steady, mixed_cycle] = synthetic::mixed::both(title);
    let previews = [
        ("load-cycle", synthetic::load_cycle(title)),
        ("not-converged", synthetic::load_cycle_not_converged(title)),
        ("steady", synthetic::steady(title)),
        ("mixed-steady", mixed_steady),
        ("mixed-cycle", mixed_cycle),
        ("dimensionless", synthetic::dimensionless(title)),
        ("engine", synthetic::machine::inline_six(title, 1, true)),
        (
            "engine-speeds",
            synthetic::machine::inline_six(title, 8, true),
        ),
        ("shaft", synthetic::machine::shaft(title)),
    ];
    for (name, results) in previews {
        write_all(&results, &directory.join(name))?;
    }
    Ok(())
}
