//! Film models and integrals with a closed form: infinitely long and short bearings.
//!
//! The plain functions ([`infinitely_long`], [`short`]) are the classical scaled results that the
//! field solver is tested against. The film models ([`ShortBearingFilm`], [`MobilityFilm`],
//! [`LongBearingFilm`]) answer any motion of an aligned journal through [`crate::FilmForce`] in
//! microseconds: estimates for design, start values and tests of everything above the film.

mod arc;
pub mod infinitely_long;
mod long_bearing_film;
mod mobility_film;
mod plain_film;
pub mod short;
mod short_bearing_film;

pub use long_bearing_film::LongBearingFilm;
pub use mobility_film::MobilityFilm;
pub use plain_film::PlainFilm;
pub use short_bearing_film::ShortBearingFilm;
