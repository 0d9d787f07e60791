//! How finely the cycles of a page are drawn, so that the page stays small enough to send.
//!
//! One cycle has the page for itself and is drawn as computed, in numbers a reader may copy. Many
//! cycles share the room: their curves are packed and thinned, and fewer frames of the film are kept.

use super::figures::short;
use super::packing::{Depth, packed};
use serde_json::{Value, json};

/// Characters of a page that the data of all its cycles may take: what ten million leave beside the
/// drawing library, the text and the tables.
const ROOM: usize = 3_400_000;
/// Curves of one cycle over crank angle, each of two bytes a point in base64.
const CURVES: usize = 22;
/// Characters that a value of two bytes takes.
const WORD: f64 = 8.0 / 3.0;
/// Characters of one block of a frame: two bytes of pressure, one each of film fraction and thickness.
const FRAME_BLOCK: f64 = 16.0 / 3.0;

/// From this many cycles on each shows only what matters most.
const CROWDED: usize = 40;

/// How finely a cycle is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Detail {
    /// Points of a curve over crank angle.
    pub curve_points: usize,
    /// Whether curves are packed.
    pub is_packed: bool,
    /// Whether there are so many cycles that each shows only what matters most.
    pub is_crowded: bool,
    /// Frames of the film.
    pub frames: usize,
    /// Blocks of a frame around and along.
    pub frame_blocks: [usize; 2],
    /// Steps of the pressure in a frame.
    pub frame_depth: Depth,
    /// Blocks around and along of a map of what the surfaces have seen.
    pub map_blocks: [usize; 2],
    /// Steps of the values of such a map.
    pub map_depth: Depth,
}

impl Detail {
    /// A cycle that has the page for itself.
    pub const ALONE: Self = Self {
        curve_points: super::figures::CURVE_POINTS,
        is_packed: false,
        is_crowded: false,
        frames: crate::results::MOST_FRAMES,
        // With two bytes for pressure and one each for film fraction and thickness, all frames are
        // 2.2 MB of text.
        frame_blocks: [144, 40],
        frame_depth: Depth::Word,
        map_blocks: [360, 96],
        map_depth: Depth::Word,
    };

    /// One of `cycles` that share a page, their films on at most `grid` cells around and along.
    pub fn of_many(cycles: usize, grid: [usize; 2]) -> Self {
        let room = ROOM as f64 / cycles.max(1) as f64;
        let curve_points = (0.45 * room / (CURVES as f64 * WORD)) as usize;
        let frame_blocks = [96, 24];
        let shown = [0, 1].map(|k| frame_blocks[k].min(grid[k]).max(1));
        let frame = FRAME_BLOCK * (shown[0] * shown[1]) as f64;
        let is_crowded = cycles > CROWDED;
        Self {
            curve_points: curve_points.clamp(180, 720),
            is_packed: true,
            is_crowded,
            // A few frames are no film of a cycle: then the worst instant stands alone.
            frames: match (0.45 * room / frame) as usize {
                0..6 => 1,
                frames => frames.min(36),
            },
            frame_blocks,
            frame_depth: if is_crowded { Depth::Byte } else { Depth::Word },
            map_blocks: if is_crowded { [64, 16] } else { [96, 24] },
            map_depth: Depth::Byte,
        }
    }

    /// The values of a curve for the script.
    pub fn numbers(&self, values: &[f64]) -> Value {
        if !self.is_packed {
            return values.iter().copied().map(short).collect();
        }
        let first = values.first().copied().unwrap_or(f64::NAN);
        if values.iter().all(|value| *value == first) {
            return json!({"even": short(first), "count": values.len()});
        }
        packed(values, Depth::Word)
    }

    /// Ascending places for the script: evenly spaced ones by the first, the step and their number.
    pub fn places(&self, places: &[f64]) -> Value {
        let (Some(first), Some(second)) = (places.first(), places.get(1)) else {
            return self.numbers(places);
        };
        let step = second - first;
        let is_even = places
            .iter()
            .enumerate()
            .all(|(i, place)| (first + step * i as f64 - place).abs() < 1e-6 * step.abs());
        if self.is_packed && is_even {
            return json!({"first": first, "step": step, "count": places.len()});
        }
        places.iter().copied().map(short).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_cycles_share_the_same_room() {
        let [few, many] = [13, 104].map(|cycles| Detail::of_many(cycles, [64, 16]));
        assert!(few.frames > 18 && few.curve_points > many.curve_points);
        assert_eq!(many.frames, 1);
        assert!(many.curve_points >= 240 && many.is_crowded);
    }

    #[test]
    fn an_even_curve_is_one_number() {
        let detail = Detail::of_many(13, [64, 16]);
        let even = detail.numbers(&[209.0; 3]);
        assert_eq!(even, json!({"even": 209.0, "count": 3}));
        assert!(detail.numbers(&[1.0, 2.0])["data"].is_string());
        assert!(Detail::ALONE.numbers(&[1.0, 2.0]).is_array());
    }
}
