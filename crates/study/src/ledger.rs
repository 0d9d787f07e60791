//! The ledger of a run of many cases: which are done, on disk, so that a run that ends in any way, a
//! power cut among them, is taken up where it stood.
//!
//! One SQLite file in the directory of the results. A case of a sweep counts as done when its record
//! is committed, and never before its files are written; a unit of a machine when its findings are
//! committed, which stand in the ledger itself until the results are written. What is not committed is
//! run again. Write-ahead logging keeps the file whole when the program is killed. A lock file, which
//! the system releases with the program, keeps a second run out.

use crate::cases::{CaseRecord, CaseStatus};
use crate::results::VERSION;
use rusqlite::{Connection, OptionalExtension, params};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;
use thiserror::Error;

/// Name of the ledger in the directory of the results.
pub const FILE_NAME: &str = "ledger.sqlite";
const LOCK_NAME: &str = "ledger.lock";
/// Version of its tables.
const LAYOUT: i64 = 2;
/// How long to wait for somebody who reads the ledger meanwhile.
const PATIENCE: Duration = Duration::from_secs(60);

const TABLES: &str = "
    CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
    CREATE TABLE cases (
        number INTEGER PRIMARY KEY,
        inputs TEXT NOT NULL,          -- JSON: varied key -> value
        hash TEXT NOT NULL,            -- of the text of the case and the files it names
        starts INTEGER NOT NULL DEFAULT 0,
        starts_when_finished INTEGER,  -- equal to starts unless a finished case was run again
        status TEXT,                   -- NULL until the case is finished
        message TEXT,
        summary TEXT,                  -- JSON
        wall_time_s REAL,
        program_version TEXT
    );
    CREATE TABLE findings (number INTEGER PRIMARY KEY, content BLOB NOT NULL);
";

/// A ledger that cannot be used.
#[derive(Debug, Error)]
pub enum LedgerError {
    /// Another run is at work.
    #[error(
        "another run is at work in {}{}\n  = hint: wait for it, or give this one a directory of its own with --out",
        directory.display(),
        process.as_ref().map_or(String::new(), |id| format!(" (process {id})"))
    )]
    Busy {
        /// The directory.
        directory: PathBuf,
        /// The other process, if it left its number.
        process: Option<String>,
    },
    /// The directory holds the results of another study.
    #[error(
        "{} holds the results of another study, {title}: {}\n  = hint: give this one a directory of its own with --out, or remove that one to begin anew",
        directory.display(),
        differences.join("; ")
    )]
    OtherStudy {
        /// The directory.
        directory: PathBuf,
        /// The study that the directory belongs to.
        title: String,
        /// What differs.
        differences: Vec<String>,
    },
    /// The file is no ledger, or its content is broken.
    #[error(
        "the ledger {} cannot be trusted: {reason}\n  = hint: move it away to compute everything anew; of a sweep, the results of finished cases are still in {}",
        path.display(),
        path.with_file_name("cases").display()
    )]
    Damaged {
        /// The ledger.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Disk or permissions.
    #[error("the ledger {} cannot be used: {reason}", path.display())]
    Disk {
        /// The file.
        path: PathBuf,
        /// What the system said.
        reason: String,
    },
}

impl LedgerError {
    /// The directory belongs to somebody else: the request is refused. Otherwise the machine
    /// failed.
    #[must_use]
    pub const fn is_refusal(&self) -> bool {
        matches!(self, Self::Busy { .. } | Self::OtherStudy { .. })
    }
}

/// A study as the ledger knows it.
#[derive(Debug, Clone, PartialEq)]
pub struct LedgerStudy {
    /// Its title, or its file.
    pub title: String,
    /// Equal hashes are the same cases with the same files.
    pub hash: String,
    /// What the study consists of, name and content, to say what differs.
    pub parts: Vec<(String, String)>,
    /// Inputs (JSON) and hash of each case.
    pub cases: Vec<(String, String)>,
}

/// Something that happened to a case.
#[derive(Debug, Clone, PartialEq)]
pub enum Entry {
    /// The case of this number was begun.
    Started(usize),
    /// The case ended; its files are written.
    Finished(CaseRecord),
    /// The case of this number ended; this is all that it found.
    Found(usize, Vec<u8>),
}

/// The ledger of a run, open and locked.
#[derive(Debug)]
pub struct Ledger {
    path: PathBuf,
    connection: Connection,
    /// Holds the lock as long as it is open.
    _lock: File,
}

impl Ledger {
    /// Opens the ledger in a directory, which must exist, or makes it.
    ///
    /// # Errors
    /// [`LedgerError`].
    pub fn open(directory: &Path, study: &LedgerStudy) -> Result<Self, LedgerError> {
        let lock = lock(directory)?;
        let path = directory.join(FILE_NAME);
        let failed = |error: rusqlite::Error| failure(&path, &error);
        let mut connection = Connection::open(&path).map_err(failed)?;
        connection.busy_timeout(PATIENCE).map_err(failed)?;
        connection
            .pragma_update(None, "journal_mode", "wal")
            .and_then(|()| connection.pragma_update(None, "synchronous", "full"))
            .map_err(failed)?;
        let layout: i64 = connection
            .pragma_query_value(None, "user_version", |row| row.get(0))
            .map_err(failed)?;
        let objects: i64 = connection
            .query_row("SELECT count(*) FROM sqlite_master", [], |row| row.get(0))
            .map_err(failed)?;
        let damaged = |reason: &str| LedgerError::Damaged {
            path: path.clone(),
            reason: reason.to_owned(),
        };
        match (layout, objects) {
            (0, 0) => create(&mut connection, study).map_err(failed)?,
            (LAYOUT, _) => {
                check(&connection)
                    .map_err(failed)?
                    .map_err(|reason| damaged(&reason))?;
                let differences = differences(&connection, study).map_err(failed)?;
                if let Some((title, differences)) = differences {
                    return Err(LedgerError::OtherStudy {
                        directory: directory.to_path_buf(),
                        title,
                        differences,
                    });
                }
            }
            (0, _) => return Err(damaged("it is a database of something else")),
            (other, _) => {
                let reason =
                    format!("its layout {other} is not the {LAYOUT} of this program, {VERSION}");
                return Err(damaged(&reason));
            }
        }
        Ok(Self {
            path,
            connection,
            _lock: lock,
        })
    }

    /// The finished cases in the order of their numbers.
    ///
    /// # Errors
    /// [`LedgerError::Damaged`], [`LedgerError::Disk`].
    pub fn finished(&self) -> Result<Vec<CaseRecord>, LedgerError> {
        let failed = |error: rusqlite::Error| failure(&self.path, &error);
        let mut statement = self
            .connection
            .prepare(
                "SELECT number, status, message, summary, wall_time_s FROM cases
                 WHERE status IS NOT NULL ORDER BY number",
            )
            .map_err(failed)?;
        let rows = statement
            .query_map([], |row| {
                Ok((
                    row.get::<_, String>(1)?,
                    CaseRecord {
                        number: row.get(0)?,
                        status: CaseStatus::NotRun,
                        message: row.get(2)?,
                        summary: row.get(3)?,
                        wall_time: row.get(4)?,
                    },
                ))
            })
            .map_err(failed)?;
        rows.map(|row| {
            let (status, record) = row.map_err(failed)?;
            match CaseStatus::from_name(&status) {
                Some(status) => Ok(CaseRecord { status, ..record }),
                None => Err(LedgerError::Damaged {
                    path: self.path.clone(),
                    reason: format!("case {} has the unknown status {status}", record.number),
                }),
            }
        })
        .collect()
    }

    /// The findings of the finished cases by their numbers, in their order.
    ///
    /// # Errors
    /// [`LedgerError::Damaged`], [`LedgerError::Disk`].
    pub fn findings(&self) -> Result<Vec<(usize, Vec<u8>)>, LedgerError> {
        let failed = |error: rusqlite::Error| failure(&self.path, &error);
        let mut statement = self
            .connection
            .prepare("SELECT number, content FROM findings ORDER BY number")
            .map_err(failed)?;
        let rows = statement
            .query_map([], |row| Ok((row.get(0)?, row.get(1)?)))
            .map_err(failed)?;
        rows.map(|row| row.map_err(failed)).collect()
    }

    /// The error of a ledger that holds what this program cannot read.
    #[must_use]
    pub fn damaged(&self, reason: &str) -> LedgerError {
        LedgerError::Damaged {
            path: self.path.clone(),
            reason: reason.to_owned(),
        }
    }

    /// Removes the ledger of a run whose results are all written.
    ///
    /// # Errors
    /// [`LedgerError::Disk`].
    pub fn remove(self) -> Result<(), LedgerError> {
        let Self {
            path, connection, ..
        } = self;
        let failed = |reason: String| LedgerError::Disk {
            path: path.clone(),
            reason,
        };
        // Closed, it folds its log into itself.
        connection
            .close()
            .map_err(|(_, error)| failed(error.to_string()))?;
        let lock = path.with_file_name(LOCK_NAME);
        for path in [&path, &lock] {
            std::fs::remove_file(path).map_err(|error| failed(error.to_string()))?;
        }
        Ok(())
    }

    /// Writes entries, all or none; when this returns they are on the disk.
    ///
    /// # Errors
    /// [`LedgerError::Damaged`], [`LedgerError::Disk`].
    pub fn write(&mut self, entries: &[Entry]) -> Result<(), LedgerError> {
        let path = &self.path;
        write(&mut self.connection, entries).map_err(|error| failure(path, &error))
    }
}

/// Takes the lock of a directory; it lasts as long as the file is open, and no longer than the
/// program.
fn lock(directory: &Path) -> Result<File, LedgerError> {
    let path = directory.join(LOCK_NAME);
    let failed = |error: io::Error| LedgerError::Disk {
        path: path.clone(),
        reason: error.to_string(),
    };
    let mut file = OpenOptions::new()
        .create(true)
        .read(true)
        .write(true)
        .truncate(false)
        .open(&path)
        .map_err(failed)?;
    match file.try_lock() {
        Ok(()) => {
            // The number only helps a reader of the message; the lock is the system's.
            file.set_len(0)
                .and_then(|()| writeln!(file, "{}", std::process::id()))
                .map_err(failed)?;
            Ok(file)
        }
        Err(TryLockError::WouldBlock) => {
            let mut process = String::new();
            let known = file.read_to_string(&mut process).is_ok();
            let process = process.trim().to_owned();
            Err(LedgerError::Busy {
                directory: directory.to_path_buf(),
                process: Some(process).filter(|id| known && !id.is_empty()),
            })
        }
        Err(TryLockError::Error(error)) => Err(failed(error)),
    }
}

/// Makes the tables and lists the cases, at once: a ledger is there in full or not at all.
fn create(connection: &mut Connection, study: &LedgerStudy) -> rusqlite::Result<()> {
    let transaction = connection.transaction()?;
    transaction.execute_batch(TABLES)?;
    {
        let mut insert = transaction.prepare("INSERT INTO study (key, value) VALUES (?1, ?2)")?;
        insert.execute(["title", &study.title])?;
        insert.execute(["hash", &study.hash])?;
        insert.execute(["program version", VERSION])?;
        for (name, content) in &study.parts {
            insert.execute([format!("part {name}").as_str(), content])?;
        }
        let mut insert =
            transaction.prepare("INSERT INTO cases (number, inputs, hash) VALUES (?1, ?2, ?3)")?;
        for (number, (inputs, hash)) in (1_i64..).zip(&study.cases) {
            insert.execute(params![number, inputs, hash])?;
        }
    }
    transaction.pragma_update(None, "user_version", LAYOUT)?;
    transaction.commit()
}

/// What SQLite finds wrong with the file.
fn check(connection: &Connection) -> rusqlite::Result<Result<(), String>> {
    let verdict: String = connection.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))?;
    Ok(if verdict == "ok" {
        Ok(())
    } else {
        Err(verdict)
    })
}

fn write(connection: &mut Connection, entries: &[Entry]) -> rusqlite::Result<()> {
    let transaction = connection.transaction()?;
    {
        let mut started =
            transaction.prepare_cached("UPDATE cases SET starts = starts + 1 WHERE number = ?1")?;
        let mut finished = transaction.prepare_cached(
            "UPDATE cases SET status = ?2, message = ?3, summary = ?4, wall_time_s = ?5,
                 program_version = ?6, starts_when_finished = starts
             WHERE number = ?1",
        )?;
        let mut found = transaction
            .prepare_cached("INSERT OR REPLACE INTO findings (number, content) VALUES (?1, ?2)")?;
        for entry in entries {
            match entry {
                Entry::Started(number) => started.execute([number])?,
                Entry::Finished(record) => finished.execute(params![
                    record.number,
                    record.status.name(),
                    record.message,
                    record.summary,
                    record.wall_time,
                    VERSION,
                ])?,
                Entry::Found(number, content) => found.execute(params![number, content])?,
            };
        }
    }
    transaction.commit()
}

/// Title of the study of a ledger and what differs from this one; `None` if it is the same.
fn differences(
    connection: &Connection,
    study: &LedgerStudy,
) -> rusqlite::Result<Option<(String, Vec<String>)>> {
    let known = |key: &str| -> rusqlite::Result<Option<String>> {
        connection
            .query_row("SELECT value FROM study WHERE key = ?1", [key], |row| {
                row.get(0)
            })
            .optional()
    };
    let title = known("title")?.unwrap_or_default();
    let version = known("program version")?.unwrap_or_default();
    let mut found = Vec::new();
    if version != VERSION {
        found.push(format!(
            "its cases were computed by version {version}, this is {VERSION}"
        ));
    }
    if known("hash")?.as_deref() != Some(study.hash.as_str()) {
        for (name, content) in &study.parts {
            match known(&format!("part {name}"))? {
                Some(there) if there == *content => {}
                Some(there) => found.push(difference(name, &there, content)),
                None => found.push(format!("it has no {name}")),
            }
        }
        let names: Vec<String> = connection
            .prepare("SELECT substr(key, 6) FROM study WHERE key LIKE 'part %'")?
            .query_map([], |row| row.get(0))?
            .collect::<rusqlite::Result<_>>()?;
        let dropped = names
            .iter()
            .filter(|name| !study.parts.iter().any(|(known, _)| known == *name));
        found.extend(dropped.map(|name| format!("it has {name}, this one has not")));
        if found.is_empty() {
            found.push("a file that the study names, such as its loads, has changed".into());
        }
    }
    Ok((!found.is_empty()).then_some((title, found)))
}

/// The first line in which two contents differ.
fn difference(name: &str, there: &str, here: &str) -> String {
    let (mut old, mut new) = (there.lines(), here.lines());
    let mut line = 0;
    loop {
        line += 1;
        let (a, b) = (old.next(), new.next());
        if a != b || a.is_none() {
            let shown = |text: Option<&str>| match text {
                Some(text) => format!("`{}`", text.trim().chars().take(120).collect::<String>()),
                None => "nothing".to_owned(),
            };
            let at = if there.lines().count().max(here.lines().count()) > 1 {
                format!(" in line {line}")
            } else {
                String::new()
            };
            return format!("{name} differs{at}: {} there, {} here", shown(a), shown(b));
        }
    }
}

/// Tells a broken file from a disk that fails.
fn failure(path: &Path, error: &rusqlite::Error) -> LedgerError {
    use rusqlite::ErrorCode::{DatabaseCorrupt, NotADatabase};
    let (path, reason) = (path.to_path_buf(), error.to_string());
    let is_broken = match error.sqlite_error_code() {
        Some(code) => matches!(code, DatabaseCorrupt | NotADatabase),
        // Not what the system said, but what stands in the file.
        None => true,
    };
    // A table or column that is not there.
    if is_broken || error.sqlite_error_code() == Some(rusqlite::ErrorCode::Unknown) {
        LedgerError::Damaged { path, reason }
    } else {
        LedgerError::Disk { path, reason }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    fn study() -> LedgerStudy {
        LedgerStudy {
            title: "\"Clearance\"".into(),
            hash: "abc".into(),
            parts: vec![("the base study".into(), "a = 1\nb = 2\n".into())],
            cases: (1..=3).map(|n| ("{}".to_owned(), format!("{n}"))).collect(),
        }
    }

    fn record(number: usize) -> CaseRecord {
        CaseRecord {
            number,
            status: CaseStatus::Converged,
            message: String::new(),
            summary: format!("{{\"x\": {number}}}"),
            wall_time: 0.25,
        }
    }

    #[test]
    fn what_was_written_is_there_after_reopening() {
        let directory = tempfile::tempdir().unwrap();
        let mut ledger = Ledger::open(directory.path(), &study()).unwrap();
        let entries = [
            Entry::Started(3),
            Entry::Started(1),
            Entry::Finished(record(3)),
        ];
        ledger.write(&entries).unwrap();
        drop(ledger);
        let ledger = Ledger::open(directory.path(), &study()).unwrap();
        assert_eq!(ledger.finished().unwrap(), [record(3)]);
        let starts: Vec<(i64, Option<i64>)> = ledger
            .connection
            .prepare("SELECT starts, starts_when_finished FROM cases ORDER BY number")
            .unwrap()
            .query_map([], |row| Ok((row.get(0)?, row.get(1)?)))
            .unwrap()
            .map(Result::unwrap)
            .collect();
        assert_eq!(starts, [(1, None), (0, None), (1, Some(1))]);
    }

    #[test]
    fn findings_are_there_after_reopening_and_gone_with_the_ledger() {
        let directory = tempfile::tempdir().unwrap();
        let mut ledger = Ledger::open(directory.path(), &study()).unwrap();
        let bytes = vec![0, 255, 7];
        let entries = [Entry::Found(2, bytes.clone()), Entry::Found(1, Vec::new())];
        ledger.write(&entries).unwrap();
        drop(ledger);
        let ledger = Ledger::open(directory.path(), &study()).unwrap();
        assert_eq!(ledger.findings().unwrap(), [(1, Vec::new()), (2, bytes)]);
        ledger.remove().unwrap();
        assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_second_run_is_kept_out() {
        let directory = tempfile::tempdir().unwrap();
        let first = Ledger::open(directory.path(), &study()).unwrap();
        let error = Ledger::open(directory.path(), &study()).unwrap_err();
        let process = format!("process {}", std::process::id());
        assert!(
            error.is_refusal() && error.to_string().contains(&process),
            "{error}"
        );
        drop(first);
        Ledger::open(directory.path(), &study()).unwrap();
    }

    #[test]
    fn another_study_is_told_by_its_differences() {
        let directory = tempfile::tempdir().unwrap();
        drop(Ledger::open(directory.path(), &study()).unwrap());
        let mut other = study();
        other.hash = "def".into();
        let told = |other: &LedgerStudy| {
            let error = Ledger::open(directory.path(), other).unwrap_err();
            assert!(error.is_refusal());
            error.to_string()
        };
        assert!(told(&other).contains("a file that the study names"));
        other.parts[0].1 = "a = 1\nb = 3\n".into();
        let message = told(&other);
        assert!(
            message.contains("the base study differs in line 2: `b = 2` there, `b = 3` here"),
            "{message}"
        );
        other.parts = vec![("`x`".into(), "1".into())];
        let message = told(&other);
        assert!(
            message.contains("it has no `x`; it has the base study, this one has not"),
            "{message}"
        );
    }

    #[test]
    fn a_broken_file_is_named() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(FILE_NAME);
        let told = |name: &str| {
            let error = Ledger::open(directory.path(), &study()).unwrap_err();
            assert!(!error.is_refusal());
            let message = error.to_string();
            assert!(message.contains("cannot be trusted"), "{name}: {message}");
        };
        std::fs::write(&path, "not a database, whatever its name may promise to be").unwrap();
        told("garbage");
        std::fs::remove_file(&path).unwrap();
        let mut large = study();
        large.cases = (0..500)
            .map(|n| ("{}".repeat(40), format!("{n}")))
            .collect();
        drop(Ledger::open(directory.path(), &large).unwrap());
        let whole = std::fs::read(&path).unwrap();
        std::fs::write(&path, &whole[..whole.len() / 2]).unwrap();
        told("cut");
        let mut holed = whole.clone();
        holed[4096..].fill(0xa5);
        std::fs::write(&path, &holed).unwrap();
        told("overwritten");
        std::fs::remove_file(&path).unwrap();
        Connection::open(&path)
            .unwrap()
            .execute_batch("CREATE TABLE x (y)")
            .unwrap();
        told("foreign");
    }
}
