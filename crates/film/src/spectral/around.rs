//! Which coordinate makes an aligned film smooth around the bearing, and what is its equation there?
//!
//! ```text
//! theta from the narrowest gap, H = 1 - e cos(theta), s:  cos(theta) = (m + cos s)/(1 + m cos s)
//! H = N/D,  N = 1 - e m + (m - e) cos s,  D = 1 + m cos s,  dtheta/ds = sqrt(1 - m^2)/D
//! (H^3 u')' - k H^3 u = -w n,  U = u sqrt(H^3 ds/dtheta):   U_ss - (k (dtheta/ds)^2 + r) U = f
//! ```
//! Sommerfeld's substitution with a modulus m below e: nodes evenly spaced in s crowd where the gap is
//! narrow and are not too far apart where it is wide. All coefficients are algebraic in cos s, so that
//! their derivatives by e, at a node that moves with e, are exact.
//! References: A. Sommerfeld, Z. Math. Phys. 50 (1904) 97; G. Vogelpohl, VDI-Forschungsheft 386 (1937)
//! (pressure times H^1.5).

use std::f64::consts::TAU;

/// Modulus of the substitution over the relative eccentricity.
const MODULUS: f64 = 0.82;

/// The substitution at one eccentricity, with derivatives by it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Substitution {
    modulus: Dual,
    /// 1 - m^2.
    rest: Dual,
    /// N at cos s = 0 and its slope by cos s.
    gap: [Dual; 2],
    /// (1 - m^2)^(3/4) and (1 - m^2)^(5/4).
    scales: [Dual; 2],
}

/// A value and its derivative by the relative eccentricity.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Dual {
    pub value: f64,
    pub slope: f64,
}

/// The equation at one node, without what belongs to a shape across the width.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Node {
    /// (dtheta/ds)^2: the factor of k.
    pub stretch: Dual,
    /// r.
    pub potential: Dual,
    /// f for unit motion along the line of centres and across it; also the weights of the film
    /// force per U: force = int U f ds.
    pub source: [Dual; 2],
}

impl Substitution {
    pub(super) fn new(eps: f64) -> Self {
        let modulus = Dual {
            value: MODULUS * eps,
            slope: MODULUS,
        };
        let (m, m_slope) = (modulus.value, modulus.slope);
        let rest = (1.0 - m) * (1.0 + m);
        let rest_slope = -2.0 * m * m_slope;
        let quarter = rest.sqrt().sqrt();
        let power = |value: f64, exponent: f64| Dual {
            value,
            slope: value * exponent * rest_slope / rest,
        };
        Self {
            modulus,
            rest: Dual {
                value: rest,
                slope: rest_slope,
            },
            gap: [
                Dual {
                    value: 1.0 - eps * m,
                    slope: -m - eps * m_slope,
                },
                Dual {
                    value: m - eps,
                    slope: m_slope - 1.0,
                },
            ],
            scales: [power(rest / quarter, 0.75), power(rest * quarter, 1.25)],
        }
    }

    /// The equation where s has this cos and sin.
    #[inline]
    pub(super) fn node(&self, cos: f64, sin: f64) -> Node {
        let (m, m_slope) = (self.modulus.value, self.modulus.slope);
        let [base, rise] = self.gap;
        let n = base.value + rise.value * cos;
        let n_slope = base.slope + rise.slope * cos;
        let per_n = 1.0 / n;
        let per_d = 1.0 / (1.0 + m * cos);
        let d_change = m_slope * cos * per_d;
        let n_change = n_slope * per_n;

        let stretch = self.rest.value * per_d * per_d;
        let a = rise.value * per_n;
        let a_slope = rise.slope * per_n - a * n_change;
        let b = m * per_d;
        let b_slope = m_slope * per_d - b * d_change;
        // ln of the square root of H^3 ds/dtheta: its first derivative is l sin s.
        let l = b - 1.5 * a;
        let l_slope = b_slope - 1.5 * a_slope;
        let bend = b * b - 1.5 * a * a + l * l;
        let bend_slope = 2.0 * b * b_slope - 3.0 * a * a_slope + 2.0 * l * l_slope;

        let narrow = -per_n * per_n.sqrt() * per_d;
        let common = -1.5 * n_change - d_change;
        let [along, across] = self.scales;
        let along_unit = along.value * narrow;
        let along_value = along_unit * (m + cos);
        let across_value = across.value * narrow * sin;
        Node {
            stretch: Dual {
                value: stretch,
                slope: self.rest.slope * per_d * per_d - 2.0 * stretch * d_change,
            },
            potential: Dual {
                value: cos * l + sin * sin * bend,
                slope: cos * l_slope + sin * sin * bend_slope,
            },
            source: [
                Dual {
                    value: along_value,
                    slope: along_value * common
                        + along_unit * m_slope
                        + along.slope * narrow * (m + cos),
                },
                Dual {
                    value: across_value,
                    slope: across_value * common + across.slope * narrow * sin,
                },
            ],
        }
    }

    /// theta of s in [-pi, pi], rad.
    pub(super) fn angle(&self, s: f64) -> f64 {
        let m = self.modulus.value;
        turned(s, [1.0 - m, 1.0 + m])
    }

    /// u/U, the inverse square root of H^3 ds/dtheta, and H, where s has this cosine.
    pub(super) fn unscaled(&self, cos: f64) -> [f64; 2] {
        let n = self.gap[0].value + self.gap[1].value * cos;
        let d = 1.0 + self.modulus.value * cos;
        [self.rest.value.sqrt().sqrt() * d / (n * n.sqrt()), n / d]
    }
}

/// The substitution itself, over any number of turns.
#[derive(Debug, Clone, Copy)]
pub(super) struct SommerfeldAngle {
    modulus: f64,
    /// How it grows with the relative eccentricity.
    growth: f64,
    /// sqrt(1 - m^2).
    root: f64,
    /// N at cos s = 0 and its slope by cos s.
    gap: [f64; 2],
}

impl SommerfeldAngle {
    /// At a relative eccentricity, with a modulus of a share of it.
    pub(super) fn new(eps: f64, share: f64) -> Self {
        Self::of_modulus(eps, share * eps, share)
    }

    /// With a modulus m that falls behind as the gap closes: `(1 + m)/(1 - m) = ((1 + e)/(1 - e))^power`.
    pub(super) fn graded(eps: f64, power: f64) -> Self {
        let ratio = ((1.0 - eps) / (1.0 + eps)).powf(power);
        let modulus = (1.0 - ratio) / (1.0 + ratio);
        let growth = power * (1.0 - modulus * modulus) / ((1.0 - eps) * (1.0 + eps));
        Self::of_modulus(eps, modulus, growth)
    }

    fn of_modulus(eps: f64, modulus: f64, growth: f64) -> Self {
        Self {
            modulus,
            growth,
            root: ((1.0 - modulus) * (1.0 + modulus)).sqrt(),
            gap: [1.0 - eps * modulus, modulus - eps],
        }
    }

    /// theta of s, rad.
    pub(super) fn angle(&self, s: f64) -> f64 {
        turned(s, [1.0 - self.modulus, 1.0 + self.modulus])
    }

    /// Where theta has this cos and sin: dtheta/ds, the changes of its logarithm by s and by relative
    /// eccentricity at that s, and the change of theta by relative eccentricity there.
    pub(super) fn rates(&self, [cos, sin]: [f64; 2]) -> (f64, [f64; 2], f64) {
        let per_root = 1.0 / self.root;
        let share = self.growth * per_root * per_root;
        (
            (1.0 - self.modulus * cos) * per_root,
            [self.modulus * sin * per_root, -share * cos],
            -share * sin,
        )
    }

    /// s of theta, rad.
    pub(super) fn of(&self, angle: f64) -> f64 {
        turned(angle, [1.0 + self.modulus, 1.0 - self.modulus])
    }

    /// cos and sin of theta, dtheta/ds and H where s has this sin and cos.
    pub(super) fn at(&self, (sin, cos): (f64, f64)) -> ([f64; 2], f64, f64) {
        let per_d = 1.0 / (1.0 + self.modulus * cos);
        let stretch = self.root * per_d;
        (
            [(self.modulus + cos) * per_d, stretch * sin],
            stretch,
            (self.gap[0] + self.gap[1] * cos) * per_d,
        )
    }
}

/// The angle whose half has a tangent by the root of a ratio that of the half of another.
fn turned(angle: f64, [above, below]: [f64; 2]) -> f64 {
    let turns = (angle / TAU).round() * TAU;
    let (sin, cos) = (0.5 * (angle - turns)).sin_cos();
    2.0 * (above.sqrt() * sin).atan2(below.sqrt() * cos) + turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gap_belongs_to_the_angle() {
        for eps in [0.0, 0.4, 0.95] {
            let map = Substitution::new(eps);
            for s in [-3.0, -0.7, 0.0, 0.2, 1.9] {
                let [_, gap] = map.unscaled(f64::cos(s));
                let exact = 1.0 - eps * map.angle(s).cos();
                assert!((gap - exact).abs() < 1e-14, "{eps} {s}: {gap} {exact}");
            }
        }
    }

    /// U = sqrt(H^3 ds/dtheta) itself solves U'' = r U, as u = 1 does without side flow and motion.
    #[test]
    fn the_potential_is_that_of_a_constant_pressure() {
        let map = Substitution::new(0.9);
        let root = |s: f64| 1.0 / map.unscaled(s.cos())[0];
        for s in [0.1, 1.3, 2.9] {
            let d = 1e-4;
            let bend = (root(s + d) - 2.0 * root(s) + root(s - d)) / (d * d);
            let exact = map.node(s.cos(), s.sin()).potential.value * root(s);
            assert!((bend / exact - 1.0).abs() < 1e-5, "{s}: {bend} {exact}");
        }
    }

    #[test]
    fn there_and_back_over_turns() {
        let map = SommerfeldAngle::new(0.9, 0.95);
        for angle in [-4.0, -1.0, 0.0, 3.0, 5.5] {
            let s = map.of(angle);
            assert!((map.angle(s) - angle).abs() < 1e-13);
            let ([cos, sin], stretch, gap) = map.at(s.sin_cos());
            assert!((cos - angle.cos()).abs() < 1e-13 && (sin - angle.sin()).abs() < 1e-13);
            assert!((gap - (1.0 - 0.9 * angle.cos())).abs() < 1e-13);
            let slope = (map.angle(s + 1e-6) - map.angle(s - 1e-6)) / 2e-6;
            assert!((stretch - slope).abs() < 1e-8);
        }
    }

    #[test]
    fn slopes_equal_differences() {
        let eps = 0.83;
        let s: f64 = 0.9;
        let at = |eps: f64| {
            let node = Substitution::new(eps).node(s.cos(), s.sin());
            [node.stretch, node.potential, node.source[0], node.source[1]]
        };
        let (plus, minus) = (at(eps + 1e-6), at(eps - 1e-6));
        for (k, dual) in at(eps).iter().enumerate() {
            let difference = (plus[k].value - minus[k].value) / 2e-6;
            let bar = 1e-8 * (1.0 + difference.abs());
            assert!((dual.slope - difference).abs() < bar, "{k}: {difference}");
        }
    }
}
