//! Films solved on line: shapes across the width, nodes of high order around.
//!
//! Pressure is so smooth across the width that a few polynomials carry it, and around the bearing in
//! Sommerfeld's angle. [`OnlineFilm`] is the model behind [`crate::FilmForce`].

#![allow(
    clippy::needless_range_loop,
    reason = "loops over lanes run through several arrays at once"
)]

mod across;
mod aligned_film;
mod answer;
mod around;
mod cut;
mod film;
mod fitted_film;
mod full_film;
mod half_film;
mod profile;
mod quadrature;

pub use aligned_film::{AlignedFilm, Precision};
pub use answer::{AlignedFigures, AlignedForce};
pub use film::OnlineFilm;
