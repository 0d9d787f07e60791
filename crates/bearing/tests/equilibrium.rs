//! Equilibria, coefficients and the linear whirl threshold against closed forms.
#![allow(clippy::unwrap_used)]

mod common;

use common::{CONDITIONS, plain_bearing, table};
use sommerfeld_bearing::{
    Coefficients, EquilibriumRequest, EquilibriumSettings, find_equilibrium, whirl_threshold,
};
use sommerfeld_film::closed_form::short;
use sommerfeld_film::{
    FilmForce, JournalState, LongBearingFilm, MobilityFilm, Outcome, ShortBearingFilm, Step,
};

fn request(load: [f64; 2], journal_speed: f64) -> EquilibriumRequest {
    EquilibriumRequest {
        load,
        moment: None,
        frame: JournalState {
            journal_speed,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings::default(),
    }
}

/// Every film finds back the position from which its load was taken, over the whole range of
/// eccentricities, directions and senses of rotation.
#[test]
fn every_eccentricity_is_found_back() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let mut films: Vec<Box<dyn FilmForce>> = vec![
        Box::new(ShortBearingFilm::new(&bearing, 0.01).unwrap()),
        Box::new(MobilityFilm::new(&bearing, 0.01).unwrap()),
        Box::new(LongBearingFilm::new(&bearing, 0.01).unwrap()),
    ];
    let mut most = 0;
    for film in &mut films {
        for eps in [0.01, 0.1, 0.3, 0.6, 0.9, 0.97, 0.99, 0.999] {
            for (angle, speed) in [(0.0, 300.0), (1.2, -300.0), (2.9, 30.0), (5.0, 3000.0)] {
                let mut request = request([0.0; 2], speed);
                request.frame.position = [f64::cos(angle), f64::sin(angle)]
                    .map(|component| component * eps * bearing.radial_clearance);
                let answer = film
                    .react(&request.frame, Step::Steady, &CONDITIONS)
                    .unwrap();
                request.load = answer.reaction.force().map(|force| -force);
                let found =
                    find_equilibrium(film.as_mut(), &bearing, &request, &CONDITIONS).unwrap();
                assert_eq!(
                    found.outcome,
                    Outcome::Converged,
                    "eps {eps}: {:#?}",
                    found.table
                );
                assert!(found.residual < 1e-9);
                let error = (found.state.position[0] - request.frame.position[0])
                    .hypot(found.state.position[1] - request.frame.position[1]);
                let gap = (1.0 - eps) * bearing.radial_clearance;
                assert!(
                    error < 1e-7 * gap.min(eps * bearing.radial_clearance),
                    "eps {eps}: {error:e}"
                );
                most = most.max(found.iterations());
            }
        }
    }
    assert!(most <= 25, "{most} iterations");
}

#[test]
fn a_far_start_is_survived() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let mut film = ShortBearingFilm::new(&bearing, 0.01).unwrap();
    for eps in [0.0, 0.5, 0.999] {
        for load in [0.1, 100.0, 1e6] {
            let mut request = request([-load, load], 300.0);
            request.start = Some([eps * bearing.radial_clearance, 0.0]);
            let found = find_equilibrium(&mut film, &bearing, &request, &CONDITIONS).unwrap();
            assert_eq!(
                found.outcome,
                Outcome::Converged,
                "eps {eps}, load {load}: {:#?}",
                found.table
            );
        }
    }
}

#[test]
fn no_load_rests_in_the_centre_and_no_speed_carries_nothing() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let mut film = ShortBearingFilm::new(&bearing, 0.01).unwrap();
    let unloaded = request([0.0, 0.0], 300.0);
    let found = find_equilibrium(&mut film, &bearing, &unloaded, &CONDITIONS).unwrap();
    assert_eq!(found.outcome, Outcome::Converged);
    assert!(found.state.eccentricity() < 1e-9 * bearing.radial_clearance);
    let standing = request([100.0, 0.0], 0.0);
    let found = find_equilibrium(&mut film, &bearing, &standing, &CONDITIONS).unwrap();
    assert_eq!(found.outcome, Outcome::NoSolution);
}

/// M. I. Friswell et al., Dynamics of Rotating Machines, Cambridge 2010, p. 177 example, turned to x
/// along the load and y 90 degrees ahead.
#[test]
fn friswell_short_bearing_rotor() {
    let bearing = plain_bearing(0.1, 0.03, 0.1e-3);
    let mut film = ShortBearingFilm::new(&bearing, 0.1).unwrap();
    let load_angle: f64 = -2.0;
    let load = [525.0 * load_angle.cos(), 525.0 * load_angle.sin()];
    let request = request(load, 1500.0 * std::f64::consts::TAU / 60.0);
    let found = find_equilibrium(&mut film, &bearing, &request, &CONDITIONS).unwrap();
    assert!((found.state.eccentricity() / bearing.radial_clearance - 0.266298).abs() < 1e-6);
    assert!((found.attitude_angle(load).to_degrees() - 70.620).abs() < 1e-3);
    let coefficients = Coefficients::from_tangent(&found.tangent).turned(load_angle);
    let stiffness = [[8815302.0, 25060393.0], [-16393593.0, 12807959.0]];
    let damping = [[294911.6, 81924.4], [81924.4, 232896.9]];
    let pairs = [
        (coefficients.translation_stiffness(), stiffness),
        (coefficients.translation_damping(), damping),
    ];
    for (found, expected) in pairs {
        for (value, reference) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!(
                (value / reference - 1.0).abs() < 1e-6,
                "{value} {reference}"
            );
        }
    }
}

#[test]
fn whirl_threshold_of_short_bearings() {
    let (speed, viscosity) = (300.0, 0.01);
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let mut film = ShortBearingFilm::new(&bearing, viscosity).unwrap();
    for row in table("whirl-threshold/reference.csv") {
        let (eps, whirl_ratio, expected) = (row[0], row[11], row[12]);
        let [along, across] = short::ocvirk_force(eps);
        let psi = bearing.relative_clearance();
        let square = (bearing.width / bearing.diameter).powi(2);
        let load =
            along.hypot(across) * square * viscosity * speed * bearing.diameter * bearing.width
                / (4.0 * psi * psi);
        let found = find_equilibrium(
            &mut film,
            &bearing,
            &request([0.0, -load], speed),
            &CONDITIONS,
        )
        .unwrap();
        let threshold = whirl_threshold(&Coefficients::from_tangent(&found.tangent)).unwrap();
        let relative = speed * (threshold.mass * bearing.radial_clearance / load).sqrt();
        assert!(
            (relative / expected - 1.0).abs() < 1e-5,
            "eps {eps}: {relative} {expected}"
        );
        assert!((threshold.whirl_speed / speed / whirl_ratio - 1.0).abs() < 1e-5);
    }
}
