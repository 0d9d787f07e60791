//! A checked study: everything a run needs, in SI, with nothing left to doubt.

use super::error::InputError;
use super::heat::HeatPlan;
use super::machine::MachinePlan;
use super::sweep::SweepPlan;
use super::wear::WearPlan;
use crate::film_tables::{Scheme, StoredFilms};
use sommerfeld_bearing::LoadCycle;
use sommerfeld_database::Recipe;
use sommerfeld_database::superposition::SuperpositionRecipe;
use sommerfeld_film::dimensionless::DimensionlessFilm;
use sommerfeld_film::{Bearing, Cavitation, JournalState};
use sommerfeld_oil::Lubricant;
use std::path::PathBuf;

/// A study file that was read and checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// Title; empty where the file gives none.
    pub title: String,
    /// What is calculated.
    pub analysis: Analysis,
    /// What it is calculated of.
    pub subject: Subject,
    /// How the film is modelled; of a sweep, in its first case.
    pub film: FilmSettings,
    /// The rotor whose stability is asked for.
    pub rotor: Rotor,
    /// Design limits, in the order of the table of keys.
    pub limits: Vec<StudyLimit>,
    /// What the user should know.
    pub warnings: Vec<InputError>,
    /// The study file, as the user named it.
    pub file: String,
    /// The study file and the tables it names: what a run must not write over.
    pub files: Vec<PathBuf>,
    /// Its text, without a byte order mark.
    pub text: String,
    /// Identifies study text and the tables it names: equal hashes are the same calculation.
    pub input_hash: String,
}

impl Study {
    /// The bearing, unless the study is dimensionless or a sweep.
    #[must_use]
    pub fn bearing_case(&self) -> Option<&BearingCase> {
        match &self.subject {
            Subject::Bearing(case) => Some(case),
            Subject::Dimensionless(_)
            | Subject::Sweep(_)
            | Subject::Machine(_)
            | Subject::Database(_) => None,
        }
    }
}

/// What a study calculates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Analysis {
    /// One film at a given journal state.
    Film,
    /// The position that carries a constant load.
    Equilibrium,
    /// Stiffness and damping at that position.
    Coefficients,
    /// The journal orbit over a load cycle.
    LoadCycle,
    /// Every bearing of an engine.
    Engine,
    /// Every bearing of a shaft with given loads.
    Shaft,
    /// Films solved before, stored to be looked up.
    Database,
    /// One of these for each of many cases.
    Sweep,
}

impl Analysis {
    /// As in the study file.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Film => "film",
            Self::Equilibrium => "equilibrium",
            Self::Coefficients => "coefficients",
            Self::LoadCycle => "load-cycle",
            Self::Engine => "engine",
            Self::Shaft => "shaft",
            Self::Database => "database",
            Self::Sweep => "sweep",
        }
    }
}

/// What is calculated: a bearing in SI, or the dimensionless film problem.
#[derive(Debug, Clone, PartialEq)]
pub enum Subject {
    /// A bearing in SI.
    Bearing(Box<BearingCase>),
    /// The dimensionless film problem.
    Dimensionless(DimensionlessFilm),
    /// An engine or shaft with all its bearings.
    Machine(Box<MachinePlan>),
    /// A database of films.
    Database(Box<DatabasePlan>),
    /// Many cases of a base study.
    Sweep(SweepPlan),
}

/// A database of films that is to be built.
#[derive(Debug, Clone, PartialEq)]
pub enum DatabasePlan {
    /// Wedge and squeeze solved together.
    Combined(Recipe),
    /// Wedge and squeeze solved apart, as in the paper.
    Superposition(SuperpositionRecipe),
}

impl DatabasePlan {
    /// Closure for the ruptured film.
    #[must_use]
    pub const fn closure(&self) -> Cavitation {
        match self {
            Self::Combined(recipe) => recipe.closure,
            Self::Superposition(recipe) => recipe.cavitation,
        }
    }

    /// How wedge and squeeze are put together.
    #[must_use]
    pub const fn scheme(&self) -> Scheme {
        match self {
            Self::Combined(_) => Scheme::Combined,
            Self::Superposition(_) => Scheme::Superposition,
        }
    }

    /// Smallest and largest width over diameter.
    #[must_use]
    pub const fn width_ratios(&self) -> [f64; 2] {
        match self {
            Self::Combined(recipe) => recipe.width_ratios,
            Self::Superposition(recipe) => [1.0 / recipe.d_over_b; 2],
        }
    }

    /// Error asked for.
    #[must_use]
    pub const fn target(&self) -> f64 {
        match self {
            Self::Combined(recipe) => recipe.target,
            Self::Superposition(recipe) => recipe.target,
        }
    }
}

/// A bearing with its oil and what it has to do.
#[derive(Debug, Clone, PartialEq)]
pub struct BearingCase {
    /// The bearing.
    pub bearing: Bearing,
    /// The oil.
    pub lubricant: Lubricant,
    /// Temperature of the film, K; its first guess where heat is balanced.
    pub temperature: f64,
    /// Where the temperature of the film comes from.
    pub heat: HeatPlan,
    /// What wears, where it is asked for.
    pub wear: Option<WearPlan>,
    /// What the bearing has to do.
    pub duty: Duty,
}

/// What the bearing has to do; one variant for each analysis, equilibrium and coefficients sharing
/// theirs.
#[derive(Debug, Clone, PartialEq)]
pub enum Duty {
    /// Analysis `film`: hold this journal state.
    State(JournalState),
    /// Analyses `equilibrium` and `coefficients`: carry this load.
    Load(SteadyLoad),
    /// Analysis `load-cycle`: carry this load cycle.
    Cycle(CycleDuty),
}

/// A constant load and the speeds under it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyLoad {
    /// Load ON the journal, N.
    pub load: [f64; 2],
    /// Angular speed of the journal in the frame of the load, rad/s.
    pub journal_speed: f64,
    /// Angular speed of the shell in the frame of the load, rad/s.
    pub shell_speed: f64,
    /// What holds the tilt.
    pub tilt: TiltCondition,
}

/// The rigid rotor on the bearing, as far as the analysis `coefficients` asks for its stability.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rotor {
    /// Mass that the bearing carries, kg.
    pub mass: Option<f64>,
    /// Journal speeds of the stability chart, rad/s, ascending; empty without a chart.
    pub speeds: Vec<f64>,
}

/// What holds the tilt of the journal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TiltCondition {
    /// The tilt is given, rad about X and Y.
    Fixed([f64; 2]),
    /// The tilt is free and answers this moment ON the journal, N m about X and Y.
    Free {
        /// Moment on the journal, N m.
        moment: [f64; 2],
    },
}

/// A load cycle and how its orbit is computed.
#[derive(Debug, Clone, PartialEq)]
pub struct CycleDuty {
    /// The load cycle.
    pub cycle: LoadCycle,
    /// Crank angles at which stiffness and damping are taken, rad.
    pub coefficients_at: Vec<f64>,
    /// Crank angle between two rows of the results, rad; divides the period.
    pub crank_step: f64,
    /// Cycles after which an orbit that has not closed is given up.
    pub maximum_cycles: usize,
    /// The orbit is closed when two cycles differ by less, over the radial clearance.
    pub closure_tolerance: f64,
    /// Instants of which `results.h5` holds the fields.
    pub stored_fields: StoredInstants,
    /// Error allowed to a time step over the usual one: 1, but where a run is repeated with other
    /// steps to see what they cost.
    pub step_error_factor: f64,
}

/// Instants of a cycle of which `results.h5` holds the fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StoredInstants {
    /// Every crank angle of the results.
    All,
    /// At most 72 evenly spaced ones.
    Frames,
    /// None.
    None,
}

/// How the film is modelled.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmSettings {
    /// The model.
    pub model: FilmModel,
    /// How a dimensionless film is solved.
    pub method: FilmMethod,
    /// Cells around the circumference and along the axis.
    pub grid: [usize; 2],
    /// Solver of the linear systems.
    pub linear_solver: LinearSolver,
    /// Estimated error below which the grid is refined, over the scale of each figure; `None` takes
    /// the grid as it is.
    pub relative_error_target: Option<f64>,
    /// What the study is run once more with, to compare.
    pub compare: Vec<Compared>,
    /// The databases that the study names.
    pub databases: Vec<StoredFilms>,
}

impl FilmSettings {
    /// The study is run once more with plain surfaces and oil.
    #[must_use]
    pub fn compares_plain(&self) -> bool {
        self.compare.contains(&Compared::Plain)
    }

    /// Film models beside the study's own that it is run with once more.
    pub fn compared_models(&self) -> impl Iterator<Item = FilmModel> {
        self.compare.iter().filter_map(|compared| match compared {
            Compared::Plain => None,
            Compared::Model(model) => Some(*model),
        })
    }
}

/// What a study is run once more with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Compared {
    /// Smooth surfaces, a rigid shell, an oil of constant viscosity and density.
    Plain,
    /// Another model of the film.
    Model(FilmModel),
}

/// A model of the film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilmModel {
    /// Reynolds equation on a grid.
    Field,
    /// Closed form of the short bearing (Ocvirk).
    ShortBearing,
    /// Booker's mobility of the short bearing.
    Mobility,
    /// Closed form of the infinitely long bearing (Sommerfeld).
    LongBearing,
    /// Solved on line in shapes across the width, without a grid.
    Online,
    /// Looked up in a database of wedge and squeeze solved together.
    Database,
    /// Looked up in a database of wedge and squeeze solved apart, their forces added.
    Superposition,
}

impl FilmModel {
    /// Every model.
    pub const ALL: [Self; 7] = [
        Self::Field,
        Self::ShortBearing,
        Self::Mobility,
        Self::LongBearing,
        Self::Online,
        Self::Database,
        Self::Superposition,
    ];

    /// The model of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|model| model.name() == name)
    }

    /// As in the study file.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Field => "field",
            Self::ShortBearing => "short-bearing",
            Self::Mobility => "mobility",
            Self::LongBearing => "long-bearing",
            Self::Online => "online",
            Self::Database => "database",
            Self::Superposition => "superposition",
        }
    }

    /// It answers to tilt, feeds and pressures other than 0.
    #[must_use]
    pub const fn is_field(self) -> bool {
        matches!(self, Self::Field)
    }

    /// It answers to tilt where the ruptured film is closed this way.
    #[must_use]
    pub const fn tilts(self, closure: Cavitation) -> bool {
        match self {
            Self::Field => true,
            Self::Online => matches!(closure, Cavitation::Gumbel),
            _ => false,
        }
    }

    /// It is looked up in a database.
    #[must_use]
    pub const fn is_looked_up(self) -> bool {
        matches!(self, Self::Database | Self::Superposition)
    }

    /// It takes a bearing with grooves and holes and does not use them: an estimate of closed form. The
    /// others that have none refuse them.
    #[must_use]
    pub const fn overlooks_feeds(self) -> bool {
        matches!(
            self,
            Self::ShortBearing | Self::Mobility | Self::LongBearing
        )
    }
}

/// How the Reynolds equation is solved on a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilmMethod {
    /// Cells and active sets.
    FiniteVolume,
    /// The paper's finite differences with point iteration; of dimensionless films alone.
    VogelpohlFdm,
}

impl FilmMethod {
    /// As in the study file.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::FiniteVolume => "finite-volume",
            Self::VogelpohlFdm => "vogelpohl-fdm",
        }
    }
}

/// Solver of the linear systems of the field model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinearSolver {
    /// The program chooses.
    Auto,
    /// Banded elimination.
    Banded,
}

/// A design limit as the user wrote it.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyLimit {
    /// Its key under `[limits]`, such as `minimum_film_thickness`.
    pub key: &'static str,
    /// The limit, SI.
    pub value: f64,
    /// Where the limit comes from, in the words of the user.
    pub source: String,
}

/// A hash of the inputs that is the same on every machine and in every release (FNV-1a, 128 bit;
/// constants from the IETF draft by Fowler, Noll, Vo and Eastlake). It tells inputs apart, it is no
/// seal against forgery.
pub(super) fn input_hash(parts: &[&[u8]]) -> String {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    let mut hash = OFFSET;
    let mut feed = |byte: u8| {
        hash ^= u128::from(byte);
        hash = hash.wrapping_mul(PRIME);
    };
    for part in parts {
        // The length keeps two parts from being taken for one.
        (part.len() as u64)
            .to_le_bytes()
            .into_iter()
            .for_each(&mut feed);
        part.iter().copied().for_each(&mut feed);
    }
    format!("{hash:032x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hash_of_known_text() {
        // Eight bytes of length 0, then nothing: differs from no part at all.
        assert_eq!(input_hash(&[]), "6c62272e07bb014262b821756295c58d");
        assert_ne!(input_hash(&[b"ab", b"c"]), input_hash(&[b"a", b"bc"]));
    }
}
