//! Builds a table of an aligned film, B/D 0.5, and holds it against films solved at fresh random states:
//! `fresh_states CLOSURE TARGET STATES SEED...`, so many states of each seed; exits with 1 where a bar is missed.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use sommerfeld_database::{CheckReport, DatabaseError, Recipe, check, generate};
use sommerfeld_film::Cavitation;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

/// Bars of the derivatives: against central differences of the table, and of 99 % of the states against
/// those of the solved film.
const DIFFERENCE: f64 = 1e-6;
const TANGENT: f64 = 1e-2;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((recipe, states, seeds)) = read(&arguments) else {
        eprintln!("fresh_states gumbel|reynolds TARGET STATES SEED...");
        return ExitCode::from(2);
    };
    match run(&recipe, states, &seeds) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn read(arguments: &[String]) -> Option<(Recipe, usize, Vec<u64>)> {
    let [closure, target, states, seeds @ ..] = arguments else {
        return None;
    };
    let closure = match closure.as_str() {
        "gumbel" => Cavitation::Gumbel,
        "reynolds" => Cavitation::Reynolds,
        _ => return None,
    };
    let recipe = Recipe {
        target: target.parse().ok()?,
        ..Recipe::new(closure, 0.5)
    };
    let seeds: Result<Vec<u64>, _> = seeds.iter().map(|seed| seed.parse()).collect();
    let seeds = seeds.ok().filter(|seeds| !seeds.is_empty())?;
    Some((recipe, states.parse().ok()?, seeds))
}

fn run(recipe: &Recipe, states: usize, seeds: &[u64]) -> Result<bool, DatabaseError> {
    let begun = Instant::now();
    let table = Arc::new(generate(recipe, &(), None)?);
    println!(
        "# {} {:e}: nodes {:?} in {:.1} s, stated {:.2e}",
        recipe.closure_name(),
        recipe.target,
        table.axes().counts(),
        begun.elapsed().as_secs_f64(),
        table.errors().maximum
    );
    println!(
        "seed,states,error_maximum,error_quantile_999,error_median,difference_maximum,tangent_quantile_99,\
         dissipation_minimum,peak_error_maximum,by_rings,by_rings_error_maximum,seconds"
    );
    let mut kept = true;
    for seed in seeds {
        let begun = Instant::now();
        let found: CheckReport = check(&table, states, *seed)?;
        println!(
            "{seed},{},{:.3e},{:.3e},{:.3e},{:.1e},{:.2e},{:.3e},{:.2e},{},{:.3e},{:.0}",
            found.samples,
            found.maximum,
            found.quantile_999,
            found.median,
            found.difference_maximum,
            found.tangent_quantile_99,
            found.dissipation_minimum,
            found.peak_maximum,
            found.independent,
            found.independent_maximum,
            begun.elapsed().as_secs_f64()
        );
        let (worst, peak) = (&found.worst, &found.peak_worst);
        println!(
            "# largest error at eccentricity {:.6}, {:.2} deg; of peak pressure at {:.6}, {:.2} deg",
            worst.eccentricity,
            worst.angle.to_degrees(),
            peak.eccentricity,
            peak.angle.to_degrees()
        );
        kept &= found.maximum <= recipe.target
            && found.difference_maximum <= DIFFERENCE
            && found.tangent_quantile_99 <= TANGENT
            && found.dissipation_minimum >= 0.0;
    }
    Ok(kept)
}
