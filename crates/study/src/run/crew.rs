//! Units of work over threads, under one calling thread that alone owns the ledger and the progress.
//!
//! The threads compute units and send what becomes of them; a unit is sequential, so that what it
//! finds does not depend on the number of threads.

use super::{ProgressCallback, RunError};
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// A sign of life at least this often, so that Ctrl-C is heard while long units run.
const HEARTBEAT: Duration = Duration::from_millis(200);
/// Share of a unit that is worth a message to the calling thread.
const NOTABLE: f64 = 0.01;

/// What the calling thread hears of a unit, by its index.
pub(super) enum News<T> {
    Started(usize),
    /// Share of it that is done.
    Share(usize, f64),
    Finished(usize, T),
    /// It was given up because the run was stopped.
    Abandoned(usize),
}

/// The calling thread: keeps what is finished and shows how far the work is.
pub(super) trait Desk<T> {
    /// Takes what has come in since the last time and answers whether to go on.
    ///
    /// # Errors
    /// What ends the work.
    fn take(&mut self, news: Vec<News<T>>) -> Result<ControlFlow<()>, RunError>;

    /// Shows how far the work is and answers whether to go on.
    fn show(&mut self) -> ControlFlow<()>;
}

/// Computes one unit under a progress of its own, which asks it to stop.
pub(super) type Work<'a, T> =
    dyn Fn(usize, &mut ProgressCallback<'_>) -> Result<T, RunError> + Sync + 'a;

enum Sent<T> {
    News(News<T>),
    Broken(RunError),
}

/// Does the units `todo`, in their order, on so many threads (`None`: one for each processor) until
/// they are done, the desk stops them, or one fails; the first failure is reported.
pub(super) fn work_through<T: Send>(
    todo: &[usize],
    threads: Option<usize>,
    work: &Work<'_, T>,
    desk: &mut dyn Desk<T>,
) -> Result<(), RunError> {
    if todo.is_empty() {
        return Ok(());
    }
    // Without a number rayon takes one thread for each processor.
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .build()
        .map_err(|error| RunError::Threads(error.to_string()))?;
    let stopped = AtomicBool::new(false);
    let (sender, receiver) = channel();
    std::thread::scope(|scope| {
        let stopped = &stopped;
        scope.spawn(move || {
            // In order, each thread the next unit: the results fill from their beginning.
            pool.install(|| {
                todo.iter()
                    .par_bridge()
                    .for_each_with(sender, |sender, &unit| do_unit(unit, work, stopped, sender));
            });
        });
        serve(&receiver, stopped, desk)
    })
}

/// Computes a unit and sends what became of it. That nobody listens any more is no failure of this
/// thread.
fn do_unit<T>(unit: usize, work: &Work<'_, T>, stopped: &AtomicBool, sender: &Sender<Sent<T>>) {
    let is_stopped = || stopped.load(Ordering::Relaxed);
    if is_stopped() {
        return;
    }
    let _ = sender.send(Sent::News(News::Started(unit)));
    let mut told = 0.0;
    let mut interrupted = false;
    let ended = work(unit, &mut |event| {
        if event.done >= told + NOTABLE {
            told = event.done;
            let _ = sender.send(Sent::News(News::Share(unit, event.done.min(1.0))));
        }
        if is_stopped() {
            interrupted = true;
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    let _ = sender.send(match ended {
        _ if interrupted => Sent::News(News::Abandoned(unit)),
        Ok(found) => Sent::News(News::Finished(unit, found)),
        Err(error) => Sent::Broken(error),
    });
}

/// Until every thread has ended.
fn serve<T>(
    receiver: &Receiver<Sent<T>>,
    stopped: &AtomicBool,
    desk: &mut dyn Desk<T>,
) -> Result<(), RunError> {
    let stop = || stopped.store(true, Ordering::Relaxed);
    let heed = |answer: ControlFlow<()>| {
        if answer.is_break() {
            stop();
        }
    };
    let mut failure = None;
    heed(desk.show());
    loop {
        let first = match receiver.recv_timeout(HEARTBEAT) {
            Ok(first) => Some(first),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => break,
        };
        let mut batch = Vec::new();
        let mut broken = None;
        // What has come in meanwhile is taken together: it shares one commit of the ledger.
        for sent in first.into_iter().chain(receiver.try_iter()) {
            match sent {
                Sent::News(news) => batch.push(news),
                Sent::Broken(error) => broken = broken.or(Some(error)),
            }
        }
        match desk.take(batch) {
            Ok(answer) => heed(answer),
            Err(error) => broken = broken.or(Some(error)),
        }
        if broken.is_some() {
            stop();
            failure = failure.or(broken);
        }
        heed(desk.show());
    }
    failure.map_or(Ok(()), Err)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;
    use crate::progress::ProgressEvent;

    /// Notes what is finished and stops the work after so many units.
    struct Notes {
        finished: Vec<(usize, usize)>,
        abandoned: usize,
        most: usize,
    }

    impl Desk<usize> for Notes {
        fn take(&mut self, news: Vec<News<usize>>) -> Result<ControlFlow<()>, RunError> {
            for news in news {
                match news {
                    News::Finished(unit, found) => self.finished.push((unit, found)),
                    News::Abandoned(_) => self.abandoned += 1,
                    News::Started(_) | News::Share(..) => {}
                }
            }
            Ok(self.show())
        }

        fn show(&mut self) -> ControlFlow<()> {
            match self.finished.len() >= self.most {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        }
    }

    fn notes(most: usize) -> Notes {
        Notes {
            finished: Vec::new(),
            abandoned: 0,
            most,
        }
    }

    #[test]
    fn every_unit_is_done_once_whatever_the_threads() {
        let todo: Vec<usize> = (3..40).collect();
        for threads in [1, 4] {
            let mut desk = notes(usize::MAX);
            work_through(&todo, Some(threads), &|unit, _| Ok(unit * unit), &mut desk).unwrap();
            desk.finished.sort_unstable();
            let expected: Vec<_> = todo.iter().map(|unit| (*unit, unit * unit)).collect();
            assert_eq!(desk.finished, expected);
        }
    }

    #[test]
    fn a_stop_reaches_units_at_work() {
        let mut desk = notes(1);
        let is_under_way = AtomicBool::new(false);
        // The first unit ends, and with it the run, only when the second is at work for good.
        let endless = |unit: usize, progress: &mut ProgressCallback<'_>| {
            if unit > 0 {
                is_under_way.store(true, Ordering::Relaxed);
            }
            while !is_under_way.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(1));
            }
            while unit > 0 && progress(ProgressEvent::new("", 0.5)).is_continue() {
                std::thread::sleep(Duration::from_millis(1));
            }
            Ok(unit)
        };
        work_through(&[0, 1, 2, 3], Some(2), &endless, &mut desk).unwrap();
        assert_eq!(desk.finished, [(0, 0)]);
        assert!(desk.abandoned >= 1);
    }

    #[test]
    fn the_first_failure_is_reported_and_ends_the_work() {
        let mut desk = notes(usize::MAX);
        let fails = |unit: usize, _: &mut ProgressCallback<'_>| match unit {
            2 => Err(RunError::Threads("unit 2".into())),
            _ => Ok(unit),
        };
        let todo: Vec<usize> = (0..1000).collect();
        let error = work_through(&todo, Some(1), &fails, &mut desk).unwrap_err();
        assert!(error.to_string().contains("unit 2"));
        assert!(desk.finished.len() < todo.len());
    }
}
