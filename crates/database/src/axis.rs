//! Nodes of a table along one quantity: even in a coordinate in which the film changes evenly.

use crate::error::DatabaseError;
use serde::{Deserialize, Serialize};

/// Coordinate in which the nodes of an axis are evenly spaced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Spacing {
    /// The value itself.
    Linear,
    /// `atanh(value)`: even towards 0, and in the logarithm of what is left towards 1.
    Atanh,
    /// `ln(value)`.
    Logarithmic,
    /// `ln((value + 1/20)/(1 - value))`: even in the logarithm of what is left towards 1 and of the value itself down
    /// to about 1/20, below which it is even in the value.
    ShiftedLogit,
}

/// Shift of [`Spacing::ShiftedLogit`].
const SHIFT: f64 = 0.05;

impl Spacing {
    /// Coordinate of a value.
    #[must_use]
    pub fn coordinate(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            // One logarithm: exact enough, as places are sums with the node's number.
            Self::Atanh => 0.5 * ((1.0 + value) / (1.0 - value)).ln(),
            Self::Logarithmic => value.ln(),
            Self::ShiftedLogit => ((value + SHIFT) / (1.0 - value)).ln(),
        }
    }

    /// Value at a coordinate.
    #[must_use]
    pub fn value(self, coordinate: f64) -> f64 {
        match self {
            Self::Linear => coordinate,
            Self::Atanh => coordinate.tanh(),
            Self::Logarithmic => coordinate.exp(),
            Self::ShiftedLogit => 1.0 - (1.0 + SHIFT) / (1.0 + coordinate.exp()),
        }
    }

    /// Derivative of the coordinate by the value.
    #[must_use]
    pub fn slope(self, value: f64) -> f64 {
        match self {
            Self::Linear => 1.0,
            Self::Atanh => 1.0 / ((1.0 - value) * (1.0 + value)),
            Self::Logarithmic => 1.0 / value,
            Self::ShiftedLogit => (1.0 + SHIFT) / ((value + SHIFT) * (1.0 - value)),
        }
    }

    /// Name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Atanh => "atanh",
            Self::Logarithmic => "logarithmic",
            Self::ShiftedLogit => "shifted-logit",
        }
    }
}

/// Evenly spaced nodes from `low` to `high` in the coordinate of a [`Spacing`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    spacing: Spacing,
    low: f64,
    high: f64,
    count: usize,
}

impl Axis {
    /// Nodes from the value `low` to the value `high`; a single node where `count` is 1, at `low`.
    ///
    /// # Errors
    /// [`DatabaseError::Recipe`] where the ends have no finite coordinate, do not rise, or there is no
    /// node.
    pub fn new(
        key: &'static str,
        spacing: Spacing,
        low: f64,
        high: f64,
        count: usize,
    ) -> Result<Self, DatabaseError> {
        let [start, end] = [low, high].map(|value| spacing.coordinate(value));
        let rises = start < end || (count == 1 && start == end);
        if !(start.is_finite() && end.is_finite() && rises && count > 0) {
            return Err(DatabaseError::Recipe {
                key,
                value: format!("{count} nodes from {low} to {high}"),
                allowed: "at least one node, between rising ends inside of the range of the quantity",
            });
        }
        Ok(Self {
            spacing,
            low,
            high,
            count,
        })
    }

    /// Number of nodes.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Coordinate in which the nodes are even.
    #[must_use]
    pub fn spacing(&self) -> Spacing {
        self.spacing
    }

    /// First and last value.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// Value at node `index`; the ends are what they were given as.
    #[must_use]
    pub fn value(&self, index: usize) -> f64 {
        if index == 0 {
            self.low
        } else if index + 1 >= self.count {
            self.high
        } else {
            self.at(index as f64)
        }
    }

    /// Value at a place counted in nodes, 0 at the first.
    #[must_use]
    pub fn at(&self, place: f64) -> f64 {
        let [start, end] = self.coordinates();
        let share = place / (self.count - 1).max(1) as f64;
        self.spacing.value(start + share * (end - start))
    }

    /// All values.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        (0..self.count).map(|index| self.value(index)).collect()
    }

    /// Place of a value counted in nodes (0 at the first; beyond the ends too) and its derivative by
    /// the value.
    #[must_use]
    pub fn place(&self, value: f64) -> (f64, f64) {
        self.placing().place(value)
    }

    /// What finds places quickly.
    #[must_use]
    pub fn placing(&self) -> Placing {
        let [start, end] = self.coordinates();
        let per_coordinate = if self.count == 1 {
            0.0
        } else {
            (self.count - 1) as f64 / (end - start)
        };
        Placing {
            spacing: self.spacing,
            start,
            per_coordinate,
        }
    }

    /// The same ends with a node in the middle of every two; nodes that were, stay.
    #[must_use]
    pub fn halved(&self) -> Self {
        Self {
            count: 2 * self.count - 1,
            ..*self
        }
    }

    fn coordinates(&self) -> [f64; 2] {
        [self.low, self.high].map(|value| self.spacing.coordinate(value))
    }
}

/// Places on an axis by arithmetic alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placing {
    spacing: Spacing,
    start: f64,
    per_coordinate: f64,
}

impl Placing {
    /// Place of a coordinate.
    #[inline]
    pub(crate) fn of_coordinate(&self, coordinate: f64) -> f64 {
        (coordinate - self.start) * self.per_coordinate
    }

    /// Derivative of the place by the coordinate.
    #[inline]
    pub(crate) fn per_coordinate(&self) -> f64 {
        self.per_coordinate
    }

    /// As [`Axis::place`].
    #[must_use]
    pub fn place(&self, value: f64) -> (f64, f64) {
        (
            (self.spacing.coordinate(value) - self.start) * self.per_coordinate,
            self.spacing.slope(value) * self.per_coordinate,
        )
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn places_and_values_are_each_others_inverse() {
        for (spacing, low, high) in [
            (Spacing::Linear, -1.0, 1.0),
            (Spacing::Atanh, 0.0, 0.999),
            (Spacing::Logarithmic, 0.2, 2.0),
            (Spacing::ShiftedLogit, 0.0, 0.99),
        ] {
            let axis = Axis::new("axis", spacing, low, high, 9).unwrap();
            for (index, value) in axis.values().into_iter().enumerate() {
                let (place, slope) = axis.place(value);
                assert!((place - index as f64).abs() < 1e-10, "{spacing:?} {index}");
                let step = 1e-6 * (1.0 - value.abs()).max(0.1);
                let inside = value.clamp(low + step, high - step);
                let ahead = axis.place(inside + step).0 - axis.place(inside - step).0;
                let slope = if inside == value {
                    slope
                } else {
                    axis.place(inside).1
                };
                assert!((ahead / (2.0 * step) - slope).abs() < 1e-4 * slope);
            }
            let fine = axis.halved();
            for index in 0..9 {
                assert!((fine.value(2 * index) - axis.value(index)).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn ends_without_a_coordinate_are_refused() {
        assert!(Axis::new("eps", Spacing::Atanh, 0.0, 1.0, 5).is_err());
        assert!(Axis::new("eps", Spacing::Linear, 1.0, 0.0, 5).is_err());
        assert!(Axis::new("eps", Spacing::Linear, 0.0, 1.0, 0).is_err());
        assert!(Axis::new("b_d", Spacing::Logarithmic, 0.5, 0.5, 1).is_ok());
    }
}
