//! Each error enum of `flow-core` is one exception class of `curveflow.errors`; a panic is a `BugError`.

use std::error::Error;
use std::panic::{AssertUnwindSafe, catch_unwind};

use flow_core::flow::NodalError;
use flow_core::geometry::GeometryError;
use flow_core::output::page::PageError;
use flow_core::output::picture::PictureError;
use flow_core::output::{StorageError, with_causes};
use flow_core::run::tradeoff::{LadderError, TradeoffError};
use flow_core::run::{EvaluationError, SceneError, SetupError};
use pyo3::prelude::*;

/// An error with a class of its own in `curveflow.errors`.
pub trait PythonError: Error + Send {
    /// Name of the class.
    fn class(&self) -> &'static str;
}

impl PythonError for SceneError {
    fn class(&self) -> &'static str {
        "SceneError"
    }
}

impl PythonError for SetupError {
    fn class(&self) -> &'static str {
        "SetupError"
    }
}

impl PythonError for StorageError {
    fn class(&self) -> &'static str {
        "StorageError"
    }
}

impl PythonError for LadderError {
    fn class(&self) -> &'static str {
        "LadderError"
    }
}

impl PythonError for TradeoffError {
    fn class(&self) -> &'static str {
        match self {
            Self::Setup(error) => error.class(),
            Self::FewerNodes { .. } => "LadderError",
            _ => "TradeoffError",
        }
    }
}

impl PythonError for PageError {
    fn class(&self) -> &'static str {
        "StorageError"
    }
}

impl PythonError for PictureError {
    fn class(&self) -> &'static str {
        "StorageError"
    }
}

impl PythonError for GeometryError {
    fn class(&self) -> &'static str {
        "ArrayError"
    }
}

impl PythonError for NodalError {
    fn class(&self) -> &'static str {
        "ArrayError"
    }
}

impl PythonError for EvaluationError {
    fn class(&self) -> &'static str {
        match self {
            Self::Setup(error) => error.class(),
            _ => "ArrayError",
        }
    }
}

/// An earlier call panicked and may have left its object half changed.
#[derive(Debug, thiserror::Error)]
#[error("an earlier call on this object failed by a bug in Curveflow; make a new one")]
pub struct Panicked;

impl PythonError for Panicked {
    fn class(&self) -> &'static str {
        "BugError"
    }
}

/// Runs `call` without the interpreter lock and turns its error, or its panic, into an exception.
pub fn detached<T: Send, E: PythonError>(
    py: Python<'_>,
    call: impl FnOnce() -> Result<T, E> + Send,
) -> PyResult<T> {
    match py.detach(|| catch_unwind(AssertUnwindSafe(call))) {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(error)) => Err(raised(py, &error)),
        Err(_) => {
            let text = "a bug in Curveflow: please report the lines above and the scene";
            Err(exception(py, "BugError", text))
        }
    }
}

/// The exception of an error.
pub fn raised(py: Python<'_>, error: &impl PythonError) -> PyErr {
    exception(py, error.class(), &with_causes(error))
}

/// An exception of a class of `curveflow.errors`.
#[cold]
pub fn exception(py: Python<'_>, class: &str, message: &str) -> PyErr {
    let raised = py.import("curveflow.errors").and_then(|errors| errors.getattr(class)?.call1((message,)));
    raised.map_or_else(|error| error, PyErr::from_value)
}
