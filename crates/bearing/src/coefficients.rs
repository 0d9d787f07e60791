//! How stiff and how damped is the film around a journal state?
//!
//! Equation: `stiffness = -d(force)/d(position)`, `damping = -d(force)/d(velocity)`, from the film's
//! exact tangents; with tilt, moments by tilts too. Shell frame unless turned.
//!
//! What the film content does while the journal is displaced decides what these derivatives mean:
//! - **Films without content** (`gumbel`, `reynolds`, closed forms) answer to position and velocity
//!   alone, at rest as on an orbit.
//! - **At an equilibrium of a mass-conserving film** ([`Coefficients::from_tangent`]) they are those of
//!   slow motion: the content has time to become the steady one of the displaced journal, and the
//!   squeeze acts on the film fraction of the equilibrium.
//! - **At an instant of an orbit of a mass-conserving film** ([`instant_coefficients`]) there is no such
//!   time: the film content is that of the instant, and no cell changes sides. The full zone `Z` stays
//!   full, as an incompressible film must; the ruptured zone keeps its film fraction theta. The
//!   pressure of Z obeys `div(h^3/(12 eta) grad p) = U dh/dx + dh/dt` and takes in `U theta h` where it
//!   meets ruptured film, so
//! ```text
//! K = -dF/dq at fixed Z, theta and velocity        conduction, wedge and inflow at the displaced gap
//! C = -dF/dv at fixed Z, theta and position        squeeze of Z alone
//! ```
//!   Both come from one implicit step of a length d too short for transport, which starts from this
//!   content and at this state: its tangents are `by_rate = S` and `by_position = A + S/d`, where S is
//!   the squeeze and A everything else, so that `C = -S` and `K = -(by_position - by_rate/d)`. The
//!   part S/d of a displacement without time is what keeps Z full; it is no stiffness.
//!
//! Reference: J. W. Lund, K. K. Thomsen, Topics in Fluid Film Bearing and Rotor Bearing System
//! Design and Optimization, ASME 1978, p. 1.

use serde::{Deserialize, Serialize};
use sommerfeld_film::{
    Conditions, FilmError, FilmForce, FilmHistory, JournalState, Outcome, Step, Tangent,
};

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

/// Length of the step that shows a film with memory at an instant, as an angle of mean rotation (rad):
/// far below a cell, so that nothing is transported, and far above round-off.
const INSTANT: f64 = 1e-6;

/// Stiffness and damping at an instant of an orbit: at `state` (with its rates), from the film content
/// `instant` of that instant ([`FilmForce::instant`]). The film is left with another history.
///
/// # Errors
/// What the film refuses; that it does not settle is the [`Outcome`], and then the numbers are those of
/// its last iterate.
pub fn instant_coefficients(
    film: &mut dyn FilmForce,
    state: &JournalState,
    instant: &FilmHistory,
    conditions: &Conditions<'_>,
) -> Result<(Coefficients, Outcome), FilmError> {
    if !film.capabilities().has_history {
        let answer = film.react(state, Step::Steady, conditions)?;
        return Ok((Coefficients::from_tangent(&answer.tangent), answer.outcome));
    }
    let duration = INSTANT / state.mean_speed().abs().max(1.0);
    let step = Step::Implicit {
        duration,
        after: duration,
    };
    film.restore(instant);
    let answer = film.react(state, step, conditions)?;
    film.reject_step();
    let mut tangent = answer.tangent;
    for (row, squeeze) in tangent.by_position.iter_mut().zip(tangent.by_rate) {
        for (value, squeeze) in row.iter_mut().zip(squeeze) {
            *value -= squeeze / duration;
        }
    }
    Ok((Coefficients::from_tangent(&tangent), answer.outcome))
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
