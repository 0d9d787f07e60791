//! How stiff and how damped is the film around a journal state?
//!
//! Equation: `stiffness = -d(force)/d(position)`, `damping = -d(force)/d(velocity)`, from the film's
//! exact tangents; with tilt, moments by tilts too. Shell frame unless turned.
//! Reference: J. W. Lund, K. K. Thomsen, Topics in Fluid Film Bearing and Rotor Bearing System
//! Design and Optimization, ASME 1978, p. 1.

use serde::{Deserialize, Serialize};
use sommerfeld_film::Tangent;

/// Stiffness and damping of the film. Rows: force x, y (N), moment x, y (N m); columns: position
/// x, y (m), tilt x, y (rad), or their rates.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Coefficients {
    /// N/m, N/rad, N m/m, N m/rad.
    pub stiffness: [[f64; 4]; 4],
    /// N s/m, N s/rad, N m s/m, N m s/rad.
    pub damping: [[f64; 4]; 4],
}

impl Coefficients {
    /// From the derivatives of a steady film.
    #[must_use]
    pub fn from_tangent(tangent: &Tangent) -> Self {
        let negative = |matrix: [[f64; 4]; 4]| matrix.map(|row| row.map(|value| -value));
        Self {
            stiffness: negative(tangent.by_position),
            damping: negative(tangent.by_rate),
        }
    }

    /// Stiffness of the aligned journal, N/m.
    #[must_use]
    pub fn translation_stiffness(&self) -> [[f64; 2]; 2] {
        leading(&self.stiffness)
    }

    /// Damping of the aligned journal, N s/m.
    #[must_use]
    pub fn translation_damping(&self) -> [[f64; 2]; 2] {
        leading(&self.damping)
    }

    /// The same coefficients in a frame turned by `angle` (rad) from the shell frame, for example x
    /// along the load and y 90 degrees ahead.
    #[must_use]
    pub fn turned(&self, angle: f64) -> Self {
        Self {
            stiffness: turn(&self.stiffness, angle),
            damping: turn(&self.damping, angle),
        }
    }
}

fn leading(matrix: &[[f64; 4]; 4]) -> [[f64; 2]; 2] {
    [0, 1].map(|row| [matrix[row][0], matrix[row][1]])
}

/// `R^T A R` block by block: positions and tilts both turn as vectors.
fn turn(matrix: &[[f64; 4]; 4], angle: f64) -> [[f64; 4]; 4] {
    let (sin, cos) = angle.sin_cos();
    let rotate = |[x, y]: [f64; 2]| [x * cos + y * sin, y * cos - x * sin];
    let mut columns_turned = *matrix;
    for row in &mut columns_turned {
        let ([x, y], [tilt_x, tilt_y]) = (rotate([row[0], row[1]]), rotate([row[2], row[3]]));
        *row = [x, y, tilt_x, tilt_y];
    }
    let mut turned = columns_turned;
    for column in 0..4 {
        for block in [0, 2] {
            let pair = [
                columns_turned[block][column],
                columns_turned[block + 1][column],
            ];
            [turned[block][column], turned[block + 1][column]] = rotate(pair);
        }
    }
    turned
}
