//! What the tests of this crate share.
#![allow(dead_code, clippy::unwrap_used)]

use sommerfeld_bearing::{CycleTilt, LoadCycle, LoadPoint};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Conditions, ContactLaw, Ends, Feed, FeedLine, FeedShape,
    FilmShear, Finish, GreenwoodTripp, Inlet, RoughFinish, Roughness, Shape,
};
use std::f64::consts::PI;

pub const CONDITIONS: Conditions<'static> = Conditions {
    temperature: 373.0,
    feed_pressures: None,
};

/// Plain bearing without feeds, ends and ruptured film at ambient pressure.
pub fn plain_bearing(diameter: f64, width: f64, radial_clearance: f64) -> Bearing {
    Bearing {
        diameter,
        width,
        radial_clearance,
        bore: Shape::cylindrical(),
        journal: Shape::cylindrical(),
        feeds: Vec::new(),
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Air,
        inlet: Inlet::Cyclic,
        cavitation: Cavitation::Gumbel,
        film_shear: FilmShear::FullWidth,
        finish: Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
    }
}

/// Numbers of a committed table: comments and the header left out.
pub fn table(path: &str) -> Vec<Vec<f64>> {
    let path = format!("{}/../../validation/{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path)
        .unwrap()
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| {
            line.split(',')
                .map(|cell| cell.trim().parse().unwrap())
                .collect()
        })
        .collect()
}

/// Cells of a committed table: comments and the header left out.
pub fn text_table(path: &str) -> Vec<Vec<String>> {
    let path = format!("{}/../../validation/{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path)
        .unwrap()
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.trim().to_owned()).collect())
        .collect()
}

/// Bearing of a diesel big end, fed by a hole of 6 mm in the journal.
pub fn diesel_big_end(cavitation: Cavitation) -> Bearing {
    let mut bearing = plain_bearing(0.072, 0.030, 36e-6);
    bearing.cavitation = cavitation;
    if cavitation == Cavitation::MassConserving {
        bearing.film_shear = FilmShear::FilmFraction;
    }
    bearing.feeds.push(Feed {
        shape: FeedShape::Hole { diameter: 6e-3 },
        carried_by: Carrier::Journal,
        angle: 0.5 * PI,
        position: 0.0,
        pressure: 5e5,
        line: FeedLine::Direct,
    });
    bearing
}

/// Its loads.
pub fn diesel_cycle() -> LoadCycle {
    let points: Vec<LoadPoint> = table("../examples/02-big-end-diesel/loads.csv")
        .iter()
        .map(|row| LoadPoint {
            crank_angle: row[0].to_radians(),
            load: [row[1], row[2]],
            moment: [0.0; 2],
            journal_speed: row[3],
            shell_speed: 0.0,
        })
        .collect();
    LoadCycle {
        points,
        period: 4.0 * PI,
        engine_speed: 2000.0 * PI / 30.0,
        journal_mass: 0.0,
        tilt: CycleTilt::Aligned,
        feed_pressures: Vec::new(),
    }
}

/// Contact of Greenwood and Tripp with the asperities of a measured rig and a factor (1e-3 there).
pub fn greenwood_tripp(factor: f64) -> ContactLaw {
    ContactLaw::GreenwoodTripp(GreenwoodTripp {
        factor,
        asperity_product: 0.05,
        modulus: 53.3e9,
        summit_height: 0.0,
        summit_roughness: None,
    })
}

/// Surfaces of that rig, as rough as its summits. The Peklenik number of its shell, 12, is beyond what the factors were fitted
/// to: 9 is the end.
pub fn rig_finish(contact: ContactLaw) -> Finish {
    Finish::Rough(RoughFinish {
        roughness: Roughness {
            journal: 0.13e-6,
            shell: 0.28e-6,
            peklenik_journal: 4.0,
            peklenik_shell: 9.0,
        },
        contact,
        boundary_friction: 0.02,
    })
}
