//! Builds a small table of an aligned film and writes it: `aligned_table FILE`.
#![allow(clippy::print_stdout)]

use sommerfeld_database::{DatabaseError, Recipe, generate};
use sommerfeld_film::Cavitation;
use std::path::Path;

fn main() -> Result<(), DatabaseError> {
    let file = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "aligned.h5".to_owned());
    let recipe = Recipe {
        target: 5e-3,
        samples: 100,
        ..Recipe::new(Cavitation::Gumbel, 0.5)
    };
    let table = generate(&recipe, &(), None)?;
    table.save(Path::new(&file))?;
    println!("{file}: {:?}", table.errors());
    Ok(())
}
