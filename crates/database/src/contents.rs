//! Arrays and attributes of one database file, and the check that they are whole.
//!
//! Every database is one HDF5 file: datasets of doubles in the root group, each with the attributes
//! `unit` and `meaning`, and attributes of the file. Whatever scheme it holds, a file carries the
//! attributes `format`, `layout`, `scheme`, `solver_version` and `check`, the FNV-1a hash (64 bit, as
//! 16 hexadecimal digits) of all the others: names and values of attributes in alphabetical order, then
//! name, shape and values of datasets in alphabetical order, numbers as little-endian bytes.
//! Files appear whole: they are written under another name and renamed.
//!
//! Reference of the hash: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, RFC 9923.

use crate::error::DatabaseError;
use hdf5_pure::{AttrValue, File, FileBuilder};
use std::collections::BTreeMap;
use std::path::Path;

/// What the attribute `format` says.
pub const FORMAT: &str = "sommerfeld-database";
/// Version of the layout that is written, and the only one that is read.
pub const LAYOUT: i64 = 1;
/// Version of the program that solves the films.
pub const SOLVER_VERSION: &str = env!("CARGO_PKG_VERSION");

/// Value of an attribute.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Text, UTF-8.
    Text(String),
    /// A whole number.
    Integer(i64),
    /// A number.
    Number(f64),
    /// Several numbers.
    Numbers(Vec<f64>),
}

/// A dataset of doubles.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// Extents, the slowest first.
    pub shape: Vec<usize>,
    /// Values, row by row.
    pub values: Vec<f64>,
    /// Unit; "1" for numbers without one.
    pub unit: String,
    /// What it holds, in one sentence.
    pub meaning: String,
}

/// Everything one file holds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Contents {
    /// Attributes of the file, besides those that every file has.
    pub attributes: BTreeMap<String, Value>,
    /// Datasets of the root group.
    pub arrays: BTreeMap<String, Array>,
}

impl Contents {
    /// Adds a dataset.
    pub fn array(
        &mut self,
        name: &str,
        unit: &str,
        meaning: &str,
        shape: &[usize],
        values: Vec<f64>,
    ) {
        let array = Array {
            shape: shape.to_vec(),
            values,
            unit: unit.to_owned(),
            meaning: meaning.to_owned(),
        };
        self.arrays.insert(name.to_owned(), array);
    }

    /// Adds an attribute.
    pub fn attribute(&mut self, name: &str, value: Value) {
        self.attributes.insert(name.to_owned(), value);
    }

    /// Writes the file of a scheme.
    ///
    /// # Errors
    /// [`DatabaseError::File`] where the file cannot be written.
    pub fn write(&self, path: &Path, scheme: &str) -> Result<(), DatabaseError> {
        let failed = |reason: String| DatabaseError::File {
            path: path.to_owned(),
            reason,
        };
        let mut whole = self.clone();
        whole.attribute("format", Value::Text(FORMAT.to_owned()));
        whole.attribute("layout", Value::Integer(LAYOUT));
        whole.attribute("scheme", Value::Text(scheme.to_owned()));
        whole.attribute("solver_version", Value::Text(SOLVER_VERSION.to_owned()));
        let check = whole.check();
        whole.attribute("check", Value::Text(check));
        let bytes = whole
            .encoded()
            .map_err(|error| failed(format!("cannot be written as HDF5: {error}")))?;
        let partial = path.with_extension("h5.partial");
        std::fs::write(&partial, bytes)
            .and_then(|()| std::fs::rename(&partial, path))
            .map_err(|error| failed(format!("cannot be written: {error}")))
    }

    /// Reads a file and checks that it is whole and of this scheme. The attributes that every file has
    /// are among those returned.
    ///
    /// # Errors
    /// [`DatabaseError::File`] where the file cannot be read, [`DatabaseError::Contents`] where it is
    /// not a database, of another layout or scheme, or damaged.
    pub fn read(path: &Path, scheme: &str) -> Result<Self, DatabaseError> {
        let bytes = std::fs::read(path).map_err(|error| DatabaseError::File {
            path: path.to_owned(),
            reason: format!("cannot be read: {error}"),
        })?;
        let wrong = |reason: String| DatabaseError::Contents {
            path: path.to_owned(),
            reason,
        };
        let mut read = Self::decoded(bytes)
            .map_err(|error| wrong(format!("not a whole HDF5 file ({error})")))?;
        let expected = [
            ("format", Value::Text(FORMAT.to_owned())),
            ("layout", Value::Integer(LAYOUT)),
            ("scheme", Value::Text(scheme.to_owned())),
        ];
        for (name, value) in expected {
            let found = read.attributes.get(name);
            if found != Some(&value) {
                return Err(wrong(format!(
                    "its attribute {name} is {}, not {value:?}",
                    found.map_or("missing".to_owned(), |found| format!("{found:?}"))
                )));
            }
        }
        let noted = read.attributes.remove("check");
        if noted != Some(Value::Text(read.check())) {
            return Err(wrong(
                "its contents are not those that were written (attribute check)".to_owned(),
            ));
        }
        Ok(read)
    }

    /// The scheme of a file, of which nothing else is checked.
    ///
    /// # Errors
    /// As [`Contents::read`].
    pub fn scheme(path: &Path) -> Result<String, DatabaseError> {
        let bytes = std::fs::read(path).map_err(|error| DatabaseError::File {
            path: path.to_owned(),
            reason: format!("cannot be read: {error}"),
        })?;
        let wrong = |reason: String| DatabaseError::Contents {
            path: path.to_owned(),
            reason,
        };
        let read = Self::decoded(bytes)
            .map_err(|error| wrong(format!("not a whole HDF5 file ({error})")))?;
        if read.attributes.get("format") != Some(&Value::Text(FORMAT.to_owned())) {
            return Err(wrong(
                "its attribute format is not that of a database".to_owned(),
            ));
        }
        read.text(path, "scheme").map(str::to_owned)
    }

    fn encoded(&self) -> Result<Vec<u8>, hdf5_pure::Error> {
        let mut builder = FileBuilder::new();
        for (name, value) in &self.attributes {
            let value = match value {
                Value::Text(text) => AttrValue::String(text.clone()),
                Value::Integer(number) => AttrValue::I64(*number),
                Value::Number(number) => AttrValue::F64(*number),
                Value::Numbers(numbers) => AttrValue::F64Array(numbers.clone()),
            };
            builder.set_attr(name, value);
        }
        for (name, array) in &self.arrays {
            let shape: Vec<u64> = array.shape.iter().map(|extent| *extent as u64).collect();
            builder
                .create_dataset(name)
                .with_f64_data(&array.values)
                .with_shape(&shape)
                .set_attr("unit", AttrValue::String(array.unit.clone()))
                .set_attr("meaning", AttrValue::String(array.meaning.clone()));
        }
        builder.finish()
    }

    fn decoded(bytes: Vec<u8>) -> Result<Self, hdf5_pure::Error> {
        let file = File::from_bytes(bytes)?;
        let root = file.root();
        let mut read = Self::default();
        for (name, value) in root.attrs()? {
            let value = match value.as_str() {
                Some(text) => Some(Value::Text(text.to_owned())),
                None => match &value {
                    AttrValue::I64(number) => Some(Value::Integer(*number)),
                    AttrValue::F64(number) => Some(Value::Number(*number)),
                    AttrValue::F64Array(numbers) => Some(Value::Numbers(numbers.clone())),
                    _ => None,
                },
            };
            if let Some(value) = value {
                read.attributes.insert(name, value);
            }
        }
        for name in root.datasets()? {
            let dataset = root.dataset(&name)?;
            let texts = dataset.attrs()?;
            let text = |key: &str| {
                let value = texts.get(key).and_then(AttrValue::as_str);
                value.unwrap_or_default().to_owned()
            };
            let array = Array {
                shape: dataset
                    .shape()?
                    .iter()
                    .map(|extent| *extent as usize)
                    .collect(),
                values: dataset.read_f64()?,
                unit: text("unit"),
                meaning: text("meaning"),
            };
            read.arrays.insert(name, array);
        }
        Ok(read)
    }

    fn check(&self) -> String {
        let mut hash = Fnv::default();
        for (name, value) in &self.attributes {
            hash.text(name);
            match value {
                Value::Text(text) => hash.text(text),
                Value::Integer(number) => hash.bytes(&number.to_le_bytes()),
                Value::Number(number) => hash.numbers(&[*number]),
                Value::Numbers(numbers) => hash.numbers(numbers),
            }
        }
        for (name, array) in &self.arrays {
            hash.text(name);
            for extent in &array.shape {
                hash.bytes(&(*extent as u64).to_le_bytes());
            }
            hash.numbers(&array.values);
        }
        format!("{:016x}", hash.state)
    }

    /// A dataset of these extents.
    ///
    /// # Errors
    /// [`DatabaseError::Contents`] where it is missing or of other extents.
    pub fn values(
        &self,
        path: &Path,
        name: &str,
        shape: &[usize],
    ) -> Result<&[f64], DatabaseError> {
        let wrong = |reason: String| DatabaseError::Contents {
            path: path.to_owned(),
            reason,
        };
        let array = self
            .arrays
            .get(name)
            .ok_or_else(|| wrong(format!("its dataset {name} is missing")))?;
        let size: usize = shape.iter().product();
        if array.shape != shape || array.values.len() != size {
            return Err(wrong(format!(
                "its dataset {name} has the extents {:?} instead of {shape:?}",
                array.shape
            )));
        }
        Ok(&array.values)
    }

    /// An attribute that is a number.
    ///
    /// # Errors
    /// [`DatabaseError::Contents`] where it is missing or something else.
    pub fn number(&self, path: &Path, name: &str) -> Result<f64, DatabaseError> {
        match self.attributes.get(name) {
            Some(Value::Number(number)) => Ok(*number),
            Some(Value::Integer(number)) => Ok(*number as f64),
            other => Err(DatabaseError::Contents {
                path: path.to_owned(),
                reason: format!("its attribute {name} is {other:?} instead of a number"),
            }),
        }
    }

    /// An attribute that is a whole number.
    ///
    /// # Errors
    /// [`DatabaseError::Contents`] where it is missing or something else.
    pub fn integer(&self, path: &Path, name: &str) -> Result<i64, DatabaseError> {
        match self.attributes.get(name) {
            Some(Value::Integer(number)) => Ok(*number),
            other => Err(DatabaseError::Contents {
                path: path.to_owned(),
                reason: format!("its attribute {name} is {other:?} instead of a whole number"),
            }),
        }
    }

    /// An attribute that is text.
    ///
    /// # Errors
    /// [`DatabaseError::Contents`] where it is missing or something else.
    pub fn text(&self, path: &Path, name: &str) -> Result<&str, DatabaseError> {
        match self.attributes.get(name) {
            Some(Value::Text(text)) => Ok(text),
            other => Err(DatabaseError::Contents {
                path: path.to_owned(),
                reason: format!("its attribute {name} is {other:?} instead of text"),
            }),
        }
    }
}

/// FNV-1a, 64 bit.
struct Fnv {
    state: u64,
}

impl Default for Fnv {
    fn default() -> Self {
        Self {
            state: 0xcbf2_9ce4_8422_2325,
        }
    }
}

impl Fnv {
    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.state = (self.state ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Text with its length, so that neighbours do not run together.
    fn text(&mut self, text: &str) {
        self.bytes(&(text.len() as u64).to_le_bytes());
        self.bytes(text.as_bytes());
    }

    fn numbers(&mut self, numbers: &[f64]) {
        self.bytes(&(numbers.len() as u64).to_le_bytes());
        for number in numbers {
            self.bytes(&number.to_le_bytes());
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn example() -> Contents {
        let mut contents = Contents::default();
        contents.attribute("target", Value::Number(1e-3));
        contents.attribute("samples", Value::Integer(400));
        contents.attribute("ends", Value::Numbers(vec![0.0, 0.999]));
        contents.attribute("closure", Value::Text("reynolds".to_owned()));
        contents.array(
            "force",
            "1",
            "Force",
            &[2, 3],
            vec![1.0, 2.0, 3.0, 4.0, 5.0, f64::NAN],
        );
        contents
    }

    #[test]
    fn what_is_written_is_read() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("table.h5");
        example().write(&path, "combined").unwrap();
        let read = Contents::read(&path, "combined").unwrap();
        assert_eq!(read.number(&path, "target").unwrap(), 1e-3);
        assert_eq!(read.text(&path, "closure").unwrap(), "reynolds");
        assert_eq!(read.text(&path, "scheme").unwrap(), "combined");
        let force = read.values(&path, "force", &[2, 3]).unwrap();
        assert_eq!(force[..5], [1.0, 2.0, 3.0, 4.0, 5.0]);
        assert!(force[5].is_nan());
        assert!(read.values(&path, "force", &[3, 2]).is_err());
        assert_eq!(read.attributes["ends"], Value::Numbers(vec![0.0, 0.999]));
        let error = Contents::read(&path, "superposition")
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("scheme") && error.contains("build it again"),
            "{error}"
        );
        // Nothing else is left in the directory.
        assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_damaged_file_is_named_whichever_byte_is_hit() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("table.h5");
        example().write(&path, "combined").unwrap();
        let whole = std::fs::read(&path).unwrap();
        let read = Contents::read(&path, "combined").unwrap();
        let mut refused = 0;
        for at in (0..whole.len()).step_by(5) {
            let mut bytes = whole.clone();
            bytes[at] ^= 0x10;
            std::fs::write(&path, &bytes).unwrap();
            match Contents::read(&path, "combined") {
                Ok(other) => {
                    // Padding, or words about a dataset: what is looked up is what was written.
                    assert_eq!(other.attributes, read.attributes, "byte {at}");
                    let force = |c: &Contents| c.arrays["force"].values[..5].to_vec();
                    assert_eq!(force(&other), force(&read), "byte {at}");
                }
                Err(error) => {
                    refused += 1;
                    assert!(
                        error.to_string().contains("build it again"),
                        "byte {at}: {error}"
                    );
                }
            }
        }
        assert!(refused > whole.len() / 20, "{refused} of {}", whole.len());
        for length in [0, 7, 100, whole.len() / 2, whole.len() - 1] {
            std::fs::write(&path, &whole[..length]).unwrap();
            assert!(Contents::read(&path, "combined").is_err(), "{length} bytes");
        }
        assert!(Contents::read(&directory.path().join("none.h5"), "combined").is_err());
    }
}
