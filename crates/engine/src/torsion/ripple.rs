//! The speed ripple that torsion makes, fed back into the loads that make it.
//!
//! With a throw at the angle `b = a + x`, the crank's own inertia `J_c` and the inertia `J(b)` of its
//! pistons and rods, the disc obeys exactly
//! `J_c b'' + (links, damping) = T_gas(b) - J(b) b'' - J'(b) b'^2 / 2`,
//! and the right side is the torque that exact loads at this motion put on the throw. The disc of a
//! chain has the inertia `J_c + J_m` with the mean `J_m` of `J(b)`. Were the torque of the rippling
//! motion used as it stands, `J_m x''` would be counted twice: in the disc, and in the loads. So the
//! chain is driven by `T(motion) + J_m x''`: at even speed the classical linear excitation, gas and
//! inertia torque; with ripple, in addition, only what goes beyond the mean inertia. What it settles
//! at solves the exact equation in all orders kept.
//!
//! Fixed point with Anderson's mixing (J. ACM 12 (1965) 547, 10.1145/321296.321305): near a resonance,
//! or where `J(b)` swings by much of the disc's inertia, plain repetition runs away.

use super::chain::{Range, require_task};
use super::forced::{amplitude, harmonic};
use super::{TorsionError, TorsionResponse, TorsionalChain};
use crate::{CrankMotion, CrankTrain, Harmonic, IndicatorDiagram, Twist, harmonics, throw_torques};
use nalgebra::{Complex, DMatrix, DVector};
use sommerfeld_film::Outcome;
use std::f64::consts::TAU;

/// Earlier iterates that the mixing looks at.
const MEMORY: usize = 6;

/// When the ripple counts as settled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RippleSettings {
    /// Settled when no harmonic of a twist moves by more, over the largest one.
    pub tolerance: f64,
    /// Evaluations of the torques after which it is given up.
    pub maximum_iterations: usize,
}

impl Default for RippleSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-8,
            maximum_iterations: 60,
        }
    }
}

/// A vibration, the motion it makes, and whether the two agree.
#[derive(Debug, Clone, PartialEq)]
pub struct SettledRipple {
    /// Vibration under the torques of `motion`, the last one found.
    pub response: TorsionResponse,
    /// Motion of the crankshaft with this vibration.
    pub motion: CrankMotion,
    /// Evaluations of the torques.
    pub iterations: usize,
    /// What no harmonic of a twist moved by more in the end, over the largest one.
    pub change: f64,
    /// Converged, or not converged.
    pub outcome: Outcome,
}

/// Vibration of an engine whose gas, pistons and rods drive its chain, at the mean `speed` (rad/s):
/// [`settle_ripple`] with the exact torques at `points` even steps of the crank angle, up to
/// `highest_order`. Every throw drives one disc, whose inertia contains the mean of its pistons and rods.
///
/// # Errors
/// As [`settle_ripple`]; also a train or a diagram whose torques are not finite.
pub fn engine_ripple(
    train: &CrankTrain,
    diagram: &IndicatorDiagram,
    chain: &TorsionalChain,
    speed: f64,
    points: usize,
    highest_order: f64,
    settings: RippleSettings,
) -> Result<SettledRipple, TorsionError> {
    let axial: Vec<f64> = train
        .layout
        .throws
        .iter()
        .map(|throw| throw.axial)
        .collect();
    let period = train.period();
    let torques = |motion: &CrankMotion| {
        let mut throws = vec![Vec::with_capacity(points); axial.len()];
        for step in 0..points {
            let crank_angle = period * step as f64 / points as f64;
            let row = throw_torques(train, diagram, motion, crank_angle);
            for (throw, torque) in throws.iter_mut().zip(row) {
                throw.push(torque);
            }
        }
        let orders = |values: &Vec<f64>| harmonics(values, period / TAU, highest_order);
        throws.iter().map(orders).collect()
    };
    let means = train.mean_slider_inertias();
    settle_ripple(chain, speed, &axial, &means, settings, torques)
}

/// What settles: the chain, its speed and its throws.
struct Ripple<'a> {
    chain: &'a TorsionalChain,
    speed: f64,
    axial: &'a [f64],
    mean_inertias: &'a [f64],
}

/// Vibration of a chain whose torques depend on its motion.
///
/// `axial` are the axial positions of the throws, m; `mean_inertias` what pistons and rods add to the
/// inertia of each, kg m2 ([`crate::CrankTrain::mean_slider_inertias`]), contained in the discs.
/// `torques` gives the torque on each throw over the crank angle (time times mean speed) at a motion,
/// N m: of gas, piston and rod, at the angle, speed and acceleration of that throw.
///
/// # Errors
/// As [`TorsionalChain::forced_response`]; as many axial positions and inertias as throws are due.
pub fn settle_ripple(
    chain: &TorsionalChain,
    speed: f64,
    axial: &[f64],
    mean_inertias: &[f64],
    settings: RippleSettings,
    mut torques: impl FnMut(&CrankMotion) -> Vec<Vec<Harmonic>>,
) -> Result<SettledRipple, TorsionError> {
    for &inertia in mean_inertias {
        require_task("mean inertia of a throw", inertia, Range::NotNegative)?;
    }
    require_task("relative change", settings.tolerance, Range::Positive)?;
    let ripple = Ripple {
        chain,
        speed,
        axial,
        mean_inertias,
    };
    let mut motion = CrankMotion::even(speed);
    let mut mixing = Mixing::default();
    let mut at: Option<DVector<f64>> = None;
    let mut iterations = 0;
    loop {
        iterations += 1;
        let response = ripple.vibration(&torques(&motion), &motion)?;
        let orders = orders_of(&response);
        let found = ripple.coordinates(&response, &orders);
        // The even turning is all zeros, whatever the orders.
        let before = at.unwrap_or_else(|| DVector::zeros(found.len()));
        if before.len() != found.len() {
            return Err(not_one_each("orders", found.len(), before.len()));
        }
        let moved = (&found - &before).amax();
        let largest = found.amax();
        let change = if moved > 0.0 { moved / largest } else { 0.0 };
        let is_settled = change <= settings.tolerance;
        if is_settled || iterations >= settings.maximum_iterations {
            return Ok(SettledRipple {
                motion: response.motion(chain, speed, axial),
                response,
                iterations,
                change,
                outcome: if is_settled {
                    Outcome::Converged
                } else {
                    Outcome::NotConverged
                },
            });
        }
        let next = mixing.next(&before, found);
        motion = ripple.turning(&next, &orders);
        at = Some(next);
    }
}

impl Ripple<'_> {
    /// Vibration under the torques of a motion, the mean inertias not counted twice.
    fn vibration(
        &self,
        torques: &[Vec<Harmonic>],
        motion: &CrankMotion,
    ) -> Result<TorsionResponse, TorsionError> {
        for (name, count) in [
            ("number of mean inertias", self.mean_inertias.len()),
            ("number of throws with torques", torques.len()),
        ] {
            if count != self.axial.len() {
                return Err(not_one_each(name, count, self.axial.len()));
            }
        }
        let throws = torques.iter().zip(self.axial).zip(self.mean_inertias);
        let excitation: Vec<Vec<Harmonic>> = throws
            .map(|((torque, &axial), inertia)| {
                let scale = inertia * self.speed * self.speed;
                let twist = motion.twists.iter().find(|(station, _)| *station == axial);
                let twist = twist.map_or(&[][..], |(_, twist)| &twist.harmonics);
                let returned = twist.iter().map(|one| Harmonic {
                    order: one.order,
                    cos: -scale * one.order * one.order * one.cos,
                    sin: -scale * one.order * one.order * one.sin,
                });
                torque.iter().copied().chain(returned).collect()
            })
            .collect();
        self.chain.forced_response(self.speed, &excitation)
    }

    /// Cosines and sines of the twists of all throws, order by order.
    fn coordinates(&self, response: &TorsionResponse, orders: &[f64]) -> DVector<f64> {
        let motion = response.motion(self.chain, self.speed, self.axial);
        let of_one = |harmonics: &[Harmonic]| {
            let amplitudes = orders.iter().map(|&order| amplitude(harmonics, order));
            amplitudes
                .flat_map(|one| [one.re, one.im])
                .collect::<Vec<f64>>()
        };
        let all = motion
            .twists
            .iter()
            .flat_map(|(_, twist)| of_one(&twist.harmonics));
        DVector::from_vec(all.collect())
    }

    /// The motion that has these coordinates.
    fn turning(&self, coordinates: &DVector<f64>, orders: &[f64]) -> CrankMotion {
        let mut axial = self.axial.to_vec();
        axial.sort_by(f64::total_cmp);
        let twist = |values: &[f64]| {
            let pairs = orders.iter().zip(values.chunks_exact(2));
            let of_one =
                |(&order, pair): (&f64, &[f64])| harmonic(order, Complex::new(pair[0], pair[1]));
            Twist {
                harmonics: pairs.map(of_one).collect(),
            }
        };
        let twists = coordinates.as_slice().chunks_exact(2 * orders.len());
        CrankMotion {
            speed: self.speed,
            twists: axial.into_iter().zip(twists.map(twist)).collect(),
        }
    }
}

fn not_one_each(name: &'static str, count: usize, due: usize) -> TorsionError {
    TorsionError::Count { name, count, due }
}

fn orders_of(response: &TorsionResponse) -> Vec<f64> {
    let first = response.twists.first();
    first.map_or_else(Vec::new, |twist| {
        twist.harmonics.iter().map(|one| one.order).collect()
    })
}

/// Anderson's mixing: the next iterate is where the steps seen so far, combined linearly, would
/// leave the smallest residual.
#[derive(Default)]
struct Mixing {
    /// Last residual and last value of the map.
    last: Option<(DVector<f64>, DVector<f64>)>,
    /// Differences of residuals and of values between successive iterates.
    steps: Vec<(DVector<f64>, DVector<f64>)>,
}

impl Mixing {
    fn next(&mut self, at: &DVector<f64>, found: DVector<f64>) -> DVector<f64> {
        let residual = &found - at;
        if let Some((last_residual, last_found)) = self.last.take() {
            self.steps
                .push((&residual - last_residual, &found - last_found));
            if self.steps.len() > MEMORY {
                self.steps.remove(0);
            }
        }
        let differences: Vec<DVector<f64>> =
            self.steps.iter().map(|(step, _)| step.clone()).collect();
        let mut next = found.clone();
        if !differences.is_empty() {
            let matrix = DMatrix::from_columns(&differences);
            let smallest = 1e-12 * matrix.norm();
            // Where the least squares fail, the plain step remains.
            if let Ok(shares) = matrix.svd(true, true).solve(&residual, smallest) {
                for (share, (_, step)) in shares.iter().zip(&self.steps) {
                    next.axpy(-share, step, 1.0);
                }
            }
        }
        self.last = Some((residual, found));
        next
    }
}
