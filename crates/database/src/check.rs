//! How far is a table from films solved anew?
//!
//! States are drawn from a seed: half of the eccentricities even, half in the coordinate of the axis,
//! and directions alike; width ratios even in their logarithm. Errors are those of the force at a unit
//! effective velocity over its size, which never vanishes, so there is no floor. Derivatives are compared
//! with those of the solved film at its set, by the relative eccentricity and by the angle of the
//! motion, over the larger of their size and that of the force.

use crate::direction::Direction;
use crate::error::DatabaseError;
use crate::node_film::{NodeFilm, Solved};
use crate::recipe::Recipe;
use crate::table::Table;
use crate::table_film::TableFilm;
use rayon::prelude::*;
use sommerfeld_film::{
    Bearing, Conditions, Elasticity, Ends, FilmForce, FilmShear, Finish, JournalState, Shape, Step,
};
use std::f64::consts::PI;
use std::sync::Arc;

/// A state of an aligned journal, without dimensions.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Place {
    /// Width over diameter.
    pub width_ratio: f64,
    /// Relative eccentricity.
    pub eccentricity: f64,
    /// Angle of the effective velocity from the line of centres, rad, -pi to pi.
    pub angle: f64,
}

/// Errors of a table at samples.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CheckReport {
    /// States compared.
    pub samples: usize,
    /// Largest error of the force, and where.
    pub maximum: f64,
    /// Where the largest error is.
    pub worst: Place,
    /// Error that 99.9 % of the states stay below.
    pub quantile_999: f64,
    /// Error that half of the states stay below.
    pub median: f64,
    /// Largest error of the peak pressure over itself.
    pub peak_maximum: f64,
    /// Where that is.
    pub peak_worst: Place,
    /// Difference of the derivatives to those of the solved film that 99 % of the states stay below.
    pub tangent_quantile_99: f64,
    /// Largest difference of the derivatives to central differences of the table, relative.
    pub difference_maximum: f64,
    /// Smallest power that a unit effective velocity loses over the force it meets, here and beyond the
    /// last eccentricity.
    pub dissipation_minimum: f64,
    /// Largest error that the solver states of the films compared with.
    pub solver_maximum: f64,
    /// States compared with rings of columns, and the largest error of the force there.
    pub independent: usize,
    /// See [`CheckReport::independent`].
    pub independent_maximum: f64,
}

/// What one state shows.
#[derive(Debug, Clone, Copy)]
struct Compared {
    place: Place,
    error: f64,
    peak: f64,
    tangent: f64,
    difference: f64,
    dissipation: f64,
    solver: f64,
    by_rings: bool,
}

/// Compares a table with films solved at `samples` states drawn from `seed`, on all cores; the
/// report does not depend on their number.
///
/// # Errors
/// [`DatabaseError::NotSolved`] where a film to compare with cannot be solved.
pub fn check(table: &Arc<Table>, samples: usize, seed: u64) -> Result<CheckReport, DatabaseError> {
    check_at(table, &places(table.recipe(), samples, seed), true)
}

/// States drawn from a seed.
pub(crate) fn places(recipe: &Recipe, samples: usize, seed: u64) -> Vec<Place> {
    (0..samples)
        .map(|index| draw(recipe, seed, index))
        .collect()
}

/// Compares a table with films solved at given states; derivatives and dissipation only if asked for.
pub(crate) fn check_at(
    table: &Arc<Table>,
    places: &[Place],
    derivatives: bool,
) -> Result<CheckReport, DatabaseError> {
    let compared: Vec<Compared> = places
        .par_iter()
        .enumerate()
        .map_init(
            || (None, None),
            |(film, known), (at, place)| {
                let by_rings = at % INDEPENDENT == 0;
                let solver = solver_at(table.recipe(), known, place, derivatives);
                let solved = solved(solver, place, derivatives, by_rings)?;
                compare(film_at(table, film, place)?, *place, &solved, derivatives)
            },
        )
        .collect::<Result<_, _>>()?;
    Ok(report(&compared))
}

fn report(compared: &[Compared]) -> CheckReport {
    let sorted = |of: fn(&Compared) -> f64| {
        let mut values: Vec<f64> = compared.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let quantile = |sorted: &[f64], share: f64| {
        let at = (share * sorted.len() as f64).ceil() as usize;
        sorted.get(at.saturating_sub(1)).copied().unwrap_or(0.0)
    };
    let largest = |of: fn(&Compared) -> f64| sorted(of).last().copied().unwrap_or(0.0);
    let errors = sorted(|c| c.error);
    let worst = compared.iter().max_by(|a, b| a.error.total_cmp(&b.error));
    let peak_worst = compared.iter().max_by(|a, b| a.peak.total_cmp(&b.peak));
    CheckReport {
        samples: compared.len(),
        maximum: quantile(&errors, 1.0),
        worst: worst.map(|c| c.place).unwrap_or_default(),
        quantile_999: quantile(&errors, 0.999),
        median: quantile(&errors, 0.5),
        peak_maximum: largest(|c| c.peak),
        peak_worst: peak_worst.map(|c| c.place).unwrap_or_default(),
        tangent_quantile_99: quantile(&sorted(|c| c.tangent), 0.99),
        difference_maximum: largest(|c| c.difference),
        dissipation_minimum: sorted(|c| c.dissipation).first().copied().unwrap_or(0.0),
        solver_maximum: largest(|c| c.solver),
        independent: compared.iter().filter(|c| c.by_rings).count(),
        independent_maximum: largest(|c| if c.by_rings { c.error } else { 0.0 }),
    }
}

/// State `index` of a seed.
fn draw(recipe: &Recipe, seed: u64, index: usize) -> Place {
    let mut random = Random(seed ^ (index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let [narrow, wide] = recipe.width_ratios;
    let width_ratio = narrow * (wide / narrow).powf(random.share());
    let last = recipe.last_eccentricity;
    let eccentricity = if random.share() < 0.5 {
        last * random.share()
    } else {
        (last.atanh() * random.share()).tanh()
    };
    let angle = if random.share() < 0.5 {
        PI * random.share()
    } else {
        Direction::angle(eccentricity, 2.0 * random.share() - 1.0)
    };
    Place {
        width_ratio,
        eccentricity,
        angle: if random.share() < 0.5 { angle } else { -angle },
    }
}

/// Films at the width ratio of a place that solved nothing so far: copies of those before if it is the same.
fn solver_at(
    recipe: &Recipe,
    known: &mut Option<(f64, NodeFilm)>,
    place: &Place,
    tangents: bool,
) -> NodeFilm {
    // Derivatives of rings at their set are as coarse as the columns: they ask for more of these.
    let tolerance = if tangents {
        recipe.tolerance().min(FINE)
    } else {
        recipe.tolerance()
    };
    let width_ratio = place.width_ratio;
    match known {
        Some((same, film)) if *same == width_ratio => film.fresh(),
        _ => {
            let film = NodeFilm::new(recipe.closure, width_ratio, tolerance);
            known.insert((width_ratio, film)).1.fresh()
        }
    }
}

/// The solver's film at a state, cold.
fn solved(
    mut film: NodeFilm,
    place: &Place,
    tangents: bool,
    by_rings: bool,
) -> Result<Solved, DatabaseError> {
    let angle = place.angle.abs();
    let solved = if by_rings {
        film.rings(place.eccentricity, angle, tangents)
    } else {
        film.solve(place.eccentricity, angle, tangents)
    };
    solved.ok_or(DatabaseError::NotSolved {
        eccentricity: place.eccentricity,
        direction_deg: place.angle.to_degrees(),
        width_ratio: place.width_ratio,
    })
}

/// Error of rings whose derivatives are compared.
const FINE: f64 = 1e-5;
/// One state of so many is compared with rings, whatever the films of the nodes are.
const INDEPENDENT: usize = 32;

/// Radial clearance of the bearing that states are looked up in, whose radius is 1 m.
const CLEARANCE: f64 = 1e-3;
/// Viscosity of its oil, Pa s.
const VISCOSITY: f64 = 1e-6;

/// A bearing of this width ratio for the recipe.
fn bearing(recipe: &Recipe, width_ratio: f64) -> Bearing {
    Bearing {
        diameter: 2.0,
        width: 2.0 * width_ratio,
        radial_clearance: CLEARANCE,
        bore: Shape::cylindrical(),
        journal: Shape::cylindrical(),
        feeds: Vec::new(),
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Air,
        inlet: recipe.inlet,
        cavitation: recipe.closure,
        film_shear: FilmShear::FullWidth,
        finish: Finish::Smooth,
        elasticity: Elasticity::Rigid,
    }
}

const CONDITIONS: Conditions<'_> = Conditions {
    temperature: 373.15, // the viscosity is given
    feed_pressures: None,
};

/// The table's film at the width ratio of a place: the one before if it is the same.
fn film_at<'film>(
    table: &Arc<Table>,
    last: &'film mut Option<(f64, TableFilm)>,
    place: &Place,
) -> Result<&'film mut TableFilm, DatabaseError> {
    let width_ratio = place.width_ratio;
    let own = match last.take() {
        Some((known, film)) if known == width_ratio => film,
        _ => TableFilm::new(
            Arc::clone(table),
            &bearing(table.recipe(), width_ratio),
            VISCOSITY,
        )?,
    };
    Ok(&mut last.insert((width_ratio, own)).1)
}

fn compare(
    film: &mut TableFilm,
    place: Place,
    solved: &Solved,
    derivatives: bool,
) -> Result<Compared, DatabaseError> {
    let side = 1.0_f64.copysign(place.angle);
    let mirrored = |[along, across]: [f64; 2]| [along, side * across];
    let scale = VISCOSITY * place.width_ratio / CLEARANCE.powi(3);
    let (sin, cos) = place.angle.sin_cos();
    let state = JournalState {
        position: [place.eccentricity * CLEARANCE, 0.0],
        velocity: [cos, sin],
        ..JournalState::default()
    };
    let seen = film.react(&state, Step::Steady, &CONDITIONS)?;
    let force = seen.reaction.film_force.map(|f| f / scale);
    let direct = mirrored(solved.force);
    let size = length(direct);
    let by_position = seen.tangent.by_position;
    let by_rate = seen.tangent.by_rate;
    let by_eps: [f64; 2] = std::array::from_fn(|row| by_position[row][0] * CLEARANCE / scale);
    let by_angle: [f64; 2] =
        std::array::from_fn(|row| (cos * by_rate[row][1] - sin * by_rate[row][0]) / scale);
    let direct_by_eps = mirrored(solved.by_eccentricity);
    let direct_by_angle = mirrored(solved.by_angle).map(|slope| side * slope);
    let off = |found: [f64; 2], direct: [f64; 2]| {
        length([found[0] - direct[0], found[1] - direct[1]]) / length(direct).max(size)
    };
    let peak = film.summary().peak_film_pressure.value * CLEARANCE.powi(3) / VISCOSITY;
    let peak = (peak / solved.peak - 1.0).abs();
    if !derivatives {
        return Ok(Compared {
            place,
            error: off(force, direct),
            peak,
            tangent: 0.0,
            difference: 0.0,
            dissipation: 1.0,
            solver: solved.error,
            by_rings: solved.by_rings,
        });
    }
    Ok(Compared {
        place,
        error: off(force, direct),
        peak,
        tangent: off(by_eps, direct_by_eps).max(off(by_angle, direct_by_angle)),
        difference: difference(film, &place)?,
        dissipation: dissipation(film, &place)?,
        solver: solved.error,
        by_rings: solved.by_rings,
    })
}

fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// A state anywhere around that turns, of the same place.
fn turned(place: &Place, eccentricity: f64) -> JournalState {
    let line_of_centres = 7.0 * place.angle + 40.0 * place.eccentricity;
    let way = line_of_centres + place.angle;
    let position =
        [line_of_centres.cos(), line_of_centres.sin()].map(|unit| eccentricity * CLEARANCE * unit);
    let speed = 300.0;
    let mean = 0.5 * speed;
    // The effective velocity is one of 1 m/s.
    JournalState {
        position,
        velocity: [
            way.cos() - mean * position[1],
            way.sin() + mean * position[0],
        ],
        journal_speed: speed,
        ..JournalState::default()
    }
}

/// Largest difference of the derivatives to central differences of the table, over the largest of them,
/// with the steps that show it best: long ones cross nodes, short ones lose digits.
fn difference(film: &mut TableFilm, place: &Place) -> Result<f64, DatabaseError> {
    let state = turned(place, place.eccentricity);
    let tangent = film.react(&state, Step::Steady, &CONDITIONS)?.tangent;
    let gap = 1.0 - place.eccentricity;
    let mut worst = 0.0_f64;
    for (by_rate, scale) in [(false, CLEARANCE * gap), (true, gap.sqrt())] {
        let exact = if by_rate {
            &tangent.by_rate
        } else {
            &tangent.by_position
        };
        let mut best = f64::INFINITY;
        for step in STEPS {
            let central = central_differences(film, &state, by_rate, step * scale)?;
            let mut largest = 0.0_f64;
            let mut off = 0.0_f64;
            for (exact, central) in exact.iter().zip(&central) {
                for (exact, central) in exact.iter().zip(central) {
                    largest = largest.max(exact.abs());
                    off = off.max((exact - central).abs());
                }
            }
            best = best.min(off / largest);
        }
        worst = worst.max(best);
    }
    Ok(worst)
}

/// Steps of the differences, relative to the gap, or to its root for velocities.
const STEPS: [f64; 3] = [1e-3, 1e-4, 1e-5];

/// Derivatives of the force by position or velocity, rows force, columns direction; of fourth order.
fn central_differences(
    film: &mut TableFilm,
    state: &JournalState,
    by_rate: bool,
    step: f64,
) -> Result<[[f64; 2]; 2], DatabaseError> {
    let mut central = [[0.0; 2]; 2];
    for column in 0..2 {
        let mut at = |ahead: f64| -> Result<[f64; 2], DatabaseError> {
            let mut moved = *state;
            if by_rate {
                moved.velocity[column] += ahead;
            } else {
                moved.position[column] += ahead;
            }
            let seen = film.react(&moved, Step::Steady, &CONDITIONS)?;
            Ok(seen.reaction.film_force)
        };
        let [far, near] = [(at(2.0 * step)?, at(-2.0 * step)?), (at(step)?, at(-step)?)];
        for (row, central) in central.iter_mut().enumerate() {
            central[column] =
                (8.0 * (near.0[row] - near.1[row]) - (far.0[row] - far.1[row])) / (12.0 * step);
        }
    }
    Ok(central)
}

/// Smallest share of the force along the effective velocity it resists, at the place and beyond the
/// last eccentricity.
fn dissipation(film: &mut TableFilm, place: &Place) -> Result<f64, DatabaseError> {
    let last = film.table().recipe().last_eccentricity;
    let beyond = last + (1.0 - last) * place.eccentricity;
    let mut smallest = f64::INFINITY;
    for eccentricity in [place.eccentricity, beyond] {
        let state = turned(place, eccentricity);
        let force = film
            .react(&state, Step::Steady, &CONDITIONS)?
            .reaction
            .film_force;
        let motion = sommerfeld_film::closed_form::PlainFilm::effective_velocity(&state);
        let power = -(force[0] * motion[0] + force[1] * motion[1]);
        smallest = smallest.min(power / length(force));
    }
    Ok(smallest)
}

/// Numbers that look random (splitmix64 of Steele, Lea and Flood, 2014).
struct Random(u64);

impl Random {
    /// From 0 to below 1.
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 53) as f64
    }
}
