//! Any table a study names: CSV with the unit of each column in its header.
//!
//! Columns come in any order; `#` begins a comment line; empty lines do not count; a cell may stand
//! in quotes. What the columns mean is for the reader of each kind of table to say, in a [`Layout`].

use super::error::{InputError, Place};
use super::schema::nearest_word;
use super::units::{Dimension, with_ascii_minus};
use std::ops::Range;

/// Bad rows and columns that are shown; the others are counted.
const ERRORS_SHOWN: usize = 5;
/// Longest line, bytes: a row of numbers is below a hundredth of it.
const LINE_CAP: usize = 64 << 10;
/// Most rows: a table finer than this does not describe its curve any better.
const MOST_ROWS: usize = 200_000;
/// Longest piece of a cell that is shown in a message, characters.
const CELL_SHOWN: usize = 40;

/// The columns a kind of table may have.
pub(super) struct Layout<const N: usize> {
    /// What messages call it, such as `load table`.
    pub(super) what: &'static str,
    /// Names and dimensions.
    pub(super) columns: [(&'static str, Dimension); N],
    /// So many of the first columns must be there.
    pub(super) required: usize,
    /// Columns that only make sense together.
    pub(super) together: &'static [&'static [usize]],
    /// The header in full, for messages.
    pub(super) header: &'static str,
}

/// A table as read.
pub(super) struct CsvTable<'t, const N: usize> {
    file: &'t str,
    columns: Vec<Column<'t>>,
    /// Its rows in the order of the file, one at least.
    pub(super) rows: Vec<Row<'t, N>>,
}

/// One row in SI.
pub(super) struct Row<'t, const N: usize> {
    /// By column of the layout; 0 where the file has no such column.
    pub(super) values: [f64; N],
    line: Line<'t>,
}

impl<const N: usize> Row<'_, N> {
    /// Its line in the file, from 1.
    pub(super) fn line(&self) -> usize {
        self.line.number
    }
}

/// A column of the file: which of the layout, and its unit.
struct Column<'t> {
    index: usize,
    unit: &'t str,
}

/// A line of the file with its number; cells know their place in it.
#[derive(Clone, Copy)]
struct Line<'t> {
    number: usize,
    text: &'t str,
}

impl<'t> Line<'t> {
    /// Cells without the blanks and quotes around them, and their bytes in the line.
    fn cells(self) -> impl Iterator<Item = (&'t str, Range<usize>)> {
        let mut start = 0;
        self.text.split(',').map(move |cell| {
            let trimmed = cell.trim();
            let mut from = start + (cell.len() - cell.trim_start().len());
            start += cell.len() + 1;
            let bare = trimmed
                .strip_prefix('"')
                .and_then(|rest| rest.strip_suffix('"'));
            from += usize::from(bare.is_some());
            let text = bare.unwrap_or(trimmed);
            (text, from..from + text.len())
        })
    }

    fn error(self, file: &str, span: Range<usize>, message: impl Into<String>) -> InputError {
        let value = self.text.get(span.clone()).unwrap_or_default().to_owned();
        InputError::new(file, message)
            .at(Place::in_line(self.number, self.text, span))
            .with_value(&value)
    }

    /// An error about the whole line.
    fn refused(self, file: &str, message: impl Into<String>) -> InputError {
        self.error(file, 0..self.text.len(), message)
    }
}

/// Reads a table.
///
/// # Errors
/// Every error of the header or, where that is right, of the rows: the first few with their lines,
/// then how many more there are.
pub(super) fn read_table<'t, const N: usize>(
    file: &'t str,
    text: &'t str,
    layout: &Layout<N>,
) -> Result<CsvTable<'t, N>, Vec<InputError>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(index, text)| Line {
            number: index + 1,
            text: text.trim_end(),
        })
        .filter(|line| !line.text.trim().is_empty() && !line.text.starts_with('#'));
    let Some(header) = lines.next() else {
        let message = format!("the {} is empty", layout.what);
        return Err(vec![InputError::new(file, message).allowing(layout.header)]);
    };
    let columns = read_header(file, header, layout)?;
    let rows = read_rows(file, lines, &columns, layout)?;
    if rows.is_empty() {
        let message = format!("the {} has a header and no rows", layout.what);
        return Err(vec![header.refused(file, message)]);
    }
    Ok(CsvTable {
        file,
        columns,
        rows,
    })
}

impl<const N: usize> CsvTable<'_, N> {
    /// The file has this column of the layout.
    pub(super) fn has(&self, index: usize) -> bool {
        self.columns.iter().any(|column| column.index == index)
    }

    /// An error at the cell of a row and a column of the layout.
    pub(super) fn error_at(
        &self,
        row: &Row<'_, N>,
        index: usize,
        message: impl Into<String>,
    ) -> InputError {
        row.line.error(self.file, self.cell(row, index).1, message)
    }

    fn cell<'r>(&self, row: &Row<'r, N>, index: usize) -> (&'r str, Range<usize>) {
        let at = self.columns.iter().position(|column| column.index == index);
        at.and_then(|at| row.line.cells().nth(at))
            .unwrap_or(("", 0..0))
    }

    /// Errors where a column, called `name` in messages, does not ascend from row to row.
    pub(super) fn not_ascending(&self, index: usize, name: &str) -> Vec<InputError> {
        let at = self.columns.iter().find(|column| column.index == index);
        let unit = at.map_or("", |column| column.unit);
        let mut found = Found::default();
        let mut highest: Option<&Row<'_, N>> = None;
        for row in &self.rows {
            let Some(before) = highest.filter(|before| row.values[index] <= before.values[index])
            else {
                highest = Some(row);
                continue;
            };
            let shown = |row| format!("{} {unit}", self.cell(row, index).0);
            let message = if row.values[index] == before.values[index] {
                format!("the {name} {} repeats line {}", shown(row), before.line())
            } else {
                format!(
                    "the {name} falls from {} in line {} to {}",
                    shown(before),
                    before.line(),
                    shown(row)
                )
            };
            found.push(|| {
                self.error_at(row, index, message)
                    .hinting(format!("sort the rows by {name}, each value once"))
            });
        }
        found.into_errors(self.file)
    }
}

/// Errors of one file: the first few, and how many more.
#[derive(Default)]
struct Found {
    shown: Vec<InputError>,
    more: usize,
}

impl Found {
    fn push(&mut self, error: impl FnOnce() -> InputError) {
        if self.shown.len() < ERRORS_SHOWN {
            self.shown.push(error());
        } else {
            self.more += 1;
        }
    }

    fn into_errors(mut self, file: &str) -> Vec<InputError> {
        if let (Some(line), true) = (self.last_line(), self.more > 0) {
            let lines = if self.more == 1 { "line" } else { "lines" };
            let message = format!("{} more {lines} below are refused, too", self.more);
            self.shown
                .push(InputError::new(file, message).at(Place::in_line(line, "", 0..0)));
        }
        self.shown
    }

    fn last_line(&self) -> Option<usize> {
        Some(self.shown.last()?.place.as_ref()?.line)
    }
}

fn read_header<'t, const N: usize>(
    file: &str,
    header: Line<'t>,
    layout: &Layout<N>,
) -> Result<Vec<Column<'t>>, Vec<InputError>> {
    if let Some(error) = no_header(file, header, layout) {
        return Err(vec![error]);
    }
    let mut errors = Vec::new();
    let mut columns: Vec<Column<'t>> = Vec::new();
    for (cell, span) in header.cells() {
        match read_column(cell, layout) {
            Ok(column) if columns.iter().any(|known| known.index == column.index) => {
                let message = format!("column `{}` is given twice", shown(cell));
                errors.push(header.error(file, span, message));
            }
            Ok(column) => columns.push(column),
            Err((message, allowed)) => {
                errors.push(header.error(file, span, message).allowing(allowed));
            }
        }
        if errors.len() >= ERRORS_SHOWN {
            break;
        }
    }
    if errors.is_empty() {
        errors.extend(missing_columns(file, header, &columns, layout));
    }
    if errors.is_empty() {
        Ok(columns)
    } else {
        Err(errors)
    }
}

/// The first line is no header of this form at all.
fn no_header<const N: usize>(
    file: &str,
    header: Line<'_>,
    layout: &Layout<N>,
) -> Option<InputError> {
    if let Some(error) = too_long(file, header) {
        return Some(error);
    }
    let text = header.text;
    let (message, hint) = if text.contains(';') || text.contains('\t') {
        let separator = if text.contains(';') {
            "semicolons"
        } else {
            "tabs"
        };
        (
            format!("the columns are separated by {separator}"),
            "separate columns by commas and write decimals with a point",
        )
    } else if text.ends_with(',') {
        (
            "the header ends with a comma: its last column has no name".to_owned(),
            "take the comma out, here and at the end of each row",
        )
    } else if header.cells().all(|(cell, _)| cell.parse::<f64>().is_ok()) {
        (
            "the table begins with numbers, not with a header".to_owned(),
            "name the columns with their units in the first line",
        )
    } else {
        return None;
    };
    let error = header.refused(file, message);
    Some(error.allowing(layout.header).hinting(hint))
}

fn too_long(file: &str, line: Line<'_>) -> Option<InputError> {
    (line.text.len() > LINE_CAP).then(|| {
        line.error(
            file,
            0..1,
            format!("the line is {} kB long", line.text.len() >> 10),
        )
        .allowing(format!("at most {} kB", LINE_CAP >> 10))
        .hinting("is this the right file? each row of a table is a line of its own")
    })
}

/// A cell as it is shown in messages.
fn shown(cell: &str) -> String {
    let piece: String = cell.chars().take(CELL_SHOWN).collect();
    piece.escape_debug().to_string()
}

/// Reads `name[unit]`; the error is a message and what is allowed.
fn read_column<'t, const N: usize>(
    cell: &'t str,
    layout: &Layout<N>,
) -> Result<Column<'t>, (String, String)> {
    let (name, unit) = match cell.split_once('[') {
        Some((name, unit)) => (name.trim(), unit.strip_suffix(']')),
        None => (cell, None),
    };
    let Some(index) = layout.columns.iter().position(|column| column.0 == name) else {
        let names = layout.columns.map(|column| column.0);
        let meant = nearest_word(&names, name)
            .map(|word| format!("; did you mean `{word}`?"))
            .unwrap_or_default();
        return Err((
            format!("unknown column `{}`{meant}", shown(cell)),
            layout.header.to_owned(),
        ));
    };
    let dimension = layout.columns[index].1;
    let units = format!("{name} in one of [{}]", dimension.units().join("], ["));
    match unit {
        None => Err((
            format!("column `{}` has no unit in brackets", shown(cell)),
            units,
        )),
        Some(unit) if dimension.to_si(1.0, unit).is_none() => Err((
            format!("column `{name}` cannot be in `{}`", shown(unit)),
            units,
        )),
        Some(unit) => Ok(Column { index, unit }),
    }
}

fn missing_columns<const N: usize>(
    file: &str,
    header: Line<'_>,
    columns: &[Column<'_>],
    layout: &Layout<N>,
) -> Option<InputError> {
    let has = |index: usize| columns.iter().any(|column| column.index == index);
    let begun = layout
        .together
        .iter()
        .filter(|group| group.iter().any(|&index| has(index)));
    let missing: Vec<&str> = (0..layout.required)
        .chain(begun.flat_map(|group| group.iter().copied()))
        .filter(|&index| !has(index))
        .map(|index| layout.columns[index].0)
        .collect();
    if missing.is_empty() {
        return None;
    }
    let (columns, names) = match missing.len() {
        1 => ("column", missing.join("")),
        _ => ("columns", missing.join(", ")),
    };
    let message = format!("the {} lacks the {columns} {names}", layout.what);
    Some(header.refused(file, message).allowing(layout.header))
}

fn read_rows<'t, const N: usize>(
    file: &str,
    lines: impl Iterator<Item = Line<'t>>,
    columns: &[Column<'_>],
    layout: &Layout<N>,
) -> Result<Vec<Row<'t, N>>, Vec<InputError>> {
    let mut rows: Vec<Row<'t, N>> = Vec::new();
    let mut found = Found::default();
    for line in lines {
        if rows.len() == MOST_ROWS {
            let message = format!("the {} has more than {MOST_ROWS} rows", layout.what);
            return Err(vec![
                line.refused(file, message)
                    .allowing(format!("at most {MOST_ROWS} rows"))
                    .hinting("thin the table out"),
            ]);
        }
        match read_row(file, line, columns, layout) {
            Ok(row) => rows.push(row),
            Err(error) => found.push(|| *error),
        }
    }
    if found.shown.is_empty() {
        Ok(rows)
    } else {
        Err(found.into_errors(file))
    }
}

fn read_row<'t, const N: usize>(
    file: &str,
    line: Line<'t>,
    columns: &[Column<'_>],
    layout: &Layout<N>,
) -> Result<Row<'t, N>, Box<InputError>> {
    if let Some(error) = too_long(file, line) {
        return Err(Box::new(error));
    }
    let cells = line.cells().count();
    if cells != columns.len() {
        return Err(Box::new(miscounted(file, line, cells, columns.len())));
    }
    let mut values = [0.0; N];
    for (column, (cell, span)) in columns.iter().zip(line.cells()) {
        let (name, dimension) = layout.columns[column.index];
        let number = cell.parse::<f64>().ok();
        match number.and_then(|number| dimension.to_si(number, column.unit)) {
            Some(value) if value.is_finite() => values[column.index] = value,
            found => return Err(no_number(line.error(file, span, ""), name, cell, found)),
        }
    }
    Ok(Row { values, line })
}

/// A row of more or fewer cells than the header.
fn miscounted(file: &str, line: Line<'_>, cells: usize, columns: usize) -> InputError {
    let values = if cells == 1 { "value" } else { "values" };
    let error = line.refused(
        file,
        format!("{cells} {values}, the header names {columns} columns"),
    );
    if cells == columns + 1 && line.text.ends_with(',') {
        error.hinting("take the comma at the end of the line out")
    } else if line.text.contains([';', '\t']) {
        error.hinting("separate columns by commas and write decimals with a point")
    } else if cells > columns {
        error.hinting("decimal comma? use a point: 0.5, not 0,5")
    } else {
        error.hinting("each row gives every column of the header")
    }
}

/// A cell without a finite number; `found` is what it says otherwise.
fn no_number(place: InputError, name: &str, cell: &str, found: Option<f64>) -> Box<InputError> {
    let (message, hint) = match (found, with_ascii_minus(cell)) {
        (Some(_), _) => (format!("`{name}` is not a finite number"), None),
        (None, Some(plain)) => (
            format!("`{name}` has a minus sign that is not the one of the keyboard"),
            Some(format!("write {}", shown(&plain))),
        ),
        (None, None) if cell.is_empty() => (
            format!("`{name}` is empty"),
            Some("give a number in every cell of the row".to_owned()),
        ),
        (None, None) => (format!("`{name}` is not a number: `{}`", shown(cell)), None),
    };
    Box::new(InputError {
        message,
        hint,
        ..place
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const LAYOUT: Layout<3> = Layout {
        what: "table",
        columns: [
            ("angle", Dimension::Angle),
            ("left", Dimension::Length),
            ("right", Dimension::Length),
        ],
        required: 1,
        together: &[&[1, 2]],
        header: "angle[deg], then as needed left[mm],right[mm]",
    };

    fn messages(text: &str) -> Vec<String> {
        let errors = read_table("t.csv", text, &LAYOUT).err().unwrap();
        errors.into_iter().map(|error| error.message).collect()
    }

    #[test]
    fn columns_comments_quotes_and_line_ends() {
        let text =
            "\u{feff}# a comment\r\n\"right[um]\",angle[rad],left[mm]\r\n\r\n3, 1 ,\"2\"\r\n";
        let table = read_table("t.csv", text, &LAYOUT).unwrap();
        assert_eq!(table.rows[0].values, [1.0, 2e-3, 3.0 * 1e-6]);
        assert_eq!(table.rows[0].line(), 4);
        assert!(table.has(1));
    }

    #[test]
    fn what_is_no_table_is_named() {
        for (text, part) in [
            ("", "is empty"),
            ("# nothing\n\n", "is empty"),
            ("angle[deg]\n", "a header and no rows"),
            ("angle[deg];left[mm]\n", "separated by semicolons"),
            ("angle[deg]\tleft[mm]\n", "separated by tabs"),
            ("angle[deg],\n", "ends with a comma"),
            ("1,2\n", "begins with numbers"),
            ("angle[deg],left[mm]\n", "lacks the column right"),
            ("left[mm],right[mm]\n", "lacks the column angle"),
            ("angle[deg]\n1,\n", "2 values"),
            ("angle[deg]\n\u{2212}1\n", "minus sign"),
            ("angle[deg],left[mm],right[mm]\n1,,2\n", "`left` is empty"),
        ] {
            let found = messages(text);
            assert!(
                found.len() == 1 && found[0].contains(part),
                "{text:?}: {found:?}"
            );
        }
    }

    #[test]
    fn bad_rows_are_shown_up_to_a_few_and_counted() {
        let found = messages(&("angle[deg]\n".to_owned() + &"x\n".repeat(1000)));
        assert_eq!(found.len(), ERRORS_SHOWN + 1);
        assert_eq!(found[ERRORS_SHOWN], "995 more lines below are refused, too");
    }

    #[test]
    fn lines_and_rows_have_their_caps() {
        let long = format!("angle[deg]\n{}\n", "1".repeat(LINE_CAP + 1));
        assert!(messages(&long)[0].contains("kB long"));
        let many = "angle[deg]\n".to_owned() + &"1\n".repeat(MOST_ROWS + 1);
        assert!(messages(&many)[0].contains("more than 200000 rows"));
    }
}
