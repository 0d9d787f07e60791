//! The elastic crankshaft of an inline six in its seven main bearings, with the forces of its pistons:
//! what a test and a bench run. Main bearings, webs and supports are assumed, of the size usual for
//! 105 mm bore.

use crate::common;
use sommerfeld_bearing::{CycleTilt, LoadCycle, LoadPoint, OrbitSettings};
use sommerfeld_engine::{
    CoupledJournal, CoupledOrbits, CoupledRequest, CrankMotion, CrankTrain, CrankshaftShape,
    FilmExecutor, IndicatorDiagram, Supports, Web, condensed_crankshaft, coupled_orbits,
    shaft_forces,
};
use sommerfeld_film::{
    Bearing, Cavitation, Conditions, Ends, Feed, FilmForce, FilmShear, FilmSolver, Inlet, Shape,
    ShortBearingFilm,
};
use sommerfeld_flex::CondensedShaft;
use sommerfeld_oil::Lubricant;
use std::ops::ControlFlow;

/// Pa s.
const VISCOSITY: f64 = 0.010;

/// What stands for the film of a main.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MainFilm {
    /// Closed form without tilt.
    Short,
    /// On the grid, with tilt.
    Grid,
}

/// Engine, crankshaft and bearing.
pub struct ElasticSix {
    pub train: CrankTrain,
    pub diagram: IndicatorDiagram,
    pub motion: CrankMotion,
    pub shaft: CondensedShaft,
    pub bearing: Bearing,
    pub supports: Supports,
    /// Cells around and along each film.
    pub grid: [usize; 2],
}

impl ElasticSix {
    /// Webs of this thickness (m), supports of usual stiffness, films of this closure.
    pub fn new(web_thickness: f64, cavitation: Cavitation, feeds: Vec<Feed>) -> Self {
        let train = common::general(common::inline(&[1, 5, 3, 6, 2, 4]));
        Self::of(train, web_thickness, cavitation, feeds)
    }

    /// The same with one cylinder, thick webs and a coarse grid.
    pub fn single() -> Self {
        Self::single_with(0.032, Cavitation::Reynolds, Vec::new())
    }

    /// One cylinder, webs of this thickness (m), films of this closure, a coarse grid.
    pub fn single_with(web_thickness: f64, cavitation: Cavitation, feeds: Vec<Feed>) -> Self {
        let mut train = common::general(common::inline(&[1]));
        train.unbalances.truncate(1);
        Self {
            grid: [32, 8],
            ..Self::of(train, web_thickness, cavitation, feeds)
        }
    }

    fn of(train: CrankTrain, web_thickness: f64, cavitation: Cavitation, feeds: Vec<Feed>) -> Self {
        let journal_length = 0.5 * (0.13 - 2.0 * web_thickness);
        let shape = CrankshaftShape {
            youngs_modulus: 210e9,
            poissons_ratio: 0.3,
            main_diameter: 0.085,
            main_length: journal_length,
            pin_diameter: 0.072,
            pin_length: journal_length,
            bore_diameter: 0.0,
            web: Web::Bar {
                thickness: web_thickness,
                width: 0.13,
            },
        };
        let rods = train.layout.cylinders.iter().map(|on| on.axial);
        let turning = train.unbalances.iter().map(|on| on.axial);
        let places: Vec<f64> = rods.chain(turning).collect();
        Self {
            shaft: condensed_crankshaft(&train, &shape, &places).unwrap(),
            train,
            diagram: common::diagram(),
            motion: CrankMotion::even(common::SPEED),
            bearing: Bearing {
                diameter: 0.085,
                width: 0.032,
                radial_clearance: 40e-6,
                bore: Shape::cylindrical(),
                journal: Shape::cylindrical(),
                feeds,
                ambient_pressure: 0.0,
                cavitation_pressure: 0.0,
                ends: Ends::Air,
                inlet: Inlet::Cyclic,
                cavitation,
                film_shear: FilmShear::FullWidth,
                finish: sommerfeld_film::Finish::Smooth,
                elasticity: sommerfeld_film::Elasticity::Rigid,
            },
            supports: Supports::Each {
                stiffness: [[5e8, 0.0], [0.0, 3e8]],
                tilt_stiffness: Some([[1e5, 0.0], [0.0, 1e5]]),
            },
            grid: [64, 16],
        }
    }

    /// Forces on the crankshaft and their axial positions at a crank angle.
    pub fn forces(&self, crank_angle: f64) -> Vec<sommerfeld_engine::ShaftForce> {
        shaft_forces(&self.train, &self.diagram, &self.motion, crank_angle)
    }

    /// The orbits of all mains on films with tilt.
    pub fn run(&self, settings: &OrbitSettings, executor: &FilmExecutor<'_>) -> CoupledOrbits {
        self.run_on(MainFilm::Grid, settings, executor)
    }

    fn film(&self, kind: MainFilm, oil: &Lubricant) -> Box<dyn FilmForce + Send> {
        match kind {
            MainFilm::Short => Box::new(ShortBearingFilm::new(&self.bearing, VISCOSITY).unwrap()),
            MainFilm::Grid => Box::new(FilmSolver::new(&self.bearing, oil, self.grid).unwrap()),
        }
    }

    /// The orbits of all mains.
    pub fn run_on(
        &self,
        film: MainFilm,
        settings: &OrbitSettings,
        executor: &FilmExecutor<'_>,
    ) -> CoupledOrbits {
        let oil = Lubricant::constant(VISCOSITY, 850.0);
        let count = self.train.layout.mains.len();
        let mut films: Vec<_> = (0..count).map(|_| self.film(film, &oil)).collect();
        let duty = LoadCycle {
            points: vec![LoadPoint {
                crank_angle: 0.0,
                load: [0.0; 2],
                moment: [0.0; 2],
                journal_speed: self.motion.speed,
                shell_speed: 0.0,
            }],
            period: self.train.period(),
            engine_speed: self.motion.speed,
            journal_mass: 0.0,
            tilt: CycleTilt::Free,
            feed_pressures: Vec::new(),
        };
        let compliance = match &self.supports {
            Supports::Rigid => None,
            yielding => Some(yielding.compliance(count).unwrap()),
        };
        let forces = |angle| self.forces(angle).iter().map(|one| one.force).collect();
        let journals = films.iter_mut().map(|film| CoupledJournal {
            film: film.as_mut(),
            bearing: &self.bearing,
            duty: &duty,
            conditions: Conditions {
                temperature: 373.15,
                feed_pressures: None,
            },
            offset: [0.0; 2],
        });
        let request = CoupledRequest {
            shaft: &self.shaft,
            compliance: compliance.as_ref(),
            forces: &forces,
            settings,
            executor,
        };
        coupled_orbits(journals.collect(), &request, &mut |_, _, _, _| {
            ControlFlow::Continue(())
        })
        .unwrap()
    }
}
