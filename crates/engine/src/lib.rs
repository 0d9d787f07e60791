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

mod coupled;
mod crank_train;
mod drilling;
mod duty;
mod gas;
mod harmonics;
mod layout;
mod loads;
mod mains;
mod motion;
mod performance;
mod pin_speed;
mod shaft;
mod slider_crank;
mod torsion;

pub use coupled::{
    COUPLED_ERROR_TOLERANCE, CoupledJournal, CoupledObserver, CoupledOrbits, CoupledRequest,
    FilmExecutor, FilmUpdate, ShaftForces, coupled_orbits, coupled_orbits_from, in_sequence,
};
pub use crank_train::{CrankTrain, Rod, Unbalance};
pub use drilling::{
    Drilling, DrillingInlet, GrooveArc, HoleSupply, arm_in_rod_frame, mouth_radius,
};
pub use duty::{BearingDuty, Role};
pub use gas::{
    Chamber, Closure, Combustion, CombustionError, Convention, CycleScales, DiagramError, Gas,
    GasExchange, GasInstant, GeneratedCycle, HeatRatio, HeatRelease, IndicatorDiagram, PeakScaling,
    Seam, Sense, WallHeat, Wiebe, Woschni,
};
pub use harmonics::{delayed, harmonics};
pub use layout::{Cylinder, EngineLayout, LayoutError, LayoutKind, LayoutPlan, Strokes, Throw};
pub use loads::bearing_duties;
pub use mains::{determinate_main_loads, resultant, shaft_forces};
pub use motion::{CrankMotion, Harmonic, ThrowInstant, Twist};
pub use performance::{Performance, cycle_work, performance, throw_torques};
pub use pin_speed::{PinBalance, PinSpeed};
pub use shaft::{
    CrankshaftShape, GeneralShaft, Mains, PinFit, ShaftError, ShaftForce, ShaftLoad, ShaftSection,
    SupportReactions, Supports, ThrowStiffness, Web, condensed_crankshaft, condensed_shaft,
    fitted_web, support_reactions, throw_stiffness,
};
pub use slider_crank::{
    CylinderInstant, RodForces, SliderCrank, SliderCrankInstant, WorkingCylinder, inertia_force,
    rod_forces,
};
pub use torsion::{
    ChainMatrices, Damper, DamperOptimum, DamperTask, Disc, NaturalVibration, RippleSettings,
    SettledRipple, TorsionError, TorsionResponse, TorsionalChain, TorsionalLink, engine_ripple,
    settle_ripple,
};
