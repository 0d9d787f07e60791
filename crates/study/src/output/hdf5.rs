//! `results.h5`: everything a run found, described in the file itself.
//!
//! SI, angles in degrees as in the tables. Every dataset carries `units` (`1` for plain numbers) and
//! `long_name`; the axes of an array are attached to it as dimension scales. Numbers are 64-bit floats,
//! the fields over crank angle 32-bit ones. What is not finite stands as NaN. Arrays of 256 values or
//! more are chunked, shuffled and deflated.
//!
//! | where | holds | of |
//! |---|---|---|
//! | `/` | attributes `program`, `version`, `schema`, `analysis`, `status`, `title`, `messages`, `models`, `study` (the file as it was read), `study_hash` | every run |
//! | `summary/` | the numbers of `summary.json` under the same keys; lists as arrays, nested keys as groups | every run |
//! | `error/` | absolute discretisation errors by key of `summary/` | runs with error bars |
//! | `limits/<quantity>/` | `limit` and `value`; attributes `verdict`, `source`; of a machine `at`, the bearing and speed of the value | studies with limits |
//! | `bearing/` | `diameter`, `width`, `radial_clearance` | bearings |
//! | `film/` | `pressure`, `film_fraction`, `film_thickness` \[angle, axial\] with their axes; where asperities touch `contact_pressure`, where it is a field `temperature` (K) | one state |
//! | `cycle/` | the columns of `cycle.csv` \[crank_angle\]; `converged`, 1 where the step did | load cycles |
//! | `fields/` | the same \[crank_angle, angle, axial\] with their axes, over the last cycle | load cycles with a film on a grid |
//! | `accumulated/shell/`, `accumulated/journal/` | what each point of that surface has seen over the last cycle: `minimum_film_thickness`, `maximum_pressure`, `pressure_amplitude`, `full_film_share` \[angle, axial\], angles from +X of the surface; with wear `wear_load`, `friction_energy` of asperities, `peak_pressure_velocity`, `mean_pressure_velocity`, of the shell `wear_depth_per_hour` | the same |
//! | `running_in/` | the columns of `running-in.csv` \[time\], attribute `end`; in `shell/` `worn_depth` \[angle, axial\] | a shell that ran in |
//!
//! `[output] fields` of the study chooses the instants of `fields/`.
//!
//! Of an engine or shaft each speed has a group `speeds/<speed>/`, such as `speeds/2000rpm/`:
//!
//! | where | holds |
//! |---|---|
//! | `engine/`, `orders/` | the columns of `engine.csv` and `orders.csv`, mean effective pressures, mean torque |
//! | `torsion/` | natural frequencies, mean heat of each link |
//! | `bearings/<name>/` | attributes `role`, `status`; in it `bearing/`, where its heat is balanced `heat/` (temperatures, K), `load/` (the load cycle), `cycle/`, `accumulated/` as above; `worst/`, the film at its thinnest; at the first speed `fields/`, the frames of the cycle |

mod machine;

use super::csv::cycle_columns;
use super::{OutputError, ResultWriter, StoredFields, json, replace_with, running_in};
use crate::hdf5::{Attribute, Node, Writer};
use crate::results::{
    AccumulatedMap, Body, CycleFields, CycleResults, FieldSnapshot, Header, PROGRAM, Results,
    SCHEMA, VERSION, degrees, status_name,
};
use crate::spool::{FieldSpool, Quantity};
use serde_json::Value;
use sommerfeld_bearing::{CyclePoint, RanIn};
use sommerfeld_film::{Bearing, Outcome};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};

/// Writes `results.h5`.
#[derive(Debug, Clone, Copy)]
pub struct Hdf5Results;

impl ResultWriter for Hdf5Results {
    fn file_name(&self) -> &'static str {
        "results.h5"
    }

    fn describe(&self) -> &'static str {
        "everything, self-describing: summary, cycle, fields over crank angle, accumulated maps"
    }

    fn write(
        &self,
        results: &Results,
        stored: StoredFields<'_>,
        directory: &Path,
    ) -> Result<Vec<PathBuf>, OutputError> {
        let path = directory.join(self.file_name());
        replace_with(&path, |file| write(file, results, stored))?;
        Ok(vec![path])
    }
}

/// Writes the file into `sink`.
///
/// # Errors
/// What the disk says.
pub fn write(
    sink: impl Write + Seek,
    results: &Results,
    stored: StoredFields<'_>,
) -> io::Result<()> {
    let mut file = Layout {
        file: Writer::new(sink)?,
    };
    file.header(&results.header);
    let Value::Object(mut summary) = json::summary(results) else {
        return Ok(());
    };
    let error = summary.remove("error");
    summary.remove("limits");
    let root = file.file.root();
    let group = file.file.group(root, "summary")?;
    file.numbers(group, &Value::Object(summary))?;
    if let Some(error) = error {
        let group = file.file.group(root, "error")?;
        file.numbers(group, &error)?;
    }
    file.limits(&results.header)?;
    match &results.body {
        Body::Steady(steady) => {
            file.bearing(root, &steady.bearing)?;
            if let Some(field) = &steady.field {
                let group = file.file.group(root, "film")?;
                file.snapshot(group, field)?;
            }
        }
        Body::LoadCycle(cycle) => {
            file.bearing(root, &cycle.bearing)?;
            file.cycle(root, cycle, stored)?;
            if let Some(ran) = &cycle.running_in {
                file.running_in(root, ran)?;
            }
        }
        Body::Machine(machine) => file.machine(machine)?,
        Body::Dimensionless(_) | Body::Database(_) | Body::Sweep(_) => {}
    }
    file.file.finish()?.flush()
}

/// Places results in a file.
struct Layout<W> {
    file: Writer<W>,
}

/// Axes of fields in the order of their dimensions: name, unit, values.
type Axis<'a> = (&'a str, &'a str, Vec<f64>);

/// Takes the field of a quantity at the instant of this number.
type ReadInstant<'a> = dyn FnMut(Quantity, usize, &mut [f32]) -> io::Result<()> + 'a;

impl<W: Write + Seek> Layout<W> {
    fn header(&mut self, header: &Header) {
        let root = self.file.root();
        let texts = [
            ("program", PROGRAM),
            ("version", VERSION),
            ("analysis", &header.analysis),
            ("status", status_name(header.status)),
            ("title", &header.title),
            ("study", &header.study_text),
        ];
        for (name, text) in texts {
            self.file.set(root, name, text);
        }
        self.file
            .set(root, "schema", Attribute::Integer(SCHEMA.into()));
        if let Some(hash) = &header.study_hash {
            self.file.set(root, "study_hash", hash.as_str());
        }
        let models = header.models.iter();
        let models = models.map(|m| format!("{}: {} ({})", m.family, m.name, m.reference));
        for (name, list) in [
            ("messages", header.messages.clone()),
            ("models", models.collect()),
        ] {
            if !list.is_empty() {
                self.file.set(root, name, Attribute::Texts(list));
            }
        }
    }

    /// A dataset with what it is.
    fn add(
        &mut self,
        group: Node,
        name: &str,
        unit: &str,
        shape: &[usize],
        values: &[f64],
    ) -> io::Result<Node> {
        // One NaN for all that is not finite: equal results are equal bytes.
        let shown = |value: &f64| if value.is_finite() { *value } else { f64::NAN };
        let values: Vec<f64> = values.iter().map(shown).collect();
        let node = self.file.doubles(group, name, shape, &values)?;
        self.describe(node, name, unit);
        Ok(node)
    }

    fn describe(&mut self, node: Node, name: &str, unit: &str) {
        self.file.set(node, "units", unit);
        let long_name = name.replace('_', " ");
        self.file.set(node, "long_name", long_name.as_str());
    }

    /// The numbers of an object of `summary.json`: scalars, arrays, objects as groups. Text stays there.
    fn numbers(&mut self, group: Node, object: &Value) -> io::Result<()> {
        for (key, value) in object.as_object().into_iter().flatten() {
            if value.is_object() {
                let inner = self.file.group(group, key)?;
                self.numbers(inner, value)?;
            } else if let Some((shape, values)) = array_of(value) {
                let node = self.add(group, key, unit_of(key), &shape, &values)?;
                let name = words_of(key);
                self.file.set(node, "long_name", name.as_str());
            }
        }
        Ok(())
    }

    fn limits(&mut self, header: &Header) -> io::Result<()> {
        let root = self.file.root();
        for check in &header.limits {
            let limits = self.file.group(root, "limits")?;
            let quantity = check.limit.quantity;
            let group = self.file.group(limits, quantity.key())?;
            let unit = unit_of(&format!("_{}", quantity.unit_suffix()));
            self.add(group, "limit", unit, &[], &[check.limit.value])?;
            let found = check.found.unwrap_or(f64::NAN);
            self.add(group, "value", unit, &[], &[found])?;
            let verdict = serde_json::to_value(check.verdict)?;
            self.file
                .set(group, "verdict", verdict.as_str().unwrap_or_default());
            self.file.set(group, "source", check.limit.source.as_str());
            if let Some(at) = &check.at {
                self.file.set(group, "at", at.as_str());
            }
        }
        Ok(())
    }

    fn bearing(&mut self, place: Node, bearing: &Bearing) -> io::Result<()> {
        let group = self.file.group(place, "bearing")?;
        for (name, value) in [
            ("diameter", bearing.diameter),
            ("width", bearing.width),
            ("radial_clearance", bearing.radial_clearance),
        ] {
            self.add(group, name, "m", &[], &[value])?;
        }
        Ok(())
    }

    fn cycle(
        &mut self,
        place: Node,
        cycle: &CycleResults,
        stored: StoredFields<'_>,
    ) -> io::Result<()> {
        if !cycle.orbit.points.is_empty() {
            let group = self.file.group(place, "cycle")?;
            let mut columns = cycle_columns(cycle);
            columns.push(converged(cycle));
            self.columns(group, columns)?;
        }
        match &cycle.fields {
            Some(fields) => self.fields(place, fields, stored),
            None => Ok(()),
        }
    }

    /// How the shell ran in, and what it has lost.
    fn running_in(&mut self, place: Node, ran: &RanIn) -> io::Result<()> {
        let group = self.file.group(place, "running_in")?;
        self.file.set(group, "end", ran.end.name());
        // A first cycle that was not solved leaves neither steps nor cells.
        if ran.steps.is_empty() {
            return Ok(());
        }
        self.columns(group, running_in::columns(ran))?;
        let shell = self.file.group(group, "shell")?;
        let depth: [(&str, &str, &[f64]); 1] = [("worn_depth", "m", &ran.depth)];
        self.surface(shell, &ran.angles, &ran.axial, &depth)
    }

    /// What the surfaces have seen over a cycle, and the fields of its instants.
    fn fields(
        &mut self,
        place: Node,
        fields: &CycleFields,
        stored: StoredFields<'_>,
    ) -> io::Result<()> {
        let accumulated = self.file.group(place, "accumulated")?;
        for (name, map) in [("shell", &fields.on_shell), ("journal", &fields.on_journal)] {
            let group = self.file.group(accumulated, name)?;
            self.accumulated(group, map)?;
        }
        match stored {
            StoredFields::Spool(spool) if !spool.crank_angles().is_empty() => {
                self.spooled(place, spool)
            }
            StoredFields::Spool(_) | StoredFields::None => Ok(()),
            StoredFields::Frames => self.frames(place, fields),
        }
    }

    /// Columns of a table, the first of them the scale of the others.
    fn columns(&mut self, group: Node, columns: Vec<(String, Vec<f64>)>) -> io::Result<()> {
        let mut scale = None;
        for (header, values) in columns {
            let (name, unit) = header.split_once('[').unwrap_or((&header, "-]"));
            let unit = match unit.trim_end_matches(']') {
                "-" => "1",
                unit => unit,
            };
            let node = self.add(group, name, unit, &[values.len()], &values)?;
            match scale {
                None => scale = Some(node),
                Some(first) => self.file.attach_scale(node, 0, first)?,
            }
        }
        Ok(())
    }

    fn axes(&mut self, group: Node, axes: &[Axis<'_>]) -> io::Result<Vec<Node>> {
        let axes = axes.iter();
        axes.map(|(name, unit, values)| self.add(group, name, unit, &[values.len()], values))
            .collect()
    }

    fn attach(&mut self, node: Node, axes: &[Node]) -> io::Result<()> {
        let mut axes = axes.iter().enumerate();
        axes.try_for_each(|(dimension, axis)| self.file.attach_scale(node, dimension, *axis))
    }

    /// Values over a surface.
    fn surface(
        &mut self,
        group: Node,
        angles: &[f64],
        axial: &[f64],
        maps: &[(&str, &str, &[f64])],
    ) -> io::Result<()> {
        let axes = self.axes(group, &surface_axes(angles, axial))?;
        for (name, unit, values) in maps {
            let shape = [angles.len(), axial.len()];
            let node = self.add(group, name, unit, &shape, values)?;
            self.attach(node, &axes)?;
        }
        Ok(())
    }

    fn snapshot(&mut self, group: Node, field: &FieldSnapshot) -> io::Result<()> {
        let maps = Quantity::among(field).map(|quantity| {
            let (name, unit) = name_of(quantity);
            (name, unit, quantity.of(field))
        });
        let maps: Vec<_> = maps.collect();
        self.surface(group, &field.angles, &field.axial, &maps)
    }

    fn accumulated(&mut self, group: Node, map: &AccumulatedMap) -> io::Result<()> {
        let maps: [(&str, &str, &[f64]); 4] = [
            ("minimum_film_thickness", "m", &map.minimum_film_thickness),
            ("maximum_pressure", "Pa", &map.maximum_pressure),
            ("pressure_amplitude", "Pa", &map.pressure_amplitude),
            ("full_film_share", "1", &map.full_film_share),
        ];
        let wear = map.wear.as_ref().map(|wear| {
            let seen = &wear.map;
            let depth = wear.depth_per_hour();
            let mut all = vec![
                ("wear_load", "J/m2", seen.wear_load.clone()),
                ("friction_energy", "J/m2", wear.friction_energy()),
                (
                    "peak_pressure_velocity",
                    "W/m2",
                    seen.peak_pressure_velocity.clone(),
                ),
                (
                    "mean_pressure_velocity",
                    "W/m2",
                    seen.mean_pressure_velocity.clone(),
                ),
            ];
            all.extend(depth.map(|depth| ("wear_depth_per_hour", "m", depth)));
            all
        });
        let mut maps = maps.to_vec();
        let wear = wear.iter().flatten();
        maps.extend(wear.map(|(name, unit, values)| (*name, *unit, values.as_slice())));
        self.surface(group, &map.angles, &map.axial, &maps)
    }

    fn spooled(&mut self, place: Node, spool: &FieldSpool) -> io::Result<()> {
        let (angles, axial) = (spool.angles(), spool.axial());
        self.over_cycle(
            place,
            spool.quantities(),
            spool.crank_angles(),
            angles,
            axial,
            &mut |quantity, row, values| spool.read(quantity, row, values),
        )
    }

    fn frames(&mut self, place: Node, fields: &CycleFields) -> io::Result<()> {
        let frames = &fields.frames;
        let crank_angles: Vec<f64> = frames.iter().map(|frame| frame.crank_angle).collect();
        let grid = &fields.worst.field;
        let quantities: Vec<Quantity> = Quantity::among(grid).collect();
        self.over_cycle(
            place,
            &quantities,
            &crank_angles,
            &grid.angles,
            &grid.axial,
            &mut |quantity, row, values| {
                let field = quantity.of(&frames[row].field);
                for (value, found) in values.iter_mut().zip(field) {
                    *value = *found as f32;
                }
                Ok(())
            },
        )
    }

    /// The fields over crank angle, taken instant by instant.
    fn over_cycle(
        &mut self,
        place: Node,
        quantities: &[Quantity],
        crank_angles: &[f64],
        angles: &[f64],
        axial: &[f64],
        read: &mut ReadInstant<'_>,
    ) -> io::Result<()> {
        if crank_angles.is_empty() {
            return Ok(());
        }
        let group = self.file.group(place, "fields")?;
        let crank = crank_angles.iter().copied().map(degrees).collect();
        let mut axes = vec![("crank_angle", "deg", crank)];
        axes.extend(surface_axes(angles, axial));
        let axes = self.axes(group, &axes)?;
        let shape = [crank_angles.len(), angles.len(), axial.len()];
        for &quantity in quantities {
            let (name, unit) = name_of(quantity);
            let mut row = |row: usize, values: &mut [f32]| read(quantity, row, values);
            let node = self.file.rows(group, name, &shape, &mut row)?;
            self.describe(node, name, unit);
            self.attach(node, &axes)?;
        }
        Ok(())
    }
}

/// The column that says at which crank angles the step was solved.
fn converged(cycle: &CycleResults) -> (String, Vec<f64>) {
    let points = cycle.orbit.points.iter();
    let is_solved = |p: &CyclePoint| f64::from(u8::from(p.outcome == Outcome::Converged));
    ("converged[-]".to_owned(), points.map(is_solved).collect())
}

fn surface_axes(angles: &[f64], axial: &[f64]) -> [Axis<'static>; 2] {
    let angles = angles.iter().copied().map(degrees).collect();
    [("angle", "deg", angles), ("axial", "m", axial.to_vec())]
}

fn name_of(quantity: Quantity) -> (&'static str, &'static str) {
    match quantity {
        Quantity::Pressure => ("pressure", "Pa"),
        Quantity::FilmFraction => ("film_fraction", "1"),
        Quantity::FilmThickness => ("film_thickness", "m"),
        Quantity::ContactPressure => ("contact_pressure", "Pa"),
        Quantity::Temperature => ("temperature", "K"),
    }
}

/// Shape and values of a number (`null` stands for one that is not finite) or of nested lists of
/// them; `None` for anything else.
fn array_of(value: &Value) -> Option<(Vec<usize>, Vec<f64>)> {
    match value {
        Value::Null => Some((Vec::new(), vec![f64::NAN])),
        Value::Number(number) => Some((Vec::new(), vec![number.as_f64()?])),
        Value::Array(items) => {
            let parts: Vec<_> = items.iter().map(array_of).collect::<Option<_>>()?;
            let inner = parts.first()?.0.clone();
            let mut shape = vec![parts.len()];
            let mut values = Vec::new();
            for (part, found) in parts {
                if part != inner {
                    return None;
                }
                values.extend(found);
            }
            shape.extend(inner);
            Some((shape, values))
        }
        _ => None,
    }
}

/// Ends of the keys of a summary and the units they stand for. Longer ends come first, as shorter ones
/// are part of them.
const UNITS: [(&str, &str); 25] = [
    ("_n_m_s_rad", "N.m.s/rad"),
    ("_n_s_rad", "N.s/rad"),
    ("_n_m_rad", "N.m/rad"),
    ("_n_s_m", "N.s/m"),
    ("_n_rad", "N/rad"),
    ("_rad_s", "rad/s"),
    ("_kg_m3", "kg/m3"),
    ("_m3_s", "m3/s"),
    ("_w_m2", "W/m2"),
    ("_j_m2", "J/m2"),
    ("_m3", "m3"),
    ("_pa_s", "Pa.s"),
    ("_n_m", "N.m"),
    ("_m_s", "m/s"),
    ("_degc", "degC"),
    ("_deg", "deg"),
    ("_rad", "rad"),
    ("_rpm", "rpm"),
    ("_hz", "Hz"),
    ("_pa", "Pa"),
    ("_kg", "kg"),
    ("_w", "W"),
    ("_n", "N"),
    ("_s", "s"),
    ("_m", "m"),
];

/// The unit that the key of a summary ends in, spelt for readers; `1` if it ends in none.
fn unit_of(key: &str) -> &'static str {
    if key.starts_with("stiffness") && key.ends_with("_n_m") {
        return "N/m";
    }
    let found = UNITS.iter().find(|(end, _)| key.ends_with(end));
    found.map_or("1", |(_, unit)| unit)
}

/// A key of a summary in words, without its unit.
fn words_of(key: &str) -> String {
    let found = UNITS.iter().find_map(|(end, _)| key.strip_suffix(end));
    found.unwrap_or(key).replace('_', " ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn units_are_those_of_the_keys() {
        for (key, unit) in [
            ("minimum_film_thickness_m", "m"),
            ("friction_torque_shell_n_m", "N.m"),
            ("stiffness_n_m", "N/m"),
            ("damping_n_s_m", "N.s/m"),
            ("side_flow_m3_s", "m3/s"),
            ("wall_time_s", "s"),
            ("force_n", "N"),
            ("power_loss_w", "W"),
            ("peak_film_pressure_angle_deg", "deg"),
            ("iterations", "1"),
            ("relative_eccentricity", "1"),
        ] {
            assert_eq!(unit_of(key), unit, "{key}");
        }
    }

    #[test]
    fn names_are_words_without_units() {
        assert_eq!(words_of("power_loss_w"), "power loss");
        assert_eq!(words_of("steps"), "steps");
    }

    #[test]
    fn lists_become_arrays() {
        let matrix = array_of(&json!([[1.0, 2.0], [3.0, 4.0]]));
        assert_eq!(matrix, Some((vec![2, 2], vec![1.0, 2.0, 3.0, 4.0])));
        assert_eq!(array_of(&json!(["a"])), None);
        assert_eq!(array_of(&json!([[1.0], 2.0])), None);
        assert!(array_of(&json!(null)).is_some_and(|(_, values)| values[0].is_nan()));
    }
}
