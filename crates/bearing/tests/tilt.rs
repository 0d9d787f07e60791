//! Tilt in operation: prescribed over a cycle, free under moments, and both against each other.
#![allow(clippy::unwrap_used)]

mod common;

use common::{CONDITIONS, plain_bearing};
use sommerfeld_bearing::{
    CycleTilt, EquilibriumRequest, EquilibriumSettings, JournalOrbit, LoadCycle, LoadPoint,
    OrbitSettings, OrbitStart, find_equilibrium, journal_orbit,
};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Feed, FeedLine, FeedShape, FilmError, FilmForce, FilmShear,
    FilmSolver, JournalState, OnlineFilm, Outcome, ShortBearingFilm, Step,
};
use sommerfeld_oil::Lubricant;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

const SPEED: f64 = 209.0;

fn bearing(cavitation: Cavitation) -> Bearing {
    let mut bearing = plain_bearing(0.072, 0.030, 36e-6);
    bearing.cavitation = cavitation;
    if cavitation == Cavitation::MassConserving {
        bearing.film_shear = FilmShear::FilmFraction;
        bearing.feeds.push(Feed {
            shape: FeedShape::Circumferential { width: 5e-3 },
            carried_by: Carrier::Shell,
            angle: 0.0,
            position: 0.0,
            pressure: 5e5,
            line: FeedLine::Direct,
        });
    }
    bearing
}

fn film(bearing: &Bearing) -> FilmSolver {
    let oil = Lubricant::constant(8e-3, 850.0);
    FilmSolver::new(bearing, &oil, [36, 12]).unwrap()
}

fn run(
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    cycle: &LoadCycle,
    start: OrbitStart,
) -> JournalOrbit {
    let rows = cycle.points.len();
    let settings = OrbitSettings {
        crank_step: TAU / rows.max(120) as f64,
        cycle_limit: 40,
        start,
        ..OrbitSettings::default()
    };
    let mut watch = |_: &_, _: &dyn FilmForce, _| ControlFlow::Continue(());
    journal_orbit(film, bearing, cycle, &CONDITIONS, &settings, &mut watch).unwrap()
}

/// Load and moment at each of `rows` crank angles of one turn, and what holds the tilt.
fn cycle(
    rows: u32,
    load: impl Fn(f64) -> [f64; 2],
    moment: impl Fn(f64) -> [f64; 2],
    tilt: CycleTilt,
) -> LoadCycle {
    let points = (0..rows)
        .map(|row| {
            let angle = TAU * f64::from(row) / f64::from(rows);
            LoadPoint {
                crank_angle: angle,
                load: load(angle),
                moment: moment(angle),
                journal_speed: SPEED,
                shell_speed: 0.0,
            }
        })
        .collect();
    LoadCycle {
        points,
        period: TAU,
        engine_speed: SPEED,
        journal_mass: 0.0,
        feed_pressures: Vec::new(),
        tilt,
    }
}

/// A tilt that is held under a constant load ends in the equilibrium of that tilt, from the centre on.
#[test]
fn a_constant_tilt_comes_to_rest_in_its_equilibrium() {
    for cavitation in [Cavitation::Reynolds, Cavitation::MassConserving] {
        let bearing = bearing(cavitation);
        let mut film = film(&bearing);
        let (load, tilt) = ([1500.0, -2000.0], [4e-4, -2e-4]);
        let constant = cycle(1, |_| load, |_| [0.0; 2], CycleTilt::Prescribed(vec![tilt]));
        let centred = OrbitStart::At(JournalState::default());
        let orbit = run(&mut film, &bearing, &constant, centred);
        let failed = orbit
            .points
            .iter()
            .filter(|p| p.outcome != Outcome::Converged)
            .count();
        // Cells that fill and empty keep a film with memory moving by less than the bar below.
        assert_eq!(failed, 0, "{cavitation:?}");
        let request = EquilibriumRequest {
            load,
            moment: None,
            frame: JournalState {
                tilt,
                journal_speed: SPEED,
                ..JournalState::default()
            },
            start: None,
            settings: EquilibriumSettings::default(),
        };
        let rest = find_equilibrium(&mut film, &bearing, &request, &CONDITIONS).unwrap();
        assert_eq!(rest.outcome, Outcome::Converged);
        let end = orbit.points[orbit.points.len() - 1];
        assert_eq!(end.state.tilt, tilt);
        let apart = [0, 1].map(|i| end.state.position[i] - rest.state.position[i]);
        let distance = apart[0].hypot(apart[1]) / bearing.radial_clearance;
        assert!(distance < 1e-3, "{cavitation:?}: {distance:e}");
        let moment = rest.reaction.moment();
        for axis in 0..2 {
            let off = (end.moment[axis] + moment[axis]).abs() / moment[0].hypot(moment[1]);
            assert!(off < 0.01, "{cavitation:?}: {:?} {moment:?}", end.moment);
        }
    }
}

/// The power that a moving tilt puts into the film stands in the squeeze power, and the moment that
/// holds the tilt is the one that does this work.
#[test]
fn an_oscillating_tilt_does_its_work_on_the_film() {
    let bearing = bearing(Cavitation::Reynolds);
    let mut film = film(&bearing);
    let rows = 120_u32;
    let tilts = (0..rows)
        .map(|row| {
            let angle = TAU * f64::from(row) / f64::from(rows);
            [8e-4 * (3.0 * angle).sin(), 3e-4 * (2.0 * angle).cos()]
        })
        .collect();
    let oscillating = cycle(
        rows,
        |_| [1500.0, 0.0],
        |_| [0.0; 2],
        CycleTilt::Prescribed(tilts),
    );
    let orbit = run(&mut film, &bearing, &oscillating, OrbitStart::Equilibrium);
    assert_eq!(orbit.outcome, Outcome::Converged);
    let (mut of_tilt, mut largest, mut worst) = (0.0_f64, 0.0_f64, 0.0_f64);
    for point in &orbit.points[1..] {
        // The rate is that of the curve through the rows.
        let angle = point.crank_angle;
        let rate = SPEED * 24e-4 * (3.0 * angle).cos();
        assert!((point.state.tilt_rate[0] - rate).abs() < 0.01 * SPEED * 24e-4);
        let ([fx, fy], [vx, vy]) = (point.reaction.force(), point.state.velocity);
        let ([mx, my], [rx, ry]) = (point.moment, point.state.tilt_rate);
        let work = mx * rx + my * ry;
        let power = work - fx * vx - fy * vy;
        of_tilt = of_tilt.max(work.abs());
        largest = largest.max(point.summary.squeeze_power.abs());
        worst = worst.max((power - point.summary.squeeze_power).abs());
    }
    assert!(worst < 1e-3 * largest, "{worst} of {largest} W");
    assert!(of_tilt > 0.2 * largest, "{of_tilt} of {largest} W");
}

/// The tilt that a free journal found under its moments, prescribed, needs just these moments: largest
/// difference of the moments and its root mean square, N m, and of the positions over the clearance.
fn round_trip(cavitation: Cavitation, rows: u32) -> [f64; 3] {
    let bearing = bearing(cavitation);
    let load = |angle: f64| [2500.0 + 800.0 * angle.cos(), 900.0 * angle.sin()];
    let moment = |angle: f64| [6.0 * angle.sin(), 4.0 + 3.0 * (2.0 * angle).cos()];
    let mut first = film(&bearing);
    let free = cycle(rows, load, moment, CycleTilt::Free);
    let free = run(&mut first, &bearing, &free, OrbitStart::Equilibrium);
    assert_eq!(free.outcome, Outcome::Converged, "{cavitation:?}");
    // The last point is the first of the next turn.
    let points = &free.points[..free.points.len() - 1];
    let tilts = points.iter().map(|point| point.state.tilt).collect();
    let held = cycle(rows, load, |_| [0.0; 2], CycleTilt::Prescribed(tilts));
    let mut second = film(&bearing);
    let held = run(&mut second, &bearing, &held, OrbitStart::Equilibrium);
    assert_eq!(held.outcome, Outcome::Converged, "{cavitation:?}");
    let (mut off, mut apart, mut tilted) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut squares = 0.0;
    for (free, held) in free.points.iter().zip(&held.points) {
        let change = [0, 1].map(|axis| held.moment[axis] - free.moment[axis]);
        off = off.max(change[0].hypot(change[1]));
        squares += change[0].powi(2) + change[1].powi(2);
        let moved = [0, 1].map(|axis| held.state.position[axis] - free.state.position[axis]);
        apart = apart.max(moved[0].hypot(moved[1]) / bearing.radial_clearance);
        let edge = free.state.tilt[0].hypot(free.state.tilt[1]) * 0.5 * bearing.width;
        tilted = tilted.max(edge / bearing.radial_clearance);
    }
    assert!(tilted > 0.1, "{tilted}");
    let rms = (squares / f64::from(rows)).sqrt();
    [off, rms, apart]
}

/// Without memory of the film the round trip closes with the square of the spacing of its table.
#[test]
fn the_tilt_of_a_free_run_takes_its_moments_to_hold() {
    let [coarse, fine] = [120, 240].map(|rows| round_trip(Cavitation::Reynolds, rows));
    assert!(fine[0] < 0.005 * 7.0, "{} N m", fine[0]);
    let order = (coarse[1] / fine[1]).log2();
    assert!(order > 1.5, "rms {} after {} N m", fine[1], coarse[1]);
    assert!(fine[2] < 1e-3, "{:e}", fine[2]);
}

/// With memory, cells that fill or rupture make the moments of single steps jump.
#[test]
fn the_round_trip_closes_for_a_film_with_memory() {
    let [_, moments, positions] = round_trip(Cavitation::MassConserving, 240);
    assert!(moments < 0.01 * 7.0, "{moments} N m");
    assert!(positions < 2e-3, "{positions:e}");
}

/// What a film leaves out that takes a tilt to turn with the line of centres, as the paper's databases do: of the
/// force over itself, and of the moment over the force at half the width. The journal tilts freely under moments that
/// turn once and twice as fast as it does, of a tenth of its load at half the width.
#[test]
fn tilt_rates_that_are_left_out_cost_a_tenth_of_force_and_moment() {
    let bearing = bearing(Cavitation::Gumbel);
    let load = |angle: f64| [2500.0 + 800.0 * angle.cos(), 900.0 * angle.sin()];
    let moment = |angle: f64| [4.0 * angle.sin(), 2.0 * (2.0 * angle).cos()];
    let cycle = cycle(120, load, moment, CycleTilt::Free);
    let oil = Lubricant::constant(8e-3, 850.0);
    let mut on_line = OnlineFilm::new(&bearing, &oil).unwrap();
    let orbit = run(&mut on_line, &bearing, &cycle, OrbitStart::Equilibrium);
    assert_eq!(orbit.outcome, Outcome::Converged);
    let of = [
        left_out(&mut on_line, &bearing, &orbit),
        left_out(&mut film(&bearing), &bearing, &orbit),
    ];
    println!("force and moment, median and largest: {of:.3?}");
    for (one, other) in of[0].iter().zip(&of[1]) {
        assert!((0.03..0.2).contains(one), "{of:?}");
        assert!((one / other - 1.0).abs() < 0.1, "{of:?}");
    }
}

/// Median and largest of the force and of the moment that a film owes to its tilt rates along an orbit.
fn left_out(film: &mut dyn FilmForce, bearing: &Bearing, orbit: &JournalOrbit) -> [f64; 4] {
    let mut answer = |state: &JournalState| {
        let seen = film.linearise(state, Step::Steady, &CONDITIONS).unwrap();
        [seen.reaction.force(), seen.reaction.moment()]
    };
    let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let (mut forces, mut moments) = (Vec::new(), Vec::new());
    for point in &orbit.points[1..] {
        let state = point.state;
        let [[x, y], [u, v], [a, b]] = [state.position, state.velocity, state.tilt];
        let turning = (x * v - y * u) / (x * x + y * y);
        let whole = answer(&state);
        let left = answer(&JournalState {
            tilt_rate: [-turning * b, turning * a],
            ..state
        });
        let size = whole[0][0].hypot(whole[0][1]);
        forces.push(apart(whole[0], left[0]) / size);
        moments.push(apart(whole[1], left[1]) / (size * 0.5 * bearing.width));
    }
    forces.sort_by(f64::total_cmp);
    moments.sort_by(f64::total_cmp);
    let (half, last) = (forces.len() / 2, forces.len() - 1);
    [forces[half], forces[last], moments[half], moments[last]]
}

#[test]
fn a_film_without_tilt_refuses_cycles_that_tilt() {
    let bearing = bearing(Cavitation::Gumbel);
    let mut film = ShortBearingFilm::new(&bearing, 8e-3).unwrap();
    for tilt in [CycleTilt::Free, CycleTilt::Prescribed(vec![[1e-4, 0.0]])] {
        let tilted = cycle(1, |_| [500.0, 0.0], |_| [0.0; 2], tilt);
        let refused = journal_orbit(
            &mut film,
            &bearing,
            &tilted,
            &CONDITIONS,
            &OrbitSettings::default(),
            &mut |_, _, _| ControlFlow::Continue(()),
        );
        assert_eq!(refused.unwrap_err(), FilmError::NoTilt);
    }
}
