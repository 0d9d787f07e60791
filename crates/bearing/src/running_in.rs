//! How does a shell run in, and when has it done so?
//!
//! ```text
//! d(depth)/dt = k int p_c |U| dt / period          at every cell of the shell, with its worn bore
//! s_shell     = rms of the Gaussian heights truncated by the mean worn depth D
//! D           = int depth^2 dA / int depth dA      mean over the worn zone, weighted by contact work
//! ```
//! The depth is a profile of radial offsets ([`sommerfeld_film::ProfileTable`]) added to the bore: the
//! mean plane falls by what is worn. The summits are what is worn first, so that the roughness falls too
//! ([`sommerfeld_film::WornHeights`]), to 0.584 of what it was once they are all gone.
//! Unknowns: the depth at the cells of the film's grid, m; one roughness of the shell.
//! Method: explicit steps of the second order (Adams and Bashforth, steps of any length), one cycle each.
//! A step is as long as no place wears deeper than a share of the roughness and no rate, going on as in
//! the step before, changes by more than half of the largest. The first step, of the first order, is half
//! as deep.
//! The shell has run in when the map of the wear rates no longer changes from step to step, or when the
//! largest rate has faded to the same share of what it was.
//!
//! Assumptions: the shell is the softer surface and wears alone; the wear coefficient stays; oil and
//! duty stay. The film knows one roughness per bearing: that of the worn zone stands for all of it,
//! outside of which nothing touches. The dimensionless groups of the contact law stay, as they are
//! alike for surfaces of any roughness; a measured table of contact stays as a whole. Beyond the outermost
//! cells the profile goes on as it ends.
//! References: J. F. Archard, J. Appl. Phys. 24 (1953) 981, 10.1063/1.1721448; T. G. King, W. Watson, K.
//! J. Stout, The micro-geometry of the running-in process, 4th Leeds-Lyon Symposium, 1978.

#[cfg(test)]
mod tests;

use crate::wear::WearMap;
use serde::{Deserialize, Serialize};
use sommerfeld_film::{Bearing, Feature, FilmError, Finish, Outcome, ProfileTable, WornHeights};

/// What wear does to the roughness of the shell.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WornRoughness {
    /// Its summits are truncated by the worn depth.
    #[default]
    Truncated,
    /// It stays: wear moves the profile alone.
    Kept,
}

/// How long a shell runs in, and how finely that is followed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RunningIn {
    /// Wear coefficient of the shell, 1/Pa = m3/(N m); 1e-18 to 1e-15 for lubricated bearings.
    pub coefficient: f64,
    /// Time to run, s.
    pub duration: f64,
    /// Largest depth that one step wears, m: about a fifth of the composite roughness.
    pub largest_depth: f64,
    /// The shell has run in when the wear rate of no cell changes by more than this share of the largest
    /// rate while the deepest place wears by `largest_depth`, or when the largest rate is below this
    /// share of the first one; 0 runs the whole time. Default 0.02.
    pub settled_below: f64,
    /// Steps at most. Default 100.
    pub step_limit: usize,
    /// What becomes of the roughness.
    pub roughness: WornRoughness,
}

/// Largest change of a rate that a step may lead to, over the largest rate.
const LARGEST_CHANGE: f64 = 0.5;
/// Share of the usual depth of the first step, which is of the first order.
const FIRST_SHARE: f64 = 0.5;

impl RunningIn {
    /// With the usual steps: a fifth of the composite roughness (m) each.
    #[must_use]
    pub fn of(coefficient: f64, duration: f64, roughness: f64) -> Self {
        Self {
            coefficient,
            duration,
            largest_depth: 0.2 * roughness,
            settled_below: 0.02,
            step_limit: 100,
            roughness: WornRoughness::Truncated,
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
    /// Thinnest film of the cycle, m.
    pub minimum_film_thickness: f64,
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
            minimum_film_thickness: f64::NAN,
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
    /// Largest depth worn until its start, m.
    pub depth: f64,
    /// Volume worn until its start, m3.
    pub volume: f64,
    /// rms roughness of the shell at its start, m.
    pub shell_roughness: f64,
    /// Contact share at its start.
    pub contact_share: f64,
    /// Thinnest film at its start, m.
    pub minimum_film_thickness: f64,
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
    /// The largest wear rate has become a small share of what it was at first.
    Faded,
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
            Self::Faded => "faded",
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
    /// Centres of the cells of the shell around, rad from +X of the shell.
    pub angles: Vec<f64>,
    /// Centres of the cells along the axis, m from the mid-plane.
    pub axial: Vec<f64>,
    /// Depth worn at these cells, m, placed as in [`WearMap`].
    pub depth: Vec<f64>,
    /// Steps, and the bearing at the end as a last row.
    pub steps: Vec<RunningInStep>,
    /// Time run, s.
    pub time: f64,
    /// Why it ended.
    pub end: RunningInEnd,
}

/// The step before.
struct Past {
    /// Wear rates at its start, m/s.
    rates: Vec<f64>,
    /// s.
    duration: f64,
    /// Largest depth that it wore, m.
    deepest: f64,
}

/// Runs the shell of `bearing` in. `solve` solves the cycle of the bearing as it has run in so far and tells
/// what it wears; its maps have the same cells every time.
///
/// # Errors
/// [`FilmError::Unsupported`] for settings that are not positive or maps whose cells change, and what
/// `solve` refuses.
pub fn run_in(
    bearing: &Bearing,
    settings: &RunningIn,
    mut solve: impl FnMut(&RanIn) -> Result<WornCycle, FilmError>,
) -> Result<RanIn, FilmError> {
    check(settings)?;
    let mut ran = RanIn::fresh(bearing);
    let mut past: Option<Past> = None;
    loop {
        let cycle = solve(&ran)?;
        if cycle.outcome != Outcome::Converged {
            ran.end = RunningInEnd::NotSolved(cycle.outcome);
            return Ok(ran);
        }
        let rates = cycle.on_shell.depth_rate(settings.coefficient);
        ran.place(&cycle.on_shell)?;
        let mut step = ran.next_step(settings, &cycle, &rates, past.as_ref());
        if step.duration > 0.0 && ran.steps.len() == settings.step_limit {
            ran.end = RunningInEnd::StepLimit;
            step.duration = 0.0;
        }
        ran.steps.push(step);
        if step.duration == 0.0 {
            return Ok(ran);
        }
        let worn = worn_in(&rates, past.as_ref(), step.duration);
        ran.wear(bearing, settings.roughness, &cycle.on_shell, &worn)?;
        let is_over = step.duration >= settings.duration - step.time;
        ran.time = if is_over {
            settings.duration
        } else {
            step.time + step.duration
        };
        past = Some(Past {
            rates,
            duration: step.duration,
            deepest: largest(&worn),
        });
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

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// Largest difference of two rates of a cell, m/s.
fn largest_change(before: &[f64], now: &[f64]) -> f64 {
    let pairs = before.iter().zip(now);
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Depth (m) that a step of a length (s) wears, not below zero: the rates at its start and, after a first
/// step, half of the way on which they have been moving.
fn worn_in(rates: &[f64], past: Option<&Past>, duration: f64) -> Vec<f64> {
    let weight = past.map_or(0.0, |past| 0.5 * duration / past.duration);
    let before = |cell: usize| past.map_or(0.0, |past| past.rates[cell]);
    let worn = rates.iter().enumerate();
    worn.map(|(cell, rate)| (duration * (rate + weight * (rate - before(cell)))).max(0.0))
        .collect()
}

/// Length of the next step, s, where nothing ends it sooner.
fn length(settings: &RunningIn, rates: &[f64], past: Option<&Past>) -> f64 {
    let most = largest(rates);
    let by_depth = settings.largest_depth / most;
    let Some(past) = past else {
        return FIRST_SHARE * by_depth;
    };
    let change = largest_change(&past.rates, rates) / past.duration;
    // A rate that does not change gives an infinite length.
    by_depth.min(LARGEST_CHANGE * most / change)
}

/// Whether a shell with these rates has run in.
fn has_run_in(settings: &RunningIn, rates: &[f64], past: Option<&Past>) -> bool {
    let Some(past) = past else {
        return false;
    };
    // A short step changes little and tells little.
    let change = largest_change(&past.rates, rates) * settings.largest_depth / past.deepest;
    change < settings.settled_below * largest(&past.rates)
}

impl RanIn {
    fn fresh(bearing: &Bearing) -> Self {
        Self {
            bearing: bearing.clone(),
            angles: Vec::new(),
            axial: Vec::new(),
            depth: Vec::new(),
            steps: Vec::new(),
            time: 0.0,
            end: RunningInEnd::TimeOver,
        }
    }

    /// Takes the cells of the first map; those of the others are the same.
    fn place(&mut self, map: &WearMap) -> Result<(), FilmError> {
        if self.steps.is_empty() {
            self.angles.clone_from(&map.angles);
            self.axial.clone_from(&map.axial);
            self.depth = vec![0.0; map.wear_load.len()];
        } else if self.depth.len() != map.wear_load.len() {
            return Err(FilmError::Unsupported {
                reason: "the cells of a shell changed while it ran in",
            });
        }
        Ok(())
    }

    /// What the solved cycle leads to, with a length of zero where running-in ends.
    fn next_step(
        &mut self,
        settings: &RunningIn,
        cycle: &WornCycle,
        rates: &[f64],
        past: Option<&Past>,
    ) -> RunningInStep {
        let deepest_rate = largest(rates);
        let first = self.steps.first().map_or(deepest_rate, |s| s.deepest_rate);
        let left = settings.duration - self.time;
        let duration = if left <= 0.0 {
            self.end = RunningInEnd::TimeOver;
            0.0
        } else if deepest_rate == 0.0 || has_run_in(settings, rates, past) {
            self.end = RunningInEnd::Settled;
            0.0
        } else if deepest_rate < settings.settled_below * first {
            self.end = RunningInEnd::Faded;
            0.0
        } else {
            left.min(length(settings, rates, past))
        };
        let change = past.map(|past| (largest_change(&past.rates, rates), largest(&past.rates)));
        RunningInStep {
            time: self.time,
            duration,
            deepest_rate,
            volume_rate: cycle.on_shell.volume_rate(settings.coefficient),
            depth: largest(&self.depth),
            volume: cycle.on_shell.integral(&self.depth),
            shell_roughness: shell_roughness(&self.bearing.finish),
            contact_share: cycle.contact_share,
            minimum_film_thickness: cycle.minimum_film_thickness,
            rate_change: change.map_or(f64::NAN, |(change, most)| change / most),
        }
    }

    /// Wears the bore of the new `bearing` by more depth at each cell, m.
    fn wear(
        &mut self,
        bearing: &Bearing,
        roughness: WornRoughness,
        map: &WearMap,
        worn: &[f64],
    ) -> Result<(), FilmError> {
        for (depth, more) in self.depth.iter_mut().zip(worn) {
            *depth += more;
        }
        let table = ProfileTable::new(map.angles.clone(), map.axial.clone(), self.depth.clone());
        let table = table.map_err(|_| FilmError::Unsupported {
            reason: "the wear of a shell that is no number cannot be added to its bore",
        })?;
        self.bearing.bore = bearing.bore.clone();
        self.bearing.bore.features.push(Feature::Table(table));
        let is_truncated = roughness == WornRoughness::Truncated;
        if let (Finish::Rough(own), true) = (&mut self.bearing.finish, is_truncated) {
            let fresh = shell_roughness(&bearing.finish);
            own.roughness.shell = WornHeights::of(fresh, mean_depth(map, &self.depth)).rms;
        }
        Ok(())
    }
}

/// rms roughness of the shell, m.
fn shell_roughness(finish: &Finish) -> f64 {
    match finish {
        Finish::Smooth => 0.0,
        Finish::Rough(rough) => rough.roughness.shell,
    }
}

/// Mean of the worn depth (m) over the worn zone, each place weighted by the contact work that it has
/// taken, which is its depth.
fn mean_depth(map: &WearMap, depth: &[f64]) -> f64 {
    let squares: Vec<f64> = depth.iter().map(|depth| depth * depth).collect();
    let volume = map.integral(depth);
    if volume > 0.0 {
        map.integral(&squares) / volume
    } else {
        0.0
    }
}
