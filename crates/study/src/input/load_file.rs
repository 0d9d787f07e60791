//! The load table of a load-cycle study: CSV with the unit of each column in its header.
//!
//! `crank_angle[deg],load_x[N],load_y[N]` and, in any order, `journal_speed`, `shell_speed`,
//! and `moment_x`, `moment_y`, which free the tilt, or `tilt_x`, `tilt_y`, which prescribe it; lines
//! that start with `#` are comments. Loads and moments act ON the journal. Angles ascend, may start
//! anywhere and span at most one period; the last row may repeat the first. The pressure table of a
//! feed, `crank_angle[deg],pressure[bar]`, keeps the same rules.

use super::csv_table::{self, CsvTable, Layout, read_table};
use super::error::InputError;
use super::keys::{FORCE, MOMENT};
use super::units::Dimension;
use sommerfeld_bearing::{CycleTilt, LoadCycle, LoadPoint};

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
    /// What the user should know.
    pub warnings: Vec<InputError>,
}

/// Columns a load table may have.
const COLUMNS: [(&str, Dimension); 9] = [
    ("crank_angle", Dimension::Angle),
    ("load_x", Dimension::Force),
    ("load_y", Dimension::Force),
    ("journal_speed", Dimension::AngularSpeed),
    ("shell_speed", Dimension::AngularSpeed),
    ("moment_x", Dimension::Moment),
    ("moment_y", Dimension::Moment),
    ("tilt_x", Dimension::Angle),
    ("tilt_y", Dimension::Angle),
];
/// The first columns of [`COLUMNS`] must be there.
const REQUIRED: usize = 3;
const MOMENTS: [usize; 2] = [5, 6];
const TILTS: [usize; 2] = [7, 8];
const HEADER: &str = "crank_angle[deg],load_x[N],load_y[N], then as needed journal_speed[rad/s],\
                      shell_speed[rad/s], and moment_x[N.m],moment_y[N.m] or tilt_x[mrad],\
                      tilt_y[mrad]";

const LAYOUT: Layout<{ COLUMNS.len() }> = Layout {
    what: "load table",
    columns: COLUMNS,
    required: REQUIRED,
    together: &[&MOMENTS, &TILTS],
    header: HEADER,
};

const PRESSURE_LAYOUT: Layout<2> = Layout {
    what: "pressure table",
    columns: [
        ("crank_angle", Dimension::Angle),
        ("pressure", Dimension::Pressure),
    ],
    required: 2,
    together: &[],
    header: "crank_angle[deg],pressure[bar]",
};

/// A load table before it becomes a cycle.
type Table<'t> = CsvTable<'t, { COLUMNS.len() }>;

/// What messages say of a table over the crank angle.
struct Words {
    /// What its rows give.
    values: &'static str,
    /// What to do where there is one row only.
    constant: &'static str,
    /// What to do about a step where the cycle closes.
    closing: &'static str,
}

const LOAD_WORDS: Words = Words {
    values: "load",
    constant: "for a constant load use analysis = \"equilibrium\"",
    closing: "a load that steps shakes the journal; check the ends of the table",
};

const PRESSURE_WORDS: Words = Words {
    values: "pressure",
    constant: "for a constant pressure use `pressure`",
    closing: "check the ends of the table",
};

/// Reads a load table.
///
/// # Errors
/// Every error found, the first few with their lines.
pub fn read_load_table(
    file: &str,
    text: &str,
    settings: &CycleSettings,
) -> Result<LoadTable, Vec<InputError>> {
    let (table, warnings) = read_cycle(file, text, &LAYOUT, settings.period, &LOAD_WORDS)?;
    if let Some(error) = moments_and_tilts(&table).or_else(|| beyond_machines(&table)) {
        return Err(vec![error]);
    }
    Ok(LoadTable {
        cycle: load_cycle(&table, settings),
        warnings,
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
    let (table, warnings) = read_cycle(file, text, &PRESSURE_LAYOUT, period, &PRESSURE_WORDS)?;
    Ok(PressureTable {
        points: table.rows.iter().map(|row| row.values).collect(),
        warnings,
    })
}

/// Reads a table whose first column is the crank angle of one period (rad); with warnings.
fn read_cycle<'t, const N: usize>(
    file: &'t str,
    text: &'t str,
    layout: &Layout<N>,
    period: f64,
    words: &Words,
) -> Result<(CsvTable<'t, N>, Vec<InputError>), Vec<InputError>> {
    let mut table = read_table(file, text, layout)?;
    let errors = table.not_ascending(0, "crank angle");
    if !errors.is_empty() {
        return Err(errors);
    }
    if let [only] = &table.rows[..] {
        let error = table.error_at(only, 0, format!("the {} has one row only", layout.what));
        return Err(vec![
            error.allowing("two rows or more").hinting(words.constant),
        ]);
    }
    let closing_error = close(file, &mut table, layout, period, words)?;
    let mut warnings: Vec<InputError> = closing_error.into_iter().collect();
    warnings.extend(warn_of_missing_angles(file, &table.rows, period, words));
    Ok((table, warnings))
}

/// A tilt cannot be prescribed and free.
fn moments_and_tilts(table: &Table<'_>) -> Option<InputError> {
    (table.has(MOMENTS[0]) && table.has(TILTS[0])).then(|| {
        table
            .error_in_header(TILTS[0], "the load table gives both moments and tilts")
            .allowing(
                "moment_x, moment_y, which free the tilt, or tilt_x, tilt_y, which prescribe it",
            )
            .hinting(
                "take one pair of columns out; the moment that holds a prescribed tilt is a result",
            )
    })
}

/// A load or moment that no machine makes, as the keys of a steady study refuse it.
fn beyond_machines(table: &Table<'_>) -> Option<InputError> {
    for (index, (name, dimension)) in COLUMNS.iter().enumerate() {
        let range = match dimension {
            Dimension::Force => FORCE,
            Dimension::Moment => MOMENT,
            _ => continue,
        };
        let beyond = |row: &&csv_table::Row<'_, { COLUMNS.len() }>| {
            !range.contains(row.values[index], Some(*dimension))
        };
        if let Some(row) = table.rows.iter().find(beyond) {
            let error = table.error_at(row, index, format!("`{name}` is out of range"));
            return Some(
                error
                    .allowing(range.to_string())
                    .hinting("the unit stands in the header of the column: is it right?"),
            );
        }
    }
    None
}

/// A number as it is shown in messages: nine digits, no round-off tails.
fn round(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// Checks the span, drops a last row that repeats the first, and warns of a closing step.
fn close<const N: usize>(
    file: &str,
    table: &mut CsvTable<'_, N>,
    layout: &Layout<N>,
    period: f64,
    words: &Words,
) -> Result<Option<InputError>, Vec<InputError>> {
    let (Some(first), Some(last)) = (table.rows.first(), table.rows.last()) else {
        return Ok(None);
    };
    let span = last.values[0] - first.values[0];
    let slack = 1e-6 * period;
    if span > period + slack {
        let message = format!(
            "the crank angles span {} deg, more than the period of {} deg",
            round(span.to_degrees()),
            round(period.to_degrees())
        );
        let error = table.error_at(last, 0, message);
        return Err(vec![
            error.hinting("cut the table to one period or set load_cycle.period"),
        ]);
    }
    let warning = closing_step(&table.rows, layout, period).map(|(name, share)| {
        InputError::new(
            file,
            format!(
                "{name} steps by {:.0} % of its range where the cycle closes (line {} to line {})",
                100.0 * share,
                last.line(),
                first.line()
            ),
        )
        .hinting(words.closing)
    });
    if span > period - slack {
        table.rows.pop();
    }
    Ok(warning)
}

/// Column with the largest step from the last row to the first, if it stays above [`CLOSING_STEP`]
/// when what the slope of the rows beside explains over the closing angle is taken off.
fn closing_step<const N: usize>(
    rows: &[csv_table::Row<'_, N>],
    layout: &Layout<N>,
    period: f64,
) -> Option<(&'static str, f64)> {
    let [first, second, .., before_last, last] = rows else {
        return None;
    };
    let closing_angle = (first.values[0] + period - last.values[0]).max(0.0);
    let slope = |from: &csv_table::Row<'_, N>, to: &csv_table::Row<'_, N>, index: usize| {
        ((to.values[index] - from.values[index]) / (to.values[0] - from.values[0])).abs()
    };
    (1..N)
        .map(|index| {
            let values = || rows.iter().map(|row| row.values[index]);
            let range =
                values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
            let steepest = slope(first, second, index).max(slope(before_last, last, index));
            let step = (last.values[index] - first.values[index]).abs();
            let unexplained = step - steepest * closing_angle;
            let is_step = range > 0.0 && unexplained > CLOSING_STEP * range;
            (
                layout.columns[index].0,
                if is_step { step / range } else { 0.0 },
            )
        })
        .filter(|&(_, share)| share > 0.0)
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Warns of a table that covers only part of the period.
fn warn_of_missing_angles<const N: usize>(
    file: &str,
    rows: &[csv_table::Row<'_, N>],
    period: f64,
    words: &Words,
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
                words.values
            ),
        )
        .hinting("is load_cycle.period right?")
    })
}

fn load_cycle(table: &Table<'_>, settings: &CycleSettings) -> LoadCycle {
    let (has_journal_speed, has_shell_speed) = (table.has(3), table.has(4));
    let points = table
        .rows
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
                _,
                _,
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
        tilt: cycle_tilt(table),
        feed_pressures: Vec::new(),
    }
}

fn cycle_tilt(table: &Table<'_>) -> CycleTilt {
    if table.has(TILTS[0]) {
        let tilts = table.rows.iter();
        CycleTilt::Prescribed(tilts.map(|row| TILTS.map(|i| row.values[i])).collect())
    } else if table.has(MOMENTS[0]) {
        CycleTilt::Free
    } else {
        CycleTilt::Aligned
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
        assert_eq!(table.cycle.tilt, CycleTilt::Aligned);
    }

    #[test]
    fn moments_free_the_tilt_and_tilts_prescribe_it() {
        let head = "crank_angle[deg],load_x[N],load_y[N]";
        let moments = read(&format!(
            "{head},moment_x[N.m],moment_y[N.m]\n0,1,0,0,0\n360,1,0,0,0\n"
        ));
        assert_eq!(moments.unwrap().cycle.tilt, CycleTilt::Free);
        let tilts = read(&format!(
            "{head},tilt_y[urad],tilt_x[mrad]\n0,1,0,5,0.1\n360,1,0,-5,0.2\n"
        ));
        let CycleTilt::Prescribed(rows) = tilts.unwrap().cycle.tilt else {
            unreachable!("tilts are given")
        };
        for (row, expected) in rows.iter().zip([[1e-4, 5e-6], [2e-4, -5e-6]]) {
            assert!((row[0] - expected[0]).hypot(row[1] - expected[1]) < 1e-18);
        }
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
