//! How far a shaft and a plate with a hole give way to the pressure between them: another answer than
//! columns, which know nothing of their neighbours.
//!
//! Pressure of the order n around, the same along the axis, in plane elasticity (J. H. Michell's stress
//! functions, as in J. R. Barber, Elasticity, ch. 8 and 9), radial displacement over pressure:
//! ```text
//! hole   R/(4 mu (n - 1)) (kappa + (n - 1)/(n + 1)), R/(2 mu) for n = 0
//!        kappa = (3 - nu)/(1 + nu), plane stress
//! shaft  R/(4 mu (n + 1)) (kappa + (n + 1)/(n - 1)), R (kappa - 1)/(4 mu) for n = 0
//!        kappa = 3 - 4 nu, plane strain
//! ```
//! n = 1 is a translation, which is the journal's. What varies along the axis, even about both ends, gives
//! way as a half-space does under waves of the wave number q, `2 (1 - nu^2)/(E q)` (K. L. Johnson, Contact
//! Mechanics, ch. 13).
//!
//! Limits: the plate is endless, the ends of the bodies are planes of symmetry.

use sommerfeld_film::FilmField;
use std::f64::consts::PI;

/// Poisson's ratio of both.
const NU: f64 = 0.3;

/// A shaft in the hole of a plate.
pub struct PlaneBodies {
    /// Of the hole, m.
    pub radius: f64,
    /// Of the plate, m.
    pub width: f64,
    /// Young's modulus of the shaft, Pa.
    pub shaft: f64,
    /// Young's modulus of the plate, Pa.
    pub plate: f64,
    /// Orders around that are counted.
    pub orders: u32,
}

impl PlaneBodies {
    /// Displacement over pressure, m/Pa, of the order n around and m half waves along the width.
    pub fn compliance(&self, n: u32, m: u32) -> f64 {
        let order = f64::from(n);
        let [shaft, plate] = [self.shaft, self.plate].map(|e| 0.5 * e / (1.0 + NU));
        let [strain, stress] = [3.0 - 4.0 * NU, (3.0 - NU) / (1.0 + NU)];
        let r = 0.25 * self.radius;
        match (n, m) {
            (0, 0) => r * (2.0 / plate + (strain - 1.0) / shaft),
            (1, 0) => 0.0,
            (_, 0) => {
                let ratio = (order - 1.0) / (order + 1.0);
                r / plate / (order - 1.0) * (stress + ratio)
                    + r / shaft / (order + 1.0) * (strain + 1.0 / ratio)
            }
            _ => {
                let wave_number = (order / self.radius).hypot(PI * f64::from(m) / self.width);
                2.0 * (1.0 - NU * NU) * (1.0 / self.shaft + 1.0 / self.plate) / wave_number
            }
        }
    }

    /// By how much more the gap of every cell is opened than by columns of a compliance (m/Pa), m, up to a
    /// translation.
    pub fn beyond_columns(&self, field: &FilmField<'_>, columns: f64) -> Vec<f64> {
        let (n, m) = (field.angles.len(), field.axial.len());
        let touching = |k: usize| field.contact_pressure.get(k).copied().unwrap_or(0.0);
        let pressure = |k: usize| field.pressure[k].max(0.0) + touching(k);
        let mut opened = vec![0.0; n * m];
        for along in 0..u32::try_from(m).unwrap() {
            let wave =
                |j: usize| (PI * f64::from(along) * (field.axial[j] / self.width + 0.5)).cos();
            let norm = if along == 0 { 1.0 } else { 2.0 } / self.width;
            let line: Vec<f64> = (0..n)
                .map(|i| {
                    let of = |j: usize| pressure(i * m + j) * wave(j) * field.axial_widths[j];
                    norm * (0..m).map(of).sum::<f64>()
                })
                .collect();
            for around in (0..=self.orders).filter(|n| (*n, along) != (1, 0)) {
                let angle = |i: usize| f64::from(around) * field.angles[i];
                let norm = if around == 0 { 0.5 } else { 1.0 } / PI;
                let of = |f: &dyn Fn(f64) -> f64| -> f64 {
                    let term = |i: usize| line[i] * f(angle(i)) * field.angle_widths[i];
                    norm * (0..n).map(term).sum::<f64>()
                };
                let (cos, sin) = (of(&f64::cos), of(&f64::sin));
                let by = self.compliance(around, along) - columns;
                for i in 0..n {
                    let u = by * (cos * angle(i).cos() + sin * angle(i).sin());
                    for j in 0..m {
                        opened[i * m + j] += u * wave(j);
                    }
                }
            }
        }
        opened
    }
}

/// Iterates of `x = g(x)` with what g leaves, the newest last.
#[derive(Default)]
pub struct Mixing {
    seen: Vec<[Vec<f64>; 2]>,
}

impl Mixing {
    /// The next x after g(x) - x = `left`, from the last nine (D. G. Anderson, J. ACM 12 (1965) 547).
    pub fn next(&mut self, x: &[f64], left: Vec<f64>) -> Vec<f64> {
        const KEPT: usize = 9;
        const SHARE: f64 = 0.7;
        self.seen.push([x.to_vec(), left]);
        if self.seen.len() > KEPT {
            self.seen.remove(0);
        }
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let add = |to: &mut [f64], by: f64, what: &[f64]| {
            to.iter_mut().zip(what).for_each(|(a, b)| *a += by * b);
        };
        let [mut next, mut rest] = self.seen.last().cloned().unwrap_or_default();
        let mut basis: Vec<[Vec<f64>; 2]> = Vec::new();
        for pair in self.seen.windows(2).rev() {
            let of = |k: usize| -> Vec<f64> {
                pair[1][k]
                    .iter()
                    .zip(&pair[0][k])
                    .map(|(b, a)| b - a)
                    .collect()
            };
            let [mut moved, mut change] = [of(0), of(1)];
            let size = dot(&change, &change).sqrt();
            for [by, direction] in &basis {
                let share = dot(&change, direction);
                add(&mut change, -share, direction);
                add(&mut moved, -share, by);
            }
            let left = dot(&change, &change).sqrt();
            if left < 1e-4 * size {
                continue;
            }
            change.iter_mut().for_each(|v| *v /= left);
            moved.iter_mut().for_each(|v| *v /= left);
            let share = dot(&rest, &change);
            add(&mut rest, -share, &change);
            add(&mut next, -share, &moved);
            basis.push([moved, change]);
        }
        add(&mut next, SHARE, &rest);
        next
    }
}
