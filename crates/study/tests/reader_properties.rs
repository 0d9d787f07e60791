//! Whatever a file holds, the readers answer with a value or an error.
#![allow(clippy::unwrap_used, missing_docs)]

use proptest::prelude::*;
use sommerfeld_study::input::load_file::{CycleSettings, read_load_table};
use sommerfeld_study::input::{explain, study_from_text, units};
use sommerfeld_study::load_study;
use sommerfeld_study::templates::TEMPLATES;
use std::path::Path;

const SETTINGS: CycleSettings = CycleSettings {
    engine_speed: 200.0,
    period: 4.0 * std::f64::consts::PI,
    journal_mass: 0.0,
};

/// Reads a text and renders what is wrong with it.
fn read(text: &str) {
    match study_from_text("study.toml", text, Path::new("does/not/exist")) {
        Ok(study) => assert!(!study.input_hash.is_empty()),
        Err(errors) => assert!(!errors.render(false).is_empty() && !errors.render(true).is_empty()),
    }
}

/// Pieces that sit on the edges of the grammar and of the ranges.
fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        Just("\"".to_owned()),
        Just("[[bearing.groove]]\n".to_owned()),
        Just("[film]\n".to_owned()),
        Just("= 1e999".to_owned()),
        Just("0x7fffffffffffffff".to_owned()),
        Just("nan".to_owned()),
        Just("\"-1e308 mm\"".to_owned()),
        Just("\u{20ac}\t\r\n".to_owned()),
        ".{0,12}",
    ]
}

/// Pieces of which a table is made, and some of which it is not.
fn table_piece() -> impl Strategy<Value = String> {
    let words = [
        "crank_angle[deg],load_x[N],load_y[N]\n",
        "0,1000,0\n",
        "360,2,3\r\n",
        "719,-1e3,5\n",
        "crank_angle[rad]",
        ",load_x[MN]",
        ",moment_x[N.m]",
        "[",
        "]",
        ",",
        ";",
        "\t",
        "\n",
        "#",
        "\"",
        "1e400",
        "NaN",
        "-0",
        "0,5",
        "\u{2212}1",
        "\u{feff}",
        "\u{b0}",
    ];
    prop_oneof![
        4 => prop::sample::select(words.to_vec()).prop_map(str::to_owned),
        1 => "[0-9.,e-]{0,8}",
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn random_text(text in ".{0,300}") {
        read(&text);
    }

    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("study.toml");
        std::fs::write(&path, &bytes).unwrap();
        if let Err(errors) = load_study(&path) {
            prop_assert!(!errors.render(false).is_empty());
        }
    }

    #[test]
    fn mutated_studies(
        which in 0..TEMPLATES.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0usize..6, piece()), 1..4),
    ) {
        let mut text: Vec<char> = TEMPLATES[which].study.chars().collect();
        for (at, removed, inserted) in changes {
            let at = at.index(text.len());
            let end = (at + removed).min(text.len());
            text.splice(at..end, inserted.chars());
        }
        read(&text.into_iter().collect::<String>());
    }

    #[test]
    fn mutated_load_tables(
        at in any::<prop::sample::Index>(), removed in 0usize..20, inserted in piece(),
    ) {
        let mut text: Vec<char> = TEMPLATES[0].files[0].1.chars().collect();
        let at = at.index(text.len());
        let end = (at + removed).min(text.len());
        text.splice(at..end, inserted.chars());
        let text: String = text.into_iter().collect();
        if let Err(errors) = read_load_table("loads.csv", &text, &SETTINGS) {
            prop_assert!(errors.iter().all(|error| !error.to_string().is_empty()));
        }
    }

    /// Numbers go through a table unchanged, whatever the order of its columns, its line ends,
    /// blanks, quotes and comments.
    #[test]
    fn a_table_comes_back(
        rows in prop::collection::vec((0.01f64..10.0, -1e7f64..1e7, -1e7f64..1e7), 2..40),
        order in prop::sample::select(vec![[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]]),
        (is_windows, is_quoted, is_marked) in any::<(bool, bool, bool)>(),
    ) {
        // Steps of the angle, shortened to stay within one period.
        let total: f64 = rows.iter().map(|row| row.0).sum();
        let mut angle = -1.0;
        let mut written = Vec::new();
        for (step, x, y) in &rows {
            written.push([angle, *x, *y]);
            angle += 10.0 * step / total;
        }
        let end = if is_windows { "\r\n" } else { "\n" };
        let line = |cells: [String; 3]| {
            let cell = |index: usize| match is_quoted {
                true => format!("\"{}\" ", cells[index]),
                false => cells[index].clone(),
            };
            order.map(cell).join(",") + end
        };
        let mut text = if is_marked { "\u{feff}# loads\r\n" } else { "" }.to_owned();
        text += &line(["crank_angle[rad]", "load_x[N]", "load_y[N]"].map(str::to_owned));
        for row in &written {
            text += &line(row.map(|number| number.to_string()));
            text += end;
        }
        let table = read_load_table("loads.csv", &text, &SETTINGS);
        let points = table.map(|table| table.cycle.points).unwrap_or_default();
        let read: Vec<[f64; 3]> = points
            .iter()
            .map(|point| [point.crank_angle, point.load[0], point.load[1]])
            .collect();
        prop_assert_eq!(read, written);
    }

    #[test]
    fn tables_of_pieces(pieces in prop::collection::vec(table_piece(), 0..60)) {
        let text = pieces.concat();
        match read_load_table("loads.csv", &text, &SETTINGS) {
            Ok(table) => prop_assert!(
                table.cycle.points.iter().all(|point| point.load.iter().all(|load| load.is_finite()))
            ),
            Err(errors) => prop_assert!((1..=10).contains(&errors.len())),
        }
    }

    #[test]
    fn quantities_and_keys(text in ".{0,40}") {
        let _ = units::parse(&text, units::Dimension::Length);
        let _ = explain(&text);
    }

    #[test]
    fn a_quantity_comes_back(number in -1e9f64..1e9) {
        let read = units::parse(&format!("{number} m"), units::Dimension::Length).unwrap();
        prop_assert_eq!(read, number);
    }
}
