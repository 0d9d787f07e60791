//! Where roughness, contact and the oil's answer to pressure vanish, bearings are hydrodynamic: at rest
//! and over a load cycle, with every closure.
#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod common;

use common::{CONDITIONS, diesel_big_end, diesel_cycle, greenwood_tripp, plain_bearing};
use sommerfeld_bearing::{
    Equilibrium, EquilibriumRequest, EquilibriumSettings, JournalOrbit, OrbitSettings,
    find_equilibrium, journal_orbit,
};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, ContactLaw, Feed, FeedLine, FeedShape, FilmShear, FilmSolver,
    Finish, GreenwoodTripp, JournalState, Outcome, RoughFinish, Roughness,
};
use sommerfeld_oil::{CompressionLaw, Lubricant, PressureLaw};
use std::ops::ControlFlow;

const CLOSURES: [Cavitation; 3] = [
    Cavitation::Gumbel,
    Cavitation::Reynolds,
    Cavitation::MassConserving,
];

/// Of position over clearance, and of friction torque.
const BAR: f64 = 1e-8;

fn rough(sigma: f64, contact: ContactLaw) -> Finish {
    Finish::Rough(RoughFinish {
        roughness: Roughness {
            journal: 0.6 * sigma,
            shell: 0.8 * sigma,
            peklenik_journal: 4.0,
            peklenik_shell: 1.0,
        },
        contact,
        boundary_friction: 0.02,
    })
}

fn oil() -> Lubricant {
    Lubricant::constant(8e-3, 850.0)
}

/// Pairs of bearings and oils that are to do the same: what it is, then as it is and its limit.
type Pair = (&'static str, [(Bearing, Lubricant); 2]);

fn pairs(cavitation: Cavitation, sigma: f64) -> Vec<Pair> {
    let smooth = diesel_big_end(cavitation);
    let with = |finish: Finish| Bearing {
        finish,
        ..smooth.clone()
    };
    let contact = |factor| with(rough(sigma, greenwood_tripp(factor)));
    let thickening = |alpha| Lubricant {
        viscosity_pressure: PressureLaw::Roelands {
            alpha,
            temperature: Default::default(),
        },
        ..oil()
    };
    vec![
        (
            "no roughness",
            [
                (smooth.clone(), oil()),
                (with(rough(1e-13, greenwood_tripp(1e-3))), oil()),
            ],
        ),
        (
            "no contact",
            [(contact(1e-300), oil()), (contact(1e-16), oil())],
        ),
        (
            "no answer to pressure",
            [(smooth.clone(), oil()), (smooth, thickening(1e-18))],
        ),
    ]
}

fn rest(bearing: &Bearing, oil: &Lubricant) -> Equilibrium {
    let mut film = FilmSolver::aligned(bearing, oil, [64, 16]).unwrap();
    let request = EquilibriumRequest {
        load: [27e3, 12e3],
        moment: None,
        frame: JournalState {
            journal_speed: 209.0,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings {
            residual_tolerance: 1e-11,
            step_tolerance: 1e-10,
            ..EquilibriumSettings::default()
        },
    };
    let found = find_equilibrium(&mut film, bearing, &request, &CONDITIONS).unwrap();
    assert_eq!(found.outcome, Outcome::Converged, "{:?}", found.table);
    found
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn difference(a: &Equilibrium, b: &Equilibrium, clearance: f64) -> f64 {
    let moved = apart(a.state.position, b.state.position) / clearance;
    let torque = |e: &Equilibrium| e.reaction.friction_torque_journal;
    moved.max((torque(b) / torque(a) - 1.0).abs())
}

#[test]
fn at_rest_the_limits_are_hydrodynamic() {
    for cavitation in CLOSURES {
        let sigma = 1e-6;
        for (name, [as_is, limit]) in pairs(cavitation, sigma) {
            let [a, b] = [&as_is, &limit].map(|(bearing, oil)| rest(bearing, oil));
            let found = difference(&a, &b, as_is.0.radial_clearance);
            assert!(found < BAR, "{cavitation:?}, {name}: {found:e}");
        }
        // Contact that carries next to nothing is none at all; contact that carries is not.
        let with = |contact| Bearing {
            finish: rough(sigma, contact),
            ..diesel_big_end(cavitation)
        };
        let none = rest(&with(ContactLaw::None), &oil());
        let weak = rest(&with(greenwood_tripp(1e-16)), &oil());
        let found = difference(&none, &weak, 36e-6);
        assert!(found < BAR, "{cavitation:?}, without contact: {found:e}");
        let strong = rest(&with(greenwood_tripp(1e-3)), &oil());
        assert!(strong.summary.contact_load > 0.0);
        assert!(difference(&none, &strong, 36e-6) > 1e3 * BAR);
    }
}

fn orbit(bearing: &Bearing, oil: &Lubricant) -> JournalOrbit {
    let mut film = FilmSolver::aligned(bearing, oil, [32, 8]).unwrap();
    let settings = OrbitSettings {
        crank_step: 4_f64.to_radians(),
        cycle_limit: 1,
        ..OrbitSettings::default()
    };
    journal_orbit(
        &mut film,
        bearing,
        &diesel_cycle(),
        &CONDITIONS,
        &settings,
        &mut |_, _, _| ControlFlow::Continue(()),
    )
    .unwrap()
}

#[test]
fn over_a_load_cycle_the_limits_are_hydrodynamic() {
    for cavitation in CLOSURES {
        for (name, [as_is, limit]) in pairs(cavitation, 0.4e-6) {
            let [a, b] = [&as_is, &limit].map(|(bearing, oil)| orbit(bearing, oil));
            assert_eq!(a.points.len(), 181);
            assert_eq!(a.points.len(), b.points.len());
            let mut worst = 0.0_f64;
            for (a, b) in a.points.iter().zip(&b.points) {
                assert_eq!(a.outcome, b.outcome, "{cavitation:?}, {name}");
                let moved = apart(a.state.position, b.state.position);
                worst = worst.max(moved / as_is.0.radial_clearance);
            }
            assert!(worst < BAR, "{cavitation:?}, {name}: {worst:e}");
        }
    }
}

/// An oil that is compressed and thickens by Barus, in a bearing whose summits stand high above the mean planes: a
/// step of the journal that asks the film for far more than the limit of the reduced pressure leaves nothing
/// behind that the next ones could not undo.
#[test]
fn compressed_and_thickening_oil_comes_to_rest_at_every_speed() {
    let mut bearing = Bearing {
        cavitation: Cavitation::MassConserving,
        film_shear: FilmShear::FilmFraction,
        finish: Finish::Rough(RoughFinish {
            roughness: Roughness {
                journal: 0.20e-6,
                shell: 0.34e-6,
                peklenik_journal: 4.0,
                peklenik_shell: 9.0,
            },
            contact: ContactLaw::GreenwoodTripp(GreenwoodTripp {
                factor: 1e-3,
                asperity_product: 0.05,
                modulus: 53.3e9,
                summit_height: 0.60e-6,
                summit_roughness: Some(0.309e-6),
            }),
            boundary_friction: 0.02,
        }),
        ..plain_bearing(47.8e-3, 17.2e-3, 23.9e-6)
    };
    bearing.feeds.push(Feed {
        shape: FeedShape::Rectangle {
            length: 6e-3,
            width: 12e-3,
        },
        carried_by: Carrier::Shell,
        angle: std::f64::consts::PI,
        position: 0.0,
        pressure: 2e5,
        line: FeedLine::Direct,
    });
    let oil = Lubricant {
        viscosity_pressure: PressureLaw::Barus { alpha: 9.5e-9 },
        density_pressure: CompressionLaw::DowsonHigginson,
        ..Lubricant::constant(8.27e-3, 795.0)
    };
    let mut last = 0.0;
    for speed in [500.0, 1000.0, 1400.0, 1500.0, 1600.0, 2000.0] {
        let mut film = FilmSolver::aligned(&bearing, &oil, [96, 24]).unwrap();
        let request = EquilibriumRequest {
            load: [8e3, 0.0],
            moment: None,
            frame: JournalState {
                journal_speed: speed * std::f64::consts::PI / 30.0,
                ..JournalState::default()
            },
            start: None,
            settings: EquilibriumSettings::default(),
        };
        let found = find_equilibrium(&mut film, &bearing, &request, &CONDITIONS).unwrap();
        let thinnest = found.summary.minimum_film_thickness.value;
        println!("{speed}: {} updates, {thinnest:e} m", found.film_updates);
        assert_eq!(found.outcome, Outcome::Converged, "{speed}");
        assert!(thinnest > last, "{speed}: {thinnest}");
        last = thinnest;
    }
}
