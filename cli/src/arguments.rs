//! The command line.

use clap::{Parser, Subcommand};
use std::path::PathBuf;

/// Simulates slide bearings of engines and machines, from load cycle to oil film.
#[derive(Debug, Parser)]
#[command(name = "sommerfeld", version, arg_required_else_help = true)]
#[command(
    after_help = "Exit status: 0 done; 1 something did not converge; 2 the input was refused; \
                        3 the machine failed (disk, permissions); 130 interrupted, a sweep, machine or \
                        database goes on with the same command."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a study and write its results
    Run(crate::run::RunArguments),
    /// Read and check a study file without running it
    Check {
        /// The study file
        file: PathBuf,
    },
    /// Write a study to start from
    New {
        /// Which one: big-end, main-bearing, coefficients, lemon-bearing, clearance-sweep,
        /// one-axis-cycle, film, dimensionless, engine-i1, engine-i3, engine-i4,
        /// engine-i5, engine-i6, engine-v6, engine-v8, engine-boxer,
        /// balancer-shaft, database
        template: String,
        /// Where to write it; made if it is not there
        directory: PathBuf,
    },
    /// Say what a key of the study file means; without a key, list all
    Explain {
        /// Such as bearing.diameter
        key: Option<String>,
    },
    /// Build, show, look up or check a database of films
    #[command(subcommand)]
    Database(crate::database::DatabaseCommand),
    /// Print the JSON schema of the study file
    Schema,
}
