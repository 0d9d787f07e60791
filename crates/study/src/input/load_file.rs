//! The tables of a load-cycle study: CSV with the unit of each column in its header.
//!
//! The load table holds
//! `crank_angle[deg],load_x[N],load_y[N]` and, in any order, `journal_speed`, `shell_speed`,
//! `moment_x`, `moment_y`; lines that start with `#` are comments. Loads and moments act ON the
//! journal. Angles ascend, may start anywhere and span at most one period; the last row may repeat
//! the first. The pressure table of a feed, `crank_angle[deg],pressure[bar]`, keeps the same rules.

use super::error::{InputError, Place};
use super::schema::nearest_word;
use super::units::Dimension;
use sommerfeld_bearing::{LoadCycle, LoadPoint};
use std::ops::Range;

/// More messages than this about one file help nobody.
const MOST_ERRORS: usize = 10;
/// A closing step above this share of a column's range is a warning.
const CLOSING_STEP: f64 = 0.05;
/// A closing angle this much larger than the largest step in the table is a warning.
const CLOSING_ANGLE: f64 = 2.0;

/// What the study says about its load cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleSettings {
    /// Crank speed, rad/s.
    pub engine_speed: f64,
    /// Period, rad.
    pub period: f64,
    /// Mass that moves with the journal, kg.
    pub journal_mass: f64,
}

/// A load table as read.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadTable {
    /// The load cycle.
    pub cycle: LoadCycle,
    /// The table gives moments.
    pub has_moments: bool,
    /// What the user should know.
    pub warnings: Vec<InputError>,
}

/// What a table may hold.
struct Format {
    /// What it is, and what its rows give, for messages.
    what: &'static str,
    values: &'static str,
    /// Columns it may have, in the order of [`Row`].
    columns: &'static [(&'static str, Dimension)],
    /// The first columns must be there.
    required: usize,
    /// Columns that go together.
    together: &'static [usize],
    /// What its header looks like.
    header: &'static str,
    /// What to do about a step where the cycle closes.
    closing: &'static str,
}

const LOADS: Format = Format {
    what: "load table",
    values: "load",
    columns: &COLUMNS,
    required: REQUIRED,
    together: &MOMENTS,
    header: HEADER,
    closing: "a load that steps shakes the journal; check the ends of the table",
};

const PRESSURES: Format = Format {
    what: "pressure table",
    values: "pressure",
    columns: &[
        ("crank_angle", Dimension::Angle),
        ("pressure", Dimension::Pressure),
    ],
    required: 2,
    together: &[],
    header: "crank_angle[deg],pressure[bar]",
    closing: "check the ends of the table",
};

/// Columns a load table may have, in the order of [`Row`].
const COLUMNS: [(&str, Dimension); 7] = [
    ("crank_angle", Dimension::Angle),
    ("load_x", Dimension::Force),
    ("load_y", Dimension::Force),
    ("journal_speed", Dimension::AngularSpeed),
    ("shell_speed", Dimension::AngularSpeed),
    ("moment_x", Dimension::Moment),
    ("moment_y", Dimension::Moment),
];
/// The first columns of [`COLUMNS`] must be there.
const REQUIRED: usize = 3;
const MOMENTS: [usize; 2] = [5, 6];
const HEADER: &str = "crank_angle[deg],load_x[N],load_y[N], then as needed journal_speed[rad/s],\
                      shell_speed[rad/s],moment_x[N.m],moment_y[N.m]";

/// One row in SI, by column of [`COLUMNS`], with its place.
struct Row {
    values: [f64; COLUMNS.len()],
    line: usize,
}

/// A line of the file with its number; cells know their place in it.
#[derive(Clone, Copy)]
struct Line<'t> {
    number: usize,
    text: &'t str,
}

impl<'t> Line<'t> {
    /// Cells without the blanks around them, and their bytes in the line.
    fn cells(self) -> impl Iterator<Item = (&'t str, Range<usize>)> {
        let mut start = 0;
        self.text.split(',').map(move |cell| {
            let trimmed = cell.trim();
            let from = start + (cell.len() - cell.trim_start().len());
            start += cell.len() + 1;
            (trimmed, from..from + trimmed.len())
        })
    }

    fn error(self, file: &str, span: Range<usize>, message: impl Into<String>) -> InputError {
        let value = self.text.get(span.clone()).unwrap_or_default().to_owned();
        InputError::new(file, message)
            .at(Place::in_line(self.number, self.text, span))
            .with_value(&value)
    }
}

/// Reads a load table.
///
/// # Errors
/// Every error found, up to ten, each with its line.
pub fn read_load_table(
    file: &str,
    text: &str,
    settings: &CycleSettings,
) -> Result<LoadTable, Vec<InputError>> {
    let table = read_table(file, text, settings.period, &LOADS)?;
    let columns = &table.columns;
    let has_moments = columns.iter().any(|column| MOMENTS.contains(&column.index));
    Ok(LoadTable {
        cycle: load_cycle(&table.rows, columns, settings),
        has_moments,
        warnings: table.warnings,
    })
}

/// Supply pressure of a feed as read.
#[derive(Debug, Clone, PartialEq)]
pub struct PressureTable {
    /// Crank angles, rad, and gauge pressures, Pa, as in a load cycle.
    pub points: Vec<[f64; 2]>,
    /// What the user should know.
    pub warnings: Vec<InputError>,
}

/// Reads the supply pressure of a feed over a period (rad).
///
/// # Errors
/// As [`read_load_table`].
pub fn read_pressure_table(
    file: &str,
    text: &str,
    period: f64,
) -> Result<PressureTable, Vec<InputError>> {
    let table = read_table(file, text, period, &PRESSURES)?;
    let points = table.rows.iter();
    Ok(PressureTable {
        points: points.map(|row| [row.values[0], row.values[1]]).collect(),
        warnings: table.warnings,
    })
}

/// Rows in SI.
struct RawTable<'t> {
    columns: Vec<Column<'t>>,
    rows: Vec<Row>,
    warnings: Vec<InputError>,
}

fn read_table<'t>(
    file: &str,
    text: &'t str,
    period: f64,
    format: &Format,
) -> Result<RawTable<'t>, Vec<InputError>> {
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(index, text)| Line {
            number: index + 1,
            text: text.trim_end(),
        })
        .filter(|line| !line.text.trim().is_empty() && !line.text.starts_with('#'));
    let Some(header) = lines.next() else {
        return Err(vec![
            InputError::new(file, format!("the {} is empty", format.what)).allowing(format.header),
        ]);
    };
    let columns = read_header(file, header, format)?;
    let rows = read_rows(file, lines, &columns, format)?;
    let (rows, closing_error) = close(file, rows, period, format)?;
    let mut warnings: Vec<InputError> = closing_error.into_iter().collect();
    warnings.extend(warn_of_missing_angles(file, &rows, period, format));
    Ok(RawTable {
        columns,
        rows,
        warnings,
    })
}

/// A column of the file: which of its format, and its unit.
struct Column<'t> {
    index: usize,
    unit: &'t str,
}

fn read_header<'t>(
    file: &str,
    header: Line<'t>,
    format: &Format,
) -> Result<Vec<Column<'t>>, Vec<InputError>> {
    let mut errors = Vec::new();
    let mut columns: Vec<Column<'t>> = Vec::new();
    if header.text.contains(';') {
        let end = header.text.len();
        return Err(vec![
            header
                .error(file, 0..end, "the columns are separated by semicolons")
                .allowing(format.header)
                .hinting("separate columns by commas and write decimals with a point"),
        ]);
    }
    for (cell, span) in header.cells() {
        match read_column(cell, format) {
            Ok(column) if columns.iter().any(|known| known.index == column.index) => {
                errors.push(header.error(file, span, format!("column `{cell}` is given twice")));
            }
            Ok(column) => columns.push(column),
            Err((message, allowed)) => {
                errors.push(header.error(file, span, message).allowing(allowed));
            }
        }
        if errors.len() >= MOST_ERRORS {
            return Err(errors);
        }
    }
    if errors.is_empty() {
        errors.extend(missing_columns(file, header, &columns, format));
    }
    if errors.is_empty() {
        Ok(columns)
    } else {
        Err(errors)
    }
}

/// Reads `name[unit]`; the error is a message and what is allowed.
fn read_column<'t>(cell: &'t str, format: &Format) -> Result<Column<'t>, (String, String)> {
    let shown: String = cell.chars().take(40).collect();
    let (name, unit) = match cell.split_once('[') {
        Some((name, unit)) => (name.trim(), unit.strip_suffix(']')),
        None => (cell, None),
    };
    let mut known = format.columns.iter();
    let Some(index) = known.position(|column| column.0 == name) else {
        let names: Vec<&str> = format.columns.iter().map(|column| column.0).collect();
        let meant = nearest_word(&names, name)
            .map(|word| format!("; did you mean `{word}`?"))
            .unwrap_or_default();
        return Err((
            format!("unknown column `{shown}`{meant}"),
            format.header.to_owned(),
        ));
    };
    let dimension = format.columns[index].1;
    let units = format!("{name} in one of [{}]", dimension.units().join("], ["));
    match unit {
        None => Err((format!("column `{shown}` has no unit in brackets"), units)),
        Some(unit) if dimension.to_si(1.0, unit).is_none() => {
            Err((format!("column `{name}` cannot be in `{unit}`"), units))
        }
        Some(unit) => Ok(Column { index, unit }),
    }
}

fn missing_columns(
    file: &str,
    header: Line<'_>,
    columns: &[Column<'_>],
    format: &Format,
) -> Option<InputError> {
    let has = |index: usize| columns.iter().any(|column| column.index == index);
    let mut missing: Vec<&str> = (0..format.required)
        .filter(|&i| !has(i))
        .map(|i| format.columns[i].0)
        .collect();
    let together = format.together;
    if together.iter().any(|&index| has(index)) {
        let lacking = together.iter().filter(|&&i| !has(i));
        missing.extend(lacking.map(|&i| format.columns[i].0));
    }
    if missing.is_empty() {
        return None;
    }
    let message = format!(
        "the {} lacks the column {}",
        format.what,
        missing.join(", ")
    );
    Some(
        header
            .error(file, 0..header.text.len(), message)
            .allowing(format.header),
    )
}

fn read_rows<'t>(
    file: &str,
    lines: impl Iterator<Item = Line<'t>>,
    columns: &[Column<'_>],
    format: &Format,
) -> Result<Vec<Row>, Vec<InputError>> {
    let mut rows: Vec<Row> = Vec::new();
    let mut errors = Vec::new();
    let mut last = 0;
    for line in lines {
        last = line.number;
        match read_row(file, line, columns, format) {
            Ok(row) => match rows.last() {
                Some(before) if row.values[0] <= before.values[0] => {
                    errors.push(unsorted(file, line, columns, before, &row));
                }
                _ => rows.push(row),
            },
            Err(error) => errors.push(*error),
        }
        if errors.len() >= MOST_ERRORS {
            break;
        }
    }
    if errors.is_empty() && rows.len() < 2 {
        let place = Place::in_line(last, "", 0..0);
        let message = format!("the {} has {} rows of numbers", format.what, rows.len());
        let mut error = InputError::new(file, message).allowing("two rows or more");
        if last > 0 {
            error = error.at(place);
        }
        errors.push(error);
    }
    if errors.is_empty() {
        Ok(rows)
    } else {
        Err(errors)
    }
}

fn read_row(
    file: &str,
    line: Line<'_>,
    columns: &[Column<'_>],
    format: &Format,
) -> Result<Row, Box<InputError>> {
    let cells = line.cells().count();
    if cells != columns.len() {
        let message = format!("{cells} values, the header names {} columns", columns.len());
        let error = line.error(file, 0..line.text.len(), message);
        return Err(Box::new(if cells > columns.len() {
            error.hinting("decimals take a point, columns are separated by one comma")
        } else {
            error
        }));
    }
    let mut values = [0.0; COLUMNS.len()];
    for (column, (cell, span)) in columns.iter().zip(line.cells()) {
        let (name, dimension) = format.columns[column.index];
        let number = cell.parse::<f64>().ok();
        match number.and_then(|number| dimension.to_si(number, column.unit)) {
            Some(value) if value.is_finite() => values[column.index] = value,
            Some(_) => {
                let message = format!("`{name}` is not a finite number");
                return Err(line.error(file, span, message).into());
            }
            None => {
                let shown: String = cell.chars().take(40).collect();
                let message = format!("`{name}` is not a number: `{}`", shown.escape_debug());
                return Err(line.error(file, span, message).into());
            }
        }
    }
    Ok(Row {
        values,
        line: line.number,
    })
}

fn unsorted(
    file: &str,
    line: Line<'_>,
    columns: &[Column<'_>],
    before: &Row,
    row: &Row,
) -> InputError {
    let degrees = |row: &Row| row.values[0].to_degrees();
    let at = columns
        .iter()
        .position(|column| column.index == 0)
        .unwrap_or(0);
    let span = line.cells().nth(at).map_or(0..0, |(_, span)| span);
    let message = format!(
        "the crank angle falls from {} deg in line {} to {} deg",
        round(degrees(before)),
        before.line,
        round(degrees(row))
    );
    let message = if row.values[0] == before.values[0] {
        format!(
            "the crank angle {} deg repeats line {}",
            round(degrees(row)),
            before.line
        )
    } else {
        message
    };
    line.error(file, span, message)
        .hinting("sort the rows by crank angle, each angle once")
}

/// A number as it is shown in messages: nine digits, no round-off tails.
fn round(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// Checks the span, drops a last row that repeats the first, and warns of a closing step.
fn close(
    file: &str,
    mut rows: Vec<Row>,
    period: f64,
    format: &Format,
) -> Result<(Vec<Row>, Option<InputError>), Vec<InputError>> {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
        return Ok((rows, None));
    };
    let span = last.values[0] - first.values[0];
    let slack = 1e-6 * period;
    if span > period + slack {
        let message = format!(
            "the crank angles span {} deg, more than the period of {} deg",
            round(span.to_degrees()),
            round(period.to_degrees())
        );
        let place = Place::in_line(last.line, "", 0..0);
        return Err(vec![
            InputError::new(file, message)
                .at(place)
                .hinting("cut the table to one period or set load_cycle.period"),
        ]);
    }
    let warning = closing_step(&rows, period, format).map(|(name, share)| {
        InputError::new(
            file,
            format!(
                "{name} steps by {:.0} % of its range where the cycle closes (line {} to line {})",
                100.0 * share,
                last.line,
                first.line
            ),
        )
        .hinting(format.closing)
    });
    if span > period - slack {
        rows.pop();
    }
    Ok((rows, warning))
}

/// Column with the largest step from the last row to the first, if it stays above [`CLOSING_STEP`]
/// when what the slope of the rows beside explains over the closing angle is taken off.
fn closing_step(rows: &[Row], period: f64, format: &Format) -> Option<(&'static str, f64)> {
    let [first, second, .., before_last, last] = rows else {
        return None;
    };
    let closing_angle = (first.values[0] + period - last.values[0]).max(0.0);
    let slope = |from: &Row, to: &Row, index: usize| {
        ((to.values[index] - from.values[index]) / (to.values[0] - from.values[0])).abs()
    };
    (1..format.columns.len())
        .map(|index| {
            let values = || rows.iter().map(|row| row.values[index]);
            let range =
                values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
            let steepest = slope(first, second, index).max(slope(before_last, last, index));
            let step = (last.values[index] - first.values[index]).abs();
            let unexplained = step - steepest * closing_angle;
            let is_step = range > 0.0 && unexplained > CLOSING_STEP * range;
            (
                format.columns[index].0,
                if is_step { step / range } else { 0.0 },
            )
        })
        .filter(|&(_, share)| share > 0.0)
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Warns of a table that covers only part of the period.
fn warn_of_missing_angles(
    file: &str,
    rows: &[Row],
    period: f64,
    format: &Format,
) -> Option<InputError> {
    let (first, last) = (rows.first()?, rows.last()?);
    let covered = last.values[0] - first.values[0];
    let largest = rows
        .windows(2)
        .map(|pair| pair[1].values[0] - pair[0].values[0])
        .fold(0.0, f64::max);
    let closing = period - covered;
    (closing > CLOSING_ANGLE * largest).then(|| {
        InputError::new(
            file,
            format!(
                "the table covers {} of {} deg; the {} is interpolated over the rest",
                round(covered.to_degrees()),
                round(period.to_degrees()),
                format.values
            ),
        )
        .hinting("is load_cycle.period right?")
    })
}

fn load_cycle(rows: &[Row], columns: &[Column<'_>], settings: &CycleSettings) -> LoadCycle {
    let has = |index: usize| columns.iter().any(|column| column.index == index);
    let (has_journal_speed, has_shell_speed) = (has(3), has(4));
    let points = rows
        .iter()
        .map(|row| {
            let [
                crank_angle,
                load_x,
                load_y,
                journal,
                shell,
                moment_x,
                moment_y,
            ] = row.values;
            LoadPoint {
                crank_angle,
                load: [load_x, load_y],
                moment: [moment_x, moment_y],
                journal_speed: if has_journal_speed {
                    journal
                } else {
                    settings.engine_speed
                },
                shell_speed: if has_shell_speed { shell } else { 0.0 },
            }
        })
        .collect();
    LoadCycle {
        points,
        period: settings.period,
        engine_speed: settings.engine_speed,
        journal_mass: settings.journal_mass,
        feed_pressures: Vec::new(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn read(text: &str) -> Result<LoadTable, Vec<InputError>> {
        let settings = CycleSettings {
            engine_speed: 200.0,
            period: 2.0 * TAU,
            journal_mass: 0.0,
        };
        read_load_table("loads.csv", text, &settings)
    }

    #[test]
    fn columns_in_any_order_and_unit() {
        let table = read(
            "# source: test\r\nload_y[kN], crank_angle[rad] ,load_x[N],shell_speed[rpm]\r\n\
             1,-1,3,30\r\n2,0,4,30\r\n\r\n1,11.56637061435917,3,30\r\n",
        )
        .unwrap();
        assert_eq!(table.cycle.points.len(), 2);
        assert_eq!(table.cycle.points[1].load, [4.0, 2000.0]);
        assert_eq!(table.cycle.points[0].journal_speed, 200.0);
        assert!((table.cycle.points[0].shell_speed - std::f64::consts::PI).abs() < 1e-12);
        assert!(!table.has_moments);
    }

    #[test]
    fn a_last_row_that_repeats_the_first_goes_without_a_word() {
        let table =
            read("crank_angle[deg],load_x[N],load_y[N]\n-180,1,0\n180,5,2\n540,1,0\n").unwrap();
        assert_eq!(table.cycle.points.len(), 2);
        assert!(table.warnings.is_empty(), "{:?}", table.warnings);
    }

    #[test]
    fn a_step_where_the_cycle_closes_is_a_warning() {
        let table =
            read("crank_angle[deg],load_x[N],load_y[N]\n0,1,0\n360,5,2\n540,4,1\n719,4,0\n")
                .unwrap();
        assert_eq!(table.warnings.len(), 1);
        assert!(
            table.warnings[0]
                .message
                .starts_with("load_x steps by 75 %")
        );
    }

    #[test]
    fn all_bad_rows_are_reported() {
        let errors =
            read("crank_angle[deg],load_x[N],load_y[N]\n0,1,x\n10,inf,0\n20,1\n").unwrap_err();
        let lines: Vec<usize> = errors
            .iter()
            .map(|e| e.place.as_ref().unwrap().line)
            .collect();
        assert_eq!(lines, [2, 3, 4]);
    }

    #[test]
    fn half_a_moment_is_refused() {
        let errors = read("crank_angle[deg],load_x[N],load_y[N],moment_x[N.m]\n0,1,1,0\n1,1,1,1\n")
            .unwrap_err();
        assert!(errors[0].message.contains("moment_y"));
    }
}
