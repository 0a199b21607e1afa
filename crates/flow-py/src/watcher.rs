//! Comes back to Python during a run: for signals, for the progress and for callbacks.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use flow_core::run::{Observer, Progress};
use pyo3::exceptions::{PyKeyboardInterrupt, PyStopIteration};
use pyo3::prelude::*;

/// Signals are looked for this often: often enough for a prompt Ctrl-C, too rarely to be felt.
const BETWEEN_SIGNALS: Duration = Duration::from_millis(20);

/// Watches a run for Python.
pub struct Watcher {
    callback: Option<Py<PyAny>>,
    interval: Duration,
    checked: Instant,
    called: Option<Instant>,
    /// What the callback or a signal handler raised, other than to stop the run.
    pub raised: Option<PyErr>,
}

impl Watcher {
    /// Calls `callback` after the first step and then after every step that ends `interval` or more after the last call.
    pub fn new(callback: Option<Py<PyAny>>, interval: Duration) -> Self {
        Self { callback, interval, checked: Instant::now(), called: None, raised: None }
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
            self.look(py, progress, call).map_err(|error| {
                let stop = error.is_instance_of::<PyKeyboardInterrupt>(py)
                    || error.is_instance_of::<PyStopIteration>(py);
                (!stop).then_some(error)
            })
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
}
