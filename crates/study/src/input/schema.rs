//! What a key of the study file is: its kind, range, default, meaning. The keys themselves are in
//! one table, [`KEYS`](super::keys::KEYS); reading, suggestions, `explain` and the JSON schema all
//! come from it, so that none of them can disagree.

use super::keys::KEYS;
use super::units::Dimension;
use std::fmt;

/// One key of the study file.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Dotted path, such as `bearing.diameter`. Elements of a list have no index.
    pub path: &'static str,
    /// What its value is.
    pub kind: Kind,
    /// Whether it must be given.
    pub presence: Presence,
    /// Studies that read it.
    pub used_by: &'static [Mode],
    /// What it means, in one line.
    pub meaning: &'static str,
    /// Typical values, for `explain`.
    pub typical: &'static str,
}

impl Key {
    /// Last part of the path.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.path.rsplit('.').next().unwrap_or(self.path)
    }

    /// Path of the table that holds the key; empty at the top.
    #[must_use]
    pub fn section(&self) -> &'static str {
        self.path
            .rsplit_once('.')
            .map_or("", |(section, _)| section)
    }

    /// The first of the typical values, as it would be written in the file.
    #[must_use]
    pub fn example(&self) -> Option<&'static str> {
        let quoted = self
            .typical
            .strip_prefix('"')
            .and_then(|rest| rest.find('"'));
        match quoted {
            Some(end) => self.typical.get(..end + 2),
            None => (self.typical.starts_with(['[', '{']) || self.typical.parse::<f64>().is_ok())
                .then_some(self.typical),
        }
    }

    /// The release reads it.
    #[must_use]
    pub fn is_built(&self) -> bool {
        !matches!(self.kind, Kind::NotBuilt)
    }
}

/// What the value of a key is.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// `[section]`.
    Table,
    /// `[[section]]`, one or more.
    TableList,
    /// `[section]`, or `[[section]]` where the study has several.
    TableOrList,
    /// Free text.
    Text,
    /// `true` or `false`.
    Flag,
    /// A whole number between two bounds.
    Integer(i64, i64),
    /// A dimensionless number.
    Number(Range),
    /// A number with a unit, as text.
    Quantity(Dimension, Range),
    /// A quantity, or a table that gives a law instead.
    QuantityOrLaw(Dimension, Range),
    /// Two quantities, along X and Y.
    Pair(Dimension, Range),
    /// One quantity or more.
    List(Dimension, Range),
    /// One whole number or more, each between two bounds.
    Integers(i64, i64),
    /// One bare number or more.
    Numbers(Range),
    /// The path of a file, or several.
    Files,
    /// Cells around and along the axis.
    Grid,
    /// One of these words; the second list is planned, and refused by name.
    Choice(&'static [&'static str], &'static [&'static str]),
    /// Some of these words.
    Words(&'static [&'static str]),
    /// A design limit: `{ value = "..", source = ".." }`.
    Limit(Dimension, Range),
    /// Keys of a base study, each with its values.
    Vary,
    /// Planned, and refused by name.
    NotBuilt,
}

/// Whether a key must be given in the studies that read it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presence {
    /// Always.
    Required,
    /// It may be left out.
    Optional,
    /// Left out, it has this value, as it would be written in the file (text without its quotes).
    Default(&'static str),
}

/// What a study does, as far as keys differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// One film in SI.
    Film,
    /// One film in the dimensionless form of the Reynolds equation.
    Dimensionless,
    /// Position under a constant load.
    Equilibrium,
    /// Stiffness and damping at that position.
    Coefficients,
    /// Journal orbit.
    LoadCycle,
    /// Every bearing of an engine.
    Engine,
    /// Every bearing of a shaft with given loads.
    Shaft,
    /// Films solved before, stored to be looked up.
    Database,
    /// Many cases of a base study.
    Sweep,
}

impl Mode {
    /// As in `analysis = ".."`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Film => "film",
            Self::Dimensionless => "film (dimensionless)",
            Self::Equilibrium => "equilibrium",
            Self::Coefficients => "coefficients",
            Self::LoadCycle => "load-cycle",
            Self::Engine => "engine",
            Self::Shaft => "shaft",
            Self::Database => "database",
            Self::Sweep => "sweep",
        }
    }

    /// The study is one of several bearings.
    #[must_use]
    pub const fn is_machine(self) -> bool {
        matches!(self, Self::Engine | Self::Shaft)
    }

    /// The journals run over a cycle.
    #[must_use]
    pub const fn is_cyclic(self) -> bool {
        matches!(self, Self::LoadCycle | Self::Engine | Self::Shaft)
    }
}

/// Smallest and largest number of cells: around, along the axis.
pub const GRID_LIMITS: [[i64; 2]; 2] = [[8, 4096], [2, 2048]];

/// Allowed range of a number, in the unit it is best shown in.
#[derive(Debug, Clone, Copy)]
pub struct Range {
    /// Lower bound; `-inf` without one.
    pub low: f64,
    /// The lower bound itself is not allowed.
    pub low_is_open: bool,
    /// Upper bound, allowed; `inf` without one.
    pub high: f64,
    /// Unit of the bounds; empty for dimensionless numbers.
    pub unit: &'static str,
}

impl Range {
    /// Every finite number.
    pub const ANY: Self = Self::between(f64::NEG_INFINITY, f64::INFINITY, "");

    /// Both bounds allowed.
    #[must_use]
    pub const fn between(low: f64, high: f64, unit: &'static str) -> Self {
        Self {
            low,
            low_is_open: false,
            high,
            unit,
        }
    }

    /// More than the lower bound, up to the upper.
    #[must_use]
    pub const fn above(low: f64, high: f64, unit: &'static str) -> Self {
        Self {
            low,
            low_is_open: true,
            high,
            unit,
        }
    }

    /// Whether an SI value lies in the range.
    #[must_use]
    pub fn contains(&self, value: f64, dimension: Option<Dimension>) -> bool {
        let bound = |bound: f64| match dimension {
            Some(dimension) if bound.is_finite() => {
                dimension.to_si(bound, self.unit).unwrap_or(bound)
            }
            _ => bound,
        };
        let (low, high) = (bound(self.low), bound(self.high));
        let above = if self.low_is_open {
            value > low
        } else {
            value >= low
        };
        above && value <= high
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = if self.unit.is_empty() {
            String::new()
        } else {
            format!(" {}", self.unit)
        };
        let low = if self.low_is_open {
            "more than"
        } else {
            "at least"
        };
        match (self.low.is_finite(), self.high.is_finite()) {
            (true, true) => write!(f, "{low} {}{unit}, at most {}{unit}", self.low, self.high),
            (true, false) => write!(f, "{low} {}{unit}", self.low),
            (false, true) => write!(f, "at most {}{unit}", self.high),
            (false, false) => write!(f, "any number"),
        }
    }
}

/// The key with this path.
#[must_use]
pub fn find(path: &str) -> Option<&'static Key> {
    KEYS.iter().find(|key| key.path == path)
}

/// Keys directly inside a section.
pub fn children(section: &str) -> impl Iterator<Item = &'static Key> {
    KEYS.iter().filter(move |key| key.section() == section)
}

/// The valid key a user most likely meant by an unknown path: the nearest name in the same section,
/// else the same or nearly the same name elsewhere.
#[must_use]
pub fn nearest(path: &str) -> Option<&'static Key> {
    let (section, name) = path.rsplit_once('.').unwrap_or(("", path));
    nearest_by_name(children(section), name, slip(name))
        .or_else(|| nearest_by_name(KEYS.iter(), name, 1))
}

/// Letters that may differ in a slip of the pen: a third of the word, two for swapped letters.
fn slip(text: &str) -> usize {
    (text.chars().count() / 3).max(2)
}

/// The key with the nearest name, if no more than `most` letters differ.
fn nearest_by_name(
    keys: impl Iterator<Item = &'static Key>,
    name: &str,
    most: usize,
) -> Option<&'static Key> {
    keys.map(|key| (edit_distance(key.name(), name), key))
        .filter(|&(distance, _)| distance <= most)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, key)| key)
}

/// The nearest of some words, if near enough to be a slip of the pen.
#[must_use]
pub fn nearest_word(words: &[&'static str], text: &str) -> Option<&'static str> {
    words
        .iter()
        .map(|&word| (edit_distance(word, text), word))
        .filter(|&(distance, _)| distance <= slip(text))
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, word)| word)
}

/// The words that are near enough to be meant, the nearest first: slips of the pen, then words that
/// hold the text or are held by it.
#[must_use]
pub fn nearest_of<'w>(words: &[&'w str], text: &str) -> Vec<&'w str> {
    const MOST: usize = 3;
    let text = text.trim().to_lowercase();
    let mut near: Vec<(usize, &str)> = words
        .iter()
        .map(|&word| (edit_distance(word, &text), word))
        .filter(|&(distance, word)| {
            let overlaps = !text.is_empty() && (word.contains(&text) || text.contains(word));
            distance <= slip(&text) || overlaps
        })
        .collect();
    near.sort_by_key(|&(distance, _)| distance);
    near.into_iter().take(MOST).map(|(_, word)| word).collect()
}

/// Fewest insertions, deletions and replacements of letters between two words (Levenshtein).
fn edit_distance(a: &str, b: &str) -> usize {
    // Longer words cannot be near any key, and the product of the lengths is the work.
    const LONGEST: usize = 64;
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    if a.len().max(b.len()) > LONGEST {
        return usize::MAX;
    }
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let replace = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = replace.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_sits_in_a_section_of_the_table() {
        for key in KEYS {
            let section = key.section();
            assert!(
                section.is_empty() || find(section).is_some(),
                "{}",
                key.path
            );
            assert_eq!(
                KEYS.iter().filter(|k| k.path == key.path).count(),
                1,
                "{}",
                key.path
            );
            assert!(!key.meaning.is_empty(), "{}", key.path);
        }
    }

    #[test]
    fn slips_of_the_pen_find_their_key() {
        let found = |path| nearest(path).map(|key| key.path);
        assert_eq!(found("bearing.diametre"), Some("bearing.diameter"));
        assert_eq!(found("bearing.widht"), Some("bearing.width"));
        assert_eq!(found("bearing.grid"), Some("film.grid"));
        assert_eq!(found("bearing.xyzzy"), None);
        assert_eq!(found("bering"), Some("bearing"));
    }

    #[test]
    fn ranges_in_their_own_unit() {
        let range = Range::above(0.0, 10.0, "mm");
        assert!(range.contains(0.01, Some(Dimension::Length)));
        assert!(!range.contains(0.0, Some(Dimension::Length)));
        assert_eq!(range.to_string(), "more than 0 mm, at most 10 mm");
    }
}
