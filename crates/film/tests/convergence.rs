//! How the error of the force falls with the grid, against the tables in `validation/convergence`.
//!
//! With `SOMMERFELD_WRITE_TABLES=1` the tables are written anew, references included.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod common;

use common::{big_end, conditions, least_squares_order, oil};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Ends, Feature, Feed, FeedLine, FeedShape, FilmForce, FilmSolver,
    JournalState, Shape, Step,
};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write as _;

const GRIDS: [[usize; 2]; 4] = [[32, 8], [64, 16], [128, 32], [256, 64]];
/// Grids of the reference: Richardson's extrapolation of the two, by order 2.
const REFERENCE_GRIDS: [[usize; 2]; 2] = [[256, 64], [512, 128]];

struct Case {
    name: &'static str,
    words: &'static str,
    bearing: Bearing,
    state: JournalState,
    least_order: f64,
}

fn solve(case: &Case, grid: [usize; 2]) -> ([f64; 2], usize) {
    let mut film = FilmSolver::new(&case.bearing, &oil(), grid).unwrap();
    let answer = film
        .react(&case.state, Step::Steady, &conditions())
        .unwrap();
    assert!(answer.settled, "{} {grid:?}", case.name);
    let summary = film.summary();
    (answer.reaction.film_force, summary.iterations)
}

fn reference(case: &Case) -> [f64; 2] {
    let [coarse, fine] = REFERENCE_GRIDS.map(|grid| solve(case, grid).0);
    std::array::from_fn(|k| fine[k] + (fine[k] - coarse[k]) / 3.0)
}

struct Line {
    grid: [usize; 2],
    error: f64,
    iterations: usize,
}

fn table(case: &Case, reference: [f64; 2], lines: &[Line]) -> String {
    let mut text = format!(
        "# source: this program, crates/film/tests/convergence.rs\n# {}\n# reference: force {:.9e} {:.9e} N, extrapolated from {} x {} and {} x {} cells\n\
         cells_around,cells_along,error[-],order[-],iterations\n",
        case.words,
        reference[0],
        reference[1],
        REFERENCE_GRIDS[0][0],
        REFERENCE_GRIDS[0][1],
        REFERENCE_GRIDS[1][0],
        REFERENCE_GRIDS[1][1],
    );
    for (k, line) in lines.iter().enumerate() {
        let order = if k == 0 {
            String::new()
        } else {
            format!("{:.3}", (lines[k - 1].error / line.error).log2())
        };
        let [around, along] = line.grid;
        writeln!(
            text,
            "{around},{along},{:.6e},{order},{}",
            line.error, line.iterations
        )
        .unwrap();
    }
    text
}

fn path_of(case: &Case) -> String {
    format!(
        "{}/../../validation/convergence/{}.csv",
        env!("CARGO_MANIFEST_DIR"),
        case.name
    )
}

/// The reference in the head of a table.
fn committed_reference(text: &str) -> [f64; 2] {
    let is_reference = |line: &&str| line.starts_with("# reference:");
    let line = text.lines().find(is_reference).unwrap();
    let mut numbers = line.split_whitespace().filter_map(|w| w.parse().ok());
    [numbers.next().unwrap(), numbers.next().unwrap()]
}

fn check(case: &Case) {
    let path = path_of(case);
    let writes = std::env::var_os("SOMMERFELD_WRITE_TABLES").is_some();
    let reference = if writes {
        reference(case)
    } else {
        committed_reference(&std::fs::read_to_string(&path).unwrap())
    };
    let size = reference[0].hypot(reference[1]);
    let lines = GRIDS.map(|grid| {
        let (force, iterations) = solve(case, grid);
        let error = (force[0] - reference[0]).hypot(force[1] - reference[1]) / size;
        Line {
            grid,
            error,
            iterations,
        }
    });
    let text = table(case, reference, &lines);
    println!("{text}");
    if writes {
        std::fs::write(&path, &text).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap();
    let rows = committed.lines().filter(|l| !l.starts_with('#')).skip(1);
    assert_eq!(rows.clone().count(), lines.len(), "{}", case.name);
    for (line, row) in lines.iter().zip(rows) {
        let cells: Vec<&str> = row.split(',').collect();
        let error: f64 = cells[2].parse().unwrap();
        let iterations: usize = cells[4].parse().unwrap();
        assert!(
            (line.error / error - 1.0).abs() < 0.01,
            "{}: {} against {row}",
            case.name,
            line.error
        );
        assert!(
            line.iterations.abs_diff(iterations) <= 2,
            "{}: {} iterations against {row}",
            case.name,
            line.iterations
        );
    }
    let points = lines.map(|l| (l.grid[0] as f64, l.error));
    let order = least_squares_order(&points);
    println!("{}: order {order:.2}", case.name);
    assert!(order >= case.least_order, "{}: {order}", case.name);
}

fn aligned(relative_eccentricity: f64) -> JournalState {
    let c = big_end().radial_clearance;
    JournalState {
        // Off the faces of every grid.
        position: [0.8, 0.6].map(|d| relative_eccentricity * c * d),
        journal_speed: 209.4395,
        ..JournalState::default()
    }
}

#[test]
fn full_film() {
    let c = big_end().radial_clearance;
    let half_width = 0.5 * big_end().width;
    check(&Case {
        name: "full-film",
        words: "full film: oil bath of 50 MPa at both ends, eps 0.6, tilted, wedge and squeeze; \
                closure gumbel",
        bearing: Bearing {
            cavitation: Cavitation::Gumbel,
            ends: Ends::Flooded,
            ambient_pressure: 5e7,
            ..big_end()
        },
        state: JournalState {
            tilt: [0.1 * c / half_width, -0.05 * c / half_width],
            velocity: [20.0 * c, -10.0 * c],
            ..aligned(0.6)
        },
        least_order: 1.9,
    });
}

#[test]
fn rupture_reynolds() {
    check(&Case {
        name: "rupture-reynolds",
        words: "plain bearing in air, eps 0.6; closure reynolds",
        bearing: Bearing {
            cavitation: Cavitation::Reynolds,
            ..big_end()
        },
        state: aligned(0.6),
        least_order: 1.7,
    });
}

#[test]
fn rupture_mass_conserving() {
    let radius = big_end().radius();
    check(&Case {
        name: "rupture-mass-conserving",
        words: "axial groove over the whole width, 22.5 deg long at -90 deg, 2 bar, ends in air, \
                eps 0.6; closure mass-conserving",
        bearing: Bearing {
            feeds: vec![Feed {
                shape: FeedShape::Rectangle {
                    length: PI / 8.0 * radius,
                    width: big_end().width,
                },
                carried_by: Carrier::Shell,
                angle: -FRAC_PI_2,
                position: 0.0,
                pressure: 2e5,
                line: FeedLine::Direct,
            }],
            ..big_end()
        },
        state: aligned(0.6),
        least_order: 1.7,
    });
}

#[test]
fn smooth_shape() {
    check(&Case {
        name: "smooth-shape",
        words: "plain bearing in air, eps 0.5, bore with waves of order 2 (10 um) and 3 (2 um), crowned \
                journal (4 um); closure reynolds",
        bearing: Bearing {
            cavitation: Cavitation::Reynolds,
            bore: Shape::of([
                Feature::Harmonic {
                    order: 2,
                    amplitude: 10e-6,
                    phase: 0.3,
                },
                Feature::Harmonic {
                    order: 3,
                    amplitude: 2e-6,
                    phase: 1.0,
                },
            ]),
            journal: Shape::of([Feature::Crowning {
                end_offset: -4e-6,
                half_width: 0.5 * big_end().width,
            }]),
            ..big_end()
        },
        state: aligned(0.5),
        least_order: 1.7,
    });
}
