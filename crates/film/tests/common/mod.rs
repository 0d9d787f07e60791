//! Bearings that the tests share.
#![allow(dead_code)]

use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Conditions, Ends, Feed, FeedShape, FilmShear, Inlet,
};
use sommerfeld_oil::Lubricant;

/// The plain big end of the reference data: D 72, B 30 mm, radial clearance 36 um.
pub fn big_end() -> Bearing {
    Bearing {
        diameter: 0.072,
        width: 0.030,
        radial_clearance: 36e-6,
        feeds: Vec::new(),
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Air,
        inlet: Inlet::Cyclic,
        cavitation: Cavitation::MassConserving,
        film_shear: FilmShear::FilmFraction,
    }
}

/// A hole of 6 mm in the journal at 5 bar.
pub fn feed_hole() -> Feed {
    Feed {
        shape: FeedShape::Hole { diameter: 6e-3 },
        carried_by: Carrier::Journal,
        angle: std::f64::consts::FRAC_PI_2,
        position: 0.0,
        pressure: 5e5,
    }
}

/// 8 mPa s, 850 kg/m3.
pub fn oil() -> Lubricant {
    Lubricant::constant(8e-3, 850.0)
}

/// 100 degC, feeds at their own pressure.
pub fn conditions() -> Conditions<'static> {
    Conditions {
        temperature: 373.15,
        feed_pressures: None,
    }
}
