//! Flow of grooves and holes against the closed forms of `book/src/groove-flow.md`, and behind lines.
#![allow(clippy::unwrap_used)]

mod common;

use common::planar::Planar;
use common::recomputed::{Past, recompute};
use common::{big_end, conditions, oil};
use sommerfeld_film::cavitation::model_of;
use sommerfeld_film::gap::Gap;
use sommerfeld_film::reynolds::{Around, Cell, Storage};
use sommerfeld_film::supply::drilling_head;
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Feed, FeedFlow, FeedLine, FeedShape, FilmForce, FilmSolver,
    JournalState, Step,
};
use std::f64::consts::{PI, TAU};

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

/// The mean of h^3 p around falls in straight lines over the lands, which cells reproduce: what is left
/// is round-off.
#[test]
fn circumferential_groove_at_rest() {
    for cavitation in CLOSURES {
        for eps in [0.0, 0.3, 0.6, 0.9] {
            let bar = 1e-10;
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

/// Line and lands in series: `q = p / (R_line + R_lands)`, to round-off.
#[test]
fn a_line_in_series_with_the_lands() {
    for cavitation in CLOSURES {
        for eps in [0.0, 0.6] {
            let bar = 1e-10;
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

/// The hole is the cells whose centre it covers: its area, and with it the flow, jumps with its place
/// between the cells. The bars are what `supply.rs` states, worst of nine places.
#[test]
fn hole_at_rest() {
    let diameter = 6e-3;
    let exact = hole_flow(&big_end(), 0.5 * diameter);
    for (grid, bar) in [([64, 16], 0.20), ([128, 32], 0.05), ([256, 64], 0.03)] {
        let mut worst = 0.0_f64;
        for place in 0..9 {
            let hole = Feed {
                angle: 1.0 + 0.0123 * f64::from(place),
                position: 1e-4 * f64::from(place % 3),
                ..feed(FeedShape::Hole { diameter })
            };
            let found = flows(&with(vec![hole]), &at_rest(0.0), grid).feeds[0].flow;
            worst = worst.max((found / exact - 1.0).abs());
        }
        println!("{grid:?}: worst {worst:.4} of {bar}");
        assert!(worst < bar, "{grid:?}: {worst}");
    }
}

/// Two axial grooves over the whole width of a ring without ends: one-dimensional flow around from the
/// one at `p` to the other at 0, `q = p w / 12 eta (1/L_1 + 1/L_2)` with the integrals `L` of h^-3.
#[test]
fn axial_grooves_without_ends() {
    // Lengths over the radius, gaps over the clearance, p in the operator's unit: no factor 12 eta.
    for eps in [0.0, 0.5] {
        let gap = |x: f64| 1.0 - eps * (x - 0.4).cos();
        let n = 240;
        let faces: Vec<f64> = (0..=n).map(|i| TAU * f64::from(i) / f64::from(n)).collect();
        let closure = model_of(Cavitation::MassConserving);
        let mut film = Planar::new(faces.clone(), Around::Periodic, closure);
        let profile = Gap::from_profile(&film.grid, |x, _| gap(x), |_| 0.0);
        for (cell, pressure) in [(20..40, 1.0), (140..160, 0.0)]
            .into_iter()
            .flat_map(|(cells, pressure)| cells.map(move |cell| (cell, pressure)))
        {
            film.set.cells[cell] = Cell::Fed;
            film.set.fed_pressure[cell] = pressure;
        }
        film.solve(&profile, 0.0, Storage::Rate);
        let flow: f64 = film.excess[20..40].iter().map(|excess| -excess).sum();
        // Simpson's rule, far finer than the film.
        let length = |from: f64, to: f64| {
            let steps = 2000;
            let width = (to - from) / f64::from(steps);
            let sum: f64 = (0..=steps)
                .map(|k| {
                    let weight = match k {
                        0 => 1.0,
                        k if k == steps => 1.0,
                        k if k % 2 == 1 => 4.0,
                        _ => 2.0,
                    };
                    weight * gap(from + f64::from(k) * width).powi(-3)
                })
                .sum();
            sum * width / 3.0
        };
        let exact = 1.0 / length(faces[40], faces[140]) + 1.0 / length(faces[160], TAU + faces[20]);
        // h^-3 at the faces alone: second order in the 100 cells between the grooves.
        let bar = if eps == 0.0 { 1e-10 } else { 1e-3 };
        let deviation = (flow / exact - 1.0).abs();
        println!("axial grooves, eps {eps}: {deviation:.2e} of {bar:e}");
        assert!(deviation < bar, "{eps}: {deviation:e}");
    }
}

/// A groove over part of the circumference, also across angle 0: lengthened, it takes the flow of the
/// strip that is added, `2 l h^3 p / (12 eta b)`; what its ends take stays. Groove faces lie on the grid.
#[test]
fn arcs_grow_by_their_strip() {
    let step = PI * big_end().diameter / 64.0;
    let flow = |cells: f64, angle: f64| {
        let arc = feed(FeedShape::Rectangle {
            length: cells * step,
            width: GROOVE,
        });
        let groove = Feed { angle, ..arc };
        flows(&with(vec![groove]), &at_rest(0.0), [64, 20]).feeds[0].flow
    };
    let strip = lands(0.0) * PRESSURE / 64.0;
    let added = flow(32.0, PI) - flow(24.0, PI);
    assert!(
        (added / (8.0 * strip) - 1.0).abs() < 1e-4,
        "{added} {strip}"
    );
    for angle in [0.0, TAU - 0.5 * PI, 0.25 * PI] {
        assert!((flow(32.0, angle) / flow(32.0, PI) - 1.0).abs() < 1e-9);
    }
}

/// An axial groove where the film is ruptured without it: it cannot but take from its line.
fn before_the_widest_gap() -> Feed {
    Feed {
        angle: 3.0,
        ..feed(FeedShape::Rectangle {
            length: 9e-3,
            width: 15e-3,
        })
    }
}

/// Resistance to 0 is the groove without a line; a huge one lets nothing through.
#[test]
fn from_no_line_to_a_closed_one() {
    let groove = before_the_widest_gap();
    for cavitation in CLOSURES {
        let solve = |feed: Feed| {
            let bearing = Bearing {
                cavitation,
                ..with(vec![feed])
            };
            flows(&bearing, &turning(0.6), [64, 16])
        };
        let direct = solve(groove.clone());
        for resistance in [0.0, 1e-4] {
            let open = solve(behind(groove.clone(), resistance));
            let [a, b] = [open.feeds[0], direct.feeds[0]];
            assert!((a.flow / b.flow - 1.0).abs() < 1e-10, "{a:?} {b:?}");
            assert!((a.pressure / b.pressure - 1.0).abs() < 1e-10);
            let force = open.force[0].hypot(open.force[1]);
            let off = (open.force[0] - direct.force[0]).hypot(open.force[1] - direct.force[1]);
            assert!(off < 1e-10 * force);
        }
        let closed = solve(behind(groove.clone(), 1e20));
        assert_eq!(closed.feeds[0].pressure, 0.0);
        if cavitation == Cavitation::MassConserving {
            assert!(closed.feeds[0].flow.abs() < 1e-9 * direct.feeds[0].flow);
        }
    }
}

/// A line too thin for what the film takes: it delivers what its whole pressure drives, the groove
/// stands at cavitation pressure, and no oil is made.
#[test]
fn a_starved_line_is_the_limit() {
    let resistance = 2e12;
    let groove = behind(before_the_widest_gap(), resistance);
    let found = flows(&with(vec![groove]), &turning(0.6), [64, 16]);
    let limit = PRESSURE / resistance;
    assert_eq!(found.feeds[0].pressure, 0.0);
    assert!((found.feeds[0].flow / limit - 1.0).abs() < 1e-9);
    let sum = recompute(&found.film, &turning(0.6), VISCOSITY, true, Past::None);
    assert_eq!(sum.violations, 0);
    assert!(sum.worst_cell < 1e-10 * sum.largest_flow);
    let [front, rear] = found.side;
    assert!(
        ((front + rear) / limit - 1.0).abs() < 1e-6,
        "{front} {rear}"
    );
}

/// A hole that opens into a groove: behind lines both are one pocket, their lines parallel; two that
/// hold their pressures without a line share cells, and the first listed holds those.
#[test]
fn overlapping_feeds() {
    let hole = Feed {
        carried_by: Carrier::Journal,
        pressure: 2e5,
        ..feed(FeedShape::Hole { diameter: 4e-3 })
    };
    let (film, line) = (1.0 / lands(0.0), 1.7e11);
    let solve = |feeds: Vec<Feed>| flows(&with(feeds), &at_rest(0.0), [64, 20]).feeds;
    let both = solve(vec![
        behind(hole.clone(), line),
        behind(circumferential(), 2.0 * line),
    ]);
    // Three branches meet: two lines and the film.
    let left = (2e5 / line + PRESSURE / (2.0 * line)) / (1.0 / line + 0.5 / line + 1.0 / film);
    for (feed, supply, line) in [(both[0], 2e5, line), (both[1], PRESSURE, 2.0 * line)] {
        assert!(
            (feed.pressure / left - 1.0).abs() < 1e-10,
            "{feed:?} {left}"
        );
        assert!(
            (feed.flow / ((supply - left) / line) - 1.0).abs() < 1e-9,
            "{feed:?}"
        );
    }
    // The groove holds its pressure: the hole's line takes oil out of it, the film sees no hole.
    let held = solve(vec![circumferential(), behind(hole.clone(), line)]);
    let back = (2e5 - PRESSURE) / line;
    assert!((held[1].flow / back - 1.0).abs() < 1e-12, "{held:?}");
    let total = (held[0].flow + held[1].flow) * film / PRESSURE;
    assert!((total - 1.0).abs() < 1e-10, "{total}");
    // Neither can give way: the order decides.
    let covered = solve(vec![circumferential(), hole.clone()]);
    assert_eq!(covered[1].flow, 0.0);
    assert!((covered[0].flow * film / PRESSURE - 1.0).abs() < 1e-10);
    let first = solve(vec![hole, circumferential()]);
    assert!(
        first[0].flow < 0.0,
        "the groove drives oil into the hole: {first:?}"
    );
}

/// 850 kg/m3 at 3000 rpm from the axis to 104 mm: 4.5369 bar.
#[test]
fn head_of_a_drilling() {
    let head = drilling_head(850.0, 100.0 * PI, 0.0, 0.104);
    assert!((head - 453_686.0).abs() < 1.0, "{head}");
    let part = drilling_head(850.0, 100.0 * PI, 0.03, 0.104);
    let rest = drilling_head(850.0, 100.0 * PI, 0.0, 0.03);
    assert!((part + rest - head).abs() < 1e-6);
    assert_eq!(
        drilling_head(850.0, 100.0, 0.1, 0.0),
        -drilling_head(850.0, -100.0, 0.0, 0.1)
    );
}
