//! Flow of grooves and holes against the closed forms of `book/src/groove-flow.md`, and behind lines.
#![allow(clippy::unwrap_used)]

mod common;

use common::recomputed::{Past, recompute};
use common::{big_end, conditions, oil};
use sommerfeld_film::supply::drilling_head;
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Conditions, Ends, Feed, FeedFlow, FeedLine, FeedShape, FilmForce,
    FilmSolver, JournalState, Step,
};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Of the oil in [`oil`].
const VISCOSITY: f64 = 8e-3;
const PRESSURE: f64 = 5e5;
const CLOSURES: [Cavitation; 3] = [
    Cavitation::Gumbel,
    Cavitation::Reynolds,
    Cavitation::MassConserving,
];

fn feed(shape: FeedShape) -> Feed {
    Feed {
        shape,
        carried_by: Carrier::Shell,
        angle: 0.0,
        position: 0.0,
        pressure: PRESSURE,
        line: FeedLine::Direct,
    }
}

fn behind(feed: Feed, resistance: f64) -> Feed {
    Feed {
        line: FeedLine::Resistive { resistance },
        ..feed
    }
}

fn with(feeds: Vec<Feed>) -> Bearing {
    Bearing { feeds, ..big_end() }
}

/// At rest at a relative eccentricity, in a direction that no cell favours.
fn at_rest(eps: f64) -> JournalState {
    let c = big_end().radial_clearance;
    JournalState {
        position: [eps * c * 0.7_f64.cos(), eps * c * 0.7_f64.sin()],
        ..JournalState::default()
    }
}

fn turning(eps: f64) -> JournalState {
    JournalState {
        journal_speed: 200.0,
        ..at_rest(eps)
    }
}

struct Flows {
    feeds: Vec<FeedFlow>,
    side: [f64; 2],
    force: [f64; 2],
    film: FilmSolver,
}

fn flows(bearing: &Bearing, state: &JournalState, grid: [usize; 2]) -> Flows {
    let mut film = FilmSolver::new(bearing, &oil(), grid).unwrap();
    let answer = film.react(state, Step::Steady, &conditions()).unwrap();
    assert!(answer.settled);
    Flows {
        feeds: film.feed_flows().to_vec(),
        side: film.summary().side_flow,
        force: answer.reaction.film_force,
        film,
    }
}

/// Groove width of the circumferential groove, and its land on either side, m.
const GROOVE: f64 = 6e-3;
const LAND: f64 = 12e-3;

fn circumferential() -> Feed {
    feed(FeedShape::Circumferential { width: GROOVE })
}

/// Flow of the circumferential groove over pressure, both lands: the closed form.
fn lands(eps: f64) -> f64 {
    let c = big_end().radial_clearance;
    let land = PI * big_end().diameter * c.powi(3) / (12.0 * VISCOSITY * LAND);
    2.0 * land * (1.0 + 1.5 * eps * eps)
}

/// Concentric the pressure falls in straight lines, which cells reproduce: round-off alone is left.
/// Eccentric, the mean of h^3 around is one of equal angles: exact up to round-off, too; but the
/// pressure flows around as well, and the sum of cells answers to second order: bar 1e-4 at 128 cells.
#[test]
fn circumferential_groove_at_rest() {
    for cavitation in CLOSURES {
        for (eps, bar) in [(0.0, 1e-10), (0.3, 1e-4), (0.6, 1e-4), (0.9, 1e-4)] {
            let bearing = Bearing {
                cavitation,
                ..with(vec![circumferential()])
            };
            let found = flows(&bearing, &at_rest(eps), [128, 20]);
            let exact = lands(eps) * PRESSURE;
            let [front, rear] = found.side;
            let deviation = (found.feeds[0].flow / exact - 1.0).abs();
            println!("{cavitation:?} eps {eps}: {deviation:.2e} of {bar:e}");
            assert!(deviation < bar, "{cavitation:?} {eps}: {deviation:e}");
            assert!((front / rear - 1.0).abs() < 1e-10, "{front} {rear}");
            assert!(((front + rear) / exact - 1.0).abs() < bar);
        }
    }
}

/// A groove off the middle feeds the narrower land more: each edge its own closed form.
#[test]
fn edges_share_by_their_lands() {
    let off = 4e-3;
    let found = flows(
        &with(vec![Feed {
            position: off,
            ..circumferential()
        }]),
        &at_rest(0.0),
        [64, 20],
    );
    let one = 0.5 * lands(0.0) * PRESSURE * LAND;
    let [front, rear] = found.side;
    assert!((front * (LAND + off) / one - 1.0).abs() < 1e-10, "{front}");
    assert!((rear * (LAND - off) / one - 1.0).abs() < 1e-10, "{rear}");
}

/// Line and lands in series: `q = p / (R_line + R_lands)`, at rest and, through the mean of h^3,
/// eccentric; round-off concentric.
#[test]
fn a_line_in_series_with_the_lands() {
    for cavitation in CLOSURES {
        for (eps, bar) in [(0.0, 1e-10), (0.6, 1e-4)] {
            for share in [1e-3, 0.5, 1.0, 30.0] {
                let film = 1.0 / lands(eps);
                let bearing = Bearing {
                    cavitation,
                    ..with(vec![behind(circumferential(), share * film)])
                };
                let found = flows(&bearing, &at_rest(eps), [128, 20]).feeds[0];
                let exact = PRESSURE / ((1.0 + share) * film);
                assert!((found.flow / exact - 1.0).abs() < bar, "{found:?} {exact}");
                let left = PRESSURE / (1.0 + share);
                assert!((found.pressure / left - 1.0).abs() < bar, "{found:?}");
            }
        }
    }
}

/// A round hole in a concentric gap at rest, against the conformal radius of the strip, for which
/// the hole is small: `q = 2 pi h^3 p / (12 eta ln(2 B / (pi a)))`.
fn hole_flow(bearing: &Bearing, radius: f64) -> f64 {
    let conducts = bearing.radial_clearance.powi(3) / (12.0 * VISCOSITY);
    TAU * conducts * PRESSURE / (2.0 * bearing.width / (PI * radius)).ln()
}

#[test]
fn hole_at_rest() {
    for grid in [[64, 16], [128, 32], [256, 64], [512, 128]] {
        for diameter in [3e-3, 6e-3, 9e-3] {
            let mut worst = (f64::INFINITY, -f64::INFINITY);
            for angle in [0.0, 0.011, 0.023, 0.034, 1.0, 2.0] {
                let hole = Feed {
                    angle,
                    ..feed(FeedShape::Hole { diameter })
                };
                let found = flows(&with(vec![hole]), &at_rest(0.0), grid).feeds[0].flow;
                let e = found / hole_flow(&big_end(), 0.5 * diameter) - 1.0;
                worst = (worst.0.min(e), worst.1.max(e));
            }
            println!("{grid:?} {diameter}: {worst:?}");
        }
    }
}
