//! The extension module `curveflow._curveflow`: one thin wrapper per call of `flow-core`.
//!
//! It borrows, releases the interpreter lock, maps errors and moves out; the public package with its docstrings is
//! `python/curveflow`, the types are in `python/curveflow/_curveflow.pyi`.

#![allow(clippy::needless_pass_by_value)] // the arguments of a call from Python arrive by value

mod arrays;
mod command;
mod error;
mod exports;
mod file_path;
mod operators;
mod record;
mod runs;
mod scene;
mod simulation;
mod system;
mod tradeoff;
mod tradeoff_parts;
mod watcher;

/// The extension module.
#[pyo3::pymodule]
mod _curveflow {
    use pyo3::prelude::*;

    /// Loads NumPy's functions now: a signal that arrives while they are loaded later, for the first array, would be a panic.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.py().import("numpy")?;
        crate::arrays::vector::<f64>(module.py(), Vec::new());
        Ok(())
    }

    /// Version of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    #[pymodule_export]
    use super::command::command;
    #[pymodule_export]
    use super::exports::{check_writable, file_bytes, picture, provenance, write_file};
    #[pymodule_export]
    use super::operators::{energy, flow_map, geometry, helmholtz, incompressibility, normal_force};
    #[pymodule_export]
    use super::record::Record;
    #[pymodule_export]
    use super::runs::{read, run};
    #[pymodule_export]
    use super::scene::{Scene, schema, shipped};
    #[pymodule_export]
    use super::simulation::Simulation;
    #[pymodule_export]
    use super::system::System;
    #[pymodule_export]
    use super::tradeoff::{Tradeoff, tradeoff};
}
