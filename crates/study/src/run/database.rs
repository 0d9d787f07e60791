//! A database of films: built in the directory of the results, stopped and taken up again.
//!
//! The films that are solved lie in a file of their own until the database is whole; the same command
//! goes on with them. After the build, states are drawn anew and held against films solved for them.

use super::{ProgressCallback, RunError, RunOptions, RunSummary, finish_results, header};
use crate::film_tables::{FilmTable, StoredFilms};
use crate::input::{DatabasePlan, Study};
use crate::output::{OutputError, check_directory, prepare_directory, write_all};
use crate::progress::ProgressEvent;
use crate::results::database::{BuiltDatabase, DatabaseResults, ForceCurve, FreshSample};
use crate::results::{Body, Results};
use rayon::prelude::*;
use sommerfeld_database::superposition::{Accuracy, SuperpositionTable};
use sommerfeld_database::{DatabaseError, Progress, Table, check, generate};
use sommerfeld_film::Outcome;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Name of the database in the directory of the results.
pub const DATABASE_NAME: &str = "table.h5";
/// Films of a database that is not whole.
const UNFINISHED_NAME: &str = "unfinished.h5";
/// A sign of life at least this often.
const HEARTBEAT: Duration = Duration::from_millis(100);
/// Points of a curve of the report.
const CURVE: usize = 81;

/// Builds the database into `directory`.
pub(super) fn run_database(
    study: &Study,
    plan: &DatabasePlan,
    directory: &Path,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<RunSummary, RunError> {
    check_directory(directory, &study.files)?;
    prepare_directory(directory)?;
    let unfinished = directory.join(UNFINISHED_NAME);
    let file = directory.join(DATABASE_NAME);
    let start = Instant::now();
    let built = build(plan, Some((&unfinished, &file)), options, progress)?;
    let results = match built {
        None => results(study, unfinished, None, start),
        Some(found) => {
            let built = described(&file, plan, found)?;
            results(study, file.clone(), Some(built), start)
        }
    };
    let mut files = write_all(&results, directory)?;
    if file.exists() {
        files.insert(0, file);
    }
    Ok(RunSummary { results, files })
}

/// Builds the database and writes nothing.
pub(super) fn solve_database(
    study: &Study,
    plan: &DatabasePlan,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Results, RunError> {
    let start = Instant::now();
    let file = Path::new(DATABASE_NAME).to_path_buf();
    let built = match build(plan, None, options, progress)? {
        None => None,
        Some(found) => Some(described(&file, plan, found)?),
    };
    Ok(results(study, file, built, start))
}

fn results(study: &Study, file: PathBuf, built: Option<BuiltDatabase>, start: Instant) -> Results {
    let mut header = header(study);
    header.wall_time = start.elapsed().as_secs_f64();
    match &built {
        None => {
            header.status = Outcome::NotConverged;
            header.messages.insert(
                0,
                "interrupted: run the same command again to go on with the films that are solved"
                    .to_owned(),
            );
        }
        Some(built) if built.fresh_maximum() > built.target => {
            header.status = Outcome::NotConverged;
            header.messages.insert(
                0,
                format!(
                    "a state drawn anew errs by {:.2e}, more than the target {:.2e}: build with \
                     more samples or a smaller target",
                    built.fresh_maximum(),
                    built.target
                ),
            );
        }
        Some(built) if built.facts.status != Outcome::Converged => {
            header.status = Outcome::NotConverged;
            header.messages.insert(
                0,
                format!(
                    "with as many films as it may have, the database errs by up to {:.2e} at random states, \
                     more than the target {:.2e}: raise the target or database.most_films, or narrow what it \
                     holds (last_eccentricity, smallest_gap)",
                    built.facts.stated_error, built.target
                ),
            );
        }
        Some(_) => {}
    }
    let mut results = Results {
        header,
        body: Body::Database(Box::new(DatabaseResults {
            file,
            built,
            build_time: start.elapsed().as_secs_f64(),
        })),
    };
    finish_results(study, &mut results);
    results
}

/// What the calling thread hears of the threads that solve films.
#[derive(Default)]
struct Watch {
    done: AtomicUsize,
    total: AtomicUsize,
    level: AtomicUsize,
    is_checking: AtomicBool,
    /// All levels but those that a missed target adds are known from the start.
    is_one_level: AtomicBool,
    is_stopped: AtomicBool,
    /// Bits of the largest share that was told.
    farthest: AtomicU64,
}

impl Progress for Watch {
    fn films(&self, done: usize, total: usize) {
        if self.total.swap(total, Ordering::Relaxed) != total {
            self.level.fetch_add(1, Ordering::Relaxed);
        }
        self.done.store(done, Ordering::Relaxed);
    }

    fn interrupted(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }
}

impl Watch {
    /// A bar does not go back.
    fn kept(&self, share: f64) -> f64 {
        // Shares are positive, whose bits are in their order.
        let before = self.farthest.fetch_max(share.to_bits(), Ordering::Relaxed);
        share.max(f64::from_bits(before))
    }

    /// Levels share the bar by halves of what is left: how many follow is known at the end alone.
    fn event(&self) -> ProgressEvent {
        let load = |number: &AtomicUsize| number.load(Ordering::Relaxed);
        let (done, total, level) = (load(&self.done), load(&self.total), load(&self.level));
        if self.is_checking.load(Ordering::Relaxed) {
            return ProgressEvent::new("drawing states anew", 0.97);
        }
        if level == 0 {
            return ProgressEvent::new("starting", 0.0);
        }
        let share = done as f64 / total.max(1) as f64;
        if self.is_one_level.load(Ordering::Relaxed) {
            let label = match level {
                1 => format!("{done} of {total} films"),
                _ => format!("target missed, refined: {done} of {total} films"),
            };
            return ProgressEvent::new(label, self.kept(0.99 * share));
        }
        let before = 1.0 - 0.5_f64.powi(level.saturating_sub(1) as i32);
        let label = format!("level {level}, {done} of {total} films");
        ProgressEvent::new(label, 0.95 * (before + 0.5 * (1.0 - before) * share))
    }
}

/// A database, with states drawn anew.
struct Found {
    table: FilmTable,
    fresh: Vec<FreshSample>,
}

/// Solves the films on so many threads while this one shows how far it is; `None` where it was stopped.
/// With `files`, what is solved so far lies in the first and the database in the second.
fn build(
    plan: &DatabasePlan,
    files: Option<(&Path, &Path)>,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Option<Found>, RunError> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads.unwrap_or(0))
        .build()
        .map_err(|error| RunError::Threads(error.to_string()))?;
    let watch = Watch::default();
    let ended = std::thread::scope(|scope| {
        let (watch, pool) = (&watch, &pool);
        let work = scope.spawn(move || pool.install(|| built_and_checked(plan, files, watch)));
        while !work.is_finished() {
            if progress(watch.event()).is_break() {
                watch.is_stopped.store(true, Ordering::Relaxed);
            }
            std::thread::park_timeout(HEARTBEAT);
        }
        work.join()
    });
    match ended {
        Ok(Ok(found)) => Ok(Some(found)),
        Ok(Err(DatabaseError::Interrupted { .. })) => Ok(None),
        Ok(Err(error @ DatabaseError::File { .. })) => {
            let path = files.map_or(Path::new(DATABASE_NAME), |(_, file)| file);
            Err(disk(&error, path))
        }
        Ok(Err(error)) => Err(RunError::Database(error.to_string())),
        Err(_) => Err(RunError::Threads(
            "a thread of the build ended early".to_owned(),
        )),
    }
}

fn built_and_checked(
    plan: &DatabasePlan,
    files: Option<(&Path, &Path)>,
    watch: &Watch,
) -> Result<Found, DatabaseError> {
    match plan {
        DatabasePlan::Combined(recipe) => {
            let table = generate(recipe, watch, files.map(|(unfinished, _)| unfinished))?;
            watch.is_checking.store(true, Ordering::Relaxed);
            let table = Arc::new(table);
            let fresh = fresh_samples(&table, recipe.samples, recipe.seed.wrapping_add(1))?;
            if let Some((_, file)) = files {
                table.save(file)?;
            }
            Ok(Found {
                table: FilmTable::Combined(table),
                fresh,
            })
        }
        DatabasePlan::Superposition(recipe) => {
            // It keeps what is solved beside the file that it is to be.
            let file = files.map(|(_, file)| file);
            watch.is_one_level.store(true, Ordering::Relaxed);
            let table = SuperpositionTable::build(recipe, file, &mut |done, total| {
                watch.films(done, total);
                !watch.interrupted()
            })?;
            Ok(Found {
                table: FilmTable::Superposition(Arc::new(table)),
                fresh: Vec::new(),
            })
        }
    }
}

/// States drawn from seeds of their own, each against the film solved for it.
fn fresh_samples(
    table: &Arc<Table>,
    count: usize,
    seed: u64,
) -> Result<Vec<FreshSample>, DatabaseError> {
    (0..count as u64)
        .into_par_iter()
        .map(|index| {
            // Seeds far apart, so that those of neighbouring numbers share no state.
            let own = seed.wrapping_mul(0x2545_f491_4f6c_dd1d).wrapping_add(index);
            let found = check(table, 1, own)?;
            Ok(FreshSample {
                eccentricity: found.worst.eccentricity,
                angle: found.worst.angle,
                error: found.maximum,
            })
        })
        .collect()
}

/// What the reader of the results sees of a database.
fn described(file: &Path, plan: &DatabasePlan, found: Found) -> Result<BuiltDatabase, RunError> {
    let stored = StoredFilms {
        name: file.to_string_lossy().into_owned(),
        table: found.table,
    };
    let worst = |of: fn(&Accuracy) -> f64, accuracy: &[Accuracy]| {
        accuracy.iter().map(of).fold(0.0, f64::max)
    };
    let (quantiles, peak_maximum, axes) = match &stored.table {
        FilmTable::Combined(table) => {
            let errors = table.errors();
            let names = ["width ratio", "eccentricity", "direction"];
            let axes = names.into_iter().zip(table.axes().counts());
            (
                [errors.quantile_999, errors.median],
                Some(errors.peak_maximum),
                axes.collect(),
            )
        }
        FilmTable::Superposition(table) => {
            let accuracy = table.accuracy();
            let [along, across] = table.recipe().tilt_nodes;
            let axes = vec![
                ("drive", accuracy.len()),
                ("eccentricity", table.recipe().eccentricity_nodes),
                ("tilt", along),
                ("transverse tilt", across),
            ];
            let quantiles = [worst(|a| a.of_999, accuracy), worst(|a| a.median, accuracy)];
            (quantiles, None, axes)
        }
    };
    let curves = curves(&stored).map_err(|error| RunError::Database(error.to_string()))?;
    Ok(BuiltDatabase {
        facts: stored.facts(),
        target: plan.target(),
        quantile_999: quantiles[0],
        median: quantiles[1],
        peak_maximum,
        axes,
        fresh: found.fresh,
        curves,
    })
}

/// Force and peak pressure over the eccentricity for a closing, sliding and opening gap and between.
fn curves(stored: &StoredFilms) -> Result<Vec<ForceCurve>, DatabaseError> {
    let facts = stored.facts();
    let middle = (facts.width_ratios[0] * facts.width_ratios[1]).sqrt();
    let last = facts.last_eccentricity;
    let mut all = Vec::new();
    for degrees in [0.0_f64, 60.0, 90.0, 120.0, 180.0] {
        let angle = degrees.to_radians();
        let mut curve = ForceCurve {
            angle,
            eccentricity: Vec::new(),
            force: Vec::new(),
            peak: Vec::new(),
        };
        for index in 0..CURVE {
            let share = index as f64 / (CURVE - 1) as f64;
            let eccentricity = (last.atanh() * share).tanh();
            let found = stored.look(middle, eccentricity, angle)?;
            curve.eccentricity.push(eccentricity);
            curve.force.push(found.force[0].hypot(found.force[1]));
            curve.peak.push(found.peak_pressure);
        }
        all.push(curve);
    }
    Ok(all)
}

fn disk(error: &DatabaseError, path: &Path) -> RunError {
    RunError::Output(OutputError::Disk {
        action: "write the database",
        path: path.to_path_buf(),
        source: std::io::Error::other(error.to_string()),
    })
}
