//! Two ways to the same shaped bearing agree: shifts, mirrors, turns, sums, limits and closed forms.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod common;

use common::shaped::{
    CLOSURES, GRID, HALF, VISCOSITY, answers, bearing_at, crowning, deviation, lemon, relief,
    solve, solve_on, states, wave,
};
use common::{big_end, conditions, feed_hole, oil};
use sommerfeld_film::shape::arc_shift;
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Ends, Feature, Feed, FeedLine, FeedShape, FilmError, FilmForce,
    FilmSolver, JournalState, LongBearingFilm, MobilityFilm, ProfileTable, ReliefForm, Shape,
    ShortBearingFilm, Step,
};
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// A wave of order 1 is a bore shifted against the frame, and a journal shifted the other way.
#[test]
fn a_wave_of_order_one_is_a_shift() {
    let (a, phase) = (6e-6, 0.9_f64);
    for cavitation in CLOSURES {
        for (how, state) in states() {
            // Profiles that turn move their surface's centre: here they rest.
            let state = JournalState {
                journal_angle: 0.0,
                shell_speed: 0.0,
                ..state
            };
            let plain = bearing_at(&big_end(), cavitation);
            let bore = Bearing {
                bore: Shape::of([wave(1, a, phase)]),
                ..plain.clone()
            };
            let journal = Bearing {
                journal: Shape::of([wave(1, -a, phase)]),
                ..plain.clone()
            };
            let mut moved = state;
            moved.position[0] -= a * phase.cos();
            moved.position[1] -= a * phase.sin();
            let (film, exact) = solve(&plain, &moved);
            let (shifted, answer) = solve(&bore, &state);
            let worst = deviation(answers(&exact), &answer);
            assert!(worst < 1e-11, "{cavitation:?} {how}: {worst:e}");
            let least = [&film, &shifted].map(|f| f.summary().minimum_film_thickness.value);
            assert!((least[0] - least[1]).abs() < 1e-12 * plain.radial_clearance);
            // The journal's wave turns with it: its centre moves around the turning axis.
            let speed = state.journal_speed;
            moved.velocity[0] += speed * a * phase.sin();
            moved.velocity[1] -= speed * a * phase.cos();
            let (_, exact) = solve(&plain, &moved);
            let (_, answer) = solve(&journal, &state);
            let worst = deviation(answers(&exact), &answer);
            assert!(worst < 1e-11, "{cavitation:?} {how} journal: {worst:e}");
        }
    }
}

/// What one surface has and the other lacks makes the same gap.
#[test]
fn a_relieved_journal_is_a_relieved_bore() {
    let both = |form: ReliefForm, sign: f64| {
        Shape::of([relief(HALF, 5e-6 * sign, form), crowning(3e-6 * sign)])
    };
    for form in [ReliefForm::Linear, ReliefForm::Circular] {
        for (how, state) in states() {
            let plain = bearing_at(&big_end(), Cavitation::MassConserving);
            let bore = Bearing {
                bore: both(form, 1.0),
                ..plain.clone()
            };
            let journal = Bearing {
                journal: both(form, -1.0),
                ..plain.clone()
            };
            let (_, first) = solve(&bore, &state);
            let (_, second) = solve(&journal, &state);
            assert!(deviation(answers(&first), &second) < 1e-12, "{how}");
            let (_, none) = solve(&plain, &state);
            assert!(deviation(answers(&first), &none) > 1e-2, "{how}");
        }
    }
}

/// Without preload the arcs are the cylinder.
#[test]
fn lemon_without_preload_is_a_cylinder() {
    for cavitation in CLOSURES {
        for (how, state) in states() {
            let plain = bearing_at(&big_end(), cavitation);
            let shapes = [
                Feature::Lemon {
                    shift: arc_shift(plain.radial_clearance, 0.0),
                    joint: 0.0,
                },
                Feature::OffsetHalves {
                    shift: arc_shift(plain.radial_clearance, 0.0),
                    joint: 0.0,
                },
            ];
            let (_, first) = solve(&plain, &state);
            for shape in shapes {
                let bearing = Bearing {
                    bore: Shape::of([shape]),
                    ..plain.clone()
                };
                let (_, answer) = solve(&bearing, &state);
                assert!(
                    deviation(answers(&first), &answer) < 1e-14,
                    "{cavitation:?} {how}"
                );
            }
        }
    }
}

/// `1 - |sin a| = 1 - 2/pi + sum 4/(pi (4 k^2 - 1)) cos(2 k a)`: a lemon bore by its waves.
#[test]
fn a_lemon_is_the_sum_of_its_waves() {
    let shift = 12e-6;
    let state = states()[0].1;
    let plain = bearing_at(&big_end(), Cavitation::Reynolds);
    let exact = Bearing {
        bore: Shape::of([lemon(shift, 0.0)]),
        ..plain.clone()
    };
    let (_, exact) = solve_on(&exact, &state, [256, 16]);
    let error = |waves: u32| {
        let terms: Vec<Feature> = (1..=waves)
            .map(|k| {
                let size = 4.0 / (PI * (4.0 * f64::from(k).powi(2) - 1.0));
                wave(2 * k, shift * size, 0.0)
            })
            .collect();
        let bearing = Bearing {
            bore: Shape::of(terms),
            radial_clearance: plain.radial_clearance + shift * (1.0 - 2.0 / PI),
            ..plain.clone()
        };
        let (_, answer) = solve_on(&bearing, &state, [256, 16]);
        deviation(answers(&exact), &answer)
    };
    let errors = [1, 4, 16].map(error);
    assert!(
        errors[0] < 0.1 && errors[1] < 0.01 && errors[2] < 1e-3,
        "{errors:?}"
    );
    assert!(errors[0] > errors[1] && errors[1] > errors[2], "{errors:?}");
}

/// Offset halves by a ramp in place of each step, ever steeper.
#[test]
fn a_step_is_the_limit_of_ramps() {
    let (shift, joint) = (10e-6, 0.5 * PI);
    let state = JournalState {
        position: [3e-6, -9e-6],
        ..states()[0].1
    };
    let plain = Bearing {
        cavitation: Cavitation::Gumbel,
        ends: Ends::Flooded,
        ambient_pressure: 5e7,
        ..big_end()
    };
    let stepped = Bearing {
        bore: Shape::of([Feature::OffsetHalves { shift, joint }]),
        ..plain.clone()
    };
    let force = |n: usize| answers(&solve_on(&stepped, &state, [n, 16]).1)[0];
    let ramped = |width: f64, n: usize| {
        // A table with its nodes close together beside the joints.
        let mut angles: Vec<f64> = (0..1440)
            .map(|k| PI * f64::from(k) / 720.0 + 1e-4)
            .collect();
        for at in [0.5 * PI, 1.5 * PI] {
            angles.retain(|a| (a - at).abs() > 1.5 * width);
            angles.extend([-1.0, -0.5, 0.5, 1.0].map(|s| at + s * width));
        }
        angles.sort_by(f64::total_cmp);
        let value = |a: f64| {
            let (sin, cos) = (a - joint).sin_cos();
            let blend = (sin / (0.5 * width).sin()).clamp(-1.0, 1.0);
            shift * (1.0 + blend * cos)
        };
        let offsets = angles.iter().map(|a| value(*a)).collect();
        let table = ProfileTable::new(angles, vec![0.0], offsets).unwrap();
        let bearing = Bearing {
            bore: Shape::of([Feature::Table(table)]),
            ..plain.clone()
        };
        answers(&solve_on(&bearing, &state, [n, 16]).1)[0]
    };
    let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) / b[0].hypot(b[1]);
    let exact = force(1024);
    let (wide, narrow) = (ramped(0.04, 1024), ramped(0.01, 1024));
    let errors = [apart(wide, exact), apart(narrow, exact)];
    assert!(
        errors[1] < 0.5 * errors[0] && errors[1] < 5e-3,
        "{errors:?}"
    );
    // And the grid needs no ramp to be of second order.
    let grids = [apart(force(64), exact), apart(force(128), exact)];
    assert!(grids[0] < 5e-3 && grids[0] / grids[1] > 3.0, "{grids:?}");
}

/// In the mid-plane and in the plane of X and Z, everything mirrored.
#[test]
fn mirrors() {
    let hole = |angle: f64, position: f64| Feed {
        shape: FeedShape::Hole { diameter: 7e-3 },
        carried_by: Carrier::Shell,
        angle,
        position,
        pressure: 2e5,
        line: FeedLine::Direct,
    };
    // The joint's faces lie alike on both sides of X.
    let bore = |around: f64, along: f64| {
        Shape::of([
            lemon(14e-6, around * FRAC_PI_4),
            relief(along * HALF, 5e-6, ReliefForm::Linear),
            wave(3, 1.5e-6, around * 0.4),
        ])
    };
    let journal = |around: f64, along: f64| {
        Shape::of([
            wave(2, 2e-6, around * 0.3),
            relief(-along * HALF, -4e-6, ReliefForm::Circular),
        ])
    };
    for cavitation in CLOSURES {
        for (how, state) in states() {
            let bearing = |around: f64, along: f64| Bearing {
                cavitation,
                feeds: vec![hole(around * 4.0, along * -4e-3), feed_hole()],
                bore: bore(around, along),
                journal: journal(around, along),
                ..big_end()
            };
            let mirrored_feeds = |mut bearing: Bearing| {
                bearing.feeds[1].angle = -bearing.feeds[1].angle;
                bearing
            };
            let (film, first) = solve(&bearing(1.0, 1.0), &state);
            let (polar, axial) = (|[x, y]: [f64; 2]| [x, -y], |[x, y]: [f64; 2]| [-x, y]);
            let seen = JournalState {
                position: polar(state.position),
                velocity: polar(state.velocity),
                tilt: axial(state.tilt),
                tilt_rate: axial(state.tilt_rate),
                journal_speed: -state.journal_speed,
                shell_speed: -state.shell_speed,
                journal_angle: -state.journal_angle,
                shell_angle: -state.shell_angle,
            };
            let (_, answer) = solve(&mirrored_feeds(bearing(-1.0, 1.0)), &seen);
            let [f, m] = answers(&first);
            let worst = deviation([polar(f), axial(m)], &answer);
            assert!(worst < 1e-9, "{cavitation:?} {how} around: {worst:e}");

            let minus = |[x, y]: [f64; 2]| [-x, -y];
            let seen = JournalState {
                tilt: minus(state.tilt),
                tilt_rate: minus(state.tilt_rate),
                ..state
            };
            let (other, answer) = solve(&bearing(1.0, -1.0), &seen);
            let worst = deviation([f, minus(m)], &answer);
            assert!(worst < 1e-9, "{cavitation:?} {how} along: {worst:e}");
            let flows = [&film, &other].map(|f| f.summary().side_flow);
            assert!((flows[0][0] - flows[1][1]).abs() < 1e-9 * flows[0][0].abs());
        }
    }
}

/// Everything turned by an eighth of a turn.
#[test]
fn a_turned_bearing_gives_a_turned_result() {
    let turn = |[x, y]: [f64; 2]| {
        let s = 0.5_f64.sqrt();
        [s * (x - y), s * (x + y)]
    };
    for cavitation in CLOSURES {
        for (how, state) in states() {
            let bearing = |by: f64| Bearing {
                cavitation,
                feeds: vec![Feed {
                    shape: FeedShape::Hole { diameter: 7e-3 },
                    carried_by: Carrier::Shell,
                    angle: 4.0 + by,
                    position: -4e-3,
                    pressure: 2e5,
                    line: FeedLine::Direct,
                }],
                bore: Shape::of([
                    lemon(14e-6, FRAC_PI_4 + by),
                    Feature::JointRelief {
                        offset: 8e-6,
                        half_span: TAU / 48.0,
                        joint: FRAC_PI_4 + by,
                    },
                    relief(HALF, 5e-6, ReliefForm::Linear),
                    wave(3, 1.5e-6, 0.4 + by),
                ]),
                journal: Shape::of([wave(2, 2e-6, 0.3)]),
                ..big_end()
            };
            let (_, first) = solve(&bearing(0.0), &state);
            let turned = JournalState {
                position: turn(state.position),
                velocity: turn(state.velocity),
                tilt: turn(state.tilt),
                tilt_rate: turn(state.tilt_rate),
                journal_angle: state.journal_angle + FRAC_PI_4,
                ..state
            };
            let (_, answer) = solve(&bearing(FRAC_PI_4), &turned);
            let [f, m] = answers(&first);
            let worst = deviation([turn(f), turn(m)], &answer);
            assert!(worst < 1e-9, "{cavitation:?} {how}: {worst:e}");
        }
    }
}

/// Two lands beside a central groove are two bearings that each have the groove at one end.
#[test]
fn two_lands_make_a_grooved_bearing() {
    let groove = |width: f64, position: f64| Feed {
        shape: FeedShape::Circumferential { width },
        carried_by: Carrier::Shell,
        angle: 0.0,
        position,
        pressure: 4e5,
        line: FeedLine::Direct,
    };
    for cavitation in CLOSURES {
        let whole = Bearing {
            cavitation,
            bore: Shape::of([lemon(14e-6, 0.0)]),
            feeds: vec![groove(6e-3, 0.0)],
            ..big_end()
        };
        let land = Bearing {
            width: 15e-3,
            feeds: vec![groove(3e-3, 6e-3)],
            ..whole.clone()
        };
        let state = JournalState {
            velocity: [1e-3, -5e-4],
            ..states()[0].1
        };
        let (film, first) = solve_on(&whole, &state, [96, 20]);
        let (half, second) = solve_on(&land, &state, [96, 10]);
        let twice = second.reaction.film_force.map(|f| 2.0 * f);
        let size = twice[0].hypot(twice[1]);
        let apart = [0, 1].map(|k: usize| (first.reaction.film_force[k] - twice[k]) / size);
        assert!(apart[0].hypot(apart[1]) < 1e-9, "{cavitation:?} {apart:?}");
        let (a, b) = (film.summary(), half.summary());
        assert!((a.side_flow[0] / b.side_flow[0] - 1.0).abs() < 1e-9);
        assert!((a.peak_film_pressure.value / b.peak_film_pressure.value - 1.0).abs() < 1e-9);
    }
}

/// A mirrored shape is solved on one half; one that is not, on the whole.
#[test]
fn half_a_film_where_the_shapes_are_mirrored() {
    let mirrored = [
        relief(HALF, 5e-6, ReliefForm::Linear),
        relief(-HALF, 5e-6, ReliefForm::Linear),
        lemon(10e-6, 0.0),
    ];
    let state = states()[0].1;
    for (features, is_half) in [(&mirrored[..], true), (&mirrored[..1], false)] {
        let bearing = Bearing {
            bore: Shape::of(features),
            feeds: vec![feed_hole()],
            ..big_end()
        };
        let mut film = FilmSolver::aligned(&bearing, &oil(), GRID).unwrap();
        assert_eq!(film.capabilities().accepts_tilt, !is_half);
        let answer = film.react(&state, Step::Steady, &conditions()).unwrap();
        let (_, whole) = solve(&bearing, &state);
        let force = [answers(&answer)[0], answers(&whole)[1]];
        assert!(deviation(force, &whole) < 1e-9);
    }
}

/// What needs cylinders says so.
#[test]
fn closed_forms_and_turning_grids_refuse_shapes() {
    let bearing = Bearing {
        cavitation: Cavitation::Gumbel,
        film_shear: sommerfeld_film::FilmShear::FullWidth,
        finish: sommerfeld_film::Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
        bore: Shape::of([lemon(10e-6, 0.0)]),
        ..big_end()
    };
    let refused = |error: Option<FilmError>| {
        let message = error.unwrap().to_string();
        assert!(
            message.contains("field") || message.contains("cyclic"),
            "{message}"
        );
    };
    refused(ShortBearingFilm::new(&bearing, VISCOSITY).err());
    refused(LongBearingFilm::new(&bearing, VISCOSITY).err());
    refused(MobilityFilm::new(&bearing, VISCOSITY).err());
    refused(FilmSolver::following(&bearing, &oil(), GRID, 0.0).err());
    // What is alike all around turns with the line of centres.
    let crowned = Bearing {
        bore: Shape::of([crowning(5e-6)]),
        ..bearing
    };
    assert!(FilmSolver::following(&crowned, &oil(), GRID, 0.0).is_ok());
}

/// A state that closes the gap is refused with the place.
#[test]
fn a_closed_gap_is_found_under_a_crest() {
    let bearing = Bearing {
        journal: Shape::of([wave(3, 10e-6, 0.0)]),
        feeds: vec![feed_hole()],
        ..big_end()
    };
    let mut film = FilmSolver::new(&bearing, &oil(), GRID).unwrap();
    let state = |journal_angle: f64| JournalState {
        position: [28e-6, 0.0],
        journal_speed: 100.0,
        journal_angle,
        ..JournalState::default()
    };
    // A valley of the journal faces the narrow side, then a crest.
    assert!(film.minimum_gap(&state(PI / 3.0)) > 0.0);
    film.react(&state(PI / 3.0), Step::Steady, &conditions())
        .unwrap();
    let error = film
        .react(&state(0.0), Step::Steady, &conditions())
        .unwrap_err();
    let FilmError::Contact {
        gap_um, angle_deg, ..
    } = error
    else {
        unreachable!("{error}")
    };
    assert!(
        (gap_um + 2.0).abs() < 1e-6 && angle_deg.rem_euclid(360.0).min(360.0 - angle_deg) < 1e-3
    );
}

/// Pressure and load of a narrow lemon bearing against the short-bearing quadrature of
/// `validation/lemon-bore-short`.
#[test]
fn a_short_lemon_bearing() {
    for row in common::reference_rows("lemon-bore-short", "reference.csv") {
        let [preload, joint, eps, angle, force_x, force_y, peak] = row[..] else {
            unreachable!("{row:?}")
        };
        // R = 1 m, psi = 1e-3, eta = psi^2, 1 rad/s; B/D = 0.005, forces over (B/D)^2.
        let width_ratio = 0.005;
        let plain = common::unit_bearing(width_ratio);
        let c = plain.radial_clearance;
        let bearing = Bearing {
            cavitation: Cavitation::Gumbel,
            bore: Shape::of([lemon(arc_shift(c, preload), joint.to_radians())]),
            ..plain
        };
        let direction = [angle.to_radians().cos(), angle.to_radians().sin()];
        let state = JournalState {
            position: direction.map(|d| eps * c * d),
            journal_speed: 1.0,
            ..JournalState::default()
        };
        let mut film = FilmSolver::new(&bearing, &common::unit_oil(), [1024, 64]).unwrap();
        let answer = film.react(&state, Step::Steady, &conditions()).unwrap();
        let scale = width_ratio.powi(3);
        let force = answer.reaction.film_force.map(|f| f / scale);
        let size = force_x.hypot(force_y);
        let error = (force[0] - force_x).hypot(force[1] - force_y) / size;
        let highest = film.summary().peak_film_pressure.value / width_ratio.powi(2);
        let peak_error = highest / peak - 1.0;
        println!("{row:?}: force {error:.1e} of 2e-3, peak {peak_error:.1e} of 5e-3");
        assert!(error < 2e-3, "{row:?}: {force:?}, {error:e} of 2e-3");
        assert!(
            peak_error.abs() < 5e-3,
            "{row:?}: {highest}, {peak_error:e} of 5e-3"
        );
    }
}
