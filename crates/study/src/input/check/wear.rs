//! What a study asks about wear.

use super::Checker;
use crate::input::values::{Value, not_built};
use crate::input::wear::{RunningInPlan, WearPlan};
use sommerfeld_bearing::WornRoughness;
use sommerfeld_film::Bearing;

const WEAR: &str = "wear";
const RUNNING_IN: &str = "wear.running_in";

impl Checker<'_> {
    /// What wears in `bearings`: nothing where the study does not ask. `None` where an error says why
    /// not.
    pub(super) fn wear<'b>(
        &mut self,
        mut bearings: impl Iterator<Item = &'b Bearing>,
    ) -> Option<Option<WearPlan>> {
        if self.entry(WEAR).is_none() {
            return Some(None);
        }
        self.refuse_of_closed_form(WEAR, "has no contact")?;
        if !bearings.any(|bearing| bearing.finish.has_contact()) {
            let error = self.section_error(WEAR, "nothing wears without contact of asperities");
            self.errors.push(error.hinting(
                "give [bearing.surface] a roughness and [bearing.surface.contact], or take [wear] out",
            ));
            return None;
        }
        let coefficient = self.number("wear.coefficient");
        let running_in = match self.entry(RUNNING_IN) {
            None => None,
            Some(_) => {
                self.refuse_running_in_of_machines()?;
                Some(self.running_in()?)
            }
        };
        Some(Some(WearPlan {
            coefficient: coefficient?,
            running_in,
        }))
    }

    /// The bearings of a machine would run in one by one, each under loads of its own.
    fn refuse_running_in_of_machines(&mut self) -> Option<()> {
        if !self.mode.is_machine() {
            return Some(());
        }
        let what = format!("{RUNNING_IN} of the analysis {}", self.mode.name());
        let error = not_built(self.section_error(RUNNING_IN, ""), &what);
        self.errors.push(error.hinting(
            "take it out; the loads-<name>.csv that the run writes for each bearing can be run as a load-cycle \
             study with it",
        ));
        None
    }

    fn running_in(&self) -> Option<RunningInPlan> {
        let number = |name: &str| self.number(&format!("{RUNNING_IN}.{name}"));
        let Value::Integer(steps) = self.value(&format!("{RUNNING_IN}.steps"))? else {
            return None;
        };
        Some(RunningInPlan {
            duration: number("hours")?,
            steps: usize::try_from(steps).ok()?,
            step_depth: number("step_depth")?,
            settled_below: number("settled_below")?,
            roughness: match self.text(&format!("{RUNNING_IN}.roughness"))?.as_str() {
                "kept" => WornRoughness::Kept,
                _ => WornRoughness::Truncated,
            },
        })
    }
}
