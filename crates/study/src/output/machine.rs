//! Tables of an engine or shaft: `bearings.csv` over all bearings and speeds; `engine.csv`,
//! `orders.csv`, and `loads-<name>.csv`, `cycle-<name>.csv` of each bearing at each speed.
//!
//! The tables of one speed lie in the directory of the results where it is the only speed, and in
//! a directory named after the speed, `2000rpm`, where there are several.

use super::csv::{Table, begins_with, cycle_table_with, number};
use super::{OutputError, ResultWriter, StoredFields, replace_file};
use crate::limits::{LimitCheck, Verdict};
use crate::results::machine::{BearingResults, MachineResults, SpeedResults, speed_words};
use crate::results::{
    Body, CycleResults, PROGRAM, Results, degrees, magnitude, rpm, specific_load, status_name,
};
use sommerfeld_bearing::{CyclePoint, CycleTilt, LoadCycle};
use sommerfeld_engine::{Harmonic, Performance, Role};
use std::fs;
use std::path::{Path, PathBuf};

/// Writes `bearings.csv`: one row per speed and bearing.
#[derive(Debug, Clone, Copy)]
pub struct BearingsTable;

/// Writes `engine.csv` and `orders.csv` of each speed.
#[derive(Debug, Clone, Copy)]
pub struct EngineTables;

/// Writes `loads-<name>.csv` and `cycle-<name>.csv` of each bearing at each speed.
#[derive(Debug, Clone, Copy)]
pub struct BearingTables;

impl ResultWriter for BearingsTable {
    fn file_name(&self) -> &'static str {
        "bearings.csv"
    }

    fn describe(&self) -> &'static str {
        "machine: key numbers, status and limits per speed and bearing"
    }

    fn is_own_table(&self, first_line: &str) -> bool {
        begins_with(first_line, ["speed[rpm]", "bearing", "role", "status"])
    }

    fn content(&self, results: &Results) -> Result<Option<Vec<u8>>, OutputError> {
        let Some(machine) = machine_of(results) else {
            return Ok(None);
        };
        bearings_table(machine, &results.header.limits).map(Some)
    }
}

impl ResultWriter for EngineTables {
    fn file_name(&self) -> &'static str {
        "engine.csv"
    }

    fn describe(&self) -> &'static str {
        "engine: gas, torque, shaking and side thrust per crank angle; orders.csv: their orders"
    }

    fn is_own_table(&self, first_line: &str) -> bool {
        begins_with(
            first_line,
            ["crank_angle[deg]", "gas_pressure[Pa]", "torque[N.m]"],
        ) || begins_with(
            first_line,
            ["order[-]", "torque_cos[N.m]", "torque_sin[N.m]"],
        )
    }

    fn files_in(&self, directory: &Path) -> Vec<PathBuf> {
        files_named(directory, |name| {
            ["engine.csv", "orders.csv"].contains(&name)
        })
    }

    fn write(
        &self,
        results: &Results,
        _stored: StoredFields<'_>,
        directory: &Path,
    ) -> Result<Vec<PathBuf>, OutputError> {
        let mut files = Vec::new();
        for (place, speed) in places(results, directory) {
            let Some(performance) = &speed.performance else {
                continue;
            };
            make(&place)?;
            let tables = [
                ("engine.csv", engine_table(performance)?),
                ("orders.csv", orders_table(speed, performance)?),
            ];
            for (name, content) in tables {
                let path = place.join(name);
                replace_file(&path, &content)?;
                files.push(path);
            }
        }
        Ok(files)
    }
}

impl ResultWriter for BearingTables {
    fn file_name(&self) -> &'static str {
        "cycle-main-1.csv"
    }

    fn describe(&self) -> &'static str {
        "machine: cycle-<name>.csv per bearing and speed, as cycle.csv; loads-<name>.csv, its load file"
    }

    fn is_own_table(&self, first_line: &str) -> bool {
        super::CycleTable.is_own_table(first_line) || first_line.starts_with(LOADS_BY)
    }

    fn files_in(&self, directory: &Path) -> Vec<PathBuf> {
        files_named(directory, |name| {
            let is_ours = name.starts_with("loads-") || name.starts_with("cycle-");
            is_ours && name.ends_with(".csv")
        })
    }

    fn write(
        &self,
        results: &Results,
        _stored: StoredFields<'_>,
        directory: &Path,
    ) -> Result<Vec<PathBuf>, OutputError> {
        let mut files = Vec::new();
        for (place, speed) in places(results, directory) {
            make(&place)?;
            for bearing in &speed.bearings {
                let loads = place.join(format!("loads-{}.csv", bearing.name));
                replace_file(&loads, &load_table(speed, bearing)?)?;
                files.push(loads);
                if !bearing.cycle.orbit.points.is_empty() {
                    let cycle = place.join(format!("cycle-{}.csv", bearing.name));
                    let further = determinate_columns(bearing);
                    replace_file(&cycle, &cycle_table_with(&bearing.cycle, further)?)?;
                    files.push(cycle);
                }
            }
        }
        Ok(files)
    }
}

fn machine_of(results: &Results) -> Option<&MachineResults> {
    match &results.body {
        Body::Machine(machine) => Some(machine),
        Body::Steady(_)
        | Body::LoadCycle(_)
        | Body::Dimensionless(_)
        | Body::Database(_)
        | Body::Sweep(_) => None,
    }
}

/// The speeds with the directories of their tables.
fn places<'r>(
    results: &'r Results,
    directory: &Path,
) -> impl Iterator<Item = (PathBuf, &'r SpeedResults)> {
    let speeds = machine_of(results).map_or(&[][..], |machine| &machine.speeds);
    speeds.iter().map(move |speed| {
        let place = match speeds.len() {
            1 => directory.to_path_buf(),
            _ => directory.join(speed.label()),
        };
        (place, speed)
    })
}

fn make(place: &Path) -> Result<(), OutputError> {
    fs::create_dir_all(place).map_err(|source| OutputError::Disk {
        action: "create the directory",
        path: place.to_path_buf(),
        source,
    })
}

/// Files of these names in a directory of results and in its directories of speeds, in order.
fn files_named(directory: &Path, is_named: impl Fn(&str) -> bool) -> Vec<PathBuf> {
    let entries = |place: &Path| -> Vec<PathBuf> {
        let found = fs::read_dir(place).into_iter().flatten().flatten();
        found.map(|entry| entry.path()).collect()
    };
    let name = |path: &Path| {
        let name = path.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    };
    let mut all = entries(directory);
    let speeds = all.iter().filter(|path| {
        let name = name(path);
        let speed = name.strip_suffix("rpm");
        speed.is_some_and(|speed| speed.parse::<f64>().is_ok()) && path.is_dir()
    });
    let inner: Vec<PathBuf> = speeds.flat_map(|place| entries(place)).collect();
    all.extend(inner);
    all.retain(|path| is_named(&name(path)) && path.is_file());
    all.sort();
    all
}

/// A column of the table of bearings: its header and its value for a bearing.
type BearingColumn = (&'static str, fn(&CycleResults) -> f64);

/// A value of a point of an orbit; not a number where there is none.
fn at(point: Option<&CyclePoint>, value: impl Fn(&CyclePoint) -> f64) -> f64 {
    point.map_or(f64::NAN, value)
}

const BEARING_COLUMNS: &[BearingColumn] = &[
    ("minimum_film_thickness[m]", |c| {
        at(c.minimum_film_thickness(), |p| {
            p.summary.minimum_film_thickness.value
        })
    }),
    ("minimum_film_thickness_angle[deg]", |c| {
        at(c.minimum_film_thickness(), |p| degrees(p.crank_angle))
    }),
    ("peak_film_pressure[Pa]", |c| {
        at(c.peak_film_pressure(), |p| {
            p.summary.peak_film_pressure.value
        })
    }),
    ("peak_film_pressure_angle[deg]", |c| {
        at(c.peak_film_pressure(), |p| degrees(p.crank_angle))
    }),
    ("maximum_load[N]", |c| {
        at(c.maximum_load(), |p| magnitude(p.load))
    }),
    ("maximum_load_angle[deg]", |c| {
        at(c.maximum_load(), |p| degrees(p.crank_angle))
    }),
    ("maximum_specific_load[Pa]", |c| {
        at(c.maximum_load(), |p| specific_load(&c.bearing, p.load))
    }),
    ("mean_power_loss[W]", |c| c.mean(|p| p.summary.power_loss())),
    ("mean_friction_power[W]", |c| {
        c.mean(|p| p.summary.friction_power)
    }),
    ("mean_side_flow[m3/s]", |c| {
        c.mean(|p| p.summary.side_flow[0] + p.summary.side_flow[1])
    }),
    ("mean_feed_flow[m3/s]", |c| c.mean(|p| p.summary.feed_flow)),
    ("mean_relative_eccentricity[-]", |c| {
        c.mean(|p| c.relative_eccentricity(p))
    }),
    ("maximum_tilt[rad]", |c| {
        at(c.largest(|p| magnitude(p.state.tilt)), |p| {
            magnitude(p.state.tilt)
        })
    }),
    ("cycle_closure[-]", |c| c.orbit.closure),
    ("cycles[-]", |c| c.orbit.cycles as f64),
    ("points_not_converged[-]", |c| {
        c.not_converged().count() as f64
    }),
];

/// Columns that stand in the table where a bearing has a value for them.
type FurtherColumn = (&'static str, fn(&BearingResults) -> Option<f64>);

const FURTHER_COLUMNS: &[FurtherColumn] = &[
    ("contact_load_share[-]", |b| {
        touches(b).then(|| b.cycle.contact_load_share())
    }),
    ("peak_contact_pressure[Pa]", |b| {
        let peak = b.cycle.peak_contact_pressure().filter(|_| touches(b));
        peak.map(|p| p.summary.peak_contact_pressure.value)
    }),
    ("mean_boundary_power[W]", |b| {
        touches(b).then(|| b.cycle.mean(|p| p.summary.boundary_power))
    }),
    ("wear_depth_per_hour[m]", |b| {
        Some(b.cycle.shell_wear()?.deepest_per_hour()?.value)
    }),
    ("wear_volume_per_hour[m3]", |b| {
        b.cycle.shell_wear()?.volume_per_hour()
    }),
    ("effective_temperature[degC]", |b| {
        Some(b.heat.as_ref()?.effective_temperature - 273.15)
    }),
    ("outlet_temperature[degC]", |b| {
        Some(b.heat.as_ref()?.outlet_temperature - 273.15)
    }),
];

fn touches(bearing: &BearingResults) -> bool {
    bearing.cycle.bearing.finish.has_contact() && !bearing.cycle.orbit.points.is_empty()
}

fn bearings_table(machine: &MachineResults, limits: &[LimitCheck]) -> Result<Vec<u8>, OutputError> {
    let mut table = Table::new(BearingsTable.file_name());
    let first = ["speed[rpm]", "bearing", "role", "status"].map(str::to_owned);
    let columns = BEARING_COLUMNS.iter().map(|(name, _)| (*name).to_owned());
    let further = FURTHER_COLUMNS.iter();
    let further: Vec<&FurtherColumn> = further
        .filter(|(_, value)| machine.bearings().any(|(_, one)| value(one).is_some()))
        .collect();
    let columns = columns.chain(further.iter().map(|(name, _)| (*name).to_owned()));
    let judged = limits
        .iter()
        .map(|check| format!("limit_{}", check.limit.quantity.key()));
    table.row(first.into_iter().chain(columns).chain(judged))?;
    for (speed, bearing) in machine.bearings() {
        let first = [
            number(rounded_rpm(speed.speed)),
            bearing.name.clone(),
            bearing.role.name().to_owned(),
            status_of(bearing).to_owned(),
        ];
        let values = BEARING_COLUMNS
            .iter()
            .map(|(_, value)| number(value(&bearing.cycle)));
        let more = further.iter();
        let more = more.map(|(_, value)| number(value(bearing).unwrap_or(f64::NAN)));
        let values = values.chain(more);
        let judged = limits.iter().map(|check| {
            let verdict = match bearing.check(&check.limit).verdict {
                Verdict::Ok => "OK",
                Verdict::Exceeded => "exceeded",
                Verdict::NotEvaluated => "not-evaluated",
            };
            verdict.to_owned()
        });
        table.row(first.into_iter().chain(values).chain(judged))?;
    }
    table.finish()
}

/// Without the round-off of the conversion: 2000 rpm reads 2000.
pub(super) fn rounded_rpm(speed: f64) -> f64 {
    (1e6 * rpm(speed)).round() / 1e6
}

/// The word for how a bearing ended; one that was not done has a word of its own.
pub(super) fn status_of(bearing: &BearingResults) -> &'static str {
    if bearing.is_missing() {
        "not-run"
    } else {
        status_name(bearing.cycle.orbit.outcome)
    }
}

/// How the first line of a load file of ours begins: a comment to its readers.
const LOADS_BY: &str = "# loads of ";

/// The load cycle of a bearing as a load file: `[load_cycle] file` of a load-cycle study takes it.
fn load_table(speed: &SpeedResults, bearing: &BearingResults) -> Result<Vec<u8>, OutputError> {
    let frame = match bearing.role {
        Role::Main => "engine frame",
        Role::BigEnd | Role::SmallEnd => "rod frame",
        Role::PistonBoss => "frame of the cylinder",
        Role::Shaft => "frame of the housing",
    };
    let cycle = &bearing.load;
    let mut text = format!(
        "{LOADS_BY}{} at {}, {PROGRAM}: load ON the journal, {frame}; engine_speed = \"{}\", period = \"{} deg\"\n",
        bearing.name,
        speed_words(speed.speed),
        format_args!("{:?} rad/s", cycle.engine_speed),
        degrees(cycle.period),
    )
    .into_bytes();
    let mut table = Table::new("loads.csv");
    let columns = load_columns(cycle);
    table.row(columns.iter().map(|(name, _)| *name))?;
    for row in 0..cycle.points.len() {
        table.row(columns.iter().map(|(_, values)| number(values[row])))?;
    }
    text.extend(table.finish()?);
    Ok(text)
}

/// The load that hinges at the mains would give, where an elastic shaft gave another: not part of the load
/// file, which is what the orbit answers.
pub(super) fn determinate_columns(bearing: &BearingResults) -> Vec<(String, Vec<f64>)> {
    let Some(hinges) = &bearing.determinate_load else {
        return Vec::new();
    };
    if hinges.len() != bearing.cycle.orbit.points.len() {
        return Vec::new();
    }
    let axes = ["x", "y"].into_iter().enumerate();
    axes.map(|(axis, name)| {
        let values = hinges.iter().map(|load| load[axis]).collect();
        (format!("determinate_load_{name}[N]"), values)
    })
    .collect()
}

/// The columns of a load file: moments free the tilt, tilts prescribe it.
fn load_columns(cycle: &LoadCycle) -> Vec<(&'static str, Vec<f64>)> {
    let rows = &cycle.points;
    let all = |value: fn(&sommerfeld_bearing::LoadPoint) -> f64| rows.iter().map(value).collect();
    let mut columns = vec![
        ("crank_angle[deg]", all(|row| degrees(row.crank_angle))),
        ("load_x[N]", all(|row| row.load[0])),
        ("load_y[N]", all(|row| row.load[1])),
        ("journal_speed[rad/s]", all(|row| row.journal_speed)),
        ("shell_speed[rad/s]", all(|row| row.shell_speed)),
    ];
    match &cycle.tilt {
        CycleTilt::Aligned => {}
        CycleTilt::Free => {
            columns.push(("moment_x[N.m]", all(|row| row.moment[0])));
            columns.push(("moment_y[N.m]", all(|row| row.moment[1])));
        }
        CycleTilt::Prescribed(tilts) => {
            let part = |axis: usize| tilts.iter().map(|tilt| tilt[axis]).collect();
            columns.push(("tilt_x[rad]", part(0)));
            columns.push(("tilt_y[rad]", part(1)));
        }
    }
    columns
}

/// Columns of `engine.csv` and of the group of an engine in `results.h5`.
pub(super) fn engine_columns(performance: &Performance) -> Vec<(String, Vec<f64>)> {
    let parts = |pairs: &[[f64; 2]], axis: usize| pairs.iter().map(|pair| pair[axis]).collect();
    let angles = performance.crank_angles.iter().copied().map(degrees);
    let mut columns: Vec<(String, Vec<f64>)> = [
        ("crank_angle[deg]", angles.collect()),
        ("gas_pressure[Pa]", performance.gas_pressure.clone()),
        ("torque[N.m]", performance.torque.clone()),
        ("gas_torque[N.m]", performance.gas_torque.clone()),
        ("shaking_force_x[N]", parts(&performance.shaking_force, 0)),
        ("shaking_force_y[N]", parts(&performance.shaking_force, 1)),
        (
            "shaking_moment_x[N.m]",
            parts(&performance.shaking_moment, 0),
        ),
        (
            "shaking_moment_y[N.m]",
            parts(&performance.shaking_moment, 1),
        ),
    ]
    .map(|(name, values)| (name.to_owned(), values))
    .to_vec();
    let thrusts = performance.side_thrust.iter().enumerate();
    columns
        .extend(thrusts.map(|(at, thrust)| (format!("side_thrust_{}[N]", at + 1), thrust.clone())));
    columns
}

fn engine_table(performance: &Performance) -> Result<Vec<u8>, OutputError> {
    let mut table = Table::new(EngineTables.file_name());
    let columns = engine_columns(performance);
    table.row(columns.iter().map(|(name, _)| name.as_str()))?;
    let value = |values: &[f64], row: usize| values.get(row).copied().unwrap_or(f64::NAN);
    for row in 0..performance.crank_angles.len() {
        table.row(columns.iter().map(|(_, values)| number(value(values, row))))?;
    }
    table.finish()
}

/// Columns of `orders.csv`: the order, then cosine and sine over the crank angle of each quantity; 0
/// where a quantity has no such order.
pub(super) fn orders_columns(
    speed: &SpeedResults,
    performance: &Performance,
) -> Vec<(String, Vec<f64>)> {
    let mut quantities: Vec<(String, &str, &[Harmonic])> = vec![
        ("torque".into(), "N.m", &performance.torque_orders),
        ("shaking_force_x".into(), "N", &performance.force_orders[0]),
        ("shaking_force_y".into(), "N", &performance.force_orders[1]),
        (
            "shaking_moment_x".into(),
            "N.m",
            &performance.moment_orders[0],
        ),
        (
            "shaking_moment_y".into(),
            "N.m",
            &performance.moment_orders[1],
        ),
    ];
    if let Some(torsion) = &speed.torsion {
        for (name, unit, all) in [
            ("twist", "rad", &torsion.twists),
            ("link_torque", "N.m", &torsion.link_torques),
        ] {
            let numbered = all.iter().enumerate();
            quantities.extend(numbered.map(|(at, twist)| {
                (
                    format!("{name}_{}", at + 1),
                    unit,
                    twist.harmonics.as_slice(),
                )
            }));
        }
    }
    let all = quantities
        .iter()
        .flat_map(|(_, _, harmonics)| harmonics.iter());
    let mut orders: Vec<f64> = all.map(|harmonic| harmonic.order).collect();
    orders.sort_by(f64::total_cmp);
    orders.dedup();
    let mut columns = vec![("order[-]".to_owned(), orders.clone())];
    for (name, unit, harmonics) in quantities {
        let part = |value: fn(&Harmonic) -> f64| {
            let of_order = |order: &f64| {
                let found = harmonics.iter().find(|harmonic| harmonic.order == *order);
                found.map_or(0.0, value)
            };
            orders.iter().map(of_order).collect()
        };
        columns.push((format!("{name}_cos[{unit}]"), part(|harmonic| harmonic.cos)));
        columns.push((format!("{name}_sin[{unit}]"), part(|harmonic| harmonic.sin)));
    }
    columns
}

fn orders_table(speed: &SpeedResults, performance: &Performance) -> Result<Vec<u8>, OutputError> {
    let mut table = Table::new("orders.csv");
    let columns = orders_columns(speed, performance);
    table.row(columns.iter().map(|(name, _)| name.as_str()))?;
    let rows = columns.first().map_or(0, |(_, orders)| orders.len());
    for row in 0..rows {
        table.row(columns.iter().map(|(_, values)| number(values[row])))?;
    }
    table.finish()
}
