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
    Bearing, Carrier, Cavitation, Conditions, ContactLaw, Elasticity, Ends, Feed, FeedLine,
    FeedShape, FilmShear, FilmSolver, Finish, GreenwoodTripp, JournalState, Outcome,
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
    support: Option<Elasticity>,
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
            support: None,
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

    /// At rest under the load, from the fastest speed (1/min) to the slowest, each from the one before.
    fn rests(&self, bearing: &Bearing, load: f64, speeds: &[f64]) -> Vec<Equilibrium> {
        let mut film = FilmSolver::aligned(bearing, &self.oil, self.cells).unwrap();
        let conditions = Conditions {
            temperature: 373.15,
            feed_pressures: None,
        };
        let mut start = None;
        let mut found = Vec::new();
        for rpm in speeds {
            let request = EquilibriumRequest {
                load: [load, 0.0],
                moment: None,
                frame: JournalState {
                    journal_speed: rpm * PI / 30.0,
                    ..JournalState::default()
                },
                start,
                settings: EquilibriumSettings::default(),
            };
            let rest = find_equilibrium(&mut film, bearing, &request, &conditions).unwrap();
            if rest.outcome != Outcome::Converged {
                println!("{rpm} {:?} {}", rest.outcome, rest.residual);
            }
            if rest.outcome == Outcome::Converged {
                start = Some(rest.state.position);
            }
            found.push(rest);
        }
        found
    }
    fn rest(&self, bearing: &Bearing, load: f64, speed: f64) -> Equilibrium {
        self.rests(bearing, load, &[speed * 30.0 / PI]).remove(0)
    }
}

/// Contact of Greenwood and Tripp whose summits stand `height` (m) above the mean planes, both together.
fn summits(height: f64) -> ContactLaw {
    match greenwood_tripp(1e-3) {
        ContactLaw::GreenwoodTripp(law) => ContactLaw::GreenwoodTripp(GreenwoodTripp {
            summit_height: height,
            summit_roughness: Some(0.13e-6_f64.hypot(0.28e-6)),
            ..law
        }),
        law => law,
    }
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
    let table = text_table("sander-rig/reference.csv");
    let rows: Vec<[f64; 3]> = table
        .iter()
        .map(|row| [1, 2, 3].map(|k| row[k].parse::<f64>().unwrap()))
        .collect();
    let speeds = [
        3000.0, 2000.0, 1500.0, 1000.0, 700.0, 500.0, 400.0, 350.0, 300.0, 275.0, 250.0, 225.0,
        200.0, 175.0, 150.0,
    ];
    let load = rows[0][0];
    let tested = rig.bearing(47.8e-3, 17.2e-3, FeedShape::Hole { diameter: 5e-3 });
    let groove = FeedShape::Rectangle {
        length: 0.5 * PI * 54e-3,
        width: 5e-3,
    };
    let mut support = rig.bearing(54e-3, 25e-3, groove);
    if let Some(e) = rig.support {
        support.elasticity = e;
    }
    let keep = |rests: Vec<Equilibrium>| -> Vec<Equilibrium> {
        speeds
            .iter()
            .zip(rests)
            .filter(|(s, _)| rows.iter().any(|r| r[1] == **s))
            .map(|(_, r)| r)
            .collect()
    };
    let a = keep(rig.rests(&tested, load, &speeds));
    let b = keep(rig.rests(&support, 0.5 * load, &speeds));
    let mut found: Vec<Speed> = rows
        .iter()
        .zip(a.iter().zip(&b))
        .map(|(row, (a, b))| {
            let [x, y] = a.reaction.contact_force;
            Speed {
                rpm: row[1],
                measured: row[2],
                torque: a.reaction.friction_torque_journal
                    + 2.0 * b.reaction.friction_torque_journal,
                contact: x.hypot(y) / load,
                film: a.summary.minimum_film_thickness.value,
            }
        })
        .collect();
    found.sort_by(|a, b| a.rpm.total_cmp(&b.rpm));
    found
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
    let soft = |k: f64| Elasticity::Layer {
        thickness: k,
        modulus: 1.0,
        poisson: 0.0,
    };
    let which = std::env::var("WHICH").unwrap_or_default();
    for (name, rig) in [
        ("A rigid stated", with(&|_| {})),
        ("B rigid surfaces", with(&|r| surfaces(r, 0.6e-6))),
        (
            "C soft 2e-14 stated",
            with(&|r| r.elasticity = soft(2.1e-14)),
        ),
        (
            "D soft 2e-14 surfaces",
            with(&|r| {
                r.elasticity = soft(2.1e-14);
                surfaces(r, 0.6e-6)
            }),
        ),
        (
            "E soft 2.3e-13 stated",
            with(&|r| {
                r.elasticity = soft(2.3e-13);
            }),
        ),
        (
            "G hertz surfaces",
            with(&|r| {
                r.elasticity = soft(2.3e-13);
                r.support = Some(soft(5.1e-14));
                surfaces(r, 0.6e-6)
            }),
        ),
        (
            "F soft 2.3e-13 surfaces",
            with(&|r| {
                r.elasticity = soft(2.3e-13);
                surfaces(r, 0.6e-6)
            }),
        ),
    ] {
        if !which.is_empty() && !which.contains(&name[..1]) {
            continue;
        }
        for cells in [[64, 16]] {
            let rig = Rig {
                cells,
                ..rig.clone()
            };
            let start = std::time::Instant::now();
            print(name, &over_speed(&rig));
            println!("{:?}", start.elapsed());
        }
    }
}

use sommerfeld_film::{FilmForce, Step};
fn walk(film: &mut FilmSolver, at: &mut [f64; 2], load: f64, speed: f64, c: f64) -> Option<usize> {
    let conditions = Conditions {
        temperature: 373.15,
        feed_pressures: None,
    };
    let mut p = *at;
    for k in 0..40 {
        let state = JournalState {
            position: p,
            journal_speed: speed,
            ..JournalState::default()
        };
        let seen = film.react(&state, Step::Steady, &conditions).unwrap();
        if seen.outcome != Outcome::Converged {
            return None;
        }
        let f = seen.reaction.force();
        let r = [f[0] + load, f[1]];
        if r[0].hypot(r[1]) < 1e-8 * load {
            *at = p;
            return Some(k);
        }
        let t = seen.tangent.by_position;
        let det = t[0][0] * t[1][1] - t[0][1] * t[1][0];
        let mut d = [
            -(r[0] * t[1][1] - r[1] * t[0][1]) / det,
            -(t[0][0] * r[1] - t[1][0] * r[0]) / det,
        ];
        let n = d[0].hypot(d[1]);
        let most = 0.03 * c;
        if n > most {
            d = [d[0] * most / n, d[1] * most / n];
        }
        p = [p[0] + d[0], p[1] + d[1]];
    }
    None
}

#[test]
#[ignore = "scratch"]
fn walked() {
    let stated = Rig::as_stated();
    let soft = |k: f64| Elasticity::Layer {
        thickness: k,
        modulus: 1.0,
        poisson: 0.0,
    };
    for k in [2e-14, 5e-14, 1e-13, 2.3e-13] {
        for surfaces in [false, true] {
            let mut rig = Rig {
                elasticity: soft(k),
                cells: [64, 16],
                ..stated.clone()
            };
            if surfaces {
                if let Finish::Rough(rough) = &mut rig.finish {
                    rough.roughness.journal = 0.20e-6;
                    rough.roughness.shell = 0.34e-6;
                    if let ContactLaw::GreenwoodTripp(law) = &mut rough.contact {
                        law.summit_height = 0.6e-6;
                        law.summit_roughness = Some(0.13e-6_f64.hypot(0.28e-6));
                    }
                }
            }
            let bearing = rig.bearing(47.8e-3, 17.2e-3, FeedShape::Hole { diameter: 5e-3 });
            let mut film = FilmSolver::aligned(&bearing, &rig.oil, rig.cells).unwrap();
            let c = bearing.radial_clearance;
            let mut at = [0.3 * c, 0.4 * c];
            let mut ok = true;
            let speed = 3000.0 * PI / 30.0;
            for load in [
                200.0, 500.0, 1000.0, 2000.0, 3000.0, 4000.0, 5000.0, 6000.0, 7000.0, 8000.0,
            ] {
                if walk(&mut film, &mut at, load, speed, c).is_none() {
                    println!("k {k} load {load} failed");
                    ok = false;
                    break;
                }
            }
            if !ok {
                continue;
            }
            for rpm in [
                3000.0, 2000.0, 1500.0, 1000.0, 700.0, 500.0, 400.0, 350.0, 300.0, 250.0, 220.0,
                200.0, 180.0, 160.0, 150.0,
            ] {
                let speed = rpm * PI / 30.0;
                match walk(&mut film, &mut at, 8000.0, speed, c) {
                    None => {
                        println!("k {k} {surfaces} rpm {rpm} failed");
                        break;
                    }
                    Some(n) => {
                        let state = JournalState {
                            position: at,
                            journal_speed: speed,
                            ..JournalState::default()
                        };
                        let seen = film
                            .react(
                                &state,
                                Step::Steady,
                                &Conditions {
                                    temperature: 373.15,
                                    feed_pressures: None,
                                },
                            )
                            .unwrap();
                        let s = film.summary();
                        let [x, y] = seen.reaction.contact_force;
                        println!(
                            "k {k} {surfaces} rpm {rpm} it {n} torque {:.4} contact {:.3} hmin {:.3} eps {:.3} p {:.1}",
                            seen.reaction.friction_torque_journal,
                            x.hypot(y) / 8e3,
                            s.minimum_film_thickness.value * 1e6,
                            at[0].hypot(at[1]) / c,
                            s.peak_film_pressure.value * 1e-6
                        );
                    }
                }
            }
        }
    }
}

use sommerfeld_film::{Feature, ProfileTable, Shape};
struct Body {
    modulus: f64,
    poisson: f64,
}
/// compliance
struct Bodies {
    radius: f64,
    width: f64,
    shaft: Body,
    housing: Body,
    modes: usize,
}
impl Bodies {
    fn new(radius: f64, width: f64, shaft: Body, housing: Body, modes: usize) -> Self {
        Self {
            radius,
            width,
            shaft,
            housing,
            modes,
        }
    }
    fn flat(b: &Body) -> f64 {
        2.0 * (1.0 - b.poisson * b.poisson) / b.modulus
    }
    fn of_housing(&self, n: usize, q: f64) -> f64 {
        let b = &self.housing;
        let k = n as f64;
        let (mu, kappa) = (
            0.5 * b.modulus / (1.0 + b.poisson),
            (3.0 - b.poisson) / (1.0 + b.poisson),
        );
        if q > 0.0 {
            return Self::flat(b) / (k / self.radius).hypot(q);
        }
        match n {
            0 => self.radius / (2.0 * mu),
            1 => 0.0,
            _ => self.radius / (4.0 * mu * (k - 1.0)) * (kappa + (k - 1.0) / (k + 1.0)),
        }
    }
    fn of_shaft(&self, n: usize, q: f64) -> f64 {
        let b = &self.shaft;
        let k = n as f64;
        let (mu, kappa) = (0.5 * b.modulus / (1.0 + b.poisson), 3.0 - 4.0 * b.poisson);
        let flat = Self::flat(b) / (k / self.radius).hypot(q);
        let straight = match n {
            0 => {
                return if q > 0.0 {
                    (self.radius * (kappa - 1.0) / (4.0 * mu)).min(flat)
                } else {
                    self.radius * (kappa - 1.0) / (4.0 * mu)
                };
            }
            1 => return if q > 0.0 { flat } else { 0.0 },
            _ => self.radius / (4.0 * mu * (k + 1.0)) * (kappa + (k + 1.0) / (k - 1.0)),
        };
        let plane = Self::flat(b) * self.radius / k;
        flat * straight / plane
    }
    /// correction (C - k) p
    fn correct(&self, field: &sommerfeld_film::FilmField<'_>, k: f64) -> Vec<f64> {
        let (n, m) = (field.angles.len(), field.axial.len());
        let p: Vec<f64> = (0..n * m)
            .map(|i| {
                field.pressure[i].max(0.0) + field.contact_pressure.get(i).copied().unwrap_or(0.0)
            })
            .collect();
        let mut out: Vec<f64> = p.iter().map(|p| -k * p).collect();
        let padded = std::env::var("PAD")
            .ok()
            .and_then(|v| v.parse().ok())
            .unwrap_or(4.0_f64);
        // (length of period/2 in widths, is shaft)
        for (is_shaft, half) in [(false, 1.0), (true, padded)] {
            let length = half * self.width;
            let last = if is_shaft {
                (padded * m as f64) as usize
            } else {
                m
            };
            for mz in 0..last {
                // cosines symmetric about the mid-plane for the shaft, about the ends for the housing
                let q = if is_shaft {
                    2.0 * PI * mz as f64 / length
                } else {
                    PI * mz as f64 / length
                };
                let axial = |j: usize| {
                    if is_shaft {
                        (q * field.axial[j]).cos()
                    } else {
                        (q * (field.axial[j] + 0.5 * self.width)).cos()
                    }
                };
                let line: Vec<f64> = (0..n)
                    .map(|i| {
                        (0..m)
                            .map(|j| p[i * m + j] * axial(j) * field.axial_widths[j])
                            .sum::<f64>()
                            * if mz == 0 { 1.0 } else { 2.0 }
                            / length
                    })
                    .collect();
                let mut u = vec![0.0; n];
                for na in 0..=self.modes {
                    let by = if is_shaft {
                        self.of_shaft(na, q)
                    } else {
                        self.of_housing(na, q)
                    };
                    let of = |f: &dyn Fn(f64) -> f64| {
                        (0..n)
                            .map(|i| {
                                line[i] * f(na as f64 * field.angles[i]) * field.angle_widths[i]
                            })
                            .sum::<f64>()
                            * if na == 0 { 0.5 } else { 1.0 }
                            / PI
                    };
                    let (c, s) = (of(&f64::cos), of(&f64::sin));
                    for i in 0..n {
                        let a = na as f64 * field.angles[i];
                        u[i] += by * (c * a.cos() + s * a.sin());
                    }
                }
                for i in 0..n {
                    for j in 0..m {
                        out[i * m + j] += u[i] * axial(j);
                    }
                }
            }
        }
        // a translation is the journal's
        let [mut cx, mut cy] = [0.0; 2];
        for i in 0..n {
            for j in 0..m {
                let w = field.angle_widths[i] * field.axial_widths[j] / (PI * self.width);
                cx += w * out[i * m + j] * field.angles[i].cos();
                cy += w * out[i * m + j] * field.angles[i].sin();
            }
        }
        for i in 0..n {
            for j in 0..m {
                out[i * m + j] -= cx * field.angles[i].cos() + cy * field.angles[i].sin();
            }
        }
        out
    }
}

fn anderson(xs: &[Vec<f64>], fs: &[Vec<f64>], beta: f64) -> Vec<f64> {
    let last = xs.len() - 1;
    let (x, f) = (&xs[last], &fs[last]);
    let mut q: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    let mut rest = f.clone();
    let mut next: Vec<f64> = x.clone();
    for i in (0..last).rev() {
        let mut df: Vec<f64> = fs[i + 1].iter().zip(&fs[i]).map(|(a, b)| a - b).collect();
        let mut dx: Vec<f64> = xs[i + 1].iter().zip(&xs[i]).map(|(a, b)| a - b).collect();
        let before = df.iter().map(|v| v * v).sum::<f64>().sqrt();
        for (qf, qx) in &q {
            let d: f64 = df.iter().zip(qf).map(|(a, b)| a * b).sum();
            for k in 0..df.len() {
                df[k] -= d * qf[k];
                dx[k] -= d * qx[k];
            }
        }
        let size = df.iter().map(|v| v * v).sum::<f64>().sqrt();
        if size < 1e-4 * before {
            continue;
        }
        for k in 0..df.len() {
            df[k] /= size;
            dx[k] /= size;
        }
        let d: f64 = rest.iter().zip(&df).map(|(a, b)| a * b).sum();
        for k in 0..df.len() {
            rest[k] -= d * df[k];
            next[k] -= d * dx[k];
        }
        q.push((df, dx));
    }
    for k in 0..next.len() {
        next[k] += beta * rest[k];
    }
    next
}

#[test]
#[ignore = "scratch"]
fn bodies() {
    let env = |n: &str, d: f64| {
        std::env::var(n)
            .ok()
            .and_then(|v| v.parse().ok())
            .unwrap_or(d)
    };
    let k = env("K", 1.5e-13);
    let support = env("SUPPORT", 0.0) > 0.0;
    let surfaces = env("SURF", 1.0) > 0.0;
    let mut rig = Rig {
        elasticity: Elasticity::Layer {
            thickness: k,
            modulus: 1.0,
            poisson: 0.0,
        },
        cells: [env("NX", 64.0) as usize, env("NZ", 16.0) as usize],
        ..Rig::as_stated()
    };
    if surfaces {
        if let Finish::Rough(rough) = &mut rig.finish {
            rough.roughness.journal = 0.20e-6;
            rough.roughness.shell = 0.34e-6;
            if let ContactLaw::GreenwoodTripp(law) = &mut rough.contact {
                law.summit_height = 0.6e-6;
                law.summit_roughness = Some(0.13e-6_f64.hypot(0.28e-6));
            }
        }
    }
    let steel = || Body {
        modulus: 210e9,
        poisson: 0.3,
    };
    let rod = Body {
        modulus: 70e9,
        poisson: 0.3,
    };
    let groove = FeedShape::Rectangle {
        length: 0.5 * PI * 54e-3,
        width: 5e-3,
    };
    let (plain, bodies, load) = if support {
        (
            rig.bearing(54e-3, 25e-3, groove),
            Bodies::new(27e-3, 25e-3, steel(), steel(), 24),
            4e3,
        )
    } else {
        (
            rig.bearing(47.8e-3, 17.2e-3, FeedShape::Hole { diameter: 5e-3 }),
            Bodies::new(23.9e-3, 17.2e-3, steel(), rod, 24),
            8e3,
        )
    };
    let c = plain.radial_clearance;
    let mut at = [0.3 * c, 0.4 * c];
    let speed = 3000.0 * PI / 30.0;
    let mut film = FilmSolver::aligned(&plain, &rig.oil, rig.cells).unwrap();
    for share in [0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0] {
        if walk(&mut film, &mut at, load * share, speed, c).is_none() {
            println!("load {share} failed");
            return;
        }
    }
    let field = film.field().unwrap();
    println!("grid {} {}", field.angles.len(), field.axial.len());
    let angles = field.angles.to_vec();
    let axial = field.axial.to_vec();
    let mut x = vec![0.0; angles.len() * axial.len()];
    for rpm in [3000.0, 1000.0, 500.0, 400.0, 300.0, 250.0, 200.0, 150.0] {
        let speed = rpm * PI / 30.0;
        let (mut xs, mut fs): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (vec![], vec![]);
        let mut last = String::new();
        for it in 0..60 {
            let mut bearing = plain.clone();
            bearing.bore = Shape {
                features: vec![Feature::Table(
                    ProfileTable::new(angles.clone(), axial.clone(), x.clone()).unwrap(),
                )],
            };
            let mut film = FilmSolver::aligned(&bearing, &rig.oil, rig.cells).unwrap();
            let mut here = at;
            if walk(&mut film, &mut here, load, speed, c).is_none() {
                here = [0.3 * c, 0.4 * c];
                let mut good = true;
                for share in [0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0] {
                    if walk(&mut film, &mut here, load * share, speed, c).is_none() {
                        println!("it {it} load {share} failed");
                        good = false;
                        break;
                    }
                }
                if !good {
                    return;
                }
            }
            at = here;
            let state = JournalState {
                position: at,
                journal_speed: speed,
                ..JournalState::default()
            };
            let seen = film
                .react(
                    &state,
                    Step::Steady,
                    &Conditions {
                        temperature: 373.15,
                        feed_pressures: None,
                    },
                )
                .unwrap();
            let s = film.summary();
            let [cx, cy] = seen.reaction.contact_force;
            let field = film.field().unwrap();
            let to = bodies.correct(&field, k);
            let f: Vec<f64> = to.iter().zip(&x).map(|(a, b)| a - b).collect();
            let change = f.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            last = format!(
                "rpm {rpm} it {it} change {:.1e} torque {:.4} contact {:.3} hmin {:.3} eps {:.3} p {:.1}",
                change,
                seen.reaction.friction_torque_journal,
                cx.hypot(cy) / load,
                s.minimum_film_thickness.value * 1e6,
                at[0].hypot(at[1]) / c,
                s.peak_film_pressure.value * 1e-6
            );
            if std::env::var("VERBOSE").is_ok() {
                println!("   {last}");
            }
            if change < 3e-9 {
                break;
            }
            xs.push(x.clone());
            fs.push(f);
            if xs.len() > 9 {
                xs.remove(0);
                fs.remove(0);
            }
            x = anderson(&xs, &fs, 0.7);
        }
        println!("{last}");
    }
}
