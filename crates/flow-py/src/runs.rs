//! Where records come from: runs and result files.

use flow_core::output::{StorageError, checkpoint};
use flow_core::run as core;
use pyo3::prelude::*;

use crate::error::detached;
use crate::file_path::FilePath;
use crate::record::Record;
use crate::scene::Scene;
use crate::watcher::Watcher;

/// Runs `scene`; comes back every few milliseconds for signals, and to call `callback` with the fields of `Progress`
/// after steps that end at least `interval` seconds apart.
#[pyfunction]
pub fn run(py: Python<'_>, scene: &Scene, callback: Option<Py<PyAny>>, interval: f64) -> PyResult<Record> {
    let mut watcher = Watcher::new(callback, interval)?;
    let core = detached(py, || core::run(&scene.core, &mut watcher))?;
    watcher.other(py).map_or(Ok(Record::new(core)), Err)
}

/// Reads a result file, or what its run has so far.
#[pyfunction]
pub fn read(py: Python<'_>, path: FilePath) -> PyResult<Record> {
    Ok(Record::new(detached(py, || Ok::<_, StorageError>(checkpoint::so_far(&path.0)?.record))?))
}
