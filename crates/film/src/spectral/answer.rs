//! What the film of an aligned journal answers, without units: pressures over 12 eta R^2/c^2, motion over
//! c, the angle theta from the narrowest gap, Z = 2z/B.

/// Force on the journal along and across the line of centres with its derivatives: `-int int p n
/// dtheta dZ`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct AlignedForce {
    /// Along the line of centres, towards the narrowest gap, and across it, 1/s.
    pub force: [f64; 2],
    /// Its derivative by relative eccentricity at fixed motion, 1/s.
    pub by_eccentricity: [f64; 2],
    /// Its derivative by the motion along and across, rows as the force.
    pub by_motion: [[f64; 2]; 2],
}

/// What else a designer asks of an aligned film.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct AlignedFigures {
    /// Largest pressure, 1/s; it lies in the mid-plane.
    pub peak: f64,
    /// Its angle from the line of centres, rad.
    pub peak_angle: f64,
    /// `-int H^3 dp/dZ dtheta` at one end, 1/s: flow there over c R^2 D/B.
    pub end_flow: f64,
    /// Share of the surface under pressure.
    pub full_film_share: f64,
}
