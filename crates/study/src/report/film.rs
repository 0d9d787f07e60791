//! The film at single instants: maps of pressure and film fraction, the film as a body, and what a
//! reader asks of each instant.

use super::detail::Detail;
use super::figures::{mid_plane, outline, place_mark, short};
use super::format::{MICROMETRE, Units, angle, celsius, plain_number, significant};
use super::packing::{Blocks, Depth, Keep, packed};
use super::page::FilmPart;
use crate::results::{
    CycleField, CycleFields, CycleResults, FieldSnapshot, degrees, degrees_around, magnitude, place,
};
use serde_json::{Value, json};
use sommerfeld_bearing::CyclePoint;
use sommerfeld_film::{Bearing, Extreme, FilmSummary, JournalState};

/// Blocks around and along of a film that is alone.
const SINGLE_BLOCKS: [usize; 2] = [360, 96];

/// One instant of a film and what is known of it.
pub(super) struct Instant<'a> {
    /// Crank angle, rad; none for a steady state.
    pub crank_angle: Option<f64>,
    /// The fields.
    pub field: &'a FieldSnapshot,
    /// Position of the journal.
    pub state: &'a JournalState,
    /// Extremes of the film.
    pub summary: &'a FilmSummary,
    /// Load on the journal, N.
    pub load: [f64; 2],
}

/// The recorded instants of a cycle with the points of the orbit they belong to, by ascending crank
/// angle. The instant of the thinnest film is among them: where there is no room for one more frame
/// it stands for the nearest.
pub(super) fn instants<'a>(
    cycle: &'a CycleResults,
    fields: &'a CycleFields,
    detail: &Detail,
) -> Vec<Instant<'a>> {
    let worst = &fields.worst;
    let stride = fields.frames.len().div_ceil(detail.frames).max(1);
    let mut films: Vec<&CycleField> = fields.frames.iter().step_by(stride).collect();
    let away = |film: &CycleField| (film.crank_angle - worst.crank_angle).abs();
    let nearest = (0..films.len()).min_by(|&a, &b| away(films[a]).total_cmp(&away(films[b])));
    match nearest {
        Some(nearest) if away(films[nearest]) < 1e-9 || films.len() >= detail.frames => {
            films[nearest] = worst;
        }
        _ => films.push(worst),
    }
    films.sort_by(|a, b| a.crank_angle.total_cmp(&b.crank_angle));
    films
        .into_iter()
        .filter_map(|film| {
            let point = nearest_point(cycle, film.crank_angle)?;
            Some(Instant {
                crank_angle: Some(film.crank_angle),
                field: &film.field,
                state: &point.state,
                summary: &point.summary,
                load: point.load,
            })
        })
        // Frames share one grid on the page; a frame of another size cannot be shown with it.
        .filter(|instant| instant.field.pressure.len() == worst.field.pressure.len())
        .collect()
}

/// The point of the orbit at a crank angle, rad.
fn nearest_point(cycle: &CycleResults, crank_angle: f64) -> Option<&CyclePoint> {
    cycle.largest(|point| -(point.crank_angle - crank_angle).abs())
}

/// Where along the axis an extreme lies: the middle third of the width, or the third in front of it
/// (negative z) or behind it.
pub(super) fn third(axial: f64, width: f64) -> &'static str {
    match axial / width {
        share if share < -1.0 / 6.0 => "front",
        share if share > 1.0 / 6.0 => "rear",
        _ => "mid",
    }
}

/// The place of an extreme in words: bearing angle, and the third of the width.
pub(super) fn in_film(extreme: &Extreme, width: f64) -> String {
    if !extreme.value.is_finite() {
        return String::new();
    }
    let (degrees, axial) = place(extreme);
    // A peak between two cells that mirror each other lies there to round-off.
    let along = if axial.abs() < 1e-5 {
        "mid-plane".to_owned()
    } else {
        format!(
            "{}, z = {} mm",
            third(extreme.axial, width),
            plain_number(axial)
        )
    };
    format!("at {}, {along}", angle(degrees))
}

/// The words around the pictures of the film.
pub(super) fn part(bearing: &Bearing, instants: &[Instant<'_>], detail: &Detail) -> FilmPart {
    let frames = instants.len();
    let cells =
        |field: fn(&FieldSnapshot) -> usize| instants.first().map_or(0, |first| field(first.field));
    let blocks = instants
        .first()
        .map(|first| blocks(first.field, frames, detail));
    let thinned = if let Some(blocks) = blocks.filter(Blocks::is_coarser) {
        format!(
            " Drawn in blocks of {} × {} cells, which keep the largest pressure and the smallest \
             film thickness of their cells and the mean film fraction.",
            blocks.size[0], blocks.size[1]
        )
    } else {
        " Drawn cell by cell as computed.".to_owned()
    };
    let grid = format!(
        "{} cells around × {} along the axis",
        cells(|field| field.angles.len()),
        cells(|field| field.axial.len())
    );
    let feeds = if bearing.feeds.is_empty() {
        ""
    } else {
        " Outlines: grooves and holes."
    };
    FilmPart {
        is_cycle: frames > 1,
        lead: if frames > 1 {
            format!(
                "Drag the slider, use the arrow keys, or press play: the maps and the body of \
                 the film show one of {frames} crank angles, the thinnest film among them."
            )
        } else if detail.is_packed {
            "The film at the crank angle where it is thinnest.".to_owned()
        } else {
            "The film of the state above.".to_owned()
        },
        shows_crank: frames > 1 || detail.is_packed,
        solid: "The bearing seen from +z, +X to the right and +Y up, angles as on the rings. The \
                height of the surface above the rings is the film pressure; the arrow is the load \
                on the journal. Drag to turn, scroll to zoom; unrolled, the height stands over \
                bearing angle and axial position."
            .to_owned(),
        pressure: format!(
            "Bearing surface unrolled, angle from +X of the shell frame in the sense of rotation, \
             axial position from the mid-plane: front negative, rear positive. Ring: peak \
             pressure; cross: thinnest film.{feeds}"
        ),
        fraction: format!(
            "1 where oil fills the gap, below 1 where the film is ruptured. Cross: thinnest \
             film. Grid: {grid}.{thinned}"
        ),
        contact: if touches(instants) {
            "Pressure of the asperities that touch, mean over the surface; it adds to the film \
             pressure. Ring: its peak; cross: thinnest film."
                .to_owned()
        } else {
            String::new()
        },
        temperature: temperature(instants).map_or_else(String::new, |field| {
            let hottest = field.temperature.iter().copied().fold(f64::NAN, f64::max);
            let when = if frames > 1 {
                "The temperatures at the end of the run; a cycle is too short to change them"
            } else {
                "Mean over the thickness of the film"
            };
            format!("{when}. Hottest cell: {} °C.", celsius(hottest))
        }),
    }
}

/// Whether asperities can touch in these films.
fn touches(instants: &[Instant<'_>]) -> bool {
    instants
        .iter()
        .any(|one| !one.field.contact_pressure.is_empty())
}

/// The last film with a field of temperature.
fn temperature<'a>(instants: &[Instant<'a>]) -> Option<&'a FieldSnapshot> {
    let fields = instants.iter().map(|one| one.field);
    fields.rev().find(|field| !field.temperature.is_empty())
}

fn blocks(field: &FieldSnapshot, frames: usize, detail: &Detail) -> Blocks {
    let most = if frames > 1 || detail.is_packed {
        detail.frame_blocks
    } else {
        SINGLE_BLOCKS
    };
    Blocks::of(&around(field), field.axial.len(), most)
}

fn around(field: &FieldSnapshot) -> Vec<f64> {
    field.angles.iter().copied().map(degrees_around).collect()
}

/// The instants for the script; nothing where there is none.
pub(super) fn film_data(
    bearing: &Bearing,
    instants: &[Instant<'_>],
    units: &Units,
    detail: &Detail,
) -> Value {
    let Some(first) = instants.first() else {
        return Value::Null;
    };
    let blocks = blocks(first.field, instants.len(), detail);
    let all = |values: fn(&FieldSnapshot) -> &[f64], keep, factor: f64| -> Vec<f64> {
        instants
            .iter()
            .flat_map(|instant| blocks.gather(values(instant.field), keep))
            .map(|value| value * factor)
            .collect()
    };
    let pressure = all(
        |field| &field.pressure,
        Keep::Largest,
        units.pressure.factor,
    );
    let fraction = all(|field| &field.film_fraction, Keep::Mean, 1.0);
    let thickness = all(
        |field| &field.film_thickness,
        Keep::Smallest,
        MICROMETRE.factor,
    );
    let numbers = |values: Vec<f64>| values.into_iter().map(short).collect::<Value>();
    let axial: Vec<f64> = first.field.axial.iter().map(|z| z * 1e3).collect();
    json!({
        "angle": numbers(blocks.middles_around(&around(first.field))),
        "axial": numbers(blocks.middles_along(&axial)),
        "half_width": short(bearing.width * 500.0),
        "radius": short(bearing.radius() * 1e3),
        "feeds": bearing.feeds.iter().map(|feed| outline(feed, bearing)).collect::<Value>(),
        "frames": instants.iter().map(|one| frame(one, bearing, units)).collect::<Value>(),
        "jumps": jumps(instants),
        "pressure": packed(&pressure, detail.frame_depth),
        "fraction": packed(&fraction, Depth::Byte),
        "thickness": packed(&thickness, Depth::Byte),
        "contact": touches(instants).then(|| {
            let factor = units.pressure.factor;
            let contact = all(|field| &field.contact_pressure, Keep::Largest, factor);
            packed(&contact, detail.frame_depth)
        }),
        "temperature": temperature(instants).map(|field| {
            let celsius: Vec<f64> = field.temperature.iter().map(|kelvin| kelvin - 273.15).collect();
            packed(&blocks.gather(&celsius, Keep::Largest), Depth::Word)
        }),
    })
}

/// What the page says of one instant.
fn frame(instant: &Instant<'_>, bearing: &Bearing, units: &Units) -> Value {
    let summary = instant.summary;
    let load = instant.load;
    let direction = degrees_around(load[1].atan2(load[0]));
    let eccentricity = instant.state.eccentricity() / bearing.radial_clearance;
    json!({
        "crank": instant.crank_angle.map(|crank| short(degrees(crank))),
        "crank_text": instant.crank_angle.map(|crank| angle(degrees(crank))),
        "load": load.map(|force| short(force * units.force.factor)),
        "load_text": units.force.show(magnitude(load)),
        "load_place": format!("towards {}", angle(direction)),
        "thickness_text": MICROMETRE.show(summary.minimum_film_thickness.value),
        "thickness_place": in_film(&summary.minimum_film_thickness, bearing.width),
        "pressure_text": units.pressure.show(summary.peak_film_pressure.value),
        "pressure_place": in_film(&summary.peak_film_pressure, bearing.width),
        "eccentricity_text": significant(eccentricity),
        "eccentricity_place": format!(
            "line of centres at {}",
            angle(degrees_around(instant.state.line_of_centres_angle()))
        ),
        "position": instant.state.position.map(|x| short(x / bearing.radial_clearance)),
        "journal_angle": short(degrees(instant.state.journal_angle)),
        "shell_angle": short(degrees(instant.state.shell_angle)),
        "thinnest": place_mark(&summary.minimum_film_thickness, MICROMETRE),
        "highest": place_mark(&summary.peak_film_pressure, units.pressure),
        "contact_text": units.pressure.show(summary.peak_contact_pressure.value),
        "contact_place": if summary.peak_contact_pressure.value > 0.0 {
            in_film(&summary.peak_contact_pressure, bearing.width)
        } else {
            "no asperities touch".to_owned()
        },
        "hardest": (summary.peak_contact_pressure.value > 0.0)
            .then(|| place_mark(&summary.peak_contact_pressure, units.pressure)),
    })
}

/// Instants worth a button: their names and numbers.
fn jumps(instants: &[Instant<'_>]) -> Value {
    let largest = |value: &dyn Fn(&Instant<'_>) -> f64| {
        (0..instants.len()).max_by(|&a, &b| value(&instants[a]).total_cmp(&value(&instants[b])))
    };
    let named = [
        (
            "Peak pressure",
            largest(&|one| one.summary.peak_film_pressure.value),
        ),
        (
            "Thinnest film",
            largest(&|one| -one.summary.minimum_film_thickness.value),
        ),
        ("Largest load", largest(&|one| magnitude(one.load))),
    ];
    let contact = |one: &Instant<'_>| one.summary.peak_contact_pressure.value;
    let hardest = largest(&contact).filter(|&at| contact(&instants[at]) > 0.0);
    named
        .into_iter()
        .chain([("Hardest contact", hardest)])
        .filter_map(|(name, index)| Some(json!({"name": name, "frame": index?})))
        .collect()
}

/// Curves around the mid-plane of one film.
pub(super) fn middle_data(field: &FieldSnapshot, units: &Units) -> Value {
    let angles = around(field);
    let mut order: Vec<usize> = (0..angles.len()).collect();
    order.sort_by(|&a, &b| angles[a].total_cmp(&angles[b]));
    let middle = |values: &[f64], factor: f64| -> Value {
        order
            .iter()
            .map(|&i| short(mid_plane(values, &field.axial, i) * factor))
            .collect()
    };
    json!({
        "angle": order.iter().map(|&i| short(angles[i])).collect::<Value>(),
        "pressure": middle(&field.pressure, units.pressure.factor),
        "fraction": middle(&field.film_fraction, 1.0),
        "thickness": middle(&field.film_thickness, MICROMETRE.factor),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_width_has_three_thirds() {
        assert_eq!(third(-0.010, 0.03), "front");
        assert_eq!(third(0.004, 0.03), "mid");
        assert_eq!(third(0.0051, 0.03), "rear");
    }
}
