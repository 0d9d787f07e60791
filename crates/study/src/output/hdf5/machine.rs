//! An engine or shaft in `results.h5`: a group for each speed, in it one for each bearing.

use super::super::csv::cycle_columns;
use super::super::machine::{
    determinate_columns, engine_columns, orders_columns, rounded_rpm, status_of,
};
use super::{Layout, StoredFields, converged};
use crate::hdf5::Node;
use crate::results::degrees;
use crate::results::machine::{BearingResults, MachineResults, SpeedResults};
use sommerfeld_bearing::{CycleTilt, LoadCycle};
use std::io::{self, Seek, Write};

impl<W: Write + Seek> Layout<W> {
    pub(super) fn machine(&mut self, machine: &MachineResults) -> io::Result<()> {
        let root = self.file.root();
        self.file
            .set(root, "load_model", machine.load_model.as_str());
        let speeds = self.file.group(root, "speeds")?;
        for speed in &machine.speeds {
            let group = self.file.group(speeds, &speed.label())?;
            self.speed(group, speed)?;
        }
        Ok(())
    }

    fn speed(&mut self, group: Node, speed: &SpeedResults) -> io::Result<()> {
        let rpm = rounded_rpm(speed.speed);
        self.add(group, "speed", "rpm", &[], &[rpm])?;
        if let Some(performance) = &speed.performance {
            let engine = self.file.group(group, "engine")?;
            self.columns(engine, engine_columns(performance))?;
            for (name, unit, value) in [
                (
                    "indicated_mean_effective_pressure",
                    "Pa",
                    performance.indicated_mean_effective_pressure,
                ),
                ("mean_torque", "N.m", performance.mean_torque),
                ("swept_volume", "m3", performance.swept_volume),
            ] {
                self.add(engine, name, unit, &[], &[value])?;
            }
            if let Some(lost) = speed.friction_mean_effective_pressure {
                self.add(
                    engine,
                    "friction_mean_effective_pressure",
                    "Pa",
                    &[],
                    &[lost],
                )?;
            }
            let orders = self.file.group(group, "orders")?;
            self.columns(orders, orders_columns(speed, performance))?;
        }
        if let Some(torsion) = &speed.torsion {
            let inner = self.file.group(group, "torsion")?;
            let frequencies = &torsion.natural_frequencies;
            let count = [frequencies.len()];
            self.add(inner, "natural_frequency", "Hz", &count, frequencies)?;
            self.add(
                inner,
                "link_heat",
                "W",
                &[torsion.link_heat.len()],
                &torsion.link_heat,
            )?;
        }
        let bearings = self.file.group(group, "bearings")?;
        for bearing in &speed.bearings {
            let group = self.file.group(bearings, &bearing.name)?;
            self.machine_bearing(group, bearing)?;
        }
        Ok(())
    }

    fn machine_bearing(&mut self, group: Node, bearing: &BearingResults) -> io::Result<()> {
        self.file.set(group, "role", bearing.role.name());
        self.file.set(group, "status", status_of(bearing));
        if let Some(first) = &bearing.turned_from {
            let first = first.to_string();
            self.file.set(group, "computed_as", first.as_str());
        }
        self.bearing(group, &bearing.cycle.bearing)?;
        if let Some(heat) = &bearing.heat {
            let inner = self.file.group(group, "heat")?;
            for (name, unit, value) in [
                ("effective_temperature", "K", heat.effective_temperature),
                ("supply_temperature", "K", heat.supply_temperature),
                ("outlet_temperature", "K", heat.outlet_temperature),
                ("conducted_heat", "W", heat.conducted),
            ] {
                self.add(inner, name, unit, &[], &[value])?;
            }
        }
        let load = self.file.group(group, "load")?;
        self.columns(load, load_columns(&bearing.load))?;
        let cycle = &bearing.cycle;
        if !cycle.orbit.points.is_empty() {
            let inner = self.file.group(group, "cycle")?;
            let mut columns = cycle_columns(cycle);
            columns.push(converged(cycle));
            columns.extend(determinate_columns(bearing));
            self.columns(inner, columns)?;
        }
        if let Some(fields) = &cycle.fields {
            let worst = self.file.group(group, "worst")?;
            let angle = degrees(fields.worst.crank_angle);
            self.add(worst, "crank_angle", "deg", &[], &[angle])?;
            self.snapshot(worst, &fields.worst.field)?;
            self.fields(group, fields, StoredFields::Frames)?;
        }
        Ok(())
    }
}

/// The load cycle of a bearing: rows over the crank angle.
fn load_columns(cycle: &LoadCycle) -> Vec<(String, Vec<f64>)> {
    let rows = &cycle.points;
    let all =
        |value: &dyn Fn(&sommerfeld_bearing::LoadPoint) -> f64| rows.iter().map(value).collect();
    let mut columns = vec![
        (
            "crank_angle[deg]".to_owned(),
            all(&|row| degrees(row.crank_angle)),
        ),
        ("load_x[N]".to_owned(), all(&|row| row.load[0])),
        ("load_y[N]".to_owned(), all(&|row| row.load[1])),
        ("moment_x[N.m]".to_owned(), all(&|row| row.moment[0])),
        ("moment_y[N.m]".to_owned(), all(&|row| row.moment[1])),
        (
            "journal_speed[rad/s]".to_owned(),
            all(&|row| row.journal_speed),
        ),
        ("shell_speed[rad/s]".to_owned(), all(&|row| row.shell_speed)),
    ];
    if let CycleTilt::Prescribed(tilts) = &cycle.tilt {
        for (axis, name) in ["x", "y"].into_iter().enumerate() {
            let values = tilts.iter().map(|tilt| tilt[axis]).collect();
            columns.push((format!("tilt_{name}[rad]"), values));
        }
    }
    columns
}
