//! Names of files.

use std::path::PathBuf;

use pyo3::exceptions::PyUnicodeEncodeError;
use pyo3::prelude::*;

use crate::error::exception;

/// The name of a file that holds or takes a result: one that no file can have is a `StorageError`.
pub struct FilePath(pub PathBuf);

impl FromPyObject<'_, '_> for FilePath {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        file_path(&given, "StorageError").map(Self)
    }
}

/// The name that `given` is; an error of `class` if it holds half a character, which no name of a file can.
pub fn file_path(given: &Bound<'_, PyAny>, class: &str) -> PyResult<PathBuf> {
    // Bytes are names too, as they are for `open` of Python.
    let decoded = given.py().import("os")?.call_method1("fsdecode", (given,))?;
    decoded.extract().map_err(|error: PyErr| {
        if error.is_instance_of::<PyUnicodeEncodeError>(given.py()) {
            not_a_name(given, class)
        } else {
            error
        }
    })
}

#[cold]
fn not_a_name(given: &Bound<'_, PyAny>, class: &str) -> PyErr {
    let py = given.py();
    let name = py.import("os").and_then(|os| os.call_method1("fspath", (given,))?.repr());
    match name {
        Ok(name) => exception(
            py,
            class,
            &format!("{name}: no file can have this name, which has half a character; check it"),
        ),
        Err(error) => error,
    }
}
