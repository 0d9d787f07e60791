//! How far shaft, rod and brackets give way to the pressure between them: `validation/sander-rig/compliance.csv`,
//! calculated by finite elements, applied to a pressure field.
//!
//! Pressure on a bearing surface is written in waves, cos or sin(n angle) times P_m(2 z/width); the file says
//! by how much each opens the gap in each. What the waves leave of the pressure is shorter than they are; it
//! meets columns as soft as the bodies are to their shortest one around.

use crate::common::text_table;
use sommerfeld_film::FilmField;
use std::f64::consts::PI;

/// Orders around 0..ORDERS and degrees along the axis 0..DEGREES in the file.
const ORDERS: usize = 25;
const DEGREES: usize = 8;

/// One coefficient of the file.
struct Term {
    sine: bool,
    opens: usize,
    pressed: usize,
    /// m/Pa.
    value: f64,
}

/// Shaft and what holds the shell, together.
pub struct Compliance {
    terms: Vec<Term>,
    /// Of what is shorter than the waves of the file, m/Pa.
    shorter: f64,
}

impl Compliance {
    /// Bodies by their names in the file, each so many times as soft as there.
    pub fn of(bodies: &[(&str, f64)]) -> Self {
        let mut terms = Vec::new();
        for row in text_table("sander-rig/compliance.csv") {
            let Some((_, softness)) = bodies.iter().find(|(name, _)| *name == row[0]) else {
                continue;
            };
            let number = |k: usize| row[k].parse::<usize>().unwrap();
            let value = softness * row[6].parse::<f64>().unwrap();
            for sine in [false, true] {
                if row[1] == ["cos", "sin"][usize::from(sine)] || row[1] == "both" {
                    terms.push(Term {
                        sine,
                        opens: number(2) * DEGREES + number(3),
                        pressed: number(4) * DEGREES + number(5),
                        value,
                    });
                }
            }
        }
        let shortest = (ORDERS - 1) * DEGREES;
        let mut compliance = Self {
            terms,
            shorter: 0.0,
        };
        compliance.shorter = compliance.between(false, shortest, shortest);
        compliance
    }

    /// Coefficient between two waves, order times `DEGREES` plus degree, m/Pa.
    fn between(&self, sine: bool, opens: usize, pressed: usize) -> f64 {
        let is = |t: &&Term| (t.sine, t.opens, t.pressed) == (sine, opens, pressed);
        self.terms.iter().filter(is).map(|t| t.value).sum()
    }

    /// Opening of the order and degree by a pressure of the same, m/Pa.
    pub fn own(&self, sine: bool, order: usize, degree: usize) -> f64 {
        let wave = order * DEGREES + degree;
        self.between(sine, wave, wave)
    }

    /// Largest difference of the energies of two waves of pressure on the displacement of each other, over
    /// the largest of them all.
    pub fn asymmetry(&self) -> f64 {
        // the mean square of a wave over the surface, but for a constant factor
        let square = |wave: usize| {
            let (order, degree) = (wave / DEGREES, wave % DEGREES);
            let around = if order == 0 { 2.0 } else { 1.0 };
            around / (2 * degree + 1) as f64
        };
        let translation = DEGREES;
        let mut largest: [f64; 2] = [0.0; 2];
        for term in self.terms.iter().filter(|t| t.pressed != translation) {
            let other = self.between(term.sine, term.pressed, term.opens) * square(term.pressed);
            let energy = term.value * square(term.opens);
            largest[0] = largest[0].max((energy - other).abs());
            largest[1] = largest[1].max(energy.abs());
        }
        largest[0] / largest[1]
    }

    /// By how much the gap of every cell opens under a pressure per cell (Pa), m, up to a translation.
    pub fn opening(&self, field: &FilmField<'_>, pressure: &[f64]) -> Vec<f64> {
        let waves = Waves::of(field);
        let pressed = waves.coefficients(pressure);
        let mut opened = vec![[0.0; 2]; ORDERS * DEGREES];
        for term in &self.terms {
            let wave = usize::from(term.sine);
            opened[term.opens][wave] += term.value * pressed[term.pressed][wave];
        }
        let seen = waves.sum(&pressed);
        let mut by = waves.sum(&opened);
        for (by, (p, seen)) in by.iter_mut().zip(pressure.iter().zip(&seen)) {
            *by += self.shorter * (p - seen);
        }
        by
    }
}

/// The waves at the cells of a film.
struct Waves {
    /// cos and sin times the cell's angle over pi, and as they are, per angle and order.
    around: Vec<[[f64; 2]; 2]>,
    /// The same along the axis, per position and degree.
    along: Vec<[f64; 2]>,
    angles: usize,
    positions: usize,
}

impl Waves {
    fn of(field: &FilmField<'_>) -> Self {
        let mut around = Vec::new();
        for (angle, span) in field.angles.iter().zip(field.angle_widths) {
            for n in 0..ORDERS {
                let at = n as f64 * angle;
                let share = span / PI * if n == 0 { 0.5 } else { 1.0 };
                let wave = [at.cos(), at.sin()];
                around.push([wave.map(|w| share * w), wave]);
            }
        }
        let width: f64 = field.axial_widths.iter().sum();
        let mut along = Vec::new();
        for (position, span) in field.axial.iter().zip(field.axial_widths) {
            let at = legendre(2.0 * position / width);
            let ends = [-0.5, 0.5].map(|side| legendre(2.0 * (position + side * span) / width));
            for m in 0..DEGREES {
                // of P_m over the cell: (2 m + 1) P_m = (P_(m+1) - P_(m-1))'
                let integral = |p: &[f64]| if m == 0 { p[1] } else { p[m + 1] - p[m - 1] };
                along.push([0.5 * (integral(&ends[1]) - integral(&ends[0])), at[m]]);
            }
        }
        Self {
            around,
            along,
            angles: field.angles.len(),
            positions: field.axial.len(),
        }
    }

    /// Of the cosine and the sine, per order and degree.
    fn coefficients(&self, values: &[f64]) -> Vec<[f64; 2]> {
        let mut sums = vec![[0.0; 2]; ORDERS * DEGREES];
        for i in 0..self.angles {
            for m in 0..DEGREES {
                let of = |j: usize| values[i * self.positions + j] * self.along[j * DEGREES + m][0];
                let line: f64 = (0..self.positions).map(of).sum();
                for n in 0..ORDERS {
                    let [share, _] = self.around[i * ORDERS + n];
                    let sum = &mut sums[n * DEGREES + m];
                    sum[0] += share[0] * line;
                    sum[1] += share[1] * line;
                }
            }
        }
        sums
    }

    fn sum(&self, coefficients: &[[f64; 2]]) -> Vec<f64> {
        let mut values = vec![0.0; self.angles * self.positions];
        for i in 0..self.angles {
            for m in 0..DEGREES {
                let of = |n: usize| {
                    let [cos, sin] = coefficients[n * DEGREES + m];
                    let [_, wave] = self.around[i * ORDERS + n];
                    cos * wave[0] + sin * wave[1]
                };
                let line: f64 = (0..ORDERS).map(of).sum();
                for j in 0..self.positions {
                    values[i * self.positions + j] += line * self.along[j * DEGREES + m][1];
                }
            }
        }
        values
    }
}

/// P_0 to P_DEGREES at a place.
fn legendre(x: f64) -> [f64; DEGREES + 1] {
    let mut p = [1.0; DEGREES + 1];
    p[1] = x;
    for m in 2..=DEGREES {
        let order = m as f64;
        p[m] = ((2.0 * order - 1.0) * x * p[m - 1] - (order - 1.0) * p[m - 2]) / order;
    }
    p
}
