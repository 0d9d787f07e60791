//! The paper's problem with tilt, and wedge and squeeze together, on the default grid.
#![allow(clippy::unwrap_used)]

mod common;

use common::reference_rows;
use sommerfeld_film::dimensionless::{
    DimensionlessFilm, DimensionlessIntegrals, solve_dimensionless,
};
use sommerfeld_film::{Cavitation, Inlet, Outcome};

const DEFAULT_GRID: [usize; 2] = [128, 32];

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

fn solve(problem: &DimensionlessFilm) -> DimensionlessIntegrals {
    let solution = solve_dimensionless(problem, DEFAULT_GRID).unwrap();
    assert_eq!(solution.outcome, Outcome::Converged);
    solution.integrals
}

/// Bar on the default grid: 0.5 % of the force vector and of the moment scale, where the smallest
/// H is above 0.1. The moment scale is the larger of the moment vector and a tenth of the force, so
/// that moments that vanish by symmetry have one.
#[test]
fn tilted_table() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../validation/tilted-table/reference.csv"
    ))
    .unwrap();
    let mut failures = Vec::new();
    let (mut rows, mut worst) = (0, [0.0_f64; 2]);
    for line in text.lines().filter(|l| !l.starts_with('#')).skip(1) {
        let cell: Vec<&str> = line.split(',').collect();
        let number = |k: usize| cell[k].parse::<f64>().unwrap();
        let mut problem = film(number(0), number(1));
        problem.tilt_gamma = number(2);
        problem.tilt_delta = number(5);
        if cell[8] == "closed" {
            assert!(
                problem.narrowest_gap().relative_film_thickness <= 0.0,
                "{line}"
            );
            continue;
        }
        assert!(
            problem.narrowest_gap().relative_film_thickness > 0.0,
            "{line}"
        );
        match cell[7] {
            "D" => problem.wedge = 1.0,
            "V" => problem.squeeze = 1.0,
            "W" => problem.squeeze = -1.0,
            other => panic!("{other}"),
        }
        let got = solve(&problem);
        let force = number(9).hypot(number(10));
        let moment = number(11).hypot(number(12)).max(0.1 * force);
        let deviations = [
            (got.p_cos - number(9)).hypot(got.p_sin - number(10)) / force,
            (got.p_z_cos - number(11)).hypot(got.p_z_sin - number(12)) / moment,
        ];
        println!(
            "{} Hmin {} {}: {:.3}% {:.3}% peak {:.3}%",
            &line[..20],
            cell[6],
            cell[7],
            100.0 * deviations[0],
            100.0 * deviations[1],
            100.0 * (got.peak / number(13) - 1.0)
        );
        if number(6) > 0.1 {
            rows += 1;
            worst = [worst[0].max(deviations[0]), worst[1].max(deviations[1])];
            if deviations[0] > 0.005 || deviations[1] > 0.005 {
                failures.push(format!("{line}: {deviations:?}"));
            }
        }
    }
    println!(
        "{rows} rows, worst force {:.3} %, worst moment {:.3} %",
        100.0 * worst[0],
        100.0 * worst[1]
    );
    assert!(rows >= 60 && failures.is_empty(), "{failures:#?}");
}

/// Wedge and squeeze solved together; and the sum of separately cut solutions, the scheme of the
/// paper, reproduced to show what it misses.
#[test]
fn combined_wedge_and_squeeze() {
    let mut worst = 0.0_f64;
    for row in reference_rows("combined-wedge-squeeze", "reference.csv") {
        let [d_over_b, eps, q, f1, f2, f1_sum, f2_sum, ..] = row[..] else {
            panic!("{row:?}")
        };
        let base = film(d_over_b, eps);
        let both = solve(&DimensionlessFilm {
            wedge: 1.0,
            squeeze: q,
            ..base
        });
        let wedge = solve(&DimensionlessFilm { wedge: 1.0, ..base });
        let squeeze = solve(&DimensionlessFilm { squeeze: q, ..base });
        let deviation = (both.p_cos - f1).hypot(both.p_sin - f2) / f1.hypot(f2);
        let sum = [wedge.p_cos + squeeze.p_cos, wedge.p_sin + squeeze.p_sin];
        let deviation_sum = (sum[0] - f1_sum).hypot(sum[1] - f2_sum) / f1_sum.hypot(f2_sum);
        println!(
            "{d_over_b} {eps} {q}: {:.3}% sum {:.3}%",
            100.0 * deviation,
            100.0 * deviation_sum
        );
        worst = worst.max(deviation).max(deviation_sum);
    }
    assert!(worst < 0.0015, "{worst}");
}
