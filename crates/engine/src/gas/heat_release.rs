//! How the fuel burns over the crank angle.
//!
//! Question: which share of the heat is released at a crank angle?
//!
//! Wiebe: `x = 1 - exp(-a ((angle - start)/duration)^n)`, `n = m + 1` with Wiebe's form `m`. With `a = 5`
//! 99.3 % has burnt after the duration, with 6.908 99.9 %; the rest burns on, the curve is not cut off. A
//! double or multiple Wiebe function is a sum with shares: premixed and diffusion burning of a diesel.
//!
//! References: I. Wiebe, Brennverlauf und Kreisprozess von Verbrennungsmotoren, VEB Verlag Technik,
//! Berlin 1970; J. B. Heywood, Internal Combustion Engine Fundamentals, McGraw-Hill 1988, 9.2 (a = 5,
//! m = 2 for spark ignition); N. Miyamoto et al., SAE 850107, 1985 (two functions for diesels).

use crate::CombustionError;
use serde::{Deserialize, Serialize};

/// How far shares may sum to another number than 1.
const SHARES_TOLERANCE: f64 = 1e-9;

/// One Wiebe function.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Wiebe {
    /// Crank angle from the firing top dead centre where burning begins, rad.
    pub start: f64,
    /// Crank angle in which the share `1 - exp(-efficiency)` burns, rad.
    pub duration: f64,
    /// The parameter `a`: about 5 to 7.
    pub efficiency: f64,
    /// The exponent `n`, one more than Wiebe's form: about 1.5 to 5.
    pub exponent: f64,
}

impl Wiebe {
    /// Share burnt at a crank angle.
    #[must_use]
    pub fn burnt(&self, angle: f64) -> f64 {
        let way = (angle - self.start) / self.duration;
        if way <= 0.0 {
            return 0.0;
        }
        -(-self.efficiency * way.powf(self.exponent)).exp_m1()
    }

    /// Its change with the crank angle, 1/rad.
    #[must_use]
    pub fn rate(&self, angle: f64) -> f64 {
        let way = (angle - self.start) / self.duration;
        if way <= 0.0 {
            return 0.0;
        }
        let (a, n) = (self.efficiency, self.exponent);
        a * n / self.duration * way.powf(n - 1.0) * (-a * way.powf(n)).exp()
    }
}

/// The heat of one cycle and how it is released.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeatRelease {
    /// Heat of the fuel burnt in one cycle and cylinder, J; 0 for a motored engine.
    pub heat: f64,
    /// Shares, 1 in all, and how each burns.
    pub parts: Vec<(f64, Wiebe)>,
}

impl HeatRelease {
    /// All heat by one function.
    #[must_use]
    pub fn single(heat: f64, wiebe: Wiebe) -> Self {
        Self {
            heat,
            parts: vec![(1.0, wiebe)],
        }
    }

    /// No heat: a motored engine.
    #[must_use]
    pub const fn none() -> Self {
        Self {
            heat: 0.0,
            parts: Vec::new(),
        }
    }

    /// Heat released from the beginning to a crank angle, J.
    #[must_use]
    pub fn released(&self, angle: f64) -> f64 {
        let shares = self
            .parts
            .iter()
            .map(|(share, part)| share * part.burnt(angle));
        self.heat * shares.sum::<f64>()
    }

    /// Heat released by crank angle, J/rad.
    #[must_use]
    pub fn rate(&self, angle: f64) -> f64 {
        let shares = self
            .parts
            .iter()
            .map(|(share, part)| share * part.rate(angle));
        self.heat * shares.sum::<f64>()
    }

    /// Where the first part begins to burn, rad; infinite without one.
    #[must_use]
    pub fn start(&self) -> f64 {
        let starts = self.parts.iter().map(|(_, part)| part.start);
        starts.fold(f64::INFINITY, f64::min)
    }

    /// Refuses what does not burn between two crank angles.
    ///
    /// # Errors
    /// [`CombustionError`] with the number that is out of range.
    pub fn check(&self, from: f64, to: f64) -> Result<(), CombustionError> {
        let refuse = CombustionError::unless;
        let heat = self.heat;
        refuse(
            heat >= 0.0 && heat.is_finite(),
            "heat released",
            heat,
            "0 J and above",
        )?;
        for &(share, part) in &self.parts {
            refuse(
                (0.0..=1.0).contains(&share),
                "share of the heat",
                share,
                "0 to 1",
            )?;
            let begins = part.start > from && part.start < to;
            let allowed = "between closing of the intake and opening of the exhaust";
            refuse(begins, "start of burning", part.start, allowed)?;
            let lasts = part.duration > 0.0 && part.duration.is_finite();
            refuse(lasts, "duration of burning", part.duration, "above 0 rad")?;
            let burns = (1.0..=20.0).contains(&part.efficiency);
            refuse(burns, "Wiebe efficiency", part.efficiency, "1 to 20")?;
            let exponent = part.exponent;
            refuse(
                (1.0..=20.0).contains(&exponent),
                "Wiebe exponent",
                exponent,
                "1 to 20",
            )?;
        }
        let sum: f64 = self.parts.iter().map(|(share, _)| share).sum();
        let whole = (sum - 1.0).abs() <= SHARES_TOLERANCE;
        let motored = self.parts.is_empty() && heat == 0.0;
        refuse(whole || motored, "sum of the shares of the heat", sum, "1")
    }
}
