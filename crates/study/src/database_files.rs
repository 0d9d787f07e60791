//! What a user asks of a database file: what is stored in it, what it says of states, how far it errs.

use crate::film_tables::{FilmTable, LookedUp, StoredFilms};
use crate::progress::ProgressEvent;
use sommerfeld_database::contents::{Contents, Value};
use sommerfeld_database::superposition::{Accuracy, Drive, SuperpositionTable, tilt_box};
use sommerfeld_database::{CheckReport, DatabaseError};
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::Path;

/// Everything that is stored in a database, for a reader: attributes, then datasets.
///
/// # Errors
/// [`DatabaseError`] where there is no such file, or it is no database, or damaged.
pub fn info(path: &Path) -> Result<String, DatabaseError> {
    let scheme = Contents::scheme(path)?;
    let contents = Contents::read(path, &scheme)?;
    let mut text = format!("{}\n", path.display());
    for (name, value) in &contents.attributes {
        let shown = match value {
            Value::Text(text) => text.clone(),
            Value::Integer(number) => number.to_string(),
            Value::Number(number) => shortest(*number),
            Value::Numbers(all) => told(name, all).unwrap_or_else(|| {
                let all: Vec<String> = all.iter().copied().map(shortest).collect();
                all.join(", ")
            }),
        };
        // Writing into a String cannot fail.
        let _ = writeln!(text, "  {name:<28} {shown}");
    }
    text += "datasets\n";
    for (name, array) in &contents.arrays {
        let shape: Vec<String> = array.shape.iter().map(usize::to_string).collect();
        let unit = match array.unit.as_str() {
            "1" => "-",
            unit => unit,
        };
        let name = format!("{name}[{unit}]");
        let _ = writeln!(
            text,
            "  {name:<28} {:<14} {}",
            shape.join(" x "),
            array.meaning
        );
    }
    Ok(text)
}

/// Numbers that mean nothing without their names: the errors of a drive of a superposition and the state that errs
/// most.
fn told(name: &str, numbers: &[f64]) -> Option<String> {
    match *numbers {
        [samples, largest, of_999, median, nodes] if name.starts_with("accuracy_") => {
            Some(format!(
                "{largest:.2e} largest, {of_999:.2e} of 99.9 %, {median:.2e} median of {samples} samples, \
             {nodes:.2e} of the nodes before they are extrapolated"
            ))
        }
        [eccentricity, along, across] if name.starts_with("worst_") => Some(format!(
            "eccentricity {eccentricity:.4}, tilt along {along:.4} and across {across:.4}"
        )),
        _ => None,
    }
}

fn shortest(number: f64) -> String {
    match number.abs() {
        1e-3..1e6 => number.to_string(),
        0.0 => "0".to_owned(),
        _ => format!("{number:e}"),
    }
}

/// How far a database is from films solved anew.
#[derive(Debug, Clone, PartialEq)]
pub enum FileCheck {
    /// Of a table of wedge and squeeze together.
    Combined(CombinedCheck),
    /// Of tables of wedge and squeeze apart: each against its own films, not against their sum.
    Superposition(Vec<SuperposedCheck>),
}

/// How far a table of wedge and squeeze together is from films solved anew.
#[derive(Debug, Clone, PartialEq)]
pub struct CombinedCheck {
    /// What the states show.
    pub report: CheckReport,
    /// Error that the database was built for, which no state may exceed.
    pub bound: f64,
    /// Largest error that the file states.
    pub stated: f64,
}

/// How far the table of one drive is from films solved anew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SuperposedCheck {
    /// What drives the film.
    pub drive: Drive,
    /// What the states show.
    pub found: Accuracy,
    /// What the file states.
    pub stated: Accuracy,
    /// Error that the database was built for, which no state may exceed.
    pub bound: f64,
}

impl FileCheck {
    /// Wedge and squeeze together: no state errs by more than the database was built for, and no film makes
    /// power. Apart: none errs by more than that either.
    #[must_use]
    pub fn is_kept(&self) -> bool {
        match self {
            Self::Combined(CombinedCheck { report, bound, .. }) => {
                report.maximum <= *bound && report.dissipation_minimum >= 0.0
            }
            Self::Superposition(drives) => drives
                .iter()
                .all(|drive| drive.found.largest <= drive.bound),
        }
    }
}

/// Holds a database against films solved for states drawn anew from a seed; of the scheme superposition so
/// many for each of its three drives.
///
/// # Errors
/// [`DatabaseError`] where the file cannot be used or a film cannot be solved.
pub fn check(path: &Path, samples: usize, seed: u64) -> Result<FileCheck, DatabaseError> {
    let found = check_with(path, samples, seed, &mut |_| ControlFlow::Continue(()))?;
    found.ok_or(DatabaseError::Interrupted {
        done: 0,
        total: samples,
    })
}

/// The same, telling how far it is where that takes long: a database of the scheme superposition. `None` where
/// `progress` ended it.
///
/// # Errors
/// As [`check`].
pub fn check_with(
    path: &Path,
    samples: usize,
    seed: u64,
    progress: &mut dyn FnMut(ProgressEvent) -> ControlFlow<()>,
) -> Result<Option<FileCheck>, DatabaseError> {
    let stored = StoredFilms::load(&path.to_string_lossy(), path)?;
    match &stored.table {
        FilmTable::Combined(table) => Ok(Some(FileCheck::Combined(CombinedCheck {
            report: sommerfeld_database::check(table, samples, seed)?,
            bound: table.recipe().target,
            stated: table.errors().maximum,
        }))),
        FilmTable::Superposition(table) => match check_apart(table, samples, seed, progress) {
            Ok(drives) => Ok(Some(FileCheck::Superposition(drives))),
            Err(DatabaseError::Interrupted { .. }) => Ok(None),
            Err(error) => Err(error),
        },
    }
}

fn check_apart(
    table: &SuperpositionTable,
    samples: usize,
    seed: u64,
    progress: &mut dyn FnMut(ProgressEvent) -> ControlFlow<()>,
) -> Result<Vec<SuperposedCheck>, DatabaseError> {
    let found = table.check(samples, seed, &mut |done, total| {
        let label = format!("{done} of {total} films");
        let share = done as f64 / total.max(1) as f64;
        progress(ProgressEvent::new(label, share)).is_continue()
    })?;
    let both = found.into_iter().zip(*table.accuracy());
    let drives = Drive::ALL.into_iter().zip(both);
    Ok(drives
        .map(|(drive, (found, stated))| SuperposedCheck {
            drive,
            found,
            stated,
            bound: table.recipe().target,
        })
        .collect())
}

/// A bearing with its oil, for answers in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Bore diameter, m.
    pub diameter: f64,
    /// Bearing width, m.
    pub width: f64,
    /// Radial clearance, m.
    pub radial_clearance: f64,
    /// Dynamic viscosity, Pa s.
    pub viscosity: f64,
    /// Journal plus shell speed minus twice the turning rate of the line of centres, rad/s.
    pub effective_speed: f64,
    /// Rate of the relative eccentricity, 1/s.
    pub eccentricity_rate: f64,
}

/// A state to be looked up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Width over diameter.
    pub width_ratio: f64,
    /// Relative eccentricity.
    pub eccentricity: f64,
    /// Angle of the effective velocity from the line of centres, rad.
    pub angle: f64,
    /// Relative tilts gamma and delta, see [`StoredFilms::look_tilted`].
    pub tilts: [f64; 2],
}

impl Scales {
    /// Effective velocity of the journal centre along and across the line of centres, m/s.
    #[must_use]
    pub fn velocity(&self, eccentricity: f64) -> [f64; 2] {
        let c = self.radial_clearance;
        [
            c * self.eccentricity_rate,
            -0.5 * c * eccentricity * self.effective_speed,
        ]
    }

    /// The state that a journal at this eccentricity is in.
    #[must_use]
    pub fn state(&self, eccentricity: f64) -> State {
        let [along, across] = self.velocity(eccentricity);
        State {
            width_ratio: self.width / self.diameter,
            eccentricity,
            angle: across.atan2(along),
            tilts: [0.0; 2],
        }
    }
}

/// What a database says of a state, as names, values and units; what its scheme stores.
#[must_use]
pub fn answer_rows(found: &LookedUp) -> Vec<(&'static str, f64, &'static str)> {
    stored_rows(vec![
        ("force_along", found.force[0], "-"),
        ("force_across", found.force[1], "-"),
        ("force_along_by_eccentricity", found.by_eccentricity[0], "-"),
        (
            "force_across_by_eccentricity",
            found.by_eccentricity[1],
            "-",
        ),
        ("force_along_by_direction", found.by_angle[0], "1/rad"),
        ("force_across_by_direction", found.by_angle[1], "1/rad"),
        ("moment_along", found.moment[0], "-"),
        ("moment_across", found.moment[1], "-"),
        ("peak_pressure", found.peak_pressure, "-"),
        ("peak_angle", found.peak_angle.to_degrees(), "deg"),
        ("side_flow_each_end", found.side_flow, "-"),
        ("full_film_share", found.full_film_share, "-"),
    ])
}

fn stored_rows(
    mut rows: Vec<(&'static str, f64, &'static str)>,
) -> Vec<(&'static str, f64, &'static str)> {
    rows.retain(|(_, value, _)| !value.is_nan());
    rows
}

/// The same in SI, for a bearing of these sizes at this eccentricity.
#[must_use]
pub fn dimensional_rows(
    found: &LookedUp,
    scales: &Scales,
    eccentricity: f64,
) -> Vec<(&'static str, f64, &'static str)> {
    let [along, across] = scales.velocity(eccentricity);
    let speed = along.hypot(across);
    let (radius, c) = (0.5 * scales.diameter, scales.radial_clearance);
    let per_velocity = scales.viscosity * radius.powi(3) * scales.width / (2.0 * c.powi(3));
    let force = per_velocity * speed;
    let moment = 0.5 * scales.width * force;
    let pressure = scales.viscosity * speed * radius.powi(2) / c.powi(3);
    // Per component of the velocity, from size and angle of w.
    let unit = if speed > 0.0 {
        [along / speed, across / speed]
    } else {
        [1.0, 0.0]
    };
    let damping = |row: usize, column: usize| {
        let turned = [-unit[1], unit[0]];
        -per_velocity * (found.force[row] * unit[column] + found.by_angle[row] * turned[column])
    };
    stored_rows(vec![
        ("force_along", force * found.force[0], "N"),
        ("force_across", force * found.force[1], "N"),
        ("damping_along_along", damping(0, 0), "N s/m"),
        ("damping_along_across", damping(0, 1), "N s/m"),
        ("damping_across_along", damping(1, 0), "N s/m"),
        ("damping_across_across", damping(1, 1), "N s/m"),
        ("moment_along", moment * found.moment[0], "N m"),
        ("moment_across", moment * found.moment[1], "N m"),
        ("peak_pressure", pressure * found.peak_pressure, "Pa"),
        (
            "side_flow_each_end",
            speed * radius * scales.width * found.side_flow,
            "m3/s",
        ),
    ])
}

/// Looks up every row of a table of states (`eccentricity[-],direction[deg]`, and `width_ratio[-]` where
/// the database holds several; `tilt_gamma[-]` and `tilt_delta[-]` of tilted journals) and returns the table with what it says.
///
/// # Errors
/// What is wrong with the table, in words with its line.
pub fn look_up_table(stored: &StoredFilms, text: &str) -> Result<String, String> {
    let [narrow, wide] = stored.facts().width_ratios;
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let header = reader.headers().map_err(|error| error.to_string())?.clone();
    let column = |name: &str| header.iter().position(|column| column == name);
    let needed =
        |name: &str| column(name).ok_or_else(|| format!("line 1: the column {name} is missing"));
    let (eccentricity, direction) = (needed("eccentricity[-]")?, needed("direction[deg]")?);
    let ratio = column("width_ratio[-]");
    let tilts = [column("tilt_gamma[-]"), column("tilt_delta[-]")];
    if ratio.is_none() && narrow != wide {
        return Err(
            "line 1: the column width_ratio[-] is missing: the database holds several".to_owned(),
        );
    }
    let mut table = String::new();
    for record in reader.records() {
        let record = record.map_err(|error| error.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |at: usize| {
            let cell = record.get(at).unwrap_or_default();
            let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| format!("line {line}: {cell} is no number"))
        };
        let state = State {
            width_ratio: ratio.map_or(Ok(narrow), number)?,
            eccentricity: number(eccentricity)?,
            angle: number(direction)?.to_radians(),
            tilts: [
                tilts[0].map_or(Ok(0.0), number)?,
                tilts[1].map_or(Ok(0.0), number)?,
            ],
        };
        let found = look_up(stored, &state).map_err(|error| format!("line {line}: {error}"))?;
        let rows = answer_rows(&found);
        if table.is_empty() {
            let names = rows.iter().map(|(name, _, unit)| format!("{name}[{unit}]"));
            let names: Vec<String> = header.iter().map(str::to_owned).chain(names).collect();
            table = names.join(",") + "\n";
        }
        let values = rows.iter().map(|(_, value, _)| format!("{value:?}"));
        let cells: Vec<String> = record.iter().map(str::to_owned).chain(values).collect();
        table += &(cells.join(",") + "\n");
    }
    if table.is_empty() {
        return Err("the table has no rows".to_owned());
    }
    Ok(table)
}

/// What a database says of a state.
///
/// # Errors
/// What it does not hold, in words.
pub fn look_up(stored: &StoredFilms, state: &State) -> Result<LookedUp, String> {
    if !(0.0..1.0).contains(&state.eccentricity) {
        return Err(format!(
            "the relative eccentricity {} is out of range: from 0 to below 1",
            state.eccentricity
        ));
    }
    let [gamma, delta] = state.tilts;
    if state.tilts != [0.0; 2] {
        if !stored.is_tilted() {
            return Err(
                "the database holds aligned journals: one with journal = \"tilted\" holds tilts"
                    .to_owned(),
            );
        }
        let gap = gap_of(state);
        if gap.is_nan() || gap <= 0.0 {
            return Err(format!(
                "the tilts gamma {gamma} and delta {delta} close the gap at an edge at the relative \
                 eccentricity {}: alone, gamma lies within 1 and delta within {:.6}, together less",
                state.eccentricity,
                (1.0 - state.eccentricity * state.eccentricity).sqrt()
            ));
        }
    }
    stored
        .look_tilted(
            state.width_ratio,
            state.eccentricity,
            state.angle,
            state.tilts,
        )
        .map_err(|error| error.to_string())
}

/// Smallest relative film thickness of a state.
fn gap_of(state: &State) -> f64 {
    let [gamma, delta] = state.tilts;
    tilt_box::smallest_gap(
        state.eccentricity,
        gamma * (1.0 - state.eccentricity),
        delta,
    )
}

/// That a state lies where the database has no stated error.
#[must_use]
pub fn beyond(stored: &StoredFilms, state: &State) -> Option<String> {
    let facts = stored.facts();
    let gap = gap_of(state);
    if state.eccentricity > facts.last_eccentricity {
        return Some(format!(
            "beyond the last eccentricity of the database, {}, its film is continued smoothly, without a \
             stated error",
            facts.last_eccentricity
        ));
    }
    if let FilmTable::Superposition(table) = &stored.table {
        let least = table.recipe().smallest_eccentricity;
        if state.eccentricity < least {
            return Some(format!(
                "the relative eccentricity {} is below {least}, down to which the database states its error",
                state.eccentricity
            ));
        }
    }
    (facts.is_tilted && gap < facts.smallest_gap).then(|| {
        format!(
            "the smallest relative film thickness, {gap:.4}, is below {}, down to which the database states \
             its error",
            facts.smallest_gap
        )
    })
}
