//! The floating pin: its share without films, and the balance of the friction of its two films.
#![allow(clippy::unwrap_used)] // an orbit that should run and does not fails the test

mod common;

use common::{SPEED, close, diagram, general, inline};
use sommerfeld_bearing::{JournalOrbit, LoadCycle, OrbitSettings, journal_orbit};
use sommerfeld_engine::{CrankMotion, PinBalance, PinFit, PinSpeed, Role, bearing_duties};
use sommerfeld_film::{
    Bearing, Cavitation, Conditions, Ends, FilmShear, Inlet, Outcome, Shape, ShortBearingFilm,
};
use std::ops::ControlFlow;

const VISCOSITY: f64 = 0.01;

fn bearing(width: f64, radial_clearance: f64) -> Bearing {
    Bearing {
        diameter: 0.042,
        width,
        radial_clearance,
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

fn orbit(bearing: &Bearing, cycle: &LoadCycle) -> JournalOrbit {
    let mut film = ShortBearingFilm::new(bearing, VISCOSITY).unwrap();
    let conditions = Conditions {
        temperature: 373.0,
        feed_pressures: None,
    };
    let settings = OrbitSettings {
        cycle_limit: 12,
        ..OrbitSettings::default()
    };
    let go_on = &mut |_: &_, _: &dyn sommerfeld_film::FilmForce, _| ControlFlow::Continue(());
    journal_orbit(&mut film, bearing, cycle, &conditions, &settings, go_on).unwrap()
}

#[test]
fn held_pins_turn_with_what_holds_them() {
    let (rod, boss) = (bearing(0.036, 20e-6), bearing(0.036, 20e-6));
    let of = |fit| PinSpeed::of(fit, &rod, &boss).at(0, 1.0, 4.0, 50.0);
    assert_eq!(of(PinFit::FixedInPiston), 0.0);
    assert_eq!(of(PinFit::FixedInRod), 50.0);
    assert_eq!(of(PinFit::Given(0.3)), 15.0);
    // equal films share the speed
    close(of(PinFit::Floating), 25.0, 1e-13, "equal films");
    // twice the width and half the clearance drag four times as much
    let wide = PinSpeed::of(PinFit::Floating, &bearing(0.072, 10e-6), &boss);
    close(
        wide.at(3, 1.0, 4.0, 50.0),
        40.0,
        1e-13,
        "a stronger film in the rod",
    );
}

#[test]
fn tables_are_periodic_and_linear() {
    let table = PinSpeed::Tables(vec![vec![[0.0, 1.0], [1.0, 3.0], [3.0, -1.0]]]);
    let at = |angle| table.at(0, angle, 4.0, f64::NAN);
    close(at(0.5), 2.0, 1e-15, "between");
    close(at(3.5), 0.0, 1e-15, "over the seam");
    close(at(-0.5), 0.0, 1e-15, "before");
    close(at(-1e-17), 1.0, 1e-15, "just before the seam");
    close(at(9.0), 3.0, 1e-15, "turns later");
    assert!(table.at(1, 0.5, 4.0, 0.0).is_nan());
}

/// Residual and rounds of orbits and balance until the torques cancel to a tolerance; each balance after the one
/// before, or all alike.
fn balanced(bearings: &[Bearing; 2], tolerance: f64, learns: bool) -> (f64, usize) {
    let train = general(inline(&[1]));
    let motion = CrankMotion::even(SPEED);
    let mut pin = PinSpeed::of(PinFit::Floating, &bearings[0], &bearings[1]);
    let mut before: Option<PinBalance> = None;
    let mut residual = f64::INFINITY;
    let mut rounds = 0;
    while residual > tolerance && rounds < 16 {
        let duties = bearing_duties(&train, &diagram(), &motion, &pin, 720);
        let of = |role| {
            let duty = duties.iter().find(|duty| duty.role == role).unwrap();
            let place = usize::from(role == Role::PistonBoss);
            orbit(&bearings[place], &duty.cycle)
        };
        let orbits = [of(Role::SmallEnd), of(Role::PistonBoss)];
        for orbit in &orbits {
            assert_eq!(orbit.outcome, Outcome::Converged, "round {rounds}");
        }
        let balance = match &before {
            Some(before) if learns => before.after(&orbits[0], &orbits[1]).unwrap(),
            _ => PinBalance::of(&orbits[0], &orbits[1]).unwrap(),
        };
        // the torques themselves, not what the balance says of them
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for (rod, boss) in orbits[0].points.iter().zip(&orbits[1].points) {
            let torques = [rod, boss].map(|point| point.reaction.friction_torque_journal);
            worst = worst.max((torques[0] + torques[1]).abs());
            largest = largest.max(torques[0].abs()).max(torques[1].abs());
        }
        residual = worst / largest;
        close(balance.residual, residual, 1e-12, "residual");
        pin = PinSpeed::Tables(vec![balance.speeds.clone()]);
        before = Some(balance);
        rounds += 1;
    }
    (residual, rounds)
}

#[test]
fn friction_of_both_films_cancels_on_a_floating_pin() {
    let bearings = [bearing(0.040, 21e-6), bearing(0.044, 15e-6)];
    for learns in [false, true] {
        let (residual, rounds) = balanced(&bearings, 1e-4, learns);
        assert!(
            residual <= 1e-4 && rounds < 10,
            "{residual} after {rounds} rounds"
        );
        assert!(rounds > 3, "concentric films are not the answer");
    }
}

/// In loose films the pressure turns a pin by more than the shear brakes it: by what the shear alone says the speeds
/// come no closer in sixteen rounds.
#[test]
fn friction_cancels_on_a_pin_that_thin_films_lead_around() {
    let loose = [bearing(0.022, 20e-6), bearing(0.026, 20e-6)].map(|film| Bearing {
        diameter: 0.5 * film.diameter,
        ..film
    });
    let (residual, rounds) = balanced(&loose, 2e-2, true);
    assert!(residual <= 2e-2, "{residual} after {rounds} rounds");
    let (residual, _) = balanced(&loose, 2e-2, false);
    assert!(residual > 1.0, "{residual}");
}

#[test]
fn orbits_that_do_not_belong_together_balance_nothing() {
    let train = general(inline(&[1]));
    let motion = CrankMotion::even(SPEED);
    let pin = PinSpeed::Share(0.5);
    let film = bearing(0.04, 20e-6);
    let duties = bearing_duties(&train, &diagram(), &motion, &pin, 720);
    let mut rod = orbit(&film, &duties[3].cycle);
    let boss = orbit(&film, &duties[4].cycle);
    assert_eq!(
        (duties[3].role, duties[4].role),
        (Role::SmallEnd, Role::PistonBoss)
    );
    assert!(PinBalance::of(&rod, &boss).is_some());
    rod.points.pop();
    assert_eq!(PinBalance::of(&rod, &boss), None);
    // a pin held in the rod does not move in it: there is nothing to balance
    let pin = PinSpeed::Share(1.0);
    let duties = bearing_duties(&train, &diagram(), &motion, &pin, 720);
    let still = orbit(&film, &duties[3].cycle);
    assert_eq!(PinBalance::of(&still, &boss), None);
    rod.points.clear();
    assert_eq!(PinBalance::of(&rod, &rod), None);
}
