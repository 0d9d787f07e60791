//! Where do the journals begin?
//!
//! From near the middle of their bearings they are let to settle under the loads of the first crank
//! angle, in implicit time steps of growing length, which the damping of the films keeps inside the
//! gaps (pseudo-transient continuation: C. T. Kelley, D. E. Keyes, SIAM J. Numer. Anal. 35 (1998) 508,
//! 10.1137/S0036142996304796). Rest need not be reached: the orbit is run until it closes. Under loads
//! that change it is not even wanted: a film that carries the peak of a cycle as it closes may not carry
//! it for ever, and with a tilt that the shaft imposes there need be no rest at all. The film at an edge
//! that touches carries a finite load and damps with a finite resistance, so that the journals would
//! settle into contact.

use super::balance::Stage;
use super::time_step::{Moving, Stepper, Trial};
use sommerfeld_bearing::motion::{Coordinates, add};
use sommerfeld_film::{FilmError, FilmHistory, Outcome, Step};

/// Share of the clearance by which journals begin towards their load.
const FIRST_ECCENTRICITY: f64 = 0.1;
/// Length of the first step in turns of the journal, rad.
const FIRST_STEP: f64 = 0.02;
/// Steps at most.
const LARGEST_STEPS: usize = 80;
/// At rest: the last step is at least this long (rad of turn) ...
const LONG_STEP: f64 = 1e3;
/// ... and moves no journal by more than this share of its gap.
const SMALL_MOVE: f64 = 1e-6;
/// Share of the clearance that every gap keeps where the loads change.
const KEPT_GAP: f64 = 0.1;
/// Load over stiffness times clearance below which a shaft counts as unloaded.
const UNLOADED_SHARE: f64 = 1e-6;

/// Positions (m, rad) on the way to rest under the loads of a crank angle (rad): at or near rest if the
/// loads stay as they are, else at most so far that all gaps are open.
pub(super) fn settled(
    stepper: &mut Stepper<'_>,
    crank_angle: f64,
    loads_stay: bool,
) -> Result<Vec<Coordinates>, FilmError> {
    for place in &mut stepper.places {
        place.film.restore(&FilmHistory::default());
    }
    let directions = stepper.structure.load_directions(crank_angle);
    let each = stepper.places.iter().zip(directions);
    let mut positions: Vec<Coordinates> = each
        .map(|(place, [x, y])| {
            let eccentricity = FIRST_ECCENTRICITY * place.bearing.radial_clearance;
            [eccentricity * x, eccentricity * y, 0.0, 0.0]
        })
        .collect();
    let speeds = stepper.places.iter().map(|place| {
        let frame = place.table.frame(crank_angle);
        frame.mean_speed().abs()
    });
    let speed = speeds.fold(0.0, f64::max).max(1e-3 * stepper.engine_speed);
    stepper.force_scale = stepper
        .force_scale
        .max(unloaded(stepper, crank_angle, &positions)?);
    let usual = stepper.limits;
    stepper.limits.residual = 1e-3;
    stepper.limits.step = 1e-4;
    let mut turned = FIRST_STEP;
    for _ in 0..LARGEST_STEPS {
        let stage = Stage {
            crank_angle,
            anchors: positions.clone(),
            duration: turned / speed,
            step: Step::Steady,
        };
        let (found, _) = stepper.solve(&stage, &positions, &positions)?;
        match found.outcome {
            Outcome::Converged => {
                let moved = largest_move(stepper, crank_angle, &positions, &found.positions);
                if !loads_stay && is_thin(stepper, crank_angle, &found.positions) {
                    break;
                }
                positions = found.positions;
                if turned > LONG_STEP && moved < SMALL_MOVE {
                    break;
                }
                turned *= 3.0;
            }
            Outcome::Starved => break,
            _ => turned *= 0.1,
        }
        if turned < 1e-9 {
            break;
        }
    }
    stepper.limits = usual;
    Ok(positions)
}

/// A gap is below the share that it keeps.
fn is_thin(stepper: &Stepper<'_>, crank_angle: f64, positions: &[Coordinates]) -> bool {
    let mut each = stepper.places.iter().zip(positions);
    each.any(|(place, position)| {
        place.gap(crank_angle, *position) < KEPT_GAP * place.bearing.radial_clearance
    })
}

/// Force that counts as none, N: films without a load balance where theirs is this small.
fn unloaded(
    stepper: &mut Stepper<'_>,
    crank_angle: f64,
    positions: &[Coordinates],
) -> Result<f64, FilmError> {
    let mut largest: f64 = 0.0;
    for (place, position) in stepper.places.iter_mut().zip(positions) {
        let state = place.state(crank_angle, *position, [0.0; 4]);
        place.film_solves += 1;
        let conditions = place.supply.at(crank_angle);
        let answer = place.film.linearise(&state, Step::Steady, &conditions)?;
        let rows = answer.tangent.by_position.iter().take(2);
        let stiffness = rows
            .flat_map(|row| &row[..2])
            .fold(0.0, |largest: f64, value| largest.max(value.abs()));
        largest = largest.max(UNLOADED_SHARE * stiffness * place.bearing.radial_clearance);
    }
    Ok(largest)
}

/// Largest way of a journal over its smallest gap.
fn largest_move(
    stepper: &Stepper<'_>,
    crank_angle: f64,
    from: &[Coordinates],
    to: &[Coordinates],
) -> f64 {
    let each = stepper.places.iter().zip(from).zip(to);
    each.map(|((place, from), to)| {
        place.length(add(*to, -1.0, *from)) / place.gap(crank_angle, *to).abs()
    })
    .fold(0.0, f64::max)
}

/// The first points of films with history, and the content they start from: what they remember if they
/// keep it, else that of the film at rest, or a full one where there is none.
pub(super) fn filled(
    stepper: &mut Stepper<'_>,
    start: &Moving,
    keeps_content: bool,
) -> Result<(Trial, Vec<FilmHistory>), FilmError> {
    let mut histories = Vec::with_capacity(stepper.places.len());
    let mut trial = Trial {
        end: start.clone(),
        states: Vec::new(),
        linearised: Vec::new(),
        loads: Vec::new(),
        moved: vec![0.0; start.positions.len()],
        unbalance: 0.0,
        error: 0.0,
        outcome: Outcome::Converged,
    };
    for (place, position) in stepper.places.iter_mut().zip(&start.positions) {
        let state = place.state(start.crank_angle, *position, [0.0; 4]);
        let kept = keeps_content.then(|| place.film.history());
        let answer = {
            let conditions = place.supply.at(start.crank_angle);
            place.film.react(&state, Step::Steady, &conditions)?
        };
        histories.push(if let Some(kept) = kept {
            kept
        } else if answer.outcome == Outcome::Converged {
            place.film.accept_step();
            place.film.history()
        } else {
            trial.outcome = answer.outcome;
            FilmHistory::default()
        });
        let (force, moment) = (answer.reaction.force(), answer.reaction.moment());
        trial.states.push(state);
        trial.linearised.push(answer);
        trial
            .loads
            .push([-force[0], -force[1], -moment[0], -moment[1]]);
    }
    trial.unbalance = 0.0;
    Ok((trial, histories))
}
