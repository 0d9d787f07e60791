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
//!   time. The full zone stays full, as an incompressible film must, the rest keeps the oil it has, and
//!   no cell changes sides. With the content `m = theta h` of the ruptured zone frozen, the pressure
//!   obeys `div(h^3/(12 eta) grad p) = U dh/dx + dh/dt` in the full zone `Z` and takes in `U m` where oil
//!   meets it, so
//! ```text
//! K = -dF/dq at fixed Z, m and velocity        conduction and wedge of Z at the displaced gap
//! C = -dF/dv at fixed Z, m and position        squeeze of Z alone
//! ```
//!   They are found from implicit steps of length d that start from this content: with the state in the
//!   middle of the step, the tangents are `by_rate = S(d)/2` and `by_position = A + S(d)/d`, where
//!   `S(d) = S_Z + d B + O(d^2)`: the squeeze of Z, and what the ruptured cells, whose fraction falls
//!   as their gap opens, take from the inflow. Two short steps separate `C = -S_Z` from `K = -(A + B)`.
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

/// Length of the steps that show a film with memory at an instant, as an angle of mean rotation (rad):
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
    let speed = state.mean_speed().abs().max(1.0);
    let duration = INSTANT / speed;
    film.restore(instant);
    let mut outcome = Outcome::Converged;
    let mut tangent_after = |duration: f64| -> Result<Tangent, FilmError> {
        let half = 0.5 * duration;
        let moved = |at: [f64; 2], rate: [f64; 2]| [0, 1].map(|i| at[i] + half * rate[i]);
        let middle = JournalState {
            position: moved(state.position, state.velocity),
            tilt: moved(state.tilt, state.tilt_rate),
            ..*state
        };
        let step = Step::Implicit {
            duration,
            after: half,
        };
        let answer = film.react(&middle, step, conditions)?;
        film.reject_step();
        if answer.outcome != Outcome::Converged {
            outcome = answer.outcome;
        }
        Ok(answer.tangent)
    };
    let (short, long) = (tangent_after(duration)?, tangent_after(2.0 * duration)?);
    // by_rate holds half of S(d).
    let entry = |row: usize, column: usize| {
        let of_short = 2.0 * short.by_rate[row][column];
        let of_long = 2.0 * long.by_rate[row][column];
        let squeeze = 2.0 * of_short - of_long;
        [
            -(short.by_position[row][column] - squeeze / duration),
            -squeeze,
        ]
    };
    let matrix = |which: usize| {
        std::array::from_fn(|row| std::array::from_fn(|column| entry(row, column)[which]))
    };
    let coefficients = Coefficients {
        stiffness: matrix(0),
        damping: matrix(1),
    };
    Ok((coefficients, outcome))
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
