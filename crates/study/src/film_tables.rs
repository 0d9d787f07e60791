//! Databases of films that a study names: what each holds, how far it errs, and which of them holds
//! the film of a bearing.

use serde::{Deserialize, Serialize};
use sommerfeld_database::contents::Contents;
use sommerfeld_database::superposition::{SuperpositionFilm, SuperpositionTable};
use sommerfeld_database::{DatabaseError, Table, TableFilm};
use sommerfeld_film::{
    Bearing, Cavitation, Conditions, Elasticity, Ends, FilmForce, FilmShear, Finish, Inlet,
    JournalState, Outcome, Shape, Step,
};
use std::path::Path;
use std::sync::Arc;

/// How the two motions of a film, wedge and squeeze, are put together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scheme {
    /// Solved together, at every ratio of one to the other.
    Combined,
    /// Each solved apart, and their forces added.
    Superposition,
}

impl Scheme {
    /// As in study file and database.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Combined => "combined",
            Self::Superposition => "superposition",
        }
    }
}

/// A database that a study names.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredFilms {
    /// The file as the study names it.
    pub name: String,
    /// Its content.
    pub table: FilmTable,
}

/// The content of a database.
#[derive(Debug, Clone)]
pub enum FilmTable {
    /// Wedge and squeeze solved together.
    Combined(Arc<Table>),
    /// Wedge and squeeze solved apart.
    Superposition(Arc<SuperpositionTable>),
}

impl PartialEq for FilmTable {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Combined(a), Self::Combined(b)) => a == b,
            (Self::Superposition(a), Self::Superposition(b)) => {
                a.recipe() == b.recipe() && a.accuracy() == b.accuracy()
            }
            _ => false,
        }
    }
}

/// What a reader of results must know of the database that a film was looked up in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DatabaseFacts {
    /// The file as the study names it.
    pub file: String,
    /// How wedge and squeeze are put together.
    pub scheme: Scheme,
    /// Closure for the ruptured film.
    pub closure: String,
    /// Smallest and largest width over diameter.
    pub width_ratios: [f64; 2],
    /// Last relative eccentricity with nodes.
    pub last_eccentricity: f64,
    /// Error of the force over its size that it was built to keep; of a superposition, of force and moment of
    /// wedge and squeeze each.
    pub bound: f64,
    /// Largest error of the force over its size that the samples of the build found.
    pub stated_error: f64,
    /// The number of those samples.
    pub samples: usize,
    /// Nodes of the table.
    pub points: usize,
    /// Whether those samples err by no more than [`Self::bound`].
    pub status: Outcome,
    /// Its journals tilt.
    pub is_tilted: bool,
    /// Smallest relative film thickness that the stated error was found at.
    pub smallest_gap: f64,
    /// Where the film starts.
    pub inlet: String,
}

impl DatabaseFacts {
    /// In a line for a reader.
    #[must_use]
    pub fn told(&self) -> String {
        let [narrow, wide] = self.width_ratios;
        let held = if narrow == wide {
            format!("B/D {narrow:.4}")
        } else {
            format!("B/D {narrow:.4} to {wide:.4}")
        };
        format!(
            "database {} ({}, closure {}, {held}{}), {}stated error {:.1e} of the force{}, {:.1e} found at {} \
             states",
            self.file,
            self.scheme.name(),
            self.closure,
            if self.is_tilted { ", tilted" } else { "" },
            match self.status {
                Outcome::Converged => String::new(),
                _ => format!("{} to its target: ", self.status_name().to_uppercase()),
            },
            self.bound,
            match self.scheme {
                Scheme::Combined => "",
                Scheme::Superposition => " of wedge and of squeeze, but not of their sum",
            },
            self.stated_error,
            self.samples
        )
    }

    /// How its journals stand, as in studies.
    #[must_use]
    pub const fn journal(&self) -> &'static str {
        if self.is_tilted { "tilted" } else { "aligned" }
    }

    /// Its status as in summaries.
    #[must_use]
    pub const fn status_name(&self) -> &'static str {
        match self.status {
            Outcome::Converged => "converged",
            _ => "not-converged",
        }
    }
}

/// The closure as in study files.
#[must_use]
pub const fn closure_name(closure: Cavitation) -> &'static str {
    match closure {
        Cavitation::Gumbel => "gumbel",
        Cavitation::Reynolds => "reynolds",
        Cavitation::MassConserving => "mass-conserving",
    }
}

impl StoredFilms {
    /// Reads a database; `name` is how the study names it.
    ///
    /// # Errors
    /// [`DatabaseError`] where there is no such file, or it is none, or damaged.
    pub fn load(name: &str, path: &Path) -> Result<Self, DatabaseError> {
        let table = match Contents::scheme(path)?.as_str() {
            "superposition" => FilmTable::Superposition(Arc::new(SuperpositionTable::read(path)?)),
            // One that is not known is told by its reader.
            _ => FilmTable::Combined(Arc::new(Table::load(path)?)),
        };
        Ok(Self {
            name: name.to_owned(),
            table,
        })
    }

    /// How wedge and squeeze are put together.
    #[must_use]
    pub fn scheme(&self) -> Scheme {
        match &self.table {
            FilmTable::Combined(_) => Scheme::Combined,
            FilmTable::Superposition(_) => Scheme::Superposition,
        }
    }

    /// Closure for the ruptured film.
    #[must_use]
    pub fn closure(&self) -> Cavitation {
        match &self.table {
            FilmTable::Combined(table) => table.recipe().closure,
            FilmTable::Superposition(table) => table.recipe().cavitation,
        }
    }

    /// What a reader of results must know.
    #[must_use]
    pub fn facts(&self) -> DatabaseFacts {
        match &self.table {
            FilmTable::Combined(table) => {
                let recipe = table.recipe();
                DatabaseFacts {
                    file: self.name.clone(),
                    scheme: self.scheme(),
                    closure: closure_name(recipe.closure).to_owned(),
                    width_ratios: recipe.width_ratios,
                    last_eccentricity: recipe.last_eccentricity,
                    bound: recipe.target,
                    stated_error: table.errors().maximum,
                    samples: recipe.samples,
                    points: table.nodes().len(),
                    status: match table.errors().maximum <= recipe.target {
                        true => Outcome::Converged,
                        false => Outcome::NotConverged,
                    },
                    is_tilted: false,
                    smallest_gap: 1.0 - recipe.last_eccentricity,
                    inlet: "cyclic".to_owned(),
                }
            }
            FilmTable::Superposition(table) => {
                let recipe = table.recipe();
                let accuracy = table.accuracy();
                let nodes = recipe.eccentricity_nodes
                    * recipe.tilt_nodes.iter().product::<usize>()
                    * accuracy.len();
                DatabaseFacts {
                    file: self.name.clone(),
                    scheme: self.scheme(),
                    closure: closure_name(recipe.cavitation).to_owned(),
                    width_ratios: [1.0 / recipe.d_over_b; 2],
                    last_eccentricity: recipe.eccentricities[1],
                    bound: recipe.target,
                    stated_error: table.largest_error(),
                    samples: accuracy.iter().map(|one| one.samples).sum(),
                    points: nodes,
                    status: table.outcome(),
                    is_tilted: table.is_tilted(),
                    smallest_gap: recipe.smallest_gap,
                    inlet: match recipe.wedge_inlet {
                        Inlet::Cyclic => "cyclic",
                        Inlet::MaxFilmLine { .. } => "max-film-line",
                    }
                    .to_owned(),
                }
            }
        }
    }

    /// Its journals tilt.
    #[must_use]
    pub fn is_tilted(&self) -> bool {
        match &self.table {
            FilmTable::Combined(_) => false,
            FilmTable::Superposition(table) => table.is_tilted(),
        }
    }

    /// The film of a bearing at one viscosity, Pa s.
    ///
    /// # Errors
    /// [`DatabaseError`] for a bearing that the table does not hold.
    pub fn film(
        &self,
        bearing: &Bearing,
        viscosity: f64,
    ) -> Result<Box<dyn FilmForce + Send>, DatabaseError> {
        match &self.table {
            FilmTable::Combined(table) => {
                let film = TableFilm::new(Arc::clone(table), bearing, viscosity)?;
                Ok(Box::new(film))
            }
            FilmTable::Superposition(table) => {
                let film = SuperpositionFilm::new(Arc::clone(table), bearing, viscosity)?;
                Ok(Box::new(film))
            }
        }
    }

    /// Why the database does not hold the film of a bearing, with what it holds; `None` where it does.
    #[must_use]
    pub fn misfit(&self, bearing: &Bearing) -> Option<String> {
        let facts = self.facts();
        let closure = closure_name(bearing.cavitation);
        if facts.closure != closure {
            return Some(format!(
                "the database {} holds films with cavitation = \"{}\", the bearing has \"{closure}\"",
                self.name, facts.closure
            ));
        }
        if bearing.inlet != Inlet::Cyclic {
            return Some(format!(
                "the database {} holds films with inlet = \"cyclic\", the bearing has \
                 \"max-film-line\"",
                self.name
            ));
        }
        let [narrow, wide] = facts.width_ratios;
        let ratio = bearing.width / bearing.diameter;
        let round_off = 1e-9;
        if !(ratio >= narrow * (1.0 - round_off) && ratio <= wide * (1.0 + round_off)) {
            let held = if narrow == wide {
                format!("width/diameter {narrow:.6}")
            } else {
                format!("width/diameter from {narrow:.6} to {wide:.6}")
            };
            return Some(format!(
                "the database {} holds films of {held}, the bearing has {ratio:.6}",
                self.name
            ));
        }
        None
    }
}

/// What a database says of a state, without dimensions: `w` is the effective velocity of the journal
/// centre, relative to the oil that both surfaces drag along, `velocity - mean speed x eccentricity`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LookedUp {
    /// Force along and across the line of centres over `eta |w| R^3 B / (2 c^3)`.
    pub force: [f64; 2],
    /// Its derivative by the relative eccentricity, w held.
    pub by_eccentricity: [f64; 2],
    /// Its derivative by the angle of w from the line of centres.
    pub by_angle: [f64; 2],
    /// Peak pressure over `eta |w| R^2 / c^3`.
    pub peak_pressure: f64,
    /// Its angle from the narrowest gap, rad. Not a number, as the next two, where the scheme does not store it.
    pub peak_angle: f64,
    /// Oil leaving at each end over `|w| R B`.
    pub side_flow: f64,
    /// Share of the bearing area under pressure.
    pub full_film_share: f64,
    /// Moment about and across the line of centres over that of the force's scale with an arm of half the width.
    pub moment: [f64; 2],
}

/// A bearing of radius 1 m in which states without dimensions are looked up.
const CLEARANCE: f64 = 1e-3;
/// Pa s
const VISCOSITY: f64 = 1e-6;

impl StoredFilms {
    /// Looks up the film of a state: width over diameter, relative eccentricity, angle of the effective
    /// velocity from the line of centres (rad; 0 where the gap closes).
    ///
    /// # Errors
    /// [`DatabaseError`] for a width ratio that the database does not hold, and an eccentricity of 1 and
    /// more.
    pub fn look(
        &self,
        width_ratio: f64,
        eccentricity: f64,
        angle: f64,
    ) -> Result<LookedUp, DatabaseError> {
        self.look_tilted(width_ratio, eccentricity, angle, [0.0; 2])
    }

    /// The same of a journal with relative tilts: gamma, in the plane of the narrowest gap over its largest value,
    /// and delta, across it, as it stands in the gap.
    ///
    /// # Errors
    /// As [`StoredFilms::look`], and for tilts that the database does not hold or that close the gap.
    pub fn look_tilted(
        &self,
        width_ratio: f64,
        eccentricity: f64,
        angle: f64,
        [gamma, delta]: [f64; 2],
    ) -> Result<LookedUp, DatabaseError> {
        let bearing = Bearing {
            diameter: 2.0,
            width: 2.0 * width_ratio,
            radial_clearance: CLEARANCE,
            bore: Shape::cylindrical(),
            journal: Shape::cylindrical(),
            feeds: Vec::new(),
            ambient_pressure: 0.0,
            cavitation_pressure: 0.0,
            ends: Ends::Air,
            inlet: Inlet::Cyclic,
            cavitation: self.closure(),
            film_shear: FilmShear::FullWidth,
            finish: Finish::Smooth,
            elasticity: Elasticity::Rigid,
        };
        let mut film = self.film(&bearing, VISCOSITY)?;
        let (sin, cos) = angle.sin_cos();
        let state = JournalState {
            position: [eccentricity * CLEARANCE, 0.0],
            tilt: [delta, -gamma * (1.0 - eccentricity)]
                .map(|tilt| 2.0 * CLEARANCE * tilt / bearing.width),
            velocity: [cos, sin],
            ..JournalState::default()
        };
        let conditions = Conditions {
            temperature: 373.15, // the viscosity is given
            feed_pressures: None,
        };
        let seen = film.react(&state, Step::Steady, &conditions)?;
        let scale = VISCOSITY * bearing.width / (2.0 * CLEARANCE.powi(3));
        let summary = film.summary();
        let (by_position, by_rate) = (seen.tangent.by_position, seen.tangent.by_rate);
        let of_combined = |value: f64| match self.scheme() {
            Scheme::Combined => value,
            Scheme::Superposition => f64::NAN,
        };
        Ok(LookedUp {
            force: seen.reaction.film_force.map(|force| force / scale),
            by_eccentricity: [0, 1].map(|row| by_position[row][0] * CLEARANCE / scale),
            by_angle: [0, 1].map(|row| (cos * by_rate[row][1] - sin * by_rate[row][0]) / scale),
            peak_pressure: summary.peak_film_pressure.value * CLEARANCE.powi(3) / VISCOSITY,
            peak_angle: of_combined(summary.peak_film_pressure.angle),
            side_flow: of_combined(summary.side_flow[0] / bearing.width),
            full_film_share: of_combined(summary.full_film_share),
            moment: seen
                .reaction
                .film_moment
                .map(|moment| 2.0 * moment / (scale * bearing.width)),
        })
    }
}

/// The database of a scheme that holds the film of a bearing.
///
/// # Errors
/// Why none does, in words.
pub fn holding<'a>(
    databases: &'a [StoredFilms],
    scheme: Scheme,
    bearing: &Bearing,
) -> Result<&'a StoredFilms, String> {
    let mut reasons = Vec::new();
    for database in databases.iter().filter(|one| one.scheme() == scheme) {
        match database.misfit(bearing) {
            None => return Ok(database),
            Some(reason) => reasons.push(reason),
        }
    }
    if reasons.is_empty() {
        return Err(format!(
            "film.database names no database of the scheme {}",
            scheme.name()
        ));
    }
    Err(reasons.join("; "))
}
