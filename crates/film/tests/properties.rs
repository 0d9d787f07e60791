//! Any valid bearing gives a finite film or a named outcome: random bearings with fixed seeds.
//!
//! `SOMMERFELD_RANDOM_BEARINGS=10000 cargo test --test properties` runs more of them.
#![allow(
    clippy::unwrap_used,
    reason = "a test may stop at what it does not expect"
)]

mod common;

use common::{conditions, oil};
use sommerfeld_film::narrowest::GapSearch;
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Ends, Feature, Feed, FeedLine, FeedShape, FilmForce, FilmShear,
    FilmSolver, Inlet, JournalState, Outcome, ReliefForm, Shape, Step,
};
use std::f64::consts::TAU;

/// Splitmix64: a few lines, the same numbers everywhere.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[(self.unit() * from.len() as f64) as usize]
    }
}

fn random_feed(random: &mut Random, bearing: &Bearing) -> Feed {
    let (d, b) = (bearing.diameter, bearing.width);
    let shape = match random.pick(&[0, 1, 2]) {
        0 => FeedShape::Hole {
            diameter: random.between(0.02, 0.2) * d.min(b),
        },
        1 => FeedShape::Rectangle {
            length: random.between(0.02, 0.3) * d,
            width: random.between(0.2, 0.9) * b,
        },
        _ => FeedShape::Circumferential {
            width: random.between(0.05, 0.3) * b,
        },
    };
    Feed {
        shape,
        carried_by: random.pick(&[Carrier::Shell, Carrier::Journal]),
        angle: random.between(0.0, TAU),
        position: random.between(-0.2, 0.2) * b,
        pressure: random.pick(&[0.0, 1e5, 5e5, 20e5]),
        line: FeedLine::Direct,
    }
}

fn random_bearing(random: &mut Random) -> Bearing {
    let diameter = 10_f64.powf(random.between(-2.0, 0.0));
    let mut bearing = Bearing {
        diameter,
        width: diameter / 10_f64.powf(random.between(-0.602, 1.0)),
        radial_clearance: 0.5 * diameter * random.between(2e-4, 3e-3),
        bore: Shape::cylindrical(),
        journal: Shape::cylindrical(),
        feeds: Vec::new(),
        ambient_pressure: random.pick(&[0.0, 0.0, 1e5]),
        cavitation_pressure: random.pick(&[0.0, 0.0, -0.5e5]),
        ends: random.pick(&[Ends::Air, Ends::Flooded]),
        inlet: Inlet::Cyclic,
        cavitation: random.pick(&[
            Cavitation::Gumbel,
            Cavitation::Reynolds,
            Cavitation::MassConserving,
            Cavitation::MassConserving,
        ]),
        film_shear: FilmShear::FullWidth,
        finish: sommerfeld_film::Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
    };
    match random.pick(&[0, 1, 1, 2, 3, 4]) {
        0 => {
            bearing.inlet = Inlet::MaxFilmLine {
                pressure: random.pick(&[0.0, 2e5]),
            };
        }
        // No supply at all.
        4 => {}
        count => {
            for _ in 0..count {
                let feed = random_feed(random, &bearing);
                bearing.feeds.push(feed);
            }
        }
    }
    bearing
}

/// A feature no deeper than half the clearance; one that is alike all around where the inlet follows
/// the line of the widest gap.
fn random_feature(random: &mut Random, bearing: &Bearing) -> Feature {
    let half_width = 0.5 * bearing.width;
    let depth = random.between(0.02, 0.5) * bearing.radial_clearance;
    let joint = random.between(0.0, TAU);
    let kinds: &[u8] = match bearing.inlet {
        Inlet::Cyclic => &[0, 1, 2, 3, 4, 5],
        Inlet::MaxFilmLine { .. } => &[0, 1],
    };
    match random.pick(kinds) {
        0 => Feature::Crowning {
            end_offset: random.pick(&[-1.0, 1.0]) * depth,
            half_width,
        },
        1 => Feature::EndRelief {
            end: random.pick(&[-1.0, 1.0]) * half_width,
            length: random.between(0.05, 0.9) * half_width,
            end_offset: random.pick(&[-1.0, 1.0]) * depth,
            form: random.pick(&[ReliefForm::Linear, ReliefForm::Circular]),
        },
        2 => Feature::Lemon {
            shift: depth,
            joint,
        },
        3 => Feature::OffsetHalves {
            shift: depth,
            joint,
        },
        4 => Feature::JointRelief {
            offset: depth,
            half_span: random.between(0.05, 0.8),
            joint,
        },
        _ => Feature::Harmonic {
            order: random.pick(&[1, 2, 3, 5, 8]),
            amplitude: 0.5 * depth,
            phase: joint,
        },
    }
}

/// Puts lines before some feeds, and makes bores and journals of many bearings no cylinders.
fn complete(random: &mut Random, bearing: &mut Bearing) {
    for feed in &mut bearing.feeds {
        if random.unit() < 0.5 {
            let resistance = 10_f64.powf(random.between(8.0, 14.0));
            feed.line = FeedLine::Resistive { resistance };
        }
    }
    let of_bore = random.pick(&[0, 0, 1, 2]);
    let features: Vec<Feature> = (0..of_bore)
        .map(|_| random_feature(random, bearing))
        .collect();
    let of_journal = random.pick(&[0, 0, 0, 1]);
    let waves: Vec<Feature> = (0..of_journal)
        .map(|_| random_feature(random, bearing))
        .collect();
    bearing.bore = Shape::of(features);
    // Those two are features of bores.
    let is_of_bores = |feature: &Feature| {
        matches!(
            feature,
            Feature::OffsetHalves { .. } | Feature::JointRelief { .. }
        )
    };
    let waves = waves.into_iter().filter(|wave| !is_of_bores(wave));
    bearing.journal = Shape::of(waves.collect::<Vec<_>>());
}

/// Draws the journal towards the centre until its gap is open everywhere; `false` where it fits not
/// even there.
fn fit(bearing: &Bearing, state: &mut JournalState) -> bool {
    let search = GapSearch::of(bearing);
    let is_open = |state: &JournalState| {
        search.narrowest(bearing, state).gap > 1e-3 * bearing.radial_clearance
    };
    for _ in 0..60 {
        if is_open(state) {
            return true;
        }
        state.position = state.position.map(|x| 0.9 * x);
        state.tilt = state.tilt.map(|t| 0.9 * t);
    }
    (state.position, state.tilt) = ([0.0; 2], [0.0; 2]);
    is_open(state)
}

/// Eccentricity up to 0.995, tilt up to 0.95 of contact, any direction of any motion.
fn random_state(random: &mut Random, bearing: &Bearing) -> JournalState {
    let c = bearing.radial_clearance;
    let polar = |r: f64, angle: f64| [r * angle.cos(), r * angle.sin()];
    let eccentricity = 0.995 * random.unit().sqrt();
    let position = polar(eccentricity * c, random.between(0.0, TAU));
    let direction = random.between(0.0, TAU);
    let mut state = JournalState {
        position,
        tilt: polar(2.0 * c / bearing.width, direction),
        ..JournalState::default()
    };
    // The largest factor that keeps both edges open, by bisection.
    let (mut open, mut closed) = (0.0, 2.0);
    for _ in 0..50 {
        let middle = 0.5 * (open + closed);
        let tilt = state.tilt.map(|t| t * middle);
        if bearing.minimum_gap(&JournalState { tilt, ..state }) > 0.0 {
            open = middle;
        } else {
            closed = middle;
        }
    }
    let share = random.pick(&[0.0, 0.3, 0.95]) * random.unit() * open;
    state.tilt = state.tilt.map(|t| t * share);
    let speed = random.pick(&[0.0, 1.0, 1.0, -1.0]) * 10_f64.powf(random.between(0.0, 3.0));
    state.journal_speed = speed;
    state.shell_speed = random.pick(&[0.0, 0.0, 0.5, -1.0]) * speed;
    let rate = random.pick(&[0.0, 0.1, 1.0, 10.0]) * speed.abs().max(1.0) * c;
    state.velocity = polar(rate, random.between(0.0, TAU));
    state.tilt_rate = polar(
        random.pick(&[0.0, 1.0]) * rate / bearing.width,
        random.between(0.0, TAU),
    );
    state.journal_angle = random.between(0.0, TAU);
    state
}

#[test]
fn random_bearings_give_a_film_or_a_named_outcome() {
    let count: u64 =
        std::env::var("SOMMERFELD_RANDOM_BEARINGS").map_or(2000, |v| v.parse().unwrap());
    let mut failures = Vec::new();
    let (mut starved, mut most) = (0, 0);
    for seed in 0..count {
        let mut random = Random(seed);
        let mut bearing = random_bearing(&mut random);
        let mut state = random_state(&mut random, &bearing);
        let cells = random.pick(&[[48, 12], [64, 16], [64, 16], [96, 16]]);
        complete(&mut random, &mut bearing);
        if !bearing.is_plain() && !fit(&bearing, &mut state) {
            continue;
        }
        let mut film = FilmSolver::new(&bearing, &oil(), cells).unwrap();
        let answer = film.react(&state, Step::Steady, &conditions()).unwrap();
        let summary = film.summary();
        match answer.outcome {
            Outcome::Starved => starved += 1,
            Outcome::Converged => {
                most = most.max(summary.iterations);
                let [x, y] = answer.reaction.force();
                assert!(x.is_finite() && y.is_finite(), "seed {seed}");
                let violation = summary.complementarity_violation;
                assert!(
                    violation == 0.0 || bearing.cavitation == Cavitation::Gumbel,
                    "seed {seed}: violation {violation:e}"
                );
                if bearing.cavitation != Cavitation::Gumbel && summary.cell_residual > 1e-10 {
                    failures.push(format!("seed {seed}: residual {:e}", summary.cell_residual));
                }
            }
            other => failures.push(format!(
                "seed {seed}: {other:?} after {} of {cells:?} {:?} {:?} feeds {}",
                summary.iterations,
                bearing.cavitation,
                bearing.ends,
                bearing.feeds.len()
            )),
        }
    }
    println!(
        "{count} bearings, {starved} starved, at most {most} updates, {} failures",
        failures.len()
    );
    for failure in &failures {
        println!("{failure}");
    }
    assert!(
        failures.len() as u64 * 200 <= count,
        "more than 0.5 % failed"
    );
}
