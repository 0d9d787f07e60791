//! The effective temperature of the bearing of `validation/heat-balance`.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "tests stop at the first surprise"
)]

mod common;

use common::text_table;
use sommerfeld_bearing::{
    EquilibriumRequest, EquilibriumSettings, FilmHeat, HeatFieldSettings, HeatPath,
    find_equilibrium, warm_equilibrium,
};
use sommerfeld_film::{
    Bearing, Cavitation, Conditions, Ends, FilmError, FilmForce, FilmShear, FilmSolver, Inlet,
    JournalState, Outcome, Shape, Surroundings,
};
use sommerfeld_oil::{DensityLaw, Lubricant, ViscosityLaw};
use std::f64::consts::PI;

const KELVIN: f64 = 273.15;
const GRID: [usize; 2] = [192, 48];

fn bearing() -> Bearing {
    Bearing {
        diameter: 0.12,
        width: 0.06,
        radial_clearance: 0.06 * 1.2e-3,
        bore: Shape::default(),
        journal: Shape::default(),
        feeds: Vec::new(),
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Flooded,
        inlet: Inlet::MaxFilmLine { pressure: 0.0 },
        cavitation: Cavitation::Reynolds,
        film_shear: FilmShear::FullWidth,
        finish: sommerfeld_film::Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
    }
}

fn oil() -> Lubricant {
    let viscosity = ViscosityLaw::Vogel {
        a: 1.3e-4,
        b: 900.0,
        c: 110.0 - KELVIN,
    };
    Lubricant::newtonian(viscosity, DensityLaw::Constant { density: 900.0 })
}

fn request() -> EquilibriumRequest {
    EquilibriumRequest {
        load: [36e3, 0.0],
        moment: None,
        frame: JournalState {
            journal_speed: 2000.0 * PI / 30.0,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings::default(),
    }
}

#[test]
fn the_reference_bearing_runs_at_its_effective_temperature() {
    let oil = oil();
    let bearing = bearing();
    let mut film = FilmSolver::following(&bearing, &oil, GRID, 0.6).unwrap();
    let request = request();
    let path = HeatPath {
        supply_temperature: KELVIN + 58.0,
        conductance: 0.0,
        surroundings_temperature: KELVIN + 20.0,
        outlet_weight: 0.5,
    };
    let found = path
        .balance::<_, FilmError>([KELVIN, KELVIN + 200.0], |temperature| {
            let conditions = Conditions {
                temperature,
                feed_pressures: None,
            };
            let rest = find_equilibrium(&mut film, &bearing, &request, &conditions)?;
            let heat = FilmHeat {
                power: rest.summary.power_loss(),
                side_flow: rest.summary.side_flow[0] + rest.summary.side_flow[1],
                volumetric_heat: 1.8e6,
                outcome: rest.outcome,
            };
            Ok((rest, heat))
        })
        .unwrap();
    assert_eq!(found.outcome, Outcome::Converged);
    let rest = &found.solution;
    let summary = rest.summary;
    // The same bearing at its temperature, sheared in the ruptured film as its film fraction is, which only
    // a film that conserves mass knows.
    let weighted = Bearing {
        cavitation: Cavitation::MassConserving,
        film_shear: FilmShear::FilmFraction,
        ..bearing.clone()
    };
    let mut thin = FilmSolver::following(&weighted, &oil, GRID, 0.6).unwrap();
    let conditions = Conditions {
        temperature: found.effective_temperature,
        feed_pressures: None,
    };
    let weighted = find_equilibrium(&mut thin, &weighted, &request, &conditions).unwrap();
    let (load, speed) = (request.load[0], request.frame.journal_speed);
    let viscosity = oil.viscosity(found.effective_temperature, 0.0).value;
    let sommerfeld = load * bearing.relative_clearance().powi(2)
        / (bearing.diameter * bearing.width * viscosity * speed);
    for row in text_table("heat-balance/reference.csv") {
        let found = match row[0].as_str() {
            "effective_temperature[C]" => found.effective_temperature - KELVIN,
            "outlet_temperature[C]" => found.outlet_temperature - KELVIN,
            "sommerfeld_number[-]" => sommerfeld,
            "relative_eccentricity[-]" => rest.state.eccentricity() / bearing.radial_clearance,
            "attitude_angle[deg]" => rest.attitude_angle(request.load).to_degrees(),
            "power_journal_full_width[W]" => summary.friction_power,
            "power_journal_film_fraction[W]" => weighted.summary.friction_power,
            "power_shell[W]" => rest.reaction.friction_torque_shell * speed,
            "side_flow[m3/s]" => summary.side_flow[0] + summary.side_flow[1],
            "minimum_film[um]" => 1e6 * summary.minimum_film_thickness.value,
            other => panic!("{other}"),
        };
        let [expected, bar] = [1, 2].map(|column| row[column].parse::<f64>().unwrap());
        println!("{}: {found:.6e}, reference {expected:e} +- {bar:e}", row[0]);
        assert!(
            (found - expected).abs() <= bar,
            "{}: {found}, not {expected} +- {bar}",
            row[0]
        );
    }
}

/// The temperatures of the film balance their heat, and what leaves is as much warmer as the heat balance
/// says.
#[test]
fn the_field_of_temperature_agrees_with_the_heat_balance() {
    let (bearing, oil) = (bearing(), oil());
    let mut film = FilmSolver::following(&bearing, &oil, [128, 32], 0.6).unwrap();
    let supply = [KELVIN + 58.0];
    let surroundings = Surroundings {
        volumetric_heat: 1.8e6,
        supply: &supply,
        ambient: supply[0],
        carry_over: 1.0,
        wall: (0.0, supply[0]),
    };
    let conditions = Conditions {
        temperature: KELVIN + 69.74,
        feed_pressures: None,
    };
    let found = warm_equilibrium(
        &mut film,
        &bearing,
        &request(),
        &conditions,
        &surroundings,
        &HeatFieldSettings::default(),
    )
    .unwrap();
    let warmed = found.warmed;
    assert_eq!(found.outcome, Outcome::Converged);
    assert!(warmed.balance.relative_error() < 1e-8);
    // The cells' heat is the film's power, and all of it leaves with the oil at the sides.
    let summary = found.rest.summary;
    let power = summary.power_loss();
    assert!((warmed.balance.generated / power - 1.0).abs() < 1e-9);
    let flow = summary.side_flow[0] + summary.side_flow[1];
    let rise = warmed.outlet - supply[0];
    let by_balance = power / (surroundings.volumetric_heat * flow);
    // Within what the last round still changed.
    assert!(
        (rise / by_balance - 1.0).abs() < 1e-3,
        "{rise} {by_balance}"
    );
    // Oil that comes round again warms the inlet: hotter than one temperature for all, and less power.
    assert!(warmed.mean > KELVIN + 69.74 && power < 1733.0);
    assert!(warmed.hottest < KELVIN + 130.0);
}

/// Where one temperature sets the viscosity everywhere, the equation of the film's temperature leads the
/// oil out as warm as the reference's heat balance says.
#[test]
fn the_field_of_an_oil_at_one_temperature_leaves_as_warm_as_the_reference() {
    let (bearing, oil) = (bearing(), oil());
    let rows = text_table("heat-balance/reference.csv");
    let stated = |name: &str| -> f64 {
        let row = rows.iter().find(|row| row[0] == name).unwrap();
        row[1].parse().unwrap()
    };
    let mut film = FilmSolver::following(&bearing, &oil, GRID, 0.6).unwrap();
    let conditions = Conditions {
        temperature: KELVIN + stated("effective_temperature[C]"),
        feed_pressures: None,
    };
    let rest = find_equilibrium(&mut film, &bearing, &request(), &conditions).unwrap();
    assert_eq!(rest.outcome, Outcome::Converged);
    film.account_heat(1.0);
    let supply = [KELVIN + 58.0];
    let surroundings = Surroundings {
        volumetric_heat: 1.8e6,
        supply: &supply,
        ambient: supply[0],
        carry_over: 1.0,
        wall: (0.0, supply[0]),
    };
    let warmed = film.led_to(&surroundings, false).unwrap().warmed;
    let rise = warmed.outlet - supply[0];
    let expected = stated("outlet_temperature[C]") - 58.0;
    println!("rise at the sides {rise:.3} K, heat balance {expected:.3} K");
    assert!((rise / expected - 1.0).abs() < 0.02, "{rise} {expected}");
}
