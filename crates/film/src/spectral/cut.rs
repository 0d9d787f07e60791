//! How much of a function that changes sign lies where it is positive?
//!
//! ```text
//! int_(v > 0) v W ds = h sum_(v >= 0) v W + corrections at each change of sign
//! ```
//! The sum of a smooth periodic function is exact to the order of its smoothness, so that all error
//! sits at the ends of the positive stretch. There the sum is turned into the trapezoidal rule with its
//! end correction, and the rest up to the zero of v is integrated: v by the cubic through the four
//! nodes around the change of sign, the weight W linear. That rest does not change to first order as
//! the zero moves, so that derivatives of the discrete integral take the zero as fixed.

/// Four values around a change of sign, outward: the last but one and the last positive node, the two
/// behind it.
pub(super) type Stencil = [f64; 4];

/// Weights of the rest between the last positive node and the zero.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rest {
    /// For the weight's share at the positive node, and at the one behind it.
    shares: [Stencil; 2],
}

impl Rest {
    /// For values of which the second is not negative and the third is.
    pub(super) fn of(values: &Stencil) -> Self {
        let zero = zero_of(values);
        Self {
            shares: integrals_to(zero),
        }
    }

    /// What is to be added to the sum of `values * weights` (in units of the step), the weights at the
    /// same four nodes.
    #[inline]
    pub(super) fn correction(&self, values: &Stencil, weights: &Stencil) -> f64 {
        let [before, at, behind, _] = [0, 1, 2, 3].map(|i| values[i] * weights[i]);
        let sum = |share: &Stencil| -> f64 { share.iter().zip(values).map(|(a, b)| a * b).sum() };
        sum(&self.shares[0]) * weights[1] + sum(&self.shares[1]) * weights[2]
            - 0.5 * at
            - (behind - before) / 24.0
    }
}

/// `int_(v > 0) v W` over a ring of nodes, in units of the step; values and weights by place, from
/// `1 - half` to `half`, and up to two places beyond.
pub(super) fn integrate_positive(
    half: isize,
    value: impl Fn(isize) -> f64,
    weight: impl Fn(isize) -> f64,
) -> f64 {
    let mut sum = 0.0;
    for place in 1 - half..=half {
        if value(place) < 0.0 {
            continue;
        }
        sum += value(place) * weight(place);
        for way in [-1, 1] {
            if value(place + way) < 0.0 {
                let places: [isize; 4] = [-1, 0, 1, 2].map(|i| place + way * i);
                let (values, weights) = (places.map(&value), places.map(&weight));
                sum += Rest::of(&values).correction(&values, &weights);
            }
        }
    }
    sum
}

/// Coefficients of the cubic through values at -1, 0, 1, 2.
fn cubic([before, at, behind, beyond]: &Stencil) -> [f64; 4] {
    [
        *at,
        -before / 3.0 - 0.5 * at + behind - beyond / 6.0,
        0.5 * before - at + 0.5 * behind,
        -before / 6.0 + 0.5 * at - 0.5 * behind + beyond / 6.0,
    ]
}

/// Zero in [0, 1] of the cubic through values of which the second is not negative and the third is:
/// Newton inside the bracket.
pub(super) fn zero_of(values: &Stencil) -> f64 {
    const STEPS: usize = 60;
    let [c0, c1, c2, c3] = cubic(values);
    let (mut positive, mut negative) = (0.0, 1.0);
    let mut x = values[1] / (values[1] - values[2]);
    for _ in 0..STEPS {
        let value = c0 + x * (c1 + x * (c2 + x * c3));
        let slope = c1 + x * (2.0 * c2 + x * 3.0 * c3);
        if value >= 0.0 {
            positive = x;
        } else {
            negative = x;
        }
        let newton = x - value / slope;
        let next = if newton >= positive && newton <= negative {
            newton
        } else {
            0.5 * (positive + negative)
        };
        let change = (next - x).abs();
        x = next;
        if change < 1e-13 {
            break;
        }
    }
    x
}

/// Integrals from 0 to x of the four cubic base functions times 1 - x and times x.
fn integrals_to(x: f64) -> [Stencil; 2] {
    // Of x^n, n = 0 to 4.
    let mut moments = [0.0; 5];
    let mut power = x;
    for (n, moment) in moments.iter_mut().enumerate() {
        *moment = power / (n + 1) as f64;
        power *= x;
    }
    let against = |m: &[f64]| -> Stencil {
        [
            -m[1] / 3.0 + 0.5 * m[2] - m[3] / 6.0,
            m[0] - 0.5 * m[1] - m[2] + 0.5 * m[3],
            m[1] + 0.5 * m[2] - 0.5 * m[3],
            -m[1] / 6.0 + m[3] / 6.0,
        ]
    };
    let (whole, behind) = (against(&moments[..4]), against(&moments[1..]));
    [std::array::from_fn(|i| whole[i] - behind[i]), behind]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integral of the positive half of a sine wave times a weight, over the phase of the nodes.
    fn positive_part(count: usize, phase: f64) -> f64 {
        let step = std::f64::consts::TAU / count as f64;
        let at = |place: isize| step * place as f64 + phase;
        let weight = |place| 1.0 + 0.5 * (at(place) + 0.3).cos();
        step * integrate_positive(count as isize / 2, |place| at(place).sin(), weight)
    }

    #[test]
    fn the_error_is_of_fourth_order_wherever_the_zero_lies() {
        let quarter = 0.25 * std::f64::consts::PI; // of int sin cos = 0, int sin^2 = pi/2
        let exact = 2.0 - quarter * f64::sin(0.3);
        let worst = |count: usize| {
            (0..40)
                .map(|k| positive_part(count, 0.01 + 0.0043 * f64::from(k)) - exact)
                .fold(0.0, |a: f64, b| a.max(b.abs()))
        };
        let (coarse, fine) = (worst(32), worst(64));
        assert!(coarse < 1e-4, "{coarse}");
        assert!(coarse / fine > 13.0, "{coarse} {fine}");
    }
}
