//! Supply pressures over the crank angle reach the film of the orbit.
#![allow(clippy::unwrap_used)]

mod common;

use common::{CONDITIONS, plain_bearing};
use sommerfeld_bearing::{
    CycleTilt, JournalOrbit, LoadCycle, LoadPoint, OrbitSettings, PressureCycle, journal_orbit,
};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Feed, FeedFlow, FeedLine, FeedShape, FilmError, FilmShear,
    FilmSolver,
};
use sommerfeld_oil::Lubricant;
use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

const GROOVE: f64 = 6e-3;
const VISCOSITY: f64 = 8e-3;

fn main_bearing(pressure: f64) -> Bearing {
    let mut bearing = plain_bearing(0.072, 0.030, 36e-6);
    bearing.cavitation = Cavitation::MassConserving;
    bearing.film_shear = FilmShear::FilmFraction;
    bearing.feeds.push(Feed {
        shape: FeedShape::Circumferential { width: GROOVE },
        carried_by: Carrier::Shell,
        angle: 0.0,
        position: 0.0,
        pressure,
        line: FeedLine::Direct,
    });
    bearing
}

/// A load that turns with half the amplitude of its constant part.
fn cycle(feed_pressures: Vec<PressureCycle>) -> LoadCycle {
    let points = (0..36).map(|row| {
        let crank_angle = f64::from(row) * TAU / 36.0;
        let (sin, cos) = crank_angle.sin_cos();
        LoadPoint {
            crank_angle,
            load: [3000.0 + 1500.0 * cos, 1500.0 * sin],
            moment: [0.0; 2],
            journal_speed: 200.0,
            shell_speed: 0.0,
        }
    });
    LoadCycle {
        points: points.collect(),
        period: TAU,
        engine_speed: 200.0,
        journal_mass: 0.0,
        tilt: CycleTilt::Aligned,
        feed_pressures,
    }
}

fn run(
    bearing: &Bearing,
    cycle: &LoadCycle,
) -> Result<(JournalOrbit, Vec<(f64, FeedFlow)>), FilmError> {
    let oil = Lubricant::constant(VISCOSITY, 850.0);
    let mut film = FilmSolver::new(bearing, &oil, [48, 10]).unwrap();
    let settings = OrbitSettings {
        crank_step: 5.0 * PI / 180.0,
        cycle_limit: 3,
        ..OrbitSettings::default()
    };
    let mut feeds = Vec::new();
    let orbit = journal_orbit(
        &mut film,
        bearing,
        cycle,
        &CONDITIONS,
        &settings,
        &mut |point, film, _| {
            feeds.push((point.crank_angle, film.feed_flows()[0]));
            ControlFlow::Continue(())
        },
    )?;
    Ok((orbit, feeds))
}

fn table(points: Vec<[f64; 2]>) -> Vec<PressureCycle> {
    vec![PressureCycle { feed: 0, points }]
}

/// Every point sees the pressure of its own crank angle, and the side flow follows it: over the lands
/// the mean of h^3 p around and over a closed cycle falls in a straight line, whatever load and speed.
#[test]
fn every_crank_angle_has_its_pressure() {
    let rows: Vec<[f64; 2]> = (0..24)
        .map(|row| f64::from(row) * TAU / 24.0)
        .map(|angle| [angle, 4e5 + 2e5 * (2.0 * angle).sin()])
        .collect();
    let cycle = cycle(table(rows));
    let bearing = main_bearing(4e5);
    let (orbit, feeds) = run(&bearing, &cycle).unwrap();
    let supply = |angle: f64| cycle.feed_pressures[0].at(angle, TAU);
    for (angle, feed) in &feeds {
        let due = supply(*angle);
        assert!(
            (feed.pressure / due - 1.0).abs() < 1e-9,
            "{angle} {feed:?} {due}"
        );
    }
    let c = bearing.radial_clearance;
    let land = 0.5 * (bearing.width - GROOVE);
    let conducts = 2.0 * PI * bearing.diameter * c.powi(3) / (12.0 * VISCOSITY * land);
    let exact = orbit.mean(|point| {
        let eps = point.state.eccentricity() / c;
        conducts * (1.0 + 1.5 * eps * eps) * supply(point.crank_angle)
    });
    let deviation = orbit.mean_side_flow() / exact - 1.0;
    println!(
        "mean side flow: {deviation:e} of 1e-4, closure {:e}",
        orbit.closure
    );
    assert!(deviation.abs() < 1e-4, "{deviation:e}");
    // It is no coincidence of means: the constant pressure gives another flow.
    let (constant, _) = run(&bearing, &self::cycle(Vec::new())).unwrap();
    let change = constant.mean_side_flow() / orbit.mean_side_flow() - 1.0;
    assert!(change.abs() > 1e-3, "{change:e}");
}

/// A table of equal rows is the constant pressure.
#[test]
fn a_constant_table_changes_nothing() {
    let constant = run(&main_bearing(4e5), &cycle(Vec::new())).unwrap();
    let tabled = run(
        &main_bearing(1e5),
        &cycle(table(vec![[0.0, 4e5], [2.0, 4e5]])),
    )
    .unwrap();
    assert_eq!(constant.0.points, tabled.0.points);
    assert_eq!(constant.1, tabled.1);
}

#[test]
fn a_table_without_its_feed_is_refused() {
    let points = vec![[0.0, 4e5]];
    let tables = vec![PressureCycle { feed: 1, points }];
    assert!(run(&main_bearing(4e5), &cycle(tables)).is_err());
}
