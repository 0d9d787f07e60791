//! How do rough surfaces change the mean flow and the mean shear of the oil between them?
//!
//! ```text
//! flow around   -phi_x h^3/(12 eta) dp/dx + (U_J + U_S)/2 h_T + (U_J - U_S)/2 sigma phi_s
//! flow along    -phi_z h^3/(12 eta) dp/dz
//! shear stress  eta (U_J - U_S)/h (phi_f -+ phi_fs) +- phi_fp h/2 dp/dx
//! ```
//! eta du/dy with y from shell to journal; upper signs at the journal's wall, lower ones at the shell's.
//! h is the nominal gap, x runs around. A rough surface also takes pressure on its slopes: against a
//! smooth one in a uniform mean gap, the drag on both is the shear stress at the SMOOTH wall, with
//! phi_f + |phi_fs|.
//!
//! The factors are the fits of Patir and Cheng over H = h/sigma, one row per Peklenik number;
//! `phi_z(H, g) = phi_x(H, 1/g)`. phi_f has a closed form for heights distributed as
//! `(35/96 sigma)(1 - (height/3 sigma)^2)^3` with gaps above sigma/100 counted.
//! - Peklenik numbers between rows: factors are interpolated linearly in ln g, continuous with a bend at rows.
//! - Different numbers on the two surfaces: phi_x, phi_z and phi_fp are averaged with the surfaces'
//!   variances, phi_s and phi_fs are differences so weighted (Patir and Cheng 1979). To second order
//!   in sigma/h independent surfaces act separately, each by its variance (Tripp 1983), so the
//!   average is the limit for H large; for small H it is an assumption.
//! - Below the range of a fit ([`FlowFactors`]) each row is continued with its value and slope, bounded
//!   and monotone; where pieces of a fit meet with a step they are blended. All are C1 in the gap.
//!
//! References: N. Patir, H. S. Cheng, J. Lubr. Technol. 100 (1978) 12 and 101 (1979) 220; J. H. Tripp,
//! J. Lubr. Technol. 105 (1983) 458.

use crate::roughness::{FinishError, LARGEST_PEKLENIK, MeanGap, OfGap, Roughness, mean_gap};
use std::ops::RangeInclusive;

mod fits;
mod sliding;
pub(crate) mod table;

use fits::{ROWS, Reading};

/// Weights of the rows of Peklenik numbers.
type Weights = [f64; 7];

/// Flow and stress factors of one pair of surfaces, functions of the nominal gap (m, either sign).
///
/// | factor | fit holds from H | below |
/// |---|---|---|
/// | `pressure_around`, `pressure_along` | 1 (g = 1/9, 1/6), 0.75 (1/3), 0.5 | falls to 1 % of its value there (g <= 1); rises to a limit (g > 1) |
/// | `conductance_around`, `conductance_along` | the same | falls to 1 % of its value there |
/// | `shear_flow`, `shear`, `shear_over_gap`, `shear_difference` | 0.5 | to 0 exponentially |
/// | `shear_by_pressure` | 1 (g <= 1/3), 0.75 (1), 0.5 | to 0 exponentially |
///
/// The 1 % is no physics: it lets oil that is dragged into contact leave, so that its pressure stays
/// bounded at any overlap. `shear_flow` is blended between its two formulas for H from 4.75 to 5.25; `shear_difference`, which the
/// source cuts off at H = 7, fades out from 6 on.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowFactors {
    sigma: f64,
    /// Of pressure around, by variances.
    around: Weights,
    /// Of pressure along the axis: reciprocal Peklenik numbers.
    along: Weights,
    /// Journal less shell, by variances.
    difference: Weights,
}

impl FlowFactors {
    /// Peklenik numbers that have flow factors.
    pub const PEKLENIK: RangeInclusive<f64> = 1.0 / LARGEST_PEKLENIK..=LARGEST_PEKLENIK;

    /// Factors of two surfaces.
    ///
    /// # Errors
    /// As [`Roughness::check`].
    pub fn new(roughness: &Roughness) -> Result<Self, FinishError> {
        roughness.check()?;
        let [journal, shell] = roughness.variance_shares();
        let (g_journal, g_shell) = (roughness.peklenik_journal, roughness.peklenik_shell);
        let mut factors = Self {
            sigma: roughness.composite(),
            around: [0.0; 7],
            along: [0.0; 7],
            difference: [0.0; 7],
        };
        add(&mut factors.around, g_journal, journal);
        add(&mut factors.around, g_shell, shell);
        add(&mut factors.along, 1.0 / g_journal, journal);
        add(&mut factors.along, 1.0 / g_shell, shell);
        add(&mut factors.difference, g_journal, journal);
        add(&mut factors.difference, g_shell, -shell);
        Ok(factors)
    }

    /// Composite rms roughness, m.
    #[must_use]
    pub fn sigma(&self) -> f64 {
        self.sigma
    }

    /// Mean gap h_T and contact factor.
    #[must_use]
    pub fn mean_gap(&self, gap: f64) -> MeanGap {
        mean_gap(gap, self.sigma)
    }

    /// phi_x: pressure flow around the bearing over that between smooth surfaces.
    #[must_use]
    pub fn pressure_around(&self, gap: f64) -> OfGap {
        self.blend(&self.around, gap, fits::pressure)
    }

    /// phi_z: pressure flow along the axis over that between smooth surfaces.
    #[must_use]
    pub fn pressure_along(&self, gap: f64) -> OfGap {
        self.blend(&self.along, gap, fits::pressure)
    }

    /// `phi_x h^3`, m3, positive at any gap: what an operator takes for the cubed gap.
    #[must_use]
    pub fn conductance_around(&self, gap: f64) -> OfGap {
        self.conductance(&self.around, gap)
    }

    /// `phi_z h^3`, m3, positive at any gap.
    #[must_use]
    pub fn conductance_along(&self, gap: f64) -> OfGap {
        self.conductance(&self.along, gap)
    }

    /// phi_s: flow carried along by sliding, over sigma (U_J - U_S)/2; positive where the journal is
    /// the rougher surface.
    #[must_use]
    pub fn shear_flow(&self, gap: f64) -> OfGap {
        self.blend(&self.difference, gap, fits::shear_flow)
    }

    /// phi_f: the mean of gap over local gap; the same for all surfaces.
    #[must_use]
    pub fn shear(&self, gap: f64) -> OfGap {
        self.of_gap(1.0, sliding::phi_f(gap / self.sigma))
    }

    /// `phi_f/h`, 1/m, positive at any gap: mean shear rate per sliding speed.
    #[must_use]
    pub fn shear_over_gap(&self, gap: f64) -> OfGap {
        let inverse = sliding::phi_f_over_h(gap / self.sigma);
        self.of_gap(1.0 / self.sigma, inverse)
    }

    /// phi_fs: half of what the wall shear stresses of shell and journal differ by, over eta (U_J - U_S)/h.
    #[must_use]
    pub fn shear_difference(&self, gap: f64) -> OfGap {
        self.blend(&self.difference, gap, fits::shear_difference)
    }

    /// phi_fp: shear stress by pressure flow over that between smooth surfaces.
    #[must_use]
    pub fn shear_by_pressure(&self, gap: f64) -> OfGap {
        self.blend(&self.around, gap, fits::shear_by_pressure)
    }

    /// The laws of a face around over H: `phi_x H^3`, phi_s and phi_fp with their derivatives by H.
    pub(crate) fn at_face(&self, h: f64) -> [(f64, f64); 3] {
        [
            weighted(&self.around, h, fits::conductance),
            weighted(&self.difference, h, fits::shear_flow),
            weighted(&self.around, h, fits::shear_by_pressure),
        ]
    }

    /// The same of a face along the axis: `phi_z H^3`.
    pub(crate) fn at_end(&self, h: f64) -> [(f64, f64); 1] {
        [weighted(&self.along, h, fits::conductance)]
    }

    /// The same of a cell: `phi_f/H` and phi_fs.
    pub(crate) fn at_cell(&self, h: f64) -> [(f64, f64); 2] {
        [
            sliding::phi_f_over_h(h),
            weighted(&self.difference, h, fits::shear_difference),
        ]
    }

    fn conductance(&self, weights: &Weights, gap: f64) -> OfGap {
        let cubed = self.sigma * self.sigma * self.sigma;
        let h = gap / self.sigma;
        self.of_gap(cubed, weighted(weights, h, fits::conductance))
    }

    fn blend(&self, weights: &Weights, gap: f64, fit: fn(usize, f64) -> Reading) -> OfGap {
        self.of_gap(1.0, weighted(weights, gap / self.sigma, fit))
    }

    /// From a function of H to one of the gap.
    fn of_gap(&self, unit: f64, (value, by_h): Reading) -> OfGap {
        OfGap {
            value: unit * value,
            by_gap: unit * by_h / self.sigma,
        }
    }
}

/// Adds a surface with the Peklenik number `g` and a share to the weights of the rows.
fn add(weights: &mut Weights, g: f64, share: f64) {
    let last = ROWS.len() - 1;
    // both ends come from a check that allows for their round-off
    let g = g.clamp(ROWS[0].peklenik, ROWS[last].peklenik);
    let k = ROWS.partition_point(|row| row.peklenik <= g).clamp(1, last);
    let (from, to) = (ROWS[k - 1].peklenik, ROWS[k].peklenik);
    let t = (g / from).ln() / (to / from).ln();
    weights[k - 1] += share * (1.0 - t);
    weights[k] += share * t;
}

/// Sum of a fit over rows that have a weight.
fn weighted(weights: &Weights, h: f64, fit: fn(usize, f64) -> Reading) -> Reading {
    let (mut value, mut by_h) = (0.0, 0.0);
    for (k, weight) in weights.iter().enumerate() {
        if *weight != 0.0 {
            let (v, s) = fit(k, h);
            value += weight * v;
            by_h += weight * s;
        }
    }
    (value, by_h)
}

#[cfg(test)]
mod tests;
