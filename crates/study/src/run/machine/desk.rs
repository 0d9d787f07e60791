//! The calling thread of a machine: keeps what units found and shows how far they are.

use super::units::{UnitFound, solve_unit};
use super::{ProgressCallback, RunError, RunOptions, Work};
use crate::ledger::{Entry, Ledger};
use crate::output::OutputError;
use crate::progress::ProgressEvent;
use crate::results::status_name;
use crate::run::crew::{Desk, News, work_through};
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use sommerfeld_film::Outcome;
use std::collections::{BTreeMap, HashMap};
use std::io::Write;
use std::ops::ControlFlow;

/// What a unit found and, where there is a ledger, its form there.
pub(super) type Finished = (UnitFound, Option<Vec<u8>>);

/// Writes the ledger, shows the progress, stops the threads.
pub(super) struct UnitDesk<'a> {
    work: &'a Work<'a>,
    ledger: Option<&'a mut Ledger>,
    found: &'a mut BTreeMap<usize, UnitFound>,
    /// Shares of the units at work.
    shares: HashMap<usize, f64>,
    /// Orbits that an earlier run has done.
    found_done: usize,
    progress: &'a mut ProgressCallback<'a>,
}

impl<'a> UnitDesk<'a> {
    pub(super) fn new(
        work: &'a Work<'a>,
        ledger: Option<&'a mut Ledger>,
        found: &'a mut BTreeMap<usize, UnitFound>,
        progress: &'a mut ProgressCallback<'a>,
    ) -> Self {
        let mut desk = Self {
            work,
            ledger,
            found,
            shares: HashMap::new(),
            found_done: 0,
            progress,
        };
        desk.found_done = desk.done();
        desk
    }

    /// Computes the units that are not found yet.
    pub(super) fn compute(mut self, options: RunOptions) -> Result<(), RunError> {
        let work = self.work;
        let todo: Vec<usize> = (0..work.units.len())
            .filter(|unit| !self.found.contains_key(unit))
            .collect();
        let is_kept = self.ledger.is_some();
        let solve = |unit: usize, progress: &mut ProgressCallback<'_>| {
            let found = solve_unit(work, &work.units[unit], progress)?;
            let content = is_kept.then(|| packed(&found)).transpose()?;
            Ok((found, content))
        };
        work_through(&todo, options.threads, &solve, &mut self)
    }

    /// Orbits that a unit stands for.
    fn orbits(&self, unit: usize) -> usize {
        let unit = self.work.units.get(unit);
        unit.map_or(0, |unit| unit.task.bearings().len())
    }

    fn done(&self) -> usize {
        self.found.keys().map(|unit| self.orbits(*unit)).sum()
    }

    /// Shows how far the work is, with something worth a line.
    pub(super) fn tell(&mut self, message: Option<String>) -> ControlFlow<()> {
        let total: usize = (0..self.work.units.len()).map(|at| self.orbits(at)).sum();
        let done = self.done();
        let shares = self.shares.iter();
        let at_work: f64 = shares
            .map(|(unit, share)| share * self.orbits(*unit) as f64)
            .sum();
        // The share of what this run has to do: the time left follows from it.
        let mine = (total - self.found_done).max(1) as f64;
        let share = ((done - self.found_done) as f64 + at_work) / mine;
        let label = match self.work.speeds.len() {
            1 => format!("{done} of {total} orbits"),
            speeds => format!("{done} of {total} orbits at {speeds} speeds"),
        };
        (self.progress)(ProgressEvent {
            message,
            ..ProgressEvent::new(label, share)
        })
    }

    /// What a finished unit did not solve.
    fn failures(&self, unit: usize, found: &UnitFound) -> Vec<String> {
        let speed = self.work.units.get(unit).map_or(0, |unit| unit.speed);
        let failed = found.iter();
        let failed = failed.filter(|found| found.orbit.outcome != Outcome::Converged);
        failed
            .map(|found| {
                let status = status_name(found.orbit.outcome);
                format!("{}: {status}", self.work.place(speed, found.bearing))
            })
            .collect()
    }
}

impl Desk<Finished> for UnitDesk<'_> {
    fn take(&mut self, news: Vec<News<Finished>>) -> Result<ControlFlow<()>, RunError> {
        let mut entries = Vec::new();
        let mut finished = Vec::new();
        for news in news {
            match news {
                News::Started(unit) => {
                    self.shares.insert(unit, 0.0);
                    entries.push(Entry::Started(unit + 1));
                }
                News::Share(unit, share) => {
                    self.shares.insert(unit, share);
                }
                News::Abandoned(unit) => {
                    self.shares.remove(&unit);
                }
                News::Finished(unit, (found, content)) => {
                    self.shares.remove(&unit);
                    entries.extend(content.map(|content| Entry::Found(unit + 1, content)));
                    finished.push((unit, found));
                }
            }
        }
        if let Some(ledger) = &mut self.ledger
            && !entries.is_empty()
        {
            ledger.write(&entries)?;
        }
        let mut answer = ControlFlow::Continue(());
        for (unit, found) in finished {
            let failures = self.failures(unit, &found);
            self.found.insert(unit, found);
            for failure in failures {
                if self.tell(Some(failure)).is_break() {
                    answer = ControlFlow::Break(());
                }
            }
        }
        Ok(answer)
    }

    fn show(&mut self) -> ControlFlow<()> {
        self.tell(None)
    }
}

/// What a unit found as it stands in the ledger: CBOR (RFC 8949), which holds every number as it is,
/// deflated.
pub(super) fn packed(found: &UnitFound) -> Result<Vec<u8>, RunError> {
    let failed = |reason: String| {
        RunError::Output(OutputError::Content {
            file: crate::ledger::FILE_NAME,
            reason,
        })
    };
    // Number by number, the encoder would clear its buffer for each of them.
    let mut plain = Vec::new();
    ciborium::into_writer(found, &mut plain).map_err(|error| failed(error.to_string()))?;
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder
        .write_all(&plain)
        .and_then(|()| encoder.finish())
        .map_err(|error| failed(error.to_string()))
}

/// The reverse of [`packed`].
fn unpacked(content: &[u8]) -> Result<UnitFound, String> {
    ciborium::from_reader(ZlibDecoder::new(content)).map_err(|error| error.to_string())
}

/// The units that a ledger holds, of a run of so many.
pub(super) fn read(ledger: &Ledger, units: usize) -> Result<BTreeMap<usize, UnitFound>, RunError> {
    let findings = ledger.findings()?.into_iter();
    let found = findings.map(|(number, content)| {
        let unit = number.checked_sub(1).filter(|unit| *unit < units);
        let unit = unit.ok_or_else(|| ledger.damaged("it holds a calculation of another run"))?;
        let found = unpacked(&content)
            .map_err(|reason| ledger.damaged(&format!("calculation {number}: {reason}")))?;
        Ok((unit, found))
    });
    found.collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;
    use crate::run::machine::units::BearingFound;
    use sommerfeld_bearing::{CycleTilt, JournalOrbit, LoadCycle};

    /// Numbers that compare as equal, or as never equal, are still themselves after the ledger.
    #[test]
    fn the_ledger_keeps_every_bit_of_a_number() {
        let payload = f64::from_bits(0xfff8_0000_0000_1234);
        let signalling = f64::from_bits(0x7ff0_0000_0000_0001);
        let values = [
            0.0,
            -0.0,
            f64::NAN,
            -f64::NAN,
            payload,
            signalling,
            f64::INFINITY,
            f64::MIN_POSITIVE / 1024.0,
            0.1,
            1.0,
            f64::from(0.1_f32),
        ];
        let rows = values.map(|value| [value, -value]).to_vec();
        let found = vec![BearingFound {
            bearing: 3,
            load: LoadCycle {
                points: Vec::new(),
                period: 1.0,
                engine_speed: 1.0,
                journal_mass: 0.0,
                tilt: CycleTilt::Prescribed(rows.clone()),
                feed_pressures: Vec::new(),
            },
            determinate_load: Some(rows),
            orbit: JournalOrbit {
                points: Vec::new(),
                outcome: Outcome::Converged,
                cycles: 2,
                closure: f64::NAN,
                steps: 720,
                film_solves: 2000,
            },
            feed_flows: Vec::new(),
            fields: None,
            turned_from: Some((1, 0.1)),
            heat: None,
            notes: vec!["µ".to_owned()],
        }];
        let read = unpacked(&packed(&found).unwrap()).unwrap();
        let bits = |found: &UnitFound| -> Vec<u64> {
            let rows = found[0].determinate_load.iter().flatten().flatten();
            rows.map(|value| value.to_bits()).collect()
        };
        assert_eq!(bits(&read), bits(&found));
        assert_eq!(read[0].notes, found[0].notes);
        assert_eq!(read[0].turned_from, Some((1, 0.1)));
        assert!(read[0].orbit.closure.is_nan());
        assert!(unpacked(b"neither deflated nor CBOR").is_err());
    }
}
