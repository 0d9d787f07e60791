//! Steady forced vibration at one speed, order by order.
//!
//! A harmonic `c cos(n a) + s sin(n a)` is the real part of `(c - i s) exp(i n a)`; at order `n` and
//! mean speed `W` the frequency is `w = n W` and `(K + i H + i w C - w^2 M) x = T`. Below the first
//! natural frequency the chain turns as one body: that motion is kept, it is the speed ripple.
//! Order 0 needs no inertia: each link carries the mean torque of all before it.
//! Heat: a link turns `(w^2 c + w k loss) |dx|^2 / 2` into heat, damping against ground
//! `w^2 c |x|^2 / 2`; their sum is the work of the excitation on the vibration.

use super::chain::{Range, require_task};
use super::{ChainMatrices, TorsionError, TorsionalChain, TorsionalLink};
use crate::{CrankMotion, Harmonic, Twist};
use nalgebra::{Complex, DMatrix, DVector};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Beyond this condition of the equations (its product with rounding is 1e-6) a resonance counts as
/// undamped.
const RESIDUAL_OF_A_RESONANCE: f64 = 1e-6;

/// Orders closer than this are one.
const SAME_ORDER: f64 = 1e-9;

/// Steady torsional vibration of a chain at one speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TorsionResponse {
    /// Natural frequencies of the undamped chain, Hz, ascending, the rigid one first.
    pub natural_frequencies: Vec<f64>,
    /// Mode shapes, one row for each frequency, largest entry 1.
    pub modes: Vec<Vec<f64>>,
    /// Twist of each disc over the crank angle, rad, about the even turning of the shaft. Order 0 is
    /// the twist under the mean torque, counted from the disc of throw 1 (the last disc if no throw
    /// drives the chain).
    pub twists: Vec<Twist>,
    /// Torque in each link over the orders, N m, with its damping; order 0 is the mean torque.
    pub link_torques: Vec<Twist>,
    /// Mean heat in each link over a cycle, W: what a damper must give off.
    pub link_heat: Vec<f64>,
    /// Mean power that damping against ground takes from the vibration of each disc, W; what it takes
    /// from the mean speed is not in it.
    pub disc_heat: Vec<f64>,
    /// Mean torque that the load takes at the last disc, N m.
    pub load_torque: f64,
}

impl TorsionalChain {
    /// Steady vibration at the mean `speed` (rad/s) under the torque of each throw over the crank
    /// angle, N m, of any orders from 0 on.
    ///
    /// # Errors
    /// What [`TorsionalChain::check`] refuses; a speed that is not positive; throws that do not drive
    /// one disc each; orders that are negative or values that are not finite; a link without stiffness
    /// under a mean torque; an undamped resonance.
    pub fn forced_response(
        &self,
        speed: f64,
        excitation: &[Vec<Harmonic>],
    ) -> Result<TorsionResponse, TorsionError> {
        let natural = self.natural_vibration()?;
        require_task("speed", speed, Range::Positive)?;
        let discs = self.discs_of_throws(excitation.len())?;
        let matrices = self.matrices()?;
        let mut response = TorsionResponse {
            natural_frequencies: natural.frequencies,
            modes: natural.modes,
            twists: vec![Twist::default(); self.discs.len()],
            link_torques: vec![Twist::default(); self.links.len()],
            link_heat: vec![0.0; self.links.len()],
            disc_heat: vec![0.0; self.discs.len()],
            load_torque: 0.0,
        };
        for order in orders(excitation)? {
            let mut torque = DVector::zeros(self.discs.len());
            for (&disc, harmonics) in discs.iter().zip(excitation) {
                torque[disc] += amplitude(harmonics, order);
            }
            if order > 0.0 {
                let twists = receptance(&matrices, order * speed, &torque)?;
                self.add_order(&mut response, speed, order, &twists);
            } else {
                let origin = discs.first().copied();
                self.add_mean(&mut response, speed, &torque, origin)?;
            }
        }
        Ok(response)
    }

    /// Complex twists of the discs (rad) under complex torques on them (N m) at a frequency (rad/s).
    ///
    /// # Errors
    /// What [`TorsionalChain::check`] refuses, a frequency that is not positive, an undamped resonance.
    pub fn receptance(
        &self,
        frequency: f64,
        torques: &DVector<Complex<f64>>,
    ) -> Result<DVector<Complex<f64>>, TorsionError> {
        require_task("frequency", frequency, Range::Positive)?;
        let matrices = self.matrices()?;
        let (given, due) = (torques.len(), self.discs.len());
        if given != due {
            return Err(TorsionError::Count {
                name: "torques on the discs",
                count: given,
                due,
            });
        }
        receptance(&matrices, frequency, torques)
    }

    /// Adds what vibrates at one order.
    fn add_order(
        &self,
        response: &mut TorsionResponse,
        speed: f64,
        order: f64,
        twists: &DVector<Complex<f64>>,
    ) {
        let frequency = order * speed;
        for (at, disc) in self.discs.iter().enumerate() {
            response.twists[at]
                .harmonics
                .push(harmonic(order, twists[at]));
            response.disc_heat[at] +=
                0.5 * frequency * frequency * disc.damping * twists[at].norm_sqr();
        }
        for (at, link) in self.links.iter().enumerate() {
            let stiffness = dynamic_stiffness(link, frequency);
            let difference = twists[at] - twists[at + 1];
            let torque = stiffness * difference;
            response.link_torques[at]
                .harmonics
                .push(harmonic(order, torque));
            response.link_heat[at] += 0.5 * frequency * stiffness.im * difference.norm_sqr();
        }
    }

    /// Adds mean torques, and the twist under them.
    fn add_mean(
        &self,
        response: &mut TorsionResponse,
        speed: f64,
        torque: &DVector<Complex<f64>>,
        origin: Option<usize>,
    ) -> Result<(), TorsionError> {
        let mut passed = 0.0;
        let mut twists = vec![0.0; self.discs.len()];
        for (at, disc) in self.discs.iter().enumerate() {
            passed += torque[at].re - disc.damping * speed;
            let Some(link) = self.links.get(at) else {
                continue;
            };
            if link.stiffness == 0.0 && passed != 0.0 {
                return Err(TorsionError::FreeLink {
                    link: at + 1,
                    torque: passed,
                });
            }
            let yielded = if link.stiffness > 0.0 {
                passed / link.stiffness
            } else {
                0.0
            };
            twists[at + 1] = twists[at] - yielded;
            response.link_torques[at]
                .harmonics
                .push(harmonic(0.0, passed.into()));
        }
        response.load_torque = passed;
        let origin = twists[origin.unwrap_or(self.discs.len() - 1)];
        for (twist, value) in response.twists.iter_mut().zip(twists) {
            twist.harmonics.push(harmonic(0.0, (value - origin).into()));
        }
        Ok(())
    }
}

impl TorsionResponse {
    /// Motion of the crankshaft for kinematics and loads: the twists of the discs that throws drive,
    /// at the axial position (m) of each throw.
    #[must_use]
    pub fn motion(&self, chain: &TorsionalChain, speed: f64, axial: &[f64]) -> CrankMotion {
        let discs = chain.discs.iter().zip(&self.twists);
        let mut twists: Vec<(f64, Twist)> = discs
            .filter_map(|(disc, twist)| {
                let station = axial.get(disc.throw?)?;
                Some((*station, twist.clone()))
            })
            .collect();
        twists.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        CrankMotion { speed, twists }
    }
}

/// Torque over twist of a link at a frequency (rad/s).
fn dynamic_stiffness(link: &TorsionalLink, frequency: f64) -> Complex<f64> {
    let loss = link.stiffness * link.loss_factor + frequency * link.damping;
    Complex::new(link.stiffness, loss)
}

/// Twists under torques at one frequency, rad/s.
pub(super) fn receptance(
    matrices: &ChainMatrices,
    frequency: f64,
    torques: &DVector<Complex<f64>>,
) -> Result<DVector<Complex<f64>>, TorsionError> {
    let count = matrices.inertia.nrows();
    let dynamic = DMatrix::from_fn(count, count, |row, column| {
        let at = (row, column);
        Complex::new(
            matrices.stiffness[at] - frequency * frequency * matrices.inertia[at],
            matrices.loss[at] + frequency * matrices.damping[at],
        )
    });
    let resonance = TorsionError::Resonance {
        frequency: frequency / TAU,
    };
    let twists = dynamic
        .clone()
        .lu()
        .solve(torques)
        .ok_or(resonance.clone())?;
    let residual = (&dynamic * &twists - torques).norm();
    if residual <= RESIDUAL_OF_A_RESONANCE * torques.norm() {
        Ok(twists)
    } else {
        Err(resonance)
    }
}

/// All orders of the torques, ascending, with 0: mean torques act even where they are 0.
fn orders(excitation: &[Vec<Harmonic>]) -> Result<Vec<f64>, TorsionError> {
    let mut orders = vec![0.0];
    for (throw, harmonics) in excitation.iter().enumerate() {
        for one in harmonics {
            let out_of_range = |name, value, range: Range| TorsionError::OutOfRange {
                place: "throw",
                number: throw + 1,
                name,
                value,
                range: range.name(),
            };
            if !Range::NotNegative.holds(one.order) {
                return Err(out_of_range("order", one.order, Range::NotNegative));
            }
            let Some(bad) = [one.cos, one.sin]
                .into_iter()
                .find(|value| !value.is_finite())
            else {
                orders.push(one.order);
                continue;
            };
            return Err(TorsionError::OutOfRange {
                place: "throw",
                number: throw + 1,
                name: "torque",
                value: bad,
                range: "finite",
            });
        }
    }
    orders.sort_by(f64::total_cmp);
    orders.dedup_by(|later, earlier| *later - *earlier < SAME_ORDER);
    Ok(orders)
}

/// Complex amplitude of one order among harmonics.
pub(super) fn amplitude(harmonics: &[Harmonic], order: f64) -> Complex<f64> {
    harmonics
        .iter()
        .filter(|one| (one.order - order).abs() < SAME_ORDER)
        .map(|one| Complex::new(one.cos, -one.sin))
        .sum()
}

pub(super) fn harmonic(order: f64, amplitude: Complex<f64>) -> Harmonic {
    Harmonic {
        order,
        cos: amplitude.re,
        sin: -amplitude.im,
    }
}
