//! A rigid bearing on an oil that stiffens and is compressed, beside read-off mid-plane pressures
//! (`validation/comsol-ehl`).
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests stop at the first surprise"
)]

mod common;

use common::{plain_bearing, table};
use sommerfeld_bearing::{Equilibrium, EquilibriumRequest, EquilibriumSettings, find_equilibrium};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Conditions, Feed, FeedLine, FeedShape, FilmField, FilmForce,
    FilmShear, FilmSolver, JournalState, Outcome,
};
use sommerfeld_oil::{CompressionLaw, Lubricant, PressureLaw};
use std::f64::consts::{PI, TAU};

const LOAD: f64 = 40e3;
const CELLS: [usize; 2] = [180, 17];

/// Pressures over that of the ruptured film, which the source takes as zero; angles from +X, the load
/// along -Y.
fn bearing() -> Bearing {
    let slot = |angle| Feed {
        shape: FeedShape::Rectangle {
            length: 10e-3,
            width: 67e-3,
        },
        carried_by: Carrier::Shell,
        angle,
        position: 0.0,
        pressure: 2e5,
        line: FeedLine::Direct,
    };
    Bearing {
        ambient_pressure: 100.0,
        cavitation: Cavitation::MassConserving,
        film_shear: FilmShear::FilmFraction,
        feeds: vec![slot(0.0), slot(PI)],
        ..plain_bearing(0.2004, 0.067, 200e-6)
    }
}

fn oil() -> Lubricant {
    Lubricant {
        viscosity_pressure: PressureLaw::Barus { alpha: 25e-9 },
        density_pressure: CompressionLaw::DowsonHigginson,
        ..Lubricant::constant(0.075, 850.0)
    }
}

/// At rest under the load, with the solved film.
fn rest(rpm: f64, cells: [usize; 2]) -> (FilmSolver, Equilibrium) {
    let bearing = bearing();
    let mut film = FilmSolver::new(&bearing, &oil(), cells).unwrap();
    let request = EquilibriumRequest {
        load: [0.0, -LOAD],
        moment: None,
        frame: JournalState {
            journal_speed: rpm * PI / 30.0,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings::default(),
    };
    let conditions = Conditions {
        temperature: 300.0,
        feed_pressures: None,
    };
    let rest = find_equilibrium(&mut film, &bearing, &request, &conditions).unwrap();
    assert_eq!(rest.outcome, Outcome::Converged, "{rpm} 1/min");
    (film, rest)
}

/// Pressure in the mid-plane, Pa, linear between the cells of the middle row.
fn mid_plane(field: &FilmField<'_>, degrees: f64) -> f64 {
    let (n, m) = (field.angles.len(), field.axial.len());
    assert_eq!(m % 2, 1);
    let angle = degrees.to_radians().rem_euclid(TAU);
    let behind = field.angles.partition_point(|a| *a <= angle);
    let (a, b) = ((behind + n - 1) % n, behind % n);
    let span = (field.angles[b] - field.angles[a]).rem_euclid(TAU);
    let share = (angle - field.angles[a]).rem_euclid(TAU) / span;
    let at = |i: usize| field.pressure[i * m + m / 2];
    at(a) + share * (at(b) - at(a))
}

/// The figures of the page, on its grid.
#[test]
fn equilibria_and_mid_plane_pressures_are_those_of_the_page() {
    let pressures = table("comsol-ehl/computed.csv");
    assert_eq!(pressures.len(), table("comsol-ehl/reference.csv").len());
    for row in table("comsol-ehl/equilibria.csv") {
        let [rpm, eps, attitude, film_um, peak] = [0, 1, 2, 3, 4].map(|k| row[k]);
        let (film, rest) = rest(rpm, CELLS);
        let [x, y] = rest.state.position;
        let got = [
            x.hypot(y) / 200e-6,
            rest.attitude_angle([0.0, -LOAD]).to_degrees(),
            1e6 * rest.summary.minimum_film_thickness.value,
            1e-5 * rest.summary.peak_film_pressure.value,
        ];
        println!("{rpm} {got:.4?}");
        let due = [eps, attitude, film_um, peak];
        // Half a last digit of the table.
        for (got, (due, digit)) in got.iter().zip(due.iter().zip([1e-4, 1e-2, 1e-3, 1e-1])) {
            assert!((got - due).abs() <= 0.51 * digit, "{rpm}: {got}, {due}");
        }
        let field = film.field().unwrap();
        for row in pressures.iter().filter(|row| row[0] == rpm) {
            let pressure = 1e-5 * mid_plane(&field, row[1]);
            println!("{rpm},{},{pressure:.2}", row[1]);
            assert!((pressure - row[2]).abs() <= 0.0051, "{row:?}: {pressure}");
        }
    }
}

/// Every read-off point but one lies within what the source of the points allows: 7 % of the highest
/// pressure, after a shift of at most 5 deg. The one is the end of the film at 100 1/min.
#[test]
fn read_off_pressures_are_met_but_for_the_end_of_the_slow_film() {
    for rpm in [100.0, 10000.0] {
        let (film, rest) = rest(rpm, CELLS);
        let field = film.field().unwrap();
        let allowed = 0.07 * rest.summary.peak_film_pressure.value;
        let mut missed = Vec::new();
        for row in table("comsol-ehl/reference.csv") {
            if row[0] != rpm {
                continue;
            }
            let meets = (-50..=50).any(|tenth| {
                let pressure = mid_plane(&field, row[1] + 0.1 * f64::from(tenth));
                (pressure - 1e5 * row[2]).abs() <= allowed
            });
            if !meets {
                missed.push(row[1]);
            }
        }
        let expected: &[f64] = if rpm == 100.0 { &[282.0] } else { &[] };
        assert_eq!(missed, expected, "{rpm} 1/min");
    }
}

/// The reduced pressure of the oil is bounded by 1/alpha; no speed of the source asks for more, down to a
/// twentieth of the slowest.
#[test]
fn no_speed_is_beyond_the_limit_of_the_oil() {
    for (rpm, least) in [(100.0, 0.4), (20.0, 0.6), (5.0, 0.75)] {
        let (_, rest) = rest(rpm, [120, 13]);
        let reduced = 1.0 - (-25e-9 * rest.summary.peak_film_pressure.value).exp();
        assert!(reduced > least && reduced < 1.0, "{rpm}: {reduced}");
    }
}

/// Twice the cells move the highest pressure by less than a percent.
#[test]
fn the_grid_of_the_page_is_fine_enough() {
    for rpm in [100.0, 10000.0] {
        let peak = |cells| rest(rpm, cells).1.summary.peak_film_pressure.value;
        let change = peak([90, 9]) / peak(CELLS) - 1.0;
        // Second order: what is left is a third of this.
        assert!(change.abs() < 0.02, "{rpm}: {change}");
    }
}
