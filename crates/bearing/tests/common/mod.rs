//! What the tests of this crate share.
#![allow(dead_code, clippy::unwrap_used)]

use sommerfeld_film::{Bearing, Cavitation, Conditions, Ends, FilmShear, Inlet, Shape};

pub const CONDITIONS: Conditions<'static> = Conditions {
    temperature: 373.0,
    feed_pressures: None,
};

/// Plain bearing without feeds, ends and ruptured film at ambient pressure.
pub fn plain_bearing(diameter: f64, width: f64, radial_clearance: f64) -> Bearing {
    Bearing {
        diameter,
        width,
        radial_clearance,
        bore: Shape::cylindrical(),
        journal: Shape::cylindrical(),
        feeds: Vec::new(),
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Air,
        inlet: Inlet::Cyclic,
        cavitation: Cavitation::Gumbel,
        film_shear: FilmShear::FullWidth,
    }
}

/// Numbers of a committed table: comments and the header left out.
pub fn table(path: &str) -> Vec<Vec<f64>> {
    let path = format!("{}/../../validation/{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path)
        .unwrap()
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| {
            line.split(',')
                .map(|cell| cell.trim().parse().unwrap())
                .collect()
        })
        .collect()
}

/// Cells of a committed table: comments and the header left out.
pub fn text_table(path: &str) -> Vec<Vec<String>> {
    let path = format!("{}/../../validation/{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path)
        .unwrap()
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.trim().to_owned()).collect())
        .collect()
}
