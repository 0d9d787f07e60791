//! A force on a shaft at one place.

/// Force on a shaft at one place of its axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShaftForce {
    /// Axial position, m.
    pub axial: f64,
    /// Force on the shaft along x and y of the fixed frame, N.
    pub force: [f64; 2],
}
