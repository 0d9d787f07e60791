//! How does a shell run in, and when has it done so?
//!
//! Equation: `d(depth)/dt = k int p_c |U| dt / period` at every cell of the shell, with the contact
//! pressure of the orbit (or equilibrium) in the worn bore: the depth is a profile of radial offsets
//! ([`sommerfeld_film::ProfileTable`]) added to the bore.
//! Unknowns: the depth at the cells of the film's grid, m.
//! Method: explicit steps; in one step no place wears deeper than a share of the roughness, over
//! which the contact pressure changes by little. First order in that share.
//! The shell has run in when the map of the wear rate no longer changes from step to step.
//!
//! Assumptions: the shell is the softer surface and wears alone; the wear coefficient stays; oil and
//! duty stay. The roughness stays too: how far its peaks are smoothed depends on how it was made, and
//! no law of a few measured parameters is at hand. Beyond the outermost cells the profile goes on as
//! it ends.
//! References: J. F. Archard, J. Appl. Phys. 24 (1953) 981, 10.1063/1.1721448.

use crate::wear::WearMap;
use serde::{Deserialize, Serialize};
use sommerfeld_film::{Bearing, Feature, FilmError, Outcome, ProfileTable};

/// How long a shell runs in, and how finely that is followed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RunningIn {
    /// Wear coefficient of the shell, 1/Pa = m3/(N m); 1e-18 to 1e-15 for lubricated bearings.
    pub coefficient: f64,
    /// Time to run, s.
    pub duration: f64,
    /// Largest depth that one step wears, m: about a tenth of the composite roughness.
    pub largest_depth: f64,
    /// The shell has run in when the wear rate of no cell changes in a step by more than this share of
    /// the largest rate; 0 runs the whole time. Default 0.02.
    pub settled_below: f64,
    /// Steps at most. Default 100.
    pub step_limit: usize,
}

impl RunningIn {
    /// With the usual steps: a tenth of the composite roughness (m) each.
    #[must_use]
    pub fn of(coefficient: f64, duration: f64, roughness: f64) -> Self {
        Self {
            coefficient,
            duration,
            largest_depth: 0.1 * roughness,
            settled_below: 0.02,
            step_limit: 100,
        }
    }
}

/// What one cycle does to a bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct WornCycle {
    /// Wear of the shell over the cycle.
    pub on_shell: WearMap,
    /// Share of the load that asperities carry, as the caller defines it.
    pub contact_share: f64,
    /// How the cycle was solved; anything but converged ends the running-in.
    pub outcome: Outcome,
}

impl WornCycle {
    /// A cycle that was not solved, and how it ended.
    #[must_use]
    pub fn not_solved(outcome: Outcome) -> Self {
        Self {
            on_shell: WearMap::default(),
            contact_share: f64::NAN,
            outcome,
        }
    }
}

/// One step of running-in.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RunningInStep {
    /// Time at its start, s.
    pub time: f64,
    /// Its length, s; 0 for the last row, which is the bearing at the end.
    pub duration: f64,
    /// Largest wear rate at its start, m/s.
    pub deepest_rate: f64,
    /// Wear volume per time at its start, m3/s.
    pub volume_rate: f64,
    /// Contact share at its start.
    pub contact_share: f64,
    /// Largest change of the wear rate of a cell since the step before, over the largest rate before;
    /// not a number for the first.
    pub rate_change: f64,
}

/// Why running-in ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RunningInEnd {
    /// The map of wear rates settled, or nothing wears.
    Settled,
    /// The time was over first.
    TimeOver,
    /// The steps were used up first.
    StepLimit,
    /// A cycle was not solved.
    NotSolved(Outcome),
}

impl RunningInEnd {
    /// The word for it in results: `settled`, `time-over`, ...
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Settled => "settled",
            Self::TimeOver => "time-over",
            Self::StepLimit => "step-limit",
            Self::NotSolved(_) => "not-solved",
        }
    }
}

/// A shell that has run in.
#[derive(Debug, Clone, PartialEq)]
pub struct RanIn {
    /// The bearing with its worn bore.
    pub bearing: Bearing,
    /// Depth worn at the cells of the shell, m, placed as in [`WearMap`].
    pub depth: Vec<f64>,
    /// Steps, and the bearing at the end as a last row.
    pub steps: Vec<RunningInStep>,
    /// Time run, s.
    pub time: f64,
    /// Why it ended.
    pub end: RunningInEnd,
}

/// Runs the shell of `bearing` in. `solve` solves the cycle of a bearing and tells what it wears; its
/// maps have the same cells every time.
///
/// # Errors
/// [`FilmError::Unsupported`] for settings that are not positive or maps whose cells change, and what
/// `solve` refuses.
pub fn run_in(
    bearing: &Bearing,
    settings: &RunningIn,
    mut solve: impl FnMut(&Bearing) -> Result<WornCycle, FilmError>,
) -> Result<RanIn, FilmError> {
    check(settings)?;
    let mut ran = RanIn {
        bearing: bearing.clone(),
        depth: Vec::new(),
        steps: Vec::new(),
        time: 0.0,
        end: RunningInEnd::StepLimit,
    };
    let mut before: Vec<f64> = Vec::new();
    loop {
        let cycle = solve(&ran.bearing)?;
        if cycle.outcome != Outcome::Converged {
            ran.end = RunningInEnd::NotSolved(cycle.outcome);
            return Ok(ran);
        }
        let rates = cycle.on_shell.depth_rate(settings.coefficient);
        if ran.steps.is_empty() {
            ran.depth = vec![0.0; rates.len()];
        } else if rates.len() != before.len() {
            return Err(FilmError::Unsupported {
                reason: "the cells of a shell changed while it ran in",
            });
        }
        let mut step = ran.next_step(settings, &cycle, largest_change(&before, &rates));
        if ran.steps.len() == settings.step_limit {
            step.duration = 0.0;
        }
        ran.steps.push(step);
        if step.duration == 0.0 {
            return Ok(ran);
        }
        ran.wear(bearing, &cycle.on_shell, &rates, step.duration)?;
        let is_over = step.duration >= settings.duration - step.time;
        ran.time = if is_over {
            settings.duration
        } else {
            step.time + step.duration
        };
        before = rates;
    }
}

fn check(settings: &RunningIn) -> Result<(), FilmError> {
    let positive = [
        settings.coefficient,
        settings.duration,
        settings.largest_depth,
    ];
    if positive.iter().all(|v| v.is_finite() && *v > 0.0) && settings.settled_below >= 0.0 {
        return Ok(());
    }
    Err(FilmError::Unsupported {
        reason: "running-in needs a positive wear coefficient, time and depth of a step",
    })
}

/// Largest change of a rate over the largest one before; not a number without one before.
fn largest_change(before: &[f64], now: &[f64]) -> f64 {
    if before.is_empty() {
        return f64::NAN;
    }
    let most = before.iter().copied().fold(0.0, f64::max);
    let pairs = before.iter().zip(now);
    let change = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    if change == 0.0 { 0.0 } else { change / most }
}

impl RanIn {
    /// What the solved cycle leads to, with a length of zero where running-in ends.
    fn next_step(
        &mut self,
        settings: &RunningIn,
        cycle: &WornCycle,
        rate_change: f64,
    ) -> RunningInStep {
        let deepest_rate = cycle.on_shell.deepest_rate(settings.coefficient).value;
        let left = settings.duration - self.time;
        let is_settled = rate_change < settings.settled_below || deepest_rate == 0.0;
        let duration = if left <= 0.0 {
            self.end = RunningInEnd::TimeOver;
            0.0
        } else if is_settled {
            self.end = RunningInEnd::Settled;
            0.0
        } else {
            left.min(settings.largest_depth / deepest_rate)
        };
        RunningInStep {
            time: self.time,
            duration,
            deepest_rate,
            volume_rate: cycle.on_shell.volume_rate(settings.coefficient),
            contact_share: cycle.contact_share,
            rate_change,
        }
    }

    /// Wears the bore of the new `bearing` for a time, s.
    fn wear(
        &mut self,
        bearing: &Bearing,
        map: &WearMap,
        rates: &[f64],
        duration: f64,
    ) -> Result<(), FilmError> {
        for (depth, rate) in self.depth.iter_mut().zip(rates) {
            *depth += rate * duration;
        }
        let table = ProfileTable::new(map.angles.clone(), map.axial.clone(), self.depth.clone());
        let table = table.map_err(|_| FilmError::Unsupported {
            reason: "the wear of a shell that is no number cannot be added to its bore",
        })?;
        self.bearing.bore = bearing.bore.clone();
        self.bearing.bore.features.push(Feature::Table(table));
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;
    use sommerfeld_film::{Cavitation, Elasticity, Ends, FilmShear, Finish, Inlet, Shape};

    const RATE: f64 = 1e-12;
    const SOFTNESS: f64 = 2e-7;

    fn bearing() -> Bearing {
        Bearing {
            diameter: 0.05,
            width: 0.02,
            radial_clearance: 2e-5,
            bore: Shape::cylindrical(),
            journal: Shape::cylindrical(),
            feeds: Vec::new(),
            ambient_pressure: 0.0,
            cavitation_pressure: 0.0,
            ends: Ends::Air,
            inlet: Inlet::Cyclic,
            cavitation: Cavitation::Gumbel,
            film_shear: FilmShear::FullWidth,
            finish: Finish::Smooth,
            elasticity: Elasticity::Rigid,
        }
    }

    /// A cycle whose contact pressure falls by a factor e for each `SOFTNESS` worn off the bore.
    fn fading(bearing: &Bearing) -> Result<WornCycle, FilmError> {
        let angles = vec![0.5, 2.0, 4.0];
        let wear = |angle: &f64| RATE * (-bearing.bore.offset(*angle, 0.0) / SOFTNESS).exp();
        let wear_load: Vec<f64> = angles.iter().map(wear).collect();
        Ok(WornCycle {
            contact_share: wear_load[0] / RATE,
            on_shell: WearMap {
                angles,
                axial: vec![0.0],
                angle_widths: vec![2.0; 3],
                axial_widths: vec![0.02],
                radius: 0.025,
                duration: 1.0,
                peak_pressure_velocity: vec![0.0; 3],
                mean_pressure_velocity: vec![0.0; 3],
                wear_load,
            },
            outcome: Outcome::Converged,
        })
    }

    fn settings(largest_depth: f64) -> RunningIn {
        RunningIn {
            coefficient: 1.0,
            duration: 3.6e6,
            largest_depth,
            settled_below: 0.0,
            step_limit: 100_000,
        }
    }

    /// `dw/dt = r exp(-w/s)` from nothing: `w = s ln(1 + r t / s)`, reached by the first order.
    #[test]
    fn wear_that_fades_with_depth_follows_its_closed_form() {
        let exact = SOFTNESS * (1.0 + RATE * 3.6e6 / SOFTNESS).ln();
        let error = |largest: f64| {
            let ran = run_in(&bearing(), &settings(largest), fading).unwrap();
            assert_eq!(ran.end, RunningInEnd::TimeOver);
            let total: f64 = ran.steps.iter().map(|step| step.duration).sum();
            assert!((total / 3.6e6 - 1.0).abs() < 1e-12 && ran.time == 3.6e6);
            assert_eq!(ran.steps.last().unwrap().duration, 0.0);
            assert!((ran.bearing.bore.offset(2.0, 0.003) - ran.depth[1]).abs() < 1e-20);
            ran.depth[0] / exact - 1.0
        };
        let (coarse, fine) = (error(0.1 * SOFTNESS), error(0.05 * SOFTNESS));
        let order = (coarse / fine).log2();
        assert!(
            fine.abs() < 0.02 && (order - 1.0).abs() < 0.1,
            "{coarse} {fine}"
        );
    }

    #[test]
    fn it_ends_where_rates_settle_and_where_steps_are_used_up() {
        let limited = RunningIn {
            step_limit: 7,
            ..settings(0.1 * SOFTNESS)
        };
        let ran = run_in(&bearing(), &limited, fading).unwrap();
        assert_eq!((ran.end, ran.steps.len()), (RunningInEnd::StepLimit, 8));
        // A tenth of the softness off changes the rate by a tenth.
        let settling = RunningIn {
            settled_below: 0.12,
            ..settings(0.1 * SOFTNESS)
        };
        let ran = run_in(&bearing(), &settling, fading).unwrap();
        assert_eq!((ran.end, ran.steps.len()), (RunningInEnd::Settled, 2));
        assert!((ran.time * RATE - 0.1 * SOFTNESS).abs() < 1e-20);
        let unsolved = |bearing: &Bearing| {
            let starved = !bearing.bore.is_cylindrical();
            Ok(WornCycle {
                outcome: if starved {
                    Outcome::Starved
                } else {
                    Outcome::Converged
                },
                ..fading(bearing)?
            })
        };
        let ran = run_in(&bearing(), &settling, unsolved).unwrap();
        assert_eq!(ran.end, RunningInEnd::NotSolved(Outcome::Starved));
        assert_eq!(ran.steps.len(), 1);
    }

    #[test]
    fn settings_that_are_none_are_refused() {
        for bad in [0.0, -1.0, f64::NAN] {
            let settings = RunningIn::of(1e-16, bad, 3e-7);
            assert!(run_in(&bearing(), &settings, fading).is_err());
        }
    }
}
