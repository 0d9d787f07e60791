//! The profiles of bore and journal where the gap needs them.
//!
//! As the plain gap, a profile is taken at faces and as its exact mean around each cell (in the
//! middle of the cell along the axis). It is evaluated anew when its surface has turned. A profile that
//! turns moves the gap: with the surface speeds `w_J` and `w_S`,
//!
//! ```text
//! dh/dt = w_J d(journal)/d(angle) - w_S d(bore)/d(angle)
//! ```
//! whose exact mean over a cell is the difference between its faces. What the transport at the mean
//! speed sees of a profile is the same difference, so that a frame that turns with the surfaces has
//! the same film to round-off.
//!
//! Where the bore steps at a face, as between offset halves, the two half cells conduct in series. A
//! step inside a cell, as on a shell that has turned in its frame, is a first-order error.

use crate::bearing::Bearing;
use crate::gap::{Gap, GapStep};
use crate::grid::Grid;
use crate::journal_state::JournalState;
use crate::shape::Shape;

/// Half the angle over which a step is looked for at a face, rad.
const BESIDE: f64 = 1e-9;

/// Profiles of both surfaces on a grid; nothing for cylinders.
#[derive(Debug, Clone, PartialEq)]
pub struct Surfaces {
    bore: Option<Surface>,
    journal: Option<Surface>,
}

/// One profile on a grid, over the radial clearance.
#[derive(Debug, Clone, PartialEq)]
struct Surface {
    /// Angle at which it was last evaluated, rad; not a number before the first time.
    turned: f64,
    varies_around: bool,
    /// At faces around, `(i, j)` at `i * n_axial + j`; the mean of both sides of a step.
    around: Vec<f64>,
    /// At faces along the axis, `(i, j)` at `i * (n_axial + 1) + j`.
    axial: Vec<f64>,
    /// Mean over each cell.
    mean: Vec<f64>,
    /// Half the step up at each face around.
    half_step: Vec<f64>,
}

impl Surfaces {
    /// Of `bearing`, not yet evaluated.
    #[must_use]
    pub fn new(bearing: &Bearing, grid: &Grid) -> Self {
        let surface = |shape: &Shape| (!shape.is_cylindrical()).then(|| Surface::new(shape, grid));
        Self {
            bore: surface(&bearing.bore),
            journal: surface(&bearing.journal),
        }
    }

    /// Turns both surfaces to where `state` has them.
    pub fn turn_to(&mut self, bearing: &Bearing, grid: &Grid, state: &JournalState) {
        for (surface, shape, angle) in [
            (&mut self.bore, &bearing.bore, state.shell_angle),
            (&mut self.journal, &bearing.journal, state.journal_angle),
        ] {
            if let Some(surface) = surface
                && (surface.turned.is_nan() || (surface.varies_around && surface.turned != angle))
            {
                surface.evaluate(shape, bearing, grid, angle);
            }
        }
    }

    /// Adds both profiles and their turning to the gap between cylinders.
    pub fn add_to(&self, grid: &Grid, state: &JournalState, gap: &mut Gap) {
        if let Some(bore) = &self.bore {
            bore.add_to(grid, 1.0, state.shell_speed, gap);
        }
        if let Some(journal) = &self.journal {
            journal.add_to(grid, -1.0, state.journal_speed, gap);
        }
        if self.bore.is_some() || self.journal.is_some() {
            for (cubed, height) in gap.around_cubed.iter_mut().zip(&gap.around_transport) {
                *cubed = height * height * height;
            }
        }
        if let Some(bore) = &self.bore {
            bore.put_steps(grid, gap);
        }
    }

    /// Rise of the journal's profile over cell `k` around, over the clearance.
    #[must_use]
    pub fn journal_rise(&self, k: usize, n_axial: usize) -> f64 {
        self.journal.as_ref().map_or(0.0, |journal| {
            journal.around[k + n_axial] - journal.around[k]
        })
    }

    /// The journal is not round.
    #[must_use]
    pub fn journal_varies_around(&self) -> bool {
        self.journal.as_ref().is_some_and(|j| j.varies_around)
    }
}

impl Surface {
    fn new(shape: &Shape, grid: &Grid) -> Self {
        let (n, m) = (grid.n_around(), grid.n_axial());
        Self {
            turned: f64::NAN,
            varies_around: shape.varies_around(),
            around: vec![0.0; (n + 1) * m],
            axial: vec![0.0; n * (m + 1)],
            mean: vec![0.0; n * m],
            half_step: vec![0.0; if shape.has_steps() { n + 1 } else { 0 }],
        }
    }

    fn evaluate(&mut self, shape: &Shape, bearing: &Bearing, grid: &Grid, turned: f64) {
        self.turned = turned;
        let (n, m) = (grid.n_around(), grid.n_axial());
        let (radius, unit) = (bearing.radius(), 1.0 / bearing.radial_clearance);
        for i in 0..=n {
            let angle = grid.around_faces[i] - turned;
            let own = if shape.has_steps() {
                let sides = [-BESIDE, BESIDE].map(|side| shape.around(angle + side));
                let half = 0.5 * (sides[1] - sides[0]);
                let slope = shape.gradient(angle + BESIDE, 0.0)[0];
                // A slope, too, rises a little over the angle between both sides.
                let is_step = half.abs() > 10.0 * BESIDE * (slope.abs() + half.abs());
                self.half_step[i] = if is_step { half * unit } else { 0.0 };
                if is_step {
                    0.5 * (sides[0] + sides[1])
                } else {
                    shape.around(angle)
                }
            } else {
                shape.around(angle)
            };
            for j in 0..m {
                let z = radius * grid.axial[j];
                let offset = own + shape.along(z) + shape.tabled(angle, z);
                self.around[i * m + j] = offset * unit;
            }
        }
        for i in 0..n {
            let [from, to] = [i, i + 1].map(|i| grid.around_faces[i] - turned);
            let own = shape.mean_around(from, to);
            for j in 0..m {
                let z = radius * grid.axial[j];
                let offset = own + shape.along(z) + shape.mean_tabled(from, to, z);
                self.mean[i * m + j] = offset * unit;
            }
            let angle = grid.around[i] - turned;
            let own = shape.around(angle);
            for j in 0..=m {
                let z = radius * grid.axial_faces[j];
                let offset = own + shape.along(z) + shape.tabled(angle, z);
                self.axial[i * (m + 1) + j] = offset * unit;
            }
        }
    }

    fn add_to(&self, grid: &Grid, sign: f64, speed: f64, gap: &mut Gap) {
        let m = grid.n_axial();
        for (height, offset) in gap.around_transport.iter_mut().zip(&self.around) {
            *height += sign * offset;
        }
        for (height, offset) in gap.axial.iter_mut().zip(&self.axial) {
            *height += sign * offset;
        }
        for (height, offset) in gap.mean.iter_mut().zip(&self.mean) {
            *height += sign * offset;
        }
        if !self.varies_around || speed == 0.0 {
            return;
        }
        for (k, rate) in gap.rate.iter_mut().enumerate() {
            let rise = self.around[k + m] - self.around[k];
            *rate -= sign * speed * rise / grid.around_widths[k / m];
        }
    }

    /// Puts the half cells on both sides of a step in series.
    fn put_steps(&self, grid: &Grid, gap: &mut Gap) {
        let (n, m) = (grid.n_around(), grid.n_axial());
        gap.steps.clear();
        if !self.half_step.is_empty() {
            // Two joints, one of which may be both the first and the last face.
            gap.steps.reserve(3 * m);
        }
        for (i, half) in self.half_step.iter().enumerate() {
            if *half == 0.0 {
                continue;
            }
            let (before, behind) = ((i + n - 1) % n, i % n);
            let [d1, d2] = [before, behind].map(|i| grid.around_widths[i]);
            let shares = [d1 / (d1 + d2), d2 / (d1 + d2)];
            for j in 0..m {
                let face = i * m + j;
                let middle = gap.around_transport[face];
                let heights = [middle - half, middle + half];
                let step = GapStep::between(face, heights, shares);
                gap.around_transport[face] = step.transport;
                gap.around_cubed[face] = step.cubed;
                gap.steps.push(step);
            }
        }
    }
}
