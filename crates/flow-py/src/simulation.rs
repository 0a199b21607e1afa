//! Runs that are driven from Python, step by step.

use std::sync::{Mutex, MutexGuard};

use flow_core::output::{StorageError, checkpoint};
use flow_core::run::{self as core, Frame, StepLog};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::arrays::{Table, Vector, table, vector};
use crate::error::detached;
use crate::file_path::FilePath;
use crate::record::Record;
use crate::scene::Scene;
use crate::watcher::Watcher;

/// A scene under way.
#[pyclass(frozen, module = "curveflow._curveflow")]
pub struct Simulation {
    core: Mutex<core::Simulation>,
}

impl Simulation {
    fn lock(&self) -> PyResult<MutexGuard<'_, core::Simulation>> {
        self.core.try_lock().map_err(|_| {
            PyRuntimeError::new_err(
                "the simulation is in use: a callback of a run cannot use it, nor another thread",
            )
        })
    }
}

#[pymethods]
impl Simulation {
    #[new]
    fn new(py: Python<'_>, scene: &Scene) -> PyResult<Self> {
        let core = detached(py, || core::Simulation::new(&scene.core))?;
        Ok(Self { core: Mutex::new(core) })
    }

    /// Goes on from a checkpoint.
    #[staticmethod]
    fn resume(py: Python<'_>, path: FilePath) -> PyResult<Self> {
        let core = detached::<_, StorageError>(py, || checkpoint::read(&path.0)?.simulation(&path.0))?;
        Ok(Self { core: Mutex::new(core) })
    }

    /// Time of the last accepted state.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.lock()?.time())
    }

    /// Time at which the run ends at the latest.
    #[getter]
    fn end(&self) -> PyResult<f64> {
        Ok(self.lock()?.end())
    }

    /// Accepted steps so far.
    #[getter]
    fn steps(&self) -> PyResult<u64> {
        Ok(self.lock()?.counters().steps)
    }

    /// Short name of the reason why the run stopped; none while it can go on.
    #[getter]
    fn status(&self) -> PyResult<Option<&'static str>> {
        let simulation = self.lock()?;
        Ok(simulation
            .stop_reason()
            .filter(|reason| **reason != core::StopReason::Interrupted)
            .map(core::StopReason::name))
    }

    /// At most `steps` steps until `time`; false if it is over, or the callback, which is that of `run`, stops it. Ctrl-C is raised.
    fn run_until(
        &self,
        py: Python<'_>,
        time: f64,
        steps: u64,
        callback: Option<Py<PyAny>>,
        interval: f64,
    ) -> PyResult<bool> {
        let mut watcher = Watcher::new(callback, interval)?;
        let mut guard = self.lock()?;
        let simulation = &mut *guard;
        simulation.go_on();
        let more = detached::<_, StorageError>(py, || Ok(simulation.run_until(time, steps, &mut watcher)))?;
        watcher.raised.map_or(Ok(more), Err)
    }

    /// Whether the run is at `time`, or within its rounding of it.
    fn has_reached(&self, time: f64) -> PyResult<bool> {
        Ok(self.lock()?.has_reached(time))
    }

    /// The state at hand: time, energy, dissipation, length, area; position, curvature, metric, normal velocity and each
    /// density. The arrays take over the buffers of a frame that is made for them.
    fn state<'py>(&self, py: Python<'py>) -> PyResult<State<'py>> {
        let mut guard = self.lock()?;
        let simulation = &mut *guard;
        let frame = detached::<_, StorageError>(py, || Ok(simulation.frame()))?;
        let nodes = frame.position.len();
        let density = simulation.densities().iter().cloned().zip(frame.density);
        Ok((
            [frame.time, frame.energy, frame.dissipation, frame.length, frame.area],
            table(py, frame.position.into_flattened(), nodes, 2)?,
            [frame.curvature, frame.metric, frame.normal_velocity].map(|field| vector(py, field)),
            density.map(|(name, values)| (name, vector(py, values))).collect(),
        ))
    }

    /// The state at hand, as a record of one frame.
    fn snapshot(&self, py: Python<'_>) -> PyResult<Record> {
        let mut guard = self.lock()?;
        let simulation = &mut *guard;
        let record = detached::<_, StorageError>(py, || {
            let frame: Frame = simulation.frame();
            Ok(simulation.record_of(vec![frame], StepLog::default()))
        })?;
        Ok(Record::new(record))
    }

    /// What there is so far.
    fn record(&self, py: Python<'_>) -> PyResult<Record> {
        let mut guard = self.lock()?;
        let simulation = &mut *guard;
        Ok(Record::new(detached::<_, StorageError>(py, || Ok(simulation.record()))?))
    }

    /// Writes a checkpoint, in place of another one; of another file only if `replace`.
    fn checkpoint(&self, py: Python<'_>, path: FilePath, replace: bool) -> PyResult<()> {
        let guard = self.lock()?;
        let simulation = &*guard;
        detached(py, || checkpoint::write(simulation, &path.0, replace))
    }
}

/// What [`Simulation::state`] tells.
type State<'py> = ([f64; 5], Table<'py>, [Vector<'py>; 3], Vec<(String, Vector<'py>)>);
