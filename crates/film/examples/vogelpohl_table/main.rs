//! Error against time of the paper's method and of the default one, on rows of validation/tilted-table.
//!
//! `cargo run --release -p sommerfeld-film --example vogelpohl_table` prints the table and writes it with its
//! plot into validation/vogelpohl-fdm. Times are the fastest of some runs on one core.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod plot;

use plot::{Panel, Series};
use sommerfeld_film::dimensionless::{
    DimensionlessFilm, DimensionlessIntegrals, solve_dimensionless,
};
use sommerfeld_film::vogelpohl::{VogelpohlSettings, solve_vogelpohl};
use sommerfeld_film::{Cavitation, Inlet, Outcome};
use std::fmt::Write as _;
use std::time::Instant;

/// Rows of the table by their first cells, and what they are.
const CASES: [(&str, &str, &str); 3] = [
    ("2,0.8,0.0,0.0,printed", "D", "eps 0.8, aligned, wedge"),
    (
        "2,0.8,0.8,0.0,printed",
        "D",
        "eps 0.8, gamma 0.8, wedge (the paper's figure 4)",
    ),
    ("2,0.9,0.0,0.0,printed", "V", "eps 0.9, aligned, squeeze"),
];
const GRIDS: [[usize; 2]; 4] = [[64, 16], [128, 32], [256, 64], [512, 128]];
/// Longest time a run is repeated for, s.
const PATIENCE: f64 = 1.0;

#[derive(Clone, Copy)]
enum Method {
    FiniteVolume,
    Vogelpohl { relaxation: f64 },
}

const METHODS: [(&str, Method, usize); 3] = [
    ("finite-volume", Method::FiniteVolume, 4),
    ("vogelpohl-fdm", Method::Vogelpohl { relaxation: 1.0 }, 3),
    (
        "vogelpohl-fdm, over-relaxed 1.8",
        Method::Vogelpohl { relaxation: 1.8 },
        4,
    ),
];

fn main() {
    let mut table = String::from(
        "# source: this program, cargo run --release -p sommerfeld-film --example vogelpohl_table; errors \
         against validation/tilted-table, times of one core\n\
         case,method,around,axial,updates_or_sweeps,time[ms],force_error[-],peak_error[-]\n",
    );
    let mut panels = Vec::new();
    for (row, rhs, name) in CASES {
        let (film, expected) = reference(row, rhs);
        let mut series = Vec::new();
        for (method_name, method, grids) in METHODS {
            let mut points = Vec::new();
            for grid in GRIDS.into_iter().take(grids) {
                let (time, steps, got) = timed(&film, method, grid);
                let force = (got.p_cos - expected.p_cos).hypot(got.p_sin - expected.p_sin)
                    / expected.p_cos.hypot(expected.p_sin);
                let peak = (got.peak / expected.peak - 1.0).abs();
                points.push((time, force));
                let line = format!(
                    "\"{name}\",\"{method_name}\",{},{},{steps},{:.3},{force:.2e},{peak:.2e}",
                    grid[0],
                    grid[1],
                    1e3 * time
                );
                println!("{line}");
                writeln!(table, "{line}").unwrap();
            }
            series.push(Series {
                name: method_name,
                points,
            });
        }
        panels.push(Panel {
            title: name,
            series,
        });
    }
    let directory = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../validation/vogelpohl-fdm"
    );
    std::fs::write(format!("{directory}/error-over-time.csv"), table).unwrap();
    std::fs::write(
        format!("{directory}/error-over-time.svg"),
        plot::svg(&panels),
    )
    .unwrap();
}

/// Fastest time, film updates or sweeps, and the integrals.
fn timed(
    film: &DimensionlessFilm,
    method: Method,
    grid: [usize; 2],
) -> (f64, usize, DimensionlessIntegrals) {
    let begin = Instant::now();
    let mut fastest = f64::INFINITY;
    loop {
        let start = Instant::now();
        let (outcome, steps, integrals) = match method {
            Method::FiniteVolume => {
                let solution = solve_dimensionless(film, grid).unwrap();
                (solution.outcome, solution.iterations, solution.integrals)
            }
            Method::Vogelpohl { relaxation } => {
                let settings = VogelpohlSettings {
                    relaxation,
                    ..VogelpohlSettings::new(grid)
                };
                let solution = solve_vogelpohl(film, &settings).unwrap();
                let sweeps = solution.sweeps.iter().map(|(_, sweeps)| sweeps).sum();
                (solution.outcome, sweeps, solution.integrals)
            }
        };
        assert_eq!(outcome, Outcome::Converged);
        fastest = fastest.min(start.elapsed().as_secs_f64());
        if begin.elapsed().as_secs_f64() > PATIENCE {
            return (fastest, steps, integrals);
        }
    }
}

/// Film and integrals of the row that opens with `row` and has this right side.
fn reference(row: &str, rhs: &str) -> (DimensionlessFilm, DimensionlessIntegrals) {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../validation/tilted-table/reference.csv"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let line = text
        .lines()
        .find(|line| line.starts_with(row) && line.split(',').nth(7) == Some(rhs))
        .unwrap();
    let number = |k: usize| line.split(',').nth(k).unwrap().parse::<f64>().unwrap();
    let film = DimensionlessFilm {
        d_over_b: number(0),
        relative_eccentricity: number(1),
        tilt_gamma: number(2),
        tilt_delta: number(5),
        wedge: f64::from(u8::from(rhs == "D")),
        squeeze: f64::from(u8::from(rhs == "V")),
        cavitation: Cavitation::Reynolds,
        inlet: Inlet::Cyclic,
    };
    let expected = DimensionlessIntegrals {
        p_cos: number(9),
        p_sin: number(10),
        p_z_cos: number(11),
        p_z_sin: number(12),
        peak: number(13),
    };
    (film, expected)
}
