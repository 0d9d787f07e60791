//! How do force and fronts follow the journal?
//!
//! ```text
//! R(c, x) = 0,  R_t = sum over lines of  weight T_t(Z) H^3 p_theta/|w|   at either front
//! dF/dx = F_x - F_c R_c^-1 R_x,   x = (eccentricity, direction of motion),  c the parts of the fronts
//! ```
//! In the continuous film F_c vanishes, as the slope of the pressure does at the fronts; with some terms
//! of a front it is small and not zero. All four blocks are derivatives of the discrete equations, by
//! adjoints: two of the force, which are the answers themselves, and one for each part of the fronts.
//! R_c also moves the fronts by Newton's method, and `-R_c^-1 R_x` foretells where they will be.

use super::dot;
use super::joint::{BEFORE, JointFilm};
use super::strip::{End, Point};
use crate::spectral::answer::AlignedForce;

/// Rows: both forces, then the conditions at the fronts. Columns: eccentricity, direction, parts of
/// the fronts.
pub(super) type Rates<const L: usize> = [[f64; L]; L];

/// How the discrete equations weighted with a field change with what a line depends on.
#[derive(Clone, Copy)]
struct LineRates<const L: usize> {
    /// By the place s of a front and by its slope.
    place: [[f64; L]; 2],
    slope: [[f64; L]; 2],
    /// By the logarithm of the length between the fronts.
    length: [f64; L],
    /// By eccentricity, in s.
    eccentricity: [f64; L],
}

/// Changes of a point as it moves, and as the eccentricity grows at its s.
struct PointRates {
    /// Of the logarithm of the gap, of the stretch, and of the angle.
    moved: [f64; 3],
    grown: [f64; 3],
}

/// Motion across the present one.
fn across([along, across]: [f64; 2]) -> [f64; 2] {
    [-across, along]
}

impl<const M: usize, const G: usize, const L: usize> JointFilm<M, G, L> {
    /// Fills `rates`, the inverse of the fronts' part, and how the fronts follow; false if they do not.
    pub(super) fn differentiate(&mut self) -> bool {
        self.solve_adjoints();
        let mut lines = [LineRates {
            place: [[0.0; L]; 2],
            slope: [[0.0; L]; 2],
            length: [0.0; L],
            eccentricity: [0.0; L],
        }; G];
        self.walk_fields(&mut lines);
        self.add_conditions(&mut lines);
        let mut rates = self.gathered(&lines);
        let (resistance, conditions) = (self.film.resistance(), self.conditions());
        let turned = across(self.film.motion);
        for row in 0..L {
            if row < BEFORE {
                rates[row] = rates[row].map(|rate| -rate);
                rates[row][1] += dot(resistance[row], turned);
            } else {
                rates[row][1] += conditions[row][1];
            }
        }
        self.rates = rates;
        let Some(inverse) = inverse_of_fronts(&rates) else {
            return false;
        };
        self.inverse = inverse;
        for part in BEFORE..L {
            self.follow[part] = [0, 1].map(|column| {
                let known = (BEFORE..L).map(|row| inverse[part][row] * rates[row][column]);
                -known.sum::<f64>()
            });
        }
        true
    }

    /// Force and derivatives, the fronts where their conditions put them.
    pub(super) fn tangents(&self, change: &[f64; L]) -> AlignedForce {
        let mut force = self.film.force_of_answers();
        let mut by_state = [[0.0; 2]; 2];
        for row in 0..2 {
            let rates = &self.rates[row];
            by_state[row] = [rates[0], rates[1]];
            for part in BEFORE..L {
                force[row] += rates[part] * change[part];
                for column in 0..2 {
                    by_state[row][column] += rates[part] * self.follow[part][column];
                }
            }
        }
        AlignedForce {
            force,
            by_eccentricity: by_state.map(|row| row[0]),
            by_motion: self.film.by_motion(force, by_state.map(|row| row[1])),
        }
    }

    /// Newton's change of the fronts, with the inverse last found.
    pub(super) fn newton_change(&self) -> [f64; L] {
        let conditions = self.conditions();
        let mut change = [0.0; L];
        for part in BEFORE..L {
            for row in BEFORE..L {
                change[part] -= self.inverse[part][row] * conditions[row][0];
            }
        }
        change
    }

    /// What is left of the conditions at the fronts, and how it changes with the direction of motion where the
    /// film stays.
    fn conditions(&self) -> [[f64; 2]; L] {
        let (motion, turned) = (self.film.motion, across(self.film.motion));
        let per_speed = 1.0 / motion[0].hypot(motion[1]);
        let mut conditions = [[0.0; 2]; L];
        for (side, fluxes) in self.fluxes.iter().enumerate() {
            for term in 0..Self::TERMS {
                let row = &mut conditions[BEFORE + side * Self::TERMS + term];
                for (share, flux) in self.film.fit.moment(term).iter().zip(fluxes) {
                    row[0] += share * per_speed * dot(*flux, motion);
                    row[1] += share * per_speed * dot(*flux, turned);
                }
            }
        }
        conditions
    }

    /// Adjoints of the conditions at the fronts, beside the answers.
    fn solve_adjoints(&mut self) {
        let terms = Self::TERMS;
        let degree = self.film.accuracy.degree;
        let per_speed = 1.0 / self.film.motion[0].hypot(self.film.motion[1]);
        self.fields.fill([0.0; L]);
        for side in 0..2 {
            let (element, r) = self.film.end(side);
            let mut loads = [[0.0; L]; M];
            for g in 0..G {
                let point = &self.film.points[(element * (degree + 1) + r) * G + g];
                let conducts = point.around * point.gap.powi(3) / self.film.part(element);
                for term in 0..terms {
                    let share = conducts * per_speed * self.film.fit.moment(term)[g];
                    for k in 0..M {
                        loads[k][BEFORE + side * terms + term] +=
                            share * self.film.shapes.values[g][k];
                    }
                }
            }
            for i in 0..=degree {
                let Some(first) = self.film.unknown(element * degree + i) else {
                    continue;
                };
                let slope = self.film.element.slopes[r][i];
                for (field, load) in self.fields[first..first + M].iter_mut().zip(&loads) {
                    for lane in BEFORE..L {
                        field[lane] = slope * load[lane];
                    }
                }
            }
        }
        self.film.matrix.solve(&mut self.fields);
        for (field, answer) in self.fields.iter_mut().zip(&self.film.answers) {
            field[..BEFORE].copy_from_slice(answer);
        }
    }

    /// Collects over all points how the equations change, by line.
    fn walk_fields(&self, lines: &mut [LineRates<L>; G]) {
        let degree = self.film.accuracy.degree;
        for element in 0..self.film.accuracy.elements {
            let part = self.film.part(element);
            for r in 0..=degree {
                let mut rises = [[0.0; L]; M];
                for i in 0..=degree {
                    let Some(first) = self.film.unknown(element * degree + i) else {
                        continue;
                    };
                    let slope = self.film.element.slopes[r][i] / part;
                    for (rise, field) in rises.iter_mut().zip(&self.fields[first..first + M]) {
                        for lane in 0..L {
                            rise[lane] += slope * field[lane];
                        }
                    }
                }
                let mut values = [[0.0; L]; M];
                if let Some(first) = self.film.unknown(element * degree + r) {
                    values.copy_from_slice(&self.fields[first..first + M]);
                }
                let share = self.film.breaks[element] + self.film.element.nodes[r] * part;
                for g in 0..G {
                    let point = &self.film.points[(element * (degree + 1) + r) * G + g];
                    let mut field = [[0.0; L]; 3];
                    for k in 0..M {
                        let (value, slope) =
                            (self.film.shapes.values[g][k], self.film.shapes.slopes[g][k]);
                        for lane in 0..L {
                            field[0][lane] += value * values[k][lane];
                            field[1][lane] += value * rises[k][lane];
                            field[2][lane] += slope * values[k][lane];
                        }
                    }
                    self.add_point(point, share, &field, &mut lines[g]);
                }
            }
        }
    }

    /// Adds what one point contributes for all fields: values, slopes along sigma, slopes along Z there.
    #[inline]
    fn add_point(
        &self,
        point: &Point,
        share: f64,
        [value, rise, side]: &[[f64; L]; 3],
        line: &mut LineRates<L>,
    ) {
        let [cos, sin] = point.normal;
        let motion = self.film.motion;
        let film = |of: &[f64; L]| motion[0] * of[0] + motion[1] * of[1];
        let (p, p_rise) = (film(value), film(rise));
        let p_side = film(side) - point.tau * p_rise;
        let conducts = point.area * point.gap * point.gap * point.gap;
        let by_rise = conducts * point.around * point.around * p_rise;
        let by_side = self.film.aspect * conducts * p_side;
        let by_tilt = self.film.aspect * conducts * p_rise;
        let (driven, driven_rise) = (
            point.area * dot(motion, point.normal),
            point.area * dot(motion, [-sin, cos]),
        );
        // The force also feels how its own weights change.
        let mut own = [[0.0; L]; 2];
        own[0][0] = point.area * p * cos;
        own[0][1] = point.area * p * sin;
        own[1][0] = -own[0][1];
        own[1][1] = own[0][0];
        let PointRates { moved, grown } = self.point_rates(point);
        let rest = 1.0 - share;
        for lane in 0..L {
            let slanted = side[lane] - point.tau * rise[lane];
            let around = by_rise * rise[lane];
            let along = by_side * slanted;
            let tilting = by_tilt * slanted + by_side * rise[lane];
            let source = driven * value[lane] + own[0][lane];
            let turning = driven_rise * value[lane] + own[1][lane];
            let stiff = 3.0 * (around + along);
            let stretched = source + around - along;
            let by_place = moved[1] * stretched + moved[2] * turning - moved[0] * stiff;
            line.place[0][lane] += rest * by_place;
            line.place[1][lane] += share * by_place;
            line.length[lane] += stretched - point.tau * tilting;
            line.slope[0][lane] += rest * tilting;
            line.slope[1][lane] += share * tilting;
            line.eccentricity[lane] += grown[1] * stretched + grown[2] * turning - grown[0] * stiff;
        }
    }

    fn point_rates(&self, point: &Point) -> PointRates {
        let [cos, sin] = point.normal;
        let (stretch, [stretch_moved, stretch_grown], turned) = self.film.map.rates(point.normal);
        PointRates {
            moved: [
                self.film.eps * sin * stretch / point.gap,
                stretch_moved,
                stretch,
            ],
            grown: [
                (self.film.eps * sin * turned - cos) / point.gap,
                stretch_grown,
                turned,
            ],
        }
    }

    /// Adds how the conditions at the fronts change with the places of their points.
    fn add_conditions(&self, lines: &mut [LineRates<L>; G]) {
        let terms = Self::TERMS;
        let motion = self.film.motion;
        let per_speed = 1.0 / motion[0].hypot(motion[1]);
        let degree = self.film.accuracy.degree;
        for side in 0..2 {
            let (element, r) = self.film.end(side);
            for (g, line) in lines.iter_mut().enumerate() {
                let point = &self.film.points[(element * (degree + 1) + r) * G + g];
                let flux = per_speed * dot(self.fluxes[side][g], motion);
                let PointRates { moved, grown } = self.point_rates(point);
                for term in 0..terms {
                    let lane = BEFORE + side * terms + term;
                    let part = flux * self.film.fit.moment(term)[g];
                    line.place[side][lane] += part * (3.0 * moved[0] - moved[1]);
                    line.eccentricity[lane] += part * (3.0 * grown[0] - grown[1]);
                    line.length[lane] -= part;
                }
            }
        }
    }

    /// From lines to eccentricity, direction and parts of the fronts.
    fn gathered(&self, lines: &[LineRates<L>; G]) -> Rates<L> {
        let terms = Self::TERMS;
        let mut rates = [[0.0; L]; L];
        for (g, line) in lines.iter().enumerate() {
            let ends = self.film.ends(g);
            let per_length = 1.0 / (ends[1].place - ends[0].place);
            for lane in 0..L {
                let longer = line.length[lane] * per_length;
                rates[lane][0] += line.eccentricity[lane];
                for (side, end) in ends.iter().enumerate() {
                    let End { slope, normal, .. } = *end;
                    let (stretch, [moved, grown], turned) = self.film.map.rates(normal);
                    let sign = if side == 0 { -1.0 } else { 1.0 };
                    let by_place = (line.place[side][lane] + sign * longer) / stretch;
                    let by_slope = line.slope[side][lane] * per_length / stretch;
                    // A front that stays at its angle moves in s, and its slope there changes.
                    let lean = slope * stretch * by_slope;
                    let by_angle = by_place - lean * moved / stretch;
                    rates[lane][0] -= turned * by_angle + lean * grown;
                    rates[lane][1] += by_angle;
                    for term in 0..terms {
                        let [value, rise] = self.film.fit.term(term);
                        rates[lane][BEFORE + side * terms + term] +=
                            by_angle * value[g] + by_slope * rise[g];
                    }
                }
            }
        }
        rates
    }
}

/// The inverse of the part of the fronts, at its places; none if it has none.
fn inverse_of_fronts<const L: usize>(rates: &Rates<L>) -> Option<Rates<L>> {
    let mut matrix = *rates;
    let mut inverse = [[0.0; L]; L];
    for (place, row) in inverse.iter_mut().enumerate() {
        row[place] = 1.0;
    }
    for column in BEFORE..L {
        let pivot = (column..L)
            .max_by(|&a, &b| matrix[a][column].abs().total_cmp(&matrix[b][column].abs()))?;
        matrix.swap(column, pivot);
        inverse.swap(column, pivot);
        let scale = 1.0 / matrix[column][column];
        if !scale.is_finite() {
            return None;
        }
        matrix[column] = matrix[column].map(|value| scale * value);
        inverse[column] = inverse[column].map(|value| scale * value);
        for row in (BEFORE..L).filter(|&row| row != column) {
            let factor = matrix[row][column];
            for k in BEFORE..L {
                matrix[row][k] -= factor * matrix[column][k];
                inverse[row][k] -= factor * inverse[column][k];
            }
        }
    }
    Some(inverse)
}
