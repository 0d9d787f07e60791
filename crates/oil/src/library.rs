//! Oils by name, read from the data files in `crates/oil/data`.
//!
//! A file holds one source: its author, year and licence, and the oils it describes, each with the
//! temperatures its data span. Nothing is kept between calls. An oil without a source does not go in;
//! what a source leaves out and a law needs is a round value that the oil's note names.

use crate::{Lubricant, OilError, TemperatureRange};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The data files of this crate: name and text.
const FILES: [(&str, &str); 4] = [
    (
        "iso3448-1992.toml",
        include_str!("../data/iso3448-1992.toml"),
    ),
    ("sander2016.toml", include_str!("../data/sander2016.toml")),
    (
        "sommerfeld2026.toml",
        include_str!("../data/sommerfeld2026.toml"),
    ),
    (
        "stachowiak2001.toml",
        include_str!("../data/stachowiak2001.toml"),
    ),
];

/// An oil of the library, and where its data come from.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NamedOil {
    /// What a study file calls it.
    pub name: String,
    /// What it is.
    pub title: String,
    /// Author, title and year of the source.
    pub source: String,
    /// Year of the source.
    pub year: u16,
    /// What allows the data to stand here.
    pub licence: String,
    /// What is assumed beyond the source; empty where nothing is.
    pub note: String,
    /// Temperatures the data span.
    pub temperatures: TemperatureRange,
    /// Its laws.
    pub lubricant: Lubricant,
}

/// A data file that cannot be read, or a name that is in none.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LibraryError {
    /// The file is no data file of oils.
    #[error("{file}: {message}")]
    File {
        /// Name of the file.
        file: String,
        /// What is wrong, with its line.
        message: String,
    },
    /// The laws of an oil describe none.
    #[error("the oil `{name}` of {file} is none: {error}")]
    Oil {
        /// Name of the file.
        file: String,
        /// Name of the oil.
        name: String,
        /// What its laws say.
        error: OilError,
    },
    /// No oil has this name.
    #[error("no oil is called `{given}`; there are {known}")]
    Unknown {
        /// What was asked for.
        given: String,
        /// Names of all oils.
        known: String,
    },
}

/// A data file: one source and its oils.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    source: String,
    year: u16,
    licence: String,
    oil: Vec<Entry>,
}

/// An oil of a data file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    title: String,
    #[serde(default)]
    note: String,
    /// Lowest and highest temperature of the data, K.
    temperatures: [f64; 2],
    lubricant: Lubricant,
}

/// Every oil of the library, in the order of the files.
///
/// # Errors
/// As [`read`].
pub fn library() -> Result<Vec<NamedOil>, LibraryError> {
    let mut oils = Vec::new();
    for (file, text) in FILES {
        oils.extend(read(file, text)?);
    }
    Ok(oils)
}

/// The oil of this name.
///
/// # Errors
/// [`LibraryError::Unknown`] with the names there are, and as [`read`].
pub fn named(name: &str) -> Result<NamedOil, LibraryError> {
    let oils = library()?;
    let known: Vec<String> = oils.iter().map(|oil| oil.name.clone()).collect();
    oils.into_iter()
        .find(|oil| oil.name == name)
        .ok_or_else(|| LibraryError::Unknown {
            given: name.to_owned(),
            known: known.join(", "),
        })
}

/// The oils of a data file; `file` is its name in messages.
///
/// # Errors
/// [`LibraryError::File`] for a text that is no data file, [`LibraryError::Oil`] for laws that
/// describe no oil.
pub fn read(file: &str, text: &str) -> Result<Vec<NamedOil>, LibraryError> {
    let content: File = toml::from_str(text).map_err(|error| LibraryError::File {
        file: file.to_owned(),
        message: error.to_string(),
    })?;
    let mut oils = Vec::new();
    for entry in content.oil {
        if let Err(error) = entry.lubricant.check() {
            return Err(LibraryError::Oil {
                file: file.to_owned(),
                name: entry.name,
                error,
            });
        }
        let [low, high] = entry.temperatures;
        oils.push(NamedOil {
            name: entry.name,
            title: entry.title,
            source: content.source.clone(),
            year: content.year,
            licence: content.licence.clone(),
            note: entry.note,
            temperatures: TemperatureRange { low, high },
            lubricant: entry.lubricant,
        });
    }
    Ok(oils)
}
