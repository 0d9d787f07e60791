//! Torque, work and shaking against identities and the series of the textbooks.

mod common;

use common::{
    OSCILLATING, SPEED, close, diagram, diesel, general, inline, layouts, no_gas, rippling,
};
use sommerfeld_engine::{CrankMotion, Harmonic, cycle_work, performance, throw_torques};
use std::f64::consts::PI;

fn amplitude(harmonics: &[Harmonic], order: f64) -> f64 {
    let found = harmonics.iter().find(|found| found.order == order);
    found.map_or(f64::NAN, |found| found.cos.hypot(found.sin))
}

#[test]
fn mean_torque_is_the_work_of_the_gas_whatever_the_masses() {
    for layout in layouts() {
        for masses in [1.0, 0.0, 7.0] {
            let mut train = general(layout.clone());
            train.piston_mass *= masses;
            train.rod.inertia *= masses;
            let motion = CrankMotion::even(SPEED);
            let found = performance(&train, &diagram(), &motion, 36);
            let expected =
                found.indicated_mean_effective_pressure * found.swept_volume / (4.0 * PI);
            close(found.mean_torque / expected, 1.0, 1e-11, "mean torque");
            let cylinders = train.layout.cylinders.len() as f64;
            let work = cycle_work(&train, &diagram()) * cylinders;
            close(expected * 4.0 * PI / work, 1.0, 1e-13, "work");
        }
    }
}

#[test]
fn torque_without_gas_sums_to_zero() {
    let even = CrankMotion::even(SPEED);
    for layout in layouts() {
        let train = general(layout);
        let found = performance(&train, &no_gas(), &even, 720);
        let peak = found
            .torque
            .iter()
            .fold(0.0_f64, |most, torque| most.max(torque.abs()));
        let sum: f64 = found.torque.iter().sum();
        close(sum / (720.0 * peak), 0.0, 1e-13, "sum of torques");
        // the Gauss sums see the same
        close(found.mean_torque / peak, 0.0, 1e-11, "mean torque");
        let largest_gas = found
            .gas_torque
            .iter()
            .fold(0.0_f64, |most, torque| most.max(*torque));
        assert_eq!(largest_gas, 0.0);
    }
    // a single crank over one revolution
    let found = performance(&diesel(inline(&[1])), &no_gas(), &even, 720);
    let turn: f64 = found.torque[..360].iter().sum();
    let peak = found
        .torque
        .iter()
        .fold(0.0_f64, |most, torque| most.max(*torque));
    close(turn / (360.0 * peak), 0.0, 1e-13, "sum over one revolution");
}

#[test]
fn masses_give_back_their_power_where_the_speed_ripples() {
    let motion = rippling();
    for layout in layouts() {
        let train = general(layout);
        let (mut power, mut largest) = (0.0, 0.0_f64);
        let steps = 720;
        for step in 0..steps {
            let angle = 4.0 * PI * f64::from(step) / f64::from(steps);
            let torques = throw_torques(&train, &no_gas(), &motion, angle);
            for (torque, throw) in torques.iter().zip(&train.layout.throws) {
                let added = torque * motion.at(throw.axial, angle).speed;
                power += added;
                largest = largest.max(added.abs());
            }
        }
        close(
            power / (f64::from(steps) * largest),
            0.0,
            1e-13,
            "mean power",
        );
    }
}

#[test]
fn torque_is_that_of_the_throws() {
    let (diagram, motion) = (diagram(), rippling());
    for layout in layouts() {
        let train = general(layout);
        let found = performance(&train, &diagram, &motion, 72);
        for (angle, torque) in found.crank_angles.iter().zip(&found.torque) {
            let throws = throw_torques(&train, &diagram, &motion, *angle);
            assert_eq!(throws.len(), train.layout.throws.len());
            close(throws.iter().sum(), *torque, 1e-9, "torque, N m");
        }
    }
}

#[test]
fn orders_give_the_torque_back() {
    // inertia of an inline six has few orders: their sum is the torque
    let train = diesel(inline(&[1, 5, 3, 6, 2, 4]));
    let found = performance(&train, &no_gas(), &CrankMotion::even(SPEED), 720);
    let largest = found
        .torque
        .iter()
        .fold(0.0_f64, |most, torque| most.max(*torque));
    assert!(largest > 50.0);
    for (angle, torque) in found.crank_angles.iter().zip(&found.torque) {
        let sum: f64 = found
            .torque_orders
            .iter()
            .map(|order| order.at(*angle)[0])
            .sum();
        close(sum / largest, torque / largest, 1e-6, "sum of orders");
    }
}

#[test]
fn inline_four_shakes_with_the_second_order_of_the_series() {
    let mut train = diesel(inline(&[1, 3, 4, 2]));
    let ratio = 0.33_f64;
    train.rod_length = train.crank_radius / ratio;
    // the series knows the masses that go with the piston, whatever the inertia of the rod
    train.rod.inertia *= 1.3;
    let rod = train.rod;
    let oscillating = train.piston_mass + rod.mass * rod.centre_of_gravity / train.rod_length;
    let found = performance(&train, &no_gas(), &CrankMotion::even(SPEED), 720);
    let series =
        ratio + ratio.powi(3) / 4.0 + 15.0 * ratio.powi(5) / 128.0 + 35.0 * ratio.powi(7) / 512.0;
    let unit = 4.0 * oscillating * train.crank_radius * SPEED * SPEED;
    let second = amplitude(&found.force_orders[0], 2.0);
    close(second / (unit * series), 1.0, 1e-4, "second order");
    for order in [0.5, 1.0, 1.5, 3.0] {
        let other = amplitude(&found.force_orders[0], order);
        close(other / unit, 0.0, 1e-13, "another order");
    }
    // the arms of inline throws are symmetric about the middle: no moment
    for axis in 0..2 {
        close(
            amplitude(&found.moment_orders[axis], 2.0) / unit,
            0.0,
            1e-13,
            "moment",
        );
        close(
            amplitude(&found.force_orders[1], 2.0) / unit,
            0.0,
            1e-13,
            "across",
        );
    }
}

#[test]
fn inline_six_is_balanced_in_orders_1_2_and_4() {
    let mut train = diesel(inline(&[1, 5, 3, 6, 2, 4]));
    train.rod.inertia *= 1.3;
    let found = performance(&train, &no_gas(), &CrankMotion::even(SPEED), 720);
    let unit = 6.0 * OSCILLATING * train.crank_radius * SPEED * SPEED;
    for order in [1.0, 2.0, 4.0] {
        for axis in 0..2 {
            let force = amplitude(&found.force_orders[axis], order);
            let moment = amplitude(&found.moment_orders[axis], order);
            close(force / unit, 0.0, 1e-12, "force");
            close(moment / unit, 0.0, 1e-12, "moment");
        }
    }
    // the sixth remains
    assert!(amplitude(&found.force_orders[0], 6.0) / unit > 1e-4);
}

#[test]
fn inline_three_has_a_first_order_moment() {
    // sqrt 3 times spacing, mass, radius and speed squared: arms of 1 and 3 at 120 deg, one spacing from
    // the middle
    let train = diesel(inline(&[1, 3, 2]));
    let found = performance(&train, &no_gas(), &CrankMotion::even(SPEED), 720);
    let unit = train.crank_radius * SPEED * SPEED * 0.13 * 3.0_f64.sqrt();
    let about_y = amplitude(&found.moment_orders[1], 1.0);
    let about_x = amplitude(&found.moment_orders[0], 1.0);
    close(
        about_y / (unit * (OSCILLATING + common::ROTATING)),
        1.0,
        1e-12,
        "about y",
    );
    close(about_x / (unit * common::ROTATING), 1.0, 1e-12, "about x");
}

#[test]
fn an_engine_without_points_or_diagram_gives_no_numbers_and_no_panic() {
    let train = diesel(inline(&[1]));
    let motion = CrankMotion::even(SPEED);
    let none = performance(&train, &diagram(), &motion, 0);
    assert!(none.torque.is_empty() && none.torque_orders.is_empty());
    let mut empty = diagram();
    empty.points.clear();
    let found = performance(&train, &empty, &motion, 4);
    assert!(found.mean_torque.is_nan() && found.torque[0].is_nan());
    let mut lost = train;
    lost.layout.throws.clear();
    let found = performance(&lost, &diagram(), &motion, 4);
    assert!(found.mean_torque.is_nan());
}
