//! Tables and bearings that the tests share.
#![allow(dead_code, clippy::panic, clippy::unwrap_used)]

use sommerfeld_database::{Recipe, Table, generate};
use sommerfeld_film::dimensionless::DimensionlessFilm;
use sommerfeld_film::{Bearing, Cavitation, Conditions, Inlet, JournalState};
use std::path::PathBuf;
use std::sync::Arc;

/// A table with few samples.
pub fn recipe(closure: Cavitation, width_ratio: f64, target: f64) -> Recipe {
    Recipe {
        target,
        samples: 100,
        ..Recipe::new(closure, width_ratio)
    }
}

pub fn table(closure: Cavitation, width_ratio: f64, target: f64) -> Arc<Table> {
    Arc::new(generate(&recipe(closure, width_ratio, target), &(), None).unwrap())
}

/// The dimensionless film of a state; its bearing has R = 1 m, c = 1e-3 m, its oil 1e-6 Pa s.
pub fn unit_film(closure: Cavitation, width_ratio: f64) -> DimensionlessFilm {
    DimensionlessFilm {
        d_over_b: 1.0 / width_ratio,
        relative_eccentricity: 0.5,
        tilt_gamma: 0.0,
        tilt_delta: 0.0,
        wedge: 1.0,
        squeeze: 0.0,
        cavitation: closure,
        inlet: Inlet::Cyclic,
    }
}

pub const VISCOSITY: f64 = 1e-6;

pub fn unit_bearing(closure: Cavitation, width_ratio: f64) -> Bearing {
    unit_film(closure, width_ratio).bearing()
}

pub const CONDITIONS: Conditions<'_> = Conditions {
    temperature: 373.15,
    feed_pressures: None,
};

/// A journal on its way around, at step `k`, out to relative eccentricity `reach`.
pub fn state(bearing: &Bearing, k: usize, reach: f64) -> JournalState {
    let c = bearing.radial_clearance;
    let part = |factor: f64| (k as f64 * factor).sin();
    let (eps, angle) = (reach * part(0.7).abs(), 3.0 * part(1.3));
    JournalState {
        position: [eps * c * angle.cos(), eps * c * angle.sin()],
        velocity: [2.0 * c * part(2.1), 2.0 * c * part(0.37)],
        journal_speed: 3.0 * part(0.11),
        shell_speed: 0.3,
        ..JournalState::default()
    }
}

/// Rows of `validation/<case>/reference.csv`, without comments and header.
pub fn reference_rows(case: &str) -> Vec<Vec<f64>> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../validation")
        .join(case)
        .join("reference.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(|row| {
        row.split(',')
            .map(|cell| cell.trim().parse().unwrap())
            .collect()
    })
    .collect()
}
