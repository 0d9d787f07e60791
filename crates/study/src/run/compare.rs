//! The same study once more: without roughness, contact, elastic shell and real oil, and with other
//! models of the film.
//!
//! The plain bearing has smooth surfaces, a rigid shell and an oil of constant viscosity and density at
//! one temperature: that of the heat balance, with the clearance it led to, so that the difference is
//! not one of temperature; that of the supply where the temperature is a field; else the given one.
//!
//! Another model has the temperature and the clearance of the study, and the rules of the film that it
//! is made of. What it leaves out is noted; what it cannot do is refused with the reason.

use super::film_models::adapted;
use super::heat::with_clearance;
use super::{ProgressCallback, header, solve_bearing};
use crate::input::film_models::refusal;
use crate::input::{BearingCase, FilmModel, HeatPlan, Study, Subject};
use crate::progress::ProgressEvent;
use crate::results::{
    Body, Comparison, Header, ModelEnd, ModelRun, PlainRun, Results, status_name,
};
use sommerfeld_film::{Elasticity, Finish, Outcome};
use sommerfeld_oil::Lubricant;
use std::ops::ControlFlow;
use std::time::Instant;

/// The part of the progress bar that the other runs share.
pub(super) struct Bar<'a, 'b> {
    /// Share of the bar that is done, and that of each run.
    done: f64,
    each: f64,
    is_stopped: bool,
    progress: &'a mut ProgressCallback<'b>,
}

impl<'a, 'b> Bar<'a, 'b> {
    /// Behind a share of the bar, for so many runs; `is_stopped` where the caller has asked to stop.
    pub fn new(
        done: f64,
        runs: usize,
        is_stopped: bool,
        progress: &'a mut ProgressCallback<'b>,
    ) -> Self {
        Self {
            done,
            each: (1.0 - done) / runs.max(1) as f64,
            is_stopped,
            progress,
        }
    }

    fn show(&mut self, name: &str, event: ProgressEvent) -> ControlFlow<()> {
        let answer = (self.progress)(ProgressEvent {
            label: format!("{name}, {}", event.label),
            done: self.done + self.each * event.done.clamp(0.0, 1.0),
            ..event
        });
        self.is_stopped |= answer.is_break();
        answer
    }

    fn next(&mut self) {
        self.done += self.each;
    }
}

/// Adds what the study asks to be compared with to its results. A run that does not converge, or that
/// its film refuses, is told in the messages and changes nothing of the results.
pub(super) fn with_others(
    study: &Study,
    results: &mut Results,
    own_wall_time: f64,
    mut bar: Bar<'_, '_>,
) {
    let Subject::Bearing(case) = &study.subject else {
        return;
    };
    if study.film.compares_plain() && !bar.is_stopped {
        with_plain(study, case, results, &mut bar);
        bar.next();
    }
    let mut runs = Vec::new();
    for model in study.film.compared_models() {
        let run = with_model(study, case, model, &results.header, &mut bar);
        bar.next();
        results.header.messages.extend(told(&run));
        runs.push(run);
    }
    if !runs.is_empty() {
        results.header.comparison = Some(Box::new(Comparison {
            own_model: study.film.model.name(),
            own_wall_time,
            runs,
        }));
    }
}

/// Adds the plain run.
fn with_plain(study: &Study, case: &BearingCase, results: &mut Results, bar: &mut Bar<'_, '_>) {
    let start = Instant::now();
    let plain = plain_case(case, &results.header);
    let mut settings = study.clone();
    // The same cells: what is left of the difference is no error of the grid.
    settings.film.grid = results.header.grid.unwrap_or(study.film.grid);
    let mut scratch = header(study);
    let mut progress = |event| bar.show("plain", event);
    let (status, body, reason) =
        match solve_bearing(&plain, &settings, &mut scratch, None, &mut progress) {
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
        wall_time: start.elapsed().as_secs_f64(),
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

/// The study with another model of its film.
fn with_model(
    study: &Study,
    case: &BearingCase,
    model: FilmModel,
    own: &Header,
    bar: &mut Bar<'_, '_>,
) -> ModelRun {
    let mut run = ModelRun {
        model: model.name(),
        end: ModelEnd::NotRun,
        notes: Vec::new(),
        body: None,
        wall_time: 0.0,
    };
    if bar.is_stopped {
        return run;
    }
    let start = Instant::now();
    let case = as_warm_as(case, own);
    if let Some(reason) = refusal(model, &case, &study.film) {
        run.end = ModelEnd::Refused(reason);
        return run;
    }
    let (case, notes) = adapted(model, case, &study.film);
    run.notes = notes;
    let mut settings = study.clone();
    settings.film.model = model;
    settings.film.grid = own.grid.unwrap_or(study.film.grid);
    let mut scratch = header(study);
    let mut progress = |event| bar.show(model.name(), event);
    match solve_bearing(&case, &settings, &mut scratch, None, &mut progress) {
        Ok(body) => {
            run.end = ModelEnd::Ended(scratch.status);
            run.body = Some(without_fields(body));
        }
        Err(error) => run.end = ModelEnd::Refused(error.to_string()),
    }
    run.wall_time = start.elapsed().as_secs_f64();
    if bar.is_stopped {
        run.end = ModelEnd::NotRun;
        run.body = None;
    }
    run
}

/// The bearing at the temperature and with the clearance that its heat led to, its shell not run in.
fn as_warm_as(case: &BearingCase, own: &Header) -> BearingCase {
    let mut warm = match &own.heat {
        Some(heat) => with_clearance(case, heat.radial_clearance, heat.effective_temperature),
        None => case.clone(),
    };
    warm.heat = HeatPlan::Given;
    warm
}

/// What the reader must know of a run that has no good numbers.
fn told(run: &ModelRun) -> Option<String> {
    let model = run.model;
    match &run.end {
        ModelEnd::Ended(Outcome::Converged) => None,
        ModelEnd::Ended(outcome) => Some(format!(
            "comparison: the film model {model} ended {}",
            status_name(*outcome)
        )),
        ModelEnd::Refused(reason) => Some(format!(
            "comparison: the film model {model} was not run: {reason}"
        )),
        ModelEnd::NotRun => Some(format!(
            "interrupted: the comparison with the film model {model} is missing"
        )),
    }
}

fn without_fields(mut body: Body) -> Body {
    match &mut body {
        Body::Steady(steady) => steady.field = None,
        Body::LoadCycle(cycle) => cycle.fields = None,
        Body::Dimensionless(_) | Body::Machine(_) | Body::Database(_) | Body::Sweep(_) => {}
    }
    body
}
