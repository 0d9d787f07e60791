//! Loads of all bearings: what must hold in any engine, and equivalences between engines.

mod common;

use common::{SPEED, close, diagram, diesel, general, inline, layouts, no_gas, rippling};
use sommerfeld_engine::{
    CrankMotion, CrankTrain, CylinderInstant, PinSpeed, Role, ShaftForce, bearing_duties,
    determinate_main_loads, performance, resultant, shaft_forces,
};
use std::f64::consts::PI;

/// Loads are of this size, N: bars are shares of it.
const SCALE: f64 = 1e5;

fn mains_at(train: &CrankTrain, motion: &CrankMotion, crank_angle: f64) -> Vec<[f64; 2]> {
    let forces = shaft_forces(train, &diagram(), motion, crank_angle);
    determinate_main_loads(&train.layout.mains, &forces)
}

fn as_forces(positions: &[f64], loads: &[[f64; 2]]) -> Vec<ShaftForce> {
    let pairs = positions.iter().zip(loads);
    pairs
        .map(|(&axial, &force)| ShaftForce { axial, force })
        .collect()
}

#[test]
fn shares_of_a_bay_follow_the_lever() {
    let one = |axial| {
        let force = ShaftForce {
            axial,
            force: [1.0, -2.0],
        };
        let loads = determinate_main_loads(&[0.0, 1.0, 3.0], &[force]);
        loads.iter().map(|load| load[0]).collect::<Vec<f64>>()
    };
    assert_eq!(one(0.5), [0.5, 0.5, 0.0]);
    assert_eq!(one(1.5), [0.0, 0.75, 0.25]);
    assert_eq!(one(1.0), [0.0, 1.0, 0.0]);
    assert_eq!(one(3.0), [0.0, 0.0, 1.0]);
    // beyond the ends the next bay holds it
    assert_eq!(one(-0.5), [1.5, -0.5, 0.0]);
    assert_eq!(one(4.0), [0.0, -0.5, 1.5]);
    // four equal spans, unit force in the middle of the first
    let middle = ShaftForce {
        axial: 0.5,
        force: [1.0, 0.0],
    };
    let loads = determinate_main_loads(&[0.0, 1.0, 2.0, 3.0, 4.0], &[middle]);
    let expected = [[0.5, 0.0], [0.5, 0.0], [0.0; 2], [0.0; 2], [0.0; 2]];
    assert_eq!(loads, expected);
    assert_eq!(
        determinate_main_loads(&[], &[middle]),
        Vec::<[f64; 2]>::new()
    );
    assert_eq!(determinate_main_loads(&[0.2], &[middle]), [[1.0, 0.0]]);
}

#[test]
fn mains_balance_the_shaft_in_force_and_moment() {
    for layout in layouts() {
        let mut train = general(layout);
        // fewer mains than throws ask for: several throws in a bay, one beyond the end
        let length = train.layout.throws.last().map_or(0.0, |last| last.axial);
        for mains in [
            train.layout.mains.clone(),
            vec![0.0, 0.45 * length, 0.9 * length],
        ] {
            train.layout.mains = mains;
            for step in 0..144 {
                let angle = 5.0_f64.to_radians() * f64::from(step);
                let forces = shaft_forces(&train, &diagram(), &rippling(), angle);
                let loads = determinate_main_loads(&train.layout.mains, &forces);
                let carried = resultant(&as_forces(&train.layout.mains, &loads), 0.1);
                let acting = resultant(&forces, 0.1);
                for axis in 0..2 {
                    close(carried.0[axis], acting.0[axis], 1e-13 * SCALE, "force");
                    close(carried.1[axis], acting.1[axis], 1e-13 * SCALE, "moment");
                }
            }
        }
    }
}

#[test]
fn engine_shakes_with_mains_side_thrust_and_gas() {
    for layout in layouts() {
        let train = general(layout);
        let (diagram, motion) = (diagram(), rippling());
        let found = performance(&train, &diagram, &motion, 144);
        for (step, shaking) in found.shaking_force.iter().enumerate() {
            let angle = found.crank_angles[step];
            let mut on_block = mains_at(&train, &motion, angle)
                .iter()
                .fold([0.0; 2], |sum, load| [sum[0] + load[0], sum[1] + load[1]]);
            for index in 0..train.layout.cylinders.len() {
                let at = CylinderInstant::at(&train, &diagram, &motion, index, angle);
                let Some(at) = at else { unreachable!() };
                // the gas presses the head up, the piston the cylinder against the side thrust
                let block = at.in_engine_frame([at.gas_force, -at.forces.side_thrust]);
                on_block = [on_block[0] + block[0], on_block[1] + block[1]];
                close(
                    found.side_thrust[index][step],
                    at.forces.side_thrust,
                    0.0,
                    "side thrust",
                );
            }
            for axis in 0..2 {
                close(shaking[axis], on_block[axis], 1e-12 * SCALE, "on the block");
            }
        }
    }
}

#[test]
fn duties_come_in_order_with_the_loads_of_the_shaft() {
    for layout in layouts() {
        let train = general(layout);
        let (diagram, motion) = (diagram(), rippling());
        let duties = bearing_duties(&train, &diagram, &motion, &PinSpeed::Share(0.4), 90);
        let mains = train.layout.mains.len();
        let cylinders = train.layout.cylinders.len();
        let expected: Vec<(Role, usize)> = [
            (Role::Main, mains),
            (Role::BigEnd, cylinders),
            (Role::SmallEnd, cylinders),
            (Role::PistonBoss, cylinders),
        ]
        .iter()
        .flat_map(|&(role, count)| (0..count).map(move |index| (role, index)))
        .collect();
        let order: Vec<(Role, usize)> = duties.iter().map(|duty| (duty.role, duty.index)).collect();
        assert_eq!(order, expected);
        for step in 0..90 {
            let angle = 8.0_f64.to_radians() * step as f64;
            let loads = mains_at(&train, &motion, angle);
            for (main, load) in loads.iter().enumerate() {
                let point = duties[main].cycle.points[step];
                close(point.crank_angle, angle, 1e-13, "crank angle");
                close(point.load[0], load[0], 1e-9 * SCALE, "main, x");
                close(point.load[1], load[1], 1e-9 * SCALE, "main, y");
                let speed = motion.at(train.layout.mains[main], angle).speed;
                close(point.journal_speed, speed, 1e-10 * SPEED, "main, speed");
            }
            for index in 0..cylinders {
                let of = |kind: usize| duties[mains + kind * cylinders + index].cycle.points[step];
                let (big, small, boss) = (of(0), of(1), of(2));
                let throw = train.layout.throws[train.layout.cylinders[index].throw];
                let crank = motion.at(throw.axial, angle).speed;
                let rod = crank - big.journal_speed;
                close(small.journal_speed, -0.6 * rod, 1e-9 * SPEED, "pin in rod");
                close(boss.journal_speed, 0.4 * rod, 1e-9 * SPEED, "pin in piston");
                assert_eq!([big, small, boss].map(|point| point.shell_speed), [0.0; 3]);
                // the same force at the pin, in opposite senses and frames
                let size = |load: [f64; 2]| load[0].hypot(load[1]);
                close(size(small.load), size(boss.load), 1e-12 * SCALE, "pin");
            }
        }
    }
}

#[test]
fn at_firing_the_upper_shell_of_the_rod_and_the_lower_one_of_the_block_are_loaded() {
    let train = diesel(inline(&[1]));
    let duties = bearing_duties(
        &train,
        &diagram(),
        &CrankMotion::even(0.1 * SPEED),
        &PinSpeed::Share(0.5),
        720,
    );
    let load = |role| {
        let duty = duties.iter().find(|duty| duty.role == role);
        duty.map_or(f64::NAN, |duty| duty.cycle.points[4].load[0] / SCALE)
    };
    assert!(load(Role::Main) < -0.5, "journal pressed down into the cap");
    assert!(load(Role::BigEnd) > 1.0, "crankpin pressed against the rod");
    assert!(load(Role::SmallEnd) < -1.0, "pin pressed down into the rod");
    assert!(
        load(Role::PistonBoss) > 1.0,
        "pin pressed up into the piston"
    );
}

#[test]
fn every_cylinder_of_every_layout_does_what_one_alone_does() {
    let alone = general(inline(&[1]));
    let (diagram, motion) = (diagram(), CrankMotion::even(SPEED));
    for layout in layouts() {
        let train = general(layout);
        for (index, cylinder) in train.layout.cylinders.iter().enumerate() {
            for degrees in (0..720).step_by(7) {
                // away from the seam of the diagram, where it steps
                let angle = (f64::from(degrees) + 0.5).to_radians();
                let one = CylinderInstant::at(&alone, &diagram, &motion, 0, angle);
                let angle = angle + cylinder.firing_angle;
                let same = CylinderInstant::at(&train, &diagram, &motion, index, angle);
                let (Some(one), Some(same)) = (one, same) else {
                    unreachable!()
                };
                for axis in 0..2 {
                    let bar = 1e-11 * SCALE;
                    let pairs = [
                        (same.big_end_load(), one.big_end_load()),
                        (same.small_end_load(), one.small_end_load()),
                        (same.piston_boss_load(), one.piston_boss_load()),
                    ];
                    for (same, one) in pairs {
                        close(same[axis], one[axis], bar, "load");
                    }
                }
                close(same.torque(), one.torque(), 1e-9, "torque, N m");
                // in the engine frame turned by its bank
                let ([x, y], [along, across]) = (same.crankpin_force(), one.crankpin_force());
                let (sin, cos) = cylinder.bank_angle.sin_cos();
                close(x, cos * along - sin * across, 1e-11 * SCALE, "x");
                close(y, sin * along + cos * across, 1e-11 * SCALE, "y");
            }
        }
    }
}

/// The engine turned about z as a whole.
fn turned(train: &CrankTrain, angle: f64) -> CrankTrain {
    let mut turned = train.clone();
    for cylinder in &mut turned.layout.cylinders {
        cylinder.bank_angle += angle;
    }
    for throw in &mut turned.layout.throws {
        throw.angle += angle;
    }
    for unbalance in &mut turned.unbalances {
        unbalance.angle += angle;
    }
    turned
}

/// The engine seen in a mirror across its shaft.
fn mirrored(train: &CrankTrain) -> CrankTrain {
    let mut mirrored = train.clone();
    for cylinder in &mut mirrored.layout.cylinders {
        cylinder.axial = -cylinder.axial;
    }
    for throw in &mut mirrored.layout.throws {
        throw.axial = -throw.axial;
    }
    for unbalance in &mut mirrored.unbalances {
        unbalance.axial = -unbalance.axial;
    }
    mirrored.layout.mains = train.layout.mains.iter().rev().map(|main| -main).collect();
    mirrored
}

/// The engine with its cylinders numbered the other way round: the banks of a V change their names.
fn renumbered(train: &CrankTrain) -> CrankTrain {
    let mut renumbered = train.clone();
    renumbered.layout.cylinders.reverse();
    renumbered
}

#[test]
fn turned_mirrored_and_renumbered_engines_load_their_mains_alike() {
    let motion = CrankMotion::even(SPEED);
    for layout in layouts() {
        let train = general(layout);
        let (by, step) = (0.7_f64, 5.0_f64.to_radians());
        let (turned, mirrored, renumbered) =
            (turned(&train, by), mirrored(&train), renumbered(&train));
        for k in 0..144 {
            let angle = step * (f64::from(k) + 0.5);
            let loads = mains_at(&train, &motion, angle);
            let (sin, cos) = by.sin_cos();
            let ways = [
                (mains_at(&turned, &motion, angle), false, [cos, sin]),
                (mains_at(&mirrored, &motion, angle), true, [1.0, 0.0]),
                (mains_at(&renumbered, &motion, angle), false, [1.0, 0.0]),
            ];
            for (mut found, is_reversed, [cos, sin]) in ways {
                if is_reversed {
                    found.reverse();
                }
                for (found, [x, y]) in found.iter().zip(&loads) {
                    close(found[0], cos * x - sin * y, 1e-11 * SCALE, "x");
                    close(found[1], sin * x + cos * y, 1e-11 * SCALE, "y");
                }
            }
        }
    }
}

#[test]
fn a_counterweight_of_the_rotating_mass_cancels_it_at_any_motion() {
    let mut train = diesel(inline(&[1]));
    train.unbalances = vec![sommerfeld_engine::Unbalance {
        axial: train.layout.throws[0].axial,
        moment: common::ROTATING * train.crank_radius,
        angle: PI,
    }];
    let found = performance(&train, &no_gas(), &rippling(), 144);
    for [_, across] in found.shaking_force {
        close(across, 0.0, 1e-13 * SCALE, "across the cylinder");
    }
}
