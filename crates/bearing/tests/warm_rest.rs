//! Temperatures of a film at rest: what they cost, and that how they are found does not matter.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "tests stop at the first surprise"
)]

mod common;

use common::{CONDITIONS, diesel_big_end, greenwood_tripp, rig_finish};
use sommerfeld_bearing::{
    Equilibrium, EquilibriumRequest, EquilibriumSettings, HeatFieldSettings, WarmEquilibrium,
    find_equilibrium, warm_equilibrium,
};
use sommerfeld_film::{
    Bearing, Cavitation, FilmForce, FilmSolver, JournalState, Outcome, Surroundings,
};
use sommerfeld_oil::{DensityLaw, Lubricant, ViscosityLaw};

const SUPPLY: [f64; 1] = [CONDITIONS.temperature];
const GRID: [usize; 2] = [64, 16];

fn oil() -> Lubricant {
    let viscosity = ViscosityLaw::Vogel {
        a: 1.3e-4,
        b: 900.0,
        c: 110.0 - 273.15,
    };
    Lubricant::newtonian(viscosity, DensityLaw::Constant { density: 850.0 })
}

/// Walls that take heat (W/(m2 K)), or none.
fn surroundings(wall: f64) -> Surroundings<'static> {
    Surroundings {
        volumetric_heat: 1.8e6,
        supply: &SUPPLY,
        ambient: SUPPLY[0],
        carry_over: 1.0,
        wall: (wall, SUPPLY[0]),
    }
}

fn request(load: [f64; 2]) -> EquilibriumRequest {
    EquilibriumRequest {
        load,
        moment: None,
        frame: JournalState {
            journal_speed: 209.0,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings::default(),
    }
}

struct Case {
    name: &'static str,
    bearing: Bearing,
    wall: f64,
    load: [f64; 2],
}

fn cases() -> Vec<Case> {
    let conserving = diesel_big_end(Cavitation::MassConserving);
    let rough = Bearing {
        finish: rig_finish(greenwood_tripp(1e-3)),
        ..conserving.clone()
    };
    let case = |name, bearing: &Bearing, wall, load| Case {
        name,
        bearing: bearing.clone(),
        wall,
        load,
    };
    vec![
        case("adiabatic", &conserving, 0.0, [12e3, 0.0]),
        case("walls", &conserving, 3000.0, [12e3, 0.0]),
        case("light", &conserving, 0.0, [1e3, 500.0]),
        case(
            "reynolds",
            &diesel_big_end(Cavitation::Reynolds),
            0.0,
            [12e3, 0.0],
        ),
        case("contact", &rough, 3000.0, [20e3, 0.0]),
    ]
}

fn isothermal(case: &Case) -> Equilibrium {
    let mut film = FilmSolver::aligned(&case.bearing, &oil(), GRID).unwrap();
    let request = request(case.load);
    find_equilibrium(&mut film, &case.bearing, &request, &CONDITIONS).unwrap()
}

fn warm(case: &Case, settings: &HeatFieldSettings) -> WarmEquilibrium {
    let mut film = FilmSolver::aligned(&case.bearing, &oil(), GRID).unwrap();
    warm_equilibrium(
        &mut film,
        &case.bearing,
        &request(case.load),
        &CONDITIONS,
        &surroundings(case.wall),
        settings,
    )
    .unwrap()
}

/// Equilibrium and energy equation in turn, a share of each change at a time: nothing is foreseen, mixed or
/// begun on a coarser grid.
fn slowly(case: &Case, tolerance: f64, share: f64) -> (Equilibrium, f64, f64) {
    let mut film = FilmSolver::aligned(&case.bearing, &oil(), GRID).unwrap();
    let mut request = request(case.load);
    for _ in 0..200 {
        let rest = find_equilibrium(&mut film, &case.bearing, &request, &CONDITIONS).unwrap();
        assert_eq!(rest.outcome, Outcome::Converged);
        film.account_heat(1.0);
        let warming = film.led_to(&surroundings(case.wall), false).unwrap();
        if warming.warmed.change <= tolerance {
            return (rest, warming.warmed.hottest, warming.warmed.mean);
        }
        let both = warming.from.iter().zip(&warming.led_to);
        let next: Vec<f64> = both.map(|(from, to)| from + share * (to - from)).collect();
        film.warm(&next);
        request.start = Some(rest.state.position);
    }
    panic!("{} does not settle", case.name);
}

/// Slow rounds and fast ones end at the same film, and none of its cells was left out.
#[test]
fn fast_rounds_find_what_slow_ones_find() {
    for case in cases() {
        let tolerance = 1e-4;
        let settings = HeatFieldSettings {
            tolerance,
            ..HeatFieldSettings::default()
        };
        let fast = warm(&case, &settings);
        assert_eq!(fast.outcome, Outcome::Converged, "{}", case.name);
        assert!(fast.warmed.balance.relative_error() < 1e-10);
        let (slow, hottest, mean) = slowly(&case, tolerance, 1.0 / 3.0);
        let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let moved = apart(fast.rest.state.position, slow.state.position);
        let moved = moved / slow.summary.minimum_film_thickness.value;
        println!(
            "{}: hottest {} {hottest}, mean {} {mean}, journal {moved:e} of the gap apart, {} updates",
            case.name, fast.warmed.hottest, fast.warmed.mean, fast.film_updates
        );
        // A change that is left out stands for two or three times the error.
        assert!((fast.warmed.hottest - hottest).abs() < 5.0 * tolerance);
        assert!((fast.warmed.mean - mean).abs() < 5.0 * tolerance);
        assert!(moved < 5.0 * tolerance * 0.03, "{}: {moved:e}", case.name);
    }
}

/// A temperature for each cell costs less than three times the film updates of one for all, as a rule about
/// as many.
#[test]
fn temperatures_cost_few_film_updates() {
    for case in cases() {
        let one = isothermal(&case).film_updates;
        let found = warm(&case, &HeatFieldSettings::default());
        println!(
            "{}: one temperature {one}, a field {} in {} rounds {:?}",
            case.name,
            found.film_updates,
            found.changes.len(),
            found.changes
        );
        assert_eq!(found.outcome, Outcome::Converged, "{}", case.name);
        assert!(found.film_updates <= 3 * one, "{}", case.name);
    }
}

/// Heavy loads without walls that take heat: oil turns round at the edge of the ruptured film, where cells are fed
/// now from one side, now from the other. There is a film whose heat its oil carries away, and it is found.
#[test]
fn heavily_loaded_adiabatic_films_settle() {
    let bearing = diesel_big_end(Cavitation::MassConserving);
    for load in [30e3, 60e3] {
        let case = Case {
            name: "heavy",
            bearing: bearing.clone(),
            wall: 0.0,
            load: [load, 0.0],
        };
        let found = warm(&case, &HeatFieldSettings::default());
        println!(
            "{load}: {} rounds, {} updates, hottest {}, outlet {}, {:?}",
            found.changes.len(),
            found.film_updates,
            found.warmed.hottest,
            found.warmed.outlet,
            found.warmed.balance
        );
        assert_eq!(found.outcome, Outcome::Converged, "{load}");
        let balance = found.warmed.balance;
        assert!(balance.relative_error() < 1e-10);
        assert!((balance.carried_out / balance.generated - 1.0).abs() < 1e-10);
        if load == 30e3 {
            let (_, hottest, mean) = slowly(&case, 1e-3, 0.1);
            assert!((found.warmed.hottest - hottest).abs() < 0.02, "{hottest}");
            assert!((found.warmed.mean - mean).abs() < 0.02, "{mean}");
        }
    }
}
