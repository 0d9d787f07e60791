//! A sweep: its base study, its number of cases, and every case checked before any of them runs.

use super::{Checker, sorted};
use crate::input::error::{InputError, InputErrors, Place};
use crate::input::files::{STUDY_CAP, read_text};
use crate::input::read::MOST_ERRORS;
use crate::input::study::{Analysis, FilmSettings, Rotor, Study, Subject, input_hash};
use crate::input::sweep::{Keep, SweepMode, SweepPlan};
use crate::input::values::{Value, not_built};
use crate::input::vary::{MOST_CASES, Vary};
use rayon::prelude::*;
use std::path::Path;

/// Cases that are checked at a time: errors end the check soon.
const CHUNK: usize = 1024;

impl Checker<'_> {
    /// The study of a sweep file: its plan, every case of it checked.
    pub(super) fn sweep(mut self) -> Result<Study, InputErrors> {
        let planned = self.plan();
        if !self.errors.is_empty() {
            return Err(sorted(self.errors));
        }
        let Some((mut plan, varied)) = planned else {
            return Err(InputError::new(self.reading.file, "the sweep is incomplete").into());
        };
        let film = self.check_cases(&mut plan, &varied);
        let (true, Some(film)) = (self.errors.is_empty(), film) else {
            return Err(InputErrors(self.errors));
        };
        Ok(Study {
            title: self.text("title").unwrap_or_default(),
            analysis: Analysis::Sweep,
            input_hash: sweep_hash(&plan),
            subject: Subject::Sweep(plan),
            film,
            rotor: Rotor::default(),
            limits: Vec::new(),
            warnings: sorted(self.warnings).0,
            file: self.reading.file.to_owned(),
            files: self.files,
            text: self.reading.text.to_owned(),
        })
    }

    /// The plan, its cases counted but not yet checked.
    fn plan(&mut self) -> Option<(SweepPlan, Vec<Vary>)> {
        let base = self.base_study();
        let mode = match self.text("sweep.mode")?.as_str() {
            "zip" => SweepMode::Zip,
            _ => SweepMode::Grid,
        };
        let keep = match self.text("sweep.keep")?.as_str() {
            "all" => Keep::All,
            _ => Keep::Summary,
        };
        let Value::Vary(varied) = self.value("sweep.vary")? else {
            return None;
        };
        let count = match mode {
            SweepMode::Grid => self.grid_count(&varied)?,
            SweepMode::Zip => self.zip_count(&varied)?,
        };
        let (base_file, base_text, directory) = base?;
        let plan = SweepPlan {
            base_file,
            base_text,
            directory,
            mode,
            keep,
            varied: varied.iter().map(|vary| vary.varied.clone()).collect(),
            hashes: vec![String::new(); count],
        };
        Some((plan, varied))
    }

    /// File, text and directory of the base study.
    fn base_study(&mut self) -> Option<(String, String, std::path::PathBuf)> {
        let path = self.directory.join(self.text("sweep.base")?);
        let name = path.to_string_lossy().into_owned();
        let text = match read_text(&path, STUDY_CAP) {
            Ok(text) => text,
            Err(error) => {
                let message = format!("the base study cannot be used: {}", error.message);
                let refused = self.error_at("sweep.base", message);
                let shown: String = name.chars().take(300).collect();
                self.errors
                    .push(refused.hinting(format!("it was looked for at {shown}")));
                return None;
            }
        };
        match text.parse::<toml::Table>() {
            Ok(table) if table.get("analysis").and_then(toml::Value::as_str) == Some("sweep") => {
                let refused = self.error_at("sweep.base", "the base study is a sweep itself");
                self.errors.push(refused.hinting(
                    "a sweep of a sweep is not possible: vary the keys of both in one sweep",
                ));
                None
            }
            Ok(table) if is_machine(&table) => {
                let message = "a sweep of an engine or shaft";
                let refused = not_built(self.error_at("sweep.base", ""), message);
                self.errors.push(refused.hinting(
                    "an engine runs a list of speeds in one study: speed = [\"1000 rpm\", \"2000 rpm\"]",
                ));
                None
            }
            Ok(_) => {
                let directory = path.parent().unwrap_or(Path::new("")).to_path_buf();
                Some((name, text, directory))
            }
            Err(_) => {
                // The reader says where its syntax fails, and says it better.
                let errors = super::study(&name, &text, self.directory)
                    .err()
                    .unwrap_or_default();
                self.errors.extend(errors.0);
                None
            }
        }
    }

    fn grid_count(&mut self, varied: &[Vary]) -> Option<usize> {
        let count = varied.iter().try_fold(1_usize, |count, vary| {
            count.checked_mul(vary.varied.values.len())
        });
        match count {
            Some(count) if count <= MOST_CASES => Some(count),
            _ => {
                let sizes: Vec<String> = varied
                    .iter()
                    .map(|vary| vary.varied.values.len().to_string())
                    .collect();
                let message = format!("the grid has {} cases", sizes.join(" x "));
                let refused = self
                    .error_at("sweep.vary", message)
                    .allowing(format!("at most {MOST_CASES} cases"));
                self.errors
                    .push(refused.hinting("vary fewer keys at a time, or use mode = \"zip\""));
                None
            }
        }
    }

    fn zip_count(&mut self, varied: &[Vary]) -> Option<usize> {
        let first = varied.first()?;
        let count = first.varied.values.len();
        let Some(other) = varied.iter().find(|vary| vary.varied.values.len() != count) else {
            return Some(count);
        };
        let message = format!(
            "`{}` has {} values, `{}` has {count}",
            other.varied.path,
            other.varied.values.len(),
            first.varied.path
        );
        let refused = self
            .reading
            .error(&other.key_span, message)
            .of_key(&other.varied.path);
        self.errors.push(refused.hinting(
            "mode = \"zip\" takes the first values of all keys, then the second ones: give each key as many; mode = \"grid\" takes every combination",
        ));
        None
    }

    /// Checks every case, notes its hash, and returns how the first one models its film.
    fn check_cases(&mut self, plan: &mut SweepPlan, varied: &[Vary]) -> Option<FilmSettings> {
        let mut errors = Gathered::default();
        let mut warnings = Gathered::default();
        let mut film = None;
        let count = plan.count();
        for start in (0..count).step_by(CHUNK) {
            let chunk = start..(start + CHUNK).min(count);
            let checked: Vec<Result<Study, InputErrors>> = chunk
                .into_par_iter()
                .map(|index| check_case(plan, index))
                .collect();
            for (index, result) in (start..).zip(checked) {
                match result {
                    Ok(study) => {
                        film = film.or_else(|| Some(study.film.clone()));
                        warnings.add(index, study.warnings);
                        plan.hashes[index] = study.input_hash;
                    }
                    Err(found) => {
                        let placed = found.0.into_iter();
                        let placed = placed.map(|e| self.at_varied_value(plan, varied, index, e));
                        errors.add(index, placed.collect::<Vec<_>>());
                    }
                }
            }
            if errors.found.len() >= MOST_ERRORS {
                break;
            }
        }
        self.errors.extend(errors.named(plan));
        self.warnings.extend(warnings.named(plan));
        film
    }

    /// An error about a varied value is shown where the sweep gives it.
    fn at_varied_value(
        &self,
        plan: &SweepPlan,
        varied: &[Vary],
        index: usize,
        error: InputError,
    ) -> InputError {
        let positions = plan.positions(index);
        let found = varied.iter().zip(positions).find(|(vary, at)| {
            let is_same_key = error.key == vary.varied.path || error.key == vary.schema_path;
            let within = error.key.strip_prefix(vary.schema_path);
            let is_within = within.is_some_and(|rest| rest.starts_with('.'));
            // The same key of another groove is not the varied one.
            let is_same_value =
                error.place.is_none() || vary.varied.values[*at].toml.contains(error.value.trim());
            (is_same_key || is_within) && is_same_value
        });
        let Some((vary, at)) = found else {
            return error;
        };
        let span = vary.value_spans.get(at).unwrap_or(&vary.key_span);
        let place = Some(Place::of_span(self.reading.text, span.clone()));
        let value = &vary.varied.values[at];
        InputError {
            file: self.reading.file.to_owned(),
            place,
            key: vary.varied.path.clone(),
            value: value.toml.clone(),
            ..error
        }
    }
}

/// The study is one of several bearings.
fn is_machine(study: &toml::Table) -> bool {
    let analysis = study.get("analysis").and_then(toml::Value::as_str);
    matches!(analysis, Some("engine" | "shaft"))
}

/// The study of a case.
fn check_case(plan: &SweepPlan, index: usize) -> Result<Study, InputErrors> {
    let text = plan
        .case_text(index)
        .map_err(|(key, why)| InputError::new(&plan.base_file, why).of_key(&key))?;
    let study = plan.study_of(&text)?;
    match study.subject {
        Subject::Machine(_) => {
            let place = InputError::new(&plan.base_file, "").of_key("analysis");
            Err(not_built(place, "a sweep of an engine or shaft").into())
        }
        _ => Ok(study),
    }
}

/// Identifies the cases of a sweep and what they leave behind: equal hashes are the same results.
fn sweep_hash(plan: &SweepPlan) -> String {
    let mut parts: Vec<&[u8]> = vec![plan.mode.name().as_bytes(), plan.keep.name().as_bytes()];
    for key in &plan.varied {
        parts.push(key.path.as_bytes());
        parts.extend(key.values.iter().map(|value| value.toml.as_bytes()));
    }
    parts.extend(plan.hashes.iter().map(|hash| hash.as_bytes()));
    input_hash(&parts)
}

/// Messages of many cases, each kept once, with the first case that has it and how many do.
#[derive(Default)]
struct Gathered {
    found: Vec<(InputError, usize, usize)>,
}

impl Gathered {
    fn add(&mut self, index: usize, messages: Vec<InputError>) {
        for message in messages {
            let is_full = self.found.len() >= MOST_ERRORS;
            match self
                .found
                .iter_mut()
                .find(|(known, _, _)| *known == message)
            {
                Some((_, _, count)) => *count += 1,
                None if is_full => {}
                None => self.found.push((message, index, 1)),
            }
        }
    }

    /// The messages with the case each is about. What every case says of the base study is about
    /// the base study.
    fn named(self, plan: &SweepPlan) -> Vec<InputError> {
        let total = plan.count();
        let named = self.found.into_iter().map(|(mut message, index, count)| {
            if count < total || message.file != plan.base_file {
                let more = match count {
                    1 => String::new(),
                    _ => format!(" and {} more", count - 1),
                };
                message.message = format!(
                    "case {} ({}){more}: {}",
                    index + 1,
                    plan.describe(index),
                    message.message
                );
            }
            message
        });
        named.collect()
    }
}
