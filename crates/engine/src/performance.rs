//! What an engine gives and how it shakes: torque, mean effective pressure, orders.
//!
//! Torque of a throw: moment of the rod's force on its pin. Work of the gas over a cycle: the integral of
//! its torque, i.e. of p dV. The shaking force is what it takes to accelerate pistons, rods and unbalances,
//! reversed; the block feels it together with the gas on the heads, which the mains and the side thrust
//! return. Mean torque and work are Gauss sums between the kinks of the indicator diagram, to round-off
//! for a shaft that turns evenly; the rows are values at their crank angles.

use crate::mains::{resultant, unbalance_forces};
use crate::{
    CrankMotion, CrankTrain, CylinderInstant, Harmonic, IndicatorDiagram, ShaftForce, SliderCrank,
    WorkingCylinder, harmonics,
};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Highest order that is told: excitation of higher ones is small.
const HIGHEST_ORDER: f64 = 12.0;

/// Torque, work and shaking of an engine over one working cycle, at evenly spaced crank angles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Performance {
    /// Crank angles, rad, from 0, ascending, evenly spaced over one period, the last one before its end.
    pub crank_angles: Vec<f64>,
    /// Absolute gas pressure in cylinder 1, Pa.
    pub gas_pressure: Vec<f64>,
    /// Volume that piston 1 has left behind since it stood nearest to the head, m3.
    pub displaced_volume: Vec<f64>,
    /// Torque of gas and inertia on the crankshaft, N m, in the sense of rotation.
    pub torque: Vec<f64>,
    /// Torque of the gas alone, N m.
    pub gas_torque: Vec<f64>,
    /// Mean torque, N m.
    pub mean_torque: f64,
    /// Indicated mean effective pressure, Pa: work of the gas over one cycle and the swept volume.
    pub indicated_mean_effective_pressure: f64,
    /// Swept volume of all cylinders, m3.
    pub swept_volume: f64,
    /// Force of the moving parts on the engine block without the gas, N, x and y of the engine frame.
    pub shaking_force: Vec<[f64; 2]>,
    /// Moment of that force about x and y through the middle of the mains, N m.
    pub shaking_moment: Vec<[f64; 2]>,
    /// Piston side thrust of each cylinder, N, ON the piston towards y of a cylinder whose axis is x.
    pub side_thrust: Vec<Vec<f64>>,
    /// Harmonics of the torque, N m.
    pub torque_orders: Vec<Harmonic>,
    /// Harmonics of the shaking force along x and y, N.
    pub force_orders: [Vec<Harmonic>; 2],
    /// Harmonics of the shaking moment about x and y, N m.
    pub moment_orders: [Vec<Harmonic>; 2],
}

/// Torque, work and shaking of an engine at `points` even steps of the crank angle from 0.
#[must_use]
pub fn performance(
    train: &CrankTrain,
    diagram: &IndicatorDiagram,
    motion: &CrankMotion,
    points: usize,
) -> Performance {
    let period = train.period();
    let cylinders = train.layout.cylinders.len();
    let mut found = Performance::empty(cylinders, points);
    let middle = middle_of_mains(&train.layout.mains);
    let working = WorkingCylinder::all(train, diagram);
    for step in 0..points {
        let crank_angle = period * step as f64 / points as f64;
        found.add_row(train, &working, motion, crank_angle, middle);
    }
    let area = train.piston_area();
    found.swept_volume = cylinders as f64 * area * SliderCrank::of(train).stroke();
    let all_torques: f64 = match motion.twists.is_empty() {
        // all cylinders do the same, one after the other
        true => {
            cylinders as f64 * cycle_integral(train, diagram, motion, 0, CylinderInstant::torque)
        }
        false => (0..cylinders)
            .map(|index| cycle_integral(train, diagram, motion, index, CylinderInstant::torque))
            .sum(),
    };
    found.mean_torque = all_torques / period;
    let work = cycle_work(train, diagram);
    found.indicated_mean_effective_pressure = cylinders as f64 * work / found.swept_volume;
    found.torque_orders = orders_of(&found.torque, period);
    let orders = |rows: &[[f64; 2]]| {
        [0, 1].map(|axis| {
            let component: Vec<f64> = rows.iter().map(|row| row[axis]).collect();
            orders_of(&component, period)
        })
    };
    found.force_orders = orders(&found.shaking_force);
    found.moment_orders = orders(&found.shaking_moment);
    found
}

/// Harmonics of even samples over a period (rad), without the mean.
fn orders_of(samples: &[f64], period: f64) -> Vec<Harmonic> {
    let mut all = harmonics(samples, period / TAU, HIGHEST_ORDER);
    all.retain(|harmonic| harmonic.order > 0.0);
    all
}

/// Torque of the rods on each throw (N m, in the sense of rotation) at a crank angle (rad): gas and inertia
/// of pistons and rods.
#[must_use]
pub fn throw_torques(
    train: &CrankTrain,
    diagram: &IndicatorDiagram,
    motion: &CrankMotion,
    crank_angle: f64,
) -> Vec<f64> {
    let mut torques = vec![0.0; train.layout.throws.len()];
    for (index, cylinder) in train.layout.cylinders.iter().enumerate() {
        if let Some(instant) = CylinderInstant::at(train, diagram, motion, index, crank_angle) {
            torques[cylinder.throw] += instant.torque();
        }
    }
    torques
}

/// Work of the gas on one piston over a working cycle, J.
#[must_use]
pub fn cycle_work(train: &CrankTrain, diagram: &IndicatorDiagram) -> f64 {
    let even = CrankMotion::even(1.0);
    cycle_integral(train, diagram, &even, 0, CylinderInstant::gas_torque)
}

/// Integral over the crank angle of a working cycle of a quantity of one cylinder.
fn cycle_integral(
    train: &CrankTrain,
    diagram: &IndicatorDiagram,
    motion: &CrankMotion,
    index: usize,
    quantity: impl Fn(&CylinderInstant) -> f64,
) -> f64 {
    /// Largest crank angle of a panel, rad: three degrees, where three places err by 1e-12.
    const PANEL: f64 = std::f64::consts::PI / 60.0;
    /// Places in a panel of length 2 and their weights: Gauss-Legendre, exact to degree 5.
    const GAUSS: [[f64; 2]; 3] = [
        [-0.774_596_669_241_483_4, 5.0 / 9.0],
        [0.0, 8.0 / 9.0],
        [0.774_596_669_241_483_4, 5.0 / 9.0],
    ];
    let (Some(cylinder), Some(&[first, _])) = (
        WorkingCylinder::of(train, diagram, index),
        diagram.points.first(),
    ) else {
        return f64::NAN;
    };
    let kinks = diagram.points.iter().map(|point| point[0]);
    let ends = kinks.skip(1).chain([first + diagram.period]);
    let mut sum = 0.0;
    let mut from = first;
    for to in ends {
        let panels = ((to - from) / PANEL).ceil().max(0.0) as usize;
        let half = 0.5 * (to - from) / panels as f64;
        for panel in 0..panels {
            let middle = cylinder.cycle_start() + from + half * (2 * panel + 1) as f64;
            for [place, weight] in GAUSS {
                let instant = cylinder.at(motion, middle + half * place);
                sum += half * weight * quantity(&instant);
            }
        }
        from = to;
    }
    sum
}

fn middle_of_mains(mains: &[f64]) -> f64 {
    match (mains.first(), mains.last()) {
        (Some(first), Some(last)) => 0.5 * (first + last),
        _ => 0.0,
    }
}

impl Performance {
    fn empty(cylinders: usize, points: usize) -> Self {
        Self {
            crank_angles: Vec::with_capacity(points),
            gas_pressure: Vec::with_capacity(points),
            displaced_volume: Vec::with_capacity(points),
            torque: Vec::with_capacity(points),
            gas_torque: Vec::with_capacity(points),
            mean_torque: f64::NAN,
            indicated_mean_effective_pressure: f64::NAN,
            swept_volume: f64::NAN,
            shaking_force: Vec::with_capacity(points),
            shaking_moment: Vec::with_capacity(points),
            side_thrust: vec![Vec::with_capacity(points); cylinders],
            torque_orders: Vec::new(),
            force_orders: [Vec::new(), Vec::new()],
            moment_orders: [Vec::new(), Vec::new()],
        }
    }

    fn add_row(
        &mut self,
        train: &CrankTrain,
        working: &[(usize, WorkingCylinder<'_>)],
        motion: &CrankMotion,
        crank_angle: f64,
        middle: f64,
    ) {
        let (mut torque, mut gas_torque) = (0.0, 0.0);
        let mut shaking: Vec<ShaftForce> = unbalance_forces(train, motion, crank_angle).collect();
        for &(index, cylinder) in working {
            let instant = cylinder.at(motion, crank_angle);
            torque += instant.torque();
            gas_torque += instant.gas_torque();
            shaking.push(ShaftForce {
                axial: train.layout.cylinders[index].axial,
                force: instant.in_engine_frame(instant.inertia_force),
            });
            self.side_thrust[index].push(instant.forces.side_thrust);
            if index == 0 {
                self.gas_pressure.push(instant.gas_pressure);
                let reach = train.rod_length + train.crank_radius;
                let top = (reach * reach - train.pin_offset * train.pin_offset).sqrt();
                let way = top - instant.slider.piston_position;
                self.displaced_volume.push(train.piston_area() * way);
            }
        }
        let (force, moment) = resultant(&shaking, middle);
        self.crank_angles.push(crank_angle);
        self.torque.push(torque);
        self.gas_torque.push(gas_torque);
        self.shaking_force.push(force);
        self.shaking_moment.push(moment);
    }
}
