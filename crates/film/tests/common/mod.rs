//! Bearings that the tests share.
#![allow(dead_code, clippy::panic, clippy::unwrap_used)]

pub mod direct;
pub mod planar;
pub mod recomputed;
pub mod shaped;

use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Conditions, Ends, Feed, FeedLine, FeedShape, FilmShear, Inlet,
    Shape,
};
use sommerfeld_oil::Lubricant;

/// The plain big end of the reference data: D 72, B 30 mm, radial clearance 36 um.
pub fn big_end() -> Bearing {
    Bearing {
        diameter: 0.072,
        width: 0.030,
        radial_clearance: 36e-6,
        bore: Shape::cylindrical(),
        journal: Shape::cylindrical(),
        feeds: Vec::new(),
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Air,
        inlet: Inlet::Cyclic,
        cavitation: Cavitation::MassConserving,
        film_shear: FilmShear::FilmFraction,
        finish: sommerfeld_film::Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
    }
}

/// A hole of 6 mm in the journal at 5 bar.
pub fn feed_hole() -> Feed {
    Feed {
        shape: FeedShape::Hole { diameter: 6e-3 },
        carried_by: Carrier::Journal,
        angle: std::f64::consts::FRAC_PI_2,
        position: 0.0,
        pressure: 5e5,
        line: FeedLine::Direct,
    }
}

/// 8 mPa s, 850 kg/m3.
pub fn oil() -> Lubricant {
    Lubricant::constant(8e-3, 850.0)
}

/// 100 degC, feeds at their own pressure.
pub fn conditions() -> Conditions<'static> {
    Conditions {
        temperature: 373.15,
        feed_pressures: None,
    }
}

/// Rows of `validation/<case>/<file>` as numbers by column; lines that open with `#` and the header
/// are left out, and words become NaN.
pub fn reference_rows(case: &str, file: &str) -> Vec<Vec<f64>> {
    let path = format!(
        "{}/../../validation/{case}/{file}",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    text.lines()
        .filter(|line| !line.starts_with('#') && !line.trim().is_empty())
        .skip(1)
        .map(|line| {
            line.split(',')
                .map(|v| v.trim().parse().unwrap_or(f64::NAN))
                .collect()
        })
        .collect()
}

/// Dimensionless bearing: R = 1 m, psi = 1e-3, width 2 B/D, so that with 1 rad/s and [`unit_oil`]
/// pressures are `Pi` and forces four times `So` times B/D.
pub fn unit_bearing(width_ratio: f64) -> Bearing {
    Bearing {
        diameter: 2.0,
        width: 2.0 * width_ratio,
        radial_clearance: 1e-3,
        cavitation: Cavitation::Reynolds,
        film_shear: FilmShear::FullWidth,
        finish: sommerfeld_film::Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
        ..big_end()
    }
}

/// eta = psi^2, so that `p psi^2/(eta omega) = p` at 1 rad/s.
pub fn unit_oil() -> Lubricant {
    Lubricant::constant(1e-6, 850.0)
}

/// Order by least squares of `ln error` over `ln cells`, from `(cells, error)`.
pub fn least_squares_order(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|(c, e)| (c.ln(), e.ln())).collect();
    let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(|l| l.0), mean(|l| l.1));
    let covariance: f64 = logs.iter().map(|l| (l.0 - x) * (l.1 - y)).sum();
    let variance: f64 = logs.iter().map(|l| (l.0 - x).powi(2)).sum();
    -covariance / variance
}
