//! Databases of films: those that a study looks up, and one that is to be built.

use super::Checker;
use crate::film_tables::{Scheme, StoredFilms, closure_name};
use crate::input::error::InputError;
use crate::input::film_models::{refusal_of_bearing, scheme};
use crate::input::schema::Mode;
use crate::input::study::{DatabasePlan, FilmMethod, FilmModel, FilmSettings, LinearSolver};
use crate::input::values::Value;
use sommerfeld_database::superposition::SuperpositionRecipe;
use sommerfeld_database::{DatabaseError, Recipe};
use sommerfeld_film::{Bearing, Cavitation, Inlet};
use std::fs;

const FILES: &str = "film.database";
const RATIOS: &str = "database.width_ratios";
const SMALLEST_GAP: &str = "database.smallest_gap";
const NODES: &str = "database.nodes";
/// Largest database, bytes.
const MOST_BYTES: u64 = 1 << 30;

impl Checker<'_> {
    /// Reads the databases that the study names, if one of its film models looks anything up.
    pub(super) fn read_databases(&mut self) {
        let own = self.film_model().filter(|model| model.is_looked_up());
        let compared = self.compared_words().into_iter();
        let mut models = own.into_iter().chain(compared);
        let needed = models.find(|model| model.is_looked_up());
        let names = match self.value(FILES) {
            Some(Value::Words(names)) => names,
            _ => Vec::new(),
        };
        match (needed, names.is_empty()) {
            (None, false) => {
                let message = "`film.database` is not used: no film model of the study looks it up";
                let note = self.error_at(FILES, message);
                self.warnings.push(note.hinting("model = \"database\""));
                return;
            }
            (Some(model), true) if !self.reading.was_given(FILES) => {
                let path = match own {
                    Some(_) => "film.model",
                    None => "film.compare",
                };
                let message = format!(
                    "the film model {} needs `film.database`, the file of its films",
                    model.name()
                );
                let error = self.error_at(path, message);
                self.errors.push(
                    error.hinting("`sommerfeld new database DIR` writes a study that builds one"),
                );
                return;
            }
            _ => {}
        }
        for name in names {
            match self.read_database(&name) {
                Ok(database) => self.databases.push(database),
                Err(error) => self.errors.push(*error),
            }
        }
    }

    fn read_database(&mut self, name: &str) -> Result<StoredFilms, Box<InputError>> {
        let refuse = |checker: &Self, why: String, hint: &str| {
            let message = match name.trim() {
                "" => format!("the database cannot be used: {why}"),
                name => format!("the database {name} cannot be used: {why}"),
            };
            Box::new(checker.error_at(FILES, message).hinting(hint))
        };
        const BUILD: &str = "`sommerfeld database build STUDY` makes one";
        if name.trim().is_empty() {
            return Err(refuse(self, "it has no name".to_owned(), BUILD));
        }
        let path = self.directory.join(name);
        let metadata = fs::metadata(&path).map_err(|error| {
            let shown: String = path.to_string_lossy().chars().take(300).collect();
            let why = match error.kind() {
                std::io::ErrorKind::NotFound => format!("there is no file {shown}"),
                _ => format!("{shown} cannot be read: {error}"),
            };
            refuse(self, why, BUILD)
        })?;
        if metadata.is_dir() {
            let hint =
                "the results of an analysis \"database\" are a directory: name the table.h5 in it";
            return Err(refuse(self, "it is a directory".to_owned(), hint));
        }
        if metadata.len() > MOST_BYTES {
            let why = format!("it has {} MB", metadata.len() >> 20);
            return Err(refuse(self, why, "is this the right file?"));
        }
        let found = StoredFilms::load(name, &path).map_err(|error| {
            let why = match error {
                DatabaseError::File { reason, .. } | DatabaseError::Contents { reason, .. } => {
                    reason
                }
                other => other.to_string(),
            };
            refuse(self, why, BUILD)
        })?;
        if let Ok(bytes) = fs::read(&path) {
            self.table_bytes.extend_from_slice(&bytes);
        }
        self.files.push(path);
        Ok(found)
    }

    /// Film models that the study is compared with, before anything of them is judged.
    fn compared_words(&self) -> Vec<FilmModel> {
        match self.value("film.compare") {
            Some(Value::Words(words)) => words
                .iter()
                .filter_map(|word| FilmModel::from_name(word))
                .collect(),
            _ => Vec::new(),
        }
    }

    /// The closure of the databases that a model looks up: that of the study where one of them holds it,
    /// else that of the first.
    pub(super) fn looked_up_closure(&self, model: FilmModel) -> Option<Cavitation> {
        let of_scheme = |one: &&StoredFilms| one.scheme() == scheme(model);
        let mut all = self.databases.iter().filter(of_scheme);
        let given = self.entry("film.cavitation").map(|entry| &entry.value);
        let is_given = |one: &&StoredFilms| matches!(given, Some(Value::Text(word)) if word == closure_name(one.closure()));
        let given = all.clone().find(is_given);
        given.or_else(|| all.next()).map(StoredFilms::closure)
    }

    /// Refuses a bearing that the film model cannot have, with what it can.
    pub(super) fn check_film_model(&mut self, bearing: &Bearing) {
        let Some(model) = self.film_model().filter(|model| !model.overlooks_feeds()) else {
            return;
        };
        if model.is_looked_up() && self.databases.is_empty() {
            // Told already.
            return;
        }
        let settings = FilmSettings {
            model,
            method: FilmMethod::FiniteVolume,
            grid: [0; 2],
            linear_solver: LinearSolver::Auto,
            relative_error_target: None,
            compare: Vec::new(),
            databases: self.databases.clone(),
        };
        let Some(reason) = refusal_of_bearing(model, bearing, &settings) else {
            return;
        };
        let message = format!("the film model {} cannot do this: {reason}", model.name());
        let is_told = |error: &InputError| {
            let keys = ["bearing.groove", "bearing.bore", "bearing.journal", "film."];
            keys.iter().any(|key| error.key.starts_with(key))
                || error.key.starts_with("bearing.surface")
                || error.key.starts_with("bearing.shell")
        };
        if self.errors.iter().any(is_told) {
            return;
        }
        let path = if model.is_looked_up() {
            FILES
        } else {
            "film.model"
        };
        let error = self.error_at(path, message);
        self.errors.push(error.hinting("use model = \"field\""));
    }

    /// What is to be built.
    pub(super) fn database_plan(&mut self) -> Option<DatabasePlan> {
        let closure = match self.entry("film.cavitation") {
            None => Cavitation::Reynolds,
            Some(_) => match self.text("film.cavitation")?.as_str() {
                "gumbel" => Cavitation::Gumbel,
                "reynolds" => Cavitation::Reynolds,
                _ => {
                    let message =
                        "a film that conserves mass remembers its past, which no database holds";
                    let error = self.error_at("film.cavitation", message);
                    self.errors.push(error.allowing("\"gumbel\", \"reynolds\""));
                    return None;
                }
            },
        };
        let starts_on_line = self.text("film.inlet").as_deref() == Some("max-film-line");
        let width_ratios = self.width_ratios()?;
        let samples = self.count("database.samples");
        let last = self.number("database.last_eccentricity");
        if self.text("database.scheme")? == Scheme::Superposition.name() {
            return self.superposition_plan(closure, starts_on_line, width_ratios);
        }
        self.refuse_keys_of_superposition()?;
        if starts_on_line {
            let message = "a combined database holds films that go around: a line at the widest gap has no \
                           place where the gap opens";
            let error = self.error_at("film.inlet", message).allowing("\"cyclic\"");
            self.errors.push(error);
            return None;
        }
        let usual = Recipe::new(closure, width_ratios[0]);
        let recipe = Recipe {
            width_ratios,
            target: self.number("database.target").unwrap_or(usual.target),
            last_eccentricity: last.unwrap_or(usual.last_eccentricity),
            samples: samples.unwrap_or(usual.samples),
            seed: self
                .count("database.seed")
                .map_or(usual.seed, |seed| seed as u64),
            ..usual
        };
        if let Err(error) = recipe.check() {
            let error = self.error_at("database", error.to_string());
            self.errors.push(error);
            return None;
        }
        Some(DatabasePlan::Combined(recipe))
    }

    /// What the paper's database is built from.
    fn superposition_plan(
        &mut self,
        closure: Cavitation,
        starts_on_line: bool,
        [narrow, wide]: [f64; 2],
    ) -> Option<DatabasePlan> {
        if narrow != wide {
            let message = "a database of the scheme superposition holds one width over diameter";
            let error = self.error_at(RATIOS, message);
            self.errors.push(error.hinting("build one for each"));
            return None;
        }
        let is_tilted = self.text("database.journal")? == "tilted";
        let usual = match is_tilted {
            true => SuperpositionRecipe::tilted(1.0 / narrow),
            false => SuperpositionRecipe::aligned(1.0 / narrow),
        };
        if !is_tilted && self.entry(SMALLEST_GAP).is_some() {
            let message = "aligned journals leave a smallest gap of 1 - last_eccentricity";
            let error = self.error_at(SMALLEST_GAP, message);
            let hint = "give `database.last_eccentricity`, or journal = \"tilted\"";
            self.errors.push(error.hinting(hint));
            return None;
        }
        let last = self.number("database.last_eccentricity");
        let last = last.unwrap_or(usual.eccentricities[1]);
        let (eccentricity_nodes, tilt_nodes) = self.nodes(is_tilted, &usual)?;
        let count = |path: &str, usual: usize| self.count(path).unwrap_or(usual);
        let recipe = SuperpositionRecipe {
            eccentricities: [usual.eccentricities[0], last],
            eccentricity_nodes,
            tilt_nodes,
            cavitation: closure,
            wedge_inlet: match starts_on_line {
                true => Inlet::MaxFilmLine { pressure: 0.0 },
                false => Inlet::Cyclic,
            },
            smallest_gap: match is_tilted {
                true => self.number(SMALLEST_GAP).unwrap_or(usual.smallest_gap),
                // The samples reach as far as the nodes.
                false => 1.0 - last,
            },
            samples: count("database.samples", usual.samples),
            seed: count("database.seed", usual.seed as usize) as u64,
            most_films: count("database.most_films", usual.most_films),
            target: self.number("database.target").unwrap_or(usual.target),
            ..usual
        };
        Some(DatabasePlan::Superposition(recipe))
    }

    /// What a combined database has not.
    fn refuse_keys_of_superposition(&mut self) -> Option<()> {
        let keys = [SMALLEST_GAP, NODES, "database.most_films"];
        let given = keys.into_iter().find(|key| self.entry(key).is_some());
        let is_tilted = self.text("database.journal")? == "tilted";
        let (key, message) = match given {
            _ if is_tilted => (
                "database.journal",
                "a combined database holds aligned journals: tilted ones would need five axes and more"
                    .to_owned(),
            ),
            Some(key) => (key, format!("`{key}` is one of the scheme superposition")),
            None => return Some(()),
        };
        let error = self.error_at(key, message);
        self.errors
            .push(error.hinting("scheme = \"superposition\""));
        None
    }

    /// Nodes along the eccentricity and the tilts, as given or as usual.
    fn nodes(
        &mut self,
        is_tilted: bool,
        usual: &SuperpositionRecipe,
    ) -> Option<(usize, [usize; 2])> {
        let Some(Value::List(given)) = self.entry(NODES).and_then(|_| self.value(NODES)) else {
            return Some((usual.eccentricity_nodes, usual.tilt_nodes));
        };
        let counts: Vec<usize> = given.iter().map(|count| *count as usize).collect();
        let are_whole = given.iter().all(|count| count.fract() == 0.0);
        match counts[..] {
            [along] if are_whole && !is_tilted => Some((along, [1, 1])),
            [along, tilt, across] if are_whole && is_tilted && tilt % 2 + across % 2 == 2 => {
                Some((along, [tilt, across]))
            }
            _ => {
                let message = match is_tilted {
                    true => {
                        "tilted journals have three whole numbers of nodes, those of the tilts odd"
                    }
                    false => "aligned journals have one whole number of nodes",
                };
                let error = self.error_at(NODES, message);
                let hint = if is_tilted { "[21, 21, 15]" } else { "25" };
                self.errors
                    .push(error.hinting(format!("for example nodes = {hint}")));
                None
            }
        }
    }

    fn count(&self, path: &str) -> Option<usize> {
        match self.value(path)? {
            Value::Integer(number) => usize::try_from(number).ok(),
            _ => None,
        }
    }

    /// Smallest and largest width over diameter: as given, or that of the bearing.
    fn width_ratios(&mut self) -> Option<[f64; 2]> {
        if let Some(Value::List(given)) = self.value(RATIOS) {
            let [first, last] = [given.first(), given.last()].map(|ratio| ratio.copied());
            let (narrow, wide) = (first?, last?);
            if given.len() > 2 || narrow > wide {
                let message = format!("`{RATIOS}` is one ratio, or the smallest and the largest");
                let error = self.error_at(RATIOS, message);
                self.errors.push(error.hinting("for example [0.3, 0.5]"));
                return None;
            }
            return Some([narrow, wide]);
        }
        if self.entry("bearing").is_none() {
            let error = self.error_at("database", format!("`{RATIOS}` is missing"));
            let error = error.of_key(RATIOS).with_value("");
            self.errors
                .push(error.hinting("give it, or [bearing] with diameter and width"));
            return None;
        }
        let ratio = self.number("bearing.width")? / self.number("bearing.diameter")?;
        if !(0.05..=4.0).contains(&ratio) {
            let message =
                format!("the width over diameter of the bearing, {ratio:.3}, has no database");
            let error = self.error_at("bearing.width", message);
            self.errors.push(error.allowing("0.05 to 4"));
            return None;
        }
        Some([ratio; 2])
    }

    /// Whether a section that studies of one bearing need may be missing in this one.
    pub(super) fn may_miss(&self, path: &str) -> bool {
        self.mode == Mode::Database && path == "bearing"
    }
}
