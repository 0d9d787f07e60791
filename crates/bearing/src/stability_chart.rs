//! At which speed does a given rotor begin to whirl, and how far is it from there elsewhere?
//!
//! Method: equilibrium, stiffness, damping and whirl threshold at each speed, each started from its
//! neighbour's position. Between two speeds of which one is stable for the rotor and one is not, the
//! speed where its mass is the threshold mass is found by the rule of false position with halved
//! memory (Illinois), every trial a solved equilibrium of its own.
//! Limits: those of [`crate::stability`]; load, oil and clearance are the same at every speed.
//! Reference for the root search: M. Dowell, P. Jarratt, BIT 11 (1971) 168, 10.1007/BF01934364.

use crate::{Coefficients, EquilibriumRequest, Stability, find_equilibrium, rotor_stability};
use serde::{Deserialize, Serialize};
use sommerfeld_film::{Bearing, Conditions, FilmError, FilmForce, JournalState, Outcome};
use std::ops::ControlFlow;

/// The bearing at one speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpeedPoint {
    /// Angular speed of the journal, rad/s.
    pub journal_speed: f64,
    /// The equilibrium there.
    pub state: JournalState,
    /// Stiffness and damping there, shell frame.
    pub coefficients: Coefficients,
    /// For which rotors it is stable.
    pub stability: Stability,
    /// How the search for the equilibrium ended; only a converged one has numbers.
    pub outcome: Outcome,
}

/// Where the rotor changes between stable and unstable.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Onset {
    /// Angular speed of the journal, rad/s.
    pub journal_speed: f64,
    /// Angular speed of the whirl there, rad/s.
    pub whirl_speed: f64,
    /// Unstable above this speed; else below it.
    pub is_unstable_above: bool,
}

/// Stability over speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StabilityChart {
    /// One point per speed, in the order of the speeds.
    pub points: Vec<SpeedPoint>,
    /// Where the given rotor changes between stable and unstable, between two of the speeds.
    pub onsets: Vec<Onset>,
    /// Converged only if every point and every onset did.
    pub outcome: Outcome,
}

/// Largest error of an onset, over its speed.
const ONSET_TOLERANCE: f64 = 1e-6;
/// Equilibria tried for one onset.
const ONSET_TRIALS: usize = 40;

/// Stability of a rotor on `film` at each of `speeds` (rad/s, ascending), the rest as in `request`;
/// `rotor_mass` (kg per bearing) asks for its onsets. `progress` gets the share that is done after each
/// speed and may stop the chart, which then ends there and is not converged.
///
/// # Errors
/// What the film refuses; no equilibrium at a speed is the outcome of its point.
pub fn stability_chart(
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    request: &EquilibriumRequest,
    (speeds, rotor_mass): (&[f64], Option<f64>),
    conditions: &Conditions<'_>,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<StabilityChart, FilmError> {
    let mut solver = ChartSolver {
        film,
        bearing,
        request: *request,
        conditions,
    };
    let mut chart = StabilityChart {
        points: Vec::new(),
        onsets: Vec::new(),
        outcome: Outcome::Converged,
    };
    for (index, &speed) in speeds.iter().enumerate() {
        let point = solver.at(speed)?;
        if point.outcome != Outcome::Converged {
            chart.outcome = point.outcome;
        }
        if let (Some(mass), Some(before)) = (rotor_mass, chart.points.last()) {
            let pair = [*before, point];
            let converged = pair.iter().all(|p| p.outcome == Outcome::Converged);
            let [low, high] = pair.map(|p| p.stability.is_stable(mass));
            if converged && low != high {
                match solver.onset(pair, mass)? {
                    Some(onset) => chart.onsets.push(onset),
                    None => chart.outcome = Outcome::NotConverged,
                }
            }
        }
        chart.points.push(point);
        if progress((index + 1) as f64 / speeds.len() as f64).is_break() {
            chart.outcome = Outcome::NotConverged;
            break;
        }
    }
    Ok(chart)
}

struct ChartSolver<'a> {
    film: &'a mut dyn FilmForce,
    bearing: &'a Bearing,
    /// Starts from the last equilibrium found.
    request: EquilibriumRequest,
    conditions: &'a Conditions<'a>,
}

impl ChartSolver<'_> {
    fn at(&mut self, journal_speed: f64) -> Result<SpeedPoint, FilmError> {
        self.request.frame.journal_speed = journal_speed;
        let found = find_equilibrium(self.film, self.bearing, &self.request, self.conditions)?;
        if found.outcome == Outcome::Converged {
            self.request.start = Some(found.state.position);
            self.request.frame.tilt = found.state.tilt;
        }
        let coefficients = Coefficients::from_tangent(&found.tangent);
        Ok(SpeedPoint {
            journal_speed,
            state: found.state,
            stability: rotor_stability(&coefficients),
            coefficients,
            outcome: found.outcome,
        })
    }

    /// The speed between two points where the mass is the threshold mass.
    fn onset(&mut self, pair: [SpeedPoint; 2], mass: f64) -> Result<Option<Onset>, FilmError> {
        let is_unstable_above = pair[0].stability.is_stable(mass);
        let [mut low, mut high] = pair.map(|p| (p.journal_speed, excess(&p, mass)));
        // Which end stayed last time: its value is halved if it stays again.
        let mut stayed = 0;
        for _ in 0..ONSET_TRIALS {
            let share = low.1 / (low.1 - high.1);
            let speed = low.0 + share.clamp(0.02, 0.98) * (high.0 - low.0);
            let point = self.at(speed)?;
            if point.outcome != Outcome::Converged {
                return Ok(None);
            }
            let value = excess(&point, mass);
            let narrow = (high.0 - low.0).abs() <= ONSET_TOLERANCE * speed.abs();
            if narrow || value.abs() < ONSET_TOLERANCE {
                return Ok(Some(Onset {
                    journal_speed: speed,
                    whirl_speed: point
                        .stability
                        .threshold()
                        .map_or(f64::NAN, |threshold| threshold.whirl_speed),
                    is_unstable_above,
                }));
            }
            if (value > 0.0) == (low.1 > 0.0) {
                low = (speed, value);
                high.1 *= if stayed > 0 { 0.5 } else { 1.0 };
                stayed = 1;
            } else {
                high = (speed, value);
                low.1 *= if stayed < 0 { 0.5 } else { 1.0 };
                stayed = -1;
            }
        }
        Ok(None)
    }
}

/// Positive where the rotor is stable, 0 on the threshold, of bounded size.
fn excess(point: &SpeedPoint, mass: f64) -> f64 {
    const LARGEST: f64 = 3.0;
    point.stability.margin(mass).ln().clamp(-LARGEST, LARGEST)
}
