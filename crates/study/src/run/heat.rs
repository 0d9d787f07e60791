//! The temperature that the heat of the film leads to: the bearing at trial temperatures until power
//! and what carries it away agree.
//!
//! A steady film is balanced to 1e-6 K. Of a load cycle the means over the cycle are balanced, to
//! [`CYCLE_TOLERANCE`]: its temperature settles over many cycles and does not follow one. Each trial
//! begins where the one before it ended.

use super::cycle::{is_starved, orbit_settings};
use super::steady::{solve_load, solve_state};
use super::{ProgressCallback, conditions, film_of, header};
use crate::input::{Analysis, BearingCase, CycleDuty, Duty, FilmSettings, Study};
use crate::progress::ProgressEvent;
use crate::results::{Body, Header, HeatResults};
use sommerfeld_bearing::{
    Expansion, FilmHeat, HeatBalanced, HeatPath, OrbitSettings, OrbitStart, journal_orbit,
};
use sommerfeld_film::{FilmError, FilmHistory, JournalState, Outcome};

/// Change of the temperature below which that of a load cycle has settled, K.
pub(super) const CYCLE_TOLERANCE: f64 = 0.05;
/// Temperatures in which the balance is looked for, K, as far as the laws of the oil hold.
const TEMPERATURES: [f64; 2] = [173.15, 773.15];
/// Smallest share of the given clearance that a warm bearing is calculated with.
const LEAST_CLEARANCE: f64 = 0.02;

/// A bearing at the temperature that its heat leads to.
pub(super) struct Warm {
    /// The bearing with its warm clearance, at that temperature.
    pub case: BearingCase,
    results: HeatResults,
    /// How the balance ended.
    outcome: Outcome,
    /// Ends of the range that was looked through, K.
    range: [f64; 2],
}

impl Warm {
    /// Puts the balance into the results, and what went wrong with it.
    pub(super) fn note(self, header: &mut Header) {
        if let Some(failure) = self.failure()
            && header.status == Outcome::Converged
        {
            header.status = self.outcome;
            header.messages.insert(0, failure);
        }
        header.heat = Some(self.results);
    }

    /// What went wrong with the balance.
    pub(super) fn failure(&self) -> Option<String> {
        (self.outcome != Outcome::Converged)
            .then(|| no_balance(self.range, self.results.effective_temperature))
    }

    /// The bearing at its temperature, and how that was found.
    pub(super) fn into_parts(self) -> (BearingCase, HeatResults) {
        (self.case, self.results)
    }
}

/// That no temperature within a range (K) balances the heat of a film, calculated at a last one (K).
pub(super) fn no_balance(range: [f64; 2], last: f64) -> String {
    let celsius = |kelvin: f64| kelvin - 273.15;
    let [low, high] = range.map(celsius);
    format!(
        "the heat of the film finds no balance between {low:.1} and {high:.1} degC, where the laws of \
         the oil hold and the bearing has a clearance: the numbers are those at {:.1} degC; give more \
         supply, a larger conductance or a thinner oil",
        celsius(last)
    )
}

/// Where a balance ended.
struct Balance {
    effective: f64,
    outlet: f64,
    conducted: f64,
    trials: Vec<f64>,
    outcome: Outcome,
}

impl<S> From<HeatBalanced<S>> for Balance {
    fn from(found: HeatBalanced<S>) -> Self {
        Self {
            effective: found.effective_temperature,
            outlet: found.outlet_temperature,
            conducted: found.conducted,
            trials: found.trials.iter().map(|trial| trial.temperature).collect(),
            outcome: found.outcome,
        }
    }
}

/// Finds the temperature at which power and what carries it away agree.
pub(super) fn balanced(
    case: &BearingCase,
    (path, expansion): (&HeatPath, Option<&Expansion>),
    study: &Study,
    progress: &mut ProgressCallback<'_>,
) -> Result<Warm, FilmError> {
    if let Duty::Cycle(duty) = &case.duty {
        return balanced_cycle((case, duty), (path, expansion), &study.film, progress);
    }
    let range = range(case, path.supply_temperature, expansion);
    let balanced: Result<_, FilmError> = path.balance(range, |temperature| {
        let warm = warm_case(case, expansion, temperature);
        steady_heat(&warm, study, progress).map(|heat| ((), heat))
    });
    let found: Balance = balanced?.into();
    Ok(found.into_warm(case, (path, expansion), range))
}

/// [`balanced`] of a load cycle.
pub(super) fn balanced_cycle(
    (case, duty): (&BearingCase, &CycleDuty),
    (path, expansion): (&HeatPath, Option<&Expansion>),
    settings: &FilmSettings,
    progress: &mut ProgressCallback<'_>,
) -> Result<Warm, FilmError> {
    let range = range(case, path.supply_temperature, expansion);
    let trial = CycleTrial {
        case,
        duty,
        expansion,
        settings,
        before: None,
        count: 0,
    };
    let found = trial.balance(path, range, progress)?;
    Ok(found.into_warm(case, (path, expansion), range))
}

impl Balance {
    /// The bearing of a case at the temperature of the balance.
    fn into_warm(
        self,
        case: &BearingCase,
        (path, expansion): (&HeatPath, Option<&Expansion>),
        range: [f64; 2],
    ) -> Warm {
        let warm = warm_case(case, expansion, self.effective);
        Warm {
            results: HeatResults {
                effective_temperature: self.effective,
                supply_temperature: path.supply_temperature,
                outlet_temperature: self.outlet,
                conducted: self.conducted,
                radial_clearance: warm.bearing.radial_clearance,
                given_radial_clearance: case.bearing.radial_clearance,
                trials: self.trials,
                field: None,
            },
            outcome: self.outcome,
            case: warm,
            range,
        }
    }
}

/// Temperatures, K, at which the laws of the oil hold and the bearing has a clearance; `within` is one
/// of them.
pub(super) fn range(case: &BearingCase, within: f64, expansion: Option<&Expansion>) -> [f64; 2] {
    let oil = &case.lubricant;
    let laws = oil.temperature_range().and(oil.heat_temperature_range());
    let ends = [
        laws.low.max(TEMPERATURES[0]),
        laws.high.min(TEMPERATURES[1]),
    ];
    let cold = case.bearing.radial_clearance;
    let is_open = |temperature: f64| {
        let warm = expansion.map_or(cold, |expansion| {
            expansion.clearance(case.bearing.radius(), cold, temperature)
        });
        warm > LEAST_CLEARANCE * cold
    };
    ends.map(|end| {
        let (mut open, mut closed) = (within, end);
        if is_open(end) {
            return end;
        }
        for _ in 0..60 {
            let middle = 0.5 * (open + closed);
            if is_open(middle) {
                open = middle;
            } else {
                closed = middle;
            }
        }
        open
    })
}

/// The bearing at a temperature (K): with its warm clearance and, where its position is given, the
/// same relative eccentricity.
pub(super) fn warm_case(
    case: &BearingCase,
    expansion: Option<&Expansion>,
    temperature: f64,
) -> BearingCase {
    let cold = case.bearing.radial_clearance;
    let clearance = expansion.map_or(cold, |expansion| {
        expansion.clearance(case.bearing.radius(), cold, temperature)
    });
    with_clearance(case, clearance, temperature)
}

/// The bearing at a temperature (K) with a radial clearance (m) and, where its position is given, the
/// same relative eccentricity.
pub(super) fn with_clearance(case: &BearingCase, clearance: f64, temperature: f64) -> BearingCase {
    let mut warm = case.clone();
    warm.temperature = temperature;
    let cold = case.bearing.radial_clearance;
    warm.bearing.radial_clearance = clearance;
    if let Duty::State(state) = &mut warm.duty {
        *state = scaled(state, warm.bearing.radial_clearance / cold);
    }
    warm
}

/// A state of another clearance: the same relative eccentricity and its rates.
fn scaled(state: &JournalState, factor: f64) -> JournalState {
    JournalState {
        position: state.position.map(|along| factor * along),
        velocity: state.velocity.map(|along| factor * along),
        ..*state
    }
}

/// Heat of the film at the temperature of the case.
fn steady_heat(
    case: &BearingCase,
    study: &Study,
    progress: &mut ProgressCallback<'_>,
) -> Result<FilmHeat, FilmError> {
    let mut scratch = header(study);
    let body = match &case.duty {
        Duty::State(state) => solve_state(case, state, &study.film, &mut scratch)?,
        Duty::Load(load) => {
            // The position alone: what else the analysis asks for belongs to the last temperature.
            let position = Study {
                analysis: Analysis::Equilibrium,
                ..study.clone()
            };
            solve_load(case, load, &position, &mut scratch, progress)?
        }
        Duty::Cycle(_) => return Err(WRONG_DUTY),
    };
    let Body::Steady(steady) = body else {
        return Err(WRONG_DUTY);
    };
    let [front, rear] = steady.summary.side_flow;
    Ok(FilmHeat {
        power: steady.summary.power_loss(),
        side_flow: front + rear,
        volumetric_heat: volumetric_heat(case),
        outcome: scratch.status,
    })
}

const WRONG_DUTY: FilmError = FilmError::Unsupported {
    reason: "a load cycle has no steady heat",
};

/// J/(m3 K).
pub(super) fn volumetric_heat(case: &BearingCase) -> f64 {
    let ambient = case.bearing.ambient_pressure.max(0.0);
    case.lubricant
        .volumetric_heat(case.temperature, ambient)
        .value
}

/// Load cycles at trial temperatures.
struct CycleTrial<'a> {
    case: &'a BearingCase,
    duty: &'a CycleDuty,
    expansion: Option<&'a Expansion>,
    settings: &'a FilmSettings,
    /// Where the last trial ended: relative position with its clearance (m), film content.
    before: Option<(JournalState, f64, FilmHistory)>,
    count: usize,
}

/// Why the trials of a load cycle end.
enum Ended {
    /// The film refuses what is asked of it.
    Film(FilmError),
    /// The next trial would not differ from the last one.
    Settled,
}

impl From<FilmError> for Ended {
    fn from(error: FilmError) -> Self {
        Self::Film(error)
    }
}

impl CycleTrial<'_> {
    fn balance(
        mut self,
        path: &HeatPath,
        range: [f64; 2],
        progress: &mut ProgressCallback<'_>,
    ) -> Result<Balance, FilmError> {
        let mut trials: Vec<f64> = Vec::new();
        let found = path.balance(range, |temperature| {
            let last = trials.last();
            if last.is_some_and(|last| (temperature - last).abs() <= CYCLE_TOLERANCE) {
                return Err(Ended::Settled);
            }
            trials.push(temperature);
            Ok(((), self.heat(temperature, progress)?))
        });
        match found {
            Ok(found) => Ok(found.into()),
            Err(Ended::Film(error)) => Err(error),
            Err(Ended::Settled) => {
                let effective = trials.last().copied().unwrap_or(path.supply_temperature);
                let rise = effective - path.supply_temperature;
                Ok(Balance {
                    effective,
                    outlet: path.supply_temperature + rise / path.outlet_weight,
                    conducted: path.conductance * (effective - path.surroundings_temperature),
                    trials,
                    outcome: Outcome::Converged,
                })
            }
        }
    }

    /// Means over the cycle at a temperature, K.
    fn heat(
        &mut self,
        temperature: f64,
        progress: &mut ProgressCallback<'_>,
    ) -> Result<FilmHeat, FilmError> {
        self.count += 1;
        let case = warm_case(self.case, self.expansion, temperature);
        let mut heat = FilmHeat {
            power: f64::NAN,
            side_flow: f64::NAN,
            volumetric_heat: volumetric_heat(&case),
            outcome: Outcome::Starved,
        };
        let cycle = &self.duty.cycle;
        if is_starved(&case, cycle.engine_speed, self.settings)? {
            return Ok(heat);
        }
        let mut film = film_of(&case, self.settings)?;
        let clearance = case.bearing.radial_clearance;
        let start = match &self.before {
            None => OrbitStart::Equilibrium,
            Some((state, before, content)) => {
                film.restore(content);
                OrbitStart::At(scaled(state, clearance / before))
            }
        };
        let settings = OrbitSettings {
            start,
            ..orbit_settings(self.duty)
        };
        let trial = self.count;
        let orbit = journal_orbit(
            film.as_mut(),
            &case.bearing,
            cycle,
            &conditions(&case),
            &settings,
            &mut |_, _, stage| {
                let label = format!("heat balance, trial {trial}, cycle {}", stage.cycle);
                progress(ProgressEvent::new(label, 0.0))
            },
        )?;
        if let Some(last) = orbit.points.last() {
            self.before = Some((last.state, clearance, film.history()));
        }
        heat.power = orbit.mean_power_loss();
        heat.side_flow = orbit.mean_side_flow();
        heat.outcome = orbit.outcome;
        Ok(heat)
    }
}
