//! What a study asks about wear.

use sommerfeld_bearing::{RunningIn, WornRoughness};
use sommerfeld_film::{Bearing, Finish};

/// What wears, and whether the shell is to run in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearPlan {
    /// Archard coefficient of the shell, 1/Pa.
    pub coefficient: f64,
    /// The bore wears for a time before the results are taken.
    pub running_in: Option<RunningInPlan>,
}

/// How a shell runs in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunningInPlan {
    /// Time, s.
    pub duration: f64,
    /// Steps at most.
    pub steps: usize,
    /// Largest depth of a step over the composite roughness.
    pub step_depth: f64,
    /// Largest change of the wear rate in a step, over the largest rate, of a shell that has run in.
    pub settled_below: f64,
    /// What becomes of the roughness.
    pub roughness: WornRoughness,
}

impl WearPlan {
    /// How the shell of a bearing runs in; `None` where it is not asked for, or nothing touches.
    #[must_use]
    pub fn running_in(&self, bearing: &Bearing) -> Option<RunningIn> {
        let plan = self.running_in?;
        let Finish::Rough(rough) = &bearing.finish else {
            return None;
        };
        Some(RunningIn {
            coefficient: self.coefficient,
            duration: plan.duration,
            largest_depth: plan.step_depth * rough.roughness.composite(),
            settled_below: plan.settled_below,
            step_limit: plan.steps,
            roughness: plan.roughness,
        })
    }
}
