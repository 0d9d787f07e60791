//! Bearings at rest on shells that give way by many times their film are found, under light loads and heavy
//! ones, with fast journals and slow ones.
#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod common;

use common::{CONDITIONS, greenwood_tripp, plain_bearing, rig_finish};
use sommerfeld_bearing::{Equilibrium, EquilibriumRequest, EquilibriumSettings, find_equilibrium};
use sommerfeld_film::{
    Bearing, Cavitation, Elasticity, Ends, FilmShear, FilmSolver, JournalState, Outcome,
};
use sommerfeld_oil::{Lubricant, PressureLaw};
use std::f64::consts::PI;

/// N, and 1/min.
const LOADS: [f64; 3] = [2e3, 8e3, 20e3];
const SPEEDS: [f64; 4] = [3000.0, 1000.0, 300.0, 100.0];

/// Film updates of the longest search: by raising the load.
const MOST_UPDATES: usize = 600;

fn bearing(thickness: f64, cavitation: Cavitation) -> Bearing {
    Bearing {
        cavitation,
        film_shear: FilmShear::FullWidth,
        ends: Ends::Flooded,
        ambient_pressure: 1e5,
        elasticity: Elasticity::Layer {
            thickness,
            modulus: 70e9,
            poisson: 0.33,
        },
        ..plain_bearing(47.8e-3, 17.2e-3, 23.9e-6)
    }
}

fn rest(bearing: &Bearing, oil: &Lubricant, load: f64, speed: f64) -> Equilibrium {
    let mut film = FilmSolver::aligned(bearing, oil, [64, 16]).unwrap();
    let request = EquilibriumRequest {
        load: [load, 0.0],
        moment: None,
        frame: JournalState {
            journal_speed: speed * PI / 30.0,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings::default(),
    };
    find_equilibrium(&mut film, bearing, &request, &CONDITIONS).unwrap()
}

#[test]
fn rest_on_a_soft_shell_is_found() {
    let plain = Lubricant::constant(6.8e-3, 832.5);
    let thickening = Lubricant {
        viscosity_pressure: PressureLaw::Roelands {
            alpha: 12e-9,
            temperature: Default::default(),
        },
        ..plain.clone()
    };
    let mut lost = Vec::new();
    for thickness in [2e-3, 10e-3] {
        for cavitation in [Cavitation::Reynolds, Cavitation::MassConserving] {
            for (name, oil, rough) in [
                ("smooth", &plain, false),
                ("rough", &plain, true),
                ("rough, thickening", &thickening, true),
            ] {
                let mut bearing = bearing(thickness, cavitation);
                if rough {
                    bearing.finish = rig_finish(greenwood_tripp(1e-3));
                }
                for load in LOADS {
                    for speed in SPEEDS {
                        let found = rest(&bearing, oil, load, speed);
                        println!(
                            "{thickness} {cavitation:?} {name} {load} {speed}: {:?} {} updates, {:.2} um",
                            found.outcome,
                            found.film_updates,
                            1e6 * found.summary.minimum_film_thickness.value
                        );
                        assert!(found.film_updates <= MOST_UPDATES, "{}", found.film_updates);
                        if found.outcome != Outcome::Converged {
                            lost.push(format!(
                                "{thickness} {cavitation:?} {name} {load} {speed} {:?}",
                                found.outcome
                            ));
                        }
                    }
                }
            }
        }
    }
    assert!(lost.is_empty(), "{}:\n{}", lost.len(), lost.join("\n"));
}
