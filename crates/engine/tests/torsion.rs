//! Torsional chains against other methods: the eigenvalues of a published chain, integration in time,
//! balances of torque and power.
#![allow(clippy::unwrap_used)]

use sommerfeld_engine::{Disc, Harmonic, TorsionalChain, TorsionalLink, delayed};
use std::f64::consts::{PI, TAU};

/// Quantity, number, value as printed.
fn reference() -> Vec<(String, usize, String)> {
    let path = format!(
        "{}/../../validation/torsion-i6/reference.csv",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        (
            cells[0].to_owned(),
            cells[1].parse().unwrap(),
            cells[2].to_owned(),
        )
    })
    .collect()
}

fn inline_six() -> TorsionalChain {
    let rows = reference();
    let of = |name: &str| -> Vec<f64> {
        let rows = rows.iter().filter(|(quantity, ..)| quantity == name);
        rows.map(|(.., value)| value.parse().unwrap()).collect()
    };
    let disc = |(at, inertia): (usize, f64)| {
        let throw = (2..8).contains(&at).then(|| at - 2);
        let damping = if throw.is_some() { 2.0 } else { 0.0 };
        Disc {
            inertia,
            damping,
            throw,
        }
    };
    let link = |stiffness| TorsionalLink {
        stiffness,
        damping: 0.0,
        loss_factor: 0.035,
    };
    TorsionalChain {
        discs: of("inertia").into_iter().enumerate().map(disc).collect(),
        links: of("stiffness").into_iter().map(link).collect(),
    }
}

/// A torque like that of a cylinder, for each throw after its firing angle, firing order 1-5-3-6-2-4.
fn torques() -> Vec<Vec<Harmonic>> {
    let one: Vec<Harmonic> = (0..=24)
        .map(|at| {
            let order = 0.5 * f64::from(at);
            let size = 400.0 / (1.0 + 0.2 * order * order);
            Harmonic {
                order,
                cos: 0.45 * size,
                sin: size,
            }
        })
        .collect();
    let place = [0.0, 4.0, 2.0, 5.0, 1.0, 3.0];
    place
        .iter()
        .map(|place| delayed(&one, place * 2.0 * TAU / 6.0))
        .collect()
}

#[test]
fn frequencies_of_the_inline_six_are_those_printed() {
    let found = inline_six().natural_vibration().unwrap().frequencies;
    for (_, number, printed) in reference()
        .iter()
        .filter(|(quantity, ..)| quantity == "frequency")
    {
        let decimals = printed
            .split_once('.')
            .map_or(0, |(_, decimals)| decimals.len());
        let rounded = format!("{:.decimals$}", found[number - 1]);
        assert_eq!(
            &rounded,
            printed,
            "frequency {number}: {}",
            found[number - 1]
        );
    }
}

/// What the excitation puts into the vibration leaves it in the links and at the discs, and the mean
/// torque reaches the load.
#[test]
fn torque_and_power_are_balanced() {
    let (chain, speed) = (inline_six(), 2000.0 * TAU / 60.0);
    let torques = torques();
    let response = chain.forced_response(speed, &torques).unwrap();
    let mut power = 0.0;
    for (throw, torque) in torques.iter().enumerate() {
        for (torque, twist) in torque.iter().zip(&response.twists[throw + 2].harmonics) {
            assert_eq!(torque.order, twist.order);
            // Mean of torque times d(twist)/dt.
            power += 0.5 * torque.order * speed * (torque.cos * twist.sin - torque.sin * twist.cos);
        }
    }
    let heat = response
        .link_heat
        .iter()
        .chain(&response.disc_heat)
        .sum::<f64>();
    assert!(
        power > 10.0 && (heat / power - 1.0).abs() < 1e-10,
        "{power} W in, {heat} W out"
    );

    let given: f64 = torques.iter().map(|torque| torque[0].cos).sum();
    let taken = response.load_torque + 6.0 * 2.0 * speed;
    assert!(
        (taken / given - 1.0).abs() < 1e-13,
        "{given} N m given, {taken} taken"
    );
    let last = response.link_torques[7].harmonics[0];
    assert_eq!((last.order, last.cos), (0.0, response.load_torque));
    // The mean twist between neighbours carries it.
    let mean = |disc: usize| response.twists[disc].harmonics[0].cos;
    assert_eq!(mean(2), 0.0);
    assert!(((mean(7) - mean(8)) * 1.976e6 / last.cos - 1.0).abs() < 1e-10);
}

/// Below its first natural frequency by far the chain turns as one body: `-n^2 W^2 J x = T`.
#[test]
fn a_slow_chain_turns_as_one_body() {
    let mut chain = inline_six();
    for disc in &mut chain.discs {
        disc.damping = 0.0;
    }
    let (speed, mut torques) = (1.0, vec![Vec::new(); 6]);
    torques[3] = vec![Harmonic {
        order: 0.5,
        cos: 1.0,
        sin: -2.0,
    }];
    let inertia: f64 = chain.discs.iter().map(|disc| disc.inertia).sum();
    let response = chain.forced_response(speed, &torques).unwrap();
    for twist in &response.twists {
        let twist = twist.harmonics[1];
        assert!((twist.cos * -0.25 * inertia - 1.0).abs() < 1e-5);
        assert!((twist.sin * -0.25 * inertia + 2.0).abs() < 1e-5);
    }
}

/// Both masses of a dual-mass flywheel are discs, its bow springs a link: the chain with them is the
/// chain with a rigid flywheel once the springs are stiff, and soft springs keep the ripple from the
/// gearbox as a two-disc isolator does.
#[test]
fn a_dual_mass_flywheel_is_two_discs_and_a_link() {
    let with = |stiffness: f64| {
        let mut chain = inline_six();
        let flywheel = chain.discs.pop().unwrap();
        for share in [0.4, 0.6] {
            chain.discs.push(Disc {
                inertia: share * flywheel.inertia,
                ..flywheel
            });
        }
        chain.links.push(TorsionalLink {
            stiffness,
            damping: 0.0,
            loss_factor: 0.0,
        });
        chain
    };
    let speed = 1500.0 * TAU / 60.0;
    let nose = |chain: &TorsionalChain| {
        let response = chain.forced_response(speed, &torques()).unwrap();
        response.twists[0].harmonics[6]
    };
    let (rigid, stiff) = (nose(&inline_six()), nose(&with(1e12)));
    assert_eq!(rigid.order, 3.0);
    assert!(
        (rigid.cos - stiff.cos).hypot(rigid.sin - stiff.sin) < 1e-5 * rigid.cos.hypot(rigid.sin)
    );

    // Secondary over primary mass: 1 / (1 - (w/w2)^2) with w2 of the secondary alone.
    let stiffness = 2.0e4;
    let response = with(stiffness).forced_response(speed, &torques()).unwrap();
    let size = |disc: usize| {
        response.twists[disc].harmonics[6]
            .cos
            .hypot(response.twists[disc].harmonics[6].sin)
    };
    let secondary = stiffness / (0.6 * 2.075);
    let exact = 1.0 / (1.0 - (3.0 * speed).powi(2) / secondary);
    assert!((size(9) / size(8) / exact.abs() - 1.0).abs() < 1e-9);
    assert!(size(9) < 0.1 * size(8));
}

#[test]
fn misuse_is_refused_by_name() {
    let chain = inline_six();
    let refused = |torques: &[Vec<Harmonic>], speed| {
        chain
            .forced_response(speed, torques)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        refused(&torques(), 0.0),
        "speed = 0 must be positive and finite"
    );
    assert!(refused(&torques()[..5], 100.0).contains("throw 6 drives 1 discs"));
    let mut seven = torques();
    seven.push(Vec::new());
    assert!(refused(&seven, 100.0).contains("throw 7 drives 0 discs"));
    let mut odd = torques();
    odd[1][3].sin = f64::NAN;
    assert!(refused(&odd, 100.0).contains("throw 2: torque = NaN must be finite"));
    odd[1][3] = Harmonic {
        order: -1.0,
        cos: 0.0,
        sin: 0.0,
    };
    assert!(refused(&odd, 100.0).contains("throw 2: order = -1"));
}

#[test]
fn an_undamped_resonance_is_named_and_none_beside_it() {
    let disc = |throw| Disc {
        inertia: 0.5,
        damping: 0.0,
        throw,
    };
    let link = TorsionalLink {
        stiffness: 1.0e4,
        damping: 0.0,
        loss_factor: 0.0,
    };
    let chain = TorsionalChain {
        discs: vec![disc(Some(0)), disc(None)],
        links: vec![link],
    };
    let torque = [vec![Harmonic {
        order: 1.0,
        cos: 1.0,
        sin: 0.0,
    }]];
    let error = chain
        .forced_response(200.0, &torque)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("31.83") && error.contains("nothing damps it"),
        "{error}"
    );
    assert!(chain.forced_response(200.1, &torque).is_ok());
}

/// The chain in time, first order: `d/dt (x, v) = (v, M^-1 (T - C v - K x))`.
struct InTime<'a> {
    chain: &'a TorsionalChain,
    torques: &'a [Vec<Harmonic>],
    speed: f64,
}

impl InTime<'_> {
    fn slope(&self, time: f64, state: &[f64], has_torque: bool) -> Vec<f64> {
        let count = self.chain.discs.len();
        let (twist, rate) = state.split_at(count);
        let mut torque: Vec<f64> = (0..count)
            .map(|at| -self.chain.discs[at].damping * rate[at])
            .collect();
        for (at, link) in self.chain.links.iter().enumerate() {
            let passed = link.stiffness * (twist[at] - twist[at + 1])
                + link.damping * (rate[at] - rate[at + 1]);
            torque[at] -= passed;
            torque[at + 1] += passed;
        }
        for (at, disc) in self.chain.discs.iter().enumerate() {
            let Some(throw) = disc.throw.filter(|_| has_torque) else {
                continue;
            };
            let angle = self.speed * time;
            torque[at] += self.torques[throw]
                .iter()
                .map(|one| one.at(angle)[0])
                .sum::<f64>();
        }
        let rates = rate.iter().copied();
        rates
            .chain((0..count).map(|at| torque[at] / self.chain.discs[at].inertia))
            .collect()
    }

    /// Classical Runge-Kutta steps over one cycle of two turns; a row for each step and the end.
    fn cycle(&self, start: &[f64], steps: u32, has_torque: bool) -> Vec<Vec<f64>> {
        let step = 2.0 * TAU / self.speed / f64::from(steps);
        let mut rows = vec![start.to_vec()];
        for at in 0..steps {
            let (time, state) = (f64::from(at) * step, rows.last().unwrap().clone());
            let ahead = |slope: &[f64], by: f64| -> Vec<f64> {
                state
                    .iter()
                    .zip(slope)
                    .map(|(value, slope)| value + by * slope)
                    .collect()
            };
            let k1 = self.slope(time, &state, has_torque);
            let k2 = self.slope(time + 0.5 * step, &ahead(&k1, 0.5 * step), has_torque);
            let k3 = self.slope(time + 0.5 * step, &ahead(&k2, 0.5 * step), has_torque);
            let k4 = self.slope(time + step, &ahead(&k3, step), has_torque);
            let mean: Vec<f64> = (0..state.len())
                .map(|j| (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]) / 6.0)
                .collect();
            rows.push(ahead(&mean, step));
        }
        rows
    }

    /// The state that returns after a cycle: `(1 - P) x0 = b`, columns of `P` by integration.
    fn periodic(&self, steps: u32) -> Vec<Vec<f64>> {
        let count = 2 * self.chain.discs.len();
        let mut transition = nalgebra::DMatrix::zeros(count, count);
        for column in 0..count {
            let unit: Vec<f64> = (0..count)
                .map(|row| f64::from(u8::from(row == column)))
                .collect();
            let end = self.cycle(&unit, steps, false).pop().unwrap();
            transition.set_column(column, &nalgebra::DVector::from_vec(end));
        }
        let driven = self.cycle(&vec![0.0; count], steps, true).pop().unwrap();
        // The chain may stand anywhere, and so may a ring that only oil drives: the smallest state.
        let closed = nalgebra::DMatrix::identity(count, count) - transition;
        let right = nalgebra::DVector::from_vec(driven);
        let start = closed.svd(true, true).solve(&right, 1e-9).unwrap();
        self.cycle(start.as_slice(), steps, true)
    }
}

/// Viscous damping in links and against ground, integrated in time until the cycle closes: the same
/// twist and torque at every instant as the sum over the orders.
#[test]
fn vibration_by_orders_is_the_vibration_in_time() {
    let mut chain = inline_six().with_damper(&sommerfeld_engine::Damper::viscous(0.12, 90.0));
    for link in &mut chain.links[1..] {
        (link.damping, link.loss_factor) = (12.0, 0.0);
    }
    let speed = 1800.0 * TAU / 60.0;
    // Mean torques are taken out here: what balances them turns the chain away in time.
    let torques: Vec<Vec<Harmonic>> = torques().iter().map(|all| all[1..].to_vec()).collect();
    let response = chain.forced_response(speed, &torques).unwrap();
    let in_time = InTime {
        chain: &chain,
        torques: &torques,
        speed,
    };
    let steps = 9000;
    let rows = in_time.periodic(steps);

    let returned = rows[0].iter().zip(&rows[steps as usize]);
    assert!(
        returned
            .map(|(start, end)| (start - end).abs())
            .fold(0.0, f64::max)
            < 1e-9
    );
    let vibration = |disc: usize, angle: f64| {
        let twist = &response.twists[disc].harmonics[1..];
        twist.iter().fold([0.0; 2], |sum, one| {
            [sum[0] + one.at(angle)[0], sum[1] + one.at(angle)[1]]
        })
    };
    for (at, row) in rows.iter().enumerate().step_by(225) {
        let angle = 4.0 * PI * at as f64 / f64::from(steps);
        for link in 0..chain.links.len() {
            let [one, other] = [link, link + 1].map(|disc| vibration(disc, angle));
            let difference = row[link] - row[link + 1];
            let rate = row[chain.discs.len() + link] - row[chain.discs.len() + link + 1];
            // Against the size of the whole: the twist between nose and flywheel is a milliradian.
            let found = one[0] - other[0];
            if link > 0 {
                assert!(
                    (found - difference).abs() < 1e-9,
                    "{angle}, link {link}: {found}, {difference}"
                );
            }
            let torque: f64 = response.link_torques[link].harmonics[1..]
                .iter()
                .map(|one| one.at(angle)[0])
                .sum();
            let exact = chain.links[link].stiffness * difference + chain.links[link].damping * rate;
            assert!(
                (torque - exact).abs() < 1e-3,
                "{angle}, link {link}: {torque}, {exact} N m"
            );
        }
        let rate = vibration(9, angle)[1] * speed;
        assert!((rate - row[chain.discs.len() + 9]).abs() < 1e-6 * speed);
    }
}
