//! Every row of the paper's reference table that a database may hold, at D/B 2, out of databases built around its
//! eccentricity: forces and moments of wedge and squeeze, eccentricity rising and falling, within 0.5 %.
#![allow(clippy::unwrap_used, clippy::print_stdout, missing_docs)]

use sommerfeld_database::superposition::{Drive, SuperpositionRecipe, SuperpositionTable};

struct Row {
    eps: f64,
    tilts: [f64; 2],
    drive: Drive,
    integrals: [f64; 4],
}

/// Rows of D/B 2 whose gap is one that a database states its error of.
fn rows() -> Vec<Row> {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../validation/tilted-table/reference.csv"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let mut rows = Vec::new();
    for line in lines {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        let number = |column: usize| cells[column].parse::<f64>().unwrap();
        if number(0) != 2.0 || cells[8] != "ok" || number(6) < 0.02 * (1.0 - 1e-6) {
            continue;
        }
        let eps = number(1);
        rows.push(Row {
            eps,
            tilts: [number(2) * (1.0 - eps), number(5)],
            drive: match cells[7] {
                "D" => Drive::Wedge,
                "V" => Drive::Rising,
                _ => Drive::Falling,
            },
            integrals: [9, 10, 11, 12].map(number),
        });
    }
    rows
}

/// Holds the rows of an eccentricity against a database around it.
fn hold(eps: f64, tilt_nodes: [usize; 2], expected: usize) {
    let recipe = SuperpositionRecipe {
        eccentricities: [0.9 * eps, eps + 0.1 * (1.0 - eps)],
        eccentricity_nodes: 5,
        tilt_nodes,
        centre_nodes: [0, 0],
        grid: [96, 24],
        samples: 0,
        ..SuperpositionRecipe::tilted(2.0)
    };
    let table = SuperpositionTable::build(&recipe, None, &mut |_, _| true).unwrap();
    let (mut counts, mut failures) = ([0; 3], Vec::new());
    let mut across = 0.0_f64;
    for row in rows().into_iter().filter(|row| row.eps == eps) {
        let factor = if row.drive == Drive::Wedge { eps } else { 1.0 };
        let found = (table.lookup(row.drive, eps, row.tilts).integrals).map(|value| factor * value);
        let [f1, f2, m1, m2] = row.integrals;
        let force = f1.hypot(f2);
        let moment = m1.hypot(m2).max(0.1 * force);
        let off = [
            (found[0] - f1).hypot(found[1] - f2) / force,
            (found[2] - m1).hypot(found[3] - m2) / moment,
        ];
        counts[row.drive as usize] += 1;
        if row.drive != Drive::Wedge {
            // What the paper leaves out.
            across = across.max(f2.abs() / force).max(m2.abs() / moment);
        }
        println!("{eps} {:?} {:?}: {off:.5?}", row.tilts, row.drive);
        if off[0].max(off[1]) > 0.005 {
            failures.push(format!("{eps} {:?} {:?}: {off:?}", row.tilts, row.drive));
        }
    }
    assert_eq!(counts, [expected; 3]);
    assert!(across > 0.1, "no row has Phi_2V or Theta_2V: {across}");
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn rows_at_0_1() {
    hold(0.1, [17, 11], 9);
}

#[test]
fn rows_at_0_3() {
    hold(0.3, [13, 9], 9);
}

#[test]
fn rows_at_0_8() {
    hold(0.8, [11, 9], 7);
}

#[test]
fn rows_at_0_9() {
    hold(0.9, [11, 9], 5);
}
