//! Indicator diagrams and peak pressures of an engine: CSV with the unit of each column in its header.
//!
//! `crank_angle[deg],pressure[bar]`: angles ascend, start anywhere and cover one working cycle; the last
//! row may lie one cycle from the first. Which angle is the firing top dead centre, what the encoder
//! reads too low and whether pressures are gauge is said by the study. `speed[rpm],peak_pressure[bar]`:
//! speeds ascend.

use super::csv_table::{CsvTable, Layout, read_table};
use super::error::InputError;
use super::units::Dimension;
use sommerfeld_engine::{Closure, Convention, DiagramError, IndicatorDiagram, Seam, Sense};

/// A closing step above this share of the range is a warning: a cycle of a good measurement closes
/// within a tenth of it.
const CLOSING_STEP: f64 = 0.01;
/// No engine fires above this, Pa: twice what diesels of today do.
const HIGHEST_PRESSURE: f64 = 5e7;
/// A peak below this, Pa, is no engine at work but a column in another unit.
const LOW_PEAK: f64 = 5e5;
/// Throttled engines draw at 0.2 bar and above; a diagram far below is gauge, Pa.
const LOW_INTAKE: f64 = 1e4;

const ANGLE: usize = 0;
const PRESSURE: usize = 1;
const DIAGRAM: Layout<2> = Layout {
    what: "indicator diagram",
    columns: [
        ("crank_angle", Dimension::Angle),
        ("pressure", Dimension::Pressure),
    ],
    required: 2,
    together: &[],
    header: "crank_angle[deg],pressure[bar]",
};
const PEAKS: Layout<2> = Layout {
    what: "table of peak pressures",
    columns: [
        ("speed", Dimension::AngularSpeed),
        ("peak_pressure", Dimension::Pressure),
    ],
    required: 2,
    together: &[],
    header: "speed[rpm],peak_pressure[bar]",
};

/// What the study says about a file with an indicator diagram.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiagramSettings {
    /// Crank angle of one working cycle, rad.
    pub period: f64,
    /// Angle of the firing top dead centre in the file, rad, after the shift.
    pub firing_tdc: f64,
    /// Added to every angle of the file, rad.
    pub shift: f64,
    /// Ambient pressure, Pa, where the file holds gauge pressures; `None`: they are absolute.
    pub gauge_ambient: Option<f64>,
    /// Half-width over which the diagram is smoothed, rad; `None`: it is not.
    pub smoothing: Option<f64>,
}

/// Reads an indicator diagram; with what the user should know.
///
/// # Errors
/// Every error found, the first few with their lines.
pub fn read_diagram(
    file: &str,
    text: &str,
    settings: &DiagramSettings,
) -> Result<(IndicatorDiagram, Vec<InputError>), Vec<InputError>> {
    let table = read_table(file, text, &DIAGRAM)?;
    let errors = table.not_ascending(ANGLE, "crank angle");
    if !errors.is_empty() {
        return Err(errors);
    }
    let ambient = settings.gauge_ambient.unwrap_or(0.0);
    in_range(&table, ambient).map_err(|error| vec![error])?;
    let rows: Vec<[f64; 2]> = table.rows.iter().map(|row| row.values).collect();
    let convention = Convention {
        period: settings.period,
        firing_tdc: settings.firing_tdc,
        shift: settings.shift,
        gauge_ambient: settings.gauge_ambient,
        sense: Sense::Along,
        seam: Seam::Keep,
    };
    let refused = |error| vec![explained(file, &table, settings, error)];
    let (diagram, closure) =
        IndicatorDiagram::from_measured(&rows, &convention).map_err(refused)?;
    let warnings = warnings(file, &diagram, closure, settings);
    match settings.smoothing {
        Some(half_width) => diagram.smoothed(half_width).map_err(refused),
        None => Ok(diagram),
    }
    .map(|diagram| (diagram, warnings))
}

/// Reads peak pressures (absolute, Pa) over the speed (rad/s). `gauge_ambient` is added where the file
/// holds gauge pressures.
///
/// # Errors
/// Every error found, the first few with their lines.
pub fn read_peaks(
    file: &str,
    text: &str,
    gauge_ambient: Option<f64>,
) -> Result<Vec<[f64; 2]>, Vec<InputError>> {
    let table = read_table(file, text, &PEAKS)?;
    let errors = table.not_ascending(0, "speed");
    if !errors.is_empty() {
        return Err(errors);
    }
    if let Some(row) = table.rows.iter().find(|row| row.values[0] <= 0.0) {
        let error = table.error_at(row, 0, "`speed` is not above 0");
        return Err(vec![error.allowing("above 0 rpm")]);
    }
    let ambient = gauge_ambient.unwrap_or(0.0);
    in_range(&table, ambient).map_err(|error| vec![error])?;
    let peak = |row: &[f64; 2]| [row[0], row[1] + ambient];
    let peaks: Vec<[f64; 2]> = table.rows.iter().map(|row| peak(&row.values)).collect();
    match table
        .rows
        .iter()
        .zip(&peaks)
        .find(|(_, peak)| peak[1] < LOW_PEAK)
    {
        Some((row, _)) => Err(vec![
            table
                .error_at(row, PRESSURE, "`peak_pressure` is out of range")
                .allowing(format!("{} bar and above", LOW_PEAK / 1e5))
                .hinting("the unit stands in the header of the column: is it right?"),
        ]),
        None => Ok(peaks),
    }
}

/// No pressure is beyond engines.
fn in_range(table: &CsvTable<'_, 2>, ambient: f64) -> Result<(), InputError> {
    let beyond = |pressure: f64| pressure + ambient > HIGHEST_PRESSURE;
    match table.rows.iter().find(|row| beyond(row.values[PRESSURE])) {
        Some(row) => Err(table
            .error_at(row, PRESSURE, "the gas pressure is out of range")
            .allowing(format!("up to {} bar", HIGHEST_PRESSURE / 1e5))
            .hinting("the unit stands in the header of the column: is it right?")),
        None => Ok(()),
    }
}

/// A number as it is shown in messages.
fn round(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

/// The error with its place in the file, what is allowed and what to do.
fn explained(
    file: &str,
    table: &CsvTable<'_, 2>,
    settings: &DiagramSettings,
    error: DiagramError,
) -> InputError {
    let period = round(settings.period.to_degrees());
    let at = |row: usize, column: usize, message: String| match table.rows.get(row) {
        Some(row) => table.error_at(row, column, message),
        None => InputError::new(file, message),
    };
    let last = table.rows.len().saturating_sub(1);
    let (first_line, last_line) = (
        table.rows.first().map_or(0, |row| row.line()),
        table.rows.last().map_or(0, |row| row.line()),
    );
    match error {
        DiagramError::CoversLess { covered, .. } => {
            let message = format!(
                "the indicator diagram covers {} of {period} deg (line {first_line} to line {last_line})",
                round(covered.to_degrees())
            );
            at(last, ANGLE, message)
                .allowing(format!("one working cycle, {period} deg"))
                .hinting(
                    "a missing end is not guessed: give the whole cycle; its last row may repeat the \
                     first one, a cycle on",
                )
        }
        DiagramError::CoversMore { covered, .. } => {
            let message = format!(
                "the indicator diagram covers {} deg, more than a cycle of {period} deg",
                round(covered.to_degrees())
            );
            at(last, ANGLE, message)
                .allowing(format!("one working cycle, {period} deg"))
                .hinting("cut one cycle out, or give the mean of the cycles; is the number of strokes right?")
        }
        DiagramError::BelowVacuum { row, pressure } => {
            let message = format!("the gas pressure is {} bar absolute", round(pressure / 1e5));
            let hint = match settings.gauge_ambient {
                None => "a pressure below 0 is a gauge pressure: say so, with the ambient pressure",
                Some(_) => "the gauge pressure lies below the ambient pressure: are both right?",
            };
            at(row, PRESSURE, message)
                .allowing("0 bar and above")
                .hinting(hint)
        }
        DiagramError::PeakMisplaced { peak, shift } => misplaced(table, settings, peak, shift),
        DiagramError::TooFewPoints { points } => {
            let message = format!("the indicator diagram has {points} rows only");
            at(last, ANGLE, message).hinting("give a row for every few degrees")
        }
        DiagramError::Open { share } => {
            let message = format!(
                "the pressure steps by {:.0} % of its range where the cycle closes \
                 (line {last_line} to line {first_line})",
                100.0 * share
            );
            at(last, PRESSURE, message).hinting("both ends must be of one cycle: check them")
        }
        other => InputError::new(file, other.to_string()),
    }
}

/// A peak far from the firing top dead centre, with the angle that would set it right.
fn misplaced(
    table: &CsvTable<'_, 2>,
    settings: &DiagramSettings,
    peak: f64,
    shift: f64,
) -> InputError {
    let highest = table.rows.iter().reduce(|best, row| {
        if row.values[PRESSURE] > best.values[PRESSURE] {
            row
        } else {
            best
        }
    });
    let firing = round(settings.firing_tdc.to_degrees());
    let mut right = (settings.firing_tdc + shift).to_degrees();
    let period = settings.period.to_degrees();
    let first = table
        .rows
        .first()
        .map_or(0.0, |row| row.values[ANGLE].to_degrees());
    right = first + (right - first + 1e-6).rem_euclid(period) - 1e-6;
    let message = format!(
        "the peak of the indicator diagram lies {} deg from the firing top dead centre at {firing} deg",
        round(peak.to_degrees().abs())
    );
    let hint = format!(
        "in this file the cylinder fires near {} deg: give that as its firing top dead centre",
        round(right)
    );
    let error = match highest {
        Some(row) => table.error_at(row, ANGLE, message),
        None => table.error_in_header(ANGLE, message),
    };
    error
        .allowing("a peak within 90 deg of firing")
        .hinting(hint)
}

fn warnings(
    file: &str,
    diagram: &IndicatorDiagram,
    closure: Closure,
    settings: &DiagramSettings,
) -> Vec<InputError> {
    let mut found = Vec::new();
    if closure.share > CLOSING_STEP {
        let message = format!(
            "the pressure steps by {:.3} bar, {:.1} % of its range, where the cycle closes",
            closure.step / 1e5,
            100.0 * closure.share
        );
        let hint = "the step stays in the diagram; check both ends and the drift of the sensor";
        found.push(InputError::new(file, message).hinting(hint));
    }
    let peak = diagram.peak()[1];
    if peak < LOW_PEAK {
        let message = format!("the highest gas pressure is {:.3} bar only", peak / 1e5);
        let hint = "the unit stands in the header of the column: is it right?";
        found.push(InputError::new(file, message).hinting(hint));
    }
    let lowest = diagram.lowest();
    if lowest < LOW_INTAKE && settings.gauge_ambient.is_none() {
        let message = format!(
            "the lowest gas pressure is {:.3} bar absolute",
            lowest / 1e5
        );
        let hint = "are the pressures gauge? then say so, with the ambient pressure";
        found.push(InputError::new(file, message).hinting(hint));
    }
    found
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};
    use std::fmt::Write as _;

    const SETTINGS: DiagramSettings = DiagramSettings {
        period: 2.0 * TAU,
        firing_tdc: TAU,
        shift: 0.0,
        gauge_ambient: None,
        smoothing: None,
    };

    /// A bell about `firing` deg over angles from 0 to `end`, in bar.
    fn bell(firing: f64, end: usize, low: f64) -> String {
        let mut text = "crank_angle[deg],pressure[bar]\n".to_owned();
        for angle in (0..=end).step_by(5) {
            let away = (angle as f64 - firing + 360.0).rem_euclid(720.0) - 360.0;
            writeln!(
                text,
                "{angle},{}",
                low + 80.0 * (-(away / 40.0).powi(2)).exp()
            )
            .unwrap();
        }
        text
    }

    #[test]
    fn angle_conventions_gauge_and_shift_meet_in_one_diagram() {
        let (absolute, warnings) =
            read_diagram("p.csv", &bell(365.0, 720, 1.0), &SETTINGS).unwrap();
        assert!(warnings.is_empty(), "{warnings:?}");
        let [angle, pressure] = absolute.peak();
        assert!((angle - 5.0 * PI / 180.0).abs() < 1e-12);
        assert!((pressure - 81e5).abs() < 1e-6);
        let gauge = DiagramSettings {
            firing_tdc: 0.0,
            shift: -5.0 * PI / 180.0,
            gauge_ambient: Some(1e5),
            ..SETTINGS
        };
        let (gauge, _) = read_diagram("p.csv", &bell(10.0, 720, 0.0), &gauge).unwrap();
        for angle in 0..1440 {
            let angle = 0.01 * f64::from(angle);
            assert!((absolute.at(angle) - gauge.at(angle)).abs() < 1e-3);
        }
    }

    #[test]
    fn smoothing_keeps_the_peak() {
        let smooth = DiagramSettings {
            smoothing: Some(20.0 * PI / 180.0),
            ..SETTINGS
        };
        let text = bell(365.0, 720, 1.0);
        let (raw, _) = read_diagram("p.csv", &text, &SETTINGS).unwrap();
        let (smoothed, _) = read_diagram("p.csv", &text, &smooth).unwrap();
        assert_eq!(raw.peak(), smoothed.peak());
        assert_ne!(raw, smoothed);
    }

    fn refused(text: &str, settings: &DiagramSettings) -> InputError {
        read_diagram("p.csv", text, settings).unwrap_err().remove(0)
    }

    #[test]
    fn what_is_no_cycle_is_refused_with_its_line_and_a_hint() {
        let short = refused(&bell(365.0, 700, 1.0), &SETTINGS);
        assert!(short.message.contains("covers 700 of 720 deg"), "{short}");
        assert_eq!(short.place.as_ref().unwrap().line, 142);
        let wrong = DiagramSettings {
            firing_tdc: 0.0,
            ..SETTINGS
        };
        let wrong = refused(&bell(365.0, 720, 1.0), &wrong);
        assert!(wrong.message.contains("355 deg from the firing"), "{wrong}");
        assert!(wrong.hint.unwrap().contains("fires near 360 deg"));
        let two_stroke = DiagramSettings {
            period: TAU,
            ..SETTINGS
        };
        let long = refused(&bell(365.0, 720, 1.0), &two_stroke);
        assert!(
            long.message.contains("more than a cycle of 360 deg"),
            "{long}"
        );
        let gauge = refused(&bell(365.0, 720, -0.5), &SETTINGS);
        assert!(gauge.message.contains("-0.5 bar absolute"), "{gauge}");
        assert!(gauge.hint.unwrap().contains("gauge"));
        let unit = refused(&bell(365.0, 720, 1.0).replace("bar", "MPa"), &SETTINGS);
        assert!(unit.message.contains("out of range"), "{unit}");
    }

    #[test]
    fn an_open_cycle_and_a_low_one_are_warnings() {
        let open = bell(365.0, 720, 1.0).replace("\n720,1\n", "\n720,3\n");
        let (diagram, warnings) = read_diagram("p.csv", &open, &SETTINGS).unwrap();
        assert!(
            warnings[0].message.contains("steps by -2.000 bar, 2.5 %"),
            "{warnings:?}"
        );
        assert!((diagram.before(TAU) - 3e5).abs() < 1e-6 && (diagram.at(TAU) - 1e5).abs() < 1e-6);
        let (_, warnings) = read_diagram("p.csv", &bell(365.0, 720, 0.0), &SETTINGS).unwrap();
        assert!(
            warnings[0].hint.as_ref().unwrap().contains("gauge"),
            "{warnings:?}"
        );
    }

    #[test]
    fn peaks_over_speed() {
        let text = "speed[rpm],peak_pressure[MPa]\n1000,14\n2000,15\n";
        let peaks = read_peaks("peaks.csv", text, None).unwrap();
        assert!((peaks[1][0] - 2000.0 * PI / 30.0).abs() < 1e-9 && peaks[1][1] == 15e6);
        let low = read_peaks("peaks.csv", &text.replace("MPa", "kPa"), None).unwrap_err();
        assert!(low[0].message.contains("out of range"));
        let falling = "speed[rpm],peak_pressure[MPa]\n2000,14\n1000,15\n";
        let falling = read_peaks("peaks.csv", falling, None).unwrap_err();
        assert!(
            falling[0].message.contains("the speed falls"),
            "{falling:?}"
        );
    }
}
