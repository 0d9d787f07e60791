//! What one run produced: plain owned data, SI, that every output format reads.

use crate::cases::{CaseStatus, SweepResults};
use crate::limits::{Limit, LimitCheck, Quantity, Verdict};
use crate::models::Model;
use sommerfeld_bearing::{CyclePoint, JournalOrbit};
use sommerfeld_film::{
    Bearing, Extreme, FeedFlow, FilmField, FilmSummary, JournalState, Outcome, Reaction,
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
    /// Absolute discretisation error by key of `summary.json` (`integrals.p_cos` for nested keys),
    /// in the unit of that key, where an error target or a check on a second grid was asked for.
    pub error: Option<BTreeMap<String, f64>>,
    /// Limits of the study, held against the results by [`Results::check_limits`].
    pub limits: Vec<LimitCheck>,
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
    /// The fields, if the film model has any.
    pub field: Option<FieldSnapshot>,
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
    /// The fields at one crank angle, usually that of the thinnest film.
    pub worst_film: Option<CycleField>,
}

/// The fields at one crank angle.
#[derive(Debug, Clone, PartialEq)]
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
#[derive(Debug, Clone, PartialEq)]
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
}

impl From<FilmField<'_>> for FieldSnapshot {
    fn from(field: FilmField<'_>) -> Self {
        Self {
            angles: field.angles.to_vec(),
            axial: field.axial.to_vec(),
            pressure: field.pressure.to_vec(),
            film_fraction: field.film_fraction.to_vec(),
            film_thickness: field.film_thickness.to_vec(),
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

impl Results {
    /// Holds the results against the limits of the study; the checks replace those of the header.
    /// A limit that seems kept is not called kept if the run did not converge.
    pub fn check_limits(&mut self, limits: &[Limit]) {
        let checks = limits
            .iter()
            .map(|limit| {
                let found = self.limited_value(limit.quantity);
                let mut check = LimitCheck::new(limit.clone(), found);
                if self.header.status != Outcome::Converged && check.verdict == Verdict::Ok {
                    check.verdict = Verdict::NotEvaluated;
                }
                check
            })
            .collect();
        self.header.limits = checks;
    }

    /// The result that a limit of this quantity judges, SI.
    fn limited_value(&self, quantity: Quantity) -> Option<f64> {
        match &self.body {
            Body::Steady(steady) => match quantity {
                Quantity::MinimumFilmThickness => Some(steady.summary.minimum_film_thickness.value),
                Quantity::PeakFilmPressure => Some(steady.summary.peak_film_pressure.value),
                Quantity::MaximumSpecificLoad => Some(steady.specific_load()),
                Quantity::PowerLoss => Some(steady.summary.power_loss()),
            },
            Body::LoadCycle(cycle) => match quantity {
                Quantity::MinimumFilmThickness => cycle
                    .minimum_film_thickness()
                    .map(|point| point.summary.minimum_film_thickness.value),
                Quantity::PeakFilmPressure => cycle
                    .peak_film_pressure()
                    .map(|point| point.summary.peak_film_pressure.value),
                Quantity::MaximumSpecificLoad => cycle
                    .maximum_load()
                    .map(|point| specific_load(&cycle.bearing, point.load)),
                Quantity::PowerLoss => Some(cycle.mean(|point| point.summary.power_loss())),
            },
            Body::Dimensionless(_) | Body::Sweep(_) => None,
        }
    }
}

impl Results {
    /// The few figures that answer the question of the study, named and with units, for a terminal.
    #[must_use]
    pub fn key_figures(&self) -> Vec<(&'static str, String)> {
        match &self.body {
            Body::Steady(steady) => steady.key_figures(),
            Body::LoadCycle(cycle) => cycle.key_figures(),
            Body::Dimensionless(integrals) => [
                ("p cos", integrals.p_cos),
                ("p sin", integrals.p_sin),
                ("p Z cos", integrals.p_z_cos),
                ("p Z sin", integrals.p_z_sin),
                ("peak", integrals.peak),
            ]
            .map(|(name, value)| (name, format!("{value:.7}")))
            .to_vec(),
            Body::Sweep(sweep) => {
                let mut figures = vec![("cases", sweep.cases.len().to_string())];
                let counts = [
                    ("converged", sweep.count(CaseStatus::Converged)),
                    ("not converged", sweep.count(CaseStatus::NotConverged)),
                    ("failed", sweep.failed()),
                    ("not run", sweep.count(CaseStatus::NotRun)),
                ];
                let counts = counts.into_iter().filter(|(_, count)| *count > 0);
                figures.extend(counts.map(|(name, count)| (name, count.to_string())));
                figures
            }
        }
    }
}

impl SteadyResults {
    fn key_figures(&self) -> Vec<(&'static str, String)> {
        let film = &self.summary;
        if film.minimum_film_thickness.value.is_nan() {
            return Vec::new();
        }
        let side_flow = film.side_flow[0] + film.side_flow[1];
        let mut figures = vec![
            (
                "relative eccentricity",
                format!("{:.5}", self.relative_eccentricity()),
            ),
            (
                "minimum film thickness",
                micrometres(film.minimum_film_thickness.value),
            ),
            (
                "peak film pressure",
                megapascals(film.peak_film_pressure.value),
            ),
            ("power loss", format!("{:.1} W", film.power_loss())),
            ("side flow", cubic_centimetres(side_flow)),
        ];
        let rows = |[x, y]: [[f64; 2]; 2], unit| {
            format!(
                "[[{:.4e}, {:.4e}], [{:.4e}, {:.4e}]] {unit}",
                x[0], x[1], y[0], y[1]
            )
        };
        figures.extend(self.stiffness.map(|k| ("stiffness", rows(k, "N/m"))));
        figures.extend(self.damping.map(|d| ("damping", rows(d, "N s/m"))));
        figures
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
    fn key_figures(&self) -> Vec<(&'static str, String)> {
        let at = |point: &CyclePoint| format!("at {:.1} deg", point.crank_angle.to_degrees());
        let mut figures = Vec::new();
        if let Some(point) = self.minimum_film_thickness() {
            let value = point.summary.minimum_film_thickness.value;
            figures.push((
                "minimum film thickness",
                format!("{} {}", micrometres(value), at(point)),
            ));
        }
        if let Some(point) = self.peak_film_pressure() {
            let value = point.summary.peak_film_pressure.value;
            figures.push((
                "peak film pressure",
                format!("{} {}", megapascals(value), at(point)),
            ));
        }
        if figures.is_empty() {
            return figures;
        }
        let power = self.mean(|point| point.summary.power_loss());
        let flow = self.mean(|point| point.summary.side_flow[0] + point.summary.side_flow[1]);
        figures.push(("mean power loss", format!("{power:.1} W")));
        figures.push(("mean side flow", cubic_centimetres(flow)));
        let orbit = &self.orbit;
        figures.push((
            "cycles",
            format!("{} (closure {:.1e})", orbit.cycles, orbit.closure),
        ));
        figures
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

    /// Eccentricity of a point in the mid-plane over the radial clearance.
    #[must_use]
    pub fn relative_eccentricity(&self, point: &CyclePoint) -> f64 {
        point.state.eccentricity() / self.bearing.radial_clearance
    }

    /// Points at which the step did not converge.
    pub fn not_converged(&self) -> impl Iterator<Item = &CyclePoint> {
        self.orbit
            .points
            .iter()
            .filter(|point| point.outcome != Outcome::Converged)
    }
}

fn micrometres(metres: f64) -> String {
    format!("{:.4} um", 1e6 * metres)
}

fn megapascals(pascals: f64) -> String {
    format!("{:.3} MPa", 1e-6 * pascals)
}

fn cubic_centimetres(cubic_metres: f64) -> String {
    format!("{:.3} cm3/s", 1e6 * cubic_metres)
}

/// Length of a plane vector, in its unit.
#[must_use]
pub fn magnitude(vector: [f64; 2]) -> f64 {
    vector[0].hypot(vector[1])
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
