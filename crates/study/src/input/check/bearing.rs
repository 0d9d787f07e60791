//! Bearing and oil.

use super::Checker;
use crate::film_tables::closure_name;
use crate::input::study::FilmModel;
use crate::input::values::Value;
use sommerfeld_film::{Bearing, Cavitation, Elasticity, Ends, FilmShear, Finish, Inlet, Shape};
use std::ops::Range;

/// Relative clearances outside this range are more often a slip of the unit than a bearing.
const USUAL_CLEARANCE: Range<f64> = 1e-4..1e-2;

/// The closures and boundaries of the film, as `[film]` gives them.
pub(super) struct FilmRules {
    pub(super) cavitation: Cavitation,
    pub(super) inlet: Inlet,
    pub(super) ends: Ends,
    pub(super) film_shear: FilmShear,
}

impl Checker<'_> {
    /// The bearing with its supply and film rules.
    pub(super) fn bearing(&mut self) -> Option<Bearing> {
        let diameter = self.number("bearing.diameter");
        let width = self.number("bearing.width");
        let clearance = self.radial_clearance(diameter);
        let rules = self.film_rules();
        let ambient_pressure = self.number("film.ambient_pressure");
        let cavitation_pressure = self.number("film.cavitation_pressure");
        let mut bearing = Bearing {
            diameter: diameter?,
            width: width?,
            radial_clearance: clearance?,
            bore: Shape::cylindrical(),
            journal: Shape::cylindrical(),
            feeds: Vec::new(),
            ambient_pressure: ambient_pressure?,
            cavitation_pressure: cavitation_pressure?,
            ends: rules.as_ref()?.ends,
            inlet: rules.as_ref()?.inlet,
            cavitation: rules.as_ref()?.cavitation,
            film_shear: rules.as_ref()?.film_shear,
            finish: Finish::Smooth,
            elasticity: Elasticity::Rigid,
        };
        self.check_pressures(&bearing);
        self.check_inlet(&bearing);
        bearing.feeds = self.feeds(&bearing);
        let (finish, elasticity) = (self.finish(), self.elasticity());
        (bearing.bore, bearing.journal) = self.shapes(&bearing)?;
        (bearing.finish, bearing.elasticity) = (finish?, elasticity?);
        self.check_shapes(&bearing)?;
        self.check_film_model(&bearing);
        Some(bearing)
    }

    /// Radial clearance from whichever of the two keys is given, m.
    fn radial_clearance(&mut self, diameter: Option<f64>) -> Option<f64> {
        const DIAMETRAL: &str = "bearing.diametral_clearance";
        const RELATIVE: &str = "bearing.relative_clearance";
        let section = self.entry("bearing");
        let section = section
            .filter(|entry| entry.value == Value::Table)
            .map(|entry| entry.key_span.clone())?;
        let given = |path| self.reading.was_given(path);
        let error = match (given(DIAMETRAL), given(RELATIVE)) {
            (true, true) => self
                .error_at(RELATIVE, "the clearance is given twice")
                .allowing("diametral_clearance or relative_clearance"),
            (false, false) => self
                .reading
                .error(&section, "the clearance of the bearing is missing")
                .with_value("")
                .of_key(DIAMETRAL)
                .allowing("diametral_clearance or relative_clearance")
                .hinting("diametral_clearance is bore diameter minus journal diameter"),
            _ => return self.one_clearance(diameter?),
        };
        self.errors.push(error);
        None
    }

    fn one_clearance(&mut self, diameter: f64) -> Option<f64> {
        let (path, relative) = match self.number("bearing.diametral_clearance") {
            Some(clearance) => ("bearing.diametral_clearance", clearance / diameter),
            None => (
                "bearing.relative_clearance",
                self.number("bearing.relative_clearance")?,
            ),
        };
        if relative >= 1.0 {
            let error = self.error_at(path, format!("`{path}` is not below the diameter"));
            self.errors.push(error);
            return None;
        }
        if !USUAL_CLEARANCE.contains(&relative) {
            let message = format!("the relative clearance is {relative:.2e}, which is unusual");
            let note = self.error_at(path, message).hinting(
                "usual are 0.7e-3 to 2e-3, that is 0.7 to 2 um per mm of diameter; is the unit right?",
            );
            self.warnings.push(note);
        }
        Some(0.5 * relative * diameter)
    }

    /// Ends and feeds at or above the cavitation pressure.
    fn check_pressures(&mut self, bearing: &Bearing) {
        const AMBIENT: &str = "film.ambient_pressure";
        const CAVITATION: &str = "film.cavitation_pressure";
        let path = if self.entry(AMBIENT).is_some() {
            AMBIENT
        } else {
            CAVITATION
        };
        if bearing.ambient_pressure < bearing.cavitation_pressure {
            let error = self
                .error_at(
                    path,
                    "the ambient pressure is below the cavitation pressure",
                )
                .hinting(
                    "a film in surroundings below its cavitation pressure cannot be full anywhere",
                );
            self.errors.push(error);
        }
        if let Inlet::MaxFilmLine { pressure } = bearing.inlet
            && pressure < bearing.cavitation_pressure
        {
            let error = self.error_at(
                "film.inlet_pressure",
                "the inlet pressure is below the cavitation pressure",
            );
            self.errors.push(error);
        }
    }

    /// The inlet on the line of the widest gap needs a grid that follows that line: it holds no
    /// feeds, and a film on it has no history.
    fn check_inlet(&mut self, bearing: &Bearing) {
        const INLET: &str = "film.inlet";
        // A closed form has refused it already, and does not use its grooves.
        let is_field = self.film_model().is_some_and(FilmModel::is_field);
        if bearing.inlet == Inlet::Cyclic || !is_field {
            return;
        }
        if self.mode.is_cyclic() && bearing.cavitation == Cavitation::MassConserving {
            let error = self
                .error_at(
                    INLET,
                    "a film that conserves mass cannot start on the line of the widest gap in a \
                     load cycle: the line moves, and what the film holds would be lost",
                )
                .allowing("\"cyclic\"")
                .hinting("give a groove or hole, or cavitation = \"reynolds\"");
            self.errors.push(error);
        }
        if !self.reading.grooves.is_empty() {
            let error = self
                .error_at(
                    INLET,
                    "grooves and holes do not go with an inlet on the line of the widest gap",
                )
                .allowing("\"cyclic\"")
                .hinting("take the inlet out: the grooves feed the film; or take the grooves out");
            self.errors.push(error);
        }
    }

    /// Closures and boundaries from `[film]`. The closed forms have their own: what contradicts
    /// them is refused.
    pub(super) fn film_rules(&mut self) -> Option<FilmRules> {
        let model = self.film_model()?;
        if !model.is_field() {
            self.refuse_rules_of_field(model);
        }
        let cavitation = match self.text("film.cavitation")?.as_str() {
            _ if model.is_looked_up() => self.looked_up_closure(model)?,
            "reynolds" if model == FilmModel::Online => Cavitation::Reynolds,
            _ if !model.is_field() => Cavitation::Gumbel,
            "gumbel" => Cavitation::Gumbel,
            "reynolds" => Cavitation::Reynolds,
            _ => Cavitation::MassConserving,
        };
        let inlet = match self.text("film.inlet")?.as_str() {
            "max-film-line" => Inlet::MaxFilmLine {
                pressure: self.number("film.inlet_pressure")?,
            },
            _ => Inlet::Cyclic,
        };
        if inlet == Inlet::Cyclic && self.entry("film.inlet_pressure").is_some() {
            let error = self
                .error_at("film.inlet_pressure", "a cyclic inlet has no pressure")
                .hinting("give inlet = \"max-film-line\" or take inlet_pressure out");
            self.errors.push(error);
        }
        let ends = match self.text("film.ends")?.as_str() {
            "flooded" => Ends::Flooded,
            _ => Ends::Air,
        };
        let film_shear = match self.text("film.film_shear").as_deref() {
            Some("full-width") => FilmShear::FullWidth,
            Some(_) => FilmShear::FilmFraction,
            None if cavitation == Cavitation::MassConserving => FilmShear::FilmFraction,
            None => FilmShear::FullWidth,
        };
        if model.is_field()
            && film_shear == FilmShear::FilmFraction
            && cavitation != Cavitation::MassConserving
        {
            let error = self
                .error_at(
                    "film.film_shear",
                    "only cavitation = \"mass-conserving\" has a film fraction to weight the shear by",
                )
                .allowing("\"full-width\"")
                .hinting("take film_shear out, or use cavitation = \"mass-conserving\"");
            self.errors.push(error);
        }
        Some(FilmRules {
            cavitation,
            inlet,
            ends,
            film_shear,
        })
    }

    fn refuse_rules_of_field(&mut self, model: FilmModel) {
        let closure = match self.looked_up_closure(model) {
            Some(closure) if model.is_looked_up() => closure_name(closure),
            _ => "gumbel",
        };
        let rules = [
            ("film.cavitation", closure),
            ("film.inlet", "cyclic"),
            ("film.ends", "air"),
            ("film.film_shear", "full-width"),
        ];
        for (path, own) in rules {
            let given = self.entry(path).map(|entry| entry.value.clone());
            let is_solved_on_line =
                model == FilmModel::Online && given == Some(Value::Text("reynolds".to_owned()));
            if matches!(given, Some(Value::Text(word)) if word != own) && !is_solved_on_line {
                let held = match model.is_looked_up() {
                    true => format!(", its films have \"{own}\""),
                    false => String::new(),
                };
                let message = format!("the model {} cannot do this{held}", model.name());
                let error = self
                    .error_at(path, message)
                    .allowing(format!("\"{own}\""))
                    .hinting("use model = \"field\"");
                self.errors.push(error);
            }
        }
        for path in ["film.ambient_pressure", "film.cavitation_pressure"] {
            if self.entry(path).is_some()
                && self.number("film.ambient_pressure") != self.number("film.cavitation_pressure")
            {
                let message = format!(
                    "the model {} needs equal ambient and cavitation pressure",
                    model.name()
                );
                let error = self
                    .error_at(path, message)
                    .hinting("use model = \"field\"");
                self.errors.push(error);
                break;
            }
        }
        let grooves = self.reading.grooves.first().map(|(span, _)| span.clone());
        if let Some(span) = grooves {
            let message = format!("the model {} has no grooves and holes", model.name());
            let refused = self.reading.error(&span, message).of_key("bearing.groove");
            if model.overlooks_feeds() {
                let message = format!(
                    "the model {} has no grooves: they are not used",
                    model.name()
                );
                let note = self.reading.error(&span, message).of_key("bearing.groove");
                self.warnings.push(note.hinting("use model = \"field\""));
            } else {
                self.errors.push(refused.hinting(
                    "use model = \"field\", or film.feeds = \"left-out\" for the bearing without them",
                ));
            }
        }
    }
}
