//! What a run of an engine or shaft found: every bearing at every speed.

use super::CycleResults;
use crate::limits::{Quantity, Side};
use sommerfeld_bearing::LoadCycle;
use sommerfeld_engine::{Performance, Role, TorsionResponse};
use sommerfeld_film::Outcome;

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
    /// Orbit, film and what follows.
    pub cycle: CycleResults,
}

/// Where in a machine a quantity is worst.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Worst {
    /// Place among the speeds.
    pub speed: usize,
    /// Place among the bearings of that speed.
    pub bearing: usize,
    /// Its value, SI.
    pub value: f64,
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

    /// The bearing and speed at which a quantity comes nearest to a limit or breaks it most; the first
    /// of equals. `None` where no bearing has a finite number.
    pub(crate) fn worst(&self, quantity: Quantity) -> Option<Worst> {
        let found = self.all().filter_map(|(speed, bearing, results)| {
            let value = results.cycle.limited_value(quantity)?;
            value.is_finite().then_some(Worst {
                speed,
                bearing,
                value,
            })
        });
        found.reduce(|worst, next| {
            let is_worse = match quantity.side() {
                Side::AtLeast => next.value < worst.value,
                Side::AtMost => next.value > worst.value,
            };
            if is_worse { next } else { worst }
        })
    }
}
