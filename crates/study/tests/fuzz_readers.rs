//! Mutated studies and tables: whatever stands in a file, the readers answer soon, briefly and twice
//! the same, and never panic.
//!
//! `FUZZ_SECONDS` and `FUZZ_SEED` set how long and from where; `fuzz/run` does so. The input at work
//! lies in the directory `fuzz` of the temporary directory that Cargo gives to tests, so that it is
//! there even after an abort or an endless loop.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::print_stderr,
    missing_docs
)]

use sommerfeld_study::input::{DatabasePlan, Duty, KEYS, Machine, MachinePlan, Study, Subject};
use sommerfeld_study::load_study;
use sommerfeld_study::templates::TEMPLATES;
use std::env;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Longest time for one input.
const SLOW: Duration = Duration::from_secs(2);
/// After this an input is taken to loop for ever.
const HANGS: u64 = 60;
/// Longest answer: a page or two of messages.
const LONGEST_ANSWER: usize = 16_000;
/// Longest input that mutation builds, bytes.
const LONGEST_INPUT: usize = 1 << 18;

/// Numbers on the edges of types, ranges and spellings.
const NUMBERS: &[&str] = &[
    "0",
    "-0",
    "0.0",
    "1",
    "-1",
    "1e308",
    "-1e308",
    "1e400",
    "5e-324",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "0xffffffffffffffff",
    "0b1",
    "0o7",
    "1_000",
    "1__0",
    "0,5",
    "1.000,5",
    "1 000",
    "00",
    "01",
    ".5",
    "5.",
    "1e",
    "1e+",
    "0.1e-400",
    "2026-11-22",
    "12:00:00",
    "true",
    "\u{2212}5",
    "\u{ff11}",
    "\u{bd}",
    "1e5e5",
];
/// Pieces that mean something to one of the readers.
const PIECES: &[&str] = &[
    "\"",
    "\"\"\"",
    "'",
    "'''",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "=",
    ",",
    ".",
    "#",
    "\n",
    "\r\n",
    "\r",
    "\t",
    "\0",
    ";",
    "\\",
    "\\u{0}",
    "\\uD800",
    "\u{feff}",
    "\u{2028}",
    "\u{202e}",
    "\u{b5}",
    "\u{3bc}",
    "\u{e9}",
    "\u{65e5}",
    "\u{1f600}",
    "schema = 2\n",
    "[bearing]\n",
    "[[bearing.groove]]\n",
    "[bearing.groove]\n",
    "bearing.diameter = \"1 mm\"\n",
    "a.b.c.d = 1\n",
    "mm",
    "um",
    "1/s",
    "rpm",
    " \u{b0}C",
    "MPa",
    "mPa.s",
    "{ law = \"vogel\" }",
    "{ value = \"1 um\", source = \"\" }",
    "dimensionless = true\n",
    "analysis = \"film\"\n",
    "analysis = \"load-cycle\"\n",
    "analysis = \"engine\"\n",
    "analysis = \"shaft\"\n",
    "[[bearing]]\n",
    "of = \"main\"\n",
    "fed_by = 1\n",
    "file = \"loads.csv\"\n",
    "crank_angle[deg]",
    "load_x[kN]",
    "moment_x[N.m]",
    "[rad]",
    "NaN,,\n",
];

/// Numbers that look random and come again from the same seed (splitmix64, S. Vigna, public domain
/// algorithm).
struct Dice(u64);

impl Dice {
    fn throw(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Below `sides`; 0 where there are none.
    fn below(&mut self, sides: usize) -> usize {
        (self.throw() % sides.max(1) as u64) as usize
    }

    fn pick<'a, T: ?Sized>(&mut self, of: &[&'a T]) -> &'a T {
        of[self.below(of.len())]
    }
}

/// Studies and tables to start from.
struct Corpus {
    /// Studies that are accepted before they are mutated, first those of the templates.
    good: Vec<Vec<u8>>,
    /// These and the bad inputs.
    studies: Vec<Vec<u8>>,
    tables: Vec<Vec<u8>>,
}

fn corpus() -> Corpus {
    let mut corpus = Corpus {
        good: Vec::new(),
        studies: Vec::new(),
        tables: Vec::new(),
    };
    for template in TEMPLATES {
        corpus.studies.push(template.study.into());
        for (_, table) in template.files {
            corpus.tables.push((*table).into());
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    collect(&root.join("../../examples"), &mut corpus);
    collect(&root.join("../../validation"), &mut corpus);
    corpus.good.clone_from(&corpus.studies);
    collect(&root.join("tests/bad_inputs"), &mut corpus);
    corpus
}

fn collect(directory: &Path, corpus: &mut Corpus) {
    let mut paths: Vec<PathBuf> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    // The same seed meets the same inputs on every machine.
    paths.sort();
    for path in paths {
        let kind = path.extension().and_then(|kind| kind.to_str());
        match kind {
            _ if path.is_dir() => collect(&path, corpus),
            Some("toml") => corpus.studies.push(fs::read(&path).unwrap()),
            Some("csv") => {
                let mut table = fs::read(&path).unwrap();
                table.truncate(20_000);
                corpus.tables.push(table);
            }
            _ => {}
        }
    }
}

/// Bytes of the line around a place.
fn line_at(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    let at = at.min(bytes.len());
    let start = bytes[..at]
        .iter()
        .rposition(|&b| b == b'\n')
        .map_or(0, |i| i + 1);
    let end = bytes[at..]
        .iter()
        .position(|&b| b == b'\n')
        .map_or(bytes.len(), |i| at + i + 1);
    start..end
}

/// Bytes of the number at or behind a place.
fn number_behind(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    let Some(found) = bytes[at..].iter().position(u8::is_ascii_digit) else {
        return at..at;
    };
    let start = at + found;
    let is_part = |b: &u8| b.is_ascii_digit() || matches!(b, b'.' | b'e' | b'-');
    let length = bytes[start..].iter().take_while(|b| is_part(b)).count();
    start..start + length
}

/// One change of an input; `others` are what it may take pieces from.
fn mutate(bytes: &mut Vec<u8>, others: &[Vec<u8>], dice: &mut Dice) {
    let at = dice.below(bytes.len() + 1);
    match dice.below(14) {
        0 if at < bytes.len() => bytes[at] ^= 1 << dice.below(8),
        1 if at < bytes.len() => bytes[at] = dice.throw() as u8,
        2 => bytes.truncate(at),
        3 => drop(bytes.drain(at..(at + 1 + dice.below(40)).min(bytes.len()))),
        4 => {
            let line = bytes[line_at(bytes, at)].to_vec();
            let start = line_at(bytes, at).start;
            let copies = line.repeat(1 + dice.below(3));
            drop(bytes.splice(start..start, copies));
        }
        5 => drop(bytes.drain(line_at(bytes, at))),
        6 => {
            let line: Vec<u8> = bytes.drain(line_at(bytes, at)).collect();
            let place = dice.below(bytes.len() + 1);
            let start = line_at(bytes, place).start;
            drop(bytes.splice(start..start, line));
        }
        7 => {
            let other = &others[dice.below(others.len())];
            let from = dice.below(other.len());
            let to = (from + dice.below(300)).min(other.len());
            drop(bytes.splice(at..at, other[from..to].iter().copied()));
        }
        8 | 9 => {
            let number = dice.pick(NUMBERS).bytes();
            let range = number_behind(bytes, at);
            drop(bytes.splice(range, number));
        }
        10 => {
            let piece = dice.pick(PIECES).bytes();
            drop(bytes.splice(at..at, piece));
        }
        11 => {
            let key = KEYS[dice.below(KEYS.len())].path;
            let value = dice.pick(NUMBERS);
            let line = match dice.below(3) {
                0 => format!("{key} = {value}\n"),
                1 => format!("{key} = \"{value} mm\"\n"),
                _ => format!(
                    "{} = [\"{value} N\", {value}]\n",
                    key.rsplit('.').next().unwrap()
                ),
            };
            let start = line_at(bytes, at).start;
            drop(bytes.splice(start..start, line.into_bytes()));
        }
        12 => {
            // A piece many times over: nesting, long lines, long lists.
            let piece = dice.pick(PIECES).repeat(1 << dice.below(13));
            drop(bytes.splice(at..at, piece.into_bytes()));
        }
        _ => {
            let letter = char::from_u32(dice.below(0x11_0000) as u32).unwrap_or('\u{fffd}');
            let mut utf8 = [0; 4];
            let letter = letter.encode_utf8(&mut utf8).as_bytes().to_vec();
            drop(bytes.splice(at..at, letter));
        }
    }
    bytes.truncate(LONGEST_INPUT);
}

/// Every number a run would use is finite.
fn is_finite(study: &Study) -> bool {
    let case = match &study.subject {
        Subject::Dimensionless(case) => {
            return case.d_over_b.is_finite() && case.relative_eccentricity.is_finite();
        }
        Subject::Bearing(case) => case,
        Subject::Machine(plan) => return is_finite_machine(plan),
        Subject::Database(plan) => return is_finite_database(plan),
        // Its cases are studies that are checked one by one.
        Subject::Sweep(_) => return true,
    };
    let bearing = &case.bearing;
    let viscosity = case.lubricant.viscosity(case.temperature, 0.0).value;
    let sizes = [bearing.diameter, bearing.width, bearing.radial_clearance];
    let loads = match &case.duty {
        Duty::State(state) => state.position.iter().chain(&state.velocity).sum(),
        Duty::Load(load) => load.load[0].abs().max(load.load[1].abs()),
        Duty::Cycle(duty) => duty
            .cycle
            .points
            .iter()
            .flat_map(|point| [point.crank_angle, point.load[0], point.load[1]])
            .map(f64::abs)
            .fold(0.0, f64::max),
    };
    sizes.iter().all(|size| *size > 0.0 && size.is_finite())
        && viscosity > 0.0
        && viscosity.is_finite()
        && f64::is_finite(loads)
}

/// Every number that a database would be built from is one.
fn is_finite_database(plan: &DatabasePlan) -> bool {
    match plan {
        DatabasePlan::Combined(recipe) => recipe.check().is_ok() && recipe.target.is_finite(),
        DatabasePlan::Superposition(recipe) => {
            let [first, last] = recipe.eccentricities;
            recipe.d_over_b > 0.0
                && recipe.d_over_b.is_finite()
                && (0.0..1.0).contains(&first)
                && (first..1.0).contains(&last)
                && recipe.target > 0.0
                && recipe.target.is_finite()
        }
    }
}

/// Every bearing, mass and pressure of a machine is a number that a run can use.
fn is_finite_machine(plan: &MachinePlan) -> bool {
    let bearings = plan.bearings.iter().all(|bearing| {
        let (supplied, cycles) = plan.supplied(bearing, plan.speeds[0]);
        let sizes = [supplied.diameter, supplied.width, supplied.radial_clearance];
        let feeds = supplied.feeds.iter().map(|feed| feed.pressure + feed.angle);
        let cycles = cycles.iter().flat_map(|cycle| &cycle.points).flatten();
        sizes.iter().all(|size| *size > 0.0 && size.is_finite())
            && feeds.chain(cycles.copied()).all(f64::is_finite)
    });
    let machine = match &plan.machine {
        Machine::Engine(engine) => {
            let train = &engine.train;
            let pressures = engine
                .gas
                .diagrams
                .iter()
                .flat_map(|(_, d)| &d.points)
                .flatten();
            let own = [
                train.bore,
                train.crank_radius,
                train.rod_length,
                train.rod.inertia,
            ];
            let places = train.layout.mains.iter().chain(&own).chain(pressures);
            train.rod_length > train.crank_radius && places.copied().all(f64::is_finite)
        }
        Machine::Shaft(shaft) => {
            let loads = shaft.loads.iter().flat_map(|load| &load.points).flatten();
            let sections = shaft.sections.iter().map(|s| s.length + s.diameter);
            shaft
                .bearings
                .iter()
                .chain(loads)
                .copied()
                .chain(sections)
                .all(f64::is_finite)
        }
    };
    bearings
        && machine
        && plan
            .speeds
            .iter()
            .all(|speed| *speed > 0.0 && speed.is_finite())
}

/// Reads an input and holds the answer against the promises; `true` where it is accepted.
fn check(file: &Path) -> bool {
    match load_study(file) {
        Ok(study) => {
            assert!(is_finite(&study), "accepted with a number that is none");
            let again = load_study(file);
            assert!(again.is_ok_and(|again| again == study), "read differently");
            true
        }
        Err(errors) => {
            assert!(!errors.0.is_empty(), "refused without a word");
            for colours in [false, true] {
                let text = errors.render(colours);
                assert!(
                    (1..=LONGEST_ANSWER).contains(&text.len()),
                    "an answer of {} bytes",
                    text.len()
                );
            }
            assert!(
                load_study(file).is_err_and(|again| again == errors),
                "read differently"
            );
            false
        }
    }
}

/// What a run of the fuzzer did.
#[derive(Debug, Default)]
struct Tally {
    executions: u64,
    accepted: u64,
    slowest: Duration,
    findings: Vec<String>,
}

fn setting(name: &str, default: u64) -> u64 {
    env::var(name)
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(default)
}

/// Ends the program where one input takes for ever: the input is on the disk.
fn watch(executions: &'static AtomicU64, directory: PathBuf) {
    std::thread::spawn(move || {
        let mut before = u64::MAX;
        loop {
            std::thread::sleep(Duration::from_secs(HANGS));
            let now = executions.load(Ordering::Relaxed);
            if now == before {
                eprintln!(
                    "an input takes more than {HANGS} s: {}",
                    directory.display()
                );
                std::process::exit(1);
            }
            before = now;
        }
    });
}

/// Writes a file over the one before. To empty it first would have some file systems flush it to the
/// disk each time.
fn put(path: &Path, bytes: &[u8]) {
    let mut options = OpenOptions::new();
    let mut file = options
        .write(true)
        .create(true)
        .truncate(false)
        .open(path)
        .unwrap();
    file.write_all(bytes).unwrap();
    file.set_len(bytes.len() as u64).unwrap();
}

/// A study to read, and the table it names: one of the two is mutated, now and then both.
fn next_input(corpus: &Corpus, dice: &mut Dice) -> (Vec<u8>, Vec<u8>) {
    let table = &corpus.tables[dice.below(corpus.tables.len())];
    let (mut study, mut table) = match dice.below(3) {
        0 => {
            let plain = TEMPLATES[0].study;
            (plain.as_bytes().to_vec(), table.clone())
        }
        _ => {
            let from = match dice.below(4) {
                0 => &corpus.studies,
                _ => &corpus.good,
            };
            let study = &from[dice.below(from.len())];
            (study.clone(), TEMPLATES[0].files[0].1.into())
        }
    };
    let is_table = study == TEMPLATES[0].study.as_bytes();
    // Few changes reach far into the reader, many change what it sees first.
    let most = [1, 1, 2, 6][dice.below(4)];
    for _ in 0..1 + dice.below(most) {
        if is_table || dice.below(8) == 0 {
            mutate(&mut table, &corpus.tables, dice);
        } else {
            mutate(&mut study, &corpus.studies, dice);
        }
    }
    (study, table)
}

#[test]
fn mutated_inputs_are_answered() {
    static EXECUTIONS: AtomicU64 = AtomicU64::new(0);
    let seconds = setting("FUZZ_SECONDS", 10);
    let seed = setting("FUZZ_SEED", 1);
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz");
    fs::create_dir_all(&directory).unwrap();
    let file = directory.join("study.toml");
    for (name, content) in TEMPLATES.iter().flat_map(|template| template.files) {
        put(&directory.join(name), content.as_bytes());
    }
    let corpus = corpus();
    let mut dice = Dice(seed);
    let mut tally = Tally::default();
    watch(&EXECUTIONS, directory.clone());
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(seconds) {
        let (study, table) = next_input(&corpus, &mut dice);
        put(&file, &study);
        put(&directory.join("loads.csv"), &table);
        let begun = Instant::now();
        let answer = catch_unwind(AssertUnwindSafe(|| check(&file)));
        let taken = begun.elapsed();
        tally.executions += 1;
        EXECUTIONS.store(tally.executions, Ordering::Relaxed);
        tally.slowest = tally.slowest.max(taken);
        match answer {
            Ok(accepted) => tally.accepted += u64::from(accepted),
            Err(_) => keep(&mut tally, &directory, &study, &table, "broken"),
        }
        // On a busy machine an input may wait for its turn: slow is what is slow each time.
        let again = || {
            let begun = Instant::now();
            let _ = load_study(&file);
            begun.elapsed()
        };
        if taken > SLOW && (0..3).all(|_| again() > SLOW) {
            keep(&mut tally, &directory, &study, &table, "slow");
        }
        if tally.findings.len() >= 20 {
            break;
        }
    }
    println!(
        "seed {seed}: {} inputs in {:.0} s, {} accepted, slowest {:.3} s, {} findings",
        tally.executions,
        start.elapsed().as_secs_f64(),
        tally.accepted,
        tally.slowest.as_secs_f64(),
        tally.findings.len()
    );
    assert!(tally.findings.is_empty(), "{:#?}", tally.findings);
    // A fuzzer that accepts nothing, or everything, tests one half of the readers only.
    assert!(tally.executions < 1000 || (1..tally.executions).contains(&tally.accepted));
}

/// Keeps an input that broke a promise.
fn keep(tally: &mut Tally, directory: &Path, study: &[u8], table: &[u8], kind: &str) {
    let place = directory.join(format!("{kind}-{}", tally.executions));
    fs::create_dir_all(&place).unwrap();
    fs::write(place.join("study.toml"), study).unwrap();
    fs::write(place.join("loads.csv"), table).unwrap();
    tally.findings.push(place.display().to_string());
}
