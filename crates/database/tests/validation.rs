//! Published and independently computed films, out of tables.
#![allow(clippy::panic, clippy::unwrap_used)]

mod common;

use common::{CONDITIONS, VISCOSITY, recipe, reference_rows, table, unit_bearing, unit_film};
use sommerfeld_database::{Recipe, TableFilm, generate};
use sommerfeld_film::dimensionless::{DimensionlessFilm, refine_dimensionless};
use sommerfeld_film::{Cavitation, FilmForce, Step};
use std::sync::Arc;

#[test]
fn combined_wedge_and_squeeze_within_a_fifth_of_a_percent() {
    let closure = Cavitation::Reynolds;
    let table = table(closure, 0.5, 1e-3);
    let rows = reference_rows("combined-wedge-squeeze");
    assert_eq!(rows.len(), 18);
    for row in rows {
        let [d_over_b, eps, squeeze, along, across] = row[..5] else {
            panic!("{row:?}")
        };
        let problem = DimensionlessFilm {
            relative_eccentricity: eps,
            squeeze,
            ..unit_film(closure, 1.0 / d_over_b)
        };
        let bearing = problem.bearing();
        let mut film = TableFilm::new(Arc::clone(&table), &bearing, VISCOSITY).unwrap();
        let seen = film
            .react(&problem.state(), Step::Steady, &CONDITIONS)
            .unwrap();
        let found = problem.integrals(&seen.reaction, &film.summary());
        let off = (found.p_cos - along).hypot(found.p_sin - across) / along.hypot(across);
        assert!(off < 2e-3, "{row:?}: {found:?}, off by {off:.1e}, bar 2e-3");
    }
}

#[test]
fn pure_squeeze_of_butenschoen() {
    let closure = Cavitation::Reynolds;
    let rows = reference_rows("butenschoen-squeeze");
    let mut compared = 0;
    for width_ratio in [1.0, 0.5, 0.25, 0.125] {
        // No row lies closer to contact.
        let recipe = Recipe {
            last_eccentricity: 0.991,
            ..recipe(closure, width_ratio, 4e-3)
        };
        let table = Arc::new(generate(&recipe, &(), None).unwrap());
        let bearing = unit_bearing(closure, width_ratio);
        let mut film = TableFilm::new(table, &bearing, VISCOSITY).unwrap();
        for row in rows.iter().filter(|row| row[0] == width_ratio) {
            let [_, signed, so, _] = row[..4] else {
                panic!("{row:?}")
            };
            let problem = DimensionlessFilm {
                relative_eccentricity: f64::abs(signed),
                wedge: 0.0,
                squeeze: signed.signum(),
                ..unit_film(closure, width_ratio)
            };
            let seen = film
                .react(&problem.state(), Step::Steady, &CONDITIONS)
                .unwrap();
            let found = problem.integrals(&seen.reaction, &film.summary());
            let found = 0.25 * found.p_cos.hypot(found.p_sin);
            let relative = if signed.abs() <= 0.97 { 0.005 } else { 0.01 };
            let bar = (relative * so).max(0.5e-4);
            assert!(
                (found - so).abs() <= bar,
                "{row:?}: So {found}, bar {bar:.1e}"
            );
            compared += 1;
        }
    }
    assert_eq!(compared, rows.len());
}

/// The grid solver of `sommerfeld-film`, with its own error bar, knows nothing of the table's solver.
#[test]
fn films_on_a_grid_agree() {
    for closure in [Cavitation::Gumbel, Cavitation::Reynolds] {
        let table = table(closure, 0.4, 1e-3);
        for (eps, wedge, squeeze) in [(0.5, 1.0, 0.1), (0.9, -1.0, 0.05), (0.9, 1.0, -0.15)] {
            let problem = DimensionlessFilm {
                relative_eccentricity: eps,
                wedge,
                squeeze,
                ..unit_film(closure, 0.4)
            };
            let grid = refine_dimensionless(&problem, [64, 16], 1e-3).unwrap();
            assert!(grid.reached, "{problem:?}");
            let mut film =
                TableFilm::new(Arc::clone(&table), &problem.bearing(), VISCOSITY).unwrap();
            let seen = film
                .react(&problem.state(), Step::Steady, &CONDITIONS)
                .unwrap();
            let found = problem.integrals(&seen.reaction, &film.summary());
            let on = &grid.integrals;
            let size = on.p_cos.hypot(on.p_sin);
            let off = (found.p_cos - on.p_cos).hypot(found.p_sin - on.p_sin) / size;
            assert!(off < 2e-3, "{problem:?}: {off:.1e}");
            assert!(
                (found.peak / on.peak - 1.0).abs() < 0.01,
                "{problem:?}: peak {} {}",
                found.peak,
                on.peak
            );
            let here = film.summary();
            let place = here.peak_film_pressure;
            assert!(place.angle.abs() < std::f64::consts::PI && place.axial == 0.0);
        }
    }
}
