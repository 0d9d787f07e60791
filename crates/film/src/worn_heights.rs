//! How rough is a surface whose highest places have been worn down to a plateau?
//!
//! Heights z of the fresh surface are Gaussian with the rms s about its mean plane. Sliding against a
//! harder surface cuts what reaches above a level t and leaves what lies below: `x = min(z, t)`. With
//! `u = t/s`, the density f of the unit Gaussian, `Q(u)` its tail and F_1 of [`crate::contact`]
//!
//! ```text
//! d = E[z - x]                = s F_1(u)                          mean height removed = worn depth
//! rms^2 = E[x^2] - E[x]^2     = s^2 (1 - Q - u F_1 - F_1^2)       about the new mean plane, at -d
//! d(rms^2)/dd                 = -2 (t + d)                        a slice of the plateau, twice its height
//! plateau share               = Q(u)
//! ```
//! Unknown: the level t that belongs to a depth d (Newton on ln F_1, which is concave: from above the
//! root it converges from one side).
//!
//! Limits: truncation alone, no new marks on the plateau and none in the valleys. At t = 0 every
//! summit is gone, `d = s/sqrt(2 pi)` and `rms = s sqrt(1/2 - 1/(2 pi)) = 0.584 s`; deeper wear renews
//! the surface as fast as it cuts it, so that profile and mean plane move and the roughness stays.
//!
//! References: T. G. King, W. Watson, K. J. Stout, The micro-geometry of the running-in process, 4th
//! Leeds-Lyon Symposium on Tribology, 1978 (worn profiles as truncated Gaussian ones); E. J. Abbott,
//! F. A. Firestone, Mech. Eng. 55 (1933) 569 (bearing area curve). The moments are those of a censored
//! Gaussian, worked out here and tested against quadrature.

use crate::height_integrals::F_1;

/// F_1(0) = 1/sqrt(2 pi): depth over rms at which every summit is gone.
const ALL_SUMMITS: f64 = 0.398_942_280_401_432_7;
/// Depth over rms below which nothing is worn: F_1 of a level above 33.
const NOTHING: f64 = 1e-240;

/// Heights of a surface worn down to a plateau.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WornHeights {
    /// Level of the plateau above the mean plane of the fresh surface, m; infinite for a fresh one, not
    /// below zero.
    pub level: f64,
    /// rms roughness about the new mean plane, m.
    pub rms: f64,
    /// Share of the surface that is plateau, 0 to 1/2.
    pub plateau_share: f64,
    /// Depth that truncation has taken off the mean height, m: the worn depth until all summits are gone.
    pub truncated: f64,
}

impl WornHeights {
    /// Of a surface with the rms roughness `rms` (m) that has lost `depth` (m) of its mean height; what is
    /// not above zero is no wear.
    #[must_use]
    pub fn of(rms: f64, depth: f64) -> Self {
        let wanted = depth / rms;
        if !(wanted > NOTHING && rms > 0.0) {
            return Self {
                level: f64::INFINITY,
                rms,
                plateau_share: 0.0,
                truncated: 0.0,
            };
        }
        let level = level_of(wanted.min(ALL_SUMMITS));
        let (overlap, slope) = F_1.at(level);
        let variance = 1.0 + slope - level * overlap - overlap * overlap;
        Self {
            level: rms * level,
            rms: rms * variance.sqrt(),
            plateau_share: -slope,
            truncated: rms * wanted.min(ALL_SUMMITS),
        }
    }
}

/// The level over rms, not below zero, above which the mean overlap is `wanted`.
fn level_of(wanted: f64) -> f64 {
    const STEPS: usize = 60;
    // F_1 lies below the density above zero: the start is above the root.
    let mut level = (-2.0 * (wanted / ALL_SUMMITS).ln()).max(0.0).sqrt();
    for _ in 0..STEPS {
        let (value, slope) = F_1.at(level);
        let step = (value / wanted).ln() * value / slope;
        level = (level - step).max(0.0);
        if step.abs() <= 1e-15 * level {
            break;
        }
    }
    level
}

#[cfg(test)]
mod tests {
    use super::*;

    const RMS: f64 = 0.7e-6;

    /// Mean and rms of min(z, level) for unit Gaussian heights, by the trapezoidal rule, which is exact
    /// to round-off below the level and of second order at its kink, a node.
    fn quadrature(level: f64) -> (f64, f64) {
        const CELLS: i32 = 40_000;
        let density = |z: f64| (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
        let sum = |from: f64, to: f64, value: &dyn Fn(f64) -> f64| {
            let step = (to - from) / f64::from(CELLS);
            let inner = (1..CELLS).map(|k| from + step * f64::from(k));
            let inner: f64 = inner.map(|z| value(z) * density(z)).sum();
            step * (inner + 0.5 * (value(from) * density(from) + value(to) * density(to)))
        };
        let moment = |power: i32| {
            sum(-12.0, level, &|z| z.powi(power)) + sum(level, 12.0, &|_| level.powi(power))
        };
        let mean = moment(1);
        (mean, (moment(2) - mean * mean).sqrt())
    }

    /// What is worn is what the truncation has taken, and the roughness is that of what is left.
    #[test]
    fn worn_heights_are_those_of_the_truncated_distribution() {
        for depth in [1e-6, 1e-3, 0.02, 0.1, 0.25, 0.39] {
            let worn = WornHeights::of(RMS, depth * RMS);
            let (mean, rms) = quadrature(worn.level / RMS);
            assert!((mean + depth).abs() < 1e-8, "{depth}: {mean}");
            assert!((worn.rms / RMS - rms).abs() < 1e-8, "{depth}: {rms}");
            assert!((worn.truncated / (depth * RMS) - 1.0).abs() < 1e-12);
        }
    }

    /// A thin slice of the plateau takes twice its height above the mean plane off the variance.
    #[test]
    fn the_variance_falls_by_the_slice_that_is_cut() {
        for depth in [1e-4, 0.01, 0.2, 0.35] {
            let step = 1e-5 * depth;
            let variance = |depth: f64| (WornHeights::of(RMS, depth * RMS).rms / RMS).powi(2);
            let found = (variance(depth + step) - variance(depth - step)) / (2.0 * step);
            let expected = -2.0 * (WornHeights::of(RMS, depth * RMS).level / RMS + depth);
            assert!(
                (found / expected - 1.0).abs() < 1e-6,
                "{depth}: {found} {expected}"
            );
        }
    }

    #[test]
    fn roughness_ends_where_all_summits_are_gone() {
        let last = RMS * (0.5 - 0.5 / std::f64::consts::PI).sqrt();
        for depth in [ALL_SUMMITS, 1.0, 50.0] {
            let worn = WornHeights::of(RMS, depth * RMS);
            assert!((worn.rms / last - 1.0).abs() < 1e-12, "{worn:?}");
            assert!(worn.level.abs() < 1e-9 * RMS && (worn.plateau_share - 0.5).abs() < 1e-9);
            assert!((worn.truncated / (ALL_SUMMITS * RMS) - 1.0).abs() < 1e-12);
        }
        let mut before = RMS;
        for k in 1..=400 {
            let worn = WornHeights::of(RMS, 1e-3 * f64::from(k) * RMS);
            assert!(worn.rms <= before && worn.level >= 0.0, "{k}");
            before = worn.rms;
        }
    }

    #[test]
    fn no_wear_leaves_every_bit() {
        for depth in [0.0, -1.0, f64::NAN, 1e-260] {
            let worn = WornHeights::of(RMS, depth * RMS);
            assert_eq!((worn.rms, worn.plateau_share), (RMS, 0.0));
            assert!(worn.level.is_infinite());
        }
        assert_eq!(WornHeights::of(0.0, 1e-6).rms, 0.0);
        // The smallest wear is found, too.
        let worn = WornHeights::of(1.0, 1e-200);
        assert!(
            (F_1.at(worn.level).0 / 1e-200 - 1.0).abs() < 1e-9,
            "{worn:?}"
        );
    }
}
