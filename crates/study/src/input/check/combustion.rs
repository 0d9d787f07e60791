//! The generated gas pressure of an engine without a measurement.

use super::Checker;
use super::duty::round;
use super::{as_number, value_in};
use crate::input::read::Entries;
use crate::input::values::Value;
use sommerfeld_engine::{
    Chamber, Combustion, GasExchange, HeatRatio, HeatRelease, IndicatorDiagram, WallHeat, Wiebe,
    Woschni,
};
use sommerfeld_film::Outcome;
use std::f64::consts::PI;
use std::ops::Range;

const SECTION: &str = "engine.combustion";
const BURNING: &str = "engine.combustion.burning";
/// Points of a generated diagram in one turn of the crank.
const POINTS_PER_TURN: f64 = 720.0;
/// The heats of the gas where no ratio of them is given (J. A. Gatowski et al., SAE 841359, 1984); the
/// lowest is that of hot burnt gas.
const GAS: HeatRatio = HeatRatio::Falling {
    at_300_kelvin: 1.38,
    per_kelvin: 8e-5,
    lowest: 1.2,
};

const ONE_FOR_EACH: &str = "one for all speeds, or one for each";

/// A part of the heat: its share, and how it burns at each speed.
struct Burning {
    share: f64,
    start: Vec<f64>,
    duration: Vec<f64>,
    efficiency: f64,
    exponent: f64,
}

impl Burning {
    fn at(&self, speed: usize) -> Wiebe {
        Wiebe {
            start: self.start[speed],
            duration: self.duration[speed],
            efficiency: self.efficiency,
            exponent: self.exponent,
        }
    }
}

/// One value for all speeds, or one for each; how many there are where neither holds.
fn spread(list: Vec<f64>, speeds: usize) -> Result<Option<Vec<f64>>, usize> {
    match list[..] {
        [] => Ok(None),
        [only] => Ok(Some(vec![only; speeds])),
        _ if list.len() == speeds => Ok(Some(list)),
        _ => Err(list.len()),
    }
}

impl Checker<'_> {
    /// A diagram for every speed, ascending.
    pub(super) fn generated_gas(&mut self, speeds: &[f64]) -> Option<Vec<(f64, IndicatorDiagram)>> {
        let chamber = self.chamber();
        let [heats, intakes, temperatures, exhausts] = [
            "heat",
            "intake_pressure",
            "intake_temperature",
            "exhaust_pressure",
        ]
        .map(|name| self.for_each_speed(name, speeds.len()));
        let burning = self.burning(speeds.len());
        let (chamber, heats, intakes) = (chamber?, heats?, intakes?);
        let (temperatures, exhausts, burning) = (temperatures?, exhausts?, burning?);
        let mut combustion = Combustion {
            chamber,
            strokes: self.strokes()?,
            gas_exchange: self.gas_exchange()?,
            heat_release: HeatRelease {
                heat: 0.0,
                parts: Vec::new(),
            },
            heat_ratio: match self.number("engine.combustion.ratio_of_specific_heats") {
                Some(ratio) => HeatRatio::Constant(ratio),
                None => GAS,
            },
            wall_heat: self.wall_heat()?,
        };
        let mut diagrams = Vec::new();
        for (at, speed) in speeds.iter().enumerate() {
            combustion.heat_release = HeatRelease {
                heat: heats[at],
                parts: burning
                    .iter()
                    .map(|part| (part.share, part.at(at)))
                    .collect(),
            };
            combustion.gas_exchange.intake_pressure = intakes[at];
            combustion.gas_exchange.intake_temperature = temperatures[at];
            combustion.gas_exchange.exhaust_pressure = exhausts[at];
            diagrams.push((*speed, self.generate(&combustion, *speed)?));
        }
        diagrams.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(diagrams)
    }

    fn generate(&mut self, combustion: &Combustion, speed: f64) -> Option<IndicatorDiagram> {
        let turns = combustion.strokes.period() / (2.0 * PI);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 720 or 1440
        let points = (POINTS_PER_TURN * turns).round() as usize;
        let rpm = round(speed * 30.0 / PI);
        match combustion.cycle(speed, points) {
            Ok(cycle) => {
                if cycle.outcome != Outcome::Converged {
                    let message = format!(
                        "the gas pressure generated at {rpm} rpm is exact to {:.1e} of its peak only",
                        cycle.error
                    );
                    let note = self.section_error(SECTION, message);
                    self.warnings.push(note);
                }
                Some(cycle.diagram)
            }
            Err(error) => {
                let message = format!("the gas pressure cannot be generated at {rpm} rpm: {error}");
                let error = self.section_error(SECTION, message);
                self.errors.push(error.hinting(
                    "crank angles count from the firing top dead centre: the intake closes before it, \
                     the exhaust opens behind it",
                ));
                None
            }
        }
    }

    fn chamber(&self) -> Option<Chamber> {
        let engine = |name: &str| self.number(&format!("engine.{name}"));
        let chamber = Chamber {
            bore: engine("bore")?,
            crank_radius: 0.5 * engine("stroke")?,
            rod_length: engine("rod_length")?,
            pin_offset: engine("pin_offset")?,
            compression_ratio: engine("combustion.compression_ratio")?,
        };
        // A rod that does not reach is told by its own key.
        (chamber.rod_length > chamber.crank_radius + chamber.pin_offset.abs()).then_some(chamber)
    }

    /// Values of a key, one for each speed.
    fn for_each_speed(&mut self, name: &str, speeds: usize) -> Option<Vec<f64>> {
        let path = format!("{SECTION}.{name}");
        match spread(self.list(&path), speeds) {
            Ok(list) => list,
            Err(values) => {
                let message = format!("`{path}` has {values} values for {speeds} speeds");
                let error = self.error_at(&path, message);
                self.errors.push(error.allowing(ONE_FOR_EACH));
                None
            }
        }
    }

    /// Values of a key of one part of the heat, one for each speed.
    fn of_burning(
        &mut self,
        (header, entries): &(Range<usize>, Entries),
        name: &str,
        speeds: usize,
    ) -> Option<Vec<f64>> {
        let path = format!("{BURNING}.{name}");
        let Some(Value::List(list)) = value_in(entries, &path) else {
            return None;
        };
        match spread(list, speeds) {
            Ok(list) => list,
            Err(values) => {
                let message = format!("`{path}` has {values} values for {speeds} speeds");
                let at = entries.get(path.as_str());
                let span = at.map_or(header, |entry| &entry.value_span);
                let error = self.reading.error(span, message);
                self.errors.push(error.allowing(ONE_FOR_EACH));
                None
            }
        }
    }

    /// The valves; pressures and temperature follow for each speed.
    fn gas_exchange(&self) -> Option<GasExchange> {
        let number = |name: &str| self.number(&format!("{SECTION}.{name}"));
        Some(GasExchange {
            intake_closes: number("intake_closes")?,
            exhaust_opens: number("exhaust_opens")?,
            intake_pressure: 0.0,
            intake_temperature: 0.0,
            exhaust_pressure: 0.0,
            blow_down: number("blow_down")?,
            overlap: number("overlap")?,
        })
    }

    fn wall_heat(&self) -> Option<WallHeat> {
        if self.text("engine.combustion.wall_heat")? == "adiabatic" {
            return Some(WallHeat::Adiabatic);
        }
        let number = |name: &str| self.number(&format!("{SECTION}.{name}"));
        Some(WallHeat::Woschni(Woschni {
            swirl: number("swirl")?,
            combustion: number("woschni_constant")?,
            head_temperature: number("head_temperature")?,
            piston_temperature: number("piston_temperature")?,
            liner_temperature: number("liner_temperature")?,
            head_area_ratio: number("head_area_ratio")?,
            piston_area_ratio: number("piston_area_ratio")?,
        }))
    }

    /// Shares of the heat and how each burns.
    fn burning(&mut self, speeds: usize) -> Option<Vec<Burning>> {
        let list = self.reading.lists.get(BURNING).cloned().unwrap_or_default();
        let heats = self.list("engine.combustion.heat");
        if list.is_empty() {
            if heats.iter().all(|heat| *heat == 0.0) {
                return Some(Vec::new());
            }
            let error = self.section_error(SECTION, "how the heat is released is missing");
            self.errors.push(
                error
                    .of_key(BURNING)
                    .with_value("")
                    .hinting("add [[engine.combustion.burning]] with start and duration"),
            );
            return None;
        }
        let mut parts = Vec::new();
        for group in &list {
            let start = self.of_burning(group, "start", speeds);
            let duration = self.of_burning(group, "duration", speeds);
            let number =
                |name: &str| value_in(&group.1, &format!("{BURNING}.{name}")).and_then(as_number);
            parts.push(Burning {
                share: number("share")?,
                start: start?,
                duration: duration?,
                efficiency: number("efficiency")?,
                exponent: number("exponent")?,
            });
        }
        let sum: f64 = parts.iter().map(|part| part.share).sum();
        // Shares typed to a few digits: 0.333 three times is one.
        if (sum - 1.0).abs() > 2e-3 {
            let message = format!("the shares of the heat add up to {}", round(sum));
            let error = self.section_error(SECTION, message);
            let error = error.of_key("engine.combustion.burning.share");
            self.errors.push(error.allowing("1 in all"));
            return None;
        }
        parts.iter_mut().for_each(|part| part.share /= sum);
        Some(parts)
    }
}
