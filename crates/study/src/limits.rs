//! Named limits that a user sets for a result, and whether it keeps them.
//!
//! A limit is a number and the text of its source: the program judges only against what the user
//! wrote, it brings no limits of its own.

use serde::Serialize;

/// A result that can be limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Smallest film thickness, m; a lower limit.
    MinimumFilmThickness,
    /// Largest film pressure, Pa; an upper limit.
    PeakFilmPressure,
    /// Largest load over width times diameter, Pa; an upper limit.
    MaximumSpecificLoad,
    /// Power lost in the film, W (over a load cycle its mean); an upper limit.
    PowerLoss,
}

/// On which side of the limit a result must stay.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Not below the limit.
    AtLeast,
    /// Not above the limit.
    AtMost,
}

impl Quantity {
    /// Every quantity that can be limited.
    pub const ALL: [Self; 4] = [
        Self::MinimumFilmThickness,
        Self::PeakFilmPressure,
        Self::MaximumSpecificLoad,
        Self::PowerLoss,
    ];

    /// Its key in the study file's `[limits]`.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::MinimumFilmThickness => "minimum_film_thickness",
            Self::PeakFilmPressure => "peak_film_pressure",
            Self::MaximumSpecificLoad => "maximum_specific_load",
            Self::PowerLoss => "power_loss",
        }
    }

    /// The quantity of a study file's key.
    #[must_use]
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|quantity| quantity.key() == key)
    }

    /// SI unit of limit and result, as keys of results spell it.
    #[must_use]
    pub fn unit_suffix(self) -> &'static str {
        match self {
            Self::MinimumFilmThickness => "m",
            Self::PeakFilmPressure | Self::MaximumSpecificLoad => "pa",
            Self::PowerLoss => "w",
        }
    }

    /// The side on which a result must stay.
    #[must_use]
    pub fn side(self) -> Side {
        match self {
            Self::MinimumFilmThickness => Side::AtLeast,
            Self::PeakFilmPressure | Self::MaximumSpecificLoad | Self::PowerLoss => Side::AtMost,
        }
    }
}

/// A limit as the user set it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Limit {
    /// What is limited.
    pub quantity: Quantity,
    /// The limit in SI, unit of the quantity.
    pub value: f64,
    /// Where the limit comes from, in the user's words.
    pub source: String,
}

/// How a result stands against a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The result keeps the limit.
    Ok,
    /// The result breaks the limit.
    Exceeded,
    /// The run gave no finite number to judge, or did not converge to the one it gave.
    NotEvaluated,
}

/// A limit with the result it was held against.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitCheck {
    /// The limit.
    pub limit: Limit,
    /// The result in SI, if the run gave one.
    pub found: Option<f64>,
    /// How they compare.
    pub verdict: Verdict,
    /// Of a machine: the bearing and the speed of the result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<String>,
}

impl LimitCheck {
    /// Holds a result against a limit; a value that is not finite is not judged.
    #[must_use]
    pub fn new(limit: Limit, found: Option<f64>) -> Self {
        let found = found.filter(|value| value.is_finite());
        let verdict = match (found, limit.quantity.side()) {
            (None, _) => Verdict::NotEvaluated,
            (Some(value), Side::AtLeast) if value >= limit.value => Verdict::Ok,
            (Some(value), Side::AtMost) if value <= limit.value => Verdict::Ok,
            _ => Verdict::Exceeded,
        };
        Self {
            limit,
            found,
            verdict,
            at: None,
        }
    }

    /// The same of a run that may not have converged: a limit that seems kept is then not judged.
    #[must_use]
    pub fn unless(mut self, not_converged: bool) -> Self {
        if not_converged && self.verdict == Verdict::Ok {
            self.verdict = Verdict::NotEvaluated;
        }
        self
    }

    /// Whether this result is further on the wrong side than another against the same limit.
    #[must_use]
    pub fn is_worse_than(&self, other: &Self) -> bool {
        match (self.found, other.found, self.limit.quantity.side()) {
            (Some(found), Some(other), Side::AtLeast) => found < other,
            (Some(found), Some(other), Side::AtMost) => found > other,
            (found, other, _) => found.is_none() && other.is_some(),
        }
    }
}

impl std::fmt::Display for LimitCheck {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let verdict = match self.verdict {
            Verdict::Ok => "OK",
            Verdict::Exceeded => "EXCEEDED",
            Verdict::NotEvaluated => "not evaluated",
        };
        let quantity = self.limit.quantity;
        let (factor, unit) = match quantity {
            Quantity::MinimumFilmThickness => (1e6, "um"),
            Quantity::PeakFilmPressure | Quantity::MaximumSpecificLoad => (1e-6, "MPa"),
            Quantity::PowerLoss => (1.0, "W"),
        };
        let side = match quantity.side() {
            Side::AtLeast => "at least",
            Side::AtMost => "at most",
        };
        // Without the round-off of the units.
        let value = (self.limit.value * factor * 1e6).round() / 1e6;
        write!(
            f,
            "limit: {} {side} {value} {unit} ({}): {verdict}",
            quantity.key().replace('_', " "),
            self.limit.source
        )?;
        match (&self.at, self.found) {
            (Some(at), Some(found)) => write!(f, ", {:.4} {unit} in {at}", found * factor),
            (Some(at), None) => write!(f, " in {at}"),
            (None, _) => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film_limit() -> Limit {
        Limit {
            quantity: Quantity::MinimumFilmThickness,
            value: 1e-6,
            source: "house rule".into(),
        }
    }

    #[test]
    fn each_side_is_judged() {
        let verdict = |found| LimitCheck::new(film_limit(), found).verdict;
        assert_eq!(verdict(Some(1e-6)), Verdict::Ok);
        assert_eq!(verdict(Some(0.9e-6)), Verdict::Exceeded);
        let upper = Limit {
            quantity: Quantity::PowerLoss,
            ..film_limit()
        };
        assert_eq!(LimitCheck::new(upper, Some(1.0)).verdict, Verdict::Exceeded);
    }

    #[test]
    fn what_is_not_a_number_is_not_judged() {
        let check = LimitCheck::new(film_limit(), Some(f64::NAN));
        assert_eq!((check.verdict, check.found), (Verdict::NotEvaluated, None));
    }

    #[test]
    fn a_check_reads_in_the_units_of_users() {
        let check = LimitCheck::new(film_limit(), Some(0.9e-6));
        assert_eq!(
            check.to_string(),
            "limit: minimum film thickness at least 1 um (house rule): EXCEEDED"
        );
    }

    #[test]
    fn keys_read_back() {
        for quantity in Quantity::ALL {
            assert_eq!(Quantity::from_key(quantity.key()), Some(quantity));
        }
    }
}
