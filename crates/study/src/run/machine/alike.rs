//! Which bearings of a machine do the same at another crank angle?
//!
//! In an evenly turning engine with even firing the big ends differ by a phase alone, and so do most
//! mains: their films need to be solved once. Two bearings are alike if one load cycle is the other a
//! whole number of output crank steps later, row by row, and the bearings are equal in all that the film
//! reads, seen after that shift: holes and profiles that turn with the journal must stand where those of
//! the other stood. Nothing else is asked for: where torsion, uneven firing, another bank or another
//! crank step makes a difference, the rows differ and every bearing is solved by itself.

use super::units::{BearingFound, UnitFound, WarmBearing, recorder, refused, solve_alone};
use super::{ProgressCallback, RunError, Work};
use crate::results::CycleFields;
use crate::run::cycle::bearing_cycle;
use crate::run::turn::Turn;
use sommerfeld_bearing::{
    CycleTable, CycleTilt, JournalOrbit, LoadCycle, LoadPoint, PressureCycle,
};
use sommerfeld_film::{Bearing, Carrier, Outcome};
use std::f64::consts::{PI, TAU};

/// Loads, speeds and pressures are equal if they differ by less, over the largest of them: the crank
/// train's arithmetic leaves 1e-12 between phases, and such a difference moves the journal by the same
/// share of the clearance, five orders below the closure of an orbit.
const LOAD_TOLERANCE: f64 = 1e-9;
/// Places on the journal are equal if they differ by less, over an output crank step: the angles are
/// integrals of speeds that are linear between rows, and err by more than round-off.
const PLACE_TOLERANCE: f64 = 0.01;

/// A bearing that does the same as the first of its group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Later {
    /// Index in the plan.
    pub bearing: usize,
    /// Output crank steps by which it is later.
    pub steps: usize,
}

/// A bearing as supplied with its load.
#[derive(Clone, Copy)]
struct Loaded<'a> {
    bearing: &'a Bearing,
    cycle: &'a LoadCycle,
}

/// Groups of bearings that do the same, each begun by the one that is solved, whose steps are 0;
/// `points` output points fill the period.
pub(super) fn groups(
    candidates: &[usize],
    (bearings, cycles): (&[Bearing], &[LoadCycle]),
    points: usize,
) -> Vec<Vec<Later>> {
    let loaded = |index: usize| Loaded {
        bearing: &bearings[index],
        cycle: &cycles[index],
    };
    let mut groups: Vec<Vec<Later>> = Vec::new();
    for &bearing in candidates {
        let own = loaded(bearing);
        let found = groups.iter_mut().find_map(|group| {
            let steps = steps_between(loaded(group[0].bearing), own, points)?;
            Some((group, steps))
        });
        match found {
            Some((group, steps)) => group.push(Later { bearing, steps }),
            None => groups.push(vec![Later { bearing, steps: 0 }]),
        }
    }
    groups
}

/// Fewest output crank steps by which the second does later what the first does.
fn steps_between(first: Loaded<'_>, later: Loaded<'_>, points: usize) -> Option<usize> {
    let same_kind = (first.cycle.period, first.cycle.engine_speed)
        == (later.cycle.period, later.cycle.engine_speed)
        && first.cycle.journal_mass == later.cycle.journal_mass
        && first.cycle.tilt == later.cycle.tilt
        && !matches!(first.cycle.tilt, CycleTilt::Prescribed(_));
    if !same_kind || !has_even_rows(first.cycle, points) || !has_even_rows(later.cycle, points) {
        return None;
    }
    let tables = (
        CycleTable::new(first.cycle).ok()?,
        CycleTable::new(later.cycle).ok()?,
    );
    let scale = Scale::of(first);
    (0..points).find(|steps| {
        let by = later.cycle.period * *steps as f64 / points as f64;
        rows_agree(&first.cycle.points, &later.cycle.points, *steps, &scale)
            && pressures_agree(first.cycle, later.cycle, by)
            && bearings_agree(first, later, &tables, by, points)
    })
}

/// One row at each output point, from crank angle 0 on.
fn has_even_rows(cycle: &LoadCycle, points: usize) -> bool {
    let step = cycle.period / points as f64;
    let mut rows = cycle.points.iter().enumerate();
    cycle.points.len() == points
        && rows.all(|(at, row)| (row.crank_angle - at as f64 * step).abs() < 1e-9 * step)
}

/// What counts as nothing.
struct Scale {
    load: f64,
    moment: f64,
    speed: f64,
}

impl Scale {
    fn of(bearing: Loaded<'_>) -> Self {
        let largest = |value: fn(&LoadPoint) -> f64| {
            let rows = bearing.cycle.points.iter();
            LOAD_TOLERANCE * rows.map(value).fold(0.0, f64::max)
        };
        let load = largest(|row| row.load[0].hypot(row.load[1]));
        Self {
            load,
            moment: load * bearing.bearing.width,
            speed: largest(|row| row.journal_speed.abs().max(row.shell_speed.abs())),
        }
    }
}

fn rows_agree(first: &[LoadPoint], later: &[LoadPoint], steps: usize, scale: &Scale) -> bool {
    let count = first.len();
    let near = |a: f64, b: f64, scale: f64| (a - b).abs() <= scale;
    first.iter().enumerate().all(|(at, a)| {
        let b = &later[(at + steps) % count];
        (0..2).all(|axis| {
            near(a.load[axis], b.load[axis], scale.load)
                && near(a.moment[axis], b.moment[axis], scale.moment)
        }) && near(a.journal_speed, b.journal_speed, scale.speed)
            && near(a.shell_speed, b.shell_speed, scale.speed)
    })
}

/// Supply pressures over the period, of the same feeds. Tables are linear between their rows: they
/// agree everywhere if they do at the rows of both.
fn pressures_agree(first: &LoadCycle, later: &LoadCycle, by: f64) -> bool {
    let period = first.period;
    let (of_first, of_later) = (&first.feed_pressures, &later.feed_pressures);
    let agree = |a: &PressureCycle, b: &PressureCycle| {
        let here = a.points.iter().map(|point| point[0]);
        let there = b.points.iter().map(|point| point[0] - by);
        let largest = a
            .points
            .iter()
            .map(|point| point[1].abs())
            .fold(0.0, f64::max);
        a.feed == b.feed
            && here.chain(there).all(|angle| {
                let apart = a.at(angle, period) - b.at(angle + by, period);
                apart.abs() <= LOAD_TOLERANCE * largest
            })
    };
    of_first.len() == of_later.len() && of_first.iter().zip(of_later).all(|(a, b)| agree(a, b))
}

/// All that the film reads of the bearings is equal when the second is as far as the first was `by`
/// (rad) before.
fn bearings_agree(
    first: Loaded<'_>,
    later: Loaded<'_>,
    (of_first, of_later): &(CycleTable<'_>, CycleTable<'_>),
    by: f64,
    points: usize,
) -> bool {
    let (before, now) = (of_first.frame(-by), of_later.frame(0.0));
    let journal = now.journal_angle - before.journal_angle;
    let shell = now.shell_angle - before.shell_angle;
    let tolerance = PLACE_TOLERANCE * first.cycle.period / points as f64;
    let is_turn = |angle: f64| ((angle + PI).rem_euclid(TAU) - PI).abs() <= tolerance;
    if !is_turn(shell) || (first.bearing.journal.varies_around() && !is_turn(journal)) {
        return false;
    }
    let mut same = later.bearing.clone();
    for (feed, of_first) in same.feeds.iter_mut().zip(&first.bearing.feeds) {
        let is_alike =
            feed.carried_by == Carrier::Journal && is_turn(feed.angle + journal - of_first.angle);
        if is_alike {
            feed.angle = of_first.angle;
        }
        let apart = (feed.pressure - of_first.pressure).abs();
        if apart <= LOAD_TOLERANCE * of_first.pressure.abs() {
            feed.pressure = of_first.pressure;
        }
        if feed.carried_by == Carrier::Journal && !is_alike {
            return false;
        }
    }
    same == *first.bearing
}

/// The orbit of the first of a group, and those of the others, which follow from it. One that did not
/// converge tells nothing of the others: they are solved by themselves.
pub(super) fn solve_alike(
    work: &Work<'_>,
    speed: usize,
    group: &[Later],
    progress: &mut ProgressCallback<'_>,
) -> Result<UnitFound, RunError> {
    let Some((first, others)) = group.split_first() else {
        return Ok(Vec::new());
    };
    let first = first.bearing;
    let cycles = &work.speeds[speed].cycles;
    let points = work.points();
    let turn = |other: &Later| {
        Turn::new(&cycles[first], &cycles[other.bearing], other.steps, points)
            .map_err(|error| refused(work, speed, other.bearing, error))
    };
    let turns: Vec<Turn> = others.iter().map(turn).collect::<Result<_, _>>()?;
    let warm = WarmBearing::of(work, speed, first, cycles[first].clone(), progress)?;
    let (case, duty) = (&warm.case, &warm.duty);
    let recorder = recorder(case, duty, speed).with_turns(&turns);
    let solved = bearing_cycle(case, duty, work.film, None, recorder, progress)
        .map_err(|error| refused(work, speed, first, error))?;
    let mut all = vec![warm.found(first, solved.results)];
    if solved.stopped {
        return Ok(all);
    }
    if !stands_for_others(&all[0].orbit) {
        for other in others {
            let cycle = cycles[other.bearing].clone();
            all.push(solve_alone(work, speed, other.bearing, cycle, progress)?);
        }
        return Ok(all);
    }
    let mut fields = solved.turned.into_iter();
    for (other, turn) in others.iter().zip(&turns) {
        let load = cycles[other.bearing].clone();
        let turned = turned(&all[0], *other, load, (turn, fields.next()));
        all.push(turned);
    }
    Ok(all)
}

/// Closed, or without any oil, which does not depend on the crank angle.
fn stands_for_others(orbit: &JournalOrbit) -> bool {
    match orbit.outcome {
        Outcome::Converged => true,
        Outcome::Starved => orbit.points.is_empty(),
        Outcome::NotConverged | Outcome::NoSolution => false,
    }
}

fn turned(
    first: &BearingFound,
    other: Later,
    load: LoadCycle,
    (turn, fields): (&Turn, Option<CycleFields>),
) -> BearingFound {
    BearingFound {
        bearing: other.bearing,
        load,
        determinate_load: None,
        orbit: turn.orbit(&first.orbit),
        feed_flows: turn.each(&first.feed_flows),
        fields,
        turned_from: Some((first.bearing, turn.later_by())),
        heat: first.heat.clone(),
        notes: Vec::new(),
    }
}
