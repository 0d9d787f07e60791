//! How rough are the two surfaces, and how much room do they leave between them?
//!
//! Heights are Gaussian and independent on both surfaces, so that variances add:
//! `sigma^2 = sigma_journal^2 + sigma_shell^2`. With H = h/sigma the gap averaged over the heights
//! that do not touch is
//!
//! ```text
//! h_T/sigma = H/2 (1 + erf(H/sqrt 2)) + exp(-H^2/2)/sqrt(2 pi) = F_1(-H) = H + F_1(H)
//! dh_T/dh   = (1 + erf(H/sqrt 2))/2 = 1 + F_1'(H)              the contact factor
//! ```
//! which is positive at any H, also where the mean planes overlap, and h itself above H = 36.
//! The Peklenik number of a surface is the ratio of its correlation lengths around and along the
//! axis: above 1 for marks that run around, as turning and grinding leave them.
//!
//! References: N. Patir, H. S. Cheng, J. Lubr. Technol. 100 (1978) 12; C. Wu, L. Zheng, J. Tribol. 111
//! (1989) 188 (contact factor).

use crate::height_integrals::F_1;
use serde::{Deserialize, Serialize};

/// Largest rms roughness that is taken for one, m: beyond it a unit is wrong.
pub const LARGEST_ROUGHNESS: f64 = 1e-4;
/// Largest Peklenik number with flow factors; the smallest is its reciprocal.
pub const LARGEST_PEKLENIK: f64 = 9.0;

/// A value that depends on the gap, with its exact derivative.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct OfGap {
    /// The value, in the unit of its law.
    pub value: f64,
    /// Derivative with respect to the gap, unit of the value per m.
    pub by_gap: f64,
}

/// What is wrong with a description of rough surfaces.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FinishError {
    /// A value outside what the law is known for.
    #[error("{name} is {value}: it must lie between {from} and {to}")]
    OutOfRange {
        /// The parameter, as the study file calls it.
        name: &'static str,
        /// What was given, SI.
        value: f64,
        /// Smallest value.
        from: f64,
        /// Largest value.
        to: f64,
    },
    /// A parameter that must be positive and finite is not.
    #[error("{name} must be positive, not {value}")]
    NotPositive {
        /// The parameter, as the study file calls it.
        name: &'static str,
        /// What was given, SI.
        value: f64,
    },
    /// Rough surfaces or contact were asked for with both roughnesses zero.
    #[error(
        "roughness_journal and roughness_shell are both zero: contact and flow factors need one \
         above zero; smooth surfaces are described by no roughness and no contact at all"
    )]
    NoRoughness,
    /// A contact table of one row or none.
    #[error("a contact table needs at least two rows of gap and pressure")]
    TooFewRows,
    /// A contact table with a value that is no number or infinite.
    #[error("row {row} of the contact table holds something that is no finite number")]
    NotFinite {
        /// Its place, from 1.
        row: usize,
    },
    /// Rows whose gap does not rise or whose pressure does not fall.
    #[error(
        "row {row} of the contact table: from row to row the gap must rise and the pressure fall"
    )]
    NotMonotone {
        /// Place of the row that breaks the order, from 1.
        row: usize,
    },
    /// A contact table that ends under pressure.
    #[error(
        "the contact table ends at {pressure} Pa: its last row must be the gap where contact ends, \
         at a pressure of zero"
    )]
    EndsUnderPressure {
        /// Pressure of the last row, Pa.
        pressure: f64,
    },
}

/// Roughness of both surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Roughness {
    /// rms roughness of the journal, m.
    pub journal: f64,
    /// rms roughness of the shell, m.
    pub shell: f64,
    /// Peklenik number of the journal: correlation length around over that along the axis.
    #[serde(default = "isotropic")]
    pub peklenik_journal: f64,
    /// Peklenik number of the shell.
    #[serde(default = "isotropic")]
    pub peklenik_shell: f64,
}

/// Marks that run nowhere in particular.
fn isotropic() -> f64 {
    1.0
}

impl Roughness {
    /// Composite rms roughness, m.
    #[must_use]
    pub fn composite(&self) -> f64 {
        self.journal.hypot(self.shell)
    }

    /// Shares of journal and shell in the variance; they add up to 1.
    #[must_use]
    pub fn variance_shares(&self) -> [f64; 2] {
        let sigma = self.composite();
        let share = |rms: f64| (rms / sigma) * (rms / sigma);
        [share(self.journal), share(self.shell)]
    }

    /// Refuses what is no roughness.
    ///
    /// # Errors
    /// [`FinishError::OutOfRange`] for an rms roughness below zero or above [`LARGEST_ROUGHNESS`], or
    /// a Peklenik number outside 1/9 to 9; [`FinishError::NoRoughness`] where both are zero.
    pub fn check(&self) -> Result<(), FinishError> {
        within("roughness_journal", self.journal, 0.0, LARGEST_ROUGHNESS)?;
        within("roughness_shell", self.shell, 0.0, LARGEST_ROUGHNESS)?;
        let (from, to) = (1.0 / LARGEST_PEKLENIK, LARGEST_PEKLENIK);
        within("peklenik_journal", self.peklenik_journal, from, to)?;
        within("peklenik_shell", self.peklenik_shell, from, to)?;
        if self.composite() > 0.0 {
            Ok(())
        } else {
            Err(FinishError::NoRoughness)
        }
    }

    /// Mean gap at the nominal gap `gap` (m, either sign).
    #[must_use]
    pub fn mean_gap(&self, gap: f64) -> MeanGap {
        mean_gap(gap, self.composite())
    }
}

/// The gap averaged over rough surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanGap {
    /// h_T, m; positive.
    pub value: f64,
    /// The contact factor dh_T/dh, 0 to 1: the share of the surface that does not touch.
    pub contact_factor: f64,
    /// Derivative of the contact factor by the gap, 1/m.
    pub contact_factor_by_gap: f64,
}

/// From this gap over the roughness on, what touches is below round-off: F_1(9) = 1e-20.
const NOTHING_TOUCHES: f64 = 9.0;

/// Mean gap of surfaces with the composite rms roughness `sigma` (m, positive) at a nominal gap
/// `gap` (m, either sign).
#[must_use]
pub fn mean_gap(gap: f64, sigma: f64) -> MeanGap {
    let h = gap / sigma;
    if h > NOTHING_TOUCHES {
        return MeanGap {
            value: gap,
            contact_factor: 1.0,
            contact_factor_by_gap: 0.0,
        };
    }
    let (overlap, by_h) = F_1.at(h.abs());
    // by symmetry F_1(-H) = H + F_1(H): no difference of large numbers on either side
    let (value, contact_factor) = if h >= 0.0 {
        (gap + sigma * overlap, 1.0 + by_h)
    } else {
        (sigma * overlap, -by_h)
    };
    MeanGap {
        value,
        contact_factor,
        // the density exp(-H^2/2)/sqrt(2 pi) by parts: F_1'' = F_1 - H F_1'
        contact_factor_by_gap: (overlap - h.abs() * by_h) / sigma,
    }
}

/// Refuses a value outside a range; not a number is outside.
pub(crate) fn within(
    name: &'static str,
    value: f64,
    from: f64,
    to: f64,
) -> Result<(), FinishError> {
    // 1/9 as written in a study file may be the next number below it
    if value >= from * (1.0 - 1e-12) && value <= to {
        Ok(())
    } else {
        Err(FinishError::OutOfRange {
            name,
            value,
            from,
            to,
        })
    }
}

/// Refuses a parameter that is not positive and finite.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), FinishError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(FinishError::NotPositive { name, value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIGMA: f64 = 0.4e-6;

    /// erf by its series, good to round-off below 3.
    fn erf(x: f64) -> f64 {
        let (mut term, mut sum) = (x, x);
        for k in 1..80 {
            let k = f64::from(k);
            term *= -x * x / k;
            sum += term / (2.0 * k + 1.0);
        }
        std::f64::consts::FRAC_2_SQRT_PI * sum
    }

    #[test]
    fn mean_gap_is_the_formula_with_the_error_function() {
        for i in -40..=40 {
            let h = f64::from(i) * 0.1;
            let half = 0.5 * (1.0 + erf(h * std::f64::consts::FRAC_1_SQRT_2));
            let density = (-0.5 * h * h).exp() / std::f64::consts::TAU.sqrt();
            let want = h * half + density;
            let got = mean_gap(h * SIGMA, SIGMA);
            assert!(
                (got.value / SIGMA - want).abs() < 1e-12,
                "H {h}: {got:?}, {want}"
            );
            assert!(
                (got.contact_factor - half).abs() < 1e-12,
                "H {h}: {got:?}, {half}"
            );
            let by_h = got.contact_factor_by_gap * SIGMA;
            assert!((by_h - density).abs() < 1e-12, "H {h}: {by_h}, {density}");
        }
    }

    #[test]
    fn mean_gap_and_contact_factor_have_exact_derivatives() {
        for i in -80..=80 {
            let gap = f64::from(i) * 0.1 * SIGMA + 1e-9;
            let delta = 1e-4 * SIGMA;
            let (up, down) = (mean_gap(gap + delta, SIGMA), mean_gap(gap - delta, SIGMA));
            let got = mean_gap(gap, SIGMA);
            let value = (up.value - down.value) / (2.0 * delta);
            let factor = (up.contact_factor - down.contact_factor) / (2.0 * delta);
            assert!(
                (got.contact_factor - value).abs() < 1e-8,
                "{got:?}, {value}"
            );
            let by_h = got.contact_factor_by_gap * SIGMA;
            assert!((by_h - factor * SIGMA).abs() < 1e-8, "{got:?}, {factor}");
        }
    }

    #[test]
    fn far_apart_the_mean_gap_is_the_gap_and_overlapping_it_stays_open() {
        assert_eq!(mean_gap(36.0 * SIGMA, SIGMA).value, 36.0 * SIGMA);
        assert_eq!(mean_gap(20e-6, 1e-12).contact_factor, 1.0);
        let deep = mean_gap(-8.0 * SIGMA, SIGMA);
        assert!(deep.value > 0.0 && deep.contact_factor > 0.0, "{deep:?}");
    }

    #[test]
    fn variances_add() {
        let roughness = Roughness {
            journal: 0.3e-6,
            shell: 0.4e-6,
            peklenik_journal: 3.0,
            peklenik_shell: 1.0,
        };
        assert!((roughness.composite() - 0.5e-6).abs() < 1e-20);
        let [journal, shell] = roughness.variance_shares();
        assert!((journal - 0.36).abs() < 1e-14 && (shell - 0.64).abs() < 1e-14);
        assert_eq!(roughness.check(), Ok(()));
    }

    #[test]
    fn what_is_no_roughness_is_refused_by_name_and_range() {
        let good = Roughness {
            journal: 0.3e-6,
            shell: 0.0,
            peklenik_journal: 1.0 / 9.0,
            peklenik_shell: 9.0,
        };
        assert_eq!(good.check(), Ok(()));
        let message = |roughness: Roughness| match roughness.check() {
            Ok(()) => String::new(),
            Err(error) => error.to_string(),
        };
        let smooth = message(Roughness {
            journal: 0.0,
            ..good
        });
        assert!(smooth.contains("both zero"), "{smooth}");
        let unit = message(Roughness {
            shell: 0.28,
            ..good
        });
        assert!(unit.contains("roughness_shell is 0.28"), "{unit}");
        let negative = message(Roughness {
            journal: -1e-7,
            ..good
        });
        assert!(negative.contains("roughness_journal"), "{negative}");
        let nan = message(Roughness {
            shell: f64::NAN,
            ..good
        });
        assert!(nan.contains("roughness_shell"), "{nan}");
        let marks = message(Roughness {
            peklenik_shell: 12.0,
            ..good
        });
        assert!(
            marks.contains("peklenik_shell is 12") && marks.contains("and 9"),
            "{marks}"
        );
    }
}
