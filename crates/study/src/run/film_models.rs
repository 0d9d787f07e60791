//! The film of a case in the model of its study, and what a model takes a bearing to be.

use crate::film_tables::{DatabaseFacts, closure_name, holding};
use crate::input::film_models::{scheme, stays_aligned};
use crate::input::{BearingCase, FilmModel, FilmSettings, Study, Subject};
use sommerfeld_film::{
    Bearing, Cavitation, FilmError, FilmForce, FilmShear, FilmSolver, LongBearingFilm,
    MobilityFilm, OnlineFilm, ShortBearingFilm,
};
use sommerfeld_oil::{CompressionLaw, Lubricant, PressureLaw, ShearThinning};

/// The film of a case in the model of the settings.
pub(super) fn film_of(
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
        FilmModel::Online if stays_aligned(&case.duty) => {
            Box::new(OnlineFilm::aligned(bearing, &at_ambient(oil))?)
        }
        FilmModel::Online => Box::new(OnlineFilm::new(bearing, &at_ambient(oil))?),
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
pub(super) fn databases_of(study: &Study) -> Vec<DatabaseFacts> {
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
pub(super) fn adapted(
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
    let nearest = match (model, bearing.cavitation) {
        (FilmModel::Database | FilmModel::Superposition, own) => own,
        (FilmModel::Online, Cavitation::Reynolds | Cavitation::MassConserving) => {
            Cavitation::Reynolds
        }
        _ => Cavitation::Gumbel,
    };
    if nearest != bearing.cavitation {
        notes.push(format!(
            "closure {} in place of {}",
            closure_name(nearest),
            closure_name(bearing.cavitation)
        ));
        bearing.cavitation = nearest;
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
