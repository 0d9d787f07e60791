//! The effective temperature of the bearing of `validation/heat-balance`.
#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use sommerfeld_bearing::{
    EquilibriumRequest, EquilibriumSettings, FilmHeat, HeatPath, find_equilibrium,
};
use sommerfeld_film::{
    Bearing, Cavitation, Conditions, Ends, FilmError, FilmShear, FilmSolver, Inlet, JournalState,
    Outcome, Shape,
};
use sommerfeld_oil::{DensityLaw, Lubricant, ViscosityLaw};
use std::f64::consts::PI;

const KELVIN: f64 = 273.15;

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

#[test]
fn the_reference_bearing_runs_at_its_effective_temperature() {
    let oil = Lubricant {
        viscosity: ViscosityLaw::Vogel {
            a: 1.3e-4,
            b: 900.0,
            c: 110.0 - KELVIN,
        },
        density: DensityLaw::Constant { density: 900.0 },
    };
    let bearing = bearing();
    let mut film = FilmSolver::following(&bearing, &oil, [192, 48], 0.6).unwrap();
    let speed = 2000.0 * PI / 30.0;
    let request = EquilibriumRequest {
        load: [36e3, 0.0],
        moment: None,
        frame: JournalState {
            journal_speed: speed,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings::default(),
    };
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
    let effective = found.effective_temperature - KELVIN;
    let outlet = found.outlet_temperature - KELVIN;
    let flow = rest.summary.side_flow[0] + rest.summary.side_flow[1];
    let film = rest.summary.minimum_film_thickness.value;
    println!(
        "T_eff {effective:.3} T_out {outlet:.3} P {:.2} W Q {:.5e} h {:.3} um, {} trials",
        rest.summary.power_loss(),
        flow,
        1e6 * film,
        found.trials.len()
    );
    assert!((effective - 69.74).abs() < 0.3, "{effective}");
    assert!((outlet - 81.49).abs() < 0.3, "{outlet}");
    assert!((rest.summary.power_loss() / 1733.0 - 1.0).abs() < 0.01);
    assert!((flow / 4.099e-5 - 1.0).abs() < 0.01);
    assert!((film / 14.24e-6 - 1.0).abs() < 0.01);
}
