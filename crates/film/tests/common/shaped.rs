//! Shaped bearings that tests share, and what they compare.

use super::{big_end, conditions, feed_hole, oil};
use sommerfeld_film::{
    Bearing, Cavitation, Feature, FilmForce, FilmSolver, JournalState, Linearised, ProfileTable,
    ReliefForm, Shape, Step,
};
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// Of the oil in [`oil`].
pub const VISCOSITY: f64 = 8e-3;
pub const GRID: [usize; 2] = [96, 16];
/// Half the width of [`big_end`], m.
pub const HALF: f64 = 0.015;
pub const CLOSURES: [Cavitation; 3] = [
    Cavitation::Gumbel,
    Cavitation::Reynolds,
    Cavitation::MassConserving,
];

pub fn wave(order: u32, amplitude: f64, phase: f64) -> Feature {
    Feature::Harmonic {
        order,
        amplitude,
        phase,
    }
}

pub fn relief(end: f64, end_offset: f64, form: ReliefForm) -> Feature {
    Feature::EndRelief {
        end,
        length: 4e-3,
        end_offset,
        form,
    }
}

pub fn lemon(shift: f64, joint: f64) -> Feature {
    Feature::Lemon { shift, joint }
}

pub fn crowning(end_offset: f64) -> Feature {
    Feature::Crowning {
        end_offset,
        half_width: HALF,
    }
}

/// A smooth measured profile: a wave whose amplitude falls along the axis.
pub fn table() -> Feature {
    let n = 24;
    let angles: Vec<f64> = (0..n).map(|i| TAU * f64::from(i) / f64::from(n)).collect();
    let positions: Vec<f64> = (0..7).map(|k| -HALF + 5e-3 * f64::from(k)).collect();
    let offsets = angles
        .iter()
        .flat_map(|a| {
            positions
                .iter()
                .map(move |z| 2e-6 * (2.0 * a).sin() * (1.0 - 30.0 * z))
        })
        .collect();
    Feature::Table(ProfileTable::new(angles, positions, offsets).unwrap())
}

/// Shapes of every kind but steps, on either surface.
pub fn shaped() -> Bearing {
    Bearing {
        bore: Shape::of([
            lemon(14e-6, 0.5 * PI),
            crowning(4e-6),
            relief(HALF, 5e-6, ReliefForm::Linear),
            Feature::JointRelief {
                offset: 10e-6,
                half_span: FRAC_PI_4 / 4.0,
                joint: 0.5 * PI,
            },
            wave(3, 1.5e-6, 0.4),
            table(),
        ]),
        journal: Shape::of([
            wave(2, 2e-6, 0.3),
            wave(5, 0.7e-6, 1.0),
            relief(-HALF, -4e-6, ReliefForm::Circular),
        ]),
        ..big_end()
    }
}

/// The profiles of [`shaped`], written down once more, but for the interpolation of the table.
pub fn bore_offset(angle: f64, z: f64) -> f64 {
    let lemon = 14e-6 * (1.0 - angle.cos().abs());
    let crown = 4e-6 * (z / HALF).powi(2);
    let taper = 5e-6 * ((z - 0.011) / 0.004).max(0.0);
    let apart = (angle - 0.5 * PI)
        .sin()
        .atan2((angle - 0.5 * PI).cos())
        .abs();
    let crush = 10e-6 * (1.0 - apart / (PI / 16.0)).max(0.0);
    let table = Shape::of([table()]).offset(angle, z);
    lemon + crown + taper + crush + 1.5e-6 * (3.0 * angle - 1.2).cos() + table
}

pub fn journal_offset(angle: f64, z: f64) -> f64 {
    let waves = 2e-6 * (2.0 * angle - 0.6).cos() + 0.7e-6 * (5.0 * angle - 5.0).cos();
    let arc = -4e-6 * ((-0.011 - z) / 0.004).max(0.0).powi(2);
    waves + arc
}

pub fn states() -> Vec<(&'static str, JournalState)> {
    let c = big_end().radial_clearance;
    let tilt = c / HALF;
    let base = JournalState {
        position: [0.5 * c, 0.3 * c],
        journal_speed: 210.0,
        journal_angle: 1.0,
        ..JournalState::default()
    };
    vec![
        ("aligned", base),
        (
            "everything",
            JournalState {
                tilt: [0.12 * tilt, -0.1 * tilt],
                velocity: [40.0 * c, -25.0 * c],
                tilt_rate: [30.0 * tilt, 20.0 * tilt],
                shell_speed: -40.0,
                ..base
            },
        ),
        (
            "backwards and opening",
            JournalState {
                position: [-0.3 * c, -0.5 * c],
                velocity: [5.0 * c, 30.0 * c],
                journal_speed: -150.0,
                shell_speed: 30.0,
                tilt: [-0.05 * tilt, 0.05 * tilt],
                ..base
            },
        ),
    ]
}

pub fn solve(bearing: &Bearing, state: &JournalState) -> (FilmSolver, Linearised) {
    solve_on(bearing, state, GRID)
}

pub fn solve_on(
    bearing: &Bearing,
    state: &JournalState,
    grid: [usize; 2],
) -> (FilmSolver, Linearised) {
    let mut film = FilmSolver::new(bearing, &oil(), grid).unwrap();
    let answer = film.react(state, Step::Steady, &conditions()).unwrap();
    assert!(answer.settled);
    (film, answer)
}

/// Largest difference of force and moment over their size.
pub fn deviation(a: [[f64; 2]; 2], b: &Linearised) -> f64 {
    let [f, m] = [b.reaction.film_force, b.reaction.film_moment];
    let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let force = f[0].hypot(f[1]);
    (apart(a[0], f) / force).max(apart(a[1], m) / (2.0 * HALF * force))
}

pub fn answers(answer: &Linearised) -> [[f64; 2]; 2] {
    [answer.reaction.film_force, answer.reaction.film_moment]
}

pub fn bearing_at(bearing: &Bearing, cavitation: Cavitation) -> Bearing {
    Bearing {
        cavitation,
        feeds: vec![feed_hole()],
        ..bearing.clone()
    }
}
