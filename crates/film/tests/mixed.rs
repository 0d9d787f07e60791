//! Rough surfaces, oils that thicken and shells that give way: limits, identities, closed forms.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "tests stop at the first surprise"
)]

mod common;

use common::{big_end, conditions, feed_hole, oil, reference_rows};
use sommerfeld_film::cavitation::{CavitationModel, FilmSet, Reynolds};
use sommerfeld_film::gap::Gap;
use sommerfeld_film::linear::{RingFactor, RingMatrix};
use sommerfeld_film::nonlinear::{EndOpening, Expansion, FilmEquations};
use sommerfeld_film::reduced_pressure::ReducedPressure;
use sommerfeld_film::reynolds::{Around, Axial, Operator, Storage};
use sommerfeld_film::{
    Bearing, Cavitation, ContactLaw, Elasticity, FilmForce, FilmSolver, FilmSummary, Finish,
    GreenwoodTripp, Grid, JournalState, Outcome, Reaction, RoughFinish, Roughness, Step,
};
use sommerfeld_oil::{CompressionLaw, Lubricant, PressureLaw};

const CLOSURES: [Cavitation; 3] = [
    Cavitation::Gumbel,
    Cavitation::Reynolds,
    Cavitation::MassConserving,
];

fn rough(sigma: f64, contact: f64) -> Finish {
    Finish::Rough(RoughFinish {
        roughness: Roughness {
            journal: 0.6 * sigma,
            shell: 0.8 * sigma,
            peklenik_journal: 1.0,
            peklenik_shell: 1.0,
        },
        contact: ContactLaw::GreenwoodTripp(GreenwoodTripp {
            factor: contact,
            asperity_product: 0.05,
            modulus: 53.3e9,
            summit_height: 0.0,
            summit_roughness: None,
        }),
        boundary_friction: 0.02,
    })
}

fn state(eps: f64) -> JournalState {
    JournalState {
        position: [0.8 * eps * 36e-6, 0.6 * eps * 36e-6],
        velocity: [2e-3, -1e-3],
        journal_speed: 209.4395,
        ..JournalState::default()
    }
}

fn solve(
    bearing: &Bearing,
    oil: &Lubricant,
    state: &JournalState,
) -> (Reaction, FilmSummary, Outcome) {
    let mut film = FilmSolver::new(bearing, oil, [64, 16]).unwrap();
    let answer = film.react(state, Step::Steady, &conditions()).unwrap();
    (answer.reaction, film.summary(), answer.outcome)
}

/// Largest difference of two reactions over force and torque.
fn distance(a: &Reaction, b: &Reaction) -> f64 {
    let size = a.film_force[0].hypot(a.film_force[1]);
    let force = (0..2).map(|i| (a.force()[i] - b.force()[i]).abs() / size);
    let torque = (a.friction_torque_journal - b.friction_torque_journal).abs()
        / a.friction_torque_journal.abs();
    force.fold(torque, f64::max)
}

fn bearing(cavitation: Cavitation) -> Bearing {
    Bearing {
        cavitation,
        feeds: vec![feed_hole()],
        ..big_end()
    }
}

/// Smooth surfaces are the limit of rough ones, and of contact that carries nothing.
#[test]
fn without_roughness_the_film_is_hydrodynamic() {
    for cavitation in CLOSURES {
        let smooth = bearing(cavitation);
        let (expected, ..) = solve(&smooth, &oil(), &state(0.9));
        let finest = Bearing {
            finish: rough(1e-13, 1e-3),
            ..smooth.clone()
        };
        let (found, summary, _) = solve(&finest, &oil(), &state(0.9));
        let difference = distance(&expected, &found);
        assert!(difference < 1e-8, "{cavitation:?}: {difference:e}");
        assert_eq!(summary.contact_load, 0.0);
        // The same roughness with asperities that carry next to nothing, against none that carry.
        let weak = |contact| Bearing {
            finish: rough(1e-6, contact),
            ..smooth.clone()
        };
        let (none, ..) = solve(&weak(1e-300), &oil(), &state(0.97));
        let (little, ..) = solve(&weak(1e-16), &oil(), &state(0.97));
        assert!(distance(&none, &little) < 1e-8);
        let (much, summary, _) = solve(&weak(1e-3), &oil(), &state(0.97));
        assert!(distance(&none, &much) > 1e-3 && summary.contact_load > 0.0);
    }
}

/// An oil whose viscosity next to does not depend on pressure is one whose viscosity does not.
#[test]
fn weak_dependence_on_pressure_is_none() {
    for cavitation in CLOSURES {
        let bearing = bearing(cavitation);
        let (expected, ..) = solve(&bearing, &oil(), &state(0.9));
        for law in [
            PressureLaw::Barus { alpha: 1e-18 },
            PressureLaw::Roelands {
                alpha: 1e-18,
                temperature: Default::default(),
            },
        ] {
            let weak = Lubricant {
                viscosity_pressure: law,
                ..oil()
            };
            let (found, ..) = solve(&bearing, &weak, &state(0.9));
            assert!(distance(&expected, &found) < 1e-8, "{cavitation:?} {law:?}");
        }
        let stiff = Lubricant {
            density_pressure: CompressionLaw::BulkModulus { bulk_modulus: 1e12 },
            ..oil()
        };
        let (found, ..) = solve(&bearing, &stiff, &state(0.9));
        assert!(distance(&expected, &found) < 1e-3);
        let hard = Bearing {
            elasticity: Elasticity::Layer {
                thickness: 1e-13,
                modulus: 29e9,
                poisson: 0.33,
            },
            ..bearing.clone()
        };
        let (found, ..) = solve(&hard, &oil(), &state(0.9));
        assert!(distance(&expected, &found) < 1e-8, "{cavitation:?}");
    }
}

/// `q(p)` of Barus in closed form, and the limits of both laws (105 and 143 MPa for 9.5e-9 1/Pa).
#[test]
fn reduced_pressure_is_that_of_the_law() {
    let alpha = 9.5e-9;
    let barus = Lubricant {
        viscosity_pressure: PressureLaw::Barus { alpha },
        ..oil()
    };
    let reduced = ReducedPressure::of(&barus, 373.15);
    assert!((reduced.limit() * alpha - 1.0).abs() < 1e-10);
    for pressure in [1e3, 1e6, 3e7, 2e8, 1e9] {
        let q = reduced.reduced(pressure);
        assert!(
            (q + (-alpha * pressure).exp_m1() / alpha).abs() < 1e-9 * q,
            "{pressure}"
        );
        let (back, slope) = reduced.pressure(q).unwrap();
        assert!((back / pressure - 1.0).abs() < 1e-9);
        assert!((slope / (alpha * pressure).exp() - 1.0).abs() < 1e-8);
    }
    assert!(reduced.pressure(1.000_001 / alpha).is_none());
    let roelands = Lubricant {
        viscosity_pressure: PressureLaw::Roelands {
            alpha,
            temperature: Default::default(),
        },
        ..oil()
    };
    let reduced = ReducedPressure::of(&roelands, 373.15);
    let exact = roelands.limiting_reduced_pressure(373.15);
    // The table ends where oil laws do; the rest is that of an exponential.
    assert!(
        (reduced.limit() / exact - 1.0).abs() < 1e-7,
        "{} {exact}",
        reduced.limit()
    );
    for pressure in [1e6, 1e8, 5e8] {
        let q = roelands.reduced_pressure(373.15, pressure);
        assert!((reduced.reduced(pressure) / q.value - 1.0).abs() < 1e-9);
        let (_, slope) = reduced.pressure(q.value).unwrap();
        assert!((slope * q.by_pressure - 1.0).abs() < 1e-6);
    }
}

/// The film of an oil that thickens has, cell by cell, the reduced pressures of the one that does not;
/// where these exceed the limit it has none, and says so.
#[test]
fn a_thickening_oil_has_the_reduced_pressures_of_the_isoviscous_film() {
    let oil_of = |alpha| Lubricant {
        viscosity_pressure: PressureLaw::Roelands {
            alpha,
            temperature: Default::default(),
        },
        ..oil()
    };
    for cavitation in CLOSURES {
        let bearing = Bearing {
            cavitation,
            ..big_end()
        };
        let mut plain = FilmSolver::new(&bearing, &oil(), [64, 16]).unwrap();
        let mut limited = FilmSolver::new(&bearing, &oil_of(9.5e-9), [64, 16]).unwrap();
        let reduced = ReducedPressure::of(&oil_of(9.5e-9), 373.15);
        let mut beyond = 0;
        for eps in [0.9, 0.94, 0.95, 0.96, 0.97, 0.98] {
            let still = JournalState {
                velocity: [0.0; 2],
                ..state(eps)
            };
            if plain
                .react(&still, Step::Steady, &conditions())
                .unwrap()
                .outcome
                != Outcome::Converged
            {
                continue;
            }
            let answer = limited.react(&still, Step::Steady, &conditions()).unwrap();
            let isoviscous = plain.field().unwrap().pressure;
            let peak = isoviscous.iter().fold(0.0_f64, |a, b| a.max(*b));
            if peak >= reduced.limit() {
                assert_eq!(answer.outcome, Outcome::NoSolution);
                beyond += 1;
                continue;
            }
            assert_eq!(answer.outcome, Outcome::Converged, "{eps} {peak}");
            for (p, q) in limited.field().unwrap().pressure.iter().zip(isoviscous) {
                assert!((reduced.reduced(*p) - q).abs() < 1e-7 * peak);
            }
        }
        let starves = cavitation == Cavitation::MassConserving;
        assert!(starves || beyond > 0, "{cavitation:?}");
    }
}

/// Compressed oil is conserved: what enters leaves, in mass.
#[test]
fn compressed_oil_is_conserved() {
    let bearing = bearing(Cavitation::MassConserving);
    for law in [CompressionLaw::DowsonHigginson, CompressionLaw::Limit134] {
        let compressed = Lubricant {
            viscosity_pressure: PressureLaw::Barus { alpha: 9.5e-9 },
            density_pressure: law,
            ..oil()
        };
        let still = JournalState {
            velocity: [0.0; 2],
            ..state(0.9)
        };
        let (found, summary, outcome) = solve(&bearing, &compressed, &still);
        assert_eq!(outcome, Outcome::Converged);
        assert!(
            summary.mass_balance_relative < 1e-9,
            "{}",
            summary.mass_balance_relative
        );
        assert!(summary.cell_residual < 1e-8, "{}", summary.cell_residual);
        let thick = Lubricant {
            density_pressure: CompressionLaw::None,
            ..compressed
        };
        let (expected, ..) = solve(&bearing, &thick, &still);
        let difference = distance(&expected, &found);
        assert!(difference > 1e-3 && difference < 0.1, "{difference}");
    }
}

/// Flow and mid pressure of a channel on columns, driven by pressure alone: `(h0 + k p)^4` is linear
/// along it (reference: `validation/elastic-layer`).
#[test]
fn a_channel_on_columns_has_its_closed_form() {
    let rows = reference_rows("elastic-layer", "channel.csv");
    let [row] = rows.as_slice() else {
        panic!("one row, not {}", rows.len());
    };
    let (h0, k, p0, length, eta) = (
        1e-6 * row[0],
        row[1],
        1e6 * row[2],
        1e-3 * row[3],
        1e-3 * row[4],
    );
    let solve = |n: usize, k: f64| {
        let faces: Vec<f64> = (0..=n).map(|i| i as f64 / n as f64).collect();
        let grid = Grid::from_faces(faces, vec![0.0, 1.0]);
        let unit = 12.0 * eta * (length / h0) * (length / h0);
        let around = Around::Pressures([p0 / unit, 0.0]);
        let mut operator = Operator::for_grid(&grid, around, Axial::Closed);
        let set = FilmSet::full(n, 1);
        let mut matrix = RingMatrix::new(n, 1, false);
        let mut factor = RingFactor::new(&matrix);
        let mut expansion = Expansion::new(n, false, true);
        let mut x = vec![0.0; n];
        let mut changes = Vec::new();
        for _ in 0..20 {
            let mut gap = Gap::from_profile(&grid, |_, _| 1.0, |_| 0.0);
            let ends = EndOpening {
                around: [k * p0 / h0, 0.0],
                axial: 0.0,
                conducts: false,
            };
            expansion.open(&mut gap, 1, ends, false);
            operator.update(&grid, &gap, 0.0, Storage::Rate);
            Reynolds.assemble(&operator, &set, &mut matrix, &mut x);
            let film = FilmEquations {
                operator: &operator,
                set: &set,
                gap: &gap,
                passage: None,
                held_per_height: &vec![0.0; n],
                conserves_mass: false,
            };
            expansion.add_to(&film, &mut matrix, &mut x);
            assert!(factor.factor(&matrix));
            factor.solve(&mut x);
            let change = x.iter().zip(&expansion.pressure);
            changes.push(change.fold(0.0_f64, |a, (x, p)| a.max((x - p).abs() * unit / p0)));
            expansion.pressure.copy_from_slice(&x);
            for (displacement, x) in expansion.displacement.iter_mut().zip(&x) {
                *displacement = [k * x * unit / h0, k * unit / h0];
            }
            if changes.last().unwrap() < &1e-11 {
                break;
            }
        }
        // Quadratic: each change is about the square of the one before.
        let count = changes.len();
        assert!(count <= 10, "{changes:?}");
        let pair = changes.windows(2).filter(|c| c[0] < 0.1 && c[1] > 1e-11);
        for c in pair {
            assert!(c[1] < 5.0 * c[0] * c[0], "{changes:?}");
        }
        let flow = operator.flow_around(n / 2, 0, &x, &vec![1.0; n]);
        // 1/s times h0 L^2 over L across: m2/s.
        let middle = 0.5 * (x[n / 2 - 1] + x[n / 2]) * unit;
        [flow * h0 * length, middle]
    };
    let exact = [row[5], 1e6 * row[6]];
    let [rigid, _] = solve(512, 0.0);
    assert!((rigid - row[7]).abs() < 5e-11, "{rigid}");
    let errors = [128, 512].map(|n| {
        let found = solve(n, k);
        [0, 1].map(|i| (found[i] / exact[i] - 1.0).abs())
    });
    println!("{errors:?}");
    assert!(errors[1][0] < 1e-4 && errors[1][1] < 1e-4, "{errors:?}");
    assert!(errors[0][0] / errors[1][0] > 9.0, "{errors:?}");
}

/// A shell that gives way carries a journal whose eccentricity is beyond the clearance.
#[test]
fn a_soft_shell_carries_beyond_the_clearance() {
    for cavitation in CLOSURES {
        let soft = Bearing {
            elasticity: Elasticity::Layer {
                thickness: 0.3e-3,
                modulus: 1e9,
                poisson: 0.4,
            },
            ..bearing(cavitation)
        };
        let still = |eps| JournalState {
            velocity: [0.0; 2],
            ..state(eps)
        };
        let mut last = 0.0;
        for eps in [0.9, 1.0, 1.05] {
            let (found, summary, outcome) = solve(&soft, &oil(), &still(eps));
            assert_eq!(outcome, Outcome::Converged, "{cavitation:?} {eps}");
            let force = found.film_force[0].hypot(found.film_force[1]);
            assert!(force > last && summary.minimum_film_thickness.value > 0.0);
            last = force;
        }
    }
}

/// The terms of displacement and density are the derivatives of the flows: to second order in the change.
#[test]
fn newton_terms_equal_differences() {
    let (n, m) = (12, 4);
    let faces = |count: usize, length: f64| -> Vec<f64> {
        (0..=count)
            .map(|i| length * i as f64 / count as f64)
            .collect()
    };
    let grid = Grid::from_faces(faces(n, std::f64::consts::TAU), faces(m, 0.8));
    let set = FilmSet::full(n, m);
    let pressure: Vec<f64> = (0..n * m)
        .map(|k| 40.0 + (7.3 * k as f64).sin() * 20.0)
        .collect();
    let change: Vec<f64> = (0..n * m).map(|k| (3.1 * k as f64 + 1.0).cos()).collect();
    let (compliance, compression, stiffening) = (2e-3, 1e-3, 4e-3);
    // Excess of every cell at pressures, with gap and density of the same.
    let excess = |pressure: &[f64]| {
        let mut expansion = Expansion::new(n * m, true, true);
        for (k, p) in pressure.iter().enumerate() {
            expansion.pressure[k] = *p;
            // An oil that stiffens opens the shell by more than its reduced pressure does.
            let bend = 0.5 * stiffening * p;
            let slope = compliance * (1.0 + stiffening * p);
            expansion.displacement[k] = [compliance * p * (1.0 + bend), slope];
            expansion.density[k] = [1.0 + compression * p, compression];
            expansion.content[k] = 1.0 + compression * p;
        }
        let mut gap = Gap::from_profile(&grid, |x, _| 1.0 - 0.5 * x.cos(), |x| 0.3 * x.sin());
        expansion.open(&mut gap, m, EndOpening::default(), true);
        let mut operator = Operator::for_grid(&grid, Around::Periodic, Axial::Air(0.0));
        operator.update(&grid, &gap, 1000.0, Storage::Rate);
        let central = operator.transport.clone();
        let softness = |k: usize| {
            let slope = 1.0 + stiffening * pressure[k];
            [compliance * slope, stiffening / slope]
        };
        expansion.lean(&grid, &gap, None, softness, &mut operator);
        let leans = operator.transport.iter().zip(&central);
        assert!(leans.fold(0.0_f64, |a, (t, c)| a.max((t / c - 1.0).abs())) > 1e-3);
        let mut excess = vec![0.0; n * m];
        operator.balance(pressure, &expansion.content, &mut excess);
        (excess, expansion, gap, operator)
    };
    let (before, expansion, gap, operator) = excess(&pressure);
    let mut matrix = RingMatrix::new(n, m, true);
    let mut rhs = vec![0.0; n * m];
    Reynolds.assemble(&operator, &set, &mut matrix, &mut rhs);
    let film = FilmEquations {
        operator: &operator,
        set: &set,
        gap: &gap,
        passage: None,
        held_per_height: &vec![0.0; n * m],
        conserves_mass: false,
    };
    expansion.add_to(&film, &mut matrix, &mut rhs);
    let mut residual = vec![0.0; n * m];
    matrix.residual(&pressure, &rhs, &mut residual);
    for (k, (a, b)) in residual.iter().zip(&before).enumerate() {
        assert!((a - b).abs() < 1e-9 * b.abs().max(1.0), "{k}: {a} {b}");
    }
    let error = |size: f64| {
        let moved: Vec<f64> = pressure
            .iter()
            .zip(&change)
            .map(|(p, c)| p + size * c)
            .collect();
        let mut residual = vec![0.0; n * m];
        matrix.residual(&moved, &rhs, &mut residual);
        let (exact, ..) = excess(&moved);
        residual
            .iter()
            .zip(&exact)
            .fold(0.0_f64, |a, (r, e)| a.max((r - e).abs()))
    };
    let (coarse, fine) = (error(1e-2), error(1e-3));
    assert!(fine < 0.011 * coarse, "{coarse:e} {fine:e}");
}

/// A film at one place follows a shell that gives way by Newton's steps: a handful of updates, also where it
/// moves by as much as the gap, and the answer is that of the pressures it ends with.
#[test]
fn films_on_soft_shells_settle_in_a_few_updates() {
    for cavitation in CLOSURES {
        for (thickness, modulus) in [(2e-3, 70e9), (2e-3, 20e9), (10e-3, 70e9)] {
            let soft = Bearing {
                elasticity: Elasticity::Layer {
                    thickness,
                    modulus,
                    poisson: 0.3,
                },
                ..bearing(cavitation)
            };
            let mut film = FilmSolver::new(&soft, &oil(), [64, 16]).unwrap();
            for eps in [0.7, 0.8, 0.85] {
                let still = JournalState {
                    velocity: [0.0; 2],
                    ..state(eps)
                };
                let (seen, updates) = film.look(&still, Step::Steady, &conditions()).unwrap();
                assert_eq!(seen.outcome, Outcome::Converged, "{cavitation:?} {eps}");
                assert!(
                    updates <= 14,
                    "{cavitation:?} {thickness} m {eps}: {updates}"
                );
                let again = film.linearise(&still, Step::Steady, &conditions()).unwrap();
                let force = |f: [f64; 2]| f[0].hypot(f[1]);
                let apart =
                    force(again.reaction.film_force) / force(seen.reaction.film_force) - 1.0;
                assert!(apart.abs() < 1e-8, "{cavitation:?} {eps}: {apart:e}");
            }
        }
    }
}
