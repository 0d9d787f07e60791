//! What acts on the bearing at any crank angle?
//!
//! Between its rows the load table is linear, over its end it is periodic. A prescribed tilt is a
//! periodic cubic between its rows, so that its rate, which squeezes the film, is continuous: the
//! slope at a row is that of the parabola through the row and its neighbours. The angles that journal
//! and shell have turned are the integrals of their speeds over time from crank angle 0, where the
//! journal's +X lies on the frame's +X; the linear interpolation is integrated exactly.

use crate::{CycleTilt, LoadCycle, LoadPoint};
use sommerfeld_film::{FilmError, JournalState};

/// A checked load table with the surface angles at its rows.
#[derive(Debug, Clone)]
pub struct CycleTable<'a> {
    cycle: &'a LoadCycle,
    /// Angles of journal and shell at each row, and one period after the first, rad.
    turned: Vec<[f64; 2]>,
    /// The same at crank angle 0.
    turned_at_zero: [f64; 2],
    /// Change of the prescribed tilt per crank angle at each row; empty where none is prescribed.
    tilt_slopes: Vec<[f64; 2]>,
}

/// Tilt about X and Y (rad) and its rate (rad/s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldTilt {
    /// Rotation vector, rad.
    pub tilt: [f64; 2],
    /// Its change per time, rad/s.
    pub rate: [f64; 2],
}

impl<'a> CycleTable<'a> {
    /// The table of a load cycle, checked.
    ///
    /// # Errors
    /// [`FilmError::Unsupported`] for a table that is empty, not sorted, longer than its period or
    /// without a positive crank speed and period.
    pub fn new(cycle: &'a LoadCycle) -> Result<Self, FilmError> {
        check(cycle)?;
        let mut table = Self {
            cycle,
            turned: vec![[0.0; 2]],
            turned_at_zero: [0.0; 2],
            tilt_slopes: Vec::new(),
        };
        if let CycleTilt::Prescribed(tilts) = &cycle.tilt {
            table.tilt_slopes = table.slopes(tilts);
        }
        let mut angles = [0.0; 2];
        for interval in 0..cycle.points.len() {
            let (from, to) = table.interval(interval);
            let duration = (to.crank_angle - from.crank_angle) / cycle.engine_speed;
            angles[0] += 0.5 * duration * (from.journal_speed + to.journal_speed);
            angles[1] += 0.5 * duration * (from.shell_speed + to.shell_speed);
            table.turned.push(angles);
        }
        table.turned_at_zero = table.turned_since_first_row(0.0);
        Ok(table)
    }

    /// Crank angle of the first row, rad.
    pub fn first_angle(&self) -> f64 {
        self.cycle.points[0].crank_angle
    }

    /// All rows are equal, and so are those of the supply.
    pub fn is_constant(&self) -> bool {
        let first = &self.cycle.points[0];
        let tilt_is_constant = match &self.cycle.tilt {
            CycleTilt::Prescribed(tilts) => tilts.iter().all(|tilt| *tilt == tilts[0]),
            CycleTilt::Aligned | CycleTilt::Free => true,
        };
        let mut supplies = self.cycle.feed_pressures.iter();
        let is_supplied_alike = supplies.all(crate::PressureCycle::is_constant);
        tilt_is_constant
            && is_supplied_alike
            && self.cycle.points.iter().all(|point| {
                point.load == first.load
                    && point.moment == first.moment
                    && point.journal_speed == first.journal_speed
                    && point.shell_speed == first.shell_speed
            })
    }

    /// The tilt is free and answers the moments.
    pub fn frees_tilt(&self) -> bool {
        self.cycle.tilt == CycleTilt::Free
    }

    /// The tilt is prescribed.
    pub fn holds_tilt(&self) -> bool {
        matches!(self.cycle.tilt, CycleTilt::Prescribed(_))
    }

    /// The journal never tilts.
    pub fn is_aligned(&self) -> bool {
        self.cycle.tilt == CycleTilt::Aligned
    }

    /// The prescribed tilt and its rate at a crank angle (rad, any turn).
    pub fn held_tilt(&self, crank_angle: f64) -> Option<HeldTilt> {
        let CycleTilt::Prescribed(tilts) = &self.cycle.tilt else {
            return None;
        };
        let (_, index, s) = self.locate(crank_angle);
        let (from, to) = self.interval(index);
        let length = to.crank_angle - from.crank_angle;
        let next = (index + 1) % tilts.len();
        let (slope_from, slope_to) = (self.tilt_slopes[index], self.tilt_slopes[next]);
        let axis = |axis: usize| {
            let (a, b) = (tilts[index][axis], tilts[next][axis]);
            let (p, q) = (length * slope_from[axis], length * slope_to[axis]);
            let square = 3.0 * (b - a) - 2.0 * p - q;
            let cube = 2.0 * (a - b) + p + q;
            let value = a + s * (p + s * (square + s * cube));
            let slope = (p + s * (2.0 * square + s * 3.0 * cube)) / length;
            (value, slope * self.cycle.engine_speed)
        };
        let (x, y) = (axis(0), axis(1));
        Some(HeldTilt {
            tilt: [x.0, y.0],
            rate: [x.1, y.1],
        })
    }

    /// Slopes of a row value at each row: of the parabola through it and its neighbours.
    fn slopes(&self, values: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let count = values.len();
        let secant = |index: usize| {
            let (from, to) = self.interval(index);
            let length = to.crank_angle - from.crank_angle;
            let (a, b) = (values[index], values[(index + 1) % count]);
            (length, [0, 1].map(|axis| (b[axis] - a[axis]) / length))
        };
        (0..count)
            .map(|row| {
                let ((before, s0), (behind, s1)) = (secant((row + count - 1) % count), secant(row));
                [0, 1].map(|axis| (s0[axis] * behind + s1[axis] * before) / (before + behind))
            })
            .collect()
    }

    /// Largest load, N.
    pub fn largest_load(&self) -> f64 {
        self.cycle
            .points
            .iter()
            .map(|point| point.load[0].hypot(point.load[1]))
            .fold(0.0, f64::max)
    }

    /// Load, moment and speeds at a crank angle (rad, any turn).
    pub fn at(&self, crank_angle: f64) -> LoadPoint {
        let (_, index, share) = self.locate(crank_angle);
        let (from, to) = self.interval(index);
        let between = |a: f64, b: f64| a + share * (b - a);
        LoadPoint {
            crank_angle,
            load: [0, 1].map(|axis| between(from.load[axis], to.load[axis])),
            moment: [0, 1].map(|axis| between(from.moment[axis], to.moment[axis])),
            journal_speed: between(from.journal_speed, to.journal_speed),
            shell_speed: between(from.shell_speed, to.shell_speed),
        }
    }

    /// Speeds and surface angles at a crank angle (rad, any turn); position and rates are zero.
    pub fn frame(&self, crank_angle: f64) -> JournalState {
        let point = self.at(crank_angle);
        let turned = self.turned_since_first_row(crank_angle);
        JournalState {
            journal_speed: point.journal_speed,
            shell_speed: point.shell_speed,
            journal_angle: turned[0] - self.turned_at_zero[0],
            shell_angle: turned[1] - self.turned_at_zero[1],
            ..JournalState::default()
        }
    }

    /// Angles of journal and shell since the first row of turn 0, rad.
    fn turned_since_first_row(&self, crank_angle: f64) -> [f64; 2] {
        let (turn, index, share) = self.locate(crank_angle);
        let (from, to) = self.interval(index);
        let duration = share * (to.crank_angle - from.crank_angle) / self.cycle.engine_speed;
        let mean = |a: f64, b: f64| a + 0.5 * share * (b - a);
        let since_row = [
            duration * mean(from.journal_speed, to.journal_speed),
            duration * mean(from.shell_speed, to.shell_speed),
        ];
        let per_turn = self.turned[self.cycle.points.len()];
        [0, 1].map(|i| turn * per_turn[i] + self.turned[index][i] + since_row[i])
    }

    /// Turn, interval and share of the interval at a crank angle.
    fn locate(&self, crank_angle: f64) -> (f64, usize, f64) {
        let from_first = crank_angle - self.first_angle();
        let turn = (from_first / self.cycle.period).floor();
        let within = self.first_angle() + from_first - turn * self.cycle.period;
        let index = self
            .cycle
            .points
            .partition_point(|point| point.crank_angle <= within)
            .saturating_sub(1);
        let (from, to) = self.interval(index);
        let share = (within - from.crank_angle) / (to.crank_angle - from.crank_angle);
        (turn, index, share.clamp(0.0, 1.0))
    }

    /// Rows at both ends of an interval; the last one ends with the first row of the next turn.
    fn interval(&self, index: usize) -> (LoadPoint, LoadPoint) {
        let points = &self.cycle.points;
        let to = points.get(index + 1).copied().unwrap_or(LoadPoint {
            crank_angle: points[0].crank_angle + self.cycle.period,
            ..points[0]
        });
        (points[index], to)
    }
}

fn check(cycle: &LoadCycle) -> Result<(), FilmError> {
    let refuse = |reason| Err(FilmError::Unsupported { reason });
    let (Some(first), Some(last)) = (cycle.points.first(), cycle.points.last()) else {
        return refuse("the load table has no rows");
    };
    let positive = |value: f64| value.is_finite() && value > 0.0;
    if !positive(cycle.engine_speed) || !positive(cycle.period) {
        return refuse("period and crank speed of a load cycle must be positive");
    }
    if !(cycle.journal_mass.is_finite() && cycle.journal_mass >= 0.0) {
        return refuse("the journal mass must not be negative");
    }
    let sorted = cycle
        .points
        .windows(2)
        .all(|pair| pair[0].crank_angle < pair[1].crank_angle);
    if !sorted || last.crank_angle - first.crank_angle >= cycle.period {
        return refuse(
            "the rows of a load table must rise in crank angle and span less than a period",
        );
    }
    let finite = cycle.points.iter().all(|point| {
        let sum = point.load[0] + point.load[1] + point.moment[0] + point.moment[1];
        (sum + point.crank_angle + point.journal_speed + point.shell_speed).is_finite()
    });
    if !finite {
        return refuse("the load table holds a value that is not finite");
    }
    if let CycleTilt::Prescribed(tilts) = &cycle.tilt {
        if tilts.len() != cycle.points.len() {
            return refuse("a prescribed tilt needs one value for each row of the load table");
        }
        if !tilts.iter().flatten().all(|tilt| tilt.is_finite()) {
            return refuse("the prescribed tilt holds a value that is not finite");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::f64::consts::TAU;

    fn row(crank_angle: f64, load: f64, journal_speed: f64) -> LoadPoint {
        LoadPoint {
            crank_angle,
            load: [load, 0.0],
            moment: [0.0; 2],
            journal_speed,
            shell_speed: 0.0,
        }
    }

    fn cycle() -> LoadCycle {
        LoadCycle {
            points: vec![
                row(-1.0, 10.0, 100.0),
                row(1.0, 30.0, 200.0),
                row(2.0, 0.0, 100.0),
            ],
            period: TAU,
            engine_speed: 100.0,
            journal_mass: 0.0,
            tilt: CycleTilt::Aligned,
            feed_pressures: Vec::new(),
        }
    }

    #[test]
    fn a_prescribed_tilt_is_met_at_its_rows_and_its_rate_is_its_derivative() {
        let mut cycle = cycle();
        let rows = vec![[1e-4, 0.0], [3e-4, -2e-4], [0.0, 1e-4]];
        cycle.tilt = CycleTilt::Prescribed(rows.clone());
        let table = CycleTable::new(&cycle).unwrap();
        for (point, tilt) in cycle.points.iter().zip(&rows) {
            let held = table.held_tilt(point.crank_angle + TAU).unwrap();
            assert!((held.tilt[0] - tilt[0]).hypot(held.tilt[1] - tilt[1]) < 1e-16);
        }
        let step = 1e-5;
        for angle in [-0.99, -0.3, 1.0, 1.7, 2.0, 4.0, TAU - 1.0] {
            let at = |angle| table.held_tilt(angle).unwrap();
            let (before, here, behind) = (at(angle - step), at(angle), at(angle + step));
            for axis in 0..2 {
                let rate = (behind.tilt[axis] - before.tilt[axis]) / (2.0 * step) * 100.0;
                let error = (here.rate[axis] - rate).abs();
                assert!(error < 1e-6, "{angle}: {} {rate}", here.rate[axis]);
            }
        }
        cycle.points.pop();
        assert!(CycleTable::new(&cycle).is_err());
    }

    #[test]
    fn a_smooth_tilt_is_followed_to_third_order() {
        let errors = [20_u32, 40].map(|count| {
            let angle = |row: u32| TAU * f64::from(row) / f64::from(count);
            let mut cycle = cycle();
            cycle.points = (0..count).map(|i| row(angle(i), 1.0, 100.0)).collect();
            cycle.tilt =
                CycleTilt::Prescribed((0..count).map(|i| angle(i).sin_cos().into()).collect());
            let table = CycleTable::new(&cycle).unwrap();
            let mut worst = [0.0_f64; 2];
            for i in 0..777 {
                let at = TAU * f64::from(i) / 777.0;
                let held = table.held_tilt(at).unwrap();
                worst[0] = worst[0].max((held.tilt[0] - at.sin()).abs());
                worst[1] = worst[1].max((held.rate[0] / 100.0 - at.cos()).abs());
            }
            worst
        });
        assert!(errors[0][0] / errors[1][0] > 7.0, "{errors:?}");
        assert!(errors[0][1] / errors[1][1] > 3.5, "{errors:?}");
    }

    #[test]
    fn loads_are_linear_and_periodic() {
        let cycle = cycle();
        let table = CycleTable::new(&cycle).unwrap();
        assert!((table.at(0.0).load[0] - 20.0).abs() < 1e-12);
        assert!((table.at(TAU).load[0] - 20.0).abs() < 1e-12);
        let closing = 0.5 * (2.0 + TAU - 1.0);
        assert!((table.at(closing).load[0] - 5.0).abs() < 1e-12);
    }

    #[test]
    fn angles_are_the_exact_integrals_of_the_speeds() {
        let cycle = cycle();
        let table = CycleTable::new(&cycle).unwrap();
        assert_eq!(table.frame(0.0).journal_angle, 0.0);
        // From 0 to 1 the mean speed is 175, from -1 to 0 it is 125; crank speed 100.
        assert!((table.frame(1.0).journal_angle - 1.75).abs() < 1e-12);
        assert!((table.frame(-1.0).journal_angle + 1.25).abs() < 1e-12);
        let per_turn = 3.0 + 1.5 + (TAU - 3.0);
        let turn = table.frame(0.5 + TAU).journal_angle - table.frame(0.5).journal_angle;
        assert!((turn - per_turn).abs() < 1e-12);
    }

    #[test]
    fn one_row_is_a_constant_load_and_bad_tables_are_refused() {
        let mut cycle = cycle();
        cycle.points.swap(0, 2);
        assert!(CycleTable::new(&cycle).is_err());
        cycle.points.truncate(1);
        assert!(CycleTable::new(&cycle).unwrap().is_constant());
        cycle.points.clear();
        assert!(CycleTable::new(&cycle).is_err());
    }
}
