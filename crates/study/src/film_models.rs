//! Which film model can do what a study asks, and what it leaves out.
//!
//! Only the film on a grid takes every bearing. The others are made for a plain one: what they cannot
//! answer is refused by name ([`refusal`]); what they have of their own, or are known to leave out, is put
//! into the bearing that they are given, and told ([`adapted`]).

use crate::film_tables::{DatabaseFacts, Scheme, closure_name, holding};
use crate::input::{BearingCase, Duty, FilmModel, FilmSettings, Study, Subject, TiltCondition};
use sommerfeld_bearing::CycleTilt;
use sommerfeld_film::{
    Bearing, Cavitation, Elasticity, FilmError, FilmForce, FilmShear, FilmSolver, Finish, Inlet,
    LongBearingFilm, MobilityFilm, OnlineFilm, ShortBearingFilm,
};
use sommerfeld_oil::{CompressionLaw, Lubricant, PressureLaw, ShearThinning};

/// The film of a case in the model of the settings.
pub(crate) fn film_of(
    case: &BearingCase,
    settings: &FilmSettings,
) -> Result<Box<dyn FilmForce + Send>, FilmError> {
    let (bearing, oil) = (&case.bearing, &case.lubricant);
    let viscosity = oil.viscosity(case.temperature, 0.0).value;
    Ok(match settings.model {
        FilmModel::Field if stays_aligned(&case.duty) => {
            Box::new(FilmSolver::aligned(bearing, oil, settings.grid)?)
        }
        FilmModel::Field => Box::new(FilmSolver::new(bearing, oil, settings.grid)?),
        FilmModel::ShortBearing => Box::new(ShortBearingFilm::new(bearing, viscosity)?),
        FilmModel::Mobility => Box::new(MobilityFilm::new(bearing, viscosity)?),
        FilmModel::LongBearing => Box::new(LongBearingFilm::new(bearing, viscosity)?),
        FilmModel::Online => Box::new(OnlineFilm::aligned(bearing, &at_ambient(oil))?),
        FilmModel::Database | FilmModel::Superposition => {
            // The reasons were told when the study was checked.
            let unfit = FilmError::Unsupported {
                reason: "the databases of the study do not hold the film of this bearing",
            };
            let database = holding(&settings.databases, scheme(settings.model), bearing);
            database
                .map_err(|_| unfit)?
                .film(bearing, viscosity)
                .map_err(|_| unfit)?
        }
    })
}

/// The databases that the films of a study are looked up in, each once.
pub(crate) fn databases_of(study: &Study) -> Vec<DatabaseFacts> {
    let model = study.film.model;
    if !model.is_looked_up() {
        return Vec::new();
    }
    let bearings: Vec<&Bearing> = match &study.subject {
        Subject::Bearing(case) => vec![&case.bearing],
        Subject::Machine(plan) => plan.bearings.iter().map(|on| &on.bearing).collect(),
        Subject::Dimensionless(_) | Subject::Sweep(_) | Subject::Database(_) => Vec::new(),
    };
    let mut found: Vec<DatabaseFacts> = Vec::new();
    for bearing in bearings {
        let database = holding(&study.film.databases, scheme(model), bearing);
        let facts = database.map(|database| database.facts());
        found.extend(facts.ok().filter(|facts| !found.contains(facts)));
    }
    found
}

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
    if !stays_aligned(&case.duty) {
        return Some("it has no tilt".to_owned());
    }
    refusal_of_bearing(model, &case.bearing, settings)
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

/// The oil as it is at ambient pressure and low shear, at every temperature.
fn at_ambient(oil: &Lubricant) -> Lubricant {
    Lubricant {
        viscosity_pressure: PressureLaw::None,
        shear_thinning: ShearThinning::None,
        density_pressure: CompressionLaw::None,
        ..oil.clone()
    }
}

/// The case as a model takes it, and in which ways that is another than given.
pub(crate) fn adapted(
    model: FilmModel,
    mut case: BearingCase,
    settings: &FilmSettings,
) -> (BearingCase, Vec<String>) {
    let mut notes = Vec::new();
    if model.is_field() {
        return (case, notes);
    }
    if model.is_looked_up() {
        let database = holding(&settings.databases, scheme(model), &case.bearing);
        notes.extend(database.map(|database| database.facts().told()));
    }
    let bearing = &mut case.bearing;
    if !model.is_looked_up() && bearing.cavitation != Cavitation::Gumbel {
        notes.push(format!(
            "closure gumbel in place of {}",
            closure_name(bearing.cavitation)
        ));
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
fn stays_aligned(duty: &Duty) -> bool {
    match duty {
        Duty::State(state) => state.tilt == [0.0; 2] && state.tilt_rate == [0.0; 2],
        Duty::Load(load) => load.tilt == TiltCondition::Fixed([0.0; 2]),
        Duty::Cycle(duty) => duty.cycle.tilt == CycleTilt::Aligned,
    }
}
