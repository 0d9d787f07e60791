//! How warm is the film of a bearing at rest, place by place?
//!
//! Equation: force and load balance in a film whose viscosity is that of the temperature field, and the
//! temperatures are those of the heat that this film makes and its oil carries
//! ([`sommerfeld_film::energy`]).
//! Unknowns: position and tilt of the journal; temperature (K) of every cell and feed.
//! Method: the equilibrium and the energy equation in turn. A round foresees that a warmer film makes less
//! heat, and the rounds before it are mixed in ([`crate::mixing`]). The journal is found to less while
//! temperatures still move. Ends where no temperature changes by more than the tolerance, with the heat as
//! it was made.

use crate::equilibrium::{
    Equilibrium, EquilibriumRequest, EquilibriumSettings, find_beside, find_equilibrium,
};
use crate::mixing::Mixing;
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

/// The journal is found to this share of what the temperatures still move, per K: of the load, and of the
/// gap. A K moves both by some hundredths.
const JOURNAL_SHARE: f64 = 1e-3;
/// The same before a round has been made, K.
const FIRST_CHANGE: f64 = 10.0;

/// Limits of a search for the journal while temperatures still move by a change (K).
fn coarse(exact: EquilibriumSettings, change: f64) -> EquilibriumSettings {
    EquilibriumSettings {
        residual_tolerance: exact.residual_tolerance.max(JOURNAL_SHARE * change),
        step_tolerance: exact.step_tolerance.max(JOURNAL_SHARE * change),
        ..exact
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
    let exact = request.settings;
    let mut request = EquilibriumRequest {
        settings: coarse(exact, FIRST_CHANGE),
        ..*request
    };
    let mut found = WarmEquilibrium {
        rest: find_equilibrium(film, bearing, &request, conditions)?,
        warmed: Warmed::default(),
        changes: Vec::new(),
        film_updates: 0,
        outcome: Outcome::NotConverged,
    };
    let mut find_time=0.0; let mut mixing = Mixing::new();
    for _ in 0..settings.round_limit {
        found.film_updates += found.rest.film_updates;
        if found.rest.outcome != Outcome::Converged {
            found.outcome = found.rest.outcome;
            return Ok(found);
        }
        let clock=std::time::Instant::now();film.account_heat(1.0);
        let Some(mut warming) = film.led_to(surroundings, true) else {
            found.outcome = Outcome::NoSolution;
            return Ok(found);
        };
        let heat_time=clock.elapsed().as_secs_f64();
        let is_exact = request.settings == exact;
        if is_exact && warming.warmed.change <= settings.tolerance {
            // What is said of the film is what it makes, not what it was foreseen to make.
            warming = film.led_to(surroundings, false).unwrap_or(warming);
        }
        let change = warming.warmed.change;
        found.warmed = warming.warmed;
        found.changes.push(change);
        if std::env::var("TRACE").is_ok() { println!("DBG heat {:.2} ms find {:.2} change {change:.4e} updates {} settings {:.1e} {:?}", 1e3*heat_time, 1e3*find_time, found.rest.film_updates, request.settings.step_tolerance, found.rest.table.iter().map(|r| (format!("{:.1e} {:.1e}", r.residual, r.step), r.settled)).collect::<Vec<_>>()); }
        if is_exact && change <= settings.tolerance {
            found.outcome = Outcome::Converged;
            return Ok(found);
        }
        film.warm(&mixing.next(&warming.from, &warming.led_to));
        request.settings = if change > 30.0 * settings.tolerance {
            coarse(exact, change)
        } else {
            exact
        };
        request.frame.tilt = found.rest.state.tilt;
        let clock=std::time::Instant::now();found.rest = find_beside(film, bearing, &request, conditions, &found.rest)?;find_time=clock.elapsed().as_secs_f64();
    }
    Ok(found)
}
