//! What the bearing has to do: journal state, steady load, load cycle, or the dimensionless case.

use super::Checker;
use crate::input::error::InputError;
use crate::input::load_file::{CycleSettings, LoadTable, read_load_table};
use crate::input::schema::Mode;
use crate::input::study::{
    BearingCase, CycleDuty, Duty, FilmModel, Rotor, SteadyLoad, StoredInstants, Subject,
    TiltCondition,
};
use crate::input::values::Value;
use sommerfeld_bearing::{CycleTilt, LoadCycle};
use sommerfeld_film::dimensionless::DimensionlessFilm;
use sommerfeld_film::{Bearing, JournalState};
use std::f64::consts::PI;

/// Largest number of steps in a period that is taken for an answer to a question.
const MOST_STEPS: f64 = 200_000.0;

impl Checker<'_> {
    /// What is calculated; `None` where an error says why not.
    pub(super) fn subject(&mut self) -> Option<Subject> {
        if self.mode == Mode::Dimensionless {
            return self.dimensionless().map(Subject::Dimensionless);
        }
        if self.mode == Mode::Database {
            let plan = self.database_plan()?;
            return Some(Subject::Database(Box::new(plan)));
        }
        if self.mode.is_machine() {
            return self.machine();
        }
        if let Some(entry) = self.entry("bearing").filter(|e| e.value == Value::Tables) {
            let message = format!("the analysis {} has one bearing", self.mode.name());
            let error = self
                .reading
                .error(&entry.key_span, message)
                .of_key("bearing");
            self.errors
                .push(error.hinting("write [bearing]; engines and shafts have several"));
            return None;
        }
        let bearing = self.bearing();
        let heat = self.heat(bearing.as_ref());
        let wear = bearing.as_ref().and_then(|b| self.wear(std::iter::once(b)));
        let temperature = self.number("oil.temperature");
        let lubricant = temperature.and_then(|temperature| self.lubricant(temperature, &heat));
        let duty = match self.mode {
            Mode::Film => self.journal_state(bearing.as_ref()).map(Duty::State),
            Mode::LoadCycle => self.load_cycle(bearing.as_ref()).map(Duty::Cycle),
            _ => self.steady_load(bearing.as_ref()).map(Duty::Load),
        };
        Some(Subject::Bearing(Box::new(BearingCase {
            bearing: bearing?,
            lubricant: lubricant?,
            temperature: temperature?,
            heat: heat?,
            wear: wear?,
            duty: duty?,
        })))
    }

    /// The dimensionless case, its gap open everywhere.
    fn dimensionless(&mut self) -> Option<DimensionlessFilm> {
        let model = self.film_model()?;
        if !model.is_field() {
            let error = self
                .error_at("film.model", "a dimensionless film is solved on the grid")
                .allowing("\"field\"");
            self.errors.push(error);
        }
        let rules = self.film_rules()?;
        let number = |name: &str| self.number(&format!("operation.{name}"));
        let case = DimensionlessFilm {
            d_over_b: number("d_over_b")?,
            relative_eccentricity: number("relative_eccentricity")?,
            tilt_gamma: number("tilt_gamma")?,
            tilt_delta: number("tilt_delta")?,
            wedge: number("wedge")?,
            squeeze: number("squeeze")?,
            cavitation: rules.cavitation,
            inlet: rules.inlet,
        };
        let narrowest = case.narrowest_gap();
        let (gap, z) = (narrowest.relative_film_thickness, narrowest.z);
        // A gap of round-off size is closed for every solver.
        if gap <= 1e-12 {
            let message = format!(
                "the gap closes at phi = {:.2} deg, Z = {z} (H = {:.4})",
                narrowest.phi_deg,
                gap + 0.0
            );
            let path = ["operation.tilt_gamma", "operation.tilt_delta"]
                .into_iter()
                .find(|path| z != 0.0 && self.entry(path).is_some())
                .unwrap_or("operation.relative_eccentricity");
            let error = self
                .error_at(path, message)
                .allowing("H = 1 + eps cos(phi) - gamma (1-eps) Z cos(phi) - delta Z sin(phi) above 0 everywhere")
                .hinting("reduce eccentricity or tilt");
            self.errors.push(error);
            return None;
        }
        Some(case)
    }

    /// The state of a `film` study in the shell frame.
    fn journal_state(&mut self, bearing: Option<&Bearing>) -> Option<JournalState> {
        let number = |name: &str| self.number(&format!("operation.{name}"));
        let eps = number("relative_eccentricity")?;
        let angle = number("line_of_centres_angle")?;
        let eps_rate = number("relative_eccentricity_rate")?;
        let turning = number("line_of_centres_rate")?;
        let (journal_speed, shell_speed) = (number("speed")?, number("shell_speed")?);
        let bearing = bearing?;
        let clearance = bearing.radial_clearance;
        // r points to the narrowest gap, t = z x r across.
        let (sin, cos) = angle.sin_cos();
        let (along, across) = (clearance * eps_rate, clearance * eps * turning);
        let state = JournalState {
            position: [clearance * eps * cos, clearance * eps * sin],
            tilt: self.pair("operation.tilt").unwrap_or_default(),
            velocity: [along * cos - across * sin, along * sin + across * cos],
            tilt_rate: self.pair("operation.tilt_rate").unwrap_or_default(),
            journal_speed,
            shell_speed,
            ..JournalState::default()
        };
        self.refuse_tilt_of_closed_form();
        self.check_gap(bearing, &state);
        Some(state)
    }

    /// Refuses a state that closes the gap, with the place where it does.
    fn check_gap(&mut self, bearing: &Bearing, state: &JournalState) {
        // Asperities hold a journal that smooth surfaces could not.
        if bearing.finish.has_contact() {
            return;
        }
        let least = bearing.narrowest_gap(state);
        if least.gap > 1e-12 * bearing.radial_clearance {
            return;
        }
        let is_tilted = state.tilt != [0.0; 2];
        let varies_along = bearing.bore.varies_along() || bearing.journal.varies_along();
        let place = if is_tilted || varies_along {
            format!("axial position {} mm", round(1e3 * least.axial))
        } else {
            "over the whole width".to_owned()
        };
        let message = format!(
            "the gap closes at {} deg from +X, {place} (gap {} um)",
            round(least.angle.to_degrees().rem_euclid(360.0)),
            round(least.gap * 1e6)
        );
        let path = if is_tilted && state.eccentricity() < bearing.radial_clearance {
            "operation.tilt"
        } else {
            "operation.relative_eccentricity"
        };
        let error = self
            .error_at(path, message)
            .allowing(if bearing.is_plain() {
                "a gap above 0 at both edges; relative_eccentricity below 1"
            } else {
                "a gap above 0 everywhere"
            })
            .hinting("reduce eccentricity or tilt");
        self.errors.push(error);
    }

    /// Tilt and moments need the field.
    fn refuse_tilt_of_closed_form(&mut self) {
        let Some(model) = self.model_without_tilt() else {
            return;
        };
        for path in ["operation.tilt", "operation.tilt_rate", "operation.moment"] {
            let given = self.entry(path).map(|entry| entry.value.clone());
            let is_zero = given == Some(Value::Pair([0.0; 2]));
            if given.is_some() && (!is_zero || path == "operation.moment") {
                let message = format!("the model {} has no tilt", model.name());
                let error = self
                    .error_at(path, message)
                    .hinting(match model {
                        FilmModel::Superposition => {
                            "its databases hold aligned journals: build them with journal = \"tilted\", or use \
                             model = \"field\""
                        }
                        _ => "use model = \"field\", or \"online\" with cavitation = \"gumbel\"",
                    });
                self.errors.push(error);
            }
        }
    }

    /// Load and speeds of an equilibrium.
    fn steady_load(&mut self, bearing: Option<&Bearing>) -> Option<SteadyLoad> {
        let load = self.pair("operation.load");
        let journal_speed = self.number("operation.speed");
        let shell_speed = self.number("operation.shell_speed");
        self.refuse_tilt_of_closed_form();
        let tilt = self.tilt_condition(bearing);
        let steady = SteadyLoad {
            load: load?,
            journal_speed: journal_speed?,
            shell_speed: shell_speed?,
            tilt,
        };
        if steady.journal_speed + steady.shell_speed == 0.0 {
            let error = self
                .error_at("operation.speed", "the surfaces drag no oil into the film: speed + shell_speed is 0")
                .hinting("a steady load needs rotation; for a load that varies use analysis = \"load-cycle\"");
            self.errors.push(error);
            return None;
        }
        Some(steady)
    }

    fn tilt_condition(&mut self, bearing: Option<&Bearing>) -> TiltCondition {
        let tilt = self.pair("operation.tilt");
        if let Some(moment) = self.pair("operation.moment") {
            if tilt.is_some() {
                let error = self
                    .error_at("operation.tilt", "the tilt is free where a moment is given")
                    .hinting("give tilt or moment, not both");
                self.errors.push(error);
            }
            return TiltCondition::Free { moment };
        }
        let tilt = tilt.unwrap_or_default();
        if let Some(bearing) = bearing {
            let state = JournalState {
                tilt,
                ..JournalState::default()
            };
            self.check_gap(bearing, &state);
        }
        TiltCondition::Fixed(tilt)
    }

    /// The rotor of the analysis `coefficients`, its speeds in order and none without drag.
    pub(super) fn rotor(&mut self) -> Rotor {
        const PATH: &str = "operation.speeds";
        if self.mode != Mode::Coefficients {
            return Rotor::default();
        }
        let speeds = self.list(PATH);
        if let Some(pair) = speeds.windows(2).find(|pair| pair[1] <= pair[0]) {
            let [before, behind] = [pair[0], pair[1]].map(|speed| round(speed * 30.0 / PI));
            let message = format!("the speeds do not ascend: {before} rpm, then {behind} rpm");
            let error = self.error_at(PATH, message).hinting("sort them, each once");
            self.errors.push(error);
        }
        let shell_speed = self.number("operation.shell_speed").unwrap_or(0.0);
        if speeds.iter().any(|speed| speed + shell_speed == 0.0) {
            let message = "at one of the speeds the surfaces drag no oil into the film: it cancels shell_speed";
            let error = self.error_at(PATH, message).hinting("leave that speed out");
            self.errors.push(error);
        }
        Rotor {
            mass: self.number("operation.rotor_mass"),
            speeds,
        }
    }

    fn load_cycle(&mut self, bearing: Option<&Bearing>) -> Option<CycleDuty> {
        let number = |name: &str| self.number(&format!("load_cycle.{name}"));
        let settings = CycleSettings {
            engine_speed: number("engine_speed")?,
            period: number("period")?,
            journal_mass: number("journal_mass")?,
        };
        let closure_tolerance = number("closure_tolerance")?;
        let crank_step = self.crank_step("load_cycle", settings.period);
        let Value::Integer(maximum_cycles) = self.value("load_cycle.maximum_cycles")? else {
            return None;
        };
        let name = self.text("load_cycle.file")?;
        let named_at = self.error_at("load_cycle.file", "");
        let mut table = self.load_table(&name, &settings, named_at)?;
        table.cycle.feed_pressures = std::mem::take(&mut self.feed_cycles);
        self.warnings.extend(table.warnings);
        self.check_cycle_tilt(&table.cycle, bearing);
        Some(CycleDuty {
            cycle: table.cycle,
            coefficients_at: self.list("load_cycle.coefficients_at"),
            crank_step: crank_step?,
            maximum_cycles: usize::try_from(maximum_cycles).ok()?,
            closure_tolerance,
            stored_fields: match self.text("output.fields")?.as_str() {
                "frames" => StoredInstants::Frames,
                "none" => StoredInstants::None,
                _ => StoredInstants::All,
            },
            step_error_factor: 1.0,
        })
    }

    /// A tilt needs the field, and a prescribed one must leave the gap open around the centre.
    fn check_cycle_tilt(&mut self, cycle: &LoadCycle, bearing: Option<&Bearing>) {
        let what = match cycle.tilt {
            CycleTilt::Aligned => return,
            CycleTilt::Free => "moment",
            CycleTilt::Prescribed(_) => "tilt",
        };
        if self.model_without_tilt().is_some() {
            let message = format!("the load table gives {what}s, the film model has no tilt");
            let error = self.error_at("load_cycle.file", message).hinting(format!(
                "use model = \"field\" or take the {what} columns out"
            ));
            self.errors.push(error);
        }
        let (CycleTilt::Prescribed(tilts), Some(bearing)) = (&cycle.tilt, bearing) else {
            return;
        };
        let gap = |tilt: [f64; 2]| {
            bearing.minimum_gap(&JournalState {
                tilt,
                ..JournalState::default()
            })
        };
        let closed = cycle
            .points
            .iter()
            .zip(tilts)
            .find(|(_, tilt)| gap(**tilt) <= 0.0);
        if let Some((point, tilt)) = closed {
            let message = format!(
                "the prescribed tilt closes the gap even of a centred journal: {}, {} mrad at crank \
                 angle {} deg (gap {} um)",
                round(1e3 * tilt[0]),
                round(1e3 * tilt[1]),
                round(point.crank_angle.to_degrees()),
                round(1e6 * gap(*tilt))
            );
            let largest = round(2e3 * bearing.radial_clearance / bearing.width);
            let error = self
                .error_at("load_cycle.file", message)
                .allowing(format!(
                    "a tilt below {largest} mrad, the diametral clearance over the width"
                ))
                .hinting("reduce the tilt; its unit stands in the header of its column");
            self.errors.push(error);
        }
    }

    /// The load table of a name that `named_at` is an error at.
    pub(super) fn load_table(
        &mut self,
        name: &str,
        settings: &CycleSettings,
        named_at: InputError,
    ) -> Option<LoadTable> {
        let table = self.table_text(name, "load table", named_at)?;
        match read_load_table(&table.file, &table.text, settings) {
            Ok(table) => Some(table),
            Err(errors) => {
                self.errors.extend(errors);
                None
            }
        }
    }

    /// The output step, which must divide the period so that cycles end on it.
    pub(super) fn crank_step(&mut self, section: &str, period: f64) -> Option<f64> {
        let given = format!("{section}.crank_step");
        let step = self.number(&given)?;
        let steps = (period / step).round();
        if steps >= 1.0 && (steps * step - period).abs() <= 1e-9 * period && steps <= MOST_STEPS {
            return Some(period / steps);
        }
        let path = match (self.mode, self.entry(&given)) {
            (_, Some(_)) => given.as_str(),
            (Mode::Shaft, None) => "shaft.period",
            _ => "load_cycle.period",
        };
        let nearest = round((period / steps.clamp(1.0, MOST_STEPS)).to_degrees());
        let error = self
            .error_at(path, "the crank step does not divide the period")
            .hinting(format!(
                "the nearest that does is crank_step = \"{nearest} deg\""
            ));
        self.errors.push(error);
        None
    }
}

/// A number as it is shown in messages, without round-off tails.
pub(super) fn round(value: f64) -> f64 {
    (value * 1e4).round() / 1e4 + 0.0
}
