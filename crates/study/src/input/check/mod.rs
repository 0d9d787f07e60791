//! From values to a study: what is missing, what is not used, and what no single key can tell.

mod bearing;
mod combustion;
mod crankshaft;
mod database;
mod drillings;
mod duty;
mod engine;
mod gas;
mod grooves;
mod heat;
mod machine;
mod machine_bearings;
mod oil;
mod shaft;
mod shapes;
mod surface;
mod sweep;
mod torsion;
mod wear;

use super::error::{InputError, InputErrors};
use super::files::{TABLE_CAP, read_text};
use super::film_models::tilts;
use super::keys::KEYS;
use super::read::{Entries, Entry, MOST_ERRORS, Reading};
use super::schema::{Key, Kind, Mode, Presence, find, nearest};
use super::study::{
    Analysis, Compared, FilmMethod, FilmModel, FilmSettings, LinearSolver, Study, StudyLimit,
    input_hash,
};
use super::values::{Value, default_value, not_built};
use crate::film_tables::StoredFilms;
use grooves::DrillingKeys;
use sommerfeld_bearing::PressureCycle;
use sommerfeld_film::Cavitation;
use sommerfeld_film::vogelpohl;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Reads and checks the text of a study.
pub(super) fn study(file: &str, text: &str, directory: &Path) -> Result<Study, InputErrors> {
    let mut reading = Reading::of(file, text);
    if reading.errors.len() >= MOST_ERRORS {
        // The rest was not read: nothing is known to be missing.
        return Err(sorted(reading.errors));
    }
    let Some(mode) = mode(&reading) else {
        report_missing_analysis(&mut reading);
        return Err(sorted(reading.errors));
    };
    let errors = std::mem::take(&mut reading.errors);
    let mut checker = Checker {
        reading,
        mode,
        errors,
        warnings: Vec::new(),
        table_bytes: Vec::new(),
        files: vec![PathBuf::from(file)],
        feed_cycles: Vec::new(),
        drillings: Vec::new(),
        databases: Vec::new(),
        directory,
    };
    checker.report_missing("");
    checker.report_unused("");
    checker.leave_out_feeds();
    checker.read_databases();
    if mode == Mode::Sweep {
        return checker.sweep();
    }
    let subject = checker.subject();
    let film = checker.film_settings();
    let rotor = checker.rotor();
    let limits = checker.limits();
    if !checker.errors.is_empty() {
        return Err(sorted(checker.errors));
    }
    let (Some(subject), Some(film)) = (subject, film) else {
        // Every value is there or an error says why not.
        return Err(InputError::new(file, "the study is incomplete").into());
    };
    let input_hash = input_hash(&[text.as_bytes(), &checker.table_bytes]);
    Ok(Study {
        title: checker.text("title").unwrap_or_default(),
        analysis: analysis(mode),
        subject,
        film,
        rotor,
        limits,
        warnings: sorted(checker.warnings).0,
        file: file.to_owned(),
        files: checker.files,
        text: text.to_owned(),
        input_hash,
    })
}

/// Errors in the order of the lines they are about; those about whole files first.
fn sorted(mut errors: Vec<InputError>) -> InputErrors {
    errors.sort_by_key(|error| {
        error
            .place
            .as_ref()
            .map_or((0, 0), |place| (place.line, place.columns.start))
    });
    InputErrors(errors)
}

/// What the study does, as far as `analysis` and `operation.dimensionless` tell.
fn mode(reading: &Reading<'_>) -> Option<Mode> {
    let Value::Text(analysis) = &reading.entries.get("analysis")?.value else {
        return None;
    };
    let dimensionless = reading.entries.get("operation.dimensionless");
    let is_dimensionless = dimensionless.is_some_and(|entry| entry.value == Value::Flag(true));
    match analysis.as_str() {
        "film" if is_dimensionless => Some(Mode::Dimensionless),
        "film" => Some(Mode::Film),
        "equilibrium" => Some(Mode::Equilibrium),
        "coefficients" => Some(Mode::Coefficients),
        "load-cycle" => Some(Mode::LoadCycle),
        "engine" => Some(Mode::Engine),
        "shaft" => Some(Mode::Shaft),
        "database" => Some(Mode::Database),
        "sweep" => Some(Mode::Sweep),
        _ => None,
    }
}

fn analysis(mode: Mode) -> Analysis {
    match mode {
        Mode::Film | Mode::Dimensionless => Analysis::Film,
        Mode::Equilibrium => Analysis::Equilibrium,
        Mode::Coefficients => Analysis::Coefficients,
        Mode::LoadCycle => Analysis::LoadCycle,
        Mode::Engine => Analysis::Engine,
        Mode::Shaft => Analysis::Shaft,
        Mode::Database => Analysis::Database,
        Mode::Sweep => Analysis::Sweep,
    }
}

fn report_missing_analysis(reading: &mut Reading<'_>) {
    // Behind a syntax error nothing is known to be missing.
    if !reading.errors.is_empty() && reading.entries.is_empty() {
        return;
    }
    for path in ["schema", "analysis"] {
        if let Some(key) = find(path).filter(|_| !reading.was_given(path)) {
            reading.errors.push(missing(reading, key, None));
        }
    }
}

/// The error for a key that is not there, at the header of its section.
fn missing(reading: &Reading<'_>, key: &Key, header: Option<&Range<usize>>) -> InputError {
    let (what, example) = match (key.kind, key.example()) {
        (Kind::Table | Kind::TableList | Kind::TableOrList, _) => {
            ("section", format!("add [{}]", key.path))
        }
        (_, Some(example)) => ("key", format!("for example {} = {example}", key.name())),
        _ => ("key", format!("{} Typical: {}", key.meaning, key.typical)),
    };
    let message = format!("the {what} `{}` is missing", key.path);
    match header {
        Some(span) => reading.error(span, message),
        None => InputError::new(reading.file, message),
    }
    .of_key(key.path)
    .with_value("")
    .hinting(example)
}

/// A study being checked.
struct Checker<'t> {
    reading: Reading<'t>,
    mode: Mode,
    errors: Vec<InputError>,
    warnings: Vec<InputError>,
    /// Bytes of the tables that the study names, for the hash.
    table_bytes: Vec<u8>,
    /// The study file and the tables it names.
    files: Vec<PathBuf>,
    /// Supply pressures over the crank angle.
    feed_cycles: Vec<PressureCycle>,
    /// Drillings in the crank of a machine, as given.
    drillings: Vec<DrillingKeys>,
    /// The databases of films that it names.
    databases: Vec<StoredFilms>,
    /// Where the files of the study lie.
    directory: &'t Path,
}

impl Checker<'_> {
    /// The value of a key, or its default.
    fn value(&self, path: &str) -> Option<Value> {
        value_in(&self.reading.entries, path)
    }

    /// The entry of a key, if the file gives it.
    fn entry(&self, path: &str) -> Option<&Entry> {
        self.reading.entries.get(path)
    }

    /// A number or quantity in SI.
    fn number(&self, path: &str) -> Option<f64> {
        as_number(self.value(path)?)
    }

    /// Text or a word of a choice.
    fn text(&self, path: &str) -> Option<String> {
        as_text(self.value(path)?)
    }

    /// Two quantities in SI.
    fn pair(&self, path: &str) -> Option<[f64; 2]> {
        match self.value(path)? {
            Value::Pair(pair) => Some(pair),
            _ => None,
        }
    }

    /// Quantities in SI; none where the key is left out.
    fn list(&self, path: &str) -> Vec<f64> {
        match self.value(path) {
            Some(Value::List(list)) => list,
            _ => Vec::new(),
        }
    }

    /// An error at the value of a key, or about the whole file where the key is left out.
    fn error_at(&self, path: &str, message: impl Into<String>) -> InputError {
        match self.entry(path) {
            Some(entry) => self.reading.error(&entry.value_span, message),
            None => InputError::new(self.reading.file, message),
        }
        .of_key(path)
    }

    /// An unknown key was taken for this one: one slip, one message.
    fn was_misspelt(&self, key: &Key) -> bool {
        self.errors.iter().any(|error| {
            find(&error.key).is_none()
                && nearest(&error.key).is_some_and(|meant| meant.path == key.path)
        })
    }

    /// Reports keys that this study needs and the file does not give: those whose path starts with
    /// `prefix`, and those of every list.
    fn report_missing(&mut self, prefix: &str) {
        for key in KEYS.iter().filter(|key| key.path.starts_with(prefix)) {
            let section = key.section();
            let is_due = key.presence == Presence::Required
                && key.used_by.contains(&self.mode)
                && !find(section).is_some_and(|section| matches!(section.kind, Kind::TableList))
                && !self.reading.was_given(key.path)
                && !self.may_miss(key.path)
                && !self.was_misspelt(key);
            // A quantity given in place of a law has no keys; a missing section is one error.
            let header = self.entry(section);
            let has_section =
                section.is_empty() || header.is_some_and(|entry| entry.value == Value::Table);
            if is_due && has_section {
                let header = header.map(|entry| &entry.key_span);
                let error = missing(&self.reading, key, header);
                self.errors.push(error);
            }
        }
        let grooves = [("bearing.groove", &self.reading.grooves)];
        let others = self.reading.lists.iter().map(|(path, list)| (*path, list));
        for (path, list) in grooves.into_iter().chain(others) {
            for (header, group) in list {
                if self.errors.len() >= MOST_ERRORS {
                    return;
                }
                for key in KEYS.iter().filter(|key| key.section() == path) {
                    if key.presence == Presence::Required
                        && !group.contains_key(key.path)
                        && !self.was_misspelt(key)
                    {
                        self.errors.push(missing(&self.reading, key, Some(header)));
                    }
                }
            }
        }
    }

    /// Keys that this analysis does not read: a warning, so that one file can serve several
    /// analyses; an error where a dimensional value would mean nothing. Of keys whose path starts with
    /// `prefix`.
    fn report_unused(&mut self, prefix: &str) {
        let mut unused: Vec<(&Key, Range<usize>)> = Vec::new();
        for (path, entry) in &self.reading.entries {
            let Some(key) = find(path).filter(|key| key.path.starts_with(prefix)) else {
                continue;
            };
            let section_is_used =
                find(key.section()).is_none_or(|section| section.used_by.contains(&self.mode));
            if !key.used_by.contains(&self.mode) && section_is_used {
                unused.push((key, entry.key_span.clone()));
            }
        }
        for (key, span) in unused {
            let message = format!(
                "`{}` is not used by the analysis {}",
                key.path,
                self.mode.name()
            );
            let note = self.reading.error(&span, message).of_key(key.path);
            if self.mode == Mode::Dimensionless {
                self.errors.push(note.hinting("take it out"));
            } else if self.mode == Mode::Sweep {
                self.errors
                    .push(note.hinting("it belongs into the base study, or under [sweep] vary"));
            } else if key.path == "operation.dimensionless" {
                self.errors
                    .push(note.hinting("only the analysis \"film\" can be dimensionless"));
            } else if key.path == "film.compare" {
                let what = format!("film.compare of the analysis {}", self.mode.name());
                let error = not_built(note, &what);
                self.errors
                    .push(error.allowing("film, equilibrium, coefficients, load-cycle"));
            } else if self.mode.is_machine() && key.path == "film.relative_error_target" {
                let what = format!("an error target of the analysis {}", self.mode.name());
                let error = not_built(note, &what);
                self.errors.push(error.hinting(
                    "take it out; the loads-<name>.csv of a bearing can be run as a load-cycle study with a target",
                ));
            } else {
                self.warnings.push(note);
            }
        }
    }

    /// Reads a table that the study names for the hash; `what` is the kind of table, `named_at` an
    /// error at its name.
    fn table_text(&mut self, name: &str, what: &str, named_at: InputError) -> Option<NamedTable> {
        match self.named_table(name, what, named_at) {
            Ok(table) => {
                self.take_in(&table);
                Some(table)
            }
            Err(error) => {
                self.errors.push(*error);
                None
            }
        }
    }

    /// A table that was used is part of the study.
    fn take_in(&mut self, table: &NamedTable) {
        self.table_bytes.extend_from_slice(table.text.as_bytes());
        self.files.push(table.path.clone());
    }

    fn named_table(
        &self,
        name: &str,
        what: &str,
        named_at: InputError,
    ) -> Result<NamedTable, Box<InputError>> {
        let path = self.directory.join(name);
        let refuse = |why: &str, hint: String| {
            Box::new(InputError {
                message: format!("the {what} cannot be used: {why}"),
                hint: Some(hint),
                ..named_at.clone()
            })
        };
        let same_file = |other: &Path| {
            let real = std::fs::canonicalize(&path);
            matches!((real, std::fs::canonicalize(other)), (Ok(a), Ok(b)) if a == b)
        };
        if name.trim().is_empty() {
            let hint = "give the path of a CSV file, relative to the study";
            return Err(refuse("it has no name", hint.into()));
        }
        if same_file(Path::new(self.reading.file)) {
            let hint = "give the path of a CSV file";
            return Err(refuse("it is the study itself", hint.into()));
        }
        match read_text(&path, TABLE_CAP) {
            Ok(text) => Ok(NamedTable {
                file: path.to_string_lossy().into_owned(),
                path,
                text,
            }),
            // What is wrong inside the file is shown there.
            Err(error) if error.place.is_some() => Err(error),
            Err(error) => {
                let shown: String = path.to_string_lossy().chars().take(300).collect();
                let looked = format!("it was looked for at {shown}");
                let allowed = error.allowed.clone();
                let mut refused = refuse(&error.message, error.hint.unwrap_or(looked));
                refused.allowed = allowed;
                Err(refused)
            }
        }
    }

    /// Whether a law has the keys it needs and none that belong to another law of its section.
    fn law_keys(&mut self, section: &str, law: &str, keys: LawKeys<'_>) -> bool {
        let path = |name: &str| format!("{section}.{name}");
        let given = |name: &&&str| self.reading.was_given(&path(name));
        let mut errors = Vec::new();
        for name in keys.needed.iter().filter(|name| !given(name)) {
            let message = format!("the law {law} needs `{name}`");
            let error = self.error_at(&path("law"), message);
            errors.push(error.allowing(keys.needed.join(", ")));
        }
        for name in keys.foreign.iter().filter(given) {
            let message = format!("the law {law} has no `{name}`");
            let error = self.error_at(&path(name), message);
            errors.push(if keys.needed.is_empty() {
                error.hinting("take it out")
            } else {
                error.allowing(keys.needed.join(", "))
            });
        }
        let are_right = errors.is_empty();
        self.errors.extend(errors);
        are_right
    }

    /// Takes the grooves and holes out of every bearing, where the study asks for it.
    fn leave_out_feeds(&mut self) {
        const PATH: &str = "film.feeds";
        if self.text(PATH).as_deref() != Some("left-out") {
            return;
        }
        let tables = self.reading.bearings.iter_mut();
        let lists = tables.map(|table| &mut table.grooves);
        let mut left_out = 0;
        for list in lists.chain([&mut self.reading.grooves]) {
            left_out += list.len();
            list.clear();
        }
        if left_out > 0 {
            let message = format!("the grooves and holes of the study, {left_out}, are left out");
            let note = self.error_at(PATH, message);
            self.warnings.push(note);
        }
    }

    fn film_model(&self) -> Option<FilmModel> {
        FilmModel::from_name(&self.text("film.model")?)
    }

    /// The film model, where its journal cannot tilt.
    fn model_without_tilt(&self) -> Option<FilmModel> {
        let model = self.film_model()?;
        let closure = match self.text("film.cavitation")?.as_str() {
            "reynolds" => Cavitation::Reynolds,
            _ => Cavitation::Gumbel,
        };
        (!tilts(model, closure, &self.databases)).then_some(model)
    }

    fn film_settings(&mut self) -> Option<FilmSettings> {
        let model = self.film_model()?;
        let compare = self.compared(model);
        if !model.is_field() {
            for path in [
                "film.grid",
                "film.linear_solver",
                "film.relative_error_target",
                "output.fields",
            ] {
                let compares_field = compare.contains(&Compared::Model(FilmModel::Field));
                if compares_field && path == "film.grid" {
                    continue;
                }
                if let Some(entry) = self.entry(path) {
                    let message = format!("`{path}` is not used by the model {}", model.name());
                    let note = self.reading.error(&entry.key_span, message).of_key(path);
                    self.warnings.push(note);
                }
            }
        }
        let Value::Grid(grid) = self.value("film.grid")? else {
            return None;
        };
        let method = self.film_method(grid)?;
        if model.is_field() && method == FilmMethod::FiniteVolume {
            self.check_grid_memory(grid);
        }
        let linear_solver = match self.text("film.linear_solver")?.as_str() {
            "banded" => LinearSolver::Banded,
            _ => LinearSolver::Auto,
        };
        Some(FilmSettings {
            model,
            method,
            grid,
            linear_solver,
            relative_error_target: self.number("film.relative_error_target"),
            compare,
            databases: self.databases.clone(),
        })
    }

    /// What the study is run once more with; what would compare it with itself is left out, and said.
    fn compared(&mut self, own: FilmModel) -> Vec<Compared> {
        const PATH: &str = "film.compare";
        let Some(Value::Words(words)) = self.value(PATH) else {
            return Vec::new();
        };
        let mut compare = Vec::new();
        for word in &words {
            let compared = FilmModel::from_name(word).map_or(Compared::Plain, Compared::Model);
            let itself = match compared {
                Compared::Plain if !own.is_field() => format!(
                    "\"plain\" compares nothing: surfaces and oil of the model {} are plain",
                    own.name()
                ),
                Compared::Model(model) if model == own => {
                    format!("\"{word}\" compares nothing: it is the study's own film model")
                }
                _ => {
                    compare.push(compared);
                    continue;
                }
            };
            let note = self.error_at(PATH, itself);
            self.warnings.push(note);
        }
        compare
    }

    /// How the film is solved; the paper's method is for its own problem alone.
    fn film_method(&mut self, grid: [usize; 2]) -> Option<FilmMethod> {
        if self.text("film.method")? != FilmMethod::VogelpohlFdm.name() {
            return Some(FilmMethod::FiniteVolume);
        }
        let mut errors = Vec::new();
        if self.mode != Mode::Dimensionless {
            let what = format!(
                "the analysis {} has no method vogelpohl-fdm",
                self.mode.name()
            );
            let error = self
                .error_at("film.method", what)
                .allowing("\"finite-volume\"");
            errors
                .push(error.hinting(
                    "it solves the analysis \"film\" with operation.dimensionless = true",
                ));
        } else {
            if self
                .text("film.cavitation")
                .is_some_and(|closure| closure != "reynolds")
            {
                let path = if self.entry("film.cavitation").is_some() {
                    "film.cavitation"
                } else {
                    "film.method"
                };
                let what = "the method vogelpohl-fdm sets negative pressures to 0 as it iterates";
                let error = self.error_at(path, what).of_key("film.cavitation");
                errors.push(error.allowing("\"reynolds\""));
            }
            if self.entry("film.relative_error_target").is_some() {
                let what = "the method vogelpohl-fdm has no error target";
                let error = self.error_at("film.relative_error_target", what);
                errors.push(error.hinting("take it out; the option --verify gives error bars"));
            }
            let fewest = vogelpohl::FEWEST_INTERVALS;
            if (0..2).any(|k| grid[k] < fewest[k]) {
                let what = "the method vogelpohl-fdm needs more intervals";
                let error = self.error_at("film.grid", what);
                errors.push(error.allowing(format!("at least [{}, {}]", fewest[0], fewest[1])));
            }
        }
        let is_right = errors.is_empty();
        self.errors.extend(errors);
        is_right.then_some(FilmMethod::VogelpohlFdm)
    }

    /// Refuses a grid whose direct solution does not fit into the memory of usual machines: it is
    /// better told than found out by an allocation that fails.
    fn check_grid_memory(&mut self, [around, axial]: [usize; 2]) {
        /// Entries of the dense inverses, cells around times cells along the axis squared: 16 GB.
        const MOST_ENTRIES: f64 = 2e9;
        let entries = around as f64 * (axial as f64).powi(2);
        if entries > MOST_ENTRIES {
            let message = format!("the grid needs {:.0} GB of memory", 8e-9 * entries);
            let most_axial = (MOST_ENTRIES / around as f64).sqrt().floor();
            let error = self
                .error_at("film.grid", message)
                .allowing(format!("at most {:.0} GB", 8e-9 * MOST_ENTRIES))
                .hinting(format!(
                    "with {around} cells around take at most {most_axial} along the axis"
                ));
            self.errors.push(error);
        }
    }

    fn limits(&self) -> Vec<StudyLimit> {
        KEYS.iter()
            .filter_map(|key| match &self.entry(key.path)?.value {
                Value::Limit(value, source) => Some(StudyLimit {
                    key: key.name(),
                    value: *value,
                    source: source.clone(),
                }),
                _ => None,
            })
            .collect()
    }
}

/// Keys of a law beside its name.
struct LawKeys<'k> {
    /// It cannot do without.
    needed: &'k [&'k str],
    /// They belong to other laws of the section.
    foreign: &'k [&'k str],
}

/// A table that a study names.
struct NamedTable {
    /// Its path, relative to the study, as messages show it.
    file: String,
    path: PathBuf,
    text: String,
}

/// The value of a key among some entries, or its default.
fn value_in(entries: &Entries, path: &str) -> Option<Value> {
    match entries.get(path) {
        Some(entry) => Some(entry.value.clone()),
        None => default_value(find(path)?),
    }
}

fn as_number(value: Value) -> Option<f64> {
    match value {
        Value::Number(number) => Some(number),
        _ => None,
    }
}

fn as_text(value: Value) -> Option<String> {
    match value {
        Value::Text(text) => Some(text),
        _ => None,
    }
}
