//! One slide bearing over time: equilibrium under a load, the journal orbit over a load cycle,
//! stiffness and damping. Sees the film only through [`sommerfeld_film::FilmForce`].

mod balance;
pub mod coefficients;
mod cycle_table;
mod dense;
pub mod equilibrium;
pub mod expansion;
pub mod heat_balance;
pub mod heat_field;
pub mod load_cycle;
mod mixing;
pub mod motion;
pub mod orbit;
pub mod running_in;
pub mod stability;
pub mod stability_chart;
mod step_control;
mod supply_cycle;
mod time_step;
pub mod wear;

pub use balance::IterationRow;
pub use coefficients::{Coefficients, instant_coefficients};
pub use cycle_table::{CycleTable, HeldTilt};
pub use equilibrium::{Equilibrium, EquilibriumRequest, EquilibriumSettings, find_equilibrium};
pub use expansion::{Expansion, PressedShell, ShellFit};
pub use heat_balance::{FilmHeat, HeatBalanced, HeatPath, HeatTrial, JointBalance};
pub use heat_field::{HeatFieldSettings, WarmEquilibrium, warm_equilibrium};
pub use load_cycle::{
    CyclePoint, CycleTilt, JournalOrbit, LoadCycle, LoadPoint, PressureCycle, closing_edge,
};
pub use orbit::{
    CycleHeat, Observer, OrbitSettings, OrbitStart, Progress, WarmOrbit, journal_orbit, warm_orbit,
};
pub use running_in::{
    RanIn, RunningIn, RunningInEnd, RunningInStep, WornCycle, WornRoughness, run_in,
};
pub use stability::{Stability, WhirlThreshold, rotor_stability, whirl_threshold};
pub use stability_chart::{Onset, SpeedPoint, StabilityChart, stability_chart};
pub use step_control::Substeps;
pub use supply_cycle::SupplyCycle;
pub use wear::{CycleWear, WearMap, WearRecord};
