//! Which film model can do what a study asks, and what it leaves out.
//!
//! Only the film on a grid takes every bearing. The others are made for a plain one: what they cannot
//! answer is refused by name ([`refusal`]); what they have of their own, or are known to leave out, is put
//! into the bearing that they are given, and told ([`adapted`]).

use crate::input::{BearingCase, Duty, FilmModel, FilmSettings, TiltCondition};
use sommerfeld_bearing::CycleTilt;
use sommerfeld_film::{Bearing, Cavitation, Elasticity, FilmShear, Finish, Inlet};
use sommerfeld_oil::{CompressionLaw, Lubricant, PressureLaw, ShearThinning};

/// Why a model cannot do what a case asks; `None` where it can.
pub(crate) fn refusal(
    model: FilmModel,
    case: &BearingCase,
    _settings: &FilmSettings,
) -> Option<String> {
    if model.is_field() {
        return None;
    }
    if !stays_aligned(&case.duty) {
        return Some("it has no tilt".to_owned());
    }
    if !model.overlooks_feeds() && !case.bearing.feeds.is_empty() {
        return Some(
            "it has no grooves and holes; film.feeds = \"left-out\" leaves them out of every model"
                .to_owned(),
        );
    }
    not_plain(&case.bearing).map(str::to_owned)
}

/// The oil as it is at ambient pressure and low shear, at every temperature.
pub(crate) fn at_ambient(oil: &Lubricant) -> Lubricant {
    Lubricant {
        viscosity_pressure: PressureLaw::None,
        shear_thinning: ShearThinning::None,
        density_pressure: CompressionLaw::None,
        ..oil.clone()
    }
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

/// The case as a model takes it, and in which ways that is another than given.
pub(crate) fn adapted(
    model: FilmModel,
    mut case: BearingCase,
    _settings: &FilmSettings,
) -> (BearingCase, Vec<String>) {
    let mut notes = Vec::new();
    if model.is_field() {
        return (case, notes);
    }
    let bearing = &mut case.bearing;
    if bearing.cavitation != Cavitation::Gumbel {
        notes.push("half film, negative pressures cut".to_owned());
        bearing.cavitation = Cavitation::Gumbel;
    }
    if bearing.film_shear != FilmShear::FullWidth {
        notes.push("shear over the full width".to_owned());
        bearing.film_shear = FilmShear::FullWidth;
    }
    if !bearing.feeds.is_empty() {
        notes.push("without grooves and holes".to_owned());
    }
    let oil = &case.lubricant;
    let is_newtonian = matches!(oil.shear_thinning, ShearThinning::None)
        && matches!(oil.viscosity_pressure, PressureLaw::None)
        && matches!(oil.density_pressure, CompressionLaw::None);
    if !is_newtonian {
        notes.push("oil at ambient pressure and low shear".to_owned());
    }
    (case, notes)
}

/// Whether the journal cannot tilt in this duty.
pub(crate) fn stays_aligned(duty: &Duty) -> bool {
    match duty {
        Duty::State(state) => state.tilt == [0.0; 2] && state.tilt_rate == [0.0; 2],
        Duty::Load(load) => load.tilt == TiltCondition::Fixed([0.0; 2]),
        Duty::Cycle(duty) => duty.cycle.tilt == CycleTilt::Aligned,
    }
}
