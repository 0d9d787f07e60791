//! A small curve beside a key figure: its course over the cycle, as the path of an SVG picture.

use serde::Serialize;

/// Width of the picture in its own units; the page stretches it.
const WIDTH: f64 = 200.0;
/// Height of the picture in its own units.
const HEIGHT: f64 = 40.0;
/// Free space above and below, so that the line is not cut.
const MARGIN: f64 = 3.0;
/// More points are not seen.
const POINTS: usize = 181;

/// A small curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Spark {
    /// Commands of the line.
    pub line: String,
    /// Commands of the area below it.
    pub area: String,
    /// Place of the mark on the value shown, in percent of width and height; none for a mean.
    pub mark: Option<[f64; 2]>,
    /// Height of the limit in the picture, if it lies within.
    pub limit: Option<f64>,
}

/// The curve of `values` over `places`, from zero up; `at` marks one place.
/// `None` where there are no two finite values.
pub(super) fn spark(
    places: &[f64],
    values: &[f64],
    at: Option<f64>,
    limit: Option<f64>,
) -> Option<Spark> {
    let (first, last) = (*places.first()?, *places.last()?);
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let low = finite().fold(0.0, f64::min);
    let high = finite().fold(f64::NEG_INFINITY, f64::max);
    if high.partial_cmp(&low) != Some(std::cmp::Ordering::Greater) || last <= first {
        return None;
    }
    let x = |place: f64| (place - first) / (last - first) * WIDTH;
    let y = |value: f64| HEIGHT - MARGIN - (value - low) / (high - low) * (HEIGHT - 2.0 * MARGIN);
    let stride = places.len().div_ceil(POINTS).max(1);
    let points: Vec<String> = places
        .iter()
        .zip(values)
        .step_by(stride)
        .filter(|(_, value)| value.is_finite())
        .map(|(place, value)| format!("{:.1} {:.1}", x(*place), y(*value)))
        .collect();
    let line = format!("M{}", points.join("L"));
    let mark = at.and_then(|at| {
        let nearest = (0..places.len())
            .filter(|&i| values.get(i).is_some_and(|value| value.is_finite()))
            .min_by(|&a, &b| (places[a] - at).abs().total_cmp(&(places[b] - at).abs()))?;
        let percent = |part: f64, whole: f64| (1000.0 * part / whole).round() / 10.0;
        Some([
            percent(x(places[nearest]), WIDTH),
            percent(y(values[nearest]), HEIGHT),
        ])
    });
    Some(Spark {
        area: format!("{line}L{WIDTH} {HEIGHT}L0 {HEIGHT}Z"),
        line,
        mark,
        limit: limit
            .filter(|limit| (low..=high).contains(limit))
            .map(|limit| (10.0 * y(limit)).round() / 10.0),
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    #[test]
    fn a_curve_runs_from_edge_to_edge() {
        let spark = spark(&[0.0, 1.0, 2.0], &[0.0, 4.0, 2.0], Some(1.0), Some(2.0)).unwrap();
        assert_eq!(spark.line, "M0.0 37.0L100.0 3.0L200.0 20.0");
        assert_eq!(spark.mark, Some([50.0, 7.5]));
        assert_eq!(spark.limit, Some(20.0));
    }

    #[test]
    fn nothing_to_draw_is_no_curve() {
        assert_eq!(spark(&[], &[], None, None), None);
        assert_eq!(spark(&[0.0, 1.0], &[f64::NAN; 2], None, None), None);
    }
}
