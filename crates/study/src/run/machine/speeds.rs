//! A machine at one speed: its motion, its gas, and what every bearing has to do.

use super::RunError;
use crate::input::{EnginePlan, Machine, MachinePlan};
use crate::results::machine::speed_words;
use sommerfeld_bearing::{CycleTilt, LoadCycle, LoadPoint};
use sommerfeld_engine::{
    BearingDuty, CrankMotion, GeneralShaft, Performance, PinFit, PinSpeed, RippleSettings, Role,
    TorsionResponse, bearing_duties, determinate_main_loads, engine_ripple, performance,
};
use sommerfeld_film::{Bearing, FilmError, Outcome};

/// Orders of the crankshaft up to which its torsional vibration is followed.
const HIGHEST_ORDER: f64 = 12.0;

/// A machine at one speed before any film is solved.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpeedLoads {
    /// Motion of the crankshaft or shaft.
    pub motion: CrankMotion,
    /// Crank angle after which everything repeats, rad.
    pub period: f64,
    /// Gas, torque and orders; `None` for a shaft.
    pub performance: Option<Performance>,
    /// Torsional vibration, where it is followed.
    pub torsion: Option<TorsionResponse>,
    /// What did not converge before any film was solved.
    pub notes: Vec<String>,
    /// Each bearing as it is supplied at this speed, in the order of the plan.
    pub bearings: Vec<Bearing>,
    /// Its load cycle; hinges at the mains.
    pub cycles: Vec<LoadCycle>,
}

impl SpeedLoads {
    /// The loads at a speed, rad/s.
    pub(super) fn of(plan: &MachinePlan, speed: f64) -> Result<Self, RunError> {
        match &plan.machine {
            Machine::Engine(engine) => Self::of_engine(plan, engine, speed),
            Machine::Shaft(shaft) => Self::of_shaft(plan, shaft, speed),
        }
    }

    fn of_shaft(plan: &MachinePlan, shaft: &GeneralShaft, speed: f64) -> Result<Self, RunError> {
        let points = points(plan);
        let angles = (0..points).map(|step| shaft.period * step as f64 / points as f64);
        let rows: Vec<(f64, Vec<[f64; 2]>)> = angles
            .map(|angle| {
                let forces = shaft.forces(speed, angle);
                (angle, determinate_main_loads(&shaft.bearings, &forces))
            })
            .collect();
        let duty = |index: usize| BearingDuty {
            role: Role::Shaft,
            index,
            cycle: LoadCycle {
                points: rows
                    .iter()
                    .map(|(angle, loads)| LoadPoint {
                        crank_angle: *angle,
                        load: loads[index],
                        moment: [0.0; 2],
                        journal_speed: speed,
                        shell_speed: 0.0,
                    })
                    .collect(),
                period: shaft.period,
                engine_speed: speed,
                journal_mass: 0.0,
                tilt: CycleTilt::Aligned,
                feed_pressures: Vec::new(),
            },
        };
        let duties: Vec<BearingDuty> = (0..shaft.bearings.len()).map(duty).collect();
        Self {
            motion: CrankMotion::even(speed),
            period: plan.period(),
            performance: None,
            torsion: None,
            notes: Vec::new(),
            bearings: Vec::new(),
            cycles: Vec::new(),
        }
        .with_duties(plan, &duties)
    }

    fn of_engine(plan: &MachinePlan, engine: &EnginePlan, speed: f64) -> Result<Self, RunError> {
        let train = &engine.train;
        let points = points(plan);
        let diagram = engine.gas.diagram_at(speed);
        let mut notes = Vec::new();
        let (motion, torsion) = match &engine.torsion {
            None => (CrankMotion::even(speed), None),
            Some(chain) => {
                let usual = RippleSettings::default();
                let found =
                    engine_ripple(train, &diagram, chain, speed, points, HIGHEST_ORDER, usual);
                let found = found.map_err(|error| RunError::Machine {
                    place: format!("torsion at {}", speed_words(speed)),
                    reason: error.to_string(),
                })?;
                if found.outcome != Outcome::Converged {
                    notes.push(format!(
                        "torsion at {}: not converged, harmonics of the twist still move by {:.1e} \
                         of the largest after {} evaluations; the loads are those of this ripple",
                        speed_words(speed),
                        found.change,
                        found.iterations
                    ));
                }
                (found.motion, Some(found.response))
            }
        };
        let pin = first_pin_speed(plan, engine.pin_fit);
        let duties = bearing_duties(train, &diagram, &motion, &pin, points);
        Self {
            performance: Some(performance(train, &diagram, &motion, points)),
            period: plan.period(),
            torsion,
            motion,
            notes,
            bearings: Vec::new(),
            cycles: Vec::new(),
        }
        .with_duties(plan, &duties)
    }

    /// The bearings of the plan with their duties.
    fn with_duties(mut self, plan: &MachinePlan, duties: &[BearingDuty]) -> Result<Self, RunError> {
        for planned in &plan.bearings {
            let is_its =
                |duty: &&BearingDuty| (duty.role, duty.index) == (planned.role, planned.index);
            let duty = duties.iter().find(is_its);
            let duty = duty.ok_or_else(|| RunError::Bearing {
                place: format!("{} at {}", planned.name, speed_words(self.motion.speed)),
                source: FilmError::Unsupported {
                    reason: "the machine has no such bearing",
                },
            })?;
            let (bearing, feed_pressures) = plan.supplied(planned, self.motion.speed);
            self.bearings.push(bearing);
            self.cycles.push(LoadCycle {
                feed_pressures,
                ..duty.cycle.clone()
            });
        }
        Ok(self)
    }
}

/// Rows of the results over one period.
pub(super) fn points(plan: &MachinePlan) -> usize {
    (plan.period() / plan.orbit.crank_step).round().max(1.0) as usize
}

/// How fast the piston pins turn before their films are known. Without films on both sides nothing
/// asks for the speed of a floating pin.
fn first_pin_speed(plan: &MachinePlan, fit: PinFit) -> PinSpeed {
    let of = |role| plan.bearings.iter().find(|bearing| bearing.role == role);
    match (fit, of(Role::SmallEnd), of(Role::PistonBoss)) {
        (fit, Some(small_end), Some(boss)) => PinSpeed::of(fit, &small_end.bearing, &boss.bearing),
        (PinFit::FixedInRod, ..) => PinSpeed::Share(1.0),
        (PinFit::Given(share), ..) => PinSpeed::Share(share),
        (PinFit::Floating | PinFit::FixedInPiston, ..) => PinSpeed::Share(0.0),
    }
}
