//! Orders of a periodic quantity that is known at evenly spaced crank angles.

use crate::Harmonic;
use std::f64::consts::TAU;

/// Highest order that is told: what torsional vibration commonly asks for (Ker Wilson, Practical Solution
/// of Torsional Vibration Problems, 1963, lists engines to order 12).
const HIGHEST_ORDER: f64 = 12.0;

/// Harmonics of `samples` over `period` (rad of crank angle), from the lowest to order 12 or to what the
/// samples can tell apart: trigonometric sums, exact for a sum of orders below half the number of samples.
#[must_use]
pub fn harmonics(samples: &[f64], period: f64) -> Vec<Harmonic> {
    let count = samples.len();
    let turns = period / TAU;
    let highest = (HIGHEST_ORDER * turns).round().max(0.0) as usize;
    let circle: Vec<[f64; 2]> = (0..count)
        .map(|k| {
            let (sin, cos) = (TAU * k as f64 / count as f64).sin_cos();
            [cos, sin]
        })
        .collect();
    (1..=highest)
        .take_while(|harmonic| 2 * harmonic < count)
        .map(|harmonic| {
            let (mut cos, mut sin) = (0.0, 0.0);
            for (k, sample) in samples.iter().enumerate() {
                let [c, s] = circle[harmonic * k % count];
                cos += sample * c;
                sin += sample * s;
            }
            let scale = 2.0 / count as f64;
            Harmonic {
                order: harmonic as f64 / turns,
                cos: scale * cos,
                sin: scale * sin,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_of_orders_is_found_again() {
        let orders = [(0.5, 3.0, -1.0), (2.0, 0.0, 4.0), (7.5, 0.25, 0.125)];
        let period = 2.0 * TAU;
        let count = 48;
        let samples: Vec<f64> = (0..count)
            .map(|k| {
                let angle = period * k as f64 / count as f64;
                let sum: f64 = orders
                    .iter()
                    .map(|&(order, cos, sin)| Harmonic { order, cos, sin }.at(angle)[0])
                    .sum();
                10.0 + sum
            })
            .collect();
        let found = harmonics(&samples, period);
        assert_eq!(found.len(), 23); // orders 0.5 to 11.5: the 24th is half of 48
        for harmonic in found {
            let put_in = orders.iter().find(|row| row.0 == harmonic.order);
            let &(_, cos, sin) = put_in.unwrap_or(&(0.0, 0.0, 0.0));
            assert!((harmonic.cos - cos).abs() < 1e-13, "{harmonic:?}");
            assert!((harmonic.sin - sin).abs() < 1e-13, "{harmonic:?}");
        }
    }
}
