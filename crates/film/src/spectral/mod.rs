//! Films without cells, solved on line: shapes across the width, nodes of high order around.
//!
//! Pressure is so smooth across the width that a few polynomials carry it, and around the bearing in
//! Sommerfeld's angle. [`OnlineFilm`] is the model behind [`crate::FilmForce`], [`AlignedFilm`] the
//! same without units, also to the precision that tables need. Two closures:
//! - `gumbel`: the full film falls apart into one equation around for each shape; what is positive of it
//!   is integrated. Tilt couples the shapes: then elements of high degree around;
//! - `reynolds`: the film is mapped onto a rectangle between its two fronts, which are moved to where
//!   pressure ends smoothly.

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
mod tilted_film;
mod tilting;

pub use aligned_film::{AlignedFilm, Precision};
pub use answer::{AlignedFigures, AlignedForce};
pub use film::OnlineFilm;
