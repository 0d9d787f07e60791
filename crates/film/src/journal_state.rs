//! How the journal moves: position, tilt, their rates and the speeds of both surfaces.

use serde::{Deserialize, Serialize};

/// Position and motion of the journal in the shell frame at one instant.
///
/// The journal centre at axial position `z` is `(x + ty z, y - tx z)` with position `(x, y)` and
/// tilt `(tx, ty)`, the small rotation vector of the journal axis against the shell axis.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct JournalState {
    /// Journal centre in the mid-plane, shell frame, m.
    pub position: [f64; 2],
    /// Rotation vector of the journal axis about X and Y, rad.
    pub tilt: [f64; 2],
    /// Velocity of the journal centre in the mid-plane, m/s.
    pub velocity: [f64; 2],
    /// Rate of the tilt, rad/s.
    pub tilt_rate: [f64; 2],
    /// Angular speed of the journal surface relative to the shell frame, rad/s.
    pub journal_speed: f64,
    /// Angular speed of the shell surface relative to the shell frame, rad/s; 0 for a shell that
    /// carries the frame.
    pub shell_speed: f64,
    /// Angle the journal has turned since its +X lay on the frame's +X, rad: it places what the
    /// journal carries (holes, grooves).
    pub journal_angle: f64,
    /// The same for the shell surface, rad.
    pub shell_angle: f64,
}

impl JournalState {
    /// Distance of the journal centre from the shell centre in the mid-plane, m.
    #[must_use]
    pub fn eccentricity(&self) -> f64 {
        self.position[0].hypot(self.position[1])
    }

    /// Angle from +X to the narrowest gap in the mid-plane, rad; 0 for a centred journal.
    #[must_use]
    pub fn line_of_centres_angle(&self) -> f64 {
        self.position[1].atan2(self.position[0])
    }

    /// Journal centre in the plane at axial position `z`, m.
    #[must_use]
    pub fn centre_at(&self, z: f64) -> [f64; 2] {
        [
            self.position[0] + self.tilt[1] * z,
            self.position[1] - self.tilt[0] * z,
        ]
    }

    /// Mean angular speed of the two surfaces, rad/s: the speed at which the film is dragged along.
    #[must_use]
    pub fn mean_speed(&self) -> f64 {
        0.5 * (self.journal_speed + self.shell_speed)
    }
}
