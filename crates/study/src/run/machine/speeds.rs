//! A machine at one speed: its motion, its gas, and what every bearing has to do.

use super::RunError;
use crate::input::{EnginePlan, Machine, MachinePlan};
use crate::results::machine::speed_words;
use sommerfeld_bearing::LoadCycle;
use sommerfeld_engine::{
    BearingDuty, CrankMotion, Performance, PinFit, PinSpeed, Role, TorsionResponse, bearing_duties,
    performance,
};
use sommerfeld_film::{Bearing, FilmError};

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
            Machine::Shaft(_) => Err(RunError::Film(FilmError::Unsupported {
                reason: "the analysis shaft is not built yet",
            })),
        }
    }

    fn of_engine(plan: &MachinePlan, engine: &EnginePlan, speed: f64) -> Result<Self, RunError> {
        let train = &engine.train;
        let points = (plan.period() / plan.orbit.crank_step).round().max(1.0) as usize;
        let diagram = engine.gas.diagram_at(speed);
        let motion = CrankMotion::even(speed);
        let pin = first_pin_speed(plan, engine.pin_fit);
        let duties = bearing_duties(train, &diagram, &motion, &pin, points);
        Self {
            performance: Some(performance(train, &diagram, &motion, points)),
            period: plan.period(),
            torsion: None,
            motion,
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
