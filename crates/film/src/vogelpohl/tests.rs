#![allow(clippy::unwrap_used)]

use super::iteration::{Equations, GapAt, Iteration};
use super::*;
use std::f64::consts::{PI, TAU};

fn film(relative_eccentricity: f64, tilt_gamma: f64, tilt_delta: f64) -> DimensionlessFilm {
    DimensionlessFilm {
        d_over_b: 2.0,
        relative_eccentricity,
        tilt_gamma,
        tilt_delta,
        wedge: 1.0,
        squeeze: 0.0,
        cavitation: Cavitation::Reynolds,
        inlet: Inlet::Cyclic,
    }
}

/// A mesh with steps that differ by a factor of about 3 both ways, by a smooth map.
fn stretched([n_around, n_axial]: [usize; 2]) -> Mesh {
    let even = Mesh::uniform([n_around, n_axial]);
    Mesh {
        around: even
            .around
            .iter()
            .map(|phi| phi + 0.5 * phi.sin())
            .collect(),
        axial: even
            .axial
            .iter()
            .map(|z| z - 0.5 * (PI * z).sin() / PI)
            .collect(),
    }
}

/// Largest error of `(1 - Z^2)(2 + cos(phi))` as the solution of the transformed equation of a tilted
/// gap, its right side found by hand.
fn manufactured_error(intervals: [usize; 2]) -> f64 {
    let film = film(0.6, 0.3, 0.1);
    let mesh = stretched(intervals);
    let exact = |i: usize, j: usize| (1.0 - mesh.axial[j].powi(2)) * (2.0 + mesh.around[i].cos());
    let coefficient = |i: usize, j: usize| {
        // -(3/2) H^(-3/2) div(H^(1/2) grad H), the derivation's form, by differences.
        let step = 1e-4;
        let at = |phi: f64, z: f64| GapAt::new(&film, phi, z).height;
        let (phi, z) = (mesh.around[i], mesh.axial[j]);
        let h = at(phi, z);
        let slope = |low: f64, high: f64| (high - low) / step;
        let flux = |low: f64, high: f64| (0.5 * (low + high)).sqrt() * slope(low, high);
        let around = (flux(h, at(phi + step, z)) - flux(at(phi - step, z), h)) / step;
        let along = (flux(h, at(phi, z + step)) - flux(at(phi, z - step), h)) / step;
        -1.5 * h.powf(-1.5) * (around + film.d_over_b.powi(2) * along)
    };
    let source = |i: usize, j: usize| {
        let (phi, z) = (mesh.around[i], mesh.axial[j]);
        let bends = -(1.0 - z * z) * phi.cos() - film.d_over_b.powi(2) * 2.0 * (2.0 + phi.cos());
        bends + coefficient(i, j) * exact(i, j)
    };
    // The coefficient that the method uses, the right side with the one derived here.
    let used = |i: usize, j: usize| {
        GapAt::new(&film, mesh.around[i], mesh.axial[j]).reaction(film.d_over_b)
    };
    let equations = Equations::of(&mesh, film.d_over_b, used, source, |_, _| 1.0);
    let mut iteration = Iteration::new(&equations, vec![0.0; mesh.nodes()], false);
    assert!(iteration.run(1.5, 1e-10, 100_000).is_converged);
    let values = iteration.into_values();
    let columns = mesh.axial.len();
    (0..mesh.nodes())
        .map(|k| (values[k] - exact(k / columns, k % columns)).abs())
        .fold(0.0, f64::max)
}

/// Second order on variable steps, and the coefficient `a` is the one of the transform: a wrong one would
/// leave an error that no mesh removes.
#[test]
fn a_full_film_converges_with_second_order() {
    let errors = [[16, 8], [32, 16], [64, 32], [128, 64]].map(manufactured_error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.8..2.3).contains(&order), "{errors:?}");
    }
    assert!(errors[3] < 2e-3, "{errors:?}");
}

#[test]
fn meshes_crowd_where_the_pressure_is_steep() {
    let settings = VogelpohlSettings::new([96, 24]);
    let solution = solve_vogelpohl(&film(0.8, 0.8, 0.0), &settings).unwrap();
    let mesh = &solution.mesh;
    assert_eq!((mesh.around.len(), mesh.axial.len()), (96, 25));
    assert!(mesh.around[0] == 0.0 && mesh.axial[0] == -1.0 && mesh.axial[24] == 1.0);
    let around: Vec<f64> = (0..96).map(|i| mesh.step_around(i)).collect();
    let axial: Vec<f64> = (0..24).map(|j| mesh.step_axial(j)).collect();
    assert!(around.iter().chain(&axial).all(|step| *step > 0.0));
    assert!((around.iter().sum::<f64>() - TAU).abs() < 1e-12);
    let least = |steps: &[f64]| {
        let at = (0..steps.len())
            .min_by(|a, b| steps[*a].total_cmp(&steps[*b]))
            .unwrap();
        (at, steps.iter().copied().fold(0.0, f64::max) / steps[at])
    };
    // The peak lies before the narrowest gap at 180 degrees, towards the edge Z = -1.
    let (narrow, ratio) = least(&around);
    assert!(
        (2.3..3.6).contains(&mesh.around[narrow]) && ratio > 2.0,
        "{narrow} {ratio}"
    );
    assert!(least(&axial).0 < 8, "{axial:?}");
}

#[test]
fn what_it_cannot_solve_is_said() {
    let settings = VogelpohlSettings::new([64, 16]);
    let refused = |film: &DimensionlessFilm, settings: &VogelpohlSettings| {
        solve_vogelpohl(film, settings).unwrap_err().to_string()
    };
    let closed = refused(&film(0.8, 1.0, 0.0), &settings);
    assert!(
        closed.contains("the gap closes at angle 0.00 deg"),
        "{closed}"
    );
    let mass_conserving = DimensionlessFilm {
        cavitation: Cavitation::MassConserving,
        ..film(0.5, 0.0, 0.0)
    };
    assert!(refused(&mass_conserving, &settings).contains("reynolds"));
    assert!(refused(&film(f64::NAN, 0.0, 0.0), &settings).contains("relative_eccentricity"));
    for bad in [
        VogelpohlSettings {
            intervals: [64, 2],
            ..settings
        },
        VogelpohlSettings {
            relaxation: 2.0,
            ..settings
        },
        VogelpohlSettings {
            tolerance: 0.0,
            ..settings
        },
    ] {
        assert!(
            solve_vogelpohl(&film(0.5, 0.0, 0.0), &bad).is_err(),
            "{bad:?}"
        );
    }
    let few = VogelpohlSettings {
        most_sweeps: 20,
        ..settings
    };
    let stopped = solve_vogelpohl(&film(0.8, 0.0, 0.0), &few).unwrap();
    assert_eq!(stopped.outcome, Outcome::NotConverged);
}

#[test]
fn without_motion_there_is_no_pressure() {
    let still = DimensionlessFilm {
        wedge: 0.0,
        ..film(0.5, 0.2, 0.1)
    };
    let solution = solve_vogelpohl(&still, &VogelpohlSettings::new([32, 8])).unwrap();
    assert_eq!(solution.integrals, DimensionlessIntegrals::default());
    assert_eq!(solution.outcome, Outcome::Converged);
}
