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

/// The same of any film, with the place of the peak.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct FilmFigures {
    /// Largest pressure, 1/s.
    pub peak: f64,
    /// Its angle in the frame that the film was solved in, rad.
    pub peak_angle: f64,
    /// Its Z.
    pub peak_place: f64,
    /// Flow out of the ends Z = -1 and Z = 1 over c R^2 D/B, 1/s.
    pub end_flow: [f64; 2],
    /// Share of the surface under pressure.
    pub full_film_share: f64,
}

impl From<AlignedFigures> for FilmFigures {
    fn from(aligned: AlignedFigures) -> Self {
        Self {
            peak: aligned.peak,
            peak_angle: aligned.peak_angle,
            peak_place: 0.0,
            end_flow: [aligned.end_flow; 2],
            full_film_share: aligned.full_film_share,
        }
    }
}
