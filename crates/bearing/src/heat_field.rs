//! How warm is the film of a bearing at rest, place by place?
//!
//! Equation: force and load balance in a film whose viscosity is that of the temperature field, and the
//! temperatures are those of the heat that this film makes and its oil carries
//! ([`sommerfeld_film::energy`]).
//! Unknowns: position and tilt of the journal; temperature (K) of every cell and feed.
//! Method: the equilibrium and the energy equation in turn; each round moves the temperatures by a share
//! of their change, because a warmer film makes less heat, so that a whole change goes too far. The share
//! falls where changes grow, and comes back. The journal is found to less while temperatures still move. Ends
//! where no temperature changes by more than the tolerance.

use crate::equilibrium::{Equilibrium, EquilibriumRequest, find_beside, find_equilibrium};
use serde::{Deserialize, Serialize};
use sommerfeld_film::{Bearing, Conditions, FilmError, FilmForce, Outcome, Surroundings, Warmed};

/// When the rounds end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeatFieldSettings {
    /// Largest change of a temperature that may be left out, K. Default 1e-3.
    pub tolerance: f64,
    /// Rounds at most. Default 60.
    pub round_limit: usize,
}

impl Default for HeatFieldSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            round_limit: 60,
        }
    }
}

/// A bearing at rest with the temperatures of its film.
#[derive(Debug, Clone, PartialEq)]
pub struct WarmEquilibrium {
    /// Where the journal rests in the warm film.
    pub rest: Equilibrium,
    /// Temperatures, and where the heat goes.
    pub warmed: Warmed,
    /// Largest change of a temperature per round, K.
    pub changes: Vec<f64>,
    /// Film updates of all rounds.
    pub film_updates: usize,
    /// How it ended: [`Outcome::NoSolution`] where the heat has no way out.
    pub outcome: Outcome,
}

/// Largest share: what a film whose heat falls with its temperature can take.
const FIRST_SHARE: f64 = 0.5;
/// Smallest share.
const LEAST_SHARE: f64 = 0.1;
/// Changes above so many tolerances are followed with a journal found to these limits.
const COARSE_CHANGES: f64 = 100.0;
const COARSE_RESIDUAL: f64 = 1e-6;
const COARSE_STEP: f64 = 1e-4;

/// Share of the next round, from that of the last one and the ratio of its change to the one before. A
/// change that grew was overshot; those of the first rounds, in which the ruptured film moves, may do so too,
/// so that the share comes back.
fn next_share(share: f64, ratio: f64) -> f64 {
    if ratio > 1.1 {
        (0.6 * share).max(LEAST_SHARE)
    } else {
        (1.3 * share).min(FIRST_SHARE)
    }
}

/// Finds the equilibrium in the film's own temperatures.
///
/// # Errors
/// As [`find_equilibrium`]; [`FilmError::Unsupported`] for a film without a field of temperature.
pub fn warm_equilibrium(
    film: &mut dyn FilmForce,
    bearing: &Bearing,
    request: &EquilibriumRequest,
    conditions: &Conditions<'_>,
    surroundings: &Surroundings<'_>,
    settings: &HeatFieldSettings,
) -> Result<WarmEquilibrium, FilmError> {
    if film.field().is_none() {
        return Err(FilmError::Unsupported {
            reason: "a field of temperature needs model = \"field\"",
        });
    }
    let mut request = *request;
    let mut found = WarmEquilibrium {
        rest: find_equilibrium(film, bearing, &request, conditions)?,
        warmed: Warmed::default(),
        changes: Vec::new(),
        film_updates: 0,
        outcome: Outcome::NotConverged,
    };
    let exact = request.settings;
    let mut share = FIRST_SHARE;
    for _ in 0..settings.round_limit {
        found.film_updates += found.rest.film_updates;
        if found.rest.outcome != Outcome::Converged {
            found.outcome = found.rest.outcome;
            return Ok(found);
        }
        film.account_heat(1.0);
        let Some(warmed) = film.warm(surroundings, share) else {
            found.outcome = Outcome::NoSolution;
            return Ok(found);
        };
        found.warmed = warmed;
        if let Some(before) = found.changes.last() {
            share = next_share(share, warmed.change / before);
        }
        let still_moves = warmed.change > COARSE_CHANGES * settings.tolerance;
        found.changes.push(warmed.change);
        if warmed.change <= settings.tolerance {
            found.outcome = Outcome::Converged;
            return Ok(found);
        }
        if still_moves {
            request.settings.residual_tolerance = exact.residual_tolerance.max(COARSE_RESIDUAL);
            request.settings.step_tolerance = exact.step_tolerance.max(COARSE_STEP);
        } else {
            request.settings = exact;
        }
        request.frame.tilt = found.rest.state.tilt;
        found.rest = find_beside(film, bearing, &request, conditions, &found.rest)?;
    }
    Ok(found)
}
