//! How far a run is: a bar with the time left on a terminal, plain lines elsewhere; and Ctrl-C.

use indicatif::{ProgressBar, ProgressStyle};
use sommerfeld_study::ProgressEvent;
use std::io::{self, IsTerminal};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

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
    /// Number of tenths already told.
    Lines(Option<u8>),
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
            Display::Lines(None)
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
            Display::Lines(told) => {
                if let Some(message) = &event.message {
                    eprintln!("{message}");
                }
                let tenth = (done * TENTHS) as u8;
                if told.is_none_or(|told| tenth > told) {
                    *told = Some(tenth);
                    eprintln!("{:>3} %  {}", 10 * tenth, event.label);
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
