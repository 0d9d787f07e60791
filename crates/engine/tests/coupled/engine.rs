//! A crankshaft in its main bearings: free body of the engine, power of every film.

use crate::elastic_six::{ElasticSix, MainFilm};
use sommerfeld_bearing::{CyclePoint, OrbitSettings};
use sommerfeld_engine::{
    CoupledOrbits, FilmExecutor, FilmUpdate, determinate_main_loads, resultant,
};
use sommerfeld_film::{Cavitation, Outcome};

fn threads(updates: &mut [FilmUpdate<'_>]) {
    std::thread::scope(|scope| {
        for update in updates {
            scope.spawn(move || update.run());
        }
    });
}

fn solved(crank_step: f64) -> (ElasticSix, CoupledOrbits) {
    let mut engine = ElasticSix::new(0.024, Cavitation::Reynolds, Vec::new());
    engine.grid = [48, 8];
    let settings = OrbitSettings {
        crank_step: crank_step.to_radians(),
        closure_tolerance: 1e-3,
        ..OrbitSettings::default()
    };
    let found = engine.run(&settings, &threads as &FilmExecutor<'_>);
    assert_eq!(found.outcome, Outcome::Converged);
    (engine, found)
}

/// Force and moment that the mains lack at a crank angle, over the largest of the cycle.
fn missing(engine: &ElasticSix, found: &CoupledOrbits) -> [f64; 2] {
    let count = found.orbits[0].points.len();
    let mains = &engine.train.layout.mains;
    let (mut worst, mut largest) = ([0.0_f64; 2], [0.0_f64; 2]);
    for index in 0..count {
        let angle = found.orbits[0].points[index].crank_angle;
        let (force, moment) = resultant(&engine.forces(angle), 0.0);
        let mut left = [force, moment];
        for (orbit, axial) in found.orbits.iter().zip(mains) {
            let CyclePoint { load, moment, .. } = orbit.points[index];
            left[0] = [left[0][0] - load[0], left[0][1] - load[1]];
            left[1][0] -= moment[0] - axial * load[1];
            left[1][1] -= moment[1] + axial * load[0];
        }
        for (kind, whole) in [force, moment].into_iter().enumerate() {
            worst[kind] = worst[kind].max(left[kind][0].hypot(left[kind][1]));
            largest[kind] = largest[kind].max(whole[0].hypot(whole[1]));
        }
    }
    [worst[0] / largest[0], worst[1] / largest[1]]
}

/// Ending the Newton iteration at the tolerance of the settings leaves the journals of every main within that share
/// of their gap of where a thousand times finer tolerance puts them, where cavitated sets change on the way too.
#[test]
fn journals_are_where_the_tolerance_says() {
    let run = |tolerance: f64| {
        let mut engine = ElasticSix::new(0.024, Cavitation::Reynolds, Vec::new());
        engine.grid = [48, 8];
        let settings = OrbitSettings {
            crank_step: 10.0_f64.to_radians(),
            newton_tolerance: tolerance,
            cycle_limit: 1,
            closure_tolerance: 1e-12,
            ..OrbitSettings::default()
        };
        engine.run(&settings, &threads as &FilmExecutor<'_>).orbits
    };
    let tolerance = OrbitSettings::default().newton_tolerance;
    let (found, finer) = (run(tolerance), run(1e-3 * tolerance));
    let mut worst = 0.0_f64;
    for (a, b) in found.iter().zip(&finer) {
        for (a, b) in a.points.iter().zip(&b.points) {
            let ([ax, ay], [bx, by]) = (a.state.position, b.state.position);
            let gap = b.summary.minimum_film_thickness.value;
            worst = worst.max((ax - bx).hypot(ay - by) / gap);
        }
    }
    let solves = |orbits: &[sommerfeld_bearing::JournalOrbit]| -> usize {
        orbits.iter().map(|orbit| orbit.film_solves).sum()
    };
    println!(
        "{worst:e}, {} film updates against {}",
        solves(&found),
        solves(&finer)
    );
    assert!(worst < tolerance, "{worst:e}");
}

/// The mains together carry what the free body of the engine asks of them, at every crank angle, though
/// six throws and twelve arms of unbalance stand between the forces and the mains.
#[test]
fn mains_carry_the_resultant_of_the_engine() {
    let (engine, found) = solved(2.0);
    let [force, moment] = missing(&engine, &found);
    assert!(force < 1e-8 && moment < 1e-8, "{force:e} {moment:e}");

    // Films lose what turns and squeezes them.
    let period = engine.train.period() / engine.motion.speed;
    for (journal, orbit) in found.orbits.iter().enumerate() {
        let squeezed: f64 = orbit
            .points
            .windows(2)
            .map(|pair| 0.5 * (squeeze(&pair[0], &pair[1]) - squeeze(&pair[1], &pair[0])))
            .sum();
        let turned =
            period * orbit.mean(|p| p.reaction.friction_torque_journal * p.state.journal_speed);
        let lost = period * orbit.mean_power_loss();
        let share = (squeezed + turned) / lost - 1.0;
        assert!(share.abs() < 1e-3, "main {journal}: {share:e}");
    }
}

/// Work of the load at `a` on the way from `a` to `b`, J.
fn squeeze(a: &CyclePoint, b: &CyclePoint) -> f64 {
    let axes = 0..2;
    axes.map(|axis| {
        a.load[axis] * (b.state.position[axis] - a.state.position[axis])
            + a.moment[axis] * (b.state.tilt[axis] - a.state.tilt[axis])
    })
    .sum()
}

/// One throw in two mains is determinate whatever bends: without moments the loads are those of hinges,
/// with moments of tilted films they differ by those over the distance of the mains.
#[test]
fn one_throw_in_two_mains_is_determinate() {
    let engine = ElasticSix::single();
    let settings = OrbitSettings {
        crank_step: 4_f64.to_radians(),
        closure_tolerance: 1e-3,
        ..OrbitSettings::default()
    };
    let mains = &engine.train.layout.mains;
    let (first, second) = (mains[0], mains[1]);
    assert_eq!(mains.len(), 2);
    let executor: &FilmExecutor<'_> = &threads;
    for film in [MainFilm::Short, MainFilm::Grid] {
        let found = engine.run_on(film, &settings, executor);
        let closure = found.orbits[0].closure;
        assert_eq!(found.outcome, Outcome::Converged, "{film:?}: {closure:e}");
        let (mut apart, mut largest, mut turned) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (a, b) in found.orbits[0].points.iter().zip(&found.orbits[1].points) {
            let forces = engine.forces(a.crank_angle);
            let hinged = determinate_main_loads(&[first, second], &forces);
            // About x: the load along y of the second main turns with minus its lever.
            let moment = [a.moment[0] + b.moment[0], a.moment[1] + b.moment[1]];
            let shift = [moment[1] / (second - first), -moment[0] / (second - first)];
            for axis in 0..2 {
                let front = a.load[axis] - hinged[0][axis] - shift[axis];
                let rear = b.load[axis] - hinged[1][axis] + shift[axis];
                apart = apart.max(front.abs()).max(rear.abs());
                largest = largest.max(hinged[0][axis].abs());
                turned = turned.max(shift[axis].abs());
            }
        }
        assert!(apart < 1e-8 * largest, "{film:?}: {:e}", apart / largest);
        let passes_moments = turned > 1e-3 * largest;
        assert_eq!(passes_moments, film == MainFilm::Grid, "{turned} N");
    }
}
