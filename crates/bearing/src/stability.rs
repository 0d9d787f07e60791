//! Above which journal mass does a bearing begin to whirl by itself?
//!
//! Equation: `mass q'' + C q' + K q = 0` for the aligned journal (rigid rotor on equal bearings). With
//! `b = Kxx Cyy + Kyy Cxx - Kxy Cyx - Kyx Cxy` and the equivalent stiffness `k = b/(Cxx + Cyy)`, the
//! conditions of Routh and Hurwitz for all four roots to decay are
//! ```text
//! Cxx + Cyy > 0      b > 0      det K > 0      k det C > mass [(k - Kxx)(k - Kyy) - Kxy Kyx]
//! ```
//! On the threshold the motion is harmonic: `whirl^2 = [(k - Kxx)(k - Kyy) - Kxy Kyx]/det C` and
//! `mass = k/whirl^2`. Where the bracket is not positive, the last condition holds for every mass;
//! where one of the first three fails, for none.
//! Limits: small motion around an equilibrium; coefficients taken at that running speed; the tilt is
//! held, so that a rotor on two equal bearings is meant, each carrying the mass given.
//! Reference: J. W. Lund, E. Saibel, J. Eng. Ind. 89 (1967) 813, 10.1115/1.3610169.

use crate::Coefficients;
use serde::{Deserialize, Serialize};

/// Threshold of self-excited whirl at one running condition.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WhirlThreshold {
    /// Largest stable mass per bearing, kg.
    pub mass: f64,
    /// Angular speed of the whirl on the threshold, rad/s.
    pub whirl_speed: f64,
}

/// For which masses a rigid rotor is stable.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stability {
    /// Below a threshold.
    Below(WhirlThreshold),
    /// For every mass.
    EveryMass,
    /// For none: the film drives the journal away or around however light it is.
    NoMass,
}

impl Stability {
    /// The threshold, where there is one.
    #[must_use]
    pub fn threshold(&self) -> Option<WhirlThreshold> {
        match self {
            Self::Below(threshold) => Some(*threshold),
            Self::EveryMass | Self::NoMass => None,
        }
    }

    /// Threshold mass over the mass of the rotor (kg per bearing): stable above 1. Infinite where
    /// every mass is stable, 0 where none is.
    #[must_use]
    pub fn margin(&self, rotor_mass: f64) -> f64 {
        match self {
            Self::Below(threshold) => threshold.mass / rotor_mass,
            Self::EveryMass => f64::INFINITY,
            Self::NoMass => 0.0,
        }
    }

    /// Whether small motions of a rotor of this mass (kg per bearing) decay.
    #[must_use]
    pub fn is_stable(&self, rotor_mass: f64) -> bool {
        self.margin(rotor_mass) > 1.0
    }
}

/// For which masses a rigid rotor on a film of these coefficients is stable.
#[must_use]
pub fn rotor_stability(coefficients: &Coefficients) -> Stability {
    let [[kxx, kxy], [kyx, kyy]] = coefficients.translation_stiffness();
    let [[cxx, cxy], [cyx, cyy]] = coefficients.translation_damping();
    let equivalent = (kxx * cyy + kyy * cxx - kxy * cyx - kyx * cxy) / (cxx + cyy);
    let decays = cxx + cyy > 0.0 && equivalent > 0.0 && kxx * kyy > kxy * kyx;
    let damping = cxx * cyy - cxy * cyx;
    let driving = (equivalent - kxx) * (equivalent - kyy) - kxy * kyx;
    if !decays || (damping <= 0.0 && driving > 0.0) {
        return Stability::NoMass;
    }
    let whirl_square = driving / damping;
    if driving <= 0.0 {
        return Stability::EveryMass;
    }
    Stability::Below(WhirlThreshold {
        mass: equivalent / whirl_square,
        whirl_speed: whirl_square.sqrt(),
    })
}

/// Threshold mass of these coefficients; `None` where every mass is stable, or none ([`rotor_stability`]
/// tells which).
#[must_use]
pub fn whirl_threshold(coefficients: &Coefficients) -> Option<WhirlThreshold> {
    rotor_stability(coefficients).threshold()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coefficients of an aligned journal.
    fn film(stiffness: [[f64; 2]; 2], damping: [[f64; 2]; 2]) -> Coefficients {
        let whole = |part: [[f64; 2]; 2]| {
            let mut matrix = [[0.0; 4]; 4];
            for (row, values) in part.iter().enumerate() {
                matrix[row][..2].copy_from_slice(values);
            }
            matrix
        };
        Coefficients {
            stiffness: whole(stiffness),
            damping: whole(damping),
        }
    }

    /// `mass q'' + c q' + (k, s; -s, k) q = 0`: with z = x + i y a single equation of which
    /// `mass = k (c/s)^2` is the threshold and `s/c` the whirl speed.
    #[test]
    fn the_isotropic_rotor_has_its_closed_form() {
        let (k, s, c) = (3e7, 2e7, 1e5);
        let drive = film([[k, s], [-s, k]], [[c, 0.0], [0.0, c]]);
        let threshold = rotor_stability(&drive)
            .threshold()
            .map(|t| (t.mass, t.whirl_speed));
        let (mass, speed) = threshold.unwrap_or_default();
        assert!((mass / (k * (c / s).powi(2)) - 1.0).abs() < 1e-12, "{mass}");
        assert!((speed / (s / c) - 1.0).abs() < 1e-12, "{speed}");
        assert!(
            rotor_stability(&drive).is_stable(0.999 * mass)
                && !rotor_stability(&drive).is_stable(1.001 * mass)
        );
        assert!((rotor_stability(&drive).margin(0.5 * mass) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn stable_for_every_mass_and_for_none_are_told_apart() {
        let c = [[1.0, 0.0], [0.0, 2.0]];
        let conservative = film([[1.0, 0.2], [0.2, 2.0]], c);
        assert_eq!(rotor_stability(&conservative), Stability::EveryMass);
        assert!(rotor_stability(&conservative).is_stable(1e9));
        let falling = film([[-1.0, 0.0], [0.0, 2.0]], c);
        assert_eq!(rotor_stability(&falling), Stability::NoMass);
        assert!(!rotor_stability(&falling).is_stable(1e-9));
        assert_eq!(whirl_threshold(&falling), None);
    }
}
