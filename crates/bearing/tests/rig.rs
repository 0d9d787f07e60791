//! Friction of a measured rig of three bearings over speed (`validation/sander-rig`).
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests stop at the first surprise"
)]

mod common;

use common::{greenwood_tripp, plain_bearing, rig_finish, text_table};
use sommerfeld_bearing::{Equilibrium, EquilibriumRequest, EquilibriumSettings, find_equilibrium};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Conditions, ContactLaw, ContactTable, Elasticity, Ends, Feed,
    FeedLine, FeedShape, FilmShear, FilmSolver, Finish, JournalState, Outcome,
};
use sommerfeld_oil::{Lubricant, PressureLaw, ShearThinning};
use std::f64::consts::PI;

/// What the source says or assumes, and what may be varied.
#[derive(Clone)]
struct Rig {
    /// Clearance over radius; assumed in the source.
    relative_clearance: f64,
    /// Surfaces in the film and in contact.
    finish: Finish,
    elasticity: Elasticity,
    oil: Lubricant,
    cavitation: Cavitation,
    cells: [usize; 2],
}

impl Rig {
    fn as_stated() -> Self {
        Self {
            relative_clearance: 1e-3,
            finish: rig_finish(greenwood_tripp(1e-3)),
            elasticity: Elasticity::Rigid,
            oil: Lubricant {
                viscosity_pressure: PressureLaw::Barus { alpha: 9.5e-9 },
                ..Lubricant::constant(6.8e-3, 832.5)
            },
            cavitation: Cavitation::MassConserving,
            cells: [128, 32],
        }
    }

    /// Bearing loaded along +x, with its feed on the other side, flooded ends, and everything at 1 bar
    /// over the pressure of the ruptured film.
    fn bearing(&self, diameter: f64, width: f64, feed: FeedShape) -> Bearing {
        Bearing {
            cavitation_pressure: -1e5,
            ends: Ends::Flooded,
            cavitation: self.cavitation,
            film_shear: FilmShear::FilmFraction,
            finish: self.finish.clone(),
            elasticity: self.elasticity,
            feeds: vec![Feed {
                shape: feed,
                carried_by: Carrier::Shell,
                angle: PI,
                position: 0.0,
                pressure: 0.0,
                line: FeedLine::Direct,
            }],
            ..plain_bearing(diameter, width, 0.5 * diameter * self.relative_clearance)
        }
    }

    fn rest(&self, bearing: &Bearing, load: f64, speed: f64) -> Equilibrium {
        let mut film = FilmSolver::aligned(bearing, &self.oil, self.cells).unwrap();
        let request = EquilibriumRequest {
            load: [load, 0.0],
            moment: None,
            frame: JournalState {
                journal_speed: speed,
                ..JournalState::default()
            },
            start: None,
            settings: EquilibriumSettings::default(),
        };
        let conditions = Conditions {
            temperature: 373.15,
            feed_pressures: None,
        };
        find_equilibrium(&mut film, bearing, &request, &conditions).unwrap()
    }

    /// Torque of the shaft, N m, with the share of contact and the smallest film of the test bearing.
    fn torque(&self, load: f64, rpm: f64) -> [f64; 3] {
        let speed = rpm * PI / 30.0;
        let tested = self.bearing(47.8e-3, 17.2e-3, FeedShape::Hole { diameter: 5e-3 });
        let groove = FeedShape::Rectangle {
            length: 0.5 * PI * 54e-3,
            width: 5e-3,
        };
        let support = self.bearing(54e-3, 25e-3, groove);
        let a = self.rest(&tested, load, speed);
        let b = self.rest(&support, 0.5 * load, speed);
        for rest in [&a, &b] {
            if rest.outcome != Outcome::Converged {
                println!("{rpm} {:?} {}", rest.outcome, rest.residual);
            }
        }
        let torque = |rest: &Equilibrium| rest.reaction.friction_torque_journal;
        let [x, y] = a.reaction.contact_force;
        [
            torque(&a) + 2.0 * torque(&b),
            x.hypot(y) / load,
            a.summary.minimum_film_thickness.value,
        ]
    }
}

/// Contact of Greenwood and Tripp whose summits stand `height` (m) above the mean planes, both together.
fn summits(height: f64) -> ContactLaw {
    let law = greenwood_tripp(1e-3);
    let sigma = 0.13e-6_f64.hypot(0.28e-6);
    let n = 240;
    let gaps: Vec<f64> = (0..=n)
        .map(|i| height + sigma * (-6.0 + 11.0 * f64::from(i) / f64::from(n)))
        .collect();
    let mut pressures: Vec<f64> = gaps
        .iter()
        .map(|g| law.pressure(g - height, sigma).value)
        .collect();
    *pressures.last_mut().unwrap() = 0.0;
    ContactLaw::Table(ContactTable::new(gaps, pressures).unwrap())
}

/// Summit heights of both surfaces in the source, together, m.
const SUMMITS: f64 = 0.6e-6;

struct Speed {
    rpm: f64,
    measured: f64,
    torque: f64,
    contact: f64,
    film: f64,
}

fn over_speed(rig: &Rig) -> Vec<Speed> {
    let mut speeds: Vec<Speed> = text_table("sander-rig/reference.csv")
        .iter()
        .map(|row| {
            let [load, rpm, measured] = [1, 2, 3].map(|k| row[k].parse::<f64>().unwrap());
            let [torque, contact, film] = rig.torque(load, rpm);
            Speed {
                rpm,
                measured,
                torque,
                contact,
                film,
            }
        })
        .collect();
    speeds.sort_by(|a, b| a.rpm.total_cmp(&b.rpm));
    speeds
}

fn print(name: &str, speeds: &[Speed]) {
    let cells: Vec<String> = speeds.iter().map(|s| format!("{:.3}", s.torque)).collect();
    let slowest = &speeds[0];
    println!(
        "| {name} | {} | {:.2} | {:.2} |",
        cells.join(" | "),
        slowest.contact,
        1e6 * slowest.film
    );
}

/// Where the film carries, the torque is the measured one within the bar; the mixed branch lies between
/// summits that stand in the mean planes, as the reference data have them, and those that stand as high as the
/// source says. Neither meets the bar there: see the page of the case.
#[test]
fn the_measured_torque_lies_between_both_readings_of_the_surfaces() {
    let low = over_speed(&Rig::as_stated());
    let high = over_speed(&Rig {
        finish: rig_finish(summits(SUMMITS)),
        ..Rig::as_stated()
    });
    print("as stated", &low);
    print("summits 0.60 um high", &high);
    assert_eq!(low.len(), 8);
    let largest = low.iter().map(|s| s.measured).fold(0.0, f64::max);
    for (low, high) in low.iter().zip(&high) {
        let what = format!("{} 1/min: {} {}", low.rpm, low.torque, high.torque);
        if low.rpm >= 250.0 {
            // Of the largest torque, the bar is 25 %.
            assert!((low.torque - low.measured).abs() < 0.25 * largest, "{what}");
        }
        if low.rpm >= 1000.0 {
            assert!((low.torque / low.measured - 1.0).abs() < 0.05, "{what}");
        } else {
            let between = low.torque < low.measured && low.measured < high.torque;
            assert!(between, "{what}, measured {}", low.measured);
        }
    }
}

/// One assumption at a time: `cargo test -p sommerfeld-bearing --test rig -- --ignored --nocapture`.
#[test]
#[ignore = "prints the table of validation/sander-rig"]
fn one_assumption_at_a_time() {
    let stated = Rig::as_stated();
    let with = |change: &dyn Fn(&mut Rig)| {
        let mut rig = stated.clone();
        change(&mut rig);
        rig
    };
    let thinning = ShearThinning::Cross {
        second_newtonian_ratio: 0.5,
        critical_shear_rate: 3e6,
        exponent: 0.8,
        reference: None,
    };
    let stress = |finish: &mut Finish, friction: f64| {
        if let Finish::Rough(rough) = finish {
            rough.boundary_friction = friction;
        }
    };
    let layer = Elasticity::Layer {
        thickness: 2e-3,
        modulus: 70e9,
        poisson: 0.3,
    };
    for (name, rig) in [
        ("as stated", stated.clone()),
        ("64 x 16 cells", with(&|r| r.cells = [64, 16])),
        ("`reynolds`", with(&|r| r.cavitation = Cavitation::Reynolds)),
        (
            "no pressure coefficient",
            with(&|r| r.oil.viscosity_pressure = PressureLaw::None),
        ),
        ("clearance 0.8e-3", with(&|r| r.relative_clearance = 0.8e-3)),
        ("clearance 1.3e-3", with(&|r| r.relative_clearance = 1.3e-3)),
        (
            "Cross, half at 3e6 1/s",
            with(&|r| r.oil.shear_thinning = thinning),
        ),
        (
            "boundary friction 0.1",
            with(&|r| stress(&mut r.finish, 0.1)),
        ),
        (
            "layer 2 mm of 70 GPa, 64 x 16",
            with(&|r| {
                r.elasticity = layer;
                r.cells = [64, 16];
            }),
        ),
        (
            "summits 0.30 um high",
            with(&|r| r.finish = rig_finish(summits(0.3e-6))),
        ),
        (
            "summits 0.60 um high",
            with(&|r| r.finish = rig_finish(summits(SUMMITS))),
        ),
    ] {
        print(name, &over_speed(&rig));
    }
}

/// A shell that gives way under an oil that thickens: the test bearing of the rig comes to rest.
#[test]
fn soft_shells_rest_on_oil_that_thickens() {
    for thickness in [0.3e-3, 2e-3] {
        let rig = Rig {
            elasticity: Elasticity::Layer {
                thickness,
                modulus: 70e9,
                poisson: 0.3,
            },
            cells: [64, 16],
            ..Rig::as_stated()
        };
        let bearing = rig.bearing(47.8e-3, 17.2e-3, FeedShape::Hole { diameter: 5e-3 });
        for rpm in [3000.0, 1000.0, 300.0] {
            let rest = rig.rest(&bearing, 8e3, rpm * PI / 30.0);
            assert_eq!(
                rest.outcome,
                Outcome::Converged,
                "{thickness} m, {rpm} 1/min"
            );
        }
    }
}

#[test]
#[ignore = "scratch"]
fn scratch() {
    let stated = Rig::as_stated();
    let with = |change: &dyn Fn(&mut Rig)| {
        let mut rig = stated.clone();
        change(&mut rig);
        rig
    };
    let surfaces = |rig: &mut Rig, height: f64| {
        if let Finish::Rough(rough) = &mut rig.finish {
            rough.roughness.journal = 0.20e-6;
            rough.roughness.shell = 0.34e-6;
            if let ContactLaw::GreenwoodTripp(law) = &mut rough.contact {
                law.summit_height = height;
                law.summit_roughness = Some(0.13e-6_f64.hypot(0.28e-6));
            }
        }
    };
    let soft = |k: f64| Elasticity::Layer { thickness: k, modulus: 1.0, poisson: 0.0 };
    let which = std::env::var("WHICH").unwrap_or_default();
    for (name, rig) in [
        ("A rigid stated", with(&|_| {})),
        ("B rigid surfaces", with(&|r| surfaces(r, 0.6e-6))),
        ("C soft 2e-14 stated", with(&|r| r.elasticity = soft(2.1e-14))),
        ("D soft 2e-14 surfaces", with(&|r| {r.elasticity = soft(2.1e-14); surfaces(r, 0.6e-6)})),
        ("E soft 2.3e-13 stated", with(&|r| {r.elasticity = soft(2.3e-13);})),
        ("F soft 2.3e-13 surfaces", with(&|r| {r.elasticity = soft(2.3e-13); surfaces(r, 0.6e-6)})),
    ] {
        if !which.is_empty() && !which.contains(&name[..1]) { continue; }
        for cells in [[64, 16]] {
            let rig = Rig { cells, ..rig.clone() };
            let start = std::time::Instant::now();
            print(name, &over_speed(&rig));
            println!("{:?}", start.elapsed());
        }
    }
}
