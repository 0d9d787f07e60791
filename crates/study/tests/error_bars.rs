//! Error bars as a user asks for them, held against references and finer runs of the program.
//!
//! The fine runs of the load cycles take minutes: their figures stand here, and
//! `SOMMERFELD_FINE_RUNS=1 cargo test -p sommerfeld-study --test error_bars -- --nocapture` computes
//! them anew and compares.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test may stop at the first surprise"
)]

use serde_json::Value;
use sommerfeld_study::output::summary;
use sommerfeld_study::{Outcome, RunOptions, Study, load_study, solve_with};
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A study from its text, in a file of its own.
fn study(name: &str, text: &str) -> Study {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("error-bars-{name}.toml"));
    std::fs::write(&file, text).unwrap();
    load_study(&file).unwrap_or_else(|errors| panic!("{errors}"))
}

fn solve(study: &Study, verify: bool) -> Value {
    let mut go_on = |_| ControlFlow::Continue(());
    let results = solve_with(
        study,
        RunOptions {
            verify,
            ..RunOptions::default()
        },
        &mut go_on,
    )
    .unwrap();
    assert_eq!(results.header.status, Outcome::Converged);
    summary(&results)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

/// Rows of a reference as numbers.
fn rows(case: &str) -> Vec<Vec<f64>> {
    let path = root().join(format!("validation/{case}/reference.csv"));
    let text = std::fs::read_to_string(path).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines
        .map(|line| line.split(',').map(|v| v.parse().unwrap()).collect())
        .collect()
}

/// True over stated errors.
#[derive(Default)]
struct Coverage {
    ratios: Vec<f64>,
    rows: usize,
    covered: usize,
}

impl Coverage {
    /// A row of value, stated error and reference.
    fn add(&mut self, name: &str, figures: &[(&str, [f64; 3])]) {
        let mut worst = 0.0_f64;
        for (figure, [value, error, reference]) in figures {
            let ratio = (value - reference).abs() / error;
            println!("{name} {figure}: {value:.6} +- {error:.1e}, {reference} ({ratio:.2})");
            worst = worst.max(ratio);
            self.ratios.push(ratio);
        }
        self.rows += 1;
        self.covered += usize::from(worst <= 1.0);
    }

    fn check(mut self, name: &str, least: f64) {
        self.ratios.sort_by(f64::total_cmp);
        let inside = self.ratios.iter().filter(|ratio| **ratio <= 1.0).count();
        let share = inside as f64 / self.ratios.len() as f64;
        println!(
            "{name}: {} rows, {} covered; {inside} of {} figures ({:.1} %), worst true/stated {:.2}, \
             median {:.2}",
            self.rows,
            self.covered,
            self.ratios.len(),
            100.0 * share,
            self.ratios[self.ratios.len() - 1],
            self.ratios[self.ratios.len() / 2]
        );
        assert!(share >= least, "{name}: {share}");
    }
}

/// With the error target within 0.3 % of the independent solver, and covered, its five printed digits
/// granted.
#[test]
fn raimondi_boyd() {
    let text = std::fs::read_to_string(root().join("validation/raimondi-boyd/study.toml")).unwrap();
    let mut coverage = Coverage::default();
    let mut worst = 0.0_f64;
    for row in rows("raimondi-boyd") {
        let [width_ratio, eps, s, phi, friction, q, side_share, p_ratio] = row[..] else {
            panic!("{row:?}")
        };
        let text = text
            .replace(
                "width = \"100 mm\"",
                &format!("width = \"{} mm\"", 100.0 * width_ratio),
            )
            .replace("eccentricity = 0.8", &format!("eccentricity = {eps:?}"));
        let found = solve(&study(&format!("rb-{width_ratio}-{eps}"), &text), false);
        let error = &found["error"];
        let [fx, fy] = [0, 1].map(|k| number(&found["force_n"][k]));
        let [dfx, dfy] = [0, 1].map(|k| number(&error["force_n"][k]));
        let force = fx.hypot(fy);
        let of_force = (fx * dfx).hypot(fy * dfy) / (force * force);
        let relative = |key: &str| number(&error[key]) / number(&found[key]);
        let (d, b, psi, omega) = (0.1, 0.1 * width_ratio, 1e-3, TAU * 50.0);
        let so = number(&found["sommerfeld_number"]);
        // The line of centres is +X, the load opposite to the force.
        let attitude = (0.0 - (-fy).atan2(-fx)).to_degrees();
        let f = number(&found["friction_torque_journal_n_m"]) / (0.5 * d * force * psi);
        let unit = 0.5 * d * (0.5 * d * psi) * (omega / TAU) * b;
        let side = number(&found["side_flow_m3_s"]) / unit;
        let peak = force / (b * d) / number(&found["peak_film_pressure_pa"]);
        let digits = 1e-4;
        let figure =
            |value: f64, of: f64, reference: f64| [value, value * (of + digits), reference];
        let figures = [
            (
                "S",
                figure(1.0 / (TAU * so), relative("sommerfeld_number"), s),
            ),
            (
                "phi",
                figure(attitude, of_force.to_degrees() / attitude, phi),
            ),
            (
                "f R/C",
                figure(
                    f,
                    of_force + relative("friction_torque_journal_n_m"),
                    friction,
                ),
            ),
            (
                "Qs",
                figure(side, relative("side_flow_m3_s"), q * side_share),
            ),
            (
                "P/pmax",
                figure(peak, of_force + relative("peak_film_pressure_pa"), p_ratio),
            ),
        ];
        for (name, [value, _, reference]) in figures {
            let off = (value / reference - 1.0).abs();
            worst = worst.max(off);
            assert!(off <= 0.003, "{row:?} {name}: {value}, {reference}");
        }
        coverage.add(&format!("L/D {width_ratio} eps {eps}"), &figures);
    }
    println!("Raimondi and Boyd: worst deviation {worst:.1e} of 3e-3");
    coverage.check("Raimondi and Boyd", 0.95);
}

/// Rows of Butenschoen's rotation with the target of 1e-3, within his own accuracy: So and Q* to 0.5 %,
/// the attitude to 0.1 degrees. His numbers cannot judge error bars far narrower than that: they lie
/// beside those of the independent solver of `raimondi_boyd`, which has ours.
#[test]
fn butenschoen_rotation() {
    let text = std::fs::read_to_string(root().join("validation/raimondi-boyd/study.toml")).unwrap();
    for row in rows("butenschoen-rotation") {
        let [width_ratio, eps, so, beta, flow] = row[..] else {
            panic!("{row:?}")
        };
        if ![1.0, 0.5, 0.25].contains(&width_ratio) || ![0.2, 0.5, 0.8, 0.9, 0.95].contains(&eps) {
            continue;
        }
        let width = format!("width = \"{} mm\"", 100.0 * width_ratio);
        let text = text
            .replace("width = \"100 mm\"", &width)
            .replace("eccentricity = 0.8", &format!("eccentricity = {eps:?}"));
        let found = solve(&study(&format!("bu-{width_ratio}-{eps}"), &text), false);
        let error = |key: &str| number(&found["error"][key]);
        let radius = 0.05;
        let unit = radius * radius * radius * 1e-3 * (TAU * 50.0);
        let [fx, fy] = [0, 1].map(|k| number(&found["force_n"][k]));
        let [dfx, dfy] = [0, 1].map(|k| number(&found["error"]["force_n"][k]));
        let of_angle = (fy * dfx).hypot(fx * dfy) / (fx * fx + fy * fy);
        // The line of centres is +X, the load opposite to the force.
        let attitude = (0.0 - (-fy).atan2(-fx)).to_degrees();
        let figures = [
            (
                "So",
                [
                    number(&found["sommerfeld_number"]),
                    error("sommerfeld_number") + 5e-5,
                    so,
                ],
            ),
            ("beta", [attitude, of_angle.to_degrees() + 5e-4, beta]),
            (
                "Q*",
                [
                    number(&found["side_flow_m3_s"]) / unit,
                    error("side_flow_m3_s") / unit + 5e-5,
                    flow,
                ],
            ),
        ];
        let name = format!("B/D {width_ratio} eps {eps}");
        for (figure, [value, error, reference]) in figures {
            println!("{name} {figure}: {value:.6} +- {error:.1e}, {reference}");
            let bar = if figure == "beta" {
                0.1
            } else {
                5e-3 * reference
            };
            assert!(
                (value - reference).abs() <= error + bar,
                "{name} {figure}: {value} {reference}"
            );
        }
    }
}

const GROOVED: &str = "schema = 1\nanalysis = \"equilibrium\"\n[bearing]\ndiameter = \"72 mm\"\n\
    width = \"30 mm\"\nrelative_clearance = 1e-3\n[[bearing.groove]]\nkind = \"circumferential\"\n\
    width = \"6 mm\"\npressure = \"5 bar\"\n[oil]\nviscosity = \"8 mPa.s\"\n[film]\n\
    cavitation = \"mass-conserving\"\n[operation]\nspeed = \"2000 rpm\"\nload = [\"8 kN\", \"0 N\"]\n";

/// The bearing with a circumferential groove and a mass-conserving film against its independent
/// solver, the accuracy that it states granted, else its digits: on given grids, and with a target.
#[test]
fn grooved_bearing() {
    let file = root().join("validation/grooved-bearing-steady/reference.csv");
    let table = std::fs::read_to_string(file).unwrap();
    let reference = |name: &str| -> f64 {
        let line = table
            .lines()
            .find(|line| line.split(',').next() == Some(name));
        line.unwrap().split(',').nth(1).unwrap().parse().unwrap()
    };
    // Key, its name in the reference, the unit there, what it is known to there.
    let keys = [
        (
            "relative_eccentricity",
            "relative_eccentricity",
            1.0,
            2.2e-5,
        ),
        ("attitude_angle_deg", "attitude_angle", 1.0, 5e-4),
        (
            "minimum_film_thickness_m",
            "minimum_film_thickness",
            1e-6,
            8e-4,
        ),
        ("peak_film_pressure_pa", "peak_film_pressure", 1e6, 2e-2),
        ("side_flow_m3_s", "side_flow", 1e-6, 5e-4),
        ("feed_flow_m3_s", "feed_flow", 1e-6, 5e-4),
        (
            "friction_torque_journal_n_m",
            "friction_torque_journal_film_fraction",
            1.0,
            5e-5,
        ),
    ];
    let (mut given, mut to_target) = (Coverage::default(), Coverage::default());
    for (line, verify) in [
        ("grid = [64, 20]", true),
        ("grid = [ 96, 30]", true),
        ("grid = [ 128,  40]", true),
        ("relative_error_target = 3e-3", false),
    ] {
        let text = GROOVED.replace("[operation]", &format!("{line}\n[operation]"));
        let found = solve(&study(&format!("grooved-{}", line.len()), &text), verify);
        let figures: Vec<_> = keys
            .iter()
            .map(|(key, name, unit, digit)| {
                let error = number(&found["error"][key]) / unit;
                (
                    *name,
                    [number(&found[key]) / unit, error + digit, reference(name)],
                )
            })
            .collect();
        let coverage = if verify { &mut given } else { &mut to_target };
        coverage.add(line, &figures);
    }
    given.check("grooved bearing, --verify", 0.95);
    to_target.check("grooved bearing, target 3e-3", 0.95);
}

/// Butenschoen's side flow in pure squeeze for B/D = 1 from eps 0.6 on is not ours: the deviation is many
/// times our error bar, while the table's own steps are not smooth there. Up to 0.5 the two agree.
#[test]
fn squeeze_side_flow_is_not_the_tables_by_many_error_bars() {
    let mut beyond = Vec::new();
    for row in rows("butenschoen-squeeze") {
        let [width_ratio, eps, _, reference] = row[..] else {
            panic!("{row:?}")
        };
        if width_ratio != 1.0 || !(0.25..=0.85).contains(&eps) {
            continue;
        }
        let text = format!(
            "schema = 1\nanalysis = \"film\"\n[bearing]\ndiameter = \"2 m\"\nwidth = \"2 m\"\n\
             relative_clearance = 1e-3\n[oil]\nviscosity = \"10 mPa.s\"\n[film]\n\
             cavitation = \"reynolds\"\nrelative_error_target = 1e-3\n[operation]\nspeed = \"0 rpm\"\n\
             relative_eccentricity = {eps:?}\nrelative_eccentricity_rate = \"1 1/s\"\n"
        );
        let found = solve(&study(&format!("squeeze-{eps}"), &text), false);
        let flow = number(&found["side_flow_m3_s"]) / 1e-3;
        let error = number(&found["error"]["side_flow_m3_s"]) / 1e-3;
        let off = flow - reference;
        println!(
            "eps {eps}: {flow:.4} +- {error:.4}, table {reference}, {:+.2} %",
            100.0 * off / reference
        );
        assert!(error < 2e-3 * flow, "eps {eps}: {error}");
        if eps < 0.45 {
            assert!(off.abs() < 0.01 * reference, "eps {eps}: {off}");
        }
        if eps > 0.55 {
            beyond.push(off.abs() / error);
        }
    }
    assert_eq!(beyond.len(), 3);
    assert!(beyond.iter().all(|ratio| *ratio > 5.0), "{beyond:?}");
}

/// The figures of a summary that a terminal shows, with their errors, against another summary.
fn against(found: &Value, fine: &Value, keys: &[&'static str]) -> Vec<(&'static str, [f64; 3])> {
    keys.iter()
        .map(|key| {
            let error = number(&found["error"][key]);
            (*key, [number(&found[key]), error, number(&fine[key])])
        })
        .collect()
}

const STEADY_KEYS: [&str; 8] = [
    "relative_eccentricity",
    "attitude_angle_deg",
    "minimum_film_thickness_m",
    "peak_film_pressure_pa",
    "friction_torque_journal_n_m",
    "power_loss_w",
    "side_flow_m3_s",
    "feed_flow_m3_s",
];

/// Example 01 and its coefficients on several grids, and with an error target, against the same on
/// 512 x 128 cells.
#[test]
fn steady_example_is_covered() {
    let text = std::fs::read_to_string(root().join("examples/01-steady-main-bearing/study.toml"))
        .unwrap()
        .replace("\"equilibrium\"", "\"coefficients\"");
    let with = |line: &str| {
        let text = text.replace("model = \"field\"", &format!("model = \"field\"\n{line}"));
        study(&format!("steady-{}", line.len()), &text)
    };
    let fine = solve(&with("grid = [512, 128]"), false);
    let mut coverage = Coverage::default();
    for line in [
        "grid = [64, 16]",
        "grid = [ 96, 24]",
        "grid = [ 128, 32]",
        "grid = [ 192,  48]",
    ] {
        let found = solve(&with(line), true);
        let mut figures = against(&found, &fine, &STEADY_KEYS);
        for (name, key) in [("stiffness", "stiffness_n_m"), ("damping", "damping_n_s_m")] {
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let [value, error, reference] =
                    [&found[key], &found["error"][key], &fine[key]].map(|m| number(&m[i][j]));
                figures.push((name, [value, error, reference]));
            }
        }
        coverage.add(line, &figures);
    }
    coverage.check("example 01", 0.95);
}

const CYCLE_KEYS: [&str; 9] = [
    "minimum_film_thickness_m",
    "minimum_film_thickness_angle_deg",
    "peak_film_pressure_pa",
    "peak_film_pressure_angle_deg",
    "mean_power_loss_w",
    "mean_friction_power_w",
    "mean_side_flow_m3_s",
    "mean_feed_flow_m3_s",
    "mean_relative_eccentricity",
];

/// An example on a coarse grid with error bars against its figures on 192 x 48 cells with half the
/// crank step.
fn cycle_example(name: &str, fine: [f64; 9]) -> Coverage {
    let file = root().join("examples").join(name).join("study.toml");
    let mut study = load_study(&file).unwrap();
    if std::env::var_os("SOMMERFELD_FINE_RUNS").is_some() {
        let mut finer = study.clone();
        finer.film.grid = [192, 48];
        halve_steps(&mut finer);
        compare_fine(name, &solve(&finer, false), fine);
    }
    study.film.grid = [64, 16];
    cycle_coverage(name, &solve(&study, true), fine, 720.0)
}

/// The figures that stand here are those of the fine run.
fn compare_fine(name: &str, found: &Value, fine: [f64; 9]) {
    for (key, expected) in CYCLE_KEYS.iter().zip(fine) {
        let value = number(&found[key]);
        println!("{name} {key}: {value:e}, {expected:e} stands here");
    }
    for (key, expected) in CYCLE_KEYS.iter().zip(fine) {
        let value = number(&found[key]);
        assert!(
            (value - expected).abs() <= 1e-6 * expected.abs(),
            "{key}: {value:e}"
        );
    }
}

/// Angles are compared the short way round the period, degrees.
fn cycle_coverage(name: &str, found: &Value, fine: [f64; 9], period: f64) -> Coverage {
    let figures: Vec<_> = CYCLE_KEYS
        .iter()
        .zip(fine)
        .map(|(key, fine)| {
            let turns = ((number(&found[key]) - fine) / period).round();
            let is_angle = key.ends_with("_angle_deg");
            let fine = if is_angle {
                fine + period * turns
            } else {
                fine
            };
            (
                *key,
                [number(&found[key]), number(&found["error"][key]), fine],
            )
        })
        .filter(|(_, [value, _, _])| *value != 0.0)
        .collect();
    let mut coverage = Coverage::default();
    coverage.add(name, &figures);
    coverage
}

fn halve_steps(study: &mut Study) {
    use sommerfeld_study::input::{Duty, Subject};
    let Subject::Bearing(case) = &mut study.subject else {
        panic!("no bearing")
    };
    let Duty::Cycle(duty) = &mut case.duty else {
        panic!("no load cycle")
    };
    duty.crank_step *= 0.5;
}

#[test]
fn one_axis_cycle_is_covered() {
    let coverage = cycle_example(
        "03-one-axis-cycle",
        [
            7.880803476236932e-06,
            659.929379,
            5432413.970109888,
            630.929379,
            143.5340148503347,
            143.40675725291769,
            5.8176359553814216e-06,
            0.0,
            0.633998039863626,
        ],
    );
    coverage.check("example 03", 0.95);
}

const CLOSED_FORM_CYCLE: &str = "schema = 1\nanalysis = \"load-cycle\"\n[bearing]\ndiameter = \"60 mm\"\n\
    width = \"20 mm\"\nrelative_clearance = 1e-3\n[oil]\nviscosity = \"8 mPa.s\"\n[film]\n\
    model = \"short-bearing\"\ncavitation = \"gumbel\"\n[load_cycle]\nfile = \"error-bars-loads.csv\"\n\
    engine_speed = \"2000 rpm\"\nperiod = \"360 deg\"\ncrank_step = \"4 deg\"\n";

/// Once for all tests: one may read while another writes.
fn write_loads() {
    static WRITTEN: std::sync::Once = std::sync::Once::new();
    let loads = "crank_angle[deg],load_x[N],load_y[N]\n0,4000,0\n90,2000,2000\n180,1000,0\n\
                 270,2000,-2000\n360,4000,0\n";
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("error-bars-loads.csv");
    WRITTEN.call_once(|| std::fs::write(file, loads).unwrap());
}

/// A closed form has no grid: its cycle has the error of the time step alone, and that covers.
#[test]
fn closed_form_cycle_has_the_error_of_its_steps() {
    write_loads();
    let coarse = solve(&study("closed-cycle", CLOSED_FORM_CYCLE), true);
    let messages = coarse["messages"].to_string();
    assert!(messages.contains("has no grid"), "{messages}");
    let mut fine = study("closed-cycle-fine", CLOSED_FORM_CYCLE);
    for _ in 0..3 {
        halve_steps(&mut fine);
    }
    let fine = solve(&fine, false);
    let keys = [CYCLE_KEYS[0], CYCLE_KEYS[4], CYCLE_KEYS[6], CYCLE_KEYS[8]];
    let mut coverage = Coverage::default();
    coverage.add("short bearing", &against(&coarse, &fine, &keys));
    coverage.check("closed form over a cycle", 1.0);
}

const TRANSPORTED_CYCLE: &str = "schema = 1\nanalysis = \"load-cycle\"\n[bearing]\n\
    diameter = \"60 mm\"\nwidth = \"20 mm\"\nrelative_clearance = 1e-3\n[[bearing.groove]]\n\
    kind = \"hole\"\ncarried_by = \"shell\"\nangle = \"180 deg\"\nposition = \"0 mm\"\n\
    diameter = \"6 mm\"\npressure = \"4 bar\"\n[oil]\nviscosity = \"8 mPa.s\"\n[film]\n\
    cavitation = \"mass-conserving\"\ngrid = [64, 16]\n[load_cycle]\nfile = \"error-bars-loads.csv\"\n\
    engine_speed = \"2000 rpm\"\nperiod = \"360 deg\"\ncrank_step = \"4 deg\"\n";

/// A load cycle whose film fraction is carried along, against 128 x 32 cells with half the step.
#[test]
fn cycle_with_transported_film_is_covered() {
    write_loads();
    let study = study("transported", TRANSPORTED_CYCLE);
    let fine = [
        2.5289284223055676e-6,
        116.0,
        1.4967742198952878e7,
        0.0,
        68.35318509456714,
        67.30197239898679,
        3.1628350468809133e-6,
        3.1628343978704523e-6,
        0.8103877832883284,
    ];
    if std::env::var_os("SOMMERFELD_FINE_RUNS").is_some() {
        let mut finer = study.clone();
        finer.film.grid = [128, 32];
        halve_steps(&mut finer);
        compare_fine("transported film", &solve(&finer, false), fine);
    }
    let coverage = cycle_coverage("transported film", &solve(&study, true), fine, 360.0);
    coverage.check("load cycle with transported film", 0.95);
}

/// With a target a cycle refines grid and steps until its own estimate is below it.
#[test]
fn load_cycle_reaches_its_target() {
    write_loads();
    let text = CLOSED_FORM_CYCLE.replace(
        "model = \"short-bearing\"\ncavitation = \"gumbel\"",
        "cavitation = \"reynolds\"\ngrid = [48, 12]\nrelative_error_target = 0.02",
    );
    let found = solve(&study("cycle-target", &text), false);
    let error = &found["error"];
    let messages = found["messages"].to_string();
    assert!(
        messages.contains("error target 0.02 reached on"),
        "{messages}"
    );
    let grid = [0, 1].map(|k| found["grid"][k].as_u64().unwrap());
    assert!(grid[0] > 48 && grid[1] > 12, "{grid:?}");
    for key in [
        "minimum_film_thickness_m",
        "peak_film_pressure_pa",
        "mean_power_loss_w",
    ] {
        assert!(
            number(&error[key]) <= 0.02 * number(&found[key]),
            "{key}: {error}"
        );
        assert!(number(&error[key]) > 0.0);
    }
}

/// A missed target is named with its estimate, and the run has converged all the same.
#[test]
fn missed_target_is_named() {
    let text = std::fs::read_to_string(root().join("validation/raimondi-boyd/study.toml"))
        .unwrap()
        .replace(
            "relative_error_target = 1e-3",
            "relative_error_target = 1e-6\ngrid = [32, 8]",
        );
    let found = solve(&study("missed", &text), false);
    let messages = found["messages"].to_string();
    assert!(
        messages.contains("error target 0.000001 not reached on 256 x 64 cells"),
        "{messages}"
    );
    assert_eq!(found["grid"][0], 256);
    assert!(number(&found["error"]["peak_film_pressure_pa"]) > 0.0);
}

/// Below the smallest grid there are no error bars, and a message says why; what no grid touches has none.
#[test]
fn error_bars_have_their_limits() {
    let text = std::fs::read_to_string(root().join("validation/raimondi-boyd/study.toml")).unwrap();
    let small = text.replace("relative_error_target = 1e-3", "grid = [24, 6]");
    let found = solve(&study("small", &small), true);
    assert!(found["error"].is_null());
    let messages = found["messages"].to_string();
    assert!(
        messages.contains("no error bars: film.grid must be at least [32, 8]"),
        "{messages}"
    );
    let grid = text.replace("relative_error_target = 1e-3", "grid = [64, 16]");
    let found = solve(&study("given", &grid), true);
    assert_eq!(found["error"]["minimum_film_thickness_m"], 0.0);
    assert_eq!(found["error"]["relative_eccentricity"], 0.0);
    let closed = text.replace("relative_error_target = 1e-3", "model = \"short-bearing\"");
    let closed = closed
        .replace("max-film-line", "cyclic")
        .replace("\"reynolds\"", "\"gumbel\"");
    let found = solve(&study("closed", &closed), true);
    assert_eq!(found["error"]["power_loss_w"], 0.0);
}
