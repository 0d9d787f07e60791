//! `stability.csv`: a rigid rotor over speed, one row per speed.

use super::csv::{Table, begins_with, number};
use super::{OutputError, ResultWriter};
use crate::results::{Body, Results, SteadyResults, degrees, rpm, status_name};
use sommerfeld_bearing::{SpeedPoint, StabilityChart};
use sommerfeld_film::Outcome;

/// Writes `stability.csv`: equilibrium, stiffness, damping and whirl threshold per speed.
#[derive(Debug, Clone, Copy)]
pub struct StabilityTable;

impl ResultWriter for StabilityTable {
    fn file_name(&self) -> &'static str {
        "stability.csv"
    }

    fn describe(&self) -> &'static str {
        "stability chart: equilibrium, stiffness, damping and whirl threshold per speed"
    }

    fn is_own_table(&self, first_line: &str) -> bool {
        begins_with(first_line, COLUMNS)
    }

    fn content(&self, results: &Results) -> Result<Option<Vec<u8>>, OutputError> {
        let Body::Steady(steady) = &results.body else {
            return Ok(None);
        };
        let Some(dynamics) = &steady.dynamics else {
            return Ok(None);
        };
        dynamics
            .chart
            .as_ref()
            .map(|chart| table(steady, chart, dynamics.rotor_mass))
            .transpose()
    }
}

const COLUMNS: [&str; 19] = [
    "journal_speed[rad/s]",
    "journal_speed[rpm]",
    "relative_eccentricity[-]",
    "attitude_angle[deg]",
    "stiffness_xx[N/m]",
    "stiffness_xy[N/m]",
    "stiffness_yx[N/m]",
    "stiffness_yy[N/m]",
    "damping_xx[N.s/m]",
    "damping_xy[N.s/m]",
    "damping_yx[N.s/m]",
    "damping_yy[N.s/m]",
    "whirl_threshold_mass[kg]",
    "whirl_speed[rad/s]",
    "whirl_ratio[-]",
    "stability_margin[-]",
    "stable[-]",
    "whirl_threshold",
    "status",
];

fn table(
    steady: &SteadyResults,
    chart: &StabilityChart,
    rotor_mass: Option<f64>,
) -> Result<Vec<u8>, OutputError> {
    let mut table = Table::new(StabilityTable.file_name());
    table.row(COLUMNS)?;
    for point in &chart.points {
        let mut cells: Vec<String> = numbers(steady, point, rotor_mass).map(number).to_vec();
        let words = if point.outcome == Outcome::Converged {
            crate::results::stability_name(point.stability)
        } else {
            ""
        };
        cells.push(words.to_owned());
        cells.push(status_name(point.outcome).to_owned());
        table.row(cells)?;
    }
    table.finish()
}

/// The numbers of a row; none where there is no equilibrium. `stable` is 1 or 0.
fn numbers(steady: &SteadyResults, point: &SpeedPoint, rotor_mass: Option<f64>) -> [f64; 17] {
    let mut row = [f64::NAN; 17];
    row[0] = point.journal_speed;
    row[1] = rpm(point.journal_speed);
    if point.outcome != Outcome::Converged {
        return row;
    }
    let [x, y] = point.state.position;
    row[2] = x.hypot(y) / steady.bearing.radial_clearance;
    if let Some(load_angle) = steady.load_angle() {
        let (sin, cos) = load_angle.sin_cos();
        row[3] = degrees((y * cos - x * sin).atan2(x * cos + y * sin));
    }
    let matrices = [
        point.coefficients.translation_stiffness(),
        point.coefficients.translation_damping(),
    ];
    for (cell, value) in row[4..12]
        .iter_mut()
        .zip(matrices.iter().flatten().flatten())
    {
        *cell = *value;
    }
    if let Some(threshold) = point.stability.threshold() {
        row[12] = threshold.mass;
        row[13] = threshold.whirl_speed;
        row[14] = threshold.whirl_speed / point.journal_speed.abs();
    }
    if let Some(mass) = rotor_mass {
        row[15] = point.stability.margin(mass);
        row[16] = f64::from(u8::from(point.stability.is_stable(mass)));
    }
    row
}
