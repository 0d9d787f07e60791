//! What acts on the crankshaft, and what its main bearings carry with a hinge at each of them.
//!
//! Cut at the mains, the crankshaft is a chain of beams on two supports each: a force F at the share s of
//! a bay loads the main before it with (1 - s) F and the one behind it with s F. A force beyond the first
//! or last main is held by the bay next to it, which its lever lifts off the inner main (s < 0 or s > 1).
//! Forces and moments about x and y of the shaft balance for any loads. No stiffness enters: what a
//! continuous shaft, unequal supports or clearances do to the shares, this model does not see.
//! Reference: Cho et al., KSME Int. J. 16 (2002) 1095-1101: agreement with loads measured in cap bolts.

use crate::{CrankMotion, CrankTrain, CylinderInstant, IndicatorDiagram, ShaftForce};

/// Everything that acts on the crankshaft except its main bearings, at a crank angle (rad): the forces of
/// the rods on their pins, cylinder by cylinder at the axial positions of their rods, then the inertia
/// forces of the unbalances (centrifugal, and tangential where their speed changes), one by one. Order and
/// positions are the same at every crank angle.
#[must_use]
pub fn shaft_forces(
    train: &CrankTrain,
    diagram: &IndicatorDiagram,
    motion: &CrankMotion,
    crank_angle: f64,
) -> Vec<ShaftForce> {
    let cylinders = &train.layout.cylinders;
    let rods = cylinders
        .iter()
        .enumerate()
        .filter_map(|(index, cylinder)| {
            let instant = CylinderInstant::at(train, diagram, motion, index, crank_angle)?;
            Some(ShaftForce {
                axial: cylinder.axial,
                force: instant.crankpin_force(),
            })
        });
    rods.chain(unbalance_forces(train, motion, crank_angle))
        .collect()
}

/// Inertia forces of the unbalances of the crankshaft at a crank angle (rad).
pub(crate) fn unbalance_forces(
    train: &CrankTrain,
    motion: &CrankMotion,
    crank_angle: f64,
) -> impl Iterator<Item = ShaftForce> {
    train.unbalances.iter().map(move |unbalance| {
        let place = motion.at(unbalance.axial, crank_angle);
        let (sin, cos) = (place.angle + unbalance.angle).sin_cos();
        let outwards = unbalance.moment * place.speed * place.speed;
        let against = unbalance.moment * place.acceleration;
        ShaftForce {
            axial: unbalance.axial,
            force: [
                outwards * cos + against * sin,
                outwards * sin - against * cos,
            ],
        }
    })
}

/// Load ON each main journal (N, engine frame) from the forces on a shaft with a hinge at each main;
/// `mains` are their axial positions (m, ascending). One main alone takes all forces and no moment.
#[must_use]
pub fn determinate_main_loads(mains: &[f64], forces: &[ShaftForce]) -> Vec<[f64; 2]> {
    let mut loads = vec![[0.0; 2]; mains.len()];
    for force in forces {
        let Some((before, share)) = bay(mains, force.axial) else {
            continue;
        };
        for axis in 0..2 {
            loads[before][axis] += (1.0 - share) * force.force[axis];
            if let Some(behind) = loads.get_mut(before + 1) {
                behind[axis] += share * force.force[axis];
            }
        }
    }
    loads
}

/// Index of the main before a place (of the nearest bay beyond the ends) and the share of the one behind
/// it; `None` without mains.
fn bay(mains: &[f64], axial: f64) -> Option<(usize, f64)> {
    let last_bay = mains.len().checked_sub(2);
    let Some(last_bay) = last_bay else {
        return (!mains.is_empty()).then_some((0, 0.0));
    };
    let behind = mains.partition_point(|main| *main <= axial);
    let before = behind.saturating_sub(1).min(last_bay);
    let (from, to) = (mains[before], mains[before + 1]);
    Some((before, (axial - from) / (to - from)))
}

/// Resultant of forces on a shaft: force (N) and moment about x and y (N m) through the axial position
/// `about` (m). Of [`shaft_forces`]: what the main bearings together carry.
#[must_use]
pub fn resultant(forces: &[ShaftForce], about: f64) -> ([f64; 2], [f64; 2]) {
    forces
        .iter()
        .fold(([0.0; 2], [0.0; 2]), |(sum, moment), one| {
            let [x, y] = one.force;
            let arm = one.axial - about;
            (
                [sum[0] + x, sum[1] + y],
                [moment[0] - arm * y, moment[1] + arm * x],
            )
        })
}
