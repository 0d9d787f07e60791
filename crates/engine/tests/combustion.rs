//! Generated cycles against closed forms, an independent quadrature and the first law.
#![allow(clippy::unwrap_used)]

mod printed;

use printed::rows_of;
use sommerfeld_engine::{
    Chamber, Combustion, CombustionError, CycleScales, GasExchange, GasInstant, HeatRatio,
    HeatRelease, Strokes, WallHeat, Wiebe, Woschni,
};
use sommerfeld_film::Outcome;
use std::f64::consts::{PI, TAU};

const DEGREE: f64 = PI / 180.0;

fn chamber() -> Chamber {
    Chamber {
        bore: 0.086,
        crank_radius: 0.043,
        rod_length: f64::INFINITY,
        pin_offset: 0.0,
        compression_ratio: 10.0,
    }
}

/// Air from dead centre to dead centre, adiabatic, ratio 1.4.
fn ideal(heat_release: HeatRelease) -> Combustion {
    Combustion {
        chamber: chamber(),
        strokes: Strokes::Four,
        gas_exchange: GasExchange {
            intake_closes: -PI,
            exhaust_opens: PI,
            intake_pressure: 1e5,
            intake_temperature: 300.0,
            exhaust_pressure: 1e5,
            blow_down: 60.0 * DEGREE,
            overlap: 20.0 * DEGREE,
        },
        heat_release,
        heat_ratio: HeatRatio::Constant(1.4),
        wall_heat: WallHeat::Adiabatic,
    }
}

/// A direct-injection engine with everything on.
fn real() -> Combustion {
    let burn = |start: f64, duration: f64, exponent: f64| Wiebe {
        start: start * DEGREE,
        duration: duration * DEGREE,
        efficiency: 6.9,
        exponent,
    };
    Combustion {
        chamber: Chamber {
            rod_length: 0.145,
            pin_offset: 0.5e-3,
            ..chamber()
        },
        gas_exchange: GasExchange {
            intake_closes: -130.0 * DEGREE,
            exhaust_opens: 140.0 * DEGREE,
            intake_temperature: 360.0,
            exhaust_pressure: 1.2e5,
            ..ideal(HeatRelease::none()).gas_exchange
        },
        heat_release: HeatRelease {
            heat: 1400.0,
            parts: vec![(0.3, burn(-5.0, 15.0, 1.7)), (0.7, burn(-3.0, 60.0, 2.0))],
        },
        heat_ratio: HeatRatio::Falling {
            at_300_kelvin: 1.38,
            per_kelvin: 8e-5,
            lowest: 1.2,
        },
        wall_heat: WallHeat::Woschni(walls()),
        ..ideal(HeatRelease::none())
    }
}

fn walls() -> Woschni {
    Woschni {
        swirl: 2.0,
        combustion: 3.24e-3,
        head_temperature: 520.0,
        piston_temperature: 550.0,
        liner_temperature: 420.0,
        head_area_ratio: 1.1,
        piston_area_ratio: 1.05,
    }
}

#[test]
fn the_wiebe_case_of_the_reference() {
    let volume = chamber().swept_volume() / 0.9;
    let wiebe = Wiebe {
        start: -20.0 * DEGREE,
        duration: 40.0 * DEGREE,
        efficiency: 5.0,
        exponent: 3.0,
    };
    let heat = 20.0 * 1e5 * volume;
    let cycle = ideal(HeatRelease::single(heat, wiebe))
        .cycle(100.0, 720)
        .unwrap();
    assert_eq!(cycle.outcome, Outcome::Converged);
    let found = [
        cycle.peak[1] / 1e5,
        cycle.peak[0] / DEGREE,
        cycle.closed_work / (1e5 * volume),
        cycle.closed_work / heat,
    ];
    let rows = rows_of("wiebe/reference.csv");
    assert_eq!(rows.len(), found.len());
    for (row, found) in rows.iter().zip(found) {
        println!("{}: {found:.6} against {}", row.name, row.value);
        let away = (found - row.value).abs();
        assert!(
            away <= row.bar,
            "{}: {found} against {} +- {}",
            row.name,
            row.value,
            row.bar
        );
    }
    assert_eq!(cycle.diagram.peak()[1], cycle.peak[1]);
}

#[test]
fn without_heat_compression_is_isentropic_and_gives_its_work_back() {
    let cycle = ideal(HeatRelease::none()).cycle(100.0, 720).unwrap();
    let chamber = chamber();
    let start = 1e5 * chamber.volume(-PI).powf(1.4);
    let mut checked = 0;
    for angle in (-179..180).map(|deg| f64::from(deg) * DEGREE) {
        let constant = cycle.diagram.at(angle) * chamber.volume(angle).powf(1.4);
        assert!(
            (constant / start - 1.0).abs() < 1e-8,
            "{angle}: {constant} against {start}"
        );
        checked += 1;
    }
    assert_eq!(checked, 359);
    assert!((cycle.peak[1] / 1e5 - 10.0_f64.powf(1.4)).abs() < 1e-7);
    assert!(cycle.peak[0].abs() < 1e-6);
    assert!(cycle.closed_work.abs() < 1e-8 * 1e5 * chamber.swept_volume());
}

#[test]
fn sudden_burning_at_the_dead_centre_is_the_otto_cycle() {
    let volume = chamber().swept_volume() / 0.9;
    let heat = 10.0 * 1e5 * volume;
    let lost = |duration: f64| {
        let wiebe = Wiebe {
            start: -0.5 * duration * DEGREE,
            duration: duration * DEGREE,
            efficiency: 5.0,
            exponent: 3.0,
        };
        let cycle = ideal(HeatRelease::single(heat, wiebe))
            .cycle(100.0, 720)
            .unwrap();
        assert_eq!(cycle.outcome, Outcome::Converged, "{}", cycle.error);
        let peak = 1e5 * 10.0_f64.powf(1.4) + 0.4 * heat / (0.1 * volume);
        let efficiency = 1.0 - 10.0_f64.powf(-0.4);
        [
            1.0 - cycle.closed_work / heat / efficiency,
            1.0 - cycle.peak[1] / peak,
        ]
    };
    let [slow, fast, fastest] = [4.0, 2.0, 0.05].map(lost);
    println!("lost over 4, 2, 0.05 deg: {slow:?} {fast:?} {fastest:?}");
    // Around the dead centre the volume grows with the square of the angle.
    let order = (slow[0] / fast[0]).log2();
    assert!((order - 2.0).abs() < 0.02, "order {order}");
    assert!(
        fastest[0].abs() < 1e-6 && fastest[1].abs() < 1e-5,
        "{fastest:?}"
    );
}

#[test]
fn the_first_law_balances() {
    let cycle = real().cycle(300.0, 720).unwrap();
    assert_eq!(cycle.outcome, Outcome::Converged, "{}", cycle.error);
    let left = cycle.heat_released - cycle.wall_heat - cycle.closed_work;
    let rest = (left - cycle.internal_energy_change) / cycle.heat_released;
    println!(
        "balance {rest:.2e}, stated error of the pressure {:.2e}",
        cycle.error
    );
    assert!(rest.abs() < 1e-8, "{rest}");
    assert!(cycle.wall_heat > 0.05 * cycle.heat_released);
    assert!(cycle.wall_heat < 0.5 * cycle.heat_released);
    let ideal_gas = cycle.peak[1] * real().chamber.volume(cycle.peak[0]) / cycle.charge;
    assert!(cycle.highest_temperature >= ideal_gas);
}

#[test]
fn work_of_the_closed_cycle_is_that_of_the_diagram() {
    // Blow-down and gas exchange at one pressure give no work beyond the closed cycle's.
    let wiebe = Wiebe {
        start: -20.0 * DEGREE,
        duration: 40.0 * DEGREE,
        efficiency: 5.0,
        exponent: 3.0,
    };
    let combustion = ideal(HeatRelease::single(1000.0, wiebe));
    let cycle = combustion.cycle(100.0, 36_000).unwrap();
    let chamber = combustion.chamber;
    let whole = chamber.work(&cycle.diagram);
    let from_opening: Vec<[f64; 2]> = cycle
        .diagram
        .points
        .iter()
        .map(|&[angle, p]| {
            if angle > PI && angle < 3.0 * PI {
                [angle, 1e5]
            } else {
                [angle, p]
            }
        })
        .collect();
    let open = sommerfeld_engine::IndicatorDiagram::new(from_opening, 2.0 * TAU).unwrap();
    // Without blow-down the pressures of the gas exchange cancel; what is left is the closed cycle, but
    // for the step at the dead centre, where the piston rests.
    let closed = chamber.work(&open);
    assert!(
        (closed / cycle.closed_work - 1.0).abs() < 1e-6,
        "{closed} {}",
        cycle.closed_work
    );
    assert!(
        whole > closed,
        "the blow-down after the dead centre costs: {whole} {closed}"
    );
}

#[test]
fn woschni_by_hand() {
    let gas = GasInstant {
        pressure: 50e5,
        temperature: 1500.0,
        excess_pressure: 20e5,
    };
    let scales = CycleScales {
        bore: 0.1,
        piston_speed: 12.0,
        reference: 0.5e-3 * 350.0 / (1e5 * 0.55e-3),
    };
    let still = Woschni {
        swirl: 0.0,
        ..walls()
    };
    // w = 2.28 * 12 + 3.24e-3 * 3.18182e-3 * 2e6 = 47.97818 m/s
    let closed = still.coefficient(&gas, &scales);
    assert!((closed - 2160.8569).abs() < 1e-3, "{closed}");
    // (6.18 + 0.417 * 2) * 12 m/s
    let open = walls().gas_exchange_coefficient(&gas, &scales);
    assert!((open - 3387.7285).abs() < 1e-3, "{open}");
    // The paper's 110 kcal/(m2 h K) at kp/cm2.
    assert!((110.0 * 1.163 * 1.019_716_f64.powf(0.8) / 130.0 - 1.0).abs() < 1e-3);
    let area = PI * 0.25 * 0.086 * 0.086;
    let chamber = chamber();
    let liner = PI * 0.086 * (0.086 + 0.086 / 9.0);
    let driving = walls().driving(&chamber, PI, 1000.0);
    let by_hand = 1.1 * area * 480.0 + 1.05 * area * 450.0 + liner * 580.0;
    assert!((driving / by_hand - 1.0).abs() < 1e-12);
}

#[test]
fn volumes_of_an_offset_cylinder() {
    let chamber = Chamber {
        rod_length: 0.145,
        pin_offset: 8e-3,
        ..chamber()
    };
    assert!((chamber.volume(0.0) / chamber.clearance_volume() - 1.0).abs() < 1e-12);
    assert!(chamber.volume_rate(0.0).abs() < 1e-15);
    let volumes = (0..36_000).map(|i| chamber.volume(f64::from(i) * 0.01 * DEGREE));
    let largest = volumes.fold(0.0, f64::max);
    assert!((largest / chamber.clearance_volume() / 10.0 - 1.0).abs() < 1e-7);
    for angle in [0.3, 1.0, 2.0, 3.5, 5.0] {
        let h = 1e-5;
        let numeric = (chamber.volume(angle + h) - chamber.volume(angle - h)) / (2.0 * h);
        assert!((chamber.volume_rate(angle) - numeric).abs() < 1e-9 * chamber.area());
    }
    let long = Chamber {
        rod_length: 1e4,
        pin_offset: 0.0,
        ..chamber
    };
    let infinite = Chamber {
        rod_length: f64::INFINITY,
        ..long
    };
    for angle in [0.3, 1.0, 2.0, 3.5] {
        assert!((long.volume(angle) / infinite.volume(angle) - 1.0).abs() < 1e-5);
    }
}

#[test]
fn internal_energy_is_the_integral_of_the_specific_heat() {
    let falling = real().heat_ratio;
    for ratio in [HeatRatio::Constant(1.35), falling] {
        for temperature in [250.0, 300.0, 900.0, 2000.0, 2800.0] {
            let h = 0.01;
            let above = ratio.internal_energy(temperature + h);
            let below = ratio.internal_energy(temperature - h);
            let numeric = (above - below) / (2.0 * h);
            let exact = 1.0 / (ratio.at(temperature) - 1.0);
            assert!(
                (numeric / exact - 1.0).abs() < 1e-8,
                "{ratio:?} {temperature}"
            );
        }
    }
    assert_eq!(falling.at(5000.0), 1.2);
}

#[test]
fn pressures_are_continuous_over_the_whole_cycle() {
    for strokes in [Strokes::Four, Strokes::Two] {
        let mut combustion = real();
        combustion.strokes = strokes;
        if strokes == Strokes::Two {
            combustion.gas_exchange.exhaust_opens = 110.0 * DEGREE;
            combustion.gas_exchange.intake_closes = -120.0 * DEGREE;
        }
        let cycle = combustion.cycle(200.0, 7200).unwrap();
        let diagram = &cycle.diagram;
        assert_eq!(diagram.period, strokes.period());
        let steepest = (0..7200)
            .map(|i| f64::from(i) * diagram.period / 7200.0)
            .map(|angle| (diagram.at(angle + 1e-4) - diagram.at(angle - 1e-4)).abs())
            .fold(0.0, f64::max);
        assert!(steepest < 1e-3 * cycle.peak[1], "{strokes:?} {steepest}");
        let closing = combustion.gas_exchange.intake_closes;
        assert!((diagram.at(closing) - 1e5).abs() < 1e-6);
        let ascending = diagram
            .points
            .windows(2)
            .all(|pair| pair[0][0] < pair[1][0]);
        assert!(ascending, "{strokes:?}");
    }
}

#[test]
fn less_heat_reaches_the_walls_of_a_faster_engine() {
    let share = |speed: f64| {
        let cycle = real().cycle(speed, 360).unwrap();
        cycle.wall_heat / cycle.heat_released
    };
    assert!(share(100.0) > 1.2 * share(500.0));
}

#[test]
fn numbers_out_of_range_are_named() {
    let refused = |change: &dyn Fn(&mut Combustion)| {
        let mut combustion = real();
        change(&mut combustion);
        match combustion.cycle(200.0, 720) {
            Err(CombustionError::OutOfRange { what, .. }) => what,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(
        refused(&|c| c.chamber.compression_ratio = 1.0),
        "compression ratio"
    );
    assert_eq!(refused(&|c| c.chamber.rod_length = 0.04), "rod length");
    assert_eq!(refused(&|c| c.chamber.bore = f64::NAN), "bore");
    assert_eq!(refused(&|c| c.heat_release.heat = -1.0), "heat released");
    assert_eq!(
        refused(&|c| c.heat_release.parts[0].0 = 0.4),
        "sum of the shares of the heat"
    );
    assert_eq!(
        refused(&|c| c.heat_release.parts[0].1.start = 3.0),
        "start of burning"
    );
    assert_eq!(
        refused(&|c| c.gas_exchange.intake_closes = 1.0),
        "closing of the intake"
    );
    assert_eq!(
        refused(&|c| c.gas_exchange.blow_down = 4.0),
        "crank angle of the blow-down"
    );
    assert_eq!(
        refused(&|c| c.gas_exchange.intake_temperature = 20.0),
        "temperature of the charge"
    );
    assert_eq!(
        refused(&|c| c.heat_ratio = HeatRatio::Constant(1.0)),
        "ratio of specific heats"
    );
    let cold = WallHeat::Woschni(Woschni {
        head_temperature: 90.0,
        ..walls()
    });
    assert_eq!(refused(&|c| c.wall_heat = cold), "wall temperature");
    assert!(real().cycle(f64::NAN, 720).is_err() && real().cycle(100.0, 3).is_err());
}
