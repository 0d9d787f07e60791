//! Prints how far stiffness and damping of a bearing with two axial grooves are from the table in
//! validation/dynamic-coefficients/someya.csv, whose grooves are not described: there is no bar.
//!
//! `cargo run -p sommerfeld-bearing --example someya_table`
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use sommerfeld_bearing::{Coefficients, EquilibriumRequest, EquilibriumSettings, find_equilibrium};
use sommerfeld_film::{
    Bearing, Carrier, Cavitation, Conditions, Ends, Feed, FeedLine, FeedShape, FilmShear,
    FilmSolver, Inlet, JournalState, Shape,
};
use sommerfeld_oil::Lubricant;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Assumed arc of each groove, rad, and share of the width.
const ARC: f64 = 10.0 * TAU / 360.0;
const SHARE: f64 = 1.0;

fn main() {
    let (diameter, speed, viscosity) = (0.1, 200.0, 0.01);
    let conditions = Conditions {
        temperature: 313.0,
        feed_pressures: None,
    };
    let path = format!(
        "{}/../../validation/dynamic-coefficients/someya.csv",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(path).unwrap();
    println!("| eps | here | attitude [deg] | here | K off | C off |\n|---|---|---|---|---|---|");
    for line in text
        .lines()
        .filter(|line| line.starts_with("two_axial_groove"))
    {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |column: usize| cells[column].trim().parse::<f64>().unwrap();
        let width = diameter * number(1);
        let groove = |angle: f64| Feed {
            shape: FeedShape::Rectangle {
                length: 0.5 * diameter * ARC,
                width: SHARE * width,
            },
            carried_by: Carrier::Shell,
            angle,
            position: 0.0,
            pressure: 0.0,
            line: FeedLine::Direct,
        };
        let bearing = Bearing {
            diameter,
            width,
            radial_clearance: 50e-6,
            bore: Shape::cylindrical(),
            journal: Shape::cylindrical(),
            feeds: vec![groove(FRAC_PI_2), groove(-FRAC_PI_2)],
            ambient_pressure: 0.0,
            cavitation_pressure: 0.0,
            ends: Ends::Air,
            inlet: Inlet::Cyclic,
            cavitation: Cavitation::Reynolds,
            film_shear: FilmShear::FullWidth,
            finish: sommerfeld_film::Finish::Smooth,
            elasticity: sommerfeld_film::Elasticity::Rigid,
        };
        // S = eta N D B/W (R/c)^2 with N in revolutions.
        let turns = speed / TAU;
        let load = viscosity * turns * diameter * width
            / (number(3) * bearing.relative_clearance().powi(2));
        let oil = Lubricant::constant(viscosity, 850.0);
        let mut film = FilmSolver::new(&bearing, &oil, [256, 32]).unwrap();
        let request = EquilibriumRequest {
            load: [load, 0.0],
            moment: None,
            frame: JournalState {
                journal_speed: speed,
                ..JournalState::default()
            },
            start: None,
            settings: EquilibriumSettings::default(),
        };
        let found = find_equilibrium(&mut film, &bearing, &request, &conditions).unwrap();
        let coefficients = Coefficients::from_tangent(&found.tangent);
        let unit = bearing.radial_clearance / load;
        let off = |matrix: [[f64; 2]; 2], unit: f64, first: usize| {
            let expected: Vec<f64> = (first..first + 4).map(number).collect();
            let largest = expected.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            let pairs = matrix.iter().flatten().zip(&expected);
            let worst = pairs.fold(0.0_f64, |worst, (got, expected)| {
                worst.max((got * unit - expected).abs())
            });
            100.0 * worst / largest
        };
        println!(
            "| {} | {:.4} | {} | {:.1} | {:.1} % | {:.1} % |",
            cells[4],
            found.state.eccentricity() / bearing.radial_clearance,
            cells[5],
            found.attitude_angle(request.load).to_degrees(),
            off(coefficients.translation_stiffness(), unit, 9),
            off(coefficients.translation_damping(), unit * speed, 13),
        );
    }
}
