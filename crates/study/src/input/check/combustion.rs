//! The generated gas pressure of an engine without a measurement.

use super::Checker;
use super::duty::round;
use super::{as_number, value_in};
use sommerfeld_engine::{
    Chamber, Combustion, GasExchange, HeatRatio, HeatRelease, IndicatorDiagram, WallHeat, Wiebe,
    Woschni,
};
use sommerfeld_film::Outcome;
use std::f64::consts::PI;

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

impl Checker<'_> {
    /// A diagram for every speed, ascending.
    pub(super) fn generated_gas(&mut self, speeds: &[f64]) -> Option<Vec<(f64, IndicatorDiagram)>> {
        let chamber = self.chamber();
        let heats = self.for_each_speed("heat", speeds.len());
        let pressures = self.for_each_speed("intake_pressure", speeds.len());
        let burning = self.burning();
        let (chamber, heats, pressures, parts) = (chamber?, heats?, pressures?, burning?);
        let mut combustion = Combustion {
            chamber,
            strokes: self.strokes()?,
            gas_exchange: self.gas_exchange()?,
            heat_release: HeatRelease { heat: 0.0, parts },
            heat_ratio: match self.number("engine.combustion.ratio_of_specific_heats") {
                Some(ratio) => HeatRatio::Constant(ratio),
                None => GAS,
            },
            wall_heat: self.wall_heat()?,
        };
        let mut diagrams = Vec::new();
        for ((speed, heat), pressure) in speeds.iter().zip(heats).zip(pressures) {
            combustion.heat_release.heat = heat;
            combustion.gas_exchange.intake_pressure = pressure;
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
        let list = self.list(&path);
        match list[..] {
            [] => None,
            [only] => Some(vec![only; speeds]),
            _ if list.len() == speeds => Some(list),
            _ => {
                let message = format!("`{path}` has {} values for {speeds} speeds", list.len());
                let error = self.error_at(&path, message);
                self.errors
                    .push(error.allowing("one for all speeds, or one for each"));
                None
            }
        }
    }

    fn gas_exchange(&self) -> Option<GasExchange> {
        let number = |name: &str| self.number(&format!("{SECTION}.{name}"));
        Some(GasExchange {
            intake_closes: number("intake_closes")?,
            exhaust_opens: number("exhaust_opens")?,
            intake_pressure: 0.0,
            intake_temperature: number("intake_temperature")?,
            exhaust_pressure: number("exhaust_pressure")?,
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
    fn burning(&mut self) -> Option<Vec<(f64, Wiebe)>> {
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
        let parts: Option<Vec<(f64, Wiebe)>> = list
            .iter()
            .map(|(_, entries)| {
                let number = |name: &str| {
                    value_in(entries, &format!("{BURNING}.{name}")).and_then(as_number)
                };
                let wiebe = Wiebe {
                    start: number("start")?,
                    duration: number("duration")?,
                    efficiency: number("efficiency")?,
                    exponent: number("exponent")?,
                };
                Some((number("share")?, wiebe))
            })
            .collect();
        let mut parts = parts?;
        let sum: f64 = parts.iter().map(|(share, _)| share).sum();
        // Shares typed to a few digits: 0.333 three times is one.
        if (sum - 1.0).abs() > 2e-3 {
            let message = format!("the shares of the heat add up to {}", round(sum));
            let error = self.section_error(SECTION, message);
            let error = error.of_key("engine.combustion.burning.share");
            self.errors.push(error.allowing("1 in all"));
            return None;
        }
        parts.iter_mut().for_each(|(share, _)| *share /= sum);
        Some(parts)
    }
}
