//! The on-line film against a direct solution, the film on a grid, closed forms and identities.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "helpers of tests stop at the first surprise; --nocapture shows the figures"
)]

mod common;

use common::conditions;
use common::direct::gumbel_force;
use sommerfeld_film::closed_form::infinitely_long;
use sommerfeld_film::dimensionless::{DimensionlessFilm, refine_dimensionless};
use sommerfeld_film::spectral::{AlignedFilm, Precision};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Feed, FeedLine, FeedShape, FilmError, FilmForce, FilmShear,
    FilmSolver, Inlet, JournalState, Linearised, OnlineFilm, Outcome, ShortBearingFilm, Step,
};
use sommerfeld_oil::{CompressionLaw, Lubricant, PressureLaw};
use std::f64::consts::{PI, TAU};

const VISCOSITY: f64 = 8e-3;
const SPEED: f64 = 200.0;

fn bearing(width_ratio: f64, cavitation: Cavitation) -> Bearing {
    Bearing {
        width: 0.072 * width_ratio,
        cavitation,
        film_shear: FilmShear::FullWidth,
        ..common::big_end()
    }
}

fn oil() -> Lubricant {
    Lubricant::constant(VISCOSITY, 850.0)
}

fn online(bearing: &Bearing) -> OnlineFilm {
    OnlineFilm::aligned(bearing, &oil()).expect("a plain bearing")
}

fn react(film: &mut impl FilmForce, state: &JournalState) -> Linearised {
    let seen = film.react(state, Step::Steady, &conditions());
    seen.expect("an open gap")
}

/// Journal at `eps` in the direction `place` with the effective velocity `SPEED` times `motion` radial
/// clearances, which stands at the angle `direction` to the line of centres; shell and journal turn.
fn moving(bearing: &Bearing, eps: f64, place: f64, direction: f64) -> JournalState {
    let c = bearing.radial_clearance;
    let mut state = JournalState {
        position: [eps * c * place.cos(), eps * c * place.sin()],
        journal_speed: 0.7 * SPEED,
        shell_speed: -0.1 * SPEED,
        ..JournalState::default()
    };
    let mean = state.mean_speed();
    let [x, y] = state.position;
    let (sin, cos) = (place + direction).sin_cos();
    state.velocity = [SPEED * c * cos - mean * y, SPEED * c * sin + mean * x];
    state
}

fn size([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

fn difference(a: [f64; 2], b: [f64; 2]) -> f64 {
    size([a[0] - b[0], a[1] - b[1]])
}

/// The bars are those that `OnlineFilm::aligned` states.
#[test]
fn half_film_has_the_force_of_a_direct_solution() {
    for width_ratio in [0.25, 0.75, 1.5] {
        let bearing = bearing(width_ratio, Cavitation::Gumbel);
        let mut film = online(&bearing);
        let c = bearing.radial_clearance;
        let unit = 12.0
            * VISCOSITY
            * (bearing.radius() / c).powi(2)
            * bearing.radius().powi(2)
            * width_ratio
            * SPEED;
        for (eps, n, bar) in [
            (0.0, 512, 4e-5),
            (0.6, 1024, 4e-5),
            (0.95, 4096, 4e-5),
            (0.99, 8192, 1.5e-4),
        ] {
            for direction in [0.2, 1.6, 3.3, 4.4] {
                let state = moving(&bearing, eps, 2.0, direction);
                let seen = react(&mut film, &state).reaction.film_force;
                let (sin, cos) = direction.sin_cos();
                let exact = gumbel_force(width_ratio, eps, [cos, sin], n).map(|f| unit * f);
                let along = [2.0_f64.cos(), 2.0_f64.sin()];
                let local = [
                    seen[0] * along[0] + seen[1] * along[1],
                    seen[1] * along[0] - seen[0] * along[1],
                ];
                let error = difference(local, exact) / size(exact);
                println!("B/D {width_ratio} eps {eps} direction {direction}: {error:.1e}");
                assert!(
                    error < bar,
                    "B/D {width_ratio} eps {eps} direction {direction}: {error}"
                );
            }
        }
    }
}

/// The derivative at 0, by two central differences extrapolated to order four (Richardson).
fn slope(step: f64, mut force: impl FnMut(f64) -> [f64; 2]) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (by, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
        let force = force(by * step);
        for row in 0..2 {
            sum[row] += weight / (12.0 * step) * force[row];
        }
    }
    sum
}

/// Derivatives of the discrete force, by differences of the force itself: over force over gap by position,
/// over force over motion by rate.
fn compare_tangents(bearing: &Bearing, eps: f64, directions: usize, step: f64, bar: f64) {
    let mut film = online(bearing);
    let mut worst = [0.0_f64; 2];
    let c = bearing.radial_clearance;
    for k in 0..directions {
        let direction = 0.1 + TAU * k as f64 / directions as f64;
        let state = moving(bearing, eps, 0.3 + 1.9 * k as f64, direction);
        let seen = react(&mut film, &state);
        let force = size(seen.reaction.film_force);
        let units = [(1.0 - eps) * c, SPEED * c];
        let tangents = [seen.tangent.by_position, seen.tangent.by_rate];
        for (kind, (unit, tangent)) in units.into_iter().zip(tangents).enumerate() {
            for column in 0..2 {
                let expected = slope(step, |by| {
                    let mut moved = state;
                    match kind {
                        0 => moved.position[column] += by * unit,
                        _ => moved.velocity[column] += by * unit,
                    }
                    react(&mut film, &moved).reaction.film_force
                });
                let [along, across, ..] = tangent.map(|row| row[column] * unit);
                let found = [along, across];
                worst[kind] = worst[kind].max(difference(found, expected) / force);
            }
        }
        let width_ratio = bearing.width / bearing.diameter;
        assert!(
            worst[0].max(worst[1]) < bar,
            "B/D {width_ratio:.2} eps {eps} direction {direction}: {worst:?}"
        );
    }
    println!("eps {eps}: {:.1e}, {:.1e}", worst[0], worst[1]);
}

#[test]
fn tangents_of_the_half_film_equal_differences() {
    for width_ratio in [0.4, 1.0] {
        for eps in [0.0, 0.2, 0.7, 0.93] {
            compare_tangents(
                &bearing(width_ratio, Cavitation::Gumbel),
                eps,
                6,
                1e-5,
                1e-6,
            );
        }
    }
}

/// With fronts that follow the journal, held ones being 1e-4 to 1e-3 off.
#[test]
fn tangents_of_the_fitted_film_equal_differences() {
    for width_ratio in [0.25, 0.5, 0.75, 1.0, 1.5] {
        println!("B/D {width_ratio}");
        for eps in [0.0, 0.2, 0.6, 0.8, 0.9, 0.95, 0.99] {
            let bearing = bearing(width_ratio, Cavitation::Reynolds);
            compare_tangents(&bearing, eps, 12, 1e-3, 1e-6);
        }
    }
}

/// A film that knows a neighbour's fronts settles where one that knows none does.
#[test]
fn forces_of_the_fitted_film_do_not_remember() {
    for width_ratio in [0.25, 0.6, 1.5] {
        let new = || AlignedFilm::new(Cavitation::Reynolds, width_ratio, Precision::OnLine);
        let mut warm = new().expect("a plain film");
        for k in 0..120 {
            let share = f64::from(k) / 120.0;
            let (eps, direction) = (0.5 + 0.45 * (3.0 * TAU * share).sin(), TAU * share);
            let motion = [direction.cos(), direction.sin()];
            let (seen, _) = warm.force(eps, motion).expect("open");
            let mut cold = new().expect("a plain film");
            let (expected, outcome) = cold.force(eps, motion).expect("open");
            assert_eq!(outcome, Outcome::Converged);
            let off = difference(seen.force, expected.force) / size(expected.force);
            assert!(off < 1e-8, "B/D {width_ratio} eps {eps} {direction}: {off}");
        }
    }
}

/// Rows of an independent solver; the bar is that of the table.
#[test]
fn fitted_film_meets_wedge_and_squeeze_together() {
    let rows = common::reference_rows("combined-wedge-squeeze", "reference.csv");
    assert!(!rows.is_empty());
    for row in rows {
        let (d_over_b, eps, ratio) = (row[0], row[1], row[2]);
        let exact = [row[3], row[4]];
        for precision in [Precision::OnLine, Precision::Fine] {
            let mut film = AlignedFilm::new(Cavitation::Reynolds, 1.0 / d_over_b, precision)
                .expect("a plain film");
            let (seen, outcome) = film.scaled_force(eps, [2.0 * ratio, 1.0]).expect("open");
            assert_eq!(outcome, Outcome::Converged);
            let error = difference(seen.force, exact) / size(exact);
            println!("D/B {d_over_b} eps {eps} q {ratio} {precision:?}: {error:.1e}");
            assert!(
                error < 1.5e-3,
                "D/B {d_over_b} eps {eps} q {ratio}: {error}"
            );
        }
    }
}

/// The film on a grid, extrapolated, with the error it states.
#[test]
fn fitted_film_has_the_force_of_a_grid() {
    for (width_ratio, eps, squeeze, wedge) in [
        (0.25, 0.9, 0.0, 1.0),
        (0.5, 0.1, 0.3, 1.0),
        (0.75, 0.6, -0.2, 1.0),
        (0.75, 0.95, 0.02, 1.0),
        (1.5, 0.6, -1.0, 0.0),
    ] {
        let problem = DimensionlessFilm {
            d_over_b: 1.0 / width_ratio,
            relative_eccentricity: eps,
            tilt_gamma: 0.0,
            tilt_delta: 0.0,
            wedge,
            squeeze,
            cavitation: Cavitation::Reynolds,
            inlet: Inlet::Cyclic,
        };
        let grid = refine_dimensionless(&problem, [96, 24], 3e-4).expect("open");
        assert_eq!(grid.outcome, Outcome::Converged);
        let exact = [grid.integrals.p_cos, grid.integrals.p_sin];
        let known = size([grid.error.p_cos, grid.error.p_sin]) / size(exact);
        for (precision, bar) in [(Precision::OnLine, 6e-5), (Precision::Fine, 2e-5)] {
            let mut film =
                AlignedFilm::new(Cavitation::Reynolds, width_ratio, precision).expect("plain");
            let (seen, _) = film
                .scaled_force(eps, [2.0 * squeeze, wedge])
                .expect("open");
            let error = difference(seen.force, exact) / size(exact);
            println!("B/D {width_ratio} eps {eps} {precision:?}: {error:.1e}, grid {known:.1e}");
            assert!(
                error < known + bar,
                "B/D {width_ratio} eps {eps}: {error} {known}"
            );
        }
    }
}

/// The bars of `OnlineFilm::aligned` and of `Precision::Fine`, over all directions: the fine film is
/// within 2e-5 of a finer one (`fitted_film` tests), the film on line close to the fine one.
#[test]
fn on_line_and_fine_films_agree() {
    for cavitation in [Cavitation::Gumbel, Cavitation::Reynolds] {
        for width_ratio in [0.25, 0.5, 0.75, 1.0, 1.5] {
            let new = |precision| {
                AlignedFilm::new(cavitation, width_ratio, precision).expect("a plain film")
            };
            let (mut film, mut fine) = (new(Precision::OnLine), new(Precision::Fine));
            for eps in [0.0, 0.3, 0.6, 0.8, 0.9, 0.95, 0.99] {
                let mut worst = 0.0_f64;
                for k in 0..24 {
                    let direction = 0.1 + TAU * f64::from(k) / 24.0;
                    let motion = [direction.cos(), direction.sin()];
                    let (seen, outcome) = film.force(eps, motion).expect("open");
                    let (exact, fine_outcome) = fine.force(eps, motion).expect("open");
                    assert_eq!(outcome, Outcome::Converged, "{eps} {direction}");
                    assert_eq!(fine_outcome, Outcome::Converged, "{eps} {direction}");
                    worst = worst.max(difference(seen.force, exact.force) / size(exact.force));
                }
                println!("{cavitation:?} B/D {width_ratio} eps {eps}: {worst:.1e}");
                let bar = match cavitation {
                    Cavitation::Gumbel if eps < 0.96 => 4e-5,
                    Cavitation::Gumbel => 1.5e-4,
                    _ if eps < 0.96 => 4e-5,
                    _ => 6e-5,
                };
                assert!(
                    worst < bar,
                    "{cavitation:?} B/D {width_ratio} eps {eps}: {worst}"
                );
            }
        }
    }
}

/// Derivatives of the scaled force by its own variables.
#[test]
fn scaled_derivatives_equal_differences() {
    let mut film =
        AlignedFilm::new(Cavitation::Gumbel, 0.5, Precision::OnLine).expect("a plain film");
    let (eps, motion) = (0.7, [0.3, 1.2]);
    let mut force = |eps: f64, motion: [f64; 2]| film.scaled_force(eps, motion).expect("open").0;
    let seen = force(eps, motion);
    let h = 1e-5;
    let slope = |plus: [f64; 2], minus: [f64; 2]| [0, 1].map(|i| (plus[i] - minus[i]) / (2.0 * h));
    let by_eps = slope(force(eps + h, motion).force, force(eps - h, motion).force);
    assert!(difference(by_eps, seen.by_eccentricity) < 1e-6 * size(by_eps));
    for column in 0..2 {
        let at = |sign: f64| {
            let mut moved = motion;
            moved[column] += sign * h;
            moved
        };
        let by_motion = slope(force(eps, at(1.0)).force, force(eps, at(-1.0)).force);
        let expected = seen.by_motion.map(|row| row[column]);
        assert!(difference(by_motion, expected) < 1e-6 * size(seen.force));
    }
}

/// Every figure of the summary, with the limit of three grids.
fn compare_figures(cavitation: Cavitation, states: &[(f64, f64)], bar: f64) {
    let bearing = bearing(0.5, cavitation);
    let mut film = online(&bearing);
    for &(eps, direction) in states {
        let state = moving(&bearing, eps, 0.8, direction);
        let seen = react(&mut film, &state);
        let summary = film.summary();
        let mut grid =
            FilmSolver::following(&bearing, &oil(), [256, 96], 0.8 * eps).expect("a plain bearing");
        let by_grid = react(&mut grid, &state);
        let expected = grid.summary();
        let close = |name: &str, a: f64, b: f64, scale: f64| {
            let off = (a - b).abs() / scale;
            println!("eps {eps} direction {direction} {name}: {off:.1e}");
            assert!(off < bar, "eps {eps} direction {direction} {name}: {a} {b}");
        };
        let peak = [summary.peak_film_pressure, expected.peak_film_pressure];
        close("peak", peak[0].value, peak[1].value, peak[1].value);
        let turn = (peak[0].angle - peak[1].angle) / TAU;
        close("peak angle", (turn - turn.round()) * TAU, 0.0, 1.0);
        close("peak place", peak[0].axial, peak[1].axial, bearing.width);
        let flow = [summary.side_flow, expected.side_flow];
        close("flow", flow[0][0], flow[1][0], flow[1][0]);
        close("flow", flow[0][1], flow[1][1], flow[1][1]);
        let share = [summary.full_film_share, expected.full_film_share];
        // A grid counts cells: of two fronts, each may be off by one.
        let cells = (share[0] - share[1]).abs() * 256.0;
        assert!(
            cells < 2.0,
            "eps {eps} direction {direction} share: {share:?}"
        );
        let least = [
            summary.minimum_film_thickness,
            expected.minimum_film_thickness,
        ];
        close("film", least[0].value, least[1].value, least[1].value);
        close("film angle", least[0].angle, least[1].angle, 1.0);
        close("film place", least[0].axial, least[1].axial, bearing.width);
        let edges = [summary.edge_film_thickness, expected.edge_film_thickness];
        close("edge", edges[0][0], edges[1][0], edges[1][0]);
        let power = [summary.friction_power, expected.friction_power];
        close("friction", power[0], power[1], power[1]);
        let squeeze = [summary.squeeze_power, expected.squeeze_power];
        close(
            "squeeze",
            squeeze[0],
            squeeze[1],
            power[1].max(squeeze[1].abs()),
        );
        let torque = [seen, by_grid].map(|seen| seen.reaction.friction_torque_shell);
        close("torque", torque[0], torque[1], torque[1]);
        close(
            "Re",
            summary.reynolds_number,
            expected.reynolds_number,
            expected.reynolds_number,
        );
        let balance = [
            summary.mass_balance_relative,
            expected.mass_balance_relative,
        ];
        close("balance", balance[0], balance[1], 1.0);
    }
}

#[test]
fn figures_of_the_half_film_are_those_of_a_grid() {
    let states = [(0.3, 0.5), (0.6, 4.7), (0.9, 4.7), (0.9, 5.8), (0.8, 2.8)];
    compare_figures(Cavitation::Gumbel, &states, 3e-3);
}

#[test]
fn figures_of_the_fitted_film_are_those_of_a_grid() {
    let states = [(0.3, 0.5), (0.6, 4.7), (0.9, 4.7), (0.9, 5.8), (0.8, 2.8)];
    compare_figures(Cavitation::Reynolds, &states, 3e-3);
}

#[test]
fn force_is_homogeneous_mirrored_and_turns_with_the_frame() {
    // Fronts are settled to a tolerance.
    for (cavitation, exact) in [(Cavitation::Gumbel, 1e-11), (Cavitation::Reynolds, 1e-8)] {
        compare_motions(&bearing(0.5, cavitation), exact);
    }
}

fn compare_motions(bearing: &Bearing, exact: f64) {
    let mut film = online(bearing);
    for (eps, direction) in [(0.0, 1.0), (0.5, 2.0), (0.9, 4.0), (0.95, 0.3)] {
        let state = moving(bearing, eps, 0.3, direction);
        let force = react(&mut film, &state).reaction.film_force;
        let bar = exact * size(force);
        let faster = JournalState {
            velocity: state.velocity.map(|v| 3.0 * v),
            journal_speed: 3.0 * state.journal_speed,
            shell_speed: 3.0 * state.shell_speed,
            ..state
        };
        let seen = react(&mut film, &faster).reaction.film_force;
        assert!(difference(seen, force.map(|f| 3.0 * f)) < 3.0 * bar);
        let mirrored = JournalState {
            position: [state.position[0], -state.position[1]],
            velocity: [state.velocity[0], -state.velocity[1]],
            journal_speed: -state.journal_speed,
            shell_speed: -state.shell_speed,
            ..state
        };
        let seen = react(&mut film, &mirrored).reaction.film_force;
        assert!(difference(seen, [force[0], -force[1]]) < bar);
        for place in [1.9, 3.6, 5.5] {
            let seen = react(&mut film, &moving(bearing, eps, place, direction));
            let (sin, cos) = f64::sin_cos(place - 0.3);
            let turned = [
                cos * force[0] - sin * force[1],
                sin * force[0] + cos * force[1],
            ];
            // The pressures of a journal in the centre are cut a hair off, between other nodes.
            let bar = if eps == 0.0 {
                bar.max(1e-6 * size(force))
            } else {
                bar
            };
            assert!(
                difference(seen.reaction.film_force, turned) < bar,
                "{eps} {place}"
            );
        }
    }
}

/// Power goes into the film, whatever the motion; what a motion along one axis does along another, the
/// other does along the one, where the film is between fronts that it chose.
#[test]
fn motion_is_resisted_and_reciprocal() {
    for cavitation in [Cavitation::Gumbel, Cavitation::Reynolds] {
        let bearing = bearing(0.6, cavitation);
        let mut film = online(&bearing);
        for eps in [0.0, 0.4, 0.8, 0.97] {
            for k in 0..24 {
                let direction = TAU * f64::from(k) / 24.0;
                let state = moving(&bearing, eps, 0.0, direction);
                let seen = react(&mut film, &state);
                let [x, y] = seen.reaction.film_force;
                let power = x * direction.cos() + y * direction.sin();
                assert!(power < 0.0, "{eps} {direction}: {power}");
                let rate = seen.tangent.by_rate;
                if cavitation == Cavitation::Reynolds {
                    let largest = rate[0][0].abs().max(rate[1][1].abs());
                    let off = (rate[0][1] - rate[1][0]).abs() / largest;
                    assert!(off < 5e-4, "{eps} {direction}: {off}");
                }
            }
        }
    }
}

#[test]
fn narrow_bearings_tend_to_the_short_one() {
    for cavitation in [Cavitation::Gumbel, Cavitation::Reynolds] {
        tends_to_short(cavitation);
    }
}

fn tends_to_short(cavitation: Cavitation) {
    let error = |width_ratio: f64| {
        let bearing = bearing(width_ratio, cavitation);
        let mut film = online(&bearing);
        let mut short = ShortBearingFilm::new(&bearing, VISCOSITY).expect("a plain bearing");
        let states = [(0.5, 4.7), (0.8, 0.6), (0.8, 3.0)];
        let worst = states.map(|(eps, direction)| {
            let state = moving(&bearing, eps, 1.1, direction);
            let exact = react(&mut short, &state).reaction.film_force;
            difference(react(&mut film, &state).reaction.film_force, exact) / size(exact)
        });
        worst.into_iter().fold(0.0, f64::max)
    };
    let (narrow, narrower) = (error(0.06), error(0.03));
    assert!(narrower < 5e-3, "{narrower}");
    assert!(
        narrow / narrower > 3.5,
        "quadratic in B/D: {narrow} {narrower}"
    );
}

#[test]
fn wide_bearings_tend_to_the_infinitely_long_one() {
    let eps = 0.6;
    let error = |width_ratio: f64| {
        let bearing = bearing(width_ratio, Cavitation::Gumbel);
        let state = JournalState {
            position: [eps * bearing.radial_clearance, 0.0],
            journal_speed: SPEED,
            ..JournalState::default()
        };
        let seen = react(&mut online(&bearing), &state).reaction.film_force;
        let unit = VISCOSITY * SPEED * bearing.diameter * bearing.width
            / (4.0 * bearing.relative_clearance().powi(2));
        let long = infinitely_long::gumbel(eps);
        let exact = [long.force_along, long.force_across].map(|f| 2.0 * unit * f);
        difference(seen, exact) / size(exact)
    };
    let (wide, wider) = (error(10.0), error(20.0));
    assert!(wider < 0.06, "{wider}");
    assert!(
        wide / wider > 1.8,
        "the ends take a share that falls with the width: {wide} {wider}"
    );
}

#[test]
fn what_it_does_not_have_is_refused_by_name() {
    let plain = bearing(0.5, Cavitation::Gumbel);
    let refused = |bearing: &Bearing, oil: &Lubricant, word: &str| {
        let message = OnlineFilm::aligned(bearing, oil)
            .expect_err(word)
            .to_string();
        assert!(message.contains(word), "{message}");
    };
    let with = |change: &dyn Fn(&mut Bearing)| {
        let mut changed = plain.clone();
        change(&mut changed);
        changed
    };
    refused(&with(&|b| b.ambient_pressure = 1e5), &oil(), "ambient");
    refused(
        &with(&|b| b.cavitation_pressure = -5e4),
        &oil(),
        "cavitation pressure",
    );
    refused(
        &with(&|b| b.cavitation = Cavitation::MassConserving),
        &oil(),
        "remembers",
    );
    refused(&with(&|b| b.width = 0.0), &oil(), "positive");
    refused(&bearing(2.1, Cavitation::Reynolds), &oil(), "twice as wide");
    let hole = Feed {
        shape: FeedShape::Hole { diameter: 6e-3 },
        carried_by: Carrier::Shell,
        angle: PI,
        position: 0.0,
        pressure: 0.0,
        line: FeedLine::Direct,
    };
    refused(&with(&|b| b.feeds.push(hole.clone())), &oil(), "grooves");
    let thick = Lubricant {
        viscosity_pressure: PressureLaw::Barus { alpha: 2e-8 },
        ..oil()
    };
    refused(&plain, &thick, "thickens");
    let dense = Lubricant {
        density_pressure: CompressionLaw::DowsonHigginson,
        ..oil()
    };
    refused(&plain, &dense, "compressed");
    let mut film = online(&plain);
    let tilted = JournalState {
        tilt: [1e-5, 0.0],
        ..moving(&plain, 0.5, 0.0, 0.0)
    };
    let seen = film.linearise(&tilted, Step::Steady, &conditions());
    assert_eq!(seen.expect_err("tilt"), FilmError::NoTilt);
    let touching = moving(&plain, 1.0, 0.5, 0.0);
    let seen = film.linearise(&touching, Step::Steady, &conditions());
    assert!(matches!(seen, Err(FilmError::Contact { .. })), "{seen:?}");
    let broken = JournalState {
        velocity: [f64::NAN, 0.0],
        ..moving(&plain, 0.5, 0.0, 0.0)
    };
    let seen = film.linearise(&broken, Step::Steady, &conditions());
    assert!(matches!(seen, Err(FilmError::NotFinite { .. })), "{seen:?}");
}
