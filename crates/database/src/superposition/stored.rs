//! The database as a file: the paper's names for its integrals, everything it was built from, its error.

use super::build::{FIGURES, place_of};
use super::grid::Shape;
use super::{Accuracy, Drive, SuperpositionRecipe, SuperpositionTable, centre};
use crate::contents::{Contents, Value};
use crate::error::DatabaseError;
use sommerfeld_film::{Cavitation, Inlet, Outcome};
use std::path::{Path, PathBuf};

const SCHEME: &str = "superposition";
const PARTIAL: &str = "superposition-partial-2";

/// Names of the figures of a node before the letter of the drive, and what they are.
const NAMES: [(&str, &str); FIGURES] = [
    (
        "Phi_1",
        "Integral of Pi cos(phi) over phi from the widest gap and Z = 2z/B",
    ),
    ("Phi_2", "Integral of Pi sin(phi)"),
    ("Theta_1", "Integral of Pi Z cos(phi)"),
    ("Theta_2", "Integral of Pi Z sin(phi)"),
    ("peak_", "Largest Pi"),
    (
        "node_error_",
        "Estimated error of the integrals before they are extrapolated, over force and moment",
    ),
];

/// Names of the axes, and what they are.
const AXES: [(&str, &str); 3] = [
    ("eccentricity", "Relative eccentricity"),
    (
        "tilt_share",
        "Share of the largest tilt in the plane of the narrowest gap",
    ),
    ("transverse_share", "Share of the largest transverse tilt"),
];

/// Difference of two nodes that is of no account.
const SAME: f64 = 1e-9;

/// Films near the centre.
const CENTRE: &str = "centre_D";

/// Nodes and cells that were asked for, of an unfinished file.
const ASKED: &str = "asked_nodes_and_cells";

/// Files are rewritten after so many films at the least.
const FILMS_PER_WRITE: usize = 256;

impl SuperpositionTable {
    /// Writes the database.
    ///
    /// # Errors
    /// [`DatabaseError::File`] where the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), DatabaseError> {
        let mut contents = Contents::default();
        note_recipe(&self.recipe, &mut contents);
        let shape = Shape::of(&self.axes);
        for ((name, meaning), axis) in AXES.into_iter().zip(&self.axes) {
            contents.array(name, "1", meaning, &[axis.count()], axis.values());
        }
        let places = (0..shape.nodes()).map(|index| place_of(&self.axes, shape.place(index)));
        let (gamma, delta) = places
            .map(|(eps, [along, across])| (along / (1.0 - eps), across))
            .unzip();
        let meaning = "Tilt in the plane of the narrowest gap over its largest value";
        contents.array("gamma", "1", meaning, &shape.counts, gamma);
        let meaning = "Tilt across that plane, as it stands in the gap";
        contents.array("delta", "1", meaning, &shape.counts, delta);
        for (drive, nodes) in Drive::ALL.into_iter().zip(&self.nodes) {
            for (k, (name, meaning)) in NAMES.into_iter().enumerate() {
                let name = format!("{name}{}", drive.letter());
                let values = nodes.iter().map(|node| node[k]).collect();
                contents.array(&name, "1", meaning, &shape.counts, values);
            }
            let a = self.accuracy[drive as usize];
            let numbers = vec![
                a.samples as f64,
                a.largest,
                a.of_999,
                a.median,
                a.node_error,
            ];
            let name = format!("accuracy_{}", drive.letter());
            contents.attribute(&name, Value::Numbers(numbers));
            let name = format!("worst_{}", drive.letter());
            contents.attribute(&name, Value::Numbers(a.worst.to_vec()));
        }
        let states = centre::states(&self.recipe);
        let lines = states
            .iter()
            .zip(&self.centre)
            .flat_map(|((eps, [along, across]), node)| {
                [*eps, along / (1.0 - eps), *across]
                    .into_iter()
                    .chain(*node)
            });
        let meaning = "Films of the wedge near the centre: eccentricity, gamma, delta, then the figures of a \
                       node in their order";
        let extents = [states.len(), 3 + FIGURES];
        if !states.is_empty() {
            contents.array(CENTRE, "1", meaning, &extents, lines.collect());
        }
        for (name, meaning) in [
            (
                "accuracy_meaning",
                "samples, then errors over force and moment: largest, of 99.9 %, median of the samples, \
                 largest of the nodes before they are extrapolated",
            ),
            (
                "worst_meaning",
                "eccentricity, tilt along and tilt across, as they stand in the gap, of the sample that errs most",
            ),
            (
                "status",
                match self.outcome() {
                    Outcome::Converged => "converged: all samples err by no more than the target",
                    _ => "not-converged: a sample errs by more than the target",
                },
            ),
        ] {
            contents.attribute(name, Value::Text(meaning.to_owned()));
        }
        contents.write(path, SCHEME)
    }

    /// Reads a database.
    ///
    /// # Errors
    /// [`DatabaseError::File`] where the file cannot be read, [`DatabaseError::Contents`] where it is not
    /// such a database or damaged.
    pub fn read(path: &Path) -> Result<Self, DatabaseError> {
        let contents = Contents::read(path, SCHEME)?;
        let recipe = recipe_of(&contents, path)?;
        let axes = recipe.axes()?;
        let shape = Shape::of(&axes);
        for (name, axis) in AXES.iter().map(|(name, _)| *name).zip(&axes) {
            let stored = contents.values(path, name, &[axis.count()])?;
            let mut pairs = stored.iter().zip(axis.values());
            if !pairs.all(|(stored, own)| (stored - own).abs() < SAME) {
                return Err(moved(path, name));
            }
        }
        let mut nodes: [Vec<[f64; FIGURES]>; 3] = Default::default();
        let mut accuracy = [Accuracy::default(); 3];
        for (own, drive) in nodes.iter_mut().zip(Drive::ALL) {
            own.resize(shape.nodes(), [0.0; FIGURES]);
            for (k, (name, _)) in NAMES.into_iter().enumerate() {
                let name = format!("{name}{}", drive.letter());
                let values = contents.values(path, &name, &shape.counts)?;
                for (node, value) in own.iter_mut().zip(values) {
                    node[k] = *value;
                }
            }
            let name = format!("accuracy_{}", drive.letter());
            let [samples, largest, of_999, median, node_error] = numbers(&contents, path, &name)?;
            let worst = numbers(&contents, path, &format!("worst_{}", drive.letter()))?;
            accuracy[drive as usize] = Accuracy {
                samples: samples as usize,
                largest,
                of_999,
                median,
                node_error,
                worst,
            };
        }
        let extents = [centre::states(&recipe).len(), 3 + FIGURES];
        let lines: &[f64] = if extents[0] == 0 {
            &[]
        } else {
            contents.values(path, CENTRE, &extents)?
        };
        let centre = (lines.chunks_exact(extents[1]))
            .map(|line| std::array::from_fn(|k| line[3 + k]))
            .collect();
        let at = centre::states(&recipe).into_iter();
        let mut pairs = (lines.chunks_exact(extents[1])).zip(at);
        if !pairs.all(|(line, (eps, [_, across]))| {
            (line[0] - eps).abs().max((line[2] - across).abs()) < SAME
        }) {
            return Err(moved(path, CENTRE));
        }
        Self::of(recipe, nodes, centre, accuracy)
    }
}

/// A database whose nodes stand elsewhere than this version puts them.
fn moved(path: &Path, name: &str) -> DatabaseError {
    DatabaseError::Contents {
        path: path.to_owned(),
        reason: format!("its nodes ({name}) are those of another version"),
    }
}

fn note_recipe(recipe: &SuperpositionRecipe, contents: &mut Contents) {
    let count = |count: usize| Value::Integer(count as i64);
    let pair = |pair: [usize; 2]| Value::Numbers(pair.map(|count| count as f64).to_vec());
    let text = |text: &str| Value::Text(text.to_owned());
    for (name, value) in [
        ("d_over_b", Value::Number(recipe.d_over_b)),
        (
            "eccentricities",
            Value::Numbers(recipe.eccentricities.to_vec()),
        ),
        ("eccentricity_nodes", count(recipe.eccentricity_nodes)),
        (
            "largest_shares",
            Value::Numbers(recipe.largest_shares.to_vec()),
        ),
        ("tilt_nodes", pair(recipe.tilt_nodes)),
        ("centre_nodes", pair(recipe.centre_nodes)),
        (
            "cavitation",
            text(match recipe.cavitation {
                Cavitation::Gumbel => "gumbel",
                Cavitation::Reynolds => "reynolds",
                Cavitation::MassConserving => "mass-conserving",
            }),
        ),
        (
            "wedge_inlet",
            text(match recipe.wedge_inlet {
                Inlet::Cyclic => "cyclic",
                Inlet::MaxFilmLine { .. } => "max-film-line",
            }),
        ),
        ("grid", pair(recipe.grid)),
        ("smallest_gap", Value::Number(recipe.smallest_gap)),
        (
            "smallest_eccentricity",
            Value::Number(recipe.smallest_eccentricity),
        ),
        ("samples", count(recipe.samples)),
        ("seed", Value::Integer(recipe.seed as i64)),
        ("target", Value::Number(recipe.target)),
        ("most_films", count(recipe.most_films)),
        ("tilt_rates", text("neglected")),
    ] {
        contents.attribute(name, value);
    }
}

fn recipe_of(contents: &Contents, path: &Path) -> Result<SuperpositionRecipe, DatabaseError> {
    let number = |name| contents.number(path, name);
    let pair = |name| numbers::<2>(contents, path, name);
    let counts = |name| Ok::<_, DatabaseError>(pair(name)?.map(|count| count as usize));
    let word = |name, words: &[&str]| {
        let text = contents.text(path, name)?;
        let found = words.iter().position(|word| *word == text);
        found.ok_or_else(|| DatabaseError::Contents {
            path: path.to_owned(),
            reason: format!("its attribute {name} is {text}"),
        })
    };
    let closures = [Cavitation::Gumbel, Cavitation::Reynolds];
    let inlets = [Inlet::Cyclic, Inlet::MaxFilmLine { pressure: 0.0 }];
    Ok(SuperpositionRecipe {
        d_over_b: number("d_over_b")?,
        eccentricities: pair("eccentricities")?,
        eccentricity_nodes: number("eccentricity_nodes")? as usize,
        largest_shares: pair("largest_shares")?,
        tilt_nodes: counts("tilt_nodes")?,
        centre_nodes: counts("centre_nodes")?,
        cavitation: closures[word("cavitation", &["gumbel", "reynolds"])?],
        wedge_inlet: inlets[word("wedge_inlet", &["cyclic", "max-film-line"])?],
        grid: counts("grid")?,
        smallest_gap: number("smallest_gap")?,
        smallest_eccentricity: number("smallest_eccentricity")?,
        samples: number("samples")? as usize,
        seed: contents.integer(path, "seed")? as u64,
        target: number("target")?,
        most_films: number("most_films")? as usize,
    })
}

/// An attribute of `N` numbers.
fn numbers<const N: usize>(
    contents: &Contents,
    path: &Path,
    name: &str,
) -> Result<[f64; N], DatabaseError> {
    let found = match contents.attributes.get(name) {
        Some(Value::Numbers(numbers)) => <[f64; N]>::try_from(numbers.as_slice()).ok(),
        _ => None,
    };
    found.ok_or_else(|| DatabaseError::Contents {
        path: path.to_owned(),
        reason: format!("its attribute {name} is not {N} numbers"),
    })
}

/// What is known of a recipe: not a number where a film is still to be solved.
#[derive(Debug, Clone, Default)]
pub(super) struct Solved {
    /// Figures by task.
    pub films: Vec<[f64; FIGURES]>,
    /// Errors by random state.
    pub errors: Vec<f64>,
}

impl Solved {
    /// Nothing is known where the numbers are others.
    pub(super) fn fit(&mut self, films: usize, errors: usize) {
        if self.films.len() != films {
            self.films = vec![[f64::NAN; FIGURES]; films];
            self.errors.clear();
        }
        if self.errors.len() != errors {
            self.errors = vec![f64::NAN; errors];
        }
    }

    fn count(&self) -> usize {
        let films = self.films.iter().filter(|figures| !figures[0].is_nan());
        films.count() + self.errors.iter().filter(|error| !error.is_nan()).count()
    }
}

/// What an interrupted generation has solved, in a file beside the one that it is to be.
pub(super) struct Kept {
    path: Option<PathBuf>,
    recipe: SuperpositionRecipe,
    /// Films in the file.
    written: usize,
}

impl Kept {
    pub(super) fn beside(path: Option<&Path>, recipe: &SuperpositionRecipe) -> Self {
        Self {
            path: path.map(|path| path.with_extension("unfinished.h5")),
            recipe: *recipe,
            written: 0,
        }
    }

    /// The recipe that was being solved, with more nodes or cells than the one that was asked for, and what is
    /// known of it. A file of another recipe, or one that cannot be read, is of no use and no harm.
    pub(super) fn read(&self) -> (SuperpositionRecipe, Solved) {
        self.found().unwrap_or((self.recipe, Solved::default()))
    }

    fn found(&self) -> Option<(SuperpositionRecipe, Solved)> {
        let path = self.path.as_ref()?;
        let contents = Contents::read(path, PARTIAL).ok()?;
        let level = recipe_of(&contents, path).ok()?;
        let asked: [f64; 7] = numbers(&contents, path, ASKED).ok()?;
        let [e, u, d, shells, degree, n, m] = asked.map(|count| count as usize);
        let first = SuperpositionRecipe {
            eccentricity_nodes: e,
            tilt_nodes: [u, d],
            centre_nodes: [shells, degree],
            grid: [n, m],
            ..level
        };
        if first != self.recipe {
            return None;
        }
        let films = contents.arrays.get("solved")?;
        let errors = contents.arrays.get("measured");
        let solved = Solved {
            films: (films.values.chunks_exact(FIGURES))
                .map(|figures| std::array::from_fn(|k| figures[k]))
                .collect(),
            errors: errors
                .map(|errors| errors.values.clone())
                .unwrap_or_default(),
        };
        Some((level, solved))
    }

    /// Keeps what is solved of a recipe, now and then, or where it `must`.
    pub(super) fn write(
        &mut self,
        level: &SuperpositionRecipe,
        solved: &Solved,
        must: bool,
    ) -> Result<(), DatabaseError> {
        let Some(path) = &self.path else {
            return Ok(());
        };
        let count = solved.count();
        // Fewer than were written are those of finer nodes or cells.
        if !must && count >= self.written && count < self.written + FILMS_PER_WRITE {
            return Ok(());
        }
        let mut contents = Contents::default();
        note_recipe(level, &mut contents);
        let first = &self.recipe;
        let [u, d] = first.tilt_nodes;
        let [shells, degree] = first.centre_nodes;
        let asked = [
            first.eccentricity_nodes,
            u,
            d,
            shells,
            degree,
            first.grid[0],
            first.grid[1],
        ];
        contents.attribute(
            ASKED,
            Value::Numbers(asked.map(|count| count as f64).to_vec()),
        );
        let films = solved.films.iter().flatten().copied().collect();
        let extents = [solved.films.len(), FIGURES];
        contents.array("solved", "1", "Films by task", &extents, films);
        let extents = [solved.errors.len()];
        let meaning = "Errors of random states";
        if !solved.errors.is_empty() {
            contents.array("measured", "1", meaning, &extents, solved.errors.clone());
        }
        self.written = count;
        contents.write(path, PARTIAL)
    }

    /// The database is whole: what was kept is in it.
    pub(super) fn remove(&self) {
        if let Some(path) = &self.path {
            // It may never have been written.
            let _ = std::fs::remove_file(path);
        }
    }
}
