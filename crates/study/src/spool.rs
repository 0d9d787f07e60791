//! The fields of every crank angle, on the disk while the orbit runs.
//!
//! Only its end tells which cycle was the last, so each cycle writes over the one before. The memory
//! holds one instant, whatever the number of crank angles. Values are single precision, 7 digits: a
//! film on a grid is not known better.

use crate::results::FieldSnapshot;
use sommerfeld_film::FilmField;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// One of the fields of a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Gauge pressure, Pa.
    Pressure,
    /// Film fraction.
    FilmFraction,
    /// Film thickness, m.
    FilmThickness,
    /// Contact pressure of asperities, Pa.
    ContactPressure,
    /// Temperature, K.
    Temperature,
}

impl Quantity {
    /// All of them, in the order in which they are stored. The first three every film has.
    pub const ALL: [Self; 5] = [
        Self::Pressure,
        Self::FilmFraction,
        Self::FilmThickness,
        Self::ContactPressure,
        Self::Temperature,
    ];

    /// Its field in a film; empty where that has none.
    #[must_use]
    pub fn of(self, field: &FieldSnapshot) -> &[f64] {
        match self {
            Self::Pressure => &field.pressure,
            Self::FilmFraction => &field.film_fraction,
            Self::FilmThickness => &field.film_thickness,
            Self::ContactPressure => &field.contact_pressure,
            Self::Temperature => &field.temperature,
        }
    }

    /// The quantities that a film has.
    pub fn among(field: &FieldSnapshot) -> impl Iterator<Item = Self> {
        Self::ALL
            .into_iter()
            .filter(|one| !one.of(field).is_empty())
    }

    fn in_view<'f>(self, field: &FilmField<'f>) -> &'f [f64] {
        match self {
            Self::Pressure => field.pressure,
            Self::FilmFraction => field.film_fraction,
            Self::FilmThickness => field.film_thickness,
            Self::ContactPressure => field.contact_pressure,
            Self::Temperature => field.temperature,
        }
    }
}

/// Fields over one cycle in a file that nobody sees and that goes when this goes.
#[derive(Debug)]
pub struct FieldSpool {
    file: File,
    /// Where the file is still there to be removed: systems that keep open files in place.
    left: Option<PathBuf>,
    angles: Vec<f64>,
    axial: Vec<f64>,
    crank_angles: Vec<f64>,
    /// What is stored of each instant: what the film has at the first one.
    quantities: Vec<Quantity>,
    failure: Option<io::Error>,
}

impl FieldSpool {
    /// An empty one with its file in `directory`.
    ///
    /// # Errors
    /// What the disk says.
    pub fn create(directory: &Path) -> io::Result<Self> {
        let path = directory.join(format!(".fields-{}.part", std::process::id()));
        let file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(true)
            .open(&path)?;
        // A file without a name goes with the process, however that ends.
        let left = fs::remove_file(&path).err().map(|_| path);
        Ok(Self {
            file,
            left,
            angles: Vec::new(),
            axial: Vec::new(),
            crank_angles: Vec::new(),
            quantities: Vec::new(),
            failure: None,
        })
    }

    /// Forgets what is stored.
    pub fn restart(&mut self) {
        self.crank_angles.clear();
    }

    /// Stores the fields at a crank angle, rad; `false` if the disk failed, now or before:
    /// [`FieldSpool::failure`] says how.
    pub fn push(&mut self, crank_angle: f64, field: &FilmField<'_>) -> bool {
        if self.crank_angles.is_empty() {
            self.angles = field.angles.to_vec();
            self.axial = field.axial.to_vec();
            let has = |one: &Quantity| !one.in_view(field).is_empty();
            self.quantities = Quantity::ALL.into_iter().filter(has).collect();
        }
        if self.failure.is_none() {
            match self.write(field) {
                Ok(()) => self.crank_angles.push(crank_angle),
                Err(error) => self.failure = Some(error),
            }
        }
        self.failure.is_none()
    }

    fn write(&mut self, field: &FilmField<'_>) -> io::Result<()> {
        let cells = field.pressure.len();
        let mut bytes: Vec<u8> =
            Vec::with_capacity(self.quantities.len() * cells * size_of::<f32>());
        for quantity in &self.quantities {
            // Every instant takes the same room, whatever the film shows of it.
            let values = quantity.in_view(field).iter().copied();
            let values = values.chain(std::iter::repeat(f64::NAN)).take(cells);
            bytes.extend(values.flat_map(|value| (value as f32).to_le_bytes()));
        }
        let place = self.crank_angles.len() as u64 * bytes.len() as u64;
        self.file.seek(SeekFrom::Start(place))?;
        self.file.write_all(&bytes)
    }

    /// Takes what the disk said, if it failed.
    pub fn failure(&mut self) -> Option<io::Error> {
        self.failure.take()
    }

    /// Crank angles in the order of storing, rad.
    #[must_use]
    pub fn crank_angles(&self) -> &[f64] {
        &self.crank_angles
    }

    /// Cell centres around, rad, shell frame.
    #[must_use]
    pub fn angles(&self) -> &[f64] {
        &self.angles
    }

    /// Cell centres along the axis, m.
    #[must_use]
    pub fn axial(&self) -> &[f64] {
        &self.axial
    }

    /// What is stored of each instant.
    #[must_use]
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// Reads the field of one quantity at the stored crank angle of this number into `values`, one for
    /// each cell.
    ///
    /// # Errors
    /// What the disk says, and a quantity that is not stored.
    pub fn read(&self, quantity: Quantity, number: usize, values: &mut [f32]) -> io::Result<()> {
        let size = (self.angles.len() * self.axial.len() * size_of::<f32>()) as u64;
        let fields = self.quantities.len() as u64;
        let found = self.quantities.iter().position(|one| *one == quantity);
        let field = found.ok_or(io::ErrorKind::NotFound)? as u64;
        let place = (number as u64 * fields + field) * size;
        let mut file = &self.file;
        file.seek(SeekFrom::Start(place))?;
        let mut bytes = vec![0; size as usize];
        file.read_exact(&mut bytes)?;
        for (value, bytes) in values.iter_mut().zip(bytes.as_chunks().0) {
            *value = f32::from_le_bytes(*bytes);
        }
        Ok(())
    }
}

impl Drop for FieldSpool {
    fn drop(&mut self) {
        if let Some(path) = &self.left {
            // There is nobody left to tell.
            let _ = fs::remove_file(path);
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    #[test]
    fn a_film_with_contact_alone_stores_that_and_no_temperature() {
        let directory = tempfile::tempdir().unwrap();
        let mut spool = FieldSpool::create(directory.path()).unwrap();
        for value in [1.0, 2.0] {
            let field = FilmField {
                angles: &[0.5],
                axial: &[0.0],
                angle_widths: &[1.0],
                axial_widths: &[0.01],
                pressure: &[value],
                film_fraction: &[1.0],
                film_thickness: &[3.0],
                temperature: &[],
                contact_pressure: &[10.0 * value],
            };
            assert!(spool.push(value, &field));
        }
        assert_eq!(spool.quantities(), &Quantity::ALL[..4]);
        let mut values = [0.0];
        for (number, found) in [(0, 10.0), (1, 20.0)] {
            spool
                .read(Quantity::ContactPressure, number, &mut values)
                .unwrap();
            assert_eq!(values, [found]);
        }
        assert!(spool.read(Quantity::Temperature, 0, &mut values).is_err());
    }

    #[test]
    fn the_last_cycle_is_read_back() {
        let directory = tempfile::tempdir().unwrap();
        let mut spool = FieldSpool::create(directory.path()).unwrap();
        let show = |spool: &mut FieldSpool, value: f64| {
            let row = |offset: f64| [value + offset, value + offset + 0.25];
            let field = FilmField {
                angles: &[0.5, 1.5],
                axial: &[0.0],
                angle_widths: &[1.0, 1.0],
                axial_widths: &[0.01],
                pressure: &row(0.0),
                film_fraction: &row(1.0),
                film_thickness: &row(2.0),
                temperature: &[],
                contact_pressure: &[],
            };
            assert!(spool.push(value, &field));
        };
        for value in [7.0, 8.0, 9.0] {
            show(&mut spool, value);
        }
        spool.restart();
        for value in [10.0, 20.0] {
            show(&mut spool, value);
        }
        assert_eq!(spool.crank_angles(), [10.0, 20.0]);
        let mut values = [0.0; 2];
        for (number, first) in [(0, 10.0), (1, 20.0)] {
            for (quantity, offset) in Quantity::ALL.into_iter().zip([0.0, 1.0, 2.0]) {
                spool.read(quantity, number, &mut values).unwrap();
                assert_eq!(values, [first + offset, first + offset + 0.25]);
            }
        }
        drop(spool);
        assert_eq!(directory.path().read_dir().unwrap().count(), 0);
    }
}
