//! Exit status, the same for every command.

use std::process::ExitCode;

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// Done, and converged.
    Done,
    /// Finished, but something did not converge or a case failed.
    NotConverged,
    /// The input was refused, or the arguments.
    Refused,
    /// Disk, permissions: the machine failed us.
    MachineFailed,
    /// Stopped by the user.
    Interrupted,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Done => 0,
            Exit::NotConverged => 1,
            Exit::Refused => 2,
            Exit::MachineFailed => 3,
            Exit::Interrupted => 130,
        })
    }
}
