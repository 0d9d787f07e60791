//! The load cycle of every bearing of an engine with rigid parts.
//!
//! Loads are those ON the journal in the frame of its shell; speeds are in the frame of the loads, whose
//! axes turn with the rod for big end and small end:
//! main: journal speed of the throw's shaft at its place, shell 0; big end: speed of its throw minus that
//! of the rod; small end: speed of the pin minus that of the rod; bosses: speed of the pin. Time runs with
//! the mean speed, so the rows stand at crank angles that are mean speed times time.
//!
//! The pin's mass is part of the piston's: the inertia force of the pin itself, which goes from the rod
//! through the small end only, is left in the load of the bosses too.

use crate::mains::{determinate_main_loads, unbalance_forces};
use crate::{
    BearingDuty, CrankMotion, CrankTrain, CylinderInstant, IndicatorDiagram, PinSpeed, Role,
    ShaftForce, WorkingCylinder,
};
use sommerfeld_bearing::{CycleTilt, LoadCycle, LoadPoint};

/// Load cycles of all bearings at `points` even steps of the crank angle from 0: mains (hinge at each
/// main) from the free end, then big ends, small ends and piston bosses by cylinder. Journals stay
/// parallel to their shells and have no mass.
#[must_use]
pub fn bearing_duties(
    train: &CrankTrain,
    diagram: &IndicatorDiagram,
    motion: &CrankMotion,
    pin: &PinSpeed,
    points: usize,
) -> Vec<BearingDuty> {
    let layout = &train.layout;
    let period = train.period();
    let mut rows = Rows::new(layout.mains.len(), layout.cylinders.len(), points);
    let cylinders = WorkingCylinder::all(train, diagram);
    for step in 0..points {
        let crank_angle = period * step as f64 / points as f64;
        let mut forces: Vec<ShaftForce> = Vec::with_capacity(cylinders.len());
        for (index, cylinder) in &cylinders {
            let instant = cylinder.at(motion, crank_angle);
            forces.push(ShaftForce {
                axial: layout.cylinders[*index].axial,
                force: instant.crankpin_force(),
            });
            let pin_speed = pin.at(*index, crank_angle, period, instant.slider.rod_speed);
            rows.add_rod(*index, crank_angle, &instant, pin_speed);
        }
        forces.extend(unbalance_forces(train, motion, crank_angle));
        let loads = determinate_main_loads(&layout.mains, &forces);
        for (index, (main, load)) in layout.mains.iter().zip(loads).enumerate() {
            let speed = motion.at(*main, crank_angle).speed;
            rows.mains[index].push(row(crank_angle, load, speed));
        }
    }
    rows.into_duties(period, motion.speed)
}

/// Rows of the load tables of all bearings, by kind.
struct Rows {
    mains: Vec<Vec<LoadPoint>>,
    big_ends: Vec<Vec<LoadPoint>>,
    small_ends: Vec<Vec<LoadPoint>>,
    piston_bosses: Vec<Vec<LoadPoint>>,
}

impl Rows {
    fn new(mains: usize, cylinders: usize, points: usize) -> Self {
        let tables = |count| vec![Vec::with_capacity(points); count];
        Self {
            mains: tables(mains),
            big_ends: tables(cylinders),
            small_ends: tables(cylinders),
            piston_bosses: tables(cylinders),
        }
    }

    fn add_rod(&mut self, index: usize, crank_angle: f64, at: &CylinderInstant, pin_speed: f64) {
        let rod_speed = at.slider.rod_speed;
        self.big_ends[index].push(row(
            crank_angle,
            at.big_end_load(),
            at.slider.crank.speed - rod_speed,
        ));
        self.small_ends[index].push(row(crank_angle, at.small_end_load(), pin_speed - rod_speed));
        self.piston_bosses[index].push(row(crank_angle, at.piston_boss_load(), pin_speed));
    }

    fn into_duties(self, period: f64, engine_speed: f64) -> Vec<BearingDuty> {
        let kinds = [
            (Role::Main, self.mains),
            (Role::BigEnd, self.big_ends),
            (Role::SmallEnd, self.small_ends),
            (Role::PistonBoss, self.piston_bosses),
        ];
        let duties = kinds.into_iter().flat_map(|(role, tables)| {
            tables
                .into_iter()
                .enumerate()
                .map(move |(index, points)| BearingDuty {
                    role,
                    index,
                    cycle: LoadCycle {
                        points,
                        period,
                        engine_speed,
                        journal_mass: 0.0,
                        tilt: CycleTilt::Aligned,
                        feed_pressures: Vec::new(),
                    },
                })
        });
        duties.collect()
    }
}

/// A row of a load table in the frame of a shell that does not turn in it.
fn row(crank_angle: f64, load: [f64; 2], journal_speed: f64) -> LoadPoint {
    LoadPoint {
        crank_angle,
        load,
        moment: [0.0; 2],
        journal_speed,
        shell_speed: 0.0,
    }
}
