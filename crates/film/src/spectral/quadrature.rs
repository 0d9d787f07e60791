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

/// Nodes of an element of a degree, both ends included, on [0, 1], with weights and slopes.
#[derive(Debug, Clone)]
pub(super) struct Element {
    /// Gauss-Lobatto nodes, ascending.
    pub nodes: Vec<f64>,
    /// Their weights.
    pub weights: Vec<f64>,
    /// Slope at a node (row) of the polynomial that is 1 at another (column).
    pub slopes: Vec<Vec<f64>>,
}

impl Element {
    /// Element of a degree of 1 or more.
    pub(super) fn new(degree: usize) -> Self {
        let product = (degree * (degree + 1)) as f64;
        let on_both_sides: Vec<f64> = (0..=degree)
            .map(|i| {
                let mut t = -(PI * i as f64 / degree as f64).cos();
                if i == 0 || i == degree {
                    return t.round();
                }
                for _ in 0..100 {
                    let (value, slope) = legendre(degree, t);
                    let step = slope * (1.0 - t * t) / (2.0 * t * slope - product * value);
                    t -= step;
                    if step.abs() < 1e-16 {
                        break;
                    }
                }
                t
            })
            .collect();
        let weight = |t: &f64| 1.0 / (product * legendre(degree, *t).0.powi(2));
        let nodes: Vec<f64> = on_both_sides.iter().map(|t| 0.5 * (1.0 + t)).collect();
        Self {
            weights: on_both_sides.iter().map(weight).collect(),
            slopes: slopes_between(&nodes),
            nodes,
        }
    }
}

/// Slopes at the nodes of the polynomials that are 1 at one of them, by barycentric weights.
fn slopes_between(nodes: &[f64]) -> Vec<Vec<f64>> {
    let others = |i: usize| (0..nodes.len()).filter(move |&j| j != i);
    let weights: Vec<f64> = (0..nodes.len())
        .map(|i| 1.0 / others(i).map(|j| nodes[i] - nodes[j]).product::<f64>())
        .collect();
    let slope = |i: usize, j: usize| weights[j] / weights[i] / (nodes[i] - nodes[j]);
    (0..nodes.len())
        .map(|i| {
            (0..nodes.len())
                .map(|j| match i == j {
                    true => -others(i).map(|j| slope(i, j)).sum::<f64>(),
                    false => slope(i, j),
                })
                .collect()
        })
        .collect()
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

    #[test]
    fn an_element_integrates_and_differentiates_polynomials() {
        for degree in [1, 4, 7] {
            let element = Element::new(degree);
            for power in 0..2 * degree as i32 {
                let values = element.nodes.iter().map(|x| x.powi(power));
                let sum: f64 = values.zip(&element.weights).map(|(a, b)| a * b).sum();
                assert!(
                    (sum - 1.0 / f64::from(power + 1)).abs() < 1e-14,
                    "{degree} {power}"
                );
            }
            for (row, x) in element.slopes.iter().zip(&element.nodes) {
                let of = |x: &f64| x.powi(degree as i32);
                let slope: f64 = row.iter().zip(&element.nodes).map(|(d, x)| d * of(x)).sum();
                let exact = degree as f64 * x.powi(degree as i32 - 1);
                assert!((slope - exact).abs() < 1e-12, "{degree} {x}");
            }
        }
    }
}
