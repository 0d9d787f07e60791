//! Long fields as short text: numbers rounded to whole steps, their bytes in base64.
//!
//! Seventy frames of a film are some hundred thousand numbers. Written as decimals they would be
//! most of the page; in whole steps of a 65534th of their range they are a tenth of it, and the eye
//! sees no difference. The script turns them back into numbers.

use serde_json::{Value, json};

/// Steps into which the range of a field is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Depth {
    /// 254 steps, one byte: for a share between 0 and 1.
    Byte,
    /// 65534 steps, two bytes: for what is read off.
    Word,
}

/// `values` for the script: the first step, the size of a step, and the number of steps of each
/// value as base64; the highest code stands for what is not finite.
pub(super) fn packed(values: &[f64], depth: Depth) -> Value {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let low = finite().fold(f64::INFINITY, f64::min);
    let high = finite().fold(f64::NEG_INFINITY, f64::max);
    let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
    let missing: u16 = match depth {
        Depth::Byte => u16::from(u8::MAX),
        Depth::Word => u16::MAX,
    };
    let step = (high - low) / f64::from(missing - 1);
    let codes = values.iter().map(|value| {
        if !value.is_finite() {
            missing
        } else if step > 0.0 {
            ((value - low) / step).round() as u16
        } else {
            0
        }
    });
    let bytes: Vec<u8> = match depth {
        Depth::Byte => codes.map(|code| code.to_le_bytes()[0]).collect(),
        Depth::Word => codes.flat_map(u16::to_le_bytes).collect(),
    };
    json!({
        "low": low,
        "step": step,
        "bytes": match depth { Depth::Byte => 1, Depth::Word => 2 },
        "data": base64(&bytes),
    })
}

/// Base64 of RFC 4648 with padding.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let whole = group
            .iter()
            .chain([&0, &0])
            .take(3)
            .fold(0u32, |whole, byte| whole << 8 | u32::from(*byte));
        for place in 0..4 {
            let letter = LETTERS[(whole >> (18 - 6 * place) & 63) as usize];
            let is_padding = place > group.len();
            text.push(if is_padding { '=' } else { char::from(letter) });
        }
    }
    text
}

/// What a block of cells keeps of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keep {
    /// The largest: a peak stays.
    Largest,
    /// The smallest: the thinnest film stays.
    Smallest,
    /// The mean.
    Mean,
}

/// The cells of a grid gathered into blocks few enough to draw; blocks of one cell where the grid
/// is small.
#[derive(Debug)]
pub(super) struct Blocks {
    /// Cells around of each block, by ascending angle.
    around: Vec<Vec<usize>>,
    /// Cells along the axis of each block.
    along: Vec<Vec<usize>>,
    /// Cells along the axis of the grid.
    columns: usize,
    /// Cells in a whole block, around and along.
    pub size: [usize; 2],
}

impl Blocks {
    /// Blocks over a grid with cells at `angles` (deg, any order) and `columns` cells along the
    /// axis, at most `most` around and along.
    pub fn of(angles: &[f64], columns: usize, most: [usize; 2]) -> Self {
        let mut order: Vec<usize> = (0..angles.len()).collect();
        order.sort_by(|&a, &b| angles[a].total_cmp(&angles[b]));
        let size = [
            angles.len().div_ceil(most[0]).max(1),
            columns.div_ceil(most[1]).max(1),
        ];
        let along: Vec<usize> = (0..columns).collect();
        Self {
            around: order.chunks(size[0]).map(<[usize]>::to_vec).collect(),
            along: along.chunks(size[1]).map(<[usize]>::to_vec).collect(),
            columns,
            size,
        }
    }

    /// Whether a block is more than a cell.
    pub fn is_coarser(&self) -> bool {
        self.size != [1, 1]
    }

    /// Middles of the blocks around, from the angles of the cells.
    pub fn middles_around(&self, angles: &[f64]) -> Vec<f64> {
        middles(&self.around, angles)
    }

    /// Middles of the blocks along the axis, from the places of the cells.
    pub fn middles_along(&self, axial: &[f64]) -> Vec<f64> {
        middles(&self.along, axial)
    }

    /// One value per block, row by row along the axis, each row around.
    pub fn gather(&self, values: &[f64], keep: Keep) -> Vec<f64> {
        let mut gathered = Vec::with_capacity(self.around.len() * self.along.len());
        for along in &self.along {
            for around in &self.around {
                let cells = around.iter().flat_map(|i| {
                    along.iter().map(move |j| {
                        let value = values.get(i * self.columns + j);
                        value.copied().unwrap_or(f64::NAN)
                    })
                });
                gathered.push(match keep {
                    Keep::Largest => cells.fold(f64::NAN, f64::max),
                    Keep::Smallest => cells.fold(f64::NAN, f64::min),
                    Keep::Mean => cells.sum::<f64>() / (around.len() * along.len()) as f64,
                });
            }
        }
        gathered
    }
}

fn middles(groups: &[Vec<usize>], places: &[f64]) -> Vec<f64> {
    groups
        .iter()
        .map(|group| group.iter().map(|&i| places[i]).sum::<f64>() / group.len() as f64)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_the_standard() {
        let pairs = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, coded) in pairs {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn a_packed_field_keeps_its_ends_and_its_gaps() {
        let packed = packed(&[1.0, f64::NAN, 3.0], Depth::Byte);
        assert_eq!(packed["low"], 1.0);
        assert_eq!(packed["data"], base64(&[0, 255, 254]));
        assert!((packed["step"].as_f64().unwrap_or(0.0) * 254.0 - 2.0).abs() < 1e-12);
    }

    #[test]
    fn an_even_field_has_no_steps() {
        assert_eq!(packed(&[2.0, 2.0], Depth::Word)["data"], base64(&[0; 4]));
        assert_eq!(packed(&[f64::NAN], Depth::Word)["low"], 0.0);
    }

    #[test]
    fn blocks_keep_what_matters() {
        // Four cells around, not in order, and two along.
        let angles = [270.0, 0.0, 90.0, 180.0];
        let values = [7.0, 8.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let blocks = Blocks::of(&angles, 2, [2, 1]);
        assert!(blocks.is_coarser());
        assert_eq!(blocks.middles_around(&angles), [45.0, 225.0]);
        assert_eq!(blocks.gather(&values, Keep::Largest), [4.0, 8.0]);
        assert_eq!(blocks.gather(&values, Keep::Smallest), [1.0, 5.0]);
        assert_eq!(blocks.gather(&values, Keep::Mean), [2.5, 6.5]);
    }

    #[test]
    fn a_small_grid_stays_as_it_is() {
        let blocks = Blocks::of(&[0.0, 180.0], 2, [160, 40]);
        assert!(!blocks.is_coarser());
        assert_eq!(
            blocks.gather(&[1.0, 2.0, 3.0, 4.0], Keep::Mean),
            [1.0, 3.0, 2.0, 4.0]
        );
    }
}
