//! Shapes of both parities across the width.

use crate::spectral::quadrature::{gauss_legendre, legendre};

/// Lines lie at `Z = sin(a t)/sin(a)`, t Gauss points: closer to the ends, near which integrands have
/// poles where a slanting gap would close.
const CROWDING: f64 = 1.2;

/// The shapes on lines of Gauss points around the bearing.
#[derive(Debug, Clone)]
pub(super) struct Widthwise<const M: usize, const G: usize> {
    pub lines: [Line<M>; G],
}

/// A line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line<const M: usize> {
    /// Z.
    pub place: f64,
    pub weight: f64,
    /// Values of the shapes.
    pub values: [f64; M],
    /// Their slopes by Z.
    pub slopes: [f64; M],
}

impl<const M: usize, const G: usize> Widthwise<M, G> {
    pub(super) fn new() -> Self {
        let points = gauss_legendre(G);
        let lines = std::array::from_fn(|g| {
            let [point, weight] = points[g];
            let (sin, cos) = (CROWDING * point).sin_cos();
            let place = sin / CROWDING.sin();
            let weight = weight * CROWDING * cos / CROWDING.sin();
            let shapes = shapes_at::<M>(place);
            Line {
                place,
                weight,
                values: shapes.map(|[value, _]| value),
                slopes: shapes.map(|[_, slope]| slope),
            }
        });
        Self { lines }
    }
}

/// (1 - Z^2) P_k(Z) and its slope, k = 0 to M - 1.
pub(super) fn shapes_at<const M: usize>(z: f64) -> [[f64; 2]; M] {
    std::array::from_fn(|k| {
        let (value, slope) = legendre(k, z);
        let bubble = (1.0 - z) * (1.0 + z);
        [bubble * value, bubble * slope - 2.0 * z * value]
    })
}
