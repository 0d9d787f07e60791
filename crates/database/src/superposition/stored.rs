//! The database as a file: the paper's names for its integrals, everything it was built from, its error.

use super::build::{FIGURES, place_of};
use super::grid::Shape;
use super::{Accuracy, Drive, SuperpositionRecipe, SuperpositionTable, centre};
use crate::contents::{Contents, Value};
use crate::error::DatabaseError;
use sommerfeld_film::{Cavitation, Inlet};
use std::path::{Path, PathBuf};

const SCHEME: &str = "superposition";
const PARTIAL: &str = "superposition-partial";

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

/// Films near the centre.
const CENTRE: &str = "centre_D";

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
        let axes = [
            ("eccentricity", "Relative eccentricity"),
            (
                "tilt_share",
                "Share of the largest tilt in the plane of the narrowest gap",
            ),
            ("transverse_share", "Share of the largest transverse tilt"),
        ];
        for ((name, meaning), axis) in axes.into_iter().zip(&self.axes) {
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
        let meaning = "samples, then errors over force and moment: largest, of 99.9 %, median of the \
                       samples, largest of the nodes";
        contents.attribute("accuracy_meaning", Value::Text(meaning.to_owned()));
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
        let shape = Shape::of(&recipe.axes()?);
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
            accuracy[drive as usize] = Accuracy {
                samples: samples as usize,
                largest,
                of_999,
                median,
                node_error,
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
        Self::of(recipe, nodes, centre, accuracy)
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

    /// Films by task, not a number where one is still to be solved. A file of another recipe, or one that
    /// cannot be read, is of no use and no harm.
    pub(super) fn read(&self, tasks: usize) -> Vec<[f64; FIGURES]> {
        let nothing = vec![[f64::NAN; FIGURES]; tasks];
        let Some(path) = &self.path else {
            return nothing;
        };
        let Ok(contents) = Contents::read(path, PARTIAL) else {
            return nothing;
        };
        if recipe_of(&contents, path).ok() != Some(self.recipe) {
            return nothing;
        }
        match contents.values(path, "solved", &[tasks, FIGURES]) {
            Ok(values) => (values.chunks_exact(FIGURES))
                .map(|figures| std::array::from_fn(|k| figures[k]))
                .collect(),
            Err(_) => nothing,
        }
    }

    /// Keeps what is solved, now and then, or where it `must`.
    pub(super) fn write(
        &mut self,
        solved: &[[f64; FIGURES]],
        must: bool,
    ) -> Result<(), DatabaseError> {
        let Some(path) = &self.path else {
            return Ok(());
        };
        let count = solved.iter().filter(|figures| !figures[0].is_nan()).count();
        if !must && count < self.written + FILMS_PER_WRITE {
            return Ok(());
        }
        let mut contents = Contents::default();
        note_recipe(&self.recipe, &mut contents);
        let values = solved.iter().flatten().copied().collect();
        contents.array(
            "solved",
            "1",
            "Films by task",
            &[solved.len(), FIGURES],
            values,
        );
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
