//! How thick is the film, and how does it change?
//!
//! ```text
//! h(angle, z) = c - (x + ty z) cos(angle) - (y - tx z) sin(angle) + bore - journal profile
//! ```
//! with the journal position `(x, y)` and tilt `(tx, ty)`; c is the radial clearance. Here are the
//! cylinders; [`crate::surfaces`] adds the profiles. All here is
//! relative: `H = h / c`, positions over c, `zeta = z / R`, tilts times R / c.
//!
//! H lives where the discrete equation needs it: at faces (conductance and transport), and as the
//! exact mean over each cell (storage and squeeze). The means make the squeeze source of the film
//! equal to the weights of its force, so that work and torque balances hold to round-off.

use crate::grid::Grid;

/// Relative gap on a grid, with what a step (groove edge, Rayleigh step) needs kept apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Gap {
    /// H that carries the transport, at faces around, `(i, j)` at `i * n_axial + j`, `i` up to and
    /// including `n_around`.
    pub around_transport: Vec<f64>,
    /// H^3 that conducts, at the same faces.
    pub around_cubed: Vec<f64>,
    /// H at faces along the axis, `(i, j)` at `i * (n_axial + 1) + j`.
    pub axial: Vec<f64>,
    /// H^3 that conducts at the same faces, where it is not that of H: else empty.
    pub axial_cubed: Vec<f64>,
    /// Mean H over each cell.
    pub mean: Vec<f64>,
    /// Mean rate dH/dt over each cell, 1/s.
    pub rate: Vec<f64>,
    /// Faces at which the gap steps.
    pub steps: Vec<GapStep>,
    /// The first and the last face along the axis of every station (`2 i + end`) where a soft shell makes
    /// the gap differ between them and the cells; else empty.
    pub ends: Vec<EndFace>,
}

/// The face at the end of a soft shell. Between the cell beside it and the end, H is linear in the pressure,
/// so that the flow `-H^3 dp/dz` through the half cell is the mean of H^3 over the pressure times its
/// difference: `(a^4 - b^4)/(4 (a - b))` with `a` in the cell and `b` at the end, where the film closes on the
/// way `a^4/(4 (a - b))`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EndFace {
    /// The H whose cube is that mean.
    pub height: f64,
    /// Its derivative by an H that grows on both sides alike.
    pub rigid_slope: f64,
    /// Twice its derivative by that of the cell: 1 where both are alike.
    pub yielding_slope: f64,
}

impl EndFace {
    /// Of H in the cell and at the end.
    #[must_use]
    pub fn between(cell: f64, end: f64) -> Self {
        const LEAST: f64 = 1e-6;
        let a = cell.max(LEAST);
        let (mean, by_cell, by_end) = if end > 0.0 {
            (
                0.25 * (a * a + end * end) * (a + end),
                0.25 * (3.0 * a * a + 2.0 * a * end + end * end),
                0.25 * (a * a + 2.0 * a * end + 3.0 * end * end),
            )
        } else {
            let drop = a - end;
            let mean = 0.25 * a * a * a * a / drop;
            (mean, (a * a * a - mean) / drop, mean / drop)
        };
        let height = mean.cbrt();
        let per_height = 1.0 / (3.0 * height * height);
        Self {
            height,
            rigid_slope: (by_cell + by_end) * per_height,
            yielding_slope: 2.0 * by_cell * per_height,
        }
    }
}

/// A face around at which the gap steps: the half cells before and behind it, with heights `H1`,
/// `H2` over the lengths `d1`, `d2`, conduct in series, and continuity of flow and pressure at the
/// step leaves `(d1 H1^-2 + d2 H2^-2)/(d1 H1^-3 + d2 H2^-3)` for the transport.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GapStep {
    /// The face around.
    pub face: usize,
    /// H that carries the transport.
    pub transport: f64,
    /// H^3 that conducts.
    pub cubed: f64,
    /// Derivative of the transport's H where H grows on both sides alike.
    pub transport_slope: f64,
    /// The same of H^3.
    pub cubed_slope: f64,
}

impl GapStep {
    /// Of the half cells before and behind, with heights H and shares of the length.
    #[must_use]
    pub fn between(face: usize, heights: [f64; 2], shares: [f64; 2]) -> Self {
        let series = |power: i32| -> f64 {
            let terms = heights.iter().zip(shares);
            terms
                .map(|(height, share)| share * height.powi(power))
                .sum()
        };
        let (square, cube, fourth) = (series(-2), series(-3), series(-4));
        Self {
            face,
            transport: square / cube,
            cubed: 1.0 / cube,
            transport_slope: 3.0 * square * fourth / (cube * cube) - 2.0,
            cubed_slope: 3.0 * fourth / (cube * cube),
        }
    }
}

impl Gap {
    /// Gap of the right size for `grid`, closed everywhere.
    #[must_use]
    pub fn for_grid(grid: &Grid) -> Self {
        let (n, m) = (grid.n_around(), grid.n_axial());
        Self {
            around_transport: vec![0.0; (n + 1) * m],
            around_cubed: vec![0.0; (n + 1) * m],
            axial: vec![0.0; n * (m + 1)],
            axial_cubed: Vec::new(),
            mean: vec![0.0; n * m],
            rate: vec![0.0; n * m],
            steps: Vec::new(),
            ends: Vec::new(),
        }
    }

    /// Derivatives of H at a face along the axis by that of the rigid shapes, and twice that by the
    /// displacement of the cell beside it.
    #[must_use]
    pub fn end_slopes(&self, i: usize, j: usize, n_axial: usize) -> [f64; 2] {
        if self.ends.is_empty() || (j > 0 && j < n_axial) {
            return [1.0; 2];
        }
        let face = self.ends[2 * i + usize::from(j > 0)];
        [face.rigid_slope, face.yielding_slope]
    }

    /// Relative derivatives by H, 1/H each, of what conducts and of what transports through a face
    /// around. `steps` are those of the faces not yet asked for, in ascending order.
    #[must_use]
    pub fn relative_slopes(&self, face: usize, steps: &mut &[GapStep]) -> (f64, f64) {
        if let [step, rest @ ..] = *steps
            && step.face == face
        {
            *steps = rest;
            return (
                step.cubed_slope / step.cubed,
                step.transport_slope / step.transport,
            );
        }
        let per_height = 1.0 / self.around_transport[face];
        (3.0 * per_height, per_height)
    }

    /// Gap of a planar slider, uniform along the axis: `profile(x, side)` is H just before
    /// (`side < 0`) or just behind (`side > 0`) the place `x`, so that steps may lie on faces
    /// ([`GapStep`]); `rate(x)` is dH/dt.
    #[must_use]
    pub fn from_profile(
        grid: &Grid,
        profile: impl Fn(f64, f64) -> f64,
        rate: impl Fn(f64) -> f64,
    ) -> Self {
        let (n, m) = (grid.n_around(), grid.n_axial());
        let mut gap = Self::for_grid(grid);
        for i in 0..=n {
            let x = grid.around_faces[i];
            // Beyond the ends of the slider there is nothing to be in series with.
            let before = profile(x, if i == 0 { 1.0 } else { -1.0 });
            let behind = profile(x, if i == n { -1.0 } else { 1.0 });
            let width = |cell: usize| grid.around_widths[cell.min(n - 1)];
            let total = width(i.saturating_sub(1)) + width(i);
            let shares = [width(i.saturating_sub(1)) / total, width(i) / total];
            for j in 0..m {
                let step = GapStep::between(i * m + j, [before, behind], shares);
                gap.around_transport[step.face] = step.transport;
                gap.around_cubed[step.face] = step.cubed;
            }
        }
        for i in 0..n {
            let (x, half) = (grid.around[i], 0.5 * grid.around_widths[i]);
            let middle = profile(x, 1.0);
            // Simpson's rule inside the cell, one-sided at its faces.
            let mean = (profile(x - half, 1.0) + 4.0 * middle + profile(x + half, -1.0)) / 6.0;
            for j in 0..m {
                gap.mean[i * m + j] = mean;
                gap.rate[i * m + j] = rate(x);
            }
            for j in 0..=m {
                gap.axial[i * (m + 1) + j] = middle;
            }
        }
        gap
    }
}

/// A quantity `a cos(angle) + b sin(angle)` whose amplitudes vary linearly along the axis: the gap
/// between cylinders beyond the clearance, its rate, and every derivative of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waviness {
    /// Relative displacement of the centre towards +X and +Y in the mid-plane.
    pub centre: [f64; 2],
    /// Change of the same per unit of zeta.
    pub slope: [f64; 2],
}

impl Waviness {
    /// Of a journal at `position` with `tilt`, both relative (over c; times R/c), or of their rates.
    #[must_use]
    pub fn of(position: [f64; 2], tilt: [f64; 2]) -> Self {
        Self {
            centre: position,
            slope: [tilt[1], -tilt[0]],
        }
    }

    /// Its value at an angle with this cos and sin in the mid-plane, and its change per unit of zeta.
    #[must_use]
    pub fn along(&self, [cos, sin]: [f64; 2]) -> (f64, f64) {
        let value = |[x, y]: [f64; 2]| x * cos + y * sin;
        (value(self.centre), value(self.slope))
    }

    /// The amplitudes at `zeta`.
    #[must_use]
    pub fn at(&self, zeta: f64) -> [f64; 2] {
        [
            self.centre[0] + self.slope[0] * zeta,
            self.centre[1] + self.slope[1] * zeta,
        ]
    }
}

/// The trigonometry of a grid around the bearing: made once, used by every gap, tangent and
/// integral.
#[derive(Debug, Clone, PartialEq)]
pub struct AngleTables {
    /// cos and sin at faces around.
    pub faces: Vec<[f64; 2]>,
    /// cos and sin at cell centres.
    pub centres: Vec<[f64; 2]>,
    /// Exact mean of cos and sin over each cell.
    pub means: Vec<[f64; 2]>,
}

impl AngleTables {
    /// Tables for `grid`.
    #[must_use]
    pub fn new(grid: &Grid) -> Self {
        let trig = |a: &f64| [a.cos(), a.sin()];
        let means = grid.around_faces.windows(2).map(|f| {
            let width = f[1] - f[0];
            [
                (f[1].sin() - f[0].sin()) / width,
                (f[0].cos() - f[1].cos()) / width,
            ]
        });
        Self {
            faces: grid.around_faces.iter().map(trig).collect(),
            centres: grid.around.iter().map(trig).collect(),
            means: means.collect(),
        }
    }

    /// Fills `gap` between cylinders with the journal at `position` moving at `rate`.
    pub fn fill_gap(&self, grid: &Grid, position: &Waviness, rate: &Waviness, gap: &mut Gap) {
        let (n, m) = (grid.n_around(), grid.n_axial());
        for (i, trig) in self.faces.iter().enumerate() {
            let faces = i * m..(i + 1) * m;
            let (centre, slope) = position.along(*trig);
            let transport = &mut gap.around_transport[faces.clone()];
            let cubed = &mut gap.around_cubed[faces];
            for ((transport, cubed), zeta) in transport.iter_mut().zip(cubed).zip(&grid.axial) {
                let h = 1.0 - (centre + slope * zeta);
                *transport = h;
                *cubed = h * h * h;
            }
        }
        for i in 0..n {
            let cells = i * m..(i + 1) * m;
            let (centre, slope) = position.along(self.means[i]);
            let (rising, turning) = rate.along(self.means[i]);
            let mean = &mut gap.mean[cells.clone()];
            let rates = &mut gap.rate[cells];
            for ((mean, rate), zeta) in mean.iter_mut().zip(rates).zip(&grid.axial) {
                *mean = 1.0 - (centre + slope * zeta);
                *rate = -(rising + turning * zeta);
            }
            let (centre, slope) = position.along(self.centres[i]);
            let heights = &mut gap.axial[i * (m + 1)..(i + 1) * (m + 1)];
            for (height, zeta) in heights.iter_mut().zip(&grid.axial_faces) {
                *height = 1.0 - (centre + slope * zeta);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_step_both_sides_are_one() {
        let step = GapStep::between(0, [0.7; 2], [0.3, 0.7]);
        assert!((step.transport - 0.7).abs() < 1e-15);
        assert!((step.cubed - 0.343).abs() < 1e-15);
        assert!((step.transport_slope - 1.0).abs() < 1e-14);
        assert!((step.cubed_slope - 3.0 * 0.49).abs() < 1e-14);
    }

    /// Gauss points of the mean, open all the way and closed on the way.
    #[test]
    fn an_end_conducts_the_mean_of_cubes() {
        for (a, b) in [(0.7, 0.7), (0.9, 0.2), (0.3, -0.4)] {
            let face = EndFace::between(a, b);
            let open: f64 = if b < 0.0 { a / (a - b) } else { 1.0 };
            let cube = |s: f64| (a + s * open * (b - a)).powi(3);
            let offset = 0.5 / 3.0_f64.sqrt();
            let mean = 0.5 * open * (cube(0.5 - offset) + cube(0.5 + offset));
            assert!((face.height.powi(3) - mean).abs() < 1e-15, "{a} {b}");
            let step = 1e-6;
            let height = |da: f64, db: f64| EndFace::between(a + da, b + db).height;
            let both = (height(step, step) - height(-step, -step)) / (2.0 * step);
            assert!((both - face.rigid_slope).abs() < 1e-9, "{a} {b}");
            let cell = (height(step, 0.0) - height(-step, 0.0)) / step;
            assert!((cell - face.yielding_slope).abs() < 1e-9, "{a} {b}");
        }
    }

    #[test]
    fn slopes_of_a_step_equal_differences() {
        let at = |by: f64| GapStep::between(0, [0.7 + by, 1.3 + by], [0.4, 0.6]);
        let (plus, minus, middle) = (at(1e-6), at(-1e-6), at(0.0));
        let slope = (plus.transport - minus.transport) / 2e-6;
        assert!((slope - middle.transport_slope).abs() < 1e-9);
        let slope = (plus.cubed - minus.cubed) / 2e-6;
        assert!((slope - middle.cubed_slope).abs() < 1e-9);
    }
}
