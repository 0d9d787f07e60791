//! Tangents by fixed-set adjoints against central differences of the settled reaction.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod common;

use common::{big_end, conditions, feed_hole, oil};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, ContactLaw, Elasticity, Feed, FeedLine, FeedShape, FilmForce,
    FilmSolver, Finish, GreenwoodTripp, Inlet, JournalState, Outcome, Reaction, RoughFinish,
    Roughness, Step,
};
use sommerfeld_oil::{Lubricant, PressureLaw, ShearThinning};

fn state(c: f64) -> JournalState {
    JournalState {
        position: [0.55 * c, 0.35 * c],
        tilt: [0.15 * c / 0.015, -0.1 * c / 0.015],
        velocity: [40.0 * c, -25.0 * c],
        tilt_rate: [30.0 * c / 0.015, 20.0 * c / 0.015],
        journal_speed: 230.0,
        shell_speed: -11.0,
        journal_angle: 1.0,
        shell_angle: 0.0,
    }
}

fn values(r: &Reaction) -> [f64; 4] {
    let (f, m) = (r.force(), r.moment());
    [f[0], f[1], m[0], m[1]]
}

fn nudge(state: &mut JournalState, rates: bool, column: usize, by: f64) {
    let (lin, tilt) = if rates {
        (&mut state.velocity, &mut state.tilt_rate)
    } else {
        (&mut state.position, &mut state.tilt)
    };
    if column < 2 {
        lin[column] += by;
    } else {
        tilt[column - 2] += by;
    }
}

/// Worst deviation over each row's largest entry, by position and by rate.
fn worst_deviation(bearing: &Bearing, step: Step) -> f64 {
    worst_deviation_within(bearing, step, 1e-6)
}

/// The same with differences over twice this share of the clearance.
fn worst_deviation_within(bearing: &Bearing, step: Step, nudged: f64) -> f64 {
    worst_deviation_of(
        bearing,
        &oil(),
        &state(bearing.radial_clearance),
        step,
        nudged,
    )
}

fn worst_deviation_of(
    bearing: &Bearing,
    oil: &Lubricant,
    centre: &JournalState,
    step: Step,
    nudged: f64,
) -> f64 {
    let (c, centre) = (bearing.radial_clearance, *centre);
    let mut film = FilmSolver::new(bearing, oil, [64, 16]).unwrap();
    if let Step::Implicit { duration, after } = step {
        let duration = duration - after;
        // From where the motion came: no cell is left exactly at the corner of its two conditions.
        let back =
            |at: [f64; 2], rate: [f64; 2]| [at[0] - duration * rate[0], at[1] - duration * rate[1]];
        let before = JournalState {
            position: back(centre.position, centre.velocity),
            tilt: back(centre.tilt, centre.tilt_rate),
            ..centre
        };
        assert!(
            film.react(&before, Step::Steady, &conditions())
                .unwrap()
                .settled
        );
        film.accept_step();
    }
    let tangent = film.react(&centre, step, &conditions()).unwrap().tangent;
    let mut worst = 0.0_f64;
    for rates in [false, true] {
        let analytic = if rates {
            tangent.by_rate
        } else {
            tangent.by_position
        };
        for column in 0..4 {
            // Small against the cells, so that the set mostly stays as it is.
            let unit = if column < 2 { c } else { c / 0.015 } * if rates { 200.0 } else { 1.0 };
            let by = nudged * unit;
            let mut react = |sign: f64| {
                let mut moved = centre;
                nudge(&mut moved, rates, column, sign * by);
                values(&film.react(&moved, step, &conditions()).unwrap().reaction)
            };
            let (plus, minus) = (react(1.0), react(-1.0));
            for row in 0..4 {
                let difference = (plus[row] - minus[row]) / (2.0 * by);
                let scale = analytic[row].iter().enumerate().fold(0.0_f64, |s, (k, v)| {
                    s.max(v.abs() * if k < 2 { 1.0 } else { 1.0 / 0.015 })
                });
                let lever = if column < 2 { 1.0 } else { 1.0 / 0.015 };
                let deviation = (analytic[row][column] - difference).abs() * lever;
                worst = worst.max(deviation / scale.max(1e-300));
            }
        }
    }
    worst
}

#[test]
fn tangents_equal_differences_for_every_closure_and_step() {
    let steps = [
        Step::Steady,
        Step::Implicit {
            duration: 1e-4,
            after: 0.0,
        },
        Step::Implicit {
            duration: 1e-4,
            after: 5e-5,
        },
    ];
    for cavitation in [
        Cavitation::Gumbel,
        Cavitation::Reynolds,
        Cavitation::MassConserving,
    ] {
        for step in steps {
            let bearing = Bearing {
                cavitation,
                feeds: vec![feed_hole()],
                ..big_end()
            };
            let deviation = worst_deviation(&bearing, step);
            assert!(deviation < 2e-5, "{cavitation:?} {step:?}: {deviation:e}");
        }
    }
}

#[test]
fn tangents_follow_the_line_of_centres() {
    for cavitation in [
        Cavitation::Gumbel,
        Cavitation::Reynolds,
        Cavitation::MassConserving,
    ] {
        let inlet = Inlet::MaxFilmLine { pressure: 2e5 };
        let bearing = Bearing {
            cavitation,
            inlet,
            ..big_end()
        };
        let deviation = worst_deviation(&bearing, Step::Steady);
        assert!(deviation < 2e-5, "{cavitation:?}: {deviation:e}");
    }
}

/// A hole in the journal and a groove in the shell, each behind its own line; and the groove alone
/// behind a line that starves it.
fn behind_lines() -> [(&'static str, Vec<Feed>); 3] {
    let behind = |feed: Feed, resistance: f64| Feed {
        line: FeedLine::Resistive { resistance },
        ..feed
    };
    let groove = Feed {
        shape: FeedShape::Rectangle {
            length: 9e-3,
            width: 15e-3,
        },
        carried_by: Carrier::Shell,
        angle: 4.0,
        pressure: 2e5,
        ..feed_hole()
    };
    [
        (
            "two lines",
            vec![behind(feed_hole(), 2e10), behind(groove.clone(), 4e10)],
        ),
        (
            "hole behind a line beside a groove without",
            vec![behind(feed_hole(), 3e10), groove.clone()],
        ),
        ("starved", vec![behind(groove, 1e12)]),
    ]
}

#[test]
fn tangents_include_the_lines() {
    let steps = [
        Step::Steady,
        Step::Implicit {
            duration: 1e-4,
            after: 5e-5,
        },
    ];
    for cavitation in [
        Cavitation::Gumbel,
        Cavitation::Reynolds,
        Cavitation::MassConserving,
    ] {
        for (name, feeds) in behind_lines() {
            for step in steps {
                let bearing = Bearing {
                    cavitation,
                    feeds: feeds.clone(),
                    ..big_end()
                };
                // A cell of the moving film fills within 1e-7 of the clearance: no derivative.
                let deviation = worst_deviation_within(&bearing, step, 1e-8);
                assert!(
                    deviation < 2e-6,
                    "{cavitation:?} {name} {step:?}: {deviation:e}"
                );
            }
        }
    }
}

/// What the tests above differentiate: one line feeds in part, the other starves.
#[test]
fn the_lines_are_at_work() {
    let solved = |feeds: Vec<Feed>| {
        let bearing = Bearing { feeds, ..big_end() };
        let mut film = FilmSolver::new(&bearing, &oil(), [64, 16]).unwrap();
        let state = state(bearing.radial_clearance);
        film.react(&state, Step::Steady, &conditions()).unwrap();
        film.feed_flows().to_vec()
    };
    let [(_, two), _, (_, starved)] = behind_lines();
    for (feed, flow) in two.iter().zip(solved(two.clone())) {
        let lost = 1.0 - flow.pressure / feed.pressure;
        assert!((0.05..0.999).contains(&lost), "{flow:?}");
    }
    assert_eq!(solved(starved)[0].pressure, 0.0);
}

fn rough(contact: f64) -> Finish {
    Finish::Rough(RoughFinish {
        roughness: Roughness {
            journal: 0.4e-6,
            shell: 0.8e-6,
            peklenik_journal: 3.0,
            peklenik_shell: 1.0,
        },
        contact: ContactLaw::GreenwoodTripp(GreenwoodTripp {
            factor: contact,
            asperity_product: 0.05,
            modulus: 53.3e9,
            summit_height: 0.3e-6,
            summit_roughness: Some(0.8e-6),
        }),
        boundary_friction: 0.05,
    })
}

/// An oil that thickens under pressure and thins under shear.
fn engine_oil() -> Lubricant {
    Lubricant {
        viscosity_pressure: PressureLaw::Barus { alpha: 9.5e-9 },
        shear_thinning: ShearThinning::Cross {
            second_newtonian_ratio: 0.4,
            critical_shear_rate: 2e6,
            exponent: 0.8,
            reference: None,
        },
        ..oil()
    }
}

#[test]
fn tangents_of_rough_surfaces_and_engine_oil_equal_differences() {
    let steps = [
        Step::Steady,
        Step::Implicit {
            duration: 1e-4,
            after: 5e-5,
        },
    ];
    for cavitation in [
        Cavitation::Gumbel,
        Cavitation::Reynolds,
        Cavitation::MassConserving,
    ] {
        for (step, finish) in steps
            .into_iter()
            .flat_map(|s| [(s, Finish::Smooth), (s, rough(1e-3))])
        {
            let bearing = Bearing {
                cavitation,
                feeds: vec![feed_hole()],
                finish: finish.clone(),
                ..big_end()
            };
            let centre = state(bearing.radial_clearance);
            let deviation = worst_deviation_of(&bearing, &engine_oil(), &centre, step, 1e-6);
            assert!(
                deviation < 2e-5,
                "{cavitation:?} {step:?} {finish:?}: {deviation:e}"
            );
        }
    }
}

/// Beyond nominal contact the asperities carry, and the tangents hold there as anywhere.
#[test]
fn tangents_hold_where_the_surfaces_overlap() {
    let bearing = Bearing {
        cavitation: Cavitation::Reynolds,
        finish: rough(1e-3),
        ..big_end()
    };
    // A film between overlapping surfaces is thicker in pressure than an oil that stiffens can answer.
    let thinning = Lubricant {
        viscosity_pressure: PressureLaw::None,
        ..engine_oil()
    };
    let c = bearing.radial_clearance;
    let centre = JournalState {
        position: [0.8 * c, 0.61 * c],
        tilt: [0.0; 2],
        velocity: [0.0; 2],
        tilt_rate: [0.0; 2],
        journal_speed: 40.0,
        ..state(c)
    };
    let mut film = FilmSolver::new(&bearing, &thinning, [64, 16]).unwrap();
    let answer = film.react(&centre, Step::Steady, &conditions()).unwrap();
    let contact = answer.reaction.contact_force;
    assert_eq!(answer.outcome, Outcome::Converged);
    assert!(contact[0].hypot(contact[1]) > 0.0);
    assert!(film.summary().minimum_film_thickness.value < 0.0);
    let deviation = worst_deviation_of(&bearing, &thinning, &centre, Step::Steady, 1e-7);
    assert!(deviation < 2e-5, "{deviation:e}");
}

/// Asperities that press on a shell that gives way: both answer the journal together.
#[test]
fn tangents_of_asperities_on_a_soft_shell_equal_differences() {
    for cavitation in [Cavitation::Gumbel, Cavitation::Reynolds] {
        let bearing = Bearing {
            cavitation,
            finish: rough(1e-3),
            elasticity: Elasticity::Layer {
                thickness: 2e-3,
                modulus: 70e9,
                poisson: 0.3,
            },
            ..big_end()
        };
        let oil = Lubricant {
            viscosity_pressure: PressureLaw::None,
            ..engine_oil()
        };
        let c = bearing.radial_clearance;
        let centre = JournalState {
            position: [0.8 * c, 0.61 * c],
            tilt: [0.0; 2],
            velocity: [0.0; 2],
            tilt_rate: [0.0; 2],
            journal_speed: 20.0,
            ..state(c)
        };
        let mut film = FilmSolver::new(&bearing, &oil, [64, 16]).unwrap();
        let answer = film.react(&centre, Step::Steady, &conditions()).unwrap();
        assert_eq!(answer.outcome, Outcome::Converged, "{cavitation:?}");
        let contact = answer.reaction.contact_force;
        let force = answer.reaction.force();
        assert!(contact[0].hypot(contact[1]) > 0.05 * force[0].hypot(force[1]));
        let deviation = worst_deviation_of(&bearing, &oil, &centre, Step::Steady, 1e-7);
        assert!(deviation < 2e-5, "{cavitation:?}: {deviation:e}");
    }
}
