//! Data of the figures, in the units they are drawn in, as JSON for the script.
//!
//! Long tables are thinned for drawing only: the CSV files hold every row.

use super::detail::Detail;
use super::format::{MICROMETRE, MILLIRADIAN, Unit, Units, angle};
use crate::limits::Quantity;
use crate::results::{
    CycleResults, Header, SteadyResults, degrees, degrees_around, magnitude, place,
};
use serde_json::{Value, json};
use sommerfeld_bearing::CyclePoint;
use sommerfeld_film::{Bearing, Carrier, Extreme, Feed, FeedShape};

/// More points than this on a curve are not seen.
pub(super) const CURVE_POINTS: usize = 1500;

/// A number for drawing: six significant digits, `null` where it is not finite.
pub(super) fn short(value: f64) -> Value {
    let text = format!("{value:.5e}");
    json!(text.parse::<f64>().ok().filter(|value| value.is_finite()))
}

/// Every n-th of `count`, so that at most about `wanted` remain, and always the last.
pub(super) fn thinned(count: usize, wanted: usize) -> Vec<usize> {
    let stride = count.div_ceil(wanted).max(1);
    let mut kept: Vec<usize> = (0..count).step_by(stride).collect();
    if count > 0 && kept.last() != Some(&(count - 1)) {
        kept.push(count - 1);
    }
    kept
}

/// Curves over crank angle, marks on orbit and load, extremes and limits.
pub(super) fn cycle_data(
    header: &Header,
    cycle: &CycleResults,
    units: &Units,
    detail: &Detail,
) -> Value {
    let points = &cycle.orbit.points;
    let kept = thinned(points.len(), detail.curve_points);
    let clearance = cycle.bearing.radial_clearance;
    let over = |unit: Unit, value: &dyn Fn(&CyclePoint) -> f64| -> Vec<f64> {
        kept.iter()
            .map(|&index| value(&points[index]) * unit.factor)
            .collect()
    };
    let curve = |unit: Unit, value: &dyn Fn(&CyclePoint) -> f64| detail.numbers(&over(unit, value));
    // What the script can make of other curves is not sent where many cycles share the page.
    let made = |unit: Unit, value: &dyn Fn(&CyclePoint) -> f64| {
        (!detail.is_packed).then(|| curve(unit, value))
    };
    let one = super::format::ONE;
    let tilted = points.iter().any(|point| point.state.tilt != [0.0, 0.0]);
    json!({
        "angle": detail.places(&over(one, &|p| degrees(p.crank_angle))),
        "load_x": curve(units.force, &|p| p.load[0]),
        "load_y": curve(units.force, &|p| p.load[1]),
        "load": made(units.force, &|p| magnitude(p.load)),
        "x": curve(one, &|p| p.state.position[0] / clearance),
        "y": curve(one, &|p| p.state.position[1] / clearance),
        "eccentricity": made(one, &|p| cycle.relative_eccentricity(p)),
        "thickness": curve(MICROMETRE, &|p| p.summary.minimum_film_thickness.value),
        "pressure": curve(units.pressure, &|p| p.summary.peak_film_pressure.value),
        "friction_power": curve(units.power, &|p| p.summary.friction_power),
        "squeeze_power": curve(units.power, &|p| p.summary.squeeze_power),
        "power": made(units.power, &|p| p.summary.power_loss()),
        "side_flow": made(units.flow, &|p| p.summary.side_flow[0] + p.summary.side_flow[1]),
        "feed_flow": curve(units.flow, &|p| p.summary.feed_flow),
        "storage": curve(units.flow, &|p| p.summary.storage_rate),
        "side_front": curve(units.flow, &|p| p.summary.side_flow[0]),
        "side_rear": curve(units.flow, &|p| p.summary.side_flow[1]),
        "journal_load_x": made(units.force, &|p| on_journal(p)[0]),
        "journal_load_y": made(units.force, &|p| on_journal(p)[1]),
        "journal_angle": curve(one, &|p| degrees(p.state.journal_angle)),
        "journal_speed": curve(one, &|p| p.state.journal_speed),
        "tilt_x": tilted.then(|| curve(MILLIRADIAN, &|p| p.state.tilt[0])),
        "tilt_y": tilted.then(|| curve(MILLIRADIAN, &|p| p.state.tilt[1])),
        "failed": failed(cycle),
        "marks": marks(cycle, units),
        "thinnest": cycle.minimum_film_thickness().map(|p| extreme_mark(p, units, true)),
        "highest": cycle.peak_film_pressure().map(|p| extreme_mark(p, units, false)),
        "thickness_limits": limits(header, Quantity::MinimumFilmThickness, MICROMETRE),
        "pressure_limits": limits(header, Quantity::PeakFilmPressure, units.pressure),
    })
}

/// The load of a point in the frame that turns with the journal, N.
fn on_journal(point: &CyclePoint) -> [f64; 2] {
    let (sin, cos) = point.state.journal_angle.sin_cos();
    let [x, y] = point.load;
    [cos * x + sin * y, cos * y - sin * x]
}

/// Crank angle, film thickness and eccentricity of the points whose step did not converge.
fn failed(cycle: &CycleResults) -> Value {
    let failed: Vec<&CyclePoint> = cycle.not_converged().collect();
    thinned(failed.len(), CURVE_POINTS)
        .into_iter()
        .map(|index| {
            let point = failed[index];
            let thickness = point.summary.minimum_film_thickness.value * MICROMETRE.factor;
            json!([
                short(degrees(point.crank_angle)),
                short(thickness),
                short(cycle.relative_eccentricity(point)),
            ])
        })
        .collect()
}

fn extreme_mark(point: &CyclePoint, units: &Units, is_thickness: bool) -> Value {
    let (value, unit) = if is_thickness {
        (point.summary.minimum_film_thickness.value, MICROMETRE)
    } else {
        (point.summary.peak_film_pressure.value, units.pressure)
    };
    let crank_angle = degrees(point.crank_angle);
    json!({
        "angle": short(crank_angle),
        "value": short(value * unit.factor),
        "label": format!("{} at {}", unit.show(value), angle(crank_angle)),
    })
}

pub(super) fn limits(header: &Header, quantity: Quantity, unit: Unit) -> Value {
    header
        .limits
        .iter()
        .filter(|check| check.limit.quantity == quantity)
        .map(|check| {
            json!({
                "value": short(check.limit.value * unit.factor),
                "label": format!("limit {}", unit.plain(check.limit.value)),
            })
        })
        .collect()
}

/// Load and position at every 90 deg of crank angle (an eighth of longer periods).
fn marks(cycle: &CycleResults, units: &Units) -> Value {
    let points = &cycle.orbit.points;
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return json!([]);
    };
    let (start, end) = (degrees(first.crank_angle), degrees(last.crank_angle));
    let spacing = ((end - start) / 8.0).max(90.0);
    let clearance = cycle.bearing.radial_clearance;
    let mut marks = Vec::new();
    let mut at = (start / spacing).ceil() * spacing;
    // The last point repeats the first one.
    while at < end - 1e-6 {
        let load = between(points, at, |p| p.load);
        let turned = between(points, at, on_journal);
        let position = between(points, at, |p| p.state.position);
        marks.push(json!({
            "label": angle(at),
            "angle": at,
            "load": load.map(|value| short(value * units.force.factor)),
            "journal_load": turned.map(|value| short(value * units.force.factor)),
            "position": position.map(|value| short(value / clearance)),
        }));
        at += spacing;
    }
    Value::Array(marks)
}

/// A plane vector at a crank angle in degrees, linear between the points.
fn between(
    points: &[CyclePoint],
    crank_angle: f64,
    value: impl Fn(&CyclePoint) -> [f64; 2],
) -> [f64; 2] {
    let next = points
        .partition_point(|point| degrees(point.crank_angle) < crank_angle)
        .clamp(1, points.len().max(2) - 1);
    let (Some(a), Some(b)) = (points.get(next - 1), points.get(next)) else {
        return points.first().map_or([f64::NAN; 2], value);
    };
    let (from, to) = (degrees(a.crank_angle), degrees(b.crank_angle));
    let share = if to > from {
        (crank_angle - from) / (to - from)
    } else {
        0.0
    };
    let (a, b) = (value(a), value(b));
    [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]))
}

/// The journal in the clearance circle with load and force on it.
pub(super) fn position_data(steady: &SteadyResults, units: &Units) -> Value {
    let clearance = steady.bearing.radial_clearance;
    let vector = |vector: [f64; 2]| {
        json!({
            "x": short(vector[0] * units.force.factor),
            "y": short(vector[1] * units.force.factor),
            "label": units.force.show(magnitude(vector)),
        })
    };
    json!({
        "x": short(steady.state.position[0] / clearance),
        "y": short(steady.state.position[1] / clearance),
        "load": steady.load.map(vector),
        "force": vector(steady.reaction.force()),
    })
}

/// A cell value in the mid-plane: where an even number of cells has none there, the mean of the
/// two beside it.
pub(super) fn mid_plane(values: &[f64], axial: &[f64], around: usize) -> f64 {
    let columns = axial.len();
    let cell = |j: usize| {
        values
            .get(around * columns + j)
            .copied()
            .unwrap_or(f64::NAN)
    };
    match axial.partition_point(|z| *z < 0.0) {
        0 => cell(0),
        above if above >= columns => cell(columns.saturating_sub(1)),
        above => {
            let (low, high) = (axial[above - 1], axial[above]);
            let share = -low / (high - low);
            cell(above - 1) * (1.0 - share) + cell(above) * share
        }
    }
}

pub(super) fn place_mark(extreme: &Extreme, unit: Unit) -> Value {
    let (degrees, axial) = place(extreme);
    json!({
        "angle": short(degrees),
        "axial": short(axial),
        "label": format!("{} at {}", unit.show(extreme.value), angle(degrees)),
    })
}

/// Outline of a feed on the developed surface of its carrier, degrees and mm.
pub(super) fn outline(feed: &Feed, bearing: &Bearing) -> Value {
    let (length, width, is_round) = match feed.shape {
        FeedShape::Hole { diameter } => (diameter, diameter, true),
        FeedShape::Rectangle { length, width } => (length, width, false),
        FeedShape::Circumferential { width } => {
            (std::f64::consts::PI * bearing.diameter, width, false)
        }
    };
    json!({
        "angle": short(degrees_around(feed.angle)),
        "axial": short(feed.position * 1e3),
        "half_length": short(degrees(0.5 * length / bearing.radius())),
        "half_width": short(width * 500.0),
        "round": is_round,
        "on_journal": feed.carried_by == Carrier::Journal,
    })
}

/// The symbols the axes carry.
pub(super) fn unit_symbols(units: &Units) -> Value {
    json!({
        "force": units.force.symbol,
        "pressure": units.pressure.symbol,
        "power": units.power.symbol,
        "flow": units.flow.symbol,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use sommerfeld_film::{FilmSummary, JournalState, Outcome, Reaction};

    #[test]
    fn a_load_that_turns_with_the_journal_stands_still_on_it() {
        let turned = 0.7f64;
        let point = CyclePoint {
            crank_angle: 0.0,
            load: [2.0 * turned.cos(), 2.0 * turned.sin()],
            moment: [0.0; 2],
            state: JournalState {
                journal_angle: turned,
                ..JournalState::default()
            },
            reaction: Reaction::default(),
            summary: FilmSummary::default(),
            outcome: Outcome::Converged,
        };
        let [x, y] = on_journal(&point);
        assert!((x - 2.0).abs() < 1e-12 && y.abs() < 1e-12);
    }

    #[test]
    fn thinning_keeps_both_ends() {
        assert_eq!(thinned(5, 2), [0, 3, 4]);
        assert_eq!(thinned(3, 10), [0, 1, 2]);
        assert!(thinned(0, 10).is_empty());
    }

    #[test]
    fn numbers_for_drawing_are_short_and_finite() {
        assert_eq!(short(1.0 / 3.0), json!(0.333333));
        assert_eq!(short(f64::INFINITY), Value::Null);
    }

    #[test]
    fn the_mid_plane_lies_between_cells() {
        let axial = [-1.0, 1.0];
        assert_eq!(mid_plane(&[1.0, 3.0, 5.0, 9.0], &axial, 1), 7.0);
        assert_eq!(mid_plane(&[4.0], &[0.0], 0), 4.0);
    }
}
