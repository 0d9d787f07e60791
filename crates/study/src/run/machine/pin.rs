//! How fast does a piston pin turn that floats in rod and piston?
//!
//! So that the friction torques of its two films cancel at every crank angle
//! ([`PinBalance`]). The films change with the speed: orbits and balance take turns until the torques
//! cancel.

use super::units::{UnitFound, solve_alone};
use super::{ProgressCallback, RunError, Work};
use crate::progress::ProgressEvent;
use sommerfeld_bearing::LoadCycle;
use sommerfeld_engine::{PinBalance, PinSpeed};

/// Turns of orbits and balance at most.
const LARGEST_PASSES: usize = 16;
/// The torques cancel when less of them is left, over the largest torque.
const TOLERANCE: f64 = 0.01;

/// The orbits of small end and piston boss, in this order, with the speed of the pin that balances them.
pub(super) fn solve_pin(
    work: &Work<'_>,
    speed: usize,
    films: [usize; 2],
    progress: &mut ProgressCallback<'_>,
) -> Result<UnitFound, RunError> {
    let at = &work.speeds[speed];
    let mut cycles = films.map(|film| at.cycles[film].clone());
    let mut pass = 0;
    let mut before: Option<PinBalance> = None;
    loop {
        let mut share = |film: usize, event: ProgressEvent| {
            // Most pins settle in a quarter of the passes allowed.
            let expected = (LARGEST_PASSES / 4).max(pass + 1) as f64;
            let done = (pass as f64 + 0.5 * (film as f64 + event.done)) / expected;
            progress(ProgressEvent { done, ..event })
        };
        let [rod, boss] = cycles.clone();
        let mut in_rod = solve_alone(work, speed, films[0], rod, &mut |event| share(0, event))?;
        let mut in_boss = solve_alone(work, speed, films[1], boss, &mut |event| share(1, event))?;
        pass += 1;
        let balance = match &before {
            None => PinBalance::of(&in_rod.orbit, &in_boss.orbit),
            Some(before) => before.after(&in_rod.orbit, &in_boss.orbit),
        };
        let Some(balance) = balance else {
            return Ok(vec![in_rod, in_boss]);
        };
        if balance.residual < TOLERANCE {
            return Ok(vec![in_rod, in_boss]);
        }
        if pass == LARGEST_PASSES {
            let note = format!(
                "{}: not converged, {:.1} % of the friction torque on the floating pin is not balanced \
                 after {pass} passes; engine.pin_speed_share gives the pin a speed instead",
                work.place(speed, films[0]),
                100.0 * balance.residual
            );
            in_rod.notes.push(note);
            in_rod.mark_not_converged();
            in_boss.mark_not_converged();
            return Ok(vec![in_rod, in_boss]);
        }
        set_pin_speeds(&mut cycles, &PinSpeed::Tables(vec![balance.speeds.clone()]));
        before = Some(balance);
    }
}

/// Gives the load cycles of rod and boss other speeds of the pin; the rod swings as before.
fn set_pin_speeds([in_rod, in_boss]: &mut [LoadCycle; 2], speeds: &PinSpeed) {
    for (rod_row, boss_row) in in_rod.points.iter_mut().zip(&mut in_boss.points) {
        let rod = boss_row.journal_speed - rod_row.journal_speed;
        boss_row.journal_speed = speeds.at(0, boss_row.crank_angle, in_boss.period, rod);
        rod_row.journal_speed = boss_row.journal_speed - rod;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sommerfeld_bearing::{CycleTilt, LoadPoint};

    fn cycle(speeds: [f64; 2]) -> LoadCycle {
        let row = |at: usize| LoadPoint {
            crank_angle: at as f64,
            load: [0.0; 2],
            moment: [0.0; 2],
            journal_speed: speeds[at],
            shell_speed: 0.0,
        };
        LoadCycle {
            points: vec![row(0), row(1)],
            period: 2.0,
            engine_speed: 1.0,
            journal_mass: 0.0,
            tilt: CycleTilt::Aligned,
            feed_pressures: Vec::new(),
        }
    }

    #[test]
    fn both_films_see_the_same_rod_before_and_after() {
        // Rod at 4 and -4, pin at 2 and 0; then at 1 and -1.
        let mut cycles = [cycle([-2.0, 4.0]), cycle([2.0, 0.0])];
        let other = PinSpeed::Tables(vec![vec![[0.0, 1.0], [1.0, -1.0]]]);
        set_pin_speeds(&mut cycles, &other);
        let speeds = cycles.map(|cycle| [0, 1].map(|at| cycle.points[at].journal_speed));
        assert_eq!(speeds, [[-3.0, 3.0], [1.0, -1.0]]);
    }
}
