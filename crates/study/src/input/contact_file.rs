//! Contact pressure over the gap as a table: CSV with the unit of each column in its header.
//!
//! `gap[um],pressure[MPa]`: the nominal gap, negative where the mean planes overlap, ascending; the
//! mean contact pressure, falling to 0 in the last row.

use super::csv_table::{Layout, read_table};
use super::error::InputError;
use super::units::Dimension;
use sommerfeld_film::{ContactTable, FinishError};

const GAP: usize = 0;
const PRESSURE: usize = 1;
const LAYOUT: Layout<2> = Layout {
    what: "contact table",
    columns: [
        ("gap", Dimension::Length),
        ("pressure", Dimension::Pressure),
    ],
    required: 2,
    together: &[],
    header: "gap[um],pressure[MPa]",
};

/// Reads a contact table.
///
/// # Errors
/// Every error found, the first few with their lines.
pub(super) fn read_contact(file: &str, text: &str) -> Result<ContactTable, Vec<InputError>> {
    let table = read_table(file, text, &LAYOUT)?;
    let errors = table.not_ascending(GAP, "gap");
    if !errors.is_empty() {
        return Err(errors);
    }
    let column = |index: usize| table.rows.iter().map(|row| row.values[index]).collect();
    ContactTable::new(column(GAP), column(PRESSURE)).map_err(|error| {
        let row = match error {
            FinishError::NotMonotone { row } => table.rows.get(row - 1),
            FinishError::EndsUnderPressure { .. } => table.rows.last(),
            _ => None,
        };
        let message = match &error {
            FinishError::NotMonotone { .. } => {
                "the contact pressure does not fall from the row before".to_owned()
            }
            FinishError::EndsUnderPressure { .. } => {
                "the contact table ends under pressure".to_owned()
            }
            error => error.to_string(),
        };
        let refused = match row {
            Some(row) => table.error_at(row, PRESSURE, message),
            None => InputError::new(file, message),
        };
        vec![refused.allowing("gaps that rise and pressures that fall to 0 in the last row")]
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn gaps_and_pressures_in_their_units() {
        let text = "# measured\npressure[bar],gap[nm]\n400,-100\n100,200\n0,900\n";
        let table = read_contact("contact.csv", text).unwrap();
        assert!((table.pressure(-1e-7).value - 40e6).abs() < 1.0);
        assert!((table.pressure(2e-7).value - 10e6).abs() < 1.0);
        assert_eq!(table.pressure(9e-7).value, 0.0);
    }

    #[test]
    fn what_is_wrong_has_its_line() {
        let error = |rows: &str| {
            let text = format!("gap[um],pressure[MPa]\n{rows}");
            read_contact("contact.csv", &text).unwrap_err()[0].clone()
        };
        let rising = error("0,40\n0.5,50\n1,0\n");
        assert!(rising.message.contains("does not fall"), "{rising:?}");
        assert_eq!(rising.place.map(|place| place.line), Some(3));
        let open = error("0,40\n0.5,20\n");
        assert!(open.message.contains("ends under pressure"), "{open:?}");
        assert!(error("0.5,40\n0,20\n").message.contains("the gap falls"));
        assert!(error("0,0\n").message.contains("two rows"));
    }
}
