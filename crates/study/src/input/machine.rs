//! A checked machine: an engine or a shaft with its bearings and speeds, in SI.

use super::heat::HeatPlan;
use super::wear::WearPlan;
use sommerfeld_bearing::PressureCycle;
use sommerfeld_engine::{
    CrankTrain, Drilling, Gas, GeneralShaft, HoleSupply, Mains, PinFit, Role, TorsionalChain,
};
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
    /// Temperature of the films, K; their first guess where heat is balanced.
    pub temperature: f64,
    /// Where the temperature of the films comes from.
    pub heat: HeatPlan,
    /// What wears, where it is asked for.
    pub wear: Option<WearPlan>,
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
    /// The bearing; the heads of drillings are not yet in the pressures of its feeds.
    pub bearing: Bearing,
    /// Supply pressures that change over the period.
    pub feed_pressures: Vec<PressureCycle>,
    /// Drillings in the crank that feed its holes.
    pub drillings: Vec<Drilling>,
}

impl MachinePlan {
    /// Angle of the shaft after which everything repeats, rad.
    #[must_use]
    pub fn period(&self) -> f64 {
        match &self.machine {
            Machine::Engine(engine) => engine.train.period(),
            Machine::Shaft(shaft) => shaft.period,
        }
    }

    /// A bearing as it is supplied at a speed of the shaft (rad/s): with the heads of its drillings, and
    /// the supply pressures that change over the period.
    #[must_use]
    pub fn supplied(&self, bearing: &MachineBearing, speed: f64) -> (Bearing, Vec<PressureCycle>) {
        let supply = self.heat.path().map(|path| path.supply_temperature);
        let temperature = supply.unwrap_or(self.temperature);
        let density = self.lubricant.density(temperature, 0.0).value;
        bearing.supplied(density, speed, self.period())
    }
}

impl MachineBearing {
    /// The bearing with its supply at a density (kg/m3) and speed (rad/s), over a period (rad).
    fn supplied(&self, density: f64, speed: f64, period: f64) -> (Bearing, Vec<PressureCycle>) {
        let mut bearing = self.bearing.clone();
        let mut cycles = self.feed_pressures.clone();
        for drilling in &self.drillings {
            let Some(feed) = bearing.feeds.get_mut(drilling.feed) else {
                continue;
            };
            match drilling.supply(density, speed, period) {
                Some(HoleSupply::Constant(pressure)) => feed.pressure = pressure,
                Some(HoleSupply::Cycle(cycle)) => {
                    feed.pressure = cycle.mean(period);
                    cycles.push(cycle);
                }
                None => {
                    let head = drilling.head(density, speed);
                    feed.pressure += head;
                    let own = cycles.iter_mut().find(|cycle| cycle.feed == drilling.feed);
                    for point in own.into_iter().flat_map(|cycle| &mut cycle.points) {
                        point[1] += head;
                    }
                }
            }
        }
        (bearing, cycles)
    }
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
