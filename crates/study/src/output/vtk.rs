//! Files for ParaView: `film.pvd`, to be opened, and the films it names in `paraview/`.
//!
//! The film is the bore, a cylinder of its nominal radius in m with +Z along the axis, as a structured
//! grid that closes around. Each cell of the film is a cell here and carries its values as computed;
//! its borders lie half-way between cell centres, the outermost ones on the ends of the bearing. A
//! cycle has a film for each of its frames, its time the crank angle in degrees. With wear there are
//! `paraview/wear-shell.vts` and `paraview/wear-journal.vts`, too: what contact does to each surface over
//! the cycle, and what running-in has worn off the shell, in the frame of that surface.
//!
//! Reference: Kitware, *VTK XML formats* (data inline, zlib, base64).

use super::{OutputError, ResultWriter, StoredFields, replace_file};
use crate::results::{Body, FieldSnapshot, Results, SurfaceWear, degrees};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use sommerfeld_film::Bearing;
use std::borrow::Cow;
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
        "film pressure, film fraction and film thickness on the bore, where they are fields contact pressure and temperature; wear of shell and journal; for ParaView"
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
            let cells = Cells {
                angles: &film.field.angles,
                axial: &film.field.axial,
            };
            let content = surface(bearing, &cells, &film_arrays(film.field));
            files.push(put(path, content)?);
        }
        for (name, cells, arrays) in worn_surfaces(results) {
            let content = surface(bearing, &cells, &arrays);
            files.push(put(place.join(name), content)?);
        }
        remove_others(&place, &files);
        let path = directory.join(self.file_name());
        replace_file(&path, list(&films).as_bytes())?;
        files.push(path);
        Ok(files)
    }
}

/// Writes a surface that was built.
fn put(path: PathBuf, content: io::Result<String>) -> Result<PathBuf, OutputError> {
    let content = content.map_err(|source| OutputError::Disk {
        action: "build",
        path: path.clone(),
        source,
    })?;
    replace_file(&path, content.as_bytes())?;
    Ok(path)
}

/// Centres of the cells of a surface.
struct Cells<'a> {
    angles: &'a [f64],
    axial: &'a [f64],
}

/// Values per cell with their name.
type Arrays<'a> = Vec<(&'static str, Cow<'a, [f64]>)>;

fn film_arrays(field: &FieldSnapshot) -> Arrays<'_> {
    let all = [
        ("pressure [Pa]", &field.pressure),
        ("film fraction", &field.film_fraction),
        ("film thickness [m]", &field.film_thickness),
        ("contact pressure [Pa]", &field.contact_pressure),
        ("temperature [K]", &field.temperature),
    ];
    let given = all.into_iter().filter(|(_, values)| !values.is_empty());
    given
        .map(|(name, values)| (name, Cow::Borrowed(values.as_slice())))
        .collect()
}

/// What contact has done to shell and journal over a load cycle, where the study asks for it.
fn worn_surfaces(results: &Results) -> Vec<(&'static str, Cells<'_>, Arrays<'_>)> {
    let Body::LoadCycle(cycle) = &results.body else {
        return Vec::new();
    };
    let Some(fields) = &cycle.fields else {
        return Vec::new();
    };
    let ran_in = cycle
        .running_in
        .as_ref()
        .filter(|ran| !ran.depth.is_empty());
    let surfaces = [
        ("wear-shell.vts", &fields.on_shell, ran_in),
        ("wear-journal.vts", &fields.on_journal, None),
    ];
    let surfaces = surfaces.into_iter();
    surfaces
        .filter_map(|(name, map, ran_in)| {
            let wear = map.wear.as_ref()?;
            let mut arrays = wear_arrays(wear);
            arrays.extend(ran_in.map(|ran| ("worn depth [m]", Cow::from(&ran.depth))));
            let cells = Cells {
                angles: &wear.map.angles,
                axial: &wear.map.axial,
            };
            Some((name, cells, arrays))
        })
        .collect()
}

fn wear_arrays(wear: &SurfaceWear) -> Arrays<'_> {
    let seen = &wear.map;
    let mut arrays: Arrays<'_> = vec![
        ("wear load [J/m2]", Cow::from(&seen.wear_load)),
        ("friction energy [J/m2]", Cow::from(wear.friction_energy())),
        (
            "peak pressure velocity [W/m2]",
            Cow::from(&seen.peak_pressure_velocity),
        ),
        (
            "mean pressure velocity [W/m2]",
            Cow::from(&seen.mean_pressure_velocity),
        ),
    ];
    let depth = wear.depth_per_hour();
    arrays.extend(depth.map(|depth| ("wear depth per hour [m]", Cow::from(depth))));
    arrays
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
        let is_ours = ["film", "wear-"].iter().any(|ours| name.starts_with(ours));
        let is_film = is_ours && name.ends_with(".vts");
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

/// Values on the bore as a structured grid: first index around, second along the axis.
fn surface(bearing: &Bearing, cells: &Cells<'_>, arrays: &Arrays<'_>) -> io::Result<String> {
    let (around, along) = (cells.angles.len(), cells.axial.len());
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
    let first = arrays.first().map_or("", |(name, _)| name);
    text += &format!("<CellData Scalars=\"{first}\">\n");
    for (name, values) in arrays {
        array(&mut text, name, 1, &by_cell(values))?;
    }
    text += "</CellData>\n<Points>\n";
    array(&mut text, "bore [m]", 3, &points(bearing, cells))?;
    text += "</Points>\n</Piece>\n</StructuredGrid>\n</VTKFile>\n";
    Ok(text)
}

/// Corners of the cells on the bore; the last ones around lie on the first.
fn points(bearing: &Bearing, cells: &Cells<'_>) -> Vec<f32> {
    let radius = bearing.radius();
    let (angles, half) = (cells.angles, 0.5 * bearing.width);
    let between = |pair: &[f64]| 0.5 * (pair[0] + pair[1]);
    let (Some(first), Some(last)) = (angles.first(), angles.last()) else {
        return Vec::new();
    };
    let seam = 0.5 * (last - TAU + first);
    let mut corners = vec![seam];
    corners.extend(angles.windows(2).map(between));
    let mut ends = vec![-half];
    ends.extend(cells.axial.windows(2).map(between));
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
