//! Which film model can do what a study asks, and why another cannot.
//!
//! Only the film on a grid takes every bearing. The others are made for a plain one: what they cannot
//! answer is refused by name.

use super::study::{BearingCase, Duty, FilmModel, FilmSettings, TiltCondition};
use crate::film_tables::{Scheme, StoredFilms, holding};
use sommerfeld_bearing::CycleTilt;
use sommerfeld_film::{Bearing, Cavitation, Elasticity, Finish, Inlet};

/// The scheme of the databases that a model looks up.
pub(crate) const fn scheme(model: FilmModel) -> Scheme {
    match model {
        FilmModel::Field
        | FilmModel::ShortBearing
        | FilmModel::Mobility
        | FilmModel::LongBearing
        | FilmModel::Online
        | FilmModel::Database => Scheme::Combined,
        FilmModel::Superposition => Scheme::Superposition,
    }
}

/// Why a model cannot do what a case asks; `None` where it can.
pub(crate) fn refusal(
    model: FilmModel,
    case: &BearingCase,
    settings: &FilmSettings,
) -> Option<String> {
    if model.is_field() {
        return None;
    }
    if !stays_aligned(&case.duty) && !tilts(model, case.bearing.cavitation, &settings.databases) {
        return Some("it has no tilt".to_owned());
    }
    refusal_of_bearing(model, &case.bearing, settings)
}

/// Whether a model answers to tilt where the ruptured film is closed this way: of a superposition, whether all of
/// its databases do.
pub(crate) fn tilts(model: FilmModel, closure: Cavitation, databases: &[StoredFilms]) -> bool {
    if model != FilmModel::Superposition {
        return model.tilts(closure);
    }
    let mut own = databases
        .iter()
        .filter(|one| one.scheme() == scheme(model))
        .peekable();
    own.peek().is_some() && own.all(StoredFilms::is_tilted)
}

/// [`refusal`] of the bearing alone.
pub(crate) fn refusal_of_bearing(
    model: FilmModel,
    bearing: &Bearing,
    settings: &FilmSettings,
) -> Option<String> {
    if model.is_field() {
        return None;
    }
    if !model.overlooks_feeds() && !bearing.feeds.is_empty() {
        return Some(
            "it has no grooves and holes; film.feeds = \"left-out\" leaves them out of every model"
                .to_owned(),
        );
    }
    if let Some(reason) = not_plain(bearing) {
        return Some(reason.to_owned());
    }
    let is_at_zero = (bearing.ambient_pressure, bearing.cavitation_pressure) == (0.0, 0.0);
    if !model.overlooks_feeds() && !is_at_zero {
        return Some("it needs ambient and cavitation pressure 0".to_owned());
    }
    if model.is_looked_up() {
        return holding(&settings.databases, scheme(model), bearing).err();
    }
    None
}

/// What of a bearing only the film on a grid can follow.
fn not_plain(bearing: &Bearing) -> Option<&'static str> {
    if bearing.finish != Finish::Smooth {
        return Some("it has smooth surfaces alone");
    }
    if bearing.elasticity != Elasticity::Rigid {
        return Some("it has a rigid shell alone");
    }
    if !bearing.is_plain() {
        return Some("its bore and journal are cylinders");
    }
    if bearing.ambient_pressure != bearing.cavitation_pressure {
        return Some("it needs equal ambient and cavitation pressure");
    }
    if bearing.inlet != Inlet::Cyclic {
        return Some("it has no inlet on the line of the widest gap");
    }
    None
}

/// Whether the journal cannot tilt in this duty.
pub(crate) fn stays_aligned(duty: &Duty) -> bool {
    match duty {
        Duty::State(state) => state.tilt == [0.0; 2] && state.tilt_rate == [0.0; 2],
        Duty::Load(load) => load.tilt == TiltCondition::Fixed([0.0; 2]),
        Duty::Cycle(duty) => duty.cycle.tilt == CycleTilt::Aligned,
    }
}
