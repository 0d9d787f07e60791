//! What each bearing of a machine has to do.

use serde::{Deserialize, Serialize};
use sommerfeld_bearing::LoadCycle;

/// The place of a bearing in a machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Crankshaft in the block; shell frame is the engine frame.
    Main,
    /// Crankpin in the rod; shell frame is the rod frame.
    BigEnd,
    /// Piston pin in the rod; shell frame is the rod frame.
    SmallEnd,
    /// Piston pin in both bosses of the piston together; shell frame: x along the cylinder axis towards
    /// the head, y 90 deg further in the sense of rotation.
    PistonBoss,
    /// A general shaft in its housing.
    Shaft,
}

impl Role {
    /// As in the study file and in names of bearings.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Main => "main",
            Self::BigEnd => "big-end",
            Self::SmallEnd => "small-end",
            Self::PistonBoss => "piston-boss",
            Self::Shaft => "bearing",
        }
    }
}

/// The load cycle of one bearing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BearingDuty {
    /// Its place in the machine.
    pub role: Role,
    /// Its number among its kind, 0-based: main from the free end, else cylinder.
    pub index: usize,
    /// Load ON the journal, speeds of both surfaces.
    pub cycle: LoadCycle,
}
