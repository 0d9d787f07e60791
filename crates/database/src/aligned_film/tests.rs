#![allow(clippy::unwrap_used)]
use super::*;
use sommerfeld_film::Cavitation;
use std::f64::consts::{FRAC_PI_2, PI};

const TOLERANCE: f64 = 1e-5;

fn case(closure: Cavitation, eccentricity: f64, width_ratio: f64) -> FilmCase {
    FilmCase {
        eccentricity,
        width_ratio,
        closure,
        line: false,
    }
}

fn solve(case: FilmCase, angle: f64) -> Solved {
    let solved = AlignedFilm::new(case, TOLERANCE).solve(angle, TOLERANCE, true);
    let solved = solved.unwrap();
    assert!(
        solved.error < 2.0 * TOLERANCE,
        "{case:?} {angle} {solved:?}"
    );
    solved
}

/// The narrower the bearing, the closer it is to short-bearing theory: force over (B/D)^2 of pure sliding
/// is `12 [-eps/(1-eps^2)^2 ... ]`, in the scale of the effective velocity twice that of the wedge over eps.
#[test]
fn narrow_bearings_tend_to_the_short_bearing() {
    let eps: f64 = 0.6;
    let square = 1.0 - eps * eps;
    // Ocvirk per effective velocity eps/2, per (B/D)^2; the motion turns against the paper's frame.
    let short = [
        -8.0 * eps * eps / square.powi(2),
        -2.0 * PI * eps / square.powf(1.5),
    ]
    .map(|force| force * 2.0 / eps);
    let distance = |width_ratio: f64| {
        let force = solve(case(Cavitation::Gumbel, eps, width_ratio), FRAC_PI_2)
            .answer
            .force;
        let scaled = force.map(|force| force / (width_ratio * width_ratio));
        (scaled[0] - short[0]).hypot(scaled[1] - short[1]) / short[0].hypot(short[1])
    };
    let [wide, narrow] = [0.1, 0.05].map(distance);
    assert!(narrow < 0.01, "{narrow}");
    assert!((3.0..5.0).contains(&(wide / narrow)), "{wide} {narrow}");
}

/// The flow out of the ends of a film that is not cut is what the walls displace; of a short one,
/// R B |w| at each end.
#[test]
fn a_closing_film_gives_off_what_it_displaces() {
    let narrow = solve(case(Cavitation::Reynolds, 0.5, 0.05), 0.0).answer;
    assert!(
        (narrow.side_flow - 1.0).abs() < 0.01,
        "{}",
        narrow.side_flow
    );
    assert!((narrow.full_film_share - 0.5).abs() < 0.02);
}

#[test]
fn derivatives_are_those_of_differences() {
    for (closure, bar) in [(Cavitation::Gumbel, 2e-3), (Cavitation::Reynolds, 2e-2)] {
        for (eps, angle) in [(0.4, 0.7), (0.9, 1.8)] {
            let own = solve(case(closure, eps, 0.5), angle).answer;
            let h = 0.02 * (1.0 - eps);
            let force = |e: f64, a: f64| {
                solve(case(closure, eps + e * h, 0.5), angle + a * h)
                    .answer
                    .force
            };
            let steps = [-2.0, -1.0, 1.0, 2.0];
            let [by_eps, by_angle] = [steps.map(|s| force(s, 0.0)), steps.map(|s| force(0.0, s))];
            // Of fourth order.
            let slope = |f: &[[f64; 2]; 4], row: usize| {
                (8.0 * (f[2][row] - f[1][row]) - (f[3][row] - f[0][row])) / (12.0 * h)
            };
            let size = own.force[0].hypot(own.force[1]) / (1.0 - eps);
            for row in 0..2 {
                let off = [
                    own.by_eccentricity[row] - slope(&by_eps, row),
                    own.by_angle[row] - slope(&by_angle, row),
                ];
                let within = off.iter().all(|off| off.abs() < bar * size);
                assert!(within, "{closure:?} {eps} {angle}: {off:?} of {size}");
            }
        }
    }
}

#[test]
fn the_closures_stand_in_their_order() {
    // Cutting afterwards leaves less pressure than the film that knows where it ruptures.
    for angle in [0.5, 1.5, 2.5] {
        let [gumbel, reynolds] = [Cavitation::Gumbel, Cavitation::Reynolds]
            .map(|closure| solve(case(closure, 0.7, 0.5), angle).answer);
        assert!(reynolds.peak > gumbel.peak);
        assert!(reynolds.full_film_share > gumbel.full_film_share);
        // The film of `reynolds` is one half-space better everywhere: it resists the motion more.
        let power =
            |answer: &Answer| -(answer.force[0] * angle.cos() + answer.force[1] * angle.sin());
        assert!(power(&reynolds) > power(&gumbel));
    }
}

#[test]
fn a_line_at_the_widest_gap_lowers_the_force_of_a_sliding_journal() {
    let cyclic = case(Cavitation::Reynolds, 0.3, 1.0);
    let line = FilmCase {
        line: true,
        ..cyclic
    };
    let [cyclic, line] = [cyclic, line].map(|case| solve(case, FRAC_PI_2).answer);
    // Butenschoen 1976, B/D 1, eps 0.3, pure rotation: So 0.4091, attitude 68.264 deg.
    let so = 0.25 * 0.15 * line.force[0].hypot(line.force[1]);
    assert!((so - 0.4091).abs() < 0.005 * 0.4091, "{so}");
    let attitude = line.force[1].atan2(line.force[0]).to_degrees() + 180.0;
    assert!((attitude - 68.264).abs() < 0.15, "{attitude}");
    assert!((cyclic.force[0] - line.force[0]).abs() > 1e-3);
}
