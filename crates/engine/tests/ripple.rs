//! Speed ripple fed back: what settles solves the exact equation of a crank slider, whose inertia
//! swings with the crank angle.
#![allow(clippy::unwrap_used)]

use sommerfeld_engine::{
    CrankMotion, CrankTrain, Cylinder, Disc, EngineLayout, Harmonic, RippleSettings, Rod,
    SettledRipple, Strokes, Throw, TorsionalChain, TorsionalLink, harmonics, settle_ripple,
};
use sommerfeld_film::Outcome;
use std::f64::consts::TAU;

const HIGHEST_ORDER: f64 = 40.0;

/// A single-cylinder engine with heavy running gear.
fn train() -> CrankTrain {
    CrankTrain {
        layout: EngineLayout {
            cylinders: vec![Cylinder {
                throw: 0,
                bank_angle: 0.0,
                firing_angle: 0.0,
                axial: 0.0,
            }],
            throws: vec![Throw {
                angle: 0.0,
                axial: 0.0,
            }],
            mains: vec![-0.05, 0.05],
            strokes: Strokes::Four,
        },
        bore: 0.1,
        crank_radius: 0.05,
        rod_length: 0.16,
        pin_offset: 0.004,
        piston_mass: 0.9,
        rod: Rod {
            mass: 0.8,
            centre_of_gravity: 0.05,
            inertia: 0.003,
        },
        unbalances: Vec::new(),
        crankcase_pressure: 1e5,
    }
}

/// Torque of the gas over the angle of the throw: a smooth cycle of two turns, N m.
fn gas(angle: f64) -> f64 {
    let stroke = 0.5 * angle;
    let burst = ((stroke - 0.35).cos() - 1.0) * 9.0;
    700.0 * burst.exp() * (angle).sin() + 40.0 * angle.sin() * (0.5 * stroke).cos().powi(2) + 20.0
}

/// Inertia of piston and rod over the angle and its slope, the slope by a central difference of high
/// order.
fn inertia(train: &CrankTrain, angle: f64) -> (f64, f64) {
    let (at, h) = (|by: f64| train.slider_inertia(angle + by), 1e-3);
    let slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
    (at(0.0), slope)
}

/// Exact torque of gas, piston and rod on the throw over the crank angle, by orders.
fn torques(train: &CrankTrain, motion: &CrankMotion) -> Vec<Vec<Harmonic>> {
    let count = 720;
    let values: Vec<f64> = (0..count)
        .map(|at| {
            let instant = motion.at(0.0, 2.0 * TAU * f64::from(at) / f64::from(count));
            let (inertia, slope) = inertia(train, instant.angle);
            gas(instant.angle)
                - inertia * instant.acceleration
                - 0.5 * slope * instant.speed * instant.speed
        })
        .collect();
    vec![harmonics(&values, 2.0, HIGHEST_ORDER)]
}

fn settle(train: &CrankTrain, chain: &TorsionalChain, speed: f64) -> SettledRipple {
    let settings = RippleSettings {
        tolerance: 1e-12,
        maximum_iterations: 60,
    };
    let means = train.mean_slider_inertias();
    settle_ripple(chain, speed, &[0.0], &means, settings, |motion| {
        torques(train, motion)
    })
    .unwrap()
}

/// With one disc the equation has an integral: `(J_c + J(b)) b'^2 / 2` gains what gas and load do, so
/// speed over the angle is a quadrature, and so is time.
#[test]
fn ripple_of_a_rigid_engine_is_that_of_its_energy() {
    let train = train();
    let crank = 0.15;
    let disc = Disc {
        inertia: crank + train.mean_slider_inertias()[0],
        damping: 0.0,
        throw: Some(0),
    };
    let chain = TorsionalChain {
        discs: vec![disc],
        links: vec![],
    };
    let speed = 120.0;
    let settled = settle(&train, &chain, speed);
    assert_eq!(
        settled.outcome,
        Outcome::Converged,
        "{} after {}",
        settled.change,
        settled.iterations
    );

    // Midpoints of the cells, and the work up to each border by Simpson's rule.
    let cells = 14400_u32;
    let width = 2.0 * TAU / f64::from(cells);
    let border = |at: u32| f64::from(at) * width;
    let work_in = |at: u32| {
        width / 6.0 * (gas(border(at)) + 4.0 * gas(border(at) + 0.5 * width) + gas(border(at + 1)))
    };
    let load = (0..cells).map(work_in).sum::<f64>() / (2.0 * TAU);
    assert!((settled.response.load_torque / load - 1.0).abs() < 1e-9);
    let mut gained = vec![0.0];
    for at in 0..cells {
        gained.push(gained[at as usize] + work_in(at) - load * width);
    }
    let total = |angle: f64| crank + train.slider_inertia(angle);
    let speeds = |energy: f64| -> Vec<f64> {
        let of_one = |at: u32| (2.0 * (energy + gained[at as usize]) / total(border(at))).sqrt();
        (0..=cells).map(of_one).collect()
    };
    // Time at each border; the energy at angle 0 is that which makes the cycle last as long as the
    // mean speed says. The trapezoid is exact beyond all powers over the whole period.
    let period = 2.0 * TAU / speed;
    let lasts = |energy: f64| {
        speeds(energy)[1..]
            .iter()
            .map(|speed| width / speed)
            .sum::<f64>()
    };
    let (mut low, mut high) = (
        0.3 * 0.5 * crank * speed * speed,
        3.0 * 0.5 * crank * speed * speed,
    );
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        *(if lasts(middle) > period {
            &mut low
        } else {
            &mut high
        }) = middle;
    }
    let exact = speeds(low);
    let swing = |values: &[f64]| {
        let highest = values.iter().copied().fold(f64::MIN, f64::max);
        highest - values.iter().copied().fold(f64::MAX, f64::min)
    };
    assert!(
        swing(&exact) > 0.2 * speed,
        "a case without ripple shows nothing: {}",
        swing(&exact)
    );

    // The settled motion: at equal angle of the throw, equal speed.
    let mut largest: f64 = 0.0;
    for at in 0..cells {
        let crank_angle = border(at);
        let instant = settled.motion.at(0.0, crank_angle);
        let place = instant.angle.rem_euclid(2.0 * TAU) / width;
        let (cell, share) = (place.floor(), place.fract());
        let row = cell as usize % cells as usize;
        let between = exact[row] + share * (exact[row + 1] - exact[row]);
        largest = largest.max((instant.speed - between).abs());
    }
    assert!(
        largest < 1e-5 * swing(&exact),
        "{largest} rad/s of {}",
        swing(&exact)
    );

    // At even speed the same torques give another ripple: the feedback is no small matter here.
    let even = chain
        .forced_response(speed, &torques(&train, &CrankMotion::even(speed)))
        .unwrap();
    let of = |harmonics: &[Harmonic], order: f64| {
        let one = harmonics.iter().find(|one| one.order == order).unwrap();
        one.cos.hypot(one.sin)
    };
    let first = of(&even.twists[0].harmonics, 2.0);
    let last = of(&settled.response.twists[0].harmonics, 2.0);
    assert!((first / last - 1.0).abs() > 0.01, "{first}, {last}");
}

/// Throw, soft link and flywheel, damped, integrated in time until the cycle repeats.
#[test]
fn ripple_of_an_elastic_engine_is_that_of_its_equation_in_time() {
    let train = train();
    let (crank, flywheel, stiffness, damping) = (0.03, 0.4, 4000.0, 3.0);
    let mean = train.mean_slider_inertias()[0];
    let chain = TorsionalChain {
        discs: vec![
            Disc {
                inertia: crank + mean,
                damping: 0.05,
                throw: Some(0),
            },
            Disc {
                inertia: flywheel,
                damping: 1.5,
                throw: None,
            },
        ],
        links: vec![TorsionalLink {
            stiffness,
            damping,
            loss_factor: 0.0,
        }],
    };
    let speed = 150.0;
    let settled = settle(&train, &chain, speed);
    assert_eq!(
        settled.outcome,
        Outcome::Converged,
        "{} after {}",
        settled.change,
        settled.iterations
    );

    let load = settled.response.load_torque;
    let slope = |[throw, wheel, throw_rate, wheel_rate]: [f64; 4]| {
        let (inertia, swing) = inertia(&train, throw);
        let link = stiffness * (throw - wheel) + damping * (throw_rate - wheel_rate);
        let driving = gas(throw) - 0.5 * swing * throw_rate * throw_rate - 0.05 * throw_rate - link;
        let driven = link - 1.5 * wheel_rate - load;
        [
            throw_rate,
            wheel_rate,
            driving / (crank + inertia),
            driven / flywheel,
        ]
    };
    let steps = 3600_u32;
    let step = 2.0 * TAU / speed / f64::from(steps);
    let advance = |state: [f64; 4]| {
        let ahead = |slope: [f64; 4], by: f64| [0, 1, 2, 3].map(|j| state[j] + by * slope[j]);
        let k1 = slope(state);
        let k2 = slope(ahead(k1, 0.5 * step));
        let k3 = slope(ahead(k2, 0.5 * step));
        let k4 = slope(ahead(k3, step));
        [0, 1, 2, 3].map(|j| state[j] + step / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]))
    };
    // Begins beside the periodic motion, which draws it in: the load acts as found, so a wrong mean
    // torque would show as a drift of speed.
    let twist = |disc: usize, angle: f64| {
        let harmonics = &settled.response.twists[disc].harmonics;
        harmonics.iter().fold([0.0; 2], |sum, one| {
            [sum[0] + one.at(angle)[0], sum[1] + one.at(angle)[1]]
        })
    };
    let start = [twist(0, 0.0), twist(1, 0.0)];
    let mut state = [
        start[0][0],
        start[1][0],
        speed * (1.0 + start[0][1]),
        speed * 0.999 * (1.0 + start[1][1]),
    ];
    let cycles = 150;
    for _ in 0..cycles * steps {
        state = advance(state);
    }
    // Autonomous: time may be shifted. Compared at equal angles of the throw.
    let mut largest: f64 = 0.0;
    let mut swing: f64 = 0.0;
    for _ in 0..steps {
        state = advance(state);
        let mut angle = state[0];
        for _ in 0..50 {
            angle = state[0] - twist(0, angle)[0];
        }
        let [ours, theirs] = [0, 1].map(|disc| speed * (1.0 + twist(disc, angle)[1]));
        largest = largest
            .max((ours - state[2]).abs())
            .max((theirs - state[3]).abs());
        largest = largest.max(speed * (angle + twist(1, angle)[0] - state[1]).abs());
        swing = swing.max((ours - speed).abs());
    }
    assert!(swing > 10.0);
    assert!(largest < 1e-8 * swing, "{largest} rad/s of {swing}");
}

/// The mean of what a slider adds, by its series to the second power of the crank ratio, and a piston
/// alone on a long rod: half its mass times the crank radius squared.
#[test]
fn mean_inertia_of_a_slider_is_that_of_its_masses() {
    let mut long = train();
    (long.rod_length, long.pin_offset) = (500.0, 0.0);
    long.rod = Rod {
        mass: 0.0,
        centre_of_gravity: 0.0,
        inertia: 0.0,
    };
    let half = 0.5 * long.piston_mass * long.crank_radius.powi(2);
    assert!((long.mean_slider_inertias()[0] / half - 1.0).abs() < 1e-7);

    // A rod of two point masses: one turns with the pin, one goes with the piston.
    let mut two = train();
    let (a, l) = (0.05, two.rod_length);
    two.rod = Rod {
        mass: 0.8,
        centre_of_gravity: a,
        inertia: 0.8 * a * (l - a),
    };
    let mut points = train();
    points.rod = Rod {
        mass: 0.0,
        centre_of_gravity: 0.0,
        inertia: 0.0,
    };
    points.piston_mass += 0.8 * a / l;
    let turning = 0.8 * (1.0 - a / l) * two.crank_radius.powi(2);
    for angle in [0.1, 1.3, 2.9, 4.4] {
        let (one, other) = (
            two.slider_inertia(angle),
            points.slider_inertia(angle) + turning,
        );
        assert!((one / other - 1.0).abs() < 1e-13, "{angle}: {one}, {other}");
    }
    let mut pair = train();
    pair.layout.cylinders.push(pair.layout.cylinders[0]);
    assert_eq!(
        pair.mean_slider_inertias()[0],
        2.0 * train().mean_slider_inertias()[0]
    );
}

/// The inertia torque of the loads and the inertia here are two derivations of one thing. Torques that
/// do not ask for the motion settle in the step that confirms them.
#[test]
fn torques_that_do_not_depend_on_the_motion_settle_at_once() {
    let disc = |inertia, throw| Disc {
        inertia,
        damping: 0.5,
        throw,
    };
    let link = TorsionalLink {
        stiffness: 3e4,
        damping: 0.0,
        loss_factor: 0.02,
    };
    let chain = TorsionalChain {
        discs: vec![disc(0.1, Some(0)), disc(1.0, None)],
        links: vec![link],
    };
    let given = || {
        vec![vec![Harmonic {
            order: 0.5,
            cos: 30.0,
            sin: 4.0,
        }]]
    };
    let settled = settle_ripple(
        &chain,
        100.0,
        &[0.3],
        &[0.0],
        RippleSettings::default(),
        |_| given(),
    )
    .unwrap();
    assert_eq!(
        (settled.outcome, settled.iterations),
        (Outcome::Converged, 2)
    );
    assert_eq!(
        settled.response,
        chain.forced_response(100.0, &given()).unwrap()
    );
    assert_eq!(settled.motion.twists[0].0, 0.3);

    let never = RippleSettings {
        tolerance: 1e-9,
        maximum_iterations: 1,
    };
    let stopped = settle_ripple(&chain, 100.0, &[0.3], &[0.0], never, |_| given()).unwrap();
    assert_eq!(stopped.outcome, Outcome::NotConverged);
    let short = settle_ripple(&chain, 100.0, &[0.3], &[], never, |_| given()).unwrap_err();
    assert!(
        short.to_string().contains("mean inertias: 0 given, 1 due"),
        "{short}"
    );
}
