//! What a run of an engine or shaft found: every bearing at every speed.
//!
//! Of the film at each speed the fields of the worst instant and what each point of the surfaces has
//! seen are kept; frames over the cycle, at most [`MACHINE_FRAMES`], at the first speed only.

use super::{CycleResults, HeatResults, degrees, rpm};
use crate::limits::{Limit, LimitCheck, Verdict};
use sommerfeld_bearing::LoadCycle;
use sommerfeld_engine::{Performance, Role, TorsionResponse};
use sommerfeld_film::Outcome;

/// Instants of a cycle that are kept of every bearing of a machine, at the first of its speeds.
pub const MACHINE_FRAMES: usize = 24;

/// Every bearing of a machine at every speed.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineResults {
    /// How the loads of the mains (or of the bearings of a shaft) were found, in words for a reader.
    pub load_model: String,
    /// One for each speed, in the order of the study.
    pub speeds: Vec<SpeedResults>,
}

/// A machine at one speed.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedResults {
    /// Mean speed of the crankshaft or shaft, rad/s.
    pub speed: f64,
    /// How it ended: converged only if every bearing did.
    pub outcome: Outcome,
    /// Gas, torque and orders; `None` for a shaft.
    pub performance: Option<Performance>,
    /// Torsional vibration, where it was followed.
    pub torsion: Option<TorsionResponse>,
    /// Every bearing, in the order of the study.
    pub bearings: Vec<BearingResults>,
    /// Mean power lost in all bearings over the swept volume and cycle rate, Pa: friction mean effective
    /// pressure of the bearings; `None` for a shaft.
    pub friction_mean_effective_pressure: Option<f64>,
}

/// One bearing at one speed.
#[derive(Debug, Clone, PartialEq)]
pub struct BearingResults {
    /// Its name.
    pub name: String,
    /// Its place in the machine.
    pub role: Role,
    /// Its number among its kind, 0-based.
    pub index: usize,
    /// The load it was given, or that the elastic shaft put on it.
    pub load: LoadCycle,
    /// Where the mains are indeterminate: the load that hinges at the mains would give, N, at each point
    /// of the orbit.
    pub determinate_load: Option<Vec<[f64; 2]>>,
    /// The bearing whose orbit this is at another crank angle; `None` for one that was solved itself.
    pub turned_from: Option<TurnedFrom>,
    /// The temperature that its heat led to, where it was not given.
    pub heat: Option<HeatResults>,
    /// Orbit, film and what follows.
    pub cycle: CycleResults,
}

/// Another bearing of the machine that does the same at another crank angle.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnedFrom {
    /// Its name.
    pub name: String,
    /// Crank angle by which this bearing is later, rad.
    pub later_by: f64,
}

impl std::fmt::Display for TurnedFrom {
    /// For a reader: `big-end-1 shifted by 240 deg`.
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let angle = (1e6 * degrees(self.later_by)).round() / 1e6;
        write!(formatter, "{} shifted by {angle} deg", self.name)
    }
}

impl MachineResults {
    /// Every bearing at every speed with that speed, speed by speed.
    pub fn bearings(&self) -> impl Iterator<Item = (&SpeedResults, &BearingResults)> {
        let speeds = self.speeds.iter();
        speeds.flat_map(|speed| speed.bearings.iter().map(move |bearing| (speed, bearing)))
    }

    /// The bearing and speed at which a value is largest, the first of equals; what is not finite does
    /// not count.
    pub fn largest(
        &self,
        value: impl Fn(&BearingResults) -> Option<f64>,
    ) -> Option<(&SpeedResults, &BearingResults, f64)> {
        self.bearings()
            .filter_map(|(speed, bearing)| Some((speed, bearing, value(bearing)?)))
            .filter(|(_, _, value)| value.is_finite())
            .reduce(|best, next| if next.2 > best.2 { next } else { best })
    }

    /// Orbits that an interrupted run has not done.
    #[must_use]
    pub fn missing(&self) -> usize {
        self.bearings()
            .filter(|(_, bearing)| bearing.is_missing())
            .count()
    }

    /// The worst of all bearings and speeds against a limit, with its place. A limit that one of them
    /// breaks is broken; one that is not judged everywhere is not kept.
    #[must_use]
    pub fn check(&self, limit: &Limit) -> LimitCheck {
        let severity = |check: &LimitCheck| match check.verdict {
            Verdict::Ok => 0,
            Verdict::NotEvaluated => 1,
            Verdict::Exceeded => 2,
        };
        let checks = self.bearings().map(|(speed, bearing)| LimitCheck {
            at: Some(speed.place(bearing)),
            ..bearing.check(limit)
        });
        checks
            .reduce(|worst, next| {
                let worse = match severity(&next).cmp(&severity(&worst)) {
                    std::cmp::Ordering::Equal => next.is_worse_than(&worst),
                    other => other.is_gt(),
                };
                if worse { next } else { worst }
            })
            .unwrap_or_else(|| LimitCheck::new(limit.clone(), None))
    }
}

impl SpeedResults {
    /// A bearing at this speed, for a reader: `big-end-2 at 2000 rpm`.
    #[must_use]
    pub fn place(&self, bearing: &BearingResults) -> String {
        format!("{} at {}", bearing.name, speed_words(self.speed))
    }

    /// The speed as it stands in names of directories and groups: `2000rpm`.
    #[must_use]
    pub fn label(&self) -> String {
        speed_words(self.speed).replace(' ', "")
    }
}

/// An angular speed (rad/s) for a reader, `2000 rpm`: as many decimals as it has, three at most.
#[must_use]
pub fn speed_words(speed: f64) -> String {
    format!("{} rpm", (1e3 * rpm(speed)).round() / 1e3)
}

impl BearingResults {
    /// An interrupted run has not done this orbit.
    #[must_use]
    pub fn is_missing(&self) -> bool {
        let orbit = &self.cycle.orbit;
        orbit.outcome == Outcome::NotConverged && orbit.cycles == 0
    }

    /// This bearing at its speed against a limit. A limit that seems kept is not called kept if the
    /// orbit did not converge.
    #[must_use]
    pub fn check(&self, limit: &Limit) -> LimitCheck {
        let found = self.cycle.limited_value(limit.quantity);
        let check = LimitCheck::new(limit.clone(), found);
        check.unless(self.cycle.orbit.outcome != Outcome::Converged)
    }
}

impl MachineResults {
    /// Every bearing at every speed, with the places of both.
    pub(crate) fn all(&self) -> impl Iterator<Item = (usize, usize, &BearingResults)> + Clone {
        let speeds = self.speeds.iter().enumerate();
        speeds.flat_map(|(at, speed)| {
            let bearings = speed.bearings.iter().enumerate();
            bearings.map(move |(number, bearing)| (at, number, bearing))
        })
    }

    /// The bearings as the speed with most of them has them: a speed that failed may have none.
    pub(crate) fn fullest(&self) -> &[BearingResults] {
        let most = self
            .speeds
            .iter()
            .rev()
            .max_by_key(|one| one.bearings.len());
        most.map_or(&[], |speed| &speed.bearings)
    }
}
