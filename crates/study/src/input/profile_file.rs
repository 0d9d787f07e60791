//! The profile of a bore or journal as a table: CSV with the unit of each column in its header.
//!
//! `angle[deg],position[mm],offset[um]`: the angle on the surface from its own +X, the axial position
//! from the mid-plane, the radial offset outward from the nominal circle. There is a row for every
//! pair of angle and position, in any order. Without the column `angle` the profile is alike all
//! around, without `position` alike all along the axis. A last angle one turn from the first may
//! repeat it.

use super::csv_table::{CsvTable, Layout, Row, read_table};
use super::error::InputError;
use super::units::Dimension;
use sommerfeld_film::ProfileTable;
use std::f64::consts::TAU;

const OFFSET: usize = 0;
const ANGLE: usize = 1;
const POSITION: usize = 2;
const LAYOUT: Layout<3> = Layout {
    what: "profile",
    columns: [
        ("offset", Dimension::Length),
        ("angle", Dimension::Angle),
        ("position", Dimension::Length),
    ],
    required: 1,
    together: &[],
    header: "angle[deg],position[mm],offset[um]; angle or position may be left out",
};

/// Reads a profile.
///
/// # Errors
/// Every error found, the first few with their lines.
pub(super) fn read_profile(file: &str, text: &str) -> Result<ProfileTable, Vec<InputError>> {
    let table = read_table(file, text, &LAYOUT)?;
    if !table.has(ANGLE) && !table.has(POSITION) {
        let message = "the profile has neither angles nor positions";
        return Err(vec![InputError::new(file, message).allowing(LAYOUT.header)]);
    }
    let mut angles = distinct(&table, ANGLE);
    let positions = distinct(&table, POSITION);
    let m = positions.len();
    let mut rows: Vec<Option<&Row<'_, 3>>> = vec![None; angles.len() * m];
    for row in &table.rows {
        let place = |values: &[f64], column: usize| {
            values.partition_point(|value| *value < row.values[column])
        };
        let at = &mut rows[place(&angles, ANGLE) * m + place(&positions, POSITION)];
        if let Some(first) = at {
            let message = format!(
                "{} is given twice: line {} has it, too",
                named(&table, row.values[ANGLE], row.values[POSITION]),
                first.line()
            );
            return Err(vec![table.error_at(row, OFFSET, message)]);
        }
        *at = Some(row);
    }
    if let Some(k) = rows.iter().position(Option::is_none) {
        let place = named(&table, angles[k / m], positions[k % m]);
        let message = format!(
            "the profile has no offset at {place}: {} rows for {} angles times {m} positions",
            table.rows.len(),
            angles.len()
        );
        let error = InputError::new(file, message);
        return Err(vec![
            error.hinting("give a row for every pair of angle and position"),
        ]);
    }
    let mut offsets: Vec<f64> = rows.iter().flatten().map(|r| r.values[OFFSET]).collect();
    close(file, &mut angles, &mut offsets, m)?;
    ProfileTable::new(angles, positions, offsets)
        .map_err(|error| vec![InputError::new(file, error.to_string())])
}

/// Values of a column, each once, ascending.
fn distinct(table: &CsvTable<'_, 3>, column: usize) -> Vec<f64> {
    let mut values: Vec<f64> = table
        .rows
        .iter()
        .map(|row| row.values[column] + 0.0)
        .collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

/// A place of the profile, for messages.
fn named(table: &CsvTable<'_, 3>, angle: f64, position: f64) -> String {
    let short = |value: f64| (value * 1e6).round() / 1e6;
    let angle = format!("angle {} deg", short(angle.to_degrees()));
    let position = format!("position {} mm", short(1e3 * position));
    match (table.has(ANGLE), table.has(POSITION)) {
        (true, true) => format!("{angle}, {position}"),
        (true, false) => angle,
        _ => position,
    }
}

/// Drops a last angle that repeats the first, one turn on.
fn close(
    file: &str,
    angles: &mut Vec<f64>,
    offsets: &mut Vec<f64>,
    m: usize,
) -> Result<(), Vec<InputError>> {
    let near = 1e-9 * TAU;
    let (first, last) = (angles[0], angles[angles.len() - 1]);
    let span = last - first;
    if span > TAU + near {
        let message = format!("the angles span {} deg", span.to_degrees().round());
        let error = InputError::new(file, message);
        return Err(vec![error.allowing("one turn, 360 deg")]);
    }
    if span < TAU - near {
        return Ok(());
    }
    let (start, end) = (&offsets[..m], &offsets[offsets.len() - m..]);
    let size = offsets.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let gap = start.iter().zip(end).map(|(a, b)| (a - b).abs());
    let gap = gap.fold(0.0, f64::max);
    if gap > 1e-6 * size {
        let message = format!(
            "the profile does not close: first and last angle, one turn apart, differ by {} um",
            (gap * 1e9).round() / 1e3
        );
        let error = InputError::new(file, message);
        return Err(vec![
            error.hinting("leave the last angle out or let it repeat the first"),
        ]);
    }
    offsets.truncate(offsets.len() - m);
    angles.pop();
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn rows_in_any_order_and_unit() {
        let text = "\u{feff}# measured\r\noffset[mm],position[m],angle[rad]\r\n0.003,0.01,1\r\n\
                    0.001,-0.01,1\r\n0.002,0.01,0\r\n0,-0.01,0\r\n";
        let table = read_profile("bore.csv", text).unwrap();
        assert!((table.offset(0.0, 0.01) - 2e-6).abs() < 1e-20);
        assert!((table.offset(1.0, -0.01) - 1e-6).abs() < 1e-20);
        assert_eq!(table.span(), [-0.01, 0.01]);
    }

    #[test]
    fn a_last_angle_that_repeats_the_first_is_dropped() {
        let text = "angle[deg],offset[um]\n0,1\n120,2\n240,3\n360,1\n";
        let table = read_profile("bore.csv", text).unwrap();
        assert_eq!(table.n_around(), 3);
        let open = "angle[deg],offset[um]\n0,1\n120,2\n360,3\n";
        let errors = read_profile("bore.csv", open).unwrap_err();
        assert!(errors[0].message.contains("differ by 2 um"), "{errors:?}");
    }

    #[test]
    fn alike_around() {
        let text = "position[mm],offset[um]\n-15,0\n0,4\n15,0\n";
        let table = read_profile("bore.csv", text).unwrap();
        assert!(!table.varies_around() && table.varies_along());
        assert!((table.offset(2.0, 0.0) - 4e-6).abs() < 1e-20);
    }

    #[test]
    fn holes_and_repetitions_are_named() {
        let error = |rows: &str| {
            let text = format!("angle[deg],position[mm],offset[um]\n{rows}");
            read_profile("bore.csv", &text).unwrap_err()[0]
                .message
                .clone()
        };
        assert!(
            error("0,-5,1\n0,5,1\n90,-5,1\n").contains("no offset at angle 90 deg, position 5 mm")
        );
        assert!(error("0,-5,1\n0,-5,1\n").contains("line 2 has it"));
        assert!(error("0,-5,1\n0,5,1\n400,-5,1\n400,5,1\n").contains("span 400 deg"));
    }
}
