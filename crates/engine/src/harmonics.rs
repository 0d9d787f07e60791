<<<<<<< HEAD
//! Orders of a periodic quantity that is known at evenly spaced crank angles.
=======
//! Which orders a periodic quantity consists of.
//!
//! `f(a) = c_0 + sum over k of c_k cos(n_k a) + s_k sin(n_k a)`, `n_k = k / turns`, over the crank
//! angle `a`, for values evenly spaced over one period of `turns` turns. The sums
//! `c_k = 2/N sum_j f_j cos(2 pi k j / N)` are exact for a trigonometric polynomial whose highest
//! harmonic stays below `N/2`; what lies beyond is folded onto lower orders, so a table should have at
//! least twice as many rows as its highest harmonic has.
//! At `k = N/2`, the last one `N` values can tell, the sine is invisible and the cosine counts once.
>>>>>>> torsion

use crate::Harmonic;
use std::f64::consts::TAU;

<<<<<<< HEAD
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
=======
/// Harmonics of `values`, evenly spaced over one period from crank angle 0, the end not repeated. The
/// period takes `turns_per_period` turns of the crankshaft (2 for a four-stroke engine), so orders
/// come in steps of its inverse. The first is order 0, the mean, in `cos`; the last is at most
/// `highest_order` and at most what the number of values can tell. Empty without values, or if the
/// period is not positive.
#[must_use]
pub fn harmonics(values: &[f64], turns_per_period: f64, highest_order: f64) -> Vec<Harmonic> {
    let count = values.len();
    let is_period = turns_per_period > 0.0 && turns_per_period.is_finite();
    if count == 0 || !is_period {
        return Vec::new();
    }
    // Cosines and sines of one turn once: every k and j meets one of them.
    let circle: Vec<(f64, f64)> = (0..count)
        .map(|j| (TAU * j as f64 / count as f64).sin_cos())
        .collect();
    // A part of a thousand of a step, so that order 3 is not lost where its multiple is rounded.
    let reaches = |k: usize| k as f64 <= highest_order * turns_per_period + 1e-3;
    (0..=count / 2)
        .take_while(|&k| k == 0 || reaches(k))
        .map(|k| {
            let (mut sine, mut cosine, mut at) = (0.0, 0.0, 0);
            for value in values {
                let (sin, cos) = circle[at];
                sine += value * sin;
                cosine += value * cos;
                at = (at + k) % count;
            }
            let is_alone = k == 0 || 2 * k == count;
            let share = if is_alone { 1.0 } else { 2.0 } / count as f64;
            Harmonic {
                order: k as f64 / turns_per_period,
                cos: share * cosine,
                sin: if is_alone { 0.0 } else { share * sine },
>>>>>>> torsion
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
<<<<<<< HEAD
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
=======
    fn harmonics_of_a_trigonometric_polynomial_are_its_coefficients() {
        let of = |order, cos, sin| Harmonic { order, cos, sin };
        let given = [
            of(0.0, 3.0, 0.0),
            of(0.5, 1.0, -2.0),
            of(1.5, 0.0, 0.7),
            of(3.0, -5.0, 0.1),
        ];
        let values: Vec<f64> = (0..24)
            .map(|j| 2.0 * TAU * f64::from(j) / 24.0)
            .map(|a| given.iter().map(|one| one.at(a)[0]).sum())
            .collect();
        let found = harmonics(&values, 2.0, 3.0);
        assert_eq!(found.len(), 7, "orders 0, 0.5, ... 3");
        for one in found {
            let meant = given
                .iter()
                .find(|other| (other.order - one.order).abs() < 1e-12);
            let meant = meant.copied().unwrap_or(of(one.order, 0.0, 0.0));
            assert!((one.cos - meant.cos).abs() < 1e-13, "{one:?} for {meant:?}");
            assert!((one.sin - meant.sin).abs() < 1e-13, "{one:?} for {meant:?}");
        }
    }

    #[test]
    fn all_harmonics_of_a_table_give_the_table_back() {
        for count in [1, 2, 7, 12] {
            let values: Vec<f64> = (0..count).map(|j| f64::from((j * j * 37) % 11)).collect();
            let found = harmonics(&values, 2.0, f64::INFINITY);
            assert_eq!(found.len(), values.len() / 2 + 1);
            for (j, value) in values.iter().enumerate() {
                let angle = 2.0 * TAU * j as f64 / f64::from(count);
                let sum: f64 = found.iter().map(|one| one.at(angle)[0]).sum();
                assert!(
                    (sum - value).abs() < 1e-12,
                    "{count} values, row {j}: {sum}, {value}"
                );
            }
        }
    }

    #[test]
    fn nothing_comes_of_nothing() {
        assert!(harmonics(&[], 2.0, 3.0).is_empty());
        assert!(harmonics(&[1.0], 0.0, 3.0).is_empty());
        assert!(harmonics(&[1.0], f64::NAN, 3.0).is_empty());
        assert_eq!(harmonics(&[1.0, 3.0], 2.0, f64::NAN).len(), 1);
    }
>>>>>>> torsion
}
