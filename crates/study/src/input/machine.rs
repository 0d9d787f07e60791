//! A checked machine: an engine or a shaft with its bearings and speeds, in SI.

use sommerfeld_engine::{CrankTrain, Gas, GeneralShaft, Mains, PinFit, Role, TorsionalChain};
use sommerfeld_film::Bearing;
use sommerfeld_oil::Lubricant;

/// A machine with several bearings.
#[derive(Debug, Clone, PartialEq)]
pub struct MachinePlan {
    /// What it is.
    pub machine: Machine,
    /// Its bearings: mains (or the bearings of a shaft) from the free end, big ends, small ends and
    /// piston bosses by cylinder.
    pub bearings: Vec<MachineBearing>,
    /// The oil of all bearings.
    pub lubricant: Lubricant,
    /// Temperature of the films, K.
    pub temperature: f64,
    /// Speeds of the crankshaft or shaft, rad/s, in the order of the file.
    pub speeds: Vec<f64>,
    /// How the orbits are computed.
    pub orbit: OrbitPlan,
}

/// What a machine is.
#[derive(Debug, Clone, PartialEq)]
pub enum Machine {
    /// A piston engine.
    Engine(Box<EnginePlan>),
    /// A shaft with given loads.
    Shaft(Box<GeneralShaft>),
}

/// A piston engine.
#[derive(Debug, Clone, PartialEq)]
pub struct EnginePlan {
    /// Layout, dimensions, masses.
    pub train: CrankTrain,
    /// Gas over the speeds.
    pub gas: Gas,
    /// How the loads of the mains are found.
    pub mains: Mains,
    /// How the piston pin is held.
    pub pin_fit: PinFit,
    /// The torsional chain, if its vibration is followed.
    pub torsion: Option<TorsionalChain>,
}

/// One bearing of a machine.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineBearing {
    /// Its name in results, such as `main-1` or `big-end-3`: unique, safe in file names.
    pub name: String,
    /// Its place.
    pub role: Role,
    /// Its number among its kind, 0-based.
    pub index: usize,
    /// The bearing.
    pub bearing: Bearing,
}

/// How the orbits of a machine are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitPlan {
    /// Crank angle between two rows of the results, rad; divides the period.
    pub crank_step: f64,
    /// Cycles after which an orbit that has not closed is given up.
    pub maximum_cycles: usize,
    /// An orbit is closed when two cycles differ by less, over the radial clearance.
    pub closure_tolerance: f64,
}
