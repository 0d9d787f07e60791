//! Error bars held against references: how often does the stated error cover the true one, and by how
//! much is it too wide?
//!
//! Every thirteenth row of the tilted table is run, too few for a share of rows, so that the share of
//! figures is held to the bar; `SOMMERFELD_ALL_ROWS=1 cargo test -p sommerfeld-film
//! --test error_bars -- --nocapture` runs all of them, in minutes. The shares in `richardson` are set on the
//! even rows, so that the odd ones, which are judged on their own too, are a check from outside.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod common;

use common::reference_rows;
use sommerfeld_film::dimensionless::{
    DimensionlessFilm, DimensionlessIntegrals, RefinedSolution, refine_dimensionless,
};
use sommerfeld_film::{Cavitation, Inlet, Outcome};

const TARGET: f64 = 1e-3;
const FIRST_GRID: [usize; 2] = [128, 32];
/// Bar on the deviation of force and moment vector, over their scales.
const BAR: f64 = 1.5e-3;
/// Least share of rows whose error bars cover.
const LEAST_COVERAGE: f64 = 0.95;

fn film(d_over_b: f64, relative_eccentricity: f64) -> DimensionlessFilm {
    DimensionlessFilm {
        d_over_b,
        relative_eccentricity,
        tilt_gamma: 0.0,
        tilt_delta: 0.0,
        wedge: 0.0,
        squeeze: 0.0,
        cavitation: Cavitation::Reynolds,
        inlet: Inlet::Cyclic,
    }
}

fn refined(film: &DimensionlessFilm) -> RefinedSolution {
    let refined = refine_dimensionless(film, FIRST_GRID, TARGET).unwrap();
    assert_eq!(refined.outcome, Outcome::Converged);
    refined
}

/// True over stated errors of a table.
#[derive(Default)]
struct Coverage {
    /// Largest ratio of each row.
    rows: Vec<f64>,
    /// All ratios of integrals.
    integrals: Vec<f64>,
    /// All ratios of peaks.
    peaks: Vec<f64>,
    /// Stated errors over the scale of the figure.
    stated: Vec<f64>,
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn inside(ratios: &[f64]) -> usize {
    ratios.iter().filter(|ratio| **ratio <= 1.0).count()
}

impl Coverage {
    /// One row: value, stated error, reference, its own error, scale of each figure; the fifth is the
    /// peak.
    fn add(&mut self, figures: &[[f64; 5]]) {
        let mut worst = 0.0_f64;
        for (k, [value, error, reference, known_to, scale]) in figures.iter().enumerate() {
            // What the reference cannot tell is not held against the error bar.
            let off = ((value - reference).abs() - known_to).max(0.0);
            let ratio = if off == 0.0 { 0.0 } else { off / error };
            worst = worst.max(ratio);
            // A figure that vanishes by symmetry has no error bar to judge.
            if *error > 1e-9 * scale {
                let ratios = if k < 4 {
                    &mut self.integrals
                } else {
                    &mut self.peaks
                };
                ratios.push((value - reference).abs() / error);
                self.stated.push(error / scale);
            }
        }
        self.rows.push(worst);
    }

    /// The share of covered rows, or of figures, is large enough.
    fn check(mut self, name: &str, by_rows: bool) {
        let covered = inside(&self.rows);
        let rows = self.rows.len();
        println!(
            "{name}: {covered} of {rows} rows covered, worst true/stated {:.2}, median stated {:.1e}",
            self.rows.iter().fold(0.0_f64, |a, b| a.max(*b)),
            median(&mut self.stated)
        );
        for (kind, ratios) in [
            ("integrals", &mut self.integrals),
            ("peaks", &mut self.peaks),
        ] {
            println!(
                "{name}: {} of {} {kind} covered, median true/stated {:.3}",
                inside(ratios),
                ratios.len(),
                median(ratios)
            );
        }
        let figures = self.integrals.len() + self.peaks.len();
        let held = if by_rows {
            covered as f64 / rows as f64
        } else {
            (inside(&self.integrals) + inside(&self.peaks)) as f64 / figures as f64
        };
        assert!(held >= LEAST_COVERAGE, "{name}: {held}");
    }
}

/// The five figures of a row as [`Coverage::add`] takes them.
fn figures(
    solution: &RefinedSolution,
    reference: &DimensionlessIntegrals,
    known_to: &DimensionlessIntegrals,
    [force, moment]: [f64; 2],
) -> Vec<[f64; 5]> {
    let (value, error) = (&solution.integrals, &solution.error);
    let of = |figure: fn(&DimensionlessIntegrals) -> f64, scale: f64| {
        let known_to = figure(known_to);
        [
            figure(value),
            figure(error),
            figure(reference),
            known_to,
            scale,
        ]
    };
    vec![
        of(|i| i.p_cos, force),
        of(|i| i.p_sin, force),
        of(|i| i.p_z_cos, moment),
        of(|i| i.p_z_sin, moment),
        of(|i| i.peak, reference.peak),
    ]
}

/// Every kind of row: force and moment within 0.15 % of their scales where the smallest H is above
/// 0.02, and covered by their error bars in 95 % of all open rows, smaller H included.
#[test]
fn tilted_table() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../validation/tilted-table/reference.csv"
    ))
    .unwrap();
    let lines: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| line.split(',').collect())
        .filter(|cell: &Vec<&str>| cell[8] == "ok")
        .collect();
    let stride = if std::env::var_os("SOMMERFELD_ALL_ROWS").is_some() {
        1
    } else {
        13
    };
    let (mut coverage, mut of_odd) = (Coverage::default(), Coverage::default());
    let (mut worst, mut held, mut missed) = ([0.0_f64; 2], 0, 0);
    for (k, cell) in lines.iter().enumerate().step_by(stride) {
        let number = |k: usize| cell[k].parse::<f64>().unwrap();
        let sided = |k: usize| [k, k + 1, k + 2, k + 3, k + 4].map(number);
        let of = |[p_cos, p_sin, p_z_cos, p_z_sin, peak]: [f64; 5]| DimensionlessIntegrals {
            p_cos,
            p_sin,
            p_z_cos,
            p_z_sin,
            peak,
        };
        let (reference, known_to) = (of(sided(9)), of(sided(14)));
        let mut problem = film(number(0), number(1));
        problem.tilt_gamma = number(2);
        problem.tilt_delta = number(5);
        match cell[7] {
            "D" => problem.wedge = 1.0,
            "V" => problem.squeeze = 1.0,
            "W" => problem.squeeze = -1.0,
            other => panic!("{other}"),
        }
        let solution = refined(&problem);
        let got = &solution.integrals;
        let force = reference.p_cos.hypot(reference.p_sin);
        let moment = reference.p_z_cos.hypot(reference.p_z_sin).max(0.1 * force);
        let off = [
            (got.p_cos - reference.p_cos).hypot(got.p_sin - reference.p_sin) / force,
            (got.p_z_cos - reference.p_z_cos).hypot(got.p_z_sin - reference.p_z_sin) / moment,
        ];
        missed += usize::from(!solution.reached);
        println!(
            "{} {:?} force {:.1e} moment {:.1e} peak {:.1e} reached {}",
            cell[..8].join(","),
            solution.grid,
            off[0],
            off[1],
            got.peak / reference.peak - 1.0,
            solution.reached
        );
        if number(6) > 0.02 {
            held += 1;
            worst = [worst[0].max(off[0]), worst[1].max(off[1])];
            assert!(off[0] <= BAR && off[1] <= BAR, "{cell:?}: {off:?}");
        }
        let row = figures(&solution, &reference, &known_to, [force, moment]);
        coverage.add(&row);
        if k % 2 == 1 {
            of_odd.add(&row);
        }
    }
    println!(
        "tilted table, {held} rows with H above 0.02: worst force {:.1e}, worst moment {:.1e} of \
         {BAR:.1e}; target missed in {missed} rows of all",
        worst[0], worst[1]
    );
    coverage.check("tilted table", stride == 1);
    if stride == 1 {
        of_odd.check("tilted table, odd rows", true);
    }
}

/// Wedge and squeeze together within 0.15 % of the force, and covered but for one row of 18, whose three
/// grids agree by chance.
#[test]
fn combined_wedge_and_squeeze() {
    let mut coverage = Coverage::default();
    let mut worst = 0.0_f64;
    for row in reference_rows("combined-wedge-squeeze", "reference.csv") {
        let [d_over_b, eps, q, f1, f2, ..] = row[..] else {
            panic!("{row:?}")
        };
        let solution = refined(&DimensionlessFilm {
            wedge: 1.0,
            squeeze: q,
            ..film(d_over_b, eps)
        });
        let force = f1.hypot(f2);
        let got = &solution.integrals;
        let off = (got.p_cos - f1).hypot(got.p_sin - f2) / force;
        worst = worst.max(off);
        assert!(off <= BAR, "{row:?}: {off}");
        // Six digits are printed; the accuracy of the tilted table's like rows is 1e-5 of the force.
        let known_to = 1e-5 * force;
        coverage.add(&[
            [got.p_cos, solution.error.p_cos, f1, known_to, force],
            [got.p_sin, solution.error.p_sin, f2, known_to, force],
        ]);
    }
    println!("combined wedge and squeeze: worst force {worst:.1e} of {BAR:.1e}");
    coverage.check("combined wedge and squeeze", true);
}

/// A target out of reach is said to be missed, with the errors that were reached.
#[test]
fn a_target_out_of_reach_is_missed_honestly() {
    let problem = DimensionlessFilm {
        wedge: 1.0,
        ..film(2.0, 0.9)
    };
    let solution = refine_dimensionless(&problem, [32, 8], 1e-9).unwrap();
    assert!(!solution.reached);
    let worst = solution.relative_errors().map(|(_, e)| e);
    assert!(worst.iter().any(|e| *e > 1e-9), "{worst:?}");
}
