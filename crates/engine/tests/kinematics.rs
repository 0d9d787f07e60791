//! Slider-crank and rod against identities, numerical differentiation and free-body sums.

mod common;

use common::{SPEED, close, diagram, diesel, general, inline, rippling};
use sommerfeld_engine::{
    CrankMotion, CylinderInstant, SliderCrank, SliderCrankInstant, ThrowInstant, rod_forces,
};
use std::f64::consts::PI;

fn even(angle: f64) -> ThrowInstant {
    ThrowInstant {
        angle,
        speed: SPEED,
        acceleration: 0.0,
    }
}

/// First derivative by central differences of order 8 (Fornberg 1988).
fn derivative(value: impl Fn(f64) -> f64, at: f64, step: f64) -> f64 {
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let sum: f64 = weights
        .iter()
        .zip(1..)
        .map(|(weight, k)| {
            let reach = step * f64::from(k);
            weight * (value(at + reach) - value(at - reach))
        })
        .sum();
    sum / step
}

#[test]
fn accelerations_and_pin_speeds_at_the_dead_centres() {
    let train = diesel(inline(&[1]));
    let slider = SliderCrank::of(&train);
    let (r, l) = (train.crank_radius, train.rod_length);
    let scale = r * SPEED * SPEED;
    let (top, bottom) = (slider.at(even(0.0)), slider.at(even(PI)));
    close(
        top.piston_acceleration / scale,
        -(1.0 + r / l),
        1e-14,
        "top",
    );
    close(
        bottom.piston_acceleration / scale,
        1.0 - r / l,
        1e-14,
        "bottom",
    );
    let pin_speed = |at: SliderCrankInstant| (SPEED - at.rod_speed) / SPEED;
    close(pin_speed(top), 1.0 + r / l, 1e-14, "pin in the rod, top");
    close(
        pin_speed(bottom),
        1.0 - r / l,
        1e-14,
        "pin in the rod, bottom",
    );
    assert_eq!((SPEED * pin_speed(top)).round(), 279.0);
    assert_eq!((SPEED * pin_speed(bottom)).round(), 140.0);
}

#[test]
fn motion_is_the_derivative_of_position_where_the_speed_ripples() {
    let train = general(inline(&[1]));
    let slider = SliderCrank::of(&train);
    let motion = rippling();
    let at = |time: f64| slider.at(motion.at(0.1, SPEED * time));
    let time_step = 0.02 / SPEED;
    let radius = train.crank_radius;
    for k in 0..90 {
        let time = 0.14 * f64::from(k) / SPEED;
        let now = at(time);
        let slope = |value: fn(&SliderCrankInstant) -> f64| {
            derivative(|time| value(&at(time)), time, time_step)
        };
        let (speed_scale, scale) = (radius * SPEED, radius * SPEED * SPEED);
        let pairs = [
            (
                slope(|at| at.piston_position),
                now.piston_speed,
                speed_scale,
            ),
            (slope(|at| at.piston_speed), now.piston_acceleration, scale),
            (-slope(|at| at.rod_angle()), now.rod_speed, SPEED),
            (
                slope(|at| at.rod_speed),
                now.rod_acceleration,
                SPEED * SPEED,
            ),
        ];
        for (numeric, exact, scale) in pairs {
            close(numeric / scale, exact / scale, 1e-9, "against differences");
        }
        // any point of the rod lies between its ends
        for share in [0.3, 1.0] {
            let point = now.rod_point_acceleration(share * train.rod_length);
            let pin = now.crankpin_acceleration;
            let expected = [
                (1.0 - share) * pin[0] + share * now.piston_acceleration,
                (1.0 - share) * pin[1],
            ];
            for axis in 0..2 {
                close(point[axis] / scale, expected[axis] / scale, 1e-13, "rod");
            }
        }
    }
}

#[test]
fn forces_of_a_rod_with_any_inertia_balance() {
    let train = general(inline(&[1]));
    let rod = train.rod;
    let (l, a) = (train.rod_length, rod.centre_of_gravity);
    let motion = rippling();
    let diagram = diagram();
    for degrees in 0..720 {
        let angle = f64::from(degrees).to_radians();
        let at = CylinderInstant::at(&train, &diagram, &motion, 0, angle);
        let Some(CylinderInstant {
            slider,
            forces,
            gas_force,
            ..
        }) = at
        else {
            unreachable!("the engine has one cylinder")
        };
        let gas = gas_force;
        let pin = slider.crankpin_acceleration;
        let share = a / l;
        let centre = [
            (1.0 - share) * pin[0] + share * slider.piston_acceleration,
            (1.0 - share) * pin[1],
        ];
        let [x, y] = slider.rod_direction;
        // the piston's end against the crankpin's: turns the rod
        let across = -x * pin[1] - y * (slider.piston_acceleration - pin[0]);
        let turning = across / l;
        let scale = 1e4;
        for axis in 0..2 {
            let on_rod = -forces.big_end[axis] - forces.small_end[axis];
            close(
                on_rod / scale,
                rod.mass * centre[axis] / scale,
                1e-12,
                "rod force",
            );
        }
        let small_end = forces.small_end;
        let about_big_end = -l * (x * small_end[1] - y * small_end[0]);
        let needed = rod.inertia * turning + a * rod.mass * (x * centre[1] - y * centre[0]);
        close(about_big_end, needed, 1e-9, "moment on the rod, N m");
        let on_piston = small_end[0] - gas;
        let needed = train.piston_mass * slider.piston_acceleration;
        close(on_piston / scale, needed / scale, 1e-12, "piston along");
        close(small_end[1] + forces.side_thrust, 0.0, 0.0, "piston across");
    }
}

#[test]
fn power_of_the_torque_is_that_of_the_gas_and_of_the_masses() {
    let train = general(inline(&[1]));
    let rod = train.rod;
    let slider = SliderCrank::of(&train);
    let motion = rippling();
    let share = rod.centre_of_gravity / train.rod_length;
    let energy = |time: f64| {
        let at = slider.at(motion.at(0.065, SPEED * time));
        let pin = [-at.crankpin[1], at.crankpin[0]].map(|arm| arm * at.crank.speed);
        let centre = [
            (1.0 - share) * pin[0] + share * at.piston_speed,
            (1.0 - share) * pin[1],
        ];
        0.5 * train.piston_mass * at.piston_speed.powi(2)
            + 0.5 * rod.mass * (centre[0].powi(2) + centre[1].powi(2))
            + 0.5 * rod.inertia * at.rod_speed.powi(2)
    };
    let gas = 5e4;
    for k in 0..60 {
        let time = 0.1 * f64::from(k) / SPEED;
        let now = slider.at(motion.at(0.065, SPEED * time));
        let forces = rod_forces(&train, &now, gas);
        let [x, y] = now.crankpin;
        let torque = x * forces.big_end[1] - y * forces.big_end[0];
        let lost = derivative(energy, time, 0.02 / SPEED);
        let expected = -gas * now.piston_speed - lost;
        let scale = 1e3 * SPEED;
        close(
            torque * now.crank.speed / scale,
            expected / scale,
            1e-9,
            "power",
        );
    }
}

#[test]
fn pin_offset_moves_the_dead_centres_of_piston_and_gas() {
    let train = general(inline(&[1, 3, 4, 2]));
    let slider = SliderCrank::of(&train);
    let (top, bottom) = (slider.top_dead_centre(), slider.bottom_dead_centre());
    assert!(top > 0.004);
    let (high, low) = (slider.at(even(top)), slider.at(even(bottom)));
    close(high.piston_speed, 0.0, 1e-13, "speed at the top");
    close(low.piston_speed, 0.0, 1e-13, "speed at the bottom");
    let way = high.piston_position - low.piston_position;
    close(way, slider.stroke(), 1e-15, "stroke");
    assert!(way > 2.0 * train.crank_radius);
    let diagram = diagram();
    for (index, cylinder) in train.layout.cylinders.iter().enumerate() {
        for degrees in [-40.0_f64, 0.0, 7.0, 300.0] {
            let angle = cylinder.firing_angle + top + degrees.to_radians();
            let motion = CrankMotion::even(SPEED);
            let at = CylinderInstant::at(&train, &diagram, &motion, index, angle);
            let pressure = at.map_or(f64::NAN, |at| at.gas_pressure);
            let expected = diagram.at(degrees.to_radians());
            close(pressure / expected, 1.0, 1e-9, "pressure");
        }
    }
}
