//! A plain figure of curves or points that needs no drawing of its own in the script.
//!
//! To add one: build a [`Chart`], put `chart.data()` under `"charts"` and its name in the data of
//! the figures, and list a [`Figure`](super::page::Figure) whose kind is that name.

use super::detail::Detail;
use serde_json::{Value, json};

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    /// A line.
    Line,
    /// Dots.
    Dots,
    /// Bars.
    Bars,
}

/// One curve of a chart.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Series {
    /// Its name in the legend.
    pub name: String,
    /// Places, in the unit of the axis; none for the crank angles of the cycle's curves.
    pub x: Option<Vec<f64>>,
    /// Values, in the unit of the axis; a gap where not finite.
    pub y: Vec<f64>,
    /// How it is drawn.
    pub mark: Mark,
}

/// Curves over one axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chart {
    /// Title of the axis to the right with its unit in brackets.
    pub x_title: String,
    /// Title of the axis upwards with its unit in brackets.
    pub y_title: String,
    /// Ends of the axis upwards; none to follow the curves.
    pub y_range: Option<[f64; 2]>,
    /// The curves.
    pub series: Vec<Series>,
}

impl Chart {
    /// The chart for the script.
    pub fn data(&self, detail: &Detail) -> Value {
        let series = self.series.iter().map(|series| {
            json!({
                "name": series.name,
                "x": series.x.as_deref().map(|places| detail.numbers(places)),
                "y": detail.numbers(&series.y),
                "mark": match series.mark { Mark::Line => "line", Mark::Dots => "dots", Mark::Bars => "bars" },
            })
        });
        json!({
            "x_title": self.x_title,
            "y_title": self.y_title,
            "y_range": self.y_range,
            "series": series.collect::<Value>(),
        })
    }
}
