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
mod tests {
    use super::*;

    /// Rows of `validation/elastic-layer`: 2 mm under 100 MPa.
    #[test]
    fn thin_layers_give_way_as_constrained_columns() {
        for (modulus, poisson, um) in [(29e9, 0.33, 4.6547), (0.9e9, 0.35, 138.46)] {
            let layer = Elasticity::Layer {
                thickness: 2e-3,
                modulus,
                poisson,
            };
            let displacement = 1e6 * 100e6 * layer.compliance();
            assert!((displacement / um - 1.0).abs() < 2e-5, "{displacement}");
        }
        assert_eq!(Elasticity::Rigid.compliance(), 0.0);
    }
}
