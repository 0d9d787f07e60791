//! The few figures that answer the question of a study, named and with units, for a terminal.

use crate::cases::CaseStatus;
use crate::limits::Quantity;
use crate::results::database::DatabaseResults;
use crate::results::machine::{BearingResults, MachineResults, SpeedResults};
use crate::results::{Body, CycleResults, Dynamics, Results, SteadyResults, rpm};
use sommerfeld_bearing::{CyclePoint, Stability};
use sommerfeld_engine::Performance;
use std::collections::BTreeMap;

impl Results {
    /// The few figures that answer the question of the study, named and with units, for a terminal.
    #[must_use]
    pub fn key_figures(&self) -> Vec<(&'static str, String)> {
        let bars = ErrorBars(self.header.error.as_ref());
        let mut figures = match &self.body {
            Body::Steady(steady) => steady.key_figures(bars),
            Body::LoadCycle(cycle) => cycle.key_figures(bars),
            Body::Dimensionless(integrals) => [
                ("p cos", "p_cos", integrals.p_cos),
                ("p sin", "p_sin", integrals.p_sin),
                ("p Z cos", "p_z_cos", integrals.p_z_cos),
                ("p Z sin", "p_z_sin", integrals.p_z_sin),
                ("peak", "peak", integrals.peak),
            ]
            .map(|(name, key, value)| {
                let bar = bars.text(&format!("integrals.{key}"), 1.0);
                (name, format!("{value:.7}{bar}"))
            })
            .to_vec(),
            Body::Machine(machine) => machine.key_figures(),
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
            Body::Database(database) => database.key_figures(),
        };
        let databases = self.header.databases.iter();
        figures.extend(databases.map(|one| ("film", one.told())));
        figures
    }
}

impl DatabaseResults {
    fn key_figures(&self) -> Vec<(&'static str, String)> {
        let mut figures = vec![("file", self.file.display().to_string())];
        if let Some(built) = &self.built {
            let facts = &built.facts;
            figures.push(("points", facts.points.to_string()));
            figures.push((
                "largest error",
                format!(
                    "{:.2e} of {} samples, target {:.0e}, {}",
                    facts.stated_error,
                    facts.samples,
                    built.target,
                    facts.status_name()
                ),
            ));
            if !built.fresh.is_empty() {
                figures.push((
                    "fresh states",
                    format!(
                        "largest error {:.2e} of {}",
                        built.fresh_maximum(),
                        built.fresh.len()
                    ),
                ));
            }
        }
        figures.push(("build time", format!("{:.2} s", self.build_time)));
        figures
    }
}

impl MachineResults {
    fn key_figures(&self) -> Vec<(&'static str, String)> {
        let none = ErrorBars(None);
        let count = self.speeds.first().map_or(0, |speed| speed.bearings.len());
        let mut figures = vec![("bearings", count.to_string())];
        if self.speeds.len() > 1 {
            figures.push(("speeds", self.speeds.len().to_string()));
        }
        let extreme = |value: &dyn Fn(&CyclePoint) -> f64| {
            let of = |bearing: &BearingResults| {
                let point = bearing.cycle.largest(value)?;
                Some(value(point))
            };
            let (speed, bearing, _) = self.largest(of)?;
            let point = bearing.cycle.largest(value)?;
            let at = format!(
                "at {:.1} deg in {}",
                point.crank_angle.to_degrees(),
                speed.place(bearing)
            );
            Some((bearing, point, at))
        };
        if let Some((_, point, at)) = extreme(&|p| -p.summary.minimum_film_thickness.value) {
            let film = point.summary.minimum_film_thickness.value;
            figures.push((
                "minimum film thickness",
                format!("{} {at}", micrometres(film, "", none)),
            ));
        }
        if let Some((_, point, at)) = extreme(&|p| p.summary.peak_film_pressure.value) {
            let peak = point.summary.peak_film_pressure.value;
            figures.push((
                "peak film pressure",
                format!("{} {at}", megapascals(peak, "", none)),
            ));
        }
        let specific =
            |bearing: &BearingResults| bearing.cycle.limited_value(Quantity::MaximumSpecificLoad);
        if let Some((speed, bearing, load)) = self.largest(specific) {
            let text = format!(
                "{} in {}",
                megapascals(load, "", none),
                speed.place(bearing)
            );
            figures.push(("maximum specific load", text));
        }
        figures.extend(self.speed_figures());
        figures
    }

    /// Of one speed its figures, of several their range.
    fn speed_figures(&self) -> Vec<(&'static str, String)> {
        let mut figures = Vec::new();
        let mut add =
            |name, value: &dyn Fn(&SpeedResults) -> Option<f64>, text: &dyn Fn(f64) -> String| {
                let values: Vec<f64> = self.speeds.iter().filter_map(value).collect();
                let Some(least) = values.iter().copied().reduce(f64::min) else {
                    return;
                };
                let most = values.iter().copied().fold(least, f64::max);
                figures.push((
                    name,
                    match least == most {
                        true => shown(least, text),
                        false => format!("{} to {}", shown(least, text), shown(most, text)),
                    },
                ));
            };
        add(
            "friction mean pressure",
            &|speed| speed.friction_mean_effective_pressure,
            &|pressure| format!("{:.4} bar", 1e-5 * pressure),
        );
        let engine = |value: fn(&Performance) -> f64| {
            move |speed: &SpeedResults| speed.performance.as_ref().map(value)
        };
        add(
            "imep",
            &engine(|found| found.indicated_mean_effective_pressure),
            &|pressure| format!("{:.3} bar", 1e-5 * pressure),
        );
        add(
            "mean torque",
            &engine(|found| found.mean_torque),
            &|torque| format!("{torque:.1} N.m"),
        );
        figures
    }
}

/// Errors of figures as text behind their values.
#[derive(Debug, Clone, Copy)]
struct ErrorBars<'a>(Option<&'a BTreeMap<String, f64>>);

impl ErrorBars<'_> {
    /// ` +- 0.012`, two digits in the unit that one SI unit makes `factor` of; empty without an error.
    fn text(self, key: &str, factor: f64) -> String {
        let Some(error) = self.0.and_then(|errors| errors.get(key)) else {
            return String::new();
        };
        format!(" +- {}", two_digits(factor * error))
    }

    /// The largest error of the components of a matrix.
    fn largest(self, key: &str) -> String {
        let inner = format!("{key}.");
        let components = self.0.into_iter().flatten();
        let errors = components.filter(|(name, _)| name.starts_with(&inner));
        errors
            .map(|(_, error)| *error)
            .reduce(f64::max)
            .map_or_else(String::new, |error| format!(" +- {error:.1e} each"))
    }
}

impl SteadyResults {
    fn key_figures(&self, bars: ErrorBars<'_>) -> Vec<(&'static str, String)> {
        let film = &self.summary;
        if film.minimum_film_thickness.value.is_nan() {
            return Vec::new();
        }
        let side_flow = film.side_flow[0] + film.side_flow[1];
        let mut figures = vec![
            (
                "relative eccentricity",
                format!(
                    "{:.5}{}",
                    self.relative_eccentricity(),
                    bars.text("relative_eccentricity", 1.0)
                ),
            ),
            (
                "minimum film thickness",
                micrometres(
                    film.minimum_film_thickness.value,
                    "minimum_film_thickness_m",
                    bars,
                ),
            ),
            (
                "peak film pressure",
                megapascals(film.peak_film_pressure.value, "peak_film_pressure_pa", bars),
            ),
            ("power loss", watts(film.power_loss(), "power_loss_w", bars)),
            (
                "side flow",
                cubic_centimetres(side_flow, "side_flow_m3_s", bars),
            ),
        ];
        let rows = |[x, y]: [[f64; 2]; 2], key, unit| {
            format!(
                "[[{:.4e}, {:.4e}], [{:.4e}, {:.4e}]]{} {unit}",
                x[0],
                x[1],
                y[0],
                y[1],
                bars.largest(key)
            )
        };
        let stiffness = self.stiffness.map(|k| rows(k, "stiffness_n_m", "N/m"));
        let damping = self.damping.map(|d| rows(d, "damping_n_s_m", "N s/m"));
        figures.extend(stiffness.map(|text| ("stiffness", text)));
        figures.extend(damping.map(|text| ("damping", text)));
        if let Some(dynamics) = &self.dynamics {
            figures.extend(dynamics.key_figures(self.state.journal_speed));
        }
        figures
    }
}

impl Dynamics {
    fn key_figures(&self, journal_speed: f64) -> Vec<(&'static str, String)> {
        let mut figures = Vec::new();
        figures.push((
            "whirl threshold mass",
            match self.stability {
                Stability::Below(threshold) => {
                    let ratio = threshold.whirl_speed / journal_speed.abs();
                    format!("{:.5} kg (whirl ratio {ratio:.4})", threshold.mass)
                }
                Stability::EveryMass => "none: stable with every rotor mass".to_owned(),
                Stability::NoMass => "none: unstable with every rotor mass".to_owned(),
            },
        ));
        if let Some(mass) = self.rotor_mass {
            let word = if self.stability.is_stable(mass) {
                "stable"
            } else {
                "unstable"
            };
            let margin = self.stability.margin(mass);
            figures.push(("rotor", format!("{word}, margin {margin:.4}")));
        }
        for onset in self.chart.iter().flat_map(|chart| &chart.onsets) {
            let side = if onset.is_unstable_above {
                "above"
            } else {
                "below"
            };
            figures.push((
                "whirl onset",
                format!("unstable {side} {:.2} rpm", rpm(onset.journal_speed)),
            ));
        }
        figures
    }
}

impl CycleResults {
    fn key_figures(&self, bars: ErrorBars<'_>) -> Vec<(&'static str, String)> {
        let at = |point: &CyclePoint, key| {
            let bar = bars.text(key, 1.0);
            format!("at {:.1}{bar} deg", point.crank_angle.to_degrees())
        };
        let mut figures = Vec::new();
        if let Some(point) = self.minimum_film_thickness() {
            let value = point.summary.minimum_film_thickness.value;
            figures.push((
                "minimum film thickness",
                format!(
                    "{} {}",
                    micrometres(value, "minimum_film_thickness_m", bars),
                    at(point, "minimum_film_thickness_angle_deg")
                ),
            ));
        }
        if let Some(point) = self.peak_film_pressure() {
            let value = point.summary.peak_film_pressure.value;
            figures.push((
                "peak film pressure",
                format!(
                    "{} {}",
                    megapascals(value, "peak_film_pressure_pa", bars),
                    at(point, "peak_film_pressure_angle_deg")
                ),
            ));
        }
        if figures.is_empty() {
            return figures;
        }
        let power = self.mean(|point| point.summary.power_loss());
        let flow = self.mean(|point| point.summary.side_flow[0] + point.summary.side_flow[1]);
        let power = watts(power, "mean_power_loss_w", bars);
        let flow = cubic_centimetres(flow, "mean_side_flow_m3_s", bars);
        figures.extend([("mean power loss", power), ("mean side flow", flow)]);
        let orbit = &self.orbit;
        figures.push((
            "cycles",
            format!(
                "{} (closure {})",
                orbit.cycles,
                shown(orbit.closure, |closure| format!("{closure:.1e}"))
            ),
        ));
        figures
    }
}

/// Two significant digits, without powers of ten where they are readable.
fn two_digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let exponent = value.abs().log10().floor();
    if !(-6.0..6.0).contains(&exponent) {
        return format!("{value:.1e}");
    }
    let decimals = (1.0 - exponent).max(0.0) as usize;
    format!("{value:.decimals$}")
}

/// A number as text; `n/a` for one that was not found.
fn shown(value: f64, text: impl FnOnce(f64) -> String) -> String {
    if value.is_finite() {
        text(value)
    } else {
        "n/a".to_owned()
    }
}

fn micrometres(metres: f64, key: &str, bars: ErrorBars<'_>) -> String {
    shown(metres, |m| {
        format!("{:.4}{} um", 1e6 * m, bars.text(key, 1e6))
    })
}

fn megapascals(pascals: f64, key: &str, bars: ErrorBars<'_>) -> String {
    shown(pascals, |p| {
        format!("{:.3}{} MPa", 1e-6 * p, bars.text(key, 1e-6))
    })
}

fn watts(watts: f64, key: &str, bars: ErrorBars<'_>) -> String {
    shown(watts, |w| format!("{w:.1}{} W", bars.text(key, 1.0)))
}

fn cubic_centimetres(cubic_metres: f64, key: &str, bars: ErrorBars<'_>) -> String {
    shown(cubic_metres, |q| {
        format!("{:.3}{} cm3/s", 1e6 * q, bars.text(key, 1e6))
    })
}
