//! The command line, in the process of Python.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Does what `arguments` ask for, the first of which is the name of the program; returns the exit code.
#[pyfunction]
pub fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| flow_cli::run(arguments))
}
