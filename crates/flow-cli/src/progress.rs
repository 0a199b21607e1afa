//! Progress of a run on standard error: a line that renews itself on a terminal, elsewhere one every 30 s.

use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use flow_core::run::tradeoff::{LadderObserver, Leg};
use flow_core::run::{Observer, Progress};
use indicatif::{ProgressBar, ProgressStyle};

use crate::print;

/// Time between two lines where standard error is no terminal.
const PLAIN_INTERVAL: Duration = Duration::from_secs(30);
/// Time between two looks of the terminal line.
const TERMINAL_INTERVAL: Duration = Duration::from_millis(100);

/// Shows progress and passes on the wish to stop.
#[derive(Debug)]
pub struct Reporter {
    stop: Arc<AtomicBool>,
    limit: Option<Instant>,
    line: Option<ProgressBar>,
    interval: Option<Duration>,
    shown: Instant,
}

impl Reporter {
    /// A reporter that stops the run once `stop` is set, or at the time `limit`.
    pub fn new(quiet: bool, stop: Arc<AtomicBool>, limit: Option<Instant>) -> Self {
        let terminal = !quiet && std::io::stderr().is_terminal();
        let line = terminal.then(|| {
            let style = ProgressStyle::with_template("{spinner} {msg}");
            let line = ProgressBar::new_spinner();
            line.with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()))
        });
        let interval = (!quiet).then_some(if terminal { TERMINAL_INTERVAL } else { PLAIN_INTERVAL });
        Self { stop, limit, line, interval, shown: Instant::now() }
    }

    /// What says things without spoiling the line.
    pub fn voice(&self) -> impl Fn(&str) + use<> {
        let line = self.line.clone();
        move |text| match &line {
            Some(line) => line.suspend(|| print::talk(text)),
            None => print::talk(text),
        }
    }

    /// Takes the line away.
    pub fn finish(&self) {
        if let Some(line) = &self.line {
            line.finish_and_clear();
        }
    }
}

impl Observer for Reporter {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        if self.interval.is_some_and(|interval| self.shown.elapsed() >= interval) {
            self.shown = Instant::now();
            let message = format!(
                "t = {:.4e} of {:.4e}, step {} of size {:.2e}, energy {}, dissipation {:.2e}, length {}",
                progress.time,
                progress.end,
                progress.steps,
                progress.step_size,
                print::digits(progress.energy),
                progress.dissipation,
                print::digits(progress.length)
            );
            match &self.line {
                Some(line) => {
                    line.set_message(message);
                    line.tick();
                }
                None => print::talk(&message),
            }
        }
        let over =
            self.stop.load(Ordering::Relaxed) || self.limit.is_some_and(|limit| Instant::now() >= limit);
        if over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl LadderObserver for Reporter {
    fn before_run(&mut self, leg: &Leg) {
        let message = match leg {
            Leg::Scout { tolerance } => format!("the scene itself, at tolerance {tolerance:e}"),
            Leg::Reference { tolerance, nodes } => {
                format!("the reference, at tolerance {tolerance:e} ({nodes})")
            }
            Leg::Rung { tolerance, number, count } => {
                format!("run {number} of {count}, at tolerance {tolerance:e}")
            }
            _ => return,
        };
        match (&self.line, self.interval) {
            (Some(line), _) => line.println(message),
            (None, Some(_)) => print::talk(&message),
            (None, None) => {}
        }
    }
}
