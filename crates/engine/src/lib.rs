//! The crank train: from the indicator diagram, the dimensions and the masses of an engine to the
//! load cycle of every bearing.
//!
//! # Frames and signs
//! - **Engine frame**: x up along the bisector of the banks, z along the crankshaft to the flywheel, y
//!   completes the right-handed frame. The crankshaft turns positively about z, from x to y.
//! - **Crank angle**: 0 where cylinder 1 fires at its firing top dead centre, counted in the sense of
//!   rotation; the arm of throw `t` points to the crank angle plus [`Throw::angle`]. Dead centres of the
//!   layout are those of a crank without pin offset (arm along the cylinder axis); with one, piston and
//!   gas cycle of every cylinder reach theirs `asin(e/(r + l))` later.
//! - **Rod frame** (big end, small end): x from the big end to the small end, y 90 deg further in the
//!   sense of rotation.
//! - Loads are loads ON the journal (crankpin, piston pin, main journal), in the frame of the shell.
//! - Cylinders, throws and mains are numbered from the free end (pulley), 1 in names, 0 in indices.
//!
//! SI throughout; pressures of the gas are absolute.

mod chamber;
mod closed_cycle;
mod combustion;
mod combustion_error;
mod coupled;
mod crank_frame;
mod crank_station;
mod crank_train;
mod crankshaft;
mod cylinder;
mod diagram;
mod drilling;
mod duty;
mod gas_exchange;
mod harmonics;
mod heat_ratio;
mod heat_release;
mod kinematics;
mod layout;
mod layout_plan;
mod loads;
mod mains;
mod measured;
mod motion;
mod performance;
mod pin_speed;
mod rod_forces;
mod shaft;
mod shaft_error;
mod shaft_force;
mod shaft_frame;
mod smoothing;
mod supports;
mod throw_stiffness;
mod torsion;
mod wall_heat;

pub use chamber::Chamber;
pub use combustion::{Combustion, GeneratedCycle};
pub use combustion_error::CombustionError;
pub use coupled::{
    COUPLED_ERROR_TOLERANCE, CoupledJournal, CoupledObserver, CoupledOrbits, CoupledRequest,
    FilmExecutor, FilmUpdate, ShaftForces, coupled_orbits, in_sequence,
};
pub use crank_frame::condensed_crankshaft;
pub use crank_train::{CrankTrain, Rod, Unbalance};
pub use crankshaft::{CrankshaftShape, Mains, PinFit, Supports, Web};
pub use cylinder::{CylinderInstant, WorkingCylinder};
pub use diagram::{DiagramError, Gas, IndicatorDiagram, PeakScaling};
pub use drilling::{
    Drilling, DrillingInlet, GrooveArc, HoleSupply, arm_in_rod_frame, mouth_radius,
};
pub use duty::{BearingDuty, Role};
pub use gas_exchange::GasExchange;
pub use harmonics::{delayed, harmonics};
pub use heat_ratio::HeatRatio;
pub use heat_release::{HeatRelease, Wiebe};
pub use kinematics::{SliderCrank, SliderCrankInstant};
pub use layout::{Cylinder, EngineLayout, LayoutError, Strokes, Throw};
pub use layout_plan::{LayoutKind, LayoutPlan};
pub use loads::bearing_duties;
pub use mains::{determinate_main_loads, resultant, shaft_forces};
pub use measured::{Closure, Convention, Seam, Sense};
pub use motion::{CrankMotion, Harmonic, ThrowInstant, Twist};
pub use performance::{Performance, cycle_work, performance, throw_torques};
pub use pin_speed::{PinBalance, PinSpeed};
pub use rod_forces::{RodForces, inertia_force, rod_forces};
pub use shaft::{GeneralShaft, ShaftLoad, ShaftSection};
pub use shaft_error::ShaftError;
pub use shaft_force::ShaftForce;
pub use shaft_frame::condensed_shaft;
pub use supports::{SupportReactions, support_reactions};
pub use throw_stiffness::{ThrowStiffness, fitted_web, throw_stiffness};
pub use torsion::{
    ChainMatrices, Damper, DamperOptimum, DamperTask, Disc, NaturalVibration, RippleSettings,
    SettledRipple, TorsionError, TorsionResponse, TorsionalChain, TorsionalLink, engine_ripple,
    settle_ripple,
};
pub use wall_heat::{CycleScales, GasInstant, WallHeat, Woschni};
