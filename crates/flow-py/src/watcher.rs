//! Comes back to Python during a run: for signals, for the progress and for callbacks.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use flow_core::run::tradeoff::{LadderObserver, Leg};
use flow_core::run::{Observer, Progress};
use pyo3::exceptions::{PyKeyboardInterrupt, PyStopIteration, PyValueError};
use pyo3::prelude::*;

/// Signals are looked for this often: often enough for a prompt Ctrl-C, too rarely to be felt.
const BETWEEN_SIGNALS: Duration = Duration::from_millis(20);

/// Watches a run for Python.
pub struct Watcher {
    callback: Option<Py<PyAny>>,
    interval: Duration,
    checked: Instant,
    called: Option<Instant>,
    /// What stopped the run: Ctrl-C, or what the callback or a signal handler raised, but for `StopIteration`.
    pub raised: Option<PyErr>,
}

impl Watcher {
    /// Calls `callback` after the first step and then after every step that ends `interval` seconds or more after the last call.
    pub fn new(callback: Option<Py<PyAny>>, interval: f64) -> PyResult<Self> {
        let interval = Duration::try_from_secs_f64(interval)
            .map_err(|error| PyValueError::new_err(format!("interval = {interval}: {error}")))?;
        Ok(Self { callback, interval, checked: Instant::now(), called: None, raised: None })
    }

    /// What was raised other than to stop the run and keep what there is, as Ctrl-C does.
    pub fn other(self, py: Python<'_>) -> Option<PyErr> {
        self.raised.and_then(|error| other(py, error))
    }

    fn look(&mut self, py: Python<'_>, progress: &Progress, call: bool) -> PyResult<()> {
        py.check_signals()?;
        if let Some(callback) = self.callback.as_ref().filter(|_| call) {
            let Progress { time, end, steps, step_size, energy, dissipation, length } = *progress;
            callback.call1(py, (time, end, steps, step_size, energy, dissipation, length))?;
        }
        Ok(())
    }
}

impl Observer for Watcher {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        let now = Instant::now();
        let call = self.callback.is_some()
            && self.called.is_none_or(|last| now.duration_since(last) >= self.interval);
        if !call && now.duration_since(self.checked) < BETWEEN_SIGNALS {
            return ControlFlow::Continue(());
        }
        let looked = Python::attach(|py| {
            let stops = |error: &PyErr| error.is_instance_of::<PyStopIteration>(py);
            self.look(py, progress, call).map_err(|error| Some(error).filter(|error| !stops(error)))
        });
        self.checked = Instant::now();
        if call {
            self.called = Some(self.checked);
        }
        match looked {
            Ok(()) => ControlFlow::Continue(()),
            Err(raised) => {
                self.raised = raised;
                ControlFlow::Break(())
            }
        }
    }

    fn takes_time(&self) -> bool {
        self.callback.is_some()
    }
}

/// None for what stops a run without being an error.
fn other(py: Python<'_>, error: PyErr) -> Option<PyErr> {
    let stop = error.is_instance_of::<PyKeyboardInterrupt>(py) || error.is_instance_of::<PyStopIteration>(py);
    (!stop).then_some(error)
}

/// Watches a ladder for Python: all its runs, and the start of each.
pub struct LadderWatcher {
    runs: Watcher,
    before_run: Option<Py<PyAny>>,
    /// Whether `before_run` raised anything: the ladder then stops at the next step.
    stopped: bool,
    /// What it raised, other than to stop.
    refused: Option<PyErr>,
}

impl LadderWatcher {
    /// Calls `before_run` with the name of the run, its tolerance, its number and the number of rungs, or 0 for the
    /// runs that are no rungs.
    pub fn new(runs: Watcher, before_run: Option<Py<PyAny>>) -> Self {
        Self { runs, before_run, stopped: false, refused: None }
    }

    /// What Python raised, other than to stop the ladder.
    pub fn raised(self, py: Python<'_>) -> Option<PyErr> {
        self.refused.or(self.runs.other(py))
    }
}

impl Observer for LadderWatcher {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        if self.stopped { ControlFlow::Break(()) } else { self.runs.after_step(progress) }
    }
}

impl LadderObserver for LadderWatcher {
    fn before_run(&mut self, leg: &Leg) {
        let Some(before_run) = &self.before_run else { return };
        let arguments = match *leg {
            Leg::Scout { tolerance } => ("scout", tolerance, 0, 0),
            Leg::Reference { tolerance, .. } => ("reference", tolerance, 0, 0),
            Leg::Rung { tolerance, number, count } => ("rung", tolerance, number, count),
            _ => return,
        };
        let called = Python::attach(|py| before_run.call1(py, arguments).map_err(|error| other(py, error)));
        if let Err(refused) = called {
            self.stopped = true;
            self.refused = refused;
        }
    }
}
