//! `sommerfeld run`: what surrounds a run. The run itself is handed in, so that this file knows
//! neither options nor results of the library.

use crate::commands;
use crate::exit::Exit;
use crate::progress::{Progress, stop_flag};
use clap::Args;
use sommerfeld_study::{ProgressEvent, Study};
use std::ops::ControlFlow;
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
    /// Solve on a second grid and state error bars
    #[arg(long)]
    pub verify: bool,
    /// Threads to use [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

/// Answers an event of the run with whether to go on.
pub type Callback<'c> = &'c mut dyn FnMut(ProgressEvent) -> ControlFlow<()>;

/// Checks the study, runs it by `runner(study, results directory, progress)` and tells how it ended.
pub fn run(
    arguments: &RunArguments,
    runner: impl FnOnce(&Study, &Path, Callback<'_>) -> Exit,
) -> Exit {
    if arguments.verify {
        eprintln!(
            "error: --verify is not built yet in version {}",
            env!("CARGO_PKG_VERSION")
        );
        return Exit::Refused;
    }
    let study = match commands::read(&arguments.file) {
        Ok(study) => study,
        Err(exit) => return exit,
    };
    let out = arguments
        .out
        .clone()
        .unwrap_or_else(|| default_directory(&arguments.file));
    let stop = stop_flag();
    let mut progress = Progress::new(stop.clone());
    let exit = runner(&study, &out, &mut |event| progress.show(&event));
    progress.finish();
    if exit != Exit::Done && stop.load(Ordering::Relaxed) {
        eprintln!("interrupted; the same command resumes in {}", out.display());
        return Exit::Interrupted;
    }
    exit
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
