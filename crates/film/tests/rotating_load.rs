//! A load of constant size that turns at nu times the journal speed keeps the film of a fixed load at
//! the journal speed times (1 - 2 nu), if no hole or groove tells one angle from another: the turning
//! of the line of centres acts like a speed of both surfaces. Film content is dragged along by one
//! and stored by the other, so only a scheme that does both consistently agrees.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod common;

use common::{big_end, conditions, oil};
use sommerfeld_film::{
    Bearing, Carrier, Feed, FeedLine, FeedShape, FilmForce, FilmSolver, JournalState, Step,
};
use std::f64::consts::TAU;

const GRID: [usize; 2] = [120, 10];
const SPEED: f64 = 209.4395;
const ECCENTRICITY: f64 = 0.7;

fn bearing() -> Bearing {
    Bearing {
        feeds: vec![Feed {
            shape: FeedShape::Circumferential { width: 6e-3 },
            carried_by: Carrier::Shell,
            angle: 0.0,
            position: 0.0,
            pressure: 5e5,
            line: FeedLine::Direct,
        }],
        ..big_end()
    }
}

/// Force towards the line of centres and across it, peak pressure, side flow.
type Answer = [f64; 4];

fn answer(film: &FilmSolver, force: [f64; 2], angle: f64) -> Answer {
    let summary = film.summary();
    let (sin, cos) = angle.sin_cos();
    [
        cos * force[0] + sin * force[1],
        cos * force[1] - sin * force[0],
        summary.peak_film_pressure.value,
        summary.side_flow[0] + summary.side_flow[1],
    ]
}

/// Deviations from `steady`: force over its size, peak and flow over theirs.
fn deviation(got: Answer, steady: Answer) -> Answer {
    let force = steady[0].hypot(steady[1]);
    let scale = [force, force, steady[2], steady[3]];
    std::array::from_fn(|k| (got[k] - steady[k]) / scale[k])
}

/// The film in the turning frame after it has passed the bearing several times, in steps of `cells`
/// cells of the grid: the film then turns with the journal from step to step, exactly.
fn turning(nu: f64, cells: usize) -> (Answer, Answer) {
    let c = bearing().radial_clearance;
    let place = |angle: f64| [angle.cos(), angle.sin()].map(|d| ECCENTRICITY * c * d);
    let mut film = FilmSolver::new(&bearing(), &oil(), GRID).unwrap();
    // The start: the steady film of the equivalent speed.
    let fixed = JournalState {
        position: place(0.0),
        journal_speed: SPEED * (1.0 - 2.0 * nu),
        ..JournalState::default()
    };
    let first = film.react(&fixed, Step::Steady, &conditions()).unwrap();
    assert!(first.settled);
    let steady = answer(&film, first.reaction.film_force, 0.0);
    film.accept_step();

    let by = nu.signum() * cells as f64 * TAU / GRID[0] as f64;
    let duration = by / (nu * SPEED);
    // The film passes the journal's line of centres at SPEED (1/2 - nu).
    let passage = TAU / ((0.5 - nu) * SPEED).abs();
    let steps = (2.0 * passage / duration).ceil() as usize;
    let (mut before, mut now) = ([0.0; 4], [0.0; 4]);
    for step in 1..=steps {
        let angle = step as f64 * by;
        let (position, old) = (place(angle), place(angle - by));
        let state = JournalState {
            position,
            velocity: [0, 1].map(|d: usize| (position[d] - old[d]) / duration),
            journal_speed: SPEED,
            journal_angle: SPEED * duration * step as f64,
            ..JournalState::default()
        };
        let solved = film.react(
            &state,
            Step::Implicit {
                duration,
                after: 0.0,
            },
            &conditions(),
        );
        let solved = solved.unwrap();
        assert!(solved.settled, "nu {nu} step {step}");
        film.accept_step();
        before = now;
        now = answer(&film, solved.reaction.film_force, angle);
    }
    // The transient is over.
    let change = deviation(now, before);
    assert!(change.iter().all(|d| d.abs() < 1e-6), "nu {nu}: {change:?}");
    (now, steady)
}

fn check(nu: f64) {
    let deviations = [4, 2, 1].map(|cells| {
        let (got, steady) = turning(nu, cells);
        deviation(got, steady)
    });
    for (value, name) in ["force towards", "force across", "peak"].iter().enumerate() {
        let [coarse, middle, fine] = deviations.map(|d| d[value]);
        let ratio = (coarse - middle) / (middle - fine);
        // Of the parabola through the three steps.
        let limit = (8.0 * fine - 6.0 * middle + coarse) / 3.0;
        println!("nu {nu}, {name}: {coarse:.4} {middle:.4} {fine:.4}, limit {limit:.1e}");
        // Backward differences: the error falls in proportion to the step, to nothing.
        assert!((1.7..2.3).contains(&ratio), "nu {nu}, {name}: {ratio}");
        assert!(limit.abs() < 3e-3, "nu {nu}, {name}: {limit}");
        assert!(fine.abs() < 0.1, "nu {nu}, {name}: {fine}");
    }
    // In an aligned film that passes on all its oil, the mean of h^3 p around falls in a straight line
    // from the groove to the end: eccentricity and feed pressure alone give the side flow.
    for d in deviations {
        assert!(d[3].abs() < 1e-8, "nu {nu}: {d:?}");
    }
}

#[test]
fn a_load_that_turns_slowly_with_the_journal() {
    check(0.25);
}

#[test]
fn a_load_that_turns_against_the_journal() {
    check(-0.5);
}
