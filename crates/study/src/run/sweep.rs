//! A sweep: its cases over the threads, each finished one in the ledger before it counts.
//!
//! A case is sequential, and the table is built from the summaries in the order of the cases, so that
//! the results do not depend on the number of threads.

use super::crew::{Desk, News, work_through};
use super::{
    ProgressCallback, RunError, RunOptions, RunSummary, input_rows, models_of, solve_with,
};
use crate::cases::{self, CaseRecord, CaseStatus, SweepResults, VariedColumn};
use crate::input::{Keep, Study, SweepPlan};
use crate::ledger::{Entry, Ledger, LedgerStudy};
use crate::models::Model;
use crate::output::{prepare_directory, replace_file, summary, write_all};
use crate::progress::ProgressEvent;
use crate::results::{Body, Header, InputRow, PROGRAM, Results, SCHEMA, VERSION};
use serde_json::json;
use sommerfeld_film::Outcome;
use std::collections::{BTreeMap, HashMap};
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Directory of the cases in that of the results.
const CASES: &str = "cases";
/// Cases named one by one among the messages; all of them are in the table.
const NAMED: usize = 20;

/// Runs the cases of a sweep that the directory does not hold yet, and writes the results of all.
pub(super) fn run_sweep(
    study: &Study,
    plan: &SweepPlan,
    directory: &Path,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<RunSummary, RunError> {
    let start = Instant::now();
    prepare_directory(directory)?;
    let mut ledger = Ledger::open(directory, &ledger_study(study, plan, options))?;
    let mut records: BTreeMap<usize, CaseRecord> = ledger
        .finished()?
        .into_iter()
        .map(|record| (record.number, record))
        .collect();
    let todo: Vec<usize> = (0..plan.count())
        .filter(|index| !records.contains_key(&(index + 1)))
        .collect();
    let found_done = records.len();
    let mut desk = CaseDesk {
        plan,
        ledger: &mut ledger,
        records: &mut records,
        shares: HashMap::new(),
        found_done,
        progress,
    };
    let work = |index: usize, progress: &mut ProgressCallback<'_>| {
        run_case(plan, index, directory, options, progress)
    };
    work_through(&todo, options.threads, &work, &mut desk)?;
    let mut results = assemble(study, plan, &records);
    results.header.wall_time = start.elapsed().as_secs_f64();
    if found_done > 0 {
        results.header.messages.push(format!(
            "{found_done} of {} cases were found done in {}",
            plan.count(),
            directory.display()
        ));
    }
    let files = write_all(&results, directory)?;
    Ok(RunSummary { results, files })
}

/// Computes the cases of a sweep one after the other and writes nothing.
pub(super) fn solve_sweep(
    study: &Study,
    plan: &SweepPlan,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Results {
    let start = Instant::now();
    let mut records = BTreeMap::new();
    for index in 0..plan.count() {
        let label = format!("case {} of {}", index + 1, plan.count());
        let mut answer = ControlFlow::Continue(());
        let mut watch = |event: ProgressEvent| {
            let done = (index as f64 + event.done) / plan.count() as f64;
            answer = progress(ProgressEvent::new(label.clone(), done));
            answer
        };
        let ended = solve_case(plan, index, options, &mut watch);
        if answer.is_break() {
            break;
        }
        if let Ok((record, _)) = ended {
            records.insert(index + 1, record);
        }
    }
    let mut results = assemble(study, plan, &records);
    results.header.wall_time = start.elapsed().as_secs_f64();
    results
}

/// Computes a case and writes its files, unless the run was stopped.
fn run_case(
    plan: &SweepPlan,
    index: usize,
    directory: &Path,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<CaseRecord, RunError> {
    let mut interrupted = false;
    // The threads are at work on cases: a case has one.
    let alone = RunOptions {
        threads: Some(1),
        ..options
    };
    let (record, results) = solve_case(plan, index, alone, &mut |event| {
        let answer = progress(event);
        interrupted |= answer.is_break();
        answer
    })?;
    if !interrupted {
        write_case(plan, directory, &record, results.as_ref())?;
    }
    Ok(record)
}

/// The files of a case, in `cases/0001`.
fn write_case(
    plan: &SweepPlan,
    directory: &Path,
    record: &CaseRecord,
    results: Option<&Results>,
) -> Result<(), RunError> {
    let directory = case_directory(directory, record.number, plan.count());
    prepare_directory(&directory)?;
    match results {
        Some(results) if plan.keep == Keep::All => {
            write_all(results, &directory)?;
        }
        _ => replace_file(&directory.join("summary.json"), record.summary.as_bytes())?,
    }
    Ok(())
}

/// Where the files of a case lie: numbers of four digits, more where there are more cases.
fn case_directory(directory: &Path, number: usize, count: usize) -> PathBuf {
    let digits = count.to_string().len().max(4);
    directory.join(CASES).join(format!("{number:0digits$}"))
}

/// Computes a case. A case that is refused, or whose calculation breaks down, is a record of its
/// own: the others go on.
fn solve_case(
    plan: &SweepPlan,
    index: usize,
    options: RunOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<(CaseRecord, Option<Results>), RunError> {
    let start = Instant::now();
    let number = index + 1;
    let study = plan
        .study(index)
        .ok()
        .filter(|study| plan.hashes.get(index) == Some(&study.input_hash))
        .ok_or_else(|| RunError::InputChanged(plan.base_file.clone()))?;
    let solved = catch_unwind(AssertUnwindSafe(|| solve_with(&study, options, progress)));
    let wall_time = start.elapsed().as_secs_f64();
    let refused = match solved {
        Ok(Ok(results)) => {
            let status = CaseStatus::from(results.header.status);
            let message = match status {
                CaseStatus::Converged => String::new(),
                _ => results.header.messages.first().cloned().unwrap_or_default(),
            };
            let text = format!("{:#}\n", summary(&results));
            let record = CaseRecord {
                number,
                status,
                message,
                summary: text,
                wall_time,
            };
            return Ok((record, Some(results)));
        }
        Ok(Err(error)) => error.to_string(),
        Err(_) => format!(
            "the program broke down in this case: a fault of version {VERSION}, please report it with the study"
        ),
    };
    let text = json!({
        "schema": SCHEMA, "program": PROGRAM, "version": VERSION,
        "analysis": study.analysis.name(), "title": study.title,
        "status": CaseStatus::Failed.name(), "messages": [refused],
        "models": models_of(&study), "wall_time_s": wall_time, "study_hash": study.input_hash,
    });
    let record = CaseRecord {
        number,
        status: CaseStatus::Failed,
        message: refused,
        summary: format!("{text:#}\n"),
        wall_time,
    };
    Ok((record, None))
}

/// The calling thread: writes the ledger, shows the progress, stops the others.
struct CaseDesk<'a> {
    plan: &'a SweepPlan,
    ledger: &'a mut Ledger,
    records: &'a mut BTreeMap<usize, CaseRecord>,
    /// Shares of the cases at work, by index.
    shares: HashMap<usize, f64>,
    /// Cases that an earlier run has finished.
    found_done: usize,
    progress: &'a mut ProgressCallback<'a>,
}

impl Desk<CaseRecord> for CaseDesk<'_> {
    fn take(&mut self, news: Vec<News<CaseRecord>>) -> Result<ControlFlow<()>, RunError> {
        let mut entries = Vec::new();
        for news in news {
            match news {
                News::Started(index) => {
                    self.shares.insert(index, 0.0);
                    entries.push(Entry::Started(index + 1));
                }
                News::Share(index, share) => {
                    self.shares.insert(index, share);
                }
                News::Abandoned(index) => {
                    self.shares.remove(&index);
                }
                News::Finished(index, record) => {
                    self.shares.remove(&index);
                    entries.push(Entry::Finished(record));
                }
            }
        }
        if !entries.is_empty() {
            self.ledger.write(&entries)?;
        }
        let mut answer = ControlFlow::Continue(());
        for entry in entries {
            if let Entry::Finished(record) = entry {
                if record.status != CaseStatus::Converged
                    && self.tell(Some(self.told(&record))).is_break()
                {
                    answer = ControlFlow::Break(());
                }
                self.records.insert(record.number, record);
            }
        }
        Ok(answer)
    }

    fn show(&mut self) -> ControlFlow<()> {
        self.tell(None)
    }
}

impl CaseDesk<'_> {
    fn told(&self, record: &CaseRecord) -> String {
        let inputs = self.plan.describe(record.number - 1);
        let (number, status) = (record.number, record.status.name());
        let told = ended(status, &record.message);
        format!("case {number} ({inputs}): {told}")
    }

    fn tell(&mut self, message: Option<String>) -> ControlFlow<()> {
        let total = self.plan.count();
        let done = self.records.len();
        let at_work: f64 = self.shares.values().sum();
        // The share of what this run has to do: the time left follows from it.
        let mine = (total - self.found_done).max(1) as f64;
        let share = ((done - self.found_done) as f64 + at_work) / mine;
        (self.progress)(ProgressEvent {
            message,
            ..ProgressEvent::new(format!("{done} of {total} cases"), share)
        })
    }
}

/// The sweep as its ledger knows it.
fn ledger_study(study: &Study, plan: &SweepPlan, options: RunOptions) -> LedgerStudy {
    let mut parts = vec![
        ("the base study".to_owned(), plan.base_text.clone()),
        ("mode".to_owned(), plan.mode.name().to_owned()),
        ("keep".to_owned(), plan.keep.name().to_owned()),
    ];
    // A ledger holds cases with error bars or cases without.
    if options.verify {
        parts.push(("--verify".to_owned(), "error bars".to_owned()));
    }
    for key in &plan.varied {
        let values: Vec<&str> = key
            .values
            .iter()
            .map(|value| value.shown.as_str())
            .collect();
        parts.push((format!("`{}`", key.path), values.join(", ")));
    }
    let cases = (0..plan.count()).map(|index| {
        let pairs = plan.varied.iter().zip(plan.values(index));
        let inputs: serde_json::Map<String, serde_json::Value> = pairs
            .map(|(key, value)| (key.path.clone(), json!(value.shown)))
            .collect();
        (json!(inputs).to_string(), plan.hashes[index].clone())
    });
    LedgerStudy {
        title: if study.title.is_empty() {
            study.file.clone()
        } else {
            format!("\"{}\"", study.title)
        },
        hash: if options.verify {
            format!("{}-verify", study.input_hash)
        } else {
            study.input_hash.clone()
        },
        parts,
        cases: cases.collect(),
    }
}

/// The results of a sweep from the records of its cases.
fn assemble(study: &Study, plan: &SweepPlan, records: &BTreeMap<usize, CaseRecord>) -> Results {
    let mut sweep = SweepResults {
        base: plan.base_file.clone(),
        mode: plan.mode.name(),
        varied: plan
            .varied
            .iter()
            .map(|key| VariedColumn {
                key: key.path.clone(),
                unit: key.unit.clone(),
                tells_apart: plan.tells_apart(key),
            })
            .collect(),
        ..SweepResults::default()
    };
    let mut models: Vec<Model> = Vec::new();
    for index in 0..plan.count() {
        let record = records.get(&(index + 1));
        let values = plan.values(index);
        sweep.push(
            index + 1,
            values.iter().map(|value| value.shown.clone()).collect(),
            values.iter().map(|value| value.number).collect(),
            record,
        );
        for model in record.map(cases::models_of).unwrap_or_default() {
            if !models.contains(&model) {
                models.push(model);
            }
        }
    }
    let header = header(study, plan, models, &sweep);
    Results {
        header,
        body: Body::Sweep(Box::new(sweep)),
    }
}

fn header(study: &Study, plan: &SweepPlan, models: Vec<Model>, sweep: &SweepResults) -> Header {
    let is_converged = sweep.count(CaseStatus::Converged) == sweep.cases.len();
    let mut messages = messages(sweep);
    messages.extend(study.warnings.iter().map(|warning| warning.message.clone()));
    let is_varied = |row: &InputRow| {
        let key = row.key.as_str();
        let in_sweep = plan.varied.iter().any(|varied| varied.path == key);
        in_sweep || ["schema", "title", "analysis"].contains(&key)
    };
    let mut inputs = input_rows(&study.text);
    inputs.extend(
        input_rows(&plan.base_text)
            .into_iter()
            .filter(|row| !is_varied(row)),
    );
    Header {
        analysis: study.analysis.name().to_owned(),
        title: study.title.clone(),
        status: if is_converged {
            Outcome::Converged
        } else {
            Outcome::NotConverged
        },
        messages,
        models,
        wall_time: 0.0,
        inputs,
        study_text: format!(
            "{}\n# ---- the base study, {} ----\n\n{}",
            study.text, plan.base_file, plan.base_text
        ),
        study_hash: Some(study.input_hash.clone()),
        error: None,
        grid: None,
        limits: Vec::new(),
        heat: None,
        plain: None,
        databases: Vec::new(),
        comparison: None,
    }
}

/// How a case ended and why. Most messages begin with the status themselves.
fn ended(status: &str, message: &str) -> String {
    let words = status.replace('-', " ");
    if message.starts_with(&words) {
        message.to_owned()
    } else {
        format!("{status}: {message}")
    }
}

/// What the reader must know: cases that are missing, cases that did not converge.
fn messages(sweep: &SweepResults) -> Vec<String> {
    let total = sweep.cases.len();
    let mut messages = Vec::new();
    let missing = sweep.count(CaseStatus::NotRun);
    if missing > 0 {
        messages.push(format!(
            "interrupted: {} of {total} cases are done; run the same command again to do the rest",
            total - missing
        ));
    }
    let bad = sweep
        .cases
        .iter()
        .filter(|row| !matches!(row.status, CaseStatus::Converged | CaseStatus::NotRun));
    let told: Vec<String> = bad
        .map(|row| {
            let told = ended(row.status.name(), &row.message);
            format!("{}: {told}", sweep.describe(row))
        })
        .collect();
    let more = told.len().saturating_sub(NAMED);
    messages.extend(told.into_iter().take(NAMED));
    if more > 0 {
        messages.push(format!("{more} more cases did not converge: see cases.csv"));
    }
    messages
}
