//! What a table of an aligned film is built from.

use crate::contents::{Contents, Value};
use crate::error::DatabaseError;
use serde::{Deserialize, Serialize};
use sommerfeld_film::{Cavitation, Inlet};
use std::path::Path;

/// Everything that decides what a table holds. All of it is stored in the file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Recipe {
    /// Closure for the ruptured film: `gumbel` or `reynolds`. Mass conservation has a memory, which no
    /// table holds.
    pub closure: Cavitation,
    /// Where the film starts: cyclic.
    pub inlet: Inlet,
    /// Smallest and largest width over diameter; alike for a table of one bearing shape.
    pub width_ratios: [f64; 2],
    /// Largest error of the force over its size that samples may find, 1e-5 to 0.05.
    pub target: f64,
    /// Last relative eccentricity with nodes, 0.5 to 0.9999; beyond it the table goes on smoothly by
    /// powers of the gap.
    pub last_eccentricity: f64,
    /// States, drawn anew, at which the table is compared with films solved for it.
    pub samples: usize,
    /// Seed of those states.
    pub seed: u64,
}

impl Recipe {
    /// A table of one bearing shape that errs by 0.1 %.
    #[must_use]
    pub fn new(closure: Cavitation, width_ratio: f64) -> Self {
        Self {
            closure,
            inlet: Inlet::Cyclic,
            width_ratios: [width_ratio; 2],
            target: 1e-3,
            last_eccentricity: 0.999,
            samples: 400,
            seed: 1,
        }
    }

    /// Refuses what no table can be built for.
    ///
    /// # Errors
    /// [`DatabaseError::Unsupported`] for closures and inlets, [`DatabaseError::Recipe`] for numbers.
    pub fn check(&self) -> Result<(), DatabaseError> {
        if self.closure == Cavitation::MassConserving {
            return Err(DatabaseError::Unsupported {
                reason: "a mass-conserving film remembers its past, which no table holds: use cavitation \
                         = \"reynolds\" or \"gumbel\", or model = \"field\"",
            });
        }
        if self.inlet != Inlet::Cyclic {
            return Err(DatabaseError::Unsupported {
                reason: "a combined table holds films with inlet = \"cyclic\": a line at the widest gap \
                         has no place when the gap opens, nor a direction at eccentricity 0",
            });
        }
        let [narrow, wide] = self.width_ratios;
        let refused = |key, value: String, allowed| {
            Err(DatabaseError::Recipe {
                key,
                value,
                allowed,
            })
        };
        if !(narrow >= 0.05 && narrow <= wide && wide <= 4.0) {
            return refused(
                "width_ratios",
                format!("{:?}", self.width_ratios),
                "B/D from 0.05 to 4, the smaller one first",
            );
        }
        if !(1e-5..=0.05).contains(&self.target) {
            return refused("target", self.target.to_string(), "1e-5 to 0.05");
        }
        if !(0.5..=0.9999).contains(&self.last_eccentricity) {
            return refused(
                "last_eccentricity",
                self.last_eccentricity.to_string(),
                "0.5 to 0.9999",
            );
        }
        if !(100..=1_000_000).contains(&self.samples) {
            return refused("samples", self.samples.to_string(), "100 to 1000000");
        }
        Ok(())
    }

    /// Error up to which films are solved: a tenth of the target, and not more than the derivatives between
    /// the nodes bear.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        const COARSEST: f64 = 2e-5;
        (0.1 * self.target).min(COARSEST)
    }

    /// Name of the closure in files and study files.
    #[must_use]
    pub fn closure_name(&self) -> &'static str {
        match self.closure {
            Cavitation::Gumbel => "gumbel",
            Cavitation::Reynolds => "reynolds",
            Cavitation::MassConserving => "mass-conserving",
        }
    }

    /// Writes the recipe into attributes.
    pub(crate) fn store(&self, contents: &mut Contents) {
        contents.attribute("closure", Value::Text(self.closure_name().to_owned()));
        contents.attribute("inlet", Value::Text("cyclic".to_owned()));
        contents.attribute("width_ratios", Value::Numbers(self.width_ratios.to_vec()));
        contents.attribute("target", Value::Number(self.target));
        contents.attribute("last_eccentricity", Value::Number(self.last_eccentricity));
        contents.attribute("samples", Value::Integer(self.samples as i64));
        contents.attribute("seed", Value::Integer(self.seed.cast_signed()));
    }

    /// Reads what [`Recipe::store`] wrote.
    pub(crate) fn load(contents: &Contents, path: &Path) -> Result<Self, DatabaseError> {
        let wrong = |reason: String| DatabaseError::Contents {
            path: path.to_owned(),
            reason,
        };
        let closure = match contents.text(path, "closure")? {
            "gumbel" => Cavitation::Gumbel,
            "reynolds" => Cavitation::Reynolds,
            other => return Err(wrong(format!("its closure is {other}"))),
        };
        let width_ratios = match contents.attributes.get("width_ratios") {
            Some(Value::Numbers(pair)) if pair.len() == 2 => [pair[0], pair[1]],
            other => return Err(wrong(format!("its attribute width_ratios is {other:?}"))),
        };
        let recipe = Self {
            closure,
            inlet: Inlet::Cyclic,
            width_ratios,
            target: contents.number(path, "target")?,
            last_eccentricity: contents.number(path, "last_eccentricity")?,
            samples: contents.number(path, "samples")? as usize,
            seed: contents.integer(path, "seed")?.cast_unsigned(),
        };
        recipe
            .check()
            .map_err(|error| wrong(format!("its recipe is not valid: {error}")))?;
        Ok(recipe)
    }
}
