//! How warm is the film of a bearing at rest, place by place?
//!
//! Equation: force and load balance in a film whose viscosity is that of the temperature field, and the
//! temperatures are those of the heat that this film makes and its oil carries
//! ([`sommerfeld_film::energy`]).
//! Unknowns: position and tilt of the journal; temperature (K) of every cell and feed.
//! Method: the equilibrium and the energy equation in turn, on coarser grids first. A round foresees that a
//! warmer film makes less heat; the rounds before it are mixed in (`mixing`), and the journal's positions
//! with them. While temperatures still move, the journal goes one step of Newton per round or few, and the
//! cavitated set need not be settled. Ends where no temperature changes by more than the tolerance, with an
//! exact equilibrium and the heat as it was made.

use crate::equilibrium::{Equilibrium, EquilibriumRequest, Round, find_in_round};
use crate::mixing::{DEPTH, Mixing};
use crate::motion::{Coordinates, coordinates};
use serde::{Deserialize, Serialize};
use sommerfeld_film::{
    Bearing, Conditions, FilmError, FilmForce, Outcome, Surroundings, Warmed, Warming,
};

/// When the rounds end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeatFieldSettings {
    /// Largest change of a temperature that may be left out, K. Default 1e-3.
    pub tolerance: f64,
    /// Rounds at most, on each grid, that mix those before; as many times [`CALM_ROUNDS`] where mixing does not
    /// come nearer. Default 60.
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
    /// Film updates of all rounds, on the film's own grid: those on coarser ones cost a few of them.
    pub film_updates: usize,
    /// How it ended: [`Outcome::NoSolution`] where the heat has no way out.
    pub outcome: Outcome,
}

/// While temperatures still move by a change, the journal is found to this share of it, per K: of the load,
/// and of the gap. A K moves both by some hundredths.
const JOURNAL_SHARE: f64 = 1e-2;
/// Never to more than this share.
const COARSEST: f64 = 0.1;
/// Changes below so many tolerances are followed by rounds that find the journal as exactly as asked for.
const NEARLY: f64 = 3.0;
/// Rounds of temperatures that go their own shares, over those of mixed ones: they halve what is left in two or
/// three rounds, but a cell whose oil turns round goes slowly.
pub const CALM_ROUNDS: usize = 4;
/// On a coarser grid, changes (K) below those that its cells differ by from finer ones are none.
const COARSE_TOLERANCE: f64 = 1.0;

/// Finds the equilibrium in the film's own temperatures.
///
/// # Errors
/// As [`crate::find_equilibrium`]; [`FilmError::Unsupported`] for a film without a field of temperature.
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
    let search = Search {
        bearing,
        request,
        conditions,
        surroundings,
        settings,
    };
    search.nested(film, settings.tolerance)
}

struct Search<'a> {
    bearing: &'a Bearing,
    request: &'a EquilibriumRequest,
    conditions: &'a Conditions<'a>,
    surroundings: &'a Surroundings<'a>,
    settings: &'a HeatFieldSettings,
}

/// What a round begins with.
struct Begin {
    /// Where the journal may be.
    journal: Option<Coordinates>,
    /// Largest change of the round before, K.
    change: f64,
    goes_on: bool,
}

impl Search<'_> {
    /// From what the film on a coarser grid finds, if it does.
    fn nested(
        &self,
        film: &mut dyn FilmForce,
        tolerance: f64,
    ) -> Result<WarmEquilibrium, FilmError> {
        let rough = film
            .coarser()
            .map(|coarse| self.nested(coarse, COARSE_TOLERANCE));
        let known = match rough {
            Some(Ok(rough)) if rough.outcome == Outcome::Converged => {
                film.take_over();
                Some(coordinates(&rough.rest.state))
            }
            _ => None,
        };
        self.rounds(film, known, tolerance)
    }

    /// Film and temperatures in turn.
    fn rounds(
        &self,
        film: &mut dyn FilmForce,
        known: Option<Coordinates>,
        tolerance: f64,
    ) -> Result<WarmEquilibrium, FilmError> {
        let mut begin = Begin {
            journal: known,
            change: f64::INFINITY,
            goes_on: true,
        };
        let mut found = WarmEquilibrium {
            rest: self.rest(film, &begin)?,
            warmed: Warmed::default(),
            changes: Vec::new(),
            film_updates: 0,
            outcome: Outcome::NotConverged,
        };
        let mut mixing = Mixing::new(DEPTH);
        for round in 0..CALM_ROUNDS * self.settings.round_limit {
            if round >= self.settings.round_limit && !mixing.is_calm() {
                break;
            }
            found.film_updates += found.rest.film_updates;
            if found.rest.outcome != Outcome::Converged {
                found.outcome = found.rest.outcome;
                return Ok(found);
            }
            film.account_heat(1.0);
            let Some(mut warming) = film.led_to(self.surroundings, true) else {
                found.outcome = Outcome::NoSolution;
                return Ok(found);
            };
            if !begin.goes_on && warming.warmed.change <= tolerance {
                // What is said of the film is what it makes, not what it was foreseen to make.
                warming = film.led_to(self.surroundings, false).unwrap_or(warming);
            }
            let change = warming.warmed.change;
            found.warmed = warming.warmed;
            found.changes.push(change);
            // A coarser grid is only asked where to begin.
            let is_exact = !begin.goes_on || tolerance > self.settings.tolerance;
            if is_exact && change <= tolerance {
                found.outcome = Outcome::Converged;
                return Ok(found);
            }
            let goes_on = begin.goes_on && change > NEARLY * tolerance;
            begin = self.next(film, &mut mixing, warming, begin.journal, &found.rest);
            begin.goes_on = goes_on;
            found.rest = self.rest(film, &begin)?;
        }
        if begin.goes_on {
            begin.goes_on = false;
            found.rest = self.rest(film, &begin)?;
        }
        Ok(found)
    }

    /// Warms the film to the mix of this round and those before it; the journal goes along.
    fn next(
        &self,
        film: &mut dyn FilmForce,
        mixing: &mut Mixing,
        mut warming: Warming,
        begun: Option<Coordinates>,
        rest: &Equilibrium,
    ) -> Begin {
        let cells = warming.from.len();
        let journal = coordinates(&rest.state);
        warming.from.extend(begun.unwrap_or(journal));
        warming.led_to.extend(journal);
        let next = mixing.next(&warming.from, &warming.led_to, cells);
        film.warm(&next[..cells]);
        let mut journal = [0.0; 4];
        journal.copy_from_slice(&next[cells..]);
        Begin {
            journal: Some(journal),
            change: warming.warmed.change,
            goes_on: true,
        }
    }

    /// The journal in the film as warm as it is: as exactly as the temperatures deserve.
    fn rest(&self, film: &mut dyn FilmForce, begin: &Begin) -> Result<Equilibrium, FilmError> {
        let mut request = *self.request;
        if begin.goes_on {
            let share = (JOURNAL_SHARE * begin.change).min(COARSEST);
            let exact = &mut request.settings;
            exact.residual_tolerance = exact.residual_tolerance.max(share);
            exact.step_tolerance = exact.step_tolerance.max(share / 3.0);
        }
        let round = Round {
            start: begin.journal,
            goes_on: begin.goes_on,
        };
        find_in_round(film, self.bearing, &request, self.conditions, &round)
    }
}
