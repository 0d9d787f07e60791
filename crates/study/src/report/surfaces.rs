//! What the surfaces have seen over a cycle, on shell and journal, and where an oil hole in the
//! journal would be loaded least.

use super::detail::Detail;
use super::figures::{outline, short};
use super::format::{MICROMETRE, Units, angle, plain_number};
use super::packing::{Blocks, Keep, packed};
use super::page::Figure;
use crate::results::{AccumulatedMap, CycleFields, SurfaceWear, degrees, degrees_around};
use serde_json::{Value, json};
use sommerfeld_film::{Bearing, Carrier, Feed, FeedShape};
use std::f64::consts::{PI, TAU};

/// Oil hole over bore diameter where the study has no hole in the journal: usual for crankshafts.
const USUAL_HOLE: f64 = 0.1;
/// nm per m.
const NANOMETRES: f64 = 1e9;
/// MW per W.
const MEGA: f64 = 1e-6;
/// Pressures this share of the range above the smallest one count as equally small.
const ALIKE: f64 = 0.01;

/// A round patch of the journal in the mid-plane, by the largest pressure it sees in a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Patch {
    /// Angle of its centre from +X of the journal, rad.
    pub angle: f64,
    /// Largest pressure it sees, Pa.
    pub pressure: f64,
    /// Half the angle over which this holds within a hundredth of the range, rad.
    pub half_span: f64,
}

/// Largest pressure that a round patch of `diameter` (m) around `centre` (rad) in the mid-plane
/// sees; cells that touch the patch count whole.
fn patch_pressure(map: &AccumulatedMap, centre: f64, diameter: f64, radius: f64) -> f64 {
    let (around, along) = (map.angles.len(), map.axial.len());
    let cell = TAU * radius / around.max(1) as f64;
    let mut largest = f64::NEG_INFINITY;
    for (i, angle) in map.angles.iter().enumerate() {
        let dx = (apart(*angle, centre) * radius - 0.5 * cell).max(0.0);
        if dx > 0.5 * diameter {
            continue;
        }
        for (j, z) in map.axial.iter().enumerate() {
            let dz = (z.abs() - half_cell(&map.axial, j)).max(0.0);
            if dx.hypot(dz) <= 0.5 * diameter {
                largest = largest.max(map.maximum_pressure[i * along + j]);
            }
        }
    }
    largest
}

/// Half the width of cell `j` along the axis: half the way to its nearer neighbour.
fn half_cell(axial: &[f64], j: usize) -> f64 {
    let to = |other: Option<&f64>| other.map_or(f64::INFINITY, |z| 0.5 * (z - axial[j]).abs());
    let before = j.checked_sub(1).and_then(|before| axial.get(before));
    to(before).min(to(axial.get(j + 1)))
}

/// The smaller angle between two directions, rad.
fn apart(a: f64, b: f64) -> f64 {
    ((a - b + PI).rem_euclid(TAU) - PI).abs()
}

/// What a patch sees around each angle of the map; infinite where a hole of the study is nearer
/// than a diameter, because it relieves its surroundings.
fn patch_pressures(map: &AccumulatedMap, diameter: f64, bearing: &Bearing) -> Vec<f64> {
    let radius = bearing.radius();
    map.angles
        .iter()
        .map(|&angle| {
            let is_taken =
                holes(bearing).any(|(hole, _)| apart(angle, hole.angle) * radius < diameter);
            if is_taken {
                f64::INFINITY
            } else {
                patch_pressure(map, angle, diameter, radius)
            }
        })
        .collect()
}

/// The place in the mid-plane at which a round patch sees the least: the middle of the longest
/// stretch of angles with (within a hundredth of the range) the smallest largest pressure.
fn least_loaded(map: &AccumulatedMap, pressures: &[f64]) -> Option<Patch> {
    let least = pressures.iter().copied().reduce(f64::min)?;
    let most = pressures
        .iter()
        .copied()
        .filter(|p| p.is_finite())
        .reduce(f64::max)?;
    if !least.is_finite() {
        return None;
    }
    let count = pressures.len();
    let is_quiet = |i: usize| pressures[i % count] <= least + ALIKE * (most - least);
    let run_from = |start: usize| (0..count).take_while(|step| is_quiet(start + step)).count();
    let (start, length) = (0..count)
        .filter(|&start| is_quiet(start) && (!is_quiet(start + count - 1) || start == 0))
        .map(|start| (start, run_from(start)))
        .max_by_key(|&(start, length)| (length, std::cmp::Reverse(start)))?;
    let cell = TAU / count as f64;
    Some(Patch {
        angle: (map.angles[start] + 0.5 * cell * (length.saturating_sub(1)) as f64).rem_euclid(TAU),
        pressure: least,
        half_span: 0.5 * cell * length as f64,
    })
}

/// Holes that turn with the journal: where they stand on it and their diameters.
fn holes(bearing: &Bearing) -> impl Iterator<Item = (&Feed, f64)> {
    bearing.feeds.iter().filter_map(|feed| match feed.shape {
        FeedShape::Hole { diameter } if feed.carried_by == Carrier::Journal => {
            Some((feed, diameter))
        }
        _ => None,
    })
}

/// Diameter of the hole for which a place is sought.
fn hole_diameter(bearing: &Bearing) -> f64 {
    holes(bearing)
        .next()
        .map_or(USUAL_HOLE * bearing.diameter, |(_, diameter)| diameter)
}

/// Where an oil hole would be loaded least, with its diameter.
pub(super) fn quiet_place(bearing: &Bearing, map: &AccumulatedMap) -> Option<(Patch, f64)> {
    let diameter = hole_diameter(bearing);
    let pressures = patch_pressures(map, diameter, bearing);
    Some((least_loaded(map, &pressures)?, diameter))
}

/// The least loaded place in a sentence or two.
pub(super) fn hole_sentence(bearing: &Bearing, map: &AccumulatedMap, units: &Units) -> String {
    let Some((patch, diameter)) = quiet_place(bearing, map) else {
        return String::new();
    };
    let around = |turned: f64| angle(degrees_around(turned).round());
    let apart_from = if holes(bearing).next().is_some() {
        "Apart from the surroundings of its own hole, the journal"
    } else {
        "The journal"
    };
    let mut text = format!(
        "{apart_from} is loaded least for an oil hole of {} mm in the mid-plane around {} ({} to \
         {}): at most {} over the cycle (dashed circle).",
        plain_number(diameter * 1e3),
        around(patch.angle),
        around(patch.angle - patch.half_span),
        around(patch.angle + patch.half_span),
        units.pressure.show(patch.pressure)
    );
    for (hole, diameter) in holes(bearing) {
        let seen = patch_pressure(map, hole.angle, diameter, bearing.radius());
        text += &format!(
            " Its hole at {} relieves its surroundings; its edge sees {}.",
            angle(degrees(hole.angle)),
            units.pressure.show(seen)
        );
    }
    text
}

/// Maps of both surfaces side by side: kind of the drawing, title, what one sees. `hole` tells where
/// an oil hole in the journal would be loaded least.
pub(super) fn figures(hole: &str, has_wear: bool, detail: &Detail) -> Vec<Figure> {
    let shell_frame = "Shell, angle from +X of the shell frame.";
    let journal_frame = "Journal, angle from +X of the journal.";
    let figure = |kind, title, caption: String| Figure {
        kind,
        title,
        caption,
        size: "",
    };
    let mut figures = vec![
        figure(
            "shell-pressure",
            "Largest pressure · shell",
            format!("{shell_frame} The largest film pressure each point has seen in the cycle."),
        ),
        figure(
            "journal-pressure",
            "Largest pressure · journal",
            format!("{journal_frame} {hole}"),
        ),
        figure(
            "shell-thickness",
            "Thinnest film · shell",
            format!("{shell_frame} Bright where the film has been thinnest: wear starts there."),
        ),
        figure(
            "journal-thickness",
            "Thinnest film · journal",
            format!("{journal_frame} A bright band all around is a journal worn evenly."),
        ),
        figure(
            "shell-amplitude",
            "Pressure amplitude · shell",
            format!(
                "{shell_frame} Half the difference of largest and smallest pressure: what tires \
                 the bearing layer."
            ),
        ),
        figure(
            "journal-amplitude",
            "Pressure amplitude · journal",
            format!("{journal_frame} Half the difference of largest and smallest pressure."),
        ),
        figure(
            "shell-share",
            "Share of the cycle with a full film · shell",
            format!("{shell_frame} Dark where the film is ruptured for most of the cycle."),
        ),
        figure(
            "journal-share",
            "Share of the cycle with a full film · journal",
            format!("{journal_frame} Dark where oil is short for most of the cycle."),
        ),
    ];
    if has_wear {
        figures.extend([
            figure(
                "shell-wear",
                "Wear · shell",
                format!("{shell_frame} Depth that contact wears off the shell in an hour (Archard)."),
            ),
            figure(
                "journal-energy",
                "Friction energy · journal",
                format!("{journal_frame} Energy that asperities in contact turn into heat in a cycle; the shear of the oil is not in it."),
            ),
            figure(
                "shell-pv",
                "Pressure times speed · shell",
                format!("{shell_frame} Largest film and contact pressure together times sliding speed."),
            ),
            figure(
                "journal-pv",
                "Pressure times speed · journal",
                format!("{journal_frame} Largest film and contact pressure together times sliding speed."),
            ),
        ]);
    }
    if detail.is_crowded {
        figures.retain(|figure| !figure.kind.ends_with("share"));
    }
    figures
}

/// Both surfaces for the script; `worn` is the depth that running-in has worn off the cells of the shell,
/// m.
pub(super) fn surface_data(
    bearing: &Bearing,
    fields: &CycleFields,
    worn: Option<&[f64]>,
    (units, detail): (&Units, &Detail),
) -> Value {
    let feeds = |carrier: Carrier| -> Value {
        bearing
            .feeds
            .iter()
            .filter(|feed| feed.carried_by == carrier)
            .map(|feed| outline(feed, bearing))
            .collect()
    };
    let quiet = quiet_place(bearing, &fields.on_journal).map(|(patch, diameter)| {
        json!({
            "angle": short(degrees_around(patch.angle)),
            "axial": 0.0,
            "half_length": short(degrees(0.5 * diameter / bearing.radius())),
            "half_width": short(diameter * 500.0),
            "label": format!("oil hole: {}", units.pressure.show(patch.pressure)),
        })
    });
    json!({
        "half_width": short(bearing.width * 500.0),
        "shell": map_data(&fields.on_shell, worn, feeds(Carrier::Shell), (units, detail)),
        "journal": map_data(&fields.on_journal, None, feeds(Carrier::Journal), (units, detail)),
        "quiet": quiet,
    })
}

fn map_data(
    map: &AccumulatedMap,
    worn: Option<&[f64]>,
    feeds: Value,
    (units, detail): (&Units, &Detail),
) -> Value {
    let angles: Vec<f64> = map.angles.iter().copied().map(degrees_around).collect();
    let axial: Vec<f64> = map.axial.iter().map(|z| z * 1e3).collect();
    let blocks = Blocks::of(&angles, axial.len(), detail.map_blocks);
    let numbers = |values: Vec<f64>| values.into_iter().map(short).collect::<Value>();
    let field = |values: &[f64], keep, factor: f64| {
        let gathered: Vec<f64> = blocks
            .gather(values, keep)
            .into_iter()
            .map(|value| value * factor)
            .collect();
        packed(&gathered, detail.map_depth)
    };
    let pressure = units.pressure.factor;
    let wear = map.wear.as_ref();
    let of_wear = |values: Option<Vec<f64>>, factor| {
        values.map(|values| field(&values, Keep::Largest, factor))
    };
    json!({
        "worn": worn.map(|depth| field(depth, Keep::Largest, MICROMETRE.factor)),
        "wear": of_wear(wear.and_then(SurfaceWear::depth_per_hour), NANOMETRES),
        "energy": of_wear(wear.map(SurfaceWear::friction_energy), 1.0),
        "pv": of_wear(wear.map(|wear| wear.map.peak_pressure_velocity.clone()), MEGA),
        "angle": numbers(blocks.middles_around(&angles)),
        "axial": numbers(blocks.middles_along(&axial)),
        "pressure": field(&map.maximum_pressure, Keep::Largest, pressure),
        "amplitude": field(&map.pressure_amplitude, Keep::Largest, pressure),
        "thickness": field(&map.minimum_film_thickness, Keep::Smallest, MICROMETRE.factor),
        "share": (!detail.is_crowded).then(|| field(&map.full_film_share, Keep::Mean, 1.0)),
        "feeds": feeds,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    /// Eight angles, three places along the axis; pressure where `loaded` says.
    fn map(loaded: impl Fn(usize, usize) -> f64) -> AccumulatedMap {
        let pressure: Vec<f64> = (0..24).map(|cell| loaded(cell / 3, cell % 3)).collect();
        AccumulatedMap {
            angles: (0..8).map(|i| (f64::from(i) + 0.5) * TAU / 8.0).collect(),
            axial: vec![-0.01, 0.0, 0.01],
            minimum_film_thickness: vec![1e-6; 24],
            pressure_amplitude: pressure.clone(),
            maximum_pressure: pressure,
            full_film_share: vec![1.0; 24],
            wear: None,
        }
    }

    fn patches(map: &AccumulatedMap, diameter: f64) -> Vec<f64> {
        let patch = |angle: &f64| patch_pressure(map, *angle, diameter, 0.05);
        map.angles.iter().map(patch).collect()
    }

    #[test]
    fn the_longest_quiet_stretch_wins_across_zero() {
        // Quiet at cells 7, 0, 1 (three) and 4 (one).
        let map = map(|i, _| if matches!(i, 7 | 0 | 1 | 4) { 0.0 } else { 5e6 });
        let quiet = least_loaded(&map, &patches(&map, 1e-4)).unwrap();
        assert!((quiet.angle - 0.5 * TAU / 8.0).abs() < 1e-12, "{quiet:?}");
        assert!((quiet.half_span - 1.5 * TAU / 8.0).abs() < 1e-12);
        assert_eq!(quiet.pressure, 0.0);
    }

    #[test]
    fn a_wide_hole_feels_what_is_beside_the_mid_plane() {
        let map = map(|i, j| {
            if i == 2 && j == 1 {
                0.0
            } else {
                1e6 * (1 + i) as f64
            }
        });
        let small = patches(&map, 1e-4);
        let wide = patches(&map, 0.012);
        assert_eq!((small[2], wide[2]), (0.0, 3e6));
    }

    #[test]
    fn an_even_load_is_quiet_everywhere() {
        let map = map(|_, _| 2e6);
        let quiet = least_loaded(&map, &patches(&map, 1e-4)).unwrap();
        assert!((quiet.half_span - PI).abs() < 1e-12);
    }
}
