//! What can be made of a record besides arrays: the bytes of its file, its picture, where it comes from.

use flow_core::output::picture::{NodalLines, Options, PictureError, plot};
use flow_core::output::{StorageError, atomic_file, hdf5_file};
use flow_core::run::{Provenance, nodal_polylines};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error::detached;
use crate::file_path::FilePath;
use crate::record::Record;

/// The bytes of the result file of `record`.
#[pyfunction]
pub fn file_bytes<'py>(py: Python<'py>, record: &Record) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = detached::<_, StorageError>(py, || hdf5_file::to_bytes(&record.core))?;
    Ok(PyBytes::new(py, &bytes))
}

/// Checks that [`write_file`] can write to `path` now.
#[pyfunction]
pub fn check_writable(py: Python<'_>, path: FilePath, replace: bool) -> PyResult<()> {
    detached(py, || atomic_file::check_writable(&path.0, replace))
}

/// Writes `data` to a file that appears at once, by the rules of all files of ours.
#[pyfunction]
pub fn write_file(py: Python<'_>, path: FilePath, data: &[u8], replace: bool) -> PyResult<()> {
    detached(py, || atomic_file::write(&path.0, data, replace))
}

/// Draws `record`, with one of its densities, into a PNG or SVG file.
#[pyfunction]
pub fn picture(
    py: Python<'_>,
    record: &Record,
    path: FilePath,
    density: Option<String>,
    replace: bool,
) -> PyResult<()> {
    detached::<_, PictureError>(py, || {
        let lines = nodal_polylines(&record.core, density.as_deref());
        let nodal_lines =
            lines.map(|[preferred_curvature, low, high]| NodalLines { preferred_curvature, low, high });
        let options = Options { replace, density, nodal_lines, ..Options::default() };
        plot(&record.core, &path.0, &options)
    })
}

/// Version, commit, machine, seconds of integration and citation of `record`.
#[pyfunction]
pub fn provenance(record: &Record) -> (String, Option<String>, String, f64, String) {
    let Provenance { version, commit, machine, citation } = record.core.provenance.clone();
    (version, commit, machine, record.core.counters.integration_seconds, citation)
}
