//! By how much may the figures of a run be off, for the sake of its grid and its time step?
//!
//! A figure is a number of `summary.json` that the discretisation touches, under its key there;
//! components of vectors and matrices carry their indices (`force_n.0`, `stiffness_n_m.0.1`). The
//! error of a figure has two parts that are summed:
//! - space: from three grids, see [`sommerfeld_film::richardson`];
//! - time, load cycles only: the change when all time steps are twice as long, with a safety factor.
//!   That is the whole error of a method of order 1, which a transported film fraction makes of any,
//!   and three times that of order 2. Extremes may also lie between two crank angles.
//!
//! What the physical model leaves out is no part of it.

use crate::output::summary;
use crate::results::{Body, Results, magnitude};
use serde_json::Value;
use sommerfeld_bearing::CyclePoint;
use sommerfeld_film::FilmShear;
use sommerfeld_film::richardson::{Estimate, Kind, Sample, estimate, vector_errors};
use std::collections::BTreeMap;

/// Safety on the change of a figure with longer time steps, as on that with coarser grids.
const TIME_SAFETY: f64 = 1.25;

/// Figures by key, in the unit of the key.
pub type Figures = BTreeMap<String, f64>;

/// Against what the error of a figure is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scale {
    /// The largest component of the figures of this key: itself, vector, matrix.
    Own,
    /// The larger of its own and a tenth of the force on half the width: moments may vanish.
    Moment,
    /// The larger of side and feed flow: one of them may be nothing.
    Flow,
    /// A radian.
    Angle,
    /// None: an error is stated, no target is set. Counts of cells and crank angles go in steps.
    Free,
}

/// Figures that are the two components of a vector.
const VECTORS: &[[&str; 2]] = &[
    ["force_n.0", "force_n.1"],
    ["moment_n_m.0", "moment_n_m.1"],
    ["integrals.p_cos", "integrals.p_sin"],
    ["integrals.p_z_cos", "integrals.p_z_sin"],
];

/// The figures of one state of the journal.
const STEADY: &[(&str, Scale)] = &[
    ("force_n", Scale::Own),
    ("moment_n_m", Scale::Moment),
    ("relative_eccentricity", Scale::Own),
    ("line_of_centres_angle_deg", Scale::Angle),
    ("attitude_angle_deg", Scale::Angle),
    ("sommerfeld_number", Scale::Own),
    ("specific_load_pa", Scale::Own),
    ("minimum_film_thickness_m", Scale::Own),
    ("peak_film_pressure_pa", Scale::Own),
    ("friction_torque_journal_n_m", Scale::Own),
    ("friction_torque_shell_n_m", Scale::Own),
    ("power_loss_w", Scale::Own),
    ("side_flow_m3_s", Scale::Flow),
    ("feed_flow_m3_s", Scale::Flow),
    ("full_film_share", Scale::Free),
    ("stiffness_n_m", Scale::Own),
    ("damping_n_s_m", Scale::Own),
];

/// The figures of a load cycle.
const CYCLE: &[(&str, Scale)] = &[
    ("minimum_film_thickness_m", Scale::Own),
    ("minimum_film_thickness_angle_deg", Scale::Free),
    ("peak_film_pressure_pa", Scale::Own),
    ("peak_film_pressure_angle_deg", Scale::Free),
    ("maximum_load_n", Scale::Own),
    ("maximum_load_angle_deg", Scale::Free),
    ("maximum_specific_load_pa", Scale::Own),
    ("mean_power_loss_w", Scale::Own),
    ("mean_friction_power_w", Scale::Own),
    ("mean_squeeze_power_w", Scale::Own),
    ("mean_side_flow_m3_s", Scale::Flow),
    ("mean_feed_flow_m3_s", Scale::Flow),
    ("mean_relative_eccentricity", Scale::Own),
];

const DIMENSIONLESS: &[(&str, Scale)] = &[("integrals", Scale::Own)];

fn keys(body: &Body) -> &'static [(&'static str, Scale)] {
    match body {
        Body::Steady(_) => STEADY,
        Body::LoadCycle(_) => CYCLE,
        Body::Dimensionless(_) => DIMENSIONLESS,
        Body::Machine(_) | Body::Database(_) | Body::Sweep(_) => &[],
    }
}

/// The figures of a run; those that are no number are left out.
#[must_use]
pub fn figures(results: &Results) -> Figures {
    let summary = summary(results);
    let mut figures = Figures::new();
    for (key, _) in keys(&results.body) {
        flatten(key, &summary[*key], &mut figures);
    }
    figures
}

fn flatten(key: &str, value: &Value, figures: &mut Figures) {
    match value {
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                flatten(&format!("{key}.{index}"), item, figures);
            }
        }
        Value::Object(items) => {
            for (name, item) in items {
                flatten(&format!("{key}.{name}"), item, figures);
            }
        }
        other => {
            if let Some(number) = other.as_f64().filter(|number| number.is_finite()) {
                figures.insert(key.to_owned(), number);
            }
        }
    }
}

/// One run on its grid: cell size and figures.
#[derive(Debug, Clone, Copy)]
pub struct GridRun<'a> {
    /// Cell size, as of [`sommerfeld_film::richardson::cell_size`].
    pub size: f64,
    /// What was found.
    pub figures: &'a Figures,
}

/// What three grids, the finest first, tell about each figure that all of them have. `results` are
/// any of theirs, for the turn of their angles.
#[must_use]
pub fn space_estimates(results: &Results, runs: [GridRun<'_>; 3]) -> BTreeMap<String, Estimate> {
    let mut estimates = BTreeMap::new();
    for (key, finest) in runs[0].figures {
        let value = |run: GridRun<'_>| {
            let value = *run.figures.get(key)?;
            Some(Sample {
                size: run.size,
                value: finest + difference(results, key, value, *finest),
            })
        };
        if let [Some(fine), Some(middle), Some(coarse)] = runs.map(value) {
            let found = estimate(kind(key, results), [fine, middle, coarse]);
            estimates.insert(key.clone(), found);
        }
    }
    estimates
}

/// Extremes are the peak pressure, its crank angle and that of the smallest film; the gap itself is known
/// in closed form and as smooth as the place of the journal. A share of the film in the bearing counts
/// cells.
fn kind(key: &str, results: &Results) -> Kind {
    const EXTREMES: [&str; 5] = [
        "peak_film_pressure_pa",
        "peak_film_pressure_angle_deg",
        "minimum_film_thickness_angle_deg",
        "integrals.peak",
        "full_film_share",
    ];
    const OF_FILM_FRACTION: [&str; 5] = [
        "friction_torque_journal_n_m",
        "friction_torque_shell_n_m",
        "mean_friction_power_w",
        "power_loss_w",
        "mean_power_loss_w",
    ];
    let bearing = match &results.body {
        Body::Steady(steady) => Some(&steady.bearing),
        Body::LoadCycle(cycle) => Some(&cycle.bearing),
        Body::Dimensionless(_) | Body::Machine(_) | Body::Database(_) | Body::Sweep(_) => None,
    };
    let shears_by_fraction = bearing.is_some_and(|b| b.film_shear == FilmShear::FilmFraction);
    if EXTREMES.contains(&key) {
        Kind::Extreme
    } else if shears_by_fraction && OF_FILM_FRACTION.contains(&key) {
        Kind::Transported
    } else {
        Kind::Integral
    }
}

/// Errors taken from estimates by `of`, those of a vector by [`vector_errors`].
#[must_use]
pub fn space_errors(
    estimates: &BTreeMap<String, Estimate>,
    of: impl Fn(&Estimate) -> f64,
) -> Figures {
    let mut errors: Figures = estimates
        .iter()
        .map(|(key, e)| (key.clone(), of(e)))
        .collect();
    for [x, y] in VECTORS {
        if let (Some(&of_x), Some(&of_y)) = (errors.get(*x), errors.get(*y)) {
            let [of_x, of_y] = vector_errors([of_x, of_y]);
            errors.insert((*x).to_owned(), of_x);
            errors.insert((*y).to_owned(), of_y);
        }
    }
    errors
}

/// Errors for the sake of the time step, from figures with the steps of the run and with twice as
/// long ones. A crank angle is known to half a step in any case.
#[must_use]
pub fn time_errors(results: &Results, run: &Figures, with_long_steps: &Figures) -> Figures {
    let half_step = match &results.body {
        Body::LoadCycle(cycle) => match &cycle.orbit.points[..] {
            [first, second, ..] => 0.5 * (second.crank_angle - first.crank_angle).to_degrees(),
            _ => 0.0,
        },
        Body::Steady(_)
        | Body::Dimensionless(_)
        | Body::Machine(_)
        | Body::Database(_)
        | Body::Sweep(_) => 0.0,
    };
    let between = sampling_errors(results);
    run.iter()
        .filter_map(|(key, value)| {
            let change = difference(results, key, *with_long_steps.get(key)?, *value).abs();
            let least = if is_angle(key) { half_step } else { 0.0 };
            let missed = between.get(key.as_str()).copied().unwrap_or_default();
            Some((key.clone(), (TIME_SAFETY * change).max(least) + missed))
        })
        .collect()
}

/// What an extreme may miss between two crank angles: an eighth of the second difference around it, as
/// for a parabola whose vertex lies in the middle of two points. Longer steps do not show it where
/// their points hold the same extreme.
fn sampling_errors(results: &Results) -> BTreeMap<&'static str, f64> {
    let Body::LoadCycle(cycle) = &results.body else {
        return BTreeMap::new();
    };
    let points = &cycle.orbit.points;
    let missed = |value: &dyn Fn(&CyclePoint) -> f64| {
        let bend =
            |k: usize| (value(&points[k - 1]) - 2.0 * value(&points[k])) + value(&points[k + 1]);
        (1..points.len().saturating_sub(1))
            .max_by(|&a, &b| value(&points[a]).total_cmp(&value(&points[b])))
            .map_or(0.0, |highest| 0.125 * bend(highest).abs())
    };
    let load = missed(&|point| magnitude(point.load));
    let area = cycle.bearing.width * cycle.bearing.diameter;
    BTreeMap::from([
        (
            "minimum_film_thickness_m",
            missed(&|point| -point.summary.minimum_film_thickness.value),
        ),
        (
            "peak_film_pressure_pa",
            missed(&|point| point.summary.peak_film_pressure.value),
        ),
        ("maximum_load_n", load),
        ("maximum_specific_load_pa", load / area),
    ])
}

fn is_angle(key: &str) -> bool {
    key.ends_with("_angle_deg")
}

/// `a - b`; of angles the short way round the circle, of crank angles round the period.
fn difference(results: &Results, key: &str, a: f64, b: f64) -> f64 {
    let turn = match &results.body {
        _ if !is_angle(key) => return a - b,
        Body::LoadCycle(cycle) => match &cycle.orbit.points[..] {
            [first, .., last] => (last.crank_angle - first.crank_angle).to_degrees(),
            _ => return a - b,
        },
        Body::Steady(_)
        | Body::Dimensionless(_)
        | Body::Machine(_)
        | Body::Database(_)
        | Body::Sweep(_) => 360.0,
    };
    (a - b) - turn * ((a - b) / turn).round()
}

/// Errors of the figures over their scales, for those that a target is set for; the largest first.
#[must_use]
pub fn relative_errors(
    results: &Results,
    figures: &Figures,
    errors: &Figures,
) -> Vec<(String, f64)> {
    let size = |key: &str| {
        let inner = format!("{key}.");
        figures
            .iter()
            .filter(|(name, _)| *name == key || name.starts_with(&inner))
            .fold(0.0, |largest: f64, (_, value)| largest.max(value.abs()))
    };
    let half_width = match &results.body {
        Body::Steady(steady) => 0.5 * steady.bearing.width,
        Body::LoadCycle(_)
        | Body::Dimensionless(_)
        | Body::Machine(_)
        | Body::Database(_)
        | Body::Sweep(_) => 0.0,
    };
    let mut relative = Vec::new();
    for (name, error) in errors {
        let family = name.split('.').next().unwrap_or(name);
        let Some((_, scale)) = keys(&results.body).iter().find(|(key, _)| *key == family) else {
            continue;
        };
        let scale = match scale {
            Scale::Own => size(family),
            Scale::Moment => size(family).max(0.1 * size("force_n") * half_width),
            Scale::Flow => ["", "mean_"]
                .iter()
                .flat_map(|mean| ["side", "feed"].map(|of| size(&format!("{mean}{of}_flow_m3_s"))))
                .fold(0.0, f64::max),
            Scale::Angle => 1_f64.to_degrees(),
            Scale::Free => continue,
        };
        // An error of nothing is none, whatever the scale.
        let share = if *error == 0.0 { 0.0 } else { error / scale };
        relative.push((name.clone(), share));
    }
    relative.sort_by(|a, b| b.1.total_cmp(&a.1));
    relative
}
