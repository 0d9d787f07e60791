//! Which orders a periodic quantity consists of.
//!
//! `f(a) = c_0 + sum over k of c_k cos(n_k a) + s_k sin(n_k a)`, `n_k = k / turns`, over the crank
//! angle `a`, for values evenly spaced over one period of `turns` turns. The sums
//! `c_k = 2/N sum_j f_j cos(2 pi k j / N)` are exact for a trigonometric polynomial whose highest
//! harmonic stays below `N/2`; what lies beyond is folded onto lower orders, so a table should have at
//! least twice as many rows as its highest harmonic has.
//! At `k = N/2`, the last one `N` values can tell, the sine is invisible and the cosine counts once.

use crate::Harmonic;
use std::f64::consts::TAU;

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
            }
        })
        .collect()
}

/// The same course later by `delay` (rad of crank angle): what cylinder 1 does, for one that fires
/// `delay` after it.
#[must_use]
pub fn delayed(harmonics: &[Harmonic], delay: f64) -> Vec<Harmonic> {
    let later = |one: &Harmonic| {
        let (sin, cos) = (one.order * delay).sin_cos();
        Harmonic {
            order: one.order,
            cos: one.cos * cos - one.sin * sin,
            sin: one.cos * sin + one.sin * cos,
        }
    };
    harmonics.iter().map(later).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
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
    fn a_delayed_course_is_the_course_of_an_earlier_angle() {
        let of = |order, cos, sin| Harmonic { order, cos, sin };
        let given = [of(0.0, 3.0, 0.0), of(0.5, 1.0, -2.0), of(3.0, -5.0, 0.1)];
        let sum = |harmonics: &[Harmonic], a| harmonics.iter().map(|one| one.at(a)[0]).sum::<f64>();
        let later = delayed(&given, 4.2);
        for a in [0.0, 1.0, 7.7] {
            assert!((sum(&later, a) - sum(&given, a - 4.2)).abs() < 1e-13);
        }
    }

    #[test]
    fn nothing_comes_of_nothing() {
        assert!(harmonics(&[], 2.0, 3.0).is_empty());
        assert!(harmonics(&[1.0], 0.0, 3.0).is_empty());
        assert!(harmonics(&[1.0], f64::NAN, 3.0).is_empty());
        assert_eq!(harmonics(&[1.0, 3.0], 2.0, f64::NAN).len(), 1);
    }
}
