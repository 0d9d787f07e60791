//! Equilibrium and orbit over the film on a grid, whose cavitated set settles while the journal moves.
#![allow(clippy::unwrap_used)]

mod common;

use common::{CONDITIONS, diesel_big_end, diesel_cycle, plain_bearing, table};
use sommerfeld_bearing::{
    CycleTilt, EquilibriumRequest, EquilibriumSettings, LoadCycle, LoadPoint, OrbitSettings,
    find_equilibrium, journal_orbit,
};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Feed, FeedLine, FeedShape, FilmForce, FilmShear, FilmSolver,
    JournalState, Outcome,
};
use sommerfeld_oil::Lubricant;
use std::f64::consts::PI;
use std::ops::ControlFlow;

fn big_end(shape: FeedShape, carried_by: Carrier) -> Bearing {
    let mut bearing = plain_bearing(0.072, 0.030, 36e-6);
    bearing.cavitation = Cavitation::MassConserving;
    bearing.film_shear = FilmShear::FilmFraction;
    bearing.feeds.push(Feed {
        shape,
        carried_by,
        angle: 0.5 * PI,
        position: 0.0,
        pressure: 5e5,
        line: FeedLine::Direct,
    });
    bearing
}

/// Aligned and tilted by a moment: journal and cavitated set settle in one iteration.
#[test]
fn grooved_bearing_comes_to_rest() {
    let groove = FeedShape::Circumferential { width: 6e-3 };
    let bearing = big_end(groove, Carrier::Shell);
    let oil = Lubricant::constant(8e-3, 850.0);
    let mut film = FilmSolver::new(&bearing, &oil, [64, 20]).unwrap();
    for moment in [None, Some([1.0, 0.5]), Some([20.0, 10.0])] {
        let request = EquilibriumRequest {
            load: [0.0, -8000.0],
            moment,
            frame: JournalState {
                journal_speed: 209.4395,
                ..JournalState::default()
            },
            start: None,
            settings: EquilibriumSettings::default(),
        };
        let found = find_equilibrium(&mut film, &bearing, &request, &CONDITIONS).unwrap();
        assert_eq!(found.outcome, Outcome::Converged, "{:#?}", found.table);
        assert!(found.residual < 1e-9);
        assert!(found.iterations() <= 25, "{:#?}", found.table);
        let [fx, fy] = found.reaction.force();
        assert!(fx.abs() < 1e-4 && (fy - 8000.0).abs() < 1e-4);
        assert!(found.summary.mass_balance_relative < 1e-8);
    }
}

/// Oil from a hole in the journal: the film remembers, and every point converges.
#[test]
fn mass_conserving_big_end_runs_through_its_cycle() {
    let bearing = big_end(FeedShape::Hole { diameter: 6e-3 }, Carrier::Journal);
    let oil = Lubricant::constant(8e-3, 850.0);
    let mut film = FilmSolver::new(&bearing, &oil, [48, 8]).unwrap();
    let settings = OrbitSettings {
        crank_step: 2.0 * PI / 180.0,
        cycle_limit: 2,
        ..OrbitSettings::default()
    };
    let cycle = diesel_cycle();
    let mut fields = 0;
    let mut observer = |_: &_, film: &dyn FilmForce, _| {
        fields += usize::from(film.field().is_some());
        ControlFlow::Continue(())
    };
    let orbit = journal_orbit(
        &mut film,
        &bearing,
        &cycle,
        &CONDITIONS,
        &settings,
        &mut observer,
    )
    .unwrap();
    let end = orbit.points[orbit.points.len() - 1];
    assert_eq!(orbit.points.len(), 361, "{:?} {end:#?}", orbit.outcome);
    assert_eq!(fields, 721);
    assert!(orbit.points.iter().all(|p| p.outcome == Outcome::Converged));
    let worst = orbit
        .points
        .iter()
        .skip(1)
        .map(|point| point.summary.mass_balance_relative)
        .fold(0.0, f64::max);
    assert!(worst < 1e-7, "{worst:e}");
    assert!(orbit.film_solves < 15 * 2 * 360, "{}", orbit.film_solves);
}

/// The one-axis cycle with the finite film (validation/flores-2006/reference_finite.csv).
#[test]
fn finite_film_on_the_one_axis_cycle() {
    let mut bearing = plain_bearing(0.0635, 0.0254, 35.56e-6);
    bearing.cavitation = Cavitation::Reynolds;
    let speed = 2000.0 * PI / 30.0;
    let points = table("flores-2006/load.csv")
        .iter()
        .map(|row| LoadPoint {
            crank_angle: row[0].to_radians(),
            load: [row[1], 0.0],
            moment: [0.0; 2],
            journal_speed: 2.0 * speed,
            shell_speed: 0.0,
        })
        .collect();
    let cycle = LoadCycle {
        points,
        period: 4.0 * PI,
        engine_speed: speed,
        journal_mass: 0.0,
        tilt: CycleTilt::Aligned,
        feed_pressures: Vec::new(),
    };
    let oil = Lubricant::constant(0.00416, 850.0);
    let mut film = FilmSolver::new(&bearing, &oil, [64, 8]).unwrap();
    let settings = OrbitSettings {
        crank_step: 4.0 * PI / 180.0,
        error_tolerance: 1e-3,
        ..OrbitSettings::default()
    };
    let orbit = journal_orbit(
        &mut film,
        &bearing,
        &cycle,
        &CONDITIONS,
        &settings,
        &mut |_, _, _| ControlFlow::Continue(()),
    )
    .unwrap();
    assert_eq!(
        orbit.outcome,
        Outcome::Converged,
        "closure {}",
        orbit.closure
    );
    let reference = table("flores-2006/reference_finite.csv")
        .iter()
        .map(|row| row[row.len() - 1])
        .fold(f64::INFINITY, f64::min);
    let smallest = orbit.minimum_film_thickness().unwrap().0.value * 1e6;
    assert!(
        (smallest / reference - 1.0).abs() < 0.02,
        "{smallest} {reference}"
    );
}

/// Nothing to carry: the journal rests in the centre, where every pressure is zero and the film still
/// resists.
#[test]
fn an_unloaded_journal_rests_in_the_centre_of_a_film_on_a_grid() {
    for cavitation in [Cavitation::Gumbel, Cavitation::Reynolds] {
        let bearing = Bearing {
            cavitation,
            ..plain_bearing(0.072, 0.030, 36e-6)
        };
        let oil = Lubricant::constant(8e-3, 850.0);
        let request = EquilibriumRequest {
            load: [0.0; 2],
            moment: None,
            frame: JournalState {
                journal_speed: 209.0,
                ..JournalState::default()
            },
            start: None,
            settings: EquilibriumSettings::default(),
        };
        for make in [FilmSolver::new, FilmSolver::aligned] {
            let mut film = make(&bearing, &oil, [64, 16]).unwrap();
            let found = find_equilibrium(&mut film, &bearing, &request, &CONDITIONS).unwrap();
            assert_eq!(found.outcome, Outcome::Converged, "{cavitation:?}");
            let eccentricity = found.state.eccentricity();
            assert!(
                eccentricity < 1e-6 * bearing.radial_clearance,
                "{eccentricity:e}"
            );
        }
    }
}

/// Newton's last step counts by its square: against a rule a hundred times tighter the journal stays where
/// it was to the tolerance, through thin films and past the hole. Steps are equal, so that nothing else
/// differs.
#[test]
fn newton_keeps_the_journal_within_its_tolerance() {
    let bearing = diesel_big_end(Cavitation::Reynolds);
    let oil = Lubricant::constant(8e-3, 850.0);
    let cycle = diesel_cycle();
    let run = |newton_tolerance: f64| {
        let mut film = FilmSolver::aligned(&bearing, &oil, [64, 16]).unwrap();
        let settings = OrbitSettings {
            newton_tolerance,
            error_tolerance: 1.0,
            cycle_limit: 1,
            ..OrbitSettings::default()
        };
        let mut observer = |_: &_, _: &dyn FilmForce, _| ControlFlow::Continue(());
        journal_orbit(
            &mut film,
            &bearing,
            &cycle,
            &CONDITIONS,
            &settings,
            &mut observer,
        )
        .unwrap()
    };
    let tolerance = OrbitSettings::default().newton_tolerance;
    let (usual, tight) = (run(tolerance), run(0.01 * tolerance));
    assert_eq!(usual.steps, tight.steps);
    assert!(usual.film_solves < tight.film_solves);
    let mut worst = 0.0_f64;
    for (a, b) in usual.points.iter().zip(&tight.points).skip(1) {
        assert_eq!(a.outcome, Outcome::Converged);
        assert_eq!(
            a.summary.complementarity_violation, 0.0,
            "{}",
            a.crank_angle
        );
        let apart = [0, 1].map(|axis| a.state.position[axis] - b.state.position[axis]);
        let gap = b.summary.minimum_film_thickness.value;
        worst = worst.max(apart[0].hypot(apart[1]) / gap);
    }

    assert!(worst < tolerance, "{worst:e}");
}
