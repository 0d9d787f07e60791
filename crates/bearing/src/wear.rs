//! How much do surfaces that touch wear over a cycle, and where?
//!
//! ```text
//! depth(a, z) = k int p_c |U| dt                  Archard; U = R (w_J - w_S)
//! pv(a, z)    = (p + p_c) |U|                     p film pressure, p_c contact pressure
//! e(a, z)     = mu int p_c |U| dt                 friction energy of asperities
//! ```
//! k wear coefficient of the surface, 1/Pa = m3/(N m); mu boundary friction. Kept is the wear load
//! `int p_c |U| dt`, J/m2, which depends on neither.
//!
//! Each surface keeps cells of its own, those of the film's grid at the first instant. A film cell
//! lies over some of them once the surface has turned, and what it carries is shared out by the
//! overlap: an even field stays even, and the volume worn is `k int N |U| dt` to round-off, N the
//! contact pressure over the whole bearing.
//!
//! Limits: sliding across the axis and by squeeze motion is small beside U and left out, and so are
//! asperities in grooves. The friction energy holds no viscous shear: the film keeps that as a sum,
//! not per cell. The film pressure of pv is gauge; below zero the sum counts as zero.
//!
//! Reference: J. F. Archard, J. Appl. Phys. 24 (1953) 981, 10.1063/1.1721448.

use serde::{Deserialize, Serialize};
use sommerfeld_film::{Extreme, FilmField, JournalState};
use std::f64::consts::TAU;

/// Sliding speed of the journal against the shell, m/s, with the sign of their relative rotation;
/// `radius` of the bore, m.
#[must_use]
pub fn sliding_speed(radius: f64, state: &JournalState) -> f64 {
    radius * (state.journal_speed - state.shell_speed)
}

/// What contact and pressure have done to one surface: cell `i` around, `j` along the axis, at
/// `i * axial.len() + j`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct WearMap {
    /// Centres of the cells around, rad, from +X of the surface.
    pub angles: Vec<f64>,
    /// Centres of the cells along the axis, m, from the mid-plane.
    pub axial: Vec<f64>,
    /// Angles that the cells span, rad.
    pub angle_widths: Vec<f64>,
    /// Widths of the cells along the axis, m.
    pub axial_widths: Vec<f64>,
    /// Radius of the bore, m.
    pub radius: f64,
    /// Time over which the map was taken, s.
    pub duration: f64,
    /// Wear load `int p_c |U| dt`, J/m2.
    pub wear_load: Vec<f64>,
    /// Largest of film and contact pressure together times sliding speed, W/m2.
    pub peak_pressure_velocity: Vec<f64>,
    /// Its mean over the time, W/m2.
    pub mean_pressure_velocity: Vec<f64>,
}

impl WearMap {
    /// Depth worn over the time of the map for a wear coefficient (1/Pa), m.
    #[must_use]
    pub fn depth(&self, coefficient: f64) -> Vec<f64> {
        self.wear_load
            .iter()
            .map(|load| coefficient * load)
            .collect()
    }

    /// Depth worn per time, m/s; zero for a map of no time.
    #[must_use]
    pub fn depth_rate(&self, coefficient: f64) -> Vec<f64> {
        self.depth(coefficient * self.per_time())
    }

    /// The deepest place: depth per time, m/s, and where.
    #[must_use]
    pub fn deepest_rate(&self, coefficient: f64) -> Extreme {
        let cells = 0..self.wear_load.len();
        let deepest = cells.max_by(|&a, &b| self.wear_load[a].total_cmp(&self.wear_load[b]));
        deepest.map_or_else(Extreme::default, |k| Extreme {
            value: coefficient * self.per_time() * self.wear_load[k],
            angle: self.angles[k / self.axial.len()],
            axial: self.axial[k % self.axial.len()],
        })
    }

    /// Volume worn over the time of the map, m3.
    #[must_use]
    pub fn volume(&self, coefficient: f64) -> f64 {
        coefficient * self.total()
    }

    /// Volume worn per time, m3/s; zero for a map of no time.
    #[must_use]
    pub fn volume_rate(&self, coefficient: f64) -> f64 {
        coefficient * self.per_time() * self.total()
    }

    /// Friction energy of asperities over the time of the map for a boundary friction coefficient,
    /// J/m2: without the viscous shear of the film.
    #[must_use]
    pub fn friction_energy(&self, boundary_friction: f64) -> Vec<f64> {
        self.depth(boundary_friction)
    }

    /// Wear load over the whole surface, J: contact pressure over the bearing times sliding distance.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.integral(&self.wear_load)
    }

    /// Integral over the surface (m2) of a value per cell.
    #[must_use]
    pub fn integral(&self, values: &[f64]) -> f64 {
        let along = self.axial.len();
        let cells = values.iter().enumerate();
        let sum: f64 = cells
            .map(|(k, value)| value * self.angle_widths[k / along] * self.axial_widths[k % along])
            .sum();
        sum * self.radius
    }

    fn per_time(&self) -> f64 {
        if self.duration > 0.0 {
            1.0 / self.duration
        } else {
            0.0
        }
    }
}

/// Fills the [`WearMap`] of one surface instant by instant.
#[derive(Debug, Clone)]
pub struct WearRecord {
    map: WearMap,
    /// Pressure velocity of the cells at one instant, and what they take of the wear load.
    now: Vec<[f64; 2]>,
}

impl WearRecord {
    /// Nothing seen yet, on a surface with the cells of `field`; `radius` of the bore, m.
    #[must_use]
    pub fn new(radius: f64, field: &FilmField<'_>) -> Self {
        let zero = vec![0.0; field.pressure.len()];
        Self {
            now: vec![[0.0; 2]; zero.len()],
            map: WearMap {
                angles: field.angles.to_vec(),
                axial: field.axial.to_vec(),
                angle_widths: field.angle_widths.to_vec(),
                axial_widths: field.axial_widths.to_vec(),
                radius,
                duration: 0.0,
                wear_load: zero.clone(),
                peak_pressure_velocity: zero.clone(),
                mean_pressure_velocity: zero,
            },
        }
    }

    /// Takes the fields of one instant, at which the surface has turned by `turned` (rad) and slides at
    /// `sliding` (m/s, either sign), for a time (s). The field has as many cells as the first one.
    pub fn see(&mut self, field: &FilmField<'_>, turned: f64, sliding: f64, duration: f64) {
        let along = self.map.axial.len();
        let speed = sliding.abs();
        let contact = |cell: usize| field.contact_pressure.get(cell).copied().unwrap_or(0.0);
        self.now.fill([0.0; 2]);
        let shares = Overlaps::of(&self.map, field, turned);
        for (from, to, share) in shares.shares {
            for j in 0..along {
                let cell = from * along + j;
                let touching = contact(cell);
                let pressed = (field.pressure[cell] + touching).max(0.0);
                let now = &mut self.now[to * along + j];
                now[0] += share * pressed * speed;
                now[1] += share * touching * speed;
            }
        }
        let map = &mut self.map;
        map.duration += duration;
        for (k, [pressed, touching]) in self.now.iter().enumerate() {
            map.wear_load[k] += touching * duration;
            map.mean_pressure_velocity[k] += pressed * duration;
            map.peak_pressure_velocity[k] = map.peak_pressure_velocity[k].max(*pressed);
        }
    }

    /// What was seen.
    #[must_use]
    pub fn finish(mut self) -> WearMap {
        let per_time = self.map.per_time();
        for mean in &mut self.map.mean_pressure_velocity {
            *mean *= per_time;
        }
        self.map
    }
}

/// Which cells of a surface the cells of a field lie over.
struct Overlaps {
    /// Cell of the field, cell of the surface, and the share of the latter that is covered.
    shares: Vec<(usize, usize, f64)>,
}

impl Overlaps {
    /// Of a surface that has turned by `turned`, rad.
    fn of(map: &WearMap, field: &FilmField<'_>, turned: f64) -> Self {
        let count = map.angles.len();
        let stands = field
            .angles
            .iter()
            .zip(&map.angles)
            .all(|(at, own)| at - turned == *own);
        if stands {
            return Self {
                shares: (0..count).map(|i| (i, i, 1.0)).collect(),
            };
        }
        let cells = map.angles.iter().zip(&map.angle_widths);
        let starts: Vec<f64> = cells.map(|(angle, width)| angle - 0.5 * width).collect();
        let mut shares = Vec::with_capacity(2 * count + 1);
        for (from, (angle, width)) in field.angles.iter().zip(field.angle_widths).enumerate() {
            let begin = angle - 0.5 * width - turned;
            let mut at = starts[0] + (begin - starts[0]).rem_euclid(TAU);
            let mut left = *width;
            let mut to = starts.partition_point(|start| *start <= at).max(1) - 1;
            while left > 0.0 {
                let end = starts.get(to + 1).copied().unwrap_or(starts[0] + TAU);
                let covered = left.min(end - at).max(0.0);
                shares.push((from, to, covered / map.angle_widths[to]));
                // The last cell takes what rounding leaves of a turn.
                left = if end - at >= left {
                    0.0
                } else {
                    left - covered
                };
                (to, at) = if to + 1 < count {
                    (to + 1, end)
                } else {
                    (0, starts[0])
                };
            }
        }
        Self { shares }
    }
}

/// Fills the maps of shell and journal together.
#[derive(Debug, Clone)]
pub struct CycleWear {
    /// Of the shell.
    pub on_shell: WearRecord,
    /// Of the journal, which turns in the film's frame.
    pub on_journal: WearRecord,
}

impl CycleWear {
    /// Nothing seen yet; `radius` of the bore, m.
    #[must_use]
    pub fn new(radius: f64, field: &FilmField<'_>) -> Self {
        Self {
            on_shell: WearRecord::new(radius, field),
            on_journal: WearRecord::new(radius, field),
        }
    }

    /// Takes the fields that belong to a state for a time (s).
    pub fn see(&mut self, field: &FilmField<'_>, state: &JournalState, duration: f64) {
        let sliding = sliding_speed(self.on_shell.map.radius, state);
        self.on_shell
            .see(field, state.shell_angle, sliding, duration);
        self.on_journal
            .see(field, state.journal_angle, sliding, duration);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    const AROUND: usize = 40;
    const AXIAL: [f64; 3] = [-0.01, -0.002, 0.007];
    const AXIAL_WIDTHS: [f64; 3] = [0.008, 0.008, 0.01];
    const RADIUS: f64 = 0.025;

    /// Uneven cells around: centres and widths, rad.
    fn cells() -> (Vec<f64>, Vec<f64>) {
        let face = |i: usize| {
            let even = i as f64 * TAU / AROUND as f64;
            even + 0.05 * even.sin()
        };
        (0..AROUND)
            .map(|i| (0.5 * (face(i) + face(i + 1)), face(i + 1) - face(i)))
            .unzip()
    }

    /// Shows a contact pressure over the angle to a surface that turns, instant by instant.
    fn record(contact: impl Fn(f64, usize) -> f64, turned: &[f64], duration: f64) -> WearMap {
        let (angles, angle_widths) = cells();
        let zero = vec![0.0; 3 * AROUND];
        let mut record = None;
        for (instant, turned) in turned.iter().enumerate() {
            let seen: Vec<f64> = angles
                .iter()
                .flat_map(|a| [contact(*a, instant); 3])
                .collect();
            let field = FilmField {
                angles: &angles,
                axial: &AXIAL,
                angle_widths: &angle_widths,
                axial_widths: &AXIAL_WIDTHS,
                pressure: &vec![2e6; 3 * AROUND],
                film_fraction: &zero,
                film_thickness: &zero,
                temperature: &[],
                contact_pressure: &seen,
            };
            record
                .get_or_insert_with(|| WearRecord::new(RADIUS, &field))
                .see(&field, *turned, -8.0, duration);
        }
        record.unwrap().finish()
    }

    fn assert_all(values: &[f64], expected: f64) {
        for value in values {
            assert!((value / expected - 1.0).abs() < 1e-12, "{value} {expected}");
        }
    }

    /// k p U T wherever the surface has turned to, and the energy and p-v that belong to it.
    #[test]
    fn an_even_contact_pressure_wears_evenly() {
        for speed in [0.0, 0.37, -2.3, 11.0] {
            let turned: Vec<f64> = (0..25).map(|i| speed * f64::from(i)).collect();
            let map = record(|_, _| 3e5, &turned, 2e-3);
            assert_all(&map.depth(1e-16), 1e-16 * 3e5 * 8.0 * 0.05);
            assert_all(&map.depth_rate(1e-16), 1e-16 * 3e5 * 8.0);
            assert_all(&map.friction_energy(0.08), 0.08 * 3e5 * 8.0 * 0.05);
            assert_all(&map.peak_pressure_velocity, 2.3e6 * 8.0);
            assert_all(&map.mean_pressure_velocity, 2.3e6 * 8.0);
            let area = TAU * RADIUS * 0.026;
            assert_all(&[map.volume(1e-16)], 1e-16 * 3e5 * 8.0 * 0.05 * area);
            assert_all(&[map.volume_rate(1e-16)], 1e-16 * 3e5 * 8.0 * area);
        }
    }

    /// However the surface turns, it takes what the film carries: the sum over the film's cells.
    #[test]
    fn turning_keeps_the_volume() {
        let patch = |angle: f64, instant: usize| {
            1e6 * (2.0 * (angle - 0.3 * instant as f64).cos() - 1.0).max(0.0)
        };
        let turned: Vec<f64> = (0..30).map(|i| 0.71 * f64::from(i) - 4.0).collect();
        let (angles, widths) = cells();
        let mut expected = 0.0;
        for instant in 0..turned.len() {
            for (angle, width) in angles.iter().zip(&widths) {
                expected += patch(*angle, instant) * width * RADIUS * 0.026 * 8.0 * 1e-3;
            }
        }
        assert_all(&[record(patch, &turned, 1e-3).total()], expected);
        assert_all(&[record(patch, &[0.0; 30], 1e-3).total()], expected);
    }

    /// A patch that turns with a surface wears one place of it, and another one all around.
    #[test]
    fn a_patch_wears_where_it_is_fixed() {
        let step = 0.5 * (5.0_f64.sqrt() - 1.0) * TAU; // spreads evenly
        let patch = |angle: f64, instant: usize| {
            let from = (angle - step * instant as f64).rem_euclid(TAU);
            if (2.0..2.6).contains(&from) { 1e6 } else { 0.0 }
        };
        let turned: Vec<f64> = (0..400).map(|i| step * f64::from(i)).collect();
        let with = record(patch, &turned, 1e-3);
        let deepest = with.deepest_rate(1.0);
        // All the time but for cells that the patch only cuts.
        assert!(deepest.value > 0.99 * 8e6 && (2.1..2.5).contains(&deepest.angle));
        for (i, angle) in with.angles.iter().enumerate() {
            if !(1.6..3.0).contains(angle) {
                assert_eq!(with.wear_load[3 * i], 0.0, "{angle}");
            }
        }
        let stands = record(patch, &[0.0; 400], 1e-3);
        let even = 0.4 * 8e6 * 0.6 / TAU;
        for load in &stands.wear_load {
            assert!((load / even - 1.0).abs() < 0.1, "{load} {even}");
        }
    }

    #[test]
    fn nothing_seen_is_no_wear() {
        let (angles, angle_widths) = cells();
        let zero = vec![0.0; 3 * AROUND];
        let field = FilmField {
            angles: &angles,
            axial: &AXIAL,
            angle_widths: &angle_widths,
            axial_widths: &AXIAL_WIDTHS,
            pressure: &zero,
            film_fraction: &zero,
            film_thickness: &zero,
            temperature: &[],
            contact_pressure: &[],
        };
        let mut both = CycleWear::new(RADIUS, &field);
        let none = both.on_journal.clone().finish();
        assert_eq!(none.volume_rate(1e-16), 0.0);
        assert_eq!(none.deepest_rate(1e-16).value, 0.0);
        let state = JournalState {
            journal_speed: 300.0,
            shell_speed: 100.0,
            ..JournalState::default()
        };
        assert_eq!(sliding_speed(RADIUS, &state), 5.0);
        both.see(&field, &state, 1.0);
        assert_eq!(both.on_shell.finish().total(), 0.0);
    }
}
