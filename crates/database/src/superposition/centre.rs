//! What is the wedge of a journal near the centre of the bore, tilted as much as it is eccentric?
//!
//! ```text
//! H = 1 + (eps - along Z) cos(phi) - across Z sin(phi)       A = |(eps, along, across)|
//! Phi/eps = f(A, x, y)       Theta/A = g(A, x, y)            (x, y) = (along, across)/|(k eps, along, across)|
//! ```
//! For A -> 0 the pressure of the wedge is proportional to A, and how it ruptures depends on the direction
//! alone: a cone, which no table over eccentricity and tilt follows. Over the direction and A it is smooth.
//! With `eps -> -eps` the film turns by half a turn and its ends change places: the force changes its sign,
//! the moment does not, so that f and g are even in eps and hence smooth in x and y up to the rim of the unit
//! disc, where eps = 0. Near it they turn within a few hundredths of eps/A, as two films apart become one: k
//! spreads them. With both tilts turned round only the moment changes its sign: f is even, g odd in (x, y) together.
//! Products of Legendre polynomials in x and y, by least squares through films on rings; cubic splines through
//! their coefficients along A. Below the first A the curves go on straight to the limit.

use super::SuperpositionRecipe;
use super::build::FIGURES;
use super::grid::{Parts, Reach};
use crate::axis::{Axis, Placing, Spacing};
use crate::error::DatabaseError;
use crate::spline::{End, fit};
use std::f64::consts::{FRAC_PI_2, PI};

/// First and last A of the films.
const SIZES: [f64; 2] = [0.02, 0.55];
/// From it to the last A the curves turn into those of the table over eccentricity and tilts.
const JOIN: f64 = 0.4;
/// Largest even degree in x and y.
pub(super) const LARGEST_DEGREE: usize = 20;
/// Weight k of the eccentricity in a direction, found by trial: at degree 14 films err by 1.9 % at most where eps/A is
/// 0.025 to 0.05, with k = 1 by 5 %, and by 0.3 % where it is above 0.3. About 2.5 is as good.
const SPREAD: f64 = 2.0;
/// A below it has no direction.
const SMALLEST: f64 = 1e-12;
/// Lanes of a film: `Phi_1, Phi_2, Theta_1, Theta_2, peak`.
const LANES: usize = 5;
/// Of them, those that are fitted side by side, with their parity: even in the tilts, odd, and the even peak, of which
/// no derivatives are asked.
const GROUPS: [(usize, &[usize]); 3] = [(0, &[0, 1]), (1, &[2, 3]), (0, &[4])];
/// Legendre polynomials up to one degree above the largest, and their derivatives.
struct Polynomials {
    /// Even ones, then odd ones.
    values: [[f64; HALF]; 2],
    slopes: [[f64; HALF]; 2],
}
/// Polynomials of a parity.
const HALF: usize = LARGEST_DEGREE / 2 + 1;

/// States `(eps, [along, across])` of the films near the centre.
pub(super) fn states(recipe: &SuperpositionRecipe) -> Vec<(f64, [f64; 2])> {
    let [shells, degree] = recipe.centre_nodes;
    let Ok(axis) = axis(shells) else {
        return Vec::new();
    };
    let (rings, rays) = (degree / 2 + 2, degree + 2);
    let mut states = Vec::new();
    for size in axis.values() {
        for ring in 0..rings {
            // The rim itself has no force of the wedge to divide by eps.
            let angle = FRAC_PI_2 * (ring as f64 + 0.5) / (rings as f64 + 0.1);
            let (radius, height) = angle.sin_cos();
            let height = height / SPREAD;
            let per_length = size / radius.hypot(height);
            for ray in 0..rays {
                // The other half is that of the journal turned round.
                let turn = PI * (ray as f64 + 0.25 * (ring % 3) as f64) / rays as f64;
                let (y, x) = turn.sin_cos();
                let tilts = [x, y].map(|side| per_length * radius * side);
                states.push((per_length * height, tilts));
            }
        }
    }
    states
}

fn axis(shells: usize) -> Result<Axis, DatabaseError> {
    Axis::new("centre_nodes", Spacing::Linear, SIZES[0], SIZES[1], shells)
}

/// Curves of the wedge near the centre.
#[derive(Debug, Clone)]
pub(super) struct Centre {
    placing: Placing,
    shells: usize,
    degree: usize,
    /// Coefficients of one A.
    width: usize,
    coefficients: Vec<f64>,
}

impl Centre {
    /// Curves through the films at [`states`]; none where the recipe has none.
    pub(super) fn through(
        recipe: &SuperpositionRecipe,
        nodes: &[[f64; FIGURES]],
    ) -> Result<Option<Self>, DatabaseError> {
        let [shells, degree] = recipe.centre_nodes;
        if shells == 0 {
            return Ok(None);
        }
        let states = states(recipe);
        let of_shell = states.len() / shells;
        let mut lines = Vec::new();
        for (states, nodes) in states.chunks(of_shell).zip(nodes.chunks(of_shell)) {
            let samples: Vec<_> = states
                .iter()
                .zip(nodes)
                .map(|((eps, tilts), node)| sample(*eps, *tilts, node))
                .collect();
            for (parity, lanes) in GROUPS {
                lines.extend(least_squares(degree, parity, lanes, &samples));
            }
        }
        let width = lines.len() / shells;
        Ok(Some(Self {
            placing: axis(shells)?.placing(),
            shells,
            degree,
            width,
            coefficients: fit(&lines, width, [End::NotAKnot; 2])?,
        }))
    }

    /// Share of the table over eccentricity and tilts at a size A, and its derivative.
    pub(super) fn share_of_table(size: f64) -> [f64; 2] {
        let span = SIZES[1] - JOIN;
        let place = ((size - JOIN) / span).clamp(0.0, 1.0);
        [
            place * place * (3.0 - 2.0 * place),
            6.0 * place * (1.0 - place) / span,
        ]
    }

    /// Forces over eps and moments with derivatives, at a size A, and where it is asked for, the peak.
    pub(super) fn lookup(
        &self,
        eps: f64,
        [along, across]: [f64; 2],
        size: f64,
        asks_peak: bool,
    ) -> Parts {
        let size = size.max(SMALLEST);
        let own = [eps, along, across].map(|side| side / size);
        let per_spread = 1.0 / spread(eps, [along, across]).max(SMALLEST);
        let (x, y) = (along * per_spread, across * per_spread);
        let inward = SPREAD * SPREAD * eps * per_spread;
        let mut parts = Parts::default();
        let (curves, peak) = self.curves(size, [x, y], asks_peak);
        for (lane, [value, by_size, by_x, by_y]) in curves.into_iter().enumerate() {
            let outward = by_x * x + by_y * y;
            let slopes = [
                by_size * own[0] - outward * inward * per_spread,
                by_size * own[1] + (by_x - outward * x) * per_spread,
                by_size * own[2] + (by_y - outward * y) * per_spread,
            ];
            if lane < 2 {
                parts.values[lane] = value;
                parts.slopes[lane] = slopes;
            } else {
                parts.values[lane] = size * value;
                parts.slopes[lane] = std::array::from_fn(|k| own[k] * value + size * slopes[k]);
            }
        }
        parts.peak = size * peak;
        parts
    }

    /// Of forces and moments: value, derivatives by A, x and y; and the peak where it is asked for.
    fn curves(&self, size: f64, [x, y]: [f64; 2], asks_peak: bool) -> ([[f64; 4]; 4], f64) {
        let reach = Reach::new(&self.placing, self.shells, size);
        let polynomials = [
            Polynomials::at(x, self.degree + 1),
            Polynomials::at(y, self.degree + 1),
        ];
        let rows: [&[f64]; 4] = std::array::from_fn(|k| {
            &self.coefficients[(reach.first + k) * self.width..][..self.width]
        });
        let [even, odd] = [0, 1].map(|parity| count_of_terms(self.degree, parity));
        let part = |from: usize, to: usize| rows.map(|row| &row[from..to]);
        let forces = pairs(part(0, 2 * even), &reach, self.degree, 0, &polynomials);
        let moments = pairs(
            part(2 * even, 2 * (even + odd)),
            &reach,
            self.degree,
            1,
            &polynomials,
        );
        let peak = match asks_peak {
            true => single(
                part(2 * (even + odd), self.width),
                &reach,
                self.degree,
                &polynomials,
            ),
            false => 0.0,
        };
        ([forces[0], forces[1], moments[0], moments[1]], peak)
    }
}

/// Sums of two curves side by side: value, derivatives by A, x and y.
fn pairs(
    rows: [&[f64]; 4],
    reach: &Reach,
    degree: usize,
    parity: usize,
    [of_x, of_y]: &[Polynomials; 2],
) -> [[f64; 4]; 2] {
    let rows = rows.map(|row| row.as_chunks::<2>().0);
    let [w0, w1, w2, w3] = reach.value;
    let [s0, s1, s2, s3] = reach.slope;
    let (mut sums, mut first) = ([[0.0; 2]; 4], 0);
    for i in 0..=degree + parity {
        let [own, other] = [i % 2, (i + parity) % 2];
        let count = count_of_line(degree, parity, i);
        let [a, b, c, d] = rows.map(|row| &row[first..first + count]);
        let (values, slopes) = (&of_y.values[other][..count], &of_y.slopes[other][..count]);
        let (mut line, mut by_size, mut by_y) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for k in 0..count {
            for lane in 0..2 {
                let value = w0 * a[k][lane] + w1 * b[k][lane] + w2 * c[k][lane] + w3 * d[k][lane];
                let slope = s0 * a[k][lane] + s1 * b[k][lane] + s2 * c[k][lane] + s3 * d[k][lane];
                line[lane] += values[k] * value;
                by_size[lane] += values[k] * slope;
                by_y[lane] += slopes[k] * value;
            }
        }
        let (value, slope) = (of_x.values[own][i / 2], of_x.slopes[own][i / 2]);
        for lane in 0..2 {
            sums[0][lane] += value * line[lane];
            sums[1][lane] += value * by_size[lane];
            sums[2][lane] += slope * line[lane];
            sums[3][lane] += value * by_y[lane];
        }
        first += count;
    }
    [0, 1].map(|lane| sums.map(|sum| sum[lane]))
}

/// The same of one even curve, its value alone.
fn single(rows: [&[f64]; 4], reach: &Reach, degree: usize, [of_x, of_y]: &[Polynomials; 2]) -> f64 {
    let [w0, w1, w2, w3] = reach.value;
    let (mut sum, mut first) = (0.0, 0);
    for i in 0..=degree {
        let parity = i % 2;
        let count = count_of_line(degree, 0, i);
        let [a, b, c, d] = rows.map(|row| &row[first..first + count]);
        let mut line = 0.0;
        for k in 0..count {
            line += of_y.values[parity][k] * (w0 * a[k] + w1 * b[k] + w2 * c[k] + w3 * d[k]);
        }
        sum += of_x.values[parity][i / 2] * line;
        first += count;
    }
    sum
}

/// Degrees in x and y of the terms of a parity: up to `degree` even ones, one more for the odd ones.
fn terms(degree: usize, parity: usize) -> impl Iterator<Item = [usize; 2]> {
    let top = degree + parity;
    (0..=top)
        .flat_map(move |i| (0..=top - i).map(move |j| [i, j]))
        .filter(move |[i, j]| (i + j) % 2 == parity)
}

/// Terms of a parity with the degree `i` in x.
fn count_of_line(degree: usize, parity: usize, i: usize) -> usize {
    let first = (i + parity) % 2;
    (degree + parity - i - first) / 2 + 1
}

/// All terms of a parity.
fn count_of_terms(degree: usize, parity: usize) -> usize {
    (0..=degree + parity)
        .map(|i| count_of_line(degree, parity, i))
        .sum()
}

/// Factors of the recurrence `P_n = a_n x P_(n-1) - b_n P_(n-2)`.
const RECURRENCE: [[f64; 2]; LARGEST_DEGREE + 2] = {
    let mut factors = [[0.0; 2]; LARGEST_DEGREE + 2];
    let mut n = 1;
    while n < LARGEST_DEGREE + 2 {
        let order = n as f64;
        factors[n] = [(2.0 * order - 1.0) / order, (order - 1.0) / order];
        n += 1;
    }
    factors
};

impl Polynomials {
    /// Polynomials up to degree `last` and their derivatives at a value from -1 to 1, by their recurrences.
    fn at(x: f64, last: usize) -> Self {
        let (mut values, mut slopes) = ([[0.0; HALF]; 2], [[0.0; HALF]; 2]);
        let (mut before, mut value) = (0.0, 1.0);
        let (mut slope_before, mut slope) = (0.0, 0.0);
        values[0][0] = 1.0;
        for n in 1..=last {
            let [a, b] = RECURRENCE[n];
            let next = a * x * value - b * before;
            let next_slope = slope_before + (2 * n - 1) as f64 * value;
            (before, value) = (value, next);
            (slope_before, slope) = (slope, next_slope);
            values[n % 2][n / 2] = value;
            slopes[n % 2][n / 2] = slope;
        }
        Self { values, slopes }
    }

    fn value(&self, degree: usize) -> f64 {
        self.values[degree % 2][degree / 2]
    }
}

/// Length by which tilts are divided for a direction.
fn spread(eps: f64, [along, across]: [f64; 2]) -> f64 {
    let weighted = SPREAD * eps;
    (weighted * weighted + along * along + across * across).sqrt()
}

/// Direction of a film and its lanes.
struct Sample {
    x: f64,
    y: f64,
    lanes: [f64; LANES],
}

fn sample(eps: f64, [along, across]: [f64; 2], node: &[f64; FIGURES]) -> Sample {
    let size = eps.hypot(along).hypot(across);
    let spread = spread(eps, [along, across]);
    Sample {
        x: along / spread,
        y: across / spread,
        lanes: [
            node[0] / eps,
            node[1] / eps,
            node[2] / size,
            node[3] / size,
            node[4] / size,
        ],
    }
}

/// Coefficients of the terms of a parity, its lanes side by side: normal equations, whose condition
/// is that of Legendre polynomials on a disc, by their Cholesky factor.
fn least_squares(degree: usize, parity: usize, lanes: &[usize], samples: &[Sample]) -> Vec<f64> {
    let terms: Vec<_> = terms(degree, parity).collect();
    let n = terms.len();
    let mut matrix = vec![0.0; n * n];
    let mut right = vec![0.0; n * lanes.len()];
    for sample in samples {
        let [of_x, of_y] = [sample.x, sample.y].map(|side| Polynomials::at(side, degree + 1));
        let basis: Vec<_> = terms
            .iter()
            .map(|[i, j]| of_x.value(*i) * of_y.value(*j))
            .collect();
        for row in 0..n {
            for column in 0..n {
                matrix[row * n + column] += basis[row] * basis[column];
            }
            for (k, lane) in lanes.iter().enumerate() {
                right[row * lanes.len() + k] += basis[row] * sample.lanes[*lane];
            }
        }
    }
    for row in 0..n {
        for column in 0..=row {
            let known: f64 = (0..column)
                .map(|k| matrix[row * n + k] * matrix[column * n + k])
                .sum();
            let rest = matrix[row * n + column] - known;
            matrix[row * n + column] = if row == column {
                rest.sqrt()
            } else {
                rest / matrix[column * n + column]
            };
        }
    }
    for lane in 0..lanes.len() {
        let at = |row: usize| row * lanes.len() + lane;
        for row in 0..n {
            let known: f64 = (0..row).map(|k| matrix[row * n + k] * right[at(k)]).sum();
            right[at(row)] = (right[at(row)] - known) / matrix[row * n + row];
        }
        for row in (0..n).rev() {
            let known: f64 = (row + 1..n)
                .map(|k| matrix[k * n + row] * right[at(k)])
                .sum();
            right[at(row)] = (right[at(row)] - known) / matrix[row * n + row];
        }
    }
    right
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// A wedge that a cone describes exactly, with a part of second order.
    fn wedge(eps: f64, [along, across]: [f64; 2]) -> [f64; FIGURES] {
        let size = eps.hypot(along).hypot(across);
        let spread = spread(eps, [along, across]);
        let (x, y) = (along / spread, across / spread);
        [
            eps * (0.3 * x * y + size),
            eps * (1.5 - 0.2 * x * x),
            size * (x + 0.4 * y * y * y + size * y),
            size * (y - x * x * y),
            size * (2.0 + x * x),
            0.0,
        ]
    }

    fn recipe() -> SuperpositionRecipe {
        SuperpositionRecipe {
            centre_nodes: [5, 4],
            ..SuperpositionRecipe::tilted(2.0)
        }
    }

    #[test]
    fn what_it_is_made_of_it_reproduces() {
        let recipe = recipe();
        let nodes: Vec<_> = (states(&recipe).iter())
            .map(|(eps, tilts)| wedge(*eps, *tilts))
            .collect();
        let centre = Centre::through(&recipe, &nodes).unwrap().unwrap();
        let h = 1e-7;
        // Below the first size, on the rim, aligned, and beyond what is solved.
        for (eps, along, across) in [
            (0.001, 0.002, -0.001),
            (0.0, 0.1, 0.2),
            (0.2, 0.0, 0.0),
            (0.05, -0.4, 0.1),
            (0.3, 0.2, -0.3),
        ] {
            let lookup = |eps: f64, [along, across]: [f64; 2]| {
                centre.lookup(eps, [along, across], eps.hypot(along).hypot(across), true)
            };
            let found = lookup(eps, [along, across]);
            // Forces over eps are even in it.
            let expected = wedge(eps.max(1e-9), [along, across]);
            for (k, expected) in expected.into_iter().enumerate().take(4) {
                let factor = if k < 2 { eps.max(1e-9) } else { 1.0 };
                assert!((found.values[k] - expected / factor).abs() < 1e-7);
                let at =
                    |e: f64, a: f64, c: f64| lookup(eps + e, [along + a, across + c]).values[k];
                let differences = [
                    (at(h, 0.0, 0.0) - at(-h, 0.0, 0.0)) / (2.0 * h),
                    (at(0.0, h, 0.0) - at(0.0, -h, 0.0)) / (2.0 * h),
                    (at(0.0, 0.0, h) - at(0.0, 0.0, -h)) / (2.0 * h),
                ];
                for (slope, difference) in found.slopes[k].iter().zip(differences) {
                    assert!((slope - difference).abs() < 2e-4 * (1.0 + slope.abs()));
                }
            }
            assert!((found.peak - expected[4]).abs() < 1e-7);
        }
        assert!(
            centre
                .lookup(0.0, [0.0; 2], 0.0, true)
                .values
                .iter()
                .all(|value| value.is_finite())
        );
    }

    #[test]
    fn it_joins_with_a_continuous_slope() {
        for size in [JOIN, SIZES[1]] {
            let [share, slope] = Centre::share_of_table(size);
            assert!((share - f64::from(u8::from(size > JOIN))).abs() < 1e-12);
            assert!(slope.abs() < 1e-12);
        }
        let middle = |size| Centre::share_of_table(size)[0];
        let slope = (middle(0.5 + 1e-6) - middle(0.5 - 1e-6)) / 2e-6;
        assert!((Centre::share_of_table(0.5)[1] - slope).abs() < 1e-6);
    }
}
