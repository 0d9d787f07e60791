//! The bearings of one elastic shaft: orbits that answer each other through the shaft.

use super::units::{BearingFound, UnitFound, bearing_case, recorder};
use super::{ProgressCallback, RunError, Work};
use crate::input::{BearingCase, CycleDuty, EnginePlan, Machine};
use crate::results::CycleResults;
use crate::run::cycle::{CycleWatch, orbit_settings};
use crate::run::{conditions, film_of, with_reynolds_number};
use nalgebra::DMatrix;
use rayon::prelude::*;
use sommerfeld_bearing::{CycleTilt, LoadCycle, OrbitSettings};
use sommerfeld_engine::{
    COUPLED_ERROR_TOLERANCE, CoupledJournal, CoupledRequest, CrankshaftShape, FilmUpdate,
    GeneralShaft, ShaftError, Supports, condensed_crankshaft, condensed_shaft, coupled_orbits,
    shaft_forces,
};
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

/// The orbits of all bearings of an elastic shaft; of each also the load that hinges would give.
pub(super) fn solve_coupled(
    work: &Work<'_>,
    speed: usize,
    bearings: &[usize],
    progress: &mut ProgressCallback<'_>,
) -> Result<UnitFound, RunError> {
    let refused = |reason: String| RunError::Machine {
        place: work.place(speed, bearings[0]),
        reason,
    };
    let held = HeldShaft::of(work, speed, bearings.len()).map_err(|e| refused(e.to_string()))?;
    let cases: Vec<(BearingCase, CycleDuty)> = bearings
        .iter()
        .map(|bearing| {
            let free = LoadCycle {
                tilt: CycleTilt::Free,
                ..work.speeds[speed].cycles[*bearing].clone()
            };
            bearing_case(work, speed, *bearing, free)
        })
        .collect();
    let failed = |error: sommerfeld_film::FilmError| refused(error.to_string());
    let mut films = cases
        .iter()
        .map(|(case, _)| film_of(case, work.film))
        .collect::<Result<Vec<_>, _>>()
        .map_err(failed)?;
    let mut watches: Vec<CycleWatch<'_>> = cases
        .iter()
        .map(|(case, duty)| CycleWatch::new(duty, recorder(case, duty, speed)))
        .collect();
    let journals = films.iter_mut().zip(&cases).enumerate();
    let journals = journals.map(|(at, (film, (case, duty)))| CoupledJournal {
        film: film.as_mut(),
        bearing: &case.bearing,
        duty: &duty.cycle,
        conditions: conditions(case),
        offset: held.offsets.get(at).copied().unwrap_or([0.0; 2]),
    });
    let (_, duty) = &cases[0];
    let settings = OrbitSettings {
        error_tolerance: COUPLED_ERROR_TOLERANCE * duty.step_error_factor,
        ..orbit_settings(duty)
    };
    let side_by_side =
        |updates: &mut [FilmUpdate<'_>]| updates.par_iter_mut().for_each(FilmUpdate::run);
    let request = CoupledRequest {
        shaft: &held.shaft,
        compliance: held.compliance.as_ref(),
        forces: held.forces.as_ref(),
        settings: &settings,
        executor: &side_by_side,
    };
    let found = coupled_orbits(
        journals.collect(),
        &request,
        &mut |at, point, film, stage| watches[at].see(point, film, stage, progress),
    )
    .map_err(failed)?;
    let orbits = found.orbits.into_iter().zip(found.cycles);
    let all = bearings.iter().zip(cases).zip(watches).zip(orbits);
    let all = all.map(|(((bearing, (case, _)), watch), (mut orbit, load))| {
        for point in &mut orbit.points {
            point.summary = with_reynolds_number(point.summary, &case, &point.state);
        }
        let hinges = &work.speeds[speed].cycles[*bearing];
        let determinate = orbit
            .points
            .iter()
            .map(|point| load_at(hinges, point.crank_angle));
        let determinate: Vec<[f64; 2]> = determinate.collect();
        let results: CycleResults = watch.finish(&case, &load, orbit, Vec::new()).results;
        BearingFound {
            determinate_load: Some(determinate),
            ..BearingFound::of(*bearing, load, results)
        }
    });
    Ok(all.collect())
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
