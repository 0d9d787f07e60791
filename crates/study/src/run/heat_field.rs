//! Studies whose film has a temperature at every place: what the oil brings, and what came of it.

use crate::input::{BearingCase, HeatPlan};
use crate::results::{Header, HeatFieldResults, HeatResults};
use sommerfeld_film::{Inlet, Outcome, Surroundings, Warmed};

/// Change of a temperature from cycle to cycle below which that of a load cycle has settled, K.
pub(super) const CYCLE_TOLERANCE: f64 = 0.05;

/// What surrounds the film of a case, if its temperature is a field.
pub(super) struct FieldHeat {
    supply: Vec<f64>,
    wall: (f64, f64),
    carry_over: f64,
    volumetric_heat: f64,
}

impl FieldHeat {
    /// Of a case; `None` where the temperature is one number.
    pub(super) fn of(case: &BearingCase) -> Option<Self> {
        let HeatPlan::Field {
            path,
            wall,
            carry_over,
        } = &case.heat
        else {
            return None;
        };
        let bearing = &case.bearing;
        let line = usize::from(bearing.inlet != Inlet::Cyclic);
        Some(Self {
            supply: vec![path.supply_temperature; (bearing.feeds.len() + line).max(1)],
            wall: (wall.coefficient, wall.temperature),
            carry_over: *carry_over,
            volumetric_heat: case
                .lubricant
                .volumetric_heat(case.temperature, bearing.ambient_pressure.max(0.0))
                .value,
        })
    }

    /// As the film takes them.
    pub(super) fn surroundings(&self) -> Surroundings<'_> {
        Surroundings {
            volumetric_heat: self.volumetric_heat,
            supply: &self.supply,
            ambient: self.supply[0],
            carry_over: self.carry_over,
            wall: self.wall,
        }
    }

    /// Puts the temperatures into the results, and what went wrong with them.
    pub(super) fn note(
        &self,
        case: &BearingCase,
        warmed: &Warmed,
        changes: &[f64],
        outcome: Outcome,
        header: &mut Header,
    ) {
        if outcome == Outcome::NoSolution && header.status == Outcome::Converged {
            header.status = outcome;
            header.messages.insert(
                0,
                "no solution: heat is made in oil that nothing replaces, so that no temperature \
                 balances it; give a supply or walls that take heat"
                    .to_owned(),
            );
        } else if outcome != Outcome::Converged && header.status == Outcome::Converged {
            header.status = outcome;
            let last = changes.last().copied().unwrap_or(f64::NAN);
            header.messages.insert(
                0,
                format!(
                    "not converged: the temperatures of the film still move by {last:.2} K, with {:.3} W \
                     made and {:.3} W carried away; give walls that take heat (heat.wall_coefficient), more \
                     supply or, for a load cycle, more maximum_cycles",
                    warmed.balance.generated,
                    warmed.balance.carried_out + warmed.balance.conducted,
                ),
            );
        }
        let clearance = case.bearing.radial_clearance;
        header.heat = Some(HeatResults {
            effective_temperature: warmed.mean,
            supply_temperature: self.supply[0],
            outlet_temperature: warmed.outlet,
            conducted: warmed.balance.conducted,
            radial_clearance: clearance,
            given_radial_clearance: clearance,
            trials: Vec::new(),
            field: Some(HeatFieldResults {
                hottest: warmed.hottest,
                generated: warmed.balance.generated,
                carried_out: warmed.balance.carried_out,
                balance_error: warmed.balance.relative_error(),
                changes: changes.to_vec(),
            }),
        });
    }
}
