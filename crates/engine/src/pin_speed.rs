//! How fast the piston pin turns in rod and piston.
//!
//! A pin held in piston or rod turns with it. A floating pin, whose inertia is neglected, turns so that the
//! friction torques of its two films cancel. Of the torque M of each film on the pin the shear of the
//! relative rotation gives c (w_pin - w_shell) with c > 0, and the pressure gradient gives a part d that
//! the journal feels with the opposite sign of the shell: `c (w_pin - w_shell) = (M_journal + M_shell)/2`,
//! `d = (M_journal - M_shell)/2`. The balance at each crank angle is
//! `c_rod (w_pin - w_rod) + d_rod + c_boss w_pin + d_boss = 0`.
//! c is the integral of eta R^2/h over the film: it changes smoothly where the relative speed passes
//! through zero, and there it is interpolated. Without films, c = 2 pi eta R^3 B/C_R (Petroff 1883) and
//! d = 0: the pin turns with the share c_rod/(c_rod + c_boss) of the rod's angular speed.

use crate::PinFit;
use sommerfeld_bearing::{CyclePoint, JournalOrbit};
use sommerfeld_film::{Bearing, Outcome};

/// Angular speed of the piston pins over the working cycle.
#[derive(Debug, Clone, PartialEq)]
pub enum PinSpeed {
    /// This share of the rod's angular speed, in every cylinder: 0 with the piston, 1 with the rod.
    Share(f64),
    /// For each cylinder rows of crank angle (rad, ascending in one period) and angular speed of its pin
    /// (rad/s, engine frame), linear between them and periodic.
    Tables(Vec<Vec<[f64; 2]>>),
}

impl PinSpeed {
    /// The speed of a pin that is held so, of a floating one that of concentric films in the two bearings.
    #[must_use]
    pub fn of(fit: PinFit, small_end: &Bearing, piston_boss: &Bearing) -> Self {
        match fit {
            PinFit::FixedInPiston => Self::Share(0.0),
            PinFit::FixedInRod => Self::Share(1.0),
            PinFit::Given(share) => Self::Share(share),
            PinFit::Floating => {
                let rod = petroff(small_end);
                Self::Share(rod / (rod + petroff(piston_boss)))
            }
        }
    }

    /// Angular speed of the pin of a cylinder (0-based) at a crank angle (rad), rad/s, where its rod turns
    /// with `rod_speed` (rad/s). Not a number for a cylinder without a table.
    #[must_use]
    pub fn at(&self, cylinder: usize, crank_angle: f64, period: f64, rod_speed: f64) -> f64 {
        match self {
            Self::Share(share) => share * rod_speed,
            Self::Tables(tables) => tables
                .get(cylinder)
                .map_or(f64::NAN, |rows| periodic(rows, period, crank_angle)),
        }
    }
}

/// Friction torque of a concentric film over its relative speed and 2 pi times its viscosity, m3.
fn petroff(bearing: &Bearing) -> f64 {
    bearing.width * (0.5 * bearing.diameter).powi(3) / bearing.radial_clearance
}

fn periodic(rows: &[[f64; 2]], period: f64, angle: f64) -> f64 {
    let Some(&first) = rows.first() else {
        return f64::NAN;
    };
    // rem_euclid rounds to the period just before its end
    let along = (angle - first[0]).rem_euclid(period);
    let within = first[0] + if along < period { along } else { 0.0 };
    let behind = rows.partition_point(|row| row[0] <= within);
    let from = rows[behind.saturating_sub(1)];
    let to = match rows.get(behind) {
        Some(&to) => to,
        None => [first[0] + period, first[1]],
    };
    from[1] + (within - from[0]) / (to[0] - from[0]) * (to[1] - from[1])
}

/// How far the friction torques on a floating pin are from balance, and what comes closer.
#[derive(Debug, Clone, PartialEq)]
pub struct PinBalance {
    /// Crank angle (rad) and angular speed of the pin (rad/s): a row of [`PinSpeed::Tables`].
    pub speeds: Vec<[f64; 2]>,
    /// Largest sum of both torques over the largest of them.
    pub residual: f64,
    /// What these films said of each crank angle.
    tried: Vec<Tried>,
    /// Steps by the shear alone came no closer: the slopes are those between rounds.
    learns: bool,
}

/// The sum of both torques on a pin at one crank angle.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Tried {
    /// Speed of the pin, rad/s.
    speed: f64,
    /// Sum of the torques, N m.
    torque: f64,
    /// By how much it rises with the speed, N m s.
    slope: f64,
}

impl PinBalance {
    /// From the orbits of small end and bosses with the speeds so far. The films change with the speed:
    /// repeat, [`after`](Self::after) this one, until the residual is small. `None` if the orbits do not
    /// stand at the same crank angles, or one has no point that converged and moved.
    #[must_use]
    pub fn of(small_end: &JournalOrbit, piston_boss: &JournalOrbit) -> Option<Self> {
        Self::between(small_end, piston_boss, None)
    }

    /// The same from the orbits with the speeds of this balance. The films of both say how the torque of the
    /// pressure goes with the speed: where a thin film leads the journal around, by many times what the shear
    /// does, and steps by the shear alone would lead ever further away.
    #[must_use]
    pub fn after(&self, small_end: &JournalOrbit, piston_boss: &JournalOrbit) -> Option<Self> {
        Self::between(small_end, piston_boss, Some(self))
    }

    fn between(
        small_end: &JournalOrbit,
        piston_boss: &JournalOrbit,
        before: Option<&Self>,
    ) -> Option<Self> {
        /// A residual that falls to less than this of the one before is on a good way.
        const FALLING: f64 = 0.5;
        /// Share of the way to the balance of today's films that the speed goes: of 0.5, 0.65, 0.8 and 1
        /// the fastest in a diesel at full load, a factor of about four a round.
        const PACE: f64 = 0.8;
        /// Largest difference of equal crank angles, rad.
        const ROUND_OFF: f64 = 1e-9;
        // the last point is the first one again
        let in_rod = small_end.points.split_last()?.1;
        let in_boss = piston_boss.points.split_last()?.1;
        let pairs = || in_rod.iter().zip(in_boss);
        let apart = |(rod, boss): (&CyclePoint, &CyclePoint)| {
            (rod.crank_angle - boss.crank_angle).abs() > ROUND_OFF
        };
        if in_rod.len() != in_boss.len() || pairs().any(apart) {
            return None;
        }
        let (rod, boss) = (TorqueParts::of(in_rod)?, TorqueParts::of(in_boss)?);
        let (mut most_left, mut largest) = (0.0_f64, 0.0_f64);
        for (rod, boss) in pairs().filter(|(rod, boss)| has_film(rod) && has_film(boss)) {
            let torques = [rod, boss].map(|point| point.reaction.friction_torque_journal);
            most_left = most_left.max((torques[0] + torques[1]).abs());
            largest = largest.max(torques[0].abs()).max(torques[1].abs());
        }
        let residual = most_left / largest;
        let learns = before.is_some_and(|it| it.learns || residual > FALLING * it.residual);
        let before = before.filter(|_| learns).map_or(&[][..], |it| &it.tried);
        let tried = pairs().enumerate().map(|(k, (at_rod, at_boss))| {
            let shear = [rod.coefficient[k], boss.coefficient[k]];
            let by_shear = shear[0] * relative_speed(at_rod) + shear[1] * relative_speed(at_boss);
            let now = Tried {
                speed: relative_speed(at_boss),
                torque: by_shear + rod.pressure[k] + boss.pressure[k],
                slope: shear[0] + shear[1],
            };
            now.since(before.get(k))
        });
        let tried: Vec<Tried> = tried.collect();
        let speeds = tried.iter().zip(in_rod).map(|(tried, at_rod)| {
            let balanced = tried.speed - tried.torque / tried.slope;
            let speed = tried.speed + PACE * (balanced - tried.speed);
            [at_rod.crank_angle, speed]
        });
        Some(Self {
            speeds: speeds.collect(),
            residual,
            tried,
            learns,
        })
    }
}

impl Tried {
    /// With the slope between this and what was tried before: at least that of the shear, which is its own.
    fn since(self, before: Option<&Self>) -> Self {
        /// Most by which a slope rises in one round, which two torques that differ by chance ask for.
        const STEEPER: f64 = 100.0;
        let Some(before) = before else {
            return self;
        };
        let between = (self.torque - before.torque) / (self.speed - before.speed);
        let slope = if between.is_finite() {
            between.clamp(self.slope, STEEPER * self.slope.max(before.slope))
        } else {
            self.slope.max(before.slope)
        };
        Self { slope, ..self }
    }
}

/// The friction torque on a pin in one film over the cycle.
struct TorqueParts {
    /// Torque of shear over relative speed, N m s.
    coefficient: Vec<f64>,
    /// Torque of the pressure gradient, N m, 0 where the film did not converge.
    pressure: Vec<f64>,
}

impl TorqueParts {
    fn of(points: &[CyclePoint]) -> Option<Self> {
        /// Share of the largest relative speed below which shear is not divided by it.
        const SLOW: f64 = 0.02;
        let fastest = points
            .iter()
            .fold(0.0_f64, |most, point| most.max(relative_speed(point).abs()));
        let known: Vec<(usize, f64)> = points
            .iter()
            .enumerate()
            .filter(|(_, point)| has_film(point))
            .filter(|(_, point)| relative_speed(point).abs() > SLOW * fastest)
            .map(|(index, point)| {
                let reaction = &point.reaction;
                let shear =
                    0.5 * (reaction.friction_torque_journal + reaction.friction_torque_shell);
                (index, shear / relative_speed(point))
            })
            .filter(|(_, coefficient)| *coefficient > 0.0)
            .collect();
        let pressure = points.iter().map(|point| {
            let reaction = &point.reaction;
            match has_film(point) {
                true => 0.5 * (reaction.friction_torque_journal - reaction.friction_torque_shell),
                false => 0.0,
            }
        });
        Some(Self {
            coefficient: filled(&known, points.len())?,
            pressure: pressure.collect(),
        })
    }
}

fn has_film(point: &CyclePoint) -> bool {
    point.outcome == Outcome::Converged
}

fn relative_speed(point: &CyclePoint) -> f64 {
    point.state.journal_speed - point.state.shell_speed
}

/// Values at all of `count` evenly spaced points of a ring from those that are `known`, ascending: linear
/// between them. `None` if none is known.
fn filled(known: &[(usize, f64)], count: usize) -> Option<Vec<f64>> {
    let (&first, &last) = (known.first()?, known.last()?);
    let around =
        |(index, value): (usize, f64), turns: f64| (index as f64 + turns * count as f64, value);
    let value = |index: usize| {
        let behind = known.partition_point(|(at, _)| *at <= index);
        let from = match behind.checked_sub(1) {
            Some(before) => around(known[before], 0.0),
            None => around(last, -1.0),
        };
        let to = match known.get(behind) {
            Some(&next) => around(next, 0.0),
            None => around(first, 1.0),
        };
        from.1 + (index as f64 - from.0) / (to.0 - from.0) * (to.1 - from.1)
    };
    Some((0..count).map(value).collect())
}
