//! Tables as CSV, the unit of each column in its header, SI with angles in degrees.
//!
//! Numbers are written with as many digits as it takes to read the same number back; what is not
//! finite is written `nan`, which common readers take as a number.

use super::{OutputError, ResultWriter};
use crate::cases::SweepResults;
use crate::results::{Body, CycleResults, FieldSnapshot, Results, degrees, status_name};
use sommerfeld_bearing::CyclePoint;
use sommerfeld_film::FeedFlow;

/// Writes `cycle.csv`: one row per crank angle of a load cycle.
#[derive(Debug, Clone, Copy)]
pub struct CycleTable;

impl ResultWriter for CycleTable {
    fn file_name(&self) -> &'static str {
        "cycle.csv"
    }

    fn describe(&self) -> &'static str {
        "load cycle: orbit, load, film, flows and power per crank angle"
    }

    fn is_own_table(&self, first_line: &str) -> bool {
        begins_with(
            first_line,
            CYCLE_COLUMNS.iter().take(9).map(|(name, _)| *name),
        )
    }

    fn content(&self, results: &Results) -> Result<Option<Vec<u8>>, OutputError> {
        match &results.body {
            Body::LoadCycle(cycle) => cycle_table(cycle).map(Some),
            Body::Steady(_)
            | Body::Dimensionless(_)
            | Body::Machine(_)
            | Body::Database(_)
            | Body::Sweep(_) => Ok(None),
        }
    }
}

/// Writes `film.csv`: the fields cell by cell, of the steady state or of the worst crank angle.
#[derive(Debug, Clone, Copy)]
pub struct FieldTable;

impl ResultWriter for FieldTable {
    fn file_name(&self) -> &'static str {
        "film.csv"
    }

    fn describe(&self) -> &'static str {
        "film pressure, film fraction and film thickness per cell"
    }

    fn is_own_table(&self, first_line: &str) -> bool {
        begins_with(first_line, FIELD_COLUMNS)
    }

    fn content(&self, results: &Results) -> Result<Option<Vec<u8>>, OutputError> {
        let field = match &results.body {
            Body::Steady(steady) => steady.field.as_ref(),
            Body::LoadCycle(cycle) => cycle.fields.as_ref().map(|fields| &fields.worst.field),
            Body::Dimensionless(_) | Body::Machine(_) | Body::Database(_) | Body::Sweep(_) => None,
        };
        field.map(field_table).transpose()
    }
}

/// Writes `cases.csv`: one row per case of a sweep.
#[derive(Debug, Clone, Copy)]
pub struct CaseTable;

impl ResultWriter for CaseTable {
    fn file_name(&self) -> &'static str {
        "cases.csv"
    }

    fn describe(&self) -> &'static str {
        "sweep: varied values, status, key numbers and limits per case"
    }

    /// Between the number of the case and the status stand the keys that the sweep varies.
    fn is_own_table(&self, first_line: &str) -> bool {
        let mut cells = first_line.split(',');
        cells.next() == Some("case")
            && cells.any(|cell| cell == "status")
            && cells.next_back() == Some("message")
    }

    fn content(&self, results: &Results) -> Result<Option<Vec<u8>>, OutputError> {
        match &results.body {
            Body::Sweep(sweep) => case_table(sweep).map(Some),
            Body::Steady(_)
            | Body::LoadCycle(_)
            | Body::Dimensionless(_)
            | Body::Machine(_)
            | Body::Database(_) => Ok(None),
        }
    }
}

/// A column of the cycle table: its header and its value at a point, with the radial clearance in
/// m for what is relative to it.
type CycleColumn = (&'static str, fn(&CyclePoint, f64) -> f64);

/// The columns of the cycle table. Names and order of the first nine are fixed; more may follow.
const CYCLE_COLUMNS: &[CycleColumn] = &[
    ("crank_angle[deg]", |p, _| degrees(p.crank_angle)),
    ("eccentricity_x[-]", |p, c| p.state.position[0] / c),
    ("eccentricity_y[-]", |p, c| p.state.position[1] / c),
    ("load_x[N]", |p, _| p.load[0]),
    ("load_y[N]", |p, _| p.load[1]),
    ("minimum_film_thickness[m]", |p, _| {
        p.summary.minimum_film_thickness.value
    }),
    ("peak_film_pressure[Pa]", |p, _| {
        p.summary.peak_film_pressure.value
    }),
    ("power_loss[W]", |p, _| p.summary.power_loss()),
    ("side_flow[m3/s]", |p, _| {
        p.summary.side_flow[0] + p.summary.side_flow[1]
    }),
    ("feed_flow[m3/s]", |p, _| p.summary.feed_flow),
    ("storage_rate[m3/s]", |p, _| p.summary.storage_rate),
    ("friction_power[W]", |p, _| p.summary.friction_power),
    ("squeeze_power[W]", |p, _| p.summary.squeeze_power),
    ("friction_torque_journal[N.m]", |p, _| {
        p.reaction.friction_torque_journal
    }),
    ("friction_torque_shell[N.m]", |p, _| {
        p.reaction.friction_torque_shell
    }),
    ("force_x[N]", |p, _| p.reaction.force()[0]),
    ("force_y[N]", |p, _| p.reaction.force()[1]),
    ("moment_x[N.m]", |p, _| p.reaction.moment()[0]),
    ("moment_y[N.m]", |p, _| p.reaction.moment()[1]),
    ("applied_moment_x[N.m]", |p, _| p.moment[0]),
    ("applied_moment_y[N.m]", |p, _| p.moment[1]),
    ("tilt_rate_x[rad/s]", |p, _| p.state.tilt_rate[0]),
    ("tilt_rate_y[rad/s]", |p, _| p.state.tilt_rate[1]),
    ("minimum_edge_film_front[m]", |p, _| {
        p.summary.edge_film_thickness[0]
    }),
    ("minimum_edge_film_rear[m]", |p, _| {
        p.summary.edge_film_thickness[1]
    }),
    ("tilt_x[rad]", |p, _| p.state.tilt[0]),
    ("tilt_y[rad]", |p, _| p.state.tilt[1]),
    ("journal_speed[rad/s]", |p, _| p.state.journal_speed),
    ("shell_speed[rad/s]", |p, _| p.state.shell_speed),
    ("minimum_film_thickness_angle[deg]", |p, _| {
        degrees(p.summary.minimum_film_thickness.angle)
    }),
    ("minimum_film_thickness_axial[m]", |p, _| {
        p.summary.minimum_film_thickness.axial
    }),
    ("peak_film_pressure_angle[deg]", |p, _| {
        degrees(p.summary.peak_film_pressure.angle)
    }),
    ("peak_film_pressure_axial[m]", |p, _| {
        p.summary.peak_film_pressure.axial
    }),
    ("full_film_share[-]", |p, _| p.summary.full_film_share),
    ("mass_balance_relative[-]", |p, _| {
        p.summary.mass_balance_relative
    }),
    ("complementarity_violation[-]", |p, _| {
        p.summary.complementarity_violation
    }),
    ("side_flow_front[m3/s]", |p, _| p.summary.side_flow[0]),
    ("side_flow_rear[m3/s]", |p, _| p.summary.side_flow[1]),
];

/// The columns that follow where asperities can touch.
const CONTACT_COLUMNS: &[CycleColumn] = &[
    ("contact_load[N]", |p, _| p.summary.contact_load),
    ("peak_contact_pressure[Pa]", |p, _| {
        p.summary.peak_contact_pressure.value
    }),
    ("boundary_power[W]", |p, _| p.summary.boundary_power),
];

/// Headers and values of the columns of the cycle table that hold numbers.
pub(super) fn cycle_columns(cycle: &CycleResults) -> Vec<(String, Vec<f64>)> {
    let points = &cycle.orbit.points;
    let clearance = cycle.bearing.radial_clearance;
    let contact = cycle.bearing.finish.has_contact();
    let contact = CONTACT_COLUMNS.iter().filter(|_| contact);
    let fixed = CYCLE_COLUMNS.iter().chain(contact).map(|(name, value)| {
        let values = points.iter().map(|point| value(point, clearance));
        ((*name).to_owned(), values.collect())
    });
    let feeds = cycle.feed_flows.iter().map(Vec::len).max().unwrap_or(0);
    let of_feed = |feed: usize, value: fn(&FeedFlow) -> f64| {
        (0..points.len())
            .map(|index| {
                let flow = cycle.feed_flows.get(index).and_then(|row| row.get(feed));
                flow.map_or(f64::NAN, value)
            })
            .collect()
    };
    let name = |feed: usize, what: &str| format!("feed_{}_{what}", feed + 1);
    let flows = (0..feeds).map(|k| (name(k, "flow[m3/s]"), of_feed(k, |feed| feed.flow)));
    let pressures = (0..feeds).map(|k| (name(k, "pressure[Pa]"), of_feed(k, |feed| feed.pressure)));
    fixed.chain(flows).chain(pressures).collect()
}

/// The table of a load cycle as CSV: the fixed columns, the flow of each feed, the
/// pressure in each feed, the status.
///
/// # Errors
/// [`OutputError::Content`].
pub fn cycle_table(cycle: &CycleResults) -> Result<Vec<u8>, OutputError> {
    cycle_table_with(cycle, Vec::new())
}

/// The orbit with further columns, each with a value for every point, behind those of a load cycle.
pub(super) fn cycle_table_with(
    cycle: &CycleResults,
    further: Vec<(String, Vec<f64>)>,
) -> Result<Vec<u8>, OutputError> {
    let mut columns = cycle_columns(cycle);
    columns.extend(further);
    let mut table = Table::new(CycleTable.file_name());
    let headers = columns.iter().map(|(name, _)| name.as_str());
    table.row(headers.chain(["status"]))?;
    for (index, point) in cycle.orbit.points.iter().enumerate() {
        let numbers = columns.iter().map(|(_, values)| number(values[index]));
        let status = status_name(point.outcome).to_owned();
        table.row(numbers.chain([status]))?;
    }
    table.finish()
}

/// The columns of the fields.
const FIELD_COLUMNS: [&str; 5] = [
    "angle[deg]",
    "axial[mm]",
    "pressure[Pa]",
    "film_fraction[-]",
    "film_thickness[m]",
];

/// The fields as CSV, one row per cell.
///
/// # Errors
/// [`OutputError::Content`].
pub fn field_table(field: &FieldSnapshot) -> Result<Vec<u8>, OutputError> {
    let mut table = Table::new(FieldTable.file_name());
    table.row(FIELD_COLUMNS)?;
    let places = field
        .angles
        .iter()
        .flat_map(|angle| field.axial.iter().map(move |axial| (angle, axial)));
    let values = field
        .pressure
        .iter()
        .zip(&field.film_fraction)
        .zip(&field.film_thickness);
    for ((angle, axial), ((pressure, fraction), thickness)) in places.zip(values) {
        let axial_mm = (axial * 1e12).round() * 1e-9;
        table.row([degrees(*angle), axial_mm, *pressure, *fraction, *thickness].map(number))?;
    }
    table.finish()
}

/// The table of a sweep as CSV: number, varied values, status, numbers, limits, message. It holds no
/// times: the same sweep gives the same table, byte for byte.
///
/// # Errors
/// [`OutputError::Content`].
pub fn case_table(sweep: &SweepResults) -> Result<Vec<u8>, OutputError> {
    let mut table = Table::new(CaseTable.file_name());
    let varied = sweep
        .varied
        .iter()
        .map(|column| match column.unit.as_str() {
            "" => column.key.clone(),
            unit => format!("{}[{unit}]", column.key),
        });
    let columns = sweep.columns.iter();
    let columns = columns.map(|column| format!("{}[{}]", column.name, column.unit));
    let limits = sweep.limits.iter().map(|name| format!("limit_{name}"));
    let header = ["case".to_owned()].into_iter().chain(varied);
    let header = header.chain(["status".to_owned()]).chain(columns);
    table.row(header.chain(limits).chain(["message".to_owned()]))?;
    for row in &sweep.cases {
        let inputs = row.inputs.iter().zip(&row.numbers);
        let inputs = inputs.map(|(shown, value)| value.map_or_else(|| shown.clone(), number));
        let values = (0..sweep.columns.len()).map(|at| number(SweepResults::value(row, at)));
        let limits = (0..sweep.limits.len()).map(|at| match SweepResults::limit(row, at) {
            Some(limit) => match limit.verdict.as_str() {
                "ok" => "OK".to_owned(),
                verdict => verdict.to_owned(),
            },
            None => String::new(),
        });
        let first = [row.number.to_string()].into_iter().chain(inputs);
        let first = first.chain([row.status.name().to_owned()]).chain(values);
        table.row(first.chain(limits).chain([row.message.clone()]))?;
    }
    table.finish()
}

/// Whether the cells of a header begin with these names.
pub(super) fn begins_with<'n>(header: &str, names: impl IntoIterator<Item = &'n str>) -> bool {
    let mut cells = header.split(',');
    names.into_iter().all(|name| cells.next() == Some(name))
}

/// The shortest text that reads back as the same number.
pub(super) fn number(value: f64) -> String {
    if value.is_finite() {
        format!("{value:?}")
    } else {
        "nan".to_owned()
    }
}

/// A CSV table in memory that names its file where it fails.
pub(super) struct Table {
    file: &'static str,
    writer: csv::Writer<Vec<u8>>,
}

impl Table {
    pub(super) fn new(file: &'static str) -> Self {
        Self {
            file,
            writer: csv::Writer::from_writer(Vec::new()),
        }
    }

    pub(super) fn row(
        &mut self,
        fields: impl IntoIterator<Item = impl AsRef<[u8]>>,
    ) -> Result<(), OutputError> {
        let file = self.file;
        self.writer
            .write_record(fields)
            .map_err(|error| failed(file, &error))
    }

    pub(super) fn finish(self) -> Result<Vec<u8>, OutputError> {
        let file = self.file;
        self.writer
            .into_inner()
            .map_err(|error| failed(file, error.error()))
    }
}

fn failed(file: &'static str, error: &dyn std::error::Error) -> OutputError {
    OutputError::Content {
        file,
        reason: error.to_string(),
    }
}
