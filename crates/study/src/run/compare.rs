//! How much do roughness, contact, elastic shell and real oil change? The same study without them.
//!
//! The plain bearing has smooth surfaces, a rigid shell and an oil of constant viscosity and density at
//! one temperature: that of the heat balance, with the clearance it led to, so that the difference is
//! not one of temperature; that of the supply where the temperature is a field; else the given one.

use super::heat::with_clearance;
use super::{ProgressCallback, header, solve_bearing};
use crate::input::{BearingCase, HeatPlan, Study, Subject};
use crate::results::{Body, Header, PlainRun, Results, status_name};
use sommerfeld_film::{Elasticity, Finish, Outcome};
use sommerfeld_oil::Lubricant;

/// Adds the plain run to the results of `study`. One that does not converge, or that its film refuses,
/// is told in the messages and changes nothing of the results.
pub(super) fn with_plain(
    study: &Study,
    results: &mut Results,
    progress: &mut ProgressCallback<'_>,
) {
    let Subject::Bearing(case) = &study.subject else {
        return;
    };
    let plain = plain_case(case, &results.header);
    let mut settings = study.clone();
    // The same cells: what is left of the difference is no error of the grid.
    settings.film.grid = results.header.grid.unwrap_or(study.film.grid);
    let mut scratch = header(study);
    let (status, body, reason) =
        match solve_bearing(&plain, &settings, &mut scratch, None, progress) {
            Ok(body) => (scratch.status, Some(without_fields(body)), None),
            Err(error) => (Outcome::NoSolution, None, Some(error.to_string())),
        };
    if status != Outcome::Converged {
        let reason = reason.map_or_else(String::new, |reason| format!(": {reason}"));
        results.header.messages.push(format!(
            "comparison: the plain bearing, of smooth surfaces and constant oil, ended {}{reason}",
            status_name(status)
        ));
    }
    results.header.plain = Some(Box::new(PlainRun {
        temperature: plain.temperature,
        status,
        body,
    }));
}

/// The bearing of a case without what makes it real.
fn plain_case(case: &BearingCase, header: &Header) -> BearingCase {
    let mut plain = match (&case.heat, &header.heat) {
        (HeatPlan::Balance { .. }, Some(heat)) => {
            with_clearance(case, heat.radial_clearance, heat.effective_temperature)
        }
        (heat, _) => {
            let supply = heat.path().map(|path| path.supply_temperature);
            let clearance = case.bearing.radial_clearance;
            with_clearance(case, clearance, supply.unwrap_or(case.temperature))
        }
    };
    plain.heat = HeatPlan::Given;
    plain.bearing.finish = Finish::Smooth;
    plain.bearing.elasticity = Elasticity::Rigid;
    let oil = case.lubricant.reference_state(plain.temperature);
    plain.lubricant = Lubricant::constant(oil.viscosity, oil.density);
    plain
}

fn without_fields(mut body: Body) -> Body {
    match &mut body {
        Body::Steady(steady) => steady.field = None,
        Body::LoadCycle(cycle) => cycle.fields = None,
        Body::Dimensionless(_) | Body::Machine(_) | Body::Sweep(_) => {}
    }
    body
}
