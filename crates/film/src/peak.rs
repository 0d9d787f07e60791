//! Where the pressure is highest, between the cells.
//!
//! Cell values are interpolated by the product of polynomials around and along the axis, and the
//! maximum of the product is found by Newton's method, so that a ridge that lies oblique to the grid is
//! followed along both axes at once. Five cells each way (order 4) where the film is full and
//! under pressure in all of them, three (order 2) where that holds for the neighbours alone, else one
//! parabola for each axis.

/// Most cells of a window each way.
pub const WIDTH: usize = 5;
/// Place of the highest cell in a window.
pub const CENTRE: usize = WIDTH / 2;

/// The highest cell and those around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Places around relative to the highest cell, ascending.
    pub around: [f64; WIDTH],
    /// Places along the axis relative to the highest cell, ascending.
    pub axial: [f64; WIDTH],
    /// Pressure by place around and along, in any unit; not a number where there is no full film.
    pub pressure: [[f64; WIDTH]; WIDTH],
}

/// A peak relative to the highest cell.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Peak {
    /// Place around, in the unit of the window.
    pub around: f64,
    /// Place along the axis, in the unit of the window.
    pub axial: f64,
    /// Pressure above that of the cell, in the unit of the window, never negative.
    pub rise: f64,
}

impl Window {
    /// The peak by the widest window that is a film throughout; `None` where not even the eight
    /// neighbours are, or where the surface has no maximum between them.
    #[must_use]
    pub fn peak(&self) -> Option<Peak> {
        self.peak_of::<5>().or_else(|| self.peak_of::<3>())
    }

    /// The peak of the polynomial through the middle `N` x `N` cells.
    fn peak_of<const N: usize>(&self) -> Option<Peak> {
        const STEPS: usize = 20;
        const CLOSE: f64 = 1e-9;
        let first = CENTRE - N / 2;
        let x: [f64; N] = std::array::from_fn(|k| self.around[first + k]);
        let z: [f64; N] = std::array::from_fn(|k| self.axial[first + k]);
        let top = self.pressure[CENTRE][CENTRE];
        let p: [[f64; N]; N] =
            std::array::from_fn(|i| std::array::from_fn(|j| self.pressure[first + i][first + j]));
        // Also false for what is no number.
        if !p.iter().flatten().all(|p| *p > 0.0) {
            return None;
        }
        let [west, east] = [CENTRE - 1, CENTRE + 1].map(|k| self.around[k]);
        let [south, north] = [CENTRE - 1, CENTRE + 1].map(|k| self.axial[k]);
        let (mut around, mut axial) = (0.0, 0.0);
        for _ in 0..STEPS {
            let [value, px, pz, pxx, pxz, pzz] = surface(&x, &z, &p, around, axial);
            let determinant = pxx * pzz - pxz * pxz;
            if pxx >= 0.0 || determinant <= 0.0 {
                return None;
            }
            let dx = (pxz * pz - pzz * px) / determinant;
            let dz = (pxz * px - pxx * pz) / determinant;
            if dx.abs() <= CLOSE * (east - west) && dz.abs() <= CLOSE * (north - south) {
                let rise = value - top;
                return (rise >= 0.0).then_some(Peak {
                    around,
                    axial,
                    rise,
                });
            }
            around += dx;
            axial += dz;
            let is_near = (west..=east).contains(&around) && (south..=north).contains(&axial);
            if !is_near {
                return None;
            }
        }
        None
    }
}

/// The product polynomial through `p` at a place: value, both slopes, and the second derivatives
/// around, mixed and along.
fn surface<const N: usize>(
    x: &[f64; N],
    z: &[f64; N],
    p: &[[f64; N]; N],
    around: f64,
    axial: f64,
) -> [f64; 6] {
    let rows = p.each_ref().map(|row| polynomial(z, row, axial));
    let [value, px, pxx] = polynomial(x, &rows.map(|row| row[0]), around);
    let [pz, pxz, _] = polynomial(x, &rows.map(|row| row[1]), around);
    let [pzz, ..] = polynomial(x, &rows.map(|row| row[2]), around);
    [value, px, pz, pxx, pxz, pzz]
}

/// The polynomial through `values` at `nodes`: value, first and second derivative at `at`. Newton's
/// divided differences, summed by Horner's rule.
fn polynomial<const N: usize>(nodes: &[f64; N], values: &[f64; N], at: f64) -> [f64; 3] {
    let mut factors = *values;
    for order in 1..N {
        for k in (order..N).rev() {
            factors[k] = (factors[k] - factors[k - 1]) / (nodes[k] - nodes[k - order]);
        }
    }
    let (mut value, mut slope, mut bend) = (0.0, 0.0, 0.0);
    for (factor, node) in factors.iter().zip(nodes).rev() {
        bend = bend * (at - node) + 2.0 * slope;
        slope = slope * (at - node) + value;
        value = value * (at - node) + factor;
    }
    [value, slope, bend]
}

/// Offset and height above the middle one of the peak of the parabola through three values at the
/// given distances; both 0 where it opens upwards.
#[must_use]
pub fn parabola_peak(
    [before, middle, behind]: [f64; 3],
    [d_before, d_behind]: [f64; 2],
) -> (f64, f64) {
    let slope_before = (middle - before) / d_before;
    let slope_behind = (behind - middle) / d_behind;
    let curvature = (slope_behind - slope_before) / (d_before + d_behind);
    if curvature >= 0.0 {
        return (0.0, 0.0);
    }
    let slope = (slope_before * d_behind + slope_behind * d_before) / (d_before + d_behind);
    let offset = (-0.5 * slope / curvature).clamp(-0.5 * d_before, 0.5 * d_behind);
    (offset, offset * (slope + curvature * offset))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Uneven places, as on a graded grid.
    fn window(pressure: impl Fn(f64, f64) -> f64) -> Window {
        let (around, axial) = ([-2.3, -1.1, 0.0, 1.0, 1.9], [-1.8, -0.9, 0.0, 1.0, 2.1]);
        Window {
            around,
            axial,
            pressure: around.map(|x| axial.map(|z| pressure(x, z))),
        }
    }

    /// A ridge across both axes, with its peak in the corner of the cell: an oblique quadratic is met
    /// exactly, by five cells and by three.
    #[test]
    fn an_oblique_peak_is_met() {
        let of = |x: f64, z: f64| {
            let (x, z) = (x - 0.4, z + 0.35);
            100.0 - 3.0 * x * x - 2.0 * z * z - 4.0 * x * z
        };
        let mut whole = window(of);
        let five = whole.peak().unwrap_or_default();
        whole.pressure[0][4] = 0.0;
        let three = whole.peak().unwrap_or_default();
        for peak in [five, three] {
            assert!((peak.around - 0.4).abs() < 1e-8, "{peak:?}");
            assert!((peak.axial + 0.35).abs() < 1e-8, "{peak:?}");
            assert!(
                (peak.rise - (100.0 - of(0.0, 0.0))).abs() < 1e-9,
                "{peak:?}"
            );
        }
        let (_, separate) = parabola_peak([of(-1.1, 0.0), of(0.0, 0.0), of(1.0, 0.0)], [1.1, 1.0]);
        assert!(
            separate < 0.6 * five.rise,
            "the cross term is what the test is about"
        );
    }

    #[test]
    fn five_cells_are_of_higher_order_than_three() {
        let of = |x: f64, z: f64| {
            let (x, z) = (0.3 * x - 0.1, 0.3 * z + 0.12);
            (-(x * x) - z * z - 0.8 * x * z).exp() * (1.0 + 0.2 * x * x * x)
        };
        let exact = 1.0; // slopes vanish at the peak of the first factor, to within 1e-9
        let whole = window(of);
        let off = |peak: Option<Peak>| (of(0.0, 0.0) + peak.unwrap_or_default().rise - exact).abs();
        assert!(off(whole.peak_of::<5>()) < 0.2 * off(whole.peak_of::<3>()));
    }

    #[test]
    fn no_film_and_no_maximum_give_none() {
        let mut hollow = window(|x, z| 5.0 + x * x - z * z);
        assert_eq!(hollow.peak(), None);
        hollow = window(|x, z| 9.0 - x * x - z * z);
        hollow.pressure[1][1] = f64::NAN;
        assert_eq!(hollow.peak(), None);
    }
}
