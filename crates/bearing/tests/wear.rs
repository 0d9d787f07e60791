//! Wear of bearings that are carried partly by contact, over films on a grid.
#![allow(clippy::unwrap_used)]

mod common;

use common::{CONDITIONS, diesel_big_end, diesel_cycle, plain_bearing};
use sommerfeld_bearing::{
    CycleWear, EquilibriumRequest, EquilibriumSettings, OrbitSettings, RanIn, RunningIn,
    RunningInEnd, WornCycle, WornRoughness, find_equilibrium, journal_orbit, run_in, wear,
};
use sommerfeld_film::{
    Cavitation, ContactLaw, FilmError, FilmForce, FilmSolver, Finish, GreenwoodTripp, JournalState,
    Outcome, RoughFinish, Roughness,
};
use sommerfeld_oil::Lubricant;
use std::f64::consts::PI;
use std::ops::ControlFlow;

const SIGMA: f64 = 0.5e-6;
const COEFFICIENT: f64 = 1e-16; // 1/Pa

fn rough() -> Finish {
    Finish::Rough(RoughFinish {
        roughness: Roughness {
            journal: 0.6 * SIGMA,
            shell: 0.8 * SIGMA,
            peklenik_journal: 1.0,
            peklenik_shell: 1.0,
        },
        contact: ContactLaw::GreenwoodTripp(GreenwoodTripp {
            factor: 1e-3,
            asperity_product: 0.05,
            modulus: 53.3e9,
            summit_height: 0.0,
            summit_roughness: None,
        }),
        boundary_friction: 0.08,
    })
}

/// Over an orbit the volume worn is k times the contact load times the sliding distance, on the shell
/// as on the journal that turns: the film's own sum against the sum over the cells.
#[test]
fn the_volume_worn_is_that_of_the_contact_load() {
    let mut bearing = diesel_big_end(Cavitation::Reynolds);
    bearing.finish = rough();
    let oil = Lubricant::constant(4e-3, 850.0);
    let mut film = FilmSolver::new(&bearing, &oil, [48, 8]).unwrap();
    let settings = OrbitSettings {
        crank_step: 6.0 * PI / 180.0,
        cycle_limit: 1,
        ..OrbitSettings::default()
    };
    let (cycle, duration) = (diesel_cycle(), 2e-4);
    let mut record: Option<CycleWear> = None;
    let mut expected = 0.0;
    journal_orbit(
        &mut film,
        &bearing,
        &cycle,
        &CONDITIONS,
        &settings,
        &mut |point, film, _| {
            let field = film.field().unwrap();
            let record = record.get_or_insert_with(|| CycleWear::new(bearing.radius(), &field));
            record.see(&field, &point.state, duration);
            let sliding = wear::sliding_speed(bearing.radius(), &point.state).abs();
            expected += COEFFICIENT * film.summary().contact_load * sliding * duration;
            ControlFlow::Continue(())
        },
    )
    .unwrap();
    assert!(expected > 0.0);
    let record = record.unwrap();
    for map in [record.on_shell.finish(), record.on_journal.finish()] {
        let volume = map.volume(COEFFICIENT);
        assert!(
            (volume / expected - 1.0).abs() < 1e-12,
            "{volume} {expected}"
        );
    }
}

/// The equilibrium of a tilted journal, and what it wears in a second.
fn tilted(ran: &RanIn) -> Result<WornCycle, FilmError> {
    let bearing = &ran.bearing;
    let oil = Lubricant::constant(8e-3, 850.0);
    let mut film = FilmSolver::new(bearing, &oil, [48, 16])?;
    let frame = JournalState {
        journal_speed: 60.0,
        tilt: [3e-4, 0.0],
        ..JournalState::default()
    };
    let request = EquilibriumRequest {
        load: [0.0, -3000.0],
        moment: None,
        frame,
        start: None,
        settings: EquilibriumSettings::default(),
    };
    let found = find_equilibrium(&mut film, bearing, &request, &CONDITIONS)?;
    let field = film.field().unwrap();
    let mut record = CycleWear::new(bearing.radius(), &field);
    record.see(&field, &found.state, 1.0);
    let [x, y] = found.reaction.contact_force;
    Ok(WornCycle {
        on_shell: record.on_shell.finish(),
        contact_share: x.hypot(y) / 3000.0,
        minimum_film_thickness: film.summary().minimum_film_thickness.value,
        outcome: found.outcome,
    })
}

/// A journal that bears on an edge wears it until the film carries: contact falls all the way, most is
/// worn at that edge, and the time given is the time run.
#[test]
fn a_tilted_journal_runs_its_edge_in() {
    let mut bearing = plain_bearing(0.050, 0.020, 25e-6);
    bearing.cavitation = Cavitation::Reynolds;
    bearing.finish = rough();
    let settings = RunningIn {
        settled_below: 0.0,
        largest_depth: 0.2 * SIGMA,
        ..RunningIn::of(COEFFICIENT, 3.0 * 3600.0, SIGMA)
    };
    let ran = run_in(&bearing, &settings, tilted).unwrap();
    assert_eq!(ran.end, RunningInEnd::TimeOver);
    let total: f64 = ran.steps.iter().map(|step| step.duration).sum();
    assert!((total / settings.duration - 1.0).abs() < 1e-12);
    for pair in ran.steps.windows(2) {
        assert!(pair[1].contact_share < pair[0].contact_share, "{pair:?}");
        assert!(pair[1].deepest_rate < pair[0].deepest_rate, "{pair:?}");
    }
    let (first, last) = (ran.steps[0], *ran.steps.last().unwrap());
    assert!(first.contact_share > 0.02 && last.contact_share < 0.2 * first.contact_share);
    let worn = ran.depth.iter().enumerate();
    let (deepest, depth) = worn.max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
    assert!(*depth > SIGMA, "{depth}");
    let edge = deepest % 16;
    assert!(edge == 0 || edge == 15, "{edge}");
    let after = tilted(&ran).unwrap();
    assert_eq!(after.outcome, Outcome::Converged);
}

/// Share of the load on asperities, largest pressure of film and of asperities (Pa) of a slow aligned
/// journal, step by step, on cells around; the roughness stays so that the profile alone is seen.
fn scarred(cells: usize, steps: usize) -> Vec<(f64, [f64; 3])> {
    const LOAD: f64 = 6000.0;
    let oil = Lubricant::constant(8e-3, 850.0);
    let mut bearing = plain_bearing(0.050, 0.020, 25e-6);
    bearing.cavitation = Cavitation::Reynolds;
    bearing.finish = rough();
    let settings = RunningIn {
        settled_below: 0.0,
        step_limit: steps,
        roughness: WornRoughness::Kept,
        ..RunningIn::of(COEFFICIENT, 1e7, SIGMA)
    };
    let mut seen = Vec::new();
    let ran = run_in(&bearing, &settings, |ran| {
        let bearing = &ran.bearing;
        let mut film = FilmSolver::new(bearing, &oil, [cells, 8])?;
        let request = EquilibriumRequest {
            load: [0.0, -LOAD],
            moment: None,
            frame: JournalState {
                journal_speed: 10.0,
                ..JournalState::default()
            },
            start: None,
            settings: EquilibriumSettings::default(),
        };
        let found = find_equilibrium(&mut film, bearing, &request, &CONDITIONS)?;
        let field = film.field().unwrap();
        let mut record = CycleWear::new(bearing.radius(), &field);
        record.see(&field, &found.state, 1.0);
        let [x, y] = found.reaction.contact_force;
        let share = x.hypot(y) / LOAD;
        let summary = film.summary();
        seen.push([
            share,
            summary.peak_film_pressure.value,
            summary.peak_contact_pressure.value,
        ]);
        Ok(WornCycle {
            on_shell: record.on_shell.finish(),
            contact_share: share,
            minimum_film_thickness: summary.minimum_film_thickness.value,
            outcome: found.outcome,
        })
    })
    .unwrap();
    assert_eq!(ran.end, RunningInEnd::StepLimit);
    ran.steps.iter().map(|step| step.depth).zip(seen).collect()
}

/// Where an aligned journal under a steady load wears its own scar, asperities carry more of it and
/// not less: the scar follows the journal, a gap of even width has no wedge, and the film loses more than
/// the asperities, whose pressure falls as the load spreads. It is no matter of the grid: twice the cells
/// say the same.
#[test]
fn a_scar_that_follows_the_journal_takes_load_off_the_film() {
    let coarse = scarred(96, 10);
    for pair in coarse.windows(2) {
        let ([(_, before), (_, after)], all) = ([pair[0], pair[1]], &coarse);
        assert!(after[0] > before[0], "share of contact: {all:?}");
        assert!(after[1] < before[1], "film pressure: {all:?}");
        assert!(after[2] < before[2], "contact pressure: {all:?}");
    }
    let ((depth, [share, film, contact]), first) = (coarse[10], coarse[0].1);
    assert!(depth > 1.5 * SIGMA && share > 1.3 * first[0], "{coarse:?}");
    assert!(
        film < 0.7 * first[1] && contact < 0.7 * first[2],
        "{coarse:?}"
    );
    let (fine_depth, fine) = scarred(192, 10)[10];
    assert!((fine_depth / depth - 1.0).abs() < 0.01);
    for (a, b) in [share, film, contact].iter().zip(fine) {
        assert!((a / b - 1.0).abs() < 0.04, "{coarse:?} {fine:?}");
    }
}
