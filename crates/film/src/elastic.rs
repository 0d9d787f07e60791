//! How far does the shell give way under pressure?
//!
//! - Rigid: not at all.
//! - Layer: a thin soft layer bonded to a rigid backing, so thin that it can only be compressed, not pushed
//!   aside (constrained column): each place moves by its own pressure,
//!   `u = (1 + nu)(1 - 2 nu)/(1 - nu) t/E p`. Valid for layers much thinner than the pressure changes
//!   along; not for nu towards 1/2, where the layer gives way sideways after all.
//!
//! Reference: K. L. Johnson, Contact Mechanics, Cambridge 1985, ch. 5.8 (thin compressible layers).

use serde::{Deserialize, Serialize};

/// How the running surface of the shell gives way.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "elastic", rename_all = "kebab-case")]
pub enum Elasticity {
    /// Not at all.
    #[default]
    Rigid,
    /// A thin layer bonded to a rigid backing.
    Layer {
        /// Thickness, m.
        thickness: f64,
        /// Young's modulus, Pa.
        modulus: f64,
        /// Poisson's ratio, 0 to below 1/2.
        poisson: f64,
    },
}

impl Elasticity {
    /// Displacement per pressure where the pressure acts, m/Pa; zero for a rigid shell.
    #[must_use]
    pub fn compliance(&self) -> f64 {
        match *self {
            Self::Rigid => 0.0,
            Self::Layer {
                thickness,
                modulus,
                poisson,
            } => (1.0 + poisson) * (1.0 - 2.0 * poisson) / (1.0 - poisson) * thickness / modulus,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]
mod tests {
    use super::*;

    /// Rows of `validation/elastic-layer`.
    #[test]
    fn thin_layers_give_way_as_constrained_columns() {
        let table = include_str!("../../../validation/elastic-layer/reference.csv");
        let rows = table.lines().filter(|line| !line.starts_with('#')).skip(1);
        let mut read = 0;
        for row in rows {
            let cells: Vec<f64> = row.split(',').map(|c| c.parse().unwrap()).collect();
            let layer = Elasticity::Layer {
                thickness: 1e-3 * cells[0],
                modulus: 1e9 * cells[1],
                poisson: cells[2],
            };
            let displacement = 1e6 * 1e6 * cells[3] * layer.compliance();
            let (expected, bar) = (cells[4], cells[5]);
            assert!(
                (displacement - expected).abs() < bar,
                "{row}: {displacement}"
            );
            read += 1;
        }
        assert_eq!(read, 2);
        assert_eq!(Elasticity::Rigid.compliance(), 0.0);
    }
}
