//! The lubricant film of one slide bearing at one instant.
//!
//! What it is ([`Bearing`]) and how it moves ([`JournalState`]) go in; the film's answer
//! ([`Reaction`]) and its exact tangents come out, through one trait: [`FilmForce`].
//!
//! # Frames and signs
//! The shell frame has its origin at the shell centre, Z along the bearing axis, right-handed.
//! `angle` runs from +X towards +Y, the sense of positive rotation. Loads, eccentricities and both
//! angular speeds are given in one frame fixed to the shell. LOAD is what the machine puts on the
//! journal; FORCE is what the film puts on the journal; at rest `load + force = 0`. Moments are
//! about the mid-plane centre of the shell, on the journal.

pub mod bearing;
pub mod cavitation;
pub mod closed_form;
pub mod contact;
mod contact_table;
pub mod dimensionless;
pub mod elastic;
pub mod energy;
mod feed_lines;
mod film_state;
pub mod finish;
pub mod flow_factors;
pub mod force;
pub mod frame;
pub mod friction;
pub mod gap;
pub mod grid;
mod heat;
mod height_integrals;
pub mod integrals;
pub mod journal_state;
pub mod leaning;
pub mod linear;
pub mod mirror;
pub mod narrowest;
pub mod nonlinear;
pub mod passage;
pub mod peak;
pub mod reduced_pressure;
pub mod reynolds;
pub mod richardson;
pub mod roughness;
mod settling;
pub mod shape;
mod shape_table;
pub mod solver;
pub mod spectral;
pub mod supply;
pub mod surfaces;
pub mod tilted_grid;
pub mod vogelpohl;
mod worn_heights;

pub use bearing::{
    Bearing, Carrier, Cavitation, Ends, Feed, FeedLine, FeedShape, FilmShear, Inlet,
};
pub use closed_form::{LongBearingFilm, MobilityFilm, ShortBearingFilm};
pub use contact::{ContactLaw, ContactTable, GreenwoodTripp};
pub use elastic::Elasticity;
pub use energy::{EnergyBalance, Surroundings};
pub use finish::{Finish, RoughFinish};
pub use flow_factors::FlowFactors;
pub use force::{
    Capabilities, Conditions, Extreme, FeedFlow, FilmError, FilmField, FilmForce, FilmHistory,
    FilmSummary, Linearised, Outcome, Reaction, Step, Tangent, Warmed, Warming,
};
pub use grid::Grid;
pub use journal_state::JournalState;
pub use roughness::{FinishError, OfGap, Roughness};
pub use shape::{Feature, ProfileTable, ReliefForm, Shape};
pub use solver::FilmSolver;
pub use spectral::OnlineFilm;
pub use worn_heights::WornHeights;
