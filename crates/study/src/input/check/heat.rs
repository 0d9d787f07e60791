//! Where the temperature of the film comes from.

use super::Checker;
use super::grooves::mm;
use crate::input::heat::{HeatPlan, Wall};
use crate::input::schema::Mode;
use crate::input::values::{Value, not_built};
use sommerfeld_bearing::{Expansion, HeatPath, PressedShell, ShellFit};
use sommerfeld_film::Bearing;

const HEAT: &str = "heat";
const EXPANSION: &str = "heat.expansion";
const RING: &str = "heat.expansion.shell";
/// Keys of the balance alone, of the field alone, of both.
const OF_BALANCE: &[&str] = &["conductance", "surroundings_temperature", "outlet_weight"];
const OF_FIELD: &[&str] = &["wall_coefficient", "wall_temperature", "carry_over"];
const OF_BOTH: &[&str] = &["supply_temperature", "expansion"];

impl Checker<'_> {
    /// Where the temperature of the film comes from; `bearing` is the one bearing of the study, if it
    /// has only one.
    pub(super) fn heat(&mut self, bearing: Option<&Bearing>) -> Option<HeatPlan> {
        if self.entry(HEAT).is_none() {
            return Some(HeatPlan::Given);
        }
        let model = self.text("heat.model")?;
        self.refuse_unused_heat_keys(&model)?;
        if model == "given" {
            return Some(HeatPlan::Given);
        }
        self.refuse_heat_not_built(&model)?;
        if model == "field" {
            self.refuse_of_closed_form(HEAT, "has one temperature of the film")?;
        }
        let path = self.heat_path()?;
        let expansion = match self.entry(EXPANSION).map(|entry| &entry.value) {
            None => None,
            Some(Value::Table) if model == "field" => {
                let place = self.section_error(EXPANSION, "");
                let error = not_built(place, "heat.expansion of a field of temperature");
                self.errors
                    .push(error.hinting("give the clearance of the warm bearing"));
                return None;
            }
            Some(Value::Table) if self.mode.is_machine() && self.entry(RING).is_some() => {
                let place = self.section_error(RING, "");
                let error = not_built(
                    place,
                    "heat.expansion.shell of a machine with several bearings",
                );
                self.errors.push(error.hinting(
                    "give each bearing the clearance of its assembled shell, and the expansions of journal and housing",
                ));
                return None;
            }
            Some(Value::Table) => Some(self.expansion(bearing)?),
            Some(_) => return None,
        };
        self.check_warm_clearance(bearing, &path, expansion.as_ref())?;
        Some(match model.as_str() {
            "field" => HeatPlan::Field {
                path,
                wall: self.wall(path.supply_temperature)?,
                carry_over: self.number("heat.carry_over")?,
            },
            _ => HeatPlan::Balance { path, expansion },
        })
    }

    /// Keys that the model does not read.
    fn refuse_unused_heat_keys(&mut self, model: &str) -> Option<()> {
        let foreign: Vec<&str> = match model {
            "balance" => OF_FIELD.to_vec(),
            "field" => OF_BALANCE.to_vec(),
            _ => [OF_BALANCE, OF_FIELD, OF_BOTH].concat(),
        };
        let mut errors = Vec::new();
        for name in foreign {
            let path = format!("{HEAT}.{name}");
            if self.entry(&path).is_some() {
                let message = format!("the heat model {model} has no `{name}`");
                let error = match name {
                    "expansion" => self.section_error(&path, message),
                    _ => self.error_at(&path, message),
                };
                errors.push(error.hinting(match (model, name) {
                    ("given", "expansion") => {
                        "with a given temperature give the clearance of the warm bearing"
                    }
                    ("given", _) => "take it out, or give model = \"balance\"",
                    _ => "take it out",
                }));
            }
        }
        let are_right = errors.is_empty();
        self.errors.extend(errors);
        are_right.then_some(())
    }

    /// Refuses by name what no run reads yet.
    fn refuse_heat_not_built(&mut self, model: &str) -> Option<()> {
        let is_built = match self.mode {
            Mode::Film => model == "balance",
            Mode::Equilibrium | Mode::Coefficients | Mode::LoadCycle => true,
            mode if mode.is_machine() => model == "balance",
            _ => false,
        };
        if is_built {
            return Some(());
        }
        let place = self.error_at("heat.model", "");
        let what = format!(
            "heat.model = \"{model}\" of the analysis {}",
            self.mode.name()
        );
        let error = not_built(place, &what);
        self.errors.push(if self.mode.is_machine() {
            error.allowing("given, balance").hinting(
                "the loads-<name>.csv of a bearing can be run as a load-cycle study with a field",
            )
        } else {
            error.allowing("given, balance")
        });
        None
    }

    fn heat_path(&mut self) -> Option<HeatPath> {
        const SUPPLY: &str = "heat.supply_temperature";
        const AROUND: &str = "heat.surroundings_temperature";
        let Some(supply_temperature) = self.number(SUPPLY) else {
            if !self.reading.was_given(SUPPLY) {
                let error = self
                    .section_error(HEAT, "a heat balance needs `supply_temperature`")
                    .with_value("")
                    .of_key(SUPPLY);
                self.errors
                    .push(error.hinting("for example supply_temperature = \"90 degC\""));
            }
            return None;
        };
        let conductance = self.number("heat.conductance")?;
        let surroundings = self.number(AROUND);
        if conductance > 0.0 && surroundings.is_none() {
            if !self.reading.was_given(AROUND) {
                let error = self.error_at(
                    "heat.conductance",
                    "heat that is conducted away needs `surroundings_temperature`",
                );
                self.errors.push(
                    error
                        .of_key(AROUND)
                        .hinting("for example surroundings_temperature = \"20 degC\""),
                );
            }
            return None;
        }
        Some(HeatPath {
            supply_temperature,
            conductance,
            // Without conduction nothing depends on it.
            surroundings_temperature: surroundings.unwrap_or(supply_temperature),
            outlet_weight: self.number("heat.outlet_weight")?,
        })
    }

    fn wall(&mut self, supply_temperature: f64) -> Option<Wall> {
        let coefficient = self.number("heat.wall_coefficient")?;
        let temperature = self.number("heat.wall_temperature");
        if coefficient > 0.0 && temperature.is_none() {
            let error = self.error_at(
                "heat.wall_coefficient",
                "heat that goes into the surfaces needs `wall_temperature`",
            );
            self.errors.push(
                error
                    .of_key("heat.wall_temperature")
                    .hinting("for example wall_temperature = \"90 degC\""),
            );
            return None;
        }
        Some(Wall {
            coefficient,
            temperature: temperature.unwrap_or(supply_temperature),
        })
    }

    fn expansion(&mut self, bearing: Option<&Bearing>) -> Option<Expansion> {
        let number = |name: &str| self.number(&format!("{EXPANSION}.{name}"));
        let (journal, housing) = (number("journal")?, number("housing")?);
        let (journal_excess, housing_excess) =
            (number("journal_excess")?, number("housing_excess")?);
        let reference_temperature = number("reference_temperature")?;
        let shell = match self.entry(RING).map(|entry| &entry.value) {
            None => ShellFit::None,
            Some(Value::Table) => ShellFit::Pressed(self.pressed_shell(bearing)?),
            Some(_) => return None,
        };
        Some(Expansion {
            reference_temperature,
            journal,
            housing,
            journal_excess,
            housing_excess,
            shell,
        })
    }

    /// Refuses bearings of a machine that have no clearance at the temperature of their supply.
    pub(super) fn check_warm_clearances<'b>(
        &mut self,
        heat: &HeatPlan,
        mut bearings: impl Iterator<Item = &'b Bearing>,
    ) -> Option<()> {
        let (Some(path), expansion) = (heat.path(), heat.expansion()) else {
            return Some(());
        };
        bearings.try_for_each(|bearing| self.check_warm_clearance(Some(bearing), path, expansion))
    }

    /// A bearing without clearance at the temperature of its supply does not run.
    fn check_warm_clearance(
        &mut self,
        bearing: Option<&Bearing>,
        path: &HeatPath,
        expansion: Option<&Expansion>,
    ) -> Option<()> {
        let (Some(bearing), Some(expansion)) = (bearing, expansion) else {
            return Some(());
        };
        let cold = bearing.radial_clearance;
        let warm = expansion.clearance(bearing.radius(), cold, path.supply_temperature);
        if warm > 0.0 {
            return Some(());
        }
        let message = format!(
            "the bearing has no clearance at the supply temperature: {:.1} um, from {:.1} um at the \
             reference temperature",
            2e6 * warm,
            2e6 * cold
        );
        let error = self.section_error(EXPANSION, message);
        self.errors
            .push(error.hinting("the clearance of [bearing] is that at the reference temperature"));
        None
    }

    fn pressed_shell(&mut self, bearing: Option<&Bearing>) -> Option<PressedShell> {
        let number = |name: &str| self.number(&format!("{RING}.{name}"));
        let shell = PressedShell {
            thickness: number("thickness")?,
            modulus: number("modulus")?,
            poisson: number("poisson")?,
            expansion: number("expansion")?,
            housing_radius: 0.5 * number("housing_diameter")?,
            housing_modulus: number("housing_modulus")?,
            housing_poisson: number("housing_poisson")?,
            // Drawings give the diametral one.
            interference: 0.5 * number("interference")?,
        };
        let joint = bearing.map_or(0.0, Bearing::radius) + shell.thickness;
        if shell.housing_radius <= joint {
            let message = "the housing has no wall around the shell";
            let error = self.error_at(&format!("{RING}.housing_diameter"), message);
            let least = format!("more than {} mm, the outside of the shell", mm(2.0 * joint));
            self.errors.push(error.allowing(least));
            return None;
        }
        Some(shell)
    }
}
