//! How much flow can a thickening oil carry? The reduced pressure `q(p) = integral from 0 to p of
//! eta0 / eta dp'`, Pa.
//!
//! With `dq = (eta0 / eta) dp` the Reynolds equation of a rigid film is the isoviscous one in q
//! (H. Blok, 1950, and A. N. Grubin, 1949, for the wedge). q is bounded: for Barus by `1 / alpha`,
//! for Roelands by an incomplete gamma function. **A rigid film whose isoviscous pressure exceeds
//! the bound has no solution**; elastic surfaces remove the bound.
//!
//! Roelands: with `t = ln(1 + 5.1e-9 p)` the integrand is `exp(t - L (e^(z t) - 1))`, smooth and
//! falling doubly exponentially: panels of ten Gauss points. For `z = 1` it is Barus' law.
//!
//! Limits: the laws' bound on their exponents ([`crate::pressure`]) is left out: it would make q
//! grow for ever at 1e-9 of its slope. Tension follows the laws as they are.

use crate::{
    Derived, PressureLaw,
    law::LARGEST_TENSION,
    pressure::{ROELANDS_PER_PASCAL, RoelandsState},
};

/// Positive nodes of the ten-point Gauss-Legendre rule on -1 to 1, with their weights.
const GAUSS: [[f64; 2]; 5] = [
    [0.148_874_338_981_631_2, 0.295_524_224_714_752_9],
    [0.433_395_394_129_247_2, 0.269_266_719_309_996_3],
    [0.679_409_568_299_024_4, 0.219_086_362_515_982],
    [0.865_063_366_688_984_5, 0.149_451_349_150_580_6],
    [0.973_906_528_517_171_7, 0.066_671_344_308_688_1],
];
/// Widest panel in t: the integrand changes by less than a factor of 2e5 over one.
const PANEL: f64 = 0.25;
/// Panels up to which the bound is sought; an oil that needs more hardly thickens.
const MOST_PANELS: usize = 4000;
/// Tension after which the laws are flat to round-off, Pa.
const FLAT_TENSION: f64 = 20.0 * LARGEST_TENSION;

impl PressureLaw {
    /// Reduced pressure, Pa, of a gauge pressure (Pa) at a temperature (K); `ambient` is the
    /// viscosity law's value at ambient pressure over the temperature.
    ///
    /// `by_pressure` is `eta0 / eta`.
    #[must_use]
    pub fn reduced_pressure(
        &self,
        ambient: impl Fn(f64) -> Derived,
        temperature_k: f64,
        pressure_pa: f64,
    ) -> Derived {
        if pressure_pa < 0.0 {
            return self.reduced_tension(ambient, temperature_k, pressure_pa);
        }
        match *self {
            Self::Barus { alpha } if alpha > 0.0 => Derived {
                value: -(-alpha * pressure_pa).exp_m1() / alpha,
                by_temperature: 0.0,
                by_pressure: (-alpha * pressure_pa).exp(),
            },
            Self::None | Self::Barus { .. } => Derived {
                value: pressure_pa,
                by_temperature: 0.0,
                by_pressure: 1.0,
            },
            Self::Roelands { .. } => {
                let eta0 = self.at_ambient(&ambient, temperature_k);
                let state = self.roelands(&ambient, eta0, temperature_k);
                let end = (ROELANDS_PER_PASCAL * pressure_pa).ln_1p();
                let panels = (end / PANEL).ceil().clamp(1.0, MOST_PANELS as f64);
                let (mut value, mut by_temperature) = (0.0, 0.0);
                let mut panel = 0.0;
                while panel < panels {
                    let bounds = [panel, panel + 1.0].map(|at| at * end / panels);
                    let part = roelands_panel(&state, bounds);
                    value += part[0];
                    by_temperature += part[1];
                    panel += 1.0;
                }
                Derived {
                    value,
                    by_temperature,
                    by_pressure: (-state.exponent(end)[0]).exp(),
                }
            }
        }
    }

    /// Bound of the reduced pressure, Pa, at a temperature (K): infinite for an oil that does not
    /// thicken. The isoviscous pressure of a rigid film has to stay below it.
    #[must_use]
    pub fn limiting_reduced_pressure(
        &self,
        ambient: impl Fn(f64) -> Derived,
        temperature_k: f64,
    ) -> f64 {
        match *self {
            Self::Barus { alpha } if alpha > 0.0 => 1.0 / alpha,
            Self::Roelands { alpha, .. } if alpha > 0.0 => {
                let eta0 = self.at_ambient(&ambient, temperature_k);
                let state = self.roelands(&ambient, eta0, temperature_k);
                let mut bound = 0.0;
                for panel in 0..MOST_PANELS {
                    let start = panel as f64 * PANEL;
                    let part = roelands_panel(&state, [start, start + PANEL])[0];
                    bound += part;
                    // the integrand grows while dx/dt < 1
                    let falls = state.exponent(start)[1] > 1.0;
                    if falls && part <= 1e-17 * bound {
                        return bound;
                    }
                }
                f64::INFINITY
            }
            _ => f64::INFINITY,
        }
    }

    /// Reduced pressure of a tension, from the laws as they are there.
    fn reduced_tension(
        &self,
        ambient: impl Fn(f64) -> Derived,
        temperature_k: f64,
        pressure_pa: f64,
    ) -> Derived {
        let eta0 = self.at_ambient(&ambient, temperature_k);
        let thinning = |p: f64| {
            let eta = self.at(&ambient, temperature_k, p);
            let ratio = eta0.value / eta.value;
            [
                ratio,
                ratio * (eta0.by_temperature / eta0.value - eta.by_temperature / eta.value),
            ]
        };
        let start = pressure_pa.max(-FLAT_TENSION);
        let flat = pressure_pa - start;
        let panels = (-start / (0.5 * LARGEST_TENSION)).ceil().max(1.0);
        let [ratio, ratio_by_temperature] = thinning(start);
        let (mut value, mut by_temperature) = (flat * ratio, flat * ratio_by_temperature);
        let mut panel = 0.0;
        while panel < panels {
            let bounds = [panel + 1.0, panel].map(|at| at * start / panels);
            let part = gauss(bounds, thinning);
            value -= part[0];
            by_temperature -= part[1];
            panel += 1.0;
        }
        Derived {
            value,
            by_temperature,
            by_pressure: ratio,
        }
    }
}

/// Part of Roelands' reduced pressure between two values of t, Pa, and its derivative, Pa/K.
fn roelands_panel(state: &RoelandsState, bounds: [f64; 2]) -> [f64; 2] {
    gauss(bounds, |t| {
        let [x, _, x_by_temperature] = state.exponent(t);
        let integrand = (t - x).exp() / ROELANDS_PER_PASCAL;
        if integrand > 0.0 {
            [integrand, -integrand * x_by_temperature]
        } else {
            [0.0, 0.0]
        }
    })
}

/// Integral of a pair of functions by ten Gauss points.
fn gauss(bounds: [f64; 2], of: impl Fn(f64) -> [f64; 2]) -> [f64; 2] {
    let (centre, half) = (0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[1] - bounds[0]));
    let mut sum = [0.0; 2];
    for [node, weight] in GAUSS {
        for at in [centre - half * node, centre + half * node] {
            let value = of(at);
            sum[0] += weight * half * value[0];
            sum[1] += weight * half * value[1];
        }
    }
    sum
}
