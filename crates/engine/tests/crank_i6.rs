//! The inline-six diesel of `validation/crank-i6`, column by column.

mod common;

use common::{ROTATING, SPEED, close, diagram, diesel, inline, table};
use sommerfeld_engine::{
    CrankMotion, CylinderInstant, PinSpeed, Role, bearing_duties, cycle_work, performance,
};
use std::f64::consts::PI;

/// Share of a column's peak.
const BAR: f64 = 5e-4;

/// The table counts its firing top dead centre at 360 deg.
fn crank_angle(row: &[f64]) -> f64 {
    (row[0] - 360.0).to_radians()
}

#[test]
#[allow(clippy::unwrap_used)] // the engine has a first cylinder
fn every_column_of_the_table() {
    let (train, diagram) = (diesel(inline(&[1, 5, 3, 6, 2, 4])), diagram());
    let motion = CrankMotion::even(SPEED);
    let rows = table("crank-i6/reference.csv");
    assert_eq!(rows.len(), 360);
    let found: Vec<[f64; 13]> = rows
        .iter()
        .map(|row| {
            let at = CylinderInstant::at(&train, &diagram, &motion, 0, crank_angle(row)).unwrap();
            // force along a rod of two point masses: what the big end carries without that at the pin
            let big_end = [0, 1].map(|axis| {
                at.forces.big_end[axis] + ROTATING * at.slider.crankpin_acceleration[axis]
            });
            let force = at.crankpin_force();
            let load = at.big_end_load();
            [
                at.gas_pressure,
                at.slider.piston_position,
                at.slider.piston_speed,
                at.slider.piston_acceleration,
                at.gas_force,
                -at.slider.in_rod_frame(big_end)[0],
                at.forces.side_thrust,
                force[0],
                force[1],
                -load[0],
                -load[1],
                at.torque(),
                -at.slider.rod_speed,
            ]
        })
        .collect();
    for column in 0..13 {
        let peak = rows
            .iter()
            .map(|row| row[column + 1].abs())
            .fold(0.0, f64::max);
        for (row, found) in rows.iter().zip(&found) {
            let what = format!("column {} at {} deg", column + 2, row[0]);
            close(found[column], row[column + 1], BAR * peak, &what);
        }
    }
}

#[test]
#[allow(clippy::unwrap_used)] // the engine has six big ends
fn big_ends_of_all_cylinders_are_the_table_at_their_firing() {
    let (train, diagram) = (diesel(inline(&[1, 5, 3, 6, 2, 4])), diagram());
    let motion = CrankMotion::even(SPEED);
    let duties = bearing_duties(&train, &diagram, &motion, &PinSpeed::Share(0.5), 360);
    let rows = table("crank-i6/reference.csv");
    let peak = 116.12e3;
    for (index, cylinder) in train.layout.cylinders.iter().enumerate() {
        let duty = duties
            .iter()
            .find(|duty| duty.role == Role::BigEnd && duty.index == index)
            .unwrap();
        for point in &duty.cycle.points {
            let degrees = (point.crank_angle - cylinder.firing_angle).to_degrees() + 360.0;
            // rows stand every 2 deg from 0
            let row = &rows[(0.5 * degrees.rem_euclid(720.0)).round() as usize % 360];
            if row[0] == 0.0 {
                continue; // the pressure steps here: either side is right
            }
            let what = format!("big end {} at {} deg", index + 1, row[0]);
            close(point.load[0], -row[10], BAR * peak, &what);
            close(point.load[1], -row[11], BAR * peak, &what);
            close(point.journal_speed, SPEED + row[13], BAR * SPEED, &what);
        }
    }
}

#[test]
fn peak_pin_load() {
    let (train, diagram) = (diesel(inline(&[1])), diagram());
    let motion = CrankMotion::even(SPEED);
    let duties = bearing_duties(&train, &diagram, &motion, &PinSpeed::Share(0.5), 720);
    let big_end = duties.iter().find(|duty| duty.role == Role::BigEnd);
    let peak = big_end
        .iter()
        .flat_map(|duty| &duty.cycle.points)
        .map(|point| (point.load[0].hypot(point.load[1]), point.crank_angle))
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let (load, angle) = peak.unwrap_or((0.0, 0.0));
    close(load, 116.12e3, 5.0, "peak load, N"); // half its last digit
    close(angle.to_degrees(), 8.0, 1.0, "deg after firing");
}

#[test]
fn work_mean_pressure_and_mean_torque() {
    let (train, diagram) = (diesel(inline(&[1, 5, 3, 6, 2, 4])), diagram());
    let found = performance(&train, &diagram, &CrankMotion::even(SPEED), 720);
    // half a last digit of the printed figures; that of the work was a sum of p dV every 0.2 deg, which
    // differs from the integral by 7e-6 of it
    let work = cycle_work(&train, &diagram);
    close(work, 2247.60, 0.02, "work, J");
    let position = |angle: f64| {
        let sin_rod = train.crank_radius * angle.sin() / train.rod_length;
        train.crank_radius * angle.cos() + train.rod_length * (1.0 - sin_rod * sin_rod).sqrt()
    };
    let coarse: f64 = (0..3600)
        .map(|k| [k, k + 1].map(|k| 0.2 * f64::from(k) - 360.0))
        .map(|ends| {
            let [from, to] = ends.map(f64::to_radians);
            // just before the seam, not behind it
            let pressure = 0.5 * (diagram.at(from) + diagram.at(to - 1e-12));
            pressure * train.piston_area() * (position(from) - position(to))
        })
        .sum();
    close(coarse.abs(), 2247.60, 0.005, "sum of p dV every 0.2 deg, J");
    // by parts: the integral of V dp over every line of the diagram by Simpson's rule, and the step
    let mut by_parts = 0.0;
    for pair in diagram.points.windows(2) {
        let [[from, p], [to, next]] = [pair[0], pair[1]];
        let panels = 200;
        let h = (to - from) / f64::from(panels);
        let area: f64 = (0..panels)
            .map(|k| from + h * f64::from(k))
            .map(|a| h / 6.0 * (position(a) + 4.0 * position(a + 0.5 * h) + position(a + h)))
            .sum();
        by_parts += (next - p) / (to - from) * area;
    }
    let step = diagram.points[0][1] - diagram.points[diagram.points.len() - 1][1];
    by_parts += step * position(0.0);
    // the gas moves the piston down: W = -A times the integral of p dx = A times that of x dp
    let by_parts = train.piston_area() * by_parts;
    close(work / by_parts, 1.0, 1e-12, "work, by parts");
    let bar = 1e-5 * found.indicated_mean_effective_pressure;
    close(bar, 18.947, 5e-4, "imep, bar");
    close(found.mean_torque / 6.0, 178.86, 5e-3, "mean torque, N m");
    let swept = 6.0 * 0.25 * PI * 0.105 * 0.105 * 0.137;
    close(found.swept_volume, swept, 1e-15, "swept volume, m3");
}
