//! Films of slide bearings solved before, stored with their error, and looked up.
//!
//! A database is one HDF5 file ([`contents`]) that holds what a film answers at the nodes of its axes
//! ([`axis`]), everything it was built from, and how far it errs. Between the nodes runs a smooth curve
//! or surface ([`spline`]).

pub mod aligned_film;
pub mod axis;
pub mod check;
pub mod contents;
pub mod direction;
pub mod error;
pub mod generate;
pub mod node_film;
pub mod recipe;
pub mod spline;
pub mod superposition;
mod surface;
pub mod table;
pub mod table_film;

pub use check::{CheckReport, check};
pub use error::DatabaseError;
pub use generate::{Progress, generate};
pub use recipe::Recipe;
pub use table::Table;
pub use table_film::TableFilm;
