//! A row of panels with decades on both axes, as SVG text.

use std::fmt::Write as _;

/// One line of a panel.
pub struct Series {
    pub name: &'static str,
    /// Time, s, and error.
    pub points: Vec<(f64, f64)>,
}

/// One case.
pub struct Panel {
    pub title: &'static str,
    pub series: Vec<Series>,
}

const WIDTH: f64 = 300.0;
const HEIGHT: f64 = 260.0;
const LEFT: f64 = 60.0;
const TOP: f64 = 40.0;
const GAP: f64 = 40.0;
const BOTTOM: f64 = 90.0;
/// Decades of the axes: of time, s, and of the error.
const TIMES: [i32; 2] = [-4, 2];
const ERRORS: [i32; 2] = [-6, -1];
/// Told apart with and without colour.
const STYLES: [(&str, &str); 3] = [("#0072b2", ""), ("#d55e00", "6 3"), ("#009e73", "2 3")];

/// The drawing.
pub fn svg(panels: &[Panel]) -> String {
    let width = LEFT + panels.len() as f64 * (WIDTH + GAP);
    let height = TOP + HEIGHT + BOTTOM;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    );
    for (k, panel) in panels.iter().enumerate() {
        let left = LEFT + k as f64 * (WIDTH + GAP);
        axes(&mut text, panel, left, k == 0);
        for (series, (colour, dashes)) in panel.series.iter().zip(STYLES) {
            line(&mut text, series, left, colour, dashes);
        }
    }
    let names = panels.iter().flat_map(|panel| &panel.series);
    for (k, (series, (colour, dashes))) in names.zip(STYLES).enumerate() {
        let (x, y) = (LEFT + 300.0 * k as f64, TOP + HEIGHT + 65.0);
        text += &format!(
            "<line x1=\"{x}\" y1=\"{y}\" x2=\"{}\" y2=\"{y}\" stroke=\"{colour}\" stroke-width=\"2\" \
             stroke-dasharray=\"{dashes}\"/>\n<text x=\"{}\" y=\"{}\">{}</text>\n",
            x + 40.0,
            x + 48.0,
            y + 4.0,
            series.name
        );
    }
    text + "</svg>\n"
}

fn place(value: f64, [low, high]: [i32; 2], length: f64) -> f64 {
    let share = (value.log10() - f64::from(low)) / f64::from(high - low);
    share.clamp(0.0, 1.0) * length
}

fn axes(text: &mut String, panel: &Panel, left: f64, has_label: bool) {
    let bottom = TOP + HEIGHT;
    for decade in TIMES[0]..=TIMES[1] {
        let x = left + place(10f64.powi(decade), TIMES, WIDTH);
        writeln!(
            text,
            "<line x1=\"{x:.1}\" y1=\"{TOP}\" x2=\"{x:.1}\" y2=\"{bottom}\" stroke=\"#ddd\"/>\
             <text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">1e{decade}</text>",
            bottom + 16.0
        )
        .unwrap();
    }
    for decade in ERRORS[0]..=ERRORS[1] {
        let y = bottom - place(10f64.powi(decade), ERRORS, HEIGHT);
        writeln!(
            text,
            "<line x1=\"{left}\" y1=\"{y:.1}\" x2=\"{}\" y2=\"{y:.1}\" stroke=\"#ddd\"/>\
             <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">1e{decade}</text>",
            left + WIDTH,
            left - 5.0,
            y + 4.0
        )
        .unwrap();
    }
    writeln!(
        text,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\
         <text x=\"{}\" y=\"{}\" text-anchor=\"middle\">time, s</text>",
        left + 0.5 * WIDTH,
        TOP - 12.0,
        panel.title,
        left + 0.5 * WIDTH,
        bottom + 36.0
    )
    .unwrap();
    if has_label {
        let y = TOP + 0.5 * HEIGHT;
        writeln!(
            text,
            "<text x=\"14\" y=\"{y}\" text-anchor=\"middle\" transform=\"rotate(-90 14 {y})\">\
             error of the force vector</text>"
        )
        .unwrap();
    }
}

fn line(text: &mut String, series: &Series, left: f64, colour: &str, dashes: &str) {
    let at = |(time, error): &(f64, f64)| {
        let x = left + place(*time, TIMES, WIDTH);
        (x, TOP + HEIGHT - place(*error, ERRORS, HEIGHT))
    };
    let path: Vec<String> = (series.points.iter().map(at))
        .map(|(x, y)| format!("{x:.1},{y:.1}"))
        .collect();
    writeln!(
        text,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" \
         stroke-dasharray=\"{dashes}\"/>",
        path.join(" ")
    )
    .unwrap();
    for (x, y) in series.points.iter().map(at) {
        writeln!(
            text,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>"
        )
        .unwrap();
    }
}
