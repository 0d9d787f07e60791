//! The oil: a law of each kind, or one of the library with laws of its own in place of some.

use super::{Checker, LawKeys};
use crate::input::error::InputError;
use crate::input::heat::HeatPlan;
use crate::input::schema::{find, nearest_of};
use crate::input::study::FilmModel;
use crate::input::values::Value;
use sommerfeld_oil::library::{LibraryError, library, named};
use sommerfeld_oil::{
    CROSS_EXPONENT, CompressionLaw, ConductivityLaw, DensityLaw, GradeError, HTHS_TEMPERATURE,
    HeatCapacityLaw, Lubricant, NamedOil, OilError, PressureLaw, RoelandsTemperature, SaeGrade,
    ShearThinning, TemperatureRange, ThinningForm, ViscosityLaw,
};

const OIL: &str = "oil.oil";
const VISCOSITY: &str = "oil.viscosity";
const DENSITY: &str = "oil.density";
const PRESSURE: &str = "oil.viscosity_pressure";
const THINNING: &str = "oil.shear_thinning";
const GRADE: &str = "oil.grade";
/// Temperature of the kinematic viscosity of a grade, 100 degC, K.
const GRADE_TEMPERATURE: f64 = 373.15;

/// Temperatures in words.
pub(super) fn celsius(range: TemperatureRange) -> String {
    let shown = |kelvin: f64| (10.0 * (kelvin - 273.15)).round() / 10.0 + 0.0;
    if range.high.is_finite() {
        format!("{} degC to {} degC", shown(range.low), shown(range.high))
    } else {
        format!("at least {} degC", shown(range.low))
    }
}

impl Checker<'_> {
    /// The oil, with its laws checked at the temperatures that the study names.
    pub(super) fn lubricant(
        &mut self,
        temperature: f64,
        heat: &Option<HeatPlan>,
    ) -> Option<Lubricant> {
        self.entry("oil").filter(|e| e.value == Value::Table)?;
        // A film that finds its temperature begins at that of its supply.
        let path = heat.as_ref().and_then(HeatPlan::path);
        let temperature = path.map_or(temperature, |path| path.supply_temperature);
        let base = self.named_oil()?;
        let density = self.density();
        let viscosity = match &base {
            Some(_) => None,
            None => Some(self.viscosity()?),
        };
        let (density, density_pressure) = density?;
        let mut oil = match (base.as_ref(), viscosity) {
            (Some(base), _) => base.lubricant.clone(),
            (None, Some(viscosity)) => Lubricant::newtonian(viscosity, density),
            (None, None) => return None,
        };
        if base.is_none() || self.reading.was_given(DENSITY) {
            (oil.density, oil.density_pressure) = (density, density_pressure);
        }
        let errors = self.errors.len();
        self.viscosity_pressure(&mut oil);
        self.heat_capacity(&mut oil);
        self.conductivity(&mut oil);
        if let Err(error) = oil.check() {
            let path = if base.is_some() { OIL } else { VISCOSITY };
            let error = self.error_at(path, format!("the oil is none: {error}"));
            self.errors.push(error);
        }
        if self.errors.len() > errors {
            return None;
        }
        self.check_viscosity(&oil, temperature)?;
        self.shear_thinning(&mut oil)?;
        self.check_temperature(&oil, base.as_ref(), temperature, path.is_some())?;
        self.check_grade(&oil)?;
        self.note_of_closed_form(&oil);
        Some(oil)
    }

    /// The oil of the library that the study names; the inner `None` where it names none.
    fn named_oil(&mut self) -> Option<Option<NamedOil>> {
        let was_given = self.reading.was_given(OIL);
        if was_given && self.reading.was_given(VISCOSITY) {
            let error = self
                .error_at(VISCOSITY, "the viscosity is given twice")
                .allowing("oil or viscosity")
                .hinting("the oil of the library has a viscosity of its own");
            self.errors.push(error);
            return None;
        }
        if !was_given {
            return Some(None);
        }
        let name = self.text(OIL)?;
        match named(&name) {
            Ok(oil) => Some(Some(oil)),
            Err(error) => {
                let error = self.library_error(&name, &error);
                self.errors.push(error);
                None
            }
        }
    }

    fn library_error(&self, name: &str, error: &LibraryError) -> InputError {
        let LibraryError::Unknown { known, .. } = error else {
            return self.error_at(OIL, format!("the library of oils cannot be read: {error}"));
        };
        let shown: String = name.chars().take(40).collect();
        let message = format!("no oil is called \"{}\"", shown.escape_debug());
        let refused = self.error_at(OIL, message).allowing(known.clone());
        let oils = library().unwrap_or_default();
        let names: Vec<&str> = oils.iter().map(|oil| oil.name.as_str()).collect();
        let near = nearest_of(&names, name);
        if near.is_empty() {
            return refused.hinting("or give its viscosity: for example viscosity = \"8 mPa.s\"");
        }
        let near: Vec<String> = near.iter().map(|name| format!("\"{name}\"")).collect();
        refused.hinting(format!("did you mean {}?", near.join(" or ")))
    }

    fn viscosity(&mut self) -> Option<ViscosityLaw> {
        if !self.reading.was_given(VISCOSITY) {
            let key = find(VISCOSITY)?;
            if !self.was_misspelt(key) {
                let header = self.entry("oil").map(|entry| &entry.key_span);
                let error = super::missing(&self.reading, key, header);
                self.errors
                    .push(error.allowing("viscosity, or oil: the name of one of the library"));
            }
            return None;
        }
        match self.value(VISCOSITY)? {
            Value::Number(viscosity) => Some(ViscosityLaw::Constant { viscosity }),
            Value::Table => self.viscosity_law(),
            _ => None,
        }
    }

    fn viscosity_law(&mut self) -> Option<ViscosityLaw> {
        let law = self.text("oil.viscosity.law")?;
        let (needed, foreign): (&[&str], &[&str]) = match law.as_str() {
            "vogel" => (&["a", "b", "c"], &["kv40", "kv100"]),
            _ => (&["kv40", "kv100"], &["a", "b", "c"]),
        };
        if !self.law_keys(VISCOSITY, &law, LawKeys { needed, foreign }) {
            return None;
        }
        let number = |name: &str| self.number(&format!("{VISCOSITY}.{name}"));
        Some(match law.as_str() {
            "vogel" => ViscosityLaw::Vogel {
                a: number("a")?,
                b: number("b")?,
                c: number("c")?,
            },
            _ => ViscosityLaw::AstmD341 {
                kv40: number("kv40")?,
                kv100: number("kv100")?,
            },
        })
    }

    /// Density over temperature and over pressure.
    fn density(&mut self) -> Option<(DensityLaw, CompressionLaw)> {
        let number = |name: &str| self.number(&format!("{DENSITY}.{name}"));
        let density = match self.value(DENSITY)? {
            Value::Number(density) => {
                return Some((DensityLaw::Constant { density }, CompressionLaw::None));
            }
            _ => number("value")?,
        };
        let (reference, expansion) = (number("temperature"), number("expansion"));
        let bulk_modulus = number("bulk_modulus");
        let law = match (reference, expansion) {
            (Some(temperature), Some(expansion)) => DensityLaw::ThermalExpansion {
                density,
                temperature,
                expansion,
            },
            (None, None) => DensityLaw::Constant { density },
            (Some(_), None) => {
                return self.lacks("oil.density.temperature", "temperature", "expansion");
            }
            (None, Some(_)) => {
                return self.lacks("oil.density.expansion", "expansion", "temperature");
            }
        };
        let path = "oil.density.pressure";
        let compression = match (self.text(path)?.as_str(), bulk_modulus) {
            ("bulk-modulus", Some(bulk_modulus)) => CompressionLaw::BulkModulus { bulk_modulus },
            ("bulk-modulus", None) => {
                let error = self.error_at(path, "the law bulk-modulus needs `bulk_modulus`");
                self.errors
                    .push(error.hinting("for example bulk_modulus = \"1.6 GPa\""));
                return None;
            }
            (law, Some(_)) => {
                let message = format!("the law {law} has no `bulk_modulus`");
                let error = self.error_at("oil.density.bulk_modulus", message);
                self.errors
                    .push(error.hinting("take it out, or give pressure = \"bulk-modulus\""));
                return None;
            }
            ("dowson-higginson", None) => CompressionLaw::DowsonHigginson,
            ("limit-1.34", None) => CompressionLaw::Limit134,
            _ => CompressionLaw::None,
        };
        Some((law, compression))
    }

    /// Refuses a key of the density that stands without the other one.
    fn lacks<T>(&mut self, path: &str, given: &str, other: &str) -> Option<T> {
        let error = self.error_at(path, format!("`{given}` of the density needs `{other}`"));
        self.errors.push(error.allowing("both, or neither"));
        None
    }

    fn viscosity_pressure(&mut self, oil: &mut Lubricant) -> Option<()> {
        self.entry(PRESSURE)?;
        let law = self.text(&format!("{PRESSURE}.law"))?;
        let (needed, foreign): (&[&str], &[&str]) = match law.as_str() {
            "barus" => (&["alpha"], &["temperature"]),
            "roelands" => (&["alpha"], &[]),
            _ => (&[], &["alpha", "temperature"]),
        };
        if !self.law_keys(PRESSURE, &law, LawKeys { needed, foreign }) {
            return None;
        }
        let number = |name: &str| self.number(&format!("{PRESSURE}.{name}"));
        oil.viscosity_pressure = match law.as_str() {
            "barus" => PressureLaw::Barus {
                alpha: number("alpha")?,
            },
            "roelands" => PressureLaw::Roelands {
                alpha: number("alpha")?,
                temperature: match number("temperature") {
                    Some(temperature) => RoelandsTemperature::AlphaAt { temperature },
                    None => RoelandsTemperature::SameAlpha,
                },
            },
            _ => PressureLaw::None,
        };
        Some(())
    }

    /// How the oil thins with shear; its viscosity and density are known. `None` where an error says
    /// why not.
    fn shear_thinning(&mut self, oil: &mut Lubricant) -> Option<()> {
        const HTHS: &str = "hths";
        const RATE: &str = "critical_shear_rate";
        if self.entry(THINNING).is_none() {
            return Some(());
        }
        let path = |name: &str| format!("{THINNING}.{name}");
        let law = self.text(&path("law"))?;
        let given = |name: &str| self.reading.was_given(&path(name));
        let (hths_given, rate_given) = (given(HTHS), given(RATE));
        let (needed, foreign): (&[&str], &[&str]) = match law.as_str() {
            "none" => (&[], &[HTHS, RATE, "second_newtonian_ratio", "exponent"]),
            "carreau" => (&["exponent"], &[]),
            _ => (&[], &[]),
        };
        if !self.law_keys(THINNING, &law, LawKeys { needed, foreign }) {
            return None;
        }
        if law == "none" {
            oil.shear_thinning = ShearThinning::None;
            return Some(());
        }
        if hths_given == rate_given {
            let (place, message) = if hths_given {
                (RATE, "the critical shear rate is given twice")
            } else {
                ("law", "the critical shear rate is missing")
            };
            let error = self.error_at(&path(place), message);
            self.errors.push(
                error
                    .allowing("hths or critical_shear_rate")
                    .hinting("for example hths = \"2.9 mPa.s\""),
            );
            return None;
        }
        let ratio = self.number(&path("second_newtonian_ratio"))?;
        let exponent = self.number(&path("exponent")).unwrap_or(CROSS_EXPONENT);
        let is_cross = law == "cross";
        let found = match self.number(&path(HTHS)) {
            Some(hths) => {
                let form = if is_cross {
                    ThinningForm::Cross { exponent }
                } else {
                    ThinningForm::Carreau { exponent }
                };
                let range = oil.temperature_range();
                if !range.contains(HTHS_TEMPERATURE) {
                    let message = "the laws of this oil do not reach 150 degC, where hths is taken";
                    let error = self.error_at(&path(HTHS), message);
                    self.errors.push(
                        error.allowing(format!("a range with 150 degC, not {}", celsius(range))),
                    );
                    return None;
                }
                oil.clone().with_hths(hths, form, ratio)
            }
            None => {
                let critical_shear_rate = self.number(&path(RATE))?;
                oil.shear_thinning = thinning(is_cross, ratio, critical_shear_rate, exponent);
                oil.check().map(|()| oil.clone())
            }
        };
        match found {
            Ok(found) => {
                *oil = found;
                Some(())
            }
            Err(error) => {
                let place = match &error {
                    OilError::OutOfRange { name, .. } => path(name),
                    _ if hths_given => path(HTHS),
                    _ => path(RATE),
                };
                let error = self.error_at(&place, error.to_string());
                self.errors.push(error);
                None
            }
        }
    }

    fn heat_capacity(&mut self, oil: &mut Lubricant) -> Option<()> {
        const PATH: &str = "oil.heat_capacity";
        oil.heat_capacity = match self.value(PATH)? {
            Value::Number(heat_capacity) => HeatCapacityLaw::Constant { heat_capacity },
            _ => HeatCapacityLaw::Linear {
                heat_capacity: self.number(&format!("{PATH}.value"))?,
                temperature: self.number(&format!("{PATH}.temperature"))?,
                slope: self.number(&format!("{PATH}.slope"))?,
            },
        };
        Some(())
    }

    fn conductivity(&mut self, oil: &mut Lubricant) -> Option<()> {
        const PATH: &str = "oil.conductivity";
        oil.conductivity = match self.value(PATH)? {
            Value::Number(conductivity) => ConductivityLaw::Constant { conductivity },
            _ => ConductivityLaw::Linear {
                conductivity: self.number(&format!("{PATH}.value"))?,
                temperature: self.number(&format!("{PATH}.temperature"))?,
                slope: self.number(&format!("{PATH}.slope"))?,
            },
        };
        Some(())
    }

    /// A viscosity that no oil has at the film temperature is a slip of the unit.
    fn check_viscosity(&mut self, oil: &Lubricant, temperature: f64) -> Option<()> {
        let viscosity = oil.viscosity(temperature, 0.0).value;
        let is_below_pole =
            matches!(oil.viscosity, ViscosityLaw::Vogel { c, .. } if temperature + c <= 0.0);
        if !is_below_pole && (1e-6..=1e3).contains(&viscosity) {
            return Some(());
        }
        let message = format!(
            "the viscosity is {viscosity:.3e} Pa.s at the film temperature of {:.1} degC",
            temperature - 273.15
        );
        let path = if self.reading.was_given(OIL) {
            OIL
        } else {
            VISCOSITY
        };
        let error = self
            .error_at(path, message)
            .allowing("at least 0.001 mPa.s, at most 1000 Pa.s");
        self.errors.push(match oil.viscosity {
            ViscosityLaw::Vogel { .. } => {
                error.hinting("for vogel, b and c are in K and T in K: c = (c for degC) - 273.15")
            }
            _ => error.hinting("is the unit right? 1 mPa.s is the viscosity of water"),
        });
        None
    }

    /// The temperature that the study names lies where the laws of the oil hold.
    fn check_temperature(
        &mut self,
        oil: &Lubricant,
        base: Option<&NamedOil>,
        temperature: f64,
        is_supply: bool,
    ) -> Option<()> {
        let (key, what, range) = if is_supply {
            let heat = oil.heat_temperature_range();
            let range = oil.temperature_range().and(heat);
            ("heat.supply_temperature", "supply", range)
        } else {
            ("oil.temperature", "film", oil.temperature_range())
        };
        let place = |checker: &Self, message: String| match checker.entry(key) {
            Some(_) => checker.error_at(key, message),
            None => checker.section_error("oil", message).of_key(key),
        };
        let degrees = temperature - 273.15;
        if !range.contains(temperature) {
            let message = format!(
                "the {what} temperature of {degrees:.1} degC is outside the range of the oil's laws"
            );
            let error = place(self, message).allowing(celsius(range));
            self.errors.push(error);
            return None;
        }
        if let Some(base) = base.filter(|base| !base.temperatures.contains(temperature)) {
            let message = format!(
                "the {what} temperature of {degrees:.1} degC is outside the data of the oil {}",
                base.name
            );
            let note = place(self, message).allowing(celsius(base.temperatures));
            self.warnings.push(note);
        }
        Some(())
    }

    /// The oil has the viscosities of the grade that the study names.
    fn check_grade(&mut self, oil: &Lubricant) -> Option<()> {
        if !self.reading.was_given(GRADE) {
            return Some(());
        }
        let given = self.text(GRADE)?;
        let refused = match given.parse::<SaeGrade>() {
            Err(_) => {
                let shown: String = given.chars().take(40).collect();
                let message = format!("\"{}\" is no grade of SAE J300", shown.escape_debug());
                let grades = "0W, 5W, 10W, 15W, 20W, 25W; 8, 12, 16, 20, 30, 40, 50, 60; or both, \
                              as 5W-30";
                Some(self.error_at(GRADE, message).allowing(grades))
            }
            Ok(grade) => self.grade_error(oil, grade),
        };
        match refused {
            None => Some(()),
            Some(error) => {
                self.errors.push(error);
                None
            }
        }
    }

    fn grade_error(&self, oil: &Lubricant, grade: SaeGrade) -> Option<InputError> {
        if matches!(oil.viscosity, ViscosityLaw::Constant { .. }) {
            let message = "a viscosity that is the same at every temperature has no grade";
            let error = self.error_at(GRADE, message);
            return Some(error.hinting("give viscosity = { law = \"astm-d341\", kv40, kv100 }"));
        }
        let range = oil.temperature_range();
        if !range.contains(GRADE_TEMPERATURE) || !range.contains(HTHS_TEMPERATURE) {
            let message =
                "the laws of this oil do not reach 100 and 150 degC, where a grade is taken";
            let error = self.error_at(GRADE, message);
            return Some(error.allowing(celsius(range)));
        }
        let error = grade.check_lubricant(oil).err()?;
        let message = match &error {
            GradeError::Below {
                what, value, unit, ..
            }
            | GradeError::Above {
                what, value, unit, ..
            } => {
                let value = (1e4 * value).round() / 1e4;
                format!("the oil is no SAE {grade}: {what} is {value} {unit}")
            }
            GradeError::Unknown { .. } => error.to_string(),
        };
        let window = grade.window();
        let kv = window.kv100_high.map_or(String::new(), |high| {
            format!(", below {:.1} mm2/s", 1e6 * high)
        });
        let hths = window.hths_low.map_or(String::new(), |low| {
            format!("; HTHS at least {:.1} mPa.s", 1e3 * low)
        });
        let allowed = format!(
            "kinematic viscosity at 100 degC at least {:.1} mm2/s{kv}{hths}",
            1e6 * window.kv100_low
        );
        let refused = self.error_at(GRADE, message).allowing(allowed);
        let is_thinned = !matches!(oil.shear_thinning, ShearThinning::None);
        Some(match error {
            GradeError::Below { what, .. } if what.contains("HTHS") && is_thinned => {
                refused.hinting("shear_thinning sets the viscosity at high shear")
            }
            _ => refused,
        })
    }

    /// Says that a film in closed form takes the oil as it is at ambient pressure and low shear.
    fn note_of_closed_form(&mut self, oil: &Lubricant) {
        let Some(model) = self
            .film_model()
            .filter(|model| !FilmModel::is_field(*model))
        else {
            return;
        };
        let is_newtonian = matches!(oil.shear_thinning, ShearThinning::None)
            && matches!(oil.viscosity_pressure, PressureLaw::None)
            && matches!(oil.density_pressure, CompressionLaw::None);
        if is_newtonian {
            return;
        }
        let message = format!(
            "the model {} takes the oil at ambient pressure and low shear",
            model.name()
        );
        let path = [PRESSURE, THINNING, OIL, DENSITY]
            .into_iter()
            .find(|path| self.entry(path).is_some());
        let note = self.section_error(path.unwrap_or("oil"), message);
        self.warnings.push(note.hinting("use model = \"field\""));
    }
}

/// An oil that thins about the same critical shear rate at every temperature.
fn thinning(is_cross: bool, ratio: f64, rate: f64, exponent: f64) -> ShearThinning {
    if is_cross {
        ShearThinning::Cross {
            second_newtonian_ratio: ratio,
            critical_shear_rate: rate,
            exponent,
            reference: None,
        }
    } else {
        ShearThinning::Carreau {
            second_newtonian_ratio: ratio,
            critical_shear_rate: rate,
            exponent,
            reference: None,
        }
    }
}
