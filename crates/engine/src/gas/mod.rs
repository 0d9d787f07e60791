//! The gas over a piston: its pressure over the working cycle, measured or generated.
//!
//! Crank angles count from the piston's firing top dead centre, pressures are absolute.

mod chamber;
mod closed_cycle;
mod combustion;
mod diagram;
mod error;
mod exchange;
mod heat_ratio;
mod heat_release;
mod measured;
mod smoothing;
mod wall_heat;

pub use chamber::Chamber;
pub use combustion::{Combustion, GeneratedCycle};
pub use diagram::{DiagramError, Gas, IndicatorDiagram, PeakScaling};
pub use error::CombustionError;
pub use exchange::GasExchange;
pub use heat_ratio::HeatRatio;
pub use heat_release::{HeatRelease, Wiebe};
pub use measured::{Closure, Convention, Seam, Sense};
pub use wall_heat::{CycleScales, GasInstant, WallHeat, Woschni};
