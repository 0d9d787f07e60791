//! Films of slide bearings solved before, stored with their error, and looked up.
//!
//! A database is one HDF5 file ([`contents`]) that holds what a film answers at the nodes of its axes
//! ([`axis`]), everything it was built from, and how far it errs. Between the nodes runs a smooth curve
//! or surface ([`spline`]).

pub mod axis;
pub mod contents;
pub mod direction;
pub mod error;
pub mod spline;
pub mod superposition;

pub use error::DatabaseError;
