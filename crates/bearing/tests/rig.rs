//! Friction of a measured rig of three bearings over speed (`validation/sander-rig`).
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "tests stop at the first surprise"
)]

mod common;
#[path = "rig/plane_bodies.rs"]
mod plane_bodies;

use common::{greenwood_tripp, plain_bearing, rig_finish, text_table};
use plane_bodies::{Mixing, PlaneBodies};
use sommerfeld_bearing::{Equilibrium, EquilibriumRequest, EquilibriumSettings, find_equilibrium};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Conditions, ContactLaw, Elasticity, Ends, Feature, Feed,
    FeedLine, FeedShape, FilmForce, FilmShear, FilmSolver, Finish, GreenwoodTripp, JournalState,
    Outcome, ProfileTable, Shape,
};
use sommerfeld_oil::{Lubricant, PressureLaw, ShearThinning};
use std::f64::consts::PI;

/// Load of the test bearing in the curve with a bar, and in the other; each support carries half; N.
const LOAD: f64 = 8e3;
const LIGHT_LOAD: f64 = 4e3;

/// From the full film down, each the start of the next, 1/min; the measured ones among them.
const SPEEDS: [f64; 14] = [
    3000.0, 2000.0, 1500.0, 1000.0, 700.0, 500.0, 400.0, 350.0, 300.0, 275.0, 250.0, 225.0, 200.0,
    150.0,
];

/// Diameter and width, m, and Young's modulus of what holds the shell, Pa.
struct Place {
    diameter: f64,
    width: f64,
    modulus: f64,
}

/// An aluminium rod, and steel brackets.
const TESTED: Place = Place {
    diameter: 47.8e-3,
    width: 17.2e-3,
    modulus: 70e9,
};
const SUPPORT: Place = Place {
    diameter: 54e-3,
    width: 25e-3,
    modulus: 210e9,
};

/// How the bodies give way.
#[derive(Clone, Copy)]
enum Bodies {
    Rigid,
    /// A layer (thickness in m, modulus in Pa) in every bearing.
    Layer(f64, f64),
    /// Columns as stiff as the bodies of each bearing, times this.
    Columns(f64),
}

/// What the source says or assumes, and what may be varied.
#[derive(Clone)]
struct Rig {
    /// Clearance over radius; assumed in the source.
    relative_clearance: f64,
    /// Surfaces in the film and in contact.
    finish: Finish,
    bodies: Bodies,
    /// Young's modulus of the rod, Pa.
    rod: f64,
    oil: Lubricant,
    cavitation: Cavitation,
    /// Tilt of the journal in the supports, rad.
    support_tilt: f64,
    cells: [usize; 2],
}

impl Rig {
    /// Between rigid bodies.
    fn as_in_the_source() -> Self {
        Self {
            relative_clearance: 1e-3,
            finish: surfaces(),
            bodies: Bodies::Rigid,
            rod: TESTED.modulus,
            oil: Lubricant {
                viscosity_pressure: PressureLaw::Barus { alpha: 9.5e-9 },
                ..Lubricant::constant(6.8e-3, 832.5)
            },
            cavitation: Cavitation::MassConserving,
            support_tilt: 0.0,
            cells: [64, 16],
        }
    }

    /// On columns as stiff as the bodies.
    fn elastic() -> Self {
        Self {
            bodies: Bodies::Columns(1.0),
            ..Self::as_in_the_source()
        }
    }

    fn elasticity(&self, place: &Place, load: f64) -> Elasticity {
        match self.bodies {
            Bodies::Rigid => Elasticity::Rigid,
            Bodies::Layer(thickness, modulus) => Elasticity::Layer {
                thickness,
                modulus,
                poisson: 0.3,
            },
            Bodies::Columns(share) => {
                let modulus = composite(place.modulus);
                let half_width = self.half_width(place, load);
                Elasticity::Layer {
                    // without sideways strain, so that the compliance is thickness over modulus
                    thickness: share * half_width / (0.375 * PI),
                    modulus,
                    poisson: 0.0,
                }
            }
        }
    }

    /// Half width of the dry contact of shaft and bore, m: Hertz, with the difference of their curvatures.
    fn half_width(&self, place: &Place, load: f64) -> f64 {
        let radius = 0.5 * place.diameter / self.relative_clearance;
        (4.0 * load / place.width * radius / (PI * composite(place.modulus))).sqrt()
    }

    /// Bearing loaded along +x, with its feed on the other side, flooded ends, and everything at 1 bar
    /// over the pressure of the ruptured film.
    fn bearing(&self, place: &Place, load: f64, feed: FeedShape) -> Bearing {
        let radial_clearance = 0.5 * place.diameter * self.relative_clearance;
        Bearing {
            cavitation_pressure: -1e5,
            ends: Ends::Flooded,
            cavitation: self.cavitation,
            film_shear: FilmShear::FilmFraction,
            finish: self.finish.clone(),
            elasticity: self.elasticity(place, load),
            feeds: vec![Feed {
                shape: feed,
                carried_by: Carrier::Shell,
                angle: PI,
                position: 0.0,
                pressure: 0.0,
                line: FeedLine::Direct,
            }],
            ..plain_bearing(place.diameter, place.width, radial_clearance)
        }
    }

    fn tested(&self, load: f64) -> Bearing {
        let place = Place {
            modulus: self.rod,
            ..TESTED
        };
        self.bearing(&place, load, FeedShape::Hole { diameter: 5e-3 })
    }

    fn support(&self, load: f64) -> Bearing {
        let groove = FeedShape::Rectangle {
            length: 0.5 * PI * SUPPORT.diameter,
            width: 5e-3,
        };
        self.bearing(&SUPPORT, 0.5 * load, groove)
    }

    /// At rest under the load at each speed (1/min), from the state before.
    fn rests(&self, bearing: &Bearing, load: f64, tilt: f64, speeds: &[f64]) -> Vec<Equilibrium> {
        let mut film = if tilt == 0.0 {
            FilmSolver::aligned(bearing, &self.oil, self.cells).unwrap()
        } else {
            FilmSolver::new(bearing, &self.oil, self.cells).unwrap()
        };
        let conditions = Conditions {
            temperature: 373.15,
            feed_pressures: None,
        };
        let mut start = None;
        let mut at = |rpm: &f64| {
            let request = request(load, *rpm, tilt, start);
            let rest = find_equilibrium(&mut film, bearing, &request, &conditions).unwrap();
            assert_eq!(rest.outcome, Outcome::Converged, "{rpm} 1/min");
            start = Some(rest.state.position);
            rest
        };
        speeds.iter().map(&mut at).collect()
    }

    /// The same between a shaft and a plate as soft as their moduli make them: the bore is moved until it
    /// is where the pressures of film and contact push it beyond the columns.
    fn rests_in_a_plate(
        &self,
        bearing: &Bearing,
        modulus: f64,
        speeds: &[f64],
    ) -> Vec<Equilibrium> {
        let bodies = PlaneBodies {
            radius: bearing.radius(),
            width: bearing.width,
            shaft: 210e9,
            plate: modulus,
            orders: 24,
        };
        let columns = bearing.elasticity.compliance();
        let conditions = Conditions {
            temperature: 373.15,
            feed_pressures: None,
        };
        let mut moved = vec![0.0; self.cells[0] * self.cells[1]];
        let mut start = None;
        let mut at = |rpm: &f64| {
            let mut mixing = Mixing::default();
            let mut shape = Shape::default();
            for _ in 0..60 {
                let bearing = Bearing {
                    bore: shape.clone(),
                    ..bearing.clone()
                };
                let mut film = FilmSolver::aligned(&bearing, &self.oil, self.cells).unwrap();
                let request = request(LOAD, *rpm, 0.0, start);
                let rest = find_equilibrium(&mut film, &bearing, &request, &conditions).unwrap();
                assert_eq!(rest.outcome, Outcome::Converged, "{rpm} 1/min");
                start = Some(rest.state.position);
                let field = film.field().unwrap();
                let mut left = bodies.beyond_columns(&field, columns);
                assert_eq!(left.len(), moved.len());
                left.iter_mut().zip(&moved).for_each(|(a, b)| *a -= b);
                if left.iter().all(|missing| missing.abs() < 3e-9) {
                    return rest;
                }
                moved = mixing.next(&moved, left);
                let (angles, axial) = (field.angles.to_vec(), field.axial.to_vec());
                let table = ProfileTable::new(angles, axial, moved.clone()).unwrap();
                shape.features = vec![Feature::Table(table)];
            }
            panic!("{rpm} 1/min: the plate does not settle");
        };
        speeds.iter().map(&mut at).collect()
    }
}

fn request(load: f64, rpm: f64, tilt: f64, start: Option<[f64; 2]>) -> EquilibriumRequest {
    EquilibriumRequest {
        load: [load, 0.0],
        moment: None,
        frame: JournalState {
            journal_speed: rpm * PI / 30.0,
            tilt: [0.0, tilt],
            ..JournalState::default()
        },
        start,
        settings: EquilibriumSettings::default(),
    }
}

/// Composite modulus of a steel shaft and what holds the shell, Pa; Poisson's ratio 0.3 of both.
fn composite(modulus: f64) -> f64 {
    1.0 / (0.91 / 210e9 + 0.91 / modulus)
}

/// Surfaces of the source: rms roughness 0.20 and 0.34 um, summits 0.13 and 0.28 um rms about means that
/// stand 0.21 and 0.39 um above the mean planes.
fn surfaces() -> Finish {
    finish(0.20e-6, 0.34e-6, 0.60e-6)
}

/// Surfaces of a given rms roughness, whose summits stand `height` above the mean planes; m.
fn finish(journal: f64, shell: f64, height: f64) -> Finish {
    let ContactLaw::GreenwoodTripp(planes) = greenwood_tripp(1e-3) else {
        return Finish::Smooth;
    };
    let mut finish = rig_finish(ContactLaw::GreenwoodTripp(GreenwoodTripp {
        summit_height: height,
        summit_roughness: Some(0.13e-6_f64.hypot(0.28e-6)),
        ..planes
    }));
    if let Finish::Rough(rough) = &mut finish {
        rough.roughness.journal = journal;
        rough.roughness.shell = shell;
    }
    finish
}

struct Speed {
    rpm: f64,
    measured: f64,
    /// Of the shaft, N m.
    torque: f64,
    /// Of the load of the test bearing.
    contact: f64,
    /// Smallest in the test bearing, m.
    film: f64,
}

/// The measured speeds under a load of the test bearing, the slowest first.
fn over_speed(rig: &Rig, load: f64) -> Vec<Speed> {
    let tested = rig.rests(&rig.tested(load), load, 0.0, &SPEEDS);
    let support = rig.rests(&rig.support(load), 0.5 * load, rig.support_tilt, &SPEEDS);
    let mut speeds: Vec<Speed> = text_table("sander-rig/reference.csv")
        .iter()
        .map(|row| [1, 2, 3].map(|k| row[k].parse::<f64>().unwrap()))
        .filter(|[of, ..]| *of == load)
        .map(|[_, rpm, measured]| {
            let k = SPEEDS.iter().position(|speed| *speed == rpm).unwrap();
            let torque = |rests: &[Equilibrium]| rests[k].reaction.friction_torque_journal;
            let [x, y] = tested[k].reaction.contact_force;
            Speed {
                rpm,
                measured,
                torque: torque(&tested) + 2.0 * torque(&support),
                contact: x.hypot(y) / load,
                film: tested[k].summary.minimum_film_thickness.value,
            }
        })
        .collect();
    speeds.sort_by(|a, b| a.rpm.total_cmp(&b.rpm));
    assert_eq!(speeds.len(), if load == LOAD { 8 } else { 7 });
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

/// Speeds where the torque is off by less than the bar, 25 % of the largest measured one.
fn level(speeds: &[Speed]) -> Vec<f64> {
    let largest = speeds.iter().map(|s| s.measured).fold(0.0, f64::max);
    let meets = |s: &&Speed| (s.torque - s.measured).abs() < 0.25 * largest;
    speeds.iter().filter(meets).map(|s| s.rpm).collect()
}

/// Speed of the smallest torque, 1/min.
fn least(speeds: &[Speed]) -> f64 {
    let least = speeds.iter().min_by(|a, b| a.torque.total_cmp(&b.torque));
    least.unwrap().rpm
}

/// With the surfaces of the source, the measured torque lies between that of rigid bodies and that of
/// bodies as soft as their moduli make them, where asperities touch. Neither meets the bar there: see the page
/// of the case.
#[test]
fn the_measured_torque_lies_between_rigid_and_elastic_bodies() {
    let rigid = over_speed(&Rig::as_in_the_source(), LOAD);
    let elastic = over_speed(&Rig::elastic(), LOAD);
    print("rigid bodies", &rigid);
    print("elastic bodies", &elastic);
    for (soft, hard) in elastic.iter().zip(&rigid) {
        let what = format!("{} 1/min: {} {}", soft.rpm, soft.torque, hard.torque);
        if soft.rpm >= 1000.0 {
            assert!((hard.torque / hard.measured - 1.0).abs() < 0.05, "{what}");
        } else {
            let between = soft.torque < soft.measured && soft.measured < hard.torque;
            assert!(between, "{what}, measured {}", soft.measured);
        }
    }
    assert_eq!(level(&rigid), [500.0, 1000.0, 3000.0]);
    assert_eq!(level(&elastic), [300.0, 400.0, 500.0, 1000.0, 3000.0]);
    assert_eq!([least(&rigid), least(&elastic)], [1000.0, 250.0]);
}

/// Column foundations answer a dry Hertz contact with its half width and load: what the elastic bodies are
/// stands on this.
#[test]
fn columns_carry_the_load_of_hertz_over_the_same_half_width() {
    let rig = Rig::elastic();
    for (place, load) in [(TESTED, LOAD), (SUPPORT, 0.5 * LOAD)] {
        let half_width = rig.half_width(&place, load);
        let radius = 0.5 * place.diameter / rig.relative_clearance;
        let compliance = rig.elasticity(&place, load).compliance();
        let n = 2000;
        let width = 2.0 * half_width / f64::from(n);
        let carried: f64 = (0..n)
            .map(|i| (f64::from(i) + 0.5) * width - half_width)
            .map(|x| (half_width * half_width - x * x) / (2.0 * radius * compliance) * width)
            .sum();
        assert!((carried * place.width / load - 1.0).abs() < 1e-6);
    }
}

/// Columns as soft as a Hertz contact stand for elastic bodies: a shaft in a plate, whose places know of each
/// other, has in the test bearing the torque of the columns within 0.06 N m.
#[test]
#[ignore = "a minute; for the page of validation/sander-rig"]
fn a_shaft_in_a_plate_has_the_torque_of_columns() {
    let rig = Rig::elastic();
    let bearing = rig.tested(LOAD);
    let speeds = [3000.0, 1000.0, 300.0, 150.0];
    let plate = rig.rests_in_a_plate(&bearing, TESTED.modulus, &speeds);
    let columns = rig.rests(&bearing, LOAD, 0.0, &speeds);
    for (rpm, (plate, columns)) in speeds.iter().zip(plate.iter().zip(&columns)) {
        let of = |rest: &Equilibrium| {
            let [x, y] = rest.reaction.contact_force;
            let film = 1e6 * rest.summary.minimum_film_thickness.value;
            let torque = rest.reaction.friction_torque_journal;
            [torque, x.hypot(y) / LOAD, film]
        };
        println!("{rpm}: {:.3?} {:.3?}", of(plate), of(columns));
        let apart = (of(plate)[0] - of(columns)[0]).abs();
        assert!(apart < 0.06, "{rpm}: {apart}");
    }
}

/// Short waves see a half-plane, and pressure without waves a plate of Lame.
#[test]
fn plane_bodies_have_their_limits() {
    let bodies = PlaneBodies {
        radius: 0.02,
        width: 0.02,
        shaft: 1e30,
        plate: 70e9,
        orders: 0,
    };
    let lame = 0.02 * 1.3 / 70e9;
    assert!((bodies.compliance(0, 0) / lame - 1.0).abs() < 1e-9);
    let half_plane = 2.0 * 0.02 / 70e9 / 1e4;
    assert!((bodies.compliance(10_000, 0) / half_plane - 1.0).abs() < 2e-4);
    let shaft = PlaneBodies {
        shaft: 210e9,
        plate: 1e30,
        ..bodies
    };
    let half_plane = 2.0 * 0.91 * 0.02 / 210e9 / 1e4;
    assert!((shaft.compliance(10_000, 0) / half_plane - 1.0).abs() < 2e-4);
    assert!((shaft.compliance(10_000, 1) / half_plane - 1.0).abs() < 1e-3);
}

/// One assumption at a time: `cargo test -p sommerfeld-bearing --test rig -- --ignored --nocapture`.
#[test]
#[ignore = "prints the table of validation/sander-rig"]
fn one_assumption_at_a_time() {
    let rigid = Rig::as_in_the_source();
    let elastic = Rig::elastic();
    let planes = finish(0.13e-6, 0.28e-6, 0.0);
    let thinning = ShearThinning::Cross {
        second_newtonian_ratio: 0.5,
        critical_shear_rate: 3e6,
        exponent: 0.8,
        reference: None,
    };
    let mut rubbing = surfaces();
    let mut isotropic = surfaces();
    if let (Finish::Rough(rubbing), Finish::Rough(isotropic)) = (&mut rubbing, &mut isotropic) {
        rubbing.boundary_friction = 0.1;
        isotropic.roughness.peklenik_journal = 1.0;
        isotropic.roughness.peklenik_shell = 1.0;
    }
    let of = |from: &Rig, change: &dyn Fn(&mut Rig)| {
        let mut rig = from.clone();
        change(&mut rig);
        rig
    };
    let columns = |share: f64| of(&elastic, &|r| r.bodies = Bodies::Columns(share));
    for (name, rig) in [
        ("rigid bodies", rigid.clone()),
        (
            "rigid, 128 x 32 cells",
            of(&rigid, &|r| r.cells = [128, 32]),
        ),
        (
            "rigid, summits in the mean planes",
            of(&rigid, &|r| r.finish = planes.clone()),
        ),
        ("elastic bodies", elastic.clone()),
        ("128 x 32 cells", of(&elastic, &|r| r.cells = [128, 32])),
        ("half as soft", columns(0.5)),
        ("a quarter as soft", columns(0.25)),
        ("an eighth as soft", columns(0.125)),
        (
            "a layer of 2 mm of 70 GPa",
            of(&elastic, &|r| r.bodies = Bodies::Layer(2e-3, 70e9)),
        ),
        ("rod of steel", of(&elastic, &|r| r.rod = 210e9)),
        (
            "summits in the mean planes",
            of(&elastic, &|r| r.finish = planes.clone()),
        ),
        (
            "marks in no direction",
            of(&elastic, &|r| r.finish = isotropic.clone()),
        ),
        (
            "`reynolds`",
            of(&elastic, &|r| r.cavitation = Cavitation::Reynolds),
        ),
        (
            "no pressure coefficient",
            of(&elastic, &|r| r.oil.viscosity_pressure = PressureLaw::None),
        ),
        (
            "Cross, half at 3e6 1/s",
            of(&elastic, &|r| r.oil.shear_thinning = thinning),
        ),
        (
            "clearance 0.8e-3",
            of(&elastic, &|r| r.relative_clearance = 0.8e-3),
        ),
        (
            "clearance 1.3e-3",
            of(&elastic, &|r| r.relative_clearance = 1.3e-3),
        ),
        (
            "supports tilted by 2e-5",
            of(&elastic, &|r| r.support_tilt = 2e-5),
        ),
        (
            "boundary friction 0.1",
            of(&elastic, &|r| r.finish = rubbing.clone()),
        ),
    ] {
        let speeds = over_speed(&rig, LOAD);
        print(name, &speeds);
        println!("  level {:?}, least at {}", level(&speeds), least(&speeds));
    }
}

/// The curve of half the load, which has no bar: between both bodies, too, where asperities touch; in the full
/// film the measured torque is up to 12 % larger.
#[test]
fn so_it_does_under_half_the_load() {
    let rigid = over_speed(&Rig::as_in_the_source(), LIGHT_LOAD);
    let elastic = over_speed(&Rig::elastic(), LIGHT_LOAD);
    print("rigid bodies", &rigid);
    print("elastic bodies", &elastic);
    for (soft, hard) in elastic.iter().zip(&rigid) {
        let what = format!("{} 1/min: {} {}", soft.rpm, soft.torque, hard.torque);
        if soft.rpm >= 500.0 {
            assert!((hard.torque / hard.measured - 1.0).abs() < 0.13, "{what}");
        } else {
            let between = soft.torque < soft.measured && soft.measured < hard.torque;
            assert!(between, "{what}, measured {}", soft.measured);
        }
    }
}

/// A shell that gives way, under asperities and an oil that thickens: the test bearing of the rig comes to rest
/// without a start, too.
#[test]
fn soft_shells_rest_on_asperities_and_oil_that_thickens() {
    let bodies = [
        Bodies::Layer(0.3e-3, 70e9),
        Bodies::Layer(2e-3, 70e9),
        Bodies::Columns(1.0),
    ];
    for bodies in bodies {
        let rig = Rig {
            bodies,
            ..Rig::as_in_the_source()
        };
        let bearing = rig.tested(LOAD);
        let compliance = bearing.elasticity.compliance();
        let along = rig.rests(&bearing, LOAD, 0.0, &SPEEDS);
        for rpm in [3000.0, 1000.0, 300.0, 150.0] {
            let rest = &rig.rests(&bearing, LOAD, 0.0, &[rpm])[0];
            let k = SPEEDS.iter().position(|speed| *speed == rpm).unwrap();
            let [x, y] = rest.state.position;
            let [u, v] = along[k].state.position;
            let apart = (x - u).hypot(y - v) / bearing.radial_clearance;
            assert!(apart < 1e-6, "{compliance} m/Pa, {rpm} 1/min: {apart}");
        }
    }
}
