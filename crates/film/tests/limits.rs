//! The two limits that have closed forms: the infinitely long and the very short bearing. The error
//! against them falls with the square of the cell size.
#![allow(clippy::unwrap_used)]

mod common;

use common::{conditions, least_squares_order, unit_bearing, unit_oil};
use sommerfeld_film::{Bearing, Cavitation, FilmForce, FilmSolver, Inlet, JournalState, Step};

/// Rows of a reference whose first column is a word.
fn worded_rows(case: &str) -> Vec<(String, Vec<f64>)> {
    let path = format!(
        "{}/../../validation/{case}/reference.csv",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(path).unwrap();
    text.lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| {
            let (word, rest) = line.split_once(',').unwrap();
            let numbers = rest.split(',').map(|v| v.parse().unwrap_or(f64::NAN));
            (word.to_owned(), numbers.collect())
        })
        .collect()
}

/// Force per projected quarter area, towards the narrowest gap and across it.
fn force(bearing: &Bearing, state: &JournalState, grid: [usize; 2]) -> [f64; 2] {
    let mut film = FilmSolver::new(bearing, &unit_oil(), grid).unwrap();
    let answer = film.react(state, Step::Steady, &conditions()).unwrap();
    assert!(answer.settled);
    answer.reaction.film_force.map(|f| f / bearing.width)
}

fn vector_error(got: [f64; 2], exact: [f64; 2]) -> f64 {
    (got[0] - exact[0]).hypot(got[1] - exact[1]) / exact[0].hypot(exact[1])
}

/// A bearing ten thousand times as wide as its diameter, film from the line of the widest gap:
/// half Sommerfeld (`gumbel`) and Swift-Stieber (`reynolds`).
#[test]
fn infinitely_long() {
    const CELLS: [usize; 4] = [64, 128, 256, 512];
    let rows = worded_rows("infinitely-long-bearing");
    for (condition, cavitation, least_order) in [
        ("gumbel_half_sommerfeld", Cavitation::Gumbel, 1.9),
        (
            "reynolds_swift_stieber_inlet_hmax",
            Cavitation::Reynolds,
            1.7,
        ),
    ] {
        let bearing = Bearing {
            cavitation,
            inlet: Inlet::MaxFilmLine { pressure: 0.0 },
            ..unit_bearing(1e4)
        };
        // Where the film ruptures inside a cell scatters the error of one eccentricity: the mean
        // over all shows the order. Even cells resolve narrower gaps only when they are finer.
        let resolved = |row: &&(String, Vec<f64>)| row.0 == condition && row.1[0] <= 0.8;
        let points = CELLS.map(|n| {
            let errors = rows.iter().filter(resolved).map(|(_, row)| {
                let state = JournalState {
                    position: [row[0] * bearing.radial_clearance, 0.0],
                    journal_speed: 1.0,
                    ..JournalState::default()
                };
                // `force` is per width; the closed form per width and radius, R = 1.
                vector_error(force(&bearing, &state, [n, 4]), [row[1], row[2]])
            });
            let errors: Vec<f64> = errors.collect();
            let squares: f64 = errors.iter().map(|e| e * e).sum();
            (n as f64, (squares / errors.len() as f64).sqrt())
        });
        let order = least_squares_order(&points);
        println!("{condition}: order {order:.2}, {:.1e} at 512", points[3].1);
        assert!(order > least_order, "{condition}: {order} {points:?}");
        assert!(points[3].1 < 1e-4, "{condition}: {points:?}");
    }
}

/// A bearing two hundred times as wide around as along: Ocvirk's wedge, and squeeze with rising and
/// falling eccentricity, half film.
#[test]
fn very_short() {
    const WIDTH_RATIO: f64 = 0.005;
    const CELLS: [[usize; 2]; 4] = [[32, 6], [64, 12], [128, 24], [256, 48]];
    for row in common::reference_rows("short-bearing-ocvirk", "reference.csv") {
        let eps = row[0];
        if ![0.2, 0.5, 0.8].contains(&eps) {
            continue;
        }
        let bearing = Bearing {
            cavitation: Cavitation::Gumbel,
            ..unit_bearing(WIDTH_RATIO)
        };
        let c = bearing.radial_clearance;
        let at_rest = JournalState {
            position: [eps * c, 0.0],
            ..JournalState::default()
        };
        let (mut wedge, mut rising, mut falling) = (at_rest, at_rest, at_rest);
        wedge.journal_speed = 1.0;
        rising.velocity[0] = c;
        falling.velocity[0] = -c;
        for (name, state, exact) in [
            ("wedge", wedge, [row[1], row[2]]),
            ("rising", rising, [row[8], 0.0]),
            ("falling", falling, [row[10], 0.0]),
        ] {
            let points = CELLS.map(|grid| {
                // Integrals over Z = 2 z / B, from -1 to 1.
                let got = force(&bearing, &state, grid).map(|f| 2.0 * f / WIDTH_RATIO.powi(2));
                (grid[0] as f64, vector_error(got, exact))
            });
            let order = least_squares_order(&points);
            println!("{name} eps {eps}: order {order:.2}, {:.1e}", points[3].1);
            assert!(points[3].1 < 2e-3, "{name} {eps}: {points:?}");
            assert!(order > 1.9, "{name} {eps}: {order} {points:?}");
        }
    }
}
