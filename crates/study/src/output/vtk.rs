//! Files for ParaView: `film.pvd`, to be opened, and the films it names in `paraview/`.
//!
//! The film is the bore, a cylinder of its nominal radius in m with +Z along the axis, as a structured
//! grid that closes around. Each cell of the film is a cell here and carries its values as computed;
//! its borders lie half-way between cell centres, the outermost ones on the ends of the bearing. A
//! cycle has a film for each of its frames, its time the crank angle in degrees.
//!
//! Reference: Kitware, *VTK XML formats* (data inline, zlib, base64).

use super::{OutputError, ResultWriter, StoredFields, replace_file};
use crate::results::{Body, FieldSnapshot, Results, degrees};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use sommerfeld_film::Bearing;
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Directory of the films.
const FILMS: &str = "paraview";

/// Writes `film.pvd` and the films that it names.
#[derive(Debug, Clone, Copy)]
pub struct ParaView;

/// A film with the name and the time under which it is listed.
struct Shown<'a> {
    name: String,
    time: f64,
    field: &'a FieldSnapshot,
}

impl ResultWriter for ParaView {
    fn file_name(&self) -> &'static str {
        "film.pvd"
    }

    fn describe(&self) -> &'static str {
        "film pressure, film fraction and film thickness on the bore, where they are fields contact pressure and temperature, for ParaView"
    }

    fn write(
        &self,
        results: &Results,
        _stored: StoredFields<'_>,
        directory: &Path,
    ) -> Result<Vec<PathBuf>, OutputError> {
        let Some((bearing, films)) = films(results) else {
            return Ok(Vec::new());
        };
        let place = directory.join(FILMS);
        fs::create_dir_all(&place).map_err(|source| OutputError::Disk {
            action: "create the directory",
            path: place.clone(),
            source,
        })?;
        let mut files = Vec::new();
        for film in &films {
            let path = place.join(&film.name);
            let content = surface(bearing, film).map_err(|source| OutputError::Disk {
                action: "build",
                path: path.clone(),
                source,
            })?;
            replace_file(&path, content.as_bytes())?;
            files.push(path);
        }
        remove_others(&place, &files);
        let path = directory.join(self.file_name());
        replace_file(&path, list(&films).as_bytes())?;
        files.push(path);
        Ok(files)
    }
}

/// The bearing and its films; `None` if the results hold no fields.
fn films(results: &Results) -> Option<(&Bearing, Vec<Shown<'_>>)> {
    match &results.body {
        Body::Steady(steady) => {
            let film = Shown {
                name: "film.vts".to_owned(),
                time: 0.0,
                field: steady.field.as_ref()?,
            };
            Some((&steady.bearing, vec![film]))
        }
        Body::LoadCycle(cycle) => {
            let frames = cycle.fields.as_ref()?.frames.iter().enumerate();
            let films = frames.map(|(number, frame)| Shown {
                name: format!("film-{:02}.vts", number + 1),
                time: degrees(frame.crank_angle),
                field: &frame.field,
            });
            Some((&cycle.bearing, films.collect()))
        }
        Body::Dimensionless(_) | Body::Machine(_) | Body::Database(_) | Body::Sweep(_) => None,
    }
}

/// Removes films of an earlier run that this one has not written.
fn remove_others(place: &Path, files: &[PathBuf]) {
    for entry in fs::read_dir(place).into_iter().flatten().flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        let name = name.to_string_lossy();
        let is_film = name.starts_with("film") && name.ends_with(".vts");
        if is_film && !files.contains(&path) {
            // The list does not name it: what cannot be removed does no harm.
            let _ = fs::remove_file(path);
        }
    }
}

/// The list of films with their times.
fn list(films: &[Shown<'_>]) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" \
         byte_order=\"LittleEndian\">\n<Collection>\n",
    );
    for film in films {
        let (time, name) = (film.time, &film.name);
        text += &format!(
            "<DataSet timestep=\"{time}\" group=\"\" part=\"0\" file=\"{FILMS}/{name}\"/>\n"
        );
    }
    text + "</Collection>\n</VTKFile>\n"
}

/// One film as a structured grid: first index around, second along the axis.
fn surface(bearing: &Bearing, film: &Shown<'_>) -> io::Result<String> {
    let field = film.field;
    let (around, along) = (field.angles.len(), field.axial.len());
    let by_cell = |values: &[f64]| -> Vec<f32> {
        let cells = (0..along).flat_map(|j| (0..around).map(move |i| i * along + j));
        cells.map(|cell| values[cell] as f32).collect()
    };
    let extent = format!("0 {around} 0 {along} 0 0");
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"StructuredGrid\" version=\"1.0\" \
         byte_order=\"LittleEndian\" header_type=\"UInt32\" \
         compressor=\"vtkZLibDataCompressor\">\n",
    );
    text += &format!("<StructuredGrid WholeExtent=\"{extent}\">\n<Piece Extent=\"{extent}\">\n");
    text += "<CellData Scalars=\"pressure [Pa]\">\n";
    for (name, values) in [
        ("pressure [Pa]", &field.pressure),
        ("film fraction", &field.film_fraction),
        ("film thickness [m]", &field.film_thickness),
        ("contact pressure [Pa]", &field.contact_pressure),
        ("temperature [K]", &field.temperature),
    ] {
        if values.is_empty() {
            continue;
        }
        array(&mut text, name, 1, &by_cell(values))?;
    }
    text += "</CellData>\n<Points>\n";
    array(&mut text, "bore [m]", 3, &points(bearing, field))?;
    text += "</Points>\n</Piece>\n</StructuredGrid>\n</VTKFile>\n";
    Ok(text)
}

/// Corners of the cells on the bore; the last ones around lie on the first.
fn points(bearing: &Bearing, field: &FieldSnapshot) -> Vec<f32> {
    let radius = bearing.radius();
    let (angles, half) = (&field.angles, 0.5 * bearing.width);
    let between = |pair: &[f64]| 0.5 * (pair[0] + pair[1]);
    let (Some(first), Some(last)) = (angles.first(), angles.last()) else {
        return Vec::new();
    };
    let seam = 0.5 * (last - TAU + first);
    let mut corners = vec![seam];
    corners.extend(angles.windows(2).map(between));
    let mut ends = vec![-half];
    ends.extend(field.axial.windows(2).map(between));
    ends.push(half);
    let circle: Vec<[f32; 2]> = corners
        .iter()
        .chain([&seam])
        .map(|angle| [angle.cos(), angle.sin()].map(|part| (radius * part) as f32))
        .collect();
    let ends = ends.iter();
    ends.flat_map(|z| circle.iter().flat_map(move |[x, y]| [*x, *y, *z as f32]))
        .collect()
}

/// An array: one zlib block and its sizes, in base64.
fn array(text: &mut String, name: &str, components: u32, values: &[f32]) -> io::Result<()> {
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(&bytes)?;
    let packed = encoder.finish()?;
    // Blocks, bytes of each, bytes of a last shorter one, bytes of the compressed block.
    let sizes = [1, bytes.len() as u32, 0, packed.len() as u32];
    let sizes: Vec<u8> = sizes.iter().flat_map(|n| n.to_le_bytes()).collect();
    let _ = write!(
        text,
        "<DataArray type=\"Float32\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"binary\">\n{}{}\n</DataArray>\n",
        base64(&sizes),
        base64(&packed)
    );
    Ok(())
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let at = |index: usize| u32::from(three.get(index).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for place in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * place)) as usize & 63];
            text.push(if place <= three.len() {
                letter.into()
            } else {
                '='
            });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        // Test vectors of RFC 4648.
        for (plain, coded) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
