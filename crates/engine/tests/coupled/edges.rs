//! Edges of tilted journals: how much a film carries there as it closes, where no balance is left, what
//! crowning does, and orbits of films that remember.

use crate::elastic_six::ElasticSix;
use crate::shafts::{CONDITIONS, plain_bearing};
use sommerfeld_bearing::{JournalOrbit, OrbitSettings};
use sommerfeld_engine::{
    COUPLED_ERROR_TOLERANCE, CoupledOrbits, FilmExecutor, FilmUpdate, Supports,
};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Feature, Feed, FeedLine, FeedShape, FilmForce, FilmSolver,
    JournalState, Outcome, Shape, Step,
};
use sommerfeld_oil::Lubricant;
use std::f64::consts::PI;

const CLEARANCE: f64 = 40e-6;
const HALF_WIDTH: f64 = 0.016;

fn threads(updates: &mut [FilmUpdate<'_>]) {
    std::thread::scope(|scope| {
        for update in updates {
            scope.spawn(move || update.run());
        }
    });
}

fn crowned(end_offset: f64) -> Shape {
    Shape::of(vec![Feature::Crowning {
        end_offset,
        half_width: HALF_WIDTH,
    }])
}

/// Force (N) and resistance to closing (N s/m) of a main whose journal tilts by a quarter of the clearance at
/// half the width, towards the narrowest gap of this size (m).
fn at_gap(bore: &Shape, grid: [usize; 2], gap: f64) -> [f64; 2] {
    let bearing = Bearing {
        cavitation: Cavitation::Reynolds,
        bore: bore.clone(),
        ..plain_bearing(0.085, 2.0 * HALF_WIDTH, CLEARANCE)
    };
    let oil = Lubricant::constant(0.01, 850.0);
    let mut film = FilmSolver::new(&bearing, &oil, grid).unwrap();
    let tilt = 0.25 * CLEARANCE / HALF_WIDTH;
    let state = |x: f64| JournalState {
        position: [x, 0.0],
        tilt: [0.0, tilt],
        journal_speed: 209.0,
        ..JournalState::default()
    };
    let (mut open, mut closed) = (0.0, 2.0 * CLEARANCE);
    for _ in 0..100 {
        let middle = 0.5 * (open + closed);
        if film.minimum_gap(&state(middle)) > gap {
            open = middle;
        } else {
            closed = middle;
        }
    }
    let answer = film.react(&state(open), Step::Steady, &CONDITIONS).unwrap();
    assert_eq!(answer.outcome, Outcome::Converged);
    let [x, y] = answer.reaction.force();
    [x.hypot(y), -answer.tangent.by_rate[0][0]]
}

/// Near an edge that closes at slope `a` the gap is `h + a s + x^2/2R`. At `h = 0` pressure falls with
/// the distance, `p ~ |x|/(s + x^2/2Ra)`, whose integral is finite; so is that of the squeeze film. A
/// bore that curves away faster than the journal tilts leaves a contact inside the edge, and there the
/// load grows without bound, with `h^-1/2`.
#[test]
fn an_edge_that_closes_carries_a_finite_load_and_a_crowned_one_any() {
    let sharp = Shape::cylindrical();
    for grid in [[64, 16], [128, 32], [256, 64]] {
        let [near, slow] = at_gap(&sharp, grid, 1e-8);
        let [touching, slowest] = at_gap(&sharp, grid, 1e-11);
        assert!((touching / near - 1.0).abs() < 0.02, "{near} {touching}");
        assert!((slowest / slow - 1.0).abs() < 0.05, "{slow} {slowest}");
    }
    // The limit is one of the film, not of the grid.
    let loads = [[64, 16], [128, 32], [256, 64]].map(|grid| at_gap(&sharp, grid, 1e-11)[0]);
    let changes = [loads[0] - loads[1], loads[1] - loads[2]];
    assert!(changes[1].abs() < 0.6 * changes[0].abs(), "{loads:?}");
    assert!(changes[1].abs() < 0.02 * loads[2], "{loads:?}");

    // 5 um at the ends: a slope of 0.625 mrad there, as large as the tilt.
    let round = crowned(5e-6);
    for [wide, narrow] in [[1e-6, 1e-7], [1e-7, 1e-8]] {
        let growth = at_gap(&round, [256, 64], narrow)[0] / at_gap(&round, [256, 64], wide)[0];
        assert!(growth > 3.1, "{growth} from {wide:e} m to {narrow:e} m");
    }
}

fn run(engine: &ElasticSix, crank_step: f64) -> CoupledOrbits {
    let settings = OrbitSettings {
        crank_step: crank_step.to_radians(),
        closure_tolerance: 1e-3,
        error_tolerance: COUPLED_ERROR_TOLERANCE,
        ..OrbitSettings::default()
    };
    engine.run(&settings, &threads as &FilmExecutor<'_>)
}

fn thinnest(orbit: &JournalOrbit) -> f64 {
    let (least, _) = orbit.minimum_film_thickness().unwrap();
    least.value
}

fn tilting(stiffness: f64) -> Supports {
    Supports::Each {
        stiffness: [[5e8, 0.0], [0.0, 3e8]],
        tilt_stiffness: Some([[stiffness, 0.0], [0.0, stiffness]]),
    }
}

/// Bars of 24 mm for webs tilt the journals to the edge. Held by 120 kN m/rad the shells follow and
/// keep a film, by 300 they do not: no balance is left and the edge is named. Crowning opens the edges.
#[test]
fn thin_webs_close_the_edges_and_crowning_opens_them() {
    let mut engine = ElasticSix::single_with(0.024, Cavitation::Reynolds, Vec::new());
    engine.supports = tilting(1.2e5);
    let plain = run(&engine, 4.0);
    assert_eq!(plain.outcome, Outcome::Converged);
    // A start that rests in the peak of the load would be a start in contact: it took 15 276.
    let solves: usize = plain.orbits.iter().map(|orbit| orbit.film_solves).sum();
    assert!(solves < 12_000, "{solves}");

    engine.bearing.bore = crowned(5e-6);
    let round = run(&engine, 4.0);
    assert_eq!(round.outcome, Outcome::Converged);
    for (plain, round) in plain.orbits.iter().zip(&round.orbits) {
        let [plain, round] = [thinnest(plain), thinnest(round)];
        assert!(round > 4.0 * plain, "{plain:e} {round:e}");
    }

    engine.bearing.bore = Shape::cylindrical();
    engine.supports = tilting(3e5);
    let pressed = run(&engine, 4.0);
    assert_eq!(pressed.outcome, Outcome::NotConverged);
    let named = pressed.orbits.iter().zip(&pressed.cycles);
    let named = named.filter_map(|(orbit, cycle)| orbit.edge_contact(cycle, CLEARANCE));
    assert!(named.count() > 0);
}

/// Longest run of points that alternate by more than a thousandth of the clearance; lengths, m.
fn longest_ringing(lengths: &[f64]) -> usize {
    let bends: Vec<f64> = lengths
        .windows(3)
        .map(|v| 0.25 * (v[0] - 2.0 * v[1] + v[2]))
        .collect();
    let (mut longest, mut present) = (0, 0);
    for pair in bends.windows(2) {
        let least = pair[0].abs().min(pair[1].abs());
        let alternates = pair[0] * pair[1] < 0.0 && least > 1e-3 * CLEARANCE;
        present = if alternates { present + 1 } else { 0 };
        longest = longest.max(present);
    }
    longest
}

/// Films that remember step by the midpoint rule, which does not damp what is stiff. It does not ring,
/// though main 1 flies across an emptied gap at 412 deg, within 4 deg and at twenty times its speed before
/// and after: positions and tilts do not alternate after it, half the step changes the thinnest film
/// little, and with oil at hand the thinnest film is that of `reynolds`.
#[test]
fn films_with_history_do_not_ring() {
    let groove = vec![Feed {
        shape: FeedShape::Rectangle {
            length: 0.5 * PI * 0.085,
            width: 0.005,
        },
        carried_by: Carrier::Shell,
        angle: 0.0,
        position: 0.0,
        pressure: 4.5e5,
        line: FeedLine::Direct,
    }];
    let engine = |cavitation| ElasticSix::single_with(0.032, cavitation, groove.clone());
    let reynolds = run(&engine(Cavitation::Reynolds), 4.0);
    let [coarse, fine] = [4.0, 2.0].map(|step| run(&engine(Cavitation::MassConserving), step));
    for found in [&reynolds, &coarse, &fine] {
        assert_eq!(found.outcome, Outcome::Converged);
    }
    for journal in 0..2 {
        let [reynolds, coarse, fine] =
            [&reynolds, &coarse, &fine].map(|found| thinnest(&found.orbits[journal]));
        assert!((coarse / fine - 1.0).abs() < 5e-3, "{coarse:e} {fine:e}");
        assert!(
            (fine / reynolds - 1.0).abs() < 1e-2,
            "{fine:e} {reynolds:e}"
        );
    }
    for found in [&coarse, &fine] {
        let points = found.orbits[0].points.iter();
        let fastest = points.map(|p| p.state.velocity[0].abs());
        assert!(fastest.fold(0.0, f64::max) > 0.05);
    }
    for orbit in coarse.orbits.iter().chain(&fine.orbits) {
        for axis in 0..4 {
            let lengths = orbit.points.iter().map(|point| {
                let ([x, y], [tilt_x, tilt_y]) = (point.state.position, point.state.tilt);
                [x, y, HALF_WIDTH * tilt_x, HALF_WIDTH * tilt_y][axis]
            });
            let run = longest_ringing(&lengths.collect::<Vec<f64>>());
            assert!(run < 4, "{run} points alternate, coordinate {axis}");
        }
    }
    let undamped: Vec<f64> = (0..20)
        .map(|k| if k % 2 == 0 { 1e-7 } else { 0.0 })
        .collect();
    assert!(longest_ringing(&undamped) > 15);
}
