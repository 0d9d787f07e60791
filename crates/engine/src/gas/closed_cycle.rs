//! The gas while the valves are closed: the integration behind `combustion`.
//!
//! Question: which pressure follows from the first law, and how exact is it?
//!
//! Unknowns over the crank angle: pressure, heat to the walls, work. The heat released is known in closed
//! form. The internal energy is not integrated: that it balances the others checks the integration.
//!
//! Method: Runge-Kutta of order 4 on a mesh of the angles asked for and of angles graded towards every
//! beginning of burning, where the rate has a kink; its intervals are halved until the pressures of two
//! solutions differ by less than 15 times the tolerance (Richardson).

use crate::{
    Chamber, CombustionError, CycleScales, GasExchange, GasInstant, HeatRatio, HeatRelease,
    WallHeat,
};
use sommerfeld_film::Outcome;

/// Relative error of the pressures at which halving stops.
const TOLERANCE: f64 = 1e-9;
/// Most halvings of the mesh.
const HALVINGS: u32 = 9;
/// Angles of the mesh over the duration of a Wiebe function, graded by their square.
const BURNING_STEPS: usize = 48;
/// Widest interval of the mesh, rad.
const WIDEST: f64 = 0.04;
/// Difference of two solutions over the error of the finer one, for order 4.
const RICHARDSON: f64 = 15.0;

/// A state on the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct State {
    /// Crank angle from firing, rad.
    pub(crate) angle: f64,
    /// Pa.
    pub(crate) pressure: f64,
    wall_heat: f64,
    work: f64,
}

/// What decides a closed cycle.
pub(crate) struct ClosedGas<'c> {
    pub(crate) chamber: &'c Chamber,
    pub(crate) exchange: &'c GasExchange,
    pub(crate) release: &'c HeatRelease,
    pub(crate) ratio: HeatRatio,
    pub(crate) walls: WallHeat,
    /// rad/s
    pub(crate) speed: f64,
}

/// The equations of one closed cycle.
pub(crate) struct ClosedCycle<'c> {
    gas: ClosedGas<'c>,
    /// m R, J/K
    charge: f64,
    scales: CycleScales,
    /// Volume and ratio of specific heats at the closing of the intake: the motored cycle.
    motored: [f64; 2],
    burning_from: f64,
}

/// What the closed cycle gave.
pub(crate) struct Closed {
    /// At the angles asked for, and at both ends.
    pub(crate) states: Vec<State>,
    pub(crate) peak: [f64; 2],
    pub(crate) highest_temperature: f64,
    pub(crate) heat_released: f64,
    pub(crate) internal_energy_change: f64,
    pub(crate) charge: f64,
    pub(crate) error: f64,
    pub(crate) outcome: Outcome,
}

impl Closed {
    pub(crate) fn last(&self) -> Option<&State> {
        self.states.last()
    }

    pub(crate) fn wall_heat(&self) -> f64 {
        self.last().map_or(0.0, |state| state.wall_heat)
    }

    pub(crate) fn work(&self) -> f64 {
        self.last().map_or(0.0, |state| state.work)
    }
}

impl<'c> ClosedCycle<'c> {
    pub(crate) fn new(gas: ClosedGas<'c>) -> Self {
        let (chamber, exchange) = (gas.chamber, gas.exchange);
        let volume = chamber.volume(exchange.intake_closes);
        let (pressure, temperature) = (exchange.intake_pressure, exchange.intake_temperature);
        let charge = pressure * volume / temperature;
        let scales = CycleScales {
            bore: chamber.bore,
            piston_speed: chamber.stroke() * gas.speed / std::f64::consts::PI,
            reference: chamber.swept_volume() / charge,
        };
        Self {
            charge,
            scales,
            motored: [volume, gas.ratio.at(temperature)],
            burning_from: gas.release.start(),
            gas,
        }
    }

    /// Solves for the states at the angles, ascending, between closing of the intake and opening of the
    /// exhaust.
    pub(crate) fn solve(&self, angles: &[f64]) -> Result<Closed, CombustionError> {
        let mesh = self.mesh(angles);
        let mut coarse = self.march(&mesh, 1)?;
        let (mut error, mut outcome) = (f64::INFINITY, Outcome::NotConverged);
        for halving in 1..=HALVINGS {
            let fine = self.march(&mesh, 1 << halving)?;
            error = difference(&coarse, &fine) / RICHARDSON;
            coarse = fine;
            if error <= TOLERANCE {
                outcome = Outcome::Converged;
                break;
            }
        }
        Ok(self.gathered(coarse, angles, error, outcome))
    }

    fn gathered(&self, all: Vec<State>, angles: &[f64], error: f64, outcome: Outcome) -> Closed {
        let exchange = self.gas.exchange;
        let (from, to) = (exchange.intake_closes, exchange.exhaust_opens);
        let release = self.gas.release;
        let temperature = |state: &State| self.temperature(state.angle, state.pressure);
        let energy = |state: Option<&State>| {
            state.map_or(f64::NAN, |state| {
                self.charge * self.gas.ratio.internal_energy(temperature(state))
            })
        };
        let internal_energy_change = energy(all.last()) - energy(all.first());
        let highest_temperature = all.iter().map(temperature).fold(0.0, f64::max);
        let peak = self.peak(&all);
        let is_asked = |angle: f64| angles.binary_search_by(|at| at.total_cmp(&angle)).is_ok();
        let mut states = all;
        states.retain(|state| state.angle == from || state.angle == to || is_asked(state.angle));
        Closed {
            states,
            peak,
            highest_temperature,
            heat_released: release.released(to) - release.released(from),
            internal_energy_change,
            charge: self.charge,
            error,
            outcome,
        }
    }

    /// Angles of the mesh, ascending: those asked for, both ends, and the burning.
    fn mesh(&self, angles: &[f64]) -> Vec<f64> {
        let exchange = self.gas.exchange;
        let (from, to) = (exchange.intake_closes, exchange.exhaust_opens);
        let mut mesh = vec![from, to];
        mesh.extend_from_slice(angles);
        for (_, part) in &self.gas.release.parts {
            mesh.extend((0..=2 * BURNING_STEPS).map(|index| {
                let way = index as f64 / BURNING_STEPS as f64;
                part.start + part.duration * way * way
            }));
        }
        let count = ((to - from) / WIDEST).ceil();
        mesh.extend((1..count as usize).map(|index| from + (to - from) * index as f64 / count));
        mesh.retain(|angle| *angle >= from && *angle <= to);
        mesh.sort_by(f64::total_cmp);
        mesh.dedup();
        mesh
    }

    /// States on the mesh with `parts` steps in each interval.
    fn march(&self, mesh: &[f64], parts: u32) -> Result<Vec<State>, CombustionError> {
        let mut state = [self.gas.exchange.intake_pressure, 0.0, 0.0];
        let mut states = Vec::with_capacity(mesh.len());
        for (index, &angle) in mesh.iter().enumerate() {
            if let Some(before) = index.checked_sub(1).and_then(|at| mesh.get(at)) {
                let step = (angle - before) / f64::from(parts);
                for part in 0..parts {
                    state = self.step(before + f64::from(part) * step, step, state);
                }
            }
            let [pressure, wall_heat, work] = state;
            if !(pressure > 0.0 && pressure.is_finite()) {
                return Err(CombustionError::NoState { angle });
            }
            states.push(State {
                angle,
                pressure,
                wall_heat,
                work,
            });
        }
        Ok(states)
    }

    /// One step of the classical Runge-Kutta method.
    fn step(&self, angle: f64, step: f64, state: [f64; 3]) -> [f64; 3] {
        let ahead =
            |rate: [f64; 3], by: f64| std::array::from_fn(|index| state[index] + by * rate[index]);
        let half = 0.5 * step;
        let k1 = self.rates(angle, state);
        let k2 = self.rates(angle + half, ahead(k1, half));
        let k3 = self.rates(angle + half, ahead(k2, half));
        let k4 = self.rates(angle + step, ahead(k3, step));
        std::array::from_fn(|i| state[i] + step / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
    }

    /// Rates of pressure, wall heat and work with the crank angle.
    fn rates(&self, angle: f64, [pressure, ..]: [f64; 3]) -> [f64; 3] {
        let chamber = self.gas.chamber;
        let (volume, volume_rate) = (chamber.volume(angle), chamber.volume_rate(angle));
        let temperature = pressure * volume / self.charge;
        let ratio = self.gas.ratio.at(temperature);
        let wall_heat = self.wall_heat_rate(angle, pressure, volume);
        let heat = self.gas.release.rate(angle) - wall_heat;
        let work = pressure * volume_rate;
        [
            ((ratio - 1.0) * heat - ratio * work) / volume,
            wall_heat,
            work,
        ]
    }

    fn wall_heat_rate(&self, angle: f64, pressure: f64, volume: f64) -> f64 {
        let WallHeat::Woschni(woschni) = &self.gas.walls else {
            return 0.0;
        };
        let [start, ratio] = self.motored;
        let motored = self.gas.exchange.intake_pressure * (start / volume).powf(ratio);
        let burns = angle > self.burning_from;
        let gas = GasInstant {
            pressure,
            temperature: pressure * volume / self.charge,
            excess_pressure: if burns {
                (pressure - motored).max(0.0)
            } else {
                0.0
            },
        };
        let driving = woschni.driving(self.gas.chamber, angle, gas.temperature);
        woschni.coefficient(&gas, &self.scales) * driving / self.gas.speed
    }

    fn temperature(&self, angle: f64, pressure: f64) -> f64 {
        pressure * self.gas.chamber.volume(angle) / self.charge
    }

    /// Highest pressure: on the cubic through two states and their slopes where the slope changes sign,
    /// else the highest state.
    fn peak(&self, states: &[State]) -> [f64; 2] {
        let highest = states
            .iter()
            .enumerate()
            .max_by(|a, b| a.1.pressure.total_cmp(&b.1.pressure));
        let Some((at, top)) = highest else {
            return [f64::NAN; 2];
        };
        let slope = |state: &State| self.rates(state.angle, [state.pressure, 0.0, 0.0])[0];
        let neighbour = if slope(top) > 0.0 {
            Some(at + 1)
        } else {
            at.checked_sub(1)
        };
        let Some(other) = neighbour.and_then(|index| states.get(index)) else {
            return [top.angle, top.pressure];
        };
        let (a, b) = if other.angle > top.angle {
            (top, other)
        } else {
            (other, top)
        };
        let width = b.angle - a.angle;
        let (m, n) = (width * slope(a), width * slope(b));
        if !(m > 0.0 && n < 0.0) {
            return [top.angle, top.pressure];
        }
        // Slope of the Hermite cubic: m + 2 c2 t + 3 c3 t^2, one sign change in (0, 1).
        let rise = b.pressure - a.pressure;
        let (c2, c3) = (3.0 * rise - 2.0 * m - n, m + n - 2.0 * rise);
        let root = (c2 * c2 - 3.0 * c3 * m).max(0.0).sqrt();
        // The root in (0, 1) with a falling slope, in the form that does not cancel.
        let t = m / (root - c2);
        if !(t > 0.0 && t < 1.0) {
            return [top.angle, top.pressure];
        }
        [
            a.angle + t * width,
            a.pressure + t * (m + t * (c2 + t * c3)),
        ]
    }
}

/// Largest relative difference of the pressures of two solutions.
fn difference(coarse: &[State], fine: &[State]) -> f64 {
    let pairs = coarse.iter().zip(fine);
    pairs
        .map(|(a, b)| (a.pressure / b.pressure - 1.0).abs())
        .fold(0.0, f64::max)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{Wiebe, Woschni};

    #[test]
    fn pressures_converge_with_the_fourth_order() {
        let chamber = Chamber {
            bore: 0.086,
            crank_radius: 0.043,
            rod_length: 0.145,
            pin_offset: 0.0,
            compression_ratio: 10.0,
        };
        let exchange = GasExchange {
            intake_closes: -2.5,
            exhaust_opens: 2.5,
            intake_pressure: 1e5,
            intake_temperature: 350.0,
            exhaust_pressure: 1e5,
            blow_down: 1.0,
            overlap: 0.3,
        };
        let wiebe = Wiebe {
            start: -0.3,
            duration: 0.9,
            efficiency: 5.0,
            exponent: 4.0,
        };
        let release = HeatRelease::single(1200.0, wiebe);
        let walls = WallHeat::Woschni(Woschni {
            swirl: 0.0,
            // Without the term that begins with a kink where the gas outdoes the motored pressure.
            combustion: 0.0,
            head_temperature: 500.0,
            piston_temperature: 520.0,
            liner_temperature: 400.0,
            head_area_ratio: 1.0,
            piston_area_ratio: 1.0,
        });
        let cycle = ClosedCycle::new(ClosedGas {
            chamber: &chamber,
            exchange: &exchange,
            release: &release,
            ratio: HeatRatio::Constant(1.33),
            walls,
            speed: 300.0,
        });
        let mesh: Vec<f64> = (0..=50)
            .map(|index| -2.5 + 0.1 * f64::from(index))
            .collect();
        let solutions = [1, 2, 4, 8].map(|parts| cycle.march(&mesh, parts).unwrap());
        let [a, b, c] = [0, 1, 2].map(|at| difference(&solutions[at], &solutions[at + 1]));
        let orders = [(a / b).log2(), (b / c).log2()];
        assert!(
            orders.iter().all(|order| (3.7..4.5).contains(order)),
            "{orders:?}"
        );
    }
}
