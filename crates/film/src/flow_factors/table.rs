//! The factors as polynomials, for the many gaps of a film.
//!
//! One polynomial of the fifth degree per cell of H, with value and slope of the law at both ends and its
//! value at two places between, so that the whole is C1. Cells end where laws are joined, and are filled
//! when a gap first falls into them; beyond the cells the law itself answers. A table is off by less than
//! [`ERROR`] of the law (tested), its slopes by less than [`SLOPE_ERROR`].

use super::fits::Reading;

/// Largest error of a table over the law, where the law does not vanish.
#[cfg(test)]
pub(crate) const ERROR: f64 = 1e-10;
/// The same of slopes, over the law per H.
#[cfg(test)]
pub(crate) const SLOPE_ERROR: f64 = 1e-8;

/// Range of H, cells per unit of H and cells of the fine part and of the coarse part behind it. Below, some
/// laws are continued by exponentials too steep for cells.
const FINE_FROM: f64 = 1.0;
const PER_FINE: f64 = 32.0;
const FINE: usize = 352;
const COARSE_FROM: f64 = 12.0;
const PER_COARSE: f64 = 2.0;
const COARSE: usize = 512;

/// Squares of the places between, in half cells from the middle: 1/5.
const BETWEEN: f64 = 0.2;

/// Coefficients of a cell, by powers of the distance from its middle in half cells.
type Polynomial = [f64; 6];

/// Tables of `N` laws that are asked for together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LawTable<const N: usize> {
    /// Not a number where not filled yet.
    cells: Vec<[Polynomial; N]>,
    /// A place with a weak singularity, beside which the laws answer themselves.
    singular: f64,
}

/// How far the laws answer themselves beside a singularity, in H.
const SINGULAR_REACH: f64 = 0.125;

impl<const N: usize> LawTable<N> {
    /// An empty table; `singular` is infinite for smooth laws.
    pub(crate) fn new(singular: f64) -> Self {
        Self {
            cells: vec![[[f64::NAN; 6]; N]; FINE + COARSE],
            singular,
        }
    }

    /// Values and derivatives by H at H, of `laws`, which must be the same at every call.
    #[inline]
    pub(crate) fn at(&mut self, h: f64, laws: impl Fn(f64) -> [Reading; N]) -> [Reading; N] {
        let (from, per_unit, first, count) = if h < COARSE_FROM {
            (FINE_FROM, PER_FINE, 0, FINE)
        } else {
            (COARSE_FROM, PER_COARSE, FINE, COARSE)
        };
        let place = (h - from) * per_unit;
        let is_inside = place >= 0.0 && place < count as f64;
        if !is_inside || (h - self.singular).abs() < SINGULAR_REACH {
            return laws(h);
        }
        let within = place as usize;
        let cell = &mut self.cells[first + within];
        if cell[0][0].is_nan() {
            let middle = from + (within as f64 + 0.5) / per_unit;
            *cell = fitted(middle, 0.5 / per_unit, &laws);
        }
        let t = 2.0 * (place - within as f64) - 1.0;
        let mut readings = [(0.0, 0.0); N];
        for (reading, polynomial) in readings.iter_mut().zip(&*cell) {
            let (value, slope) = read(polynomial, t);
            *reading = (value, 2.0 * per_unit * slope);
        }
        readings
    }
}

/// Value and slope of a polynomial.
#[inline]
fn read(a: &Polynomial, t: f64) -> Reading {
    let square = t * t;
    let even = a[0] + square * (a[2] + square * a[4]);
    let odd = a[1] + square * (a[3] + square * a[5]);
    let by_even = 2.0 * a[2] + 4.0 * square * a[4];
    let by_odd = a[1] + square * (3.0 * a[3] + 5.0 * square * a[5]);
    (even + t * odd, by_odd + t * by_even)
}

/// Polynomials of a cell from its middle and half its width.
#[cold]
fn fitted<const N: usize>(
    middle: f64,
    half: f64,
    laws: &impl Fn(f64) -> [Reading; N],
) -> [Polynomial; N] {
    let place = BETWEEN.sqrt();
    let [low, inner_low, inner_high, high] =
        [-1.0, -place, place, 1.0].map(|t| laws(middle + half * t));
    std::array::from_fn(|k| {
        // Even and odd part: value and slope at the end, value between.
        let even = thirds(
            0.5 * (high[k].0 + low[k].0),
            0.5 * half * (high[k].1 - low[k].1),
            0.5 * (inner_high[k].0 + inner_low[k].0),
        );
        let rise = 0.5 * (high[k].0 - low[k].0);
        // The odd part over t: its slope at the end is less by its value.
        let odd = thirds(
            rise,
            0.5 * half * (high[k].1 + low[k].1) - rise,
            0.5 * (inner_high[k].0 - inner_low[k].0) / place,
        );
        [even[0], odd[0], even[1], odd[1], even[2], odd[2]]
    })
}

/// Coefficients of `a + b t^2 + c t^4` with value and slope at t = 1 and the value between.
fn thirds(value: f64, slope: f64, between: f64) -> [f64; 3] {
    let rest = 1.0 - BETWEEN;
    // Both equations of b and c: b + 2 c = slope/2, rest (b + (1 + BETWEEN) c) = value - between.
    let c = (0.5 * slope - (value - between) / rest) / rest;
    let b = 0.5 * slope - 2.0 * c;
    [value - b - c, b, c]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A law of the fifth degree is met exactly, and what lies outside is the law itself.
    #[test]
    fn polynomials_are_met_exactly() {
        let law = |h: f64| {
            let x = 0.1 * h;
            let value = 1.0 + x * (2.0 - x * (3.0 - x * (1.0 + x * (0.5 - x))));
            let slope = 2.0 - x * (6.0 - x * (3.0 + x * (2.0 - 5.0 * x)));
            [(value, 0.1 * slope)]
        };
        let mut table = LawTable::<1>::new(f64::INFINITY);
        for i in -500..3000 {
            let h = f64::from(i) * 0.0137;
            let ([got], [want]) = (table.at(h, law), law(h));
            let size = 1.0 + want.0.abs();
            assert!(
                (got.0 - want.0).abs() < 1e-12 * size,
                "{h}: {got:?} {want:?}"
            );
            assert!(
                (got.1 - want.1).abs() < 1e-9 * size,
                "{h}: {got:?} {want:?}"
            );
        }
        assert_eq!(table.at(1e4, law), law(1e4));
        assert!(table.at(f64::NAN, law)[0].0.is_nan());
    }
}
