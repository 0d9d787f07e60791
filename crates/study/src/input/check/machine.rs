//! An engine or shaft as a whole: oil, speeds, orbits, what holds its shells.

use super::Checker;
use super::duty::round;
use super::machine_bearings::Place;
use crate::input::error::InputError;
use crate::input::machine::OrbitPlan;
use crate::input::schema::Mode;
use crate::input::study::Subject;
use crate::input::values::Value;
use crate::input::{Machine, MachinePlan};
use sommerfeld_engine::Supports;
use std::f64::consts::PI;

/// Largest difference of two entries of a symmetric matrix across its diagonal, over the larger one.
const ASYMMETRY: f64 = 1e-4;

impl Checker<'_> {
    /// The machine; `None` where an error says why not.
    pub(super) fn machine(&mut self) -> Option<Subject> {
        let heat = self.heat(None);
        let temperature = self.number("oil.temperature");
        let lubricant = temperature.and_then(|temperature| self.lubricant(temperature, &heat));
        let section = match self.mode {
            Mode::Engine => "engine",
            _ => "shaft",
        };
        let speeds = self.speeds(&format!("{section}.speed"));
        let orbit = self.orbit();
        let found = match self.mode {
            Mode::Engine => {
                // The oil of the drillings is as it is supplied.
                let supply = heat.as_ref().and_then(|heat| heat.path());
                let supply = supply.map(|path| path.supply_temperature).or(temperature);
                let oil = lubricant.as_ref().zip(supply);
                let density = oil.map(|(oil, temperature)| oil.density(temperature, 0.0).value);
                self.engine(&speeds, density)
            }
            _ => self.shaft(),
        };
        let (machine, bearings) = found?;
        let wear = self.wear(bearings.iter().map(|b| &b.bearing));
        let heat = heat?;
        self.check_warm_clearances(&heat, bearings.iter().map(|b| &b.bearing))?;
        Some(Subject::Machine(Box::new(MachinePlan {
            machine,
            bearings,
            lubricant: lubricant?,
            temperature: temperature?,
            heat,
            wear: wear?,
            speeds,
            orbit: orbit?,
        })))
    }

    /// Angle after which everything repeats, rad: of a load cycle, engine or shaft.
    pub(super) fn period(&self) -> Option<f64> {
        match self.mode {
            Mode::Engine => Some(self.strokes()?.period()),
            Mode::Shaft => self.number("shaft.period"),
            _ => self.number("load_cycle.period"),
        }
    }

    /// Speeds in the order of the file, each once.
    fn speeds(&mut self, path: &str) -> Vec<f64> {
        let speeds = self.list(path);
        let twice = speeds
            .iter()
            .enumerate()
            .find(|(at, speed)| speeds[..*at].contains(speed));
        if let Some((_, speed)) = twice {
            let message = format!("the speed {} rpm is given twice", round(speed * 30.0 / PI));
            let error = self.error_at(path, message);
            self.errors.push(error.hinting("give each speed once"));
        }
        speeds
    }

    fn orbit(&mut self) -> Option<OrbitPlan> {
        let period = self.period()?;
        let crank_step = self.crank_step("orbit", period);
        let Value::Integer(maximum_cycles) = self.value("orbit.maximum_cycles")? else {
            return None;
        };
        Some(OrbitPlan {
            crank_step: crank_step?,
            maximum_cycles: usize::try_from(maximum_cycles).ok()?,
            closure_tolerance: self.number("orbit.closure_tolerance")?,
        })
    }

    /// A film in closed form has no tilt: an elastic shaft tilts in its bearings.
    pub(super) fn refuse_elastic_closed_form(&mut self, model_key: &str) {
        let Some(model) = self.model_without_tilt() else {
            return;
        };
        let message = format!(
            "an elastic shaft tilts in its bearings, and the film model {} has no tilt",
            model.name()
        );
        let error = self.error_at(model_key, message);
        self.errors.push(error.hinting(
            "use film.model = \"field\", or model = \"determinate\" for the loads of the bearings",
        ));
    }

    /// What holds the shells of `count` bearings; `section` holds its keys.
    pub(super) fn supports(&mut self, section: &str, count: usize) -> Option<Supports> {
        let path = |name: &str| format!("{section}.{name}");
        let stiffness = self.pair(&path("support_stiffness"));
        let tilt = self.pair(&path("support_tilt_stiffness"));
        let coupling = self.number(&path("support_coupling"))?;
        if self.entry(&path("support_matrix")).is_some() {
            for name in [
                "support_stiffness",
                "support_tilt_stiffness",
                "support_coupling",
            ] {
                if self.entry(&path(name)).is_some() {
                    let message = "the stiffness of the supports is given twice";
                    let error = self.error_at(&path(name), message);
                    self.errors
                        .push(error.hinting("support_matrix holds all of it"));
                    return None;
                }
            }
            return self.support_matrix(&path("support_matrix"), count);
        }
        let Some([x, y]) = stiffness else {
            for name in ["support_tilt_stiffness", "support_coupling"] {
                if self.entry(&path(name)).is_some() {
                    let message = format!("`{name}` belongs to an elastic support");
                    let error = self.error_at(&path(name), message);
                    self.errors
                        .push(error.hinting("give support_stiffness, too"));
                    return None;
                }
            }
            return Some(Supports::Rigid);
        };
        if coupling * coupling >= x * y {
            let most = round((x * y).sqrt());
            let error = self.error_at(
                &path("support_coupling"),
                "a support with this coupling would push itself away",
            );
            self.errors.push(error.allowing(format!(
                "less than {most} N/m, the root of the two stiffnesses"
            )));
            return None;
        }
        Some(Supports::Each {
            stiffness: [[x, coupling], [coupling, y]],
            tilt_stiffness: tilt.map(|[x, y]| [[x, 0.0], [0.0, y]]),
        })
    }

    /// The condensed matrix of the block over `count` bearings.
    fn support_matrix(&mut self, key: &str, count: usize) -> Option<Supports> {
        let name = self.text(key)?;
        let named_at = self.error_at(key, "");
        let table = self.table_text(&name, "stiffness matrix", named_at)?;
        match read_matrix(&table.file, &table.text, 4 * count) {
            Ok(matrix) => Some(Supports::Matrix(matrix)),
            Err(error) => {
                self.errors.push(*error);
                None
            }
        }
    }
}

/// A symmetric matrix of numbers, row by row; lines that start with `#` are comments.
fn read_matrix(file: &str, text: &str, size: usize) -> Result<Vec<f64>, Box<InputError>> {
    let refuse = |message: String| {
        let wanted = format!("{size} rows of {size} numbers, 4 for each bearing");
        Box::new(InputError::new(file, message).allowing(wanted))
    };
    let rows = text
        .lines()
        .enumerate()
        .map(|(at, line)| (at + 1, line.trim()));
    let rows = rows.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let mut matrix = Vec::new();
    let mut count = 0;
    for (line, row) in rows {
        let cells: Vec<&str> = row.split([',', ';']).map(str::trim).collect();
        if cells.len() != size {
            return Err(refuse(format!(
                "line {line} of the stiffness matrix has {} numbers",
                cells.len()
            )));
        }
        for cell in cells {
            let number = cell.parse().ok().filter(|number: &f64| number.is_finite());
            let shown: String = cell.chars().take(40).collect();
            let number = number.ok_or_else(|| {
                refuse(format!(
                    "line {line} of the stiffness matrix holds \"{}\", no number",
                    shown.escape_debug()
                ))
            })?;
            matrix.push(number);
        }
        count += 1;
        if count > size {
            break;
        }
    }
    if count != size {
        let more = if count > size { "more than " } else { "" };
        let rows = count.min(size);
        return Err(refuse(format!(
            "the stiffness matrix has {more}{rows} rows"
        )));
    }
    for i in 0..size {
        if matrix[i * size + i] <= 0.0 {
            return Err(refuse(format!(
                "the stiffness matrix has no stiffness in row {}: its diagonal is not above 0",
                i + 1
            )));
        }
        for k in 0..i {
            let (a, b) = (matrix[i * size + k], matrix[k * size + i]);
            let scale = (matrix[i * size + i] * matrix[k * size + k]).sqrt();
            if (a - b).abs() > ASYMMETRY * scale {
                let (row, column) = (i + 1, k + 1);
                return Err(Box::new(refuse(format!(
                    "the stiffness matrix is not symmetric: {a} in row {row}, column {column}, and {b} across"
                )).hinting("write it in N/m, N and N.m/rad; every bearing has x, y, tilt about x, tilt about y")));
            }
        }
    }
    Ok(matrix)
}

/// A machine with its bearings.
pub(super) type Found = (Machine, Vec<crate::input::MachineBearing>);

/// The bearings along a shaft must not run into each other: `neighbours` are places along it.
impl Checker<'_> {
    /// Refuses bearings that overlap along the shaft.
    pub(super) fn refuse_overlaps_along(&mut self, mut places: Vec<Place>) {
        places.sort_by(|a, b| a.axial.total_cmp(&b.axial));
        for pair in places.windows(2) {
            let [a, b] = pair else { continue };
            let room = b.axial - a.axial;
            let needed = 0.5 * (a.width + b.width);
            if needed > room * (1.0 + 1e-9) {
                let mm = super::grooves::mm;
                let message = format!(
                    "the bearing is wider than its place: {} and {} overlap by {} mm",
                    a.name,
                    b.name,
                    mm(needed - room)
                );
                let wider = if b.width > a.width { b } else { a };
                let mut error = wider.error.clone();
                error.message = message;
                let allowed = format!(
                    "half widths of the two together up to {} mm, the distance of their centres",
                    mm(room)
                );
                if !self
                    .errors
                    .iter()
                    .any(|e| e.place == error.place && e.key == error.key)
                {
                    self.errors.push(error.allowing(allowed));
                }
            }
        }
    }
}
