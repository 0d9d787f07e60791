//! Journal orbits against closed forms and independent integrations.
#![allow(clippy::unwrap_used)]

mod common;

use common::{CONDITIONS, plain_bearing, table};
use sommerfeld_bearing::{
    CycleTilt, JournalOrbit, LoadCycle, LoadPoint, OrbitSettings, OrbitStart, journal_orbit,
};
use sommerfeld_film::closed_form::short;
use sommerfeld_film::{
    Bearing, Capabilities, Conditions, FilmError, FilmForce, FilmHistory, FilmSummary,
    JournalState, Linearised, MobilityFilm, Outcome, ShortBearingFilm, Step,
};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// The one-axis cycle of Flores et al. 2006; the journal turns at 4000 rpm in a fixed shell while
/// the load cycle takes 720 degrees of a 2000 rpm engine.
fn flores() -> (Bearing, LoadCycle) {
    let points = table("flores-2006/load.csv")
        .iter()
        .map(|row| LoadPoint {
            crank_angle: row[0].to_radians(),
            load: [row[1], 0.0],
            moment: [0.0; 2],
            journal_speed: 2.0 * 209.439_510_239_319_5,
            shell_speed: 0.0,
        })
        .collect();
    let cycle = LoadCycle {
        points,
        period: 4.0 * PI,
        engine_speed: 209.439_510_239_319_5,
        journal_mass: 0.0,
        tilt: CycleTilt::Aligned,
        feed_pressures: Vec::new(),
    };
    (plain_bearing(0.0635, 0.0254, 35.56e-6), cycle)
}

fn run(
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    cycle: &LoadCycle,
    settings: &OrbitSettings,
) -> JournalOrbit {
    journal_orbit(
        film,
        bearing,
        cycle,
        &CONDITIONS,
        settings,
        &mut |_, _, _| ControlFlow::Continue(()),
    )
    .unwrap()
}

fn updates_per_crank_step(orbit: &JournalOrbit) -> f64 {
    orbit.film_solves as f64 / ((orbit.points.len() - 1) * orbit.cycles) as f64
}

/// Position at a crank angle in degrees, linear between the points.
fn position_at(orbit: &JournalOrbit, degrees: f64) -> [f64; 2] {
    let first = orbit.points[0].crank_angle;
    let step = orbit.points[1].crank_angle - first;
    let place = (degrees.to_radians() - first).rem_euclid(4.0 * PI) / step;
    let index = (place.floor() as usize).min(orbit.points.len() - 2);
    let share = place - index as f64;
    let (a, b) = (&orbit.points[index].state, &orbit.points[index + 1].state);
    [0, 1].map(|i| a.position[i] + share * (b.position[i] - a.position[i]))
}

#[test]
fn flores_cycle_of_the_short_bearing() {
    let (bearing, cycle) = flores();
    let mut film = ShortBearingFilm::new(&bearing, 0.00416).unwrap();
    let orbit = run(&mut film, &bearing, &cycle, &OrbitSettings::default());
    assert_eq!(orbit.outcome, Outcome::Converged);
    let mut worst: f64 = 0.0;
    let (mut smallest, mut reference_smallest) = (f64::INFINITY, f64::INFINITY);
    for row in table("flores-2006/reference.csv") {
        let [x, y] = position_at(&orbit, row[0]);
        let gap = (bearing.radial_clearance - x.hypot(y)) * 1e6;
        worst = worst.max((gap / row[4] - 1.0).abs());
        smallest = smallest.min(gap);
        reference_smallest = reference_smallest.min(row[4]);
    }
    assert!(worst < 1e-3, "{worst}");
    assert!((smallest / reference_smallest - 1.0).abs() < 1e-4);
    assert!(updates_per_crank_step(&orbit) < 3.0);
    assert!(orbit.cycles <= 3);
}

#[test]
fn flores_cycle_of_bookers_mobility() {
    let (bearing, cycle) = flores();
    let mut exact = ShortBearingFilm::new(&bearing, 0.00416).unwrap();
    let exact = run(&mut exact, &bearing, &cycle, &OrbitSettings::default());
    let mut film = MobilityFilm::new(&bearing, 0.00416).unwrap();
    let orbit = run(&mut film, &bearing, &cycle, &OrbitSettings::default());
    assert_eq!(orbit.outcome, Outcome::Converged);
    let ratio = orbit.minimum_film_thickness().unwrap().0.value
        / exact.minimum_film_thickness().unwrap().0.value;
    assert!((ratio - 1.0).abs() < 0.05);
    assert!(orbit.mean_power_loss() > 0.0 && orbit.mean_side_flow() > 0.0);
}

/// Heavily loaded big end (validation/plain-big-end): short-bearing theory gives 2.565 um at 392
/// degrees by an independent program.
#[test]
fn plain_big_end_of_a_diesel_engine() {
    let speed = 2000.0 * PI / 30.0;
    let points = table("../examples/02-big-end-diesel/loads.csv")
        .iter()
        .map(|row| LoadPoint {
            crank_angle: row[0].to_radians(),
            load: [row[1], row[2]],
            moment: [0.0; 2],
            journal_speed: row[3],
            shell_speed: 0.0,
        })
        .collect();
    let cycle = LoadCycle {
        points,
        period: 4.0 * PI,
        engine_speed: speed,
        journal_mass: 0.0,
        tilt: CycleTilt::Aligned,
        feed_pressures: Vec::new(),
    };
    let bearing = plain_bearing(0.072, 0.030, 36e-6);
    let mut film = ShortBearingFilm::new(&bearing, 8e-3).unwrap();
    let orbit = run(&mut film, &bearing, &cycle, &OrbitSettings::default());
    assert_eq!(orbit.outcome, Outcome::Converged);
    let (smallest, crank_angle) = orbit.minimum_film_thickness().unwrap();
    assert!((smallest.value * 1e6 - 2.565).abs() < 0.003, "{smallest:?}");
    assert!(
        (crank_angle.to_degrees() - 392.0).abs() < 1.5,
        "{}",
        crank_angle.to_degrees()
    );
    assert!(
        updates_per_crank_step(&orbit) < 5.0,
        "{}",
        updates_per_crank_step(&orbit)
    );
}

#[test]
fn the_observer_stops_the_run() {
    let (bearing, cycle) = flores();
    let mut film = ShortBearingFilm::new(&bearing, 0.00416).unwrap();
    let orbit = journal_orbit(
        &mut film,
        &bearing,
        &cycle,
        &CONDITIONS,
        &OrbitSettings::default(),
        &mut |_, _, progress| {
            if progress.fraction < 0.5 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        },
    )
    .unwrap();
    assert_eq!(orbit.outcome, Outcome::NotConverged);
    assert_eq!(orbit.points.len(), 361);
}

fn constant(load: [f64; 2], speed: f64, mass: f64, turns: f64) -> LoadCycle {
    LoadCycle {
        points: vec![LoadPoint {
            crank_angle: 0.0,
            load,
            moment: [0.0; 2],
            journal_speed: speed,
            shell_speed: 0.0,
        }],
        period: turns * 2.0 * PI,
        engine_speed: speed,
        journal_mass: mass,
        tilt: CycleTilt::Aligned,
        feed_pressures: Vec::new(),
    }
}

#[test]
fn a_constant_load_stays_in_equilibrium_and_decays_to_it() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let mut film = ShortBearingFilm::new(&bearing, 0.01).unwrap();
    let cycle = constant([300.0, -400.0], 300.0, 0.0, 2.0);
    let resting = run(&mut film, &bearing, &cycle, &OrbitSettings::default());
    assert_eq!((resting.outcome, resting.cycles), (Outcome::Converged, 1));
    let rest = resting.points[0].state.position;

    let settings = OrbitSettings {
        start: OrbitStart::At(JournalState::default()),
        cycle_limit: 20,
        ..OrbitSettings::default()
    };
    let decayed = run(&mut film, &bearing, &cycle, &settings);
    assert_eq!(decayed.outcome, Outcome::Converged);
    let end = decayed.points[decayed.points.len() - 1].state.position;
    let distance = (end[0] - rest[0]).hypot(end[1] - rest[1]);
    assert!(distance < 1e-3 * bearing.radial_clearance, "{distance:e}");
}

/// Largest distance from the equilibrium over the first and the last turns of a free run of the
/// rigid rotor, which starts 0.001 clearances beside it.
fn growth_of_small_whirl(eps: f64, threshold_share: f64) -> f64 {
    let (speed, viscosity) = (300.0, 0.01);
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let mut film = ShortBearingFilm::new(&bearing, viscosity).unwrap();
    let [along, across] = short::ocvirk_force(eps);
    let psi = bearing.relative_clearance();
    let square = (bearing.width / bearing.diameter).powi(2);
    let unit = viscosity * speed * bearing.diameter * bearing.width / (4.0 * psi * psi);
    let load = along.hypot(across) * square * unit;
    let row = table("whirl-threshold/reference.csv");
    let threshold = row.iter().find(|row| row[0] == eps).unwrap()[12];
    // The threshold is a speed at a given mass; at a given speed it is a mass with its square.
    let mass = (threshold_share * threshold / speed).powi(2) * load / bearing.radial_clearance;
    let turns = 60.0;
    let cycle = constant([load, 0.0], speed, mass, turns);
    let rest = run(
        &mut film,
        &bearing,
        &constant([load, 0.0], speed, 0.0, 1.0),
        &OrbitSettings::default(),
    );
    let mut start = rest.points[0].state;
    let centre = start.position;
    start.position[0] += 1e-3 * bearing.radial_clearance;
    start.velocity = [0.0; 2];
    let settings = OrbitSettings {
        crank_step: 2.0 * PI / 180.0,
        start: OrbitStart::At(start),
        cycle_limit: 1,
        ..OrbitSettings::default()
    };
    let orbit = run(&mut film, &bearing, &cycle, &settings);
    let amplitude = |from: f64, to: f64| {
        orbit
            .points
            .iter()
            .filter(|p| p.crank_angle > from * 2.0 * PI && p.crank_angle < to * 2.0 * PI)
            .map(|p| (p.state.position[0] - centre[0]).hypot(p.state.position[1] - centre[1]))
            .fold(0.0, f64::max)
    };
    // The fast transient of the start is gone after ten turns.
    amplitude(turns - 5.0, turns) / amplitude(10.0, 15.0)
}

#[test]
fn small_whirl_decays_below_and_grows_above_the_threshold() {
    for eps in [0.1, 0.3, 0.5] {
        let (below, above) = (
            growth_of_small_whirl(eps, 0.97),
            growth_of_small_whirl(eps, 1.03),
        );
        assert!(below < 0.9, "eps {eps}: {below}");
        assert!(above > 1.1, "eps {eps}: {above}");
    }
}

/// Smooth rotating and pulsating load for orders of convergence.
fn smooth_cycle(mass: f64) -> LoadCycle {
    let rows = 2880;
    let points = (0..rows)
        .map(|row| {
            let angle = 2.0 * PI * f64::from(row) / f64::from(rows);
            LoadPoint {
                crank_angle: angle,
                load: [200.0 + 600.0 * angle.cos(), 400.0 * angle.sin()],
                moment: [0.0; 2],
                journal_speed: 300.0 + 50.0 * angle.sin(),
                shell_speed: 0.0,
            }
        })
        .collect();
    LoadCycle {
        points,
        period: 2.0 * PI,
        engine_speed: 300.0,
        journal_mass: mass,
        tilt: CycleTilt::Aligned,
        feed_pressures: Vec::new(),
    }
}

/// Errors at the output points common to all runs, for step sizes halved from run to run.
fn errors(film: &mut dyn FilmForce, mass: f64) -> Vec<f64> {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let cycle = smooth_cycle(mass);
    let mut orbits: Vec<Vec<[f64; 2]>> = Vec::new();
    for steps in [45_u32, 90, 180, 360, 1440] {
        let settings = OrbitSettings {
            crank_step: 2.0 * PI / f64::from(steps),
            error_tolerance: f64::INFINITY,
            history_error_tolerance: f64::INFINITY,
            newton_tolerance: 1e-8,
            history_newton_tolerance: 1e-8,
            closure_tolerance: 1e-9,
            cycle_limit: 30,
            ..OrbitSettings::default()
        };
        let orbit = run(film, &bearing, &cycle, &settings);
        assert_eq!(
            orbit.outcome,
            Outcome::Converged,
            "{steps} steps, closure {}",
            orbit.closure
        );
        let stride = (steps / 45) as usize;
        orbits.push(
            orbit
                .points
                .iter()
                .step_by(stride)
                .map(|p| p.state.position)
                .collect(),
        );
    }
    let reference = orbits.pop().unwrap();
    let distance = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    orbits
        .iter()
        .map(|orbit| {
            let largest = orbit
                .iter()
                .zip(&reference)
                .map(|(a, b)| distance(a, b))
                .fold(0.0, f64::max);
            largest / bearing.radial_clearance
        })
        .collect()
}

#[test]
fn the_scheme_is_of_second_order_in_time() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let mut film = ShortBearingFilm::new(&bearing, 0.01).unwrap();
    for mass in [0.0, 5.0] {
        let errors = errors(&mut film, mass);
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!(order > 1.8, "mass {mass}: {errors:?}");
        }
    }
}

/// A short-bearing film that counts its squeeze from the accepted history and lags one update behind
/// in its set, as a field film with stored content does.
struct RememberingFilm {
    film: ShortBearingFilm,
    accepted: Option<[f64; 2]>,
    present: [f64; 2],
    /// Where the present step ends.
    end: [f64; 2],
    /// Refuses to converge while the journal is on this side.
    refuses: fn(&JournalState) -> Option<Outcome>,
}

impl RememberingFilm {
    fn new(bearing: &Bearing, viscosity: f64) -> Self {
        Self {
            film: ShortBearingFilm::new(bearing, viscosity).unwrap(),
            accepted: None,
            present: [f64::NAN; 2],
            end: [f64::NAN; 2],
            refuses: |_| None,
        }
    }
}

impl FilmForce for RememberingFilm {
    fn capabilities(&self) -> Capabilities {
        Capabilities {
            has_history: true,
            iteration_limit: 10,
            ..self.film.capabilities()
        }
    }

    fn minimum_gap(&self, state: &JournalState) -> f64 {
        self.film.minimum_gap(state)
    }

    fn linearise(
        &mut self,
        state: &JournalState,
        step: Step,
        conditions: &Conditions<'_>,
    ) -> Result<Linearised, FilmError> {
        let Step::Implicit { duration, after } = step else {
            self.present = state.position;
            self.end = state.position;
            return self.film.linearise(state, step, conditions);
        };
        let duration = duration - after;
        let mut moved = *state;
        if let Some(old) = self.accepted {
            moved.velocity = [0, 1].map(|i| (state.position[i] - old[i]) / duration);
            let difference = (moved.velocity[0] - state.velocity[0])
                .hypot(moved.velocity[1] - state.velocity[1]);
            assert!(
                difference * duration < 1e-12,
                "history and velocity disagree"
            );
        }
        let mut answer = self.film.linearise(&moved, step, conditions)?;
        let far = (0..2).any(|i| (state.position[i] - self.present[i]).abs() > 1e-8);
        answer.settled = !(far || self.present[0].is_nan());
        answer.outcome = (self.refuses)(state).unwrap_or(answer.outcome);
        self.present = state.position;
        self.end = [0, 1].map(|i| state.position[i] + after * moved.velocity[i]);
        Ok(answer)
    }

    fn summary(&self) -> FilmSummary {
        self.film.summary()
    }

    fn accept_step(&mut self) {
        self.accepted = (!self.end[0].is_nan()).then_some(self.end);
    }

    fn reject_step(&mut self) {
        self.present = self.accepted.unwrap_or([f64::NAN; 2]);
        self.end = self.present;
    }

    fn history(&self) -> FilmHistory {
        FilmHistory {
            content: self.accepted.map(Vec::from).unwrap_or_default(),
        }
    }

    fn restore(&mut self, history: &FilmHistory) {
        self.accepted = <[f64; 2]>::try_from(history.content.as_slice()).ok();
        self.reject_step();
    }
}

#[test]
fn a_film_with_history_runs_by_the_midpoint_rule() {
    let (bearing, cycle) = flores();
    let mut plain = ShortBearingFilm::new(&bearing, 0.00416).unwrap();
    let expected = run(&mut plain, &bearing, &cycle, &OrbitSettings::default());
    let mut film = RememberingFilm::new(&bearing, 0.00416);
    let orbit = run(&mut film, &bearing, &cycle, &OrbitSettings::default());
    assert_eq!(
        orbit.outcome,
        Outcome::Converged,
        "closure {}",
        orbit.closure
    );
    let ratio = orbit.minimum_film_thickness().unwrap().0.value
        / expected.minimum_film_thickness().unwrap().0.value;
    assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    assert!(
        updates_per_crank_step(&orbit) < 4.0,
        "{}",
        updates_per_crank_step(&orbit)
    );
}

#[test]
fn the_midpoint_rule_is_of_second_order() {
    let bearing = plain_bearing(0.05, 0.02, 25e-6);
    let mut film = RememberingFilm::new(&bearing, 0.01);
    let errors = errors(&mut film, 0.0);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 1.8, "{errors:?}");
    }
}

/// A film that never converges in part of the circle, or has no solution there, ends the run with a
/// name and in bounded time.
#[test]
fn a_film_that_fails_ends_the_run_with_a_name() {
    let (bearing, cycle) = flores();
    let mut film = RememberingFilm::new(&bearing, 0.00416);
    film.refuses = |state| (state.position[0] > 10e-6).then_some(Outcome::NotConverged);
    let orbit = run(&mut film, &bearing, &cycle, &OrbitSettings::default());
    assert_eq!(orbit.outcome, Outcome::NotConverged);
    assert!(orbit.film_solves < 500_000);
    film.refuses = |state| (state.position[0] > 10e-6).then_some(Outcome::NoSolution);
    let orbit = run(&mut film, &bearing, &cycle, &OrbitSettings::default());
    assert_eq!(orbit.outcome, Outcome::NoSolution);
    assert!(orbit.points.len() > 10);
}
