//! How fast equilibria converge where oil thickens close to its limit and where contact carries: every
//! iteration stands in `validation/newton-tables`, and the tail squares its residual.
//!
//! With `SOMMERFELD_WRITE_TABLES=1` the tables are written anew, loads and speeds included.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests stop at the first surprise"
)]

mod common;

use common::{CONDITIONS, diesel_big_end, greenwood_tripp, rig_finish, text_table};
use sommerfeld_bearing::{
    Equilibrium, EquilibriumRequest, EquilibriumSettings, IterationRow, find_equilibrium,
};
use sommerfeld_film::reduced_pressure::ReducedPressure;
use sommerfeld_film::{Bearing, Cavitation, FilmForce, FilmSolver, JournalState, Outcome};
use sommerfeld_oil::{Lubricant, PressureLaw};
use std::fmt::Write as _;

const CLOSURES: [(&str, Cavitation); 3] = [
    ("gumbel", Cavitation::Gumbel),
    ("reynolds", Cavitation::Reynolds),
    ("mass-conserving", Cavitation::MassConserving),
];

/// A step over the smallest gap is at most so many squares of the one before, and so is the residual that
/// it leaves. A force that goes with the gap to the power -n has (n + 1)/2 of them, 2 for a film; where it
/// is softer along one direction than along the other, or thickens, some more.
const SQUARES: f64 = 10.0;
/// Residuals below it are round-off of forces that nearly cancel.
const ROUND_OFF: f64 = 1e-10;

fn thickening() -> Lubricant {
    Lubricant {
        viscosity_pressure: PressureLaw::Roelands {
            alpha: 9.5e-9,
            temperature: Default::default(),
        },
        ..Lubricant::constant(6.8e-3, 832.5)
    }
}

fn rest(bearing: &Bearing, oil: &Lubricant, load: f64, speed: f64) -> (Equilibrium, FilmSolver) {
    let mut film = FilmSolver::aligned(bearing, oil, [64, 16]).unwrap();
    let request = EquilibriumRequest {
        load: [load, 0.0],
        moment: None,
        frame: JournalState {
            journal_speed: speed,
            ..JournalState::default()
        },
        start: None,
        settings: EquilibriumSettings {
            residual_tolerance: ROUND_OFF,
            step_tolerance: 1e-9,
            ..EquilibriumSettings::default()
        },
    };
    let found = find_equilibrium(&mut film, bearing, &request, &CONDITIONS).unwrap();
    (found, film)
}

/// One table: bearings whose measured share rises with one input, load or speed.
struct Study<'a> {
    file: &'static str,
    head: &'static str,
    shares: &'a [f64],
    /// Input between which the shares are looked for; the share rises from the first to the second.
    range: [f64; 2],
    solve: &'a dyn Fn(Cavitation, f64) -> (Equilibrium, f64),
}

impl Study<'_> {
    /// The input at which the share is reached, four digits.
    fn input(&self, cavitation: Cavitation, share: f64) -> f64 {
        let [mut low, mut high] = self.range.map(f64::ln);
        for _ in 0..24 {
            let middle = 0.5 * (low + high);
            let (found, reached) = (self.solve)(cavitation, middle.exp());
            if found.outcome == Outcome::Converged && reached < share {
                low = middle;
            } else {
                high = middle;
            }
        }
        format!("{:.4e}", low.exp()).parse().unwrap()
    }

    fn path(&self) -> String {
        format!(
            "{}/../../validation/newton-tables/{}",
            env!("CARGO_MANIFEST_DIR"),
            self.file
        )
    }

    fn write(&self) {
        let mut text = format!(
            "# source: this program, crates/bearing/tests/newton_tables.rs\n# {}\n",
            self.head
        );
        text.push_str("closure,share[-],input,iteration,residual[-],step[-],taken[-],settled\n");
        for (name, cavitation) in CLOSURES {
            for share in self.shares {
                let input = self.input(cavitation, *share);
                let (found, _) = (self.solve)(cavitation, input);
                for (k, row) in found.table.iter().enumerate() {
                    writeln!(
                        text,
                        "{name},{share},{input:.4e},{},{:.3e},{:.3e},{},{}",
                        k + 1,
                        row.residual,
                        row.step,
                        row.taken,
                        row.settled
                    )
                    .unwrap();
                }
            }
        }
        std::fs::write(self.path(), text).unwrap();
    }

    fn check(&self) {
        if std::env::var_os("SOMMERFELD_WRITE_TABLES").is_some() {
            self.write();
        }
        let rows = text_table(&format!("newton-tables/{}", self.file));
        for (name, cavitation) in CLOSURES {
            for share in self.shares {
                let is_mine = |row: &&Vec<String>| {
                    row[0] == name && row[1].parse::<f64>().is_ok_and(|s| s == *share)
                };
                let mine: Vec<&Vec<String>> = rows.iter().filter(is_mine).collect();
                let input: f64 = mine.first().unwrap()[2].parse().unwrap();
                let (found, reached) = (self.solve)(cavitation, input);
                let what = format!("{}, {name}, share {share}", self.file);
                assert_eq!(found.outcome, Outcome::Converged, "{what}");
                // Without a way back from films beyond the limit it took hundreds.
                assert!(found.film_updates <= 45, "{what}: {}", found.film_updates);
                assert!((reached / share - 1.0).abs() < 2e-3, "{what}: {reached}");
                assert!(
                    found.table.len().abs_diff(mine.len()) <= 2,
                    "{what}: {} iterations, not {}",
                    found.table.len(),
                    mine.len()
                );
                squares(&found.table, &what);
            }
        }
    }
}

/// The tail squares its steps and leaves residuals of their square: from each settled iteration with a
/// full step on. The next one still has its set, which may change only after that. Steps are what tells: the residual alone is small, too, where the journal is off along
/// the film's softest direction.
fn squares(table: &[IterationRow], what: &str) {
    let mut seen = 0;
    for pair in table.windows(2) {
        let [before, after] = [&pair[0], &pair[1]];
        let is_tail = before.settled && before.taken == 1.0;
        if is_tail && before.step < 0.1 && after.residual > ROUND_OFF {
            let square = before.step * before.step;
            let [step, residual] = [after.step, after.residual].map(|value| value / square);
            println!("{what}: {step:.3} and {residual:.3} squares");
            assert!(step < SQUARES, "{what}: {table:#?}");
            assert!(residual < SQUARES, "{what}: {table:#?}");
            seen += 1;
        }
    }
    assert!(seen > 0, "{what}: no tail in {table:#?}");
    assert!(table.len() <= 25, "{what}: {} iterations", table.len());
}

fn thickening_at(cavitation: Cavitation, load: f64) -> (Equilibrium, f64) {
    let bearing = diesel_big_end(cavitation);
    let (found, film) = rest(&bearing, &thickening(), load, 209.4395);
    let reduced = ReducedPressure::of(&thickening(), CONDITIONS.temperature);
    let pressures = film.field().unwrap().pressure;
    let peak = pressures.iter().fold(0.0_f64, |a, p| a.max(*p));
    let share = reduced.reduced(peak) / reduced.limit();
    (found, share)
}

#[test]
fn close_to_the_limit_of_the_reduced_pressure_newton_squares_its_residual() {
    let study = Study {
        file: "roelands.csv",
        head: "share: peak reduced pressure over its limit; input: load, N, on the big end of common/mod.rs at 209.4395 rad/s, 6.8 mPa s, Roelands with 9.5e-9 1/Pa, 64 x 16 cells",
        shares: &[0.5, 0.7, 0.8, 0.9],
        range: [1e3, 1e6],
        solve: &thickening_at,
    };
    study.check();
    // The pressure of a cell grows only as the logarithm of what is left to the limit: a grid carries a
    // little more there, and then has no solution, and says so.
    for (name, cavitation) in CLOSURES {
        let rows = text_table("newton-tables/roelands.csv");
        let last = rows.iter().rfind(|row| row[0] == name).unwrap();
        let load: f64 = last[2].parse().unwrap();
        for over in [4.0, 6.0] {
            let (found, _) = thickening_at(cavitation, over * load);
            assert_eq!(found.outcome, Outcome::NoSolution, "{name}, {over}");
        }
    }
}

#[test]
fn carried_by_contact_newton_squares_its_residual() {
    let at = |cavitation, speed: f64| {
        let bearing = Bearing {
            finish: rig_finish(greenwood_tripp(1e-3)),
            ..diesel_big_end(cavitation)
        };
        let oil = Lubricant::constant(6.8e-3, 832.5);
        let load = 8e3;
        let (found, _) = rest(&bearing, &oil, load, speed);
        let [x, y] = found.reaction.contact_force;
        (found, x.hypot(y) / load)
    };
    Study {
        file: "contact.csv",
        head: "share: force of contact over load; input: speed, rad/s, of the rough big end of common/mod.rs under 8 kN, 6.8 mPa s, 64 x 16 cells",
        shares: &[0.1, 0.5, 0.9],
        range: [300.0, 1e-2],
        solve: &at,
    }
    .check();
}
