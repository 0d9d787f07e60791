//! One slide bearing over time: equilibrium under a load, the journal orbit over a load cycle,
//! stiffness and damping. Sees the film only through [`sommerfeld_film::FilmForce`].

pub mod load_cycle;

pub use load_cycle::{CyclePoint, JournalOrbit, LoadCycle, LoadPoint};
