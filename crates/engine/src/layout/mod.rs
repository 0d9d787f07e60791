//! Which cylinder works on which throw, and when it fires.

mod plan;

pub use plan::{LayoutKind, LayoutPlan};

use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Largest angle by which what a plan says twice may differ, rad: angles typed to 0.01 deg pass.
pub(crate) const ANGLE_TOLERANCE: f64 = 1e-3;

/// Cylinders, throws and main bearings of an engine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EngineLayout {
    /// Cylinders, numbered from the free end; those of bank A first in a V engine.
    pub cylinders: Vec<Cylinder>,
    /// Throws in ascending axial position; two rods may share one.
    pub throws: Vec<Throw>,
    /// Axial positions of the centres of the main bearings, m, ascending.
    pub mains: Vec<f64>,
    /// Strokes of a working cycle.
    pub strokes: Strokes,
}

/// One cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Cylinder {
    /// Index of its throw.
    pub throw: usize,
    /// Angle of the cylinder axis from x of the engine frame, rad, positive about z.
    pub bank_angle: f64,
    /// Crank angle of its firing top dead centre, rad, in one period; 0 for cylinder 1.
    pub firing_angle: f64,
    /// Axial position of the cylinder axis and of its rod, m.
    pub axial: f64,
}

/// One throw of the crankshaft.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Throw {
    /// Direction of its arm at crank angle 0, rad from x of the engine frame.
    pub angle: f64,
    /// Axial position of the centre of its pin, m.
    pub axial: f64,
}

/// Strokes of a working cycle.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strokes {
    /// One cycle in one turn.
    Two,
    /// One cycle in two turns.
    #[default]
    Four,
}

impl Strokes {
    /// Crank angle of one working cycle, rad.
    #[must_use]
    pub fn period(self) -> f64 {
        match self {
            Self::Two => TAU,
            Self::Four => 2.0 * TAU,
        }
    }
}

/// Why a plan is no engine.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// Nothing to build, or an odd number of cylinders in two banks.
    #[error("{kind} has {needed}, not {cylinders} cylinders")]
    Cylinders {
        /// What is built.
        kind: &'static str,
        /// What it needs.
        needed: &'static str,
        /// What is given.
        cylinders: usize,
    },
    /// A cylinder that fires never, twice, or does not exist.
    #[error("the firing order {order:?} {fault}: name each cylinder from 1 to {cylinders} once")]
    FiringOrder {
        /// As given.
        order: Vec<usize>,
        /// What is wrong, with the cylinder.
        fault: String,
        /// Cylinders of the engine.
        cylinders: usize,
    },
    /// As many intervals as cylinders are needed, each above 0, a period together.
    #[error("firing intervals: {fault}")]
    FiringIntervals {
        /// What is wrong, with the cylinder or the sum.
        fault: String,
    },
    /// Too few or too many throw angles.
    #[error("{given} throw angles for {throws} throws{hint}")]
    ThrowCount {
        /// As given.
        given: usize,
        /// As the layout has.
        throws: usize,
        /// What else would do.
        hint: &'static str,
    },
    /// A piston is not at top dead centre where its cylinder fires.
    #[error(
        "cylinder {cylinder} fires at {firing:.1} deg, but its piston is at top dead centre at {dead_centres}: \
         the firing order or the firing intervals do not fit {against}"
    )]
    NotAtTopDeadCentre {
        /// 1-based.
        cylinder: usize,
        /// Its firing angle, deg after that of cylinder 1.
        firing: f64,
        /// Where it could fire.
        dead_centres: String,
        /// What fixes the throw.
        against: String,
    },
    /// Throws of a pair of boxer cylinders that are not opposed.
    #[error(
        "cylinders {} and {} of a boxer are to have opposed throws, but theirs are {between:.1} deg apart: \
         let them fire a multiple of 360 deg apart, or describe the engine as a V of 180 deg",
        cylinders[0], cylinders[1]
    )]
    NotOpposed {
        /// 1-based.
        cylinders: [usize; 2],
        /// Angle between their throws, deg.
        between: f64,
    },
    /// A dimension or angle that no engine has.
    #[error("{what} is {value}: {needed}")]
    Dimension {
        /// Which.
        what: &'static str,
        /// As given, m or deg.
        value: f64,
        /// What it must be.
        needed: &'static str,
    },
    /// Mains that hold no shaft.
    #[error("main bearings: {fault}")]
    Mains {
        /// What is wrong, with the main and its position.
        fault: String,
    },
    /// A cylinder on a throw that is not there.
    #[error("cylinder {cylinder} works on throw {throw}, but there are {throws} throws")]
    NoSuchThrow {
        /// 1-based.
        cylinder: usize,
        /// 1-based.
        throw: usize,
        /// How many there are.
        throws: usize,
    },
}

impl EngineLayout {
    /// Whether the parts of a layout fit together: cylinders on throws that exist, pistons at top dead
    /// centre where they fire, mains in order.
    ///
    /// # Errors
    /// The first thing that does not fit.
    pub fn check(&self) -> Result<(), LayoutError> {
        if self.cylinders.is_empty() {
            return Err(LayoutError::Cylinders {
                kind: "an engine",
                needed: "one cylinder at least",
                cylinders: 0,
            });
        }
        let throws = self.throws.len();
        let lost = |cylinder: &Cylinder| cylinder.throw >= throws;
        if let Some(index) = self.cylinders.iter().position(lost) {
            return Err(LayoutError::NoSuchThrow {
                cylinder: index + 1,
                throw: self.cylinders[index].throw + 1,
                throws,
            });
        }
        check_dead_centres(
            &self.cylinders,
            &self.throws,
            self.strokes,
            "the throws".to_owned(),
        )?;
        self.check_mains()
    }

    fn check_mains(&self) -> Result<(), LayoutError> {
        let refuse = |fault: String| Err(LayoutError::Mains { fault });
        let mains = &self.mains;
        if mains.len() < 2 {
            return refuse(format!("{} given, a crankshaft needs two", mains.len()));
        }
        if let Some(index) = mains.iter().position(|z| !z.is_finite()) {
            return refuse(format!("the position of main {} is no number", index + 1));
        }
        if let Some(index) = mains.windows(2).position(|pair| pair[0] >= pair[1]) {
            return refuse(format!(
                "main {} at {:.1} mm does not follow main {} at {:.1} mm; count from the free end",
                index + 2,
                mains[index + 1] * 1e3,
                index + 1,
                mains[index] * 1e3
            ));
        }
        /// Closest that the centres of a pin and of a main can lie, m: they are not the same journal.
        const SAME_PLACE: f64 = 1e-6;
        for (index, throw) in self.throws.iter().enumerate() {
            let stands_there = |main: &f64| (main - throw.axial).abs() < SAME_PLACE;
            if let Some(main) = mains.iter().position(stands_there) {
                return refuse(format!(
                    "main {} stands at throw {}, {:.1} mm",
                    main + 1,
                    index + 1,
                    throw.axial * 1e3
                ));
            }
        }
        Ok(())
    }
}

pub(crate) fn check_dead_centres(
    cylinders: &[Cylinder],
    throws: &[Throw],
    strokes: Strokes,
    against: String,
) -> Result<(), LayoutError> {
    for (index, cylinder) in cylinders.iter().enumerate() {
        let off = overshoot(cylinder, &throws[cylinder.throw]);
        // not a number is refused too
        let fits = off.abs() <= ANGLE_TOLERANCE;
        if fits {
            continue;
        }
        let first = (cylinder.firing_angle + off).rem_euclid(TAU).to_degrees();
        return Err(LayoutError::NotAtTopDeadCentre {
            cylinder: index + 1,
            firing: cylinder.firing_angle.to_degrees(),
            dead_centres: match strokes {
                Strokes::Two => format!("{first:.1} deg"),
                Strokes::Four => format!("{first:.1} and {:.1} deg", first + 360.0),
            },
            against,
        });
    }
    Ok(())
}

/// Crank angle from a cylinder's firing to the nearest top dead centre of its piston, rad.
pub(crate) fn overshoot(cylinder: &Cylinder, throw: &Throw) -> f64 {
    wrap(cylinder.bank_angle - throw.angle - cylinder.firing_angle)
}

/// The angle in -pi to pi that is equal but for full turns.
pub(crate) fn wrap(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
