//! The volume over a piston.
//!
//! Question: which volume does the gas have at a crank angle, and which work does a diagram do on it?
//!
//! Exact slider-crank with pin offset: with the arm at `phi` from the cylinder axis the pin stands at
//! `x = r cos(phi) + l cos(beta)`, `sin(beta) = (r sin(phi) - e)/l`; `V = V_c + A (x_TDC - x)`. Angles count
//! from the top dead centre of the piston, `phi = angle + asin(e/(r + l))`. An infinite rod is allowed:
//! `x = r cos(phi)`.
//!
//! Limit: the chamber at the dead centre is a disc of the bore, which decides only how much of the liner
//! the gas touches.

use crate::{CombustionError, CrankTrain, IndicatorDiagram};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Longest part of a diagram over which the volume is integrated at once, rad.
const PANEL: f64 = 0.1;
/// Gauss-Legendre points and weights of order 8 on (-1, 1).
const GAUSS: [[f64; 2]; 4] = [
    [-0.861_136_311_594_052_6, 0.347_854_845_137_453_85],
    [-0.339_981_043_584_856_26, 0.652_145_154_862_546_2],
    [0.339_981_043_584_856_26, 0.652_145_154_862_546_2],
    [0.861_136_311_594_052_6, 0.347_854_845_137_453_85],
];

/// Cylinder, crank and rod as the gas sees them. Lengths m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Chamber {
    /// Cylinder bore.
    pub bore: f64,
    /// Crank radius.
    pub crank_radius: f64,
    /// Rod length from centre to centre; infinite for a piston that moves as a cosine.
    pub rod_length: f64,
    /// Distance of the cylinder axis from the crank axis, as in [`CrankTrain::pin_offset`].
    pub pin_offset: f64,
    /// Largest volume over smallest.
    pub compression_ratio: f64,
}

impl Chamber {
    /// The chamber of an engine.
    #[must_use]
    pub fn of(train: &CrankTrain, compression_ratio: f64) -> Self {
        Self {
            bore: train.bore,
            crank_radius: train.crank_radius,
            rod_length: train.rod_length,
            pin_offset: train.pin_offset,
            compression_ratio,
        }
    }

    /// Refuses dimensions that are no cylinder.
    ///
    /// # Errors
    /// [`CombustionError::OutOfRange`] with the dimension.
    pub fn check(&self) -> Result<(), CombustionError> {
        let refuse = CombustionError::unless;
        let reach = self.rod_length - self.crank_radius;
        refuse(self.bore > 0.0, "bore", self.bore, "above 0 m")?;
        refuse(self.bore.is_finite(), "bore", self.bore, "finite")?;
        let radius = self.crank_radius;
        let is_length = radius > 0.0 && radius.is_finite();
        refuse(is_length, "crank radius", radius, "above 0 m")?;
        let rod = "longer than the crank radius";
        refuse(reach > 0.0, "rod length", self.rod_length, rod)?;
        let offset = self.pin_offset;
        let allowed = "smaller than rod length less crank radius";
        refuse(offset.abs() < reach, "pin offset", offset, allowed)?;
        let ratio = self.compression_ratio;
        let is_ratio = ratio > 1.0 && ratio.is_finite();
        refuse(is_ratio, "compression ratio", ratio, "above 1")
    }

    /// Area of the piston, m2.
    #[must_use]
    pub fn area(&self) -> f64 {
        0.25 * PI * self.bore * self.bore
    }

    /// Way of the piston from dead centre to dead centre, m.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        let (r, l, e) = (self.crank_radius, self.rod_length, self.pin_offset);
        if l.is_infinite() {
            return 2.0 * r;
        }
        ((l + r).powi(2) - e * e).sqrt() - ((l - r).powi(2) - e * e).sqrt()
    }

    /// Volume the piston sweeps, m3.
    #[must_use]
    pub fn swept_volume(&self) -> f64 {
        self.area() * self.stroke()
    }

    /// Volume at the top dead centre, m3.
    #[must_use]
    pub fn clearance_volume(&self) -> f64 {
        self.swept_volume() / (self.compression_ratio - 1.0)
    }

    /// Volume, m3, at a crank angle from the top dead centre, rad.
    #[must_use]
    pub fn volume(&self, angle: f64) -> f64 {
        self.clearance_volume() + self.area() * self.travel(angle)[0]
    }

    /// Change of the volume with the crank angle, m3/rad.
    #[must_use]
    pub fn volume_rate(&self, angle: f64) -> f64 {
        self.area() * self.travel(angle)[1]
    }

    /// Way of the piston from its top dead centre, m, and its change with the crank angle, m/rad.
    fn travel(&self, angle: f64) -> [f64; 2] {
        let (r, l, e) = (self.crank_radius, self.rod_length, self.pin_offset);
        if l.is_infinite() {
            let half = (0.5 * angle).sin();
            return [2.0 * r * half * half, r * angle.sin()];
        }
        let (sin, cos) = (angle + (e / (l + r)).asin()).sin_cos();
        let sin_rod = (r * sin - e) / l;
        let cos_rod = (1.0 - sin_rod * sin_rod).sqrt();
        let top = ((l + r).powi(2) - e * e).sqrt();
        let rate = r * sin + r * cos * sin_rod / cos_rod;
        [top - (r * cos + l * cos_rod), rate]
    }

    /// Liner the gas touches at a crank angle, m2: the cleared stroke and the height of the chamber.
    #[must_use]
    pub fn liner_area(&self, angle: f64) -> f64 {
        PI * self.bore * self.volume(angle) / self.area()
    }

    /// Work of the gas on the piston over one cycle, J: the integral of p dV, with a diagram that is
    /// linear between its points and the exact volume; to round-off.
    #[must_use]
    pub fn work(&self, diagram: &IndicatorDiagram) -> f64 {
        let points = &diagram.points;
        let Some(&[first, pressure]) = points.first() else {
            return 0.0;
        };
        let end = [first + diagram.period, pressure];
        let next = points.iter().skip(1).chain(std::iter::once(&end));
        points
            .iter()
            .zip(next)
            .map(|(a, b)| self.work_between(*a, *b))
            .sum()
    }

    /// Work between two points of a diagram.
    fn work_between(&self, [a, p]: [f64; 2], [b, q]: [f64; 2]) -> f64 {
        let panels = ((b - a) / PANEL).ceil().max(1.0);
        let half = 0.5 * (b - a) / panels;
        let mut work = 0.0;
        for panel in 0..panels as usize {
            let middle = a + (2.0 * panel as f64 + 1.0) * half;
            for [x, weight] in GAUSS {
                let angle = middle + half * x;
                let share = if b > a { (angle - a) / (b - a) } else { 0.0 };
                work += half * weight * (p + (q - p) * share) * self.volume_rate(angle);
            }
        }
        work
    }

    /// Indicated mean effective pressure of a diagram, Pa.
    #[must_use]
    pub fn mean_effective_pressure(&self, diagram: &IndicatorDiagram) -> f64 {
        self.work(diagram) / self.swept_volume()
    }
}
