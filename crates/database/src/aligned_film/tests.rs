#![allow(clippy::unwrap_used)]
use super::*;
use sommerfeld_film::Cavitation;
use std::f64::consts::PI;
#[test]
fn build() {
    for (closure, target) in [
        (Cavitation::Gumbel, 1e-3),
        (Cavitation::Gumbel, 1e-4),
        (Cavitation::Reynolds, 1e-3),
        (Cavitation::Reynolds, 1e-4),
    ] {
        let recipe = crate::Recipe {
            target,
            ..crate::Recipe::new(closure, 0.5)
        };
        let begin = std::time::Instant::now();
        match crate::generate(&recipe, &(), None) {
            Ok(table) => {
                println!(
                    "{closure:?} {target} {:?} {:?} {:.1} s",
                    table.axes().counts(),
                    table.errors(),
                    begin.elapsed().as_secs_f64()
                );
                let begin = std::time::Instant::now();
                println!(
                    "{:?} {:.1} s",
                    crate::check(&std::sync::Arc::new(table), 400, 99),
                    begin.elapsed().as_secs_f64()
                );
            }
            Err(error) => println!(
                "{closure:?} {target} {error} {:.1} s",
                begin.elapsed().as_secs_f64()
            ),
        }
    }
}
