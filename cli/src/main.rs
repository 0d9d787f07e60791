//! The `sommerfeld` command: parses its arguments, calls the library, prints. No physics here.
// A command's product is what it prints.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod arguments;
mod commands;
mod database;
mod exit;
mod progress;
mod run;

use arguments::{Arguments, Command};
use clap::Parser;
use exit::Exit;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are no errors; clap sends each to its own stream.
            let exit = if error.use_stderr() {
                Exit::Refused
            } else {
                Exit::Done
            };
            return match error.print() {
                Ok(()) => exit.into(),
                Err(_) => Exit::MachineFailed.into(),
            };
        }
    };
    let exit = match &arguments.command {
        Command::Run(arguments) => run::run(arguments),
        Command::Check { file } => commands::check(file),
        Command::New {
            template,
            directory,
        } => commands::new(template, directory),
        Command::Explain { key } => commands::explain(key.as_deref()),
        Command::Database(command) => database::database(command),
        Command::Schema => commands::schema(),
    };
    exit.into()
}
