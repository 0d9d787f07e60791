//! What does a table answer to a journal that moves in any way?
//!
//! With the effective velocity w, its angle theta from the line of centres and J the turn by 90 degrees
//! ```text
//! F = -S D (w + q J w),   S = eta R^3 B / (2 c^3),   D = exp(L), q = +-sinh(m)    (L, m)(eps, |theta|)
//! dF/dw = -S D [1 + q J + ((w + q J w) L_theta + J w q_theta) (J w)^T / |w|^2]
//! dF/de = -S D [(w + q J w) (L_eps e^/c - L_theta J e/|e|^2)^T + J w (q_eps e^/c - q_theta J e/|e|^2)^T]
//! ```
//! which is homogeneous of degree 1 in w by its form, loses energy everywhere since D > 0, and has exact
//! derivatives. L and m are splines, twice differentiable but in the centre, where they are once; beyond the
//! last eccentricity both tend to straight lines over atanh(eps), that is F to a power of the gap. At eps = 0
//! the film only resists w.
//! Limits: those of the table; full-width shear, see [`PlainFilm`].

use crate::axis::Placing;
use crate::direction::{Direction, Position};
use crate::error::DatabaseError;
use crate::surface::{Centre, Surface};
use crate::table::Table;
use sommerfeld_film::closed_form::PlainFilm;
use sommerfeld_film::{
    Bearing, Capabilities, Conditions, Elasticity, Extreme, FilmError, FilmForce, FilmSummary,
    Finish, JournalState, Linearised, Step,
};
use std::sync::Arc;

/// A film looked up in a table.
#[derive(Debug, Clone)]
pub struct TableFilm {
    table: Arc<Table>,
    film: PlainFilm,
    eccentricity: Placing,
    direction: Placing,
    forces: Surface<2>,
    centre: Centre,
    figures: Surface<4>,
    per_clearance: f64,
    /// Force of a film of unit dissipation at unit velocity, with its sign, N s/m.
    scale: f64,
}

/// Relative eccentricity below which the direction of the journal from the centre is taken for that of
/// its motion.
const CENTRED: f64 = 1e-8;

impl TableFilm {
    /// Film of `bearing` at one viscosity [Pa s].
    ///
    /// # Errors
    /// [`DatabaseError::Unsupported`] for a bearing with another closure, another inlet, feeds, pressures
    /// at its ends or in the ruptured film, roughness, elasticity, profiles or film shear other than full
    /// width; [`DatabaseError::Recipe`] for a width ratio out of the table.
    pub fn new(
        table: Arc<Table>,
        bearing: &Bearing,
        viscosity: f64,
    ) -> Result<Self, DatabaseError> {
        refuse(&table, bearing)?;
        let film = PlainFilm::new(bearing, viscosity)?;
        let (forces, figures) = table.slice(bearing.width / bearing.diameter)?;
        let slenderness = film.radius / film.clearance;
        Ok(Self {
            scale: -0.5 * film.viscosity * film.width * slenderness.powi(3),
            per_clearance: 1.0 / film.clearance,
            film,
            eccentricity: table.axes().eccentricity.placing(),
            direction: table.axes().direction.placing(),
            centre: Centre::of(&forces),
            forces,
            figures,
            table,
        })
    }

    /// The table it looks up.
    #[must_use]
    pub fn table(&self) -> &Arc<Table> {
        &self.table
    }

    /// Position, with a direction where there is none, and effective velocity.
    #[inline]
    fn position_and_motion(&self, state: &JournalState) -> ([f64; 2], [f64; 2]) {
        let motion = PlainFilm::effective_velocity(state);
        let mut position = state.position;
        let smallest = CENTRED * self.film.clearance;
        if length(position) < smallest {
            let speed = length(motion);
            position = if speed > 0.0 {
                motion.map(|w| smallest * w / speed)
            } else {
                [smallest, 0.0]
            };
        }
        (position, motion)
    }

    /// Force and its derivatives by position, at fixed effective velocity, and by effective velocity.
    #[inline]
    fn forces(&self, state: &JournalState) -> ([f64; 2], [[f64; 2]; 2], [[f64; 2]; 2]) {
        let (position, motion) = self.position_and_motion(state);
        let distance = length(position);
        let per_distance = 1.0 / distance;
        let unit = position.map(|e| e * per_distance);
        let eps = distance * self.per_clearance;
        let speed = length(motion);
        // A film at rest answers as if its gap began to close.
        let way = if speed > 0.0 {
            let per_speed = 1.0 / speed;
            motion.map(|w| w * per_speed)
        } else {
            unit
        };
        let along = way[0] * unit[0] + way[1] * unit[1];
        let across = unit[0] * way[1] - unit[1] * way[0];
        let side = 1.0_f64.copysign(across);
        let seen = self.look(eps, along, across.abs());
        let [dissipation, turn] = seen.value;
        let growth = turn.exp();
        let shrink = 1.0 / growth;
        let (sinh, cosh) = (0.5 * (growth - shrink), 0.5 * (growth + shrink));
        let scale = self.scale * dissipation.exp();
        let quarter = |[x, y]: [f64; 2]| [-y, x];
        let (turned, beside) = (quarter(way), quarter(unit));
        let q = side * sinh;
        // Per unit velocity: the answer, its change per turn of w and per relative eccentricity.
        let answer: [f64; 2] = std::array::from_fn(|k| way[k] + q * turned[k]);
        let slope =
            |l: f64, m: f64| -> [f64; 2] { std::array::from_fn(|k| answer[k] * l + turned[k] * m) };
        let per_turn = slope(side * seen.by_angle[0], cosh * seen.by_angle[1]);
        let per_eps = slope(
            seen.by_eccentricity[0],
            side * cosh * seen.by_eccentricity[1],
        );
        let mut by_velocity = [[0.0; 2]; 2];
        let mut by_position = [[0.0; 2]; 2];
        let identity = [[1.0, -q], [q, 1.0]];
        let force = scale * speed;
        let (of_eps, of_turn) = (force * self.per_clearance, force * per_distance);
        for row in 0..2 {
            for column in 0..2 {
                by_velocity[row][column] =
                    scale * (identity[row][column] + per_turn[row] * turned[column]);
                by_position[row][column] =
                    of_eps * per_eps[row] * unit[column] - of_turn * per_turn[row] * beside[column];
            }
        }
        (answer.map(|share| force * share), by_position, by_velocity)
    }

    /// Logarithms of the force at a relative eccentricity, for a unit velocity along the line of centres and
    /// across it, the latter not negative.
    #[inline]
    fn look(&self, eps: f64, along: f64, across: f64) -> Logarithms {
        let position = Position::new(eps);
        let direction = Direction::of_unit(&position, along, across);
        let place_e = self.eccentricity.of_coordinate(position.atanh);
        let place_d = self.direction.of_coordinate(direction.place);
        let slope_e = self.eccentricity.per_coordinate() * position.atanh_slope;
        let slope_d = self.direction.per_coordinate();
        let mut found = self.forces.look(place_e, place_d);
        if place_e < 1.0 {
            let added = self.centre.look(place_e, place_d);
            for lane in 0..2 {
                found.value[lane] += added.value[lane];
                found.by_eccentricity[lane] += added.by_eccentricity[lane];
                found.by_direction[lane] += added.by_direction[lane];
            }
        }
        let turned_slope = slope_d * direction.by_angle;
        let moved_slope = slope_d * direction.by_eccentricity;
        Logarithms {
            value: found.value,
            by_angle: std::array::from_fn(|k| found.by_direction[k] * turned_slope),
            by_eccentricity: std::array::from_fn(|k| {
                found.by_eccentricity[k] * slope_e + found.by_direction[k] * moved_slope
            }),
        }
    }
}

/// L and m with their derivatives by the angle of w and by relative eccentricity.
#[derive(Debug, Clone, Copy)]
struct Logarithms {
    value: [f64; 2],
    by_angle: [f64; 2],
    by_eccentricity: [f64; 2],
}

/// Without the care of `hypot` for numbers whose squares leave the range: journals have none.
#[inline]
fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

/// Refuses bearings of which the table says nothing.
fn refuse(table: &Table, bearing: &Bearing) -> Result<(), DatabaseError> {
    let recipe = table.recipe();
    let refusals = [
        (
            bearing.cavitation != recipe.closure,
            "the table was built with another closure: set film.cavitation to the table's, or build one \
             for this closure",
        ),
        (
            bearing.inlet != recipe.inlet,
            "the table was built with inlet = \"cyclic\": set it, or use model = \"field\"",
        ),
        (
            !bearing.feeds.is_empty(),
            "a table knows no grooves and holes: leave them out, or use model = \"field\"",
        ),
        (
            bearing.ambient_pressure != 0.0 || bearing.cavitation_pressure != 0.0,
            "a table holds films with ambient and cavitation pressure 0: use model = \"field\"",
        ),
        (
            bearing.finish != Finish::Smooth,
            "a table holds films between smooth surfaces: use model = \"field\"",
        ),
        (
            bearing.elasticity != Elasticity::Rigid,
            "a table holds films in rigid shells: use model = \"field\"",
        ),
    ];
    match refusals.into_iter().find(|(refused, _)| *refused) {
        Some((_, reason)) => Err(DatabaseError::Unsupported { reason }),
        None => Ok(()),
    }
}

impl FilmForce for TableFilm {
    fn capabilities(&self) -> Capabilities {
        PlainFilm::capabilities()
    }

    fn minimum_gap(&self, state: &JournalState) -> f64 {
        self.film.minimum_gap(state)
    }

    fn linearise(
        &mut self,
        state: &JournalState,
        _step: Step,
        _conditions: &Conditions<'_>,
    ) -> Result<Linearised, FilmError> {
        self.film.check(state)?;
        let (force, by_position, by_velocity) = self.forces(state);
        Ok(self.film.answer(state, force, by_position, by_velocity))
    }

    fn summary(&self) -> FilmSummary {
        let Some(state) = self.film.last_state() else {
            return FilmSummary::default();
        };
        let (position, motion) = self.position_and_motion(state);
        let speed = length(motion);
        if speed == 0.0 {
            return self.film.summary(Extreme::default(), 0.0, 0.0);
        }
        let distance = length(position);
        let along = (motion[0] * position[0] + motion[1] * position[1]) / distance;
        let across = (position[0] * motion[1] - position[1] * motion[0]) / distance;
        let film = &self.film;
        let eps = distance / film.clearance;
        let place = self.eccentricity.place(eps).0;
        let direction = self
            .direction
            .place(Direction::new(eps, along, across).place)
            .0;
        let [peak, side_flow, share, angle] = self.figures.look(place, direction).value;
        let scale = film.viscosity * speed * film.radius.powi(2) / film.clearance.powi(3);
        let line_of_centres = position[1].atan2(position[0]);
        let turned = line_of_centres + angle.copysign(across);
        let peak = Extreme {
            value: scale * peak.exp(),
            angle: turned - (turned / std::f64::consts::TAU).round() * std::f64::consts::TAU,
            axial: 0.0,
        };
        film.summary(peak, side_flow * speed * film.radius * film.width, share)
    }

    fn accept_step(&mut self) {
        self.film.restart_count();
    }

    fn reject_step(&mut self) {
        self.film.restart_count();
    }
}
