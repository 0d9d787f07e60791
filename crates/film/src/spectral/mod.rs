//! Films solved on line: shapes across the width, nodes of high order around.
//!
//! Pressure is so smooth across the width that a few polynomials carry it, and around the bearing in
//! Sommerfeld's angle. [`OnlineFilm`] is the model behind [`crate::FilmForce`].

#![allow(
    clippy::needless_range_loop,
    reason = "loops over lanes run through several arrays at once"
)]

mod across;
mod around;
mod cut;
mod film;
mod full_film;
mod half_film;
mod quadrature;

pub use film::OnlineFilm;
pub use half_film::{AlignedFigures, AlignedForce};
