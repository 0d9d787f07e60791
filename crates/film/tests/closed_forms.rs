//! Closed forms against tables computed from the formulas by separate code.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use sommerfeld_film::closed_form::{infinitely_long, short};
use sommerfeld_film::{
    Bearing, Cavitation, Conditions, Ends, FilmForce, FilmShear, Inlet, JournalState,
    LongBearingFilm, MobilityFilm, Shape, ShortBearingFilm, Step,
};

const CONDITIONS: Conditions<'static> = Conditions {
    temperature: 373.0,
    feed_pressures: None,
};
const VISCOSITY: f64 = 0.01;

fn bearing() -> Bearing {
    Bearing {
        diameter: 0.05,
        width: 0.02,
        radial_clearance: 25e-6,
        bore: Shape::cylindrical(),
        journal: Shape::cylindrical(),
        feeds: Vec::new(),
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Air,
        inlet: Inlet::Cyclic,
        cavitation: Cavitation::Gumbel,
        film_shear: FilmShear::FullWidth,
        finish: sommerfeld_film::Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
    }
}

/// Data rows of a reference table: comments and the header left out.
fn rows(case: &str) -> Vec<Vec<String>> {
    let path = format!(
        "{}/../../validation/{case}/reference.csv",
        env!("CARGO_MANIFEST_DIR")
    );
    std::fs::read_to_string(path)
        .unwrap()
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| {
            line.split(',')
                .map(|cell| cell.trim().to_string())
                .collect()
        })
        .collect()
}

fn number(cell: &str) -> f64 {
    cell.parse().unwrap()
}

/// Within 1e-6 of `scale`, or half a last digit of the eight printed ones.
fn close(value: f64, reference: f64, scale: f64, what: &str) {
    assert!(
        (value - reference).abs() <= 1e-6 * scale.abs().max(reference.abs()),
        "{what}: {value} instead of {reference}"
    );
}

#[test]
fn infinitely_long_bearing() {
    let table = rows("infinitely-long-bearing");
    assert!(table.len() > 20);
    for row in table {
        let eps = number(&row[1]);
        let film = match row[0].as_str() {
            "full_sommerfeld" => infinitely_long::full_sommerfeld(eps),
            "gumbel_half_sommerfeld" => infinitely_long::gumbel(eps),
            _ => infinitely_long::swift_stieber(eps),
        };
        let size = number(&row[4]);
        let what = format!("{} at {eps}", row[0]);
        close(film.force_along, number(&row[2]), size, &what);
        close(film.force_across, number(&row[3]), size, &what);
        close(film.sommerfeld_number(), number(&row[5]), 0.0, &what);
        close(
            film.attitude_angle().to_degrees(),
            number(&row[7]),
            0.0,
            &what,
        );
        if !row[8].is_empty() {
            close(film.rupture_angle.to_degrees(), number(&row[8]), 0.0, &what);
        }
        close(film.peak_film_thickness, number(&row[9]), 0.0, &what);
        close(film.peak_pressure, number(&row[10]), 0.0, &what);
        close(film.peak_angle.to_degrees(), number(&row[11]), 0.0, &what);
    }
}

#[test]
fn short_bearing() {
    for row in rows("short-bearing-ocvirk") {
        let eps = number(&row[0]);
        let [along, across] = short::ocvirk_force(eps);
        let what = format!("Ocvirk at {eps}");
        close(along, number(&row[1]), 0.0, &what);
        close(across, number(&row[2]), 0.0, &what);
        close(
            across.atan2(-along).to_degrees(),
            number(&row[5]),
            0.0,
            &what,
        );
        let peak = short::ocvirk_peak_angle(eps);
        close(peak.to_degrees(), number(&row[6]), 0.0, &what);
        close(
            short::ocvirk_pressure(eps, peak, 0.0),
            number(&row[7]),
            0.0,
            &what,
        );
        close(
            short::squeeze_force_closing(eps),
            number(&row[8]),
            0.0,
            &what,
        );
        close(
            short::squeeze_force_opening(eps),
            number(&row[10]),
            0.0,
            &what,
        );
    }
}

/// The film model in the units of the table: rotation only, and squeeze only.
#[test]
fn short_bearing_film_answers_wedge_and_squeeze() {
    let bearing = bearing();
    let mut film = ShortBearingFilm::new(&bearing, VISCOSITY).unwrap();
    let psi = bearing.relative_clearance();
    let square = (bearing.width / bearing.diameter).powi(2);
    let scale = VISCOSITY * bearing.diameter * bearing.width / (4.0 * psi * psi) * square;
    for row in rows("short-bearing-ocvirk") {
        let eps = number(&row[0]);
        let mut state = JournalState {
            position: [eps * bearing.radial_clearance, 0.0],
            journal_speed: 300.0,
            ..JournalState::default()
        };
        let wedge = film.linearise(&state, Step::Steady, &CONDITIONS).unwrap();
        let size = number(&row[3]);
        let [fx, fy] = wedge.reaction.film_force.map(|f| f / (scale * 300.0));
        close(fx, number(&row[1]), size, "wedge along");
        close(fy, number(&row[2]), size, "wedge across");
        let summary = film.summary();
        let peak = summary.peak_film_pressure.value * psi * psi / (VISCOSITY * 300.0 * square);
        close(peak, number(&row[7]), 0.0, "peak");
        let from_widest = (summary.peak_film_pressure.angle.to_degrees() + 180.0).rem_euclid(360.0);
        close(from_widest, number(&row[6]), 0.0, "place of the peak");

        state.journal_speed = 0.0;
        for (rate, column) in [(1.0, 8), (-1.0, 10)] {
            state.velocity = [rate * bearing.radial_clearance, 0.0];
            let squeeze = film.linearise(&state, Step::Steady, &CONDITIONS).unwrap();
            close(
                squeeze.reaction.film_force[0] / scale,
                number(&row[column]),
                0.0,
                "squeeze",
            );
        }
    }
}

#[test]
fn mobility_table() {
    let bearing = bearing();
    let psi = bearing.relative_clearance();
    let square = (bearing.width / bearing.diameter).powi(2);
    let mut exact = ShortBearingFilm::new(&bearing, VISCOSITY).unwrap();
    let mut booker = MobilityFilm::new(&bearing, VISCOSITY).unwrap();
    let expected = VISCOSITY * bearing.width * bearing.diameter / (psi * psi);
    for row in rows("short-bearing-mobility") {
        let cells: Vec<f64> = row.iter().map(|cell| number(cell)).collect();
        let (sin, cos) = cells[1].to_radians().sin_cos();
        let closed = short::booker_mobility(cells[0] * cos, cells[0] * sin);
        close(closed[0], cells[4], 0.0, "closed along");
        close(closed[1], cells[5], closed[0], "closed across");
        let check = |film: &mut dyn FilmForce, mobility: [f64; 2], what: &str| {
            let state = JournalState {
                position: [cos, sin].map(|c| c * cells[0] * bearing.radial_clearance),
                velocity: mobility.map(|m| m * bearing.radial_clearance / square),
                ..JournalState::default()
            };
            let answer = film.linearise(&state, Step::Steady, &CONDITIONS).unwrap();
            let force = answer.reaction.film_force;
            close(force[0], -expected, 0.0, what);
            close(force[1], 0.0, expected, what);
        };
        check(&mut exact, [cells[2], cells[3]], "exact mobility");
        check(&mut booker, closed, "Booker's mobility");
    }
}

#[test]
fn long_bearing_film_is_half_sommerfeld_when_steady() {
    let bearing = bearing();
    let mut film = LongBearingFilm::new(&bearing, VISCOSITY).unwrap();
    let psi = bearing.relative_clearance();
    // F per unit of 2z/B: twice that over the width.
    let scale = VISCOSITY * 300.0 * bearing.diameter * bearing.width / (2.0 * psi * psi);
    for eps in [0.05, 0.3, 0.8, 0.99] {
        let state = JournalState {
            position: [0.0, eps * bearing.radial_clearance],
            journal_speed: 300.0,
            ..JournalState::default()
        };
        let answer = film.linearise(&state, Step::Steady, &CONDITIONS).unwrap();
        let reference = infinitely_long::gumbel(eps);
        let [fx, fy] = answer.reaction.film_force.map(|f| f / scale);
        let size = 2.0 * reference.sommerfeld_number();
        close(fy, reference.force_along, size, "along");
        close(-fx, reference.force_across, size, "across");
        let peak = film.summary().peak_film_pressure.value * psi * psi / (VISCOSITY * 300.0);
        close(peak, reference.peak_pressure, 0.0, "peak");
    }
}

fn films() -> Vec<(&'static str, Box<dyn FilmForce>)> {
    let bearing = bearing();
    vec![
        (
            "short",
            Box::new(ShortBearingFilm::new(&bearing, VISCOSITY).unwrap()),
        ),
        (
            "mobility",
            Box::new(MobilityFilm::new(&bearing, VISCOSITY).unwrap()),
        ),
        (
            "long",
            Box::new(LongBearingFilm::new(&bearing, VISCOSITY).unwrap()),
        ),
    ]
}

/// Positions all over the clearance circle, moving in all directions at all relative rates.
fn states() -> Vec<JournalState> {
    let clearance = bearing().radial_clearance;
    let mut states = Vec::new();
    for eps in [0.0, 1e-6, 0.2, 0.7, 0.95, 0.999] {
        for step in 0..7 {
            let angle = 0.3 + 0.9 * f64::from(step);
            let direction = 1.1 + 2.3 * f64::from(step);
            let rate = 400.0 * clearance * (0.1 + f64::from(step) / 4.0) * (1.0 - 0.9 * eps);
            states.push(JournalState {
                position: [eps * clearance * angle.cos(), eps * clearance * angle.sin()],
                velocity: [rate * direction.cos(), rate * direction.sin()],
                journal_speed: 260.0,
                shell_speed: -40.0,
                ..JournalState::default()
            });
        }
    }
    states
}

#[test]
fn tangents_match_central_differences() {
    for (name, mut film) in films() {
        for state in states() {
            let answer = film.linearise(&state, Step::Steady, &CONDITIONS).unwrap();
            // The long film changes its line of zero pressure at the centre: its second derivatives
            // jump there, so that differences need a short step.
            let gap = film.minimum_gap(&state);
            let step = if state.eccentricity() < 0.5 * bearing().radial_clearance {
                3e-6 * gap
            } else {
                1e-4 * gap
            };
            let mut worst: f64 = 0.0;
            for column in 0..2 {
                let by_position =
                    difference(film.as_mut(), &state, column, step, |s| &mut s.position);
                let by_rate = difference(film.as_mut(), &state, column, 3e-6, |s| &mut s.velocity);
                for row in 0..2 {
                    let exact = answer.tangent.by_position;
                    let scale = norm(&exact);
                    worst = worst.max((by_position[row] - exact[row][column]).abs() / scale);
                    let exact = answer.tangent.by_rate;
                    let scale = norm(&exact);
                    worst = worst.max((by_rate[row] - exact[row][column]).abs() / scale);
                }
            }
            assert!(worst < 1e-6, "{name} at {state:?}: {worst:e}");
        }
    }
}

fn norm(matrix: &[[f64; 4]; 4]) -> f64 {
    matrix
        .iter()
        .flatten()
        .fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

/// Fourth-order central difference of the film force.
fn difference(
    film: &mut dyn FilmForce,
    state: &JournalState,
    column: usize,
    step: f64,
    part: fn(&mut JournalState) -> &mut [f64; 2],
) -> [f64; 2] {
    let mut force = |shift: f64| {
        let mut moved = *state;
        part(&mut moved)[column] += shift;
        film.linearise(&moved, Step::Steady, &CONDITIONS)
            .unwrap()
            .reaction
            .film_force
    };
    let [near, minus_near] = [force(step), force(-step)];
    let [far, minus_far] = [force(2.0 * step), force(-2.0 * step)];
    [0, 1].map(|i| (8.0 * (near[i] - minus_near[i]) - far[i] + minus_far[i]) / (12.0 * step))
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

#[test]
fn a_turned_frame_turns_the_answer_in_all_quadrants() {
    for (name, mut film) in films() {
        for state in states() {
            let answer = film.linearise(&state, Step::Steady, &CONDITIONS).unwrap();
            let peak = film.summary().peak_film_pressure;
            for angle in [0.4, 1.9, 3.5, 5.3] {
                let moved = JournalState {
                    position: turned(state.position, angle),
                    velocity: turned(state.velocity, angle),
                    ..state
                };
                let other = film.linearise(&moved, Step::Steady, &CONDITIONS).unwrap();
                let expected = turned(answer.reaction.film_force, angle);
                let size = expected[0].hypot(expected[1]);
                for (force, expected) in other.reaction.film_force.iter().zip(expected) {
                    let error = (force - expected).abs() / size;
                    assert!(error < 1e-8, "{name} at {moved:?}: {error:e}");
                }
                let other_peak = film.summary().peak_film_pressure;
                assert!(
                    (other_peak.value / peak.value - 1.0).abs() < 1e-7,
                    "{name} {moved:?}"
                );
            }
        }
    }
}

/// The mirrored motion (both speeds reversed, y reversed) gives the mirrored force.
#[test]
fn a_mirrored_bearing_mirrors_the_answer() {
    for (name, mut film) in films() {
        for state in states() {
            let force = film
                .linearise(&state, Step::Steady, &CONDITIONS)
                .unwrap()
                .reaction
                .film_force;
            let mirrored = JournalState {
                position: [state.position[0], -state.position[1]],
                velocity: [state.velocity[0], -state.velocity[1]],
                journal_speed: -state.journal_speed,
                shell_speed: -state.shell_speed,
                ..state
            };
            let other = film
                .linearise(&mirrored, Step::Steady, &CONDITIONS)
                .unwrap()
                .reaction
                .film_force;
            let size = force[0].hypot(force[1]);
            assert!(
                (force[0] - other[0]).abs() + (force[1] + other[1]).abs() < 1e-8 * size,
                "{name}"
            );
        }
    }
}

#[test]
fn friction_torques_differ_by_the_force_couple() {
    for (name, mut film) in films() {
        for state in states() {
            let reaction = film
                .linearise(&state, Step::Steady, &CONDITIONS)
                .unwrap()
                .reaction;
            let [fx, fy] = reaction.film_force;
            let couple = state.position[0] * fy - state.position[1] * fx;
            let difference = reaction.friction_torque_journal - reaction.friction_torque_shell;
            assert!(
                (difference - couple).abs() <= 1e-12 * reaction.friction_torque_journal.abs(),
                "{name}"
            );
        }
    }
}

#[test]
fn refusals_have_names() {
    for (_, mut film) in films() {
        let mut state = JournalState {
            tilt: [1e-6, 0.0],
            ..JournalState::default()
        };
        let message = film
            .linearise(&state, Step::Steady, &CONDITIONS)
            .unwrap_err()
            .to_string();
        assert!(message.contains("no tilt"), "{message}");
        state.tilt = [0.0; 2];
        state.position = [30e-6, 0.0];
        let message = film
            .linearise(&state, Step::Steady, &CONDITIONS)
            .unwrap_err()
            .to_string();
        assert!(
            message.contains("the gap closes at angle 0.00 deg"),
            "{message}"
        );
    }
}
