//! Gauss-Legendre points on [-1, 1].

use std::f64::consts::PI;

/// Abscissae, descending, with their weights; exact for polynomials of degree `2 count - 1`.
pub(super) fn gauss_legendre(count: usize) -> Vec<[f64; 2]> {
    (0..count)
        .map(|i| {
            let mut t = ((4 * i + 3) as f64 / (4 * count + 2) as f64 * PI).cos();
            let mut slope = 1.0;
            for _ in 0..100 {
                let (value, derivative) = legendre(count, t);
                slope = derivative;
                let step = value / derivative;
                t -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            [t, 2.0 / ((1.0 - t * t) * slope * slope)]
        })
        .collect()
}

/// Value and derivative of the Legendre polynomial of a degree at `t`, inside or at the ends of [-1, 1].
pub(super) fn legendre(degree: usize, t: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, t);
    let (mut slope_before, mut slope) = (0.0, 1.0);
    if degree == 0 {
        return (before, slope_before);
    }
    for n in 2..=degree {
        let n = n as f64;
        let next = ((2.0 * n - 1.0) * t * value - (n - 1.0) * before) / n;
        let next_slope = slope_before + (2.0 * n - 1.0) * value;
        (before, value) = (value, next);
        (slope_before, slope) = (slope, next_slope);
    }
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        for count in [1, 4, 9, 16] {
            for power in 0..2 * count {
                let sum: f64 = gauss_legendre(count)
                    .iter()
                    .map(|[t, weight]| weight * t.powi(power as i32))
                    .sum();
                let exact = if power % 2 == 0 {
                    2.0 / (power + 1) as f64
                } else {
                    0.0
                };
                assert!((sum - exact).abs() < 1e-14, "{count} {power}: {sum}");
            }
        }
    }

    #[test]
    fn slopes_are_those_of_the_values() {
        for degree in 0..9 {
            let (value, slope) = legendre(degree, 1.0);
            assert!((value - 1.0).abs() < 1e-14);
            let exact = 0.5 * (degree * (degree + 1)) as f64;
            assert!((slope - exact).abs() < 1e-12);
            let around = |t| legendre(degree, t).0;
            let difference = (around(0.3 + 1e-6) - around(0.3 - 1e-6)) / 2e-6;
            assert!((legendre(degree, 0.3).1 - difference).abs() < 1e-8);
        }
    }
}
