//! Every row of the paper's reference table whose gap is open, at D/B 1 and 2, out of databases built around its
//! eccentricity, the aligned ones of D/B 1 out of the usual database of aligned journals too:
//! forces and moments of wedge and squeeze, eccentricity rising and falling, within 0.5 %, so the largest pressure of
//! the paper's figure 4; other peaks, which the cells of these databases cut off, within 4 %.
#![allow(clippy::unwrap_used, clippy::print_stdout, missing_docs)]

use sommerfeld_database::superposition::{Drive, SuperpositionRecipe, SuperpositionTable};
use std::ops::Range;

/// Gaps over the clearance that a database states its error of by default.
const USUAL: Range<f64> = 0.02 * (1.0 - 1e-6)..f64::INFINITY;

struct Row {
    d_over_b: f64,
    eps: f64,
    tilts: [f64; 2],
    gap: f64,
    drive: Drive,
    integrals: [f64; 4],
    peak: f64,
}

/// Rows whose gap is open.
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
        if cells[8] != "ok" {
            continue;
        }
        let eps = number(1);
        rows.push(Row {
            d_over_b: number(0),
            eps,
            tilts: [number(2) * (1.0 - eps), number(5)],
            gap: number(6),
            drive: match cells[7] {
                "D" => Drive::Wedge,
                "V" => Drive::Rising,
                _ => Drive::Falling,
            },
            integrals: [9, 10, 11, 12].map(number),
            peak: number(13),
        });
    }
    rows
}

/// Databases around an eccentricity.
fn around(d_over_b: f64, eps: f64, tilt_nodes: [usize; 2]) -> SuperpositionTable {
    build(&SuperpositionRecipe {
        eccentricities: [0.9 * eps, eps + 0.1 * (1.0 - eps)],
        eccentricity_nodes: 5,
        tilt_nodes,
        centre_nodes: [0, 0],
        grid: [96, 24],
        samples: 0,
        ..SuperpositionRecipe::tilted(d_over_b)
    })
}

fn build(recipe: &SuperpositionRecipe) -> SuperpositionTable {
    SuperpositionTable::build(recipe, None, &mut |_, _| true).unwrap()
}

/// Holds the rows of an eccentricity, `expected` of each drive, against a database; the largest force or moment of a
/// squeeze that the paper leaves out, over the whole.
fn hold(table: &SuperpositionTable, eps: f64, gaps: &Range<f64>, expected: usize) -> f64 {
    let (mut counts, mut failures) = ([0; 3], Vec::new());
    let mut across = 0.0_f64;
    let d_over_b = table.recipe().d_over_b;
    let of_table =
        |row: &Row| row.d_over_b == d_over_b && row.eps == eps && gaps.contains(&row.gap);
    for row in rows().into_iter().filter(of_table) {
        let factor = if row.drive == Drive::Wedge { eps } else { 1.0 };
        let seen = table.lookup(row.drive, eps, row.tilts);
        let found = seen.integrals.map(|value| factor * value);
        let peak = factor * seen.peak / row.peak - 1.0;
        let [f1, f2, m1, m2] = row.integrals;
        let force = f1.hypot(f2);
        let moment = m1.hypot(m2).max(0.1 * force);
        let off = [
            (found[0] - f1).hypot(found[1] - f2) / force,
            (found[2] - m1).hypot(found[3] - m2) / moment,
        ];
        counts[row.drive as usize] += 1;
        if row.drive != Drive::Wedge {
            across = across.max(f2.abs() / force).max(m2.abs() / moment);
        }
        println!("{eps} {:?} {:?}: {off:.5?} {peak:.5}", row.tilts, row.drive);
        // A number that is none is no error either.
        let is_figure_4 = (eps, row.tilts[1], row.drive) == (0.8, 0.0, Drive::Wedge);
        let peak_bar = if is_figure_4 { 0.005 } else { 0.04 };
        let is_kept = off.iter().all(|off| *off <= 0.005) && peak.abs() <= peak_bar;
        if !is_kept {
            failures.push(format!(
                "{eps} {:?} {:?}: {off:?} {peak}",
                row.tilts, row.drive
            ));
        }
    }
    assert_eq!(counts, [expected; 3]);
    assert!(failures.is_empty(), "{failures:#?}");
    across
}

/// The same of tilted rows: squeezes have the force and moment that the paper leaves out.
fn hold_tilted(eps: f64, tilt_nodes: [usize; 2], expected: usize) {
    let across = hold(&around(2.0, eps, tilt_nodes), eps, &USUAL, expected);
    assert!(across > 0.1, "no row has Phi_2V or Theta_2V: {across}");
}

#[test]
fn rows_at_0_1() {
    hold_tilted(0.1, [17, 11], 9);
}

#[test]
fn rows_at_0_3() {
    hold_tilted(0.3, [13, 9], 9);
}

#[test]
fn rows_at_0_8() {
    hold_tilted(0.8, [11, 9], 7);
}

#[test]
fn rows_at_0_9() {
    hold_tilted(0.9, [11, 9], 5);
}

/// Rows with gaps of 0.02 to 0.004 of the clearance, out of databases that reach there.
#[test]
fn rows_close_to_contact() {
    for (eps, expected) in [(0.8, 1), (0.9, 2)] {
        let table = build(&SuperpositionRecipe {
            eccentricities: [eps - 0.1 * (1.0 - eps), eps + 0.1 * (1.0 - eps)],
            eccentricity_nodes: 5,
            tilt_nodes: [11, 11],
            largest_shares: [0.97, 0.94],
            centre_nodes: [0, 0],
            grid: [96, 24],
            smallest_gap: 0.004,
            samples: 0,
            ..SuperpositionRecipe::tilted(2.0)
        });
        hold(&table, eps, &(0.004..USUAL.start), expected);
    }
}

#[test]
fn rows_of_d_over_b_1() {
    for eps in [0.3, 0.8] {
        hold(&around(1.0, eps, [5, 5]), eps, &USUAL, 1);
    }
    let recipe = SuperpositionRecipe {
        samples: 0,
        ..SuperpositionRecipe::aligned(1.0)
    };
    let aligned = build(&recipe);
    for eps in [0.3, 0.8] {
        hold(&aligned, eps, &USUAL, 1);
    }
}

/// No row is forgotten: two eccentricities of D/B 1 aligned, four of D/B 2 with tilts, less those closed.
#[test]
fn all_rows_are_held() {
    let of = |d_over_b: f64| rows().iter().filter(|row| row.d_over_b == d_over_b).count();
    let close = rows()
        .iter()
        .filter(|row| !USUAL.contains(&row.gap))
        .count();
    assert_eq!([of(1.0), of(2.0), close], [6, 99, 9]);
}
