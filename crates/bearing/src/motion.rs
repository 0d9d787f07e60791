//! Coordinates of a journal, and the weights of the time scheme that moves it.
//!
//! Equation: TR-BDF2 from `x0` over a step `T`, with g = 2 - sqrt 2: `x1 = x0 + g/2 T (x0' + x1')`
//! after `g T`, then `x2 = x0 + T (w x0' + w x1' + g/2 x2')`, w = sqrt 2 / 4. Second order, L-stable;
//! the third-order companion differs by `T` times [`ERROR_WEIGHTS`] times the three rates.
//! References: R. E. Bank et al., IEEE Trans. CAD 4 (1985) 436, 10.1109/TCAD.1985.1270142; M. E.
//! Hosea, L. F. Shampine, Appl. Numer. Math. 20 (1996) 21, 10.1016/0168-9274(95)00115-8.

use sommerfeld_film::JournalState;
use std::f64::consts::SQRT_2;

/// Position x, y (m) and tilt x, y (rad), or their rates.
pub type Coordinates = [f64; 4];

/// Share of the step that the trapezoidal stage of TR-BDF2 takes: 2 - sqrt 2.
pub const FIRST_STAGE: f64 = 2.0 - SQRT_2;
/// Diagonal weight of both implicit stages.
pub const DIAGONAL: f64 = 0.5 * FIRST_STAGE;
/// Weight of the first two rates in the last stage.
pub const WEIGHT: f64 = 0.25 * SQRT_2;
/// Weights of the solution minus those of the embedded third-order one.
pub const ERROR_WEIGHTS: [f64; 3] = [
    WEIGHT - (1.0 - WEIGHT) / 3.0,
    WEIGHT - (3.0 * WEIGHT + 1.0) / 3.0,
    DIAGONAL - DIAGONAL / 3.0,
];

/// Position and tilt of a state.
#[must_use]
pub fn coordinates(state: &JournalState) -> Coordinates {
    let ([x, y], [tilt_x, tilt_y]) = (state.position, state.tilt);
    [x, y, tilt_x, tilt_y]
}

/// `a + factor b`.
#[must_use]
pub fn add(a: Coordinates, factor: f64, b: Coordinates) -> Coordinates {
    [0, 1, 2, 3].map(|i| a[i] + factor * b[i])
}

/// Size of a displacement, m; tilts count by what they move at `arm` (m) from the mid-plane.
#[must_use]
pub fn length(displacement: Coordinates, arm: f64) -> f64 {
    let [x, y, tilt_x, tilt_y] = displacement;
    x.hypot(y).hypot(arm * tilt_x.hypot(tilt_y))
}

/// The state with other coordinates and rates.
#[must_use]
pub fn with_motion(frame: &JournalState, position: Coordinates, rate: Coordinates) -> JournalState {
    JournalState {
        position: [position[0], position[1]],
        tilt: [position[2], position[3]],
        velocity: [rate[0], rate[1]],
        tilt_rate: [rate[2], rate[3]],
        ..*frame
    }
}
