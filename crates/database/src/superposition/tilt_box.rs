//! Which coordinates of a tilt fill a box, whatever the eccentricity?
//!
//! ```text
//! H = 1 + (eps - along Z) cos(phi) - across Z sin(phi)       along = gamma (1 - eps), across = delta
//! ```
//! At the edges the journal's centre stands at `eps -+ along, -+ across`, and the gap is open while both lie
//! within the unit circle: tilts fill the lens that two unit circles about `(+-eps, 0)` share. Both pass
//! through the corners `(0, +-a)`, `a = sqrt(1 - eps^2)`, so in bipolar coordinates about the corners the lens is
//! a strip, and every circle through them is a line:
//! ```text
//! v + i psi = 2 artanh((across + i along)/a)       |psi| < arccos(eps)
//! share = psi/arccos(eps) in (-1, 1)       transverse = tanh(v/2) in (-1, 1)
//! ```
//! The map is analytic, odd in each tilt, and turns into `gamma` and `delta/a` on the axes for
//! eccentricities near 1. `|share| = 1` is contact at an edge.

/// Place of a tilt with its derivatives.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct TiltPlace {
    /// Share of the tilt in the plane of the narrowest gap, and of the transverse one.
    pub shares: [f64; 2],
    /// Derivatives of each share by eccentricity, tilt along and tilt across.
    pub slopes: [[f64; 3]; 2],
}

/// Shares of the tilts `along` (gamma (1 - eps)) and `across` (delta) of an open gap, at a relative
/// eccentricity from 0 to below 1.
#[must_use]
pub fn place(eps: f64, along: f64, across: f64) -> TiltPlace {
    let square = (1.0 - eps) * (1.0 + eps);
    let a = square.sqrt();
    let widest = eps.acos();
    // 2 artanh(z/a) = ln((a + z)/(a - z)), z = across + i along
    let [near, far] = [
        (a + across) * (a + across) + along * along,
        (a - across) * (a - across) + along * along,
    ];
    // v = ln(near/far)/2, and tanh(v/2) without a logarithm.
    let ratio = (near / far).sqrt();
    let psi = along.atan2(a + across) + along.atan2(a - across);
    let transverse = (ratio - 1.0) / (ratio + 1.0);
    let share = psi / widest;
    // 1/(a^2 - z^2)
    let (re, im) = (
        square - across * across + along * along,
        -2.0 * across * along,
    );
    let size = re * re + im * im;
    let (re, im) = (re / size, -im / size);
    // dzeta/dz = 2 a/(a^2 - z^2), dzeta/da = -2 z/(a^2 - z^2)
    let (by_across, by_along) = ([2.0 * a * re, 2.0 * a * im], [-2.0 * a * im, 2.0 * a * re]);
    let by_a = [
        -2.0 * (across * re - along * im),
        -2.0 * (across * im + along * re),
    ];
    let da = -eps / a;
    let narrowing = 0.5 * (1.0 - transverse * transverse);
    TiltPlace {
        shares: [share, transverse],
        slopes: [
            [
                by_a[1] * da / widest + share / (a * widest),
                by_along[1] / widest,
                by_across[1] / widest,
            ],
            [
                by_a[0] * da * narrowing,
                by_along[0] * narrowing,
                by_across[0] * narrowing,
            ],
        ],
    }
}

/// Tilts `[along, across]` at two shares: the inverse of [`place`].
#[must_use]
pub fn tilts(eps: f64, [share, transverse]: [f64; 2]) -> [f64; 2] {
    let a = ((1.0 - eps) * (1.0 + eps)).sqrt();
    let (v, psi) = (2.0 * transverse.atanh(), share * eps.acos());
    let divisor = v.cosh() + psi.cos();
    [a * psi.sin() / divisor, a * v.sinh() / divisor]
}

/// Smallest relative film thickness: at the worse edge.
#[must_use]
pub fn smallest_gap(eps: f64, along: f64, across: f64) -> f64 {
    1.0 - (eps + along.abs()).hypot(across)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACES: [f64; 5] = [-0.9, -0.4, 0.0, 0.3, 0.85];

    #[test]
    fn the_box_is_the_open_gap() {
        for eps in [0.0, 0.05, 0.5, 0.9, 0.99] {
            for share in PLACES {
                for transverse in PLACES {
                    let [along, across] = tilts(eps, [share, transverse]);
                    assert!(smallest_gap(eps, along, across) > 0.0);
                    let back = place(eps, along, across).shares;
                    assert!(
                        (back[0] - share).abs() < 1e-12 && (back[1] - transverse).abs() < 1e-12
                    );
                }
                // Contact on the whole side, at either edge.
                for contact in [-1.0, 1.0] {
                    let [along, across] = tilts(eps, [contact, share]);
                    assert!(smallest_gap(eps, along, across).abs() < 1e-12);
                }
            }
        }
        // On the axes: gamma and delta over their largest values, near contact.
        let [along, across] = tilts(0.999, [0.6, 0.0]);
        assert!((along / 0.001 - 0.6).abs() < 1e-3 && across == 0.0);
        let across = tilts(0.8, [0.0, 0.5])[1];
        assert!((across - 0.3).abs() < 1e-12);
    }

    #[test]
    fn slopes_are_those_of_central_differences() {
        let h = 1e-6;
        for eps in [0.1, 0.6, 0.95] {
            for share in PLACES {
                for transverse in PLACES {
                    let [along, across] = tilts(eps, [share, transverse]);
                    let found = place(eps, along, across).slopes;
                    let of = |e: f64, l: f64, c: f64| place(eps + e, along + l, across + c).shares;
                    for k in 0..2 {
                        let scale = h * (1.0 - eps);
                        let differences = [
                            of(scale, 0.0, 0.0)[k] - of(-scale, 0.0, 0.0)[k],
                            of(0.0, scale, 0.0)[k] - of(0.0, -scale, 0.0)[k],
                            of(0.0, 0.0, scale)[k] - of(0.0, 0.0, -scale)[k],
                        ];
                        for (found, difference) in found[k].iter().zip(differences) {
                            let difference = difference / (2.0 * scale);
                            let off = (found - difference).abs();
                            assert!(off < 1e-6 * (1.0 + difference.abs()) / (1.0 - eps));
                        }
                    }
                }
            }
        }
    }
}
