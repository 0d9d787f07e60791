//! A damper at the nose: a hub on the first disc, and a ring that a link drives.
//!
//! Viscous: the ring swims in silicone oil, the link damps and has no stiffness (Houdaille). Rubber:
//! the link is a spring with a loss factor. A damper with both is a link with all three values.

use super::{Disc, TorsionalChain, TorsionalLink};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A torsional vibration damper.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Damper {
    /// Moment of inertia of what is fixed to the shaft, added to the disc that carries it, kg m2.
    pub hub_inertia: f64,
    /// Moment of inertia of the ring, kg m2.
    pub ring_inertia: f64,
    /// What drives the ring.
    pub link: TorsionalLink,
}

impl Damper {
    /// A viscous damper with a hub without inertia: ring (kg m2), damping (N m s/rad).
    #[must_use]
    pub const fn viscous(ring_inertia: f64, damping: f64) -> Self {
        Self {
            hub_inertia: 0.0,
            ring_inertia,
            link: TorsionalLink {
                stiffness: 0.0,
                damping,
                loss_factor: 0.0,
            },
        }
    }

    /// A rubber damper with a hub without inertia: ring (kg m2), stiffness (N m/rad), loss factor.
    #[must_use]
    pub const fn rubber(ring_inertia: f64, stiffness: f64, loss_factor: f64) -> Self {
        Self {
            hub_inertia: 0.0,
            ring_inertia,
            link: TorsionalLink {
                stiffness,
                damping: 0.0,
                loss_factor,
            },
        }
    }

    /// Natural frequency of the ring on a hub that stands still, Hz; 0 for a viscous damper.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        (self.link.stiffness / self.ring_inertia).sqrt() / TAU
    }
}

impl TorsionalChain {
    /// The chain with a damper at its free end: the ring becomes the first disc, what was the first
    /// one carries the hub. Heat of the damper is that of link 1.
    #[must_use]
    pub fn with_damper(&self, damper: &Damper) -> Self {
        let ring = Disc {
            inertia: damper.ring_inertia,
            damping: 0.0,
            throw: None,
        };
        let mut chain = self.clone();
        if let Some(nose) = chain.discs.first_mut() {
            nose.inertia += damper.hub_inertia;
        }
        chain.discs.insert(0, ring);
        chain.links.insert(0, damper.link);
        chain
    }
}
