//! How far is a figure from what an infinitely fine grid would give?
//!
//! ```text
//! f(h) = f + a h^p     p = 2 for the film; less where a film fraction is carried from cell to cell
//! shift = (f_1 - f_j) h_1^p / (h_j^p - h_1^p)        f = f_1 + shift        grid 1 the finest
//! ```
//! A rupture line that crosses the grid makes single differences noisy, so no pair is trusted alone:
//! three grids give three shifts of order 2 and one of the observed order, held between 1 and 2.
//! - Error of the finest value: [`FINEST_SAFETY`] times the largest shift of that value.
//! - Error of the extrapolated value: the spread of the four limits, above all the difference between
//!   the extrapolations from the two finer and the two coarser grids, and a share of the largest shift
//!   ([`Kind::share`]), since limits may also agree by chance.
//!
//! - Where the observed order is not between [`LOWEST_ORDER`] and [`HIGHEST_ORDER`], or there is none,
//!   the differences are noise as much as error: the safety is [`ROUGH_SAFETY`], and the error of the
//!   extrapolated value counts [`ROUGH_FACTOR`] times.
//!
//! The form is that of Roache's grid convergence index for three grids and its factor 1.25, and
//! the larger of several fits is Eca and Hoekstra's; the second factor is calibrated here, on the
//! tables in `validation` (`film/tests/error_bars.rs` measures the coverage).
//! References: P. J. Roache, J. Fluids Eng. 116 (1994) 405, 10.1115/1.2910291; L. Eca, M. Hoekstra,
//! J. Comput. Phys. 262 (2014) 104, 10.1016/j.jcp.2014.01.006.

/// Safety on the largest shift, for the error of the value on the finest grid: Roache's for three
/// grids.
pub const FINEST_SAFETY: f64 = 1.25;

/// The same where the order is not believable: Roache's for two grids.
pub const ROUGH_SAFETY: f64 = 3.0;

/// Factor on the error of the extrapolated value where the order is not believable. With it the side
/// flows of Butenschoen's cases are covered in 98 % of the rows, without it in 95 %.
pub const ROUGH_FACTOR: f64 = 2.0;

/// How a figure comes out of the film: that tells how far its limits can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A sum over the film, or what follows from such: force, moment, torque, flow, place of the
    /// journal, coefficient. Smooth as the grid is refined.
    Integral,
    /// The same of a film fraction that is carried from cell to cell: friction of a ruptured film that
    /// conserves oil. Its order lies between 1 and 2, so that the limit of order 2 is no better known
    /// than the value.
    Transported,
    /// Value or place of an extreme, which wanders between the cells.
    Extreme,
}

impl Kind {
    /// Share of the largest shift that counts in the error of the extrapolated value in any case:
    /// calibrated on the tables of tilted films and of combined wedge and squeeze, so that no table of
    /// integrals is covered in less than 95 % of its rows; that of Raimondi and Boyd is a check from
    /// outside.
    #[must_use]
    pub const fn share(self) -> f64 {
        match self {
            Self::Integral => 0.2,
            Self::Transported => FINEST_SAFETY,
            Self::Extreme => 0.1,
        }
    }
}

/// Order of the discretisation of the film.
const FORMAL_ORDER: f64 = 2.0;
/// Lowest order that is believed: upwind transport of the film fraction has it.
pub const LOWEST_ORDER: f64 = 1.0;
/// Highest order that is believed.
pub const HIGHEST_ORDER: f64 = 3.0;

/// A figure on one grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Cell size, in any unit common to the samples.
    pub size: f64,
    /// The figure.
    pub value: f64,
}

/// What three grids tell about a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Best value: that of the finest grid, extrapolated by order 2.
    pub extrapolated: f64,
    /// Its error, absolute.
    pub error: f64,
    /// Error of the value on the finest grid, absolute.
    pub error_of_finest: f64,
    /// Observed order; `None` where the differences change sign.
    pub order: Option<f64>,
}

/// Estimates from three grids, the finest first, their sizes ascending and distinct. Not a number
/// where a value is not one.
#[must_use]
pub fn estimate(kind: Kind, [fine, middle, coarse]: [Sample; 3]) -> Estimate {
    let order = observed_order([fine, middle, coarse]);
    let of_pair = shift(fine, middle, FORMAL_ORDER);
    let of_ends = shift(fine, coarse, FORMAL_ORDER);
    let of_middle = middle.value - fine.value + shift(middle, coarse, FORMAL_ORDER);
    let of_order = order.map_or(of_pair, |order| {
        shift(fine, middle, order.clamp(LOWEST_ORDER, FORMAL_ORDER))
    });
    let largest = of_pair.abs().max(of_ends.abs()).max(of_order.abs());
    let shifts = [of_pair, of_ends, of_middle, of_order];
    let highest = shifts.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let lowest = shifts.into_iter().fold(f64::INFINITY, f64::min);
    // Maxima pass over what is not a number; the sum of the values does not.
    let nothing = 0.0 * (fine.value + middle.value + coarse.value);
    let is_clean = order.is_some_and(|p| (LOWEST_ORDER..=HIGHEST_ORDER).contains(&p));
    let (safety, factor) = if is_clean {
        (FINEST_SAFETY, 1.0)
    } else {
        (ROUGH_SAFETY, ROUGH_FACTOR)
    };
    Estimate {
        extrapolated: fine.value + of_pair,
        error: factor * (highest - lowest + kind.share() * largest) + nothing,
        error_of_finest: safety * largest + nothing,
        order,
    }
}

/// Errors of the two components of a vector: the larger for both, because a rupture line that moves by
/// a cell does not know the axes, and a component that happens to be small or to have stood still
/// would be thought too well of. A component that vanishes by symmetry keeps its own.
#[must_use]
pub fn vector_errors(errors: [f64; 2]) -> [f64; 2] {
    const NOTHING: f64 = 1e-9;
    let larger = errors[0].max(errors[1]);
    errors.map(|error| {
        if error > NOTHING * larger {
            larger
        } else {
            error
        }
    })
}

/// What is to be added to the finer value, if the error goes with the `order`th power of the size.
fn shift(fine: Sample, coarse: Sample, order: f64) -> f64 {
    let ratio = (coarse.size / fine.size).powf(order);
    (fine.value - coarse.value) / (ratio - 1.0)
}

/// Order p of `f + a h^p` through three grids, between 0.2 and 6, by bisection; `None` where the
/// differences change sign or vanish.
fn observed_order([fine, middle, coarse]: [Sample; 3]) -> Option<f64> {
    let ratio = (middle.value - coarse.value) / (fine.value - middle.value);
    if !ratio.is_finite() || ratio <= 0.0 {
        return None;
    }
    let [h1, h2, h3] = [fine.size, middle.size, coarse.size];
    let ratio_of = |p: f64| (h3.powf(p) - h2.powf(p)) / (h2.powf(p) - h1.powf(p));
    let (mut low, mut high) = (0.2, 6.0);
    for _ in 0..50 {
        let p = 0.5 * (low + high);
        // The farther difference grows with the order.
        if ratio_of(p) > ratio {
            high = p;
        } else {
            low = p;
        }
    }
    Some(0.5 * (low + high))
}

/// The factors by which a first grid is coarsened and refined: neighbours by 4/3 or 3/2, so that a
/// triple spans a factor of 2 and costs little more than its finest grid.
const FACTORS: [f64; 9] = [0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0];

/// Fewest cells around and along the axis of which a triple can still be made.
pub const SMALLEST_GRID: [usize; 2] = [32, 8];

/// Grids of one shape around `grid`, from half to eight times its cells in each direction, coarse to
/// fine; the third is `grid` itself. Cell numbers of the others are even, so that a symmetric bearing
/// keeps its mid-plane.
pub fn grid_sequence(grid: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
    FACTORS.into_iter().map(move |factor| {
        if factor == 1.0 {
            return grid;
        }
        grid.map(|cells| 2 * (0.5 * factor * cells as f64).round() as usize)
    })
}

/// Cell size of a grid of one shape: the root of the share of a cell in the bearing.
#[must_use]
pub fn cell_size([around, axial]: [usize; 2]) -> f64 {
    1.0 / ((around * axial) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const KIND: Kind = Kind::Integral;

    fn samples(value: impl Fn(f64) -> f64) -> [Sample; 3] {
        [1.0, 4.0 / 3.0, 2.0].map(|size| Sample {
            size,
            value: value(size),
        })
    }

    #[test]
    fn an_error_of_order_two_is_found_and_removed() {
        let found = estimate(KIND, samples(|h| 5.0 - 0.3 * h * h));
        assert!((found.extrapolated - 5.0).abs() < 1e-12);
        assert!((found.order.unwrap_or_default() - 2.0).abs() < 1e-6);
        assert!((found.error_of_finest - FINEST_SAFETY * 0.3).abs() < 1e-6);
        assert!((found.error - KIND.share() * 0.3).abs() < 1e-6);
    }

    #[test]
    fn an_error_of_order_one_is_covered() {
        let found = estimate(KIND, samples(|h| 5.0 - 0.3 * h));
        assert!((found.order.unwrap_or_default() - 1.0).abs() < 1e-6);
        // The order may come out a hair below 1, which is not believed any more.
        assert!(found.error_of_finest >= 0.3 && found.error_of_finest < 1.0);
        assert!((found.extrapolated - 5.0).abs() <= found.error);
    }

    #[test]
    fn noise_widens_the_error() {
        let clean = estimate(KIND, samples(|h| 1.0 + 0.1 * h * h));
        let mut noisy = samples(|h| 1.0 + 0.1 * h * h);
        noisy[0].value += 0.05;
        let found = estimate(KIND, noisy);
        assert!(found.error > 0.05 && found.error > clean.error);
        noisy[1].value = f64::NAN;
        assert!(
            estimate(KIND, noisy).error.is_nan() && estimate(KIND, noisy).error_of_finest.is_nan()
        );
    }

    #[test]
    fn what_no_grid_touches_has_no_error() {
        let found = estimate(KIND, samples(|_| 0.8));
        assert_eq!((found.error, found.error_of_finest), (0.0, 0.0));
        assert_eq!(found.extrapolated, 0.8);
    }

    #[test]
    fn only_smooth_figures_are_credited_their_limit() {
        let of = |kind| estimate(kind, samples(|h| 5.0 - 0.3 * h * h));
        let kinds = [Kind::Integral, Kind::Extreme, Kind::Transported];
        let [integral, extreme, transported] = kinds.map(of);
        let finest = integral.error_of_finest;
        assert!(integral.error < 0.25 * finest && extreme.error < 0.25 * finest);
        assert!(transported.error >= finest * (1.0 - 1e-12));
        assert_eq!(extreme.error_of_finest, finest);
        assert_eq!(transported.error_of_finest, finest);
    }

    #[test]
    fn grids_keep_shape_and_symmetry() {
        let grids: Vec<_> = grid_sequence([128, 32]).take(5).collect();
        let expected = [[64, 16], [96, 24], [128, 32], [192, 48], [256, 64]];
        assert_eq!(grids, expected);
        let odd: Vec<_> = grid_sequence([101, 21]).take(3).collect();
        assert_eq!(odd, [[50, 10], [76, 16], [101, 21]]);
    }
}
