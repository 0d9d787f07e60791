//! The gas of the 2.0 l inline four of `examples/05-inline-four-gasoline`, generated anew.
//!
//! `cargo test -p sommerfeld-engine --test open_engine -- --nocapture` prints the rows of its `gas.csv`.
#![allow(clippy::unwrap_used, clippy::panic)]

use sommerfeld_engine::{
    Chamber, Combustion, GasExchange, GeneratedCycle, HeatRatio, HeatRelease, Strokes, WallHeat,
    Wiebe, Woschni,
};
use sommerfeld_film::Outcome;
use std::f64::consts::PI;

const DEGREE: f64 = PI / 180.0;

fn rows(file: &str) -> Vec<Vec<f64>> {
    let directory = "../../examples/05-inline-four-gasoline";
    let path = format!("{}/{directory}/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect()
}

fn combustion(row: &[f64]) -> Combustion {
    let &[_, intake, temperature, exhaust, heat, start, duration] = row else {
        panic!("seven columns: {row:?}");
    };
    Combustion {
        chamber: Chamber {
            bore: 0.086,
            crank_radius: 0.043,
            rod_length: 0.145,
            pin_offset: 0.0,
            compression_ratio: 10.5,
        },
        strokes: Strokes::Four,
        gas_exchange: GasExchange {
            intake_closes: -140.0 * DEGREE,
            exhaust_opens: 130.0 * DEGREE,
            intake_pressure: intake * 1e5,
            intake_temperature: temperature,
            exhaust_pressure: exhaust * 1e5,
            blow_down: 70.0 * DEGREE,
            overlap: 40.0 * DEGREE,
        },
        heat_release: HeatRelease::single(
            heat,
            Wiebe {
                start: start * DEGREE,
                duration: duration * DEGREE,
                efficiency: 5.0,
                exponent: 3.0,
            },
        ),
        heat_ratio: HeatRatio::Falling {
            at_300_kelvin: 1.38,
            per_kelvin: 8e-5,
            lowest: 1.2,
        },
        wall_heat: WallHeat::Woschni(Woschni {
            swirl: 0.0,
            combustion: 3.24e-3,
            head_temperature: 480.0,
            piston_temperature: 520.0,
            liner_temperature: 410.0,
            head_area_ratio: 1.15,
            piston_area_ratio: 1.05,
        }),
    }
}

fn shown(speed: f64, cycle: &GeneratedCycle) -> Vec<String> {
    vec![
        format!("{speed}"),
        format!("{:.3}", cycle.mean_effective_pressure / 1e5),
        format!("{:.2}", cycle.peak[1] / 1e5),
        format!("{:.2}", cycle.peak[0] / DEGREE),
        format!("{:.0}", cycle.highest_temperature),
        format!("{:.1}", 100.0 * cycle.wall_heat / cycle.heat_released),
    ]
}

#[test]
fn the_committed_figures_come_from_the_generator() {
    let rows_of_gas = rows("gas.csv");
    let rows_of_combustion = rows("combustion.csv");
    assert_eq!(rows_of_gas.len(), rows_of_combustion.len());
    for (row, expected) in rows_of_combustion.iter().zip(rows_of_gas) {
        let cycle = combustion(row).cycle(row[0] * PI / 30.0, 1440).unwrap();
        assert_eq!(cycle.outcome, Outcome::Converged, "{}", cycle.error);
        let found = shown(row[0], &cycle);
        println!("{}", found.join(","));
        let found: Vec<f64> = found.iter().map(|cell| cell.parse().unwrap()).collect();
        assert_eq!(found, expected);
    }
}

#[test]
fn it_is_a_plausible_engine() {
    for row in rows("combustion.csv") {
        let cycle = combustion(&row).cycle(row[0] * PI / 30.0, 720).unwrap();
        let mean = cycle.mean_effective_pressure / 1e5;
        assert!((9.0..14.0).contains(&mean), "{row:?}: {mean} bar");
        let [angle, peak] = cycle.peak;
        assert!((8.0..20.0).contains(&(angle / DEGREE)), "{row:?}: {angle}");
        assert!((45e5..90e5).contains(&peak), "{row:?}: {peak}");
        assert!(
            (2200.0..2900.0).contains(&cycle.highest_temperature),
            "{row:?}: {}",
            cycle.highest_temperature
        );
    }
}
