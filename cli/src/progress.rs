//! How far a run is, with the time left: a bar on a terminal, plain lines elsewhere; and Ctrl-C.

use indicatif::{ProgressBar, ProgressStyle};
use sommerfeld_study::ProgressEvent;
use std::io::{self, IsTerminal};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Steps of the bar.
const STEPS: u64 = 1000;
/// Plain lines come at every tenth of the run.
const TENTHS: f64 = 10.0;

/// Shows the events of a run and answers whether it may go on.
pub struct Progress {
    display: Display,
    stop: Arc<AtomicBool>,
}

enum Display {
    Bar(ProgressBar),
    Lines {
        start: Instant,
        /// Number of tenths already told.
        told: Option<u8>,
    },
}

impl Progress {
    /// On standard error: standard output belongs to results.
    pub fn new(stop: Arc<AtomicBool>) -> Self {
        let display = if io::stderr().is_terminal() {
            let bar = ProgressBar::new(STEPS);
            let template = "{bar:30} {percent:>3} %  {msg}  {eta} left";
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style);
            }
            Display::Bar(bar)
        } else {
            Display::Lines {
                start: Instant::now(),
                told: None,
            }
        };
        Self { display, stop }
    }

    /// Shows one event.
    pub fn show(&mut self, event: &ProgressEvent) -> ControlFlow<()> {
        let done = event.done.clamp(0.0, 1.0);
        match &mut self.display {
            Display::Bar(bar) => {
                if let Some(message) = &event.message {
                    bar.println(message);
                }
                bar.set_position((done * 1000.0) as u64);
                bar.set_message(event.label.clone());
            }
            Display::Lines { start, told } => {
                if let Some(message) = &event.message {
                    eprintln!("{message}");
                }
                let tenth = (done * TENTHS) as u8;
                if told.is_none_or(|told| tenth > told) {
                    *told = Some(tenth);
                    let left = time_left(start.elapsed(), done);
                    let left = left.map_or(String::new(), |left| format!("  {left} left"));
                    eprintln!("{:>3} %  {}{left}", 10 * tenth, event.label);
                }
            }
        }
        if self.stop.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }
}

/// What is left of a run that has done this share in this time and goes on as before; `None` at its ends.
fn time_left(elapsed: Duration, done: f64) -> Option<String> {
    if done <= 0.0 || done >= 1.0 {
        return None;
    }
    let seconds = (elapsed.as_secs_f64() * (1.0 / done - 1.0)).round();
    // Beyond years nobody counts; the conversion saturates.
    let seconds = seconds as u64;
    let (hours, minutes) = (seconds / 3600, seconds / 60);
    Some(match (hours, minutes) {
        (0, 0) => format!("{seconds}s"),
        (0, _) => format!("{minutes}m {}s", seconds % 60),
        _ => format!("{hours}h {}m", minutes % 60),
    })
}

/// A flag that Ctrl-C raises. The run stops at its next event and leaves a valid directory; a second
/// Ctrl-C ends the program at once.
pub fn stop_flag() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    // Without a handler Ctrl-C still ends the program, only less politely.
    let _ = ctrlc::set_handler(move || {
        if raised.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    stop
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_follows_from_the_share_done() {
        let left = |elapsed, done| time_left(Duration::from_secs(elapsed), done);
        assert_eq!(left(10, 0.0), None);
        assert_eq!(left(10, 1.0), None);
        assert_eq!(left(10, 0.25), Some("30s".to_owned()));
        assert_eq!(left(61, 0.5), Some("1m 1s".to_owned()));
        assert_eq!(left(3600, 0.4), Some("1h 30m".to_owned()));
        assert!(left(1, f64::MIN_POSITIVE).is_some());
    }
}
