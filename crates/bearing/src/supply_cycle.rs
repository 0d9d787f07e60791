//! At which pressure is each feed supplied at any crank angle?
//!
//! A table of the load cycle says so for its feed, linear between rows and periodic; feeds without a
//! table keep the pressure of the conditions or of the bearing.

use crate::{LoadCycle, PressureCycle};
use sommerfeld_film::{Bearing, Conditions, FilmError};

/// The conditions of the film over the crank angle.
#[derive(Debug, Clone)]
pub struct SupplyCycle<'a> {
    constant: Conditions<'a>,
    tables: &'a [PressureCycle],
    period: f64,
    /// Per feed, Pa.
    pressures: Vec<f64>,
}

impl<'a> SupplyCycle<'a> {
    /// The supply of `bearing` over a load cycle; feeds without a table keep what `constant` says.
    ///
    /// # Errors
    /// [`FilmError::Unsupported`] for a table of a feed that the bearing has not, or one that is
    /// empty, not sorted, not finite or longer than the period.
    pub fn new(
        bearing: &Bearing,
        cycle: &'a LoadCycle,
        constant: &Conditions<'a>,
    ) -> Result<Self, FilmError> {
        let given = constant.feed_pressures.unwrap_or_default();
        let pressures = bearing.feeds.iter().enumerate();
        let pressures: Vec<f64> = pressures
            .map(|(index, feed)| given.get(index).copied().unwrap_or(feed.pressure))
            .collect();
        for table in &cycle.feed_pressures {
            check(table, cycle.period, pressures.len())?;
        }
        Ok(Self {
            constant: *constant,
            tables: &cycle.feed_pressures,
            period: cycle.period,
            pressures,
        })
    }

    /// Conditions at a crank angle (rad, any turn).
    pub fn at(&mut self, crank_angle: f64) -> Conditions<'_> {
        if self.tables.is_empty() {
            return self.constant;
        }
        for table in self.tables {
            self.pressures[table.feed] = table.at(crank_angle, self.period);
        }
        Conditions {
            feed_pressures: Some(&self.pressures),
            ..self.constant
        }
    }
}

fn check(table: &PressureCycle, period: f64, feeds: usize) -> Result<(), FilmError> {
    let refuse = |reason| Err(FilmError::Unsupported { reason });
    if table.feed >= feeds {
        return refuse("a pressure table belongs to a feed that the bearing has not");
    }
    let (Some(first), Some(last)) = (table.points.first(), table.points.last()) else {
        return refuse("the pressure table of a feed has no rows");
    };
    let sorted = table.points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
    let finite = table.points.iter().flatten().all(|value| value.is_finite());
    if !finite || !sorted || last[0] - first[0] >= period {
        return refuse(
            "the rows of a pressure table must be finite, rise in crank angle and span less than a \
             period",
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> PressureCycle {
        PressureCycle {
            feed: 0,
            points: vec![[-1.0, 2e5], [1.0, 4e5], [2.0, 1e5]],
        }
    }

    #[test]
    fn pressures_are_linear_and_periodic() {
        let period = 5.0;
        for (angle, pressure) in [(-1.0, 2e5), (0.0, 3e5), (1.5, 2.5e5), (3.0, 1.5e5)] {
            for turn in [-1.0, 0.0, 3.0] {
                let found = table().at(angle + turn * period, period);
                assert!((found - pressure).abs() < 1e-6, "{angle} {turn}: {found}");
            }
        }
        // 2 x 3 + 1 x 2.5 + 2 x 1.5 bar over 5.
        assert!((table().mean(period) - 2.3e5).abs() < 1e-6);
        assert!(!table().is_constant());
    }

    #[test]
    fn one_row_is_constant_and_bad_tables_are_refused() {
        let mut table = table();
        assert!(check(&table, 5.0, 1).is_ok());
        assert!(check(&table, 3.0, 1).is_err() && check(&table, 5.0, 0).is_err());
        table.points.swap(0, 1);
        assert!(check(&table, 5.0, 1).is_err());
        table.points.truncate(1);
        assert!(table.is_constant() && table.at(17.0, 5.0) == 4e5 && table.mean(5.0) == 4e5);
        table.points.clear();
        assert!(check(&table, 5.0, 1).is_err());
    }
}
