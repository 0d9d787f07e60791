//! The orbit of a bearing that does what another does, some output crank steps later.
//!
//! With the load rows of the first, `load_b(angle) = load_a(angle - later)`, its periodic orbit is the
//! orbit of the first turned by the same angle: position, film and flows are those of the first, while
//! crank angle, load and the angles that the surfaces have turned since crank angle 0 are its own.

use sommerfeld_bearing::{CyclePoint, CycleTable, JournalOrbit, LoadCycle, LoadPoint};
use sommerfeld_film::{FilmError, JournalState};

/// How the points of an orbit become those of a bearing that does the same later.
#[derive(Debug, Clone)]
pub(super) struct Turn {
    /// Output crank steps by which it is later; less than those of a period.
    steps: usize,
    /// Its load at its points: one for each output point, both ends of the period included.
    rows: Vec<LoadPoint>,
    /// What its surfaces, journal and shell, have turned further at each point, rad.
    further: Vec<[f64; 2]>,
    /// The moment of a point is what holds its tilt, and not a load.
    holds_tilt: bool,
}

impl Turn {
    /// From the cycle of the first bearing to that of one that is `steps` of `count` output crank
    /// steps later.
    ///
    /// # Errors
    /// A load cycle that cannot be run.
    pub(super) fn new(
        first: &LoadCycle,
        later: &LoadCycle,
        steps: usize,
        count: usize,
    ) -> Result<Self, FilmError> {
        let (from, to) = (CycleTable::new(first)?, CycleTable::new(later)?);
        let step = later.period / count as f64;
        let mut turn = Self {
            steps,
            rows: Vec::new(),
            further: Vec::new(),
            holds_tilt: to.holds_tilt(),
        };
        for index in 0..=count {
            let here = to.at(to.first_angle() + index as f64 * step);
            let source = turn.source(index, count);
            let there = from.frame(from.first_angle() + source as f64 * step);
            let own = to.frame(here.crank_angle);
            turn.rows.push(here);
            turn.further.push([
                own.journal_angle - there.journal_angle,
                own.shell_angle - there.shell_angle,
            ]);
        }
        Ok(turn)
    }

    /// Crank angle by which the bearing is later, rad.
    pub(super) fn later_by(&self) -> f64 {
        let angle = |index: usize| self.rows.get(index).map_or(0.0, |row| row.crank_angle);
        angle(self.steps) - angle(0)
    }

    /// Output points per period.
    fn count(&self) -> usize {
        self.rows.len().saturating_sub(1)
    }

    /// Point of the first orbit that becomes the point `index`. Both ends of a turned period are one
    /// point of the first orbit: the one that its last cycle computed.
    fn source(&self, index: usize, count: usize) -> usize {
        if self.steps == 0 || index > self.steps {
            index - self.steps
        } else {
            index + count - self.steps
        }
    }

    /// Which point the point `source` of the first orbit becomes.
    pub(super) fn index(&self, source: usize) -> usize {
        if self.steps == 0 {
            return source;
        }
        (source + self.steps - 1) % self.count().max(1) + 1
    }

    /// The angle that the journal has turned where point `index` is a point of the first orbit, rad.
    pub(super) fn journal_angle(&self, index: usize, of_first: f64) -> f64 {
        of_first + self.further[index][0]
    }

    /// Crank angle of a point, rad.
    pub(super) fn crank_angle(&self, index: usize) -> f64 {
        self.rows[index].crank_angle
    }

    /// The turned orbit. What it took to compute is that of the first.
    pub(super) fn orbit(&self, first: &JournalOrbit) -> JournalOrbit {
        let points = self.each(&first.points).into_iter().enumerate();
        JournalOrbit {
            points: points.map(|(at, point)| self.point(at, point)).collect(),
            ..first.clone()
        }
    }

    fn point(&self, index: usize, first: CyclePoint) -> CyclePoint {
        let row = &self.rows[index];
        let [journal, shell] = self.further[index];
        CyclePoint {
            crank_angle: row.crank_angle,
            load: row.load,
            moment: if self.holds_tilt {
                first.moment
            } else {
                row.moment
            },
            state: JournalState {
                journal_angle: first.state.journal_angle + journal,
                shell_angle: first.state.shell_angle + shell,
                ..first.state
            },
            ..first
        }
    }

    /// What stands at each point of the first orbit, at the points of this one; nothing for an orbit
    /// that does not fill its period.
    pub(super) fn each<T: Clone>(&self, first: &[T]) -> Vec<T> {
        if first.len() != self.rows.len() {
            return Vec::new();
        }
        let sources = (0..first.len()).map(|index| self.source(index, self.count()));
        sources.map(|source| first[source].clone()).collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;
    use sommerfeld_bearing::CycleTilt;
    use std::f64::consts::TAU;

    const COUNT: usize = 12;

    /// A load and a journal speed of `cos` over the crank angle, so many steps late.
    fn cycle(late: usize) -> LoadCycle {
        let row = |at: usize| {
            let angle = TAU * at as f64 / COUNT as f64;
            let phase = angle - TAU * late as f64 / COUNT as f64;
            LoadPoint {
                crank_angle: angle,
                load: [phase.cos(), phase.sin()],
                moment: [0.0; 2],
                journal_speed: 100.0 + 10.0 * phase.cos(),
                shell_speed: 0.0,
            }
        };
        LoadCycle {
            points: (0..COUNT).map(row).collect(),
            period: TAU,
            engine_speed: 100.0,
            journal_mass: 0.0,
            tilt: CycleTilt::Aligned,
            feed_pressures: Vec::new(),
        }
    }

    #[test]
    fn every_point_finds_its_source_and_back() {
        for steps in 0..COUNT {
            let turn = Turn::new(&cycle(0), &cycle(steps), steps, COUNT).unwrap();
            for index in 1..=COUNT {
                let source = turn.source(index, COUNT);
                assert!((1..=COUNT).contains(&source), "{index} {steps}: {source}");
                assert_eq!(turn.index(source), index);
            }
            let all: Vec<usize> = (0..=COUNT).collect();
            let turned = turn.each(&all);
            assert_eq!(turned[steps.max(1)] % COUNT, usize::from(steps == 0));
            assert_eq!(turned.len(), COUNT + 1);
            assert!(turn.each(&all[1..]).is_empty());
        }
    }

    /// The surface angles are those that the later table has by itself: the integral of its own speed.
    #[test]
    fn surface_angles_are_those_of_its_own_table() {
        let (first, later) = (cycle(0), cycle(5));
        let tables = [&first, &later].map(|cycle| CycleTable::new(cycle).unwrap());
        let turn = Turn::new(&first, &later, 5, COUNT).unwrap();
        for index in 0..=COUNT {
            let angle = |at: usize| TAU * at as f64 / COUNT as f64;
            let of_first = tables[0].frame(angle(turn.source(index, COUNT)));
            let own = tables[1].frame(angle(index));
            let found = turn.journal_angle(index, of_first.journal_angle);
            assert!((found - own.journal_angle).abs() < 1e-14, "{index}");
            // By hand: one per radian, and 0.1 of the sine of the phase.
            let late = angle(5);
            let exact = angle(index) + 0.1 * ((angle(index) - late).sin() + late.sin());
            assert!((found - exact).abs() < 0.1 * (TAU / 12.0_f64).powi(2) / 4.0);
        }
    }
}
