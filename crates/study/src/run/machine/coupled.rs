//! The bearings of one elastic shaft: orbits that answer each other through the shaft.

use super::units::{BearingFound, UnitFound, bearing_case, recorder};
use super::{ProgressCallback, RunError, Work};
use crate::input::{BearingCase, CycleDuty, EnginePlan, HeatPlan, Machine};
use crate::progress::ProgressEvent;
use crate::results::{CycleResults, HeatResults};
use crate::run::cycle::{CycleWatch, WarmStart, orbit_settings};
use crate::run::{conditions, film_of, heat, with_reynolds_number};
use nalgebra::DMatrix;
use rayon::prelude::*;
use sommerfeld_bearing::{CycleTilt, FilmHeat, JointBalance, LoadCycle, OrbitSettings};
use sommerfeld_engine::{
    COUPLED_ERROR_TOLERANCE, CoupledJournal, CoupledRequest, CrankshaftShape, FilmUpdate,
    GeneralShaft, ShaftError, Supports, condensed_crankshaft, condensed_shaft, coupled_orbits_from,
    shaft_forces,
};
use sommerfeld_film::{FilmError, Outcome};
use sommerfeld_flex::CondensedShaft;

/// Forces on a shaft at a shaft angle, rad.
type Forces<'a> = Box<dyn Fn(f64) -> Vec<[f64; 2]> + 'a>;

/// A shaft with what holds and loads it.
struct HeldShaft<'a> {
    shaft: CondensedShaft,
    /// `None` for supports that do not move.
    compliance: Option<DMatrix<f64>>,
    offsets: &'a [[f64; 2]],
    forces: Forces<'a>,
}

/// Rounds of orbits and temperatures at most.
const LARGEST_ROUNDS: usize = 12;

/// The orbits of all bearings of an elastic shaft; of each also the load that hinges would give.
///
/// Where each film finds its own temperature, orbits and temperatures take turns: a temperature settles
/// over many cycles and does not follow one. Each round begins where the one before it ended.
pub(super) fn solve_coupled(
    work: &Work<'_>,
    speed: usize,
    bearings: &[usize],
    progress: &mut ProgressCallback<'_>,
) -> Result<UnitFound, RunError> {
    let shaft = CoupledShaft::of(work, speed, bearings)?;
    let HeatPlan::Balance { path, expansion } = work.plan.heat else {
        return Ok(shaft.round(&shaft.cases, None, progress)?.found);
    };
    let expansion = expansion.as_ref();
    let cold = shaft.cases.iter().map(|(case, _)| case);
    let ranges: Vec<[f64; 2]> = cold
        .map(|case| heat::range(case, path.supply_temperature, expansion))
        .collect();
    let mut balances: Vec<JointBalance> = ranges
        .iter()
        .map(|range| JointBalance::new(path, *range))
        .collect();
    let mut start = None;
    let mut rounds = 0;
    loop {
        let warm = |((case, duty), balance): (&(BearingCase, CycleDuty), &JointBalance)| {
            let warm = heat::warm_case(case, expansion, balance.temperature());
            (warm, duty.clone())
        };
        let cases: Vec<_> = shaft.cases.iter().zip(&balances).map(warm).collect();
        let expected = (LARGEST_ROUNDS / 2).max(rounds + 1) as f64;
        let round = shaft.round(&cases, start.as_deref(), &mut |event| {
            progress(ProgressEvent {
                done: (rounds as f64 + event.done) / expected,
                ..event
            })
        })?;
        rounds += 1;
        let mut is_settled = true;
        for ((found, (case, _)), balance) in round.found.iter().zip(&cases).zip(&mut balances) {
            let film = FilmHeat {
                power: found.orbit.mean_power_loss(),
                side_flow: found.orbit.mean_side_flow(),
                volumetric_heat: heat::volumetric_heat(case),
                outcome: found.orbit.outcome,
            };
            is_settled &= balance.take(&film, heat::CYCLE_TOLERANCE);
        }
        let mut orbits = round.found.iter().map(|found| found.orbit.outcome);
        let solved = orbits.all(|outcome| outcome == Outcome::Converged);
        if solved && !is_settled && rounds < LARGEST_ROUNDS {
            start = Some(round.ends);
            continue;
        }
        let each = round.found.into_iter().zip(cases).zip(&balances);
        let found = each.zip(&ranges).map(|(((mut found, (case, _)), balance), range)| {
            let last = balance.trials().last();
            let effective = last.map_or(path.supply_temperature, |trial| trial.temperature);
            if solved && (!is_settled || balance.is_at_end()) {
                found.mark_not_converged();
                let place = work.place(speed, found.bearing);
                found.notes.push(if balance.is_at_end() {
                    format!("{place}: {}", heat::no_balance(*range, effective))
                } else {
                    format!("{place}: the temperatures on the shaft still move after {rounds} rounds")
                });
            }
            found.heat = Some(HeatResults {
                effective_temperature: effective,
                supply_temperature: path.supply_temperature,
                outlet_temperature: balance.outlet_temperature(),
                conducted: balance.conducted(),
                radial_clearance: case.bearing.radial_clearance,
                given_radial_clearance: work.speeds[speed].bearings[found.bearing].radial_clearance,
                trials: balance.trials().iter().map(|trial| trial.temperature).collect(),
                field: None,
            });
            found
        });
        return Ok(found.collect());
    }
}

/// An elastic shaft with its bearings, before their temperatures are known.
struct CoupledShaft<'a> {
    work: &'a Work<'a>,
    speed: usize,
    bearings: &'a [usize],
    held: HeldShaft<'a>,
    cases: Vec<(BearingCase, CycleDuty)>,
}

/// What the orbits of a shaft left.
struct Round {
    found: UnitFound,
    /// Where those of a shaft that differs little may begin.
    ends: Vec<WarmStart>,
}

impl<'a> CoupledShaft<'a> {
    fn of(work: &'a Work<'a>, speed: usize, bearings: &'a [usize]) -> Result<Self, RunError> {
        let held = HeldShaft::of(work, speed, bearings.len());
        let held = held.map_err(|error| RunError::Machine {
            place: work.place(speed, bearings[0]),
            reason: error.to_string(),
        })?;
        let case = |bearing: &usize| {
            let free = LoadCycle {
                tilt: CycleTilt::Free,
                ..work.speeds[speed].cycles[*bearing].clone()
            };
            bearing_case(work, speed, *bearing, free)
        };
        Ok(Self {
            work,
            speed,
            bearings,
            held,
            cases: bearings.iter().map(case).collect(),
        })
    }

    /// The orbits of the bearings as they are in `cases`, from rest or from where others ended.
    fn round(
        &self,
        cases: &[(BearingCase, CycleDuty)],
        starts: Option<&[WarmStart]>,
        progress: &mut ProgressCallback<'_>,
    ) -> Result<Round, RunError> {
        let (work, speed) = (self.work, self.speed);
        let failed = |error: FilmError| RunError::Machine {
            place: work.place(speed, self.bearings[0]),
            reason: error.to_string(),
        };
        let films = cases.iter().map(|(case, _)| film_of(case, work.film));
        let mut films = films.collect::<Result<Vec<_>, _>>().map_err(failed)?;
        for (film, start) in films.iter_mut().zip(starts.into_iter().flatten()) {
            film.restore(&start.content);
        }
        let states =
            starts.map(|starts| starts.iter().map(|start| start.state).collect::<Vec<_>>());
        let watches = cases.iter();
        let mut watches: Vec<CycleWatch<'_>> = watches
            .map(|(case, duty)| CycleWatch::new(duty, recorder(case, duty, speed)))
            .collect();
        let journals = films.iter_mut().zip(cases).enumerate();
        let journals = journals.map(|(at, (film, (case, duty)))| CoupledJournal {
            film: film.as_mut(),
            bearing: &case.bearing,
            duty: &duty.cycle,
            conditions: conditions(case),
            offset: self.held.offsets.get(at).copied().unwrap_or([0.0; 2]),
        });
        let (_, duty) = &cases[0];
        let settings = OrbitSettings {
            error_tolerance: COUPLED_ERROR_TOLERANCE * duty.step_error_factor,
            ..orbit_settings(duty)
        };
        let side_by_side =
            |updates: &mut [FilmUpdate<'_>]| updates.par_iter_mut().for_each(FilmUpdate::run);
        let request = CoupledRequest {
            shaft: &self.held.shaft,
            compliance: self.held.compliance.as_ref(),
            forces: self.held.forces.as_ref(),
            settings: &settings,
            executor: &side_by_side,
        };
        let found = coupled_orbits_from(
            journals.collect(),
            states.as_deref(),
            &request,
            &mut |at, point, film, stage| watches[at].see(point, film, stage, progress),
        )
        .map_err(failed)?;
        let ends = found.orbits.iter().zip(&films);
        let ends = ends.filter_map(|(orbit, film)| {
            Some(WarmStart {
                state: orbit.points.last()?.state,
                content: film.history(),
            })
        });
        let ends: Vec<WarmStart> = ends.collect();
        let orbits = found.orbits.into_iter().zip(found.cycles);
        let all = self.bearings.iter().zip(cases).zip(watches).zip(orbits);
        let all = all.map(|(((bearing, (case, _)), watch), (mut orbit, load))| {
            for point in &mut orbit.points {
                point.summary = with_reynolds_number(point.summary, case, &point.state);
            }
            let hinges = &work.speeds[speed].cycles[*bearing];
            let points = orbit.points.iter();
            let determinate = points.map(|point| load_at(hinges, point.crank_angle));
            let determinate: Vec<[f64; 2]> = determinate.collect();
            let results: CycleResults = watch.finish(case, &load, orbit, Vec::new()).results;
            BearingFound {
                determinate_load: Some(determinate),
                ..BearingFound::of(*bearing, load, results)
            }
        });
        Ok(Round {
            found: all.collect(),
            ends,
        })
    }
}

/// The load of a table of even rows at the row nearest to a crank angle.
fn load_at(cycle: &LoadCycle, crank_angle: f64) -> [f64; 2] {
    let count = cycle.points.len();
    let Some(first) = cycle.points.first() else {
        return [f64::NAN; 2];
    };
    let turned = (crank_angle - first.crank_angle).rem_euclid(cycle.period);
    let row = (turned / cycle.period * count as f64).round() as usize % count;
    cycle.points[row].load
}

impl<'a> HeldShaft<'a> {
    fn of(work: &'a Work<'_>, speed: usize, bearings: usize) -> Result<Self, ShaftError> {
        match &work.plan.machine {
            Machine::Engine(engine) => match &engine.mains {
                sommerfeld_engine::Mains::Elastic {
                    shape,
                    supports,
                    offsets,
                } => Self::of_engine(work, engine, speed, shape, (supports, bearings), offsets),
                sommerfeld_engine::Mains::Determinate => Err(ShaftError::Value {
                    name: "elastic crankshaft",
                    value: 0.0,
                    allowed: "given for mains that answer each other",
                }),
            },
            Machine::Shaft(shaft) => Self::of_shaft(work, shaft, speed, bearings),
        }
    }

    fn of_engine(
        work: &'a Work<'_>,
        engine: &'a EnginePlan,
        speed: usize,
        shape: &CrankshaftShape,
        (supports, bearings): (&Supports, usize),
        offsets: &'a [[f64; 2]],
    ) -> Result<Self, ShaftError> {
        let motion = &work.speeds[speed].motion;
        let diagram = engine.gas.diagram_at(motion.speed);
        let forces = move |angle| {
            let forces = shaft_forces(&engine.train, &diagram, motion, angle);
            forces.iter().map(|force| force.force).collect()
        };
        let rods = engine.train.layout.cylinders.iter().map(|on| on.axial);
        let turning = engine.train.unbalances.iter().map(|on| on.axial);
        let places: Vec<f64> = rods.chain(turning).collect();
        Ok(Self {
            shaft: condensed_crankshaft(&engine.train, shape, &places)?,
            compliance: compliance(supports, bearings)?,
            offsets,
            forces: Box::new(forces),
        })
    }

    fn of_shaft(
        work: &Work<'_>,
        shaft: &'a GeneralShaft,
        speed: usize,
        bearings: usize,
    ) -> Result<Self, ShaftError> {
        let speed = work.speeds[speed].motion.speed;
        let forces = move |angle| {
            let forces = shaft.forces(speed, angle);
            forces.iter().map(|force| force.force).collect()
        };
        Ok(Self {
            shaft: condensed_shaft(shaft)?,
            compliance: compliance(&shaft.supports, bearings)?,
            offsets: &shaft.offsets,
            forces: Box::new(forces),
        })
    }
}

fn compliance(supports: &Supports, bearings: usize) -> Result<Option<DMatrix<f64>>, ShaftError> {
    match supports {
        Supports::Rigid => Ok(None),
        yielding => yielding.compliance(bearings).map(Some),
    }
}
