//! The load a machine puts on the journal over one period, and the journal orbit that answers it.

use serde::{Deserialize, Serialize};
use sommerfeld_film::{Extreme, FilmSummary, JournalState, Outcome, Reaction};

/// One row of a load table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LoadPoint {
    /// Crank angle, rad.
    pub crank_angle: f64,
    /// Load ON the journal in the shell frame, N.
    pub load: [f64; 2],
    /// Moment ON the journal about the mid-plane shell centre, N m.
    pub moment: [f64; 2],
    /// Angular speed of the journal in the frame of the loads, rad/s.
    pub journal_speed: f64,
    /// Angular speed of the shell in the frame of the loads, rad/s.
    pub shell_speed: f64,
}

/// What holds the tilt of the journal over the cycle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CycleTilt {
    /// The journal stays parallel to the shell.
    #[default]
    Aligned,
    /// The tilt is free and answers the moments of the table.
    Free,
    /// The tilt is prescribed: rotation vector about X and Y, rad, one for each row. Between the rows
    /// it is a periodic cubic with the slopes of the parabolas through three rows: tilt and tilt rate
    /// are continuous, and both enter the film.
    Prescribed(Vec<[f64; 2]>),
}

/// A periodic load table: linear between its rows, which are sorted by crank angle, do not repeat
/// the first row at the end, and span less than one period.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LoadCycle {
    /// Rows in ascending crank angle.
    pub points: Vec<LoadPoint>,
    /// Period, rad of crank angle.
    pub period: f64,
    /// Crank speed, rad/s: sets time.
    pub engine_speed: f64,
    /// Mass that moves with the journal, kg; 0 for a massless journal.
    pub journal_mass: f64,
    /// What holds the tilt.
    #[serde(default)]
    pub tilt: CycleTilt,
    /// Supply pressures that change over the period; feeds without a table keep theirs.
    #[serde(default)]
    pub feed_pressures: Vec<PressureCycle>,
}

/// The supply pressure of one feed over the period: rows as those of a [`LoadCycle`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PressureCycle {
    /// Index into the feeds of the bearing.
    pub feed: usize,
    /// Crank angle, rad, and gauge pressure at the supply, Pa.
    pub points: Vec<[f64; 2]>,
}

impl PressureCycle {
    /// Pressure at a crank angle (rad, any turn) for a period (rad), Pa: linear between the rows.
    /// Not a number without rows.
    #[must_use]
    pub fn at(&self, crank_angle: f64, period: f64) -> f64 {
        let Some(&first) = self.points.first() else {
            return f64::NAN;
        };
        let within = first[0] + (crank_angle - first[0]).rem_euclid(period);
        let behind = self.points.partition_point(|point| point[0] <= within);
        let from = self.points[behind.saturating_sub(1)];
        let to = match self.points.get(behind) {
            Some(&to) => to,
            None => [first[0] + period, first[1]],
        };
        from[1] + (within - from[0]) / (to[0] - from[0]) * (to[1] - from[1])
    }

    /// Mean over the period (rad), Pa. Not a number without rows.
    #[must_use]
    pub fn mean(&self, period: f64) -> f64 {
        let Some(&first) = self.points.first() else {
            return f64::NAN;
        };
        let closing = [first[0] + period, first[1]];
        let ends = self.points.iter().skip(1).chain([&closing]);
        let area: f64 = self
            .points
            .iter()
            .zip(ends)
            .map(|(from, to)| 0.5 * (from[1] + to[1]) * (to[0] - from[0]))
            .sum();
        area / period
    }

    /// All rows are equal.
    pub(crate) fn is_constant(&self) -> bool {
        self.points.windows(2).all(|pair| pair[0][1] == pair[1][1])
    }
}

/// The bearing at one crank angle of the periodic orbit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CyclePoint {
    /// Crank angle, rad, from the first row of the load table onwards.
    pub crank_angle: f64,
    /// Load on the journal, N.
    pub load: [f64; 2],
    /// Moment on the journal, N m: of the load table or, where the tilt is prescribed, the one that
    /// it takes to hold it.
    pub moment: [f64; 2],
    /// Journal state in the shell frame.
    pub state: JournalState,
    /// The film's answer.
    pub reaction: Reaction,
    /// Extremes, flows, power.
    pub summary: FilmSummary,
    /// How the step ended.
    pub outcome: Outcome,
}

/// The journal orbit over the last computed cycle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JournalOrbit {
    /// One point per output crank step over one period; the last point is one period after the
    /// first.
    pub points: Vec<CyclePoint>,
    /// Cycles computed until the orbit closed.
    pub cycles: usize,
    /// Largest distance of the journal centre between the last two cycles at equal crank angle,
    /// over the radial clearance.
    pub closure: f64,
    /// Accepted time steps over all cycles.
    pub steps: usize,
    /// Film updates (factorisations) over all cycles.
    pub film_solves: usize,
    /// Converged only if every step and the closure did.
    pub outcome: Outcome,
}

/// The edge that a tilt has all but closed: 0 the front (z = -B/2), 1 the rear (z = +B/2). `films` are
/// the film thicknesses there, m.
#[must_use]
pub fn closing_edge(films: [f64; 2], radial_clearance: f64) -> Option<usize> {
    /// Share of the clearance below which an edge counts as closing where no balance is found.
    const CLOSING: f64 = 0.01;
    let edge = usize::from(films[1] < films[0]);
    let is_tilted = films[edge] < 0.5 * films[1 - edge];
    (is_tilted && films[edge] < CLOSING * radial_clearance).then_some(edge)
}

impl JournalOrbit {
    /// Mean over the cycle of any value of its points (trapezoidal rule; equal crank steps).
    #[must_use]
    pub fn mean(&self, value: impl Fn(&CyclePoint) -> f64) -> f64 {
        let pairs = self.points.windows(2);
        let count = pairs.len();
        if count == 0 {
            return self.points.first().map_or(f64::NAN, value);
        }
        let sum: f64 = pairs
            .map(|pair| 0.5 * (value(&pair[0]) + value(&pair[1])))
            .sum();
        sum / count as f64
    }

    /// Mean power lost in the film, W: friction and squeeze together.
    #[must_use]
    pub fn mean_power_loss(&self) -> f64 {
        self.mean(|point| point.summary.power_loss())
    }

    /// Mean friction power, W.
    #[must_use]
    pub fn mean_friction_power(&self) -> f64 {
        self.mean(|point| point.summary.friction_power)
    }

    /// Mean flow out of both bearing ends, m3/s.
    #[must_use]
    pub fn mean_side_flow(&self) -> f64 {
        self.mean(|point| point.summary.side_flow[0] + point.summary.side_flow[1])
    }

    /// Mean flow in through all feeds, m3/s.
    #[must_use]
    pub fn mean_feed_flow(&self) -> f64 {
        self.mean(|point| point.summary.feed_flow)
    }

    /// Mean eccentricity, m.
    #[must_use]
    pub fn mean_eccentricity(&self) -> f64 {
        self.mean(|point| point.state.eccentricity())
    }

    /// The first point that did not converge because the moment presses an edge of a freely tilting
    /// journal to contact, with that edge: 0 the front (z = -B/2), 1 the rear (z = +B/2). As an edge
    /// closes, the area that carries it shrinks faster than its pressure grows: the moment of a film
    /// between rigid surfaces is bounded, and beyond it the edge touches.
    #[must_use]
    pub fn edge_contact(&self, cycle: &LoadCycle, radial_clearance: f64) -> Option<(f64, usize)> {
        if cycle.tilt != CycleTilt::Free {
            return None;
        }
        let failed = |point: &&CyclePoint| point.outcome != Outcome::Converged;
        let point = self.points.iter().find(failed)?;
        let edge = closing_edge(point.summary.edge_film_thickness, radial_clearance)?;
        Some((point.crank_angle, edge))
    }

    /// Smallest film thickness over the cycle, m, with its place and its crank angle (rad).
    #[must_use]
    pub fn minimum_film_thickness(&self) -> Option<(Extreme, f64)> {
        self.points
            .iter()
            .map(|point| (point.summary.minimum_film_thickness, point.crank_angle))
            .min_by(|a, b| a.0.value.total_cmp(&b.0.value))
    }

    /// Largest film pressure over the cycle, Pa (gauge), with its place and its crank angle (rad).
    #[must_use]
    pub fn peak_film_pressure(&self) -> Option<(Extreme, f64)> {
        self.points
            .iter()
            .map(|point| (point.summary.peak_film_pressure, point.crank_angle))
            .max_by(|a, b| a.0.value.total_cmp(&b.0.value))
    }
}
