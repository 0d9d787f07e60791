//! The gas of an engine: measured diagrams, or a generated one.

use super::Checker;
use super::duty::round;
use super::{as_number, as_text, value_in};
use crate::input::diagram_file::{DiagramSettings, read_diagram, read_peaks};
use crate::input::error::InputError;
use crate::input::values::Value;
use sommerfeld_engine::{Gas, IndicatorDiagram};
use std::f64::consts::PI;

const FILE: &str = "engine.gas.file";
const DIAGRAM: &str = "engine.diagram";
const COMBUSTION: &str = "engine.combustion";

impl Checker<'_> {
    /// Gas over the speeds of the engine.
    pub(super) fn gas(&mut self, speeds: &[f64]) -> Option<Gas> {
        let has_file = self.entry(FILE).is_some();
        let has_list = self.entry(DIAGRAM).is_some();
        let is_generated = self.entry(COMBUSTION).is_some();
        let sources = [
            (has_file, FILE),
            (has_list, DIAGRAM),
            (is_generated, COMBUSTION),
        ];
        let given: Vec<&str> = sources.iter().filter(|s| s.0).map(|s| s.1).collect();
        let allowed = "engine.gas.file, [[engine.diagram]] for each speed, or [engine.combustion]";
        if let [_, second, ..] = given[..] {
            let error = self.section_error(second, "the gas pressure is given twice");
            self.errors.push(error.allowing(allowed));
            return None;
        }
        let settings = self.diagram_settings()?;
        let diagrams = match given[..] {
            [FILE] => {
                let name = self.text(FILE)?;
                let named_at = self.error_at(FILE, "");
                vec![(0.0, self.diagram(&name, named_at, &settings)?)]
            }
            [DIAGRAM] => self.diagrams(&settings)?,
            [_] => self.generated_gas(speeds)?,
            _ => {
                let error = self.section_error("engine", "the gas pressure is missing");
                let error = error.with_value("").of_key("engine.gas").allowing(allowed);
                self.errors
                    .push(error.hinting(
                        "[engine.gas] with file = \"pressure.csv\", or [engine.combustion] without a measurement",
                    ));
                return None;
            }
        };
        let peaks = self.peaks(settings.gauge_ambient)?;
        self.warn_beyond(speeds, diagrams.iter().map(|d| d.0), DIAGRAM, "diagrams");
        self.warn_beyond(
            speeds,
            peaks.iter().map(|p| p[0]),
            "engine.gas.peaks",
            "peak pressures",
        );
        Some(Gas { diagrams, peaks })
    }

    fn diagram_settings(&self) -> Option<DiagramSettings> {
        let is_gauge = self.value("engine.gas.gauge")? == Value::Flag(true);
        let ambient = self.number("engine.gas.ambient")?;
        Some(DiagramSettings {
            period: self.period()?,
            firing_tdc: self.number("engine.gas.firing_tdc")?,
            shift: self.number("engine.gas.shift")?,
            gauge_ambient: is_gauge.then_some(ambient),
            smoothing: self.number("engine.gas.smoothing"),
        })
    }

    /// The diagram of a file that `named_at` is an error at.
    fn diagram(
        &mut self,
        name: &str,
        named_at: InputError,
        settings: &DiagramSettings,
    ) -> Option<IndicatorDiagram> {
        let table = self.table_text(name, "indicator diagram", named_at)?;
        match read_diagram(&table.file, &table.text, settings) {
            Ok((diagram, warnings)) => {
                self.warnings.extend(warnings);
                Some(diagram)
            }
            Err(errors) => {
                self.errors.extend(errors);
                None
            }
        }
    }

    /// Every `[[engine.diagram]]`, by speed.
    fn diagrams(&mut self, settings: &DiagramSettings) -> Option<Vec<(f64, IndicatorDiagram)>> {
        let list = self.reading.lists.get(DIAGRAM)?.clone();
        let mut diagrams: Vec<(f64, IndicatorDiagram)> = Vec::new();
        for (header, entries) in &list {
            let speed = value_in(entries, "engine.diagram.speed").and_then(as_number);
            let name = value_in(entries, "engine.diagram.file").and_then(as_text);
            let (Some(speed), Some(name)) = (speed, name) else {
                continue;
            };
            let at = entries.get("engine.diagram.file");
            let span = at.map_or(header, |entry| &entry.value_span);
            let named_at = self.reading.error(span, "").of_key("engine.diagram.file");
            if diagrams.iter().any(|(known, _)| *known == speed) {
                let rpm = round(speed * 30.0 / PI);
                let message = format!("there are two diagrams for {rpm} rpm");
                let error = self.reading.error(header, message).of_key(DIAGRAM);
                self.errors.push(error.hinting("give one for each speed"));
                continue;
            }
            let diagram = self.diagram(&name, named_at, settings);
            diagrams.extend(diagram.map(|diagram| (speed, diagram)));
        }
        diagrams.sort_by(|a, b| a.0.total_cmp(&b.0));
        (diagrams.len() == list.len()).then_some(diagrams)
    }

    fn peaks(&mut self, gauge_ambient: Option<f64>) -> Option<Vec<[f64; 2]>> {
        const PEAKS: &str = "engine.gas.peaks";
        let Some(name) = self.text(PEAKS) else {
            return Some(Vec::new());
        };
        let named_at = self.error_at(PEAKS, "");
        let table = self.table_text(&name, "table of peak pressures", named_at)?;
        match read_peaks(&table.file, &table.text, gauge_ambient) {
            Ok(peaks) => Some(peaks),
            Err(errors) => {
                self.errors.extend(errors);
                None
            }
        }
    }

    /// Speeds beyond those of a table take its nearest row: a warning.
    fn warn_beyond(
        &mut self,
        speeds: &[f64],
        known: impl Iterator<Item = f64>,
        path: &str,
        what: &str,
    ) {
        let known: Vec<f64> = known.collect();
        let (Some(low), Some(high)) = (
            known.iter().copied().reduce(f64::min),
            known.iter().copied().reduce(f64::max),
        ) else {
            return;
        };
        if known.len() < 2 {
            return;
        }
        let rpm = |speed: f64| round(speed * 30.0 / PI);
        // Speeds typed in other units differ by round-off.
        let is_beyond =
            |speed: &&f64| **speed < low * (1.0 - 1e-9) || **speed > high * (1.0 + 1e-9);
        if let Some(speed) = speeds.iter().find(is_beyond) {
            let message = format!(
                "the {what} reach from {} to {} rpm: at {} rpm the nearest one is taken",
                rpm(low),
                rpm(high),
                rpm(*speed)
            );
            let note = self.section_error(path, message);
            self.warnings.push(note);
        }
    }
}
