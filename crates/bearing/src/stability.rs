//! Above which journal mass does a bearing begin to whirl by itself?
//!
//! Equation: `mass q'' + C q' + K q = 0` for the aligned journal (rigid rotor on equal bearings). On
//! the threshold the motion is harmonic; with the equivalent stiffness
//! `k = (Kxx Cyy + Kyy Cxx - Kxy Cyx - Kyx Cxy)/(Cxx + Cyy)` the whirl speed follows from
//! `whirl^2 = [(k - Kxx)(k - Kyy) - Kxy Kyx]/(Cxx Cyy - Cxy Cyx)` and `mass = k/whirl^2`
//! (Routh-Hurwitz).
//! Limits: small motion around an equilibrium; coefficients taken at that running speed.
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

/// Threshold mass of these coefficients; `None` where every mass is stable.
#[must_use]
pub fn whirl_threshold(coefficients: &Coefficients) -> Option<WhirlThreshold> {
    let [[kxx, kxy], [kyx, kyy]] = coefficients.translation_stiffness();
    let [[cxx, cxy], [cyx, cyy]] = coefficients.translation_damping();
    let equivalent = (kxx * cyy + kyy * cxx - kxy * cyx - kyx * cxy) / (cxx + cyy);
    let whirl_square =
        ((equivalent - kxx) * (equivalent - kyy) - kxy * kyx) / (cxx * cyy - cxy * cyx);
    (whirl_square > 0.0 && equivalent > 0.0).then(|| WhirlThreshold {
        mass: equivalent / whirl_square,
        whirl_speed: whirl_square.sqrt(),
    })
}
