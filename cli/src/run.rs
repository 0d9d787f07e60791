//! `sommerfeld run`: reads a study, runs it, tells what was found and where it lies.

use crate::commands;
use crate::exit::Exit;
use crate::progress::{Progress, stop_flag};
use clap::Args;
use sommerfeld_study::cases::CaseStatus;
use sommerfeld_study::input::{Analysis, Study};
use sommerfeld_study::output::OutputError;
use sommerfeld_study::results::{Body, Results, status_name};
use sommerfeld_study::{Outcome, RunError, RunOptions, RunSummary};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

/// Arguments of `run`.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// The study file
    pub file: PathBuf,
    /// Directory of the results [default: beside the study, named after it]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Solve on coarser grids and with longer time steps too, and state error bars; not of a machine
    #[arg(long)]
    pub verify: bool,
    /// Threads for the cases of a sweep or the bearings of a machine; no result depends on it [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

/// Checks the study, runs it and tells how it ended.
pub fn run(arguments: &RunArguments) -> Exit {
    match commands::read(&arguments.file) {
        Ok(study) => run_study(&study, arguments),
        Err(exit) => exit,
    }
}

/// Builds the database that a study describes.
pub fn build_database(arguments: &RunArguments) -> Exit {
    let study = match commands::read(&arguments.file) {
        Ok(study) => study,
        Err(exit) => return exit,
    };
    if study.analysis != Analysis::Database {
        eprintln!(
            "error: {}: the analysis {} builds no database\n  = hint: `sommerfeld new database DIR` writes \
             a study that does",
            arguments.file.display(),
            study.analysis.name()
        );
        return Exit::Refused;
    }
    run_study(&study, arguments)
}

fn run_study(study: &Study, arguments: &RunArguments) -> Exit {
    let out = arguments
        .out
        .clone()
        .unwrap_or_else(|| default_directory(&arguments.file));
    let stop = stop_flag();
    let mut progress = Progress::new(stop.clone());
    let options = RunOptions {
        verify: arguments.verify,
        threads: arguments.threads.map(usize::from),
    };
    let ended =
        sommerfeld_study::run_with(study, &out, options, &mut |event| progress.show(&event));
    progress.finish();
    match ended {
        Ok(summary) => {
            let told = commands::print(&told(&summary, &out));
            let header = &summary.results.header;
            let is_unfinished = is_unfinished(&summary.results, arguments.verify);
            if stop.load(Ordering::Relaxed) && is_unfinished {
                eprintln!("interrupted: run the same command again to finish it");
                Exit::Interrupted
            } else if header.status == Outcome::Converged {
                told
            } else {
                Exit::NotConverged
            }
        }
        Err(
            error @ (RunError::Film(_)
            | RunError::Bearing { .. }
            | RunError::Machine { .. }
            | RunError::NoErrorBars { .. }
            | RunError::Database(_)),
        ) => {
            eprintln!("error: {}: {error}", arguments.file.display());
            Exit::Refused
        }
        Err(error) => {
            eprintln!("error: {error}");
            match error {
                RunError::Output(OutputError::Taken { .. }) => Exit::Refused,
                RunError::Ledger(error) if error.is_refusal() => Exit::Refused,
                RunError::InputChanged(_) => Exit::Refused,
                _ => Exit::MachineFailed,
            }
        }
    }
}

/// Whether a run that was stopped has something left to do.
fn is_unfinished(results: &Results, verify: bool) -> bool {
    match &results.body {
        Body::Database(database) => database.built.is_none(),
        Body::Sweep(sweep) => sweep.count(CaseStatus::NotRun) > 0,
        Body::Machine(machine) => machine.missing() > 0,
        _ => {
            let header = &results.header;
            let comparison = header.comparison.as_ref();
            header.status != Outcome::Converged
                || (verify && header.error.is_none())
                || comparison.is_some_and(|comparison| comparison.is_unfinished())
        }
    }
}

/// Status, key figures and the place of the report, a few lines.
fn told(summary: &RunSummary, out: &Path) -> String {
    let header = &summary.results.header;
    let mut text = format!("{}: {}\n", header.analysis, status_name(header.status));
    for message in &header.messages {
        text += &format!("  {message}\n");
    }
    for (name, value) in summary.results.key_figures() {
        text += &format!("  {name:<24} {value}\n");
    }
    for check in &header.limits {
        text += &format!("  {check}\n");
    }
    let report = out.join("report.html");
    text + &format!(
        "results in {}\nreport  in {}\n",
        out.display(),
        report.display()
    )
}

/// Beside the study, named after it.
fn default_directory(file: &Path) -> PathBuf {
    match file.extension() {
        Some(_) => file.with_extension(""),
        // The study itself has that name.
        None => file.with_extension("results"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_lie_beside_the_study() {
        let directory = |file: &str| default_directory(Path::new(file));
        assert_eq!(directory("a/big-end.toml"), Path::new("a/big-end"));
        assert_eq!(directory("a/study"), Path::new("a/study.results"));
    }
}
