//! Which damper leaves the smallest twist.
//!
//! The largest twist of the nose against the flywheel over a band of frequencies, under given
//! torques, is made as small as it gets (minimax) by the damping of a viscous damper, or by the
//! stiffness and the loss of a tuned one. Search: a coarse scan of the logarithm, then golden
//! section; stiffness outside, loss inside.
//! For one disc on a spring it finds what Den Hartog (Mechanical Vibrations, 4th ed. 1956, ch. 3)
//! gives in closed form: with the ratio m of the inertias, the untuned viscous damper
//! `c / (2 J_ring w0) = 1 / sqrt(2 (1 + m)(2 + m))`, peak `1 + 2/m` times the static twist; the tuned
//! one, viscous, nearly a peak of `sqrt(1 + 2/m)` at the tuning `1 / (1 + m)`; of rubber exactly
//! `sqrt(2 (1 + m) / m)` there, at the loss factor `sqrt(m (3 + m) / 2)`.

use super::chain::{Range, require_task};
use super::forced::receptance;
use super::{Damper, TorsionError, TorsionalChain};
use nalgebra::{Complex, DVector};

/// Samples over the band before the peaks are refined.
const BAND_SAMPLES: u32 = 120;
/// Decades to both sides in which damping and loss are sought.
const DECADES: f64 = 3.0;
const COARSE_SAMPLES: u32 = 13;
/// Golden section ends at this width of the logarithm: the peak is flat there to its square.
const LOGARITHM_TOLERANCE: f64 = 1e-6;

/// What a damper at the nose of a chain has to quieten.
#[derive(Debug, Clone, PartialEq)]
pub struct DamperTask {
    /// The chain without the damper.
    pub chain: TorsionalChain,
    /// Torque on each disc, N m, all in phase.
    pub torques: Vec<f64>,
    /// Lowest and highest frequency, rad/s.
    pub band: [f64; 2],
}

/// The best damper found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamperOptimum {
    /// The damper.
    pub damper: Damper,
    /// Largest twist of the nose against the flywheel that it leaves, rad.
    pub peak: f64,
}

impl DamperTask {
    /// Largest twist (rad) of the nose against the last disc over the band, with a damper.
    ///
    /// # Errors
    /// What [`TorsionalChain::check`] refuses of the chain with its damper, torques that are not one
    /// for each disc, a band that is none, an undamped resonance.
    pub fn peak(&self, damper: &Damper) -> Result<f64, TorsionError> {
        let [low, high] = self.band;
        require_task("lowest frequency of the band", low, Range::Positive)?;
        require_task("width of the band", high - low, Range::Positive)?;
        if self.torques.len() != self.chain.discs.len() {
            return Err(TorsionError::Count {
                name: "torques on the discs",
                count: self.torques.len(),
                due: self.chain.discs.len(),
            });
        }
        let matrices = self.chain.with_damper(damper).matrices()?;
        let mut torques = DVector::zeros(self.torques.len() + 1);
        for (at, &torque) in self.torques.iter().enumerate() {
            torques[at + 1] = Complex::from(torque);
        }
        let last = self.torques.len();
        let twist = |logarithm: f64| {
            let twists = receptance(&matrices, logarithm.exp(), &torques)?;
            Ok((twists[1] - twists[last]).norm())
        };
        let (_, highest) = smallest(low.ln(), high.ln(), BAND_SAMPLES, &mut |at| {
            twist(at).map(|twist: f64| -twist)
        })?;
        Ok(-highest)
    }

    /// The damping of a viscous damper with this ring (kg m2).
    ///
    /// # Errors
    /// As [`DamperTask::peak`].
    pub fn best_viscous(&self, ring_inertia: f64) -> Result<DamperOptimum, TorsionError> {
        let scale = (ring_inertia * (self.band[0] * self.band[1]).sqrt()).ln();
        let damper = |logarithm: f64| Damper::viscous(ring_inertia, logarithm.exp());
        let (best, peak) = self.best_over(scale, &damper)?;
        Ok(DamperOptimum {
            damper: damper(best),
            peak,
        })
    }

    /// Stiffness and loss factor of a rubber damper with this ring (kg m2), whose ring is tuned to a
    /// frequency of the band.
    ///
    /// # Errors
    /// As [`DamperTask::peak`].
    pub fn best_rubber(&self, ring_inertia: f64) -> Result<DamperOptimum, TorsionError> {
        self.best_tuned(ring_inertia, &|stiffness, logarithm| {
            Damper::rubber(ring_inertia, stiffness, logarithm.exp())
        })
    }

    /// Stiffness and viscous damping of a damper with this ring (kg m2), whose ring is tuned to a
    /// frequency of the band.
    ///
    /// # Errors
    /// As [`DamperTask::peak`].
    pub fn best_spring_and_viscous(
        &self,
        ring_inertia: f64,
    ) -> Result<DamperOptimum, TorsionError> {
        self.best_tuned(ring_inertia, &|stiffness: f64, logarithm| {
            let mut damper = Damper::rubber(ring_inertia, stiffness, 0.0);
            damper.link.damping = (stiffness * ring_inertia).sqrt() * logarithm.exp();
            damper
        })
    }

    /// `damper` makes one from a stiffness and the logarithm of a loss.
    fn best_tuned(
        &self,
        ring_inertia: f64,
        damper: &dyn Fn(f64, f64) -> Damper,
    ) -> Result<DamperOptimum, TorsionError> {
        let stiffness = |tuning: f64| ring_inertia * (2.0 * tuning).exp();
        let [low, high] = self.band.map(f64::ln);
        let (tuning, _) = smallest(low, high, COARSE_SAMPLES, &mut |tuning| {
            let (_, peak) = self.best_over(0.0, &|loss| damper(stiffness(tuning), loss))?;
            Ok(peak)
        })?;
        let damper = |loss| damper(stiffness(tuning), loss);
        let (loss, peak) = self.best_over(0.0, &damper)?;
        Ok(DamperOptimum {
            damper: damper(loss),
            peak,
        })
    }

    /// The best of a family of dampers over a logarithm about `scale`, and its peak.
    fn best_over(
        &self,
        scale: f64,
        damper: &dyn Fn(f64) -> Damper,
    ) -> Result<(f64, f64), TorsionError> {
        let reach = DECADES * std::f64::consts::LN_10;
        smallest(scale - reach, scale + reach, COARSE_SAMPLES, &mut |at| {
            self.peak(&damper(at))
        })
    }
}

/// Where a function is smallest between two places, and its value: every dip of an even scan is
/// followed by golden section.
fn smallest(
    low: f64,
    high: f64,
    samples: u32,
    of: &mut dyn FnMut(f64) -> Result<f64, TorsionError>,
) -> Result<(f64, f64), TorsionError> {
    let place = |at: u32| low + (high - low) * f64::from(at) / f64::from(samples - 1);
    let values = (0..samples)
        .map(|at| of(place(at)))
        .collect::<Result<Vec<f64>, _>>()?;
    let mut best = (low, f64::INFINITY);
    for (at, &value) in (0..samples).zip(&values) {
        let before = at.saturating_sub(1);
        let behind = (at + 1).min(samples - 1);
        if value > values[before as usize] || value > values[behind as usize] {
            continue;
        }
        let found = golden_section(place(before), place(behind), of)?;
        // An end of the range is itself a place, and golden section stays inside.
        for candidate in [(place(at), value), found] {
            if candidate.1 < best.1 {
                best = candidate;
            }
        }
    }
    Ok(best)
}

fn golden_section(
    mut low: f64,
    mut high: f64,
    of: &mut dyn FnMut(f64) -> Result<f64, TorsionError>,
) -> Result<(f64, f64), TorsionError> {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut left = high - ratio * (high - low);
    let mut right = low + ratio * (high - low);
    let (mut at_left, mut at_right) = (of(left)?, of(right)?);
    while high - low > LOGARITHM_TOLERANCE {
        if at_left < at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - ratio * (high - low);
            at_left = of(left)?;
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + ratio * (high - low);
            at_right = of(right)?;
        }
    }
    Ok(if at_left < at_right {
        (left, at_left)
    } else {
        (right, at_right)
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Disc, TorsionalLink};
    use super::*;

    const INERTIA: f64 = 0.2;
    const STIFFNESS: f64 = 4.0e5;

    /// One disc on a spring, the last disc so heavy that it stands still.
    fn task() -> DamperTask {
        let disc = |inertia| Disc {
            inertia,
            damping: 0.0,
            throw: None,
        };
        let natural = (STIFFNESS / INERTIA).sqrt();
        DamperTask {
            chain: TorsionalChain {
                discs: vec![disc(INERTIA), disc(1e9 * INERTIA)],
                links: vec![TorsionalLink {
                    stiffness: STIFFNESS,
                    damping: 0.0,
                    loss_factor: 0.0,
                }],
            },
            torques: vec![STIFFNESS, 0.0],
            band: [0.3 * natural, 3.0 * natural],
        }
    }

    #[test]
    fn viscous_damper_found_is_the_closed_form() {
        let natural = (STIFFNESS / INERTIA).sqrt();
        for ratio in [0.05, 0.2, 0.5, 1.0] {
            let found = task().best_viscous(ratio * INERTIA).unwrap();
            let damping = found.damper.link.damping / (2.0 * ratio * INERTIA * natural);
            let exact = 1.0 / (2.0 * (1.0 + ratio) * (2.0 + ratio)).sqrt();
            assert!(
                (found.peak / (1.0 + 2.0 / ratio) - 1.0).abs() < 1e-7,
                "{ratio}: {found:?}"
            );
            assert!(
                (damping / exact - 1.0).abs() < 1e-4,
                "{ratio}: {damping}, {exact}"
            );
        }
    }

    /// At two frequencies the twist does not depend on the damping; where these are equally high, no
    /// damper of this ring can do better than they, and the best comes near.
    #[test]
    fn tuned_damper_found_reaches_its_fixed_points() {
        let natural = (STIFFNESS / INERTIA).sqrt();
        let ratio: f64 = 0.2;
        let bound = (1.0 + 2.0 / ratio).sqrt();
        let stiffness = ratio * INERTIA * (natural / (1.0 + ratio)).powi(2);

        let mut den_hartog = Damper::rubber(ratio * INERTIA, stiffness, 0.0);
        let damping_ratio = (3.0 * ratio / (8.0 * (1.0 + ratio).powi(3))).sqrt();
        den_hartog.link.damping = damping_ratio * 2.0 * ratio * INERTIA * natural;
        let by_hand = task().peak(&den_hartog).unwrap();
        assert!(
            by_hand > bound && by_hand < 1.005 * bound,
            "{by_hand}, {bound}"
        );

        let found = task().best_spring_and_viscous(ratio * INERTIA).unwrap();
        assert!(found.peak <= by_hand);
        assert!(
            found.peak >= bound * (1.0 - 1e-7),
            "{found:?} below {bound}"
        );
        let tuning = (found.damper.link.stiffness / stiffness).sqrt();
        assert!(
            (tuning - 1.0).abs() < 0.01,
            "{found:?}: tuning off by {tuning}"
        );
    }

    /// At tuning `1 / (1 + m)` and `h^2 = 2 (1 + m) / m`, `h^2` times the square of the denominator of
    /// the twist less the square of its numerator is the square of a quadratic in the squared
    /// frequency, if the squared loss factor is `m (3 + m) / 2`: two peaks of the height `h`.
    #[test]
    fn rubber_damper_found_is_the_closed_form() {
        let natural = (STIFFNESS / INERTIA).sqrt();
        for ratio in [0.1_f64, 0.4] {
            let found = task().best_rubber(ratio * INERTIA).unwrap();
            let peak = (2.0 * (1.0 + ratio) / ratio).sqrt();
            let stiffness = ratio * INERTIA * (natural / (1.0 + ratio)).powi(2);
            let loss = (0.5 * ratio * (3.0 + ratio)).sqrt();
            assert!(
                (found.peak / peak - 1.0).abs() < 1e-7,
                "{ratio}: {found:?}, {peak}"
            );
            let link = found.damper.link;
            assert!(
                (link.stiffness / stiffness - 1.0).abs() < 1e-4,
                "{link:?}, {stiffness}"
            );
            assert!(
                (link.loss_factor / loss - 1.0).abs() < 1e-3,
                "{link:?}, {loss}"
            );
        }
    }

    #[test]
    fn twist_at_the_fixed_points_does_not_depend_on_the_damping() {
        let natural = (STIFFNESS / INERTIA).sqrt();
        let ratio: f64 = 0.2;
        let stiffness = ratio * INERTIA * (natural / (1.0 + ratio)).powi(2);
        // Den Hartog's frequencies of the fixed points at this tuning.
        for sign in [-1.0, 1.0] {
            let square = (1.0 + sign * (ratio / (2.0 + ratio)).sqrt()) / (1.0 + ratio);
            let frequency = natural * f64::sqrt(square);
            for loss in [0.01, 0.3, 5.0] {
                let chain =
                    task()
                        .chain
                        .with_damper(&Damper::rubber(ratio * INERTIA, stiffness, loss));
                let torques = DVector::from_vec(vec![0.0, STIFFNESS, 0.0]).map(Complex::from);
                let twists = chain.receptance(frequency, &torques).unwrap();
                let twist = (twists[1] - twists[2]).norm();
                let exact = (1.0 + 2.0 / ratio).sqrt();
                assert!(
                    (twist / exact - 1.0).abs() < 1e-7,
                    "loss {loss}: {twist}, {exact}"
                );
            }
        }
    }

    #[test]
    fn a_task_that_is_none_is_refused() {
        let mut none = task();
        none.band = [2.0, 1.0];
        let damper = Damper::viscous(0.1, 1.0);
        assert!(
            none.peak(&damper)
                .unwrap_err()
                .to_string()
                .contains("width of the band")
        );
        let mut short = task();
        short.torques.pop();
        assert!(
            short
                .peak(&damper)
                .unwrap_err()
                .to_string()
                .contains("torques on the discs")
        );
        assert!(
            task()
                .best_viscous(-1.0)
                .unwrap_err()
                .to_string()
                .contains("disc 1: inertia")
        );
    }
}
