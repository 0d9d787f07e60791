//! How high is the pressure where the oil stiffens under it?
//!
//! With the reduced pressure
//! ```text
//! q(p) = int_0^p (eta_0/eta)(rho/rho_0) dp'
//! ```
//! the Reynolds equation of a rigid film at one temperature is that of constant viscosity, in q: the film
//! is solved for q, and p follows cell by cell. q is bounded (Barus: 1/alpha). Where the film asks for
//! more, it has no solution: the load would have to be carried by an oil that has become a solid.
//! H. Blok's and A. Cameron's reduced pressure (Cameron, Principles of Lubrication, Longmans 1966).
//!
//! The inverse is tabulated over `s = -ln(1 - q/q_limit)`, in which it is nearly straight (with Barus it is
//! straight: `p = s/alpha`), as cubics with exact slopes: value and derivative agree, so that Newton
//! iterations do. Pressures below zero, which only a closure that cuts them has, are those of constant
//! viscosity.

use sommerfeld_oil::Lubricant;

/// Intervals of the table and its reach in s: up to `1 - exp(-16)` of the limit. Oil laws are
/// followed to viscosities of `exp(20)` times the ambient one.
const INTERVALS: usize = 800;
const REACH: f64 = 16.0;
/// Fluidity behind which the rest of the integral is that of an exponential.
const LAST: f64 = 1e-8;

/// Gauss-Legendre points and weights on (0, 1), eight of them.
const GAUSS: [(f64, f64); 8] = [
    (0.019_855_071_751_231_856, 0.050_614_268_145_188_13),
    (0.101_666_761_293_186_64, 0.111_190_517_226_687_24),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_64),
    (0.408_282_678_752_175_1, 0.181_341_891_689_180_98),
    (0.591_717_321_247_825, 0.181_341_891_689_180_98),
    (0.762_766_204_958_164_5, 0.156_853_322_938_943_64),
    (0.898_333_238_706_813_4, 0.111_190_517_226_687_24),
    (0.980_144_928_248_768_1, 0.050_614_268_145_188_13),
];

/// The relation between pressure and reduced pressure of an oil at a temperature.
#[derive(Debug, Clone, PartialEq)]
pub enum ReducedPressure {
    /// Neither viscosity nor density depends on the pressure: both are one.
    Same,
    /// Tabulated.
    Table(Table),
}

/// The tabulated inverse.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Pa.
    limit: f64,
    /// Pressure (Pa) and its slope over s at equal steps of s.
    nodes: Vec<[f64; 2]>,
}

impl ReducedPressure {
    /// Of `oil` at a temperature (K).
    #[must_use]
    pub fn of(oil: &Lubricant, temperature: f64) -> Self {
        let law = Fluidity::of(oil, temperature);
        let probe = 1e8;
        if law.at(probe) == 1.0 {
            return Self::Same;
        }
        Table::of(&law).map_or(Self::Same, Self::Table)
    }

    /// The reduced pressure that no film exceeds, Pa.
    #[must_use]
    pub fn limit(&self) -> f64 {
        match self {
            Self::Same => f64::INFINITY,
            Self::Table(table) => table.limit,
        }
    }

    /// Pressure (Pa) and its derivative by the reduced pressure `reduced` (Pa); `None` at the limit and
    /// beyond.
    #[must_use]
    pub fn pressure(&self, reduced: f64) -> Option<(f64, f64)> {
        match self {
            Self::Same => Some((reduced, 1.0)),
            Self::Table(_) if reduced <= 0.0 => Some((reduced, 1.0)),
            Self::Table(table) => table.pressure(reduced),
        }
    }

    /// Relative derivative of that derivative, 1/Pa: how fast the oil stiffens. Zero without pressure, and at
    /// the limit and beyond.
    #[must_use]
    pub fn stiffening(&self, reduced: f64) -> f64 {
        match self {
            Self::Table(table) if reduced > 0.0 => table.stiffening(reduced),
            _ => 0.0,
        }
    }

    /// The last pressure (Pa) of the table with its slope: what a film beyond the limit is given until it
    /// has settled.
    #[must_use]
    pub fn highest(&self) -> (f64, f64) {
        match self {
            Self::Same => (f64::MAX, 1.0),
            Self::Table(table) => table.highest(),
        }
    }

    /// Reduced pressure (Pa) of a pressure (Pa), by the same cubics.
    #[must_use]
    pub fn reduced(&self, pressure: f64) -> f64 {
        match self {
            Self::Table(table) if pressure > 0.0 => table.reduced(pressure),
            _ => pressure,
        }
    }
}

/// `(eta_0/eta)(rho/rho_0)` of an oil over pressure.
struct Fluidity<'a> {
    oil: &'a Lubricant,
    temperature: f64,
    viscosity: f64,
    density: f64,
}

impl<'a> Fluidity<'a> {
    fn of(oil: &'a Lubricant, temperature: f64) -> Self {
        Self {
            oil,
            temperature,
            viscosity: oil.viscosity(temperature, 0.0).value,
            density: oil.density(temperature, 0.0).value,
        }
    }

    fn at(&self, pressure: f64) -> f64 {
        let viscosity = self.oil.viscosity(self.temperature, pressure).value;
        let density = self.oil.density(self.temperature, pressure).value;
        self.viscosity / viscosity * (density / self.density)
    }

    fn integral(&self, from: f64, to: f64) -> f64 {
        let length = to - from;
        GAUSS
            .iter()
            .map(|(place, weight)| weight * length * self.at(from + place * length))
            .sum()
    }
}

impl Table {
    /// `None` where the integral has no bound within any pressure: a viscosity that does not rise.
    fn of(law: &Fluidity<'_>) -> Option<Self> {
        let limit = Self::limit_of(law)?;
        let step = REACH / INTERVALS as f64;
        let mut nodes = Vec::with_capacity(INTERVALS + 1);
        let (mut pressure, mut reduced) = (0.0, 0.0);
        for index in 0..=INTERVALS {
            let s = step * index as f64;
            // What is left below the limit, without the cancellation of a difference.
            let left = limit * (-s).exp();
            let target = limit - left;
            for _ in 0..60 {
                let fluidity = law.at(pressure);
                let missing = target - reduced;
                let next = pressure + missing / fluidity;
                if !next.is_finite() {
                    return None;
                }
                let moved = next - pressure;
                reduced += law.integral(pressure, next);
                pressure = next;
                if moved.abs() <= 1e-13 * (pressure + 1e5) {
                    break;
                }
            }
            let slope = left / law.at(pressure);
            if !slope.is_finite() || index > 0 && slope <= 0.0 {
                return None;
            }
            nodes.push([pressure, slope]);
        }
        Some(Self { limit, nodes })
    }

    /// `q` of an infinite pressure: sums pieces over which the viscosity rises by about a quarter of e.
    fn limit_of(law: &Fluidity<'_>) -> Option<f64> {
        let (mut pressure, mut sum) = (0.0_f64, 0.0_f64);
        for _ in 0..2000 {
            let here = law.at(pressure);
            let probe = 1e6 + 1e-3 * pressure;
            let fall = (here / law.at(pressure + probe)).ln();
            if fall.is_nan() || fall <= 0.0 {
                return None;
            }
            let length = (0.25 * probe / fall).max(1e5);
            if here <= LAST {
                return Some(sum + here * probe / fall);
            }
            sum += law.integral(pressure, pressure + length);
            pressure += length;
            if !sum.is_finite() || pressure > 1e13 {
                return None;
            }
        }
        None
    }

    fn pressure(&self, reduced: f64) -> Option<(f64, f64)> {
        let left = 1.0 - reduced / self.limit;
        if left <= 0.0 {
            return None;
        }
        let step = REACH / INTERVALS as f64;
        let place = -left.ln() / step;
        let index = place as usize;
        if index >= INTERVALS {
            return None;
        }
        let (value, slope) = self.cubic(index, place - index as f64);
        Some((value, slope / (left * self.limit)))
    }

    /// With `s = -ln(1 - q/q_limit)`: `p'' / p' = ds/dq (1 + p_ss/p_s)`.
    fn stiffening(&self, reduced: f64) -> f64 {
        let left = 1.0 - reduced / self.limit;
        let step = REACH / INTERVALS as f64;
        let place = -left.ln() / step;
        let index = place as usize;
        if left <= 0.0 || index >= INTERVALS {
            return 0.0;
        }
        let ([from, out], [to, into]) = (self.nodes[index], self.nodes[index + 1]);
        let (t, rise) = (place - index as f64, to - from);
        let (out, into) = (step * out, step * into);
        let curve = 3.0 * rise - 2.0 * out - into;
        let twist = out + into - 2.0 * rise;
        let slope = out + t * (2.0 * curve + 3.0 * t * twist);
        let bend = 2.0 * curve + 6.0 * t * twist;
        (1.0 + bend / (step * slope)) / (left * self.limit)
    }

    fn highest(&self) -> (f64, f64) {
        // Far enough from the end that the slope is that of a film that still flows.
        let place = 0.25 * INTERVALS as f64;
        let (value, slope) = self.cubic(place as usize, 0.0);
        let left = (-0.25 * REACH).exp();
        (value, slope / (left * self.limit))
    }

    /// Pressure and its slope by s in an interval, at a share `t` of it.
    fn cubic(&self, index: usize, t: f64) -> (f64, f64) {
        let step = REACH / INTERVALS as f64;
        let ([from, out], [to, into]) = (self.nodes[index], self.nodes[index + 1]);
        let rise = to - from;
        let (out, into) = (step * out, step * into);
        let curve = 3.0 * rise - 2.0 * out - into;
        let twist = out + into - 2.0 * rise;
        let value = from + t * (out + t * (curve + t * twist));
        let slope = out + t * (2.0 * curve + 3.0 * t * twist);
        (value, slope / step)
    }

    fn reduced(&self, pressure: f64) -> f64 {
        let index = self.nodes.partition_point(|node| node[0] <= pressure);
        let index = index.saturating_sub(1).min(INTERVALS - 1);
        let step = REACH / INTERVALS as f64;
        let (from, to) = (self.nodes[index][0], self.nodes[index + 1][0]);
        let mut t = ((pressure - from) / (to - from)).min(1.0);
        for _ in 0..20 {
            let (value, slope) = self.cubic(index, t);
            let change = (pressure - value) / (slope * step);
            t += change;
            if change.abs() <= 1e-15 {
                break;
            }
        }
        -self.limit * (-step * (index as f64 + t)).exp_m1()
    }
}
