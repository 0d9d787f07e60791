//! Shafts, bearings and films that the tests share.

use sommerfeld_bearing::{CycleTilt, LoadCycle, LoadPoint, OrbitSettings};
use sommerfeld_engine::{
    CoupledJournal, CoupledOrbits, CoupledRequest, ShaftForces, coupled_orbits, in_sequence,
};
use sommerfeld_film::{
    Bearing, Capabilities, Cavitation, Conditions, Ends, FilmError, FilmForce, FilmShear,
    FilmSummary, Inlet, JournalState, Linearised, Outcome, Shape, Step,
};
use sommerfeld_flex::{CondensedShaft, Frame, Material, Section};
use std::ops::ControlFlow;

pub const CONDITIONS: Conditions<'static> = Conditions {
    temperature: 373.0,
    feed_pressures: None,
};

pub const STEEL: Material = Material {
    youngs_modulus: 210e9,
    poissons_ratio: 0.3,
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
        finish: sommerfeld_film::Finish::Smooth,
        elasticity: sommerfeld_film::Elasticity::Rigid,
    }
}

/// A straight shaft along z: nodes at the given positions (m), of which some are journals and some
/// places of load. Shear is left out, so that beams are those of Euler and Bernoulli.
pub fn straight_shaft(
    diameter: f64,
    positions: &[f64],
    journals: &[usize],
    loads: &[usize],
) -> CondensedShaft {
    let mut frame = Frame::new();
    for z in positions {
        frame.add_node([0.0, 0.0, *z]);
    }
    let section = Section::circle(&STEEL, diameter, 0.0).without_shear();
    for from in 1..positions.len() {
        frame
            .add_beam([from - 1, from], section, [1.0, 0.0, 0.0])
            .unwrap();
    }
    frame.hold(positions.len() - 1, 2).unwrap();
    frame.hold(positions.len() - 1, 5).unwrap();
    CondensedShaft::from_frame(&frame, journals, loads).unwrap()
}

/// EI of [`straight_shaft`], N m2.
pub fn bending_stiffness(diameter: f64) -> f64 {
    STEEL.youngs_modulus * std::f64::consts::PI * diameter.powi(4) / 64.0
}

/// Two bearings at the ends of a shaft, loaded in the middle.
pub fn two_bearing_shaft(diameter: f64) -> CondensedShaft {
    straight_shaft(diameter, &[0.0, 0.1, 0.2], &[0, 2], &[1])
}

/// What a journal does: steady speed in a shell at rest.
pub fn duty(speed: f64, engine_speed: f64, period: f64) -> LoadCycle {
    LoadCycle {
        points: vec![LoadPoint {
            crank_angle: 0.0,
            load: [0.0; 2],
            moment: [0.0; 2],
            journal_speed: speed,
            shell_speed: 0.0,
        }],
        period,
        engine_speed,
        journal_mass: 0.0,
        tilt: CycleTilt::Aligned,
        feed_pressures: Vec::new(),
    }
}

/// A spring in place of a film: no tilt stiffness, no damping.
#[derive(Debug, Clone)]
pub struct Spring {
    /// N/m.
    pub stiffness: f64,
}

impl FilmForce for Spring {
    fn capabilities(&self) -> Capabilities {
        Capabilities {
            accepts_tilt: false,
            has_history: false,
            conserves_mass: false,
            iteration_limit: 1,
        }
    }

    fn minimum_gap(&self, state: &JournalState) -> f64 {
        1e-3 - state.eccentricity()
    }

    fn linearise(
        &mut self,
        state: &JournalState,
        _step: Step,
        _conditions: &Conditions<'_>,
    ) -> Result<Linearised, FilmError> {
        let mut answer = Linearised::without_film(Outcome::Converged);
        for axis in 0..2 {
            answer.reaction.film_force[axis] = -self.stiffness * state.position[axis];
            answer.tangent.by_position[axis][axis] = -self.stiffness;
        }
        Ok(answer)
    }

    fn summary(&self) -> FilmSummary {
        FilmSummary::default()
    }
}

/// Runs films of one bearing and one duty on a shaft with rigid supports and bores in line.
pub fn run<F: FilmForce + Send>(
    films: &mut [F],
    bearing: &Bearing,
    duty: &LoadCycle,
    shaft: &CondensedShaft,
    forces: &ShaftForces<'_>,
    settings: &OrbitSettings,
) -> CoupledOrbits {
    let offsets = vec![[0.0; 2]; films.len()];
    run_with_offsets(films, bearing, duty, shaft, forces, settings, &offsets)
}

/// The same with offsets of the bores.
pub fn run_with_offsets<F: FilmForce + Send>(
    films: &mut [F],
    bearing: &Bearing,
    duty: &LoadCycle,
    shaft: &CondensedShaft,
    forces: &ShaftForces<'_>,
    settings: &OrbitSettings,
    offsets: &[[f64; 2]],
) -> CoupledOrbits {
    let journals = films
        .iter_mut()
        .zip(offsets)
        .map(|(film, offset)| CoupledJournal {
            film,
            bearing,
            duty,
            conditions: CONDITIONS,
            offset: *offset,
        })
        .collect();
    let request = CoupledRequest {
        shaft,
        compliance: None,
        forces,
        settings,
        executor: &in_sequence,
    };
    coupled_orbits(journals, &request, &mut |_, _, _, _| {
        ControlFlow::Continue(())
    })
    .unwrap()
}
