//! The results of a machine from what its units found, and what the reader must know of them.

use super::Work;
use super::units::{BearingFound, UnitFound};
use crate::input::{HeatPlan, MachineBearing, MachinePlan};
use crate::regime::FlowRegime;
use crate::results::machine::{BearingResults, MachineResults, SpeedResults, TurnedFrom};
use crate::results::{CycleResults, Header};
use crate::run::cycle::without_orbit;
use crate::run::{edge_contact_message, outcome_message};
use crate::sanity::{self, Hottest};
use sommerfeld_bearing::LoadCycle;
use sommerfeld_film::{Bearing, Outcome};
use std::collections::BTreeMap;

/// Bearings named one by one among the messages; all of them are in the table.
const NAMED: usize = 20;

/// Puts every bearing in its place; one that was not done has no orbit.
pub(super) fn assemble(
    work: Work<'_>,
    found: BTreeMap<usize, UnitFound>,
    header: &mut Header,
) -> MachineResults {
    let mut by_place: BTreeMap<(usize, usize), BearingFound> = BTreeMap::new();
    for (unit, bearings) in found {
        let speed = work.units[unit].speed;
        by_place.extend(
            bearings
                .into_iter()
                .map(|found| ((speed, found.bearing), found)),
        );
    }
    let mut notes = Vec::new();
    let mut speeds = Vec::new();
    for (at, speed) in work.speeds.into_iter().enumerate() {
        let is_settled = speed.notes.is_empty();
        notes.extend(speed.notes);
        let mut bearings = Vec::new();
        let duties = speed.bearings.into_iter().zip(speed.cycles);
        for (index, (planned, (bearing, cycle))) in
            work.plan.bearings.iter().zip(duties).enumerate()
        {
            let found = by_place.remove(&(at, index));
            notes.extend(found.iter().flat_map(|found| found.notes.clone()));
            let turned_from = turned_from(work.plan, found.as_ref());
            bearings.push(BearingResults {
                turned_from,
                ..bearing_results(planned, bearing, cycle, found)
            });
        }
        let mean_power = bearings.iter().map(mean_power_loss).sum::<f64>();
        // Work of the period over the swept volume.
        let work_lost = mean_power * speed.period / speed.motion.speed;
        let swept = speed.performance.as_ref().map(|engine| engine.swept_volume);
        speeds.push(SpeedResults {
            speed: speed.motion.speed,
            outcome: match outcome_of(bearings.iter()) {
                Outcome::Converged if !is_settled => Outcome::NotConverged,
                outcome => outcome,
            },
            friction_mean_effective_pressure: swept.map(|swept| work_lost / swept),
            performance: speed.performance,
            torsion: speed.torsion,
            bearings,
        });
    }
    let machine = MachineResults {
        load_model: super::load_model(work.plan),
        speeds,
    };
    let all = machine.bearings().map(|(_, bearing)| bearing);
    header.status = match outcome_of(all) {
        Outcome::Converged if !notes.is_empty() => Outcome::NotConverged,
        outcome => outcome,
    };
    let mut messages = messages(&machine, work.plan, &header.analysis);
    messages.extend(notes);
    messages.append(&mut header.messages);
    header.messages = messages;
    machine
}

fn bearing_results(
    planned: &MachineBearing,
    bearing: Bearing,
    cycle: LoadCycle,
    found: Option<BearingFound>,
) -> BearingResults {
    let (load, determinate_load, heat, cycle) = match found {
        None => {
            let none = without_orbit(&bearing, Outcome::NotConverged);
            (cycle, None, None, none)
        }
        Some(found) => (
            found.load,
            found.determinate_load,
            found.heat.clone(),
            CycleResults {
                bearing: match &found.heat {
                    None => bearing,
                    Some(heat) => Bearing {
                        radial_clearance: heat.radial_clearance,
                        ..bearing
                    },
                },
                orbit: found.orbit,
                feed_flows: found.feed_flows,
                fields: found.fields,
                coefficients: Vec::new(),
                running_in: None,
            },
        ),
    };
    BearingResults {
        name: planned.name.clone(),
        role: planned.role,
        index: planned.index,
        load,
        determinate_load,
        turned_from: None,
        heat,
        cycle,
    }
}

/// The bearing by its name whose orbit this is.
fn turned_from(plan: &MachinePlan, found: Option<&BearingFound>) -> Option<TurnedFrom> {
    let (bearing, later_by) = found?.turned_from?;
    Some(TurnedFrom {
        name: plan.bearings.get(bearing)?.name.clone(),
        later_by,
    })
}

fn mean_power_loss(bearing: &BearingResults) -> f64 {
    bearing.cycle.mean(|point| point.summary.power_loss())
}

/// Converged only if all are; the outcome they share, if those that failed share one.
fn outcome_of<'b>(bearings: impl Iterator<Item = &'b BearingResults>) -> Outcome {
    let mut failed = bearings
        .map(|bearing| bearing.cycle.orbit.outcome)
        .filter(|outcome| *outcome != Outcome::Converged);
    match failed.next() {
        None => Outcome::Converged,
        Some(first) if failed.all(|other| other == first) => first,
        Some(_) => Outcome::NotConverged,
    }
}

/// Orbits that are missing, orbits that did not converge, results beyond what they can mean.
fn messages(machine: &MachineResults, plan: &MachinePlan, analysis: &str) -> Vec<String> {
    let mut messages = Vec::new();
    let (missing, total) = (machine.missing(), machine.bearings().count());
    if missing > 0 {
        messages.push(format!(
            "interrupted: {} of {total} orbits are done; run the same command again to do the rest",
            total - missing
        ));
    }
    let mut told = Vec::new();
    let mut advice: Vec<&str> = Vec::new();
    for (speed, bearing) in machine.bearings() {
        let outcome = bearing.cycle.orbit.outcome;
        if outcome == Outcome::Converged || bearing.is_missing() || is_closed(bearing, plan) {
            continue;
        }
        told.push(format!(
            "{}: {}",
            speed.place(bearing),
            how_it_ended(bearing)
        ));
        let general = outcome_message(outcome, analysis).filter(|text| !advice.contains(text));
        advice.extend(general);
    }
    let more = told.len().saturating_sub(NAMED);
    messages.extend(told.into_iter().take(NAMED));
    if more > 0 {
        messages.push(format!(
            "{more} more orbits did not converge: see bearings.csv"
        ));
    }
    messages.extend(advice.into_iter().map(str::to_owned));
    messages.extend(beyond_the_physics(machine, plan));
    messages
}

/// The orbit itself closed: a note says what else did not converge.
fn is_closed(bearing: &BearingResults, plan: &MachinePlan) -> bool {
    let cycle = &bearing.cycle;
    cycle.orbit.outcome == Outcome::NotConverged
        && cycle.orbit.closure <= plan.orbit.closure_tolerance
        && cycle.not_converged().next().is_none()
}

/// Where and how an orbit failed.
fn how_it_ended(bearing: &BearingResults) -> String {
    let cycle = &bearing.cycle;
    let clearance = cycle.bearing.radial_clearance;
    if let Some((angle, edge)) = cycle.orbit.edge_contact(&bearing.load, clearance) {
        let at = format!("at crank angle {:.1} deg", angle.to_degrees());
        return edge_contact_message(edge, &at);
    }
    let points = cycle.not_converged().count();
    let first = cycle.not_converged().next();
    match (cycle.orbit.outcome, first) {
        (Outcome::Starved, _) => "starved, no oil enters".to_owned(),
        (Outcome::NoSolution, Some(point)) => {
            format!(
                "no solution at crank angle {:.1} deg",
                point.crank_angle.to_degrees()
            )
        }
        (Outcome::NoSolution, None) => "no solution".to_owned(),
        (_, Some(point)) => format!(
            "not converged at {points} of {} crank angles, first at {:.1} deg",
            cycle.orbit.points.len(),
            point.crank_angle.to_degrees()
        ),
        (_, None) => format!(
            "the orbit has not closed after {} cycles (closure {:.1e})",
            cycle.orbit.cycles, cycle.orbit.closure
        ),
    }
}

/// Results that smooth rigid surfaces, a laminar film or an oil do not stand for: of each bearing the worst
/// speed.
fn beyond_the_physics(machine: &MachineResults, plan: &MachinePlan) -> Vec<String> {
    let bearings = machine
        .speeds
        .first()
        .map_or(0, |first| first.bearings.len());
    let worst = |index: usize, value: &dyn Fn(&BearingResults) -> Option<f64>| {
        let at = machine.speeds.iter().filter_map(move |speed| {
            let bearing = speed.bearings.get(index)?;
            let value = value(bearing).filter(|value| value.is_finite())?;
            Some((speed.place(bearing), value))
        });
        at.reduce(|best, next| if next.1 > best.1 { next } else { best })
    };
    let hot_film = |what, temperature| {
        let hottest = Hottest { what, temperature };
        sanity::hot_film(&hottest, &plan.lubricant, &plan.heat)
    };
    let mut messages = Vec::new();
    for index in 0..bearings {
        let thinnest = worst(index, &|bearing| {
            let point = bearing.cycle.minimum_film_thickness()?;
            Some(-point.summary.minimum_film_thickness.value)
        });
        let peak = worst(index, &|bearing| {
            let point = bearing.cycle.peak_film_pressure()?;
            Some(point.summary.peak_film_pressure.value)
        });
        let fastest = worst(index, &|bearing| {
            Some(FlowRegime::of_cycle(&bearing.cycle)?.reynolds_number)
        });
        let hottest = worst(index, &|bearing| {
            Some(Hottest::of(bearing.heat.as_ref()?).temperature)
        });
        let cycle = &machine.speeds[0].bearings[index].cycle;
        let knows_contact = cycle.bearing.finish.has_contact();
        let thinnest = thinnest
            .filter(|_| !knows_contact)
            .and_then(|(place, film)| Some((place, sanity::thin_film(-film)?)));
        let peak = peak.and_then(|(place, peak)| Some((place, sanity::high_pressure(peak)?)));
        let fastest = fastest.and_then(|(place, number)| {
            Some((place, FlowRegime::of(&cycle.bearing, number)?.warning()?))
        });
        let hottest =
            hottest.and_then(|(place, at)| Some((place, hot_film(Hottest::EFFECTIVE, at)?)));
        let found = [thinnest, peak, fastest, hottest].into_iter().flatten();
        messages.extend(found.map(|(place, text)| format!("{place}: {text}")));
    }
    if plan.heat == HeatPlan::Given {
        messages.extend(hot_film(Hottest::GIVEN, plan.temperature));
    }
    messages
}
