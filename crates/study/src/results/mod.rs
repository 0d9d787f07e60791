//! What one run produced: plain owned data, SI, that every output format reads.

mod comparison;
pub mod database;
pub mod machine;

pub use comparison::{Comparison, ModelEnd, ModelRun, PlainRun};

use crate::cases::SweepResults;
use crate::film_tables::DatabaseFacts;
use crate::limits::{Limit, LimitCheck, Quantity, Side};
use crate::models::Model;
use database::DatabaseResults;
use machine::{BearingResults, MachineResults};
use serde::{Deserialize, Serialize};
use sommerfeld_bearing::{
    Coefficients, CyclePoint, JournalOrbit, RanIn, Stability, StabilityChart, WearMap,
};
use sommerfeld_film::{
    Bearing, Extreme, FeedFlow, FilmField, FilmSummary, Finish, JournalState, Outcome, Reaction,
};
use std::collections::BTreeMap;

/// Version of the layout of study files and results.
pub const SCHEMA: u32 = 1;
/// Name of the program in results.
pub const PROGRAM: &str = "sommerfeld";
/// Version of the program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What one run produced.
#[derive(Debug, Clone, PartialEq)]
pub struct Results {
    /// What was run, with what, and how it ended.
    pub header: Header,
    /// The numbers.
    pub body: Body,
}

/// What was run, with what, and how it ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// Name of the analysis as in the study file, for example `load-cycle`.
    pub analysis: String,
    /// Title of the study; may be empty.
    pub title: String,
    /// How the run ended.
    pub status: Outcome,
    /// What the reader must know: warnings, and why a run did not converge.
    pub messages: Vec<String>,
    /// The physical models of the run.
    pub models: Vec<Model>,
    /// Wall time of the run, s.
    pub wall_time: f64,
    /// The input of the study, for the reader of a report.
    pub inputs: Vec<InputRow>,
    /// The study file as it was read.
    pub study_text: String,
    /// Hash of the study and the files it names, if one was taken.
    pub study_hash: Option<String>,
    /// Absolute discretisation error by key of `summary.json` (`integrals.p_cos` for nested keys,
    /// `force_n.0` for components), in the unit of that key, where an error target or a check on a second grid was asked for.
    pub error: Option<BTreeMap<String, f64>>,
    /// Cells around and along the axis of the grid that the results are from; `None` for closed forms.
    pub grid: Option<[usize; 2]>,
    /// Limits of the study, held against the results by [`Results::check_limits`].
    pub limits: Vec<LimitCheck>,
    /// The temperature that the heat of the film led to, where it was not given.
    pub heat: Option<HeatResults>,
    /// The same study with plain surfaces and oil, where the study asks for it.
    pub plain: Option<Box<PlainRun>>,
    /// The databases that its films were looked up in.
    pub databases: Vec<DatabaseFacts>,
    /// The same study with other film models, where the study asks for them.
    pub comparison: Option<Box<Comparison>>,
}

/// The balance of the heat that a film makes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeatResults {
    /// Temperature at which the film was calculated, K.
    pub effective_temperature: f64,
    /// Temperature of the oil that is supplied, K.
    pub supply_temperature: f64,
    /// Temperature of the oil that leaves, K.
    pub outlet_temperature: f64,
    /// Heat that is conducted away, W.
    pub conducted: f64,
    /// Radial clearance at the effective temperature, m.
    pub radial_clearance: f64,
    /// Radial clearance as the study gives it, m.
    pub given_radial_clearance: f64,
    /// Temperatures at which the bearing was calculated on the way, K.
    pub trials: Vec<f64>,
    /// More of a film whose temperature is a field; its mean over the film is then the effective one.
    pub field: Option<HeatFieldResults>,
}

/// Temperatures of a film that has one at every place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeatFieldResults {
    /// Highest temperature, K.
    pub hottest: f64,
    /// Heat made in the film, W.
    pub generated: f64,
    /// Heat that the oil takes out at the ends, W.
    pub carried_out: f64,
    /// What the energy balance of all cells misses, over its largest part.
    pub balance_error: f64,
    /// Largest change of a temperature in each round, K.
    pub changes: Vec<f64>,
}

/// One line of a study's input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputRow {
    /// Dotted key in the study file, for example `bearing.diameter`.
    pub key: String,
    /// Value with its unit, as the user wrote it.
    pub value: String,
}

/// The numbers of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum Body {
    /// One state of the journal: `film`, `equilibrium`, `coefficients`.
    Steady(Box<SteadyResults>),
    /// A journal orbit over a periodic load.
    LoadCycle(Box<CycleResults>),
    /// The dimensionless problem.
    Dimensionless(DimensionlessResults),
    /// Every bearing of an engine or shaft.
    Machine(Box<MachineResults>),
    /// A database of films.
    Database(Box<DatabaseResults>),
    /// The cases of a sweep.
    Sweep(Box<SweepResults>),
}

/// One state of the journal.
#[derive(Debug, Clone, PartialEq)]
pub struct SteadyResults {
    /// The bearing.
    pub bearing: Bearing,
    /// Position and motion of the journal.
    pub state: JournalState,
    /// Load on the journal, N; `None` where the position was given and no load.
    pub load: Option<[f64; 2]>,
    /// What the film puts on the journal.
    pub reaction: Reaction,
    /// Extremes, flows, power.
    pub summary: FilmSummary,
    /// Flow through each feed, in the order of the bearing's feeds.
    pub feed_flows: Vec<FeedFlow>,
    /// Sommerfeld number So = F psi^2/(B D eta omega); not finite where nothing turns.
    pub sommerfeld_number: f64,
    /// Film updates until converged.
    pub iterations: usize,
    /// -dF/d(position), shell frame, rows force x, y, columns x, y, N/m.
    pub stiffness: Option<[[f64; 2]; 2]>,
    /// -dF/d(velocity), shell frame, rows force x, y, columns x, y, N s/m.
    pub damping: Option<[[f64; 2]; 2]>,
    /// Coefficients with tilt and the stability of a rotor, where they were asked for.
    pub dynamics: Option<Box<Dynamics>>,
    /// The fields, if the film model has any.
    pub field: Option<FieldSnapshot>,
}

/// The film as a spring and damper of a rotor.
#[derive(Debug, Clone, PartialEq)]
pub struct Dynamics {
    /// Stiffness and damping, shell frame.
    pub coefficients: Coefficients,
    /// The film answers to tilt: the coefficients have rows and columns of tilt, too.
    pub has_tilt: bool,
    /// For which masses a rigid rotor is stable.
    pub stability: Stability,
    /// Mass of the rotor that the bearing carries, kg, if given.
    pub rotor_mass: Option<f64>,
    /// Stability over speed, if asked for.
    pub chart: Option<StabilityChart>,
}

/// Stiffness and damping at an instant of an orbit.
#[derive(Debug, Clone, PartialEq)]
pub struct InstantCoefficients {
    /// Crank angle, rad.
    pub crank_angle: f64,
    /// Load on the journal, N.
    pub load: [f64; 2],
    /// Stiffness and damping, shell frame.
    pub coefficients: Coefficients,
    /// The film answers to tilt.
    pub has_tilt: bool,
    /// How the film of that instant ended.
    pub outcome: Outcome,
}

/// A journal orbit over a periodic load.
#[derive(Debug, Clone, PartialEq)]
pub struct CycleResults {
    /// The bearing.
    pub bearing: Bearing,
    /// The orbit of the last cycle.
    pub orbit: JournalOrbit,
    /// Flow through each feed at each point of the orbit; empty if not recorded.
    pub feed_flows: Vec<Vec<FeedFlow>>,
    /// The fields over the last cycle, if the film model has any.
    pub fields: Option<CycleFields>,
    /// Stiffness and damping at the crank angles asked for.
    pub coefficients: Vec<InstantCoefficients>,
    /// How the shell ran in before, where it was asked for.
    pub running_in: Option<RanIn>,
}

/// The fields over the last cycle: single instants, and what each point of a surface has seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CycleFields {
    /// Evenly spaced crank angles over the period, ascending, at most [`MOST_FRAMES`].
    pub frames: Vec<CycleField>,
    /// Where the film is thinnest.
    pub worst: CycleField,
    /// What each point of the shell has seen.
    pub on_shell: AccumulatedMap,
    /// What each point of the journal has seen, angles from +X of the journal.
    pub on_journal: AccumulatedMap,
}

/// Instants of a cycle that are kept for the report and for a look at the fields.
pub const MOST_FRAMES: usize = 72;

/// What the points of one surface have seen over a cycle: point `i` around, `j` along the axis, at
/// `i * axial.len() + j`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AccumulatedMap {
    /// Angles around, rad, from +X of the surface.
    pub angles: Vec<f64>,
    /// Places along the axis, m, from the mid-plane.
    pub axial: Vec<f64>,
    /// Smallest film thickness, m.
    pub minimum_film_thickness: Vec<f64>,
    /// Largest gauge pressure, Pa.
    pub maximum_pressure: Vec<f64>,
    /// Half the difference of the largest and the smallest pressure, Pa: the amplitude that tires
    /// the surface.
    pub pressure_amplitude: Vec<f64>,
    /// Share of the cycle in which the point had a full film.
    pub full_film_share: Vec<f64>,
    /// What contact has done to it, where the study asks for wear.
    #[serde(default)]
    pub wear: Option<SurfaceWear>,
}

/// What contact has done to a surface over a cycle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SurfaceWear {
    /// Wear load and pressure times sliding speed.
    pub map: WearMap,
    /// Boundary friction, for the friction energy.
    pub boundary_friction: f64,
    /// Archard coefficient of the surface, 1/Pa; `None` for a surface whose wear is not asked for.
    pub coefficient: Option<f64>,
}

impl SurfaceWear {
    /// Deepest wear in an hour of such cycles, m, and where; of a surface with a coefficient.
    #[must_use]
    pub fn deepest_per_hour(&self) -> Option<Extreme> {
        let deepest = self.map.deepest_rate(self.coefficient?);
        Some(Extreme {
            value: HOUR * deepest.value,
            ..deepest
        })
    }

    /// Depth worn in an hour of such cycles, m.
    #[must_use]
    pub fn depth_per_hour(&self) -> Option<Vec<f64>> {
        Some(self.map.depth_rate(HOUR * self.coefficient?))
    }

    /// Volume worn in an hour of such cycles, m3.
    #[must_use]
    pub fn volume_per_hour(&self) -> Option<f64> {
        Some(self.map.volume_rate(HOUR * self.coefficient?))
    }

    /// Friction energy of asperities in a cycle, J/m2: without the viscous shear of the film.
    #[must_use]
    pub fn friction_energy(&self) -> Vec<f64> {
        self.map.friction_energy(self.boundary_friction)
    }
}

/// s
const HOUR: f64 = 3600.0;

/// The fields at one crank angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CycleField {
    /// Crank angle, rad.
    pub crank_angle: f64,
    /// The fields.
    pub field: FieldSnapshot,
}

/// Integrals of the dimensionless pressure over `phi` in [0, 2 pi] and `Z` in [-1, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DimensionlessResults {
    /// Integral of p cos phi.
    pub p_cos: f64,
    /// Integral of p sin phi.
    pub p_sin: f64,
    /// Integral of p Z cos phi.
    pub p_z_cos: f64,
    /// Integral of p Z sin phi.
    pub p_z_sin: f64,
    /// Largest pressure.
    pub peak: f64,
}

/// The fields of a film at one instant, cell `i` around, `j` along the axis, at
/// `i * axial.len() + j`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FieldSnapshot {
    /// Cell centres around, rad, from +X of the shell frame.
    pub angles: Vec<f64>,
    /// Cell centres along the axis, m, from the mid-plane.
    pub axial: Vec<f64>,
    /// Gauge pressure, Pa.
    pub pressure: Vec<f64>,
    /// Film fraction.
    pub film_fraction: Vec<f64>,
    /// Film thickness, m.
    pub film_thickness: Vec<f64>,
    /// Contact pressure of asperities, Pa; empty where none carry.
    #[serde(default)]
    pub contact_pressure: Vec<f64>,
    /// Temperature, K; empty where it is no field.
    #[serde(default)]
    pub temperature: Vec<f64>,
}

impl From<FilmField<'_>> for FieldSnapshot {
    fn from(field: FilmField<'_>) -> Self {
        Self {
            angles: field.angles.to_vec(),
            axial: field.axial.to_vec(),
            pressure: field.pressure.to_vec(),
            film_fraction: field.film_fraction.to_vec(),
            film_thickness: field.film_thickness.to_vec(),
            contact_pressure: field.contact_pressure.to_vec(),
            temperature: field.temperature.to_vec(),
        }
    }
}

/// The word for an outcome in results: `converged`, `not-converged`, ...
#[must_use]
pub fn status_name(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Converged => "converged",
        Outcome::NotConverged => "not-converged",
        Outcome::Starved => "starved",
        Outcome::NoSolution => "no-solution",
    }
}

/// With which rotors a film is stable, in words.
#[must_use]
pub fn stability_name(stability: Stability) -> &'static str {
    match stability {
        Stability::Below(_) => "stable below the threshold mass",
        Stability::EveryMass => "stable with every mass",
        Stability::NoMass => "unstable with every mass",
    }
}

impl Results {
    /// Holds the results against the limits of the study; the checks replace those of the header.
    /// A limit that seems kept is not called kept if the run did not converge.
    pub fn check_limits(&mut self, limits: &[Limit]) {
        let not_converged = self.header.status != Outcome::Converged;
        let checks = limits.iter().map(|limit| match &self.body {
            Body::Machine(machine) => machine.check(limit),
            _ => {
                let found = self.limited_value(limit.quantity);
                LimitCheck::new(limit.clone(), found).unless(not_converged)
            }
        });
        self.header.limits = checks.collect();
    }

    /// The result that a limit of this quantity judges, SI.
    pub(crate) fn limited_value(&self, quantity: Quantity) -> Option<f64> {
        match &self.body {
            Body::Steady(steady) => match quantity {
                Quantity::MinimumFilmThickness => Some(steady.summary.minimum_film_thickness.value),
                Quantity::PeakFilmPressure => Some(steady.summary.peak_film_pressure.value),
                Quantity::MaximumSpecificLoad => Some(steady.specific_load()),
                Quantity::PowerLoss => Some(steady.summary.power_loss()),
            },
            Body::LoadCycle(cycle) => cycle.limited_value(quantity),
            Body::Machine(machine) => {
                let sign = match quantity.side() {
                    Side::AtLeast => -1.0,
                    Side::AtMost => 1.0,
                };
                let value = |bearing: &BearingResults| bearing.cycle.limited_value(quantity);
                let worst = machine.largest(|bearing| value(bearing).map(|found| sign * found));
                worst.map(|(_, _, found)| sign * found)
            }
            Body::Dimensionless(_) | Body::Database(_) | Body::Sweep(_) => None,
        }
    }
}

impl SteadyResults {
    /// Friction torque of the journal over load times bore radius; `None` without a load.
    #[must_use]
    pub fn friction_coefficient(&self) -> Option<f64> {
        let load = self.load.filter(|load| *load != [0.0, 0.0])?;
        let torque = self.reaction.friction_torque_journal.abs();
        Some(torque / (magnitude(load) * self.bearing.radius()))
    }

    /// What asperities carry over what the journal bears: the integral of their pressure without
    /// regard to its direction over the load, or over the force where no load is given.
    #[must_use]
    pub fn contact_load_share(&self) -> f64 {
        let carried = self.load.unwrap_or_else(|| self.reaction.force());
        self.summary.contact_load / magnitude(carried)
    }

    /// Direction of the load, rad from +X; `None` without a load.
    #[must_use]
    pub fn load_angle(&self) -> Option<f64> {
        let [x, y] = self.load.filter(|load| *load != [0.0, 0.0])?;
        Some(y.atan2(x))
    }

    /// Eccentricity in the mid-plane over the radial clearance.
    #[must_use]
    pub fn relative_eccentricity(&self) -> f64 {
        self.state.eccentricity() / self.bearing.radial_clearance
    }

    /// Angle from the load direction to the line of centres, rad in (-pi, pi], positive in the
    /// sense of rotation; `None` without a load or with a centred journal.
    #[must_use]
    pub fn attitude_angle(&self) -> Option<f64> {
        let [x, y] = self.load.filter(|load| *load != [0.0, 0.0])?;
        if self.state.eccentricity() == 0.0 {
            return None;
        }
        let [ex, ey] = self.state.position;
        Some((x * ey - y * ex).atan2(x * ex + y * ey))
    }

    /// Load (or, where none was given, film and contact force) over width times diameter, Pa.
    #[must_use]
    pub fn specific_load(&self) -> f64 {
        specific_load(
            &self.bearing,
            self.load.unwrap_or_else(|| self.reaction.force()),
        )
    }
}

impl CycleResults {
    /// The result that a limit of this quantity judges, SI.
    #[must_use]
    pub fn limited_value(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::MinimumFilmThickness => self
                .minimum_film_thickness()
                .map(|point| point.summary.minimum_film_thickness.value),
            Quantity::PeakFilmPressure => self
                .peak_film_pressure()
                .map(|point| point.summary.peak_film_pressure.value),
            Quantity::MaximumSpecificLoad => self
                .maximum_load()
                .map(|point| specific_load(&self.bearing, point.load)),
            Quantity::PowerLoss => Some(self.mean(|point| point.summary.power_loss())),
        }
    }

    /// The point with the thinnest film.
    #[must_use]
    pub fn minimum_film_thickness(&self) -> Option<&CyclePoint> {
        self.largest(|point| -point.summary.minimum_film_thickness.value)
    }

    /// The point with the highest film pressure.
    #[must_use]
    pub fn peak_film_pressure(&self) -> Option<&CyclePoint> {
        self.largest(|point| point.summary.peak_film_pressure.value)
    }

    /// The point with the highest contact pressure of asperities.
    #[must_use]
    pub fn peak_contact_pressure(&self) -> Option<&CyclePoint> {
        self.largest(|point| point.summary.peak_contact_pressure.value)
    }

    /// What contact has done to the shell, where the study asks for wear.
    #[must_use]
    pub fn shell_wear(&self) -> Option<&SurfaceWear> {
        self.fields.as_ref()?.on_shell.wear.as_ref()
    }

    /// Mean of what asperities carry, without regard to its direction, over the mean load.
    #[must_use]
    pub fn contact_load_share(&self) -> f64 {
        self.mean(|point| point.summary.contact_load) / self.mean(|point| magnitude(point.load))
    }

    /// The point with the largest load.
    #[must_use]
    pub fn maximum_load(&self) -> Option<&CyclePoint> {
        self.largest(|point| magnitude(point.load))
    }

    /// The point at which a value is largest, the first of equals; points where it is not finite
    /// do not count.
    pub fn largest(&self, value: impl Fn(&CyclePoint) -> f64) -> Option<&CyclePoint> {
        self.orbit
            .points
            .iter()
            .map(|point| (value(point), point))
            .filter(|(value, _)| value.is_finite())
            .reduce(|best, next| if next.0 > best.0 { next } else { best })
            .map(|(_, point)| point)
    }

    /// Mean of a value over the crank angles of the orbit (trapezoidal rule); not a number if any
    /// of its values is not finite or the orbit is empty.
    pub fn mean(&self, value: impl Fn(&CyclePoint) -> f64) -> f64 {
        let points = &self.orbit.points;
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return f64::NAN;
        };
        let span = last.crank_angle - first.crank_angle;
        if span == 0.0 {
            return value(first);
        }
        let area: f64 = points
            .windows(2)
            .map(|pair| {
                0.5 * (value(&pair[0]) + value(&pair[1]))
                    * (pair[1].crank_angle - pair[0].crank_angle)
            })
            .sum();
        area / span
    }

    /// Mean of a value of one feed over the crank angles of the orbit (trapezoidal rule); not a
    /// number where it was not recorded at every point.
    pub fn mean_of_feed(&self, feed: usize, value: impl Fn(&FeedFlow) -> f64) -> f64 {
        let points = &self.orbit.points;
        if self.feed_flows.len() != points.len() {
            return f64::NAN;
        }
        let at = |row: &Vec<FeedFlow>| row.get(feed).map_or(f64::NAN, &value);
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return f64::NAN;
        };
        let span = last.crank_angle - first.crank_angle;
        if span == 0.0 {
            return at(&self.feed_flows[0]);
        }
        let area: f64 = points
            .windows(2)
            .zip(self.feed_flows.windows(2))
            .map(|(pair, rows)| {
                0.5 * (at(&rows[0]) + at(&rows[1])) * (pair[1].crank_angle - pair[0].crank_angle)
            })
            .sum();
        area / span
    }

    /// Eccentricity of a point in the mid-plane over the radial clearance.
    #[must_use]
    pub fn relative_eccentricity(&self, point: &CyclePoint) -> f64 {
        point.state.eccentricity() / self.bearing.radial_clearance
    }

    /// The point with the thinnest film at an edge: 0 the front (z = -B/2), 1 the rear (z = +B/2).
    #[must_use]
    pub fn thinnest_edge(&self, edge: usize) -> Option<&CyclePoint> {
        self.largest(|point| -point.summary.edge_film_thickness[edge])
    }

    /// The journal tilts somewhere in the cycle.
    #[must_use]
    pub fn is_tilted(&self) -> bool {
        let points = &self.orbit.points;
        points.iter().any(|point| point.state.tilt != [0.0; 2])
    }

    /// Points at which the step did not converge.
    pub fn not_converged(&self) -> impl Iterator<Item = &CyclePoint> {
        self.orbit
            .points
            .iter()
            .filter(|point| point.outcome != Outcome::Converged)
    }
}

/// An angular speed in revolutions per minute.
#[must_use]
pub fn rpm(speed: f64) -> f64 {
    speed * 30.0 / std::f64::consts::PI
}

/// Length of a plane vector, in its unit.
#[must_use]
pub fn magnitude(vector: [f64; 2]) -> f64 {
    vector[0].hypot(vector[1])
}

/// A film thickness (m) over the composite roughness; `None` between smooth surfaces.
#[must_use]
pub fn film_parameter(bearing: &Bearing, film_thickness: f64) -> Option<f64> {
    match &bearing.finish {
        Finish::Smooth => None,
        Finish::Rough(rough) => Some(film_thickness / rough.roughness.composite()),
    }
}

/// Load over width times diameter, Pa.
#[must_use]
pub fn specific_load(bearing: &Bearing, load: [f64; 2]) -> f64 {
    magnitude(load) / (bearing.width * bearing.diameter)
}

/// An angle in degrees in [0, 360), without the round-off of the conversion.
#[must_use]
pub fn degrees_around(angle: f64) -> f64 {
    degrees(angle).rem_euclid(360.0)
}

/// An angle in degrees, without the round-off of the conversion: 90 deg reads 90.
#[must_use]
pub fn degrees(angle: f64) -> f64 {
    (angle.to_degrees() * 1e9).round() / 1e9
}

/// The place of an extreme in reading units: angle in degrees in [0, 360) and axial position, mm.
#[must_use]
pub fn place(extreme: &Extreme) -> (f64, f64) {
    // A mid-plane found by arithmetic reads 0, not 1e-15.
    let axial = (extreme.axial * 1e12).round() * 1e-9;
    (degrees_around(extreme.angle), axial)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    #[test]
    fn status_names_are_those_of_serialisation() {
        for outcome in [
            Outcome::Converged,
            Outcome::NotConverged,
            Outcome::Starved,
            Outcome::NoSolution,
        ] {
            let serialised = serde_json::to_value(outcome).unwrap();
            assert_eq!(serialised, status_name(outcome));
        }
    }

    #[test]
    fn degrees_are_free_of_conversion_noise() {
        assert_eq!(degrees(4.5f64.to_radians()), 4.5);
        assert_eq!(degrees_around((-90.0f64).to_radians()), 270.0);
    }
}
