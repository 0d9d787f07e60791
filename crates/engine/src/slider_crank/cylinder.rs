//! One cylinder of an engine at a crank angle: where its parts are, how they move and what they carry.
//!
//! The throw has its own angle, the crank angle with the twist at its place; piston, rod and gas follow
//! it. Crank angle 0 is where the arm of cylinder 1 points along its cylinder axis. With a pin offset the
//! piston's top dead centre is `asin(e/(r + l))` further, and there the gas cycle begins: an indicator
//! diagram counts from the dead centre of the piston.

use super::rod_forces::{RodForces, inertia_force, rod_forces};
use crate::{
    CrankMotion, CrankTrain, IndicatorDiagram, SliderCrank, SliderCrankInstant, ThrowInstant,
};

/// One cylinder of an engine: what is the same at every crank angle.
#[derive(Debug, Clone, Copy)]
pub struct WorkingCylinder<'a> {
    train: &'a CrankTrain,
    diagram: &'a IndicatorDiagram,
    slider_crank: SliderCrank,
    /// Axial position of its throw, m.
    throw_axial: f64,
    /// Angle of the arm from the cylinder axis at crank angle 0, rad.
    arm: f64,
    /// Crank angle at which the gas cycle begins, rad.
    cycle_start: f64,
    /// m2.
    piston_area: f64,
    /// Cosine and sine of the bank angle.
    bank: [f64; 2],
}

/// One cylinder at a crank angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CylinderInstant {
    /// Position and motion in the frame of the cylinder.
    pub slider: SliderCrankInstant,
    /// Absolute gas pressure, Pa.
    pub gas_pressure: f64,
    /// Force of the gas on the piston against the pressure under it, N, away from the head.
    pub gas_force: f64,
    /// What the rod carries, frame of the cylinder.
    pub forces: RodForces,
    /// Force of piston and rod on the engine block without the gas, N, frame of the cylinder.
    pub inertia_force: [f64; 2],
    /// Cosine and sine of the bank angle.
    bank: [f64; 2],
}

impl<'a> WorkingCylinder<'a> {
    /// Cylinder `index` (0-based); `None` if there is no such cylinder or throw.
    #[must_use]
    pub fn of(train: &'a CrankTrain, diagram: &'a IndicatorDiagram, index: usize) -> Option<Self> {
        let cylinder = train.layout.cylinders.get(index)?;
        let throw = train.layout.throws.get(cylinder.throw)?;
        let slider_crank = SliderCrank::of(train);
        let (sin, cos) = cylinder.bank_angle.sin_cos();
        Some(Self {
            train,
            diagram,
            slider_crank,
            throw_axial: throw.axial,
            arm: throw.angle - cylinder.bank_angle,
            cycle_start: cylinder.firing_angle + slider_crank.top_dead_centre(),
            piston_area: train.piston_area(),
            bank: [cos, sin],
        })
    }

    /// All cylinders of an engine with their indices; those without a throw are left out.
    pub(crate) fn all(train: &'a CrankTrain, diagram: &'a IndicatorDiagram) -> Vec<(usize, Self)> {
        (0..train.layout.cylinders.len())
            .filter_map(|index| Some((index, Self::of(train, diagram, index)?)))
            .collect()
    }

    /// Crank angle at which its gas cycle begins, rad: the firing top dead centre of its piston.
    #[must_use]
    pub fn cycle_start(&self) -> f64 {
        self.cycle_start
    }

    /// The cylinder when the crank angle (rad) is `crank_angle`.
    #[must_use]
    pub fn at(&self, motion: &CrankMotion, crank_angle: f64) -> CylinderInstant {
        let place = motion.at(self.throw_axial, crank_angle);
        let slider = self.slider_crank.at(ThrowInstant {
            angle: place.angle + self.arm,
            ..place
        });
        let gas_pressure = self.diagram.at(place.angle - self.cycle_start);
        let gas_force = self.piston_area * (gas_pressure - self.train.crankcase_pressure);
        CylinderInstant {
            slider,
            gas_pressure,
            gas_force,
            forces: rod_forces(self.train, &slider, gas_force),
            inertia_force: inertia_force(self.train, &slider),
            bank: self.bank,
        }
    }
}

impl CylinderInstant {
    /// Cylinder `index` (0-based) when the crank angle (rad) is `crank_angle`; `None` if there is no such
    /// cylinder or throw. For many angles, keep the [`WorkingCylinder`].
    #[must_use]
    pub fn at(
        train: &CrankTrain,
        diagram: &IndicatorDiagram,
        motion: &CrankMotion,
        index: usize,
        crank_angle: f64,
    ) -> Option<Self> {
        Some(WorkingCylinder::of(train, diagram, index)?.at(motion, crank_angle))
    }

    /// A vector of the frame of the cylinder in the engine frame.
    #[must_use]
    pub fn in_engine_frame(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = self.bank;
        [cos * x - sin * y, sin * x + cos * y]
    }

    /// Force of the rod ON the crankpin in the engine frame, N.
    #[must_use]
    pub fn crankpin_force(&self) -> [f64; 2] {
        self.in_engine_frame(self.forces.big_end)
    }

    /// Torque of the rod on the crankshaft, N m, in the sense of rotation: gas and inertia of piston and
    /// rod.
    #[must_use]
    pub fn torque(&self) -> f64 {
        let ([x, y], [force_x, force_y]) = (self.slider.crankpin, self.forces.big_end);
        x * force_y - y * force_x
    }

    /// Torque of the gas alone, N m: its power over the speed of the throw, from the slope of the piston's
    /// position over the crank angle.
    #[must_use]
    pub fn gas_torque(&self) -> f64 {
        let ([_, pin], [x, y]) = (self.slider.crankpin, self.slider.rod_direction);
        // dx/dt = -(r sin t + r cos t tan b), tan b = -y/x of the rod
        self.gas_force * (pin - self.slider.crankpin[0] * y / x)
    }

    /// Load of the crankpin ON the big end's journal in the rod frame, N: what the film balances.
    #[must_use]
    pub fn big_end_load(&self) -> [f64; 2] {
        self.slider
            .in_rod_frame(self.forces.big_end.map(|force| -force))
    }

    /// Load ON the piston pin as journal of the small end in the rod frame, N.
    #[must_use]
    pub fn small_end_load(&self) -> [f64; 2] {
        self.slider
            .in_rod_frame(self.forces.small_end.map(|force| -force))
    }

    /// Load ON the piston pin as journal of both bosses together, N, frame of the piston.
    #[must_use]
    pub fn piston_boss_load(&self) -> [f64; 2] {
        self.forces.small_end
    }
}
