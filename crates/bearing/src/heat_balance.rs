//! At which one temperature does the whole film run?
//!
//! Equation: what the film makes of power leaves with the oil at the sides and by conduction,
//! ```text
//! P(T) = rho c Q(T) (T_out - T_in) + k (T - T_surroundings),     T = T_in + w (T_out - T_in)
//! ```
//! Unknown: the effective temperature T, K, at which viscosity and warm clearance are taken; w is 1/2
//! where the film's mean temperature is the mean of inlet and outlet. Power and flow come from a
//! solution of the bearing at T: an equilibrium, or the means of a load cycle, whose temperature settles
//! over many cycles and does not follow one.
//! Method: the imbalance falls with T, because power does and what leaves rises; secant steps inside a
//! bracket, one solution each.
//! Reference: ISO 7902-1 (heat balance of plain bearings).

use serde::{Deserialize, Serialize};
use sommerfeld_film::Outcome;

/// How heat leaves the bearing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeatPath {
    /// Temperature of the oil that is supplied, K.
    pub supply_temperature: f64,
    /// Heat conducted per difference to the surroundings, W/K; 0 if the oil carries all.
    pub conductance: f64,
    /// Temperature of the surroundings, K.
    pub surroundings_temperature: f64,
    /// Weight of the outlet in the effective temperature; 1/2: the mean of inlet and outlet.
    pub outlet_weight: f64,
}

/// What a solution of the bearing at one temperature says of heat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmHeat {
    /// Power lost in the film, W.
    pub power: f64,
    /// Oil that leaves at the sides, m3/s.
    pub side_flow: f64,
    /// Heat capacity of the oil by volume, J/(m3 K).
    pub volumetric_heat: f64,
    /// How the solution ended.
    pub outcome: Outcome,
}

/// One trial of the balance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeatTrial {
    /// Effective temperature, K.
    pub temperature: f64,
    /// Temperature that the heat of this film leads to, less the one it was taken at, K.
    pub imbalance: f64,
}

/// The bearing at the temperature that its heat leads to.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatBalanced<S> {
    /// Effective temperature, K.
    pub effective_temperature: f64,
    /// Temperature of the oil that leaves, K.
    pub outlet_temperature: f64,
    /// Heat that the oil carries away and that is conducted, W.
    pub carried: f64,
    /// See `carried`.
    pub conducted: f64,
    /// The solution at the effective temperature.
    pub solution: S,
    /// Every trial.
    pub trials: Vec<HeatTrial>,
    /// How it ended: [`Outcome::NotConverged`] also where nothing carries the heat away within the range.
    pub outcome: Outcome,
}

/// The balance holds to this difference, K.
const TOLERANCE: f64 = 1e-6;
/// Trials at most.
const TRIALS: usize = 40;

impl HeatPath {
    /// Effective temperature (K) that a film's heat leads to, if it is taken at `temperature`.
    fn led_to(&self, heat: &FilmHeat, temperature: f64) -> f64 {
        let conducted = self.conducted(temperature);
        let carrying = heat.volumetric_heat * heat.side_flow;
        self.supply_temperature + self.outlet_weight * (heat.power - conducted) / carrying
    }

    /// Heat conducted away from a film at a temperature (K), W.
    #[must_use]
    pub fn conducted(&self, temperature: f64) -> f64 {
        self.conductance * (temperature - self.surroundings_temperature)
    }

    /// Imbalance in K, finite also where no oil leaves: power that is left over what would carry it.
    #[must_use]
    pub fn imbalance(&self, heat: &FilmHeat, temperature: f64) -> f64 {
        let carrying = heat.volumetric_heat * heat.side_flow / self.outlet_weight;
        let left = heat.power
            - self.conducted(temperature)
            - carrying * (temperature - self.supply_temperature);
        left / (carrying + self.conductance).max(f64::MIN_POSITIVE)
    }

    /// Finds the effective temperature within `range` (K), where `solve` gives the bearing's solution and
    /// its heat at a temperature (K).
    ///
    /// # Errors
    /// Those of `solve`.
    pub fn balance<S, E>(
        &self,
        range: [f64; 2],
        mut solve: impl FnMut(f64) -> Result<(S, FilmHeat), E>,
    ) -> Result<HeatBalanced<S>, E> {
        let mut trials: Vec<HeatTrial> = Vec::new();
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let first = self.supply_temperature.clamp(range[0], range[1]);
        let mut temperature = first;
        loop {
            let (solution, heat) = solve(temperature)?;
            let imbalance = self.imbalance(&heat, temperature);
            trials.push(HeatTrial {
                temperature,
                imbalance,
            });
            let solved = heat.outcome == Outcome::Converged && imbalance.is_finite();
            let at_end = (temperature >= range[1] && imbalance > 0.0)
                || (temperature <= range[0] && imbalance < 0.0);
            let balanced = imbalance.abs() <= TOLERANCE || high - low <= 1e-9;
            if !solved || at_end || balanced || trials.len() >= TRIALS {
                let outcome = match heat.outcome {
                    Outcome::Converged if !balanced || !solved => Outcome::NotConverged,
                    outcome => outcome,
                };
                return Ok(self.balanced(solution, &heat, temperature, trials, outcome));
            }
            if imbalance > 0.0 {
                low = temperature;
            } else {
                high = temperature;
            }
            temperature = next_trial(&trials, [low, high], range);
        }
    }

    fn balanced<S>(
        &self,
        solution: S,
        heat: &FilmHeat,
        temperature: f64,
        trials: Vec<HeatTrial>,
        outcome: Outcome,
    ) -> HeatBalanced<S> {
        let conducted = self.conducted(temperature);
        let led_to = self.led_to(heat, temperature);
        HeatBalanced {
            effective_temperature: temperature,
            outlet_temperature: self.supply_temperature
                + (led_to - self.supply_temperature) / self.outlet_weight,
            carried: heat.power - conducted,
            conducted,
            solution,
            trials,
            outcome,
        }
    }
}

/// The temperatures of several films that answer each other, as on one shaft: each film's step follows
/// its own imbalance, by the slope of its last two trials within what a film can have.
#[derive(Debug, Clone, PartialEq)]
pub struct JointBalance {
    path: HeatPath,
    range: [f64; 2],
    trials: Vec<HeatTrial>,
    temperature: f64,
}

impl JointBalance {
    /// Slopes of the imbalance by the temperature: -1 with a power that does not change, steeper where a
    /// warmer film makes less heat.
    const SLOPES: [f64; 2] = [-6.0, -1.0];
    /// The first guess of it.
    const FIRST_SLOPE: f64 = -2.0;

    /// Of one film, at the temperature of its supply, within `range` (K).
    #[must_use]
    pub fn new(path: HeatPath, range: [f64; 2]) -> Self {
        let temperature = path.supply_temperature.clamp(range[0], range[1]);
        Self {
            path,
            range,
            trials: Vec::new(),
            temperature,
        }
    }

    /// Temperature at which the film is to be looked at next, K.
    #[must_use]
    pub fn temperature(&self) -> f64 {
        self.temperature
    }

    /// Trials so far.
    #[must_use]
    pub fn trials(&self) -> &[HeatTrial] {
        &self.trials
    }

    /// Takes the heat of the film at its temperature, and moves it by less than `settled` (K) once it has
    /// settled: then it stays and `true` comes back. An end of the range that the heat leads beyond is
    /// none: see [`JointBalance::is_at_end`].
    pub fn take(&mut self, heat: &FilmHeat, settled: f64) -> bool {
        let imbalance = self.path.imbalance(heat, self.temperature);
        self.trials.push(HeatTrial {
            temperature: self.temperature,
            imbalance,
        });
        if !imbalance.is_finite() {
            return true;
        }
        let [steepest, flattest] = Self::SLOPES;
        let slope = match self.trials.as_slice() {
            [.., a, b] if a.temperature != b.temperature => {
                let found = (b.imbalance - a.imbalance) / (b.temperature - a.temperature);
                found.clamp(steepest, flattest)
            }
            _ => Self::FIRST_SLOPE,
        };
        let next = (self.temperature - imbalance / slope).clamp(self.range[0], self.range[1]);
        if (next - self.temperature).abs() <= settled {
            return true;
        }
        self.temperature = next;
        false
    }

    /// The heat leads beyond the range of temperatures.
    #[must_use]
    pub fn is_at_end(&self) -> bool {
        let [low, high] = self.range;
        self.trials.last().is_some_and(|last| {
            (last.temperature >= high && last.imbalance > 0.0)
                || (last.temperature <= low && last.imbalance < 0.0)
        })
    }

    /// Temperature of the oil that leaves, K.
    #[must_use]
    pub fn outlet_temperature(&self) -> f64 {
        let supply = self.path.supply_temperature;
        supply + (self.temperature - supply) / self.path.outlet_weight
    }

    /// Heat conducted away, W.
    #[must_use]
    pub fn conducted(&self) -> f64 {
        self.path.conducted(self.temperature)
    }
}

/// Secant through the last two trials, kept inside the bracket.
fn next_trial(trials: &[HeatTrial], [low, high]: [f64; 2], range: [f64; 2]) -> f64 {
    let secant = match trials {
        [.., a, b] => {
            let slope = (b.imbalance - a.imbalance) / (b.temperature - a.temperature);
            b.temperature - b.imbalance / slope
        }
        // A warmer film makes less heat: half of what this one would lead to.
        [first] => first.temperature + 0.5 * first.imbalance,
        [] => range[0],
    };
    let is_inside = secant > low && secant < high;
    if low.is_finite() && high.is_finite() && !is_inside {
        0.5 * (low + high)
    } else if is_inside {
        secant.clamp(range[0], range[1])
    } else if low.is_finite() {
        // Without an upper end yet: half of the way to the end of the range.
        0.5 * (low + range[1])
    } else {
        0.5 * (range[0] + high)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]
mod tests {
    use super::*;
    use std::convert::Infallible;

    const OIL: f64 = 1.8e6;

    fn path(conductance: f64) -> HeatPath {
        HeatPath {
            supply_temperature: 330.0,
            conductance,
            surroundings_temperature: 300.0,
            outlet_weight: 0.5,
        }
    }

    /// Petroff's power with a viscosity that falls exponentially, at constant flow.
    fn petroff(temperature: f64) -> (f64, FilmHeat) {
        let power = 2000.0 * (-0.03 * (temperature - 330.0)).exp();
        let heat = FilmHeat {
            power,
            side_flow: 4e-5,
            volumetric_heat: OIL,
            outcome: Outcome::Converged,
        };
        (power, heat)
    }

    #[test]
    fn heat_and_power_agree_at_the_effective_temperature() {
        for conductance in [0.0, 15.0] {
            let path = path(conductance);
            let found = path
                .balance([250.0, 450.0], |t| Ok::<_, Infallible>(petroff(t)))
                .unwrap();
            assert_eq!(found.outcome, Outcome::Converged);
            let rise = found.outlet_temperature - path.supply_temperature;
            assert!((found.effective_temperature - 330.0 - 0.5 * rise).abs() < 2e-6);
            assert!((OIL * 4e-5 * rise - found.carried).abs() < 1e-9 * found.carried);
            assert!((found.carried + found.conducted - found.solution).abs() < 1e-9);
            assert!(found.trials.len() <= 12, "{}", found.trials.len());
        }
    }

    /// No oil leaves and nothing conducts: there is no temperature in the range, and the answer says so.
    #[test]
    fn without_a_way_out_the_heat_has_no_balance() {
        let closed = |t: f64| {
            let (power, heat) = petroff(t);
            Ok::<_, Infallible>((
                power,
                FilmHeat {
                    side_flow: 0.0,
                    ..heat
                },
            ))
        };
        let found = path(0.0).balance([250.0, 450.0], closed).unwrap();
        assert_eq!(found.outcome, Outcome::NotConverged);
        let cooled = path(20.0).balance([250.0, 450.0], closed).unwrap();
        assert_eq!(cooled.outcome, Outcome::Converged);
        assert!((cooled.conducted - cooled.solution).abs() < 1e-3);
    }

    /// Two films of which each makes less heat as it warms, and more as the other does: the temperatures
    /// at which both imbalances vanish, which a linear system gives.
    #[test]
    fn films_that_answer_each_other_are_balanced_together() {
        let path = HeatPath {
            supply_temperature: 360.0,
            conductance: 0.0,
            surroundings_temperature: 360.0,
            outlet_weight: 0.5,
        };
        // w P / (rho c Q) = a - b (T - 360) + c (other - 360), K
        let rises = [[20.0, 1.5, 0.2], [9.0, 0.6, 0.3]];
        let heat = |own: f64, other: f64, [a, b, c]: [f64; 3]| FilmHeat {
            power: 2.0 * (a - b * (own - 360.0) + c * (other - 360.0)),
            side_flow: 1e-6,
            volumetric_heat: 1e6,
            outcome: Outcome::Converged,
        };
        let mut both = [0, 1].map(|_| JointBalance::new(path, [300.0, 500.0]));
        let mut passes = 0;
        loop {
            passes += 1;
            let now = [both[0].temperature(), both[1].temperature()];
            let of_first = both[0].take(&heat(now[0], now[1], rises[0]), 1e-6);
            let of_second = both[1].take(&heat(now[1], now[0], rises[1]), 1e-6);
            if of_first && of_second {
                break;
            }
            assert!(passes < 20);
        }
        // x (1 + b) - c y = a, y (1 + b) - c x = a
        let determinant = 2.5 * 1.6 - 0.2 * 0.3;
        let exact = [
            (20.0 * 1.6 + 0.2 * 9.0) / determinant,
            (9.0 * 2.5 + 0.3 * 20.0) / determinant,
        ];
        for (found, exact) in both.iter().zip(exact) {
            let rise = found.temperature() - 360.0;
            assert!((rise - exact).abs() < 1e-5, "{rise} {exact}");
            assert!((found.outlet_temperature() - 360.0 - 2.0 * exact).abs() < 2e-5);
            assert!(!found.is_at_end());
        }
        // Heat that nothing carries leads to the end of the range.
        let mut stuck = JointBalance::new(path, [300.0, 370.0]);
        while !stuck.take(&heat(stuck.temperature(), 360.0, [50.0, 0.0, 0.0]), 1e-6) {}
        assert!(stuck.is_at_end() && stuck.temperature() == 370.0);
    }
}
