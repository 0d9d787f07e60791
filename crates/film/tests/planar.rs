//! One-dimensional films with exact solutions, on the operator: sliders, steps, cavities, squeeze.
#![allow(clippy::unwrap_used)]

mod common;

use common::planar::{Planar, even_faces, order};
use common::reference_rows;
use sommerfeld_film::cavitation::{CavitationModel, Gumbel, MassConserving, Reynolds};
use sommerfeld_film::gap::Gap;
use sommerfeld_film::reynolds::{Around, Cell, Storage};
use std::f64::consts::{PI, TAU};

/// With `U = 1`, `L = 1`: the mean surface speed.
const MEAN_SPEED: f64 = 0.5;
/// `P` of the references, `p h0^2/(eta U L)`, per pressure of the operator.
const PRESSURE: f64 = 12.0;

fn slider(
    faces: Vec<f64>,
    ends: f64,
    closure: Box<dyn CavitationModel>,
    profile: impl Fn(f64, f64) -> f64,
) -> Planar {
    let around = Around::Pressures([ends / PRESSURE; 2]);
    let mut film = Planar::new(faces, around, closure);
    let gap = Gap::from_profile(&film.grid, profile, |_| 0.0);
    film.solve(&gap, MEAN_SPEED, Storage::Rate);
    film
}

/// Load, peak, flow and centre of pressure of the inclined pad; order 2.
#[test]
fn inclined_slider() {
    for row in reference_rows("inclined-slider", "reference.csv") {
        let (k, load, peak, flow, centre) = (row[0], row[1], row[2], row[5], row[6]);
        let errors = [64, 128, 256, 512].map(|n| {
            let film = slider(even_faces(0.0, 1.0, n), 0.0, Box::new(Gumbel), |x, _| {
                1.0 + k * (1.0 - x)
            });
            let w = PRESSURE * film.integral(|_| 1.0);
            let highest = film.pressure.iter().fold(0.0_f64, |a, b| a.max(*b)) * PRESSURE;
            let (q, spread) = film.flow();
            assert!(spread < 1e-12, "K {k}: {spread:e}");
            [
                w / load - 1.0,
                q / flow - 1.0,
                PRESSURE * film.integral(|x| x) / w / centre - 1.0,
                highest / peak - 1.0,
            ]
        });
        for value in 0..3 {
            let [first, .., fine] = errors.map(|e| e[value]);
            assert!(fine.abs() < 1e-4, "K {k} value {value}: {errors:?}");
            // The references have eight digits.
            if fine.abs() > 3e-8 {
                let observed = order(first, fine) / 3.0;
                assert!(observed > 1.9, "K {k} value {value}: {observed} {errors:?}");
            }
        }
        assert!(errors[3][3].abs() < 1e-4, "K {k} peak: {errors:?}");
    }
}

/// The pressure is piecewise linear: step pressure and flow are exact on any grid with a face on
/// the step, and the load too where the cells are even on either side.
#[test]
fn rayleigh_step() {
    for row in reference_rows("rayleigh-step", "reference.csv") {
        let [inlet, share, step, load, flow] = row[..] else {
            panic!("{row:?}")
        };
        for n in [4, 16, 64] {
            let mut faces = even_faces(0.0, share, n);
            faces.extend(even_faces(share, 1.0, n).drain(1..));
            let film = slider(faces, 0.0, Box::new(MassConserving), |x, side| {
                if x < share || (x == share && side < 0.0) {
                    inlet
                } else {
                    1.0
                }
            });
            let (q, spread) = film.flow();
            assert!(
                spread < 1e-13 && (q - flow).abs() < 2e-10,
                "{n}: {q} {spread:e}"
            );
            // From the last cell before the step, half a cell on.
            let dx = film.grid.around_widths[n - 1];
            let slope = PRESSURE * (MEAN_SPEED * inlet - q) / inlet.powi(3);
            let at_step = PRESSURE * film.pressure[n - 1] + 0.5 * dx * slope;
            assert!((at_step - step).abs() < 2e-9, "{n}: {at_step} {step}");
            let w = PRESSURE * film.integral(|_| 1.0);
            assert!((w - load).abs() < 2e-9, "{n}: {w} {load}");
        }
    }
}

/// Bars: rupture and reformation within one cell, load 0.1 % at 512 cells; the flow too.
#[test]
fn mass_conserving_parabolic_slider() {
    let n = 512;
    let cell = 1.0 / n as f64;
    for row in reference_rows("jfo-parabolic-slider", "reference.csv") {
        let (k, ends, level, load) = (row[0], row[1], row[3], row[7]);
        let film = slider(
            even_faces(0.0, 1.0, n),
            ends,
            Box::new(MassConserving),
            |x, _| 1.0 + k * (2.0 * x - 1.0).powi(2),
        );
        let w = PRESSURE * film.integral(|_| 1.0);
        let (q, spread) = film.flow();
        println!(
            "Pa {ends}: W {:+.2e} Hs {:+.2e} {:?}",
            w / load - 1.0,
            q / MEAN_SPEED / level - 1.0,
            film.cavity()
        );
        assert!((w / load - 1.0).abs() < 1e-3, "Pa {ends}: {w} {load}");
        assert!(
            (q / MEAN_SPEED / level - 1.0).abs() < 1e-3,
            "Pa {ends}: {q}"
        );
        assert!(spread < 1e-12, "{spread:e}");
        let Some([rupture, reformation]) = film.cavity() else {
            assert!(row[4].is_nan());
            continue;
        };
        assert!((rupture - row[4]).abs() <= cell, "Pa {ends}: {rupture}");
        assert!(
            (reformation - row[5]).abs() <= cell,
            "Pa {ends}: {reformation}"
        );
        let least = film.film_fraction.iter().fold(1.0_f64, |a, b| a.min(*b));
        let slope = 4.0 * k * (2.0 * row[5] - 1.0) * cell;
        assert!((least - row[6]).abs() < slope.abs(), "Pa {ends}: {least}");
    }
}

/// Ring of the long journal bearing, cut on the line of the widest gap. Same bars.
#[test]
fn mass_conserving_long_journal() {
    let n = 512;
    let cell = 360.0 / n as f64;
    for row in reference_rows("jfo-long-journal", "reference.csv") {
        let (eps, supply, level) = (row[0], row[1], row[3]);
        let film = slider(
            even_faces(0.0, TAU, n),
            supply,
            Box::new(MassConserving),
            |x, _| 1.0 + eps * x.cos(),
        );
        let [rupture, reformation] = film.cavity().unwrap().map(f64::to_degrees);
        let f1 = PRESSURE * film.integral(f64::cos);
        let f2 = PRESSURE * film.integral(f64::sin);
        let (q, _) = film.flow();
        let load = row[6].hypot(row[7]);
        let vector = (f1 - row[6]).hypot(f2 - row[7]) / load;
        let attitude = f2.atan2(-f1).to_degrees();
        println!(
            "Ps {supply}: {vector:.2e} {:.2e} {rupture} {reformation} {attitude}",
            q / MEAN_SPEED / level - 1.0
        );
        assert!(vector < 1e-3, "Ps {supply}: {vector:e}");
        assert!(
            (q / MEAN_SPEED / level - 1.0).abs() < 1e-3,
            "Ps {supply}: {q}"
        );
        assert!((rupture - row[4]).abs() <= cell, "Ps {supply}: {rupture}");
        assert!(
            (reformation - row[5]).abs() <= cell,
            "Ps {supply}: {reformation}"
        );
        assert!((attitude - row[8]).abs() < 0.05, "Ps {supply}: {attitude}");
    }
}

/// Slider with a pocket: rupture where the gap jumps open, reformation inside the pocket. Same bars.
#[test]
fn mass_conserving_pocket() {
    const LENGTH: f64 = 0.01;
    const THICKNESS: f64 = 1e-6;
    const VISCOSITY: f64 = 0.01;
    const SPEED: f64 = 1.0;
    // 512 cells with faces on the edges of the pocket.
    let mut faces = even_faces(0.0, 0.2, 102);
    faces.extend(even_faces(0.2, 0.5, 154).drain(1..));
    faces.extend(even_faces(0.5, 1.0, 256).drain(1..));
    let unit = 12.0 * VISCOSITY * (LENGTH / THICKNESS).powi(2);
    let around = Around::Pressures([1e5 / unit; 2]);
    let mut film = Planar::new(faces, around, Box::new(MassConserving));
    let gap = Gap::from_profile(
        &film.grid,
        |x, side| {
            let in_pocket =
                (x > 0.2 && x < 0.5) || (x == 0.2 && side > 0.0) || (x == 0.5 && side < 0.0);
            1.05 - 0.05 * x + if in_pocket { 1.0 } else { 0.0 }
        },
        |_| 0.0,
    );
    film.solve(&gap, 0.5 * SPEED / LENGTH, Storage::Rate);

    let [before_step, in_pocket] = [50, 150].map(|k| film.grid.around_widths[k] * LENGTH);
    let [rupture, reformation] = film.cavity().unwrap().map(|x| x * LENGTH);
    let load = unit * LENGTH * film.integral(|_| 1.0);
    let flow = film.flow().0 * THICKNESS * LENGTH / SPEED;
    println!(
        "load {:.2e} flow {:.2e}",
        load / 35165.7 - 1.0,
        flow / 5.22963502e-7 - 1.0
    );
    assert!((rupture - 0.002).abs() <= 1.0001 * before_step, "{rupture}");
    assert!(
        (reformation - 0.003_611_262_66).abs() <= in_pocket,
        "{reformation}"
    );
    assert!((load / 35_165.7 - 1.0).abs() < 1e-3, "{load}");
    assert!((flow / 5.229_635_02e-7 - 1.0).abs() < 1e-3, "{flow:e}");
    // The pressures at the nodes, by lines between cell centres.
    let peak = 9_808_818.8;
    let mut worst = 0.0_f64;
    for row in reference_rows("pocket-slider", "reference.csv") {
        let x = row[0] / LENGTH;
        let behind = film.grid.around.partition_point(|c| *c < x);
        if behind == 0 || behind == film.grid.n_around() || x == 0.2 || x == 0.5 {
            continue; // corners: no line runs through them
        }
        let (a, b) = (film.grid.around[behind - 1], film.grid.around[behind]);
        let share = (x - a) / (b - a);
        let p = (1.0 - share) * film.pressure[behind - 1] + share * film.pressure[behind];
        worst = worst.max((unit * p - row[2]).abs() / peak);
    }
    println!("pressure {worst:e}");
    assert!(worst < 1e-3, "{worst:e}");
}

/// A groove across the slider holds its pressure up to its edges: parallel plates leak from it by
/// straight lines of pressure, exactly.
#[test]
fn groove_holds_its_pressure_to_its_edges() {
    for n in [10, 20, 40] {
        let mut film = Planar::new(
            even_faces(0.0, 1.0, n),
            Around::Pressures([0.0; 2]),
            Box::new(Reynolds),
        );
        for (cell, x) in film.grid.around.iter().enumerate() {
            if *x > 0.4 && *x < 0.6 {
                film.set.cells[cell] = Cell::Fed;
                film.set.fed_pressure[cell] = 1.0;
            }
        }
        let gap = Gap::from_profile(&film.grid, |_, _| 1.0, |_| 0.0);
        film.solve(&gap, 0.0, Storage::Rate);
        let fed: f64 = film
            .excess
            .iter()
            .zip(&film.set.cells)
            .filter(|(_, cell)| **cell == Cell::Fed)
            .map(|(excess, _)| -excess)
            .sum();
        assert!((fed - 2.0 / 0.4).abs() < 1e-12, "{n}: {fed}");
        assert!((film.integral(|_| 1.0) - 0.6).abs() < 1e-12, "{n}");
    }
}

struct Squeeze {
    rupture_start: f64,
    boundary_minimum: [f64; 2],
    full_again: f64,
}

/// Plates that open and close between two pressures, by implicit steps.
fn oscillating_squeeze(conserves_mass: bool, n: usize, duration: f64) -> Squeeze {
    // d/dx(h^3 dp/dx) = 2 d(h theta)/dt
    const UNIT: f64 = 2.0;
    let ends = 0.025 / UNIT;
    let closure: Box<dyn CavitationModel> = if conserves_mass {
        Box::new(MassConserving)
    } else {
        Box::new(Reynolds)
    };
    // Cells clustered towards the ends, where the boundary comes to lie.
    let faces = even_faces(-1.0, 1.0, n)
        .into_iter()
        .map(|s| 0.5 + 0.5 * (1.4 * s).sin() / 1.4_f64.sin())
        .collect();
    let mut film = Planar::new(faces, Around::Pressures([ends; 2]), closure);
    let thickness = |t: f64| 0.125 * (4.0 * PI * t).cos() + 0.375;
    let mut content = vec![thickness(0.0); n];
    let mut result = Squeeze {
        rupture_start: f64::NAN,
        boundary_minimum: [f64::NAN, 1.0],
        full_again: f64::NAN,
    };
    let steps = (0.8 / duration).round() as usize;
    for step in 1..=steps {
        let t = step as f64 * duration;
        let rate = (thickness(t) - thickness(t - duration)) / duration;
        let gap = Gap::from_profile(&film.grid, |_, _| thickness(t), |_| rate);
        let storage = if conserves_mass {
            Storage::Step {
                after: 0.0,
                duration,
                old: &content,
            }
        } else {
            Storage::Rate
        };
        film.solve(&gap, 0.0, storage);
        content = film.content(&gap);
        if film.is_ruptured() {
            if result.rupture_start.is_nan() {
                result.rupture_start = t;
            }
            // At rupture p = const (x_b - x)^2: where the root of p vanishes.
            let last = film
                .set
                .cells
                .iter()
                .position(|c| *c == Cell::Ruptured)
                .unwrap()
                - 1;
            let at = |k: usize| (film.grid.around[k], film.pressure[k].sqrt());
            let ((x0, r0), (x1, r1)) = (at(0), at(last / 2));
            let boundary = x1 + r1 * (x1 - x0) / (r0 - r1);
            // Later the film forms again, against the parabola.
            if t < 0.35 && boundary < result.boundary_minimum[1] {
                result.boundary_minimum = [t, boundary];
            }
        } else if result.rupture_start.is_finite() && result.full_again.is_nan() {
            result.full_again = t;
        }
    }
    result
}

#[test]
fn oscillating_squeeze_remembers() {
    let rows = reference_rows("oscillating-squeeze", "reference.csv");
    let [start, minimum_time, minimum, full] = [0, 1, 2, 3].map(|k: usize| rows[k][1]);
    for (n, duration) in [(200, 1.0 / 1000.0), (400, 1.0 / 2000.0)] {
        let got = oscillating_squeeze(true, n, duration);
        let [at, place] = got.boundary_minimum;
        println!(
            "{n}: {:.2} {:.2} {:.2} steps, {place} {minimum}",
            (got.rupture_start - start) / duration,
            (at - minimum_time) / duration,
            (got.full_again - full) / duration
        );
        assert!((got.rupture_start - start).abs() <= 2.0 * duration);
        assert!((at - minimum_time).abs() <= 2.0 * duration);
        assert!((got.full_again - full).abs() <= 2.0 * duration);
        assert!((place / minimum - 1.0).abs() <= 0.01);
    }
}

/// Without memory the film is full as soon as the plates close.
#[test]
fn oscillating_squeeze_without_mass_conservation_refills_at_once() {
    let duration = 1.0 / 1000.0;
    let got = oscillating_squeeze(false, 200, duration);
    assert!((got.rupture_start - 0.250_079_157).abs() <= 2.0 * duration);
    assert!((got.full_again - 0.5).abs() <= 2.0 * duration);
}
