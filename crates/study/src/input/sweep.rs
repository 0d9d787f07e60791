//! The plan of a sweep: a base study, the keys it varies, and the text of each case.
//!
//! A case is the text of the base study with the varied values written into it; it goes through the
//! ordinary reader and checker like a study of its own.

use super::check;
use super::error::InputErrors;
use super::study::Study;
use std::path::PathBuf;
use toml_edit::{Array, DocumentMut, Item, Table, TableLike, Value};

/// A sweep: every case was checked when the study was read.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepPlan {
    /// File of the base study, for messages.
    pub base_file: String,
    /// Its text.
    pub base_text: String,
    /// Directory that holds the files that the base study names.
    pub directory: PathBuf,
    /// How the varied keys combine.
    pub mode: SweepMode,
    /// What each case leaves behind.
    pub keep: Keep,
    /// The varied keys, in the order of the file; of a grid the last one varies fastest.
    pub varied: Vec<VariedKey>,
    /// Input hash of each case, in the order of the cases: there are as many cases as hashes.
    pub hashes: Vec<String>,
}

/// How the varied keys of a sweep combine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepMode {
    /// Every value with every other.
    Grid,
    /// First with first, second with second.
    Zip,
}

impl SweepMode {
    /// As in the study file.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::Zip => "zip",
        }
    }
}

/// What each case of a sweep leaves behind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keep {
    /// Its summary.
    Summary,
    /// A full directory of results.
    All,
}

impl Keep {
    /// As in the study file.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Summary => "summary",
            Self::All => "all",
        }
    }
}

/// A varied key with its values.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedKey {
    /// The key as the user wrote it, such as `bearing.groove[0].pressure`.
    pub path: String,
    /// The way to it through the tables of the base study.
    pub steps: Vec<KeyStep>,
    /// Unit of the numbers: the one all values are written in, or else SI; `-` for bare numbers,
    /// empty where the values are not numbers.
    pub unit: String,
    /// Its values.
    pub values: Vec<VariedValue>,
}

/// One name on the way to a key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyStep {
    /// The name.
    pub name: String,
    /// Which element of the list of this name, from 0.
    pub index: Option<usize>,
}

/// One value of a varied key.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedValue {
    /// As it is written in TOML.
    pub toml: String,
    /// As it is shown: text without its quotes.
    pub shown: String,
    /// The number in the unit of its key, if it is one.
    pub number: Option<f64>,
}

/// The way to a key from its path; `None` where the path cannot be read.
pub(super) fn steps_of(path: &str) -> Option<Vec<KeyStep>> {
    path.split('.')
        .map(|part| {
            let (name, index) = match part.split_once('[') {
                Some((name, rest)) => (name, Some(rest.strip_suffix(']')?.parse().ok()?)),
                None => (part, None),
            };
            (!name.is_empty()).then(|| KeyStep {
                name: name.to_owned(),
                index,
            })
        })
        .collect()
}

impl SweepPlan {
    /// Number of cases; case numbers run from 1 to it.
    #[must_use]
    pub fn count(&self) -> usize {
        self.hashes.len()
    }

    /// Which value of each varied key a case takes. `index` runs from 0.
    #[must_use]
    pub fn positions(&self, index: usize) -> Vec<usize> {
        let mut rest = index;
        let mut positions = vec![index; self.varied.len()];
        if self.mode == SweepMode::Grid {
            // The last key varies fastest.
            for (position, key) in positions.iter_mut().zip(&self.varied).rev() {
                *position = rest % key.values.len().max(1);
                rest /= key.values.len().max(1);
            }
        }
        positions
    }

    /// The values of a case, one for each varied key. `index` runs from 0.
    #[must_use]
    pub fn values(&self, index: usize) -> Vec<&VariedValue> {
        let pairs = self.varied.iter().zip(self.positions(index));
        pairs.filter_map(|(key, at)| key.values.get(at)).collect()
    }

    /// Whether a varied key tells the cases apart: it takes more than one value, or none does.
    #[must_use]
    pub fn tells_apart(&self, key: &VariedKey) -> bool {
        key.values.len() > 1 || self.count() <= 1
    }

    /// What tells a case from the others, in words: `bearing.width = 30 mm, operation.speed = 900 rpm`.
    #[must_use]
    pub fn describe(&self, index: usize) -> String {
        let pairs = self.varied.iter().zip(self.values(index));
        pairs
            .filter(|(key, _)| self.tells_apart(key))
            .map(|(key, value)| format!("{} = {}", key.path, value.shown))
            .collect::<Vec<_>>()
            .join(", ")
    }

    /// The text of a case: that of the base study with the values of the case written into it.
    ///
    /// # Errors
    /// Which key has no place in the base study, and why.
    pub fn case_text(&self, index: usize) -> Result<String, (String, String)> {
        let mut document: DocumentMut = self.base_text.parse().map_err(|error| {
            let why: toml_edit::TomlError = error;
            (String::new(), why.to_string())
        })?;
        for (key, value) in self.varied.iter().zip(self.values(index)) {
            let read: Value = value.toml.parse().map_err(|error| {
                let why: toml_edit::TomlError = error;
                (key.path.clone(), why.to_string())
            })?;
            set(document.as_table_mut(), &key.steps, read)
                .map_err(|why| (key.path.clone(), why))?;
        }
        Ok(document.to_string())
    }

    /// The checked study of a case.
    ///
    /// # Errors
    /// What is wrong with it. A plan holds only cases that were right when it was made: an error
    /// means that a file has changed since.
    pub fn study(&self, index: usize) -> Result<Study, InputErrors> {
        let text = self
            .case_text(index)
            .map_err(|(_, why)| InputErrors::from(super::InputError::new(&self.base_file, why)))?;
        self.study_of(&text)
    }

    /// The study of the text of a case.
    pub(super) fn study_of(&self, text: &str) -> Result<Study, InputErrors> {
        check::study(&self.base_file, text, &self.directory)
    }
}

/// Writes a value to its place, making the sections on the way where they are missing.
fn set(root: &mut dyn TableLike, steps: &[KeyStep], value: Value) -> Result<(), String> {
    let Some((last, way)) = steps.split_last() else {
        return Err("the key is empty".into());
    };
    let mut table = root;
    let mut walked = String::new();
    for step in way {
        walked = if walked.is_empty() {
            step.name.clone()
        } else {
            format!("{walked}.{}", step.name)
        };
        table = descend(table, step, &walked)?;
    }
    match last.index {
        None => put(table, &last.name, value),
        Some(index) => {
            let path = &last.name;
            let item = table.get_mut(path).ok_or_else(|| {
                format!("the base study has no `{path}` whose element could be set")
            })?;
            match item {
                Item::Value(Value::Array(list)) if index < list.len() => {
                    put_element(list, index, value)
                }
                _ => {
                    return Err(format!(
                        "`{path}` has no element [{index}] in the base study"
                    ));
                }
            }
        }
    }
    Ok(())
}

/// The table of a step, made where it is missing.
fn descend<'t>(
    table: &'t mut dyn TableLike,
    step: &KeyStep,
    walked: &str,
) -> Result<&'t mut dyn TableLike, String> {
    if table.get(&step.name).is_none() {
        if step.index.is_some() {
            return Err(format!("the base study has no [[{walked}]]"));
        }
        table.insert(&step.name, Item::Table(Table::new()));
    }
    let Some(item) = table.get_mut(&step.name) else {
        return Err(format!("`{walked}` cannot be made"));
    };
    let Some(index) = step.index else {
        return item
            .as_table_like_mut()
            .ok_or_else(|| format!("`{walked}` is a single value in the base study, not a table"));
    };
    let count = match item {
        Item::ArrayOfTables(list) => list.len(),
        Item::Value(Value::Array(list)) => list.len(),
        _ => 0,
    };
    let element: Option<&mut dyn TableLike> = match item {
        Item::ArrayOfTables(list) => list.get_mut(index).map(|table| table as &mut dyn TableLike),
        Item::Value(Value::Array(list)) => list
            .get_mut(index)
            .and_then(Value::as_inline_table_mut)
            .map(|table| table as &mut dyn TableLike),
        _ => None,
    };
    element.ok_or_else(|| {
        format!("the base study has {count} [[{walked}]], counted from [0]: there is no [{index}]")
    })
}

/// Sets a value; the comments around an old one stay.
fn put(table: &mut dyn TableLike, name: &str, mut value: Value) {
    match table.get_mut(name) {
        Some(Item::Value(old)) => {
            *value.decor_mut() = old.decor().clone();
            *old = value;
        }
        Some(other) => *other = Item::Value(value),
        None => {
            table.insert(name, Item::Value(value));
        }
    }
}

fn put_element(list: &mut Array, index: usize, mut value: Value) {
    if let Some(old) = list.get_mut(index) {
        *value.decor_mut() = old.decor().clone();
        *old = value;
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    fn edited(base: &str, path: &str, value: &str) -> Result<String, String> {
        let mut document: DocumentMut = base.parse().unwrap();
        let steps = steps_of(path).unwrap();
        set(document.as_table_mut(), &steps, value.parse().unwrap())?;
        Ok(document.to_string())
    }

    #[test]
    fn values_and_elements_are_replaced_where_they_stand() {
        let base = "# head\n[a]\nb = \"1 mm\"  # why\n[[a.c]]\nd = 1\n[[a.c]]\nd = 2\n";
        assert_eq!(
            edited(base, "a.b", "\"2 mm\"").unwrap(),
            base.replace("1 mm", "2 mm")
        );
        assert_eq!(
            edited(base, "a.c[1].d", "7").unwrap(),
            base.replace("d = 2", "d = 7")
        );
        assert_eq!(edited("p = [1, 2]\n", "p[1]", "9").unwrap(), "p = [1, 9]\n");
        assert!(
            edited(base, "a.c[2].d", "7")
                .unwrap_err()
                .contains("has 2 [[a.c]]")
        );
        assert!(
            edited(base, "a.b.e", "7")
                .unwrap_err()
                .contains("a single value")
        );
    }

    #[test]
    fn missing_sections_and_laws_are_made() {
        let text = edited("x = 1\n", "film.grid", "[8, 4]").unwrap();
        let table: toml::Table = text.parse().unwrap();
        assert_eq!(table["film"]["grid"].as_array().unwrap().len(), 2);
        let text = edited(
            "[oil]\nviscosity = \"1 Pa.s\"\n[b]\nc = 1\n",
            "oil.viscosity",
            "{ law = \"vogel\" }",
        );
        let table: toml::Table = text.unwrap().parse().unwrap();
        assert_eq!(table["oil"]["viscosity"]["law"].as_str(), Some("vogel"));
        assert_eq!(table["b"]["c"].as_integer(), Some(1));
    }
}
