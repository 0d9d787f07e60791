//! Where does a film end around the bearing, and how does the place vary across the width?
//!
//! Both fronts are polynomials in Z^2, fitted to what each line of Gauss points asks for. Lines close
//! to an end count little: there the front bends sharply into the corner, next to no pressure stands
//! before it, and what it asks for is noise.

use crate::spectral::quadrature::gauss_legendre;

/// Most terms of a front.
pub(super) const MOST_TERMS: usize = 6;
/// How fast the weight of lines falls towards the ends: (1 - Z^2) to this power.
const FALL: i32 = 3;

/// The fit: from wishes on the lines to fronts and their slopes there.
#[derive(Debug, Clone)]
pub(super) struct FrontFit<const G: usize> {
    /// Orthonormal polynomials on the lines, and their slopes by Z.
    terms: [[[f64; G]; 2]; MOST_TERMS],
    /// Weights of the fit.
    weights: [f64; G],
    /// The terms by the weights of their conditions.
    moments: [[f64; G]; MOST_TERMS],
}

/// The fronts that bound the film, the first and the last in the sense of the angle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fronts<const G: usize> {
    /// Angles from the line of centres on each line, rad.
    pub angles: [[f64; G]; 2],
    /// Their slopes by Z.
    pub slopes: [[f64; G]; 2],
}

impl<const G: usize> FrontFit<G> {
    pub(super) fn new() -> Self {
        let points = gauss_legendre(2 * G);
        let places: [f64; G] = std::array::from_fn(|g| points[g][0]);
        let weights: [f64; G] =
            std::array::from_fn(|g| points[g][1] * (1.0 - places[g] * places[g]).powi(FALL));
        let mut terms = [[[0.0; G]; 2]; MOST_TERMS];
        for term in 0..MOST_TERMS {
            let power = 2 * term as i32;
            let mut value = places.map(|z| z.powi(power));
            let mut slope = places.map(|z| f64::from(power) * z.powi((power - 1).max(0)));
            // Twice is enough for orthogonality to round-off.
            for _ in 0..2 {
                for known in &terms[..term] {
                    let share = weighted(&weights, &value, &known[0]);
                    for g in 0..G {
                        value[g] -= share * known[0][g];
                        slope[g] -= share * known[1][g];
                    }
                }
            }
            let size = weighted(&weights, &value, &value).sqrt();
            terms[term] = [value.map(|v| v / size), slope.map(|v| v / size)];
        }
        let moments = terms.map(|[value, _]| {
            std::array::from_fn(|g| points[g][1] * (1.0 - places[g] * places[g]) * value[g])
        });
        Self {
            terms,
            weights,
            moments,
        }
    }

    /// Fronts of `count` terms closest to the wishes.
    pub(super) fn fit(&self, wishes: &[[f64; G]; 2], count: usize) -> Fronts<G> {
        let [first, last] = [0, 1].map(|side| self.front(&self.parts(&wishes[side], count)));
        Fronts {
            angles: [first[0], last[0]],
            slopes: [first[1], last[1]],
        }
    }

    /// Parts of `count` terms in the front closest to the wishes for it.
    pub(super) fn parts(&self, wishes: &[f64; G], count: usize) -> [f64; MOST_TERMS] {
        let mut parts = [0.0; MOST_TERMS];
        for (part, [value, _]) in parts.iter_mut().zip(&self.terms).take(count) {
            *part = weighted(&self.weights, wishes, value);
        }
        parts
    }

    /// Angles and slopes of a front of these parts.
    pub(super) fn front(&self, parts: &[f64]) -> [[f64; G]; 2] {
        let mut front = [[0.0; G]; 2];
        for (part, term) in parts.iter().zip(&self.terms) {
            for g in 0..G {
                front[0][g] += part * term[0][g];
                front[1][g] += part * term[1][g];
            }
        }
        front
    }

    /// A term and its slope by Z on the lines.
    pub(super) fn term(&self, term: usize) -> &[[f64; G]; 2] {
        &self.terms[term]
    }

    /// What the flux across a front counts on the lines in the condition of a term: the term by 1 - Z^2, as the
    /// pressure before the front falls to the ends.
    pub(super) fn moment(&self, term: usize) -> &[f64; G] {
        &self.moments[term]
    }

    /// Weighted mean square of a change of angles, rad.
    pub(super) fn size_on_lines(&self, change: &[f64; G]) -> f64 {
        (weighted(&self.weights, change, change) / self.whole()).sqrt()
    }

    /// The same of a change of both fronts by these parts.
    pub(super) fn size_of_parts(&self, parts: &[f64]) -> f64 {
        let square: f64 = parts.iter().map(|part| part * part).sum();
        (square / self.whole()).sqrt()
    }

    fn whole(&self) -> f64 {
        self.weights.iter().sum()
    }
}

fn weighted<const G: usize>(weights: &[f64; G], a: &[f64; G], b: &[f64; G]) -> f64 {
    (0..G).map(|g| weights[g] * a[g] * b[g]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_polynomials_are_met_with_their_slopes() {
        let fit = FrontFit::<6>::new();
        let points = gauss_legendre(12);
        let front = |z: f64| 1.5 - 0.4 * z * z + 0.3 * z.powi(4);
        let wishes: [f64; 6] = std::array::from_fn(|g| front(points[g][0]));
        let fronts = fit.fit(&[wishes, wishes.map(|w| -w)], 3);
        for g in 0..6 {
            let z = points[g][0];
            assert!((fronts.angles[0][g] - wishes[g]).abs() < 1e-12);
            assert!((fronts.angles[1][g] + wishes[g]).abs() < 1e-12);
            let slope = -0.8 * z + 1.2 * z.powi(3);
            assert!((fronts.slopes[0][g] - slope).abs() < 1e-11);
        }
    }
}
